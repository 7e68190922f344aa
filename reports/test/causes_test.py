"""The page of experiments: without any, and what is concluded from some."""
import json
import unittest

from harness.tools.kit.program import TRUTHS, ProgramTest
from reports import ledger
from reports.test.results import Site


def experiment(kind, gone, what="shear", formulation="beam"):
    return {"kind": kind, "gone": gone, "what": what, "formulation": formulation}


class Causes(ProgramTest):

    def test_what_is_concluded(self):
        finer = experiment("finer", False, "more elements")
        instead = experiment("instead", True, "modes", "other")
        for last, words in (
            ([experiment("without", True)], "gone without shear"),
            ([instead], "gone with other"),
            ([experiment("without", False)], "none of these takes it away"),
        ):
            self.assertEqual(ledger.verdict_of({"experiments": [finer, *last]}), words)
        coarse = {"experiments": [experiment("finer", True, "more elements"), instead]}
        self.assertIn("too coarse", ledger.verdict_of(coarse))

    def test_page(self):
        site = Site(str(self.folder / "results.h5"), TRUTHS)
        self.assertFalse(ledger.has_causes(site))
        studies = [{"finding": name, "experiments": []} for name in ("b", "a", "b")]
        record = {"minutes": 1, "not_run": 0, "studies": studies}
        (self.folder / "causes.json").write_text(json.dumps(record), encoding="utf-8")
        self.assertTrue(ledger.has_causes(site))
        ledger.write_causes(site)
        rules = site.pages["causes.html"]["rules"]
        self.assertEqual([(name, len(found)) for name, found in rules.items()], [("a", 1),
                                                                                 ("b", 2)])


if __name__ == "__main__":
    unittest.main()
