"""The report of a small run: every page is there, every link and image resolves, foreign files are refused."""
import html.parser
import os
import pathlib
import shutil
import tempfile
import unittest

from harness.test.program import TRUTHS, report, run

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Links(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.found = []

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name in ("href", "src") and not value.startswith(("data:", "http")):
                self.found.append(value)


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.results = os.path.join(cls.folder, "results.h5")
        run("verify", "-k", "warping_torsion or roll_up", "-o", cls.results)
        cls.done = report(cls.results, os.path.join(cls.folder, "site"))

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def test_pages(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        names = os.listdir(os.path.join(self.folder, "site"))
        for name in ("index.html", "errata.html", "claims.html", "papers.html", "environment.html", "convergence.html", "warping_torsion.html", "formulation_beamw.html"):
            self.assertIn(name, names)

    def test_links_resolve(self):
        site = pathlib.Path(self.folder) / "site"
        for page in site.glob("*.html"):
            links = Links()
            links.feed(page.read_text(encoding="utf-8"))
            for link in links.found:
                name, _, anchor = link.partition("#")
                target = site / name if name else page
                self.assertTrue(target.is_file(), f"{page.name}: {link}")
                if anchor:
                    self.assertIn(f'id="{anchor}"', target.read_text(encoding="utf-8"), f"{page.name}: {link}")

    def test_figures_are_drawn(self):
        figures = list((pathlib.Path(self.folder) / "site").glob("*.svg"))
        self.assertGreater(len(figures), 3)
        for figure in figures:
            self.assertIn("<path", figure.read_text(encoding="utf-8"))

    def test_foreign_file(self):
        done = report(TRUTHS, os.path.join(self.folder, "none"))
        self.assertEqual(done.returncode, 4)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1)


if __name__ == "__main__":
    unittest.main()
