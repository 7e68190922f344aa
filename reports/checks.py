"""What was checked, and how often: truths by kind, cells judged, limits' uncertainties, the smallest
faults that the gate notices, planted faults, executions with any bytes as input."""
import csv
import functools
import json
import pathlib

from reports.site import ROOT
from reports.tally import count_verdicts

NAVIGATION = [("checks.html", "checks")]
# They have no limits of their own.
CONSISTENT = ("beamw_consistent", "collocation", "geometrically_exact")


def stored(site, name):
    """A table that another target left beside the results, or None."""
    path = pathlib.Path(site.results).parent / name
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else None


def noticed(cases):
    """The committed tables of the smallest faults that are noticed, of these cases; false: there are
    none, as where beamwork is installed."""
    paths = [ROOT / "harness" / name for name in ("blind_spots.csv", "planted_faults.csv")]
    if not all(path.is_file() for path in paths):
        return None
    rows, faults = (
        list(csv.DictReader(path.read_text(encoding="utf-8").splitlines())) for path in paths
    )
    names = {case.name for case in cases}
    here = [row for row in rows if row["case"] in names]
    constants = list(dict.fromkeys(fault["constant"] for fault in faults))
    by_formulation = {}
    for fault in faults:
        by_formulation.setdefault(fault["formulation"], {})[fault["constant"]] = fault
    return here and {
        "rows": here, "passing": [row for row in here if row["reason"]],
        "constants": constants, "formulations": by_formulation
    }  # yapf: disable


def counted(cases):
    """[(case, points, cells, verdicts against truths, passes)] over all points."""
    rows = []
    for case in cases:
        counts = count_verdicts([case])
        judged = sum(n for verdict, n in counts.items() if verdict not in ("skip", "no truth"))
        rows.append(
            (
                case.name,
                len(case.points),
                sum(len(s.meshes) for p in case.points for s in p.series),
                judged,
                counts.get("pass", 0),
            )
        )
    return rows


def coverage(rows):
    """[(covered, series) without the 0, 1, ... finest meshes], summed."""
    sums = {}
    for row in rows:
        covered, series = sums.get(row["left_out"], (0, 0))
        sums[row["left_out"]] = covered + row["covered"], series + row["series"]
    return [sums[k] for k in sorted(sums)]


def of_formulation(rows, key):
    return coverage(row for row in rows if row["formulation"] == key)


def coverages(cases):
    """What the page shows: each consistent formulation, these together, all; and by case."""
    rows = [row for case in cases for row in case.coverages]
    names = sorted({row["formulation"] for row in rows})
    by_case = [
        (case.name, [of_formulation(case.coverages, key) for key in CONSISTENT]) for case in cases
    ]
    return {
        "consistent": [(key, of_formulation(rows, key)) for key in names if key in CONSISTENT],
        "together": coverage(row for row in rows if row["formulation"] in CONSISTENT),
        "all": coverage(rows),
        "others": [(key, of_formulation(rows, key)) for key in names if key not in CONSISTENT],
        "cases": [(name, found) for name, found in by_case if any(found)],
        "formulations": CONSISTENT,
    }


def write(site):
    site.write(
        "checks.html",
        "checks.html",
        rows=counted(site.cases),
        counts=count_verdicts(site.cases),
        coverage=coverages(site.cases),
        kinds=site.kinds,
        noticed=noticed(site.cases),
        mutants=stored(site, "faults.json"),
        fuzz=stored(site, "fuzz.json"),
    )


def tasks(site):
    return [functools.partial(write, site)]
