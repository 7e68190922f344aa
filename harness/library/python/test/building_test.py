"""Scenes built in Python, their motions, and the display of results in notebooks."""
import copy
import importlib.util
import math
import pickle
import random
import sys
import unittest
from unittest import mock

import numpy

from harness.library.python.test.module import ModuleTest, bw, leaf


def written(scene):
    return bw.scene.scene_text({}, scene._entries)[0]  # pylint: disable=protected-access


class Building(ModuleTest):

    def test_solves_like_its_file(self):
        scene = leaf()
        result = scene.solve("beamw", 2)
        path = self.folder / "leaf.yaml"
        text = scene.write(path)
        record = self.record("solve", "--scene", path, "-f", "beamw", "-n", 2)
        values = {q["quantity"]: q["value"] for q in record["quantities"]}
        self.assertGreater(abs(values["tip_uy"]), 1e-3)
        self.assertEqual(values, dict(result.values))
        self.assertEqual(values, dict(bw.Scene.text(text).solve("beamw", 2).values))

    def test_plane(self):
        scene = leaf()
        space = scene.solve("beamw", 2)
        scene.plane = "xy"
        for held in (scene, scene.copy()):
            self.assertIn("\nplane: xy\n", held.write())
            flat = held.solve("beamw", 2)
            self.assertAlmostEqual(flat.values["tip_uy"] / space.values["tip_uy"], 1, 9)
        scene.loads["push"]["force"] = [0, 1, 1]
        with self.assertRaises(bw.Refused):
            scene.solve("beamw", 2)

    def test_bits_of_numbers(self):
        draw = random.Random(1)
        numbers = [math.ldexp(draw.uniform(0.5, 1), draw.randint(-30, 30)) for _ in range(60)]
        numbers += [0.1, 1 / 3, 5e-7, 123456789.0, numpy.nextafter(1, 2)]
        for i in range(0, len(numbers), 3):
            scene = leaf()
            at = [0.1, *numbers[i:i + 2]]
            scene.nodes["tip"]["at"] = numpy.array(at)
            scene.members["leaf"]["y"] = [0, 0.3, 0.7]
            line = next(line for line in scene.write().splitlines() if "0.1" in line)
            inside = line.partition("at: [")[2].partition("]")[0]
            self.assertEqual([float(v) for v in inside.split(",")], at)

    def test_numpy_is_written(self):
        entry = {"a": numpy.float64(0.5), "b": numpy.arange(3), "c": numpy.eye(2), "d": True,
                 "e": range(2), "f": (1, 2.5), "g": numpy.int32(7), "from_": "x", "h": "2*pi/3",
                 "i": [{"is_": "t"}]}
        scene = bw.Scene()
        scene.nodes["n"] = entry
        self.assertIn("n: {a: 0.5, b: [0, 1, 2], c: [[1.0, 0.0], [0.0, 1.0]], d: yes, e: [0, 1], "
                      'f: [1, 2.5], g: 7, from: x, h: "2*pi/3", i: [{is: t}]}', written(scene))

    def test_loads_on_parts_of_members(self):
        scene = leaf()
        scene.loads["row_$i"] = {"for_": {"i": "0..1"}, "force": [0, 1, 0], "on": "leaf",
                                 "where": "1/4 + i/2", "follower": True}
        scene.loads["wind"] = {"distributed": numpy.array([0, 1, 0]), "on": "leaf", "from_": 0.25,
                               "to": numpy.float64(0.75), "to_value": [0, 3, 0], "lumped": True}
        lines = [line.strip() for line in scene.write().splitlines()]
        for line in ("row_0: {force: [0, 1, 0], on: leaf, where: 0.25, follower: true}",
                     "row_1: {force: [0, 1, 0], on: leaf, where: 0.75, follower: true}",
                     "wind: {distributed: [0, 1, 0], on: leaf, from: 0.25, to: 0.75, "
                     "to_value: [0, 3, 0], lumped: yes}"):
            self.assertIn(line, lines)
        scene.loads["wind"]["to"] = 0.125
        with self.assertRaises(bw.Refused) as caught:
            scene.write()
        self.assertIn("from 0.25 to 0.125 of the member's length", str(caught.exception))
        self.assertIn("loads['wind']", str(caught.exception))

    def test_entries_may_change(self):
        scene = leaf()
        scene.parameters["push"] = {"value": 1, "unit": "N"}
        scene.loads["push"]["force"] = [0, "push", 0]
        before = scene.solve("beamw", 1)["tip_uy"]
        scene.set(push=2)
        self.assertAlmostEqual(scene.solve("beamw", 1)["tip_uy"] / before, 2, 12)
        scene.sections["leaf"]["rectangle"]["thickness"] = 1e-3
        thicker = scene.solve("beamw", 1)["tip_uy"]
        self.assertAlmostEqual(thicker * 8 / before, 2, 3)
        other = scene.copy()
        other.loads["push"]["force"] = [0, "2*push", 0]
        self.assertAlmostEqual(other.solve("beamw", 1)["tip_uy"] / thicker, 2, 12)
        self.assertEqual(scene.solve("beamw", 1)["tip_uy"], thicker)

    def test_loops_of_python(self):
        whole, chain = leaf(), leaf()
        del chain.members["leaf"]
        chain.nodes["n0"] = chain.nodes.pop("base")
        for i in range(10):
            if i < 9:
                chain.nodes[f"n{i + 1}"] = {"at": numpy.array([0.1 * (i + 1) / 10, 0, 0])}
            chain.members[f"m{i}"] = {"from_": f"n{i}", "to": f"n{i + 1}" if i < 9 else "tip",
                                      "section": "leaf", "y": [0, 1, 0]}
        self.assertAlmostEqual(
            chain.solve("beamw", 1)["tip_uy"] / whole.solve("beamw", 10)["tip_uy"], 1, 9)

    def test_mistakes_have_places(self):
        scene = leaf(thicknes=1)
        scene.nodes["tip"] = {"at": [0.1, 0]}
        error = self.one_line(bw.Refused, "sections['leaf']|thicknes|thickness|1 more", scene.solve)
        self.assertEqual([m.entry for m in error.mistakes], ["sections['leaf']", "nodes['tip']"])
        lines = written(scene).splitlines()
        for mistake in error.mistakes:
            self.assertTrue(mistake.column > 0 and mistake.line > 0, mistake)
        self.assertIn("thicknes", error.mistakes[0].text)
        self.assertGreater(len(lines), 5)

    def test_mistakes_of_a_file(self):
        path = self.folder / "bad.yaml"
        path.write_text(leaf().write().replace("young:", "yong:"), encoding="utf-8")
        error = self.one_line(bw.Refused, f"{path}:|yong|young", bw.Scene.open, path)
        line, column = error.mistakes[0].line, error.mistakes[0].column
        told = path.read_text(encoding="utf-8").splitlines()[line - 1][column - 1:]
        self.assertTrue(told.startswith("yong"), told)

    def test_about(self):
        about = bw.Scene.case("sheet_cantilever").set(length=0.2).about
        length, = about["parameters"].where(name="length")
        self.assertEqual((length["value"], length["default"], length["unit"]), (0.2, 0.1, "m"))
        self.assertEqual([q["name"] for q in about["quantities"] if q["is_curve"]],
                         ["C_xx_curve", "C_zz_curve"])
        self.assertIn("tip_uy", [q["name"] for q in leaf().about["quantities"]])

    def test_parameters(self):
        scene = bw.Scene.case("sheet_cantilever")
        changed = scene.set(thickness=numpy.float64(0.5e-3), moment_convention="spatial")
        self.assertIs(changed, scene)
        self.assertEqual(scene.solve("sheet_third", 1).parameters["thickness"], 0.5e-3)
        self.one_line(bw.Refused, "thicknes", scene.set, length=0.2, thicknes=1)
        self.one_line(bw.Refused, "thickness", scene.set, length=0.2, thickness=-1)
        parameters = scene.solve("sheet_third", 1).parameters
        self.assertEqual((parameters["length"], parameters["thickness"]), (0.1, 0.5e-3))


