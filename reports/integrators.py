"""Reads the results of `beamwork motion` and of `make lab L=integrators` into plain records: motions computed by integrators
with given steps and tolerances. The results of `make lab L=integrators` contain records for every case with a motion."""
import json
import math
import os
from dataclasses import dataclass

from reports import experiments
from reports.data import Unreadable

INTEGRATOR_RUNS = "integrators.json"
KEPT = 1e-11  # largest energy-balance error, relative to the largest energy, of a run that conserves energy
ORDER = ("alpha", "hht", "trapezoidal", "conserving", "radau", "explicit")
KEYS = ("case", "parameters", "formulation", "elements")  # columns that identify a problem
NONE_WANTED = "none is wanted"  # reason stored if no reference is requested
STIFFENING = "stiffening"


@dataclass(frozen=True)
class Run:
    """One motion. `error` is the time-integration error, and `cost` is the cost of counted work [s]. `energy` and
    `momentum` are the largest relative changes after the last load. `fate` is the outcome after the loads have ended.
    `large` is True if the run belongs to a map of large steps, for which errors are not computed."""

    scheme: str
    step: float
    tolerance: float
    error: float
    cost: float
    iterations: float
    rejected: int
    energy: float
    momentum: float
    fate: str
    status: str
    reason: str
    large: bool

    @property
    def setting(self):
        return f"tolerance {self.tolerance:.2g}" if self.tolerance else f"step {self.step:.3g} s"

    @property
    def known(self):
        return self.status == "ok" and math.isfinite(self.error)

    @property
    def keeps(self):
        return self.energy <= KEPT


@dataclass(frozen=True)
class Ladder:
    """Observed order of an integrator, from successively halved steps. `verdict` is pass, low order or undecided."""

    scheme: str
    nominal: float
    order: float
    verdict: str


@dataclass(frozen=True)
class Way:
    """An integrator that reaches an error level. `cost` [s] is interpolated to exactly this level, and `run` is a run
    within it."""

    scheme: str
    cost: float
    run: Run


@dataclass
class Problem:
    """The motion of a case with one formulation on one mesh, and the runs that compute it. `reached` is {error: [Way]},
    the cheapest first. `uncertainty` is that of the reference."""

    case: str
    parameters: str
    formulation: str
    elements: int
    stiffening: float
    reference: str  # reason why there is no reference, or an empty string
    uncertainty: float
    runs: list
    ladders: list
    reached: dict

    @property
    def name(self):
        at = f" ({self.parameters})" if self.parameters else ""
        return f"{self.case}{at}, {self.formulation}, n = {self.elements}"

    @property
    def structure(self):
        rest = [p for p in self.parameters.split(";") if not p.strip().startswith(STIFFENING)]
        return self.case, ";".join(rest), self.formulation, self.elements

    def schemes(self):
        return ordered({r.scheme for r in self.runs})

    def ladder(self, scheme):
        return next((one for one in self.ladders if one.scheme == scheme), None)


def ordered(schemes):
    """Returns the schemes in the order of ORDER, each followed by its variants with options. Others come last."""
    def place(scheme):
        name = scheme.partition(":")[0]
        return ORDER.index(name) if name in ORDER else len(ORDER), scheme

    return sorted(schemes, key=place)


def number(row, name, other=math.nan):
    value = row.get(name)
    return other if value is None else float(value)


def run_of(row, large=False):
    return Run(row["integrator"], number(row, "step"), number(row, "tolerance", 0),
               number(row, "error"), number(row, "cost"), number(row, "iterations_per_step"),
               int(number(row, "rejected", 0)), number(row, "energy_drift"),
               number(row, "momentum_drift"), row["outcome"], row["status"], row["reason"],
               large)


def ways_of(rows, runs):
    """Returns {error: [Way]}, the cheapest first."""
    found = {(r.scheme, r.step, r.tolerance): r for r in runs}
    out = {}
    for row in rows:
        run = found[row["integrator"], row["step"], row["tolerance"]]
        out.setdefault(row["error"], []).append(Way(row["integrator"], row["cost"], run))
    return {error: sorted(ways, key=lambda w: w.cost) for error, ways in out.items()}


def stiffening_in(parameters):
    said = dict(p.strip().split("=", 1) for p in parameters.split(";") if p.strip())
    return float(said.get(STIFFENING, 1))


def problem_of(tables, key):
    """Returns the Problem of a case, set of parameters, formulation and mesh. Its runs are those with errors, then
    those of which only the outcome is known."""
    def own(name):
        return tables[name].get(key, [])

    case, parameters, formulation, elements = key
    runs = sorted((run_of(r, not r["has_reference"]) for r in own("runs")), key=lambda r: r.large)
    reference = (own("references") or [{"reason": NONE_WANTED}])[0]
    ladders = [Ladder(o["integrator"], o["nominal"], number(o, "order"), o["verdict"])
               for o in own("orders")]
    return Problem(case, parameters, formulation, int(elements), stiffening_in(parameters),
                   reference["reason"], number(reference, "uncertainty"), runs, ladders,
                   ways_of(own("reached"), runs))


def problems_of(found):
    """Returns a Problem for each case, set of parameters, formulation and mesh."""
    tables = {name: experiments.grouped(found[name], *KEYS)
              for name in ("references", "runs", "orders", "reached")}
    return [problem_of(tables, key) for key in tables["runs"]]


@dataclass(frozen=True)
class Check:
    """Difference between the reference of a problem and runs of `explicit` with two tolerances. `reason` states why
    the difference is unknown."""

    name: str
    formulation: str
    uncertainty: float
    distances: tuple
    reason: str


