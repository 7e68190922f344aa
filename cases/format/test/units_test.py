"""Tests the keys of scene files and the units of their values."""
import json
import re
import unittest

import yaml

from cases.format.test.scene_case import EXAMPLES, SceneCase, values
from harness.tools.kit.program import ROOT, run


GOOD = ROOT / "cases/format/test/good"

BARE = [
    """sections:
  b: {rectangle: {width: 0.02, thickness: 0.01}, young: 7e10, shear_modulus: 2.6e10, density: 2700}
  w: {points: {a: [0, 0], b: [0.1, 0], c: [0.1, 0.1]}, walls: [{from: a, to: b, thickness: 2e-3}, {from: b, to: c, thickness: 2e-3}], young: 7e10, shear_modulus: 2.6e10}
  c: {constants: {A: 1e-4, Iy: 1e-8, Iz: 2e-8, It: 1e-8}, young: 7e10, shear_modulus: 2.6e10}
  m: {stiffness: [1e6, 1e6, 1e6, 1e3, 1e3, 1e3]}
nodes:
  a: {at: [0, 0, 0], hold: all}
  b: {at: [1, 0, 0], hold: [uz, rx, ry]}
  c: {at: [2, 0, 0]}
  d: {at: [3, 0, 0]}
  e: {at: [4, 0, 0]}
members:
  ab: {from: a, to: b, section: b, y: [0, 1, 0]}
  bc: {from: b, to: c, section: w, y: [0, 1, 0], release: {from: [rz]}}
  cd: {from: c, to: d, section: c, y: [0, 1, 0], release: {to: [rz]}}
  de: {from: d, to: e, section: m, y: [0, 1, 0]}
springs:
  s: {to: c, stiffness: [1e3, 1e3, 1e3, 1, 1, 1]}
  t: {to: d, stiffness: [1e3, 1e3, 1e3, 1, 1, 1]}
  u: {to: e, stiffness: [1e3, 1e3, 1e3, 1, 1, 1]}
loads:
  push: {force: [0, 1, 0], on: b}
  line: {distributed: [0, 1, 0], on: ab}
  holds: {force: [0, 1, 0], on: b, feedback: {node: b, component: uy, proportional: 1}}
  damps: {force: [0, 1, 0], on: b, feedback: {node: b, component: uy, derivative: 1}}
""", """analyses:
  path: {static: {stations: [1]}}
  still: {compliance: {node: b}}
  free: {modal: {}}
  steady: {harmonic: {frequencies: [1], damping: {}}}
  damped: {modal: {damped: yes, damping: {}}}
  critical: {buckling: {}}
  curve: {continuation: {control: {node: b, component: uy}, to: [0.1], step: 0.1}}
quantities:
  uy: {displacement: {analysis: path, node: b, component: uy}}
  over: {displacement: {analysis: path, node: b, component: uy, take: curve}, x: {}}
  first: {frequency: {analysis: free}}
  damps: {damping_ratio: {analysis: damped}}
  shakes: {response: {analysis: steady, node: b, component: uy, force: b}}
  load: {critical_factor: {analysis: critical}}
  point: {critical_point: {analysis: curve, kind: limit}}
  most: {stress: {analysis: path, member: ab}}
  there: {stress: {analysis: path, member: ab, where: 0.5}}
  force: {reaction: {analysis: path, node: a, component: ux}}
  within: {internal: {analysis: path, member: ab, end: from, resultant: N}}
  bent: {deflection: {analysis: path, member: ab, end: from, component: rz}}
  turned: {hinge: {analysis: path, member: bc, end: from, component: rz}}
  k: {stiffness: {analysis: still, component: ux}}
  c: {compliance: {analysis: still, row: ux, column: ux}}
  at: {factor_at: {analysis: curve}}
truths:
  - {quantity: uy, value: 1, kind: exact, source: here}
""", """analyses:
  swing: {motion: {stations: [1], step: 0.01, start: {}, damping: {mass: 0}}}
quantities:
  uy: {displacement: {analysis: swing, node: b, component: uy, take: crossing}, when: {}}
  over: {displacement: {analysis: swing, node: b, component: uy, take: curve}, x: {}}
  vx: {rate: {analysis: swing, node: b, component: ux}}
  R: {orientation: {analysis: swing, node: b, row: x, column: y}}
  E: {energy: {analysis: swing, of: energy}}
  p: {momentum: {analysis: swing, component: px}}
  r: {relative: {analysis: swing, node: b, from: a, component: ux}}
""", """analyses:
  turn: {rotation: {omega: [0, 0, 1], stations: [1]}}
  spun: {static: {stations: [1], spin: {omega: [0, 0, 1]}}}
quantities:
  grows: {growth: {analysis: turn}}
""", """analyses:
  shaken: {harmonic: {frequencies: [10, 20]}}
quantities:
  gives: {response: {analysis: shaken, node: b, component: ux, force: b}}
"""]


