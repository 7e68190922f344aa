"""Element types with additional unknowns at their nodes: scalars.c must agree with closed forms, and ancf_slopes.c
with timoshenko.c within 2e-3 in all analyses."""
import json
import math
import re
import shutil
import sys
import unittest

from harness.cli.test.plugin import EXAMPLES, compile_shared
from harness.tools.kit.program import ROOT, ProgramTest, environment, run

EA, LENGTH, BETA, GAMMA, LOAD, DENSITY = 2e11 * 2e-4, 1.0, 0.5, 2.0, 100.0, 8000
BAR = """beamwork: 1
sections: {s: {rectangle: {width: 0.02, thickness: 0.01}, young: 2e11, shear_modulus: 8e10, density: 8000}}
nodes: {a: {at: [0, 0, 0], hold: all}, %s}
members: {%s}
omit: [warping, trapeze, wagner_torque, shear, rotary_inertia]
loads: {pull: {force: [100, 0, 0], on: b}}
"""
GUIDED = "hold: [uy, uz, rx, ry, rz]"
ONE = BAR % (f"b: {{at: [1, 0, 0], {GUIDED}, mass: 3}}", "ab: {from: a, to: b, section: s, y: [0, 1, 0]}")
LINEAR = """analyses: {run: {linear: {}}}
quantities: {u: {displacement: {analysis: run, node: b, component: ux}}}
"""
FRAME = """beamwork: 1
sections: {s: {rectangle: {width: 0.02, thickness: 0.01}, young: 2.0e11, shear_modulus: 7.7e10, density: 7800}}
nodes: {base: {at: [0, 0, 0], hold: all}, mid: {at: [0.5, 0, 0]}, knee: {at: [1, 0, 0]},
  tip: {at: [1, 0.6, 0.1], mass: 0.3}}
members:
  a: {from: base, to: mid, section: s, y: [0, 1, 0], damping: 1e-5}
  b: {from: knee, to: mid, section: s, y: [0, 1, 0], damping: 1e-5}
  c: {from: knee, to: tip, section: s, y: [1, 0, 0], release: {from: [rz]}}
springs: {s: {from: knee, to: tip, stiffness: [2000, 2000, 2000, 0, 0, 0]}}
omit: [warping, trapeze, wagner_torque]
loads: {F: {on: tip, force: [10, -40, 20], time: "cos(20*t)"}, q: {on: a, distributed: [0, 30, 10], time: 1}}
analyses:
  push: {static: {stations: 0..1/2}}
  comp: {compliance: {node: tip, about: push}}
  buck: {buckling: {}}
  modes: {modal: {damped: yes}}
  loaded: {modal: {about: push}}
  shake: {harmonic: {frequencies: [3, 10, 40]}}
  swing: {motion: {stations: [0.05, 0.1], integrator: INTEGRATOR, step: 0.005}}
quantities:
  uy: {displacement: {analysis: push, node: tip, component: uy}}
  R: {reaction: {analysis: push, node: base, component: rz}}
  M: {internal: {analysis: push, member: a, where: 0.3, resultant: Mz}}
  C: {compliance: {analysis: comp, row: uy, column: uy}}
  crit: {critical_factor: {analysis: buck}}
  f1: {frequency: {analysis: modes, which: 1}}
  z1: {damping_ratio: {analysis: modes, which: 1}}
  g2: {frequency: {analysis: loaded, which: 2}}
  h: {response: {analysis: shake, node: tip, component: uy, force: tip, along: uy, at: 10}}
  swung: {displacement: {analysis: swing, node: tip, component: uy}}
"""
CONSTANT = FRAME[:FRAME.index("analyses:")].replace(', time: "cos(20*t)"', "").replace(", time: 1", "")
CASES = CONSTANT.replace("on: tip,", "on: tip, case: live,").replace("on: a,", "on: a, case: dead,") + """
combinations: {both: {dead: 1.35, live: 1.5}}
analyses:
  flat: {linear: {combination: both}}
  buck: {buckling: {combination: both}}
  push: {static: {combination: both, stations: [1]}}
quantities:
  flat: {displacement: {analysis: flat, node: tip, component: uy}}
  buck: {critical_factor: {analysis: buck}}
  push: {displacement: {analysis: push, node: tip, component: uy}}
"""
PATH = CONSTANT + """
analyses:
  push: {static: {stations: 0..1/2}}
  go: {continuation: {control: {node: tip, component: uy}, by: arc, to: [-0.3], step: 0.2}}
  modes: {modal: {about: push, damped: yes}}
  shake: {harmonic: {frequencies: [3, 10, 40], about: push}}
  spin: {rotation: {omega: [0, 0, 20], stations: [1]}}
quantities:
  factor: {factor_at: {analysis: go}}
  moved: {displacement: {analysis: go, node: tip, component: ux}}
  f2: {frequency: {analysis: modes, which: 1}}
  z2: {damping_ratio: {analysis: modes, which: 1}}
  h: {response: {analysis: shake, node: tip, component: uy, force: tip, along: uy, at: 10}}
  spun: {displacement: {analysis: spin, node: tip, component: ux}}
"""
LOCKING = """beamwork: 1
sections: {s: {rectangle: {width: 0.1, thickness: 0.1}, young: 2e11, shear_modulus: 7.6923076923076923e10}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [2, 0, 0]}}
members: {ab: {from: a, to: b, section: s, y: [0, 1, 0]}}
omit: [warping, trapeze, wagner_torque]
loads: {F: {on: b, force: [0, 1, 0]}, T: {on: b, moment: [1, 0, 0]}}
analyses: {run: {linear: {}}}
quantities: {uy: {displacement: {analysis: run, node: b, component: uy}},
  rx: {displacement: {analysis: run, node: b, component: rx}}}
"""
PYTHON = """
import numpy as np
from beamwork_element import serve

def prepare(kind):
    kind.EA = kind.section.young * kind.section.A
    return np.diag([kind.EA / kind.length] + [1e-3 * kind.EA / kind.length] * 5 + [kind.EA / kind.length] * 2)

def strain(kind, r, u, R, a, s):
    l = kind.length
    chord = (r[:, 1] - r[:, 0])[:, None] @ R[:, 0]
    turned = np.einsum("nia,nib->nab", R[:, 0], R[:, 1])
    e = [chord[:, 0, 0] - l - l * 0.5 * (s[:, 0, 0] + s[:, 1, 0]) / 2, chord[:, 0, 1], chord[:, 0, 2],
         l * turned[:, 2, 1], l * turned[:, 0, 2], l * turned[:, 1, 0], l * s[:, 0, 0], l * s[:, 1, 0]]
    return np.stack(e, -1)

serve(prepare, strain, name="scalars_py", family="example", source="this test", summary="the bar of scalars.c",
      strains=8, scalars=1, offers=["geometric", "large rotations", "mass"], limits=["doubly symmetric"])
"""
OCTAVE = """1;

function C = prepare(kind)
EA = kind.section.young * kind.section.A;
C = diag([1, 1e-3 * ones(1, 5), 1, 1]) * EA / kind.length;
end

function e = strain(kind, r, u, R, a, s)
l = kind.length;
Rp = beamwork_element('transpose', reshape(R(:, :, 1, :), 3, 3, []));
chord = reshape(beamwork_element('product', Rp, r(:, 2, :) - r(:, 1, :)), 3, []);
T = beamwork_element('product', Rp, reshape(R(:, :, 2, :), 3, 3, []));
turned = [reshape(T(3, 2, :), 1, []); reshape(T(1, 3, :), 1, []); reshape(T(2, 1, :), 1, [])];
s = reshape(s, 2, []);
e = [chord - [l; 0; 0] - [l * 0.5 * sum(s, 1) / 2; 0 * s]; l * turned; l * s];
end

addpath('%s');
beamwork_element(@prepare, 'strain', @strain, 'strains', 8, 'scalars', 1, 'name', 'scalars_m', 'family', 'example', ...
    'summary', 'the bar of scalars.c', 'source', 'this test', 'offers', {'geometric', 'large rotations', 'mass'}, ...
    'limits', {'doubly symmetric'});
""" % EXAMPLES


