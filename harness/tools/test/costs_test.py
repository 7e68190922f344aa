"""The cost of work: counts of instructions, and coefficients fitted to measured times."""
import csv
import math
import os
import pathlib
import random
import re
import subprocess
import tempfile
import unittest

import h5py
import numpy as np

from harness.tools import cost_coefficients as coefficients, motions, run_cost
from harness.tools.instructions import Profile, operations, parts_of
from harness.tools.kit.program import ProgramTest, ROOT


def planted():
    """Returns runs with artificial costs. A run costs 10 us, a modal analysis 1 us plus 20 us per element, and a
    load step 5 us plus 3 us per element. The costs per element are half of this for one formulation and 1.5 times
    this for the other."""
    dice, out = random.Random(7), []
    for case in range(12):
        modal, steps = dice.randrange(2), dice.randrange(12)
        times = [dict(cell=1, modal=modal, load_step=steps).get(kind, 0) for kind in run_cost.WORK]
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
        prices, factors = run_cost.fit(cells)
        np.testing.assert_allclose(run_cost.predict(cells, prices, factors), cost, rtol=0.02)
        self.assertAlmostEqual(factors["blue"][1] / factors["red"][1], 3, delta=0.1)
        self.assertAlmostEqual(np.mean([f[1] for f in factors.values()]), 1, delta=1e-9)
        self.assertLess(run_cost.spread(run_cost.validate(cells), cost)[1], 1.1)

    def test_work_of_a_scene(self):
        times, members = run_cost.work_of({
            "members": {"a": {}, "b": {}},
            "analyses": {"path": {"static": {"stations": [1, 2, 3], "steps": 4}},
                         "about": {"compliance": {"about": "path", "node": "n"}},
                         "load": {"buckling": {"about": "path"}}, "rest": {"buckling": None}}})
        self.assertEqual(members, 2)
        self.assertEqual(dict(times), {"cell": 1, "load_step": 6, "compliance": 3,
                                       "loaded_buckling": 1, "buckling": 1})

    def test_steps_of_motions(self):
        swing = {"stations": [1, 3], "integrator": "alpha", "step": 0.7}
        for more, kind, count in (({}, "alpha_step", 5),
                                  ({"step": 0.75}, "alpha_step", 4),
                                  ({"integrator": "radau", "tolerance": 1e-6}, "radau_step",
                                   40 * 100 ** 0.3),
                                  ({"integrator": "explicit", "tolerance": 1}, "explicit_step", 5)):
            times, _ = run_cost.work_of({"members": {"a": {}},
                                        "analyses": {"swing": {"motion": swing | more}}})
            self.assertEqual(set(times), {"cell", kind})
            self.assertAlmostEqual(times[kind], count, delta=1e-9)


class Table(unittest.TestCase):

    def test_the_committed_one(self):
        lines = (ROOT / "harness/study/run_cost.csv").read_text(encoding="utf-8").splitlines()
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        work = [row["name"] for row in rows if row["table"] == "work"]
        header = (ROOT / "harness/study/study.h").read_text(encoding="utf-8")
        self.assertEqual(tuple(work), run_cost.WORK)
        self.assertEqual(re.findall(r"RUN_COST_([a-z_]+)[,;]", header), work)
        named = [row["name"] for row in rows if row["table"] == "formulation"]
        self.assertEqual(len(set(named)), len(named))
        self.assertGreater(len(named), 1)
        self.assertTrue(all(float(row["element"]) >= 0 for row in rows))


NAMES = ("red", "blue", "green")


def planted_of_prices(noise):
    """Returns runs of artificial cases with 20 us per run, 1 ns per flop, and 2, 4 or 8 us per evaluation."""
    dice, out = random.Random(11), []
    for case in range(10):
        for name, price in zip(NAMES, (2e-6, 4e-6, 8e-6)):
            for n in (1, 2, 4, 8, 16):
                cell = dict.fromkeys(coefficients.SHARED + coefficients.OWN, 0.0)
                cell.update(one=1.0, case=f"case{case}", name=name, kind="static",
                            strain_evaluations=float(n * dice.randint(20, 60)),
                            factor_flops=float(n * dice.randint(1000, 30000)))
                true = 2e-5 + price * cell["strain_evaluations"] + 1e-9 * cell["factor_flops"]
                cell["seconds"] = true * math.exp(dice.gauss(0, noise))
                if noise and dice.random() < 0.05:
                    cell["seconds"] *= 5
                out.append(cell)
    return out


