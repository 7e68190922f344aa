"""Harmonic responses compared with closed forms, and inputs that a harmonic analysis rejects."""
import cmath
import json
import math
import unittest

import numpy

from harness.tools.kit.program import ProgramTest, run

BEAM = """beamwork: 1
let: {E: 210e9, b: 0.02, h: 0.01, L: 1, c: 15}
sections: {s: {constants: {A: b*h, Iy: 1e-4, Iz: b*h^3/12, It: 1e-6}, young: E, shear_modulus: 81e9, density: 7800}}
nodes:
  root: {at: [0, 0, 0], %s}
  tip: {at: [L, 0, 0]}
members: {m: {from: root, to: tip, section: s, y: [0, 1, 0]}}
springs: {d: {to: tip, damping: [0, c, 0, 0, 0, 0]}}
%s
analyses:
%s
  steady: {harmonic: {frequencies: [5, 8, 20, 60]%s}}
quantities:
%s
omit: [shear, rotary_inertia, trapeze, wagner_moments, wagner_torque]
"""
EI, MU, C = 210e9*0.02*0.01**3/12, 7800*0.02*0.01, 15
FREQUENCIES = 5, 8, 20, 60
PARTS = "real", "imaginary"


def reading(name, **keys):
    return "".join(f"  {name}_{part}: {{response: {{analysis: steady, node: tip, part: {part}, take: curve, "
                   + ", ".join(f"{k}: {v}" for k, v in keys.items()) + "}}\n" for part in PARTS)


FORCED = reading("u", component="uy", force="tip", along="uy") + reading("t", component="rz", force="tip", along="uy")
SHAKEN = reading("u", component="uy", drive="shake") + reading("r", component="uy", drive="shake", **{"from": "root"})


def beam(hertz, tension, length, by_mass=0.0, by_stiffness=0.0):
    """Solves EI v'''' - N v'' - mu w^2 v = 0 with four exponentials. Returns the exponents and EI, which is complex
    with damping. Proportional damping replaces EI by EI (1 + i w b) and mu by mu (1 - i a/w)."""
    w = 2*math.pi*hertz
    stiff = EI*length*(1 + 1j*w*by_stiffness)
    s = cmath.sqrt((tension/(2*stiff))**2 + MU/length*w*(w - 1j*by_mass)/stiff)
    a, b = cmath.sqrt(tension/(2*stiff) + s), cmath.sqrt(s - tension/(2*stiff))
    return (a, -a, 1j*b, -1j*b), stiff/length


def solve(rows, right):
    n = len(rows)
    table = [list(map(complex, row)) + [complex(r)] for row, r in zip(rows, right)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(table[i][k]))
        table[k], table[pivot] = table[pivot], table[k]
        for i in range(n):
            if i != k:
                part = table[i][k]/table[k][k]
                table[i] = [x - part*y for x, y in zip(table[i], table[k])]
    return [table[k][n]/table[k][k] for k in range(n)]


def exact(hertz, force=0.0, shift=0.0, tension=0.0, length=1.0, **damping):
    amplitude, roots, at, _ = waves(hertz, force, shift, tension, length, **damping)
    return (sum(a*e for a, e in zip(amplitude, at)),
            sum(a*k*e for a, k, e in zip(amplitude, roots, at)))


def waves(hertz, force=0.0, shift=0.0, tension=0.0, length=1.0, **damping):
    w = 2*math.pi*hertz
    roots, stiff = beam(hertz, tension, length, **damping)
    at = [cmath.exp(k*length) for k in roots]
    rows = [[1]*4, list(roots), [k*k*e for k, e in zip(roots, at)],
            [-stiff*length*k**3*e + tension*k*e + 1j*w*C*e for k, e in zip(roots, at)]]
    amplitude = solve(rows, [shift, 0, 0, force])
    return amplitude, roots, at, sum(a*(stiff*length*k**3 - tension*k) for a, k in zip(amplitude, roots))


MASSES = """beamwork: 1
sections: {s: {constants: {A: 1e-4, Iy: 1e-8, Iz: 1e-8, It: 1e-8}, young: 2e11, shear_modulus: 8e10}}
nodes:
  body_$i: {for: {i: %s}, at: [0, $i, 0], hold: [ux, uz, rx, ry, rz], mass: 2}
  top_$i: {for: {i: %s}, at: [1, $i, 0]}
members: {post_$i: {for: {i: %s}, from: body_$i, to: top_$i, section: s, y: [0, 1, 0]}}
springs: {mount_$i: {for: {i: %s}, to: body_$i, stiffness: [0, 800, 0, 0, 0, 0], damping: [0, %s, 0, 0, 0, 0]}}
analyses: {modes: {modal: {%s}}}
quantities:
%s
"""


def modes(count):
    return "".join(f"""  f{i}: {{frequency: {{analysis: modes, which: {i}}}}}
  z{i}: {{damping_ratio: {{analysis: modes, which: {i}}}}}
  d{i}: {{damping_ratio: {{analysis: modes, which: {i}, of: decay}}}}
""" for i in range(count))


