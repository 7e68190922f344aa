"""Sheets that cannot be, or are extreme: one line and the documented exit code, or an answer; never a silent wrong number."""
import json
import math
import os
import resource
import subprocess
import unittest

PROGRAM = os.environ.get("BEAMWORK", "build/beamwork")


def solve(case, formulation, n, *assignments, memory=None):
    def limit():
        if memory:
            resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    sets = [word for a in assignments for word in ("--set", a)]
    return subprocess.run([PROGRAM, "solve", case, "-f", formulation, "-n", str(n), "--format", "json", *sets], capture_output=True, text=True, check=False, preexec_fn=limit)


class BadInput(unittest.TestCase):
    def refused(self, words, *arguments, code=2, **options):
        done = solve(*arguments, **options)
        self.assertEqual(done.returncode, code, (arguments, done.stderr))
        self.assertEqual(done.stdout, "")
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_sizes(self):
        for case in ("sheet_cantilever", "sheet_wagner", "spherical_joint"):
            for name in ("thickness", "width"):
                for value in ("0", "-0.01", "nan", "inf", "1e-400", ""):
                    self.refused([name], case, "sheet_third", 1, f"{name}={value}")
        for name in ("length", "young", "density"):
            for value in ("0", "-1"):
                self.refused([name, "range"], "sheet_cantilever", "collocation", 1, f"{name}={value}")

    def test_poisson(self):
        for value in ("0.5", "0.7", "-1", "-2"):
            self.refused(["poisson", "range"], "sheet_cantilever", "sheet_second", 1, f"poisson={value}")

    def test_deflection_beyond_the_length(self):
        for case in ("sheet_cantilever", "sheet_wagner"):
            for value in ("0.1", "-0.1", "5"):
                self.refused(["tip_deflection", "length", "smaller"], case, "collocation", 1, f"tip_deflection={value}")

    def test_meshes(self):
        for n in (0, -3, 2.5, 99999999999999):
            self.refused(["elements", "whole number"], "sheet_cantilever", "sheet_third", n)

    def test_memory(self):
        if solve("sheet_cantilever", "sheet_third", 1, memory=2 ** 30).returncode != 0:
            self.skipTest("this build cannot run with limited memory (sanitizers)")
        self.refused(["300000 elements", "memory", "give fewer"], "sheet_cantilever", "sheet_third", 300000, memory=2 ** 30)
        self.refused(["memory", "newton=mixed"], "sheet_cantilever", "sheet_third:newton=dense", 4000, memory=2 ** 32)

    def test_choices(self):
        self.refused(["moment_convention", "spatial|semitangential|symmetrised"], "sheet_cantilever", "sheet_third", 1, "moment_convention=dead")
        self.refused(["modes", "range"], "sheet_cantilever", "sheet_third", 1, "modes=7")


class Extremes(unittest.TestCase):
    """L/w 0.5 to 20, w/t 10 to 1000, u_y to 0.5 L: an answer, or the reason why there is none.  Sheets too thick for N Eq. 50 are refused."""

    def test_answer_or_reason(self):
        answers = 0
        for length, slenderness, deflection in ((0.05, 10, 0.5), (0.05, 1000, 0.5), (2, 10, 0.5), (2, 1000, 0.5), (0.1, 1000, 0.01), (0.1, 10, 0.999)):
            for formulation in ("sheet_third", "collocation", "geometrically_exact", "beamw_consistent"):
                done = solve("sheet_cantilever", formulation, 4, f"length={length}", f"thickness={0.1 / slenderness}", f"tip_deflection={deflection * length}")
                at = (formulation, length, slenderness, deflection, done.stderr)
                Phi = 2.6 / (13 / 15.3) * (0.1 / slenderness / length) ** 2  # nu = 0.3, k = 10 (1 + nu)/(12 + 11 nu)
                self.assertIn(done.returncode, (2,) if formulation == "sheet_third" and Phi > 0.01 else (0, 1), at)
                if done.returncode == 0:
                    answers += 1
                    values = {q["quantity"]: q["value"] for q in json.loads(done.stdout)["quantities"]}
                    self.assertTrue(all(v is not None and math.isfinite(v) for v in values.values()), at)
                    self.assertGreater(values["C_xx"], 0, at)
                    self.assertGreater(values["C_zz"], 0, at)
                else:
                    self.assertEqual(len(done.stderr.splitlines()), 1, at)
        self.assertGreaterEqual(answers, 20)


if __name__ == "__main__":
    unittest.main()
