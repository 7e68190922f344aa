"""Error against elements of a formulation, in the case where it does best and where it does worst."""
import math

from reports import answers
from reports.style import plt

FLOOR = 1e-12  # errors below are drawn there
TITLES = ("least", "largest")


def curve(series, quantity):
    """[(elements, size of the error)] of the meshes that have one."""
    return [(m.n, max(abs(m.errors[quantity]), FLOOR)) for m in series.meshes
            if math.isfinite(m.errors.get(quantity, math.nan))]


def candidates(found):
    """[(last error, case, point, series, quantity)]: first judged quantity of each case, three meshes."""
    out = []
    for case, point, series in found:
        names = answers.judged(point)
        if series.missing or not names:
            continue
        points = curve(series, names[0])
        if len(points) >= 3:
            out.append((points[-1][1], case.name, case, point, series, names[0]))
    return sorted(out, key=lambda item: item[:2])


def extremes(found):
    """[(case, point, series, quantity)] with the least and the largest error on the finest mesh."""
    known = candidates(found)
    if not known:
        return []
    chosen = [known[0], known[-1]] if len(known) > 1 else known
    return [item[2:] for item in chosen]


def panel(axes, site, key, item, title):
    case, point, series, quantity = item
    for other in point.series:
        points = [] if other.missing or other.key == key or ":" in other.key else curve(
            other, quantity)
        if points:
            axes.loglog(*zip(*points), color="0.75", linewidth=0.8, zorder=1)
    axes.loglog(*zip(*curve(series, quantity)), **{**site.styles.of(key), "linewidth": 2},
                zorder=3)
    axes.set_title(f"{title} error: {case.name}, {quantity}", loc="left", fontsize=9)
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
