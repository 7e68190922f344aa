"""Reports must describe every kind of verdict, count each verdict once, and show all known deviations and checks."""
import json
import re
import unittest

from harness.tools.kit.program import ProgramTest, TRUTHS, drawn, run
from reference import pack
from reports import answers, checks, data, deviations, verdicts
from reports.site import ROOT
from reports.test.results import Site, case, series, verdict


def told():
    return run("schema").stdout.split("/cases/CASE/verdicts:")[1]


class Kinds(unittest.TestCase):

    def test_every_kind_of_the_judge_has_words(self):
        table = told()
        names = re.search(r"  verdict +enum +verdict \((.*)\)\n", table).group(1)
        left = names
        for name in sorted(verdicts.BY_NAME, key=len, reverse=True):
            self.assertIn(name, names)
            left = left.replace(name, "", 1)
        self.assertEqual(left.strip(", "), "")

    def test_every_column_of_the_judge_is_read(self):
        columns = set(re.findall(r"^  (\S+) ", told().split("\n\n")[0], re.M))
        left_out = {"case", "point", "parameters", "formulation", "unit", "asymptotic_from",
                    "omitted", "assumed"}
        read = set(data.Verdict.__dataclass_fields__) - {"reach"} | set(data.REACH.values())
        self.assertEqual(columns - read, left_out)


class Remarks(unittest.TestCase):

    def test_biased_has_its_size(self):
        found = verdict(
            "load", "biased", truth=2.0, limit=2.001, error=5e-4, limit_uncertainty=1e-6
        )
        self.assertEqual(verdicts.remarks(found), ["+0.05 % from the reference value"])

    def test_predicted_limit_stands_beside(self):
        record = {"truth": 2.0, "limit": 2.2, "error": 0.1, "predicted": 2.2000022}
        hit = verdict("load", "wrong limit, as predicted", **record)
        self.assertAlmostEqual(verdicts.met(hit), 1e-6, 11)
        self.assertIn("predicted 2.2000022, met to", verdicts.remarks(hit)[1])
        self.assertIn("missed by", verdicts.remarks(verdict("load", "wrong limit", **record))[1])

    def test_undecided_says_how_well_it_is_known(self):
        found = verdict(
            "load", "undecided", truth=2.0, limit=2.0, error=0.0, limit_uncertainty=0.02
        )
        self.assertIn("known to ± 1 %", verdicts.remarks(found)[0])

    def test_digits_and_contradictions(self):
        found = verdict(
            "f", "pass", truth=2.0, limit=2.0, error=0.0, below_digits=1, contradicted=2.5
        )
        self.assertEqual(len(verdicts.remarks(found)), 2)
        self.assertEqual(verdicts.remarks(verdict("f", "pass", limit=2.0)), [])
        self.assertEqual(verdicts.remarks(verdict("f", "diverged")), [])

    def test_the_mark_is_that_of_the_worst(self):
        good = verdict("a", "pass", truth=1.0, error=0.0)
        biased, more = (verdict("b", "biased", truth=1.0, error=e) for e in (1e-4, -3e-4))
        wrong = verdict("c", "wrong limit", truth=1.0, error=0.1)
        self.assertIs(verdicts.worst([good, biased, more]), more)
        self.assertIs(verdicts.worst([wrong, biased, good]), wrong)
        series = data.Series("k", "", "", "", [], [good, wrong, biased])
        mesh = data.Mesh(
            4, "ok", "", data.Clock(0, 1, 1, 1, 1), 1, 0, "", {}, errors={"a": 0, "b": 0, "c": 0.1}
        )
        series.meshes.append(mesh)
        for v in series.verdicts:
            v.reach = {0.1: 4}
        self.assertIs(answers.way(series, ["a", "b", "c"], 0.1).worst, wrong)


def experiment(kind, gone, what="shear", formulation="beam"):
    return {"kind": kind, "gone": gone, "what": what, "formulation": formulation}


