"""The answers, texts, maps and page of integrators must agree with artificial records (motions.py)."""
import json
import re
import unittest

from harness.tools.kit.program import ProgramTest, drawn
from reports import integrators, integrators_page
from reports.data import Unreadable
from reports.test import motions
from reports.test.browser_test import CHROMIUM, chromium, console


def problems(found=None):
    return integrators.problems_of(found or motions.record())


class Answers(unittest.TestCase):

    def setUp(self):
        self.every = integrators.judged(problems())
        self.one = self.every[0]

    def test_judged(self):
        self.assertEqual(len(self.every), 4)
        self.assertEqual(len(problems()), 4 * len(motions.STIFFENINGS))
        self.assertEqual({p.stiffening for p in self.every}, {1})

    def test_best(self):
        for level in integrators.LEVELS:
            found = integrators.answer(self.one, level)
            costs = {}
            for scheme, (order, error) in motions.CONSTANTS.items():
                within = [h for h in motions.STEPS if error * h**order <= level]
                if within:
                    costs[scheme] = motions.COSTS[scheme] / max(within)
            self.assertEqual([w.scheme for w in found.ways], sorted(costs, key=costs.get))
            self.assertLessEqual(found.best.run.error, level)

    def test_ties(self):
        found = integrators.answer(self.one, 1e-2, noise=1.4)
        self.assertEqual((found.best.scheme, found.ties), ("radau", ("alpha",)))
        self.assertEqual(integrators.answer(self.one, 1e-2, noise=1.01).ties, ())

    def test_series(self):
        rows = [motions.run("radau", 0.1, tolerance=x) for x in (1e-6, 1e-3)]
        self.one.runs += [integrators.run_of(r) for r in rows]
        equal, by_tolerance = integrators.series(self.one, "radau")
        self.assertEqual([r.step for r in equal], [0.2] + motions.STEPS)
        self.assertEqual([r.tolerance for r in by_tolerance], [1e-3, 1e-6])
        self.assertEqual(by_tolerance[0].setting, "tolerance 0.001")

    def test_doubt(self):
        way = integrators.answer(self.one, 1e-2).best
        self.assertEqual(integrators.doubt(self.one, way), "")
        self.one.uncertainty = 1.0
        self.assertIn("reference", integrators.doubt(self.one, way))

    def test_profile(self):
        for level in integrators.LEVELS:
            curves = integrators.profile(self.every, level)
            self.assertEqual(set(curves), set(motions.CONSTANTS))
            for shares in curves.values():
                self.assertEqual(shares, sorted(shares))
            self.assertAlmostEqual(max(s[0] for s in curves.values()), 1)
        self.assertEqual(integrators.profile(self.every, 1e-6)["alpha"][-1], 0)

    def test_summary(self):
        for own in integrators.by_case(self.every).values():
            self.assertEqual(len(own), 2)
            for level in integrators.LEVELS:
                found = integrators.summary(own, level)
                count, reached = integrators.wins(own, level)
                self.assertEqual((dict(found.wins), found.reached, found.count),
                                 (count, reached, 2))
                self.assertEqual({w.scheme for w in found.best}, {found.wins[0][0]})
                kept = any(w.scheme == "conserving" for p in own
                           for w in integrators.answer(p, level).ways)
                self.assertEqual({s for s, _ in found.keeping}, {"conserving"} if kept else set())
                for p, (_, ratio) in zip(own, found.keeping):
                    ways = {w.scheme: w.cost for w in integrators.answer(p, level).ways}
                    self.assertEqual(ratio, ways["conserving"] / min(ways.values()))

    def test_counted(self):
        self.assertEqual(integrators.counted(self.every, 1e-2), dict.fromkeys(motions.CONSTANTS, 4))
        self.assertEqual(integrators.counted(self.every, 1e-6),
                         {"alpha": 0, "conserving": 0, "radau": 4})

    def test_iterations(self):
        rows, stiffenings = integrators.iterations(problems())
        self.assertEqual(stiffenings, list(motions.STIFFENINGS))
        self.assertEqual(rows[self.one.name, "alpha", 0.4], {1: 3.0, 1e3: 3.0, 1e6: 3.0})
        self.assertNotIn((self.one.name, "radau", 0.2), rows)

    def test_without_a_reference(self):
        found = motions.record()
        found["references"][0]["reason"] = "no result after 120 s"
        every = problems(found)
        self.assertEqual(len(integrators.judged(every)), 3)
        self.assertEqual([p.reference for p in integrators_page.unmeasured(every)],
                         ["no result after 120 s"])

    def test_structures(self):
        found = integrators.structures(problems())
        self.assertEqual(len(found), 4)
        self.assertEqual({p.stiffening for own in found.values() for p in own},
                         set(motions.STIFFENINGS))

    def test_names(self):
        self.assertEqual(integrators.ordered({"radau", "new", "alpha:rho=0.5", "alpha"}),
                         ["alpha", "alpha:rho=0.5", "radau", "new"])


