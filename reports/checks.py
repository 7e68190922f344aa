"""What was checked, and how often: truths by kind, cells judged, extremes, planted faults, executions with any bytes as input."""
import functools
import json
import pathlib

from reports.index import count_verdicts

NAVIGATION = [("checks.html", "checks")]


def stored(site, name):
    """A table that another target left beside the results, or None."""
    path = pathlib.Path(site.results).parent / name
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else None


def counted(cases):
    """[(case, points, cells, verdicts against truths, passes)] over all points."""
    rows = []
    for case in cases:
        counts = count_verdicts([case])
        judged = sum(n for verdict, n in counts.items() if verdict not in ("skip", "no truth"))
        rows.append((case.name, len(case.points), sum(len(s.meshes) for p in case.points for s in p.series), judged, counts.get("pass", 0)))
    return rows


def coverage(cases):
    """{formulation: [(covered, series) without the 0, 1, ... finest meshes]} over all cases."""
    sums = {}
    for row in (row for case in cases for row in case.coverages):
        covered, series = sums.setdefault(row["formulation"], {}).get(row["left_out"], (0, 0))
        sums[row["formulation"]][row["left_out"]] = covered + row["covered"], series + row["series"]
    return {name: [without[k] for k in sorted(without)] for name, without in sorted(sums.items())}


def write(site):
    site.write("checks.html", "checks.html", rows=counted(site.cases), counts=count_verdicts(site.cases), coverage=coverage(site.cases), kinds=site.kinds, mutants=stored(site, "mutants.json"), fuzz=stored(site, "fuzz.json"))


def tasks(site):
    return [functools.partial(write, site)]
