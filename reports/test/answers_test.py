"""The formulation of lowest cost within a tolerance must be the one defined in reports/answers.py, and its page and
tables must contain the same answers."""
import csv
import html
import json
import math
import random
import re
import sys
import unittest

from harness.tools.kit.program import ProgramTest, ROOT, drawn, run
from reports import answers, answers_table, data
from reports.test.browser_test import CHROMIUM, chromium
from reports.test.results import Site, verdict


def clock(*rounds):
    return data.Clock(0, min(rounds), min(rounds), max(rounds), 5 if len(rounds) > 1 else 1, rounds)


def series(key, errors, costs, kind="pass", seconds=None):
    meshes = [data.Mesh(2**i, "ok", "", clock(*((seconds or {}).get(2**i, (1.0,)))), 8, 4, "", {},
                        errors={"u": e}, cost=c)
              for i, (e, c) in enumerate(zip(errors, costs))]
    out = data.Series(key, "", "", "", meshes, [verdict("u", kind, truth=1.0)])
    out.verdicts[0].reach = {level: n for level in data.REACH
                             if (n := answers.first_within(out, "u", level))}
    return out


def answer(*found, level=0.01, quantity="u", noise=1.25):
    return answers.answer(data.Point("default", "", list(found), {}, [], noise), quantity, level)


def told(ways):
    return [(w.key, w.n) for w in ways]


class Mesh(unittest.TestCase):

    def test_a_dip_is_no_arrival(self):
        dips = series("dips", (0.005, 0.05, 0.002, 0.001), (1, 2, 4, 8))
        self.assertEqual(told(answer(dips).best), [("dips", 4)])
        self.assertEqual(told(answer(dips, level=0.1).best), [("dips", 1)])
        lost = series("lost", (0.005, 0.001, math.nan), (1, 2, 4))
        self.assertEqual(answer(lost).missed, ["lost"])

    def test_any_level_by_the_same_rule(self):
        one = series("one", (-0.2, 0.03, -0.003, 0.003, 0.0004), (1, 2, 4, 8, 16))
        for level, n in ((0.5, 1), (0.2, 1), (0.19, 2), (0.03, 2), (0.003, 4), (0.001, 16),
                         (1e-4, None)):
            found = answer(one, level=level).best
            self.assertEqual(told(found), [("one", n)] if n else [], level)


class Order(unittest.TestCase):

    def test_work_ranks_and_clocks_do_not(self):
        fast = series("dear", (0.001,), (2e-3,), seconds={1: (1e-4, 1.1e-4)})
        slow = series("cheap", (0.001,), (1e-3,), seconds={1: (5e-4, 6e-4)})
        found = answer(fast, slow)
        self.assertEqual(told(found.best), [("cheap", 1)])
        self.assertEqual(told(found.faster), [("dear", 1)])
        overlap = series("dear", (0.001,), (2e-3,), seconds={1: (1e-4, 5.5e-4)})
        self.assertEqual(answer(overlap, slow).faster, [])

    def test_ties(self):
        one, two, three = (series(k, (0.001,), (c,)) for k, c in (("one", 1.2), ("two", 1.0),
                                                                 ("three", 1.3)))
        found = answer(one, two, three)
        self.assertEqual(told(found.best), [("two", 1), ("one", 1)])
        self.assertEqual(told(found.dearer), [("three", 1)])
        self.assertEqual([(w.key, rank, tie) for w, rank, tie in found.ways],
                         [("two", 1, True), ("one", 2, True), ("three", 3, False)])
        self.assertEqual(told(answer(series("b", (0,), (1,)), series("a", (0,), (1,))).best),
                         [("a", 1), ("b", 1)])

    def test_times_shuffled_by_three_change_nothing(self):
        dice = random.Random(16)
        kinds = ("pass", "pass", "wrong limit")
        found = [series(f"f{i}", sorted((10**dice.uniform(-5, -1) for _ in range(5)), reverse=True),
                        [dice.uniform(1, 5) * 2**k for k in range(5)], dice.choice(kinds))
                 for i in range(9)]

        def answered():
            return [[told(part) for part in (a.best, a.dearer, a.defective)]
                    for a in (answer(*found, level=level) for level in (0.1, 0.01, 0.003, 1e-3))]

        before = answered()
        for s in found:
            for m in s.meshes:
                m.clock = clock(*(m.clock.least * 3**dice.uniform(-1, 1) for _ in range(5)))
        self.assertEqual(answered(), before)


    def test_variants_that_repeat(self):
        plain, same = series("one", (0.02, 0.001), (1, 2)), series("one:mass=lumped", (0.02, 0.001),
                                                                   (1, 2))
        self.assertEqual(told(answer(plain, same).best), [("one", 2)])
        self.assertEqual(told(answer(same).best), [("one:mass=lumped", 2)])
        for other in (series("one:mass=lumped", (0.03, 0.001), (1, 2)),
                      series("one:mass=lumped", (0.02, 0.001), (1, 2.1))):
            self.assertEqual(len(answer(plain, other).best), 2)


