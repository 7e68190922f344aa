"""Figures: error against work, small multiples, model error, curves."""
import math

import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter, NullLocator

from reports import answers, beside
from reports.chart import Chart

FLOOR = 1e-13   # below it errors are round-off
CEILING = 1e3   # above it a value is a divergence


def log_axis(axis, whole=False):
    """Few ticks: whole numbers as such, else powers of ten."""
    low, high = axis.get_view_interval()
    decades = math.log10(high / low) if low > 0 else 6
    if whole and decades < 0.7:
        axis.set_major_locator(MaxNLocator(4, integer=True))
    elif whole and decades < 2.2:
        axis.set_major_locator(LogLocator(subs=(1, 2, 4) if decades < 1.2 else (1, 2, 5)))
    else:
        axis.set_major_locator(LogLocator(numticks=7))
    axis.set_minor_locator(NullLocator())
    axis.set_minor_formatter(NullFormatter())
    if whole:
        axis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))


def log_axes(axes, xlabel, ylabel, whole=False):
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel(xlabel)
    axes.set_ylabel(ylabel)
    log_axis(axes.xaxis, whole)
    log_axis(axes.yaxis)


def clipped(error):
    return min(max(abs(error), FLOOR), CEILING)


def finite(series, quantity, errors="errors"):
    return [(m, clipped(getattr(m, errors)[quantity])) for m in series.meshes if math.isfinite(getattr(m, errors).get(quantity, math.nan))]


def marks_of(site, point, series, quantity, pairs, errors="errors"):
    """What plot() wants for the curve of a formulation through these meshes, whose marks say what was found."""
    v = answers.verdict_of(series, quantity)
    unit = point.units.get(quantity, "")
    columns = ("elements", f"value [{unit}]" if unit else "value", "error", "time [s]", "unknowns", "verdict")
    rows = [(m.n, m.values.get(quantity), getattr(m, errors)[quantity], m.seconds, m.free, v.verdict if v else None) for m, _ in pairs]
    return site.points(series.key, columns, rows, quantity if errors == "errors" else f"{quantity}, error of the model")


def work_of(point):
    """(label, function of a mesh) of what the last panel counts: iterations, or elements evaluated where nothing iterates."""
    iterates = any(m.iterations > 0 for s in point.series for m in s.meshes)
    return ("Newton iterations", lambda m: m.iterations) if iterates else ("evaluations of elements", lambda m: m.work["strain_evaluations"] + m.work["stress_evaluations"])


def panels_of(point):
    """[(label, function of a mesh, whole numbers)] of the four panels."""
    label, work = work_of(point)
    return [("elements per member", lambda m: m.n, True), ("time [ms]: set-up and solution", lambda m: 1e3 * m.seconds, False), ("unknowns", lambda m: m.free, True), (label, work, True)]


def tolerance_of(point, quantity):
    for series in point.series:
        v = answers.verdict_of(series, quantity)
        if v and v.truth and math.isfinite(v.truth) and math.isfinite(v.tolerance):
            return v.tolerance / abs(v.truth)
    return None


def digits_of(point, quantity):
    """What the truth is uncertain by, relative to it: errors below say nothing. None where it is exact to more than is drawn."""
    known = [v.truth_uncertainty / abs(v.truth) for s in point.series for v in [answers.verdict_of(s, quantity)] if v and v.truth and math.isfinite(v.truth)]
    least = max((u for u in known if math.isfinite(u)), default=0)
    return least if least > FLOOR else None


def slope_triangle(axes, point, quantity):
    """Order of the most accurate formulation beside its last points."""
    best = None
    for series in point.series:
        pairs, v = finite(series, quantity), answers.verdict_of(series, quantity)
        if len(pairs) > 2 and v and math.isfinite(v.order) and v.order > 0.5 and pairs[-1][1] > 30 * FLOOR and v.verdict == "pass" and (best is None or pairs[-1][1] < best[2]):
            best = (round(v.order), pairs[-1][0].n, pairs[-1][1])
    if best:
        order, n, error = best
        x = np.array([n / 3, n])
        axes.plot(x, error / 3 * (x / n) ** -order, back=True, color="currentColor", linewidth=1, alpha=0.55)
        axes.note(x[0], error / 3 * 3 ** order, f"order {order}")


def draw_failures(panels, charts, point, quantity, styles):
    """Crosses on the upper edge of every panel, where a cell has no value."""
    for series, mesh, _, _ in answers.failures(point):
        if math.isfinite(mesh.values.get(quantity, math.nan)):
            continue
        look = styles.of(series.key)
        for (_, where, _), one in zip(panels, charts):
            if where(mesh) > 0:
                one.cross(where(mesh), look["color"], look["gid"])


