"""Writes a drawing directly as SVG. A Sheet has the methods of matplotlib's axes that canvas.py calls; it takes a fraction
of the time."""
import numpy as np
from markupsafe import escape

from reports.figures import svg
from reports.figures.svg import FONT, Image, number

BASELINE = 0.36  # height of the middle of a letter above its baseline, relative to the font size
WIDE = 0.58  # width of a letter, relative to the font size


class Drawn:
    """Replacement for the objects that matplotlib returns for a line or an area. It ignores identifiers, which only
    figures of papers need."""

    def set_gid(self, mark):
        pass


class Sheet:
    """Writer of one drawing. `low` and `high` are the corners of the drawing [pt], with y upwards."""

    def __init__(self, low, high):
        self.left, self.top = float(low[0]), float(high[1])
        self.width, self.height = (float(b - a) for a, b in zip(low, high))
        self.parts = []  # (zorder, tag, attributes, path or text)

    def at(self, x, y):
        return float(x) - self.left, self.top - float(y)

    def path(self, x, y, closed=False):
        points = (self.at(*p) for p in zip(np.atleast_1d(x), np.atleast_1d(y)))
        return "M" + "L".join(f"{number(a)} {number(b)}" for a, b in points) + ("z" if closed else "")

    def add(self, order, own, path):
        """Adds a path, or joins it to the last one if this has the same attributes."""
        last = self.parts[-1] if self.parts else None
        if last and own.get("fill") == "none" and last[0] == order and last[1] == own:
            self.parts[-1] = (order, own, last[2] + path)
        else:
            self.parts.append((order, own, path))

    @staticmethod
    def look(fill, stroke, width, **more):
        own = {"fill": fill} if fill == "none" else {"fill": fill, "stroke": "none"}
        if stroke != "none":
            own |= {"stroke": stroke, "stroke-width": number(width, 2)}
        for name in ("fill", "stroke"):
            svg.ink(own, name)
        if own.get("stroke") == "none":
            del own["stroke"]
        return own | more

    def plot(self, x, y, marker="", color="none", linewidth=1.2, linestyle="-", zorder=2, solid_capstyle="butt",
             markersize=0, markerfacecolor="none", markeredgecolor="none", markeredgewidth=0.9, **_):
        if marker:
            (a, b), own = self.at(x[0], y[0]), self.look(hexed(markerfacecolor), markeredgecolor, markeredgewidth)
            r = number(markersize / 2, 2)
            self.add(zorder, own, f"M{number(a - markersize / 2, 2)} {number(b, 2)}a{r} {r} 0 1 0 {number(markersize, 2)} 0"
                     f"a{r} {r} 0 1 0 -{number(markersize, 2)} 0z")
            return [Drawn()]
        more = {"stroke-linecap": "round"} if solid_capstyle == "round" and linestyle == "-" else {}
        if linestyle != "-":
            more["stroke-dasharray"] = ",".join(number(d * linewidth, 2) for d in linestyle[1])
        self.add(zorder, self.look("none", color, linewidth, **more), self.path(x, y))
        return [Drawn()]

    def fill(self, x, y, facecolor="none", edgecolor="none", linewidth=0.8, zorder=1, **_):
        own = self.look(hexed(facecolor), edgecolor, linewidth)
        self.add(zorder, own | ({"stroke-linejoin": "miter"} if "stroke" in own else {}), self.path(x, y, True))
        return [Drawn()]

    def text(self, x, y, words, color="#000000", fontsize=9, rotation=0, zorder=3, bbox=None, **_):
        a, b = self.at(x, y)
        turned = f' transform="rotate({number(-rotation, 2)} {number(a, 2)} {number(b, 2)})"' if rotation else ""
        own = self.look(color, "none", 0)
        if bbox:
            w, h = WIDE * fontsize * len(words) + 1.6, 1.16 * fontsize + 1.6
            self.parts.append((zorder, None, f'<path fill="var(--paper,#fff)"{turned} d="M{number(a - w / 2)} {number(b - h / 2)}'
                               f'h{number(w)}v{number(h)}h{number(-w)}z"/>'))
        attributes = "".join(f' {name}="{value}"' for name, value in own.items())
        self.parts.append((zorder, None, f'<text{attributes} text-anchor="middle" font-size="{number(fontsize)}" x="{number(a)}" '
                           f'y="{number(b + BASELINE * fontsize)}"{turned}>{escape(words)}</text>'))

    def faces(self, faces):
        """Adds polygons [(corners, colour, colour of the edge)] in this order. Their colours do not change in dark mode."""
        for corners, colour, edge in faces:
            self.add(2, {"fill": colour, "stroke": edge, "stroke-width": "0.4"}, self.path(*np.asarray(corners).T, True))

    def image(self, name):
        drawn = []
        for _, own, path in sorted(self.parts, key=lambda part: part[0]):
            if own is None:
                drawn.append(path)
            else:
                attributes = "".join(f' {key}="{value}"' for key, value in own.items())
                drawn.append(f'<path{attributes} d="{path}"/>')
        size = f'width="{self.width / 0.75:.0f}" height="{self.height / 0.75:.0f}"'
        return Image(f"{name}.svg", f'<svg viewBox="0 0 {number(self.width, 3)} {number(self.height, 3)}" {size} '
                     f'fill="currentColor" data-off="" stroke-linejoin="round" font-family="{FONT}">{"".join(drawn)}</svg>')


def hexed(colour):
    return "#ffffff" if colour == "white" else colour
