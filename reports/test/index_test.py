"""The first page, the navigation bar, the glossary and the pages of formulations must agree with the results."""
import re
import sys
import tempfile
import unittest

import h5py

from harness.tools.kit.program import ProgramTest, ROOT, TRUTHS, drawn, report, run
from harness.tools.kit.scenes import LEAF
from reports import data, formulation, glossary, index, mathml, navigation
from reports.site import Site, file_of
from reports.test.results import case, series
from reports.verdicts import UNJUDGED


class Agreed(unittest.TestCase):

    def tried(self, key, limit, errors):
        found = series(key, [data.Verdict("u", "no truth", limit=limit, model_truth=2.0,
                                          model_truth_kind="agreement", model_error=limit / 2 - 1)])
        clock = data.Clock(0, 1, 1, 1, 1)
        found.meshes = [data.Mesh(2**i, "ok", "", clock, 8, 4, "", {}, model_errors={"u": e})
                        for i, e in enumerate(errors)]
        return found

    def rows(self, *tries):
        one = case("one", *tries)
        one.points[0].units = {"u": "m"}
        return index.rows_agreed([one], 0.01)

    def test_limits_and_meshes(self):
        row, = self.rows(self.tried("a", 2.0, (0.5, 0.002, 0.02, 0.001)),
                         self.tried("b", 2.1, (0.5, 0.1, 0.06, 0.05)),
                         self.tried("c", 2.0, (0.1, 0.005, 0.001, 0)))
        self.assertEqual((row.value, row.unit, row.within(0.01)), (2.0, "m", ["a", "c"]))
        self.assertEqual((row.farthest, row.fewest), ("b", (2, ["c"])))
        self.assertEqual(row.meshes, {"a": 8, "c": 2})

    def test_the_same_everywhere(self):
        row, = self.rows(self.tried("a", 2.0, (0,)), self.tried("b", 2.0, (0,)))
        self.assertEqual((row.farthest, row.fewest), (None, (1, ["a", "b"])))

    def test_what_has_a_truth_is_judged(self):
        one = self.tried("a", 2.0, (0,))
        one.verdicts[0].truth = 2.0
        self.assertEqual(self.rows(one), [])


class Small(ProgramTest):

    def whole(self, page):
        self.assertEqual(re.findall(r"<(table|ul|figure)[^>]*>\s*</\1>", page), [])
        return page

    def test_a_scene_without_truths(self):
        scene, results, site = (self.folder / name for name in ("mine.yaml", "mine.h5", "site"))
        scene.write_text(LEAF, encoding="utf-8")
        run("verify", "--scene", scene, "-f", "collocation", "-f", "beamw_consistent", "-o", results)
        self.assertEqual(report(results, site).returncode, 0)
        page = self.whole((site / "index.html").read_text(encoding="utf-8"))
        self.assertIn("No quantity in these results has a reference value", page)
        self.assertIn("limits on which formulations agree", page)
        self.assertNotIn("<figure>", page)
        self.assertIn("No quantity in these results has both", self.whole(
            (site / "profiles.html").read_text(encoding="utf-8")))

    def test_one_mesh(self):
        scene, results, site = (self.folder / name for name in ("mine.yaml", "mine.h5", "site"))
        scene.write_text(LEAF + "meshes: [4]\n", encoding="utf-8")
        run("verify", "--scene", scene, "-f", "collocation", "-f", "beamw", "-o", results)
        done = report(results, site)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("uncertainty unknown", (site / "mine.html").read_text(encoding="utf-8"))

    def test_of_one_solution(self):
        results, site = self.folder / "one.h5", self.folder / "site"
        run("solve", "elastica", "-f", "collocation", "-n", "2", "--shapes", "-o", results)
        done = report(results, site)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("Outcome.", (site / "index.html").read_text(encoding="utf-8"))

    def test_whole_or_none(self):
        site = drawn(self.folder, "-k", "warping_torsion/default", "-f", "collocation")
        before = {file.name: file.read_bytes() for file in site.iterdir()}
        code = ("import sys\nfrom reports import glossary, pages\n"
                "glossary.tasks = lambda site: [lambda: 1/0]\n"
                "pages.build(sys.argv[1], sys.argv[2], sys.argv[3])\n")
        for folder in (site, self.folder / "new"):
            done = run("-B", "-c", code, self.folder / "results.h5", TRUTHS, folder, program=sys.executable, cwd=ROOT)
            self.assertIn("ZeroDivisionError", done.stderr)
        self.assertEqual({file.name: file.read_bytes() for file in site.iterdir()}, before)
        self.assertEqual(sorted(file.name for file in self.folder.iterdir()), ["results.h5", "site"])

    def test_one_formulation(self):
        site = drawn(self.folder, "-k", "warping_torsion/default", "-f", "collocation")
        page = self.whole((site / "index.html").read_text(encoding="utf-8"))
        self.assertIn('href="warping_torsion.html"', page)
        self.assertNotIn("<figure>", page)
        self.assertIn("only one formulation was run", self.whole(
            (site / "profiles.html").read_text(encoding="utf-8")))

    def test_two_formulations(self):
        site = drawn(self.folder, "-k", "warping_torsion/default", "-f", "collocation", "-f",
                     "beamw_vlasov")
        page = self.whole((site / "index.html").read_text(encoding="utf-8"))
        self.assertEqual(page.count("<figure>"), 1)
        answers = page[page.index('id="answers"'):page.index("</section>")]
        self.assertRegex(answers, r'<i>n&nbsp;=&nbsp;\d+</i> <i class="pass" title="pass">✓</i>')
        self.assertIn('<th class="n">pass: within&nbsp;0.1\u00a0%</th>', page)
        for level in ("10", "1", "0.1", "0.01"):
            self.assertIn(f">{level} %</label>", answers)
        table = (site / "profiles.csv").read_text(encoding="utf-8").splitlines()
        self.assertEqual(table[0], "picture,level,factor,beamw_vlasov,collocation")
        self.assertEqual(len({len(line.split(",")) for line in table}), 1)


