"""Tests the examples and scenes with closed-form solutions."""
import json
import pathlib
import re
import unittest

from cases.format.test.scene_case import EXAMPLES, SceneCase, values
from harness.tools.kit.program import ProgramTest, ROOT
from harness.tools.kit.scenes import LEAF



SHAPES = """\
beamwork: 1
parameters: {h: {value: 0.2, unit: m}}
let: {E: 210e9, G: 81e9}
sections:
  zed:  {zed: {depth: h, flange: 0.06, flange_thickness: 3e-3, web_thickness: 3e-3}, young: E, shear_modulus: G}
  rail: {channel: {depth: h, flange: 0.06, flange_thickness: 6e-3, web_thickness: 4e-3}, given: {Iw: 1e-8}, young: E, shear_modulus: G}
  tri_$i: {for: {i: 1..2}, points: {a: [0, 0], b: [0.1, 0], c: [0, 0.05]}, cells: 1, walls: [{from: a, to: b, thickness: i*1e-3}, {from: b, to: c, thickness: i*1e-3}, {from: c, to: a, thickness: i*1e-3}], young: E, shear_modulus: G}
  pipe: {tube: {diameter: 0.05, thickness: 3e-3}, young: E, shear_modulus: G}
  hollow: {box: {depth: h, flange: 0.1, flange_thickness: 3e-3, web_thickness: 3e-3}, young: E, shear_modulus: G}
  beam: {i: {depth: h, flange: 0.1, flange_thickness: 6e-3, web_thickness: 4e-3}, thickness_terms: yes, young: E, shear_modulus: G}
  leg:  {angle: {along_z: 0.08, along_y: 0.05, thickness: 4e-3}, young: E, shear_modulus: G}
nodes:
  n_0: {at: [-1, 0, 0], hold: all}
  n_1: {at: [rail.ey + rail.yc, pipe.It*1e6, tri_2.It*1e6]}
  n_$i: {for: {i: 2..6}, at: [i, 0, 0]}
members:
  a: {from: n_0, to: n_1, section: zed, y: [0, 1, 0]}
  b: {from: n_1, to: n_2, section: rail, y: [0, 1, 0]}
  c: {from: n_2, to: n_3, section: tri_1, y: [0, 1, 0]}
  d: {from: n_3, to: n_4, section: pipe, y: [0, 1, 0]}
  e: {from: n_4, to: n_5, section: hollow, y: [0, 1, 0]}
  f: {from: n_5, to: n_6, section: beam, y: [0, 1, 0]}
loads:
  push: {force: [0, rail.Iy*1e6, 1], on: n_6}
"""


