"""Rods moving in space, the thrown rod and the elbow. The program confirms values of other programs.

The intrinsic equations (D.H. Hodges, Journal of Guidance, Control and Dynamics 26 (2003) 131) have the velocities v, w
and the strains g, k in the axes of the section as unknowns, without displacements or rotations. With the tangent t at
rest, e = t + g, and the forces F and moments M of the strains, the equations are
  m v' + w x m v = F_s + k x F,  J w' + w x J w = M_s + k x M + e x F,
  g' = v_s + k x v + e x w,      k' = w_s + k x w.
At rest, the section axes are the space axes. In each element, velocities are polynomials defined by their values at the
Lobatto points. Lobatto quadrature makes the mass matrix diagonal. Strains are defined by their values at the Gauss
points, one fewer. Terms whose contributions to the power cancel in the equations also cancel at each Gauss point, so
the energy of the rod changes only by the work of the loads. The positions and quaternions of the start and of the ends
of the legs are integrated in time. The time integration uses the explicit Runge-Kutta method of order 8 by Dormand and
Prince, restarted at slope discontinuities of the load.
"""
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.polynomial import legendre
from scipy.integrate import solve_ivp

from reference.derive.plane_motion import ANY, LEAST, lobatto

KIND = "consensus"  # kind of the stored rows with which these values are compared
MESHES = ((10, 10), (8, 8))  # number of elements of a leg, degree
TIMES = ("1", "2", "2.5", "4", "5", "7", "7.5", "9", "10")
ELBOW_MESHES = ((4, 10), (3, 8))
ELBOW_TIMES = ("1", "2")  # only the first of the stored times, because fast axial waves in the elbow require small steps


@dataclass(frozen=True)
class Rod:
    """A rod from `start` along legs of equal length, with EA = GA = `force` [N] and EI = GJ = `moment` [N m^2]. `mass` is
    in [kg/m]. `rotary` and `polar` are the rotary inertia about axes across and along the rod [kg m]. load(t) returns
    the force and the moment, in space axes, at the end of the leg with the index `loaded`. Their slopes are
    discontinuous at the times `kinks`."""
    start: tuple
    legs: tuple
    force: float
    moment: float
    mass: float
    rotary: float
    polar: float
    held: bool  # True if the start is fixed
    loaded: int
    load: Callable
    kinks: tuple


def _triangle(slope, peak):
    return lambda t: slope * max(peak - abs(t - peak), 0.0)


def _thrown(t):
    factor = _triangle(80, 2.5)(t)
    return factor * np.array([0.1, 0, 0]), factor * np.array([0, 1, 0.5])


def _pushed(t):
    return np.array([0, 0, _triangle(50, 1)(t)]), np.zeros(3)


THROWN = Rod((0, 0, 8), ((6, 0, -8), ), 1e4, 500, 1, 10, 20, False, 0, _thrown, (2.5, 5.0))
ELBOW = Rod((0, 0, 0), ((10, 0, 0), (0, 10, 0)), 1e6, 1e3, 1, 10, 20, True, 0, _pushed, (1.0, 2.0))


def cross(a, b):
    return np.stack([
        a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
    ])


def turned(q, v):
    along = 2 * cross(q[1:], v)
    return v + q[0] * along + cross(q[1:], along)


def _between(x, points):
    """Returns the matrices that map values at x to values, and to derivatives, of their interpolating polynomials at
    points."""
    V = legendre.legvander(x, len(x) - 1)
    to = np.linalg.inv(V)
    basis = map(legendre.Legendre.basis, range(len(x)))
    slopes = np.stack([p.deriv()(points) for p in basis], axis=1)
    return legendre.legvander(points, len(x) - 1) @ to, slopes @ to


def _each(tensors, vectors):
    return (tensors @ vectors.T[:, :, None])[:, :, 0].T


