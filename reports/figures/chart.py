"""Charts of curves in panels, written directly in SVG. They are drawn much faster than charts of matplotlib.

A chart has panels in rows. A panel contains curves with markers, levels, labels and shaded areas, in data coordinates.
Sizes in the picture are in pixels. The attributes of a curve (colour, marker, line, formulation) are those that
style.Styles.of and Site.points return."""
import functools
import math
import zlib

import numpy as np
from markupsafe import escape
from matplotlib.markers import MarkerStyle

from reports.figures import style
from reports.figures.svg import FONT, Image, MARKERS, number, said_of

SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def power(decade):
    return f"10{str(decade).translate(SUPERSCRIPTS)}" if decade not in (0, 1) else str(10**decade)


def whole_ticks(low, high):
    decades = math.log10(high / low)
    if decades < 0.7:
        step = max(1, round((high - low) / 4))
        return [n for n in range(math.ceil(low), math.floor(high) + 1) if n % step == 0] or [low]
    steps = (1, 2, 4) if decades < 1.2 else (1, 2, 5) if decades < 2.2 else (1,)
    return [s * 10**e for e in range(-3, 10) for s in steps if low <= s * 10**e <= high]


def log_ticks(low, high):
    """Returns [(value, label)]: at most six powers of ten, or 1, 2 and 5 times powers of ten if at most one power of
    ten is in the range."""
    first, last = math.ceil(math.log10(low) - 1e-9), math.floor(math.log10(high) + 1e-9)
    every = max(1, math.ceil((last - first + 1) / 6))
    if last > first:
        return [(10.0**e, power(e)) for e in range(first, last + 1) if (e - last) % every == 0]
    return [(s * 10.0**e, f"{s * 10.0**e:g}") for e in range(first - 2, last + 1) for s in (1, 2, 5)
            if low <= s * 10.0**e <= high]


def linear_ticks(low, high):
    step = 10.0**math.floor(math.log10((high - low) / 4))
    step *= next(f for f in (1, 2, 5, 10) if (high - low) / (f * step) <= 6)
    digits = max(0, -math.floor(math.log10(step) + 1e-9))
    return [(i * step, f"{i * step:.{digits}f}" if 1e-4 < step < 1e5 else f"{i * step:g}")
            for i in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]


class Axis:
    """An axis of a panel. If `log` is True, the axis is logarithmic. If `whole` is also True, its ticks are whole
    numbers."""

    def __init__(self, log, whole=False):
        self.log, self.whole, self.low, self.high = log, whole, math.inf, -math.inf

    def take(self, values):
        values = [v for v in values if math.isfinite(v) and (v > 0 or not self.log)]
        self.low, self.high = min([self.low, *values]), max([self.high, *values])

    def settle(self):
        if not self.high >= self.low:
            self.low, self.high = 1, 10
        if self.log:
            margin = (self.high / self.low)**0.05 if self.high > self.low else 3
            self.low, self.high = self.low / margin, self.high * margin
        else:
            margin = 0.05 * (self.high - self.low) or abs(self.low) or 1
            self.low, self.high = self.low - margin, self.high + margin

    def part(self, values):
        """Returns the positions of values along the axis, from 0 to 1."""
        values = np.asarray(values, float)
        if self.log:
            return np.log(values / self.low) / math.log(self.high / self.low)
        return (values - self.low) / (self.high - self.low)

    def ticks(self):
        if not self.log:
            return linear_ticks(self.low, self.high)
        if self.whole:
            return [(t, f"{t:g}") for t in whole_ticks(self.low, self.high)]
        return log_ticks(self.low, self.high)


INK = "currentColor"
DASHES = {"-": "", "--": "4.4 1.9", ":": "1.2 2", "-.": "7.7 1.9 1.2 1.9", "none": "none"}
WIDTH = 1.5  # default line width of a curve
LETTER = 6.7  # mean width of a letter at a font size of 11 pixels [pixels]


