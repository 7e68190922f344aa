"""Members of a scene cut where loads begin, end or act: then loads are along whole members, and on nodes."""
import numpy as np

from reference.derive.scene_network import Frame
from reference.derive.scene_text import Refused, named, number, numbers

SPREAD = ("distributed", "distributed_moment")
OF_PART = ("where", "from", "to", "lumped")


class Pieces:
    """A straight member cut at places of its length, 0 < place < 1, ascending."""

    def __init__(self, scene, name, places):
        self.name, self.entry = name, scene["members"][name]
        self.bounds = [0.0, *places, 1.0]
        ends = [numbers(named(scene["nodes"], self.entry[end], "node", name)["at"], name, 3)
                for end in ("from", "to")]
        curvature = numbers(self.entry.get("curvature", ["0"] * 3), name, 3)
        if places and any(curvature):
            raise Refused(f"{name}: a load on a part of a curved member is not within the deriving program")
        self.ends = np.array(ends)
        self.axes = None if any(curvature) else Frame(*ends, numbers(self.entry["y"], name, 3), curvature, name).described

    def node(self, place):
        """Name of the node at a bound."""
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
        """A force or a moment within the member: on a node, in fixed axes."""
        place = number(entry["where"], name)
        end = {0.0: "from", 1.0: "to"}.get(place)
        if end in self.entry.get("release", {}):
            raise Refused(f"{name}: at a released end it is not within the deriving program")
        out = {key: value for key, value in entry.items() if key not in (*OF_PART, "axes")}
        if entry.get("axes") == "member":
            if self.axes is None:
                raise Refused(f"{name}: on a curved member it is not within the deriving program")
            for key in ("force", "moment", "at"):
                if key in entry:
                    out[key] = [repr(float(x)) for x in self.axes @ numbers(entry[key], name, 3)]
        yield name, {**out, "on": self.node(place)}

    def spread(self, name, entry):
        """A load along the member: on each piece what is there of it."""
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
    """{member: places within it at which a load begins, ends or acts}."""
    out = {name: set() for name in scene["members"]}
    for name, entry in scene.get("loads", {}).items():
        found = [number(entry[key], name) for key in ("where", "from", "to") if key in entry]
        if found:
            named(out, entry["on"], "member", name).update(p for p in found if 0 < p < 1)
    return {name: sorted(places) for name, places in out.items()}


def asked(name, entry, pieces):
    """A quantity of an end of a member is that of the last piece's."""
    what = entry.get("internal")
    if what is None or what["member"] not in pieces or what.get("end", what.get("where")) not in ("to", "1"):
        return name, entry
    own = pieces[what["member"]]
    return name, {**entry, "internal": {**what, "member": own.piece(len(own.bounds) - 2)}}


def whole(piece, members):
    """Of the members of a scene that was cut those that were one with this."""
    name = piece.partition(" from ")[0]
    return [one for one in members if one.partition(" from ")[0] == name]


def cut(scene):
    """The same scene, with whole loads; itself where they are whole."""
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
