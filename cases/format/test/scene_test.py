"""Scene files through the program: mistakes with their places, bits of the cases, parameters, keys."""
import json
import re
import unittest

from cases.format.test.scene_case import EXAMPLES, SceneCase, values
from harness.tools.kit.program import ROOT, run
from harness.tools.kit.scenes import LEAF, bad_scenes

GOOD = ROOT / "cases/format/test/good"
# A part of the motion of twelve joints: all of it takes as long as many other cases together.
PART = {"hexapod_motion": ("--set", "time=0.05")}


class SceneTest(SceneCase):

    def test_bad_files(self):
        """Each planted mistake is told at its place, with its remedy, and nothing else is."""
        self.assertGreaterEqual(len(bad_scenes()), 160)
        for name, text in bad_scenes():
            path = self.folder / f"{name}.yaml"
            path.write_text(text, encoding="utf-8")
            expected = re.findall(r"^# expect (.*)$", text, re.M)
            self.assertTrue(expected, path)
            done = run("solve", "--scene", path, "-f", "beamw", "-n", 1)
            told = [line.removeprefix(f"{path}:") for line in done.stderr.splitlines()]
            self.assertEqual((done.returncode, told, done.stdout), (2, expected, ""), path.name)

    def test_mistakes_for_editors(self):
        """--format json gives the same mistakes as numbers and text."""
        path = self.folder / "several_mistakes.yaml"
        path.write_text(dict(bad_scenes())[path.stem], encoding="utf-8")
        done = self.answered("scene", "--scene", path, "--format", "json", code=2)
        told = json.loads(done.stdout)
        self.assertEqual([(m["line"], m["column"]) for m in told["mistakes"]], [(15, 55), (19, 49),
                                                                                (33, 53), (34, 65)])
        self.assertEqual((told["file"], told["more"]), (str(path), 0))

    def test_unknown_parameter(self):
        """A refusal says the command that lists the parameters, and it does."""
        path = self.scene(LEAF)
        self.refused(2, f"'beamwork list --scene {path}' shows them", "solve", "--scene", path,
                     "--set", "force=3")
        self.answered("list", "--scene", path)

    def test_first_scene(self):
        """Ten lines are a scene: P L^3/3EI + P L/(k G A) at the tip."""
        path = self.scene(LEAF)
        record = self.record("solve", "--scene", path, "-f", "collocation", "-n", 1)
        area, inertia = 50e-3 * 0.5e-3, 50e-3 * 0.5e-3 ** 3 / 12
        exact = 0.1 ** 3 / (3 * 210e9 * inertia) + 0.1 / (5 / 6 * 81e9 * area)
        self.assertAlmostEqual(values(record)["tip_uy"] / exact, 1, delta=1e-9)

    def test_bytes(self):
        """Line ends and marks of other editors, and letters of other languages, change nothing."""
        own = self.answered("scene", "--scene", self.scene(LEAF)).stdout
        for name, text in (("ends", LEAF.replace(
                "\n", "\r\n")), ("mark", "\ufeff" + LEAF), ("letters", LEAF + "# Größe – 大きさ\n")):
            path = self.folder / "scene.yaml"
            path.write_bytes(text.encode())
            self.assertEqual(self.answered("scene", "--scene", path).stdout, own, name)

    def test_same_bits(self):
        """A case and the file that `scene` writes of it have the same values, every bit."""
        listed = self.answered("list", "cases").stdout.splitlines()
        cases = [line.split()[0] for line in listed if re.match("  [^ ]", line)]
        self.assertGreater(len(cases), 20)
        compared = 0
        for case in cases:
            path = self.folder / f"{case}.yaml"
            part = PART.get(case, ())
            self.answered("scene", case, *part, "-o", path)
            for formulation in ("collocation", "geometrically_exact", "beamw_consistent"):
                where = ("-f", formulation, "-n", 2, "--format", "json")
                own, copied = run("solve", case, *part, *where), run("solve", "--scene", path, *where)
                self.assertEqual((own.returncode, own.stderr), (copied.returncode, copied.stderr),
                                 (case, formulation))
                if own.stdout:
                    self.assertEqual(values(json.loads(own.stdout)),
                                     values(json.loads(copied.stdout)), (case, formulation))
                    compared += 1
        self.assertGreater(compared, 40)

    def test_written_again(self):
        """What is written of a file, read and written once more, is the same text."""
        for path in sorted(EXAMPLES.glob("*.yaml")):
            once = self.answered("scene", "--scene", path).stdout
            self.assertEqual(self.answered("scene", "--scene", self.scene(once)).stdout, once)

    def test_everything(self):
        """All that a scene can say is understood as it was meant, and written so that it is again."""
        for path in sorted(GOOD.glob("*.yaml")):
            written = path.with_suffix(".written").read_text(encoding="utf-8")
            self.assertEqual(self.answered("scene", "--scene", path).stdout, written)
            again = self.answered("scene", "--scene", self.scene(written)).stdout
            self.assertEqual(again, written)

    def test_needs_of_earlier_versions(self):
        """What it does not list is left out, but for warping; one line says what stands for it."""
        rest = ["shear", "trapeze", "wagner_moments", "wagner_torque", "rotary_inertia"]
        buckles = LEAF + ("analyses:\n  run: {buckling: {}}\nquantities:\n"
                          "  P: {critical_factor: {analysis: run}, unit: \"1\"}\n")
        for words, theory in ((["shear"], "own"), (["trapeze", "shear", "engesser"], "engesser"),
                              (["shear", "haringx", "warping"], ""), ([], ""), (rest, "own")):
            path = self.scene(buckles + f"needs: [{', '.join(words)}]\n")
            done = self.answered("scene", "--scene", path)
            omit = [word for word in rest if word not in words]
            lines = ([f"omit: [{', '.join(omit)}]"] if omit else []) + ([f"shear_theory: {theory}"]
                                                                       if theory else [])
            self.assertEqual([line for line in done.stdout.splitlines()
                              if line.startswith(("omit", "shear_theory", "needs"))], lines)
            self.assertEqual(done.stderr, f"beamwork: {path}: needs is read as earlier versions did; "
                             f"in its place write {' and '.join(lines)}\n")
            again = self.scene(done.stdout)
            self.assertEqual(self.answered("scene", "--scene", again).stdout, done.stdout)

    def test_parameters(self):
        """--set changes a scene's parameters, within their ranges; truths follow."""
        where = ("solve", "--scene", EXAMPLES / "leaf_spring_guide.yaml", "-f", "collocation", "-n",
                 1)
        got = values(self.record(*where, "--set", "width=0.1"))
        self.assertAlmostEqual(got["k_support"] / 2.1e8, 1, delta=1e-12)
        self.refused(2, "outside its range", *where, "--set", "width=100")
        self.refused(2, "did you mean 'width'", *where, "--set", "wdth=0.1")

    def test_truths_of_a_point(self):
        """A truth that names parameters holds there only, and `verify` goes there."""
        path = self.scene(
            LEAF.replace("width: 50e-3", "width: width").replace(
                "sections:", "parameters:\n  width: {value: 50e-3, unit: m}\nsections:") +
            "truths:\n  - {quantity: tip_uy, value: 1.5238e-3, kind: published, uncertainty: 1e-6,"
            " source: book, parameters: {width: 0.1}}\n")
        where = ("solve", "--scene", path, "-f", "collocation", "-n", 1)
        here = self.record(*where)["quantities"][1]
        there = self.record(*where, "--set", "width=0.1")["quantities"][1]
        self.assertEqual((here["quantity"], here["error"]), ("tip_uy", None))
        self.assertAlmostEqual(there["error"], 0, delta=1e-3)
        done = self.answered("verify", "--scene", path, "-f", "collocation")
        self.assertIn("width=0.1", done.stdout)
        self.assertIn("1 verdict against truths: 1 pass", done.stdout)

    def test_refusals(self):
        """One line where it is not the file's content."""
        self.refused(4, "cannot be read", "solve", "--scene", self.folder / "none.yaml", "-f",
                     "beamw", "-n", 1)
        self.refused(2, "give one of them", "solve", "elastica", "--scene", self.scene(LEAF), "-f",
                     "beamw", "-n", 1)
        path = self.scene(LEAF)
        self.refused(2, "which is read", "converge", "--scene", path, "-f", "beamw", "-o", path)
        self.assertEqual(path.read_text(encoding="utf-8"), LEAF)

    def test_schema(self):
        """The schema has every list of a scene, and what its entries must have."""
        schema = json.loads(self.answered("scene", "--schema").stdout)
        self.assertEqual(schema["required"], ["beamwork", "sections"])
        member = schema["properties"]["members"]["additionalProperties"]
        self.assertEqual(member["required"], ["from", "to", "section", "y"])
        self.assertIn("for", member["properties"])

    def test_list_of_keys(self):
        """--keys names what the schema names, and what the examples use is in both."""
        listed = {
            line.split()[0]
            for line in self.answered("scene", "--keys").stdout.splitlines() if line.strip()
        }
        schema = json.loads(self.answered("scene", "--schema").stdout)
        self.assertLessEqual(set(schema["properties"]), listed)
        for path in EXAMPLES.glob("*.yaml"):
            used = set(re.findall(r"^([a-z]+):", path.read_text(encoding="utf-8"), re.M))
            self.assertLessEqual(used, set(schema["properties"]))


if __name__ == "__main__":
    unittest.main()
