"""The rod that is thrown in space and flies freely: confirms values that other programs gave.

Intrinsic equations (D.H. Hodges, Journal of Guidance, Control and Dynamics 26 (2003) 131): unknown
are velocities v, w and strains g, k in axes of the section, no displacement and no rotation; with
t the tangent at rest, e = t + g, F and M the forces of the strains,
  m v' + w x m v = F_s + k x F,  J w' + w x J w = M_s + k x M + e x F,
  g' = v_s + k x v + e x w,      k' = w_s + k x w.
Section axes are those of space at rest.  Velocities are polynomials in Lobatto's points, whose
quadrature makes the mass diagonal, strains are values in Gauss's points, one fewer: products that
cancel in the power cancel in each point, so that the energy of the rod changes by the loads' work
alone.  Places and quaternions of nodes follow by integration in time.  Time: the explicit
Runge-Kutta method of order 8 by Dormand and Prince, begun anew at kinks of the load.
"""
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.polynomial import legendre
from scipy.integrate import solve_ivp

from reference.derive.plane_motion import ANY, LEAST, lobatto

KIND = "consensus"  # of the stored rows that these are held against
MESHES = ((10, 10), (8, 8))  # elements, degree
TIMES = ("1", "2", "2.5", "4", "5", "7", "7.5", "9", "10")
KINKS = (2.5, 5.0)  # [s] of the load


@dataclass(frozen=True)
class Rod:
    """From start along reach; EA = GA = force, EI = GJ = moment; mass [kg/m], inertia about an
    axis across and along [kg m]."""
    start: tuple
    reach: tuple
    force: float
    moment: float
    mass: float
    rotary: float
    polar: float


THROWN = Rod((0, 0, 8), (6, 0, -8), 1e4, 500, 1, 10, 20)


def cross(a, b):
    """Of [3, n] and [3, n] or [3, 1]."""
    return np.stack([
        a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
    ])


def turned(q, v):
    """v [3, n] by the quaternions q [4, n] from axes of the section to those of space."""
    along = 2 * cross(q[1:], v)
    return v + q[0] * along + cross(q[1:], along)


def _between(x, points):
    """Values at points, from values at x, of the polynomials through them; derivatives likewise."""
    V = legendre.legvander(x, len(x) - 1)
    to = np.linalg.inv(V)
    basis = map(legendre.Legendre.basis, range(len(x)))
    slopes = np.stack([p.deriv()(points) for p in basis], axis=1)
    return legendre.legvander(points, len(x) - 1) @ to, slopes @ to


class Mesh:
    """Rod in elements: U [6, nodes] are velocities, S [6, points] strains."""

    def __init__(self, rod, elements, degree):
        self.rod, length = rod, float(np.linalg.norm(rod.reach))
        x, w, _ = lobatto(degree)
        gauss, weight = legendre.leggauss(degree)
        at, slope = _between(x, gauss)
        half, self.points = length / elements / 2, elements * degree
        self.nodes = self.points + 1
        G, V = np.zeros((2, self.points, self.nodes))
        self.lumped = np.zeros(self.nodes)
        for e in range(elements):
            rows, columns = slice(e * degree, (e + 1) * degree), slice(
                e * degree, e * degree + degree + 1)
            G[rows, columns], V[rows, columns] = slope / half, at
            self.lumped[columns] += w * half
        self.weight = np.tile(weight * half, elements)
        self.up = np.concatenate([G, V]).T.copy()
        self.down = np.concatenate([G, V]) * np.tile(self.weight, 2)[:, None]
        self.tangent = np.array(rod.reach)[:, None] / length
        t = self.tangent[:, 0]
        self.inertia = rod.rotary * np.eye(3) + (rod.polar - rod.rotary) * np.outer(t, t)
        self.flexible = np.linalg.inv(self.inertia)

    def forces(self, S):
        return np.concatenate([self.rod.force * S[:3], self.rod.moment * S[3:]])

    def rates(self, U, S, load):
        """(U', S'); load [6, nodes] in axes of the sections."""
        both = U @ self.up
        rate, here = both[:, :self.points], both[:, self.points:]
        e, k, N = self.tangent + S[:3], S[3:], self.forces(S)
        strain = rate + np.concatenate(
            [cross(k, here[:3]) + cross(e, here[3:]),
             cross(k, here[3:])])
        across = np.concatenate([cross(k, N[:3]), cross(k, N[3:]) + cross(e, N[:3])])
        force = (np.concatenate([-N, across], axis=1) @ self.down + load) / self.lumped
        v, w = U[:3], U[3:]
        return np.concatenate([
            force[:3] / self.rod.mass - cross(w, v),
            self.flexible @ (force[3:] - cross(w, self.inertia @ w))
        ]), strain

    def energy(self, U, S):
        """Kinetic and elastic [J]."""
        moving = self.rod.mass * (U[:3]**2).sum(0) + (U[3:] * (self.inertia @ U[3:])).sum(0)
        return (self.lumped @ moving + self.weight @ (S * self.forces(S)).sum(0)) / 2


