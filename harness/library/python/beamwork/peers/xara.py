"""xara (a fork of OpenSees): geometrically exact frames of 2 to 4 nodes, and corotational frames."""

from __future__ import annotations

import importlib.metadata
import math
import sys
from collections.abc import Mapping, Sequence
from typing import Any

from ._loads import KEYS, THERMAL, nodal, require_known, vectors
from ._modes import diagonal_inertia, require_plain_mass, rigid_motions
from ._opensees_path import PathOfFrame
from ._opensees_springs import add_hinges, add_springs, reactions
from ._path import follow
from ._xara_buckling import buckling, moved_axis
from .data import COMPONENTS, Analysis, Answer, Element, Failed, Mesh, Model, Refused, Scene, State, Vector

NAME, PROGRAM, LICENCE = "xara", "xara", "BSD-2-Clause"
HOMEPAGE = "https://github.com/peer-open-source/xara"
REQUIRES = (
    'xara==0.0.46; python_version >= "3.12"',
    'opensees==0.1.32; python_version >= "3.12"',
)

_STATICS = frozenset({"linear", "static", "compliance"})
_OFFERS = frozenset({"shear", "haringx", "large rotations", "geometric"})
_KEYS = KEYS | THERMAL | {"springs", "springs.from", "members.release", "nodes.mass", "nodes.inertia", "plane"}
ELEMENTS = {
    "exact": Element(
        "ExactFrame with 2 nodes: geometrically exact, linear interpolation",
        order=1,
        offers=_OFFERS,
        analyses=_STATICS | {"buckling"},
        keys=_KEYS,
    ),
    "exact_3": Element(
        "ExactFrame with 3 nodes on a straight line",
        order=2,
        offers=_OFFERS,
        analyses=_STATICS,
        keys=_KEYS,
    ),
    "exact_4": Element(
        "ExactFrame with 4 nodes on a straight line",
        order=3,
        offers=_OFFERS,
        analyses=_STATICS,
        keys=_KEYS,
    ),
    "force": Element(
        "ForceFrame: force interpolation, corotational (Corotational02), lumped mass; with shear,"
        " Engesser's theory",
        order=1,
        offers=_OFFERS | {"mass", "rotary inertia"},
        analyses=_STATICS | {"modal", "continuation", "buckling"},
        keys=_KEYS,
    ),
}

_STIFF = 1e6  # shear stiffness of a rigid section, over EI/L^2; 1e7 needs a hundred times the steps in roll_up
_LEAST_STEP = 1 / 512
_STEPS: dict[tuple[str, str, int, str], int] = {}  # last numbers of steps between stations with which paths converged


def version() -> str:
    if sys.version_info < (3, 12):
        raise ImportError("it requires Python 3.12 or later")
    found = importlib.metadata.version("xara")
    return f"{found} (opensees {importlib.metadata.version('opensees')})"


def build(scene: Scene, element: str, mesh: Mesh) -> Model:
    return Frame(scene, element, mesh)


def _unwrapped(vector: Any, last: Any) -> Any:
    """Returns the rotation vector of the same rotation that is nearest to `last`."""
    import numpy as np

    angle = float(np.linalg.norm(vector))
    if angle < 1e-12:
        axis = last / np.linalg.norm(last) if np.linalg.norm(last) > math.pi else None
        angle, vector = 0.0, np.zeros(3)
        if axis is None:
            return vector
    else:
        axis = vector / angle
    turns = round((float(axis @ last) - angle) / (2 * math.pi))
    return axis * (angle + 2 * math.pi * turns)


def _rotation_vector(quaternion: Any) -> Any:
    import numpy as np

    q = np.array(quaternion)
    if q[3] < 0:
        q = -q
    sine = float(np.linalg.norm(q[:3]))
    return q[:3] * (2 * math.atan2(sine, q[3]) / sine if sine > 0 else 2.0)


