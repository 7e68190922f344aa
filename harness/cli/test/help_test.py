"""What the program says of itself: help, words that are explained, names that are misspelt."""
import re
import unittest

from harness.cli.test.work import EVERY_VERB
from harness.tools.kit.program import ROOT, ProgramTest, environment, run

WIDEST = 100
# the C library's argp leaves a byte when it exits
ENV = environment(ASAN_OPTIONS="detect_leaks=0")


class Help(ProgramTest):
    def help_of(self, verb):
        return self.answered(verb, "-h", env=ENV).stdout

    def test_every_verb(self):
        """Three ways to the same text, within the columns, with an example that names the verb."""
        for verb in EVERY_VERB:
            text = self.help_of(verb)
            self.assertEqual(text, self.answered(verb, "--help", env=ENV).stdout)
            self.assertEqual(text, self.answered("help", verb, env=ENV).stdout)
            self.assertTrue(text.startswith(f"usage: beamwork {verb} "), text)
            self.assertLessEqual(max(map(len, text.splitlines())), WIDEST, text)
            self.assertRegex(text, rf"\nexamples?\n  beamwork {verb}\b")
            self.assertIn("-h, --help", text)

    def test_the_program(self):
        text = self.answered().stdout
        for words in (("help",), ("-h",), ("--help",)):
            self.assertEqual(self.answered(*words).stdout, text)
        self.assertEqual(re.findall(r"^  ([a-z-]+)  +[a-z]", text, re.MULTILINE), list(EVERY_VERB))
        self.assertLessEqual(max(map(len, text.splitlines())), WIDEST)
        self.assertIn("HDF5", run("--version").stdout)

    def test_examples_are_accepted(self):
        """Every option of an example is one of its verb."""
        seen = 0
        for verb in EVERY_VERB:
            text = self.help_of(verb)
            for line in text.partition("\nexample")[2].splitlines():
                for option in re.findall(r"(?<= )--?[a-z-]+", line):
                    self.assertRegex(text, rf"(?m)^ +(-\w, )?{option}\b|^ +{option}, ", line)
                    seen += 1
        self.assertGreater(seen, 5)


class Misspelt(ProgramTest):
    def test_verbs(self):
        self.refused(2, "did you mean 'solve'", "slove")
        self.refused(2, "did you mean 'verify'", "help", "verifi")
        self.refused(2, "unknown verb 'xyzzyxyzzy'; 'beamwork -h'", "xyzzyxyzzy")

    def test_options(self):
        self.refused(2, "did you mean --elements?", "solve", "elastica", "--elemnts", "3")
        self.refused(2, "did you mean --threshold?", "compare", "a", "b", "--treshold=error=1")
        self.refused(2, "solve takes no --threshold", "solve", "elastica", "--threshold=error=1")
        self.refused(2, "unknown option -z", "converge", "elastica", "-z")
        self.refused(2, "begins several", "solve", "elastica", "--s", "3")
        self.refused(2, "--elements needs a value", "solve", "elastica", "-n")
        self.refused(2, "--elements needs a value", "solve", "elastica", "--elements")
        self.refused(2, "--keep-all takes no value", "solve", "elastica", "--keep-all=1")

    def test_values_are_no_options(self):
        """What stands behind an option that takes a value is that value, whatever it begins
        with."""
        self.refused(2, "'-1'", "solve", "elastica", "-f", "beamw", "-n", "-1")
        self.refused(2, "--elemnts", "solve", "elastica", "-f", "--elemnts", "-n", "1")
        self.refused(2, "--elemnts", "solve", "-f", "beamw", "-n1", "--", "--elemnts")

    def test_one_letter_with_its_value(self):
        self.answered("solve", "warping_torsion", "-fbeamw", "-n2")


class Explain(ProgramTest):
    def test_words(self):
        """However they are written; several arguments are one word."""
        text = self.answered("explain", "wrong limit").stdout
        self.assertEqual(self.answered("explain", "Wrong", "limit").stdout, text)
        self.assertEqual(self.answered("explain", "wrong_limit").stdout, text)
        self.assertIn("see also: biased", text)
        for word in ("haringx", "bimoment", "not_converged", "wagner torque", "n"):
            done = self.answered("explain", word)
            self.assertLessEqual(max(map(len, done.stdout.splitlines())), WIDEST)

    def test_names(self):
        self.assertIn("beamwork list c_column", self.answered("explain", "c_column").stdout)
        self.assertIn("source: J", self.answered("explain", "beamw").stdout)
        self.assertIn("c_column [N]: ", self.answered("explain", "buckling_load").stdout)
        ledger = (ROOT / "reference" / "findings.csv").read_text(encoding="utf-8")
        for rule in re.findall(r"^([\w-]+),", ledger, re.MULTILINE)[1:]:
            self.assertIn("cause: ", self.answered("explain", rule).stdout)

    def test_all_words(self):
        text = self.answered("explain").stdout
        self.assertLessEqual(max(map(len, text.splitlines())), WIDEST)
        listed = {word.strip() for line in text.splitlines() if line.startswith("  ")
                  for word in line.split(";")}
        self.assertGreater(len(listed), 70)
        self.assertLessEqual({"pass", "Haringx", "bimoment", "Newton's method"}, listed)

    def test_misspelt(self):
        self.refused(2, "did you mean 'Haringx'", "explain", "harinxg")
        self.refused(2, "did you mean 'bimoment'", "explain", "bimomnet")
        self.refused(2, "did you mean 'J66-shear'", "explain", "J66-sheer")
        self.refused(4, "missing.h5", "explain", "pass", "--truths", "missing.h5")


if __name__ == "__main__":
    unittest.main()
