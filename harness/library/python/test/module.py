"""The module under test, with the library built next to the program, and other Python processes that use it."""
import importlib
import os
import pathlib
import subprocess
import sys
import unittest

from harness.tools.kit.program import PROGRAM, ROOT, TRUTHS, ProgramTest, environment

LIBRARY = pathlib.Path(PROGRAM).parent / "libbeamwork.so.0"
FOLDER = ROOT / "harness" / "library" / "python"
SETTINGS = {"BEAMWORK_LIBRARY": str(LIBRARY), "BEAMWORK_TRUTHS": TRUTHS,
            "PYTHONPATH": str(FOLDER), "PYTHONDONTWRITEBYTECODE": "1"}


def sanitized():
    """Returns True if the library is built with a sanitizer, so that Python without a sanitizer cannot load it."""
    return LIBRARY.is_file() and b"__asan_" in LIBRARY.read_bytes()


os.environ.update(BEAMWORK_LIBRARY=SETTINGS["BEAMWORK_LIBRARY"], BEAMWORK_TRUTHS=TRUTHS)
sys.path.insert(0, str(FOLDER))
bw = None if sanitized() else importlib.import_module("beamwork")


def python(code, **options):
    options = {"env": environment(**SETTINGS), **options}
    return subprocess.run([sys.executable, "-c", code], text=True, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)


def leaf(scene=None, **changes):
    scene = bw.Scene("leaf") if scene is None else scene
    scene.sections["leaf"] = {"rectangle": {"width": 50e-3, "thickness": 0.5e-3, **changes},
                              "young": 210e9, "shear_modulus": 81e9}
    scene.nodes["base"] = {"at": [0, 0, 0], "hold": "all"}
    scene.nodes["tip"] = {"at": [0.1, 0, 0]}
    scene.members["leaf"] = {"from": "base", "to": "tip", "section": "leaf", "y": [0, 1, 0]}
    scene.loads["push"] = {"force": [0, 1, 0], "on": "tip"}
    return scene


@unittest.skipIf(sanitized(), "needs a library without sanitizers")
class ModuleTest(ProgramTest):

    def one_line(self, kind, words, call, *arguments, **options):
        with self.assertRaises(kind) as caught:
            call(*arguments, **options)
        text = str(caught.exception)
        self.assertNotIn("\n", text)
        self.assertTrue(text.strip(), "an exception without a text")
        for word in words.split("|"):
            self.assertIn(word, text)
        return caught.exception
