"""Error against elements of a formulation, where it is least and where it is largest."""
import math

from reports import answers
from reports.chart import Chart

FLOOR = 1e-12  # errors below are drawn there
TITLES = ("least", "largest")
WRONG = ("wrong limit", "wrong limit, as predicted")
GREY = {"back": True, "color": "currentColor", "alpha": 0.25, "linewidth": 1}


def curve(series, quantity):
    """[(elements, size of the error)] of the meshes that have one."""
    return [(m.n, max(abs(m.errors[quantity]), FLOOR)) for m in series.meshes
            if math.isfinite(m.errors.get(quantity, math.nan))]


def candidates(found):
    """[(error on the finest mesh, case name, quantity, (case, point, series))] with three meshes at
    least: the first judged quantity of each case, and those whose limit is known to be wrong."""
    out = []
    for case, point, series in found:
        names = answers.judged(point)[:1]
        names += [v.quantity for v in series.verdicts if v.verdict in WRONG]
        for name in dict.fromkeys(names) if not series.missing and not series.other else ():
            points = curve(series, name)
            if len(points) >= 3:
                out.append((points[-1][1], case.name, name, (case, point, series)))
    return sorted(out, key=lambda item: item[:3])


def extremes(found):
    """[(case, point, series, quantity)] with the least and the largest error on the finest mesh."""
    known = candidates(found)
    chosen = {known[i][:3]: (*known[i][3], known[i][2]) for i in (0, -1)} if known else {}
    return list(chosen.values())


def draw(site, key, items, name):
    """Two panels; grey: the other formulations."""
    chart = Chart(2, (380, 230))
    for (case, point, series, quantity), title in zip(items, TITLES):
        one = chart.panel(f"{title}: {case.name}, {quantity}", "elements per member",
                          "relative error", whole=True)
        for other in point.series:
            skipped = other.missing or other.other or other.key == key
            points = [] if skipped else curve(other, quantity)
            if points and ":" not in other.key:
                one.plot(*zip(*points), **GREY)
        own = curve(series, quantity)
        errors = {m.n: m.errors[quantity] for m in series.meshes if quantity in m.errors}
        look = site.points(key, ("n", "error"), [(n, errors[n]) for n, _ in own], case.name)
        one.plot(*zip(*own), **{**look, "linewidth": 2})
    return chart.image(site, name)
