"""The page of the ledger: what a rule counts, what only repeats, how predictions are met."""
import unittest

from harness.tools.kit.program import TRUTHS
from reference import pack
from reports import data, ledger, verdicts
from reports.site import ROOT
from reports.test.results import Site, case, series, verdict

RULE = {
    "rule": "shear",
    "formulations": "sheet_third",
    "cases": "*",
    "condition": "shear",
    "quantities": "*",
    "verdicts": "biased|wrong limit, as predicted",
    "largest_error": 0.02,
    "predicted": "",
    "cause": "shear is left out",
    "proof": "reference/ERRATA.md, N 37",
}


def known(quantity, kind, error, **more):
    return verdict(quantity, kind, finding="shear", error=error, limit=1 + error, **more)


def sheet(second_name):
    """A corrected form, its misprint, and a second name of one entry with this value."""
    values = {"C_ux_Fx": 1.5, "C_xx": second_name, "C_zz": 2.0}
    told = known("C_ux_Fx", "wrong limit, as predicted", 0.01, predicted=1.01 * (1 + 1e-6))
    right = [told, known("C_xx", "biased", 4e-4), known("C_zz", "biased", -3e-4)]
    printed = [
        told,
        known("C_xx", "biased", 4e-4),
        known("C_zz", "wrong limit", 0.05, as_expected=0),
    ]
    return case(
        "sheet",
        series("sheet_third", right, values),
        series("sheet_third_printed", printed, values),
    )


class Tally(unittest.TestCase):

    def standings(self, found):
        return {(r.formulation, r.verdict.quantity): r.standing for r in verdicts.rows([found])}

    def test_repeats(self):
        stands = self.standings(sheet(1.5))
        self.assertEqual(stands["sheet_third", "C_ux_Fx"], verdicts.OWN)
        self.assertEqual(stands["sheet_third", "C_xx"], verdicts.ALIAS)
        self.assertEqual(stands["sheet_third_printed", "C_ux_Fx"], verdicts.MISPRINT)

    def test_a_misprint_with_a_verdict_of_its_own_counts(self):
        self.assertEqual(self.standings(sheet(1.5))["sheet_third_printed", "C_zz"], verdicts.OWN)

    def test_a_name_with_other_bits_is_no_alias(self):
        self.assertEqual(self.standings(sheet(1.5 + 2.3e-16))["sheet_third", "C_xx"], verdicts.OWN)

    def test_a_name_without_the_other_is_no_alias(self):
        self.assertEqual(self.standings(sheet(1.5))["sheet_third", "C_zz"], verdicts.OWN)


class Ledger(unittest.TestCase):

    def contents(self, *rules):
        return ledger.contents([sheet(1.5)], rules)

    def test_line(self):
        (line, ) = self.contents(RULE)["lines"]
        self.assertEqual(dict(line["seen"]),
                         {"wrong limit, as predicted": 1, "biased": 1, "wrong limit": 1})
        self.assertEqual((line["number"], line["aliases"], line["misprints"]), (3, 2, 1))
        self.assertEqual(line["worst"].verdict.error, 0.05)
        self.assertEqual([line["met"][name] for name in ("met", "missed", "open")], [1, 0, 0])
        self.assertAlmostEqual(line["met"]["digits"], 6, 3)
        self.assertEqual(line["link"], "errata.html")

    def test_what_is_missed_or_open_is_not_met(self):
        kinds = ("biased", "wrong limit", "undecided", "low order")
        told = [known(str(i), kind, 0.01, predicted=1.02) for i, kind in enumerate(kinds)]
        found = ledger.contents([case("c", series("k", told))], [RULE])["lines"][0]["met"]
        self.assertEqual([found[name] for name in ("met", "missed", "open")], [0, 2, 2])
        self.assertAlmostEqual(found["largest"], 0.01 / 1.02)
        found = ledger.contents([case("c", series("k", told[2:]))], [RULE])["lines"][0]["met"]
        self.assertIsNone(found["farthest"])

    def test_what_is_left_open(self):
        """The distance from a derived limit, in parts of the truth; else that from the truth."""
        there = {"limit": 2.02, "truth": 2.0, "error": 0.01}
        self.assertAlmostEqual(ledger.left(verdict("q", "biased", predicted=2.03, **there)), 0.005)
        self.assertAlmostEqual(ledger.left(verdict("q", "biased", **there)), 0.01)

    def test_what_nobody_saw_is_there(self):
        line = self.contents(RULE, {**RULE, "rule": "other", "proof": "test_a"})["lines"][1]
        self.assertEqual((line["seen"], line["worst"], line["met"], line["link"]),
                         ([], None, None, ""))

    def test_what_is_not_expected_is_named(self):
        self.assertEqual(self.contents()["unexplained"],
                         [(("sheet_third_printed", "wrong limit"), 1)])

    def test_proofs_lead_to_sections_that_exist(self):
        site = Site()
        ledger.write_errata(site)
        for title in ledger.headings():
            link = ledger.link_of(f"reference/ERRATA.md, {title.lower()}", ledger.headings())
            self.assertIn(f'id="{link.partition("#")[2]}"', site.pages["errata.html"]["body"])

    def test_every_table_of_the_errata_is_one(self):
        """A table without an empty line above it would be read as prose."""
        text = (ROOT / "reference" / "ERRATA.md").read_text(encoding="utf-8")
        site = Site()
        ledger.write_errata(site)
        body = site.pages["errata.html"]["body"]
        self.assertEqual(body.count("<table>"), text.count("\n|---"))

    def test_the_packed_ledger_is_shown_whole(self):
        rules = data.read_rules(TRUTHS)
        site = Site(results="nowhere/results.h5", truths=TRUTHS)
        ledger.write(site)
        shown = [line["rule"] for line in site.pages["ledger.html"]["lines"]]
        self.assertEqual(shown, [rule["rule"] for rule in rules])

    def test_the_columns_are_those_of_the_ledger(self):
        self.assertEqual(set(RULE), set(pack.FINDING_COLUMNS))


if __name__ == "__main__":
    unittest.main()
