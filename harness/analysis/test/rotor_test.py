"""Rotors: a heavy disc on a light shaft, stability of rotating states, and bearings with cross-coupled stiffness."""
import cmath
import math
import re
import unittest

from harness.tools.kit.program import ProgramTest, run

SHAFT = """beamwork: 1
let: {d: 0.02}
sections:
  s: {constants: {A: pi*d^2/4, Iy: pi*d^4/64*%(flat)r, Iz: pi*d^4/64, It: pi*d^4/32}, young: 200e9, shear_modulus: 80e9,
      density: %(density)r}
nodes:
  base: {at: [0, 0, 0], hold: all}
  disc: {at: [0.5, 0, 0], mass: 5, inertia: [%(polar)r, 0.02, 0.02, 0, 0, 0]}
members: {shaft: {from: base, to: disc, section: s, y: [0, 1, 0]}}
analyses: {r: {rotation: {omega: [%(omega)r, 0, 0], stations: [1], wanted: 8}}}
quantities: {f_$n: {for: {n: 0..%(last)d}, frequency: {analysis: r, which: n}, unit: Hz}}
omit: [%(omit)s]
"""
# A point mass on a massless shaft whose end does not rotate. The shaft stiffness is 12 E I/L^3, multiplied by `flat` in
# one plane.
JEFFCOTT = SHAFT.replace("mass: 5, inertia: [%(polar)r, 0.02, 0.02, 0, 0, 0]", "mass: 5, hold: [ux, rx, ry, rz]")
# A nearly rigid arm with a mass at its tip, in an eccentric hinge with a soft spring. Three coordinates have mass.
ARM = """beamwork: 1
let: {W: 20, e: 0.1, L: 0.9, k: 1}
sections: {arm: {constants: {A: 1e-2, Iy: 1e-4, Iz: 1e-4, It: 2e-4}, young: %s, shear_modulus: 80e9}}
nodes: {hinge: {at: [e, 0, 0], hold: [ux, uy, uz, rx]}, tip: {at: [e + L, 0, 0], mass: 1}}
members: {arm: {from: hinge, to: tip, section: arm, y: [0, 1, 0]}}
springs: {soft: {to: hinge, stiffness: [0, 0, 0, 0, k, k]}}
analyses: {r: {rotation: {omega: [0, 0, W], stations: [1], wanted: 2}}}
quantities:
  lag:  {frequency: {analysis: r, which: 0}, unit: Hz}
  flap: {frequency: {analysis: r, which: 1}, unit: Hz}
"""
WIRE = """beamwork: 1
let: {d: 1e-3}
sections: {wire: {constants: {A: pi*d^2/4, Iy: pi*d^4/64, Iz: pi*d^4/64, It: pi*d^4/32}, young: 2e9, shear_modulus: 1e9, density: 7800}}
nodes: {hub: {at: [0, 0, 0], hold: [ux, uy, uz, rx]}, tip: {at: [1, 0, 0]}}
members: {wire: {from: hub, to: tip, section: wire, y: [0, 1, 0]}}
springs: {soft: {to: hub, stiffness: [0, 0, 0, 0, 1e-6, 1e-6]}}
analyses: {r: {rotation: {omega: [0, 0, 100], stations: [1], wanted: 4}}}
quantities: {flap: {frequency: {analysis: r, which: 0, family: bending_z}, unit: Hz}}
"""
EI, GJ, EA = 200e9*math.pi*0.02**4/64, 80e9*math.pi*0.02**4/32, 200e9*math.pi*0.01**2
LENGTH, MASS, DIAMETRAL = 0.5, 5, 0.02
K11, K12, K22 = 12*EI/LENGTH**3, -6*EI/LENGTH**2, 4*EI/LENGTH
FIRST = math.sqrt(K11/MASS)
DEFAULT = {"flat": 1.0, "density": 1e-6, "polar": 0.04, "omega": 300.0, "last": 5, "omit": "shear"}


