"""Section constants of outlines (sectionproperties) compared with exact values and with the thin-walled sections of
beamwork."""
import importlib.util
import math
import unittest

from harness.library.python.test.module import ModuleTest, bw

INSTALLED = importlib.util.find_spec("sectionproperties") is not None
MATERIAL = {"young": 210e9, "shear_modulus": 81e9}


def rectangle(width, height):
    y, z = height / 2, width / 2
    return [[-y, -z], [y, -z], [y, z], [-y, z]]


def channel(depth, flange, t):
    out, inner = depth / 2 + t / 2, depth / 2 - t / 2
    return [[t / 2, -out], [t / 2, out], [-flange, out], [-flange, inner], [-t / 2, inner],
            [-t / 2, -inner], [-flange, -inner], [-flange, -out]]


class Outline(ModuleTest):

    def ours(self, words):
        names = ("A", "Iy", "Iz", "It", "Iw", "ys", "zs")
        text = f"""beamwork: 1
sections:
  s: {{{words}, young: 210e9, shear_modulus: 81e9}}
nodes: {{a: {{at: [0, 0, 0], hold: all}}, b: {{at: [1, 0, 0]}}}}
members: {{m: {{from: a, to: b, section: s, y: [0, 1, 0]}}}}
loads:
""" + "".join(f"  {n}: {{force: [s.{n}*1e12, 0, 0], on: b}}\n" for n in names)
        lines = bw.Scene.text(text).write().splitlines()
        return {n: float(line.split("[")[1].split(",")[0]) * 1e-12
                for n in names for line in lines if line.startswith(f"  {n}: {{force")}

    @unittest.skipUnless(INSTALLED, "needs sectionproperties")
    def test_rectangle(self):
        got, angle = bw.outline(rectangle(0.1, 0.05), parts=4000, **MATERIAL)
        ours, c = self.ours("rectangle: {width: 0.1, thickness: 0.05}"), got["constants"]
        self.assertEqual(angle, 0)
        for name, bound in (("A", 1e-12), ("Iy", 1e-9), ("Iz", 1e-9), ("It", 1e-5)):
            self.assertAlmostEqual(c[name] / ours[name], 1, delta=bound, msg=name)
        for name in ("ys", "zs", "wagner_y", "wagner_z"):
            self.assertAlmostEqual(c[name], 0, delta=1e-6 * 0.1**(1 if name.endswith("s") else 5))
        exact = (0.1**5 * 0.05 + 0.1 * 0.05**5) / 1440
        self.assertAlmostEqual(c["wagner_torque"] / exact, 1, delta=1e-9)
        self.assertAlmostEqual(c["F"][0] * c["A"], 1.2, delta=1e-4)
        self.assertAlmostEqual(c["F"][4] * c["A"], 1.2, delta=1e-4)

    @unittest.skipUnless(INSTALLED, "needs sectionproperties")
    def test_thin_channel(self):
        apart = []
        for t in (4e-3, 2e-3):
            got, _ = bw.outline(channel(0.2, 0.1, t), parts=6000, **MATERIAL)
            c, ours = got["constants"], self.ours(
                f"channel: {{depth: 0.2, flange: 0.1, flange_thickness: {t}, web_thickness: {t}}}")
            for name, bound in (("A", 1e-9), ("Iy", 2e-3), ("Iz", 2e-3), ("Iw", 5e-3), ("It", 0.02)):
                self.assertAlmostEqual(c[name] / ours[name], 1, delta=bound, msg=(name, t))
            apart.append(abs(c["ys"] - ours["ys"]))
            self.assertLess(apart[-1], 0.01 * abs(ours["ys"]))
        self.assertLess(apart[1], apart[0])

    @unittest.skipUnless(INSTALLED, "needs sectionproperties")
    def test_turned(self):
        points, turn = channel(0.2, 0.1, 0.02), 0.3
        c, s = math.cos(turn), math.sin(turn)
        there = [[0.7 + c * y - s * z, -0.2 + s * y + c * z] for y, z in points]
        one, first = bw.outline(points, **MATERIAL)
        other, angle = bw.outline(there, **MATERIAL)
        self.assertEqual(first, 0)
        self.assertAlmostEqual(angle, turn, delta=1e-9)
        for name in ("A", "Iy", "Iz", "It", "Iw", "ys", "wagner_y", "wagner_torque"):
            self.assertAlmostEqual(other["constants"][name] / one["constants"][name], 1, delta=2e-3,
                                   msg=name)

    @unittest.skipUnless(INSTALLED, "needs sectionproperties")
    def test_tube_and_solution(self):
        got, _ = bw.outline(rectangle(0.1, 0.1), [rectangle(0.08, 0.08)], **MATERIAL)
        c = got["constants"]
        self.assertAlmostEqual(c["Iy"] / ((0.1**4 - 0.08**4) / 12), 1, delta=1e-9)
        scene = bw.Scene()
        scene.sections["s"] = got
        scene.nodes["a"] = {"at": [0, 0, 0], "hold": "all"}
        scene.nodes["b"] = {"at": [1, 0, 0]}
        scene.members["m"] = {"from_": "a", "to": "b", "section": "s", "y": [0, 1, 0],
                              "warping": "free"}
        scene.loads["t"] = {"moment": [100, 0, 0], "on": "b"}
        scene.analyses["run"] = {"linear": {}}
        scene.quantities["rx"] = {"displacement": {"analysis": "run", "node": "b",
                                                   "component": "rx"}}
        self.assertAlmostEqual(scene.solve("collocation", 2)["rx"] / (100 / (81e9 * c["It"])), 1,
                               delta=1e-3)

    @unittest.skipUnless(INSTALLED, "needs sectionproperties")
    def test_no_area(self):
        with self.assertRaisesRegex(ValueError, "does not enclose an area"):
            bw.outline([[0, 0], [1, 1], [1, 0], [0, 1]], **MATERIAL)

    @unittest.skipIf(INSTALLED, "sectionproperties is installed")
    def test_not_installed(self):
        with self.assertRaisesRegex(bw.Error, "pip install sectionproperties"):
            bw.outline(rectangle(0.1, 0.1), **MATERIAL)
