"""Formulations of the tree that the project has not accepted yet: told, and the gate stays green
where nobody named them."""
import csv
import shutil
import subprocess
import sys

import h5py

from harness.tools.kit.program import ROOT, ProgramTest

NAME = "sheet_second"


def without(path, beginning):
    """Takes the lines that begin so out of a file."""
    lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
    kept = [line for line in lines if not line.startswith(beginning)]
    assert len(kept) < len(lines), path
    path.write_text("".join(kept), encoding="utf-8")


class NotAccepted(ProgramTest):
    """Truths without the findings of a formulation that has some, accepted or not."""

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        shutil.copytree(ROOT / "reference", folder / "reference")
        without(folder / "reference" / "findings.csv", "N")
        without(folder / "reference" / "extreme_findings.csv", "slender_square")
        cls.truths = {"accepted": folder / "accepted.h5", "new": folder / "new.h5"}
        cls.pack(folder / "reference", cls.truths["accepted"])
        without(folder / "reference" / "accepted.csv", f"{NAME},")
        cls.pack(folder / "reference", cls.truths["new"])

    @staticmethod
    def pack(reference, path):
        subprocess.run([sys.executable, ROOT / "reference" / "pack.py", "--folder", reference, "-o",
                        path], check=True, capture_output=True)

    def verified(self, truths, *options, code=0):
        return self.answered("verify", "-k", f"shear_elastica/default/{NAME}/", "--truths",
                             self.truths[truths], *options, code=code).stdout

    def test_named_it_gates(self):
        out = self.verified("new", "-f", NAME, code=1)
        self.assertIn("from the expected one", out)
        self.assertNotIn("(new)", out)

    def test_an_accepted_one_without_its_finding_is_red(self):
        out = self.verified("accepted", code=1)
        self.assertIn("from the expected one", out)
        self.assertNotIn("(new)", out)

    def test_a_new_one_is_told_and_does_not_gate(self):
        out = " ".join(self.verified("new").split())
        self.assertIn("(new)", out)
        for text in (out, " ".join(self.verified("new", "-q").split())):
            self.assertRegex(text, r"nothing that affects the exit status differs from what is expected; without effect on the exit status: "
                             r"\d+ of \d+ verdicts of new formulations")
            self.assertNotIn("every verdict is as expected", text)

    def test_its_rules_are_proposed(self):
        needed = self.folder / "needed.csv"
        self.verified("new", "--propose", needed)
        with open(needed, newline="", encoding="utf-8") as rows:
            rules = list(csv.DictReader(rows))
        self.assertEqual({(r["formulations"], r["cases"]) for r in rules},
                         {(NAME, "shear_elastica")})

    def test_results_say_so(self):
        for truths, new in (("accepted", 0), ("new", 1)):
            stored = self.folder / f"{truths}.h5"
            self.verified(truths, "-o", stored, code=1 - new)
            with h5py.File(stored) as file:
                row = file["declarations"][()][0]
            self.assertEqual((row["type"].decode(), int(row["is_new"])), (NAME, new))

    def test_extremes(self):
        """What fails at an extreme needs a finding, of an accepted formulation."""
        for truths, code in (("accepted", 1), ("new", 0)):
            what = ("stress", "-k", f"slender_square and {NAME}", "--truths", self.truths[truths])
            out = self.answered(*what, code=code).stdout
            self.assertEqual("which do not affect the exit status" in out, truths == "new", out)
            self.answered(*what, "-f", NAME, code=1)
