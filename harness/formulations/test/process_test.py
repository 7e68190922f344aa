"""Formulations in Python and Octave that run in another process. The examples must have the verdicts of
timoshenko.c, every mistake must be reported in one line, and many elements evaluated at once must give the values
of single evaluations."""
import json
import os
import pathlib
import shutil
import sys
import unittest

from harness.cli.test.plugin import EXAMPLES as OCTAVE_EXAMPLES
from harness.formulations.test.beside_c import BesideC
from harness.tools.kit.program import PROGRAM, ProgramTest, ROOT, broken, environment, run


EXAMPLES = ROOT / "elements" / "examples"
PYTHON = f"exec:'{sys.executable}' '{EXAMPLES / 'timoshenko.py'}'"
CASES = ("tapered_cantilever", "deep_beam", "weighted_column", "tip_body", "sprung_beam",
         "loaded_cantilever", "bend_45", "elastica", "snap_through", "right_angle_frame")


ENERGY = """
import numpy as np
from beamwork_element import Refused, serve

def prepare(kind):  # a chord that stretches, and turns of its ends against it
    if kind.options["law"] != "linear":
        raise Refused(f"law {kind.options['law']}, times {kind.options['times']:g}")
    c = kind.section
    kind.stretch, kind.twist = c.young * c.A, c.shear_modulus * c.It
    kind.bending = c.young * kind.options["times"] * np.array([c.Iy, c.Iz])

def force(kind, r, _u, R, _a):
    l, chord = kind.length, r[:, 1] - r[:, 0]
    now = np.linalg.norm(chord, axis=1)
    to = [np.einsum("ni,nkia->nka", chord / now[:, None], R)[..., k] for k in (1, 2)]
    turned = np.einsum("nia,nib->nab", R[:, 0], R[:, 1])
    energy = kind.stretch / l * (now - l)**2 / 2
    energy += kind.twist / l * ((turned[:, 2, 1] - turned[:, 1, 2]) / 2)**2 / 2
    for EI, t in zip(kind.bending, to[::-1]):
        energy += 2 * EI / l * (t[:, 0]**2 + t[:, 0] * t[:, 1] + t[:, 1]**2)
    return energy, None, None

serve(prepare, force=force, gives="energy", name="chord", family="example", source="this test",
      summary="an energy alone", offers=["large rotations", "geometric", "mass"],
      options=[dict(name="times", default=1, min=0.5, max=2, unit="1", summary="of E I"),
               dict(name="law", choices=["linear", "other"], default="linear", summary="which")])
"""


class Energy(ProgramTest):
    def solve(self, *words, formulation="chord", code=0):
        path = self.folder / "chord.py"
        path.write_text(ENERGY, encoding="utf-8")
        return self.answered("solve", "elastica", "--element", f"exec:'{sys.executable}' '{path}'",
                             "-f", formulation, "-n", "8", *words, code=code,
                             env={**os.environ, "PYTHONPATH": str(EXAMPLES)})

    def value(self, formulation):
        told = json.loads(self.solve("--format", "json", formulation=formulation).stdout)
        return {q["quantity"]: q["value"] for q in told["quantities"]}["w_over_L"]

    def test_solves(self):
        self.assertAlmostEqual(self.value("chord"), 0.30172, delta=1e-3)

    def test_options(self):
        self.assertLess(self.value("chord:times=2"), 0.6 * self.value("chord"))
        done = self.solve(formulation="chord:law=other,times=1.5", code=2)
        self.assertIn("chord: law other, times 1.5", done.stderr)

    def test_times_are_told(self):
        self.assertIn("in all run times: that of the process", " ".join(self.solve().stdout.split()))


