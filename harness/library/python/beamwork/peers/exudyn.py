"""Exudyn: geometrically exact beams in the plane and in space, and the ANCF beam in space; statics and modes."""
from __future__ import annotations

import importlib
import importlib.metadata
import math
from typing import Any

from ._exudyn_modes import modal
from .data import (COMPONENTS, Analysis, Answer, Element, Load, LoadSteps, Matrix, Mesh, Model, Refused, Scene, Section, State, product,
                   rotation, rotation_vector, times, transposed)

NAME, PROGRAM, LICENCE = "exudyn", "Exudyn", "BSD-3-Clause"
HOMEPAGE = "https://github.com/jgerstmayr/EXUDYN"
REQUIRES = ("exudyn==1.13.6", )
_ANALYSES, _PHYSICS = frozenset({"static", "modal"}), frozenset({"shear", "large rotations", "geometric", "mass", "rotary inertia"})
_KEYS = frozenset({"loads.follower", "modal.about"})
ELEMENTS = {
    "exact_2d": Element("geometrically exact, 2 nodes, xy plane only", _PHYSICS, _ANALYSES, keys=_KEYS | {"plane"}),
    "exact_2d_3": Element("geometrically exact, 3 nodes, xy plane only", _PHYSICS, _ANALYSES, 2, _KEYS | {"plane"}),
    "exact_3d": Element("geometrically exact, 2 nodes; marked as under construction by its authors", _PHYSICS, _ANALYSES, keys=_KEYS),
    "ancf_3d": Element("ANCF beam with cross-section slopes, 2 nodes; marked as under construction", _PHYSICS, _ANALYSES, keys=_KEYS),
}
_RIGID = 1e9  # shear stiffness of sections that are rigid in shear, relative to EI/length^2


def version() -> str:
    return importlib.metadata.version("exudyn")


def _shear(section: Section, length: float) -> list[float]:
    most = _RIGID * max(section.EIy, section.EIz) / length**2
    return [min(k, most) for k in section.GA]


