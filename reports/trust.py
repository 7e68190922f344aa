"""Trust beside speed: what the judge says of each formulation, and how soon it is there."""
import math
from dataclasses import dataclass

from reports import tally
from reports.problems import Question, contestants, factors, weights

LEVEL, NEAR = 0.01, 2  # "within twice the best, to 1 %"
GROUPS = {  # column -> verdicts counted in it
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
class Row:
    """One formulation; shares are of the weight of all problems (reports/problems.py)."""

    key: str
    counts: dict  # column of GROUPS -> verdicts
    offered: float = math.nan
    solved: float = math.nan  # to LEVEL
    near: float = math.nan  # to LEVEL within NEAR times the best
    factor: float = math.nan  # to the best: the median over what it solves to LEVEL

    @property
    def judged(self):
        return sum(self.counts.values())

    @property
    def wrong(self):
        return self.counts["predicted"] + self.counts["wrong"]

    @property
    def share(self):
        """Of its verdicts that are passes."""
        return self.counts["pass"] / self.judged if self.judged else math.nan


def median(pairs):
    """Of values with weights: half of the weight is at or below it; NaN where there is none."""
    half, reached = sum(w for _, w in pairs) / 2, 0.0
    for value, weight in sorted(pairs):
        reached += weight
        if reached >= half * (1 - 1e-12):
            return value
    return math.nan


def counted(cases):
    """{formulation: {column: number}} over all points and quantities, without second names."""
    out = {}
    for row in tally.rows(cases):
        name = COLUMN.get(row.verdict.verdict)
        counts = out.setdefault(row.formulation, dict.fromkeys(GROUPS, 0))
        if name and row.standing != tally.ALIAS:
            counts[name] += 1
    return out


def judged(cases):
    """Every formulation with a verdict, whatever its options."""
    return [key for key, counts in counted(cases).items() if sum(counts.values())]


def speed(row, found, pairs):
    """Fills what a row says of problems. pairs: [(problem, factor to the best)]."""
    weight = {id(p): w for p, w in weights(found)}
    reached = [(f, weight[id(p)]) for p, f in pairs if math.isfinite(f)]
    row.offered = sum(weight[id(p)] for p in found if row.key in p.tries)
    row.solved = sum(w for _, w in reached)
    row.near = sum(w for f, w in reached if f <= NEAR)
    row.factor = median(reached)


def table(cases, found, keys):
    """[Row] of these formulations, as far as they were judged."""
    counts, measured = counted(cases), factors(found, contestants(cases), Question(LEVEL))
    rows = [Row(key, counts[key]) for key in keys if sum(counts.get(key, {}).values())]
    for row in rows:
        if row.key in measured and found:
            speed(row, found, measured[row.key])
    return sorted(rows, key=order)


def order(row):
    """Those that solve most first; what is not compared (options, kept misprints) at last."""
    solved = row.solved if math.isfinite(row.solved) else -1
    return -round(solved, 6), -round(row.share, 6), row.key


def wrong_cases(cases, key):
    """{case: verdicts} where a formulation tends to a wrong limit, most first."""
    sizes = {}
    for row in tally.rows(cases):
        wrong = COLUMN.get(row.verdict.verdict) in ("predicted", "wrong")
        if row.formulation == key and wrong and row.standing != tally.ALIAS:
            sizes[row.case] = sizes.get(row.case, 0) + 1
    return dict(sorted(sizes.items(), key=lambda item: (-item[1], item[0])))
