"""Derives the modified modes of a second-order beam from the Simo-Reissner beam, and compares them with J Eq. 66 and N
Eq. 37.

usage: second_order.py      prints the comparisons, which reference/test/second_order_test.py uses

r' = R (e_x + gamma), kappa~ = R^T R', and R = exp(phi~) relative to axes in the middle of the element. If stresses are
in equilibrium to first order, the second-order strains contribute only through the weighted integrals
  e1 = int gx, e2 = L int kx, e3 = int [(L-s) ky - gz], e4 = int [s ky + gz], e5 = int [(L-s) kz + gy], e6 = int [s kz
  - gy]
over the linear solution.  All results are quadratic forms in few variables with rational coefficients. Exact
evaluation in fractions for every e_i + e_j determines these coefficients.  Series are truncated after the second
power.
"""
import itertools
from fractions import Fraction as Q

import numpy as np

L = Q(13, 10)
NAMES = ("u", "px", "yp", "yq", "zp", "zq", "Wp", "Wq")


def skew(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]], dtype=object)


def axial(M):
    return np.array([M[2, 1] - M[1, 2], M[0, 2] - M[2, 0], M[1, 0] - M[0, 1]], dtype=object) / 2


class Series:
    """A series c0 + c1 t + c2 t^2 with numbers, vectors or matrices as coefficients."""

    def __init__(self, *c):
        self.c = list(c) + [0 * c[0]] * (3 - len(c))

    def __add__(self, other):
        return Series(*[a + b for a, b in zip(self.c, other.c)])

    def __mul__(self, number):
        return Series(*[a * number for a in self.c])

    def __matmul__(self, other):
        a, b = self.c, other.c
        return Series(a[0] @ b[0], a[0] @ b[1] + a[1] @ b[0], a[0] @ b[2] + a[1] @ b[1] + a[2] @ b[0])

    def each(self, linear):
        return Series(*[linear(a) for a in self.c])

    def __getitem__(self, i):
        return self.each(lambda a: a[i])


UNIT = np.array([[Q(int(i == j)) for j in range(3)] for i in range(3)], dtype=object)


def exponential(v):
    first, second = skew(v.c[1]), skew(v.c[2])
    return Series(UNIT, first, second + first @ first / 2)


def about(axis, angle):
    v = np.array([Q(0)] * 3, dtype=object)
    v[axis] = angle
    return exponential(Series(0 * v, v))


def screw(q):
    """Returns e1 .. e6 of the screw displacement (elements/beamw/screw.h) as series in the local coordinates q of N Eqs.
    40, 42."""
    p_triad = about(1, q["yp"]) @ about(2, q["zp"])
    q_triad = about(1, q["yq"]) @ about(2, q["zq"]) @ about(0, q["px"])
    psi = (p_triad.each(np.transpose) @ q_triad).each(axial)  # the angle equals its sine to second order
    middle = p_triad @ exponential(psi * Q(1, 2))
    D = middle.each(np.transpose) @ Series(np.array([L, Q(0), Q(0)], dtype=object), np.array([q["u"], Q(0), Q(0)], dtype=object))
    turn = psi.each(skew)
    U = D + turn @ turn @ D * Q(-1, 24)
    bend = [psi[1] * (L / 2), psi[2] * (L / 2)]
    return [U[0] + Series(-L), psi[0] * L, bend[0] + U[2] * -1, bend[0] + U[2], bend[1] + U[1], bend[1] + U[1] * -1]


def jonker(q):
    """Returns e1 .. e6 of J Eq. 7, with the chord as the x axis."""
    (p, r) = about(1, q["yp"]) @ about(2, q["zp"]), about(1, q["yq"]) @ about(2, q["zq"]) @ about(0, q["px"])
    between = p.each(np.transpose) @ r
    twist = (between.each(lambda M: M[2, 1]) + between.each(lambda M: M[1, 2]) * -1) * (L / 2)
    across = [p.each(lambda M: M[0, 2]) * -L, r.each(lambda M: M[0, 2]) * L, p.each(lambda M: M[0, 1]) * L, r.each(lambda M: M[0, 1]) * -L]
    return [Series(Q(0), q["u"]), twist] + across


