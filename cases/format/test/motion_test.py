"""Motions in time from scene files, as one who writes them meets them in every verb."""
import math
import re
import unittest

from cases.format.test.scene_case import SceneCase, values
from docs.commands import reader_file
from harness.tools.kit.program import run
from harness.tools.kit.scenes import LEAF

# A block on a spring and a light wire, pushed by little.
BLOCK = """\
beamwork: 1
parameters:
  step: {value: 5e-3, unit: s}
  push: {value: 1e-4, unit: N}
sections:
  wire: {tube: {diameter: 1e-3, thickness: 5e-4}, young: 1e6, shear_modulus: 4e5, density: 1}
nodes:
  base:  {at: [0, 1e-3, 0], hold: all}
  block: {at: [0, 0, 0], mass: 0.1, hold: [uy, uz, rx, ry, rz]}
members:
  wire: {from: base, to: block, section: wire, y: [1, 0, 0]}
springs:
  coil: {to: block, stiffness: [10, 0, 0, 0, 0, 0]}
loads:
  push: {force: [push, 0, 0], on: block, TIME}
analyses:
  ANALYSES
quantities:
  u: {displacement: {analysis: swing, node: block, component: ux, at: 0.5}}
omit: [trapeze, wagner_moments, wagner_torque, rotary_inertia]
"""
SWING = "swing: {motion: {stations: [0.25, 0.5], integrator: radau, step: step}}"
PUSH = 1e-4


