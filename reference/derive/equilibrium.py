"""Stability and small vibrations of the geometrically exact beam (beam.py) in a loaded and deformed state.

Critical load: the determinant of the linearised boundary-value problem vanishes along the nonlinear path of
equilibrium.

Vibration: let y = (r, q, a, B) and p = (F, m0) be those of the equilibrium, and u, theta, a small amplitudes of exp(i
omega t). Then
  dy' = (df/dy) dy + (df/dp) dp - omega^2 rho Iw a,
  dF' = -omega^2 rho A u,   dm0' = r x dF' - omega^2 rho R diag(Ip, Iy, Iz) R^T theta
where the term with a is only in the row of B, and m = m0 - r x F is the moment in fixed axes. Spectral integration as
in network.py gives an eigenvalue problem L z = omega^2 M z.

Option `interpolated`: a consistent mass derives the warping amplitude along an element from its twist, psi = kx - w (1
- 6 x (1 - x)) with w = kx - a. Therefore kx^2 + w^2/5 has the inertia of a^2 (J section 3.2 without flexible warping;
with J Eq. 66, w = -(n_y ky + n_z kz)). This inertia adds the momentum rho Iw (kx + w/5) to Mx and -rho Iw w/5 to B'.
The change of kx due to the change of Mx is neglected (1e-11 of a frequency).
"""
import math

import numpy as np
from scipy.linalg import eig
from scipy.optimize import brentq

from reference.derive import defaults
from reference.derive.beam import Beam, cross_matrix, product, rotation
from reference.derive.network import Network, clamped
from reference.derive.sheets import deflected, sheet

RELATIVE = 2e-10


def singular_load(net, start, end):
    net.solve(np.linspace(start / 4, start, 4))
    size = np.linalg.slogdet(net.system(start)[0].toarray())[1]
    level = [start]

    def determinant(target):
        net.solve(np.linspace(level[0], target, 3)[1:])
        level[0] = target
        sign, logarithm = np.linalg.slogdet(net.system(target)[0].toarray())
        return sign * math.exp(logarithm - size)

    return brentq(determinant, start, end, xtol=1e-11 * end, rtol=1e-12)


def lateral(bracket, ratio, K=0.0):
    """Returns the critical tip force of lateral_buckling [N], for weak EI = GJ = 1 N m^2 and strong EI = ratio."""
    beam = Beam(1.0, EA=1e6, EIy=ratio, EIz=1.0, GJ=1.0, EIw=1 / K if K else 0.0)
    net = Network(1.0, 1.0, intervals=6, nodes=14)
    root = net.body((0, 0, 0), clamped((0.0, 0.0, 0.0)))
    tip = net.body((1, 0, 0), lambda level, x, R, force, moment, numbers: np.concatenate(
        [force - level * np.array([0, 0, -1.0]), moment]))
    net.member(beam, root, tip, (0, 0, 0), np.eye(3), ("fixed", "free"))
    return singular_load(net, *bracket)


def buckling():
    for bracket, ratio, K in (((3.9, 4.1), 10000, 0.0), ((4.4, 4.9), 10, 0.0), ((6.5, 7.5), 4, 0.0),
                              ((11.5, 13.5), 10, 10.0)):
        at = ([f"K={K:g}"] if K else []) + ["prebuckling=included"
                                            ] + ([f"ratio={ratio}"] if ratio != 10000 else [])
        yield "lateral_buckling", ";".join(at), "load_factor", lateral(bracket, ratio,
                                                                       K), "1", RELATIVE


