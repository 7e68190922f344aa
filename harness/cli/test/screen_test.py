"""What verify shows: a screen, all that is unexpected in full, colour on terminals only."""
import os
import pty
import re
import shlex
import shutil
import subprocess
import unittest

import h5py

from harness.tools.kit.program import PROGRAM, TRUTHS, ProgramTest, environment
from reference.pack import seal

SELECT = ("verify", "-k", "c_column and section_data=printed and (beamw or collocation)")
SMALL = ("verify", "-k", "shear_elastica/default or elastica/default")
UTF8 = environment(LC_ALL="C.UTF-8")
ASCII = environment(LC_ALL="C")


def on_terminal(*arguments, **changes):
    """What the program writes to a terminal."""
    parent, child = pty.openpty()
    with subprocess.Popen([PROGRAM, *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=child,
                          stderr=child, env=environment(**changes)) as process:
        os.close(child)
        written = b""
        try:
            while more := os.read(parent, 65536):
                written += more
        except OSError:  # the other end is closed
            pass
    os.close(parent)
    return written.decode(), process.returncode


class Screen(ProgramTest):

    def columns(self, text):
        """No line is wider than the screen."""
        for line in text.splitlines():
            self.assertLessEqual(len(line), 100, line)

    def test_widths(self):
        """Long names, sources and descriptions are continued on lines of their own."""
        long_name = "collocation:stages=3,newton=displacement"
        for words in (("truth", "c_column"), ("truth", "warping_torsion"), ("scene", "--keys"),
                      ("bench", "c_column", "-f", "collocation", "--against", "beamw_consistent",
                       "--error", "10%"),
                      ("bench", "elastica", "-f", long_name, "-n", "1", "--against",
                       "beamw_consistent")):
            self.columns(self.answered(*words).stdout)

    def test_source_of_a_prediction(self):
        """It stands apart from the error."""
        text = self.answered("solve", "sheet_cantilever", "-f", "sheet_third", "-n", "1").stdout
        self.assertRegex(text, r"(?m)^prediction C_xx .* %  N Eq\. 54, analytic$")

    def without_a_rule(self):
        """Truths whose ledger does not know what these cases show."""
        path = self.folder / "t.h5"
        shutil.copy(TRUTHS, path)
        with h5py.File(path, "r+") as file:
            file["findings/quantities"][...] = b"gone"
        seal(path)
        return path

    def test_matrix(self):
        """A mark for each case and formulation, and its words."""
        for env, marks in ((UTF8, "≠1 ✓ · ○ ✓ ✓ ≠1 ≈2 ○ ○"), (ASCII, "#1 ok . m ok ok #1 ~2 m m")):
            text = self.answered(*SMALL, env=env).stdout
            row, = re.findall(r"^shear_elastica +(\S.*)$", text, re.M)
            self.assertEqual(row.split(), marks.split())
            words = re.escape(marks.split()[0][0]) + " limit off, beyond the tolerance "
            self.assertRegex(text, f"(?m)^{words}")
            self.columns(text)
            self.assertRegex(text, r"\d+ cells, \d+ more for their noise, in [\d.]+ s\n")
            self.assertEqual(text.isascii(), env is ASCII)

    def test_verdict_sentence(self):
        """One sentence says that findings were expected."""
        for quiet in ((), ("-q",)):
            text = self.answered(*SMALL, *quiet).stdout
            self.assertRegex(" ".join(text.split()), r"PASS: every verdict is as expected; 6 of them are "
                             r"limits off the truth \(4 within the tolerance, 2 beyond it\) just as "
                             r'derived for these formulations \(beamwork explain "wrong limit, as '
                             r'predicted"\)\.')
        self.assertEqual(text.count("PASS"), 1)
        self.assertTrue(text.startswith("PASS"), text)
        self.assertLess(len(text.splitlines()), 5)

    def test_unexpected(self):
        """All of it, in full, with commands that show it again; also with --quiet."""
        truths = self.without_a_rule()
        for quiet in ((), ("-q",), ("-v",)):
            text = self.answered(*SELECT, "--truths", truths, *quiet, code=1, env=ASCII).stdout
            self.columns(text)
            end = text.splitlines()[-1]
            self.assertRegex(end, r"^FAIL: 3 verdicts differ from the expected ones\.$")
            block = text[text.index(" 1. "):]
            self.assertIn(" 1. c_column (section_data=printed), beamw, buckling_load [N]\n"
                          "    wrong limit, as predicted, expected pass\n", block)
            self.assertIn("-2.7801 %", block)
            self.assertEqual(len(re.findall(r"^ \d\. ", block, re.M)), 3)
            again = block[block.index("    beamwork "):].partition("\n\n")[0]
            again = shlex.split(again.replace("\\\n", ""))
        self.assertEqual(again[:5], ["beamwork", "converge", "c_column", "--set",
                                     "section_data=printed"])
        limit, = re.findall(r"limit ([\d.]+) \+- ", block.partition(" 2. ")[0])
        self.assertIn(limit[:6], self.answered(*again[1:]).stdout)

    def test_marks_of_the_unexpected(self):
        text = self.answered(*SELECT, "--truths", self.without_a_rule(), code=1, env=ASCII).stdout
        row, = re.findall(r"^c_column +(\S.*)$", text, re.M)
        self.assertIn("!#1", row.split())
        self.assertIn("! not as expected, see below   # limit off", text)

    def test_long_table(self):
        """Where it is asked for, or something is chosen; never with --quiet."""
        long = r"(?m)^  w_over_L \[.*\], truth 0\.\d+ \+- \S+ \(exact\)$"
        chosen = ("verify", "-k", "elastica/default and (beamw or collocation)")
        self.assertRegex(self.answered(*chosen).stdout, long)
        self.assertRegex(self.answered(*chosen, "-v").stdout, long)
        self.assertNotRegex(self.answered(*chosen, "-q").stdout, long)
        self.refused(2, "give one of them", *chosen, "-q", "-v")

    def test_widths(self):
        """Tables of every verb, with the longest names there are."""
        longest = ("-f", "beamw_consistent:torsion=hyperbolic", "-f", "collocation")
        for words in (("solve", "c_column", *longest[:2], "-n", "2"),
                      ("solve", "sheet_cantilever", "-f", "sheet_third", "-n", "1"),
                      ("converge", "shear_elastica", "-n", "1,2,4"),
                      ("converge", "shear_elastica", "-n", "1,2,4", "-v"),
                      ("bench", "shear_elastica", *longest, "-n", "1,2", "--dense"),
                      ("stress", "-k", "decay_free"), ("stress", "-k", "twist_wagner")):
            text = self.answered(*words).stdout
            self.assertGreater(len(text.splitlines()), 3)
            self.columns(text)

    def test_errors_in_percent(self):
        """The same error as the JSON has it, in every verb."""
        case = ("shear_elastica", "-f", "beamw", "-n", "4")
        error = 100 * self.record("solve", *case)["quantities"][0]["error"]
        shown = f"{error:+.4f} %"
        for verb in ("solve", "converge", "bench"):
            self.assertIn(shown, self.answered(verb, *case).stdout)

    def test_colour(self):
        """On a terminal that has it, unless it is not wanted."""
        coloured, code = on_terminal(*SMALL, TERM="xterm", NO_COLOR="")
        self.assertEqual(code, 0)
        self.assertIn("\x1b[32mPASS\x1b[0m", coloured)
        for plain in ({"TERM": "dumb", "NO_COLOR": ""}, {"TERM": "xterm", "NO_COLOR": "1"}):
            text, code = on_terminal(*SMALL, **plain)
            self.assertEqual(code, 0)
            self.assertIn("PASS: every", text)
            self.assertNotIn("\x1b[3", text)
        quiet, code = on_terminal(*SMALL, "-q", TERM="xterm", NO_COLOR="1")
        self.assertRegex(quiet, r"^PASS: [^\x1b]*$")
        self.assertNotIn("\r", quiet.replace("\r\n", ""))
        piped = self.answered(*SMALL, env=environment(TERM="xterm", NO_COLOR=""))
        self.assertNotIn("\x1b", piped.stdout + piped.stderr)


if __name__ == "__main__":
    unittest.main()
