"""What the Python module for authors makes of mistakes: a sentence each."""
import os
import pathlib
import sys

from harness.tools.kit.program import PROGRAM, ROOT, ProgramTest, run


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
        """It is seen, and harms nothing."""
        done = self.solve(self.example("    chord = (", "    print('hello')\n    chord = ("))
        self.assertEqual(done.returncode, 0, done)
        self.assertIn("hello", done.stderr)

    def told(self, before, after, *words, code=1):
        """The example with that change fails and says so."""
        done = self.solve(self.example(before, after))
        self.assertEqual(done.returncode, code, done)
        for word in words:
            self.assertIn(word, done.stderr)
        return done

    def test_wrong_shapes(self):
        """A sentence with both shapes, and no line of the module or of numpy."""
        back = "return np.hstack([e - [kind.length, 0, 0], kind.length * psi])"
        due = "strains=6 wants (N, 6)"
        for after, words in ((f"{back}[:, :5]", ("strain returned (N, 5)", due)),
                             (f"{back}.T", ("strain returned (6, ", due)),
                             (f"{back}[0]", ("strain returned (6)", due)),
                             ("return 0.0", ("strain returned one number", due)),
                             (f"{back}[:1]", ("strain returned (1, 6)", due)),
                             ("return None", ("strain returned None",)),
                             ("return 'long'", ("strain returned numbers of type <U4",)),
                             ("return [[1], [1, 2]]", ("strain: an array is due",)),
                             (f"{back} + 0j", ("complex128", "real numbers of real states"))):
            done = self.told(back, after, "timoshenko_py: ", *words)
            self.assertNotIn(".py:", done.stderr)
        self.told("strains=6", "strains=5", "prepare returned (6, 6), strains=5 wants (5, 5)",
                  code=2)

    def stress(self, back):
        """What is told of the example with this stress in place of a constant stiffness."""
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
                            ("return w", "stress must return three: energy, sigma, C")):
            done = self.stress(back)
            self.assertEqual(done.returncode, 1, done)
            self.assertIn(words, done.stderr)

    def test_ends_itself(self):
        self.told("    chord = (", "    raise SystemExit('enough')\n    chord = (",
                  "SystemExit: enough (mine.py:")

    def test_a_word_that_is_none(self):
        self.told("strains=6", "strain=6", "strain=6 is no function, did you mean strains?",
                  code=2)
        self.told("summary=", "sumary=", "is no key, did you mean summary?", code=2)
        self.told('offers=["shear"', 'offers=["sheer"', "'sheer'", "trapeze, wagner moments",
                  code=2)

    def test_not_analytic(self):
        """Also where value and derivative are right in the undeformed state."""
        self.told("np.sqrt((psi * psi).sum(1))", "np.linalg.norm(psi, axis=1)",
                  "strain is not analytic", "gives='e'")

    def test_no_words_of_numpy(self):
        """States that are no numbers are asked too; what comes of them is no warning."""
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
        """What fails always is told as the cause of each family, and as nothing else."""
        out = self.contract("chord = (", "chord = 1 / 0 + (")
        self.assertRegex(out, r"derivatives of the strains \(1 compared\) ✘ formulation "
                              r"timoshenko_py: ZeroDivisionError: division by zero "
                              r"\(mine.py:\d+\); the rest is not checked")
        self.assertNotIn("nan", out)
        self.assertNotIn("crashed", out)

    def test_fails_for_some(self):
        """An element that cannot be made again is told; what stood there before is used."""
        out = self.contract(
            "    chord = (", "    longer = prepare.__dict__.setdefault('longer', set())\n"
            "    if kind.length > 0.4:\n        longer.add(id(kind))\n"
            "    if kind.length > 0.4 and len(longer) > 1:\n        raise ValueError('too long')\n"
            "    chord = (")
        self.assertIn("refused when it is made again: formulation timoshenko_py: ValueError: too "
                      "long (mine.py:", out)
        self.assertNotIn("crashed", out)

    def test_finds_the_module(self):
        """From an empty folder, also behind a PYTHONPATH of the user's."""
        if pathlib.Path(PROGRAM).resolve().parents[1] != ROOT:
            self.skipTest("needs the program of build/, whose examples it is about")
        element = self.example("strains=6", "strains=6")
        for given in ({}, {"PYTHONPATH": ""}, {"PYTHONPATH": "/no/such"}):
            clean = {name: v for name, v in os.environ.items() if name != "PYTHONPATH"}
            done = run("solve", "elastica", "-f", "timoshenko_py", "-n", "2", "--element", element,
                       cwd=self.folder, env={**clean, **given})
            self.assertEqual(done.returncode, 0, done)
