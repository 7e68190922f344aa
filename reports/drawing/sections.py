"""Sections beside a drawing, to a scale of their own, with their sizes."""
import numpy as np

from reports.drawing import geometry
from reports.drawing.canvas import INK, SOFT, STEEL, Canvas
from reports.drawing.words import length

SIZE, THINNEST = 84, 1.6  # largest size on paper, least thickness [pt]
GAP = 46  # between two sections [pt]
MOST = 3


def thick(polygon, scale):
    """On paper, thin ones widened so that they can be seen."""
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
    """As it is looked at along x: y upwards, z to the right. Returns the right end."""
    polygons = geometry.outline(section)
    both = np.vstack(polygons)[:, ::-1]  # across the paper z, upwards y
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


def drawn(scene):
    """Names of the sections whose shape is known, each shape once."""
    out = {}
    for member in scene.members.values():
        for name in member.sections:
            if geometry.outline(scene.sections[name]):
                out.setdefault(str(scene.sections[name]), name)
    return list(out.values())[:MOST]


def draw(scene):
    """The figure, or None where no section has a shape."""
    names = drawn(scene)
    if not names:
        return None
    canvas, left = Canvas(), 0
    for name in names:
        left = put_section(canvas, name, scene.sections[name], left) + GAP
    return canvas.finish()
