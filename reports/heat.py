"""The soonest way of every case to each level: what the heat map and the index show."""
from dataclasses import dataclass

from reports import answers
from reports.site import LEVELS


@dataclass
class Line:
    """A case at its defaults: all its judged quantities together."""

    case: object  # data.Case
    quantities: list  # with a truth to judge by
    found: dict  # level -> answers.Answer


def line(case):
    """None where nothing is judged."""
    point = case.points[0]
    names = answers.judged(point)
    if not names:
        return None
    asked = answers.ALL if len(names) > 1 else names[0]
    return Line(case, names, {level: answers.answer(point, asked, level) for level in LEVELS})


def lines(cases):
    """Of every case with a truth at its defaults."""
    return [found for found in map(line, cases) if found]
