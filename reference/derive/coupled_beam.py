"""A cantilever with a section given by matrices: (N, Q, M) = C (gamma, kappa), and the kinetic energy per length is 1/2
v . m v with the velocities v and the mass matrix m. L = 1.

Linear statics: the displacement along a load is the integral of (N, Q, M) . C^-1 (N, Q, M of the unit load). Weight
acts at the centre of mass.

Helix: there is no force, and M is an eigenvector of (C^-1)_kk, so M is along kappa. M is constant both in space and in
the axes of the section. Therefore strains are uniform, R = exp(s kappa~) and r = int R (e_x + gamma) ds.

Frequencies, with v = (u, theta) and the vectors N of the force and M of the moment: gamma = u' + e_x x theta, kappa =
theta', N' = -omega^2 (m v)_force and M' = -e_x x N - omega^2 (m v)_moment. These twelve equations with constant
coefficients A have the transfer matrix exp(A). One end is clamped and the other is free.

Buckling under the dead force n = -P e_x: the force on the rotated section changes by n x theta, and M' = -e_x x N - u'
x n.
"""
from mpmath import cos, det, expm, findroot, matrix, mp, mpf, pi, quad, sin, sqrt

from reference.derive import defaults

mp.dps = 30
STIFF = [mpf(v) for v in (10 ** 7, 4 * 10 ** 6, 3 * 10 ** 6, 800, 1000, 4000)]
MASS, CENTRE, ABOUT = mpf(2), (mpf("0.02"), mpf("-0.01")), (mpf("0.0008"), mpf("0.0018"))
GRAVITY = mpf("9.81")
NAMES = (("ux", "m"), ("uy", "m"), ("uz", "m"), ("rx", "rad"), ("ry", "rad"), ("rz", "rad"))


def stiffness(coupling, helix):
    C = matrix(6, 6)
    for i in range(6):
        C[i, i] = STIFF[i]
    parts = {(0, 3): coupling / 2, (3, 4): coupling}
    if not helix:
        parts.update({(0, 1): 3 * coupling / 10, (1, 5): -coupling / 5, (2, 4): coupling / 5,
                      (3, 5): 2 * coupling / 5})
    for (i, j), part in parts.items():
        C[i, j] = C[j, i] = part * sqrt(STIFF[i] * STIFF[j])
    return C


def mass(coupling):
    """Returns the mass matrix int rho [1, -x~; x~, -x~ x~] dA per length of beam."""
    y, z = (coupling * c for c in CENTRE)
    x = matrix([[0, -z, y], [z, 0, 0], [-y, 0, 0]])
    out, turned = matrix(6, 6), -MASS * x * x
    about = (ABOUT[0] + ABOUT[1], *ABOUT)
    for i in range(3):
        out[i, i] = MASS
        for j in range(3):
            out[i, 3 + j], out[3 + i, j] = -MASS * x[i, j], MASS * x[i, j]
            out[3 + i, 3 + j] = turned[i, j] + (about[i] if i == j else 0)
    return out


def at_section(x, tip):
    """Returns the resultants (N, Q, M) at x due to the force and the moment `tip` at the free end."""
    fx, fy, fz, mx, my, mz = tip
    return matrix([fx, fy, fz, mx, my - (1 - x) * fz, mz + (1 - x) * fy])


def weight_at_section(x, coupling):
    w, rest, (y, _) = -MASS * GRAVITY, 1 - x, CENTRE
    return matrix([0, 0, w * rest, w * rest * coupling * y, -w * rest ** 2 / 2, 0])


def displacement(coupling, weight, row):
    F = stiffness(coupling, False) ** -1
    unit = [mpf(i == row) for i in range(6)]

    def density(x):
        here = weight_at_section(x, coupling) if weight else at_section(
            x, (mpf(1000), 0, mpf(50), mpf(10), 0, 0))
        return (at_section(x, unit).T * F * here)[0]

    return quad(density, [0, 1])


