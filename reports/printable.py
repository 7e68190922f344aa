"""A convergence report on paper: every case on a sheet, to be printed or attached (A4; headless: chromium --print-to-pdf)."""
import functools
import math

from reports import answers, plots, question_figures
from reports.site import LEVELS

NAVIGATION = [("convergence.html", "to print")]


def sheet(site, case):
    """The first judged quantity of the defaults: its figure, and for each formulation limit, order, errors, time to every level."""
    point = case.points[0]
    names = answers.judged(point)
    if not names:
        return None
    quantity, rows = names[0], []
    for series in point.series:
        v = answers.verdict_of(series, quantity)
        if v is not None and not series.missing:
            rows.append(
                (series.key, v, [answers.way(series, [quantity], level) for level in LEVELS]))
    truth = next((v for _, v, _ in rows if math.isfinite(v.truth)), None)
    if truth is None:
        return None
    image = question_figures.errors_figure(site, point, quantity,
                                           plots.leading(point, quantity)[0],
                                           ("elements", "time"), f"sheet_{case.name}")
    return {
        "case": case, "quantity": quantity, "unit": point.units[quantity],
        "image": image and site.keep(image), "rows": rows, "truth": truth
    }


def write(site):
    sheets = [s for s in (sheet(site, case) for case in site.cases) if s]
    site.write("convergence.html",
               "convergence.html",
               sheets=sheets,
               about=site.about,
               bench=site.bench)


def tasks(site):
    return [functools.partial(write, site)]
