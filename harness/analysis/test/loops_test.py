"""Feedback loops in small vibrations: poles, responses and state spaces compared with closed forms for masses and
springs."""
import csv
import json
import re

import numpy as np
import scipy.io
from scipy.linalg import expm

from harness.tools.kit.program import ProgramTest, run

# A base with prescribed motion, a cart of 2 kg and a tool of 0.5 kg, connected along x by bars of stiffness k1 and k2.
SCENE = """beamwork: 1
let: {k1: %(k1)s, k2: 200}
sections:
  a: {constants: {A: 1e-4, Iy: 1e-9, Iz: 1e-9, It: 1e-9}, young: k1*1e4, shear_modulus: 8e5}
  b: {constants: {A: 1e-4, Iy: 1e-9, Iz: 1e-9, It: 1e-9}, young: k2*1e4, shear_modulus: 8e5}
nodes:
  base: {at: [0, 0, 0], hold: [uy, uz, rx, ry, rz], drive: {ux: shake}}
  cart: {at: [1, 0, 0], hold: [uy, uz, rx, ry, rz], mass: 2}
  tool: {at: [2, 0, 0], hold: [uy, uz, rx, ry, rz], mass: 0.5}
members:
  one: {from: base, to: cart, section: a, y: [0, 1, 0], warping: free}
  two: {from: cart, to: tool, section: b, y: [0, 1, 0], warping: free}
springs:
  oil: {from: base, to: cart, damping: [c, 0, 0, 0, 0, 0]}
loads:
  motor: {force: [1, 0, 0], on: cart, %(time)s feedback: {node: %(at)s, component: ux, %(gains)s}}
motions:
  shake: {unit: m, path: [0, 1], value: [0, 0]%(still)s}
analyses:
%(analyses)s
quantities:
%(quantities)s
omit: [trapeze, wagner_moments, wagner_torque]
""".replace("let: {", "let: {c: %(c)s, ")
M, K2 = np.diag([2.0, 0.5]), 200.0
HERTZ = 0, 0.3, 1, 2, 5
POLES = "  poles: {modal: {damped: yes}}\n"
STEADY = "  steady: {harmonic: {frequencies: [0, 0.3, 1, 2, 5]}}\n"


def poles_read(count):
    return "".join(f"  f{i}: {{frequency: {{analysis: poles, which: {i}}}}}\n"
                   f"  d{i}: {{damping_ratio: {{analysis: poles, which: {i}, of: decay}}}}\n" for i in range(count))


def read(name, **keys):
    return "".join(f"  {name}_{part}: {{response: {{analysis: steady, part: {part}, take: curve, "
                   + ", ".join(f"{k}: {v}" for k, v in keys.items()) + "}}\n" for part in ("real", "imaginary"))


INPUTS = {"force": {"force": "tool", "along": "ux"}, "drive": {"drive": "shake"}, "reference": {"reference": "motor"}}


class Plant:
    """Equations of motion of the cart and the tool with the loop u = (Kp + Kd s + Ki/s)(r - S x - S0 q), where r is
    the reference, x are the displacements of cart and tool, S x is the measured one, and q is the motion of the
    base. S0 is -1 if the measurement is relative to the base, otherwise 0."""

    def __init__(self, k1=300.0, c=4.0, at="cart", kp=0.0, kd=0.0, ki=0.0, relative=False):
        self.K = np.array([[k1 + K2, -K2], [-K2, K2]])
        self.C = np.diag([c, 0.0])
        self.base = k1, c
        self.S = np.array([1.0, 0.0] if at == "cart" else [0.0, 1.0])
        self.S0 = -1.0 if relative else 0.0
        self.gains = kp, kd, ki

    def poles(self):
        kp, kd, ki = self.gains
        P = np.poly1d
        k = [[P([M[i, j], self.C[i, j], self.K[i, j]]) for j in range(2)] for i in range(2)]
        for j in range(2):
            for i in range(2):
                if ki != 0:
                    k[i][j] = k[i][j]*P([1, 0]) if i == 0 else k[i][j]
            k[0][j] = k[0][j] + self.S[j]*(P([kd, kp, ki]) if ki != 0 else P([kd, kp]))
        s = (k[0][0]*k[1][1] - k[0][1]*k[1][0]).roots
        return sorted((z for z in s if z.imag >= 0), key=abs)

    def response(self, hertz, what):
        s = 2j*np.pi*hertz
        kp, kd, ki = self.gains
        D = self.K + s*self.C + s*s*M
        own, gain = (s, (kp + kd*s)*s + ki) if ki != 0 else (1, kp + kd*s)
        A = np.zeros((3, 3), complex)
        A[:2, :2], A[:2, 2], A[2, :2], A[2, 2] = D, [-1, 0], gain*self.S, own
        z0 = self.base[0] + s*self.base[1]
        q = float(what == "drive")
        right = [z0*q, float(what == "force"), gain*((what == "reference") - self.S0*q)]
        x = np.linalg.solve(A, right)
        return x[0], x[1], z0*(q - x[0])


