"""Springs and released ends of members in OpenSees and xara: zero-length elements, and nodes with equal components."""
from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ._hinges import hinges, idle
from .data import COMPONENTS, Mesh, Scene, Vector


def add_springs(ops: Any, scene: Scene, mesh: Mesh, moved: Mapping[int, Vector] | None) -> None:
    """Adds a zero-length element for each spring. A spring to the ground also gets a fixed node. ops: the interface of the
    program. moved: displacements of the nodes; None: the structure is undeformed."""
    for i, spring in enumerate(scene.springs):
        number, directions = mesh.node_of[spring.end], [k for k in range(6) if spring.stiffness[k] != 0]
        begin = mesh.node_of[spring.begin] if spring.begin else len(mesh.nodes) + i
        if not spring.begin:
            ops.node(begin, *(float(a + b) for a, b in zip(mesh.nodes[number].at, moved[number] if moved else (0, 0, 0))))
            ops.fix(begin, *[1] * 6)
        tags = [6 * i + k + 1 for k in directions]
        for tag, k in zip(tags, directions):
            ops.uniaxialMaterial("Elastic", tag, spring.stiffness[k])
        ops.element("zeroLength", len(mesh.elements) + i + 1, begin, number, "-mat", *tags, "-dir", *(k + 1 for k in directions))


def add_hinges(ops: Any, scene: Scene, mesh: Mesh, moved: Mapping[int, Vector] | None) -> list[list[int]]:
    """Adds a node for each released end of a member. The components of this node that are not released equal those of the node
    to which the member is connected. Returns the nodes of all elements."""
    out = [list(e.nodes) for e in mesh.elements]
    for i, hinge in enumerate(hinges(scene, mesh)):
        number = len(mesh.nodes) + len(scene.springs) + i
        ops.node(number, *(float(a + b) for a, b in zip(mesh.nodes[hinge.node].at, moved[hinge.node] if moved else (0, 0, 0))))
        ops.equalDOF(hinge.node, number, *(k + 1 for k, c in enumerate(COMPONENTS) if c not in hinge.components))
        out[hinge.element][-hinge.end] = number
    for name, rotations in idle(scene).items():
        held = scene.held_at(mesh.nodes[mesh.node_of[name]])
        ops.fix(mesh.node_of[name], *(int(c in rotations and c not in held) for c in COMPONENTS))
    return out


def reactions(ops: Any, scene: Scene, mesh: Mesh) -> dict[str, list[float]]:
    """Returns the reactions at the nodes of the scene, including the forces of released ends, which the program reports at
    separate nodes."""
    out = {name: [float(x) for x in ops.nodeReaction(number)] for name, number in mesh.node_of.items()}
    for i, hinge in enumerate(hinges(scene, mesh)):
        more = ops.nodeReaction(len(mesh.nodes) + len(scene.springs) + i)
        own = out[str(mesh.nodes[hinge.node].name)]
        own[:] = [a + (0.0 if c in hinge.components else float(b)) for a, b, c in zip(own, more, COMPONENTS)]
    return out
