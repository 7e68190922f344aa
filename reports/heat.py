"""The soonest way of every case to each level: what the heat map and the index show."""
from dataclasses import dataclass

from reports import answers
from reports.site import LEVELS


@dataclass
class Line:
    """A case at its defaults. ways: {level: the answers.Way that is there soonest, or None}."""

    case: object  # data.Case
    quantities: list  # with a truth to judge by
    quantity: str  # one of them, or answers.ALL
    ways: dict


def soonest(point, quantity, level):
    """The way that wins, or None where no formulation is there."""
    found = answers.answer(point, quantity, level)
    return found.best[0] if found.best else None


def line(case, quantity=None):
    """For one quantity, or for all that are judged; None where nothing is."""
    point = case.points[0]
    names = answers.judged(point)
    if not names:
        return None
    wanted = quantity or (answers.ALL if len(names) > 1 else names[0])
    return Line(case, names, wanted, {level: soonest(point, wanted, level) for level in LEVELS})


def lines(cases):
    """Of every case with a truth at its defaults."""
    return [found for found in map(line, cases) if found]
