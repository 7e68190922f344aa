"""The joint and the hexapod, compared with N sections 4.2 and 4.3: curves, times and their parts, and the published
dense algorithm.

The times are measured by `make lab L=bench-mechanisms`, which writes its files to the folder of the results."""
import functools
import math
import os

from reports import data
from reports.figures.plots import log_axes
from reports.figures.style import plt

NAVIGATION = [("mechanisms.html", "mechanisms")]

# N Fig. 8 and its text: formulation, elements per sheet, largest support stiffness in N/m, time relative to the first
# row
PUBLISHED = (("sheet_third", 1, 9.77e5, 1.0), ("sheet_third", 2, 9.61e5, 3.3),
             ("sheet_second", 1, 10.95e5, 0.9), ("sheet_second", 2, 9.68e5, 3.1), ("sheet_second",
                                                                                   4, 9.63e5, 9.6))
PUBLISHED_SHELL = 9.81e5  # N Fig. 8, shell elements, which are another model
PUBLISHED_SECONDS = {"spherical_joint": 2.45,
                     "hexapod": 122.0}  # published times [s] with one third-order element per sheet
PUBLISHED_FACTOR = 6.32  # N section 4.3: time of two second-order elements relative to one third-order element
PARTS = ("elements", "assembly", "factorisation", "solution")
QUANTITY = "support_stiffness_max"


class Cell:
    """One timed run of a bench file. `parts` is {part: seconds per iteration}."""

    def __init__(self, case, key, mesh):
        self.case, self.key, self.n, self.free = case, key, mesh.n, mesh.free
        self.iterations, self.steps = mesh.iterations, int(mesh.work["load_steps"])
        self.seconds = mesh.seconds
        self.parts = {p: seconds / max(self.iterations, 1) for p, seconds in mesh.parts.items()}
        self.dense_unknowns = mesh.dense.unknowns if mesh.dense else 0
        self.dense = mesh.dense.seconds if mesh.dense else math.nan
        self.dense_whole = bool(mesh.dense and mesh.dense.whole)
        self.value = mesh.values.get(QUANTITY, math.nan)


def read_bench(path, case):
    """Returns the timed runs at the default parameters in a file of `beamwork bench`. The list may be empty."""
    if not os.path.exists(path):
        return []
    found = data.read_case(path, case, root=data.root_of_bench)
    return [
        Cell(case, s.key, m) for s in found.points[0].series for m in s.meshes
        if m.clock.repeats > 1
    ]


def value_of(site, key, n, parameters):
    case = site.case("spherical_joint")
    for point in case.points if case else []:
        if point.parameters == parameters:
            return next((m.values.get(QUANTITY, math.nan) for s in point.series if s.key == key
                         for m in s.meshes if m.n == n), math.nan)
    return math.nan


def comparison(site, cells):
    """Returns the published rows with those of beamwork. The published second-order element has no Wagner torque."""
    at = {(c.key, c.n): c for c in cells if c.case == "spherical_joint"}
    first = at.get(("sheet_third", 1))
    rows = []
    for key, n, maximum, time in PUBLISHED:
        ours = value_of(site, key, n, "wagner=0" if key == "sheet_second" else "")
        cell = at.get((key, n))
        rows.append({
            "key": key, "n": n, "published": maximum, "ours": ours, "published_time": time,
            "seconds": cell.seconds if cell else math.nan,
            "time": cell.seconds / first.seconds if cell and first else math.nan
        })
    return rows


def curve_figure(site):
    case = site.case("spherical_joint")
    point = next((p for p in case.points if p.name == "default"), None) if case else None
    wanted = (("collocation", 1), ("sheet_third", 1), ("sheet_third", 2), ("sheet_second", 1),
              ("sheet_second", 2))
    meshes = {(s.key, m.n): m for s in point.series for m in s.meshes} if point else {}
    lines = [(key, n, meshes[key, n].curves["support_stiffness_curve"]) for key, n in wanted
             if (key, n) in meshes and "support_stiffness_curve" in meshes[key, n].curves]
    if not lines:
        return None
    figure, axes = plt.subplots(figsize=(7.2, 3.8))
    for key, n, curve in lines:
        style = site.styles.of(key)
        style.update(marker=None,
                     linestyle="-" if n == 1 else "--",
                     linewidth=2.6 if key == "collocation" else 1.3,
                     alpha=0.55 if key == "collocation" else 1)
        axes.plot(curve[0],
                  curve[1] / 1e5,
                  label=f"{key}, {n} per sheet" +
                  (" (converged beam model)" if key == "collocation" else ""),
                  **style)
    axes.axhline(PUBLISHED_SHELL / 1e5,
                 color="0.3",
                 linestyle=":",
                 linewidth=1.2,
                 label="N: maximum of shell elements (another model)")
    axes.set_xlabel("azimuth of the tilt axis [rad]")
    axes.set_ylabel("support stiffness [10$^5$ N/m]")
    axes.legend(fontsize=7.5, loc="upper right", bbox_to_anchor=(1.55, 1))
    return site.image(figure, "mechanisms_curve")


