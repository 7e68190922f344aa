"""Harmonic responses in rotating axes, compared with the closed form of a mass on springs, and with a motion."""
import numpy as np
import scipy.io

from harness.tools.kit.program import ProgramTest, run

W, M, K, C = 6.0, 2.0, (500.0, 300.0), (3.0, 1.0)
SPRUNG = """beamwork: 1
sections: {s: {rectangle: {width: 0.02, thickness: 0.03}, young: 2e9, shear_modulus: 0.8e9, density: 1e-9}}
nodes:
  o: {at: [0, 0, 1], hold: all}
  p: {at: [1, 0, 1], hold: all}
  base: {at: [0.1, 0, 0], hold: [uy, uz, rx, ry, rz], drive: {ux: shake}}
  m: {at: [0.1, 0, 0], hold: [uz, rx, ry, rz], mass: 2}
members: {n: {from: o, to: p, section: s, y: [0, 0, 1]}}
springs: {s: {from: base, to: m, stiffness: [500, 300, 0, 0, 0, 0], damping: [3, 1, 0, 0, 0, 0]}}
motions: {shake: {unit: m, path: [0, 1], value: [0, 0]}}
LOADS
analyses:
  spun: {ABOUT}
  A: {harmonic: {frequencies: [0, 0.5, 1.3, 4], about: spunKEYS}}
quantities:
"""
FREQUENCIES = 0, 0.5, 1.3, 4
INPUTS = {"fx": "force: m, along: ux", "fy": "force: m, along: uy", "d": "drive: shake"}
OUTPUTS = {"x": "node: m, component: ux", "y": "node: m, component: uy", "v": "node: m, component: uy, of: velocity",
           "r": "node: base, component: ux, of: reaction"}
PATH = "rotation: {omega: [0, 0, 6], stations: [1]}"


def quantities():
    return "".join(f"  {o}_{i}_{part}: {{response: {{analysis: A, {what}, {by}, part: {part}, take: curve}}}}\n"
                   for i, by in INPUTS.items() for o, what in OUTPUTS.items() for part in ("real", "imaginary"))


def expected(hertz, what, gain=0.0):
    s = 2j*np.pi*hertz
    D = np.array([[M*(s*s - W*W) + C[0]*s + K[0], -2*M*W*s], [2*M*W*s + gain, M*(s*s - W*W) + C[1]*s + K[1]]])
    spring = K[0] + C[0]*s
    f = {"fx": [1, 0], "fy": [0, 1], "d": [spring, 0]}[what]
    x = np.linalg.solve(D, f)
    return x[0], x[1], s*x[1], spring*((what == "d") - x[0])


