"""What notebooks show: every text escaped, digits as far as they are known, short."""
import copy
import importlib.util
import pickle
import sys
import unittest
from unittest import mock

from harness.library.python.test.module import ModuleTest, bw, leaf

HOSTILE = "<script>alert(1)</script>"
ESCAPED = "&lt;script&gt;alert(1)&lt;/script&gt;"


class Shown(ModuleTest):

    def shown(self, thing):
        """Its HTML, which is well-formed as far as brackets of tags go."""
        html = thing._repr_html_()  # pylint: disable=protected-access
        for tag in ("table", "tr", "td", "th", "caption", "details", "pre"):
            self.assertEqual(html.count(f"<{tag}>") + html.count(f"<{tag} "),
                             html.count(f"</{tag}>"), tag)
        return html

    def test_escaped(self):
        scene = leaf()
        scene.summary = HOSTILE
        html = self.shown(scene)
        self.assertIn(ESCAPED, html)
        self.assertNotIn("<script", html)
        convergence = bw.Scene.case("elastica").converge("beamw", meshes=[1, 2])
        document = copy.deepcopy(convergence.document)
        document["sentence"] = HOSTILE
        for series in document["series"]:
            series["formulation"] = HOSTILE
            for quantity in series["quantities"]:
                quantity["quantity"] = quantity["verdict"] = quantity["unit"] = HOSTILE
        records = bw.Records([{HOSTILE: HOSTILE, "<b>": 1.5}])
        verdicts = bw.Verdicts({"verdicts": [dict.fromkeys(
            ("case", "parameters", "formulation", "quantity", "verdict"), HOSTILE) |
            {"limit": 1.0, "limit_uncertainty": 0.1, "error": None}], "counts": {HOSTILE: 1},
            "outcome": HOSTILE, "broken_contracts": []})
        for thing in (bw.Convergence(document), records, verdicts):
            html = self.shown(thing)
            self.assertIn(ESCAPED, html)
            self.assertNotIn("<script", html)

    def test_digits(self):
        """A limit has the digits that its uncertainty leaves, a value those of its error."""
        known = bw.display.known
        self.assertEqual(known(3.14159265358979, 1e-4), "3.14159")
        self.assertEqual(known(3.14159265358979, 2e-2), "3.142")
        self.assertEqual(known(3.14159265358979, 0.5), "3.1")
        self.assertEqual(known(3.14159265358979, 10), "3.1")
        self.assertEqual(known(3.14159265358979, 0), "3.14159265359")
        self.assertEqual(known(3.14159265358979, None), "3.141593")
        self.assertEqual(known(None, 1), "")
        self.assertEqual(known(float("nan"), 1), "")
        self.assertEqual(bw.display.percent(-0.00123), "-0.12 %")
        self.assertEqual(bw.display.percent(None), "")

    def test_result(self):
        html = self.shown(bw.Scene.case("sheet_cantilever").solve("sheet_third", 1))
        self.assertIn("sheet_cantilever, sheet_third, n = 1: ok", html)
        self.assertIn("curve of 15 points", html)
        self.assertIn("-0.64 %", html)
        self.assertLess(len(html), 6000)

    def test_scene(self):
        """Parameters with their values; mistakes, where there are some."""
        html = self.shown(bw.Scene.case("sheet_cantilever").set(thickness=0.00175))
        for words in ("clamped sheet flexure", "<td>thickness</td><td>0.00175</td><td>m</td>",
                      "25 quantities", "beamwork: 1"):
            self.assertIn(words, html)
        scene = leaf(thicknes="<b>")
        self.assertIn("rectangle has no key", self.shown(scene))
        scene.nodes["tip"] = {"at": [float("nan"), 0, 0]}
        self.assertIn("is nan", self.shown(scene))

    def test_convergence_and_verdicts(self):
        html = self.shown(bw.Scene.case("elastica").converge("beamw", "collocation"))
        for words in ("n = 1", "limit", "order", "pass", "for 1 % in every quantity"):
            self.assertIn(words, html)
        verdicts = bw.verify("collocation", select="elastica/default")
        self.assertIn("PASS: 5 pass", self.shown(verdicts))

    def test_long_tables_are_cut(self):
        html = self.shown(bw.Records({"n": i} for i in range(1000)))
        self.assertIn("and 960 more", html)
        self.assertLess(len(html), 2000)


class Tables(ModuleTest):

    def test_records(self):
        records = bw.Scene.case("elastica").converge("beamw", "collocation", meshes=[1, 2])
        self.assertEqual(records.column("elements").tolist(),
                         [record["elements"] for record in records])
        one = records.where(formulation="beamw", elements=2)
        self.assertEqual({r["formulation"] for r in one}, {"beamw"})
        self.assertEqual(len(one) * 4, len(records))
        self.assertTrue((abs(records.column("error")) < 1).all())
        self.one_line(KeyError, "errors|elements", records.column, "errors")
        again = pickle.loads(pickle.dumps(records))
        self.assertEqual((list(again), again.sentence), (list(records), records.sentence))

    def test_missing_numbers(self):
        column = bw.Records([{"order": 2.0}, {"order": None}]).column("order")
        self.assertEqual([str(v) for v in column], ["2.0", "nan"])
        self.assertEqual(bw.Records([{"a": "x"}, {"a": 1}]).column("a").tolist(), ["x", 1])

    @unittest.skipIf(importlib.util.find_spec("pandas") is None, "needs pandas")
    def test_pandas(self):
        records = bw.Scene.case("elastica").converge("beamw", meshes=[1, 2])
        frame = records.frame()
        self.assertEqual(frame.shape, (len(records), len(records[0])))
        self.assertEqual(frame["value"].tolist(), records.column("value").tolist())
        self.assertEqual(len(bw.cases().frame()), len(bw.cases()))

    def test_frame(self):
        """With pandas, of its own kind; without, one line."""
        records = bw.Records([{"n": 1, "error": 0.5}, {"n": 2, "error": None}])
        made = mock.MagicMock()
        with mock.patch.dict(sys.modules, pandas=made):
            records.frame()
        made.DataFrame.from_records.assert_called_once_with(list(records))
        with mock.patch.dict(sys.modules, pandas=None):
            self.one_line(ImportError, "pandas", records.frame)


if __name__ == "__main__":
    unittest.main()
