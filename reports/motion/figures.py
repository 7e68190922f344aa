"""Figures of a motion over time."""
import math

import numpy as np

from reports import tally
from reports.chart import Chart
from reports.motion import stored
from reports.motion.units import fitting
from reports.style import COLOURS

WIDE, HALF = (640, 200), (300, 170)
MOST_POINTS = 150  # of a curve
MOST_CURVES = 7  # with the truth one less than a figure shows at first
FLOOR = 1e-17  # of drifts that are drawn
# column: name, colour, line
ENERGIES = {"kinetic": ("kinetic", 0, "-"), "strain": ("strain", 1, "-"),
            "work": ("work", 2, "--"), "dissipated": ("dissipated", 3, "-."),
            "energy": ("kinetic and strain", 6, ":")}
AXES = {"x": (0, "-"), "y": (1, "--"), "z": (2, ":")}


def thinned(values, most=MOST_POINTS):
    """Indices of so many of the values, evenly, both ends among them."""
    return np.unique(np.linspace(0, len(values) - 1, min(len(values), most)).round().astype(int))


def largest(x, y, most=MOST_POINTS):
    """(x, y) where y is largest in each of so many parts: no peak is lost."""
    parts = np.array_split(np.arange(len(y)), min(len(y), most))
    at = [int(part[np.nanargmax(y[part])]) for part in parts]
    return x[at], y[at]


def line(site, panel, name, look, x, y, unit, size):
    """A curve that is no formulation's; size: of the unit that the axis has."""
    index, dash = look
    marks = thinned(x, 9)
    told = site.points(name, ("time", f"value [{unit}]"),
                       [(f"{x[i]:.4g} s", float(y[i])) for i in marks])
    panel.plot(x, y / size, label=name, marks=marks,
               **{**told, "color": COLOURS[index][0], "marker": "osDv^PX"[index % 7],
                  "linestyle": dash, "markersize": 3})


def energies(site, motion, name):
    """Kinetic, strain, work and what was dissipated."""
    chart = Chart(1, WIDE)
    values = {**motion.columns, "energy": motion.energy}
    size, unit = fitting(motion.scale, "J")
    panel = chart.panel("", "time [s]", f"energy [{unit}]", xlog=False, ylog=False)
    at = thinned(motion.time)
    for column, (words, index, dash) in ENERGIES.items():
        y = values[column]
        if column in ("kinetic", "strain", "energy") or np.abs(y).max() > 1e-12 * motion.scale:
            line(site, panel, words, (index, dash), motion.time[at], y[at], "J",
                 size)
    return chart.image(site, name)


def momenta(site, motion, name):
    """Momentum and angular momentum, a panel each."""
    chart = Chart(2, HALF, gap=(76, 52))
    at = thinned(motion.time)
    for which, words, unit in (("P", "momentum", "kg m/s"), ("L", "angular momentum", "kg m²/s")):
        found = motion.momentum(which)
        size, shown = fitting(found, unit)
        panel = chart.panel(f"{words} [{shown}]", "time [s]", "", xlog=False, ylog=False)
        for i, (axis, look) in enumerate(AXES.items()):
            line(site, panel, axis, look, motion.time[at], found[at, i], unit, size)
    return chart.image(site, name)


def leading(motions):
    """Those that are drawn: plain formulations first."""
    rank = sorted(motions, key=lambda m: (tally.corrected(m.formulation) is not None,
                                          ":" in m.formulation))
    return rank[:MOST_CURVES]


def compared(site, panel, motion, x, y, what):
    """A curve of a formulation."""
    marks = thinned(x, 9)
    look = site.points(motion.formulation, ("time", what),
                       [(f"{x[i]:.4g} s", float(f"{y[i]:.3g}")) for i in marks],
                       f"n = {motion.elements}")
    panel.plot(x, y, label=motion.formulation, marks=marks, **{**look, "markersize": 3})


def drifts(site, motions, name):
    """Drift of energy of the formulations."""
    chart = Chart(1, WIDE)
    panel = chart.panel("", "time [s]", "drift of energy", xlog=False)
    for motion in leading(motions):
        x, y = largest(motion.time[1:], np.abs(motion.drift[1:]))
        compared(site, panel, motion, x, np.maximum(y, FLOOR), "drift")
    return chart.image(site, name)