PAGES = [("index.html", "beamwork"), ("deviations.html", "deviations"), ("claims.html", "claims"),
         ("errata.html", "errata"), ("cases.html", "all cases"),
         ("environment.html", "environment"), ("a_new_page.html", "new")]


class Bar(unittest.TestCase):

    def setUp(self):
        self.groups = navigation.groups(PAGES)

    def test_groups(self):
        self.assertEqual([g.title for g in self.groups],
                         ["beamwork", "Cases", "Papers & errata", "Deviations", "About"])
        self.assertEqual(self.groups[2].pages,
                         (("claims.html", "claims"), ("errata.html", "errata")))

    def test_a_page_of_no_group(self):
        self.assertIn(("a_new_page.html", "new"), self.groups[-1].pages)

    def test_where_a_page_is(self):
        def title(name):
            found = navigation.group_of(name, self.groups, {"elastica"})
            return found and found.title

        self.assertEqual(title("errata.html"), "Papers & errata")
        self.assertEqual(title("elastica.html"), "Cases")
        self.assertIsNone(title("formulation_beamw.html"))


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


# Verdicts with which a formulation may be recommended for a case.
RIGHT = ("pass", "low order", "undecided", "biased", "biased, as predicted")


def texts():
    return {path.stem: path.read_text(encoding="utf-8")
            for path in sorted((ROOT / "elements").glob("*.md")) if path.stem != "README"}


def claims(text):
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
        named &= {path.stem for path in (ROOT / "cases" / "benchmarks").glob("*.[cy]*")}
        run("verify", "-k", " or ".join(f"{name}/default" for name in sorted(named)),
            "-o", folder / "results.h5")
        cls.site = Site(folder / "results.h5", TRUTHS, folder / "site")
        cls.known = formulation.gather(cls.site)
        for task in formulation.tasks(cls.site):
            task()
        cls.pages = {key: (folder / "site" / f"{file_of(key)}.html").read_text(encoding="utf-8")
                     for key in cls.site.styles.order}

    def test_texts_agree_with_the_verdicts(self):
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
                self.assertIn(f'href="deviations.html#{rule}"', page, key)
        self.assertIn("deviations.html#J66-shear", self.pages["beamw"])

    def test_equations_are_drawn(self):
        for key, page in self.pages.items():
            self.assertGreater(page.count("<math"), 1, key)
            for left in ("$", "\\", "EQUATION"):
                self.assertNotIn(left, page, key)

    def test_what_is_measured_of_the_choice(self):
        self.assertRegex(self.pages["beamw_first"],
                         r'with any number of elements[^\n]*>c_column</a> \(buckling_load, \+32 %\)')
        self.assertNotIn("with any number of elements at the", self.pages["collocation"])
        for key, page in self.pages.items():
            cheapest = [c for (c, level), answer in self.known.ways.items()
                        if level == 0.01 and any(w.key == key for w in answer.best)]
            said = re.search("cheapest to 1 % among those that pass(.*)", page).group(1)
            self.assertEqual(re.findall(r">(\w+)</a>", said), sorted(cheapest), key)

    def test_options_share_the_text(self):
        self.assertIn("<h2>Theory</h2>", self.pages["beamw:mass=lumped"])

    def test_verdicts(self):
        for key, page in self.pages.items():
            number = sum(r.formulation == key and r.standing != "alias"
                         and r.verdict.verdict not in UNJUDGED for r in self.known.rows)
            if number:
                self.assertIn(f"of {number} verdicts", page)


if __name__ == "__main__":
    unittest.main()
