"""Points without reference values, as in your own scenes: the limit on which families of formulations agree stands for the
reference value in figures and recommendations. It is not a reference value, so there are no verdicts."""
import dataclasses
import math

from reports import answers

AGREED = "agreement"  # kind of a value in the results on which at least two families of formulations agree
FROM = " from that on which "  # these words precede the names of the formulations in messages of verdicts


@dataclasses.dataclass(frozen=True)
class Agreement:
    """Value of a quantity on which formulations agree. `words` names these formulations and the theory."""

    quantity: str
    unit: str
    value: float
    words: str
    farthest: str  # formulation whose limit is farthest from the value
    distance: float  # its distance, relative to the value


def is_agreed(v):
    return v.model_truth_kind == AGREED and math.isfinite(v.model_truth)


def agreements(point):
    """Returns [Agreement] of the quantities of a point without a reference value."""
    known, found = set(answers.judged(point)), {}
    for series in point.series:
        for v in series.verdicts:
            if v.quantity not in known and is_agreed(v) and not series.missing:
                found.setdefault(v.quantity, []).append((series, v))
    out = []
    for quantity, rows in found.items():
        own = [(s, v) for s, v in rows if math.isfinite(v.model_error) and not s.other]
        far, v = max(own, key=lambda row: abs(row[1].model_error), default=rows[0])
        words = next((v.message.partition(FROM)[2] for _, v in rows if FROM in v.message), "")
        out.append(Agreement(quantity, point.units.get(quantity, ""), v.model_truth, words, far.key, v.model_error))
    return out


def within(series, quantity):
    """Returns {level: number of elements from which all meshes are within the level of the agreed limit}."""
    found = {}
    for level in answers.LEVELS:
        for mesh in reversed(series.meshes):
            if not abs(mesh.model_errors.get(quantity, math.nan)) <= level:
                break
            found[level] = mesh.n
    return found


def taken(series, names):
    """Returns a copy of a series in which the agreed limits of these quantities stand for reference values. A series of
    another model has no errors relative to them."""
    verdicts = [dataclasses.replace(v, truth=v.model_truth, truth_kind=AGREED, error=v.model_error, truth_uncertainty=0.0,
                                    tolerance=math.nan, reach=within(series, v.quantity))
                if v.quantity in names and is_agreed(v) and not series.other else v for v in series.verdicts]
    meshes = [dataclasses.replace(m, errors={**m.errors, **{q: e for q, e in m.model_errors.items() if q in names}})
              for m in series.meshes]
    return dataclasses.replace(series, verdicts=verdicts, meshes=meshes)


def ranked(point):
    """Returns the point for figures and recommendations: the point itself if it has a reference value or no agreement,
    otherwise a copy in which the agreed limits stand for reference values."""
    names = set() if answers.judged(point) else {a.quantity for a in agreements(point)}
    return dataclasses.replace(point, series=[taken(s, names) for s in point.series]) if names else point


def without_any(point):
    """Returns the quantities with values but neither a reference value nor an agreement."""
    known = {*answers.judged(point), *(a.quantity for a in agreements(point))}
    curves = {q for s in point.series for m in s.meshes for q in m.curves}
    return [q for q in point.units if q not in known and q not in curves]
