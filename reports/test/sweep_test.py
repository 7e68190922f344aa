"""Values that reports compute from a sweep must equal those computed point by point."""
import itertools
import unittest

import numpy as np

from harness.tools.kit.program import ProgramTest
from reports import data, sweep_page
from reports.sweep import answers, boxes, gather, maps, stored
from reports.test import sweeps
from reports.test.sweeps import ANGLE, SHAPE, WIDTH


QUANTITIES = (("u", "m"), ("v", "m"))


class Counts(ProgramTest):
    def made(self, points=None, axes=(WIDTH, ANGLE), **more):
        draw = np.random.default_rng(7)

        def errors(at, n):
            return 0.05 * draw.random((len(at), 2)) / n

        def outcome(at, f, m):
            return np.where(draw.random(len(at)) < 0.1, 1 + 6 * (f == 2), 0)

        points = sweeps.grid(*axes) if points is None else points
        path = sweeps.store(self.folder / "made.h5", axes, points,
                            {key: errors for key in ("beamw", "collocation", "sheet_third")},
                            quantities=QUANTITIES, status=outcome,
                            kind=lambda at: draw.integers(0, 5, len(at)), **more)
        return stored.read(path)

    def one_by_one(self, sweep):
        """Yields (point, formulation, first mesh from which all are within the tolerance or None, largest error on each
        mesh) for all quantities together."""
        piece, = sweep.pieces()
        for p, f in itertools.product(range(sweep.points), range(len(sweep.keys))):
            absent = any(sweep.statuses[s] == "not_offered" for s in piece.status[p, f])
            if absent or piece.kind[p, 0] >= 3:
                continue
            error = np.where(np.isnan(piece.error[p, f]), np.inf, abs(piece.error[p, f]))
            largest = error.max(axis=1)
            reached = [m for m in range(4) if (largest[m:] <= sweep.tolerance).all()]
            yield p, f, min(reached, default=None), largest

    def check(self, sweep):
        found = gather.of_sweep(sweep)
        piece, = sweep.pieces()
        cell = found.lattices[0].cell_of(piece.at)
        reach = np.zeros((len(found.points), 3, 6), int)
        worst = np.full((len(found.points), 3, 4), -1.0)
        cost = np.full((sweep.points, 3), np.inf)
        for p, f, first, largest in self.one_by_one(sweep):
            failed = piece.status[p, f, -1] != 0
            reach[cell[p], f, (5 if failed else 4) if first is None else first] += 1
            worst[cell[p], f] = np.maximum(worst[cell[p], f], largest)
            if first is not None:
                cost[p, f] = piece.cost[p, f, first]
        wins = np.zeros_like(found.wins)
        for p in np.flatnonzero(np.isfinite(cost).any(axis=1)):
            wins[cell[p]] += cost[p] <= sweep.noise * cost[p].min()
        np.testing.assert_array_equal(found.reach[:, :, -1], reach)
        np.testing.assert_allclose(found.worst[:, :, -1], worst, rtol=1e-6)
        np.testing.assert_array_equal(found.wins, wins)
        self.assertGreater(wins.sum(), 20)
        nobody = np.isinf(cost).all(axis=1) & (piece.kind[:, 0] < 3)
        self.assertEqual(found.unwon, nobody.sum())
        self.assertEqual(found.points.sum(), sweep.points)
        self.assertEqual(found.judged, (piece.kind[:, 0] < 3).sum())
        return found

    def test_a_grid(self):
        self.assertEqual(self.check(self.made()).shape, (10, 10))

    def test_costs_that_tie(self):
        alone = self.check(self.made()).wins.sum(axis=0)
        tied = self.check(self.made(noise=2.5)).wins.sum(axis=0)
        self.assertGreater(tied[1], alone[1])

    def test_words_and_scattered_points(self):
        axes = (("width", "m", "sobol", "log"), SHAPE)
        points = np.stack([np.geomspace(1e-3, 1, 90), np.arange(90) % 3], 1)
        found = self.check(self.made(points, axes))
        self.assertEqual(found.shape[1], 3)
        width = found.parts[0]
        ratios = np.diff(np.log(width.cuts))
        self.assertLess(ratios.max(), 1.2 * ratios.min())

    def test_many_values_of_a_grid(self):
        axes = (("width", "m", "log", np.geomspace(1, 100, 60)), SHAPE)
        found = self.check(self.made(axes=axes))
        self.assertEqual(found.shape, (gather.MOST, 3))
        self.assertTrue(np.isin(found.parts[0].high, axes[0][3]).all())

    def test_in_pieces(self):
        sweep = self.made()
        whole = gather.of_sweep(sweep)
        self.addCleanup(setattr, stored, "PIECE", stored.PIECE)
        stored.PIECE = 200
        self.assertGreater(len(list(sweep.pieces())), 10)
        parts = gather.of_sweep(sweep)
        for name in ("reach", "worst", "wins", "known", "kinds", "status", "failed"):
            np.testing.assert_array_equal(getattr(parts, name), getattr(whole, name), name)

    def test_of_another_theory(self):
        path = sweeps.store(self.folder / "t.h5", (WIDTH, ANGLE), sweeps.grid(WIDTH, ANGLE), {
            "beamw": lambda at, n: np.full(len(at), np.nan),
            "collocation": lambda at, n: np.full(len(at), 1e-3)})
        with sweeps.h5py.File(path, "r+") as file:
            file["value"][:] = 1
        sweep = stored.read(path)
        found = gather.of_sweep(sweep)
        self.assertEqual(found.reach[:, 0].sum(), 0)
        first, second = answers.of_sweep(sweep, found)
        self.assertEqual((first.key, first.first.box.good), ("collocation", 100))
        self.assertIsNone(second.first)

    def test_a_quantity_that_nothing_measures(self):
        def errors(at, n):
            both = np.stack([np.full(len(at), 1e-3), np.full(len(at), np.nan)], 1)
            both[at[:, 0] > 0.8, 0] = 0.5
            return both
        path = sweeps.store(self.folder / "o.h5", (WIDTH, ANGLE), sweeps.grid(WIDTH, ANGLE),
                            {"beamw": errors}, quantities=(("u", "m"), ("k", "N/m")))
        with sweeps.h5py.File(path, "r+") as file:
            file["value"][:] = 1
            at = file["points"][:, 0]
        off = int((at > at.min() + 0.8 * np.ptp(at)).sum())
        sweep = stored.read(path)
        found = gather.of_sweep(sweep)
        whole, first = found.reach[:, 0, -1].sum(axis=0), found.reach[:, 0, 0].sum()
        self.assertEqual((whole[:-2].sum(), whole.sum(), first), (0, off, 100))
        known = found.reach[:, 0, -1].sum(axis=1) > 0
        self.assertTrue((found.worst[known, 0, -1] > 0.4).all())
        self.assertTrue((found.worst[~known, 0, -1] == -1).all())
        made, = answers.of_sweep(sweep, found)
        self.assertIsNone(made.first)
        self.assertEqual(answers.unjudged(made.of[-1].whole, made.of[-1].known),
                         f"; {100 - off} of all 100 cannot be judged")
        one = made.single["u"][-1].box
        self.assertEqual((one.whole, one.asked), (100, 100))

    def test_judged_at_few_points(self):
        def errors(at, n):
            return np.where(at[:, 0] < 0.5, 1e-3, np.nan)
        path = sweeps.store(self.folder / "f.h5", (WIDTH, ANGLE), sweeps.grid(WIDTH, ANGLE),
                            {"beamw": errors})
        with sweeps.h5py.File(path, "r+") as file:
            file["value"][:] = 1
        sweep = stored.read(path)
        made, = answers.of_sweep(sweep, gather.of_sweep(sweep))
        self.assertEqual(answers.where(made.first.box), "wherever that can be judged")
        self.assertEqual(answers.held(made.first.box), "all 50 points; 50 of all 100 cannot be judged")

    def test_a_ratio(self):
        axes = (("length", "m", "sobol", "linear"), ("width", "m", "sobol", "linear"), ANGLE)
        points = sweeps.scattered(3000, (1, 10), (1, 4), (0, 0.9))

        def errors(at, n):
            length, width = 1 + 9 * at[:, 0], 1 + 3 * at[:, 1]
            return np.where((length < 2 * width) | (at[:, 2] > 0.7), 0.5, 0.001)
        sweep = stored.read(sweeps.store(self.folder / "r.h5", axes, points, {"beamw": errors}))
        found = gather.of_sweep(sweep)
        made, = answers.of_sweep(sweep, found)
        box = made.first.box
        self.assertRegex(answers.where(box), r"^where length/width ≥ [12]\.\d+ and angle ≤ 0\.\d+ r")
        inside = box.holds(points)
        good = (points[:, 0] >= 2 * points[:, 1]) & (points[:, 2] <= 0.7 * 0.9)
        self.assertEqual((box.good, box.bad), ((inside & good).sum(), (inside & ~good).sum()))
        self.assertGreater(box.good, 0.85 * good.sum())
        for each in found.reaches:
            self.assertEqual(each[:, 0, 0].sum(), 3000)
        for outlier in made.first.exceptions:
            self.assertTrue(inside[outlier.point] and not good[outlier.point])

    def test_the_quantity_that_decides(self):
        def made(errors):
            sweep = stored.read(sweeps.store(self.folder / "d.h5", (WIDTH, ANGLE),
                                             sweeps.grid(WIDTH, ANGLE), {"beamw": errors},
                                             quantities=QUANTITIES))
            return answers.of_sweep(sweep, gather.of_sweep(sweep))[0].decided
        flat = np.full(100, 0.001)
        self.assertEqual(made(lambda at, n: np.stack([flat, 0.05 * at[:, 0] / n], 1)), "v")
        self.assertEqual(made(lambda at, n: np.stack([0.05 * at[:, 0] / n] * 2, 1)), "")

    def test_exceptions_are_named(self):
        def errors(at, n):
            return np.where((at[:, 0] > 0.95) & (at[:, 1] > 0.95), 0.02, 0.001)
        sweep = stored.read(sweeps.store(self.folder / "e.h5", (WIDTH, ANGLE),
                                         sweeps.grid(WIDTH, ANGLE), {"beamw": errors}))
        made, = answers.of_sweep(sweep, gather.of_sweep(sweep))
        self.assertEqual((made.first.mesh, made.first.box.bad), (1, 1))
        named, = made.first.exceptions
        self.assertEqual(sweep.place(named.at), "width = 10 m, angle = 0.9 rad")
        self.assertEqual((named.point, answers.error(named.error)), (99, "2 %"))


