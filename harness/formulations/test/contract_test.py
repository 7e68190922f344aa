"""`element-test` of a formulation in another process, which answers for many elements at once."""
import json
import sys

from harness.tools.kit.program import ROOT, ProgramTest, broken, environment

EXAMPLES = ROOT / "elements" / "examples"


class ManyAtOnce(ProgramTest):
    """What the first element gives to all is told, and nothing where each has its own."""

    def test_one_value_for_all(self):
        text = (EXAMPLES / "timoshenko.py").read_text(encoding="utf-8")
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
                                env=environment(PYTHONPATH=str(EXAMPLES))).stdout
            said = broken(json.loads(out))
            self.assertEqual(len(said), code, said)
            self.assertTrue(all("many at once gives other strains than one by one: element" in s
                                and "strain 3: " in s for s in said), said)
