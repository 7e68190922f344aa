"""Performance profiles and data profiles: what share of the problems is solved within a factor."""
import math
from dataclasses import dataclass

from reports import problems, style
from reports.problems import Question, to_the_best, to_the_smallest

ROUND = (1, 1.2, 1.4, 1.7, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8)  # in each decade, where shares are read
FARTHEST = {to_the_best: 100, to_the_smallest: 1000}  # where the axis ends
SLACK = 1e-9  # of a factor: equal bills stay equal in floating point


@dataclass(frozen=True)
class Picture:
    """One figure for each level. offered: every formulation is asked only what it offers."""

    name: str
    count: str
    unit: object = to_the_best
    offered: bool = False

    @property
    def file(self):
        return f"profile_{self.name}"

    def question(self, level):
        return Question(level, self.count, self.unit)


PICTURES = (
    Picture("cost", "cost"),
    Picture("cost_offered", "cost", offered=True),
    Picture("unknowns", "unknowns"),
    Picture("data_cost", "cost", to_the_smallest),
    Picture("data_unknowns", "unknowns", to_the_smallest),
)


def places(farthest):
    """Factors at which shares are read: round numbers from 1 to a power of ten."""
    tens = [10**i for i in range(round(math.log10(farthest)))]
    return [round(ten * x, 1) for ten in tens for x in ROUND] + [farthest]


def shares(pairs, at):
    """Share of the weight of problems solved within each factor, and at last at any.

    pairs: [(factor, weight)] of one formulation, infinite where it does not solve; at: ascending.
    """
    ordered = sorted(pairs)
    whole, reached, i, out = sum(w for _, w in ordered), 0.0, 0, []
    for place in [*at, math.inf]:
        limit = min(place * (1 + SLACK), 1e300)
        while i < len(ordered) and ordered[i][0] <= limit:
            reached += ordered[i][1]
            i += 1
        out.append(reached / whole if whole else math.nan)
    return out


def weight_of(found, key=None):
    return {id(problem): weight for problem, weight in problems.weights(found, key)}


def profile(found, keys, question, offered=False):
    """{formulation: shares at `places`, and of all that it solves}."""
    at, everything = places(FARTHEST[question.unit]), weight_of(found)
    out = {}
    for key, pairs in problems.factors(found, keys, question).items():
        weight = weight_of(found, key) if offered else everything
        out[key] = shares([(f, weight[id(p)]) for p, f in pairs if id(p) in weight], at)
    return out


def read_at(curves, at, factor):
    """[(share within the factor, formulation)], the largest first; factor: one of the places."""
    i = at.index(factor)
    return sorted(((values[i], key) for key, values in curves.items()), reverse=True)


class Compared:
    """What is compared in results: problems, the formulations, those of them with a curve."""

    def __init__(self, cases):
        self.keys = problems.contestants(cases)
        self.problems = problems.problems(cases, self.keys)
        self.cases = len({p.case for p in self.problems})
        self._profiles = {}
        extra = style.extra(self.keys)
        self.curves = [key for key in self.keys if key not in extra] if self.any else []

    @property
    def any(self):
        """Is there a comparison: a problem, and two formulations to solve it?"""
        return bool(self.problems) and len(self.keys) > 1

    def profile(self, question, offered=False):
        """{formulation: shares at `places`, and of all that it solves}."""
        if (question, offered) not in self._profiles:
            found = profile(self.problems, self.keys, question, offered)
            self._profiles[question, offered] = found
        return self._profiles[question, offered]
