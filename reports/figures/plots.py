import math
from dataclasses import dataclass

import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter, NullLocator

from reports import answers, data, verdicts
from reports.figures import style
from reports.figures.chart import Axis, Chart, whole_ticks

FLOOR = 1e-13
NEARLY = 1e-10  # smaller errors are treated as zero
CEILING = 1e3  # larger errors are drawn at this value
MOST_CURVES = style.MOST
OPEN = "open: below the reference's digits"


def log_axis(axis, whole=False):
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
    """Returns [(mesh, magnitude of its error, limited to FLOOR and CEILING)] of the meshes with an error."""
    return [(m, clipped(getattr(m, errors)[quantity])) for m in series.meshes
            if math.isfinite(getattr(m, errors).get(quantity, math.nan))]


def work_of(point):
    """Returns (label, function of a mesh) of the counted work, which is iterations, or evaluated elements if there are no
    iterations."""
    if any(m.iterations > 0 for s in point.series for m in s.meshes):
        return "Newton iterations", lambda m: m.iterations
    return ("evaluations of elements",
            lambda m: m.work["strain_evaluations"] + m.work["stress_evaluations"])


def against(point, name):
    measure = answers.measure_of(point)
    return {"elements": ("elements per member", lambda m: m.n, True),
            "time": (measure.words, lambda m: 1e3 * measure.of(m), False),
            "unknowns": ("unknowns", lambda m: m.free, True),
            "work": (*work_of(point), True)}[name]


def tolerance_of(point, quantity):
    for series in point.series:
        v = answers.verdict_of(series, quantity)
        if v and v.truth and math.isfinite(v.truth) and math.isfinite(v.tolerance):
            return v.tolerance / abs(v.truth)
    return None


def digits_of(point, quantity):
    """Returns the relative uncertainty of the reference value, below which errors have no meaning, or None if it is below
    the range of the plot."""
    found = (answers.verdict_of(s, quantity) for s in point.series)
    known = [v.truth_uncertainty / abs(v.truth) for v in found
             if v and v.truth and math.isfinite(v.truth)]
    least = max((u for u in known if math.isfinite(u)), default=0)
    return least if least > FLOOR else None


def leading(point, quantity, most=MOST_CURVES):
    """Returns (at most `most` series to draw, other series). Uncorrected misprints and options are omitted first,
    except options on the front of time and error. The least accurate series are omitted next."""
    drawn = [s for s in point.series if finite(s, quantity)]
    front = {s.key for s, _ in answers.front(point, quantity)}

    def rank(series):
        return (verdicts.corrected(series.key) is not None,
                ":" in series.key and series.key not in front, ":" in series.key,
                series.key not in front, min(e for _, e in finite(series, quantity)))

    order = sorted(drawn, key=rank)
    plain = [s for s in order if not any(rank(s)[:2])]
    first = {s.key for s in (plain or order)[:most]}
    return [s for s in drawn if s.key in first], [s for s in drawn if s.key not in first]


def telling(point, quantities):
    """Returns the first quantity for which the errors of most formulations on their coarsest mesh exceed round-off and
    the uncertainty of the reference value, or otherwise the first quantity, if possible one that is not zero."""
    def tells(quantity):
        least = max(digits_of(point, quantity) or 0, NEARLY)
        first = [pairs[0][1] for pairs in (finite(s, quantity) for s in point.series) if pairs]
        return sum(e > least for e in first) > len(first) / 2

    nonzero = (q for q in quantities if any(v.truth and v.quantity == q for s in point.series for v in s.verdicts))
    return next((q for q in quantities if tells(q)), None) or next(nonzero, quantities[0])


def marks_of(site, point, series, quantity, meshes, errors="errors"):
    v = answers.verdict_of(series, quantity)
    unit = point.units.get(quantity, "")
    measure = answers.measure_of(point)
    columns = ("n", f"value [{unit}]" if unit else "value", "error", f"{measure.name} [s]", "unknowns",
               "order", "verdict")
    rows = [(m.n, m.values.get(quantity), float(f"{getattr(m, errors)[quantity]:.3g}"),
             float(f"{measure.of(m):.3g}"), m.free, order_of(v), v.verdict if v else None) for m in meshes]
    title = quantity if errors == "errors" else f"{quantity}, model error"
    return site.points(series.key, columns, rows, title)


def short_label(series):
    """Returns the name of a series with its marks, and an asterisk if it belongs to another model."""
    return f"{series.key}{f' ({series.marks})' if series.marks else ''}{' *' if series.other else ''}"


