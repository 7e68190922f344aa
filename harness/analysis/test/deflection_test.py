"""Displacements and rotations within members must be those of closed forms or of a node at the same position.
Rotations of released ends must be those of closed forms."""
import math
import unittest

from harness.tools.kit.program import ProgramTest, run

FORMULATIONS = ("collocation", "geometrically_exact", "beamw", "beamw_consistent", "beamw_first", "beamw_vlasov",
                "sheet_second", "sheet_second_consistent", "sheet_third", "sheet_third_printed")
BEAM = """beamwork: 1
let: {L: 2, q: 10}
sections:
  s: {rectangle: {width: 0.02, thickness: 0.01}, young: 210e9, shear_modulus: 81e9, density: 7800, expansion: 1e-5}
nodes:
  a: {at: [0, 0, 0], hold: [ux, uy, uz, rx]}
  b: {at: [L, 0, 0], hold: [uy, uz]}
  c: {at: [0, 0, 1], hold: all}
  d: {at: [L, 0, 1]}
members:
  ab: {from: a, to: b, section: s, y: [0, 1, 0]}
  cd: {from: c, to: d, section: s, y: [0, 1, 0]}
loads:
  w: {distributed: [0, -q, 0], on: ab}
  t: {temperature: 0, gradient: [-1000, 0], on: cd}
analyses:
  lin: {linear: {}}
  sta: {static: {stations: [1e-4, 1]}}
quantities:
  mid:     {deflection: {analysis: lin, member: ab, where: 0.5, component: uy}}
  little:  {deflection: {analysis: sta, member: ab, where: 0.5, component: uy, at: 1e-4}, factor: 1e4}
  slope:   {deflection: {analysis: lin, member: ab, where: 0.25, component: rz}}
  end:     {deflection: {analysis: lin, member: ab, end: from, component: rz}}
  warm:    {deflection: {analysis: lin, member: cd, where: 0.4, component: uy}}
  warmed:  {deflection: {analysis: sta, member: cd, where: 0.4, component: uy}}
  turned:  {deflection: {analysis: sta, member: cd, where: 0.4, component: rz}}
  along:   {deflection: {analysis: sta, member: cd, where: 0.4, component: ux}}
omit: [shear, trapeze, wagner_moments, wagner_torque]
"""
FAR = """beamwork: 1
sections:
  s: {rectangle: {width: 0.02, thickness: 0.002}, young: 210e9, shear_modulus: 81e9, density: 7800}
nodes:
  a: {at: [0, 0, 0], hold: all}
  b: {at: [1, 0, 0]}
  c: {at: [0, 0, 1], hold: all}
  m: {at: [0.3, 0, 1]}
  d: {at: [1, 0, 1]}
members:
  ab: {from: a, to: b, section: s, y: [0, 1, 0], warping: free}
  cm: {from: c, to: m, section: s, y: [0, 1, 0], warping: free}
  md: {from: m, to: d, section: s, y: [0, 1, 0], warping: free}
loads:
  p: {force: [0, 12, 0], on: b}
  q: {force: [0, 12, 0], on: d}
analyses:
  sta: {static: {stations: 0..1/2}}
  con: {continuation: {control: {node: b, component: uy}, to: [0.1, 0.2], step: 0.1}}
  rot: {rotation: {omega: [0, 0, 5], stations: [1]}}
  mo:  {motion: {stations: 0..0.2/10, integrator: radau, step: 2e-3}}
quantities:
%s
omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia]
"""
PAIRS = [(a, c, t) for a in ("sta", "con", "rot", "mo") for c in ("ux", "uy", "rz") for t in ("last", "max", "curve")]
LINES = "\n".join(f"  w_{a}_{c}_{t}: {{deflection: {{analysis: {a}, member: ab, where: 0.3, component: {c}, take: {t}}}}}\n"
                  f"  n_{a}_{c}_{t}: {{displacement: {{analysis: {a}, node: m, component: {c}, take: {t}}}}}" for a, c, t in PAIRS)