class Words(unittest.TestCase):

    def test_first(self):
        every = problems()
        text = integrators_page.first(every, 1.0)
        for level in integrators.LEVELS:
            count, reached = integrators.wins(integrators.judged(every), level)
            said = re.search(rf"within {100 * level:g} % (.*?)[;.]", text)[1]
            told = {s: int(n) for s, n in re.findall(r"(\w+) in (\d+)", said)}
            self.assertEqual(told, {s: n for s, n in count.items() if 2 * n >= max(count.values())})
            self.assertTrue(said.endswith(f"of {reached}"), said)
        self.assertIn("12 answers are verified", text)

    def test_one_problem(self):
        one = problems()[:1]
        best = integrators.answer(one[0], 1e-2).best
        self.assertIn(f"within 1 % {best.scheme} with step {best.run.step:g} s",
                      integrators_page.first(one, 1.0))

    def test_doubt(self):
        found = motions.record(cases=("pendulum",), formulations=("collocation",))
        for row in found["orders"]:
            if row["integrator"] == "radau":
                row.update(order=1.0, verdict="low order")
        text = integrators_page.first(problems(found), 1.0)
        self.assertIn("3 of these 3 answers are uncertain", text)
        self.assertRegex(text, r"order 1\.0, not 5")

    def test_nothing(self):
        self.assertIn("No run", integrators_page.first([], 1.0))
        rows = [motions.run("alpha", 1.0)]
        one = integrators.problems_of(motions.group("a", "b", rows))[0]
        self.assertIn("within 1 % none", integrators_page.first([one], 1.0))

    def test_stability(self):
        text = integrators_page.stability(next(iter(integrators.structures(problems()).values())))
        self.assertIn("The energy stays bounded everywhere with alpha and conserving", text)
        self.assertIn("with trapezoidal, the energy grows or the motion stops at steps of 0.05 s or more", text)

    def test_iterations(self):
        rows = {"a": {1: 3.0, 1e6: 3.25}, "b": {1: 4.0, 1e3: 9.0, 1e6: 4.5}}
        self.assertIn("increases by at most 0.5.", integrators_page.iterations(rows))
        self.assertEqual(integrators_page.iterations({}), "")

    def test_verdicts(self):
        rows = [motions.VERDICT, {**motions.VERDICT, "as_expected": False}]
        self.assertIn("all as expected", integrators_page.verdicts(rows[:1]))
        self.assertIn("1 not as expected", integrators_page.verdicts(rows))


class Map(unittest.TestCase):

    def setUp(self):
        self.problems = next(iter(integrators.structures(problems()).values()))

    def test_letters(self):
        markup = integrators_page.draw_map(self.problems, legend=False).markup
        fields = re.findall(r"<title>(.*?)</title>.*?<text[^>]*>(\w)</text>", markup)
        wanted = integrators_page.fates(self.problems)
        self.assertEqual(len(wanted), 3 * len(motions.FATE_STEPS) * len(motions.STIFFENINGS))
        self.assertEqual(len(fields), len(wanted))
        for words_of, letter in fields:
            scheme, step, by, what = re.match(r"(\w+), step (\S+) s, EA × (\S+): (\w+)",
                                              words_of).groups()
            self.assertEqual(what, motions.fate(scheme, float(step), float(by)))
            self.assertEqual(letter, integrators_page.LOOK[what][0])

    def test_letters_differ(self):
        self.assertEqual(len({look[0] for look in integrators_page.LOOK.values()}), len(integrators_page.LOOK))
        self.assertEqual(len({look[1] for look in integrators_page.LOOK.values()}), len(integrators_page.LOOK))

    def test_not_run(self):
        self.problems[-1].runs.pop()
        self.assertEqual(integrators_page.draw_map(self.problems).markup.count("–"), 1)


class Page(ProgramTest):

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        motions.leave(folder / "results.h5", motions.record())
        cls.site = drawn(folder, "-k", "elastica/default")
        cls.text = (cls.site / "integrators.html").read_text(encoding="utf-8")

    def test_figures(self):
        self.assertEqual(len(re.findall(r'<svg id="integrators_(?!profile)', self.text)), 2)
        self.assertEqual(len(re.findall(r'<svg id="map_', self.text)), 4)
        for scheme in motions.CONSTANTS:
            self.assertIn(f'data-f="{scheme}"', self.text)
        self.assertIn("step 3 does not converge", self.text)

    def test_every_case(self):
        folder = self.folder
        motions.leave(folder / "results.h5", motions.record())
        motions.write(folder / "integrators.json", motions.integrator_runs())
        site = drawn(folder, "-k", "elastica/default")
        text = (site / "integrators.html").read_text(encoding="utf-8")
        self.assertIn("Of 6 problems", text)
        self.assertEqual(len(re.findall(r'<details id="of_', text)), 3)
        self.assertEqual(len(re.findall(r'<svg id="integrators_(?!profile)', text)), 3)
        self.assertEqual(len(re.findall(r'<svg id="map_', text)), 4)
        table = re.search(r'(?s)id="reference".*?</table>', text)[0]
        self.assertIn('<td class="n">3.0e-09</td><td class="n">4.0e-10</td>', table)
        self.assertIn("not possible: no inertia", table)
        self.assertIn("elbow, beamw_vlasov: does not support shear", text)
        self.assertRegex(text, r"conserves energy to round-off: conserving, at [\d.]+ times the cost")

    def test_old_integrator_runs(self):
        motions.leave(self.folder / "results.h5", motions.record())
        for text in ('{"cases": []}', "[1", "[]"):
            (self.folder / "integrators.json").write_text(text, encoding="utf-8")
            with self.assertRaisesRegex(Unreadable, "run 'make lab L=integrators', or remove it"):
                integrators.read(self.folder / "results.h5")

    def test_nothing_from_elsewhere(self):
        self.assertNotRegex(self.text, r'(src|href)="https?:')

    def test_absent(self):
        self.assertFalse(integrators_page.present(type("Site", (), {
            "results": str(self.folder / "results.h5")})))

    def test_commit(self):
        self.assertRegex(self.text, r"beamwork motion</code>, version 0\.1\.0, commit made up, "
                                    r"2026-01-01T00:00:00Z; <span class=\"unexpected\">")

    @unittest.skipUnless(CHROMIUM, "needs chromium")
    def test_browser(self):
        copy = self.site / "marks.html"
        action = """<pre id="out"></pre><script>addEventListener("load", () => {
          const frame = document.querySelector(".scroll ~ details [data-p]").closest("div.figure");
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