def growth_figure(site, cells):
    """Draws the time of the whole curve against elements per sheet, and the time of each part of an iteration divided by
    the elements per sheet."""
    joint = [c for c in cells if c.case == "spherical_joint"]
    if not joint:
        return None
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 3.8))
    for key in sorted({c.key for c in joint}):
        mine = [c for c in joint if c.key == key]
        left.plot([c.n for c in mine], [1e3 * c.seconds for c in mine],
                  label=key,
                  **site.styles.of(key))
    third = [c for c in joint if c.key == "sheet_third"] or joint
    left.plot([1, third[-1].n], [1e3 * third[0].seconds, 1e3 * third[0].seconds * third[-1].n],
              color="0.6",
              linewidth=0.8,
              zorder=0,
              label="linear")
    log_axes(left, "elements per sheet", "milliseconds, 50 steps")
    left.legend(fontsize=8)
    below = [0] * len(third)
    for part, colour in zip(PARTS, ("#0072B2", "#56B4E9", "#D55E00", "#E69F00")):
        height = [1e6 * c.parts.get(part, 0) / c.n for c in third]
        right.bar([str(c.n) for c in third],
                  height,
                  bottom=below,
                  color=colour,
                  label=part,
                  width=0.65)
        below = [b + h for b, h in zip(below, height)]
    right.set_xlabel("elements per sheet")
    right.set_ylabel("µs per iteration / elements per sheet")
    right.set_title(third[0].key, fontsize=9)
    right.grid(axis="x", visible=False)
    right.legend(fontsize=8, loc="upper left", bbox_to_anchor=(1, 1))
    return site.image(figure, "mechanisms_growth")


def factor_of_orders(cells):
    at = {(c.key, c.n): c.seconds for c in cells if c.case == "hexapod"}
    return at.get(("sheet_second", 2), math.nan) / at.get(("sheet_third", 1), math.nan)


def farthest(rows):
    """Returns the largest relative difference from the published values, or NaN if a value is unknown."""
    known = [abs(r["ours"] / r["published"] - 1) for r in rows]
    return max(known) if all(map(math.isfinite, known)) else math.nan


def present(site):
    return site.case("spherical_joint") is not None


def write(site):
    folder = os.path.dirname(os.path.abspath(site.results))
    cells = read_bench(os.path.join(folder, "mechanisms_joint.h5"), "spherical_joint") + read_bench(
        os.path.join(folder, "mechanisms_hexapod.h5"), "hexapod")
    reference = value_of(site, "collocation", 1, "")
    rows = comparison(site, cells)
    site.write("mechanisms.html",
               "mechanisms.html",
               cells=cells,
               rows=rows,
               known=farthest(rows),
               stiffer={key: value_of(site, key, 1, "") / reference - 1
                        for key in ("sheet_second", "sheet_third")},
               parts=PARTS,
               reference=reference,
               shell=PUBLISHED_SHELL,
               published_seconds=PUBLISHED_SECONDS,
               published_factor=PUBLISHED_FACTOR,
               factor=factor_of_orders(cells),
               curve=curve_figure(site),
               growth=growth_figure(site, cells))


def tasks(site):
    return [functools.partial(write, site)]


def section(_, case):
    if case.name not in PUBLISHED_SECONDS:
        return []
    return [(
        "Comparison with the paper",
        '<p>Published stiffnesses and times, growth with the elements and the dense baseline: <a href="mechanisms.html">mechanisms</a>.</p>'
    )]
