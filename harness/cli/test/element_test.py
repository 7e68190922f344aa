"""Formulations from outside: the example as a stranger compiles it, and files that mean harm."""
import csv
import json
import os
import subprocess

from harness.test.program import ROOT, ProgramTest, environment, run

EXAMPLE = ROOT / "elements" / "examples" / "timoshenko.c"
CASE = ("elastica", "-f", "timoshenko")
CRASHES = environment(ASAN_OPTIONS="handle_segv=0")  # a crash is one, also under sanitizers


class Loaded(ProgramTest):

    def compiled(self, source, name="mine.so"):
        """The path of a shared object made of this text."""
        text, made = self.folder / f"{name}.c", self.folder / name
        text.write_text(source, encoding="utf-8")
        subprocess.run([os.environ.get("CC", "cc"), "-O1", "-shared", "-fPIC", "-I", ROOT, text,
                        "-o", made],
                       check=True)
        return made

    def example(self, *changes):
        """The example with parts of its text replaced, each of which must be there."""
        text = EXAMPLE.read_text(encoding="utf-8")
        for before, after in changes:
            self.assertIn(before, text)
            text = text.replace(before, after, 1)
        return self.compiled(text)


class Example(Loaded):

    @classmethod
    def setUpClass(cls):
        cls.object = cls.class_folder() / "timoshenko.so"
        subprocess.run([os.environ.get("CC", "cc"), "-O2", "-Wall", "-Wextra", "-Werror", "-shared",
                        "-fPIC", "-I", ROOT, EXAMPLE, "-o", cls.object],
                       check=True)

    def test_short(self):
        lines = EXAMPLE.read_text(encoding="utf-8").splitlines()
        self.assertLessEqual(len(lines), 130)
        self.assertEqual([line for line in lines if line.startswith('#include "')],
                         ['#include "elements/element.h"'])

    def test_judged_like_the_others(self):
        """Ten cases, statics, vibration and buckling: limits of order two that are right."""
        record, needed = self.folder / "v.json", self.folder / "needed.csv"
        cases = ("tapered_cantilever", "deep_beam", "weighted_column", "tip_body", "sprung_beam",
                 "loaded_cantilever", "bend_45", "elastica", "snap_through", "right_angle_frame")
        self.answered("verify", "--element", self.object, "-f", "timoshenko", "-k",
                      " or ".join(f"{case}/default" for case in cases), "--json", record,
                      "--propose", needed)
        found = json.loads(record.read_text(encoding="utf-8"))["verdicts"]
        passed = {v["case"] for v in found if v["verdict"] == "pass"}
        self.assertEqual(passed - {"shear_elastica"}, set(cases))
        self.assertNotIn("wrong limit", {v["verdict"] for v in found})
        with open(needed, newline="", encoding="utf-8") as rows:
            rules = list(csv.DictReader(rows))
        self.assertEqual(
            {(r["cases"], r["verdicts"]) for r in rules},
            {(v["case"], v["verdict"]) for v in found
             if v["verdict"] not in ("pass", "skip", "no truth")})

    def test_beside_the_others(self):
        out = self.answered("converge", "tapered_cantilever", "--element", self.object, "-f",
                            "timoshenko", "-f", "collocation", "-n", "2,4,8").stdout
        self.assertIn("timoshenko", out)
        self.assertIn("collocation", out)

    def test_differences_rank_nothing(self):
        out = self.answered("converge", "tapered_cantilever", "--element", self.object, "-f",
                            "timoshenko", "-f", "geometrically_exact").stdout
        answer = " ".join(out[out.rindex("for 1 %"):].split())
        self.assertRegex(answer, r"geometrically_exact n = \d+ .*timoshenko n = \d+ \(its deriv")

    def test_named_before_it_is_loaded(self):
        self.answered("solve", "-f", "timoshenko", "elastica", "-n", "8", "--element", self.object)

    def test_does_not_gate(self):
        """A stiffness that is wrong by 1 % is told, and written as a finding; the run passes."""
        wrong = self.example(("c->young * c->Iy / l3", "1.01 * c->young * c->Iy / l3"))
        needed = self.folder / "needed.csv"
        out = self.answered("verify", "--element", wrong, "-f", "timoshenko", "-k",
                            "tapered_cantilever/default", "--propose", needed).stdout
        self.assertIn("new formulations, which do not gate", " ".join(out.split()))
        self.assertIn("deflection_z", needed.read_text(encoding="utf-8"))
        self.assertIn("wrong limit", needed.read_text(encoding="utf-8"))


