import math

import numpy as np

from reference.derive.beam import quaternion, rotation
from reference.derive.network import LineLoad, Network
from reference.derive.scene_support import (Applied, FREE, HELD, Release, Support, WORDS,
                                            rotation_vector)
from reference.derive.scene_text import (Refused, beam, constants_of, named, number, numbers, only,
                                         table)

PHYSICS = frozenset(
    ("shear", "trapeze", "wagner_moments", "wagner_torque", "rotary_inertia", "warping"))
SCENE = ("beamwork", "name", "summary", "source", "sections", "nodes", "members", "motions",
         "loads", "analyses", "quantities", "omit", "shear_theory", "meshes")
NODE = ("at", "hold", "drive", "part_of", "rotation", "fork", "mass", "centre", "inertia"
        )  # the inertia is used in scene_states.py
MEMBER = ("from", "to", "section", "y", "warping", "curvature", "divisions", "release")
LOAD = ("force", "moment", "distributed", "distributed_moment", "gravity", "on", "path", "factor",
        "at", "axes", "follower", "to_value")


class Place:
    """A node: its body, the support of this body (None if the body belongs to another node), and its position [m]
    relative to the reference point of the body."""

    def __init__(self, body, support, offset):
        self.body, self.support, self.offset = body, support, np.array(offset)


class Frame:
    """Undeformed axis of a member, which is straight or an arc about the z axis of the section: length, curvature, and
    triads at its start (described and principal axes)."""

    def __init__(self, first, last, y, curvature, where):
        if curvature[0] or curvature[1]:
            raise Refused(
                f"{where}: initial twist or curvature about y is not supported by the deriving program")
        chord, self.curvature = np.array(last) - np.array(first), curvature[2]
        distance = np.linalg.norm(chord)
        half = math.asin(distance * self.curvature /
                         2) if abs(distance * self.curvature) < 2 else None
        if half is None:
            raise Refused(
                f"{where}: an arc of half a turn or more is not supported by the deriving program")
        self.length = 2 * half / self.curvature if self.curvature else distance
        x = chord / distance
        y = np.array(y) - (np.array(y) @ x) * x
        y /= np.linalg.norm(y)
        z = np.cross(x, y)
        self.described = np.column_stack(
            [math.cos(half) * x - math.sin(half) * y,
             math.cos(half) * y + math.sin(half) * x, z])

    def principal(self, angle):
        c, s = math.cos(angle), math.sin(angle)
        return self.described @ np.array([[1, 0, 0], [0, c, -s], [0, s, c]])


def physics_of(scene):
    """Returns the physics that a scene does not omit. The shear theory in stability must be Haringx's."""
    if scene.get("shear_theory", "haringx") == "engesser":
        raise Refused("shear_theory: 'engesser' is not supported by the deriving program")
    omitted = scene.get("omit", [])
    if omitted == "all":
        return frozenset()
    for word in omitted:
        if word not in PHYSICS:
            raise Refused(f"omit: '{word}' is not supported by the deriving program")
    return PHYSICS.difference(omitted)