class DampedModesTest(ProgramTest):

    def found(self, text, formulation="collocation", n=1):
        """Returns the eigenvalues s = -d + i w and the damping ratios."""
        path = self.folder/"scene.yaml"
        path.write_text(text, encoding="utf-8")
        record = self.record("solve", "--scene", path, "-f", formulation, "-n", n)
        value = {q["quantity"]: q["value"] for q in record["quantities"] if q["status"] == "ok"}
        count = sum(name[0] == "f" for name in value)
        return ([complex(-value[f"d{i}"], 2*math.pi*value[f"f{i}"]) for i in range(count)],
                [value[f"z{i}"] for i in range(count)])

    def masses(self, bodies, c, keys="damped: yes", count=2):
        each = f"0..{bodies - 1}"
        return self.found(MASSES % (each, each, each, each, c, keys, modes(count)))

    def same(self, found, expected, most=1e-9):
        self.assertEqual(len(found), len(expected), found)
        for one, other in zip(found, expected):
            self.assertLess(abs(one - other), most*abs(other), (found, expected))

    def test_one_mass(self):
        for ratio in (1e-6, 0.1, 0.9, 0.999):
            found, ratios = self.masses(1, 2*ratio*40)
            self.same(found, [20*complex(-ratio, math.sqrt(1 - ratio**2))])
            self.same(ratios, [ratio])
        self.same(self.masses(1, 0)[0], [20j])
        self.assertEqual(self.masses(1, 0)[1], [0])
        found, ratios = self.masses(1, 2*3*40)
        self.same(found, [20*(-3 + math.sqrt(8)), 20*(-3 - math.sqrt(8))])
        self.same(ratios, [1, 1])
        found, ratios = self.masses(1, 2*40)
        self.same(found[:1], [-20], 1e-6)

    def test_two_equal_masses(self):
        found, ratios = self.masses(2, 2*0.1*40, count=3)
        self.same(found, [20*complex(-0.1, math.sqrt(0.99))]*2)
        self.same(ratios, [0.1]*2)

    def test_proportional(self):
        """With the damping a M + b K, every mode of a beam must have the damping ratio (a/w + b w)/2 within 1e-5,
        where w is its undamped circular frequency."""
        scene = BEAM.replace("c: 15", "c: 0").replace("  steady: {harmonic: {frequencies: [5, 8, 20, 60]%s}}", "  modes: {modal: {%s}}")
        for formulation in ("collocation", "geometrically_exact", "sheet_third"):
            plain = self.record("solve", "--scene", self.write(scene % ("hold: all", "", "", "", "".join(
                f"  f{i}: {{frequency: {{analysis: modes, which: {i}}}}}\n" for i in range(4)))), "-f", formulation, "-n", 6)
            w = [2*math.pi*q["value"] for q in plain["quantities"]]
            found, ratios = self.found(scene % ("hold: all", "", "", "damped: yes, damping: {mass: 7, stiffness: 1e-4}", modes(4)),
                                       formulation, 6)
            expected = [(7/x + 1e-4*x)/2 for x in w]
            self.same(ratios, expected, 1e-5)
            self.same([abs(s) for s in found], w, 1e-5)

    def write(self, text):
        path = self.folder/"scene.yaml"
        path.write_text(text, encoding="utf-8")
        return path

    def test_dashpot_at_the_tip(self):
        """The eigenvalues s of the exact beam are zeros of 1/u(s), found by the secant method: without tension, under
        tension, and beyond the critical load, where a mode grows."""
        scene = BEAM.replace("  steady: {harmonic: {frequencies: [5, 8, 20, 60]%s}}", "  modes: {modal: {damped: yes%s}}")
        stretched = 1 + 2000/(210e9*0.02*0.01)
        load = "loads: {pull: {force: [2000, 0, 0], on: tip}}"
        for loads, before, about, keys in (
                ("", "", "", {}),
                (load, "  before: {static: {stations: [1]}}", ", about: before", {"tension": 2000, "length": stretched}),
                (load, "  before: {linear: {}}", ", about: before", {"tension": 2000}),
                (load.replace("2000", "-2000"), "  before: {linear: {}}", ", about: before", {"tension": -2000})):
            found, ratios = self.found(scene % ("hold: all", loads, before, about, modes(6).replace(
                "which", "family: bending_y, which")), "collocation", 24)
            self.assertEqual(len(found), 6)
            for s, ratio in zip(found[:4] if about else found, ratios):
                a, b = s*(1 + 1e-5), s
                for _ in range(20):
                    fa, fb = (1/exact(-1j*x/(2*math.pi), force=1, **keys)[0] for x in (a, b))
                    if fa == fb or a == b:
                        break
                    a, b = b, b - fb*(b - a)/(fb - fa)
                self.assertLess(abs(b - s), 1e-4*abs(s), (about, s, b))
                self.assertAlmostEqual(ratio, -b.real/abs(b), delta=5e-5)

    def test_refused(self):
        scene = BEAM.replace("  steady: {harmonic: {frequencies: [5, 8, 20, 60]%s}}", "  modes: {modal: {damped: yes%s}}")
        load = "loads: {push: {force: [-2000, 0, 0], on: tip}}"
        spun = "  before: {static: {stations: [1], spin: {omega: [0, 0, 5]}}}"
        free = MASSES.replace("stiffness: [0, 800, 0, 0, 0, 0], ", "")
        for text, words in (
                (MASSES % ("0..0", "0..0", "0..0", "0..0", 1, "", modes(1)), "add damped: yes"),
                (MASSES % ("0..0", "0..0", "0..0", "0..0", 1, "damping: {mass: 1}", modes(1)), "add damped: yes"),
                (scene % ("hold: all", load, "  before: {static: {stations: [1]}}", ", about: before", modes(1)), "is unstable"),
                (scene % ("hold: all", load, spun, ", about: before", modes(1)), "rotating axes"),
                (free % ("0..0", "0..0", "0..0", "0..0", 1, "damped: yes", modes(1)), "can move freely in one direction; hold it")):
            done = run("solve", "--scene", self.write(text), "-f", "collocation", "-n", 1)
            self.assertRegex(done.stdout + done.stderr, words)