class Refused(Loaded):

    def refuse(self, path, *words):
        self.refused(2, words, "solve", *CASE, "-n", "2", "--element", path)

    def test_no_shared_object(self):
        self.refuse(self.folder / "none.so", "none.so", "is it a shared object?")
        text = self.folder / "text.so"
        text.write_text("text", encoding="ascii")
        self.refuse(text, "is it a shared object?")

    def test_no_symbol(self):
        self.refuse(self.compiled("int other;"), "beamwork_element")

    def test_other_interface(self):
        self.refuse(self.example((".abi = ELEMENT_ABI", ".abi = ELEMENT_ABI + 1")), "version")
        self.refuse(self.example((".size = sizeof(element_type)", ".size = 8")), "bytes")
        self.refuse(self.example((".size = sizeof(element_type)", ".size = 1 << 20")), "bytes")

    def test_says_too_little(self):
        self.refuse(self.example(('.name = "timoshenko"', '.name = "no word"')), ".name")
        self.refuse(self.example((".data_size = data_size,", "")), ".data_size")
        self.refuse(self.example((".family = \"example\",", "")), ".family")

    def test_name_that_is_there(self):
        self.refuse(self.example(('.name = "timoshenko"', '.name = "collocation"')),
                    "collocation is there already")

    def test_sizes_that_cannot_be(self):
        made = self.example(("return STRAINS;", "return 1000;"))
        self.refused(2, "1 to 24 strains", "solve", *CASE, "-n", "2", "--element", made)

    def test_strains_without_stresses(self):
        made = self.example((".stress = stress,", ""))
        self.refused(2, "belong together", "solve", *CASE, "-n", "2", "--element", made)


class Hostile(Loaded):
    """Each ends as one line, in `solve` and as a cell of `converge`."""

    def one_line(self, made, *words):
        done = run("solve", *CASE, "-n", "2", "--element", made, "--time-limit", "2")
        self.assertEqual(done.returncode, 1, done)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def cell(self, made, *words):
        record = self.folder / "v.json"
        run("verify", "-f", "timoshenko", "--element", made, "-k", "elastica/default", "--json",
            record, "--time-limit", "2", env=CRASHES)
        reasons = {v["reason"]
                   for v in json.loads(record.read_text(encoding="utf-8"))["verdicts"]
                   if v["verdict"] == "diverged"}
        self.assertTrue(reasons)
        for word in words:
            self.assertTrue(all(word in reason for reason in reasons), reasons)

    def test_crash(self):
        made = self.example(("    if (out->e == NULL)",
                             "    *(volatile int *)0 = 1;\n    if (out->e == NULL)"))
        self.one_line(made, "timoshenko", "memory that is not its own")
        self.cell(made, "crashed")

    def test_endless_recursion(self):
        made = self.example(
            ("    if (out->e == NULL)",
             "    volatile char room[99999];\n    room[0] = 1;\n"
             "    strain(d, x, out);\n    room[1] = room[0];\n    if (out->e == NULL)"))
        self.one_line(made, "timoshenko")

    def test_endless_loop(self):
        made = self.example(("    if (out->e == NULL)",
                             "    for (volatile int i = 1; i;) {}\n    if (out->e == NULL)"))
        self.one_line(made, "timoshenko", "time limit")
        self.cell(made, "time")

    def test_not_a_number(self):
        made = self.example(("out->e[0] -= d->length;", "out->e[0] = NAN;"))
        done = run("solve", *CASE, "-n", "2", "--element", made)
        self.assertEqual(done.returncode, 1, done)
        self.assertIn("no number", done.stderr)
        self.cell(made, "no number")

    def test_no_cell_has_a_solution(self):
        made = self.example(("out->e[0] -= d->length;", "out->e[0] = NAN;"))
        self.answered("converge", *CASE, "-n", "2", "--element", made, code=1)
