"""Shapes of a scene in space, from the centre lines in the results file.

Thin walls of sections are drawn as strips along their mid-lines, thick walls as solids. Rigid bodies are the convex
hulls of the points attached to them. Groups of points that are far apart are joined by rods."""
import base64
import dataclasses
import json
import math
import os

import h5py
import numpy as np
from markupsafe import Markup, escape
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from reports.data import text

SYMBOL = 0.03  # largest half side, relative to the size, of a rectangle that represents a section known only by its constants
THIN = 0.2  # ratio of thickness to length up to which a wall is drawn as a surface
VISIBLE = 0.02  # displacement, relative to the size, below which the picture exaggerates displacements
GAP = 0.35  # gap, relative to the extent of a body, beyond which its parts are joined by rods
CLAMPED = 63  # bits of all six components
FRAME = "motion"  # kind of a state that is a frame of a motion, whose value is the time [s]


@dataclasses.dataclass
class Shapes:
    formulation: str
    n: int
    members: np.ndarray  # nodes p and q, and section [members x 3]
    first: np.ndarray  # index of the first point of each member [members + 1]
    body: np.ndarray  # node with which each node moves, or -1 [nodes]
    held: np.ndarray  # bits of the fixed components [nodes]
    released: np.ndarray  # bits of the released components at both ends [members x 2]
    sections: list  # corners (y, z) of the walls of each section [walls x 4 x 2] in m
    far: dict  # {member: section at its far end}, if the section changes along the member
    equivalent: list  # True if the section is known only by its constants and drawn as a rectangle
    kind: list
    acting: list  # loads of a linear solution, such as "combination ULS", or "" for all loads
    value: np.ndarray
    position: np.ndarray  # [states x points x 3] in m
    axes: np.ndarray  # axes of the section in rows [states x points x 3 x 3]
    nodes: np.ndarray  # [states x nodes x 3] in m


def matrices(q):
    w, x, y, z = np.moveaxis(q, -1, 0)
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
            [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
            [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)]]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def frames_in(shapes):
    return int((shapes["kind"][()] == FRAME.encode()).sum())


def read(site, case):
    return read_file(site.results, case.name)


def read_file(path, name, point="default"):
    with h5py.File(path) as file:
        place = f"cases/{name}/shapes/{point}"
        if place not in file:
            return None
        g = file[place]
        sections = [g["sections"][str(i)] for i in range(len(g["sections"]))]
        equivalent = [bool(s.attrs["equivalent"]) for s in sections]
        size = np.linalg.norm(np.ptp(g["position"][0], axis=0))
        scale = [
            min(1, SYMBOL * size / np.abs(s[()]).max()) if symbol else 1
            for s, symbol in zip(sections, equivalent)
        ]
        walls = [s[()] * by if by != 1 else s[()] for s, by in zip(sections, scale)]
        far = {
            int(i): end[()] * scale[g["members"][int(i), 2]]
            for i, end in g.get("far_ends", {}).items()
        }
        return Shapes(
            text(g.attrs["formulation"]), int(g.attrs["elements"]), g["members"][()],
            g["first_point"][()], g["bodies"][:, 0], g["bodies"][:, 1],
            g["released"][()] if "released" in g else np.zeros((len(g["members"]), 2), int), walls,
            far, equivalent, [text(kind) for kind in g["kind"][()]],
            [text(one) for one in g["acting"][()]] if "acting" in g else [""] * len(g["kind"]), g["value"][()],
            g["position"][()],
            matrices(g["orientation"][()]), g["nodes"][()])


def size_of(s):
    return float(np.linalg.norm(np.ptp(s.position[0], axis=0)))


def turns(s, a, b):
    """Returns the rotation vectors [points x 3] from state a to state b."""
    return Rotation.from_matrix(np.swapaxes(s.axes[b], -1, -2) @ s.axes[a]).as_rotvec()


def distance(s, a, b):
    radius = max(np.linalg.norm(walls, axis=2).max() for walls in s.sections)
    return float((np.linalg.norm(s.position[a] - s.position[b], axis=1) +
                  radius * np.linalg.norm(turns(s, a, b), axis=1)).max())


