"""converge: the same numbers as text, CSV and JSON."""
import csv
import io
import json
import unittest

from harness.test.program import run


def converge(form):
    done = run("converge", "elastica", "-f", "beamw", "-f", "sheet_second:newton=displacement",
               "-n", "4,8,16", "--format", form)
    assert done.returncode == 0, done.stderr
    return done.stdout


class Forms(unittest.TestCase):
    def test_json_and_csv_agree(self):
        series = json.loads(converge("json"))["series"]
        self.assertEqual([s["formulation"] for s in series],
                         ["beamw", "sheet_second:newton=displacement"])
        rows = {(r["formulation"], r["quantity"], int(r["elements"])): r
                for r in csv.DictReader(io.StringIO(converge("csv")))}
        seen = 0
        for one in series:
            for quantity in one["quantities"]:
                for mesh in quantity["meshes"]:
                    row = rows[one["formulation"], quantity["quantity"], mesh["elements"]]
                    self.assertEqual(float(row["value"]), mesh["value"])
                    self.assertEqual(float(row["error"]), mesh["error"])
                    seen += 1
        self.assertEqual(seen, len(rows))

    def test_limit_order_and_verdict(self):
        quantities = json.loads(converge("json"))["series"][0]["quantities"]
        one = next(q for q in quantities if q["quantity"] == "w_over_L")
        self.assertEqual(one["verdict"], "pass")
        self.assertAlmostEqual(one["order"], 2, delta=0.05)
        self.assertLess(abs(one["error"]), 1e-4)
        self.assertIn("exact", converge("text"))


if __name__ == "__main__":
    unittest.main()
