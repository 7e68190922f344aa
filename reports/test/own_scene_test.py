"""Tests the pages of your own scenes: recommendation, physics, supports, stability, agreement, and curves."""
import re
import unittest

from harness.tools.kit.program import ProgramTest, report, run
from reports import agreed, answers, data, model
from reports.test.results import case, series

GUIDE = """beamwork: 1
name: my_guide
sections:
  leaf: {rectangle: {width: 50e-3, thickness: 0.5e-3}, young: 210e9, shear_modulus: 81e9}
nodes:
  stage:   {at: [0.025, 0.1, 0], drive: {ux: travel}}
  base_$i: {for: {i: 0..1}, at: [i*0.05, 0, 0], hold: all}
  end_$i:  {for: {i: 0..1}, at: [i*0.05, 0.1, 0], part_of: stage}
members:
  leaf_$i: {for: {i: 0..1}, from: base_$i, to: end_$i, section: leaf, y: [1, 0, 0], warping: fixed}
motions:
  travel: {unit: m, path: [0, 1], value: [0, 0.01]}
analyses:
  push: {static: {stations: 0..1/5}}
quantities:
  drive_force: {reaction: {analysis: push, node: stage, component: ux}, unit: N}
  drive_curve: {reaction: {analysis: push, node: stage, component: ux, take: curve}, unit: N, x: {name: travel, unit: mm, factor: 10}}
"""


def plain(text):
    return re.sub(r"\s+", " ", re.sub(r"<[^>]*>", " ", text.replace("&nbsp;", " ")))


def tried(key, errors, other=""):
    found = series(key, [data.Verdict("u", "no truth", limit=2.0, model_truth=2.0, model_truth_kind="agreement",
                                      model_error=errors[-1], message="no reference value; its limit is near"
                                      " from that on which a (x) and b (y) agree; shear in stability: Haringx")])
    found.other = other
    found.meshes = [data.Mesh(2**i, "ok", "", data.Clock(0, 1, 1, 1, 1), 8, 4, "", {}, values={"u": 2 + 2 * e},
                              model_errors={"u": e}, cost=1e-3 * 2**i) for i, e in enumerate(errors)]
    return found


class Agreed(unittest.TestCase):

    def setUp(self):
        self.point = case("one", tried("a", (0.5, 0.002, 0.0005)), tried("b", (0.009, 0.008, 0.005)),
                          tried("c", (0.0, 0.0, 0.0), "shear")).points[0]
        self.point.units = {"u": "m", "v": "m"}

    def test_recommendation(self):
        """The recommendation must be the formulation of lowest cost within the level of the agreed limit. Another model is not
        ranked."""
        ranked = agreed.ranked(self.point)
        for level, best, n in ((0.01, "b", 1), (0.001, "a", 4)):
            found = answers.answer(ranked, answers.ALL, level)
            self.assertEqual([(w.key, w.n) for w in found.best[:1]], [(best, n)])
            self.assertNotIn("c", [w.key for w, _, _ in found.ways])
        self.assertEqual(answers.judged(self.point), [], "the original point is changed")

    def test_agreement(self):
        found, = agreed.agreements(self.point)
        self.assertEqual((found.value, found.farthest, found.distance), (2.0, "b", 0.005))
        self.assertEqual(found.words, "a (x) and b (y) agree; shear in stability: Haringx")
        self.assertEqual(agreed.without_any(self.point), ["v"])

    def test_a_reference_value_comes_first(self):
        self.point.series[0].verdicts.append(data.Verdict("v", "pass", truth=1.0))
        self.assertIs(agreed.ranked(self.point), self.point)


class Model(unittest.TestCase):

    def test_ranges(self):
        states = [(0.2, "stable"), (0.4, "stable"), (0.6, "unstable (1)"), (0.8, "stable")]
        self.assertEqual(model.ranges(states), [("stable", 0.2, 0.4), ("unstable (1)", 0.6, 0.6), ("stable", 0.8, 0.8)])


class OwnScene(ProgramTest):

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        (folder / "guide.yaml").write_text(GUIDE, encoding="utf-8")
        run("verify", "--scene", folder / "guide.yaml", "-o", folder / "own.h5")
        cls.advice = run("converge", "--scene", folder / "guide.yaml").stdout
        done = report(folder / "own.h5", folder / "site")
        assert done.returncode == 0, done.stderr
        cls.page = (folder / "site" / "my_guide.html").read_text(encoding="utf-8")
        cls.index = (folder / "site" / "index.html").read_text(encoding="utf-8")

    def test_the_recommendation_is_that_of_converge(self):
        said = re.search(r"for 1 % in every[^:]*: |for 1 % in [^:]*?\): ", self.advice, re.S)
        advised = re.findall(r"(\w+)\s+n\s+=\s+(\d+)", self.advice[(said or re.search("for 1 % ", self.advice)).end():])
        shown = re.search(r'class="answer">(.*?)</p>', self.page, re.S)[1]
        self.assertIn("Lowest cost within 1 % of the limit on which families agree", plain(shown))
        self.assertEqual(re.findall(r"(\w+) with n = (\d+)", plain(shown))[0], advised[0])
        self.assertRegex(plain(self.index), rf"my_guide n = {advised[0][1]} ○ {advised[0][0]}")

    def test_same_parts_as_ours(self):
        text = plain(self.page)
        for words in ("Error against run time", "Mesh convergence", "Physics and supports of the computation", "12 fixed degrees",
                      "held at base_0, base_1, end_0, end_1", "stability of push stable up to 1", "No reference value, so no verdicts",
                      "shear in stability: Haringx", "Curves are not included: drive_curve", "Agreement of families"):
            self.assertIn(words, text)

    def test_curves_over_your_abscissa(self):
        self.assertIn(">travel [mm]</text>", self.page)
        self.assertIn(">drive_curve [N]</text>", self.page)


if __name__ == "__main__":
    unittest.main()
