"""Kratos: corotational beams of the StructuralMechanicsApplication."""

from __future__ import annotations

import importlib.metadata
import math
from collections.abc import Mapping, Sequence
from typing import Any

from ._kratos_buckling import buckling
from ._modes import families, require_plain_mass, rigid_motions, spectrum
from ._loads import KEYS, THERMAL, nodal, require_known
from .data import COMPONENTS, Analysis, Answer, Element, Failed, Mesh, MeshElement, Model, Refused, Scene, State, Vector, cross, unit

NAME, PROGRAM, LICENCE = "kratos", "Kratos", "BSD-4-Clause"
HOMEPAGE = "https://github.com/KratosMultiphysics/Kratos"
REQUIRES = (
    "KratosMultiphysics==10.4.4",
    "KratosStructuralMechanicsApplication==10.4.4",
    "KratosLinearSolversApplication==10.4.4",
)
ELEMENTS = {
    "corotational": Element(
        "CrBeamElement3D2N: corotational; linear analyses and modes by CrLinearBeamElement3D2N;"
        " with shear, Engesser's theory",
        order=1,
        offers=frozenset({"shear", "haringx", "large rotations", "geometric", "mass", "rotary inertia"}),
        analyses=frozenset({"linear", "static", "compliance", "modal", "buckling"}),
        keys=KEYS | THERMAL | {"plane", "modal.about"},
    ),
}

_TOLERANCE = 1e-10
_ROUND_OFF = 1e-14  # absolute tolerance of rotations, and of displacements divided by the length
_MOST_ITERATIONS = 100
_LEAST_STEP = 1 / 64
_TURN = 0.5  # [rad] largest rotation of a node in a step; with a larger one, Newton's method may find another equilibrium
_STEPS: dict[tuple[str, int, str], int] = {}  # last numbers of steps between stations with which paths converged


def version() -> str:
    return importlib.metadata.version("KratosStructuralMechanicsApplication")


def build(scene: Scene, element: str, mesh: Mesh) -> Model:
    return Frame(scene, mesh)