class ByModesTest(ProgramTest):
    def solved(self, text, formulation="collocation", n=8):
        path = self.folder/"scene.yaml"
        path.write_text(text, encoding="utf-8")
        record = self.record("solve", "--scene", path, "-f", formulation, "-n", n)
        curves = {}
        for c in record.get("curves", []):
            curves.setdefault(c["quantity"], c["curve_value"])
        return ({**{q["quantity"]: [q["value"]] for q in record["quantities"]}, **curves},
                max(q["rounding"] for q in record["quantities"]), record["quantities"])

    def close(self, text, keys, formulation="collocation", most=1e-8, n=8, least=0.0):
        direct, _, _ = self.solved(text(""), formulation, n)
        modal, stated, all_ = self.solved(text(keys), formulation, n)
        for name, values in direct.items():
            size = max(map(abs, values)) or 1
            self.assertEqual(len(values), len(modal[name]), [q["reason"] for q in all_])
            error = max(abs(x - y) for x, y in zip(values, modal[name]))/size
            self.assertLessEqual(error, stated + 1e-9, (keys, formulation, name))
            self.assertLess(error, most, (keys, formulation, name))
        self.assertGreaterEqual(stated, least)
        return stated

    @staticmethod
    def scenes():
        load = "loads: {pull: {force: [2000, 0, 0], on: tip}}"
        shake = "motions: {shake: {unit: m, path: [0, 1], value: [0, 0]}}"
        yield lambda k: BEAM % ("hold: all", "", "", k, FORCED)
        yield lambda k: BEAM % ("hold: [ux, uz, rx, ry, rz], drive: {uy: shake}", shake, "", k, SHAKEN)
        yield lambda k: BEAM % ("hold: all", load, "  before: {static: {stations: [1]}}", ", about: before" + k, FORCED)
        yield lambda k: BEAM % ("hold: all", load, "  before: {linear: {}}", ", about: before" + k, FORCED)
        yield lambda k: BEAM % ("hold: [uz, rx, ry]", "", "", k, FORCED)
        yield lambda k: BEAM % ("hold: [ux, uz, rx, ry], drive: {uy: shake}", shake, "", k, SHAKEN)

    def test_all_modes(self):
        for text in self.scenes():
            for damping in ("", ", damping: {mass: 7, stiffness: 1e-3}", ", damping: {ratio: 0.02}",
                            ", damping: {mass: 1, ratios: [0.3, 0, 0.1], ratio: 0.01}"):
                self.assertEqual(self.close(lambda k: text(damping + k), ", solution: modal"), 0)
        for formulation in [f["formulation"] for f in self.record("list", "formulations")["formulations"]]:
            for text in list(self.scenes())[:2]:
                self.close(text, ", solution: modal", formulation, n=4)

    def test_few_modes(self):
        for text in self.scenes():
            for damping in ("", ", damping: {mass: 7, stiffness: 1e-3}"):
                for modes, most in ((5, 1e-3), (8, 1e-5), (14, 1e-6)):
                    self.assertLess(self.close(lambda k: text(damping + k), f", solution: modal, modes: {modes}", most=most,
                                               least=1e-4*most if modes < 14 else 0), 10*most)
        text = next(self.scenes())
        for damping in (", modes: 5, damping: {ratio: 0.02}", ", modes: 5, damping: {ratios: [0.1], mass: 2}"):
            self.close(lambda k: text(damping + k), ", solution: modal", most=1e-4, least=1e-9)

    def test_loops(self):
        acts = "path: [0, 1], factor: [0, 0], feedback: {node: tip, component:"
        for loops, commanded in ((f"servo: {{force: [0, 1, 0], on: tip, {acts} uy, proportional: 2000, derivative: 20, integral: 3000}}}}", 1),
                                 (f"servo: {{moment: [0, 0, 1], on: tip, {acts} uy, proportional: 9, derivative: 0.05}}}}, "
                                  f"other: {{force: [0, 1, 0], on: tip, {acts} rz, proportional: 40, derivative: 0.7}}}}", 1),
                                 (f"servo: {{force: [0, 1, 0], on: tip, {acts} uy, proportional: 300, derivative: 1}}}}", 0)):
            shake = f"motions: {{shake: {{unit: m, path: [0, 1], value: [0, 0]}}}}\nloads: {{{loops}}}"
            pull = f"loads: {{pull: {{force: [2000, 0, 0], on: tip}}, {loops}}}"
            by_reference = reading("u", component="uy", reference="servo")
            scenes = [lambda k: BEAM % ("hold: all", f"loads: {{{loops}}}", "", k, FORCED + (by_reference.replace("  u_", "  c_"))),
                      lambda k: BEAM % ("hold: [ux, uz, rx, ry, rz], drive: {uy: shake}", shake, "", k, SHAKEN + reading("f", component="uy", drive="shake", of="reaction").replace("node: tip", "node: root")),
                      lambda k: BEAM % ("hold: all", pull, "  before: {static: {stations: [1]}}", ", about: before" + k, FORCED)]
            for text in scenes:
                for damping in ("", ", damping: {mass: 7, stiffness: 1e-3}", ", damping: {ratio: 0.02}"):
                    one = text if commanded else lambda k, text=text: text(k).replace("c: 15", "c: 0")
                    self.assertEqual(self.close(lambda k: one(damping + k), ", solution: modal"), 0)
                for modes, most in ((5, 1e-2), (8, 1e-4), (14, 1e-5)):
                    self.assertLess(self.close(text, f", solution: modal, modes: {modes}", most=most), 100*most)

    def test_too_few(self):
        path = self.folder/"scene.yaml"
        path.write_text(BEAM % ("hold: all", "", "", ", solution: modal, modes: 1", FORCED), encoding="utf-8")
        done = run("solve", "--scene", path, "-f", "collocation", "-n", 8)
        self.assertRegex(done.stdout + done.stderr, "the number of modes, 1, is too small for an error bound")

    def test_refused(self):
        load = "loads: {push: {force: [0, 50, 0], on: tip, follower: yes}}"
        path = self.folder/"scene.yaml"
        for keys, words in ((", modes: 3", "does not use modes"),
                            (", damping: {ratios: [-1]}", "a damping ratio is -1"),
                            (", modes: 1, damping: {ratios: [0.1, 0.2]}", "2 damping ratios, but modes: 1"),
                            (", damping: {ratio: -1}", "at least 0")):
            path.write_text(BEAM % ("hold: all", "", "", keys, FORCED), encoding="utf-8")
            done = run("solve", "--scene", path, "-f", "collocation", "-n", 1)
            self.assertRegex(done.stdout + done.stderr, words)
        path.write_text(BEAM % ("hold: all", load, "  before: {static: {stations: [1]}}",
                                ", about: before, solution: modal", FORCED), encoding="utf-8")
        done = run("solve", "--scene", path, "-f", "collocation", "-n", 2)
        self.assertRegex(done.stdout + done.stderr, "require a symmetric stiffness")

    def test_many_modes_wanted(self):
        text = MASSES.replace("analyses: {modes: {modal: {%s}}}",
                              "analyses: {steady: {harmonic: {frequencies: [1, 3, 9]%s}}}")
        each = "0..1"
        scene = lambda c, damped: lambda k: text % (each, each, each, each, c, damped + k, "".join(
            f"  {p}: {{response: {{analysis: steady, node: body_0, component: uy, force: top_0, along: uy, part: {p}, "
            "take: curve}}\n" for p in PARTS))
        for c in (0, 8):
            for keys in (", solution: modal", ", solution: modal, modes: 1", ", solution: modal, modes: 2"):
                if not keys.endswith("1"):
                    self.close(scene(c, ""), keys)
            self.close(scene(c, ", damping: {ratio: 0.3}"), ", solution: modal")

    def test_one_mass(self):
        base = MASSES.replace("to: body_$i, ", "from: base, to: body_$i, ").replace(
            "nodes:", "motions: {shake: {unit: m, path: [0, 1], value: [0, 0]}}\nnodes:\n"
            "  base: {at: [0, -1, 0], hold: [ux, uz, rx, ry, rz], drive: {uy: shake}}")
        for text, source, exact in ((MASSES, "force: body_0, along: uy", lambda z, r: 1/(800*(1 - r*r + 2j*z*r))),
                                    (base, "drive: shake", lambda z, r: (1 + 2j*z*r)/(1 - r*r + 2j*z*r))):
            text = text.replace("analyses: {modes: {modal: {%s}}}",
                                "analyses: {steady: {harmonic: {frequencies: [0, 20/(2*pi), 20/pi]%s}}}")
            reading_ = "".join(f"  {p}: {{response: {{analysis: steady, node: body_0, component: uy, {source}, part: {p}, "
                               "take: curve}}\n" for p in PARTS)
            scene = lambda keys: text % ("0..0", "0..0", "0..0", "0..0", 0, keys, reading_)
            for keys in (", solution: modal", "", ", modes: 1", ", solution: modal, modes: 1"):
                got = self.solved(scene(keys + ", damping: {ratio: 0.02}"), n=1)[0]
                found = [complex(x, y) for x, y in zip(got["real"], got["imaginary"])]
                for r, value in enumerate(found):
                    self.assertLess(abs(value/exact(0.02, r) - 1), 1e-9, (keys, source, found))
            for keys in (", solution: modal", ""):
                path = self.folder/"scene.yaml"
                path.write_text(scene(keys), encoding="utf-8")
                done = run("solve", "--scene", path, "-f", "collocation", "-n", 1)
                self.assertIn("is a natural frequency without damping", done.stdout + done.stderr)


