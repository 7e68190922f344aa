"""Floors that are rigid in their planes."""
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


class Diaphragms(ConstraintsCase):

    def test_diaphragm(self):
        """A diaphragm is rigid in its plane, also at large rotations and with eccentric loads. If nodes can tilt, the
        columns have universal joints at the floor."""
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

    def test_braced_floor(self):
        """A floor braced by stiff hinged bars must agree with a rigid diaphragm, up to a difference due to the
        compliance of the bars. The nodes may rise and tilt."""
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
