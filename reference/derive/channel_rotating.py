"""The channel cantilever of J section 5.2, rotating about the vertical axis through its root: force at given deflections.

The beam and the load are those of channel_cantilever.py. In the rotating frame, the outward force per length on the
centroidal axis is f = rho A Omega^2 times the distance from the rotation axis. With rotary inertia, a fibre at v = R
(omega a, y, z) from the centroid has the additional force rho Omega^2 P v with P = I - e_z e_z^T. These forces have
the moment c = rho Omega^2 sum_k I_k d_k x P d_k about the centroid, where d_k are the columns of R and I = (Iw a^2,
Iz, Iy); int omega y, int omega z and int y z vanish. They do the work rho Iw a Omega^2 d_x . P d_x on da. F' = -f, m0'
= -r x f - c, and B' is -Mw minus this work. These equations are integrated with the state of the beam (beam.py) by
Chebyshev collocation of all intervals at once. Newton's method uses derivatives by complex steps.
"""
import numpy as np

from reference.derive import defaults
from reference.derive.beam import STEP, chebyshev, rotation
from reference.derive.channel_cantilever import LENGTH, channel_beam

DENSITY, INTERVALS, NODES = 7800.0, 6, 12
STATES = 15
RELATIVE = 1e-8


class Turning:
    """The boundary-value problem. Its unknowns are the states at all points, one after the other, and the force on the
    tip."""

    def __init__(self, omega, rotary, form):
        value = defaults.values("c_cantilever")
        beam, self.half, self.web = channel_beam(*(value[k]
                                                   for k in ("sizes", "shear", "wagner_moments")))
        self.force = beam.EIz / LENGTH ** 2
        self.beam = form(beam).scaled(LENGTH, self.force)
        area = beam.EA / 210e9
        self.pull = DENSITY * area * omega ** 2 * LENGTH ** 2 / self.force
        turning = rotary * DENSITY * omega ** 2 / self.force  # dimensionless after multiplication by the moments of area
        self.moments, self.bimoments = turning * np.array(
            [beam.EIz, beam.EIy]) / 210e9, turning * beam.EIw / 210e9 / LENGTH ** 2
        self.arm = np.array([0, self.web, self.half]) / LENGTH
        self.points, self.W = chebyshev(NODES)
        s = np.concatenate([[0.0]] + [(i + self.points[1:]) / INTERVALS for i in range(INTERVALS)])
        self.z = np.zeros((STATES, len(s)))
        self.z[:9] = self.beam.at_rest((0, 0, 0), (1, 0, 0, 0), s)
        self.load = 0.0

    def slope(self, z):
        outward = self.pull * z[:3] * np.array([1, 1, 0])[:, None]
        R, a = rotation(z[3:7]), z[7]
        P = np.array([1, 1, 0])[:, None]
        moment = sum(I * np.cross(R[:, k], P * R[:, k], axis=0)
                     for k, I in enumerate((self.bimoments * a * a, *self.moments)))
        y = self.beam.slope(z[:9], z[9:])
        y[8] -= self.bimoments * a * np.sum(R[:, 0] * P * R[:, 0], axis=0)
        return np.concatenate([y, -outward, -np.cross(z[:3], outward, axis=0) - moment])

    def ends(self, z0, z1, load, deflection):
        """Returns the residuals of sixteen conditions. The root is clamped with warping restrained. The other conditions
        are the force, the moment, the bimoment and the deflection of the tip."""
        r, R, F = z1[:3], rotation(z1[3:7]), z1[9:12]
        arm, pull = R @ self.arm, np.array([0 * load, 0 * load, -load])
        return np.concatenate([
            z0[:3], z0[3:7] - np.array([1, 0, 0, 0]), [z0[7], z1[8]], F - pull,
            z1[12:] - np.cross(r, F) - np.cross(arm, pull),
            [r[2] + arm[2] - self.arm[2] + deflection]
        ])

    def system(self, deflection):
        many, h = self.z.shape[1], 1.0 / INTERVALS
        columns = np.repeat(self.z.astype(complex)[:, :, None], STATES, axis=2)
        columns[np.arange(STATES), :, np.arange(STATES)] += 1j * STEP
        f = self.slope(columns.reshape(STATES, -1)).reshape(STATES, many, STATES)
        value, jacobian = f[:, :, 0].real, np.moveaxis(f.imag / STEP, 0,
                                                       1)  # [many, states, states]
        size = STATES * many + 1
        A, b = np.zeros((size, size)), np.zeros(size)
        row = 0
        for i in range(INTERVALS):
            at = i * NODES
            for j in range(1, NODES + 1):
                rows = slice(row, row + STATES)
                b[rows] = self.z[:, at +
                                 j] - self.z[:, at] - h * value[:, at:at + NODES + 1] @ self.W[j]
                for k in range(NODES + 1):
                    A[rows, STATES * (at + k):STATES *
                      (at + k + 1)] -= h * self.W[j, k] * jacobian[at + k]
                A[rows, STATES * (at + j):STATES * (at + j + 1)] += np.eye(STATES)
                A[rows, STATES * at:STATES * (at + 1)] -= np.eye(STATES)
                row += STATES
        b[row:] = self.ends(self.z[:, 0], self.z[:, -1], self.load, deflection)
        for k, column in [(k, k) for k in range(STATES)] + [(STATES + k, size - 1 - STATES + k)
                                                            for k in range(STATES + 1)]:
            d = np.zeros(2 * STATES + 1, dtype=complex)
            d[k] = 1j * STEP
            A[row:, column] += self.ends(self.z[:, 0] + d[:STATES], self.z[:, -1] + d[STATES:-1],
                                         self.load + d[-1], deflection).imag / STEP
        return A, b

    def solve(self, deflection, tolerance):
        for _ in range(30):
            A, b = self.system(deflection)
            step = np.linalg.solve(A, -b)
            self.z += step[:-1].reshape(-1, STATES).T
            self.load += step[-1]
            if np.max(np.abs(step)) <= tolerance * (1 + abs(self.load)):
                return
        raise ArithmeticError(f"Newton's method did not converge at {deflection}")


