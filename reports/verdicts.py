"""The verdicts of the judge in words: sign, look, meaning, what a record says beside its name."""
import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Kind:
    name: str  # as in the results
    sign: str  # where there is no room
    look: str  # class of the style sheet
    meaning: str


# From good to bad, then what is not judged: of several verdicts the last one counts.
KINDS = (
    Kind("pass", "✓", "pass", "the limit is the truth as far as both are known"),
    Kind("low order", "↓", "other", "the limit is the truth, approached more slowly than need be"),
    Kind("undecided", "~", "other", "the limit is not known well enough to say more"),
    Kind("biased", "≈", "other", "within the tolerance, but significantly different from the reference value"),
    Kind(
        "biased, as predicted",
        "≅",
        "known",
        "within the tolerance, a limit of its own, derived for the form as printed",
    ),
    Kind(
        "wrong limit, as predicted",
        "≡",
        "known",
        "a limit of its own beyond the tolerance, derived for the form as printed: the program does what is printed",
    ),
    Kind("wrong limit", "≠", "wrong", "a limit that is significantly beyond the tolerance"),
    Kind("refused", "R", "other", "the finest mesh was refused, with its reason"),
    Kind("diverged", "✗", "wrong", "the finest mesh has no value"),
    Kind("skip", "·", "skip", "needs what the formulation does not offer"),
    Kind("no truth", "·", "skip", "there is none of its theory"),
    Kind("other model", "○", "skip",
         "without physics that the formulation does not offer: shown, not judged"),
)
BY_NAME = {kind.name: kind for kind in KINDS}
SEVERITY = {kind.name: i for i, kind in enumerate(KINDS)}
AS_PREDICTED = ("biased, as predicted", "wrong limit, as predicted")
OWN_LIMITS = ("biased", "wrong limit", *AS_PREDICTED)
UNJUDGED = ("skip", "no truth", "other model")


def worst(verdicts):
    """The record of the worst kind; of several the one whose limit is farthest off."""

    def badness(v):
        return SEVERITY[v.verdict], abs(v.error) if math.isfinite(v.error) else 0

    return max(verdicts, key=badness)


def percent(value):
    return f"{100 * value:+.3g} %"


def met(v):
    """How far the limit is from the predicted one, relative to that; NaN where none was derived."""
    return abs(v.limit - v.predicted) / abs(v.predicted) if v.predicted else math.nan


def of_limit(v):
    """What is said of a limit that is not the truth, or is not known to be."""
    if v.verdict == "undecided" and v.truth:
        known = 100 * v.limit_uncertainty / abs(v.truth)
        return [f"{percent(v.error)} from the truth, known to ± {known:.2g} %"]
    if v.verdict not in OWN_LIMITS:
        return []
    words = [f"{percent(v.error)} from the truth"]
    if math.isfinite(v.predicted):
        hit = "met to" if v.verdict.endswith("predicted") else "missed by"
        words.append(f"predicted {v.predicted:.10g}, {hit} {met(v):.1e}")
    return words


def remarks(v, distance=True):
    """Short sentences for a verdict's cell in a table; distance: of a limit from the truth, too,
    which a table with a column for it does without."""
    words = of_limit(v) if math.isfinite(v.limit) else []
    if not distance and v.verdict in OWN_LIMITS:
        words = words[1:]
    if v.below_digits:
        words.append("error below the truth's digits")
    if math.isfinite(v.contradicted):
        words.append(f"the published {v.contradicted:.8g} cannot be")
    return words
