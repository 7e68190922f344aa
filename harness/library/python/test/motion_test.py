"""Motions in time: built of dicts, solved, and read with their steps."""
import unittest

import numpy

from harness.library.python.test.module import ModuleTest, bw, leaf


def swing():
    """A tip mass on an arm that a drive turns by 30 degrees."""
    scene = bw.Scene("swing")
    scene.sections["tube"] = {"tube": {"diameter": 20e-3, "thickness": 1e-3}, "young": 70e9,
                              "shear_modulus": 26e9, "density": 2700}
    scene.nodes["hub"] = {"at": [0, 0, 0], "hold": ["ux", "uy", "uz", "rx", "ry"],
                          "drive": {"rz": "turn"}}
    scene.nodes["tip"] = {"at": [1, 0, 0], "mass": 0.3}
    scene.members["arm"] = {"from": "hub", "to": "tip", "section": "tube", "y": [0, 1, 0]}
    scene.motions["turn"] = {"unit": "rad", "pieces": [
        {"until": 0.5, "is": "30*deg*(2*t - sin(4*pi*t)/(2*pi))"}, {"is": "30*deg"}]}
    scene.analyses["swing"] = {"motion": {"stations": "0..1/10", "integrator": "radau",
                                          "tolerance": 1e-5}}
    seen = {"analysis": "swing", "node": "tip", "from": "hub", "component": "uy"}
    scene.quantities["ahead"] = {"relative": {**seen, "take": "max"}}
    scene.quantities["bend"] = {"relative": {**seen, "take": "curve"}}
    scene.quantities["kinetic"] = {"energy": {"analysis": "swing", "of": "kinetic"}}
    scene.omit = ["trapeze", "wagner_torque"]
    return scene


class Motion(ModuleTest):

    def test_the_same_bits_as_the_program(self):
        path = self.folder / "swing.yaml"
        swing().write(path)
        record = self.record("solve", "--scene", path, "-f", "beamw", "-n", 2)
        result = swing().solve("beamw", 2)
        for quantity in (q for q in record["quantities"] if q["quantity"] in result):
            self.assertEqual(quantity["value"], result[quantity["quantity"]])
            self.assertEqual(quantity["x"], result.at[quantity["quantity"]])
        for name, column in result.motion.items():
            self.assertEqual([row[name] for row in record["motion"]], list(column), name)
        self.assertEqual(set(result.motion), set(record["motion"][0]) - {"analysis", "analysis_name"})

    def test_steps_outlive_their_result(self):
        result = swing().solve("beamw", 2, shapes=20)
        self.assertTrue(0.3 < result.at["ahead"] < 0.4)
        self.assertNotIn("bend", result.at)
        self.assertEqual(result.shapes.kinds[-1], "motion")
        self.assertEqual(result.shapes.values[-1], 1)
        kinetic, last = result.motion["kinetic"], result["kinetic"]
        del result
        self.assertEqual(kinetic[-1], last)
        with self.assertRaises(ValueError):
            kinetic[0] = 1
        self.assertEqual(numpy.argmax(kinetic) > 0, True)

    def test_nothing_moves(self):
        result = leaf().solve("beamw", 2)
        self.assertEqual(result.motion, {})
        self.assertEqual(dict(result.at), {})


if __name__ == "__main__":
    unittest.main()
