"""Critical loads beyond the first, about static paths: single, double, triple and almost equal loads, and loads near
which round-off hinders Newton's method."""
import json
import math
import unittest

import scipy.optimize

from harness.tools.kit.program import ProgramTest, run

PLAIN = "omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia]\n"
# Three equal columns below a floor that moves and rotates in its plane. A moment M changes the pattern of the matrix to
# an unsymmetric one.
STOREY = """beamwork: 1
sections: {s: {constants: {A: 1e-3, Iy: 1e-7, Iz: 1e-7, It: 4e-8}, young: 2e11, shear_modulus: 8e10}}
nodes:
  b0: {at: [0.5, 0, 0], hold: all}
  b1: {at: [-0.25, 0.4330127018922193, 0], hold: all}
  b2: {at: [-0.25, -0.4330127018922193, 0], hold: all}
  t0: {at: [0.5, 0, 2], hold: [rx, ry]}
  t1: {at: [-0.25, 0.4330127018922193, 2], hold: [rx, ry]}
  t2: {at: [-0.25, -0.4330127018922193, 2], hold: [rx, ry]}
  M: {at: [0.1, 0.2, 2], hold: [uz, rx, ry]}
members:
  m$i: {for: {i: 0..2}, from: b$i, to: t$i, section: s, y: [0, 1, 0]}
constraints:
  d: {diaphragm: [t0, t1, t2], master: M, normal: z}
  v: {equal: [t0, t1, t2], components: [uz]}
loads:
  p$i: {for: {i: 0..2}, force: [0, 0, -1e3], on: t$i}
analyses: {st: {static: {stations: [1]}}, bu: {buckling: {about: st}}}
quantities:
  c_$i: {for: {i: 0..2}, critical_factor: {analysis: bu, which: $i}}
""" + PLAIN


def columns(second_moments, wanted):
    each = list(enumerate(second_moments))
    lines = ["beamwork: 1", "sections:"]
    lines += [f"  s{k}: {{constants: {{A: 1e6, Iy: {Iy!r}, Iz: 1, It: 1}}, young: 1, shear_modulus: 1}}" for k, Iy in each]
    lines += ["nodes:"] + [f"  a{k}: {{at: [0, {k}, 0], hold: all}}\n  b{k}: {{at: [1, {k}, 0]}}" for k, _ in each]
    lines += ["members:"] + [f"  m{k}: {{from: a{k}, to: b{k}, section: s{k}, y: [0, 1, 0]}}" for k, _ in each]
    lines += ["loads:"] + [f"  p{k}: {{force: [-1, 0, 0], on: b{k}}}" for k, _ in each]
    lines += ["analyses: {st: {static: {stations: [1]}}, bu: {buckling: {about: st}}}", "quantities:"]
    lines += [f"  c_{i}: {{critical_factor: {{analysis: bu, which: {i}}}}}" for i in range(wanted)]
    return "\n".join(lines) + "\n" + PLAIN


def shortened(load, stiffness):
    return scipy.optimize.brentq(lambda P: P*(1 - P/stiffness) - load, load, 2*load, xtol=1e-13*load)


class FurtherLoads(ProgramTest):

    def found(self, scene, formulation, n):
        done = run("solve", "--scene", "/dev/stdin", "-f", formulation, "-n", n, "--format", "json", input=scene)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return [q["value"] for q in json.loads(done.stdout)["quantities"]]

    def test_columns(self):
        table = ((2,), (1,), (2, 2), (1, 1), (1, 1, 1), (2, 2, 2), (1, 1.0001), (2, 1 + 1e-6), (1, 1 + 1e-8), (4, 1.5, 9))
        for second_moments in table:
            wanted = 8
            exact = sorted(shortened(((2*k + 1)*math.pi/2)**2*I, 1e6)
                           for k in range(wanted) for Iy in second_moments for I in (1, Iy))[:wanted]
            for value, right in zip(self.found(columns(second_moments, wanted), "collocation", 16), exact):
                with self.subTest(second_moments=second_moments, load=right):
                    self.assertAlmostEqual(value, right, delta=3e-9*right)

    def test_storey(self):
        EI, EA, GJ, L, r = 2e4, 2e8, 3.2e3, 2, 0.5

        def twist(P):
            length = 1 - P/EA
            u = math.sqrt(P*length/EI)*L/2
            return r*r*P/(length*L*(math.tan(u)/u - 1)) + GJ/L
        sway = shortened(math.pi**2*EI/L**2, EA)
        exact = [sway, sway, scipy.optimize.brentq(twist, 1.001*sway, 1.4*sway, xtol=1e-9)]
        for n, within in ((2, 1e-7), (4, 1e-8), (8, 1e-8)):
            for value, right in zip(self.found(STOREY, "collocation", n), exact):
                with self.subTest(n=n, load=right):
                    self.assertAlmostEqual(value*1e3, right, delta=within*right)


if __name__ == "__main__":
    unittest.main()
