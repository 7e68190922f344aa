"""The page of checks: counts from the results, tables that other targets leave beside them, and what is missing."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from reports import checks, data

PROGRAM = os.environ.get("BEAMWORK", "build/beamwork")
TRUTHS = os.environ.get("BEAMWORK_TRUTHS", "build/truths.h5")


class Checks(unittest.TestCase):
    def page(self, folder):
        subprocess.run([sys.executable, "-B", "-m", "reports", os.path.join(folder, "results.h5"), TRUTHS, "-o", os.path.join(folder, "site")], check=True, capture_output=True)
        return (pathlib.Path(folder) / "site" / "checks.html").read_text(encoding="utf-8")

    def test_counts(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([PROGRAM, "verify", "-k", "warping_torsion/default/beamw_vlasov", "-o", os.path.join(folder, "results.h5")], capture_output=True, check=True)
            page = self.page(folder)
            self.assertIn("make mutants", page)
            self.assertIn("make fuzz", page)
            self.assertIn("1 pass", page)
            fault = {"fault": "a sign", "check": "test x", "expected": "1", "exit": "0", "killed": False}
            (pathlib.Path(folder) / "mutants.json").write_text(json.dumps({"killed": 1, "survived": 1, "mutants": [fault, {**fault, "killed": True}]}), encoding="utf-8")
            (pathlib.Path(folder) / "fuzz.json").write_text(json.dumps({"executions": 12, "findings": 0, "inputs": [{"input": "words", "executions": 12, "finding": False}]}), encoding="utf-8")
            page = self.page(folder)
            self.assertIn("1 of 2 were noticed", page)
            self.assertIn("survived", page)
            self.assertIn("12 executions", page)

    def test_coverages(self):
        """Sums over cases; formulations with limits of their own stand apart."""

        def row(formulation, left_out, series, covered):
            return {"formulation": formulation, "left_out": left_out, "series": series, "covered": covered}

        one = data.Case("one", "", "", [], [row("collocation", 0, 4, 4), row("collocation", 1, 3, 2), row("beamw", 0, 5, 1)])
        two = data.Case("two", "", "", [], [row("collocation", 0, 6, 5)])
        found = checks.coverages([one, two, data.Case("none", "", "", [])])
        self.assertEqual(found["consistent"], [("collocation", [(9, 10), (2, 3)])])
        self.assertEqual(found["together"], [(9, 10), (2, 3)])
        self.assertEqual(found["all"], [(10, 15), (2, 3)])
        self.assertEqual(found["others"], [("beamw", [(1, 5)])])
        at = checks.CONSISTENT.index("collocation")
        self.assertEqual([(name, rows[at]) for name, rows in found["cases"]], [("one", [(4, 4), (2, 3)]), ("two", [(5, 6)])])


if __name__ == "__main__":
    unittest.main()
