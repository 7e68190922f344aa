"""The ANCF cable of Exudyn in the xy plane."""
from __future__ import annotations

import math
from typing import Any

from ._exudyn_joint import torque_of
from ._exudyn_model import Steps, check_plane
from .data import COMPONENTS, Matrix, Mesh, Refused, Scene, State, Vector, rotation

_PLANE = (0, 1, 5)


class Cable(Steps):
    """Each end of a member has a node with a slope vector; rigid joints connect the ends."""

    def __init__(self, scene: Scene, name: str, mesh: Mesh) -> None:
        super().__init__(scene, name, mesh)
        check_plane(scene)
        self.direction: dict[int, float] = {}
        self.angle: dict[str, float] = dict.fromkeys(scene.nodes, 0.0)
        made = self.nodes_of_members()
        for element in mesh.elements:
            ends = [made[element.member.name, k] for k in element.nodes]
            s = element.member.section
            self.add("ObjectANCFCable2D", nodeNumbers=ends, length=element.length, massPerLength=s.rho_A,
                     bendingStiffness=s.EIz if abs(element.R[2][2]) > 0.5 else s.EIy, axialStiffness=s.EA,
                     useReducedOrderIntegration=2, strainIsRelativeToReference=1.0)
        markers, joints = {}, 0
        for node, (first, *others) in self.of.items():
            markers[node] = self.add("MarkerNodeRigid", nodeNumber=first)
            for other in others:
                joints += 3
                self._joint(markers[node], self.add("MarkerNodeRigid", nodeNumber=other), first, other, [1, 1, 0, 0, 0, 1])
            self._support(node, markers[node])
        self.put_loads(markers.__getitem__)
        self.assemble(4 * len(made) - joints)
        self.settings = "SolveStatic, Newton increments below 1e-8, sparse, adaptive load steps"

    def add_node(self, at: Vector, frame: Matrix) -> int:
        x, y = frame[0][0], frame[1][0]
        node = self.add("NodePoint2DSlope1", referenceCoordinates=[*at[:2], x, y])
        self.direction[node] = math.atan2(y, x)
        return node

    def _joint(self, p: int, q: int, first: int | None, other: int, axes: list[int]) -> int:
        turns = [rotation([0, 0, -self.direction[k]]) if k is not None else rotation([0, 0, 0]) for k in (first, other)]
        return self.add("GenericJoint", markerNumbers=[p, q], constrainedAxes=axes, rotationMarker0=turns[0], rotationMarker1=turns[1])

    def _support(self, name: str, marker: int) -> None:
        node = self.scene.nodes[name]
        for word, motion in node.drive.items():
            k = COMPONENTS.index(word)
            if k < 2:
                self.constrain(name, self.of[name][0], k, k, motion)
            elif any(v != 0 for v in self.scene.motions[motion]["value"]):
                raise Refused(f"drive: the driver cannot prescribe {word} of a cable")
        axes = [int(k in _PLANE and (c in node.hold or (c in node.drive and k == 5))) for k, c in enumerate(COMPONENTS)]
        if any(axes):
            ground = self.add("MarkerNodeRigid", nodeNumber=self.add("NodePointGround", referenceCoordinates=list(node.at)))
            joint = self._joint(ground, marker, None, self.of[name][0], axes)
            self.held.setdefault(name, []).append((joint, [k for k in range(6) if axes[k]]))

    def frame_of(self, name: str) -> Matrix:
        return rotation([0, 0, self.direction[self.of[name][0]]])

    def rotations(self) -> list[Matrix]:
        """Returns the rotation matrices of the nodes of the scene. The angles are followed over several turns."""
        for name, (node, *_) in self.of.items():
            slope = self.mbs.GetNodeOutput(node, self.exu.OutputVariableType.Coordinates)[2:]
            x, y = (float(a) + b for a, b in zip(slope, (math.cos(self.direction[node]), math.sin(self.direction[node]))))
            turned = math.atan2(y, x) - self.direction[node]
            self.angle[name] += math.remainder(turned - self.angle[name], 2 * math.pi)
        return [rotation([0, 0, angle]) for angle in self.angle.values()]

    def state(self, get: Any = None) -> State:
        get = get or self.get
        u, reaction = dict[str, Any](), dict[str, Any]()
        for name, (node, *_) in self.of.items():
            x, y = get("Node", node, "Coordinates")[:2]
            u[name] = [x, y, 0.0, 0.0, 0.0, self.angle[name]]
            reaction[name] = [0.0] * 6
            for item, components in self.held.get(name, []):
                if item in [d for _, d in self.driven]:
                    reaction[name][components[0]] = get("Object", item, "Force")[0]
                    continue
                held = [k - 3 for k in components if k > 2]
                torque = torque_of(get("Object", item, "TorqueLocal"), held, rotation([0, 0, self.angle[name]]))
                both = [*get("Object", item, "ForceLocal")[:3], *torque]
                for k in components:
                    reaction[name][k] = both[k]
        return State(u, reaction)