def advance(t, at, w):
    """Makes one step from the deflection `at` towards w [m], halved until it converges. Returns the new deflection."""
    step, before = 0.025 if at < 0.4 else 0.05, (t.z.copy(), t.load)
    while step > 1e-3:
        to = min(at + step, w)
        try:
            t.solve(to / LENGTH, 1e-11 if to == w else 1e-6)
            return to
        except (ArithmeticError, np.linalg.LinAlgError):
            t.z, t.load, step = before[0].copy(), before[1], step / 2
    raise ArithmeticError(f"no equilibrium found beyond a deflection of {at} m")


def path(deflections, omega, rotary=0, form=lambda beam: beam):
    """Returns (force [N], displacement of the loaded point along y [m]) at each deflection [m]."""
    t = Turning(omega, rotary, form)
    out, at = [], 0.0
    for w in deflections:
        while at < w - 1e-12:
            at = advance(t, at, w)
        out.append(
            (t.load * t.force, (t.z[:3, -1] + rotation(t.z[3:7, -1]) @ t.arm - t.arm)[1] * LENGTH))
    return out


def rows():
    deflections = (0.25, 0.5, 1.0)
    for omega, rotary in ((10, 0), (20, 0), (40, 0), (20, 1), (40, 1)):
        for w, (force, lateral) in zip(deflections, path(deflections, omega, rotary)):
            at = defaults.differing("c_cantilever", omega=omega, w=w, rotary_inertia=rotary)
            yield "c_cantilever", at, "load_at_w", force, "N", RELATIVE
            yield "c_cantilever", at, "lateral", lateral, "m", RELATIVE
