"""The page of certificates: what is drawn, what is left out, names from files."""
import unittest

from harness.records.test.stored import put_experiment
from harness.tools.kit.program import ProgramTest, drawn, run
from reports import certificates, experiments


class Site:
    """What the page asks of a site."""

    def __init__(self, folder, keys):
        self.results = folder / "results.h5"
        self.styles = type("Styles", (), {"order": keys})


class Words(unittest.TestCase):

    def test_percent(self):
        self.assertEqual([certificates.percent(e) for e in (None, 1e-10, -0.012, 2e-7, 30)],
                         ["–", "exact", "1.2 %", "2e-05 %", "3e+03 %"])

    def test_order(self):
        one = {"least": 2, "highest": 4, "order": 3.96, "error": [0.1, 0.01]}
        self.assertEqual(certificates.order(one), "4.0, declared 2 to 4")
        self.assertEqual(certificates.order({**one, "order": None, "error": [1e-12, 1e-13]}),
                         "exact, declared 2 to 4")
        self.assertEqual(certificates.order({**one, "order": None, "error": [0.1, None]}),
                         "none seen, declared 2 to 4")

    def test_standing(self):
        def of(*outcomes):
            return certificates.standing({"claims": [{"outcome": o} for o in outcomes]})
        self.assertEqual(of("not claimed"), ("not claimed", 0))
        self.assertEqual(of("not claimed", "holds", "holds"), ("holds", 2))
        self.assertEqual(of("holds", "broken"), ("broken", 2))


class Present(ProgramTest):

    def test_only_with_certificates_of_what_was_run(self):
        site = Site(self.folder, ["beamw:mass=lumped", "collocation"])
        self.assertFalse(certificates.present(site))
        run("element-test", "beamw", "sheet_second", "-o", site.results)
        self.assertEqual(certificates.names(site), {"beamw"})
        self.assertFalse(certificates.present(Site(self.folder, ["collocation"])))


class Page(ProgramTest):

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        path = folder / "results.h5"
        run("element-test", "beamw", "geometrically_exact", "-o", path)
        record = experiments.read(path, "element-test")
        record["formulations"][1].update(summary="<b>&", kept=False)
        claim = next(c for c in record["claims"] if c["formulation"] == "geometrically_exact")
        claim.update(outcome="broken", sentence="J: <i> is wrong")
        path.unlink()
        put_experiment(path, "element-test", record)
        site = drawn(folder, "-k", "elastica/default", "-f", "beamw", "-f", "geometrically_exact")
        cls.page = (site / "certificates.html").read_text(encoding="utf-8")
        cls.formulation = (site / "formulation_beamw.html").read_text(encoding="utf-8")

    def test_all_is_there(self):
        for words in ('id="beamw"', 'id="geometrically_exact"', "pure torsion", "exact",
                      "quarter ring", "declared 2 to 4", "J is the derivative of the strains"):
            self.assertIn(words, self.page)
        self.assertEqual(self.page.count("<figure"), 2)

    def test_broken_is_told(self):
        self.assertIn("It is broken by geometrically_exact.", " ".join(self.page.split()))
        self.assertIn("J: &lt;i&gt; is wrong", self.page)

    def test_names_are_escaped(self):
        self.assertIn("&lt;b&gt;&amp;", self.page)
        self.assertNotIn("<b>&", self.page)

    def test_linked(self):
        self.assertIn('href="certificates.html#beamw"', self.formulation)


if __name__ == "__main__":
    unittest.main()
