"""Main sizes of a structure and its axes."""
import itertools

import numpy as np

from reports.drawing.canvas import INK, SOFT
from reports.drawing.words import length

CLEAR = 13  # between a size and what is drawn [pt]
SMALL = 0.02  # extents below this part of the largest are not told


def edges(low, high, axis):
    """Edges of the box along an axis [4 x 2 x 3]."""
    others = [i for i in range(3) if i != axis]
    out = []
    for corner in itertools.product((0, 1), repeat=2):
        a, b = low.copy(), high.copy()
        for i, which in zip(others, corner):
            a[i] = b[i] = (low, high)[which][i]
        out.append(np.array([a, b]))
    return out


def put_size(canvas, view, low, high, axis):
    """A dimension line beyond all that is drawn, on the lower or the right side."""
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
    """x, y, z in the lower left corner; an axis that points at the reader is a dot."""
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
