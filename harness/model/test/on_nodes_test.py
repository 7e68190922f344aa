"""Loads and masses that are lumped at nodes must be reported, with their order of convergence in space."""
import json
import math
import unittest

from harness.tools.kit.program import ProgramTest, run

SCENE = """beamwork: 1
sections: {s: {rectangle: {width: 0.02, thickness: 0.01}, young: 2e11, shear_modulus: 8e10%s}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]}}
members: {beam: {from: a, to: b, section: s, y: [0, 1, 0]}}
loads: {%s}
analyses: {%s}
quantities: {u: {displacement: {analysis: run, node: b, component: uy}}}
"""
MORE = "(more than two nodes: weights that integrate the polynomial through them; order 4 or more)"
SHARES = f": half of an element's load at each of its nodes; order 2 in the length of the element {MORE}"
MASSES = (": at the nodes, weighted along each member; order 4 in slender bending for 6 or more elements, order 2 "
          f"with shear, stretch and twist {MORE}")
HEAVY = ", density: 7800"
LOADS = "d: {distributed: [0, 20, 0], on: beam%s}, w: {gravity: [0, -9.81, 0], on: beam}"
MOTION = ("run: {motion: {stations: [0.001], integrator: %s, step: 1e-3%s}}")

BAR = """beamwork: 1
mass: lumped
omit: [shear, rotary_inertia]
sections: {s: {rectangle: {width: 0.1, thickness: 0.1}, young: 2e11, shear_modulus: 8e10, density: 7800}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]}}
members: {bar: {from: a, to: b, section: s, y: [0, 1, 0]}}
analyses: {v: {modal: {wanted: 12}}}
quantities: {f: {frequency: {analysis: v, which: 0%s}}}
"""
ROD = """beamwork: 1
sections:
  s: {rectangle: {width: 10e-3, thickness: 10e-3}, young: 2e11, shear_modulus: 8e10, density: 7800, given: {Iw: 0}}
nodes: {a: {at: [-0.4, 0, 0]}, b: {at: [0.4, 0, 0]}}
members: {rod: {from: a, to: b, section: s, y: [0, 1, 0]}}
plane: xy
analyses: {m: {motion: {stations: [1e-4], step: 1e-5, integrator: %s, start: {spin: [0, 0, 2]}}}}
quantities: {L: {momentum: {analysis: m, component: lz}}}
"""
CLAMPED = """beamwork: 1
mass: lumped
sections: {s: {rectangle: {width: 10e-3, thickness: 10e-3}, young: 2e11, shear_modulus: 8e10, density: 7800}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]}}
members: {rod: {from: a, to: b, section: s, y: [0, 1, 0]}}
plane: xy
"""
TURNING = CLAMPED + """analyses: {m: {rotation: {stations: [1], omega: [0, 0, 10]}}}
quantities: {N: {internal: {analysis: m, member: rod, where: 0.3, resultant: N}}}
"""
WEIGHED = CLAMPED + """loads: {w: {gravity: [0, -0.01, 0], on: all}}
analyses: {st: {static: {stations: [1]}}, m: {motion: {about: st, stations: [1e-3], step: 1e-4, integrator: conserving}}}
quantities:
  M: {internal: {analysis: st, member: rod, where: 0.3, resultant: Mz}}
  V: {internal: {analysis: st, member: rod, where: 0.3, resultant: Qy}}
"""
WIDER = """
  t: {rectangle: {width: 20e-3, thickness: 10e-3}, young: 2e11, shear_modulus: 8e10, density: 7800, given: {Iw: 0}}
nodes:"""


