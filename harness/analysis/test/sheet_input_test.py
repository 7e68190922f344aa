"""Sheets that cannot be, or are extreme: one line and the documented exit code, or an answer; never
a silent wrong number."""
import json
import math
import resource
import unittest

from harness.tools.kit.program import ProgramTest, run


def question(case, formulation, n, *assignments, memory=None):
    """Words of the command, and what limits its memory [bytes]."""
    def limit():
        if memory:
            resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    sets = [word for a in assignments for word in ("--set", a)]
    return ("solve", case, "-f", formulation, "-n", n, "--format", "json", *sets), limit


def solve(*arguments, **options):
    words, limit = question(*arguments, **options)
    return run(*words, preexec_fn=limit)


class BadInput(ProgramTest):
    def denied(self, words, *arguments, **options):
        said, limit = question(*arguments, **options)
        self.refused(2, words, *said, preexec_fn=limit)

    def test_sizes(self):
        for case in ("sheet_cantilever", "sheet_wagner", "spherical_joint"):
            for name in ("thickness", "width"):
                for value in ("0", "-0.01", "nan", "inf", "1e-400", ""):
                    self.denied([name], case, "sheet_third", 1, f"{name}={value}")
        for name in ("length", "young", "density"):
            for value in ("0", "-1"):
                self.denied([name, "range"], "sheet_cantilever", "collocation", 1,
                            f"{name}={value}")

    def test_poisson(self):
        for value in ("0.5", "0.7", "-1", "-2"):
            self.denied(["poisson", "range"], "sheet_cantilever", "sheet_second", 1,
                        f"poisson={value}")

    def test_deflection_beyond_the_length(self):
        for case in ("sheet_cantilever", "sheet_wagner"):
            for value in ("0.1", "-0.1", "5"):
                self.denied(["tip_deflection", "length", "smaller"], case, "collocation", 1,
                            f"tip_deflection={value}")

    def test_meshes(self):
        for n in (0, -3, 2.5, 99999999999999):
            self.denied(["elements", "whole number"], "sheet_cantilever", "sheet_third", n)

    def test_memory(self):
        if solve("sheet_cantilever", "sheet_third", 1, memory=2 ** 30).returncode != 0:
            self.skipTest("this build cannot run with limited memory (sanitizers)")
        self.denied(["300000 elements", "memory", "give fewer"], "sheet_cantilever", "sheet_third",
                    300000, memory=2 ** 30)
        self.denied(["memory", "newton=mixed"], "sheet_cantilever", "sheet_third:newton=dense",
                    4000, memory=2 ** 32)

    def test_choices(self):
        self.denied(["moment_convention", "spatial|semitangential|symmetrised"], "sheet_cantilever",
                    "sheet_third", 1, "moment_convention=dead")
        self.denied(["modes", "range"], "sheet_cantilever", "sheet_third", 1, "modes=7")


class Extremes(unittest.TestCase):
    """L/w 0.5 to 20, w/t 10 to 1000, u_y to 0.5 L: an answer, or the reason why there is none.
    Sheets too thick for N Eq. 50 run as another model, and say so."""

    def test_answer_or_reason(self):
        answers = 0
        for length, slenderness, deflection in ((0.05, 10, 0.5), (0.05, 1000, 0.5), (2, 10, 0.5),
                                                (2, 1000, 0.5), (0.1, 1000, 0.01),
                                                (0.1, 10, 0.999)):
            for formulation in ("sheet_third", "collocation", "geometrically_exact",
                                "beamw_consistent"):
                done = solve("sheet_cantilever", formulation, 4, f"length={length}",
                             f"thickness={0.1 / slenderness}",
                             f"tip_deflection={deflection * length}")
                at = (formulation, length, slenderness, deflection, done.stderr)
                # nu = 0.3, k = 10 (1 + nu)/(12 + 11 nu)
                Phi = 2.6 / (13 / 15.3) * (0.1 / slenderness / length) ** 2
                self.assertIn(done.returncode, (0, 1), at)
                if done.returncode == 0:
                    answers += 1
                    thick = formulation == "sheet_third" and Phi > 0.01
                    left_out = json.loads(done.stdout)["cell"]["left_out"]
                    self.assertEqual("not modelled: shear along y" in left_out, thick, at)
                    values = {q["quantity"]: q["value"]
                              for q in json.loads(done.stdout)["quantities"]}
                    self.assertTrue(all(v is not None and math.isfinite(v)
                                        for v in values.values()), at)
                    self.assertGreater(values["C_xx"], 0, at)
                    self.assertGreater(values["C_zz"], 0, at)
                else:
                    self.assertEqual(len(done.stderr.splitlines()), 1, at)
        self.assertGreaterEqual(answers, 20)


if __name__ == "__main__":
    unittest.main()
