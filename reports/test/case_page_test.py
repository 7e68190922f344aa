"""Pages of cases: the scene first, every quantity explained, at most eight curves in a figure,
errors below the truth's own digits marked as such."""
import html
import math
import re
import unittest

from harness.tools.kit.program import ProgramTest, report, run
from reports import case, data, plots
from reports.plots import MOST_CURVES, OPEN
from reports.style import Styles
from reports.test import results


class Site:
    """What a chart asks of a site."""

    def __init__(self):
        self.said, self.styles = [], Styles([])

    def points(self, key, columns, rows, title):
        self.said.append({"f": key, "t": title, "c": columns, "r": rows})
        look = Styles.of(key)
        return {**look, "gid": f"{look['gid']}|{len(self.said) - 1}"}


def series(key, errors, truth=2.0, uncertainty=2e-6):
    """Meshes of 1, 2, 4 ... elements with these errors."""
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
        """The truth is known to 1e-6: two of four marks are open, on that line, and the legend says
        so."""
        site, own = Site(), point(series("beamw", (1e-2, 1e-4, 1e-8, -1e-9)))
        image = plots.errors_figure(site, own, "u", own.series, ("elements",), "f")
        self.assertIn(OPEN, html.unescape(image.markup))
        full, = re.findall(r'<polyline stroke="none" points="([^"]*)" style="([^"]*)"',
                           image.markup[:image.markup.index("data-l")])
        lost = re.search(r'points="([^"]+)" stroke="none"[^>]* style="([^"]*)"', image.markup)
        self.assertEqual([len(full[0].split()), len(lost[1].split())], [2, 2])
        self.assertEqual(len({p.split(",")[1] for p in lost[1].split()}), 1)
        self.assertNotEqual(full[1], lost[2])  # another marker
        self.assertIn('fill-opacity=".07"', image.markup)

    def test_above_the_digits(self):
        own = point(series("beamw", (1e-2, 1e-4)))
        image = plots.errors_figure(Site(), own, "u", own.series, ("elements",), "f")
        self.assertNotIn(OPEN, html.unescape(image.markup))

    def test_eight_at_most(self):
        """Misprints and options give way; an option on the front stays."""
        names = [f"f{i}" for i in range(7)]
        own = point(*[series(key, (1e-2, 1e-4)) for key in names],
                    series("sheet_third_printed", (1e-2, 1e-5)),
                    series("f0:mass=lumped", (1e-3, 1e-6)), series("f1:mass=lumped", (0.1, 0.1)))
        shown, further = plots.leading(own, "u")
        self.assertEqual([s.key for s in shown], [*names, "f0:mass=lumped"])
        self.assertEqual([s.key for s in further], ["sheet_third_printed", "f1:mass=lumped"])
        # f0 is on the front by its first mesh, f11 by its last; of the others the most exact stay.
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

    def test_the_scene_is_first(self):
        for name, page in self.pages.items():
            self.assertLess(page.index(f'id="{name}_scene"'), page.index("<h2>Quantities"))
            self.assertLess(page.index("<h2>Quantities"), page.index("Which formulation?"))

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
        """Next and previous lead through all cases."""
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
        """There is no drawing, and quantities stand without explanations."""
        old = data.Case("c", "", "", [point(series("a", [1e-3]))])
        old.points[0].meanings = {}
        self.assertIsNone(case.drawing(None, old))
        self.assertEqual([(q.name, q.meaning) for q in case.quantities(old.points[0])],
                         [("u", "")])


if __name__ == "__main__":
    unittest.main()
