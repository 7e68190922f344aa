"""Tests the page of the papers: one printed number in each row, with the computed number, the difference and the proof."""
import csv
import math
import unittest

from harness.tools.kit.program import ROOT, TRUTHS
from reports import data, papers
from reports.claims import Lookup
from reports.test.results import Site, case, series


def row(**more):
    return {"paper": "J", "item": "Table 2", "claim": "c", "number": "2 elements", "printed": "12.86", "unit": "MN", "measure": "value",
            "case": "one", "parameters": "", "formulation": "a", "elements": "1", "quantity": "u", "ours": "", "proof": "", **more}


class Numbers(unittest.TestCase):

    def setUp(self):
        found = case("one", series("a", [data.Verdict("u", "pass", truth=12.5e6)], {"u": 12.8587e6}))
        found.points[0].series[0].meshes[0].errors["u"] = -0.035
        self.look = Lookup([found])

    def of(self, **more):
        return papers.compared(row(**more), papers.computed(self.look, TRUTHS, row(**more)))

    def test_value(self):
        found = self.of()
        self.assertEqual((found.printed, found.ours, found.difference), ("12.86", "12.8587", "rounds to it"))
        self.assertEqual(found.by, "run: one; a, n = 1; u")
        self.assertEqual(self.of(printed="12.5").difference, "+2.9 %")

    def test_exact_error_and_given(self):
        self.assertEqual(self.of(measure="exact", printed="12.4").difference, "+0.81 %")
        self.assertEqual(self.of(measure="error", printed="4", unit="%").ours, "3.5")
        self.assertEqual(self.of(measure="error", printed="4", unit="%").difference, "-0.5 points")
        given = self.of(measure="derived", case="", elements="", ours="12.0", proof="a test")
        self.assertEqual((given.ours, given.by), ("12.0", "a test"))
        none = self.of(measure="none", case="", elements="", proof="another machine")
        self.assertEqual((none.ours, none.difference, none.by), ("", "", "another machine"))

    def test_without_the_run(self):
        found = self.of(case="two")
        self.assertEqual((found.printed, found.ours, found.difference), ("12.86", "", ""))
        self.assertTrue(math.isnan(papers.computed(self.look, TRUTHS, row(measure="time", case="two"))))


class Page(unittest.TestCase):

    def test_every_item_and_every_number(self):
        site = Site(truths=TRUTHS)
        papers.write(site)
        context = site.pages["papers.html"]
        for name, part in (("papers.csv", lambda found: len(found)), ("papers_numbers.csv", lambda found: sum(len(own) for _, own in found))):
            with open(ROOT / "reference" / name, newline="", encoding="utf-8") as table:
                self.assertEqual(sum(part(found) for _, _, found, _ in context["papers"]), len(list(csv.DictReader(table))))
        for _, _, found, equations in context["papers"]:
            self.assertGreater(len(equations), 10)
            for row_, _ in found:
                self.assertIn(row_["status"], papers.STATUSES)


if __name__ == "__main__":
    unittest.main()
