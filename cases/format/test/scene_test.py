"""Tests the form of scene files: names, parameters, errors, parts and instances."""
import csv
import json
import math
import re
import unittest

import numpy as np

from cases.format.test.scene_case import EXAMPLES, SceneCase, values
from harness.tools.kit.program import ProgramTest, ROOT, run
from harness.tools.kit.scenes import LEAF, bad_scenes


GOOD = ROOT / "cases/format/test/good"
PART = {"hexapod_motion": ("--set", "time=0.05")}


class SceneTest(SceneCase):

    def test_bad_files(self):
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
        path = self.folder / "several_mistakes.yaml"
        path.write_text(dict(bad_scenes())[path.stem], encoding="utf-8")
        done = self.answered("scene", "--scene", path, "--format", "json", code=2)
        told = json.loads(done.stdout)
        self.assertEqual([(m["line"], m["column"]) for m in told["mistakes"]], [(15, 55), (19, 49),
                                                                                (33, 53), (34, 65)])
        self.assertEqual((told["file"], told["more"]), (str(path), 0))

    def test_unknown_parameter(self):
        path = self.scene(LEAF)
        self.refused(2, f"'beamwork list --scene {path}' shows the names", "solve", "--scene", path,
                     "--set", "force=3")
        self.answered("list", "--scene", path)

    def test_first_scene(self):
        path = self.scene(LEAF)
        record = self.record("solve", "--scene", path, "-f", "collocation", "-n", 1)
        area, inertia = 50e-3 * 0.5e-3, 50e-3 * 0.5e-3 ** 3 / 12
        exact = 0.1 ** 3 / (3 * 210e9 * inertia) + 0.1 / (5 / 6 * 81e9 * area)
        self.assertAlmostEqual(values(record)["tip_uy"] / exact, 1, delta=1e-9)

    def test_bytes(self):
        own = self.answered("scene", "--scene", self.scene(LEAF)).stdout
        for name, text in (("ends", LEAF.replace(
                "\n", "\r\n")), ("mark", "\ufeff" + LEAF), ("letters", LEAF + "# Größe – 大きさ\n")):
            path = self.folder / "scene.yaml"
            path.write_bytes(text.encode())
            self.assertEqual(self.answered("scene", "--scene", path).stdout, own, name)

    def test_same_bits(self):
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
        for path in sorted(EXAMPLES.glob("*.yaml")):
            once = self.answered("scene", "--scene", path).stdout
            self.assertEqual(self.answered("scene", "--scene", self.scene(once)).stdout, once)

    def test_everything(self):
        for path in sorted(GOOD.glob("*.yaml")):
            written = path.with_suffix(".written").read_text(encoding="utf-8")
            self.assertEqual(self.answered("scene", "--scene", path).stdout, written)
            again = self.answered("scene", "--scene", self.scene(written)).stdout
            self.assertEqual(again, written)

    def test_needs_of_earlier_versions(self):
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
            self.assertEqual(done.stderr, f"beamwork: {path}: 'needs' is read as in earlier versions; "
                             f"instead write {' and '.join(lines)}\n")
            again = self.scene(done.stdout)
            self.assertEqual(self.answered("scene", "--scene", again).stdout, done.stdout)

    def test_parameters(self):
        where = ("solve", "--scene", EXAMPLES / "leaf_spring_guide.yaml", "-f", "collocation", "-n",
                 1)
        got = values(self.record(*where, "--set", "width=0.1"))
        self.assertAlmostEqual(got["k_support"] / 2.1e8, 1, delta=1e-12)
        self.refused(2, "outside its range", *where, "--set", "width=100")
        self.refused(2, "did you mean 'width'", *where, "--set", "wdth=0.1")

    def test_truths_of_a_point(self):
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
        self.assertIn("1 verdict against reference values: 1 pass", done.stdout)

    def test_refusals(self):
        self.refused(4, "cannot be read", "solve", "--scene", self.folder / "none.yaml", "-f",
                     "beamw", "-n", 1)
        self.refused(2, "give only one of them", "solve", "elastica", "--scene", self.scene(LEAF), "-f",
                     "beamw", "-n", 1)
        path = self.scene(LEAF)
        self.refused(2, "which is an input", "converge", "--scene", path, "-f", "beamw", "-o", path)
        self.assertEqual(path.read_text(encoding="utf-8"), LEAF)

    def test_schema(self):
        schema = json.loads(self.answered("scene", "--schema").stdout)
        self.assertEqual(schema["required"], ["beamwork", "sections"])
        member = schema["properties"]["members"]["additionalProperties"]
        self.assertEqual(member["required"], ["from", "to", "section", "y"])
        self.assertIn("for", member["properties"])

    def test_list_of_keys(self):
        listed = {
            line.split()[0]
            for line in self.answered("scene", "--keys").stdout.splitlines() if line.strip()
        }
        schema = json.loads(self.answered("scene", "--schema").stdout)
        self.assertLessEqual(set(schema["properties"]), listed)
        for path in EXAMPLES.glob("*.yaml"):
            used = set(re.findall(r"^([a-z]+):", path.read_text(encoding="utf-8"), re.M))
            self.assertLessEqual(used, set(schema["properties"]))

    def test_summaries_say_more_than_keys(self):
        self.assertEqual(re.findall(r"^ *(\w+) +(?:NAME|TEXT|EXPR|\.\.\.) +\1(?: \[| \*|$)",
                                    self.answered("scene", "--keys").stdout, re.M), [])


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

