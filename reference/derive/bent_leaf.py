"""Leaf between a clamp and a stage that moves transversely without rotating and is free along the leaf: the extensible
elastica.

Each half is a cantilever under a transverse force F at the point of inflection. With the initial length s, the angle t
of the axis and N = F sin t,
  EI t'' = -F cos t (1 + F sin t/EA),   EI t'^2/2 = F (sin e - sin t) + F^2 (sin^2 e - sin^2 t)/2EA,   where e is the value of t at the inflection.
With sin t = sin e - u^2, the integrals over the angle are smooth. At the clamp, N = 0, and the stress is E t' h/2 with
the thickness h.
"""
from mpmath import asin, cos, findroot, mp, mpf, quad, sin, sqrt

mp.dps = 30
TABLES = "examples"
E, LENGTH, WIDTH, THICK, TRAVEL = mpf("200e9"), mpf("0.1"), mpf("0.02"), mpf("0.5e-3"), mpf("0.03")
EI, EA = E * WIDTH * THICK ** 3 / 12, E * WIDTH * THICK


def curvature(F, e, u):
    return u * sqrt(2 * F / EI * (1 + F / EA * (sin(e) - u ** 2 / 2)))


def integral(F, e, low, f):
    """Returns the integral of f(sin t) over the initial length from u = `low` to the point of inflection (u = 0)."""

    def slope(u):
        t = asin(sin(e) - u ** 2)
        return f(sin(t)) * 2 / (cos(t) * sqrt(2 * F / EI * (1 + F / EA * (sin(e) - u ** 2 / 2))))

    return quad(slope, [0, low])


def solved(travel):
    def missing(F, e):
        root = sqrt(sin(e))
        return (integral(F, e, root, lambda sine: 1) / LENGTH - mpf(1) / 2,
                integral(F, e, root, lambda sine: sine * (1 + F * sine / EA)) / travel - mpf(1) / 2)

    return findroot(missing, (12 * EI * travel / LENGTH ** 3, mpf(3) / 2 * travel / LENGTH))


def stress(travel):
    F, e = solved(travel)
    return E * THICK / 2 * curvature(F, e, sqrt(sin(e)))


def moment(travel, place):
    """Returns the moment at a distance from the clamp. `place` is this distance divided by the length, less than one
    half."""
    F, e = solved(travel)
    u = findroot(lambda low: integral(F, e, low, lambda sine: 1) / LENGTH - (mpf(1) / 2 - place),
                 sqrt(sin(e)) * (1 - 2 * place))
    return EI * curvature(F, e, u)


def rows():

    def row(quantity, value, unit):
        return "bent_leaf", "thickness=0.5e-3", quantity, value, unit

    most = stress(TRAVEL)
    yield row("stress_small", stress(TRAVEL / 100), "Pa")
    yield row("stress", most, "Pa")
    yield row("compression", -most, "Pa")
    yield row("quarter", moment(TRAVEL, mpf(1) / 4), "N m")
    yield row("largest", most * WIDTH * THICK ** 2 / 6, "N m")
    yield row("force", solved(TRAVEL)[0], "N")
