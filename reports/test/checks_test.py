"""The page of checks: counts from the results, tables that other targets leave beside them, and
what is missing."""
import json
import unittest

from harness.tools.kit.program import ProgramTest
from reports import checks, data
from reports.test.results import Site, case, series, verdict


def row(formulation, left_out, number, covered):
    return {
        "formulation": formulation,
        "left_out": left_out,
        "series": number,
        "covered": covered,
    }


class Checks(ProgramTest):
    def context(self, *cases):
        site = Site(str(self.folder / "results.h5"), cases=cases)
        checks.write(site)
        return site.pages["checks.html"]

    def test_counts(self):
        judged = [verdict("a", "pass"), verdict("b", "biased"), verdict("c", "no truth")]
        found = self.context(case("one", series("beam", judged)))
        self.assertEqual(found["rows"], [("one", 1, 1, 2, 1)])
        self.assertEqual(
            list(found["counts"].items()), [("pass", 1), ("biased", 1), ("no truth", 1)]
        )

    def test_tables_of_other_commands(self):
        found = self.context()
        self.assertEqual((found["mutants"], found["fuzz"]), (None, None))
        mutants, fuzz = {"killed": 1, "survived": 1, "mutants": []}, {"executions": 12}
        (self.folder / "faults.json").write_text(json.dumps(mutants), encoding="utf-8")
        (self.folder / "fuzz.json").write_text(json.dumps(fuzz), encoding="utf-8")
        found = self.context()
        self.assertEqual((found["mutants"], found["fuzz"]), (mutants, fuzz))

    def test_smallest_faults(self):
        """Of the cases that are shown; what passes has its reason; every constant of a formulation."""
        self.assertFalse(self.context(case("none"))["noticed"])
        found = self.context(case("elastica"), case("cross_flexure"))["noticed"]
        self.assertEqual({row["case"] for row in found["rows"]}, {"elastica", "cross_flexure"})
        self.assertIn("shift_x", {row["quantity"] for row in found["passing"]})
        self.assertNotIn("elastica", {row["case"] for row in found["passing"]})
        for of in found["formulations"].values():
            self.assertEqual(list(of), found["constants"])

    def test_coverages(self):
        """Sums over cases; formulations with limits of their own stand apart."""
        rows = [row("collocation", 0, 4, 4), row("collocation", 1, 3, 2), row("beamw", 0, 5, 1)]
        one = data.Case("one", "", "", [], rows)
        two = data.Case("two", "", "", [], [row("collocation", 0, 6, 5)])
        found = self.context(one, two, data.Case("none", "", "", []))["coverage"]
        self.assertEqual(found["consistent"], [("collocation", [(9, 10), (2, 3)])])
        self.assertEqual(found["together"], [(9, 10), (2, 3)])
        self.assertEqual(found["all"], [(10, 15), (2, 3)])
        self.assertEqual(found["others"], [("beamw", [(1, 5)])])
        at = checks.CONSISTENT.index("collocation")
        by_case = [(name, of_keys[at]) for name, of_keys in found["cases"]]
        self.assertEqual(by_case, [("one", [(4, 4), (2, 3)]), ("two", [(5, 6)])])


if __name__ == "__main__":
    unittest.main()