class Example(BesideC):

    def test_short(self):
        self.assertLessEqual(len((EXAMPLES / "timoshenko.py").read_text("utf-8").splitlines()), 60)

    def test_judged_like_the_others(self):
        passed = self.like_timoshenko(PYTHON, "timoshenko_py", CASES)
        self.assertEqual(passed - {"shear_elastica"}, set(CASES))

    def test_ranks_nothing(self):
        out = self.answered("converge", "tapered_cantilever", "--element", PYTHON, "-f",
                            "timoshenko_py", "-f", "geometrically_exact").stdout
        answer = " ".join(out[out.rindex("for 1 %"):].split())
        self.assertRegex(answer,
                         r"geometrically_exact n = \d+ .*timoshenko_py n = \d+ \(in another proc")

    def test_every_verb(self):
        out = self.answered("list", "timoshenko_py", "--element", PYTHON).stdout
        self.assertIn("Reissner", out)
        for verb in (("solve", "-n", "2"), ("bench", "-n", "2"), ("converge", "-j", "2")):
            out = self.answered(verb[0], "elastica", "--element", PYTHON, "-f", "timoshenko_py",
                                *verb[1:]).stdout
            self.assertIn("timoshenko_py", out)


class InPython(ProgramTest):

    def example(self, before, after):
        text = (ROOT / "elements/examples/timoshenko.py").read_text(encoding="utf-8")
        self.assertIn(before, text)
        path = self.folder / "mine.py"
        path.write_text(text.replace(before, after, 1), encoding="utf-8")
        return f"exec:'{sys.executable}' '{path}'"

    def solve(self, element):
        path = str(ROOT / "elements" / "examples")
        return run("solve", "elastica", "-f", "timoshenko_py", "-n", "2", "--element", element,
                   env={**os.environ, "PYTHONPATH": path})

    def test_exception(self):
        done = self.solve(self.example("chord = (", "chord = 1 / 0 + ("))
        self.assertEqual(done.returncode, 1, done)
        self.assertRegex(done.stderr,
                         r"^beamwork: .*timoshenko_py: ZeroDivisionError: .*mine.py:\d+")
        self.assertEqual(len(done.stderr.splitlines()), 1)

    def test_refusal(self):
        done = self.solve(self.example("    c, l = kind",
                                       "    from beamwork_element import Refused\n"
                                       "    raise Refused('only steel')\n    c, l = kind"))
        self.assertEqual(done.returncode, 2, done)
        self.assertIn("timoshenko_py: only steel\n", done.stderr)

    def test_print(self):
        done = self.solve(self.example("    chord = (", "    print('hello')\n    chord = ("))
        self.assertEqual(done.returncode, 0, done)
        self.assertIn("hello", done.stderr)

    def told(self, before, after, *words, code=1):
        done = self.solve(self.example(before, after))
        self.assertEqual(done.returncode, code, done)
        for word in words:
            self.assertIn(word, done.stderr)
        return done

    def test_wrong_shapes(self):
        back = "return np.hstack([e - [kind.length, 0, 0], kind.length * psi])"
        due = "strains=6 wants (N, 6)"
        for after, words in ((f"{back}[:, :5]", ("strain returned (N, 5)", due)),
                             (f"{back}.T", ("strain returned (6, ", due)),
                             (f"{back}[0]", ("strain returned (6)", due)),
                             ("return 0.0", ("strain returned one number", due)),
                             (f"{back}[:1]", ("strain returned (1, 6)", due)),
                             ("return None", ("strain returned None",)),
                             ("return 'long'", ("strain returned numbers of type <U4",)),
                             ("return [[1], [1, 2]]", ("strain: an array is expected",)),
                             (f"{back} + 0j", ("complex128", "real numbers are expected for real states"))):
            done = self.told(back, after, "timoshenko_py: ", *words)
            self.assertNotIn(".py:", done.stderr)
        self.told("strains=6", "strains=5", "prepare returned (6, 6), strains=5 wants (5, 5)",
                  code=2)

    def stress(self, back):
        text = (ROOT / "elements/examples/timoshenko.py").read_text(encoding="utf-8")
        text = text.replace("    return np.diag(", "    kind.C = np.diag(").replace(
            "if __name__", f"def stress(kind, e):\n"
            f"    s = e @ kind.C\n    w = (s * e).sum(1) / 2\n    {back}\n\n\n"
            "if __name__").replace("serve(prepare, strain,", "serve(prepare, strain, stress,")
        (self.folder / "mine.py").write_text(text, encoding="utf-8")
        return self.solve(f"exec:'{sys.executable}' '{self.folder / 'mine.py'}'")

    def test_wrong_stresses(self):
        right = "np.broadcast_to(kind.C, (len(e), 6, 6))"
        self.assertEqual(self.stress(f"return w, s, {right}").returncode, 0)
        for back, words in ((f"return w.sum(), s, {right}", "for energy, returned one number"),
                            (f"return w[:, None], s, {right}", "for energy, returned (N, 1)"),
                            (f"return w, s[:1], {right}", "for sigma, returned (1, 6)"),
                            ("return w, s, kind.C", "for C, returned (6, 6)"),
                            ("return w", "stress must return three values: energy, sigma, C")):
            done = self.stress(back)
            self.assertEqual(done.returncode, 1, done)
            self.assertIn(words, done.stderr)

    def test_ends_itself(self):
        self.told("    chord = (", "    raise SystemExit('enough')\n    chord = (",
                  "SystemExit: enough (mine.py:")

    def test_a_word_that_is_none(self):
        self.told("strains=6", "strain=6", "strain=6 is no function; give a function that returns it",
                  code=2)
        self.told("summary=", "sumary=", "is no key, did you mean summary?", code=2)
        self.told('offers=["shear"', 'offers=["sheer"', "'sheer'", "trapeze, wagner moments",
                  code=2)

    def test_not_analytic(self):
        self.told("np.sqrt((psi * psi).sum(1))", "np.linalg.norm(psi, axis=1)",
                  "strain is not analytic", "gives='e'")

    def test_no_words_of_numpy(self):
        element = self.example("chord = (", "np.float64(0) / np.zeros(1)\n    chord = (")
        done = self.solve(element)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done)

    def contract(self, before, after):
        path = str(ROOT / "elements" / "examples")
        done = run("element-test", "timoshenko_py", "--element", self.example(before, after),
                   env={**os.environ, "PYTHONPATH": path})
        self.assertEqual(done.returncode, 1, done)
        return " ".join(done.stdout.partition("measured:")[0].split())

    def test_one_cause_in_the_contract(self):
        out = self.contract("chord = (", "chord = 1 / 0 + (")
        self.assertRegex(out, r"derivatives of the strains \(1 compared\) ✘ formulation "
                              r"timoshenko_py: ZeroDivisionError: division by zero "
                              r"\(mine.py:\d+\); the other requirements are not checked")
        self.assertNotIn("nan", out)
        self.assertNotIn("crashed", out)

    def test_fails_for_some(self):
        out = self.contract(
            "    chord = (", "    longer = prepare.__dict__.setdefault('longer', set())\n"
            "    if kind.length > 0.4:\n        longer.add(id(kind))\n"
            "    if kind.length > 0.4 and len(longer) > 1:\n        raise ValueError('too long')\n"
            "    chord = (")
        self.assertIn("an accepted element is rejected when it is prepared again (formulation timoshenko_py: ValueError: too "
                      "long (mine.py:", out)
        self.assertNotIn("crashed", out)

    def test_finds_the_module(self):
        if pathlib.Path(PROGRAM).resolve().parents[1] != ROOT:
            self.skipTest("needs the program of build/, whose examples it is about")
        element = self.example("strains=6", "strains=6")
        for given in ({}, {"PYTHONPATH": ""}, {"PYTHONPATH": "/no/such"}):
            clean = {name: v for name, v in os.environ.items() if name != "PYTHONPATH"}
            done = run("solve", "elastica", "-f", "timoshenko_py", "-n", "2", "--element", element,
                       cwd=self.folder, env={**clean, **given})
            self.assertEqual(done.returncode, 0, done)