def swing():
    scene = bw.Scene("swing")
    scene.sections["tube"] = {"tube": {"diameter": 20e-3, "thickness": 1e-3}, "young": 70e9,
                              "shear_modulus": 26e9, "density": 2700}
    scene.nodes["hub"] = {"at": [0, 0, 0], "hold": ["ux", "uy", "uz", "rx", "ry"],
                          "drive": {"rz": "turn"}}
    scene.nodes["tip"] = {"at": [1, 0, 0], "mass": 0.3}
    scene.members["arm"] = {"from": "hub", "to": "tip", "section": "tube", "y": [0, 1, 0]}
    scene.motions["turn"] = {"unit": "rad", "pieces": [
        {"until": 0.5, "is": "30*deg*(2*t - sin(4*pi*t)/(2*pi))"}, {"is": "30*deg"}]}
    scene.analyses["swing"] = {"motion": {"stations": "0..1/10", "integrator": "radau",
                                          "tolerance": 1e-5}}
    seen = {"analysis": "swing", "node": "tip", "from": "hub", "component": "uy"}
    scene.quantities["ahead"] = {"relative": {**seen, "take": "max"}}
    scene.quantities["bend"] = {"relative": {**seen, "take": "curve"}}
    scene.quantities["kinetic"] = {"energy": {"analysis": "swing", "of": "kinetic"}}
    scene.omit = ["trapeze", "wagner_torque"]
    return scene