def exaggeration(s, state):
    """Returns 1 if the displacements are visible or zero, otherwise a round factor that makes them visible."""
    moved = distance(s, state, 0)
    if moved == 0 or moved > VISIBLE * size_of(s):
        return 1
    exact = min(0.1 * size_of(s) / moved,
                0.6 / max(np.linalg.norm(turns(s, 0, state), axis=1).max(), 1e-300))
    decade = 10 ** math.floor(math.log10(exact))
    return max(1, decade * (5 if exact >= 5 * decade else 2 if exact >= 2 * decade else 1))


def axes_of(s, state, scale):
    if scale == 1:
        return s.axes[state]
    turned = Rotation.from_rotvec(scale * turns(s, 0, state)).as_matrix()
    return s.axes[0] @ np.swapaxes(turned, -1, -2)


def is_thick(wall):
    return np.linalg.norm(wall[0] - wall[1]) > THIN * np.linalg.norm(wall[1] - wall[2])


def strips(s, state, scale, every):
    """Returns the quadrilaterals of all members [quadrilaterals x 4 x 3]. `every` is the spacing of the points used."""
    out = []
    position = s.position[0] + scale * (s.position[state] - s.position[0])
    axes = axes_of(s, state, scale)
    for i, (_, _, section) in enumerate(s.members):
        at = np.arange(s.first[i], s.first[i + 1])
        at = np.append(at[:-1:every], at[-1])
        r, y, z = position[at], axes[at, 1], axes[at, 2]
        along = ((at - at[0]) / (at[-1] - at[0]))[:, None, None, None]
        walls = s.sections[section]
        here = walls + along * (s.far.get(i, walls) - walls)  # [points x walls x 4 x 2]
        for k, wall in enumerate(walls):
            thick = is_thick(wall)
            corners = here[:, k] if thick else (here[:, k, ::2] + here[:, k, 1::2]) / 2
            edges = [r + c[:, :1] * y + c[:, 1:] * z for c in np.moveaxis(corners, 1, 0)]
            pairs = [(k, (k + 1) % 4) for k in range(4)] if thick else [(0, 1)]
            out += [
                np.stack([edges[a][:-1], edges[b][:-1], edges[b][1:], edges[a][1:]], axis=1)
                for a, b in pairs
            ]
            if thick:
                out += [np.stack([e[end] for e in edges])[None] for end in (0, -1)]
    return np.concatenate(out)


def hull_faces(points):
    """Returns the faces of the convex hull as indices of points: triangles, one polygon for points in a plane, one
    segment for points on a line, or none for a single point."""
    rounded, index = np.unique(np.round(points, 12), axis=0, return_index=True)
    middle = rounded.mean(axis=0)
    _, extent, axes = np.linalg.svd(rounded - middle, full_matrices=False)
    rank = int((extent > 1e-6 * max(extent[0], 1e-300)).sum()) if len(rounded) > 1 else 0
    flat = (rounded - middle) @ axes.T
    if rank == 3:
        faces = ConvexHull(rounded).simplices
    elif rank == 2:
        faces = [ConvexHull(flat[:, :2]).vertices]
    else:
        faces = [[flat[:, 0].argmin(), flat[:, 0].argmax()]] if rank == 1 else []
    return [index[list(face)] for face in faces]


def hull(points):
    return [points[face] for face in hull_faces(points)]


def clusters(points):
    """Returns groups of indices of points that are close together. Gaps below GAP times the extent do not separate
    points."""
    reach = GAP * np.linalg.norm(np.ptp(points, axis=0))
    group = np.arange(len(points))
    for i in range(len(points)):
        for j in range(i):
            if np.linalg.norm(points[i] - points[j]) <= reach:
                group[group == group[i]] = group[j]
    return [np.flatnonzero(group == g) for g in np.unique(group)]


