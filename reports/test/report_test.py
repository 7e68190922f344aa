"""Reports must contain all pages, with links that resolve, and show every quantity, parameter and reference value."""
import html
import html.parser
import json
import math
import re
import unittest
import xml.etree.ElementTree

from harness.tools.kit.program import ProgramTest, TRUTHS, drawn, report, run
from harness.tools.kit.scenes import LEAF
from reports import answers, case, data, film, shapes
from reports.figures import paper, plots
from reports.figures.plots import MOST_CURVES, OPEN
from reports.figures.style import Styles
from reports.test import results


MESHES = {"parameters": "shear=0", "meshes": [8, 256]}
EXPERIMENTS = [
    {
        "kind": "finer",
        "what": "more elements",
        "formulation": "beamw",
        "error": 0.1,
        "gone": False,
        "limit": 1.1,
        "limit_uncertainty": 1e-9,
        "against": "truth",
        "why": "",
        **MESHES,
    },
    {
        "kind": "without",
        "what": "shear",
        "formulation": "beamw",
        "error": 1e-9,
        "gone": True,
        "limit": 1.0,
        "limit_uncertainty": 0.0,
        "against": "collocation:stages=8",
        "why": "",
        **MESHES,
    },
    {
        "kind": "instead",
        "what": "mass matrix",
        "formulation": "beamw:mass=lumped",
        "error": None,
        "gone": False,
        "why": "no answer within 60 s",
        **MESHES,
    },
]
STUDY = {
    "finding": "a_rule_of_the_past",
    "case": "elastica",
    "parameters": "shear=1",
    "formulation": "beamw",
    "quantity": "w",
    "verdict": "wrong limit, as predicted",
    "error": 0.1,
    "predicted": 1.1,
    "reason": "",
    "experiments": EXPERIMENTS,
}
BESIDE = {
    "faults.json": {
        "killed": 1,
        "survived": 1,
        "mutants": [{
            "fault": "a sign", "check": "test x", "expected": "1", "exit": "0", "killed": k
        } for k in (False, True)],
    },
    "fuzz.json": {
        "executions": 12,
        "findings": 1,
        "inputs": [{"input": "words", "executions": 12, "finding": True}],
    },
    "causes.json": {
        "minutes": 1,
        "not_run": 3,
        "studies": [STUDY, {**STUDY, "parameters": "", "error": None, "reason": "diverged"}],
    },
}


class Links(html.parser.HTMLParser):

    def __init__(self):
        super().__init__()
        self.found = []

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name in ("href", "src") and not value.startswith(("data:", "http")):
                self.found.append(value)


