"""Rotations beyond 180 degrees, symmetry of tangents, base states of analyses, and sheets with invalid input."""
import json
import math
import resource
import unittest

from harness.tools.kit.program import ProgramTest, run


# Euler's load is 1, because E Iz = 4 L^2/pi^2 for the clamped column, whose shortening is negligible.
COLUMN = """beamwork: 1
sections: {s: {constants: {A: 1e6, Iy: %(Iy)r, Iz: %(Iz)r, It: 1}, young: 1, shear_modulus: 1}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}
loads: {p: {force: [%(force)r, 0, 0], on: b}%(more)s}
analyses: {path: {static: {stations: [1]}}, about: {buckling: {about: path, wanted: 4}}}
quantities:
  P_$i: {for: {i: 0..%(last)d}, critical_factor: {analysis: about, which: $i}, unit: 1}
omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia]
"""
I = 4 / math.pi ** 2
ZERO = ", z: {moment: [0, 0, 0], on: b}"


class AboutState(ProgramTest):

    def factors(self, formulation="collocation", force=-1, Iy=I, last=0, more="", status=0):
        path = self.folder / "scene.yaml"
        path.write_text(COLUMN % {"force": force, "Iy": Iy, "Iz": I, "last": last, "more": more})
        done = run("solve", "--scene", path, "-f", formulation, "-n", 8, "--format", "json")
        self.assertEqual(done.returncode, status, done.stdout[-3000:] + done.stderr)
        return ([q.get("value") for q in json.loads(done.stdout)["quantities"]],
                " ".join((done.stdout + done.stderr).split()))

    def test_any_load(self):
        for formulation in ("collocation", "geometrically_exact", "beamw_consistent"):
            for force in (1e-3, 0.5, 0.99, 1.01, 30, 1000):
                (factor,), _ = self.factors(formulation, -force)
                self.assertLess(abs(factor * force - 1), 1e-3, (formulation, force))

    def test_several(self):
        for Iy in (I, I * (1 + 1e-9), I * (1 - 1e-6), I * (1 + 1e-3), 3 * I):
            for force in (0.01, 0.5, 20):
                found, _ = self.factors(force=-force, Iy=Iy, last=3)
                exact = sorted([1, 9, 25, Iy / I, 9 * Iy / I])
                for value, right in zip(found, exact):
                    self.assertLess(abs(value * force / right - 1), 4e-3, (Iy, force, found))

    def test_zero_load(self):
        self.assertEqual(self.factors(more=ZERO)[0], self.factors()[0])

    def test_none(self):
        found, said = self.factors(force=1, status=1)
        self.assertEqual(found, [None])
        self.assertRegex(said, r"no critical load from path 1 to [0-9.e+]+, because the structure does not lose its stiffness")


BAR = """beamwork: 1
sections: {s: {rectangle: {width: 0.05, thickness: 0.005}, young: 210e9, shear_modulus: 81e9,
               density: 7850}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}
"""
LOADS = {"moment": "{moment: [%(s)s, 0, %(s)s], on: b}",
         "clamped": "{moment: [%(s)s, %(s)s, %(s)s], on: a}",
         "following": "{force: [0, %(s)s, 0], on: b, follower: true}",
         "spread": "{distributed_moment: [0, 0, %(s)s], on: m}"}
FORMULATIONS = ("collocation", "beamw", "geometrically_exact")


