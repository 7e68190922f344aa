"""The outputs shown on pages of docs/ must be those of their commands."""
import unittest

from harness.tools import shown_commands as commands
from harness.tools.kit.program import PROGRAM


class Pages(unittest.TestCase):

    def test_commands(self):
        count = 0
        for page in commands.pages():
            text = page.read_text(encoding="utf-8")
            count += text.count("\n$ ")
            for command, expected, printed in commands.differences(text, PROGRAM):
                with self.subTest(page=str(page.relative_to(commands.ROOT)), command=command):
                    self.assertEqual("\n".join(expected), "\n".join(printed))
                    self.fail("its marks do not fit")
        self.assertGreater(count, 40)

    def test_every_command_is_run(self):
        """Every line that begins with `$ ` must be in a console block, because others are not run."""
        for page in commands.pages():
            text = page.read_text(encoding="utf-8")
            run = sum(len(commands.commands(body)) for kind, body in commands.BLOCK.findall(text)
                      if kind == "console")
            with self.subTest(page=page.name):
                self.assertEqual(run, text.count("\n$ "))


    def test_readme_counts_the_examples(self):
        there = len(list((commands.ROOT / "cases" / "examples").glob("*.yaml")))
        self.assertIn(f" {there} example structures", (commands.ROOT / "README.md").read_text(encoding="utf-8"))


class Marks(unittest.TestCase):

    def test_difference_is_noticed(self):
        for shown, printed, same in (("a 1.5 s", "a 1.5 s", True), ("a 1.5 s", "a 1.6 s", False),
                                     ("a ... s", "a 1.6 s", True), ("a ... s", "b 1.6 s", False),
                                     ("a\n...\nd", "a\nb\nc\nd", True), ("a\n...\nd", "a\nb", False),
                                     ("a", "a\nb", False), ("a\nb", "a", False)):
            with self.subTest(shown=shown, printed=printed):
                self.assertEqual(commands.match(shown.split("\n"), printed.split("\n")), same)

    def test_page_fails(self):
        page = "```{code-block} text\n:caption: a.txt\n\n17\n```\n\n```console\n$ cat a.txt\n18\n```\n"
        self.assertEqual(commands.differences(page, PROGRAM), [("cat a.txt", ["18"], ["17"])])
        self.assertEqual(commands.differences(page.replace("18", "17"), PROGRAM), [])


if __name__ == "__main__":
    unittest.main()
