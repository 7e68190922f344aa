"""The examples: they pass together, with the values that they are known for."""
import json
import re
import unittest

from cases.format.test.scene_case import EXAMPLES, SceneCase, values


class ExamplesTest(SceneCase):

    def test_examples_are_understood(self):
        for path in sorted(EXAMPLES.glob("*.yaml")):
            self.answered("list", "--scene", path)

    def test_folder(self):
        """All examples at once, every formulation as expected; a case beside them; names once."""
        verdicts = self.folder / "verdicts.json"
        done = self.answered("verify", "--scene", EXAMPLES, "-v", "--json", verdicts)
        judged = {v["case"] for v in json.loads(verdicts.read_text(encoding="utf-8"))["verdicts"]}
        known = {path.stem for path in EXAMPLES.glob("*.yaml")
                 if "\ntruths:" in path.read_text(encoding="utf-8")}
        self.assertGreaterEqual(len(known), 4)
        self.assertLessEqual(known, judged)
        self.assertIn("PASS: every verdict is as expected", done.stdout)
        block = done.stdout.partition("\nleaf_spring_guide\n")[2]
        block = block.partition("\n  k_drive [")[2].partition("\n  k_")[0]
        self.assertIn("[1] N50-examples: ", done.stdout)
        found = re.findall(r"^    (\S+) .* biased, as predicted \[1\]$", block, re.M)
        self.assertEqual(found, ["sheet_third", "sheet_third_printed"])
        self.answered("verify", "--built-in", "--scene", EXAMPLES, "--json", verdicts, "-k",
                      "(euler_column or warping_torsion/default) and collocation")
        both = json.loads(verdicts.read_text(encoding="utf-8"))
        self.assertEqual({v["case"] for v in both["verdicts"]}, {"euler_column", "warping_torsion"})
        euler = EXAMPLES / "euler_column.yaml"
        self.refused(2, "is judged already", "verify", "--scene", EXAMPLES, "--scene", euler)
        self.refused(2, "no *.yaml", "verify", "--scene", EXAMPLES.parent / "shared")
        taken = euler.read_text(encoding="utf-8").replace("name: euler_column", "name: c_column")
        taken = self.scene(taken)
        self.refused(2, "is judged already", "verify", "--built-in", "--scene", taken)
        self.refused(2, "given twice", "solve", "--scene", euler, "--scene", euler, "-f", "beamw",
                     "-n", 1)
        self.refused(2, "would replace", "verify", "--scene", self.folder, "-o", taken)

    def test_leaf_spring_guide(self):
        """Stiffnesses at rest by hand, those of the pushed stage by the deriving program."""
        path = EXAMPLES / "leaf_spring_guide.yaml"
        got = values(self.record("solve", "--scene", path, "-f", "collocation", "-n", 4))
        self.assertAlmostEqual(got["k_drive"] / 2624.536778, 1, delta=1e-9)
        self.assertAlmostEqual(got["k_support"] / 1.05e8, 1, delta=1e-12)
        self.assertAlmostEqual(got["k_pushed"] / 13.1869e6, 1, delta=1e-5)
        done = self.answered("verify", "--scene", path, "-f", "collocation")
        self.assertIn("5 pass", done.stdout)

    def test_double_cross(self):
        """Stiffness out of the plane leaves the sixteen frequencies in it alone."""
        path, count = EXAMPLES / "double_cross.yaml", 0
        for formulation in ("collocation", "beamw_vlasov"):
            where = ("solve", "--scene", path, "-f", formulation, "-n", 8)
            usual, stiffer = (values(self.record(*where, "--set", f"across={across}"))
                              for across in (100, 1e4))
            for name, value in usual.items():
                self.assertAlmostEqual(stiffer[name] / value, 1, delta=1e-11)
                count += 1
        self.assertEqual(count, 32)

    def test_cross_flexure_hinge(self):
        """Moment, shift and stiffness at 20 degrees."""
        got = values(
            self.record("solve", "--scene", EXAMPLES / "cross_flexure_hinge.yaml", "-f",
                        "collocation", "-n", 2))
        for name, value in (("moment", 0.0800992), ("shift_y", 0.838472e-3), ("k_x", 177513.77)):
            self.assertAlmostEqual(got[name] / value, 1, delta=1e-6)

    def test_folded_leaf_stage(self):
        """Three instances at 120 degrees: the stiffness in their plane has no direction."""
        path = EXAMPLES / "folded_leaf_stage.yaml"
        got = values(self.record("solve", "--scene", path, "-f", "collocation", "-n", 2))
        self.assertAlmostEqual(got["k_x"] / got["k_y"], 1, delta=1e-12)
        turned = path.read_text(encoding="utf-8").replace("{a: 2*pi/3*i}", "{a: 2*pi/3*i + 0.3}")
        again = values(
            self.record("solve", "--scene", self.scene(turned), "-f", "collocation", "-n", 2))
        for name, value in got.items():
            self.assertAlmostEqual(again[name] / value, 1, delta=1e-11)

    def test_box_girder(self):
        """Benscoter's beam: torsion with warping restrained of a closed section."""
        path = EXAMPLES / "box_girder.yaml"
        done = self.answered("verify", "--scene", path)
        self.assertRegex(done.stdout, r"12 verdicts against truths: 12 pass")
        self.assertRegex(done.stdout, r"sheet_second, [\w,\s]+: another model: warping not modelled")


if __name__ == "__main__":
    unittest.main()
