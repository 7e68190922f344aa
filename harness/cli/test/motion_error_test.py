"""The error of time of motions whose integration is left to the program: 0.1 % of the motion, be it
nanometres or metres."""
import math
import random
import unittest

from harness.tools.kit.program import ProgramTest

# A mass on a leaf; a force comes at once: u/u_static = 1 - cos(omega t).
SUDDEN = """beamwork: 1
parameters: {{force: {{value: 1, unit: N}}}}
let: {{T: 2*pi*sqrt(0.5*0.1^3/60), us: force*0.1^3/60}}
sections:
  s: {{constants: {{A: 1e-4, Iy: 1e-10, Iz: 1e-10, It: 2e-10}}, young: 200e9, shear_modulus: 80e9, density: 0}}
nodes:
  a: {{at: [0, 0, 0], hold: all}}
  b: {{at: [0.1, 0, 0], mass: 0.5}}
members:
  leaf: {{from: a, to: b, section: s, y: [0, 1, 0]}}
loads:
  p: {{force: [0, force, 0], on: b, time: 1}}
analyses:
  mo: {{motion: {{{how}stations: [T/4, T, 2.25*T, 10.25*T]}}}}
quantities:
  u: {{displacement: {{analysis: mo, node: b, component: uy, take: curve}}, factor: 1/us, unit: 1}}
  largest: {{displacement: {{analysis: mo, node: b, component: uy, take: max}}, factor: 1/us, unit: 1}}
omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia]
"""

# A corner of two leaves that something sets in motion.
CORNER = """beamwork: 1
sections:
  s: {{rectangle: {{width: {width}, thickness: {t}}}, young: 70e9, shear_modulus: 27e9, density: 2700}}
nodes:
  a: {{at: [0, 0, 0], {end}}}
  b: {{at: [{L}, 0, 0], mass: {mass}, inertia: [{I}, {I}, {I}, 0, 0, 0]}}
  c: {{at: [{L}, 0, {half}]}}
members:
  m: {{from: a, to: b, section: s, y: [0, 1, 0]}}
  k: {{from: b, to: c, section: s, y: [0, 1, 0]}}
{acts}analyses:
  mo: {{motion: {{{how}stations: [{stations}]{start}}}}}
quantities:
  u: {{displacement: {{analysis: mo, node: b, component: uy, take: curve}}}}
  v: {{displacement: {{analysis: mo, node: b, component: ux, take: curve}}}}
  w: {{displacement: {{analysis: mo, node: c, component: uy, take: curve}}}}
"""

# A leaf that hangs at rest under a load.
REST = """beamwork: 1
sections:
  s: {{rectangle: {{width: 0.02, thickness: 0.002}}, young: 70e9, shear_modulus: 27e9, density: 2700}}
nodes:
  a: {{at: [0, 0, 0], hold: all}}
  b: {{at: [0.3, 0, 0], mass: 0.1, inertia: [1e-5, 1e-5, 1e-5, 0, 0, 0]}}
members:
  m: {{from: a, to: b, section: s, y: [0, 1, 0]}}
loads:
  p: {{force: [0, {force}, 0], on: b}}
analyses:
  st: {{static: {{stations: [1]}}}}
  mo: {{motion: {{{how}stations: [0.1, 0.5], about: st}}}}
quantities:
  u: {{displacement: {{analysis: mo, node: b, component: uy, take: curve}}}}
"""

# A hub that is driven about three axes, one inside the other.
ANGLES = """beamwork: 1
sections:
  tube: {tube: {diameter: 20e-3, thickness: 1e-3}, young: 70e9, shear_modulus: 26e9, density: 2700}
nodes:
  hub: {at: [0, 0, 0], hold: [ux, uy, uz], rotation: {sequence: [{axis: z, angle: turn}, {axis: y, angle: tilt}, {axis: x, angle: roll}]}}
  tip: {at: [1, 0, 0], mass: 0.3}
members:
  arm: {from: hub, to: tip, section: tube, y: [0, 1, 0]}
motions:
  turn: {unit: rad, pieces: [{until: 0.5, is: 60*deg*(2*t - sin(4*pi*t)/(2*pi))}, {is: 60*deg}]}
  tilt: {unit: rad, pieces: [{until: 0.5, is: 40*deg*(2*t - sin(4*pi*t)/(2*pi))}, {is: 40*deg}]}
  roll: {unit: rad, pieces: [{until: 0.5, is: 100*deg*(2*t - sin(4*pi*t)/(2*pi))}, {is: 100*deg}]}
analyses:
  swing: {motion: {stations: [0.2, 0.5, 0.7, 1], HOW}}
quantities:
  x: {displacement: {analysis: swing, node: tip, component: ux, take: curve}}
  y: {displacement: {analysis: swing, node: tip, component: uy, take: curve}}
  z: {displacement: {analysis: swing, node: tip, component: uz, take: curve}}
  work: {energy: {analysis: swing, of: work, take: curve}}
"""


