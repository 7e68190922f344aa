"""Which integrator, with which step, is soonest within an error of time; and whether that can be
believed.

A scheme is within an error by the cheapest of its runs from which on all with smaller steps or
tolerances are within it, too."""
import math
from dataclasses import dataclass

from reports.integrators.stored import nominal, ordered

LEVELS = (1e-2, 1e-4, 1e-6)
NEAR = 0.3  # an order is the one that a scheme should have when it is not lower by more
FLOOR = 1e-9  # below it the error of the reference may count: no order is read there
FACTORS = [10**(i / 12) for i in range(25)]  # of profiles: from 1 to 100


@dataclass(frozen=True)
class Answer:
    """best: the run that is soonest, or None; ties: schemes as soon, within the noise of costs;
    ways: {scheme: run}."""

    level: float
    best: object
    ties: tuple
    ways: dict


def series(problem, scheme, stiffening=1):
    """Its runs, from the coarsest to the finest."""
    own = [r for r in problem.runs if r.scheme == scheme and r.stiffening == stiffening]
    return sorted(own, key=lambda r: (-r.tolerance, -r.step))


def way(runs, level):
    """The cheapest run from which on all are within the level, or None."""
    kept = []
    for run in reversed(runs):
        if not (run.known and abs(run.error) <= level):
            break
        kept.append(run)
    return min(kept, key=lambda r: r.cost, default=None)


def groups(runs):
    """Runs of one step each, and those with a tolerance, apart: each goes to its own limit."""
    return [[r for r in runs if bool(r.tolerance) == wanted] for wanted in (False, True)]


def answer(problem, level, noise=1.0):
    """The Answer of one problem."""
    ways = {}
    for scheme in problem.schemes():
        found = [w for w in (way(own, level) for own in groups(series(problem, scheme))) if w]
        if found:
            ways[scheme] = min(found, key=lambda r: r.cost)
    best = min(ways.values(), key=lambda r: r.cost, default=None)
    ties = tuple(s for s, r in ways.items() if r is not best and r.cost <= noise * best.cost)
    return Answer(level, best, ties, ways)


def order(runs):
    """The order that the two finest runs of equal steps show, above the floor, or NaN."""
    told = [r for r in runs if r.known and not r.tolerance and abs(r.error) > FLOOR]
    if len(told) < 2 or told[-1].step == told[-2].step:
        return math.nan
    return (math.log(abs(told[-2].error / told[-1].error)) /
            math.log(told[-2].step / told[-1].step))


def doubts(problem, run):
    """Why the error of a run may not be what it says: [words]."""
    found, shown = order(series(problem, run.scheme)), nominal(run.scheme)
    if math.isfinite(found) and found < shown - NEAR:
        return [f"its error falls with order {found:.1f}, not {shown}"]
    return []


def wins(problems, level, noise=1.0):
    """({scheme: problems in which it is soonest or as soon}, problems that any scheme reaches)."""
    count, reached = {}, 0
    for problem in problems:
        found = answer(problem, level, noise)
        reached += found.best is not None
        for scheme in ((found.best.scheme, *found.ties) if found.best else ()):
            count[scheme] = count.get(scheme, 0) + 1
    return count, reached


def profile(problems, level):
    """{scheme: [share of problems within FACTORS of the least cost]}, every case weighs the
    same."""
    cases = {}
    for problem in problems:
        cases.setdefault(problem.case, []).append(answer(problem, level))
    schemes = ordered({r.scheme for p in problems for r in p.runs})
    out = {s: [0.0] * len(FACTORS) for s in schemes}
    for found in cases.values():
        for one in found:
            for scheme, run in one.ways.items():
                for i, factor in enumerate(FACTORS):
                    if run.cost <= factor * one.best.cost * (1 + 1e-12):
                        out[scheme][i] += 1 / len(found) / len(cases)
    return out


def iterations(problems):
    """({(problem name, scheme, step): {stiffening: iterations a step}}, stiffenings): what was
    measured with several stiffenings."""
    rows = {}
    for problem in problems:
        for one in (*problem.cells, *problem.runs):
            if math.isfinite(one.iterations) and not getattr(one, "tolerance", 0):
                rows.setdefault((problem.name, one.scheme, one.step),
                                {})[one.stiffening] = one.iterations
    rows = {key: found for key, found in rows.items() if len(found) > 1}
    return rows, sorted({s for found in rows.values() for s in found})