class Scalars(ProgramTest):

    def solved(self, element, scene, n=1, *words, code=0):
        path = self.folder / "scene.yaml"
        path.write_text(scene, encoding="utf-8")
        names = [w for w in words if ":" in w or w in ("timoshenko", "ancf_slopes", "scalars_py", "scalars_m")]
        name = names[0] if names else "scalars"
        words = [w for w in words if w not in names]
        done = self.answered("solve", "--scene", path, "--element", element, "-f", name, "-n", n, *words, "--format",
                             "json", code=code, env=environment(PYTHONPATH=str(EXAMPLES)))
        if code:
            return done.stderr
        record = json.loads(done.stdout)
        return record["cell"], {q["quantity"]: q["value"] for q in record["quantities"]}

    def bar(self, *options):
        return compile_shared(ROOT / "harness/formulations/test/scalars.c", self.folder / "scalars.so", *options)

    def ancf(self):
        return compile_shared(EXAMPLES / "ancf_slopes.c", self.folder / "ancf_slopes.so")

    def test_free_and_held(self):
        stretch = LOAD * LENGTH / EA
        for n in (1, 2, 5):
            self.assertAlmostEqual(self.solved(self.bar(), ONE + LINEAR, n)[1]["u"] / stretch,
                                   (GAMMA + BETA**2) / GAMMA, delta=1e-8)
        held = self.solved(self.bar("-DHELD=1"), ONE + LINEAR)[1]["u"]
        self.assertAlmostEqual(held / stretch, (GAMMA + BETA**2 / 2) / GAMMA, delta=1e-8)
        freed = ONE.replace("y: [0, 1, 0]}", "y: [0, 1, 0], warping: free}")
        self.assertAlmostEqual(self.solved(self.bar("-DHELD=1"), freed + LINEAR)[1]["u"] / stretch,
                               (GAMMA + BETA**2) / GAMMA, delta=1e-8)

    def test_shared_between_members(self):
        nodes = f"m: {{at: [0.5, 0, 0], {GUIDED}}}, b: {{at: [1, 0, 0], {GUIDED}}}"
        for second, free in (("from: m, to: b", 5), ("from: b, to: m", 6)):
            scene = BAR % (nodes, "am: {from: a, to: m, section: s, y: [0, 1, 0]}, "
                           f"mb: {{{second}, section: s, y: [0, 1, 0]}}") + LINEAR
            cell, found = self.solved(self.bar(), scene)
            self.assertEqual(cell["free"], free, second)
            self.assertAlmostEqual(found["u"] / (LOAD * LENGTH / EA), (GAMMA + BETA**2) / GAMMA, delta=1e-8)

    def test_frequencies(self):
        modal = """analyses: {run: {modal: {}}}
quantities: {f1: {frequency: {analysis: run}}, f2: {frequency: {analysis: run, which: 1}}}
"""
        mass = 3 + DENSITY * 2e-4 * LENGTH / 2
        stiffness = EA / LENGTH * GAMMA / (GAMMA + BETA**2)
        own = self.bar("-DMASS=0")
        f1 = self.solved(own, ONE + modal.replace(", f2: {frequency: {analysis: run, which: 1}}", ""))[1]["f1"]
        self.assertAlmostEqual(2 * math.pi * f1 / math.sqrt(stiffness / mass), 1, delta=1e-8)
        fixed = ONE.replace(GUIDED, "hold: all").replace("y: [0, 1, 0]}", "y: [0, 1, 0], warping: free}")
        fixed = fixed.replace("loads: {pull: {force: [100, 0, 0], on: b}}\n", "")
        found = self.solved(self.bar("-DMASS=0.25"), fixed + modal)[1]
        for name, k in (("f1", GAMMA / 2), ("f2", GAMMA / 2 + BETA**2 / 2)):
            expected = math.sqrt(EA * LENGTH * k / 0.25) / (2 * math.pi)
            self.assertAlmostEqual(found[name] / expected, 1, delta=1e-8, msg=name)

    def test_python(self):
        path = self.folder / "bar.py"
        path.write_text(PYTHON, encoding="utf-8")
        element = f"exec:'{sys.executable}' '{path}'"
        found = self.solved(element, ONE + LINEAR, 2, "scalars_py")[1]["u"]
        self.assertAlmostEqual(found / (LOAD * LENGTH / EA), (GAMMA + BETA**2) / GAMMA, delta=1e-10)
        done = run("element-test", "--element", element, env=environment(PYTHONPATH=str(EXAMPLES)))
        for family in ("features", "derivatives", "energy", "many"):
            self.assertIn(f"\u2714 {family}", done.stdout)

    @unittest.skipUnless(shutil.which("octave-cli"), "needs octave-cli")
    def test_octave(self):
        path = self.folder / "bar.m"
        path.write_text(OCTAVE, encoding="utf-8")
        element = f"exec:octave-cli -qf '{path}'"
        found = self.solved(element, ONE + LINEAR, 2, "scalars_m")[1]["u"]
        self.assertAlmostEqual(found / (LOAD * LENGTH / EA), (GAMMA + BETA**2) / GAMMA, delta=1e-10)
        done = run("element-test", "--element", element)
        for family in ("features", "derivatives", "energy", "many"):
            self.assertIn(f"\u2714 {family}", done.stdout)

    def test_analyses(self):
        timoshenko = compile_shared(EXAMPLES / "timoshenko.c", self.folder / "timoshenko.so")
        for scheme in ("alpha", "radau"):
            scene = FRAME.replace("INTEGRATOR", scheme)
            here = self.solved(self.ancf(), scene, 16, "ancf_slopes")[1]
            there = self.solved(timoshenko, scene, 16, "timoshenko")[1]
            self.assertEqual(len(here), 10)
            for name, value in there.items():
                self.assertAlmostEqual(here[name] / value, 1, delta=2e-3, msg=(scheme, name))

    def test_further_analyses(self):
        timoshenko = compile_shared(EXAMPLES / "timoshenko.c", self.folder / "timoshenko.so")
        for scene, count in ((CASES, 3), (PATH, 6)):
            here = self.solved(self.ancf(), scene, 16, "ancf_slopes")[1]
            there = self.solved(timoshenko, scene, 16, "timoshenko")[1]
            self.assertEqual(len(here), count)
            for name, value in there.items():
                self.assertAlmostEqual(here[name] / value, 1, delta=2e-3, msg=name)

    def test_restart(self):
        state = str(self.folder / "state.h5")
        for scheme in ("alpha", "radau"):
            whole = FRAME[:FRAME.index("analyses:")] + "analyses: {swing: " + FRAME.split("swing: ")[1].split("\n")[0].replace(
                "INTEGRATOR", scheme) + "}\nquantities: {u: {displacement: {analysis: swing, node: tip, component: uy}}}\n"
            expected = self.solved(self.ancf(), whole, 4, "ancf_slopes")[1]["u"]
            self.solved(self.ancf(), whole.replace("[0.05, 0.1]", "[0.05]"), 4, "ancf_slopes", "--save-state", state)
            found = self.solved(self.ancf(), whole, 4, "ancf_slopes", "--restart", state)[1]["u"]
            self.assertAlmostEqual(found / expected, 1, delta=1e-11, msg=scheme)

    def test_reduced(self):
        path = self.folder / "scene.yaml"
        path.write_text(CONSTANT + """analyses: {modes: {modal: {}}}
quantities: {f: {frequency: {analysis: modes, which: 2}}}
""", encoding="utf-8")
        for i, reduced in enumerate(("6", "6:tip")):
            told = self.answered("solve", "--scene", path, "--element", self.ancf(), "-f", "ancf_slopes", "-n", 4, "--matrices",
                                 self.folder / str(i), "--state-space", "--reduce", reduced).stderr
            errors = [float(e) for e in re.findall(r"natural frequencies: 6 compared, relative errors at most ([\d.e-]+)", told)]
            self.assertGreater(len(errors), 0, told)
            self.assertLess(max(errors), 1e-3, told)

    def test_locking(self):
        nu, E, A, I, L = 0.3, 2e11, 1e-2, 1e-8 * 1e4 / 12, 2
        G = E / (2 * (1 + nu))
        locked = (1 - 2 * nu) * (1 + nu) / (1 - nu) * L**3 / (3 * E * I) + L / (G * A)
        element = self.ancf()
        coarse, fine = (self.solved(element, LOCKING, n, "ancf_slopes:energy=continuum")[1] for n in (16, 32))
        self.assertAlmostEqual((4 * fine["uy"] - coarse["uy"]) / 3 / locked, 1, delta=1e-6)
        self.assertAlmostEqual(fine["rx"] / (L / (2 * G * I)), 1, delta=1e-9)
        coarse, fine = (self.solved(element, LOCKING, n, "ancf_slopes")[1] for n in (16, 32))
        exact = L**3 / (3 * E * I) + 1.2 * L / (G * A)
        self.assertAlmostEqual((4 * fine["uy"] - coarse["uy"]) / 3 / exact, 1, delta=1e-4)

    def test_rejected(self):
        element, motion = self.ancf(), """analyses: {run: {motion: {stations: [0.01], integrator: %s, step: 1e-3}}}
quantities: {u: {displacement: {analysis: run, node: b, component: ux}}}
"""
        for scheme in ("conserving", "explicit"):
            said = self.solved(element, ONE + motion % scheme, 1, "ancf_slopes", code=2)
            self.assertRegex(" ".join(said.split()), "additional unknowns.*; use (the integrator )?alpha or radau")
        warm = ONE.replace("loads: {", "loads: {t: {temperature: 10, on: ab}, ").replace("density", "expansion: 1e-5, density")
        said = self.solved(element, warm + LINEAR, 1, "ancf_slopes", code=2)
        self.assertRegex(" ".join(said.split()), "additional unknowns, such as ancf_slopes; use another formulation")

    def test_interface(self):
        done = self.answered("element-test", "--element", self.ancf())
        self.assertIn("interface requirements: SATISFIED", done.stdout)
        self.assertNotIn("wrong limit", done.stdout)
