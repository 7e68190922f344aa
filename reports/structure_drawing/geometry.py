import math
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

STEPS = 24  # number of segments of a curved member


@dataclass
class Line:
    """Axis of a member: points [n x 3], and the triads [n x 3 x 3] at these points, whose rows are x, y, z."""
    points: np.ndarray
    axes: np.ndarray


def triad(x, y):
    """Returns the triad whose rows are the unit vector along x, the unit vector along the part of y normal to x, and the
    third axis."""
    x = x / np.linalg.norm(x)
    y = y - x * (x @ y)
    y = y / np.linalg.norm(y)
    return np.array([x, y, np.cross(x, y)])


def chord(k, s):
    w = np.linalg.norm(k)
    e = np.array([1.0, 0, 0])
    if w * s < 1e-9:
        return s * e
    first = np.cross(k, e)
    return (s * e + (1 - np.cos(w * s)) / w**2 * first +
            (w * s - np.sin(w * s)) / w**3 * np.cross(k, first))


def arc_length(k, distance):
    length = distance
    for _ in range(60):
        length += distance - np.linalg.norm(chord(k, length))
    return length


def line_of(scene, member):
    """Returns the axis of a member between its ends, which may be offset from its nodes."""
    p, q = (scene.nodes[name].position + offset for name, offset in zip(member.ends, member.offset))
    B = triad(q - p, member.y)
    k = member.curvature
    if not k.any():
        return Line(np.array([p, q]), np.array([B, B]))
    length = arc_length(k, np.linalg.norm(q - p))
    R = B.T @ triad(chord(k, length), np.array([0, 1.0, 0]))  # the columns are the triad at p
    along = np.linspace(0, length, STEPS + 1)
    turned = Rotation.from_rotvec(np.outer(along, k)).as_matrix()
    return Line(np.array([p + R @ chord(k, s) for s in along]),
                np.swapaxes(R @ turned, -1, -2))


def rectangle(y, z, height, width):
    """Returns the corners (y, z) of a rectangle about the point (y, z) [4 x 2]."""
    return np.array([y, z]) + 0.5 * np.array([[-height, -width], [height, -width],
                                              [height, width], [-height, width]])


def meet(walls):
    return bool(set.intersection(*({w["from"], w["to"]} for w in walls)))


def warps(section):
    given = section.get("given", {})
    if "Iw" in given:
        return float(given["Iw"]) > 0
    if "walls" in section:
        return not meet(section["walls"])
    return "rectangle" in section or float(section.get("constants", {}).get("Iw", 0)) > 0


def walls_of(section):
    """Returns (strips [4 x 2], ends of the mid-lines [walls x 2 x 2], thicknesses [walls]) of thin walls. Positions are
    relative to the centroid of the walls."""
    points = {name: np.array([float(v) for v in p]) for name, p in section["points"].items()}
    ends = np.array([[points[w["from"]], points[w["to"]]] for w in section["walls"]])
    thickness = np.array([float(w["thickness"]) for w in section["walls"]])
    areas = thickness * np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    ends = ends - (areas[:, None] * ends.mean(axis=1)).sum(axis=0) / areas.sum()
    strips = []
    for (a, b), t in zip(ends, thickness):
        across = 0.5 * t * np.array([a[1] - b[1], b[0] - a[0]]) / np.linalg.norm(b - a)
        strips.append(np.array([a - across, b - across, b + across, a + across]))
    return strips, ends, thickness


def circle(radius, count=24):
    angle = 2 * np.pi * np.arange(count) / count
    return radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def outline(section):
    """Returns the polygons [n x 2] in (y, z) of a section [m], or [] if only its constants are known."""
    if "rectangle" in section:
        r = section["rectangle"]
        return [rectangle(0, 0, float(r["thickness"]), float(r["width"]))]
    if "walls" in section:
        return walls_of(section)[0]
    if "tube" in section:
        return [circle(0.5 * float(section["tube"]["diameter"]))]
    return []


