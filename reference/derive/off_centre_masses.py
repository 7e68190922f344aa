"""Frequencies of a cantilever with a round section and two point masses on rigid arms at its end, +-a across it (NAFEMS
FV4).

The cantilever is rigid in shear and has rotary inertia. Both masses together are a body of mass m. Its centre of mass
is at the distance y from the axis, and its moment of inertia about the axes along x and z through this centre is J.
With the angular frequency o and the displacements u, v, w of the end, the resultants are
  in the plane of the arms   Q = m o^2 v, N = m o^2 (u - y t), M = o^2 (J t - m y (u - y t)), where t is the rotation of the end
  across it                  Q = m o^2 (w + y p), M = 0, T = o^2 (J p + m y (w + y p)), where p is the twist of the end
They act at the end of the beam and are due to the inertia forces of the body.
"""
from mpmath import det, matrix, mp, mpf, pi, sqrt

from reference.derive.vibrating_beam import along, bending, zeros

mp.dps = 40
TABLES = "examples"
E, RHO, LENGTH, DIAMETER, HEAVY, LIGHT = mpf("200e9"), mpf(8000), mpf(10), mpf("0.5"), mpf(
    10000), mpf(1000)
G, A, I = E / mpf("2.6"), pi * DIAMETER ** 2 / 4, pi * DIAMETER ** 4 / 64
COUNT, HIGHEST, STEP = 6, 60, mpf("0.5")  # [Hz]


def body(arm):
    m = HEAVY + LIGHT
    return m, arm * (HEAVY - LIGHT) / m, HEAVY * LIGHT / m * (2 * arm) ** 2


def end(o, flexibility):
    """Returns (w, t, M, Q) at the end (rows) due to unit (M, Q) at the root (columns)."""
    return bending(LENGTH, o, E * I, RHO * A, RHO * I, flexibility)[:, 2:]


def in_plane(f, arm, flexibility=0):
    o, (m, y, J) = 2 * pi * f, body(arm)
    bent, (u, N) = end(o, flexibility), along(LENGTH, o, E * A, sqrt(E / RHO))
    rows = matrix(3, 3)
    for k, (v, t, M, Q, u, N) in enumerate([[*bent[:, 0], 0, 0], [*bent[:, 1], 0, 0],
                                            [0, 0, 0, 0, u, N]]):
        centre = m * o ** 2 * (u - y * t)
        rows[0,
             k], rows[1,
                      k], rows[2,
                               k] = Q - m * o ** 2 * v, N - centre, M - o ** 2 * J * t + y * centre
    return det(rows)


def across(f, arm, flexibility=0):
    o, (m, y, J) = 2 * pi * f, body(arm)
    bent, (p, T) = end(o, flexibility), along(LENGTH, o, 2 * G * I, sqrt(G / RHO))
    rows = matrix(3, 3)
    for k, (w, M, Q, p, T) in enumerate([[bent[0, 0], *bent[2:, 0], 0, 0],
                                         [bent[0, 1], *bent[2:, 1], 0, 0], [0, 0, 0, p, T]]):
        centre = m * o ** 2 * (w + y * p)
        rows[0, k], rows[1, k], rows[2, k] = Q - centre, M, T - o ** 2 * J * p - y * centre
    return det(rows)


def frequencies(arm, flexibility=0):
    found = [
        f for family in (in_plane, across)
        for f in zeros(lambda f, one=family: one(f, mpf(arm), flexibility), HIGHEST, STEP)
    ]
    return sorted(found)[:COUNT]


def rows():
    for i, value in enumerate(frequencies(2)):
        yield "off_centre_masses", "arm=2", f"frequency_{i + 1}", value, "Hz"