def draw_series(site, point, quantity, panels, charts):
    """The curves of all formulations and other programs; noise of times as pale bars in the second panel."""
    for series in point.series:
        pairs = finite(series, quantity)
        if not pairs:
            continue
        look = marks_of(site, point, series, quantity, pairs)
        for (_, where, _), one in zip(panels, charts):
            one.plot([max(where(m), 1e-3) for m, _ in pairs], [e for _, e in pairs], label=series.key, **look)
        for m, e in pairs:
            if m.clock.most > 1.02 * m.clock.least:
                charts[1].plot([1e3 * m.clock.least, 1e3 * m.clock.most], [e, e], back=True, color=look["color"], gid=site.styles.of(series.key)["gid"], linewidth=3, alpha=0.35)
    for i, series in enumerate(s for s in point.others if finite(s, quantity)):
        for (_, where, _), one in zip(panels, charts):
            pairs = [(where(m), e) for m, e in finite(series, quantity) if where(m) > 0]   # not everything is said of other programs
            one.plot([x for x, _ in pairs], [e for _, e in pairs], label=series.key, **beside.style(i))


def front_line(point, quantity):
    """Times and errors of the front, as a staircase."""
    best = [(1e3 * m.seconds, clipped(m.errors[quantity])) for _, m in answers.front(point, quantity)]
    corners = [(b[0], a[1]) for a, b in zip(best, best[1:])]
    return [p for pair in zip(best, corners + [None]) for p in pair if p]


def work_precision(site, point, quantity, name):
    """Error against elements, time, unknowns and work; the front of time and error in grey; noise as horizontal bars. None when there is no error."""
    panels = panels_of(point)
    if not any(finite(s, quantity) for s in point.series):
        return None
    chart = Chart(len(panels), (282, 262))
    charts = []
    for label, _, whole in panels:
        charts.append(chart.panel(xlabel=label, ylabel="" if charts else "relative error", whole=whole, like=charts[0] if charts else None))
    line = front_line(point, quantity)
    charts[1].plot([x for x, _ in line], [y for _, y in line], back=True, color="currentColor", linewidth=5, alpha=0.15)
    draw_series(site, point, quantity, panels, charts)
    slope_triangle(charts[0], point, quantity)
    tolerance = tolerance_of(point, quantity)
    for one in charts:
        one.below = digits_of(point, quantity)
        if tolerance:
            one.level(tolerance, "tolerance" if one is charts[-1] else "")
    draw_failures(panels, charts, point, quantity, site.styles)
    return chart.image(site, name)


def small_multiples(site, point, quantities, name, errors="errors", ylabel="relative error", against="time"):
    """One small panel for each quantity, error against time (or elements)."""
    columns = min(4, len(quantities))
    chart = Chart(columns, (246, 150), gap=(66, 62))
    for i, quantity in enumerate(quantities):
        last = i + columns >= len(quantities)
        one = chart.panel(quantity, ("time [ms]" if against == "time" else "elements per member") if last else "", "" if i % columns else ylabel, whole=against != "time")
        for series in point.series:
            pairs = finite(series, quantity, errors)
            if pairs:
                x = [1e3 * m.seconds if against == "time" else m.n for m, _ in pairs]
                one.plot(x, [e for _, e in pairs], label=series.key, **{**marks_of(site, point, series, quantity, pairs, errors), "markersize": 3.5})
        if errors == "errors":
            one.below = digits_of(point, quantity)
    return chart.image(site, name)


def curves(site, point, quantity, name):
    """The curve of every formulation on its finest mesh."""
    chart = Chart(1, (520, 300))
    one = None
    for series in point.series:
        meshes = [m for m in series.meshes if quantity in m.curves and len(m.curves[quantity][0]) > 0]
        if not meshes:
            continue
        x, value, x_name, x_unit, unit = meshes[-1].curves[quantity]
        one = one or chart.panel("", f"{x_name} [{x_unit}]", f"{quantity} [{unit}]", xlog=False, ylog=False)
        marks = range(0, len(x), max(1, len(x) // 12))
        names = (f"{x_name} [{x_unit}]", f"{quantity} [{unit}]")
        look = site.points(series.key, names, [(float(x[i]), float(value[i])) for i in marks], f"n = {meshes[-1].n}")
        one.plot(x, value, label=f"{series.key}, n = {meshes[-1].n}", marks=marks, **{**look, "markersize": 3})
    return chart.image(site, name) if one else None


def peers_figure(site, ours, others, name):
    """ours: [(key, meshes)], others: {program: [data.Mesh]}: errors against unknowns and time."""
    chart = Chart(2, (470, 260))
    labels = ("unknowns", "time of the solution [ms]; open marks: taken elsewhere")
    for quantity in ("C_xx", "C_zz"):
        row = [chart.panel("", labels[0], f"relative error of {quantity}", whole=True)]
        row.append(chart.panel("", labels[1], like=row[0]))
        curves_of = [(key, meshes, site.styles.of(key)) for key, meshes in ours]
        curves_of += [(f"{program} (elsewhere)", meshes, beside.style(i)) for i, (program, meshes) in enumerate(others.items())]
        for label, meshes, look in curves_of:
            error = [clipped(m.errors[quantity]) for m in meshes]
            row[0].plot([m.free for m in meshes], error, label=label, **look)
            row[1].plot([1e3 * m.clock.solve for m in meshes], error, label=label, **look)
        for one in row:
            one.level(0.01)
    return chart.image(site, name)
