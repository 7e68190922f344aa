"""External formulations: the first example compared with the built-in formulations, and malicious files."""
import json
from pathlib import Path

from harness.cli.test.plugin import EXAMPLES, WARNINGS, PluginTest, compile_shared
from harness.tools.kit.program import environment, run

EXAMPLE = EXAMPLES / "timoshenko.c"
CASE = ("elastica", "-f", "timoshenko")
CRASHES = environment(ASAN_OPTIONS="handle_segv=0")  # a crash is reported as a crash, even under sanitizers


class Loaded(PluginTest):

    def example(self, *changes):
        return self.altered(EXAMPLE.name, *changes)


class Example(Loaded):

    @classmethod
    def setUpClass(cls):
        cls.object = compile_shared(EXAMPLE, cls.class_folder() / "timoshenko.so", *WARNINGS)

    def test_beside_the_others(self):
        out = self.answered("converge", "tapered_cantilever", "--element", self.object, "-f",
                            "timoshenko", "-f", "collocation", "-n", "2,4,8").stdout
        self.assertIn("timoshenko", out)
        self.assertIn("collocation", out)

    def test_differences_rank_nothing(self):
        out = self.answered("converge", "tapered_cantilever", "--element", self.object, "-f",
                            "timoshenko", "-f", "geometrically_exact").stdout
        answer = " ".join(out[out.rindex("for 1 %"):].split())
        self.assertRegex(answer, r"geometrically_exact n = \d+ .*timoshenko n = \d+ \(by differences")

    def test_named_before_it_is_loaded(self):
        self.answered("solve", "-f", "timoshenko", "elastica", "-n", "8", "--element", self.object)

    def test_gates(self):
        wrong = self.example(("c->young * c->Iy / l3", "1.01 * c->young * c->Iy / l3"))
        needed = self.folder / "needed.csv"
        out = self.answered("verify", "--element", wrong, "-f", "timoshenko", "-k",
                            "tapered_cantilever/default", "--propose-deviations", needed, code=1).stdout
        self.assertRegex(out, r"\nFAIL: \d+ verdicts? differs? from the expected")
        self.assertIn("deflection_z", needed.read_text(encoding="utf-8"))
        self.assertIn("wrong limit", needed.read_text(encoding="utf-8"))


class Kept(Loaded):

    @classmethod
    def setUpClass(cls):
        cls.object = compile_shared(EXAMPLE, cls.class_folder() / "timoshenko.so")

    def test_outputs_do_not_replace_what_is_loaded(self):
        mine = self.folder / "mine.so"
        mine.write_bytes(Path(self.object).read_bytes())
        script = self.folder / "my beam.py"
        script.write_text("there", encoding="ascii")
        link = self.folder / "link.so"
        link.symlink_to(mine)
        before = mine.read_bytes()
        small = ("verify", "-f", "beamw", "-k", "warping_torsion/default", "--element", mine)
        for option in ("-o", "--json", "--junit", "--markdown", "--propose-deviations"):
            for place in (mine, link):
                self.refused(2, (option, "which is an input"), *small, option, place)
        for verb in (("solve", "elastica", "-f", "timoshenko", "-n", "2"),
                     ("converge", "elastica", "-f", "timoshenko", "-n", "2,4"), ("element-test",)):
            self.refused(2, "which is an input", *verb, "--element", mine, "-o", mine)
        example = EXAMPLES / "timoshenko.py"
        command = f"exec:/usr/bin/python3 '{example}' '{script}'"
        self.refused(2, "which is an input", "solve", "elastica", "-f", "timoshenko_py", "-n", "2",
                     "--element", command, "-o", script)
        self.assertEqual(mine.read_bytes(), before)
        self.assertEqual(script.read_text(encoding="ascii"), "there")


class Refused(Loaded):

    def refuse(self, path, *words):
        self.refused(2, words, "solve", *CASE, "-n", "2", "--element", path)

    def test_words_of_the_command_line_are_no_names(self):
        for word in ("all", "cases", "formulations"):
            self.refuse(self.example(('"timoshenko"', f'"{word}"')), f"'{word}'", "another name")

    def test_a_file_in_the_place_of_a_name(self):
        for file in ("./mine.so", "mine.so", "exec:python3 x.py"):
            self.refused(2, f"use --element '{file}' to load", "element-test", file)

    def test_a_wrong_name_of_what_is_loaded(self):
        self.refused(2, ("unknown formulation 'min'", "--element loaded timoshenko"), "solve",
                     "elastica", "-f", "min", "--element", self.example())
        self.assertNotIn("loaded", run("solve", "elastica", "-f", "min").stderr)

    def test_no_shared_object(self):
        self.refuse(self.folder / "none.so", "none.so", "give the path of an existing shared object")
        text = self.folder / "text.so"
        text.write_text("text", encoding="ascii")
        self.refuse(text, "give the path of an existing shared object")

    def test_no_symbol(self):
        self.refuse(self.compiled("int other;"), "beamwork_element")
        self.refuse(self.compiled("void *beamwork_element_type(void)\n{\n    return 0;\n}\n"),
                    "beamwork_element_type() that returns the formulation")

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
                    "collocation already exists")

    def test_sizes_that_cannot_be(self):
        made = self.example(("return STRAINS;", "return 1000;"))
        self.refused(2, "strains is 1000; give 1 to 56", "solve", *CASE, "-n", "2", "--element", made)

    def test_strains_without_stresses(self):
        made = self.example((".stress = stress,", ""))
        self.refused(2, "'strain' or 'stress' is missing; give both", "solve", *CASE, "-n", "2", "--element", made)


class Hostile(Loaded):

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
        self.one_line(made, "timoshenko", "memory that it does not own")
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
        self.assertIn("NaN or Inf", done.stderr)
        self.cell(made, "NaN or Inf")

    def test_no_cell_has_a_solution(self):
        made = self.example(("out->e[0] -= d->length;", "out->e[0] = NAN;"))
        self.answered("converge", *CASE, "-n", "2", "--element", made, code=1)