def bending(omega, polar):
    def value(w):
        return (K11 - MASS*w*w)*(K22 - DIAMETRAL*w*w + polar*omega*w) - K12*K12
    limit = 10*(FIRST + math.sqrt(K22/DIAMETRAL) + polar/DIAMETRAL*omega)
    places = sorted({s*limit*10**(-5*i/40000) for i in range(40001) for s in (-1, 1)})
    found = []
    for a, b in zip(places, places[1:]):
        if value(a)*value(b) > 0:
            continue
        low = value(a) > 0
        for _ in range(200):
            m = (a + b)/2
            a, b = (m, b) if (value(m) > 0) == low else (a, m)
        found.append(abs(a - omega))
    assert len(found) == 4
    return found


def expected(omega, polar):
    return sorted(w/2/math.pi for w in
                  bending(omega, polar) + [math.sqrt(GJ/LENGTH/polar), math.sqrt(EA/LENGTH/MASS)])


def critical(polar):
    a, b = 1.0, 300.0
    for _ in range(200):
        m = (a + b)/2
        left = (K11 - MASS*m*m)*(K22 - (DIAMETRAL - polar)*m*m) - K12*K12
        a, b = (m, b) if left > 0 else (a, m)
    return a


def values(text):
    return [float(v) for v in re.findall(r"^f_\d+ +([-+.e\d]+) Hz", text, re.M)]


