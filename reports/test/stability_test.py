"""The pages of stability and of Newton's method, analytic estimates and results of other programs must show the stored
values."""
import json
import math
import random
import re
import subprocess
import sys
import unittest

from harness.records.test.stored import put_experiment
from harness.tools import newton as tool
from harness.tools.kit.program import PROGRAM, ProgramTest, TRUTHS, run
from reports import answers_table, checks, data, newton, pages, predictions, stability
from reports.site import Site
from reports.test import results


class Stability(ProgramTest):

    def setUp(self):
        super().setUp()
        run("verify", "-k", "warping_torsion and beamw", "-o", self.folder / "results.h5")

    def page(self):
        site = Site(self.folder / "results.h5", TRUTHS, self.folder / "site")
        stability.write(site)
        return (self.folder / "site" / "stability.html").read_text(encoding="utf-8")

    def test_without_a_sweep(self):
        site = Site(self.folder / "results.h5", TRUTHS, self.folder / "site")
        self.assertFalse(stability.present(site))
        self.assertIn("stress", [command for command, _ in checks.more(site)])

    def test_sweep(self):
        self.answered("stress", "-k", "decay_free or twist_wagner", "-o",
                      self.folder / "results.h5")
        record = stability.read(self.folder / "results.h5")
        page = self.page()
        tried, survived = (sum(f[name] for f in record["formulations"])
                           for name in ("tried", "survived"))
        self.assertIn(f"of {tried} runs, {survived} gave", page)
        self.assertLess(survived, tried)
        self.assertIn('<svg id="stability_map"', page)
        for o in record["outcomes"]:
            if o["proof"]:
                self.assertIn(o["proof"].split("'")[0], page)

    def test_a_formulation_that_is_skipped_at_some_values(self):
        def outcome(x, kind):
            return {
                "extreme": "thin", "formulation": "beamw", "x": x, "outcome": kind, "error": 1e-9,
                "condition": None, "iterations": 1, "reason": "", "as_expected": True, "proof": ""
            }

        extreme = {
            "name": "thin", "summary": "", "case": "c", "fixed": "", "judge": "exact",
            "tolerance": 1e-6, "x_name": "x", "x_unit": "1"
        }
        tally = {
            "formulation": "beamw", "tried": 1, "survived": 1, "coarse": 0, "named_failures": 0,
            "wrong": 0, "faults": 0
        }
        record = {
            "extremes": [extreme], "formulations": [tally],
            "extreme_values": [{"extreme": "thin", "x": x} for x in (1.0, 2.0)],
            "extreme_quantities": [{"extreme": "thin", "quantity": "w"}],
            "outcomes": [outcome(1.0, "skip"), outcome(2.0, "value")], "unexpected": 0,
            "program_version": "0.1.0", "commit": "made up", "clock": "2026-01-01T00:00:00Z"
        }
        put_experiment(self.folder / "results.h5", "stress", record)
        page = self.page()
        self.assertIn("of 1 runs, 1 gave", page)
        self.assertIn("commit made up, 2026-01-01T00:00:00Z", page)
        self.assertIn("of the other pages are of commit", page)

    def test_findings_that_are_alike(self):
        def outcome(formulation, x, proof):
            return {"extreme": "thin", "formulation": formulation, "x": x, "outcome": "wrong",
                    "proof": proof, "reason": ""}

        found = stability.findings({"outcomes": [
            outcome("a", 2, "p"), outcome("a", 1, "p"), outcome("b", 1, "p"), outcome("b", 2, "p"),
            outcome("c", 1, "p"), outcome("d", 1, "q")]})
        self.assertEqual(found, [("thin", ["a", "b"], "wrong", "1, 2", "p"),
                                 ("thin", ["c"], "wrong", "1", "p"),
                                 ("thin", ["d"], "wrong", "1", "q")])

    def test_bands_of_the_map(self):
        many = [{"name": f"extreme_{i}", "values": [1.0]} for i in range(stability.MOST + 1)]
        cell = stability.Cell([{"outcome": "value", "error": 0.1, "condition": 1, "iterations": 1,
                                "reason": "", "as_expected": True}])
        record = {"extremes": many, "formulations": [{"formulation": "beamw"}]}
        markup = stability.draw_map(record, {(e["name"], "beamw"): {1.0: cell} for e in many},
                                    stability.LOOK, stability.MEANING).markup
        self.assertEqual(markup.count(">beamw<"), 2)
        self.assertEqual(markup.count(">extreme_"), len(many))
        width = float(re.search(r'width="(\d+)"', markup)[1])
        self.assertTrue(all(float(x) < width for x in re.findall(r"M([\d.]+) ", markup)))


