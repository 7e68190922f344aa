"""Formulations in Octave, in another process: the example beside the same one in C, what else its
module offers, and the mistakes of authors."""
import shutil
import unittest

from harness.cli.test.plugin import EXAMPLES
from harness.formulations.test.beside_c import BesideC
from harness.tools.kit.program import ProgramTest, run

EXAMPLE = EXAMPLES / "timoshenko.m"
NAME = "timoshenko_m"
# Some of the cases of process_test.py: 4 s of the processor, where all ten take 28 s.
CASES = ("tapered_cantilever", "deep_beam", "sprung_beam", "bend_45")
HERE = "addpath(fileparts(mfilename('fullpath')));"


def command(script):
    return f"exec:octave-cli -qf '{script}'"


@unittest.skipUnless(shutil.which("octave-cli"), "needs octave-cli")
class OctaveTest(ProgramTest):

    def altered(self, *changes):
        """The example with parts of its text replaced, each of which must be there."""
        text = EXAMPLE.read_text(encoding="utf-8")
        for before, after in ((HERE, f"addpath('{EXAMPLES}');"), *changes):
            self.assertIn(before, text)
            text = text.replace(before, after)
        script = self.folder / "mine.m"
        script.write_text(text, encoding="utf-8")
        return command(script)


class Example(OctaveTest, BesideC):

    def test_short(self):
        self.assertLessEqual(len(EXAMPLE.read_text("utf-8").splitlines()), 70)

    def test_judged_like_the_others(self):
        """The verdicts of the same beam in C, and its limits."""
        self.assertEqual(self.like_timoshenko(command(EXAMPLE), NAME, CASES), set(CASES))

    def test_keeps_the_contract(self):
        """Its derivatives, in the rotation chart, are those of its strains; and all else."""
        self.answered("element-test", "--element", command(EXAMPLE))

    def test_from_an_empty_folder(self):
        """The module is found beside the script."""
        done = self.answered("converge", "elastica", "-f", NAME, "--element", command(EXAMPLE),
                             cwd=self.folder)
        text = " ".join(done.stdout.split())
        self.assertIn("converges to the truth, order 2", text)
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
    """What an author may give, on the same beam."""

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
        """In place of a constant stiffness; what prepare keeps in its kind is there."""
        element = self.altered(*KEPT, ("@strain,", "@strain, 'stress', @stress,"))
        self.same(element, 1e-10)
        self.same(element, 1e-10, "tapered_cantilever")  # of several kinds

    def test_energy(self):
        """Of whole elements, all else differences."""
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
    """Each is one line that names the formulation and has Octave's own message."""

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
        self.told(2, ["'limitz' of its first line"], ("'limits'", "'limitz'"))

    def test_printed(self):
        """What is printed while it answers is seen, and harms nothing."""
        done = self.answered("solve", "elastica", "-f", NAME, "-n", "2", "--element",
                             self.altered(("c = cos(angle / 2);", "1 + 1\nc = cos(angle / 2);")))
        self.assertIn("ans = 2", done.stderr)
        self.assertNotIn("ans", done.stdout)

    def test_printed_before(self):
        """Before beamwork_element is called nothing can hold it back: it is named."""
        self.told(2, ["began with 'x = 3', which is no line of JSON"], ("1;", "x = 3"))

    def test_ends(self):
        self.told(1, [f"formulation {NAME}: its process ended with status 3"],
                  ("c = cos(", "exit(3);\nc = cos("))

    def test_does_not_begin(self):
        """Octave's message stands on standard error, before the line of beamwork."""
        done = run("list", "--element", self.altered(("c = cos(angle / 2)", "c = (")))
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"error: .*mine\.m")
        self.assertIn("ended with status 1 before its first line", done.stderr.splitlines()[-1])
