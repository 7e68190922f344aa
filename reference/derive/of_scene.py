"""Exact values of a scene that is a network of geometrically exact beams, rigid bodies and supports: displacements, reactions, stiffnesses.

usage: of_scene.py [FILE]     The scene (FILE or standard input) as 'beamwork scene' writes it.  One line for each quantity, as at.py has them.
Exit status: 0; 3 the scene, or all of its quantities, are beyond this program, with a line for each that says what is.

A value is that of the finer of two grids; its uncertainty is twice the difference, and at least round-off.  Grids are refined until
the difference is below 1e-10 of the value (or of its scale).  The path is followed from the undeformed state in steps that are halved
where Newton's method fails.  Linear analyses are one step of it.
"""
import pathlib
import sys

import numpy as np
from scipy.sparse.linalg import splu

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
from reference.derive import scene_text  # noqa: E402
from reference.derive.beam import cross_matrix  # noqa: E402
from reference.derive.scene_network import SceneNetwork  # noqa: E402
from reference.derive.scene_support import WORDS  # noqa: E402
from reference.derive.scene_text import Refused, number, numbers, only  # noqa: E402

SOURCE = "reference/derive/of_scene.py"
GRIDS = ((4, 13), (6, 14), (10, 15), (16, 16))  # intervals, nodes of each
AGREEMENT, ROUND_OFF, NOTHING = 1e-10, 1e-11, 1e-13  # of grids; of a value; of its scale
STEPS, HALVINGS = 4, 8  # of a path: at least so many to each station
KINDS = ("displacement", "reaction", "stiffness", "compliance", "motion")


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
            self.scene.net.solve((target,), tolerance=1e-6)
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
                raise Refused(f"{name}: its turn about several axes makes what '{word}' means depend on the path; give it a sequence or a vector")


def keep(net):
    return [(b.x, b.q, b.load) for b in net.bodies], [(m.p, m.y.copy()) for m in net.members], net.numbers


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
        raise Refused(f"the reaction at a part of a body ({name}) is not within the deriving program")
    loads = place.body.load - place.support.applied(level, place.body.R)
    return loads[component] * scene.force * (scene.length if component > 2 else 1.0)


def compliance(scene, level, entry, name):
    """C [6, 6] in SI of dead forces and moments on a node, whose released components are free and keep their load."""
    net, place = scene.net, scene.places[entry["node"]]
    if place.support is None:
        raise Refused(f"{name}: the compliance of a part of a body is not within the deriving program")
    support, released = place.support, [WORDS.index(word) for word in entry.get("released", [])]
    now = place.body.load - support.applied(level, place.body.R)
    turns = [i for i in released if i > 2]
    extra, axes = list(net.extra), None
    if support.angles:
        if len(turns) in (1, 2):
            raise Refused(f"{name}: some of the turns of a sequence are released, not all; this is not within the deriving program")
        axes = None if turns else support.axes_now(level, net.numbers)
        first = min(support.angles)
        extra[first:first + len(support.angles)] = [(place.body, one) for one in support.kept_angles()]
    matrix, _ = net.system(level, {place.body: support.conditions({i: now[i] for i in released}, axes), "extra": extra})
    load = place.body.at + 6 + np.arange(6)
    rows = np.r_[load, np.arange(matrix.shape[0] - len(net.numbers), matrix.shape[0])]
    right = np.zeros((matrix.shape[0], 6))
    right[rows] = matrix[rows][:, load].toarray()
    C = splu(matrix).solve(right)[place.body.at:place.body.at + 6]
    scale = np.array([scene.length] * 3 + [1.0] * 3)[:, None] / (scene.force * np.array([1.0] * 3 + [scene.length] * 3))[None, :]
    convention, moment = entry.get("moments", "spatial"), now[3:] * scene.force * scene.length
    return under(C * scale, now[3:] * scene.force * scene.length, entry.get("moments", "spatial"), name)


