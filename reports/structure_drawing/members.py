"""Draws members with their sections, rigid bodies, masses, springs and hinges."""
import numpy as np

from reports import shapes
from reports.structure_drawing import geometry
from reports.structure_drawing.canvas import BODY, INK, MASS, ROD, SOFT, SPRING, STEEL, number
from reports.structure_drawing.scene import COMPONENTS

THIN = 0.2  # ratio of thickness to length up to which a wall is drawn as a surface
SEEN = 2.5  # size on paper from which a section is drawn [pt]
LIGHT = np.array([0.3, -0.5, 0.81])
FEW = 10  # largest number of members whose centre lines are drawn
HINGE = 9  # distance of a hinge from the end of a member [pt]
WARPING = 7  # distance of a warping symbol from the end of a member [pt]


def shade(colour, quad):
    """Returns the colour of a face. Faces that are turned towards the light are lighter."""
    normal = np.cross(quad[1] - quad[0], quad[2] - quad[1])
    size = np.linalg.norm(normal)
    bright = abs(normal @ LIGHT) / size if size > 0 else 1
    rgb = np.array([int(colour[i:i + 2], 16) for i in (1, 3, 5)])
    return "#" + "".join(f"{int(v):02x}" for v in np.minimum(255, rgb * (0.82 + 0.26 * bright)))


def is_thin(strip):
    a, b = np.linalg.norm(strip[1] - strip[0]), np.linalg.norm(strip[2] - strip[1])
    return min(a, b) < THIN * max(a, b)


def middle_line(strip):
    a, b = np.linalg.norm(strip[1] - strip[0]), np.linalg.norm(strip[2] - strip[1])
    return np.array([(strip[0] + strip[3]) / 2, (strip[1] + strip[2]) / 2]) if a > b else \
        np.array([(strip[0] + strip[1]) / 2, (strip[2] + strip[3]) / 2])


def put_polygon(canvas, view, corners, colour, edge=INK):
    canvas.face(view(corners), float(view.depth(corners).mean()), shade(colour, corners), edge)


def put_solid(canvas, view, line, here, there):
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
    """Returns the width of a member on paper, normal to its line [pt]."""
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
    """Yields (member, end, word) for the ends of members whose sections warp. `end` is 0 or 1, and `word` is "fixed",
    "free" or "shared"."""
    if "warping" in scene.omitted or "all" in scene.omitted:
        return
    for member in scene.members.values():
        for end, word in enumerate(member.warping):
            if word and geometry.warps(scene.sections[member.sections[end]]):
                yield member, end, word


def put_warping(canvas, view, scene, lines):
    """Draws bars across the ends of members. The bars are filled where warping is restrained and open where it is free."""
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
    along = b - a
    across = np.array([-along[1], along[0]]) / max(np.linalg.norm(along), 1e-9)
    share = np.concatenate([[0, 0.15], np.linspace(0.2, 0.8, 2 * turns), [0.85, 1]])
    sign = np.concatenate([[0, 0], [(-1)**i for i in range(2 * turns)], [0, 0]])
    return a + share[:, None] * along + width * sign[:, None] * across


def spiral(turns=2.2, radius=12):
    """Returns a spiral around the origin [n x 2], from the middle outwards."""
    angle = np.linspace(0, 2 * np.pi * turns, 60)
    return radius * (0.15 + 0.85 * angle[:, None] / angle[-1]) * np.stack(
        [np.cos(angle), np.sin(angle)], axis=1)


def stands_along(view, spring):
    """Returns the direction on paper of a spring to the ground: that of its stiffest translation, or downwards if there
    is none."""
    k = spring.stiffness[:3] if spring.stiffness[:3].any() else spring.acts[:3]
    way = view(np.eye(3)[int(np.argmax(k))]) if k.any() else np.zeros(2)
    way = way if np.linalg.norm(way) > 0.2 * view.scale else np.array([0, -1.0])
    way = way / np.linalg.norm(way)
    return way if way[1] < 0.5 else -way


def spring_words(spring):
    names = ("kx", "ky", "kz", "krx", "kry", "krz")
    units = ("N/m",) * 3 + ("N m",) * 3
    words = [f"{n} {number(k)} {u}" for n, k, u in zip(names, spring.stiffness, units) if k]
    words += [f"table of {n[1:]}" for n, table in zip(names, spring.tables) if table]
    rates = ("N s/m",) * 3 + ("N m s",) * 3
    return words + [f"c{n[1:]} {number(c)} {u}" for n, c, u in zip(names, spring.damping, rates) if c]


