"""Means, root mean squares and level crossings of every kind of quantity, compared with closed forms."""
import math
import unittest

from cases.format.test.scene_case import SceneCase

# A mass on a bar. The mass stretches the bar (10 rad/s) and bends it between parallel ends (5 rad/s). The amplitudes
# are so small that the two vibrations are independent.
BAR = """beamwork: 1
sections: {bar: {rectangle: {width: 0.5, thickness: 0.5}, young: 400, shear_modulus: 150}}
nodes:
  wall: {at: [0, 0, 0], hold: all}
  tip:  {at: [1, 0, 0], hold: [uz, rx, ry, rz], mass: 1}
members: {bar: {from: wall, to: tip, section: bar, y: [0, 1, 0], warping: fixed}}
analyses: {go: {motion: {stations: [2], step: %s, integrator: %s, start: {velocity: [1e-7, 1e-7, 0]}}}}
omit: [shear]
quantities:
"""
V = 1e-7


def x(t):
    return V/10*math.sin(10*t)


def y(t):
    return V/5*math.sin(5*t)


def vx(t):
    return V*math.cos(10*t)


def vy(t):
    return V*math.cos(5*t)


KINDS = {
    "force": ("reaction: {analysis: go, node: wall, component: ux", lambda t: -100*x(t), (math.pi/10, math.pi/10)),
    "moment": ("reaction: {analysis: go, node: wall, component: rz", lambda t: -25*y(t)/2, (math.pi/5, math.pi/5)),
    "N": ("internal: {analysis: go, member: bar, where: 0.5, resultant: N", lambda t: 100*x(t), (math.pi/10, math.pi/10)),
    "Mz": ("internal: {analysis: go, member: bar, where: 0, resultant: Mz", lambda t: 25*y(t)/2, (math.pi/5, math.pi/5)),
    "stress": ("stress: {analysis: go, member: bar, where: 0, measure: normal_max",
               lambda t: 400*x(t) + 600*abs(y(t)), None),
    "kinetic": ("energy: {analysis: go, of: kinetic", lambda t: (vx(t)**2 + vy(t)**2)/2, None),
    "strain": ("energy: {analysis: go, of: strain", lambda t: (100*x(t)**2 + 25*y(t)**2)/2, None),
    "energy": ("energy: {analysis: go, of: energy", lambda t: V*V, None),
    "momentum": ("momentum: {analysis: go, component: px", vx, (math.pi/20, math.pi/10)),
    "position": ("displacement: {analysis: go, node: tip, component: ux", x, (math.pi/10, math.pi/10)),
    "apart": ("relative: {analysis: go, node: tip, from: wall, component: uy", y, (math.pi/5, math.pi/5)),
    "velocity": ("rate: {analysis: go, node: tip, component: ux", vx, (math.pi/20, math.pi/10)),
    "within": ("deflection: {analysis: go, member: bar, where: 0.5, component: uy", lambda t: y(t)/2, (math.pi/5, math.pi/5)),
    "acceleration": ("rate: {analysis: go, node: tip, component: ux, of: acceleration", lambda t: -100*x(t),
                     (math.pi/10, math.pi/10)),
    "jerk": ("rate: {analysis: go, node: tip, component: uy, of: jerk", lambda t: -25*vy(t), (math.pi/10, math.pi/5))}
WINDOWS = {"whole": (0, 2), "part": (0.333, 1.777), "step": (0.5003, 0.5007)}
# integrator, step, allowed error relative to the root mean square, and the kinds that the integrator does not compute
SCHEMES = (("radau", 0.01, 1e-7, {}), ("explicit", 0.02, 1e-7, {}),
           ("alpha", 0.005, 6e-4, {"jerk"}), ("conserving", 0.005, 6e-4, {"acceleration", "jerk"}))

JUMP = """beamwork: 1
sections: {bar: {constants: {A: 1, Iy: 1, Iz: 1, It: 1}, young: 100, shear_modulus: 100}}
nodes:
  wall: {at: [0, 0, 0], hold: all}
  mass: {at: [1, 0, 0], mass: 1, hold: [uy, uz, rx, ry, rz]}
members: {bar: {from: wall, to: mass, section: bar, y: [0, 1, 0]}}
loads:
  here:  {force: [1, 0, 0], on: wall, pieces: [{until: 0.3, is: 1}, {is: -2}]}
  there: {force: [1, 0, 0], on: mass, pieces: [{until: 0.3, is: 0}, {is: 1}]}
analyses: {go: {motion: {stations: [1], step: %s, integrator: %s}}}
quantities:
  mean: {reaction: {analysis: go, node: wall, component: ux, take: mean}}
  rms:  {reaction: {analysis: go, node: wall, component: ux, take: rms}}
  late: {reaction: {analysis: go, node: wall, component: ux, take: mean}, when: {from: 0.3}}
  when: {reaction: {analysis: go, node: wall, component: ux, take: crossing}}
  a:    {rate: {analysis: go, node: mass, component: ux, of: %s, take: crossing}, when: {level: %s}}
  gone: {reaction: {analysis: go, node: wall, component: ux, take: crossing}, when: {level: 5}}
omit: [shear, wagner_torque]
"""