class Vibration:
    """Generalised eigenvalue problem of one member whose ends are at the reference points of bodies, in the units of the
    network."""

    def __init__(self, member, inertia, interpolated=False):
        self.m, self.n, self.interpolated = member, member.beam.states, interpolated
        self.fields = self.n + 6
        self.inertia = inertia  # (rho A, diag rho (Ip, Iy, Iz), rho Iw)
        self.intervals, self.points = member.y.shape[:2]
        self.size = self.intervals * self.points * self.fields

    def slopes(self, y):
        """Returns the matrices A and G of dz/ds = A z - omega^2 G z at one point, where z = (dy, dp)."""
        n, L = self.n, self.m.beam.length
        slope, fy, fp = self.m.beam.slope_and_derivatives(y[:, None], self.m.p[:, None])
        A, G = np.zeros((self.fields, self.fields)), np.zeros((self.fields, self.fields))
        A[:n, :n], A[:n, n:] = fy[0], fp[0]
        line, turn, warp = self.inertia
        R, theta = rotation(y[3:7]), turn_of(y[3:7])
        G[n:n + 3, :3] = L * line * np.eye(3)
        G[n + 3:, :3] = L * line * cross_matrix(y[:3])
        G[n + 3:, 3:7] = L * R @ np.diag(turn) @ R.T @ theta
        if self.m.beam.warps and self.interpolated:
            amplitude = np.eye(self.fields)[7]
            rate = twist_rate(y[3:7], slope[3:7, 0], A[3:7], self.fields) / L
            G[8] -= L * warp / 5 * (rate - amplitude)
            G[:n] -= np.outer(fp[0][:, 3:] @ R[:, 0], warp * (rate + (rate - amplitude) / 5))
        elif self.m.beam.warps:
            G[8, 7] = L * warp
        return A, G

    def matrices(self, start, end):
        """Returns L and M of L z = omega^2 M z. `start` and `end` contain the rows of the conditions on z at the ends."""
        N, f, W = self.points, self.fields, self.m.h * self.m.W
        left, mass = np.zeros((self.size, self.size)), np.zeros((self.size, self.size))
        row = 0
        for i in range(self.intervals):
            at = i * N * f
            parts = [self.slopes(self.m.y[i, k]) for k in range(N)]
            for j in range(1, N):  # z_j - z_0 - h sum W A z = -omega^2 h sum W G z
                rows = slice(row, row + f)
                left[rows, at + j * f:at + (j + 1) * f] += np.eye(f)
                left[rows, at:at + f] -= np.eye(f)
                for k in range(N):
                    columns = slice(at + k * f, at + (k + 1) * f)
                    left[rows, columns] -= W[j, k] * parts[k][0]
                    mass[rows, columns] -= W[j, k] * parts[k][1]
                row += f
            if i:
                left[row:row + f, at:at + f] = np.eye(f)
                left[row:row + f, at - f:at] = -np.eye(f)
                row += f
        left[row:row + len(start), :f] = start
        left[row + len(start):, -f:] = end
        assert row + len(start) + len(end) == self.size
        return left, mass

    def frequencies(self, start, end, count):
        """Returns the smallest values of omega^2 in ascending order, in the units of the network."""
        left, mass = self.matrices(start, end)
        inverse = np.linalg.solve(left, mass)
        values = eig(inverse, right=False)
        mu = np.sort(values.real[np.abs(values.imag) <= 1e-6 * np.abs(values.real)])[::-1]
        return 1 / mu[:count]


def twist_rate(q, slope, by, fields):
    conjugate = np.array([1, -1, -1, -1])
    rate = 2 * product(q * conjugate, by)[1]
    rate[3:7] += [2 * product(e * conjugate, slope)[1] for e in np.eye(4)]
    return rate


def turn_of(q):
    back = np.asarray(q) * np.array([1, -1, -1, -1])
    return np.array([2 * product(e, back)[1:] for e in np.eye(4)]).T


def held_tip(vibration, y, p, free_warping):
    """Returns the conditions at the tip. u_y and the rotation about the fixed z axis are fixed. The forces along x and z
    and the moments about the fixed x and y axes are zero."""
    n, f = vibration.n, vibration.fields
    rows = np.zeros((f // 2, f))
    theta, F = turn_of(y[3:7]), p[:3]
    rows[0, 1] = 1.0
    rows[1, 3:7] = theta[2]
    rows[2, n], rows[3, n + 2] = 1.0, 1.0
    dm = np.zeros((3, f))
    dm[:, n + 3:] = np.eye(3)
    dm[:, n:n + 3] -= cross_matrix(y[:3])
    dm[:, :3] += cross_matrix(F)
    rows[4:6] = dm[:2]
    if f == 15:
        return np.vstack([rows[:6], np.eye(f)[8 if free_warping else 7]])
    return rows[:6]


def sheet_frequencies(count, given, form=lambda beam: beam, interpolated=False):
    """Returns the `count` lowest frequencies [Hz] of sheet_cantilever in its deflected state. For `form`, see
    sheets.deflected."""
    value = {**defaults.values("sheet_cantilever"), **given}
    net, _ = deflected(given, form)
    width, thickness, length = value["width"], value["thickness"], value["length"]
    beam = sheet(**value)
    A, Iy, Iz = width * thickness, thickness * width ** 3 / 12, width * thickness ** 3 / 12
    mass = value["density"] / net.force  # in 1/s^2, or dimensionless after multiplication by area and length^2
    inertia = (mass * A * length ** 2, mass * np.array([Iy + Iz, Iy, Iz]),
               mass * beam.EIw / value["young"] / length ** 2)
    member = net.members[0]
    vibration = Vibration(member, inertia, interpolated)
    n = vibration.n
    start = np.eye(vibration.fields)[:8 if n == 9 else 7]
    end = held_tip(vibration, member.y[-1, -1], member.p, value["tip_warping"])
    return np.sqrt(vibration.frequencies(start, end, count)) / (2 * math.pi)


def frequencies():
    for given in ({}, {"tip_deflection": 0.05}, {"tip_warping": 1}):
        at = ";".join(f"{k}={v}" for k, v in {"modes": 3, **given}.items())
        for i, value in enumerate(sheet_frequencies(3, given)):
            yield "sheet_cantilever", at, f"frequency_{i + 1}", value, "Hz", RELATIVE


def rows():
    yield from buckling()
    yield from frequencies()
