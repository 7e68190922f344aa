"""Makes one pass over a sweep: collects the data of the page for any number of points, counted in the cells of a lattice.
The last quantity of every table represents all quantities together."""
import itertools
import math
from dataclasses import dataclass, field

import numpy as np

from reports.sweep import stored

# Points of a sweep in cells. Every axis is divided into a few parts, so that any number of points takes the same
# memory. The parts of a grid contain its values. The parts of scattered points end at round numbers.

MOST = 20  # largest number of parts of an axis
CELLS = 1_500_000  # maximum number of values stored for all cells together
RATIOS = 6  # largest number of ratios of two axes that are tried
EACH = 4  # average number of scattered points in a cell of two axes
AXES = 8  # largest number of axes that are divided; further axes have a single part
LEVELS = 4096  # largest number of different values of an axis of a grid


@dataclass
class Parts:
    """An axis in parts. `cuts` are the boundaries between parts (one fewer than parts). `low` and `high` are the smallest
    and largest value in each part. `exact` is True if the values are those of a grid, so that low and high were
    actually run."""

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
        if self.axis.words:
            return self.axis.words[part]
        if self.exact and self.low[part] == self.high[part]:
            return f"{self.low[part]:.3g}"
        return f"{self.low[part]:.3g} to {self.high[part]:.3g}"


@dataclass(frozen=True, eq=False)
class Lattice:
    """The cells that the parts of some columns form. `columns` contains an axis (i,) or the ratio of two axes (i, j) for
    each column. `parts` are the Parts of each column."""

    columns: tuple
    parts: tuple

    @property
    def shape(self):
        return tuple(len(p) for p in self.parts)

    @property
    def cells(self):
        return int(np.prod(self.shape))

    def index(self, at):
        """Returns the part of each point in each column [points, columns], where `at` is [points, axes]."""
        return np.stack([p.index(values_of(c, at)) for c, p in zip(self.columns, self.parts)], 1)

    def cell_of(self, at):
        found = np.zeros(len(at), np.int64)
        for k, part in enumerate(self.index(at).T):
            found = found * len(self.parts[k]) + part
        return found


def values_of(column, at):
    """Returns the values of a column at points [points, axes]."""
    return at[:, column[0]] / at[:, column[1]] if len(column) > 1 else at[:, column[0]]


@dataclass
class Extent:
    """Smallest and largest value of an axis, and its different values if they are few."""

    levels: np.ndarray
    low: float = math.inf
    high: float = -math.inf

    def take(self, values):
        if len(self.levels) <= LEVELS:
            self.levels = np.union1d(self.levels, values)
        self.low, self.high = min(self.low, values.min()), max(self.high, values.max())


def shortened(edges, width):
    """Rounds each number to a multiple of a power of ten that is at most a tenth of its width."""
    return np.array([round(e, max(0, 1 - math.floor(math.log10(w)))) if w < 1 else
                     round(e, 1 - math.floor(math.log10(w))) for e, w in zip(edges, width)])


def parts_of(axis, extent, most):
    """Returns the Parts of an axis: one for each of its words, or at most `most` parts of its numbers."""
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
    """Returns the largest number of parts of an axis, from the memory and the number of scattered points."""
    meshes, asked = len(sweep.meshes), len(sweep.quantities) + 1
    room = CELLS / (len(sweep.keys) * asked * (meshes + 2))
    axes = min(AXES, max(1, len(sweep.axes)))
    most = min(MOST if axes > 1 else 2 * MOST, int(room**(1 / axes) + 1e-9))
    if any(a.scattered for a in sweep.axes):
        most = min(most, int(math.sqrt(sweep.points / EACH)))
    return max(2, most)


