"""What can be had is printed; what cannot is told with its reason and by the exit status."""
import json

from harness.tools.kit.program import ProgramTest, run

BAR = """beamwork: 1
parameters: {depth: {value: 0.1, unit: m, min: 0.05, max: 0.5, about: "of the section at b"},
             damping: {value: 0, unit: s, min: 0, max: 1, about: "of the member"}}
sections:
  s: {i: {depth: 0.2, flange: 0.1, flange_thickness: 0.008, web_thickness: 0.005}, young: 210e9,
      shear_modulus: 81e9, density: 7850}
  t: {i: {depth: depth, flange: 0.1, flange_thickness: 0.008, web_thickness: 0.005}, young: 210e9,
      shear_modulus: 81e9, density: 7850}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [2, 0, 0]}}
members: {m: {from: a, to: b, section: [s, t], y: [0, 1, 0], damping: damping}}
loads: {p: {force: [0, 0, 100], on: b}}
analyses: {run: {linear: {}}}
quantities: {uz: {displacement: {analysis: run, node: b, component: uz}}}
"""
HINGES = """beamwork: 1
sections: {s: {constants: {A: 1e-3, Iy: 1e-6, Iz: 1e-6, It: 2e-6}, young: 210e9,
               shear_modulus: 81e9}}
nodes: {a: {at: [0, 0, 0], hold: all}, m: {at: [1, 0, 0]}, b: {at: [2, 0, 0], hold: all}}
members:
  p: {from: a, to: m, section: s, y: [0, 1, 0], release: {to: [rz]}}
  q: {from: m, to: b, section: s, y: [0, 1, 0], release: {from: [rz]}}
loads: {f: {force: [0, 960, 0], on: m}}
analyses: {run: {linear: {}}}
quantities:
  uy: {displacement: {analysis: run, node: m, component: uy}}
  rz: {displacement: {analysis: run, node: m, component: rz}}
"""


class Had(ProgramTest):
    def scene(self, text):
        path = self.folder / "own.yaml"
        path.write_text(text)
        return path

    def test_one_quantity_of_two(self):
        words = ("solve", "--scene", self.scene(HINGES), "-f", "collocation", "-n", "2")
        done = run(*words)
        self.assertEqual(done.returncode, 1, done)
        self.assertEqual(len(done.stderr.splitlines()), 1, done)
        self.assertIn("node m turns by itself", done.stderr)
        self.assertRegex(done.stdout, r"uy +7\.61904")
        told = json.loads(run(*words, "--format", "json").stdout)
        values = {q["quantity"]: q["value"] for q in told["quantities"]}
        self.assertAlmostEqual(values["uy"], 960 / 6 / 210e3, delta=1e-6)
        self.assertIsNone(values["rz"])
        found = run("converge", "--scene", self.scene(HINGES), "-f", "collocation", "-n", "1,2")
        self.assertEqual(found.returncode, 0, found)

    def test_values_that_are_asked_for(self):
        """A taper of an open section is refused, a prismatic member is none."""
        words = ("solve", "--scene", self.scene(BAR), "-f", "collocation", "-n", "2")
        self.refused(2, "own.yaml", *words)
        done = run(*words, "--set", "depth=0.2")
        self.assertEqual((done.returncode, done.stderr), (0, ""), done)
        self.refused(2, "own.yaml", *words, "--set", "depth=0.3")
        self.refused(2, "did you mean 'depth'", *words, "--set", "deptj=0.2")

    def test_matrices_without_damping(self):
        words = ("solve", "--scene", self.scene(BAR), "-f", "collocation", "-n", "2", "--set",
                 "depth=0.2", "--matrices", self.folder / "matrices")
        self.refused(2, "member m has 0.001 s", *words, "--set", "damping=1e-3")
        self.assertEqual(run(*words).returncode, 0)
