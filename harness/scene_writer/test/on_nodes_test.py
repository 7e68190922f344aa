"""What of loads and mass is put on nodes is said, with the order in space that it has."""
import json
import math
import unittest

from harness.test.program import ProgramTest, run

SCENE = """beamwork: 1
sections: {s: {rectangle: {width: 0.02, thickness: 0.01}, young: 2e11, shear_modulus: 8e10%s}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]}}
members: {beam: {from: a, to: b, section: s, y: [0, 1, 0]}}
loads: {%s}
analyses: {%s}
quantities: {u: {displacement: {analysis: run, node: b, component: uy}}}
"""
SHARES = (": half of an element's at both its nodes, of order 2 in its length (at three nodes 1/6, 4/6, "
          "1/6, of order 4)")
HEAVY = ", density: 7800"
LOADS = "d: {distributed: [0, 20, 0], on: beam%s}, w: {gravity: [0, -9.81, 0], on: beam}"
MOTION = ("run: {motion: {stations: [0.001], integrator: %s, step: 1e-3%s}}")


class OnNodes(ProgramTest):
    def cell(self, scene, elements=2, formulation="beamw"):
        path = self.folder / "scene.yaml"
        path.write_text(scene, encoding="utf-8")
        done = run("solve", "--scene", path, "-f", formulation, "-n", elements, "--format", "json")
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)
        return found["cell"]["lumped"], found["quantities"][0]["value"]

    def test_nothing_is(self):
        self.assertEqual(self.cell(SCENE % (HEAVY, LOADS % "", "run: {linear: {}}"))[0], "")

    def test_a_load_that_asks_for_it(self):
        told, _ = self.cell(SCENE % (HEAVY, LOADS % ", lumped: yes", "run: {linear: {}}"))
        self.assertEqual(told, "load d" + SHARES)

    def test_orders_of_what_is(self):
        load = "d: {distributed: [0, 20, 0], to_value: [0, 5, 0], on: beam%s}"
        for formulation, order in (("beamw", 2), ("geometrically_exact:nodes=3", 4)):
            exact = self.cell(SCENE % ("", load % "", "run: {linear: {}}"), 2, formulation)[1]
            error = [abs(self.cell(SCENE % ("", load % ", lumped: yes", "run: {linear: {}}"), n,
                                   formulation)[1] / exact - 1) for n in (4, 8, 16)]
            for coarse, fine in zip(error, error[1:]):
                self.assertAlmostEqual(math.log2(coarse / fine), order, delta=0.05)

    def test_motions(self):
        for integrator, more, what in (("conserving", "", " and loads along members"),
                                       ("alpha", ", mass: lumped", " and weight")):
            told, _ = self.cell(SCENE % (HEAVY, LOADS % "", MOTION % (integrator, more)))
            self.assertEqual(told, "mass" + what + " of analysis run" + SHARES)
        told, _ = self.cell(SCENE % (HEAVY, LOADS % "", MOTION % ("alpha", ", mass: consistent")),
                            formulation="beamw_consistent:mass=consistent")
        self.assertEqual(told, "")

    def test_in_text(self):
        path = self.folder / "scene.yaml"
        path.write_text(SCENE % ("", LOADS.partition(", w")[0] % ", lumped: yes",
                                 "run: {linear: {}}"), encoding="utf-8")
        done = run("solve", "--scene", path, "-f", "beamw", "-n", "2")
        self.assertIn("lumped: load d" + SHARES, " ".join(done.stdout.split()))


if __name__ == "__main__":
    unittest.main()