class Mesh:
    """A rod with elements on each leg. U [6, nodes] are velocities, and S [6, points] are strains."""

    def __init__(self, rod, elements, degree):
        self.rod, legs = rod, np.array(rod.legs, float)
        lengths = np.linalg.norm(legs, axis=1)
        x, w, _ = lobatto(degree)
        gauss, weight = legendre.leggauss(degree)
        at, slope = _between(x, gauss)
        half, self.points = lengths[0] / elements / 2, len(legs) * elements * degree
        self.nodes = self.points + 1
        self.ends = np.arange(len(legs) + 1) * elements * degree
        self.tangent = np.repeat((legs / lengths[:, None]).T, elements * degree, axis=1)
        G, V = np.zeros((2, self.points, self.nodes))
        self.lumped, self.inertia = np.zeros(self.nodes), np.zeros((self.nodes, 3, 3))
        for first in range(0, self.points, degree):
            rows, columns = slice(first, first + degree), slice(first, first + degree + 1)
            G[rows, columns], V[rows, columns] = slope / half, at
            t, share = self.tangent[:, first], w * half
            self.lumped[columns] += share
            self.inertia[columns] += share[:, None, None] * (
                rod.rotary * np.eye(3) + (rod.polar - rod.rotary) * np.outer(t, t))
        self.weight = np.tile(weight * half, self.points // degree)
        self.up = np.concatenate([G, V]).T.copy()
        self.down = np.concatenate([G, V]) * np.tile(self.weight, 2)[:, None]
        self.flexible = np.linalg.inv(self.inertia)

    def forces(self, S):
        return np.concatenate([self.rod.force * S[:3], self.rod.moment * S[3:]])

    def rates(self, U, S, load):
        """Returns (U', S'). `load` [6, nodes] is in section axes."""
        both = U @ self.up
        rate, here = both[:, :self.points], both[:, self.points:]
        e, k, N = self.tangent + S[:3], S[3:], self.forces(S)
        strain = rate + np.concatenate(
            [cross(k, here[:3]) + cross(e, here[3:]),
             cross(k, here[3:])])
        across = np.concatenate([cross(k, N[:3]), cross(k, N[3:]) + cross(e, N[:3])])
        force = np.concatenate([-N, across], axis=1) @ self.down + load
        v, w = U[:3], U[3:]
        moment = force[3:] - cross(w, _each(self.inertia, w))
        rate = np.concatenate([
            force[:3] / (self.rod.mass * self.lumped) - cross(w, v),
            _each(self.flexible, moment)
        ])
        if self.rod.held:
            rate[:, 0] = 0
        return rate, strain

    def energy(self, U, S):
        moving = self.rod.mass * self.lumped @ (U[:3]**2).sum(0)
        turning = (U[3:] * _each(self.inertia, U[3:])).sum()
        return (moving + turning + self.weight @ (S * self.forces(S)).sum(0)) / 2


def move(mesh, times, method="DOP853", tolerance=1e-9):
    """Returns (U, S, r, q) at each time, where r [3, ends] and q [4, ends] belong to the start and the ends of legs."""
    n, m, ends, rod = mesh.nodes, mesh.points, mesh.ends, mesh.rod
    sizes = np.cumsum([6 * n, 6 * m, 3 * len(ends)])

    def parts(y):
        U, S, r, q = np.split(y, sizes)
        return U.reshape(6, n), S.reshape(6, m), r.reshape(3, -1), q.reshape(4, -1)

    def rate(t, y):
        U, S, _, q = parts(y)
        q = q / np.sqrt((q**2).sum(0))
        back = q[:, [rod.loaded + 1]] * [[1], [-1], [-1], [-1]]
        loads, w = np.zeros_like(U), U[3:, ends]
        loads[:, ends[rod.loaded + 1]] = np.concatenate(
            [turned(back, f[:, None])[:, 0] for f in rod.load(t)])
        turning = np.concatenate([-(q[1:] * w).sum(0)[None], q[0] * w + cross(q[1:], w)]) / 2
        return np.concatenate(
            [f.ravel() for f in (*mesh.rates(U, S, loads), turned(q, U[:3, ends]), turning)])

    place = np.cumsum([rod.start, *rod.legs], axis=0, dtype=float).T
    turn = np.eye(4, 1) * np.ones(len(ends))
    y, begin, found = np.concatenate([np.zeros(sizes[1]), place.ravel(), turn.ravel()]), 0.0, {}
    for stop in sorted({*times, *(t for t in rod.kinks if t < max(times))}):
        y = solve_ivp(rate, (begin, stop), y, method, rtol=tolerance, atol=tolerance / 10).y[:, -1]
        begin, found[stop] = stop, parts(y)
    return [found[t] for t in times]


def run(rod, elements, degree, times):
    """Returns the positions x, y, z of the start and of the ends of the legs, and the energy, at each time."""
    mesh = Mesh(rod, elements, degree)
    return np.array([[*r.T.ravel(), mesh.energy(U, S)]
                     for U, S, r, _ in move(mesh, [float(t) for t in times])])


@cache
def flight(elements, degree, times=TIMES):
    """Returns (A_x, A_y, A_z, B_x, B_y, B_z, energy) at each time."""
    return run(THROWN, elements, degree, times)


@cache
def elbow(elements, degree, times=ELBOW_TIMES):
    """Returns (elbow_x, elbow_y, elbow_z, tip_x, tip_y, tip_z, energy) at each time."""
    return run(ELBOW, elements, degree, times)[:, 3:]


def _rows(case, times, nodes, fine, coarse, kept):
    names = [f"{node}_{axis}" for node in nodes for axis in "xyz"] + ["energy"]
    for time, values, apart in zip(times, fine, np.abs(fine - coarse)):
        for name, value, doubt in zip(names, values, apart):
            if name != "energy" or kept(float(time)):
                yield (case, f"time={time};{ANY}", name, value, "J" if name == "energy" else "m",
                       max(doubt, LEAST) / abs(value))


def rows():
    yield from _rows("free_flight_space", TIMES, "AB", *(flight(*mesh) for mesh in MESHES),
                     lambda time: time >= THROWN.kinks[1])
    yield from _rows("elbow", ELBOW_TIMES, ("elbow", "tip"),
                     *(elbow(*mesh) for mesh in ELBOW_MESHES), lambda time: False)
