"""The page of ratios to other programs: its numbers and reasons, and its agreement with the records."""
import importlib
import unittest

from harness.library.python.test.module import ModuleTest, bw
from harness.library.python.test.peers_ranking_test import record, run, series
from harness.tools.kit.program import ROOT

ratios = None if bw is None else importlib.import_module("beamwork.peers._ratios")


@unittest.skipIf(bw is None, "needs a library without sanitizers")
class Ratios(ModuleTest):

    def pairs(self, *all_series):
        return ratios.pairs(record(*all_series), {"bent"})

    def test_fastest(self):
        """The fastest element of each program must be compared with the fastest formulation."""
        found = self.pairs(series("a", [run(1, 5e-3, 1.0)], True), series("b", [run(1, 5e-3, 2.0)], True),
                           series("P, x", [run(1, 5e-3, 9.0)]), series("P, y", [run(1, 5e-3, 4.0)]), series("Q, z", [run(1, 5e-3, 30.0)]))
        self.assertEqual([(level, row["name"], row["ratio"], ours["name"]) for _, level, row, ours in found],
                         [(1e-2, "P, y", 4.0, "a"), (1e-2, "Q, z", 30.0, "a")])
        self.assertEqual(ratios.pairs(record(series("a", [run(1, 5e-3, 1.0)], True)), {"other"}), [])

    def test_nothing_to_compare(self):
        """Without a formulation that reaches the error, or without times, there is no ratio."""
        self.assertEqual(self.pairs(series("P, x", [run(1, 5e-3, 9.0)])), [])
        self.assertEqual(self.pairs(series("a", [run(1, 5e-3, 1.0)], True), series("P, x", [{**run(1, 5e-3, 9.0), "times": {}}])), [])

    def test_factors(self):
        """The product of the factors must be the ratio, and the reason must name the small ones."""
        def one(**own):
            pair, = self.pairs(series("a", [run(1, 5e-3, 1.0)], True), series("P, x", [run(1, 5e-3, 6.0, **own)]))
            return ratios.factors(*pair[2:])
        found = one(unknowns=3, systems=20)
        self.assertEqual(found, (0.5, 4.0, 3.0))
        self.assertEqual(ratios.reason(found), "fewer unknowns")
        self.assertEqual(ratios.reason(one(unknowns=6, systems=60)), "as many unknowns, less time for each unknown of a system")
        self.assertEqual(ratios.reason(one(unknowns=12, systems=10)), "no factor is above 2")
        self.assertEqual(ratios.reason(one(systems=None)), "its number of systems is unknown")

    def test_no_records(self):
        with self.assertRaisesRegex(bw.Refused, "no recorded comparisons"):
            ratios.recorded(self.folder)

    def test_page(self):
        """The page of the documentation must be that of the records, and its rows below the bound must have reasons."""
        page = (ROOT / "docs" / "reference" / "peer_ratios.md").read_text(encoding="utf-8")
        self.assertEqual(page, ratios.markdown(ratios.recorded(ROOT / "reference" / "peers")))
        rows = [line.split(" | ") for line in page.partition(f"why below {ratios.SMALL}")[2].splitlines()[2:]]
        self.assertTrue(rows)
        self.assertNotIn("not built in", page)
        for row in rows:
            ratio, *found = (float(word) for word in row[4:8])
            self.assertLess(ratio, ratios.SMALL)
            self.assertAlmostEqual(found[0] * found[1] * found[2] / ratio, 1, delta=0.15)