class Symmetry(ProgramTest):

    def written(self, scene):
        path = self.folder / "scene.yaml"
        path.write_text(scene)
        return path

    def values(self, scene, formulation="collocation", n=8, status=0):
        done = run("solve", "--scene", self.written(scene), "-f", formulation, "-n", n, "--format", "json")
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return {q["quantity"]: q for q in json.loads(done.stdout)["quantities"]}

    def test_frequencies_of_the_unloaded(self):
        rest = """analyses: {path: {static: {stations: [1]}}, v: {modal: {wanted: 2}}}
quantities:
  f_$i: {for: {i: 0..1}, frequency: {analysis: v, which: $i}, unit: Hz}
  u: {displacement: {analysis: path, node: b, component: uy}, unit: m}
"""
        for formulation in FORMULATIONS:
            bare = self.values(BAR + rest, formulation)
            for name, load in LOADS.items():
                found = self.values(BAR + "loads: {t: %s}\n" % (load % {"s": 0.5}) + rest,
                                    formulation)
                for f in ("f_0", "f_1"):
                    self.assertEqual(found[f]["value"], bare[f]["value"], (formulation, name, f))
        exact = 4.178
        fine = self.values(BAR + "loads: {t: {moment: [0, 0, 1], on: b}}\n" + rest,
                           "geometrically_exact", 16)
        self.assertLess(abs(fine["f_0"]["value"] / exact - 1), 1e-3)

    def test_zero_loads_about_a_state(self):
        rest = """analyses:
  path: {static: {stations: [1]}}
  v: {modal: {about: path, wanted: 2}}
  b: {buckling: {about: path, wanted: 1}}
quantities:
  f_$i: {for: {i: 0..1}, frequency: {analysis: v, which: $i}, unit: Hz}
  P: {critical_factor: {analysis: b, which: 0}, unit: 1}
  u: {displacement: {analysis: path, node: b, component: uy}, unit: m}
"""
        pressed = "loads: {p: {force: [-200, 0, 0], on: b}%s}\n"
        for formulation in ("collocation",):
            bare = self.values(BAR + pressed % "" + rest, formulation)
            for name, load in LOADS.items():
                more = pressed % (", zero: " + load % {"s": 0})
                found = self.values(BAR + more + rest, formulation)
                for q, value in bare.items():
                    self.assertEqual(found[q]["value"], value["value"], (formulation, name, q))

    def test_bent_column(self):
        scene = BAR + """loads: {p: {force: [-200, 0.5, 0], on: b}}
analyses: {path: {static: {stations: [1]}}, b: {buckling: {about: path}}}
quantities: {P: {critical_factor: {analysis: b}}}
"""
        for formulation in FORMULATIONS:
            for n in (4, 8, 16, 32, 64):
                if (formulation, n) != ("beamw", 16):
                    self.assertIsNone(self.values(scene, formulation, n, 1)["P"].get("value"), (formulation, n))

    def test_bent_column_by_stations(self):
        scene = BAR + """loads: {p: {force: [-200, 0.5, 0], on: b}}
analyses: {path: {static: {stations: %r}}}
quantities: {u: {displacement: {analysis: path, node: b, component: uy}, unit: m}}
"""
        for formulation in ("collocation", "geometrically_exact", "beamw_consistent"):
            for n in (8, 32):
                many = [1 + 0.01*i for i in range(51)]
                fine = self.values(scene % many, formulation, n)["u"]["value"]
                self.assertTrue(0.4 < fine < 0.7, fine)
                for few in ([1.5], [1, 1.5], [1.2, 1.5], [1, 1.2, 1.3, 1.35, 1.4, 1.5]):
                    done = run("solve", "--scene", self.written(scene % few), "-f", formulation, "-n", n, "--format", "json")
                    record = json.loads(done.stdout)
                    found, last = record["quantities"][0]["value"], record["steps"][-1]["stability"]
                    self.assertTrue(abs(found/fine - 1) < 1e-8 or last == "unstable (1)", (formulation, n, few, found, last))
                self.assertEqual(last, "stable")

    def test_what_is_not_symmetric_has_frequencies(self):
        rest = """analyses: {path: {static: {stations: [1]}}, v: {modal: {about: path, wanted: 1}}}
quantities: {f: {frequency: {analysis: v, which: 0}, unit: Hz}}
"""
        loaded, unloaded = (self.values(BAR + "loads: {t: %s}\n" % (LOADS["moment"] % {"s": size}) + rest)["f"]["value"]
                            for size in (5, 0))
        self.assertNotEqual(loaded, unloaded)
        self.assertLess(abs(loaded/unloaded - 1), 1e-2)


