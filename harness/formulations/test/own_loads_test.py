"""Loads along elements that compute the motion of their sections themselves: exact displacements of nodes, equilibrium
of reactions and loads, buckling under distributed loads, and the checks of the interface."""
import json
import shutil
import sys
import unittest

from harness.cli.test.plugin import EXAMPLES
from harness.formulations.test.speaker import Speaker
from harness.tools.kit.program import broken, environment

WITH_MODULES = environment(PYTHONPATH=str(EXAMPLES))
YOUNG, WIDTH, HEIGHT, LENGTH = 2e9, 0.02, 0.01, 1.5
EI = YOUNG * WIDTH * HEIGHT**3 / 12
MEMBER = f"""beamwork: 1
sections: {{s: {{rectangle: {{width: {WIDTH}, thickness: {HEIGHT}}}, young: {YOUNG}, shear_modulus: 8e8, density: 1000}}}}
nodes: {{a: {{at: [0, 0, 0], hold: all}}, b: {{at: [{LENGTH}, 0, 0]}}}}
members: {{ab: {{from: a, to: b, section: s, y: [0, 1, 0]}}}}
omit: [warping, shear, trapeze, wagner_torque, wagner_moments]
"""
LINEAR = MEMBER + """loads: {%s}
analyses: {run: {linear: {}}}
quantities:
  u: {displacement: {analysis: run, node: b, component: uy}}
  t: {displacement: {analysis: run, node: b, component: rz}}
  F: {reaction: {analysis: run, node: a, component: uy}}
  M: {reaction: {analysis: run, node: a, component: rz}}
  inside: {internal: {analysis: run, member: ab, where: 0.5, resultant: Mz}}
"""
BENT = MEMBER + """loads:
  q: {distributed: [0.2, 0.9, 0.5], on: ab, at: [0, 0.01, 0.02]}
  p: {distributed: [0.1, -0.8, 1], on: ab, follower: yes}
  m: {distributed_moment: [0.01, 0.1, 0.2], on: ab}
analyses: {run: {static: {stations: [0.5, 1]}}}
quantities:
  x: {displacement: {analysis: run, node: b, component: ux}}
  y: {displacement: {analysis: run, node: b, component: uy}}
  F$c: {for: {c: [x, y, z]}, reaction: {analysis: run, node: a, component: u$c}}
"""
WEIGHT = MEMBER.replace("hold: all}, b", "hold: all}, b") + """loads: {w: {distributed: [-1, 0, 0], on: ab}}
analyses: {run: {buckling: {}}}
quantities: {factor: {critical_factor: {analysis: run}}}
"""
OCTAVE = (("function A = turned_back(R)", """function [place, axes] = between(kind, at, r, u, R, a)
s = reshape(at, 1, 1, []);
q = s .^ 2 .* (3 - 2 * s);
[Rp, Rq] = deal(reshape(R(:, :, 1, :), 3, 3, []), reshape(R(:, :, 2, :), 3, 3, []));
place = (1 - q) .* r(:, 1, :) + q .* r(:, 2, :) + ...
        kind.length * s .* (1 - s) .* ((1 - s) .* Rp(:, 1, :) - s .* Rq(:, 1, :));
place = reshape(place, 3, []);
T = beamwork_element('product', beamwork_element('transpose', Rp), Rq);
psi = reshape(at .* beamwork_element('rotation_vector', T), 3, 1, []);
t = sqrt(sum(psi .* psi, 1));
o = 0 * t;
spin = [o, -psi(3, 1, :), psi(2, 1, :); psi(3, 1, :), o, -psi(1, 1, :); -psi(2, 1, :), psi(1, 1, :), o];
turn = full(eye(3)) + beamwork_element('sinc', t) .* spin + ...
       beamwork_element('sinc', t / 2) .^ 2 / 2 .* beamwork_element('product', spin, spin);
axes = beamwork_element('product', Rp, turn);
end

function A = turned_back(R)"""), ("'strain', @strain,", "'strain', @strain, 'line', @between,"),
          ("fileparts(mfilename('fullpath'))", f"'{EXAMPLES}'"))