class ContentsTest(SceneCase):
    LOADS = """\
beamwork: 1
sections:
  bar: {rectangle: {width: 0.05, thickness: 0.02}, young: 1e9, shear_modulus: 4e8, density: 900}
nodes:
  base: {at: [0, 0, 0], hold: all}
  tip:  {at: TIP}
members:
  bar: {from: base, to: tip, section: bar, y: Y}
loads:
  push:   {force: FORCE, on: tip, at: AT, follower: true}
  turn:   {moment: TURN, on: tip, follower: true, path: [0], factor: [1]}
  wind:   {distributed: [1, 20, 3], on: bar, axes: member, at: [0, 0.01, 0.02], follower: yes}
  twist:  {distributed_moment: [2, 0.3, 0.4], on: bar, axes: member}
  weight: {gravity: GRAVITY, on: bar}
analyses:
  path: {static: {stations: [0.5, 1]}}
quantities:
  along:  {displacement: {analysis: path, node: tip, component: X}, unit: m}
  across: {displacement: {analysis: path, node: tip, component: Z}, unit: m}
omit: [wagner_torque]
"""

    def loads(self, name, **words):
        text = self.LOADS
        for key, word in words.items():
            text = re.sub(rf"\b{key}\b", word, text)
        return self.scene(text, name)

    def test_loads(self):
        first = self.loads("first.yaml", TIP="[1, 0, 0]", Y="[0, 1, 0]", FORCE="[1, 2, 3]", AT="[0.1, 0.2, 0.3]", TURN="[0, 4, 1]",
                           GRAVITY="[0, 0, -9.81]", X="ux", Z="uz")
        turned = self.loads("turned.yaml", TIP="[0, 1, 0]", Y="[0, 0, 1]", FORCE="[3, 1, 2]", AT="[0.3, 0.1, 0.2]", TURN="[1, 0, 4]",
                            GRAVITY="[-9.81, 0, 0]", X="uy", Z="ux")
        again = self.scene(self.answered("scene", "--scene", first).stdout, "again.yaml")
        for formulation in ("collocation", "beamw"):
            result = [values(self.record("solve", "--scene", path, "-f", formulation, "-n", 3)) for path in (first, again, turned)]
            self.assertEqual(result[0], result[1])
            for quantity, value in result[0].items():
                self.assertAlmostEqual(value, result[2][quantity], delta=1e-11)
                self.assertGreater(abs(value), 1e-4)

    def test_shapes(self):
        path = self.scene(SHAPES, "shapes.yaml")
        text = self.answered("scene", "--scene", path).stdout
        again = self.scene(text, "again.yaml")
        self.assertEqual(self.answered("scene", "--scene", again).stdout, text)
        where = ("-f", "collocation", "-n", 1)
        once, twice = (values(self.record("solve", "--scene", p, *where)) for p in (path, again))
        self.assertEqual(once, twice)
        # shear centre of a channel at e = 3 b^2 t_f/(h t_w + 6 b t_f) from its web, with mid-line dimensions
        height, width, flange, web = 0.2, 0.06, 6e-3, 4e-3
        centre = 3*width**2*flange/(height*web + 6*width*flange)
        ring = (0.05**4 - 0.044**4)*3.141592653589793/32
        tri = 4*(0.1*0.05/2)**2*2e-3/(0.15 + 0.0125**0.5) + (0.15 + 0.0125**0.5)*8e-9/3
        at = [float(x) for x in re.search(r"n_1: \{at: \[([^]]*)", text).group(1).split(",")]
        for got, exact in zip(at, (centre, ring*1e6, tri*1e6)):
            self.assertAlmostEqual(got/exact, 1, delta=1e-12)

    INTERNAL = """\
beamwork: 1
sections:
  rail: {channel: {depth: 0.1, flange: 0.05, flange_thickness: 3e-3, web_thickness: 2e-3}, young: 210e9, shear_modulus: 81e9}
nodes:
  base: {at: [0, 0, 0], hold: all}
  tip: {at: [2, 0, 0]}
members:
  bar: {from: base, to: tip, section: rail, y: [0, 1, 0], warping: [fixed, free]}
loads:
  push: {force: [5, 0.7, 0.3], on: tip}
  torque: {moment: [1, 0, 0], on: tip}
  wind: {distributed: [0, 0, 0.2], on: bar}
analyses:
  linear: {linear: {}}
quantities:
  ${r}_$e: {for: {r: [N, Qy, Qz, Mx, My, Mz, bimoment], e: [from, to]}, internal: {analysis: linear, member: bar, end: $e, resultant: $r}}
  ${r}_at_$p: {for: {r: [Qy, Qz, Mx, My, bimoment, Mx_saint_venant, Mx_warping], p: 0..1}, internal: {analysis: linear, member: bar, where: 1/4 + p/2, resultant: $r}}
  ${r}_$a: {for: {r: [My, Qz], a: [max, min, largest]}, internal: {analysis: linear, member: bar, along: $a, resultant: $r}}
  ys: {internal: {analysis: linear, member: bar, end: to, resultant: N}, unit: m, factor: rail.ys/5}
  zs: {internal: {analysis: linear, member: bar, end: to, resultant: N}, unit: m, factor: rail.zs/5}
"""

    def test_internal(self):
        path = self.scene(self.INTERNAL, "internal.yaml")
        exact = {"N": (5, 5), "Qy": (0.7, 0.7), "Qz": (0.7, 0.3), "Mx": (1, 1), "My": (-1, 0), "Mz": (1.4, 0)}
        for formulation in ("collocation", "geometrically_exact", "beamw", "beamw_consistent"):
            for elements in (1, 3):
                got = values(self.record("solve", "--scene", path, "-f", formulation, "-n", elements))
                for name, ends in exact.items():
                    for end, value in zip(("from", "to"), ends):
                        self.assertAlmostEqual(got[f"{name}_{end}"], value, delta=1e-10)
                self.assertAlmostEqual(got["bimoment_to"], 0, delta=1e-10)
                for place, b in ((0, 1.5), (1, 0.5)):
                    inside = {"Qy": 0.7, "Qz": 0.3 + 0.2*b, "Mx": 1, "My": -0.3*b - 0.1*b*b}
                    for name, value in inside.items():
                        self.assertAlmostEqual(got[f"{name}_at_{place}"], value, delta=1e-10)
                    self.assertAlmostEqual(got[f"Mx_saint_venant_at_{place}"] + got[f"Mx_warping_at_{place}"] +
                                           got["ys"]*inside["Qz"] - got["zs"]*inside["Qy"], 1, delta=1e-9)
                for name, value in {"My_max": 0, "My_min": -1, "My_largest": 1, "Qz_max": 0.7, "Qz_min": 0.3}.items():
                    self.assertAlmostEqual(got[name], value, delta=1e-10)
        again = self.scene(self.answered("scene", "--scene", path).stdout, "again.yaml")
        self.assertEqual(values(self.record("solve", "--scene", again, "-f", formulation, "-n", 3)), got)

    STRESS = """\
beamwork: 1
sections:
  box: {box: {depth: 0.1, flange: 0.06, flange_thickness: 2e-3, web_thickness: 3e-3}, young: 210e9, shear_modulus: 81e9}
nodes:
  base: {at: [0, 0, 0], hold: all}
  tip: {at: [2, 0, 0]}
members:
  bar: {from: base, to: tip, section: box, y: [0, 1, 0], warping: free}
loads:
  push: {force: [500, 0, 0], on: tip}
  bend: {moment: [300, 0, 0], on: tip}
analyses:
  linear: {linear: {}}
  pulled: {static: {stations: [0.5, 1]}}
quantities:
  ${m}_$a: {for: {m: [von_mises, normal_max, normal_min], a: [linear, pulled]}, stress: {analysis: $a, member: bar, measure: $m}}
  middle: {stress: {analysis: linear, member: bar, where: 0.5}}
  path: {stress: {analysis: pulled, member: bar, take: max}, unit: MPa, factor: 1e-6}
"""

    def test_stress(self):
        area, swept, perimeter = 2*(0.1*3e-3 + 0.06*2e-3), 2*0.1*0.06, 2*(0.1/3e-3 + 0.06/2e-3)
        It = swept**2/perimeter + 2*(0.1*3e-3**3 + 0.06*2e-3**3)/3
        tau = max(300/It*(swept/perimeter/t + t) for t in (2e-3, 3e-3))
        mises = ((500/area)**2 + 3*tau**2)**0.5
        path = self.scene(self.STRESS, "stress.yaml")
        for formulation in ("collocation", "geometrically_exact", "beamw", "beamw_consistent"):
            got = values(self.record("solve", "--scene", path, "-f", formulation, "-n", 2))
            self.assertAlmostEqual(got["von_mises_linear"]/mises, 1, delta=1e-9)
            self.assertAlmostEqual(got["middle"]/mises, 1, delta=1e-9)
            self.assertAlmostEqual(got["normal_max_linear"]*area/500, 1, delta=1e-9)
            self.assertAlmostEqual(got["normal_min_linear"]*area/500, 1, delta=1e-9)
            self.assertAlmostEqual(got["path"]*1e6/got["von_mises_pulled"], 1, delta=1e-12)
            self.assertAlmostEqual(got["von_mises_pulled"]/mises, 1, delta=1e-3)
        again = self.scene(self.answered("scene", "--scene", path).stdout, "again.yaml")
        self.assertEqual(values(self.record("solve", "--scene", again, "-f", formulation, "-n", 2)), got)

    def test_sections_by_sizes(self):
        sizes = {"channel_portal": "channel: {depth: depth, flange: flange, flange_thickness: t_f, "
                                   "web_thickness: t_w}",
                 "zed_purlin": "zed: {depth: depth, flange: flange, flange_thickness: thickness, "
                               "web_thickness: thickness}"}
        for name, words in sizes.items():
            text = (EXAMPLES / f"{name}.yaml").read_text(encoding="utf-8")
            short = re.sub(r"    points:.*\n    walls:\n(      - .*\n)+", f"    {words}\n", text)
            self.assertNotEqual(short, text)
            written = [re.sub("p[0-9]+", "p", self.answered("scene", "--scene", path).stdout)
                       for path in (EXAMPLES / f"{name}.yaml", self.scene(short))]
            self.assertEqual(*written)
        # cantilever rigid in shear: P L^3/(3 E I)
        text = LEAF.replace("rectangle: {width: 50e-3, thickness: 0.5e-3}",
                             "i: {depth: 0.2, flange: 0.1, flange_thickness: 8e-3, "
                             "web_thickness: 5e-3}")
        text = text.replace("[0, 1, 0], on", "[0, 0, 1], on") + "omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia]\n"
        got = values(self.record("solve", "--scene", self.scene(text), "-f", "beamw_vlasov", "-n",
                                 1))
        inertia = 2 * 0.1 * 8e-3 * 0.1**2 + 5e-3 * 0.2**3 / 12
        self.assertAlmostEqual(got["tip_uz"] / (1e-3 / (3 * 210e9 * inertia)), 1, delta=1e-9)
        written = []
        for shape in ("angle: {along_y: 0.1, along_z: 0.08, thickness: 5e-3}",
                      "points: {a: [0.1, 0], b: [0, 0], c: [0, 0.08]}, walls: [{from: a, to: b, "
                      "thickness: 5e-3}, {from: b, to: c, thickness: 5e-3}]"):
            text = LEAF.replace("rectangle: {width: 50e-3, thickness: 0.5e-3}", shape)
            written.append(self.answered("scene", "--scene", self.scene(text)).stdout)
        self.assertEqual(*written)

    def test_weight_of_a_body(self):
        """A body of weight P, with its centre of mass at the distance a beyond the tip, must deflect the tip by P
        L^3/(3 E I) + P a L^2/(2 E I)."""
        heavy = LEAF.replace("  push: {force: [0, 1, 0], on: tip}", "  weight: {gravity: [0, -9.81, 0], on: tip}")
        body = heavy.replace("tip:  {at: [0.1, 0, 0]}", "tip:  {at: [0.1, 0, 0], mass: 0.01, centre: [0.02, 0, 0]}")
        self.assertNotIn("push", body)
        self.assertIn("mass", body)
        stiff = ("omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia]\n", "-f", "beamw_vlasov", "-n", 1)
        got = self.same_again(self.scene(body + stiff[0], "body.yaml"), *stiff[1:])
        force = repr(-9.81*0.01)
        plain = body.replace("gravity: [0, -9.81, 0], on: tip", f"force: [0, {force}, 0], at: [0.02, 0, 0], on: tip")
        self.assertEqual(got, values(self.record("solve", "--scene", self.scene(plain + stiff[0], "plain.yaml"), *stiff[1:])))
        EI = 210e9 * 50e-3 * 0.5e-3**3 / 12
        self.assertAlmostEqual(got["tip_uy"] / (-9.81*0.01 * (0.1**3/3 + 0.02*0.1**2/2) / EI), 1, delta=1e-9)
        for change, words in ((("mass: 0.01, ", ""), "has no mass"), (("on: tip", "on: tip, at: [1, 0, 0]"), "remove 'at'")):
            self.refused(2, words, "scene", "--scene", self.scene(body.replace(*change)))

    def test_weight_of_all(self):
        one = LEAF.replace("push: {force: [0, 1, 0], on: tip}", "weight: {gravity: [0, -9.81, 0], on: all}").replace(
            "tip:  {at: [0.1, 0, 0]}", "tip:  {at: [0.1, 0, 0], mass: 0.01, centre: [0.02, 0, 0]}\n  end:  {at: [0.2, 0, 0]}").replace(
            "loads:", "  more: {from: tip, to: end, section: light, y: [0, 1, 0]}\nloads:").replace(
            "nodes:", "  light: {rectangle: {width: 50e-3, thickness: 0.5e-3}, young: 210e9, shear_modulus: 81e9}\nnodes:").replace(
            "shear_modulus: 81e9}", "shear_modulus: 81e9, density: 7800}", 1)
        each = one.replace("weight: {gravity: [0, -9.81, 0], on: all}",
                           "weight: {gravity: [0, -9.81, 0], on: leaf}\n  load_1: {gravity: [0, -9.81, 0], on: tip}")
        self.assertEqual(self.answered("scene", "--scene", self.scene(one, "one.yaml")).stdout,
                         self.answered("scene", "--scene", self.scene(each, "one.yaml")).stdout)
        self.same_again(self.scene(one, "again.yaml"), "-f", "collocation", "-n", 1)
        bare = one.replace(", density: 7800", "").replace("mass: 0.01, centre: [0.02, 0, 0]", "hold: []")
        for text, words in ((one + "  twice: {gravity: [0, 0, 1], on: tip}\n", "already includes this weight"),
                            (one + "  twice: {gravity: [0, 0, 1], on: leaf}\n", "already includes this weight"),
                            (one.replace("on: all", "on: all, follower: true"), "remove 'follower'"),
                            (one.replace("gravity:", "force:"), "no node 'all'"),
                            (bare, "the scene has no mass")):
            self.refused(2, words, "scene", "--scene", self.scene(text))

    def test_the_analysis_that_was_made_up(self):
        where = ("-f", "collocation", "-n", 1)
        done = self.answered("solve", "--scene", self.scene(LEAF), *where)
        self.assertIn("has no analysis; a linear analysis is run", done.stderr)
        driven = LEAF.replace("hold: all", "hold: [uy, uz, rx, ry, rz], drive: {ux: pushed}").replace(
            "loads:", "motions:\n  pushed: {unit: m, path: [0, 0.5], value: [0, 1e-3]}\nloads:")
        done = self.answered("solve", "--scene", self.scene(driven), *where)
        self.assertIn("analyses: {run: {static: {stations: [0.5]}}}", done.stderr)
        done = self.answered("solve", "--scene", self.scene(LEAF + "analyses:\n  run: {linear: {}}\n"), *where)
        self.assertEqual(done.stderr, "")