@functools.lru_cache(None)
def marker_path(marker, size):
    form = MarkerStyle(marker)
    path = form.get_path().transformed(form.get_transform().scale(size))
    lines = path.to_polygons(closed_only=False)
    end = "Z" if form.is_filled() else ""
    return "".join("M" + "L".join(f"{number(x, 2)} {number(-y, 2)}" for x, y in c) + end
                   for c in lines)


def form(marker, size):
    """Returns the name and the shape attributes of a marker's SVG element, without brackets, fill and stroke."""
    if marker == "o":
        return f'circle r="{number(0.5 * size, 2)}"'
    return f'path d="{marker_path(marker, size)}"'


def dashes(line):
    return DASHES[line] if isinstance(line, str) else " ".join(number(1.2 * x) for x in line[1])


def colour(given):
    return style.VARIABLES.get(given, given)


class Panel:
    """A pair of axes with curves. y may be the axis of another panel."""

    def __init__(self, title, xlabel, ylabel, x, y):
        self.title, self.xlabel, self.ylabel = title, xlabel, ylabel
        self.x, self.y = x, y
        self.curves, self.back, self.words, self.lows = [], [], [], []

    def plot(self, x, y, back=False, **look):
        """Adds a curve to the panel. `look` may contain color, marker, linestyle, gid, label, markersize, linewidth,
        alpha, hollow and marks. `marks` are the indices of the points with markers (default: all). If `back` is True,
        the curve is drawn behind all others, without a label."""
        self.x.take(x)
        self.y.take(y)
        (self.back if back else self.curves).append((x, y, look))

    def level(self, y, words=""):
        self.y.take([y])
        self.lows.append((y, words))

    def ground(self, y):
        self.below = y

    below = None

    def edge(self, x):
        """Draws a vertical line at x, behind all curves."""
        self.edges = [*self.edges, x]

    edges = ()

    def note(self, x, y, words):
        self.words.append((x, y, words))

    def cross(self, x, color, gid):
        self.x.take([x])
        self.crosses.append((x, color, gid))

    @functools.cached_property
    def crosses(self):
        return []


class Chart:
    """A chart. `columns` is the number of panels in a row. `size` is the size of the axes of a panel in pixels. `apart`
    is True if the panels of a row show different curves, so that each needs a legend below it."""

    def __init__(self, columns, size, gap=(62, 52), apart=False):
        self.columns, self.size, self.gap, self.apart = columns, size, gap, apart
        self.panels, self.names = [], {}

    def panel(self, title="", xlabel="", ylabel="", xlog=True, ylog=True, whole=False, like=None):
        """Adds a panel and returns it. `like` is a panel whose vertical axis the new panel shares."""
        y = like.y if like else Axis(ylog)
        self.panels.append(Panel(title, xlabel, ylabel, Axis(xlog, whole), y))
        self.panels[-1].shares = like is not None
        return self.panels[-1]

    def image(self, site, name):
        """Returns the Image of the chart for the page."""
        image = Writer(self, site, name).image()
        site.paper.chart(self, name)
        return image