EXAMPLE = OCTAVE_EXAMPLES / "timoshenko.m"
NAME = "timoshenko_m"
OCTAVE_CASES = ("tapered_cantilever", "deep_beam", "sprung_beam", "bend_45")
HERE = "addpath(fileparts(mfilename('fullpath')));"


def command(script):
    return f"exec:octave-cli -qf '{script}'"


@unittest.skipUnless(shutil.which("octave-cli"), "needs octave-cli")
class OctaveTest(ProgramTest):

    def altered(self, *changes):
        text = EXAMPLE.read_text(encoding="utf-8")
        for before, after in ((HERE, f"addpath('{OCTAVE_EXAMPLES}');"), *changes):
            self.assertIn(before, text)
            text = text.replace(before, after)
        script = self.folder / "mine.m"
        script.write_text(text, encoding="utf-8")
        return command(script)


class OctaveExample(OctaveTest, BesideC):

    def test_short(self):
        self.assertLessEqual(len(EXAMPLE.read_text("utf-8").splitlines()), 70)

    def test_judged_like_the_others(self):
        self.assertEqual(self.like_timoshenko(command(EXAMPLE), NAME, OCTAVE_CASES), set(OCTAVE_CASES))

    def test_keeps_the_contract(self):
        self.answered("element-test", "--element", command(EXAMPLE))

    def test_from_an_empty_folder(self):
        done = self.answered("converge", "elastica", "-f", NAME, "--element", command(EXAMPLE),
                             cwd=self.folder)
        text = " ".join(done.stdout.split())
        self.assertIn("converges to the reference value, order 2", text)
        self.assertIn(f"{NAME} n = 8 (in another process: no rank)", text)
        self.assertEqual(done.stderr, "")


