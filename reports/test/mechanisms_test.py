"""The page of the mechanisms: published rows beside measured ones, with and without times."""
import re
import unittest

from harness.tools.kit.program import ProgramTest, drawn


class Page(ProgramTest):

    def page(self):
        site = drawn(self.folder, "-k", "spherical_joint/default and sheet_third")
        return (site / "mechanisms.html").read_text(encoding="utf-8")

    def test_without_times(self):
        page = self.page()
        self.assertIn("9.77", page)
        self.assertNotIn("time here", page)
        about = (self.folder / "site" / "environment.html").read_text(encoding="utf-8")
        self.assertIn("make lab L=bench-mechanisms", about)

    def test_with_times(self):
        """The time of the dense baseline and the parts of an iteration are there."""
        done = self.answered("bench", "spherical_joint", "-f", "sheet_third", "-n", "1", "--dense",
                             "-o", self.folder / "mechanisms_joint.h5")
        parts = re.search(
            r"\[us\] in an iteration.*\n +sheet_third +1(?: +-?[\d.]+){5}\n"
            r" +dense ([\d.]+) ms \(243 unknowns\): ([\d.]+) times", done.stdout)
        self.assertIsNotNone(parts, done.stdout)
        # How large they are is for benchmarks to say: on a busy machine differences may be negative.
        self.assertTrue(all(float(part) > 0 for part in parts.groups()), done.stdout)
        page = self.page()
        self.assertIn("time here", page)
        self.assertIn("<td class=\"n\">243</td>", page)
        self.assertIn('<svg id="mechanisms_growth"', page)


if __name__ == "__main__":
    unittest.main()
