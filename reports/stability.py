"""Numerical stability of every formulation in every extreme case: a map, curves of the error against the varied
parameter, and numbers."""
import functools
import math

from markupsafe import escape

from reports import experiments
from reports.figures.chart import Chart
from reports.figures.svg import FONT, Image

# The map of stability in a separate SVG. Rows are formulations, and columns are extremes. Each field is a strip with a
# part for each tested value, from left to right in the order of the results.

WIDE, TALL, HEAD, LEFT = 42, 22, 150, 190  # width and height of a field, space for the names above and on the left
MOST = 22  # largest number of extremes side by side


def map_text(x, y, words, more=""):
    start = f'<text x="{x:.1f}" y="{y:.1f}"{more and " "}{more}>'
    return f"{start}{escape(words)}</text>" if words else ""


class Fields:
    def __init__(self, look):
        self.look = look
        self.paths, self.signs = {kind: [] for kind in look}, {kind: [] for kind in look}
        self.absent = []

    def strip(self, found, values, left, top):
        middle = top + TALL / 2 + 3
        if found is None:
            self.absent.append(map_text(left + WIDE / 2 - 2, middle, "–"))
            return
        width = (WIDE - 4) / len(values)
        for i, x in enumerate(values):
            cell, at = found.get(x), left + i * width
            if cell is None:
                self.absent.append(map_text(at + width / 2, middle, "–"))
                continue
            self.paths[cell.kind].append(
                f"M{at:.1f} {top + 1}h{width:.1f}v{TALL - 3}h-{width:.1f}z")
            self.signs[cell.kind].append(map_text(at + width / 2, middle, self.look[cell.kind][1]))

    def markup(self):
        out = f'<g text-anchor="middle" fill-opacity=".5">{"".join(self.absent)}</g>'
        for kind, (colour, _) in self.look.items():
            fill, ink = paint(kind, colour)
            out += (f'<path fill="{fill}" stroke="var(--paper,#fff)" stroke-width=".6" '
                    f'd="{"".join(self.paths[kind])}"/><g text-anchor="middle" font-size="8" '
                    f'fill="{ink}">{"".join(self.signs[kind])}</g>')
        return out


def paint(kind, colour):
    """Returns the colours of a field and of its sign. Wrong values have the colour of the text, which changes in dark
    mode."""
    return ("currentColor", "var(--paper,#fff)") if kind == "wrong" else (colour, "#111418")


def draw_band(fields, extremes, keys, all_cells, top):
    out = ""
    for column, extreme in enumerate(extremes):
        x = LEFT + (column + 0.5) * WIDE
        out += (f'<text transform="translate({x:.1f} {top - 6}) rotate(-55)">'
                f'{escape(extreme["name"])}</text>')
    for row, key in enumerate(keys):
        y = top + row * TALL
        out += map_text(LEFT - 8, y + TALL / 2 + 4, key, 'text-anchor="end" font-size="11"')
        for column, extreme in enumerate(extremes):
            fields.strip(all_cells.get((extreme["name"], key)), extreme["values"],
                         LEFT + column * WIDE, y)
    return out


def draw_map(record, all_cells, look, meaning):
    """Returns the Image of the map. `look` is {kind: (colour, sign)}, and `meaning` is {kind: description}."""
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
        out += map_text(LEFT + 7, 18 * i + 12, sign, f'text-anchor="middle" font-size="8" fill="{ink}"')
        out += map_text(LEFT + 22, 18 * i + 13, f"{k}: {meaning[k]}")
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


NAVIGATION = [("stability.html", "stability")]

# Outcomes from good to bad, with colours that also differ in brightness and signs that can be read without colour.
LOOK = {
    "value": ("#009E73", ""), "coarse": ("#8FD3F4", "·"), "named": ("#E69F00", "△"),
    "wrong": ("#000000", "×"), "fault": ("#CC79A7", "!")
}
MEANING = {
    "value": "a value within the extreme's tolerance",
    "coarse": "outside the tolerance, decreases with more elements", "named": "a reported failure",
    "wrong": "a wrong value, listed and explained below", "fault": "crashed"
}
FLOOR = 1e-16  # smallest drawn error
NAMED = ("not converged", "singular", "refused", "no value")


def read(path):
    """Reads the results of `beamwork stress`, each extreme with its values of x and its quantities. Returns None if
    there are no results."""
    record = experiments.read(path, "stress")
    if record is None:
        return None
    values, quantities = (experiments.grouped(record[table], "extreme")
                          for table in ("extreme_values", "extreme_quantities"))
    for extreme in record["extremes"]:
        key = (extreme["name"], )
        extreme["values"] = [row["x"] for row in values[key]]
        extreme["quantities"] = [row["quantity"] for row in quantities[key]]
    return record


