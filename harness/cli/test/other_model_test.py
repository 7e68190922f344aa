"""A formulation that does not offer all physics of a scene: as any other where that changes nothing
asked for, else as another model, which is shown and neither gates, wins nor votes."""
import csv
import io
import json

import h5py

from harness.tools.kit.program import ProgramTest

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
        """Shear changes nothing: rigid in shear or not, all are one model."""
        for load in ("0.1", "0"):
            leaf = self.scene("0.0005", load, "1e-4")
            one = self.series(*leaf)[0]["beamw_vlasov"]
            self.assertEqual((one["other_model"], one["not_modelled"]), (False, "shear"), load)
            self.assertLess(one["model_change"], 1e-4)
            self.assertIn("without shear: changes no asked value", one["model_words"])
            for quantity in one["quantities"]:
                self.assertNotEqual(quantity["verdict"], "other model")
            text = self.answered("solve", *leaf, "-f", "beamw_vlasov", "-n", "2").stdout
            self.assertEqual(text.count("without shear: changes no asked value"), 1)

    def test_no_load_at_all(self):
        """Every value is zero: nothing can be changed."""
        one = self.series(*self.scene("0.05", "0", "0"))[0]["beamw_vlasov"]
        self.assertEqual((one["other_model"], one["model_change"]), (False, 0))

    def test_a_deep_beam(self):
        """Shear is 1e-1 of its deflection: shown, in no ranking, in no agreement."""
        deep = self.scene("0.1", "1", "0")
        series, record = self.series(*deep)
        one = series["beamw_vlasov"]
        self.assertTrue(one["other_model"])
        self.assertEqual({q["verdict"] for q in one["quantities"]}, {"other model"})
        self.assertTrue(all(m["value"] is not None for q in one["quantities"] for m in q["meshes"]))
        self.assertNotIn("beamw_vlasov", [a["formulation"] for a in record["answers"]])
        self.assertIn("another model, which is not ranked: beamw_vlasov (without shear)",
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
        """Second order, third order and Vlasov side by side."""
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
        """Points of a sweep rest on the whole model."""
        text = self.answered("sweep", "shear_column", "--vary", "length=0.5,1", "-f",
                             "beamw_vlasov").stdout
        self.assertNotIn("does not offer", text)

    def test_sweep_of_another_model(self):
        """It is marked at the points where it is one, and is in no share and no ranking there."""
        path = self.folder / "leaf.yaml"
        path.write_text(LEAF.replace("sections:", "parameters: {t: {value: 0.1, unit: m}}\nsections:") %
                        ("t", "0.001", "0"))
        words = ("sweep", "--scene", path, "--vary", "t=0.0005,0.1", "-f", "beamw_vlasov", "-f",
                 "collocation", "-k", "uy")
        text = self.answered(*words, "-o", self.folder / "s.h5").stdout
        self.assertIn("omitted: trapeze, wagner_torque", text)
        self.assertIn("beamw_vlasov: another model at 1 of 2 points, not counted: shear not modelled",
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
        """What the scene leaves out stands in every table."""
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
        """Times rank: another model is not timed beside the others, by name; alone it is marked."""
        deep = self.scene("0.1", "1", "0")
        text = self.answered("bench", *deep, "-f", "beamw_vlasov", "-f", "collocation", "-n",
                             "1").stdout
        self.assertIn("omitted: trapeze, wagner_torque", text)
        self.assertIn("beamw_vlasov: not timed, shear not modelled", text)
        text = self.answered("bench", *deep, "-f", "beamw_vlasov", "--against", "collocation", "-n",
                             "1").stdout
        self.assertIn("A: shear not modelled", text)
        self.assertNotIn("B: shear", text)
