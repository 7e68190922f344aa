"""Floors that are rigid in their planes: motions with every integrator, and analyses about instants of motions."""
import math
import re

import numpy
from scipy.integrate import solve_ivp

from harness.cli.test.constraints import ConstraintsCase
from harness.tools.kit.program import ROOT, run

FLOOR = """beamwork: 1
sections: {s: {rectangle: {width: 0.02, thickness: 0.03}, young: 2e9, shear_modulus: 0.8e9, density: 2000}}
nodes:
  o: {at: [9, 0, 0], hold: all}
  p: {at: [9, 1, 0], hold: all}
  M: {at: [0.3, 0.2, 3], hold: [uz, rx, ry], mass: 100, inertia: [10, 10, 20, 0, 0, 0]}
  A: {at: [0, 0, 3], hold: [uz, rx, ry], mass: 40}
  B: {at: [2, 0, 3.1], hold: [uz, rx, ry], mass: 70, inertia: [2, 2, 3, 0, 0, 0]}
  C: {at: [2, 1.5, 3], hold: [uz, rx, ry]}
members: {m: {from: o, to: p, section: s, y: [0, 0, 1]}}
springs:
  a: {to: A, stiffness: [2e4, 3e4, 0, 0, 0, 0]}
  b: {to: B, stiffness: [1e4, 2e4, 0, 0, 0, 0], damping: [50, 80, 0, 0, 0, 0]}
  c: {to: C, stiffness: [5e3, 0, 0, 0, 0, 0]}
  t: {to: B, stiffness: [0, 0, 0, 0, 0, 2000]}
constraints: {floor: {diaphragm: [A, B, C], master: M, normal: z}}
loads:
  f: {force: [300, 0, 0], on: C, time: sin(7*t)}
  g: {force: [0, -200, 0], on: C, time: 1}
  h: {moment: [0, 0, 50], on: A, time: cos(3*t)}
  k: {force: [0, 40, 0], on: A, feedback: {node: B, component: uy, proportional: 30, derivative: 4}}
analyses: {T: {motion: {stations: [1], integrator: HOW, start: {velocity: [1, -2, 0], spin: [0, 0, 12]}}}}
quantities:
  shift: {displacement: {analysis: T, node: A, component: ux}}
  sway: {displacement: {analysis: T, node: B, component: uy}}
  turn: {displacement: {analysis: T, node: A, component: rz}}
  speed: {rate: {analysis: T, node: B, component: ux}}
  spin: {rate: {analysis: T, node: C, component: rz}}
  gain: {rate: {analysis: T, node: C, component: uy, of: acceleration}}
  E: {energy: {analysis: T, of: energy}}
  K: {energy: {analysis: T, of: kinetic}}
  D: {energy: {analysis: T, of: drift}}
  push: {momentum: {analysis: T, component: py}}
  swirl: {momentum: {analysis: T, component: lz}}
  across: {relative: {analysis: T, node: B, from: A, component: ux}}
"""
MASTER = numpy.array([0.3, 0.2])
ARM = numpy.array([[0, 0], [0, 0], [2, 0], [2, 1.5]]) - MASTER
ARM[0] = 0
MASS, INERTIA = [100, 40, 70, 0], 23
SIZE = {"shift": 0.3, "sway": 0.3, "turn": 0.5, "speed": 10, "spin": 10, "gain": 100, "K": 6000, "push": 1000, "swirl": 500}
STIFF = numpy.array([[0, 0], [2e4, 3e4], [1e4, 2e4], [5e3, 0]])


