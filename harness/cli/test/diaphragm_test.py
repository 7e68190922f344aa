"""Floors that are rigid in their planes."""
import math

from harness.cli.test.constraints import ConstraintsCase
from harness.tools.kit.program import ROOT

STOREY = """beamwork: 1
sections:
  c: {rectangle: {width: 0.3, thickness: 0.2}, young: 30e9, shear_modulus: 12e9, density: 2500}
  d: {rectangle: {width: 0.4, thickness: 0.3}, young: 30e9, shear_modulus: 12e9, density: 2500}
nodes:
  A0: {at: [0, 0, 0], hold: all}
  B0: {at: [6, 0, 0], hold: all}
  C0: {at: [6, 4, 0], hold: all}
  A: {at: [0, 0, 3]HOLD}
  B: {at: [6, 0, 3]HOLD}
  C: {at: [6, 4, 3]HOLD}
  M: {at: [3, 2, 3], hold: [uz, rx, ry], mass: 500}
members:
  a: {from: A0, to: A, section: d, y: [0, 1, 0], warping: fixedRELEASE}
  b: {from: B0, to: B, section: c, y: [0, 1, 0], warping: fixedRELEASE}
  c: {from: C0, to: C, section: c, y: [0, 1, 0], warping: fixedRELEASE}
CONSTRAINTS
LOADS
analyses:
  L: {linear: {}}
  M: {modal: {}}
  S: {static: {stations: [0.5, 1]}}
  MS: {modal: {about: S}}
  C: {compliance: {node: M, about: S}}
  B: {buckling: {}}
  H: {harmonic: {frequencies: [3]}}
quantities:
  y: {displacement: {analysis: L, node: A, component: uy}}
  t: {displacement: {analysis: S, node: M, component: rz}}
  s: {displacement: {analysis: S, node: A, component: ux}}
  r: {reaction: {analysis: S, node: C0, component: uy}}
  N: {internal: {analysis: S, member: b, end: from, resultant: My}}
  f: {frequency: {analysis: M}}
  g: {frequency: {analysis: MS, which: 1}}
  c: {compliance: {analysis: C, row: ux, column: uy}}
  b: {critical_factor: {analysis: B}}
  h: {response: {analysis: H, node: B, component: uy, force: A, along: ux}}
"""
COLUMNS = """beamwork: 1
sections: {c: {constants: {A: 1e-2, Iy: 1e-5, Iz: 1e-5, It: 1e-5}, young: 2e11, shear_modulus: 8e10}}
nodes:
""" + "".join(f"""  f{i}: {{at: [{x}, {y}, 0], hold: all}}
  t{i}: {{at: [{x}, {y}, 3], hold: [rx, ry]}}
""" for i, (x, y) in enumerate(((-2, -2), (2, -2), (2, 2), (-2, 2)))) + """  m: {at: [0, 0, 3], hold: [uz, rx, ry], mass: 10, inertia: [20, 20, 30, 0, 0, 0]}
members:
""" + "".join(f"  c{i}: {{from: f{i}, to: t{i}, section: c, y: [1, 0, 0], release: RELEASE}}\n" for i in range(4)) + """constraints: {floor: {diaphragm: [t0, t1, t2, t3], master: m, normal: z}}
springs: {s: {to: m, stiffness: [1e4, 1e4, 0, 0, 0, 8e4]}}
omit: [trapeze, wagner_moments, wagner_torque, shear]
loads:
"""


