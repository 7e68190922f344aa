"""The command line: options, rejections and answers."""
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import unittest

import h5py

from harness.cli.test.work import EVERY_VERB, VERBS, WORK
from harness.tools.kit.program import ProgramTest, ROOT, TRUTHS, environment, run
from reference.pack import seal


LISTS = ("formulation", "element", "elements", "set")
# argp of the C library does not free one byte at exit
HELP = environment(ASAN_OPTIONS="detect_leaks=0")


class Words(ProgramTest):

    def test_options_twice(self):
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
        for text in ("1e-400", "-1e-400", "1e400", "1e-320", "1e999999999999", "0x1p-2000", "nan",
                     "inf", "1,5", "1e", "", " "):
            self.refused(2, "parameter load", "solve", "elastica", "-f", "beamw", "-n", "1",
                         "--set",
                         f"load={text}")
            self.refused(2, "threshold", "compare", "old.h5", "new.h5", "--threshold",
                         f"error={text}")


class Tables(ProgramTest):
    CLI = ROOT / "harness" / "cli"
    ANSWERS = {"bench": ("bench", "bench_against", "compared_run")}
    ELSEWHERE = {("scene", "format")}

    def shown(self, verb):
        return re.findall(r"^  (?:-(\w), |    )--([a-z-]+)", run(verb, "-h", env=HELP).stdout,
                          re.MULTILINE)

    def source(self, name):
        return (self.CLI / f"{name}.c").read_text(encoding="utf-8")

    def test_letters(self):
        meaning = {}
        for verb in EVERY_VERB:
            names = [name for _, name in self.shown(verb)]
            self.assertEqual(len(names), len(set(names)), verb)
            for letter, name in filter(lambda one: one[0], self.shown(verb)):
                self.assertEqual(meaning.setdefault(letter, name), name)
        self.assertEqual("".join(sorted(meaning)), "fhjknoqsv")

    def test_former_letters(self):
        names = {name: verb for verb in EVERY_VERB for _, name in self.shown(verb)}
        former = re.findall(r"\{'(.)', \"([a-z-]+)\"\}", self.source("options"))
        self.assertGreater(len(former), 40)
        for letter, name in former:
            told = run(names[name], f"-{letter}", "3", "-h", env=HELP).stderr
            self.assertIn(f"-{letter} has been renamed to --{name};", told)
        self.answered("solve", "warping_torsion", "-fbeamw", "-Kn2")

    def test_former_names(self):
        verbs = {name: verb for verb in EVERY_VERB for _, name in self.shown(verb)}
        renamed = re.findall(r"\{\"([a-z-]+)\", \"([a-z-]+)\"\}", self.source("options"))
        self.assertEqual(len(renamed), 10)
        for was, name in renamed:
            done = run(verbs[name], f"--{was}", "-h", env=HELP)
            if "requires a value" in done.stderr or done.returncode != 0:
                done = run(verbs[name], f"--{was}=1", "-h", env=HELP)
            self.assertIn(f"--{was} has been renamed to --{name};", done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)
            for verb in EVERY_VERB:
                self.assertNotRegex(run(verb, "-h", env=HELP).stdout, rf"--{was}\b(?!-)")
                self.assertNotRegex(run(verb, "--usage", env=HELP).stdout, rf"--{was}\b(?!-)")
        self.answered("solve", "warping_torsion", "-fbeamw", "--keep-all", "-n2")
        self.refused(2, "is an abbreviation of several options", "sweep", "elastica", "--de")
        self.refused(2, "solve has no --beside", "solve", "elastica", "--beside", "x.h5")

    def test_each_is_used(self):
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
                if tail and f"&r->{head}" in answers:
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
    @unittest.skipUnless(os.path.exists("/dev/full"), "needs /dev/full")
    def test_full_disk(self):
        shown = [("--help",), ("help",), ("--version",), (), ("list",), ("list", "cases"),
                 ("list", "formulations"), ("list", "elastica"),
                 ("truth", "elastica"), *((verb, *work) for verb, work in WORK.items()),
                 *((verb, "--help") for verb in VERBS),
                 *((verb, "--usage") for verb in VERBS)]
        for arguments in shown:
            with open("/dev/full", "w", encoding="ascii") as full:
                done = run(*arguments, stdout=full, env=HELP)
            self.assertEqual(done.returncode, 4, (arguments, done))
            self.assertRegex(done.stderr, r"^beamwork: standard output cannot be written \(.+\); free disk space, or "
                             r"redirect the output to another file\n$",
                             arguments)

    def test_small_files(self):
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
        self.needs_no_sanitizers()
        for size in (24, 32, 64, 128, 512):
            for hard in (False, True):
                self.with_stack(size, hard, os.environ["PATH"], BEAMWORK_TRUTHS=TRUTHS)

    def test_least_stack(self):
        self.needs_no_sanitizers()
        for size in 8 * (16, 17, 18):
            self.with_stack(size, True, "/usr/bin:/bin")


