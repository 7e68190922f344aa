"""Computes the constants of an open thin-walled section from its mid-line, in extended precision.

Straight walls (i, j, t) between points (y, z) form a tree. The resulting axes are centroidal and principal. The shear
flexibilities times G are computed from the shear flow: F_ij = 1/(I_i I_j) sum int S_i S_j/t ds with I = (Iz, Iy, Iw) (J
Eq. 27), where S are the first moments of y, z, omega.
"""
from mpmath import mp, mpf, matrix, atan2, cos, sin, sqrt


class Section:
    pass


def _integrate(f):
    a = sqrt(mpf(3) / 5) / 2
    return (5 * f(mpf(1) / 2 - a) + 8 * f(mpf(1) / 2) + 5 * f(mpf(1) / 2 + a)) / 18


def _leaf_first(walls, points):
    """Returns the walls, each as (outer point, inner point, thickness), ordered from the free ends to the root."""
    left, order = list(walls), []
    degree = [sum(p in w[:2] for w in walls) for p in range(points)]
    while left:
        for w in left:
            ends = [e for e in w[:2] if degree[e] == 1]
            if ends:
                outer = ends[0]
                inner = w[1] if w[0] == outer else w[0]
                order.append((outer, inner, w[2]))
                degree[outer] -= 1
                degree[inner] -= 1
                left.remove(w)
                break
        else:
            raise ValueError("the walls close a cell")
    return order


def section(points, walls):
    p = [(mpf(y), mpf(z)) for y, z in points]
    w = [(i, j, mpf(t)) for i, j, t in walls]
    length = [sqrt((p[j][0] - p[i][0]) ** 2 + (p[j][1] - p[i][1]) ** 2) for i, j, _ in w]

    def area_integral(f):
        return sum(t * l * _integrate(lambda s: f(i, j, s)) for (i, j, t), l in zip(w, length))

    def at(values, i, j, s):
        return values[i] * (1 - s) + values[j] * s

    out = Section()
    out.A = sum(t * l for (_, _, t), l in zip(w, length))
    yc = area_integral(lambda i, j, s: at([q[0] for q in p], i, j, s)) / out.A
    zc = area_integral(lambda i, j, s: at([q[1] for q in p], i, j, s)) / out.A
    y = [q[0] - yc for q in p]
    z = [q[1] - zc for q in p]
    iyy = area_integral(lambda i, j, s: at(z, i, j, s) ** 2)
    izz = area_integral(lambda i, j, s: at(y, i, j, s) ** 2)
    iyz = area_integral(lambda i, j, s: at(y, i, j, s) * at(z, i, j, s))
    beta = atan2(2 * iyz, izz - iyy) / 2 if abs(iyz) > mp.eps * (iyy + izz) else mpf(0)
    y, z = ([cos(beta) * a + sin(beta) * b
             for a, b in zip(y, z)], [-sin(beta) * a + cos(beta) * b for a, b in zip(y, z)])
    out.beta, out.points = beta, list(zip(y, z))
    out.Iy = area_integral(lambda i, j, s: at(z, i, j, s) ** 2)
    out.Iz = area_integral(lambda i, j, s: at(y, i, j, s) ** 2)
    out.Ip = out.Iy + out.Iz
    out.It = sum(l * t ** 3 for (_, _, t), l in zip(w, length)) / 3

    order = _leaf_first(w, len(p))

    def sectorial(y0, z0):
        omega = [None] * len(p)
        omega[order[-1][1]] = mpf(0)
        for outer, inner, _ in reversed(order):
            a, b = (y[inner] - y0, z[inner] - z0), (y[outer] - y0, z[outer] - z0)
            omega[outer] = omega[inner] + a[0] * b[1] - a[1] * b[0]
        mean = area_integral(lambda i, j, s: at(omega, i, j, s)) / out.A
        return [o - mean for o in omega]

    omega = sectorial(mpf(0), mpf(0))
    out.ys = area_integral(lambda i, j, s: at(omega, i, j, s) * at(z, i, j, s)) / out.Iy
    out.zs = -area_integral(lambda i, j, s: at(omega, i, j, s) * at(y, i, j, s)) / out.Iz
    omega = sectorial(out.ys, out.zs)
    out.Iw = area_integral(lambda i, j, s: at(omega, i, j, s) ** 2)
    if out.Iw < mpf(10) ** -25 * out.Iy * out.Iz / out.A:  # true if all walls meet in one point
        out.Iw = mpf(0)
    out.wagner_y = area_integral(lambda i, j, s: at(y, i, j, s) *
                                 (at(y, i, j, s) ** 2 + at(z, i, j, s) ** 2))
    out.wagner_z = area_integral(lambda i, j, s: at(z, i, j, s) *
                                 (at(y, i, j, s) ** 2 + at(z, i, j, s) ** 2))
    # energy E c kx^4 per length due to twist with free shortening and bending; the elongation of a fibre is r^2 kx^2/2
    quartic = area_integral(lambda i, j, s: (at(y, i, j, s) ** 2 + at(z, i, j, s) ** 2) ** 2)
    out.wagner_torque = (quartic - out.Ip ** 2 / out.A - out.wagner_y ** 2 / out.Iz -
                         out.wagner_z ** 2 / out.Iy) / 8

    field, inertia = (y, z, omega), (out.Iz, out.Iy, out.Iw)
    carried = [[mpf(0)] * 3 for _ in p]
    out.F = matrix(3, 3)
    warps = 3 if out.Iw else 2
    for outer, inner, t in order:
        l = sqrt((y[inner] - y[outer]) ** 2 + (z[inner] - z[outer]) ** 2)
        start = [carried[outer][k] for k in range(3)]

        def moment(k, s):
            return start[k] + t * l * s * (field[k][outer] * (1 - s / 2) + field[k][inner] * s / 2)

        for a in range(warps):
            for b in range(warps):
                out.F[a, b] += _integrate(lambda s: moment(a, s) * moment(b, s)) * l / t / (
                    inertia[a] * inertia[b])
        for k in range(3):
            carried[inner][k] += moment(k, mpf(1))
    return out


def channel(height, width, flange, web):
    """Returns the Section of a channel given by centre-line dimensions, with its web on the +y side."""
    h, b = mpf(height), mpf(width)
    points = [(0, -h / 2), (b, -h / 2), (b, h / 2), (0, h / 2)]
    return section(points, [(0, 1, flange), (1, 2, web), (2, 3, flange)])
