"""What the user named comes back by its name: in messages, tables, folders, records and files."""
import csv
import re
import unittest

from cases.format.test.scene_case import SceneCase
from harness.tools.kit.program import ROOT, ProgramTest, run

NUMBERED = re.compile(r"\b(node|member|section|spring|load|analysis|motion)[ _][0-9]")

GUIDE = """beamwork: 1
sections:
  steel: {rectangle: {width: 30e-3, thickness: 0.3e-3}, young: 200e9, shear_modulus: 77e9}
parts:
  wing:
    places: [stage]
    nodes:
      foot: {at: [0, 0, 0], hold: all}
      top: {at: [0, 0.08, 0], part_of: stage}
    members:
      leaf: {from: foot, to: top, section: steel, y: [1, 0, 0], warping: fixed}
instances:
  left: {part: wing, at: [0, 0, 0], connect: {stage: stage}}
  right: {part: wing, at: [0.06, 0, 0], connect: {stage: stage}}
nodes:
  stage: {at: [0.03, 0.08, 0]}
  post_$i: {for: {i: 1..2}, at: [i, 0, 0], hold: all}
  peak: {at: [1.5, 0.2, 0]}
members:
  brace_$i: {for: {i: 1..2}, from: post_$i, to: peak, section: steel, y: [0, 0, 1], warping: fixed}
springs:
  strap: {from: peak, to: stage, stiffness: [1, 1, 1, 0, 0, 0]}
loads:
  push: {force: [0, 1e-3, 0], on: stage}
analyses:
  travel: {static: {stations: [0.5, 1]}}
  support: {compliance: {node: stage, about: travel}}
quantities:
  stage_y: {displacement: {analysis: travel, node: stage, component: uy}}
  k_x: {stiffness: {analysis: support, component: ux}}
  moment: {internal: {analysis: travel, member: left.leaf, end: from, resultant: Mz}, unit: "N m"}
"""

# What makes the guide wrong, and what the line says after the place in the file.
WRONG = [
    ("hold: all}\n      top: {at: [0, 0.08, 0]", "hold: all}\n      top: {at: [0, 0, 0]",
     "left.leaf: its ends coincide"),
    ("from: peak, to: stage, st", "from: peak, to: peak, st", "strap: both its ends are node peak"),
    ("stiffness: [1, 1, 1, 0", "stiffness: [1, -1, 1, 0", "strap: its stiffness"),
    ("[0, 1e-3, 0], on: stage", "[0, 1/0, 0], on: stage", "division by zero"),
    ("{force: [0, 1e-3, 0], on: stage}", "{distributed: [0, 1, 0], on: brace_2, axes: member, follower: yes}\n"
     "  wind: {moment: [0, 0, 1], on: peak, at: [1, 0, 0]}", "wind: only forces act at an offset"),
    ("stations: [0.5, 1]", "stations: [1, 0.5]", "travel: its stations must ascend"),
    ("peak: {at: [1.5, 0.2, 0]}", "peak: {at: [1.5, 0.2, 0], mass: -1}", "mass = -1; give at least 0"),
]


class NamesTest(SceneCase):

    def unnumbered(self, text, what):
        self.assertIsNone(NUMBERED.search(text), (what, NUMBERED.search(text)))

    def line(self, code, words, *arguments):
        """The one line of a refusal, in which the words stand."""
        done = run(*arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertIn(words, done.stderr)
        self.unnumbered(done.stderr, words)
        return done.stderr

    def test_refusals(self):
        for before, behind, words in WRONG:
            self.assertIn(before, GUIDE)
            path = self.scene(GUIDE.replace(before, behind))
            line = self.line(2, words, "solve", "--scene", path)
            self.assertRegex(line, r"scene\.yaml:\d+:\d+: ")

    def test_tables(self):
        path = self.scene(GUIDE)
        text = self.answered("solve", "--scene", path, "-f", "collocation", "-n", 2).stdout
        self.assertIn("compliance of node stage at path 1", text)
        self.unnumbered(text, "solve")

    def test_loose(self):
        path = self.scene(GUIDE.replace("peak: {at", "cloud: {at: [5, 5, 0]}\n  rain: {at: [5, 6, 0]}\n  peak: {at")
                          .replace("springs:", "  mist: {from: cloud, to: rain, section: steel, y: [1, 0, 0]}\nsprings:"))
        self.line(1, "node cloud at (5, 5, 0) is not held", "solve", "--scene", path,
                  "-f", "collocation", "-n", 2)

    def test_written(self):
        path = self.scene(GUIDE)
        text = self.answered("scene", "--scene", path).stdout
        self.unnumbered(text, "scene")
        for words in ("  left.leaf: {from: left.foot, to: left.top, section: steel", "part_of: stage",
                      "  strap: {from: peak, to: stage", "  push: {force", "about: travel"):
            self.assertIn(words, text)
        self.same_again(path, "-f", "collocation", "-n", 2)

    def test_written_weight(self):
        """A node that has the name of a member, and a load that came to several."""
        both = GUIDE.replace("peak", "brace_1").replace("0.2, 0]}", "0.2, 0], mass: 0.1}") + "omit: all\n"
        weight = both.replace("push: {force: [0, 1e-3, 0], on: stage}", "load_1: {gravity: [0, 1e-3, 0], on: all}").replace(
            "shear_modulus: 77e9}", "shear_modulus: 77e9, density: 7800}")
        self.same_again(self.scene(weight), "-f", "collocation", "-n", 2)

    def test_matrices(self):
        path, folder = self.scene(GUIDE), self.folder / "system"
        self.answered("solve", "--scene", path, "-f", "collocation", "-n", 2, "--matrices", folder)
        self.assertTrue((folder / "travel_station_1/K.mtx").exists())
        names = {}
        for name in ("dofs", "loads", "states"):
            with open(folder / f"{name}.csv", encoding="utf-8") as file:
                names[name] = list(csv.DictReader(file))
        self.assertEqual({r["member"] for r in names["dofs"]}, {"", "left.leaf", "right.leaf", "brace_1", "brace_2"})
        self.assertEqual({r["node"] for r in names["loads"]}, {"stage"})
        self.assertEqual({r["analysis"] for r in names["states"]}, {"", "travel"})

    def test_records(self):
        record = self.record("solve", "--scene", self.scene(GUIDE), "-f", "collocation", "-n", 2)
        self.assertEqual({m["node_name"] for m in record["matrices"]}, {"stage"})

    def test_export(self):
        alone = re.sub(r"springs:\n.*\n", "", GUIDE)
        self.line(2, "node peak: corners of members", "export", "--scene", self.scene(alone), "--to", "calculix")
        free = re.sub(r"members:\n  brace.*\n|  (post|peak).*\n", "", alone).replace("warping: fixed", "warping: free")
        self.line(2, "member left.leaf: its ends warp", "export", "--scene", self.scene(free), "--to", "calculix")


class OfFile(ProgramTest):
    def test_any_file_name(self):
        """What a name cannot have becomes '_', one for each character."""
        text = (ROOT / "cases" / "examples" / "euler_column.yaml").read_text(encoding="utf-8")
        text = "\n".join(line for line in text.splitlines() if not line.startswith("name:"))
        for file, name in (("my-leaf.yaml", "my_leaf"), ("2 blätter.yaml", "scene_2_bl_tter"),
                           (".yaml", "scene_"), ("x" * 60 + ".yaml", "x" * 47)):
            path = self.folder / file
            path.write_text(text, encoding="utf-8")
            self.assertIn(f"\nname: {name}\n", self.answered("scene", "--scene", path).stdout)


if __name__ == "__main__":
    unittest.main()