class MotionTest(SceneCase):
    def block(self, time, analyses=SWING):
        text = BLOCK.replace(", TIME", f", {time}" if time else "")
        return self.scene(text.replace("ANALYSES", analyses))

    def moved(self, time, analyses=SWING, *more):
        path = self.block(time, analyses)
        return values(self.record("solve", "--scene", path, "-f", "collocation", "-n", 1, *more))

    def test_constant_push(self):
        """Without a function the load is whole from the begin: u = F/k (1 - cos w t)."""
        k = self.stiffness()
        exact = PUSH * (1 - math.cos(math.sqrt(k / 0.1) * 0.5)) / k
        self.assertAlmostEqual(self.moved("")["u"] / exact, 1, delta=1e-4)
        doubled = self.moved("", SWING, "--set", "push=2e-4")["u"]
        self.assertAlmostEqual(doubled / exact, 2, delta=1e-3)

    def stiffness(self):
        """Of spring and wire [N/m], by a push at rest."""
        text = BLOCK.replace(", TIME", "").replace(", at: 0.5", "")
        path = self.scene(text.replace("ANALYSES", "swing: {linear: {}}"))
        got = values(self.record("solve", "--scene", path, "-f", "collocation", "-n", 1))
        return PUSH / got["u"]

    def test_functions(self):
        """Expression, pieces and table of one function of time move alike."""
        ramp = self.moved("pieces: [{until: 0.2, is: 5*t}, {is: 1}]")["u"]
        self.assertAlmostEqual(self.moved("table: {at: [0, 0.2], value: [0, 1]}")["u"], ramp,
                               delta=1e-9 * abs(ramp))
        self.assertNotAlmostEqual(self.moved("time: 1")["u"] / ramp, 1, delta=1e-2)
        self.assertEqual(self.moved("time: 1")["u"], self.moved("")["u"])

    def test_release(self):
        """Released from the end of a static path: the load is gone, and it swings back."""
        walk = "walk: {static: {stations: [1]}}\n  "
        about = walk + SWING.replace("radau,", "radau, about: walk,")
        k = self.stiffness()
        swung = self.moved("time: 0*t", about)["u"]
        self.assertAlmostEqual(swung * k / PUSH, math.cos(math.sqrt(k / 0.1) * 0.5), delta=1e-4)
        held = self.moved("path: [0, 1], factor: [0, 0.5]", about)["u"]
        self.assertAlmostEqual(held * k / PUSH, 0.5, delta=1e-6)

    def test_usual_choices(self):
        """Neither step nor tolerance: they adapt; no quantities: places and energy."""
        path = self.scene(re.sub(r"(?s)quantities:.*?omit", "omit", BLOCK.replace(
            ", TIME", "").replace("ANALYSES", "swing: {motion: {stations: [0.5]}}")))
        written = self.answered("scene", "--scene", path).stdout
        self.assertIn("integrator: radau, step: 0.0005, tolerance: 1e-05", written)
        record = self.record("solve", "--scene", path, "-f", "collocation", "-n", 1)
        self.assertEqual(set(values(record)), {"block_ux", "energy"})

    def test_chosen_integrators(self):
        """rho stays where the integrator is the choice of a parameter; all agree on the motion."""
        swing = SWING.replace("radau, step: step", "how, step: 1e-3, rho: 0.8")
        text = BLOCK.replace(", TIME", ", time: sin(20*t)").replace("ANALYSES", swing)
        path = self.scene(text.replace(
            "  step:", "  how: {value: alpha, choices: [alpha, conserving, radau]}\n  step:"))
        got = [values(self.record("solve", "--scene", path, "-f", "beamw", "-n", 1, "--set",
                                  f"how={how}"))["u"] for how in ("alpha", "conserving", "radau")]
        self.assertAlmostEqual(got[0] / got[2], 1, delta=1e-2)
        self.assertAlmostEqual(got[1] / got[2], 1, delta=1e-2)
        self.assertNotEqual(got[0], got[1])

    def test_mass(self):
        """Mass along members is usual, also when it is asked for; at the nodes it is farther from fine
        meshes. Of three nodes, and with integrators that do not have it, it is refused by name."""
        text = reader_file("howto/dynamics.md", "swing.yaml")
        lumped = self.scene(text.replace("0..1/100", "0..1/100, mass: lumped"), "lumped.yaml")
        usual = self.scene(text, "usual.yaml")
        path = self.scene(text.replace("0..1/100", "0..1/100, mass: consistent"), "consistent.yaml")
        self.assertIn(", mass: consistent", self.answered("scene", "--scene", path).stdout)
        self.assertIn(", mass: lumped", self.answered("scene", "--scene", lumped).stdout)
        self.assertNotIn("mass: ", self.answered("scene", "--scene", usual).stdout.partition(
            "analyses:")[2])
        behind = [values(self.record("solve", "--scene", what, "-f", "beamw", "-n", n))["behind"]
                  for what, n in ((lumped, 2), (path, 2), (path, 4), (usual, 2))]
        self.assertEqual(behind[1], behind[3])
        self.assertAlmostEqual(behind[0] / behind[2], 0.9975, delta=1e-4)
        self.assertAlmostEqual(behind[1] / behind[2], 1, delta=3e-5)
        for name in ("collocation", "sheet_third", "geometrically_exact:nodes=2"):
            value = values(self.record("solve", "--scene", path, "-f", name, "-n", 2))["behind"]
            self.assertAlmostEqual(value / behind[2], 1, delta=1e-3, msg=name)
        self.refused(2, "lumped at its nodes", "solve", "--scene", path, "-n", 2, "-f",
                     "geometrically_exact")

    def test_mass_of_what_goes_on(self):
        """An integrator that has lumped mass only goes on from no motion with another one."""
        go = "{a: {motion: {stations: [0.01], MASSstep: 1e-4}}, "
        go += "b: {motion: {stations: [0.02], about: a, integrator: conserving, step: 1e-4}}}"
        text = reader_file("howto/dynamics.md", "swing.yaml")
        head = text.partition("analyses:")[0]
        asked = "quantities:\n  u: {displacement: {analysis: b, node: tip, component: uy}}\n"
        for mass, code in (("mass: consistent, ", 2), ("", 0), ("mass: lumped, ", 0)):
            path = self.scene(f"{head}analyses: {go.replace('MASS', mass)}\n{asked}", "on.yaml")
            done = run("solve", "--scene", path, "-f", "beamw", "-n", 1)
            self.assertEqual(done.returncode, code, done.stderr + done.stdout)
            self.assertEqual("lumped mass only" in done.stdout + done.stderr, code == 2)

    def test_forms_of_newton(self):
        """Displacements alone move alike; what an integrator does not have is refused."""
        path = self.block("time: sin(20*t)")
        where = ("solve", "--scene", path, "-n", 1, "-f")
        mixed, alone = (values(self.record(*where, f"collocation:newton={how}"))["u"]
                        for how in ("mixed", "displacement"))
        self.assertAlmostEqual(alone / mixed, 1, delta=1e-6)
        self.refused(2, "give newton=mixed", *where, "collocation:newton=dense")
        kept = self.block("time: sin(20*t)", SWING.replace("radau", "conserving"))
        self.refused(2, "needs strains as unknowns", "solve", "--scene", kept, "-n", 1, "-f",
                     "collocation:newton=displacement")

    def test_other_verbs(self):
        """Steps are swept; a deck refuses a motion; written again it has the same bits."""
        path = self.block("time: sin(20*t)")
        self.answered("sweep", "--scene", path, "--vary", "step=1e-3..4e-3/2:log", "-f",
                      "collocation", "-n", 1, "-o", self.folder / "steps.h5")
        leaf = LEAF.replace("81e9", "81e9, density: 7800")
        leaf = leaf.replace("y: [0, 1, 0]}", "y: [0, 1, 0], warping: fixed}")
        moving = self.scene(leaf + "analyses: {swing: {motion: {stations: [1e-3]}}}\n", "leaf.yaml")
        self.refused(2, "motion not; leave it", "export", "--scene", moving, "--to", "calculix",
                     "-n", 2, "-o", self.folder / "deck.inp")
        own = self.record("solve", "--scene", path, "-f", "beamw", "-n", 2)
        again = self.scene(self.answered("scene", "--scene", path).stdout, "again.yaml")
        self.assertEqual(values(own),
                         values(self.record("solve", "--scene", again, "-f", "beamw", "-n", 2)))
        timed = self.answered("bench", "--scene", path, "-f", "beamw", "-n", 1).stdout
        self.assertIn("steps of motions are not divided", timed)
        listed = self.answered("list", "--scene", path).stdout
        self.assertIn("0.5 s after the start of the motion", re.sub(r"\s+", " ", listed))

    def test_loads_that_jump(self):
        """Where the path holds what the motion has not: told, unless both agree."""
        follows = ("bent: {static: {stations: [1]}}\n"
                   "  swing: {motion: {stations: [0.25, 0.5], step: step, about: bent}}")
        for time, told in (("time: 0", True), ("time: 1 - t", False),
                           ("path: [0, 1], factor: [0, 0], time: 100*t", False)):
            path = self.block(time, follows)
            text = self.answered("solve", "--scene", path, "-f", "beamw", "-n", 1).stdout
            self.assertEqual("at factor 1 where the path ends, at 0" in re.sub(r"\s+", " ", text),
                             told, text)

    def test_what_ends_too_early(self):
        """A push that grows beyond all: the motion stops, and what may help stands there."""
        path = self.block("time: exp(1000*t)")
        done = self.answered("solve", "--scene", path, "-f", "beamw", "-n", 1, code=1)
        self.assertIn("it ends before 0.5 s: give a smaller step", re.sub(r"\s+", " ", done.stdout))
        done = self.answered("solve", "--scene", self.block("time: 1"), "-f", "beamw", "-n", 1)
        self.assertNotIn("it ends before", re.sub(r"\s+", " ", done.stdout))

    def test_time_is_t(self):
        self.refused(2, "did you mean 't'?", "solve", "--scene", self.block("time: 2*time"))

    def test_curves_are_over_time(self):
        """Without words of the file; those of the file stay."""
        path = self.block("time: 1")
        for x, wanted in (("", ("time", "s")), (", x: {factor: 1000}", ("time", "1")),
                          (", x: {name: a, unit: s}", ("a", "s"))):
            path.write_text(path.read_text("utf-8").partition("  u:")[0] +
                            "  u: {displacement: {analysis: swing, node: block, component: ux, "
                            f"take: curve}}{x}}}\nomit: [trapeze, wagner_moments, wagner_torque, rotary_inertia]\n", "utf-8")
            curve, = self.record("solve", "--scene", path, "-f", "beamw", "-n", 1)["curves"]
            self.assertEqual((curve["x_name"], curve["x_unit"]), wanted)

    def test_one_reason_once(self):
        """Quantities that have no value for the reason of the one before."""
        path = self.block("time: 1")
        late = "{rate: {analysis: swing, node: block, component: ux, at: 0.9}}"
        path.write_text(path.read_text("utf-8").replace(
            "omit:", f"  v: {late}\n  w: {late}\nomit:"), "utf-8")
        text = self.answered("solve", "--scene", path, "-f", "beamw", "-n", 1, code=1).stdout
        self.assertRegex(text, r"v +- the path does not reach this station\nw +- likewise\n")


if __name__ == "__main__":
    unittest.main()