def kind(outcome):
    return "named" if outcome["outcome"] in NAMED else outcome["outcome"]


class Cell:
    """Outcome of one formulation at one value of one extreme: the worst outcome of all quantities. `error` is the
    largest magnitude of the errors of all quantities, or NaN."""

    def __init__(self, outcomes):
        order = list(LOOK)
        worst = max(outcomes, key=lambda o: (order.index(kind(o)), abs(o["error"] or 0.0)))
        self.kind, self.outcome = kind(worst), worst["outcome"]
        self.error = max((abs(o["error"]) for o in outcomes if o["error"] is not None),
                         default=math.nan)
        self.condition, self.iterations, self.reason = worst["condition"] or math.nan, worst[
            "iterations"], worst["reason"]
        self.expected = all(o["as_expected"] for o in outcomes)
        self.mark = LOOK[self.kind][1]

    @property
    def text(self):
        return self.outcome if self.kind in (
            "named", "fault"
        ) else f"{self.error:.1e}{' ~' if self.kind == 'coarse' else ' ×' if self.kind == 'wrong' else ''}"


def cells(record):
    """Returns {(extreme, formulation): {x: Cell}} of all runs. Values of x that need unsupported physics are missing."""
    groups = {}
    for o in record["outcomes"]:
        if o["outcome"] != "skip":
            groups.setdefault((o["extreme"], o["formulation"], o["x"]), []).append(o)
    out = {}
    for (extreme, key, x), outcomes in groups.items():
        out.setdefault((extreme, key), {})[x] = Cell(outcomes)
    return out


def largest(found, name):
    values = [getattr(c, name) for c in found.values() if math.isfinite(getattr(c, name))]
    return f"{max(values):.2g}" if values and max(values) > 0 else "–"


def draw_curve(site, extreme, keys, all_cells):
    """A failure is drawn as a cross on the upper edge."""
    low, high = min(extreme["values"]), max(extreme["values"])
    unit = "" if extreme["x_unit"] == "1" else f" [{extreme['x_unit']}]"
    chart = Chart(1, (540, 190))
    panel = chart.panel("", extreme["x_name"] + unit, "relative error",
                        xlog=low > 0 and high / low >= 20)
    panel.y.take([FLOOR / 2, 1])
    panel.level(extreme["tolerance"], "tolerance")
    for key in keys:
        found = all_cells.get((extreme["name"], key))
        if found is None:
            continue
        points = [(x, min(1, max(found[x].error, FLOOR))) for x in extreme["values"]
                  if x in found and math.isfinite(found[x].error)]
        look = site.points(key, (extreme["x_name"] + unit, "error", "outcome"),
                           [(x, found[x].error, found[x].outcome) for x, _ in points])
        if points:
            panel.plot([x for x, _ in points], [e for _, e in points], label=key, **look)
        for x in extreme["values"]:
            if x in found and found[x].kind in ("named", "fault"):
                panel.cross(x, look["color"], site.styles.of(key)["gid"])
    return chart.image(site, f"stability_{extreme['name']}")


def findings(record):
    """Returns [(extreme, formulations, outcome, values of x, proof)] of the reported failures, wrong numbers and crashes.
    Formulations with the same outcome at the same values share an entry."""
    rows, told = {}, {}
    for o in record["outcomes"]:
        if kind(o) in ("named", "wrong", "fault"):
            rows.setdefault((o["extreme"], o["formulation"], o["outcome"], o["proof"] or
                             "not expected: " + o["reason"]), set()).add(o["x"])
    for (extreme, formulation, outcome, proof), found in rows.items():
        values = ", ".join(f"{x:g}" for x in sorted(found))
        told.setdefault((extreme, outcome, values, proof), []).append(formulation)
    return [(extreme, keys, outcome, values, proof)
            for (extreme, outcome, values, proof), keys in told.items()]


def stored(site):
    return read(site.results)


def present(site):
    return experiments.holds(site.results, "stress")


def write(site):
    record = stored(site)
    all_cells = cells(record)
    record["extremes"] = [
        e for e in record["extremes"] if any(name == e["name"] for name, _ in all_cells)
    ]
    keys = [f["formulation"] for f in record["formulations"]]
    total = {
        name: sum(f[name] for f in record["formulations"])
        for name in ("tried", "survived", "coarse", "named_failures", "wrong", "faults")
    }
    site.write("stability.html",
               "stability.html",
               record=record, about=site.about,
               total=total,
               image=draw_map(record, all_cells, LOOK, MEANING),
               cells=all_cells,
               keys=keys,
               findings=findings(record),
               curves={e["name"]: draw_curve(site, e, keys, all_cells)
                       for e in record["extremes"]},
               largest=largest)


def tasks(site):
    return [functools.partial(write, site)]