class _Steps(Model):
    """Load steps. Subclasses add nodes, elements, supports and loads, and read states."""

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
        self.unknowns = 0
        self.node_at: dict[int, int] = {}
        self.base = ""  # the analysis whose last state the model is in

    def add(self, kind: str, **values: Any) -> int:
        item = getattr(self.items, kind)(**values)
        for word in ("Node", "Marker", "Load"):
            if kind.startswith(word):
                return int(getattr(self.mbs, f"Add{word}")(item))
        return int(self.mbs.AddObject(item))

    def assemble(self, count: int) -> None:
        self.mbs.Assemble()
        s = self.settings_of = self.exu.SimulationSettings()
        s.solutionSettings.writeSolutionToFile = False
        s.solutionSettings.sensorsWriteFileHeader = s.solutionSettings.sensorsWriteFileFooter = False
        s.staticSolver.verboseMode = 0
        s.staticSolver.numberOfLoadSteps = 1
        s.staticSolver.useLoadFactor = False
        s.staticSolver.adaptiveStep = False
        s.staticSolver.newton.maxIterations = 25
        s.staticSolver.newton.residualMode = 1
        s.staticSolver.newton.relativeTolerance = s.staticSolver.newton.absoluteTolerance = 1e-8
        s.linearSolverType = self.exu.LinearSolverType.EigenSparse
        self.unknowns = count - sum(len(c) for all_ in self.held.values() for _, c in all_)
        self.settings = ("SolveStatic, Newton increments below 1e-8, sparse, adaptive load steps; rigid in shear: "
                         f"GA = {_RIGID:g} EI/L^2; modes: LAPACK, with the matrices of the static solver")

    def constrain(self, name: str, node: int, coordinate: int, component: int, motion: str = "") -> None:
        zero = self.add("MarkerNodeCoordinate", nodeNumber=self.ground, coordinate=0)
        marker = self.add("MarkerNodeCoordinate", nodeNumber=node, coordinate=coordinate)
        fixed = self.add("CoordinateConstraint", markerNumbers=[zero, marker])
        self.held.setdefault(name, []).append((fixed, [component]))
        if motion:
            self.driven.append((motion, fixed))

    def put_loads(self, marker_of: Any) -> None:
        for load in self.scene.loads:
            if load.node is None or load.kind not in ("force", "moment"):
                raise Refused(f"{load.kind}: the driver has forces and moments at nodes only")
            kind = "LoadForceVector" if load.kind == "force" else "LoadTorqueVector"
            vector = times(transposed(self.frame_of(load.node)), load.vector) if load.follower else list(load.vector)
            number = self.add(kind, markerNumber=marker_of(load.node), loadVector=vector, bodyFixed=load.follower)
            self.loads.append((load, number, vector))

    def frame_of(self, name: str) -> Matrix:
        del name
        return rotation([0, 0, 0])

    def _set(self, path: float) -> None:
        for load, number, vector in self.loads:
            factor = self.scene.load_factor(load, path)
            self.mbs.SetLoadParameter(number, "loadVector", [factor * x for x in vector])
        for motion, constraint in self.driven:
            self.mbs.SetObjectParameter(constraint, "offset", self.scene.motion_value(motion, path))

    def _step(self, path: float) -> bool:
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

    def solve(self, analysis: Analysis) -> Answer:
        if analysis.kind == "modal":
            self._return_to(analysis)
            return modal(self, analysis)
        states, path, iterations = [], 0.0, 0
        steps = LoadSteps((self.scene.of, self.name, len(self.mesh.elements), analysis.name), analysis.stations[-1])
        before = self.rotations()
        for station in analysis.stations:
            while path < station * (1 - 1e-12):
                step = steps.next(station - path)
                if not self._step(path + step):
                    iterations += 25
                    steps.failed(step)
                    continue
                iterations += int(self.mbs.sys["staticSolver"].it.newtonStepsCount)
                path += step
                after = self.rotations()
                steps.done(step, max(between(a, b) for a, b in zip(before, after)))
                before = after
            states.append(self.state())
        self.base = analysis.name
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

    def rotations(self) -> list[Matrix]:
        raise NotImplementedError

    def state(self) -> State:
        raise NotImplementedError


def _plane(scene: Scene) -> None:
    for member in scene.members.values():
        if abs(member.start[2]) > 0 or abs(member.axes[2][0]) > 1e-12 or member.curvature[0] != 0 or min(
                abs(member.axes[2][k]) for k in (1, 2)) > 1e-12:
            raise Refused(f"space: {member.name} is not in the xy plane")
    for load in scene.loads:
        if any(x != 0 for x in (load.vector[2:] if load.kind == "force" else load.vector[:2])):
            raise Refused(f"space: {load.name} is not in the xy plane")


def between(P: Matrix, Q: Matrix) -> float:
    return math.hypot(*rotation_vector(product(transposed(P), Q)))


