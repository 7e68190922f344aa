"""python -m reports.graph FORM draws curves for `beamwork plot`. FORM is png, svg or pdf for a picture, or csv for a
table with a column for each quantity. The program reads a list of solutions in the format of `beamwork solve --format
json` from standard input and writes the picture or the table to standard output. Exit status 4 means that nothing can be
drawn; a line on standard error gives the reason.

For a single formulation, there is a panel for each abscissa and unit, and each quantity has a colour. For several
formulations, there is a panel for each quantity, and each formulation has a colour. Curves over frequency have a
logarithmic vertical axis, as in a Bode diagram, if all their values are positive and are not phases."""
import csv
import importlib.util
import itertools
import json
import math
import sys

COULD_NOT = 4
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#8c6d31")
LINES = ("-", "--", ":", "-.")
MARKED = 30  # number of points below which a curve has markers
WIDTH, HEIGHT = 6.4, 2.5  # width and height of a panel [inch]
MOST = 16  # largest number of panels
PHASES = ("rad", "deg")  # units of phases over frequency


class Curve:
    def __init__(self, solution, entry):
        self.quantity, self.unit = entry["quantity"], entry["unit"]
        self.x_name, self.x_unit = entry["x_name"], entry["x_unit"]
        self.formulation = f"{solution['formulation']}, n = {solution['elements']}"
        pairs = [(a, b) for a, b in zip(entry["curve_x"], entry["curve_value"])
                 if a is not None and b is not None and math.isfinite(a) and math.isfinite(b)]
        self.x, self.y = [a for a, _ in pairs], [b for _, b in pairs]

    @property
    def steady(self):
        return self.x_name == "frequency"

    @property
    def decades(self):
        return (self.steady and self.unit not in PHASES and
                all(b > 0 for a, b in zip(self.x, self.y) if a > 0))


def merged(curves):
    """Merges quantities with equal curves, such as the largest and the smallest value of a history, into one curve."""
    found = {}
    for c in curves:
        same = found.setdefault((c.formulation, c.unit, c.x_name, *c.x, *c.y), c)
        if same is not c:
            same.quantity += f", {c.quantity}"
    return list(found.values())


def label(name, unit):
    return f"{name} [{unit}]" if unit not in ("", "1") else name


def panels_of(curves):
    """Returns lists of curves, one for each panel."""
    several = len({c.formulation for c in curves}) > 1
    found = {}
    for c in curves:
        of = (c.quantity,) if several else (c.unit, c.decades)
        found.setdefault((c.x_name, c.x_unit, *of), []).append(c)
    abscissae = list(dict.fromkeys(key[:2] for key in found))
    return [found[key] for at in abscissae for key in found if key[:2] == at]


def draw_panel(axes, curves):
    formulations = list(dict.fromkeys(c.formulation for c in curves))
    quantities = list(dict.fromkeys(c.quantity for c in curves))
    several = len(formulations) > 1
    for c in curves:
        number = formulations.index(c.formulation) if several else quantities.index(c.quantity)
        x, y = c.x, c.y
        if c.steady and min(c.x) <= 0 and c.decades:
            x, y = zip(*((a, b) for a, b in zip(x, y) if a > 0))
        axes.plot(x, y, color=COLOURS[number % len(COLOURS)],
                  linestyle=LINES[number % len(LINES) if several else 0],
                  marker="o" if len(x) < MARKED else "", markersize=3, linewidth=1.3,
                  label=c.formulation if several else c.quantity)
    first = curves[0]
    if first.steady and (first.decades or min(first.x) > 0):
        axes.set_xscale("log")
    if first.decades:
        axes.set_yscale("log")
    axes.set_xlabel(label(first.x_name, first.x_unit))
    axes.set_ylabel(label(quantities[0], first.unit) if len(quantities) == 1 else
                    f"[{first.unit}]")
    axes.grid(True, which="major", alpha=0.25, linewidth=0.5)
    if len(curves) > 1:
        axes.legend(frameon=False, fontsize=8)


def share(panels, axes):
    for i, (curves, one) in enumerate(zip(panels, axes)):
        for k in range(i):
            if panels[k][0].x_name == curves[0].x_name and (
                    panels[k][0].x_unit == curves[0].x_unit):
                one.sharex(axes[k])
                break


def written(curves):
    """Returns the rows of a table: a column for each abscissa, followed by a column for each curve over this abscissa."""
    several = len({c.formulation for c in curves}) > 1
    columns, last = [], None
    for c in (c for panel in panels_of(curves) for c in panel):
        if last != (c.x_name, c.x):
            columns.append([label(c.x_name, c.x_unit), *map(repr, c.x)])
            last = (c.x_name, c.x)
        name = label(c.quantity, c.unit)
        columns.append([f"{name} {c.formulation}" if several else name, *map(repr, c.y)])
    return itertools.zip_longest(*columns, fillvalue="")


def draw(curves, solutions, form, to):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    plt.rcParams.update({"font.size": 9, "axes.spines.top": False, "axes.spines.right": False,
                         "svg.hashsalt": "beamwork", "svg.fonttype": "none"})
    panels = panels_of(merged(curves))
    if len(panels) > MOST:
        print(f"beamwork: {len(panels)} panels, of which the first {MOST} are drawn; -k selects "
              "quantities", file=sys.stderr)
    panels = panels[:MOST]
    figure, axes = plt.subplots(len(panels), 1, squeeze=False, layout="constrained",
                                figsize=(WIDTH, 0.4 + HEIGHT * len(panels)))
    axes = [row[0] for row in axes]
    for one, curves in zip(axes, panels):
        draw_panel(one, curves)
    share(panels, axes)
    words = ", ".join(f"{name} = {value:g}" if isinstance(value, float) else f"{name} = {value}"
                      for name, value in solutions[0]["parameters"].items() if name != "omit")
    one = len({c.formulation for panel in panels for c in panel}) == 1
    title = [solutions[0]["case"], *([panels[0][0].formulation] if one else [])]
    figure.suptitle(": ".join(title) + (f" ({words})" if words and len(words) < 60 else ""),
                    fontsize=10)
    figure.savefig(to, format=form, dpi=150,
                   metadata={"Date": None} if form == "svg" else
                   {"CreationDate": None} if form == "pdf" else None)


def main():
    form, solutions = sys.argv[1], json.load(sys.stdin)
    curves = [Curve(s, entry) for s in solutions for entry in s["curves"]]
    for c in (c for c in curves if len(c.x) < 2):
        print(f"beamwork: {c.quantity} has one point: give its analysis more stations",
              file=sys.stderr)
    curves = [c for c in curves if len(c.x) > 1]
    if not curves:
        return COULD_NOT
    if form == "csv":
        csv.writer(sys.stdout, lineterminator="\n").writerows(written(curves))
    elif importlib.util.find_spec("matplotlib") is None:
        print("beamwork: pictures need matplotlib. Run: sudo apt-get install python3-matplotlib",
              file=sys.stderr)
        return COULD_NOT
    else:
        draw(curves, solutions, form, sys.stdout.buffer)
    return 0


if __name__ == "__main__":
    sys.exit(main())
