"""Rigid bodies joined by geometrically exact beams (beam.py): equilibrium by Newton's method, and the linear response
about the equilibrium.

The unknowns of a body are its position x, its rotation and the load (f, mu) on its reference point. The unknowns of a
beam are F, m0 (moment about the origin, constant along the beam) and its states at the ends of the intervals. The
problem may have additional numbers as unknowns. The equations of a body are the six equations of equilibrium and six
conditions that depend on its support: a clamped body has a given position and rotation, and a free body has no load on
its reference point. The equations of a beam are those of its intervals, six conditions of closure (the end of the beam
coincides with the point and the axes of the second body to which it is fixed), and one warping condition at each
end."""
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu

from reference.derive.beam import (STEP, Scaled, chebyshev, cross_matrix, exponential, product,
                                   quaternion, rotation)

# Loads along a beam (beam.py) add six states, which are F and m0 (moment about the origin, fixed axes) minus their
# values at the start:
#   F' = -f q,   m0' = -f ((r + R d) x q + c).
# The force q and the moment c are per initial length. They are in fixed axes or rotate with the sections, and they are
# constant or linear along the beam. If a load is linear, s is a state before the six states. d is the position of q
# relative to the centroid in the axes of the section, and f is the load factor at the level.


class LineLoad:
    """A load along a beam. `force` [N/m] and `moment` [N] are per length, in fixed axes or in the axes of the section,
    with which they rotate. `at` [m] is the position of the force in the axes of the section. `factor(level)` is the
    factor of the load. `more` is the linear increase of force and moment from the start to the end, or None."""

    def __init__(self, force, moment, at, turns, factor, more=None):
        self.force, self.moment, self.at, self.turns, self.factor = (*(np.array(
            v, dtype=float) for v in (force, moment, at)), turns, factor)
        self.more = None if more is None else [np.array(v, dtype=float) for v in more]

    def scaled(self, length, force):
        more = None if self.more is None else (self.more[0] * length / force, self.more[1] / force)
        return LineLoad(self.force * length / force, self.moment / force, self.at / length,
                        self.turns, self.factor, more)

    def at_place(self, s):
        more = (0.0, 0.0) if self.more is None else (v[:, None] * s for v in self.more)
        return [v[:, None] + m for v, m in zip((self.force, self.moment), more)]


class Loaded(Scaled):
    """A scaled beam with loads along it. The level is that of the network."""
    carries = True
    stays = False  # True in linear analysis: loads remain at their undeformed positions

    def __init__(self, beam, loads):
        self.__dict__.update(beam.__dict__)
        self.plain, self.loads, self.level = beam, loads, 0.0
        self.varies = any(load.more is not None for load in loads)

    @property
    def states(self):
        return self.plain.states + self.varies + 6

    def slope(self, y, p):
        n = self.plain.states
        place = y[:7].real if self.stays else y[:7]  # without the complex step, loads do not follow the motion
        R, out = rotation(place[3:]), np.zeros((6, y.shape[1]), dtype=np.result_type(y, p))
        s = y[n].real if self.varies else 0 * y[0].real
        for load in self.loads:
            factor = load.factor(self.level)
            q, c = (np.einsum("ijk,jk->ik", R, factor * (v + 0 * s)) if load.turns else
                    factor * v + 0 * y[:3] for v in load.at_place(s))
            out[:3] -= q
            out[3:] -= np.cross(place[:3] + np.einsum("ijk,j->ik", R, load.at), q, axis=0) + c
        rates = [self.plain.slope(y[:n], p + y[-6:]), self.length * out]
        return np.concatenate(rates[:1] + [1 + 0 * y[:1]] * self.varies + rates[1:])

    def at_rest(self, start, q0, s):
        y = self.plain.at_rest(start, q0, s)
        return np.concatenate([y] + [np.array(s)[None]] * self.varies + [np.zeros((6, y.shape[1]))])



class Body:

    def __init__(self, x, conditions, on=None):
        """Makes a body at x. `on` is the body to which a joint belongs, or None."""
        self.on = on
        self.x, self.q, self.load, self.conditions = np.array(x, dtype=float), np.array(
            [1.0, 0, 0, 0]), np.zeros(6), conditions

    @property
    def R(self):
        return rotation(self.q)


