"""Damping that a formulation computes: the closed form of a viscous (Kelvin-Voigt) material, the same damping given by
the scene, and the checks of the damping matrix."""
import json
import math
import subprocess
import sys

import scipy.io

from harness.cli.test.plugin import EXAMPLES, compile_shared
from harness.formulations.test.speaker import Speaker
from harness.tools.kit.program import ROOT, broken, environment

WITH_MODULES = environment(PYTHONPATH=str(EXAMPLES))
ETA = 1e-3
# A cantilever in one plane. About the unstressed state, its equation is E I d^4/dx^4 (w + eta dw/dt) + rho A d^2w/dt^2
# = 0.
CANTILEVER = """beamwork: 1
sections: {s: {rectangle: {width: 0.02, thickness: 0.01}, young: 2e9, shear_modulus: 8e8, density: 1000}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0], hold: [ux, uz, rx, ry]}}
members: {ab: {from: a, to: b, section: s, y: [0, 1, 0]%s}}
omit: [warping, shear, trapeze, wagner_torque, wagner_moments, rotary_inertia]
"""
MODES = CANTILEVER + """analyses: {free: {modal: {}}, damped: {modal: {damped: yes}}}
quantities:
  f$i: {for: {i: 0..1}, frequency: {analysis: free, which: $i}}
  d$i: {for: {i: 0..1}, damping_ratio: {analysis: damped, which: $i, of: decay}}
"""
SHAKEN = CANTILEVER + """analyses: {shake: {harmonic: {frequencies: [%r]}}, push: {compliance: {node: b}}}
loads: {tip: {force: [0, 1, 0], on: b}}
quantities: {w: {response: {analysis: shake, node: b, component: uy, force: b, along: uy, at: %r}}}
"""
PULLED = """beamwork: 1
sections: {s: {constants: {A: 1e-4, Iy: 1e-8, Iz: 1e-8, It: 1e-8}, young: 1e6, shear_modulus: 4e5}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [0.5, 0, 0], hold: [uy, uz, rx, ry, rz], mass: 2}}
members: {ab: {from: a, to: b, section: s, y: [0, 1, 0]}}
omit: [warping, trapeze, wagner_torque, wagner_moments, rotary_inertia]
analyses: {go: {motion: {stations: [0.9], integrator: %s, step: 1e-3, start: {velocity: [0.01, 0, 0]}}}}
quantities:
  u: {displacement: {analysis: go, node: b, component: ux}}
  v: {rate: {analysis: go, node: b, component: ux}}
  N: {internal: {analysis: go, member: ab, end: to, resultant: N}}
  lost: {energy: {analysis: go, of: dissipated}}
"""
SWING = """beamwork: 1
sections: {s: {rectangle: {width: 0.03, thickness: 0.004}, young: 2e9, shear_modulus: 8e8, density: 3000}}
nodes: {a: {at: [0, 0, 0], hold: [ux, uy, uz]}, b: {at: [0.6, 0, 0.1]}, c: {at: [0.6, 0.5, 0], mass: 0.1}}
members:
  ab: {from: a, to: b, section: s, y: [0, 1, 0]%s}
  bc: {from: b, to: c, section: s, y: [0, 0, 1]%s}
loads: {pull: {force: [0, 1, 2], on: c}, w: {gravity: [0, 0, -9.81], on: ab}}
omit: [warping, trapeze, wagner_torque]
analyses:
  run: {motion: {stations: [0.15], %s}}
  modes: {modal: {about: run, time: 0.15, damped: yes}}
quantities:
  x: {displacement: {analysis: run, node: c, component: ux}}
  y: {displacement: {analysis: run, node: c, component: uy}}
  lost: {energy: {analysis: run, of: dissipated}}
  drift: {energy: {analysis: run, of: drift}}
  M: {internal: {analysis: run, member: bc, end: from, resultant: My}}
  decay: {damping_ratio: {analysis: modes, which: 2, of: decay}}
"""
INTEGRATORS = ("alpha, step: 0.002", "radau, step: 0.005", "conserving, step: 0.002")