def load(t):
    """(force [N], moment [N m]) at the end of the thrown rod, in axes of space."""
    factor = 80 * t if t < KINKS[0] else max(400 - 80 * t, 0.0)
    return factor * np.array([0.1, 0, 0]), factor * np.array([0, 1, 0.5])


def move(mesh, times, method="DOP853", tolerance=1e-9):
    """At each time (U, S, r, q): r [3, 2] and q [4, 2] of the first and the last node."""
    n, m, ends = mesh.nodes, mesh.points, [0, -1]
    sizes = np.cumsum([6 * n, 6 * m, 6])

    def parts(y):
        U, S, r, q = np.split(y, sizes)
        return U.reshape(6, n), S.reshape(6, m), r.reshape(3, 2), q.reshape(4, 2)

    def rate(t, y):
        U, S, _, q = parts(y)
        q = q / np.sqrt((q**2).sum(0))
        back = q[:, 1:] * [[1], [-1], [-1], [-1]]
        loads, w = np.zeros_like(U), U[3:, ends]
        loads[:, -1] = np.concatenate([turned(back, f[:, None])[:, 0] for f in load(t)])
        turning = np.concatenate([-(q[1:] * w).sum(0)[None], q[0] * w + cross(q[1:], w)]) / 2
        return np.concatenate(
            [f.ravel() for f in (*mesh.rates(U, S, loads), turned(q, U[:3, ends]), turning)])

    start, reach = (np.array(v, float) for v in (mesh.rod.start, mesh.rod.reach))
    place, turn = np.stack([start, start + reach], axis=1), np.array([[1., 1], *[[0, 0]] * 3])
    y, begin, found = np.concatenate([np.zeros(sizes[1]), place.ravel(), turn.ravel()]), 0.0, {}
    for stop in sorted({*times, *(t for t in KINKS if t < max(times))}):
        y = solve_ivp(rate, (begin, stop), y, method, rtol=tolerance, atol=tolerance / 10).y[:, -1]
        begin, found[stop] = stop, parts(y)
    return [found[t] for t in times]


@cache
def flight(elements, degree, times=TIMES):
    """(A_x, A_y, A_z, B_x, B_y, B_z, energy) at each time."""
    mesh = Mesh(THROWN, elements, degree)
    return np.array([[*r.T.ravel(), mesh.energy(U, S)]
                     for U, S, r, _ in move(mesh, [float(t) for t in times])])


def rows():
    fine, coarse = (flight(*mesh) for mesh in MESHES)
    for time, values, apart in zip(TIMES, fine, np.abs(fine - coarse)):
        for name, value, doubt in zip(("A_x", "A_y", "A_z", "B_x", "B_y", "B_z", "energy"), values,
                                      apart):
            if name != "energy" or float(time) >= KINKS[1]:
                unit = "J" if name == "energy" else "m"
                yield ("free_flight_space", f"time={time};{ANY}", name, value, unit,
                       max(doubt, LEAST) / abs(value))