class Report(ProgramTest):

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        for name, content in BESIDE.items():
            (folder / name).write_text(json.dumps(content), encoding="utf-8")
        cls.site = drawn(folder, "-k", "warping_torsion or roll_up")

    def test_pages(self):
        for name in (
                "index.html",
                "errata.html",
                "claims.html",
                "deviations.html",
                "causes.html",
                "papers.html",
                "environment.html",
                "convergence.html",
                "cases.html",
                "formulations.html",
                "glossary.html",
                "warping_torsion.html",
                "formulation_beamw.html",
        ):
            self.assertTrue((self.site / name).is_file(), name)

    def test_links_resolve(self):
        for page in self.site.glob("*.html"):
            links = Links()
            links.feed(page.read_text(encoding="utf-8"))
            for link in links.found:
                name, _, anchor = link.partition("#")
                target = self.site / name if name else page
                self.assertTrue(target.is_file(), f"{page.name}: {link}")
                if anchor:
                    self.assertIn(f'id="{anchor}"', target.read_text(encoding="utf-8"),
                                  f"{page.name}: {link}")

    def test_nothing_is_announced(self):
        for name in ("stability.html", "newton.html", "rotation.html", "mechanisms.html"):
            self.assertFalse((self.site / name).exists(), name)
        for page in self.site.glob("*.html"):
            text = page.read_text(encoding="utf-8")
            if page.name != "environment.html":
                self.assertNotRegex(text, "then <code>make report|hold no ", page.name)
        about = (self.site / "environment.html").read_text(encoding="utf-8")
        self.assertIn("<code>make stress</code>", about)
        self.assertNotIn("<code>make lab L=causes</code>", about)

    def test_bar(self):
        for page, title in (("deviations.html", "Deviations"), ("warping_torsion.html", "Cases"),
                            ("formulation_beamw.html", "Formulations"), ("index.html", "beamwork")):
            text = (self.site / page).read_text(encoding="utf-8")
            bar = re.search('<nav class="bar" [^>]*>(.*?)</nav>', text, re.S).group(1)
            titles = re.findall(r'<a href="[^"]+"([^>]*)>([^<]+)</a>', bar)
            self.assertLessEqual(sum(len(t.split()) for _, t in titles), 13)
            self.assertEqual([t for more, t in titles if "aria-current" in more], [title])

    def test_entities(self):
        for page in self.site.glob("*.html"):
            markup = re.sub(r"(?s)<(script|style).*?</\1>", "", page.read_text(encoding="utf-8"))
            broken = re.search(r"[^&](nbsp|shy|amp|lt|gt);", markup)
            self.assertIsNone(broken, f"{page.name}: {broken}")

    def test_size(self):
        for page in self.site.glob("*.html"):
            self.assertLess(page.stat().st_size, 500_000, page.name)

    def test_figures_are_drawn(self):
        page = (self.site / "roll_up.html").read_text(encoding="utf-8")
        self.assertGreater(page.count("<polyline"), 8)
        files = list(self.site.glob("*.svg"))
        self.assertGreater(len(files), 0)
        for file in files:
            self.assertIn("<polyline", file.read_text(encoding="utf-8"))
            xml.etree.ElementTree.parse(file)

    def test_foreign_file(self):
        done = report(TRUTHS, self.folder / "none")
        self.assertEqual(done.returncode, 4)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1)


SWINGS = LEAF.replace("young: 210e9", "density: 7800, young: 210e9") + """
analyses:
  swing: {motion: {stations: [0.005, 0.01], step: 1e-3}}
quantities:
  tip: {displacement: {analysis: swing, node: tip, component: uy, take: max}}
"""


class SceneReport(ProgramTest):

    def test_without_truths(self):
        scene, results, site = (self.folder / name for name in ("mine.yaml", "mine.h5", "site"))
        scene.write_text(LEAF, encoding="utf-8")
        done = run("verify", "--shapes", "--scene", scene, "-f", "collocation", "-f", "beamw_consistent",
                   "-o", results)
        self.assertEqual(done.returncode, 3, done)
        drawn = report(results, site)
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        page = (site / "mine.html").read_text(encoding="utf-8")
        self.assertNotIn("Source:", page)
        self.assertNotIn("beamwork scene", page, "a command for scenes that the program knows by name")
        self.assertTrue((site / "picture_mine.svg").is_file())
        # P L^3/3EI + P L/(k G A)
        tip = 0.1 ** 3 / (3 * 210e9 * 50e-3 * 0.5e-3 ** 3 / 12)
        limits = page[page.index("Limits of quantities"):page.index("<summary>Verdicts")]
        found = [float(text) for text in re.findall(r'class="n">([0-9.e-]+) ± ', limits)]
        self.assertEqual(sum(abs(value / tip - 1) < 1e-3 for value in found), 2, found)
        self.assertIn("<details open><summary>Limits of quantities without a reference value", page)

    def test_what_is_assumed(self):
        scene, results, site = (self.folder / name for name in ("bar.yaml", "bar.h5", "site"))
        text = re.sub("rectangle: {[^}]*}", "constants: {A: 1e-3, Iy: 2e-6, Iz: 1e-6, It: 1e-8, Iw: 0}",
                      LEAF, count=1)
        self.assertNotEqual(text, LEAF)
        scene.write_text(text, encoding="utf-8")
        done = run("verify", "--scene", scene, "-f", "beamw", "-o", results)
        self.assertEqual(done.returncode, 3, done)
        drawn = report(results, site)
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        page = (site / "bar.html").read_text(encoding="utf-8")
        self.assertIn("<p class=\"small\">Not known: shear of section leaf is not given by its constants and"
                      " is assumed to be zero.</p>", page)

    def test_motion_without_summary(self):
        scene, results, site = (self.folder / name for name in ("mine.yaml", "mine.h5", "site"))
        scene.write_text(SWINGS, encoding="utf-8")
        done = run("verify", "--shapes", "--scene", scene, "-f", "beamw", "-o", results)
        self.assertEqual(done.returncode, 3, done)
        drawn = report(results, site)
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        page = (site / "motions.html").read_text(encoding="utf-8")
        self.assertRegex(page, r"<dd>[A-Z]")
        self.assertTrue((site / "motion_mine.html").is_file())
        name, summary, point = film.chosen(results, None)
        said = film.words_of(summary, shapes.read_file(results, name, point))
        self.assertRegex(said, "^0 to 0.01 s, computed with beamw")

    def test_what_has_a_truth_is_left_out(self):
        verdicts = [
            data.Verdict("u", "no truth"),
            data.Verdict("v", "no truth"),
            data.Verdict("w", "skip")
        ]
        judged = [
            data.Verdict("u", "no truth"),
            data.Verdict("v", "pass"),
            data.Verdict("w", "no truth")
        ]
        series = [
            data.Series(key, "", "", "", [], of) for key, of in (("a", verdicts), ("b", judged))
        ]
        limits = case.limits_of(data.Point("default", "", series, {"u": "m", "v": "m", "w": "m"}))
        self.assertEqual([(q, [key for key, _ in found]) for q, found in limits],
                         [("u", ["a", "b"]), ("w", ["b"])])


