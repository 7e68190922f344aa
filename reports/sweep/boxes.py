"""Finds the largest box of a lattice in which nearly all points are within the tolerance. Simple boxes take precedence
over large boxes.

For each axis, a box has no condition, one bound, two bounds, or a set of words. Each bound is one condition, and a set
of words is one condition. A box with more conditions is preferred only if it contains many more points."""
import functools
import itertools
from dataclasses import dataclass, field

import numpy as np

ALLOWED = 0.03  # maximum share of exceptions among the points of a box
LEAST = 0.05  # share of all points below which a box is not printed
FEWEST = 3  # number of points below which a box is not printed
GAIN = 1.2  # a further condition must increase the number of points at least by this factor
WEIGHT = 3  # weight of an exception relative to a point within the tolerance, so that a box ends before mixed regions
CLIMBS = (1, 3, 10, 30)  # weights of exceptions while a box grows
ROUNDS = 20  # largest number of passes over all axes
FINE = 8  # number of parts of an axis above which three axes are first tried at every second part
WORDS = 6  # number of words up to which all choices of words are tried


@dataclass(frozen=True)
class Box:
    """A box of a lattice. `chosen` is, for each column of the lattice, None or the indices of the selected parts. `good`
    and `bad` are the numbers of points in the box within and outside the tolerance, `whole` is that of all points, and
    `asked` is that of points with a reference value. `conditions` is the number of conditions."""

    lattice: object = field(repr=False)
    chosen: tuple
    good: int
    bad: int
    whole: int
    conditions: int
    asked: int

    @property
    def points(self):
        return self.good + self.bad

    @property
    def share(self):
        return self.points / self.whole if self.whole else 0.0

    def holds(self, at):
        """Returns a mask of the points in the box, where `at` is [points, axes]."""
        inside = np.ones(len(at), bool)
        for chosen, index in zip(self.chosen, self.lattice.index(at).T):
            if chosen is not None:
                inside &= np.isin(index, chosen)
        return inside


@dataclass(frozen=True)
class Choices:
    """All choices on an axis, simple choices first. `member` is [choices, parts], and `cost` is the number of conditions
    of each choice. `coarse` contains the rows of the choices that end only at every second part, if there are many
    parts."""

    member: np.ndarray
    cost: np.ndarray
    coarse: np.ndarray

    @classmethod
    def made(cls, member, cost):
        order = np.argsort(cost, kind="stable")
        member, cost = np.asarray(member, float)[order], np.asarray(cost)[order]
        rows = np.arange(len(cost))
        if member.shape[1] > FINE:
            ends = np.diff(member, axis=1, prepend=0)
            rows = rows[(ends[:, 1::2] == 0).all(axis=1)]
        return cls(member, cost, rows)

    def rows(self, cost):
        return np.flatnonzero(self.cost == cost)


def of_words(count):
    every = range(1, count + 1) if count <= WORDS else (1, count - 1, count)
    sets = [c for k in every for c in itertools.combinations(range(count), k)]
    member = np.zeros((len(sets), count))
    for row, chosen in zip(member, sets):
        row[list(chosen)] = 1
    made = Choices.made(member, [int(len(c) < count) for c in sets])
    return Choices(made.member, made.cost, np.arange(len(sets)))


@functools.lru_cache(maxsize=None)
def of_numbers(count):
    member, cost = [], []
    for low in range(count):
        for high in range(low, count):
            row = np.zeros(count)
            row[low:high + 1] = 1
            member.append(row)
            cost.append((low > 0) + (high < count - 1))
    return Choices.made(member, cost)


def choices_of(parts):
    return of_words(len(parts)) if parts.axis.words else of_numbers(len(parts))


def fewest(whole):
    return max(min(FEWEST, whole), LEAST * whole)


def scored(good, bad, whole):
    """Returns the good points minus the weighted exceptions, or -infinity if a box is not allowed."""
    points = good + bad
    fine = (bad <= ALLOWED * points) & (points >= fewest(whole))
    return np.where(fine, good - WEIGHT * bad, -np.inf)


