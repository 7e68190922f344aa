"""Ranges, boxes and counts in words."""
from reports.sweep.boxes import Box

SMALL = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")


def count(number):
    """Small numbers as words."""
    return SMALL[number] if number < len(SMALL) else f"{number:,}".replace(",", "\u202f")


def plenty(number):
    """A number with its thousands apart."""
    return f"{number:,}".replace(",", "\u202f")


def many(number, noun):
    """A number of things."""
    return f"{plenty(number)} {noun}" + ("s" if number != 1 else "")


def percent(share):
    """Of all points; never 0 or 100 where it is neither."""
    value = 100 * share
    if 0 < value < 1:
        return "less than 1 %"
    if 99.5 <= value < 100:
        return f"{min(value, 99.9):.1f} %"
    return f"{value:.0f} %"


def error(value):
    """The size of a relative error, in percent."""
    value = abs(value)
    if value == float("inf"):
        return "no solution"
    return f"{100 * value:.2g} %" if value < 10 else f"{100 * value:.1e} %"


def tolerance(sweep):
    return f"{100 * sweep.tolerance:g} %"


def elements(number):
    return many(number, "element")


def bounds(part, chosen):
    """[(sign, number)] of an axis with numbers."""
    low, high, found = chosen[0], chosen[-1], []
    if low > 0:
        found.append(("≥", part.low[low] if part.exact else part.cuts[low - 1]))
    if high < len(part) - 1:
        found.append(("≤", part.high[high]) if part.exact else ("<", part.cuts[high]))
    return found


def condition(part, chosen):
    """What is chosen of an axis, in words."""
    axis = part.axis
    if axis.words:
        given, left = (axis.words[i] for i in chosen), set(range(len(part))) - set(chosen)
        if len(left) == 1 and len(part) > 2:
            return f"{axis.name} is not {axis.words[left.pop()]}"
        return f"{axis.name} is " + " or ".join(given)
    unit = f" {axis.unit}" if axis.unit not in ("", "1") else ""
    said = bounds(part, chosen)
    if len(said) == 2:
        (_, low), (sign, high) = said
        return f"{low:.4g} ≤ {axis.name} {sign} {high:.4g}{unit}"
    return f"{axis.name} {said[0][0]} {said[0][1]:.4g}{unit}"


def conditions(box: Box):
    """All of a box: empty where it is everywhere."""
    return " and ".join(condition(p, c) for p, c in zip(box.lattice.parts, box.chosen)
                        if c is not None)


def where(box):
    if box.conditions:
        return f"where {conditions(box)}"
    return "everywhere" if box.asked == box.whole else "wherever that can be judged"


def held(box):
    """The counts behind a statement."""
    there = " there" if box.conditions else ""
    if box.bad:
        said = f"{plenty(box.good)} of {many(box.points, 'point')}{there}"
    else:
        said = ("all " if box.points > 1 else "") + many(box.points, "point") + there
    return said + unjudged(box.whole, box.asked)


def unjudged(whole, asked):
    """Points at which something has nothing to be measured by."""
    return f"; {plenty(whole - asked)} of all {plenty(whole)} cannot be judged" if asked < whole else ""
