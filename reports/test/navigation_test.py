"""The bar and the words: pages in their groups, words linked where the glossary has them."""
import tempfile
import unittest

import h5py

from harness.tools.kit.program import TRUTHS
from reports import data, glossary, navigation

PAGES = [("index.html", "beamwork"), ("ledger.html", "ledger"), ("claims.html", "claims"),
         ("errata.html", "errata"), ("cases.html", "all cases"),
         ("environment.html", "environment"), ("a_new_page.html", "new")]


class Bar(unittest.TestCase):

    def setUp(self):
        self.groups = navigation.groups(PAGES)

    def test_groups(self):
        self.assertEqual([g.title for g in self.groups],
                         ["beamwork", "Cases", "Papers & errata", "Ledger", "About"])
        self.assertEqual(self.groups[2].pages,
                         (("claims.html", "claims"), ("errata.html", "errata")))

    def test_a_page_of_no_group(self):
        """It is not lost."""
        self.assertIn(("a_new_page.html", "new"), self.groups[-1].pages)

    def test_where_a_page_is(self):
        def title(name):
            found = navigation.group_of(name, self.groups, {"elastica"})
            return found and found.title

        self.assertEqual(title("errata.html"), "Papers & errata")
        self.assertEqual(title("elastica.html"), "Cases")
        self.assertIsNone(title("formulation_beamw.html"))  # no page lists formulations here


class Words(unittest.TestCase):

    def test_links(self):
        term = glossary.linker(TRUTHS)
        self.assertEqual(str(term("wrong limit")),
                         '<a class="term" href="glossary.html#wrong-limit">wrong limit</a>')
        self.assertIn('#verdict">Verdicts</a>', str(term("Verdicts", "verdict")))
        self.assertEqual(str(term("<no such word>")), "&lt;no such word&gt;")

    def test_truths_without_words(self):
        with tempfile.TemporaryDirectory() as folder:
            path = f"{folder}/truths.h5"
            with h5py.File(path, "w") as file:
                file.create_group("truths")
            self.assertEqual(data.read_glossary(path), [])
            self.assertEqual(str(glossary.linker(path)("verdict")), "verdict")

    def test_other_names(self):
        known = glossary.places([{"term": "wrong limit", "also": "wrong", "see": ""}])
        self.assertEqual(known, {"wrong limit": "wrong-limit", "wrong": "wrong-limit"})

    def test_anchors_differ(self):
        places = [glossary.anchor(row["term"]) for row in glossary.terms(TRUTHS)]
        self.assertGreater(len(places), 100)
        self.assertEqual(len(set(places)), len(places))

    def test_groups_keep_all(self):
        rows = [{"term": t, "group": g} for t, g in (("a", "new"), ("b", "verdicts"), ("c", "new"))]
        self.assertEqual([(g, len(found)) for g, found in glossary.grouped(rows)],
                         [("verdicts", 1), ("new", 2)])


if __name__ == "__main__":
    unittest.main()
