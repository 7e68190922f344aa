"""Writes a page for each case with its scene, quantities, formulations of lowest cost, figures and verdicts, and a
page of all cases for printing."""
import functools
import math
from dataclasses import dataclass

from reports import agreed, answers, data, model, peers
from reports.figures import plots
from reports.answers import LEVELS
from reports.structure_drawing import describe, draw, scene
from reports.site import ROOT
from reports.verdicts import BY_NAME, UNJUDGED, percent, remarks


@dataclass
class Drawing:
    figure: object
    sections: object
    counts: str
    lines: list


def drawing(site, case):
    read = scene.read(case.points[0].scene)
    if read is None:
        return None
    beside = draw.compose_sections(read)
    return Drawing(draw.compose(read).image(site, f"{case.name}_scene"),
                   beside.image(site, f"{case.name}_sections") if beside else None,
                   describe.counts(read), describe.describe(read))


MOST_DIGITS = 15


@dataclass(frozen=True)
class Truth:
    """A reference value of a quantity, as text in the unit of the quantity. `digits` is the number of known significant
    digits."""
    value: str
    digits: int
    kind: str
    theory: str
    source: str


@dataclass
class Quantity:
    """A quantity of a point. `meaning` is its description. `truths` are its reference values, or an empty list if there
    are none. `is_curve` is True if a run stored a curve of the quantity."""
    name: str
    unit: str
    meaning: str
    truths: list
    is_curve: bool


def digits_of(value, uncertainty):
    """Returns the number of significant digits of a reference value that its uncertainty permits, from 1 to
    MOST_DIGITS."""
    if not value or not uncertainty:
        return MOST_DIGITS
    return max(1, min(MOST_DIGITS, math.floor(math.log10(abs(value) / uncertainty))))


def truths_of(point, name):
    out = {}
    for series in point.series:
        v = answers.verdict_of(series, name)
        if v and math.isfinite(v.truth):
            digits = digits_of(v.truth, v.truth_uncertainty)
            truth = Truth(f"{v.truth:.{min(10, digits)}g}", digits, v.truth_kind, v.theory,
                          v.source)
            out.setdefault((truth.value, truth.source), truth)
    return list(out.values())


def quantities(point):
    curves = {q for s in point.series for m in s.meshes for q in m.curves}
    names = dict.fromkeys([*point.meanings, *point.units])
    return [Quantity(name, point.units[name], point.meanings.get(name, ""),
                     truths_of(point, name), name in curves) for name in names
            if name in point.units]


@dataclass
class Cell:
    """A cell of the matrix of verdicts. `look` is its class in the style sheet, which is `skip` without a verdict."""
    sign: str
    look: str
    words: str


def away(v):
    if not math.isfinite(v.model_error):
        return []
    return [f"{percent(v.model_error)} from the {v.model_truth_kind} value"]


def cell_of(series, name):
    v = None if series.missing else answers.verdict_of(series, name)
    if v is None or v.verdict in UNJUDGED:
        if series.other and v is not None:
            return Cell("○", "model", "; ".join([series.without, *away(v)]))
        why = f"does not support {series.missing}" if series.missing else v.verdict if v else ""
        return Cell("·", "skip", why)
    kind = BY_NAME[v.verdict]
    words = [v.verdict, *remarks(v)] + ([f"known: {v.finding}"] if v.finding else [])
    return Cell(kind.sign, kind.look, "" if v.verdict == "pass" else "; ".join(words))


def matrix(point):
    """Returns (series with verdicts, [(quantity, cells)]), with one cell per series."""
    names = answers.judged(point)
    shown = [s for s in point.series if any(cell_of(s, n).look != "skip" for n in names)]
    return shown, [(name, [cell_of(s, name) for s in shown]) for name in names]


def tally_of(point):
    counts = {}
    for series in point.series:
        for v in series.verdicts:
            if v.verdict not in UNJUDGED and not series.missing:
                counts[v.verdict] = counts.get(v.verdict, 0) + 1
    return [(kind, counts[name]) for name, kind in BY_NAME.items() if name in counts]


NAVIGATION = [("convergence.html", "to print")]
MOST_POINTS = 3  # number of points with figures; later points have figures only if they have values of other programs
MOST_PANELS = 6  # largest number of panels in the figure of the other quantities, and in that of model errors
# Largest number of verdicts at the parameter points other than the first for which these points are on the page of the
# case. With more verdicts, each of these points has a separate page.
MOST_ROWS = 1500
MOST_ON_PAGE = 30  # largest number of parameter points on one page

NOTHING = {"elements": None, "time": None, "work": None, "further": None,
           "beside": [], "starred": False, "untimed": [], "left_out": []}


