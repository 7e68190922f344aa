"""A model of Exudyn: its items, load steps and analyses. Other files add nodes, elements and supports."""
from __future__ import annotations

import importlib
import math
from typing import Any

from . import _exudyn_motion
from ._exudyn_buckling import buckling
from ._exudyn_modes import compliance, modal
from ._exudyn_path import add_controls, follow_path
from ._loads import nodal, vectors
from .data import (Analysis, Answer, Load, LoadSteps, Matrix, Mesh, MeshElement, Model, Refused, Scene, Section, State, Vector, product, rotation,
                   rotation_vector, times, transposed)

# shear stiffness, divided by EI/length^2, of sections that are rigid in shear; lower values for these analyses:
_RIGID, _LESS_RIGID = 1e9, 1e7
_WITH_LESS = ("continuation", "buckling")


def _rigid(scene: Scene) -> float:
    return _LESS_RIGID if any(a.kind in _WITH_LESS for a in scene.analyses.values()) else _RIGID


def shear_of(section: Section, scene: Scene) -> list[float]:
    return [min(k, _rigid(scene) * EI / scene.length()**2) for k, EI in zip(section.GA, (section.EIz, section.EIy))]


class Steps(Model):
    """Load steps. Subclasses add nodes, elements, supports and loads, and read states."""
    most_iterations = 25

    def __init__(self, scene: Scene, name: str, mesh: Mesh) -> None:
        self.exu = importlib.import_module("exudyn")
        self.items = importlib.import_module("exudyn.itemInterface")
        self.scene, self.name, self.mesh = scene, name, mesh
        self.container = self.exu.SystemContainer()
        self.mbs = self.container.AddSystem()
        self.ground = self.add("NodePointGround", referenceCoordinates=[0, 0, 0])
        self.loads: list[tuple[Load, int, list[float]]] = []
        self.held: dict[str, list[tuple[int, list[int]]]] = {}
        self.driven: list[tuple[str, int]] = []
        self.turned: list[tuple[str, int, int]] = []  # motion, joint, and component of a driven rotation in space
        self.beams: list[tuple[MeshElement, int]] = []
        self.unknowns = 0
        self.node_at: dict[int, int] = {}  # nodes of Exudyn at nodes of the mesh
        self.of: dict[str, list[int]] = {node: [] for node in scene.nodes}  # at nodes of the scene, one for each member
        self.base = ""  # analysis in whose last state the model is
        self.kept: dict[str, list[tuple[float, Any, State]]] = {}  # path parameter, coordinates and state at stations

    def add(self, kind: str, **values: Any) -> int:
        item = getattr(self.items, kind)(**values)
        for word in ("Node", "Marker", "Load"):
            if kind.startswith(word):
                return int(getattr(self.mbs, f"Add{word}")(item))
        return int(self.mbs.AddObject(item))

    def assemble(self, count: int) -> None:
        self.controls = add_controls(self)
        self.mbs.Assemble()
        self.undeformed = self.mbs.systemData.GetODE2Coordinates(configuration=self.exu.ConfigurationType.Current)
        s = self.settings_of = self.exu.SimulationSettings()
        s.solutionSettings.writeSolutionToFile = False
        s.solutionSettings.sensorsWriteFileHeader = s.solutionSettings.sensorsWriteFileFooter = False
        s.staticSolver.verboseMode = 0
        s.staticSolver.numberOfLoadSteps = 1
        s.staticSolver.useLoadFactor = False
        s.staticSolver.adaptiveStep = False
        s.staticSolver.newton.maxIterations = self.most_iterations
        s.staticSolver.newton.residualMode = 1
        s.staticSolver.newton.relativeTolerance = s.staticSolver.newton.absoluteTolerance = 1e-8
        s.linearSolverType = self.exu.LinearSolverType.EigenSparse
        self.unknowns = count - sum(len(c) for all_ in self.held.values() for _, c in all_)
        self.settings = ("SolveStatic, Newton increments below 1e-8, sparse, adaptive load steps; rigid in shear: "
                         f"GA = {_rigid(self.scene):g} EI/L^2; modes: LAPACK, with the matrices of the static solver")
        if _exudyn_motion.moves(self.scene):
            self.settings = f"{_exudyn_motion.SETTINGS}; rigid in shear: GA = {_rigid(self.scene):g} EI/L^2"

    def constrain(self, name: str, node: int, coordinate: int, component: int, motion: str = "") -> None:
        zero = self.add("MarkerNodeCoordinate", nodeNumber=self.ground, coordinate=0)
        marker = self.add("MarkerNodeCoordinate", nodeNumber=node, coordinate=coordinate)
        fixed = self.add("CoordinateConstraint", markerNumbers=[zero, marker])
        self.held.setdefault(name, []).append((fixed, [component]))
        if motion:
            self.driven.append((motion, fixed))

    def add_node(self, at: Vector, frame: Matrix) -> int:
        """Adds a node with the axes of a section."""
        raise NotImplementedError

    def nodes_of_members(self) -> dict[tuple[str, int], int]:
        """Adds a node for each member and node of the mesh. Returns them by the name of the member and the number in the mesh."""
        made: dict[tuple[str, int], int] = {}
        for element in self.mesh.elements:
            for k, frame in zip(element.nodes, element.frames):
                key = (element.member.name, k)
                if key not in made:
                    made[key] = self.node_at[k] = self.add_node(self.mesh.nodes[k].at, frame)
                    if self.mesh.nodes[k].name is not None:
                        self.of[str(self.mesh.nodes[k].name)].append(made[key])
        return made

    def put_loads(self, marker_of: Any) -> None:
        for load in self.scene.loads:
            if load.kind == "gravity":
                self._put_gravity(load, marker_of)
                continue
            if load.node is None:
                self._put_along(load)
                continue
            kind = "LoadForceVector" if load.kind == "force" else "LoadTorqueVector"
            vector = times(transposed(self.frame_of(load.node)), load.vector) if load.follower else list(load.vector)
            number = self.add(kind, markerNumber=marker_of(load.node), loadVector=vector, bodyFixed=load.follower)
            self.loads.append((load, number, vector))

    def _put_along(self, load: Load) -> None:
        """Adds a load on a member as forces and moments at nodes."""
        if load.follower:
            raise Refused(f"follower: {load.name} acts on a member")
        for number, vector in nodal(load, self.mesh, self.scene).items():
            marker = self.add("MarkerNodeRigid", nodeNumber=self.node_at[number])
            for kind, part in (("LoadForceVector", vector[:3]), ("LoadTorqueVector", vector[3:])):
                if any(v != 0 for v in part):
                    self.loads.append((load, self.add(kind, markerNumber=marker, loadVector=list(part)), list(part)))

    def _put_gravity(self, load: Load, marker_of: Any) -> None:
        if load.node is not None:
            weight = [float(self.scene.nodes[load.node].raw.get("mass", 0)) * g for g in load.vector]
            self.loads.append((load, self.add("LoadForceVector", markerNumber=marker_of(load.node), loadVector=weight), weight))
        for element, beam in self.beams:
            if element.member.name == load.member:
                marker = self.add("MarkerBodyMass", bodyNumber=beam)
                number = self.add("LoadMassProportional", markerNumber=marker, loadVector=list(load.vector))
                self.loads.append((load, number, list(load.vector)))

    def frame_of(self, name: str) -> Matrix:
        del name
        return rotation([0, 0, 0])

    def _set(self, path: float) -> None:
        for load, number, vector in self.loads:
            factor = self.scene.load_factor(load, path)
            self.mbs.SetLoadParameter(number, "loadVector", [factor * x for x in vector])
        for motion, constraint in self.driven:
            self.mbs.SetObjectParameter(constraint, "offset", self.scene.motion_value(motion, path))

    def step(self, path: float) -> bool:
        data, current, initial = self.mbs.systemData, self.exu.ConfigurationType.Current, self.exu.ConfigurationType.Initial
        before = data.GetODE2Coordinates(configuration=current)
        data.SetODE2Coordinates(before, configuration=initial)
        self._set(path)
        try:
            done = self.mbs.SolveStatic(self.settings_of, updateInitialValues=False, storeSolver=True)
        except (RuntimeError, ValueError):
            done = False
        if not done:
            data.SetODE2Coordinates(before, configuration=current)
        return bool(done)

    def newton_steps(self) -> int:
        return int(self.mbs.sys["staticSolver"].it.newtonStepsCount)

    def solve(self, analysis: Analysis) -> Answer:
        if analysis.kind == "modal":
            self._return_to(analysis)
            return modal(self, analysis)
        if analysis.kind == "compliance":
            self._return_to(analysis)
            return Answer(compliance(self, analysis), iterations=1)
        if analysis.kind == "buckling":
            return buckling(self)
        if analysis.kind == "motion":
            return _exudyn_motion.motion(self, analysis)
        if analysis.kind == "continuation":
            return follow_path(self, analysis)
        states, kept, path, iterations = [], [], 0.0, 0
        steps = LoadSteps((self.scene.of, self.name, len(self.mesh.elements), analysis.name), analysis.stations[-1])
        before = self.rotations()
        for station in analysis.stations:
            while path < station * (1 - 1e-12):
                step = steps.next(station - path)
                if not self.step(path + step):
                    iterations += self.most_iterations
                    steps.failed(step)
                    continue
                iterations += self.newton_steps()
                path += step
                after = self.rotations()
                steps.done(step, max(between(a, b) for a, b in zip(before, after)))
                before = after
            states.append(self.state())
            kept.append((path, self.mbs.systemData.GetODE2Coordinates(configuration=self.exu.ConfigurationType.Current), states[-1]))
        self.base, self.kept[analysis.name] = analysis.name, kept
        return Answer(states, iterations=iterations)

    def _return_to(self, analysis: Analysis) -> None:
        if analysis.about is not None and analysis.about != self.base:
            raise Refused(f"about: {analysis.about} is not the last static analysis before {analysis.name}")
        data, types = self.mbs.systemData, self.exu.ConfigurationType
        state = data.GetODE2Coordinates(configuration=types.Current)
        if analysis.about is None:
            self._set(0.0)
            state = [0.0] * len(state)
        data.SetODE2Coordinates(state, configuration=types.Initial)

    def states_about(self, analysis: Analysis) -> list[tuple[float, Any, State]]:
        """Returns path parameters, coordinates and states at the stations of the base analysis of another analysis."""
        if analysis.about is not None:
            return self.kept[analysis.about]
        zero = [0.0] * 6
        return [(0.0, [0.0] * len(self.undeformed), State(reaction=dict.fromkeys(self.scene.nodes, zero)))]

    def get(self, kind: str, item: int, output: str) -> list[float]:
        """Returns the present output of an item."""
        which = getattr(self.exu.OutputVariableType, output)
        value = self.mbs.GetNodeOutput(item, which) if kind == "Node" else self.mbs.GetObjectOutput(item, which)
        return [float(x) for x in value] if hasattr(value, "__len__") else [float(value)]

    def add_sensors(self) -> None:
        if _exudyn_motion.moves(self.scene):
            self.sensors = _exudyn_motion.Sensors(self)
            self.state(self.sensors.record)

    def node_of(self, name: str) -> int:
        """Returns the node of Exudyn at a node of the scene."""
        raise NotImplementedError

    def moves(self, component: int) -> bool:
        """Returns True if the nodes have this component."""
        return component < 3

    def rotations(self) -> list[Matrix]:
        raise NotImplementedError

    def state(self, get: Any = None) -> State:
        """Returns the present state, or one with the outputs that `get` returns, for the nodes in quantities of motions."""
        raise NotImplementedError

    def all_nodes(self) -> list[tuple[str | None, int]]:
        """Returns the numbers of all nodes of the model, with the names of those of the scene."""
        raise NotImplementedError

    def coordinate_rates(self, node: int, v: list[float], w: list[float]) -> list[float]:
        """Returns the rates of the coordinates of a node from its velocity and angular velocity."""
        raise NotImplementedError

    def stiffness_of(self, element: MeshElement) -> Any:
        """Returns the stiffnesses for (gx, gy, gz, kx, ky, kz) in the axes of the program's resultants."""
        raise NotImplementedError


def check_plane(scene: Scene) -> None:
    for member in scene.members.values():
        if abs(member.start[2]) > 0 or abs(member.axes[2][0]) > 1e-12 or member.curvature[0] != 0 or min(
                abs(member.axes[2][k]) for k in (1, 2)) > 1e-12:
            raise Refused(f"space: {member.name} is not in the xy plane")
    for load in scene.loads:
        if any(x != 0 for v in vectors(load) for x in (v[:2] if load.kind.endswith("moment") else v[2:])):
            raise Refused(f"space: {load.name} is not in the xy plane")


def between(P: Matrix, Q: Matrix) -> float:
    return math.hypot(*rotation_vector(product(transposed(P), Q)))
