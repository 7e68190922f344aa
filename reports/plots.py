"""Figures: error against work, small multiples, model error, curves."""
import math

import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter, NullLocator

from reports import answers, beside
from reports.style import plt

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


def shade_digits(axes, point, quantity):
    """Grey ground where errors are below the truth's digits, as far down as something is drawn."""
    digits = digits_of(point, quantity)
    low, high = axes.get_ylim()
    if digits and digits > low:
        axes.axhspan(low, min(digits, high), color="0.93", zorder=-1)
        axes.set_ylim(low, high)


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
        axes.plot(x, error / 3 * (x / n) ** -order, color="0.55", linewidth=0.8, zorder=0)
        axes.annotate(f"order {order}", (x[0], error / 3 * 3 ** order), fontsize=7.5, color="0.35", ha="right")


def draw_failures(panels, axes, point, quantity, styles):
    """Crosses on the upper edge of every panel, where a cell has no value."""
    shown = False
    for series, mesh, _, _ in answers.failures(point):
        if math.isfinite(mesh.values.get(quantity, math.nan)):
            continue
        for (_, where, _), one in zip(panels, axes):
            if where(mesh) > 0:
                one.plot([where(mesh)], [1], marker="x", markersize=6, color=styles.of(series.key)["color"], gid=styles.of(series.key)["gid"], clip_on=False, linestyle="none", transform=one.get_xaxis_transform(), zorder=5)
                shown = True
    return shown


def legend_height(entries, columns):
    """In inches, of a legend below a figure."""
    return 0.2 * math.ceil(entries / columns) + 0.1


def finish(figure, legend, columns, left, right, top, bottom, **spacing):
    """Margins in inches and a legend below: laid out by hand, since finding out takes as long as drawing."""
    width, height = figure.get_size_inches()
    handles, labels = legend
    bottom += legend_height(len(labels), columns)
    figure.subplots_adjust(left=left / width, right=1 - right / width, top=1 - top / height, bottom=bottom / height, **spacing)
    figure.legend(handles, labels, loc="lower center", bbox_to_anchor=(0.5, 0), ncol=columns, fontsize=8.5, borderaxespad=0.2)


def work_precision(site, point, quantity, name):
    """Error against elements, time, unknowns and work; the front of time and error in grey; noise as horizontal bars. None when there is no error."""
    panels = panels_of(point)
    drawn = [s for s in point.series if finite(s, quantity)]
    if not drawn:
        return None
    figure, axes = plt.subplots(1, len(panels), figsize=(13.5, 3.75 + legend_height(len(drawn) + len(point.others), 6)), sharey=True)
    for series in drawn:
        pairs = finite(series, quantity)
        look = marks_of(site, point, series, quantity, pairs)
        for (_, where, _), one in zip(panels, axes):
            one.plot([max(where(m), 1e-3) for m, _ in pairs], [e for _, e in pairs], label=series.key, **look)
        noisy = [(m, e) for m, e in pairs if m.clock.most > 1.02 * m.clock.least]
        axes[1].hlines([e for _, e in noisy], [1e3 * m.clock.least for m, _ in noisy], [1e3 * m.clock.most for m, _ in noisy], color=look["color"], gid=site.styles.of(series.key)["gid"], linewidth=2.5, alpha=0.35)
    for i, series in enumerate(s for s in point.others if finite(s, quantity)):
        for (_, where, _), one in zip(panels, axes):
            pairs = [(where(m), e) for m, e in finite(series, quantity) if where(m) > 0]   # not everything is said of other programs
            one.plot([x for x, _ in pairs], [e for _, e in pairs], label=beside.label(series.key), **beside.style(i))
    best = answers.front(point, quantity)
    axes[1].step([1e3 * m.seconds for _, m in best], [clipped(m.errors[quantity]) for _, m in best], where="post", color="0.6", linewidth=4, alpha=0.35, zorder=0)
    slope_triangle(axes[0], point, quantity)
    for (label, _, whole), one in zip(panels, axes):
        log_axes(one, label, "", whole)
    axes[0].set_ylabel("relative error")
    for one in axes:
        shade_digits(one, point, quantity)
    draw_failures(panels, axes, point, quantity, site.styles)
    tolerance = tolerance_of(point, quantity)
    if tolerance:
        for one in axes:
            one.axhline(tolerance, color="0.45", linewidth=0.8, linestyle=(0, (2, 2)), zorder=0)
        axes[-1].annotate("tolerance", (1, tolerance), xycoords=("axes fraction", "data"), fontsize=7.5, color="0.35", ha="right", va="bottom")
    finish(figure, axes[0].get_legend_handles_labels(), 6, left=0.65, right=0.1, top=0.15, bottom=0.5, wspace=0.06)
    return site.image(figure, name, tight=False)


