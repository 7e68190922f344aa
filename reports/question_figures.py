"""Figures of a case, each for one question: errors of a quantity, those of the others, curves of
paths."""
from reports import beside, plots, tally
from reports.chart import Chart
from reports.plots import MOST_CURVES, finite

ONE = (520, 280)  # axes of a figure with one panel [pixels]
TWO = (400, 260)  # of each of two beside each other
SMALL = (250, 150)  # of one among many


def errors_figure(site, point, quantity, shown, abscissae, name, told=True):
    """Error of one quantity against elements, time, unknowns or work, a panel for each that is
    named. None when there is no error. told: marks say what was found."""
    if not any(finite(s, quantity) for s in [*shown, *point.others]):
        return None
    chart = Chart(len(abscissae), ONE if len(abscissae) == 1 else TWO)
    first = None
    for abscissa in abscissae:
        label, where, whole = plots.against(point, abscissa)
        panel = chart.panel(xlabel=label, ylabel="" if first else f"relative error of {quantity}",
                            whole=whole, like=first)
        first = first or panel
        draw_errors(site, panel, point, quantity, shown, abscissa, told)
        plots.draw_failures(site, panel, shown, quantity, where)
    return chart.image(site, name)


def draw_errors(site, panel, point, quantity, shown, abscissa, told):
    _, where, _ = plots.against(point, abscissa)
    if abscissa == "time":
        draw_times(site, panel, point, shown, quantity)
    for series in shown:
        plots.draw_series(site, panel, point, series, quantity, where, told=told)
    for i, series in enumerate(point.others):
        pairs = [(where(m), e) for m, e in finite(series, quantity) if where(m) > 0]
        if pairs:  # not everything is said of other programs
            panel.plot([x for x, _ in pairs], [e for _, e in pairs], label=series.label,
                       **beside.style(i))
    if abscissa == "elements":
        plots.slope_triangle(panel, shown, quantity)
    tolerance = plots.tolerance_of(point, quantity)
    if tolerance:
        panel.level(tolerance, "tolerance")


def draw_times(site, panel, point, shown, quantity):
    """The front that nothing beats, and the noise of times."""
    line = plots.front_line(point, quantity)
    panel.plot([x for x, _ in line], [y for _, y in line], back=True, color="currentColor",
               linewidth=5, alpha=0.15)
    for series in shown:
        look = site.styles.of(series.key)
        for m, e in finite(series, quantity):
            if m.clock.most > 1.02 * m.clock.least:
                panel.plot([1e3 * m.clock.least, 1e3 * m.clock.most], [e, e], back=True,
                           color=look["color"], gid=look["gid"], linewidth=3, alpha=0.35)


def shown_in_all(point, quantities, errors="errors"):
    """At most MOST_CURVES: those that are drawn of most of these quantities."""
    if errors != "errors":
        own = [s for s in point.series if any(finite(s, q, errors) for q in quantities)]
        plain = [s for s in own if ":" not in s.key and tally.corrected(s.key) is None]
        return (plain or own)[:MOST_CURVES]
    votes = {}
    for quantity in quantities:
        for series in plots.leading(point, quantity)[0]:
            votes[series.key] = votes.get(series.key, 0) + 1
    best = sorted(votes, key=lambda key: -votes[key])[:MOST_CURVES]
    return [s for s in point.series if s.key in best]


def small_multiples(site, point, quantities, name, errors="errors", ylabel="relative error",
                    abscissa="time"):
    """One small panel for each quantity, the same formulations in all."""
    columns = min(3, len(quantities))
    chart = Chart(columns, SMALL if len(quantities) > 1 else ONE, gap=(66, 62))
    label, where, whole = plots.against(point, abscissa)
    shown = shown_in_all(point, quantities, errors)
    for i, quantity in enumerate(quantities):
        last = i + columns >= len(quantities)
        panel = chart.panel(quantity, label if last else "", "" if i % columns else ylabel,
                            whole=whole)
        for series in shown:
            plots.draw_series(site, panel, point, series, quantity, where, errors, markersize=3.5)
    return chart.image(site, name)


def curves(site, point, quantity, name):
    """The curve of every formulation on its finest mesh, of MOST_CURVES at most."""
    found = [(s, [m for m in s.meshes if quantity in m.curves and len(m.curves[quantity][0])])
             for s in point.series]
    found = sorted((f for f in found if f[1]),
                   key=lambda f: (tally.corrected(f[0].key) is not None, ":" in f[0].key))
    if not found:
        return None
    _, _, x_name, x_unit, unit = found[0][1][-1].curves[quantity]
    names = (f"{x_name} [{x_unit}]", f"{quantity} [{unit}]")
    chart = Chart(1, ONE)
    panel = chart.panel("", *names, xlog=False, ylog=False)
    for series, meshes in found[:MOST_CURVES]:
        x, value = meshes[-1].curves[quantity][:2]
        marks = range(0, len(x), max(1, len(x) // 12))
        look = site.points(series.key, names, [(float(x[i]), float(value[i])) for i in marks],
                           f"n = {meshes[-1].n}")
        panel.plot(x, value, label=f"{series.label}, n = {meshes[-1].n}", marks=marks,
                   **{**look, "markersize": 3})
    return chart.image(site, name)