def order_of(v):
    """Returns the observed order of convergence of a verdict, rounded, or None."""
    return float(f"{v.order:.2g}") if v and math.isfinite(v.order) else None


def draw_series(site, panel, point, series, quantity, where, errors="errors", told=True, short=False, orders=False, **look):
    """Draws the curve of a formulation. Markers below the uncertainty of the reference value are hollow and are drawn at
    this uncertainty, on the grey background. If `told` is True, the markers have tooltips with their values."""
    digits = digits_of(point, quantity) if errors == "errors" else None
    pairs = [(m, e) for m, e in finite(series, quantity, errors) if where(m) > 0]
    if not pairs:
        return
    below = [bool(digits and e < digits) for _, e in pairs]
    x, y = [where(m) for m, _ in pairs], [max(e, digits or 0) for _, e in pairs]
    known = [i for i, low in enumerate(below) if not low]
    lost = [i for i, low in enumerate(below) if low]

    def own(which):
        meshes = [pairs[i][0] for i in which]
        other = {"linestyle": ":"} if series.other else {}
        return {**(marks_of(site, point, series, quantity, meshes, errors) if told else
                   site.styles.of(series.key)), **other, **look}

    order = order_of(answers.verdict_of(series, quantity)) if orders else None
    label = f"{short_label(series)}, order {order:g}" if order else short_label(series) if short else series.label
    panel.plot(x, y, label=label, marks=known, **own(known))
    if lost:
        panel.plot([x[i] for i in lost], [y[i] for i in lost],
                   **own(lost) | {"linestyle": "none", "hollow": True})
        panel.plot([], [], label=OPEN, color="currentColor", marker="o", hollow=True,
                   linestyle="none")
    if lost or digits and min(y) < 3 * digits:
        panel.y.take([digits / 3])
        panel.ground(digits)


def slope_triangle(panel, shown, quantity):
    """Draws a line below the last points of the most accurate formulation. Its slope is the rounded order of this
    formulation."""
    best = None
    for series in shown:
        pairs, v = finite(series, quantity), answers.verdict_of(series, quantity)
        if len(pairs) < 3 or v is None or v.verdict != "pass" or not v.order > 0.5:
            continue
        if pairs[-1][1] > 30 * FLOOR and (best is None or pairs[-1][1] < best[2]):
            best = (round(v.order), pairs[-1][0].n, pairs[-1][1])
    if best:
        order, n, error = best
        x = np.array([n / 3, n])
        panel.plot(x, error / 3 * (x / n)**-order, back=True, color="currentColor", linewidth=1,
                   alpha=0.55)
        panel.note(x[0], error / 3 * 3**order, f"order {order}")


def draw_failures(site, panel, shown, quantity, where):
    for series in shown:
        look = site.styles.of(series.key)
        for mesh in series.meshes:
            if not math.isfinite(mesh.values.get(quantity, math.nan)) and where(mesh) > 0:
                panel.cross(where(mesh), look["color"], look["gid"])


@dataclass(frozen=True)
class Beside:
    """The curve of another program, next to those of formulations. `points` are [(run time or cost [s], error, row of the
    tooltip)], `columns` are the names of the entries of a row."""
    name: str
    points: list
    columns: tuple
    look: dict


def front_line(point, quantity, beside=()):
    """Returns the corners of the Pareto front of the formulations and the other programs."""
    least, measure = digits_of(point, quantity) or FLOOR, answers.measure_of(point).of
    own = [(1e3 * measure(m), max(clipped(m.errors[quantity]), least)) for _, m in answers.front(point, quantity)]
    theirs = [(1e3 * t, max(clipped(e), least)) for one in beside for t, e, _ in one.points]
    best = []
    for time, error in sorted(own + theirs):
        if not best or error < best[-1][1]:
            best.append((time, error))
    corners = [(b[0], a[1]) for a, b in zip(best, best[1:])]
    return [p for pair in zip(best, corners + [None]) for p in pair if p]


ONE = (520, 280)  # size of the axes of a figure with one panel [pixels]
TWO = (400, 260)  # size of the axes of each of two panels side by side [pixels]
SMALL = (250, 150)  # size of the axes of one of many panels [pixels]