def groups_of_bodies(s):
    """Returns [(nodes of a rigid body, groups of nodes that are close together)]. The main node is included if it is a
    hinge (partly fixed)."""
    out = []
    for b in sorted({int(b) for b in s.body if b >= 0}):
        attached = np.append(np.flatnonzero(s.body == b), [b] * (s.held[b] not in (0, CLAMPED)))
        attached = attached.astype(int)
        out.append((attached, clusters(s.nodes[0][attached])))
    return out


def bodies(s, state, scale):
    """Returns the faces of the rigid bodies, including the rods or faces between the middles of their groups."""
    faces = []
    nodes = s.nodes[0] + scale * (s.nodes[state] - s.nodes[0])
    for attached, groups in groups_of_bodies(s):
        for group in groups:
            faces += hull(nodes[attached][group])
        if len(groups) > 1:
            faces += hull(np.array([nodes[attached][group].mean(axis=0) for group in groups]))
    return faces


# Shapes for the 3-D viewer (assets/viewer.js): one file for each case, loaded when the case is viewed.
#
# Positions and axes of all stored states are 16-bit integers. Positions are relative to the middle of the scene, in
# units of half its size. Axes are quaternions. Invisible displacements are exaggerated, as in the still pictures, and
# the label of the state contains the factor.

WHOLE = 32767
MOST_POINTS = 1300  # largest number of stored points of all members; if there are more, only every n-th is stored
MOST_FRAMED = 16_000  # largest number of points of all frames of a motion together
LEAST = 3  # smallest number of points of a bent member before the number of frames is reduced


def packed(values):
    """Returns numbers from -1 to 1 as 16-bit integers encoded in base64. Numbers beyond this range are clipped."""
    whole = np.round(np.clip(values, -1, 1) * WHOLE).astype("<i2")
    return base64.b64encode(whole.tobytes()).decode()


def frames_of(s):
    """Returns the states that are frames of a motion."""
    return [k for k, kind in enumerate(s.kind) if kind == FRAME]


