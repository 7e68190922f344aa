"""The problems on which formulations are compared, and the cost at which each formulation solves a problem.

A problem is a quantity with an exact reference value of the same model, at a parameter point of a case. Aliases of
quantities (verdicts.py) are not counted. All cases have equal weights, whatever the number of their parameter points.
All problems within a case have equal weights.

A formulation solves a problem to a level with the coarsest mesh for which the errors of that mesh and of all finer
meshes are within the level, unless its limit is known to be outside the level."""
import math
from collections import Counter
from dataclasses import dataclass, field

from reports import answers, verdicts
from reports.verdicts import OWN_LIMITS, UNJUDGED

COUNTS = {  # cost measures of a mesh
    "cost": lambda mesh: mesh.cost,  # cost of counted work, with the cost coefficients of the reference machine [s]
    "unknowns": lambda mesh: max(1, mesh.free),
}


@dataclass
class Problem:
    """A problem. `tries` is {formulation: (data.Series, data.Verdict)} of the formulations that support the problem."""

    case: str
    point: str
    quantity: str
    tries: dict
    meshes: list  # meshes of all successful runs at the parameter point
    least: dict = field(default_factory=dict)  # measure -> smallest value over all these meshes


def contestants(cases):
    keys = {s.key for c in cases for p in c.points for s in p.series
            if not s.missing and not s.unranked}
    plain = {k for k in keys if ":" not in k and verdicts.corrected(k) is None}
    return sorted(plain or keys)


def tries_of(point, quantity, keys):
    tries = {}
    for series in point.series:
        verdict = answers.verdict_of(series, quantity)
        judged = verdict and verdict.truth_kind == "exact" and verdict.verdict not in UNJUDGED
        if judged and series.key in keys:
            tries[series.key] = series, verdict
    return tries


def problems_of(case, keys):
    """Returns the problems of a case, each with the smallest value of each cost measure over the runs at its point."""
    found, second_names = [], verdicts.aliases(case)
    for point in case.points:
        meshes = [m for s in point.series for m in s.meshes if m.status == "ok"]
        for quantity in answers.judged(point):
            tries = tries_of(point, quantity, keys) if quantity not in second_names else {}
            if tries and any(math.isfinite(m.cost) for m in meshes):
                found.append(Problem(case.name, point.name, quantity, tries, meshes))
    for problem in found:
        for name, count in COUNTS.items():
            known = filter(math.isfinite, map(count, problem.meshes))
            problem.least[name] = min(known, default=math.nan)
    return found


def problems(cases, keys):
    return [p for case in cases for p in problems_of(case, keys)]


def defect(verdict, level):
    return verdict.verdict in OWN_LIMITS and abs(verdict.error) > level


def any_defect(verdict, level):
    del level
    return verdict.verdict in OWN_LIMITS


def no_defect(verdict, level):
    """Returns False, so that only the errors of the meshes matter."""
    del verdict, level
    return False


def solved(problem, key, level, forbids=defect):
    """Returns the data.Mesh with which a formulation solves the problem, or None. A problem is not solved if
    forbids(verdict, level) is True."""
    if key not in problem.tries:
        return None
    series, verdict = problem.tries[key]
    n = verdict.reach.get(level)
    if n is None or forbids(verdict, level):
        return None
    return next(m for m in series.meshes if m.n == n)


def weights(found, key=None):
    """Returns the weights of the problems, whose sum is 1. If `key` is given, only problems that this formulation
    supports have a weight."""
    kept = [p for p in found if key is None or key in p.tries]
    sizes = Counter(p.case for p in kept)
    return [(p, 1 / sizes[p.case] / len(sizes)) for p in kept]


def paid(problem, keys, level, count, forbids=defect):
    """Returns {formulation: cost of the mesh that solves the problem}, by the cost measure `count`. The cost is infinite
    if no mesh solves the problem."""
    meshes = {key: solved(problem, key, level, forbids) for key in keys}
    return {key: COUNTS[count](m) if m else math.inf for key, m in meshes.items()}


def to_the_best(problem, bills, count):
    """Returns the unit of performance profiles (Dolan and More 2002): the lowest cost of any formulation."""
    del problem, count
    return min(bills.values(), default=math.inf)


def to_the_smallest(problem, bills, count):
    """Returns the unit of data profiles (More and Wild 2009): the smallest cost of any run at the parameter point,
    whatever its error. This unit does not depend on a tolerance."""
    del bills
    return problem.least[count]


