"""Statements in READMEs, and words to avoid."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from harness.tools import words
from harness.tools.kit.program import ROOT


PATTERNS = ("NAME", "my_beam", "*", "cases/elastica/quantities")
PATH = re.compile(r"(?<![\w./-])(?:cases|docs|elements|harness|reference|reports)/[\w./*-]+\w")
WALK = re.compile(r"^(\w+| \|) +((?:cases|elements|harness|reports)/\S+)", re.MULTILINE)


TREES = ("cases", "docs", "elements", "harness", "reference", "reports")


def files(*endings):
    top = [path for path in ROOT.iterdir() if path.is_file()]
    below = [path for tree in TREES for path in (ROOT / tree).rglob("*")]
    return [path for path in top + below if path.suffix in endings]


class Readme(unittest.TestCase):

    def test_paths_exist(self):
        found = 0
        for readme in files(".md"):
            if readme.match("docs/index.md"):
                continue
            text = readme.read_text(encoding="utf-8")
            if readme.name == "CHANGELOG.md":
                text = "## ".join(text.split("\n## ")[:2])
            for name in PATH.findall(text):
                if any(part in name for part in PATTERNS):
                    continue
                found += 1
                with self.subTest(readme=readme.name, path=name):
                    self.assertTrue((ROOT / name).exists() or (readme.parent / name).exists())
        self.assertGreater(found, 50)

    def test_walk_goes_down(self):
        text = (ROOT / "docs" / "project" / "source.md").read_text(encoding="utf-8")
        walked = [name for _, name in WALK.findall(text)]
        self.assertGreater(len(walked), 8)
        rooms = [name.rpartition("/")[0] for name in walked]
        for i, name in enumerate(walked):
            included = re.findall(r'#include "([^"]+)/[^/"]+"', (ROOT / name).read_text("utf-8"))
            below = set(rooms[i + 1:]) - set(rooms[:i + 1])
            with self.subTest(file=name):
                self.assertFalse(below & set(included))


THEIRS = (ROOT / "cases" / "scene", ROOT / "cases" / "quantities",
          ROOT / "cases" / "format" / "builder_members.c")


class Unions(unittest.TestCase):

    def test_only_their_files_name_them(self):
        for path in files(".c"):
            if path.parent.name == "test" or path.parent in THEIRS or path in THEIRS:
                continue
            with self.subTest(file=path.name):
                self.assertIsNone(re.search(r"(->|\.)of\.(walk|compliance|continuation|component"
                                            r"|entry|load|mode|point|driver)\b",
                                            path.read_text(encoding="utf-8")))


TEXTS = {
    "shown.c": ('#include "ledger of.h"\nint a;\nconst char *b = "it is "\n    "told here";\n', 4, "told"),
    "comment.c": ("int a; /* Sums.\n * A cell is told. */\n", 2, "told"),
    "line.c": ("// one\n// soonest of all\n", 2, "soonest"),
    "shown.py": ('a = 1\nprint(f"it is {a} told")\n', 2, "told"),
    "statement.py": ('"""One.\n\nThe soonest one.\n"""\n', 3, "soonest"),
    "comment.py": ("a = 1  # soonest of all\n", 1, "soonest"),
    "page.md": ("# Head\n\nWhich is soonest?\n", 3, "soonest"),
    "page.html": ('<p>x</p>\n<td title="as cheap as one">y</td>\n', 2, "as cheap"),
    "macro.html": ('{{ figure("the soonest one") }}\n', 1, "soonest"),
    "scene.yaml": ("a: 1\nsummary: velocity at the begin\n", 2, "the begin"),
    "table.csv": ('a,"this one, told"\n', 1, "told"),
    "list.mk": ("a: b ## plants faults\n", 1, "plants"),
    "script.sh": ("# nobody knows\n", 1, "nobody"),
}
CLEAN = {
    "name.c": 'const char *key = "ledger"; int told;\n',
    "allowed.c": 'const char *t = "it is told"; /* words: ok (a test) */\n',
    "name.py": 'told = f"{told} is here"\n',
    "page.md": "Run `make lab L=prices` and read `prices.html`.\n",
    "page.html": '<a href="prices.html">list</a>{% for told in prices %}{{ told }}{% endfor %}\n',
    "table.csv": "term,gate|gates|what is asked\n",
    "script.sh": "told=1\n",
    "named.py": "x = 1  # `ours`: errors of these\n",
}


class Words(unittest.TestCase):

    def test_found_at_its_line(self):
        for name, (text, line, word) in TEXTS.items():
            with self.subTest(name):
                self.assertIn((line, word), [(hit[2], hit[3]) for hit in words.hits(name, text)])

    def test_names_are_not_found(self):
        for name, text in CLEAN.items():
            with self.subTest(name):
                self.assertEqual(list(words.hits(name, text)), [])

    def test_every_pattern_has_a_remedy(self):
        for pattern, remedy in words.WORDS:
            with self.subTest(pattern):
                self.assertTrue(remedy)

    def test_exit_status(self):
        for name, (text, line, word) in TEXTS.items():
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder, name)
                path.write_text(text, encoding="utf-8")
                done = subprocess.run([sys.executable, words.__file__, path], capture_output=True,
                                      text=True, check=False)
                self.assertEqual(done.returncode, 1)
                self.assertIn(f"{path}:{line}: {word} (", done.stdout)
                self.assertIn("): write ", done.stdout)

    def test_the_tree(self):
        done = subprocess.run([sys.executable, words.__file__], capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stdout)


if __name__ == "__main__":
    unittest.main()