class Refused(ProgramTest):

    def test_another_version(self):
        path = sweeps.store(self.folder / "v.h5", (WIDTH, ), sweeps.grid(WIDTH),
                            {"beamw": sweeps.series("beamw")})
        with sweeps.h5py.File(path, "r+") as file:
            file.attrs["beamwork_sweep"] = 2
        with self.assertRaisesRegex(data.Unreadable, "version 2, but the report reads version 1"):
            stored.read(path)
        with sweeps.h5py.File(path, "r+") as file:
            file.attrs["beamwork_sweep"] = 1
            del file["least"], file["meshes"]
        with self.assertRaisesRegex(data.Unreadable, "v.h5: cannot be read"):
            stored.read(path)


def lattice_of(*axes):
    out = []
    for name, unit, kind, values in axes:
        axis = stored.Axis(name, unit, kind, len(values), False,
                           tuple(values) if kind == "words" else ())
        extent = gather.Extent(np.zeros(0))
        extent.take(np.arange(len(values), dtype=float) if kind == "words" else values)
        out.append(gather.parts_of(axis, extent, gather.MOST))
    return gather.Lattice(tuple((k,) for k in range(len(axes))), tuple(out))


class Boxes(unittest.TestCase):

    def largest(self, axes, holds):
        """Returns the largest box of grid points within the tolerance, and its description."""
        cells = lattice_of(*axes)
        good = np.array([holds(*at) for at in itertools.product(*map(range, cells.shape))], int)
        box = boxes.largest([cells], [(good, 1 - good)])
        return box, box and answers.where(box)

    def test_everywhere(self):
        box, said = self.largest((WIDTH, ANGLE), lambda i, j: 1)
        self.assertEqual((said, box.good, box.bad, box.share), ("everywhere", 100, 0, 1))

    def test_nowhere(self):
        self.assertIsNone(self.largest((WIDTH, ANGLE), lambda i, j: 0)[0])
        self.assertIsNone(self.largest((WIDTH, ANGLE), lambda i, j: i == j)[0])

    def test_one_bound(self):
        _, said = self.largest((WIDTH, ANGLE), lambda i, j: i >= 3)
        self.assertEqual(said, "where width ≥ 4 m")

    def test_two_bounds_of_an_axis(self):
        box, said = self.largest((WIDTH, ANGLE), lambda i, j: 3 <= i < 8)
        self.assertEqual((said, box.points), ("where 4 ≤ width ≤ 8 m", 50))

    def test_a_corner_with_an_exception(self):
        box, said = self.largest((WIDTH, ANGLE), lambda i, j: i >= 3 and j < 5 and (i, j) != (6, 2))
        self.assertEqual(said, "where width ≥ 4 m and angle ≤ 0.4 rad")
        self.assertEqual((box.good, box.bad, answers.held(box)), (34, 1, "34 of 35 points there"))

    def test_too_many_exceptions(self):
        box, _ = self.largest((WIDTH, ANGLE), lambda i, j: i >= 3 and j < 5 and (i, j) not in
                              ((6, 2), (5, 3)))
        self.assertLessEqual(box.bad, boxes.ALLOWED * box.points)

    def test_simple_before_large(self):
        def with_more(lines):
            return lambda i, j: i >= 5 or (i >= 4 and j < lines)
        self.assertEqual(self.largest((WIDTH, ANGLE), with_more(2))[1], "where width ≥ 6 m")
        _, said = self.largest((WIDTH, ANGLE), lambda i, j: i >= 8 or (i >= 2 and j < 6))
        self.assertEqual(said, "where width ≥ 3 m and angle ≤ 0.5 rad")

    def test_words(self):
        _, said = self.largest((WIDTH, SHAPE), lambda i, k: k == 1)
        self.assertEqual(said, "where shape is box")
        _, said = self.largest((WIDTH, SHAPE), lambda i, k: k != 2 and i < 5)
        self.assertEqual(said, "where width ≤ 5 m and shape is not strip")

    def test_many_axes(self):
        short = [("a" * (k + 1), "1", "linear", np.arange(4.0)) for k in range(5)]
        _, said = self.largest(short, lambda *at: at[0] < 2 and at[2] >= 1 and at[4] < 3
                               and at[1] < 3)
        self.assertEqual(said, "where a ≤ 1 and aa ≤ 2 and aaa ≥ 1 and aaaaa ≤ 2")

    def test_no_box_is_better(self):
        draw = np.random.default_rng(3)
        for _ in range(20):
            table = draw.random((5, 6)) < np.add.outer(np.arange(5), np.arange(6)) / 6
            cells = lattice_of(("x", "1", "linear", np.arange(5.0)),
                               ("y", "1", "linear", np.arange(6.0)))
            best = -np.inf
            for (a, b), (c, d) in itertools.product(
                    itertools.combinations(range(6), 2), itertools.combinations(range(7), 2)):
                part = table[a:b, c:d]
                best = max(best, float(boxes.scored(part.sum(), (~part).sum(), 30)))
            search = boxes.Search(cells, table.astype(int), 1 - table)
            search.run()
            found = max((score for score, _ in search.best.values()), default=-np.inf)
            self.assertEqual(found, best)