class Search:
    """Search for the best boxes. `good` and `bad` are the numbers of points in each cell of a lattice [cells]. `whole`
    is the number of all points, or None if every point is good or bad."""

    def __init__(self, lattice, good, bad, whole=None):
        self.lattice = lattice
        self.good, self.bad = (t.reshape(lattice.shape).astype(float) for t in (good, bad))
        self.choices = [choices_of(p) for p in lattice.parts]
        self.asked = int(good.sum() + bad.sum())
        self.whole = self.asked if whole is None else whole
        self.best = {}  # number of conditions -> (score, {axis: row of its choices})

    def reduced(self, table, axes, fixed):
        """Returns a table over some axes. `fixed` is {axis: row} of the choices on other axes. The table is summed over
        the remaining axes."""
        for axis in reversed(range(table.ndim)):
            if axis not in axes:
                of = self.choices[axis].member
                weights = of[fixed[axis]] if axis in fixed else np.ones(of.shape[1])
                table = np.tensordot(table, weights, axes=([axis], [0]))
        return table

    def keep(self, score, rows, fixed):
        """Keeps the best of all choices for each number of conditions. `rows` is {axis: its choices, simple ones first}.
        `score` has a dimension for each of these axes. `fixed` is {axis: row} of the choices on other axes."""
        costs = [self.choices[a].cost[r] for a, r in rows.items()]
        base = sum(int(self.choices[a].cost[r]) for a, r in fixed.items())
        for kinds in itertools.product(*map(np.unique, costs)):
            block = tuple(slice(*np.searchsorted(c, [k, k + 1])) for c, k in zip(costs, kinds))
            of, cost = score[block], base + int(sum(kinds))
            at = np.unravel_index(of.argmax(), of.shape)
            if of[at] > self.best.get(cost, (-np.inf, None))[0]:
                chosen = {a: int(r[b][i]) for (a, r), b, i in zip(rows.items(), block, at)}
                self.best[cost] = float(of[at]), fixed | chosen

    def one(self, axis, fixed):
        """Tries all choices on an axis with the choices on the other axes fixed. Returns the numbers of good and bad
        points for each choice."""
        of = self.choices[axis]
        good, bad = (of.member @ self.reduced(t, (axis,), fixed) for t in (self.good, self.bad))
        other = {a: row for a, row in fixed.items() if a != axis}
        self.keep(scored(good, bad, self.whole), {axis: np.arange(len(of.cost))}, other)
        return good, bad

    def two(self, a, b):
        first, second = self.choices[a], self.choices[b]
        good, bad = (first.member @ self.reduced(t, (a, b), {}) @ second.member.T
                     for t in (self.good, self.bad))
        self.keep(scored(good, bad, self.whole),
                  {a: np.arange(len(first.cost)), b: np.arange(len(second.cost))}, {})

    def three(self, a, b, c):
        """Tries the coarse choices on axes a and b together with all choices on axis c that are one condition."""
        rows = {a: self.choices[a].coarse, b: self.choices[b].coarse, c: self.choices[c].rows(1)}
        if not len(rows[c]):
            return

        def counted(of):
            table = self.reduced(of, (a, b, c), {})
            table = np.moveaxis(table, [sorted(rows).index(k) for k in (c, a, b)], (0, 1, 2))
            table = np.tensordot(self.choices[c].member[rows[c]], table, axes=1)
            return self.choices[a].member[rows[a]] @ table @ self.choices[b].member[rows[b]].T

        score = scored(counted(self.good), counted(self.bad), self.whole)
        self.keep(score, {c: rows[c], a: rows[a], b: rows[b]}, {})

    def climb(self, weight):
        """Restricts one axis after the other, starting without conditions, with this weight of exceptions. This finds
        boxes with many conditions even if boxes with few conditions are not allowed."""
        fixed, before = {}, None
        for _ in range(ROUNDS):
            if fixed == before:
                return
            before = dict(fixed)
            for axis in range(self.good.ndim):
                good, bad = self.one(axis, fixed)
                value = good - weight * bad - 1e-6 * self.choices[axis].cost
                fixed[axis] = int(value.argmax())

    def ascend(self):
        """Changes the choice on one axis after the other, starting from each box in `best`, until no score improves."""
        before = None
        while self.best and before != self.best:
            before = dict(self.best)
            for _, fixed in before.values():
                for axis in range(self.good.ndim):
                    self.one(axis, fixed)

    def enough(self):
        """Returns True if no additional condition could add enough points to a box."""
        most = max((score for score, _ in self.best.values()), default=0)
        return most >= self.good.sum() / GAIN

    def run(self):
        axes = range(self.good.ndim)
        self.one(0, {})
        if 0 in self.best or self.good.sum() < fewest(self.whole) * (1 - ALLOWED):
            return
        for a in axes:
            self.one(a, {})
        if self.enough():
            return
        for a, b in itertools.combinations(axes, 2):
            self.two(a, b)
        if len(axes) < 3 or self.enough():
            return
        for a, b in itertools.combinations(axes, 2):
            for c in axes:
                if c not in (a, b):
                    self.three(a, b, c)
        for weight in CLIMBS:
            self.climb(weight)
        self.ascend()

    def box(self, cost, chosen):
        good, bad = (float(self.reduced(t, (), chosen)) for t in (self.good, self.bad))
        parts = [None] * self.good.ndim
        for axis, row in chosen.items():
            if self.choices[axis].cost[row]:
                parts[axis] = tuple(np.flatnonzero(self.choices[axis].member[row]).tolist())
        return Box(self.lattice, tuple(parts), round(good), round(bad), self.whole, int(cost),
                   self.asked)


def candidates(lattice, good, bad, whole):
    """Returns [Box] with the best box for each number of conditions."""
    search = Search(lattice, good, bad, whole)
    if search.asked:
        search.run()
    return [search.box(cost, chosen) for cost, (_, chosen) in sorted(search.best.items())]


def largest(lattices, counts, whole=None):
    """Returns the largest Box, or None if no box with enough points is within the tolerance. `counts` is [(good, bad)] of
    the cells of each lattice; the first lattice is preferred. `whole` is the argument of Search."""
    every = [box for lattice, (good, bad) in zip(lattices, counts)
             for box in candidates(lattice, good, bad, whole)]
    found = None
    for box in sorted(every, key=lambda b: b.conditions):
        if found is None or box.good >= GAIN * found.good:
            found = box
    return found
