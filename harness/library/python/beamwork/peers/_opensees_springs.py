"""Springs of OpenSees and xara: zero-length elements."""
from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from .data import Mesh, Scene, Vector


def add_springs(ops: Any, scene: Scene, mesh: Mesh, moved: Mapping[int, Vector] | None) -> None:
    """Adds an element for each spring, with a node for the ground. ops: the interface of the program. moved: displacements of
    the nodes."""
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
