"""Reads a scene file in the form that `beamwork scene CASE` writes into plain records. Lengths are in m, forces in N."""
from dataclasses import dataclass, field

import numpy as np
import yaml

COMPONENTS = ("ux", "uy", "uz", "rx", "ry", "rz")
Loader = getattr(yaml, "CBaseLoader", yaml.BaseLoader)  # scalars are text until they are converted


@dataclass
class Turn:
    """A rotation about an axis. `angle` is "free", "held" or the name of the motion that prescribes it."""
    axis: np.ndarray
    angle: str


@dataclass
class Node:
    """A node of the scene. `position` is in [m], `held` are the components that do not move, and `driven` is {component:
    motion}."""
    name: str
    position: np.ndarray
    part_of: str = ""
    held: tuple = ()
    driven: dict = field(default_factory=dict)
    turns: list = field(default_factory=list)  # successive rotations, each with its axis
    vector: tuple = ()  # motions of a rotation vector
    fork: np.ndarray = None  # axis and web of a fork [2 x 3]
    mass: float = 0
    centre: np.ndarray = None  # centre of mass relative to the node [m]


@dataclass
class Member:
    """A member. `y` is the direction of the y axis of its section. `released` contains the names of the released
    components for each end. `warping` contains "fixed", "free", "shared" or "" for each end."""
    name: str
    ends: tuple  # names of two nodes
    sections: tuple  # names of the sections at both ends
    y: np.ndarray
    curvature: np.ndarray
    released: tuple
    warping: tuple = ("", "")
    offset: np.ndarray = field(default_factory=lambda: np.zeros((2, 3)))  # from the nodes to the ends of the member [m]


@dataclass
class Load:
    """A load. `kind` is force, moment, distributed, distributed_moment or gravity. `on` is a node or a member.
    `within` contains the start and the end of the load as fractions of the member length, which are equal for a force
    or a moment. It is None at a node and for gravity. `last` is the vector at the end of this range."""
    name: str
    kind: str
    vector: np.ndarray
    on: str
    at: np.ndarray  # point of application of a force relative to the node or the centroid [m]
    member_axes: bool
    follower: bool
    grows: bool  # True if the load increases with the path parameter
    within: tuple = None
    last: np.ndarray = None
    lumped: bool = False

    def varies(self):
        return bool(np.any(self.vector != self.last))


@dataclass
class Spring:
    """Spring between two nodes. ends[0] is empty if the spring is connected to the ground."""
    name: str
    ends: tuple
    stiffness: np.ndarray  # diagonal [6]
    damping: np.ndarray  # diagonal [6]
    tables: tuple  # True for each component that a table defines

    @property
    def acts(self):
        """Returns a mask [6] of the components with a stiffness, a damping or a table."""
        return (self.stiffness != 0) | (self.damping != 0) | np.array(self.tables)


@dataclass
class Constraint:
    """A condition between components of nodes. `kind` is "diaphragm" (rigid in the plane normal to `normal`; the first of
    `nodes` is its master), "equal", or "ratio" (component of the first node = `ratio` x component of the second)."""
    name: str
    kind: str
    nodes: tuple
    components: tuple = ()
    ratio: str = ""
    normal: str = ""


@dataclass
class Spin:
    """Rotating axes. `omega` is the angular velocity [rad/s] at the end of the path, and `centre` is a point of the axis
    [m]."""
    omega: np.ndarray
    centre: np.ndarray


@dataclass
class Scene:
    name: str
    sections: dict  # name -> entry of the section in the file
    nodes: dict
    members: dict
    loads: list
    springs: list
    constraints: list
    motions: dict  # name -> (smallest, largest value), () for a function of time, or None if unknown
    spin: Spin = None
    asked: set = field(default_factory=set)  # nodes at which quantities are defined
    omitted: tuple = ()  # omitted physics


def numbers(values):
    return np.array([float(v) for v in values]) + 0.0


def words_of(said):
    return said if isinstance(said, (list, tuple)) else [said]


def read_node(name, said):
    rotation = said.get("rotation", {})
    fork = said.get("fork")
    return Node(name,
                numbers(said["at"]),
                said.get("part_of", ""),
                tuple(said.get("hold", ())),
                dict(said.get("drive", {})),
                [Turn(numbers(t["axis"]), t["angle"]) for t in rotation.get("sequence", ())],
                tuple(rotation.get("vector", ())),
                np.array([numbers(fork["axis"]), numbers(fork["web"])]) if fork else None,
                float(said.get("mass", 0)),
                numbers(said.get("centre", (0, 0, 0))))


