"""Pages of the manual: all there is in the program stands in them, and formatters take them."""
import re
import shutil
import subprocess
import unittest

from harness.cli.test.work import EVERY_VERB
from harness.tools.kit.program import ROOT, ProgramTest, environment, run

# the C library's argp leaves a byte when it exits
ENV = environment(ASAN_OPTIONS="detect_leaks=0")
FILES = ("beamwork.1", "beamwork-scene.5", "beamwork-results.5")
# of -h and of a page: letter, name, argument, what it does
SHOWN = re.compile(r"^  (?:-(\w), |    )--([\w-]+)(\S*)(\s.*\n(?: {30}.*\n)*)", re.MULTILINE)
TOLD = re.compile(r"^\.It (?:Fl (\w) , )?Fl -([\w-]+)(?: Ns (?:Oo )?= Ns Ar \"(.+?)\")?(?: Oc)?\n"
                  r"((?:(?!\.It|\.El).*\n)+)", re.MULTILINE)


def bare(argument):
    """"=N", "[=N]": N."""
    return argument[2:-1] if argument.startswith("[") else argument.removeprefix("=")


def plain(page):
    """Without the escapes that keep characters as they are."""
    for escaped, shown in (("\\&", ""), ("\\-", "-"), ("\\(aq", "'"), ("\\(dq", '"'),
                           ("\\(ha", "^"), ("\\(ti", "~"), ("\\(ga", "`"), ("\\e", "\\")):
        page = page.replace(escaped, shown)
    return page


def hand_page(name):
    """One that is written by hand, of a day and a version."""
    return run(name, "0.1.0", "2026-11-21",
               program=ROOT / "harness" / "library" / "packaging" / "page.sh").stdout


class Manual(ProgramTest):
    def page(self, name):
        return self.answered("help", "--man", name, env=ENV).stdout

    def names(self):
        return self.answered("help", "--man").stdout.split()

    def test_a_page_for_each_verb(self):
        self.assertEqual(sorted(self.names()),
                         sorted([*FILES, *(f"beamwork-{verb}.1" for verb in EVERY_VERB)]))
        self.assertEqual(self.page("solve"), self.page("beamwork-solve.1"))
        self.refused(2, "did you mean 'solve'", "help", "--man", "slove")

    def test_options_of_help(self):
        """The same options with the same words, in the same order."""
        for verb in EVERY_VERB:
            shown = [(letter, name, bare(argument), words.split()) for letter, name, argument, words
                     in SHOWN.findall(self.answered(verb, "-h", env=ENV).stdout)]
            told = [(letter, name, argument, words.split()) for letter, name, argument, words
                    in TOLD.findall(plain(self.page(verb)))]
            self.assertGreater(len(shown), 1)
            self.assertEqual(told, shown, verb)

    def test_examples_of_help(self):
        for verb in EVERY_VERB:
            lines = self.answered(verb, "-h", env=ENV).stdout.partition("\nexample")[2]
            text = plain(self.page(verb))
            for line in lines.splitlines()[1:]:
                self.assertIn("\n" + line.strip() + "\n", text)

    def test_keys_of_scenes(self):
        """All of them, as often as `scene --keys` lists them."""
        keys = re.findall(r"^( *)(\w+) +\S", self.answered("scene", "--keys").stdout.partition(
            "is replaced:\n")[2], re.MULTILINE)
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
        """Every member of the interface and all physics; nothing is left to be filled in."""
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


if __name__ == "__main__":
    unittest.main()
