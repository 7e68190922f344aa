"""Profiles as figures, and as a table for other programs."""
import csv
import os

from reports.axis import Axis
from reports.chart import Chart
from reports.problems import to_the_best
from reports.profiles import FARTHEST, PICTURES, places
from reports.site import LEVELS
from reports.style import plt

XLABELS = {
    ("cost", True): "factor to the least cost of all",
    ("unknowns", True): "factor to the fewest unknowns of all",
    ("cost", False): "cost, by the cheapest run",
    ("unknowns", False): "unknowns, by the smallest model",
}


def xlabel(picture):
    return XLABELS[picture.count, picture.unit is to_the_best]


def marks_of(site, key, at, shares, marked):
    """What plot() wants for a curve whose marks say the share, and what is solved at any cost."""
    rows = [(f"{x:g}", f"{100 * share:.1f} %", f"{100 * shares[-1]:.1f} %")
            for x, share in list(zip(at, shares))[marked]]
    return site.points(key, ("factor", "solved", "at any cost"), rows)


def legend_of(site, keys, name="profile_legend"):
    """One legend for all figures of the page."""
    columns = min(2, len(keys))
    figure, axes = plt.subplots(figsize=(1.95 * columns, 0.22 * -(-len(keys) // columns) + 0.06))
    lines = [axes.plot([], [], label=key, **site.styles.of(key))[0] for key in keys]
    axes.set_axis_off()
    figure.subplots_adjust(left=0, right=1, top=1, bottom=0)
    figure.legend(lines, keys, loc="center left", ncol=columns, borderaxespad=0, fontsize=9)
    return site.image(figure, name, tight=False)


class Fixed(Axis):
    """An axis whose limits and ticks are given. ticks: [(value, words)]"""

    def __init__(self, log, limits, ticks):
        super().__init__(log)
        self.low, self.high = limits
        self.given = ticks

    def take(self, values):
        """Nothing moves it."""

    def settle(self):
        """It is."""

    def ticks(self):
        return self.given


def factors(farthest):
    ticks = [s * 10**i for i in range(4) for s in ((1, 2, 5) if farthest <= 100 else (1,))]
    return Fixed(True, (1, farthest), [(x, f"{x:g}") for x in ticks if x <= farthest])


def stairs(at, shares):
    """Corners of the curve: a share holds from its factor on."""
    xs, ys = [at[0]], [shares[0]]
    for x, y in zip(at[1:], shares[1:]):
        if y != ys[-1]:
            xs += [x, x]
            ys += [ys[-1], y]
    return xs + [at[-1]], ys + [ys[-1]]


def figure_of(site, picture, curves, keys, name, size=(250, 175)):
    """curves: {formulation: shares at places}; size: of the axes, in pixels."""
    at = places(FARTHEST[picture.unit])
    chart = Chart(1, size)
    panel = chart.panel(xlabel=xlabel(picture), ylabel="share of problems")
    panel.x = factors(at[-1])
    panel.y = Fixed(False, (0, 1), [(i / 5, f"{20 * i} %") for i in range(6)])
    for i, key in enumerate(keys):
        marked = slice(i, None, len(keys))
        look = marks_of(site, key, at, curves[key], marked)
        panel.plot(*stairs(at, curves[key][:-1]), **{**look, "marker": None, "gid": f"f|{key}"})
        panel.plot(at[marked], curves[key][:-1][marked], **{**look, "linestyle": "none"})
    return chart.image(site, name)


def write_table(site, compared, name="profiles.csv"):
    """Every curve, drawn or not; at factor "any": what is solved at all."""
    path = os.path.join(site.folder, name)
    with open(f"{path}.part", "w", encoding="utf-8", newline="") as out:
        table = csv.writer(out)
        table.writerow(["picture", "level", "factor", *compared.keys])
        for picture in PICTURES:
            at = [f"{x:g}" for x in places(FARTHEST[picture.unit])] + ["any"]
            for level in LEVELS:
                curves = compared.profile(picture.question(level), picture.offered)
                for i, x in enumerate(at):
                    found = (f"{curves[key][i]:.5g}" for key in compared.keys)
                    table.writerow([picture.name, level, x, *found])
    os.replace(f"{path}.part", path)
    return name