class Site:
    def __init__(self):
        self.said, self.styles, self.paper = [], Styles([]), paper.Paper("", ())

    def points(self, key, columns, rows, title):
        self.said.append({"f": key, "t": title, "c": columns, "r": rows})
        look = Styles.of(key)
        return {**look, "gid": f"{look['gid']}|{len(self.said) - 1}"}


def series(key, errors, truth=2.0, uncertainty=2e-6):
    judged = data.Verdict("u", "pass", truth=truth, truth_uncertainty=uncertainty,
                          truth_kind="exact", tolerance=1e-3 * truth)
    meshes = [data.Mesh(2**i, "ok", "", data.Clock(0, 1e-3, 1e-3 * 2**i, 1e-3 * 2**i, 1), 8, 4, "",
                        {"strain_evaluations": 1, "stress_evaluations": 1},
                        values={"u": truth * (1 + e)}, errors={"u": e})
              for i, e in enumerate(errors)]
    return data.Series(key, "", "", "", meshes, [judged])


def point(*found):
    return data.Point("default", "", list(found), {"u": "m"}, meanings={"u": "displacement"})


class Figures(unittest.TestCase):

    def test_below_the_digits(self):
        site, own = Site(), point(series("beamw", (1e-2, 1e-4, 1e-8, -1e-9)))
        image = plots.errors_figure(site, own, "u", own.series, ("elements",), "f")
        self.assertIn(OPEN, html.unescape(image.markup))
        full, = re.findall(r'<polyline stroke="none" points="([^"]*)" style="([^"]*)"',
                           image.markup[:image.markup.index("data-l")])
        lost = re.search(r'points="([^"]+)" stroke="none"[^>]* style="([^"]*)"', image.markup)
        self.assertEqual([len(full[0].split()), len(lost[1].split())], [2, 2])
        self.assertEqual(len({p.split(",")[1] for p in lost[1].split()}), 1)
        self.assertNotEqual(full[1], lost[2])
        self.assertIn('fill-opacity=".07"', image.markup)

    def test_above_the_digits(self):
        own = point(series("beamw", (1e-2, 1e-4)))
        image = plots.errors_figure(Site(), own, "u", own.series, ("elements",), "f")
        self.assertNotIn(OPEN, html.unescape(image.markup))

    def priced(self, own, repeats=1):
        for m in (m for s in own.series for m in s.meshes):
            m.cost, m.clock.repeats = 5e-3 * m.n, repeats
        return own

    def test_run_time_of_rounds_or_cost(self):
        """Times of single runs are never compared: the cost is drawn, under its name."""
        def own():
            return point(series("beamw", (1e-2, 1e-4)))
        for found, name, of, words in (
                (own(), "time", 1e-3, "run time [ms] of one run"), (self.priced(own()), "cost", 5e-3, "cost [ms]: counted work"),
                (self.priced(own(), 7), "time", 1e-3, "run time [ms], fastest of 7 rounds")):
            measure = answers.measure_of(found)
            self.assertEqual((measure.name, measure.of(found.series[0].meshes[0])), (name, of))
            self.assertIn(words, measure.words)
            site = Site()
            image = plots.errors_figure(site, found, "u", found.series, ("time",), "f")
            self.assertIn(words, html.unescape(image.markup))
            self.assertIn(f'"{name} [s]"', image.points)
            for column in ("n", "order", "verdict"):
                self.assertIn(f'"{column}"', image.points)

    def test_front_with_other_programs(self):
        own = self.priced(point(series("beamw", (1e-2, 1e-4))))
        fast = plots.Beside("P, x", [(1e-3, 1e-3, (1, 1e-3))], ("n", "error"), {"color": "#000000", "marker": "o", "gid": "f|P, x"})
        self.assertEqual(plots.front_line(own, "u"), [(5.0, 1e-2), (10.0, 1e-2), (10.0, 1e-4)])
        self.assertEqual(plots.front_line(own, "u", [fast]), [(1.0, 1e-3), (10.0, 1e-3), (10.0, 1e-4)])
        image = plots.errors_figure(Site(), own, "u", own.series, ("time",), "f", beside=[fast])
        self.assertIn('data-f="P, x"', image.markup)
        self.assertIn('data-off=""', image.markup)

    def test_limits_beside_the_meshes(self):
        """The extrapolated limit has a mark with its error, and a bar over its uncertainty."""
        own = point(series("beamw", (1e-2, 1e-4)), series("beamw_first", (1e-1, 1e-2)))
        found = own.series[0].verdicts[0]
        found.limit, found.limit_uncertainty, found.error, found.order = 2.0002, 1e-4, 1e-4, 2.04
        self.assertEqual(plots.limit_error(own, own.series[0], "u")[:2], (1e-4, 5e-5))
        self.assertIsNone(plots.limit_error(own, own.series[1], "u"))
        image = plots.convergence_figure(Site(), own, "u", own.series, "f")
        for words in (">∞</text>", "beamw, order 2", ">beamw_first</text>", "tolerance 0.1 %"):
            self.assertIn(words, image.markup)
        self.assertIn('"limit [m]","uncertainty","error","order","verdict"', image.points)
        bar, = re.findall(r'points="([^"]*)" stroke="[^"]*" stroke-opacity="0.35" stroke-width="5"', image.markup)
        (x, low), (x_high, high) = (map(float, p.split(",")) for p in bar.split())
        self.assertEqual(x, x_high)
        self.assertGreater(low, high)

    def test_eight_at_most(self):
        names = [f"f{i}" for i in range(7)]
        own = point(*[series(key, (1e-2, 1e-4)) for key in names],
                    series("sheet_third_printed", (1e-2, 1e-5)),
                    series("f0:mass=lumped", (1e-3, 1e-6)), series("f1:mass=lumped", (0.1, 0.1)))
        shown, further = plots.leading(own, "u")
        self.assertEqual([s.key for s in shown], [*names, "f0:mass=lumped"])
        self.assertEqual([s.key for s in further], ["sheet_third_printed", "f1:mass=lumped"])
        many = point(*[series(f"f{i}", (1e-2, 10.0**-i)) for i in range(12)])
        shown, further = plots.leading(many, "u")
        self.assertEqual(len(shown), MOST_CURVES)
        self.assertEqual({s.key for s in further}, {f"f{i}" for i in range(1, 5)})

    def test_no_errors(self):
        own = point(series("beamw", (math.nan, math.nan)))
        self.assertIsNone(plots.errors_figure(Site(), own, "u", own.series,
                                              ("time",), "f"))


