"""A scene as data, its mesh, and what a driver returns. All values are in SI units and all vectors in global axes."""
from __future__ import annotations

import bisect
import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

COMPONENTS = ("ux", "uy", "uz", "rx", "ry", "rz")
Vector = Sequence[float]
Matrix = Sequence[Sequence[float]]


class Refused(Exception):
    """Raised if a peer does not support a part of the scene. The text names this part, then the reason: "warping: ..."."""


class Failed(Exception):
    """Raised if a peer found no solution."""


@dataclasses.dataclass(frozen=True)
class Element:
    """An element of a peer. offers: the physics that it models, in the words of the protocol. analyses: keys of scene files.
    order: number of nodes minus 1. keys: "nodes.mass", "members.release" and others that the driver reads in `raw`."""
    summary: str
    offers: frozenset[str] = frozenset()
    analyses: frozenset[str] = frozenset()
    order: int = 1
    keys: frozenset[str] = frozenset()


@dataclasses.dataclass(frozen=True)
class Node:
    """A node of the scene. hold: fixed components. drive: {component: name of the motion}."""
    name: str
    at: Vector
    hold: frozenset[str]
    drive: Mapping[str, str]
    raw: Mapping[str, Any]


@dataclasses.dataclass(frozen=True)
class Section:
    """Constants about the centroid and the principal axes y and z. GA: shear stiffnesses along y and z [N], infinite if
    the section is rigid in shear or the scene omits shear. rho_A [kg/m]; rho_I: rotary inertias about x, y, z [kg m]."""
    name: str
    raw: Mapping[str, Any]
    EA: float
    GA: tuple[float, float]
    GIt: float
    EIy: float
    EIz: float
    rho_A: float
    rho_I: tuple[float, float, float]

    def stiffness(self, most: float = math.inf) -> list[list[float]]:
        """Returns the matrix that maps (gx, gy, gz, kx, ky, kz) to (N, Qy, Qz, Mx, My, Mz) about the centroid. most: value that
        replaces infinite shear stiffnesses."""
        if "stiffness" in self.raw:
            return [list(row) for row in self.raw["stiffness"]]
        diagonal = (self.EA, *(min(k, most) for k in self.GA), self.GIt, self.EIy, self.EIz)
        return [[diagonal[i] if i == k else 0.0 for k in range(6)] for i in range(6)]


@dataclasses.dataclass(frozen=True)
class Member:
    """A member: a line of constant curvature [1/m, in section axes] from `start`. axes: x, y, z at the start in columns. taper:
    sections along a tapered member; empty: the section is constant."""
    name: str
    ends: tuple[str, str]
    section: Section
    start: Vector
    axes: Matrix
    length: float
    curvature: Vector
    raw: Mapping[str, Any]
    taper: tuple[Section, ...] = ()

    def section_at(self, x: float) -> Section:
        """Returns the section at a fraction of the length, interpolated by a cubic between the equally spaced sections of
        `taper`."""
        last = len(self.taper) - 1
        first = min(max(math.floor(x * last) - 1, 0), last - 3)
        weights = [math.prod((x * last - j) / (i - j) for j in range(first, first + 4) if j != i) for i in range(first, first + 4)]
        some = self.taper[first:first + 4]

        def mean(of: Callable[[Section], float]) -> float:
            values = [of(s) for s in some]
            return math.inf if math.inf in values else sum(w * v for w, v in zip(weights, values))

        return dataclasses.replace(
            some[1], EA=mean(lambda s: s.EA), GA=(mean(lambda s: s.GA[0]), mean(lambda s: s.GA[1])),
            GIt=mean(lambda s: s.GIt), EIy=mean(lambda s: s.EIy), EIz=mean(lambda s: s.EIz), rho_A=mean(lambda s: s.rho_A),
            rho_I=(mean(lambda s: s.rho_I[0]), mean(lambda s: s.rho_I[1]), mean(lambda s: s.rho_I[2])))

    def at(self, s: float) -> tuple[list[float], list[list[float]]]:
        """Returns the position and the axes (columns) at the arc length s."""
        k = self.curvature
        turn = rotation([c * s for c in k])
        w = math.sqrt(sum(c * c for c in k))
        first, second = cross(k, (1, 0, 0)), cross(k, cross(k, (1, 0, 0)))
        angle = w * s
        a = (1 - math.cos(angle)) / w**2 if angle > 1e-4 else s * s / 2 * (1 - angle**2 / 12)
        b = (angle - math.sin(angle)) / w**3 if angle > 1e-2 else s**3 / 6 * (1 - angle**2 / 20)
        along = [s * (i == 0) + a * first[i] + b * second[i] for i in range(3)]
        step = times(self.axes, along)
        return [p + q for p, q in zip(self.start, step)], product(self.axes, turn)


