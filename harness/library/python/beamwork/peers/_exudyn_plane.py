"""Geometrically exact beams of Exudyn in the xy plane."""
from __future__ import annotations

import math
from typing import Any

from . import _exudyn_motion, _motion
from ._exudyn_model import Steps, check_plane, shear_of
from ._hinges import hinges, idle
from .data import COMPONENTS, Matrix, Mesh, MeshElement, Scene, State, rotation


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
        ends = self._hinges()
        for index, element in enumerate(mesh.elements):
            s, shear = element.member.section, shear_of(element.member.section, scene)
            z = abs(element.R[2][2]) > 0.5
            chord = math.dist(*(mesh.nodes[element.nodes[k]].at for k in (0, -1)))
            self.beams.append((element, self.add(
                "ObjectBeamGeometricallyExact2D", nodeNumbers=ends[index], length=chord,
                bendingStiffness=s.EIz if z else s.EIy, axialStiffness=s.EA, shearStiffness=shear[0 if z else 1],
                massPerLength=s.rho_A, crossSectionInertia=_exudyn_motion.inertia(scene, s)[2 if z else 1], includeReferenceRotations=False)))
        loose = idle(scene)
        for node in scene.nodes.values():
            number = self.nodes[mesh.node_of[node.name]]
            mass, inertia = _exudyn_motion.body(node)
            if mass or any(inertia):
                self.add("ObjectRigidBody2D", nodeNumber=number, physicsMass=mass, physicsInertia=inertia[2])
            for coordinate, component in enumerate((0, 1, 5)):
                word = COMPONENTS[component]
                if word in node.hold or word in node.drive or word in loose.get(node.name, ()):
                    self.constrain(node.name, number, coordinate, component, node.drive.get(word, ""))
        for spring in scene.springs:
            for coordinate, component in enumerate((0, 1, 5)):
                if spring.stiffness[component] != 0:
                    both = [self.add("MarkerNodeCoordinate", nodeNumber=k, coordinate=c)
                            for k, c in ((self.ground, 0), (self.node_of(spring.end), coordinate))]
                    self.add("CoordinateSpringDamper", markerNumbers=both, stiffness=spring.stiffness[component])
        markers = {node: self.add("MarkerNodeRigid", nodeNumber=self.nodes[mesh.node_of[node]]) for node in scene.nodes}
        self.put_loads(markers.__getitem__)
        self.add_sensors()
        self.assemble(3 * len(mesh.nodes) + len(self.released))

    def _hinges(self) -> list[list[int]]:
        """Adds a node for each released end. Returns the nodes of all elements."""
        ends = [[self.nodes[k] for k in element.nodes] for element in self.mesh.elements]
        self.released: list[int] = []
        for hinge in hinges(self.scene, self.mesh):
            number = self.add("NodeRigidBody2D", referenceCoordinates=[*self.mesh.nodes[hinge.node].at[:2], 0])
            for coordinate, word in enumerate(("ux", "uy", "rz")):
                if word not in hinge.components:
                    both = [self.add("MarkerNodeCoordinate", nodeNumber=k, coordinate=coordinate) for k in (self.nodes[hinge.node], number)]
                    self.add("CoordinateConstraint", markerNumbers=both)
            ends[hinge.element][-hinge.end] = number
            self.released.append(number)
        return ends

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
        return [(node.name, self.nodes[node.number]) for node in self.mesh.nodes] + [(None, number) for number in self.released]

    def coordinate_rates(self, node: int, v: list[float], w: list[float]) -> list[float]:
        return [v[0], v[1], w[2]]

    def stiffness_of(self, element: MeshElement) -> Any:
        s, shear, z = element.member.section, shear_of(element.member.section, self.scene), abs(element.R[2][2]) > 0.5
        return [s.EA, shear[0 if z else 1], math.inf, math.inf, math.inf, s.EIz if z else s.EIy]
