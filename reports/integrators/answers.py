"""Which integrator, with which step, is soonest within an error of time; and whether that can be
believed. What a scheme needs for an error is told by `beamwork motion` itself."""
import math
from dataclasses import dataclass

from reports.integrators.stored import ordered

LEVELS = (1e-2, 1e-4, 1e-6)
FACTORS = [10**(i / 12) for i in range(25)]  # of profiles: from 1 to 100


@dataclass(frozen=True)
class Answer:
    """ways: the cheapest first; ties: schemes that are as soon, within the noise of costs."""

    level: float
    ways: tuple
    ties: tuple

    @property
    def best(self):
        return self.ways[0] if self.ways else None


def answer(problem, level, noise=1.0):
    """The Answer of one problem."""
    ways = tuple(problem.reached.get(level, ()))
    ties = tuple(w.scheme for w in ways[1:] if w.cost <= noise * ways[0].cost)
    return Answer(level, ways, ties)


def by_case(problems):
    """{(case, parameters): [Problem]}"""
    out = {}
    for problem in problems:
        out.setdefault((problem.case, problem.parameters), []).append(problem)
    return out


@dataclass(frozen=True)
class Summary:
    """Of a case with all formulations: wins {scheme: formulations in which it is soonest or as
    soon}; best: the ways of the scheme that has most of them; keeping: the cheapest ways that
    keep energy to round-off, with their costs over the least."""

    wins: tuple
    reached: int
    count: int
    best: tuple
    keeping: tuple


def summary(problems, level, noise=1.0):
    count, reached = wins(problems, level, noise)
    ordered_wins = tuple(sorted(count.items(), key=lambda item: -item[1]))
    best, keeping = [], []
    for problem in problems:
        found = answer(problem, level, noise)
        best += [w for w in found.ways if ordered_wins and w.scheme == ordered_wins[0][0]]
        keeping += [(w.scheme, w.cost / found.best.cost)
                    for w in found.ways if w.run.keeps][:1]
    return Summary(ordered_wins, reached, len(problems), tuple(best), tuple(keeping))


def counted(problems, level):
    """{scheme: problems in which it comes within the level}"""
    return {s: sum(any(w.scheme == s for w in answer(p, level).ways) for p in problems)
            for s in ordered({r.scheme for p in problems for r in p.runs if r.known})}


def orders(problems):
    """{scheme: (nominal order, {verdict: ladders})}"""
    out = {}
    for one in (one for p in problems for one in p.ladders):
        verdicts = out.setdefault(one.scheme, (one.nominal, {}))[1]
        verdicts[one.verdict] = verdicts.get(one.verdict, 0) + 1
    return {s: out[s] for s in ordered(out)}


def judged(problems):
    """Those with errors of time."""
    return [p for p in problems if not p.reference and any(r.known for r in p.runs)]


def series(problem, scheme):
    """Its runs, from the coarsest to the finest: [those with equal steps, those with a
    tolerance]."""
    own = sorted((r for r in problem.runs if r.scheme == scheme),
                 key=lambda r: (-r.tolerance, -r.step))
    return [[r for r in own if bool(r.tolerance) == wanted] for wanted in (False, True)]


def doubt(problem, way):
    """Why the error of a run may not be what it says; empty: nothing speaks against it."""
    ladder = problem.ladder(way.scheme)
    if ladder is not None and ladder.verdict == "low order":
        return f"its error falls with order {ladder.order:.1f}, not {ladder.nominal:g}"
    if problem.uncertainty > abs(way.run.error):
        return f"the reference itself may be off by {problem.uncertainty:.0e}"
    return ""


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
    told = ordered({r.scheme for p in problems for r in p.runs if r.known})
    out = {s: [0.0] * len(FACTORS) for s in told}
    for found in cases.values():
        for one in found:
            for way in one.ways:
                for i, factor in enumerate(FACTORS):
                    if way.cost <= factor * one.best.cost * (1 + 1e-12):
                        out[way.scheme][i] += 1 / len(found) / len(cases)
    return out


def structures(problems):
    """{structure: [Problem]}: one structure with all its stiffenings."""
    out = {}
    for problem in problems:
        out.setdefault(problem.structure, []).append(problem)
    return out


def iterations(problems):
    """({(name, scheme, step): {stiffening: iterations a step}}, stiffenings): what was run with
    several stiffenings."""
    rows = {}
    for own in structures(problems).values():
        for problem in own:
            for run in problem.runs:
                if math.isfinite(run.iterations) and not run.tolerance and run.status == "ok":
                    key = min(own, key=lambda p: p.stiffening).name, run.scheme, run.step
                    rows.setdefault(key, {})[problem.stiffening] = run.iterations
    place = {s: i for i, s in enumerate(ordered({scheme for _, scheme, _ in rows}))}
    rows = {key: rows[key] for key in sorted(rows, key=lambda k: (k[0], place[k[1]], -k[2]))
            if len(rows[key]) > 1}
    return rows, sorted({s for found in rows.values() for s in found})