class Rotors(ProgramTest):

    def written(self, scene):
        path = self.folder / "scene.yaml"
        path.write_text(scene)
        return path

    def text(self, scene, formulation, n):
        return run("solve", "--scene", self.written(scene), "-f", formulation, "-n", n)

    def solved(self, scene, formulation, n):
        return self.record("solve", "--scene", self.written(scene), "-f", formulation, "-n", n)

    def frequencies(self, scene, formulation, n):
        done = self.text(scene, formulation, n)
        self.assertEqual(done.returncode, 0, done.stderr)
        return values(done.stdout)

    def close(self, found, exact, omega, within):
        self.assertEqual(len(found), len(exact))
        for a, b in zip(found, exact):
            self.assertLess(abs(a - b), within*(b + 1e-2*omega), (found, exact))

    def test_stated(self):
        for got, stated in zip(expected(300, 0.04), (32.51997385, 39.89422804, 59.62402347, 135.91112896,
                                                     139.26009748, 797.88456080)):
            self.assertLess(abs(got/stated - 1), 1e-9)

    def test_meshes(self):
        for formulation in ("collocation", "geometrically_exact", "beamw_consistent"):
            for n in (1, 2, 4, 16, 64) if formulation == "collocation" else (2, 32):
                self.close(self.frequencies(SHAFT % DEFAULT, formulation, n), expected(300, 0.04), 300, 2e-9)

    def test_masses(self):
        for density in (7.85, 1e-3, 1e-6, 1e-9, 1e-12):
            for n in (2, 16):
                found = self.frequencies(SHAFT % {**DEFAULT, "density": density}, "collocation", n)
                self.close(found, expected(300, 0.04), 300, 1e-9 + 4e-5*density)

    def test_too_light(self):
        for density in (1e-9, 1e-13):
            for omega in (0.5*FIRST, 3*FIRST):
                scene = JEFFCOTT % {**DEFAULT, "density": density, "omega": omega, "last": 3}
                done = self.record("solve", "--scene", self.written(scene), "-f", "collocation", "-n", 2)
                self.assertEqual([q["status"] for q in done["quantities"]], ["ok", "ok", "no_value", "no_value"])
                self.assertIn("distinguishable from round-off", done["quantities"][2]["reason"])

    def test_speeds(self):
        for polar in (0.04, 0.01):
            at = critical(polar)
            for omega in (1e-2, 1.0, at/2, at*(1 - 1e-3), at*(1 - 1e-6), at*(1 + 1e-6), at*(1 + 1e-3), 300.0, 1e4):
                scene = SHAFT % {**DEFAULT, "polar": polar, "omega": omega, "density": 1e-9}
                for n in (1, 8):
                    self.close(self.frequencies(scene, "collocation", n), expected(omega, polar), omega, 1e-8)

    def test_at_the_critical_speed(self):
        at = critical(0.04)
        for omega in (at*(1 - 1e-10), at, at*(1 + 1e-10)):
            done = self.text(SHAFT % {**DEFAULT, "omega": omega}, "collocation", 4)
            if done.returncode == 0:
                self.close(values(done.stdout), expected(omega, 0.04), omega, 1e-8)
            else:
                self.assertIn("critical point", done.stderr)

    def known(self, scene, formulation, n, exact, within, floor=2e-13):
        done = self.solved(scene, formulation, n)
        self.assertEqual(len(done["quantities"]), len(exact))
        for q, right in zip(done["quantities"], exact):
            self.assertEqual(q["status"], "ok", (formulation, n, q["reason"]))
            self.assertGreater(q["rounding"], 0)
            self.assertLess(q["rounding"], within, (formulation, n, q["quantity"]))
            self.assertLess(abs(q["value"]/right - 1), q["rounding"] + floor, (formulation, n, q["quantity"]))

    def test_massless(self):
        exact = (math.sqrt(400/9 + 1/0.81)/2/math.pi, math.sqrt(400*(1 + 1/9) + 1/0.81)/2/math.pi)
        for young, stretch in (("20e9", 1e-5), ("200e9", 1e-6)):
            for formulation in ("geometrically_exact", "collocation", "beamw"):
                first = None
                for n in (1, 2, 8, 16, 24, 32):
                    scene = ARM % young
                    values = [q["value"] for q in self.solved(scene, formulation, n)["quantities"]]
                    first = first or values
                    for value, right in zip(first, exact):
                        self.assertLess(abs(value/right - 1), stretch, (formulation, young))
                    self.known(scene, formulation, n, first, 1e-10)

    def test_lost(self):
        done = self.record("solve", "--scene", self.written(ARM % "200e9"), "-f", "geometrically_exact", "-n", 64, code=1)
        for q in done["quantities"]:
            self.assertIsNone(q["value"])
            self.assertIn("use fewer elements", q["reason"])

    def test_uncertainties(self):
        at = critical(0.04)
        for formulation in ("collocation", "geometrically_exact", "beamw", "sheet_third"):
            for n in (1, 4, 16, 64):
                scene = SHAFT % {**DEFAULT, "density": 1e-13}
                self.known(scene, formulation, n, expected(300, 0.04), 1e-11)
        for near, within in ((1e-3, 1e-10), (1e-6, 1e-7), (1e-9, 1e-4)):
            for side in (-1, 1):
                for n in (1, 8, 32):
                    omega = at*(1 + side*near)
                    scene = SHAFT % {**DEFAULT, "density": 1e-13, "omega": omega}
                    self.known(scene, "collocation", n, expected(omega, 0.04), within)

    def test_growth(self):
        for flat in (1.001, 1.3):
            high = math.sqrt(flat)
            for part, within in ((1 + 1e-6, 1e-7), ((1 + high)/2, 1e-9), (high*(1 - 1e-6), 1e-7)):
                W = part*FIRST
                a, b = FIRST**2 - W*W, flat*FIRST**2 - W*W
                sum_ = a + b + 4*W*W
                right = math.sqrt(-2*a*b/(sum_ + math.sqrt(sum_**2 - 4*a*b)))
                scene = JEFFCOTT.replace("f_$n: {for: {n: 0..%(last)d}, frequency: {analysis: r, which: n}, unit: Hz}",
                                         "g: {growth: {analysis: r}}")
                for n in (1, 8, 32):
                    self.known(scene % {**DEFAULT, "flat": flat, "omega": W, "density": 1e-13}, "collocation", n, [right],
                               within)

    def test_moment(self):
        for moment in ("0", "1e-9"):
            scene = SHAFT % {**DEFAULT, "density": 1e-13}
            scene = scene.replace("analyses:", f"loads: {{turn: {{moment: [0, 0, {moment}], on: disc}}}}\nanalyses:")
            for n in (1, 8):
                self.known(scene, "collocation", n, expected(300, 0.04), 1e-11)

    def test_indefinite_without_mass(self):
        done = self.text(WIRE, "geometrically_exact", 8)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("too long for the axial force", " ".join((done.stdout + done.stderr).split()))
        done = self.solved(WIRE, "collocation", 8)
        self.assertLess(abs(done["quantities"][0]["value"]/(100/2/math.pi) - 1), 3e-4)

    def stability(self, scene, n=2):
        return self.solved(scene, "collocation", n)["steps"][-1]["stability"]

    def test_stability(self):
        for part, said in ((0.5, "stable"), (0.9, "stable"), (1.05, "unstable: grows"),
                           (1.2, "stable without damping"), (1.5, "stable without damping")):
            scene = JEFFCOTT % {**DEFAULT, "flat": 1.3, "omega": part*FIRST, "last": 0}
            self.assertEqual(self.stability(scene), said, part)
            told = self.text(scene, "collocation", 2).stdout
            self.assertNotIn("negative pivots", told)
            self.assertEqual("stable without damping" in told, part > 1.1, told)

    def test_round_shaft(self):
        for part in (0.5, 0.999, 1.001, 1.5, 3.0):
            scene = JEFFCOTT % {**DEFAULT, "omega": part*FIRST, "last": 1}
            right = sorted(abs(FIRST*(1 + s*part))/2/math.pi for s in (-1, 1))
            for n in (1, 2, 4, 8, 16):
                self.close(self.frequencies(scene, "collocation", n), right, part*FIRST, 2e-9)
            self.assertEqual(self.stability(scene), "stable" if part < 1 else "stable without damping")

    def test_without_modes(self):
        for part, said in ((0.9, "stable"), (1.05, "unstable: grows"), (1.5, "undecided")):
            scene = JEFFCOTT % {**DEFAULT, "flat": 1.3, "omega": part*FIRST, "last": 0}
            scene = scene.replace("frequency: {analysis: r, which: n}, unit: Hz",
                                  "displacement: {analysis: r, node: disc, component: uy}")
            self.assertEqual(self.stability(scene), said, part)


