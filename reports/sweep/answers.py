from dataclasses import dataclass, field

from reports.sweep import boxes, gather, stored
from reports.sweep.boxes import Box

# A range with fewer elements is listed first if it has at least this share of the points of the largest range.
ENOUGH = 0.9
# A range with fewer elements is listed if it has at least this share of the points of the first range.
FEWER = 0.15
# A quantity decides if its points within the tolerance are fewer than this share of those of every other quantity.
BEHIND = 0.95
# The largest range is listed if it has more than this multiple of the points of the first range.
WIDER = 1.01


@dataclass
class Range:
    """Range in which a formulation with this number of elements is within the tolerance. `box` is a Box or None.
    `reached` is the number of points within the tolerance, in the box or not. `known` is the number of points with a
    reference value, and `whole` that of all points. `exceptions` are the points of the box that are not within the
    tolerance."""

    mesh: int
    box: object
    reached: int
    known: int
    whole: int
    exceptions: list = field(default_factory=list)

    @property
    def good(self):
        return self.box.good if self.box else 0


@dataclass
class Answer:
    """Answer for a formulation.

      of       ranges for all quantities together, by mesh
      single   {quantity: its ranges}
      first    the range that is listed first, or None
      fewer    a range with fewer elements
      wider    a range with more elements
      absent   True if the formulation does not support the physics at any point
      decided  the quantity that needs the most elements, or an empty string"""

    key: str
    of: list
    single: dict
    first: Range = None
    fewer: Range = None
    wider: Range = None
    absent: bool = False
    decided: str = ""

    def decide(self):
        """Sets `decided`. On the finest mesh that is not sufficient at some points, the deciding quantity is within the
        tolerance at clearly fewer points than every other quantity."""
        short = [i for i, r in enumerate(self.of) if r.reached < r.known]
        if not short or not self.single:
            return
        reached = sorted((of[short[-1]].reached, name) for name, of in self.single.items()
                         if of[short[-1]].known)
        if len(reached) > 1 and reached[0][0] < BEHIND * reached[1][0]:
            self.decided = reached[0][1]

    def choose(self):
        """Sets `first` to the range with the fewest elements that is nearly as wide as the widest. Sets `fewer` and
        `wider` to ranges with fewer and with more elements that are also listed."""
        most = max((r.good for r in self.of), default=0)
        if not most:
            return
        self.first = next(r for r in self.of if r.good >= ENOUGH * most)
        before = [r for r in self.of if r.mesh < self.first.mesh and
                  r.good >= FEWER * self.first.good and r.box]
        self.fewer = max(before, key=lambda r: r.good, default=None)
        self.wider = next((r for r in self.of if r.good == most > WIDER * self.first.good), None)

    @property
    def told(self):
        return [r for r in (self.first, self.fewer, self.wider) if r]

    def same(self):
        """Returns a key. Answers with equal keys are printed in one sentence."""
        if not self.first:
            return self.absent, self.of[-1].reached
        return self.first.mesh, self.first.box.lattice, self.first.box.chosen


def ranges(found, meshes, f, q):
    """Returns [Range] of a formulation and a quantity for every mesh."""
    whole, reach, out = int(found.points.sum()), [table[:, f, q] for table in found.reaches], []
    for m, n in enumerate(meshes):
        counts = [(r[:, :m + 1].sum(axis=1), r[:, m + 1:].sum(axis=1)) for r in reach]
        reached, known = int(counts[0][0].sum()), int(reach[0].sum())
        same = out and out[-1].reached == reached
        box = out[-1].box if same else boxes.largest(found.lattices, counts, whole)
        out.append(Range(n, box, reached, known, whole))
    return out


def answer(sweep, found, f):
    count = len(sweep.quantities)
    of = ranges(found, sweep.meshes, f, count)
    single = {q.name: ranges(found, sweep.meshes, f, i) for i, q in enumerate(sweep.quantities)
              } if count > 1 else {}
    made = Answer(sweep.keys[f], of, single)
    made.choose()
    made.decide()
    absent = found.status[f][:, sweep.outcomes(stored.ABSENT)].sum()
    made.absent = bool(absent == found.status[f].sum())
    return made


def of_sweep(sweep, found):
    made = [answer(sweep, found, f) for f in range(len(sweep.keys))]
    told = [(a, r) for a in made for r in a.told]
    asked = [(r.box, sweep.keys.index(a.key), len(sweep.quantities), sweep.meshes.index(r.mesh))
             for a, r in told]
    for (_, r), named in zip(told, gather.exceptions(sweep, asked)):
        r.exceptions = named
    most = max((a.first.good for a in made if a.first), default=0)

    def order(a):
        if not a.first:
            return 2, 0, 0, a.key
        wide = a.first.good >= ENOUGH * most
        return not wide, a.first.mesh if wide else 0, -a.first.good, a.key

    return sorted(made, key=order)


