"""Finds the formulation and the number of elements that reach a tolerance at the lowest cost.

The rule is that of harness/study/study.h. n is the number of elements of the coarsest mesh for which the errors of
that mesh and of all finer meshes are within the level (the tolerance). Formulations are sorted by the cost of their
counted work on that mesh, so two runs give the same order. Costs that differ from the lowest by less than the
uncertainty of the cost model tie with it. A formulation that does not pass in the requested quantity is listed but is
never the cheapest. Variants whose options change neither errors nor work are omitted.

    found = answers.answer(point, quantity, level) # quantity: a name, ALL, or a list of names
    found.best [Way] the cheapest formulation and those whose costs tie with it; may be empty
    `found.dearer` [Way] the other formulations that are within the level and pass, by cost
    found.defective [Way] formulations within the level but with a verdict other than pass, by cost
    found.faster [Way] formulations of `dearer` that were measured faster than the cheapest in every round
    found.unranked [Way] formulations that are within the level and pass but have no rank (reason: Way.unranked), by name
    found.missed [key] formulations that are not within the level on these meshes
    found.unjudged [key] formulations whose theory has no reference value for at least one requested quantity
"""
import math
from dataclasses import dataclass, field

from reports import data, verdicts as words

ALL = "all quantities"
NO_COSTS = "the results have no costs"  # in results that were written before cost coefficients existed
SOUND = ("pass", *words.UNJUDGED)
LEVELS = tuple(data.REACH)


@dataclass
class Way:
    """The coarsest mesh of a formulation for which the errors of this mesh and of all finer meshes are within a
    level."""
    key: str
    n: int
    cost: float  # cost of counted work, with the cost coefficients of the reference machine [s]
    clock: object  # data.Clock: measured time
    error: float  # error on the mesh, the largest in magnitude of the requested quantities
    worst: object  # data.Verdict: the worst verdict on the requested quantities
    defects: list  # the verdicts that are not in SOUND
    priced: bool = True  # True if the formulation has separate cost coefficients, False for general ones
    unranked: str = ""  # reason why the formulation has no rank, or an empty string

    @property
    def seconds(self):
        return self.clock.least


@dataclass
class Answer:
    quantity: str
    level: float
    best: list = field(default_factory=list)
    dearer: list = field(default_factory=list)
    defective: list = field(default_factory=list)
    faster: list = field(default_factory=list)
    unranked: list = field(default_factory=list)
    missed: list = field(default_factory=list)
    unjudged: list = field(default_factory=list)

    @property
    def ways(self):
        """Returns [(Way, rank, tie)] of all formulations within the level. `tie` is True for the formulations in `best`
        if there are several. The rank is 0 for defective and unranked formulations."""
        ranked = self.best + self.dearer
        return [(w, i + 1, len(self.best) > 1 and i < len(self.best))
                for i, w in enumerate(ranked)] + [(w, 0, False)
                                                  for w in self.unranked + self.defective]


def judged(point):
    names = []
    for series in point.series:
        for v in series.verdicts:
            if math.isfinite(v.truth) and v.quantity not in names:
                names.append(v.quantity)
    return names


def verdict_of(series, quantity):
    return next((v for v in series.verdicts if v.quantity == quantity), None)


def error_of(mesh, quantities):
    errors = [mesh.errors.get(q, math.nan) for q in quantities]
    return math.nan if any(not math.isfinite(e) for e in errors) else max(errors, key=abs)


def first_within(series, quantity, level):
    found = None
    for mesh in reversed(series.meshes):
        if not abs(mesh.errors.get(quantity, math.nan)) <= level:
            break
        found = mesh.n
    return found


def reach(series, v, level):
    """Returns the number of elements that first_within defines, or None. For the levels in data.REACH, it is read from
    the stored verdict."""
    if not math.isfinite(v.truth):
        return None
    return v.reach.get(level) if level in data.REACH else first_within(series, v.quantity, level)


def verdicts_on(series, quantities):
    found = [verdict_of(series, q) for q in quantities]
    known = not series.missing and found and all(v and math.isfinite(v.truth) for v in found)
    return found if known else None


def repeats(point, series, quantities):
    """Returns True if the options of a variant have no effect, that is, if errors and work on every mesh are the same
    as without the options."""
    name, colon, _ = series.key.partition(":")
    plain = next((s for s in point.series if colon and s.key == name and not s.missing), None)

    def done(one):
        return repr([(m.n, m.cost, [m.errors.get(q) for q in quantities]) for m in one.meshes])

    return plain is not None and done(plain) == done(series)