class Writer:
    def __init__(self, chart, site, name):
        self.chart, self.name, self.said, self.told = chart, name, site.said, {}
        self.keys, self.labels = {}, {}

    @staticmethod
    def marker(look):
        size, hollow = look.get("markersize", 4.5) / 0.75, look.get("hollow", False)
        marker, ink = look["marker"], colour(look["color"])
        filled = MarkerStyle(marker).is_filled() and not hollow
        drawn = (f'markerUnits="userSpaceOnUse" overflow="visible"><{form(marker, size)} '
                 f'fill="{ink if filled else "var(--paper,#fff)"}" stroke="{ink}" '
                 f'stroke-width="{1 if filled else 1.2}"/></marker>')
        name = f"k{zlib.crc32(drawn.encode()):x}"
        MARKERS[name] = f'<marker id="{name}" {drawn}'
        return name

    def whose(self, gid):
        if not (gid or "").startswith("f|"):
            return ""
        _, key, *points = gid.split("|")
        self.keys[key] = None
        index = f' data-p="{self.told.setdefault(points[0], len(self.told))}"' if points else ""
        return f' data-f="{escape(key)}"{index}'

    def line(self, points, look):
        drawn = " ".join(f"{number(x)},{number(y)}" for x, y in points)
        dash = dashes(look.get("linestyle", "-"))
        stroke = colour(look["color"]) if dash != "none" else "none"
        attributes = f' stroke-dasharray="{dash}"' if dash and dash != "none" else ""
        if look.get("alpha"):
            attributes += f' stroke-opacity="{look["alpha"]}"'
        if look.get("linewidth", WIDTH) != WIDTH and stroke != "none":
            attributes += f' stroke-width="{look["linewidth"]}"'
        marks, every = "", look.get("marks")
        if look.get("marker") and (every is None or list(every) == list(range(len(points)))):
            name = self.marker(look)
            marks = f' style="marker{look.get("where", "")}:url(#{name})"'
        elif look.get("marker"):
            name = self.marker(look)
            at = " ".join(f"{number(points[i][0])},{number(points[i][1])}" for i in every)
            marks = f'/><polyline stroke="none" points="{at}" style="marker:url(#{name})"'
        whose = self.whose(look.get("gid"))
        line = f'<polyline points="{drawn}" stroke="{stroke}"{attributes}{marks}/>'
        return f"<g{whose}>{line}</g>" if whose else line

    def lines(self, curves):
        drawn = "".join(self.line(*curve) for curve in curves)
        return f'<g fill="none">{drawn}</g>' if drawn else ""

    def panel(self, panel, left, top):
        width, height = self.chart.size

        def across(values):
            return left + width * panel.x.part(values)

        def up(values):
            return top + height * (1 - panel.y.part(values))

        def points(x, y):
            return list(zip(across(x), up(y)))

        bottom, right = top + height, left + width
        out = []
        if panel.below and panel.below > panel.y.low:
            y = max(top, float(up(panel.below)))
            out.append(f'<path fill="{INK}" fill-opacity=".07" d="M{left} {number(y)}H{right}'
                       f'V{bottom}H{left}z"/>')
        xs = [(float(across(t)), words) for t, words in panel.x.ticks()]
        ys = [(float(up(t)), words) for t, words in panel.y.ticks()]
        grid = "".join(f"M{number(x)} {top}V{bottom}" for x, _ in xs) + "".join(
            f"M{left} {number(y)}H{right}" for y, _ in ys)
        edge = f"M{left} {top}V{bottom}H{right}" + "".join(
            f"M{number(x)} {bottom}v4" for x, _ in xs) + "".join(
                f"M{left} {number(y)}h-4" for y, _ in ys)
        out.append(f'<path stroke="{INK}" stroke-opacity=".12" stroke-width=".6" d="{grid}"/>')
        for x in panel.edges:
            out.append(f'<path stroke="{INK}" stroke-opacity=".35" stroke-dasharray="2 2" '
                       f'd="M{number(float(across(x)))} {top}V{bottom}"/>')
        out.append(self.lines((points(x, y), look) for x, y, look in panel.back))
        for y, words in panel.lows:
            at = number(float(up(y)))
            out.append(f'<path stroke="{INK}" stroke-width="1" stroke-opacity=".55" '
                       f'stroke-dasharray="2 2" d="M{left} {at}H{right}"/>')
            if words:
                out.append(self.text(right, float(up(y)) - 3, words, "end", 10))
        out += [self.text(float(across(x)), float(up(y)), words, "end", 10)
                for x, y, words in panel.words]
        cross = {"marker": "x", "markersize": 6, "linestyle": "none"}
        out.append(self.lines([(points(x, y), look) for x, y, look in panel.curves] + [
            ([(float(across(x)), top)], {**cross, "color": ink, "gid": gid})
            for x, ink, gid in panel.crosses]))
        out.append(f'<path fill="none" stroke="{INK}" stroke-width="1" d="{edge}"/>')
        out.append(f'<g text-anchor="middle" transform="translate(0 {number(bottom + 17)})">' +
                   "".join(f'<text x="{number(x)}">{words}</text>' for x, words in xs) + "</g>")
        if not panel.shares:
            out.append(f'<g text-anchor="end" transform="translate({number(left - 7)} 4)">' +
                       "".join(f'<text y="{number(y)}">{words}</text>' for y, words in ys) + "</g>")
        out += [self.text(left + width / 2, bottom + 34, panel.xlabel, "middle", 11.5)]
        out += [self.text(left + width / 2, top - 7, panel.title, "middle", 12)]
        if panel.ylabel:
            x, y = number(left - 46), number(top + height / 2)
            out.append(f'<text transform="translate({x} {y}) rotate(-90)" text-anchor="middle" '
                       f'font-size="11.5">{escape(panel.ylabel)}</text>')
        for _, _, look in panel.curves:
            if look.get("label"):
                self.labels.setdefault(look["label"], look)
        return "".join(out)

    @staticmethod
    def text(x, y, words, anchor="start", size=11):
        if not words:
            return ""
        more = (f' text-anchor="{anchor}"' if anchor != "start" else "") + (
            f' font-size="{size}"' if size != 11 else "")
        return f'<text x="{number(x)}" y="{number(y)}"{more}>{escape(words)}</text>'

    def entry(self, words, wide, x, y):
        look = self.labels[words]
        of = (look.get("gid") or "").split("|")
        whose = f' data-l="{escape(of[1])}"' if of[0] == "f" else ""
        bare = {**look, "gid": None, "marks": None, "where": "-mid"}
        drawn = self.line([(0, 0), (13, 0), (26, 0)], bare)
        return (f'<g{whose} transform="translate({number(x)} {number(y)})"><g fill="none">'
                f'<path d="M0-8h{number(wide - 8)}v16H0z"/>{drawn}</g>'
                f"{self.text(33, 4, words)}</g>")

    def legend(self, top, left, step, width):
        """Returns (SVG, height) of the entries in columns below the panels."""
        words = list(self.labels)
        wide = 44 + LETTER * max((len(one) for one in words), default=0)
        if self.chart.apart:
            columns = [[curve[2]["label"] for curve in panel.curves] for panel in self.chart.panels]
            begin = [left + step * i for i in range(len(columns))]
        else:
            count = max(1, min(len(words), int((width - 20) // wide)))
            rows = math.ceil(len(words) / count)
            columns = [words[rows * i:rows * (i + 1)] for i in range(count)]
            begin = [20 + wide * i for i in range(count)]
        out = "".join(self.entry(one, wide, x, top + 17 * i) for x, column in zip(begin, columns)
                      for i, one in enumerate(column))
        return out, 17 * max((len(column) for column in columns), default=0)

    def image(self):
        chart = self.chart
        for axis in {id(a): a for p in chart.panels for a in (p.x, p.y)}.values():
            axis.settle()
        shared = any(p.shares for p in chart.panels)
        columns = min(chart.columns, len(chart.panels))
        step = (chart.size[0] + (14 if shared else chart.gap[0]), chart.size[1] + chart.gap[1])
        left, top = 62, 24 if any(p.title for p in chart.panels) else 10
        rows = math.ceil(len(chart.panels) / columns)
        out = "".join(
            self.panel(p, left + step[0] * (i % columns), top + step[1] * (i // columns))
            for i, p in enumerate(chart.panels))
        width = left + step[0] * (columns - 1) + chart.size[0] + 14
        height = top + step[1] * (rows - 1) + chart.size[1] + 40
        entries, more = self.legend(height + 14, left, step[0], width)
        height += more + 16
        off = escape(" ".join(style.extra(key for key in self.keys if " " not in key)))  # not other programs
        markup = (f'<svg viewBox="0 0 {number(width)} {number(height)}" width="{width:.0f}" '
                  f'height="{height:.0f}" fill="{INK}" data-off="{off}" font-family="{FONT}" '
                  f'font-size="11" stroke-width="{WIDTH}" stroke-linejoin="round">'
                  f"{out}{entries}</svg>")
        told = [self.said[int(index)] for index in self.told]
        self.said.clear()
        return Image(f"{self.name}.svg", markup, said_of(told))
