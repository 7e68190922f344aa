"""From where a structure is looked at: face-on where it lies in a plane, else from above at an
angle."""
import itertools
import math
from dataclasses import dataclass

import numpy as np

WIDTH, HEIGHT = 400, 230  # of the structure on paper, at most [pt]
FLAT = 1e-6  # extent below this part of the whole counts as none
AZIMUTHS, ELEVATIONS = (-72, -64, -56, -48, -40, -32), (18, 24, 31)  # [degrees]
MOST_POINTS = 60  # that an angle is judged by


@dataclass
class View:
    """right, up, near: unit vectors of the picture; scale [pt/m]."""
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
        """On paper [.. x 2], in pt."""
        return self.scale * np.stack([points @ self.right, points @ self.up], axis=-1)

    def depth(self, points):
        return points @ self.near


def from_angles(azimuth, elevation):
    a, e = math.radians(azimuth), math.radians(elevation)
    return View(np.array([-math.sin(a), math.cos(a), 0]),
                np.array([-math.sin(e) * math.cos(a), -math.sin(e) * math.sin(a), math.cos(e)]))


X, Y, Z = np.eye(3)
FACES = (View(X, Y), View(X, Z), View(Y, Z))


def in_plane(normal, flat, shifts, turns):
    """Does all lie and move in the plane across an axis, and turn about that axis only?"""
    others = np.eye(3)[[i for i in range(3) if i != normal]]
    return bool(flat[normal] and all(abs(v[normal]) <= FLAT * np.linalg.norm(v) for v in shifts)
                and all(max(abs(others @ v)) <= FLAT * np.linalg.norm(v) for v in turns))


def openness(view, points):
    """Least distance on paper between points that are apart in space, to the size of the
    picture."""
    flat = view(points)
    apart = [(np.linalg.norm(flat[i] - flat[k]), np.linalg.norm(points[i] - points[k]))
             for i, k in itertools.combinations(range(len(points)), 2)]
    size = np.linalg.norm(np.ptp(points, axis=0))
    return min((d for d, space in apart if space > 1e-3 * size), default=0) / size


def choose(points, shifts, turns, solid):
    """points [n x 3] to be seen; shifts, turns: directions of loads and motions; solid: sections
    have a shape."""
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
        return from_angles(-35 if extent.argmax() == 1 else -58, 20)
    few = points[::math.ceil(len(points) / MOST_POINTS)]
    views = [from_angles(a, e) for a in AZIMUTHS for e in ELEVATIONS]
    return max(views, key=lambda v: openness(v, few))


def scaled(view, points):
    """The same view, as large as there is room for these points [n x 3]."""
    width, height = np.maximum(np.ptp(View(view.right, view.up)(points), axis=0), 1e-300)
    return View(view.right, view.up, min(WIDTH / width, HEIGHT / height))
