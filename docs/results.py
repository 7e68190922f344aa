"""Makes tables and figures for pages from a results file: verdicts, and error against run time of one quantity.

usage, from the root: python3 -m docs.results build/results.h5 docs/images/sheet_cantilever.svg
"""
import math
import pathlib
import re
import sys

import matplotlib

matplotlib.use("svg")
import h5py  # noqa: E402  pylint: disable=wrong-import-position
import matplotlib.pyplot as plt  # noqa: E402  pylint: disable=wrong-import-position

from reports import data  # noqa: E402  pylint: disable=wrong-import-position

plt.rcParams.update({"svg.hashsalt": "beamwork", "svg.fonttype": "none", "font.size": 9})
MARKERS = "os^vD<>Pp*"


def cases(path):
    """Returns the names of the cases in a file."""
    with h5py.File(path) as file:
        return list(file.get("cases", ()))


def read(path, case):
    """Returns a case with all its parameter points."""
    return data.read_case(path, case)


def percent(verdict):
    """Returns the relative error of the limit in percent."""
    return f"{100 * verdict.error:+.2g} %" if math.isfinite(verdict.error) else "-"


def curve(series, quantity):
    """Returns [(cost [ms], |error|)] of the meshes with a cost and an error."""
    return [(1e3 * m.cost, abs(m.errors[quantity])) for m in series.meshes
            if math.isfinite(m.cost) and abs(m.errors.get(quantity, math.nan)) > 0]


def draw(point, path, quantity=None, only=None):
    """Draws the error against the cost of the counted work into a file. Returns its path, or None if no mesh has an
    error."""
    judged = [v.quantity for s in point.series for v in s.verdicts if math.isfinite(v.error)]
    quantity = quantity or (judged[0] if judged else None)
    shown = [(s.key, curve(s, quantity)) for s in point.series
             if quantity and not s.missing and (only is None or s.key in only)]
    if not any(points for _, points in shown):
        return None
    figure, axes = plt.subplots(figsize=(7, 3.6), layout="constrained")
    for marker, (key, points) in zip(MARKERS, shown):
        if points:
            axes.loglog(*zip(*points), marker=marker, markersize=4, linewidth=1, label=key)
    axes.set_xlabel("run time by counted work [ms]")
    axes.set_ylabel(f"relative error of {quantity}")
    axes.grid(True, color="0.9")
    axes.legend(frameon=False, fontsize=8, loc="center left", bbox_to_anchor=(1, 0.5))
    save(figure, path)
    return path


def save(figure, path):
    """Saves the figure as SVG. Equal figures give equal text."""
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)
    text = re.sub(r"[ \t]+$", "", path.read_text("utf-8"), flags=re.M)
    path.write_text(text, "utf-8")


def main(results, image):
    """Draws the figure of the README from the results of `make verify`."""
    point = read(results, "sheet_cantilever").points[0]
    draw(point, pathlib.Path(image), "C_zz", ("sheet_second", "sheet_second_consistent",
                                              "sheet_third", "collocation", "geometrically_exact",
                                              "beamw_consistent"))


if __name__ == "__main__":
    main(*sys.argv[1:])