class SceneNetwork:
    """The network of a scene. `net` is the Network, `places` is {name: Place}, `motion` is {name: function(level,
    numbers)} in SI units, and `unknown` is {motion: its number}."""

    def __init__(self, scene, intervals, nodes, form=lambda beam: beam):
        """Builds the network. `form` is a function that replaces a beam by another beam, as in predicted.py."""
        only(scene, "the scene", SCENE)
        self.scene, self.physics, self.form = scene, physics_of(scene), form
        self.places, self.numbers, self.extra, self.unknown, self.conditions_of = {}, 0, [], {}, []
        self._measure()
        self.net = Network(self.length, self.force, intervals=intervals, nodes=nodes)
        self._motions()
        for name, entry in scene["nodes"].items():
            self._node(name, entry)
        self._load_nodes()
        self._members()
        self.net.numbers = np.zeros(self.numbers)
        for place in self.places.values():
            if place.support is not None:
                place.body.conditions = place.support.conditions()
        self.net.extra = [condition() for condition in self.conditions_of] + self.extra

    def _measure(self):
        self.frames = {}
        for name, entry in self.scene["members"].items():
            only(entry, name, MEMBER)
            ends = [
                numbers(named(self.scene["nodes"], entry[end], "node", name)["at"], name, 3)
                for end in ("from", "to")
            ]
            self.frames[name] = Frame(*ends, numbers(entry["y"], name, 3),
                                      numbers(entry.get("curvature", ["0"] * 3), name, 3), name)
        name = min(self.frames, key=lambda each: self.frames[each].length)
        section, where = self.section_of(self.scene["members"][name])
        s = constants_of(section, where)
        self.length = self.frames[name].length
        self.force = number(section["young"], where) * min(s.Iy, s.Iz) / self.length ** 2

    def section_of(self, member):
        name = member["section"]
        if isinstance(name, list):
            raise Refused(
                "a section that changes along a member is not supported by the deriving program")
        return named(self.scene["sections"], name, "section", "members"), name

    def _new_number(self):
        self.numbers += 1
        return self.numbers - 1

    def _motions(self):
        self.motion = {}
        for name, entry in self.scene.get("motions", {}).items():
            only(entry, name, ("unit", "path", "value", "unknown", "such_that"))
            if "such_that" in entry:
                self._unknown(name, entry["such_that"])
            else:
                known = table(numbers(entry["path"], name), numbers(entry["value"], name))
                self.motion[name] = lambda level, numbers, known=known: known(level)

    def _unknown(self, name, what):
        i = WORDS.index(what["component"])
        if i > 2:
            raise Refused(
                f"{name}: an unknown motion that fixes a turn is not supported by the deriving program")
        k = self.unknown[name] = self._new_number()
        self.motion[name] = lambda level, numbers: numbers[k]

        def condition():
            place = self.places[what["node"]]
            start, arm = place.body.x + place.offset / self.length, place.offset / self.length
            return place.body, lambda level, x, R, force, moment, numbers: [(x + R @ arm - start)[
                i] - self.motion[what["motion"]](level, numbers) / self.length]

        self.conditions_of.append(condition)

    def _moved(self, name, translation, where):
        motion, unit = named(self.motion, name, "motion",
                             where), self.length if translation else 1.0
        return lambda level, numbers: motion(level, numbers) / unit

    def _node(self, name, entry):
        only(entry, name, NODE)
        at = numbers(entry["at"], name, 3)
        if "part_of" in entry:
            only(entry, name, ("at", "part_of", "mass", "centre", "inertia"))
            owner = self.scene["nodes"][entry["part_of"]]
            if entry["part_of"] not in self.places:
                self._node(entry["part_of"], owner)
            place = self.places[entry["part_of"]]
            self.places[name] = Place(
                place.body, None,
                place.offset + np.array(at) - np.array(numbers(owner["at"], name, 3)))
        elif name not in self.places:
            body = self.net.body(at)
            self.places[name] = Place(body, self._support(name, entry, body), (0.0, 0.0, 0.0))

    def _support(self, name, entry, body):
        support = Support(body.x)
        for word in entry.get("hold", []):
            for i in range(6) if word == "all" else (WORDS.index(word), ):
                support.kinds[i] = HELD
        for word, motion in entry.get("drive", {}).items():
            support.kinds[WORDS.index(word)] = self._moved(motion, WORDS.index(word) < 3, name)
        turns = support.kinds[3:]
        if sum(callable(kind) for kind in turns) > 1:
            raise Refused(
                f"{name}: several turns driven as increments depend on their order; give a sequence or a vector"
            )
        if "fork" in entry:
            web, axis = (np.array(numbers(entry["fork"][key], name, 3)) for key in ("web", "axis"))
            n = np.cross(web, axis)
            support.sequence = [(n / np.linalg.norm(n), FREE), (web / np.linalg.norm(web), FREE)]
        rotation_of = entry.get("rotation", {})
        if "vector" in rotation_of:
            support.vector = [self._angle(word, name) for word in rotation_of["vector"]]
        elif "sequence" in rotation_of:
            support.sequence = [(self._axis(one["axis"], name), self._angle(one["angle"], name))
                                for one in rotation_of["sequence"]]
        if support.sequence is not None or support.vector is not None:
            support.kinds[3:] = [HELD] * 3
        for _, kind in support.sequence or ():
            if kind == FREE:
                support.angles.append(self._new_number())
        self.extra += [(body, condition) for condition in support.extra()]
        return support

    def _angle(self, word, where):
        return word if word in (FREE, HELD) else self._moved(word, False, where)

    @staticmethod
    def _axis(word, where):
        axis = np.eye(3)["xyz".index(word)] if isinstance(word, str) else np.array(
            numbers(word, where, 3))
        return axis / np.linalg.norm(axis)

    def factor(self, entry, where):
        if "factor" not in entry:
            return float
        return table(numbers(entry["path"], where), numbers(entry["factor"], where))

    def weight(self, entry, where):
        """Returns the load entry for the weight of a body: a force at its centre of mass."""
        if entry["on"] not in self.scene["nodes"]:
            raise Refused(f"{where}: no node or member '{entry['on']}' in the deriving program")
        body = self.scene["nodes"][entry["on"]]
        mass = number(body.get("mass", "0"), where)
        return {
            **entry, "force": [str(mass * g) for g in numbers(entry["gravity"], where, 3)],
            "at": body.get("centre", ["0"] * 3)
        }

    def _load_nodes(self):
        for name, entry in self.scene.get("loads", {}).items():
            only(entry, name, LOAD)
            if "force" not in entry and "moment" not in entry:
                if entry["on"] in self.scene["members"]:
                    continue
                entry = self.weight(entry, name)
            if entry.get("axes", "fixed") != "fixed":
                raise Refused(
                    f"{name}: loads on a node in the axes of a member are not supported by the deriving program")
            place = named(self.places, entry["on"], "node", name)
            owner = next(
                p for p in self.places.values() if p.body is place.body and p.support is not None)
            force, moment = ([
                v / self.force / unit for v in numbers(entry.get(kind, ["0"] * 3), name, 3)
            ] for kind, unit in (("force", 1), ("moment", self.length)))
            arm = (place.offset +
                   np.array(numbers(entry.get("at", ["0"] * 3), name, 3))) / self.length
            owner.support.loads.append(
                Applied(force, moment, arm,
                        entry.get("follower") in ("true", "yes"), self.factor(entry, name)))

    def _line_loads(self, member, described, principal, s, density):
        for name, entry in self.scene.get("loads", {}).items():
            if entry["on"] != member or "force" in entry or "moment" in entry:
                continue
            axes = described if entry.get("axes") == "member" else np.eye(3)
            follows = entry.get("follower") in ("true", "yes")
            if self.frames[member].curvature and (follows or "at" in entry or
                                                  entry.get("axes") == "member"):
                raise Refused(f"{name}: on a curved member it is not supported by the deriving program")
            kind = next(k for k in ("distributed", "distributed_moment", "gravity") if k in entry)
            turn = principal.T @ axes if follows else axes
            first, last = (turn @ np.array(numbers(entry[key], name, 3)) *
                           (density * s.A if kind == "gravity" else 1.0)
                           for key in (kind, "to_value" if "to_value" in entry else kind))
            none = np.zeros(3)

            def pair(v, kind=kind):
                return (none, v) if kind == "distributed_moment" else (v, none)

            yield LineLoad(
                *pair(first),
                principal.T @ axes @ np.array(numbers(entry.get("at", ["0"] * 3), name, 3)),
                follows, self.factor(entry, name),
                pair(last - first) if "to_value" in entry else None)

    def _members(self):
        self.member = {}
        for name, entry in self.scene["members"].items():
            frame, (section, where) = self.frames[name], self.section_of(entry)
            if frame.curvature and constants_of(section, where).turned:
                raise Refused(
                    f"{name}: a curved member with inclined principal axes is not supported by the deriving program"
                )
            plain, s = beam(section, self.physics, frame.length, frame.curvature, where)
            ends = [named(self.places, entry[end], "node", name) for end in ("from", "to")]
            principal = frame.principal(s.turned)
            loads = list(
                self._line_loads(name, frame.described, principal, s,
                                 number(section.get("density", "0"), where)))
            if plain.EIw > 0 and "warping" not in entry:
                raise Refused(f"{name}: 'warping' is missing; give what 'beamwork scene' writes")
            warping = entry.get("warping", "free")
            warp = tuple(w if isinstance(w, str) else w["shared"]
                         for w in (warping if isinstance(warping, list) else [warping] * 2))
            start = numbers(self.scene["nodes"][entry["from"]]["at"], name, 3)
            bodies = [
                self._end(name, entry, end, place, frame)
                for end, place in zip(("from", "to"), ends)
            ]
            self.member[name] = self.net.member(self.form(plain), *bodies, start,
                                                rotation(quaternion(principal)), warp, loads)

    def _end(self, name, entry, end, place, frame):
        words = entry.get("release", {}).get(end, [])
        if not words:
            return place.body
        if frame.curvature:
            raise Refused(
                f"{name}: a release of a curved member is not supported by the deriving program")
        release = Release(words, frame.described, place.offset / self.length, self._new_number)
        joint = self.net.joint(place.body, self.length * place.body.x + place.offset,
                               release.conditions)
        self.extra += [(joint, condition) for condition in release.extra()]
        return joint

    def displacement(self, name, component):
        place = self.places[name]
        if component > 2:
            return rotation_vector(place.body.R)[component - 3]
        start = np.array(numbers(self.scene["nodes"][name]["at"], name, 3))
        return (self.length * place.body.x + place.body.R @ place.offset - start)[component]


