"""Frames of a motion: evenly over its time, in the arrays that pictures are drawn from and as
temporal unstructured grid (VTKHDF file format 2.0, section on temporal data)."""
import json
import unittest

import h5py
import numpy as np

from harness.tools.kit.program import ProgramTest

MOTION = ("solve", "elbow", "-f", "collocation", "-n", "2", "--set", "step=0.07",
          "--set", "tolerance=0", "--set", "integrator=alpha")


class Frames(ProgramTest):
    def solved(self, name, *more):
        path = self.folder / name
        self.answered(*MOTION, *more, "-o", path)
        return h5py.File(path)

    def shapes(self, file):
        (only,) = file["cases/elbow/shapes"].values()
        return only

    def test_times(self):
        """As many as asked for, sixty otherwise, from the begin to the end."""
        for option, count in (("--shapes", 60), ("--shapes=3", 60), ("--shapes=8", 8)):
            with self.solved("times.h5", option, "--set", "time=2") as file:
                g = self.shapes(file)
                kinds = [k.decode() for k in g["kind"][()]]
                self.assertEqual(kinds, ["undeformed"] + ["motion"] * count)
                np.testing.assert_allclose(g["value"][1:], np.linspace(0, 2, count), atol=1e-15)
                np.testing.assert_allclose(file["VTKHDF/Steps/Values"], np.linspace(0, 2, count),
                                           atol=1e-15)

    def test_places(self):
        """A frame between the ends of steps is where a motion is at that time."""
        with self.solved("places.h5", "--shapes=9", "--set", "time=2") as file:
            nodes, first = self.shapes(file)["nodes"][()], self.shapes(file)["nodes"][0]
            np.testing.assert_array_equal(nodes[1], first)
            for frame in (6, 7, 8):
                time = 2 * (frame - 1) / 8
                record = json.loads(self.answered(*MOTION, "--set", f"time={time}", "--format",
                                                  "json").stdout)
                value = {q["quantity"]: q["value"] for q in record["quantities"]}
                place = [value[f"tip_{axis}"] for axis in "xyz"]
                np.testing.assert_allclose(nodes[frame][2], place, atol=2e-3)
                self.assertGreater(abs(place[2]), 0.03)

    def test_resultants(self):
        """Stresses run between the ends of steps: the root's moment does not jump."""
        with self.solved("forces.h5", "--shapes=40", "--set", "time=2") as file:
            moment = self.shapes(file)["moment"][1:, 0, 1]
            self.assertGreater(np.ptp(moment), 50)
            self.assertLess(np.abs(np.diff(moment)).max(), 0.15 * np.ptp(moment))

    def test_temporal_grid(self):
        """Every data set that the format asks of a grid over time, with its length and type."""
        frames = 7
        with self.solved("grid.h5", f"--shapes={frames}", "--set", "time=1") as file:
            grid, steps = file["VTKHDF"], file["VTKHDF/Steps"]
            self.assertEqual(tuple(grid.attrs["Version"]), (2, 0))
            self.assertEqual(grid.attrs["Type"], b"UnstructuredGrid")
            self.assertEqual(steps.attrs["NSteps"], frames)
            points, cells, ids = (int(grid[f"NumberOf{name}"][0])
                                  for name in ("Points", "Cells", "ConnectivityIds"))
            self.assertEqual(grid["Points"].shape, (frames * points, 3))
            self.assertEqual(grid["Connectivity"].shape, (ids,))
            self.assertEqual(grid["Offsets"].shape, (cells + 1,))
            self.assertEqual(grid["Types"].dtype, np.uint8)
            self.assertLess(grid["Connectivity"][()].max(), points)
            along = points * np.arange(frames)
            for name, expected in (("PointOffsets", along), ("PartOffsets", 0 * along),
                                   ("NumberOfParts", 0 * along + 1)):
                np.testing.assert_array_equal(steps[name], expected, name)
            for name in ("CellOffsets", "ConnectivityIdOffsets"):
                np.testing.assert_array_equal(steps[name], np.zeros((frames, 1)), name)
            for name, data in grid["PointData"].items():
                self.assertEqual(len(data), frames * points, name)
                np.testing.assert_array_equal(steps["PointDataOffsets"][name], along, name)
            for name, data in grid["CellData"].items():
                self.assertEqual(len(data), cells, name)
                np.testing.assert_array_equal(steps["CellDataOffsets"][name], 0 * along, name)


if __name__ == "__main__":
    unittest.main()
