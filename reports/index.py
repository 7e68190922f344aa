"""First page: the results, the verdicts, and the formulations of lowest cost for every case."""
import collections
import functools
import math
from dataclasses import dataclass

from reports import agreed, answers, problems, profiles, questions, verdicts
from reports.profiles import panel

@dataclass
class AgreedRow:
    """A quantity of a case at its default parameters. `value` is the limit on which formulations agree."""

    case: str
    quantity: str
    unit: str
    value: float
    errors: dict  # formulation -> error of its limit relative to `value`
    meshes: dict  # formulation -> elements of the coarsest mesh from which all meshes are within the level

    def within(self, level):
        return sorted(key for key, error in self.errors.items() if abs(error) <= level)

    @property
    def farthest(self):
        key = max(self.errors, key=lambda key: (abs(self.errors[key]), key))
        return key if self.errors[key] else None

    @property
    def fewest(self):
        """Returns (smallest number of elements, formulations that need only this number), or None."""
        least = min(self.meshes.values(), default=None)
        keys = (k for k, n in self.meshes.items() if n == least)
        return least and (least, sorted(keys, key=lambda key: (":" in key, key)))


def first_within(series, quantity, level):
    """Returns the number of elements from which the errors of all meshes relative to the agreed limit are within the
    level, or None."""
    found = None
    for mesh in reversed(series.meshes):
        if not abs(mesh.model_errors.get(quantity, math.nan)) <= level:
            break
        found = mesh.n
    return found


def row_of(case, quantity, level):
    point = case.points[0]
    tries = [(s, v) for s in point.series for v in s.verdicts
             if v.quantity == quantity and v.model_truth_kind == agreed.AGREED and math.isfinite(v.limit)]
    if not tries:
        return None
    meshes = {s.key: first_within(s, quantity, level) for s, _ in tries}
    return AgreedRow(case.name, quantity, point.units.get(quantity, ""), tries[0][1].model_truth,
                     {s.key: v.model_error for s, v in tries if math.isfinite(v.model_error)},
                     {key: n for key, n in meshes.items() if n is not None})


def rows_agreed(cases, level):
    """Returns [AgreedRow] of quantities with an agreed limit but no reference value, at the defaults of each case."""
    found = []
    for case in cases:
        point = case.points[0]
        known = {v.quantity for s in point.series for v in s.verdicts if math.isfinite(v.truth)}
        names = [q for q in point.units if q not in known]
        found += [row for row in (row_of(case, q, level) for q in names) if row and row.errors]
    return found


@dataclass(frozen=True)
class Sizes:
    """Numbers of verdicts of a formulation, by the error of its limit."""

    judged: int = 0
    passes: int = 0
    biased: int = 0  # different limit within the tolerance
    beyond: int = 0  # limit outside the tolerance, with an error of at most PERCENT
    far: int = 0  # limit outside the tolerance, with an error above PERCENT
    derived: int = 0  # of the last two: limits that follow from the equations as printed
    unknown: int = 0  # inconclusive
    none: int = 0  # no solution, or refused


PERCENT = 0.01
COLUMNS = {"pass": "passes", "low order": "passes", "biased": "biased", "predicted": "beyond", "wrong": "beyond",
           "undecided": "unknown", "failed": "none"}  # column of problems.GROUPS -> member of Sizes


def sizes_of(cases):
    """Returns {formulation: Sizes} over all quantities and parameters, without aliases of quantities."""
    found = {}
    for row in verdicts.rows(cases):
        group = problems.COLUMN.get(row.verdict.verdict)
        if group is None or row.standing == verdicts.ALIAS:
            continue
        counts = found.setdefault(row.formulation, collections.Counter())
        name = COLUMNS[group]
        far = name == "beyond" and abs(row.verdict.error) > PERCENT
        counts.update({"judged": 1, "far" if far else name: 1, "derived": group == "predicted"})
    return {key: Sizes(**counts) for key, counts in found.items()}


def tolerance_of(cases):
    """Returns the most frequent relative tolerance of the verdicts, or NaN if there are no verdicts."""
    known = collections.Counter(float(f"{v.tolerance / abs(v.truth):.3g}") for c in cases for p in c.points
                                for s in p.series for v in s.verdicts if v.truth and math.isfinite(v.tolerance))
    return known.most_common(1)[0][0] if known else math.nan


AS_MANY = 0.01  # shares of solved problems that differ from the largest share by at most this count as equal to it


def default_choice(rows, sizes):
    """Returns the problems.TrustRow of the formulation to use by default: of those without a limit outside the tolerance
    and without a failure that solve the most problems, the one with the lowest cost. Returns None if there is none."""
    sound = [r for r in rows if math.isfinite(r.solved) and r.key in sizes
             and not (sizes[r.key].beyond or sizes[r.key].far or sizes[r.key].none)]
    most = max((r.solved for r in sound), default=0)
    able = [r for r in sound if r.solved >= most - AS_MANY and math.isfinite(r.factor)]
    return min(able, key=lambda r: (r.factor, -r.share, r.key), default=None)


NAMED = 3  # largest number of cases that a sentence names


def ahead(values):
    most = max(values.values())
    return sorted(k for k, v in values.items() if round(100 * v) == round(100 * most)), most