# Members of a scene are cut where loads start, end or act, so that loads act only on whole members and on nodes.

SPREAD = ("distributed", "distributed_moment")
OF_PART = ("where", "from", "to", "lumped")


class Pieces:
    """A straight member that is cut at ascending positions along its length, 0 < position < 1."""

    def __init__(self, scene, name, places):
        self.name, self.entry = name, scene["members"][name]
        self.bounds = [0.0, *places, 1.0]
        ends = [numbers(named(scene["nodes"], self.entry[end], "node", name)["at"], name, 3)
                for end in ("from", "to")]
        curvature = numbers(self.entry.get("curvature", ["0"] * 3), name, 3)
        if places and any(curvature):
            raise Refused(f"{name}: a load on a part of a curved member is not supported by the deriving program")
        self.ends = np.array(ends)
        self.axes = None if any(curvature) else Frame(*ends, numbers(self.entry["y"], name, 3), curvature, name).described

    def node(self, place):
        if place in (0.0, 1.0):
            return self.entry["from" if place == 0.0 else "to"]
        return f"{self.name} at {place!r}"

    def piece(self, i):
        return self.name if i == 0 else f"{self.name} from {self.bounds[i]!r}"

    def nodes(self):
        for place in self.bounds[1:-1]:
            at = (1 - place) * self.ends[0] + place * self.ends[1]
            yield self.node(place), {"at": [repr(float(x)) for x in at]}

    def members(self):
        last = len(self.bounds) - 2
        warping = self.entry.get("warping")
        ends = warping if isinstance(warping, list) else [warping] * 2
        release = self.entry.get("release", {})
        for i in range(last + 1):
            one = {**self.entry, "from": self.node(self.bounds[i]), "to": self.node(self.bounds[i + 1])}
            if warping is not None:
                one["warping"] = [ends[0] if i == 0 else {"shared": self.node(self.bounds[i])},
                                  ends[1] if i == last else {"shared": self.node(self.bounds[i + 1])}]
            one["release"] = {end: release[end] for end, there in (("from", i == 0), ("to", i == last))
                              if there and end in release}
            yield self.piece(i), one

    def at_place(self, name, entry):
        place = number(entry["where"], name)
        end = {0.0: "from", 1.0: "to"}.get(place)
        if end in self.entry.get("release", {}):
            raise Refused(f"{name}: at a released end it is not supported by the deriving program")
        out = {key: value for key, value in entry.items() if key not in (*OF_PART, "axes")}
        if entry.get("axes") == "member":
            if self.axes is None:
                raise Refused(f"{name}: on a curved member it is not supported by the deriving program")
            for key in ("force", "moment", "at"):
                if key in entry:
                    out[key] = [repr(float(x)) for x in self.axes @ numbers(entry[key], name, 3)]
        yield name, {**out, "on": self.node(place)}

    def spread(self, name, entry):
        kind = next((k for k in SPREAD if k in entry), None)
        begin, end = (number(entry.get(key, usual), name) for key, usual in (("from", "0"), ("to", "1")))
        out = {key: value for key, value in entry.items() if key not in OF_PART}
        for i, bounds in enumerate(zip(self.bounds, self.bounds[1:])):
            if bounds[0] < begin or bounds[1] > end:
                continue
            one = {**out, "on": self.piece(i)}
            if "to_value" in entry:
                first, last = (np.array(numbers(entry[key], name, 3)) for key in (kind, "to_value"))
                for key, place in zip((kind, "to_value"), bounds):
                    share = (place - begin) / (end - begin)
                    one[key] = [repr(float(x)) for x in (1 - share) * first + share * last]
            yield name if i == 0 else f"{name} from {bounds[0]!r}", one


