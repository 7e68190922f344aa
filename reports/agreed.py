"""Where there is no truth: the limit that formulations agree on, and how they stand to it."""
import math
from dataclasses import dataclass

AGREED = "agreement"  # as the judge calls it: of at least two families of formulations


@dataclass
class Row:
    """A quantity of a case at its defaults."""

    case: str
    quantity: str
    unit: str
    value: float
    errors: dict  # formulation -> of its limit
    meshes: dict  # formulation -> elements from which on every mesh is within the level

    def within(self, level):
        return sorted(key for key, error in self.errors.items() if abs(error) <= level)

    @property
    def farthest(self):
        """The formulation whose limit is farthest off; None where all are the same."""
        key = max(self.errors, key=lambda key: (abs(self.errors[key]), key))
        return key if self.errors[key] else None

    @property
    def fewest(self):
        """(elements, formulations that need no more), or None."""
        least = min(self.meshes.values(), default=None)
        keys = (k for k, n in self.meshes.items() if n == least)
        return least and (least, sorted(keys, key=lambda key: (":" in key, key)))


def first_within(series, quantity, level):
    """Elements from which on every mesh is within the level of what is agreed, or None."""
    found = None
    for mesh in reversed(series.meshes):
        if not abs(mesh.model_errors.get(quantity, math.nan)) <= level:
            break
        found = mesh.n
    return found


def row_of(case, quantity, level):
    point = case.points[0]
    tries = [(s, v) for s in point.series for v in s.verdicts
             if v.quantity == quantity and v.model_truth_kind == AGREED and math.isfinite(v.limit)]
    if not tries:
        return None
    meshes = {s.key: first_within(s, quantity, level) for s, _ in tries}
    return Row(case.name, quantity, point.units.get(quantity, ""), tries[0][1].model_truth,
               {s.key: v.model_error for s, v in tries if math.isfinite(v.model_error)},
               {key: n for key, n in meshes.items() if n is not None})


def rows(cases, level):
    """[Row] of quantities that are agreed on and have no truth, at the defaults of each case."""
    found = []
    for case in cases:
        point = case.points[0]
        known = {v.quantity for s in point.series for v in s.verdicts if math.isfinite(v.truth)}
        names = [q for q in point.units if q not in known]
        found += [row for row in (row_of(case, q, level) for q in names) if row and row.errors]
    return found
