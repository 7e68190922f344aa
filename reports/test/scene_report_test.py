"""The report of a scene of one's own that has no truth: its picture, and limits in the place of verdicts."""
import re
import unittest

from harness.tools.kit.program import ProgramTest, report, run
from harness.tools.kit.scenes import LEAF
from reports import case, data, film, shapes

SWINGS = LEAF.replace("young: 210e9", "density: 7800, young: 210e9") + """
analyses:
  swing: {motion: {stations: [0.005, 0.01], step: 1e-3}}
quantities:
  tip: {displacement: {analysis: swing, node: tip, component: uy, take: max}}
"""


class SceneReport(ProgramTest):

    def test_without_truths(self):
        scene, results, site = (self.folder / name for name in ("mine.yaml", "mine.h5", "site"))
        scene.write_text(LEAF, encoding="utf-8")
        done = run("verify", "--shapes", "--scene", scene, "-f", "collocation", "-f", "beamw_consistent",
                   "-o", results)
        self.assertEqual(done.returncode, 3, done)
        drawn = report(results, site)
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        page = (site / "mine.html").read_text(encoding="utf-8")
        self.assertNotIn("Source:", page)
        self.assertNotIn("beamwork scene", page, "a command for scenes that the program knows by name")
        self.assertTrue((site / "picture_mine.svg").is_file())
        # P L^3/3EI + P L/(k G A)
        tip = 0.1 ** 3 / (3 * 210e9 * 50e-3 * 0.5e-3 ** 3 / 12)
        limits = page[page.index("Limits of quantities"):page.index("<summary>Verdicts")]
        found = [float(text) for text in re.findall(r'class="n">([0-9.e-]+) ± ', limits)]
        self.assertEqual(sum(abs(value / tip - 1) < 1e-3 for value in found), 2, found)
        self.assertIn("<details open><summary>Limits of quantities without a truth", page)

    def test_what_is_assumed(self):
        """What numbers of a section do not say stands on its page, in the words of the terminal."""
        scene, results, site = (self.folder / name for name in ("bar.yaml", "bar.h5", "site"))
        text = re.sub("rectangle: {[^}]*}", "constants: {A: 1e-3, Iy: 2e-6, Iz: 1e-6, It: 1e-8, Iw: 0}",
                      LEAF, count=1)
        self.assertNotEqual(text, LEAF)
        scene.write_text(text, encoding="utf-8")
        done = run("verify", "--scene", scene, "-f", "beamw", "-o", results)
        self.assertEqual(done.returncode, 3, done)
        drawn = report(results, site)
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        page = (site / "bar.html").read_text(encoding="utf-8")
        self.assertIn("<p class=\"small\">Not known: shear of section leaf, whose numbers say nothing of it: taken as"
                      " zero.</p>", page)

    def test_motion_without_summary(self):
        """Only what a file must say is there: pages and film say nothing in the place of the rest."""
        scene, results, site = (self.folder / name for name in ("mine.yaml", "mine.h5", "site"))
        scene.write_text(SWINGS, encoding="utf-8")
        done = run("verify", "--shapes", "--scene", scene, "-f", "beamw", "-o", results)
        self.assertEqual(done.returncode, 3, done)
        drawn = report(results, site)
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        page = (site / "motions.html").read_text(encoding="utf-8")
        self.assertRegex(page, r"<dd>[A-Z]")
        self.assertTrue((site / "motion_mine.html").is_file())
        name, summary, point = film.chosen(results, None)
        said = film.words_of(summary, shapes.read_file(results, name, point))
        self.assertRegex(said, "^0 to 0.01 s, computed with beamw")

    def test_what_has_a_truth_is_left_out(self):
        verdicts = [
            data.Verdict("u", "no truth"),
            data.Verdict("v", "no truth"),
            data.Verdict("w", "skip")
        ]
        judged = [
            data.Verdict("u", "no truth"),
            data.Verdict("v", "pass"),
            data.Verdict("w", "no truth")
        ]
        series = [
            data.Series(key, "", "", "", [], of) for key, of in (("a", verdicts), ("b", judged))
        ]
        limits = case.limits_of(data.Point("default", "", series, {"u": "m", "v": "m", "w": "m"}))
        self.assertEqual([(q, [key for key, _ in found]) for q, found in limits],
                         [("u", ["a", "b"]), ("w", ["b"])])


if __name__ == "__main__":
    unittest.main()