class Defects(unittest.TestCase):

    def test_never_the_cheapest(self):
        for kind in ("biased", "wrong limit", "biased, as predicted", "wrong limit, as predicted",
                     "low order", "undecided", "diverged"):
            wrong = series("wrong", (0.001,), (1,), kind)
            right = series("right", (0.001,), (100,))
            found = answer(wrong, right)
            self.assertEqual(told(found.best), [("right", 1)], kind)
            self.assertEqual(told(found.defective), [("wrong", 1)], kind)
            self.assertTrue(answers.defect_words(found.defective[0]))
            alone = answer(wrong)
            self.assertEqual((alone.best, told(alone.defective)), ([], [("wrong", 1)]), kind)

    def test_of_all_quantities_one_is_enough(self):
        one = series("one", (0.001,), (1,))
        one.meshes[0].errors["v"] = 0.002
        one.verdicts.append(verdict("v", "biased", truth=1.0, error=0.002))
        one.verdicts[1].reach = {0.01: 1}
        self.assertEqual(told(answer(one).best), [("one", 1)])
        found = answer(one, quantity=answers.ALL)
        self.assertEqual((found.best, told(found.defective)), ([], [("one", 1)]))

    def test_without_a_truth_of_its_theory(self):
        one, two = series("one", (0.001,), (1,)), series("two", (0.001,), (1,))
        two.verdicts[0].truth = math.nan
        found = answer(one, two)
        self.assertEqual((told(found.best), found.unjudged), ([("one", 1)], ["two"]))


SELECTION = "elastica/default or warping_torsion/default"
LEVELS = (0.1, 0.03, 0.01, 0.004, 1e-3, 2e-4, 1e-4, 1e-6)


