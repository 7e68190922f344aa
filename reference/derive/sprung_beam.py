"""Beams on rotational springs of stiffness k EI/L, with L = 1, EI = 1 and rho A = 1. Shear deformation and rotary inertia
are neglected.

Two supports with equal springs and a force 1 in the middle: the end moment is M = k/(8 (2 + k)), and w = 1/48 - M/8.
Symmetric buckling and vibration: w'' = -+k w' at the ends gives tan u = -2 u/k with P = 4 u^2, and tan u + tanh u = -4
u/k with omega = 4 u^2. One support and a moment m at the end: the spring rotates by m/k, less than 3 rad, and the beam
is an arc of the angle m.
"""
from mpmath import cos, findroot, mp, mpf, pi, sin, tanh

from reference.derive import defaults

mp.dps = 30


def deflection(k):
    return mpf(1) / 48 - mpf(k) / (64 * (2 + mpf(k)))


def buckling_load(k):
    return 4 * findroot(lambda u: sin(u) * k + 2 * u * cos(u), (pi / 2, pi), solver="anderson") ** 2


def frequency(k):
    return 4 * findroot(lambda u: (sin(u) + cos(u) * tanh(u)) * k + 4 * u * cos(u),
                        (pi / 2, mpf(3) * pi / 4 + mpf(1) / 10),
                        solver="anderson") ** 2


def rolled(k, m):
    turned, m = mpf(m) / mpf(k), mpf(m)
    return (("x", (sin(turned + m) - sin(turned)) / m, "m"),
            ("y", (cos(turned) - cos(turned + m)) / m, "m"))


def values(given):
    at = defaults.decimals("sprung_beam", given)
    k, load = at["spring"], at["load"]
    if load == "axial":
        return (("buckling_load", buckling_load(k), "N"), )
    if load == "moment":
        return rolled(k, at["moment"])
    return (("deflection", deflection(k), "m"), ("frequency", frequency(k), "1"))


POINTS = ("", "spring=0.01", "spring=1000", "load=axial", "load=axial;spring=0.01",
          "load=axial;spring=1000", "load=moment", "load=moment;spring=1", "load=moment;moment=3.5")


def rows():
    for at in POINTS:
        for quantity, value, unit in values(dict(
                item.split("=") for item in at.split(";") if item)):
            yield "sprung_beam", at, quantity, value, unit
