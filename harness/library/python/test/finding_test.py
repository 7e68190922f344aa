"""The module finds its library, or says in one line what to do."""
import os
import subprocess
import unittest

from harness.library.python.test.module import LIBRARY, SETTINGS, ModuleTest, bw, python
from harness.tools.kit.program import environment


class Finding(ModuleTest):

    def test_missing(self):
        """No library: one line that says what to do."""
        settings = {**SETTINGS, "BEAMWORK_LIBRARY": str(self.folder / "none.so")}
        done = python("import beamwork", env=environment(**settings))
        last = done.stderr.strip().splitlines()[-1]
        self.assertTrue(last.startswith("ImportError: beamwork: "), last)
        self.assertIn("none.so", last)
        self.assertIn("BEAMWORK_LIBRARY", last)

    def test_no_library(self):
        path = self.folder / "rubbish.so"
        path.write_bytes(b"rubbish")
        done = python("import beamwork",
                      env=environment(**{**SETTINGS, "BEAMWORK_LIBRARY": str(path)}))
        self.assertIn("ImportError: beamwork: ", done.stderr.strip().splitlines()[-1])

    def test_another_library(self):
        """A library that is not ours names what it lacks."""
        path = self.folder / "other.so"
        subprocess.run(["cc", "-shared", "-o", path, "-xc", "/dev/null"], check=True)
        done = python("import beamwork",
                      env=environment(**{**SETTINGS, "BEAMWORK_LIBRARY": str(path)}))
        self.assertIn("bw_", done.stderr.strip().splitlines()[-1])

    def test_beside_and_installed(self):
        """Without the variable: beside the module, and in lib of the prefix it is installed in."""
        source = os.path.dirname(bw.__file__)
        for module, library in (("here/beamwork", "here"), ("here2/beamwork", "here2/beamwork"),
                                ("p/lib/python3/dist-packages/beamwork", "p/lib"),
                                ("q/lib/python3/dist-packages/beamwork", "q/lib/x86_64-linux-gnu"),
                                ("clone/harness/library/python/beamwork", "clone/build")):
            with self.subTest(library):
                place = self.folder / module
                subprocess.run(["cp", "-r", source, f"{self.folder}/copied"], check=True)
                place.parent.mkdir(parents=True, exist_ok=True)
                os.rename(self.folder / "copied", place)
                (self.folder / library).mkdir(parents=True, exist_ok=True)
                os.link(LIBRARY, self.folder / library / LIBRARY.name)
                settings = {**SETTINGS, "PYTHONPATH": str(place.parent)}
                del settings["BEAMWORK_LIBRARY"]
                without = {k: v for k, v in environment(**settings).items()
                           if k != "BEAMWORK_LIBRARY"}
                done = python("import beamwork; print(beamwork.path)", env=without)
                self.assertEqual(done.stdout.strip(),
                                 str(self.folder / library / LIBRARY.name), done.stderr)


if __name__ == "__main__":
    unittest.main()
