"""Critical factors of OpenSees, from differences of its tangent stiffness matrices at small loads, as M. H. Scott documents
in "Right Under Your Nose" (Portwood Digital, 2021)."""
from __future__ import annotations

from typing import Any

from ._modes import critical_factors, require_still_springs
from .data import Answer, Failed, Refused

# largest displacement divided by the length, or rotation, under the first loads; ratio of the second to the critical loads
_FIRST, _SECOND = 1e-6, 1e-3


def _moved(model: Any, path: float) -> dict[int, list[float]]:
    """Applies the loads times `path` to the new model, and returns the displacements and rotations of nodes."""
    ops = model.ops
    ops.test("FixedNumIter", 5)
    ops.integrator("LoadControl", path)
    ops.analysis("Static", "-noWarnings")
    if ops.analyze(1) != 0:
        raise Failed("Newton's method does not converge at small loads")
    return {int(number): [float(x) for x in ops.nodeDisp(number)] for number in ops.getNodeTags()}


def _slope(model: Any, path: float) -> Any:
    """Returns the derivative of the tangent with respect to the loads. Linear buckling neglects the part due to the
    displacements. It is the change for a structure without stresses whose nodes are displaced, and is subtracted."""
    out = 0.0
    for sign in (1, -1):
        model.build()
        u = _moved(model, sign * path)
        tangent = model.matrices()[1]
        model.build(moved=u)
        out += sign * (tangent - model.matrices()[1]) / (2 * path)
    return out


def buckling(model: Any) -> Answer:
    """Computes the critical factors of all loads."""
    scene = model.scene
    if any("factor" in load.raw for load in scene.loads) or any(node.drive for node in scene.nodes.values()):
        raise Refused("buckling: the driver supports only loads proportional to the load factor, and no driven nodes")
    require_still_springs(scene, model.mesh)
    if any(load.kind.endswith("moment") for load in scene.loads):
        raise Refused("buckling: not tested with moments as loads")
    model.build()
    largest = max(abs(x) / (scene.length() if i < 3 else 1) for u in _moved(model, 1e-9).values() for i, x in enumerate(u))
    if largest == 0:
        raise Refused("buckling: there are no loads")
    model.build()
    K = model.matrices()[1]
    factors = critical_factors(K, _slope(model, 1e-9 * _FIRST / largest))
    if factors:
        factors = critical_factors(K, _slope(model, _SECOND * factors[0]))
    return Answer(factors=factors, iterations=26)
