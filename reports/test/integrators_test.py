"""The page of integrators: who is soonest, orders, maps with letters, sentences against data."""
import json
import math
import re
import unittest

from harness.test.program import ProgramTest, drawn
from reports import integrators_page
from reports.integrators import answers, map as stability, stored, words
from reports.test import motions
from reports.test.browser_test import CHROMIUM, chromium, console


def problems(found=None):
    return [stored.problem_of(row) for row in (found or motions.record())["cases"]]


class Answers(unittest.TestCase):

    def setUp(self):
        self.one = problems()[0]

    def test_way(self):
        """The cheapest run from which on all finer ones are within, too."""
        runs = answers.series(self.one, "alpha")
        self.assertEqual([r.step for r in runs], sorted((r.step for r in runs), reverse=True))
        level = 1.01 * runs[2].error
        self.assertIs(answers.way(runs, level), runs[2])
        worse = [*runs[:4], stored.run_of(motions.run("alpha", 0.01, error=1.0)), runs[5]]
        self.assertIs(answers.way(worse, level), runs[5])
        self.assertIsNone(answers.way(worse[:5], level))

    def test_a_failed_run_reaches_nothing(self):
        failed = [r for r in self.one.runs if r.status != "ok"]
        self.assertEqual(len(failed), 1)
        self.assertIsNone(answers.way(failed, 1e9))

    def test_best(self):
        """Errors are C step^p and costs c/step: what is least can be said."""
        for level in answers.LEVELS:
            found = answers.answer(self.one, level)
            steps = [0.1 / 2**i for i in range(6)]
            costs = {}
            for scheme, (order, error) in motions.CONSTANTS.items():
                within = [h for h in steps if error * h**order <= level]
                if within:
                    costs[scheme] = motions.COSTS[scheme] / max(within)
            self.assertEqual(found.best.scheme, min(costs, key=costs.get))
            self.assertEqual(set(found.ways), set(costs))

    def test_ties(self):
        found = answers.answer(self.one, 1e-2, noise=1.4)
        self.assertEqual((found.best.scheme, found.ties), ("radau", ("alpha",)))
        self.assertEqual(answers.answer(self.one, 1e-2, noise=1.01).ties, ())

    def test_orders(self):
        for scheme, (order, _) in motions.CONSTANTS.items():
            self.assertAlmostEqual(answers.order(answers.series(self.one, scheme)), order)
        self.assertTrue(math.isnan(answers.order(answers.series(self.one, "explicit"))))

    def test_profile(self):
        """Shares grow with the factor and end with what is reached at all."""
        for level in answers.LEVELS:
            curves = answers.profile(problems(), level)
            self.assertEqual(set(curves), set(motions.CONSTANTS))
            for shares in curves.values():
                self.assertEqual(shares, sorted(shares))
            self.assertAlmostEqual(max(s[0] for s in curves.values()), 1)
        self.assertEqual(answers.profile(problems(), 1e-6)["alpha"][-1], 0)

    def test_iterations(self):
        """At each stiffness, of the same step."""
        rows, stiffenings = answers.iterations(problems())
        self.assertEqual(stiffenings, [1, 1e3, 1e6])
        self.assertIn((self.one.name, "alpha", 0.05), rows)

    def test_names(self):
        row = motions.run("alpha", 0.1)
        self.assertEqual(stored.run_of({**row, "rho": 0.6}).scheme, "alpha:rho=0.6")
        self.assertEqual(stored.run_of({**row, "rho": None}).scheme, "alpha")
        self.assertEqual(stored.ordered({"radau", "new", "alpha:rho=0.6", "alpha"}),
                         ["alpha", "alpha:rho=0.6", "radau", "new"])


