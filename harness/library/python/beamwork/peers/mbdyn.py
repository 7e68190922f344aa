"""MBDyn, a program on PATH: geometrically exact beams of two and three nodes; statics. Each analysis is a run of the program
on an input file, in which the time is the path."""
from __future__ import annotations

import math
import pathlib
import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterable, Sequence

from ._loads import KEYS, nodal, vectors
from .data import (COMPONENTS, Analysis, Answer, Element, Failed, Load, Mesh, Model, Node, Refused, Scene, State, Vector,
                   rotation_vector, times)

NAME, PROGRAM, LICENCE = "mbdyn", "MBDyn", "GPL-2.0"
HOMEPAGE = "https://www.mbdyn.org"
REQUIRES = ()
_OFFERS = frozenset({"shear", "large rotations", "coupled section"})
_KEYS = KEYS | {"loads.follower", "nodes.part_of", "nodes.rotation", "plane"}
ELEMENTS = {
    "beam3": Element("geometrically exact, 3 nodes", _OFFERS, frozenset({"static", "compliance"}), 2, _KEYS),
    "beam2": Element("geometrically exact, 2 nodes", _OFFERS, frozenset({"static", "compliance"}), 1, _KEYS),
}
_RIGID = 1e6  # shear stiffness of sections that are rigid in shear, over EI/length^2
_MOST = 1536  # steps of a path
_SHORT = 1e-6  # duration of a step in which nothing moves, relative to the time between stations
_Rows = list[dict[int, list[float]]]
_Tangent = tuple[float, list[tuple[int, int, float]]]  # factor of stiffnesses, and entries of the matrix
_known: dict[tuple[str, str, int, str], int] = {}  # steps between stations with which paths were solved
_TURN = 0.7  # [rad] with a larger rotation of a node in a step, Newton's method may find another equilibrium


def _program() -> str:
    found = shutil.which("mbdyn")
    if found is None:
        raise ImportError("there is no program mbdyn on PATH")
    return found


def version() -> str:
    told = subprocess.run([_program(), "--version"], capture_output=True, text=True, check=False)
    found = re.search(r"MBDyn - .* (\S+)\n", told.stdout + told.stderr)
    return found.group(1) if found else "unknown"


def _list(values: Iterable[float]) -> str:
    return ", ".join(f"{v:.17g}" for v in values)


def _matrix(R: Sequence[Vector]) -> str:
    return "matr, " + _list(x for row in R for x in row)


