"""What the program offers at the cursor: all that is in its tables, and nothing else."""
import re
import unittest

from harness.cli.test.work import EVERY_VERB
from harness.tools.kit.program import ROOT, ProgramTest, environment

# the C library's argp leaves a byte when it exits
ENV = environment(ASAN_OPTIONS="detect_leaks=0")
LEAF = ROOT / "cases" / "examples" / "leaf_spring_guide.yaml"


class Completion(ProgramTest):
    def lines(self, *words):
        """Of the line 'beamwork WORD...', the last word begun."""
        return self.answered("help", "--complete", *words, env=ENV).stdout.splitlines()

    def offered(self, *words):
        return [line.partition("\t")[0] for line in self.lines(*words)]

    def test_verbs(self):
        self.assertEqual(self.offered(""), [*EVERY_VERB, "help", "--help", "--version"])
        self.assertEqual(self.offered("help", ""), list(EVERY_VERB))
        self.assertEqual(self.offered("so"), ["solve"])
        self.assertRegex(self.lines("so")[0], r"^solve\t\w")
        self.assertEqual(self.offered("none", ""), [])

    def test_options_of_each_verb(self):
        for verb in EVERY_VERB:
            shown = re.findall(r"^  (?:-\w,|   ) --([\w-]+)(=?)",
                               self.answered(verb, "-h", env=ENV).stdout, re.MULTILINE)
            self.assertEqual(self.offered(verb, "-"), [f"--{name}{more}" for name, more in shown])

    def test_names(self):
        cases, formulations = (sorted(path.stem for end in ("c", "yaml")
                                      for path in (ROOT / folder).glob("*." + end))
                               for folder in ("cases", "elements"))
        self.assertEqual(sorted(self.offered("solve", "")), cases)
        self.assertEqual(self.offered("solve", "c_column", ""), [])
        self.assertEqual(self.offered("bench", "c_column", "elas"), ["elastica"])
        self.assertEqual(sorted(self.offered("solve", "elastica", "-f", "")),
                         sorted([*formulations, "all"]))
        self.assertEqual(sorted(self.offered("list", "")),
                         sorted([*cases, *formulations, "cases", "formulations"]))

    def test_options_of_formulations(self):
        for words, before in ((("-f",), ""), (("--formulation",), ""), ((), "--formulation="),
                              ((), "-f"), ((), "-hf")):
            def offered(begun, words=words, before=before):
                found = self.offered("solve", "c_column", *words, before + begun)
                self.assertTrue(all(one.startswith(before) for one in found))
                return [one[len(before):] for one in found]
            self.assertEqual(offered("beamw_v"), ["beamw_vlasov"])
            self.assertEqual(offered("beamw:"), ["beamw:mass=", "beamw:newton="])
            self.assertEqual(offered("beamw:mass=l"), ["beamw:mass=lumped"])
            self.assertEqual(offered("beamw:mass=lumped,"), ["beamw:mass=lumped,newton="])
            self.assertEqual(offered("none:"), [])

    def test_parameters(self):
        table = self.answered("list", "c_column").stdout.partition("parameters (")[2]
        names = re.findall(r"^  (\w+)", table.partition("quantities (")[0], re.MULTILINE)
        self.assertEqual(self.offered("solve", "c_column", "--set", ""),
                         [f"{name}=" for name in names])
        self.assertEqual(self.offered("solve", "c_column", "-s", "section_data=pr"),
                         ["section_data=printed"])
        self.assertEqual(self.offered("solve", "c_column", "--set=leng"), ["--set=length="])
        for scene in (("--scene", LEAF), (f"--scene={LEAF}",), ("-h", "--scene", LEAF)):
            self.assertEqual(self.offered("solve", *scene, "--set", "str"), ["stroke="])
            self.assertEqual(self.offered("solve", *scene, "--follow=str"), ["--follow=stroke="])
        self.assertEqual(self.offered("solve", "--scene", "none.yaml", "--set", ""), [])
        self.assertNotIn("section_data=", self.offered("solve", "c_column", "--follow", ""))

    def test_formats_and_files(self):
        self.assertEqual(self.offered("solve", "elastica", "--format", ""), ["text", "json", "csv"])
        self.assertEqual(self.offered("solve", "elastica", "--format=j"), ["--format=json"])
        self.assertEqual(self.offered("export", "elastica", "--to", ""), ["calculix"])
        for words in (("solve", "--scene", ""), ("verify", "-o", ""), ("verify", "--beside="),
                      ("import", ""), ("compare", "one.h5", "")):
            self.assertEqual(set(self.offered(*words)), {":files"}, words)
        self.assertEqual(self.offered("solve", "--element", "e"), [":files", "exec:"])
        self.assertEqual(self.offered("solve", "elastica", "--matrices", ""), [":folders"])
        self.assertEqual(self.offered("solve", "elastica", "-n", ""), [])

    def test_words(self):
        """Terms of several words in one argument or in several."""
        self.assertIn("limit", self.offered("explain", "wrong", ""))
        self.assertIn("wrong limit", self.offered("explain", "wrong l"))
        self.assertEqual(self.offered("explain", "bimom"), ["bimoment"])
        self.assertEqual(self.offered("explain", "J66-m"), ["J66-mechanisms"])
        self.assertIn("c_column", self.offered("explain", "c_"))

    def test_selections(self):
        self.assertEqual(self.offered("verify", "-k", "(c_column or sheet_c"),
                         ["(c_column or sheet_cantilever"])
        self.assertEqual(self.offered("verify", "-k", "(elas"), ["(elastica"])

    def test_behind_the_end_of_options(self):
        self.assertEqual(self.offered("solve", "--", "-"), [])
        self.assertEqual(self.offered("solve", "--", "elas"), ["elastica"])


if __name__ == "__main__":
    unittest.main()
