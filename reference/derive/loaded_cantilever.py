"""A plane cantilever under follower or dead loads: the equations of the extensible elastica, integrated from its tip.

The equations are x' = (1 + N/EA) cos t, y' = (1 + N/EA) sin t, EI t' = M, F' = -q and M' = y' F_x - x' F_y - m with N
= F_x cos t + F_y sin t. The loads q and m are per initial length. F and M are the action of the outer part on the
inner part. A Runge-Kutta method of order 8 starts at the tip. The angle of the tip is determined by the condition that
the root does not rotate. Follower loads need no search, because the whole solution rotates with the tip.
"""
from math import cos, sin

from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from reference.derive import defaults

RELATIVE = 5e-12
LOADS = ("follower", "dead", "pressure", "line", "couples", "weight")
POINTS = ({}, {"size": 1}, {"arm": "0.2"}, {"load": "dead", "arm": "0.2"}, {"load": "pressure"}, {
    "load": "pressure", "size": 4
}, {"load": "line"}, {"load": "couples", "size": 2}, {"load": "weight", "size": 6})


def from_tip(at, angle):
    """Returns (x, y, t) of the root for a tip at the origin that is rotated by `angle`."""
    load, size, axial = at["load"], at["size"], at["axial"]
    transverse = (-sin(angle), cos(angle)) if load == "follower" else (0.0, 1.0)
    tip = size if load in ("follower", "dead") else 0.0
    F = tip * transverse[0], tip * transverse[1]
    M = at["arm"] * (cos(angle) * F[1] - sin(angle) * F[0])
    couple = size if load == "couples" else 0.0

    def slope(s, y):
        _, _, t, fx, fy, moment = y
        along = 1 + (fx * cos(t) + fy * sin(t)) / axial
        dx, dy = along * cos(t), along * sin(t)
        q = {
            "pressure": (-size * sin(t), size * cos(t)), "line": (0.0, size), "weight": (0.0, size)
        }.get(load, (0.0, 0.0))
        return [-dx, -dy, -moment, q[0], q[1], -(dy * fx - dx * fy - couple)]

    return solve_ivp(slope, (0, 1), [0.0, 0.0, angle, F[0], F[1], M],
                     method="DOP853",
                     rtol=3e-14,
                     atol=1e-15).y[:3, -1]


def tip(given):
    """Returns (x, y, angle) of the tip for L = EI = 1."""
    at = {
        **defaults.values("loaded_cantilever"),
        **{k: defaults.value(str(v))
           for k, v in given.items()}
    }
    if at["load"] in ("follower", "pressure"):
        x, y, t = from_tip(at, 0.0)
        return -(x * cos(t) + y * sin(t)), -(y * cos(t) - x * sin(t)), -t
    angle = brentq(lambda a: from_tip(at, a)[2], 0, 1.6, xtol=1e-15)
    x, y, _ = from_tip(at, angle)
    return -x, -y, angle


def rows_at(given):
    x, y, angle = tip(given)
    yield "w_over_L", y, "1", RELATIVE
    yield "u_over_L", 1 - x, "1", RELATIVE
    yield "theta", angle, "rad", RELATIVE


def rows():
    for given in POINTS:
        for row in rows_at(given):
            yield "loaded_cantilever", defaults.differing("loaded_cantilever", **given), *row
