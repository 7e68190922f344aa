"""Critical loads about a loaded state: the same whatever the load of that state, several when they
are asked for, and a range where there is none."""
import json
import math
import unittest

from harness.tools.kit.program import ProgramTest, run

# Euler's load is 1: E Iz = 4 L^2/pi^2 of the clamped column; hardly shortened.
COLUMN = """beamwork: 1
sections: {s: {constants: {A: 1e6, Iy: %(Iy)r, Iz: %(Iz)r, It: 1}, young: 1, shear_modulus: 1}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}
loads: {p: {force: [%(force)r, 0, 0], on: b}%(more)s}
analyses: {path: {static: {stations: [1]}}, about: {buckling: {about: path, wanted: 4}}}
quantities:
  P_$i: {for: {i: 0..%(last)d}, critical_factor: {analysis: about, which: $i}, unit: 1}
omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia]
"""
I = 4 / math.pi ** 2
ZERO = ", z: {moment: [0, 0, 0], on: b}"


class AboutState(ProgramTest):
    def factors(self, formulation="collocation", force=-1, Iy=I, last=0, more="", status=0):
        path = self.folder / "scene.yaml"
        path.write_text(COLUMN % {"force": force, "Iy": Iy, "Iz": I, "last": last, "more": more})
        done = run("solve", "--scene", path, "-f", formulation, "-n", 8, "--format", "json")
        self.assertEqual(done.returncode, status, done.stdout[-3000:] + done.stderr)
        return ([q.get("value") for q in json.loads(done.stdout)["quantities"]],
                " ".join((done.stdout + done.stderr).split()))

    def test_any_load(self):
        """A thousandth of the critical load to a thousand times that."""
        for formulation in ("collocation", "geometrically_exact", "beamw_consistent"):
            for force in (1e-3, 0.5, 0.99, 1.01, 30, 1000):
                (factor,), _ = self.factors(formulation, -force)
                self.assertLess(abs(factor * force - 1), 1e-3, (formulation, force))

    def test_several(self):
        for Iy in (I, I * (1 + 1e-9), I * (1 - 1e-6), I * (1 + 1e-3), 3 * I):
            for force in (0.01, 0.5, 20):
                found, _ = self.factors(force=-force, Iy=Iy, last=3)
                exact = sorted([1, 9, 25, Iy / I, 9 * Iy / I])
                for value, right in zip(found, exact):
                    self.assertLess(abs(value * force / right - 1), 4e-3, (Iy, force, found))

    def test_zero_load(self):
        self.assertEqual(self.factors(more=ZERO)[0], self.factors()[0])

    def test_none(self):
        """Pulled: the range that was searched is named."""
        found, said = self.factors(force=1, status=1)
        self.assertEqual(found, [None])
        self.assertRegex(said, r"no critical load from path 1 to [0-9.e+]+: nothing loses")


if __name__ == "__main__":
    unittest.main()
