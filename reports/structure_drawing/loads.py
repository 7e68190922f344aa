"""Draws arrows of loads, of prescribed motions and of rotating axes."""
from dataclasses import replace

import numpy as np

from reports.structure_drawing.canvas import LOAD, MOTION, number, vector
from reports.structure_drawing.scene import COMPONENTS

ARROW, SHORT, RADIUS = 38, 20, 15  # [pt]
ALONG = 9  # number of arrows of a load along a member
MOST_MOTIONS = 4  # largest number of motions that are drawn with their ranges
UNITS = {"force": "N", "moment": "N m", "distributed": "N/m", "distributed_moment": "N m/m",
         "gravity": "m/s²"}


def unit(v):
    return v / max(np.linalg.norm(v), 1e-300)


def arc(view, at, axis, radius=RADIUS, begin=-0.35, turn=1.5):
    """Returns a right-handed arc around an axis through a point, on paper [n x 2], where `begin` and `turn` are the
    start and the angle of the arc in units of pi."""
    axis = unit(axis)
    side = view.right - axis * (axis @ view.right)
    side = unit(side if np.linalg.norm(side) > 0.2 else view.up - axis * (axis @ view.up))
    other = np.cross(axis, side)
    angle = np.pi * np.linspace(begin, begin + turn, 30)[:, None]
    return view(at + radius / view.scale * (np.cos(angle) * side + np.sin(angle) * other))


def straight(view, at, way, ways, size=ARROW):
    """Returns an arrow on paper [2 x 2] that points away from the point, or towards it if a member is on that side."""
    flat = view(unit(way)) / view.scale
    size = size * max(np.linalg.norm(flat), 0.45)
    flat = unit(flat)
    blocked = any(unit(way) @ w > 0.8 for w in ways)
    start = view(at)
    return start + size * np.outer([-1, 0] if blocked else [0, 1], flat)


def size(load):
    unit_of = UNITS[load.kind]
    if not load.varies():
        return vector(load.vector, unit_of)
    first, last = (f"({', '.join(map(number, v))})" for v in (load.vector, load.last))
    return f"{first} to {last} {unit_of}"


def words_of(load):
    return ("gravity " if load.kind == "gravity" else "") + size(load)


def put_force(canvas, view, load, at, ways):
    line = straight(view, at, load.vector, ways)
    canvas.arrow(line, LOAD, mark=load.name)
    words = words_of(load) + (", follows" if load.follower else "")
    tail = line[0] if np.allclose(line[1], view(at)) else line[1]
    canvas.label(tail, words, LOAD, towards=unit(tail - view(at)))


