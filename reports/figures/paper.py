"""Draws the charts and figures of the report again with matplotlib, for papers: PDF, PGF (for LaTeX), PNG or SVG.

A style file of matplotlib changes sizes, fonts and colours of text, grids and lines. Its `figure.figsize` replaces the
size of the charts. The colour and marker of a formulation are those of the report."""
import io
import math
import os
import shutil

import matplotlib
from matplotlib.ticker import FixedFormatter, FixedLocator, LogFormatterMathtext, NullLocator

from reports.figures.style import plt

FORMATS = ("pdf", "pgf", "png", "svg")
FOLDER = "figures"  # subfolder of the report folder
PIXELS = 96
LEGEND = 3  # largest number of columns of a legend
TEX = ("xelatex", "pdflatex", "lualatex")


class Impossible(Exception):
    """Raised if the requested case, format or style is not possible. The text is one line with the remedy."""


class Paper:
    """Writes figures to `folder`/figures. `formats` are some of FORMATS. `cases` are the names of all cases. `only` is
    the case whose figures are written (default: all). `sized` is True if the style file sets the size of figures."""

    def __init__(self, folder, cases, formats=(), style=None, only=None):
        self.folder, self.formats, self.sized = os.path.join(folder, FOLDER), formats, False
        self.cases, self.only = sorted(cases, key=len, reverse=True), only
        if only and only not in cases:
            raise Impossible(f"the results have no case '{only}'; cases: {', '.join(sorted(cases))}")
        if style:
            self.sized = "figure.figsize" in use(style)
        if "pgf" in formats:
            try_latex()
        if formats:
            os.makedirs(self.folder, exist_ok=True)

    def wants(self, name):
        case = next((c for c in self.cases if name.startswith(c)), None)
        return self.formats and self.only in (None, case)

    def chart(self, chart, name):
        if self.wants(name):
            figure = figure_of(chart, self.sized)
            self.figure(figure, name)
            plt.close(figure)

    def figure(self, figure, name):
        """Writes a figure of matplotlib, without a date, so that equal results give equal files."""
        undated = {"pdf": {"metadata": {"CreationDate": None}}, "svg": {"metadata": {"Date": None}}}
        for form in self.formats if self.wants(name) else ():
            figure.savefig(os.path.join(self.folder, f"{name}.{form}"), format=form, bbox_inches="tight",
                           **undated.get(form, {}))


def try_latex():
    """Raises Impossible if no program can measure text for PGF figures."""
    remedy = "run: sudo apt-get install texlive-latex-recommended texlive-pictures"
    found = next((t for t in TEX if shutil.which(t)), None)
    if not found:
        raise Impossible(f"PGF figures require LaTeX, which measures their text; {remedy}")
    matplotlib.rcParams["pgf.texsystem"] = found
    try:
        figure = plt.figure()
        figure.text(0, 0, "x")
        figure.savefig(io.BytesIO(), format="pgf")
    except Exception as why:
        raise Impossible(f"PGF figures: {found} fails ({str(why).splitlines()[0]}); {remedy}") from why
    finally:
        plt.close("all")


def use(path):
    """Applies a style file. Returns its entries. Raises Impossible if the file cannot be read or an entry is unknown or
    invalid."""
    try:
        with open(path, encoding="utf-8") as file:
            lines = [line.partition("#")[0].strip() for line in file]
    except (OSError, UnicodeError) as why:
        raise Impossible(f"{path}: {getattr(why, 'strerror', None) or 'not a text file'}") from why
    entries = {}
    for number, line in enumerate(lines, 1):
        key, _, value = (part.strip() for part in line.partition(":"))
        if not line:
            continue
        try:
            matplotlib.rcParams[key] = value.strip('"')
        except (KeyError, ValueError) as why:
            raise Impossible(f"{path}:{number}: '{line}' is not an entry of a matplotlib style; "
                             "see matplotlib's 'Customizing Matplotlib with style sheets'") from why
        entries[key] = value
    return entries