def under(C, moment, convention, name):
    """Compliance under another convention of moments, on the components that can move."""
    some = [i for i in range(6) if abs(C[i, i]) > 1e-14 * np.max(np.abs(C[i // 3 * 3:i // 3 * 3 + 3]))]
    if convention == "spatial" or not np.any(moment):
        return C
    if np.linalg.cond(C[np.ix_(some, some)] / np.sqrt(np.outer(np.diag(C)[some], np.diag(C)[some]))) > 1e12:
        raise Refused(f"{name}: {convention} moments where turns depend on each other are not within the deriving program")
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
    """{node: [6]}: displacements and turns of one linear step, loads and motions at 1."""
    if any(callable(kind) for place in scene.places.values() if place.support for kind in place.support.kinds[3:]) or any(p.support and (p.support.vector or p.support.sequence) for p in scene.places.values()):
        raise Refused("a linear analysis with prescribed turns is not within the deriving program")
    for loads in [m.beam for m in scene.net.members if m.beam.carries] + [load for place in scene.places.values() if place.support for load in place.support.loads]:
        loads.stays = True
    matrix, right = scene.net.system(1.0)
    step, out = splu(matrix).solve(right), {}
    for name, place in scene.places.items():
        d = step[place.body.at:place.body.at + 6] * np.array([scene.length] * 3 + [1.0] * 3)
        d[:3] += np.cross(d[3:], place.offset)
        out[name] = d
    return out


class Question:
    """A quantity of the scene: kind, what of it, and how it is told."""

    def __init__(self, name, entry):
        only(entry, name, (*KINDS, "unit", "tolerance", "order", "near_zero", "factor", "offset", "prediction"))
        self.name, self.entry = name, entry
        self.kind = next(kind for kind in KINDS if kind in entry)
        self.of = entry[self.kind]
        only(self.of, name, ("analysis", "at", "take", "node", "component", "row", "column", "motion"))
        if self.of.get("take") == "curve":
            raise Refused(f"{name}: a curve is not within the deriving program")

    def told(self, value):
        return value * number(self.entry.get("factor", "1"), self.name) + number(self.entry.get("offset", "0"), self.name)

    def reduced(self, stations, values):
        take = self.of.get("take", "last")
        if "at" in self.of:
            at = number(self.of["at"], self.name)
            return next(v for s, v in zip(stations, values) if abs(s - at) <= 1e-12 * max(1, abs(at)))
        return {"last": lambda v: v[-1], "max": max, "min": min}[take](values)

    def of_state(self, scene, level):
        i = WORDS.index(self.of["component"]) if "component" in self.of else None
        if self.kind == "displacement":
            return scene.displacement(self.of["node"], i)
        if self.kind == "reaction":
            return reaction(scene, self.of["node"], i, level)
        return scene.motion[self.of["motion"]](level, scene.net.numbers)

    def scale(self, scene):
        """Of displacements and reactions in the network: what round-off is relative to."""
        turns = self.of.get("component", "ux")[0] == "r"
        if self.kind == "displacement":
            return 1.0 if turns else scene.length
        if self.kind == "reaction":
            return max(np.max(np.abs(body.load)) for body in scene.net.bodies) * scene.force * (scene.length if turns else 1.0)
        return 0.0

    def of_matrix(self, C):
        if self.kind == "compliance":
            return C[WORDS.index(self.of["row"]), WORDS.index(self.of["column"])]
        i = WORDS.index(self.of["component"])
        return 1 / C[i, i]


def analyses(scene, questions, grid, scales=None):
    """{quantity: value or the Refused that says why not} on one grid; scales: filled with {quantity: its scale}."""
    out, scales = {}, {} if scales is None else scales

    def answer(asked, stations, states):
        for q in asked:
            out[q.name] = q.told(q.reduced(stations, [state[q.name] for state in states]))

    def try_one(name):
        entry = scene["analyses"][name]
        kind = next(iter(entry))
        asked = [q for q in questions if q.of["analysis"] == name]
        if kind == "linear":
            network = SceneNetwork(scene, *grid)
            found = linear(network)
            scales.update({q.name: abs(found[q.of["node"]]).max() for q in asked})
            answer(asked, [1.0], [{q.name: found[q.of["node"]][WORDS.index(q.of["component"])] for q in asked}])
        elif kind == "static":
            after = [n for n, a in scene["analyses"].items() if a.get("compliance", {}).get("about") == name]
            about = {n: [q for q in questions if q.of["analysis"] == n] for n in after}
            if not asked and not any(about.values()):
                return
            path = Path(scene, name, grid)

            def ask(state, level):
                found = {q.name: q.of_state(state, level) for q in asked}
                scales.update({q.name: q.told(q.scale(state)) - q.told(0.0) for q in asked})
                for n, some in about.items():
                    if some:
                        C = compliance(state, level, scene["analyses"][n]["compliance"], n)
                        found.update({q.name: q.of_matrix(C) for q in some})
                return found
            states = path.walk(ask)
            answer(asked + [q for some in about.values() for q in some], path.stations, states)
        elif kind == "compliance" and "about" not in entry[kind] and asked:
            C = compliance(SceneNetwork(scene, *grid), 0.0, entry[kind], name)
            answer(asked, [0.0], [{q.name: q.of_matrix(C) for q in asked}])
        elif kind != "compliance" and asked:
            raise Refused(f"{name}: analyses of the kind '{kind}' are not within the deriving program")
    for name in scene["analyses"]:
        try:
            try_one(name)
        except Refused as why:
            for q in questions:
                if q.of["analysis"] == name or scene["analyses"][q.of["analysis"]].get("compliance", {}).get("about") == name:
                    out[q.name] = why
    return out


def solve(scene):
    """Yields (quantity, value, unit, uncertainty, convention), and (quantity, Refused) where it is beyond the program."""
    questions = []
    for name, entry in scene["quantities"].items():
        try:
            questions.append(Question(name, entry))
        except Refused as why:
            yield name, why
    found, scales = [], {}
    for grid in GRIDS:
        found.append(analyses(scene, questions, grid, scales))
        if len(found) > 1 and all(near(found[-1][q.name], found[-2][q.name], abs(scales.get(q.name, 0.0))) for q in questions):
            break
    for q in questions:
        value = found[-1][q.name]
        if isinstance(value, Refused):
            yield q.name, value
            continue
        uncertainty = max(2 * abs(value - found[-2][q.name]), ROUND_OFF * abs(value), NOTHING * abs(scales.get(q.name, 0.0)))
        yield q.name, value, q.entry.get("unit", "1"), uncertainty, moments_of(scene, q)


def near(a, b, scale):
    return isinstance(a, Refused) or abs(a - b) <= max(AGREEMENT * abs(a), NOTHING * scale)


def moments_of(scene, question):
    if question.kind not in ("stiffness", "compliance"):
        return ""
    return scene["analyses"][question.of["analysis"]]["compliance"].get("moments", "spatial")


def main(arguments):
    text = pathlib.Path(arguments[0]).read_text(encoding="utf-8") if arguments else sys.stdin.read()
    values = 0
    try:
        for row in solve(scene_text.read(text)):
            if isinstance(row[1], Refused):
                print(row[1], file=sys.stderr)
                continue
            name, value, unit, uncertainty, convention = row
            values += 1
            print(f"{name}\t{value:.17g}\t{unit}\t{uncertainty:.1e}\t{convention}\t{SOURCE}", flush=True)
    except Refused as why:
        print(why, file=sys.stderr)
        return 3
    return 0 if values else 3


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
