"""Other models: scenes confined to a plane, physics that a formulation does not support, and formulations that are
not accepted yet."""
import csv
import io
import json
import math
import shutil
import subprocess
import sys

import h5py

from harness.tools.kit.program import ProgramTest, ROOT


EXAMPLES = ROOT / "cases" / "examples"
E, G, RHO = 210e9, 81e9, 7850
LENGTH, HEIGHT, THICK = 1, 0.1, 0.002
STRIP = """beamwork: 1
name: strip
sections: {s: {rectangle: {width: 0.002, thickness: 0.1}, young: 210e9, shear_modulus: 81e9,
               density: 7850}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}
loads: {push: {force: [-1, 0, 0], on: b}}
analyses:
  buckling: {buckling: {}}
  modes: {modal: {}}
  path: {static: {stations: [1]}}
quantities:
  p: {critical_factor: {analysis: buckling}}
  f: {frequency: {analysis: modes}}
  g: {frequency: {analysis: modes, which: 1}}
  u: {displacement: {analysis: path, node: b, component: uy}}
omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia]
"""


FRAME = """beamwork: 1
name: frame
sections: {s: {rectangle: {width: 0.02, thickness: 0.01}, young: 210e9, shear_modulus: 81e9,
               density: 7850}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [0, 1, 0]}, c: {at: [1, 1.2, 0]},
        d: {at: [1, 0, 0], hold: [ux, uy, uz, rx, ry]}}
members:
  m: {from: a, to: b, section: s, y: [1, 0, 0]}
  n: {from: b, to: c, section: s, y: [0, 1, 0], release: {from: %s}}
  o: {from: c, to: d, section: s, y: [1, 0, 0]}
loads: {t: {force: [10, 0, 0], on: b}, q: {distributed: [0, -5, 0], on: n}}
analyses: {path: {static: {stations: [1]}}, modes: {modal: {}}, b: {buckling: {}}, l: {linear: {}}}
quantities:
  ux: {displacement: {analysis: path, node: b, component: ux}}
  uc: {displacement: {analysis: path, node: c, component: uy}}
  ul: {displacement: {analysis: l, node: b, component: ux}}
  mz: {internal: {analysis: path, member: m, resultant: Mz, end: from}}
  f: {frequency: {analysis: modes}}
  p: {critical_factor: {analysis: b}}
"""


def turned(text, plane):
    to = {"xy": (0, 1), "xz": (0, 2), "yz": (1, 2)}[plane]
    for old in ("[1, 0, 0]", "[0, 1, 0]", "[-1, 0, 0]"):
        x, y, _ = (int(v) for v in old[1:-1].split(","))
        new = [0, 0, 0]
        new[to[0]], new[to[1]] = x, y
        text = text.replace(old, "<" + ", ".join(str(v) for v in new) + ">")
    return text.replace("<", "[").replace(">", "]").replace(
        "component: uy", "component: u" + "xyz"[to[1]]) + f"plane: {plane}\n"


