"""The words for verdicts: every kind that the judge knows, and what is said beside each."""
import re
import unittest

from harness.tools.kit.program import run
from reports import answers, data, verdicts
from reports.test.results import verdict


def told():
    """What the schema says of verdicts, and of the tables behind them."""
    return run("schema").stdout.split("/cases/CASE/verdicts:")[1]


class Kinds(unittest.TestCase):
    def test_every_kind_of_the_judge_has_words(self):
        table = told()
        names = re.search(r"  verdict +enum +of the judge \((.*)\)\n", table).group(1)
        left = names
        for name in sorted(verdicts.BY_NAME, key=len, reverse=True):
            self.assertIn(name, names)
            left = left.replace(name, "", 1)
        self.assertEqual(left.strip(", "), "")

    def test_every_column_of_the_judge_is_read(self):
        columns = set(re.findall(r"^  (\S+) ", told().split("\n\n")[0], re.M))
        left_out = {"case", "point", "parameters", "formulation", "unit", "asymptotic_from",
                    "omitted", "assumed"}  # the last two as its cells have them
        read = set(data.Verdict.__dataclass_fields__) - {"reach"} | set(data.REACH.values())
        self.assertEqual(columns - read, left_out)


class Remarks(unittest.TestCase):
    def test_biased_has_its_size(self):
        found = verdict(
            "load", "biased", truth=2.0, limit=2.001, error=5e-4, limit_uncertainty=1e-6
        )
        self.assertEqual(verdicts.remarks(found), ["+0.05 % from the truth"])

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
        """A way for all quantities is as good as its worst verdict, however they are ordered."""
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


if __name__ == "__main__":
    unittest.main()