def put_springs(canvas, view, scene):
    for spring in scene.springs:
        at = view(scene.nodes[spring.ends[1]].position)
        turns = not spring.acts[:3].any()
        foot = at if turns or spring.ends[0] else at + 34 * stands_along(view, spring)
        if spring.ends[0]:
            foot = view(scene.nodes[spring.ends[0]].position)
        elif not turns:
            put_ground(canvas, foot, foot - at)
        shape = at + spiral() if np.linalg.norm(foot - at) < 8 else zigzag(foot, at)
        canvas.line(shape, SPRING, 1.2, mark=spring.name)
        canvas.label((foot + at) / 2, ", ".join(spring_words(spring)[:2]), SPRING, 8, near=8)


def put_ground(canvas, at, away):
    way = away / np.linalg.norm(away)
    across = np.array([-way[1], way[0]])
    canvas.line([at - 11 * across, at + 11 * across], INK, 1.3)
    for k in np.linspace(-9, 11, 6):
        canvas.line([at + k * across, at + (k - 4) * across + 5 * way], INK, 0.7)


PLATE = 15  # half the side of the plate of a clamp [pt]
HATCHES = 9  # number of hatching lines of a plate
MOST_LETTERS = 4  # fixed components are named if at most this number of nodes is partly fixed


def held_of(scene, node):
    """Returns the components that do not move: fixed components, components with a motion that is always zero, and fixed
    rotations."""
    still = [c for c, motion in node.driven.items() if scene.motions.get(motion) == (0, 0)]
    turned = [f"turn {i + 1}" for i, t in enumerate(node.turns) if t.angle == "held"]
    return [c for c in COMPONENTS if c in node.held or c in still] + turned


def rigid(scene, name):
    return [name] + [n.name for n in scene.nodes.values() if n.part_of == name]


def into(scene, lines, name):
    """Returns the unit vectors from a node along its members."""
    out = []
    for key, member in scene.members.items():
        line = lines[key].points
        for own, a, b in ((member.ends[0], line[0], line[1]), (member.ends[1], line[-1], line[-2])):
            if own == name:
                out.append((b - a) / np.linalg.norm(b - a))
    return out


def put_plate(canvas, view, at, way, mark):
    """Draws a hatched plate normal to `way` and returns 1. Draws nothing and returns 0 if the plate would be seen
    edge-on."""
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
    """Draws a plate seen edge-on as a hatched line behind the node."""
    flat = view(way)
    flat = flat / np.linalg.norm(flat) if np.linalg.norm(flat) > 0.1 * view.scale else \
        np.array([0, 1.0])
    canvas.dot(view(at), 2, INK, mark=mark)
    put_ground(canvas, view(at), -flat)


def put_pin(canvas, at, way, mark, roller):
    """Draws the symbol of a pinned support. `roller` is True if the support can slide."""
    across = np.array([-way[1], way[0]])
    foot = at + 11 * way
    canvas.area(np.array([at, foot - 7 * across, foot + 7 * across]), "white", INK, 1.1, mark=mark,
                order=6)
    if roller:
        for x in (-4, 4):
            canvas.dot(foot + 2.5 * way + x * across, 3.5, "white")
    put_ground(canvas, foot + (5 if roller else 0) * way, way)


def put_fork(canvas, view, at, fork, mark):
    """Draws two guides, one on each side of the web."""
    axis, web = (v / np.linalg.norm(v) for v in fork)
    normal, h = np.cross(web, axis), 13 / view.scale
    for sign in (-1, 1):
        ends = view(at + 0.55 * h * sign * normal + np.outer([-1, 1], h * web))
        if np.linalg.norm(ends[1] - ends[0]) < 6:
            ends = view(at) + np.array([[-9, 5.0 * sign], [9, 5.0 * sign]])
        canvas.line(ends, INK, 2.2, mark=mark if sign > 0 else None)


def pin_way(view, seen, ways):
    """Returns the direction of the symbol of a pin, which is downwards by default. If only one direction on paper is
    fixed, the symbol is along this direction and away from the members."""
    down = np.array([0, -1.0])
    if not view.face_on or len(seen) != 1:
        return down
    way = view(np.eye(3)["xyz".index(seen[0][1])]) / view.scale
    inside = sum((view(w) for w in ways), np.zeros(2)) @ way
    return -way if inside > 1e-9 or (abs(inside) <= 1e-9 and way @ down < 0) else way


def put_support(canvas, view, scene, lines, node):
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
