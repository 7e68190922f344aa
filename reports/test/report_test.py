"""The report of a small run: every page is there, every link and image resolves, foreign files are refused."""
import html.parser
import json
import re
import unittest
import xml.etree.ElementTree

from harness.tools.kit.program import TRUTHS, ProgramTest, drawn, report

# What other commands leave beside the results: a little of everything that the pages draw.
MESHES = {"parameters": "shear=0", "meshes": [8, 256]}
EXPERIMENTS = [
    {
        "kind": "finer",
        "what": "more elements",
        "formulation": "beamw",
        "error": 0.1,
        "gone": False,
        "limit": 1.1,
        "limit_uncertainty": 1e-9,
        "against": "truth",
        "why": "",
        **MESHES,
    },
    {
        "kind": "without",
        "what": "shear",
        "formulation": "beamw",
        "error": 1e-9,
        "gone": True,
        "limit": 1.0,
        "limit_uncertainty": 0.0,
        "against": "collocation:stages=8",
        "why": "",
        **MESHES,
    },
    {
        "kind": "instead",
        "what": "mass matrix",
        "formulation": "beamw:mass=lumped",
        "error": None,
        "gone": False,
        "why": "no answer within 60 s",
        **MESHES,
    },
]
STUDY = {
    "finding": "a_rule_of_the_past",
    "case": "elastica",
    "parameters": "shear=1",
    "formulation": "beamw",
    "quantity": "w",
    "verdict": "wrong limit, as predicted",
    "error": 0.1,
    "predicted": 1.1,
    "reason": "",
    "experiments": EXPERIMENTS,
}
BESIDE = {
    "faults.json": {
        "killed": 1,
        "survived": 1,
        "mutants": [{
            "fault": "a sign", "check": "test x", "expected": "1", "exit": "0", "killed": k
        } for k in (False, True)],
    },
    "fuzz.json": {
        "executions": 12,
        "findings": 1,
        "inputs": [{"input": "words", "executions": 12, "finding": True}],
    },
    "causes.json": {
        "minutes": 1,
        "not_run": 3,
        "studies": [STUDY, {**STUDY, "parameters": "", "error": None, "reason": "diverged"}],
    },
}


class Links(html.parser.HTMLParser):

    def __init__(self):
        super().__init__()
        self.found = []

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name in ("href", "src") and not value.startswith(("data:", "http")):
                self.found.append(value)


class Report(ProgramTest):

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        for name, content in BESIDE.items():
            (folder / name).write_text(json.dumps(content), encoding="utf-8")
        cls.site = drawn(folder, "-k", "warping_torsion or roll_up")

    def test_pages(self):
        for name in (
                "index.html",
                "errata.html",
                "claims.html",
                "ledger.html",
                "causes.html",
                "papers.html",
                "environment.html",
                "convergence.html",
                "cases.html",
                "formulations.html",
                "glossary.html",
                "warping_torsion.html",
                "formulation_beamw.html",
        ):
            self.assertTrue((self.site / name).is_file(), name)

    def test_links_resolve(self):
        for page in self.site.glob("*.html"):
            links = Links()
            links.feed(page.read_text(encoding="utf-8"))
            for link in links.found:
                name, _, anchor = link.partition("#")
                target = self.site / name if name else page
                self.assertTrue(target.is_file(), f"{page.name}: {link}")
                if anchor:
                    self.assertIn(f'id="{anchor}"', target.read_text(encoding="utf-8"),
                                  f"{page.name}: {link}")

    def test_nothing_is_announced(self):
        """A page whose data are missing is not there, and no other page links to it."""
        for name in ("stability.html", "newton.html", "rotation.html", "mechanisms.html"):
            self.assertFalse((self.site / name).exists(), name)
        for page in self.site.glob("*.html"):
            text = page.read_text(encoding="utf-8")
            if page.name != "environment.html":
                self.assertNotRegex(text, "then <code>make report|hold no ", page.name)
        about = (self.site / "environment.html").read_text(encoding="utf-8")
        self.assertIn("<code>make stress</code>", about)
        self.assertNotIn("<code>make lab L=causes</code>", about)  # it has left its file

    def test_bar(self):
        """Short, and it says where the reader is: also on pages of cases and of formulations."""
        for page, title in (("ledger.html", "Ledger"), ("warping_torsion.html", "Cases"),
                            ("formulation_beamw.html", "Formulations"), ("index.html", "beamwork")):
            text = (self.site / page).read_text(encoding="utf-8")
            bar = re.search('<nav class="bar" [^>]*>(.*?)</nav>', text, re.S).group(1)
            titles = re.findall(r'<a href="[^"]+"([^>]*)>([^<]+)</a>', bar)
            self.assertLessEqual(sum(len(t.split()) for _, t in titles), 13)
            self.assertEqual([t for more, t in titles if "aria-current" in more], [title])

    def test_size(self):
        for page in self.site.glob("*.html"):
            self.assertLess(page.stat().st_size, 500_000, page.name)

    def test_figures_are_drawn(self):
        """They stand in the pages; the sheets to be printed have theirs as files."""
        page = (self.site / "roll_up.html").read_text(encoding="utf-8")
        self.assertGreater(page.count("<polyline"), 8)
        files = list(self.site.glob("*.svg"))
        self.assertGreater(len(files), 0)
        for file in files:
            self.assertIn("<polyline", file.read_text(encoding="utf-8"))
            xml.etree.ElementTree.parse(file)

    def test_foreign_file(self):
        done = report(TRUTHS, self.folder / "none")
        self.assertEqual(done.returncode, 4)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1)


if __name__ == "__main__":
    unittest.main()
