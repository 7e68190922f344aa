"""Values at new points: the programs give back what the tables hold at the old ones, and refuse what they cannot."""
import csv
import pathlib
import unittest

from reference.derive import at

TABLES = pathlib.Path(__file__).resolve().parents[1] / "tables"
CHEAP = {
    "c_column": 3, "moment_buckling": 8, "unsymmetric_column": 3, "shear_column": 12,
    "warping_torsion": 10, "elastica": 2, "shear_elastica": 1, "geradin_cardona": 1, "bend_45": 2,
    "roll_up": 3, "wagner_torsion": 3, "sheet_cantilever": 2, "rotating_cantilever": 2,
    "tip_body": 2, "sprung_beam": 9, "tapered_cantilever": 2, "coupled_beam": 6
}


def exact_rows(case):
    """{parameters: {quantity: row}} in the table's order."""
    points = {}
    with open(TABLES / f"{case}.csv", newline="", encoding="utf-8") as table:
        for row in csv.DictReader(table):
            if row["kind"] == "exact" and row["model"] == "same" and "*" not in row["parameters"]:
                points.setdefault(row["parameters"], {})[row["quantity"]] = row
    return points


class At(unittest.TestCase):

    def test_old_points(self):
        for case, most in CHEAP.items():
            compared = 0
            for parameters, rows in exact_rows(case).items():
                try:
                    found = {row[0]: row
                             for row in at.solve(case, parameters)} if compared < most else {}
                except at.NotDerivable:
                    continue
                for quantity in found.keys() & rows.keys():
                    value, unit = found[quantity][1:3]
                    self.assertEqual(unit, rows[quantity]["unit"], (case, quantity))
                    self.assertLessEqual(abs(float(value) - float(rows[quantity]["value"])),
                                         2 * float(rows[quantity]["uncertainty"]) + 1e-300,
                                         (case, parameters, quantity))
                compared += bool(found)
            self.assertGreater(compared, 0, case)

    def test_every_case_is_known(self):
        for case in at.SOLVERS:
            self.assertTrue((TABLES / f"{case}.csv").exists(), case)

    def test_refusals(self):
        for case, text, word in (("no_case", "", "no_case"), ("elastica", "young=3", "young"),
                                 ("c_column", "section_data=printed;height=0.5", "printed")):
            with self.assertRaisesRegex(at.NotDerivable, word):
                list(at.solve(case, text))


if __name__ == "__main__":
    unittest.main()
