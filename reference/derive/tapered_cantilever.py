"""A cantilever whose section changes linearly: displacements by integrals over its flexibility, Kirchhoff's wedge, and a
column with Iz ~ x^3.

Statics: the forces at the tip cause N, Q, M in the principal axes of the section at x. The displacement along a load
P_i is the integral over x of the sum of (stress resultant) (stress resultant for P_i = 1) (flexibility). Torsion is
about the shear centre, Mx - ys Qz + zs Qy. The I-section warps: the twist rate a due to the torque T satisfies (EIw
a')' - GIt a + T = 0 with a(0) = 0 and a'(1) = 0, solved by collocation at the Chebyshev points. The twist is int a dx.

Buckling and vibration of the wedge with the second moment of area I1 s^3 and the area A1 s, at the distance s from the
point where its thickness vanishes, with Bessel functions Z = J, Y:
    buckling    E I1 s^3 w'' + P w = 0            w = sqrt(s) Z1(2 q/sqrt(s)),           q^2 = P/(E I1)
    bending     E I1 (s^3 w'')'' = omega^2 rho A1 s w     w = Z1(2 b sqrt(s))/sqrt(s),
    where Z also includes I and K (Kirchhoff 1879), b^4 = omega^2 rho A1/(E I1)
"""
from mpmath import besseli, besselj, besselk, bessely, cos, det, findroot, lu_solve, matrix, mp, mpf, pi, quad, sin, sqrt, tanh

from reference.derive import defaults
from reference.derive.section import section

mp.dps = 30
E, G, RHO = mpf(210) * 10 ** 9, mpf(81) * 10 ** 9, mpf(7800)
WIDTH, THICKNESS, DEPTH, FLANGE, WALL = mpf("0.03"), mpf("0.02"), mpf("0.1"), mpf("0.06"), mpf(
    "0.002")
LOADS = (mpf(1000), mpf(100), mpf(100), mpf(10))  # Fx, Fy, Fz, Mx at the tip
NAMES = (("stretch", "m"), ("deflection_y", "m"), ("deflection_z", "m"), ("twist", "rad"),
         ("slope_y", "rad"), ("slope_z", "rad"))


def rectangle_torsion(a, b):
    h, t = max(a, b), min(a, b)
    total = mp.zeta(5) * 31 / 32 + sum(
        (tanh(n * pi * h / (2 * t)) - 1) / mpf(n) ** 5 for n in range(1, 60, 2))
    return h * t ** 3 / 3 * (1 - 192 / pi ** 5 * t / h * total)


class At:
    """Constants of the section at x: A, Iy, Iz, It, Iw and the shear centre (ys, zs), in principal axes, which are
    rotated by beta."""

    def __init__(self, form, ratio, x):
        size = 1 + x * (ratio - 1)
        if form == "wedge":
            t = size * THICKNESS
            self.A, self.Iy, self.Iz, self.It = WIDTH * t, t * WIDTH ** 3 / 12, WIDTH * t ** 3 / 12, rectangle_torsion(
                WIDTH, t)
            self.Iw = self.ys = self.zs = self.beta = mpf(0)
            return
        b, h, t = size * FLANGE, DEPTH / 2, WALL
        if form == "i":
            points = [(-b / 2, h), (0, h), (b / 2, h), (-b / 2, -h), (0, -h), (b / 2, -h)]
            walls = [(0, 1, t), (1, 2, t), (1, 4, t), (3, 4, t), (4, 5, t)]
        else:
            points, walls = [(-b, h), (0, h), (0, -h),
                             (-b if form == "channel" else b, -h)], [(i, i + 1, t)
                                                                     for i in range(3)]
        s = section(points, walls)
        self.A, self.Iy, self.Iz, self.It, self.Iw, self.ys, self.zs, self.beta = s.A, s.Iy, s.Iz, s.It, s.Iw, s.ys, s.zs, s.beta


def resultants(at, x, load):
    """Returns N, Qy, Qz, the torque about the shear centre, My, Mz in principal axes, due to (Fx, Fy, Fz, Mx, My, Mz) at
    the tip."""
    fx, fy, fz, mx, my, mz = load
    arm = 1 - x
    my, mz = my - arm * fz, mz + arm * fy
    c, s = cos(at.beta), sin(at.beta)
    qy, qz, my, mz = c * fy + s * fz, c * fz - s * fy, c * my + s * mz, c * mz - s * my
    return fx, qy, qz, mx - at.ys * qz + at.zs * qy, my, mz


def displacement(form, ratio, shear, row):
    load = (*LOADS, 0, 0)
    unit = [mpf(i == row) for i in range(6)]

    def density(x):
        at = At(form, ratio, x)
        slide = mpf(6) / 5 / (G * at.A) if shear else mpf(0)
        flexibility = (1 / (E * at.A), slide, slide, 1 / (G * at.It) if form != "i" else 0,
                       1 / (E * at.Iy), 1 / (E * at.Iz))
        return sum(
            a * b * f
            for a, b, f in zip(resultants(at, x, load), resultants(at, x, unit), flexibility))

    value = quad(density, [0, mpf(1) / 2, 1])
    return value + (twist_of_i(ratio) if form == "i" and row == 3 else 0)


