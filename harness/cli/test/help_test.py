"""Help, manual pages, and commands that the program prints."""
import re
import shlex
import shutil
import subprocess
import unittest

from harness.cli.test.work import EVERY_VERB
from harness.tools.kit.program import PROGRAM, ProgramTest, ROOT, environment, run


WIDEST = 100
# argp of the C library does not free one byte at exit
ENV = environment(ASAN_OPTIONS="detect_leaks=0")


class Help(ProgramTest):

    def help_of(self, verb):
        return self.answered(verb, "-h", env=ENV).stdout

    def test_every_verb(self):
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
        self.refused(2, "solve has no --threshold", "solve", "elastica", "--threshold=error=1")
        self.refused(2, "unknown option -z", "converge", "elastica", "-z")
        self.refused(2, "is an abbreviation of several", "solve", "elastica", "--s", "3")
        self.refused(2, "--elements requires a value", "solve", "elastica", "-n")
        self.refused(2, "--elements requires a value", "solve", "elastica", "--elements")
        self.refused(2, "--all-dofs does not accept a value; remove the value", "solve", "elastica", "--all-dofs=1")

    def test_values_are_no_options(self):
        self.refused(2, "'-1'", "solve", "elastica", "-f", "beamw", "-n", "-1")
        self.refused(2, "--elemnts", "solve", "elastica", "-f", "--elemnts", "-n", "1")
        self.refused(2, "--elemnts", "solve", "-f", "beamw", "-n1", "--", "--elemnts")

    def test_one_letter_with_its_value(self):
        self.answered("solve", "warping_torsion", "-fbeamw", "-n2")


class Explain(ProgramTest):

    def test_words(self):
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


MANUAL_ENV = environment(ASAN_OPTIONS="detect_leaks=0")
FILES = ("beamwork.1", "beamwork-scene.5", "beamwork-results.5")
# option in the help or in a manual page: letter, name, argument, description
SHOWN = re.compile(r"^  (?:-(\w), |    )--([\w-]+)(\S*)(\s.*\n(?: {30}.*\n)*)", re.MULTILINE)
TOLD = re.compile(r"^\.It (?:Fl (\w) , )?Fl -([\w-]+)(?: Ns (?:Oo )?= Ns Ar \"(.+?)\")?(?: Oc)?\n"
                  r"((?:(?!\.It|\.El).*\n)+)", re.MULTILINE)


def bare(argument):
    return argument[2:-1] if argument.startswith("[") else argument.removeprefix("=")


def plain(page):
    for escaped, shown in (("\\&", ""), ("\\-", "-"), ("\\(aq", "'"), ("\\(dq", '"'),
                           ("\\(ha", "^"), ("\\(ti", "~"), ("\\(ga", "`"), ("\\e", "\\")):
        page = page.replace(escaped, shown)
    return page


def hand_page(name):
    return run(name, "0.1.0", "2026-11-21",
               program=ROOT / "harness" / "library" / "packaging" / "page.sh").stdout