class Plane(_Steps):
    """Beams in the xy plane. Nodes are shared by members in any directions."""

    def __init__(self, scene: Scene, name: str, mesh: Mesh) -> None:
        super().__init__(scene, name, mesh)
        _plane(scene)
        self.nodes = [self.add("NodeRigidBody2D", referenceCoordinates=[*node.at[:2], 0]) for node in mesh.nodes]
        self.node_at = dict(enumerate(self.nodes))
        for element in mesh.elements:
            s, shear = element.member.section, _shear(element.member.section, scene.length())
            z = abs(element.R[2][2]) > 0.5
            curvature = element.member.curvature[2] * element.R[2][2] if z else element.member.curvature[1] * element.R[2][1]
            if curvature != 0:
                raise Refused("curvature: straight elements on an arc are not tested with the shared nodes of Exudyn")
            self.add("ObjectBeamGeometricallyExact2D", nodeNumbers=[self.nodes[k] for k in element.nodes],
                     length=element.length, bendingStiffness=s.EIz if z else s.EIy, axialStiffness=s.EA,
                     shearStiffness=shear[0 if z else 1], massPerLength=s.rho_A,
                     crossSectionInertia=s.rho_I[2 if z else 1], includeReferenceRotations=False)
        for node in scene.nodes.values():
            number = self.nodes[mesh.node_of[node.name]]
            for coordinate, component in enumerate((0, 1, 5)):
                word = COMPONENTS[component]
                if word in node.hold or word in node.drive:
                    self.constrain(node.name, number, coordinate, component, node.drive.get(word, ""))
        markers = {node: self.add("MarkerNodeRigid", nodeNumber=self.nodes[mesh.node_of[node]]) for node in scene.nodes}
        self.put_loads(markers.__getitem__)
        self.assemble(3 * len(mesh.nodes))

    def rotations(self) -> list[Matrix]:
        angles = [float(self.mbs.GetNodeOutput(self.nodes[k], self.exu.OutputVariableType.Coordinates)[2])
                  for k in self.mesh.node_of.values()]
        return [rotation([0, 0, angle]) for angle in angles]

    def state(self) -> State:
        u, reaction = {}, {}
        for name, number in self.mesh.node_of.items():
            moved = self.mbs.GetNodeOutput(self.nodes[number], self.exu.OutputVariableType.Coordinates)
            u[name] = [float(moved[0]), float(moved[1]), 0.0, 0.0, 0.0, float(moved[2])]
            reaction[name] = [0.0] * 6
            for fixed, (component, ) in self.held.get(name, []):
                force = self.mbs.GetObjectOutput(fixed, self.exu.OutputVariableType.Force)
                reaction[name][component] = float(force)
        return State(u, reaction)


