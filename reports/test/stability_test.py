"""The page of stability: what a sweep of extremes found is on it; without one there is none."""
import re
import unittest

from harness.records.test.stored import put_experiment
from harness.tools.kit.program import TRUTHS, ProgramTest, run
from reports import checks, stability
from reports.site import Site


class Stability(ProgramTest):

    def setUp(self):
        super().setUp()
        run("verify", "-k", "warping_torsion and beamw", "-o", self.folder / "results.h5")

    def page(self):
        site = Site(self.folder / "results.h5", TRUTHS, self.folder / "site")
        stability.write(site)
        return (self.folder / "site" / "stability.html").read_text(encoding="utf-8")

    def test_without_a_sweep(self):
        """There is no page, and what makes it is said with the environment."""
        site = Site(self.folder / "results.h5", TRUTHS, self.folder / "site")
        self.assertFalse(stability.present(site))
        self.assertIn("stress", [command for command, _ in checks.more(site)])

    def test_sweep(self):
        self.answered("stress", "-k", "decay_free or twist_wagner", "-o",
                      self.folder / "results.h5")
        record = stability.read(self.folder / "results.h5")
        page = self.page()
        tried, survived = (sum(f[name] for f in record["formulations"])
                           for name in ("tried", "survived"))
        self.assertIn(f"{tried} in all: {survived} survived", page)
        self.assertLess(survived, tried)
        self.assertIn('<svg id="stability_map"', page)
        for o in record["outcomes"]:
            if o["proof"]:
                self.assertIn(o["proof"].split("'")[0], page)

    def test_a_formulation_that_is_skipped_at_some_values(self):
        """What an extreme needs can depend on what it is driven to."""

        def outcome(x, kind):
            return {
                "extreme": "thin", "formulation": "beamw", "x": x, "outcome": kind, "error": 1e-9,
                "condition": None, "iterations": 1, "reason": "", "as_expected": True, "proof": ""
            }

        extreme = {
            "name": "thin", "summary": "", "case": "c", "fixed": "", "judge": "exact",
            "tolerance": 1e-6, "x_name": "x", "x_unit": "1"
        }
        tally = {
            "formulation": "beamw", "tried": 1, "survived": 1, "coarse": 0, "named_failures": 0,
            "wrong": 0, "faults": 0
        }
        record = {
            "extremes": [extreme], "formulations": [tally],
            "extreme_values": [{"extreme": "thin", "x": x} for x in (1.0, 2.0)],
            "extreme_quantities": [{"extreme": "thin", "quantity": "w"}],
            "outcomes": [outcome(1.0, "skip"), outcome(2.0, "value")], "unexpected": 0,
            "program_version": "0.1.0", "commit": "made up", "clock": "2026-01-01T00:00:00Z"
        }
        put_experiment(self.folder / "results.h5", "stress", record)
        page = self.page()
        self.assertIn("1 in all: 1 survived", page)
        self.assertIn("commit made up, 2026-01-01T00:00:00Z", page)
        self.assertIn("of the other pages are of commit", page)

    def test_findings_that_are_alike(self):
        """Stand in one row: extreme, outcome, values and proof the same."""
        def outcome(formulation, x, proof):
            return {"extreme": "thin", "formulation": formulation, "x": x, "outcome": "wrong",
                    "proof": proof, "reason": ""}

        found = stability.findings({"outcomes": [
            outcome("a", 2, "p"), outcome("a", 1, "p"), outcome("b", 1, "p"), outcome("b", 2, "p"),
            outcome("c", 1, "p"), outcome("d", 1, "q")]})
        self.assertEqual(found, [("thin", ["a", "b"], "wrong", "1, 2", "p"),
                                 ("thin", ["c"], "wrong", "1", "p"),
                                 ("thin", ["d"], "wrong", "1", "q")])

    def test_bands_of_the_map(self):
        """Many extremes stand in bands, each with its names and all formulations."""
        many = [{"name": f"extreme_{i}", "values": [1.0]} for i in range(stability.MOST + 1)]
        cell = stability.Cell([{"outcome": "value", "error": 0.1, "condition": 1, "iterations": 1,
                                "reason": "", "as_expected": True}])
        record = {"extremes": many, "formulations": [{"formulation": "beamw"}]}
        markup = stability.draw_map(record, {(e["name"], "beamw"): {1.0: cell} for e in many},
                                    stability.LOOK, stability.MEANING).markup
        self.assertEqual(markup.count(">beamw<"), 2)
        self.assertEqual(markup.count(">extreme_"), len(many))
        width = float(re.search(r'width="(\d+)"', markup)[1])
        self.assertTrue(all(float(x) < width for x in re.findall(r"M([\d.]+) ", markup)))


if __name__ == "__main__":
    unittest.main()