def chebyshev(n):
    x = [(1 - cos(pi * j / n)) / 2 for j in range(n + 1)]
    weight = [(-1) ** j * (mpf(2) if j in (0, n) else mpf(1)) for j in range(n + 1)]
    D = matrix(n + 1, n + 1)
    for i in range(n + 1):
        for j in range(n + 1):
            if i != j:
                D[i, j] = weight[i] / weight[j] / (x[i] - x[j])
        D[i, i] = -sum(D[i, j] for j in range(n + 1))
    return x, D


def twist_of_i(ratio, n=30):
    x, D = chebyshev(n)
    at = [At("i", ratio, s) for s in x]
    A = D * matrix([[E * at[i].Iw * D[i, j] for j in range(n + 1)] for i in range(n + 1)])
    T = matrix([-LOADS[3]] * (n + 1))
    for i in range(n + 1):
        A[i, i] -= G * at[i].It
    for j in range(n + 1):
        A[0, j], A[n, j] = mpf(j == 0), D[n, j]
    T[0] = T[n] = 0
    a = lu_solve(A, T)
    a[0] = 0  # boundary value
    for j in range(n + 1):
        D[0, j] = mpf(j == 0)
    return lu_solve(D, a)[n]


def ends(ratio):
    """Returns the distances of tip and root from the point where the thickness vanishes, and the sign of s along x."""
    return ratio / abs(1 - ratio), 1 / abs(1 - ratio), (1 if ratio > 1 else -1)


def first_roots(f, start, step, wanted):
    found, low, value = [], start, f(start)
    while len(found) < wanted:
        high = low + step
        other = f(high)
        if value * other < 0:
            found.append(findroot(f, (low, high), solver="anderson", tol=mpf(10) ** -40))
        low, value = high, other
    return found


def buckling_load(ratio):
    tip, root, _ = ends(ratio)
    unit = E * WIDTH * THICKNESS ** 3 / 12 / root ** 3

    def condition(q):
        """Returns the determinant of the two conditions w(tip) = 0 (w measured from the tip) and w'(root) = 0. With z = 2
        q/sqrt(s), w ~ Z1(z)/z and w' ~ z^2 Z2(z)."""
        here, there = 2 * q / sqrt(tip), 2 * q / sqrt(root)
        return besselj(1, here) * bessely(2, there) - bessely(1, here) * besselj(2, there)

    low = first_roots(condition, mpf(1) / 100 * sqrt(root), sqrt(tip) * tip / 3, 1)[0]
    return unit * low ** 2


def bending(ratio, wanted):
    tip, root, _ = ends(ratio)
    speed = sqrt(E * THICKNESS ** 2 / (12 * RHO)) / root  # b^4 = (omega/speed)^2

    def condition(b):
        """Returns the determinant of the four end conditions. With z = 2 b sqrt(s), w ~ Z1(z)/z. Every derivative is a
        function of the next order: d/ds Zn/z^n ~ Zn+1/z^(n+1)."""
        rows = []
        for Z, sign in ((besselj, -1), (bessely, -1), (besseli, 1), (besselk, -1)):
            row = [
                sign ** k * Z(k + 1, 2 * b * sqrt(s)) / sqrt(s) ** (k + 1)
                for k, s in ((0, root), (1, root), (2, tip), (3, tip))
            ]
            scale = max(abs(value) for value in row)
            rows.append([value / scale for value in row])
        return det(matrix(rows))

    return [
        speed * b ** 2 / (2 * pi) for b in first_roots(condition,
                                                       mpf(1) / 2 / sqrt(root),
                                                       mpf(1) / 4 / (sqrt(root)), wanted)
    ]


def values(given):
    at = defaults.decimals("tapered_cantilever", given)
    ratio = at["ratio"]
    if at["asked"] == "waves":
        yield "buckling_load", buckling_load(ratio), "N"
        for i, value in enumerate(bending(ratio, 2)):
            yield f"bending_{i + 1}", value, "Hz"
        return
    for row, (name, unit) in enumerate(NAMES):
        if at["shear"] == 1 and name == "deflection_y":
            continue
        yield name, displacement(at["section"], ratio, at["shear"] == 1, row), unit


POINTS = ("", "ratio=0.25", "ratio=2", "shear=1", "section=i", "section=channel", "section=zed",
          "asked=waves", "asked=waves;ratio=0.25", "asked=waves;ratio=2")


def rows():
    for at in POINTS:
        for quantity, value, unit in values(dict(
                item.split("=") for item in at.split(";") if item)):
            yield "tapered_cantilever", at, quantity, value, unit
