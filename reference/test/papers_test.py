"""The papers figure by figure: every item has a row, with status, reason and an existing case."""
import csv
import pathlib
import unittest

from reference import pack

REFERENCE = pathlib.Path(__file__).resolve().parents[1]
STATUSES = ("reproduced", "partly", "not reproducible", "contradicted")
ITEMS = {
    ("J", item)
    for item in (
        "Table 1",
        "Table 2",
        "Table 3",
        "Table 4",
        "Fig. 10",
        "Fig. 11",
        "Fig. 12",
        "Fig. 13",
        "App. A",
    )
} | {
    ("N", item)
    for item in ("Table 1", "Fig. 5", "Fig. 6", "Fig. 8", "Fig. 10", "Sec. 4.1", "App. A", "App. B")
}


def rows():
    with open(REFERENCE / "papers.csv", newline="", encoding="utf-8") as table:
        return list(csv.DictReader(table))


class Papers(unittest.TestCase):
    def test_every_item(self):
        self.assertEqual({(r["paper"], r["item"]) for r in rows()}, ITEMS)

    def test_status_and_reason(self):
        for r in rows():
            self.assertIn(r["status"], STATUSES, r)
            self.assertTrue(r["claim"] and (r["why"] or r["status"] == "reproduced"), r)

    def test_cases_parameters_and_cells(self):
        defaults = pack.read_defaults(REFERENCE / "defaults.csv")
        for r in rows():
            pack.parameter_hash(defaults[r["case"]], r["parameters"], f"papers.csv: {r['item']}")
            given = [bool(r[name]) for name in ("formulation", "elements", "quantity")]
            self.assertIn(sum(given), (0, 3), r)

    def test_contradicted_numbers_are_errata(self):
        errata = (REFERENCE / "ERRATA.md").read_text(encoding="utf-8")
        for r in (
            r
            for r in rows()
            if r["status"] == "contradicted" and r["item"].startswith(("Table", "App"))
        ):
            self.assertIn(f"{r['paper']} {r['item']}", errata, r)


if __name__ == "__main__":
    unittest.main()
