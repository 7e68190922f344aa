"""Points of a sweep in cells: every axis is cut into few parts, so that any number of points takes
the same memory. Parts hold whole values of a grid; those of scattered points end at short numbers.
"""
import itertools
import math
from dataclasses import dataclass, field

import numpy as np

from reports.sweep import stored

MOST = 20  # parts of an axis
CELLS = 1_500_000  # numbers that are kept of all cells together
RATIOS = 6  # of two axes that are tried
EACH = 4  # scattered points in a cell of two axes, in the mean
AXES = 8  # that are cut; of more the others are one part each
LEVELS = 4096  # different values by which an axis counts as a grid


@dataclass
class Parts:
    """An axis in parts. cuts: between them, len - 1; low, high: least and largest value in each;
    exact: their values are those of a grid, so that low and high are what was tried."""

    axis: object  # stored.Axis
    low: np.ndarray
    high: np.ndarray
    cuts: np.ndarray
    exact: bool
    log: bool = False
    levels: np.ndarray = field(default_factory=lambda: np.zeros(0))

    def __len__(self):
        return len(self.low)

    def index(self, values):
        return np.searchsorted(self.cuts, values, side="right")

    def name(self, part):
        """What stands at a part."""
        if self.axis.words:
            return self.axis.words[part]
        if self.exact and self.low[part] == self.high[part]:
            return f"{self.low[part]:.3g}"
        return f"{self.low[part]:.3g} to {self.high[part]:.3g}"


@dataclass(frozen=True, eq=False)
class Lattice:
    """Cells of some columns. columns: an axis (i,), or the ratio of two (i, j); parts: of each."""

    columns: tuple
    parts: tuple

    @property
    def shape(self):
        return tuple(len(p) for p in self.parts)

    @property
    def cells(self):
        return int(np.prod(self.shape))

    def index(self, at):
        """The part of each point in each column [points, columns]; at: [points, axes]."""
        return np.stack([p.index(values_of(c, at)) for c, p in zip(self.columns, self.parts)], 1)

    def cell_of(self, at):
        """The cell of each point."""
        found = np.zeros(len(at), np.int64)
        for k, part in enumerate(self.index(at).T):
            found = found * len(self.parts[k]) + part
        return found


def values_of(column, at):
    """Values of a column at points [points, axes]."""
    return at[:, column[0]] / at[:, column[1]] if len(column) > 1 else at[:, column[0]]


@dataclass
class Extent:
    """What an axis takes: its different values while they are few, least and largest one."""

    levels: np.ndarray
    low: float = math.inf
    high: float = -math.inf

    def take(self, values):
        if len(self.levels) <= LEVELS:
            self.levels = np.union1d(self.levels, values)
        self.low, self.high = min(self.low, values.min()), max(self.high, values.max())


def shortened(edges, width):
    """Numbers with as few digits as a tenth of a width allows."""
    return np.array([round(e, max(0, 1 - math.floor(math.log10(w)))) if w < 1 else
                     round(e, 1 - math.floor(math.log10(w))) for e, w in zip(edges, width)])


def parts_of(axis, extent, most):
    """An axis in at most so many parts."""
    if axis.words:
        number = np.arange(len(axis.words), dtype=float)
        return Parts(axis, number, number, number[1:] - 0.5, True, levels=number)
    if not axis.scattered and axis.kind != "ratio" and len(extent.levels) <= LEVELS:
        groups = np.array_split(extent.levels, min(most, len(extent.levels)))
        low, high = (np.array([g[k] for g in groups]) for k in (0, -1))
        middle = np.sqrt(low[1:] * high[:-1]) if axis.log else (low[1:] + high[:-1]) / 2
        return Parts(axis, low, high, middle, True, axis.log, extent.levels)
    log = axis.log and extent.low > 0
    edges = (np.geomspace if log else np.linspace)(extent.low, extent.high, most + 1)
    cuts = np.zeros(0)
    if extent.high > extent.low:
        cuts = np.unique(shortened(edges[1:-1], np.diff(edges)[:-1]))
    bounds = np.concatenate([[extent.low], cuts, [extent.high]])
    return Parts(axis, bounds[:-1], bounds[1:], cuts, False, log)


def most_parts(sweep):
    """How many parts of an axis the memory for cells, and the number of scattered points, allow."""
    meshes, asked = len(sweep.meshes), len(sweep.quantities) + 1
    room = CELLS / (len(sweep.keys) * asked * (meshes + 2))
    axes = min(AXES, max(1, len(sweep.axes)))
    most = min(MOST if axes > 1 else 2 * MOST, int(room**(1 / axes) + 1e-9))
    if any(a.scattered for a in sweep.axes):
        most = min(most, int(math.sqrt(sweep.points / EACH)))
    return max(2, most)


def ratios_of(sweep, extents):
    """Columns of ratios that may say more than their axes: of one unit, all values positive."""
    pairs = []
    for i, j in itertools.combinations(range(min(AXES, len(sweep.axes))), 2):
        a, b = sweep.axes[i], sweep.axes[j]
        same = a.unit == b.unit and a.unit not in ("", "1") and not (a.words or b.words)
        if same and min(extents[i].low, extents[j].low) > 0:
            pairs.append((i, j) if extents[i].high >= extents[j].high else (j, i))
    return pairs[:RATIOS]


def with_ratio(sweep, parts, pair, extent):
    """The lattice of a ratio and the axes that are not in it."""
    names = "/".join(sweep.axes[k].name for k in pair)
    axis = stored.Axis(names, "1", "ratio", 0, True)
    rest = [k for k in range(len(parts)) if k not in pair]
    most = 2 * max(len(parts[k]) for k in pair)  # one column in the place of two
    return Lattice((pair, *((k,) for k in rest)),
                   (parts_of(axis, extent, most), *(parts[k] for k in rest)))


def extents_of(sweep, columns):
    found = [Extent(np.zeros(0)) for _ in columns]
    for at in sweep.points_only():
        for extent, column in zip(found, columns):
            extent.take(values_of(column, at))
    return found


def of_sweep(sweep):
    """[Lattice], all axes first, then those with a ratio: two passes over the points."""
    columns = tuple((k,) for k in range(len(sweep.axes)))
    extents = extents_of(sweep, columns)
    most = most_parts(sweep)
    parts = tuple(parts_of(a, e, most if i < AXES else 1)
                  for i, (a, e) in enumerate(zip(sweep.axes, extents)))
    pairs = ratios_of(sweep, extents)
    found = extents_of(sweep, pairs) if pairs else []
    return [Lattice(columns, parts),
            *(with_ratio(sweep, parts, pair, extent) for pair, extent in zip(pairs, found))]