def newton_cotes(points=9):
    """Returns rational points in [0, 1] and weights of a quadrature that is exact for polynomials of degree points -
    1."""
    x = [Q(k, points - 1) for k in range(points)]
    rows = [[xi ** n for xi in x] + [Q(1, n + 1)] for n in range(points)]
    for i in range(points):
        pivot = next(k for k in range(i, points) if rows[k][i] != 0)
        rows[i], rows[pivot] = rows[pivot], rows[i]
        rows[i] = [v / rows[i][i] for v in rows[i]]
        for k in range(points):
            if k != i:
                rows[k] = [a - rows[k][i] * b for a, b in zip(rows[k], rows[i])]
    return list(zip(x, (row[-1] for row in rows)))


POINTS = newton_cotes()


def simo_reissner(e, hg, g, tw, c, centre=(Q(0), Q(0)), trapeze=Q(0)):
    """Returns the quadratic parts of e1bar .. e6bar for e of the screw. hg and g are the antisymmetric deformations in
    bending and in shear (y, z)."""
    ys, zs = centre
    A = (e[6] - e[7]) / 2
    mean = [e[1] / L, (e[2] + e[3]) / L, (e[4] + e[5]) / L]
    total = [Q(0)] * 6
    for x, weight in POINTS:
        turn = [mean[0] * (x - Q(1, 2)) + (A * x * (1 - x) + tw * (3 * x ** 2 - 2 * x ** 3 - x)) / L,
                mean[1] * (x - Q(1, 2)) - 6 * hg[1] * x * (1 - x), mean[2] * (x - Q(1, 2)) + 6 * hg[0] * x * (1 - x)]
        kx = (mean[0] + (A * (1 - 2 * x) + tw * (6 * x - 6 * x ** 2 - 1)) / L) / L
        rate = [kx, (mean[1] - 6 * hg[1] * (1 - 2 * x)) / L, (mean[2] + 6 * hg[0] * (1 - 2 * x)) / L]
        shear = [g[0] + zs * kx, g[1] - ys * kx]
        slope = np.array([e[0] / L, turn[2] + shear[0], -turn[1] + shear[1]], dtype=object)
        phi, dphi = skew(turn), skew(rate)
        gamma = phi @ phi @ UNIT[0] / 2 - phi @ slope
        kappa = axial((dphi @ phi - phi @ dphi) / 2)
        if c:
            gamma[0] += (trapeze + ys * ys + zs * zs) * kx * kx / 2
            kappa[1:] += np.array([-zs, ys], dtype=object) * kx * kx
        else:
            gamma[0] += (shear[0] ** 2 + shear[1] ** 2 + trapeze * kx * kx) / 2
            kappa[1:] -= np.array(shear, dtype=object) * kx
        to_q, from_p = (1 - x) * L, x * L
        parts = (gamma[0], L * kappa[0], to_q * kappa[1] - gamma[2], from_p * kappa[1] + gamma[2], to_q * kappa[2] + gamma[1],
                 from_p * kappa[2] - gamma[1])
        total = [t + weight * L * part for t, part in zip(total, parts)]
    m, share = mean, L / 24  # the part contained in the screw: -1/24 psi x (psi x U)
    return [total[0] - share * (m[1] ** 2 + m[2] ** 2), total[1], total[2] - share * m[0] * m[2], total[3] + share * m[0] * m[2],
            total[4] + share * m[0] * m[1], total[5] - share * m[0] * m[1]]


def nijenhuis(q, Phi):
    """Returns the second-order parts of the generalized strains of N Eq. 7 over N Eqs. 14-19 with Phi, and int phi_y'
    phi_z."""
    total = [Q(0)] * 7
    for x, weight in POINTS:
        fields = []
        for a, b, P in ((q["zp"], q["zq"], Phi[0]), (q["yp"], q["yq"], Phi[1])):
            lag = P / (2 + 2 * P) * (a + b)
            slope = a * (1 - 4 * x + 3 * x ** 2) + b * (3 * x ** 2 - 2 * x) - lag * (1 - 6 * x + 6 * x ** 2)
            second = a * (6 * x - 4) + b * (6 * x - 2) - lag * (12 * x - 6)
            fields.append((slope, slope + lag, second / L))
        (duy, phz, dphz), (minus_duz, phy, dphy) = fields
        duz = -minus_duz
        phx = q["px"] * x ** 2 * (3 - 2 * x) + L * q["Wp"] * x * (1 - x) ** 2 - L * q["Wq"] * x ** 2 * (1 - x)
        gx = -phy * (phy / 2 + duz) - phz * (phz / 2 - duy)
        kx, ky, kz, gy, gz = dphy * phz, dphz * phx, -dphy * phx, phx * (phy + duz), phx * (phz - duy)
        s, r = x * L, (1 - x) * L
        parts = (gx, L * kx, r * ky - gz, s * ky + gz, r * kz + gy, s * kz - gy, L * kx)
        total = [t + weight * L * part for t, part in zip(total, parts)]
    return total