def across(a, b, c, d):
    rows = [[0]*6 for _ in range(6)]
    rows[1][1:3], rows[2][1:3] = (a, b), (c, d)
    return sum(rows, [])


# A disc at the middle of a massless shaft on two bearings, which do not resist rotation.
JOURNAL = """beamwork: 1
sections: {s: {constants: {A: 3e-4, Iy: 8e-9, Iz: 8e-9, It: 1.6e-8}, young: 200e9, shear_modulus: 80e9}}
nodes:
  left:  {at: [0, 0, 0], hold: [ux, rx]}
  disc:  {at: [0.5, 0, 0], mass: 10}
  right: {at: [1, 0, 0]}
members:
  first:  {from: left, to: disc, section: s, y: [0, 1, 0]}
  second: {from: disc, to: right, section: s, y: [0, 1, 0]}
springs:
  a: {to: left, stiffness: %(stiffness)s, damping: %(damping)s}
  b: {to: right, stiffness: %(stiffness)s, damping: %(damping)s}
loads: {weight: {force: [0, 0, -98.1], on: disc}}
analyses: {%(analyses)s}
quantities: {%(quantities)s}
omit: [shear]
"""
BEARING, FILM, SHAFT_STIFFNESS = (3e5, 2e5, -4e4, 2e5), (1600, 250, 150, 1500), 48*200e9*8e-9
RESPONSES = ", ".join(f"{part}_{o}{i}: {{response: {{analysis: A, node: disc, component: {o}, force: disc, along: {i}, "
                      f"part: {part}, at: 9}}}}" for o in ("uy", "uz") for i in ("uy", "uz")
                      for part in ("real", "imaginary"))
# A disc that does not rotate, in a fluid film, on a shaft with the stiffness 192 E I/L^3.
DAMPED = """beamwork: 1
sections: {s: {constants: {A: 3e-4, Iy: 8e-9, Iz: 8e-9, It: 1.6e-8}, young: 200e9, shear_modulus: 80e9}}
nodes:
  left:  {at: [0, 0, 0], hold: all}
  disc:  {at: [0.5, 0, 0], mass: 10, hold: [ux, rx, ry, rz]}
  right: {at: [1, 0, 0], hold: all}
members:
  first:  {from: left, to: disc, section: s, y: [0, 1, 0]}
  second: {from: disc, to: right, section: s, y: [0, 1, 0]}
springs: {film: {to: disc, stiffness: %(stiffness)s, damping: %(damping)s}}
analyses: {%(analyses)s}
quantities: {%(quantities)s}
omit: [shear, rotary_inertia]
"""


