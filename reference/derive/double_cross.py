"""Frequencies of eight equal pinned arms that meet at a hub, in their plane (NAFEMS FV2).

The arms are rigid in shear and have no rotary inertia. A rotation by one arm does not change the structure, so the
amplitudes of the arms in a mode are proportional to e^{i m a}, where a is the angle of the arm. For m = 0, all arms
bend in the same way, and the hub rotates without a resisting moment, so each arm vibrates as if it were pinned at both
ends. For m = 1 and 7, the hub moves without rotation, and the arms stretch. The force on the hub per displacement is
that of four arms along the displacement and four arms across it. This force must vanish. Each of these modes occurs
twice, once for each m. For the other five m, the hub is at rest, and the arms are clamped there. Each of these modes
occurs five times. Modes in which arms only stretch start at c/(2 L) = 500 Hz.
"""
from mpmath import cos, mp, mpf, pi, sin, sqrt

from reference.derive.vibrating_beam import bending, zeros

mp.dps = 40
TABLES = "examples"
E, RHO, LENGTH, SIDE = mpf("200e9"), mpf(8000), mpf(5), mpf("0.125")
A, I = SIDE ** 2, SIDE ** 4 / 12
HIGHEST, STEP = 60, mpf("0.5")  # [Hz]


def from_pin(f):
    """Returns (w, t, M, Q) at the hub due to unit (t, Q) at the pinned end [4, 2]."""
    t = bending(LENGTH, 2 * pi * f, E * I, RHO * A)
    return [[t[i, 1], t[i, 3]] for i in range(4)]


def minor(rows, i, k):
    return rows[i][0] * rows[k][1] - rows[i][1] * rows[k][0]


def turning(f):
    return minor(from_pin(f), 0, 2)


def at_rest(f):
    return minor(from_pin(f), 0, 1)


def moving(f):
    """The force of an arm per displacement is Q/w across the arm, with t = 0, and EA k cot(k L) along it."""
    rows, k = from_pin(f), 2 * pi * f / sqrt(E / RHO)
    return E * A * k * cos(k * LENGTH) * minor(rows, 0, 1) + sin(k * LENGTH) * minor(rows, 3, 1)


FAMILIES = ((turning, 1), (moving, 2), (at_rest, 5))  # conditions, each with the number of equal modes


def frequencies():
    return sorted(f for family, alike in FAMILIES for f in zeros(family, HIGHEST, STEP)
                  for _ in range(alike))


def rows():
    for i, value in enumerate(frequencies()):
        yield "double_cross", "", f"frequency_{i + 1}", value, "Hz"
