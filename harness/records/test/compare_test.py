"""Tests of beamwork compare."""
import unittest

from harness.records.test.stored import altered, replace, table_of, verify
from harness.tools.kit.program import TRUTHS, ProgramTest, run

TABLES = "cases/warping_torsion"


def of_cell(table):
    return (table["point"] == b"default") & (table["formulation"] == b"beamw") & (table["elements"]
                                                                                  == 4)


def change_rows(file, name, change):
    """Applies change(rows of the cell) to a table of the file. Removes the rows if `change` returns False."""
    group, rows = file[TABLES], file[TABLES][name][()]
    own = of_cell(rows)
    part = rows[own]
    keep = change(part)
    rows[own] = part
    replace(group, name, rows[~own] if keep is False else rows)


class Compare(ProgramTest):

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        cls.old, cls.new, cls.table = (folder / name for name in ("old.h5", "new.h5", "old.csv"))
        verify("warping_torsion/default", cls.old)
        table_of(cls.old, cls.table)

    def compared(self, change, *options, old=None):
        return run("compare", *options, old or self.old, altered(self.old, self.new, change))

    def check(self, code, words, change, *options):
        for old, mesh in ((self.old, " n=4"), (self.table, "")):
            done = self.compared(change, *options, old=old)
            self.assertEqual(done.returncode, code, done)
            for word in words:
                self.assertIn(word.replace("{n=4}", mesh), done.stdout)

    def test_same(self):
        self.check(0, ["0 worse, 0 better, 0 changed, 0 gone, 0 new"], lambda file: None)
        done = self.compared(lambda file: None, "--threshold", "error=0,floor=0,work=0")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual(
            run("compare", self.table, self.old, "--threshold",
                "error=0,floor=0,work=0").returncode, 0)

    def test_jobs(self):
        path = {}
        for jobs in ("1", "2", "5"):
            path[jobs] = self.folder / f"j{jobs}.h5"
            verify(
                "elastica/default and collocation or sheet_wagner/default and collocation or "
                "shear_column/default and beamw_consistent", path[jobs], "-j", jobs)
        for jobs in ("2", "5"):
            done = run("compare", path["1"], path[jobs], "--threshold", "error=0,floor=0,work=0")
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertIn("0 worse, 0 better, 0 changed, 0 gone, 0 new", done.stdout)

    def test_lost_value(self):
        def lose(file):

            def nothing(rows):
                rows["value"][0] = rows["error"][0] = float("nan")

            change_rows(file, "quantities", nothing)

        done = self.compared(lose)
        self.assertRegex(done.stdout, r"(?m)^worse .* no longer has a value$")
        done = run("compare", self.new, self.old)
        self.assertRegex(done.stdout, r"(?m)^better .* has a value now$")

    def test_extra_work(self):
        for count in ("factorisations", "iterations", "strain_evaluations", "factor_flops", "solutions",
                      "solved_entries"):

            def change(file, count=count):

                def more(rows):
                    rows[count] = 2 * rows[count] + 1

                change_rows(file, "cells", more)

            self.check(1, ["worse    warping_torsion/default/beamw{n=4}: ", " 1 worse, 0 better"],
                       change)

        def two(rows):
            rows["factorisations"] = 2

        self.assertEqual(
            self.compared(lambda file: change_rows(file, "cells", two), "--threshold",
                          "work=1").returncode, 0)

    def test_less_work(self):

        def change(file):

            def half(rows):
                rows["strain_evaluations"] //= 2

            change_rows(file, "cells", half)

        self.check(
            1, ["better   warping_torsion/default/beamw{n=4}: evaluations", "0 worse, 1 better"],
            change)

    def errors(self, factor):

        def change(file):

            def scaled(rows):
                rows["error"] *= factor

            change_rows(file, "quantities", scaled)

        return change

    def test_errors(self):
        self.check(1, ["worse    warping_torsion/default/beamw{n=4}: ", "error"], self.errors(1.02))
        self.check(1, ["better   warping_torsion/default/beamw{n=4}: ", "error"], self.errors(0.5))
        self.check(0, [], self.errors(1.005))
        self.check(1, ["worse"], self.errors(1.005), "--threshold", "error=0.001")

    def test_cells(self):

        def gone(file):
            change_rows(file, "cells", lambda rows: False)
            change_rows(file, "quantities", lambda rows: False)

        def failed(file):
            group, rows = file[TABLES], file[TABLES]["cells"][()]
            wider = rows.astype([(name, "S12" if name == "status" else rows.dtype[name])
                                 for name in rows.dtype.names])
            wider["status"][of_cell(wider)] = b"singular"
            del group["cells"]
            group["cells"] = wider

        self.check(1, ["gone     warping_torsion/default/beamw n=4"], gone)
        self.check(1, ["worse    warping_torsion/default/beamw n=4: ok -> singular"], failed)
        self.compared(gone)
        done = run("compare", self.new, self.old)
        self.assertEqual(done.returncode, 1)
        self.assertIn("new      warping_torsion/default/beamw n=4", done.stdout)

    def test_quantities(self):
        def rename(file):

            def other(rows):
                rows["quantity"][0] = b"other"

            change_rows(file, "quantities", other)

        done = self.compared(rename)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stdout,
                         r"(?m)^gone     warping_torsion/default/beamw n=4: (?!other$).+$")
        self.assertRegex(done.stdout, r"(?m)^new      warping_torsion/default/beamw n=4: other$")

    def test_near_zero(self):
        def without_truth(near_zero):

            def change(rows):
                rows["error"], rows["near_zero"] = float("nan"), near_zero * abs(rows["value"])

            return lambda file: change_rows(file, "quantities", change)

        def move(rows):
            rows["value"] *= 1 + 1e-6

        for near_zero, code in ((0, 1), (10, 1), (1000, 0)):
            old = altered(self.old, self.folder / "zero.h5", without_truth(near_zero))
            new = altered(old, self.new, lambda file: change_rows(file, "quantities", move))
            done = run("compare", old, new, "--threshold", "floor=1e-8")
            self.assertEqual(done.returncode, code, (near_zero, done.stdout))

    def trouble(self, word, *arguments, **options):
        self.refused(2, word, "compare", *arguments, **options)

    def test_trouble(self):
        data, cut = self.old.read_bytes(), self.folder / "cut"
        for length in (0, 5, 100, len(data) // 2):
            cut.write_bytes(data[:length])
            self.trouble(str(cut), cut, self.old)
        cut.write_text(self.table.read_text(encoding="utf-8")[:-10], encoding="utf-8")
        self.trouble("damaged or truncated", cut, self.old)
        self.trouble("not a results file", self.old, TRUTHS)
        self.trouble("missing.h5", "missing.h5", self.old)
        self.trouble("nothing was compared", "-k", "elastica", self.old, self.old, silent=False)
        self.trouble("threshold", "--threshold", "work=-1", self.old, self.old)
        self.trouble("did you mean 'elastica'", "-k", "elastca", self.old, self.old)
        self.trouble("malformed", "-k", "and", self.old, self.old)
        self.trouble("two results files", self.old)
        self.trouble("too many", self.old, self.old, self.old)

    def test_impossible_counts(self):
        for column in ("iterations", "strain_evaluations", "factorisations", "factor_flops", "solutions",
                       "solved_entries"):
            for count in (-1, 2 ** 63 - 1):

                def impossible(rows):
                    rows[column][0] = count

                done = self.compared(lambda file: change_rows(file, "cells", impossible))
                self.assertEqual(done.returncode, 2, done)
                self.assertIn("missing or damaged", done.stderr)

    def test_damaged_cell(self):

        def change(file):
            del file[TABLES]["quantities"]

        done = self.compared(change)
        self.assertEqual(done.returncode, 2)
        self.assertIn("warping_torsion/quantities is missing or damaged", done.stderr)

    def test_strange_tables(self):
        def drop(name, column):

            def change(file):
                rows = file[TABLES][name][()]
                del file[TABLES][name]
                file[TABLES][name] = rows[[c for c in rows.dtype.names if c != column]]

            return change

        def texts(file):
            rows = file[TABLES]["quantities"][()]
            del file[TABLES]["quantities"]
            file[TABLES]["quantities"] = rows.astype(
                [(c, "S30" if c == "value" else rows.dtype[c]) for c in rows.dtype.names])

        def homeless(file):
            change_rows(file, "cells", lambda rows: False)

        def pointless(file):
            rows = file[TABLES]["points"][()]
            del file[TABLES]["points"]
            file[TABLES]["points"] = rows[:0]

        for change in (drop("cells", "iterations"), drop("cells", "elements"),
                       drop("quantities", "error"), drop("points",
                                                         "point"), texts, homeless, pointless):
            done = self.compared(change)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
            self.assertIn("damaged", done.stderr)

    def test_versions(self):
        for version in (1, 4):
            done = self.compared(lambda file: file.attrs.modify("schema_version", version))
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(f"the results have format version {version}, but this version of beamwork reads 2 to 3", done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        done = self.compared(lambda file: file.attrs.modify("schema_version", 2))
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
