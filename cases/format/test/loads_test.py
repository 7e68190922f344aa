"""Tests loads, functions of time and stability in scene files."""
import itertools
import math
import re
import unittest

from cases.format.test.scene_case import SceneCase, values
from harness.tools.kit.program import run
from harness.tools.kit.scenes import LEAF
from harness.tools.shown_commands import reader_file


SCENE = """beamwork: 1
UNITS
sections:
  s: {rectangle: {width: WIDTH, thickness: THICK}, young: YOUNG, shear_modulus: SHEAR, density: RHO}
nodes:
  root: {at: [0, 0, 0], hold: all}
  tip: {at: [LENGTH, 0, 0], mass: MASS}
members:
  bar: {from: root, to: tip, section: s, y: [0, 1, 0]}
loads:
LOADS
analyses:
  run: ANALYSIS
"""
SI = {"UNITS": "", "WIDTH": "0.05", "THICK": "0.02", "YOUNG": "2e11", "SHEAR": "8e10", "RHO": "7800", "LENGTH": "2", "MASS": "3"}
MM = {"UNITS": "units: mm, N, MPa", "WIDTH": "50", "THICK": "20", "YOUNG": "2e5", "SHEAR": "8e4", "RHO": "7.8e-9", "LENGTH": "2000",
      "MASS": "3e-3"}

KINDS = {
    "force": "force: [1, 2, 3], on: tip",
    "moment": "moment: [1, 2, 3], on: tip",
    "force within": "force: [1, 2, 3], on: bar, where: 0.25",
    "moment within": "moment: [1, 2, 3], on: bar, where: 0.25",
    "distributed": "distributed: [1, 2, 3], on: bar",
    "distributed moment": "distributed_moment: [1, 2, 3], on: bar",
    "gravity": "gravity: [1, 2, 3], on: bar",
    "weight": "gravity: [1, 2, 3], on: tip",
    "all": "gravity: [1, 2, 3], on: all"
}
FORCES, MOMENTS = ("force", "force within", "distributed"), ("moment", "moment within", "distributed moment")
ON_MEMBERS = ("force within", "moment within", "distributed", "distributed moment")
SPREAD = ("distributed", "distributed moment")
KEYS = {
    "where: 0.75": (),
    "from: 0.25": SPREAD,
    "to: 0.75": SPREAD,
    "to_value: [3, 2, 1]": SPREAD,
    "lumped: yes": (*SPREAD, "gravity", "all"),
    "at: [0, 0, 0.125]": FORCES,
    "axes: member": ON_MEMBERS,
    "follower: true": FORCES + MOMENTS,
    "path: [0, 1], factor: [0, 2]": tuple(KINDS)
}
NOTHING = ("from: 0, to: 1", "lumped: no", "at: [0, 0, 0]", "axes: fixed", "follower: no")
ANALYSES = {
    "linear": "{linear: {}}",
    "static": "{static: {stations: [1]}}",
    "continuation": "{continuation: {control: {node: tip, component: uy}, to: [0.1], step: 0.1}}",
    "buckling": "{buckling: {}}",
    "modal": "{modal: {}}",
    "compliance": "{compliance: {node: tip}}",
    "rotation": "{rotation: {omega: [0, 0, 1], stations: [1]}}"
}


def text_of(loads, analysis="{linear: {}}", words=SI):
    text = SCENE.replace("LOADS", "\n".join(f"  l{i}: {{{said}}}" for i, said in enumerate(loads)))
    text = text.replace("ANALYSIS", analysis)
    for key, word in words.items():
        text = text.replace(key, word)
    return text