class OwnDamping(Speaker):

    def python(self, before="", after=""):
        text = (EXAMPLES / "own_damping.py").read_text(encoding="utf-8")
        self.assertIn(before, text)
        path = self.folder / "mine.py"
        path.write_text(text.replace(before, after, 1), encoding="utf-8")
        return f"exec:'{sys.executable}' '{path}'"

    def in_c(self):
        made = self.folder / "own_damping.so"
        if not made.exists():
            compile_shared(ROOT / "harness/formulations/test/own_damping.c", made)
        return made

    def solved(self, text, element=None, chosen=None, n=1, *more):
        path = self.folder / "scene.yaml"
        path.write_text(text, encoding="utf-8")
        chosen = chosen or f"own_damping_py:eta={ETA},eta_torsion={ETA}"
        done = self.answered("solve", "--scene", path, "--element", element or self.python(), "-f", chosen, "-n", n,
                             "--format", "json", *more, env=WITH_MODULES)
        return {q["quantity"]: q["value"] for q in json.loads(done.stdout)["quantities"]}

    def test_modes(self):
        """A mode must decay at the rate eta (2 pi f)^2/2 within 2e-4, where f is its frequency without damping."""
        for element, chosen in ((None, None), (self.in_c(), f"own_damping:eta={ETA}")):
            found = self.solved(MODES % "", element, chosen, 8)
            for i in range(2):
                expected = ETA * (2 * math.pi * found[f"f{i}"])**2 / 2
                self.assertLessEqual(abs(found[f"d{i}"] / expected - 1), 1e-5 if i == 0 else 2e-4)

    def test_resonance(self):
        f = self.solved(MODES % "", n=8)["f0"]
        w, first = 2 * math.pi * f, 0.97068  # share of the first mode in the static compliance, 12/1.8751^4
        found = self.solved(SHAKEN % ("", f, f), n=8)["w"]
        static = 1 / (3 * 2e9 * 0.02 * 0.01**3 / 12)
        self.assertLessEqual(abs(found / (first * static / (ETA * w)) - 1), 1e-3)

    def test_decay(self):
        """The displacement must be u = v0/wd exp(-d t) sin(wd t) with the initial velocity v0, the decay rate d and
        the angular frequency wd, and the axial force must contain the damping stress."""
        k, m, v0, t = 200, 2, 0.01, 0.9
        d = ETA * 20 * k / (2 * m)
        wd = math.sqrt(k / m - d * d)
        u = v0 / wd * math.exp(-d * t) * math.sin(wd * t)
        v = v0 * math.exp(-d * t) * math.cos(wd * t) - d * u
        lost = m * v0**2 / 2 - m * v**2 / 2 - k * u**2 / 2
        for integrator, close in (("radau", 1e-9), ("alpha", 2e-3), ("conserving", 1e-4)):
            for element, chosen in ((None, "own_damping_py"), (self.in_c(), "own_damping")):
                found = self.solved(PULLED % integrator, element, f"{chosen}:eta={20 * ETA}")
                for name, value, size in (("u", u, v0 / wd), ("v", v, v0), ("N", k * u + 20 * ETA * k * v, k * v0 / wd),
                                          ("lost", lost, lost)):
                    rate = 1e-5 if name == "N" else 0
                    self.assertLessEqual(abs(found[name] - value), max(close, rate) * size, (integrator, name))

    def test_same_as_damping_of_members(self):
        def swung(how, own, given):
            more = f", damping: {given}"
            return self.solved(SWING % (more, more, f"integrator: {how}"), self.in_c(), f"own_damping:eta={own}")

        for how in INTEGRATORS:
            there = swung(how, 0, ETA)
            self.assertGreater(there["lost"], 1e-5)
            for here in swung(how, ETA, 0), swung(how, ETA / 2, ETA / 2):
                for name, value in there.items():
                    size = max(abs(value), abs(there["lost"]))
                    self.assertLessEqual(abs(here[name] - value), 1e-9 * size, (how, name))

    def test_matrices(self):
        own, given = (f"own_damping_py:eta={eta},eta_torsion={eta}" for eta in (ETA, 0))
        for i, (chosen, more) in enumerate(((own, ""), (given, f", damping: {ETA}"))):
            self.solved(MODES % more, None, chosen, 2, "--matrices", self.folder / str(i))
        here, there = (scipy.io.mmread(next((self.folder / str(i)).rglob("C.mtx"))).toarray() for i in range(2))
        self.assertGreater(abs(there).max(), 0)
        self.assertLessEqual(abs(here - there).max(), 1e-13 * abs(there).max())

    def contract(self, element, name, code=0):
        out = self.answered("element-test", name, "--element", element, "--format", "json", code=code,
                            env=WITH_MODULES).stdout
        record = json.loads(out)
        return [c["outcome"] for c in record["claims"] if "damping" in c["claim"]], " ".join(broken(record))

    def test_contract(self):
        for element, name in ((self.python(), "own_damping_py"), (self.in_c(), "own_damping")):
            made, wrong = self.contract(element, name)
            self.assertEqual((made, wrong), (["holds", "holds"], ""))
        wrong = self.contract(self.python("return prepare(kind) * eta", "return prepare(kind) * eta - "
                                          "2 * prepare(kind) * np.diag(eta)[3]"), "own_damping_py", code=1)[1]
        self.assertIn("some motions gain energy", wrong)
        wrong = self.contract(self.python("return prepare(kind) * eta", "return prepare(kind) * eta + "
                                          "np.eye(6, k=1) * 1e-3"), "own_damping_py", code=1)[1]
        self.assertIn("the transposed entry is", wrong)

    def test_refused(self):
        def solve(text, element, chosen):
            path = self.folder / "scene.yaml"
            path.write_text(text, encoding="utf-8")
            return "solve", "--scene", path, "--element", element, "-f", chosen, "-n", 1

        self.refused(2, "motions would gain energy", *solve(PULLED % "radau", self.in_c(), "own_damping:eta=-0.1"))
        self.refused(2, "nor damping of the formulation", *solve(PULLED % "explicit", self.in_c(), "own_damping"))
        static = PULLED.replace("analyses: {", "loads: {f: {force: [1, 0, 0], on: b}}\nanalyses: {still: {static: {stations: "
                                "[1]}}, ") + "  s: {displacement: {analysis: still, node: b, component: ux}}\n"
        out = self.answered(*solve(static % "explicit", self.in_c(), "own_damping"), code=2).stdout
        self.assertEqual(out, "")
        self.refused(2, "damping returned (3), strains=6 wants (6, 6)",
                     *solve(PULLED % "radau", self.python("return prepare(kind) * eta", "return eta[:3]"),
                            "own_damping_py"), env=WITH_MODULES)

    def test_slender(self):
        slender = CANTILEVER.replace("width: 0.02, thickness: 0.01", "width: 0.01, thickness: 1e-5") % ""
        slender += """analyses: {damped: {modal: {damped: yes}}}
quantities: {d: {damping_ratio: {analysis: damped, which: 0, of: decay}}}
"""
        path = self.folder / "scene.yaml"
        path.write_text(slender, encoding="utf-8")
        for factor, entry, told, shown in (("-1", 5, "entry 6, 6 of its damping matrix is -", "entry 6, 6 of V is -"),
                                           ("np.nan", 1, "entry 1, 2 of its damping matrix is NaN; give",
                                            "entry 1, 2 of V is NaN")):
            wrong = self.python("eta[3] = kind.options[\"eta_torsion\"]", f"eta[{entry}] *= {factor}")
            self.refused(2, told, "solve", "--scene", path, "--element", wrong, "-f", "own_damping_py", "-n", 1,
                         env=WITH_MODULES)
            self.assertIn(shown, self.contract(wrong, "own_damping_py", code=1)[1])

    def test_only_damping(self):
        given = self.solved(PULLED % "radau", None, f"own_damping_py:eta={20 * ETA}")
        own = self.python("serve(prepare, strain, damping=damping", """

    def stress(kind, e):
        C = prepare(kind)
        return np.einsum("ni,ij,nj->n", e, C, e) / 2, e @ C, np.tile(C, (len(e), 1, 1))

    serve(lambda kind: None, strain, stress, damping=damping""")
        self.assertEqual(given.keys(), (found := self.solved(PULLED % "radau", own, f"own_damping_py:eta={20 * ETA}")).keys())
        for name, value in given.items():
            self.assertLessEqual(abs(found[name] - value), 1e-9 * abs(value), name)

    def test_arrays(self):
        self.python("damping=damping", "damping=np.eye(6)")
        told = subprocess.run([sys.executable, self.folder / "mine.py"], env=WITH_MODULES, stdin=subprocess.DEVNULL,
                              capture_output=True, encoding="utf-8", check=False).stderr
        self.assertEqual(len(told.splitlines()), 1, told)
        self.assertIn("damping=ndarray is no function", told)

    def breaks(self, element, *words):
        told = self.answered("solve", "elastica", "-f", "speaker", "-n", "2", "--element", element, code=1).stderr
        for word in words:
            self.assertIn(word, told)

    def test_first_line(self):
        self.refuse(self.speaker(first="said['damping'] = 1"), "key 'damping' of its first line", "give true or false")
        for more in "", "body += body[:280]", "body *= 3":
            self.breaks(self.speaker(first="said['damping'] = True", at=f"if what == 1: {more or 'pass'}"),
                        "bytes instead of 576; with 'damping' true, answer prepare with C, then V")
        self.breaks(self.speaker(first="said['damping'] = 'only V'", at="if what == 1: body *= 2"),
                    "an answer has 576 bytes instead of 288", "with 'only V', answer with V")
        self.refuse(self.speaker(first="said.update(damping=True, gives='energy'); del said['strains']"),
                    "give strains (e, or e,J, or e,J,H")
