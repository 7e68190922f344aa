"""Pages of the C interfaces: all that is public is documented, and what they show compiles."""
import re
import shutil
import unittest

from harness.tools.kit.program import ROOT, ProgramTest, run

HERE = ROOT / "harness" / "library" / "packaging" / "api"
LIBRARY = ROOT / "harness" / "library" / "beamwork.h"


@unittest.skipUnless(shutil.which("doxygen"), "needs doxygen")
class Pages(ProgramTest):
    def drawn(self):
        return run("0.1.0", self.folder / "api", program=HERE / "pages.sh")

    def test_everything_is_documented(self):
        done = self.drawn()
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        page = (self.folder / "api" / "beamwork_8h.html").read_text(encoding="utf-8")
        for name in re.findall(r"\b(bw_\w+)\(", LIBRARY.read_text(encoding="utf-8")):
            self.assertTrue(f">{name}</a>" in page or f"<b>{name}</b>" in page, name)
        for words in ("<code>beamwork list --format json</code>", "--element takes it"):
            self.assertTrue(words in page, words)

    def test_members_stand_in_their_groups(self):
        self.drawn()
        page = (self.folder / "api" / "structelement__type.html").read_text(encoding="utf-8")
        self.assertTrue("Required: these two, or force in their place" in page)
        self.assertLess(page.index("Required: these two"), page.index("Optional: what it is"))
        bits = (self.folder / "api" / "feature_8h.html").read_text(encoding="utf-8")
        self.assertTrue("initial curvature: initial curvature and strain" in bits)


class Example(ProgramTest):
    def test_compiles(self):
        text = (HERE / "index.md").read_text(encoding="utf-8")
        path = self.folder / "mine.c"
        path.write_text(re.search(r"```c\n(.*?)```", text, re.DOTALL)[1], encoding="utf-8")
        done = run("-std=c99", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-I",
                   LIBRARY.parent, path, program="cc")
        self.assertEqual((done.returncode, done.stderr), (0, ""))


class Filter(ProgramTest):
    def filtered(self, text):
        path = self.folder / "one.h"
        path.write_text(text, encoding="utf-8")
        return run(path, program=HERE / "filter.py").stdout

    def test_comments(self):
        """The first is the file's; others are of what they stand before or behind."""
        self.assertEqual(self.filtered("/* A <file>. */\n/* x */\nint a; /* of --set */\n"),
                         "/** @file\n * A \\<file\\>. */\n/** x */\nint a; /**< of \\--set */\n")

    def test_members_together(self):
        self.assertIn("double a /**< x */, b; /**< x */",
                      self.filtered("/* f */\nstruct s {\n    double a, b; /* x */\n};\n"))


if __name__ == "__main__":
    unittest.main()
