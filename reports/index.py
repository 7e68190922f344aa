"""First page: the cheapest way to each error in every case, and the verdicts of all formulations."""
import functools

from reports import answers, plots, tally
from reports.case import cheapest_of
from reports.verdicts import SEVERITY

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
    """{verdict: number} from good to bad, without second names and misprints that repeat what is counted."""
    return dict(
        sorted(tally.counts(tally.rows(cases))[0].items(), key=lambda item: SEVERITY[item[0]]))


def formulation_rows(cases):
    """{key: {case: {verdict: count}}} over all points, without second names."""
    rows = {}
    for row in tally.rows(cases):
        cell = rows.setdefault(row.formulation, {}).setdefault(row.case, {})
        if row.standing != tally.ALIAS:
            cell[row.verdict.verdict] = cell.get(row.verdict.verdict, 0) + 1
    return rows


def write(site):
    column = site.case("c_column")
    site.write("index.html",
               "index.html",
               cases=site.cases,
               kinds=site.kinds,
               counts=count_verdicts(site.cases),
               rows=formulation_rows(site.cases),
               undecided=answers.undecided,
               winners={c.name: winners(c)
                        for c in site.cases},
               timed=site.bench is not None,
               column=plots.column_figure(site, column) if column else None)


def tasks(site):
    return [functools.partial(write, site)]
