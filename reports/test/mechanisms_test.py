"""The page of the mechanisms: published rows beside measured ones, with and without times."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.environ.get("BEAMWORK", "build/beamwork")
TRUTHS = os.environ.get("BEAMWORK_TRUTHS", "build/truths.h5")


class Page(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.results = os.path.join(self.folder.name, "r.h5")
        subprocess.run([PROGRAM, "verify", "-k", "spherical_joint/default and sheet_third", "-o", self.results], capture_output=True, check=False)

    def page(self):
        out = os.path.join(self.folder.name, "site")
        done = subprocess.run([sys.executable, "-B", "-m", "reports", self.results, TRUTHS, "-o", out], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return (pathlib.Path(out) / "mechanisms.html").read_text(encoding="utf-8")

    def test_without_times(self):
        page = self.page()
        self.assertIn("make bench-mechanisms", page)
        self.assertIn("9.77", page)

    def test_with_times(self):
        """The time of the dense baseline, the parts of an iteration and their sum."""
        bench = [PROGRAM, "bench", "spherical_joint", "-f", "sheet_third", "-n", "1", "--dense"]
        done = subprocess.run([*bench, "-o", os.path.join(self.folder.name, "mechanisms_joint.h5")], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        parts = re.search(r"sheet_third +1 +([\d.]+) +([\d.]+) +([\d.]+) +([\d.]+)  dense ([\d.]+) ms \(243 unknowns\): ([\d.]+) times", done.stdout)
        self.assertIsNotNone(parts, done.stdout)
        row = re.search(r"sheet_third +1 +51 +(\d+) +\d+ +\d+ +[\d.]+ ms +([\d.]+) ms", done.stdout)
        inside = sum(float(parts[k]) for k in range(1, 5)) * float(row[1]) / 1e3
        self.assertTrue(0.3 * float(row[2]) < inside < 3 * float(row[2]), done.stdout)  # of the time of the whole, which has the stiffnesses too
        self.assertGreater(float(parts[6]), 5)  # 26 on a quiet machine
        page = self.page()
        self.assertNotIn("There are no times yet", page)
        self.assertIn("<td class=\"n\">243</td>", page)
        self.assertIn("mechanisms_growth.svg", page)


if __name__ == "__main__":
    unittest.main()