class OwnLoads(Speaker):

    def python(self, before="", after=""):
        text = (EXAMPLES / "own_loads.py").read_text(encoding="utf-8")
        self.assertIn(before, text)
        path = self.folder / "mine.py"
        path.write_text(text.replace(before, after, 1), encoding="utf-8")
        return f"exec:'{sys.executable}' '{path}'"

    def solved(self, text, n=1, name="own_loads", element=None, chosen=None):
        path = self.folder / "scene.yaml"
        path.write_text(text, encoding="utf-8")
        element = element or f"exec:'{sys.executable}' '{EXAMPLES / name}.py'"
        record = json.loads(self.answered("solve", "--scene", path, "--element", element, "-f", chosen or f"{name}_py", "-n", n,
                                          "--format", "json", env=WITH_MODULES).stdout)
        return record, {q["quantity"]: q["value"] for q in record["quantities"]}

    def test_exact(self):
        q, a, l = 0.7, 0.4 * LENGTH, LENGTH
        for load, u, t, force, moment in (
                (f"q: {{distributed: [0, {q}, 0], on: ab}}", q * l**4 / 8, q * l**3 / 6, q * l, q * l * l / 2),
                (f"q: {{distributed: [0, {q}, 0], on: ab, from: 0, to: 0.4}}", q * a**3 * (4 * l - a) / 24, q * a**3 / 6,
                 q * a, q * a * a / 2),
                (f"q: {{distributed: [0, 0, 0], to_value: [0, {q}, 0], on: ab}}", 11 * q * l**4 / 120, q * l**3 / 8, q * l / 2,
                 q * l * l / 3)):
            _, found = self.solved(LINEAR % load)
            for name, value in (("u", u / EI), ("t", t / EI), ("F", -force), ("M", -moment)):
                self.assertLessEqual(abs(found[name] / value - 1), 1e-9, (load, name))

    def test_line_through_the_nodes(self):
        """If the line between the nodes is straight, half of the load acts on each node, so one element must have
        the displacement u = q l^4 (1/8 + 1/24)/(E I)."""
        element = self.python("slope = s * s * (3 - 2 * s), kind.length * s * (1 - s)",
                              "slope = s, 0 * s")
        q, l = 0.7, LENGTH
        _, found = self.solved(LINEAR % f"q: {{distributed: [0, {q}, 0], on: ab}}", element=element)
        for name, value in (("u", q * l**4 / (6 * EI)), ("F", -q * l), ("M", -q * l * l / 2),
                            ("inside", q * l * l / 8)):
            self.assertLessEqual(abs(found[name] / value - 1), 1e-9, name)

    def test_large_displacements(self):
        (here, own), (there, common) = (self.solved(BENT, 8, name) for name in ("own_loads", "timoshenko"))
        self.assertGreater(abs(own["y"]), 0.08)
        for name in "xy":
            self.assertLessEqual(abs(own[name] - common[name]), 2e-3 * LENGTH, name)
        self.assertLessEqual(here["cell"]["iterations"], there["cell"]["iterations"] + 2)
        dead = self.solved("\n".join(line for line in BENT.split("\n") if not line.startswith("  p:")), 4)[1]
        for name, value in (("Fx", -0.2), ("Fy", -0.9), ("Fz", -0.5)):
            self.assertLessEqual(abs(dead[name] - value * LENGTH), 1e-8, name)

    def test_buckling_under_its_weight(self):
        """The critical load must be that of Greenhill, q l^3/(E I) = 7.8373474, about the weak axis, within 5e-3."""
        found = self.solved(WEIGHT, 16)[1]["factor"]
        weak = min(EI, YOUNG * HEIGHT * WIDTH**3 / 12)
        self.assertLessEqual(abs(found / (7.8373474 * weak / LENGTH**3) - 1), 5e-3)

    @unittest.skipUnless(shutil.which("octave-cli"), "needs octave-cli")
    def test_octave(self):
        text = (EXAMPLES / "timoshenko.m").read_text(encoding="utf-8")
        for before, after in OCTAVE:
            self.assertIn(before, text)
            text = text.replace(before, after)
        path = self.folder / "mine.m"
        path.write_text(text, encoding="utf-8")
        element = f"exec:octave-cli -qf '{path}'"
        for scene in BENT, LINEAR % "q: {distributed: [0, 0.7, 0], on: ab, from: 0, to: 0.4}":
            expected, found = self.solved(scene, 2)[1], self.solved(scene, 2, "timoshenko", element, "timoshenko_m")[1]
            for name, value in expected.items():
                self.assertLessEqual(abs(found[name] / value - 1), 1e-8, name)
        out = self.answered("element-test", "--element", element, "--format", "json").stdout
        made = [c["outcome"] for c in json.loads(out)["claims"] if c["family"] == "along"]
        self.assertEqual(made, ["holds"] * 5 + ["not claimed"] * 2)

    def contract(self, element, code=0):
        out = self.answered("element-test", "own_loads_py", "--element", element, "--format", "json", code=code,
                            env=WITH_MODULES).stdout
        record = json.loads(out)
        return [c["outcome"] for c in record["claims"] if c["family"] == "along"], " ".join(broken(record))

    def test_contract(self):
        made, wrong = self.contract(self.python())
        self.assertEqual((made, wrong), (["holds"] * 5 + ["not claimed"] * 2, ""))
        for before, after, told in (
                ("(1 - q) * r[:, 0]", "0.9 * (1 - q) * r[:, 0]", "nodal forces have the sum"),
                ("psi = s * ", "psi = 0.1 + s * ", "R at 0 of the length differs from R of the nodes")):
            self.assertIn(told, self.contract(self.python(before, after), code=1)[1])

    def test_refused(self):
        path = self.folder / "scene.yaml"
        path.write_text(LINEAR % "q: {distributed: [0, 1, 0], on: ab}", encoding="utf-8")
        for before, after, told in (("return place, ", "return place[:, :2], ", "line, for place, returned (N, 2)"),
                                    ("return place, ", "return abs(place), ", "line is not analytic")):
            self.refused(1, told, "solve", "--scene", path, "-n", 1, "-f", "own_loads_py", "--element",
                         self.python(before, after), env=WITH_MODULES, silent=False)
        self.refuse(self.speaker(first="said['line'] = 'yes'"), "key 'line' of its first line", "give true or false")