def small_multiples(site, point, quantities, name, errors="errors", ylabel="relative error", against="time"):
    """One small panel for each quantity, error against time (or elements)."""
    columns = min(4, len(quantities))
    rows = math.ceil(len(quantities) / columns)
    handles = {s.key: None for s in point.series if any(finite(s, q, errors) for q in quantities)}
    across = max(1, min(6, 2 * columns - 1))
    size = (3.35 * columns + 0.3, 2.45 * rows + 0.3 + legend_height(len(handles), across))
    figure, axes = plt.subplots(rows, columns, figsize=size, squeeze=False)
    for one, quantity in zip(axes.flat, quantities):
        for series in point.series:
            pairs = finite(series, quantity, errors)
            if pairs:
                x = [1e3 * m.seconds if against == "time" else m.n for m, _ in pairs]
                handles[series.key] = one.plot(x, [e for _, e in pairs], **{**marks_of(site, point, series, quantity, pairs, errors), "markersize": 3.5})[0]
        log_axes(one, "", "", against != "time")
        if errors == "errors":
            shade_digits(one, point, quantity)
        one.set_title(quantity, fontsize=9)
    for one in axes.flat[len(quantities):]:
        one.set_visible(False)
    for one in axes[:, 0]:
        one.set_ylabel(ylabel)
    for column in range(columns):
        last = max(i for i in range(len(quantities)) if i % columns == column)
        axes.flat[last].set_xlabel("time [ms]" if against == "time" else "elements per member")
    finish(figure, (handles.values(), handles.keys()), across, left=0.75, right=0.1, top=0.25, bottom=0.5, wspace=0.3, hspace=0.5)
    return site.image(figure, name, tight=False)


def curves(site, point, quantity, name):
    """The curve of every formulation on its finest mesh."""
    figure, axes = plt.subplots(figsize=(6.4, 3.6))
    labels = None
    for series in point.series:
        meshes = [m for m in series.meshes if quantity in m.curves and len(m.curves[quantity][0]) > 0]
        if not meshes:
            continue
        x, value, x_name, x_unit, unit = meshes[-1].curves[quantity]
        axes.plot(x, value, label=f"{series.key}, n = {meshes[-1].n}", **{**site.styles.of(series.key), "markersize": 3}, markevery=max(1, len(x) // 12))
        labels = (f"{x_name} [{x_unit}]", f"{quantity} [{unit}]")
    if labels is None:
        plt.close(figure)
        return None
    axes.set_xlabel(labels[0])
    axes.set_ylabel(labels[1])
    axes.legend(fontsize=8, loc="center left", bbox_to_anchor=(1.01, 0.5))
    return site.image(figure, name)


def peers_figure(site, ours, others, name):
    """ours: [(key, meshes)], others: {program: [data.Mesh]}: errors against unknowns and time."""
    figure, axes = plt.subplots(2, 2, figsize=(11, 7), sharey="row", constrained_layout=True)
    for row, quantity in zip(axes, ("C_xx", "C_zz")):
        for key, meshes in ours:
            error = [clipped(m.errors[quantity]) for m in meshes]
            row[0].plot([m.free for m in meshes], error, label=key, **site.styles.of(key))
            row[1].plot([1e3 * m.clock.solve for m in meshes], error, **site.styles.of(key))
        for i, (program, rows) in enumerate(others.items()):
            row[0].plot([m.free for m in rows], [clipped(m.errors[quantity]) for m in rows], label=f"{beside.label(program)} (elsewhere)", **beside.style(i))
            row[1].plot([1e3 * m.clock.solve for m in rows], [clipped(m.errors[quantity]) for m in rows], **beside.style(i))
        for one, label in zip(row, ("unknowns", "time of the solution [ms]; open marks: taken elsewhere")):
            log_axes(one, label, "", label == "unknowns")
            one.axhline(0.01, color="0.45", linewidth=0.8, linestyle=(0, (2, 2)), zorder=0)
        row[0].set_ylabel(f"relative error of {quantity}")
    figure.legend(*axes[0][0].get_legend_handles_labels(), loc="upper center", bbox_to_anchor=(0.5, 0), ncol=3, fontsize=8.5)
    return site.image(figure, name)
