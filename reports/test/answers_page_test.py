"""The page of answers and the tables beside it: the reader's tolerance by the rule of the judge."""
import csv
import html
import json
import re
import sys
import unittest

from harness.tools.kit.program import ROOT, ProgramTest, drawn, run
from reports import answers, answers_table, data
from reports.test.browser_test import CHROMIUM, chromium
from reports.test.results import Site, verdict

SELECTION = "elastica/default or warping_torsion/default"
LEVELS = (0.1, 0.03, 0.01, 0.004, 1e-3, 2e-4, 1e-4, 1e-6)


class Page(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.folder_ = cls.class_folder()
        cls.site = drawn(cls.folder_, "-k", SELECTION)
        _, cls.cases = data.read_results(cls.folder_ / "results.h5")
        cls.page = (cls.site / "answers.html").read_text(encoding="utf-8")
        cls.points = json.loads(re.search(r'id="points">(.*?)</script>', cls.page, re.S).group(1))

    def test_the_stored_meshes_are_those_of_the_rule(self):
        seen = 0
        for case in self.cases:
            for point in case.points:
                for series in point.series:
                    if series.other:  # which reaches nothing, however near it is
                        self.assertFalse(any(v.reach for v in series.verdicts), series.key)
                        continue
                    for v in series.verdicts:
                        for level in data.REACH:
                            rule = answers.first_within(series, v.quantity, level)
                            self.assertEqual(v.reach.get(level), rule, (series.key, level))
                            seen += rule is not None
        self.assertGreater(seen, 20)

    def test_points_say_what_the_answers_say(self):
        """By the rule of the script, at any tolerance."""
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
        """The page's document after the fields were given these values."""
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

    def test_nothing_of_a_file_ends_the_script(self):
        text = answers_table.embedded({"case": "</script><b>&"})
        self.assertNotIn("<", text)
        self.assertEqual(json.loads(text), {"case": "</script><b>&"})

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