def ratios_of(sweep, extents):
    """Returns the pairs of axes that have the same unit and positive values, whose ratio may describe the results."""
    pairs = []
    for i, j in itertools.combinations(range(min(AXES, len(sweep.axes))), 2):
        a, b = sweep.axes[i], sweep.axes[j]
        same = a.unit == b.unit and a.unit not in ("", "1") and not (a.words or b.words)
        if same and min(extents[i].low, extents[j].low) > 0:
            pairs.append((i, j) if extents[i].high >= extents[j].high else (j, i))
    return pairs[:RATIOS]


def with_ratio(sweep, parts, pair, extent):
    """Returns the lattice of the ratio of a pair of axes and of all other axes."""
    names = "/".join(sweep.axes[k].name for k in pair)
    axis = stored.Axis(names, "1", "ratio", 0, True)
    rest = [k for k in range(len(parts)) if k not in pair]
    most = 2 * max(len(parts[k]) for k in pair)  # one column instead of two
    return Lattice((pair, *((k,) for k in rest)),
                   (parts_of(axis, extent, most), *(parts[k] for k in rest)))


def extents_of(sweep, columns):
    found = [Extent(np.zeros(0)) for _ in columns]
    for at in sweep.points_only():
        for extent, column in zip(found, columns):
            extent.take(values_of(column, at))
    return found


def lattice_of(sweep):
    """Returns [Lattice]: that of all axes, then those with a ratio. The points are read once, or twice if there are
    ratios."""
    columns = tuple((k,) for k in range(len(sweep.axes)))
    extents = extents_of(sweep, columns)
    most = most_parts(sweep)
    parts = tuple(parts_of(a, e, most if i < AXES else 1)
                  for i, (a, e) in enumerate(zip(sweep.axes, extents)))
    pairs = ratios_of(sweep, extents)
    found = extents_of(sweep, pairs) if pairs else []
    return [Lattice(columns, parts),
            *(with_ratio(sweep, parts, pair, extent) for pair, extent in zip(pairs, found))]


NAMED = 3  # number of exceptions of a box that are stored, the worst first


@dataclass
class Gathered:
    """Counts of F formulations, M meshes, Q quantities (and all of them together) in the C cells of the first lattice.

      reaches      for each lattice, numbers of points, sorted by the coarsest mesh such that it and all finer meshes
                   are within the tolerance [C, F, Q+1, M+2]; M: no mesh; M+1: no mesh, and the finest mesh has no
                   solution. Only points at which the formulation is compared are counted
      reach        `reaches` of the first lattice
      known        points with a reference value [C, Q+1]
      worst        largest error [C, F, Q+1, M], infinite without a solution, -1 if nothing is compared
      wins         number of points at which a formulation has the lowest cost within the tolerance for all quantities,
                   or ties within the uncertainty of the cost model [C, F]
      winner_cost  sum of its costs at these points [s] [C, F]
      unwon        points with a reference value but without a winner
      kinds        reference values by kind [Q, kinds]
      `doubt`      largest relative uncertainty [Q]
      doubtful     number of reference values whose uncertainty exceeds the tolerance [Q]
      status       runs by outcome [F, M, S]
      failed       smallest and largest value of each axis where an outcome occurs [F, S, 2, A]
      points       all points [C]
      ranked       True if a formulation has counted costs at any point [F]"""

    lattices: list
    reaches: list
    known: np.ndarray
    worst: np.ndarray
    wins: np.ndarray
    winner_cost: np.ndarray
    kinds: np.ndarray
    doubt: np.ndarray
    doubtful: np.ndarray
    status: np.ndarray
    failed: np.ndarray
    points: np.ndarray
    ranked: np.ndarray
    unwon: int = 0

    @property
    def reach(self):
        return self.reaches[0]

    @property
    def parts(self):
        return self.lattices[0].parts

    @property
    def judged(self):
        return int(self.known[:, -1].sum())

    @property
    def shape(self):
        return self.lattices[0].shape


