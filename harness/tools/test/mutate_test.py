"""Generated faults: the code that is edited, the code that is never edited, and reproducibility."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

from harness.tools import mutate

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
    TRY(look(at, f));
    total_add(total, n); /* a call */
    total_free(total);
    n = total_add(total,
                  n);
    if (n == letter)
        return fault_set(f, STATUS_SINGULAR, "no");
    return total[0];
}
'''
EDITS = {
    (8, "- to none (1)"), (8, "0.5 to (2 * 0.5) (1)"), (8, "1e-3 to (2 * 1e-3) (1)"),
    (12, "2 to 1 (1)"),
    (17, "if to if not (1)"), (17, "> to >= (1)"), (17, "0 to 1 (1)"), (17, "&& to || (1)"),
    (17, "n to 0 (1)"), (17, "!= to == (1)"), (17, "2.0 to (2 * 2.0) (1)"),
    (18, "0 to 1 (1)"), (18, "+= to -= (1)"), (18, "* to / (1)"), (18, "- to none (1)"),
    (18, "- to + (2)"), (18, "/ to * (1)"),
    (19, "0 to 1 (1)"), (19, "< to <= (1)"),
    (16, "memcpy to none (1)"), (21, "TRY to none (1)"), (22, "total_add to none (1)"),
    (26, "if to if not (1)"), (26, "== to != (1)"),
    (27, "STATUS_SINGULAR to STATUS_NOT_CONVERGED (1)"),
    (28, "0 to 1 (1)"),
}


class Faults(unittest.TestCase):

    def test_edits(self):
        found = mutate.faults(SOURCE)
        self.assertEqual({(line, edit) for line, _, _, edit, _ in found} ^ EDITS, set())
        self.assertEqual(len(found), len(EDITS))
        for line, name, text, edit, changed in found:
            self.assertEqual(text, SOURCE.split("\n")[line - 1].strip())
            self.assertNotEqual(text, changed.strip(), edit)
            self.assertEqual(name, "weight" if line < 10 else "sum")

    def test_changed_lines(self):
        changed = {(line, edit): text.strip() for line, _, _, edit, text in mutate.faults(SOURCE)}
        self.assertEqual(changed[17, "if to if not (1)"], "if (!(n > 0 && A[n] != 2.0))")
        self.assertEqual(changed[17, "n to 0 (1)"], "if (n > 0 && A[0] != 2.0)")
        self.assertEqual(changed[18, "- to none (1)"], "total[0] += *at * A[n - 1] / letter;")
        self.assertEqual(changed[22, "total_add to none (1)"], "; /* a call */")
        self.assertEqual(changed[8, "1e-3 to (2 * 1e-3) (1)"],
                         "static const double weight[] = {-0.5, (2 * 1e-3)};")

    def test_at_most_sixty(self):
        told = subprocess.run([sys.executable, mutate.__file__], cwd=mutate.ROOT, check=True,
                              capture_output=True, text=True).stdout.splitlines()
        left, known = (int(told[0].split()[k]) for k in (1, 3))
        self.assertEqual((left + known, len(told)), (60, left + 1))

    def test_constants(self):
        for text, index, other in (("0", False, "1"), ("3u", False, "4u"), ("0", True, "1"),
                                   ("3", True, "2"), ("0.0", False, "1.0"), ("0x1f", False, None)):
            self.assertEqual(mutate.constant(text, index), other)


@unittest.skipUnless((mutate.ROOT / ".git").exists(), "needs a clone")
class Sample(unittest.TestCase):
    FILES = ["elements/math/dense.c", "harness/model/division.c"]

    def setUp(self):
        for name, value in (("sources", lambda: self.FILES), ("equivalent", lambda: self.known)):
            self.addCleanup(setattr, mutate, name, getattr(mutate, name))
            setattr(mutate, name, value)
        self.known = {}

    def test_always_the_same(self):
        few, known = mutate.chosen(5)
        self.assertEqual((len(few), known), (5, 0))
        self.assertEqual(mutate.chosen(5), (few, 0))
        many, _ = mutate.chosen(12)
        self.assertEqual([one for one in many if one in few], few)
        self.assertEqual(len({(one[0], one[1]) for one in many}), 12)

    def test_equivalent_ones_are_left_out(self):
        few, _ = mutate.chosen(5)
        self.known = {(few[0][0], *few[0][2:5]): "for a reason"}
        self.assertEqual(mutate.chosen(5), (few[1:], 1))

    def test_checks_are_there(self):
        texts = mutate.tests()
        found = mutate.checks(self.FILES[1], texts)
        self.assertEqual(found[0], "harness/model/test/initial_test")
        for one in found:
            self.assertTrue(one.startswith("verify:") or f"{one}.c" in texts or
                            one.replace(".", "/") + ".py" in texts, one)


class Touched(unittest.TestCase):

    def test_lines_of_commits(self):
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
            self.addCleanup(setattr, mutate, "ROOT", mutate.ROOT)
            mutate.ROOT = root
            self.assertEqual(mutate.touched({commits[1]}, "a.c"), {3})
            self.assertEqual(mutate.touched(set(commits[1:]), "a.c"), {1, 3, 4})
            self.assertEqual(mutate.touched({commits[0]}, "a.c"), {2})


class Equivalent(unittest.TestCase):

    def test_each_has_its_place_and_reason(self):
        made = {}
        for (file, function, line, edit), reason in mutate.equivalent().items():
            if file not in made:
                source = (mutate.ROOT / file).read_text(encoding="utf-8")
                made[file] = {one[1:4] for one in mutate.faults(source)}
            self.assertIn((function, line, edit), made[file], file)
            self.assertGreater(len(reason.split()), 3, (file, line, edit))


if __name__ == "__main__":
    unittest.main()
