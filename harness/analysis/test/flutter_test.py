"""Frequencies, growth rates and critical loads (flutter or divergence) under loads without a potential, compared with
closed forms."""
import json
import math
import unittest

from harness.tools.kit.program import ProgramTest, run

COLUMN = """beamwork: 1
sections: {s: {constants: {A: 1e7, Iy: %(Iy)r, Iz: 1, It: 1, Ip: 2e-6}, young: 1, shear_modulus: 1e3%(density)s}}
nodes: {base: {at: [0, 0, 0], hold: all}, tip: {at: %(at)s%(tip)s}}
members: {m: {from: base, to: tip, section: s, y: [0, 0, 1]%(member)s}}
loads: {p: {%(load)s}%(more)s}
analyses: {st: {static: {stations: [1]}}, b: {buckling: {about: st}}, v: {modal: {about: st}}}
quantities:
%(quantities)s
omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia, warping]
"""
CRITICAL = "  P: {critical_factor: {analysis: b}}"
MOTIONS = """  f0: {frequency: {analysis: v, which: 0}}
  f1: {frequency: {analysis: v, which: 1}}
  g: {growth: {analysis: v}}"""
DEFAULT = {"Iy": 3.0, "density": ", density: 1e-7", "at": "[1, 0, 0]", "tip": "", "member": "", "more": "", "quantities": CRITICAL}
FORMULATIONS = ("geometrically_exact", "beamw_consistent", "beamw")
ARCH = """beamwork: 1
sections: {s: {constants: {A: 1e6, Iy: 1, Iz: 1, It: 1}, young: 1, shear_modulus: 1e3%s}}
nodes: {%s}
members: {%s}
loads: {%s}
analyses: {st: {static: {stations: [1]}}, b: {buckling: {about: st}}}
quantities: {P: {critical_factor: {analysis: b}}}
omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia, warping]
"""

# Ziegler's double pendulum with almost rigid bars, springs of 1 N m and masses of 2 and 1 kg. The critical load is 7/2
# - sqrt 2.
ZIEGLER = """beamwork: 1
plane: xy
sections: {s: {constants: {A: 1e7, Iy: %(EI)r, Iz: %(EI)r, It: 1e5}, young: 1, shear_modulus: 1}}
nodes: {a: {at: [0, 0, 0], hold: [ux, uy, uz, rx, ry]}, b: {at: [1, 0, 0], mass: 2}, c: {at: [1, 0, 0]},
        d: {at: [2, 0, 0], mass: 1}}
members: {ab: {from: a, to: b, section: s, y: [0, 1, 0]}, cd: {from: c, to: d, section: s, y: [0, 1, 0]}}
springs: {base: {to: a, stiffness: [0, 0, 0, 0, 0, 1]},
          joint: {from: b, to: c, stiffness: [1e7, 1e7, 1e7, 1e5, 1e5, 1]}}
loads: {p: {force: [-1, 0, 0], on: d, follower: true}}
analyses: {st: {static: {stations: [1]}}, b: {buckling: {about: st}}}
quantities: {P: {critical_factor: {analysis: b}}}
omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia, warping]
"""


def tip_force(size):
    return f"force: [{-size!r}, 0, 0], on: tip, follower: true"


def arch(n, pressure, density=""):
    angle = [math.pi*(2*i/n - 1)/3 for i in range(n + 1)]
    hold = ["ux, uy, uz, rx, ry" if i in (0, n) else "uz, rx, ry" for i in range(n + 1)]
    return ARCH % (
        density,
        ", ".join(f"n{i}: {{at: [{math.sin(a)!r}, {math.cos(a)!r}, 0], hold: [{hold[i]}]}}" for i, a in enumerate(angle)),
        ", ".join(f"m{i}: {{from: n{i}, to: n{i + 1}, section: s, y: [0, 1, 0]}}" for i in range(n)),
        ", ".join(f"p{i}: {{distributed: [0, {-pressure!r}, 0], on: m{i}, axes: member, follower: true}}" for i in range(n)))

WOUND = """beamwork: 1
sections: {s: {constants: {A: 1e6, Iy: 1, Iz: 1, It: 1}, young: 1, shear_modulus: 1%s}}
nodes: {a: {at: [0, 0, 0], hold: [ux, uy, uz, rx]}, b: {at: [1, 0, 0], hold: [uy, uz], drive: {rx: wind}}}
members: {l: {from: a, to: b, section: s, y: [0, 1, 0]}}
motions: {wind: {path: [0, 1], value: [0, %r]}}
loads: {p: {force: [-1, 0, 0], on: b, factor: [0, 0, 20], path: [0, 1, 2]}}
analyses: {st: {static: {stations: [1]}}, bu: {buckling: {about: st}}}
quantities: {P: {critical_factor: {analysis: bu}}}
omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia]
"""


