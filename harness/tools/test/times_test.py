"""The table of times in the documentation: its commands exist, and other pages state the same times."""
import pathlib
import re
import tempfile
import unittest

from harness.tools import times
from harness.tools.kit.program import PROGRAM, ROOT, run

TEXT = times.PAGE.read_text("utf-8")


class Table(unittest.TestCase):

    def test_commands_exist(self):
        make = (ROOT / "Makefile").read_text("utf-8") + (ROOT / "harness/library/packaging/packaging.mk").read_text("utf-8")
        targets = set(re.findall(r"^([a-z-]+):", make, re.MULTILINE))
        self.assertGreater(len(times.rows(TEXT)), 12)
        for command, _, stated in times.rows(TEXT):
            first, second = (command + " ").split(" ")[:2]
            with self.subTest(command=command):
                self.assertRegex(stated, r"^[\d.]+ (s|minutes?)$")
                if first == "make":
                    self.assertIn(second, targets)
                else:
                    self.assertEqual(run("help", first).returncode, 0)

    def test_same_time_of_a_build(self):
        stated = {words: time for _, words, time in times.rows(TEXT)}[", a clean build"]
        for page in ("README.md", "docs/howto/install.md"):
            self.assertIn(f"{stated} on two processors", (ROOT / page).read_text("utf-8"))

    def test_written(self):
        results = [{"command": "list", "seconds": 0.0123}, {"command": "make verify", "seconds": 93.0}]
        text = times.replaced(TEXT, results)
        now = {command: time for command, _, time in times.rows(text)}
        self.assertEqual((now["list"], now["make verify"]), ("0.01 s", "1.6 minutes"))
        self.assertIn(f"Elapsed times on {times.machine()}:", text)
        self.assertEqual(len(text.splitlines()), len(TEXT.splitlines()))

    def test_measured(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "times.json"
            times.main([str(PROGRAM), "--only", "list", "-o", str(out)])
            self.assertIn('"command": "list"', out.read_text("utf-8"))


if __name__ == "__main__":
    unittest.main()
