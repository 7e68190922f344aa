"""Prices of counted work: planted ones are found again, from times with noise and outliers; what is
said of their accuracy holds; the committed table is what the tool writes."""
import csv
import math
import random
import unittest

import numpy as np

from harness.tools.kit.program import ROOT
from harness.tools import prices

NAMES = ("red", "blue", "green")


def planted(noise):
    """Cells of made-up cases: 20 us a cell, 1 ns a flop, 2, 4 and 8 us an evaluation."""
    dice, out = random.Random(11), []
    for case in range(10):
        for name, price in zip(NAMES, (2e-6, 4e-6, 8e-6)):
            for n in (1, 2, 4, 8, 16):
                cell = dict.fromkeys([f for c in prices.SHARED + prices.ANY for f in c.split("*")],
                                     0.0)
                cell.update(one=1.0, case=f"case{case}", name=name, strains=8.0,
                            strain_evaluations=float(n * dice.randint(20, 60)),
                            factor_flops=float(n * dice.randint(1000, 30000)))
                true = 2e-5 + price * cell["strain_evaluations"] + 1e-9 * cell["factor_flops"]
                cell["seconds"] = true * math.exp(dice.gauss(0, noise))
                if noise and dice.random() < 0.05:
                    cell["seconds"] *= 5
                out.append(cell)
    return out


class Fit(unittest.TestCase):

    def test_planted_prices_are_found(self):
        for noise, digits in ((0, 1e-6), (0.05, 0.1)):
            found = prices.fit(planted(noise), list(NAMES))
            for key, right in ((("", "one"), 2e-5), (("red", "strain_evaluations"), 2e-6),
                               (("blue", "strain_evaluations"), 4e-6),
                               (("green", "strain_evaluations"), 8e-6)):
                self.assertLess(abs(found[key] / right - 1), digits, (noise, key))
        self.assertTrue(all(price > 0 for price in found.values()))

    def test_without_a_row_the_prices_of_any(self):
        cells = planted(0)
        own = prices.fit(cells, list(NAMES))
        anyone = prices.fit(cells, [], {k: p for k, p in own.items() if k[0] == ""})
        self.assertEqual(anyone["", "one"], own["", "one"])
        each = anyone.get(("*", "strain_evaluations"), 0) + \
            8 * anyone.get(("*", "strain_evaluations*strains"), 0)
        self.assertTrue(2e-6 < each < 8e-6, each)

    def test_names_keep_what_has_a_price(self):
        for key, name in (("red", "red"), ("red:mass=lumped", "red"),
                          ("red:mass=lumped,stages=4", "red:stages=4"),
                          ("red:newton=dense,nodes=2,stages=4", "red:nodes=2,stages=4")):
            self.assertEqual(prices.name_of(key), name)

    def test_noise_is_where_the_order_becomes_doubtful(self):
        dice = np.random.default_rng(5)
        cost = dice.uniform(0, math.log(prices.NEAR), 20000)
        sure = prices.noise_of(cost, cost)
        self.assertEqual(sure, 1)
        # an error of 20 % in the ratio: nine of ten are in order beyond 1.28 sigma
        doubtful = prices.noise_of(cost, cost + dice.normal(0, 0.2, cost.size))
        self.assertAlmostEqual(math.log(doubtful), 1.28 * 0.2, delta=0.05)


class Table(unittest.TestCase):

    def test_the_committed_one(self):
        lines = (ROOT / "harness/study/prices.csv").read_text(encoding="utf-8").splitlines()
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        self.assertTrue(any("took no part" in line for line in lines if line.startswith("#")))
        known = set(prices.SHARED + prices.ANY)
        for row in rows[:-1]:
            self.assertIn(row["count"], known)
            self.assertGreater(float(row["seconds"]), 0)
        self.assertEqual(rows[-1]["formulation"], "noise")
        names = {row["formulation"] for row in rows}
        self.assertTrue({"", "*"} < names)


if __name__ == "__main__":
    unittest.main()
