"""On the page of the column: the printed form levels off where it was derived to."""
import math

from reports import answers, plots
from reports.style import plt
from reports.verdicts import OWN_LIMITS

NAVIGATION = []
CASE, POINT, QUANTITY = "c_column", "section_data=printed", "buckling_load"
ALT = "Error of the buckling load against elements: beamw levels off, beamw_consistent goes down"
PAIR = ("beamw", "beamw_consistent")


def words(verdict):
    """A verdict with the size of its error where it has a limit of its own."""
    own = verdict.verdict in OWN_LIMITS
    return f"{verdict.verdict} ({100 * verdict.error:+.3g} %)" if own else verdict.verdict


def draw(axes, series, style):
    """One formulation, its verdict beside its last mesh, its predicted limit dashed."""
    pairs, verdict = plots.finite(series, QUANTITY), answers.verdict_of(series, QUANTITY)
    axes.plot([m.n for m, _ in pairs], [e for _, e in pairs], label=series.key, **style)
    own, colour = verdict.verdict in OWN_LIMITS, style["color"]
    axes.annotate(words(verdict), (pairs[-1][0].n, pairs[-1][1]), textcoords="offset points",
                  xytext=(-4, 6) if own else (-10, -6), ha="right", fontsize=8.5, color=colour)
    if math.isfinite(verdict.predicted):
        axes.axhline(abs(verdict.predicted / verdict.truth - 1), color=colour, linewidth=0.9,
                     linestyle=(0, (4, 3)), zorder=0)


def figure_of(site, point):
    """The figure; None where one of the two was not run."""
    found = {s.key: s for s in point.series}
    if not all(key in found and plots.finite(found[key], QUANTITY) for key in PAIR):
        return None
    figure, axes = plt.subplots(figsize=(6.4, 3.8))
    for key in PAIR:
        draw(axes, found[key], site.styles.of(key))
    axes.set_xlim(1.8, 260)
    plots.log_axes(axes, "elements over the column", "relative error of the buckling load", True)
    axes.legend(loc="lower left")
    return site.image(figure, "column")


def section(site, case):
    point = next((p for p in case.points if p.parameters == POINT), None)
    image = figure_of(site, point) if case.name == CASE and point else None
    if not image:
        return []
    return [("Convergence to a wrong limit, as predicted",
             f'<figure><div class="figure" tabindex="0">{image.inline(ALT)}</div>'
             '<figcaption>J Table 2, printed constants: '
             'the printed second-order modes do not see shear. The limit that follows from the '
             'printed formulas was derived by itself (dashed); the program meets it, and it is not '
             'the exact load, to which the consistent modes converge.</figcaption></figure>')]


def tasks(site):
    del site
    return []
