"""Isotropic rod (EI = GJ = 1) of length 1. Its tip is rotated by phi = strain (0.6, 0, 0.8) relative to its root, and
then the whole rod is rotated about (1, 2, 3).

Without a force, the moment M = phi EI/L and the curvature phi/L are constant along the rod, and r = int exp(s phi) ex
ds. After the rotation R, the moment and the position are R M and R r."""
from mpmath import matrix, mp, mpf, cos, pi, sin, sqrt

from reference.derive import defaults

mp.dps = 40
QUANTITIES = (("M_x", "N m"), ("M_y", "N m"), ("M_z", "N m"), ("u_x", "m"), ("u_y", "m"), ("u_z",
                                                                                           "m"))


def cross(a, b):
    return matrix([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def turned(angle, axis, v):
    once = cross(axis, v)
    return v + sin(angle) * once + (1 - cos(angle)) * cross(axis, once)


def rod(turns, strain):
    bend, way = matrix(["0.6", "0", "0.8"]), matrix([1, 2, 3]) / sqrt(mpf(14))
    ex, angle = matrix([1, 0, 0]), 2 * pi * mpf(turns)
    once = cross(bend, ex)
    tip = ex + (1 - cos(strain)) / strain * once + (1 - sin(strain) / strain) * cross(bend, once)
    moment, place = turned(angle, way, bend * strain), turned(angle, way, tip) - ex
    at = defaults.differing("carried_rod", turns=turns, strain=float(strain))
    for (name, unit), value in zip(QUANTITIES, list(moment) + list(place)):
        yield "carried_rod", at, name, value if abs(value) > mpf(10) ** -30 else mpf(0), unit


def rows():
    for turns, strain in (("1", mpf(1)), ("0", mpf(1)), ("0.3", mpf(1)), ("2.5", mpf("0.5"))):
        yield from rod(turns, strain)
