"""Tests of the verb bench: rows, rejected input, and comparison of two programs or formulations."""
import csv
import io
import json
import re
import unittest

import h5py

from harness.tools.kit.program import PROGRAM, ROOT, ProgramTest

LEAF = ROOT / "cases" / "examples" / "leaf_spring_guide.yaml"


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

    def test_json(self):
        whole = json.loads(self.answered("bench", "elastica", "-f", "collocation", "-n", "1,2", "--format", "json").stdout)
        self.assertTrue(whole["processor"])
        self.assertEqual([one["elements"] for one in whole["timings"]], [1, 2])
        for one in whole["timings"]:
            self.assertLessEqual(one["seconds_least"], one["seconds_most"])
            self.assertEqual({q["quantity"] for q in one["quantities"]}, {"w_over_L", "u_over_L", "theta"})

    def test_several_cases(self):
        done = self.answered("bench", "elastica", "warping_torsion", "-f", "collocation", "-n", "1")
        text = " ".join(done.stdout.split())
        self.assertIn("w_over_L, u_over_L, theta within 10, 1, 0.1, 0.01 %: ", text)
        self.assertIn("twist_ratio within 10, 1, 0.1, 0.01 %: ", text)

    def test_errors_of_one_quantity(self):
        work = ("bench", "c_column", "-f", "beamw", "-f", "collocation", "-n", "2")
        text = self.answered(*work, "-k", "buckling_load").stdout
        self.assertIn("\n  errors of buckling_load\n", text)
        self.assertRegex(text, r"(?m)^  beamw  .*\+8\.26\d* %$")
        self.assertRegex(text, r"(?m)^  collocation  .* -$")
        self.assertNotIn("frequency", text)
        other = self.answered(*work, "-k", "=buckling_load or =frequency_1").stdout
        self.assertRegex(other, r"(?m)^  formulation +n +error   of frequency_1$")
        self.assertRegex(other, r"(?m)^  collocation +2 +\+0\.189\d* %$")

    def test_selection(self):
        work = ("bench", "c_column", "-n", "2", "-k", "=frequency_3 and (beamw or collocation)", "--format", "csv")
        rows = list(csv.DictReader(io.StringIO(self.answered(*work).stdout)))
        self.assertEqual({r["quantity"] for r in rows}, {"frequency_3"})
        self.assertIn("collocation", {r["formulation"] for r in rows})
        self.assertEqual([r["formulation"] for r in rows if r["formulation"][:2] not in ("be", "co")], [])
        self.refused(2, "did you mean 'buckling_load'", "bench", "c_column", "-k", "buckling_laod")
        self.refused(2, "selects no quantity of elastica", "bench", "warping_torsion", "elastica", "-k", "warping_torsion")

    def test_ranks_as_converge(self):
        text = self.answered("bench", "--scene", LEAF, "--set", "stroke=0.009", "-n", "1,2,4").stdout
        self.assertNotIn("no reference value", text)
        self.assertRegex(text, r"(?m)^  collocation +4 .* %$")

    def test_none_that_passes(self):
        done = self.answered("bench", "shear_elastica", "-f", "beamw", "-f", "sheet_third", "-n",
                             "2,4,8,16")
        text = " ".join(done.stdout.split())
        self.assertRegex(text, r"\b[uv] within 10\b[^%]* %: none that passes; also within this error, with a "
                               r"different limit: beamw, n = \d+, cost [\d.]+ ms, timed [\d.]+ ms")
        told = re.findall(r"(?m)^  (\S[\w, ]*) within ([\d., ]+) %: ", done.stdout)
        for name in {n for names, _ in told for n in names.split(", ")}:
            levels = [level for names, some in told if name in names.split(", ")
                      for level in some.split(", ")]
            self.assertEqual(levels, ["10", "1", "0.1", "0.01"], name)

    def test_file(self):
        path = self.folder / "bench.h5"
        self.answered("bench", "elastica", "-f", "sheet_third", "-n", "2,4,8", "-o", path)
        with h5py.File(path) as file:
            case = file["experiments/bench/cases/elastica"]
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
        for arguments in (("nonsense",), ("-n", "2"),
                          ("elastica", "c_column", "--against", "beamw"),
                          (*cell, "--against", "beamw", "--error", "1%"), (*cell, "--error", "1%"),
                          (*cell, "--against", "nonsense"),
                          (*cell, "--against", "beamw_first", "-o", "x.h5"),
                          (*cell, "--against", "./x", "--inject-slowdown", "20")):
            self.refused(2, "", "bench", *arguments)

    def test_refused_errors(self):
        work = ("bench", "elastica", "-f", "collocation", "--against", "beamw", "--error")
        for error in ("0", "1", "100%", "1%,", ",1%", "-1%", "nan", "1%%", "1 %", ""):
            self.refused(2, "--error", *work, error)
        self.refused(2, "a different model", "bench", "c_column", "-f", "beamw", "--against",
                     "beamw_vlasov", "--error", "1%")
        self.refused(2, "did you mean 'theta'", *work, "1%", "-k", "thetta")
        self.refused(2, "selects only one of the two formulations", *work, "1%", "-k", "beamw")

    def least(self, case, formulation, level):
        """Returns the smallest number of elements for which this mesh and all finer meshes are within the error level,
        according to converge."""
        series = self.record("converge", *case, "-f", formulation)["series"][0]
        meshes = [m["elements"] for m in series["quantities"][0]["meshes"]]
        bad = [k for q in series["quantities"] for k, m in enumerate(q["meshes"])
               if not abs(m["error"]) <= level]
        first = max(bad, default=-1) + 1
        return meshes[first] if first < len(meshes) else None

    def test_equal_error(self):
        answer = self.record("bench", "elastica", "-f", "collocation", "--against", "beamw",
                             "--error", "0.15%,0.001%")
        self.assertEqual(answer["quantities"], ["w_over_L", "u_over_L", "theta"])
        for one, level in zip(answer["comparisons"], (0.0015, 1e-5), strict=True):
            self.assertEqual(one["error"], level)
            for side, name in (("a", "collocation"), ("b", "beamw")):
                least = self.least(("elastica",), name, level)
                self.assertEqual(one[f"elements_{side}"], least)
        met, missed = answer["comparisons"]
        self.assertLessEqual(max(met["error_a"], met["error_b"]), 0.0015)
        self.assertLessEqual(met["low"], met["ratio"])
        self.assertLessEqual(met["ratio"], met["high"])
        self.assertTrue(met["outcome"] != "faster" or met["high"] < 1, met)
        self.assertTrue(met["outcome"] != "slower" or met["low"] > 1, met)
        self.assertEqual(missed["outcome"], "not reached")
        self.assertIsNone(missed["elements_b"])

    def test_equal_error_of_a_scene(self):
        text = self.answered("bench", "--scene", LEAF, "-f", "sheet_third", "--against",
                             "collocation", "-k", "k_pushed").stdout
        self.assertEqual(re.findall(r"(?m)^at ([\d.]+) %: ", text), ["10", "1", "0.1"])
        self.assertRegex(text, r"(?m)^sheet_third, k_pushed: converges to its derived limit")

    def test_another_build(self):
        answer = self.record("bench", "--scene", LEAF, "-f", "collocation", "-n", "1", "--against",
                             PROGRAM)
        self.assertEqual({w["a"] for w in answer["work"]}, {w["b"] for w in answer["work"]})
        text = self.answered("bench", "warping_torsion", "--against", PROGRAM).stdout
        self.assertRegex(text, r"\A-f \S+: .*\n-n \d+: .*\nA ")
        self.assertIn("the same work", text)

    def test_stranger(self):
        self.refused(4, "/bin/true", "bench", "elastica", "-f", "beamw", "-n", "1",
                     "--against", "/bin/true")


if __name__ == "__main__":
    unittest.main()
