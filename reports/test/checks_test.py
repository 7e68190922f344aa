"""The page of checks: counts from the results, tables that other targets leave beside them, and what is missing."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from harness.test.program import PROGRAM, TRUTHS


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
            self.assertRegex(page, r"beamw_vlasov</a></td>(<td class=\"n\">100.0 %</td><td class=\"n small\">1</td>){4}")
            fault = {"fault": "a sign", "check": "test x", "expected": "1", "exit": "0", "killed": False}
            (pathlib.Path(folder) / "mutants.json").write_text(json.dumps({"killed": 1, "survived": 1, "mutants": [fault, {**fault, "killed": True}]}), encoding="utf-8")
            (pathlib.Path(folder) / "fuzz.json").write_text(json.dumps({"executions": 12, "findings": 0, "inputs": [{"input": "words", "executions": 12, "finding": False}]}), encoding="utf-8")
            page = self.page(folder)
            self.assertIn("1 of 2 were noticed", page)
            self.assertIn("survived", page)
            self.assertIn("12 executions", page)


if __name__ == "__main__":
    unittest.main()