class Manual(ProgramTest):

    def page(self, name):
        return self.answered("help", "--man", name, env=MANUAL_ENV).stdout

    def names(self):
        return self.answered("help", "--man").stdout.split()

    def test_a_page_for_each_verb(self):
        self.assertEqual(sorted(self.names()),
                         sorted([*FILES, *(f"beamwork-{verb}.1" for verb in EVERY_VERB)]))
        self.assertEqual(self.page("solve"), self.page("beamwork-solve.1"))
        self.refused(2, "did you mean 'solve'", "help", "--man", "slove")

    def test_options_of_help(self):
        for verb in EVERY_VERB:
            shown = [(letter, name, bare(argument), words.split()) for letter, name, argument, words
                     in SHOWN.findall(self.answered(verb, "-h", env=MANUAL_ENV).stdout)]
            told = [(letter, name, argument, words.split()) for letter, name, argument, words
                    in TOLD.findall(plain(self.page(verb)))]
            self.assertGreater(len(shown), 1)
            self.assertEqual(told, shown, verb)

    def test_examples_of_help(self):
        for verb in EVERY_VERB:
            lines = self.answered(verb, "-h", env=MANUAL_ENV).stdout.partition("\nexample")[2]
            text = plain(self.page(verb))
            for line in lines.splitlines()[1:]:
                self.assertIn("\n" + line.strip() + "\n", text)

    def test_keys_of_scenes(self):
        keys = re.findall(r"^( *)(\w+) +\S", self.answered("scene", "--keys").stdout.partition(
            "in names and strings:\n")[2], re.MULTILINE)
        shown = [name for blanks, name in keys if len(blanks) < 12]
        told = re.findall(r'^\.It Ic "(\w+)"', plain(self.page("beamwork-scene.5")), re.MULTILINE)
        self.assertGreater(len(told), 150)
        self.assertEqual(told, shown)

    def test_fields_of_results(self):
        records = self.record("schema")["records"]
        page = plain(self.page("beamwork-results.5"))
        self.assertEqual(re.findall(r'^\.It Va "([\w.]+)"', page, re.MULTILINE),
                         [field["name"] for record in records for field in record["fields"]])
        for record in records:
            self.assertIn(record["table"] + '"\n' + record["summary"].split()[0], page)

    def test_element(self):
        page = plain(hand_page("beamwork-element.7"))
        self.assertNotRegex(page, "@[A-Z]+@")
        self.assertIn(".Dd November 21, 2026\n", page)
        header = (ROOT / "elements" / "element.h").read_text(encoding="utf-8")
        body = re.sub(r"/\*.*?\*/", "", header.partition("typedef struct element_type {")[2]
                      .partition("} element_type;")[0], flags=re.DOTALL)
        members = re.findall(r"\(\*(\w+)\)|(\w+)(?:\[\w+\])?;", body)
        self.assertGreater(len(members), 20)
        for names in members:
            name = names[0] or names[1]
            self.assertRegex(page, rf"\.It Fa (.* , )?{name}\b|^\.Fa {name}\b", name)
        for constant in re.findall(r"LEAVES_\w+", header):
            self.assertIn(f".It Dv {constant}\n", page)
        for name in re.findall(r'\{FEATURE_\w+,\s*"([^"]+)"',
                               (ROOT / "elements" / "feature.h").read_text(encoding="utf-8")):
            self.assertIn(f".It {name}\n", page)

    @unittest.skipUnless(shutil.which("mandoc"), "needs mandoc")
    def test_lint(self):
        pages = {name: self.page(name) for name in self.names()}
        hand = {path.name: hand_page(path.name)
                for path in (ROOT / "harness" / "library" / "packaging").glob("*.[0-9]")}
        self.assertIn("beamwork-element.7", hand)
        for name, text in {**pages, **hand}.items():
            self.assertNotRegex(text, "@[A-Z]+@")
            path = self.folder / name
            path.write_text(text, encoding="utf-8")
            done = subprocess.run(["mandoc", "-T", "lint", "-W", "warning", path], text=True,
                                  capture_output=True, check=False)
            self.assertEqual((done.returncode, done.stdout), (0, ""), name)


EXAMPLE = (ROOT / "elements" / "examples" / "timoshenko.c").read_text(encoding="utf-8")
SCENE = (ROOT / "cases" / "examples" / "euler_column.yaml").read_text(encoding="utf-8")
BENDING = "c->young * c->I"


def commands(text):
    return re.findall(r"(?:^ *|: )(beamwork (?!\w+: )[^;\n]+)", re.sub(r" \\\n *", " ", text), re.MULTILINE)


