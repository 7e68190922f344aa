"""Figures: error against elements and against time, curves, the summary of all verdicts."""
import math

import numpy as np
from matplotlib.ticker import NullFormatter, ScalarFormatter

from reports.style import plt

FLOOR = 1e-13


def log_axes(axes, xlabel, ylabel):
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel(xlabel)
    axes.set_ylabel(ylabel)
    if "elements" in xlabel:
        axes.set_xticks([1, 2, 4, 8, 16, 32, 64])
        axes.xaxis.set_major_formatter(ScalarFormatter())
        axes.xaxis.set_minor_formatter(NullFormatter())


def finite_errors(series, quantity):
    return [(m, abs(m.errors[quantity])) for m in series.meshes if math.isfinite(m.errors.get(quantity, math.nan))]


def failures(series, quantity):
    return [m for m in series.meshes if not math.isfinite(m.values.get(quantity, math.nan))]


def slope_triangle(axes, order, n, error):
    """Reference slope through the last point of a series."""
    x = np.array([n / 4, n])
    axes.plot(x, error * (x / n) ** -order, color="0.6", linewidth=0.8, zorder=0)
    axes.annotate(f"order {order:.0f}", (x[0], error * 4 ** order), fontsize=7, color="0.4")


def convergence(site, point, quantity, name):
    """Error against elements (left) and against seconds (right); failures are marked at the top."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.8), sharey=True)
    drawn, best = False, None
    for series in point.series:
        pairs = finite_errors(series, quantity)
        if not pairs:
            continue
        drawn = True
        n, error = [m.n for m, _ in pairs], [max(e, FLOOR) for _, e in pairs]
        style = site.styles.of(series.key)
        left.plot(n, error, label=series.key, **style)
        right.plot([max(m.seconds, 1e-6) for m, _ in pairs], error, **style)
        order = next((v.order for v in series.verdicts if v.quantity == quantity), math.nan)
        if math.isfinite(order) and len(n) > 2 and error[-1] > 10 * FLOOR and (best is None or error[-1] < best[2]):
            best = (round(order), n[-1], error[-1])
    if not drawn:
        plt.close(figure)
        return None
    span = left.get_xlim()
    log_axes(left, "elements per member", "relative error")
    left.set_xlim(0.9 * max(span[0], 1), 1.1 * span[1])
    log_axes(right, "seconds (set-up and solution)", "")
    if best and best[0] >= 1:
        slope_triangle(left, *best)
    top = left.get_ylim()[1]
    for series in point.series:
        for mesh in failures(series, quantity) if series.missing == "" else []:
            left.plot([mesh.n], [top], marker="x", color=site.styles.of(series.key)["color"], clip_on=False, linestyle="none")
    tolerance = next((v.tolerance / abs(v.truth) for s in point.series for v in s.verdicts if v.quantity == quantity and v.truth and math.isfinite(v.truth)), None)
    if tolerance:
        for axes in (left, right):
            axes.axhline(tolerance, color="0.5", linewidth=0.7, linestyle=(0, (2, 2)))
        right.annotate("tolerance", (right.get_xlim()[1], tolerance), fontsize=7, color="0.4", ha="right", va="bottom")
    right.legend(*left.get_legend_handles_labels(), loc="center left", bbox_to_anchor=(1.02, 0.5), fontsize=8)
    return site.image(figure, name)


def curves(site, point, quantity, name):
    """The curve of every formulation on its finest mesh."""
    figure, axes = plt.subplots(figsize=(6, 3.6))
    labels = None
    for series in point.series:
        meshes = [m for m in series.meshes if quantity in m.curves]
        if not meshes:
            continue
        x, value, x_name, x_unit, unit = meshes[-1].curves[quantity]
        style = {**site.styles.of(series.key), "marker": ""}
        axes.plot(x, value, label=f"{series.key}, n = {meshes[-1].n}", **style)
        labels = (f"{x_name} [{x_unit}]", f"{quantity} [{unit}]")
    if labels is None:
        plt.close(figure)
        return None
    axes.set_xlabel(labels[0])
    axes.set_ylabel(labels[1])
    axes.legend(fontsize=7)
    return site.image(figure, name)


def column_figure(site, case):
    """The column under its axial load: the printed form levels off at the wrong limit, the consistent one goes down."""
    point = next((p for p in case.points if p.parameters == "section_data=printed"), case.points[0])
    figure, axes = plt.subplots(figsize=(6.4, 3.8))
    for key in ("beamw", "beamw_consistent"):
        series = next((s for s in point.series if s.key == key), None)
        if series is None:
            continue
        pairs = finite_errors(series, "buckling_load")
        axes.plot([m.n for m, _ in pairs], [e for _, e in pairs], label=key, **site.styles.of(key))
        verdict = next(v for v in series.verdicts if v.quantity == "buckling_load")
        axes.annotate(f"{verdict.verdict} ({100 * verdict.error:+.2g} %)" if verdict.verdict == "wrong limit" else verdict.verdict,
                      (pairs[-1][0].n, pairs[-1][1]), textcoords="offset points", xytext=(4, 4), fontsize=8, color=site.styles.of(key)["color"])
    log_axes(axes, "elements over the column", "relative error of the buckling load")
    axes.set_xlim(1.8, 260)
    axes.legend(loc="lower left")
    return site.image(figure, "column")
