"""Maps of a sweep in separate SVG images, with a field for each cell of two axes. Colour and sign of a field show its
state. Equal adjacent fields in a row are joined, which keeps files small. assets/sweep.js draws the same maps over
other axes and must be changed together with this module."""
import numpy as np
from markupsafe import escape
from matplotlib import colormaps
from matplotlib.colors import to_hex

from reports.figures import style
from reports.figures.chart import linear_ticks, log_ticks
from reports.figures.svg import FONT, Image, number

EMPTY, UNKNOWN = -2, -1  # states of fields without a point, and without a reference value
LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
WIDE, LEAST_FIELD, MOST_FIELD = 230, 11.5, 40  # width of a map, smallest and largest size of a field, in pixels
LEFT, TOP, BELOW, RIGHT = 52, 36, 38, 12
LETTER = 5.6  # mean width in pixels of a letter at a font size of 9 pixels
DOT = 6  # radius of a point in pixels


def luminance(colour):
    return sum(w * int(colour[i:i + 2], 16) for i, w in ((1, .299), (3, .587), (5, .114)))


def ink(fill):
    """Returns a text colour that is legible on the fill."""
    if not fill.startswith("#"):
        return "currentColor"
    return "#111418" if luminance(fill) > 130 else "#ffffff"


def steps(count):
    at = np.linspace(0.95, 0.25, count) if count > 1 else [0.8]
    return [to_hex(colormaps["viridis"](x)) for x in at]


class Look:
    """Colour, sign and label of every state: first the meshes, then the states without a mesh within the tolerance."""

    def __init__(self, meshes):
        count = len(meshes)
        self.none, self.some, self.failed = count, count + 1, count + 2
        self.fill = dict(enumerate(steps(count))) | {
            self.none: "url(#sweep-none)", self.some: "url(#sweep-some)", self.failed: "#45342c",
            UNKNOWN: "none"}
        self.sign = {i: str(n) for i, n in enumerate(meshes)} | {
            self.none: "×", self.some: "~", self.failed: "!", UNKNOWN: "?"}
        self.words = {i: f"{n} element{'s' if n != 1 else ''}" for i, n in enumerate(meshes)} | {
            self.none: f"not with {meshes[-1]}", self.some: "at some of its points only",
            self.failed: f"no solution with {meshes[-1]}", UNKNOWN: "no reference for the error"}

    def legend(self, used):
        """Returns [(fill, ink, sign, label)] of the states that are drawn."""
        order = [*(k for k in self.fill if k >= 0), UNKNOWN]
        return [(self.fill[k], ink(self.fill[k]), self.sign[k], self.words[k]) for k in order
                if k in used]


def states(reach, points, look):
    """Returns the states of fields. `reach` [..., M + 2] contains numbers of points, sorted by the coarsest mesh such
    that it and all finer meshes are within the tolerance (gather.Gathered). `points` is the number of points in each
    field."""
    count = look.none
    total, out = reach.sum(axis=-1), reach[..., count:].sum(axis=-1)
    top = count - 1 - np.argmax(reach[..., count - 1::-1] > 0, axis=-1)
    found = np.where(out == 0, top, np.where(out == total, look.none, look.some))
    found = np.where(reach[..., count + 1] > 0, look.failed, found)
    return np.where(points == 0, EMPTY, np.where(total == 0, UNKNOWN, found))


def runs(row):
    """Returns [(first field, number of fields, state)] of the runs of equal fields in a row, except empty fields."""
    ends = np.flatnonzero(np.diff(row, prepend=row[0] - 1, append=row[-1] - 1))
    return [(int(a), int(b - a), int(row[a])) for a, b in zip(ends, ends[1:]) if row[a] != EMPTY]


def text(x, y, words, more=""):
    return f'<text x="{number(x)}" y="{number(y)}"{more}>{escape(words)}</text>'


def bounds(part):
    """Returns the values at which the parts of an axis with numbers begin and end."""
    if part.exact and len(part) > 1:
        first, last = 2 * part.cuts[0] - part.cuts[1:2], part.cuts[-2:-1]
        single = (part.low == part.high).all() and len(part) > 2
        low = float(first[0]) if single else part.low[0]
        high = float(2 * part.cuts[-1] - last[0]) if single else part.high[-1]
        return np.array([low, *part.cuts, high])
    return np.array([part.low[0], *part.cuts, part.high[-1]])


def place_of(part, values):
    return np.interp(values, bounds(part), np.arange(len(part) + 1.0))


def marks(part):
    """Returns [(position in parts, label)] of possible ticks, at fields of one value or at round numbers."""
    if part.axis.words or (part.exact and (part.low == part.high).all()):
        return [(i + 0.5, part.name(i)) for i in range(len(part))]
    low, high = part.low[0], part.high[-1]
    found = (log_ticks if part.log else linear_ticks)(low, high) if high > low else [
        (low, f"{low:.3g}")]
    return [(float(place_of(part, value)), words) for value, words in found]


def ticks(part, field, room):
    """Returns [(position in pixels, label)] along an axis with fields of this size. Ticks are at least `room` apart."""
    kept = []
    for place, words in marks(part):
        if not kept or place * field - kept[-1][0] >= room:
            kept.append((place * field, words))
    return kept


def title_of(part):
    axis = part.axis
    return axis.name + (f" [{axis.unit}]" if axis.unit not in ("", "1") else "")


