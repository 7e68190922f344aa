"""Formulations from outside in motions in time: by strains, by forces, by an energy alone, and in
another process."""
import sys
import unittest

from harness.cli.test.plugin import EXAMPLES, PluginTest, compile_shared

PROCESS = f"exec:'{sys.executable}' '{EXAMPLES / 'timoshenko.py'}'"

ARM = """beamwork: 1
sections:
  tube: {tube: {diameter: 20e-3, thickness: 1e-3}, young: 70e9, shear_modulus: 26e9, density: 2700}
nodes:
  hub: {at: [0, 0, 0], hold: [ux, uy, uz, rx, ry], drive: {rz: turn}}
  tip: {at: [1, 0, 0], mass: 0.3}
members:
  arm: {from: hub, to: tip, section: tube, y: [0, 1, 0]}
motions:
  turn: {unit: rad, pieces: [{is: 30*deg*(2*t - sin(4*pi*t)/(2*pi))}]}
analyses:
  swing: {motion: {stations: [0.1], integrator: conserving, step: 0.01}}
quantities:
  behind: {relative: {analysis: swing, node: tip, from: hub, component: uy}}
  energy: {energy: {analysis: swing, of: energy}}
omit: [shear, trapeze, wagner_moments, wagner_torque]
"""


class OwnMotion(PluginTest):

    def flight(self, integrator, name, *element):
        """A soft rod thrown in space, for a second."""
        return self.record("solve", "free_flight_space", "--set", f"integrator={integrator}", "-f",
                           name, "-n", 4, *element)

    def compare(self, name, element, integrators=("alpha", "conserving", "radau")):
        """As the exact beam with as many elements; conserving steps miss no energy."""
        for integrator in integrators:
            ours = self.flight(integrator, "collocation")
            own = self.flight(integrator, name, "--element", element)
            for one, same in zip(own["quantities"], ours["quantities"], strict=True):
                if one["unit"] == "m":
                    with self.subTest(integrator=integrator, quantity=one["quantity"]):
                        self.assertAlmostEqual(one["value"], same["value"], delta=0.02)
            if integrator == "conserving":
                energy = max(step["kinetic"] for step in own["motion"])
                self.assertLess(max(abs(step["drift"]) for step in own["motion"]), 1e-12 * energy)

    def test_by_strains(self):
        self.compare("timoshenko", compile_shared(EXAMPLES / "timoshenko.c", self.folder / "t.so"))

    def test_by_forces(self):
        self.compare("corotational", compile_shared(EXAMPLES / "corotational.c",
                                                    self.folder / "c.so"))

    def test_by_an_energy_alone(self):
        """A thin arm that is turned by its hub."""
        made = compile_shared(EXAMPLES / "ancf.c", self.folder / "a.so")
        path = self.folder / "arm.yaml"
        path.write_text(ARM, encoding="utf-8")
        own, ours = (self.record("solve", "--scene", path, "-f", *words, "-n", 2)
                     for words in (("ancf", "--element", made), ("collocation",)))
        for one, same in zip(own["quantities"], ours["quantities"], strict=True):
            self.assertAlmostEqual(one["value"] / same["value"], 1, delta=0.02)
        self.assertLess(max(abs(step["drift"]) for step in own["motion"]), 1e-14)

    def test_in_another_process(self):
        self.compare("timoshenko_py", PROCESS, ("conserving",))


if __name__ == "__main__":
    unittest.main()
