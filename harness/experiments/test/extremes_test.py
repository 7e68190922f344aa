"""Motions at extremes: each integrator with a value and its error, or a failure that is named."""
import json
import math
import unittest

from harness.tools.kit import program
from harness.tools.kit.program import ProgramTest

STEEL = 200e9, 7800.0

# A sheet whose length is a thousand times its thickness, held aside and released.
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

# A rod with a body at one end flies freely; MASS: of the body in masses of the rod.
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
        """Each integrator: its run."""
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
        """A motion that fails says how and when."""
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
        found = self.runs(SHEET, "collocation", SHEET_PERIOD / 10, "--no-errors",
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
        """With and without inertia of turns: a value that is right, or a failure with its name."""
        for omit in ("", ", rotary_inertia"):
            found = self.runs(BODY, "collocation", 0.01, "--no-errors", TIME=1, DENSITY=1e-6,
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
