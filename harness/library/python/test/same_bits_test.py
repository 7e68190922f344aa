"""The program, the library and Python must give the same bits for every case and every example."""
import json
import math
import unittest

from harness.library.python.test.module import ROOT, ModuleTest, bw

EXAMPLES = sorted((ROOT / "cases" / "examples").glob("*.yaml"))


PART = {"hexapod_motion": {"time": 0.05}}


def bits(value):
    return "nan" if value is None or math.isnan(value) else float(value).hex()


class SameBits(ModuleTest):

    def same(self, record, result):
        self.assertEqual((record["formulation"], record["elements"]),
                         (result.document["formulation"], result.elements))
        values = [q for q in record["quantities"] if q["quantity"] not in result.curves]
        self.assertTrue(values or record["curves"], "nothing to compare")
        for quantity in values:
            name = quantity["quantity"]
            self.assertEqual(bits(quantity["value"]), bits(result[name]), name)
            error = result.errors.get(name)
            self.assertEqual(bits(quantity["error"]), bits(error), name)
        for curve in record["curves"]:
            x, y = result.curve(curve["quantity"])
            for ours, theirs in ((x, "curve_x"), (y, "curve_value")):
                self.assertEqual([bits(v) for v in curve[theirs]], [bits(v) for v in ours])
        for step in record["steps"]:
            self.assertEqual(bits(step["path"]), bits(result.steps["path"][step["step"]]))

    def test_every_case(self):
        names = [case["case"] for case in bw.cases()]
        self.assertGreater(len(names), 20)
        for name in names:
            part = PART.get(name, {})
            words = [word for key, value in part.items() for word in ("--set", f"{key}={value}")]
            with self.subTest(name):
                self.same(self.record("solve", name, *words), bw.Scene.case(name).set(**part).solve())

    def test_every_example(self):
        self.assertGreater(len(EXAMPLES), 10)
        for path in EXAMPLES:
            with self.subTest(path.name):
                record = self.record("solve", "--scene", path)
                self.same(record, bw.Scene.open(path).solve())
                content = path.read_text(encoding="utf-8")
                self.same(record, bw.Scene.text(content, path.stem).solve())

    def test_chosen(self):
        record = self.record("solve", "sheet_cantilever", "-f", "sheet_third:newton=displacement",
                             "-n", 2, "--set", "tip_deflection=0.01", "--steps", 3)
        scene = bw.Scene.case("sheet_cantilever").set(tip_deflection=0.01)
        self.same(record, scene.solve("sheet_third:newton=displacement", 2, steps=3))

    def test_converge(self):
        record = self.record("converge", "elastica", "-f", "collocation", "-f", "beamw", "-n",
                             "1,2,4")
        ours = bw.Scene.case("elastica").converge("collocation", "beamw", meshes=[1, 2, 4])
        theirs = [(s["formulation"], q["quantity"], m["elements"], bits(m["value"]),
                   bits(m["error"])) for s in record["series"] for q in s["quantities"]
                  for m in q["meshes"]]
        self.assertEqual(theirs, [(r["formulation"], r["quantity"], r["elements"],
                                   bits(r["value"]), bits(r["error"])) for r in ours])
        self.assertEqual(len(theirs), 2 * 3 * 3)
        self.assertEqual([bits(q["limit"]) for s in record["series"] for q in s["quantities"]],
                         [bits(limit["limit"]) for limit in ours.limits])
        self.assertEqual(record["sentence"], ours.sentence)

    def test_verify(self):
        path = self.folder / "verdicts.json"
        self.answered("verify", "-k", "elastica/default and collocation", "--json", path)
        theirs = json.loads(path.read_text(encoding="utf-8"))["verdicts"]
        ours = bw.verify("collocation", select="elastica/default",
                         results=self.folder / "results.h5")
        self.assertTrue(ours.passed)
        self.assertEqual([(v["quantity"], v["verdict"], bits(v["limit"])) for v in theirs],
                         [(v["quantity"], v["verdict"], bits(v["limit"])) for v in ours])
        self.assertTrue((self.folder / "results.h5").is_file())


if __name__ == "__main__":
    unittest.main()