class Diaphragms(ConstraintsCase):

    def test_diaphragm(self):
        loads = """loads:
  f: {force: [1e6, 4e6, 0], on: M}
  g: {force: [1e6, -3e6, 0], on: A}
  h: {moment: [0, 0, 1e6], on: M}
  i: {force: [2e6, 1e6, 0], on: C, at: [0.5, 0.2, 0.1]}
  j: {distributed: [2e5, 1e5, 0], on: a}
"""
        for tilts, released in (("rx, ry, ", ""), ("", ", release: {to: [rz, ry]}")):
            same = STOREY.replace("LOADS", loads if tilts else loads.replace(", at: [0.5, 0.2, 0.1]", ""))
            floor = same.replace("HOLD", ", hold: [" + tilts + "uz]").replace("RELEASE", "")
            floor = floor.replace("CONSTRAINTS", "constraints: {floor: {diaphragm: [A, B, C], master: M, normal: z}}")
            body = same.replace("HOLD", ", part_of: M").replace("CONSTRAINTS", "").replace("RELEASE", released)
            a, b = self.values(floor), self.values(body)
            self.assertGreater(abs(b["t"]), 0.02)
            for name, value in b.items():
                self.assertLess(abs(a[name] - value), 1e-7 * abs(value), f"{tilts}: {name}")
            path = self.folder / "floor.yaml"
            path.write_text(floor)
            again = self.answered("scene", "--scene", path).stdout
            self.assertIn("diaphragm: [A, B, C]", again)
            for name, value in self.values(again).items():
                self.assertLess(abs(a[name] - value), 1e-10 * abs(a[name]), name)

    def test_ball_joints(self):
        k, M = 3 * 2e6 / 27, 24
        wanted = {"x": 12 / (1e4 + 4 * k), "r": -M / (8e4 + 32 * k), "s": -M / (8e4 + 32 * k), "c": 1 / (8e4 + 32 * k),
                  "f": math.sqrt((8e4 + 32 * k) / 30) / 2 / math.pi}
        text = COLUMNS + """  f: {force: [12, 0, 0], on: t2}
analyses: {L: {linear: {}}, S: {static: {stations: [1]}}, C: {compliance: {node: m}}, F: {modal: {}}}
quantities:
  x: {displacement: {analysis: L, node: m, component: ux}}
  r: {displacement: {analysis: L, node: m, component: rz}}
  s: {displacement: {analysis: S, node: m, component: rz}}
  c: {compliance: {analysis: C, row: rz, column: rz}}
  f: {frequency: {analysis: F, which: 2}}
"""
        ball, universal = text.replace("RELEASE", "{to: [rx, ry, rz]}"), text.replace("RELEASE", "{from: [rx], to: [ry, rz]}")
        for name in ("collocation", "beamw", "sheet_third"):
            found = self.values(ball, name)
            for q, value in wanted.items():
                self.assertLess(abs(found[q] / value - 1), 1e-5 if q == "s" else 1e-7, f"{name} {q}")
        ends = "".join(f"  e{i}: {{at: [{x}, {y}, 3], part_of: t{i}}}\n" for i, (x, y) in enumerate(((-1.9, -1.8), (2.1, -2), (2, 2), (-2, 2.2))))
        beams = "".join(f"  b{i}: {{from: t{i}, to: t{(i + 1) % 4}, section: c, y: [0, 0, 1]}}\n" for i in range(4)) + "constraints:"
        for changes, close in ({"y: [1, 0, 0]": "y: [1, 0, 0], offset: {to: [0.1, 0.2, -0.3]}"}, 1e-7), ({"to: t": "to: e", "  m: {at": ends + "  m: {at"}, 1e-7), \
                ({", hold: [rx, ry]}": "}", "constraints:": beams}, 1e-7), ({"rz]},": "rz, uy]},", "rz]}}": "rz, uy]}}"}, 1e-5):
            a, b = ball, universal
            for of, to in changes.items():
                a, b = a.replace(of, to), b.replace(of, to)
            self.assertNotEqual(a, ball)
            self.same(a, b, close)
        one = ball.replace("to: t3, section: c, y: [1, 0, 0], release: {to: [rx, ry, rz]}", "to: t3, section: c, y: [1, 0, 0]")
        self.same(one, one.replace("{to: [rx, ry, rz]}", "{from: [rx], to: [ry, rz]}"), 1e-7)

    def test_pinned_columns(self):
        text = COLUMNS.replace("2e11", "2e14").replace("RELEASE", "{from: [ry, rz], to: [rx, ry, rz]}")
        text += "".join(f"  p{i}: {{force: [0, 0, -3000], on: t{i}}}\n" for i in range(4)) + """analyses: {B: {buckling: {}}, S: {static: {stations: [1]}}, C: {compliance: {node: m, about: S}}, F: {modal: {about: S}}}
quantities:
  b: {critical_factor: {analysis: B, which: 0}}
  t: {critical_factor: {analysis: B, which: 2}}
  c: {compliance: {analysis: C, row: rz, column: rz}}
  f: {frequency: {analysis: F, which: 2}}
"""
        found, P, h = self.values(text), 3000, 3
        turned = 8e4 - 32 * P / h
        for name, value in {"b": 1e4 * h / 4 / P, "t": 8e4 * h / 32 / P, "c": 1 / turned, "f": math.sqrt(turned / 30) / 2 / math.pi}.items():
            self.assertLess(abs(found[name] / value - 1), 1e-6, name)

    def test_braced_floor(self):
        loads, errors = "loads: {f: {force: [1e4, 2e4, -3e4], on: A}, g: {force: [0, 1e4, 5e3], on: C}}\n", []
        same = STOREY.replace("LOADS", loads).replace("HOLD", "").replace("RELEASE", "").replace(", hold: [uz, rx, ry], mass: 500", ", hold: [uz, rx, ry]")
        same = same[:same.index("analyses")] + "analyses: {L: {linear: {}}}\n" + """quantities:
  x: {displacement: {analysis: L, node: A, component: ux}}
  y: {displacement: {analysis: L, node: C, component: uy}}
  z: {displacement: {analysis: L, node: C, component: uz}}
  r: {displacement: {analysis: L, node: B, component: rx}}
"""
        exact = self.values(same.replace("CONSTRAINTS", "constraints: {floor: {diaphragm: [A, B, C], master: M, normal: z}}"))
        for stiff in (1e2, 1e4):
            bars = same.replace("  M: {at: [3, 2, 3], hold: [uz, rx, ry]}\n", "").replace("CONSTRAINTS", "")
            ends = ", release: {from: [rz], to: [rz, rx]}"
            bars = bars.replace("members:", "members:" + "".join(f"\n  {p}{q}: {{from: {p}, to: {q}, section: bar, y: [0, 0, 1]{ends}}}" for p, q in ("AB", "BC", "CA")))
            bars = bars.replace("sections:", f"sections:\n  bar: {{rectangle: {{width: 0.3, thickness: 0.3}}, young: {30e9 * stiff}, shear_modulus: {12e9 * stiff}}}")
            found = self.values(bars)
            errors.append(max(abs(found[name] / value - 1) for name, value in exact.items()))
        self.assertLess(errors[1], 1e-5)
        self.assertAlmostEqual(errors[0] / errors[1], 100, delta=10)

    def test_storey(self):
        example = ROOT / "cases" / "examples" / "eccentric_storey.yaml"
        for name in self.names():
            for q in self.record("solve", "--scene", example, "-f", name, "-n", "1")["quantities"]:
                self.assertLess(abs(q["error"]), 1e-8, f"{name}: {q['quantity']}")
        text, path = example.read_text(), self.folder / "storey.yaml"
        for old, new, words in (("d:  {at: [0, 4, 3], hold: [uz, rx, ry]}", "d:  {at: [0, 4, 3], hold: [uz, ux]}", "ux of node d is fixed or driven, but follows the master"),
                                ("d:  {at: [0, 4, 3], hold: [uz, rx, ry]}", "d:  {at: [0, 4, 3], axes: {x: [0, 1, 0], y: [1, 0, 0]}}", "node d has its own axes"),
                                ("[a, b, c, d], master", "[a, b, c, middle], master", "floor: node middle is named twice"),
                                ("normal: z}", "normal: z}\n  two: {equal: [a, b], components: [uy]}", "uy of node a also belongs to a diaphragm"),
                                ("normal: z}", "normal: z}\n  two: {diaphragm: [a], master: b, normal: z}", "also belongs to another constraint"),
                                (", normal: z}", "}", "{diaphragm: [NODE], master: NODE, normal: z}")):
            self.assertIn(old, text)
            path.write_text(text.replace(old, new))
            self.refused(2, words, "scene", "--scene", path)
        text = text.replace("pushed: {linear: {}}", "pushed: {linear: {}}\n  C: {compliance: {node: a}}")
        text = text.replace("quantities:", "quantities:" + "".join(
            f"\n  c{a}{b}: {{compliance: {{analysis: C, row: {a}, column: {b}}}}}" for a in ("ux", "uy", "rz") for b in ("ux", "uy")))
        det = "(ky*kt - kc^2)"  # the displacement of a is that of the middle plus the rotation times (-3, -2)
        text = text.replace("truths:", "truths:" + "".join(
            f"\n  - {{quantity: c{name}, value: {value}, kind: exact, source: statics, uncertainty: 1e-9}}" for name, value in {
                "uxux": f"1/ky + 4*ky/{det}", "uyuy": f"(kt + 6*kc + 9*ky)/{det}", "uxuy": f"(-2*kc - 6*ky)/{det}",
                "uyux": f"(-2*kc - 6*ky)/{det}", "rzux": f"2*ky/{det}", "rzuy": f"(-kc - 3*ky)/{det}"}.items()))
        path.write_text(text)
        for q in self.record("solve", "--scene", path, "-f", "collocation", "-n", "1")["quantities"]:
            self.assertLess(abs(q["error"]), 1e-8, q["quantity"])
