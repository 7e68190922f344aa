"""Scenes built of dicts: what is written, with which bits, and how mistakes are told."""
import math
import random
import unittest

import numpy

from harness.library.python.test.module import ModuleTest, bw, leaf


def written(scene):
    """Its text without the head."""
    return bw.scene.scene_text({}, scene._entries)[0]  # pylint: disable=protected-access


class Building(ModuleTest):

    def test_solves_like_its_file(self):
        """A scene of dicts, the text of it, and its file in the program: the same bits."""
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
        """Held in it, also as a copy; what leaves it is refused."""
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
        """Numbers of every size come back from the library as they were given."""
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
        """As in a scene file; what is refused is refused at its entry."""
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
        """Entries changed after a solution count in the next one; set values stay."""
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
        """A chain of ten leaves made by a loop is the leaf of ten elements."""
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
        """All mistakes together, each with line, column and the entry that was meant."""
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


if __name__ == "__main__":
    unittest.main()
