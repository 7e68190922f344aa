"""A page for each case: its scene, what is asked, which formulation answers, one figure per
question, the rest folded."""
import functools
import math

from reports import answers, beside, case_truth, plots, question_figures, scene_drawing
from reports.site import LEVELS, ROOT
from reports.verdicts import UNJUDGED

NAVIGATION = []
MOST_POINTS = 3  # parameter points with a figure
MOST_PANELS = 6  # small figures of the other quantities, and of model errors
# of verdicts on one page; with more, other parameter points have pages of their own
MOST_ROWS = 1500

# Figures about the first quantity, and the formulations that are not in them.
NOTHING = {"elements": None, "time": None, "work": None, "further": None,
           "left_out": []}


def question_of(site, point, quantity, name):
    """{what: image} of the figures about the first quantity."""
    shown, further = plots.leading(point, quantity)

    def draw(series, kind, *abscissae):
        return question_figures.errors_figure(
            site, point, quantity, series, abscissae, f"{name}_{kind}",
            told=len(abscissae) == 1) if series else None

    return {"elements": draw(shown, "elements", "elements"), "time": draw(shown, "time", "time"),
            "work": draw(shown, "work", "unknowns", "work"),
            "further": draw(further[:plots.MOST_CURVES], "further", "elements", "time"),
            "left_out": [s.key for s in further]}


def told_of(point, quantity):
    """Is any of its errors more than round-off?"""
    return any(e > plots.FLOOR for s in point.series for _, e in plots.finite(s, quantity))


def figures_of(site, case, index):
    """What is drawn of one parameter point."""
    point = case.points[index]
    name = f"{case.name}_{point.name}"
    quantities = [q for q in answers.judged(point)
                  if any(plots.finite(s, q) for s in point.series)]
    out = {"main": NOTHING, "others": None, "model": None, "curves": []}
    main = plots.telling(point, quantities) if quantities else None
    out["quantity"] = main
    if index == 0 and quantities:
        out["main"] = question_of(site, point, main, name)
    elif quantities and (index < MOST_POINTS or point.others):
        shown, _ = plots.leading(point, main)
        out["main"] = {**NOTHING, "elements": question_figures.errors_figure(
            site, point, main, shown, ("elements",), name, told=False)}
    others = [q for q in quantities if q != main and told_of(point, q)]
    out["panels_left_out"] = others[MOST_PANELS:]
    if others and index == 0:
        out["others"] = question_figures.small_multiples(site, point, others[:MOST_PANELS],
                                                         f"{name}_others")
    modelled = [q for q in point.units
                if any(plots.finite(s, q, "model_errors") for s in point.series)][:MOST_PANELS]
    if modelled and (index == 0 or point.others):
        out["model"] = question_figures.small_multiples(site, point, modelled, f"{name}_model",
                                                        "model_errors", "model error", "elements")
    if index == 0:
        names = sorted({q for s in point.series for m in s.meshes for q in m.curves})
        drawn = ((q, question_figures.curves(site, point, q, f"{name}_{q}_curve")) for q in names)
        out["curves"] = [(q, image) for q, image in drawn if image]
    return out


def cost_of(cell):
    """Of a way; without one it stands behind all that have one."""
    return cell[0].cost if math.isfinite(cell[0].cost) else math.inf


def table_of(point, quantity):
    """[(formulation, {level: (way, factor to the cheapest, tie)})]: what each formulation needs for
    each level."""
    rows = {}
    for level in LEVELS:
        found = answers.answer(point, quantity, level)
        for w, _, tie in found.ways:
            factor = w.cost / found.best[0].cost if found.best else math.nan
            rows.setdefault(w.key, {})[level] = (w, factor, tie)
    return sorted(rows.items(), key=lambda r: (-len(r[1]), min(map(cost_of, r[1].values())), r[0]))


def cheapest_of(point):
    """[(quantity, {level: answers.Answer})], with all quantities together first."""
    names = answers.judged(point)
    wanted = ([answers.ALL] if len(names) > 1 else []) + names
    return [(q, {level: answers.answer(point, q, level) for level in LEVELS}) for q in wanted]


def limits_of(point):
    """[(quantity, [(formulation, verdict)])] of what no truth speaks of."""
    rows = {}
    for s in point.series:
        for v in s.verdicts:
            rows.setdefault(v.quantity, []).append((s.key, v))
    return [(q, [(key, v) for key, v in found if v.verdict != "skip"]) for q, found in rows.items()
            if q in point.units and all(v.verdict in UNJUDGED for _, v in found)]


def verdicts_of(point, index):
    """[(series, verdicts)] for the table: of the first parameter point all that say something, of
    the others what is not a pass."""
    def told(v):
        own = v.verdict not in ("skip", "no truth", *(("pass",) if index else ()))
        return own or math.isfinite(v.model_truth) and v.verdict != "pass"

    return [(s, [v for v in s.verdicts if told(v)]) for s in point.series]


def causes_of(point):
    """[(rule of the ledger, its cause)] of the verdicts of a point."""
    return sorted({v.finding: v.cause for s in point.series for v in s.verdicts
                   if v.finding and not s.missing}.items())


def parts_of(site, case, index):
    """What a page shows of one parameter point."""
    point = case.points[index]
    names = answers.judged(point)
    noise = [100 * (m.clock.most / m.clock.least - 1) for s in point.series for m in s.meshes
             if m.clock.repeats > 1 and m.clock.least > 0]
    shown, cells = case_truth.matrix(point)
    figures = figures_of(site, case, index)
    main = figures["quantity"] or (names[0] if names else None)
    return {
        "point": point, "figures": figures, "quantity":
            main, "table": table_of(point, main) if main else [],
        "limits": limits_of(point) if index == 0 or not names else [], "others": beside.rows(point), "cheapest": cheapest_of(point),
        "front": answers.front(point, main) if main else [], "failures":
            answers.failures(point), "savings": answers.savings(point), "noise": sorted(noise),
        "causes": causes_of(point), "shown": shown, "cells": cells,
        "verdicts": verdicts_of(point, index), "tally":
            case_truth.tally_of(point), "has_model": any(
                math.isfinite(v.model_error) for s in point.series for v in s.verdicts)
    }


def rows_of(point):
    return sum(len(s.verdicts) for s in point.series)


def own_pages(case):
    """Do its other parameter points have pages of their own?"""
    return sum(rows_of(p) for p in case.points[1:]) > MOST_ROWS


def page_of(case, index):
    """Where a parameter point is shown."""
    point = case.points[index]
    if index and own_pages(case):
        return f"{case.name}_{point.name}.html"
    return f"{case.name}.html#{point.name}"


def signs_of(parts):
    """Of the verdicts that stand in matrices."""
    return {cell.sign for part in parts for _, cells in part["cells"] for cell in cells}


def write(site, case):
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
               drawing=scene_drawing.drawing(site, case),
               quantities=case_truth.quantities(case.points[0]), sections=sections)
    for i, part in enumerate(parts[1:] if apart else (), 1):
        site.write("case_point.html", page_of(case, i), **shared, part=part,
                   signs=signs_of([part]))


def tasks(site):
    return [functools.partial(write, site, case) for case in site.cases]
