"""Reads a scene as data, checks whether an element of a peer can express it, and extracts its quantities."""
from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from . import _motion
from ._hinges import check_hinges, idle
from .data import COMPONENTS, Analysis, Answer, Element, Load, Member, Node, Quantity, Refused, Scene, Section, Spring, times

_KNOWN = {
    "nodes": {"at", "hold", "drive", "fork"},
    "members": {"from", "to", "section", "y", "warping", "curvature", "divisions"},
    "motions": {"path", "value", "pieces", "unit"},
    "loads": {"force", "moment", "on", "path", "factor", "pieces"},
    "springs": {"to", "stiffness"},
    "": {"beamwork", "name", "summary", "source", "sections", "nodes", "members", "loads", "motions", "analyses",
         "quantities", "omit", "shear_theory", "meshes"},
}  # keys that every driver supports; others are in Element.keys
_ANALYSIS: dict[str, set[str]] = {"linear": set(), "static": {"stations", "steps"}, "buckling": {"wanted"}, "modal": {"wanted"},
             "compliance": {"about", "node", "moments", "released"},
             "motion": {"stations", "about", "start"} | _motion.NUMERICS,
             "continuation": {"control", "by", "to", "step", "step_max", "constant"}}
_QUANTITY: dict[str, set[str]] = {"displacement": {"node", "component"}, "reaction": {"node", "component"},
             "compliance": {"row", "column"}, "stiffness": {"component"}, "critical_factor": {"which"},
             "frequency": {"which", "family"}, "critical_point": {"kind", "value", "which"}, "factor_at": set()}

_STATICS = {"linear", "static", "continuation", "compliance"}
_OF_KINDS = frozenset({"mass", "rotary inertia", "geometric"})  # physics without effect on statics


def _section(name: str, raw: Mapping[str, Any], physics: frozenset[str]) -> Section:
    E, G, density = raw["E"], raw["G"], raw["density"]
    F = [raw["F"][i][i] if "shear" in physics else 0.0 for i in range(2)]
    rotary = density if "rotary inertia" in physics else 0.0
    mass, inertia = density * raw["A"], (density * raw["Ip"], rotary * raw["Iy"], rotary * raw["Iz"])
    if "mass" in raw:
        own = [raw["mass"][i][i] if i == 3 or "rotary inertia" in physics else 0.0 for i in (3, 4, 5)]
        mass, inertia = raw["mass"][0][0], (own[0], own[1], own[2])
    GA = tuple(G / f if f > 0 else math.inf for f in F)
    return Section(name, raw, E * raw["A"], (GA[0], GA[1]), G * raw["It"], E * raw["Iy"], E * raw["Iz"], mass, inertia)


def _load(name: str, raw: Mapping[str, Any], members: Mapping[str, Member]) -> Load:
    kind = next(iter(raw))
    on = raw.get("on", "")
    if raw.get("axes") == "member" and on in members and not any(members[on].curvature):
        raw = {key: times(members[on].axes, value) if key in (kind, "to_value", "at") else value for key, value in raw.items()
               if key != "axes"}
    along = kind.startswith("distributed") or "where" in raw or (on in members and kind in ("gravity", "temperature"))
    vector = raw[kind] if isinstance(raw[kind], list) else (0.0, 0.0, 0.0)
    return Load(name, kind, vector, None if along else on, on if along else None,
                raw.get("follower") in ("true", "yes"), raw)


def _analysis(name: str, entry: Mapping[str, Any]) -> Analysis:
    kind = next(iter(entry))
    raw = entry[kind]
    return Analysis(name, kind, tuple(raw.get("stations", ())), raw.get("about"), raw)


def _quantity(name: str, entry: Mapping[str, Any]) -> Quantity:
    kind = next(iter(entry))
    raw = entry[kind]
    return Quantity(name, kind, raw.get("analysis", ""), entry["unit"], entry.get("factor", 1.0),
                    entry.get("offset", 0.0), raw, entry.get("x", {}), entry)


def _forked(entry: Mapping[str, Any]) -> set[str]:
    """Returns the small rotation that a fork prevents, if its axis is a global one."""
    axis = entry["fork"]["axis"] if "fork" in entry else (0, 0, 0)
    return {"r" + "xyz"[i] for i in range(3) if axis[i] != 0 and all(axis[k] == 0 for k in range(3) if k != i)}