class Plane(ProgramTest):

    def solved(self, text, *options, formulation="collocation", n=16):
        path = self.folder / "scene.yaml"
        path.write_text(text)
        record = self.record("solve", "--scene", path, "-f", formulation, "-n", str(n), *options)
        return record, {q["quantity"]: q["value"] for q in record["quantities"]}

    def test_closed_forms(self):
        area, stiff = HEIGHT * THICK, E * THICK * HEIGHT**3 / 12
        soft = E * HEIGHT * THICK**3 / 12
        _, space = self.solved(STRIP)
        self.assertLess(abs(space["p"] / (math.pi**2 * soft / 4) - 1), 1e-3)
        for plane in ("xy", "xz", "yz"):
            record, found = self.solved(turned(STRIP, plane))
            self.assertEqual(record["cell"]["free"], 48)
            self.assertIn(f"out of the plane {plane}", record["cell"]["left_out"])
            self.assertLess(abs(found["p"] / (math.pi**2 * stiff / 4) - 1), 1e-3)
            for name, root in (("f", 1.8751040687), ("g", 4.6940911330)):
                exact = root**2 / (2 * math.pi) * math.sqrt(stiff / (RHO * area))
                self.assertLess(abs(found[name] / exact - 1), 0.02, (plane, name))

    def test_the_same_as_in_space(self):
        text = self.answered("scene", "elastica").stdout
        whole, space = self.solved(text)
        half, plane = self.solved(text + "plane: xy\n")
        self.assertEqual((whole["cell"]["free"], half["cell"]["free"]), (96, 48))
        for name, value in space.items():
            self.assertLess(abs(plane[name] / value - 1), 1e-9, name)
        for n in (1, 3, 64):
            for formulation in ("beamw", "collocation"):
                _, space = self.solved(text, formulation=formulation, n=n)
                _, plane = self.solved(text + "plane: xy\n", formulation=formulation, n=n)
                for name, value in space.items():
                    self.assertLess(abs(plane[name] / value - 1), 1e-8, (formulation, n, name))

    def test_examples(self):
        for name in ("bent_leaf", "four_bar", "hinged_guide", "released_guide"):
            text = (EXAMPLES / f"{name}.yaml").read_text()
            _, space = self.solved(text, n=4)
            record, plane = self.solved(text + "\nplane: xy\n", n=4)
            self.assertIn("out of the plane xy", record["cell"]["left_out"])
            self.assertEqual(set(space), set(plane))
            compared = 0
            for key, value in space.items():
                if value is None or plane[key] is None:
                    continue
                compared += 1
                self.assertLess(abs(plane[key] - value), 1e-7 * max(abs(value), 1e-6),
                                (name, key, plane[key], value))
            self.assertGreater(compared, 0)

    def test_released_ends(self):
        values = []
        for release, plane in (("rz", ""), ("rz", "plane: xy\n"),
                               ("[rx, ry, rz]", "plane: xy\n"),
                               ("[uz, rx, rz]", "plane: xy\n")):
            _, found = self.solved(FRAME % release + plane, n=4)
            values.append(found)
        for found in values[1:]:
            for name, value in values[0].items():
                self.assertLess(abs(found[name] / value - 1), 1e-8, name)

    def test_keep_all(self):
        text = self.answered("scene", "elastica").stdout + "plane: xy\n"
        _, one = self.solved(text, n=4)
        _, other = self.solved(text, "--all-dofs", n=4)
        for name, value in one.items():
            self.assertLess(abs(other[name] / value - 1), 1e-9)

    def test_warping_is_held(self):
        text = STRIP.replace("rectangle: {width: 0.002, thickness: 0.1}",
                             "constants: {A: 2e-3, Iy: 1e-6, Iz: 3e-6, It: 1e-9, Iw: 1e-9, "
                             "ys: 0.01}").replace("[-1, 0, 0]", "[0, 1, 0]")
        text = text.replace("  buckling: {buckling: {}}\n", "").replace(
            "  p: {critical_factor: {analysis: buckling}}\n", "")
        record, found = self.solved(text + "plane: xy\n", formulation="beamw", n=8)
        self.assertEqual(record["cell"]["free"], 24)
        self.assertLess(abs(found["u"] / (1 / (3 * E * 3e-6)) - 1), 1e-3)

    def test_written(self):
        path = self.folder / "scene.yaml"
        path.write_text(STRIP + "plane: xy\n")
        text = self.answered("scene", "--scene", path).stdout
        self.assertIn("\nplane: xy\n", text)
        self.assertEqual(self.solved(text)[1], self.solved(STRIP + "plane: xy\n")[1])
        self.assertIn("plane", self.answered("scene", "--keys").stdout)

    def test_what_leaves_it_is_refused(self):
        held = STRIP + "plane: xy\n"
        node = "b: {at: [1, 0, 0]"
        changes = {
            "push: it acts out of the plane": ("[-1, 0, 0]", "[-1, 0, 1e-3]"),
            "push: its moment is not about the normal of the plane": ("force: [-1, 0, 0]", "moment: [1, 0, 0]"),
            "push: it acts outside the plane":
                ("force: [-1, 0, 0]", "at: [0, 0, 0.1], force: [-1, 0, 0]"),
            "b: its position is outside the plane through the first node": (node, "b: {at: [1, 0, 0.1]"),
            "b: the centre of its body is outside":
                (node, node + ", mass: 1, centre: [0, 0, 0.1]"),
            "m: its initial curvature leaves":
                ("y: [0, 1, 0]}}", "y: [0, 1, 0], curvature: [0, 0.1, 0]}}"),
            "m: its initial strain leaves":
                ("y: [0, 1, 0]}}", "y: [0, 1, 0], strain: [0, 0, 1e-3]}}"),
            "m: it is released along or about":
                ("y: [0, 1, 0]}}", "y: [0, 1, 1], release: {from: rz}}}"),
        }
        path = self.folder / "scene.yaml"
        for words, (old, new) in changes.items():
            self.assertIn(old, held)
            text = held.replace(old, new)
            path.write_text(text)
            self.refused(2, words, "solve", "--scene", path, "-f", "collocation", "-n", "2")
        path.write_text(STRIP + "plane: zx\n")
        self.refused(2, "plane", "solve", "--scene", path)

    def test_motions_that_leave_it(self):
        text = STRIP.replace("b: {at: [1, 0, 0]}", "b: {at: [1, 0, 0], drive: {%s: d}}").replace(
            "loads:", "motions: {d: {path: [0, 1], value: [0, 1e-4]}}\nloads:")
        for component, out in (("uz", 1), ("rx", 1), ("ry", 1), ("uy", 0), ("rz", 0)):
            path = self.folder / "scene.yaml"
            path.write_text(text % component + "plane: xy\n")
            what = ("solve", "--scene", path, "-f", "collocation", "-n", "2")
            if out:
                self.refused(2, "out of the plane is prescribed", *what)
            else:
                self.answered(*what)

    def test_compliance(self):
        text = STRIP.replace("  modes: {modal: {}}\n",
                             "  modes: {modal: {}}\n  c: {compliance: {node: b}}\n")
        extra = "  k: {stiffness: {analysis: c, component: %s}}\nomit"
        _, found = self.solved(text.replace("omit", extra % "uy") + "plane: xy\n")
        self.assertLess(abs(found["k"] / (3 * E * THICK * HEIGHT**3 / 12) - 1), 1e-3)
        path = self.folder / "scene.yaml"
        path.write_text(text.replace("omit", extra % "uz") + "plane: xy\n")
        self.refused(2, "k refers to a component out of the plane", "solve", "--scene", path)

    def test_decks(self):
        path = self.folder / "scene.yaml"
        path.write_text(STRIP + "plane: xy\n")
        self.refused(2, "confined to a plane", "export", "--scene", path, "--to", "calculix")