class Limits(Axis):
    """The axis of the numbers of elements, with a strip for the extrapolated limits behind the finest mesh."""

    def __init__(self, finest, count):
        super().__init__(True, True)
        self.finest, self.end = finest, finest * 2.6
        self.places = [finest * (1.7 + 1.8 * i / max(1, count - 1)) for i in range(count)]

    def ticks(self):
        return [(t, f"{t:g}") for t in whole_ticks(self.low, self.finest * 1.01)] + [(self.end, "∞")]


def limit_error(point, series, quantity):
    """Returns (magnitude of the error of the extrapolated limit, relative uncertainty of the limit, verdict), or None."""
    v = answers.verdict_of(series, quantity)
    if v is None or series.missing or not math.isfinite(v.limit) or not math.isfinite(v.error):
        return None
    unknown = v.limit_uncertainty / abs(v.truth) if v.truth and math.isfinite(v.limit_uncertainty) else 0
    return abs(v.error), unknown, v


def draw_limits(site, panel, point, quantity, series, at):
    """Draws the extrapolated limit of a formulation with its uncertainty."""
    found = limit_error(point, series, quantity)
    if found is None:
        return
    error, unknown, v = found
    least = digits_of(point, quantity) or FLOOR
    low, high, y = (min(max(e, least), CEILING) for e in (error - unknown, error + unknown, error))
    unit = point.units.get(quantity, "")
    told = site.points(series.key, (f"limit [{unit}]" if unit else "limit", "uncertainty", "error", "order", "verdict"),
                       [(v.limit, v.limit_uncertainty, float(f"{v.error:.3g}"), order_of(v), v.verdict)],
                       f"{quantity}, limit as n → ∞")
    if high > low:
        panel.plot([at, at], [low, high], back=True, color=told["color"], gid=site.styles.of(series.key)["gid"],
                   linewidth=5, alpha=0.35)
    panel.plot([at], [y], **told, hollow=error < least)


def convergence_figure(site, point, quantity, shown, name):
    """Draws the error against the number of elements, and the extrapolated limits with their uncertainties. Returns None
    if no series has an error."""
    drawn = [s for s in shown if finite(s, quantity)]
    if not drawn and not any(finite(s, quantity) for s in point.others):
        return None
    chart = Chart(1, ONE)
    panel = chart.panel(xlabel="n: elements per member; ∞: extrapolated limit", ylabel=f"relative error of {quantity}",
                        whole=True)
    known = [s for s in drawn if limit_error(point, s, quantity)]
    finest = max(m.n for s in [*drawn, *point.others] for m in s.meshes)
    if known:
        panel.x = Limits(finest, len(known))
        panel.edge(finest * 1.3)
    draw_errors(site, panel, point, quantity, drawn, "elements", True, short=True, orders=True)
    for at, series in zip(panel.x.places if known else (), known):
        draw_limits(site, panel, point, quantity, series, at)
    draw_failures(site, panel, drawn, quantity, lambda m: m.n)
    return chart.image(site, name)


def errors_figure(site, point, quantity, shown, abscissae, name, told=True, beside=(), short=False):
    """Draws the error of one quantity against elements, time, unknowns or work, with a panel for each of the given
    abscissae. Returns None if no series has an error. If `told` is True, the markers have tooltips with their
    values."""
    if not any(finite(s, quantity) for s in [*shown, *point.others]):
        return None
    chart = Chart(len(abscissae), ONE if len(abscissae) == 1 else TWO)
    first = None
    for abscissa in abscissae:
        label, where, whole = against(point, abscissa)
        panel = chart.panel(xlabel=label, ylabel="" if first else f"relative error of {quantity}",
                            whole=whole, like=first)
        first = first or panel
        draw_errors(site, panel, point, quantity, shown, abscissa, told, beside, short)
        draw_failures(site, panel, shown, quantity, where)
    return chart.image(site, name)


def draw_errors(site, panel, point, quantity, shown, abscissa, told, beside=(), short=False, orders=False):
    """If `short` is True, the legend contains short names. If `orders` is True, the legend contains the observed orders of convergence."""
    _, where, _ = against(point, abscissa)
    if abscissa == "time":
        draw_times(site, panel, point, shown, quantity, beside)
    for series in shown:
        draw_series(site, panel, point, series, quantity, where, told=told, short=short, orders=orders)
    for one in beside:
        look = site.points(one.name, one.columns, [row for _, _, row in one.points], quantity)
        panel.plot([1e3 * t for t, _, _ in one.points], [max(clipped(e), FLOOR) for _, e, _ in one.points], label=one.name,
                   **{**one.look, "gid": look["gid"]})
    for i, series in enumerate(point.others):
        pairs = [(where(m), e) for m, e in finite(series, quantity) if where(m) > 0]
        if pairs:  # some data are unknown for other programs
            panel.plot([x for x, _ in pairs], [e for _, e in pairs], label=series.label,
                       **data.style_beside(i))
    if abscissa == "elements":
        slope_triangle(panel, shown, quantity)
    tolerance = tolerance_of(point, quantity)
    if tolerance:
        panel.level(tolerance, f"tolerance {100 * tolerance:.3g} %")


