"""Pages stay small: what every page loads, what one figure takes, the largest page of a case with
many formulations and
parameter points."""
import re
import unittest

from harness.test.program import ProgramTest, drawn
from reports.site import ASSETS

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

    def test_assets(self):
        for name, most in (("script.js", SCRIPT), ("viewer.js", VIEWER), ("explorer.js", SCRIPT)):
            self.assertLess((ASSETS / name).stat().st_size, most, name)
        self.assertLess((self.site / "style.css").stat().st_size, SHEET)


if __name__ == "__main__":
    unittest.main()
