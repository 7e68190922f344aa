"""The answers of CalculiX, where it is there, are those of beams and plates."""
import unittest

import numpy as np

from harness.exchange.test.export_case import (
    CHANNEL, HEIGHT, INERTIA, LENGTH, PATH, PERCENT, RECTANGLE, TIP, WIDTH, YOUNG,
    cantilever, needs_ccx, ExportTest,
)
from cases.format.test.scene_case import EXAMPLES


@needs_ccx
class Solved(ExportTest):
    def test_cantilever(self):
        """F L^3/(3 E I) + 6 F L/(5 G A), F L^2/(2 E I)."""
        found = self.solved(self.scene(cantilever(2.0)), "-n", "10")
        bent = 2 * LENGTH**3 / (3 * YOUNG * INERTIA)
        sheared = 1.2 * 2 * LENGTH / (YOUNG / 2 * WIDTH * HEIGHT)
        self.assertAlmostEqual(found["deflection"] / (bent + sheared), 1, delta=1e-3)
        self.assertAlmostEqual(found["turn"] / (-2 * LENGTH**2 / (2 * YOUNG * INERTIA)), 1,
                               delta=1e-3)

    def test_elastica(self):
        """F L^2/(E I) = 2: deflection 0.49346 L, shortening 0.16064 L (Mattiasson 1981)."""
        force = 2 * YOUNG * INERTIA / LENGTH**2
        found = self.solved(self.scene(cantilever(force, PATH)), "-n", "16")
        self.assertAlmostEqual(found["deflection"] / (0.49346 * LENGTH), 1, delta=2e-3)
        self.assertAlmostEqual(found["shortening"] / (-0.16064 * LENGTH), 1, delta=2e-3)
        self.assertAlmostEqual(found["held"] / -force, 1, delta=1e-5)

    def test_arc(self):
        """The end turned by a: deflection (1 - cos a) L/a, shortening (1 - sin a/a) L; also
        when the turn is about an axis of no coordinate, as the bar lies askew."""
        angle, c, s = 1.2, 0.8, 0.6
        text = cantilever(0.0, PATH).replace(
            "tip:  {at: [0.02, 0.1, 0]", "tip:  {at: [0.02, 0.08, 0.06], rotation: {vector: [none, "
            "about_y, about_z]}").replace(
            "loads:\n  push: {force: [0.0, 0, 0], on: tip}", "motions:\n"
            "  none:    {unit: rad, path: [0, 1], value: [0, 0]}\n"
            f"  about_y: {{unit: rad, path: [0, 1], value: [0, {s * angle!r}]}}\n"
            f"  about_z: {{unit: rad, path: [0, 1], value: [0, {-c * angle!r}]}}")
        found = self.solved(self.scene(text), "-n", "16")
        self.assertAlmostEqual(found["deflection"] / ((1 - np.cos(angle)) / angle * LENGTH), 1,
                               delta=2e-3)
        self.assertAlmostEqual(found["shortening"] / (-c * (1 - np.sin(angle) / angle) * LENGTH), 1,
                               delta=2e-3)
        self.assertAlmostEqual(found["turn"], -c * angle, delta=1e-6)

    def test_compliance(self):
        """Of a beam's end, with moments: L/(E I), L^2/(2 E I), L/(E A)."""
        text = cantilever(1.0).replace("run: {linear: {}}", "run: {compliance: {node: tip}}")
        entries = {"turn_turn": ("rz", "rz", "rad/(N m)", LENGTH / (YOUNG * INERTIA)),
                   "turn_move": ("rz", "ux", "rad/N", -LENGTH**2 / (2 * YOUNG * INERTIA)),
                   "move_turn": ("ux", "rz", "1/N", -LENGTH**2 / (2 * YOUNG * INERTIA)),
                   "along": ("uy", "uy", "m/N", LENGTH / (YOUNG * WIDTH * HEIGHT))}
        text = text[:text.index("  deflection:")] + "".join(
            f"  {name}: {{compliance: {{analysis: run, row: {row}, column: {column}}}, "
            f"unit: {unit}}}\n" for name, (row, column, unit, _) in entries.items())
        found = self.solved(self.scene(text), "-n", "10")
        for name, (*_, value) in entries.items():
            self.assertAlmostEqual(found[name] / value, 1, delta=2e-3, msg=name)

    def test_channel(self):
        """A channel of 2 m with rigid ends: so many percent more is each compliance of the solid,
        and the twist by a force on the centroid."""
        head = cantilever(1.0).replace(RECTANGLE, CHANNEL).replace("at: [0.02, 0.1, 0]", TIP)
        text = head[:head.index("loads:")] + (
            "analyses:\n  run: {compliance: {node: tip}}\nquantities:\n" + "".join(
                f"  {c}: {{compliance: {{analysis: run, row: {c}, column: {c}}}}}\n"
                for c in PERCENT if c != "twist") +
            "  twist: {compliance: {analysis: run, row: ry, column: uz}}\n")
        scene = self.scene(text)
        solid = self.solved(scene, "-n", "8")
        told = self.record("solve", "--scene", scene, "-f", "collocation", "-n", "4")
        more = {q["quantity"]: 100 * (solid[q["quantity"]] / q["value"] - 1)
                for q in told["quantities"]}
        for name, percent in PERCENT.items():
            self.assertAlmostEqual(more[name], percent, delta=0.1, msg=name)

    def test_wagner_moments(self):
        """A channel of 4 m loaded at its centroid twists, and moves across its load: 12 % more than
        beams without int y (y^2 + z^2) dA, 0.6 % less than those with it."""
        text = cantilever(0.0, "{static: {stations: [1]}}").replace(RECTANGLE, CHANNEL).replace(
            "force: [0.0, 0, 0]", "force: [0, 0, -3e3]").replace("[0.02, 0.1, 0]", "[0.02, 4, 0]")
        text = text.replace("shear_modulus: 100e9", "shear_modulus: 80e9")
        scene = self.scene(text + "omit: [wagner_torque, rotary_inertia]\n")
        solid = self.solved(scene, "-n", "6")["deflection"]
        plain = self.scene(text + "omit: [trapeze, wagner_moments, wagner_torque, rotary_inertia]\n",
                           "plain.yaml")
        for beams, least, most in ((scene, 0.985, 1.005), (plain, 1.1, 1.14)):
            told = self.record("solve", "--scene", beams, "-f", "collocation", "-n", "8")
            beam, = [q["value"] for q in told["quantities"] if q["quantity"] == "deflection"]
            self.assertGreater(solid / beam, least)
            self.assertLess(solid / beam, most)

    def test_leaf_spring_guide(self):
        """Plates hold their anticlastic bending: stiffer than beams by what finer meshes keep."""
        scene = EXAMPLES / "leaf_spring_guide.yaml"
        solid = self.solved(scene, "-n", "20")
        told = self.record("solve", "--scene", scene, "-f", "collocation", "-n", "4")
        more = {q["quantity"]: 100 * (solid[q["quantity"]] / q["value"] - 1)
                for q in told["quantities"]}
        for name, percent in (("k_drive", 6.9), ("force", 8.0), ("k_pushed", 6.3),
                              ("k_support", 1.3), ("shortening", 0.2)):
            self.assertAlmostEqual(more[name], percent, delta=0.2, msg=name)


if __name__ == "__main__":
    unittest.main()
