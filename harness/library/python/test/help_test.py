"""What the module says of itself: the version of the program, and help of every public name."""
import re
import unittest

from harness.library.python.test.module import FOLDER, ROOT, ModuleTest, bw, python


class Said(ModuleTest):

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
