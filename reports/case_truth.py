"""What is known of the quantities of a parameter point: truths with their digits, verdicts in a
matrix."""
import math
from dataclasses import dataclass

from reports import answers
from reports.verdicts import BY_NAME, UNJUDGED, percent, remarks

MOST_DIGITS = 15


@dataclass(frozen=True)
class Truth:
    """One truth of a quantity, in its unit; of: the formulations it is for, where not all."""
    value: str
    digits: int
    kind: str
    theory: str
    source: str


@dataclass
class Quantity:
    """meaning: what it is; truths: none where it is not judged."""
    name: str
    unit: str
    meaning: str
    truths: list
    is_curve: bool


def digits_of(value, uncertainty):
    """How many digits of a truth are known."""
    if not value or not uncertainty:
        return MOST_DIGITS
    return max(1, min(MOST_DIGITS, math.floor(math.log10(abs(value) / uncertainty))))


def truths_of(point, name):
    """The different truths that formulations are judged by, each once."""
    out = {}
    for series in point.series:
        v = answers.verdict_of(series, name)
        if v and math.isfinite(v.truth):
            digits = digits_of(v.truth, v.truth_uncertainty)
            truth = Truth(f"{v.truth:.{min(10, digits)}g}", digits, v.truth_kind, v.theory,
                          v.source)
            out.setdefault((truth.value, truth.source), truth)
    return list(out.values())


def quantities(point):
    """Of a point, in the order of the case."""
    curves = {q for s in point.series for m in s.meshes for q in m.curves}
    names = dict.fromkeys([*point.meanings, *point.units])
    return [Quantity(name, point.units[name], point.meanings.get(name, ""),
                     truths_of(point, name), name in curves) for name in names
            if name in point.units]


@dataclass
class Cell:
    """A verdict in the matrix, or an empty one."""
    sign: str
    look: str
    words: str


def away(v):
    """How far another model's limit is from the truth."""
    if not math.isfinite(v.model_error):
        return []
    return [f"{percent(v.model_error)} from the {v.model_truth_kind} value"]


def cell_of(series, name):
    v = None if series.missing else answers.verdict_of(series, name)
    if v is None or v.verdict in UNJUDGED:
        if series.other and v is not None:
            return Cell("○", "model", "; ".join([series.without, *away(v)]))
        why = f"does not offer {series.missing}" if series.missing else v.verdict if v else ""
        return Cell("·", "skip", why)
    kind = BY_NAME[v.verdict]
    words = [v.verdict, *remarks(v)] + ([f"known: {v.finding}"] if v.finding else [])
    return Cell(kind.sign, kind.look, "" if v.verdict == "pass" else "; ".join(words))


def matrix(point):
    """(series, [(quantity, cells)]) of what is judged."""
    names = answers.judged(point)
    shown = [s for s in point.series if any(cell_of(s, n).look != "skip" for n in names)]
    return shown, [(name, [cell_of(s, name) for s in shown]) for name in names]


def tally_of(point):
    """[(kind, number)] of the verdicts of a point, from good to bad."""
    counts = {}
    for series in point.series:
        for v in series.verdicts:
            if v.verdict not in UNJUDGED and not series.missing:
                counts[v.verdict] = counts.get(v.verdict, 0) + 1
    return [(kind, counts[name]) for name, kind in BY_NAME.items() if name in counts]
