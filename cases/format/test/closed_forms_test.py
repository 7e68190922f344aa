"""Scenes as a new user writes them, without a word on physics, against closed forms.

Each file of cases/textbook says in its first lines what it is and what is right, and carries
the right values as its truths. What solve chooses, and formulations with all physics, must have
them; a value that is not right may never come with status ok.
"""
import pathlib
import unittest

from harness.tools.kit.program import ROOT, ProgramTest

SCENES = sorted((ROOT / "cases" / "textbook").glob("*.yaml"))
# Of a value, relative, on the mesh that solve chooses by itself.
CLOSE = 2e-3

# Scenes whose elements of this formulation are too long for the force in them, however many: it
# fails by name, and no value is shown.
REFUSED = {"rotating_string": "geometrically_exact"}


def wrong(solution):
    """What differs from its truth, or has none although one is known."""
    found = []
    for row in solution["quantities"]:
        for truth in row["truths"][:1]:
            right, uncertainty = truth["truth"], truth["truth_uncertainty"]
            if row["status"] != "ok" or row["value"] is None:
                found.append(f"{row['quantity']}: no value: {row['reason']}")
            elif abs(row["value"] - right) > CLOSE * abs(right) + uncertainty + 1e-12:
                found.append(f"{row['quantity']}: {row['value']} instead of {right}")
    return found


class ClosedFormsTest(ProgramTest):
    """One test a scene."""

    def holds(self, path, *options):
        """The scene has its right values with these options."""
        solution = self.record("solve", "--scene", path, *options)
        self.assertEqual(solution["cell"]["status"], "ok", solution["cell"]["reason"])
        self.assertEqual(wrong(solution), [], path.name)

    def test_that_there_are_enough(self):
        """Thirty scenes; each has a truth, or is known to have no value."""
        self.assertGreaterEqual(len(SCENES), 30)


def add(path):
    """The scene's tests into the class."""
    def chosen(self):
        self.holds(path)

    def exact(self):
        if path.stem in REFUSED:
            done = self.answered("solve", "--scene", path, "-f", REFUSED[path.stem], "-n", "32",
                                 code=1)
            self.assertNotEqual(done.stderr, "")
        else:
            self.holds(path, "-f", "geometrically_exact", "-n", "32")

    chosen.__doc__ = f"{path.stem}: with what solve chooses"
    exact.__doc__ = f"{path.stem}: geometrically_exact with 32 elements"
    setattr(ClosedFormsTest, f"test_{path.stem}_chosen", chosen)
    setattr(ClosedFormsTest, f"test_{path.stem}_exact", exact)


for scene in SCENES:
    add(pathlib.Path(scene))

if __name__ == "__main__":
    unittest.main()