@dataclasses.dataclass(frozen=True)
class Load:
    """A load. kind: force, moment, distributed, ... vector: value for the factor 1. node, member: the load acts on one of the
    two; the other is None."""
    name: str
    kind: str
    vector: Vector
    node: str | None
    member: str | None
    follower: bool
    raw: Mapping[str, Any]


@dataclasses.dataclass(frozen=True)
class Spring:
    """A spring between a node and the ground (begin is None) or another node at the same position. stiffness: stiffnesses of the
    six components [N/m, N m]."""
    name: str
    begin: str | None
    end: str
    stiffness: Vector


@dataclasses.dataclass(frozen=True)
class Analysis:
    """An analysis. kind: linear, static, compliance, buckling, modal, ... about: the analysis that provides the state. step:
    largest time step of a motion [s]; the driver divides the time up to the last station equally."""
    name: str
    kind: str
    stations: tuple[float, ...]
    about: str | None
    raw: Mapping[str, Any]
    step: float = 0.0


@dataclasses.dataclass(frozen=True)
class Quantity:
    """A quantity. Its value is the extracted value times `factor`, plus `offset`. raw_entry: the whole entry of the file;
    raw: the part named `kind`."""
    name: str
    kind: str
    analysis: str
    unit: str
    factor: float
    offset: float
    raw: Mapping[str, Any]
    x: Mapping[str, Any]
    raw_entry: Mapping[str, Any]


@dataclasses.dataclass(frozen=True)
class MeshNode:
    """A node of the mesh. name: the node of the scene, or None inside a member."""
    number: int
    name: str | None
    at: Vector


@dataclasses.dataclass(frozen=True)
class MeshElement:
    """An element of the mesh. nodes: the order + 1 node numbers along the member. R: axes x (along the chord), y and z in
    columns. frames: axes of the member at each node. length: length along the line of the member. begin, end: ends of the
    element as fractions of the member."""
    member: Member
    nodes: tuple[int, ...]
    R: Matrix
    frames: tuple[Matrix, ...]
    length: float
    begin: float
    end: float


@dataclasses.dataclass(frozen=True)
class Mesh:
    """A mesh. The nodes of the scene come first, in the order of the scene."""
    nodes: tuple[MeshNode, ...]
    elements: tuple[MeshElement, ...]
    node_of: Mapping[str, int]


@dataclasses.dataclass
class State:
    """Displacements and rotation vectors, and forces of supports on the structure at fixed and driven components, for each
    node of the scene. A value that the program does not compute is None. compliance: 6 x 6 matrix of the node of a
    compliance analysis. In motions, rate: velocities along fixed axes, and angular velocities along the axes of the node;
    energy: the energies by the names kinetic, strain and energy (their sum)."""
    u: Mapping[str, Sequence[float | None]] = dataclasses.field(default_factory=dict)
    reaction: Mapping[str, Sequence[float | None]] = dataclasses.field(default_factory=dict)
    compliance: Sequence[Sequence[float | None]] | None = None
    rate: Mapping[str, Sequence[float | None]] = dataclasses.field(default_factory=dict)
    energy: Mapping[str, float] = dataclasses.field(default_factory=dict)


@dataclasses.dataclass
class PathPoint:
    """A point of an equilibrium path. values: coordinates that describe the path, the control coordinate first. limit: True
    if the load factor has an extremum at the point."""
    factor: float
    values: Sequence[float]
    state: State
    limit: bool = False


@dataclasses.dataclass
class Answer:
    """Results of an analysis: the states at its stations (linear: one state) or, in motions, at `times`; critical factors or
    frequencies [Hz] in ascending order, with a zero for each rigid-body motion. families: families of the modes, from
    _modes.py; may be empty. iterations: number of equation systems solved. A continuation has its path and, in `stops`, the
    points at the values of the control coordinate."""
    states: Sequence[State] = ()
    factors: Sequence[float] = ()
    frequencies: Sequence[float] = ()
    families: Sequence[str] = ()
    iterations: int = 0
    times: Sequence[float] = ()
    path: Sequence[PathPoint] = ()
    stops: Sequence[PathPoint] = ()


class Model:
    """A model of a peer. unknowns: number of free degrees of freedom. settings: text on the solver, the tolerance, the steps
    and the parts that are made rigid."""
    unknowns: int = 0
    settings: str = ""

    def solve(self, analysis: Analysis) -> Answer:
        """Solves an analysis. Called once for each analysis, in the order of the scene, while time is measured."""
        raise NotImplementedError