class PricesFit(unittest.TestCase):

    def test_planted_prices_are_found(self):
        for noise, digits in ((0, 0.02), (0.05, 0.1)):
            found = coefficients.fit(planted_of_prices(noise), list(NAMES))
            for key, right in ((("", "one"), 2e-5), (("red", "strain_evaluations"), 2e-6),
                               (("blue", "strain_evaluations"), 4e-6),
                               (("green", "strain_evaluations"), 8e-6)):
                self.assertLess(abs(found[key] / right - 1), digits, (noise, key))
        self.assertTrue(all(price > 0 for price in found.values()))

    def test_without_a_row_the_prices_of_any(self):
        cells = planted_of_prices(0)
        own = coefficients.fit(cells, list(NAMES))
        anyone = coefficients.fit(cells, [], {k: p for k, p in own.items() if k[0] == ""})
        self.assertEqual(anyone["", "one"], own["", "one"])
        each = anyone["*", "strain_evaluations"]
        self.assertTrue(2e-6 < each < 8e-6, each)

    def test_names_keep_what_has_a_price(self):
        for key, name in (("red", "red"), ("red:mass=lumped", "red"),
                          ("red:mass=lumped,stages=4", "red:stages=4"),
                          ("red:newton=dense,nodes=2,stages=4", "red:nodes=2,stages=4")):
            self.assertEqual(coefficients.name_of(key), name)

    def test_noise_is_where_the_order_becomes_doubtful(self):
        dice = np.random.default_rng(5)
        cost = dice.uniform(0, math.log(coefficients.NEAR), 20000)
        sure = coefficients.noise_of(cost, cost)
        self.assertEqual(sure, 1)
        # if the ratio of two costs has a standard deviation of 20 %, nine of ten pairs are in the correct order if they
        # differ by more than 1.28 times this deviation
        doubtful = coefficients.noise_of(cost, cost + dice.normal(0, 0.2, cost.size))
        self.assertAlmostEqual(math.log(doubtful), 1.28 * 0.2, delta=0.05)


    def test_accuracy_by_kind(self):
        cells = [{"kind": kind, "seconds": 2.0} for kind in ("modal", "static", "static", "static", "static")]
        found = coefficients.by_kind(cells, np.array([9.0, 2.9, 6.0, 6.0, 13.0]))
        self.assertEqual(found["modal"], (1, 1.5, 1.0))
        self.assertEqual(found["static"], (4, 1.0, 0.5))

    def test_kinds(self):
        for analyses, kind in (({"a": {"static": None}}, "static"),
                               ({"a": {"static": None}, "b": {"compliance": {}}}, "static and compliance"),
                               ({"a": {"static": None}, "b": {"motion": {"integrator": "radau"}}},
                                "radau motion"), ({"a": {"linear": None}, "b": {"buckling": None}},
                                                  "buckling"), (None, "none")):
            self.assertEqual(coefficients.kind_of({"analyses": analyses}), kind)


class PricesTable(unittest.TestCase):

    def test_the_committed_one(self):
        lines = (ROOT / "harness/study/cost_coefficients.csv").read_text(encoding="utf-8").splitlines()
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        told = [re.fullmatch(r"# (sample|check): ([a-z ]+): (\d+) runs, median [\d.]+, within ([\d.]+)", line)
                for line in lines if re.match(r"# (sample|check): ", line)]
        kinds = {label: {m[2] for m in told if m[1] == label} for label in ("sample", "check")}
        self.assertLess({f"{i} motion" for i in coefficients.INTEGRATORS} |
                        {"static", "buckling", "continuation"}, kinds["sample"])
        self.assertLess({f"{i} motion" for i in coefficients.INTEGRATORS}, kinds["check"])
        for m in told:
            self.assertGreaterEqual(float(m[4]), 0.9, m[0])
        known = set(coefficients.SHARED + coefficients.OWN)
        for row in rows[:-1]:
            self.assertIn(row["count"], known)
            self.assertGreater(float(row["seconds"]), 0)
        self.assertEqual(rows[-1]["formulation"], "noise")
        names = {row["formulation"] for row in rows}
        self.assertTrue({"", "*"} < names)


PROFILE = """# callgrind format
positions: instr line
events: Ir

ob=(1) /there/build/beamwork
fl=(1) harness/newton/newton.c
fn=(1) newton_to
0x100 10 5
+4 11 7
cfi=(2) /old/place/elements/sheet/third.c
cfn=(2) third_strain
calls=2 0x200 1
* 12 60
cfi=(3) harness/numerics/factor.c
cfn=(3) factor_numeric
calls=1 0x300 1
+4 13 20
cfi=(4) harness/model/model.c
cfn=(4) model_alloc
calls=1 0x400 1
+4 14 33

fl=(2)
fn=(2)
0x200 1 50
+4 2 16
cfi=(5) elements/math/dense.c
cfn=(5) dense_add_congruence
calls=3 0x500 1
+8 3 24

fl=(5)
fn=(5)
0x500 1 24

fl=(3)
fn=(3)
0x300 1 8
cob=(2) /lib/libldl.so
cfi=(6) ???
cfn=(6) ldl_numeric
calls=1 0x200 0
+4 2 12

ob=(2)
fl=(6)
fn=(6)
0x200 0 12

ob=(1)
fl=(4)
fn=(4)
0x400 1 3
cfi=(2)
cfn=(2)
calls=1 0x200 1
-4 2 30
"""


class Parts(ProgramTest):

    def setUp(self):
        super().setUp()
        self.path = self.folder / "profile"
        self.path.write_text(PROFILE, encoding="ascii")

    def test_parts(self):
        parts = parts_of(Profile(self.path))
        self.assertEqual(dict(parts), {"strain": 60, "factorisation": 20, "set-up": 33, "rest": 12})

    def test_operations(self):
        numbers = {0x200: 4, 0x204: 1, 0x104: 2, 0x3fc: 1}
        self.assertEqual(operations(self.path, "/there/build/beamwork", numbers),
                         4 * 50 + 16 + 2 * 7)


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
