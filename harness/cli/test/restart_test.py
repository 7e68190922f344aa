"""Motions in several runs (--save-state, --restart)."""
import csv
import unittest

from cases.format.test.scene_case import SceneCase
from harness.tools.kit.program import TRUTHS


SWING = """\
beamwork: 1
parameters:
  end:  {value: 2, unit: s}
  how:  {value: alpha, choices: [alpha, conserving, radau, explicit]}
  step: {value: 0.015625, unit: s}
  tol:  {value: 0, unit: 1}
  damp: {value: 0, unit: s}
  mass: {value: 0.3, unit: kg}
sections:
  tube: {tube: {diameter: 20e-3, thickness: 1e-3}, young: 70e6, shear_modulus: 26e6, density: 2700}
nodes:
  hub: {at: [0, 0, 0], hold: [ux, uy, uz, rx, ry], drive: {rz: turn}}
  tip: {at: [1, 0, 0], mass: mass, centre: [0, 0.01, 0.02], inertia: [1e-3, 1e-3, 1e-3, 0, 0, 0]}
members:
  arm: {from: hub, to: tip, section: tube, y: [0, 1, 0], damping: damp}
motions:
  turn: {unit: rad, pieces: [{until: 0.5, is: 30*deg*(2*t - sin(4*pi*t)/(2*pi))}, {is: 30*deg}]}
loads:
  weight: {gravity: [0, 0, -0.1], on: all}
  push: {force: [0, 0.01, 0], on: tip, pieces: [{until: 1, is: 0}, {is: 1}]}
analyses:
  hang: {static: {stations: [1]}}
  swing: {motion: {stations: [end/4, end], integrator: how, step: step, tolerance: tol, about: hang}}
quantities:
  x: {displacement: {analysis: swing, node: tip, component: ux}}
  z: {displacement: {analysis: swing, node: tip, component: uz}}
  spin: {rate: {analysis: swing, node: tip, component: ry}}
  energy: {energy: {analysis: swing, of: energy}}
  work: {energy: {analysis: swing, of: work}}
  drift: {energy: {analysis: swing, of: drift}, offset: 1}
  torque: {reaction: {analysis: swing, node: hub, component: rz}}
omit: [trapeze, wagner_moments, wagner_torque]
"""
TAKES = ("mean", "rms", "max", "min", "max_time", "min_time", "crossing", "period", "per_second", "spectrum", "psd")
KINDS = {"v": "rate: {analysis: swing, node: tip, component: uz",
         "a": "rate: {analysis: swing, node: tip, component: uz, of: acceleration",
         "N": "internal: {analysis: swing, member: arm, end: from, resultant: Qz",
         "k": "energy: {analysis: swing, of: kinetic"}


def windows(when, **more):
    lines = [f"  {kind}_{take}: {{{words}, take: {take}}}, {when}}}" for kind, words in KINDS.items() for take in TAKES]
    lines += [f"  {name}: {{displacement: {{analysis: swing, node: tip, component: ux, {words}}}}}"
              for name, words in more.items()]
    return (SWING.replace("parameters:", "parameters:\n  from: {value: 0, unit: s}\n  until: {value: 1.5, unit: s}")
            .replace("[end/4, end]", "0..end/(8*end)").replace("quantities:", "\n".join(["quantities:", *lines])))


MESH = ("-f", "geometrically_exact", "-n", 2)


