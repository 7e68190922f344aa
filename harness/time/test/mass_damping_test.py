"""With mass-proportional damping, momenta of a free structure and the motion of an oscillator must
agree with closed forms."""
import math
import unittest

from harness.tools.kit.program import ProgramTest, run

FREE = """beamwork: 1
sections: {s: {rectangle: {width: 0.02, thickness: 0.02}, young: 70e9, shear_modulus: 26e9, density: 2700}}
nodes:
  a: {at: [0, 0, 0]}
  b: {at: [1, 0, 0], mass: 2, centre: [0.1, 0.05, 0], inertia: [0.1, 0.2, 0.25, 0.01, 0, 0]}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}
analyses: {go: {motion: {stations: [0.1], %s, damping: {mass: %g}, start: {velocity: [1, 2, 0.5], spin: [0, 0, 2]}}}}
quantities:
  px: {momentum: {analysis: go, component: px}}
  py: {momentum: {analysis: go, component: py}}
  pz: {momentum: {analysis: go, component: pz}}
  lz: {momentum: {analysis: go, component: lz}}
  lost: {energy: {analysis: go, of: dissipated}}
  drift: {energy: {analysis: go, of: drift}}
omit: [trapeze, wagner_moments, wagner_torque]
"""
MASS = """beamwork: 1
sections: {s: {constants: {A: 1e-4, Iy: 1e-8, Iz: 1e-8, It: 1e-8}, young: 2e11, shear_modulus: 8e10}}
nodes:
  b: {at: [1, 0, 0], hold: [uy, uz, rx, ry, rz], mass: 2}
  c: {at: [2, 0, 0], hold: [uy, uz, rx, ry, rz], mass: 3}
members: {m: {from: b, to: c, section: s, y: [0, 1, 0]}}
springs: {k: {to: b, stiffness: [200, 0, 0, 0, 0, 0]}}
analyses: {go: {motion: {stations: [0.7], %s, damping: {mass: 3}, start: {velocity: [0.1, 0, 0]}}}}
quantities:
  x: {displacement: {analysis: go, node: b, component: ux}}
  v: {rate: {analysis: go, node: b, component: ux}}
  between: {internal: {analysis: go, member: m, end: to, resultant: N}}
omit: [trapeze, wagner_moments, wagner_torque]
"""
LIGHT = """beamwork: 1
sections:
  tube: {tube: {diameter: 20e-3, thickness: 1e-3}, young: 70e9, shear_modulus: 26e9, density: 2700}
nodes:
  g: {at: [0, 1, 0], hold: all}
  h: {at: [1, 1, 0], hold: all}
  base: {at: [0, 0, 0], hold: [uy, uz, rx, ry, rz], drive: {ux: shake}}
  mid:  {at: [0.1, 0, 0], hold: [uy, uz, rx, ry, rz]}
  far:  {at: [0.2, 0, 0], hold: [uy, uz, rx, ry, rz], mass: 1}
members:
  w: {from: g, to: h, section: tube, y: [0, 1, 0]}
springs:
  a: {from: base, to: mid, %s, damping: [%s, 0, 0, 0, 0, 0]}
  b: {from: mid, to: far, stiffness: [3000, 0, 0, 0, 0, 0]}
motions:
  shake: {unit: m, time: 1e-2*(1-cos(20*t))}
loads:
  p: {force: [5, 0, 0], on: mid, time: 1 + t}
analyses:
  run: {motion: {stations: [1e-3, 0.01, 0.1], step: 1e-3, integrator: %s}}
quantities:
  early: {displacement: {analysis: run, node: mid, component: ux, at: 1e-3}}
  next: {displacement: {analysis: run, node: mid, component: ux, at: 0.01}}
  end:  {displacement: {analysis: run, node: mid, component: ux}}
omit: [trapeze, wagner_moments, wagner_torque]
"""
HOW = (("integrator: radau", 1e-6), ("integrator: alpha, rho: 1, step: 5e-4", 2e-6),
       ("integrator: explicit, step: 1e-5, mass: lumped", 1e-7))


class MassDampingTest(ProgramTest):

    def values(self, text, formulation):
        path = self.folder/"scene.yaml"
        path.write_text(text, encoding="utf-8")
        record = self.record("solve", "--scene", path, "-f", formulation, "-n", 2)
        for q in record["quantities"]:
            self.assertEqual(q["status"], "ok", q)
        return {q["quantity"]: q["value"] for q in record["quantities"]}

    def test_free(self):
        """With mass-proportional damping a, the momenta of a free structure must decay as exp(-a t), and the lost
        energy must equal the dissipated energy."""
        for how, most in HOW:
            for formulation in ("collocation", "sheet_third") if how[12] != "e" else ("sheet_third",):
                plain, damped = (self.values(FREE % (how, a), formulation) for a in (0, 3))
                for name in ("px", "py", "pz", "lz"):
                    self.assertAlmostEqual(damped[name]/plain[name]/math.exp(-0.3), 1, delta=most, msg=(how, formulation, name))
                self.assertGreater(damped["lost"], 5)
                self.assertLess(abs(damped["drift"]), 1e-5*damped["lost"], (how, formulation))

    def test_oscillator(self):
        w, a, t = math.sqrt(200/5), 3, 0.7
        d = math.sqrt(w*w - a*a/4)
        x = 0.1*math.exp(-a*t/2)*math.sin(d*t)/d
        v = 0.1*math.exp(-a*t/2)*(math.cos(d*t) - a/2*math.sin(d*t)/d)
        accelerates = -a*v - w*w*x
        for how in ("integrator: radau, tolerance: 1e-9", "integrator: alpha, rho: 0.9, step: 1e-4"):
            got = self.values(MASS % how, "collocation")
            self.assertAlmostEqual(got["x"]/x, 1, delta=2e-4, msg=how)
            self.assertAlmostEqual(got["v"]/v, 1, delta=2e-4, msg=how)
            self.assertAlmostEqual(got["between"]/(-3*(accelerates + a*v)), 1, delta=1e-3, msg=how)

    def test_refused(self):
        path = self.folder/"scene.yaml"
        path.write_text(FREE % ("integrator: conserving", 3), encoding="utf-8")
        done = run("solve", "--scene", path, "-f", "collocation", "-n", 1)
        self.assertRegex(done.stdout + done.stderr, "conserving does not support damping of masses")

    def test_light_dashpot(self):
        for damping in ("1e-6", "1e-4"):
            for integrator in ("alpha", "radau"):
                both = []
                for spring in ("stiffness: [1000, 0, 0, 0, 0, 0]",
                               "tables: {ux: {at: [-1, 1], value: [-1000, 1000]}}"):
                    path = self.folder/"light.yaml"
                    path.write_text(LIGHT % (spring, damping, integrator), encoding="utf-8")
                    record = self.record("solve", "--scene", path, "-f", "beamw", "-n", 1)
                    both.append([q["value"] for q in record["quantities"]])
                for one, other in zip(*both, strict=True):
                    self.assertAlmostEqual(one, other, delta=2e-9)


if __name__ == "__main__":
    unittest.main()
