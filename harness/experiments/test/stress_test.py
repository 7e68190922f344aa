import csv
import io
import json
import math
import shutil
import sys
import unittest

from harness.tools.kit import program
from harness.tools.kit.program import ProgramTest, ROOT


# `beamwork stress`: exit status, agreement of the output forms, and reports of wrong values.
SMALL = "decay_free or soft_square or twist_wagner"


def run(*arguments, truths=None):
    return program.run("stress", *arguments, *(["--truths", truths] if truths else []))


class Stress(ProgramTest):

    @classmethod
    def setUpClass(cls):
        done = run("-k", SMALL, "--format", "json")
        cls.code, cls.record = done.returncode, json.loads(done.stdout)

    def altered(self, change):
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
        done = run("-k", "(turn_alpha or long_steps_radau) and collocation", "--format", "json")
        self.assertEqual(done.returncode, 0, done.stdout)
        record = json.loads(done.stdout)
        found = {(o["extreme"], o["x"], o["quantity"]): o for o in record["outcomes"]}
        for x, outcome in ((0.9, "value"), (3, "not converged")):
            self.assertEqual(found["turn_alpha", x, "R_xx"]["outcome"], outcome)
        self.assertIn("rotates by 3 rad", found["turn_alpha", 3, "energy"]["reason"])
        self.assertLess(abs(found["long_steps_radau", 100, "tip"]["error"]), 5e-3)

    def test_a_missing_truth_is_a_fault(self):

        def none(folder):
            (folder / "extremes" / "roll_up.csv").unlink()

        done = run("-k", "turns", truths=self.altered(none))
        self.assertEqual(done.returncode, 4)
        self.assertIn("tip_gap has no exact value", done.stderr)

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


STEEL = 200e9, 7800.0

SHEET = """beamwork: 1
sections:
  sheet: {rectangle: {width: 0.05, thickness: 1e-4}, young: 200e9, shear_modulus: 77e9,
          density: 7800}
nodes:
  base: {at: [0, 0, 0], hold: all}
  tip: {at: [0.1, 0, 0]}
members:
  sheet: {from: base, to: tip, section: sheet, y: [0, 1, 0]}
loads:
  aside: {force: [0, 0.0025, 0], on: tip, pieces: [{is: "0"}]}
analyses:
  aside: {static: {stations: [1]}}
  swing: {motion: {stations: [TIME], step: STEP, about: aside}}
quantities:
  tip: {displacement: {analysis: swing, node: tip, component: uy}}
omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia]
"""
SHEET_PERIOD = 0.1**2 * 2 * math.pi / 1.8751041**2 / math.sqrt(STEEL[0] * 1e-8 / 12 / STEEL[1])

# A free rod with a body at one end. MASS: mass of the body relative to that of the rod.
BODY = """beamwork: 1
sections:
  rod: {rectangle: {width: 0.02, thickness: 0.02}, young: 5e6, shear_modulus: 2e6, density: DENSITY}
nodes:
  body: {at: [0, 0, 0], mass: MASS, inertia: [INERTIA, INERTIA, INERTIA, 0, 0, 0]}
  end: {at: [1, 0, 0]}
members:
  rod: {from: body, to: end, section: rod, y: [0, 1, 0]}
analyses:
  flight: {motion: {stations: [TIME], step: STEP,
                   start: {velocity: [0, 0, 3], spin: [0.3, 0.1, 2]}}}
quantities:
  x: {displacement: {analysis: flight, node: body, component: ux}, near_zero: 1}
omit: [shear, trapeze, wagner_moments, wagner_torqueOMIT]
"""


class Extremes(ProgramTest):

    def runs(self, scene, formulation, step, *options, **words):
        for word, value in words.items():
            scene = scene.replace(word, value if isinstance(value, str) else f"{value:.17g}")
        path = self.folder / "extreme.yaml"
        path.write_text(scene.replace("STEP", f"{step:.17g}"), encoding="utf-8")
        done = program.run("motion", "--scene", path, "-f", formulation, "-n", "4", "--integrator",
                           "alpha,conserving,radau", "--step", f"{step:.17g}", "--format", "json",
                           *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return {r["integrator"]: r for r in json.loads(done.stdout)["runs"]}

    def is_named(self, run):
        self.assertEqual(run["status"], "not_converged")
        self.assertIn(" s: ", run["reason"] + " s: ")
        self.assertIsNotNone(run["stopped"])

    def test_thin_sheet(self):
        for formulation in ("sheet_third", "collocation"):
            found = self.runs(SHEET, formulation, SHEET_PERIOD / 40, TIME=2 * SHEET_PERIOD)
            for integrator, most in (("alpha", 0.2), ("conserving", 0.2), ("radau", 1e-3)):
                if found[integrator]["status"] != "ok":
                    self.is_named(found[integrator])
                    continue
                self.assertLess(found[integrator]["error"], most, (formulation, integrator))
            self.assertLess(found["conserving"]["energy_drift"], 1e-9)

    def test_a_thousand_periods(self):
        found = self.runs(SHEET, "collocation", SHEET_PERIOD / 10, "--conservation-only",
                          TIME=1000 * SHEET_PERIOD)
        self.assertEqual(found["conserving"]["status"], "ok")
        self.assertLess(found["conserving"]["energy_drift"], 1e-9)
        self.assertGreater(found["conserving"]["steps"], 9000)

    def test_heavy_body(self):
        rod = STEEL[1] * 4e-4
        found = self.runs(BODY, "collocation", 0.01, TIME=1, DENSITY=STEEL[1], MASS=1e6 * rod,
                          INERTIA=1e5 * rod, OMIT="")
        self.assertEqual(found["conserving"]["outcome"], "exact")
        for integrator, most in (("alpha", 0.02), ("conserving", 0.02), ("radau", 1e-3)):
            self.assertLess(found[integrator]["error"], most, integrator)

    def test_nearly_massless_nodes(self):
        for omit in ("", ", rotary_inertia"):
            found = self.runs(BODY, "collocation", 0.01, "--conservation-only", TIME=1, DENSITY=1e-6,
                              MASS=1, INERTIA=0.1, OMIT=omit)
            for integrator in ("alpha", "conserving", "radau"):
                run = found[integrator]
                if run["status"] == "ok":
                    self.assertLess(run["energy_drift"], 1e-6, integrator)
                else:
                    self.is_named(run)
            self.assertEqual(found["conserving"]["outcome"], "exact")


if __name__ == "__main__":
    unittest.main()