@dataclass
class Group:
    """Answers with the same range and number of elements, which are printed in one sentence.

      least       the answer with the fewest points within the tolerance
      worst       [(formulation, exception)], the worst first
      exceptions  number of exceptions
      fewer       range with fewer elements that all answers have in common, or None
      wider       range with more elements that all answers have in common, or None
      more        True if some answers have other ranges, which are not printed"""

    answers: list

    @property
    def least(self):
        return min(self.answers, key=lambda a: a.first.good)

    @property
    def alike(self):
        return len({(a.first.good, a.first.box.points) for a in self.answers}) == 1

    @property
    def exceptions(self):
        return sum(a.first.box.bad for a in self.answers)

    @property
    def worst(self):
        found = [(a.key, e) for a in self.answers for e in a.first.exceptions]
        return sorted(found, key=lambda row: -row[1].error)

    def common(self, name):
        found = {(r.mesh, r.box) if r else None for r in (getattr(a, name) for a in self.answers)}
        return getattr(self.answers[0], name) if len(found) == 1 else None

    @property
    def fewer(self):
        return self.common("fewer")

    @property
    def wider(self):
        return self.common("wider")

    @property
    def more(self):
        return any(getattr(a, name) and not self.common(name) for a in self.answers
                   for name in ("fewer", "wider"))


def together(made):
    """Returns [Group] of answers that are printed in one sentence, in the order of the answers."""
    groups = {}
    for each in made:
        groups.setdefault(each.same(), []).append(each)
    return [Group(group) for group in groups.values()]


def unknown(sweep, found, q):
    """Returns (number of points without a reference value for a quantity, Box of these points or None)."""
    known = found.known[:, q]
    without = found.points - known
    if not without.any():
        return 0, None
    box = boxes.largest(found.lattices[:1], [(without, known)])
    return int(without.sum()), box


def outcomes(sweep, found):
    """Returns [(formulation, outcome, number of runs with this outcome, number of runs of the formulation, [(Parts,
    low, high)])] of outcomes without a solution. The list contains the axes on which the outcome occurs only from `low`
    to `high`."""
    out = []
    for f, key in enumerate(sweep.keys):
        for s, name in enumerate(sweep.statuses):
            cells = int(found.status[f, :, s].sum())
            if name == "ok" or not cells:
                continue
            low, high = found.failed[f, s]
            where = [(p, float(a), float(b)) for p, a, b in zip(found.parts, low, high)
                     if not p.axis.words and (a > p.low[0] or b < p.high[-1])]
            out.append((key, name.replace("_", " "), cells, int(found.status[f].sum()), where))
    return sorted(out, key=lambda row: -row[2])


def proven(rows):
    """Returns the quantities that have reference values at some points and only limits at other points, and the largest
    number of their points with reference values. `rows` is the result of references()."""
    mixed = []
    for quantity, kinds, *_ in rows:
        truths = sum(n for kind, n in kinds.items() if kind.startswith("truth"))
        if 0 < truths < sum(kinds.values()):
            mixed.append((quantity.name, truths))
    return [name for name, _ in mixed], max((n for _, n in mixed), default=0)


def references(sweep, found):
    """Returns [(quantity, {kind: number of points}, largest relative uncertainty, number of points with an uncertainty
    beyond the tolerance, number of points without a reference value, Box of the latter or None)]."""
    rows = []
    for q, quantity in enumerate(sweep.quantities):
        kinds = {name: int(n) for name, n in zip(sweep.kinds, found.kinds[q])
                 if n and not name.startswith(stored.NONE)}
        without, box = unknown(sweep, found, q)
        rows.append((quantity, kinds, float(found.doubt[q]), int(found.doubtful[q]), without, box))
    return rows


SMALL = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")


def count(number):
    return SMALL[number] if number < len(SMALL) else f"{number:,}".replace(",", "\u202f")


def plenty(number):
    return f"{number:,}".replace(",", "\u202f")


def many(number, noun):
    return f"{plenty(number)} {noun}" + ("s" if number != 1 else "")


def percent(share):
    value = 100 * share
    if 0 < value < 1:
        return "less than 1 %"
    if 99.5 <= value < 100:
        return f"{min(value, 99.9):.1f} %"
    return f"{value:.0f} %"


def error(value):
    value = abs(value)
    if value == float("inf"):
        return "no solution"
    return f"{100 * value:.2g} %" if value < 10 else f"{100 * value:.1e} %"


def tolerance(sweep):
    return f"{100 * sweep.tolerance:g} %"


def elements(number):
    return many(number, "element")


def bounds(part, chosen):
    low, high, found = chosen[0], chosen[-1], []
    if low > 0:
        found.append(("≥", part.low[low] if part.exact else part.cuts[low - 1]))
    if high < len(part) - 1:
        found.append(("≤", part.high[high]) if part.exact else ("<", part.cuts[high]))
    return found


def condition(part, chosen):
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
    """Describes a box. Returns an empty string if the box covers all points."""
    return " and ".join(condition(p, c) for p, c in zip(box.lattice.parts, box.chosen)
                        if c is not None)


def where(box):
    if box.conditions:
        return f"where {conditions(box)}"
    return "everywhere" if box.asked == box.whole else "wherever that can be judged"


def held(box):
    """Returns the counts of points on which a statement about a box is based."""
    there = " there" if box.conditions else ""
    if box.bad:
        said = f"{plenty(box.good)} of {many(box.points, 'point')}{there}"
    else:
        said = ("all " if box.points > 1 else "") + many(box.points, "point") + there
    return said + unjudged(box.whole, box.asked)


def unjudged(whole, asked):
    return f"; {plenty(whole - asked)} of all {plenty(whole)} cannot be judged" if asked < whole else ""
