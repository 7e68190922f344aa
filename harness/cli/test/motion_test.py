"""Transient analyses: external formulations, the time-integration error, masses, and continued runs."""
import csv
import io
import math
import random
import re
import sys
import unittest

from cases.format.test.scene_case import SceneCase, values
from harness.cli.test.plugin import EXAMPLES, PluginTest, compile_shared
from harness.tools.kit.program import ROOT, ProgramTest, TRUTHS


PROCESS = f"exec:'{sys.executable}' '{EXAMPLES / 'timoshenko.py'}'"

ARM = """beamwork: 1
sections:
  tube: {tube: {diameter: 20e-3, thickness: 1e-3}, young: 70e9, shear_modulus: 26e9, density: 2700}
nodes:
  hub: {at: [0, 0, 0], hold: [ux, uy, uz, rx, ry], drive: {rz: turn}}
  tip: {at: [1, 0, 0], mass: 0.3}
members:
  arm: {from: hub, to: tip, section: tube, y: [0, 1, 0]}
motions:
  turn: {unit: rad, pieces: [{is: 30*deg*(2*t - sin(4*pi*t)/(2*pi))}]}
analyses:
  swing: {motion: {stations: [0.1], integrator: conserving, step: 0.01}}
quantities:
  behind: {relative: {analysis: swing, node: tip, from: hub, component: uy}}
  energy: {energy: {analysis: swing, of: energy}}
omit: [shear, trapeze, wagner_moments, wagner_torque]
"""


class OwnMotion(PluginTest):

    def flight(self, integrator, name, *element):
        return self.record("solve", "free_flight_space", "--set", f"integrator={integrator}", "-f",
                           name, "-n", 4, *element)

    def compare(self, name, element, integrators=("alpha", "conserving", "radau")):
        for integrator in integrators:
            ours = self.flight(integrator, "collocation")
            own = self.flight(integrator, name, "--element", element)
            for one, same in zip(own["quantities"], ours["quantities"], strict=True):
                if one["unit"] == "m":
                    with self.subTest(integrator=integrator, quantity=one["quantity"]):
                        self.assertAlmostEqual(one["value"], same["value"], delta=0.02)
            if integrator == "conserving":
                energy = max(step["kinetic"] for step in own["motion"])
                self.assertLess(max(abs(step["drift"]) for step in own["motion"]), 1e-12 * energy)

    def test_by_strains(self):
        self.compare("timoshenko", compile_shared(EXAMPLES / "timoshenko.c", self.folder / "t.so"))

    def test_by_forces(self):
        self.compare("corotational", compile_shared(EXAMPLES / "corotational.c",
                                                    self.folder / "c.so"))

    def test_by_an_energy_alone(self):
        made = compile_shared(EXAMPLES / "ancf.c", self.folder / "a.so")
        path = self.folder / "arm.yaml"
        path.write_text(ARM, encoding="utf-8")
        own, ours = (self.record("solve", "--scene", path, "-f", *words, "-n", 2)
                     for words in (("ancf", "--element", made), ("collocation",)))
        for one, same in zip(own["quantities"], ours["quantities"], strict=True):
            self.assertAlmostEqual(one["value"] / same["value"], 1, delta=0.02)
        self.assertLess(max(abs(step["drift"]) for step in own["motion"]), 1e-14)

    def test_in_another_process(self):
        self.compare("timoshenko_py", PROCESS, ("conserving",))


# A mass on a leaf spring under a suddenly applied force: u/u_static = 1 - cos(omega t).
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
        path = self.folder / "scene.yaml"
        path.write_text(text, encoding="utf-8")
        record = self.record("solve", "--scene", path, "-f", "geometrically_exact", *options)
        self.steps = len(record["motion"]) - 1
        return ({one["quantity"]: one["curve_value"] for one in record["curves"]},
                {one["quantity"]: one["value"] for one in record["quantities"]})

    def test_sudden_loads(self):
        """u/u_static must be 1 - cos(omega t) for u_static from 1.7 pm to 17 mm. Errors are relative to 2, the
        largest value of u/u_static."""
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

    def test_unsupported_integrator(self):
        """Integrators given by --integrator must reject the same input as in a scene."""
        text = self.answered("motion", "--scene", ROOT / "cases" / "examples" / "servo.yaml", "-f", "collocation", "-n",
                             "1", "--integrator", "conserving", "--step", "0.01", code=1).stdout
        self.assertIn("(conserving): load motor has feedback, which supplies energy", " ".join(text.split()))
        self.assertRegex(text, r"(?m)^  conserving +0.01 +- +- ")

    def test_at_rest(self):
        for how in ("", "integrator: alpha, ", "integrator: conserving, "):
            for force in (0, 1, 1e-9):
                text = REST.format(how=how, force=force)
                with self.subTest(how=how, force=force):
                    curves, _ = self.curves(text, "-n", 2)
                    self.assertLess(abs(curves["u"][1] - curves["u"][0]), 1e-12)
                    self.assertLess(self.steps, 40)

    def test_conserving_by_driven_angles(self):
        right, _ = self.curves(ANGLES.replace("HOW", "integrator: radau, tolerance: 1e-7"), "-n", 2)
        errors = []
        for step in (4e-3, 2e-3):
            got, _ = self.curves(ANGLES.replace("HOW", f"integrator: conserving, step: {step}"),
                                 "-n", 2)
            errors.append(max(abs(a - b) for name in ("x", "y", "z", "work")
                              for a, b in zip(right[name], got[name], strict=True)))
        self.assertLess(errors[1], 3e-3)
        self.assertAlmostEqual(errors[0]/errors[1], 4, delta=0.6)