def question_of(site, case, point, quantity, name):
    """Returns the figures of one quantity, {figure: Image or None}. `left_out` contains the formulations that are shown
    only in the figure `further` or not at all."""
    beside = peers.beside(site, case, point, quantity)
    shown, further = plots.leading(point, quantity, plots.MOST_CURVES - min(3, len(beside)))

    def draw(series, kind, *abscissae):
        return plots.errors_figure(
            site, point, quantity, series, abscissae, f"{name}_{kind}",
            told=len(abscissae) == 1) if series else None

    return {"elements": plots.convergence_figure(site, point, quantity, shown, f"{name}_elements"),
            "time": plots.errors_figure(site, point, quantity, shown, ("time",), f"{name}_time", beside=beside, short=True),
            "starred": any(s.other for s in shown),
            "untimed": [s.key for s in shown if not any(math.isfinite(answers.measure_of(point).of(m)) for m in s.meshes)],
            "beside": [one.name for one in beside],
            "work": draw(shown, "work", "unknowns", "work"),
            "further": draw(further[:plots.MOST_CURVES], "further", "elements", "time"),
            "left_out": [s.key for s in further]}


def told_of(point, quantity):
    return any(e > plots.FLOOR for s in point.series for _, e in plots.finite(s, quantity))


def figures_of(site, case, index, point):
    """Returns the figures of a point as a dictionary. `point` is the result of agreed.ranked()."""
    name = f"{case.name}_{point.name}"
    quantities = [q for q in answers.judged(point)
                  if any(plots.finite(s, q) for s in point.series)]
    out = {"main": NOTHING, "others": None, "model": None, "curves": []}
    main = plots.telling(point, quantities) if quantities else None
    out["quantity"] = main
    if index == 0 and quantities:
        out["main"] = question_of(site, case, point, main, name)
    elif quantities and (index < MOST_POINTS or point.others):
        shown, _ = plots.leading(point, main)
        out["main"] = {**NOTHING, "elements": plots.errors_figure(
            site, point, main, shown, ("elements",), name, told=False)}
    others = [q for q in quantities if q != main and told_of(point, q)]
    out["panels_left_out"] = others[MOST_PANELS:]
    if others and index == 0:
        out["others"] = plots.small_multiples(site, point, others[:MOST_PANELS],
                                              f"{name}_others")
    taken = quantities if point is not case.points[index] else ()  # agreed limits are not results of another model
    modelled = [q for q in point.units if q not in taken and any(plots.finite(s, q, "model_errors") for s in point.series)][:MOST_PANELS]
    if modelled and (index == 0 or point.others):
        out["model"] = plots.small_multiples(site, point, modelled, f"{name}_model",
                                             "model_errors", "model error", "elements")
    if index == 0:
        names = sorted({q for s in point.series for m in s.meshes for q in m.curves})
        drawn = ((q, plots.curves(site, point, q, f"{name}_{q}_curve")) for q in names)
        out["curves"] = [(q, image) for q, image in drawn if image]
    return out


def cost_of(cell):
    return cell[0].cost if math.isfinite(cell[0].cost) else math.inf


def table_of(point, quantity):
    """Returns [(formulation, {level: (way, cost relative to the cheapest, tie)})]: the mesh and cost that each
    formulation needs for each level."""
    rows = {}
    for level in LEVELS:
        found = answers.answer(point, quantity, level)
        for w, _, tie in found.ways:
            factor = w.cost / found.best[0].cost if found.best else math.nan
            rows.setdefault(w.key, {})[level] = (w, factor, tie)
    return sorted(rows.items(), key=lambda r: (-len(r[1]), min(map(cost_of, r[1].values())), r[0]))


def cheapest_of(point):
    """Returns [(quantity, {level: answers.Answer})]. If there are several quantities, answers.ALL comes first."""
    names = answers.judged(point)
    wanted = ([answers.ALL] if len(names) > 1 else []) + names
    return [(q, {level: answers.answer(point, q, level) for level in LEVELS}) for q in wanted]


def steps_of(cheapest):
    """Returns [(level, answers.Way, cost relative to that of 1 %)] of the levels below 1 %, for the first row of
    cheapest_of(). The ratio states what a tenfold smaller error costs."""
    found = cheapest[0][1] if cheapest else {}
    first = found[0.01].best if found else []
    return [(level, found[level].best[0], found[level].best[0].cost / first[0].cost) for level in (0.001, 0.0001)
            if first and found[level].best]


def limits_of(point):
    rows = {}
    for s in point.series:
        for v in s.verdicts:
            rows.setdefault(v.quantity, []).append((s.key, v))
    return [(q, [(key, v) for key, v in found if v.verdict != "skip"]) for q, found in rows.items()
            if q in point.units and all(v.verdict in UNJUDGED for _, v in found)]


def verdicts_of(point, index):
    """Returns [(series, verdicts)] for the table. Passes are listed only at the first parameter point (index 0). Records
    without a reference value are listed only if another model has a value."""
    def told(v):
        own = v.verdict not in ("skip", "no truth", *(("pass",) if index else ()))
        return own or math.isfinite(v.model_truth) and v.verdict != "pass"

    return [(s, [v for v in s.verdicts if told(v)]) for s in point.series]


