"""Descriptions of verdicts: sign, style, meaning, and additional text for a record."""
import math
from dataclasses import dataclass

from reports import data


@dataclass(frozen=True)
class Kind:
    name: str  # name in the results
    sign: str  # sign that is used if there is no room for the name
    look: str  # class of the style sheet
    meaning: str


# Kinds from good to bad, then kinds without a verdict. Of several kinds, the worst is the last one in this order.
KINDS = (
    Kind("pass", "✓", "pass", "the limit agrees with the reference value within the uncertainties"),
    Kind("low order", "↓", "other", "the limit is the reference value, but the order of convergence is too low"),
    Kind("undecided", "~", "other", "the uncertainty of the limit is too large for a verdict"),
    Kind("biased", "≈", "other", "within the tolerance, but significantly different from the reference value"),
    Kind(
        "biased, as predicted",
        "≅",
        "known",
        "within the tolerance, with a different limit that was derived for the form as printed",
    ),
    Kind(
        "wrong limit, as predicted",
        "≡",
        "known",
        "a different limit outside the tolerance, derived for the form as printed: the program does what is printed",
    ),
    Kind("wrong limit", "≠", "wrong", "a limit that is significantly outside the tolerance"),
    Kind("refused", "R", "other", "the finest mesh was rejected, with a reason"),
    Kind("diverged", "✗", "wrong", "the finest mesh has no value"),
    Kind("skip", "·", "skip", "requires physics that the formulation does not support"),
    Kind("no truth", "·", "skip", "no reference value for its theory"),
    Kind("other model", "○", "skip",
         "the formulation omits physics of the case: shown without a verdict"),
)
BY_NAME = {kind.name: kind for kind in KINDS}
SEVERITY = {kind.name: i for i, kind in enumerate(KINDS)}
AS_PREDICTED = ("biased, as predicted", "wrong limit, as predicted")
OWN_LIMITS = ("biased", "wrong limit", *AS_PREDICTED)
UNJUDGED = ("skip", "no truth", "other model")


def worst(verdicts):
    """Returns the record of the worst kind. Of several such records, returns the record whose limit is farthest from the
    reference value."""

    def badness(v):
        return SEVERITY[v.verdict], abs(v.error) if math.isfinite(v.error) else 0

    return max(verdicts, key=badness)


def percent(value):
    return f"{100 * value:+.3g} %"


def met(v):
    """Returns the distance of the limit from the predicted limit relative to the latter, or NaN if none was predicted."""
    return abs(v.limit - v.predicted) / abs(v.predicted) if v.predicted else math.nan


def of_limit(v):
    if v.verdict == "undecided" and v.truth:
        known = 100 * v.limit_uncertainty / abs(v.truth)
        return [f"{percent(v.error)} from the reference value, known to ± {known:.2g} %"]
    if v.verdict not in OWN_LIMITS:
        return []
    words = [f"{percent(v.error)} from the reference value"]
    if math.isfinite(v.predicted):
        hit = "met to" if v.verdict.endswith("predicted") else "missed by"
        words.append(f"predicted {v.predicted:.10g}, {hit} {met(v):.1e}")
    return words


def remarks(v, distance=True):
    """Returns short sentences for the cell of a verdict in a table. If `distance` is True, the text includes the distance
    of a limit from the reference value. `distance` is False if the table has a column for it."""
    words = of_limit(v) if math.isfinite(v.limit) else []
    if not distance and v.verdict in OWN_LIMITS:
        words = words[1:]
    if v.below_digits:
        words.append("error below the reference value's digits")
    if math.isfinite(v.contradicted):
        words.append(f"the published value {v.contradicted:.8g} is impossible")
    return words


# Counts every verdict once and finds verdicts that only repeat another verdict.
#
# An alias is a second name of the same entry of a matrix. Aliases are recognised from the results: the values of both
# names are equal, bit for bit, in every run. A formulation with a misprint differs from the corrected form in one sign.
# If both have the same verdict, the verdict is counted only once.

ALIASES = {"C_xx": "C_ux_Fx", "C_zz": "C_uz_Fz"}
MISPRINTS = {"sheet_third_printed": "sheet_third"}
OWN, ALIAS, MISPRINT = "counted", "alias", "misprint"


@dataclass(frozen=True)
class TallyRow:
    """A verdict and its location."""

    case: str
    parameters: str
    formulation: str
    verdict: data.Verdict
    standing: str  # OWN, ALIAS or MISPRINT


def same(a, b):
    return a == b or math.isnan(a) and math.isnan(b)


def is_alias(case, name, other):
    values = [m.values for p in case.points for s in p.series for m in s.meshes]
    pairs = [(v.get(name, math.nan), v.get(other, math.nan)) for v in values]
    return all(same(*pair) for pair in pairs) and any(math.isfinite(a) for a, _ in pairs)


def aliases(case):
    return {name for name, other in ALIASES.items() if is_alias(case, name, other)}


def corrected(key):
    """Returns the corrected formulation with the same options, or None if this formulation does not contain a
    misprint."""
    name, colon, options = key.partition(":")
    return MISPRINTS[name] + colon + options if name in MISPRINTS else None


def standing(v, key, second_names, judged):
    """Returns OWN, ALIAS or MISPRINT. `judged` is {(formulation, quantity): verdict} at the point."""
    if v.quantity in second_names:
        return ALIAS
    return MISPRINT if judged.get((corrected(key), v.quantity)) == v.verdict else OWN


def rows_of_point(case, point, second_names):
    judged = {(s.key, v.quantity): v.verdict for s in point.series for v in s.verdicts}
    for series in point.series:
        for v in series.verdicts:
            stands = standing(v, series.key, second_names, judged)
            yield TallyRow(case.name, point.parameters, series.key, v, stands)


def rows(cases):
    for case in cases:
        second_names = aliases(case)
        for point in case.points:
            yield from rows_of_point(case, point, second_names)


def counts(found):
    by_verdict, left_out = {}, {}
    for row in found:
        own = row.standing == OWN
        into, name = (by_verdict, row.verdict.verdict) if own else (left_out, row.standing)
        into[name] = into.get(name, 0) + 1
    return by_verdict, left_out


def count_verdicts(cases):
    found = counts(rows(cases))[0]
    return dict(sorted(found.items(), key=lambda item: SEVERITY[item[0]]))
