"""The verb bench: rows, refusals, comparison of two contestants. Times themselves are not asserted: see make bench-check."""
import csv
import io
import json
import os
import subprocess
import tempfile
import unittest

import h5py

PROGRAM = os.environ.get("BEAMWORK", "build/beamwork")


def run(*arguments):
    return subprocess.run([PROGRAM, "bench", *arguments], capture_output=True, text=True, check=False)


class Bench(unittest.TestCase):
    def test_rows(self):
        done = run("elastica", "-f", "collocation", "-f", "beamw", "-n", "1,2", "--format", "csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = list(csv.DictReader(io.StringIO(done.stdout)))
        self.assertEqual({(r["formulation"], r["elements"]) for r in rows}, {("collocation", "1"), ("collocation", "2"), ("beamw", "1"), ("beamw", "2")})
        for r in rows:
            self.assertGreaterEqual(int(r["repeats"]), 5)
            self.assertLessEqual(float(r["seconds_least"]), float(r["seconds_most"]))
            self.assertGreater(int(r["strain_evaluations"]), 0)

    def test_several_cases(self):
        done = run("elastica", "warping_torsion", "-f", "collocation", "-n", "1")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("w_over_L within 10 %", done.stdout)
        self.assertIn("twist_ratio within 10 %", done.stdout)

    def test_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "bench.h5")
            done = run("elastica", "-f", "sheet_third", "-n", "2,4,8", "-o", path)
            self.assertEqual(done.returncode, 0, done.stderr)
            with h5py.File(path) as file:
                case = file["cases/elastica"]
                rows = case["timings"][()]
                self.assertEqual(list(rows["elements"]), [2, 4, 8])
                self.assertEqual(rows[0]["keep_all_repeats"], 0)
                self.assertGreaterEqual(rows[1]["keep_all_repeats"], 5)
                self.assertGreater(rows[1]["keep_all_free"], case["cells"][1]["free"])
                for row in rows:
                    self.assertAlmostEqual(row["seconds_setup"] + row["seconds_solve"], min(row[f"round_{i}"] for i in range(1, 6)), delta=1e-12)
                    self.assertEqual(row["seconds_least"], min(row[f"round_{i}"] for i in range(1, 6)))
                    self.assertEqual(row["seconds_most"], max(row[f"round_{i}"] for i in range(1, 6)))
                reached = dict(zip(case["verdicts"]["quantity"], case["verdicts"]["reach_10"]))
                self.assertEqual(reached[b"w_over_L"], 2)

    def test_against(self):
        done = run("warping_torsion", "-f", "beamw", "-n", "1,2", "--against", "beamw", "--format", "json")
        self.assertEqual(done.returncode, 0, done.stderr)
        answer = json.loads(done.stdout)
        self.assertGreaterEqual(answer["pairs"], 51)
        self.assertLessEqual(answer["low"], answer["high"])
        work = {w["name"]: (w["a"], w["b"]) for w in answer["work"]}
        self.assertLess(*work["free"])

    def test_refusals(self):
        for arguments in (("nonsense",), ("-n", "2"), ("elastica", "--against", "beamw"), ("elastica", "-f", "beamw", "-n", "1", "--against", "nonsense"),
                          ("elastica", "-f", "beamw", "-n", "1", "--against", "beamw_first", "-o", "x.h5"),
                          ("elastica", "-f", "beamw", "-n", "1", "--against", "./x", "--plant", "20")):
            done = run(*arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)

    def test_stranger(self):
        done = run("elastica", "-f", "beamw", "-n", "1", "--against", "/bin/true")
        self.assertEqual(done.returncode, 4)
        self.assertIn("/bin/true", done.stderr)


if __name__ == "__main__":
    unittest.main()