def of_speed(compared, rows):
    """Returns the formulations that are most often near the best, the formulations that solve the most problems, their
    shares, and the numbers of problems and cases. Returns None if there is no comparison."""
    if not compared.any:
        return None
    known = [r for r in rows if math.isfinite(r.solved)]
    near, near_share = ahead({r.key: r.near for r in known})
    most, most_share = ahead({r.key: r.solved for r in known})
    return {
        "problems": len(compared.problems),
        "cases": compared.cases,
        "near": near,
        "near_share": near_share,
        "most": most,
        "most_share": most_share,
        "most_factor": max(r.factor for r in known if r.key in most),
    }


def of_trust(cases, rows):
    """Returns the formulations without a wrong limit or a failure, the formulation with the most wrong limits and up to
    NAMED cases in which it has them, and the numbers of wrong, predicted and unexpected verdicts. Returns None without
    rows."""
    if not rows:
        return None
    worst = max(rows, key=lambda r: (r.wrong, r.key))
    unexpected = sum(not row.verdict.as_expected for row in verdicts.rows(cases))
    return {
        "never": [r.key for r in rows if not r.wrong and not r.counts["failed"]],
        "wrong": sum(r.wrong for r in rows),
        "derived": sum(r.counts["predicted"] for r in rows),
        "worst": worst.key,
        "times": worst.wrong,
        "judged": worst.judged,
        "where": list(problems.wrong_cases(cases, worst.key))[:NAMED],
        "unexpected": unexpected,
    }


def of_truths(cases):
    """Returns the number of reference values in verdicts, their number by kind, and their median and largest relative
    uncertainty, or None without reference values."""
    known = {}
    for row in verdicts.rows(cases):
        v = row.verdict
        if math.isfinite(v.truth) and row.standing != verdicts.ALIAS:
            known[row.case, row.parameters, v.quantity, v.theory] = v
    if not known:
        return None
    kinds = {}
    for v in known.values():
        kinds[v.truth_kind] = kinds.get(v.truth_kind, 0) + 1
    digits = sorted(v.truth_uncertainty / abs(v.truth) for v in known.values() if v.truth)
    return {
        "number": len(known),
        "kinds": dict(sorted(kinds.items(), key=lambda item: -item[1])),
        "half": digits[(len(digits) - 1) // 2] if digits else math.nan,
        "all": digits[-1] if digits else math.nan,
    }


NAVIGATION = [("index.html", "beamwork")]
LEVEL = 0.01  # error level of the answers
MOST_ROWS = 10  # largest number of rows in the table of verdicts on the first screen
PLACES = (  # pages to read next, if the site has them
    ("answers.html", "your tolerance"),
    ("profiles.html", "profiles"),
    ("profiles.html#winners", "winners at each tolerance"),
    ("profiles.html#trust", "trust in full"),
    ("formulations.html", "formulations"),
    ("stability.html", "stability"),
    ("motions.html", "motions"),
    ("integrators.html", "integrators"),
    ("errata.html", "errata"),
    ("deviations.html", "causes"),
    ("glossary.html", "glossary"),
)
FIGURE = (300, 150)


def formulation_rows(cases):
    """Returns {formulation: {case: {verdict: number}}} over all points. Aliases of quantities are not counted."""
    rows = {}
    for row in verdicts.rows(cases):
        cell = rows.setdefault(row.formulation, {}).setdefault(row.case, {})
        if row.standing != verdicts.ALIAS:
            cell[row.verdict.verdict] = cell.get(row.verdict.verdict, 0) + 1
    return rows


def table_of(case):
    point = case.points[0]
    names = answers.judged(point)
    asked = [(names[0], names[0])] if names else []
    asked += [(f"all {len(names)} quantities", answers.ALL)] if len(names) > 1 else []
    return [(words, answers.answer(point, quantity, LEVEL)) for words, quantity in asked]


def write(site):
    compared = profiles.Compared(site.cases)
    rows = problems.trust_table(site.cases, compared.problems, compared.keys)
    lines = {found.case.name: found for found in answers.lines_of_cases(site.cases)}
    groups, sizes = questions.grouped(site.cases), sizes_of(site.cases)
    written = {file for file, _ in site.navigation}
    site.write("index.html", "index.html", about=site.about, cases=site.cases, lines=lines, level=LEVEL,
               agreed=rows_agreed([c for c in site.cases if c.name not in lines], LEVEL),
               places=[place for place in PLACES if place[0].partition("#")[0] in written],
               groups=groups, sizes=sizes, tolerance=tolerance_of(site.cases),
               others=[c for c in site.cases if not any(line.case is c for _, found in groups for line in found)],
               choice=default_choice(rows, sizes) if compared.any else None,
               speed=of_speed(compared, rows),
               trust=of_trust(site.cases, rows), truths=of_truths(site.cases),
               profile=panel(site, compared, profiles.PICTURES[0], LEVEL, "profile", FIGURE)
               if compared.any else None, rows=rows[:MOST_ROWS], compared=compared,
               counts=verdicts.count_verdicts(site.cases),
               glances=site.glances, tables={c.name: table_of(c) for c in site.cases},
               verdicts=formulation_rows(site.cases))


def tasks(site):
    return [functools.partial(write, site)]