ROD = "sections: {s: {constants: {A: 1e-4, Iy: 1e-9, Iz: 1e-9, It: 2e-9}, young: 200e9, shear_modulus: 80e9}}\n"
WOUND = """beamwork: 1
""" + ROD + """parameters: {angle: {value: 10, unit: rad, min: -200, max: 200, about: "of the end that is driven"}}
nodes:
  a: {at: [0, 0, 0], hold: [ux, uy, uz], rotation: {sequence: [{axis: x, angle: wind}, {axis: y, angle: held}, {axis: z, angle: held}]}}
  b: {at: [1, 0, 0], hold: [uy, uz, ry, rz]}
motions: {wind: {unit: rad, path: [0, 1], value: [0, angle]}}
members: {rod: {from: a, to: b, section: s, y: [0, 1, 0]}}
springs: {k: {to: b, stiffness: [0, 0, 0, 5, 0, 0]}}
analyses: {st: {static: {stations: [0.2, 0.3, 0.5, 1], steps: %d}}}
quantities:
  M:     {internal: {analysis: st, member: rod, end: from, resultant: Mx}}
  curve: {internal: {analysis: st, member: rod, end: from, resultant: Mx, take: curve}}
  turn:  {displacement: {analysis: st, node: b, component: rx, take: curve}}
"""
# Torsional stiffness G It/L = 160 N m/rad; bending stiffness E I/L = 200 N m/rad
TWISTED = """beamwork: 1
""" + ROD + """parameters: {load: {value: 1600, unit: N m, min: 0, max: 1e5, about: "at the end"}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]%s}}
members: {rod: {from: a, to: b, section: s, y: [0, 1, 0]}}
loads: {end: {moment: [%s], on: b}}
analyses: {st: {static: {stations: [0.1, 0.2, 0.5, 1], steps: 4}}}
omit: [trapeze, wagner_torque, shear]
quantities:
  last:  {displacement: {analysis: st, node: b, component: %s}}
  curve: {displacement: {analysis: st, node: b, component: %s, take: curve}}
"""
DRIVEN = """beamwork: 1
""" + ROD + """parameters: {angle: {value: 10, unit: rad, min: -100, max: 100, about: "of the driven end"}}
nodes:
  a: {at: [0, 0, 0], hold: all}
  b: {at: [1, 0, 0], hold: [uy, uz], rotation: {sequence: [{axis: x, angle: turn}, {axis: y, angle: held}, {axis: z, angle: held}]}}
motions: {turn: {unit: rad, path: [0, 1], value: [0, angle]}}
members: {rod: {from: a, to: b, section: s, y: [0, 1, 0]}}
analyses: {st: {static: {stations: [1], steps: 10}}}
omit: [trapeze, wagner_torque]
quantities: {M: {internal: {analysis: st, member: rod, end: from, resultant: Mx}}}
"""
SPINNING = """beamwork: 1
sections: {s: {constants: {A: 1e-4, Iy: 1e-9, Iz: 1e-9, It: 2e-9}, young: 200e9, shear_modulus: 80e9, density: 7800}}
nodes:
  a: {at: [0, 0, 0], hold: [ux, uy, uz, ry, rz]}
  b: {at: [0.3, 0, 0], hold: [uy, uz, ry, rz], mass: 1, inertia: [1e-3, 1e-3, 1e-3, 0, 0, 0]}
members: {shaft: {from: a, to: b, section: s, y: [0, 1, 0]}}
analyses: {m: {motion: {stations: [%s], step: 0.01, integrator: %s, start: {spin: [10, 0, 0]}}}}
quantities:
  rx:   {displacement: {analysis: m, node: b, component: rx}}
  most: {displacement: {analysis: m, node: b, component: rx, take: max}}
"""
EVERY = ("beamw", "beamw_consistent", "beamw_first", "beamw_vlasov", "collocation", "geometrically_exact", "sheet_second",
         "sheet_second_consistent", "sheet_third")