class LoadsTest(SceneCase):

    def written(self, text):
        return self.answered("scene", "--scene", self.scene(text)).stdout

    def loads_of(self, text):
        return [line for line in self.written(text).partition("\nloads:\n")[2].splitlines() if line.startswith("  l")]

    def test_every_key(self):
        taken, refused = [], 0
        for (kind, said), (key, kinds) in itertools.product(KINDS.items(), KEYS.items()):
            where = key.startswith("where") and "within" in kind
            entry = said.replace("where: 0.25", key) if where else f"{said}, {key}"
            if where or kind in kinds:
                taken.append(entry)
                continue
            path = self.scene(text_of([entry]))
            done = run("scene", "--scene", path)
            self.assertEqual((done.returncode, done.stdout), (2, ""), entry)
            lines = done.stderr.splitlines()
            self.assertEqual(len(lines), 1, (entry, lines))
            self.assertTrue(lines[0].startswith(f"{path}:11:"), lines)
            self.assertRegex(lines[0], rf"\b{key.partition(':')[0]}\b", entry)
            self.assertIn("; ", lines[0])
            refused += 1
        self.assertGreater(len(taken), 30)
        self.assertGreater(refused, 30)
        once = self.written(text_of([entry for entry in taken if "on: all" not in entry]))
        self.assertEqual(self.written(once), once)
        for key in KEYS:
            self.assertIn(key, once)

    def test_analyses(self):
        several = [said for kind, said in KINDS.items() if kind != "all"]
        several += [f"{KINDS[kind]}, from: 0.25, to: 0.5, to_value: [4, 5, 6], follower: true" for kind in SPREAD]
        for analysis, said in ANALYSES.items():
            once = self.written(text_of(several, said))
            self.assertEqual(self.written(once), once, analysis)
        about = "{static: {stations: [1]}}\n  fall: {modal: {about: run}}"
        self.assertEqual(len(self.loads_of(text_of(several, about))), len(several))
        for kind in ("distributed moment", "moment within"):
            path = self.scene(text_of([KINDS[kind]], ANALYSES["buckling"]))
            done = run("solve", "--scene", path, "-f", "beamw", "-n", 2)
            self.assertEqual((done.returncode, done.stdout), (2, ""), kind)
            self.assertRegex(done.stderr, r"\bl0 \(moments? .*\) has no potential")

    def test_nothing(self):
        for kind, said in KINDS.items():
            for key in NOTHING:
                if kind not in SPREAD and key.startswith("from"):
                    continue
                if kind in ("gravity", "weight", "all") and key.startswith("at"):
                    continue
                self.assertEqual(self.loads_of(text_of([f"{said}, {key}"])), self.loads_of(text_of([said])), (kind, key))

    def test_plane(self):
        inside = ["force: [1, 2, 0], on: bar, where: 0.25", "moment: [0, 0, 3], on: bar, where: 0.25",
                  "distributed: [1, 2, 0], on: bar, to_value: [2, 1, 0]", "distributed_moment: [0, 0, 0], on: bar, to_value: [0, 0, 1]"]
        outside = ["force: [1, 2, 3], on: bar, where: 0.25", "moment: [1, 0, 3], on: bar, where: 0.25, axes: member",
                   "distributed: [1, 2, 0], on: bar, to_value: [2, 1, 1]", "distributed: [0, 0, 1], on: bar, to_value: [2, 1, 0]",
                   "distributed_moment: [0, 0, 0], on: bar, to_value: [0, 1, 1]"]
        self.assertEqual(len(self.loads_of(text_of(inside) + "plane: xy\n")), len(inside))
        for said in outside:
            path = self.scene(text_of([said]) + "plane: xy\n")
            done = run("scene", "--scene", path)
            self.assertEqual((done.returncode, done.stdout), (2, ""), said)
            self.assertRegex(done.stderr, r":11:3: l0: it(s moment is not about the normal| acts out) of the plane, .*; correct this, or remove plane: xy\n$")

    def test_units(self):
        def loads(millimetre):
            force, moment, line, moments, arm = (f"[{x}, {2*x}, {3*x}]" for x in (1, 0.5*millimetre, 2/millimetre, 0.25, 0.125*millimetre))
            more = [f"distributed: {line}, on: bar, from: 0.25, to: 0.5, at: {arm}, to_value: [0, {8/millimetre}, 0]",
                    f"distributed_moment: {moments}, on: bar, to: 0.5, to_value: [0, 4, 0], lumped: yes"]
            return [f"force: {force}, on: bar, where: 0.25, at: {arm}", f"moment: {moment}, on: bar, where: 0.25"] + more
        self.assertEqual(self.loads_of(text_of(loads(1000), words=MM)), self.loads_of(text_of(loads(1))))
        self.assertNotEqual(self.loads_of(text_of(loads(1000))), self.loads_of(text_of(loads(1))))


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
        k = self.stiffness()
        exact = PUSH * (1 - math.cos(math.sqrt(k / 0.1) * 0.5)) / k
        self.assertAlmostEqual(self.moved("")["u"] / exact, 1, delta=1e-4)
        doubled = self.moved("", SWING, "--set", "push=2e-4")["u"]
        self.assertAlmostEqual(doubled / exact, 2, delta=1e-3)

    def stiffness(self):
        text = BLOCK.replace(", TIME", "").replace(", at: 0.5", "")
        path = self.scene(text.replace("ANALYSES", "swing: {linear: {}}"))
        got = values(self.record("solve", "--scene", path, "-f", "collocation", "-n", 1))
        return PUSH / got["u"]

    def test_functions(self):
        ramp = self.moved("pieces: [{until: 0.2, is: 5*t}, {is: 1}]")["u"]
        self.assertAlmostEqual(self.moved("table: {at: [0, 0.2], value: [0, 1]}")["u"], ramp,
                               delta=1e-9 * abs(ramp))
        self.assertNotAlmostEqual(self.moved("time: 1")["u"] / ramp, 1, delta=1e-2)
        self.assertEqual(self.moved("time: 1")["u"], self.moved("")["u"])

    def test_release(self):
        walk = "walk: {static: {stations: [1]}}\n  "
        about = walk + SWING.replace("radau,", "radau, about: walk,")
        k = self.stiffness()
        swung = self.moved("time: 0*t", about)["u"]
        self.assertAlmostEqual(swung * k / PUSH, math.cos(math.sqrt(k / 0.1) * 0.5), delta=1e-4)
        held = self.moved("path: [0, 1], factor: [0, 0.5]", about)["u"]
        self.assertAlmostEqual(held * k / PUSH, 0.5, delta=1e-6)

    def test_usual_choices(self):
        path = self.scene(re.sub(r"(?s)quantities:.*?omit", "omit", BLOCK.replace(
            ", TIME", "").replace("ANALYSES", "swing: {motion: {stations: [0.5]}}")))
        written = self.answered("scene", "--scene", path).stdout
        self.assertIn("integrator: radau, step: 0.0005, tolerance: 1e-05", written)
        record = self.record("solve", "--scene", path, "-f", "collocation", "-n", 1)
        self.assertEqual(set(values(record)), {"block_ux", "energy"})

    def test_chosen_integrators(self):
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
        self.refused(2, "supports only lumped mass", "solve", "--scene", path, "-n", 2, "-f",
                     "geometrically_exact")

    def test_mass_of_what_goes_on(self):
        go = "{a: {motion: {stations: [0.01], MASSstep: 1e-4}}, "
        go += "b: {motion: {stations: [0.02], about: a, integrator: conserving, step: 1e-4}}}"
        text = reader_file("howto/dynamics.md", "swing.yaml")
        head = text.partition("analyses:")[0]
        asked = "quantities:\n  u: {displacement: {analysis: b, node: tip, component: uy}}\n"
        for mass, code in (("mass: consistent, ", 2), ("", 0), ("mass: lumped, ", 0)):
            path = self.scene(f"{head}analyses: {go.replace('MASS', mass)}\n{asked}", "on.yaml")
            done = run("solve", "--scene", path, "-f", "beamw", "-n", 1)
            self.assertEqual(done.returncode, code, done.stderr + done.stdout)
            self.assertEqual("only lumped mass" in done.stdout + done.stderr, code == 2)

    def test_forms_of_newton(self):
        path = self.block("time: sin(20*t)")
        where = ("solve", "--scene", path, "-n", 1, "-f")
        mixed, alone = (values(self.record(*where, f"collocation:newton={how}"))["u"]
                        for how in ("mixed", "displacement"))
        self.assertAlmostEqual(alone / mixed, 1, delta=1e-6)
        self.refused(2, "give newton=mixed", *where, "collocation:newton=dense")
        kept = self.block("time: sin(20*t)", SWING.replace("radau", "conserving"))
        self.refused(2, "requires that strains are unknowns", "solve", "--scene", kept, "-n", 1, "-f",
                     "collocation:newton=displacement")

    def test_other_verbs(self):
        path = self.block("time: sin(20*t)")
        self.answered("sweep", "--scene", path, "--vary", "step=1e-3..4e-3/2:log", "-f",
                      "collocation", "-n", 1, "-o", self.folder / "steps.h5")
        leaf = LEAF.replace("81e9", "81e9, density: 7800")
        leaf = leaf.replace("y: [0, 1, 0]}", "y: [0, 1, 0], warping: fixed}")
        moving = self.scene(leaf + "analyses: {swing: {motion: {stations: [1e-3]}}}\n", "leaf.yaml")
        self.refused(2, "not motion; remove the analysis", "export", "--scene", moving, "--to", "calculix",
                     "-n", 2, "-o", self.folder / "deck.inp")
        own = self.record("solve", "--scene", path, "-f", "beamw", "-n", 2)
        again = self.scene(self.answered("scene", "--scene", path).stdout, "again.yaml")
        self.assertEqual(values(own),
                         values(self.record("solve", "--scene", again, "-f", "beamw", "-n", 2)))
        timed = self.answered("bench", "--scene", path, "-f", "beamw", "-n", 1).stdout
        self.assertIn("times of motions are not divided", timed)
        listed = self.answered("list", "--scene", path).stdout
        self.assertIn("0.5 s after the start of the motion", re.sub(r"\s+", " ", listed))

    def test_loads_that_jump(self):
        follows = ("bent: {static: {stations: [1]}}\n"
                   "  swing: {motion: {stations: [0.25, 0.5], step: step, about: bent}}")
        for time, told in (("time: 0", True), ("time: 1 - t", False),
                           ("path: [0, 1], factor: [0, 0], time: 100*t", False)):
            path = self.block(time, follows)
            text = self.answered("solve", "--scene", path, "-f", "beamw", "-n", 1).stdout
            self.assertEqual("the factor of push is 1 at the end of the path, but 0" in re.sub(r"\s+", " ", text),
                             told, text)

    def test_what_ends_too_early(self):
        path = self.block("time: exp(1000*t)")
        done = self.answered("solve", "--scene", path, "-f", "beamw", "-n", 1, code=1)
        self.assertIn("the motion stopped before 0.5 s; give a smaller step", re.sub(r"\s+", " ", done.stdout))
        done = self.answered("solve", "--scene", self.block("time: 1"), "-f", "beamw", "-n", 1)
        self.assertNotIn("the motion stopped before", re.sub(r"\s+", " ", done.stdout))

    def test_time_is_t(self):
        self.refused(2, "did you mean 't'?", "solve", "--scene", self.block("time: 2*time"))

    def test_curves_are_over_time(self):
        path = self.block("time: 1")
        for x, wanted in (("", ("time", "s")), (", x: {factor: 1000}", ("time", "1")),
                          (", x: {name: a, unit: s}", ("a", "s"))):
            path.write_text(path.read_text("utf-8").partition("  u:")[0] +
                            "  u: {displacement: {analysis: swing, node: block, component: ux, "
                            f"take: curve}}{x}}}\nomit: [trapeze, wagner_moments, wagner_torque, rotary_inertia]\n", "utf-8")
            curve, = self.record("solve", "--scene", path, "-f", "beamw", "-n", 1)["curves"]
            self.assertEqual((curve["x_name"], curve["x_unit"]), wanted)

    def test_one_reason_once(self):
        path = self.block("time: 1")
        late = "{rate: {analysis: swing, node: block, component: ux, at: 0.9}}"
        path.write_text(path.read_text("utf-8").replace(
            "omit:", f"  v: {late}\n  w: {late}\nomit:"), "utf-8")
        text = self.answered("solve", "--scene", path, "-f", "beamw", "-n", 1, code=1).stdout
        self.assertRegex(text, r"v +- the path does not reach this station; request an\n +earlier one\nw +- likewise\n")


