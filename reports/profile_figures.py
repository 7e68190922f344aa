"""Profiles as figures, and as a table for other programs."""
import csv
import os

from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator, PercentFormatter

from reports.problems import to_the_best
from reports.profiles import FARTHEST, PICTURES, places
from reports.site import LEVELS
from reports.style import plt

XLABELS = {
    ("time", True): "factor to the least time of all",
    ("unknowns", True): "factor to the fewest unknowns of all",
    ("time", False): "time, by that of the cheapest run of the structure",
    ("unknowns", False): "unknowns, by those of its smallest model",
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
    columns = min(4, len(keys))
    figure, axes = plt.subplots(figsize=(1.95 * columns, 0.22 * -(-len(keys) // columns) + 0.06))
    lines = [axes.plot([], [], label=key, **site.styles.of(key))[0] for key in keys]
    axes.set_axis_off()
    figure.subplots_adjust(left=0, right=1, top=1, bottom=0)
    figure.legend(lines, keys, loc="center left", ncol=columns, borderaxespad=0, fontsize=9)
    return site.image(figure, name, tight=False)


def figure_of(site, picture, curves, keys, name, size=(4.4, 3.0)):
    """curves: {formulation: shares at places}. Steps: a share holds from its factor on."""
    farthest = FARTHEST[picture.unit]
    at = places(farthest)
    figure, axes = plt.subplots(figsize=size)
    for i, key in enumerate(keys):
        axes.plot(at, curves[key][:-1], drawstyle="steps-post", markevery=(i, len(keys)),
                  label=key, **marks_of(site, key, at, curves[key], slice(i, None, len(keys))))
    axes.set_xscale("log")
    axes.set_xlim(1, farthest)
    axes.set_ylim(0, 1.005)
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5) if farthest <= 100 else (1,)))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    axes.yaxis.set_major_formatter(PercentFormatter(1))
    axes.set_xlabel(xlabel(picture))
    axes.set_ylabel("share of problems")
    width, height = size
    figure.subplots_adjust(left=0.62 / width, right=1 - 0.15 / width, top=1 - 0.1 / height,
                           bottom=0.5 / height)
    return site.image(figure, name, tight=False)


def write_table(site, compared, name="profiles.csv"):
    """Every curve, of all the formulations, drawn or not; at factor "any": what is solved at all."""
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