def places_of(scene):
    """Returns {member: positions within it at which a load starts, ends or acts}."""
    out = {name: set() for name in scene["members"]}
    for name, entry in scene.get("loads", {}).items():
        found = [number(entry[key], name) for key in ("where", "from", "to") if key in entry]
        if found:
            named(out, entry["on"], "member", name).update(p for p in found if 0 < p < 1)
    return {name: sorted(places) for name, places in out.items()}


def asked(name, entry, pieces):
    """Returns the name and the entry of a quantity. If it is a resultant at the end of a cut member, it is transferred to
    the end of the last piece."""
    what = entry.get("internal")
    if what is None or what["member"] not in pieces or what.get("end", what.get("where")) not in ("to", "1"):
        return name, entry
    own = pieces[what["member"]]
    return name, {**entry, "internal": {**what, "member": own.piece(len(own.bounds) - 2)}}


def whole(piece, members):
    """Returns the pieces of a cut scene that belonged to the same member as this piece."""
    name = piece.partition(" from ")[0]
    return [one for one in members if one.partition(" from ")[0] == name]


def cut(scene):
    """Returns an equivalent scene whose loads act on whole members, or the scene itself if all loads already act on
    whole members."""
    loads = scene.get("loads", {})
    if not any(key in entry for entry in loads.values() for key in OF_PART):
        return scene
    pieces = {name: Pieces(scene, name, places) for name, places in places_of(scene).items()}
    out = {**scene, "nodes": dict(scene["nodes"]), "members": {}, "loads": {}}
    for own in pieces.values():
        out["nodes"].update(own.nodes())
        out["members"].update(own.members())
    for name, entry in loads.items():
        if "where" in entry:
            out["loads"].update(pieces[entry["on"]].at_place(name, entry))
        elif entry["on"] in pieces and "force" not in entry and "moment" not in entry:
            out["loads"].update(pieces[entry["on"]].spread(name, entry))
        else:
            out["loads"][name] = entry
    if "quantities" in scene:
        out["quantities"] = dict(asked(name, entry, pieces) for name, entry in scene["quantities"].items())
    return out
