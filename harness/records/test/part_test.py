"""compare of a part: what a run was not asked for is counted, what it was asked for and lost is
gone."""
import h5py
import numpy

from harness.records.test.stored import altered, replace, table_of, verify
from harness.tools.kit.program import ROOT, ProgramTest, run

CASE = "warping_torsion"
SCENE = ROOT / "cases" / "examples" / "euler_column.yaml"


def without(file, formulation):
    """Takes a formulation out of the case."""
    for name in ("cells", "quantities", "verdicts"):
        rows = file[f"cases/{CASE}/{name}"][()]
        kept = rows[rows["formulation"] != formulation.encode()]
        assert len(kept) < len(rows), name
        replace(file[f"cases/{CASE}"], name, kept)


def is_new(file, formulation, value):
    rows = file["declarations"][()]
    rows["is_new"][rows["formulation"] == formulation.encode()] = value
    file["declarations"][...] = rows


class Part(ProgramTest):

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        cls.whole, cls.table = folder / "whole.h5", folder / "whole.csv"
        verify(f"{CASE}/default or elastica/default or c_column/default", cls.whole)
        with h5py.File(cls.whole) as file:  # as a run of all that there is
            cls.series = sum(len({(r["point"], r["formulation"]) for r in group["cells"][()]})
                             for group in file["cases"].values())
        cls.whole = altered(cls.whole, folder / "all.h5", lambda f: f.attrs.pop("selection"))
        table_of(cls.whole, cls.table)

    def compared(self, new, code, *words, old=None):
        """Against the whole run and its short table, in both directions."""
        for before in [old] if old else [self.whole, self.table]:
            for pair in ((before, new), (new, before)):
                done = run("compare", *pair)
                self.assertEqual(done.returncode, code, (pair, done.stdout, done.stderr))
                for word in words:
                    self.assertIn(word, done.stdout)

    def outside(self, new, left):
        self.compared(new, 0, " 0 worse, 0 better, 0 changed, 0 gone, 0 new",
                      f"{left} series of ", f" outside the selection of {new}")

    def test_a_case(self):
        new = verify(f"{CASE}/default", self.folder / "n.h5")
        with h5py.File(new) as file:
            self.assertEqual(file.attrs["selection"], f"{CASE}/default".encode())
            own = len({r["formulation"] for r in file[f"cases/{CASE}/cells"][()]})
        self.outside(new, self.series - own)

    def test_formulations(self):
        new = self.folder / "n.h5"
        self.answered("verify", "-k", f"{CASE}/default", "-f", "beamw", "-f", "collocation", "-o",
                      new)
        self.outside(new, self.series - 2)

    def test_options_that_only_one_was_asked_for(self):
        new = self.folder / "n.h5"
        self.answered("verify", "-k", "elastica/default", "-f", "collocation:stages=4", "-f",
                      "collocation", "-o", new)
        self.compared(new, 0, f"2 series of {new} are outside the selection of ")

    def test_a_scene(self):
        """A run of one scene against one of all cases and the scene."""
        old, new = self.folder / "o.h5", self.folder / "n.h5"
        self.answered("verify", "--built-in", "--scene", SCENE, "-o", old, "-k",
                      "euler_column or elastica/default")
        self.answered("verify", "--scene", SCENE, "-o", new)
        self.compared(new, 0, "outside the selection of", old=altered(
            old, self.folder / "all.h5", lambda f: f.attrs.pop("selection")))

    def test_quantities(self):
        """Limits of what is selected are compared, those of the rest are not missed."""
        new = verify("c_column/default and buckling_load", self.folder / "n.h5")
        self.compared(new, 0, " 0 gone, 0 new")
        done = self.answered("compare", self.table, new)
        self.assertIn("compared by limits only", done.stdout)

        def other(file):
            rows = file["cases/c_column/verdicts"][()]
            own = (rows["formulation"] == b"beamw") & (rows["quantity"] == b"buckling_load")
            self.assertEqual(own.sum(), 1)
            rows["limit"][own] *= 1.001
            file["cases/c_column/verdicts"][...] = rows

        changed = altered(new, self.folder / "c.h5", other)
        done = self.answered("compare", self.table, changed, code=1)
        self.assertIn("changed  c_column/default/beamw: limit of buckling_load", done.stdout)

    def test_a_lost_series_inside_is_gone(self):
        for select, options in ((f"{CASE}/default", ()), (f"{CASE}/default", ("-f", "beamw", "-f",
                                                                              "collocation"))):
            new = verify(select, self.folder / "n.h5", *options)
            lost = altered(new, self.folder / "l.h5", lambda file: without(file, "beamw"))
            for old in (self.whole, self.table):
                done = self.answered("compare", old, lost, code=1)
                self.assertIn(f"gone     {CASE}/default/beamw", done.stdout)

    def test_new_formulations_are_told(self):
        """One that is in one run only is a change, unless it is new."""
        old = altered(self.whole, self.folder / "o.h5", lambda file: without(file, "beamw"))
        for new in (False, True):
            run_of = altered(self.whole, self.folder / "n.h5",
                             lambda file, new=new: is_new(file, "beamw", new))
            done = self.answered("compare", old, run_of, code=0 if new else 1)
            self.assertEqual("do not affect the exit status, is in" in done.stdout, new, done.stdout)
            self.assertEqual(f"new      {CASE}/default/beamw" in done.stdout, not new)

    def test_a_selection_that_cannot_be(self):
        bad = altered(self.whole, self.folder / "n.h5",
                      lambda f: f.attrs.create("selection", numpy.bytes_("(elastica")))
        done = self.answered("compare", self.whole, bad, code=2)
        self.assertIn("selection is missing or damaged", done.stderr)
