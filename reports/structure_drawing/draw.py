import itertools

import numpy as np

from reports.structure_drawing import geometry, joints, loads, members
from reports.structure_drawing.canvas import Canvas, INK, SOFT, STEEL, length

CLEAR = 13  # distance between a dimension line and the drawing [pt]
SMALL = 0.02  # dimensions below this fraction of the largest are not drawn


def edges(low, high, axis):
    others = [i for i in range(3) if i != axis]
    out = []
    for corner in itertools.product((0, 1), repeat=2):
        a, b = low.copy(), high.copy()
        for i, which in zip(others, corner):
            a[i] = b[i] = (low, high)[which][i]
        out.append(np.array([a, b]))
    return out


def put_size(canvas, view, low, high, axis):
    along = view(np.eye(3)[axis]) / view.scale
    if np.linalg.norm(along) < 0.2:
        return
    along = along / np.linalg.norm(along)
    out = np.array([along[1], -along[0]])
    if abs(along[0]) > abs(along[1]):
        out = out if out[1] < 0 else -out
    else:
        out = out if out[0] > 0 else -out
    edge = max((view(e) for e in edges(low, high, axis)), key=lambda e: e.mean(axis=0) @ out)
    a, b = sorted(edge, key=lambda p: p @ along)
    drawn = np.vstack(canvas.points + [np.array(c).reshape(2, 2) for c in canvas.boxes])
    near = drawn[((drawn - a) @ along > -20) & ((drawn - b) @ along < 20)]
    reach = (near @ out).max(initial=a @ out) + CLEAR
    ends = [p + (reach - p @ out) * out for p in (a, b)]
    for p, q in zip((a, b), ends):
        canvas.line([p + 4 * out, q + 3 * out], SOFT, 0.4, clear=False)
        canvas.line([q - 3 * (along + out), q + 3 * (along + out)], SOFT, 1)
    canvas.line(ends, SOFT, 0.7)
    turn = np.degrees(np.arctan2(along[1], along[0]))
    turn = turn - 180 if turn > 91 else turn + 180 if turn < -89 else turn
    words, middle = length((high - low)[axis]), np.mean(ends, axis=0)
    if np.linalg.norm(b - a) > 6.5 * len(words):
        canvas.text(middle, words, INK, rotation=turn)
    else:
        canvas.text(middle + (8 + 3 * len(words) * abs(out[0])) * out, words, INK)


def put_sizes(canvas, view, points):
    low, high = points.min(axis=0), points.max(axis=0)
    for axis in range(3):
        if (high - low)[axis] > SMALL * (high - low).max():
            put_size(canvas, view, low, high, axis)


def put_axes(canvas, view):
    """An axis that points at the reader is drawn as a dot."""
    low, _ = canvas.extent()
    at = low + [-16, -12]
    for axis, name in enumerate("xyz"):
        way = view(np.eye(3)[axis]) / view.scale
        if np.linalg.norm(way) < 0.15:
            canvas.dot(at, 4, INK)
            canvas.text(at + [-8, -8], name, INK, 8)
            continue
        canvas.arrow([at, at + 26 * way], INK, 0.9, f"axis_{name}", head=5)
        canvas.text(at + 26 * way + 7 * way / np.linalg.norm(way), name, INK, 8)


# Sections next to a drawing, at a separate scale, with their dimensions.

SIZE, THINNEST = 84, 1.6  # largest size and smallest thickness on paper [pt]
GAP = 46  # gap between two sections [pt]
MOST = 3


def thick(polygon, scale):
    """Returns the polygon of a section on paper, with thin walls widened so that they are visible."""
    flat = polygon * scale
    sides = np.linalg.norm(np.roll(flat, -1, axis=0) - flat, axis=1)
    if len(flat) != 4 or min(sides[:2]) >= THINNEST:
        return flat
    k = int(np.argmin(sides[:2]))
    way = (flat[(k + 1) % 4] - flat[k]) / sides[k]
    out = flat.copy()
    grow = 0.5 * (THINNEST - sides[k]) * way
    for i, sign in ((k, -1), (k + 1, 1), (k + 2, 1), (k + 3, -1)):
        out[i % 4] += sign * grow
    return out