def tables(schema):
    def below(node, place):
        if "properties" in node:
            yield place, node["properties"], node.get("required", [])
            for key, value in node["properties"].items():
                yield from below(value, (*place, key))
        for word in ("additionalProperties", "items"):
            if isinstance(node.get(word), dict):
                yield from below(node[word], (*place, "*"))

    yield from below(schema, ())


def maps(scene, schema, place=()):
    if isinstance(scene, dict) and "properties" in schema:
        yield place, scene, schema["properties"]
        for key, value in scene.items():
            if key in schema["properties"]:
                yield from maps(value, schema["properties"][key], (*place, key))
    elif isinstance(scene, dict) and isinstance(schema.get("additionalProperties"), dict):
        for value in scene.values():
            yield from maps(value, schema["additionalProperties"], (*place, "*"))
    elif isinstance(scene, list) and isinstance(schema.get("items"), dict):
        for value in scene:
            yield from maps(value, schema["items"], (*place, "*"))


class KeysTest(SceneCase):

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.schema = json.loads(run("scene", "--schema").stdout)

    def test_words_of_keys(self):
        said = "".join(self.answered("scene", "--keys").stdout.split())
        offered = []

        def gather(node):
            for value in node.values() if isinstance(node, dict) else node:
                if isinstance(value, (dict, list)):
                    gather(value)
            if isinstance(node, dict) and isinstance(node.get("examples"), list):
                offered.append(node["examples"])

        gather(self.schema)
        self.assertGreater(len(offered), 10)
        for words in offered:
            self.assertTrue(f"({','.join(words)})" in said, words)

    def test_every_key(self):
        lines = []
        for line in self.answered("scene", "--keys").stdout.partition("in names and strings:\n")[2].splitlines():
            if re.match(r" {0,11}\S", line):
                lines.append(line)
            else:
                lines[-1] += " " + line.strip()
        self.assertGreater(len(lines), 200)
        for line in lines:
            self.assertRegex(line, r"(\*|; default: .+)$")
            self.assertNotRegex(line, r"; default: .*\*$", line)
        said = 0
        for place, properties, required in tables(self.schema):
            for key, value in properties.items():
                words = value["description"]
                if "; default: " not in words:
                    continue
                said += 1
                self.assertNotIn(key, required, place)
                if "default" in value:
                    told = words.partition("; default: ")[2]
                    self.assertEqual(yaml.load(told, yaml.BaseLoader),
                                     yaml.load(json.dumps(value["default"]), yaml.BaseLoader)
                                     if not re.fullmatch(r"[\d.e-]+", told) else told, (place, key))
        self.assertGreater(said, 150)

    def test_written(self):
        wanted = {(place, key)
                  for place, properties, _ in tables(self.schema)
                  for key, value in properties.items() if "default" in value}
        self.assertGreater(len(wanted), 60)
        scenes = [yaml.load("beamwork: 1\n" + BARE[0] + more, yaml.BaseLoader) for more in BARE[1:]]
        scenes += [yaml.load(path.read_text(encoding="utf-8"), yaml.BaseLoader)
                   for path in sorted((*EXAMPLES.glob("*.yaml"), *GOOD.glob("*.yaml")))]
        tried = set()
        for number, scene in enumerate(scenes):
            path = self.folder / f"s{number}.yaml"
            path.write_text(yaml.safe_dump(scene, sort_keys=False), encoding="utf-8")
            written = self.answered("scene", "--scene", path).stdout
            for place, entry, properties in list(maps(scene, self.schema)):
                for key, value in properties.items():
                    is_known = (place, key) in tried and number >= len(BARE) - 1
                    if "default" not in value or key in entry or is_known:
                        continue
                    entry[key] = value["default"]
                    path.write_text(yaml.safe_dump(scene, sort_keys=False), encoding="utf-8")
                    done = run("scene", "--scene", path)
                    del entry[key]
                    if done.returncode == 0:
                        self.assertEqual(done.stdout, written, (place, key, entry))
                        tried.add((place, key))
        self.assertEqual({one for one in wanted - tried if one[0][:1] != ("parts",)}, set())


# Unit systems: the value of `units`, the length unit in m, the force unit in N.
SYSTEMS = (("mm, N, MPa", 1e-3, 1), ("[mm, N]", 1e-3, 1), ("m, kN, kPa", 1, 1e3), ("in, lbf, psi", 0.0254, 4.4482216152605),
           ("cm, kN", 1e-2, 1e3), ("m, N, Pa", 1, 1))


