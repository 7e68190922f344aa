"""The check of words: a bad word in each kind of text is found at its line, names are not."""
import subprocess
import sys
import tempfile
import pathlib
import unittest

from harness.tools import words

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
    "page.md": "Run `make lab L=prices` and read `ledger.html`.\n",
    "page.html": '<a href="ledger.html">list</a>{% for told in prices %}{{ told }}{% endfor %}\n',
    "table.csv": "term,gate|gates|what is asked\n",
    "script.sh": "told=1\n",
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
        for pattern, remedy, most in words.WORDS:
            with self.subTest(pattern):
                self.assertTrue(remedy)
                self.assertGreaterEqual(most, 0)

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
