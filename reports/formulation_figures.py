"""Error against elements of a formulation, in the case where it does best and where it does worst."""
import math

from matplotlib.ticker import ScalarFormatter

from reports import answers
from reports.style import plt

FLOOR = 1e-12  # errors below are drawn there
TITLES = ("least", "largest")
WRONG = ("wrong limit", "wrong limit, as predicted")


def curve(series, quantity):
    """[(elements, size of the error)] of the meshes that have one."""
    return [(m.n, max(abs(m.errors[quantity]), FLOOR)) for m in series.meshes
            if math.isfinite(m.errors.get(quantity, math.nan))]


def candidates(found):
    """[(error on the finest mesh, case name, quantity, (case, point, series))] with three meshes at least: the first
    judged quantity of each case, and every one whose limit is known to be wrong."""
    out = []
    for case, point, series in found:
        names = answers.judged(point)[:1]
        names += [v.quantity for v in series.verdicts if v.verdict in WRONG]
        for name in dict.fromkeys(names) if not series.missing else ():
            points = curve(series, name)
            if len(points) >= 3:
                out.append((points[-1][1], case.name, name, (case, point, series)))
    return sorted(out, key=lambda item: item[:3])


def extremes(found):
    """[(case, point, series, quantity)] with the least and the largest error on the finest mesh."""
    known = candidates(found)
    chosen = {known[i][:3]: (*known[i][3], known[i][2]) for i in (0, -1)} if known else {}
    return list(chosen.values())


def panel(axes, site, key, item, title):
    case, point, series, quantity = item
    for other in point.series:
        points = [] if other.missing or other.key == key or ":" in other.key else curve(
            other, quantity)
        if points:
            axes.plot(*zip(*points), color="0.75", linewidth=0.8, zorder=1)
    axes.plot(*zip(*curve(series, quantity)), **{**site.styles.of(key), "linewidth": 2},
                zorder=3)
    axes.set_title(f"{title} error: {case.name}, {quantity}", loc="left", fontsize=9)
    axes.set_yscale("log")
    axes.set_xscale("log", base=2)
    axes.xaxis.set_major_formatter(ScalarFormatter())
    axes.set_xlabel("elements of each member")
    axes.set_ylabel("relative error")


def draw(site, key, items):
    """Two panels; grey: the other formulations."""
    figure, axes = plt.subplots(1, len(items), figsize=(4.8 * len(items), 3.1), squeeze=False)
    for one, item, title in zip(axes[0], items, TITLES):
        panel(one, site, key, item, title)
    figure.subplots_adjust(left=0.62 / (4.8 * len(items)), right=0.99, bottom=0.16, top=0.9,
                           wspace=0.25)
    return figure
