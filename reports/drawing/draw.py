"""A scene as a figure."""
import numpy as np

from reports.drawing import geometry, loads, members, sizes, supports, view
from reports.drawing.canvas import Canvas, SOFT

FAR = 5  # sizes of a structure from which an axis is no longer drawn
MOST_NAMES = 9  # nodes whose names are written


def skeleton(scene, lines):
    """Nodes and lines [n x 3]."""
    points = [line.points for line in lines.values()]
    return np.vstack(points + [n.position[None] for n in scene.nodes.values()])


def body(scene, lines):
    """Corners of the sections at the ends of members, and masses [n x 3]."""
    out = [n.position[None] + n.centre for n in scene.nodes.values() if n.mass]
    for name, member in scene.members.items():
        line = lines[name]
        for section, end in zip(member.sections, (0, -1)):
            for polygon in geometry.outline(scene.sections[section]):
                out.append(line.points[end] + polygon @ line.axes[end][1:])
    return np.vstack(out) if out else np.zeros((0, 3))


def directions(scene):
    """Of shifts and of turns that loads, motions, springs and axes make."""
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
        shifts += [np.eye(3)[i] for i in range(3) if spring.stiffness[i]]
    return [v for v in shifts if np.any(v)], [v for v in turns if np.any(v)]


def put_names(canvas, look, scene):
    """Of all nodes, or, where they are many, of those that quantities are of."""
    asked = [n for n in scene.nodes.values() if n.name in scene.asked]
    named = asked if len(scene.nodes) > MOST_NAMES else list(scene.nodes.values())
    if len(named) > MOST_NAMES:
        return
    for node in named:
        canvas.label(look(node.position), node.name, SOFT, 8, near=5)


def near_spin(scene, points):
    """Is the axis about which all turns so near that it can be drawn?"""
    if scene.spin is None:
        return False
    away = np.linalg.norm(scene.spin.centre - points.mean(axis=0))
    return away < FAR * np.linalg.norm(np.ptp(points, axis=0))


def compose(scene):
    """A canvas with the scene on it."""
    lines = {name: geometry.line_of(scene, m) for name, m in scene.members.items()}
    points = skeleton(scene, lines)
    solid = any(geometry.outline(s) for s in scene.sections.values())
    look = view.choose(points, *directions(scene), solid)
    centre = scene.spin.centre[None] if near_spin(scene, points) else points[:0]
    look = view.scaled(look, np.vstack([points, body(scene, lines), centre]))
    canvas = Canvas()

    def into(name):
        return [w for own in supports.rigid(scene, name) for w in supports.into(scene, lines, own)]

    members.put_bodies(canvas, look, scene)
    for name, member in scene.members.items():
        members.put_member(canvas, look, scene, member, lines[name])
        members.put_hinges(canvas, look, member, lines[name])
    members.put_warping(canvas, look, scene, lines)
    members.put_springs(canvas, look, scene)
    members.put_masses(canvas, look, scene)
    supports.put_supports(canvas, look, scene, lines)
    loads.put_loads(canvas, look, scene, lines, into)
    loads.put_motions(canvas, look, scene, into)
    if near_spin(scene, points):
        loads.put_spin(canvas, look, scene, np.linalg.norm(np.ptp(points, axis=0)))
    put_names(canvas, look, scene)
    canvas.place_labels()
    canvas.labels = []
    sizes.put_sizes(canvas, look, points)
    sizes.put_axes(canvas, look)
    return canvas


def draw(scene):
    """The figure of a scene."""
    return compose(scene).finish()
