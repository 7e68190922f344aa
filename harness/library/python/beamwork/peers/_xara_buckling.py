"""Critical factors of xara, from differences of its tangent stiffness matrices at small loads, as those of OpenSees."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ._modes import critical_factors, require_axial_loads, require_still_springs
from .data import Answer, Failed, MeshElement, Refused, Vector, cross, transposed

# first displacement divided by the length, or first rotation; ratio of the second load to the critical load
_FIRST, _SECOND = 1e-6, 3e-3


def moved_axis(e: MeshElement, moved: Mapping[int, Vector]) -> tuple[list[float], float]:
    """Returns the z axis of an element that rotates with its nodes, and the ratio of its new length to its initial
    length. Multiplying the stiffnesses of the section by this ratio keeps those of the element."""
    u, v = moved[e.nodes[0]], moved[e.nodes[-1]]
    z = transposed(e.R)[2]
    z = [a + (b + c) / 2 for a, b, c in zip(z, cross(u[3:], z), cross(v[3:], z))]
    return z, 1 + sum((b - a) * row[0] for a, b, row in zip(u, v, e.R)) / e.length


def _tangent(owner: Any, model: Any, path: float) -> tuple[Any, dict[int, list[float]]]:
    """Applies the loads multiplied by `path`. Returns the tangent by nodes and components, and the displacements and
    rotations of nodes."""
    import numpy as np

    owner.drives.clear()
    owner.prepare(model)
    if path:
        owner.apply(model, [], path)
        model.test("FixedNumIter", 5)
    model.integrator("LoadControl", 1.0 if path else 0.0)
    if model.analyze(1) != 0:
        raise Failed("Newton's method does not converge at small loads")
    numbers = [node.number for node in owner.mesh.nodes]
    order = [k for number in numbers for k in model.nodeDOFs(number) if k >= 0]
    u = {number: [float(x) for x in model.nodeDisp(number)] for number in numbers}
    return owner.tangent(model)[np.ix_(order, order)], u


def _slope(owner: Any, path: float) -> Any:
    """Returns the derivative of the tangent with respect to the loads. The part due to the
    displacements, which linear buckling neglects, is that of a structure without stresses whose
    nodes are displaced."""
    out = 0.0
    for sign in (1, -1):
        K, u = _tangent(owner, owner.new(), sign * path)
        out += sign * (K - _tangent(owner, owner.new(u), 0.0)[0]) / (2 * path)
    return out


def buckling(owner: Any) -> Answer:
    """Computes the critical factors of all loads."""
    scene = owner.scene
    if any("factor" in load.raw for load in scene.loads) or any(node.drive for node in scene.nodes.values()):
        raise Refused("buckling: the driver supports only loads proportional to the load factor, and no driven nodes")
    require_still_springs(scene, owner.mesh)
    if any(load.kind.endswith("moment") for load in scene.loads):
        raise Refused("buckling: the driver does not support moments as loads")
    if any(math.isfinite(k) for s in scene.sections.values() for k in s.GA):
        require_axial_loads(scene, owner.mesh, "frames that are sheared before buckling have no reference state in xara")
    K, _ = _tangent(owner, owner.new(), 0.0)
    _, u = _tangent(owner, owner.new(), 1e-9)
    largest = max(abs(x) / (scene.length() if i < 3 else 1) for v in u.values() for i, x in enumerate(v))
    if largest == 0:
        raise Refused("buckling: there are no loads")
    factors = critical_factors(K, _slope(owner, 1e-9 * _FIRST / largest))
    if factors:
        factors = critical_factors(K, _slope(owner, _SECOND * factors[0]))
    return Answer(factors=factors, iterations=12)
