"""Charts, figures for papers and pictures must be valid, contain the data of the results, and not exceed size
limits."""
import json
import pathlib
import re
import tempfile
import types
import unittest
import xml.etree.ElementTree

import matplotlib
import numpy as np
from scipy.spatial.transform import Rotation

from harness.tools.kit.program import (ProgramTest, TRUTHS, drawn as drawn_of_campbell,
                                       drawn as drawn_of_paths, drawn as drawn_of_pictures,
                                       drawn as drawn_of_sizes)
from reports import campbell, data, paths, pictures, shapes
from reports.figures import chart, paper, style, svg
from reports.claims import Lookup
from reports.site import ASSETS, Site
from reports.figures.style import Styles, plt


def site():
    found = types.SimpleNamespace(said=[], styles=Styles([]), paper=paper.Paper("", []))
    found.points = types.MethodType(Site.points, found)
    return found


class Axes(unittest.TestCase):

    def test_part(self):
        one = chart.Axis(log=True)
        one.take([1e-3, 1e-1, 1e1, 0, float("nan")])
        one.settle()
        low, middle, high = one.part([1e-3, 1e-1, 1e1])
        self.assertAlmostEqual(middle, 0.5)
        self.assertGreater(low, 0.02)
        self.assertAlmostEqual(high, 1 - low)

    def test_ticks(self):
        self.assertEqual([w for _, w in chart.log_ticks(0.5e-3, 20)],
                         ["10⁻³", "10⁻²", "10⁻¹", "1", "10"])
        self.assertLessEqual(len(chart.log_ticks(1e-14, 1)), 8)
        self.assertEqual(chart.whole_ticks(0.9, 70), [1, 2, 5, 10, 20, 50])
        self.assertEqual(chart.whole_ticks(9.7, 13.2), [10, 11, 12, 13])
        self.assertEqual([w for _, w in chart.linear_ticks(-0.1, 1.05)],
                         ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"])
        for low, high in ((1.2, 1.9), (3.1, 3.2), (40, 41)):
            self.assertGreater(len(chart.whole_ticks(low, high)), 0)

    def test_nothing_to_scale(self):
        for values in ([3.0], []):
            one = chart.Axis(log=True, whole=True)
            one.take(values)
            one.settle()
            self.assertLess(one.low, one.high)


class Charts(unittest.TestCase):

    def drawn(self):
        place, picture = site(), chart.Chart(2, (100, 80))
        one = picture.panel("<one>", "x", "y")
        two = picture.panel("two", "x", like=one)
        look = place.points("beamw", ("elements", "error"), [(1, 0.5), (2, 0.25)], "w")
        for panel in (one, two):
            panel.plot([1, 2], [0.5, 0.25], label="beamw", **look)
        two.plot([1, 4], [0.1, 0.1], label="<theirs>", color="currentColor", marker="s", hollow=True)
        one.level(0.01, "tolerance")
        one.below = 0.02
        one.cross(2, look["color"], look["gid"].rpartition("|")[0])
        return picture.image(place, "some")

    def test_valid(self):
        text = svg.alone(self.drawn().markup)
        xml.etree.ElementTree.fromstring(text.encode())
        self.assertEqual(set(re.findall(r"url\(#(\w+)\)", text)),
                         set(re.findall(r'marker id="(\w+)"', text)))
        self.assertIn("&lt;one&gt;", text)
        self.assertIn("&lt;theirs&gt;", text)

    def test_points(self):
        image = self.drawn()
        self.assertEqual(image.markup.count('data-f="beamw" data-p="0"'), 2)
        said = json.loads(image.points)
        self.assertEqual([said["v"][i] for i in said["s"][0]["r"]], [[1, 2], [0.5, 0.25]])
        self.assertIn('data-l="beamw"', image.markup)
        curve = re.search(r'data-p="0"><polyline points="([^"]+)"', image.markup).group(1)
        (x0, y0), (x1, y1) = (map(float, p.split(",")) for p in curve.split())
        self.assertLess(x0, x1)
        self.assertLess(y0, y1)


class Papers(unittest.TestCase):

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.addCleanup(matplotlib.rcParams.update, dict(matplotlib.rcParams))

    def chart(self):
        drawn = chart.Chart(2, (300, 200))
        for title in ("left", "right"):
            panel = drawn.panel(title, "elements", "error", whole=True)
            panel.plot([1, 2, 4], [1e-2, 1e-4, 1e-6], label="beam_1", color="#0072b2", marker="o", gid="f|beam_1")
            panel.plot([], [], label="open", color="currentColor", marker="o", hollow=True, linestyle="none")
            panel.level(1e-3, "tolerance")
            panel.ground(1e-5)
            panel.note(2, 1e-3, "order 4")
            panel.cross(8, "#0072b2", "f|beam_1")
        return drawn

    def written(self, formats, style=None, name="elastica_time", only=None):
        one = site()
        one.paper = paper.Paper(self.folder.name, ["elastica", "elastica_motion"], formats, style, only)
        self.chart().image(one, name)
        folder = pathlib.Path(self.folder.name, paper.FOLDER)
        return {f.name: f.read_bytes() for f in folder.iterdir()} if folder.exists() else {}

    def style(self, text):
        path = pathlib.Path(self.folder.name, "own.mplstyle")
        path.write_text(text, encoding="utf-8")
        return str(path)

    def test_formats(self):
        found = self.written(["pdf", "svg", "png"])
        self.assertEqual(set(found), {"elastica_time.pdf", "elastica_time.svg", "elastica_time.png"})
        self.assertTrue(found["elastica_time.pdf"].startswith(b"%PDF"))
        for words in (b"tolerance", b"order 4", b"beam_1", b"elements", b"right"):
            self.assertIn(words, found["elastica_time.svg"])
        self.assertEqual(found["elastica_time.svg"].count(b">beam_1<"), 1)

    def test_equal_results_give_equal_files(self):
        self.assertEqual(self.written(["pdf", "svg"]), self.written(["pdf", "svg"]))

    def test_nothing_without_a_format(self):
        self.assertEqual(self.written([]), {})

    def test_one_case(self):
        self.assertEqual(self.written(["svg"], name="elastica_motion_time", only="elastica"), {})
        self.assertEqual(set(self.written(["svg"], only="elastica")), {"elastica_time.svg"})
        with self.assertRaisesRegex(paper.Impossible, "no case 'elastic'; cases: elastica, elastica_motion"):
            self.written(["svg"], only="elastic")

    def test_style_sets_the_size(self):
        found = self.written(["svg"], self.style("figure.figsize: 20, 2  # inches\nfont.size: 5\n"))
        width = float(re.search(rb'width="([\d.]+)pt"', found["elastica_time.svg"]).group(1))
        self.assertAlmostEqual(width / 72, 20, delta=0.5)

    def test_invalid_styles(self):
        for text, why in (("axes.gri: on", ":1: 'axes.gri: on' is not"), ("\nfont.size: large x", ":2: 'font.size")):
            with self.assertRaisesRegex(paper.Impossible, why):
                self.written(["svg"], self.style(text))
        with self.assertRaisesRegex(paper.Impossible, "nowhere: No such file"):
            self.written(["svg"], "nowhere")

    def test_pgf(self):
        try:
            found = self.written(["pgf"])
        except paper.Impossible as why:
            self.assertIn("apt-get install texlive-latex-recommended", str(why))
        else:
            self.assertIn(b"pgfpicture", found["elastica_time.pgf"])

def drawn(name, said=(), gid=None):
    figure, axes = plt.subplots(figsize=(3, 2))
    look = Styles.of("beamw:mass=lumped")
    axes.plot([1, 2, 4], [1, 3, 2], label="the <curve>", **{**look, "gid": gid or look["gid"]})
    axes.axhspan(1, 2, color="0.75")
    axes.legend()
    return svg.image_of(figure, name, said)


class Figures(unittest.TestCase):

    def test_identifiers(self):
        one, two = (set(re.findall(r' id="([^"]+)"', drawn(name).markup)) for name in ("a", "b"))
        self.assertGreater(len(one), 2)
        self.assertFalse(one & two)
        self.assertEqual(set(re.findall(r'[("]#(\w+)', drawn("a").markup)), one)

    def test_colours(self):
        markup = drawn("a").markup
        self.assertNotIn("#000000", markup)
        self.assertIn('fill="currentColor" stroke="currentColor"', markup)
        self.assertIn('fill-opacity="0.25"', markup)
        self.assertIn("var(--f0,#0072b2)", markup)
        self.assertIn("--f0: #0072b2;", style.sheet())

    def test_text(self):
        markup = drawn("a").inline('x "y" <z>')
        self.assertIn("the &lt;curve&gt;", markup)
        self.assertIn('aria-label="x &#34;y&#34; &lt;z&gt;"', markup)

    def test_whose(self):
        self.assertEqual(drawn("a").markup.count('data-f="beamw:mass=lumped"'), 1)
        self.assertEqual(drawn("a").markup.count('data-l="beamw:mass=lumped"'), 2)
        image = drawn("a", [{}, {"f": "beamw", "t": "", "c": ["a", "b"],
                                 "r": [[1, "</script>"], [2, "</script>"]]}], "f|beamw|1")
        self.assertIn('data-f="beamw" data-p="0"', image.markup)
        self.assertEqual(json.loads(image.points), {
            "h": [["a", "b"]],
            "v": [[1, 2]],
            "s": [{"f": "beamw", "t": "", "h": 0, "k": {"1": "</script>"}, "n": 2, "r": [0]}]
        })
        self.assertNotIn("</", image.points)


class Looks(unittest.TestCase):

    def test_for_ever(self):
        for keys in (["beamw"], ["another", "beamw"]):
            self.assertEqual(Styles(keys).of("beamw")["color"], "#0072b2")
        self.assertEqual(Styles.of("mine"), Styles.of("mine"))
        self.assertIn(Styles.of("mine")["color"], [light for light, _ in style.RESERVE])
        one, other = Styles.of("beamw"), Styles.of("beamw:mass=lumped")
        self.assertEqual((one["color"], one["marker"]), (other["color"], other["marker"]))
        self.assertNotEqual(one["linestyle"], other["linestyle"])

    def test_table(self):
        looks = list(style.TABLE.values())
        for column in zip(*looks):
            self.assertEqual(len(set(column)), len(looks))

    def test_classes(self):
        curve = '<polyline points="{}" stroke="red" stroke-dasharray="1 2" style="{}:url(#k1)"/>'
        page = "<head></head>" + "".join(curve.format(*one) for one in (
            ("0,0", "marker"), ("1,1", "marker"), ("2,2", "marker-mid")))
        made = svg.with_classes(page)
        self.assertEqual(re.findall('points="(.*?)" class="(.*?)" stroke-dasharray="1 2"/>', made),
                         [("0,0", "q0"), ("1,1", "q0"), ("2,2", "q1")])
        self.assertIn(".q0{stroke:red;marker:url(#k1)}.q1{stroke:red;marker-mid:url(#k1)}</style>",
                      made)
        self.assertEqual(svg.with_classes("<head></head>"), "<head></head>")


class Geometry(unittest.TestCase):

    def test_axes(self):
        rotation = Rotation.from_rotvec([0.3, -1.1, 0.7])
        x, y, z, w = rotation.as_quat()
        np.testing.assert_allclose(shapes.matrices(np.array([w, x, y, z])),
                                   rotation.as_matrix().T,
                                   atol=1e-15)

    def test_hull(self):
        square = np.array([[0, 0, 1.], [1, 0, 1], [1, 1, 1], [0, 1, 1], [0.5, 0.5, 1]])
        faces = shapes.hull(square)
        self.assertEqual([len(f) for f in faces], [4])
        self.assertEqual(len(shapes.hull(square[:1])), 0)
        self.assertEqual([len(f) for f in shapes.hull(square[[0, 4, 2]])], [2])
        corners = np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)], float)
        self.assertEqual(len(shapes.hull(corners)), 12)

    def test_chosen(self):
        for moved, wanted in (([0, 0.75, 1.499, 2.25,
                                3], [0, 2, 4]), ([0, 0.6, 1.2, 1.8, 2.4,
                                                  3], [0, 3, 5]), ([0, -3, -1.5, 0, 1.5,
                                                                    3], [0, 1, 5])):
            s = types.SimpleNamespace(
                kind=["undeformed"] + ["path"] * (len(moved) - 1),
                sections=[np.zeros((1, 1, 2))],
                position=np.array(moved, float)[:, None, None] * np.array([1, 0, 0]),
                axes=np.tile(np.eye(3), (len(moved), 1, 1, 1)))
            self.assertEqual(pictures.chosen(s), wanted)

    def test_clusters(self):
        points = np.array([[0, 0, 0.], [0.1, 0, 0], [1, 0, 0], [1, 0.1, 0]])
        self.assertEqual([list(g) for g in shapes.clusters(points)], [[0, 1], [2, 3]])

    def test_hinges(self):
        ends = types.SimpleNamespace(first=np.array([0, 13, 26, 39]),
                                     released=np.array([[0, 32], [1, 0], [0, 0]]))
        self.assertEqual(list(pictures.hinges(ends)), [12, 13])


    def test_view_of_a_plane(self):
        flat = np.array([[[0, 0, 0], [1, 0, 0]], [[0, 0, 0], [0, 1, 0]]], float)
        lifted = np.array([[[0, 0, 0], [1, 0, 0]], [[0, 0, 0], [1, 0, 0.01]]], float)
        for points, wanted in ((flat, (-90, 74)), (flat[..., [0, 2, 1]], (-58, 24)),
                               (lifted, (-58, 24))):
            s = types.SimpleNamespace(kind=["undeformed", shapes.FRAME], position=points)
            view = pictures.best_view(s, [1])
            self.assertEqual(view.angles, wanted)
        np.testing.assert_allclose(pictures.View(-90, 74).right, [1, 0, 0], atol=1e-15)


