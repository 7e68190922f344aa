"""A long step must not leave a stable path for an unstable state."""
import unittest

from harness.tools.kit.program import ProgramTest

SCENE = """beamwork: 1
sections:
  s: {rectangle: {width: 0.03, thickness: 0.0015}, young: 70e9, shear_modulus: 27e9}
nodes:
  a: {at: [0, 0, 0], hold: all}
  b: {at: [0.5, 0, 0]}
members:
  m: {from: a, to: b, section: s, y: [0, 1, 0]}
loads:
  l: {force: [0, 0.3, -15], on: b}
analyses:
  s: {static: {stations: [1], steps: %d}}
quantities:
  uy: {displacement: {analysis: s, node: b, component: uy}}
omit: [shear]
"""


class LeftPath(ProgramTest):

    def test_strip_beyond_its_lateral_buckling_load(self):
        for formulation in ("collocation", "beamw_consistent", "geometrically_exact"):
            found = []
            for steps in (1, 50):
                path = self.folder / "scene.yaml"
                path.write_text(SCENE % steps, encoding="utf-8")
                found += [q["value"] for q in self.record("solve", "--scene", path, "-f", formulation, "-n", 16)["quantities"]]
            self.assertGreater(found[1], 0.1, formulation)
            self.assertAlmostEqual(found[0] / found[1], 1, 6, formulation)


if __name__ == "__main__":
    unittest.main()
