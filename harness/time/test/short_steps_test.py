"""Constant steps must end at jumps and at the end of a motion without a very short last step, whose rates would be
round-off."""
import math
import unittest

from cases.format.test.scene_case import SceneCase, values

# A mass of 1 kg on a spring of 100 N/m: x = 0.1 sin(10 t) without loads.
HEAD = """beamwork: 1
sections: {s: {constants: {A: 1, Iy: 1, Iz: 1, It: 1}, young: 100, shear_modulus: 100}}
nodes:
  g: {at: [0, 0, 0], hold: all}
  n: {at: [1, 0, 0], mass: 1, hold: [uy, uz, rx, ry, rz]}
members: {m: {from: g, to: n, section: s, y: [0, 1, 0]}}
omit: [shear, wagner_torque]
"""
FREE = HEAD + """analyses: {go: {motion: {stations: [0.4, %r], start: {velocity: [1, 0, 0]}, integrator: %s, step: %s}}}
quantities:
  a: {rate: {analysis: go, node: n, component: ux, of: acceleration}}
  greatest: {rate: {analysis: go, node: n, component: ux, of: acceleration, take: max}}
"""
JERK = """  j: {rate: {analysis: go, node: n, component: ux, of: jerk}}
  early: {rate: {analysis: go, node: n, component: ux, of: jerk, at: 0.4}}
"""
JUMPS = HEAD + """loads:
  p: {force: [1, 0, 0], on: n, pieces: [{until: 0.3, is: 0}, {is: 30}]}
  q: {force: [1, 0, 0], on: n, pieces: [{until: 3*0.1, is: 0}, {is: 30}]}
analyses:
  first: {motion: {stations: [%s], integrator: %s, step: 0.01}}
  go: {motion: {about: first, stations: [1.1], integrator: %s, step: 0.01}}
quantities:
  a: {rate: {analysis: go, node: n, component: ux, of: acceleration}}
  greatest: {rate: {analysis: go, node: n, component: ux, of: acceleration, take: max}}
"""
SHORT = HEAD + """analyses: {go: {motion: {stations: [0.001234567, 0.002], start: {velocity: [1, 0, 0]}, integrator: %s, step: %s}}}
quantities:
  a: {rate: {analysis: go, node: n, component: ux, of: acceleration, at: 0.001234567}}
  j: {rate: {analysis: go, node: n, component: ux, of: jerk, at: 0.001234567}}
  curve: {rate: {analysis: go, node: n, component: ux, of: jerk, take: curve}}
  largest: {rate: {analysis: go, node: n, component: ux, of: jerk, take: min}}
"""
SCHEMES = (("radau", 1e-6), ("explicit", 1e-6), ("alpha", 2e-4))


class ShortStepsTest(SceneCase):

    def solve(self, text):
        record = self.record("solve", "--scene", self.scene(text), "-f", "collocation", "-n", 1)
        return values(record), [one["step"] for one in record["motion"] if one["step"] > 0]

    def test_long_sum(self):
        for scheme, most in SCHEMES:
            for end in (1.1, 2.0):
                got, steps = self.solve(FREE % (end, scheme, "1e-4") + (JERK if scheme != "alpha" else ""))
                why = (scheme, end)
                self.assertEqual(len(steps), round(end/1e-4), why)
                self.assertLess(max(abs(step/1e-4 - 1) for step in steps), 1e-10, why)
                self.assertAlmostEqual(got["a"], -10*math.sin(10*end), delta=most, msg=why)
                self.assertAlmostEqual(got["greatest"], 10, delta=most, msg=why)
                if scheme != "alpha":
                    self.assertAlmostEqual(got["j"], -100*math.cos(10*end), delta=0.05, msg=why)
                    self.assertAlmostEqual(got["early"], -100*math.cos(4), delta=0.05, msg=why)

    def test_remainder(self):
        for scheme, _ in SCHEMES:
            for beyond, count, last in ((1e-9, 10, 0.1), (1e-4, 11, 0.05), (0.03, 11, 0.03)):
                _, steps = self.solve(FREE % (1 + beyond, scheme, "0.1"))
                self.assertEqual(len(steps), count, (scheme, beyond))
                self.assertAlmostEqual(steps[-1], last, delta=1e-4, msg=(scheme, beyond))
                self.assertAlmostEqual(sum(steps), 1 + beyond, delta=1e-14, msg=(scheme, beyond))

    def test_equal_instants(self):
        """Both loads jump at 0.3 s, after which the motion must be x = 0.6 (1 - cos(10 (t - 0.3)))."""
        for scheme, most in (("radau", 1e-6), ("explicit", 1e-5), ("alpha", 2)):
            for end in ("0.2", "0.3", "3*0.1"):
                got, steps = self.solve(JUMPS % (end, scheme, scheme))
                self.assertEqual(len(steps), 110, (scheme, end))
                self.assertGreater(min(steps), 0.00999, (scheme, end))
                self.assertAlmostEqual(got["a"], 60*math.cos(8), delta=most, msg=(scheme, end))
                self.assertAlmostEqual(got["greatest"], 60, delta=most, msg=(scheme, end))

    def test_rounding(self):
        time = 0.001234567
        exact = {"a": -10*math.sin(10*time), "j": -100*math.cos(10*time), "largest": -100}
        for scheme in ("radau", "explicit"):
            for step, most in (("1e-4", 1e-5), ("1e-5", 1e-2), ("3e-7", math.inf)):
                record = self.record("solve", "--scene", self.scene(SHORT % (scheme, step)), "-f", "collocation", "-n", 1)
                got = {one["quantity"]: one for one in record["quantities"]}
                for name, value in exact.items():
                    one, why = got[name], (scheme, step, name)
                    if most < math.inf or name == "a":
                        self.assertLess(abs(one["value"]/value - 1), one["rounding"] + 1e-7, why)
                        self.assertLess(one["rounding"], min(most, 1e-2), why)
                    else:
                        self.assertEqual(one["status"], "no_value", why)
                        self.assertIn("the rounding error is up to", one["reason"], why)
                self.assertEqual(got["curve"]["status"], "no_value" if most == math.inf else "ok")


if __name__ == "__main__":
    unittest.main()
