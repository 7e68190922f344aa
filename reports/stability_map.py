"""The map of stability as SVG of its own: rows are formulations, columns extremes, each a strip of
the
values it was driven to, from left to right as in the tables."""
from markupsafe import escape

from reports.figures import FONT, Image

WIDE, TALL, HEAD, LEFT = 42, 22, 150, 190  # a field, the names on top, the names on the left
MOST = 22  # extremes beside each other


def text(x, y, words, more=""):
    start = f'<text x="{x:.1f}" y="{y:.1f}"{more and " "}{more}>'
    return f"{start}{escape(words)}</text>" if words else ""


class Fields:
    """All fields, gathered by what happened: one path and one group of signs for each kind."""

    def __init__(self, look):
        self.look = look
        self.paths, self.signs = {kind: [] for kind in look}, {kind: [] for kind in look}
        self.absent = []

    def strip(self, found, values, left, top):
        """One field: a part for each value, in the colour and with the sign of what happened."""
        middle = top + TALL / 2 + 3
        if found is None:
            self.absent.append(text(left + WIDE / 2 - 2, middle, "–"))
            return
        width = (WIDE - 4) / len(values)
        for i, x in enumerate(values):
            cell, at = found.get(x), left + i * width
            if cell is None:
                self.absent.append(text(at + width / 2, middle, "–"))
                continue
            self.paths[cell.kind].append(
                f"M{at:.1f} {top + 1}h{width:.1f}v{TALL - 3}h-{width:.1f}z")
            self.signs[cell.kind].append(text(at + width / 2, middle, self.look[cell.kind][1]))

    def markup(self):
        out = f'<g text-anchor="middle" fill-opacity=".5">{"".join(self.absent)}</g>'
        for kind, (colour, _) in self.look.items():
            fill, ink = paint(kind, colour)
            out += (f'<path fill="{fill}" stroke="var(--paper,#fff)" stroke-width=".6" '
                    f'd="{"".join(self.paths[kind])}"/><g text-anchor="middle" font-size="8" '
                    f'fill="{ink}">{"".join(self.signs[kind])}</g>')
        return out


def paint(kind, colour):
    """Colours of a field and its sign: what is wrong has that of the ink, which changes on a dark
    page."""
    return ("currentColor", "var(--paper,#fff)") if kind == "wrong" else (colour, "#111418")


def draw_band(fields, extremes, keys, all_cells, top):
    """Names of extremes above, of formulations on the left, and their fields."""
    out = ""
    for column, extreme in enumerate(extremes):
        x = LEFT + (column + 0.5) * WIDE
        out += (f'<text transform="translate({x:.1f} {top - 6}) rotate(-55)">'
                f'{escape(extreme["name"])}</text>')
    for row, key in enumerate(keys):
        y = top + row * TALL
        out += text(LEFT - 8, y + TALL / 2 + 4, key, 'text-anchor="end" font-size="11"')
        for column, extreme in enumerate(extremes):
            fields.strip(all_cells.get((extreme["name"], key)), extreme["values"],
                         LEFT + column * WIDE, y)
    return out


def draw(record, all_cells, look, meaning):
    """The Image. look: {kind: (colour, sign)}; meaning: {kind: words}."""
    extremes = record["extremes"]
    keys = [f["formulation"] for f in record["formulations"]]
    kinds = {c.kind for found in all_cells.values() for c in found.values()}
    present = [k for k in look if k in kinds]
    top = HEAD + 18 * len(present)
    out = ""
    for i, k in enumerate(present):
        sign = look[k][1]
        fill, ink = paint(k, look[k][0])
        out += f'<path fill="{fill}" d="M{LEFT} {18 * i + 2}h14v13h-14z"/>'
        out += text(LEFT + 7, 18 * i + 12, sign, f'text-anchor="middle" font-size="8" fill="{ink}"')
        out += text(LEFT + 22, 18 * i + 13, f"{k}: {meaning[k]}")
    fields = Fields(look)
    columns = -(-len(extremes) // -(-len(extremes) // MOST)) if extremes else 0
    band = HEAD + TALL * len(keys)
    for first in range(0, len(extremes), max(columns, 1)):
        out += draw_band(fields, extremes[first:first + columns], keys, all_cells,
                         top + first // columns * band)
    width = LEFT + WIDE * columns + HEAD // 2
    height = top - HEAD + band * -(-len(extremes) // max(columns, 1)) + 6
    return Image("stability_map.svg",
                 f'<svg viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
                 f'fill="currentColor" font-size="10" font-family="{FONT}">'
                 f"{out}{fields.markup()}</svg>")