HINGED = """beamwork: 1
sections:
  s: {rectangle: {width: 0.02, thickness: 0.01}, young: 210e9, shear_modulus: 81e9, density: 7800}
nodes:
  foot: {at: [0, 0, 0], hold: [ux, uy, uz, rx, ry], drive: {rz: turn}}
  tip:  {at: [1, 0, 0], hold: [rx, ry, rz, uz], drive: {ux: x, uy: y}}
  base: {at: [0, 0, 1], hold: all}
  out:  {at: [1, 0, 1], hold: [uy, uz, rx, ry, rz], drive: {ux: slide}}
members:
  bar:  {from: foot, to: tip, section: s, y: [0, 1, 0], release: {from: [rz], to: [rz]}, warping: free}
  rod:  {from: base, to: out, section: s, y: [0, 1, 0], release: {to: [ux]}}
motions:
  turn:  {unit: rad, path: [0, 1], value: [0, 0.5]}
  x:     {unit: m, path: [0, 0.25, 0.5, 0.75, 1], value: [0, cos(0.5) - 1, cos(1) - 1, cos(1.5) - 1, cos(2) - 1]}
  y:     {unit: m, path: [0, 0.25, 0.5, 0.75, 1], value: [0, sin(0.5), sin(1), sin(1.5), sin(2)]}
  slide: {unit: m, path: [0, 1], value: [0, 0.1]}
analyses: {sta: {static: {stations: 0..1/4}}}
quantities:
  first: {hinge: {analysis: sta, member: bar, end: from, component: rz}}
  first_all: {hinge: {analysis: sta, member: bar, end: from, component: rz, take: curve}}
  last:  {hinge: {analysis: sta, member: bar, end: to, component: rz}}
  end:   {deflection: {analysis: sta, member: bar, end: from, component: rz}}
  mid:   {deflection: {analysis: sta, member: bar, where: 0.5, component: uy}}
  gone:  {hinge: {analysis: sta, member: rod, end: to, component: ux}}
omit: [shear, trapeze, wagner_moments, wagner_torque]
"""
RELEASED = """beamwork: 1
sections: {s: {constants: {A: 1e-3, Iy: 2e-7, Iz: 1e-7, It: 1e-7}, young: 2e11, shear_modulus: 8e10}}
nodes: {a: {at: [0, 0, 0], hold: all}, m: {at: [0.6, 0.8, 0]}, b: {at: [1.2, 1.6, 0], hold: [ux, uy, uz]}}
springs: {k: {to: b, stiffness: [0, 0, 0, 3e3, 2e3, 4e3]}}
members:
  l: {from: a, to: m, section: s, y: [-0.48, 0.36, 0.8], release: {to: [%s]}}
  r: {from: m, to: b, section: s, y: [-0.48, 0.36, 0.8]}
combinations: {both: {one: 2, two: 1}}
loads:
  p: {force: [40, 10, 60], on: m, case: one}
  t: {moment: [7, 5, -3], on: m, case: two}
analyses: {li: {linear: {}}, st: {static: {stations: [1e-6], combination: both}}}
quantities:
%s
omit: [shear, trapeze, wagner_moments, wagner_torque]
"""