class Turns(ProgramTest):

    def scene(self, text):
        path = self.folder / "scene.yaml"
        path.write_text(text)
        return path

    def solved(self, text, formulation, n, *more):
        record = self.record("solve", "--scene", self.scene(text), "-f", formulation, "-n", n, *more)
        values = {q["quantity"]: q["value"] for q in record["quantities"]}
        return values, {c["quantity"]: c["curve_value"] for c in record["curves"]}

    def test_wound_spring(self):
        for formulation in EVERY:
            for angle, steps in ((10, 4), (-10, 4), (100, 40)):
                values, curves = self.solved(WOUND % steps, formulation, 16, "--set", f"angle={angle}")
                right = -angle/(1/160 + 1/5)
                within = (2e-3 if formulation.startswith("beamw") and formulation != "beamw_consistent" else 1e-6)
                self.assertLess(abs(values["M"]/right - 1), within*max(1, angle*angle/100), (formulation, angle))
                for part, torque, turn in zip((0.2, 0.3, 0.5, 1), curves["curve"], curves["turn"]):
                    self.assertLess(abs(torque/(right*part) - 1), within*max(1, angle*angle/100), (formulation, angle))
                    self.assertLess(abs(turn/(-right*part/5) - 1), within*max(1, angle*angle/100), (formulation, angle))

    def test_readings(self):
        for component, hold, moment, stiffness in (("rx", ", hold: [uy, uz, ry, rz]", "load, 0, 0", 160),
                                                   ("rz", "", "0, 0, load", 200), ("ry", "", "0, load, 0", 200)):
            for formulation in ("collocation", "geometrically_exact", "beamw_consistent"):
                scene = TWISTED % (hold, moment, component, component)
                values, curves = self.solved(scene, formulation, 32, "--set", f"load={10*stiffness}")
                self.assertAlmostEqual(values["last"], 10, delta=0.01)
                for part, turn in zip((0.1, 0.2, 0.5, 1), curves["curve"]):
                    self.assertAlmostEqual(turn, 10*part, delta=0.01, msg=(formulation, component))

    def test_elements(self):
        for formulation in EVERY:
            for n, angle in ((1, 0.7), (1, 1.5), (1, 3.2), (1, 10), (2, 5), (3, 10), (8, 10), (64, 10), (64, -30)):
                done = run("solve", "--scene", self.scene(DRIVEN), "-f", formulation, "-n", n, "--set",
                                f"angle={angle}", "--format", "json")
                if done.returncode != 0:
                    self.assertRegex(done.stdout + done.stderr, r"element \d+ of \d+ of member rod (has a relative rotation of|is twisted by) "
                                     ".*use more elements", (formulation, n, angle))
                    self.assertGreater(abs(angle/n), 0.78 if formulation.startswith("beamw") else 1.57)
                    continue
                torque, = (q["value"] for q in json.loads(done.stdout)["quantities"])
                part = angle/n
                if formulation.startswith("beamw") and formulation != "beamw_consistent":
                    right = math.sin(2*part)/(2*part)
                    within = 1e-6
                else:
                    right, within = 1, 5e-2 if formulation == "geometrically_exact" else 1e-6
                self.assertLess(abs(torque/(160*angle)/right - 1), within, (formulation, n, angle))

    def test_spin_in_time(self):
        for integrator, within in (("alpha", 1e-3), ("conserving", 0.02), ("radau", 1e-3)):
            values, _ = self.solved(SPINNING % ("2", integrator), "collocation", 1)
            self.assertAlmostEqual(values["rx"], 20, delta=within, msg=integrator)
            self.assertAlmostEqual(values["most"], 20, delta=within, msg=integrator)
            ends = self.folder / f"{integrator}.h5"
            self.answered("solve", "--scene", self.scene(SPINNING % ("1", integrator)), "-f", "collocation", "-n", 1, "--save-state", ends)
            values, _ = self.solved(SPINNING % ("1, 2", integrator), "collocation", 1, "--restart", ends)
            self.assertAlmostEqual(values["rx"], 20, delta=within, msg=integrator)


def question(case, formulation, n, *assignments, memory=None):
    """Returns the arguments of the command and a function that limits its memory to `memory` [bytes]."""
    def limit():
        if memory:
            resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    sets = [word for a in assignments for word in ("--set", a)]
    return ("solve", case, "-f", formulation, "-n", n, "--format", "json", *sets), limit


