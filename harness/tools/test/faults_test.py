"""Faults that are made: what is edited and what never is, always the same ones."""
import pathlib
import subprocess
import tempfile
import unittest

from harness.tools import faults

SOURCE = r'''#include "a.h"
#define SIZE (3 + 4) \
    - 5
enum { FIRST = 6 };
typedef struct pair {
    double x[2 + 1];
} pair;
static const double weight[] = {-0.5, 1e-3};
/* a + b */
double sum(const double A[9], int n)
{
    double total[3] = {A[2]}, other[4], *at = other; // 1 - 2
    const char *said = "1 + 2", letter = '+';
    assert(n > 3);
    double *room = malloc(n * 8);
    memcpy(room, A, 9 * n);
    if (n > 0 && A[n] != 2.0)
        total[0] += *at * -A[n - 1] / letter;
    for (int i = 0; i < n; i++)
        n->at--;
    return total[0];
}
'''
# Line and edit.
EDITS = {
    (8, "- to none (1)"), (8, "0.5 to (2 * 0.5) (1)"), (8, "1e-3 to (2 * 1e-3) (1)"),
    (12, "2 to 1 (1)"),
    (17, "if to if not (1)"), (17, "> to >= (1)"), (17, "0 to 1 (1)"), (17, "&& to || (1)"),
    (17, "n to 0 (1)"), (17, "!= to == (1)"), (17, "2.0 to (2 * 2.0) (1)"),
    (18, "0 to 1 (1)"), (18, "+= to -= (1)"), (18, "* to / (1)"), (18, "- to none (1)"),
    (18, "- to + (2)"), (18, "/ to * (1)"),
    (19, "0 to 1 (1)"), (19, "< to <= (1)"),
    (21, "0 to 1 (1)"),
}


class Faults(unittest.TestCase):
    def test_edits(self):
        found = faults.faults(SOURCE)
        self.assertEqual({(line, edit) for line, _, _, edit, _ in found} ^ EDITS, set())
        self.assertEqual(len(found), len(EDITS))
        for line, name, text, edit, changed in found:
            self.assertEqual(text, SOURCE.split("\n")[line - 1].strip())
            self.assertNotEqual(text, changed.strip(), edit)
            self.assertEqual(name, "weight" if line < 10 else "sum")

    def test_changed_lines(self):
        changed = {(line, edit): text.strip() for line, _, _, edit, text in faults.faults(SOURCE)}
        self.assertEqual(changed[17, "if to if not (1)"], "if (!(n > 0 && A[n] != 2.0))")
        self.assertEqual(changed[17, "n to 0 (1)"], "if (n > 0 && A[0] != 2.0)")
        self.assertEqual(changed[18, "- to none (1)"], "total[0] += *at * A[n - 1] / letter;")
        self.assertEqual(changed[8, "1e-3 to (2 * 1e-3) (1)"],
                         "static const double weight[] = {-0.5, (2 * 1e-3)};")

    def test_constants(self):
        for text, index, other in (("0", False, "1"), ("3u", False, "4u"), ("0", True, "1"),
                                   ("3", True, "2"), ("0.0", False, "1.0"), ("0x1f", False, None)):
            self.assertEqual(faults.constant(text, index), other)


@unittest.skipUnless((faults.ROOT / ".git").exists(), "needs a clone")
class Sample(unittest.TestCase):
    FILES = ["elements/math/dense.c", "harness/model/division.c"]

    def setUp(self):
        for name, value in (("sources", lambda: self.FILES), ("equivalent", lambda: self.known)):
            self.addCleanup(setattr, faults, name, getattr(faults, name))
            setattr(faults, name, value)
        self.known = {}

    def test_always_the_same(self):
        few, known = faults.chosen(5)
        self.assertEqual((len(few), known), (5, 0))
        self.assertEqual(faults.chosen(5), (few, 0))
        many, _ = faults.chosen(12)
        self.assertEqual([one for one in many if one in few], few)
        self.assertEqual(len({(one[0], one[1]) for one in many}), 12)

    def test_equivalent_ones_are_left_out(self):
        few, _ = faults.chosen(5)
        self.known = {(few[0][0], *few[0][2:5]): "for a reason"}
        self.assertEqual(faults.chosen(5), (few[1:], 1))

    def test_checks_are_there(self):
        texts = faults.tests()
        found = faults.checks(self.FILES[1], texts)
        self.assertEqual(found[0], "harness/model/test/division_test")
        for one in found:
            self.assertTrue(one.startswith("verify:") or f"{one}.c" in texts or
                            one.replace(".", "/") + ".py" in texts, one)


class Touched(unittest.TestCase):
    def test_lines_of_commits(self):
        """Of a range, the lines that still stand as it wrote them."""
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            commits = []

            def git(*arguments):
                return subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@b.c",
                                       *arguments], cwd=root, check=True, capture_output=True,
                                      text=True).stdout.strip()

            git("init", "-q")
            for text in ("one\ntwo\nthree\n", "one\n2\n3\n", "zero\none\n2\nIII\n"):
                (root / "a.c").write_text(text, encoding="ascii")
                git("add", "a.c")
                git("commit", "-q", "-m", "a")
                commits.append(git("rev-parse", "HEAD"))
            self.addCleanup(setattr, faults, "ROOT", faults.ROOT)
            faults.ROOT = root
            self.assertEqual(faults.touched({commits[1]}, "a.c"), {3})
            self.assertEqual(faults.touched(set(commits[1:]), "a.c"), {1, 3, 4})
            self.assertEqual(faults.touched({commits[0]}, "a.c"), {2})


class Equivalent(unittest.TestCase):
    def test_each_has_its_place_and_reason(self):
        """A line that has changed takes its equivalent faults with it."""
        made = {}
        for (file, function, line, edit), reason in faults.equivalent().items():
            if file not in made:
                source = (faults.ROOT / file).read_text(encoding="utf-8")
                made[file] = {one[1:4] for one in faults.faults(source)}
            self.assertIn((function, line, edit), made[file], file)
            self.assertGreater(len(reason.split()), 3, (file, line, edit))


if __name__ == "__main__":
    unittest.main()