def helix(coupling, turn):
    C = stiffness(coupling, True)
    F = C ** -1
    k, b = C[3, 3] - C[0, 3] ** 2 / C[0, 0], C[3, 4]
    soft = (k + C[4, 4]) / 2 - sqrt((k - C[4, 4]) ** 2 / 4 + b ** 2)
    size = sqrt(b ** 2 + (soft - k) ** 2)
    M = matrix([0, 0, 0, soft * turn * b / size, soft * turn * (soft - k) / size, 0])
    strain = F * M
    axis, along = strain[3:6] / turn, matrix([1 + strain[0], strain[1], strain[2]])
    cross = lambda a, c: matrix(
        [a[1] * c[2] - a[2] * c[1], a[2] * c[0] - a[0] * c[2], a[0] * c[1] - a[1] * c[0]])
    once = cross(axis, along)
    r = along + (1 - cos(turn)) / turn * once + (1 - sin(turn) / turn) * cross(axis, once)
    return (("ux", r[0] - 1, "m"), ("uy", r[1], "m"), ("uz", r[2], "m"))


def cross_matrix(a):
    return matrix([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def free_end(F, M, squared, force):
    """Returns the determinant of the matrix [6, 6] that maps the forces and moments at the clamped end to those at the
    free end, up to a factor. It follows from (u, theta, N, M)' = A (u, theta, N, M) and vanishes for a solution with a
    free end."""
    axis, n = cross_matrix((1, 0, 0)), cross_matrix((-force, 0, 0))
    S, A, scale = matrix(6, 12), matrix(12, 12), sqrt(STIFF[4])
    for i in range(6):
        S[i, 6 + i] = scale
        for j in range(3):
            S[i, 3 + j] = n[i, j] if i < 3 else 0
    strain = F * S
    for j in range(12):
        for i in range(6):
            A[i, j] = strain[i, j] - (axis[i, j - 3] if i < 3 and 3 <= j < 6 else 0)
            A[6 + i, j] = -squared * M[i, j] / scale if j < 6 else mpf(0)
    for i in range(3):
        for j in range(12):
            A[9 + i, j] += sum(n[i, k] * A[k, j]
                               for k in range(3)) / scale - (axis[i, j - 6] if 6 <= j < 9 else 0)
    return det(expm(A)[6:12, 6:12])


def first_roots(f, step, wanted):
    found, low = [], step / 2
    value = f(low)
    while len(found) < wanted:
        high = low + step
        other = f(high)
        if value * other < 0:
            found.append(
                findroot(f, (low, high), solver="anderson", tol=mpf(10) ** -20, verify=False))
        low, value = high, other
    return found


def frequencies(coupling, wanted):
    F, M = stiffness(coupling, False) ** -1, mass(coupling)
    return [
        w / (2 * pi) for w in first_roots(lambda w: free_end(F, M, w ** 2, 0),
                                          sqrt(STIFF[4] / MASS) / 3, wanted)
    ]


def buckling_load(coupling):
    F, none = stiffness(coupling, False) ** -1, matrix(6, 6)
    return first_roots(lambda P: free_end(F, none, 0, P), STIFF[4] / 4, 1)[0]


def values(given):
    at = defaults.decimals("coupled_beam", given)
    coupling = at["coupling"]
    if at["asked"] == "helix":
        yield from helix(coupling, at["turn"])
    elif at["asked"] == "frequencies":
        for i, value in enumerate(frequencies(coupling, 4)):
            yield f"frequency_{i + 1}", value, "Hz"
    elif at["asked"] == "buckling":
        yield "buckling_load", buckling_load(coupling), "N"
    else:
        for row, (name, unit) in enumerate(NAMES):
            if coupling != 0 or name not in ("uy", "rz"):
                yield name, displacement(coupling, at["asked"] == "weight", row), unit


POINTS = ("", "coupling=0.2", "coupling=0", "asked=weight", "asked=helix", "asked=helix;turn=-6",
          "asked=frequencies", "asked=frequencies;coupling=0.2", "asked=buckling",
          "asked=buckling;coupling=0.2")


def rows():
    for at in POINTS:
        for quantity, value, unit in values(dict(
                item.split("=") for item in at.split(";") if item)):
            yield "coupled_beam", at, quantity, value, unit
