"""Shells: completion, and behaviour in terminals and pipes."""
import os
import pathlib
import pty
import re
import select
import shutil
import tempfile
import unittest

from harness.cli.test.work import EVERY_VERB
from harness.tools.kit.program import PROGRAM, ProgramTest, ROOT, TRUTHS, environment


HERE = ROOT / "harness" / "cli"
PACKAGE = pathlib.Path("/usr/share/bash-completion/bash_completion")
PATIENCE = 60  # [s] longest time to wait for the answer of a shell
LINES = {
    "so": ["solve"],
    "solve elas": ["solve", "elastica"],
    "solve elastica --form": ["solve", "elastica", "--form"],
    "solve elastica --all": ["solve", "elastica", "--all-dofs"],
    "solve elastica -f beamw_v": ["solve", "elastica", "-f", "beamw_vlasov"],
    "solve elastica -f beamw:ma": ["solve", "elastica", "-f", "beamw:mass="],
    "solve elastica -f beamw:mass=lum": ["solve", "elastica", "-f", "beamw:mass=lumped"],
    "solve c_column --set=section_data=pri": ["solve", "c_column", "--set=section_data=printed"],
    "solve c_column --set lengt": ["solve", "c_column", "--set", "length="],
    "solve --scene=a_folder/le": ["solve", "--scene=a_folder/leaf.yaml"],
    "solve --scene a_folder/le": ["solve", "--scene", "a_folder/leaf.yaml"],
    "solve --scene a_folder/leaf.yaml --set str": ["solve", "--scene", "a_folder/leaf.yaml",
                                                  "--set", "stroke="],
    'verify -k "c_column and beamw_v': ["verify", "-k", "c_column and beamw_vlasov"],
    "list --element exe": ["list", "--element", "exec:"],
    "explain bimom": ["explain", "bimoment"],
    "explain Poiss": ["explain", "Poisson's"],
}
SHOW = ("beamwork() { if [ \"$1\" = help ]; then command beamwork \"$@\"; else "
        "printf '<<'; printf '%s|' \"$@\"; printf '>>\\n'; fi; }")


class Terminal:

    def __init__(self, folder, *command):
        self.child, self.master = pty.fork()
        if self.child == 0:
            os.chdir(folder)
            os.environ.update(PATH=f"{pathlib.Path(PROGRAM).parent}:{os.environ['PATH']}",
                              TERM="dumb", HISTFILE="", HOME=str(folder), PS1="", LC_ALL="C.UTF-8",
                              ASAN_OPTIONS="detect_leaks=0", BEAMWORK_TRUTHS=TRUTHS)
            os.execvp(command[0], command)

    def say(self, text):
        os.write(self.master, text.encode())

    def answer(self, end):
        text = ""
        while end not in text:
            if not select.select([self.master], [], [], PATIENCE)[0]:
                raise AssertionError(f"no {end!r} in {text!r}")
            text += os.read(self.master, 4096).decode(errors="replace")
        return text

    def close(self):
        os.close(self.master)
        os.waitpid(self.child, 0)


class Shell(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "a_folder").mkdir()
        shutil.copy(ROOT / "cases" / "examples" / "leaf_spring_guide.yaml",
                    self.folder / "a_folder" / "leaf.yaml")

    def check(self, prepare, *command):
        shell = Terminal(self.folder, *command)
        self.addCleanup(shell.close)
        shell.say("\n".join((*prepare, SHOW, "printf '%s%s\\n' rea dy")) + "\n")
        shell.answer("ready")
        for typed, wanted in LINES.items():
            closing = '"' if typed.count('"') == 1 else ""
            shell.say(f"beamwork {typed}\t")
            shell.say(f'{closing}{closing}\n' if closing else "\n")
            text = shell.answer(">>")
            shown = text.partition("<<")[2].partition("|>>")[0].split("|")
            with self.subTest(line=typed):
                self.assertEqual([word.strip() for word in shown if word.strip()], wanted, text)

    @unittest.skipUnless(shutil.which("bash"), "needs bash")
    def test_bash(self):
        self.check((f"source '{HERE / 'beamwork.bash'}'",), "bash", "--norc", "-i")

    @unittest.skipUnless(shutil.which("bash") and PACKAGE.exists(), "needs bash-completion")
    def test_bash_with_its_package(self):
        found = self.folder / "share" / "bash-completion" / "completions"
        found.mkdir(parents=True)
        shutil.copy(HERE / "beamwork.bash", found / "beamwork")
        self.check((f"export XDG_DATA_HOME='{self.folder / 'share'}'", f"source {PACKAGE}"),
                   "bash", "--norc", "-i")

    @unittest.skipUnless(shutil.which("zsh"), "needs zsh")
    def test_zsh(self):
        self.check((f"fpath=('{HERE}' $fpath)", "autoload -Uz compinit", "compinit -u -D",
                    "unsetopt prompt_cr prompt_sp"), "zsh", "-f", "-i")


ENV = environment(ASAN_OPTIONS="detect_leaks=0")
LEAF = ROOT / "cases" / "examples" / "leaf_spring_guide.yaml"


class Completion(ProgramTest):

    def lines(self, *words):
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
                               for folder in ("cases/benchmarks", "elements"))
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
        names = re.findall(r"^  (\w+)", table.partition("\nquantities ")[0], re.MULTILINE)
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
        for words in (("solve", "--scene", ""), ("verify", "-o", ""), ("verify", "--imported="),
                      ("import", ""), ("compare", "one.h5", "")):
            self.assertEqual(set(self.offered(*words)), {":files"}, words)
        self.assertEqual(self.offered("solve", "--element", "e"), [":files", "exec:"])
        self.assertEqual(self.offered("solve", "elastica", "--matrices", ""), [":folders"])
        self.assertEqual(self.offered("solve", "elastica", "-n", ""), [])

    def test_words(self):
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
