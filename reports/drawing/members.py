"""Members with their sections, rigid bodies, masses, springs and hinges."""
import numpy as np

from reports import shapes
from reports.drawing import geometry
from reports.drawing.canvas import BODY, INK, MASS, ROD, SOFT, SPRING, STEEL
from reports.drawing.words import number

THIN = 0.2  # thickness to length of a wall that is drawn as a surface
SEEN = 2.5  # size of a section on paper from which it is drawn [pt]
LIGHT = np.array([0.3, -0.5, 0.81])
FEW = 10  # members with centre lines
HINGE = 9  # from the end of a member [pt]
WARPING = 7  # likewise


def shade(colour, quad):
    """Lighter where it faces the light."""
    normal = np.cross(quad[1] - quad[0], quad[2] - quad[1])
    size = np.linalg.norm(normal)
    bright = abs(normal @ LIGHT) / size if size > 0 else 1
    rgb = np.array([int(colour[i:i + 2], 16) for i in (1, 3, 5)])
    return "#" + "".join(f"{int(v):02x}" for v in np.minimum(255, rgb * (0.82 + 0.26 * bright)))


def is_thin(strip):
    a, b = np.linalg.norm(strip[1] - strip[0]), np.linalg.norm(strip[2] - strip[1])
    return min(a, b) < THIN * max(a, b)


def middle_line(strip):
    """Of a thin polygon with four corners [2 x 2]."""
    a, b = np.linalg.norm(strip[1] - strip[0]), np.linalg.norm(strip[2] - strip[1])
    return np.array([(strip[0] + strip[3]) / 2, (strip[1] + strip[2]) / 2]) if a > b else \
        np.array([(strip[0] + strip[1]) / 2, (strip[2] + strip[3]) / 2])


def put_polygon(canvas, view, corners, colour, edge=INK):
    canvas.face(view(corners), float(view.depth(corners).mean()), shade(colour, corners), edge)