STEP = {
    "path": 1.0, "increment": 1.0, "iterations": 3, "rejected": 0, "corrections": [0.1, 0.01, 1e-4],
    "residuals": [1.0, None, 1e-6]
}
SUMMARY = {
    "status": "ok", "reason": "", "steps": 2, "rejected": 1, "iterations": 9, "most_iterations": 5
}
DATA = {
    "singles": [{
        "case": "sheet", "parameter": "tilt", "unit": "rad", "values": [0.1, 0.2, 0.3],
        "formulation": "beam", "elements": 2, "mixed": [3, 4, 5], "displacement": [5, None, 9]
    }], "contests": [{
        "case": "sheet", "parameters": "", "formulation": "beam", "elements": 2, "first_steps": 4,
        "mixed": SUMMARY,
        "displacement": {**SUMMARY, "status": "not_converged", "reason": "Newton diverged"}
    }], "histories": [{
        "case": "roll", "formulation": "beam", "elements": 2, "form": form, "status": "ok",
        "reason": "", "steps": [STEP]
    } for form in newton.FORMS]
}


class NewtonSite(results.Site):
    def __init__(self, folder):
        super().__init__(str(folder / "results.h5"))
        self.images = []

    def image(self, figure, name):
        self.images.append(name)
        newton.plt.close(figure)
        return name


class Newton(ProgramTest):

    def test_what_is_written_is_what_is_drawn(self):
        solved = tool.solve(PROGRAM, "elastica", "", "beamw", "2", 0)
        steps = tool.steps_of(solved)
        self.assertGreater(len(steps), 0)
        for step in steps:
            self.assertLessEqual(set(STEP), set(step))
            self.assertEqual(len(step["residuals"]), len(step["corrections"]))
        self.assertLessEqual(set(SUMMARY), set(tool.summary(solved)))

    def test_largest(self):
        self.assertEqual(newton.largest([1, 2, 3], [4, 5, 6]), (3, 6))
        self.assertEqual(newton.largest([1, 2, 3], [4, None, 6]), (1, 4))
        self.assertEqual(newton.largest([1], [None]), (None, None))

    def test_page(self):
        site = NewtonSite(self.folder)
        self.assertFalse(newton.present(site))
        (self.folder / "newton.json").write_text(json.dumps(DATA), encoding="utf-8")
        self.assertTrue(newton.present(site))
        newton.write(site)
        page = site.pages["newton.html"]
        self.assertEqual(page["singles"][0][1][0][2], {"mixed": (0.3, 5), "displacement": (0.1, 5)})
        self.assertEqual(site.images, ["newton_roll"])
        self.assertEqual(len(page["histories"][0][2]), 2)


def point(prediction):
    mesh = data.Mesh(1,
                     "ok",
                     "",
                     data.Clock(0, 1e-3, 1e-3, 1e-3, 1),
                     8,
                     4,
                     "", {},
                     values={"C_zz": 2.2},
                     errors={"C_zz": 0.1},
                     predictions=prediction)
    verdict = data.Verdict("C_zz",
                           "pass",
                           truth_kind="exact",
                           truth=2.0,
                           limit=2.0,
                           order=2.0,
                           error=0.0)
    return data.Point("default", "", [data.Series("beam", "", "", "", [mesh], [verdict])],
                      {"C_zz": "m/N"})