class Deflections(ProgramTest):

    def written(self, scene):
        path = self.folder / "scene.yaml"
        path.write_text(scene)
        return path

    def solved(self, scene, formulation, n):
        record = self.record("solve", "--scene", self.written(scene), "-f", formulation, "-n", n)
        return ({q["quantity"]: q for q in record["quantities"]},
                {c["quantity"]: c["curve_value"] for c in record["curves"]})

    def test_beam(self):
        bending = 210e9*0.02*0.01**3/12
        curvature = 0.01
        exact = {"mid": -5*10*2**4/(384*bending), "little": -5*10*2**4/(384*bending),
                 "slope": -10*(8 - 6*2*0.25 + 4*0.125)/(24*bending), "end": -10*8/(24*bending),
                 "warm": curvature*0.32, "warmed": (1 - math.cos(0.8*curvature))/curvature, "turned": 0.8*curvature,
                 "along": math.sin(0.8*curvature)/curvature - 0.8}
        for formulation in FORMULATIONS:
            got, _ = self.solved(BEAM, formulation, 1)
            for name, value in exact.items():
                self.assertEqual(got[name]["status"], "ok", (formulation, got[name]["reason"]))
                within = 1e-3 if name in ("warmed", "turned", "along") and formulation != "collocation" else 1e-7
                self.assertLess(abs(got[name]["value"]/value - 1), within, (formulation, name))

    def test_hinge_in_linear_analyses(self):
        pinned = RELEASED.replace("[40, 10, 60]", "[48, -36, -80]").replace("[0, 0, 0, 3e3, 2e3, 4e3]", "[0, 0, 0, 1e-4, 0, 0]")
        text = pinned % ("rz", "  h: {hinge: {analysis: li, member: l, end: to, component: rz, case: one}}")
        for formulation in FORMULATIONS:
            got, _ = self.solved(text, formulation, 1)
            self.assertAlmostEqual(got["h"]["value"], -100*(1/2 + 1/3)/2e4, delta=1e-9)
        for released in (["rz"], ["ry", "rz"], ["rz", "ry"], ["rx", "ry", "rz"], ["ux"], ["ux", "rx", "ry", "rz"]):
            lines = "\n".join(f"  {c}_{a}: {{hinge: {{analysis: {a}, member: l, end: to, component: {c}{more}}}}}"
                              for c in released for a, more in (("li", ", combination: both"), ("st", "")))
            got, _ = self.solved(RELEASED % (", ".join(released), lines), "collocation", 1)
            for c in released:
                with self.subTest(released=released, component=c):
                    value = got[f"{c}_li"]["value"]
                    self.assertGreater(abs(value), 1e-7)
                    self.assertAlmostEqual(got[f"{c}_st"]["value"], 1e-6*value, delta=1e-10*abs(value) + 3e-16)

    def test_far(self):
        for formulation, n, within in (("collocation", 8, 4e-3), ("geometrically_exact", 12, 4e-3), ("beamw", 12, 1e-2)):
            got, curves = self.solved(FAR % LINES, formulation, n)
            for a, c, t in PAIRS:
                if a == "mo" and formulation == "beamw":
                    continue
                one, two = got[f"w_{a}_{c}_{t}"], got[f"n_{a}_{c}_{t}"]
                if one["status"] != "ok" or two["status"] != "ok":
                    self.assertEqual((one["status"], t), (two["status"], t), (a, c, one["reason"], two["reason"]))
                    continue
                size = max(abs(v) for v in curves[f"n_{a}_{c}_curve"])
                self.assertLess(abs(one["value"] - two["value"]), within*size + 1e-12, (formulation, a, c, t))
        for v, w in zip(curves["w_sta_uy_curve"], curves["n_sta_uy_curve"]):
            self.assertLess(abs(v - w), 1e-2*abs(w) + 1e-14)

    def test_hinges(self):
        for formulation in ("collocation", "beamw", "sheet_third"):
            got, curves = self.solved(HINGED, formulation, 1)
            for name, value in (("first", 1.5), ("last", 2.0), ("end", 2.0), ("mid", math.sin(2)/2)):
                self.assertLess(abs(got[name]["value"] - value), 1e-9, (formulation, name, got[name]))
            self.assertLess(abs(abs(got["gone"]["value"]) - 0.1), 1e-9, got["gone"])
            for k, value in enumerate(curves["first_all"]):
                self.assertLess(abs(value - 0.375*k), 1e-9, (formulation, k))

    def test_refused(self):
        done = run("solve", "--scene", self.written(HINGED.replace("member: rod, end: to, component: ux",
                                                                   "member: rod, end: from, component: ux")), "-n", 1)
        self.assertIn("member rod does not release ux at its end 'from'", done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
