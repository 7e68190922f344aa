"""The page about Newton's method: what is called the largest step, and a page without data."""
import json
import unittest

from harness.tools import newton as tool
from harness.tools.kit.program import PROGRAM, ProgramTest
from reports import newton
from reports.test import results

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


class Site(results.Site):
    """Remembers what was drawn, too."""

    def __init__(self, folder):
        super().__init__(str(folder / "results.h5"))
        self.images = []

    def image(self, figure, name):
        self.images.append(name)
        newton.plt.close(figure)
        return name


class Newton(ProgramTest):

    def test_what_is_written_is_what_is_drawn(self):
        """The steps of a real solution have all that the page asks of one."""
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
        site = Site(self.folder)
        self.assertFalse(newton.present(site))
        (self.folder / "newton.json").write_text(json.dumps(DATA), encoding="utf-8")
        self.assertTrue(newton.present(site))
        newton.write(site)
        page = site.pages["newton.html"]
        self.assertEqual(page["singles"][0][1][0][2], {"mixed": (0.3, 5), "displacement": (0.1, 5)})
        self.assertEqual(site.images, ["newton_roll"])
        self.assertEqual(len(page["histories"][0][2]), 2)


if __name__ == "__main__":
    unittest.main()