def eq66(e):
    """Returns J Eq. 66 minus e, without its last term (ys = zs = 0) and without Ip/A."""
    e1, e2, e3, e4, e5, e6, e7, e8 = e
    return [(2 * e3 ** 2 + e3 * e4 + 2 * e4 ** 2 + 2 * e5 ** 2 + e5 * e6 + 2 * e6 ** 2) / (30 * L), (e4 * e5 - e3 * e6) / L,
            (e2 * e5 / 10 + e2 * e6 / 5 + e5 * e7 / 10 - e5 * e8 / 30 - e6 * e8 / 30) / L,
            (-e2 * e5 / 5 - e2 * e6 / 10 + e5 * e7 / 30 + e6 * e7 / 30 - e6 * e8 / 10) / L,
            (-e2 * e3 / 10 - e2 * e4 / 5 - e3 * e7 / 10 + e3 * e8 / 30 + e4 * e8 / 30) / L,
            (e2 * e3 / 5 + e2 * e4 / 10 - e3 * e7 / 30 - e4 * e7 / 30 + e4 * e8 / 10) / L]


def all_modes(e, hg, g, tw, c, centre, trapeze=Q(0)):
    """Returns the corrected J Eq. 66 for the strains e of J, for any shear flexibility and shear centre. c = 0 is
    Engesser's theory, as in J, and c = 1 is Haringx's theory (Simo-Reissner)."""
    ys, zs = centre
    e1, e2, e3, e4, e5, e6, e7, e8 = e
    A = (e7 - e8) / 2
    Vs, Vt = -(e5 + e6) / 2 + zs / L * A, -L * hg[0] - zs / L * tw
    Ws, Wt = (e3 + e4) / 2 - ys / L * A, -L * hg[1] + ys / L * tw
    ap, bp, aq, bq = -e2 / 3 - A / 6 + tw / 30, (tw - A) / 10, -e2 / 3 + A / 6 + tw / 30, -(tw + A) / 10
    half = (e2 / 2 + A / 6, e2 / 2 - A / 6)
    return [(Vs ** 2 + Ws ** 2) / (6 * L) + (Vt ** 2 + Wt ** 2) / (10 * L) + trapeze / (2 * L ** 3) * (e2 ** 2 + A ** 2 / 3 + tw ** 2 / 5)
            - c * (L * (g[0] ** 2 + g[1] ** 2) / 2 + (zs * g[0] - ys * g[1]) * e2 / L),
            (e3 + e4) * hg[0] + (e5 + e6) * hg[1],
            (Vs * ap + Vt * bp) / L + c * g[0] * half[0], -(Vs * aq + Vt * bq) / L + c * g[0] * half[1],
            (Ws * ap + Wt * bp) / L + c * g[1] * half[0], -(Ws * aq + Wt * bq) / L + c * g[1] * half[1]]


def directions(names=NAMES):
    """Yields every e_i and e_i + e_j, with factors other than one."""
    size = dict(zip(NAMES, (Q(3, 7), Q(5, 3), Q(-7, 5), Q(2, 11), Q(9, 4), Q(-4, 9), Q(6, 13), Q(11, 6))))
    for pair in itertools.combinations_with_replacement(names, 2):
        yield {n: size[n] if n in pair else Q(0) for n in NAMES}


def linear(coordinates):
    return [s.c[1] for s in coordinates]


def strains(q):
    return linear(screw(q)) + [L * L * q["Wp"], L * L * q["Wq"]]