def put_dimension(canvas, a, b, text, rotation=0):
    way = (b - a) / np.linalg.norm(b - a)
    across = np.array([-way[1], way[0]])
    canvas.line([a, b], SOFT, 0.7)
    for p in (a, b):
        canvas.line([p - 3 * across, p + 3 * across], SOFT, 0.7)
    middle = (a + b) / 2
    canvas.text(middle + (-8 if rotation == 0 else 9) * np.array(
        [0, 1.0] if rotation == 0 else [1.0, 0]), text, INK, 8, rotation)


def thickness_words(section):
    if "walls" in section:
        found = sorted({float(w["thickness"]) for w in section["walls"]})
        return "walls " + ", ".join(map(length, found[:4]))
    tube = section.get("tube", {})
    if "thickness" in tube and 2 * float(tube["thickness"]) < 0.999 * float(tube["diameter"]):
        return "wall " + length(float(tube["thickness"]))
    return ""


def put_section(canvas, name, section, left):
    """Draws a section and its dimensions from the position `left` on. Returns the position of their right edge [pt]."""
    polygons = geometry.outline(section)
    both = np.vstack(polygons)[:, ::-1]  # z is horizontal, y vertical
    low, high = both.min(axis=0), both.max(axis=0)
    scale = SIZE / max(high - low)
    shift = np.array([left, 0]) - low * scale
    for polygon in polygons:
        canvas.area(thick(polygon[:, ::-1], scale) + shift, STEEL, INK, 0.8, mark=name)
    if "tube" in section and thickness_words(section):
        tube = section["tube"]
        inner = float(tube["diameter"]) / 2 - float(tube["thickness"])
        canvas.area(geometry.circle(inner) * scale + shift, "white", INK, 0.8)
    sizes, at = high - low, shift
    canvas.arrow([at, at + [max(16, high[0] * scale + 10), 0]], INK, 0.7, head=4)
    canvas.arrow([at, at + [0, max(16, high[1] * scale + 10)]], INK, 0.7, head=4)
    canvas.text(at + [max(16, high[0] * scale + 10) + 5, 0], "z", INK, 8)
    canvas.text(at + [0, max(16, high[1] * scale + 10) + 6], "y", INK, 8)
    a, b = low * scale + shift, high * scale + shift
    bottom = np.array([0, min(a[1], at[1]) - 10])
    put_dimension(canvas, np.array([a[0], 0]) + bottom, np.array([b[0], 0]) + bottom,
                  length(sizes[0]))
    if sizes[1] > 1e-9 * sizes[0]:
        x = max(b[0], at[0] + max(16, high[0] * scale + 10)) + 14
        put_dimension(canvas, np.array([x, a[1]]), np.array([x, b[1]]), length(sizes[1]), 90)
    words = thickness_words(section)
    foot = bottom[1] - 24
    canvas.text(np.array([(a[0] + b[0]) / 2, foot]), name, SOFT, 8)
    if words:
        canvas.text(np.array([(a[0] + b[0]) / 2, foot - 12]), words, SOFT, 8)
    return canvas.extent()[1][0]


def sections_drawn(scene):
    out = {}
    for member in scene.members.values():
        for name in member.sections:
            if geometry.outline(scene.sections[name]):
                out.setdefault(str(scene.sections[name]), name)
    return list(out.values())[:MOST]


def compose_sections(scene):
    names = sections_drawn(scene)
    if not names:
        return None
    canvas, left = Canvas(), 0
    for name in names:
        left = put_section(canvas, name, scene.sections[name], left) + GAP
    return canvas


def draw_sections(scene):
    canvas = compose_sections(scene)
    return canvas and canvas.finish()


