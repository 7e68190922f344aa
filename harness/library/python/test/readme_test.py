"""What the README prints for Python does what it says; the version is that of the program."""
import re
import unittest

from harness.library.python.test.module import FOLDER, ROOT, ModuleTest, bw, python


class Printed(ModuleTest):

    def test_lines_of_the_readme(self):
        """The lines of `From Python` run as printed, from a folder of one's own."""
        readme = (ROOT / "README.md").read_text(encoding="utf-8")
        section = readme.partition("## From Python")[2].partition("\n## ")[0]
        code = re.search(r"```python\n(.*?)```", section, re.S).group(1)
        done = python(code, cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        tip, sentence, passed = done.stdout.splitlines()
        self.assertTrue(tip.startswith(re.search(r"# (0\.0030\d+)\.\.\.", code).group(1)), tip)
        self.assertTrue(sentence.startswith("for 1 % in every quantity: "), sentence)
        self.assertEqual(passed, "True")

    def test_version(self):
        """One version: of the citation, of the library, and of what pip installs."""
        cited = re.search(r"^version: (\S+)", (ROOT / "CITATION.cff").read_text("utf-8"), re.M)
        project = (FOLDER / "pyproject.toml").read_text("utf-8")
        packed = re.search(r'^version = "(.*)"', project, re.M)
        self.assertEqual({cited.group(1), packed.group(1)}, {bw.version})

    def test_help(self):
        """Every public name says what it is."""
        done = python("import beamwork; help(beamwork)")
        for name in bw.__all__:
            self.assertIn(name, done.stdout)
            if callable(getattr(bw, name)):
                self.assertTrue(getattr(bw, name).__doc__, name)
        for cls in (bw.Scene, bw.Result, bw.Records):
            for name, member in vars(cls).items():
                if not name.startswith("_") and callable(member):
                    self.assertTrue(member.__doc__, f"{cls.__name__}.{name}")


if __name__ == "__main__":
    unittest.main()