def steps(site, motions, name):
    """Lengths of steps and iterations; of steps that are all alike the latter only."""
    told = leading(motions)
    equal = all(np.ptp(m.steps) <= 1e-6 * m.steps.max() for m in told)
    chart = Chart(1 if equal else 2, WIDE if equal else HALF, gap=(76, 52))
    if not equal:
        panel = chart.panel("step [s]", "time [s]", "", xlog=False)
        for motion in told:
            at = thinned(motion.steps)
            compared(site, panel, motion, motion.time[1:][at], motion.steps[at], "step [s]")
    panel = chart.panel("" if equal else "iterations", "time [s]",
                        "iterations of a step" if equal else "", xlog=False, ylog=False)
    panel.y.take([0])
    for motion in told:
        x, y = largest(motion.time[1:], motion.columns["iterations"][1:])
        compared(site, panel, motion, x, y, "iterations")
    return chart.image(site, name)


def over_time(case, quantity):
    """{formulation: (times, values, elements, whole)} of finest meshes: the curve of the quantity,
    or its values at points that differ in `time` only."""
    out, end = {}, end_of(case)
    for series in case.points[0].series:
        curves = [m for m in series.meshes if quantity in m.curves and
                  m.curves[quantity][3] == "s" and len(m.curves[quantity][0])]
        if curves:
            x, y = curves[-1].curves[quantity][:2]
            out[series.key] = (np.array(x, float), np.array(y, float), curves[-1].n, True)
    if out or end is None:
        return out
    for point in case.points:
        said = dict(item.split("=", 1) for item in point.parameters.split(";") if item)
        time = float(said.pop("time", end))
        for series in point.series if not said else ():
            done = [m for m in series.meshes if math.isfinite(m.values.get(quantity, math.nan))]
            if done:
                out.setdefault(series.key, []).append((time, done[-1].values[quantity],
                                                       done[-1].n))
    return {key: (*map(np.array, zip(*[row[:2] for row in sorted(rows)])), rows[0][2], False)
            for key, rows in out.items()}


def end_of(case):
    """Default of the parameter `time`, or None."""
    found = [p for p in case.parameters if p["parameter"] == "time"]
    return float(found[0]["default"]) if found else None


def quantity(site, case, name, image):
    """A quantity over time with its truths, as far as it was computed; None where that is one
    instant only."""
    found, end = over_time(case, name), end_of(case)
    instants = {t for x, *_ in found.values() for t in x}
    if len(instants) < 2:
        return None
    truths = stored.truths_of(site.truths, case.name, name, end) if end is not None else []
    truths = [t for t in truths if t.time <= max(instants) * (1 + 1e-9)]
    unit = case.points[0].units.get(name, "")
    chart = Chart(1, WIDE)
    size, shown = fitting(np.concatenate([y for _, y, _, _ in found.values()]), unit)
    panel = chart.panel("", "time [s]", f"{name} [{shown}]", xlog=False, ylog=False)
    keys = sorted(found, key=lambda k: (tally.corrected(k) is not None, ":" in k))[:MOST_CURVES]
    for key in keys:
        x, y, n, whole = found[key]
        at = thinned(x)
        marks = thinned(x[at], 12)
        look = site.points(key, ("time", f"{name} [{unit}]"),
                           [(f"{x[at][i]:.4g} s", float(y[at][i])) for i in marks], f"n = {n}")
        look = {**look, "markersize": 3, **({} if whole else {"linestyle": "none"})}
        panel.plot(x[at], y[at] / size, label=f"{key}, n = {n}", marks=marks, **look)
    if truths:
        look = site.points("truth", ("time", f"{name} [{unit}]"),
                           [(f"{t.time:g} s", t.value) for t in truths])
        panel.plot([t.time for t in truths], [t.value / size for t in truths], label="truth",
                   **{**look, "color": COLOURS[6][0], "marker": "x", "markersize": 8,
                      "linestyle": "none"})
    return chart.image(site, image)