FAR = 5  # distance, in multiples of the size of the structure, from which an axis of rotation is not drawn
MOST_NAMES = 9  # names are drawn for at most this number of nodes


def skeleton(scene, lines):
    """Returns the positions of the nodes and of the points on the axes of members [n x 3]."""
    points = [line.points for line in lines.values()]
    return np.vstack(points + [n.position[None] for n in scene.nodes.values()])


def body(scene, lines):
    """Returns the corners of the sections at the ends of members, and the centres of masses [n x 3]."""
    out = [n.position[None] + n.centre for n in scene.nodes.values() if n.mass]
    for name, member in scene.members.items():
        line = lines[name]
        for section, end in zip(member.sections, (0, -1)):
            for polygon in geometry.outline(scene.sections[section]):
                out.append(line.points[end] + polygon @ line.axes[end][1:])
    return np.vstack(out) if out else np.zeros((0, 3))


def directions(scene):
    """Returns (translational directions, rotational directions) of loads, motions, fork supports, springs and rotating
    axes."""
    shifts, turns = [], []
    for load in scene.loads:
        (turns if "moment" in load.kind else shifts).extend((load.vector, load.last))
        shifts.append(load.at)
    for node in scene.nodes.values():
        for way, turn, _ in loads.motions_of(scene, node):
            (turns if turn else shifts).append(way)
        if node.fork is not None:
            shifts += [node.fork[0], node.fork[1], np.cross(*node.fork)]
    if scene.spin is not None and scene.spin.omega.any():
        turns.append(scene.spin.omega)
    for spring in scene.springs:
        shifts += [np.eye(3)[i] for i in range(3) if spring.acts[i]]
    return [v for v in shifts if np.any(v)], [v for v in turns if np.any(v)]


def put_names(canvas, look, scene):
    asked = [n for n in scene.nodes.values() if n.name in scene.asked]
    named = asked if len(scene.nodes) > MOST_NAMES else list(scene.nodes.values())
    if len(named) > MOST_NAMES:
        return
    for node in named:
        canvas.label(look(node.position), node.name, SOFT, 8, near=5)


def near_spin(scene, points):
    if scene.spin is None:
        return False
    away = np.linalg.norm(scene.spin.centre - points.mean(axis=0))
    return away < FAR * np.linalg.norm(np.ptp(points, axis=0))


def compose(scene):
    lines = {name: geometry.line_of(scene, m) for name, m in scene.members.items()}
    points = skeleton(scene, lines)
    solid = any(geometry.outline(s) for s in scene.sections.values())
    look = geometry.choose_view(points, *directions(scene), solid)
    centre = scene.spin.centre[None] if near_spin(scene, points) else points[:0]
    look = geometry.scaled(look, np.vstack([points, body(scene, lines), centre]))
    canvas = Canvas()

    def into(name):
        return [w for own in members.rigid(scene, name) for w in members.into(scene, lines, own)]

    members.put_bodies(canvas, look, scene)
    for name, member in scene.members.items():
        members.put_member(canvas, look, scene, member, lines[name])
        members.put_hinges(canvas, look, member, lines[name])
    joints.put_offsets(canvas, look, scene)
    joints.put_constraints(canvas, look, scene)
    members.put_warping(canvas, look, scene, lines)
    members.put_springs(canvas, look, scene)
    members.put_masses(canvas, look, scene)
    members.put_supports(canvas, look, scene, lines)
    loads.put_loads(canvas, look, scene, lines, into)
    loads.put_motions(canvas, look, scene, into)
    if near_spin(scene, points):
        loads.put_spin(canvas, look, scene, np.linalg.norm(np.ptp(points, axis=0)))
    put_names(canvas, look, scene)
    canvas.place_labels()
    canvas.labels = []
    put_sizes(canvas, look, points)
    put_axes(canvas, look)
    return canvas


def draw(scene):
    return compose(scene).finish()
