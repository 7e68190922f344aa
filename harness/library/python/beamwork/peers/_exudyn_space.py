"""Geometrically exact beams and ANCF beams of Exudyn in space."""
from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from . import _exudyn_motion, _motion
from ._exudyn_joint import torque_of
from ._exudyn_model import Steps, shear_of
from ._hinges import hinges, idle
from .data import (COMPONENTS, Matrix, Mesh, MeshElement, Node, Refused, Scene, Section, Spring, State, Vector, product, rotation, rotation_vector, times,
                   transposed)


class Space(Steps):
    """Beams in space. Each end of a member has a node with the axes of its section; rigid joints connect the ends."""

    def __init__(self, scene: Scene, name: str, mesh: Mesh, places: Sequence[tuple[Vector, Matrix]] = ()) -> None:
        """Makes the model. places: positions and axes of the nodes of Exudyn in a reference state that differs from
        that of the scene; empty: it does not differ."""
        super().__init__(scene, name, mesh)
        self.places = places
        self.ancf = name == "ancf_3d"
        if self.ancf and any(any(c != 0 for c in member.curvature) for member in scene.members.values()):
            raise Refused("curvature: the ANCF beam of Exudyn has stresses in a curved reference state")
        self.frame: dict[int, Matrix] = {}
        made = self.nodes_of_members()
        for element in mesh.elements:
            ends = [made[element.member.name, k] for k in element.nodes]
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
        released = {made[mesh.elements[h.element].member.name, h.node]: h.own for h in hinges(scene, mesh)}
        self.loose = idle(scene)
        for node in scene.nodes.values():
            self._order(node, released)
            first, *others = [self.add("MarkerNodeRigid", nodeNumber=k) for k in self.of[node.name]]
            markers[node.name] = first
            self._body(node)
            for marker, k in zip(others, self.of[node.name][1:]):
                axes = [int(c not in released.get(k, ())) for c in COMPONENTS]
                joints += sum(axes)
                self._joint(first, marker, self.frame[self.of[node.name][0]], self.frame[k], axes, self.frame[k])
            self._support(node.name, first)
        for spring in scene.springs:
            self._spring(spring, markers[spring.end])
        self.put_loads(markers.__getitem__)
        self.add_sensors()
        self.assemble((9 if self.ancf else 6) * len(self.frame) - joints)

    def _order(self, node: Node, released: Mapping[int, frozenset[str]]) -> None:
        """Moves an end without a hinge to the front, because the first node represents the node of the scene. If
        all ends have hinges, adds a node."""
        numbers = sorted(self.of[node.name], key=lambda k: k in released)
        if numbers[0] in released:
            if _exudyn_motion.moves(self.scene):
                raise Refused(f"release: all members have hinges at {node.name}, and nodes without mass do not move in Exudyn")
            numbers.insert(0, self.add_node(node.at, rotation([0, 0, 0])))
        self.of[node.name] = numbers

    def node_of(self, name: str) -> int:
        return self.of[name][0]

    def rotations(self) -> list[Matrix]:
        return [self.matrix_of(nodes[0]) for nodes in self.of.values()]

    def frame_of(self, name: str) -> Matrix:
        return self.frame[self.of[name][0]]

    def matrix_of(self, node: int) -> list[list[float]]:
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
        shear = shear_of(section, self.scene)
        return numpy.diag([section.EA, *shear, section.GIt, section.EIy, section.EIz])

    def add_node(self, at: Vector, frame: Matrix) -> int:
        at, frame = self.places[len(self.frame)] if self.places else (at, frame)
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

    def _spring(self, spring: Spring, marker: int) -> None:
        import numpy  # pylint: disable=import-outside-toplevel
        number = self.of[spring.end][0]
        place = self.places[list(self.frame).index(number)][0] if self.places else self.scene.nodes[spring.end].at
        ground = self.add("MarkerNodeRigid", nodeNumber=self.add("NodePointGround", referenceCoordinates=list(place)))
        self.add("RigidBodySpringDamper", markerNumbers=[ground, marker], stiffness=numpy.diag([float(k) for k in spring.stiffness]),
                 rotationMarker1=transposed(self.frame[number]))

    def _joint(self, p: int, q: int, P: Matrix, Q: Matrix, axes: list[int], along: Matrix) -> int:
        """Adds a joint. P, Q: axes of both markers. along: axes of the joint."""
        return self.add("GenericJoint", markerNumbers=[p, q], constrainedAxes=axes, rotationMarker0=product(transposed(P), along),
                        rotationMarker1=product(transposed(Q), along))

    def _support(self, name: str, marker: int) -> None:
        node = self.scene.nodes[name]
        for word, motion in node.drive.items():
            if word[0] == "u":
                k = COMPONENTS.index(word)
                self.constrain(name, self.of[name][0], k, k, motion)
            elif any(v != 0 for v in self.scene.motions[motion].get("value", ())):
                raise Refused(f"drive: the driver cannot prescribe {word} in space along a load path")
        held = node.hold | self.loose.get(name, frozenset())
        axes = [int(c in held or (c in node.drive and c[0] == "r")) for c in COMPONENTS]
        if sum(axes[3:]) == 1 and not self._about_normal(axes) and any(a.kind not in ("modal", "buckling") or a.about
                                                                       for a in self.scene.analyses.values()):
            raise Refused(f"hold: the driver does not hold one rotation of {name}")
        if any(axes):
            frame = self.frame[self.of[name][0]]
            ground = self.add("MarkerNodeRigid", nodeNumber=self.add(
                "NodePointGround", referenceCoordinates=list(node.at)))
            joint = self._joint(ground, marker, rotation([0, 0, 0]), frame, axes, rotation([0, 0, 0]))
            self.held.setdefault(name, []).append((joint, [k for k in range(6) if axes[k]]))
            self._turn(name, joint, axes)

    def _about_normal(self, axes: list[int]) -> bool:
        """Returns True if the only fixed rotation is the rotation in the plane in which the structure stays."""
        normal = _motion.normal(self.scene)
        return normal is not None and sum(axes[3:]) == 1 and axes[3 + normal] == 1 and not _exudyn_motion.moves(self.scene)

    def _turn(self, name: str, joint: int, axes: list[int]) -> None:
        driven = [(word, motion) for word, motion in self.scene.nodes[name].drive.items() if word[0] == "r"]
        if self._about_normal(axes):
            return
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
