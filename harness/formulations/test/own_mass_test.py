"""A formulation in another process that computes its inertia must have the frequencies (within 1e-9) and motions of
the same formulation in C and satisfy the interface requirements."""
import json
import sys

from harness.cli.test.plugin import EXAMPLES, compile_shared
from harness.formulations.test.speaker import Speaker
from harness.tools.kit.program import ROOT, broken, environment, run

WITH_MODULES = environment(PYTHONPATH=str(EXAMPLES))
FREQUENCIES = (("deep_beam", ()), ("c_column", ()), ("release", ("time=0.002", )), ("sheet_cantilever", ("modes=3", )))
HOW = ("integrator: radau, step: 0.005", "integrator: alpha, step: 0.004")
SWING = """beamwork: 1
sections: {s: {rectangle: {width: 0.03, thickness: 0.004}, young: 2e9, shear_modulus: 8e8, density: 3000}}
nodes: {a: {at: [0, 0, 0], hold: [ux, uy, uz]}, b: {at: [0.6, 0, 0.1]}, c: {at: [0.6, 0.5, 0]}}
members: {ab: {from: a, to: b, section: s, y: [0, 1, 0]}, bc: {from: b, to: c, section: s, y: [0, 0, 1]}}
loads: {pull: {force: [0, 1, 2], on: c}, w: {gravity: [0, 0, -9.81], on: ab}}
omit: [warping, trapeze, wagner_torque]
analyses: {run: {motion: {stations: [0.15], %s}}}
quantities: {x: {displacement: {analysis: run, node: c, component: ux}},
  y: {displacement: {analysis: run, node: c, component: uy}},
  z: {displacement: {analysis: run, node: c, component: uz}}}
%s"""
# Axial displacement of the end of a rod that rotates about its other end: rho omega^2 L^3/(3 E).
SPIN = """beamwork: 1
sections: {s: {rectangle: {width: 0.03, thickness: 0.004}, young: 2e9, shear_modulus: 8e8, density: 3000}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [0.6, 0, 0]}}
members: {ab: {from: a, to: b, section: s, y: [0, 1, 0]}}
omit: [warping, trapeze, wagner_torque]
analyses: {spin: {rotation: {omega: [0, 0, 20], stations: [1]}}}
quantities: {u: {displacement: {analysis: spin, node: b, component: ux}}}
"""