class Page(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.folder_ = cls.class_folder()
        cls.site = drawn(cls.folder_, "-k", SELECTION)
        _, cls.cases = data.read_results(cls.folder_ / "results.h5")
        cls.page = (cls.site / "answers.html").read_text(encoding="utf-8")
        stored = (cls.site / "answers_points.js").read_text(encoding="utf-8")
        cls.points = json.loads(stored.removeprefix("window.answersPoints = ").removesuffix(";\n"))

    def test_the_stored_meshes_are_those_of_the_rule(self):
        seen = 0
        for case in self.cases:
            for point in case.points:
                for series in point.series:
                    if series.other:
                        self.assertFalse(any(v.reach for v in series.verdicts), series.key)
                        continue
                    for v in series.verdicts:
                        for level in data.REACH:
                            rule = answers.first_within(series, v.quantity, level)
                            self.assertEqual(v.reach.get(level), rule, (series.key, level))
                            seen += rule is not None
        self.assertGreater(seen, 20)

    def test_points_say_what_the_answers_say(self):
        for one, case in zip(self.points["cases"], self.cases):
            for quantity, found in one["asked"]:
                for level in LEVELS:
                    sound = answers.answer(case.points[0], quantity, level)
                    right = {w.key: w.n for w, _, _ in sound.ways}
                    told = {}
                    for index, _, errors in found:
                        at = next((i for i, e in enumerate(errors)
                                   if e is not None and e <= level), None)
                        if at is not None:
                            told[self.points["keys"][index]] = one["meshes"][str(index)][0][at]
                    self.assertEqual(told, right, (case.name, quantity, level))

    def test_tables(self):
        rows = list(csv.DictReader(
            (self.site / "answers.csv").read_text(encoding="utf-8").splitlines()))
        whole = json.loads((self.site / "answers.json").read_text(encoding="utf-8"))
        found = []
        for *question, ways in whole["answers"]:
            for way in ways:
                row = dict(zip(whole["asked"] + whole["columns"], question + way))
                found.append({**row, "formulation": whole["formulations"][row["formulation"]]})
        self.assertEqual(found, answers_table.rows(self.cases))
        first = {c.name: answers_table.asked_of(c.points[0])[0] for c in self.cases}
        together = [r for r in found if r["quantity"] == first[r["case"]]]
        self.assertEqual(len(rows), len(together))
        for a, b in zip(rows, together):
            self.assertEqual((a["formulation"], int(a["n"]), float(a["tolerance"])),
                             (b["formulation"], b["n"], b["tolerance"]))
        first = [r for r in found if r["rank"] == 1 and r["case"] == "elastica"]
        right = {level: answers.answer(self.cases[0].points[0], answers_table.asked_of(
            self.cases[0].points[0])[0], level).best[0].key for level in data.REACH}
        self.assertEqual({r["tolerance"]: r["formulation"] for r in first
                          if r["quantity"] == first[0]["quantity"]}, right)

    def test_terminal(self):
        done = run("-m", "reports.answers_table", self.folder_ / "results.h5", "--error", "0.3%",
                   program=sys.executable, cwd=ROOT)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("0.3 %: ", done.stdout)
        bad = run("-m", "reports.answers_table", self.folder_ / "results.h5", "--error", "3",
                  program=sys.executable, cwd=ROOT)
        self.assertEqual(bad.returncode, 2)
        self.assertIn("give an error such as 0.3%", bad.stderr)
        self.assertIn("cannot be read", run("-m", "reports.answers_table", "no.h5",
                                            program=sys.executable, cwd=ROOT).stderr)

    def test_what_has_no_prices_is_told(self):
        self.assertNotIn("Without cost coefficients of their own", self.page)
        for mesh in self.cases[0].points[0].series[0].meshes:
            mesh.priced = False
        site = Site(cases=self.cases)
        site.folder, site.about, site.bench = self.folder, {}, None
        answers_table.write(site)
        self.assertEqual(site.pages["answers.html"]["unpriced"],
                         [self.cases[0].points[0].series[0].key])
        for mesh in self.cases[0].points[0].series[0].meshes:
            mesh.priced = True

    def test_without_script_the_standard_levels(self):
        for level in ("10 %", "1 %", "0.1 %", "0.01 %"):
            self.assertIn(f"<th>{level}</th>", self.page)
        point = self.cases[0].points[0]
        words = answers_table.sentence(
            answers.answer(point, answers_table.asked_of(point)[0], 0.01))
        self.assertIn(f"<td>{html.escape(words)}</td>", self.page)

    def asked(self, *said):
        script = "".join(f"field({name!r}, {value!r});" for name, value in said)
        (self.site / "ask.js").write_text(
            "const field = (name, value) => { const at = document.getElementById(name);"
            "at.value = value; at.dispatchEvent(new Event('input', { bubbles: true })); };" + script,
            encoding="utf-8")
        page = self.page.replace("</head>", '<script src="ask.js" defer></script></head>')
        (self.site / "asked.html").write_text(page, encoding="utf-8")
        return chromium(self.folder_, "--dump-dom", "--virtual-time-budget=2000",
                        f"file://{self.site}/asked.html").stdout

    @unittest.skipUnless(CHROMIUM, "needs chromium")
    def test_the_script_answers(self):
        for said, level in (((), 0.01), ((("tolerance", "0.3"),), 0.003),
                            ((("tolerance", "0,02 %"),), 2e-4)):
            page = self.asked(*said)
            self.assertIn(f"least cost within {100 * level:g} %", page)
            right = 0
            for case in self.cases:
                point = case.points[0]
                found = answers.answer(point, answers_table.asked_of(point)[0], level)
                told = ", ".join(f"{w.key} n&nbsp;=&nbsp;{w.n}" for w in found.best)
                right += bool(found.best)
                self.assertTrue(not told or f"<td>{told}" in page, told)
            self.assertTrue(f"{right} of {len(self.cases)} reached" in page)

    @unittest.skipUnless(CHROMIUM, "needs chromium")
    def test_the_script_asks_again(self):
        for value in ("20", "0", "much", ""):
            self.assertTrue("Give a tolerance from 0.0001 to 10 %." in
                            self.asked(("tolerance", value)), value)
        page = self.asked(("which", "each"), ("case", "elastica"))
        rows = len(answers_table.asked_of(self.cases[0].points[0])) - 1
        self.assertTrue(f"{rows} of {rows} reached" in page)


class Names(unittest.TestCase):

    def test_rounding_never_lets_a_mesh_in(self):
        for value in (0.0100000004, 0.0099999996, 1 / 3, 1.23456789e-7):
            self.assertGreaterEqual(answers_table.outward(value), value)
            self.assertLess(answers_table.outward(value), value * (1 + 2e-5))

    def test_defects_have_words(self):
        self.assertEqual(answers_table.defect_of([verdict("u", "pass")]), "")
        self.assertEqual(answers_table.defect_of([verdict("u", "pass"), verdict("v", "biased")]),
                         "with a different limit")


if __name__ == "__main__":
    unittest.main()
