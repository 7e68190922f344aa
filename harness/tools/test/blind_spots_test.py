"""The faults that `make verify` detects. The tables must be complete and within the required bounds, and a sample of
rows is confirmed by runs."""
import csv
import json
import pathlib
import unittest

from harness.tools.kit.program import PROGRAM, ROOT, environment, run
from harness.tools import blind_spots

PLANTED = pathlib.Path(PROGRAM).parent / "planted"
MOST = 40


def table(name):
    with open(ROOT / "harness" / name, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def listed(*what):
    return json.loads(run("list", *what, "--format", "json").stdout)


class BlindSpots(unittest.TestCase):
    rows, faults = table("blind_spots.csv"), table("planted_faults.csv")

    def test_every_quantity(self):
        here = {(r["case"], r["quantity"]) for r in self.rows}
        for case in listed()["cases"]:
            told = listed(case["case"])
            self.assertEqual({(case["case"], q["name"]) for q in told["quantities"] if not q["is_curve"]} - here, set())
        scenes = {path.stem for path in (ROOT / "cases" / "examples").glob("*.yaml")}
        self.assertEqual(scenes - {case for case, _ in here}, set())

    def test_what_passes_has_a_reason(self):
        passing = [r for r in self.rows if blind_spots.passes(r["noticed"])]
        self.assertLessEqual(len(passing), MOST)
        for row in self.rows:
            self.assertEqual(bool(row["reason"]), row in passing, row)

    def test_every_constant_of_every_formulation(self):
        keys = {(f["formulation"], f["constant"]) for f in self.faults}
        for name in (f["formulation"] for f in listed()["formulations"]):
            for constant in blind_spots.CONSTANTS:
                self.assertIn((name, constant), keys)
        for fault in self.faults:
            if blind_spots.passes(fault["noticed"]) and ":" not in fault["formulation"]:
                self.assertIn("depends on the constant", fault["reason"])
                self.assertEqual(fault["noticed"], "", fault)

    def seen(self, row, constant, size, *options):
        """Returns True if a run with a fault of this size fails. The formulation is selected by -k, not by -f, because
        the checks of -f against the interface requirements would detect faults in masses."""
        select = f"={row['case']} and =default and ={row['formulation']} and ={row['quantity']}"
        done = run("verify", "-k", select, "-j", 1, *options, program=PLANTED,
                   env=environment(BEAMWORK_PLANT=f"{constant}={size}"))
        self.assertIn(done.returncode, (0, 1, 3), done.stderr)
        return done.returncode == 1

    def sample(self, rows):
        quick = [r for r in rows if not r["parameters"] and list((ROOT / "cases" / "benchmarks").glob(r["case"] + ".[cy]*"))
                 and r["noticed"] and "motion" not in r["case"] and not blind_spots.passes(r["noticed"])]
        return quick[::max(1, len(quick) // 6)]

    def test_quantities_measured(self):
        former = ("--not-worse-than", ROOT / "harness" / "baseline.csv")
        rows = self.sample(self.rows)
        self.assertEqual({row["by"] for row in rows}, {"verdict", "baseline"})
        for row in rows:
            size = max(2 * float(row["noticed"]), 1e-7)
            with self.subTest(row=row):
                for sign in (1, -1):
                    self.assertTrue(self.seen(row, row["constant"], sign * size, *former))
                if float(row["noticed"]) > 1e-7:
                    small = [self.seen(row, row["constant"], sign * float(row["noticed"]) / 3, *former)
                             for sign in (1, -1)]
                    self.assertIn(False, small)

    def test_constants_measured(self):
        for fault in self.sample([f for f in self.faults if f["noticed"]]):
            with self.subTest(fault=fault):
                self.assertFalse(self.seen(fault, fault["constant"], 0))
                self.assertTrue(self.seen(fault, fault["constant"], 1e-3))


if __name__ == "__main__":
    unittest.main()