LEAF = """beamwork: 1
sections: {s: {rectangle: {width: 0.1, thickness: %s}, young: 210e9, shear_modulus: 81e9}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [0.2, 0, 0]}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0], warping: free}}
loads: {f: {force: [0, %s, 0], on: b}, t: {moment: [%s, 0, 0], on: b}}
analyses: {p: {static: {stations: [1]}}}
quantities:
  uy: {displacement: {analysis: p, node: b, component: uy}}
  rx: {displacement: {analysis: p, node: b, component: rx}}
omit: [trapeze, wagner_torque]
meshes: [1, 2, 4, 8]
"""
PAPERS = {"c_column": ("beamw_vlasov", "sheet_second", "sheet_third", "beamw"),
          "sheet_cantilever": ("beamw_vlasov", "sheet_third", "beamw"),
          "spherical_joint": ("beamw_vlasov", "beamw", "sheet_second", "sheet_third")}


class OtherModel(ProgramTest):

    def scene(self, *numbers):
        path = self.folder / "leaf.yaml"
        path.write_text(LEAF % numbers)
        return "--scene", path

    def series(self, *words):
        done = self.answered("converge", *words, "-f", "all", "--format", "json")
        record = json.loads(done.stdout)
        return {s["formulation"]: s for s in record["series"]}, record

    def test_a_thin_leaf(self):
        for load in ("0.1", "0"):
            leaf = self.scene("0.0005", load, "1e-4")
            one = self.series(*leaf)[0]["beamw_vlasov"]
            self.assertEqual((one["other_model"], one["not_modelled"]), (False, "shear"), load)
            self.assertLess(one["model_change"], 1e-4)
            self.assertIn("without shear; the omission changes no value", one["model_words"])
            for quantity in one["quantities"]:
                self.assertNotEqual(quantity["verdict"], "other model")
            text = self.answered("solve", *leaf, "-f", "beamw_vlasov", "-n", "2").stdout
            self.assertEqual(text.count("without shear; the omission changes no value"), 1)

    def test_no_load_at_all(self):
        one = self.series(*self.scene("0.05", "0", "0"))[0]["beamw_vlasov"]
        self.assertEqual((one["other_model"], one["model_change"]), (False, 0))

    def test_a_deep_beam(self):
        deep = self.scene("0.1", "1", "0")
        series, record = self.series(*deep)
        one = series["beamw_vlasov"]
        self.assertTrue(one["other_model"])
        self.assertEqual({q["verdict"] for q in one["quantities"]}, {"other model"})
        self.assertTrue(all(m["value"] is not None for q in one["quantities"] for m in q["meshes"]))
        self.assertNotIn("beamw_vlasov", [a["formulation"] for a in record["answers"]])
        self.assertIn("a different model, not ranked: beamw_vlasov (without shear)",
                      record["sentence"])
        for other in series.values():
            self.assertTrue(all("beamw_vlasov" not in q["source"] for q in other["quantities"]))
        chosen = self.answered("solve", *deep, "-n", "2").stdout
        self.assertNotIn("another model", chosen)

    def test_every_form(self):
        deep = self.scene("0.1", "1", "0")
        work = ("solve", *deep, "-f", "beamw_vlasov", "-n", "2")
        self.assertIn("another model: shear not modelled", self.answered(*work).stdout)
        rows = list(csv.DictReader(io.StringIO(self.answered(*work, "--format", "csv").stdout)))
        self.assertEqual({r["not_modelled"] for r in rows}, {"shear"})
        results, junit = self.folder / "r.h5", self.folder / "j.xml"
        table = self.answered("verify", *deep, "-o", results, "--junit", junit, code=3).stdout
        self.assertIn("another model: shear not modelled", table)
        self.assertIn('<skipped message="another model: shear not modelled', junit.read_text())
        with h5py.File(results) as file:
            rows = file["cases/leaf/series"][()]
        found = {r["formulation"].decode(): r for r in rows}
        self.assertEqual(found["beamw_vlasov"]["not_modelled"].decode(), "shear")
        self.assertTrue(found["beamw_vlasov"]["other_model"])
        self.assertFalse(found["collocation"]["other_model"])

    def test_as_in_the_papers(self):
        for case, names in PAPERS.items():
            done = self.answered("converge", case, *[w for name in names for w in ("-f", name)],
                                 "-n", "1,2", "--format", "json")
            for one in json.loads(done.stdout)["series"]:
                self.assertEqual(one["missing"], "", case)
            listed = json.loads(self.answered("list", case, "--format", "json").stdout)
            of = {f["formulation"]: f for f in listed["formulations"]}
            self.assertTrue(all(of[name]["runs"] for name in names), case)
            self.assertTrue(of["beamw_vlasov"]["other_model"], case)

    def test_sweep(self):
        text = self.answered("sweep", "shear_column", "--vary", "length=0.5,1", "-f",
                             "beamw_vlasov").stdout
        self.assertNotIn("does not support", text)

    def test_sweep_of_another_model(self):
        path = self.folder / "leaf.yaml"
        path.write_text(LEAF.replace("sections:", "parameters: {t: {value: 0.1, unit: m}}\nsections:") %
                        ("t", "0.001", "0"))
        words = ("sweep", "--scene", path, "--vary", "t=0.0005,0.1", "-f", "beamw_vlasov", "-f",
                 "collocation", "-k", "uy")
        text = self.answered(*words, "-o", self.folder / "s.h5").stdout
        self.assertIn("omitted: trapeze, wagner_torque", text)
        self.assertIn("beamw_vlasov: another model at 1 of 2 points, which are not counted: shear not modelled",
                      " ".join(text.split()))
        rows = csv.DictReader(io.StringIO(self.answered(*words, "--format", "csv").stdout))
        self.assertEqual({(r["t"], r["not_modelled"]) for r in rows
                          if r["formulation"] == "beamw_vlasov"}, {("0.0005", ""), ("0.1", "shear")})
        with h5py.File(self.folder / "s.h5") as file:
            stored = file["experiments/sweep/not_modelled"]
            lacks, bits = stored[()], stored.attrs["bits"].decode()
        self.assertEqual([[bool(x) for x in row] for row in lacks], [[False, False], [True, False]])
        self.assertEqual(bits.split("\n")[int(lacks[1, 0]).bit_length() - 1], "shear")

    def test_omitted(self):
        deep = self.scene("0.1", "1", "0")
        for words, code in ((("solve", "-n", "2"), 0), (("converge",), 0), (("verify", "-v"), 3)):
            text = self.answered(words[0], *deep, *words[1:], code=code).stdout
            self.assertIn("omitted: trapeze, wagner_torque", text, words)
        rows = csv.DictReader(io.StringIO(
            self.answered("converge", *deep, "-n", "1,2", "--format", "csv").stdout))
        self.assertEqual({r["omitted"] for r in rows}, {"trapeze, wagner_torque"})
        one = ("-f", "collocation", "-f", "beamw_vlasov", "-n", "1")
        rows = csv.DictReader(io.StringIO(
            self.answered("solve", *deep, *one[:2], "-n", "1", "--format", "csv").stdout))
        self.assertEqual({r["omitted"] for r in rows}, {"trapeze, wagner_torque"})
        files = [self.folder / name for name in ("v.json", "j.xml", "m.md")]
        self.answered("verify", *deep, *one[:4], "--json", files[0], "--junit", files[1],
                      "--markdown", files[2], code=3)
        verdicts = json.loads(files[0].read_text())["verdicts"]
        self.assertEqual({v["omitted"] for v in verdicts}, {"trapeze, wagner_torque"})
        self.assertEqual(files[1].read_text().count('name="omitted" value="trapeze, wagner_torque"'),
                         len(verdicts))
        self.assertIn("\n- leaf: trapeze, wagner_torque\n", files[2].read_text())

    def test_bench(self):
        deep = self.scene("0.1", "1", "0")
        text = self.answered("bench", *deep, "-f", "beamw_vlasov", "-f", "collocation", "-n",
                             "1").stdout
        self.assertIn("omitted: trapeze, wagner_torque", text)
        self.assertIn("beamw_vlasov: not timed, shear not modelled", text)
        text = self.answered("bench", *deep, "-f", "beamw_vlasov", "--against", "collocation", "-n",
                             "1").stdout
        self.assertIn("A: shear not modelled", text)
        self.assertNotIn("B: shear", text)


