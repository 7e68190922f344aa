"""Critical factors of the beam of Exudyn in space, from differences of its tangent stiffness matrices at small loads."""
from __future__ import annotations

import dataclasses
from typing import Any

from ._exudyn_modes import free_motions, require_no_torque, tangent
from ._modes import critical_factors, require_still_springs
from .data import Answer, Failed, Refused

# first displacement divided by the length, or first rotation; ratio of the second load to the critical load
_FIRST, _SECOND = 1e-6, 3e-3


def _moved(model: Any, path: float) -> Any:
    """Applies the loads times `path` to the undeformed model, and returns its coordinates."""
    model.mbs.systemData.SetODE2Coordinates(model.undeformed, configuration=model.exu.ConfigurationType.Current)
    if not model.step(path):
        raise Failed("Newton's method does not converge at small loads")
    require_no_torque(model, model.state(), {})
    return model.mbs.systemData.GetODE2Coordinates(configuration=model.exu.ConfigurationType.Current)


def _slope(model: Any, path: float) -> Any:
    """Returns the derivative of the tangent with respect to the loads. The part due to the displacements, which linear
    buckling neglects, is that of a structure without stresses whose nodes are displaced."""
    out = 0.0
    for sign in (1, -1):
        coordinates = _moved(model, sign * path)
        places = [(model.get("Node", node, "Position"), model.matrix_of(node)) for node in model.frame]
        free = type(model)(dataclasses.replace(model.scene, loads=()), model.name, model.mesh, places)
        out += sign * (tangent(model, coordinates)[0] - tangent(free, [0.0] * len(coordinates))[0]) / (2 * path)
    return out


def buckling(model: Any) -> Answer:
    """Computes the critical factors of all loads."""
    scene = model.scene
    if any("factor" in load.raw for load in scene.loads) or any(node.drive for node in scene.nodes.values()):
        raise Refused("buckling: the driver supports only loads proportional to the load factor, and no driven nodes")
    require_still_springs(scene, model.mesh)
    if any(load.kind.endswith("moment") or load.follower for load in scene.loads):
        raise Refused("buckling: the driver supports neither moments nor follower loads")
    model.settings_of.staticSolver.newton.relativeTolerance = model.settings_of.staticSolver.newton.absoluteTolerance = 1e-13
    K, constraints = tangent(model, model.undeformed)
    free = free_motions(constraints)
    _moved(model, 1e-9)
    largest = max(abs(x) / (scene.length() if i < 3 else 1) for node in model.frame
                  for i, x in enumerate([*model.get("Node", node, "Displacement"), *model.get("Node", node, "Coordinates")[3:]]))
    if largest == 0:
        raise Refused("buckling: there are no loads")
    factors = critical_factors(free.T @ K @ free, free.T @ _slope(model, 1e-9 * _FIRST / largest) @ free)
    if factors:
        factors = critical_factors(free.T @ K @ free, free.T @ _slope(model, _SECOND * factors[0]) @ free)
    return Answer(factors=factors, iterations=8)
