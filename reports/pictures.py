"""Pictures of every scene, undeformed and deformed, and of its modes (shapes.py). Each has a still picture and a model
that can be rotated.

Surfaces are projected in parallel and painted from back to front."""
import functools
import html
import math
import os

import numpy as np

from reports import shapes
from reports.shapes import CLAMPED, FRAME, bodies, distance, exaggeration, read, size_of, strips

NAVIGATION = [("pictures.html", "pictures")]
FLAT = 0.02  # ratio of extent to size below which a structure is treated as plane
FAR, NEARLY = 0.45, 0.9  # fractions of the largest distance from a state (see chosen)

MEMBER, BODY, SUPPORT = np.array([0.52, 0.71, 0.87]), np.array([0.93, 0.80, 0.62]), "#1c2430"
LIGHT = np.array([0.35, -0.55, 0.76])
MOST_STRIPS, MOST_MODES = 500, 4


class View:
    """A parallel projection with z upwards."""

    def __init__(self, azimuth=-58, elevation=24):
        self.angles = (azimuth, elevation)
        a, e = math.radians(azimuth), math.radians(elevation)
        self.towards = np.array([math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e)])
        self.right = np.array([-math.sin(a), math.cos(a), 0])
        self.up = np.cross(self.towards, self.right)

    def flat(self, points):
        return np.stack([points @ self.right, points @ self.up], axis=-1)

    def depth(self, points):
        return points @ self.towards


def best_view(s, states):
    """Returns the view from the side, or from higher up if displacements are then much more visible."""

    def seen(view):
        return max((float(np.linalg.norm(view.flat(s.position[k] - s.position[0]), axis=1).max())
                    for k in states),
                   default=0)

    moved = np.abs(s.position - s.position[0]).max(axis=(0, 1))
    if any(s.kind[k] == FRAME for k in states) and moved[2] < moved[:2].max() and \
            np.ptp(s.position[..., 2]) < FLAT * size_of(s):
        return View(-90, 74)  # motion in the xy plane, seen from above with x to the right
    side, above = View(), View(elevation=52)
    return above if seen(above) > 1.25 * seen(side) else side


def shade(polygon, colour):
    normal = np.cross(polygon[2] - polygon[0], polygon[-1] - polygon[1])
    length = np.linalg.norm(normal)
    brightness = 0.62 + 0.42 * abs(normal @ LIGHT) / (length *
                                                      np.linalg.norm(LIGHT)) if length > 0 else 1
    return np.clip(colour * brightness, 0, 1)


def supports(s):
    """Returns the nodes with a support: nodes attached to a clamped main node of a body, held nodes that are not main
    nodes, and main nodes that are partly held (hinges)."""
    owner = {int(b) for b in s.body}
    return [
        i for i, (b, held) in enumerate(zip(s.body, s.held))
        if (b >= 0 and s.held[b] == CLAMPED) or (b < 0 and held and
                                                 (i not in owner or held != CLAMPED))
    ]


def hinges(s):
    ends = np.column_stack([s.first[:-1], s.first[1:] - 1])
    return ends[s.released != 0]


def drawn_polygons(s, state, scale):
    """Returns two lists of (corners, colour): the undeformed state behind the drawn state, with colour None, and the
    drawn state. The first is empty if the drawn state is the undeformed one."""
    every = max(1, math.ceil(len(s.position[0]) / MOST_STRIPS))
    rest = [(p, None) for p in strips(s, 0, 1, every)] if state else []
    here = [(p, shade(p, MEMBER)) for p in strips(s, state, scale, every)]
    here += [(f, shade(f, BODY) if len(f) > 2 else 0.8 * BODY) for f in bodies(s, state, scale)]
    return rest, here


class Sheet:
    def __init__(self, view, points, width=560, most=380):
        flat = view.flat(points)
        low, high = flat.min(axis=0), flat.max(axis=0)
        span = np.maximum(high - low, 1e-12)
        self.scale = min((width - 20) / span[0], (most - 40) / span[1])
        self.width, self.height = width, max(60, round(span[1] * self.scale) + 40)
        self.view, self.low = view, low - [(width / self.scale - span[0]) / 2, 30 / self.scale]

    def at(self, points):
        """Returns positions on the sheet in pixels, rounded to a tenth."""
        x, y = ((self.view.flat(np.asarray(points)) - self.low) * self.scale).T
        return [f"{a:.1f} {self.height - b:.1f}" for a, b in zip(x, y)]

    def polygon(self, corners):
        return "M" + "L".join(self.at(corners)) + ("z" if len(corners) > 2 else "")

    def bar(self):
        length = 10 ** math.floor(math.log10(0.4 * self.width / self.scale))
        words = f"{length:g} m" if length >= 1 else f"{1e3 * length:g} mm"
        x, y = 10 + length * self.scale, self.height - 10
        return (f'<path stroke="#5b6675" stroke-width="1.5" d="M10 {y}H{x:.1f}"/>'
                f'<text x="{x + 6:.1f}" y="{y + 4}" font-size="11" fill="#5b6675">{words}</text>')


