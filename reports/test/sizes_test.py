"""Pages stay small: what every page loads, what one figure takes, the largest page of a case with
many formulations and
parameter points."""
import re
import unittest

from harness.tools.kit.program import ProgramTest, drawn
from reports import data
from reports.site import ASSETS

FORMULATION = 45_000
VERDICT = 160  # for each row of a table of verdicts, in the mean
VALUE = 16  # for each value of the results in the data of the explorer
PAGE, FIGURE, SCRIPT, VIEWER, SHEET = 500_000, 90_000, 10_000, 13_000, 20_000  # bytes


class Sizes(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.site = drawn(cls.class_folder(), "-k", "elastica or c_cantilever/default or "
                         "sheet_cantilever/default", "--shapes")

    def test_pages(self):
        pages = list(self.site.glob("*.html"))
        self.assertGreater(len(pages), 15)
        for page in pages:
            self.assertLess(page.stat().st_size, PAGE, page.name)

    def test_figures(self):
        """Also the largest one, with its words of marks."""
        seen = 0
        for page in self.site.glob("*.html"):
            for figure in re.findall(r'<svg id=.*?</svg>(?:<script type.*?</script>)?',
                                     page.read_text(encoding="utf-8"), re.S):
                self.assertLess(len(figure), FIGURE, f"{page.name}: {figure[:60]}")
                seen += 1
        self.assertGreater(seen, 10)

    def test_once(self):
        """What every page needs stands beside the pages, and a marker once in a page."""
        for page in self.site.glob("*.html"):
            text = page.read_text(encoding="utf-8")
            self.assertIn('<link rel="stylesheet" href="style.css">', text)
            markers = re.findall(r'<marker id="(\w+)"', text)
            self.assertEqual(len(markers), len(set(markers)), page.name)

    def test_verdicts(self):
        """Once, in short rows, on the pages of cases; those of formulations count them."""
        rows = 0
        for page in self.site.glob("*.html"):
            text = page.read_text(encoding="utf-8")
            for table in re.findall('<table class="verdicts">.*?</table>', text, re.S):
                self.assertFalse(page.name.startswith("formulation_"))
                self.assertLess(len(table) / table.count("<tr"), VERDICT, page.name)
                rows += table.count("<tr")
            if page.name.startswith("formulation_"):
                self.assertLess(len(text), FORMULATION, page.name)
        self.assertGreater(rows, 200)

    def test_data(self):
        """Of the explorer, by the number of values and errors in the results."""
        _, cases = data.read_results(str(self.site.parent / "results.h5"))
        for case in cases:
            number = sum(len(found) for p in case.points for s in p.series for m in s.meshes
                         for found in (m.values, m.errors))
            self.assertGreater(number, 50)
            size = (self.site / f"data_{case.name}.js").stat().st_size
            self.assertLess(size / number, VALUE, case.name)

    def test_assets(self):
        for name, most in (("script.js", SCRIPT), ("viewer.js", VIEWER), ("player.js", SCRIPT),
                           ("explorer.js", SCRIPT), ("sweep.js", SCRIPT),
                           ("sweep_own.js", SCRIPT)):
            self.assertLess((ASSETS / name).stat().st_size, most, name)
        self.assertLess((self.site / "style.css").stat().st_size, SHEET)


if __name__ == "__main__":
    unittest.main()