class Motion(ModuleTest):

    def test_the_same_bits_as_the_program(self):
        path = self.folder / "swing.yaml"
        swing().write(path)
        record = self.record("solve", "--scene", path, "-f", "beamw", "-n", 2)
        result = swing().solve("beamw", 2)
        for quantity in (q for q in record["quantities"] if q["quantity"] in result):
            self.assertEqual(quantity["value"], result[quantity["quantity"]])
            self.assertEqual(quantity["x"], result.at[quantity["quantity"]])
        for name, column in result.motion.items():
            self.assertEqual([row[name] for row in record["motion"]], list(column), name)
        self.assertEqual(set(result.motion), set(record["motion"][0]) - {"analysis", "analysis_name"})

    def test_steps_outlive_their_result(self):
        result = swing().solve("beamw", 2, shapes=20)
        self.assertTrue(0.3 < result.at["ahead"] < 0.4)
        self.assertNotIn("bend", result.at)
        self.assertEqual(result.shapes.kinds[-1], "motion")
        self.assertEqual(result.shapes.values[-1], 1)
        kinetic, last = result.motion["kinetic"], result["kinetic"]
        del result
        self.assertEqual(kinetic[-1], last)
        with self.assertRaises(ValueError):
            kinetic[0] = 1
        self.assertEqual(numpy.argmax(kinetic) > 0, True)

    def test_nothing_moves(self):
        result = leaf().solve("beamw", 2)
        self.assertEqual(result.motion, {})
        self.assertEqual(dict(result.at), {})


HOSTILE = "<script>alert(1)</script>"
ESCAPED = "&lt;script&gt;alert(1)&lt;/script&gt;"


class Shown(ModuleTest):

    def shown(self, thing):
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
        records = bw.Records([{"n": 1, "error": 0.5}, {"n": 2, "error": None}])
        made = mock.MagicMock()
        with mock.patch.dict(sys.modules, pandas=made):
            records.frame()
        made.DataFrame.from_records.assert_called_once_with(list(records))
        with mock.patch.dict(sys.modules, pandas=None):
            self.one_line(ImportError, "pandas", records.frame)


@unittest.skipUnless(importlib.util.find_spec("matplotlib"), "needs matplotlib")
class Drawn(ModuleTest):

    def lines(self, figure, axes=0):
        figure.savefig(self.folder / "figure.png")
        self.assertGreater((self.folder / "figure.png").stat().st_size, 1000)
        return [line.get_xydata() for line in figure.axes[axes].get_lines()]

    def test_result(self):
        result = bw.Scene.case("sheet_cantilever").solve("sheet_third", 1)
        line, = self.lines(result.plot("C_zz_curve"))
        self.assertTrue((line == numpy.transpose(result.curve("C_zz_curve"))).all())
        self.assertEqual(len(result.plot().axes), len(result.curves))
        moving = swing().solve("beamw", 2, shapes=20)
        figure = moving.plot("bend")
        self.lines(figure)
        self.assertEqual([figure.axes[0].get_xlabel(), figure.axes[0].get_ylabel()], ["time [s]", "bend [m]"])
        self.assertGreater(len(self.lines(moving.shapes.plot(scale=2))), 10)
        self.one_line(ValueError, "no curve", leaf().solve("beamw", 2).plot)

    def test_tables(self):
        convergence = bw.Scene.case("elastica").converge("beamw", "collocation", meshes=[1, 2])
        figure = convergence.plot("w_over_L")
        errors = [abs(r["error"]) for r in convergence.where(formulation="beamw", quantity="w_over_L")]
        self.assertEqual(list(self.lines(figure)[0][:, 1]), errors)
        self.assertEqual(len(convergence.plot().axes), 3)
        self.lines(bw.verify("collocation", select="elastica/default").plot())
        records = bw.Records([{"load": 1, "error": -0.1, "f": "a"}, {"load": 2, "error": 0.2, "f": "a"},
                              {"load": 2, "error": None, "f": "b"}])
        line, = self.lines(records.plot("load", "error", by="f", log=True))
        self.assertEqual(line.tolist(), [[1, 0.1], [2, 0.2]])
        self.one_line(KeyError, "no column 'g'", records.plot, "load", "error", "g")
        self.assertEqual(len(self.lines(bw.Document({"t": list(records)}).plot("t", "load", "error"))), 1)

    @unittest.skipUnless(importlib.util.find_spec("pandas"), "needs pandas")
    def test_frames(self):
        result = swing().solve("beamw", 2)
        frame = result.frame().set_index("quantity")
        self.assertEqual(frame["value"]["ahead"], result["ahead"])
        self.assertEqual(frame["at"]["ahead"], result.at["ahead"])
        self.assertEqual(bw.schema().frame("records").shape[0], len(bw.schema()["records"]))


if __name__ == "__main__":
    unittest.main()