NAME = "sheet_second"


def without(path, beginning):
    lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
    kept = [line for line in lines if not line.startswith(beginning)]
    assert len(kept) < len(lines), path
    path.write_text("".join(kept), encoding="utf-8")


class NotAccepted(ProgramTest):
    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        shutil.copytree(ROOT / "reference", folder / "reference")
        without(folder / "reference" / "findings.csv", "N")
        without(folder / "reference" / "extreme_findings.csv", "slender_square")
        cls.truths = {"accepted": folder / "accepted.h5", "new": folder / "new.h5"}
        cls.pack(folder / "reference", cls.truths["accepted"])
        without(folder / "reference" / "accepted.csv", f"{NAME},")
        cls.pack(folder / "reference", cls.truths["new"])

    @staticmethod
    def pack(reference, path):
        subprocess.run([sys.executable, ROOT / "reference" / "pack.py", "--folder", reference, "-o",
                        path], check=True, capture_output=True)

    def verified(self, truths, *options, code=0):
        return self.answered("verify", "-k", f"shear_elastica/default/{NAME}/", "--truths",
                             self.truths[truths], *options, code=code).stdout

    def test_named_it_gates(self):
        out = self.verified("new", "-f", NAME, code=1)
        self.assertIn("from the expected one", out)
        self.assertNotIn("(new)", out)

    def test_an_accepted_one_without_its_finding_is_red(self):
        out = self.verified("accepted", code=1)
        self.assertIn("from the expected one", out)
        self.assertNotIn("(new)", out)

    def test_a_new_one_is_told_and_does_not_gate(self):
        out = " ".join(self.verified("new").split())
        self.assertIn("(new)", out)
        for text in (out, " ".join(self.verified("new", "-q").split())):
            self.assertRegex(text, r"everything that affects the exit status is as expected; without effect on the exit status: "
                             r"\d+ of \d+ verdicts of new formulations")
            self.assertNotIn("every verdict is as expected", text)

    def test_its_rules_are_proposed(self):
        needed = self.folder / "needed.csv"
        self.verified("new", "--propose-deviations", needed)
        with open(needed, newline="", encoding="utf-8") as rows:
            rules = list(csv.DictReader(rows))
        self.assertEqual({(r["formulations"], r["cases"]) for r in rules},
                         {(NAME, "shear_elastica")})

    def test_results_say_so(self):
        for truths, new in (("accepted", 0), ("new", 1)):
            stored = self.folder / f"{truths}.h5"
            self.verified(truths, "-o", stored, code=1 - new)
            with h5py.File(stored) as file:
                row = file["declarations"][()][0]
            self.assertEqual((row["type"].decode(), int(row["is_new"])), (NAME, new))

    def test_extremes(self):
        for truths, code in (("accepted", 1), ("new", 0)):
            what = ("stress", "-k", f"slender_square and {NAME}", "--truths", self.truths[truths])
            out = self.answered(*what, code=code).stdout
            self.assertEqual("these do not affect the exit status" in out, truths == "new", out)
            self.answered(*what, "-f", NAME, code=1)
