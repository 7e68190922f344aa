"""Formulations in another process: the example in Python, judged like the built-in ones and beside
the same one in C."""
import json
import os
import sys

from harness.formulations.test.beside_c import BesideC
from harness.tools.kit.program import ROOT, ProgramTest

EXAMPLES = ROOT / "elements" / "examples"
PYTHON = f"exec:'{sys.executable}' '{EXAMPLES / 'timoshenko.py'}'"
CASES = ("tapered_cantilever", "deep_beam", "weighted_column", "tip_body", "sprung_beam",
         "loaded_cantilever", "bend_45", "elastica", "snap_through", "right_angle_frame")


ENERGY = """
import numpy as np
from beamwork_element import Refused, serve

def prepare(kind):  # a chord that stretches, and turns of its ends against it
    if kind.options["law"] != "linear":
        raise Refused(f"law {kind.options['law']}, times {kind.options['times']:g}")
    c = kind.section
    kind.stretch, kind.twist = c.young * c.A, c.shear_modulus * c.It
    kind.bending = c.young * kind.options["times"] * np.array([c.Iy, c.Iz])

def force(kind, r, _u, R, _a):
    l, chord = kind.length, r[:, 1] - r[:, 0]
    now = np.linalg.norm(chord, axis=1)
    to = [np.einsum("ni,nkia->nka", chord / now[:, None], R)[..., k] for k in (1, 2)]
    turned = np.einsum("nia,nib->nab", R[:, 0], R[:, 1])
    energy = kind.stretch / l * (now - l)**2 / 2
    energy += kind.twist / l * ((turned[:, 2, 1] - turned[:, 1, 2]) / 2)**2 / 2
    for EI, t in zip(kind.bending, to[::-1]):
        energy += 2 * EI / l * (t[:, 0]**2 + t[:, 0] * t[:, 1] + t[:, 1]**2)
    return energy, None, None

serve(prepare, force=force, gives="energy", name="chord", family="example", source="this test",
      summary="an energy alone", offers=["large rotations", "geometric", "mass"],
      options=[dict(name="times", default=1, min=0.5, max=2, unit="1", summary="of E I"),
               dict(name="law", choices=["linear", "other"], default="linear", summary="which")])
"""


class Energy(ProgramTest):
    """An energy alone, with options."""

    def solve(self, *words, formulation="chord", code=0):
        path = self.folder / "chord.py"
        path.write_text(ENERGY, encoding="utf-8")
        return self.answered("solve", "elastica", "--element", f"exec:'{sys.executable}' '{path}'",
                             "-f", formulation, "-n", "8", *words, code=code,
                             env={**os.environ, "PYTHONPATH": str(EXAMPLES)})

    def value(self, formulation):
        told = json.loads(self.solve("--format", "json", formulation=formulation).stdout)
        return {q["quantity"]: q["value"] for q in told["quantities"]}["w_over_L"]

    def test_solves(self):
        self.assertAlmostEqual(self.value("chord"), 0.30172, delta=1e-3)  # 0.2 % from the truth

    def test_options(self):
        """A number and a choice reach the process as they are given."""
        self.assertLess(self.value("chord:times=2"), 0.6 * self.value("chord"))
        done = self.solve(formulation="chord:law=other,times=1.5", code=2)
        self.assertIn("chord: law other, times 1.5", done.stderr)

    def test_times_are_told(self):
        self.assertIn("of the times: what the process", " ".join(self.solve().stdout.split()))


class Example(BesideC):

    def test_short(self):
        self.assertLessEqual(len((EXAMPLES / "timoshenko.py").read_text("utf-8").splitlines()), 60)

    def test_judged_like_the_others(self):
        """Ten cases: the verdicts of the same beam in C, and its limits."""
        passed = self.like_timoshenko(PYTHON, "timoshenko_py", CASES)
        self.assertEqual(passed - {"shear_elastica"}, set(CASES))

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
