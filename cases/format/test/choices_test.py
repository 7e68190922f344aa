"""What of a scene file hangs on its parameters."""
import unittest

from cases.format.test.scene_case import SceneCase

CHOSEN = """\
beamwork: 1
parameters:
  load:  {value: tip, choices: [tip, root_side], about: "where it is"}
  size:  {value: 3, unit: N, min: 0, max: 100, about: "of it"}
  shear: {value: 0, choices: [0, 1], about: "1: flexible in shear"}
let:
  high: sign(size - 10)
  place: {load: {tip: tip, else: middle}}
  part: {high: {1: {shear: {0: 0.5, 1: 0.25}}, else: 1}}
refuse:
  - {if: {load: root_side, high: [0, 1]}, say: "size = $size N on the root's side; give less than 10 N"}
sections:
  leaf: {rectangle: {width: 0.05, thickness: 0.5e-3}, young: 210e9, shear_modulus: 81e9}
nodes:
  base: {at: [0, 0, 0], hold: all}
  middle: {at: [0.05, 0, 0]}
  tip: {at: [0.1, 0, 0]}
members:
  near: {from: base, to: middle, section: leaf, y: [0, 1, 0]}
  far: {from: middle, to: tip, section: leaf, y: [0, 1, 0]}
loads:
  push_$i: {for: {i: 1..2}, if: {load: tip}, force: [0, part*size/2, 0], on: place}
  push: {if: {load: [root_side]}, force: [0, part*size, 0], on: place}
omit: {trapeze: yes, shear: {shear: 0}}
meshes: {shear: {0: [1, 2], 1: [1, 2, 4]}}
"""


class ChoicesTest(SceneCase):

    def written(self, *assignments):
        """Lines of the scene at these values: loads, omit, meshes."""
        given = [word for one in assignments for word in ("--set", one)]
        text = self.answered("scene", "--scene", self.scene(CHOSEN), *given).stdout
        loads = text[text.index("loads:"):text.index("analyses:")].split()[1:]
        ends = {line.split(":")[0]: line for line in text.splitlines() if line[:4] in ("omit", "mesh")}
        return " ".join(loads), ends["omit"], ends["meshes"]

    def test_values_choose(self):
        """Entries, values, physics and meshes are those of the values that the parameters have."""
        self.assertEqual(self.written(),
                         ("push_1: {force: [0, 1.5, 0], on: tip} push_2: {force: [0, 1.5, 0], on: tip}",
                          "omit: [shear, trapeze]", "meshes: [1, 2]"))
        self.assertEqual(self.written("load=root_side", "shear=1"),
                         ("push: {force: [0, 3, 0], on: middle}", "omit: [trapeze]",
                          "meshes: [1, 2, 4]"))
        self.assertIn("force: [0, 5, 0]", self.written("size=20")[0])
        self.assertIn("force: [0, 2.5, 0]", self.written("size=20", "shear=1")[0])

    def test_refused(self):
        """Values that make no scene are refused at the place that says so; a switch has two values."""
        path = self.scene(CHOSEN)
        self.refused(2, f"{path}:11:49: size = 12.5 N on the root's side; give less than 10 N", "solve",
                     "--scene", path, "--set", "load=root_side", "--set", "size=12.5")
        self.refused(2, "shear", "solve", "--scene", path, "--set", "shear=0.5")


if __name__ == "__main__":
    unittest.main()