class Frame(Model):
    def __init__(self, scene: Scene, mesh: Mesh) -> None:
        self.scene, self.mesh = scene, mesh
        require_known(scene)
        self.kept: dict[str, Sequence[State]] = {}
        self.owners: list[Any] = []
        self.states_of: dict[str, Any] = {}  # the last states of static analyses
        self.wanted = {
            a.about: a.raw["node"]
            for a in scene.analyses.values()
            if a.kind == "compliance" and a.about is not None
        }
        self.driven = {
            (mesh.node_of[node.name], COMPONENTS.index(component)): motion
            for node in scene.nodes.values()
            for component, motion in node.drive.items()
        }
        self.held = {
            (number, COMPONENTS.index(c))
            for number in range(len(mesh.nodes))
            for c in self.scene.held_at(self.mesh.nodes[number])
        }
        self.unknowns = 6 * len(mesh.nodes) - len(self.held | set(self.driven))
        self.settings = (
            f"SparseLU, Newton, MixedGenericCriteria {_TOLERANCE:.0e}, steps halved where they fail"
        )
        self._import()
        self.model: Any = self.new("CrBeamElement3D2N")

    def _import(self) -> None:
        import KratosMultiphysics as km
        import KratosMultiphysics.LinearSolversApplication as solvers
        import KratosMultiphysics.StructuralMechanicsApplication as sm

        km.Logger.GetDefaultOutput().SetSeverity(km.Logger.Severity.WARNING)
        self.km, self.sm, self.solvers = km, sm, solvers
        self.displacements = [
            getattr(km, f"{kind}_{axis}") for kind in ("DISPLACEMENT", "ROTATION") for axis in "XYZ"
        ]
        self.reactions = [
            getattr(km, f"{kind}_{axis}")
            for kind in ("REACTION", "REACTION_MOMENT")
            for axis in "XYZ"
        ]
        self.forces = [
            getattr(sm, f"{kind}_{axis}") for kind in ("POINT_LOAD", "POINT_MOMENT") for axis in "XYZ"
        ]

    def _section(self, part: Any, tag: int, section: Any) -> None:
        """Sets areas and moments of area that give the stiffnesses with E = 1 and G = 1/2. Without
        effective areas, the element is rigid in shear."""
        km, sm = self.km, self.sm
        p = part.CreateNewProperties(tag)
        p.SetValue(km.YOUNG_MODULUS, 1.0)
        p.SetValue(km.POISSON_RATIO, 0.0)
        p.SetValue(km.DENSITY, section.rho_A / section.EA)
        p.SetValue(sm.CROSS_AREA, section.EA)
        p.SetValue(sm.I22, section.EIy)
        p.SetValue(sm.I33, section.EIz)
        p.SetValue(sm.TORSIONAL_INERTIA, 2 * section.GIt)
        for variable, value in zip((sm.AREA_EFFECTIVE_Y, sm.AREA_EFFECTIVE_Z), section.GA):
            if math.isfinite(value):
                p.SetValue(variable, 2 * value)
        p.SetValue(km.CONSTITUTIVE_LAW, sm.LinearElastic3DLaw())

    def new(self, element: str, moved: Mapping[int, Vector] | None = None) -> Any:
        """Makes a model. moved: displacements and rotations of nodes. Each element then has two separate nodes
        and rotates with them, without stresses and without a change of length."""
        km, sm = self.km, self.sm
        self.owner = km.Model()  # owns the model part
        part = self.owner.CreateModelPart("beams", 2)
        part.ProcessInfo.SetValue(km.DOMAIN_SIZE, 3)
        for variable in (
            km.DISPLACEMENT,
            km.ROTATION,
            km.REACTION,
            km.REACTION_MOMENT,
            sm.POINT_LOAD,
            sm.POINT_MOMENT,
            km.VOLUME_ACCELERATION,
            km.VELOCITY,
            km.ANGULAR_VELOCITY,
            km.ACCELERATION,
            km.ANGULAR_ACCELERATION,
        ):
            part.AddNodalSolutionStepVariable(variable)
        tags: dict[str, int] = {}
        for e in self.mesh.elements:
            section = e.member.section
            if section.name not in tags:
                tags[section.name] = len(tags) + 1
                self._section(part, tags[section.name], section)
        for number, node in enumerate(self.mesh.nodes if moved is None else (), start=1):
            part.CreateNewNode(number, *map(float, node.at))
        for number, e in enumerate(self.mesh.elements, start=1):
            p, y = part.GetProperties()[tags[e.member.section.name]], [float(row[1]) for row in e.R]
            own = [n + 1 for n in e.nodes]
            if moved is not None:
                own, y = [2 * number - 1, 2 * number], self._turned(part, number, e, moved)
            made = part.CreateNewElement(element, number, own, p)
            made.SetValue(km.LOCAL_AXIS_2, y)
        for u, r in zip(self.displacements, self.reactions):
            km.VariableUtils().AddDof(u, r, part)
        if moved is not None:
            return part
        first = part.GetProperties()[1]
        for number in range(1, len(self.mesh.nodes) + 1):
            part.CreateNewCondition("PointLoadCondition3D1N", 2 * number, [number], first)
            part.CreateNewCondition("PointMomentCondition3D1N", 2 * number + 1, [number], first)
        for number, dof in self.held | set(self.driven):
            part.Nodes[number + 1].Fix(self.displacements[dof])
        return part

    def _turned(self, part: Any, number: int, e: MeshElement, moved: Mapping[int, Vector]) -> list[float]:
        """Makes the nodes of an element that is turned with the nodes of the mesh, and returns its
        y axis."""
        begin, end = (self.mesh.nodes[k].at for k in e.nodes)
        u, v = (moved[k] for k in e.nodes)
        along = unit([b + q - a - p for a, b, p, q in zip(begin, end, u, v)])
        size = math.dist(begin, end)
        part.CreateNewNode(2 * number - 1, *map(float, begin))
        part.CreateNewNode(2 * number, *(float(a + size * x) for a, x in zip(begin, along)))
        y = [row[1] for row in e.R]
        return [float(a + (b + c) / 2) for a, b, c in zip(y, cross(u[3:], y), cross(v[3:], y))]

    def loads(self, p: float | None) -> dict[int, list[float]]:
        total: dict[int, list[float]] = {}
        for load in self.scene.loads:
            factor = float(self.scene.load_factor(load, 1.0 if p is None else p))
            for number, vector in nodal(load, self.mesh, self.scene).items():
                target = total.setdefault(number, [0.0] * 6)
                for i in range(6):
                    target[i] += factor * vector[i]
        return total

    def strategy(self, part: Any, linear: bool, most: int = _MOST_ITERATIONS) -> Any:
        km = self.km
        builder = km.ResidualBasedBlockBuilderAndSolver(self.solvers.SparseLUSolver())
        scheme = km.ResidualBasedIncrementalUpdateStaticScheme()
        if linear:
            strategy = km.ResidualBasedLinearStrategy(
                part, scheme, builder, True, False, False, False
            )
        else:
            length = self.scene.length()
            criterion = km.MixedGenericCriteria(
                [(km.DISPLACEMENT, _TOLERANCE, _ROUND_OFF * length), (km.ROTATION, _TOLERANCE, _ROUND_OFF)]
            )
            criterion.SetEchoLevel(0)
            strategy = km.ResidualBasedNewtonRaphsonStrategy(
                part, scheme, criterion, builder, most, True, False, True
            )
        strategy.SetEchoLevel(0)
        strategy.Initialize()
        return strategy

    def _set(self, part: Any, loads: Any, drives: Any) -> None:
        for number, vector in loads.items():
            for variable, value in zip(self.forces, vector):
                part.Nodes[number + 1].SetSolutionStepValue(variable, 0, value)
        for (number, dof), value in drives.items():
            part.Nodes[number + 1].SetSolutionStepValue(self.displacements[dof], 0, value)

    def run(self, part: Any, strategy: Any, loads: Any, drives: Any, check: bool = True, few: bool = False) -> bool:
        """Returns True if the state has converged and is in equilibrium. few: True if only equilibrium is
        required."""
        self._set(part, loads, drives)
        try:
            strategy.InitializeSolutionStep()
            strategy.Predict()
            converged = strategy.SolveSolutionStep()
            strategy.FinalizeSolutionStep()
        except RuntimeError:  # the matrix of a diverging iteration is singular
            return False
        return (bool(converged) or few) and (not check or self._balanced(part, loads))

    def _balanced(self, part: Any, loads: Any) -> bool:
        """Checks that reactions and loads are in equilibrium, because the criterion of increments also accepts
        NaN and states that are not in equilibrium."""
        sums, sizes = [0.0] * 3, 1e-300
        length = self.scene.length()
        for vector in loads.values():
            for i in range(3):
                sums[i] += vector[i]
                sizes += abs(vector[i]) + abs(vector[3 + i]) / length
        for number, dof in self.held | set(self.driven):
            if dof < 3:
                value = part.Nodes[number + 1].GetSolutionStepValue(self.reactions[dof])
                sums[dof] += value
                sizes += abs(value)
        return all(math.isfinite(x) and abs(x) <= 1e-5 * sizes for x in sums)

    def solve(self, analysis: Analysis) -> Answer:
        if analysis.kind == "static":
            return self._static(analysis)
        if analysis.kind == "linear":
            return self._linear()
        if analysis.kind == "compliance":
            return self._compliance(analysis)
        if analysis.kind == "buckling":
            return buckling(self)
        if analysis.kind == "modal":
            return self._modal(analysis)
        raise Refused(f"{analysis.kind}: this driver has no such analysis")

    def _static(self, analysis: Analysis) -> Answer:
        for (_, dof), motion in self.driven.items():
            if dof >= 3 and any(v != 0 for v in self.scene.motions[motion]["value"]):
                raise Refused("drive: elements of Kratos turn by less than a driven rotation, by a 24th of its cube in each step")
        key = (self.scene.name, len(self.mesh.elements), analysis.name)
        steps = _STEPS.get(key, 1)
        while True:
            part, self.model = self.model, None
            if part is None:
                part = self.new("CrBeamElement3D2N")
            answer = self._walk(part, analysis, steps)
            if answer is not None:
                self.kept[analysis.name] = answer.states
                self.states_of[analysis.name] = part
                self.owners.append(self.owner)
                return answer
            steps *= 2
            _STEPS[key] = steps
            if 1 / steps < _LEAST_STEP:
                del _STEPS[key]
                raise Failed("Newton's method fails or leaves loads and reactions unbalanced")

    def _walk(self, part: Any, analysis: Analysis, steps: int) -> Answer | None:
        """Follows the path. Returns None if a step fails. A failed step cannot be repeated from its start,
        because elements keep their rotations."""
        strategy = self.strategy(part, linear=False)
        loads: dict[int, list[float]] = {}
        drives: dict[tuple[int, int], float] = dict.fromkeys(self.driven, 0.0)
        states: list[State] = []
        iterations = 0
        for p in analysis.stations:
            last_loads, last_drives = loads, drives
            loads = self.loads(p)
            drives = {at: float(self.scene.motion_value(m, p)) for at, m in self.driven.items()}
            for k in range(1, steps + 1):
                s = k / steps
                zero = [0.0] * 6
                now = {
                    n: [(1 - s) * a + s * b for a, b in zip(last_loads.get(n, zero), vector)]
                    for n, vector in loads.items()
                }
                moved = {at: (1 - s) * last_drives[at] + s * drives[at] for at in drives}
                part.CloneTimeStep(float(len(states)) + s)
                before = self._rotations(part)
                if not self.run(part, strategy, now, moved) or any(
                    abs(a - b) > _TURN for a, b in zip(self._rotations(part), before)
                ):
                    return None
                iterations += int(part.ProcessInfo[self.km.NL_ITERATION_NUMBER])
            states.append(self._state(part))
            if analysis.name in self.wanted:
                states[-1].compliance = self._inverse(part, self.wanted[analysis.name])
        return Answer(states=states, iterations=iterations)

    def _rotations(self, part: Any) -> list[float]:
        """Returns the components of the rotations of all nodes."""
        return [
            float(node.GetSolutionStepValue(v)) for node in part.Nodes for v in self.displacements[3:]
        ]

    def _state(self, part: Any, linear: bool = False) -> State:
        """Returns the state, without rotations if they are large: ROTATION is the sum of the
        increments of the iterations, which depends on the steps, and the elements do not give the
        rotations of their nodes."""
        u: dict[str, list[float | None]] = {}
        reaction: dict[str, list[float]] = {}
        supported = self.held | set(self.driven)
        for name, number in self.mesh.node_of.items():
            node = part.Nodes[number + 1]
            u[name] = [float(node.GetSolutionStepValue(v)) for v in self.displacements]
            if not linear and any(x != 0 for x in u[name][3:]):
                u[name][3:] = [None] * 3
            reaction[name] = [
                float(node.GetSolutionStepValue(v)) if (number, dof) in supported else 0.0
                for dof, v in enumerate(self.reactions)
            ]
        return State(u=u, reaction=reaction)

    def matrix(self, part: Any, kind: str) -> Any:
        """Returns the stiffness or mass matrix of all coordinates, from the matrices of the
        elements."""
        import numpy as np

        size = 6 * len(self.mesh.nodes)
        out = np.zeros((size, size))
        for number, e in enumerate(self.mesh.elements, start=1):
            own, rest = self.km.Matrix(), self.km.Vector()
            element = part.Elements[number]
            if kind == "mass":
                element.CalculateMassMatrix(own, part.ProcessInfo)
            else:
                element.CalculateLocalSystem(own, rest, part.ProcessInfo)
            at = [6 * n + i for n in e.nodes for i in range(6)]
            out[np.ix_(at, at)] += np.array(own)
        return out

    def _inverse(self, part: Any, node: str) -> Any:
        import numpy as np

        number = self.mesh.node_of[node]
        fixed = self.held | {at for at in self.driven if at[0] != number}
        free = [i for i in range(6 * len(self.mesh.nodes)) if (i // 6, i % 6) not in fixed]
        inverse = np.linalg.inv(self.matrix(part, "stiffness")[np.ix_(free, free)])
        place = {i: k for k, i in enumerate(free)}
        own = [place.get(6 * number + i) for i in range(6)]
        return [
            [float(inverse[r, c]) if r is not None and c is not None else 0.0 for c in own]
            for r in own
        ]

    def linear_part(self) -> Any:
        part = self.new("CrLinearBeamElement3D2N")
        part.CloneTimeStep(1.0)
        return part

    def _linear(self) -> Answer:
        part = self.linear_part()
        loads, strategy = self.loads(None), self.strategy(part, linear=True)
        strategy.InitializeSolutionStep()
        stiffness = self.matrix(part, "stiffness")
        drives = {at: float(self.scene.motion_value(motion, 1.0)) for at, motion in self.driven.items()}
        if not self.run(part, strategy, loads, drives, check=False):
            raise Failed("the linear equations are not solved")
        return Answer(states=[self._linear_state(part, loads, stiffness)], iterations=1)

    def _linear_state(self, part: Any, loads: dict[int, list[float]], stiffness: Any) -> State:
        """Returns the state, with reactions computed from the stiffness matrix of the undeformed elements,
        because those of the program are not proportional to the loads."""
        import numpy as np

        nodes = range(1, len(self.mesh.nodes) + 1)
        u = [part.Nodes[n].GetSolutionStepValue(v) for n in nodes for v in self.displacements]
        forces = stiffness @ np.array(u)
        for number, vector in loads.items():
            forces[6 * number : 6 * number + 6] -= vector
        state = self._state(part, linear=True)
        reaction = {
            name: [float(forces[6 * n + i]) if (n, i) in self.held | set(self.driven) else 0.0 for i in range(6)]
            for name, n in self.mesh.node_of.items()
        }
        return State(u=state.u, reaction=reaction)

    def _compliance(self, analysis: Analysis) -> Answer:
        self.scene.require_released(analysis)
        if analysis.about is not None:
            return Answer(states=self.kept[analysis.about])
        part = self.linear_part()
        strategy = self.strategy(part, linear=True)
        strategy.InitializeSolutionStep()
        return Answer(states=[State(compliance=self._inverse(part, analysis.raw["node"]))])

    def _modal(self, analysis: Analysis) -> Answer:
        """Computes frequencies from the stiffness and mass matrices of the program's elements."""
        import numpy as np

        if "rotary inertia" not in self.scene.physics:
            raise Refused("modal: the mass matrix contains the rotary inertia that the scene omits")
        require_plain_mass(self.scene)
        for s in self.scene.sections.values():
            own = [s.rho_A * EI / s.EA for EI in (s.EIy, s.EIz)]
            wanted = [sum(s.rho_I[1:]), *s.rho_I[1:]]
            if any(abs(a - b) > 1e-6 * (a + b) for a, b in zip([sum(own), *own], s.rho_I)):
                raise Refused(f"rotary inertia: that of Kratos is {own} kg m, that of section {s.name} {wanted}")
        rigid = rigid_motions(self.scene, self.mesh)
        if analysis.about is not None:
            if rigid:
                raise Refused("about: the driver does not support modes of a loaded structure if its supports leave it free to move")
            part = self.states_of[analysis.about]
        else:
            part = self.linear_part()
            self.strategy(part, linear=True).InitializeSolutionStep()
        fixed = self.held | set(self.driven)
        free = [i for i in range(6 * len(self.mesh.nodes)) if (i // 6, i % 6) not in fixed]
        at = np.ix_(free, free)
        found, vectors = spectrum(self.matrix(part, "stiffness")[at], self.matrix(part, "mass")[at], rigid)
        shapes = np.zeros((len(found), 6 * len(self.mesh.nodes)))
        shapes[:, free] = vectors[:, : len(found)].T
        own_families = families(self.mesh, found, list(shapes.reshape(len(found), -1, 6)))
        return Answer(frequencies=found, families=own_families, iterations=1)
