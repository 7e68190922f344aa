"""Requirements of each command on a machine without installed packages, and the counts of the test runner with artificial
tests."""
import json
import os
import pathlib
import re
import subprocess
import textwrap
import unittest

from harness.tools.kit.program import PROGRAM, ROOT, ProgramTest, run

TOOLS = ROOT / "harness" / "tools"
COMMANDS = ("build", "verify", "report", "test", "truths")
OPTIONAL = ("chromium", "vtk")


class Folder(ProgramTest):

    def script(self, name, *lines):
        path = self.folder / name
        path.write_text("#!/bin/sh\n" + "\n".join(lines) + "\n", encoding="ascii")
        path.chmod(0o755)


class Loading(unittest.TestCase):

    def test_few_libraries(self):
        places = run("--libs-only-L", "hdf5", program="pkg-config").stdout.split()
        archive = next((path for path in (pathlib.Path(place[2:], "libhdf5.a") for place in places)
                        if path.exists()), None)
        if archive is None:
            self.skipTest("needs HDF5 as an archive")
        if " U curl_" in run(archive, program="nm").stdout:
            self.skipTest("needs an archive of HDF5 that does without curl: before 1.14")
        linked = pathlib.Path(PROGRAM).with_name("program_libraries")
        if linked.read_text(encoding="ascii").startswith("shared"):
            self.skipTest("built with HDF5=shared")
        loaded = run(PROGRAM, program="ldd").stdout
        self.assertIn("libklu", loaded)
        for name in ("libhdf5", "libcurl", "libkrb5"):
            self.assertNotIn(name, loaded)

    def test_static_lapack(self):
        linked = pathlib.Path(PROGRAM).with_name("program_libraries").read_text(encoding="ascii")
        loaded = run(PROGRAM, program="ldd").stdout
        for name in ("liblapacke", "liblapack", "libblas"):
            if linked.startswith("shared") or f"{name}.a" not in linked:
                self.skipTest(f"needs {name} as an archive")
            self.assertNotIn(f"{name}.", loaded)
        self.assertNotIn("libopenblas", loaded)

    def test_static_openblas(self):
        if " openblas_get_num_threads\n" not in run(PROGRAM, program="nm").stdout:
            self.skipTest("needs OpenBLAS as an archive")
        exported = run("-D", PROGRAM, program="nm").stdout
        for name in ("set_num_threads", "get_config", "get_corename"):
            self.assertIn(f" T openblas_{name}\n", exported)


class Dependencies(Folder):
    def setUp(self):
        super().setUp()
        for name in ("cc", "pkg-config", "python3"):
            self.script(name, "exit 1")
        self.script("apt-get", f'echo "$@" >>"{self.folder}/asked"')

    def needs(self, command, user):
        self.script("id", f"echo {user}")
        asked = self.folder / "asked"
        asked.unlink(missing_ok=True)
        done = subprocess.run(
            [TOOLS / "dependencies.sh", command, self.folder / "flags.mk"],
            capture_output=True,
            text=True,
            check=False,
            env={
                "PATH": f"{self.folder}:{os.environ['PATH']}",
                "PYTHON": str(self.folder / "python3"), "CC": "cc"
            })
        self.assertEqual(done.returncode, 1, "what was missing still is")
        self.assertIn("Run: sudo apt-get install", done.stderr.splitlines()[-1])
        packages = set(done.stderr.splitlines()[-1].partition("apt-get install")[2].split())
        return packages, asked.read_text(encoding="ascii") if asked.exists() else ""

    def test_packages(self):
        needs = {command: self.needs(command, 0)[0] for command in COMMANDS}
        self.assertTrue({"libgsl-dev", "libhdf5-dev", "libjansson-dev"} <= needs["build"])
        self.assertFalse(any(name.startswith("python3") for name in needs["build"]))
        self.assertEqual(needs["verify"], {"python3-h5py", "python3-numpy"})
        self.assertTrue(
            {"python3-matplotlib", "python3-jinja2", "python3-markdown"} <= needs["report"])
        self.assertIn("python3-mpmath", needs["truths"])
        self.assertTrue(needs["report"] | needs["truths"] | needs["verify"] <= needs["test"])

    def test_nobody_installs_what_single_tests_need(self):
        for command in COMMANDS:
            packages, asked = self.needs(command, 0)
            self.assertIn("install", asked)
            for name in OPTIONAL:
                self.assertNotIn(name, asked)
                self.assertFalse(any(name in package for package in packages))

    def test_only_root_installs(self):
        for command in COMMANDS:
            self.assertEqual(self.needs(command, 1000)[1], "")

    def test_every_import_is_asked_for(self):
        own = {"reference", "reports", "harness"}
        for command, folders in (("verify", ["reference/pack.py"]),
                                 ("truths", ["reference/derive"]), ("report", ["reports"])):
            have = {package.removeprefix("python3-")
                    for package in self.needs(command, 1000)[0]} | {"mpl_toolkits", "markupsafe"}
            for folder in folders:
                one = folder.endswith(".py")
                for path in [ROOT / folder] if one else (ROOT / folder).glob("*.py"):
                    self.assertLessEqual(foreign_imports(path) - own, have, path)


