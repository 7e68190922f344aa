"""States of a scene's network (scene_network.py), and what is read from them: along a static path, in one linear step, and the response to
small loads on a node.

The path is followed from the undeformed state, in steps that are halved where Newton's method fails.
"""
import numpy as np
from scipy.sparse.linalg import splu

from reference.derive.beam import cross_matrix, rotation
from reference.derive.scene_network import SceneNetwork
from reference.derive.scene_support import WORDS
from reference.derive.scene_text import Refused, number, numbers, only

STEPS, HALVINGS = 4, 8  # of a path: at least so many to each station


class Path:
    """States of a static analysis at its stations."""

    def __init__(self, scene, name, grid):
        entry = scene["analyses"][name]["static"]
        only(entry, name, ("stations", "steps"))
        self.scene, self.stations = SceneNetwork(scene, *grid), numbers(entry["stations"], name)
        self.steps = max(STEPS, int(number(entry.get("steps", "1"), name)))
        self.values = {}

    def walk(self, ask):
        """ask(scene network, level) at every station; returns what it gives."""
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
    """Newton's method until round-off keeps its steps from shrinking."""
    size = net.iterate(level)
    for _ in range(30):
        before, size = size, net.iterate(level)
        if size < 1e-14 or (size < 1e-8 and size > before / 4):
            return
    raise Refused(f"Newton's method does not settle at {level:g} of the path")


def reaction(scene, name, component, level):
    place = scene.places[name]
    if place.support is None:
        raise Refused(
            f"the reaction at a part of a body ({name}) is not within the deriving program")
    loads = place.body.load - place.support.applied(level, place.body.R)
    return loads[component] * scene.force * (scene.length if component > 2 else 1.0)


def compliance(scene, level, entry, name):
    """C [6, 6] in SI of dead forces and moments on a node, whose released components are free and keep their load."""
    net, place = scene.net, scene.places[entry["node"]]
    if place.support is None:
        raise Refused(
            f"{name}: the compliance of a part of a body is not within the deriving program")
    support, released = place.support, [WORDS.index(word) for word in entry.get("released", [])]
    now = place.body.load - support.applied(level, place.body.R)
    turns = [i for i in released if i > 2]
    extra, axes = list(net.extra), None
    if support.angles:
        if len(turns) in (1, 2):
            raise Refused(
                f"{name}: some of the turns of a sequence are released, not all; this is not within the deriving program"
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
    """Compliance under another convention of moments, on the components that can move."""
    some = [
        i for i in range(6) if abs(C[i, i]) > 1e-14 * np.max(np.abs(C[i // 3 * 3:i // 3 * 3 + 3]))
    ]
    if convention == "spatial" or not np.any(moment):
        return C
    if np.linalg.cond(C[np.ix_(some, some)] / np.sqrt(np.outer(np.diag(C)[some],
                                                               np.diag(C)[some]))) > 1e12:
        raise Refused(
            f"{name}: {convention} moments where turns depend on each other are not within the deriving program"
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
    """({node: [6]}: displacements and turns, {member: [2, 6]}: resultants at its ends) of one linear step, loads and motions at 1."""
    supports = [place.support for place in scene.places.values() if place.support]
    for support in supports:
        if support.sequence or support.vector or any(callable(kind) for kind in support.kinds[3:]):
            raise Refused(
                "a linear analysis with prescribed turns is not within the deriving program")
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
    """The load (F, m0) at the ends of a member in its undeformed axes."""
    rows, p = [], step[m.at:m.at + 6]
    for y in (m.y[0, 0], m.y[-1, -1]):
        R, r = rotation(y[3:7]), y[:3]
        rows.append(
            in_units(scene, np.concatenate([R.T @ p[:3], R.T @ (p[3:] - np.cross(r, p[:3]))])))
        p = p + (step[m.at + m.size - 6:m.at + m.size] if m.beam.carries else 0.0)
    return np.array(rows)


def resultants(scene, name):
    """[2, 6] (N, Qy, Qz, Mx, My, Mz) at the ends of a member, of what lies beyond, in the axes of the turned section [N, N m]."""
    m, rows = scene.member[name], []
    for y in (m.y[0, 0], m.y[-1, -1]):
        p = m.p + (y[-6:] if m.beam.carries else 0.0)
        R = rotation(y[3:7])
        rows.append(
            in_units(scene, np.concatenate([R.T @ p[:3], R.T @ (p[3:] - np.cross(y[:3], p[:3]))])))
    return np.array(rows)


def in_units(scene, load):
    return load * scene.force * np.array([1.0] * 3 + [scene.length] * 3)
