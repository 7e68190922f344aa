"""A page for each case: errors against work, curves, verdicts of every parameter point."""
import functools
import math

from reports import data, plots

NAVIGATION = []
MOST_FIGURES, MOST_POINTS = 64, 3


def judged(point):
    """Quantities of a point with a truth, in the order of the case."""
    names = []
    for series in point.series:
        for v in series.verdicts:
            if math.isfinite(v.truth) and v.quantity not in names:
                names.append(v.quantity)
    return names


def figures_of(site, case):
    """[(point, [(quantity, convergence svg)], [(quantity, curve svg)])]; every quantity of the defaults, the first of other points."""
    out = []
    for i, point in enumerate(case.points):
        quantities = judged(point)[:MOST_FIGURES if i == 0 else 1 if i < MOST_POINTS else 0]
        drawn = [(q, plots.convergence(site, point, q, f"{case.name}_{point.name}_{q}")) for q in quantities]
        names = sorted({name for s in point.series for m in s.meshes for name in m.curves}) if i == 0 else []
        curves = [(q, plots.curves(site, point, q, f"{case.name}_{point.name}_{q}_curve")) for q in names]
        out.append((point, [d for d in drawn if d[1]], [c for c in curves if c[1]]))
    return out


def write(site, case):
    sections = [found for section in site.sections for found in section(site, case)]
    site.write("case.html", f"{case.name}.html", case=case, figures=figures_of(site, case), cheapest=data.cheapest, sections=sections)


def tasks(site):
    return [functools.partial(write, site, case) for case in site.cases]
