"""Stability of each station of a path: in tables, in records, and in the choice of a mesh."""
import math
import unittest

from cases.format.test.scene_case import SceneCase
from harness.tools.kit.program import run

# A column, clamped below and free above, held in its plane; it stays straight, and buckles at path 1.
EULER = math.pi**2/4*210e9*50e-3*5e-3**3/12
COLUMN = f"""beamwork: 1
sections: {{strip: {{rectangle: {{width: 50e-3, thickness: 5e-3}}, young: 210e9, shear_modulus: 81e9, density: 7800}}}}
nodes:
  foot: {{at: [0, 0, 0], hold: all}}
  head: {{at: [1, 0, 0]}}
members: {{post: {{from: foot, to: head, section: strip, y: [0, 1, 0], warping: fixed}}}}
loads: {{push: {{force: [-{EULER!r}, 0, 0], on: head}}}}
analyses:
  press: {{static: {{stations: [0.5, 0.95, 1.05, 1.5]}}}}
  again: {{static: {{stations: [0.5, 0.9]}}}}
quantities:
  short: {{displacement: {{analysis: press, node: head, component: ux, take: curve}}}}
  shorter: {{displacement: {{analysis: again, node: head, component: ux}}}}
"""
# Turning about its axis faster than its first critical speed, where gyroscopic forces hold it or not.
SHAFT = COLUMN.replace("static: {stations: [0.5, 0.95, 1.05, 1.5]}",
                       "static: {stations: [1], spin: {omega: [200, 0, 0]}}").replace(f"-{EULER!r}", "-1e-6")


class StabilityTest(SceneCase):

    def steps(self, text, analysis, formulation):
        record = self.record("solve", "--scene", self.scene(text), "-f", formulation, "-n", 4)
        return {s["path"]: s["stability"].split(" (")[0] for s in record["steps"] if s["analysis_name"] == analysis}

    def test_column(self):
        for formulation in ("collocation", "beamw", "geometrically_exact", "sheet_third"):
            found = self.steps(COLUMN, "press", formulation)
            self.assertEqual({p: found[p] for p in (0.5, 0.95, 1.05, 1.5)},
                             {0.5: "stable", 0.95: "stable", 1.05: "unstable", 1.5: "unstable"}, formulation)
            self.assertEqual(set(self.steps(COLUMN, "again", formulation).values()), {"stable"})

    def test_words(self):
        text = self.answered("solve", "--scene", self.scene(COLUMN), "-f", "collocation", "-n", 4).stdout
        self.assertIn("analysis press: stable up to 0.95, unstable from 1.05 (path)", text)
        self.assertNotIn("analysis again:", text)
        rows = [line.split() for line in text.splitlines()]
        self.assertEqual([r[2] for r in rows if len(r) == 3 and r[0] in ("0.5", "0.95", "1.05", "1.5")],
                         ["yes", "yes", "no", "no"])

    def test_meshes(self):
        """converge says where; solve goes on to the finest mesh, which might not pass."""
        text = self.answered("converge", "--scene", self.scene(COLUMN), "-f", "collocation", "-f", "beamw").stdout
        self.assertIn("collocation met unstable states:\n  n = 1: stable up to 0.95", text)
        line = self.answered("solve", "--scene", self.scene(COLUMN), "-f", "collocation").stdout
        self.assertIn("-n 8", line)

    def test_turning(self):
        """Pivots say nothing there."""
        found = self.steps(SHAFT, "press", "collocation")
        self.assertEqual(found[1], "undecided")
        done = run("solve", "--scene", self.scene(SHAFT), "-f", "collocation", "-n", 4)
        self.assertNotIn("unstable", done.stdout)


if __name__ == "__main__":
    unittest.main()
