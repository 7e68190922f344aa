"""The page of equilibrium paths: curves beside the solids' points, conclusions with numbers, critical points of the snapping frames."""
import re
import unittest

from harness.tools.kit.program import TRUTHS, ProgramTest, drawn
from reports import paths


class Paths(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.site = drawn(cls.class_folder(), "-k",
                         "snap_through and beamw_consistent or c_cantilever and collocation")
        cls.page = (cls.site / "paths.html").read_text(encoding="utf-8")

    def test_figures(self):
        for name in ("paths_cantilever", "paths_snap_through"):
            self.assertIn(f'<svg id="{name}"', self.page)
        for name in ("exact beam (collocation, n = 10)", "exact beam, with int y", "3-D solids"):
            self.assertIn(name, self.page)

    def test_limit_points_are_listed(self):
        rows = re.findall(
            r"<td>limit point</td><td class=\"n\">(-?[\d.]+)</td><td class=\"n\">(-?[\d.]+)</td>",
            self.page)
        self.assertEqual([float(load) for _, load in rows], [0.0103933, -0.0103933])

    def test_conclusions_have_numbers(self):
        shear = re.search(r"shear changes the load by ([^<]*)", self.page).group(1)
        values = [float(v) for v in re.findall(r"([-+][\d.]+) %", shear)]
        self.assertEqual(len(values), 3)
        self.assertTrue(all(0.05 < abs(v) < 0.3 for v in values), values)

    def test_curve_of_solids(self):
        solid = paths.solid(TRUTHS, paths.EDGES["D"], "curve")
        self.assertGreater(len(solid.w), 40)
        self.assertAlmostEqual(solid.w[-1], 2.6)
        self.assertIsNone(paths.solid(TRUTHS, "load_height=edge;w=1", "curve"))


if __name__ == "__main__":
    unittest.main()
