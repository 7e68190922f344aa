"""Completion as it is typed: bash and zsh at a terminal of their own, with the tab key."""
import os
import pathlib
import pty
import select
import shutil
import tempfile
import unittest

from harness.tools.kit.program import PROGRAM, ROOT, TRUTHS

HERE = ROOT / "harness" / "cli"
PACKAGE = pathlib.Path("/usr/share/bash-completion/bash_completion")
PATIENCE = 60  # seconds until a shell that says nothing is given up
# What is typed before the tab, and the arguments that come of it.
LINES = {
    "so": ["solve"],
    "solve elas": ["solve", "elastica"],
    "solve elastica --form": ["solve", "elastica", "--form"],
    "solve elastica --keep": ["solve", "elastica", "--keep-all"],
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
    "explain Newton": ["explain", "Newton's"],
}
# The command shows its arguments; the shell's own words never look like this.
SHOW = ("beamwork() { if [ \"$1\" = help ]; then command beamwork \"$@\"; else "
        "printf '<<'; printf '%s|' \"$@\"; printf '>>\\n'; fi; }")


class Terminal:
    """A shell that believes it is used by somebody."""

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
        """All that is printed until `end` comes."""
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
        """Each line with a tab, then sent. Control-U: what another line left."""
        shell = Terminal(self.folder, *command)
        self.addCleanup(shell.close)
        shell.say("\n".join((*prepare, SHOW, "printf '%s%s\\n' rea dy")) + "\n")
        shell.answer("ready")
        for typed, wanted in LINES.items():
            closing = '"' if typed.count('"') == 1 else ""
            shell.say(f"beamwork {typed}\t")
            # bash closes the quotation itself; a second pair is an empty piece of the same word
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
        """Found where packages put it, when it is first needed."""
        found = self.folder / "share" / "bash-completion" / "completions"
        found.mkdir(parents=True)
        shutil.copy(HERE / "beamwork.bash", found / "beamwork")
        self.check((f"export XDG_DATA_HOME='{self.folder / 'share'}'", f"source {PACKAGE}"),
                   "bash", "--norc", "-i")

    @unittest.skipUnless(shutil.which("zsh"), "needs zsh")
    def test_zsh(self):
        self.check((f"fpath=('{HERE}' $fpath)", "autoload -Uz compinit", "compinit -u -D",
                    "unsetopt prompt_cr prompt_sp"), "zsh", "-f", "-i")


if __name__ == "__main__":
    unittest.main()
