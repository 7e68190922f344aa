"""Stored values of motions beside limits: what is asked of a scene, and what counts as within."""
import os
import pathlib
import subprocess
import tempfile
import unittest

import h5py
import numpy as np

from harness.tools import motions

SCENE = {
    "analyses": {"a": {"static": {}}, "b": {"motion": {"stations": ["9"]}}},
    "quantities": {
        "still": {"displacement": {"analysis": "a", "node": "n"}, "unit": "m"},
        "tip": {"displacement": {"analysis": "b", "node": "n"}, "unit": "m", "offset": "2"},
    },
}


def row(value, uncertainty="1e-6", quantity="tip"):
    return {"quantity": quantity, "unit": "m", "kind": "exact", "value": value,
            "uncertainty": uncertainty}


class Motions(unittest.TestCase):

    def test_a_quantity_is_read_at_every_time(self):
        asked = motions.asked_at(SCENE, ["1", "9"])
        self.assertEqual(list(asked["quantities"]), ["still", "tip_0", "tip_1"])
        self.assertEqual(asked["quantities"]["tip_0"]["displacement"]["at"], "1")
        self.assertEqual(asked["quantities"]["tip_1"]["offset"], "2")
        self.assertEqual(asked["analyses"]["b"]["motion"]["stations"], ["1", "9"])

    def test_within_the_larger_of_both_uncertainties(self):
        rows = [("1", row("3")), ("9", row("3")), (None, row("5", quantity="still")),
                ("1", row("3.1"))]
        found = {"tip_0": (3.2, 3.0000005, 1e-9), "tip_1": (3.2, 3.01, 0.02),
                 "still": (5.0, 5.1, 0.0)}
        judged = list(motions.judge("c", "", rows, found, ["1", "9"], 32))
        self.assertEqual([one["within"] for one in judged], ["yes", "yes", "no", "no"])
        self.assertEqual(motions.show(judged), 1)
        self.assertEqual(motions.show(judged[:2]), 0)

    def test_what_has_no_limit_is_outside(self):
        judged = list(motions.judge("c", "", [("1", row("3"))], {}, ["1"], 32))
        self.assertEqual(judged[0]["within"], "no")

    def test_what_is_known_to_no_better_than_a_hundredth_is_told(self):
        rows = [("1", row("3")), ("9", row("0.1"))]
        found = {"tip_0": (3.2, 3.0, 0.029), "tip_1": (0.1, 0.11, 0.031)}
        judged = list(motions.judge("c", "", rows, found, ["1", "9"], 32))
        self.assertEqual([one["within"] for one in judged], ["yes", "yes"])
        self.assertEqual([motions.is_loose(one, judged) for one in judged], [False, True])

    def test_every_case_has_rows_and_times(self):
        self.assertEqual(list(motions.CASES), list(motions.FINE))
        for chosen in (motions.CASES, motions.FINE):
            for case in chosen:
                stored = motions.stored(case)
                self.assertTrue(stored, case)
                for structure in chosen[case]:
                    self.assertIn(structure, stored, case)

    def test_a_body_is_within(self):
        program = os.environ.get("BEAMWORK", str(motions.ROOT / "build" / "beamwork"))
        judged = list(motions.table(program, "rigid_body"))
        self.assertEqual(len(judged), 61)
        self.assertTrue(all(one["within"] == "yes" for one in judged))

    def test_the_centre_of_mass_of_a_flight_is_where_the_impulse_takes_it(self):
        program = os.environ.get("BEAMWORK", str(motions.ROOT / "build" / "beamwork"))
        elements = 16
        for case, words, place in (("free_flight_space", ("time=10", ), (40.5, 0, 4)),
                                   ("free_flight_plane", ("time=10", "load=step"), (20.5, 4, 0)),
                                   ("free_flight_plane", ("time=2.5", "load=step"), (5.5, 4, 0))):
            with tempfile.TemporaryDirectory() as folder:
                path, scene = pathlib.Path(folder) / "flight.h5", pathlib.Path(folder) / "flight.yaml"
                text = subprocess.run([
                    program, "scene", case, *(w for word in words for w in ("--set", word))
                ], check=True, capture_output=True, text=True).stdout
                self.assertIn("integrator: radau", text)
                scene.write_text(text.replace("integrator: radau", "integrator: radau, mass: lumped"),
                                 "utf-8")
                subprocess.run([
                    program, "solve", "--scene", str(scene), "-f", "beamw", "-n",
                    str(elements), "--shapes", "-o", str(path)
                ], check=True, capture_output=True)
                with h5py.File(path) as stored:
                    shapes = stored[f"cases/{case}/shapes"]
                    nodes = shapes[next(iter(shapes))]["position"][-1]
            self.assertEqual(len(nodes), elements + 1)
            mass = np.ones(len(nodes))
            mass[:3] = mass[:-4:-1] = 3/8, 7/6, 23/24
            self.assertLess(np.max(np.abs(mass @ nodes / np.sum(mass) - place)), 1e-11, case)


if __name__ == "__main__":
    unittest.main()