class Causes(ProgramTest):

    def test_what_is_concluded(self):
        finer = experiment("finer", False, "more elements")
        instead = experiment("instead", True, "modes", "other")
        for last, words in (
            ([experiment("without", True)], "gone without shear"),
            ([instead], "gone with other"),
            ([experiment("without", False)], "none of these removes it"),
        ):
            self.assertEqual(deviations.verdict_of({"experiments": [finer, *last]}), words)
        coarse = {"experiments": [experiment("finer", True, "more elements"), instead]}
        self.assertIn("too coarse", deviations.verdict_of(coarse))

    def test_page(self):
        site = Site(str(self.folder / "results.h5"), TRUTHS)
        self.assertFalse(deviations.has_causes(site))
        studies = [{"finding": name, "experiments": []} for name in ("b", "a", "b")]
        record = {"minutes": 1, "not_run": 0, "studies": studies}
        (self.folder / "causes.json").write_text(json.dumps(record), encoding="utf-8")
        self.assertTrue(deviations.has_causes(site))
        deviations.write_causes(site)
        rules = site.pages["causes.html"]["rules"]
        self.assertEqual([(name, len(found)) for name, found in rules.items()], [("a", 1),
                                                                                 ("b", 2)])


def row(formulation, left_out, number, covered):
    return {
        "formulation": formulation,
        "left_out": left_out,
        "series": number,
        "covered": covered,
    }


class Checks(ProgramTest):

    def context(self, *cases):
        site = Site(str(self.folder / "results.h5"), cases=cases)
        checks.write(site)
        return site.pages["checks.html"]

    def test_counts(self):
        judged = [verdict("a", "pass"), verdict("b", "biased"), verdict("c", "no truth")]
        found = self.context(case("one", series("beam", judged)))
        self.assertEqual(found["rows"], [("one", 1, 1, 2, 1)])
        self.assertEqual(
            list(found["counts"].items()), [("pass", 1), ("biased", 1), ("no truth", 1)]
        )

    def test_tables_of_other_commands(self):
        found = self.context()
        self.assertEqual((found["mutants"], found["fuzz"]), (None, None))
        mutants, fuzz = {"killed": 1, "survived": 1, "mutants": []}, {"executions": 12}
        (self.folder / "faults.json").write_text(json.dumps(mutants), encoding="utf-8")
        (self.folder / "fuzz.json").write_text(json.dumps(fuzz), encoding="utf-8")
        found = self.context()
        self.assertEqual((found["mutants"], found["fuzz"]), (mutants, fuzz))

    def test_smallest_faults(self):
        self.assertFalse(self.context(case("none"))["noticed"])
        found = self.context(case("elastica"), case("cross_flexure"))["noticed"]
        self.assertEqual({row["case"] for row in found["rows"]}, {"elastica", "cross_flexure"})
        self.assertIn("shift_x", {row["quantity"] for row in found["passing"]})
        self.assertNotIn("elastica", {row["case"] for row in found["passing"]})
        for of in found["formulations"].values():
            self.assertEqual(list(of), found["constants"])

    def test_coverages(self):
        rows = [row("collocation", 0, 4, 4), row("collocation", 1, 3, 2), row("beamw", 0, 5, 1)]
        one = data.Case("one", "", "", [], rows)
        two = data.Case("two", "", "", [], [row("collocation", 0, 6, 5)])
        found = self.context(one, two, data.Case("none", "", "", []))["coverage"]
        self.assertEqual(found["consistent"], [("collocation", [(9, 10), (2, 3)])])
        self.assertEqual(found["together"], [(9, 10), (2, 3)])
        self.assertEqual(found["all"], [(10, 15), (2, 3)])
        self.assertEqual(found["others"], [("beamw", [(1, 5)])])
        at = checks.CONSISTENT.index("collocation")
        by_case = [(name, of_keys[at]) for name, of_keys in found["cases"]]
        self.assertEqual(by_case, [("one", [(4, 4), (2, 3)]), ("two", [(5, 6)])])


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