STRESS = """
function [energy, sigma, C] = stress(kind, e)
sigma = kind.stiffness * e;
energy = sum(sigma .* e, 1) / 2;
C = repmat(kind.stiffness, 1, 1, size(e, 2));
end

function [energy, F, K] = force(kind, r, u, R, a)
energy = stress(kind, strain(kind, r, u, R, a));
end
"""
KEPT = (("function C = prepare", "function [C, kind] = prepare"),
        ("Iz / l^3]);\nend", "Iz / l^3]);\nkind.stiffness = full(C);\nC = [];\nend\n" + STRESS))
OPTIONS = """'options', {
    struct('name', 'points', 'default', 1, 'min', 1, 'max', 5, 'unit', '1', 'summary', 'of it'), ...
    struct('name', 'rule', 'choices', {{'gauss', 'lobatto'}}, 'default', 'gauss', ...
           'summary', 'of points')}, 'strains'"""


class Module(OctaveTest):
    def values(self, case, element):
        record = self.record("solve", case, "-f", NAME, "-n", "2", "--element", element)
        return {q["quantity"]: q["value"] for q in record["quantities"]}

    def same(self, element, tolerance, case="bend_45"):
        expected, found = self.values(case, command(EXAMPLE)), self.values(case, element)
        self.assertEqual(expected.keys(), found.keys())
        for quantity, value in expected.items():
            self.assertAlmostEqual(found[quantity] / value, 1, delta=tolerance, msg=quantity)

    def test_derivatives_left_to_differences(self):
        self.same(self.altered(("'strains', 6", "'strains', 6, 'gives', 'e'")), 1e-7)

    def test_first_derivatives_alone(self):
        self.same(self.altered(("'strains', 6", "'strains', 6, 'gives', 'e,J'")), 1e-7)

    def test_stresses(self):
        element = self.altered(*KEPT, ("@strain,", "@strain, 'stress', @stress,"))
        self.same(element, 1e-10)
        self.same(element, 1e-10, "tapered_cantilever")

    def test_energy(self):
        self.same(self.altered(*KEPT, ("'strain', @strain, 'strains', 6,",
                                       "'force', @force, 'gives', 'energy',")), 1e-5)

    def test_options(self):
        script = self.altered(
            ("'strains'", OPTIONS),
            ("l = kind.length;\n", "l = kind.length;\nerror('beamwork:refused', '%d by %s', "
             "kind.options.points, kind.options.rule);\n"))
        self.refused(2, [f"formulation {NAME}: 3 by lobatto"], "solve", "elastica", "-f",
                     f"{NAME}:points=3,rule=lobatto", "-n", "2", "--element", script)