class Flutter(ProgramTest):

    def values(self, text, elements=16, formulation="geometrically_exact", status=0):
        path = self.folder / "scene.yaml"
        path.write_text(text)
        done = run("solve", "--scene", path, "-f", formulation, "-n", elements, "--format", "json")
        self.assertEqual(done.returncode, status, done.stdout[-2000:] + done.stderr)
        return [q.get("value") for q in json.loads(done.stdout)["quantities"]], " ".join((done.stdout + done.stderr).split())

    def critical(self, load, elements=16, formulation="geometrically_exact", **other):
        return self.values(COLUMN % {**DEFAULT, "load": load, **other}, elements, formulation)[0][0]

    def test_beck(self):
        for formulation in FORMULATIONS:
            for elements in (8, 32):
                self.assertLess(abs(self.critical(tip_force(1), elements, formulation)/20.0509536 - 1),
                                3e-4 if elements == 8 else 5e-6, (formulation, elements))
        turned = self.critical("force: [-12, -16, 0], on: tip, follower: true", at="[0.6, 0.8, 0]")
        self.assertLess(abs(turned/self.critical(tip_force(20)) - 1), 1e-6)

    def test_leipholz(self):
        for formulation in FORMULATIONS:
            found = self.critical("distributed: [-7, 0, 0], on: m, follower: true", 32, formulation)
            self.assertLess(abs(7*found/40.0537 - 1), 1e-5, formulation)

    def test_any_load(self):
        for size in (0.02, 19, 21, 20000):
            self.assertLess(abs(size*self.critical(tip_force(size))/20.05132 - 1), 1e-6, size)

    def test_round(self):
        single = self.critical(tip_force(20))
        for Iy in (1.0, 1 + 1e-9, 1.0001):
            self.assertLess(abs(self.critical(tip_force(20), Iy=Iy)/single - 1), 1e-6, Iy)

    def test_pflueger(self):
        for mass, exact in ((0.1, 17.59528), (0.5, 16.06156), (1, 16.21213), (5, 17.56257)):
            self.assertLess(abs(self.critical(tip_force(1), tip=f", mass: {mass}")/exact - 1), 2e-5, mass)

    def test_ziegler(self):
        for EI, part in ((1e4, 1e-4), (1e5, 1e-5)):
            for formulation in FORMULATIONS[:2]:
                found = self.values(ZIEGLER % {"EI": EI}, 1, formulation)[0][0]
                self.assertLess(abs(found/(3.5 - math.sqrt(2)) - 1), part, (EI, formulation))

    def test_damped(self):
        for eta, load in ((1e-2, 10.966), (1e-3, 10.9391)):
            (found,), said = self.values(COLUMN % {**DEFAULT, "load": tip_force(1), "member": f", damping: {eta}"})
            self.assertLess(abs(found/load - 1), 2e-4, eta)
            self.assertRegex(said, "growth with damping")

    def test_what_was_meant(self):
        self.assertRegex(self.values(COLUMN % {**DEFAULT, "load": tip_force(1)})[1], r"flutter, undamped at 1\.75")
        _, said = self.values(COLUMN % {**DEFAULT, "load": tip_force(1), "density": ""}, status=1)
        self.assertRegex(said, "no critical load from path 0 to .* no divergence, and flutter requires mass; add a density to a section")

    def test_of_the_mesh(self):
        for formulation in ("collocation", "beamw", "geometrically_exact"):
            _, said = self.values(COLUMN % {**DEFAULT, "load": tip_force(1), "density": ""}, 4, formulation, status=1)
            self.assertRegex(said, "is an artefact of the mesh|no critical load from path 0 to", formulation)

    def test_wound(self):
        for density in ("", ", density: 1e-9"):
            for angle in (0, 1e-9, 1, 3, 3.5, 5, 10):
                found = self.values(WOUND % (density, angle), 8, "collocation")[0][0]
                exact = 1 + (math.pi**2 - angle**2/4)/20 if angle < 2*math.pi else 2*math.pi/angle
                self.assertLess(abs(found/exact - 1), 1e-5, (density, angle))

    def test_with_damping_or_without(self):
        one = self.folder / "scene.yaml"
        said, found = {}, {}
        for follows in ("", ", follower: true"):
            for eta in (0, 1e-2):
                one.write_text((COLUMN % {**DEFAULT, "load": "force: [-1, 0, 0], on: tip" + follows, "member": f", damping: {eta}",
                                          "quantities": CRITICAL + "\n" + MOTIONS + "\n  w: {frequency: {analysis: w, which: 0}}"})
                               .replace("v: {modal: {about: st}}", "v: {modal: {about: st}}, w: {modal: {}}"))
                done = run("solve", "--scene", one, "-f", "geometrically_exact", "-n", 8, "--format", "json")
                rows = json.loads(done.stdout)["quantities"]
                said[follows, eta] = [row["meaning"] for row in rows]
                found[follows, eta] = [row["value"] for row in rows]
                if eta > 0:
                    self.assertEqual(rows[4]["value"], undamped, follows)
                    self.assertRegex(run("solve", "--scene", one, "-f", "geometrically_exact", "-n", 8).stdout,
                                     r"\nw  .*, undamped\n")
                undamped = rows[4]["value"]
        self.assertEqual(said["", 0], [""] * 5)
        self.assertEqual(said["", 1e-2], [""] + ["undamped"] * 4)
        flutter = r"flutter, undamped at 1\.75", "flutter, growth with damping at 0\\.859"
        self.assertRegex(said[", follower: true", 0][0], flutter[0])
        self.assertRegex(said[", follower: true", 1e-2][0], flutter[1])
        self.assertEqual(said[", follower: true", 0][1:], [""] * 4)
        self.assertEqual(said[", follower: true", 1e-2][1:], ["undamped", "undamped", "with damping", "undamped"])
        for now, plain in zip(found[", follower: true", 1e-2][1:3], found[", follower: true", 0][1:3]):
            self.assertLess(abs(now/plain - 1), 1e-9)

    def test_dashpot_under_a_follower_load(self):
        for size in (10.0, 21.0):
            scene = COLUMN % {**DEFAULT, "load": tip_force(size), "quantities": MOTIONS}
            plain = self.values(scene)[0]
            for damping in (1e-4, 0.3):
                found, _ = self.values(scene + "springs: {d: {to: tip, damping: [0, 0, %r, 0, 0, 0]}}\n" % damping)
                for i in (0, 1):
                    self.assertLess(abs(found[i]/plain[i] - 1), 1e-9, (size, damping))
                self.assertEqual(found[2] > 0, size > 20.05, (size, damping))
                if size > 20.05:
                    self.assertGreater(abs(found[2]/plain[2] - 1), damping/100)

    def test_growth(self):
        sums = []
        for size in (20.0, 20.04, 20.06, 20.1):
            (f0, f1, growth), _ = self.values(COLUMN % {**DEFAULT, "load": tip_force(size), "quantities": MOTIONS, "Iy": 100.0})
            (self.assertGreater if size > 20.0513 else self.assertEqual)(growth, 0)
            sums.append(((2*math.pi*f0)**2 + (2*math.pi*f1)**2)/2 - growth**2)
        self.assertLess(abs(sums[1]/11.0156**2 - 1), 2e-3)
        slope = [(sums[i + 1] - sums[i])/h for i, h in ((0, 0.04), (1, 0.02), (2, 0.04))]
        self.assertLess(max(slope) - min(slope), 0.02*abs(slope[0]))

    def test_zero(self):
        dead = {"load": "force: [-1, 0, 0], on: tip", "quantities": CRITICAL + "\n" + MOTIONS}
        plain = self.values(COLUMN % {**DEFAULT, **dead})[0]
        self.assertEqual(plain[3], 0)
        for zero in (", z: {force: [0, 0, 0], on: tip, follower: true}",
                     ", z: {distributed: [0, 0, 0], on: m, follower: true}", ", z: {moment: [0, 0, 0], on: tip}"):
            self.assertEqual(self.values(COLUMN % {**DEFAULT, **dead, "more": zero})[0], plain, zero)

    def test_arch(self):
        for density in ("", ", density: 1e-6"):
            for formulation in FORMULATIONS[:2]:
                found = [self.values(arch(n, 3.0, density), 1, formulation)[0][0]*3 for n in (8, 16)]
                self.assertLess(abs((4*found[1] - found[0])/3 - 8), 8e-3, (formulation, found))


if __name__ == "__main__":
    unittest.main()
