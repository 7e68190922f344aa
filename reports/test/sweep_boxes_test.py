"""The largest boxes of a sweep's points that hold, and their words."""
import itertools
import unittest

import numpy as np

from reports.sweep import answers, boxes, gather, stored
from reports.test.sweeps import ANGLE, SHAPE, WIDTH


def lattice_of(*axes):
    """The cells of a grid of few values."""
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
        """The box, and its words, of grid points that hold by their indices."""
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
        """Two in 35 are more than are allowed."""
        box, _ = self.largest((WIDTH, ANGLE), lambda i, j: i >= 3 and j < 5 and (i, j) not in
                              ((6, 2), (5, 3)))
        self.assertLessEqual(box.bad, boxes.ALLOWED * box.points)

    def test_simple_before_large(self):
        """A further bound for two more lines of ten is not worth it; for eight more it is."""
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
        """Against all boxes of two axes, one by one, of random points."""
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


if __name__ == "__main__":
    unittest.main()
