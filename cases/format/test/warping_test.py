"""Tests warping conditions in scene files, and curved members."""
import csv
import io
import json
import math
import re
import unittest

from cases.format.test.scene_case import SceneCase, values
from harness.tools.kit.program import run


E, G, IT, IW, LENGTH, TORQUE = 210e9, 81e9, 4e-7, 9e-7, 3.0, 50.0
K = math.sqrt(G * IT / (E * IW))  # [1/m]
SAINT_VENANT = TORQUE * LENGTH / (G * IT)
ONE_HELD = TORQUE / (G * IT) * (LENGTH - math.tanh(K * LENGTH) / K)
BOTH_HELD = TORQUE / (G * IT) * (LENGTH - 2 * math.tanh(K * LENGTH / 2) / K)
# Rotation at midspan of a beam on fork supports under a torque at midspan.
SPAN = TORQUE / (2 * G * IT) * (LENGTH / 2 - math.tanh(K * LENGTH / 2) / K)

HEAD = f"""beamwork: 1
sections:
  beam: {{constants: {{A: 5e-3, Iy: 8e-5, Iz: 6e-6, It: {IT}, Iw: {IW}}}, young: {E}, shear_modulus: {G}}}
  rigid: {{constants: {{A: 1, Iy: 1, Iz: 1, It: 1}}, young: {E}, shear_modulus: {G}}}
  rail: {{channel: {{depth: 0.2, flange: 0.1, flange_thickness: 8e-3, web_thickness: 6e-3}}, young: {E}, shear_modulus: {G}}}
  zed: {{zed: {{depth: 0.2, flange: 0.1, flange_thickness: 8e-3, web_thickness: 6e-3}}, young: {E}, shear_modulus: {G}}}
  post: {{i: {{depth: 0.2, flange: 0.1, flange_thickness: 8e-3, web_thickness: 6e-3}}, young: {E}, shear_modulus: {G}}}
  leaf: {{rectangle: {{width: 0.05, thickness: 5e-4}}, young: {E}, shear_modulus: {G}}}
"""
TWIST = f"""loads:
  twist: {{moment: [{TORQUE}, 0, 0], on: tip}}
analyses: {{run: {{linear: {{}}}}}}
quantities:
  rx: {{displacement: {{analysis: run, node: tip, component: rx}}}}
"""
CANTILEVER = "members: {beam: {from: base, to: tip, section: beam, y: [0, 1, 0]}}\n"
TIP = f"  tip: {{at: [{LENGTH}, 0, 0]"


