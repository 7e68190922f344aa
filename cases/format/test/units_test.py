"""Scenes in units of their own are those in SI; numbers that look like other units are doubted."""
import unittest

from cases.format.test.scene_case import EXAMPLES, SceneCase, values
from harness.tools.kit.program import run

# Units, metres and newtons of one, and what the units of values are called.
SYSTEMS = (("mm, N, MPa", 1e-3, 1), ("[mm, N]", 1e-3, 1), ("m, kN, kPa", 1, 1e3), ("in, lbf, psi", 0.0254, 4.4482216152605),
           ("cm, kN", 1e-2, 1e3), ("m, N, Pa", 1, 1))


def scene(units, metre, newton):
    """One structure with something of everything; numbers in those units."""
    def u(value, length=0, force=0):
        return repr(value/metre**length/newton**force)

    def us(power, force, *numbers):
        return "[" + ", ".join(u(x, power, force) for x in numbers) + "]"

    E, G, rho = u(210e9, -2, 1), u(81e9, -2, 1), u(7800.0, -4, 1)
    steel = f"young: {E}, shear_modulus: {G}, density: {rho}"
    stiffness = ", ".join(u(x, 2*(k > 2), 1) for k, x in enumerate((4e6, 2e6, 2e6, 500.0, 700.0, 900.0)))
    mass = ", ".join(u(x, 2*(k > 2) - 2, 1) for k, x in enumerate((0.2, 0.2, 0.2, 3e-5, 1e-5, 2e-5)))
    return f"""beamwork: 1
{'units: ' + units if units else ''}
sections:
  strip: {{rectangle: {{width: {u(0.04, 1)}, thickness: {u(0.004, 1)}}}, {steel}}}
  rail: {{tube: {{diameter: {u(0.06, 1)}, thickness: {u(0.003, 1)}}}, {steel}}}
  rod: {{constants: {{A: {u(1e-4, 2)}, Iy: {u(2e-9, 4)}, Iz: {u(3e-9, 4)}, It: {u(1e-9, 4)}}}, {steel}}}
  print: {{stiffness: [{stiffness}], mass: [{mass}]}}
nodes:
  root: {{at: [0, 0, 0], hold: all}}
  bend: {{at: {us(1, 0, 0.4, 0.0, 0.0)}, mass: {u(0.3, -1, 1)}, inertia: {us(1, 1, 1e-4, 2e-4, 2e-4, 0.0, 0.0, 0.0)}}}
  tip: {{at: {us(1, 0, 0.4, 0.3, 0.0)}}}
  end: {{at: {us(1, 0, 0.4, 0.3, 0.2)}}}
  far: {{at: {us(1, 0, 0.8, 0.3, 0.2)}, drive: {{uy: lift}}}}
members:
  a: {{from: root, to: bend, section: strip, y: [0, 1, 0], warping: fixed}}
  b: {{from: bend, to: tip, section: rail, y: [0, 0, 1], warping: fixed}}
  c: {{from: tip, to: end, section: rod, y: [1, 0, 0], warping: fixed, curvature: {us(-1, 0, 0.0, 0.0, 0.3)}}}
  d: {{from: end, to: far, section: print, y: [0, 1, 0], warping: fixed}}
springs:
  s: {{to: tip, stiffness: [{u(500.0, -1, 1)}, {u(50.0, -1, 1)}, {u(60.0, -1, 1)}, {u(3.0, 1, 1)}, 0, 0]}}
motions:
  lift: {{path: [0, 1], value: [0, {u(0.01, 1)}]}}
loads:
  push: {{force: {us(0, 1, 3.0, -5.0, 9.0)}, on: tip, at: {us(1, 0, 0.0, 0.01, 0.0)}}}
  twist: {{moment: {us(1, 1, 0.5, 0.2, 0.1)}, on: tip}}
  snow: {{distributed: {us(-1, 1, 0.0, -20.0, 0.0)}, on: a}}
  drift: {{distributed: {us(-1, 1, 0.0, 3.0, -7.0)}, on: a, from: 0.5, to: 1, to_value: {us(-1, 1, 5.0, 0.0, 9.0)}}}
  screw: {{distributed_moment: {us(0, 1, 0.3, 0.0, 0.0)}, on: b, to_value: {us(0, 1, 0.0, 0.2, 0.1)}}}
  rope: {{force: {us(0, 1, 0.0, 2.0, 0.0)}, on: b, where: 0.25, at: {us(1, 0, 0.0, 0.01, 0.0)}}}
  wrench: {{moment: {us(1, 1, 0.4, 0.0, 0.1)}, on: a, where: 0.5}}
  weight: {{gravity: {us(1, 0, 0.0, -9.81, 0.0)}, on: all}}
analyses:
  path: {{static: {{stations: [0.5, 1]}}}}
  supple: {{compliance: {{node: tip, about: path}}}}
  tones: {{modal: {{}}}}
quantities:
  ux: {{displacement: {{analysis: path, node: tip, component: ux}}}}
  rz: {{displacement: {{analysis: path, node: tip, component: rz}}}}
  R: {{reaction: {{analysis: path, node: root, component: uy}}}}
  M: {{reaction: {{analysis: path, node: root, component: rz}}}}
  Mz: {{internal: {{analysis: path, member: a, end: from, resultant: Mz}}}}
  S: {{stress: {{analysis: path, member: a, where: 0.5, measure: von_mises}}}}
  C: {{compliance: {{analysis: supple, row: uy, column: rz}}}}
  K: {{stiffness: {{analysis: supple, component: uz}}}}
  f: {{frequency: {{analysis: tones, which: 1}}}}
  line: {{displacement: {{analysis: path, node: end, component: uz, take: curve}}}}
"""