def put_solid(canvas, view, line, here, there):
    """One polygon of a section, along the member."""
    if len(here) == 4 and is_thin(here) and is_thin(there):
        a, b = middle_line(here), middle_line(there)
        sides, _ = geometry.prism(line, a, b)
        for quad in sides[:len(sides) // 2]:
            put_polygon(canvas, view, quad, STEEL, INK if len(line.points) == 2 else STEEL)
        return
    sides, ends = geometry.prism(line, here, there)
    smooth = len(line.points) > 2 or len(here) > 8
    for quad in sides:
        put_polygon(canvas, view, quad, STEEL, STEEL if smooth else INK)
    for end in ends:
        put_polygon(canvas, view, end, STEEL)


def breadth(view, line, polygons):
    """Of a member on paper, across its line [pt]."""
    if not polygons:
        return 0
    flat = view(line.points[[0, -1]])
    way = (flat[1] - flat[0]) / max(np.linalg.norm(flat[1] - flat[0]), 1e-9)
    corners = view(np.vstack(polygons) @ line.axes[0][1:])
    return np.ptp(corners @ [-way[1], way[0]])


def put_member(canvas, view, scene, member, line):
    outlines = [geometry.outline(scene.sections[name]) for name in member.sections]
    flat, few = view(line.points), len(scene.members) <= FEW
    if not outlines[0] or few and max(breadth(view, line, p) for p in outlines) < SEEN:
        canvas.line(flat, INK, 2.4, mark=member.name)
        return
    for here, there in zip(*outlines):
        put_solid(canvas, view, line, here, there)
    if few:
        canvas.line(flat, INK, 0.7, (0, (8, 2, 1.5, 2)), mark=member.name)


def put_hinges(canvas, view, member, line):
    flat = view(line.points)
    for released, at, beside in ((member.released[0], flat[0], flat[1]),
                                 (member.released[1], flat[-1], flat[-2])):
        if released:
            way = (beside - at) / np.linalg.norm(beside - at)
            canvas.dot(at + HINGE * way, 6, "white", mark=f"hinge_{member.name}")
            canvas.label(at + HINGE * way, "free: " + " ".join(released), SOFT, 8)


def ends_that_warp(scene):
    """(member, its end: 0 or 1, fixed, free or shared) of all whose section warps."""
    if "warping" in scene.omitted or "all" in scene.omitted:
        return
    for member in scene.members.values():
        for end, word in enumerate(member.warping):
            if word and geometry.warps(scene.sections[member.sections[end]]):
                yield member, end, word


def put_warping(canvas, view, scene, lines):
    """Bars across the ends of members: filled where they hold the warping, open where it is free."""
    for member, end, word in ends_that_warp(scene) if len(scene.members) <= FEW else ():
        flat = view(lines[member.name].points)
        at, beside = (flat[0], flat[1]) if end == 0 else (flat[-1], flat[-2])
        long = np.linalg.norm(beside - at)
        if word == "shared" or long < 3 * WARPING:
            continue
        way = (beside - at) / long
        across = np.array([-way[1], way[0]])
        middle = at + (HINGE + 7 if member.released[end] else WARPING) * way
        corners = np.array([middle + a * 1.6 * way + b * 6 * across
                            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
        canvas.area(corners, INK if word == "fixed" else "white", INK, 0.9, order=7,
                    mark=f"warping_{member.name}_{end}")


def put_bodies(canvas, view, scene):
    """Convex hulls of what moves together; rods between parts that are far from each other."""
    for name, node in scene.nodes.items():
        own = [n.position for n in scene.nodes.values() if n.part_of == name]
        if not own or node.part_of:
            continue
        points = np.array(own + [node.position])
        groups = shapes.clusters(points)
        faces = [f for g in groups for f in shapes.hull(points[g])]
        if len(groups) > 1:
            faces += shapes.hull(np.array([points[g].mean(axis=0) for g in groups]))
        for face in faces:
            if len(face) > 2:
                put_polygon(canvas, view, face, BODY, ROD)
            elif len(face) == 2:
                canvas.line(view(face), ROD, 4.5, above=False)


def put_masses(canvas, view, scene):
    for node in scene.nodes.values():
        if node.mass:
            at = view(node.position + node.centre)
            if node.centre.any():
                canvas.line([view(node.position), at], ROD, 3, above=False)
            canvas.dot(at, 11, MASS, mark=f"mass_{node.name}")
            canvas.label(at, f"{number(node.mass)} kg", INK, near=10)


def zigzag(a, b, width=5, turns=5):
    """From a to b [n x 2]."""
    along = b - a
    across = np.array([-along[1], along[0]]) / max(np.linalg.norm(along), 1e-9)
    share = np.concatenate([[0, 0.15], np.linspace(0.2, 0.8, 2 * turns), [0.85, 1]])
    sign = np.concatenate([[0, 0], [(-1)**i for i in range(2 * turns)], [0, 0]])
    return a + share[:, None] * along + width * sign[:, None] * across


def spiral(turns=2.2, radius=12):
    """Around the origin [n x 2], from the middle outwards."""
    angle = np.linspace(0, 2 * np.pi * turns, 60)
    return radius * (0.15 + 0.85 * angle[:, None] / angle[-1]) * np.stack(
        [np.cos(angle), np.sin(angle)], axis=1)


def stands_along(view, spring):
    """Direction on paper of a spring to the ground: that of its stiffest shift, else downwards."""
    k = spring.stiffness[:3]
    way = view(np.eye(3)[int(np.argmax(k))]) if k.any() else np.zeros(2)
    way = way if np.linalg.norm(way) > 0.2 * view.scale else np.array([0, -1.0])
    way = way / np.linalg.norm(way)
    return way if way[1] < 0.5 else -way


def spring_words(spring):
    names = ("kx", "ky", "kz", "krx", "kry", "krz")
    units = ("N/m",) * 3 + ("N m",) * 3
    return [f"{n} {number(k)} {u}" for n, k, u in zip(names, spring.stiffness, units) if k]


def put_springs(canvas, view, scene):
    for spring in scene.springs:
        at = view(scene.nodes[spring.ends[1]].position)
        turns = not spring.stiffness[:3].any()
        foot = at if turns or spring.ends[0] else at + 34 * stands_along(view, spring)
        if spring.ends[0]:
            foot = view(scene.nodes[spring.ends[0]].position)
        elif not turns:
            put_ground(canvas, foot, foot - at)
        shape = at + spiral() if np.linalg.norm(foot - at) < 8 else zigzag(foot, at)
        canvas.line(shape, SPRING, 1.2, mark=spring.name)
        canvas.label((foot + at) / 2, ", ".join(spring_words(spring)[:2]), SPRING, 8, near=8)


def put_ground(canvas, at, away):
    """A hatched line across a direction."""
    way = away / np.linalg.norm(away)
    across = np.array([-way[1], way[0]])
    canvas.line([at - 11 * across, at + 11 * across], INK, 1.3)
    for k in np.linspace(-9, 11, 6):
        canvas.line([at + k * across, at + (k - 4) * across + 5 * way], INK, 0.7)