def scene(units, metre, newton):
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
  a: {{from: root, to: bend, section: strip, y: [0, 1, 0], warping: fixed, foundation: {{translation: {us(-2, 1, 10.0, 300.0, 200.0)}, rotation: {us(0, 1, 1.0, 0.0, 2.0)}}}}}
  b: {{from: bend, to: tip, section: rail, y: [0, 0, 1], warping: fixed, imperfection: {{amplitude: {us(1, 0, 2e-3, 1e-3)}}}, offset: {{from: {us(1, 0, 0.0, 0.0, 0.02)}, to: {us(1, 0, 0.03, 0.0, 0.0)}}}}}
  c: {{from: tip, to: end, section: rod, y: [1, 0, 0], warping: fixed, curvature: {us(-1, 0, 0.0, 0.0, 0.3)}}}
  d: {{from: end, to: far, section: print, y: [0, 1, 0], warping: fixed}}
springs:
  s: {{to: tip, stiffness: [{u(500.0, -1, 1)}, {u(50.0, -1, 1)}, {u(60.0, -1, 1)}, {u(3.0, 1, 1)}, 0, 0]}}
  t: {{to: tip, tables: {{uy: {{at: {us(1, 0, -1.0, 0.002, 1.0)}, value: {us(0, 1, -50.0, 0.1, 150.0)}}}, rz: {{at: [-1, 1], value: {us(1, 1, -2.0, 2.0)}}}}}}}
imperfections:
  crooked: {{mode_of: shape, which: 1, amplitude: {u(2e-3, 1)}}}
  leaning: {{shifts: {{tip: {us(1, 0, 1e-3, 2e-3, 0.0)}}}, factor: 1.5}}
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
  shape: {{modal: {{}}}}
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
springs: {d: {to: b, damping: [DAMP, DAMP, DAMP, TURN, TURN, TURN]}}
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


MILLIMETRES = {"WIDTH": 50, "THICK": 0.5, "YOUNG": 210e3, "SHEAR": 81e3, "LENGTH": 100, "RHO": 7.8e-9,
               "DAMP": 2e-4, "TURN": 1}
METRES = {"WIDTH": 50e-3, "THICK": 0.5e-3, "YOUNG": 210e9, "SHEAR": 81e9, "LENGTH": 0.1, "RHO": 7800,
          "DAMP": 0.2, "TURN": 1e-3}


class UnitsTest(SceneCase):

    def solved(self, text, *where):
        return self.record("solve", "--scene", self.scene(text), "-f", "collocation", "-n", 2, *where)

    def test_systems(self):
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
        self.same_again(self.scene(scene("mm, N, MPa", 1e-3, 1)), "-f", "collocation", "-n", 2)

    def test_motion(self):
        exact = values(self.solved(filled(MOTION, UNITS="", **METRES)))
        found = values(self.solved(filled(MOTION, UNITS="units: mm, N, MPa", **MILLIMETRES)))
        for name in exact:
            self.assertAlmostEqual(found[name]/1e3/exact[name], 1, delta=1e-6, msg=name)

    def test_continued(self):
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
        found = values(self.solved(filled(LEAF, **MILLIMETRES).replace("beamwork: 1", "beamwork: 1\nunits: mm, N, MPa")))
        self.assertAlmostEqual(found["tip"], 3.0448, delta=1e-3)

    def test_refusals(self):
        leaf = filled(LEAF, **MILLIMETRES)
        for units, words in (("mm, N, Pa", "Pa is not N/mm^2"), ("mm", "a unit of length and one of force"),
                             ("mm, N, MPa, kg", "'kg'"), ("furlong, N", "'furlong'"), ("[[mm], N]", "'?'"), ("mm, m, N", "'m'")):
            text = leaf.replace("beamwork: 1", f"beamwork: 1\nunits: {units}")
            self.refused(2, words, "solve", "--scene", self.scene(text))
        text = leaf.replace("beamwork: 1", "beamwork: 1\nunits: mm, N").replace("component: uy}", "component: uy}, unit: m")
        self.refused(2, "the value is in mm", "solve", "--scene", self.scene(text))
        for unit, words in (("cm", "lengths of this scene are in mm"), ("N m", "lengths of this scene"), ("kN/mm", "forces of this scene are in N"),
                            ("GPa", "stresses of this scene are in N/mm^2"), ("deg", "angles are in rad"), ("mm", ""), ("N mm", ""), ("N/mm^2", ""), ("MPa", "")):
            text = leaf.replace("beamwork: 1", f"beamwork: 1\nunits: mm, N\nparameters: {{more: {{value: 1, unit: {unit}}}}}")
            if words:
                self.refused(2, words, "solve", "--scene", self.scene(text))
            else:
                self.solved(text)

    def warned(self, text):
        done = run("solve", "--scene", self.scene(text), "-f", "collocation", "-n", 1)
        self.assertIn(done.returncode, (0, 1), done.stderr)  # runs with large loads may fail to converge
        return "warning" in done.stderr

    def test_warnings(self):
        self.assertTrue(self.warned(filled(LEAF, **MILLIMETRES)))
        self.assertTrue(self.warned(filled(LEAF, **{**MILLIMETRES, "YOUNG": 210e9, "SHEAR": 81e9})))
        self.assertTrue(self.warned(filled(MOTION, UNITS="", **{**METRES, "YOUNG": 210e3, "SHEAR": 81e3})))
        for right in (METRES, {**METRES, "YOUNG": 5e6, "SHEAR": 2e6, "WIDTH": 0.2, "LENGTH": 3},
                      {"YOUNG": 1, "SHEAR": 0.4, "WIDTH": 1, "THICK": 0.1, "LENGTH": 10},
                      {"YOUNG": 1000, "SHEAR": 400, "WIDTH": 1, "THICK": 1, "LENGTH": 1},
                      {**METRES, "YOUNG": 30e9, "SHEAR": 12e9, "WIDTH": 12, "THICK": 2, "LENGTH": 60}):
            self.assertFalse(self.warned(filled(LEAF, **right)), right)

    def test_of_another_kind(self):
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
        path = self.scene(filled(LEAF, **MILLIMETRES))
        for words in (("solve", "-n", 1), ("converge", "-n", 1), ("verify",), ("bench", "-n", 1), ("truth",)):
            told = run(words[0], "--scene", path, *words[1:]).stderr
            self.assertEqual(told.count("numbers are in m, N, Pa and kg"), 1, words)

    def test_examples(self):
        for path in sorted(EXAMPLES.glob("*.yaml")):
            done = run("solve", "--scene", path, "-n", 1)
            self.assertNotIn("warning", done.stderr, path)


