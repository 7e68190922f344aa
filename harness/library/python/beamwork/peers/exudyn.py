"""Exudyn: geometrically exact beams, ANCF cable in the plane, ANCF beam in space; statics, modes and motions."""
from __future__ import annotations

import importlib
import importlib.metadata
import math
from typing import Any

from . import _exudyn_motion, _motion
from ._exudyn_joint import torque_of
from ._exudyn_modes import compliance, modal
from ._loads import KEYS, nodal, vectors
from ._exudyn_path import add_controls, follow_path
from .data import (COMPONENTS, Analysis, Answer, Element, Load, LoadSteps, Matrix, Mesh, MeshElement, Model, Node, Refused, Scene,
                   Section, State, product, rotation, rotation_vector, times, transposed)

NAME, PROGRAM, LICENCE = "exudyn", "Exudyn", "EXUDYN General License 1.0, terms of BSD-3-Clause"
HOMEPAGE = "https://github.com/jgerstmayr/EXUDYN"
REQUIRES = ("exudyn==1.13.6", )
_ANALYSES = frozenset({"static", "modal", "continuation"})
_PHYSICS = frozenset({"shear", "large rotations", "geometric", "mass", "rotary inertia"})
_FEW, _ALL = frozenset({"loads.follower", "modal.about"}), _ANALYSES | {"motion"}
_KEYS = KEYS | _FEW | {"loads.gravity", "nodes.mass", "nodes.inertia"}
ELEMENTS = {
    "exact_2d": Element("geometrically exact, 2 nodes, xy plane only", _PHYSICS, _ALL | {"compliance"}, keys=_KEYS | {"plane"}),
    "exact_2d_3": Element("geometrically exact, 3 nodes, xy plane only", _PHYSICS, _ALL | {"compliance"}, 2, _KEYS | {"plane"}),
    "cable_2d": Element("ANCF cable, Euler-Bernoulli, 2 nodes, Lobatto and Gauss points (useReducedOrderIntegration=2), xy plane only",
                        frozenset({"large rotations"}), frozenset({"static"}), keys=frozenset({"loads.follower", "plane"})),
    "exact_3d": Element("geometrically exact, 2 nodes, helical interpolation", _PHYSICS, _ALL, keys=_KEYS),
    # The mass matrix of the ANCF beam contains the rate of the sum of both slopes, and depends on the axes of the scene.
    "ancf_3d": Element("ANCF beam with cross-section slopes, 2 nodes; unfinished, according to its authors", _PHYSICS, _ANALYSES, keys=_FEW),
}
_RIGID, _RIGID_ON_PATHS = 1e9, 1e7  # shear stiffness of sections that are rigid in shear, over EI/length^2; in continuations


def version() -> str:
    return importlib.metadata.version("exudyn")


def _rigid(scene: Scene) -> float:
    return _RIGID_ON_PATHS if any(a.kind == "continuation" for a in scene.analyses.values()) else _RIGID


def _shear(section: Section, scene: Scene) -> list[float]:
    most = _rigid(scene) * max(section.EIy, section.EIz) / scene.length()**2
    return [min(k, most) for k in section.GA]


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
        self.node_at: dict[int, int] = {}
        self.base = ""  # the analysis whose last state the model is in

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
        for number, vector in nodal(load, self.mesh).items():
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
            return Answer([State(compliance=compliance(self, analysis))], iterations=1)
        if analysis.kind == "motion":
            return _exudyn_motion.motion(self, analysis)
        if analysis.kind == "continuation":
            return follow_path(self, analysis)
        states, path, iterations = [], 0.0, 0
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
        """Returns the stiffnesses for (gx, gy, gz, kx, ky, kz) in the axes in which the program gives resultants."""
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


