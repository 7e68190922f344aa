"""First page: the cheapest way to each error, verdicts of all formulations, what the results were made with."""
import functools

from reports import data, plots
from reports.case import judged
from reports.site import LEVELS

NAVIGATION = [("index.html", "beamwork")]


def winners(case):
    """The first judged quantity of the defaults and the cheapest way to each level."""
    point = case.points[0]
    names = judged(point)
    return (names[0], data.cheapest(point, names[0], LEVELS)) if names else (None, {})


def count_verdicts(cases):
    counts = {}
    for case in cases:
        for point in case.points:
            for series in point.series:
                for v in series.verdicts:
                    counts[v.verdict] = counts.get(v.verdict, 0) + 1
    return counts


def formulation_rows(cases):
    """{key: {case: {verdict: count}}} over all points."""
    rows = {}
    for case in cases:
        for point in case.points:
            for series in point.series:
                cell = rows.setdefault(series.key, {}).setdefault(case.name, {})
                for v in series.verdicts:
                    cell[v.verdict] = cell.get(v.verdict, 0) + 1
    return rows


def write(site):
    column = site.case("c_column")
    site.write("index.html", "index.html", cases=site.cases, about=site.about, kinds=site.kinds, counts=count_verdicts(site.cases), rows=formulation_rows(site.cases),
               winners={c.name: winners(c) for c in site.cases}, column=plots.column_figure(site, column) if column else None)


def tasks(site):
    return [functools.partial(write, site)]
