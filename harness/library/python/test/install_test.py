"""The module as pip installs it, without a network."""
import importlib.util
import pathlib
import shutil
import subprocess
import sys
import unittest

from harness.library.python.test.module import FOLDER, SETTINGS, ModuleTest, python
from harness.tools.kit.program import environment


# --no-build-isolation takes them from here.
NEEDS = [name for name in ("pip", "setuptools", "wheel") if importlib.util.find_spec(name) is None]


class Installed(ModuleTest):

    @unittest.skipIf(NEEDS, f"needs {', '.join(NEEDS)}")
    def test_pip(self):
        """Into a folder, offline; imported from there it solves."""
        source, target = self.folder / "source", self.folder / "target"
        shutil.copytree(FOLDER, source, ignore=shutil.ignore_patterns("__pycache__"))
        done = subprocess.run([sys.executable, "-m", "pip", "install", "--no-build-isolation",
                               "--no-index", "--no-deps", "--target", target, source],
                              text=True, capture_output=True, check=False,
                              env=environment(HOME=str(self.folder)))
        self.assertEqual(done.returncode, 0, done.stderr)
        installed = {path.name for path in (target / "beamwork").glob("*.py")}
        self.assertEqual(installed, {path.name for path in (FOLDER / "beamwork").glob("*.py")})
        done = python("import beamwork as bw; print(bw.__file__)\n"
                      "print(bw.Scene.case('elastica').solve('beamw', 1)['w_over_L'] > 0)",
                      env=environment(**{**SETTINGS, "PYTHONPATH": str(target)}))
        path, solved = done.stdout.split()
        self.assertEqual((pathlib.Path(path).parent, solved), (target / "beamwork", "True"))


if __name__ == "__main__":
    unittest.main()
