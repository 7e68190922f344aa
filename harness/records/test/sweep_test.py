"""Results of sweeps and of partial runs, and the hash of a run."""
import h5py
import numpy

from harness.records.test import stored
from harness.records.test.stored import altered, group_of, replace, table_of, verify
from harness.tools.kit.program import PROGRAM, ProgramTest, ROOT, run


LEAF = ROOT / "cases" / "examples" / "leaf_spring_guide.yaml"
SAME = "0 worse, 0 better, 0 changed, 0 gone, 0 new"
OPTIONS = ("-f", "beamw", "-f", "sheet_third", "-n", "1,2,4")


def sweep(path, *what):
    done = run("sweep", *what, "-o", path)
    assert done.returncode == 0, done.stderr
    return path


def altered_sweep(old, new, change):
    return stored.altered(old, new, lambda file: change(file["experiments/sweep"]))


class Sweeps(ProgramTest):

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        cls.old, cls.new = folder / "old.h5", folder / "new.h5"
        sweep(cls.old, "elastica", "--vary", "load=0.5..2/3", *OPTIONS)

    def compared(self, code, new, *options, old=None):
        done = self.answered("compare", old or self.old, new, *options, code=code)
        *lines, pairs, cost = done.stdout.splitlines()
        self.assertIn(" runs in both: ", pairs)
        self.assertTrue(cost.startswith("cost: "), cost)
        return lines, pairs

    def check(self, change, lines, *options):
        new = altered_sweep(self.old, self.new, change)
        self.assertEqual(self.compared(int(bool(lines)), new, *options)[0], lines)
        back, _ = self.compared(int(bool(lines)), self.old, *options, old=new)
        turned = {"worse": "better", "better": "worse", "gone": "new", "new": "gone", "changed": "changed"}
        self.assertEqual([line.split()[0] for line in back], [turned[line.split()[0]] for line in lines])

    def test_same(self):
        lines, pairs = self.compared(0, self.old, "--threshold", "error=0,floor=0,work=0")
        self.assertEqual((lines, pairs), ([], f"24 runs in both: {SAME}"))

    def test_errors(self):
        def grow(by):
            def change(file):
                file["error"][1, 0, 2, 1] = 0.01 * by
            return change

        old = altered_sweep(self.old, self.folder / "old.h5", grow(1))
        for by, threshold, word in ((1.005, "error=0.01", None), (1.005, "error=0.001", "worse"), (1.02, "error=0.01", "worse"),
                                    (0.9, "error=0.01", "better"), (-1, "error=0.01", "changed")):
            new = altered_sweep(self.old, self.new, grow(by))
            lines, _ = self.compared(int(word is not None), new, "--threshold", threshold, old=old)
            self.assertEqual(lines, [] if word is None else [
                f"{word:8} elastica/load=1/beamw n=4: error of u_over_L +1 % -> {by:+.4g} %"])

    def test_statuses_costs_and_values(self):
        def fails(file):
            names = file["status"].attrs["names"].decode().split("\n")
            file["status"][3, 1, 0] = names.index("singular")

        def costs(file):
            file["cost"][0, 0, 0] *= 1.03

        def loses(file):
            file["value"][2, 0, 0, 0] = float("nan")

        def other(file):
            file["not_modelled"][0, 0] = 1

        def refers(file):
            file["reference"][0, 2] *= 1.0001

        self.check(fails, ["worse    elastica/load=2/sheet_third n=1: ok -> singular"])
        self.check(loses, ["worse    elastica/load=1.5/beamw n=1: w_over_L no longer has a value"])
        self.check(other, [f"worse    elastica/load=0.5/beamw n={n}: ok -> other model" for n in (1, 2, 4)])
        lines, _ = self.compared(1, altered_sweep(self.old, self.new, costs))
        self.assertRegex("\n".join(lines), r"^worse    elastica/load=0.5/beamw n=1: cost .* ms -> .* ms \(\+3.0 %\)$")
        self.compared(0, self.new, "--threshold", "work=0.05")
        lines, _ = self.compared(1, altered_sweep(self.old, self.new, refers))
        self.assertRegex("\n".join(lines), r"^changed  elastica/load=0.5/reference: theta .* -> .*$")

    def test_points(self):
        one = sweep(self.folder / "one.h5", "elastica", "--vary", "load=0.1..0.4/3", "-s", "axial=1e6", *OPTIONS)
        two = sweep(self.folder / "two.h5", "elastica", "--vary", "axial=1e7,1e6", "--vary", "load=0.3,0.2,0.7", *OPTIONS)
        with group_of(one) as file:
            self.assertNotIn(0.3, file["points"][()], "a number that rounds as in the list")
        lines, pairs = self.compared(1, two, old=one)
        self.assertTrue(pairs.startswith("12 runs in both: 0 worse, 0 better, 0 changed, 2 gone, 4 new"), (lines, pairs))
        self.assertEqual(sorted(lines), sorted(
            [f"gone     elastica/axial=1e+06;load={load}" for load in (0.1, 0.4)] +
            ["new      elastica/axial=1e+06;load=0.7"] +
            [f"new      elastica/axial=1e+07;load={load}" for load in (0.2, 0.3, 0.7)]))
        self.refused(2, "nothing was compared", "compare", self.old, one, silent=False)

    def test_formulations_and_meshes(self):
        new = sweep(self.new, "elastica", "--vary", "load=0.5..2/3", "-f", "sheet_third", "-f", "collocation", "-n", "1,4,8")
        lines, _ = self.compared(1, new)
        self.assertEqual(sorted(line for line in lines if "gone" in line or "new" in line),
                         ["gone     elastica n=2", "gone     elastica/beamw", "new      elastica n=8",
                          "new      elastica/collocation"])
        self.refused(2, "nothing was compared", "compare", self.old, new, "-k", "beamw", silent=False)

    def test_quantities(self):
        new = sweep(self.new, "elastica", "--vary", "load=0.5..2/3", "-k", "theta", *OPTIONS)
        with group_of(self.old) as old, group_of(new) as file:
            self.assertEqual((len(old["quantities"]), len(file["quantities"])), (3, 1))
        self.compared(0, new)
        lines, _ = self.compared(1, altered_sweep(new, self.folder / "none.h5", lambda file: file.attrs.__delitem__("selection")))
        self.assertIn("gone     elastica/load=1/beamw n=2: w_over_L", lines)

    def test_words_and_scenes(self):
        words = sweep(self.new, "c_column", "--vary", "section_data=shear_flow,printed", "-f", "beamw", "-n", "1,2")
        lines, _ = self.compared(1, sweep(self.folder / "one.h5", "c_column", "--vary", "section_data=printed", "-f", "beamw",
                                          "-n", "1,2"), old=words)
        self.assertEqual(lines, ["gone     c_column/section_data=shear_flow"])
        leaf = sweep(self.new, "--scene", LEAF, "--vary", "thickness=0.2e-3,1e-3", "-f", "collocation", "-n", "1", "-k", "k_drive")
        self.assertEqual(self.compared(0, leaf, old=leaf)[1], f"2 runs in both: {SAME}")

    def test_trouble(self):
        results = verify("elastica/default and beamw", self.folder / "results.h5")
        for pair in ((self.old, results), (results, self.old)):
            self.refused(2, "old.h5 contains a sweep, but", "compare", *pair)
        self.refused(2, "there is no short table", "compare", self.old, "-o", self.folder / "x.csv")
        self.refused(4, "contains results of sweep, not of verify", "verify", "-k", "elastica", "--not-worse-than", self.old)
        for name in ("axes", "quantities", "formulations", "meshes", "points", "reference", "value", "error", "cost", "status",
                     "not_modelled"):
            def drop(file, name=name):
                del file[name]

            def empty(file, name=name):
                del file[name]
                file[name] = [1.5]

            for change, what in ((drop, name), (empty, "value" if name == "meshes" else name)):
                self.refused(2, f"{what} is missing or damaged", "compare", self.old, altered_sweep(self.old, self.new, change))
        self.refused(2, "the sweep has format version 7, but this version of beamwork reads version 1", "compare", self.old,
                     altered_sweep(self.old, self.new, lambda file: file.attrs.modify("beamwork_sweep", 7)))


