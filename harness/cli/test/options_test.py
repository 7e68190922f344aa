"""Words of the command line that say two things or nothing, and a machine that gives too little:
one line and the documented code."""
import os
import re
import resource
import signal
import subprocess
import unittest

from harness.cli.test.work import EVERY_VERB, VERBS, WORK
from harness.tools.kit.program import ROOT, TRUTHS, ProgramTest, environment, run

LISTS = ("formulation", "element", "elements", "set")  # may be given again
# the C library's argp leaves a byte when it exits
HELP = environment(ASAN_OPTIONS="detect_leaks=0")


class Words(ProgramTest):
    def test_options_twice(self):
        """Every option with one value of every verb, as its help lists them."""
        seen = 0
        for verb in VERBS:
            shown = run(verb, "--help", env=HELP).stdout
            for name in re.findall(r"--([a-z-]+)\[?=[A-Za-z]", shown):
                if name in LISTS:
                    continue
                value = {"format": "text", "against": "beamw", "error": "1%",
                         "tolerance": "1%"}.get(name, "3")
                self.refused(2, "given twice", verb, f"--{name}={value}", f"--{name}={value}")
                seen += 1
        self.assertGreater(seen, 20)

    def test_parameters_twice(self):
        for verb in ("solve", "converge", "bench"):
            self.refused(2, "given twice", verb, "elastica", "-f", "beamw", "-n", "2", "--set",
                         "load=1", "--set", "load=1")
            self.refused(2, "given twice", verb, "elastica", "-f", "beamw", "-n", "2", "--set",
                         "load=1", "--set", "load")
        self.refused(2, "given twice", "truth", "elastica", "--set", "load=1", "--set", "load=2")
        self.refused(2, "given twice", "solve", "elastica", "-n", "2", "-f",
                     "beamw:mass=lumped,mass=consistent")
        self.refused(2, "given twice", "solve", "elastica", "-n", "2", "-f",
                     "beamw:newton=mixed,newton=mixed")
        self.refused(2, "given twice", "converge", "elastica", "-n", "2", "-f", "beamw", "-f",
                     "beamw:mass=consistent")

    def test_commas(self):
        for stray in (",{}", "{},", ",", "{0},,{0}", ""):
            self.refused(2, "number of elements", "converge", "elastica", "-f", "beamw", "-n",
                         stray.format("2"))
            if stray != "":
                self.refused(2, "option", "converge", "elastica", "-n", "2", "-f",
                             "beamw:" + stray.format("mass=lumped"))
            self.refused(2, "threshold", "compare", "old.h5", "new.h5", "--threshold",
                         stray.format("error=1"))
        self.refused(2, "option", "converge", "elastica", "-n", "2", "-f", "beamw:")

    def test_numbers(self):
        """What a double cannot hold is no value: neither zero nor infinity."""
        for text in ("1e-400", "-1e-400", "1e400", "1e-320", "1e999999999999", "0x1p-2000", "nan",
                     "inf", "1,5", "1e", "", " "):
            self.refused(2, "parameter load", "solve", "elastica", "-f", "beamw", "-n", "1",
                         "--set",
                         f"load={text}")
            self.refused(2, "threshold", "compare", "old.h5", "new.h5", "--threshold",
                         f"error={text}")


class Tables(ProgramTest):
    """The arrays of options that verbs name."""

    CLI = ROOT / "harness" / "cli"
    ANSWERS = {"bench": ("bench", "contest", "contestant")}  # else the file of the verb
    ELSEWHERE = {("scene", "format")}  # of the mistakes that case_input reports

    def shown(self, verb):
        """(letter, name) of each option."""
        return re.findall(r"^  (?:-(\w), |    )--([a-z-]+)", run(verb, "-h", env=HELP).stdout,
                          re.MULTILINE)

    def source(self, name):
        return (self.CLI / f"{name}.c").read_text(encoding="utf-8")

    def test_letters(self):
        """Few, each with one meaning; names of a verb are its own."""
        meaning = {}
        for verb in EVERY_VERB:
            names = [name for _, name in self.shown(verb)]
            self.assertEqual(len(names), len(set(names)), verb)
            for letter, name in filter(lambda one: one[0], self.shown(verb)):
                self.assertEqual(meaning.setdefault(letter, name), name)
        self.assertEqual("".join(sorted(meaning)), "fhjknoqsv")

    def test_former_letters(self):
        """Each is still read, and told with its name."""
        names = {name: verb for verb in EVERY_VERB for _, name in self.shown(verb)}
        former = re.findall(r"\{'(.)', \"([a-z-]+)\"\}", self.source("options"))
        self.assertGreater(len(former), 40)
        for letter, name in former:
            told = run(names[name], f"-{letter}", "3", "-h", env=HELP).stderr
            self.assertIn(f"-{letter} is --{name} now", told)
        self.answered("solve", "warping_torsion", "-fbeamw", "-Kn2")

    def test_each_is_used(self):
        """By the verb that takes it; 'merge' passes all on."""
        everything = "".join(path.read_text(encoding="utf-8") for path in self.CLI.glob("*.c"))
        for verb in EVERY_VERB:
            name = verb.replace("-", "_")
            answers = "".join(self.source(file).partition("#define IN(at)")[0]
                              for file in self.ANSWERS.get(verb, (name,)))
            table = self.source(name).partition("#define IN(at)")[2]
            members = re.findall(r"\bIN\((?!at\b)([\w.]+)\)|SHARED\(\w+,\s*([\w.]+)\)", table)
            self.assertTrue(members or verb == "merge", verb)
            for member in {own or shared for own, shared in members if verb != "merge"}:
                head, _, tail = member.partition(".")
                if tail and f"&r->{head}" in answers:  # a whole group, which others read
                    self.assertRegex(everything, rf"->{tail}\b", (verb, member))
                elif (verb, member) not in self.ELSEWHERE:
                    self.assertRegex(answers, rf"->{re.escape(member)}\b", (verb, member))
        for group in ("solver", "reports"):
            for verb in ("solve", "bench", "verify"):
                if f"SHARED({group}," in self.source(verb):
                    answers = "".join(map(self.source, self.ANSWERS.get(verb, (verb,))))
                    for member in re.findall(rf"offsetof\({group[:6]}\w*_options, (\w+)\)",
                                             self.source("options")):
                        self.assertIn(f"->{group}.{member}", answers)