@dataclass
class Record:
    """Contents of the results. `verdicts` are rows with observed and expected verdicts. `compared` are the problems on
    which integrators are compared (every case with a motion if `make lab L=integrators` was run). `left_out` is {(case,
    formulation): reason why it is not run}. `about` contains the attributes and tables of `beamwork motion`."""

    problems: list
    verdicts: list
    compared: list
    left_out: dict
    checks: list
    about: dict

    @property
    def every(self):
        return self.problems + [p for p in self.compared if p not in self.problems]


def load(path):
    if not os.path.exists(path):
        return None
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def check_of(row):
    at = f" ({row['parameters']})" if row["parameters"] else ""
    distances = tuple(math.nan if d is None else d for d in row["distances"])
    return Check(row["case"] + at, row["formulation"], number(row, "uncertainty"), distances,
                 row["reason"])


def compared_in(path):
    """Returns the contents of integrators.json: (problems, left_out, checks), or None if there is none."""
    try:
        runs = load(path)
        return None if runs is None else (
            problems_of(runs),
            {(row["case"], row["formulation"]): row["reason"] for row in runs["left_out"]},
            [check_of(row) for row in runs["checks"]])
    except (KeyError, TypeError, ValueError) as why:
        raise Unreadable(f"{path}: damaged, or of an earlier version; run 'make lab L=integrators', or "
                         "remove it") from why


def read(path):
    """Returns the Record of a results file and of integrators.json next to the file. Returns None if the file contains no
    results of `beamwork motion`."""
    found = experiments.read(path, "motion")
    if found is None:
        return None
    problems = problems_of(found)
    beside = os.path.join(os.path.dirname(os.path.abspath(path)), INTEGRATOR_RUNS)
    return Record(problems, found["verdicts"], *(compared_in(beside) or (problems, {}, [])), found)


LEVELS = (1e-2, 1e-4, 1e-6)
FACTORS = [10**(i / 12) for i in range(25)]  # factors of profiles, from 1 to 100


@dataclass(frozen=True)
class Answer:
    """Answer for one problem. `ways` are sorted by cost. `ties` are schemes whose costs differ from the lowest by
    less than the scatter of costs."""

    level: float
    ways: tuple
    ties: tuple

    @property
    def best(self):
        return self.ways[0] if self.ways else None


def answer(problem, level, noise=1.0):
    ways = tuple(problem.reached.get(level, ()))
    ties = tuple(w.scheme for w in ways[1:] if w.cost <= noise * ways[0].cost)
    return Answer(level, ways, ties)


def by_case(problems):
    """Returns {(case, parameters): [Problem]}."""
    out = {}
    for problem in problems:
        out.setdefault((problem.case, problem.parameters), []).append(problem)
    return out


@dataclass(frozen=True)
class Summary:
    """Summary of a case over all formulations. `wins` is [(scheme, number of problems in which it has the lowest cost
    or ties)]. `reached` is the number of problems in which a scheme reaches the level, and `count` that of all
    problems. `best` are the Ways of the scheme with the most wins. `keeping` is [(scheme, cost relative to the lowest
    cost)]: for each problem, the cheapest Way that conserves energy to round-off."""

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
    """Returns {scheme: number of problems in which its error is within the level}."""
    return {s: sum(any(w.scheme == s for w in answer(p, level).ways) for p in problems)
            for s in ordered({r.scheme for p in problems for r in p.runs if r.known})}


def orders(problems):
    """Returns {scheme: (nominal order, {verdict on the order: number of problems})}."""
    out = {}
    for one in (one for p in problems for one in p.ladders):
        verdicts = out.setdefault(one.scheme, (one.nominal, {}))[1]
        verdicts[one.verdict] = verdicts.get(one.verdict, 0) + 1
    return {s: out[s] for s in ordered(out)}


def judged(problems):
    return [p for p in problems if not p.reference and any(r.known for r in p.runs)]


def series(problem, scheme):
    """Returns [runs with equal steps, runs with a tolerance] of a scheme, each sorted from the coarsest to the finest."""
    own = sorted((r for r in problem.runs if r.scheme == scheme),
                 key=lambda r: (-r.tolerance, -r.step))
    return [[r for r in own if bool(r.tolerance) == wanted] for wanted in (False, True)]


def doubt(problem, way):
    """Returns the reason why the error of a run may be wrong, or an empty string."""
    ladder = problem.ladder(way.scheme)
    if ladder is not None and ladder.verdict == "low order":
        return f"its error falls with order {ladder.order:.1f}, not {ladder.nominal:g}"
    if problem.uncertainty > abs(way.run.error):
        return f"the uncertainty of the reference is {problem.uncertainty:.0e}"
    return ""


def wins(problems, level, noise=1.0):
    """Returns ({scheme: number of problems in which it has the lowest cost or ties}, number of problems in which a
    scheme reaches the level)."""
    count, reached = {}, 0
    for problem in problems:
        found = answer(problem, level, noise)
        reached += found.best is not None
        for scheme in ((found.best.scheme, *found.ties) if found.best else ()):
            count[scheme] = count.get(scheme, 0) + 1
    return count, reached


def profile(problems, level):
    """Returns {scheme: [share of problems within FACTORS of the lowest cost]}. All cases have equal weights."""
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
    """Returns {structure: [Problem]}, the problems that differ only in the stiffening."""
    out = {}
    for problem in problems:
        out.setdefault(problem.structure, []).append(problem)
    return out


def iterations(problems):
    """Returns ({(name, scheme, step): {stiffening: iterations per step}}, stiffenings) for runs with several
    stiffenings."""
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
