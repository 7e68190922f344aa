"""A drawing of shapes and labels, in points (1/72 inch). Labels avoid the shapes and each other."""
import itertools

import numpy as np
from matplotlib.collections import PolyCollection

from reports.figures.style import plt
from reports.structure_drawing.sheet import Sheet

def number(value):
    if 1e4 <= abs(value) < 1e8:
        return f"{float(f'{value:.4g}'):,.0f}".replace(",", "\u202f")
    return f"{value + 0:.4g}"


def length(value):
    return f"{number(value)} m" if abs(value) >= 0.5 or value == 0 else f"{number(1e3 * value)} mm"


def vector(values, unit):
    along = [v for v in values if v]
    said = number(abs(along[0])) if len(along) == 1 else f"({', '.join(map(number, values))})"
    return f"{said} {unit}"


# Greys and the colours of loads, motions and springs change in dark mode (svg.ink, style.MEANINGS).
INK, SOFT, LOAD, MOTION, SPRING = "#141414", "#606060", "#b03a00", "#005a94", "#6a5a00"
STEEL, BODY, ROD, MASS = "#c9d3de", "#e3dcc8", "#a89f86", "#8c8468"
FONT = 9  # [pt]
WIDE, HIGH = 0.6, 1.25  # width and height of a letter, relative to the font size
MOST_FACES = 100  # largest number of faces whose edges labels avoid
SPACING = 3  # distance of the points on a line that labels avoid [pt]
WAYS = [np.array([np.cos(a), np.sin(a)]) for a in np.arange(8) * np.pi / 4]


def boxes_overlap(a, b):
    width = min(a[2], b[2]) - max(a[0], b[0])
    height = min(a[3], b[3]) - max(a[1], b[1])
    return max(width, 0) * max(height, 0)