def empty(sweep, lattices):
    cells = lattices[0].cells
    f, m, q, s = (len(x) for x in (sweep.keys, sweep.meshes, sweep.quantities, sweep.statuses))
    failed = np.full((f, s, 2, len(sweep.axes)), np.inf)
    failed[:, :, 1] = -np.inf
    reaches = [np.zeros((each.cells, f, q + 1, m + 2), np.int32) for each in lattices]
    return Gathered(lattices, reaches, np.zeros((cells, q + 1), np.int32),
                    np.full((cells, f, q + 1, m), -1, np.float32), np.zeros((cells, f), np.int32),
                    np.zeros((cells, f)), np.zeros((q, len(sweep.kinds)), np.int64), np.zeros(q),
                    np.zeros(q, np.int64), np.zeros((f, m, s), np.int64), failed,
                    np.zeros(cells, np.int32), np.zeros(f, bool))


def known_in(sweep, piece):
    """Returns True where a reference value exists [points, Q+1]. The last column is True if at least one quantity has a
    reference value."""
    own = ~np.isin(piece.kind, sweep.without)
    return np.concatenate([own, own.any(axis=1, keepdims=True)], axis=1)


def asked_in(sweep, piece):
    """Returns True where a formulation is compared with the reference value [points, F, Q+1]. Formulations are not
    compared if they do not support the physics, or if the reference value belongs to another theory, so that there is
    a value but no error. All quantities together are not compared if a quantity has a value but no error, unless
    another quantity is never within the tolerance."""
    own = np.repeat(known_in(sweep, piece)[:, None, :-1], len(sweep.keys), axis=1)
    own &= ~np.isin(piece.status, sweep.outcomes(stored.ABSENT)).any(axis=2)[..., None]
    open_ = (np.isfinite(piece.value) & np.isnan(piece.error)).any(axis=2)
    own &= ~open_
    off = (own & (piece.least == 0)).any(axis=2, keepdims=True)
    whole = own.any(axis=2, keepdims=True) & (off | ~open_.any(axis=2, keepdims=True))
    return np.concatenate([own, whole], axis=2)


def errors_in(piece, asked):
    """Returns the errors [points, F, Q+1, M], which are -1 if there is no comparison and infinite without a
    solution."""
    own = np.where(np.isnan(piece.error), np.inf, np.abs(piece.error)).transpose(0, 1, 3, 2)
    own = np.where(asked[:, :, :-1, None], own, -1)
    whole = np.where(asked[:, :, -1:, None], own.max(axis=2, initial=-1, keepdims=True), -1)
    return np.concatenate([own, whole], axis=2)


def reached_in(sweep, piece, asked):
    """Returns the first mesh from which all meshes are within the tolerance, numbered as in Gathered.reach [points, F,
    Q+1]."""
    count = len(sweep.meshes)
    own = np.searchsorted(sweep.meshes, piece.least)
    own = np.where(piece.least == 0, count, own)
    whole = np.where(asked[:, :, :-1], own, 0).max(axis=2, initial=0, keepdims=True)
    found = np.concatenate([own, whole], axis=2)
    failed = ~np.isin(piece.status[:, :, -1], sweep.outcomes(["ok"]))
    return np.where((found == count) & failed[..., None], count + 1, found)


def take_winners(into, sweep, piece, cell, asked, reached):
    """Adds to `into` the points at which each formulation has the lowest cost within the tolerance for all quantities, or
    ties."""
    into.ranked |= np.isfinite(piece.cost).any(axis=(0, 2))
    count = len(sweep.meshes)
    mesh = np.minimum(reached[:, :, -1], count - 1)
    cost = np.take_along_axis(piece.cost, mesh[..., None], axis=2)[..., 0]
    cost = np.where((reached[:, :, -1] < count) & asked[:, :, -1] & np.isfinite(cost), cost, np.inf)
    least = cost.min(axis=1, keepdims=True)
    won = np.isfinite(cost) & (cost <= sweep.noise * least)
    np.add.at(into.wins, cell, won)
    np.add.at(into.winner_cost, cell, np.where(won, cost, 0))
    into.unwon += int((asked[:, :, -1].any(axis=1) & ~won.any(axis=1)).sum())