class LoadSteps:
    """Load steps along the path: small at first, doubled after success, halved after a failure, and limited so that no node
    turns by much more than half a radian in a step, because Newton's method may then find another equilibrium. Later
    rounds, with the same key, repeat the steps that succeeded."""
    _FIRST, _LEAST, _TURN, _JUMP = 1 / 16, 1e-4, 0.5, 2.0
    _known: dict[Any, list[float]] = {}

    def __init__(self, key: Any, last: float) -> None:
        self.key, self.last = key, last
        self.known, self.taken, self.step = list(self._known.get(key, ())), list[float](), self._FIRST * last

    def next(self, most: float) -> float:
        """Returns the next step, at most `most`."""
        return self.known.pop(0) if self.known else min(self.step, most)

    def failed(self, step: float) -> None:
        """Halves the step. Raises Failed if it is too small."""
        self.step, self.known = step / 2, []
        if self.step < self._LEAST * self.last:
            raise Failed(f"Newton's method does not converge after path parameter {sum(self.taken):g}")

    def done(self, step: float, turn: float) -> None:
        """Records a step that succeeded. turn: largest rotation of a node in the step [rad]. Raises Failed if this rotation
        is so large that the structure jumped to another equilibrium."""
        self.taken.append(step)
        if turn > self._JUMP:
            raise Failed(f"a node turns by {turn:.2g} rad in the step to path parameter {sum(self.taken):g}: Newton's method found "
                         "another equilibrium")
        self.step = step * min(2.0, self._TURN / turn if turn > 0 else 2.0)
        self._known[self.key] = self.taken


@dataclasses.dataclass(frozen=True)
class Scene:
    """A scene as `beamwork scene --format json` writes it. raw: all of its data. of: name of the case with its parameters,
    for an import."""
    name: str
    of: str
    physics: frozenset[str]
    plane: str | None
    nodes: Mapping[str, Node]
    sections: Mapping[str, Section]
    members: Mapping[str, Member]
    loads: tuple[Load, ...]
    motions: Mapping[str, Mapping[str, Any]]
    analyses: Mapping[str, Analysis]
    quantities: tuple[Quantity, ...]
    meanings: Mapping[str, str]
    raw: Mapping[str, Any]
    springs: tuple[Spring, ...] = ()

    def held_at(self, node: MeshNode) -> set[str]:
        """Returns the fixed components of a node of the mesh, which include those out of the plane of a plane scene."""
        held = set(self.nodes[node.name].hold) if node.name is not None else set()
        if self.plane is not None:
            normal = ({"x", "y", "z"} - set(self.plane)).pop()
            held |= {"u" + normal} | {"r" + axis for axis in self.plane}
        return held

    def load_factor(self, load: Load, path: float) -> float:
        if "factor" in load.raw:
            return interpolated(load.raw["path"], load.raw["factor"], path)
        return path

    def motion_value(self, name: str, path: float) -> float:
        """Returns the value of a prescribed motion at a path parameter. Functions of time are 0 (see read.py)."""
        motion = self.motions[name]
        if "path" not in motion:
            return 0.0
        return interpolated(motion["path"], motion["value"], path)

    def require_released(self, analysis: Analysis) -> None:
        """Raises Refused unless a compliance analysis releases exactly the driven components of its node. Drivers that can
        release only these components call this function."""
        node, released = self.nodes[analysis.raw["node"]], set(analysis.raw.get("released", ()))
        if released != set(node.drive):
            raise Refused(f"released: the driver frees the driven components of {node.name}, and no others")

    def length(self) -> float:
        return max(m.length for m in self.members.values())

    def mesh(self, n: int, order: int = 1) -> Mesh:
        """Returns the mesh with n elements for each member or, if loads divide the member, for each of its pieces."""
        nodes = [MeshNode(i, node.name, node.at) for i, node in enumerate(self.nodes.values())]
        numbers = {node.name: i for i, node in enumerate(self.nodes.values())}
        elements: list[MeshElement] = []
        for member in self.members.values():
            places = self._places(member, n)
            last = numbers[member.ends[0]]
            for i, (begin, end) in enumerate(zip(places, places[1:])):
                chain, frames, points = [last], [], []
                for k in range(order + 1):
                    at, frame = member.at((begin + (end - begin) * k / order) * member.length)
                    frames.append(frame)
                    points.append(at)
                    if k == 0:
                        continue
                    if k == order and i == len(places) - 2:
                        chain.append(numbers[member.ends[1]])
                    else:
                        chain.append(len(nodes))
                        nodes.append(MeshNode(len(nodes), None, at))
                last = chain[-1]
                own = dataclasses.replace(member, section=self.sections[_part(member, i)]) if member.taper else member
                elements.append(MeshElement(own, tuple(chain), triad(points[0], points[-1], frames), tuple(frames),
                                            (end - begin) * member.length, begin, end))
        return Mesh(tuple(nodes), tuple(elements), numbers)

    def divided(self, n: int) -> Scene:
        """Returns the scene with a section for each element of the mesh with n elements in tapered members."""
        made = {_part(member, i): dataclasses.replace(member.section_at((a + b) / 2), name=_part(member, i))
                for member in self.members.values() if member.taper
                for places in [self._places(member, n)] for i, (a, b) in enumerate(zip(places, places[1:]))}
        return dataclasses.replace(self, sections={**self.sections, **made})

    def _places(self, member: Member, n: int) -> list[float]:
        """Returns the ends of the elements as fractions of the member."""
        breaks, each = self._breaks(member), int(member.raw.get("divisions", n))
        return [a + (b - a) * i / each for a, b in zip(breaks, breaks[1:]) for i in range(each)] + [1.0]

    def _breaks(self, member: Member) -> list[float]:
        at = {float(load.raw[key]) for load in self.loads if load.member == member.name
              for key in ("where", "from", "to") if key in load.raw}
        out = [0.0]
        for place in sorted(at):
            if place > out[-1] + 1e-3 and place < 1 - 1e-3:
                out.append(place)
        return out + [1.0]


