"""The page of the mechanisms: published rows beside measured ones, with and without times."""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

from harness.test.program import PROGRAM, report, run


class Page(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.results = os.path.join(self.folder.name, "r.h5")
        run("verify", "-k", "spherical_joint/default and sheet_third", "-o", self.results)

    def page(self):
        out = os.path.join(self.folder.name, "site")
        done = report(self.results, out)
        self.assertEqual(done.returncode, 0, done.stderr)
        return (pathlib.Path(out) / "mechanisms.html").read_text(encoding="utf-8")

    def test_without_times(self):
        page = self.page()
        self.assertIn("make bench-mechanisms", page)
        self.assertIn("9.77", page)

    def test_with_times(self):
        """The time of the dense baseline and the parts of an iteration are there."""
        bench = [PROGRAM, "bench", "spherical_joint", "-f", "sheet_third", "-n", "1", "--dense"]
        done = subprocess.run([*bench, "-o", os.path.join(self.folder.name, "mechanisms_joint.h5")], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        parts = re.search(r"sheet_third +1 +([\d.]+) +([\d.]+) +([\d.]+) +([\d.]+)  dense ([\d.]+) ms \(243 unknowns\): ([\d.]+) times", done.stdout)
        self.assertIsNotNone(parts, done.stdout)
        self.assertTrue(all(float(part) > 0 for part in parts.groups()), done.stdout)  # how large they are is for benchmarks to say
        page = self.page()
        self.assertNotIn("make bench-mechanisms</code>, then", page)
        self.assertIn("<td class=\"n\">243</td>", page)
        self.assertIn("mechanisms_growth.svg", page)


if __name__ == "__main__":
    unittest.main()