def draw_times(site, panel, point, shown, quantity, beside=()):
    """Draws the front of the best results, and the interval of times of each mesh over its rounds."""
    line = front_line(point, quantity, beside)
    least = digits_of(point, quantity) or FLOOR
    panel.plot([x for x, _ in line], [y for _, y in line], back=True, color="currentColor",
               linewidth=5, alpha=0.15)
    for series in shown:
        look = site.styles.of(series.key)
        for m, e in finite(series, quantity):
            if m.clock.most > 1.02 * m.clock.least:
                panel.plot([1e3 * m.clock.least, 1e3 * m.clock.most], 2 * [max(e, least)], back=True,
                           color=look["color"], gid=look["gid"], linewidth=3, alpha=0.35)


def shown_in_all(point, quantities, errors="errors"):
    """Returns at most MOST_CURVES series: those that are drawn for most of these quantities."""
    if errors != "errors":
        own = [s for s in point.series if any(finite(s, q, errors) for q in quantities)]
        plain = [s for s in own if ":" not in s.key and verdicts.corrected(s.key) is None]
        return (plain or own)[:MOST_CURVES]
    votes = {}
    for quantity in quantities:
        for series in leading(point, quantity)[0]:
            votes[series.key] = votes.get(series.key, 0) + 1
    best = sorted(votes, key=lambda key: -votes[key])[:MOST_CURVES]
    return [s for s in point.series if s.key in best]


def small_multiples(site, point, quantities, name, errors="errors", ylabel="relative error",
                    abscissa="time"):
    """Draws a small panel for each quantity, with the same formulations in all panels."""
    columns = min(3, len(quantities))
    chart = Chart(columns, SMALL if len(quantities) > 1 else ONE, gap=(66, 62))
    label, where, whole = against(point, abscissa)
    shown = shown_in_all(point, quantities, errors)
    for i, quantity in enumerate(quantities):
        last = i + columns >= len(quantities)
        panel = chart.panel(quantity, label if last else "", "" if i % columns else ylabel,
                            whole=whole)
        for series in shown:
            draw_series(site, panel, point, series, quantity, where, errors, markersize=3.5)
    return chart.image(site, name)


def curves(site, point, quantity, name):
    """Draws the curves of at most MOST_CURVES formulations on their finest meshes. Curves over frequency have a
    logarithmic frequency axis, as in a Bode plot. Their value axis is logarithmic if all values are positive."""
    found = [(s, [m for m in s.meshes if quantity in m.curves and len(m.curves[quantity][0])])
             for s in point.series]
    found = sorted((f for f in found if f[1]),
                   key=lambda f: (verdicts.corrected(f[0].key) is not None, ":" in f[0].key))
    if not found:
        return None
    _, _, x_name, x_unit, unit = found[0][1][-1].curves[quantity]
    names = (f"{x_name} [{x_unit}]", f"{quantity} [{unit}]")
    chart = Chart(1, ONE)
    steady = (x_name, x_unit) == ("frequency", "Hz")
    drawn = [(s, m, [(a, b) for a, b in zip(*m[-1].curves[quantity][:2]) if a > 0 or not steady])
             for s, m in found[:MOST_CURVES]]
    positive = all(b > 0 for _, _, pairs in drawn for _, b in pairs)
    panel = chart.panel("", *names, xlog=steady, ylog=steady and positive)
    for series, meshes, pairs in drawn:
        x, value = [a for a, _ in pairs], [b for _, b in pairs]
        marks = range(0, len(x), max(1, len(x) // 12))
        look = site.points(series.key, names, [(float(x[i]), float(value[i])) for i in marks],
                           f"n = {meshes[-1].n}")
        panel.plot(x, value, label=f"{series.label}, n = {meshes[-1].n}", marks=marks,
                   **{**look, "markersize": 3})
    return chart.image(site, name)
