"""Parts and their instances: what is placed is what its members, springs and supports are when they are written out."""
import math
import unittest

import numpy as np

from cases.format.test.scene_case import SceneCase, values
from harness.tools.kit.scenes import LEAF

# LEAF along z, as an instance of a part.
PLACED = """\
beamwork: 1
sections:
  leaf: {rectangle: {width: 50e-3, thickness: 0.5e-3}, young: 210e9, shear_modulus: 81e9}
nodes:
  tip: {at: [0, 0, 0.1]}
parts:
  arm:
    places: [end]
    nodes: {root: {at: [0, 0, 0], hold: all}}
    members: {leaf: {from: root, to: end, section: leaf, y: [0, 1, 0]}}
instances:
  one: {part: arm, at: [0, 0, 0], axes: {x: [0, 0, 2], z: [0, -1, 0]}, connect: {end: tip}}
loads:
  push: {force: [1, 0, 0], on: tip}
"""


class PartsTest(SceneCase):

    def test_instance_by_axes(self):
        """An instance placed by its axes is what its members are when they are written out."""
        got = values(self.record("solve", "--scene", self.scene(PLACED), "-f", "collocation",
                                 "-n", 1))
        own = values(self.record("solve", "--scene", self.scene(LEAF), "-f", "collocation", "-n",
                                 1))
        self.assertAlmostEqual(abs(got["tip_ux"]) / own["tip_uy"], 1, delta=1e-12)

    def test_springs_of_a_part(self):
        """In its axes: a turned part's spring is the one of the turned matrix T K T^T, on a port as between its own nodes."""
        turn, a = 0.4, [3e3, 1e3, 2e3, 4.0, 5.0, 6.0]
        c, s = math.cos(turn), math.sin(turn)
        R = np.kron(np.eye(2), [[c, -s, 0], [s, c, 0], [0, 0, 1]])
        K = R @ (np.diag(a) + 0.1*np.ones((6, 6))) @ R.T
        def numbers(matrix):
            return ", ".join(repr(float(x)) for x in ((matrix + matrix.T) / 2).ravel())
        placed = PLACED.replace("parts:", f"""parts:
  bearing: {{places: [at], springs: {{s: {{to: at, stiffness: [{numbers(np.diag(a) + 0.1*np.ones((6, 6)))}]}}}}}}
  pair:
    places: [at]
    nodes: {{own: {{at: [0, 0, 0]}}}}
    springs: {{s: {{from: at, to: own, stiffness: [{numbers(np.array(a))}]}}}}""").replace("instances:", f"""instances:
  b: {{part: bearing, at: [0, 0, 0.1], turn: {{z: {turn}}}, connect: {{at: tip}}}}
  p: {{part: pair, at: [0, 0, 0.1], turn: {{z: {turn}}}, connect: {{at: tip}}}}""") + "  pull: {force: [0.5, 1, 2], on: p.own}\n"
        plain = PLACED.replace("parts:", "  own: {at: [0, 0, 0.1]}\nparts:").replace("loads:", f"""springs:
  b: {{to: tip, stiffness: [{numbers(K)}]}}
  p: {{from: tip, to: own, stiffness: [{numbers(R @ np.diag(a) @ R.T)}]}}
loads:""") + "  pull: {force: [0.5, 1, 2], on: own}\n"
        where = ("-f", "collocation", "-n", 2)
        got = self.same_again(self.scene(placed, "placed.yaml"), *where)
        own = values(self.record("solve", "--scene", self.scene(plain, "plain.yaml"), *where))
        for name, value in own.items():
            self.assertAlmostEqual(got[name.replace("own", "p.own")] / value, 1, delta=1e-9, msg=name)
        self.assertGreater(min(map(abs, own.values())), 1e-9)

    def test_components_of_a_turned_part(self):
        """Held and driven along the part's axes where these are axes of the scene; a motion against its axis is refused."""
        part = PLACED.replace("hold: all", "hold: [uy, uz, rx, ry, rz], drive: {ux: pushed}").replace(
            "loads:", "motions:\n  pushed: {unit: m, path: [0, 1], value: [0, 1e-3]}\nloads:")
        where = ("-f", "collocation", "-n", 1)
        got = self.same_again(self.scene(part, "part.yaml"), *where)  # its x is z of the scene
        plain = LEAF.replace("hold: all", "hold: [uy, uz, rx, ry, rz], drive: {ux: pushed}").replace(
            "loads:", "motions:\n  pushed: {unit: m, path: [0, 1], value: [0, 1e-3]}\nloads:")
        self.assertNotEqual(plain, LEAF)
        own = values(self.record("solve", "--scene", self.scene(plain), *where))
        self.assertAlmostEqual(got["tip_uz"], 1e-3, delta=1e-4)
        self.assertAlmostEqual(got["tip_uz"] / own["tip_ux"], 1, delta=1e-9)
        self.refused(2, "drive: components that are not along axes of the scene", "scene", "--scene",
                     self.scene(part.replace("x: [0, 0, 2]", "x: [0, 0, -2]")))


if __name__ == "__main__":
    unittest.main()
