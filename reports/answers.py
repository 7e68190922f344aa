"""Which formulation, with how many elements, reaches a tolerance soonest: the answers that pages show."""
import math
from dataclasses import dataclass

from reports import verdicts as words

ALL = "all quantities"


@dataclass
class Way:
    """The cheapest mesh of a formulation that stays within a level on every finer mesh too."""
    key: str
    n: int
    clock: object  # data.Clock
    error: float
    worst: object  # data.Verdict: the worst of those that it takes

    @property
    def seconds(self):
        return self.clock.least


def judged(point):
    """Quantities of a point with a truth, in the order of the case."""
    names = []
    for series in point.series:
        for v in series.verdicts:
            if math.isfinite(v.truth) and v.quantity not in names:
                names.append(v.quantity)
    return names


def verdict_of(series, quantity):
    return next((v for v in series.verdicts if v.quantity == quantity), None)


def error_of(mesh, quantities):
    """The one of largest size; NaN where one is missing."""
    errors = [mesh.errors.get(q, math.nan) for q in quantities]
    return math.nan if any(not math.isfinite(e) for e in errors) else max(errors, key=abs)


def way(series, quantities, level):
    """The way of one formulation to have all these quantities within the level, or None."""
    verdicts = [verdict_of(series, q) for q in quantities]
    if series.missing or not verdicts or any(v is None or level not in v.reach for v in verdicts):
        return None
    first = max(v.reach[level] for v in verdicts)
    mesh = min((m for m in series.meshes if m.n >= first), key=lambda m: m.seconds)
    return Way(series.key, mesh.n, mesh.clock, error_of(mesh, quantities), words.worst(verdicts))


def ways(point, quantity, level):
    """Of all formulations, the cheapest first."""
    quantities = judged(point) if quantity == ALL else [quantity]
    found = [way(series, quantities, level) for series in point.series]
    return sorted((w for w in found if w is not None), key=lambda w: w.seconds)


def differ(a, b):
    """Do the times of two clocks differ by more than their noise? All rounds of one below all of the other; single runs by a factor of two."""
    if a.repeats > 1 and b.repeats > 1:
        return a.most < b.least or b.most < a.least
    return max(a.least, b.least) > 2 * min(a.least, b.least)


def undecided(found):
    """The ways whose times the noise does not tell from the first one's."""
    return [w for w in found[1:] if not differ(w.clock, found[0].clock)]


def speed_up(found):
    """(least, most) factor from the first to the next formulation that is truly slower, and its key; None when there is none."""
    for w in found[1:]:
        if differ(w.clock, found[0].clock):
            return w.seconds / found[0].seconds, w.key
    return None


def front(point, quantity):
    """[(series, mesh)] not beaten in both time and error, by time."""
    cells = [(s, m) for s in point.series if not s.missing for m in s.meshes
             if math.isfinite(m.errors.get(quantity, math.nan))]
    best, out = math.inf, []
    for series, mesh in sorted(cells, key=lambda c: (c[1].seconds, abs(c[1].errors[quantity]))):
        if abs(mesh.errors[quantity]) < best:
            best = abs(mesh.errors[quantity])
            out.append((series, mesh))
    return out


def failures(point):
    """[(series, mesh, reason)] of cells without a solution."""
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
    """[(series, mesh)] measured with nothing left out."""
    return [(s, m) for s in point.series for m in s.meshes if m.kept is not None]