class Machine(ProgramTest):
    """A disk, files or a stack that are too small."""

    @unittest.skipUnless(os.path.exists("/dev/full"), "needs /dev/full")
    def test_full_disk(self):
        """Whatever is shown: not shown is not well."""
        shown = [("--help",), ("help",), ("--version",), (), ("list",), ("list", "cases"),
                 ("list", "formulations"), ("list", "elastica"),
                 ("truth", "elastica"), *((verb, *work) for verb, work in WORK.items()),
                 *((verb, "--help") for verb in VERBS),
                 *((verb, "--usage") for verb in VERBS)]
        for arguments in shown:
            with open("/dev/full", "w", encoding="ascii") as full:
                done = run(*arguments, stdout=full, env=HELP)
            self.assertEqual(done.returncode, 4, (arguments, done))
            self.assertEqual(done.stderr.strip(), "beamwork: standard output cannot be written",
                             arguments)

    def test_small_files(self):
        """ulimit -f, without anybody who ignores its signal."""
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
            resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
        with open(self.folder / "list", "w", encoding="ascii") as file:
            done = run("list", stdout=file, preexec_fn=limit)
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (4, 1), done)
        for verb, option in (("verify", "-o"), ("verify", "--json"), ("converge", "-o"),
                             ("stress", "--json")):
            more = ("--format", "json") if verb == "converge" else ()
            done = run(verb, *WORK[verb], *more, option, self.folder / "out", preexec_fn=limit)
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (4, 1), done)
        self.assertEqual(os.listdir(self.folder), ["list"])

    def with_stack(self, size, hard, path, **more):
        """verify with a stack of so many kB, to begin with or at most; nothing else on the stack
        than these variables."""
        def limit():
            resource.setrlimit(resource.RLIMIT_STACK,
                               (size * 1024, size * 1024 if hard else 2 ** 23))
        done = run("verify", *WORK["verify"], preexec_fn=limit, env={"PATH": path, **more})
        told = (done.returncode, len(done.stderr.splitlines()))
        self.assertEqual(told, (4, 1) if hard else (0, 0), (size, hard, done))
        self.assertTrue(not hard or "ulimit -s" in done.stderr)

    def needs_no_sanitizers(self):
        if "fsanitize" in run("--version").stdout:
            self.skipTest("needs a build without sanitizers")

    def test_small_stack(self):
        """ulimit -s: raised where that is allowed, refused in one line where it is not."""
        self.needs_no_sanitizers()
        for size in (24, 32, 64, 128, 512):
            for hard in (False, True):
                self.with_stack(size, hard, os.environ["PATH"], BEAMWORK_TRUTHS=TRUTHS)

    def test_least_stack(self):
        """With the least stack that the loader can work with, wherever addresses are moved to: a
        refusal by way of stdio, which has its buffer there, dies three times in four."""
        self.needs_no_sanitizers()
        for size in 8 * (16, 17, 18):
            self.with_stack(size, True, "/usr/bin:/bin")


class OtherPythons(ProgramTest):
    """Who works in a virtual environment, or with a Python of his own, has the truths derived all
    the same."""

    def derived(self, **changes):
        done = self.answered("truth", "elastica", "--set", "load=2.5", env=environment(**changes))
        self.assertRegex(done.stdout, r"w_over_L +0\.\d+")

    def setUp(self):
        super().setUp()
        (self.folder / "bin").mkdir()
        self.python = self.folder / "bin" / "python3"

    def test_virtual_environment(self):
        self.python.symlink_to("/usr/bin/python3")
        settings = "home = /usr/bin\ninclude-system-site-packages = false\n"
        (self.folder / "pyvenv.cfg").write_text(settings, encoding="ascii")
        missing = subprocess.run([self.python, "-c", "import mpmath"], capture_output=True,
                                 check=False)
        self.assertNotEqual(missing.returncode, 0, "an environment that has nothing")
        path = f"{self.folder}/bin:{os.environ['PATH']}"
        self.derived(PATH=path, VIRTUAL_ENV=str(self.folder))
        self.derived(PATH=f"{self.folder}/bin")

    def test_another_python(self):
        self.python.write_text("#!/bin/sh\nexit 99\n", encoding="ascii")
        self.python.chmod(0o755)
        self.derived(PATH=f"{self.folder}/bin:{os.environ['PATH']}")

    def test_environment_of_python(self):
        (self.folder / "mpmath.py").write_text("raise ImportError('not this one')\n",
                                               encoding="ascii")
        self.derived(PYTHONPATH=str(self.folder))
        self.derived(PYTHONHOME=str(self.folder))
        self.derived(PYTHONSTARTUP="/nowhere", PYTHONSAFEPATH="1")


if __name__ == "__main__":
    unittest.main()
