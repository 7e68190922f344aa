"""list: the contents of a case and of a formulation, and misspelt names."""
import csv
import re
import unittest

from harness.tools.kit.program import ROOT, ProgramTest, environment

WIDEST = 100


def names_of(text, heading):
    below = text.partition(heading)[2].partition("\n")[2]
    return [line.split()[0] for line in re.split(r"\n(?! )", below)[0].splitlines()
            if re.match("  [^ ]", line)]


class Lists(ProgramTest):

    def setUp(self):
        super().setUp()
        text = self.answered("list").stdout
        self.cases, self.formulations = (names_of(text, word) for word in
                                         ("cases (", "formulations ("))
        self.assertGreater(min(len(self.cases), len(self.formulations)), 5)

    def shown(self, name):
        text = self.answered("list", name).stdout
        self.assertLessEqual(max(map(len, text.splitlines())), WIDEST, text)
        return " ".join(text.split()), text

    def test_orders(self):
        for name, statics in (("collocation", "2 to 10"), ("sheet_third", "2 to 4")):
            told = " ".join(self.shown(name)[0].split()).partition("order of convergence: ")[2]
            self.assertTrue(told.startswith(f"{statics} in statics, 4 to 8 in vibration, "
                                            "2 to 4 in motion, 2 to 4 in linear buckling"),
                            told[:99])

    def test_every_case(self):
        for name in self.cases:
            words, text = self.shown(name)
            self.assertTrue(words.startswith(f"{name}: "))
            self.assertEqual(names_of(text, "\nformulations"), self.formulations)

    def test_every_formulation(self):
        runs = {case: self.shown(case)[0] for case in self.cases}
        for name in self.formulations:
            words = self.shown(name)[0]
            for word in ("source: ", "order of convergence: ", "shear in stability: ", "newton=",
                         "known deviations", "supports"):
                self.assertIn(word, words, name)
            told = words.partition("cases, at their default parameters")[2]
            does = told.partition("not run")[0]
            for case in self.cases:
                self.assertEqual(len(re.findall(rf"[ :]{case}[, ]", told)), 1, (name, case))
                runs_here = re.search(rf"[ :]{case}[, ]", does) is not None
                self.assertEqual(runs_here, f" {name} runs" in runs[case], (name, case))

    def test_findings(self):
        with open(ROOT / "reference" / "findings.csv", newline="", encoding="utf-8") as table:
            rules = list(csv.DictReader(table))
        for name in self.formulations:
            words = self.shown(name)[0]
            for rule in rules:
                spoken_of = {"*", name} & set(rule["formulations"].split())
                self.assertEqual(bool(spoken_of), f" {rule['rule']}: " in words, rule["rule"])
                if spoken_of:
                    self.assertIn(" ".join(rule["cause"].split()), words)
        done = self.answered("list", "beamw", env=environment(BEAMWORK_TRUTHS="/nowhere"))
        self.assertNotIn("finding", done.stdout)

    def test_json(self):
        every = self.record("list")
        self.assertEqual([one["case"] for one in every["cases"]], self.cases)
        self.assertEqual([one["formulation"] for one in every["formulations"]], self.formulations)
        self.assertEqual({**self.record("list", "cases"), **self.record("list", "formulations")},
                         every)
        case = self.record("list", "c_column")
        self.assertEqual({one["name"] for one in case["parameters"] if one["choices"]},
                         {"section_data", "shear_stability", "mass", "omit"})
        self.assertEqual([one["formulation"] for one in case["formulations"]], self.formulations)
        one = self.record("list", "beamw:mass=lumped")
        option = {entry["name"]: entry for entry in one["options"]}["mass"]
        self.assertEqual((option["value"], option["default"] in option["choices"]),
                         ("lumped", True))
        self.assertNotEqual(option["value"], option["default"])
        self.assertEqual([here["case"] for here in one["cases"]], self.cases)
        for here in one["cases"]:
            there = {who["formulation"]: who for who in
                     self.record("list", here["case"])["formulations"]}["beamw"]
            self.assertEqual((here["runs"], here["without"]), (there["runs"], there["without"]))
        words = self.shown("beamw")[0]
        self.assertTrue(one["findings"])
        for rule in one["findings"]:
            self.assertIn(" ".join(rule["cause"].split()), words)
        self.refused(2, "text or json", "list", "--format", "csv")

    def test_names(self):
        self.assertEqual(self.answered("list", "formulations").stdout.splitlines()[0][:13],
                         "formulations ")
        self.assertTrue(self.answered("list", "beamw:mass=lumped").stdout.startswith("beamw:mass"))
        self.refused(2, "did you mean 'collocation'", "list", "collocaton")
        self.refused(2, "did you mean 'c_column'", "list", "c_colum")
        self.refused(2, "did you mean 'formulations'", "list", "formulation")
        self.refused(2, "no option 'mas'", "list", "beamw:mas=lumped")


if __name__ == "__main__":
    unittest.main()
