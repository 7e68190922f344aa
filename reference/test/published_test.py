"""Compares published numbers with exact values. reference/ERRATA.md must list exactly the contradictions."""
import csv
import math
import pathlib
import sys
import unittest
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
from reference.derive import deep_beam  # noqa: E402

REFERENCE = pathlib.Path(__file__).resolve().parents[1]
HEADING = "## Published numbers that contradict exact ones"


def rows_of(kind):
    found = []
    for path in sorted((REFERENCE / "tables").glob("*.csv")):
        with open(path, newline="", encoding="utf-8") as table:
            found += [
                row
                for row in csv.DictReader(table)
                if row["kind"] == kind and row["model"] == "same" and not row["formulation"]
            ]
    return found


def place(row):
    return row["case"], row["parameters"], row["quantity"], row["at"], row["theory"]


def contradictions():
    """Returns {(case, parameters, quantity): (published, exact)} that differ by more than both uncertainties."""
    exact, found = {place(row): row for row in rows_of("exact")}, {}
    for row in rows_of("published"):
        known = exact.get(place(row))
        if known and abs(float(row["value"]) - float(known["value"])) > float(
            row["uncertainty"]
        ) + float(known["uncertainty"]):
            found[place(row)[:3]] = float(row["value"]), float(known["value"])
    return found


def listed():
    section = (
        (REFERENCE / "ERRATA.md").read_text(encoding="utf-8").split(HEADING)[1].split("\n## ")[0]
    )
    lines = [
        [cell.strip().strip("`") for cell in line.strip("|").split("|")]
        for line in section.splitlines()
        if line.startswith("|")
    ]
    return {(cells[1], cells[2], cells[3]): (float(cells[4]), cells[5]) for cells in lines[2:]}


class Published(unittest.TestCase):

    def test_there_are_some(self):
        exact = {place(row) for row in rows_of("exact")}
        self.assertGreaterEqual(sum(place(row) in exact for row in rows_of("published")), 16)

    def test_every_contradiction_is_listed_and_no_other(self):
        self.assertEqual(set(contradictions()), set(listed()))

    def test_the_list_has_their_values(self):
        for where, (published, exact) in contradictions().items():
            said, digits = listed()[where]
            self.assertEqual(said, published, where)
            self.assertLessEqual(
                abs(float(digits) - exact), 0.5 * 10.0 ** -len(digits.partition(".")[2]), where
            )

    def test_bounds_of_converged_values_stand_on_the_exact_ones(self):
        exact, count = {place(row)[:4]: row["value"] for row in rows_of("exact")}, 0
        for path in (REFERENCE / "tables").glob("*.csv"):
            with open(path, newline="", encoding="utf-8") as table:
                for row in (
                    row
                    for row in csv.DictReader(table)
                    if "of the converged value" in row["source"]
                ):
                    self.assertEqual(row["value"], exact[place(row)[:4]], row)
                    count += 1
        self.assertGreater(count, 0)


class DeepBeam(unittest.TestCase):
    def published(self, *modes):
        found = {
            row["quantity"]: float(row["value"])
            for row in rows_of("published")
            if row["case"] == "deep_beam"
        }
        return [found[f"frequency_{i}"] for i in modes]

    def test_torsion_is_that_of_20_linear_elements(self):
        """The published torsion values must be those of 20 linear elements with consistent mass, where k h = (2 i - 1)
        pi/40."""
        elements, exact = 20, deep_beam.frequencies(False, 1, 1)[2]
        for i, value in zip((1, 2), self.published(3, 7)):
            kh = (2 * i - 1) * math.pi / (2 * elements)
            discrete = math.sqrt(6 * (1 - math.cos(kh)) / (2 + math.cos(kh))) / kh * (2 * i - 1)
            self.assertLess(abs(float(exact) * discrete / value - 1), 2e-5)

    def test_bending_asks_for_another_shear_factor_and_a_mesh(self):
        needed = []
        for half_waves, value in zip((1, 2, 3), self.published(1, 5, 8)):
            low, high = 0.8, 0.9
            for _ in range(40):
                middle = (low + high) / 2
                with mock.patch.object(deep_beam, "SHEAR_FACTOR", middle):
                    found = math.sqrt(deep_beam.bending(half_waves, 1, 1)[0]) / (2 * math.pi)
                low, high = (middle, high) if found < value else (low, middle)
            needed.append(middle)
        self.assertEqual([round(k, 3) for k in needed], [0.852, 0.857, 0.866])


if __name__ == "__main__":
    unittest.main()
