"""Pictures of every scene, undeformed and deformed, with its sections and modes (shapes.py).

Surfaces are projected in parallel and painted from back to front."""
import functools
import html
import math

import numpy as np
from matplotlib.collections import PolyCollection

from reports.shapes import CLAMPED, bodies, distance, exaggeration, read, strips
from reports.style import plt

NAVIGATION = [("pictures.html", "pictures")]
FAR, NEARLY = 0.45, 0.9  # of the largest distance: below a half and the whole, which evenly spaced states miss by a little

MEMBER, BODY, SUPPORT, REST = np.array([0.52, 0.71, 0.87]), np.array([0.93, 0.80,
                                                                      0.62]), "#1c2430", "#8b95a3"
LIGHT = np.array([0.35, -0.55, 0.76])
MOST_STRIPS, MOST_MODES = 900, 4


class View:
    """Parallel projection, z upwards."""

    def __init__(self, azimuth=-58, elevation=24):
        a, e = math.radians(azimuth), math.radians(elevation)
        self.towards = np.array([math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e)])
        self.right = np.array([-math.sin(a), math.cos(a), 0])
        self.up = np.cross(self.towards, self.right)

    def flat(self, points):
        return np.stack([points @ self.right, points @ self.up], axis=-1)

    def depth(self, points):
        return points @ self.towards


def best_view(s, states):
    """From the side, or more from above when that shows clearly more of the displacements."""

    def seen(view):
        return max((float(np.linalg.norm(view.flat(s.position[k] - s.position[0]), axis=1).max())
                    for k in states),
                   default=0)

    side, above = View(), View(elevation=52)
    return above if seen(above) > 1.25 * seen(side) else side


def shade(polygon, colour):
    normal = np.cross(polygon[2] - polygon[0], polygon[-1] - polygon[1])
    length = np.linalg.norm(normal)
    brightness = 0.62 + 0.42 * abs(normal @ LIGHT) / (length *
                                                      np.linalg.norm(LIGHT)) if length > 0 else 1
    return np.clip(colour * brightness, 0, 1)


def supports(s):
    """Nodes that stay in place: held ones that are no bodies, what is attached to a clamped body, hinges."""
    owner = {int(b) for b in s.body}
    return [
        i for i, (b, held) in enumerate(zip(s.body, s.held))
        if (b >= 0 and s.held[b] == CLAMPED) or (b < 0 and held and
                                                 (i not in owner or held != CLAMPED))
    ]


def hinges(s):
    """Points at ends that are released."""
    ends = np.column_stack([s.first[:-1], s.first[1:] - 1])
    return ends[s.released != 0]


def paint(axes, view, s, state, scale):
    """One state over the pale undeformed one."""
    every = max(1, math.ceil(len(s.position[0]) / MOST_STRIPS))
    if state > 0:
        rest = view.flat(strips(s, 0, 1, every))
        axes.add_collection(
            PolyCollection(rest,
                           facecolors="#e9ecf0",
                           edgecolors="#dde1e7",
                           linewidths=0.3,
                           zorder=0))
    polygons = [(p, shade(p, MEMBER), 0.95) for p in strips(s, state, scale, every)]
    polygons += [(f, shade(f, BODY) if len(f) > 2 else 0.8 * BODY, 0.3)
                 for f in bodies(s, state, scale)]
    polygons.sort(key=lambda item: view.depth(item[0]).mean())
    edge = [(*(0.88 * c), 0.9) if alpha > 0.5 else (*c, 1) if len(p) == 2 else (*c, 0.3)
            for p, c, alpha in polygons]
    drawn = PolyCollection([view.flat(p) for p, _, _ in polygons],
                           facecolors=[(*c, alpha) for _, c, alpha in polygons],
                           edgecolors=edge,
                           linewidths=[3.5 if len(p) == 2 else 0.35 for p, _, _ in polygons],
                           capstyle="round",
                           zorder=1)
    axes.add_collection(drawn)
    nodes = s.nodes[0] + scale * (s.nodes[state] - s.nodes[0])
    at = supports(s)
    spots = view.flat(nodes[at]) if at else np.empty((0, 2))
    axes.plot(spots[:, 0], spots[:, 1], "s", color=SUPPORT, markersize=3, zorder=2)
    joints = view.flat(s.position[0][hinges(s)] + scale *
                       (s.position[state] - s.position[0])[hinges(s)])
    axes.plot(joints[:, 0],
              joints[:, 1],
              "o",
              color=SUPPORT,
              markerfacecolor="white",
              markersize=4,
              zorder=3)