class Map:
    """A map of two axes. x and y are gather.Parts, and y may also be a list of names."""

    def __init__(self, x, y, wide=WIDE):
        self.x, self.y = x, y
        names = y if isinstance(y, list) else [words for _, words in marks(y)]
        self.left = max(LEFT, 12 + 6 * max(map(len, names), default=0))
        self.field = min(MOST_FIELD, max(LEAST_FIELD, wide / len(x)))
        self.high = min(MOST_FIELD / 2 if isinstance(y, list) else MOST_FIELD,
                        max(LEAST_FIELD, wide / len(y)))
        self.size = self.field * len(x), self.high * len(y)

    def fields(self, table, fill, sign):
        """Draws the fields of each state in one path, with their signs. `table` contains the states [x, y]."""
        paths, signs = {}, {}
        for j, row in enumerate(table.T):
            y = TOP + self.size[1] - (j + 1) * self.high
            for first, length, state in runs(row):
                x, width = self.left + first * self.field, length * self.field
                paths.setdefault(state, []).append(f"M{number(x)} {number(y)}h{number(width)}"
                                                   f"v{number(self.high)}h{number(-width)}z")
                if len(sign[state]) * LETTER <= width:
                    signs.setdefault(state, []).append(text(x + width / 2, y + self.high / 2 + 3,
                                                            sign[state]))
        out = ""
        for state, drawn in sorted(paths.items(), key=lambda item: (item[0] < 0, item[0])):
            edge = ' stroke="currentColor" stroke-opacity=".35"' if fill[state] == "none" else (
                ' stroke="var(--paper,#fff)"')
            out += (f'<path fill="{fill[state]}"{edge} stroke-width=".7" d="{"".join(drawn)}"/>'
                    f'<g text-anchor="middle" font-size="9" fill="{ink(fill[state])}">'
                    f'{"".join(signs.get(state, []))}</g>')
        return out

    def dots(self, at, found, fill, sign):
        """Draws scattered points. `at` is [points, 2], and `found` are their states."""
        out = ""
        for state in np.unique(found[found != EMPTY]):
            here = at[found == state]
            xy = list(zip(self.left + self.field * place_of(self.x, here[:, 0]),
                          TOP + self.size[1] - self.high * place_of(self.y, here[:, 1])))
            circles = "".join(f'<circle cx="{number(x)}" cy="{number(y)}" r="{DOT}"/>'
                              for x, y in xy)
            words = "".join(text(x, y + 3, sign[state]) for x, y in xy)
            out += (f'<g fill="{fill[state]}" stroke="currentColor" stroke-width=".5">{circles}</g>'
                    f'<g text-anchor="middle" font-size="8" fill="{ink(fill[state])}">{words}</g>')
        return out

    def frame(self, title):
        (width, height), left = self.size, self.left
        bottom = TOP + height
        room = max(34, 1.1 * LETTER * max(len(w) for _, w in marks(self.x)))
        xs = ticks(self.x, self.field, room)
        ys = [((i + 0.5) * self.high, name) for i, name in enumerate(self.y)] if isinstance(
            self.y, list) else ticks(self.y, self.high, 14)
        dashes = "".join(f"M{number(left + x)} {number(bottom)}v4" for x, _ in xs)
        dashes += "".join(f"M{left} {number(bottom - y)}h-4" for y, _ in ys)
        out = (f'<path fill="none" stroke="currentColor" stroke-width="1" '
               f'd="M{left} {TOP}V{number(bottom)}H{number(left + width)}{dashes}"/>')
        out += '<g text-anchor="middle" font-size="10">' + "".join(
            text(left + x, bottom + 15, words) for x, words in xs) + "</g>"
        out += '<g text-anchor="end" font-size="10">' + "".join(
            text(left - 6, bottom - y + 3.5, words) for y, words in ys) + "</g>"
        out += text(left + width / 2, bottom + 31, title_of(self.x), ' text-anchor="middle"')
        if not isinstance(self.y, list):
            out += text(4, TOP - 8, title_of(self.y))
        return out + (text(4, 12, title, ' font-weight="bold"') if title else "")

    def image(self, name, drawn, title=""):
        width = max(self.left + self.size[0] + RIGHT, 7.5 * len(title) + 8)
        above = 0 if title else TOP - 6 if isinstance(self.y, list) else TOP - 22
        height = TOP + self.size[1] + BELOW - above
        return Image(f"{name}.svg",
                     f'<svg viewBox="0 {above} {number(width)} {number(height)}" '
                     f'width="{width:.0f}" '
                     f'height="{height:.0f}" fill="currentColor" font-size="11" '
                     f'font-family="{FONT}">{drawn}{self.frame(title)}</svg>')


def winners(wins, known, keys):
    """Returns (states, fill, sign) of the formulation of lowest cost in each field. The state is 2 k if formulation k is
    the cheapest at every point, and 2 k + 1 if it is the cheapest at the largest number of points but not at all. `wins`
    [..., F] are these numbers, and `known` is the number of points with a reference value."""
    count = len(keys)
    best, most = wins.argmax(axis=-1), wins.max(axis=-1)
    state = np.where(most == 0, 2 * count, 2 * best + (most < known))
    fill, sign = {2 * count: "url(#sweep-none)"}, {2 * count: "×"}
    for k, key in enumerate(keys):
        fill[2 * k] = fill[2 * k + 1] = style.look(key)[0]
        sign[2 * k], sign[2 * k + 1] = LETTERS[k % 26], LETTERS[k % 26].lower()
    return np.where(known == 0, EMPTY, state), fill, sign
