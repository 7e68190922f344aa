"""Accelerations, jerks and spectra of motions, compared with closed forms."""
import cmath
import json
import math
import unittest

from harness.tools.kit.program import ProgramTest, run

PUSHED = """beamwork: 1
let: {m: 2, k: 200, J: 1, c: 100}
sections:
  post: {tube: {diameter: 40e-3, thickness: 2e-3}, young: 70e9, shear_modulus: 26e9}
nodes:
  mass:  {at: [0, 0, 0], mass: m, inertia: [J, J, J, 0, 0, 0]}
  aside: {at: [1, 0, 0], part_of: mass}
  end:   {at: [0, 0, 0.5]}
members: {post: {from: mass, to: end, section: post, y: [0, 1, 0]}}
springs: {s: {to: mass, stiffness: [k, k, k, c, c, c]}}
loads:
  push: {force: [0, 20, 0], on: mass, time: 1}
  spin: {moment: [0, 0, 1], on: mass, time: 1}
analyses: {go: {motion: {stations: 0..1/20, step: %(step)r, integrator: %(integrator)s, start: {velocity: [0, 0.1, 0]}}}}
quantities:
  a: {rate: {analysis: go, node: mass, component: uy, of: acceleration, take: curve}}
  w: {rate: {analysis: go, node: mass, component: rz, of: acceleration, take: curve}}
  x: {rate: {analysis: go, node: aside, component: ux, of: acceleration, take: curve}}
  top: {rate: {analysis: go, node: mass, component: uy, of: acceleration, take: max}}
%(more)s
"""
JERKS = """  j: {rate: {analysis: go, node: mass, component: uy, of: jerk, take: curve}}
  y: {rate: {analysis: go, node: aside, component: uy, of: jerk, take: curve}}
  rms: {rate: {analysis: go, node: mass, component: uy, of: jerk, take: rms}}
"""
SHAKEN = """beamwork: 1
sections:
  post: {tube: {diameter: 40e-3, thickness: 2e-3}, young: 70e9, shear_modulus: 26e9, density: 2700}
nodes:
  base: {at: [0, 0, 0], hold: [ux, uz, rx, ry, rz], drive: {uy: shake}}
  tip:  {at: [0, 0, 0.1]}
members: {post: {from: base, to: tip, section: post, y: [0, 1, 0]}}
motions: {shake: {unit: m, time: %(shake)s}}
analyses: {go: {motion: {stations: %(stations)s, step: 0.01, integrator: radau}}}
quantities:
  history: {displacement: {analysis: go, node: base, component: uy, take: curve}}
  lines:   {displacement: {analysis: go, node: base, component: uy, take: spectrum}, when: {%(when)s}}
  power:   {displacement: {analysis: go, node: base, component: uy, take: psd}, when: {%(when)s}}
  force:   {reaction: {analysis: go, node: base, component: uy, take: psd}, when: {%(when)s}}
"""
SINES = "1e-3*(3 + 2*cos(2*pi*5*t) - 5*cos(2*pi*12*t))"