def figure_of(chart, sized):
    columns = min(chart.columns, len(chart.panels))
    rows = math.ceil(len(chart.panels) / columns)
    size = None if sized else ((chart.size[0] + 70) * columns / PIXELS, (chart.size[1] + 60) * rows / PIXELS)
    figure, grid = plt.subplots(rows, columns, squeeze=False, figsize=size, layout="constrained")
    places = list(grid.flat)
    for axes in places[len(chart.panels):]:
        axes.remove()
    for axes, panel in zip(places, chart.panels):
        draw(axes, panel)
        if chart.apart and legend_of([axes]):
            lines, names = legend_of([axes])
            axes.legend(lines, names)
    drawn = legend_of(places[:len(chart.panels)])
    if drawn and not chart.apart and len(drawn[0]) > 1:
        put_legend(figure, *drawn)
    return figure


def put_legend(figure, lines, names):
    for columns in range(min(LEGEND, len(names)), 0, -1):
        legend = figure.legend(lines, names, loc="upper center", bbox_to_anchor=(0.5, 0), ncols=columns)
        width = legend.get_window_extent(figure.canvas.get_renderer()).width
        if columns == 1 or width <= figure.bbox.width:
            return
        legend.remove()


def legend_of(panels):
    found = {}
    for axes in panels:
        for line, name in zip(*axes.get_legend_handles_labels()):
            if name not in found or found[name].get_marker() in ("", "None", None):
                found[name] = line
    return (list(found.values()), list(found)) if found else None


def draw(axes, panel):
    """Draws a panel (chart.Panel). Its axes must have their final limits."""
    scale(axes.xaxis, panel.x, axes.set_xscale, axes.set_xlim)
    scale(axes.yaxis, panel.y, axes.set_yscale, axes.set_ylim)
    if panel.shares:
        axes.tick_params(labelleft=False)
    axes.set(title=panel.title, xlabel=panel.xlabel, ylabel=panel.ylabel)
    if panel.below:
        axes.axhspan(panel.y.low, panel.below, color="black", alpha=0.07, linewidth=0)
    for x, y, look in panel.back:
        curve(axes, x, y, {**look, "label": None, "zorder": 1.5})
    for x, y, look in panel.curves:
        curve(axes, x, y, look)
    for x, color, _ in panel.crosses:
        axes.plot([x], [1], marker="x", color=ink(color), linestyle="none", clip_on=False,
                  transform=axes.get_xaxis_transform())
    for y, words in panel.lows:
        axes.axhline(y, color="black", linestyle=":", linewidth=0.8, alpha=0.6)
        axes.annotate(words, (1, y), (0, 2), ha="right", fontsize="small",
                      xycoords=axes.get_yaxis_transform(), textcoords="offset points")
    for x, y, words in panel.words:
        axes.annotate(words, (x, y), ha="right", fontsize="small")


def scale(axis, of, set_scale, set_limits):
    set_scale("log" if of.log else "linear")
    set_limits(of.low, of.high)
    at, words = zip(*of.ticks()) if of.ticks() else ((), ())
    axis.set_major_locator(FixedLocator(at))
    axis.set_minor_locator(NullLocator())
    powers = of.log and not of.whole and all(math.log10(x) % 1 in (0, 1) for x in at)
    axis.set_major_formatter(LogFormatterMathtext() if powers else FixedFormatter(words))


def ink(colour):
    return "black" if colour == "currentColor" else colour


def curve(axes, x, y, look):
    marks = look.get("marks")
    every = {"-end": [len(x) - 1], "-start": [0], "-mid": list(range(1, len(x) - 1))}.get(look.get("where"), marks)
    known = {name: look[name] for name in ("linewidth", "alpha", "markersize", "zorder") if look.get(name)}
    axes.plot(x, y, color=ink(look["color"]), linestyle=look.get("linestyle", "-"),
              marker=look.get("marker") or "", label=look.get("label"),
              markerfacecolor="white" if look.get("hollow") else None,
              markevery=None if every is None else list(every), **known)
