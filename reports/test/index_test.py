"""The first page: what its lists are made of; nothing is empty where there is little to show."""
import re
import sys
import unittest

from harness.tools.kit.program import ROOT, TRUTHS, ProgramTest, drawn, report, run
from harness.tools.kit.scenes import LEAF
from reports import data, index
from reports.test.results import case, series

SCENE = """beamwork: 1
nodes:
  node_0: {at: [0, 0, 0], hold: all}
analyses:
  analysis_0: {static: {steps: 4}}
  "second": {compliance: {about: analysis_0, node: node_0}}
quantities:
  "linear": {displacement: {analysis: analysis_0}}
"""


class Kinds(unittest.TestCase):

    def test_analyses_of_a_scene(self):
        self.assertEqual(index.analyses_in(SCENE), ["static", "compliance"])
        self.assertEqual(index.analyses_in("beamwork: 1\n"), [])

    def test_the_first_kind_counts(self):
        self.assertEqual(index.kind_of(["static", "compliance"]), "stiffness and compliance")
        self.assertEqual(index.kind_of(["modal", "buckling"]), "buckling")
        self.assertEqual(index.kind_of([]), index.OTHER)


class Agreed(unittest.TestCase):

    def tried(self, key, limit, errors):
        """A formulation on meshes of 1, 2, 4 ... elements with these errors of the agreed 2."""
        found = series(key, [data.Verdict("u", "no truth", limit=limit, model_truth=2.0,
                                          model_truth_kind="agreement", model_error=limit / 2 - 1)])
        clock = data.Clock(0, 1, 1, 1, 1)
        found.meshes = [data.Mesh(2**i, "ok", "", clock, 8, 4, "", {}, model_errors={"u": e})
                        for i, e in enumerate(errors)]
        return found

    def rows(self, *tries):
        one = case("one", *tries)
        one.points[0].units = {"u": "m"}
        return index.rows_agreed([one], 0.01)

    def test_limits_and_meshes(self):
        row, = self.rows(self.tried("a", 2.0, (0.5, 0.002, 0.02, 0.001)),
                         self.tried("b", 2.1, (0.5, 0.1, 0.06, 0.05)),
                         self.tried("c", 2.0, (0.1, 0.005, 0.001, 0)))
        self.assertEqual((row.value, row.unit, row.within(0.01)), (2.0, "m", ["a", "c"]))
        self.assertEqual((row.farthest, row.fewest), ("b", (2, ["c"])))
        self.assertEqual(row.meshes, {"a": 8, "c": 2})

    def test_the_same_everywhere(self):
        row, = self.rows(self.tried("a", 2.0, (0,)), self.tried("b", 2.0, (0,)))
        self.assertEqual((row.farthest, row.fewest), (None, (1, ["a", "b"])))

    def test_what_has_a_truth_is_judged(self):
        one = self.tried("a", 2.0, (0,))
        one.verdicts[0].truth = 2.0
        self.assertEqual(self.rows(one), [])


class Small(ProgramTest):

    def whole(self, page):
        """A page without empty tables, lists and figures."""
        self.assertEqual(re.findall(r"<(table|ul|figure)[^>]*>\s*</\1>", page), [])
        return page

    def test_a_scene_without_truths(self):
        scene, results, site = (self.folder / name for name in ("mine.yaml", "mine.h5", "site"))
        scene.write_text(LEAF, encoding="utf-8")
        run("verify", "--scene", scene, "-f", "collocation", "-f", "beamw_consistent", "-o", results)
        self.assertEqual(report(results, site).returncode, 0)
        page = self.whole((site / "index.html").read_text(encoding="utf-8"))
        self.assertIn("No quantity of these results has a truth", page)
        self.assertIn("what formulations agree on", page)
        self.assertNotIn("<figure>", page)
        self.assertIn("No quantity of these results has one", self.whole(
            (site / "profiles.html").read_text(encoding="utf-8")))

    def test_one_mesh(self):
        """Its values have no limit that is known, nor an order: a whole site all the same."""
        scene, results, site = (self.folder / name for name in ("mine.yaml", "mine.h5", "site"))
        scene.write_text(LEAF + "meshes: [4]\n", encoding="utf-8")
        run("verify", "--scene", scene, "-f", "collocation", "-f", "beamw", "-o", results)
        done = report(results, site)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("not known how well", (site / "mine.html").read_text(encoding="utf-8"))

    def test_of_one_solution(self):
        """Nothing was judged there, and no outcome is stored."""
        results, site = self.folder / "one.h5", self.folder / "site"
        run("solve", "elastica", "-f", "collocation", "-n", "2", "--shapes", "-o", results)
        done = report(results, site)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("Outcome.", (site / "index.html").read_text(encoding="utf-8"))

    def test_whole_or_none(self):
        """A page that fails leaves what was there before, and nothing beside it."""
        site = drawn(self.folder, "-k", "warping_torsion/default", "-f", "collocation")
        before = {file.name: file.read_bytes() for file in site.iterdir()}
        code = ("import sys\nfrom reports import glossary, pages\n"
                "glossary.tasks = lambda site: [lambda: 1/0]\n"
                "pages.build(sys.argv[1], sys.argv[2], sys.argv[3])\n")
        for folder in (site, self.folder / "new"):
            done = run("-B", "-c", code, self.folder / "results.h5", TRUTHS, folder, program=sys.executable, cwd=ROOT)
            self.assertIn("ZeroDivisionError", done.stderr)
        self.assertEqual({file.name: file.read_bytes() for file in site.iterdir()}, before)
        self.assertEqual(sorted(file.name for file in self.folder.iterdir()), ["results.h5", "site"])

    def test_one_formulation(self):
        site = drawn(self.folder, "-k", "warping_torsion/default", "-f", "collocation")
        page = self.whole((site / "index.html").read_text(encoding="utf-8"))
        self.assertIn('href="warping_torsion.html"', page)
        self.assertNotIn("<figure>", page)
        self.assertIn("only one formulation was run", self.whole(
            (site / "profiles.html").read_text(encoding="utf-8")))

    def test_two_formulations(self):
        site = drawn(self.folder, "-k", "warping_torsion/default", "-f", "collocation", "-f",
                     "beamw_vlasov")
        page = self.whole((site / "index.html").read_text(encoding="utf-8"))
        self.assertEqual(page.count("<figure>"), 1)
        answers = page[page.index('id="answers"'):page.index("</section>")]
        self.assertRegex(answers, r'n&nbsp;=&nbsp;\d+ <span class="pass" title="[^"]*">✓</span>')
        table = (site / "profiles.csv").read_text(encoding="utf-8").splitlines()
        self.assertEqual(table[0], "picture,level,factor,beamw_vlasov,collocation")
        self.assertEqual(len({len(line.split(",")) for line in table}), 1)


if __name__ == "__main__":
    unittest.main()