def frame(axes, view, s, states):
    """Limits that hold all drawn states, with a bar of a round length."""
    everything = np.concatenate([view.flat(strips(s, k, e, 1)).reshape(-1, 2) for k, e in states] +
                                [view.flat(s.nodes[k]) for k, e in states if e == 1])
    low, high = everything.min(axis=0), everything.max(axis=0)
    margin = 0.04 * (high - low).max()
    length = 10 ** math.floor(math.log10(0.5 * max(high[0] - low[0], 1e-9)))
    axes.set_xlim(low[0] - margin, high[0] + margin)
    axes.set_ylim(low[1] - 3 * margin, high[1] + margin)
    axes.plot([low[0], low[0] + length], [low[1] - 2 * margin] * 2, color="#1c2430", linewidth=1.5)
    axes.text(low[0] + 1.1 * length,
              low[1] - 2 * margin,
              f"{length:g} m" if length >= 1 else f"{1e3 * length:g} mm",
              va="center",
              fontsize=8)
    axes.set_aspect("equal")
    axes.axis("off")


def title_of(s, state, scale):
    value = f"{s.value[state]:.4g}"
    words = {
        "undeformed": "undeformed", "path": f"at path parameter {value}",
        "linear": "linear solution", "buckling": f"buckling at load factor {value}",
        "mode": f"{value} Hz"
    }[s.kind[state]]
    return words + (f", displacements × {scale:g}" if scale != 1 else "")


def chosen(s):
    """States worth a picture: of a path the first that has moved far and the last that is farthest from it, a linear solution, the first modes."""
    path = [k for k, kind in enumerate(s.kind) if kind == "path"]
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


def draw_states(site, case, s):
    states = [(k, exaggeration(s, k)) for k in chosen(s)]
    view = best_view(s, [k for k, _ in states])
    flat = view.flat(s.position[0])
    tall = np.ptp(flat[:, 1]) > 0.35 * np.ptp(flat[:, 0])
    columns = min(len(states), 3)
    rows = math.ceil(len(states) / columns)
    figure, grid = plt.subplots(rows,
                                columns,
                                figsize=(4.4 * columns, (3.9 if tall else 2.2) * rows),
                                squeeze=False)
    for axes, (state, scale) in zip(grid.flat, states):
        paint(axes, view, s, state, scale)
        frame(axes, view, s, [(0, 1), (state, scale)])
        axes.set_title(title_of(s, state, scale), fontsize=9)
    for axes in grid.flat[len(states):]:
        axes.axis("off")
    figure.tight_layout()
    return site.keep(site.image(figure, f"picture_{case.name}"))


def draw_sections(site, case, s):
    count = len(s.sections)
    figure, grid = plt.subplots(1, count, figsize=(2.6 * count, 2.2), squeeze=False)
    for axes, walls, equivalent in zip(grid[0], s.sections, s.equivalent):
        millimetres = 1e3 * walls
        axes.add_collection(
            PolyCollection(millimetres[:, :, ::-1],
                           facecolors=[(*MEMBER, 1)],
                           edgecolors=[(*(0.5 * MEMBER), 1)],
                           linewidths=0.6))
        span = np.abs(millimetres).max()
        axes.plot([0], [0], "+", color="#1c2430", markersize=7)
        axes.set_xlim(-1.15 * span, 1.15 * span)
        low, high = millimetres[:, :, 0].min(), millimetres[:, :, 0].max()
        pad = max(0.15 * span, 0.1 * (high - low))
        axes.set_ylim(low - pad, high + pad)
        axes.set_aspect("equal")
        axes.set_xlabel("z [mm]", fontsize=8)
        axes.set_ylabel("y [mm]", fontsize=8)
        axes.tick_params(labelsize=7)
        axes.grid(False)
        if equivalent:
            axes.set_title("only its constants are given", fontsize=7)
    figure.tight_layout()
    return site.keep(site.image(figure, f"section_{case.name}"))


def write_case(site, case):
    s = read(site, case)
    if s is not None:
        draw_states(site, case, s)
        draw_sections(site, case, s)


def caption(s):
    return (
        f"Computed with {html.escape(s.formulation)}, n = {s.n}; between the nodes a cubic through their axes. Grey: undeformed; sand: rigid bodies; black: held; circles: released ends. "
        "Modes: largest displacement a tenth of the size, or largest turn half a radian.")


def markup(case, s):
    name = html.escape(case.name)
    return (
        f'<figure><img src="picture_{name}.svg" alt="{name}, undeformed and deformed"><figcaption>{caption(s)}</figcaption></figure>'
        f'<figure><img src="section_{name}.svg" alt="section of {name}"><figcaption>Section in its principal axes; the cross is its centroid.</figcaption></figure>'
    )


def section(site, case):
    s = read(site, case)
    return [("The scene", markup(case, s))] if s is not None else []


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