class Deviations(unittest.TestCase):

    def contents(self, *rules):
        return deviations.contents([sheet(1.5)], rules)

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
        found = deviations.contents([case("c", series("k", told))], [RULE])["lines"][0]["met"]
        self.assertEqual([found[name] for name in ("met", "missed", "open")], [0, 2, 2])
        self.assertAlmostEqual(found["largest"], 0.01 / 1.02)
        found = deviations.contents([case("c", series("k", told[2:]))], [RULE])["lines"][0]["met"]
        self.assertIsNone(found["farthest"])

    def test_what_is_left_open(self):
        there = {"limit": 2.02, "truth": 2.0, "error": 0.01}
        self.assertAlmostEqual(deviations.left(verdict("q", "biased", predicted=2.03, **there)), 0.005)
        self.assertAlmostEqual(deviations.left(verdict("q", "biased", **there)), 0.01)

    def test_what_nobody_saw_is_there(self):
        line = self.contents(RULE, {**RULE, "rule": "other", "proof": "test_a"})["lines"][1]
        self.assertEqual((line["seen"], line["worst"], line["met"], line["link"]),
                         ([], None, None, ""))

    def test_what_is_not_expected_is_named(self):
        self.assertEqual(self.contents()["unexplained"],
                         [(("sheet_third_printed", "wrong limit"), 1)])

    def test_proofs_lead_to_sections_that_exist(self):
        site = Site()
        deviations.write_errata(site)
        for title in deviations.headings():
            link = deviations.link_of(f"reference/ERRATA.md, {title.lower()}", deviations.headings())
            self.assertIn(f'id="{link.partition("#")[2]}"', site.pages["errata.html"]["body"])

    def test_every_table_of_the_errata_is_one(self):
        text = (ROOT / "reference" / "ERRATA.md").read_text(encoding="utf-8")
        site = Site()
        deviations.write_errata(site)
        body = site.pages["errata.html"]["body"]
        self.assertEqual(body.count("<table>"), text.count("\n|---"))

    def test_the_packed_ledger_is_shown_whole(self):
        rules = data.read_rules(TRUTHS)
        site = Site(results="nowhere/results.h5", truths=TRUTHS)
        deviations.write(site)
        shown = [line["rule"] for line in site.pages["deviations.html"]["lines"]]
        self.assertEqual(shown, [rule["rule"] for rule in rules])

    def test_the_columns_are_those_of_the_ledger(self):
        self.assertEqual(set(RULE), set(pack.FINDING_COLUMNS))


class Page(ProgramTest):

    def page(self):
        site = drawn(self.folder, "-k", "spherical_joint/default and sheet_third")
        return (site / "mechanisms.html").read_text(encoding="utf-8")

    def test_without_times(self):
        page = self.page()
        self.assertIn("9.77", page)
        self.assertNotIn("time here", page)
        about = (self.folder / "site" / "environment.html").read_text(encoding="utf-8")
        self.assertIn("make lab L=bench-mechanisms", about)

    def test_with_times(self):
        done = self.answered("bench", "spherical_joint", "-f", "sheet_third", "-n", "1", "--dense",
                             "-o", self.folder / "mechanisms_joint.h5")
        parts = re.search(
            r"\[us\] in an iteration.*\n +sheet_third +1(?: +-?[\d.]+){5}\n"
            r" +dense ([\d.]+) ms \(243 unknowns\): ([\d.]+) times", done.stdout)
        self.assertIsNotNone(parts, done.stdout)
        self.assertTrue(all(float(part) > 0 for part in parts.groups()), done.stdout)
        page = self.page()
        self.assertIn("time here", page)
        self.assertIn("<td class=\"n\">243</td>", page)
        self.assertIn('<svg id="mechanisms_growth"', page)


if __name__ == "__main__":
    unittest.main()