class WarpingTest(SceneCase):

    def words(self, scene):
        text = self.answered("scene", "--scene", self.scene(HEAD + scene)).stdout
        return [
            re.sub(r"\{shared: (w\d+)\}", r"\1", word)
            for word in re.findall(r"warping: \[(.*?)\](?:[,}] ?[a-z]*|\}$)", text)
        ]

    def twist(self, scene, *options):
        return values(
            self.record("solve", "--scene", self.scene(HEAD + scene), "-n", 16, *options))["rx"]

    def is_twisted(self, scene, expected):
        for formulation in ("collocation", "geometrically_exact"):
            got = self.twist(scene, "-f", formulation)
            self.assertAlmostEqual(got / expected, 1, delta=2e-3, msg=formulation)
        self.assertAlmostEqual(
            self.twist(scene, "-f", "collocation") / expected, 1, delta=1e-6, msg="collocation")

    def test_numbers(self):
        self.assertGreater(SAINT_VENANT, 1.5 * ONE_HELD)
        self.assertGreater(ONE_HELD, 1.5 * BOTH_HELD)

    def test_held(self):
        drives = "motions: {still: {path: [0, 1], value: [0, 0]}}\n"
        for base in ("hold: all", "hold: [all]", "hold: [ux, uy, uz, rx, ry, rz]",
                     "hold: [rz, ry, rx, uz, uy, ux]",
                     "hold: [ux, uy, ry, rz], drive: {uz: still, rx: still}",
                     "drive: {ux: still, uy: still, uz: still, rx: still, ry: still, rz: still}",
                     "hold: [ux, uy, uz], rotation: {vector: [still, still, still]}",
                     "hold: [ux, uy, uz], rotation: {sequence: [{axis: x, angle: still}, {axis: y, "
                     "angle: held}, {axis: z, angle: held}]}",
                     "hold: [ux, uy, uz], rotation: {sequence: [{axis: y, angle: still}]}"):
            with self.subTest(base):
                scene = f"nodes:\n  base: {{at: [0, 0, 0], {base}}}\n{TIP}}}\n{CANTILEVER}"
                self.assertEqual(self.words(scene + drives * ("still" in base)), ["fixed, free"])
                if "drive" not in base and "still" not in base:
                    self.is_twisted(scene + TWIST, ONE_HELD)

    def test_free(self):
        drives = "motions: {still: {path: [0, 1], value: [0, 0]}}\n"
        held = "nodes:\n  base: {at: [0, 0, 0], hold: all}\n"
        for tip in ("", ", mass: 3", ", mass: 3, inertia: [1, 1, 1, 0, 0, 0], centre: [0.1, 0, 0]",
                    ", hold: [ux, uy, uz, ry, rz]", ", hold: [uy, uz, rx, ry, rz]",
                    ", hold: [ux, uy, uz], fork: {axis: [1, 0, 0], web: [0, 0, 1]}",
                    ", hold: [ux, uy, uz], rotation: {sequence: [{axis: x, angle: still}, {axis: y, "
                    "angle: held}, {axis: z, angle: free}]}"):
            with self.subTest(tip):
                scene = f"{held}{TIP}{tip}}}\n{CANTILEVER}"
                self.assertEqual(self.words(scene + drives * ("still" in tip)), ["fixed, free"])
                if "rx" not in tip and "fork" not in tip and "still" not in tip:
                    self.is_twisted(scene + TWIST, ONE_HELD)
        scene = held + TIP + "}\n"
        for word, expected, told in (("free", SAINT_VENANT, "free, free"),
                                     ("[free, fixed]", ONE_HELD, "free, fixed"),
                                     ("fixed", BOTH_HELD, "fixed, fixed")):
            with self.subTest(word):
                said = scene + CANTILEVER.replace("]}", f"], warping: {word}}}")
                self.assertEqual(self.words(said), [told])
                self.is_twisted(said + TWIST, expected)

    def test_released(self):
        base = "nodes:\n  base: {at: [0, 0, 0], hold: all}\n  tip: {at: [3, 0, 0], hold: all}\n"
        for word, told in (("rz", "free"), ("[rx]", "free"), ("[rx, ry, rz]", "free"),
                           ("[ux, ry]", "free"), ("ux", "fixed"), ("[uy, uz]", "fixed")):
            with self.subTest(word):
                self.assertEqual(
                    self.words(base + CANTILEVER.replace("]}", f"], release: {{to: {word}}}}}")),
                    [f"fixed, {told}"])

    def test_tied(self):
        base = "nodes:\n  base: {at: [0, 0, 0], hold: all}\n"
        part = base + "  body: {at: [4, 0, 0]}\n" + TIP + ", part_of: body}\n" + CANTILEVER
        self.assertEqual(self.words(part), ["fixed, fixed"])
        self.is_twisted(part + TWIST.replace("on: tip", "on: body"), BOTH_HELD)
        looked = base + TIP + "}\n  eye: {at: [3, 0.1, 0], part_of: tip}\n" + CANTILEVER
        self.assertEqual(self.words(looked), ["fixed, free"])
        self.is_twisted(looked + TWIST, ONE_HELD)
        hung = looked.replace("nodes:", "springs: {hook: {to: eye, stiffness: [0, 1, 0, 0, 0, 0]}}\nnodes:")
        self.assertEqual(self.words(hung), ["fixed, fixed"])
        both = base + TIP + "}\n  side: {at: [3, 1, 0], part_of: tip}\n  foot: {at: [0, 1, 0], hold: all}\n" + \
            "members:\n  one: {from: base, to: tip, section: beam, y: [0, 1, 0]}\n" + \
            "  two: {from: side, to: foot, section: beam, y: [0, 1, 0]}\n"
        self.assertEqual(self.words(both), ["fixed, fixed", "fixed, fixed"])

    def test_guide(self):
        guide = """nodes:
  base_a: {at: [0, 0, 0], hold: all}
  base_b: {at: [0.06, 0, 0], hold: [ux, uy, uz, ry, rz], drive: {rx: tilt}}
  stage:  {at: [0.03, 0.08, 0], drive: {ux: travel}}
  end_a:  {at: [0, 0.08, 0], part_of: stage}
  end_b:  {at: [0.06, 0.08, 0], part_of: stage}
members:
  leaf_a: {from: base_a, to: end_a, section: thin, y: [1, 0, 0]}
  leaf_b: {from: base_b, to: end_b, section: thin, y: [1, 0, 0]}
motions:
  tilt: {path: [0, 1], value: [0, 0]}
  travel: {path: [0, 1], value: [0, 8e-3]}
analyses:
  stroke: {static: {stations: [1]}}
  support: {compliance: {node: stage, about: stroke}}
quantities: {rx: {stiffness: {analysis: support, component: uz}}}
omit: [trapeze, wagner_torque]
"""
        guide = HEAD.replace("leaf: {rectangle: {width: 0.05, thickness: 5e-4}, young: 210000000000.0, shear_modulus: 81000000000.0",
                             "thin: {rectangle: {width: 0.03, thickness: 3e-4}, given: {Iw: 5.0625e-18}, young: 200e9, shear_modulus: 77e9") + guide

        def across(text):
            return values(self.record("solve", "--scene", self.scene(text), "-n", 2))["rx"]

        self.assertAlmostEqual(across(guide) / 212051, 1, delta=1e-4)
        held, free = (across(guide.replace("y: [1, 0, 0]", f"y: [1, 0, 0], warping: {word}"))
                      for word in ("fixed", "free"))
        self.assertEqual(across(guide), held)
        self.assertAlmostEqual(free / 111916, 1, delta=1e-4)

    def test_parts(self):
        scene = f"""parts:
  arm:
    places: [hub]
    nodes:
      foot: {{at: [0, 0, 0], hold: all}}
      tip: {{at: [{LENGTH}, 0, 0]}}
    members:
      beam: {{from: foot, to: tip, section: beam, y: [0, 1, 0]}}
      stay: {{from: hub, to: tip, section: beam, y: [1, 0, 0]}}
nodes:
  plate: {{at: [{LENGTH}, 2, 0], hold: all}}
instances:
  first: {{part: arm, at: [0, 0, 0], connect: {{hub: plate}}}}
  second: {{part: arm, at: [0, 4, 0], connect: {{hub: plate}}}}
"""
        self.assertEqual(self.words(scene), ["fixed, free"] * 4)

    def test_continued(self):
        base = "nodes:\n  base: {at: [0, 0, 0], hold: all}\n  mid: {at: [1, 0, 0], mass: 2}\n" + TIP + "}\n"
        two = base + "members:\n  one: {from: base, to: mid, section: SECTION, y: [0, 1, 0]}\n" + \
            "  two: {from: mid, to: tip, section: SECTION, y: [0, 1, 0]}\n"
        beam = two.replace("SECTION", "beam")
        self.assertEqual(self.words(beam), ["fixed, w0", "w0, free"])
        self.is_twisted(beam + TWIST, ONE_HELD)
        fork = "hold: [ux, uy, uz], fork: {axis: [1, 0, 0], web: [0, 0, 1]}"
        span = f"nodes:\n  left: {{at: [0, 0, 0], {fork}}}\n  tip: {{at: [{LENGTH / 2}, 0, 0]}}\n" + \
            f"  right: {{at: [{LENGTH}, 0, 0], {fork.replace('ux, ', '')}}}\nmembers:\n" + \
            "  one: {from: left, to: tip, section: beam, y: [0, 1, 0]}\n" + \
            "  two: {from: tip, to: right, section: beam, y: [0, 1, 0]}\n"
        self.assertEqual(self.words(span), ["free, w0", "w0, free"])
        self.is_twisted(span + TWIST, SPAN)
        self.assertEqual(self.words(beam.replace("mass: 2", fork)), ["fixed, w0", "w0, free"])
        corner = beam.replace("at: [3.0, 0, 0]", "at: [1, 3, 0]").replace(
            "tip, section: beam, y: [0, 1, 0]", "tip, section: beam, y: [1, 0, 0]")
        third = beam.replace("members:\n", "  side: {at: [1, 1, 0]}\nmembers:\n"
                             "  leg: {from: mid, to: side, section: beam, y: [1, 0, 0]}\n")
        for scene, told in ((corner, ["fixed, free", "free, free"]),
                            (third, ["free, free", "fixed, free", "free, free"]),
                            (two.replace("SECTION", "beam", 1).replace("SECTION", "post"),
                             ["fixed, free", "free, free"]),
                            (beam.replace("y: [0, 1, 0]}", "y: [0, 0, 1]}", 1),
                             ["fixed, free", "free, free"]),
                            (beam.replace("y: [0, 1, 0]}", "y: [0, 1, 0], release: {to: ry}}", 1),
                             ["fixed, free", "free, free"]),
                            (beam.replace("y: [0, 1, 0]}", "y: [0, 1, 0], warping: fixed}", 1),
                             ["fixed, fixed", "free, free"]),
                            (beam.replace("y: [0, 1, 0]}", "y: [0, 1, 0], curvature: [0, 0, 1e-3]}",
                                          1), ["fixed, free", "free, free"])):
            with self.subTest(scene):
                self.assertEqual(self.words(scene), told)

    def test_towards(self):
        two = "nodes:\n  base: {at: [0, 0, 0], hold: all}\n  mid: {at: [1, 0, 0]}\n" + TIP + "}\n" + \
            "members:\n  one: {from: base, to: mid, section: SECTION, y: [0, 1, 0]}\n" + \
            "  two: {from: tip, to: mid, section: SECTION, y: Y}\n"
        for section, y, is_one in (("leaf", "[0, 1, 0]", True), ("leaf", "[0, -1, 0]", True),
                                   ("post", "[0, 1, 0]", True), ("rail", "[0, 1, 0]", True),
                                   ("rail", "[0, -1, 0]", False), ("zed", "[0, 1, 0]", False),
                                   ("zed", "[0, -1, 0]", False), ("beam", "[0, 1, 0]", False)):
            with self.subTest(section + y):
                scene = two.replace("SECTION", section).replace("Y}", y + "}")
                self.assertEqual(
                    self.words(scene), ["fixed, w0", "free, w0"] if is_one else
                    ["fixed, free", "free, free"])
                if is_one:
                    same = scene.replace("from: tip, to: mid", "from: mid, to: tip")
                    self.assertAlmostEqual(
                        self.twist(scene + TWIST, "-f", "geometrically_exact") /
                        self.twist(same.replace(y + "}", "[0, 1, 0]}") + TWIST, "-f",
                                   "geometrically_exact"),
                        1,
                        delta=1e-9)

    def test_told(self):
        torsion = HEAD + "nodes:\n  base: {at: [0, 0, 0], hold: all}\n" + TIP + "}\n" + CANTILEVER
        ends = "held at base; free at tip"
        scene = self.scene(torsion + TWIST)
        done = run("solve", "--scene", scene)
        self.assertIn(f"\nwarping: {ends}\n", done.stdout)
        self.assertEqual(done.stderr, "")
        record = json.loads(run("solve", "--scene", scene, "--format", "json").stdout)
        self.assertEqual(record["cell"]["warping"], ends)
        # no warning if the warping condition is given or has no effect
        for text, words in ((torsion.replace("]}", "], warping: [fixed, free]}", 3) + TWIST, ends),
                            (torsion + TWIST.replace(f"[{TORQUE}, 0, 0]", "[0, 0, 0]"), ends),
                            (torsion + TWIST.replace("moment", "force"), ends),
                            (torsion.replace("section: beam", "section: rigid") + TWIST, "")):
            text = text.replace("tip: {at: [3.0, 0, 0], warping: [fixed, free]}",
                                "tip: {at: [3.0, 0, 0]}")
            done = run("solve", "--scene", self.scene(text), "-n", 2)
            self.assertEqual(done.stderr, "", text)
            self.assertEqual("\nwarping: " + words + "\n" in done.stdout, words != "")
            self.assertEqual("\nwarping: " in done.stdout, words != "")

    def test_told_at_members(self):
        scene = HEAD + "nodes:\n  base: {at: [0, 0, 0], hold: all}\n" + TIP + "}\n  side: {at: [3, 2, 0]}\n" + \
            "members:\n  beam: {from: base, to: tip, section: post, y: [0, 1, 0], warping: free}\n" + \
            "  leg: {from: tip, to: side, section: post, y: [1, 0, 0], warping: fixed}\n" + TWIST
        done = run("solve", "--scene", self.scene(scene), "-n", 1)
        self.assertIn("\nwarping: held at leg at tip, side; free at base, beam at tip\n", done.stdout)
        many = HEAD + "nodes:\n  base: {at: [0, 0, 0], hold: all}\n" + TIP + "}\n" + \
            "  end_$i: {for: {i: 0..19}, at: [3, 1 + i, 1], hold: all}\nmembers:\n" + \
            "  beam: {from: base, to: tip, section: post, y: [0, 1, 0]}\n" + \
            "  leg_$i: {for: {i: 0..19}, from: tip, to: end_$i, section: post, y: [1, 0, 0]}\n" + TWIST
        done = run("solve", "--scene", self.scene(many), "-n", 1)
        self.assertRegex(" ".join(done.stdout.split()),
                         r"warping: held at base, end_0, .*, end_6 and 13 more; free at tip quantity")

    def test_written(self):
        for base in ("hold: all", "hold: [ux, uy, uz, rx]"):
            scene = f"nodes:\n  base: {{at: [0, 0, 0], {base}}}\n{TIP}, hold: [uy, uz]}}\n{CANTILEVER}"
            self.same_again(self.scene(HEAD + scene + TWIST), "-n", 3)