CASE = "warping_torsion"
SCENE = ROOT / "cases" / "examples" / "euler_column.yaml"


def without(file, formulation):
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
        with h5py.File(cls.whole) as file:
            cls.series = sum(len({(r["point"], r["formulation"]) for r in group["cells"][()]})
                             for group in file["cases"].values())
        cls.whole = altered(cls.whole, folder / "all.h5", lambda f: f.attrs.pop("selection"))
        table_of(cls.whole, cls.table)

    def compared(self, new, code, *words, old=None):
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
        old, new = self.folder / "o.h5", self.folder / "n.h5"
        self.answered("verify", "--built-in", "--scene", SCENE, "-o", old, "-k",
                      "euler_column or elastica/default")
        self.answered("verify", "--scene", SCENE, "-o", new)
        self.compared(new, 0, "outside the selection of", old=altered(
            old, self.folder / "all.h5", lambda f: f.attrs.pop("selection")))

    def test_quantities(self):
        new = verify("c_column/default and buckling_load", self.folder / "n.h5")
        self.compared(new, 0, " 0 gone, 0 new")
        done = self.answered("compare", self.table, new)
        self.assertIn("compared only by limits", done.stdout)

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
        old = altered(self.whole, self.folder / "o.h5", lambda file: without(file, "beamw"))
        for new in (False, True):
            run_of = altered(self.whole, self.folder / "n.h5",
                             lambda file, new=new: is_new(file, "beamw", new))
            done = self.answered("compare", old, run_of, code=0 if new else 1)
            self.assertEqual("do not affect the exit status, is only in" in done.stdout, new, done.stdout)
            self.assertEqual(f"new      {CASE}/default/beamw" in done.stdout, not new)

    def test_a_selection_that_cannot_be(self):
        bad = altered(self.whole, self.folder / "n.h5",
                      lambda f: f.attrs.create("selection", numpy.bytes_("(elastica")))
        done = self.answered("compare", self.whole, bad, code=2)
        self.assertIn("selection is missing or damaged", done.stderr)


