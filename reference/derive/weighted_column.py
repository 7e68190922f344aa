"""Buckling of a column that is clamped at its base, under its weight q per length and a load P on its top; L = EI = 1.

The slope t satisfies t'' + (P + q (1 - x)) t = 0, t(0) = 0 and t'(1) = 0. The solution is a power series in the
distance from the top.
"""
from mpmath import findroot, mp, mpf

from reference.derive import defaults

mp.dps = 30
TERMS = 120
POINTS = ({}, {"staying": 4}, {"staying": -20}, {"grows": "weight",
                                                 "staying": 1}, {"grows": "weight", "staying": -5})


def slope_at_foot(P, q):
    """Returns the slope at the base for the solution with slope 1 and zero moment at the top."""
    c = [mpf(1), mpf(0)]
    while len(c) < TERMS:
        n = len(c) - 2
        c.append(-(P * c[n] + (q * c[n - 1] if n > 0 else 0)) / ((n + 2) * (n + 1)))
    return sum(c)


def load_factor(given):
    """Returns the smallest load factor. The slope at the base decreases from 1 as the loads increase, so the first zero
    is bracketed from below."""
    at = defaults.decimals("weighted_column", given)

    def value(factor):
        return slope_at_foot(factor, at["staying"]) if at["grows"] == "head" else slope_at_foot(
            at["staying"], factor)

    low = mpf(0)
    while value(low + mpf("0.05")) > 0:
        low += mpf("0.05")
    return findroot(value, (low, low + mpf("0.05")), solver="anderson", tol=mpf(10) ** -40)


def rows():
    for given in POINTS:
        yield "weighted_column", defaults.differing("weighted_column",
                                                    **given), "load_factor", load_factor(given), "1"