# Critical load of a column in a plane, clamped at the bottom and free at the top. The column buckles at the path
# parameter 1.
EULER = math.pi**2/4*210e9*50e-3*5e-3**3/12
COLUMN = f"""beamwork: 1
sections: {{strip: {{rectangle: {{width: 50e-3, thickness: 5e-3}}, young: 210e9, shear_modulus: 81e9, density: 7800}}}}
nodes:
  foot: {{at: [0, 0, 0], hold: all}}
  head: {{at: [1, 0, 0]}}
members: {{post: {{from: foot, to: head, section: strip, y: [0, 1, 0], warping: fixed}}}}
loads: {{push: {{force: [-{EULER!r}, 0, 0], on: head}}}}
analyses:
  press: {{static: {{stations: [0.5, 0.95, 1.05, 1.5]}}}}
  again: {{static: {{stations: [0.5, 0.9]}}}}
quantities:
  short: {{displacement: {{analysis: press, node: head, component: ux, take: curve}}}}
  shorter: {{displacement: {{analysis: again, node: head, component: ux}}}}
"""
SHAFT = COLUMN.replace("static: {stations: [0.5, 0.95, 1.05, 1.5]}",
                       "static: {stations: [1], spin: {omega: [200, 0, 0]}}").replace(f"-{EULER!r}", "-1e-6")


