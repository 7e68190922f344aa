"""Released ends of members: the components that they release, and the rotations of nodes that affect nothing."""
from __future__ import annotations

import dataclasses
from collections.abc import Mapping

from . import _motion
from .data import COMPONENTS, Member, Mesh, Refused, Scene


@dataclasses.dataclass(frozen=True)
class Hinge:
    """A released end. element: index in the mesh. end: 0 or 1. node: index of the node in the mesh. own: released
    components in the axes of the member. components: released components in global axes."""
    element: int
    end: int
    node: int
    own: frozenset[str]
    components: frozenset[str]


def _released(member: Member, end: int) -> frozenset[str]:
    return frozenset(member.raw.get("release", {}).get(("from", "to")[end], ()))


def _in_space(member: Member, own: frozenset[str]) -> frozenset[str]:
    """Returns released components in global axes."""
    out = {c for c in COMPONENTS[3:] if set(COMPONENTS[3:]) <= own}
    for word in own - out:
        axis = "xyz".index(word[1])
        along = [j for j in range(3) if abs(member.axes[j][axis]) > 1 - 1e-9]
        if not along:
            raise Refused(f"release: drivers release one or two rotations, or displacements, along global axes only ({member.name})")
        out.add(word[0] + "xyz"[along[0]])
    return frozenset(out)


def hinges(scene: Scene, mesh: Mesh) -> list[Hinge]:
    out = []
    for member in scene.members.values():
        indices = [i for i, e in enumerate(mesh.elements) if e.member.name == member.name]
        for end, index in enumerate((indices[0], indices[-1])):
            own = _released(member, end)
            if own:
                out.append(Hinge(index, end, mesh.elements[index].nodes[-end], own, _in_space(member, own)))
    return out


def check_hinges(scene: Scene) -> None:
    """Raises Refused if a release depends on large rotations in space, or on the axes of a curved member, or if critical
    loads computed by drivers would converge slowly or not at all."""
    if any(a.kind == "buckling" for a in scene.analyses.values()) and any("release" in m.raw for m in scene.members.values()):
        raise Refused("release: drivers do not support buckling analyses of members with hinges")
    small = all(a.kind == "linear" or (a.kind == "modal" and not a.about) for a in scene.analyses.values())
    normal = _motion.normal(scene)
    for member in scene.members.values():
        for end in (0, 1):
            own = _released(member, end)
            if own and any(member.curvature):
                raise Refused(f"release: drivers do not support hinges of curved members ({member.name})")
            in_plane = normal is not None and own and _in_space(member, own) == {"r" + "xyz"[normal]}
            if own and not (small or in_plane or own == set(COMPONENTS[3:])):
                raise Refused("release: in large motions, drivers support only ball joints, and hinges about the normal of the plane in which "
                              f"the structure moves ({member.name})")


def idle(scene: Scene) -> Mapping[str, frozenset[str]]:
    """Returns the free rotations of nodes to which all members are hinged, so that nothing depends on these rotations."""
    ends: dict[str, list[frozenset[str]]] = {}
    for member in scene.members.values():
        for end, node in enumerate(member.ends):
            released = _released(member, end)
            ends.setdefault(node, []).append(_in_space(member, released) if released else frozenset())
    out = {}
    for name, all_ in ends.items():
        own = scene.nodes[name]
        sprung = {c for s in scene.springs for c, k in zip(COMPONENTS, s.stiffness) if k != 0 and name in (s.begin, s.end)}
        free = frozenset.intersection(*all_) & set(COMPONENTS[3:]) - own.hold - set(own.drive) - sprung
        if free and any(load.kind == "moment" and load.node == name for load in scene.loads):
            raise Refused(f"release: a moment acts on {name}, to which all members have hinges")
        if free:
            out[name] = free
    return out
