"""Two runs of verify name the same winners, with the same n and ties, whatever their times were."""
import random
import subprocess
import sys

from harness.tools.kit.program import ProgramTest, run
from reports import answers_table, data

SELECTION = ("elastica/default or c_column/default or spherical_joint/default or "
             "warping_torsion/default or rotating_cantilever/default")
LEVELS = (*data.REACH, 3e-3, 2e-5)


def told(cases):
    """The answers without times."""
    return [{name: value for name, value in row.items() if name != "seconds"}
            for row in answers_table.rows(cases, LEVELS, everywhere=True)]


def seconds(cases):
    return [row["seconds"] for row in answers_table.rows(cases, LEVELS, everywhere=True)]


class Twice(ProgramTest):

    def cases(self, name, *options):
        path = self.folder / name
        run("verify", "-k", SELECTION, "-o", path, *options)
        return data.read_results(path)[1]

    def test_the_same_winners(self):
        first = self.cases("first.h5", "-j", "1")
        with subprocess.Popen([sys.executable, "-c", "while True: sum(range(10**6))"]) as busy:
            second = self.cases("second.h5", "-j", "3")
            busy.kill()
        self.assertNotEqual(seconds(first), seconds(second))
        self.assertGreater(len(told(first)), 200)
        self.assertTrue(any(row["tie"] for row in told(first)))
        self.assertTrue(any(row["defect"] for row in told(first)))
        self.assertEqual(told(first), told(second))
        dice = random.Random(3)
        for case in second:
            for point in case.points:
                for mesh in (m for s in point.series for m in s.meshes):
                    factor = 3**dice.uniform(-1, 1)
                    clock = mesh.clock
                    clock.least, clock.most = factor * clock.least, factor * clock.most
        self.assertNotEqual(seconds(first), seconds(second))
        self.assertEqual(told(first), told(second))
