"""A four-bar linkage whose crank bends: its clamp rotates while a dead force increases on the joint of coupler and
rocker.

The coupler and the rocker are pinned at both ends. They stay straight, stretch, and transmit only axial forces.
Therefore the crank is a cantilever with the force F of the coupler and no moment at its end: E I t' = M0 - (x F_y - y
F_x) and (x, y)' = (1 + F . e/EA) e with e = (cos t, sin t). These equations are integrated by Gauss's rule of order
eight. The unknowns are M0 (the moment of the motor is -M0), the forces of coupler and rocker, and the directions of
these forces.
"""
import numpy as np
from scipy.optimize import fsolve

TABLES = "examples"
CRANK, COUPLER, ROCKER, GROUND, BEGIN = 0.1, 0.3, 0.25, 0.3, np.pi / 3
YOUNG, WIDTH, THIN, THICK = 210e9, 0.01, 0.001, 0.004
TURNED, LOAD = 2.0, -20.0  # rotation [rad] and force along y [N]
POINTS, WEIGHTS = np.polynomial.legendre.leggauss(4)
LEVELS, RELATIVE = 20, 1e-11


def stage_weights():
    """Returns the integrals from 0 to each of the Gauss points in [0, 1] (rows) of the Lagrange polynomials through these
    points (columns)."""
    c = (POINTS + 1) / 2
    V = np.vander(c, increasing=True)
    return np.array([[x ** (k + 1) / (k + 1) for k in range(len(c))] for x in c]) @ np.linalg.inv(V)


STAGES = stage_weights()


def along(angle):
    return np.array([np.cos(angle), np.sin(angle)])


def tip(clamp, M0, F, intervals):
    def slope(Y):
        e = np.array([np.cos(Y[:, 0]), np.sin(Y[:, 0])])
        g = 1 + (F[0] * e[0] + F[1] * e[1]) / (YOUNG * WIDTH * THIN)
        return np.array([(M0 - Y[:, 1] * F[1] + Y[:, 2] * F[0]) / (YOUNG * WIDTH * THIN ** 3 / 12),
                         g * e[0], g * e[1]]).T

    y, h = np.array([clamp, 0, 0]), CRANK / intervals
    for _ in range(intervals):
        Y = np.tile(y, (len(POINTS), 1))
        for _ in range(40):
            last, Y = Y, y + h * STAGES @ slope(Y)
            if np.abs(Y - last).max() < 1e-16:
                break
        y = y + h * WEIGHTS / 2 @ slope(Y)
    return y[1:], M0 - y[1] * F[1] + y[2] * F[0]


def residual(u, part, intervals):
    M0, pull, direction, push, across = u
    c, r = along(direction), along(across)
    end, moment = tip(BEGIN + part * TURNED, M0, pull * c, intervals)
    bars = pull * c + push * r - part * np.array([0, LOAD])
    joint = end + COUPLER * (1 + pull / (YOUNG * WIDTH * THICK)) * c
    gap = joint - [GROUND, 0] - ROCKER * (1 + push / (YOUNG * WIDTH * THICK)) * r
    return np.array([moment / CRANK, *bars, *(gap * 1e3)])


def at_rest():
    end = CRANK * along(BEGIN)
    d = [GROUND, 0] - end
    a = (COUPLER ** 2 - ROCKER ** 2 + d @ d) / (2 * np.hypot(*d))
    h = np.sqrt(COUPLER ** 2 - a * a)
    c = (a * d + h * np.array([-d[1], d[0]])) / np.hypot(*d)
    r = end + c - [GROUND, 0]
    return np.arctan2(c[1], c[0]), np.arctan2(r[1], r[0])


def solved(intervals=16):
    directions = at_rest()
    u = np.array([0, 0, directions[0], 0, directions[1]])
    for level in range(1, LEVELS + 1):
        u, _, good, words = fsolve(residual,
                                   u, (level / LEVELS, intervals),
                                   xtol=1e-14,
                                   full_output=True)
        if np.abs(residual(u, level / LEVELS, intervals)).max() > 1e-10:
            raise ArithmeticError(words)
    return u


def values(u):
    M0, pull, _, push, across = u
    c, r = at_rest()[1], ROCKER * (1 + push / (YOUNG * WIDTH * THICK)) * along(across)
    return {
        "move_x": (r[0] - ROCKER * np.cos(c), "m"), "move_y": (r[1] - ROCKER * np.sin(c), "m"),
        "torque": (-M0, "N m"), "coupler": (pull, "N"), "rocker": (push, "N")
    }


def rows():
    for name, (value, unit) in values(solved()).items():
        yield "four_bar", "", name, value, unit, RELATIVE


if __name__ == "__main__":
    for row in rows():
        print(row)
    print(max(abs(values(solved())[n][0] / v - 1) for n, (v, _) in values(solved(24)).items()))