class ExamplesTest(SceneCase):

    def test_examples_are_understood(self):
        for path in sorted(EXAMPLES.glob("*.yaml")):
            self.answered("list", "--scene", path)

    def test_folder(self):
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
        self.refused(2, "is already in this run", "verify", "--scene", EXAMPLES, "--scene", euler)
        self.refused(2, "no *.yaml", "verify", "--scene", EXAMPLES.parent / "shared")
        taken = euler.read_text(encoding="utf-8").replace("name: euler_column", "name: c_column")
        taken = self.scene(taken)
        self.refused(2, "is already in this run", "verify", "--built-in", "--scene", taken)
        self.refused(2, "given twice", "solve", "--scene", euler, "--scene", euler, "-f", "beamw",
                     "-n", 1)
        self.refused(2, "would overwrite", "verify", "--scene", self.folder, "-o", taken)

    def test_leaf_spring_guide(self):
        path = EXAMPLES / "leaf_spring_guide.yaml"
        got = values(self.record("solve", "--scene", path, "-f", "collocation", "-n", 4))
        self.assertAlmostEqual(got["k_drive"] / 2624.536778, 1, delta=1e-9)
        self.assertAlmostEqual(got["k_support"] / 1.05e8, 1, delta=1e-12)
        self.assertAlmostEqual(got["k_pushed"] / 13.1869e6, 1, delta=1e-5)
        done = self.answered("verify", "--scene", path, "-f", "collocation")
        self.assertIn("5 pass", done.stdout)

    def test_double_cross(self):
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
        got = values(
            self.record("solve", "--scene", EXAMPLES / "cross_flexure_hinge.yaml", "-f",
                        "collocation", "-n", 2))
        for name, value in (("moment", 0.0800992), ("shift_y", 0.838472e-3), ("k_x", 177513.77)):
            self.assertAlmostEqual(got[name] / value, 1, delta=1e-6)

    def test_folded_leaf_stage(self):
        path = EXAMPLES / "folded_leaf_stage.yaml"
        got = values(self.record("solve", "--scene", path, "-f", "collocation", "-n", 2))
        self.assertAlmostEqual(got["k_x"] / got["k_y"], 1, delta=1e-12)
        turned = path.read_text(encoding="utf-8").replace("{a: 2*pi/3*i}", "{a: 2*pi/3*i + 0.3}")
        again = values(
            self.record("solve", "--scene", self.scene(turned), "-f", "collocation", "-n", 2))
        for name, value in got.items():
            self.assertAlmostEqual(again[name] / value, 1, delta=1e-11)

    def test_box_girder(self):
        """The torsion of a closed section with restrained warping must be that of Benscoter's theory."""
        path = EXAMPLES / "box_girder.yaml"
        done = self.answered("verify", "--scene", path)
        self.assertRegex(done.stdout, r"12 verdicts against reference values: 12 pass")
        self.assertRegex(done.stdout, r"sheet_second, [\w,\s]+: another model: warping not modelled")


