"""The largest box of a lattice in which nearly all points hold, simple before large.

A box has for each axis nothing, a bound, two bounds, or some words. Each bound is a condition, and
so are words. One with more conditions is taken only where it has many more points."""
import functools
import itertools
from dataclasses import dataclass

import numpy as np

ALLOWED = 0.03  # share of the points of a box that may be exceptions
LEAST = 0.05  # share of all points below which a box is not worth a sentence
FEWEST = 3  # points
GAIN = 1.2  # of points, for which another condition is taken
WEIGHT = 3  # of an exception against a point that holds: a box ends before mixed ground
CLIMBS = (1, 3, 10, 30)  # weights of exceptions on the way up
ROUNDS = 20  # over all axes
WORDS = 6  # up to which all choices of words are tried


@dataclass(frozen=True)
class Box:
    """chosen: for each axis None or the indices of its parts; good, bad: points that hold and do
    not; whole: points that are asked in all; conditions: their number."""

    chosen: tuple
    good: int
    bad: int
    whole: int
    conditions: int

    @property
    def points(self):
        return self.good + self.bad

    @property
    def share(self):
        """Of all points."""
        return self.points / self.whole if self.whole else 0.0

    def holds(self, index):
        """Which points lie in it; index: of parts [points, axes]."""
        inside = np.ones(len(index), bool)
        for axis, chosen in enumerate(self.chosen):
            if chosen is not None:
                inside &= np.isin(index[:, axis], chosen)
        return inside


@dataclass(frozen=True)
class Choices:
    """All that can be chosen of an axis. member: [choices, parts]; cost: conditions of each."""

    member: np.ndarray
    cost: np.ndarray

    def only(self, most):
        """Those of at most so many conditions."""
        keep = self.cost <= most
        return Choices(self.member[keep], self.cost[keep])


def of_words(count):
    every = range(1, count + 1) if count <= WORDS else (1, count - 1, count)
    sets = [c for k in every for c in itertools.combinations(range(count), k)]
    member = np.zeros((len(sets), count))
    for row, chosen in zip(member, sets):
        row[list(chosen)] = 1
    return Choices(member, np.array([int(len(c) < count) for c in sets]))


@functools.lru_cache(maxsize=None)
def of_numbers(count):
    member, cost = [], []
    for low in range(count):
        for high in range(low, count):
            row = np.zeros(count)
            row[low:high + 1] = 1
            member.append(row)
            cost.append((low > 0) + (high < count - 1))
    return Choices(np.array(member), np.array(cost))


def choices_of(parts):
    return of_words(len(parts)) if parts.axis.words else of_numbers(len(parts))


def scored(good, bad, whole):
    """Points that hold less what exceptions weigh; -infinite where a box is not allowed."""
    points = good + bad
    fine = (bad <= ALLOWED * points) & (points >= max(FEWEST, LEAST * whole))
    return np.where(fine, good - WEIGHT * bad, -np.inf)


class Search:
    """good, bad: points of each cell [parts of each axis]."""

    def __init__(self, parts, good, bad):
        self.good, self.bad = good.astype(float), bad.astype(float)
        self.choices = [choices_of(p) for p in parts]
        self.whole = int(good.sum() + bad.sum())
        self.best = {}  # conditions: (score, {axis: row of its choices})

    def reduced(self, table, axes, fixed):
        """A table over some axes; of the others what is chosen {axis: row}, or all."""
        for axis in reversed(range(table.ndim)):
            if axis not in axes:
                of = self.choices[axis].member
                weights = of[fixed[axis]] if axis in fixed else np.ones(of.shape[1])
                table = np.tensordot(table, weights, axes=([axis], [0]))
        return table

    def keep(self, score, cost, rows):
        """The best of all choices for each number of conditions; rows: {axis: row of each place}.
        score, cost: of the choices, of one shape."""
        for k in np.unique(cost):
            of = np.where(cost == k, score, -np.inf)
            at = np.unravel_index(of.argmax(), of.shape)
            if of[at] > self.best.get(k, (-np.inf, None))[0]:
                self.best[k] = of[at], {a: int(row[at]) for a, row in rows.items()}

    def one(self, axis, fixed):
        """All choices of an axis, the others as they are; their (good, bad) points."""
        of = self.choices[axis]
        good, bad = (of.member @ self.reduced(t, (axis,), fixed) for t in (self.good, self.bad))
        other = {a: row for a, row in fixed.items() if a != axis}
        cost = of.cost + sum(int(self.choices[a].cost[row]) for a, row in other.items())
        rows = {axis: np.arange(len(cost))} | {a: np.full(len(cost), r) for a, r in other.items()}
        self.keep(scored(good, bad, self.whole), cost, rows)
        return good, bad

    def two(self, a, b, c=None):
        """All choices of two axes, with those of one condition of a third one."""
        first, second = self.choices[a], self.choices[b]
        third = np.flatnonzero(self.choices[c].cost == 1) if c is not None else np.zeros(0, int)
        if c is not None and not len(third):
            return

        def table(of):
            found = self.reduced(of, (a, b) if c is None else (a, b, c), {})
            if c is not None:
                found = np.moveaxis(found, sorted((a, b, c)).index(c), 0)
                found = np.tensordot(self.choices[c].member[third], found, axes=1)
            return first.member @ found @ second.member.T

        good, bad = table(self.good), table(self.bad)
        cost = np.broadcast_to(first.cost[:, None] + second.cost + (c is not None), good.shape)
        places = np.indices(good.shape, sparse=True)
        rows = {a: places[-2], b: places[-1]} | ({c: third[places[0]]} if c is not None else {})
        self.keep(scored(good, bad, self.whole), cost,
                  {axis: np.broadcast_to(row, good.shape) for axis, row in rows.items()})

    def climb(self, weight):
        """One axis after the other, from everything, while exceptions weigh so much: a way to boxes
        of many conditions where those of few are not allowed."""
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
        """One axis after the other, from the best there is until nothing is gained."""
        before = None
        while self.best and before != self.best:
            before = dict(self.best)
            for _, fixed in before.values():
                for axis in range(self.good.ndim):
                    self.one(axis, fixed)

    def run(self):
        axes = range(self.good.ndim)
        self.one(0, {})
        if 0 in self.best or self.good.sum() < max(FEWEST, LEAST * self.whole):
            return
        for a in axes:
            self.one(a, {})
        for a, b in itertools.combinations(axes, 2):
            self.two(a, b)
            for c in axes:
                if c not in (a, b):
                    self.two(a, b, c)
        for weight in CLIMBS if len(axes) > 2 else ():
            self.climb(weight)
        if len(axes) > 3:
            self.ascend()

    def box(self, cost, chosen):
        """What was chosen, as a Box."""
        good, bad = (float(self.reduced(t, (), chosen)) for t in (self.good, self.bad))
        parts = [None] * self.good.ndim
        for axis, row in chosen.items():
            if self.choices[axis].cost[row]:
                parts[axis] = tuple(np.flatnonzero(self.choices[axis].member[row]).tolist())
        return Box(tuple(parts), round(good), round(bad), self.whole, int(cost))


def largest(parts, good, bad):
    """The Box, or None where points hold in no box that is worth a sentence."""
    search = Search(parts, good, bad)
    if not search.whole:
        return None
    search.run()
    found = None
    for cost in sorted(search.best):
        box = search.box(cost, search.best[cost][1])
        if found is None or box.good >= GAIN * found.good:
            found = box
    return found
