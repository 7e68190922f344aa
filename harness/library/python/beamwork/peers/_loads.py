"""Loads as forces and moments at the nodes of a mesh."""
from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from .data import Load, Mesh, MeshElement, Refused, Scene, Vector, times

_GAUSS = ((-math.sqrt(0.6), 5 / 9), (0.0, 8 / 9), (math.sqrt(0.6), 5 / 9))
KEYS = frozenset({"loads.distributed", "loads.distributed_moment", "loads.from", "loads.to", "loads.to_value", "loads.lumped",
                  # keys that `nodal` supports; tapered members require no support by drivers
                  "loads.where", "loads.gravity", "taper"})
THERMAL = frozenset({"loads.temperature", "loads.gradient"})  # additional keys in linear analyses


def _shapes(order: int, x: float) -> list[float]:
    """Returns the values at x, from 0 to 1, of the polynomials that interpolate between the nodes of an element."""
    at = [k / order for k in range(order + 1)]
    return [math.prod((x - b) / (a - b) for b in at if b != a) for a in at]


def acts(load: Load, element: MeshElement) -> bool:
    """Returns True if a load along members acts on an element."""
    begin, end = load.raw.get("from", 0.0), load.raw.get("to", 1.0)
    return element.member.name == load.member and begin - 1e-3 <= element.begin and element.end <= end + 1e-3


def _place(load: Load, mesh: Mesh) -> int:
    """Returns the node of the mesh at which a load within a member acts."""
    where = float(load.raw["where"])
    ends = [(abs(at - where), number) for e in mesh.elements if e.member.name == load.member
            for at, number in ((e.begin, e.nodes[0]), (e.end, e.nodes[-1]))]
    return min(ends)[1]


def vectors(load: Load) -> list[Vector]:
    """Returns the vectors between which a load varies."""
    return [load.vector, *([load.raw["to_value"]] if "to_value" in load.raw else [])]


def require_known(scene: Scene) -> None:
    """Raises Refused if `nodal` does not support a load, or if the load is a follower load."""
    for load in scene.loads:
        if load.follower:
            raise Refused("follower loads: this driver applies dead loads only")
        if load.kind not in ("force", "moment", "distributed", "distributed_moment", "gravity", "temperature"):
            raise Refused(f"loads: the driver does not support loads of the kind {load.kind}")


def _thermal(load: Load, mesh: Mesh, scene: Scene) -> dict[int, list[float]]:
    """Returns the forces and moments that cause the same elongation and curvature of unloaded elements as a
    change of temperature."""
    out: dict[int, list[float]] = {}
    for e in filter(lambda one: acts(load, one), mesh.elements):
        s = e.member.section
        expansion = float(scene.raw["scene"]["sections"][s.name].get("expansion", 0))
        y, z = load.raw.get("gradient", (0.0, 0.0))
        for k, frame, sign in ((e.nodes[0], e.frames[0], -1), (e.nodes[-1], e.frames[-1], 1)):
            force = times(frame, [sign * expansion * s.EA * float(load.raw["temperature"]), 0.0, 0.0])
            moment = times(frame, [0.0, sign * expansion * s.EIy * z, -sign * expansion * s.EIz * y])
            out[k] = [a + b for a, b in zip(out.get(k, [0.0] * 6), [*force, *moment])]
    return out


def nodal(load: Load, mesh: Mesh, scene: Scene) -> Mapping[int, Sequence[float]]:
    """Returns the forces and moments [6] on nodes of the mesh at the factor 1. Loads along members are distributed
    with the interpolation of the element, so forces along a member give no moments at the nodes, and results
    converge with order 2 for elements of two nodes."""
    kind = load.kind
    if kind == "temperature":
        return _thermal(load, mesh, scene)
    if kind not in ("force", "moment", "distributed", "distributed_moment", "gravity"):
        raise Refused(f"{kind}: the driver supports only forces and moments")
    first = 3 if kind.endswith("moment") else 0
    out: dict[int, list[float]] = {}

    def add(number: int, vector: Sequence[float], factor: float) -> None:
        target = out.setdefault(number, [0.0] * 6)
        for i in range(3):
            target[first + i] += factor * vector[i]

    if load.member is None or "where" in load.raw:
        weight = float(scene.nodes[str(load.node)].raw.get("mass", 0)) if kind == "gravity" else 1.0
        add(mesh.node_of[load.node] if load.node is not None else _place(load, mesh), load.vector, weight)
        return out
    last = load.raw.get("to_value", load.vector)
    begin, end = load.raw.get("from", 0.0), load.raw.get("to", 1.0)
    for e in filter(lambda one: acts(load, one), mesh.elements):
        density = e.member.section.rho_A if kind == "gravity" else 1.0
        for place, weight in _GAUSS:
            x = (1 + place) / 2
            s = (e.begin + (e.end - e.begin) * x - begin) / (end - begin)
            value = [a + (b - a) * s for a, b in zip(load.vector, last)]
            for number, shape in zip(e.nodes, _shapes(len(e.nodes) - 1, x)):
                add(number, value, density * weight / 2 * e.length * shape)
    return out