class TurningResponses(ProgramTest):
    def curves(self, text):
        path = self.folder / "scene.yaml"
        path.write_text(text, encoding="utf-8")
        return {c["quantity"]: c["curve_value"] for c in self.record("solve", "--scene", path, "-f", "collocation", "-n", 1)["curves"]}

    def test_closed_form(self):
        for about, gain in ((PATH, 0), (PATH, 20)):
            loads = "loads: {l: {force: [0, 1, 0], on: m, path: [0, 1], factor: [0, 0], feedback: {node: m, component: ux, proportional: 20}}}" if gain else ""
            found = self.curves((SPRUNG + quantities()).replace("ABOUT", about).replace("KEYS", "").replace("LOADS\n", loads + "\n" if loads else ""))
            for i, hertz in enumerate(FREQUENCIES):
                for what in INPUTS:
                    for name, value in zip(OUTPUTS, expected(hertz, what, gain)):
                        one = complex(found[f"{name}_{what}_real"][i], found[f"{name}_{what}_imaginary"][i])
                        self.assertLess(abs(one - value), 1e-9*max(abs(value), 1e-3), (about, name, what, hertz))

    def test_largest(self):
        text = (SPRUNG + "  most: {response: {analysis: A, node: m, component: uy, force: m, along: ux, take: max}}\n").replace("ABOUT", PATH)
        path = self.folder / "scene.yaml"
        path.write_text(text.replace("KEYS", "").replace("LOADS\n", ""), encoding="utf-8")
        found, = self.record("solve", "--scene", path, "-f", "collocation", "-n", 1)["quantities"]
        most = max(abs(expected(f, "fx")[1]) for f in np.linspace(0, 4, 400001))
        self.assertAlmostEqual(found["value"] / most, 1, 7)

    def test_state_space(self):
        text = SPRUNG + "  y: {response: {analysis: A, node: m, component: uy, force: m, along: ux, at: 4}}\n"
        path, to = self.folder / "scene.yaml", self.folder / "matrices"
        path.write_text(text.replace("ABOUT", PATH).replace("KEYS", "").replace("LOADS\n", ""), encoding="utf-8")
        self.answered("solve", "--scene", path, "-f", "collocation", "-n", 1, "--matrices", to, "--state-space")
        A, B, C, D = (scipy.io.mmread(to / "A" / "state_space" / f"{name}.mtx") for name in "ABCD")
        A, B, C, D = (x.toarray() if hasattr(x, "toarray") else x for x in (A, B, C, D))
        for hertz in FREQUENCIES:
            H = C @ np.linalg.solve(2j*np.pi*hertz*np.eye(len(A)) - A, B) + D
            self.assertAlmostEqual(H[0, 0] / expected(hertz, "fx")[1] if hertz else 1, 1, 9)

    def test_motion(self):
        text = """beamwork: 1
sections: {s: {rectangle: {width: 0.01, thickness: 0.02}, young: 70e9, shear_modulus: 26e9, density: 2700}}
nodes:
  hub: {at: [0, 0, 0], hold: [ux, uy, uz, rx, ry], drive: {rz: turn}}
  tip: {at: [0.8, 0.1, 0], mass: 0.3, centre: [0.02, 0, 0.01], inertia: [0.001, 0.001, 0.002, 0, 0, 0]}
members: {arm: {from: hub, to: tip, section: s, y: [0, 0, 1], damping: 1e-4, warping: fixed}}
motions: {turn: {unit: rad, path: [0, 1], value: [0, 0], time: 25*t}}
analyses:
  spun: {rotation: {omega: [0, 0, 25], stations: [1]}}
  run: {motion: {stations: [0.002], about: spun, step: 0.0005, integrator: radau, mass: lumped}}
  A: {harmonic: {frequencies: [2, 8, 30], about: spun}}
  B: {harmonic: {frequencies: [2, 8, 30], about: run, time: 0, axes_of: hub}}
quantities:
"""
        for name in "AB":
            for i, (along, component) in enumerate((("ux", "uy"), ("uy", "uy"), ("uz", "uz"), ("uz", "uy"))):
                for part in ("real", "imaginary"):
                    text += f"  {name}{i}_{part}: {{response: {{analysis: {name}, node: tip, component: {component}, force: tip, along: {along}, part: {part}, take: curve}}}}\n"
        found = self.curves(text.replace("beamwork: 1\n", "beamwork: 1\nmass: lumped\n"))
        for i in range(4):
            a, b = (np.array(found[f"{n}{i}_real"]) + 1j*np.array(found[f"{n}{i}_imaginary"]) for n in "AB")
            self.assertLess(np.max(abs(a - b)), 1e-6*np.max(abs(b)), i)

    def test_refused(self):
        path = self.folder / "scene.yaml"
        for keys, omega, quantity, words in (
                (", solution: modal", 6, "force: m, along: ux", "modes without damping do not solve small motions in rotating axes (spun); remove 'solution'"),
                (", damping: {ratio: 0.1}", 6, "force: m, along: ux", "remove the damping ratios"),
                (", damping: {mass: 1}", 6, "force: m, along: ux", "damping in proportion to the mass acts in fixed axes"),
                ("", 6, "unbalance: m, about: rz", "an unbalance rotates with the frequency in fixed axes"),
                ("", 40, "force: m, along: ux", "reduce the angular velocity, or the damping, which rotates with the structure")):
            text = SPRUNG.replace("ABOUT", PATH.replace("6", str(omega))).replace("KEYS", keys).replace("LOADS\n", "")
            path.write_text(text + f"  x: {{response: {{analysis: A, node: m, component: ux, {quantity}, at: 4}}}}\n", encoding="utf-8")
            done = run("solve", "--scene", path, "-f", "collocation", "-n", 1)
            self.assertIn(words, " ".join((done.stdout + done.stderr).split()))
