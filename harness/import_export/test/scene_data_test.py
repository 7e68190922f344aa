"""`scene --format json` must give the scene file, the required physics, the axes of the members, the constants of
the sections, and the meanings of the quantities."""
import json
import math
import unittest

import numpy as np

from harness.tools.kit.program import ProgramTest

TURN = math.pi / 6
BAR = f"""beamwork: 1
sections:
  wall: {{points: {{a: [-0.1, 0], b: [0.1, 0], c: [0.1, 0.1]}}, walls: [{{from: a, to: b, thickness: 2e-3}},
    {{from: b, to: c, thickness: 2e-3}}], young: 200e9, shear_modulus: 80e9, density: 7800}}
  matrix: {{stiffness: [1, 2, 3, 4, 5, 6], mass: [1, 1, 1, 3, 1, 2]}}
nodes:
  "n 1": {{at: [1, 2, 3], hold: all}}
  end: {{at: [2, 2, 3]}}
  far: {{at: [2, {2 + math.sin(TURN)}, {4 - math.cos(TURN)}]}}
members:
  angle: {{from: "n 1", to: end, section: wall, y: [0, 1, 0]}}
  arc: {{from: end, to: far, section: matrix, y: [0, 0, 1], curvature: [0, 0, 1]}}
loads: {{push: {{force: [0, 1, 0], on: far, pieces: [{{is: "2"}}]}}}}
analyses: {{bent: {{static: {{stations: [1]}}}}, swing: {{motion: {{stations: [1], step: 0.1}}}}}}
quantities: {{u: {{displacement: {{analysis: bent, node: far, component: uy}}, unit: m, factor: 1000}}}}
"""


class SceneData(ProgramTest):

    def data(self, *arguments):
        return json.loads(self.answered("scene", *arguments, "--format", "json").stdout)

    def test_own_scene(self):
        place = self.folder / "bar.yaml"
        place.write_text(BAR, encoding="utf-8")
        got = self.data("--scene", place)
        self.assertEqual(got["of"], str(place))
        self.assertEqual(got["scene"]["loads"]["push"]["pieces"], [{"is": "2"}])
        self.assertEqual(got["scene"]["quantities"]["u"]["factor"], 1000)
        self.assertIn("displacement of far", got["meanings"]["u"])
        wall, matrix = got["sections"]
        self.assertEqual((wall["E"], wall["G"]), (200e9, 80e9))
        self.assertAlmostEqual(wall["A"], 0.3 * 2e-3)
        self.assertNotIn("stiffness", wall)
        self.assertEqual(np.diag(matrix["stiffness"]).tolist(), [1, 2, 3, 4, 5, 6])
        angle, arc = got["lines"]
        axes = np.array(angle["axes"])
        np.testing.assert_allclose(axes.T @ axes, np.eye(3), atol=1e-14)
        np.testing.assert_allclose(axes[:, 0], [1, 0, 0], atol=1e-14)
        self.assertGreater(abs(axes[2, 1]), 0.1)
        self.assertAlmostEqual(arc["length"], TURN, places=12)
        np.testing.assert_allclose(np.array(arc["axes"])[:, 0], [0, 1, 0], atol=1e-12)
        np.testing.assert_allclose(arc["curvature"], [0, 0, 1])

    def test_taper(self):
        """A tapered member must have its sections at equal distances; here a wedge, half as thick at its tip."""
        sections = self.data("tapered_cantilever")["lines"][0]["sections"]
        thickness = 0.02 * (1 - np.linspace(0, 0.5, len(sections)))
        np.testing.assert_allclose([s["Iz"] for s in sections], 0.03 * thickness**3 / 12, rtol=1e-12)
        self.assertTrue(all("sections" not in line for line in self.data("bend_45")["lines"]))

    def test_parameters_and_physics(self):
        got = self.data("bend_45")
        self.assertEqual(got["of"], "bend_45")
        self.assertEqual(set(got["physics"]), {"shear", "haringx", "large rotations"})
        other = self.data("sheet_cantilever", "--set", "warping=0", "--set", "trapeze=0")
        self.assertEqual(other["of"], "sheet_cantilever; warping=0;trapeze=0")
        self.assertEqual(set(other["physics"]), {"shear", "haringx", "large rotations"})
        self.assertIn("trapeze", self.data("sheet_cantilever")["physics"])


if __name__ == "__main__":
    unittest.main()