def read_member(name, said):
    section = said["section"]
    both = tuple(section) if isinstance(section, list) else (section, section)
    release = said.get("release", {})
    warping = said.get("warping", "")
    warping = warping if isinstance(warping, list) else [warping] * 2
    return Member(name, (said["from"], said["to"]), both, numbers(said["y"]),
                  numbers(said.get("curvature", (0, 0, 0))),
                  (tuple(release.get("from", ())), tuple(release.get("to", ()))),
                  tuple("shared" if isinstance(word, dict) else word for word in warping),
                  np.array([numbers(said.get("offset", {}).get(end, (0, 0, 0))) for end in ("from", "to")]))


def read_constraint(name, said):
    if "diaphragm" in said:
        return Constraint(name, "diaphragm", (said["master"], *said["diaphragm"]), normal=said["normal"])
    if "equal" in said:
        return Constraint(name, "equal", tuple(said["equal"]), tuple(said["components"]))
    return Constraint(name, "ratio", (said["node"], said["of"]), (said["component"],), said["ratio"])


IN_TIME = ("time", "pieces", "table")  # keys that make a motion a function of time
KINDS = ("force", "moment", "distributed", "distributed_moment", "gravity")


def read_load(name, said):
    """Returns the Load, or None for a temperature, which has no arrow."""
    kind = next((k for k in KINDS if k in said), None)
    if kind is None:
        return None
    factors = numbers(said.get("factor", (0, 1)))
    vector = numbers(said[kind]) * factors[-1]
    last = numbers(said["to_value"]) * factors[-1] if "to_value" in said else vector
    within = None
    if "where" in said:
        within = (float(said["where"]),) * 2
    elif kind.startswith("distributed"):
        within = float(said.get("from", 0)), float(said.get("to", 1))
    return Load(name, kind, vector, said["on"], numbers(said.get("at", (0, 0, 0))),
                said.get("axes") == "member", said.get("follower") == "true",
                bool(np.ptp(factors)) if "path" in said else True, within, last,
                said.get("lumped") == "yes")


def read_spring(name, said):
    def diagonal(key):
        values = numbers(said.get(key, [0] * 6))
        return values if len(values) == 6 else values.reshape(6, 6).diagonal()

    tables = tuple(c in said.get("tables", {}) for c in ("ux", "uy", "uz", "rx", "ry", "rz"))
    return Spring(name, (said.get("from", ""), said["to"]), diagonal("stiffness"),
                  diagonal("damping"), tables)


def read_motion(said):
    if "value" not in said:
        return () if any(word in said for word in IN_TIME) else None
    values = numbers(said["value"])
    return values.min(), values.max()


def read_spin(analyses):
    for said in analyses.values():
        kind, what = next(iter(said.items()))
        turning = what if kind == "rotation" else what.get("spin")
        if turning:
            last = float(what["stations"][-1]) if kind == "rotation" else 1
            return Spin(numbers(turning["omega"]) * last, numbers(turning["centre"]))
    return None


def nodes_asked(said):
    own = {name: next(iter(what.values())) for name, what in said["analyses"].items()}
    out = set()
    for quantity in (said.get("quantities") or {}).values():
        what = next(iter(quantity.values()))
        out.add(what.get("node") or own[what["analysis"]].get("node", ""))
    return out - {""}


def read(text):
    """Reads the scene from the text of a file. Returns None if the text is empty."""
    if not text:
        return None
    said = yaml.load(text, Loader)

    def all_of(key, reader):
        return {name: reader(name, what) for name, what in (said.get(key) or {}).items()}

    return Scene(said["name"], said["sections"], all_of("nodes", read_node),
                 all_of("members", read_member), [load for load in all_of("loads", read_load).values() if load],
                 list(all_of("springs", read_spring).values()), list(all_of("constraints", read_constraint).values()),
                 all_of("motions", lambda _, what: read_motion(what)), read_spin(said["analyses"]),
                 nodes_asked(said), tuple(words_of(said.get("omit", ()))))
