"""What holds a structure: clamps, pins, forks, single components."""
import numpy as np

from reports.drawing.canvas import INK, SOFT
from reports.drawing.members import put_ground
from reports.drawing.scene import COMPONENTS

PLATE = 15  # half a side of a clamp's plate [pt]
HATCHES = 9  # lines of a plate
MOST_LETTERS = 4  # supports with letters; more are told in the list below the drawing


def held_of(scene, node):
    """Components that do not move: held, driven by a motion that stays at zero, turns that are
    held."""
    still = [c for c, motion in node.driven.items() if scene.motions.get(motion) == (0, 0)]
    turned = [f"turn {i + 1}" for i, t in enumerate(node.turns) if t.angle == "held"]
    return [c for c in COMPONENTS if c in node.held or c in still] + turned


def rigid(scene, name):
    """Nodes that move with one, itself among them."""
    return [name] + [n.name for n in scene.nodes.values() if n.part_of == name]


def into(scene, lines, name):
    """Unit vectors from a node into its members."""
    out = []
    for key, member in scene.members.items():
        line = lines[key].points
        for own, a, b in ((member.ends[0], line[0], line[1]), (member.ends[1], line[-1], line[-2])):
            if own == name:
                out.append((b - a) / np.linalg.norm(b - a))
    return out


def put_plate(canvas, view, at, way, mark):
    """A plate across a member in space; 0: it is seen from its edge."""
    side = np.cross(way, [0, 0, 1.0] if abs(way[2]) < 0.9 else [1.0, 0, 0])
    side /= np.linalg.norm(side)
    other, h = np.cross(way, side), PLATE / view.scale
    corners = view(np.array([at + h * (a * side + b * other)
                             for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]))
    (ax, ay), (bx, by) = corners[1] - corners[0], corners[3] - corners[0]
    if abs(ax * by - ay * bx) < 0.15 * (2 * PLATE)**2:
        return 0
    canvas.area(corners, "white", INK, 0.9, mark, order=1)
    for sum_of_both in np.linspace(0, 2, HATCHES + 2)[1:-1]:
        first, last = max(0, sum_of_both - 1), min(1, sum_of_both)
        canvas.line([corners[0] + s * (corners[1] - corners[0]) +
                     (sum_of_both - s) * (corners[3] - corners[0]) for s in (first, last)],
                    SOFT, 0.6, above=False, clear=False)
    return 1


def put_edge(canvas, view, at, way, mark):
    """The plate from its edge: a hatched line behind the node."""
    flat = view(way)
    flat = flat / np.linalg.norm(flat) if np.linalg.norm(flat) > 0.1 * view.scale else \
        np.array([0, 1.0])
    canvas.dot(view(at), 2, INK, mark=mark)
    put_ground(canvas, view(at), -flat)


def put_pin(canvas, at, way, mark, roller):
    """A triangle on the side `way` of the node; roller: something slides across."""
    across = np.array([-way[1], way[0]])
    foot = at + 11 * way
    canvas.area(np.array([at, foot - 7 * across, foot + 7 * across]), "white", INK, 1.1, mark=mark,
                order=6)
    if roller:
        for x in (-4, 4):
            canvas.dot(foot + 2.5 * way + x * across, 3.5, "white")
    put_ground(canvas, foot + (5 if roller else 0) * way, way)


def put_fork(canvas, view, at, fork, mark):
    """Two guides on both sides of the web."""
    axis, web = (v / np.linalg.norm(v) for v in fork)
    normal, h = np.cross(web, axis), 13 / view.scale
    for sign in (-1, 1):
        ends = view(at + 0.55 * h * sign * normal + np.outer([-1, 1], h * web))
        if np.linalg.norm(ends[1] - ends[0]) < 6:
            ends = view(at) + np.array([[-9, 5.0 * sign], [9, 5.0 * sign]])
        canvas.line(ends, INK, 2.2, mark=mark if sign > 0 else None)


def pin_way(view, seen, ways):
    """Below the node; where one direction on paper is held only, along it, away from the
    members."""
    down = np.array([0, -1.0])
    if not view.face_on or len(seen) != 1:
        return down
    way = view(np.eye(3)["xyz".index(seen[0][1])]) / view.scale
    inside = sum((view(w) for w in ways), np.zeros(2)) @ way
    return -way if inside > 1e-9 or (abs(inside) <= 1e-9 and way @ down < 0) else way


def put_support(canvas, view, scene, lines, node):
    """Symbol of one node, whose components are held at least in part."""
    mark, at, held = f"support_{node.name}", view(node.position), held_of(scene, node)
    ways = into(scene, lines, node.name)
    if len(held) == 6:
        way = ways[0] if len(ways) == 1 else None
        if way is None or not put_plate(canvas, view, node.position, way, mark):
            put_edge(canvas, view, node.position, way if way is not None else view.up, mark)
        return
    if node.fork is not None:
        put_fork(canvas, view, node.position, node.fork, mark)
    shifts = [c for c in held if c[0] == "u"]
    seen = [c for c in shifts
            if not view.face_on or abs(np.eye(3)["xyz".index(c[1])] @ view.near) < 0.9]
    if node.fork is None and len(seen) > 0:
        sliding = len(seen) < (2 if view.face_on else 3)
        put_pin(canvas, at, pin_way(view, seen, ways), mark, sliding)
    elif node.fork is None:
        canvas.dot(at, 8, "white", mark=mark)


def supported(scene):
    return [n for n in scene.nodes.values() if held_of(scene, n) or n.fork is not None]


def put_supports(canvas, view, scene, lines):
    partly = [n for n in supported(scene) if len(held_of(scene, n)) < 6]
    for node in supported(scene):
        put_support(canvas, view, scene, lines, node)
    for node in partly if len(partly) <= MOST_LETTERS else ():
        held = held_of(scene, node) + (["fork"] if node.fork is not None else [])
        canvas.label(view(node.position), "held: " + " ".join(held), SOFT, 8, near=14,
                     towards=np.array([0, -1.0]))
