"""The page of stationary rotation from a small run: its figures are there, and the curves end at the exact values."""
import unittest

from harness.tools.kit.program import ProgramTest, drawn
from reports import campbell, data
from reports.claims import Lookup


class Campbell(ProgramTest):

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        cls.site = drawn(folder, "-k", "rotating_cantilever and beamw_consistent")
        cls.look = Lookup(data.read_results(folder / "results.h5")[1])

    def test_page(self):
        page = (self.site / "rotation.html").read_text(encoding="utf-8")
        for image in ("campbell_across", "campbell_along"):
            self.assertIn(f'<svg id="{image}"', page)

    def test_curves_pass_through_the_exact_values(self):
        mesh = campbell.finest(self.look, campbell.CASE, campbell.ACROSS, campbell.KEY)
        for name in ("flap_1", "lag_1", "flap_2"):
            x, value = mesh.curves[f"{name}_curve"][:2]
            for at, parameters in campbell.EXACT_AT.items():
                exact = campbell.truth(self.look, campbell.CASE, parameters, name)
                self.assertLess(abs(dict(zip(x.round(9), value))[at] / exact - 1), 2e-6,
                                f"{name} at {at}")

    def test_growth_between_the_critical_speeds_only(self):
        mesh = campbell.finest(self.look, campbell.CASE, campbell.ALONG, campbell.KEY)
        first = campbell.truth(self.look, campbell.CASE, campbell.EXACT_AT[0], "flap_1")
        for omega, growth in zip(*mesh.curves["growth_curve"][:2]):
            self.assertEqual(growth > 0, first < omega < 2 * first, f"at {omega}")


if __name__ == "__main__":
    unittest.main()