def take_outcomes(into, sweep, piece):
    for k in range(len(sweep.kinds)):
        into.kinds[:, k] += (piece.kind == k).sum(axis=0)
    there = ~np.isin(piece.kind, sweep.without)
    doubt = np.where(there & np.isfinite(piece.doubt), piece.doubt, 0)
    into.doubt = np.maximum(into.doubt, doubt.max(axis=0, initial=0))
    into.doubtful += (doubt > sweep.tolerance).sum(axis=0)
    for s in range(len(sweep.statuses)):
        here = piece.status == s
        into.status[:, :, s] += here.sum(axis=0)
        for f in range(len(sweep.keys)):
            points = here[:, f].any(axis=1)
            if points.any():
                low, high = into.failed[f, s]
                into.failed[f, s] = (np.minimum(low, piece.at[points].min(axis=0)),
                                     np.maximum(high, piece.at[points].max(axis=0)))


def count(reach, cell, asked, reached):
    """Adds points to a table `reach` [C, F, Q+1, M+2] (Gathered.reaches). `cell` are their cells, and `reached` are their
    classes in the last dimension. Only points for which `asked` is True are added."""
    _, f, q, classes = reach.shape
    flat = ((cell[:, None, None] * f + np.arange(f)[None, :, None]) * q +
            np.arange(q)[None, None, :]) * classes + reached
    counted = np.bincount(flat[asked], minlength=reach.size)
    reach += counted.astype(np.int32).reshape(reach.shape)


def take(into, sweep, piece):
    asked, cells = asked_in(sweep, piece), [each.cell_of(piece.at) for each in into.lattices]
    reached, cell = reached_in(sweep, piece, asked), cells[0]
    np.add.at(into.points, cell, 1)
    np.add.at(into.known, cell, known_in(sweep, piece))
    for reach, own in zip(into.reaches, cells):
        count(reach, own, asked, reached)
    order = np.argsort(cell, kind="stable")
    starts = np.flatnonzero(np.diff(cell[order], prepend=-1))
    most = np.maximum.reduceat(errors_in(piece, asked)[order], starts, axis=0)
    own = cell[order][starts]
    into.worst[own] = np.maximum(into.worst[own], most)
    take_winners(into, sweep, piece, cell, asked, reached)
    take_outcomes(into, sweep, piece)


def of_sweep(sweep):
    """Returns the Gathered of a sweep. Its points are read once more, after the passes of lattice_of()."""
    into = empty(sweep, lattice_of(sweep))
    for piece in sweep.pieces():
        take(into, sweep, piece)
    return into


@dataclass
class Outlier:
    """A point in a box that is not within the tolerance. `error` is the largest error of the mesh to which the box
    belongs and of all finer meshes."""

    point: int
    at: np.ndarray
    error: float


def exceptions(sweep, boxes):
    """Returns [[Outlier]], at most NAMED of the worst exceptions for each of the boxes [(Box, f, q, m)]. f, q and m are
    the indices of formulation, quantity and mesh."""
    found = [[] for _ in boxes]
    wanted = [i for i, (box, *_) in enumerate(boxes) if box.bad]
    for piece in sweep.pieces() if wanted else ():
        known = asked_in(sweep, piece)
        reached, errors = reached_in(sweep, piece, known), errors_in(piece, known)
        for i in wanted:
            box, f, q, m = boxes[i]
            out = np.flatnonzero(box.holds(piece.at) & known[:, f, q] & (reached[:, f, q] > m))
            worst = errors[out, f, q, m:].max(axis=1)
            for k in out[np.argsort(-worst, kind="stable")[:NAMED]]:
                found[i].append(Outlier(piece.first + int(k), piece.at[k],
                                           float(errors[k, f, q, m:].max())))
            found[i] = sorted(found[i], key=lambda e: -e.error)[:NAMED]
    return found