class ExtremesTest(ProgramTest):
    OSCILLATOR = """beamwork: 1
sections: {s: {constants: {A: 1e-4, Iy: 1e-8, Iz: 1e-8, It: 1e-8}, young: 2e11, shear_modulus: 8e10}}
nodes: {body: {at: [0, 0, 0], mass: 2, hold: [ux, uz, rx, ry, rz]}, top: {at: [1, 0, 0]}}
members: {post: {from: body, to: top, section: s, y: [0, 1, 0]}}
springs: {s: {to: body, stiffness: [0, 800, 0, 0, 0, 0]}}
analyses: {steady: {harmonic: {frequencies: %s, damping: {ratio: %g}%s}}}
quantities:
  most:  {response: {analysis: steady, node: body, component: uy, force: body, along: uy, take: max}, unit: m/N}
  least: {response: {analysis: steady, node: body, component: uy, force: body, along: uy, part: real, take: min}, unit: m/N}
"""

    def extremes(self, frequencies, ratio, more=""):
        path = self.folder/"scene.yaml"
        path.write_text(self.OSCILLATOR % (frequencies, ratio, more), encoding="utf-8")
        record = self.record("solve", "--scene", path, "-f", "collocation", "-n", 1)
        return ({q["quantity"]: q for q in record["quantities"]},
                self.answered("solve", "--scene", path, "-f", "collocation", "-n", 1).stdout)

    def test_closed_form(self):
        hertz = 20/(2*math.pi)
        for ratio in (0.2, 0.01, 1e-5):
            for frequencies in ("1..10/8:log", "1..10/200:log", "[3, 4]"):
                for more in ("", ", solution: modal"):
                    got, text = self.extremes(frequencies, ratio, more)
                    exact = 1/(800*2*ratio*math.sqrt(1 - ratio**2))
                    self.assertLess(abs(got["most"]["value"]/exact - 1), 1e-8, (ratio, frequencies))
                    self.assertLess(abs(got["most"]["x"]/(hertz*math.sqrt(1 - 2*ratio**2)) - 1), 1e-6)
                    self.assertRegex(text, r"(?m)^most .*, at 3\.\d+ Hz")
                    if hertz*math.sqrt(1 + 2*ratio) < 4:
                        self.assertLess(abs(got["least"]["value"]*800*4*ratio*(1 + ratio) + 1), 1e-8)

    def test_at_an_end(self):
        got, text = self.extremes("[5, 6, 7]", 0.01)
        self.assertAlmostEqual(got["most"]["x"], 5, delta=1e-9)
        self.assertIn(", at 5 Hz", text)

    def test_at_a_frequency_that_is_not_there(self):
        path = self.folder/"scene.yaml"
        path.write_text((self.OSCILLATOR % ("[1, 2, 5]", 0.1, "")).replace("take: max", "at: 3").replace("take: min", "at: 2"),
                        encoding="utf-8")
        said = " ".join(run("solve", "--scene", path, "-f", "collocation", "-n", 1).stdout.split())
        self.assertIn("most - 3 Hz is not one of the frequencies of analysis steady; add it least ", said)

    def test_nothing_damps(self):
        path = self.folder/"scene.yaml"
        path.write_text((self.OSCILLATOR % ("[1, 2, 5]", 0, "")).replace(", damping: {ratio: 0}", ""), encoding="utf-8")
        self.assertRegex(" ".join(run("solve", "--scene", path, "-f", "collocation", "-n", 1).stdout.split()),
                         r"most - the response is unbounded at 3\.1831 Hz, where it is not damped; add damping")

    PAIR = """beamwork: 1
sections: {s: {constants: {A: 1e-4, Iy: 1e-8, Iz: 1e-8, It: 1e-8}, young: 1e9, shear_modulus: 4e8}}
nodes:
  left: {at: [0, 0, 0], mass: 1, hold: [uy, uz, rx, ry, rz]}
  middle: {at: [1, 0, 0], hold: [uy, uz, rx, ry, rz]}
  right: {at: [2, 0, 0], mass: 1, hold: [uy, uz, rx, ry, rz]}
  g: {at: [2, 3, 0], hold: all}
  h: {at: [2, 4, 0], mass: 1, inertia: [1, 1, 1, 0, 0, 0]}
members: {side: {from: g, to: h, section: s, y: [1, 0, 0]}}
springs:
  ground_$n: {for: {n: [left, right]}, to: $n, stiffness: [100/3, 0, 0, 0, 0, 0]}
  joint_$n: {for: {n: [left, right]}, from: $n, to: middle, stiffness: [700/3, 0, 0, 0, 0, 0]}
  damper: {to: middle, damping: [2, 0, 0, 0, 0, 0]}
analyses: {steady: {harmonic: {frequencies: [0.5, 3, 9]%s}}}
quantities:
"""

    def test_what_is_not_excited(self):
        w = 2*math.pi*numpy.linspace(0.5, 9, 850001)
        k, own = 700/3, 800/3 - w*w
        exact = {"middle": own/(own*(2j*w + 2*k) - 2*k*k), "left": k/(own*(2j*w + 2*k) - 2*k*k)}
        part = {"amplitude": abs, "real": numpy.real, "imaginary": numpy.imag}
        asked = [(node, p, take) for node in exact for p in part for take in ("max", "min")]
        line = "  %s_%s_%s: {response: {analysis: steady, node: %s, component: ux, force: middle, along: ux, part: %s, take: %s}}\n"
        path = self.folder/"scene.yaml"
        for more in ("", ", solution: modal"):
            path.write_text(self.PAIR % more + "".join(line % (*one, *one) for one in asked), encoding="utf-8")
            found = self.record("solve", "--scene", path, "-f", "collocation", "-n", 1)["quantities"]
            for (node, p, take), row in zip(asked, found):
                expected = getattr(numpy, take)(part[p](exact[node]))
                self.assertEqual(row["status"], "ok", (row["quantity"], row["reason"]))
                self.assertLess(abs(row["value"] - expected), 1e-7*abs(exact[node]).max(), (row, expected))
            for node, hertz in (("left", r"2\.59899"), ("h", r"\d\.\d+")):
                path.write_text(self.PAIR % more + (line % (node, "amplitude", "max", node, "amplitude", "max"))
                                .replace("force: middle", "force: " + node), encoding="utf-8")
                said = " ".join(run("solve", "--scene", path, "-f", "collocation", "-n", 1).stdout.split())
                self.assertRegex(said, "unbounded at %s Hz, where it is not damped" % hertz)