def corner(seed, how):
    """A scene by chance: size, mass, what acts, how far (1e-7 to 1e-2 of it) and how long."""
    chance = random.Random(seed)
    L = 10**chance.uniform(-1.3, 0.5)
    t = L/chance.choice([20, 50, 100])
    width = t*chance.choice([1, 2, 5])
    mass = chance.choice([0.5, 2])*2700*width*t*L
    omega = math.sqrt(3*70e9*width*t**3/12/L**3/(mass + 0.6*2700*width*t*L))
    end = chance.choice([3, 8, 20])/omega
    reach = 10**chance.uniform(-7, -2)*L
    force = reach*3*70e9*width*t**3/12/L**3
    acts = {
        "force": f"loads:\n  p: {{force: [0, {force}, {force/3}], on: b, time: 1}}\n",
        "sine": f"loads:\n  p: {{force: [0, {force}, {force/3}], on: b, time: sin({0.9*omega}*t)}}\n",
        "ramp": f"loads:\n  p: {{force: [0, {force}, 0], on: b, time: t^2*{1/end**2}}}\n",
        "drive": f"motions:\n  sh: {{unit: m, pieces: [{{is: \"{reach}*sin({0.4*omega}*t)^3\"}}]}}\n",
        "start": "",
    }
    kind = list(acts)[seed % len(acts)]
    return CORNER.format(
        L=L, half=L/2, t=t, width=width, mass=mass, I=mass*(L/10)**2, how=how, acts=acts[kind],
        end="hold: [ux, uz, rx, ry, rz], drive: {uy: sh}" if kind == "drive" else "hold: all",
        start=f", start: {{velocity: [0, {reach*omega}, 0]}}" if kind == "start" else "",
        stations=", ".join(str(part*end) for part in (0.13, 0.37, 0.62, 0.81, 1)))


class MotionError(ProgramTest):

    def curves(self, text, *options):
        """The curves of a scene, by their names, and the others' values."""
        path = self.folder / "scene.yaml"
        path.write_text(text, encoding="utf-8")
        record = self.record("solve", "--scene", path, "-f", "geometrically_exact", *options)
        self.steps = len(record["motion"]) - 1
        return ({one["quantity"]: one["curve_value"] for one in record["curves"]},
                {one["quantity"]: one["value"] for one in record["quantities"]})

    def test_sudden_loads(self):
        """From 2 pm to 20 mm, and with another number of elements; of the largest motion, 2."""
        for how, limit in (("", 1e-3), ("integrator: alpha, ", 1.2e-3)):
            for force, n in ((1e-7, 1), (1e-3, 1), (1e-3, 4), (1, 1)):
                with self.subTest(how=how, force=force, n=n):
                    curves, values = self.curves(SUDDEN.format(how=how), "-n", n, "--set",
                                                 f"force={force}")
                    for got, right in zip(curves["u"], (1, 0, 1, 1), strict=True):
                        self.assertLess(abs(got - right), 2*limit)
                    self.assertLess(abs(values["largest"] - 2), 2e-3)

    def test_motions_by_chance(self):
        for seed in range(10):
            right, _ = self.curves(corner(seed, "integrator: radau, tolerance: 1e-6, "), "-n", 1)
            got, _ = self.curves(corner(seed, ""), "-n", 1)
            largest = max(abs(value) for curve in right.values() for value in curve)
            for name, curve in right.items():
                for one, other in zip(curve, got[name], strict=True):
                    with self.subTest(seed=seed, curve=name):
                        self.assertLess(abs(one - other), 1e-3*largest)

    def test_at_rest(self):
        """What is bent by a load that stays is at rest, whatever the integrator, in few steps: what
        its equilibrium is off by is no motion to be resolved."""
        for how in ("", "integrator: alpha, ", "integrator: conserving, "):
            for force in (0, 1, 1e-9):
                text = REST.format(how=how, force=force)
                with self.subTest(how=how, force=force):
                    curves, _ = self.curves(text, "-n", 2)
                    self.assertLess(abs(curves["u"][1] - curves["u"][0]), 1e-12)
                    self.assertLess(self.steps, 40)

    def test_conserving_by_driven_angles(self):
        """Of order 2, and the work done is the energy that there is."""
        right, _ = self.curves(ANGLES.replace("HOW", "integrator: radau, tolerance: 1e-7"), "-n", 2)
        errors = []
        for step in (4e-3, 2e-3):
            got, _ = self.curves(ANGLES.replace("HOW", f"integrator: conserving, step: {step}"),
                                 "-n", 2)
            errors.append(max(abs(a - b) for name in ("x", "y", "z", "work")
                              for a, b in zip(right[name], got[name], strict=True)))
        self.assertLess(errors[1], 3e-3)
        self.assertAlmostEqual(errors[0]/errors[1], 4, delta=0.6)


if __name__ == "__main__":
    unittest.main()
