"""Pages of formulations explain, and what their texts say of cases agrees with the verdicts."""
import re
import unittest

from harness.tools.kit.program import ROOT, TRUTHS, ProgramTest, run
from reports import formulation, mathml
from reports.site import Site, file_of
from reports.verdicts import UNJUDGED

# In its text a formulation is good for cases with these verdicts at worst.
RIGHT = ("pass", "low order", "undecided", "biased", "biased, as predicted")


def texts():
    """{formulation: its text} of all that have one."""
    return {path.stem: path.read_text(encoding="utf-8")
            for path in sorted((ROOT / "elements").glob("*.md")) if path.stem != "README"}


def claims(text):
    """[(is it for them?, cases named)] of the bullets on when to choose a formulation."""
    said = dict(formulation.sections(text))[formulation.CHOICE]
    bullets = re.findall(r"^\* \*\*(For|Not for)\*\* (.*)$", said, flags=re.M)
    return [(kind == "For", re.findall(r"`(\w+)`", words)) for kind, words in bullets]


class Texts(unittest.TestCase):

    def test_every_formulation_has_one(self):
        found = {path.stem for path in (ROOT / "elements").glob("*.c")}
        self.assertEqual(set(texts()), found)

    def test_none_is_needed(self):
        self.assertEqual(formulation.explanation_of("a_new_one", {}), [])

    def test_equations(self):
        made = mathml.convert(r"\bar e_1' = \frac{1}{2} (x^2 - \sum_k N_k) \mathbf{n} < 3")
        for part in ("<mfrac><mn>1</mn><mn>2</mn></mfrac>", "<mo>−</mo>", "<munder><mo>∑</mo>",
                     "<mo>&lt;</mo>", ">′</mo>", "𝐧"):
            self.assertIn(part, made)

    def test_what_is_not_known_is_named(self):
        for wrong, culprit in ((r"\oint x", r"\oint"), ("{x", "}"), ("x & y", "&")):
            with self.assertRaises(mathml.Unknown) as caught:
                mathml.convert(wrong)
            self.assertIn(culprit, str(caught.exception))

    def test_words_that_name_a_page(self):
        words = formulation.rendered("see `elastica`, `x`")
        made = formulation.linked(words, {"elastica": "e.html"})
        self.assertIn('<a href="e.html">elastica</a>', made)
        self.assertIn("<code>x</code>", made)


class Pages(ProgramTest):

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        named = {c for text in texts().values() for _, cases in claims(text) for c in cases}
        named &= {path.stem for path in (ROOT / "cases").glob("*.[cy]*")}
        run("verify", "-k", " or ".join(f"{name}/default" for name in sorted(named)),
            "-o", folder / "results.h5")
        cls.site = Site(folder / "results.h5", TRUTHS, folder / "site")
        cls.known = formulation.gather(cls.site)
        for task in formulation.tasks(cls.site):
            task()
        cls.pages = {key: (folder / "site" / f"{file_of(key)}.html").read_text(encoding="utf-8")
                     for key in cls.site.styles.order}

    def test_texts_agree_with_the_verdicts(self):
        """A case that a text is for is right there; one that it is not for is wrong, or not run."""
        for name, text in texts().items():
            found = {c.name: s for c, _, s in formulation.defaults(self.site.cases, name)}
            self.assertGreater(len(claims(text)), 0, name)
            for is_for, cases in claims(text):
                for case in (c for c in cases if c not in texts()):
                    self.assertIn(case, found, name)
                    worst = formulation.standing(found[case])
                    right = worst is not None and worst.verdict in RIGHT
                    self.assertEqual(right, is_for, f"{name}, {case}: {worst}")

    def test_who_offers_all(self):
        """A text says so of those that are run on everything, and of no others."""
        offers = {key: set(row["offers"].split(", ")) for key, row in self.known.declared.items()}
        everything = set().union(*offers.values())
        for name, text in texts().items():
            self.assertEqual("all the physics" in text, offers[name] == everything, name)

    def test_source_orders_and_rules(self):
        for key, page in self.pages.items():
            declared = self.known.declared[key]
            self.assertIn(declared["source"].split(";")[0].replace("&", "&amp;"), page)
            order = f"{declared['statics_least']} to {declared['statics_highest']} in statics"
            self.assertIn(order, page)
            shown = {r.verdict.finding for r in self.known.rows
                     if r.formulation == key and r.verdict.finding}
            for rule in shown:
                self.assertIn(f'href="ledger.html#{rule}"', page, key)
        self.assertIn("ledger.html#J66-shear", self.pages["beamw"])

    def test_equations_are_drawn(self):
        for key, page in self.pages.items():
            self.assertGreater(page.count("<math"), 1, key)
            for left in ("$", "\\", "EQUATION"):
                self.assertNotIn(left, page, key)

    def test_what_is_measured_of_the_choice(self):
        """Cases where it is the cheapest, and where it is wrong, from the data."""
        self.assertRegex(self.pages["beamw_first"],
                         r'however many elements[^\n]*>c_column</a> \(buckling_load, \+32 %\)')
        self.assertNotIn("however many elements, at the", self.pages["collocation"])
        for key, page in self.pages.items():
            cheapest = [c for (c, level), answer in self.known.ways.items()
                        if level == 0.01 and any(w.key == key for w in answer.best)]
            said = re.search("cheapest to 1 % among those that pass(.*)", page).group(1)
            self.assertEqual(re.findall(r">(\w+)</a>", said), sorted(cheapest), key)

    def test_options_share_the_text(self):
        self.assertIn("<h2>Theory</h2>", self.pages["beamw:mass=lumped"])

    def test_verdicts(self):
        """The page's sum is that of its verdicts."""
        for key, page in self.pages.items():
            number = sum(r.formulation == key and r.standing != "alias"
                         and r.verdict.verdict not in UNJUDGED for r in self.known.rows)
            if number:
                self.assertIn(f"of {number} verdicts", page)


if __name__ == "__main__":
    unittest.main()