IN_MM = """beamwork: 1
units: mm, N, MPa
sections: {s: {rectangle: {width: 40, thickness: 20}, young: 210e3, shear_modulus: 81e3, density: DENSITY, expansion: 12e-6}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [2000, 0, 0], hold: [uy, uz, rx, ry, rz]}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0], divide: 2}}
loads: {weight: {gravity: [0, 0, 0], on: all}, push: {force: [FORCE, 0, 0], on: b}}
analyses: {lin: {linear: {}}}
quantities: {ux: {displacement: {analysis: lin, node: b, component: ux}, unit: mm}, N: {internal: {analysis: lin, member: m, end: to, resultant: Mx}, unit: N mm}}
"""
WARM = """beamwork: 1
units: mm, N, MPa
sections: {s: {rectangle: {width: 40, thickness: 20}, young: 210e3, shear_modulus: 81e3, expansion: 12e-6}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [2000, 0, 0], hold: all}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}
loads: {fire: {temperature: 1, on: m}}
analyses: {buck: {buckling: {}}}
quantities: {dT: {critical_factor: {analysis: buck}, unit: K}}
"""


class Doubtful(SceneCase):

    def told(self, density, force):
        text = IN_MM.replace("DENSITY", density).replace("FORCE", force).replace(", divide: 2", "")
        return self.answered("solve", "--scene", self.scene(text), "-f", "beamw", "-n", 2)

    def test_density(self):
        self.assertEqual(self.told("7.85e-9", "1").stderr, "")
        self.assertIn("the values seem to be in other units; numbers are in the 'units' of the scene; if these are mm, N, MPa, "
                      "densities are in t/mm^3", self.told("7850", "1").stderr)

    def test_larger_than_the_structure(self):
        """With EA/l = 84000 N/mm, a force of 168 MN causes 2000 mm, the size of the structure. Only a larger force
        must cause a warning."""
        self.assertEqual(self.told("7.85e-9", "167e6").stderr, "")
        self.assertIn("ux: a linear analysis gives a displacement of 1.01 times the size of the structure",
                      self.told("7.85e-9", "169e6").stderr)

    def test_zero(self):
        self.assertRegex(self.told("7.85e-9", "1").stdout, r"\nN +0 N mm")

    def test_kelvin(self):
        self.assertRegex(self.answered("solve", "--scene", self.scene(WARM), "-f", "beamw", "-n", 8).stdout,
                         r"\ndT +\S+ K")
        self.refused(2, "remove 'unit', or give a 'factor' in this unit", "solve", "--scene",
                     self.scene(WARM.replace("unit: K", "unit: MPa")))


if __name__ == "__main__":
    unittest.main()