class Histories(ProgramTest):

    def done(self, scene, formulation="collocation"):
        path = self.folder / "scene.yaml"
        path.write_text(scene)
        return run("solve", "--scene", path, "-f", formulation, "-n", 1, "--format", "json")

    def curves(self, scene, formulation="collocation"):
        path = self.folder / "scene.yaml"
        path.write_text(scene)
        record = self.record("solve", "--scene", path, "-f", formulation, "-n", 1)
        self.assertEqual(record["cell"]["status"], "ok", record["cell"]["reason"])
        return ({c["quantity"]: c for c in record["curves"]}, {q["quantity"]: q for q in record["quantities"]})

    def near(self, curve, exact, within):
        largest = max(abs(e) for e in exact)
        for got, e in zip(curve["curve_value"], exact):
            self.assertLess(abs(got - e), within*largest)

    def test_rates(self):
        w, v = math.sqrt(200/2), math.sqrt(100)
        for integrator, coarse, factor in (("radau", 2e-5, 7), ("alpha", 0.06, 3.5)):
            errors = []
            for step in (0.02, 0.01):
                got, values = self.curves(PUSHED % {"step": step, "integrator": integrator, "more": ""})
                time = got["a"]["curve_x"]
                turn = [(0.01*(1 - math.cos(v*t)), 0.01*v*math.sin(v*t), 0.01*v*v*math.cos(v*t)) for t in time]
                exact = {"a": [10*math.cos(w*t) - 0.1*w*math.sin(w*t) for t in time],
                         "w": [c for _, _, c in turn],
                         "x": [-math.sin(a)*c - math.cos(a)*b*b for a, b, c in turn]}
                for name, of in exact.items():
                    self.near(got[name], of, coarse)
                errors.append(max(abs(g - e) for g, e in zip(got["w"]["curve_value"], exact["w"])))
                self.assertLess(abs(values["top"]["value"]/math.hypot(10, 1) - 1), coarse)
            self.assertGreater(errors[0], factor*errors[1])
        self.assertEqual(values["top"]["unit"], "m/s^2")

    def test_jerks(self):
        w, v = math.sqrt(200/2), math.sqrt(100)
        got, values = self.curves(PUSHED % {"step": 0.01, "integrator": "radau", "more": JERKS})
        time = got["j"]["curve_x"]
        jerk = [-10*w*math.sin(w*t) - 0.1*w*w*math.cos(w*t) for t in time]
        self.near(got["j"], jerk, 1e-4)
        beside = []
        for t, j in zip(time, jerk):
            a, b, c, d = (0.01*x for x in (1 - math.cos(v*t), v*math.sin(v*t), v*v*math.cos(v*t), -v**3*math.sin(v*t)))
            beside.append(j + math.cos(a)*d - 3*math.sin(a)*b*c - math.cos(a)*b**3)
        self.near(got["y"], beside, 1e-4)
        squares = [(-10*w*math.sin(w*t) - 0.1*w*w*math.cos(w*t))**2 for t in ((i + 0.5)*1e-4 for i in range(10000))]
        self.assertLess(abs(values["rms"]["value"]/math.sqrt(sum(squares)/10000) - 1), 1e-5)

    def test_refused(self):
        for integrator, more, what in (("conserving", "", "mean acceleration of each step"),
                                       ("alpha", JERKS, "order 2 do not compute the jerk")):
            done = self.done(PUSHED % {"step": 0.01, "integrator": integrator, "more": more})
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(what, done.stdout + done.stderr)
        light = "  l: {rate: {analysis: go, node: end, component: ux, of: acceleration}}\n"
        done = self.done(PUSHED % {"step": 0.01, "integrator": "radau", "more": light})
        self.assertIn("node end has no inertia", done.stdout + done.stderr)
        alone = json.loads(self.done(PUSHED % {"step": 0.01, "integrator": "radau", "more": ""}).stdout)["quantities"]
        both = json.loads(done.stdout)["quantities"]
        self.assertEqual([q["quantity"] for q in both if q["status"] != "ok"], ["l"])
        self.assertEqual([q["value"] for q in both if q["quantity"] != "l"], [q["value"] for q in alone])

    def test_lines(self):
        got, _ = self.curves(SHAKEN % {"shake": SINES, "stations": "0..1/200", "when": ""})
        for name, exact in (("lines", {0: 3e-3, 5: 2e-3, 12: 5e-3}), ("power", {0: 9e-6, 5: 2e-6, 12: 12.5e-6})):
            x, y = got[name]["curve_x"], got[name]["curve_value"]
            self.assertEqual([round(f, 9) for f in x], list(range(101)))
            for f, value in zip(x, y):
                self.assertLess(abs(value - exact.get(round(f), 0)), 1e-12)
        self.assertEqual([got[n]["unit"] for n in ("lines", "power", "force")], ["m", "m^2/Hz", "N^2/Hz"])

    def test_parseval(self):
        for stations, count in (("0..1/60", 60), ("0..1/45", 45), ("0..1/97", 97), ("0..1/2", 2)):
            got, _ = self.curves(SHAKEN % {"shake": "1e-3*(exp(-3*t)*sin(40*t) + t^2)", "stations": stations, "when": ""})
            history = got["history"]["curve_value"][:count]
            whole = sum(x*x for x in history)/count
            self.assertLess(abs(sum(got["power"]["curve_value"])*1/whole - 1), 1e-12)
            for k, line in enumerate(got["lines"]["curve_value"]):
                sides = 1 if k in (0, count/2) else 2
                exact = sides*abs(sum(x*cmath.exp(-2j*math.pi*k*n/count) for n, x in enumerate(history)))/count
                self.assertLess(abs(line - exact), 1e-15)

    def test_window(self):
        got, _ = self.curves(SHAKEN % {"shake": SINES, "stations": "0..1/200", "when": "from: 0.25, until: 0.75, taper: hann"})
        history = got["history"]["curve_value"][50:150]
        weights = [math.sin(math.pi*n/100)**2 for n in range(100)]
        for k, (f, line, power) in enumerate(zip(got["lines"]["curve_x"], got["lines"]["curve_value"],
                                                 got["power"]["curve_value"])):
            size = abs(sum(w*x*cmath.exp(-2j*math.pi*k*n/100) for n, (w, x) in enumerate(zip(weights, history))))
            sides = 1 if k in (0, 50) else 2
            self.assertAlmostEqual(f, 2*k)
            self.assertLess(abs(line - sides*size/50), 1e-14)
            self.assertLess(abs(power - sides*0.005*size**2/sum(w*w for w in weights)), 1e-15)

    def test_uneven(self):
        for stations, when, what in (("[0, 0.1, 0.2, 0.35, 0.45]", "", "0.1 s of analysis go is not at 0.1125 s"),
                                     ("[0.1, 0.2]", "", "the number of stations in the window is 2")):
            done = self.done(SHAKEN % {"shake": SINES, "stations": stations, "when": when})
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(what, done.stdout + done.stderr)
        self.curves(SHAKEN % {"shake": SINES, "stations": "[0, 0.1, 0.2, 0.3, 0.45]", "when": "until: 0.3"})
        over = SHAKEN.replace("take: psd}, when: {%(when)s}", "take: curve}, x: {quantity: lines}", 1)
        done = self.done(over % {"shake": SINES, "stations": "0..1/20", "when": ""})
        self.assertIn("neither of the two may be a spectrum", done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
