"""Every verdict once: which are counted, and which only repeat another one.

An alias is a second name of the same entry of a matrix. That it is one is seen in the results:
both names have the same bits in every cell. A misprint kept as a formulation shares all but one
sign with the corrected form: where both have the same verdict, the misprint adds nothing.
"""
import math
from dataclasses import dataclass

from reports import data
from reports.verdicts import SEVERITY

ALIASES = {"C_xx": "C_ux_Fx", "C_zz": "C_uz_Fz"}
MISPRINTS = {"sheet_third_printed": "sheet_third"}
OWN, ALIAS, MISPRINT = "counted", "alias", "misprint"


@dataclass(frozen=True)
class Row:
    """A verdict and where it stands."""

    case: str
    parameters: str
    formulation: str
    verdict: data.Verdict
    standing: str  # OWN, ALIAS or MISPRINT


def same(a, b):
    return a == b or math.isnan(a) and math.isnan(b)


def is_alias(case, name, other):
    """Have both names the same value wherever either has one, and is there such a place?"""
    values = [m.values for p in case.points for s in p.series for m in s.meshes]
    pairs = [(v.get(name, math.nan), v.get(other, math.nan)) for v in values]
    return all(same(*pair) for pair in pairs) and any(math.isfinite(a) for a, _ in pairs)


def aliases(case):
    """Names of a case that repeat another one."""
    return {name for name, other in ALIASES.items() if is_alias(case, name, other)}


def corrected(key):
    """The formulation that a kept misprint is a variant of, its options kept; or None."""
    name, colon, options = key.partition(":")
    return MISPRINTS[name] + colon + options if name in MISPRINTS else None


def standing(v, key, second_names, judged):
    """judged: {(formulation, quantity): verdict} of the point."""
    if v.quantity in second_names:
        return ALIAS
    return MISPRINT if judged.get((corrected(key), v.quantity)) == v.verdict else OWN


def rows_of_point(case, point, second_names):
    judged = {(s.key, v.quantity): v.verdict for s in point.series for v in s.verdicts}
    for series in point.series:
        for v in series.verdicts:
            stands = standing(v, series.key, second_names, judged)
            yield Row(case.name, point.parameters, series.key, v, stands)


def rows(cases):
    """Every verdict of the results."""
    for case in cases:
        second_names = aliases(case)
        for point in case.points:
            yield from rows_of_point(case, point, second_names)


def counts(found):
    """{verdict: number} of those that are counted, and {standing: number} of the others."""
    by_verdict, left_out = {}, {}
    for row in found:
        own = row.standing == OWN
        into, name = (by_verdict, row.verdict.verdict) if own else (left_out, row.standing)
        into[name] = into.get(name, 0) + 1
    return by_verdict, left_out


def count_verdicts(cases):
    """{verdict: number} of those that are counted, from good to bad."""
    found = counts(rows(cases))[0]
    return dict(sorted(found.items(), key=lambda item: SEVERITY[item[0]]))
