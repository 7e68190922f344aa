"""Tests the published site: report, documentation and gallery in one folder, with addresses that do not change."""
import html.parser
import json
import sys
import unittest

from harness.tools.kit.program import ROOT, ProgramTest, drawn, run


class Links(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.found = []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        named = dict(attributes)
        self.found += [named[name] for name in ("href", "src") if named.get(name)]
        if named.get("http-equiv") == "refresh":
            self.found.append(named["content"].partition("url=")[2])


def publish(report, docs, results, folder):
    return run("-B", "-m", "reports.publish", report, docs, results, "-o", folder, program=sys.executable, cwd=ROOT)


class Published(ProgramTest):

    def setUp(self):
        super().setUp()
        self.report = drawn(self.folder, "-k", "warping_torsion/default or bend_45/default", "-f", "collocation",
                            "-f", "beamw_consistent:torsion=hyperbolic", "--shapes")
        self.docs = self.folder / "docs"
        self.docs.mkdir()
        (self.docs / "index.html").write_text("documentation", encoding="utf-8")
        self.site = self.folder / "published"

    def test_one_folder(self):
        done = publish(self.report, self.docs, self.folder / "results.h5", self.site)
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads((self.site / "site.json").read_text(encoding="utf-8"))
        self.assertEqual(set(found["cases"]), {"warping_torsion", "bend_45"})
        self.assertEqual(found["formulations"], {"beamw_consistent:torsion=hyperbolic": "beamw_consistent_torsion_hyperbolic", "collocation": "collocation"})
        for file in ("report/index.html", "docs/index.html", "gallery/index.html", "case/bend_45/index.html",
                     "formulation/beamw_consistent_torsion_hyperbolic/index.html"):
            self.assertTrue((self.site / file).is_file(), file)
        page = (self.site / "index.html").read_text(encoding="utf-8")
        for words in (found["version"], found["commit"], found["date"]):
            self.assertIn(words, page)
        own = [self.site / "index.html", self.site / "gallery" / "index.html", *self.site.glob("case/*/*.html"),
               *self.site.glob("formulation/*/*.html")]
        for path in own:
            for link in Links(path).found:
                if not link.startswith("data:"):
                    self.assertTrue((path.parent / link).is_file(), (path, link))
        self.assertGreater(len(own), 5)
        again = publish(self.report, self.docs, self.folder / "results.h5", self.site)
        self.assertEqual(again.returncode, 0, again.stderr)

    def test_whole_or_none(self):
        self.site.mkdir()
        (self.site / "index.html").write_text("before", encoding="utf-8")
        (self.folder / "bad.h5").write_text("no results", encoding="utf-8")
        for docs, results in ((self.folder / "nowhere", self.folder / "results.h5"), (self.docs, self.folder / "bad.h5")):
            done = publish(self.report, docs, results, self.site)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (4, 1), done.stderr)
            self.assertEqual([p.name for p in self.site.iterdir()], ["index.html"])
            self.assertEqual((self.site / "index.html").read_text(encoding="utf-8"), "before")
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["bad.h5", "docs", "published", "results.h5", "site"])


if __name__ == "__main__":
    unittest.main()
