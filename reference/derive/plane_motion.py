"""Rods moving in their plane: the thrown rod and the pendulum. The values are exact to the digits on which two meshes
agree.

The model is the Simo-Reissner beam with the fields x, y and the rotation t of the section. The strains are (cos t x' +
sin t y' - 1, -sin t x' + cos t y', t'), the forces are EA, GA, EI times these strains, the mass is rho A and the
rotary inertia is rho I. In each element, the fields are polynomials defined by their values at the Lobatto points.
Lobatto quadrature makes the mass matrix diagonal. Time integration uses the explicit Runge-Kutta method of order 8 by
Dormand and Prince, with steps limited by wave propagation.
"""
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.polynomial import legendre
from scipy.integrate import solve_ivp

ANY = "integrator=*;step=*;tolerance=*"
MESHES = ((8, 10), (6, 10))  # number of elements, degree
FLIGHT_TIMES, SWING_TIMES = ("1", "2.5"), ("0.25", )
LEAST = 1e-9  # smallest uncertainty [m]


@dataclass(frozen=True)
class Rod:
    """A rod from (x0, y0) in the direction (cos, sin) of an angle, with stiffnesses [N, N, N m^2], mass [kg/m] and rotary
    inertia [kg m]."""
    start: tuple
    angle: float
    length: float
    EA: float
    GA: float
    EI: float
    mass: float
    rotary: float


def lobatto(degree):
    """Returns Lobatto points and weights on [-1, 1], and the derivatives at these points of the Lagrange polynomials."""
    p = legendre.Legendre.basis(degree)
    x = np.concatenate([[-1.0], np.sort(p.deriv().roots().real), [1.0]])
    D = np.zeros((degree + 1, degree + 1))
    for i in range(degree + 1):
        for j in range(degree + 1):
            if i != j:
                D[i, j] = p(x[i]) / p(x[j]) / (x[i] - x[j])
    D[0, 0], D[-1, -1] = -degree * (degree + 1) / 4, degree * (degree + 1) / 4
    return x, 2 / (degree * (degree + 1) * p(x)**2), D


class Mesh:
    """A rod divided into elements. G [points, nodes] maps nodal values to derivatives at the Lobatto points of all
    elements, and V [points, nodes] maps them to values there. `weight` [points] are the weights of the quadrature [m],
    `lumped` [nodes] are the lengths that belong to the nodes [m], and S [nodes] are the positions of the nodes [m]."""

    def __init__(self, rod, elements, degree):
        x, w, D = lobatto(degree)
        half, nodes = rod.length / elements / 2, elements * degree + 1
        self.G, self.V = np.zeros((2, elements * (degree + 1), nodes))
        self.weight = np.tile(w * half, elements)
        self.S = np.zeros(nodes)
        for e in range(elements):
            rows, columns = slice(e * (degree + 1), (e + 1) * (degree + 1)), slice(
                e * degree, e * degree + degree + 1)
            self.G[rows, columns], self.V[rows, columns] = D / half, np.eye(degree + 1)
            self.S[columns] = 2 * e * half + (x + 1) * half
        self.lumped = self.V.T @ self.weight


def forces(rod, mesh, q):
    """Returns the nodal forces [3, nodes] due to the strains. q [3, nodes] contains x, y and the rotation from the x
    axis."""
    (dx, dy, curvature), turn = q @ mesh.G.T, mesh.V @ q[2]
    c, s = np.cos(turn), np.sin(turn)
    stretch, shear = c * dx + s * dy - 1, c * dy - s * dx
    N, Q, M = rod.EA * stretch, rod.GA * shear, rod.EI * curvature
    along = np.stack([c * N - s * Q, s * N + c * Q, M]) * mesh.weight
    across = (N * shear - Q * (1 + stretch)) * mesh.weight
    out = along @ mesh.G
    out[2] += across @ mesh.V
    return -out


def move(rod, mesh, load, held, times):
    """Returns (q, v) at the times, both [times, 3, nodes]. load(t, out) adds forces to out[3, nodes]."""
    n = len(mesh.S)
    q = np.stack([
        rod.start[0] + mesh.S * np.cos(rod.angle), rod.start[1] + mesh.S * np.sin(rod.angle),
        np.full(n, rod.angle)
    ])
    inverse = 1 / (np.array([rod.mass, rod.mass, rod.rotary])[:, None] * mesh.lumped)
    for row in held:
        inverse[row, 0] = 0

    def rate(t, y):
        force = forces(rod, mesh, y[:3 * n].reshape(3, n))
        load(t, force)
        return np.concatenate([y[3 * n:], (inverse * force).ravel()])

    found = solve_ivp(rate, (0, times[-1]), np.concatenate([q.ravel(), np.zeros(3 * n)]), "DOP853",
                      t_eval=times, rtol=1e-9, atol=1e-10)
    both = found.y.T.reshape(-1, 2, 3, n)
    return both[:, 0], both[:, 1]


def ends(moved):
    q = moved[0]
    return np.concatenate([q[:, :2, 0], q[:, :2, -1]], axis=1)


def _thrown(t, force):
    factor = 2 * np.sin(np.pi * t / 2.5)**2 if t < 2.5 else 0.0
    force[0, -1] += 8 * factor
    force[2, -1] -= 80 * factor


THROWN = Rod((0, 8), float(np.arctan2(-8, 6)), 10, 1e4, 1e4, 100, 1, 10)


@cache
def flight(times=FLIGHT_TIMES):
    fine, coarse = (ends(
        move(THROWN, Mesh(THROWN, *mesh), _thrown, (), [float(t) for t in times]))
                    for mesh in MESHES)
    return fine, np.abs(fine - coarse)


def behind_step(elements, degree):
    def step(_, force):
        force[0, -1] += 8
        force[2, -1] -= 80

    mesh = Mesh(THROWN, elements, degree)
    (q, ), (v, ) = move(THROWN, mesh, step, (), [2.5])
    energy = 8 * (q[0, -1] - 6) - 80 * (q[2, -1] - THROWN.angle)
    turning = THROWN.mass * (q[0] * v[1] - q[1] * v[0]) + THROWN.rotary * v[2]
    return energy, mesh.lumped @ turning


@cache
def swing(times=SWING_TIMES):
    radius, young, density = 0.02, 5e6, 1100
    A = np.pi * radius**2
    I = A * radius**2 / 4  # noqa: E741
    rod = Rod((0, 0), 0, 1, young * A, 0.3 * young * A, young * I, density * A, density * I)

    def run(elements, degree):
        mesh = Mesh(rod, elements, degree)

        def weight(_, force):
            force[1] -= 9.81 * rod.mass * mesh.lumped

        return ends(move(rod, mesh, weight, (0, 1), [float(t) for t in times]))

    fine, coarse = (run(*mesh) for mesh in MESHES)
    return fine, np.abs(fine - coarse)


def _rows(case, at, times, names, found):
    for time, values, apart in zip(times, *found):
        for name, value, doubt in zip(names, values, apart):
            if name:
                yield (case, f"{at}time={time};{ANY}", name, value, "m",
                       max(doubt, LEAST) / abs(value))


def rows():
    yield from _rows("free_flight_plane", "", FLIGHT_TIMES,
                     ("A_x", "A_y", "B_x", "B_y"), flight())
    yield from _rows("pendulum", "", SWING_TIMES, ("", "", "tip_x", "tip_y"), swing())