def prism(line, here, there):
    """Returns (quadrilaterals of the sides of a member [m x 4 x 3], [first and last cross-section]), with the outline
    `here` at its start and `there` at its end."""
    share = np.linspace(0, 1, len(line.points))[:, None, None]
    rings = (1 - share) * here + share * there  # [points x corners x 2]
    y, z = line.axes[:, None, 1], line.axes[:, None, 2]
    edges = line.points[:, None] + rings[..., :1] * y + rings[..., 1:] * z
    n = edges.shape[1]
    sides = [np.stack([edges[:-1, k], edges[:-1, (k + 1) % n], edges[1:, (k + 1) % n],
                       edges[1:, k]], axis=1) for k in range(n)]
    return np.concatenate(sides), [edges[0], edges[-1]]


# View of a structure: normal to its plane if the structure is plane, otherwise from above at an angle.

WIDTH, HEIGHT = 400, 230  # largest size of the structure on paper [pt]
FLAT = 1e-6  # ratio to the largest extent below which an extent is treated as zero
AZIMUTHS, ELEVATIONS = (-72, -64, -56, -48, -40, -32), (18, 24, 31)  # [degrees]
MOST_POINTS = 60  # largest number of points by which a view is rated


@dataclass
class View:
    """A view. `right`, `up` and `near` are unit vectors of the picture, and `scale` is in [pt/m]."""
    right: np.ndarray
    up: np.ndarray
    scale: float = 1

    @property
    def near(self):
        return np.cross(self.right, self.up)

    @property
    def face_on(self):
        return max(abs(self.near)) > 1 - 1e-9

    def __call__(self, points):
        """Returns positions on paper [.. x 2], in pt."""
        return self.scale * np.stack([points @ self.right, points @ self.up], axis=-1)

    def depth(self, points):
        return points @ self.near


def view_from_angles(azimuth, elevation):
    a, e = math.radians(azimuth), math.radians(elevation)
    return View(np.array([-math.sin(a), math.cos(a), 0]),
                np.array([-math.sin(e) * math.cos(a), -math.sin(e) * math.sin(a), math.cos(e)]))


X, Y, Z = np.eye(3)
FACES = (View(X, Y), View(X, Z), View(Y, Z))


def in_plane(normal, flat, shifts, turns):
    """Returns True if all points lie and move in the plane normal to an axis and rotate only about this axis."""
    others = np.eye(3)[[i for i in range(3) if i != normal]]
    return bool(flat[normal] and all(abs(v[normal]) <= FLAT * np.linalg.norm(v) for v in shifts)
                and all(max(abs(others @ v)) <= FLAT * np.linalg.norm(v) for v in turns))


def openness(view, points):
    """Returns the smallest distance on paper between points that are separate in space, relative to the size of the
    picture."""
    first, second = np.triu_indices(len(points), 1)
    flat = view(points)
    on_paper, space = (np.linalg.norm(p[first] - p[second], axis=1) for p in (flat, points))
    size = np.linalg.norm(np.ptp(points, axis=0))
    apart = on_paper[space > 1e-3 * size]
    return apart.min() / size if len(apart) else 0


def choose_view(points, shifts, turns, solid):
    """Returns the view of points [n x 3]. `shifts` and `turns` are the translational and rotational directions of loads
    and motions. `solid` is True if sections have a shape."""
    extent = np.ptp(points, axis=0)
    flat = extent <= FLAT * np.linalg.norm(extent)
    straight = flat.sum() == 2
    if not (straight and solid):
        for view in FACES:
            normal = int(np.argmax(abs(view.near)))
            lies = straight or not flat[[i for i in range(3) if i != normal]].any()
            if lies and in_plane(normal, flat, shifts, turns):
                return view
    if straight:
        return view_from_angles(-35 if extent.argmax() == 1 else -58, 20)
    few = points[::math.ceil(len(points) / MOST_POINTS)]
    views = [view_from_angles(a, e) for a in AZIMUTHS for e in ELEVATIONS]
    return max(views, key=lambda v: openness(v, few))


def scaled(view, points):
    width, height = np.maximum(np.ptp(View(view.right, view.up)(points), axis=0), 1e-300)
    return View(view.right, view.up, min(WIDTH / width, HEIGHT / height))