class RestartTest(SceneCase):

    def rows(self, path, *options):
        done = self.answered("solve", "--scene", path, "--format", "csv", *options)
        rows = csv.DictReader(line for line in done.stdout.splitlines() if not line.startswith("#"))
        return {row["quantity"]: row for row in rows}

    def values(self, path, *options):
        return {name: row["value"] for name, row in self.rows(path, *options).items()}

    def in_two(self, stop=1, **changes):
        path, sets = self.scene(SWING), [f"--set={k}={v}" for k, v in changes.items()]
        ends = self.folder / "ends.h5"
        one = self.values(path, *MESH, *sets)
        self.values(path, *MESH, *sets, "--set", f"end={stop}", "--save-state", ends)
        return one, self.values(path, *sets, "--restart", ends)

    def test_the_same_bits(self):
        for changes in ({"how": "alpha"}, {"how": "alpha", "damp": 1e-3}, {"how": "alpha", "stop": 0.75},
                        {"how": "conserving"}, {"how": "conserving", "damp": 1e-3},
                        {"how": "explicit", "step": 2**-13}):
            with self.subTest(**changes):
                one, two = self.in_two(**changes)
                self.assertEqual(one, two)
                self.assertGreater(abs(float(one["z"])), 1e-3)

    def test_to_round_off(self):
        for changes, most in (({"how": "radau"}, 1e-9), ({"how": "radau", "damp": 1e-3}, 1e-9),
                              ({"how": "radau", "tol": 1e-8}, 1e-4), ({"how": "alpha", "step": 0.01}, 1e-9)):
            with self.subTest(**changes):
                one, two = self.in_two(**changes)
                for name, value in one.items():
                    self.assertAlmostEqual(float(two[name]), float(value), delta=most * max(1, abs(float(value))))

    def test_one_after_the_other(self):
        path, ends = self.scene(SWING), [self.folder / f"{i}.h5" for i in range(3)]
        self.values(path, *MESH, "--set", "end=0.5", "--save-state", ends[0])
        self.values(path, "--set", "end=1", "--restart", ends[0], "--save-state", ends[1])
        self.assertEqual(self.values(path, "--restart", ends[1]), self.values(path, *MESH))

    def test_windows(self):
        path, ends = self.scene(windows("when: {from: from}")), self.folder / "ends.h5"
        self.values(path, *MESH, "--set", "end=1", "--save-state", ends)
        for begin in (0, 0.5, 1, 1.25):
            with self.subTest(begin=begin):
                one = self.rows(path, *MESH, "--set", f"from={begin}")
                two = self.rows(path, "--restart", ends, "--set", f"from={begin}")
                self.assertGreater(sum(row["status"] == "ok" for row in one.values()), 40)
                for name, row in two.items():
                    if begin >= 1 or "_" not in name:
                        self.assertEqual((row["status"], row["value"]), (one[name]["status"], one[name]["value"]), name)
                    else:
                        self.assertEqual((row["status"], row["value"]), ("no_value", ""), name)
                        self.assertEqual(row["reason"], f"needs the motion from {begin} s, but this run continues "
                                         "from 1 s: run without --restart, or let its window ('when') begin at "
                                         "1 s or later")

    def test_before_the_restart(self):
        path, ends = self.scene(windows("when: {until: until}", early="at: 0.5", track="take: curve")), \
            self.folder / "ends.h5"
        self.values(path, *MESH, "--set", "end=1", "--save-state", ends)
        self.values(path, *MESH)
        rows = self.rows(path, "--restart", ends, "--set", "until=0.5")
        for name, row in rows.items():
            if "_" in name:
                self.assertIn("needs the motion from 0 s", row["reason"], name)
                self.assertTrue(row["reason"].endswith("run without --restart"), row["reason"])
        self.assertEqual(rows["early"]["reason"], "needs the motion at 0.5 s, but this run continues from 1 s: "
                         "run without --restart")
        self.assertEqual(rows["track"]["meaning"], "begins at 1 s, where this run continues another run")
        self.assertIn("\ntrack                        begins at 1 s, where",
                      self.answered("solve", "--scene", path, "--restart", ends).stdout)

    def test_a_window_before_a_second_motion(self):
        text = SWING.replace("quantities:", "  later: {motion: {stations: [end+1], integrator: how, step: step, "
                             "tolerance: tol, about: swing}}\nquantities:\n  mean: {rate: {analysis: later, "
                             "node: tip, component: ux, take: mean}, when: {from: end}}")
        self.answered("solve", "--scene", self.scene(text), *MESH)
        self.refused(2, "begins at 1 s, but analysis later begins at 2 s, where swing ends",
                     "solve", "--scene", self.scene(text.replace("from: end", "from: end-1")), *MESH)

    def test_refused(self):
        path, ends, cut = self.scene(SWING), self.folder / "ends.h5", self.folder / "cut.h5"
        self.values(path, *MESH, "--set", "end=1", "--save-state", ends)
        cut.write_bytes(ends.read_bytes()[:-100])
        again = ("solve", "--scene", path, "--restart", ends)
        for code, words, options in (
                (2, "is at 1 s; add a later station", (*again, "--set", "end=1")),
                (2, "the number of elements of the file", (*again, "-n", 4)),
                (2, "give the formulation and the number of elements", (*again, "-f", "collocation")),
                (2, "without --all-dofs", (*again, "--all-dofs")),
                (2, "integrator: conserving", (*again, "--set", "how=conserving")),
                (2, "step: 0.01,", (*again, "--set", "step=0.01")),
                (2, "mass: 0.31,", (*again, "--set", "mass=0.31")),
                (2, "which is an input", (*again, "--save-state", ends)),
                (2, "remove -k, --shapes, --matrices, --save-state and", (*again, "--follow", "mass=0.1..0.2/2")),
                (2, "require a motion, but the scene has none", ("solve", "elastica", "--restart", ends)),
                (2, "require a motion, but the scene has none", ("solve", "elastica", "--save-state", self.folder / "none.h5")),
                (4, "its end is missing", ("solve", "--scene", path, "--restart", cut)),
                (4, "not written by --save-state", ("solve", "--scene", path, "--restart", TRUTHS)),
                (4, "cannot be read", ("solve", "--scene", path, "--restart", self.folder / "none.h5"))):
            with self.subTest(words=words):
                self.refused(code, words, *options)
        self.assertFalse((self.folder / "none.h5").exists())


if __name__ == "__main__":
    unittest.main()
