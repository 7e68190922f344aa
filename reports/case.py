"""A page for each case: errors against work, the cheapest way to each error, curves, verdicts of every parameter point, failures, what was left out."""
import functools
import math

from reports import answers, beside, plots
from reports.site import LEVELS

NAVIGATION = []
MOST_POINTS = 4  # parameter points with a figure
MOST_PANELS = 24  # small figures of the other quantities


def figures_of(site, case, index):
    """{kind: [(caption, file)]} of one parameter point."""
    point = case.points[index]
    name = f"{case.name}_{point.name}"
    quantities = answers.judged(point)
    out = {"main": [], "others": [], "model": [], "curves": []}
    if index >= MOST_POINTS and not point.others:
        return out
    if quantities:
        drawn = plots.work_precision(site, point, quantities[0], f"{name}_{quantities[0]}")
        out["main"] = [(quantities[0], drawn)] if drawn else []
    others = [q for q in quantities[1:]
              if any(plots.finite(s, q) for s in point.series)][:MOST_PANELS]
    if others and index == 0:
        out["others"] = [(", ".join(others),
                          plots.small_multiples(site, point, others, f"{name}_others"))]
    modelled = [
        q for q in point.units if any(plots.finite(s, q, "model_errors") for s in point.series)
    ][:MOST_PANELS]
    if modelled:
        out["model"] = [(", ".join(modelled),
                         plots.small_multiples(site, point, modelled, f"{name}_model",
                                               "model_errors", "model error", "elements"))]
    if index == 0:
        names = sorted({q for s in point.series for m in s.meshes for q in m.curves})
        out["curves"] = [(q, f) for q, f in ((q, plots.curves(site, point, q, f"{name}_{q}_curve"))
                                             for q in names) if f]
    return out


def table_of(point, quantity):
    """[(formulation, {level: (way, factor to the cheapest, tie)})]: what each formulation needs for each level."""
    rows = {}
    for level in LEVELS:
        found = answers.answer(point, quantity, level)
        for w, _, tie in found.ways:
            factor = w.cost / found.best[0].cost if found.best else math.nan
            rows.setdefault(w.key, {})[level] = (w, factor, tie)
    return sorted(rows.items(), key=lambda r: (-len(r[1]), min(w[0].cost for w in r[1].values())))


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
            if q in point.units and all(v.verdict in ("no truth", "skip") for _, v in found)]


def parts_of(site, case, index):
    """What a page shows of one parameter point."""
    point = case.points[index]
    names = answers.judged(point)
    return {
        "point": point, "figures": figures_of(
            site, case, index), "table": table_of(point, names[0]) if names else [],
        "quantity": names[0] if names else None, "limits": limits_of(point),
        "others": beside.rows(point), "cheapest": cheapest_of(point),
        "front": answers.front(point, names[0]) if names else [],
        "failures": answers.failures(point), "savings": answers.savings(point), "noise": sorted(
            100 * (m.clock.most / m.clock.least - 1) for s in point.series for m in s.meshes
            if m.clock.repeats > 1 and m.clock.least > 0), "has_model": any(
                math.isfinite(v.model_error) for s in point.series for v in s.verdicts)
    }


def write(site, case):
    sections = [found for section in site.sections for found in section(site, case)]
    site.write("case.html",
               f"{case.name}.html",
               case=case,
               parts=[parts_of(site, case, i) for i in range(len(case.points))],
               sections=sections,
               differ=answers.differ,
               timed=site.bench is not None)


def tasks(site):
    return [functools.partial(write, site, case) for case in site.cases]
