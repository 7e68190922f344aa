"""If many keys of scene files are combined in one structure, formulations must agree within 0.3 %
and integrators within 0.2 %."""
from cases.format.test.scene_case import SceneCase, values

HEAD = """beamwork: 1
sections:
  ipe: {profile: IPE200, young: 210e9, shear_modulus: 81e9, density: 7850, expansion: 12e-6}
nodes:
  foot: {at: [0, 0, 0], hold: all}
  middle: {at: [2, 0, 0.3]}
  end: {at: [4, 0, 0.3], hold: [uy], mass: 20}
members:
  first: {from: foot, to: middle, section: ipe, y: [0, 1, 0], warping: free, imperfection: {amplitude: [4e-3, 0]}, divisions: 8}
  second: {from: middle, to: end, section: ipe, y: [0, 1, 0], warping: free, offset: {to: [0, 0, 0.05]}, pretension: 3e3,
           foundation: {translation: [0, 0, 2e5], rotation: [0, 0, 0]}, divisions: 8}
springs:
  stop: {to: end, stiffness: [0, 1e4, 0, 0, 0, 0], damping: [0, 0, 300, 0, 0, 0], tables: {uz: {at: [-1, 0, 1], value: [-3e5, 0, 1e5]}}}
loads:
  push: {force: [-2e3, 500, -4e3], on: end}
  sun: {temperature: 25, gradient: [0, 60], on: first}
"""
STATIC = """analyses: {path: {static: {stations: 0..1/4}}, tones: {modal: {about: path}}}
quantities:
  ux: {displacement: {analysis: path, node: end, component: ux, at: 1}}
  uz: {displacement: {analysis: path, node: end, component: uz, at: 1}}
  ry: {displacement: {analysis: path, node: middle, component: ry, at: 1}}
  N: {internal: {analysis: path, member: first, end: from, resultant: N, at: 1}}
  R: {reaction: {analysis: path, node: foot, component: ry, at: 1}}
  f: {frequency: {analysis: tones, which: 0}}
"""
MOVED = HEAD.replace("on: end}", "on: end, time: cos(20*t)}")
MOTION = """analyses: {{path: {{static: {{stations: [1]}}}}, shake: {{motion: {{stations: [0.1, 0.2], about: path, integrator: {integrator}, {steps}}}}}}}
quantities:
  ux: {{displacement: {{analysis: shake, node: end, component: ux}}}}
  uz: {{displacement: {{analysis: shake, node: end, component: uz}}}}
  ry: {{displacement: {{analysis: shake, node: middle, component: ry}}}}
  drift: {{energy: {{analysis: shake, of: drift}}}}
  energy: {{energy: {{analysis: shake, of: energy}}}}
mass: lumped
"""
# A bar that is heated suddenly, at rest. Its energy is that of the strain that the heat requires, E A L (a T)^2/2.
HEATED = """beamwork: 1
sections: {s: {rectangle: {width: 0.05, thickness: 0.02}, young: 2e11, shear_modulus: 8e10, density: 7800, expansion: 1e-5}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0], mass: 2}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}
loads: {heat: {temperature: 5, on: m}}
analyses: {go: {motion: {stations: [0.05], integrator: conserving, step: 1e-3}}}
quantities: {energy: {energy: {analysis: go, of: energy}}, drift: {energy: {analysis: go, of: drift}}}
omit: [trapeze, wagner_moments, wagner_torque]
"""


class CombinedTest(SceneCase):

    def solve(self, text, formulation, *more):
        return values(self.record("solve", "--scene", self.scene(text), "-f", formulation, "-n", 8, *more))

    def test_formulations_agree(self):
        text = HEAD + STATIC + "omit: [wagner_torque]\n"
        one = self.solve(text, "collocation")
        self.assertGreater(abs(one["uz"]), 1e-3)
        for formulation in ("geometrically_exact", "beamw_consistent", "beamw", "sheet_second", "sheet_third"):
            other = self.solve(text, formulation)
            for name, value in one.items():
                self.assertAlmostEqual(other[name] / value, 1, delta=3e-3, msg=(formulation, name))

    def test_integrators_agree(self):
        runs = {"radau": "tolerance: 1e-6", "alpha": "step: 2.5e-4", "conserving": "step: 2.5e-4"}
        got = {name: self.solve(MOVED + MOTION.format(integrator=name, steps=steps), "collocation")
               for name, steps in runs.items()}
        for name in ("alpha", "conserving"):
            for quantity in ("ux", "uz", "ry"):
                self.assertAlmostEqual(got[name][quantity] / got["radau"][quantity], 1, delta=2e-3,
                                       msg=(name, quantity))
        for name in runs:
            bound = 1e-9 if name == "conserving" else 1e-4
            self.assertLess(abs(got[name]["drift"]), bound * abs(got[name]["energy"]), name)

    def test_heat_conserves_energy(self):
        for formulation in ("beamw", "beamw_vlasov", "beamw_first", "collocation", "sheet_third"):
            got = self.solve(HEATED, formulation)
            self.assertAlmostEqual(got["energy"], 2e11*1e-3*(1e-5*5)**2/2, delta=1e-9, msg=formulation)
            self.assertLess(abs(got["drift"]), 1e-9, formulation)

    def test_explicit(self):
        text = MOVED.replace(", pretension: 3e3", "") + MOTION.format(integrator="explicit", steps="step: 1e-5")
        self.refused(2, ["member second has an offset", "part_of"], "solve", "--scene", self.scene(text), "-n", 1)

    def test_another_order_of_ends(self):
        there = HEAD.replace(
            "from: foot, to: middle, section: ipe, y: [0, 1, 0], warping: free, imperfection: {amplitude: [4e-3, 0]}",
            "from: middle, to: foot, section: ipe, y: [0, -1, 0], warping: free, imperfection: {amplitude: [-4e-3, 0]}"
        ).replace("from: middle, to: end, section: ipe, y: [0, 1, 0], warping: free, offset: {to: [0, 0, 0.05]}",
                  "from: end, to: middle, section: ipe, y: [0, -1, 0], warping: free, offset: {from: [0, 0, 0.05]}")
        self.assertNotEqual(there, HEAD)
        back = STATIC.replace("end: from, resultant: N", "end: to, resultant: N")
        for formulation in ("collocation", "beamw_consistent"):
            one, other = self.solve(HEAD + STATIC, formulation), self.solve(there + back, formulation)
            for name, value in one.items():
                self.assertAlmostEqual(other[name] / value, 1, delta=1e-7, msg=(formulation, name))