def against_sheet():
    """Returns the differences of e1 .. e6 of N with shear from the strains derived in this script for u = 0, and
    the differences with u, which are due to the factor l/l0 in the shear strain."""
    Phi = (Q(7, 5), Q(3, 8))
    inner, outer = [], []
    for q in directions():
        e = strains(q)
        h = [(e[4] - e[5]) / (2 * L), (e[3] - e[2]) / (2 * L)]
        hg = [a / (1 + P) for a, P in zip(h, Phi)]
        ours = simo_reissner(e, hg, [a - b for a, b in zip(h, hg)], e[1] - (e[6] + e[7]) / 2, 1)
        theirs = nijenhuis(q, Phi)
        gap = [s.c[2] + o - n for s, o, n in zip(screw(q), ours, theirs)]
        (inner if q["u"] == 0 else outer).append((q, gap, [q["u"] * (a - b) for a, b in zip(h, hg)]))
    # the shear strains derived in this script have the factor 1 + u/L, unlike those of N
    stretched = [[x - y for x, y in zip(gap, (0, 0, -g[1], g[1], g[0], -g[0]))] for _, gap, g in outer]
    return [gap for _, gap, _ in inner], stretched


def against_eq66():
    gaps = []
    for q, c in itertools.product(directions(), (0, 1)):
        e = strains(q)
        h = [(e[4] - e[5]) / (2 * L), (e[3] - e[2]) / (2 * L)]
        ours = simo_reissner(e, h, [Q(0), Q(0)], e[1] - (e[6] + e[7]) / 2, c)
        gaps.append([s.c[2] + o - j.c[2] - p for s, o, j, p in zip(screw(q), ours, jonker(q), eq66(e))])
    return gaps


def against_all_modes():
    """Returns the differences from all_modes for arbitrary shear, shear centre and trapeze term. hg, g and tw are varied
    as independent variables."""
    centre, trapeze, gaps = (Q(2, 7), Q(-5, 9)), Q(4, 17), []
    extra = (("hy", Q(3, 5)), ("hz", Q(-2, 3)), ("gy", Q(5, 8)), ("gz", Q(-7, 9)), ("tw", Q(8, 5)))
    for pair, c in itertools.product(itertools.combinations_with_replacement(("px", "bend_y", "bend_z", "Wp", "Wq") + tuple(n for n, _ in extra), 2), (0, 1)):
        on = {n: Q(int(n in pair)) for n in ("px", "bend_y", "bend_z", "Wp", "Wq")}
        value = {n: v if n in pair else Q(0) for n, v in extra}
        e2 = on["px"] * Q(5, 3)
        # hg and g determine the antisymmetric bending: e5 - e6 = 2 L (hg_y + g_y) + 2 zs e2/L, and similarly for z
        dz = 2 * L * (value["hy"] + value["gy"]) + 2 * centre[1] * e2 / L
        dy = 2 * L * (value["hz"] + value["gz"]) - 2 * centre[0] * e2 / L
        sy, sz = on["bend_y"] * Q(7, 4), on["bend_z"] * Q(-3, 5)
        e = [Q(0), e2, (sy - dy) / 2, (sy + dy) / 2, (sz + dz) / 2, (sz - dz) / 2, on["Wp"] * Q(6, 7), on["Wq"] * Q(9, 8)]
        q = dict(zip(NAMES, (Q(0), e2 / L, -e[2] / L, e[3] / L, -e[4] / L, e[5] / L)))
        given = (e, (value["hy"], value["hz"]), (value["gy"], value["gz"]), value["tw"], c, centre, trapeze)
        gaps.append([s.c[2] + o - j.c[2] - p for s, o, j, p in zip(screw(q), simo_reissner(*given), jonker(q), all_modes(*given))])
    return gaps


def largest(gaps):
    return max(abs(v) for gap in gaps for v in gap)


def warping_of_sheet():
    """Returns the largest int phi_y' phi_z of N, the term of e7 and e8 in addition to L^2 Wp and L^2 Wq."""
    return max(abs(nijenhuis(q, (Q(7, 5), Q(3, 8)))[6]) for q in directions())


if __name__ == "__main__":
    same, stretched = against_sheet()
    print("largest difference, exact:")
    print(f"  to the sheet element consistent with shear, u of second order: {largest(same)}; with u: {largest(stretched)} after the factor 1 + u/L")
    print(f"  to J Eq. 66, Phi = 0, ys = zs = 0, either theory: {largest(against_eq66())}")
    print(f"  to J Eq. 66 repaired, any Phi, shear centre and theory: {largest(against_all_modes())}")
    print(f"  N's e7 and e8 less L^2 W: {float(warping_of_sheet()):.3f}")