class Plane(Steps):
    """Beams in the xy plane. Nodes are shared by members in any directions."""

    def __init__(self, scene: Scene, name: str, mesh: Mesh) -> None:
        super().__init__(scene, name, mesh)
        check_plane(scene)
        at = {node.number: node.at for node in mesh.nodes}
        for element in mesh.elements:  # inner nodes are on the chord, where the reference state has no strain
            for k in element.nodes[1:-1]:
                at[k] = [(a + b) / 2 for a, b in zip(at[element.nodes[0]], at[element.nodes[-1]])]
        self.nodes = [self.add("NodeRigidBody2D", referenceCoordinates=[*at[node.number][:2], 0]) for node in mesh.nodes]
        self.node_at = dict(enumerate(self.nodes))
        for element in mesh.elements:
            s, shear = element.member.section, _shear(element.member.section, scene)
            z = abs(element.R[2][2]) > 0.5
            chord = math.dist(*(mesh.nodes[element.nodes[k]].at for k in (0, -1)))
            self.beams.append((element, self.add(
                "ObjectBeamGeometricallyExact2D", nodeNumbers=[self.nodes[k] for k in element.nodes], length=chord,
                bendingStiffness=s.EIz if z else s.EIy, axialStiffness=s.EA, shearStiffness=shear[0 if z else 1],
                massPerLength=s.rho_A, crossSectionInertia=_exudyn_motion.inertia(scene, s)[2 if z else 1], includeReferenceRotations=False)))
        for node in scene.nodes.values():
            number = self.nodes[mesh.node_of[node.name]]
            mass, inertia = _exudyn_motion.body(node)
            if mass or any(inertia):
                self.add("ObjectRigidBody2D", nodeNumber=number, physicsMass=mass, physicsInertia=inertia[2])
            for coordinate, component in enumerate((0, 1, 5)):
                word = COMPONENTS[component]
                if word in node.hold or word in node.drive:
                    self.constrain(node.name, number, coordinate, component, node.drive.get(word, ""))
        markers = {node: self.add("MarkerNodeRigid", nodeNumber=self.nodes[mesh.node_of[node]]) for node in scene.nodes}
        self.put_loads(markers.__getitem__)
        self.add_sensors()
        self.assemble(3 * len(mesh.nodes))

    def node_of(self, name: str) -> int:
        return self.nodes[self.mesh.node_of[name]]

    def moves(self, component: int) -> bool:
        return component < 2

    def rotations(self) -> list[Matrix]:
        angles = [float(self.mbs.GetNodeOutput(self.nodes[k], self.exu.OutputVariableType.Coordinates)[2])
                  for k in self.mesh.node_of.values()]
        return [rotation([0, 0, angle]) for angle in angles]

    def state(self, get: Any = None) -> State:
        known, get = _motion.asked(self.scene) if get else set(self.mesh.node_of), get or self.get
        u, rate, reaction = dict[str, Any](), dict[str, Any](), dict[str, Any]()
        for name in known:
            number = self.nodes[self.mesh.node_of[name]]
            x, y, angle = get("Node", number, "Coordinates")[:3]
            u[name] = [x, y, 0.0, 0.0, 0.0, angle]
            x, y, angle = get("Node", number, "Coordinates_t")[:3]
            rate[name] = [x, y, 0.0, 0.0, 0.0, angle]
            reaction[name] = [0.0] * 6
            for fixed, (component, ) in self.held.get(name, []):
                reaction[name][component] = get("Object", fixed, "Force")[0]
        return State(u, reaction, rate=rate)

    def all_nodes(self) -> list[tuple[str | None, int]]:
        return [(node.name, self.nodes[node.number]) for node in self.mesh.nodes]

    def coordinate_rates(self, node: int, v: list[float], w: list[float]) -> list[float]:
        return [v[0], v[1], w[2]]

    def stiffness_of(self, element: MeshElement) -> Any:
        s, shear, z = element.member.section, _shear(element.member.section, self.scene), abs(element.R[2][2]) > 0.5
        return [s.EA, shear[0 if z else 1], math.inf, math.inf, math.inf, s.EIz if z else s.EIy]


