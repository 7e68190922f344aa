"""The parameter `omit` of built-in cases."""
import csv
import io
import json
import math
import re

import h5py

from cases.format.test.scene_case import SceneCase, values

WHOLE = ("--set", "omit=none")


class OmitTest(SceneCase):

    def cases(self):
        return [c["case"] for c in self.record("list")["cases"]]

    def test_every_case_has_all_physics(self):
        changed = 0
        for case in self.cases():
            solved = self.record("solve", case, *WHOLE)
            self.assertEqual((solved["cell"]["status"], solved["omitted"]), ("ok", []), case)
            self.assertEqual(solved["parameters"]["omit"], "none", case)
            self.assertEqual([q["quantity"] for q in solved["quantities"] if q.get("truth") is not None], [], case)
        for case in ("angle_column", "elastica", "elbow", "hexapod", "moment_buckling", "sheet_wagner"):
            said = " ".join(self.answered("solve", case, *WHOLE).stdout.split())
            left_out = re.search("omitted: nothing, whereas the source of the case omits ([a-z_, ]*); the stored values", said)
            text = " ".join(self.answered("solve", case).stdout.split())
            self.assertEqual("omitted: " in text, left_out is not None, case)
            if left_out:
                self.assertIn("omitted: " + left_out[1], text)
                changed += 1
            else:
                self.assertIn("omitted: nothing; remove omit=none, which has no effect", said)
        self.assertEqual(changed, 3)

    def test_as_the_scene(self):
        for case, point in (("c_column", ()), ("moment_buckling", ("--set", "length=4")), ("c_cantilever", ()),
                            ("elastica", ("--set", "load=3"))):
            where = ("-f", "geometrically_exact", "-n", 4)
            mine = values(self.record("solve", case, *where, *point, *WHOLE))
            text = self.answered("scene", case, *point).stdout
            bare = re.sub(r"(?m)^omit:.*\n", "", text)
            self.assertNotEqual(bare, text, case)
            own = values(self.record("solve", "--scene", self.scene(bare), *where))
            self.assertEqual(set(mine), set(own))
            for name, value in mine.items():
                if isinstance(value, float):
                    self.assertLessEqual(abs(own[name] - value), 1e-12 * abs(value), (case, name))
            self.assertNotRegex(self.answered("scene", case, *WHOLE).stdout, "(?m)^omit:")

    def test_omitted_whatever_is_asked(self):
        text = """beamwork: 1
sections:
  i: {i: {depth: 0.1, flange: 0.06, flange_thickness: 3e-3, web_thickness: 2e-3}, young: 210e9, shear_modulus: 81e9}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]}}
members: {m: {from: a, to: b, section: i, y: [0, 1, 0], warping: free}}
loads:
  pull: {force: [10e3, 0, 0], on: b}
  twist: {moment: [0.1, 0, 0], on: b}
analyses: {run: {static: {stations: [1]}}}
quantities:
  turn: {displacement: {analysis: run, node: b, component: rx}}
"""
        asked = "".join(f"  {r}: {{internal: {{analysis: run, member: m, where: 0.4, resultant: {r}}}}}\n"
                        for r in ("Mx", "Mx_saint_venant", "Mx_warping", "Mx_wagner", "bimoment"))
        turns = set()
        for omit in ("none", "trapeze", "wagner_torque", "warping", "all"):
            for formulation in ("collocation", "beamw_consistent"):
                alone, both = [self.record("solve", "--scene", self.scene(text + more + f"omit: [{omit}]\n"), "-n", 2,
                                           "-f", formulation) for more in ("", asked)]
                mine, parts = values(alone), values(both)
                self.assertEqual(alone["omitted"], both["omitted"], omit)
                self.assertEqual(omit in both["omitted"], omit not in ("none", "all"))
                self.assertAlmostEqual(mine["turn"], parts["turn"], delta=1e-12, msg=omit)
                self.assertAlmostEqual(sum(parts[f"Mx_{p}"] for p in ("saint_venant", "warping", "wagner")),
                                       parts["Mx"], delta=1e-9, msg=omit)
                if omit in ("trapeze", "all"):
                    self.assertLess(abs(parts["Mx_wagner"]), 1e-6)
            turns.add(round(mine["turn"], 9))
        self.assertGreater(len(turns), 1)

    def test_more_than_single_switches(self):
        solved = [values(self.record("solve", "moment_buckling", "-n", 4, "-f", "geometrically_exact", *more))
                  for more in ((), ("--set", "shear=1"), WHOLE, (*WHOLE, "--set", "shear=1"))]
        self.assertEqual(solved[2], solved[3])
        self.assertEqual(solved[2], solved[1])
        self.assertNotEqual(solved[2], solved[0])

    BAR = """\
beamwork: 1
{parameters}sections:
  bar: {{{section}}}
nodes:
  a: {{at: [0, 0, 0], hold: all}}
  b: {{at: [1, 0, 0]}}
members:
  bar: {{from: a, to: b, section: bar, y: [0, 1, 0]}}
loads:
  push: {{force: [0, {load}, 0], on: b}}
analyses:
  st: {{{analysis}}}
quantities:
  u: {{displacement: {{analysis: st, node: b, component: uy}}, unit: m}}
{more}"""

    def loaded_bar(self, more):
        return self.BAR.format(
            parameters="parameters: {load: {value: 10, unit: N}}\n", load="load", analysis="static: {stations: [1]}",
            section="constants: {A: 1e-3, Iy: 2e-6, Iz: 1e-6, It: 1e-8%s}, young: 2e11, shear_modulus: 8e10" % more,
            more="omit: [trapeze]\n")

    def test_numbers_that_are_not_given(self):
        constants = "constants: {A: 1e-3, Iy: 2e-6, Iz: 1e-6, It: 1e-8%s}, young: 2e11, shear_modulus: 8e10"
        full = ", F: [1200, 0, 0, 0, 1200, 0, 0, 0, 0], Iw: 1e-10"
        diagonal = "stiffness: [2e8, 1e8, 1e8, 1e3, 4e5, 2e5], mass: [8, 8, 8, 1e-3, 1e-3, 1e-3]"
        shapes = "rectangle: {width: 0.1, thickness: 0.01}, young: 2e11, shear_modulus: 8e10"
        for section, analysis, more, told in (
            (constants % "", "linear: {}", "", "shear, warping"),
            (constants % "", "static: {stations: [1]}", "", "shear, wagner_torque, warping"),
            (constants % "", "static: {stations: [1]}", "omit: [shear, wagner_torque]\n", "warping"),
            (constants % "", "static: {stations: [1]}", "plane: xy\n", "shear"),
            (constants % "", "static: {stations: [1]}", "omit: all\n", None),
            (constants % (full + ", ys: 0.01"), "static: {stations: [1]}", "", "wagner_moments, wagner_torque"),
            (constants % (full + ", ys: 0.01, wagner_y: 1e-8, wagner_torque: 1e-11"), "static: {stations: [1]}", "",
             None),
            (constants % full, "linear: {}", "", None),
            (diagonal, "linear: {}", "", "warping"),
            (diagonal, "static: {stations: [1]}", "", "trapeze, wagner_moments, wagner_torque, warping"),
            (shapes, "static: {stations: [1]}", "", None)):
            scene = self.scene(self.BAR.format(parameters="", section=section, load=10, analysis=analysis, more=more))
            for verb in (("solve", ), ("converge", "-f", "collocation", "-n", 2)):
                said = " ".join(self.answered(verb[0], "--scene", scene, *verb[1:]).stdout.split())
                found = re.findall("not known: ([a-z_, ]*) of section bar is not given by its constants", said)
                self.assertEqual(found, [told] if told else [], (section, analysis, more, verb))

    def test_what_is_not_modelled(self):
        for flange, analysis, more, told in (
            (0.07, "static: {stations: [1]}", "", True), (-0.07, "static: {stations: [1]}", "", False),
            (0.07, "buckling: {}", "", True), (0.07, "linear: {}", "", False),
            (0.07, "static: {stations: [1]}", "omit: [warping]\n", False),
            (0.07, "static: {stations: [1]}", "omit: [wagner_torque]\n", False)):
            what = "critical_factor: {analysis: st, which: 0}" if "buckling" in analysis else (
                "displacement: {analysis: st, node: b, component: uy}")
            scene = self.scene(f"""\
beamwork: 1
sections:
  zed:
    points: {{a: [-0.07, 0.1], b: [0, 0.1], c: [0, -0.1], d: [{flange}, -0.1]}}
    walls: [{{from: a, to: b, thickness: 2e-3}}, {{from: b, to: c, thickness: 2e-3}}, {{from: c, to: d, thickness: 2e-3}}]
    young: 2e11
    shear_modulus: 8e10
nodes:
  a: {{at: [0, 0, 0], hold: all}}
  b: {{at: [1, 0, 0]}}
members:
  bar: {{from: a, to: b, section: zed, y: [0, 1, 0]}}
loads:
  push: {{force: [-10, 0, 0], on: b}}
analyses:
  st: {{{analysis}}}
quantities:
  u: {{{what}}}
{more}""")
            said = " ".join(self.answered("solve", "--scene", scene).stdout.split())
            self.assertEqual("not modelled: the effect of the bimoment on the torsion of section zed" in said, told,
                             (flange, analysis, more))

    def test_assumptions_stand_everywhere(self):
        scene = ("--scene", self.scene(self.loaded_bar(", Iw: 0")))
        physics = "shear, wagner_torque"
        said = physics + " of section bar is not given by its constants and is assumed to be zero"
        line = "not known: " + said
        one = {"kind": "not known", "section": "bar", "physics": physics, "text": said}
        for words in (("solve", ), ("converge", ), ("bench", "-f", "beamw", "-n", 1),
                      ("bench", "-f", "beamw", "-n", 1, "--against", "sheet_second"),
                      ("sweep", "--vary", "load=1,2", "-f", "beamw", "-n", 1)):
            text = " ".join(self.answered(words[0], *scene, *words[1:]).stdout.split())
            self.assertEqual(text.count(line), 1, words)
        for words in (("solve", ), ("converge", ), ("bench", "-f", "beamw", "-n", 1, "--against", "sheet_second"),
                      ("bench", "-f", "beamw", "--against", "sheet_second", "--error", "1%"),
                      ("bench", "-f", "beamw", "-n", 1, "--against", "build/beamwork")):
            record = self.record(words[0], *scene, *words[1:])
            self.assertEqual((record["omitted"], record["assumptions"]), (["trapeze"], [one]), words)
        for words in (("solve", ), ("converge", "-n", "1,2")):
            rows = list(csv.DictReader(io.StringIO(
                self.answered(words[0], *scene, *words[1:], "--format", "csv").stdout)))
            self.assertEqual({r["assumed"] for r in rows}, {line})
        files = [self.folder / name for name in ("v.h5", "v.json", "j.xml", "m.md")]
        self.answered("verify", *scene, "-f", "beamw", "-o", files[0], "--json", files[1], "--junit", files[2],
                      "--markdown", files[3], code=3)
        with h5py.File(files[0]) as file:
            (case, ) = file["cases"].values()
            (row, ) = case["assumptions"][()]
            self.assertEqual({name: row[name].decode() for name in ("section", "physics", "text")},
                             {name: one[name] for name in ("section", "physics", "text")})
            self.assertEqual({c["assumed"].decode() for c in case["cells"][()]}, {line})
        (row, ) = json.loads(files[1].read_text())["assumptions"]
        self.assertLessEqual(one.items(), row.items())
        self.assertIn(f'name="not known" value="{said}"', files[2].read_text())
        self.assertIn(line, files[3].read_text())

    def test_zero_that_is_given(self):
        every = ", ".join("0" for _ in range(9))
        for more, told in (("", "shear, warping, wagner_torque"), (", Iw: 0", "shear, wagner_torque"),
                           (", wagner_torque: 0", "shear, warping"), (f", F: [{every}]", "warping, wagner_torque"),
                           (f", D: [{every}]", "warping, wagner_torque"), (", Iw: 1 - 1, wagner_torque: 0", "shear"),
                           (", ys: 0.01", "shear, wagner_moments, warping, wagner_torque"),
                           (", ys: 0.01, wagner_y: 0", "shear, wagner_moments, warping, wagner_torque"),
                           (", ys: 0.01, wagner_y: 0, wagner_z: 0", "shear, warping, wagner_torque"),
                           (f", F: [{every}], Iw: 0, wagner_torque: 0", None)):
            written = self.answered("scene", "--scene", self.scene(self.loaded_bar(more))).stdout
            for text in (self.loaded_bar(more), written):
                found = [a["physics"] for a in self.record("solve", "--scene", self.scene(text))["assumptions"]]
                self.assertEqual([set(f.split(", ")) for f in found], [set(told.split(", "))] if told else [], more)

    def test_torque_of_its_own(self):
        self.assertRegex(self.answered("scene", "sheet_wagner").stdout, "given: {Iw: [^}]*, wagner_torque: ")
        text = self.loaded_bar("").replace("omit: [trapeze]\n", "")
        for more, told in ((", given: {wagner_torque: 0}", "shear, warping"), (", given: {Iw: 0}", "shear, wagner_torque"),
                           (", given: {Iw: 1e-12, wagner_torque: 1e-14}", "shear")):
            (found, ) = self.record("solve", "--scene", self.scene(text.replace(", young", more + ", young")))["assumptions"]
            self.assertEqual(set(found["physics"].split(", ")), set(told.split(", ")), more)

    def test_no_truth(self):
        self.refused(1, "beamwork scene c_column --set omit=none", "truth", "c_column", *WHOLE, silent=False)
        self.assertIn("buckling_load", self.answered("truth", "c_column", "--set", "omit=source").stdout)
        judged = self.record("converge", "elastica", "-f", "geometrically_exact", *WHOLE)
        text = str(judged["series"])
        self.assertNotIn("'pass'", text)
        self.assertIn("'pass'", str(self.record("converge", "elastica", "-f", "geometrically_exact")["series"]))