class Truths(unittest.TestCase):

    def test_digits(self):
        self.assertEqual(case.digits_of(2.0, 2e-6), 6)
        self.assertEqual(case.digits_of(2.0, 0), case.MOST_DIGITS)
        self.assertEqual(case.digits_of(2.0, 3.0), 1)

    def test_each_truth_once(self):
        found = case.truths_of(point(series("a", [1e-3]), series("b", [1e-2]),
                                     series("c", [1e-2], truth=3.0)), "u")
        self.assertEqual([t.value for t in found], ["2", "3"])

    def test_matrix(self):
        other = results.series("b", [results.verdict("u", "wrong limit", truth=1.0, error=0.1,
                                                     limit=1.1)])
        shown, rows = case.matrix(point(series("a", [1e-3]), other))
        self.assertEqual([s.key for s in shown], ["a", "b"])
        (name, cells), = rows
        self.assertEqual((name, [c.sign for c in cells]), ("u", ["✓", "≠"]))
        self.assertEqual(cells[0].words, "")
        self.assertIn("+10 %", cells[1].words)

    def test_pages_of_their_own(self):
        few = results.case("c", results.series("a", [results.verdict("u", "pass")]))
        few.points.append(few.points[0])
        self.assertEqual(case.page_of(few, 1), "c.html#default")
        verdicts = [results.verdict("u", "pass")] * (case.MOST_ROWS + 1)
        few.points.append(data.Point("12ab", "x=1", [results.series("a", verdicts)], {}))
        self.assertEqual(case.page_of(few, 2), "c_12ab.html")
        self.assertEqual(case.page_of(few, 0), "c.html#default")