class Space(Steps):
    """Beams in space. Each end of a member has a node with the axes of its section; rigid joints connect the ends."""

    def __init__(self, scene: Scene, name: str, mesh: Mesh) -> None:
        super().__init__(scene, name, mesh)
        self.ancf = name == "ancf_3d"
        if self.ancf and any(any(c != 0 for c in member.curvature) for member in scene.members.values()):
            raise Refused("curvature: the ANCF beam of Exudyn has stresses in a curved reference state")
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
            data.massPerLength = s.rho_A
            data.inertia = [[v if i == k else 0.0 for k in range(3)] for i, v in enumerate(_exudyn_motion.inertia(scene, s))]
            extra = {"crossSectionPenaltyFactor": [10.0, 10.0, 10.0]} if self.ancf else {}
            self.beams.append((element, self.add("ObjectANCFBeam" if self.ancf else "ObjectBeamGeometricallyExact",
                                                 nodeNumbers=ends, length=element.length, sectionData=data, **extra)))
        self.ground_marker = self.add("MarkerNodeRigid", nodeNumber=self.ground)
        markers: dict[str, int] = {}
        joints = 0
        for node in scene.nodes.values():
            first, *others = [self.add("MarkerNodeRigid", nodeNumber=k) for k in self.of[node.name]]
            markers[node.name] = first
            self._body(node)
            for marker, k in zip(others, self.of[node.name][1:]):
                joints += 6
                self._joint(first, marker, self.frame[self.of[node.name][0]], self.frame[k], [1] * 6, node.name)
            self._support(node.name, first)
        self.put_loads(markers.__getitem__)
        self.add_sensors()
        self.assemble(6 * len(made) - joints if not self.ancf else 9 * len(made) - joints)

    def node_of(self, name: str) -> int:
        return self.of[name][0]

    def rotations(self) -> list[Matrix]:
        return [self._matrix(nodes[0]) for nodes in self.of.values()]

    def frame_of(self, name: str) -> Matrix:
        return self.frame[self.of[name][0]]

    def _matrix(self, node: int) -> list[list[float]]:
        matrix = self.mbs.GetNodeOutput(node, self.exu.OutputVariableType.RotationMatrix)
        return [[float(x) for x in matrix[3 * i:3 * i + 3]] for i in range(3)]

    def _body(self, node: Node) -> None:
        mass, inertia = _exudyn_motion.body(node)
        if not mass and not any(inertia):
            return
        xx, yy, zz, xy, yz, xz = inertia
        P = self.frame_of(node.name)
        own = product(transposed(P), product([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]], P))
        self.add("ObjectRigidBody", nodeNumber=self.of[node.name][0], physicsMass=mass,
                 physicsInertia=[own[0][0], own[1][1], own[2][2], own[1][2], own[0][2], own[0][1]])

    def _stiffness(self, section: Section) -> Any:
        import numpy  # pylint: disable=import-outside-toplevel
        shear = _shear(section, self.scene)
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
            elif any(v != 0 for v in self.scene.motions[motion].get("value", ())):
                raise Refused(f"drive: the driver does not drive {word} in space along a path")
        axes = [int(c in node.hold or (c in node.drive and c[0] == "r")) for c in COMPONENTS]
        if sum(axes[3:]) == 1 and any(a.kind != "modal" or a.about for a in self.scene.analyses.values()):
            raise Refused(f"hold: the driver does not hold one rotation of {name}")
        if any(axes):
            frame = self.frame[self.of[name][0]]
            ground = self.add("MarkerNodeRigid", nodeNumber=self.add(
                "NodePointGround", referenceCoordinates=list(node.at)))
            joint = self._joint(ground, marker, [[1.0, 0, 0], [0, 1.0, 0], [0, 0, 1.0]], frame, axes, name)
            self.held.setdefault(name, []).append((joint, [k for k in range(6) if axes[k]]))
            self._turn(name, joint, axes)

    def _turn(self, name: str, joint: int, axes: list[int]) -> None:
        driven = [(word, motion) for word, motion in self.scene.nodes[name].drive.items() if word[0] == "r"]
        if len(driven) > 1 or (driven and sum(axes[3:]) < 3):
            raise Refused(f"drive: the driver drives one rotation of {name} while the others are fixed")
        self.turned += [(motion, joint, COMPONENTS.index(word)) for word, motion in driven]

    def state(self, get: Any = None) -> State:
        known, get = _motion.asked(self.scene) if get else set(self.mesh.node_of), get or self.get
        u, rate, reaction = dict[str, Any](), dict[str, Any](), dict[str, Any]()
        for name in known:
            node = self.of[name][0]
            matrix = get("Node", node, "RotationMatrix")
            turn = product([matrix[3 * i:3 * i + 3] for i in range(3)], transposed(self.frame[node]))
            vector = rotation_vector(turn)
            sure = math.hypot(*vector) < 3 or get != self.get  # a history shows the number of turns
            u[name] = [*get("Node", node, "Displacement")[:3], *((x if sure else None) for x in vector)]
            rate[name] = [] if self.ancf else [*get("Node", node, "Velocity")[:3],
                                                     *times(transposed(turn), get("Node", node, "AngularVelocity")[:3])]
            reaction[name] = [0.0] * 6
            for item, components in self.held.get(name, []):
                if len(components) == 1 and components[0] < 3 and (item in [d for _, d in self.driven]):
                    reaction[name][components[0]] = get("Object", item, "Force")[0]
                    continue
                held = [k - 3 for k in components if k > 2]
                both = [*get("Object", item, "ForceLocal")[:3], *torque_of(get("Object", item, "TorqueLocal"), held, turn)]
                for k in components:
                    reaction[name][k] = both[k]
        return State(u, reaction, rate=rate)

    def all_nodes(self) -> list[tuple[str | None, int]]:
        of = {number: name for name, numbers in self.of.items() for number in numbers}
        return [(of.get(number), number) for number in self.frame]

    def coordinate_rates(self, node: int, v: list[float], w: list[float]) -> list[float]:
        c = self.get("Node", node, "Coordinates")
        return [*v, *_exudyn_motion.quaternion_rate(self.parameters(node, c), w)]

    def parameters(self, node: int, c: list[float]) -> list[float]:
        """Returns the Euler parameters of a node with the coordinates c, which are changes of the reference coordinates."""
        reference = self.mbs.GetNode(node)["referenceCoordinates"]
        return [float(a) + b for a, b in zip(reference[3:], c[3:])]

    def stiffness_of(self, element: MeshElement) -> Any:
        return self._stiffness(element.member.section).diagonal()


def build(scene: Scene, element: str, mesh: Mesh) -> Model:
    if element == "cable_2d":
        return importlib.import_module("._exudyn_cable", __package__).Cable(scene, element, mesh)  # type: ignore[no-any-return]
    return (Plane if element.startswith("exact_2d") else Space)(scene, element, mesh)