ASKED = {"coupled_beam": ("asked=frequencies",), "sheet_cantilever": ("modes=3",),
         "tapered_cantilever": ("section=wedge", "asked=waves")}
MASSLESS = {"angle_column", "bend_45", "c_cantilever", "carried_rod", "cross_flexure", "elastica", "geradin_cardona",
            "hexapod", "lateral_buckling", "lee_frame", "loaded_cantilever", "moment_buckling", "rigid_body",
            "right_angle_frame", "roll_up", "shear_column", "shear_elastica", "sheet_wagner", "snap_through",
            "spherical_joint", "wagner_torsion", "warping_torsion", "weighted_column"}
WHERE = ("-f", "collocation", "-n", 2)
LUMPED = ("--set", "mass=lumped")


def with_key(scene):
    return re.sub(r"(?m)^analyses:", "mass: lumped\nanalyses:", scene)


class MassTest(SceneCase):

    def massive(self):
        names = [c["case"] for c in self.record("list")["cases"]]
        having = [n for n in names if "mass" in {p["name"] for p in self.record("list", n)["parameters"]}]
        self.assertEqual(set(names) - set(having), MASSLESS)
        return [(n, tuple(w for one in ASKED.get(n, ()) for w in ("--set", one))) for n in having]

    def lumped_differs(self, case, point):
        usual, lumped = (self.record("solve", case, *WHERE, *point, *mass) for mass in ((), LUMPED))
        self.assertEqual(usual["parameters"]["mass"], "usual")
        self.assertEqual(lumped["parameters"]["mass"], "lumped")
        self.assertRegex(lumped["cell"]["lumped"], "^mass ", case)
        self.assertNotIn("mass", usual["cell"]["lumped"], case)
        mine, former = values(lumped), values(usual)
        self.assertTrue([q for q in mine if mine[q] != former[q]], case)
        return mine, former

    def test_every_case_that_has_mass(self):
        for case, point in self.massive():
            mine, former = self.lumped_differs(case, point)
            text = self.answered("scene", case, *point).stdout
            self.assertNotRegex(text, r"(?m)\bmass: (lumped|consistent)", case)
            if case in ("leaf_guide", "deep_beam", "tip_body", "spin_up"):
                as_scene = self.record("solve", "--scene", self.scene(with_key(text)), *WHERE)
                self.assertEqual(values(as_scene), mine, case)
                as_written = self.record("solve", "--scene", self.scene(text), *WHERE)
                self.assertEqual(values(as_written), former, case)
                self.assertIn("\nmass: lumped\n", self.answered("scene", case, *point, *LUMPED).stdout)

    def test_reference_values_hold(self):
        found = self.record("solve", "deep_beam", "-f", "collocation", "-n", 64, *LUMPED)
        errors = [q["error"] for q in found["quantities"] if q["quantity"].startswith("frequency")]
        self.assertTrue(errors and all(e is not None and 1e-6 < abs(e) < 1e-3 for e in errors), errors)
        point = ("--set", "omega_star=2.5")
        said = [self.answered("truth", "tip_body", *point, *mass).stdout.split("\n", 1) for mass in ((), LUMPED)]
        self.assertEqual(said[0][1], said[1][1])
        self.assertIn("mass=lumped", said[1][0])

    def test_consistent_is_required(self):
        spin = ("spin_up", *WHERE, "--set", "time=0.5")
        usual = values(self.record("solve", *spin))
        self.assertEqual(values(self.record("solve", *spin, "--set", "mass=consistent")), usual)
        self.refused(2, "supports only lumped mass", "solve", *spin, "--set", "mass=consistent", "--set",
                     "integrator=conserving")

    def test_names(self):
        self.refused(2, "elastica has no parameter 'mass'", "solve", "elastica", *LUMPED)
        self.refused(2, "give one of usual|lumped|consistent", "solve", "tip_body", "--set", "mass=2")
        text = self.answered("solve", "deep_beam", *WHERE, *LUMPED).stdout
        self.assertIn("deep_beam (mass=lumped), collocation", text)
        self.assertIn("lumped: mass of analysis modal", text)

    def test_sweep(self):
        done = self.answered("sweep", "deep_beam", "--vary", "mass=usual,lumped", *WHERE, "-k", "frequency_1",
                             "--format", "csv")
        found = {row["mass"]: abs(float(row["error"])) for row in csv.DictReader(io.StringIO(done.stdout))}
        self.assertLess(10 * found["usual"], found["lumped"])


if __name__ == "__main__":
    unittest.main()