def way(series, quantities, level):
    """Returns the Way of a formulation for all these quantities together, or None if no mesh is within the level."""
    verdicts = verdicts_on(series, quantities)
    if verdicts is None:
        return None
    counts = [reach(series, v, level) for v in verdicts]
    if None in counts:
        return None
    mesh = next(m for m in series.meshes if m.n == max(counts))
    return Way(series.key, mesh.n, mesh.cost, mesh.clock, error_of(mesh, quantities),
               words.worst(verdicts), [v for v in verdicts if v.verdict not in SOUND], mesh.priced,
               series.unranked or ("" if math.isfinite(mesh.cost) else NO_COSTS))


def words_of(v):
    if v.verdict in words.OWN_LIMITS:
        return "with a different limit"
    return {"low order": "of low order", "undecided": "with an undecided limit"}.get(
        v.verdict, v.verdict)


def defect_words(w):
    return words_of(w.worst)


def by_cost(w):
    return math.isnan(w.cost), w.cost, w.key


def answer(point, quantity, level):
    quantities = quantity if isinstance(quantity, list) else judged(point) if quantity == ALL else [quantity]
    out, sound = Answer(quantity, level), []
    for series in point.series:
        if repeats(point, series, quantities):
            continue
        found = way(series, quantities, level)
        if found is not None:
            (out.defective if found.defects else
             out.unranked if found.unranked else sound).append(found)
        elif verdicts_on(series, quantities):
            out.missed.append(series.key)
        elif not series.missing and not series.other:
            out.unjudged.append(series.key)
    sound.sort(key=by_cost)
    out.defective.sort(key=by_cost)
    out.unranked.sort(key=lambda w: w.key)
    ties = sum(not w.cost > point.noise * sound[0].cost for w in sound)
    out.best, out.dearer = sound[:ties], sound[ties:]
    out.faster = [w for w in out.dearer if faster(w.clock, sound[0].clock)]
    return out


def faster(a, b):
    """Returns True if each round of clock a was faster than every round of clock b. Returns False for single runs."""
    return a.repeats > 1 and b.repeats > 1 and a.most < b.least


def differ(a, b):
    """Returns True if two times differ significantly: each round of one is below every round of the other or, for
    single runs, they differ by more than a factor of two."""
    if a.repeats > 1 and b.repeats > 1:
        return a.most < b.least or b.most < a.least
    return max(a.least, b.least) > 2 * min(a.least, b.least)


@dataclass(frozen=True)
class Measure:
    """What a run costs at a parameter point. `name` is "time", or "cost" if there are no times of several rounds, because
    times of single runs scatter too much for comparisons."""
    name: str
    of: object  # function of a mesh [s]
    rounds: int = 0  # number of timed rounds

    @property
    def words(self):
        if self.name == "cost":
            return "cost [ms]: counted work (no rounds were timed)"
        return f"run time [ms], fastest of {self.rounds} rounds" if self.rounds > 1 else "run time [ms] of one run"


def measure_of(point):
    meshes = [m for s in point.series for m in s.meshes]
    rounds = [m.clock.repeats for m in meshes if m.clock.repeats > 1]
    if rounds:
        return Measure("time", lambda m: m.seconds if m.clock.repeats > 1 else math.nan, min(rounds))
    if any(math.isfinite(m.cost) for m in meshes):
        return Measure("cost", lambda m: m.cost)
    return Measure("time", lambda m: m.seconds, 1)


def front(point, quantity):
    """Returns [(series, mesh)] of the Pareto front of error and run time, or cost (measure_of)."""
    measure = measure_of(point).of
    cells = [(s, m) for s in point.series if not s.missing and not s.other and not s.unranked
             for m in s.meshes
             if math.isfinite(m.errors.get(quantity, math.nan)) and math.isfinite(measure(m))]
    best, out = math.inf, []
    for series, mesh in sorted(cells, key=lambda c: (measure(c[1]), abs(c[1].errors[quantity]))):
        if abs(mesh.errors[quantity]) < best:
            best = abs(mesh.errors[quantity])
            out.append((series, mesh))
    return out


def failures(point):
    out = []
    for series in point.series:
        for mesh in series.meshes if not series.missing else []:
            lost = [
                q for q, v in mesh.values.items() if not math.isfinite(v) and q not in mesh.curves
            ]
            if mesh.status != "ok" or lost:
                reason = mesh.reason or next((mesh.reasons[q] for q in lost if mesh.reasons[q]), "")
                out.append((series, mesh, reason, lost))
    return out


def savings(point):
    return [(s, m) for s in point.series for m in s.meshes if m.kept is not None]



@dataclass
class CaseLine:
    case: object  # data.Case
    quantities: list  # the quantities with a reference value
    found: dict  # level -> answers.Answer


def line_of_case(case):
    point = case.points[0]
    names = judged(point)
    if not names:
        return None
    asked = ALL if len(names) > 1 else names[0]
    return CaseLine(case, names, {level: answer(point, asked, level) for level in LEVELS})


def lines_of_cases(cases):
    return [found for found in map(line_of_case, cases) if found]
