"""compare --hash: times and machines leave it alone, anything else that a run says does not."""
import numpy

from harness.records.test.stored import altered, replace, verify
from harness.tools.kit.program import PROGRAM, ProgramTest

TABLES = "cases/snap_through"


class Hash(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.old = cls.class_folder() / "old.h5"
        verify("snap_through/default and beamw", cls.old)

    def hashes(self, change, code):
        """Of the run and of a copy of which change(file) was made."""
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
        """Of one number of every table that has rows."""
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
        self.refused(2, ["not a file of this program"], "compare", "--hash", PROGRAM)
        self.refused(2, ["--hash is of whole files"], "compare", "--hash", self.old, "-k", "beamw")