class OtherPythons(ProgramTest):
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


EXAMPLES = ROOT / "cases" / "examples"


def solve(case, *assignments):
    sets = [word for assignment in assignments for word in ("--set", assignment)]
    return ("solve", case, "-f", "beamw", "-n", "2", *sets)


def untimed(text):
    return re.sub(r"scatter, in [\d.]+ s", "scatter", text)


class Refusals(ProgramTest):

    def test_names(self):
        self.refused(2, "did you mean 'c_column'", "solve", "c_colum", "-f", "beamw", "-n", "2")
        self.refused(2, "did you mean 'beamw'", "solve", "c_column", "-f", "beamv", "-n", "2")
        self.refused(2, "did you mean 'length'", *solve("c_column", "lenght=2"))
        self.refused(2, "did you mean 'verify'", "verifi")

    def test_values(self):
        for bad in ("length=-1", "length=nan", "length=inf", "length=0x10", "length=1e-999", "young=0", "flange_thickness=0"):
            self.refused(2, bad.partition("=")[0], *solve("c_column", bad))
        self.refused(2, "positive definite", *solve("c_column", "section_data=misprinted"))
        self.refused(2, "poisson", *solve("sheet_cantilever", "poisson=0.5"))
        self.refused(2, "tip_deflection", *solve("sheet_cantilever", "tip_deflection=0.2"))
        self.refused(2, "elements", "solve", "c_column", "-f", "beamw", "-n", "0")
        self.refused(2, "memory", "solve", "c_column", "-f", "beamw", "-n", "10000000")
        self.refused(2, "does not support coupled section", "solve", "coupled_beam", "-f",
                     "beamw_vlasov", "-n", "2")
        done = self.answered("solve", "sheet_cantilever", "-f", "collocation:newton=dense", "-n", "2",
                             "--set", "modes=3", code=1)
        self.assertIn("give newton=mixed", done.stdout + done.stderr)

    def test_byte_order_marks(self):
        """Byte order marks, which some editors write, must be accepted at the start of any text file."""
        results, table = self.folder / "r.h5", self.folder / "r.csv"
        self.answered("verify", "-k", "=elastica", "-f", "beamw", "-o", results)
        self.answered("compare", results, "-o", table)
        scene = (EXAMPLES / "euler_column.yaml").read_text(encoding="utf-8")
        columns = {name: (ROOT / "reference" / name).read_text(encoding="utf-8").splitlines()[0] + "\n"
                   for name in ("findings.csv", "tables/elastica.csv")}
        imported = ("# beamwork-import: 1\n# program: mine\n# case: elastica\n"
                    "quantity, unit, elements, value\nw_over_L, 1, 4, 0.3\n")
        for text, words in ((table.read_text(encoding="utf-8"), ("compare", "FILE", results)),
                            (scene, ("solve", "--scene", "FILE")), (imported, ("import", "FILE", "-o", self.folder / "i.h5")),
                            (columns["findings.csv"], ("verify", "-k", "=elastica", "-f", "beamw", "--deviations", "FILE")),
                            (columns["tables/elastica.csv"],
                             ("verify", "-k", "=elastica", "-f", "beamw", "--truths", "FILE"))):
            path = self.folder / ("marked.yaml" if text == scene else "marked.csv")
            path.write_text(text, encoding="utf-8-sig")
            self.answered(*[path if word == "FILE" else word for word in words])

    def test_examples_have_names(self):
        path = EXAMPLES / "euler_column.yaml"
        for verb in (("list", ), ("solve", "-f", "beamw", "-n", "2", "--format", "csv"), ("truth", )):
            by_name, by_file = (self.answered(verb[0], *of, *verb[1:]).stdout
                                for of in (("euler_column", ), ("--scene", path)))
            self.assertEqual(re.sub(r"\d\.\d+(e-\d+)?", "#", by_name), re.sub(r"\d\.\d+(e-\d+)?", "#", by_file))
        self.refused(2, "unknown case 'euler_colum'", "solve", "euler_colum")

    def test_truth_files(self):
        foreign, cut = self.folder / "foreign.h5", self.folder / "cut.h5"
        foreign.write_bytes(b"hello")
        cut.write_bytes(pathlib.Path(TRUTHS).read_bytes()[:3000])
        for path in (foreign, cut, self.folder / "missing.h5"):
            self.refused(4, str(path), "verify", "--truths", path)

    def test_unwritable_output(self):
        words = "cannot be written"
        self.refused(4, words, "verify", "-k", "warping_torsion", "-o", "/nowhere/results.h5")
        self.refused(4, words, *solve("warping_torsion"), "-o", self.folder)
        self.assertEqual(os.listdir(self.folder), [])

    def test_full_disk(self):
        if os.path.exists("/dev/full"):
            with open("/dev/full", "w", encoding="ascii") as full:
                self.answered(*solve("warping_torsion"), code=4, stdout=full)

    def test_nothing_checked(self):
        self.refused(3, "no verdict, because there is no reference value", "verify", "-k", "elastica and hexapod",
                     silent=False)

    def test_misspelt_selection(self):
        for verb in ("verify", "stress"):
            self.refused(2, "did you mean 'elastica'?", verb, "-k", "elastca")
            self.refused(2, "'sheet_thrid'", verb, "-k", "(elastica or sheet_thrid)")
        found = [untimed(self.answered("verify", "-k", selection).stdout) for selection in
                 ("warping_torsion/default or elastica/default",
                  "(warping_torsion/default or elastica/default)",
                  "((elastica or warping_torsion) and (default))")]
        self.assertEqual(len(set(found)), 1, found)