@dataclass(frozen=True)
class Question:
    """Definition of a profile: error level, cost measure, unit, and the defects that exclude a formulation."""

    level: float
    count: str = "cost"
    unit: object = to_the_best
    forbids: object = defect


def factors(found, keys, question):
    """Returns {formulation: [(problem, cost divided by the unit)]}. The cost is infinite if the formulation does not
    solve the problem."""
    out = {key: [] for key in keys}
    for problem in found:
        bills = paid(problem, keys, question.level, question.count, question.forbids)
        unit = question.unit(problem, bills, question.count)
        for key, bill in bills.items():
            out[key].append((problem, bill / unit if math.isfinite(bill) else math.inf))
    return out


LEVEL, NEAR = 0.01, 2  # error level, and cost relative to the lowest cost up to which a formulation is near the best
GROUPS = {  # column -> verdicts that the column counts
    "pass": ("pass",),
    "low order": ("low order",),
    "biased": ("biased", "biased, as predicted"),
    "predicted": ("wrong limit, as predicted",),
    "wrong": ("wrong limit",),
    "undecided": ("undecided",),
    "failed": ("diverged", "refused"),
}
COLUMN = {verdict: name for name, verdicts in GROUPS.items() for verdict in verdicts}


@dataclass
class TrustRow:
    """A row of the table for one formulation. Shares are fractions of the weight of all problems."""

    key: str
    counts: dict  # column of GROUPS -> number of verdicts
    offered: float = math.nan  # share of problems that the formulation supports
    solved: float = math.nan  # share of problems solved to LEVEL
    near: float = math.nan  # share of problems solved to LEVEL at no more than NEAR times the best cost
    factor: float = math.nan  # median cost relative to the best, over the problems that the formulation solves to LEVEL

    @property
    def judged(self):
        return sum(self.counts.values())

    @property
    def wrong(self):
        return self.counts["predicted"] + self.counts["wrong"]

    @property
    def share(self):
        return self.counts["pass"] / self.judged if self.judged else math.nan


def median(pairs):
    """Returns the weighted median of [(value, weight)], with half of the weight at or below it, or NaN if there are no
    pairs."""
    half, reached = sum(w for _, w in pairs) / 2, 0.0
    for value, weight in sorted(pairs):
        reached += weight
        if reached >= half * (1 - 1e-12):
            return value
    return math.nan


def count_trust(cases):
    out = {}
    for row in verdicts.rows(cases):
        name = COLUMN.get(row.verdict.verdict)
        counts = out.setdefault(row.formulation, dict.fromkeys(GROUPS, 0))
        if name and row.standing != verdicts.ALIAS:
            counts[name] += 1
    return out


def judged(cases):
    return [key for key, counts in count_trust(cases).items() if sum(counts.values())]


def speed(row, found, pairs):
    """Sets the shares and the factor of a row. `pairs` is [(problem, cost relative to the best)]."""
    weight = {id(p): w for p, w in weights(found)}
    reached = [(f, weight[id(p)]) for p, f in pairs if math.isfinite(f)]
    row.offered = sum(weight[id(p)] for p in found if row.key in p.tries)
    row.solved = sum(w for _, w in reached)
    row.near = sum(w for f, w in reached if f <= NEAR)
    row.factor = median(reached)


def trust_table(cases, found, keys):
    """Returns [TrustRow] of the formulations in `keys` that have verdicts, in the order of trust_order()."""
    counts, measured = count_trust(cases), factors(found, contestants(cases), Question(LEVEL))
    rows = [TrustRow(key, counts[key]) for key in keys if sum(counts.get(key, {}).values())]
    for row in rows:
        if row.key in measured and found:
            speed(row, found, measured[row.key])
    return sorted(rows, key=trust_order)


def trust_order(row):
    """Returns the sort key of a row: first the share of solved problems, then the share of passes, in descending
    order. Formulations that are not compared (options, uncorrected misprints) come last."""
    solved = row.solved if math.isfinite(row.solved) else -1
    return -round(solved, 6), -round(row.share, 6), row.key


def wrong_cases(cases, key):
    """Returns {case: number of verdicts} of the cases in which a formulation converges to a wrong limit. Cases with the
    most such verdicts come first."""
    sizes = {}
    for row in verdicts.rows(cases):
        wrong = COLUMN.get(row.verdict.verdict) in ("predicted", "wrong")
        if row.formulation == key and wrong and row.standing != verdicts.ALIAS:
            sizes[row.case] = sizes.get(row.case, 0) + 1
    return dict(sorted(sizes.items(), key=lambda item: (-item[1], item[0])))