class Words(unittest.TestCase):

    def test_first(self):
        """The counts in the sentence are those of the answers."""
        every = problems()
        text = words.first(every, 1.0)
        for level in answers.LEVELS:
            count, reached = answers.wins(every, level)
            said = re.search(rf"within {100 * level:g} % (.*?)[;.]", text)[1]
            self.assertEqual({s: int(n) for s, n in re.findall(r"(\w+) in (\d+)", said)}, count)
            self.assertTrue(said.endswith(f"of {reached}"), said)
        self.assertIn("They can be believed", text)

    def test_one_problem(self):
        """The step stands in the sentence."""
        one = problems()[:1]
        best = answers.answer(one[0], 1e-2).best
        self.assertIn(f"within 1 % {best.scheme} with step {best.step:g} s", words.first(one, 1.0))

    def test_doubt(self):
        """Of a scheme that wins and falls more slowly than it should."""
        found = motions.record(cases=("pendulum",), formulations=("collocation",))
        for row in found["cases"][0]["runs"]:
            if row["integrator"] == "radau" and row["status"] == "ok":
                row["error"] = 1e-5 * row["step"]
        text = words.first(problems(found), 1.0)
        self.assertIn("should not be relied on", text)
        self.assertRegex(text, r"order 1\.0, not 5")

    def test_nothing(self):
        self.assertIn("No run", words.first([], 1.0))
        rows = [{**motions.run("alpha", 1.0), "error": None}]
        empty = stored.problem_of({"case": "a", "formulation": "b", "elements": 1, "runs": rows})
        self.assertIn("within 1 % none", words.first([empty], 1.0))

    def test_stability(self):
        text = words.stability(problems()[0].cells)
        self.assertIn("conserving", text)
        self.assertIn("trapezoidal grows or stops from a step of 0.05 s on", text)


class Map(unittest.TestCase):

    def test_letters(self):
        """Each field has the letter of its outcome, and says it in words."""
        problem = problems()[0]
        markup = stability.draw(problem, legend=False).markup
        fields = re.findall(r"<title>(.*?)</title>.*?<text[^>]*>(\w)</text>", markup)
        self.assertEqual(len(fields), len(problem.cells))
        wanted = {(c.scheme, c.step, c.stiffening): c for c in problem.cells}
        for words_of, letter in fields:
            scheme, step, by, what = re.match(r"(\w+), step (\S+) s, EA × (\S+): (\w+)",
                                              words_of).groups()
            cell = wanted[scheme, float(step), float(by)]
            self.assertEqual((what, letter), (cell.outcome, stability.LOOK[cell.outcome][0]))

    def test_letters_differ(self):
        self.assertEqual(len({look[0] for look in stability.LOOK.values()}), len(stability.LOOK))
        self.assertEqual(len({look[1] for look in stability.LOOK.values()}), len(stability.LOOK))

    def test_not_run(self):
        problem = problems()[0]
        del problem.cells[0]
        self.assertEqual(stability.draw(problem).markup.count("–"), 1)


class Page(ProgramTest):

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        motions.write(folder / "motion.json", motions.record())
        cls.site = drawn(folder, "-k", "elastica/default")
        cls.text = (cls.site / "integrators.html").read_text(encoding="utf-8")

    def test_figures(self):
        """A diagram for each case, a map for each problem, curves for each scheme."""
        self.assertEqual(len(re.findall(r'<svg id="integrators_(?!profile)', self.text)), 2)
        self.assertEqual(len(re.findall(r'<svg id="map_', self.text)), 4)
        for scheme in motions.CONSTANTS:
            self.assertIn(f'data-f="{scheme}"', self.text)
        self.assertIn("step 3 does not converge", self.text)

    def test_nothing_from_elsewhere(self):
        self.assertNotRegex(self.text, r'(src|href)="https?:')

    def test_absent(self):
        """Without its file there is no page."""
        self.assertFalse(integrators_page.present(type("Site", (), {
            "results": str(self.folder / "results.h5")})))

    @unittest.skipUnless(CHROMIUM, "needs chromium")
    def test_browser(self):
        """Marks say what was chosen, without a message of the console."""
        copy = self.site / "marks.html"
        action = """<pre id="out"></pre><script>addEventListener("load", () => {
          const frame = document.querySelector("[data-p]").closest("div.figure");
          frame.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true }));
          const told = JSON.stringify(document.querySelector("#said").innerText);
          document.querySelector("#out").textContent = told;
        });</script>"""
        copy.write_text(self.text.replace("</body>", action + "</body>"), encoding="utf-8")
        ran = chromium(self.folder, "--virtual-time-budget=9000", "--dump-dom", copy.as_uri())
        self.assertEqual(console(ran), [])
        said = json.loads(re.search(r'<pre id="out">(.+?)</pre>', ran.stdout, re.S)[1])
        self.assertRegex(said, r"(?s)alpha.*step 0\.1 s.*error.*iterations a step\s+3\b")


if __name__ == "__main__":
    unittest.main()