WRONG = [
    ("hold: all}\n      top: {at: [0, 0.08, 0]", "hold: all}\n      top: {at: [0, 0, 0]",
     "left.leaf: its ends coincide"),
    ("from: peak, to: stage, st", "from: peak, to: peak, st", "strap: both ends are at node peak"),
    ("stiffness: [1, 1, 1, 0", "stiffness: [1, -1, 1, 0", "strap: its stiffness"),
    ("[0, 1e-3, 0], on: stage", "[0, 1/0, 0], on: stage", "division by zero"),
    ("{force: [0, 1e-3, 0], on: stage}", "{distributed: [0, 1, 0], on: brace_2, axes: member, follower: yes}\n"
     "  wind: {moment: [0, 0, 1], on: peak, at: [1, 0, 0]}", "wind: only forces act at an offset"),
    ("stations: [0.5, 1]", "stations: [1, 0.5]", "travel: the stations must ascend"),
    ("peak: {at: [1.5, 0.2, 0]}", "peak: {at: [1.5, 0.2, 0], mass: -1}", "mass = -1; give at least 0"),
]


class NamesTest(SceneCase):

    def unnumbered(self, text, what):
        self.assertIsNone(NUMBERED.search(text), (what, NUMBERED.search(text)))

    def line(self, code, words, *arguments):
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
        self.line(1, "neither node cloud at (5, 5, 0) nor any part joined to it is supported", "solve", "--scene", path,
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
        self.line(2, "node peak: a node at which several members end", "export", "--scene", self.scene(alone), "--to", "calculix")
        free = re.sub(r"members:\n  brace.*\n|  (post|peak).*\n", "", alone).replace("warping: fixed", "warping: free")
        self.line(2, "member left.leaf: the ends of the member can warp", "export", "--scene", self.scene(free), "--to", "calculix")


class OfFile(ProgramTest):
    def test_any_file_name(self):
        text = (ROOT / "cases" / "examples" / "euler_column.yaml").read_text(encoding="utf-8")
        text = "\n".join(line for line in text.splitlines() if not line.startswith("name:"))
        for file, name in (("my-leaf.yaml", "my_leaf"), ("2 blätter.yaml", "scene_2_bl_tter"),
                           (".yaml", "scene_"), ("x" * 60 + ".yaml", "x" * 47)):
            path = self.folder / file
            path.write_text(text, encoding="utf-8")
            self.assertIn(f"\nname: {name}\n", self.answered("scene", "--scene", path).stdout)


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
        given = [word for one in assignments for word in ("--set", one)]
        text = self.answered("scene", "--scene", self.scene(CHOSEN), *given).stdout
        loads = text[text.index("loads:"):text.index("analyses:")].split()[1:]
        ends = {line.split(":")[0]: line for line in text.splitlines() if line[:4] in ("omit", "mesh")}
        return " ".join(loads), ends["omit"], ends["meshes"]

    def test_values_choose(self):
        self.assertEqual(self.written(),
                         ("push_1: {force: [0, 1.5, 0], on: tip} push_2: {force: [0, 1.5, 0], on: tip}",
                          "omit: [shear, trapeze]", "meshes: [1, 2]"))
        self.assertEqual(self.written("load=root_side", "shear=1"),
                         ("push: {force: [0, 3, 0], on: middle}", "omit: [trapeze]",
                          "meshes: [1, 2, 4]"))
        self.assertIn("force: [0, 5, 0]", self.written("size=20")[0])
        self.assertIn("force: [0, 2.5, 0]", self.written("size=20", "shear=1")[0])

    def test_refused(self):
        path = self.scene(CHOSEN)
        self.refused(2, f"{path}:11:49: size = 12.5 N on the root's side; give less than 10 N", "solve",
                     "--scene", path, "--set", "load=root_side", "--set", "size=12.5")
        self.refused(2, "shear", "solve", "--scene", path, "--set", "shear=0.5")


# An instance of a part, and the same members, springs and supports written explicitly.

PLACED = """\
beamwork: 1
sections:
  leaf: {rectangle: {width: 50e-3, thickness: 0.5e-3}, young: 210e9, shear_modulus: 81e9}
nodes:
  tip: {at: [0, 0, 0.1]}
parts:
  arm:
    places: [end]
    nodes: {root: {at: [0, 0, 0], hold: all}}
    members: {leaf: {from: root, to: end, section: leaf, y: [0, 1, 0]}}
instances:
  one: {part: arm, at: [0, 0, 0], axes: {x: [0, 0, 2], z: [0, -1, 0]}, connect: {end: tip}}
loads:
  push: {force: [1, 0, 0], on: tip}
"""


class PartsTest(SceneCase):

    def test_instance_by_axes(self):
        got = values(self.record("solve", "--scene", self.scene(PLACED), "-f", "collocation",
                                 "-n", 1))
        own = values(self.record("solve", "--scene", self.scene(LEAF), "-f", "collocation", "-n",
                                 1))
        self.assertAlmostEqual(abs(got["tip_ux"]) / own["tip_uy"], 1, delta=1e-12)

    def test_springs_of_a_part(self):
        turn, a = 0.4, [3e3, 1e3, 2e3, 4.0, 5.0, 6.0]
        c, s = math.cos(turn), math.sin(turn)
        R = np.kron(np.eye(2), [[c, -s, 0], [s, c, 0], [0, 0, 1]])
        K = R @ (np.diag(a) + 0.1*np.ones((6, 6))) @ R.T
        def numbers(matrix):
            return ", ".join(repr(float(x)) for x in ((matrix + matrix.T) / 2).ravel())
        placed = PLACED.replace("parts:", f"""parts:
  bearing: {{places: [at], springs: {{s: {{to: at, stiffness: [{numbers(np.diag(a) + 0.1*np.ones((6, 6)))}]}}}}}}
  pair:
    places: [at]
    nodes: {{own: {{at: [0, 0, 0]}}}}
    springs: {{s: {{from: at, to: own, stiffness: [{numbers(np.array(a))}]}}}}""").replace("instances:", f"""instances:
  b: {{part: bearing, at: [0, 0, 0.1], turn: {{z: {turn}}}, connect: {{at: tip}}}}
  p: {{part: pair, at: [0, 0, 0.1], turn: {{z: {turn}}}, connect: {{at: tip}}}}""") + "  pull: {force: [0.5, 1, 2], on: p.own}\n"
        plain = PLACED.replace("parts:", "  own: {at: [0, 0, 0.1]}\nparts:").replace("loads:", f"""springs:
  b: {{to: tip, stiffness: [{numbers(K)}]}}
  p: {{from: tip, to: own, stiffness: [{numbers(R @ np.diag(a) @ R.T)}]}}
loads:""") + "  pull: {force: [0.5, 1, 2], on: own}\n"
        where = ("-f", "collocation", "-n", 2)
        got = self.same_again(self.scene(placed, "placed.yaml"), *where)
        own = values(self.record("solve", "--scene", self.scene(plain, "plain.yaml"), *where))
        for name, value in own.items():
            self.assertAlmostEqual(got[name.replace("own", "p.own")] / value, 1, delta=1e-9, msg=name)
        self.assertGreater(min(map(abs, own.values())), 1e-9)

    def test_components_of_a_turned_part(self):
        part = PLACED.replace("hold: all", "hold: [uy, uz, rx, ry, rz], drive: {ux: pushed}").replace(
            "loads:", "motions:\n  pushed: {unit: m, path: [0, 1], value: [0, 1e-3]}\nloads:")
        where = ("-f", "collocation", "-n", 1)
        got = self.same_again(self.scene(part, "part.yaml"), *where)
        plain = LEAF.replace("hold: all", "hold: [uy, uz, rx, ry, rz], drive: {ux: pushed}").replace(
            "loads:", "motions:\n  pushed: {unit: m, path: [0, 1], value: [0, 1e-3]}\nloads:")
        self.assertNotEqual(plain, LEAF)
        own = values(self.record("solve", "--scene", self.scene(plain), *where))
        self.assertAlmostEqual(got["tip_uz"], 1e-3, delta=1e-4)
        self.assertAlmostEqual(got["tip_uz"] / own["tip_ux"], 1, delta=1e-9)
        back = self.same_again(self.scene(part.replace("x: [0, 0, 2]", "x: [0, 0, -2]"), "back.yaml"), *where)
        self.assertLess(back["tip_uz"] * got["tip_uz"], 0)


if __name__ == "__main__":
    unittest.main()