class Loops(ProgramTest):

    def solve(self, plant, analyses, quantities, at="cart", more="", code=0, time="", options=(), **gains):
        path = self.folder / "scene.yaml"
        words = {"proportional": gains.get("kp", 0), "derivative": gains.get("kd", 0), "integral": gains.get("ki", 0)}
        path.write_text(SCENE % {
            "k1": plant.base[0], "c": plant.base[1], "at": at + more, "time": time, "still": ", time: 0*t" if time else "", "analyses": analyses,
            "quantities": quantities, "gains": ", ".join(f"{k}: {v}" for k, v in words.items() if v)}, encoding="utf-8")
        words = "solve", "--scene", path, "-f", "collocation", "-n", 1
        if code:
            return run(*words)
        done = run(*words, *options, "--format", "json")
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout[:3000])
        return json.loads(done.stdout)

    def values(self, record):
        return {q["quantity"]: q for q in record["quantities"]}

    def test_poles(self):
        for at, gains in (("cart", {"kp": 150, "kd": 7}), ("cart", {"kp": 80, "kd": 12, "ki": 90}),
                          ("tool", {"kp": 3, "kd": 0.02, "ki": 2}), ("tool", {"kp": 60, "kd": 9}), ("cart", {"ki": 40}),
                          ("tool", {"kp": 40, "kd": 8, "ki": 100})):
            plant = Plant(at=at, **gains)
            expected = plant.poles()
            record = self.solve(plant, POLES, poles_read(len(expected)), at=at, **gains)
            found = self.values(record)
            for i, s in enumerate(expected):
                self.assertAlmostEqual(complex(-found[f"d{i}"]["value"], 2*np.pi*found[f"f{i}"]["value"])/s, 1, 9)
                self.assertEqual(found[f"d{i}"]["meaning"], "damped, loop closed")
            self.assertEqual("unstable: a damped mode grows" in record["cell"]["reason"],
                             max(s.real for s in expected) > 1e-9, (at, gains, expected))

    def test_single_mass(self):
        text = """beamwork: 1
sections: {bar: {constants: {A: 1e-4, Iy: 1e-9, Iz: 1e-9, It: 1e-9}, young: 1e6, shear_modulus: 8e5}}
nodes:
  cart: {at: [0, 0, 0], hold: [uy, uz, ry, rz], mass: 2, inertia: [0.1, 0.1, 0.1, 0, 0, 0]}
  pin: {at: [1, 0, 0], part_of: cart}
members: {bar: {from: cart, to: pin, section: bar, y: [0, 1, 0]}}
loads:
  motor: {force: [1, 0, 0], on: cart, feedback: {node: cart, component: ux, proportional: 52, derivative: 3%s}}
  spin: {moment: [1, 0, 0], on: cart, feedback: {node: pin, component: rx, proportional: 2, derivative: 0.05}}
analyses: {poles: {modal: {damped: yes}}}
quantities:
%s
omit: [trapeze, wagner_moments, wagner_torque]
"""
        for ki in (0, 48):
            expected = np.concatenate([np.roots([2, 3, 52, ki] if ki else [2, 3, 52]), np.roots([0.1, 0.05, 2])])
            expected = sorted((s for s in expected if s.imag >= 0), key=abs)
            (self.folder / "scene.yaml").write_text(
                text % (f", integral: {ki}" if ki else "", poles_read(len(expected))), encoding="utf-8")
            found = self.values(self.record("solve", "--scene", self.folder / "scene.yaml", "-f", "collocation", "-n", 1))
            for i, s in enumerate(expected):
                self.assertAlmostEqual(complex(-found[f"d{i}"]["value"], 2*np.pi*found[f"f{i}"]["value"])/s, 1, 11)

    def test_slow_integral(self):
        k, own = 2e7, np.array([[3e4, -3e4], [-3e4, 3e4]])
        rate = "  rate: {force: [1, 0, 0], on: tool, feedback: {node: tool, component: ux, derivative: -20}}\n"
        for ki, kd in ((1e-2, 0), (1e-4, 0), (1e-8, 0), (1e-2, -20), (1e-5, -20), (1e-8, -20)):
            text = f"""beamwork: 1
sections: {{bar: {{constants: {{A: 1e-4, Iy: 1e-9, Iz: 1e-9, It: 1e-9}}, young: 2e11, shear_modulus: 8e10}}}}
nodes:
  wall: {{at: [0, 0, 0], hold: all}}
  cart: {{at: [1, 0, 0], hold: [uy, uz, rx, ry, rz], mass: 1}}
  tool: {{at: [1, 0, 0], hold: [uy, uz, rx, ry, rz], mass: 2}}
members: {{bar: {{from: wall, to: cart, section: bar, y: [0, 1, 0]}}}}
springs: {{soft: {{from: cart, to: tool, stiffness: [3e4, 0, 0, 0, 0, 0], damping: [5, 0, 0, 0, 0, 0]}}}}
loads:
  slow: {{force: [1, 0, 0], on: cart, feedback: {{node: tool, component: ux, proportional: 1, integral: {ki}}}}}
{rate if kd else ""}analyses:
  poles: {{modal: {{damped: yes}}}}
{STEADY if kd else ""}quantities:
{poles_read(3)}{read("tool", node="tool", component="ux", force="tool", along="ux") if kd else ""}omit: [trapeze, wagner_moments, wagner_torque]
"""
            (self.folder / "scene.yaml").write_text(text, encoding="utf-8")
            done = run("solve", "--scene", self.folder / "scene.yaml", "-f", "collocation", "-n", 1, "--format", "json")
            A = np.zeros((4, 4))
            A[:2, 2:] = np.eye(2)
            A[2:, :2] = -np.diag([1, 0.5]) @ (own + [[k, 1], [0, 0]])
            A[2:, 2:] = -np.diag([1, 0.5]) @ (own*5/3e4 + np.diag([0, kd]))
            expected = [-ki/k] + sorted((s for s in np.linalg.eigvals(A) if s.imag > 0), key=abs)
            found = self.values(json.loads(done.stdout))
            for i, s in enumerate(expected):
                one = complex(-found[f"d{i}"]["value"], 2*np.pi*found[f"f{i}"]["value"])
                self.assertLess(abs(one/s - 1), 1e-7 if i == 0 else 1e-8, (ki, kd, i))
            self.assertEqual("a mode grows at 3.754" in done.stderr, kd < 0, done.stderr)

    def test_integral_of_drive(self):
        plant = Plant()
        (self.folder / "scene.yaml").write_text((SCENE % {
            "k1": 300, "c": 4, "at": "tool", "time": "", "still": "", "analyses": POLES + STEADY.replace("[0, ", "["),
            "quantities": poles_read(2) + read("wall", node="base", component="ux", of="reaction", drive="shake"),
            "gains": "proportional: 20, integral: 30"}).replace("on: cart", "on: base"), encoding="utf-8")
        record = self.record("solve", "--scene", self.folder / "scene.yaml", "-f", "collocation", "-n", 1)
        found = self.values(record)
        curves = {c["quantity"]: c["curve_value"] for c in record["curves"]}
        for i, s in enumerate(plant.poles()):
            self.assertAlmostEqual(complex(-found[f"d{i}"]["value"], 2*np.pi*found[f"f{i}"]["value"])/s, 1, 9)
        for i, hertz in enumerate(HERTZ[1:]):
            _, tool, wall = plant.response(hertz, "drive")
            wall += (20 + 30/(2j*np.pi*hertz))*tool
            self.assertLess(abs(complex(curves["wall_real"][i], curves["wall_imaginary"][i])/wall - 1), 1e-9)

    def test_equal_real_poles(self):
        loop = "  %(c)s: {force: [%(x)s], on: cart, feedback: {node: cart, component: u%(c)s, proportional: 5, derivative: %(kd)s, integral: 3}}\n"
        for kd in (3, 100, 200):
            text = """beamwork: 1
sections: {bar: {constants: {A: 1e-4, Iy: 1e-9, Iz: 1e-9, It: 2e-9}, young: 2e11, shear_modulus: 8e10}}
nodes:
  wall: {at: [0, 0, 0], hold: all}
  cart: {at: [1, 0, 0], mass: 2, inertia: [0.01, 0.02, 0.02, 0, 0, 0]}
members: {bar: {from: wall, to: cart, section: bar, y: [0, 1, 0]}}
loads:
""" + "".join(loop % {"c": c, "x": x, "kd": kd} for c, x in (("y", "0, 1, 0"), ("z", "0, 0, 1"))) + """analyses:
  poles: {modal: {damped: yes}}
quantities:
""" + poles_read(4) + "omit: [shear, trapeze, wagner_moments, wagner_torque]\n"
            (self.folder / "scene.yaml").write_text(text, encoding="utf-8")
            found = self.values(self.record("solve", "--scene", self.folder / "scene.yaml", "-f", "collocation", "-n", 1))
            A = np.zeros((5, 5))
            A[:2, 2:4] = np.eye(2)
            A[2:4, :2] = -np.diag([0.5, 50]) @ ([[2405, -1200], [-1200, 800]])
            A[2, 2], A[2, 4], A[4, 0] = -kd/2, -1.5, 1
            expected = sorted((s for s in np.linalg.eigvals(A) if s.imag >= 0), key=abs)
            for i in range(4):
                s = complex(-found[f"d{i}"]["value"], 2*np.pi*found[f"f{i}"]["value"])
                self.assertLess(abs(s/expected[i//2] - 1), 1e-7, (kd, i))

    def test_two_slow_integrals(self):
        for n, gains, slow in ((3, (1e-4, 1e-9), 2), (3, (1e-6, 400), 1), (250, (1e-3, 1e-7), 2), (250, (2, 1e-8), 2)):
            K = 1e4*(2*np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1))
            at, kp, kd, m, c = (0, n - 1), 5.0, 3.0, 0.4, 0.02
            lines = "".join(f"  n{i}: {{at: [{i + 1}, 0, 0], hold: [uy, uz, rx, ry, rz], mass: {m}}}\n" for i in range(n))
            bars = "".join(f"  b{i}: {{from: n{i - 1}, to: n{i}, section: bar, y: [0, 1, 0]}}\n" for i in range(n + 1))
            loads = "".join(f"  l{i}: {{force: [1, 0, 0], on: n{a}, feedback: {{node: n{a}, component: ux, proportional: {kp}, "
                            f"derivative: {kd}, integral: {ki!r}}}}}\n" for i, (a, ki) in enumerate(zip(at, gains)))
            (self.folder / "scene.yaml").write_text(f"""beamwork: 1
sections: {{bar: {{constants: {{A: 1e-4, Iy: 1e-9, Iz: 1e-9, It: 1e-9}}, young: 1e8, shear_modulus: 8e10}}}}
nodes:
  n-1: {{at: [0, 0, 0], hold: all}}
  n{n}: {{at: [{n + 1}, 0, 0], hold: all}}
{lines}members:
{bars}loads:
{loads}analyses:
  poles: {{modal: {{damped: yes, damping: {{mass: {c/m}}}}}}}
quantities:
{poles_read(5)}omit: [trapeze, wagner_moments, wagner_torque]
""", encoding="utf-8")
            found = self.values(self.record("solve", "--scene", self.folder / "scene.yaml", "-f", "collocation", "-n", 1))
            S, N = np.zeros((2, n)), 2*n + 2
            S[[0, 1], at] = 1
            A = np.zeros((N, N))
            A[:n, n:2*n] = np.eye(n)
            A[n:2*n, :n] = -(K + kp*S.T @ S)/m
            A[n:2*n, n:2*n] = -(c*np.eye(n) + kd*S.T @ S)/m
            A[n:2*n, 2*n:] = S.T*gains/m
            A[2*n:, :n] = -S
            # the slow poles follow from a 2 x 2 eigenvalue problem with the static stiffness at the carts, because the gains are
            # far below this stiffness
            C = S @ np.linalg.solve(K + kp*S.T @ S, S.T)
            static = sorted(np.linalg.eigvals(C*gains).real)[:slow]
            expected = sorted((s for s in np.linalg.eigvals(A) if s.imag >= 0), key=abs)[slow:5]
            for i, s in enumerate(sorted(-g for g in static)[::-1] + expected):
                one = complex(-found[f"d{i}"]["value"], 2*np.pi*found[f"f{i}"]["value"])
                self.assertLess(abs(one/s - 1), 1e-6, (n, gains, i, one, s))

    def test_responses(self):
        quantities = "".join(read(f"{node}_{name}", node=node, component="ux", **keys) for name, keys in INPUTS.items()
                             for node in ("cart", "tool")) + "".join(
            read(f"wall_{name}", node="base", component="ux", of="reaction", **keys) for name, keys in INPUTS.items())
        for at, relative, gains in (("cart", 0, {"kp": 150, "kd": 7}), ("cart", 1, {"kp": 80, "kd": 12, "ki": 90}),
                                    ("tool", 0, {"kp": 3, "kd": 0.02, "ki": 2}), ("tool", 1, {"kp": 9})):
            plant = Plant(at=at, relative=relative, **gains)
            for solution in (", solution: modal", ""):
                record = self.solve(plant, STEADY.replace("5]", "5]" + solution), quantities, at=at, more=", from: base" if relative else "", **gains)
                found = {c["quantity"]: c["curve_value"] for c in record["curves"]}
                for name in INPUTS:
                    for i, hertz in enumerate(HERTZ):
                        for node, expected in zip(("cart", "tool", "wall"), plant.response(hertz, name)):
                            key = f"{node}_{name}"
                            one = complex(found[f"{key}_real"][i], found[f"{key}_imaginary"][i])
                            self.assertLess(abs(one - expected), 1e-9*max(abs(expected), 1e-3), (gains, key, hertz))

    def test_largest(self):
        plant = Plant(kp=400, kd=1)
        most = max(abs(plant.response(f, "reference")[0]) for f in np.linspace(0.1, 20, 200001))
        for solution in ("", ", solution: modal"):
            record = self.solve(plant, f"  steady: {{harmonic: {{frequencies: [0.1, 20]{solution}}}}}\n",
                                "  most: {response: {analysis: steady, node: cart, component: ux, reference: motor, take: max}}\n",
                                kp=400, kd=1)
            self.assertAlmostEqual(self.values(record)["most"]["value"]/most, 1, 6)

    def test_modes_of_open_loop(self):
        text = """beamwork: 1
sections: {bar: {constants: {A: 1e-4, Iy: 1e-9, Iz: 1e-9, It: 1e-9}, young: 1e6, shear_modulus: 8e5}}
nodes:
  cart: {at: [0, 0, 0], hold: [uy, uz, rx, ry, rz], mass: 2}
  tool: {at: [1, 0, 0], hold: [uy, uz, rx, ry, rz], mass: 1}
members: {bar: {from: cart, to: tool, section: bar, y: [0, 1, 0]}}
springs: {s: {to: cart, stiffness: [STIFF, 0, 0, 0, 0, 0]}}
loads: {motor: {force: [1, 0, 0], on: cart, feedback: {node: cart, component: ux, proportional: 52, derivative: 3}}}
analyses: {A: {harmonic: {frequencies: [0.5, 1], KEYS}}}
quantities:
  re: {response: {analysis: A, node: tool, component: ux, force: cart, along: ux, part: real, at: 1}}
  im: {response: {analysis: A, node: tool, component: ux, force: cart, along: ux, part: imaginary, at: 1}}
omit: [trapeze, wagner_moments, wagner_torque]
"""
        s = 2j*np.pi
        D = np.array([[100 + 52 + 3*s + 2*s*s, -100], [-100, 100 + s*s]])
        expected = np.linalg.solve(D, [1, 0])[1]
        path = self.folder / "scene.yaml"
        for keys in ("solution: modal", "solution: modal, modes: 1", "solution: direct"):
            path.write_text(text.replace("STIFF", "0").replace("KEYS", keys), encoding="utf-8")
            found = self.values(self.record("solve", "--scene", path, "-f", "collocation", "-n", 1))
            self.assertLess(abs(complex(found["re"]["value"], found["im"]["value"]) - expected), 1e-9*abs(expected) + found["re"]["rounding"])

    def test_unstable(self):
        plant = Plant(at="tool", kp=60, kd=9)
        quantities = read("r", node="cart", component="ux", force="cart", along="ux")
        done = self.solve(plant, STEADY, quantities, at="tool", code=1, kp=60, kd=9)
        growth = max(s.real for s in plant.poles())
        self.assertIn(f"a mode grows at {growth:.4g} 1/s", done.stderr + done.stdout)
        self.assertIn("gains of feedback", re.sub(r"\s+", " ", done.stderr + done.stdout))
        opened = STEADY.replace("5]", "5], loops: open")
        record = self.solve(plant, opened, quantities, at="tool", kp=60, kd=9)
        self.assertAlmostEqual(record["curves"][0]["curve_value"][0], 1/300, 12)

    def test_state_space(self):
        for at, gains in (("cart", {"kp": 80, "kd": 12, "ki": 90}), ("tool", {"kp": 3, "kd": 0.02}), ("cart", {"ki": 40})):
            plant = Plant(at=at, **gains)
            quantities = read("tool", node="tool", component="ux", reference="motor") \
                + "  fast: {response: {analysis: steady, node: tool, component: ux, of: velocity, force: tool, take: curve}}\n" \
                + "  end: {displacement: {analysis: run, node: tool, component: ux}}\n"
            folder = self.folder / f"m{at}{len(gains)}"
            record = self.solve(plant, STEADY + "  run: {motion: {stations: [1.5], step: 0.005, integrator: radau}}\n", quantities,
                                at=at, time="time: 0.01,", options=("--matrices", folder, "--state-space"), **gains)
            A, B, C, D = (scipy.io.mmread(folder / "steady/state_space" / f"{k}.mtx").toarray() for k in "ABCD")
            self.assertIn("feedback loops closed", (folder / "steady/state_space/A.mtx").read_text(encoding="utf-8"))
            self.assertIn("feedback loops open", (folder / "steady/second_order/K.mtx").read_text(encoding="utf-8"))
            with open(folder / "inputs.csv", encoding="utf-8") as stream:
                kinds = [row["kind"] for row in csv.DictReader(stream)]
            reference = kinds.index("reference rate")
            for hertz in HERTZ[1:]:
                s = 2j*np.pi*hertz
                H = C @ np.linalg.solve(s*np.eye(len(A)) - A, B) + D
                x = plant.response(hertz, "reference")[1]
                self.assertAlmostEqual(s*H[0, reference]/x, 1, 9)
                self.assertAlmostEqual(H[1, kinds.index("force")]/(s*plant.response(hertz, "force")[1]), 1, 9)
            found = sorted((s for s in np.linalg.eigvals(A) if s.imag >= 0 and abs(s) > 1e-6), key=abs)
            for s, e in zip(found, plant.poles()):
                self.assertAlmostEqual(s/e, 1, 8)
            # the reference jumps at the start of the motion, so the derivative of the control error has no impulse
            step = np.zeros(len(A))
            step[np.flatnonzero(B[:, reference] == 1)[-1]] = 0.01
            self.assertAlmostEqual((C @ expm(1.5*A) @ step)[0]/self.values(record)["end"]["value"], 1, 6)

    def test_refused(self):
        plant = Plant()
        for analyses, quantities, words in (
                ("  plain: {modal: {}}\n", "  f: {frequency: {analysis: plain}}\n", "only in motions, harmonic analyses and damped modes (damped: yes)"),
                (STEADY.replace("5]", "5], loops: open"), read("r", node="cart", component="ux", reference="motor"),
                 "the feedback loop of load motor is open in"),
                (STEADY, read("r", node="cart", component="ux", reference="motor", force="cart"), "reference")):
            done = self.solve(plant, analyses, quantities, code=1, kp=10)
            self.assertIn(done.returncode, (1, 2), words)
            self.assertIn(words, re.sub(r"\s+", " ", done.stderr + done.stdout))