def exact(time, stiff=1.0, gain=40, driven=None):
    """Returns the displacement, velocity and acceleration of each node, and the energies. The Dormand-Prince method of
    order 8 integrates the three coordinates of the floor. The coordinate `driven` is 2 t^3; the floor is then at
    rest at the start."""
    def rows(turn):
        across = numpy.array([[-math.sin(turn), -math.cos(turn)], [math.cos(turn), -math.sin(turn)]])
        return [(numpy.hstack([numpy.eye(2), (across @ a)[:, None]]), across @ numpy.array([-a[1], a[0]])) for a in ARM]

    def places(q):
        turned = numpy.array([[math.cos(q[2]), -math.sin(q[2])], [math.sin(q[2]), math.cos(q[2])]])
        return [q[:2] + turned @ a - a for a in ARM]

    def slope(t, y):
        q, v, at = y[:3], y[3:], places(y[:3])
        M, f = numpy.diag([0, 0, float(INERTIA)]), numpy.array([0, 0, 50 * math.cos(3 * t) - 2000 * stiff * q[2]])
        control = gain * (-30 * at[2][1] - 4 * (rows(q[2])[2][0] @ v)[1])
        for i, (B, inward) in enumerate(rows(q[2])):
            M += MASS[i] * B.T @ B
            F = -stiff * STIFF[i] * at[i] - MASS[i] * inward * v[2]**2
            if i == 1:
                F = F + [0, control]
            if i == 2:
                F = F - [50, 80] * (B @ v)
            if i == 3:
                F = F + [300 * math.sin(7 * t), -200]
            f += B.T @ F
        if driven is not None:
            f -= 12 * t * M[:, driven]
            M[driven], M[:, driven], M[driven, driven], f[driven] = 0, 0, 1, 12 * t
        return numpy.concatenate([v, numpy.linalg.solve(M, f)])

    start = [0] * 6 if driven is not None else [0, 0, 0, 1 - 12 * MASTER[1], -2 + 12 * MASTER[0], 12]
    y = solve_ivp(slope, [0, time], start, method="DOP853", rtol=1e-13, atol=1e-13).y[:, -1]
    q, v, a = y[:3], y[3:], slope(time, y)[3:]
    at, by = places(q), rows(q[2])
    speed = [B @ v for B, _ in by]
    where = [p + arm + MASTER for p, arm in zip(at, ARM)]
    return {"shift": at[1][0], "sway": at[2][1], "turn": q[2], "speed": speed[2][0], "spin": v[2],
            "gain": (by[3][0] @ a + by[3][1] * v[2]**2)[1],
            "K": INERTIA * v[2]**2 / 2 + sum(m * s @ s for m, s in zip(MASS, speed)) / 2,
            "push": sum(m * s[1] for m, s in zip(MASS, speed)),
            "swirl": INERTIA * v[2] + sum(m * (r[0] * s[1] - r[1] * s[0]) for m, r, s in zip(MASS, where, speed))}


COLUMNS = """beamwork: 1
sections:
  c: {rectangle: {width: 0.02, thickness: 0.03}, young: 2e9, shear_modulus: 0.8e9, density: 2000}
nodes:
  A0: {at: [0, 0, 0], hold: all}
  B0: {at: [0.9, 0, 0], hold: all}
  C0: {at: [0.9, 0.6, 0], hold: all}
  A: {at: [0, 0, 1]FOLLOWS, mass: 0.3}
  B: {at: [0.9, 0, 1]FOLLOWS, mass: 0.4, centre: [0.1, 0.05, 0.03], inertia: [0.01, 0.02, 0.015, 0, 0, 0]}
  C: {at: [0.9, 0.6, 1]FOLLOWS}
  M: {at: [0.4, 0.2, 1], hold: [uz, rx, ry], mass: 2, inertia: [0.1, 0.1, 0.2, 0, 0, 0]MORE}
members:
  a: {from: A0, to: A, section: c, y: [0, 1, 0], warping: fixedDAMPS}
  b: {from: B0, to: B, section: c, y: [0, 1, 0], warping: fixedDAMPS}
  c: {from: C0, to: C, section: c, y: [0, 1, 0], warping: fixedDAMPS}
springs: {t: {to: A, stiffness: [90, 80, 0, 0, 0, 5], damping: [3, 1, 0, 0, 0, 0.1]}, s: {from: A0, to: B, stiffness: [9, 8, 7, 0, 0, 0]}}
CONSTRAINTS
loads:
  f: {force: [60, 90, 0], on: A, time: cos(30*t)}
  g: {force: [20, -40, 0], on: B, time: 1}
  h: {distributed: [5, 3, 0], on: a}
  k: {moment: [0, 0, 9], on: C, time: 1}
MOTIONS
analyses:
  S: {static: {stations: [1]}}
  T: {motion: {stations: [UNTIL], integrator: HOW, about: S}}
  D: {modal: {about: T, time: UNTIL, damped: yes}}
  F: {modal: {about: T, time: UNTIL, damped: yes, axes: fixed}}
  H: {harmonic: {about: T, time: UNTIL, frequencies: [3]}}
  G: {harmonic: {about: T, time: UNTIL, frequencies: [3], axes_of: M}}
quantities:
  x: {displacement: {analysis: T, node: A, component: ux}}
  y: {displacement: {analysis: T, node: C, component: uy}}
  t: {displacement: {analysis: T, node: B, component: rz}}
  r: {reaction: {analysis: T, node: C0, component: uy}}
  s: {reaction: {analysis: T, node: A0, component: rz}}
  N: {internal: {analysis: T, member: b, end: from, resultant: My}}
  E: {energy: {analysis: T, of: energy}}
  W: {energy: {analysis: T, of: work}}
  P: {momentum: {analysis: T, component: py}}
  L: {momentum: {analysis: T, component: lz}}
  v: {rate: {analysis: T, node: B, component: uy}}
  w: {rate: {analysis: T, node: C, component: rz}}
  a: {rate: {analysis: T, node: B, component: ux, of: acceleration}}
  f: {frequency: {analysis: D}}
  g: {frequency: {analysis: D, which: 1}}
  j: {frequency: {analysis: F}}
  l: {frequency: {analysis: F, which: 1}}
  m: {response: {analysis: G, node: B, component: ux, force: C, along: uy}}
  h: {response: {analysis: H, node: B, component: uy, force: A, along: ux}}
"""


