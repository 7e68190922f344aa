"""What only the mesh makes is no answer: a stiffness that is indefinite at rest, a critical load
that grows with the square of the number of elements."""
import json
import math
import unittest

from harness.test.program import ProgramTest, run

RING = """beamwork: 1
sections: {leaf: {rectangle: {width: 20e-3, thickness: %(t)s}, young: 200e9, shear_modulus: 80e9}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [0.1, 0.1, 0]}}
members: {ring: {from: a, to: b, section: leaf, y: [-1, 1, 0], curvature: [0, 0, 10],
                 warping: free}}
loads: {p: {force: [0, -1e-3, 0], on: b}}
analyses: {li: {%(analysis)s}}
quantities: {u: {displacement: {analysis: li, node: b, component: uy}, unit: m}}
omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia]
"""
STRUT = """beamwork: 1
sections: {leg: {angle: {along_y: 0.07, along_z: 0.07, thickness: 0.004}, young: 210e9,
                 shear_modulus: 81e9}}
nodes: {a: {at: [0, 0, 0], hold: [ux, uy, uz, rx]}, b: {at: [0.8, 0, 0], hold: [uy, uz, rx]}}
members: {strut: {from: a, to: b, section: leg, y: [0, 1, 0], warping: free}}
loads: {P: {force: [-1, 0, 0], on: b}}
analyses: {b: {buckling: {wanted: 1}}}
omit: [shear, wagner_torque, rotary_inertia]
quantities:
  tension: {critical_factor: {analysis: b, which: 0, sign: negative}}
  compression: {critical_factor: {analysis: b, which: 0}}
"""


class Discretised(ProgramTest):
    def solve(self, scene, formulation, n):
        path = self.folder / "scene.yaml"
        path.write_text(scene)
        done = run("solve", "--scene", path, "-f", formulation, "-n", n, "--format", "json")
        said = " ".join((done.stdout + done.stderr).split())
        found = json.loads(done.stdout).get("quantities", []) if done.stdout[:1] == "{" else []
        values = {q["quantity"]: q.get("value") for q in found}
        return done.returncode, values, said

    def test_arcs(self):
        """EA l^4 k^2/EI = 6107 of one element, whatever the angle: below, it has a sign."""
        for n in (1, 2, 4):
            turn = math.pi / 2 / n
            for side in (0.98, 1.02):
                t = 0.1 * turn ** 2 * math.sqrt(12 / (6107 * side))
                for analysis in ("linear: {}", "static: {stations: [1]}"):
                    status, values, said = self.solve(RING % {"t": repr(t), "analysis": analysis},
                                                      "sheet_third", n)
                    if side < 1:
                        self.assertEqual(status, 0, said)
                        self.assertLess(values["u"], 0)
                    else:
                        self.assertEqual(status, 1, said)
                        self.assertIn("sheet_third: %d negative pivot" % n, said)
                        self.assertIn("use more elements or another formulation", said)
        self.assertIn("radii of gyration", run("list", "sheet_third").stdout)
        self.assertNotIn("radii of gyration", run("list", "sheet_second").stdout)

    def test_tension(self):
        for formulation in ("geometrically_exact", "beamw_consistent", "collocation"):
            for n in (1, 2, 4, 8):
                _, values, said = self.solve(STRUT, formulation, n)
                self.assertIsNone(values["tension"], (formulation, n, said))
                self.assertGreater(values["compression"], 0, (formulation, n))


if __name__ == "__main__":
    unittest.main()
