"""The verb bench: rows, refusals, comparison of two contestants. Times themselves are not
asserted: see make bench-check."""
import csv
import io
import unittest

import h5py

from harness.test.program import ProgramTest


class Bench(ProgramTest):
    def test_rows(self):
        done = self.answered("bench", "elastica", "-f", "collocation", "-f", "beamw", "-n", "1,2",
                             "--format", "csv")
        rows = list(csv.DictReader(io.StringIO(done.stdout)))
        self.assertEqual({(r["formulation"], r["elements"]) for r in rows},
                         {(name, n) for name in ("collocation", "beamw") for n in ("1", "2")})
        for r in rows:
            self.assertGreaterEqual(int(r["repeats"]), 5)
            self.assertLessEqual(float(r["seconds_least"]), float(r["seconds_most"]))
            self.assertGreater(int(r["strain_evaluations"]), 0)

    def test_several_cases(self):
        done = self.answered("bench", "elastica", "warping_torsion", "-f", "collocation", "-n", "1")
        self.assertIn("w_over_L within 10 %", done.stdout)
        self.assertIn("twist_ratio within 10 %", done.stdout)

    def test_file(self):
        path = self.folder / "bench.h5"
        self.answered("bench", "elastica", "-f", "sheet_third", "-n", "2,4,8", "-o", path)
        with h5py.File(path) as file:
            case = file["cases/elastica"]
            rows = case["timings"][()]
            self.assertEqual(list(rows["elements"]), [2, 4, 8])
            self.assertEqual(rows[0]["keep_all_repeats"], 0)
            self.assertGreaterEqual(rows[1]["keep_all_repeats"], 5)
            self.assertGreater(rows[1]["keep_all_free"], case["cells"][1]["free"])
            for row in rows:
                rounds = [row[f"round_{i}"] for i in range(1, 6)]
                self.assertAlmostEqual(row["seconds_setup"] + row["seconds_solve"], min(rounds),
                                       delta=1e-12)
                self.assertEqual(row["seconds_least"], min(rounds))
                self.assertEqual(row["seconds_most"], max(rounds))
            reached = dict(zip(case["verdicts"]["quantity"], case["verdicts"]["reach_10"]))
            self.assertEqual(reached[b"w_over_L"], 2)

    def test_against(self):
        answer = self.record("bench", "warping_torsion", "-f", "beamw", "-n", "1,2",
                             "--against", "beamw")
        self.assertGreaterEqual(answer["pairs"], 51)
        self.assertLessEqual(answer["low"], answer["high"])
        work = {w["name"]: (w["a"], w["b"]) for w in answer["work"]}
        self.assertLess(*work["free"])

    def test_refusals(self):
        cell = ("elastica", "-f", "beamw", "-n", "1")
        for arguments in (("nonsense",), ("-n", "2"), ("elastica", "--against", "beamw"),
                          (*cell, "--against", "nonsense"),
                          (*cell, "--against", "beamw_first", "-o", "x.h5"),
                          (*cell, "--against", "./x", "--plant", "20")):
            self.refused(2, "", "bench", *arguments)

    def test_stranger(self):
        self.refused(4, "/bin/true", "bench", "elastica", "-f", "beamw", "-n", "1",
                     "--against", "/bin/true")


if __name__ == "__main__":
    unittest.main()