class StabilityTest(SceneCase):

    def steps(self, text, analysis, formulation):
        record = self.record("solve", "--scene", self.scene(text), "-f", formulation, "-n", 4)
        return {s["path"]: s["stability"].split(" (")[0] for s in record["steps"] if s["analysis_name"] == analysis}

    def test_column(self):
        for formulation in ("collocation", "beamw", "geometrically_exact", "sheet_third"):
            found = self.steps(COLUMN, "press", formulation)
            self.assertEqual({p: found[p] for p in (0.5, 0.95, 1.05, 1.5)},
                             {0.5: "stable", 0.95: "stable", 1.05: "unstable", 1.5: "unstable"}, formulation)
            self.assertEqual(set(self.steps(COLUMN, "again", formulation).values()), {"stable"})

    def test_words(self):
        text = self.answered("solve", "--scene", self.scene(COLUMN), "-f", "collocation", "-n", 4).stdout
        self.assertIn("analysis press: stable up to 0.95, unstable from 1.05 (path)", text)
        self.assertNotIn("analysis again:", text)
        rows = [line.split() for line in text.splitlines()]
        self.assertEqual([r[2] for r in rows if len(r) == 3 and r[0] in ("0.5", "0.95", "1.05", "1.5")],
                         ["yes", "yes", "no", "no"])

    def test_meshes(self):
        text = self.answered("converge", "--scene", self.scene(COLUMN), "-f", "collocation", "-f", "beamw").stdout
        self.assertIn("collocation had unstable states:\n  n = 1: stable up to 0.95", text)
        line = self.answered("solve", "--scene", self.scene(COLUMN), "-f", "collocation").stdout
        self.assertIn("-n 8", line)

    def test_turning(self):
        found = self.steps(SHAFT, "press", "collocation")
        self.assertEqual(found[1], "undecided")
        done = run("solve", "--scene", self.scene(SHAFT), "-f", "collocation", "-n", 4)
        self.assertNotIn("unstable", done.stdout)


if __name__ == "__main__":
    unittest.main()