def causes_of(point):
    return sorted({v.finding: v.cause for s in point.series for v in s.verdicts
                   if v.finding and not s.missing}.items())


def parts_of(site, case, index):
    point = case.points[index]
    ranked = agreed.ranked(point)
    cheapest = cheapest_of(ranked)
    names = answers.judged(point)
    noise = [100 * (m.clock.most / m.clock.least - 1) for s in point.series for m in s.meshes
             if m.clock.repeats > 1 and m.clock.least > 0]
    shown, cells = matrix(point)
    figures = figures_of(site, case, index, ranked)
    main = figures["quantity"] or (names[0] if names else None)
    return {
        "agreements": agreed.agreements(point), "without": agreed.without_any(point), "agreed": ranked is not point,
        "curves": sorted({q for s in point.series for m in s.meshes for q in m.curves}),
        "measure": answers.measure_of(point), "reference": next(iter(truths_of(ranked, main)), None) if main else None,
        "point": point, "figures": figures, "quantity":
            main, "table": table_of(ranked, main) if main else [],
        "limits": limits_of(point) if index == 0 or not names else [], "others": data.rows_beside(point), "cheapest":
        cheapest, "steps": steps_of(cheapest),
        "front": answers.front(ranked, main) if main else [], "failures":
            answers.failures(point), "savings": answers.savings(point), "noise": sorted(noise),
        "causes": causes_of(point), "shown": shown, "cells": cells,
        "verdicts": verdicts_of(point, index), "tally":
            tally_of(point), "has_model": any(
                math.isfinite(v.model_error) for s in point.series for v in s.verdicts)
    }


def rows_of(point):
    return sum(len(s.verdicts) for s in point.series)


def own_pages(case):
    return sum(rows_of(p) for p in case.points[1:]) > MOST_ROWS or len(case.points) > MOST_ON_PAGE


def page_of(case, index):
    point = case.points[index]
    if index and own_pages(case):
        return f"{case.name}_{point.name}.html"
    return f"{case.name}.html#{point.name}"


def parts_best(case):
    """Returns the answers.Way of lowest cost to 1 % in all quantities at the default parameters, followed by the
    ways of other formulations. If there are no such ways, returns the series with a run."""
    point = agreed.ranked(case.points[0])
    found = answers.answer(point, answers.ALL, 0.01)
    ways = found.best + found.dearer + found.unranked + found.defective if answers.judged(point) else []
    return ways or [s for s in point.series if s.meshes and not s.missing]


def signs_of(parts):
    return {cell.sign for part in parts for _, cells in part["cells"] for cell in cells}


def write(site, case):
    best = next((w.key for w in parts_best(case)), None)
    sections = [found for section in site.sections for found in section(site, case)]
    parts = [parts_of(site, case, i) for i in range(len(case.points))]
    at = site.cases.index(case)
    shared = {
        "case": case, "differ": answers.differ,
        "timed": site.bench is not None, "before": site.cases[at - 1] if at else None,
        "after": site.cases[at + 1] if at + 1 < len(site.cases) else None, "all_of": answers.ALL
    }
    shared["stored"] = any((ROOT / "cases" / name).is_file()
                           for name in (f"{case.name}.c", f"{case.name}.yaml",
                                        f"examples/{case.name}.yaml"))
    apart = own_pages(case)
    site.write("case.html", f"{case.name}.html", **shared, part=parts[0],
               further=[] if apart else parts[1:],
               signs=signs_of(parts[:1] if apart else parts),
               places=[(part, page_of(case, i)) for i, part in enumerate(parts)],
               model=model.of(site.results, case, case.points[0], best) if best else None,
               omissions=model.omissions(case.points[0]),
               drawing=drawing(site, case),
               quantities=quantities(case.points[0]), sections=sections)
    for i, part in enumerate(parts[1:] if apart else (), 1):
        site.write("case_point.html", page_of(case, i), **shared, part=part,
                   signs=signs_of([part]))


def tasks(site):
    return [functools.partial(write_sheets, site),
            *(functools.partial(write, site, case) for case in site.cases)]



def sheet(site, case):
    """Returns the sheet of the first quantity with a reference value at the default parameters, or None. It contains the
    name of a figure and [(formulation, verdict, [answers.Way or None for each level])]."""
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
    image = plots.errors_figure(site, point, quantity,
                                plots.leading(point, quantity)[0],
                                ("elements", "time"), f"sheet_{case.name}")
    return {
        "case": case, "quantity": quantity, "unit": point.units[quantity],
        "image": image and site.keep(image), "rows": rows, "truth": truth
    }


def write_sheets(site):
    sheets = [s for s in (sheet(site, case) for case in site.cases) if s]
    site.write("convergence.html",
               "convergence.html",
               sheets=sheets,
               about=site.about,
               bench=site.bench)
