"""Expected costs: planted prices and factors are found again; what the analyses of a scene do is
counted; the committed table has a row for each kind of work."""
import csv
import random
import re
import unittest

import numpy as np

from harness.tools.kit.program import ROOT
from harness.tools import expense


def planted():
    """Cells whose cost is that of made-up prices: modal 1 us and 20 us an element, a load step 5 us
    and 3 us an element; one formulation is three times as dear by the element."""
    dice, out = random.Random(7), []
    for case in range(12):
        modal, steps = dice.randrange(2), dice.randrange(12)
        times = [dict(cell=1, modal=modal, load_step=steps).get(kind, 0) for kind in expense.WORK]
        for name, dear in (("red", 0.5), ("blue", 1.5)):
            for elements in (1, 4, 16, 64):
                cost = 1e-5 + modal * 1e-6 + steps * 5e-6 + \
                    dear * elements * (modal * 2e-5 + steps * 3e-6)
                out.append({"case": f"case{case}", "name": name, "times": times, "seconds": cost,
                            "elements": elements, "cost": cost})
    return out


class Fit(unittest.TestCase):

    def test_planted_costs_are_found(self):
        cells = planted()
        cost = np.array([c["cost"] for c in cells])
        prices, factors = expense.fit(cells)
        np.testing.assert_allclose(expense.predict(cells, prices, factors), cost, rtol=0.02)
        self.assertAlmostEqual(factors["blue"][1] / factors["red"][1], 3, delta=0.1)
        self.assertAlmostEqual(np.mean([f[1] for f in factors.values()]), 1, delta=1e-9)
        self.assertLess(expense.spread(expense.validate(cells), cost)[1], 1.1)

    def test_work_of_a_scene(self):
        times, members = expense.work_of({
            "members": {"a": {}, "b": {}},
            "analyses": {"path": {"static": {"stations": [1, 2, 3], "steps": 4}},
                         "about": {"compliance": {"about": "path", "node": "n"}},
                         "load": {"buckling": {"about": "path"}}, "rest": {"buckling": None}}})
        self.assertEqual(members, 2)
        self.assertEqual(dict(times), {"cell": 1, "load_step": 6, "compliance": 3,
                                       "loaded_buckling": 1, "buckling": 1})

    def test_steps_of_motions(self):
        """Of equal steps as many as there is room for; of those that adapt by their tolerance."""
        swing = {"stations": [1, 3], "integrator": "alpha", "step": 0.7}
        for more, kind, count in (({}, "alpha_step", 5),
                                  ({"step": 0.75}, "alpha_step", 4),
                                  ({"integrator": "radau", "tolerance": 1e-6}, "radau_step",
                                   40 * 100 ** 0.3),
                                  ({"integrator": "explicit", "tolerance": 1}, "explicit_step", 5)):
            times, _ = expense.work_of({"members": {"a": {}},
                                        "analyses": {"swing": {"motion": swing | more}}})
            self.assertEqual(set(times), {"cell", kind})
            self.assertAlmostEqual(times[kind], count, delta=1e-9)


class Table(unittest.TestCase):

    def test_the_committed_one(self):
        lines = (ROOT / "harness/study/expense.csv").read_text(encoding="utf-8").splitlines()
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        work = [row["name"] for row in rows if row["table"] == "work"]
        header = (ROOT / "harness/study/study.h").read_text(encoding="utf-8")
        self.assertEqual(tuple(work), expense.WORK)
        self.assertEqual(re.findall(r"EXPENSE_([a-z_]+)[,;]", header), work)
        named = [row["name"] for row in rows if row["table"] == "formulation"]
        self.assertEqual(len(set(named)), len(named))
        self.assertGreater(len(named), 1)
        self.assertTrue(all(float(row["element"]) >= 0 for row in rows))


if __name__ == "__main__":
    unittest.main()