def put_moment(canvas, view, load, at):
    line = arc(view, at, load.vector)
    canvas.arrow(line, LOAD, mark=load.name)
    if np.ptp(line, axis=0).min() < 0.3 * RADIUS:  # an arc seen edge-on, for which the axis is clearer
        shaft = straight(view, at, load.vector, [], ARROW + 8)
        canvas.arrow(shaft, LOAD, 1.0, head=6)
        canvas.arrow(shaft[0] + 0.86 * (shaft - shaft[0]), LOAD, 1.0, head=6)
    canvas.label(line[len(line) // 2], vector(load.vector, UNITS["moment"]), LOAD)


def beside_member(flat, way, gravity):
    """Returns the shift on paper [pt] of arrows that would lie on the member or, for gravity, on other loads."""
    along = unit(flat[-1] - flat[0])
    if abs(along @ way) > 0.9:
        return SHORT * np.array([-1.0, 0]) if abs(along[1]) > 0.5 else SHORT * np.array([0, -1.0])
    return 2 * SHORT * way if gravity else 0 * way


def in_fixed(load, line, v):
    return line.axes[0].T @ v if load.member_axes else v


def point_on(line, places):
    share = np.linspace(0, 1, len(line.points))
    return np.array([np.interp(places, share, line.points[:, i]) for i in range(3)]).T


def put_within(canvas, view, load, line):
    at = point_on(line, load.within[:1])[0]
    fixed = replace(load, vector=in_fixed(load, line, load.vector))
    if load.kind == "moment":
        put_moment(canvas, view, fixed, at)
    else:
        put_force(canvas, view, fixed, at + in_fixed(load, line, load.at), [])


def put_along(canvas, view, load, line, told):
    """Draws a load along a member. `told` contains labels that have already been drawn."""
    parts = np.linspace(0.03, 0.97, ALONG)[:, None]
    begin, end = load.within or (0, 1)
    ways = (1 - parts) * in_fixed(load, line, load.vector) + parts * in_fixed(load, line, load.last)
    shares = np.linalg.norm(ways, axis=1)
    way = ways[np.argmax(shares)]
    shares = shares / max(shares.max(), 1e-300)
    at = point_on(line, begin + (end - begin) * parts[:, 0]) + in_fixed(load, line, load.at)
    flat = view(unit(way)) / view.scale
    gravity = load.kind == "gravity"
    if load.kind == "distributed_moment":
        for i, (point, one) in enumerate(zip(at[::2], ways[::2])):
            mark = load.name if i == 0 else None
            canvas.arrow(arc(view, point, one if one.any() else way, 7), LOAD, 0.9, mark, head=4)
    else:
        reach = SHORT * max(np.linalg.norm(flat), 0.3) * (0.7 if gravity else 1)
        flats = np.array([unit(view(unit(one if one.any() else way))) for one in ways])
        tails = view(at) - reach * np.maximum(shares, 0.1)[:, None] * flats
        lift = beside_member(view(line.points), unit(flat), gravity)
        for i, (tail, tip) in enumerate(zip(tails, view(at))):
            mark = load.name if i == 0 else None
            canvas.arrow([tail + lift, tip + lift], LOAD, 0.9, mark, head=4)
        if not lift.any():
            canvas.line(tails, LOAD, 0.7)
    words = words_of(load)
    if words in told:
        return
    told.add(words)
    moments = load.kind == "distributed_moment"
    where = view(at[ALONG // 2]) if moments else (tails + lift)[ALONG // 2]
    canvas.label(where, words, LOAD, towards=unit(flat) * (1 if gravity else -1))


def put_loads(canvas, view, scene, lines, into):
    told = set()
    for load in scene.loads:
        if load.kind in ("force", "moment") and load.within is not None:
            put_within(canvas, view, load, lines[load.on])
        elif load.kind in ("force", "moment"):
            node = scene.nodes[load.on].position
            if load.kind == "moment":
                put_moment(canvas, view, load, node)
            else:
                put_force(canvas, view, load, node + load.at, into(load.on))
        elif load.on in lines:
            put_along(canvas, view, load, lines[load.on], told)
        else:
            node = scene.nodes[load.on]
            put_force(canvas, view, load, node.position + node.centre, into(load.on))


def motions_of(scene, node):
    """Returns [(direction, True for a rotation, name of the motion)] of the components that are prescribed by a motion
    that is not always zero."""
    out = [(np.eye(3)[COMPONENTS.index(c) % 3], c[0] == "r", motion)
           for c, motion in node.driven.items()]
    out += [(t.axis, True, t.angle) for t in node.turns if t.angle in scene.motions]
    out += [(np.eye(3)[i], True, motion) for i, motion in enumerate(node.vector)]
    return [m for m in out if scene.motions.get(m[2], (0, 1)) != (0, 0)]


def motion_words(scene, motion, turn):
    reach = scene.motions[motion]
    if reach is None:
        return f"{motion}, unknown"
    if not reach:
        return f"{motion}, in time"
    if turn:
        return f"{motion}: {number(reach[0])} to {number(reach[1])} rad"
    small = max(map(abs, reach)) < 0.5
    low, high = (1e3 * v if small else v for v in reach)
    return f"{motion}: {number(low)} to {number(high)} {'mm' if small else 'm'}"


def put_motions(canvas, view, scene, into):
    all_of = [(n, m) for n in scene.nodes.values() for m in motions_of(scene, n)]
    for i, (node, (way, turn, motion)) in enumerate(all_of):
        mark, at = f"motion_{node.name}_{i}", node.position
        reach = scene.motions.get(motion)
        sign = -1 if reach and abs(reach[0]) > abs(reach[1]) else 1
        if turn:
            line = arc(view, at, sign * way, RADIUS + 5)
            canvas.arrow(line, MOTION, 1.3, mark)
            place = line[len(line) // 3]
        else:
            line = straight(view, at, sign * way, into(node.name), 1.15 * ARROW)
            canvas.arrow(line, MOTION, 1.3, mark)
            place = line[1] if np.allclose(line[0], view(at)) else line[0]
        if len(all_of) <= MOST_MOTIONS:
            canvas.label(place, motion_words(scene, motion, turn), MOTION)


def put_spin(canvas, view, scene, size):
    if scene.spin is None:
        return
    omega, at = scene.spin.omega, scene.spin.centre
    speed = np.linalg.norm(omega)
    reach = np.outer([-1, 1], unit(omega)) * min(0.35 * size, 45 / view.scale)
    canvas.line(view(at + reach), MOTION, 0.9, (0, (6, 2, 1, 2)))
    top = at + 0.8 * reach[1]
    line = arc(view, top, omega, 12)
    canvas.arrow(line, MOTION, 1.3, "spin")
    if np.ptp(line, axis=0).min() < 4:
        canvas.arrow(view(at + reach), MOTION, 0.9, head=6)
    words = f"turns, {number(speed)} rad/s" if speed else "turns"
    canvas.label(line[0], words, MOTION)