class Predictions(unittest.TestCase):

    def test_errors(self):
        rows = predictions.of_point(point({"C_zz": 2.1}))
        self.assertEqual([(r[0], r[1], r[3]) for r in rows], [("C_zz", 2.1, [("beam", 1, 0.1)])])
        self.assertAlmostEqual(rows[0][2], 0.05)

    def test_section(self):
        case = data.Case("sheet", "", "", [point({"C_zz": 2.1}), point({})])
        (heading, markup), = predictions.section(None, case)
        self.assertEqual(heading, "Analytic prediction")
        self.assertEqual(markup.count("<table>"), 1)
        self.assertIn("+5.0000 %", markup)
        self.assertNotIn("&lt;", markup)
        self.assertEqual(predictions.section(None, data.Case("other", "", "", [point({})])), [])


HEAD = """# beamwork-import: 1
# program: {}
# case: elastica
quantity, unit, elements, unknowns, seconds, value
w_over_L, 1, 4, 24, 1e-3, 0.4620
w_over_L, 1, 8, 48, 2e-3, 0.4615
"""
EVIL = '_<script>alert(1)</script>&$x$"q"\\a'


class Beside(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.place = cls.class_folder()
        (cls.place / "theirs.csv").write_text(HEAD.format(EVIL.replace("/", "|")), encoding="utf-8")
        for done in (run("import", cls.place / "theirs.csv", "-o", cls.place / "theirs.h5"),
                     run("verify", "-k", "elastica/default", "-f", "beamw", "-f", "collocation",
                         "-o", cls.place / "ours.h5"),
                     run("verify", "-k", "elastica/default", "-f", "beamw", "--imported",
                         cls.place / "theirs.h5", "-o", cls.place / "both.h5")):
            assert done.returncode == 0, done.stderr

    def point(self, name):
        return data.read_case(self.place / name, "elastica").points[0]

    def test_ours_stay_ours(self):
        point = self.point("both.h5")
        self.assertEqual([s.key for s in point.series], ["beamw"])
        self.assertEqual([s.key for s in point.others], [EVIL.replace("/", "|")])
        self.assertEqual({v.verdict for s in point.others for v in s.verdicts} & {"pass"}, set())

    def test_errors_are_those_of_the_judge(self):
        case = data.read_case(self.place / "ours.h5", "elastica")
        data.add_beside([case], self.place / "theirs.h5")
        added, judged = case.points[0].others[0], self.point("both.h5").others[0]
        for a, b in zip(added.meshes, judged.meshes):
            self.assertTrue(math.isclose(a.errors["w_over_L"], b.errors["w_over_L"], rel_tol=1e-9))
            self.assertEqual((a.n, a.free, a.clock.solve), (b.n, b.free, b.clock.solve))
        data.add_beside([case], self.place / "theirs.h5")
        self.assertEqual(len(case.points[0].others), 1, "once is enough")

    def test_names_are_escaped_everywhere(self):
        folder = self.place / "report"
        pages.build(str(self.place / "both.h5"), TRUTHS, str(folder))
        seen = 0
        for page in list(folder.glob("*.html")) + list(folder.glob("*.svg")):
            text = page.read_text(encoding="utf-8")
            self.assertNotIn("<script>alert", text, page)
            seen += text.count("&lt;script&gt;alert(1)")
        self.assertGreaterEqual(seen, 2, "the page of the case and its figure")

    def test_look(self):
        self.assertEqual(data.style_beside(3)["color"], "currentColor")
        self.assertTrue(data.style_beside(3)["hollow"])


SELECTION = ("elastica/default or c_column/default or spherical_joint/default or "
             "warping_torsion/default or rotating_cantilever/default")
LEVELS = (*data.REACH, 3e-3, 2e-5)


def told(cases):
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


if __name__ == "__main__":
    unittest.main()