class Beams(Model):
    """The input file. Every node has the axes of the scene, and the beams their axes relative to the nodes."""

    def __init__(self, scene: Scene, name: str, mesh: Mesh) -> None:
        self.scene, self.name, self.mesh = scene, name, mesh
        self.length = scene.length()
        self.force = min(min(s.EIy, s.EIz) for s in scene.sections.values()) / self.length**2
        self.owner = {number: self._owner(number) for number in range(len(mesh.nodes))}
        self.labels = sorted(set(self.owner.values()))
        self.joints, held = dict[str, int](), 0
        self.tangents: dict[str, list[_Tangent]] = {}  # of analyses, at their stations
        for node in scene.nodes.values():
            held += self._held(node)
        self.unknowns = 6 * len(self.labels) - held
        self.settings = ("initial value problem with static nodes, residual below 1e-9 of the largest force, one step to each "
                         "station, more where this fails; compliances from the tangents of eigenanalysis; rigid in shear: "
                         f"GA = {_RIGID:g} EI/L^2")
        self.loads = [(load, nodal(load, mesh, scene)) for load in scene.loads]
        for load in scene.loads:
            if load.follower and load.kind not in ("force", "moment"):
                raise Refused(f"follower: {load.name} acts along a member")

    def _owner(self, number: int) -> int:
        """Returns the node to which a node of the mesh is rigidly connected, or the node itself."""
        name = self.mesh.nodes[number].name
        to = self.scene.nodes[name].raw.get("part_of") if name is not None else None
        return number if to is None else self._owner(self.mesh.node_of[to])

    def _held(self, node: Node) -> int:
        """Checks the components that the joint at a node fixes, and returns their number."""
        if not self._components(node):
            return 0
        if "part_of" in node.raw:
            raise Refused(f"part_of: the driver does not support nodes that are part of a body and have supports ({node.name})")
        rotations = [c for c in self._components(node) if c[0] == "r"]
        if len(rotations) == 1 and not self._planar("xyz".index(rotations[0][1])):
            raise Refused(f"hold: the driver does not hold one rotation of {node.name}")
        self.joints[node.name] = len(self.joints) + 1
        return len(self._components(node))

    def _components(self, node: Node) -> set[str]:
        own = node.hold | set(node.drive) | (set(COMPONENTS[3:]) if "rotation" in node.raw else set())
        return set(own) | set(self.scene.held_at(self.mesh.nodes[self.mesh.node_of[node.name]]))

    def _planar(self, axis: int) -> bool:
        """Returns True if the scene lies and moves in the plane normal to an axis."""
        flat = len({round(node.at[axis] / self.scene.length(), 9) for node in self.mesh.nodes}) == 1
        normal = all(max(abs(e.R[axis][1]), abs(e.R[axis][2])) > 1 - 1e-9 for e in self.mesh.elements)
        inside = all(v == 0 or load.kind.endswith("moment") == (i == axis)
                     for load in self.scene.loads for vector in vectors(load) for i, v in enumerate(vector))
        return flat and normal and inside

    def _law(self, index: int) -> str:
        s = self.mesh.elements[index].member.section
        K = s.stiffness(_RIGID * max(s.EIy, s.EIz) / self.length**2)
        units = [self.force * self.length ** (int(i > 2) + int(k > 2)) for i in range(6) for k in range(6)]
        return "linear elastic generic, matr, " + _list(v / unit for v, unit in zip((v for row in K for v in row), units))

    def _beam(self, index: int) -> str:
        e = self.mesh.elements[index]
        ends = []
        for number, frame in zip(e.nodes, e.frames):
            owner = self.owner[number]
            arm = self._arm(number)
            ends.append(f"{owner + 1}, position, reference, node, {_list(arm)}, orientation, reference, node, {_matrix(frame)}")
        law = [self._law(index)] + ["same, same"] * (len(e.nodes) - 2)
        return f"  {self.name}: {index + 1}, {', '.join(ends)}, from nodes, {', '.join(law)};\n"

    def _joint(self, node: Node, curve: _Curve) -> str:
        held, zero = self._components(node), [(0.0, 0.0), (1.0, 0.0)]
        drives = [curve.of_motion(node.drive[c]) if c in node.drive else zero for c in COMPONENTS]
        if "rotation" in node.raw:
            drives[3:] = self._rotation(node, curve)
        return self._pin(node, held, drives)

    def _pin(self, node: Node, held: set[str], drives: list[list[tuple[float, float]]]) -> str:
        """Returns the joint that prescribes displacements and the rotation vector of a node."""
        drives = [*drives]
        drives[:3] = [[(t, v / self.length) for t, v in points] for points in drives[:3]]
        place = f"reference, global, {_list(x / self.length for x in node.at)}"
        axes = "position orientation, reference, global, eye, rotation orientation, reference, global, eye"

        def part(word: str, first: int) -> str:
            active = ", ".join("active" if c in held else "inactive" for c in COMPONENTS[first:first + 3])
            values = ", ".join(_drive(points) for points in drives[first:first + 3])
            return f"{word} constraint, {active}, component, {values}"

        return (f"  joint: {self._label(node.name)}, total pin joint, {self.mesh.node_of[node.name] + 1}, position, null, {axes}, "
                f"position, {place}, {axes}, {part('position', 0)}, {part('orientation', 3)};\n")

    def _rotation(self, node: Node, curve: _Curve) -> list[list[tuple[float, float]]]:
        """Returns the components of the rotation vector of a prescribed rotation."""
        raw = node.raw["rotation"]
        if "vector" in raw:
            return [curve.of_motion(name) if isinstance(name, str) else [(0.0, float(name)), (1.0, float(name))] for name in raw["vector"]]
        if len(raw["sequence"]) != 1:
            raise Refused(f"rotation: {node.name} rotates by a sequence of angles")
        one = raw["sequence"][0]
        points = curve.of_motion(one["angle"])
        size = math.hypot(*one["axis"])
        return [[(t, v * a / size) for t, v in points] for a in one["axis"]]

    def _force(self, label: int, load: Load, number: int, vector: Vector, curve: _Curve) -> list[str]:
        kind, drive, out = "follower" if load.follower else "absolute", _drive(curve.of_load(load)), list[str]()
        for word, part, unit in (("force", vector[:3], self.force), ("couple", vector[3:], self.force * self.length)):
            if any(v != 0 for v in part):
                place = f"position, {_list(self._arm(number))}, " if word == "force" else ""
                values = _list(v / unit for v in part)
                out.append(f"  {word}: {label + len(out)}, {kind}, {self.owner[number] + 1}, {place}{values}, {drive};\n")
        return out

    def _arm(self, number: int) -> list[float]:
        """Returns the vector from the body to a node of the mesh, in the units of the input file."""
        return [(a - b) / self.length for a, b in zip(self.mesh.nodes[number].at, self.mesh.nodes[self.owner[number]].at)]

    def _label(self, name: str) -> int:
        return self.joints.get(name, len(self.joints) + 1)

    def _deck(self, steps: int, curve: _Curve) -> str:
        forces: list[str] = []
        for load, at in self.loads:
            for number, vector in at.items():
                forces += self._force(len(forces) + 1, load, number, vector, curve)
        joints = [self._joint(self.scene.nodes[name], curve) for name in self.joints]
        beams = [self._beam(i) for i in range(len(self.mesh.elements))]
        nodes = [f"  structural: {k + 1}, static, {_list(x / self.length for x in self.mesh.nodes[k].at)}, eye, null, null;\n" for k in self.labels]
        return (f"begin: data;\n  problem: initial value;\nend: data;\nbegin: initial value;\n{curve.times(steps)}  max iterations: 40;\n"
                f"  tolerance: {self._tolerance():.3g};\n  method: implicit euler;\n  derivatives tolerance: 1e30;\n"
                "  linear solver: umfpack;\n  output: none;\nend: initial value;\nbegin: control data;\n"
                "  skip initial joint assembly;\n  default orientation: orientation matrix;\n  output precision: 16;\n"
                f"  structural nodes: {len(nodes)};\n  beams: {len(beams)};\n  joints: {len(joints)};\n  forces: {len(forces)};\n"
                f"end: control data;\nbegin: nodes;\n{''.join(nodes)}end: nodes;\nbegin: elements;\n"
                f"{''.join(joints + beams + forces)}end: elements;\n")

    def _tolerance(self) -> float:
        """Returns the tolerance of the residual: relative to the loads or, without loads, to the bending stiffness; above the
        rounding of forces."""
        sizes = [abs(v * f) / (self.force * (self.length if i > 2 else 1)) for load, at in self.loads for vector in at.values()
                 for i, v in enumerate(vector) for f in load.raw.get("factor", [1.0])]
        rigid = _RIGID * max(max(s.EIy, s.EIz) for s in self.scene.sections.values()) / self.length**2
        largest = max(min(k, rigid) if k in s.GA else k for s in self.scene.sections.values() for k in (s.EA, *s.GA))
        rounding = 3e-15 * len(self.mesh.elements) * largest / self.force
        return float(max(1e-9 * max(sizes) if any(sizes) else 1e-9, rounding))

    def solve(self, analysis: Analysis) -> Answer:
        if analysis.kind == "compliance":
            return self._compliance(analysis)
        count, matrices = len(analysis.stations), any(a.about == analysis.name for a in self.scene.analyses.values())
        key = self.scene.of, self.name, len(self.mesh.elements), analysis.name
        steps = _known.get(key, 1)
        while steps * count <= max(_MOST, count):
            answer = self._run(steps, analysis, matrices)
            if answer is not None:
                _known[key] = steps
                return answer
            steps *= 2
        raise Failed(f"MBDyn does not converge with {steps * count // 2} steps")

    def _run(self, steps: int, analysis: Analysis, matrices: bool) -> Answer | None:
        curve = _Curve(self.scene, analysis.stations, _SHORT if matrices else 0.0)
        found = self._output(steps, curve)
        if found is None:
            return None
        moved, forces, tangents, iterations = found
        if any(_angle(a[k], b[k]) > _TURN for a, b in zip(moved, moved[1:]) for k in a):
            return None
        self.tangents[analysis.name] = tangents
        each = len(moved) // len(analysis.stations)
        states = [self._state(moved[i], forces[i] if forces else {}) for i in range(each - 1, len(moved), each)]
        return Answer(states, iterations=iterations)

    def _output(self, steps: int, curve: _Curve) -> tuple[_Rows, _Rows, list[_Tangent], int] | None:
        """Runs the program. Returns the rows of nodes and joints after each step, the tangents at the stations if the curve
        has pauses, and the number of equation systems; None: the run did not converge."""
        count = len(curve.stations[1:]) * (steps + (curve.pause > 0))
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "deck").write_text(self._deck(steps, curve), encoding="ascii")
            done = subprocess.run([_program(), "-f", "deck", "-o", "out"], cwd=folder, capture_output=True, text=True, check=False)
            told = done.stdout + done.stderr
            found = re.search(r"total iterations: (\d+)", told)
            if done.returncode != 0 or found is None:
                if not any(word in told for word in ("Max iterations", "singular", "Step=")):
                    raise Failed(f"MBDyn: {told.strip().splitlines()[-1] if told.strip() else 'no output'}")
                return None
            moved = _blocks(pathlib.Path(folder, "out.mov"), len(self.labels))
            forces = _blocks(pathlib.Path(folder, "out.jnt"), len(self.joints))
            tangents = [_tangent(pathlib.Path(folder, f"out_{i}.m")) for i in range(len(curve.stations[1:]) if curve.pause > 0 else 0)]
        return (moved[-count:], forces[-count:], tangents, int(found.group(1))) if len(moved) >= count else None

    def _compliance(self, analysis: Analysis) -> Answer:
        """Computes compliances from the tangents of the program."""
        import numpy  # pylint: disable=import-outside-toplevel
        name = analysis.raw["node"]
        node, number = self.scene.nodes[name], self.mesh.node_of[name]
        if self.owner[number] != number:
            raise Refused(f"part_of: the driver does not compute compliances of nodes that are part of a body ({name})")
        iterations, tangents = 0, self.tangents.get(str(analysis.about), [])
        if analysis.about is None:
            found = self._output(1, _Curve(self.scene, (1.0, ), _SHORT, loaded=False))
            if found is None:
                raise Failed("MBDyn does not converge without loads")
            tangents, iterations = found[2:]
        size, first, row = 6 * len(self.labels), 6 * self.labels.index(number), 6 * len(self.labels)
        kept = list(range(size))
        for joint in self.joints:  # the rows of constraints follow those of nodes
            for c in sorted(self._components(self.scene.nodes[joint]), key=COMPONENTS.index):
                kept += [row] if joint != name or c not in analysis.raw.get("released", ()) else []
                row += 1
        units = numpy.array([self.length] * 3 + [1.0] * 3)
        states = []
        for scale, entries in tangents:
            K = numpy.zeros((row, row))
            for i, k, value in entries:
                K[i, k] = value / scale if i < size and k < size else value
            K = K[numpy.ix_(kept, kept)]
            C = numpy.linalg.solve(K, numpy.eye(len(kept))[:, first:first + 6])[first:first + 6]
            states.append(State(compliance=(C * numpy.outer(units, units) / (self.force * self.length)).tolist()))
        return Answer(states, iterations=iterations + len(states))

    def _state(self, moved: dict[int, list[float]], forces: dict[int, list[float]]) -> State:
        u: dict[str, list[float | None]] = {}
        reaction: dict[str, list[float]] = {}
        for name, number in self.mesh.node_of.items():
            owner = self.owner[number]
            row = moved[owner + 1]
            R = [row[3:6], row[6:9], row[9:12]]
            at = [self.length * (a + b) for a, b in zip(row[:3], times(R, self._arm(number)))]
            vector = rotation_vector(R)
            known = math.hypot(*vector) < 3
            u[name] = [*(a - b for a, b in zip(at, self.mesh.nodes[number].at)), *((v if known else None) for v in vector)]
            reaction[name] = [0.0] * 6
            if name in self.joints:
                held = self._components(self.scene.nodes[name])
                units = [self.force] * 3 + [self.force * self.length] * 3
                values = [-v * unit for v, unit in zip(forces[self.joints[name]][6:12], units)]
                reaction[name] = [v if c in held else 0.0 for c, v in zip(COMPONENTS, values)]
        return State(u, reaction)


