"""Critical factors of Kratos, from differences of its tangent stiffness matrices, as in its prebuckling analysis."""

from __future__ import annotations

from typing import Any

from ._modes import critical_factors, require_axial_loads
from .data import Answer, Failed, Refused

# largest displacement divided by the length, or rotation, under the first loads; ratio of the second to the critical loads
_FIRST, _SECOND = 1e-3, 1e-2

_ITERATIONS = 6


def _state(model: Any, path: float) -> tuple[Any, dict[int, list[float]]]:
    """Returns the tangent, and displacements and rotations of nodes, under the loads times `path`."""
    part = model.new("CrBeamElement3D2N")
    part.CloneTimeStep(1.0)
    loads = {n: [path * x for x in vector] for n, vector in model.loads(None).items()}
    if not model.run(part, model.strategy(part, linear=False, most=_ITERATIONS), loads, {}, few=True):
        raise Failed("Newton's method does not converge at small loads")
    return model.matrix(part, "stiffness"), {
        number: [float(part.Nodes[number + 1].GetSolutionStepValue(v)) for v in model.displacements]
        for number in range(len(model.mesh.nodes))
    }


def _slope(model: Any, path: float) -> Any:
    """Returns the derivative of the tangent with respect to the loads. Linear buckling neglects the part due to the
    displacements. It is the change for a structure without stresses whose nodes are displaced, and is subtracted."""
    out = 0.0
    for sign in (1, -1):
        tangent, u = _state(model, sign * path)
        part = model.new("CrBeamElement3D2N", u)
        part.CloneTimeStep(1.0)
        model.strategy(part, linear=False).InitializeSolutionStep()
        out += sign * (tangent - model.matrix(part, "stiffness")) / (2 * path)
    return out


def buckling(model: Any) -> Answer:
    """Computes the critical factors of all loads."""
    scene = model.scene
    if any("factor" in load.raw for load in scene.loads) or model.driven:
        raise Refused("buckling: the driver supports only loads proportional to the load factor, and no driven nodes")
    require_axial_loads(scene, model.mesh, "forces of bent members are not accurate at small loads")
    part = model.linear_part()
    model.run(part, model.strategy(part, linear=True), model.loads(None), {})
    largest = max(
        abs(float(node.GetSolutionStepValue(v))) / (scene.length() if i < 3 else 1)
        for node in part.Nodes
        for i, v in enumerate(model.displacements)
    )
    if largest == 0:
        raise Refused("buckling: there are no loads")
    free = [i for i in range(6 * len(model.mesh.nodes)) if (i // 6, i % 6) not in model.held]
    part = model.new("CrBeamElement3D2N")
    part.CloneTimeStep(1.0)
    model.strategy(part, linear=False).InitializeSolutionStep()
    K = model.matrix(part, "stiffness")[free][:, free]
    factors = critical_factors(K, _slope(model, _FIRST / largest)[free][:, free])
    if factors:
        factors = critical_factors(K, _slope(model, _SECOND * factors[0])[free][:, free])
    return Answer(factors=factors, iterations=4)