def turned(text, times):
    """Returns the scene with `times` cyclic permutations of its axes: x becomes y, y becomes z, z becomes x."""
    for _ in range(times):
        text = re.sub(r"\[([-\d.e]+), ([-\d.e]+), ([-\d.e]+)\]", r"[\3, \1, \2]", text)
        text = re.sub(r"\[([-\d.e]+), ([-\d.e]+), ([-\d.e]+), ([-\d.e]+), ([-\d.e]+), ([-\d.e]+)\]", r"[\3, \1, \2, \6, \4, \5]", text)
        text = re.sub(r"\b([urpl])([xyz])\b", lambda m: m[1] + "yzx"["xyz".index(m[2])], text)
        text = re.sub(r"normal: ([xyz])", lambda m: "normal: " + "yzx"["xyz".index(m[1])], text)
    return text


class DiaphragmsInTime(ConstraintsCase):

    def test_springs(self):
        wanted = exact(1)
        self.assertGreater(abs(wanted["turn"]), 0.3)
        for how, normal, close in (("radau, tolerance: 1e-10", 0, 1e-8), ("radau, tolerance: 1e-9", 1, 1e-7), ("alpha, step: 1e-4", 0, 3e-5),
                                   ("explicit, step: 1e-3", 0, 1e-11), ("explicit, step: 1e-3", 2, 1e-11)):
            found = self.values(turned(FLOOR.replace("HOW", how), normal), elements=1)
            for name, value in wanted.items():
                self.assertLess(abs(found[name] - value), close * SIZE[name], f"{how}: {name}")
            self.assertLess(abs(found["across"]), 1e-12, how)
            if "explicit" in how:
                self.assertLess(abs(found["D"]), 1e-10 * found["E"])

    def test_conserving(self):
        text = re.sub(r"  (k|gain): .*\n", "", FLOOR)
        wanted, errors = exact(1, gain=0), []
        for step in (2e-3, 1e-3):
            found = self.values(text.replace("HOW", f"conserving, step: {step}"), elements=1)
            errors.append([found[name] - value for name, value in wanted.items() if name != "gain"])
            self.assertLess(abs(found["D"]), 1e-13 * found["E"])
            self.assertLess(abs(found["across"]), 1e-12)
        for first, second in zip(*errors):
            self.assertAlmostEqual(first / second, 4, delta=0.1)
        free = re.sub(r"(?s)springs:.*constraints:", "springs: {z: {to: A, stiffness: [0, 0, 9e3, 0, 0, 0]}}\nconstraints:", text)
        free = re.sub(r"(?s)loads:.*analyses:", "analyses:", free).replace("hold: [uz, rx, ry], mass: 40", "hold: [rx, ry], mass: 40")
        free = free.replace("velocity: [1, -2, 0]", "velocity: [1, -2, 3]").replace("HOW", "conserving, step: 0.01")
        found = self.values(free.replace("quantities:", "quantities:\n  up: {rate: {analysis: T, node: A, component: uz}}\n  z: {displacement: {analysis: T, node: A, component: uz}}"), elements=1)
        self.assertAlmostEqual(found["push"], 210 * -2 + 12 * (100 * 0.3 + 70 * 2), delta=1e-9)
        self.assertAlmostEqual(found["swirl"], 12 * (23 + 100 * 0.13 + 70 * 4) - 2 * 170 - 20, delta=1e-9)
        self.assertAlmostEqual(found["up"]**2 * 40 + found["z"]**2 * 9e3, 360, delta=1e-9)
        self.assertLess(abs(found["D"]), 1e-12 * found["E"])

    def test_conserving_driven(self):
        for driven, name, unit in ((0, "ux", "m"), (2, "rz", "rad")):
            text = re.sub(r"  (k|gain): .*\n", "", FLOOR).replace(", start: {velocity: [1, -2, 0], spin: [0, 0, 12]}", "")
            text = text.replace("mass: 100", f"mass: 100, drive: {{{name}: go}}")
            text = text.replace("loads:", f"motions: {{go: {{unit: {unit}, time: 2*t^3}}}}\nloads:")
            wanted, errors = exact(1, gain=0, driven=driven), []
            for step in (1e-3, 5e-4):
                found = self.values(text.replace("HOW", f"conserving, step: {step}"), elements=1)
                errors.append([found[name] - value for name, value in wanted.items() if name != "gain"])
                self.assertLess(abs(found["D"]), 1e-12 * found["E"])
            for first, second in zip(*errors):
                if abs(second) > 1e-9:
                    self.assertAlmostEqual(first / second, 4, delta=0.2)

    def test_turns(self):
        soft = FLOOR.replace("HOW", "radau, tolerance: 1e-10")
        for of, to in (("[2e4, 3e4,", "[0.2, 0.3,"), ("[1e4, 2e4,", "[0.1, 0.2,"), ("[5e3,", "[0.05,"), ("2000]}", "0.02]}")):
            self.assertIn(of, soft)
            soft = soft.replace(of, to)
        wanted, found = exact(1, stiff=1e-5), self.values(soft, elements=1)
        self.assertGreater(abs(wanted["turn"]), 2 * math.pi)
        for name, value in wanted.items():
            self.assertLess(abs(found[name] - value), 1e-7 * max(SIZE[name], abs(value)), name)
        self.assertLess(abs(found["across"]), 1e-12)

    def test_small(self):
        text = (ROOT / "cases" / "examples" / "eccentric_storey.yaml").read_text()
        stiff, soft = (12 * 30e9 * math.pi * d**4 / 64 / 27 for d in (0.4, 0.25))
        ky, kc, kt = 2 * (stiff + soft), 6 * (soft - stiff), 26 * (stiff + soft) + 2 * 12e9 * math.pi * (0.4**4 + 0.25**4) / 96
        root = numpy.sqrt(numpy.array([50e3, 50e3 * 52 / 12]))
        square, modes = numpy.linalg.eigh(numpy.array([[ky, kc], [kc, kt]]) / numpy.outer(root, root))
        omega, speed = numpy.sqrt(square), 1e-4
        moved = modes @ (numpy.sin(omega * 0.25) / omega * (modes.T @ (root * [speed, 0]))) / root
        text = re.sub(r"(?s)truths:.*?\n\n", "", text[:text.index("quantities:")].replace("loads:\n  wind: {force: [0, force, 0], on: middle}\n", "").replace(
            "pushed: {linear: {}}\n  modes:  {modal: {}}", "T: {motion: {stations: [0.25], integrator: HOW, start: {velocity: [0, 1e-4, 0]}}}")) + """quantities:
  y: {displacement: {analysis: T, node: middle, component: uy}}
  b: {displacement: {analysis: T, node: b, component: uy}}
  t: {displacement: {analysis: T, node: a, component: rz}}
omit: [shear, trapeze, wagner_torque, wagner_moments]
"""
        text = text.replace("parameters:\n  force: {value: 200e3, unit: N, min: 1e3, max: 1e6, about: \"on the middle of the floor, along y\"}\n", "")
        text = text.replace("  shift: force*kt/(ky*kt - kc^2)\n  turn: -force*kc/(ky*kt - kc^2)\n", "")
        for how in ("radau, tolerance: 1e-10", "alpha, step: 2e-5", "explicit, step: 2e-3"):
            found = self.values(text.replace("HOW", how), elements=1)
            for name, value in {"y": moved[0], "t": moved[1], "b": moved[0] + 3 * moved[1]}.items():
                self.assertLess(abs(found[name] / value - 1), 1e-6, f"{how}: {name}")

    def test_driven(self):
        text = FLOOR.replace("hold: [uz, rx, ry], mass: 100, inertia: [10, 10, 20, 0, 0, 0]", "hold: [uz, rx, ry], mass: 100, inertia: [10, 10, 20, 0, 0, 0], drive: {ux: go, rz: twist}")
        text = text.replace("loads:", "motions: {go: {unit: m, time: 0.1*t^2}, twist: {unit: rad, time: 2*t^2}}\nloads:")
        text = text.replace(", start: {velocity: [1, -2, 0], spin: [0, 0, 12]}", "").replace("quantities:", "quantities:" + "".join(
            f"\n  r{n}: {{reaction: {{analysis: T, node: {n}, component: ux}}}}" for n in "MABC"))
        for how in ("radau, tolerance: 1e-9", "explicit, step: 1e-3"):
            found = self.values(text.replace("HOW", how), elements=1)
            self.assertAlmostEqual(found["turn"], 2, delta=1e-12)
            turn = numpy.array([[math.cos(2), -math.sin(2)], [math.sin(2), math.cos(2)]])
            at = [numpy.array([0.1, 0]) + turn @ a - a for a in ARM]
            self.assertAlmostEqual(found["shift"], at[1][0], delta=1e-12)
            twice = [0.2 + (turn @ (4 * numpy.array([-a[1], a[0]]) - 16 * a))[0] for a in ARM]
            speed = [0.2 + (turn @ (4 * numpy.array([-a[1], a[0]])))[0] for a in ARM]
            for i, n in enumerate("MABC"):
                wanted = MASS[i] * twice[i] + STIFF[i][0] * at[i][0] + (50 * speed[i] if n == "B" else 0) - (300 * math.sin(7) if n == "C" else 0)
                self.assertAlmostEqual(found["r" + n], wanted, delta=1e-6 * max(1, abs(wanted)), msg=how + n)
            self.assertLess(abs(found["D"]), 1e-6 * found["E"])

    def test_body(self):
        for tilts, how, until, damps, close in (
                (0, "radau, step: 0.002", 0.1, ", damping: 1e-4", 1e-8), (0, "alpha, step: 0.002, mass: consistent", 0.1, ", damping: 1e-4", 1e-8),
                (0, "alpha, step: 0.002, mass: lumped", 0.1, "", 1e-8), (0, "explicit, step: 5e-6, mass: lumped", 0.0005, "", 1e-8),
                (0, "conserving, step: 0.001", 0.1, "", 1e-7),                 (1, "radau, step: 0.002, mass: lumped", 0.1, ", damping: 1e-4", 1e-7), (1, "radau, step: 0.002", 0.1, "", 1e-7)):
            text = COLUMNS.replace("HOW", how).replace("UNTIL", str(until)).replace("DAMPS", damps + ("RELEASE" if tilts else "")).replace("MOTIONS\n", "").replace("MORE", "")
            if tilts:
                text = text.replace(", centre: [0.1, 0.05, 0.03], inertia: [0.01, 0.02, 0.015, 0, 0, 0]", "")
                text = text.replace("80, 0, 0, 0, 5]", "80, 0, 0, 0, 0]").replace("1, 0, 0, 0, 0.1]", "1, 0, 0, 0, 0]").replace("on: C, time: 1", "on: M, time: 1")
                text = text.replace("node: B, component: rz", "node: M, component: rz").replace("node: C, component: rz", "node: M, component: rz")
            if "conserving" in how:
                text = re.sub(r"  a: .*acceleration}}\n", "", text)
            if "explicit" in how:
                text = text.replace(", damping: [3, 1, 0, 0, 0, 0.1]", "")
            floor = text.replace("FOLLOWS", ", hold: [uz]" if tilts else ", hold: [uz, rx, ry]").replace("RELEASE", "")
            floor = floor.replace("CONSTRAINTS", "constraints: {floor: {diaphragm: [A, B, C], master: M, normal: z}}")
            body = text.replace("FOLLOWS", ", part_of: M").replace("RELEASE", ", release: {to: [rz, ry]}").replace("CONSTRAINTS\n", "")
            a, b = self.values(floor), self.values(body)
            for name, value in b.items():
                self.assertLess(abs(a[name] - value), close * abs(value) + 1e-14, f"{how} {tilts}: {name}")

    def test_ball_joints(self):
        k, spin, square = 3 * 2e6 / 27, 0.1, 8
        text = """beamwork: 1
sections: {c: {constants: {A: 1e-2, Iy: 1e-5, Iz: 1e-5, It: 1e-5}, young: 2e11, shear_modulus: 8e10}}
nodes:
""" + "".join(f"""  f{i}: {{at: [{x}, {y}, 0], hold: all}}
  t{i}: {{at: [{x}, {y}, 3], hold: [rx, ry]}}
""" for i, (x, y) in enumerate(((-2, -2), (2, -2), (2, 2), (-2, 2)))) + """  m: {at: [0, 0, 3], hold: [uz, rx, ry], mass: 10, inertia: [20, 20, 30, 0, 0, 0]}
members:
""" + "".join(f"  c{i}: {{from: f{i}, to: t{i}, section: c, y: [1, 0, 0], release: RELEASE}}\n" for i in range(4)) + """constraints: {floor: {diaphragm: [t0, t1, t2, t3], master: m, normal: z}}
analyses: {T: {motion: {stations: [0.005], integrator: HOW, start: {spin: [0, 0, SPIN]}}}}
quantities:
  turn: {displacement: {analysis: T, node: m, component: rz}}
  spin: {rate: {analysis: T, node: m, component: rz}}
  way: {displacement: {analysis: T, node: t2, component: ux}}
  E: {energy: {analysis: T, of: energy}}
omit: [trapeze, wagner_moments, wagner_torque, shear]
"""
        omega = math.sqrt(4 * k * square / 30)
        turn = spin / omega * math.sin(0.005 * omega)
        wanted = {"turn": turn, "spin": spin * math.cos(0.005 * omega), "way": 2 * (math.cos(turn) - 1 - math.sin(turn)), "E": 15 * spin**2}
        for how, close in (("radau, step: 1e-4", 1e-5), ("alpha, step: 2e-5, rho: 0.9", 3e-4), ("conserving, step: 5e-5", 3e-4)):
            one = text.replace("HOW", how)
            ball, universal = one.replace("RELEASE", "{to: [rx, ry, rz]}"), one.replace("RELEASE", "{from: [rx], to: [ry, rz]}")
            found = self.values(ball.replace("SPIN", str(spin)))
            for name, value in wanted.items():
                self.assertLess(abs(found[name] / value - 1), close, f"{how}: {name}")
            self.same(ball.replace("SPIN", "3"), universal.replace("SPIN", "3"), 1e-7)

    def test_two_floors(self):
        text = COLUMNS.replace("MORE", "").replace("MOTIONS\n", "").replace("DAMPS", "").replace("HOW", "radau, step: 0.002").replace("UNTIL", "0.1")
        text = text.replace("  M: {at: [0.4, 0.2, 1]", """  D: {at: [0, 0, 2]HIGH}
  E: {at: [0.9, 0, 2]HIGH}
  F: {at: [0.9, 0.6, 2]HIGH}
  N: {at: [0.1, 0.2, 2], hold: [uz, rx, ry], mass: 2, inertia: [0.1, 0.1, 0.2, 0, 0, 0]}
  M: {at: [0.4, 0.2, 1]""").replace("members:", """members:
  d: {from: A, to: D, section: c, y: [0, 1, 0], warping: fixed}
  e: {from: B, to: E, section: c, y: [0, 1, 0], warping: fixed}
  f: {from: C, to: F, section: c, y: [0, 1, 0], warping: fixed}""").replace("about: S", "start: {velocity: [0, 1, 0], spin: [0, 0, 3]}")
        text = text.replace("quantities:", "quantities:\n  u: {displacement: {analysis: T, node: E, component: uy}}")
        floor = text.replace("FOLLOWS", ", hold: [uz, rx, ry]").replace("HIGH", ", hold: [uz, rx, ry]").replace(
            "CONSTRAINTS", "constraints: {floor: {diaphragm: [A, B, C], master: M, normal: z}, high: {diaphragm: [D, E, F], master: N, normal: z}}")
        body = text.replace("FOLLOWS", ", part_of: M").replace("HIGH", ", part_of: N").replace("CONSTRAINTS\n", "")
        a, b = self.values(floor), self.values(body)
        self.assertGreater(abs(b["u"]), 0.01)
        for name, value in b.items():
            self.assertLess(abs(a[name] - value), 1e-8 * abs(value), name)

    def test_rotating(self):
        text = re.sub(r"springs: .*\n", "", COLUMNS.replace("MORE", "").replace("DAMPS", "").replace("UNTIL", "0.02"))
        text = re.sub(r"\n  [fghkrs]: \{(force|moment|distributed|reaction).*", "", text).replace("loads:\n", "")
        text = text.replace("S: {static: {stations: [1]}}", "S: {rotation: {omega: [0, 0, 4], stations: [1]}}").replace("hold: all", "part_of: H")
        text = text.replace("MOTIONS", "motions: {turn: {unit: rad, path: [0, 1], value: [0, 0], time: 4*t}}")
        text = text.replace("nodes:", "nodes:\n  H: {at: [0, 0, 0], hold: [ux, uy, uz, rx, ry], drive: {rz: turn}}")
        for how, close in (("radau, step: 0.002", 1e-8), ("alpha, step: 0.002, mass: lumped", 1e-8), ("explicit, step: 5e-6", 1e-8), ("conserving, step: 0.001", 1e-5)):
            one = re.sub(r"  a: .*acceleration}}\n", "", text.replace("HOW", how))
            floor = one.replace("FOLLOWS", ", hold: [uz, rx, ry]").replace("CONSTRAINTS", "constraints: {floor: {diaphragm: [A, B, C], master: M, normal: z}}")
            a, b = self.values(floor), self.values(one.replace("FOLLOWS", ", part_of: M").replace("CONSTRAINTS\n", ""))
            self.assertGreater(len(b), 10)
            for name, value in b.items():
                if name != "W":
                    self.assertLess(abs(a[name] - value), close * abs(value), f"{how}: {name}")

    def test_rejected(self):
        path, floor = self.folder / "floor.yaml", re.sub(r"  k: .*\n", "", FLOOR)
        for text, words in ((floor.replace("HOW", "conserving, step: 1e-3").replace("A: {at: [0, 0, 3], hold: [uz, rx, ry]", "A: {at: [0, 0, 3], hold: [uz]").replace("to: A, stiffness", "from: A, to: o, stiffness").replace("  gain: ", "#"),
                             "the integrator conserving does not support nodes of a diaphragm that tilt (node A); use alpha or radau"),
                            (floor.replace("HOW", "radau").replace("spin: [0, 0, 12]", "spin: [1, 0, 0]"),
                             "node B: the initial velocity violates a constraint with another node")):
            path.write_text(text)
            done = run("solve", "--scene", path, "-f", "collocation", "-n", "1")
            self.assertIn(words, done.stdout + done.stderr)