class Member:
    """A beam between two bodies. `warp` is 'fixed', 'free' or a name that several ends share."""

    def __init__(self, beam, bodies, ends, q0, warp, intervals, nodes):
        self.beam, self.bodies, self.warp = beam, bodies, warp
        self.ends, self.q_end = ends, [q0, None]  # offsets and triads of the ends in the axes of the bodies
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
        """Computes Y = base + A y_start + B p for the changes in each interval."""
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


BODY = 12  # x, rotation, force, moment


def free(level, x, R, force, moment, numbers):
    return np.concatenate([force, moment])


def clamped(at, turned=None):
    """Returns the conditions of a body fixed at a position and with a rotation vector, both of which may depend on the
    level."""
    place = at if callable(at) else lambda level: at
    turn = turned or (lambda level: (0.0, 0.0, 0.0))

    def conditions(level, x, R, force, moment, numbers):
        D = R @ rotation(exponential(np.array(turn(level)))).T
        return np.concatenate([
            x - np.array(place(level)),
            np.array([D[2, 1] - D[1, 2], D[0, 2] - D[2, 0], D[1, 0] - D[0, 1]]) / 2
        ])

    return conditions


class Network:

    def __init__(self, length, force, numbers=(), intervals=4, nodes=12):
        self.length, self.force, self.numbers = length, force, np.array(numbers, dtype=float)
        self.bodies, self.members, self.intervals, self.nodes = [], [], intervals, nodes
        self.extra = [
        ]  # conditions that determine the numbers: (body, function(level, x, R, force, moment, numbers))

    def body(self, position, conditions=free):
        """Adds a body and returns it. `position` is in [m]. `conditions` is a function that receives dimensionless
        values."""
        self.bodies.append(Body(np.array(position) / self.length, conditions))
        return self.bodies[-1]

    def joint(self, body, position, conditions):
        """Adds a massless body at a position [m] whose load is transmitted to another body. The last argument of its
        conditions is the pair (position, rotation) of that body."""
        self.bodies.append(Body(np.array(position) / self.length, conditions, body))
        return self.bodies[-1]

    def member(self, beam, first, second, start, axes, warp=("fixed", "fixed"), loads=()):
        """Adds a beam between two bodies and returns the Member. `start` is the position [m] of its start, which is
        fixed to the first body. The columns of `axes` are x, y, z of the beam. `loads` are LineLoads along the
        beam."""
        offset = np.array(start) / self.length - first.x
        scaled = beam.scaled(self.length, self.force)
        if loads:
            scaled = Loaded(scaled, [load.scaled(self.length, self.force) for load in loads])
        self.members.append(
            Member(scaled, (first, second), [offset, None], quaternion(np.array(axes)), warp,
                   self.intervals, self.nodes))
        return self.members[-1]

    def _places(self):
        at = BODY * len(self.bodies)
        for m in self.members:
            m.at = at
            at += m.size
        for i, b in enumerate(self.bodies):
            b.at = BODY * i
        return at, at + len(self.numbers)

    def _body_rows(self, level, conditions, b, put):
        """Returns the values of the conditions of a body. Passes their derivatives to put(i, column, value), where i
        is the index of the condition."""
        columns = list(range(b.at, b.at + BODY)) + self._places_of_numbers
        on = [] if b.on is None else list(range(b.on.at, b.on.at + 6))
        R = b.R
        values = None
        for k, column in enumerate(columns + on):
            d = np.zeros(len(columns) + 6, dtype=complex)
            d[k] = 1j * STEP
            e = d[len(columns):]
            other = [] if b.on is None else [(b.on.x + e[:3],
                                              b.on.R + cross_matrix(e[3:]) @ b.on.R)]
            value = np.array(conditions(level, b.x + d[:3], R + cross_matrix(d[3:6]) @ R,
                                        b.load[:3] + d[6:9], b.load[3:] + d[9:12],
                                        self.numbers + d[12:len(columns)], *other),
                             dtype=complex)
            values = value.real
            for i in np.nonzero(value.imag)[0]:
                put(i, column, value[i].imag / STEP)
        return values

    def _equilibrium(self, b, put, right):
        """Adds the external load in rows b.at .. b.at + 5, to which the members add their loads. The load of a joint is
        transmitted to its body."""
        for owner, sign in ((b, 1.0), (b.on, -1.0)):
            if owner is None:
                continue
            _block(put, owner.at, b.at + 6, sign * np.eye(6))
            _block(put, owner.at + 3, b.at + 6, sign * cross_matrix(b.x))
            _block(put, owner.at + 3, b.at, -sign * cross_matrix(b.load[:3]))
            right[owner.at:owner.at + 3] -= sign * b.load[:3]
            right[owner.at + 3:owner.at + 6] -= sign * (b.load[3:] + np.cross(b.x, b.load[:3]))

    def _member_rows(self, m, put, right):
        n, warps = m.beam.states, m.beam.warps
        for b, sign in zip(m.bodies, (1.0, -1.0)):
            _block(put, b.at, m.at, sign * np.eye(6))
            right[b.at:b.at + 6] -= sign * m.p
        if m.beam.carries:
            _block(put, m.bodies[1].at, m.at + m.size - 6, -np.eye(6))
            right[m.bodies[1].at:m.bodies[1].at + 6] += m.y[-1, -1, n - 6:]
        first = m.at + 6  # column of (kx, B) at the start, then the states at the ends of the intervals
        nodes = first + (2 if warps else 0)
        row = m.at
        start = m.start_state()
        maps = m.linearise()
        for i, one in enumerate(maps):
            A, B, c = one[:, :n], one[:, n:n + 6], one[:, n + 6]
            _block(put, row, nodes + i * n, np.eye(n))
            _block(put, row, m.at, -B)
            jump = start - m.y[0, 0] if i == 0 else m.y[i - 1, -1] - m.y[i, 0]
            right[row:row + n] += c + A @ jump
            if i == 0:
                b = m.bodies[0]
                _block(put, row, b.at, -A[:, :3])
                arm = -cross_matrix(b.R @ m.ends[0])
                _block(put, row, b.at + 3, -A[:, :3] @ arm - A[:, 3:7] @ _spin(start[3:7]))
                if warps:
                    _block(put, row, first, -A[:, 7:9])
            else:
                _block(put, row, nodes + (i - 1) * n, -A)
            row += n
        self._closure(m, nodes + (len(maps) - 1) * n, row, put, right)

    @staticmethod
    def _closure(m, last, row, put, right):
        """Adds the conditions that the position and the rotation at the end of a member equal those prescribed by its
        second body. The condition for the rotation is 2 vec(q o q_target*) = 0."""
        b, y = m.bodies[1], m.y[-1, -1]
        arm = b.R @ m.ends[1]
        _block(put, row, last, np.eye(3))
        _block(put, row, b.at, -np.eye(3))
        _block(put, row, b.at + 3, cross_matrix(arm))
        right[row:row + 3] -= y[:3] - b.x - arm
        target = product(b.q, m.q_end[1])
        back = target * np.array([1, -1, -1, -1])
        by_q = np.array([2 * product(e, back)[1:] for e in np.eye(4)]).T
        _block(put, row + 3, last + 3, by_q)
        _block(put, row + 3, b.at + 3, -np.eye(3))
        right[row + 3:row + 6] -= 2 * product(y[3:7], back)[1:]
        m.warp_row = row + 6

    def _warp_rows(self, put, right):
        """Adds one warping condition for each end. Ends that share a coordinate have equal kx, and their bimoments are in
        equilibrium."""
        groups = {}
        for m in (m for m in self.members if m.beam.warps):
            for end in range(2):
                column = m.at + (6 if end == 0 else m.size - m.beam.states + 7)
                state = m.y[0, 0, 7:9] if end == 0 else m.y[-1, -1, 7:9]
                row, kind = m.warp_row + end, m.warp[end]
                if kind in ("fixed", "free"):
                    put(row, column + (kind == "free"), 1.0)
                    right[row] -= state[int(kind == "free")]
                else:
                    groups.setdefault(kind, []).append((row, column, state, 1.0 if end else -1.0))
        for ends in groups.values():
            for k, (row, column, state, sign) in enumerate(ends):
                if k > 0:
                    put(row, column, 1.0)
                    put(row, ends[0][1], -1.0)
                    right[row] -= state[0] - ends[0][2][0]
                put(ends[0][0], column + 1, sign)
                right[ends[0][0]] -= sign * state[1]

    def system(self, level, override=None):
        """Returns the sparse matrix and the right-hand side of Newton's method. `override` contains other conditions for
        some bodies."""
        first_number, total = self._places()
        self._places_of_numbers = list(range(first_number, total))
        for m in self.members:
            m.beam.level = level
        rows, columns, values, right = [], [], [], np.zeros(total)

        def put(row, column, value):
            rows.append(row), columns.append(column), values.append(value)

        for b in self.bodies:
            self._equilibrium(b, put, right)
            conditions = (override or {}).get(b, b.conditions)
            at = b.at + 6
            right[at:at + 6] -= self._body_rows(level, conditions, b,
                                                lambda i, c, v: put(at + i, c, v))
        for m in self.members:
            self._member_rows(m, put, right)
        self._warp_rows(put, right)
        for k, (b, conditions) in enumerate((override or {}).get("extra", self.extra)):
            right[first_number + k] -= self._body_rows(
                level, conditions, b, lambda i, c, v: put(first_number + k, c, v))[0]
        return coo_matrix((values, (rows, columns)), shape=(total, total)).tocsc(), right

    def _advance(self, step):
        for m in self.members:
            n, at = m.beam.states, m.at + 6 + (2 if m.beam.warps else 0)
            start = m.start_state()
            before = start - m.y[0, 0]
            b = m.bodies[0]
            before[:3] += step[b.at:b.at + 3] + np.cross(step[b.at + 3:b.at + 6], b.R @ m.ends[0])
            before[3:7] += _spin(start[3:7]) @ step[b.at + 3:b.at + 6]
            if m.beam.warps:
                before[7:9] += step[m.at + 6:m.at + 8]
            p = step[m.at:m.at + 6]
            old_ends = m.y[:, -1].copy()
            for i in range(m.y.shape[0]):
                if i:
                    before = old_ends[i - 1] + step[at + (i - 1) * n:at + i * n] - m.y[i, 0]
                m.y[i] += m.response[i] @ np.concatenate([before, p, [1.0]])
            m.p = m.p + p
        for b in self.bodies:
            d = step[b.at:b.at + BODY]
            b.x, b.q, b.load = b.x + d[:3], product(exponential(d[3:6]), b.q), b.load + d[6:]
            b.q = b.q / np.linalg.norm(b.q)
        self.numbers = self.numbers + step[len(step) - len(self.numbers):]

    def iterate(self, level):
        """Makes one step of Newton's method. Returns the largest relative change."""
        matrix, right = self.system(level)
        step = splu(matrix).solve(right)
        self._advance(step)
        size = np.max(np.abs(step) / (1 + self._magnitudes()))
        if not np.isfinite(size):
            raise ArithmeticError("Newton's method produced NaN or Inf")
        return size

    def solve(self, path=(1.0, ), tolerance=1e-12):
        """Solves for equilibrium at each level in succession, to the tolerance on the relative change in a step of
        Newton's method."""
        for level in path:
            for _ in range(30):
                if self.iterate(level) <= tolerance:
                    break
            else:
                raise ArithmeticError(f"Newton's method did not converge at level {level}")

    def _magnitudes(self):
        out = np.zeros(self._places()[1])
        for b in self.bodies:
            out[b.at + 6:b.at + 12] = np.max(np.abs(b.load))
        for m in self.members:
            out[m.at:m.at + 6] = np.max(np.abs(m.p))
            if m.beam.warps:
                out[m.at + 6:m.at + m.size] = np.max(np.abs(m.y[:, :, 7:9]))
            if m.beam.carries:
                out[m.at + 6:m.at + m.size] += np.max(np.abs(m.y[:, :, -6:]))
        return out

    def response(self, level, body, override):
        """Returns the compliance [6, 6] in SI units, which is the change of (u, theta) of a body due to unit dead loads
        (f, mu) on it. `override` contains other conditions for some bodies. For each component of the load, the
        overriding condition of the loaded body must be that of a free body.
        """
        matrix, _ = self.system(level, override)
        right = np.zeros((matrix.shape[0], 6))
        right[body.at + 6 + np.arange(6), np.arange(6)] = 1.0
        out = splu(matrix).solve(right)[body.at:body.at + 6]
        scale = np.array([self.length] * 3 +
                         [1.0] * 3)[:, None] / np.array([self.force] * 3 +
                                                        [self.force * self.length] * 3)[None, :]
        return out * scale


def _spin(q):
    """Returns dq/dtheta [4, 3] for a spatial rotation increment theta."""
    return np.array([product(np.concatenate([[0.0], e]), q) / 2 for e in np.eye(3)]).T


def _block(put, row, column, block):
    for i, line in enumerate(block):
        for j, value in enumerate(line):
            if value != 0:
                put(row + i, column + j, value)
