"""Other programs beside ours: kept apart, drawn hollow, their names harmless."""
import math
import unittest

from harness.tools.kit.program import TRUTHS, ProgramTest, run
from reports import data, pages

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
                     run("verify", "-k", "elastica/default", "-f", "beamw", "--beside",
                         cls.place / "theirs.h5", "-o", cls.place / "both.h5")):
            assert done.returncode == 0, done.stderr

    def point(self, name):
        return data.read_case(self.place / name, "elastica").points[0]

    def test_ours_stay_ours(self):
        """What counts formulations does not count other programs."""
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
        """Other programs are hollow and have no colour of a formulation."""
        self.assertEqual(data.style_beside(3)["color"], "currentColor")
        self.assertTrue(data.style_beside(3)["hollow"])


if __name__ == "__main__":
    unittest.main()