class Printed(ProgramTest):

    def setUp(self):
        super().setUp()
        self.element = self.folder / "my element's.so"
        source = self.folder / "mine.c"
        source.write_text(EXAMPLE.replace(BENDING, "1.1 * " + BENDING).replace("energy += d", "energy += 1.01 * d"),
                          encoding="utf-8")
        subprocess.run(["cc", "-O2", "-shared", "-fPIC", "-I", ROOT, source, "-o", self.element], check=True)
        self.scene = self.folder / "a very long name of a scene, in which one asks for quotes' quotes.yaml"
        self.scene.write_text(SCENE, encoding="utf-8")

    def run_all(self, text, least, *words):
        found = commands(text)
        self.assertGreaterEqual(len(found), least, text)
        for command in found:
            for word in words:
                self.assertIn(str(word), shlex.split(command), command)
            done = subprocess.run(command.replace("beamwork", shlex.quote(PROGRAM), 1), shell=True, text=True, check=False,
                                  cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment())
            self.assertIn(done.returncode, (0, 1), (command, done.stderr))
            self.assertNotEqual(done.stdout, "", command)

    def test_verify(self):
        own = ("--element", self.element)
        self.run_all(run("verify", *own, "-k", "=elastica and default or =tapered_cantilever").stdout, 3, self.element)
        out = run("verify", *own, "-f", "timoshenko", "--scene", self.scene).stdout
        self.run_all(out[out.find(" 1. "):], 1, self.element, self.scene)
        self.assertIn("beamwork element-test", out)

    def test_sweep(self):
        for of in (("elastica", "--vary", "load=1,5"), ("--scene", self.scene, "--vary", "length=1,2")):
            done = self.answered("sweep", *of, "--element", self.element, "-f", "timoshenko", "-n", "2")
            self.run_all(done.stdout, 1, self.element)

    def test_what_is_shown_by(self):
        near = "critical_loadd"
        for words in (("solve", "--scene", self.scene, "--set", "foo=1"), ("sweep", "--scene", self.scene),
                      ("sweep", "--scene", self.scene, "--vary", "foo"), ("solve", "--scene", self.scene, "-k", near),
                      ("converge", "--scene", self.scene, "-k", near)):
            hint = re.search(r"'(beamwork list .*)' shows", self.refused_line(*words))
            self.run_all(hint[1], 1, self.scene)
        for words, shown in ((("-f", "beamw:foo=1"), "newton="),
                             (("--element", self.element, "-f", "timoshenko:foo=1"), "newton="),
                             (("-f", "foo"), "collocation"), (("--set", "foo=1"), "load")):
            hint = re.search(r"'beamwork (list.*)' shows", self.refused_line("solve", "elastica", *words))
            command = hint[1].replace("FILE", shlex.quote(str(self.element)))
            self.assertIn(shown, self.answered(*shlex.split(command)).stdout)
        self.assertNotIn("FILE", self.refused_line("motion", "elastica"))
        case = self.refused_line("motion", "elastica").split()[-1]
        self.assertIn("motion", self.answered("list", case).stdout)
        hint = re.search(r"'(beamwork merge .*) -o FILE'", self.refused_line(
            "verify", "-k", "=elastica and =default and =beamw", "--into", "a folder", "-o", "r.h5"))
        self.assertEqual(shlex.split(hint[1]), ["beamwork", "merge", "a folder"])

    def test_remedies_for_files(self):
        work = ("-k", "=elastica and =default and =beamw")
        self.answered("verify", *work, "-o", self.folder / "results.h5")
        table = self.folder / "t.csv"
        self.answered("compare", self.folder / "results.h5", "-o", table)
        text = table.read_text(encoding="utf-8")
        table.write_text(text[:-20], encoding="utf-8")
        line = self.failed_line("compare", table, self.folder / "results.h5")
        self.run_quoted(line)
        self.assertEqual(table.read_text(encoding="utf-8"), text)
        theirs = self.folder / "theirs.csv"
        theirs.write_text("# beamwork-import: 1\n# program: T\n# case: elastica\n"
                          "quantity,unit,elements,value\nw_over_L,1,2,0.3\n", encoding="utf-8")
        line = self.failed_line("verify", "-k", "=elastica and =default and =w_over_L", "--imported", theirs)
        self.run_quoted(line)
        self.assertIn("theirs.h5", line)
        self.answered("verify", "-k", "=elastica and =default and =w_over_L", "-f", "beamw", "--imported", self.folder / "theirs.h5")
        line = self.failed_line("merge", self.folder)
        self.assertIn("--into", line)
        self.answered("verify", *work, "--into", self.folder)
        self.answered("merge", self.folder)
        line = self.failed_line("verify", *work, "--into", self.folder, "-o", "r.h5")
        self.run_quoted(line.replace("FILE", "merged.h5"))

    def test_remedies_for_options(self):
        """Each message names an option with a value that makes the same command valid."""
        for words, remedy in ((("sweep", "elastica", "--vary", "load=1..2", "-f", "beamw", "-n", "1"), r"=\S+/4"),
                              (("sweep", "elastica", "--vary", "load=1..2", "--design", "sobol", "-f", "beamw", "-n", "1"),
                               r"--points \d+"),
                              (("sweep", "elastica", "--vary", "load", "-f", "beamw", "-n", "1"), r"=\S+/4"),
                              (("sweep", "elastica", "--vary", "load=1..2/3:foo", "-f", "beamw", "-n", "1"), r"=\S+:log"),
                              (("bench", "elastica", "--error", "1%", "-f", "beamw"), "--against [a-z]+"),
                              (("verify", "elastica"), "-k elastica"),
                              (("compare", "a", "b", "--threshold", "foo"), "error=0.01,floor=1e-8,work=0.02"),
                              (("import", "x.csv"), "'beamwork import .*'"),
                              (("export", "elastica"), "--to calculix"),
                              (("plot", "elastica", "-f", "beamw", "-n", "1,2"), r"-n \d+")):
            line = self.failed_line(*words)
            self.assertRegex(line, remedy)
            given = re.search(remedy, line)[0]
            if words[0] == "sweep" and given[0] == "=":
                done = run(*(f"load{given}" if word.startswith("load") else word for word in words))
            elif words[0] in ("sweep", "bench"):
                done = run(*words, *given.split())
            elif words[0] == "verify":
                done = run("verify", *given.split(), "-f", "beamw")
            else:
                continue
            self.assertEqual((done.returncode, done.stderr), (0, ""), (line, done.stderr))

    def run_quoted(self, line):
        command = re.search(r"'(beamwork .*?)'[ ,;\n]", line)[1]
        done = subprocess.run(command.replace("beamwork", shlex.quote(PROGRAM), 1), shell=True, text=True, check=False,
                              cwd=self.folder, capture_output=True, env=environment())
        self.assertEqual(done.returncode, 0, (command, done.stderr))

    def failed_line(self, *words):
        done = run(*words)
        self.assertIn(done.returncode, (2, 4), done)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        return done.stderr

    def refused_line(self, *words):
        done = run(*words)
        self.assertEqual(done.returncode, 2, done)
        return done.stderr

    def test_explain(self):
        for word in ("elastica", "beamw"):
            out = self.answered("explain", word).stdout
            self.run_all(out.replace("; beamwork", "\nbeamwork"), 1 if word == "elastica" else 0)


if __name__ == "__main__":
    unittest.main()