class Pages(ProgramTest):

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        done = run("verify", "-k", "elastica or warping_torsion/default or lee_frame/default",
                   "-f", "beamw", "-f", "collocation", "-o", folder / "r.h5")
        assert done.returncode == 0, done.stderr
        drawn = report(folder / "r.h5", folder / "site")
        assert drawn.returncode == 0, drawn.stderr
        cls.cases = data.read_results(str(folder / "r.h5"))[1]
        cls.pages = {c.name: (folder / "site" / f"{c.name}.html").read_text(encoding="utf-8")
                     for c in cls.cases}

    def test_order_of_the_parts(self):
        """Error against run time is the first picture."""
        for name, page in self.pages.items():
            parts = ("<h2>Error against run time", f'id="{name}_default_time"', "<h2>Mesh convergence",
                     f'id="{name}_default_elements"', f'id="{name}_scene"', "<h2>Quantities")
            places = [page.index(part) for part in parts if part in page]
            self.assertEqual(places, sorted(places), name)
            self.assertIn(parts[4], page)
            if "quantities with a reference value" in page:
                self.assertEqual(len(places), len(parts), name)
                self.assertGreater(page.index("<svg"), places[0])

    def test_every_quantity_is_explained(self):
        for one in self.cases:
            for name in one.points[0].units:
                meaning = one.points[0].meanings[name]
                self.assertGreater(len(meaning), 10)
                row = f'<tr><td>{name}</td><td class="words">{html.escape(meaning)}</td>'
                self.assertIn(row, self.pages[one.name])

    def test_every_parameter_is_explained(self):
        for one in self.cases:
            for p in one.parameters:
                self.assertIn(f'<tr><td>{p["parameter"]}</td><td class="words">'
                              f'{html.escape(p["summary"])}', self.pages[one.name])

    def test_eight_curves(self):
        for name, page in self.pages.items():
            for figure in re.findall(r"<svg id=.*?</svg>", page, re.S):
                keys = set(re.findall(r'data-f="([^"]+)"', figure))
                self.assertLessEqual(len(keys), MOST_CURVES, name)

    def test_neighbours(self):
        names = [c.name for c in self.cases]
        for name, following in zip(names, names[1:]):
            self.assertIn(f'<a href="{following}.html">{following} →</a>', self.pages[name])
            self.assertIn(f'<a href="{name}.html">← {name}</a>', self.pages[following])

    def test_every_point_is_there(self):
        elastica = next(c for c in self.cases if c.name == "elastica")
        self.assertGreater(len(elastica.points), 1)
        for one in elastica.points:
            self.assertIn(f'id="{one.name}"', self.pages["elastica"])

    def test_results_without_scenes(self):
        old = data.Case("c", "", "", [point(series("a", [1e-3]))])
        old.points[0].meanings = {}
        self.assertIsNone(case.drawing(None, old))
        self.assertEqual([(q.name, q.meaning) for q in case.quantities(old.points[0])],
                         [("u", "")])


if __name__ == "__main__":
    unittest.main()