class Answers(ProgramTest):

    def test_json(self):
        result = self.record(*solve("c_column", "section_data=printed"))
        self.assertEqual(result["schema_version"], 3)
        self.assertEqual(result["parameters"]["section_data"], "printed")
        load = result["quantities"][0]
        self.assertAlmostEqual(load["value"] / 12858745.038, 1, delta=1e-9)
        self.assertTrue(any(t["truth_kind"] == "exact" for t in load["truths"]))

    def test_gate(self):
        path = self.folder / "t.h5"
        shutil.copy(TRUTHS, path)
        selection = ("-k", "c_column and section_data=printed and beamw", "--truths", path)
        self.answered("verify", *selection)
        with h5py.File(path, "r+") as file:
            file["findings"]["quantities"] = b"gone"
        seal(path)
        done = self.answered("verify", *selection, code=1)
        self.assertIn("-2.7801 % wrong limit", done.stdout)

    def test_jobs_agree(self):
        one = run("verify", "-k", "warping_torsion", "-j", "1")
        two = run("verify", "-k", "warping_torsion", "-j", "2")
        self.assertEqual(untimed(one.stdout), untimed(two.stdout))

    def test_truth(self):
        source = r" +1 +exact +same\n +reference/derive/cantilevers.py"
        for load in ("load=2", "load=2.5"):
            done = self.answered("truth", "elastica", "--set", load)
            self.assertRegex(done.stdout, r"w_over_L +0\.[45]\d+ \+- \S+" + source)
        self.answered("truth", "elastica", "--set", "load=zwei", code=2)
        self.answered("truth", "no_such_case", code=2)
        self.refused(4, "", "truth", "elastica", "--set", "load=2.5",
                     silent=False, env=environment(BEAMWORK_REFERENCE="/nowhere"))

    def test_truth_has_the_digits_of_its_uncertainty(self):
        text = self.answered("truth", "spherical_joint").stdout
        self.assertNotRegex(text, r"\d\.\d*(9{6}|0{6}\d)")
        self.assertRegex(text, r"support_stiffness_max +\S+ \+- .* exact +same, haringx\n")
        thin = ("c_column", "--set", "flange_thickness=0.02")
        load = float(re.search(r"buckling_load +(\S+) ", self.answered("truth", *thin).stdout)[1])
        solved = self.record("solve", *thin, "-f", "beamw_consistent", "-n", 32)["quantities"]
        self.assertLess(abs(next(q["value"] for q in solved if q["quantity"] == "buckling_load") / load - 1), 3e-4)
        done = self.answered("truth", "--scene", EXAMPLES / "euler_column.yaml")
        self.assertIn("give `truths` in the scene", done.stderr)

    def derived(self, scene, *words):
        """Returns {quantity: (value, uncertainty)} and the printed lines for the truths file that contain them."""
        done = self.answered("truth", "--scene", scene, *words)
        lines = done.stdout.partition("truths:\n")[2]
        found = re.findall(r"quantity: (\w+), value: (\S+), uncertainty: (\S+), kind: exact", lines)
        return {name: (float(value), float(plus)) for name, value, plus in found}, lines

    def test_truth_of_a_scene(self):
        for case in ("bend_45", "shear_elastica", "roll_up"):
            scene = self.folder / f"{case}.yaml"
            self.answered("scene", case, "-o", scene)
            stored = re.findall(r"^  (\w+) +(\S+) \+- (\S+) .* exact ",
                                self.answered("truth", case).stdout, re.MULTILINE)
            found = self.derived(scene)[0]
            self.assertEqual({name for name, _, _ in stored}, set(found))
            for name, value, plus in stored:
                self.assertLessEqual(abs(float(value) - found[name][0]),
                                     float(plus) + found[name][1], (case, name))
        text = (EXAMPLES / "box_girder.yaml").read_text(encoding="utf-8")
        beyond, start = self.folder / "beyond.yaml", text.index("truths:\n")
        beyond.write_text(text[:start] + text[text.index("meshes:", start):], encoding="utf-8")
        self.refused(1, "cells", "truth", "--scene", beyond, silent=False)
        done = self.answered("truth", "--scene", EXAMPLES / "box_girder.yaml")
        self.assertIn("cells", done.stderr)

    def test_derived_lines_belong_into_the_file(self):
        scene = self.folder / "portal.yaml"
        text = (EXAMPLES / "plane_portal.yaml").read_text(encoding="utf-8")
        head, _, tail = text.partition("truths:\n")
        found, lines = self.derived(EXAMPLES / "plane_portal.yaml", "--set", "push=900")
        scene.write_text(head + "truths:\n" + lines + tail[tail.index("omit:"):], encoding="utf-8")
        there = self.answered("truth", "--scene", scene, "--set", "push=900").stdout
        for name, (value, plus) in found.items():
            shown = re.search(rf"{name} +(\S+) .*exact", there)[1]
            self.assertLessEqual(abs(float(shown) - value), 1e-3 * plus)
        elsewhere = self.answered("truth", "--scene", scene).stdout
        self.assertNotRegex(elsewhere, r"same\n +reference")


if __name__ == "__main__":
    unittest.main()