GUIDE = """beamwork: 1
sections:
  leaf: {rectangle: {width: 30e-3, thickness: 0.3e-3}, young: 200e9, shear_modulus: 77e9}
nodes:
  base_a: {at: [0, 0, 0], hold: all}
  base_b: {at: [0.06, 0, 0], hold: all}
  stage: {at: [0.03, 0.08, 0], drive: {ux: travel}}
  end_a: {at: [0, 0.08, 0], part_of: stage}
  end_b: {at: [0.06, 0.08, 0], part_of: stage}
members:
  leaf_a: {from: base_a, to: end_a, section: leaf, y: [1, 0, 0], warping: fixed}
  leaf_b: {from: base_b, to: end_b, section: leaf, y: [1, 0, 0], warping: fixed}
motions:
  travel: {unit: m, path: [0, 1, 2], value: [0, -8e-3, 8e-3]}
analyses:
  stroke: {static: {stations: 1..2/STATIONS}}
  support: {compliance: {node: stage, about: stroke}}
  other: {linear: {}}
quantities:
  place: {displacement: {analysis: stroke, node: stage, component: ux, take: curve}, unit: mm, factor: 1000}
  force: {reaction: {analysis: stroke, node: stage, component: ux, take: curve}, x: {quantity: place}}
  k_z: {stiffness: {analysis: support, component: uz, take: curve}, x: {quantity: place}}
  k_y: {stiffness: {analysis: support, component: uy, take: curve}}
  k_end: {stiffness: {analysis: support, component: uz}}
meshes: [1, 2, 4]
"""
FEW, MANY = GUIDE.replace("STATIONS", "20"), GUIDE.replace("STATIONS", "100")
WHERE = ("-f", "collocation", "-n", 2)


