"""What a network (network.py) consists of: rigid bodies, and beams between them."""
import numpy as np

from reference.derive.beam import chebyshev, product, rotation


class Body:

    def __init__(self, x, conditions, on=None):
        """on: the body that a joint is on."""
        self.on = on
        self.x, self.q, self.load, self.conditions = np.array(x, dtype=float), np.array(
            [1.0, 0, 0, 0]), np.zeros(6), conditions

    @property
    def R(self):
        return rotation(self.q)


class Member:
    """A beam between two bodies; warp: 'fixed', 'free' or a name shared by several ends."""

    def __init__(self, beam, bodies, ends, q0, warp, intervals, nodes):
        self.beam, self.bodies, self.warp = beam, bodies, warp
        self.ends, self.q_end = ends, [q0, None]  # offsets and triads in the bodies' axes
        self.p = np.zeros(6)
        self.s, self.W = chebyshev(nodes)
        grid = (np.arange(intervals)[:, None] + self.s[None, :]) / intervals
        self.h = 1.0 / intervals
        start = np.array(bodies[0].x) + ends[0]
        self.y = np.moveaxis(
            beam.at_rest(start, q0, grid.ravel()).reshape(beam.states, intervals, -1), 0, 2)
        self.q_end[1] = self.y[-1, -1, 3:7].copy()
        self.ends[1] = self.y[-1, -1, :3] - bodies[1].x

    @property
    def size(self):
        return 6 + (2 if self.beam.warps else 0) + self.y.shape[0] * self.beam.states

    def start_state(self):
        y = self.y[0, 0].copy()
        y[:3] = self.bodies[0].x + self.bodies[0].R @ self.ends[0]
        y[3:7] = product(self.bodies[0].q, self.q_end[0])
        return y

    def linearise(self):
        """Per interval: Y = base + A y_start + B p for changes, with the residual of the current values folded into base."""
        m, n1, n = self.y.shape
        columns = self.y.reshape(-1, n).T
        f, fy, fp = self.beam.slope_and_derivatives(
            columns, np.repeat(self.p[:, None], columns.shape[1], axis=1))
        f, fy, fp = f.T.reshape(m, n1, n), fy.reshape(m, n1, n, n), fp.reshape(m, n1, n, 6)
        W = self.h * self.W
        matrix = -np.einsum("jk,mkab->mjakb", W, fy).reshape(m, n1 * n, n1 * n)
        matrix[:, np.arange(n1 * n), np.arange(n1 * n)] += 1
        start = np.tile(np.eye(n), (n1, 1))
        by_p = np.einsum("jk,mkab->mjab", W, fp).reshape(m, n1 * n, 6)
        residual = (self.y[:, :1] + np.einsum("jk,mka->mja", W, f) - self.y).reshape(m, n1 * n, 1)
        right = np.concatenate([np.broadcast_to(start, (m, n1 * n, n)), by_p, residual], axis=2)
        self.response = np.linalg.solve(matrix, right).reshape(m, n1, n, n + 7)
        return self.response[:, -1]
