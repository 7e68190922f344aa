"""A sweep of the program itself, stored and drawn."""
import re
import unittest

import numpy as np

from harness.records.test.stored import group_of
from harness.tools.kit.program import ProgramTest, report, run
from reports.sweep import gather, stored
from reports.test import sweeps
from reports.test.sweep_page_test import text_of


class Genuine(ProgramTest):
    """What `sweep` itself stored: its counts are those of the program."""

    def test_a_grid(self):
        path, site = self.folder / "loads.h5", self.folder / "site"
        run("sweep", "elastica", "--vary", "load=1..8/7", "--vary", "axial=1e6..1e8/1:log", "-f",
            "collocation", "-f", "beamw", "-f", "sheet_third", "-n", "1,2,4", "-j", "1", "-o", path)
        sweep = stored.read(path)
        self.assertEqual((sweep.name, sweep.points, sweep.meshes), ("elastica", 16, [1, 2, 4]))
        self.assertGreater(sweep.noise, 1)
        self.assertIn("ok", sweep.statuses)
        self.assertTrue(sweep.without)
        found = gather.of_sweep(sweep)
        with group_of(path) as file:
            least, status = file["least"][()], file["status"][()]
        absent = np.isin(status, sweep.outcomes(stored.ABSENT)).any(axis=2)
        for f, key in enumerate(sweep.keys):
            for q, quantity in enumerate(sweep.quantities):
                for m, n in enumerate(sweep.meshes):
                    within = (least[:, f, q] > 0) & (least[:, f, q] <= n) & ~absent[:, f]
                    self.assertEqual(found.reach[:, f, q, :m + 1].sum(), within.sum(),
                                     (key, quantity, n))
        self.assertEqual(report(path, site).returncode, 0)
        page = text_of((site / "index.html").read_text(encoding="utf-8"))
        self.assertIn("elastica: over which range is each formulation within 1 %?", page)
        scene = re.search(r"beamwork solve --scene (\S+\.yaml) -f (\S+) -n (\d+)", page)
        self.answered("solve", "--scene", scene[1], "-f", scene[2], "-n", scene[3])


if __name__ == "__main__":
    unittest.main()