def _turning(name: str, entry: Mapping[str, Any]) -> Node:
    """Returns a node. A rotation about one global axis is that of a node whose other rotations are held."""
    hold, drive = set(entry.get("hold", ())) | _forked(entry), dict(entry.get("drive", {}))
    sequence = entry.get("rotation", {}).get("sequence", [])
    if len(sequence) == 1 and not any(c[0] == "r" for c in (*hold, *drive)):
        axis, angle = sequence[0]["axis"], sequence[0]["angle"]
        own = [i for i in range(3) if axis[i] > 0 and all(axis[k] == 0 for k in range(3) if k != i)]
        if own:
            turned = COMPONENTS[3 + own[0]]
            hold |= {c for c in COMPONENTS[3:] if c != turned or angle == "held"}
            drive |= {} if angle in ("free", "held") else {turned: angle}
            entry = {key: value for key, value in entry.items() if key != "rotation"}
    return Node(name, entry["at"], frozenset(hold), drive, entry)


def scene_of(raw: Mapping[str, Any]) -> Scene:
    file, physics = raw["scene"], frozenset(raw["physics"])
    sections = {name: _section(name, constants, physics) for name, constants in zip(file["sections"], raw["sections"])}
    members = {}
    for (name, entry), line in zip(file["members"].items(), raw["lines"]):
        first = entry["section"] if isinstance(entry["section"], str) else entry["section"][0]
        members[name] = Member(name, (entry["from"], entry["to"]), sections[first], line["start"], line["axes"],
                               line["length"], line["curvature"], entry,
                               tuple(_section(first, own, physics) for own in line.get("sections", ())))
    nodes = {name: _turning(name, entry) for name, entry in file["nodes"].items()}
    return Scene(file["name"], raw["of"], physics, file.get("plane"), nodes, sections, members,
                 tuple(_load(name, entry, members) for name, entry in file.get("loads", {}).items()),
                 file.get("motions", {}), {name: _analysis(name, a) for name, a in file["analyses"].items()},
                 tuple(_quantity(name, q) for name, q in file.get("quantities", {}).items()), raw["meanings"], raw,
                 tuple(Spring(name, entry.get("from"), entry["to"], entry.get("stiffness", ())) for name, entry in file.get("springs", {}).items()))


def _check_springs(scene: Scene) -> None:
    """Raises Refused if a spring depends on large rotations in space, or acts between distant nodes."""
    small = all(a.kind in ("linear", "buckling") or (a.kind == "modal" and not a.about) for a in scene.analyses.values())
    flat = _motion.normal(scene) is not None and (scene.plane or all(a.kind != "modal" or not a.about for a in scene.analyses.values()))
    for spring in scene.springs:
        if len(spring.stiffness) != 6:
            raise Refused(f"stiffness: drivers support only springs with six stiffnesses ({spring.name})")
        if any(spring.stiffness[3:]) and not small and not flat:
            raise Refused(f"springs: drivers do not support rotational springs in large motions in space ({spring.name})")
        if spring.begin is not None and (not small or scene.nodes[spring.begin].at != scene.nodes[spring.end].at):
            raise Refused("springs: drivers support a spring between two nodes only if the nodes coincide and displacements are small "
                          f"({spring.name})")


def _stays_in_plane(scene: Scene) -> bool:
    """Returns True if the structure would stay in its plane even if motions out of the plane were free."""
    others = {"x", "y", "z"} - set(scene.plane or "")
    return (all(a.kind in ("linear", "static", "motion") for a in scene.analyses.values()) and len(others) == 1
            and _motion.normal(scene) == "xyz".index(others.pop()))