class Fields(unittest.TestCase):

    def state(self, *reached, points=None):
        look = maps.Look((1, 2, 4))
        reach = np.bincount(reached, minlength=5)
        found = int(maps.states(reach, np.array(points or len(reached)), look))
        return look.words[found] if found != maps.EMPTY else "no point"

    def test_states(self):
        for reached, said in (((0, 0), "1 element"), ((0, 2, 1), "4 elements"),
                              ((3, 3), "not with 4"), ((0, 3), "at some of its points only"),
                              ((0, 0, 4), "no solution with 4"), ((), "no point")):
            self.assertEqual(self.state(*reached), said)
        self.assertEqual(self.state(points=3), "no reference for the error")

    def test_runs(self):
        row = np.array([1, 1, maps.EMPTY, 2, 2, 2, 1])
        self.assertEqual(maps.runs(row), [(0, 2, 1), (3, 3, 2), (6, 1, 1)])

    def test_signs_differ(self):
        look = maps.Look((1, 2, 4, 8, 16, 32))
        self.assertEqual(len(set(look.sign.values())), len(look.sign))
        self.assertEqual(len(set(look.fill.values())), len(look.fill))

    def test_errors(self):
        levels = sweep_page.levels_of(0.003)
        self.assertIn(0.3, levels)
        for error in (1e-9, 0.0123, 0.01, 0.003, 0.0031, 0.5, 0.99):
            k = int(sweep_page.classes(np.float32(error), np.array(1), levels))
            self.assertGreaterEqual(levels[k] * (1 + 1e-6), 100 * error)
            self.assertTrue(k == 0 or levels[k - 1] < 100 * error)
        self.assertEqual(sweep_page.written(np.array([0, 0, 0, 2, maps.EMPTY, maps.UNKNOWN])), "a3c_?")


class Told(unittest.TestCase):

    def test_percent(self):
        for share, said in ((0, "0 %"), (0.004, "less than 1 %"), (0.5, "50 %"),
                            (0.9999, "99.9 %"), (1, "100 %")):
            self.assertEqual(answers.percent(share), said)


if __name__ == "__main__":
    unittest.main()