POWER = {"ux": (1, 0), "rz": (0, 0), "R": (0, 1), "M": (1, 1), "Mz": (1, 1), "S": (-2, 1), "C": (0, -1),
         "K": (-1, 1), "f": (0, 0)}

MOTION = """beamwork: 1
UNITS
sections: {s: {rectangle: {width: WIDTH, thickness: THICK}, young: YOUNG, shear_modulus: SHEAR, density: RHO}}
nodes:
  a: {at: [0, 0, 0], hold: all}
  b: {at: [LENGTH, 0, 0]}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0], warping: fixed}}
loads: {p: {force: [0, 1, 0], on: b, time: "sin(60*t)"}}
analyses: {run: {motion: {stations: [0.01, 0.02], integrator: radau, tolerance: 1e-6}}}
quantities:
  v: {rate: {analysis: run, node: b, component: uy}}
  E: {energy: {analysis: run, of: strain}}
  u: {displacement: {analysis: run, node: b, component: uy}}
"""

CONTINUED = """beamwork: 1
UNITS
sections: {s: {rectangle: {width: WIDTH, thickness: THICK}, young: YOUNG, shear_modulus: SHEAR}}
nodes:
  a: {at: [0, 0, 0], hold: all}
  b: {at: [LENGTH, 0, 0]}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0], warping: fixed}}
loads: {p: {force: [-1, 0.2, 0], on: b}}
analyses:
  path: {continuation: {control: {node: b, component: uy}, to: [NEAR, FAR], step: NEAR}}
  supple: {compliance: {node: b, about: path}}
quantities:
  P: {factor_at: {analysis: path, at: NEAR}}
  u: {displacement: {analysis: path, node: b, component: ux, at: NEAR}}
  C: {compliance: {analysis: supple, row: uy, column: uy, at: NEAR}}
  line: {compliance: {analysis: supple, row: uy, column: uy, take: curve}}
"""

LEAF = """beamwork: 1
sections: {leaf: {rectangle: {width: WIDTH, thickness: THICK}, young: YOUNG, shear_modulus: SHEAR}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [LENGTH, 0, 0]}}
members: {m: {from: a, to: b, section: leaf, y: [0, 1, 0], warping: fixed}}
loads: {p: {force: [0, 1, 0], on: b}}
analyses: {st: {static: {stations: [1]}}}
quantities: {tip: {displacement: {analysis: st, node: b, component: uy}}}
"""


def filled(text, **numbers):
    for name, value in numbers.items():
        text = text.replace(name, str(value))
    return text


MILLIMETRES = {"WIDTH": 50, "THICK": 0.5, "YOUNG": 210e3, "SHEAR": 81e3, "LENGTH": 100, "RHO": 7.8e-9}
METRES = {"WIDTH": 50e-3, "THICK": 0.5e-3, "YOUNG": 210e9, "SHEAR": 81e9, "LENGTH": 0.1, "RHO": 7800}