class Mistakes(OctaveTest):

    def told(self, code, words, *changes):
        self.refused(code, words, "solve", "elastica", "-f", NAME, "-n", "2", "--element",
                     self.altered(*changes), silent=code != 1)

    def test_undefined(self):
        self.told(1, [f"formulation {NAME}: 'kosine' undefined (strain, line "],
                  ("c = cos(", "c = kosine("))
        self.told(2, [f"formulation {NAME}: 'kosine' undefined (prepare, line "],
                  ("l = kind.length;", "l = kosine(1);"))

    def test_error(self):
        self.told(1, [f"formulation {NAME}: no beams on two lines (strain, line "],
                  ("c = cos(", "error(\"no beams on\\ntwo lines\");\nc = cos("))

    def test_refused(self):
        self.told(1, [f"formulation {NAME}: short beams only\n"],
                  ("c = cos(", "error('beamwork:refused', 'short beams only');\nc = cos("))

    def test_sizes(self):
        self.told(1, [NAME, "strain returns an array of size [5 2] where [6 2] is due"],
                  ("kind.length * psi]", "kind.length * psi(1:2, :)]"))
        self.told(2, [NAME, "prepare returns an array of size [7 7] where [6 6] is due"],
                  ("C = diag([", "C = diag([1, "))

    def test_complex_strains(self):
        self.told(1, [NAME, "complex numbers where real ones are due"],
                  ("c = cos(angle / 2);", "c = cos(angle / 2) + 1i;"))

    def test_no_number(self):
        self.told(1, ["NaN or Inf"], ("c = cos(", "c = NaN * cos("))

    def test_unknown_word(self):
        self.told(2, ["key 'limitz' of its first line"], ("'limits'", "'limitz'"))

    def test_printed(self):
        done = self.answered("solve", "elastica", "-f", NAME, "-n", "2", "--element",
                             self.altered(("c = cos(angle / 2);", "1 + 1\nc = cos(angle / 2);")))
        self.assertIn("ans = 2", done.stderr)
        self.assertNotIn("ans", done.stdout)

    def test_printed_before(self):
        self.told(2, ["began with 'x = 3' instead of a line of JSON"], ("1;", "x = 3"))

    def test_ends(self):
        self.told(1, [f"formulation {NAME}: its process ended with status 3"],
                  ("c = cos(", "exit(3);\nc = cos("))

    def test_does_not_begin(self):
        done = run("list", "--element", self.altered(("c = cos(angle / 2)", "c = (")))
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"error: .*mine\.m")
        self.assertIn("ended with status 1 before its first line", done.stderr.splitlines()[-1])


CONTRACT_EXAMPLES = ROOT / "elements" / "examples"


class ManyAtOnce(ProgramTest):
    def test_one_value_for_all(self):
        text = (CONTRACT_EXAMPLES / "timoshenko.py").read_text(encoding="utf-8")
        result = "    return np.hstack([e - [kind.length, 0, 0], kind.length * psi])"
        self.assertIn(result, text)
        one = "    e = np.hstack([e - [kind.length, 0, 0], kind.length * psi])\n"
        for end, code in (("    return e", 0),
                          ("    e[:, 2] = e[0, 2] if len(e) < 9 else e[:, 2]\n"
                           "    return e", 1)):
            (self.folder / "mine.py").write_text(text.replace(result, one + end),
                                                 encoding="utf-8")
            out = self.answered("element-test", "--element",
                                f"exec:'{sys.executable}' '{self.folder / 'mine.py'}'",
                                "--format", "json", code=code,
                                env=environment(PYTHONPATH=str(CONTRACT_EXAMPLES))).stdout
            said = broken(json.loads(out))
            self.assertEqual(len(said), code, said)
            self.assertTrue(all("many at once: the strains differ from those of single evaluations (element" in s
                                and "strain 3: " in s for s in said), said)
