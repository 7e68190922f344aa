"""First page: the cheapest way to each error in every case, and the verdicts of all formulations."""
import functools

from reports import answers, plots
from reports.case import cheapest_of

NAVIGATION = [("index.html", "beamwork")]


def winners(case):
    """For the defaults: [(quantity, {level: ways})] of the first judged quantity and of all together."""
    point = case.points[0]
    found = dict(cheapest_of(point))
    names = answers.judged(point)
    rows = [(names[0], found[names[0]])] if names else []
    if answers.ALL in found:
        rows.append((f"all {len(names)} quantities", found[answers.ALL]))
    return rows


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
    site.write("index.html", "index.html", cases=site.cases, kinds=site.kinds, counts=count_verdicts(site.cases), rows=formulation_rows(site.cases), undecided=answers.undecided,
               winners={c.name: winners(c) for c in site.cases}, timed=site.bench is not None, column=plots.column_figure(site, column) if column else None)


def tasks(site):
    return [functools.partial(write, site)]
