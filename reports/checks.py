"""Page of checks: reference values by kind, runs with verdicts, uncertainties of limits, the smallest faults that `make
verify` detects, injected faults, and runs with random bytes as input."""
import csv
import functools
import json
import pathlib

from reports import experiments
from reports.site import ROOT
from reports.verdicts import count_verdicts

NAVIGATION = [("checks.html", "checks"), ("environment.html", "environment")]
CONSISTENT = ("beamw_consistent", "collocation", "geometrically_exact")


def stored(site, name):
    path = pathlib.Path(site.results).parent / name
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else None


def noticed(cases):
    """Returns the smallest faults that are detected in these cases. Returns None if a table is missing, as in an
    installed copy, or [] if there are no rows for these cases."""
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
    """Returns [(case, numbers of points, of runs, of verdicts with a reference value and of passes)] over all points."""
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
    """Returns [(number of series whose limit is within its uncertainty of the reference value, number of series)] with
    all meshes, then without the finest mesh, without the two finest meshes, and so on."""
    sums = {}
    for row in rows:
        covered, series = sums.get(row["left_out"], (0, 0))
        sums[row["left_out"]] = covered + row["covered"], series + row["series"]
    return [sums[k] for k in sorted(sums)]


def of_formulation(rows, key):
    return coverage(row for row in rows if row["formulation"] == key)


def coverages(cases):
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
    return [functools.partial(write, site), functools.partial(write_environment, site)]


OUTCOME = ("outcome", "sentence")
# (make command, files that the command writes next to the results, what it adds to the report)
ADDS = (
    ("lab L=bench-check", ("bench_check.json", ), "injected delays that the times must show"),
    ("lab L=bench-mechanisms", ("mechanisms_joint.h5", "mechanisms_hexapod.h5"),
     "times of the joint and the hexapod next to the published ones"),
    ("lab L=causes", ("causes.json", ), "experiments on the causes of known deviations"),
    ("lab L=newton", ("newton.json", ), "Newton's method with stresses as unknowns, and with displacements only"),
    ("lab L=integrators", ("integrators.json", ), "integrators on all cases of motion: profiles, error against cost"),
    ("lab L=faults", ("faults.json", ), "injected faults"),
    ("lab L=fuzz", ("fuzz.json", ), "random bytes as input"),
)
# (make command, experiment whose group the command writes to the results, what it adds to the report)
GROUPS = (
    ("bench", "bench", "times with their noise"),
    ("lab L=certificates", "element-test", "interface requirements and features of each formulation"),
    ("stress", "stress", "every formulation at its extremes"),
    ("motion", "motion", "integrators of motions: orders, conserved quantities, large steps"),
)


def planted(site):
    path = pathlib.Path(site.results).parent / "bench_check.json"
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else []


def more(site):
    here = pathlib.Path(site.results).parent
    groups = [(command, what) for command, name, what in GROUPS
              if not experiments.holds(site.results, name)]
    return groups + [(command, what) for command, files, what in ADDS
                     if not any((here / name).is_file() for name in files)]


def noise(site):
    """Returns {case: (number of runs with several rounds, median spread, largest spread)}. The spread is the relative
    difference between the slowest and the fastest round."""
    out = {}
    for case in site.cases:
        spread = sorted(m.clock.most / m.clock.least - 1 for p in case.points for s in p.series
                        for m in s.meshes if m.clock.repeats > 1)
        if spread:
            out[case.name] = (len(spread), spread[len(spread) // 2], spread[-1])
    return out


def write_environment(site):
    names = [n for n in site.about if n in (site.bench or site.about) and n not in OUTCOME]
    site.write("environment.html",
               "environment.html",
               names=names,
               about=site.about,
               bench=site.bench,
               noise=noise(site),
               planted=planted(site),
               made=experiments.made(site.results),
               more=more(site))
