"""Two short pages: all cases, and all formulations."""
import functools

from reports import tally
from reports.formulation import WRONG, standing
from reports.site import file_of
from reports.verdicts import SEVERITY, UNJUDGED

NAVIGATION = [("cases.html", "all cases"), ("formulations.html", "all formulations")]


def counts(rows):
    """{verdict: number} of rows that are judged, second names left out, from bad to good."""
    found = {}
    for row in rows:
        if row.standing != tally.ALIAS and row.verdict.verdict not in UNJUDGED:
            found[row.verdict.verdict] = found.get(row.verdict.verdict, 0) + 1
    return sorted(found.items(), key=lambda item: -SEVERITY[item[0]])


def grouped(rows, name):
    """{name of a row: rows}."""
    found = {}
    for row in rows:
        found.setdefault(getattr(row, name), []).append(row)
    return found


def wrong_in(cases, key):
    """Cases at whose default parameters more elements do not give the answer."""
    found = [(c.name, standing(s)) for c in cases for s in c.points[0].series if s.key == key]
    return [name for name, v in found if v is not None and v.verdict in WRONG]


def write_cases(site, rows):
    of_case = grouped(rows, "case")
    site.write("cases.html", "cases.html",
               cases=[(c, len(c.points), len({s.key for p in c.points for s in p.series
                                              if not s.missing}),
                       counts(of_case.get(c.name, []))) for c in site.cases])


def write_formulations(site, rows):
    of_key = grouped(rows, "formulation")
    summary = {s.key: s.summary for c in site.cases for p in c.points for s in p.series}
    found = [(key, summary[key], counts(of_key.get(key, [])), wrong_in(site.cases, key))
             for key in site.styles.order]
    site.write("formulations.html", "formulations.html",
               plain=[row for row in found if ":" not in row[0]],
               variants=[row for row in found if ":" in row[0]], file_of=file_of)


def tasks(site):
    rows = list(tally.rows(site.cases))
    return [functools.partial(write_cases, site, rows),
            functools.partial(write_formulations, site, rows)]
