"""Shapes for the viewer in space (assets/viewer.js): a file for each case, loaded when it is looked
at.

Positions and axes of all stored states are whole numbers of 16 bits: a position is that part of
half
the scene's size from its middle, axes are quaternions. What is too small to be seen is drawn
larger,
as in the still pictures; the words of the state say how much."""
import base64
import json
import os

import numpy as np
from markupsafe import Markup, escape
from scipy.spatial.transform import Rotation

from reports import shapes
from reports.shapes import FRAME

WHOLE = 32767
MOST_POINTS = 1300  # of all members; of more every second or third is left out
MOST_FRAMED = 16_000  # of all frames of a motion together
LEAST = 3  # points of a member that bends, before frames are left out


def packed(values):
    """Numbers from -1 to 1 as text."""
    whole = np.round(np.clip(values, -1, 1) * WHOLE).astype("<i2")
    return base64.b64encode(whole.tobytes()).decode()


def frames_of(s):
    """States that are frames of a motion."""
    return [k for k, kind in enumerate(s.kind) if kind == FRAME]


def drawn_states(s, most=MOST_FRAMED):
    """States that are stored: all but of a motion so many frames, evenly, that `most` points are
    enough; both its ends are among them."""
    frames = frames_of(s)
    count = max(2, most // (LEAST * max(1, len(s.members))))
    if len(frames) > count:
        some = {frames[round(i * (len(frames) - 1) / (count - 1))] for i in range(count)}
        return [k for k, kind in enumerate(s.kind) if kind != FRAME or k in some]
    return list(range(len(s.kind)))


def kept(s, most=MOST_FRAMED):
    """(points that are kept, first of each member among them)."""
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
    """Corners at the near end, and at the far end where they are others: [y, z, y, z, ...] in parts
    of half."""
    return [[round(float(x) / half, 6) for x in pick(w).ravel()] for w in (wall, other)
            if w is not None]


def profile(walls, far, half):
    """Strips along a member, and caps of thick walls."""
    strips, caps = [], []
    for k, wall in enumerate(walls):
        other = None if far is None else far[k]
        if shapes.is_thick(wall):
            strips += [ends(wall, other, lambda w, a=a: w[[a, (a + 1) % 4]], half) for a in
            range(4)]
            caps.append(ends(wall, other, lambda w: w, half))
        else:
            strips.append(ends(wall, other, lambda w: (w[::2] + w[1::2]) / 2, half))
    return {"strips": strips, "caps": caps}


def bodies(s):
    """(faces, groups that rods join): indices of nodes."""
    faces, rods = [], []
    for attached, groups in shapes.groups_of_bodies(s):
        for group in groups:
            own = attached[group]
            faces += [own[face].tolist() for face in shapes.hull_faces(s.nodes[0][own])]
        if len(groups) > 1:
            rods.append([attached[group].tolist() for group in groups])
    return faces, rods


def exaggerations(s):
    """Of every state; those of a path share one, that of the state that has moved farthest; motions
    have none."""
    found = [1.0 if kind == FRAME else float(shapes.exaggeration(s, k))
             for k, kind in enumerate(s.kind)]
    path = [k for k, kind in enumerate(s.kind) if kind == "path"]
    least = min((found[k] for k in path if shapes.distance(s, k, 0) > 0), default=1)
    return [least if k in path else f for k, f in enumerate(found)]


def shape(s, words, supports, hinges, start, view, most=MOST_FRAMED):
    """What the viewer draws. words: title of a state and its exaggeration; supports: nodes; hinges:
    points; start: state shown first; view: (azimuth, elevation) in degrees; most: points of all
    frames of a motion together."""
    at, first = kept(s, most)
    drawn, every = drawn_states(s, most), exaggerations(s)
    scales = [(k, every[k]) for k in drawn]
    position = np.array([s.position[0] + f * (s.position[k] - s.position[0])
                         for k, f in scales])[:, at]
    axes = np.array([shapes.axes_of(s, k, f) for k, f in scales])[:, at]
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
    faces, rods = bodies(s)
    known = {int(p): i for i, p in enumerate(at)}
    times = [float(s.value[k]) if s.kind[k] == FRAME else None for k in drawn]
    return {
        **({"times": times} if any(t is not None for t in times) else {}),
        "count": len(at), "ends": nodes.shape[1], "half": half, "view": view, "start": drawn.index(min(drawn, key=lambda k: abs(k - start))),
        "states": [words(s, k, f) for k, f in scales], "members": of_member,
        "profiles": profiles, "bodies": faces, "rods": rods, "held": [int(i) for i in supports],
        "hinges": [known[int(i)] for i in hinges if int(i) in known],
        "corners": [[round(float(sign * x), 5) for sign, x in zip(signs, reach)]
                    for signs in ((1, 1, 1), (-1, 1, 1), (1, -1, 1), (1, 1, -1))],
        "at": packed(np.concatenate([(position - middle) / half, quaternions], axis=-1)),
        "nodes": packed((nodes - middle) / half)
    }


def as_json(found):
    """A shape as text."""
    return json.dumps(found, separators=(",", ":"))


def store(site, name, found):
    """Writes the file of a shape."""
    with open(os.path.join(site.folder, f"shape_{name}.js"), "w", encoding="utf-8") as out:
        out.write(f"beamwork_shape({json.dumps(name)}, {as_json(found)});\n")


def markup(name, still, alt):
    """The place of a viewer, with the still picture that stays where nothing can be turned."""
    return Markup(f'<div class="viewer" data-shape="{escape(name)}" data-alt="{escape(alt)}">'
                  f"{still}</div>")