SCENES = sorted((ROOT / "cases" / "format" / "test" / "textbook").glob("*.yaml"))
CLOSE = 2e-3

# For each scene, a formulation whose elements are too long for their axial force. It must fail without a value.
REFUSED = {"rotating_string": "geometrically_exact"}


def wrong(solution):
    found = []
    for row in solution["quantities"]:
        for truth in row["truths"][:1]:
            right, uncertainty = truth["truth"], truth["truth_uncertainty"]
            if row["status"] != "ok" or row["value"] is None:
                found.append(f"{row['quantity']}: no value: {row['reason']}")
            elif abs(row["value"] - right) > CLOSE * abs(right) + uncertainty + 1e-12:
                found.append(f"{row['quantity']}: {row['value']} instead of {right}")
    return found


class ClosedFormsTest(ProgramTest):
    def holds(self, path, *options):
        solution = self.record("solve", "--scene", path, *options)
        self.assertEqual(solution["cell"]["status"], "ok", solution["cell"]["reason"])
        self.assertEqual(wrong(solution), [], path.name)

    def test_that_there_are_enough(self):
        self.assertGreaterEqual(len(SCENES), 30)


def add(path):
    def chosen(self):
        self.holds(path)

    def exact(self):
        if path.stem in REFUSED:
            done = self.answered("solve", "--scene", path, "-f", REFUSED[path.stem], "-n", "32",
                                 code=1)
            self.assertNotEqual(done.stderr, "")
        else:
            self.holds(path, "-f", "geometrically_exact", "-n", "32")

    chosen.__doc__ = f"{path.stem}: with what solve chooses"
    exact.__doc__ = f"{path.stem}: geometrically_exact with 32 elements"
    setattr(ClosedFormsTest, f"test_{path.stem}_chosen", chosen)
    setattr(ClosedFormsTest, f"test_{path.stem}_exact", exact)


for scene in SCENES:
    add(pathlib.Path(scene))


if __name__ == "__main__":
    unittest.main()