def _part(member: Member, i: int) -> str:
    """Returns the name of the section of an element of a tapered member."""
    return f"{member.name} {i}"


def interpolated(at: Sequence[float], value: Sequence[float], x: float) -> float:
    """Returns the value at x of the piecewise linear function through the points, which is extrapolated beyond its
    ends."""
    i = min(max(bisect.bisect_right(at, x), 1), len(at) - 1)
    return value[i - 1] + (value[i] - value[i - 1]) * (x - at[i - 1]) / (at[i] - at[i - 1])


def cross(a: Vector, b: Vector) -> list[float]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def times(A: Matrix, v: Vector) -> list[float]:
    return [sum(a * b for a, b in zip(row, v)) for row in A]


def transposed(A: Matrix) -> list[list[float]]:
    return [list(row) for row in zip(*A)]


def product(A: Matrix, B: Matrix) -> list[list[float]]:
    return transposed([times(A, column) for column in transposed(B)])


def unit(v: Vector) -> list[float]:
    size = math.sqrt(sum(x * x for x in v))
    return [x / size for x in v]


def rotation(v: Vector) -> list[list[float]]:
    angle = math.sqrt(sum(x * x for x in v))
    if angle == 0:
        return [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    x, y, z = (c / angle for c in v)
    c, s = math.cos(angle), math.sin(angle)
    d = 1 - c
    return [[c + x * x * d, x * y * d - z * s, x * z * d + y * s], [y * x * d + z * s, c + y * y * d, y * z * d - x * s],
            [z * x * d - y * s, z * y * d + x * s, c + z * z * d]]


def rotation_vector(R: Matrix) -> list[float]:
    """Returns the rotation vector of a matrix, with an angle up to pi."""
    trace = R[0][0] + R[1][1] + R[2][2]
    a = max(range(3), key=lambda i: R[i][i])
    if trace >= R[a][a]:
        q = [1 + trace, R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1]]
    else:
        b, c = (a + 1) % 3, (a + 2) % 3
        q = [R[c][b] - R[b][c], 0, 0, 0]
        q[1 + a], q[1 + b], q[1 + c] = 1 + 2 * R[a][a] - trace, R[a][b] + R[b][a], R[a][c] + R[c][a]
    sine = math.sqrt(q[1]**2 + q[2]**2 + q[3]**2)
    sign = 1 if q[0] >= 0 else -1
    scale = sign * 2 * math.atan2(sine, abs(q[0])) / sine if sine > 0 else 0
    return [scale * x for x in q[1:]]


def triad(begin: Vector, end: Vector, frames: Sequence[Matrix]) -> list[list[float]]:
    x = unit([b - a for a, b in zip(begin, end)])
    y = [frames[0][i][1] + frames[-1][i][1] for i in range(3)]
    along = sum(a * b for a, b in zip(x, y))
    y = unit([b - along * a for a, b in zip(x, y)])
    return transposed([x, y, cross(x, y)])