def drawn_states(s, most=MOST_FRAMED):
    """Returns the states that are stored: all states that are not frames, and as many evenly spaced frames of a motion,
    including both ends, as `most` points allow."""
    frames = frames_of(s)
    count = max(2, most // (LEAST * max(1, len(s.members))))
    if len(frames) > count:
        some = {frames[round(i * (len(frames) - 1) / (count - 1))] for i in range(count)}
        return [k for k, kind in enumerate(s.kind) if kind != FRAME or k in some]
    return list(range(len(s.kind)))


def kept(s, most=MOST_FRAMED):
    """Returns (indices of the stored points, index of the first stored point for each member)."""
    framed = sum(s.kind[k] == FRAME for k in drawn_states(s, most))
    points = max(LEAST * len(s.members), min(MOST_POINTS, most // max(1, framed)))
    every = -(-s.position.shape[1] // points)
    at, first = [], [0]
    for i in range(len(s.members)):
        own = np.arange(s.first[i], s.first[i + 1])
        at += [*own[:-1:min(every, max(1, len(own) // 2))], own[-1]]
        first.append(len(at))
    return np.array(at), first


def ends(wall, other, pick, half):
    """Returns the corners at the near end and, if they differ, at the far end: [y, z, y, z, ...] in units of `half`."""
    return [[round(float(x) / half, 6) for x in pick(w).ravel()] for w in (wall, other)
            if w is not None]


def profile(walls, far, half):
    """Returns the corners of the strips along a member and of the caps of its thick walls. `far` are the walls at the far
    end, or None if the section is constant."""
    strips, caps = [], []
    for k, wall in enumerate(walls):
        other = None if far is None else far[k]
        if is_thick(wall):
            strips += [ends(wall, other, lambda w, a=a: w[[a, (a + 1) % 4]], half) for a in
            range(4)]
            caps.append(ends(wall, other, lambda w: w, half))
        else:
            strips.append(ends(wall, other, lambda w: (w[::2] + w[1::2]) / 2, half))
    return {"strips": strips, "caps": caps}


def drawn_bodies(s):
    """Returns (faces, groups that are joined by rods) as indices of nodes."""
    faces, rods = [], []
    for attached, groups in groups_of_bodies(s):
        for group in groups:
            own = attached[group]
            faces += [own[face].tolist() for face in hull_faces(s.nodes[0][own])]
        if len(groups) > 1:
            rods.append([attached[group].tolist() for group in groups])
    return faces, rods


def exaggerations(s):
    """Returns the scale of every state. All states of a path have the smallest of their scales. Motions are not
    exaggerated."""
    found = [1.0 if kind == FRAME else float(exaggeration(s, k))
             for k, kind in enumerate(s.kind)]
    path = [k for k, kind in enumerate(s.kind) if kind == "path"]
    least = min((found[k] for k in path if distance(s, k, 0) > 0), default=1)
    return [least if k in path else f for k, f in enumerate(found)]


def shape(s, words, supports, hinges, start, view, most=MOST_FRAMED):
    """Returns the data for the viewer. `words` is a function of (s, state, scale) that returns the title of a state.
    `supports` are nodes, `hinges` are points, and `start` is the state shown first. `view` is (azimuth, elevation) in
    degrees. `most` is the largest number of points of all frames of a motion together."""
    at, first = kept(s, most)
    drawn, every = drawn_states(s, most), exaggerations(s)
    scales = [(k, every[k]) for k in drawn]
    position = np.array([s.position[0] + f * (s.position[k] - s.position[0])
                         for k, f in scales])[:, at]
    axes = np.array([axes_of(s, k, f) for k, f in scales])[:, at]
    nodes = np.array([s.nodes[0] + f * (s.nodes[k] - s.nodes[0]) for k, f in scales])
    everything = np.concatenate([position.reshape(-1, 3), nodes.reshape(-1, 3)])
    low, high = everything.min(axis=0), everything.max(axis=0)
    middle, half = (low + high) / 2, float(max(np.max(high - low) / 2, 1e-12))
    turned = Rotation.from_matrix(np.swapaxes(axes, -1, -2).reshape(-1, 3, 3)).as_quat()
    quaternions = turned[:, [3, 0, 1, 2]].reshape(*position.shape[:2], 4)
    profiles, of_member, numbers = [], [], {}
    for i, (_, _, section) in enumerate(s.members):
        name = (int(section), i if i in s.far else None)
        if name not in numbers:
            numbers[name] = len(profiles)
            profiles.append(profile(s.sections[section], s.far.get(i), half))
        of_member.append([first[i], first[i + 1], numbers[name]])
    radius = max(np.linalg.norm(walls, axis=2).max() for walls in s.sections) / half
    reach = (high - low) / 2 / half + radius
    faces, rods = drawn_bodies(s)
    known = {int(p): i for i, p in enumerate(at)}
    times = [float(s.value[k]) if s.kind[k] == FRAME else None for k in drawn]
    return {
        **({"times": times} if any(t is not None for t in times) else {}),
        "count": len(at), "ends": nodes.shape[1], "half": half, "view": view, "start": drawn.index(min(drawn,
        key=lambda k: abs(k - start))),
        "states": [words(s, k, f) for k, f in scales], "members": of_member,
        "profiles": profiles, "bodies": faces, "rods": rods, "held": [int(i) for i in supports],
        "hinges": [known[int(i)] for i in hinges if int(i) in known],
        "corners": [[round(float(sign * x), 5) for sign, x in zip(signs, reach)]
                    for signs in ((1, 1, 1), (-1, 1, 1), (1, -1, 1), (1, 1, -1))],
        "at": packed(np.concatenate([(position - middle) / half, quaternions], axis=-1)),
        "nodes": packed((nodes - middle) / half)
    }


def as_json(found):
    return json.dumps(found, separators=(",", ":"))


def store(site, name, found):
    with open(os.path.join(site.folder, f"shape_{name}.js"), "w", encoding="utf-8") as out:
        out.write(f"beamwork_shape({json.dumps(name)}, {as_json(found)});\n")


def markup(name, still, alt):
    """Returns the element of a viewer, with the still picture that is shown if the model cannot be rotated."""
    return Markup(f'<div class="viewer" data-shape="{escape(name)}" data-alt="{escape(alt)}">'
                  f"{still}</div>")