class Report(ProgramTest):

    def site(self, *options):
        return drawn_of_pictures(self.folder, "-k", "spherical_joint/default", "-f", "sheet_third", *options)

    def test_drawn(self):
        site = self.site("--shapes")
        name = "picture_spherical_joint.svg"
        self.assertGreater((site / name).read_text(encoding="utf-8").count("<path"), 50)
        self.assertIn("beamwork_shape(", (site / "shape_spherical_joint.js").read_text("utf-8"))
        for page in ("pictures.html", "spherical_joint.html"):
            text = (site / page).read_text(encoding="utf-8")
            self.assertIn(f'src="{name}"', text)
            self.assertIn('data-shape="spherical_joint"', text)

    def test_absent(self):
        site = self.site()
        self.assertFalse((site / "pictures.html").exists())
        about = (site / "environment.html").read_text(encoding="utf-8")
        self.assertIn("verify --shapes", about)


class Campbell(ProgramTest):

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        cls.site = drawn_of_campbell(folder, "-k", "rotating_cantilever and beamw_consistent")
        cls.look = Lookup(data.read_results(folder / "results.h5")[1])

    def test_page(self):
        page = (self.site / "rotation.html").read_text(encoding="utf-8")
        for image in ("campbell_across", "campbell_along"):
            self.assertIn(f'<svg id="{image}"', page)

    def test_curves_pass_through_the_exact_values(self):
        mesh = campbell.finest(self.look, campbell.CASE, campbell.ACROSS, campbell.KEY)
        for name in ("flap_1", "lag_1", "flap_2"):
            x, value = mesh.curves[f"{name}_curve"][:2]
            for at, parameters in campbell.EXACT_AT.items():
                exact = campbell.truth(self.look, campbell.CASE, parameters, name)
                self.assertLess(abs(dict(zip(x.round(9), value))[at] / exact - 1), 2e-6,
                                f"{name} at {at}")

    def test_growth_between_the_critical_speeds_only(self):
        mesh = campbell.finest(self.look, campbell.CASE, campbell.ALONG, campbell.KEY)
        first = campbell.truth(self.look, campbell.CASE, campbell.EXACT_AT[0], "flap_1")
        for omega, growth in zip(*mesh.curves["growth_curve"][:2]):
            self.assertEqual(growth > 0, first < omega < 2 * first, f"at {omega}")