COLUMN = """beamwork: 1
sections:
  s: {profile: HEB300, young: 210e9, shear_modulus: 81e9}
nodes:
  foot: {at: [0, 0, 0], hold: [ux, uy, uz, rx]}
  head: {at: [1, 0, 0], hold: [uy, uz, rx]}
members:
  column: {from: foot, to: head, section: s, y: [0, 1, 0]}
loads:
  push: {force: [-1, 0, 0], on: head}
analyses:
  stability: {buckling: {}}
quantities:
  load: {critical_factor: {analysis: stability}, unit: N}
"""


class ShearOfWarpingTest(SceneCase):
    def test_choice(self):
        path = self.scene(COLUMN)
        c = json.loads(self.answered("scene", "--scene", path, "--format", "json").stdout)["sections"][0]
        warping = 1/(1/(math.pi**2*c["E"]*c["Iw"]) + c["F"][2][2]/c["G"])
        exact = (c["G"]*c["It"] + warping)*c["A"]/c["Ip"]
        solved = self.record("solve", "--scene", path)
        self.assertLess(abs(values(solved)["load"]/exact - 1), 1e-3)
        one = "".join(self.answered("solve", "--scene", path, "-f", "sheet_second_consistent").stdout.split("\n"))
        self.assertRegex(one, r"another model: shear due to warping not modelled \(changes load by about 1[0-9] %\)")
        long = self.answered("solve", "--scene", self.scene(COLUMN.replace("[1, 0, 0], hold", "[40, 0, 0], hold")),
                             "-f", "sheet_second_consistent").stdout
        self.assertIn("without shear due to warping; the omission changes no value", " ".join(long.split()))
        none = self.scene(COLUMN.replace("beamwork: 1", "beamwork: 1\nomit: [shear]"))
        self.assertNotIn("due to warping", self.answered("solve", "--scene", none, "-f", "sheet_second_consistent").stdout)