class _Curve:
    """Values as functions of the time of the program. Without a pause, the stations are at the times 1, 2, 3 and so
    on."""

    def __init__(self, scene: Scene, stations: Sequence[float], pause: float = 0.0, loaded: bool = True) -> None:
        """Makes the functions. pause: time after each station in which loads and motions do not change."""
        self.scene, self.stations, self.pause, self.loaded = scene, [0.0, *stations], pause, loaded

    def times(self, steps: int) -> str:
        """Returns the part of the input file about times. A step in a pause begins and ends with the same state, on which
        the rotations of the program are then based, so that its tangent is exact. The program does not choose the
        first two steps."""
        count, step, pause = len(self.stations) - 1, 1 / steps, self.pause
        if pause == 0:
            return f"  initial time: 0.;\n  final time: {count}.;\n  time step: {step:.17g};\n"
        points = [(-pause / 2, pause), (-pause / 4, step)]
        begins = [k * (1 + pause) + 1 for k in range(count)]
        for t in begins:
            points += [(t - step / 2, step), (t - pause / 4, pause), (t + pause / 4, pause), (t + 0.75 * pause, step)]
        return (f"  initial time: {-2 * pause:.17g};\n  final time: {begins[-1] + 0.75 * pause:.17g};\n  time step: {pause:.17g};\n"
                f"  min time step: {pause / 100:.17g};\n  strategy: change, {_drive(points)};\n"
                f"  eigenanalysis: list, {count}, {_list(t + pause / 2 for t in begins)}, parameter, 1., output sparse matrices;\n")

    def _points(self, inner: Iterable[float]) -> list[tuple[float, float]]:
        """Returns the times and the path parameters of the stations and of the given path parameters."""
        out = []
        for k, (a, b) in enumerate(zip(self.stations, self.stations[1:])):
            begin = k * (1 + self.pause)
            out += [(begin + (p - a) / (b - a), p) for p in sorted({a, b, *(p for p in inner if a < p < b)})]
            out += [(begin + 1 + self.pause, b)] if self.pause > 0 and k < len(self.stations) - 2 else []
        return sorted(set(out))

    def of_load(self, load: Load) -> list[tuple[float, float]]:
        return [(t, self.scene.load_factor(load, p) * self.loaded) for t, p in self._points(load.raw.get("path", ()))]

    def of_motion(self, name: str) -> list[tuple[float, float]]:
        return [(t, self.scene.motion_value(name, p) * self.loaded) for t, p in self._points(self.scene.motions[name]["path"])]