class Canvas:
    def __init__(self):
        self.faces, self.draws, self.points, self.labels, self.boxes = [], [], [], [], []

    def occupy(self, line):
        """Marks a polyline [n x 2] that labels must avoid."""
        line = np.atleast_2d(line)
        self.points.append(line)
        for a, b in itertools.pairwise(line):
            steps = int(np.linalg.norm(b - a) / SPACING)
            if steps > 1:
                self.points.append(a + np.linspace(0, 1, steps + 1)[:, None] * (b - a))

    def face(self, corners, depth, colour, edge=INK):
        """Adds a filled polygon. It covers polygons with a smaller `depth`."""
        self.faces.append((depth, corners, colour, edge))
        if len(self.faces) < MOST_FACES:
            self.occupy(np.vstack([corners, corners[:1]]))
        else:
            self.points.append(corners)

    def line(self, points, colour=INK, width=1.2, style="-", mark=None, above=True, clear=True):
        """Adds a polyline. `mark` is its id in the file. If `above` is True, it is in front of the members. If `clear` is
        True, labels avoid it."""
        if clear:
            self.occupy(points)
        order = 5 if above else 1

        def draw(axes):
            drawn, = axes.plot(*np.asarray(points).T, color=colour, linewidth=width,
                               linestyle=style, zorder=order, solid_capstyle="round",
                               solid_joinstyle="round", clip_on=False)
            drawn.set_gid(mark)

        self.draws.append(draw)

    def area(self, points, colour, edge=INK, width=0.8, mark=None, order=4):
        self.occupy(np.vstack([points, points[:1]]))

        def draw(axes):
            drawn, = axes.fill(*np.asarray(points).T, facecolor=colour, edgecolor=edge,
                               linewidth=width, zorder=order, clip_on=False)
            drawn.set_gid(mark)

        self.draws.append(draw)

    def dot(self, at, size, colour, edge=INK, mark=None):
        self.points.append(np.atleast_2d(at))

        def draw(axes):
            drawn, = axes.plot([at[0]], [at[1]], "o", markersize=size, markerfacecolor=colour,
                               markeredgecolor=edge, markeredgewidth=0.9, zorder=6,
                               clip_on=False)
            drawn.set_gid(mark)

        self.draws.append(draw)

    def arrow(self, points, colour, width=1.6, mark=None, head=7):
        points = np.asarray(points)
        self.occupy(points)
        tail, tip = points[-2], points[-1]
        way = (tip - tail) / max(np.linalg.norm(tip - tail), 1e-9)

        across = 0.38 * head * np.array([-way[1], way[0]])
        corners = np.array([tip, tip - head * way + across, tip - head * way - across])

        def draw(axes):
            axes.fill(*corners.T, facecolor=colour, edgecolor="none", zorder=7, clip_on=False)
            drawn, = axes.plot(*np.vstack([points[:-1], tip - 0.6 * head * way]).T, color=colour,
                               linewidth=width, zorder=7, solid_capstyle="butt", clip_on=False)
            drawn.set_gid(mark)

        self.draws.append(draw)

    def label(self, at, text, colour=INK, size=FONT, near=4, towards=None):
        """Adds a label, placed around a point where there is room. `towards` is the preferred direction."""
        self.labels.append((np.asarray(at), text, colour, size, near, towards))

    def text(self, at, text, colour=INK, size=FONT, rotation=0):
        width, height = WIDE * size * len(text), HIGH * size
        c, s = abs(np.cos(np.radians(rotation))), abs(np.sin(np.radians(rotation)))
        half = 0.5 * np.array([c * width + s * height, s * width + c * height])
        self.boxes.append((*(at - half), *(at + half)))
        self.draws.append(lambda axes: axes.text(
            *at, text, color=colour, fontsize=size, ha="center", va="center", rotation=rotation,
            rotation_mode="anchor", zorder=9,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8}))

    def extent(self):
        """Returns (lower left corner, upper right corner) of the drawing."""
        corners = [np.array([b[:2], b[2:]]) for b in self.boxes]
        all_points = np.vstack([np.vstack(self.points)] + corners)
        return all_points.min(axis=0), all_points.max(axis=0)

    def place_labels(self):
        taken = np.vstack(self.points)
        for at, text, colour, size, near, towards in self.labels:
            half = 0.5 * np.array([WIDE * size * len(text), HIGH * size])
            best = None
            for way, distance in itertools.product(WAYS, (near, near + 8, near + 18, near + 30)):
                middle = at + way * (distance + np.abs(way * half).sum())
                box = (*(middle - half), *(middle + half))
                inside = np.all((taken > middle - half) & (taken < middle + half), axis=1).sum()
                shared = sum(boxes_overlap(box, b) for b in self.boxes)
                turned = 0 if towards is None else 1 - way @ towards
                cost = 4 * inside + shared + 0.5 * distance + 2 * turned
                if best is None or cost < best[0]:
                    best = (cost, middle, box, distance)
            _, middle, box, distance = best
            self.boxes.append(box)
            if distance > near + 8:
                self.line([at, middle - (middle - at) * min(1, half.min() / distance)], SOFT, 0.5)
            self.draws.append(lambda axes, m=middle, t=text, c=colour, s=size: axes.text(
                *m, t, color=c, fontsize=s, ha="center", va="center", zorder=8))

    def corners(self, margin=6):
        """Places the labels. Returns the corners of the drawing."""
        self.place_labels()
        self.labels = []
        low, high = self.extent()
        return low - margin, high + margin

    def image(self, site, name):
        """Returns the svg.Image of the drawing for a page, and writes the figure for papers if it is requested."""
        if site.paper.wants(name):
            figure = self.finish()
            site.paper.figure(figure, name)
            plt.close(figure)
        sheet = Sheet(*self.corners())
        sheet.faces([face[1:] for face in sorted(self.faces, key=lambda f: f[0])])
        for draw in self.draws:
            draw(sheet)
        return sheet.image(name)

    def finish(self):
        low, high = self.corners()
        figure = plt.figure(figsize=(high - low) / 72)
        axes = figure.add_axes((0, 0, 1, 1))
        axes.set_axis_off()
        axes.set_xlim(low[0], high[0])
        axes.set_ylim(low[1], high[1])
        if self.faces:
            faces = sorted(self.faces, key=lambda f: f[0])
            solid = PolyCollection([f[1] for f in faces], facecolors=[f[2] for f in faces],
                                   edgecolors=[f[3] for f in faces], linewidths=0.4, zorder=2,
                                   clip_on=False)
            solid.set_gid("fixed")
            axes.add_collection(solid)
        for draw in self.draws:
            draw(axes)
        return figure
