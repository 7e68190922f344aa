"""Runs every command among the examples of the help texts and of the manual."""
import re
import shlex
import shutil
import subprocess

from harness.cli.test.plugin import EXAMPLES, compile_shared
from harness.cli.test.work import EVERY_VERB
from harness.tools.kit.program import PROGRAM, ROOT, ProgramTest, environment, run

LEAF = """beamwork: 1
sections: {leaf: {rectangle: {width: 50e-3, thickness: 0.5e-3}, young: 210e9, shear_modulus: 81e9}}
nodes: {base: {at: [0, 0, 0], hold: all}, tip: {at: [0.1, 0, 0]}}
members: {leaf: {from: base, to: tip, section: leaf, y: [0, 1, 0]}}
loads: {push: {force: [0, 1, 0], on: tip}}
meshes: [1, 2]
"""
THEIRS = """# beamwork-import: 1
# program: theirs 1.0
# case: elastica
quantity, unit, elements, unknowns, seconds, x, value, uncertainty
w_over_L, 1, 8, 48, 0.1, , 0.3017, 1e-4
"""
SMALL = " -k '=elastica and =default and =beamw'"
# Replacements in examples that take long: part of the command, and its replacement.
REDUCED = {
    "verify --shard 1/4 --into parts": ("parts", "parts" + SMALL),
    "verify -o build/results.h5": ("results.h5", "results.h5" + SMALL),
    "--design sobol --points 200": ("200", "4"),
    "--vary length=2..12/10 -k buckling_load --compute-references": ("2..12/10", "2..12/1"),
    "--error 1%,0.1%": ("1%,0.1%", "1%"),
}


def commands(text):
    return [line.split("   ")[0].strip() for line in text.splitlines() if re.match(r"  beamwork [a-z]", line)]


def manual_commands(page):
    text = run("help", "--man", page).stdout.partition(".Sh EXAMPLES")[2].partition(".Sh SEE")[0]
    plain = text.replace("\\-", "-").replace("\\(dq", '"').replace("\\&", "").replace("\\e", "\\")
    lines = (re.sub(r'^\.Dl "(.*)"$', r"\1", line) for line in plain.splitlines())
    return [line for line in lines if line.startswith("beamwork ")]


def reduced(command):
    for what, (before, after) in REDUCED.items():
        if what in command:
            return command.replace(before, after)
    return command


class Examples(ProgramTest):
    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        cls.before, cls.place = folder / "before", folder / "files"
        for made in ("build", "first", "second", "harness/experiments"):
            (cls.place / made).mkdir(parents=True)
        cls.before.mkdir()
        (cls.before / "beamwork").symlink_to(PROGRAM)
        for name in ("cases", "reference"):
            (cls.place / name).symlink_to(ROOT / name)
        shutil.copy(ROOT / "harness" / "baseline.csv", cls.place / "harness")
        pace = (ROOT / "harness" / "experiments" / "expected.csv").read_text(encoding="utf-8").splitlines(keepends=True)
        for name, text in (("leaf.yaml", LEAF), ("theirs.csv", THEIRS), ("harness/experiments/expected.csv", "".join(pace[:2]))):
            (cls.place / name).write_text(text, encoding="utf-8")
        compile_shared(EXAMPLES / "timoshenko.c", cls.place / "mine.so")
        small, swept = "verify" + SMALL, "sweep elastica --vary load=1,2 -f beamw -n 1,2"
        for made in (f"{small} -o build/results.h5", f"{small} -o old.h5", f"{small} -o new.h5", f"{swept} -o old_sweep.h5",
                     f"{swept} -o new_sweep.h5", f"{small} --shard 1/1 --into parts", f"{small} --shard 1/2 --into first/parts",
                     f"{small} --shard 2/2 --into second/parts"):
            subprocess.run([PROGRAM, *shlex.split(made)], cwd=cls.place, check=True, stdout=subprocess.DEVNULL)

    def run_all(self, found):
        here = self.place.with_name(f"here {len(list(self.place.parent.iterdir()))}")
        shutil.copytree(self.place, here, symlinks=True)
        if any("--into parts" in command for command in found):
            shutil.rmtree(here / "parts")
        path = f"{self.before}:{environment()['PATH']}"
        for command in found:
            with self.subTest(command=command):
                done = subprocess.run(reduced(command), shell=True, cwd=here, text=True, check=False, stdout=subprocess.PIPE,
                                      stderr=subprocess.PIPE, env=environment(PATH=path))
                self.assertEqual(done.returncode, 0, done.stderr[-600:])
                written = re.search(r" -o (\S+)", command)
                self.assertTrue((here / written[1]).stat().st_size if written else done.stdout)

    def test_help(self):
        used, seen = set(), 0
        for verb in EVERY_VERB:
            text = self.answered(verb, "-h", env=environment(ASAN_OPTIONS="detect_leaks=0")).stdout
            found = commands(text.partition("\nexample")[2])
            self.assertTrue(found, verb)
            self.assertEqual(manual_commands(f"beamwork-{verb}.1"), found)
            self.run_all(found)
            seen += len(found)
            used |= {what for what in REDUCED for command in found if what in command}
        self.assertGreater(seen, 30)
        self.assertEqual(used, set(REDUCED), "an example that is no more")

    def test_first_page(self):
        found = commands(run("-h").stdout.partition("to begin with")[2])
        self.assertEqual(manual_commands("beamwork.1"), found)
        self.assertEqual(len(found), 4)
        self.run_all(found)
