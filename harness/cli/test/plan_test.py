"""--plan: nothing is computed; what is expected is the table of expected costs; what was measured
is used."""
import csv
import re
import unittest

import numpy as np

from harness.tools.kit.program import ROOT, ProgramTest
from harness.tools import expense

CASES = "(elastica or c_column or bend_45 or tip_body) and default"


class Plan(ProgramTest):

    def plan(self, *arguments):
        """Batches, seconds, and the rows of the table."""
        lines = self.answered("verify", "-k", CASES, "--plan", *arguments).stdout.splitlines()
        batches, seconds = re.match(r"verify: (\d+) batches, about ([\d.e-]+) s", lines[0]).groups()
        rows = [[float(word) for word in line.split()] for line in lines if line[:1] == " "
                and "shards" not in line]
        return int(batches), float(seconds), rows

    def test_shards_end_as_the_batches_are_dealt(self):
        batches, seconds, rows = self.plan(12, "-j", 1)
        self.assertEqual([int(row[0]) for row in rows], [1, 2, 4, 8, 12])
        self.assertEqual(rows[0][2:], [batches, seconds, 1.0])
        for shards, processes, most, longest, efficiency in rows:
            self.assertEqual(shards, processes)
            self.assertGreaterEqual(most * shards, batches)
            self.assertAlmostEqual(efficiency, seconds / (shards * longest), delta=0.01)
        for fewer, more in zip(rows, rows[1:]):
            self.assertLessEqual(more[3], fewer[3])
        self.assertEqual(self.plan(1, "-j", 2)[2][0][1], 2)

    def test_what_is_expected_is_the_committed_table(self):
        self.answered("verify", "-k", CASES, "-o", self.folder / "run.h5")
        lines = (ROOT / "harness/study/expense.csv").read_text(encoding="utf-8").splitlines()
        table = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        pair = {(row["table"], row["name"]): (float(row["once"]), float(row["element"]))
                for row in table}
        prices = np.array([pair["work", kind] for kind in expense.WORK])
        factors = {name: p for (kind, name), p in pair.items() if kind == "formulation"}
        cells = expense.read(self.folder / "run.h5")
        self.assertGreater(len(cells), 100)
        self.assertAlmostEqual(
            self.plan(1)[1] / expense.predict(cells, prices, factors).sum(), 1, delta=0.006)

    def test_what_was_measured_is_used(self):
        into = self.folder / "parts"
        batches, expected, _ = self.plan(1)
        self.answered("verify", "-k", CASES, "--shard", "1/2", "--into", into)
        said = self.answered("verify", "-k", CASES, "--plan", 4, "--into", into).stdout
        there, factor = re.search(r"(\d+) of them as measured in .*: ([\d.e+-]+) times",
                                  said).groups()
        self.assertEqual(int(there), len(list(into.iterdir())))
        self.assertLess(int(there), batches)
        seconds = float(re.search(r"about ([\d.e+-]+) s", said).group(1))
        self.assertAlmostEqual(seconds / (expected * float(factor)), 1, delta=0.02)

    def test_what_does_not_go_together(self):
        for words, arguments in (("leave --shard", ("--shard", "1/2", "--into", "x")),
                                 ("outputs away", ("-o", self.folder / "out.h5")),
                                 ("no batches of this verify", ("--into", self.folder))):
            self.refused(2, words, "verify", "-k", CASES, "--plan", 2, *arguments)
        self.refused(2, "number of shards", "verify", "--plan", 0)
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