def still(s, state):
    """Returns one state, drawn over the pale undeformed state, in SVG. The picture is shown if the model cannot be
    rotated."""
    scale = 1 if s.kind[state] == FRAME else exaggeration(s, state)
    view = best_view(s, [state])
    rest, here = drawn_polygons(s, state, scale)
    nodes = s.nodes[0] + scale * (s.nodes[state] - s.nodes[0])
    sheet = Sheet(view, np.concatenate([p for p, _ in rest + here] + [nodes]))
    behind = "".join(sheet.polygon(p) for p, _ in rest)
    out = [f'<path fill="#e9ecf0" stroke="#dde1e7" stroke-width=".4" d="{behind}"/>']
    for p, colour in sorted(here, key=lambda item: view.depth(item[0]).mean()):
        edge, width = (0.88 * colour, 0.5) if len(p) > 2 else (colour, 3.5)
        out.append(f'<path fill="{hexadecimal(colour)}" stroke="{hexadecimal(edge)}" '
                   f'stroke-width="{width}" d="{sheet.polygon(p)}"/>')
    out += [f'<path stroke="{SUPPORT}" stroke-width="5" d="M{p}h.1"/>'
            for p in sheet.at(nodes[supports(s)])]
    joints = (s.position[0] + scale * (s.position[state] - s.position[0]))[hinges(s)]
    for p in sheet.at(joints) if len(joints) else []:
        x, y = p.split()
        out.append(f'<circle cx="{x}" cy="{y}" r="2.5" fill="#fff" stroke="{SUPPORT}"/>')
    size = f'width="{sheet.width}" height="{sheet.height}"'
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {sheet.width} {sheet.height}" '
            f'{size} font-family="sans-serif" stroke-linejoin="round" stroke-linecap="square">'
            f'{"".join(out)}{sheet.bar()}</svg>')


def hexadecimal(colour):
    return "#" + "".join(f"{round(255 * min(1, c)):02x}" for c in colour)


def title_of(s, state, scale):
    value = f"{s.value[state]:.4g}"
    acting = ", " + s.acting[state] if s.kind[state] == "linear" and s.acting[state] else ""
    words = {
        "undeformed": "undeformed", "path": f"at path parameter {value}",
        "linear": f"linear solution{acting}", "buckling": f"buckling at load factor {value}",
        "mode": f"{value} Hz", FRAME: f"t = {value} s"
    }[s.kind[state]]
    return words + (f", displacements × {scale:g}" if scale != 1 else "")


def chosen(s):
    """Returns the states that can be selected: the undeformed state, two states of a path or motion, and up to
    MOST_MODES of each kind of mode and of linear solutions. The first of the two states is the earliest whose distance
    from the start is at least FAR times the largest. The second is the latest whose distance from the first is at least
    NEARLY times the largest."""
    path = [k for k, kind in enumerate(s.kind) if kind in ("path", FRAME)]
    out = [0]
    if path:
        moved = [distance(s, k, 0) for k in path]
        first = next(k for k, d in zip(path, moved) if d >= FAR * max(moved))
        apart = [distance(s, k, first) for k in path]
        out += sorted({first,
                       max(k for k, d in zip(path, apart)
                           if d >= NEARLY * max(apart))}) if first != path[-1] else [first]
    for kind in ("linear", "buckling", "mode"):
        out += [k for k, each in enumerate(s.kind) if each == kind][:MOST_MODES]
    return out


def draw(site, case, s):
    worth = chosen(s)
    first = worth[min(1, len(worth) - 1)]
    start = max((k for k in worth if s.kind[k] in ("path", FRAME)), default=first)
    with open(os.path.join(site.folder, f"picture_{case.name}.svg"), "w", encoding="utf-8") as out:
        out.write(still(s, start))
    view = best_view(s, [start])
    found = shapes.shape(s, title_of, supports(s), hinges(s), start, view.angles)
    shapes.store(site, case.name, found)


def write_case(site, case):
    s = read(site, case)
    if s is not None:
        draw(site, case, s)


def caption(s):
    return (
        f"Computed with {html.escape(s.formulation)}, n = {s.n}; between the nodes a cubic through "
        "their axes. Pale: undeformed; sand: rigid bodies; squares: held; circles: released ends. "
        + ("Play, or drag the slider, to see it move, at true scale." if s.kind.count(FRAME) > 1 else
           "Modes: largest displacement a tenth of the size, or largest turn half a radian."))


def markup(case, s):
    name = html.escape(case.name)
    image = f'<img src="picture_{name}.svg" alt="{name}, undeformed and deformed" loading="lazy">'
    place = shapes.markup(case.name, image, f"{case.name} in space")
    return f"<figure>{place}<figcaption>{caption(s)}</figcaption></figure>"


def section(site, case):
    s = read(site, case)
    return [("In space", markup(case, s))] if s is not None else []


def present(site):
    return any(read(site, case) is not None for case in site.cases)


def write(site):
    found = [(case, read(site, case)) for case in site.cases]
    site.write("pictures.html",
               "pictures.html",
               pictures=[(case, markup(case, s)) for case, s in found if s is not None])


def tasks(site):
    return [functools.partial(write, site)
            ] + [functools.partial(write_case, site, case) for case in site.cases]
