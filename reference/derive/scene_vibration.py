"""Frequencies of a scene about its undeformed state: L z = omega^2 M z of the bodies and of all members at their Chebyshev points.

Fields of a member are those of equilibrium.Vibration, z = (dy, dp); its inertia rho A, rho (Ip, Iy, Iz), rho Iw, of which Iy, Iz and Iw count
with `rotary_inertia`.  Of a body: external load, those of the members' ends and omega^2 (m (u + theta x c), J theta) are in equilibrium.
"""
import math

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import LinearOperator, eigs, splu

from reference.derive.beam import cross_matrix
from reference.derive.equilibrium import Vibration, turn_of
from reference.derive.network import BODY
from reference.derive.scene_section import constants_of
from reference.derive.scene_text import Refused, number, numbers


def inertia_of(scene, name):
    """(rho A, diag rho (Ip, Iy, Iz), rho Iw) of a member in the network's units."""
    section, where = scene.section_of(scene.scene["members"][name])
    s, rho = constants_of(section, where), number(section.get("density", "0"), where) / scene.force
    rotary = float("rotary_inertia" in scene.physics)
    return rho * s.A * scene.length ** 2, rho * np.array(
        [s.Ip, rotary * s.Iy, rotary * s.Iz]), rotary * ("warping" in scene.physics) * rho * s.Iw / scene.length ** 2


def body_masses(scene, size):
    """-M of the bodies, on their rows of equilibrium: of nodes that have a mass, about the origin."""
    out = np.zeros((size, size))
    for name, entry in scene.scene["nodes"].items():
        m = number(entry.get("mass", "0"), name) * scene.length / scene.force
        J = np.array(numbers(entry.get("inertia", ["0"] * 6), name,
                             6)) / (scene.force * scene.length)
        if m == 0 and not np.any(J):
            continue
        place = scene.places[name]
        c = (place.offset +
             np.array(numbers(entry.get("centre", ["0"] * 3), name, 3))) / scene.length
        at, x = place.body.at, cross_matrix(place.body.x + c)
        tensor = np.array([[J[0], J[3], J[5]], [J[3], J[1], J[4]], [J[5], J[4], J[2]]])
        shift = np.hstack([np.eye(3), -cross_matrix(c)])  # u + theta x c
        out[at:at + 3, at:at + 6] -= m * shift
        out[at + 3:at + 6, at:at + 6] -= m * x @ shift
        out[at + 3:at + 6, at + 3:at + 6] -= tensor
    return out


class Assembly:
    """Triplets of L and M."""

    def __init__(self):
        self.parts = ([], []), ([], [])

    def add(self, which, row, column, block):
        block = np.atleast_2d(block)
        i, j = np.nonzero(block)
        self.parts[which][0].append(np.array([row + i, column + j]))
        self.parts[which][1].append(block[i, j])

    def matrix(self, which, size):
        places, values = self.parts[which]
        if not places:
            return coo_matrix((size, size)).tocsc()
        return coo_matrix((np.concatenate(values), np.concatenate(places, axis=1)),
                          shape=(size, size)).tocsc()


def add_inside(out, v, at):
    """Collocation and continuity of a member whose fields begin at column and row `at`; the next row."""
    f, N, m = v.fields, v.points, v.m
    row, W = at, m.h * m.W
    for i in range(v.intervals):
        first = at + i * N * f
        parts = [v.slopes(m.y[i, k]) for k in range(N)]
        for j in range(1, N):
            out.add(0, row, first + j * f, np.eye(f))
            out.add(0, row, first, -np.eye(f))
            for k in range(N):
                out.add(0, row, first + k * f, -W[j, k] * parts[k][0])
                out.add(1, row, first + k * f, -W[j, k] * parts[k][1])
            row += f
        if i:
            out.add(0, row, first, np.eye(f))
            out.add(0, row, first - f, -np.eye(f))
            row += f
    return row


def add_ends(out, v, at, row, shared):
    """Both ends follow their bodies, whose equilibrium takes their loads; one condition of warping at each."""
    m, f, n = v.m, v.fields, v.n
    for end, (body, sign) in enumerate(zip(m.bodies, (1.0, -1.0))):
        y, column = (m.y[0, 0], at) if end == 0 else (m.y[-1, -1], at + v.size - f)
        out.add(0, body.at, column + n, sign * np.eye(6))
        out.add(0, row, column, np.eye(3))
        out.add(0, row, body.at, -np.eye(3))
        out.add(0, row, body.at + 3, cross_matrix(body.R @ m.ends[end]))
        out.add(0, row + 3, column + 3, turn_of(y[3:7]))
        out.add(0, row + 3, body.at + 3, -np.eye(3))
        row += 6
        if end == 0:  # a quaternion has four numbers: the length of dq
            out.add(0, row, column + 3, y[3:7])
            row += 1
    if m.beam.warps:
        for end, column in enumerate((at, at + v.size - f)):
            kind = m.warp[end]
            if kind in ("fixed", "free"):
                out.add(0, row, column + 7 + (kind == "free"), 1.0)
            else:
                shared.setdefault(kind, []).append((row, column + 7, 1.0 if end else -1.0))
            row += 1
    return row


def frequencies(scene, count):
    """The lowest [Hz]."""
    matrix, _ = scene.net.system(0.0)
    size, total = BODY * len(scene.net.bodies), matrix.shape[0]
    kept = np.r_[np.arange(size), np.arange(total - len(scene.net.numbers), total)]
    out, shared, at = Assembly(), {}, len(kept)
    out.add(0, 0, 0, matrix[kept][:, kept].toarray())
    out.add(1, 0, 0, body_masses(scene, size))
    for name, member in scene.member.items():
        v = Vibration(member, inertia_of(scene, name))
        row = add_ends(out, v, at, add_inside(out, v, at), shared)
        assert row == at + v.size
        at = row
    for ends in shared.values():
        for k, (row, column, sign) in enumerate(ends):
            if k:
                out.add(0, row, column, 1.0)
                out.add(0, row, ends[0][1], -1.0)
            out.add(0, ends[0][0], column + 1, sign)
    return lowest(out.matrix(0, at), out.matrix(1, at), count)


def lowest(left, mass, count):
    try:
        solved = splu(left)
    except RuntimeError as why:
        raise Refused(
            "frequencies of what is not held are not within the deriving program") from why
    operator = LinearOperator(left.shape, matvec=lambda x: solved.solve(mass @ x), dtype=float)
    start = np.random.default_rng(1).standard_normal(left.shape[0])
    wanted = count + 6
    mu = eigs(operator,
              k=wanted,
              ncv=min(left.shape[0] - 1, 4 * wanted + 20),
              which="LM",
              v0=start,
              return_eigenvectors=False,
              tol=1e-14)
    mu = mu[np.argsort(-np.abs(mu))][:count]
    if np.any(np.abs(mu.imag) > 1e-6 * np.abs(mu.real)) or np.any(mu.real <= 0):
        raise Refused("a mode that does not vibrate is not within the deriving program")
    return np.sqrt(1 / np.sort(mu.real)[::-1]) / (2 * math.pi)
