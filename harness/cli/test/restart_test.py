"""Motions that another run goes on with: as one run, bit for bit where steps stay and end there."""
import csv
import unittest

from cases.format.test.scene_case import SceneCase
from harness.tools.kit.program import TRUTHS

# Turned quickly out of its place under its weight, with a load that comes at once.
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
MESH = ("-f", "geometrically_exact", "-n", 2)


class RestartTest(SceneCase):

    def values(self, path, *options):
        done = self.answered("solve", "--scene", path, "--format", "csv", *options)
        rows = csv.DictReader(line for line in done.stdout.splitlines() if not line.startswith("#"))
        return {row["quantity"]: row["value"] for row in rows}

    def in_two(self, stop=1, **changes):
        """Quantities of one run and of another that goes on from where a third stopped."""
        path, sets = self.scene(SWING), [f"--set={k}={v}" for k, v in changes.items()]
        ends = self.folder / "ends.h5"
        one = self.values(path, *MESH, *sets)
        self.values(path, *MESH, *sets, "--set", f"end={stop}", "--ends", ends)
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
        """Factors of a run that begins pivot anew; a step that an end cuts short is another one."""
        for changes, most in (({"how": "radau"}, 1e-9), ({"how": "radau", "damp": 1e-3}, 1e-9),
                              ({"how": "radau", "tol": 1e-8}, 1e-4), ({"how": "alpha", "step": 0.01}, 1e-9)):
            with self.subTest(**changes):
                one, two = self.in_two(**changes)
                for name, value in one.items():
                    self.assertAlmostEqual(float(two[name]), float(value), delta=most * max(1, abs(float(value))))

    def test_one_after_the_other(self):
        """From a restart to the next one."""
        path, ends = self.scene(SWING), [self.folder / f"{i}.h5" for i in range(3)]
        self.values(path, *MESH, "--set", "end=0.5", "--ends", ends[0])
        self.values(path, "--set", "end=1", "--restart", ends[0], "--ends", ends[1])
        self.assertEqual(self.values(path, "--restart", ends[1]), self.values(path, *MESH))

    def test_refused(self):
        path, ends, cut = self.scene(SWING), self.folder / "ends.h5", self.folder / "cut.h5"
        self.values(path, *MESH, "--set", "end=1", "--ends", ends)
        cut.write_bytes(ends.read_bytes()[:-100])
        again = ("solve", "--scene", path, "--restart", ends)
        for code, words, options in (
                (2, "is at 1 s: give it a later one", (*again, "--set", "end=1")),
                (2, "the elements that it began with", (*again, "-n", 4)),
                (2, "the formulation and the elements", (*again, "-f", "collocation")),
                (2, "without --keep-all", (*again, "--keep-all")),
                (2, "integrator: conserving", (*again, "--set", "how=conserving")),
                (2, "step: 0.01,", (*again, "--set", "step=0.01")),
                (2, "mass: 0.31,", (*again, "--set", "mass=0.31")),
                (2, "which is read", (*again, "--ends", ends)),
                (2, "leave -k, --shapes, --matrices, --ends and", (*again, "--follow", "mass=0.1..0.2/2")),
                (2, "no motion in time", ("solve", "elastica", "--restart", ends)),
                (2, "no motion in time", ("solve", "elastica", "--ends", self.folder / "none.h5")),
                (4, "cut short", ("solve", "--scene", path, "--restart", cut)),
                (4, "not a file of --ends", ("solve", "--scene", path, "--restart", TRUTHS)),
                (4, "cannot be read", ("solve", "--scene", path, "--restart", self.folder / "none.h5"))):
            with self.subTest(words=words):
                self.refused(code, words, *options)
        self.assertFalse((self.folder / "none.h5").exists())


if __name__ == "__main__":
    unittest.main()