# Largest sizes of pages and of their parts [bytes].
FORMULATION = 45_000
VERDICT = 160  # average size of a row in a table of verdicts
VALUE = 16  # size of each value of the results in the data of the explorer
PAGE, FIGURE, SCRIPT, VIEWER, SHEET = 500_000, 90_000, 10_000, 13_000, 20_000  # bytes


class Sizes(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.site = drawn_of_sizes(cls.class_folder(), "-k", "elastica or c_cantilever/default or "
                         "sheet_cantilever/default", "--shapes")

    def test_pages(self):
        pages = list(self.site.glob("*.html"))
        self.assertGreater(len(pages), 15)
        for page in pages:
            self.assertLess(page.stat().st_size, PAGE, page.name)

    def test_figures(self):
        seen = 0
        for page in self.site.glob("*.html"):
            for figure in re.findall(r'<svg id=.*?</svg>(?:<script type.*?</script>)?',
                                     page.read_text(encoding="utf-8"), re.S):
                self.assertLess(len(figure), FIGURE, f"{page.name}: {figure[:60]}")
                seen += 1
        self.assertGreater(seen, 10)

    def test_once(self):
        for page in self.site.glob("*.html"):
            text = page.read_text(encoding="utf-8")
            self.assertIn('<link rel="stylesheet" href="style.css">', text)
            markers = re.findall(r'<marker id="(\w+)"', text)
            self.assertEqual(len(markers), len(set(markers)), page.name)

    def test_verdicts(self):
        rows = 0
        for page in self.site.glob("*.html"):
            text = page.read_text(encoding="utf-8")
            for table in re.findall('<table class="verdicts">.*?</table>', text, re.S):
                self.assertFalse(page.name.startswith("formulation_"))
                self.assertLess(len(table) / table.count("<tr"), VERDICT, page.name)
                rows += table.count("<tr")
            if page.name.startswith("formulation_"):
                self.assertLess(len(text), FORMULATION, page.name)
        self.assertGreater(rows, 200)

    def test_data(self):
        _, cases = data.read_results(str(self.site.parent / "results.h5"))
        for case in cases:
            number = sum(len(found) for p in case.points for s in p.series for m in s.meshes
                         for found in (m.values, m.errors))
            self.assertGreater(number, 50)
            size = (self.site / f"data_{case.name}.js").stat().st_size
            self.assertLess(size / number, VALUE, case.name)

    def test_assets(self):
        for name, most in (("script.js", SCRIPT), ("viewer.js", VIEWER), ("player.js", SCRIPT),
                           ("explorer.js", SCRIPT), ("sweep.js", SCRIPT),
                           ("sweep_own.js", SCRIPT)):
            self.assertLess((ASSETS / name).stat().st_size, most, name)
        self.assertLess((self.site / "style.css").stat().st_size, SHEET)


class Paths(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.site = drawn_of_paths(cls.class_folder(), "-k",
                         "snap_through and beamw_consistent or c_cantilever and collocation")
        cls.page = (cls.site / "paths.html").read_text(encoding="utf-8")

    def test_figures(self):
        for name in ("paths_cantilever", "paths_snap_through"):
            self.assertIn(f'<svg id="{name}"', self.page)
        for name in ("exact beam (collocation, n = 10)", "exact beam, with int y", "3-D solids"):
            self.assertIn(name, self.page)

    def test_limit_points_are_listed(self):
        rows = re.findall(
            r"<td>limit point</td><td class=\"n\">(-?[\d.]+)</td><td class=\"n\">(-?[\d.]+)</td>",
            self.page)
        self.assertEqual([float(load) for _, load in rows], [0.0103933, -0.0103933])

    def test_conclusions_have_numbers(self):
        shear = re.search(r"shear changes the load by ([^<]*)", self.page).group(1)
        values = [float(v) for v in re.findall(r"([-+][\d.]+) %", shear)]
        self.assertEqual(len(values), 3)
        self.assertTrue(all(0.05 < abs(v) < 0.3 for v in values), values)

    def test_curve_of_solids(self):
        solid = paths.solid(TRUTHS, paths.EDGES["D"], "curve")
        self.assertGreater(len(solid.w), 40)
        self.assertAlmostEqual(solid.w[-1], 2.6)
        self.assertIsNone(paths.solid(TRUTHS, "load_height=edge;w=1", "curve"))


if __name__ == "__main__":
    unittest.main()