def check(scene: Scene, element: Element, program: str) -> None:
    """Raises Refused if the element lacks physics of the scene, or if the driver does not read a key or cannot
    represent an entry of the scene."""
    lacks = sorted(scene.physics - element.offers - {"haringx", "engesser"} - _OF_KINDS)  # the limit shows the theory of shear
    if lacks:
        raise Refused(f"{lacks[0]}: the element of {program} does not model it")
    for name, section in scene.sections.items():
        if "coupled section" not in element.offers and "stiffness" in section.raw and any(
                section.raw["stiffness"][i][k] != 0 for i in range(6) for k in range(6) if i != k):
            raise Refused(f"coupled section: section {name} is not diagonal")
    file = scene.raw["scene"]
    kinds = {a.kind for a in scene.analyses.values()}
    read: dict[str, Mapping[str, Any]] = {"nodes": {node.name: node.raw for node in scene.nodes.values()},
                                          "loads": {load.name: load.raw for load in scene.loads}}
    for part, known in _KNOWN.items():
        if part == "nodes" and "loads.gravity" in element.keys and kinds <= {"linear", "static", "compliance"}:
            known = known | {"mass", "inertia"}  # only their weight acts
        for name, entry in (read.get(part, file.get(part, {})).items() if part else [("scene", file)]):
            for key in entry:
                if key == "plane" and _stays_in_plane(scene):
                    continue
                if key not in known and f"{part}.{key}".lstrip(".") not in element.keys:
                    raise Refused(f"{key}: the driver of {program} does not read this key of {name}")
    for name, node in scene.nodes.items():
        if "fork" in node.raw and (not _forked(node.raw) or any(a.kind not in ("linear", "buckling", "modal") for a in scene.analyses.values())):
            raise Refused(f"fork: drivers support forks only about a global axis and without large rotations ({name})")
    _check_springs(scene)
    check_hinges(scene)
    for load in scene.loads:
        if load.kind == "temperature" and kinds != {"linear"}:
            raise Refused(f"temperature: drivers support temperature loads only in linear analyses ({load.name})")
        if "gradient" in load.raw and not {"rectangle", "constants", "i", "box", "tube"} & set(file["sections"][scene.members[str(load.member)].section.name]):
            raise Refused(f"gradient: drivers support temperature gradients only for sections with known principal axes ({load.name})")
    for name, motion in scene.motions.items():
        start = _motion.function_of(motion)
        if start is not None and start(0.0) != 0 and any(a.kind not in ("motion", "modal") for a in scene.analyses.values()):
            raise Refused(f"motions: {name} is not 0 at the time 0, and there is an analysis without time")
    for member in scene.members.values():
        if not isinstance(member.raw["section"], str) and "taper" not in element.keys:
            raise Refused(f"section: {member.name} is tapered")
    for name, line in zip(scene.members, scene.raw["lines"]):
        if any(abs(angle - line["angles"][0]) > 1e-12 for angle in line.get("angles", ())):
            raise Refused(f"section: the principal axes of {name} rotate along it")
        if "angles" in line and any(load.kind == "temperature" and load.member == name for load in scene.loads):
            raise Refused(f"temperature: drivers do not have it on tapered members ({name})")


def refusal(scene: Scene, element: Element, q: Quantity) -> str:
    """Returns the reason why the quantity cannot be computed; "": it can be computed."""
    if q.analysis not in scene.analyses:
        return f"{q.kind}: no driver computes this quantity"
    analysis = scene.analyses[q.analysis]
    for one in (analysis, *([scene.analyses[analysis.about]] if analysis.about else [])):
        if one.kind not in element.analyses:
            return f"{one.kind}: the driver has no such analysis"
        for key in one.raw:
            if key not in _ANALYSIS.get(one.kind, set()) and f"{one.kind}.{key}" not in element.keys:
                return f"{key}: the driver does not read this key of {one.name}"
    lacks = [] if analysis.kind in _STATICS else sorted(scene.physics & _OF_KINDS - element.offers)
    if lacks:
        return f"{lacks[0]}: the element does not model it"
    if analysis.about is not None and scene.analyses[analysis.about].kind != "static":
        return f"about: drivers support {analysis.kind} analyses only about states of static analyses"
    if q.raw.get("node") in (loose := idle(scene)) and q.raw.get("component") in loose[q.raw["node"]]:
        return f"release: nothing depends on this rotation of {q.raw['node']}"
    if q.kind == "energy" and scene.springs:
        return "energy: drivers do not know that of springs"
    if analysis.kind == "motion":
        return _motion.refusal(q)
    if q.kind not in _QUANTITY or set(q.raw) - _QUANTITY[q.kind] - {"analysis", "take", "at"}:
        return f"{q.kind}: no driver computes this quantity"
    if q.raw.get("take", "last") not in ("last", "curve", "max", "min") or ("take" in q.raw and "factor" not in q.x and
                                                                           q.raw["take"] == "curve"):
        return f"take: no driver computes '{q.raw['take']}'"
    if q.raw.get("kind", "limit") != "limit":
        return f"kind: drivers find limit points, not a {q.raw['kind']}"
    if analysis.about is not None and scene.analyses[analysis.about].kind != "static":
        return f"about: the driver does not support {analysis.kind} analyses about a state of a {scene.analyses[analysis.about].kind} analysis"
    if q.kind in ("compliance", "stiffness") and analysis.raw.get("moments", "spatial") != "spatial":
        return "moments: drivers use the spatial convention only"
    return ""