TABLES = "cases/snap_through"


class Hash(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.old = cls.class_folder() / "old.h5"
        verify("snap_through/default and beamw", cls.old)

    def hashes(self, change, code):
        new = altered(self.old, self.folder / "new.h5", change)
        out = self.answered("compare", "--hash", self.old, new, code=code).stdout
        return [line.split()[0] for line in out.splitlines()]

    def test_times_and_machines(self):
        def change(file):
            rows = file[TABLES]["cells"][()]
            rows["seconds_solve"] *= 2
            rows["seconds_setup"] += 1
            replace(file[TABLES], "cells", rows)
            file.attrs["processor"] = numpy.bytes_("another")
            file.attrs["clock"] = numpy.bytes_("2000-01-01")
        ours, theirs = self.hashes(change, 0)
        self.assertRegex(ours, "^[0-9a-f]{64}$")
        self.assertEqual(ours, theirs)

    def test_the_last_bit(self):
        for table, column in (("quantities", "value"), ("cells", "iterations"),
                              ("verdicts", "limit"), ("steps", "path")):
            def change(file, table=table, column=column):
                rows = file[TABLES][table][()]
                at = numpy.flatnonzero(numpy.isfinite(rows[column]))[0]
                rows[column][at] = (numpy.nextafter(rows[column][at], 9e9)
                                    if rows[column].dtype.kind == "f" else rows[column][at] + 1)
                replace(file[TABLES], table, rows)
            self.assertEqual(len(set(self.hashes(change, 1))), 2, table)

    def test_words_rows_and_arrays(self):
        def word(file):
            rows = file[TABLES]["verdicts"][()]
            rows["verdict"][0] = b"other"
            replace(file[TABLES], "verdicts", rows)

        def row(file):
            replace(file[TABLES], "quantities", file[TABLES]["quantities"][()][:-1])

        def array(file):
            values = file[TABLES]["curve_value"][()]
            replace(file[TABLES], "curve_value", numpy.append(values, 0.0))
        for change in (word, row, array):
            self.assertEqual(len(set(self.hashes(change, 1))), 2, change.__name__)

    def test_refused(self):
        self.refused(2, ["was not written by beamwork"], "compare", "--hash", PROGRAM)
        self.refused(2, ["--hash applies to whole files"], "compare", "--hash", self.old, "-k", "beamw")