def foreign_imports(path):
    import ast
    import sys
    names = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name.partition(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            names.add(node.module.partition(".")[0])
    return names - set(sys.stdlib_module_names)


class Runner(Folder):

    def tests(self, *lines):
        package = self.folder / "room"
        package.mkdir(exist_ok=True)
        (package / "__init__.py").touch()
        body = textwrap.indent("\n".join(lines), "    ")
        text = f"import unittest\n\n\nclass T(unittest.TestCase):\n{body}\n"
        (package / "made_up_test.py").write_text(text, encoding="ascii")

    def run_tests(self, *programs, python=("room", ), show=""):
        return subprocess.run(
            [TOOLS / "run_tests.sh", self.folder / "logs", *programs, *python],
            capture_output=True,
            text=True,
            check=False,
            cwd=self.folder,
            env=os.environ | {"SHOW": show})

    def test_counts(self):
        self.script("a_test", "echo PASS: one; echo PASS: two")
        self.tests("def test_good(self):", '    """With words."""',
                   "@unittest.skip('needs chromium')", "def test_skipped(self):",
                   '    """Says what."""', "@unittest.skip(\"needs a 'thing'\")",
                   "def test_skipped_too(self):", "    pass")
        done = self.run_tests(self.folder / "a_test")
        lines = done.stdout.splitlines()
        self.assertEqual((done.returncode, lines[-1]), (0, "3 passed, 0 failed, 2 skipped"), done)
        self.assertIn("SKIP room.made_up_test.T.test_skipped: needs chromium", lines)
        self.assertIn("SKIP room.made_up_test.T.test_skipped_too: needs a 'thing'", lines)

    def test_failures(self):
        self.tests("def test_good(self):", "    pass")
        self.assertEqual(self.run_tests().stdout.splitlines()[-1], "1 passed, 0 failed")
        for wrong in ("echo FAIL: this", "echo PASS: that; exit 3", "exit 0",
                      "echo PASS: that; kill -9 $$", "echo PASS: that; kill -9 $PPID"):
            self.script("a_test", wrong)
            done = self.run_tests(self.folder / "a_test")
            self.assertEqual(done.returncode, 1, wrong)
            self.assertIn(" 1 failed", done.stdout.splitlines()[-1])
        for wrong in ("    self.fail()", "    raise OSError"):
            self.tests("def test_bad(self):", wrong)
            done = self.run_tests()
            self.assertEqual((done.returncode, done.stdout.splitlines()[-1]),
                             (1, "0 passed, 1 failed"))

    def test_one_file(self):
        self.tests("def test_good(self):", "    pass")
        (self.folder / "room" / "other_test.py").write_text("raise OSError\n", encoding="ascii")
        done = self.run_tests(python=("room/made_up_test.py", ))
        self.assertEqual((done.returncode, done.stdout.splitlines()[-1]), (0, "1 passed, 0 failed"))
        self.assertEqual(self.run_tests(python=("room/other_test.py", )).returncode, 1)

    def test_shows_what_they_print(self):
        self.script("a_test", "echo PASS: one; echo here")
        self.tests("def test_good(self):", "    print('\\nthere')")
        for show in ("", "1"):
            lines = self.run_tests(self.folder / "a_test", show=show).stdout.splitlines()
            self.assertEqual([word for word in ("here", "there") if word in lines],
                             ["here", "there"] if show else [])

    def test_class_that_is_skipped(self):
        self.tests("@classmethod", "def setUpClass(cls):",
                   "    raise unittest.SkipTest('needs a lake')", "def test_one(self):", "    pass")
        done = self.run_tests()
        self.assertEqual((done.returncode, done.stdout.splitlines()[-1]),
                         (0, "0 passed, 0 failed, 1 skipped"), done)
        self.assertIn("needs a lake", done.stdout)

    def test_spaces(self):
        self.folder = self.folder / "a b"
        self.folder.mkdir()
        self.script("a_test", "echo PASS: one")
        self.tests("def test_good(self):", "    pass")
        self.assertEqual(
            self.run_tests(self.folder / "a_test").stdout.splitlines()[-1], "2 passed, 0 failed")


class Circles(Folder):
    def objects(self, **sources):
        paths = []
        for name, text in sources.items():
            path = self.folder / f"{name}.o"
            path.parent.mkdir(parents=True, exist_ok=True)
            subprocess.run(["cc", "-w", "-x", "c", "-c", "-o", path, "-"],
                           input=text,
                           text=True,
                           check=True)
            paths.append(path)
        return subprocess.run(["/usr/bin/python3", TOOLS / "circles.py", *paths],
                              capture_output=True,
                              text=True,
                              check=False,
                              cwd=self.folder)

    def test_calls_in_one_direction(self):
        said = self.objects(low="int low(void) { return 1; }",
                            middle="int low(void); int middle(void) { return low(); }",
                            high="int low(void), middle(void); int high(void) { return low(); }")
        self.assertEqual((said.returncode, said.stdout), (0, ""))

    def test_a_circle_is_named_with_its_calls(self):
        said = self.objects(one="int two(void); int one(void) { return two(); }",
                            two="int three(void); int two(void) { return three(); }",
                            three="int one(void); int three(void) { return one(); }",
                            apart="int one(void); int apart(void) { return one(); }")
        self.assertEqual(said.returncode, 1)
        first = said.stdout.splitlines()[0]
        self.assertTrue(all(f"{name}.o" in first for name in ("one", "two", "three")))
        self.assertNotIn("apart", said.stdout)
        self.assertIn("three.o: three", said.stdout)

    def test_folders_that_call_each_other(self):
        said = self.objects(**{
            "harness/low/one": "int one(void) { return 1; }",
            "harness/low/two": "int three(void); int two(void) { return three(); }",
            "harness/high/three": "int one(void); int three(void) { return one(); }",
            "harness/high/apart": "int apart(void) { return 1; }"})
        self.assertEqual(said.returncode, 1)
        self.assertIn("circle of folders by calls: harness/high/, harness/low/\n", said.stdout)
        self.assertIn("three.o three", said.stdout)
        self.assertNotIn("apart", said.stdout)

    def test_folders_that_include_each_other(self):
        for name, other in (("harness/low/one.c", "harness/high/two.h"),
                            ("harness/high/two.c", "harness/low/one.h")):
            path = self.folder / name
            path.parent.mkdir(parents=True)
            path.write_text(f'#include "{other}"\n', encoding="ascii")
        said = self.objects(**{"harness/low/one": "int one(void) { return 1; }",
                               "harness/high/two": "int two(void) { return 1; }"})
        self.assertEqual(said.returncode, 1)
        self.assertIn("circle of folders by includes: harness/high/, harness/low/\n", said.stdout)
        (self.folder / "harness/high/two.c").write_text("", encoding="ascii")
        self.assertEqual(self.objects(**{"harness/low/one": "int one(void) { return 1; }",
                                         "harness/high/two": "int two(void) { return 1; }"}).stdout, "")


class Mutants(Folder):
    def dry(self, root, table=()):
        faults = self.folder / "faults.list"
        faults.write_text(run("-B", TOOLS / "mutate.py", "--physics", *table,
                              program="/usr/bin/python3").stdout, encoding="utf-8")
        return subprocess.run([TOOLS / "mutants.sh", self.folder / "work"],
                              capture_output=True,
                              text=True,
                              check=False,
                              cwd=root,
                              env=os.environ | {"DRY": "1", "LIST": str(faults)})

    @unittest.skipUnless((ROOT / ".git").exists(), "needs a clone")
    def test_every_fault_has_its_place(self):
        done = self.dry(ROOT)
        lines = done.stdout.splitlines()
        self.assertEqual((done.returncode, [line for line in lines if "SURVIVED" in line]), (0, []))
        self.assertRegex(lines[-1], "^[5-9][0-9] match, 0 do not$")

    def test_a_fault_without_a_place(self):
        root = self.folder / "clone"
        root.mkdir()
        table = self.folder / "faults.csv"
        table.write_text("name,file,pattern,replacement,check\nhere,file,one,two,verify -k 'a b'\n"
                         "nowhere,file,three,four,verify\n", encoding="ascii")
        (root / "file").write_text("one\n", encoding="ascii")
        for command in (["git", "init", "-q"], ["git", "add", "-A"]):
            subprocess.run(command, check=True, cwd=root)
        done = self.dry(root, [table])
        self.assertEqual((done.returncode, done.stdout.splitlines()[-1]), (1, "1 match, 1 do not"))
        self.assertIn("SURVIVED  nowhere", done.stdout)

    def test_faults_that_are_made(self):
        root = self.folder / "clone"
        root.mkdir()
        texts = {
            "Makefile": """\
                all: build/beamwork build/a.o
                build/beamwork: ; @mkdir -p build; (echo '#!/bin/sh'; echo 'for last; do :; done'; \\
                    echo ': >"$$last"') >$@; chmod +x $@
                build/a.o: a.c ; @mkdir -p build; cc -O1 -c a.c -o $@
                build/a/true_test: ; @mkdir -p build/a; cp /bin/true $@
                build/a/a_test: build/a.o ; @mkdir -p build/a; cc build/a.o -o $@
                """,
            "a.c": """\
                int main(void)
                {
                    volatile int n = 3;
                    return 1 + 1 - 2 * (n > 0);
                }
                """,
            "list": "".join(f"plant {name} a.c '{change}' noticed any a/true_test a/a_test\n"
                            for name, change in (("sum", "4s|1 .|1 -|"), ("more", "3s|3|4|"),
                                                 ("alike", "4s|1 . 1|2 + 0|"),
                                                 ("broken", "4s|;|];|")))}
        for name, text in texts.items():
            (root / name).write_text(textwrap.dedent(text), encoding="ascii")
        for command in (["git", "init", "-q"], ["git", "add", "-A"]):
            subprocess.run(command, check=True, cwd=root)
        environment = {k: v for k, v in os.environ.items() if not k.startswith(("MAKE", "CFLAGS"))}
        done = subprocess.run([TOOLS / "mutants.sh", self.folder / "work"], cwd=root, text=True,
                              capture_output=True, check=False,
                              env=environment | {"LIST": str(root / "list")})
        told = [" ".join(line.split()) for line in done.stdout.splitlines()]
        self.assertEqual(told, [
            "killed sum exit noticed a/a_test (254)",
            "SURVIVED more exit 0, not noticed all of 2 checks",
            "idle alike exit idle the same machine code",
            "idle broken exit idle does not compile",
            "1 killed, 1 survived, 2 do not count"], done.stderr)
        self.assertEqual(done.returncode, 1)


class Make(Folder):
    def make(self, *arguments):
        goals = self.folder / "goals.mk"
        goals.write_text(textwrap.dedent("""\
            .PHONY: slow quick
            slow: ; @sleep 0.3; echo slow $(MAKEFLAGS)
            quick: ; @echo quick
            """),
                         encoding="ascii")
        environment = {k: v for k, v in os.environ.items() if not k.startswith("MAKE")}
        done = subprocess.run(
            ["make", "-s", "-f", ROOT / "Makefile", "-f", goals, "QUIET=1", *arguments],
            cwd=ROOT,
            capture_output=True,
            text=True,
            check=True,
            env=environment)
        return done.stdout.split("\n")

    def test_takes_all_processors(self):
        self.assertIn(f" -j{len(os.sched_getaffinity(0))} ", f"{self.make('slow')[0]} ")

    def test_as_many_as_said(self):
        self.assertIn(" -j1 ", f"{self.make('-j1', 'slow')[0]} ")

    def test_goals_in_their_order(self):
        self.assertEqual([line.split()[0] for line in self.make("slow", "quick")[:2]],
                         ["slow", "quick"])
        self.assertEqual([line.split()[0] for line in self.make("quick", "slow")[:2]],
                         ["quick", "slow"])

    def test_clean_before_all_else(self):
        told = self.make("-n", "V=1", "QUIET=", f"BUILD={self.folder}/b", "clean", "all")
        compiled = [line for line in told if line.endswith("-c harness/cli/main.c -o "
                                                           f"{self.folder}/b/harness/cli/main.o")]
        self.assertIn("hdf5", "".join(compiled))

    def test_few_targets_for_people(self):
        told = [line.split() for line in self.make("help") if line]
        self.assertEqual({words[1] for words in told}, {
            "all", "verify", "test", "report", "docs", "bench", "compare", "baseline", "check",
            "truths", "install", "clean", "help", "lab", "words", "peers", "site"})

    def test_laboratory(self):
        listed = [line.split(maxsplit=3)[2:] for line in self.make("lab") if line]
        names = [name.removeprefix("L=") for name, _ in listed]
        self.assertIn("motions", names)
        self.assertTrue(all(re.search("second|minute|hour", what) for _, what in listed))
        told = "\n".join(self.make("-n", "lab", "L=integrators newton"))
        self.assertLess(told.index("tools/integrators.py"), told.index("tools/newton.py"))
        with self.assertRaises(subprocess.CalledProcessError) as said:
            self.make("lab", "L=newton nothing")
        self.assertIn("there is no nothing", said.exception.stderr)

    def chosen(self, words):
        told = self.make("-n", "test", f"T={words}", f"BUILD={self.folder}")
        runs = [line.split("/logs ")[1].split() for line in told if "run_tests.sh" in line]
        self.assertEqual(len(runs), 1)
        return [test.removeprefix(f"{self.folder}/") for test in runs[0]], told

    def test_tests_by_words_of_their_names(self):
        tests, told = self.chosen("run_test truths")
        self.assertEqual([name for name in tests if not re.search("run_test|truths", name)], [])
        self.assertIn("harness/study/test/run_test", tests)
        self.assertTrue(any("/run_test" in line and " -o " in line for line in told))
        self.assertFalse(any("study/test/rules_test" in line for line in told))
        self.assertIn("reference/test/pack_test.py", self.chosen("reference/")[0])
        self.assertTrue(all("numerics" in name for name in self.chosen("numerics")[0]))

    def test_no_test_has_the_word(self):
        with self.assertRaises(subprocess.CalledProcessError) as said:
            self.make("-n", "test", "T=nosuchword")
        self.assertIn("'nosuchword'", said.exception.stderr)

    def test_debug(self):
        name = "build/debug/elements/beamw/lanes.o"
        told = "\n".join(self.make("-Bn", "DEBUG=1", "V=1", name))
        self.assertRegex(told, f" -O0 -g3 -O0 .*-o {name}")

    def test_compile_commands(self):
        told = self.make("-Bnk", "V=1", "QUIET=", f"BUILD={self.folder}", "all", "tests")
        done = subprocess.run(["/usr/bin/python3", TOOLS / "compile_commands.py"],
                              input="\n".join(told), text=True, capture_output=True, check=True,
                              cwd=ROOT)
        entries = {entry["output"]: entry for entry in json.loads(done.stdout)}
        for name in ("elements/beamw/lanes", "harness/cli/main", "harness/study/test/run_test"):
            self.assertEqual(entries[f"{self.folder}/{name}.o"]["file"], f"{name}.c")
        sources = {str(path.relative_to(ROOT)) for path in (ROOT / "harness").rglob("*.c")}
        self.assertEqual([path for path in sources - {entry["file"] for entry in entries.values()}
                          if "/test/" not in path], [])
        one = entries[f"{self.folder}/harness/formulations/environment.o"]
        self.assertEqual(one["directory"], str(ROOT))
        pathlib.Path(one["output"]).parent.mkdir(parents=True)
        subprocess.run(one["command"], shell=True, check=True, cwd=one["directory"])

if __name__ == "__main__":
    unittest.main()
