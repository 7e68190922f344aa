"""Fields of a sweep's maps, classes of errors, and numbers in words."""
import unittest

import numpy as np

from reports import sweep_page
from reports.sweep import answers, maps


class Fields(unittest.TestCase):
    """What a map says of a field of several points."""

    def state(self, *reached, points=None):
        """Of points by the first mesh within: 0, 1, 2, none or without a solution."""
        look = maps.Look((1, 2, 4))
        reach = np.bincount(reached, minlength=5)
        found = int(maps.states(reach, np.array(points or len(reached)), look))
        return look.words[found] if found != maps.EMPTY else "no point"

    def test_states(self):
        for reached, said in (((0, 0), "1 element"), ((0, 2, 1), "4 elements"),
                              ((3, 3), "not with 4"), ((0, 3), "at some of its points only"),
                              ((0, 0, 4), "no solution with 4"), ((), "no point")):
            self.assertEqual(self.state(*reached), said)
        self.assertEqual(self.state(points=3), "nothing to measure by")

    def test_runs(self):
        row = np.array([1, 1, maps.EMPTY, 2, 2, 2, 1])
        self.assertEqual(maps.runs(row), [(0, 2, 1), (3, 3, 2), (6, 1, 1)])

    def test_signs_differ(self):
        """Also without colours."""
        look = maps.Look((1, 2, 4, 8, 16, 32))
        self.assertEqual(len(set(look.sign.values())), len(look.sign))
        self.assertEqual(len(set(look.fill.values())), len(look.fill))

    def test_errors(self):
        """A class is not below any error in it, and the next smaller one is."""
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