INSTANTS = """beamwork: 1
sections: {bar: {constants: {A: 1, Iy: 1, Iz: 1, It: 1}, young: 100, shear_modulus: 100}}
nodes:
  wall: {at: [0, 0, 0], hold: all}
  mass: {at: [1, 0, 0], mass: 1, hold: [uy, uz, rx, ry, rz]}
members: {bar: {from: wall, to: mass, section: bar, y: [0, 1, 0]}}
loads:
  here: {force: [1, 0, 0], on: wall, time: 1 + t}
  jump: {force: [1, 0, 0], on: wall, path: [0, 5], factor: [0, 0], pieces: [{until: 0.3, is: 0}, {is: -4}]}
analyses:
  path: {static: {stations: [5]}}
  go:   {motion: {about: path, stations: [0, 0.3, 0.5], step: 0.01, integrator: %s}}
quantities:
  curve: {reaction: {analysis: go, node: wall, component: ux, take: curve}}
  least: {reaction: {analysis: go, node: wall, component: ux, take: min}}
  most:  {reaction: {analysis: go, node: wall, component: ux, take: max}}
omit: [shear, wagner_torque]
"""


def mean(f, begin, end, count=4000):
    """Returns the mean of f by Gauss's rule with two points in each of `count` intervals."""
    h = (end - begin)/count
    nodes = (begin + (i + k)*h for i in range(count) for k in (0.5 - math.sqrt(1/12), 0.5 + math.sqrt(1/12)))
    return sum(map(f, nodes))/(2*count)


class MeansTest(SceneCase):

    def solve(self, text):
        record = self.record("solve", "--scene", self.scene(text), "-f", "collocation", "-n", 1)
        return record, {one["quantity"]: one for one in record["quantities"]}

    def test_table(self):
        for scheme, step, most, none in SCHEMES:
            lines = []
            for kind, (keys, _, passes) in KINDS.items():
                for window, (begin, end) in WINDOWS.items():
                    lines += [f"  {kind}_{window}_{take}: {{{keys}, take: {take}}}, when: {{from: {begin}, until: {end}}}}}"
                              for take in ("mean", "rms")]
                lines += [f"  {kind}_{take}: {{{keys}, take: {take}}}, when: {{from: 0.05, direction: either}}}}"
                          for take in ("crossing", "period", "per_second") if passes]
            text = BAR % (step, scheme) + "\n".join(line for line in lines if line.split("_")[0].strip() not in none)
            _, got = self.solve(text)
            for kind, (_, f, passes) in KINDS.items():
                if kind in none:
                    continue
                allowed = 1e-4 if kind == "jerk" else most
                for window, (begin, end) in WINDOWS.items():
                    size = math.sqrt(mean(lambda t, f=f: f(t)**2, begin, end))
                    for take, exact in (("mean", mean(f, begin, end)), ("rms", size)):
                        one = got[f"{kind}_{window}_{take}"]
                        why = (scheme, kind, window, take, one["value"], exact, one["rounding"])
                        self.assertEqual(one["status"], "ok", why)
                        stated = one["rounding"]*abs(one["value"])
                        scale = V if kind in ("momentum", "velocity") else size
                        self.assertLess(abs(one["value"] - exact), 6*allowed*scale + stated, why)
                        self.assertLess(stated, (1e-3 if kind == "stress" else 3*max(allowed, 1e-6))*size, why)
                for take, exact in zip(("crossing", "period", "per_second"), (*passes, 1/passes[1]) if passes else ()):
                    one = got[f"{kind}_{take}"]
                    self.assertAlmostEqual(one["value"]/exact, 1, delta=3*allowed, msg=(scheme, kind, take))

    def test_jump(self):
        def after(t):
            return 2 - (1 - math.cos(10*t))
        for scheme, step, most in (("radau", 0.01, 1e-8), ("explicit", 0.02, 1e-8), ("alpha", 1e-3, 2e-4),
                                   ("conserving", 1e-3, 2e-4)):
            of, level = ("velocity", 0.05) if scheme == "conserving" else ("acceleration", 0.5)
            _, got = self.solve(JUMP % (step, scheme, of, level))
            late = 2 - 1 + math.sin(7)/7
            square = mean(lambda t: after(t)**2, 0, 0.7)
            for name, exact in (("mean", -0.3 + 0.7*late), ("late", late), ("rms", math.sqrt(0.3 + 0.7*square)),
                                ("when", 0.3), ("a", 0.3 if of == "acceleration" else 0.3 + math.asin(0.5)/10)):
                self.assertAlmostEqual(got[name]["value"], exact, delta=most, msg=(scheme, name))
            self.assertEqual(got["gone"]["status"], "no_value")
            self.assertIn("crosses the level too few times", got["gone"]["reason"])

    def test_instants(self):
        for scheme, *_ in SCHEMES:
            record, got = self.solve(INSTANTS % scheme)
            for value, exact in zip(record["curves"][0]["curve_value"], (-1, 2.7, 2.5)):
                self.assertAlmostEqual(value, exact, delta=1e-9, msg=scheme)
            self.assertAlmostEqual(got["least"]["value"], -1.3, delta=1e-9, msg=scheme)
            self.assertAlmostEqual(got["most"]["value"], 2.7, delta=1e-9, msg=scheme)


if __name__ == "__main__":
    unittest.main()