class OnNodes(ProgramTest):

    def cell(self, scene, elements=2, formulation="beamw"):
        path = self.folder / "scene.yaml"
        path.write_text(scene, encoding="utf-8")
        done = run("solve", "--scene", path, "-f", formulation, "-n", elements, "--format", "json")
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)
        return found["cell"]["lumped"], found["quantities"][0]["value"]

    def test_nothing_is(self):
        self.assertEqual(self.cell(SCENE % (HEAVY, LOADS % "", "run: {linear: {}}"))[0], "")

    def test_a_load_that_asks_for_it(self):
        told, _ = self.cell(SCENE % (HEAVY, LOADS % ", lumped: yes", "run: {linear: {}}"))
        self.assertEqual(told, "load d" + SHARES)

    def test_orders_of_what_is(self):
        load = "d: {distributed: [0, 20, 0], to_value: [0, 5, 0], on: beam%s}"
        for formulation, order in (("beamw", 2), ("geometrically_exact:nodes=3", 4)):
            exact = self.cell(SCENE % ("", load % "", "run: {linear: {}}"), 2, formulation)[1]
            error = [abs(self.cell(SCENE % ("", load % ", lumped: yes", "run: {linear: {}}"), n,
                                   formulation)[1] / exact - 1) for n in (4, 8, 16)]
            for coarse, fine in zip(error, error[1:]):
                self.assertAlmostEqual(math.log2(coarse / fine), order, delta=0.05)

    def test_halves(self):
        """With one element, half of a lumped uniform load q acts at the tip, so the deflection must be (q L/2) L^3/(3
        EI) instead of q L^4/(8 EI)."""
        scene = SCENE.replace("beamwork: 1", "beamwork: 1\nomit: [shear]") % ("", "d: {distributed: [0, 20, 0], on: beam%s}",
                                                                            "run: {linear: {}}")
        exact, lumped = (self.cell(scene % how, 1)[1] for how in ("", ", lumped: yes"))
        self.assertAlmostEqual(lumped / exact, 4/3, delta=1e-9)

    def test_motions(self):
        for integrator, more, what in (("conserving", "", " and loads along members"),
                                       ("alpha", ", mass: lumped", " and weight")):
            told, _ = self.cell(SCENE % (HEAVY, LOADS % "", MOTION % (integrator, more)))
            self.assertEqual(told, "mass" + what + " of analysis run" + MASSES)
        told, _ = self.cell(SCENE % (HEAVY, LOADS % "", MOTION % ("alpha", ", mass: consistent")),
                            formulation="beamw_consistent:mass=consistent")
        self.assertEqual(told, "")

    def test_load_and_mass(self):
        told, _ = self.cell(SCENE % (HEAVY, LOADS % ", lumped: yes", MOTION % ("conserving", "")))
        self.assertEqual(told, "load d" + SHARES + "; mass and loads along members of analysis run" + MASSES)

    def frequency(self, elements, bending):
        path = self.folder / "bar.yaml"
        path.write_text(BAR % ("" if bending else ", family: axial"), encoding="utf-8")
        done = run("solve", "--scene", path, "-f", "collocation", "-n", elements, "--format", "json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)["quantities"][0]["value"]

    def test_order_of_masses_at_nodes(self):
        exact = 1.8751040687119611**2 * math.sqrt(2e11 * 0.1**2 / 12 / 7800) / (2 * math.pi)
        error = [abs(self.frequency(n, True) / exact - 1) for n in (6, 12, 24)]
        for coarse, fine in zip(error, error[1:]):
            self.assertGreater(math.log2(coarse / fine), 3.8)
        self.assertLess(error[0], 4e-4)
        stretch = math.sqrt(2e11 / 7800) / 4
        error = [abs(self.frequency(n, False) / stretch - 1) for n in (8, 16, 32)]
        for coarse, fine in zip(error, error[1:]):
            self.assertAlmostEqual(math.log2(coarse / fine), 2, delta=0.1)

    def test_few_elements(self):
        exact = 1.8751040687119611**2 * math.sqrt(2e11 * 0.1**2 / 12 / 7800) / (2 * math.pi)
        for elements, bound in ((1, 0.32), (2, 0.03), (3, 6e-3), (4, 1.5e-3), (5, 1e-3), (7, 2e-4)):
            value = self.frequency(elements, True)
            self.assertLess(abs(value / exact - 1), bound, elements)

    def test_rigid_rods_have_their_inertia(self):
        """The shares of mass at nodes integrate cubics exactly, so a rigid rod of mass m and length L with two or
        more elements must have the moment of inertia m L^2/12, plus the rotary inertia of its sections, within
        1e-11."""
        for integrator in ("conserving", "explicit"):
            for elements in (2, 3, 4, 5, 6, 9):
                path = self.folder / "rod.yaml"
                path.write_text(ROD % integrator, encoding="utf-8")
                done = run("solve", "--scene", path, "-f", "beamw_consistent", "-n", elements, "--format", "json")
                self.assertEqual(done.returncode, 0, done.stderr)
                right = 7800 * (1e-4 * 0.8**3 / 12 + 0.8 * 1e-8 / 12) * 2
                self.assertAlmostEqual(json.loads(done.stdout)["quantities"][0]["value"] / right, 1, delta=1e-11)

    def test_resultants_beside_masses_at_nodes(self):
        for elements in (1, 2, 3, 4, 6, 9):
            for scene, right in ((TURNING, {"N": 7800*1e-4*100*(1 - 0.09)/2}),
                                 (WEIGHED, {"M": -7800*1e-4*0.01*0.49/2, "V": -7800*1e-4*0.01*0.7})):
                path = self.folder / "rod.yaml"
                path.write_text(scene, encoding="utf-8")
                done = run("solve", "--scene", path, "-f", "collocation", "-n", elements, "--format", "json")
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                for q in json.loads(done.stdout)["quantities"]:
                    self.assertAlmostEqual(q["value"] / right[q["quantity"]], 1, delta=1e-5, msg=(elements, q))

    def test_changing_members_keep_their_mass(self):
        for elements in (2, 3, 6):
            path = self.folder / "rod.yaml"
            path.write_text(ROD.replace("section: s", "section: [s, t]").replace("\nnodes:", WIDER).replace(
                "component: lz", "component: px").replace("spin: [0, 0, 2]", "velocity: [1, 0, 0]")
                            % "conserving", encoding="utf-8")
            done = run("solve", "--scene", path, "-f", "beamw_consistent", "-n", elements, "--format", "json")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertAlmostEqual(json.loads(done.stdout)["quantities"][0]["value"], 7800 * 1.5e-4 * 0.8, delta=1e-9)

    def test_in_text(self):
        path = self.folder / "scene.yaml"
        path.write_text(SCENE % ("", LOADS.partition(", w")[0] % ", lumped: yes",
                                 "run: {linear: {}}"), encoding="utf-8")
        done = run("solve", "--scene", path, "-f", "beamw", "-n", "2")
        self.assertIn("lumped: load d" + SHARES, " ".join(done.stdout.split()))


if __name__ == "__main__":
    unittest.main()
