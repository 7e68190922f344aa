"""Tests integrators.py."""
import csv
import json
import sys
import unittest

from harness.tools.kit import program
from harness.tools.kit.program import ROOT, ProgramTest
from harness.tools import integrators


def table(path):
    with open(ROOT / path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class Table(unittest.TestCase):

    def test_every_case(self):
        timed = {r["case"] for r in table("reference/defaults.csv")
                 if r["parameter"] == "integrator"}
        self.assertGreaterEqual(len(timed), 11)
        self.assertEqual({r["case"] for r in table("harness/experiments/integrators.csv")}, timed)


class Run(ProgramTest):

    def test_row(self):
        out = self.folder / "integrators.json"
        done = self.answered(ROOT / "harness/tools/integrators.py", program.PROGRAM, "rigid_body", "-o",
                             out, program=sys.executable)
        record = json.loads(out.read_text(encoding="utf-8"))
        self.assertGreater(len({r["formulation"] for r in record["runs"]}), 3)
        for name in integrators.TABLES:
            self.assertEqual({r["case"] for r in record[name]}, {"rigid_body"}, name)
        check, = record["checks"]
        coarse, fine = check["distances"]
        self.assertLess(fine, 0.2 * coarse)
        self.assertLess(fine, 1e-8)
        self.assertIn(f"{fine:.1e} from it", done.stdout)


class Words(unittest.TestCase):

    def test_check(self):
        check = {"distances": [1e-8, 2e-9], "formulation": "beam", "reason": ""}
        self.assertIn("1.0e-08 and 2.0e-09 from it (beam)", integrators.word_of(check))
        check = {"distances": [None, None], "formulation": "beam", "reason": "no inertia"}
        self.assertEqual(integrators.word_of(check), "not checked: no inertia")

    def test_soonest(self):
        ways = [{"error": integrators.LEVEL, "cost": cost, "integrator": name}
                for name, cost in (("slow", 2), ("quick", 1))]
        ways += [{"error": 1e2 * integrators.LEVEL, "cost": 0.1, "integrator": "rough"}]
        tables = {"runs": [{"formulation": name} for name in "aabc"],
                  "reached": [{"formulation": name, **way} for name in "ab" for way in ways]}
        self.assertEqual(integrators.soonest(tables), "quick 2, none 1")

    def test_refused(self):
        runs = [{"formulation": name, "status": status, "reason": reason}
                for name, status, reason in (("a", "refused", "no inertia"), ("a", "refused", "no"),
                                             ("b", "refused", "implicit"), ("b", "ok", ""))]
        self.assertEqual(integrators.refused({"runs": runs}), {"a": "no inertia"})


if __name__ == "__main__":
    unittest.main()