def solve(*arguments, **options):
    words, limit = question(*arguments, **options)
    return run(*words, preexec_fn=limit)


class BadInput(ProgramTest):

    def denied(self, words, *arguments, **options):
        said, limit = question(*arguments, **options)
        self.refused(2, words, *said, preexec_fn=limit)

    def test_sizes(self):
        for case in ("sheet_cantilever", "sheet_wagner", "spherical_joint"):
            for name in ("thickness", "width"):
                for value in ("0", "-0.01", "nan", "inf", "1e-400", ""):
                    self.denied([name], case, "sheet_third", 1, f"{name}={value}")
        for name in ("length", "young", "density"):
            for value in ("0", "-1"):
                self.denied([name, "range"], "sheet_cantilever", "collocation", 1,
                            f"{name}={value}")

    def test_poisson(self):
        for value in ("0.5", "0.7", "-1", "-2"):
            self.denied(["poisson", "range"], "sheet_cantilever", "sheet_second", 1,
                        f"poisson={value}")

    def test_deflection_beyond_the_length(self):
        for case in ("sheet_cantilever", "sheet_wagner"):
            for value in ("0.1", "-0.1", "5"):
                self.denied(["tip_deflection", "length", "smaller"], case, "collocation", 1,
                            f"tip_deflection={value}")

    def test_meshes(self):
        for n in (0, -3, 2.5, 99999999999999):
            self.denied(["elements", "whole number"], "sheet_cantilever", "sheet_third", n)

    def test_memory(self):
        if solve("sheet_cantilever", "sheet_third", 1, memory=2 ** 30).returncode != 0:
            self.skipTest("this build cannot run with limited memory (sanitizers)")
        self.denied(["300000 elements", "memory", "give fewer"], "sheet_cantilever", "sheet_third",
                    300000, memory=2 ** 30)
        self.denied(["memory", "newton=mixed"], "sheet_cantilever", "sheet_third:newton=dense",
                    4000, memory=2 ** 32)

    def test_choices(self):
        self.denied(["moment_convention", "spatial|semitangential|symmetrised"], "sheet_cantilever",
                    "sheet_third", 1, "moment_convention=dead")
        self.denied(["modes", "range"], "sheet_cantilever", "sheet_third", 1, "modes=7")


class Extremes(unittest.TestCase):
    def test_answer_or_reason(self):
        answers = 0
        for length, slenderness, deflection in ((0.05, 10, 0.5), (0.05, 1000, 0.5), (2, 10, 0.5),
                                                (2, 1000, 0.5), (0.1, 1000, 0.01),
                                                (0.1, 10, 0.999)):
            for formulation in ("sheet_third", "collocation", "geometrically_exact",
                                "beamw_consistent"):
                done = solve("sheet_cantilever", formulation, 4, f"length={length}",
                             f"thickness={0.1 / slenderness}",
                             f"tip_deflection={deflection * length}")
                at = (formulation, length, slenderness, deflection, done.stderr)
                Phi = 2.6 / (13 / 15.3) * (0.1 / slenderness / length) ** 2
                self.assertIn(done.returncode, (0, 1), at)
                if done.returncode == 0:
                    answers += 1
                    thick = formulation == "sheet_third" and Phi > 0.01
                    left_out = json.loads(done.stdout)["cell"]["left_out"]
                    self.assertEqual("physics: shear along y" in left_out, thick, at)
                    values = {q["quantity"]: q["value"]
                              for q in json.loads(done.stdout)["quantities"]}
                    self.assertTrue(all(v is not None and math.isfinite(v)
                                        for v in values.values()), at)
                    self.assertGreater(values["C_xx"], 0, at)
                    self.assertGreater(values["C_zz"], 0, at)
                else:
                    self.assertEqual(len(done.stderr.splitlines()), 1, at)
        self.assertGreaterEqual(answers, 20)


if __name__ == "__main__":
    unittest.main()
