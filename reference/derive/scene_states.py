"""States and results of the network of a scene (scene_network.py): along a static path, in one linear step, and for small
loads on a node.

The path is followed from the undeformed state, in steps that are halved if Newton's method fails.
"""
import math

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import LinearOperator, eigs, splu

from reference.derive.beam import cross_matrix, rotation
from reference.derive.equilibrium import Vibration, turn_of
from reference.derive.network import BODY
from reference.derive.scene_network import SceneNetwork
from reference.derive.scene_support import WORDS
from reference.derive.scene_text import Refused, constants_of, number, numbers, only

STEPS, HALVINGS = 4, 8  # minimum number of steps to each station of a path


class Path:
    def __init__(self, scene, name, grid):
        entry = scene["analyses"][name]["static"]
        only(entry, name, ("stations", "steps"))
        self.scene, self.stations = SceneNetwork(scene, *grid), numbers(entry["stations"], name)
        self.steps = max(STEPS, int(number(entry.get("steps", "1"), name)))
        self.values = {}

    def walk(self, ask):
        """Calls ask(scene network, level) at every station. Returns the list of its results."""
        level, out = 0.0, []
        for station in self.stations:
            steps = self.steps if station > level else 1
            for target in np.linspace(level, station, steps + 1)[1:]:
                self._reach(level, target, HALVINGS)
                level = target
            settle(self.scene.net, station)
            self._check()
            out.append(ask(self.scene, station))
            level = station
        return out

    def _reach(self, level, target, halvings):
        state = keep(self.scene.net)
        try:
            self.scene.net.solve((target, ), tolerance=1e-6)
        except (ArithmeticError, RuntimeError, np.linalg.LinAlgError):
            if halvings == 0:
                raise Refused(f"no equilibrium was found beyond {level:g} of the path") from None
            restore(self.scene.net, state)
            self._reach(level, (level + target) / 2, halvings - 1)
            self._reach((level + target) / 2, target, halvings - 1)

    def _check(self):
        for name, place in self.scene.places.items():
            word = place.support and place.support.path_dependent(place.body.R)
            if word:
                raise Refused(
                    f"{name}: its turn about several axes makes what '{word}' means depend on the path; give it a sequence or a vector"
                )


def keep(net):
    return [(b.x, b.q, b.load) for b in net.bodies], [(m.p, m.y.copy())
                                                      for m in net.members], net.numbers


def restore(net, state):
    for b, (b.x, b.q, b.load) in zip(net.bodies, state[0]):
        pass
    for m, (m.p, y) in zip(net.members, state[1]):
        m.y = y.copy()
    net.numbers = state[2]


def settle(net, level):
    size = net.iterate(level)
    for _ in range(30):
        before, size = size, net.iterate(level)
        if size < 1e-14 or (size < 1e-8 and size > before / 4):
            return
    raise Refused(f"Newton's method does not converge at {level:g} of the path")


def reaction(scene, name, component, level):
    place = scene.places[name]
    if place.support is None:
        raise Refused(
            f"the reaction at a part of a body ({name}) is not supported by the deriving program")
    loads = place.body.load - place.support.applied(level, place.body.R)
    return loads[component] * scene.force * (scene.length if component > 2 else 1.0)


def compliance(scene, level, entry, name):
    """Returns the compliance C [6, 6] in SI units for dead forces on a node and for moments under the convention in
    `entry`. Released components of the node are free, and their current reactions remain as dead loads."""
    net, place = scene.net, scene.places[entry["node"]]
    if place.support is None:
        raise Refused(
            f"{name}: the compliance of a part of a body is not supported by the deriving program")
    support, released = place.support, [WORDS.index(word) for word in entry.get("released", [])]
    now = place.body.load - support.applied(level, place.body.R)
    turns = [i for i in released if i > 2]
    extra, axes = list(net.extra), None
    if support.angles:
        if len(turns) in (1, 2):
            raise Refused(
                f"{name}: some of the turns of a sequence are released, not all; this is not supported by the deriving program"
            )
        axes = None if turns else support.axes_now(level, net.numbers)
        first = min(support.angles)
        extra[first:first + len(support.angles)] = [(place.body, one)
                                                    for one in support.kept_angles()]
    matrix, _ = net.system(
        level,
        {place.body: support.conditions({i: now[i]
                                         for i in released}, axes), "extra": extra})
    load = place.body.at + 6 + np.arange(6)
    rows = np.r_[load, np.arange(matrix.shape[0] - len(net.numbers), matrix.shape[0])]
    right = np.zeros((matrix.shape[0], 6))
    right[rows] = matrix[rows][:, load].toarray()
    C = splu(matrix).solve(right)[place.body.at:place.body.at + 6]
    scale = np.array([scene.length] * 3 + [1.0] * 3)[:, None] / (
        scene.force * np.array([1.0] * 3 + [scene.length] * 3))[None, :]
    convention, moment = entry.get("moments", "spatial"), now[3:] * scene.force * scene.length
    return under(C * scale, moment, convention, name)