def _tangent(file: pathlib.Path) -> _Tangent:
    """Returns the tangent in an output file of the eigenanalysis, which multiplies stiffnesses by a factor."""
    text = file.read_text(encoding="ascii")
    rows = [row.split() for row in text.split("Aplus = [")[1].split("]")[0].split(";") if row.strip()]
    return float(text.split("dCoef = ")[1].split(";")[0]), [(int(i) - 1, int(k) - 1, float(v)) for i, k, v in rows]


def _drive(points: Sequence[tuple[float, float]]) -> str:
    if all(v == 0 for _, v in points):
        return "const, 0."
    return f"piecewise linear, {len(points)}, " + ", ".join(f"{t:.17g}, {v:.17g}" for t, v in points)


def _angle(a: Sequence[float], b: Sequence[float]) -> float:
    """Returns the angle between the rotations of two rows of the output."""
    return math.acos(max(-1.0, min(1.0, (sum(x * y for x, y in zip(a[3:12], b[3:12])) - 1) / 2)))


def _blocks(file: pathlib.Path, size: int) -> _Rows:
    """Returns the rows of an output file by label, for each output."""
    if size == 0:
        return []
    rows = [line.split() for line in file.read_text(encoding="ascii").splitlines()]
    numbers = [(int(row[0]), [float(x) for x in row[1:]]) for row in rows]
    return [dict(numbers[i:i + size]) for i in range(0, len(numbers), size)]


def build(scene: Scene, element: str, mesh: Mesh) -> Model:
    return Beams(scene, element, mesh)