class OwnMass(Speaker):

    def python(self, before="", after="", name="own_mass.py"):
        text = (EXAMPLES / name).read_text(encoding="utf-8")
        self.assertIn(before, text)
        path = self.folder / "mine.py"
        path.write_text(text.replace(before, after, 1), encoding="utf-8")
        return f"exec:'{sys.executable}' '{path}'"

    def solved(self, element, name, case, n, point=()):
        words = [w for one in point for w in ("--set", one)]
        done = self.answered("solve", *case.split(), "--element", element, "-f", name, "-n", n, *words, "--format",
                             "json", env=WITH_MODULES)
        record = json.loads(done.stdout)
        return record["cell"], {q["quantity"]: q["value"] for q in record["quantities"]}

    def in_c(self, case, n, point=()):
        made = self.folder / "own_mass.so"
        if not made.exists():
            compile_shared(ROOT / "harness/formulations/test/own_mass.c", made)
        return self.solved(made, "own_mass", case, n, point)[1]

    def test_frequencies(self):
        for case, point in FREQUENCIES:
            there = self.in_c(case, 4, point)
            _, here = self.solved(self.python(), "own_mass_py", case, 4, point)
            _, shared = self.solved(self.python(name="timoshenko.py"), "timoshenko_py", case, 4, point)
            names = [q for q in there if q.startswith("frequency")]
            self.assertTrue(any(abs(here[q] / shared[q] - 1) > 1e-3 for q in names), case)
            for q in names:
                self.assertLessEqual(abs(here[q] / there[q] - 1), 1e-9, (case, q))

    def swing(self, how, more=""):
        path = self.folder / "swing.yaml"
        path.write_text(SWING % (how, more), encoding="utf-8")
        return f"--scene {path}"

    def test_motions(self):
        for how in HOW:
            there = self.in_c(self.swing(how), 1)
            cell, here = self.solved(self.python(), "own_mass_py", self.swing(how), 1)
            self.assertNotIn("mass", cell["lumped"])
            self.assertGreater(max(abs(v) for v in there.values()), 0.2)
            for q, value in there.items():
                self.assertLessEqual(abs(here[q] - value), 1e-7, (how, q))

    def test_vibration_alone(self):
        changed = ("mass=mass,", 'mass=mass, inertia="vibration",')
        cell, here = self.solved(self.python(*changed), "own_mass_py", self.swing(HOW[1]), 1)
        self.assertIn("mass and weight of analysis run: at the nodes", cell["lumped"])
        beam = self.solved(self.python(*changed), "own_mass_py", "deep_beam", 4)[1]
        whole, lumped = (self.solved(self.python(), "own_mass_py", self.swing(HOW[1], more), 1)[1]
                         for more in ("", "mass: lumped\n"))
        self.assertEqual(here, lumped)
        self.assertGreater(max(abs(here[q] - whole[q]) for q in here), 1e-3)
        self.assertEqual(beam, self.solved(self.python(), "own_mass_py", "deep_beam", 4)[1])

    def test_rotating_frame(self):
        path = self.folder / "spin.yaml"
        made = self.folder / "own_mass.so"
        compile_shared(ROOT / "harness/formulations/test/own_mass.c", made)
        for more in "", "mass: lumped\n":
            path.write_text(SPIN + more, encoding="utf-8")
            solve = ("solve", "--scene", path, "--element", made, "-f", "own_mass", "-n", 4, "--format", "json")
            if more:
                value = json.loads(self.answered(*solve).stdout)["quantities"][0]["value"]
                self.assertLessEqual(abs(value / (3000 * 20**2 * 0.6**3 / 3 / 2e9) - 1), 0.02)
            else:
                self.refused(2, "formulation own_mass: its 'inertia' does not support rotating frames; give mass: lumped",
                             *solve)

    def contract(self, element, code=0):
        out = self.answered("element-test", "own_mass_py", "--element", element, "--format", "json", code=code,
                            env=WITH_MODULES).stdout
        record = json.loads(out)
        claims = {}
        for one in record["claims"]:
            if one["family"] in ("mass", "rotating", "in_time"):
                claims.setdefault(one["family"], []).append(one)
        return claims, " ".join(broken(record))

    def test_contract(self):
        claims, broken = self.contract(self.python())
        self.assertEqual((len(claims), broken), (3, ""))
        for part, made in claims.items():
            self.assertTrue(all(c["outcome"] == "holds" for c in made), (part, made))

    def test_contract_notices(self):
        for before, after, words in (
                ("    return M.reshape", "    M *= 1.01\n    return M.reshape", "the mass along x"),
                ("    return M.reshape", "    M[:, 0, 0, 1, 1] += M[:, 0, 0, 0, 0] / 9\n    return M.reshape",
                 "the transposed entry is"),
                ("R[:, p] * about @ R[:, p].swapaxes(1, 2)", "np.diag(about)", "rotated as a whole")):
            self.assertIn(words, self.contract(self.python(before, after), code=1)[1])

    def test_mistakes(self):
        for before, after, words in (
                ("    return M.reshape(-1, 14, 14)", "    return M", "mass returned (N, 2, 7, 2, 7), nodes=2 wants"),
                ("    c, l = kind.section, kind.length\n    M", "    1 / 0\n    M", "ZeroDivisionError: division by"),
                ("M.reshape(-1, 14, 14)", "abs(M.reshape(-1, 14, 14))", "mass is not analytic")):
            self.refused(1, words, "solve", *self.swing(HOW[1]).split(), "-n", 1, "-f", "own_mass_py", "--element",
                         self.python(before, after), env=WITH_MODULES, silent=False)

    def test_first_line(self):
        for word, told in (("'yes'", "give vibration or motion"), ("1", "give vibration or motion")):
            self.refuse(self.speaker(first=f"said['inertia'] = {word}"), "key 'inertia' of its first line", told)
        self.refuse(self.speaker(first="said.update(inertia='motion', offers=['shear'])"), "add mass to 'offers'")
        self.refuse(self.speaker(first="said.update(inertia='motion', nodes=3)"), "motion is only for elements with two nodes")

    def test_asked_only_where_it_is_brought(self):
        for first, asked in (("", False), ("said['inertia'] = 'vibration'", True)):
            done = run("solve", "deep_beam", "-f", "speaker", "-n", 2, "--element",
                       self.speaker(first=first, at="if what == 5: os._exit(3)"))
            self.assertEqual((done.returncode, "ended with status 3" in done.stderr), (1, asked), done)