class HarmonicTest(ProgramTest):

    def scene(self, text):
        path = self.folder/"scene.yaml"
        path.write_text(text, encoding="utf-8")
        return path

    def curves(self, text, formulation, n):
        record = self.record("solve", "--scene", self.scene(text), "-f", formulation, "-n", n)
        by_name = {}
        for curve in record["curves"]:
            by_name.setdefault(curve["quantity"], curve["curve_value"])
        names = {name.rsplit("_", 1)[0] for name in by_name}
        return {name: [complex(x, y) for x, y in zip(by_name[name + "_real"], by_name[name + "_imaginary"])]
                for name in names}

    def near(self, found, expected, most, message):
        for hertz, one, other in zip(FREQUENCIES, found, expected):
            self.assertLess(abs(one - other), most*abs(other), msg=(message, hertz, one, other))

    def formulations(self):
        return [f["formulation"] for f in self.record("list", "formulations")["formulations"]]

    def test_dashpot_at_the_tip(self):
        text = BEAM % ("hold: all", "", "", "", FORCED)
        expected = [exact(f, force=1) for f in FREQUENCIES]
        for formulation in self.formulations():
            found = self.curves(text, formulation, 32)
            self.near(found["u"], [u for u, _ in expected], 4e-6, formulation)
            self.near(found["t"], [t for _, t in expected], 4e-6, formulation)

    def test_shaken_base(self):
        text = BEAM % ("hold: [ux, uz, rx, ry, rz], drive: {uy: shake}",
                       "motions: {shake: {unit: m, path: [0, 1], value: [0, 0]}}", "", "", SHAKEN)
        expected = [exact(f, shift=1)[0] for f in FREQUENCIES]
        found = self.curves(text, "collocation", 24)
        self.near(found["u"], expected, 2e-6, "base")
        self.near(found["r"], [u - 1 for u in expected], 2e-6, "as seen from the base")

    def test_reaction(self):
        for keys in ("", ", solution: modal", ", solution: modal, modes: 40"):
            text = BEAM % ("hold: [ux, uz, rx, ry, rz], drive: {uy: shake}",
                           "motions: {shake: {unit: m, path: [0, 1], value: [0, 0]}}", "", keys,
                           "".join(f"  {name}_{part}: {{response: {{analysis: steady, node: root, component: uy, of: reaction, "
                                   f"{source}, part: {part}, take: curve}}}}\n" for part in PARTS
                                   for name, source in (("f", "force: tip, along: uy"), ("s", "drive: shake"))))
            found = self.curves(text, "collocation", 24)
            self.near(found["f"], [waves(f, force=1)[3] for f in FREQUENCIES], 2e-6, keys)
            self.near(found["s"], [waves(f, shift=1)[3] for f in FREQUENCIES], 2e-6, keys)

    def test_reaction_with_ratios(self):
        base = MASSES.replace("to: body_$i, ", "from: base, to: body_$i, ").replace(
            "nodes:", "motions: {shake: {unit: m, path: [0, 1], value: [0, 0]}}\nnodes:\n"
            "  base: {at: [0, -1, 0], hold: [ux, uz, rx, ry, rz], drive: {uy: shake}}").replace(
            "analyses: {modes: {modal: {%s}}}", "analyses: {steady: {harmonic: {frequencies: [5, 8, 20, 60]%s}}}")
        for keys in (", damping: {ratio: 0.05}", ", solution: modal, damping: {ratio: 0.05}"):
            scene = lambda quantities: base % ("0..0", "0..0", "0..0", "0..0", 2, keys, quantities)
            found = self.curves(scene("".join(
                f"  {name}_{part}: {{response: {{analysis: steady, node: {node}, component: uy, of: {of}, drive: shake, "
                f"part: {part}, take: curve}}}}\n" for part in PARTS for name, node, of in (
                    ("r", "base", "reaction"), ("a", "body_0", "acceleration")))), "collocation", 1)
            self.near(found["r"], [2*a for a in found["a"]], 1e-9, keys)
            for node, words in (("body_0", "requires a motion that drives only this component"), ("top_0", "requires a motion that drives only this component")):
                done = run("solve", "--scene", self.scene(scene(
                    f"  r: {{response: {{analysis: steady, node: {node}, component: uy, of: reaction, drive: shake, at: 5}}}}")),
                    "-f", "collocation", "-n", 1)
                self.assertRegex(done.stdout + done.stderr, words)

    def test_proportional_damping(self):
        damping = {"by_mass": 7, "by_stiffness": 2e-3}
        keys = ", damping: {mass: 7, stiffness: 2e-3}"
        forced = BEAM % ("hold: all", "", "", keys, FORCED)
        expected = [exact(f, force=1, **damping)[0] for f in FREQUENCIES]
        for formulation in self.formulations():
            self.near(self.curves(forced, formulation, 32)["u"], expected, 4e-6, formulation)
        shaken = BEAM % ("hold: [ux, uz, rx, ry, rz], drive: {uy: shake}",
                         "motions: {shake: {unit: m, path: [0, 1], value: [0, 0]}}", "", keys, SHAKEN)
        self.near(self.curves(shaken, "collocation", 32)["u"],
                  [exact(f, shift=1, **damping)[0] for f in FREQUENCIES], 2e-6, "base")

    def test_stiffness_is_that_of_all_members_and_springs(self):
        loads = "loads: {pull: {force: [-300, 200, 50], on: tip}}"
        with_spring = BEAM.replace("damping: [0, c", "stiffness: [0, 900, 0, 0, 0, 3], damping: [0, c")
        keys = with_spring % ("hold: all", loads, "  before: {static: {stations: [1], steps: 4}}",
                              ", about: before, damping: {stiffness: 1e-3}", FORCED)
        each = (with_spring % ("hold: all", loads, "  before: {static: {stations: [1], steps: 4}}", ", about: before", FORCED)
                ).replace("y: [0, 1, 0]}", "y: [0, 1, 0], damping: 1e-3}").replace(
                    "damping: [0, c, 0, 0, 0, 0]", "damping: [0, c + 0.9, 0, 0, 0, 3e-3]")
        self.assertNotEqual(keys, each)
        one, other = (self.curves(text, "collocation", 4)["u"] for text in (keys, each))
        self.near(one, other, 1e-12, "all")

    def test_stiffness_of_tables(self):
        text = """beamwork: 1
sections: {s: {constants: {A: 1e-4, Iy: 1e-9, Iz: 1e-9, It: 1e-9}, young: 1e9, shear_modulus: 4e8}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0], hold: [uy, uz, rx, ry, rz], mass: 2}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}
springs: {k: {to: b, stiffness: [1000, 0, 0, 0, 0, 0], damping: [20, 0, 0, 0, 0, 0],
              tables: {ux: {at: [-1, 1e-3, 1], value: [0, 0, 8991]}}}}
loads: {p: {force: [500, 0, 0], on: b}}
analyses: {st: {static: {stations: [1]}}, steady: {harmonic: {frequencies: [8], about: st, damping: {mass: 3, stiffness: 1e-4}}}}
quantities:
  re: {response: {analysis: steady, node: b, component: ux, force: b, part: real, at: 8}}
  im: {response: {analysis: steady, node: b, component: ux, force: b, part: imaginary, at: 8}}
"""
        done = run("solve", "--scene", "/dev/stdin", "-f", "collocation", "-n", 1, "--format", "json", input=text)
        self.assertEqual(done.returncode, 0, done.stderr)
        got = {q["quantity"]: q["value"] for q in json.loads(done.stdout)["quantities"]}
        w, k = 2 * math.pi * 8, 1000 + 9000 + 1e9 * 1e-4
        exact = 1 / (k - 2 * w**2 + 1j * w * (20 + 1e-4 * k + 3 * 2))
        self.assertAlmostEqual(got["re"] / exact.real, 1, delta=1e-9)
        self.assertAlmostEqual(got["im"] / exact.imag, 1, delta=1e-9)

    def test_about_a_state(self):
        loads = "loads: {pull: {force: [2000, 0, 0], on: tip}}"
        stretched = 1 + 2000/(210e9*0.02*0.01)
        for kind, length in (("{static: {stations: [1]}}", stretched), ("{linear: {}}", 1)):
            expected = [exact(f, force=1, tension=2000, length=length)[0] for f in FREQUENCIES]
            text = BEAM % ("hold: all", loads, f"  before: {kind}", ", about: before", FORCED)
            self.near(self.curves(text, "collocation", 24)["u"], expected, 5e-5, kind)

    def test_equal_ratios(self):
        text = BEAM % ("hold: all", "", "", "", FORCED)
        one, other = (self.curves(text.replace("[5, 8, 20, 60]", to), "collocation", 4)["u"]
                      for to in ("0.5..500/3:log", "[0.5, 5, 50, 500]"))
        for a, b in zip(one, other):
            self.assertLess(abs(a - b), 1e-9*abs(b))

    def test_reciprocity(self):
        crossed = reading("a", component="rz", force="tip", along="uy") + reading("b", component="uy", force="tip", along="rz")
        found = self.curves(BEAM % ("hold: all", "", "", "", crossed), "sheet_third", 3)
        for one, other in zip(found["a"], found["b"]):
            self.assertLess(abs(one - other), 1e-9*abs(one))

    def test_force_in_a_member(self):
        scene = BEAM.replace("  tip: {at", "  cut: {at: [0, 0, 0]}\n  tip: {at").replace("from: root", "from: cut").replace(
            "springs: {", "springs: {joint: {from: root, to: cut, stiffness: [k, k, k, k, k, k]}, ").replace("c: 15", "c: 15, k: 1e10")
        scene = scene % ("hold: all", "", "", "", "".join(
            f"  m_{part}: {{response: {{analysis: steady, node: cut, from: root, component: rz, force: tip, along: uy, part: {part}, "
            "take: curve}}\n" for part in PARTS))
        (self.folder/"scene.yaml").write_text(scene, encoding="utf-8")
        record = self.record("solve", "--scene", self.folder/"scene.yaml", "-f", "beamw", "-n", 8)
        curves = [c["curve_value"] for c in record["curves"]]
        for hertz, real, imaginary in zip(FREQUENCIES, *curves):
            amplitude, roots, _, _ = waves(hertz, 1.0)
            moment = EI*sum(a*k*k for a, k in zip(amplitude, roots))
            self.assertLess(abs(1e10*complex(real, imaginary)/moment - 1), 1e-4)

    def test_refused(self):
        held = reading("u", component="uy", force="root", along="uy")
        buckled = "loads: {push: {force: [-2000, 0, 0], on: tip}, aside: {force: [0, 0.1, 0], on: tip}}"
        for text, words in (
                (BEAM % ("hold: all", "", "", "", held), "a force along a fixed or driven component of node root has no effect"),
                (BEAM % ("hold: all", "", "", "", "  n: {internal: {analysis: steady, member: m, resultant: Mz, where: 0}}"),
                 "divide the member at two nodes in the same position, join them by a stiff spring"),
                (BEAM % ("hold: all", buckled, "  before: {static: {stations: [1], steps: 4}}", ", about: before", FORCED),
                 "not_converged|unstable"),
                (BEAM.replace("5, 8, 20", "-1, 8, 20") % ("hold: all", "", "", "", FORCED), "give zero or positive"),
                (BEAM.replace("5, 8, 20", "0, 8, 20") % ("hold: [uz, rx, ry]", "", "", "", FORCED), "at 0 Hz the structure is free to move"),
                (BEAM % ("hold: all", "", "", "", "  u: {response: {analysis: steady, node: tip, component: uy}}"),
                 "exactly one input is required"),
                (BEAM % ("hold: all", "", "", ", damping: {mass: -1}", FORCED), "mass = -1; give at least 0"),
                (BEAM % ("hold: all", "", "  modes: {modal: {damping: {mass: 1}}}", "", FORCED), "damping")):
            done = run("solve", "--scene", self.scene(text), "-f", "collocation", "-n", 2)
            self.assertRegex(done.stdout + done.stderr, words.replace("\n", " "))


if __name__ == "__main__":
    unittest.main()