def under(C, moment, convention, name):
    """Returns the compliance under another convention of moments, for the components that can move."""
    some = [
        i for i in range(6) if abs(C[i, i]) > 1e-14 * np.max(np.abs(C[i // 3 * 3:i // 3 * 3 + 3]))
    ]
    if convention == "spatial" or not np.any(moment):
        return C
    if np.linalg.cond(C[np.ix_(some, some)] / np.sqrt(np.outer(np.diag(C)[some],
                                                               np.diag(C)[some]))) > 1e12:
        raise Refused(
            f"{name}: {convention} moments on a node whose rotations depend on each other are not supported by the deriving program"
        )
    K, out = np.linalg.inv(C[np.ix_(some, some)]), np.zeros((6, 6))
    if convention == "semitangential":
        half = np.zeros((6, 6))
        half[3:, 3:] = cross_matrix(moment) / 2
        K = K + half[np.ix_(some, some)]
    else:
        K = (K + K.T) / 2
    out[np.ix_(some, some)] = np.linalg.inv(K)
    return out


def linear(scene):
    """Returns ({node: displacements and rotations [6]}, {member: resultants at its ends [2, 6]}) of one linear step with
    all loads and motions at level 1."""
    supports = [place.support for place in scene.places.values() if place.support]
    for support in supports:
        if support.sequence or support.vector or any(callable(kind) for kind in support.kinds[3:]):
            raise Refused(
                "a linear analysis with prescribed turns is not supported by the deriving program")
        for load in support.loads:
            load.stays = True
    for beam in (m.beam for m in scene.net.members if m.beam.carries):
        beam.stays = True
    matrix, right = scene.net.system(1.0)
    step, out = splu(matrix).solve(right), {}
    for name, place in scene.places.items():
        d = step[place.body.at:place.body.at + 6] * np.array([scene.length] * 3 + [1.0] * 3)
        d[:3] += np.cross(d[3:], place.offset)
        out[name] = d
    return out, {name: linear_resultants(scene, m, step) for name, m in scene.member.items()}


def linear_resultants(scene, m, step):
    """Returns the resultants (N, Qy, Qz, Mx, My, Mz) [2, 6] at the ends of a member in N and N m, in its undeformed axes.
    `step` is the linear solution."""
    rows, p = [], step[m.at:m.at + 6]
    for y in (m.y[0, 0], m.y[-1, -1]):
        R, r = rotation(y[3:7]), y[:3]
        rows.append(
            in_units(scene, np.concatenate([R.T @ p[:3], R.T @ (p[3:] - np.cross(r, p[:3]))])))
        p = p + (step[m.at + m.size - 6:m.at + m.size] if m.beam.carries else 0.0)
    return np.array(rows)


def resultants(scene, name):
    """Returns the resultants (N, Qy, Qz, Mx, My, Mz) [2, 6] at the ends of a member in N and N m. The resultants are
    the action of the part towards the end of the member on the part towards the start, in the axes of the rotated
    section."""
    m, rows = scene.member[name], []
    for y in (m.y[0, 0], m.y[-1, -1]):
        p = m.p + (y[-6:] if m.beam.carries else 0.0)
        R = rotation(y[3:7])
        rows.append(
            in_units(scene, np.concatenate([R.T @ p[:3], R.T @ (p[3:] - np.cross(y[:3], p[:3]))])))
    return np.array(rows)


def in_units(scene, load):
    return load * scene.force * np.array([1.0] * 3 + [scene.length] * 3)


def inertia_of(scene, name):
    section, where = scene.section_of(scene.scene["members"][name])
    s, rho = constants_of(section, where), number(section.get("density", "0"), where) / scene.force
    rotary = float("rotary_inertia" in scene.physics)
    return rho * s.A * scene.length ** 2, rho * np.array(
        [s.Ip, rotary * s.Iy, rotary * s.Iz]), rotary * ("warping" in scene.physics) * rho * s.Iw / scene.length ** 2


def body_masses(scene, size):
    """Returns the contribution of the masses of nodes to M of L z = omega^2 M z: minus their mass matrices, in the rows
    of equilibrium of their bodies. Moments are about the origin."""
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
    """Triplets (row, column, value) of L and M."""

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
    """Adds the collocation and continuity equations of a member whose fields start at column and row `at`.

    Returns the next row."""
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
    """Adds the ends of a member. Each end follows its body, whose equilibrium includes the loads of the end, and has a
    warping condition."""
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
        if end == 0:  # the additional condition for the four numbers of a quaternion is the length of dq
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
    """Returns the `count` lowest frequencies [Hz]."""
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
            "frequencies of a structure that can move without deformation are not supported by the deriving program") from why
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
        raise Refused("a mode that does not vibrate is not supported by the deriving program")
    return np.sqrt(1 / np.sort(mu.real)[::-1]) / (2 * math.pi)