def _state_values(q: Quantity, answer: Answer) -> list[float]:
    if q.kind in ("displacement", "reaction"):
        c = COMPONENTS.index(q.raw["component"])
        found = [(s.u if q.kind == "displacement" else s.reaction)[q.raw["node"]][c] for s in answer.states]
        if None in found:
            raise Refused(f"{q.raw['component']}: the program does not give this {q.kind}")
        return [v for v in found if v is not None]
    row = COMPONENTS.index(q.raw["row" if q.kind == "compliance" else "component"])
    column = COMPONENTS.index(q.raw["column"]) if q.kind == "compliance" else row
    entries = [s.compliance[row][column] for s in answer.states if s.compliance is not None]
    if None in entries:
        raise Refused(f"{q.kind}: the driver does not compute this component")
    known = [c for c in entries if c is not None]
    return known if q.kind == "compliance" else [1 / c for c in known]


def _of_family(family: str, answer: Answer) -> list[float]:
    if family == "any":
        return list(answer.frequencies)
    if len(answer.families) < len(answer.frequencies):
        raise Refused(f"family: the driver does not find the modes of the family '{family}'")
    return [f for f, own in zip(answer.frequencies, answer.families) if own == family or (family == "not_axial" and own != "axial")]


def _path_value(q: Quantity, analysis: Analysis, answer: Answer) -> float | list[list[float]]:
    """Returns the value of a quantity of a continuation, or for a curve the list of [x, value]."""
    if q.kind == "critical_point":
        limits, which = [p for p in answer.path if p.limit], int(q.raw.get("which", 0))
        if which >= len(limits):
            raise Refused(f"critical_point: the driver found only {len(limits)} limit points")
        found_there = limits[which].values[0] if q.raw.get("value") == "coordinate" else limits[which].factor
        return float(q.factor * found_there + q.offset)
    take = q.raw.get("take", "last")
    points = answer.stops if take == "last" or "at" in q.raw else answer.path
    found = [p.factor for p in points] if q.kind == "factor_at" else _state_values(q, Answer([p.state for p in points]))
    values = [float(q.factor * v + q.offset) for v in found]
    if take == "curve":
        return [[q.x["factor"] * p.values[0] + q.x.get("offset", 0), v] for p, v in zip(points, values)]
    if "at" in q.raw:
        if q.raw["at"] not in analysis.raw["to"]:
            raise Refused("at: the path does not stop at this value")
        return values[list(analysis.raw["to"]).index(q.raw["at"])]
    return max(values) if take == "max" else min(values) if take == "min" else values[-1]


def value_of(scene: Scene, q: Quantity, answer: Answer) -> float | list[list[float]]:
    """Returns the value of a quantity, or for a curve the list of [x, value]."""
    if q.kind in ("critical_factor", "frequency"):
        found = list(answer.factors if q.kind == "critical_factor" else _of_family(q.raw.get("family", "any"), answer))
        which = int(q.raw.get("which", 0))
        if which >= len(found):
            raise Refused(f"{q.kind}: the driver found only {len(found)} values")
        return float(q.factor * found[which] + q.offset)
    analysis = scene.analyses[q.analysis]
    if analysis.kind == "motion":
        return _motion.value_of(scene, q, answer)
    if analysis.kind == "continuation":
        return _path_value(q, analysis, answer)
    stations = analysis.stations or (scene.analyses[analysis.about].stations if analysis.about else (1.0, ))
    values = [float(q.factor * v + q.offset) for v in _state_values(q, answer)]
    take = q.raw.get("take", "last")
    if len(values) != len(stations) and (len(values) != 1 or take != "last" or "at" in q.raw):
        raise Refused(f"{q.kind}: the driver returned {len(values)} of {len(stations)} states")
    if take == "curve":
        return [[q.x["factor"] * p + q.x.get("offset", 0), v] for p, v in zip(stations, values)]
    if "at" in q.raw:
        at = float(q.raw["at"])
        if at not in stations:
            raise Refused("at: there is no station at this value")
        return values[stations.index(at)]
    return max(values) if take == "max" else min(values) if take == "min" else values[-1]