class UnitsTest(SceneCase):

    def solved(self, text, *where):
        return self.record("solve", "--scene", self.scene(text), "-f", "collocation", "-n", 2, *where)

    def test_systems(self):
        """Every number by its unit: values come back in the units of the scene."""
        exact = values(self.solved(scene("", 1, 1)))
        for units, metre, newton in SYSTEMS:
            record = self.solved(scene(units, metre, newton))
            found = values(record)
            for name, (length, force) in POWER.items():
                self.assertAlmostEqual(found[name]*metre**length*newton**force/exact[name], 1, delta=1e-7,
                                       msg=(units, name))
            curve = record["curves"][0]
            self.assertAlmostEqual(curve["curve_value"][-1]*metre/self.solved(scene("", 1, 1))["curves"][0]["curve_value"][-1],
                                   1, delta=1e-7)
        units = {q["quantity"]: q["unit"] for q in self.solved(scene("mm, N, MPa", 1e-3, 1))["quantities"]}
        self.assertEqual(units, {"ux": "mm", "rz": "rad", "R": "N", "M": "N mm", "Mz": "N mm", "S": "MPa",
                                 "C": "1/N", "K": "N/mm", "f": "Hz", "line": "mm"})

    def test_written(self):
        """beamwork scene writes it in SI, with the same values."""
        self.same_again(self.scene(scene("mm, N, MPa", 1e-3, 1)), "-f", "collocation", "-n", 2)

    def test_motion(self):
        exact = values(self.solved(filled(MOTION, UNITS="", **METRES)))
        found = values(self.solved(filled(MOTION, UNITS="units: mm, N, MPa", **MILLIMETRES)))
        for name in exact:
            self.assertAlmostEqual(found[name]/1e3/exact[name], 1, delta=1e-6, msg=name)

    def test_continued(self):
        """Stations of a continuation are lengths, also of a compliance about it."""
        si, mm = [self.solved(filled(CONTINUED, UNITS=units, NEAR=near, FAR=4*near, **numbers))
                  for units, near, numbers in (("", 1e-3, METRES), ("units: mm, N, MPa", 1, MILLIMETRES))]
        exact, found = values(si), values(mm)
        for name, power in {"P": 0, "u": 1, "C": 1}.items():
            self.assertAlmostEqual(found[name]*1e-3**power/exact[name], 1, delta=1e-7, msg=name)
        for i, x in enumerate((1, 4)):
            here, there = si["curves"][0], mm["curves"][0]
            self.assertAlmostEqual(here["curve_x"][i], 1e-3*x, delta=1e-12)
            self.assertAlmostEqual(there["curve_x"][i], x, delta=1e-9)
            self.assertAlmostEqual(there["curve_value"][i]*1e-3/here["curve_value"][i], 1, delta=1e-7)

    def test_leaf(self):
        """The tip moves by 3.0448 mm."""
        found = values(self.solved(filled(LEAF, **MILLIMETRES).replace("beamwork: 1", "beamwork: 1\nunits: mm, N, MPa")))
        self.assertAlmostEqual(found["tip"], 3.0448, delta=1e-3)

    def test_refusals(self):
        leaf = filled(LEAF, **MILLIMETRES)
        for units, words in (("mm, N, Pa", "Pa are not N/mm^2"), ("mm", "of length and of force"),
                             ("mm, N, MPa, kg", "'kg'"), ("furlong, N", "'furlong'"), ("[[mm], N]", "'?'"), ("mm, m, N", "'m'")):
            text = leaf.replace("beamwork: 1", f"beamwork: 1\nunits: {units}")
            self.refused(2, words, "solve", "--scene", self.scene(text))
        text = leaf.replace("beamwork: 1", "beamwork: 1\nunits: mm, N").replace("component: uy}", "component: uy}, unit: m")
        self.refused(2, "the value is in mm", "solve", "--scene", self.scene(text))

    def warned(self, text):
        done = run("solve", "--scene", self.scene(text), "-f", "collocation", "-n", 1)
        self.assertIn(done.returncode, (0, 1), done.stderr)  # large loads may not converge
        return "warning" in done.stderr

    def test_warnings(self):
        """One line, and the status stays."""
        self.assertTrue(self.warned(filled(LEAF, **MILLIMETRES)))
        self.assertTrue(self.warned(filled(LEAF, **{**MILLIMETRES, "YOUNG": 210e9, "SHEAR": 81e9})))
        self.assertTrue(self.warned(filled(MOTION, UNITS="", **{**METRES, "YOUNG": 210e3, "SHEAR": 81e3})))
        for right in (METRES, {**METRES, "YOUNG": 5e6, "SHEAR": 2e6, "WIDTH": 0.2, "LENGTH": 3},
                      {"YOUNG": 1, "SHEAR": 0.4, "WIDTH": 1, "THICK": 0.1, "LENGTH": 10},
                      {"YOUNG": 1000, "SHEAR": 400, "WIDTH": 1, "THICK": 1, "LENGTH": 1},
                      {**METRES, "YOUNG": 30e9, "SHEAR": 12e9, "WIDTH": 12, "THICK": 2, "LENGTH": 60}):
            self.assertFalse(self.warned(filled(LEAF, **right)), right)

    def test_of_another_kind(self):
        """A frequency is in Hz, whatever its label says, unless a factor makes it another."""
        scene = """beamwork: 1
sections: {s: {rectangle: {width: 0.05, thickness: 0.01}, young: 200e9, shear_modulus: 80e9, density: 7800}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}
analyses: {v: {modal: {wanted: 1}}}
quantities: {f: {frequency: {analysis: v, which: 0}, unit: %s}}
"""
        for unit, code in (("Hz", 0), ("rad/s", 2), ("m", 2), ("rad/s, factor: 2*pi", 0)):
            done = run("solve", "--scene", self.scene(scene % unit), "-n", 1)
            self.assertEqual(done.returncode, code, (unit, done.stderr))
            self.assertEqual("the value is in Hz" in done.stderr, code == 2, (unit, done.stderr))

    def test_verbs(self):
        """Each that reads the scene says it once."""
        path = self.scene(filled(LEAF, **MILLIMETRES))
        for words in (("solve", "-n", 1), ("converge", "-n", 1), ("verify",), ("bench", "-n", 1), ("truth",)):
            told = run(words[0], "--scene", path, *words[1:]).stderr
            self.assertEqual(told.count("numbers are in m, N, Pa and kg"), 1, words)

    def test_examples(self):
        for path in sorted(EXAMPLES.glob("*.yaml")):
            done = run("solve", "--scene", path, "-n", 1)
            self.assertNotIn("warning", done.stderr, path)


if __name__ == "__main__":
    unittest.main()