def dynamic(s):
    """Returns the entries a, b, c, d of the dynamic stiffness [[a, b], [c, d]] of the disc in uy and uz at the complex
    frequency s [1/s], with the bearings eliminated."""
    k = SHAFT_STIFFNESS
    a, b, c, d = (2*x + s*2*y for x, y in zip(BEARING, FILM))
    a, d = a + k, d + k
    det = a*d - b*c
    return k - k*k*d/det + 10*s*s, k*k*b/det, k*k*c/det, k - k*k*a/det + 10*s*s


class Bearings(ProgramTest):

    def values(self, scene, n=1, formulation="collocation", **words):
        return self.values_of(scene % words, "-f", formulation, "-n", n)

    def told(self, scene, **words):
        path = self.folder/"bearing.yaml"
        path.write_text(scene % words)
        done = run("solve", "--scene", path, "-f", "collocation", "-n", 1)
        return done.returncode, " ".join((done.stdout + done.stderr).split())

    def test_journal(self):
        for formulation in ("collocation", "geometrically_exact", "beamw"):
            got = self.values(JOURNAL, 2, formulation, stiffness=across(*BEARING), damping=across(*FILM),
                              analyses="d: {modal: {damped: yes}}, A: {harmonic: {frequencies: [9]}}, L: {linear: {}}",
                              quantities=RESPONSES + ", " + ", ".join(
                                  f"{q}{i}: {{{q}: {{analysis: d, which: {i}}}}}"
                                  for q in ("frequency", "damping_ratio") for i in (0, 1)) +
                              ", y: {displacement: {analysis: L, node: disc, component: uy}}")
            for i in (0, 1):
                ratio, w = got[f"damping_ratio{i}"], 2*math.pi*got[f"frequency{i}"]
                a, b, c, d = dynamic(w*complex(-ratio/math.sqrt(1 - ratio**2), 1))
                self.assertLess(abs(a*d - b*c), 1e-7*SHAFT_STIFFNESS**2, (formulation, i))
            a, b, c, d = dynamic(2j*math.pi*9)
            for name, right in zip(("uyuy", "uyuz", "uzuy", "uzuz"), (d, -b, -c, a)):
                found = complex(got[f"real_{name}"], got[f"imaginary_{name}"])
                self.assertLess(abs(found/(right/(a*d - b*c)) - 1), 1e-7, (formulation, name))
            a, b, c, d = dynamic(0)
            self.assertLess(abs(got["y"]/(98.1*b/(a*d - b*c)) - 1), 1e-7)

    def test_onset(self):
        stiffness, damping = 192*200e9*8e-9, 40
        onset = damping*math.sqrt(stiffness/10)
        for part in (0.999, 1.001):
            words = {"stiffness": across(0, part*onset, -part*onset, 0), "damping": across(damping, 0, 0, damping)}
            got = self.values(DAMPED, analyses="d: {modal: {damped: yes}}",
                              quantities="z: {damping_ratio: {analysis: d}}", **words)
            self.assertEqual(got["z"] > 0, part < 1)
            code, told = self.told(DAMPED, analyses="A: {harmonic: {frequencies: [9]}}", quantities=RESPONSES, **words)
            self.assertEqual((code != 0, "a mode grows at" in told), (part > 1, part > 1), told)

    def test_motion(self):
        """A motion z = y + i u of the disc from an initial velocity must satisfy m z'' + (c - i g) z' + (K - i q) z
        = 0 with the mass m, the stiffness K, the damping c, and the cross-coupled stiffness q and damping g. The
        energy balance must include the work of the film."""
        m, K, q, c, g, t = 10, 192*200e9*8e-9 + 1e5, 3e4, 300, 900, 0.03
        half = complex(c, -g)/(2*m)
        root = cmath.sqrt(half**2 - complex(K, -q)/m)
        z = 1e-6*cmath.exp(-half*t)*cmath.sinh(root*t)/root
        rate = 1e-6*cmath.exp(-half*t)*(cmath.cosh(root*t) - half*cmath.sinh(root*t)/root)
        energy = (m*abs(rate)**2 + K*abs(z)**2)/2
        for integrator, step, within in (("radau", 5e-4, 1e-6), ("alpha", 1e-5, 1e-4), ("explicit", 5e-4, 1e-6)):
            got = self.values(DAMPED, stiffness=across(1e5, q, -q, 1e5), damping=across(c, g, -g, c),
                              analyses=f"r: {{motion: {{stations: [{t}], step: {step}, integrator: {integrator}, start: "
                              "{velocity: [0, 1e-6, 0]}}}",
                              quantities="y: {displacement: {analysis: r, node: disc, component: uy}}, "
                              "u: {displacement: {analysis: r, node: disc, component: uz}}, "
                              "lost: {energy: {analysis: r, of: dissipated}}")
            self.assertLess(abs(complex(got["y"], got["u"])/z - 1), within, integrator)
            self.assertLess(abs(got["lost"]/(m*1e-12/2 - energy) - 1), within, integrator)

    def test_part(self):
        part = """beamwork: 1
sections: {s: {constants: {A: 3e-4, Iy: 8e-9, Iz: 8e-9, It: 1.6e-8}, young: 200e9, shear_modulus: 80e9}}
parts:
  rotor:
    places: [end]
    nodes: {disc: {at: [0.5, 0, 0]}}
    members: {shaft: {from: end, to: disc, section: s, y: [0, 1, 0]}}
    springs: {film: {to: disc, stiffness: %(stiffness)s}}
nodes: {wall: {at: [0, 0, 0], hold: all}}
instances: {one: {part: rotor, at: [0, 0, 0], turn: {x: %(turn)s}, connect: {end: wall}}}
loads: {push: {force: [0, 1, 0], on: one.disc}}
analyses: {L: {linear: {}}}
quantities:
  y: {displacement: {analysis: L, node: one.disc, component: uy}}
  z: {displacement: {analysis: L, node: one.disc, component: uz}}
omit: [shear]
"""
        c, s = math.cos(0.5), math.sin(0.5)
        k = ((3e4, 2e4), (-1e4, 2e4))
        R = ((c, -s), (s, c))
        turned = [sum(R[i][a]*k[a][b]*R[j][b] for a in (0, 1) for b in (0, 1)) for i in (0, 1) for j in (0, 1)]
        by_part = self.values(part, stiffness=across(*k[0], *k[1]), turn=0.5)
        in_scene = self.values(part, stiffness=across(*turned), turn=0)
        for name in ("y", "z"):
            self.assertLess(abs(by_part[name]/in_scene[name] - 1), 1e-9)

    def test_refused(self):
        words = {"stiffness": across(*BEARING), "damping": across(*FILM)}
        for analyses, quantities, said in (
                ("m: {modal: {}}", "f: {frequency: {analysis: m}}", "analysis m (modal): spring a (unsymmetric spring) "
                 "has no potential"),
                ("b: {buckling: {}}", "f: {critical_factor: {analysis: b}}", "has no potential"),
                ("r: {rotation: {omega: [9, 0, 0], stations: [1]}}",
                 "f: {displacement: {analysis: r, node: disc, component: uy}}", "has no potential"),
                ("A: {harmonic: {frequencies: [9], solution: modal}}", RESPONSES, "remove 'solution'"),
                ("c: {motion: {stations: [0.1], step: 1e-3, integrator: conserving}}",
                 "f: {displacement: {analysis: c, node: disc, component: uy}}", "spring a has an unsymmetric "
                 "stiffness")):
            code, told = self.told(JOURNAL, analyses=analyses, quantities=quantities, **words)
            self.assertNotEqual(code, 0, analyses)
            self.assertIn(said, told)
        words["stiffness"] = [1e5]*6
        code, told = self.told(JOURNAL, analyses="A: {harmonic: {frequencies: [9], solution: modal}}",
                               quantities=RESPONSES, **words)
        self.assertIn("that of spring a is unsymmetric; remove 'solution'", told)


if __name__ == "__main__":
    unittest.main()
