"""beamwork stress: exit codes, what its outputs agree on, and that a wrong number is never
silent."""
import csv
import io
import json
import shutil
import sys
import unittest

from harness.tools.kit import program
from harness.tools.kit.program import ROOT, ProgramTest

SMALL = "decay_free or soft_square or twist_wagner"


def run(*arguments, truths=None):
    return program.run("stress", *arguments, *(["--truths", truths] if truths else []))


class Stress(ProgramTest):

    @classmethod
    def setUpClass(cls):
        done = run("-k", SMALL, "--format", "json")
        cls.code, cls.record = done.returncode, json.loads(done.stdout)

    def altered(self, change):
        """Packed truths of a copy of reference/ that `change` was applied to."""
        copy = self.folder / "reference"
        left_out = shutil.ignore_patterns("__pycache__", "derive", "test")
        shutil.copytree(ROOT / "reference", copy, ignore=left_out)
        change(copy)
        packed = self.folder / "truths.h5"
        self.answered(ROOT / "reference" / "pack.py",
                      "-o",
                      packed,
                      "--folder",
                      copy,
                      program=sys.executable)
        return packed

    def test_as_expected(self):
        self.assertEqual(self.code, 0)
        for o in self.record["outcomes"]:
            self.assertTrue(o["as_expected"], o)
            has_value = o["outcome"] in ("value", "coarse", "wrong")
            self.assertEqual(o["value"] is not None, has_value, o)
            self.assertEqual(bool(o["proof"]), o["outcome"] not in ("value", "coarse", "skip"), o)
            if o["outcome"] not in ("value", "coarse"):
                self.assertTrue(o["reason"], o)
            if o["outcome"] == "value":
                tolerance = next(
                    e["tolerance"] for e in self.record["extremes"] if e["name"] == o["extreme"])
                self.assertLessEqual(abs(o["error"]), tolerance * (1 + 1e-6), o)
                self.assertGreater(o["condition"], 0)

    def test_counts(self):
        for f in self.record["formulations"]:
            cells = {}
            for o in self.record["outcomes"]:
                if o["formulation"] == f["formulation"] and o["outcome"] != "skip":
                    cells.setdefault((o["extreme"], o["x"]), set()).add(o["outcome"])
            self.assertEqual(f["tried"], len(cells))
            survived = sum(found <= {"value", "coarse"} for found in cells.values())
            self.assertEqual(f["survived"], survived)
            self.assertEqual(f["tried"], survived + f["named_failures"] + f["wrong"] + f["faults"])
        self.assertGreater(sum(f["wrong"] for f in self.record["formulations"]), 0)

    def test_formats_agree(self):
        rows = list(csv.DictReader(io.StringIO(run("-k", SMALL, "--format", "csv").stdout)))
        keys = ("extreme", "formulation", "quantity", "outcome")
        self.assertEqual([[r[key] for key in keys] for r in rows],
                         [[o[key] for key in keys] for o in self.record["outcomes"]])
        for row, outcome in zip(rows, self.record["outcomes"]):
            self.assertEqual(float(row["value"]) if row["value"] else None, outcome["value"])
        written = self.folder / "table.txt"
        self.assertEqual(run("-k", SMALL, "-o", written, "-j", "1").returncode, 0)
        self.assertEqual(written.read_text(encoding="utf-8"), run("-k", SMALL).stdout)

    def test_wrong_numbers_are_not_silent(self):

        def no_findings(folder):
            path = folder / "extreme_findings.csv"
            header = path.read_text(encoding="utf-8").splitlines()[0]
            path.write_text(header + "\n", encoding="utf-8")

        done = run("-k", "soft_square", truths=self.altered(no_findings))
        self.assertEqual(done.returncode, 1)
        self.assertIn("unexpected: soft_square E/G=1000 sheet_second buckling_load: wrong",
                      done.stdout)

    def test_a_wrong_truth_is_noticed(self):

        def one_percent(folder):
            path = folder / "extremes" / "warping_torsion.csv"
            text = path.read_text(encoding="utf-8")
            for right, wrong in (("9.900000000000E-1", "9.8E-1"), ("0.9900000000000", "0.98")):
                text = text.replace(right, wrong)
            path.write_text(text, encoding="utf-8")

        done = run("-k", "decay_free and collocation", truths=self.altered(one_percent))
        self.assertEqual(done.returncode, 1, done.stdout)

    def test_motions(self):
        """Steps stay as long as they are; turns that a step does not take are named."""
        done = run("-k", "(turn_alpha or long_steps_radau) and collocation", "--format", "json")
        self.assertEqual(done.returncode, 0, done.stdout)
        record = json.loads(done.stdout)
        found = {(o["extreme"], o["x"], o["quantity"]): o for o in record["outcomes"]}
        for x, outcome in ((0.9, "value"), (3, "not converged")):
            self.assertEqual(found["turn_alpha", x, "R_xx"]["outcome"], outcome)
        self.assertIn("turns by 3 rad", found["turn_alpha", 3, "energy"]["reason"])
        self.assertLess(abs(found["long_steps_radau", 100, "tip"]["error"]), 5e-3)

    def test_a_missing_truth_is_a_fault(self):

        def none(folder):
            (folder / "extremes" / "roll_up.csv").unlink()

        done = run("-k", "turns", truths=self.altered(none))
        self.assertEqual(done.returncode, 4)
        self.assertIn("no exact value of tip_gap", done.stderr)

    def test_a_finding_that_nobody_sees(self):

        def another(folder):
            with open(folder / "extreme_findings.csv", "a", encoding="utf-8") as file:
                file.write("decay_free,1,1,collocation,twist_ratio,singular,planted\n")

        done = run("-k", "decay_free and collocation", truths=self.altered(another))
        self.assertEqual(done.returncode, 1)
        self.assertIn("expected singular", done.stdout)

    def test_refusals(self):
        for code, *arguments in ((2, "-k", "nothing_of_this_name"),
                                 (3, "-k", "turns and decay_free"), (2, "-k", "and and"),
                                 (2, "elastica"), (2, "-f", "bemw"), (4, "--truths", "/none.h5"),
                                 (4, "-k", "turns and collocation", "-o", "/none/table.txt")):
            self.refused(code, "", "stress", *arguments, silent=False)


if __name__ == "__main__":
    unittest.main()
