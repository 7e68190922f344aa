"""Scenes and checks shared by tests of constraints."""
from harness.tools.kit.program import ProgramTest

HEAD = """beamwork: 1
sections: {s: {rectangle: {width: 0.02, thickness: 0.03}, young: 2e9, shear_modulus: 0.8e9, density: 2000}}
"""
MASS = ", mass: 0.5, centre: [0.02, 0.01, 0.03], inertia: [0.01, 0.02, 0.015, 0, 0, 0]"
ALL = "components: [ux, uy, uz, rx, ry, rz]"
GEAR = """beamwork: 1
sections: {s: {tube: {diameter: 0.02, thickness: 0.01}, young: 210e9, shear_modulus: 80e9, density: 1e-3}}
nodes:
  a: {at: [0, 0, 0], hold: all}
  b: {at: [0, 0, 1], AXES hold: [ux, uy, rx, ry], inertia: [0.3, 0.3, 0.3, 0, 0, 0]}
  c: {at: [0.1, 0, 1], hold: all}
  d: {at: [0.1, 0, 3], AXES hold: [ux, uy, rx, ry], inertia: [0.05, 0.05, 0.05, 0, 0, 0]}
members:
  m: {from: a, to: b, section: s, y: [0, 1, 0]}
  n: {from: c, to: d, section: s, y: [0, 1, 0]}
constraints: {gear: {node: WHO, component: rz, ratio: RATIO, of: OTHER}}
loads: {t: {moment: [0, 0, TORQUE], on: b}, u: {moment: [0, 0, -5], on: d}}
omit: [shear, trapeze, wagner_torque, wagner_moments, rotary_inertia]
analyses:
  L: {linear: {}}
  S: {static: {stations: [0.5, 1]}}
  M: {modal: {}}
  MS: {modal: {about: S}}
  C: {compliance: {node: b}}
  D: {compliance: {node: d, about: S}}
quantities:
  lb: {displacement: {analysis: L, node: b, component: rz}}
  sb: {displacement: {analysis: S, node: b, component: rz}}
  sd: {displacement: {analysis: S, node: d, component: rz}}
  rb: {reaction: {analysis: S, node: b, component: rz}}
  rd: {reaction: {analysis: S, node: d, component: rz}}
  f: {frequency: {analysis: M}}
  fs: {frequency: {analysis: MS}}
  c: {compliance: {analysis: C, row: rz, column: rz}}
  d: {compliance: {analysis: D, row: rz, column: rz}}
"""


class ConstraintsCase(ProgramTest):
    def values(self, text, formulation="collocation", elements=2):
        return self.values_of(text, "-f", formulation, "-n", elements)

    def same(self, one, two, close=1e-10, **options):
        a, b = self.values(one, **options), self.values(two, **options)
        self.assertGreater(len(a), 0)
        for name, value in a.items():
            self.assertLess(abs(b[name] - value), close * abs(value), name)

    def names(self):
        names = [f["formulation"] for f in self.record("list", "formulations")["formulations"]]
        self.assertGreaterEqual(len(names), 10)
        return names