class Frame(Model):
    def __init__(self, scene: Scene, element: str, mesh: Mesh) -> None:
        self.scene, self.element, self.mesh = scene, element, mesh
        self.order = ELEMENTS[element].order
        self.size = max(math.dist(mesh.nodes[0].at, n.at) for n in mesh.nodes)
        self.rigid = False
        self.drives: dict[tuple[int, int], tuple[int, list[Any]]] = {}
        self.kept: dict[str, list[State]] = {}
        self.wanted = {
            a.about: a.raw["node"]
            for a in scene.analyses.values()
            if a.kind == "compliance" and a.about is not None
        }
        require_known(scene)
        self.model: Any = self.new()
        self.unknowns = sum(6 - len(self.scene.held_at(self.mesh.nodes[n])) for n in range(len(mesh.nodes)))
        self.settings = (
            f"Umfpack, Newton, NormDispIncr {self._tolerance():.0e}, steps halved where they fail"
            + ("" if element == "force" or self._planar() else ", at least 8 steps")
            + (", rigid in shear: GA = 1e6 EI/L^2 (3e-6 of a deflection)" if self.rigid else "")
        )

    def _tolerance(self) -> float:
        return 1e-8 * self.size

    def _least_steps(self, stations: int) -> int:
        """Returns the least number of steps between stations. In space, results of ExactFrame
        depend on the steps: by 1e-6 with 8 steps in the 45-degree bend."""
        return 1 if self.element == "force" or self._planar() else math.ceil(8 / stations)

    def _planar(self) -> bool:
        for i in range(3):
            inside = {"r" + "xyz"[i]} | {"u" + "xyz"[k] for k in range(3) if k != i}
            if (
                len({n.at[i] for n in self.mesh.nodes}) == 1
                and all(max(abs(e.R[i][1]), abs(e.R[i][2])) > 1 - 1e-9 for e in self.mesh.elements)
                and all(
                    vector[k] == 0 or load.kind.endswith("moment") == (k == i)
                    for load in self.scene.loads
                    for vector in vectors(load)
                    for k in range(3)
                )
                and all(inside.issuperset(n.drive) for n in self.scene.nodes.values())
            ):
                return True
        return False

    def _points(self) -> list[list[float]]:
        """Returns the positions of the nodes. Inner nodes are on the chord, as ExactFrame
        requires."""
        at = [list(map(float, n.at)) for n in self.mesh.nodes]
        for e in self.mesh.elements:
            first, last = at[e.nodes[0]], at[e.nodes[-1]]
            for k, inner in enumerate(e.nodes[1:-1], start=1):
                s = k / self.order
                at[inner] = [(1 - s) * a + s * b for a, b in zip(first, last)]
        return at

    def _section(self, model: Any, tag: int, section: Any, length: float, stretch: float) -> None:
        stiffness = (section.EIz, section.EIy)
        ga = [
            value if math.isfinite(value) else _STIFF * ei / length**2
            for value, ei in zip(section.GA, stiffness)
        ]
        self.rigid |= self.element != "force" and any(not math.isfinite(value) for value in section.GA)
        model.section(
            "ElasticFrame",
            tag,
            E=1.0,
            G=1.0,
            A=stretch * section.EA,
            Ay=stretch * ga[0],
            Az=stretch * ga[1],
            Iy=stretch * section.EIy,
            Iz=stretch * section.EIz,
            J=stretch * section.GIt,
        )

    def new(self, moved: Mapping[int, Vector] | None = None) -> Any:
        """Makes a model. moved: displacements and rotations of the nodes of a structure without stresses;
        None: the structure is undeformed."""
        import xara

        model = xara.Model(ndm=3, ndf=6, rotations="Iter")
        for number, at in enumerate(self._points()):
            model.node(number, tuple(a + b for a, b in zip(at, moved[number] if moved else (0, 0, 0))))
            held = self.scene.held_at(self.mesh.nodes[number])
            model.fix(number, *(int(c in held) for c in COMPONENTS))
        tags: dict[tuple[str, float], int] = {}
        ends = add_hinges(model, self.scene, self.mesh, moved)
        for number, e in enumerate(self.mesh.elements, start=1):
            key = (e.member.section.name if moved is None else str(number), e.member.length)
            z, stretch = moved_axis(e, moved) if moved else ([row[2] for row in e.R], 1.0)
            if key not in tags:
                tags[key] = len(tags) + 1
                self._section(model, tags[key], e.member.section, e.member.length, stretch)
            transform = "Identity" if self.element != "force" else "Corotational02"
            model.geomTransf(transform, number, tuple(map(float, z)))
            model.element(
                "ForceFrame" if self.element == "force" else "ExactFrame",
                number,
                ends[number - 1],
                section=tags[key],
                transform=number,
                shear=int(self.element != "force" or all(map(math.isfinite, e.member.section.GA))),
                **({"mass": e.member.section.rho_A} if self.element == "force" else {}),
            )
        add_springs(model, self.scene, self.mesh, moved)
        return model

    def _add_pattern(self, model: Any, tag: int, series: list[Any]) -> None:
        model.timeSeries(*series)
        model.pattern("Plain", tag, tag)

    def _drive(self, model: Any, number: int, dof: int) -> None:
        tag, series = self.drives[number, dof]
        self._add_pattern(model, tag, series)
        model.sp(number, dof + 1, 1.0, pattern=tag)

    def apply(self, model: Any, stations: Sequence[float], scale: float = 1.0) -> None:
        """Adds a separate pattern for each load and each driven component, with its values at the
        stations, which are the times 1, 2, 3 and so on. Without stations, the factor of a load is that at the
        path parameter 1."""
        times = [float(k) for k in range(max(len(stations), 1) + 1)]
        tag = 0

        def series(values: list[float]) -> list[Any]:
            return ["Path", tag, "-time", *times, "-values", 0.0, *(scale * v for v in values)]

        for load in self.scene.loads:
            tag += 1
            values = [float(self.scene.load_factor(load, p)) for p in stations or [1.0]]
            self._add_pattern(model, tag, series(values))
            for number, vector in nodal(load, self.mesh, self.scene).items():
                model.load(number, *vector, pattern=tag)
        for node in self.scene.nodes.values():
            for component, motion in node.drive.items():
                tag += 1
                values = [float(self.scene.motion_value(motion, p)) for p in stations or [1.0]]
                number, dof = self.mesh.node_of[node.name], COMPONENTS.index(component)
                self.drives[number, dof] = tag, series(values)
                self._drive(model, number, dof)

    def prepare(self, model: Any, algorithm: str = "Newton") -> None:
        model.system("Umfpack")
        model.numberer("RCM")
        model.constraints("Transformation")
        model.algorithm(algorithm)
        model.test("NormDispIncr", self._tolerance(), 20, 0)
        model.integrator("LoadControl", 1.0)
        model.analysis("Static")

    def solve(self, analysis: Analysis) -> Answer:
        if analysis.kind == "static":
            return self._static(analysis)
        if analysis.kind == "compliance":
            return self._compliance(analysis)
        if analysis.kind == "linear":
            return self._linear(analysis)
        if analysis.kind == "modal":
            return self._modal(analysis)
        if analysis.kind == "buckling":
            return buckling(self)
        if analysis.kind == "continuation":
            return follow(PathOfFrame(self, analysis), analysis, self.scene, (self.element, len(self.mesh.elements)))
        raise Refused(f"{analysis.kind}: this driver has no such analysis")

    def no_turns(self) -> dict[str, Any]:
        import numpy as np

        return {name: np.zeros(3) for name in self.mesh.node_of}

    def loaded_along_path(self) -> Any:
        """Returns the structure under loads that are proportional to the time."""
        model = self.new()
        for tag, load in enumerate(self.scene.loads, start=1):
            self._add_pattern(model, tag, ["Linear", tag])
            for number, vector in nodal(load, self.mesh, self.scene).items():
                model.load(number, *vector, pattern=tag)
        self.prepare(model)
        return model

    def _static(self, analysis: Analysis) -> Answer:
        turned = [motion for node in self.scene.nodes.values() for c, motion in node.drive.items() if c[0] == "r"]
        if self.element == "force" and any(self.scene.motion_value(name, p) != 0 for name in turned for p in analysis.stations):
            raise Refused("drive: prescribed rotations of nodes do not turn the transformation Corotational02")
        model, self.model = self.model, None
        if model is None:
            model = self.new()
        self.apply(model, analysis.stations)
        self.prepare(model)
        states: list[State] = []
        turns = self.no_turns()
        iterations = 0
        key = (self.scene.name, self.element, len(self.mesh.elements), analysis.name)
        step = 1.0 / _STEPS.get(key, self._least_steps(len(analysis.stations)))
        for station in range(len(analysis.stations)):
            time = float(station)
            while time < station + 1 - 1e-9:
                step = min(step, station + 1 - time)
                model.integrator("LoadControl", step)
                if model.analyze(1) != 0:
                    step /= 2
                    _STEPS[key] = max(_STEPS.get(key, 1), math.ceil(1 / step))
                    if step < _LEAST_STEP:
                        raise Failed(f"Newton's method fails at {time:.3g} of {len(analysis.stations)} stations")
                    continue
                time += step
                iterations += int(model.numIter())
                self.follow_turns(model, turns)
            states.append(self.state(model, turns))
            if analysis.name in self.wanted:
                states[-1].compliance = self._compliance_here(model, self.wanted[analysis.name])
        self.kept[analysis.name] = states
        return Answer(states=states, iterations=iterations)

    def follow_turns(self, model: Any, turns: dict[str, Any]) -> None:
        for name, last in turns.items():
            rotation = _rotation_vector(model.nodeRotation(self.mesh.node_of[name]))
            turns[name] = _unwrapped(rotation, last)

    def state(self, model: Any, turns: dict[str, Any]) -> State:
        model.reactions()
        numbers = self.mesh.node_of
        u = {name: [float(x) for x in (*model.nodeDisp(number)[:3], *turns[name])] for name, number in numbers.items()}
        return State(u=u, reaction=reactions(model, self.scene, self.mesh))

    def _compliance_here(self, model: Any, node: str) -> Any:
        """Returns the inverse of the tangent at the node. For this, the driven components of the
        node are released, and their reactions act as loads."""
        number = self.mesh.node_of[node]
        driven = [dof for n, dof in self.drives if n == number]
        if not driven:
            return self._inverse_at(model, number)
        model.reactions()
        reaction = reactions(model, self.scene, self.mesh)[node]
        for dof in driven:
            model.remove("loadPattern", self.drives[number, dof][0])
        load = [float(reaction[d]) if d in driven else 0.0 for d in range(6)]
        self._add_pattern(model, 1000, ["Constant", 1000])
        model.load(number, *load, pattern=1000)
        model.wipeAnalysis()
        self.prepare(model)
        model.integrator("LoadControl", 0.0)
        if model.analyze(1) != 0:
            raise Failed("the state with released components is not in equilibrium")
        out = self._inverse_at(model, number)
        model.remove("loadPattern", 1000)
        for dof in driven:
            self._drive(model, number, dof)
        model.wipeAnalysis()
        self.prepare(model)
        return out

    def tangent(self, model: Any) -> Any:
        """Returns the tangent stiffness matrix of all equations."""
        import numpy as np

        entries = np.array(model.eval("printA -ret -k 1.0").split(), dtype=float)
        return entries.reshape(math.isqrt(entries.size), -1)

    def _inverse_at(self, model: Any, number: int) -> Any:
        import numpy as np

        inverse = np.linalg.inv(self.tangent(model))
        dofs = model.nodeDOFs(number)
        return [
            [float(inverse[row, column]) if row >= 0 <= column else 0.0 for column in dofs]
            for row in dofs
        ]

    def _compliance(self, analysis: Analysis) -> Answer:
        self.scene.require_released(analysis)
        if analysis.about is not None:
            return Answer(states=self.kept[analysis.about])
        model = self.new()
        self.prepare(model)
        model.integrator("LoadControl", 0.0)
        if model.analyze(1) != 0:
            raise Failed("the undeformed state is not in equilibrium")
        number = self.mesh.node_of[analysis.raw["node"]]
        return Answer(states=[State(compliance=self._inverse_at(model, number))])

    def _linear(self, analysis: Analysis) -> Answer:
        """Makes one step of the linear algorithm. Reactions are computed by central differences of
        small loads."""
        import numpy as np

        def solved(scale: float, algorithm: str) -> Any:
            model = self.new()
            self.apply(model, [], scale)
            self.prepare(model, algorithm)
            if algorithm == "Newton":
                model.test("FixedNumIter", 5)
            if model.analyze(1) != 0:
                raise Failed("the linear equations cannot be solved")
            model.reactions()
            return model

        numbers = self.mesh.node_of
        whole = solved(1.0, "Linear")
        u = {name: np.array(whole.nodeDisp(n)) for name, n in numbers.items()}
        most = max(float(np.abs(v).max()) for v in u.values())
        small = min(1e-5 / most if most > 0 else 1.0, 1e-4 / self._axial_effect())
        up, down = solved(small, "Newton"), solved(-small, "Newton")
        above, below = (reactions(model, self.scene, self.mesh) for model in (up, down))
        reaction = {name: (np.array(above[name]) - np.array(below[name])) / (2 * small) for name in numbers}
        return Answer(
            states=[
                State(
                    u={name: v.tolist() for name, v in u.items()},
                    reaction={name: v.tolist() for name, v in reaction.items()},
                )
            ],
            iterations=1,
        )

    def _axial_effect(self) -> float:
        """Returns a bound of the axial forces divided by EI/L^2, and thus of the relative change of
        stiffnesses that they cause."""
        forces = [math.hypot(*v[:3]) for load in self.scene.loads for v in nodal(load, self.mesh, self.scene).values()]
        weakest = min(min(s.EIy, s.EIz) for s in self.scene.sections.values())
        return max(sum(forces) * self.size**2 / weakest, 1e-12)

    def _modal(self, analysis: Analysis) -> Answer:
        if self.element != "force":
            raise Refused("modal: ExactFrame has no mass matrix")
        asked = [
            int(q.raw.get("which", 0)) for q in self.scene.quantities if q.analysis == analysis.name
        ]
        require_plain_mass(self.scene)
        rigid = rigid_motions(self.scene, self.mesh)
        if rigid:
            raise Refused("modal: the eigenvalue solver of xara requires supports that hold the structure")
        model = self.new()
        bodies = {self.mesh.node_of[node.name]: node.raw for node in self.scene.nodes.values()}
        for number, inertia in diagonal_inertia(self.mesh, lambda s: s.rho_I, PROGRAM).items():
            raw = bodies.get(number, {})
            own = raw.get("inertia", (0.0, ) * 6)
            if any(own[3:]):
                raise Refused("inertia: nodes of xara have no products of inertia")
            model.mass(number, (*[float(raw.get("mass", 0))] * 3, *(a + float(b) for a, b in zip(inertia, own))))
        squares = model.eigen(max(asked, default=0) + 1)
        return Answer(frequencies=[math.sqrt(w) / (2 * math.pi) for w in squares if w > 0])