def curves(record):
    return {c["quantity"]: c for c in record["curves"]}


class CurvesTest(SceneCase):

    def rows(self, text):
        return list(csv.DictReader(io.StringIO(text)))

    def test_abscissa(self):
        found = curves(self.record("solve", "--scene", self.scene(FEW), *WHERE))
        places = found["place"]["curve_value"]
        self.assertEqual(len(places), 21)
        for name in ("force", "k_z"):
            self.assertEqual(found[name]["curve_x"], places)
            self.assertEqual((found[name]["x_name"], found[name]["x_unit"]), ("place", "mm"))
        self.assertAlmostEqual(places[0], -8, delta=1e-9)
        self.assertEqual(found["k_y"]["x_name"], "path")
        self.same_again(self.scene(FEW), *WHERE)

    def test_csv(self):
        found = curves(self.record("solve", "--scene", self.scene(MANY), *WHERE))
        rows = self.rows(self.answered("solve", "--scene", self.scene(MANY), *WHERE, "--format", "csv").stdout)
        for name, curve in found.items():
            mine = [r for r in rows if r["quantity"] == name]
            self.assertEqual([float(r["x"]) for r in mine], curve["curve_x"])
            self.assertEqual([float(r["value"]) for r in mine], curve["curve_value"])
            self.assertEqual({(r["x_name"], r["x_unit"]) for r in mine}, {(curve["x_name"], curve["x_unit"])})
        self.assertEqual(len([r for r in rows if r["quantity"] == "k_end"]), 1)
        rows = self.rows(self.answered("converge", "--scene", self.scene(FEW), "-f", "collocation",
                                       "--format", "csv").stdout)
        self.assertEqual(len([r for r in rows if r["quantity"] == "force"]), 3*21)

    def test_text(self):
        text = self.answered("solve", "--scene", self.scene(FEW), *WHERE).stdout
        lines = [line.split() for line in text.splitlines()]
        at = lines.index(["place", "[mm]", "force", "[N]", "k_z", "[N/m]", "stable"])
        table = [[float(x) for x in line[:3]] for line in lines[at + 1:at + 22]]
        self.assertEqual([row[0] for row in table], sorted(row[0] for row in table))
        self.assertAlmostEqual(table[10][0], 0)
        self.assertAlmostEqual(table[10][1], 0)
        many = self.answered("solve", "--scene", self.scene(MANY), *WHERE).stdout
        self.assertIn("20 of 101 points; --format csv and json contain all points", many)
        self.assertLess(len(many.splitlines()), 120)

    def test_largest_error(self):
        path = self.scene(FEW)
        value = {n: curves(self.record("solve", "--scene", path, "-f", "beamw", "-n", n))["k_z"]["curve_value"]
                 for n in (1, 2, 4)}
        size = max(map(abs, value[4]))
        text = self.answered("converge", "--scene", path, "-f", "beamw", "-f", "collocation").stdout
        block = text[text.index("k_z [N/m] over place [mm], largest error over the curve"):]
        line = next(line for line in block.splitlines() if line.startswith("  beamw "))
        shown = [float(x) for x in line.replace("%", "").split()[1:3]]
        for n, percent in zip((1, 2), shown):
            error = 100*max(abs(a - b) for a, b in zip(value[n], value[4]))/size
            self.assertAlmostEqual(percent, error, delta=1e-3*error + 1e-4)
        self.assertRegex(block, r"\n +n +.*  from collocation\n")
        record = self.record("converge", "--scene", path, "-f", "beamw", "-f", "collocation")
        found, = (c for c in record["series"][0]["curves"] if c["quantity"] == "k_z")
        self.assertEqual((found["x_name"], found["x_unit"], found["reference"]), ("place", "mm", "collocation"))
        for mesh in found["meshes"]:
            n = mesh["elements"]
            error = max(abs(a - b) for a, b in zip(value[n], value[4]))/size
            self.assertAlmostEqual(mesh["error"], error, delta=1e-9 + 1e-9*error)
        last = record["series"][1]["curves"]
        self.assertTrue(all(c["reference_error"] == 0 for c in last))
        self.assertIn("place [mm]: the same curve on all meshes", text)

    def test_chosen(self):
        text = self.answered("converge", "--scene", self.scene(FEW), "-f", "collocation", "-k", "force").stdout
        self.assertIn("force [N] over place [mm]", text)

    def test_refusals(self):
        for before, behind, words in (
                ("x: {quantity: place}}\n  k_z", "x: {quantity: k_end}}\n  k_z", "must be another quantity with take: curve"),
                ("x: {quantity: place}}\n  k_z", "x: {quantity: plane}}\n  k_z", "did you mean 'place'"),
                ("x: {quantity: place}}\n  k_z", "x: {quantity: place, factor: 2}}\n  k_z", "uses the factor of"),
                ("x: {quantity: place}}\n  k_z", "x: {quantity: force}}\n  k_z", "must be another quantity"),
                ("x: {quantity: place}}\n  k_z", "x: {quantity: away}}\n  k_z", "belongs to another path")):
            self.assertIn(before, FEW)
            text = FEW.replace(before, behind).replace("quantities:", """  second: {static: {stations: 1..2/20}}
quantities:
  away: {displacement: {analysis: second, node: stage, component: ux, take: curve}}""")
            self.refused(2, words, "solve", "--scene", self.scene(text))


if __name__ == "__main__":
    unittest.main()
