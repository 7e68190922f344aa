"""Formulations in another process: the example in Python, judged like the built-in ones and beside
the same one in C."""
import json
import os
import subprocess
import sys

from harness.test.program import ROOT, ProgramTest

EXAMPLES = ROOT / "elements" / "examples"
PYTHON = f"exec:'{sys.executable}' '{EXAMPLES / 'timoshenko.py'}'"
CASES = ("tapered_cantilever", "deep_beam", "weighted_column", "tip_body", "sprung_beam",
         "loaded_cantilever", "bend_45", "elastica", "snap_through", "right_angle_frame")


class Example(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.object = cls.class_folder() / "timoshenko.so"
        subprocess.run([os.environ.get("CC", "cc"), "-O2", "-shared", "-fPIC", "-I", ROOT,
                        EXAMPLES / "timoshenko.c", "-o", cls.object],
                       check=True)

    def test_short(self):
        self.assertLessEqual(len((EXAMPLES / "timoshenko.py").read_text("utf-8").splitlines()), 60)

    def verdicts(self, element, name):
        record = self.folder / "v.json"
        self.answered("verify", "--element", element, "-f", name, "-k",
                      " or ".join(f"{case}/default" for case in CASES), "--json", record)
        return json.loads(record.read_text(encoding="utf-8"))["verdicts"]

    def test_judged_like_the_others(self):
        """Ten cases: the verdicts of the same beam in C, and its limits."""
        here, there = self.verdicts(PYTHON, "timoshenko_py"), self.verdicts(self.object, "timoshenko")
        passed = {v["case"] for v in here if v["verdict"] == "pass"}
        self.assertEqual(passed - {"shear_elastica"}, set(CASES))
        self.assertEqual([(v["case"], v["quantity"], v["verdict"]) for v in here],
                         [(v["case"], v["quantity"], v["verdict"]) for v in there])
        for mine, other in zip(here, there):
            if mine["limit"] is not None:
                self.assertLess(abs(mine["limit"] - other["limit"]), 1e-7 * abs(other["limit"]),
                                (mine["case"], mine["quantity"]))

    def test_ranks_nothing(self):
        out = self.answered("converge", "tapered_cantilever", "--element", PYTHON, "-f",
                            "timoshenko_py", "-f", "geometrically_exact").stdout
        answer = " ".join(out[out.rindex("for 1 %"):].split())
        self.assertRegex(answer,
                         r"geometrically_exact n = \d+ .*timoshenko_py n = \d+ \(in another proc")

    def test_every_verb(self):
        """It is there in list, solve, bench and for several workers."""
        out = self.answered("list", "timoshenko_py", "--element", PYTHON).stdout
        self.assertIn("Reissner", out)
        for verb in (("solve", "-n", "2"), ("bench", "-n", "2"), ("converge", "-j", "2")):
            out = self.answered(verb[0], "elastica", "--element", PYTHON, "-f", "timoshenko_py",
                                *verb[1:]).stdout
            self.assertIn("timoshenko_py", out)