class Space(_Steps):
    """Beams in space. Each end of a member has a node with the axes of its section; rigid joints connect the ends."""

    def __init__(self, scene: Scene, name: str, mesh: Mesh) -> None:
        super().__init__(scene, name, mesh)
        self.ancf = name == "ancf_3d"
        self.frame: dict[int, Matrix] = {}
        self.of: dict[str, list[int]] = {node: [] for node in scene.nodes}
        made: dict[tuple[str, int], int] = {}
        for element in mesh.elements:
            ends = []
            for k, frame in zip(element.nodes, element.frames):
                key = (element.member.name, k)
                if key not in made:
                    made[key] = self.node_at[k] = self._node(mesh.nodes[k].at, frame)
                    if mesh.nodes[k].name is not None:
                        self.of[str(mesh.nodes[k].name)].append(made[key])
                ends.append(made[key])
            s = element.member.section
            data = self.exu.BeamSection()
            data.stiffnessMatrix = self._stiffness(s)
            x, y, z = s.rho_I
            data.massPerLength, data.inertia = s.rho_A, [[x, 0, 0], [0, y, 0], [0, 0, z]]
            extra = {"crossSectionPenaltyFactor": [10.0, 10.0, 10.0]} if self.ancf else {}
            self.add("ObjectANCFBeam" if self.ancf else "ObjectBeamGeometricallyExact", nodeNumbers=ends,
                     length=element.length, sectionData=data, **extra)
        self.ground_marker = self.add("MarkerNodeRigid", nodeNumber=self.ground)
        markers: dict[str, int] = {}
        joints = 0
        for node in scene.nodes.values():
            first, *others = [self.add("MarkerNodeRigid", nodeNumber=k) for k in self.of[node.name]]
            markers[node.name] = first
            for marker, k in zip(others, self.of[node.name][1:]):
                joints += 6
                self._joint(first, marker, self.frame[self.of[node.name][0]], self.frame[k], [1] * 6, node.name)
            self._support(node.name, first)
        self.put_loads(markers.__getitem__)
        self.assemble(6 * len(made) - joints if not self.ancf else 9 * len(made) - joints)

    def rotations(self) -> list[Matrix]:
        return [self._matrix(nodes[0]) for nodes in self.of.values()]

    def frame_of(self, name: str) -> Matrix:
        return self.frame[self.of[name][0]]

    def _matrix(self, node: int) -> list[list[float]]:
        matrix = self.mbs.GetNodeOutput(node, self.exu.OutputVariableType.RotationMatrix)
        return [[float(x) for x in matrix[3 * i:3 * i + 3]] for i in range(3)]

    def _stiffness(self, section: Section) -> Any:
        import numpy  # pylint: disable=import-outside-toplevel
        shear = _shear(section, self.scene.length())
        return numpy.diag([section.EA, *shear, section.GIt, section.EIy, section.EIz])

    def _node(self, at: Any, frame: Matrix) -> int:
        y, z = (list(column) for column in transposed(frame)[1:])
        if self.ancf:
            node = self.add("NodePointSlope23", referenceCoordinates=[*at, *y, *z])
        else:
            turn = rotation_vector(frame)
            half = math.sqrt(sum(x * x for x in turn)) / 2
            axis = [x * math.sin(half) / (2 * half) if half > 0 else 0 for x in turn]
            node = self.add("NodeRigidBodyEP", referenceCoordinates=[*at, math.cos(half), *axis])
        self.frame[node] = frame
        return node

    def _joint(self, p: int, q: int, P: Matrix, Q: Matrix, axes: list[int], name: str) -> int:
        del name
        return self.add("GenericJoint", markerNumbers=[p, q], constrainedAxes=axes, rotationMarker0=transposed(P),
                        rotationMarker1=transposed(Q))

    def _support(self, name: str, marker: int) -> None:
        node = self.scene.nodes[name]
        for word, motion in node.drive.items():
            if word[0] == "u":
                k = COMPONENTS.index(word)
                self.constrain(name, self.of[name][0], k, k, motion)
            elif any(v != 0 for v in self.scene.motions[motion]["value"]):
                raise Refused(f"drive: the driver does not drive {word} in space")
        axes = [int(c in node.hold or (c in node.drive and c[0] == "r")) for c in COMPONENTS]
        if sum(axes[3:]) == 1 and any(a.kind != "modal" or a.about for a in self.scene.analyses.values()):
            raise Refused(f"hold: the driver does not hold one rotation of {name}")
        if any(axes):
            frame = self.frame[self.of[name][0]]
            ground = self.add("MarkerNodeRigid", nodeNumber=self.add(
                "NodePointGround", referenceCoordinates=list(node.at)))
            joint = self._joint(ground, marker, [[1.0, 0, 0], [0, 1.0, 0], [0, 0, 1.0]], frame, axes, name)
            self.held.setdefault(name, []).append((joint, [k for k in range(6) if axes[k]]))

    def state(self) -> State:
        types = self.exu.OutputVariableType
        u: dict[str, list[float | None]] = {}
        reaction: dict[str, list[float]] = {}
        for name in self.mesh.node_of:
            node = self.of[name][0]
            moved = [float(x) for x in self.mbs.GetNodeOutput(node, types.Displacement)]
            vector = rotation_vector(product(self._matrix(node), transposed(self.frame[node])))
            known = math.sqrt(sum(x * x for x in vector)) < 3
            u[name] = [*moved, *((x if known else None) for x in vector)]
            reaction[name] = [0.0] * 6
            for item, components in self.held.get(name, []):
                if len(components) == 1 and components[0] < 3 and (item in [d for _, d in self.driven]):
                    reaction[name][components[0]] = float(self.mbs.GetObjectOutput(item, types.Force))
                    continue
                force = self.mbs.GetObjectOutput(item, types.ForceLocal)
                torque = self.mbs.GetObjectOutput(item, types.TorqueLocal)
                both = [*force, torque[0], -torque[1], -torque[2]]  # signs as measured by the contract tests
                for k in components:
                    reaction[name][k] = float(both[k])
        return State(u, reaction)


def build(scene: Scene, element: str, mesh: Mesh) -> Model:
    return (Plane if element.startswith("exact_2d") else Space)(scene, element, mesh)
