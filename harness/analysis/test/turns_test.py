"""Turns beyond half a circle: springs, drives and readings follow them, in statics, in turning axes and in motion; elements
follow as far as they say, and are refused by name beyond."""
import json
import math
import unittest

from harness.tools.kit.program import ProgramTest, run

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
# G It/L = 160 N m/rad; in bending E I/L = 200.
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
# Driven: 160 N m/rad times the angle, with one element as with many, or no value.
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
# A disc on a shaft that spins freely.
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
        """In proportion to the angle, through several turns, either way, with few and many steps."""
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
        """A node turns by 10 rad, about its axis and across it."""
        for component, hold, moment, stiffness in (("rx", ", hold: [uy, uz, ry, rz]", "load, 0, 0", 160),
                                                   ("rz", "", "0, 0, load", 200), ("ry", "", "0, load, 0", 200)):
            for formulation in ("collocation", "geometrically_exact", "beamw_consistent"):
                scene = TWISTED % (hold, moment, component, component)
                values, curves = self.solved(scene, formulation, 32, "--set", f"load={10*stiffness}")
                self.assertAlmostEqual(values["last"], 10, delta=0.01)
                for part, turn in zip((0.1, 0.2, 0.5, 1), curves["curve"]):
                    self.assertAlmostEqual(turn, 10*part, delta=0.01, msg=(formulation, component))

    def test_elements(self):
        """Right, or refused by the name of the element and with the remedy."""
        for formulation in EVERY:
            for n, angle in ((1, 0.7), (1, 1.5), (1, 3.2), (1, 10), (2, 5), (3, 10), (8, 10), (64, 10), (64, -30)):
                done = run("solve", "--scene", self.scene(DRIVEN), "-f", formulation, "-n", n, "--set",
                                f"angle={angle}", "--format", "json")
                if done.returncode != 0:
                    self.assertRegex(done.stdout + done.stderr, r"element \d+ of \d+ of member rod is (turned|twisted) by "
                                     ".*use more elements", (formulation, n, angle))
                    self.assertGreater(abs(angle/n), 0.78 if formulation.startswith("beamw") else 1.57)
                    continue
                torque, = (q["value"] for q in json.loads(done.stdout)["quantities"])
                part = angle/n
                if formulation.startswith("beamw") and formulation != "beamw_consistent":
                    right = math.sin(2*part)/(2*part)  # strain sin: what that formulation is, coarse as it is
                    within = 1e-6
                else:
                    right, within = 1, 5e-2 if formulation == "geometrically_exact" else 1e-6
                self.assertLess(abs(torque/(160*angle)/right - 1), within, (formulation, n, angle))

    def test_spin_in_time(self):
        """Read through several turns, by every integrator; after a restart too."""
        for integrator, within in (("alpha", 1e-3), ("conserving", 0.02), ("radau", 1e-3)):  # its steps of 0.1 rad
            values, _ = self.solved(SPINNING % ("2", integrator), "collocation", 1)
            self.assertAlmostEqual(values["rx"], 20, delta=within, msg=integrator)
            self.assertAlmostEqual(values["most"], 20, delta=within, msg=integrator)
            ends = self.folder / f"{integrator}.h5"
            self.answered("solve", "--scene", self.scene(SPINNING % ("1", integrator)), "-f", "collocation", "-n", 1, "--ends", ends)
            values, _ = self.solved(SPINNING % ("1, 2", integrator), "collocation", 1, "--restart", ends)
            self.assertAlmostEqual(values["rx"], 20, delta=within, msg=integrator)


if __name__ == "__main__":
    unittest.main()
