"""The page of a sweep: what stands on top, maps, winners, worst points, references, failures."""
import html
import re
import unittest

import numpy as np

from harness.tools.kit.program import ProgramTest, drawn, report
from reports.test import sweeps
from reports.test.sweep_test import ANGLE, SHAPE, WIDTH

PAGE = 2_000_000  # bytes, of any number of points
KEYS = ("beamw", "collocation", "sheet_third")


def errors(key):
    """beamw: good while the first axis is small; collocation: everywhere with 2 elements;
    sheet_third: nowhere."""
    level = {"beamw": lambda at, n: np.where(at[:, 0] < 0.55, 0.001, 0.5) / n**0.1,
             "collocation": lambda at, n: np.full(len(at), 0.03 / n**2),
             "sheet_third": lambda at, n: np.full(len(at), 0.3 / n)}
    return level[key]


def text_of(page):
    """Words of a page without its drawings."""
    plain = re.sub(r"<(svg|style|script).*?</\1>", "", page, flags=re.S)
    return html.unescape(re.sub(r"\s+", " ", re.sub(r"<[^>]*>", "", plain)))


class Pages(ProgramTest):

    def page(self, axes, points=None, keys=KEYS, name="made", **more):
        points = sweeps.grid(*axes) if points is None else points
        path = sweeps.store(self.folder / f"{name}.h5", axes, points,
                            {key: errors(key) for key in keys}, **more)
        done = report(path, self.folder / "site")
        self.assertEqual(done.returncode, 0, done.stderr)
        return (self.folder / "site" / "index.html").read_text(encoding="utf-8")

    def test_answer_on_top(self):
        page = self.page((WIDTH, ANGLE))
        said = text_of(page)
        for words in ("made_up.yaml: over which range is each formulation within 1 %?",
                      "collocation with 2 elements is within 1 % everywhere: all 100 points.",
                      "beamw with 1 element is within 1 % where width ≤ 5 m: all 50 points there, "
                      "50 % of all.",
                      "sheet_third is within 1 % in no range worth naming: at no point with up to "
                      "8 elements.",
                      "beamw at 50 % of the points, collocation at 50 % of the points",
                      "100 points (width: 1 to 10 m, 10 values; angle: 0 to 0.9 rad, 10 values), "
                      "1 200 cells"):
            self.assertIn(words, said)
        self.assertLess(said.index("collocation with 2"), said.index("beamw with 1"))

    def test_maps(self):
        """One for each formulation, of the same signs; each says in words what it shows."""
        page = self.page((WIDTH, ANGLE))
        maps = re.findall(r'<svg id="sweep_map_\d".*?</svg>', page, re.S)
        self.assertEqual(len(maps), 3)
        described = " ".join(re.findall(r'aria-label="(.*?)"', " ".join(maps)))
        self.assertIn("elements needed by beamw over width and angle: 1 element: 50 %; not with 8: "
                      "50 % of the fields", described)
        self.assertIn(">×</text>", maps[0] + maps[1])
        for figure in re.findall(r"<svg id=.*?>", page):
            self.assertIn("aria-label=", figure)

    def test_one_axis(self):
        page = self.page((WIDTH,))
        self.assertIn('id="sweep_errors"', page)
        drawn = re.search(r'<svg id="sweep_map".*?</svg>', page, re.S).group()
        names = re.findall(r">([a-z_]+)</text>", drawn)
        self.assertEqual(names[:3], ["sheet_third", "beamw", "collocation"])  # the best on top
        self.assertIn("beamw with 1 element is within 1 % where width ≤ 5 m", text_of(page))

    def test_three_axes(self):
        page = self.page((WIDTH, ANGLE, SHAPE))
        self.assertEqual(len(re.findall(r'<svg id="sweep_map_\d_\d"', page)), 9)
        self.assertIn(">shape is strip</text>", page)

    def test_scattered(self):
        """Few points are drawn one by one, many in fields."""
        axes = [("width", "m", "halton", "linear"), ("angle", "rad", "halton", "linear")]
        few = self.page(axes, sweeps.scattered(100, (1, 10), (0, 0.9)))
        self.assertEqual(few.count("<circle cx=") - 1, 300)  # and one in a hatch
        many = self.page(axes, sweeps.scattered(5000, (1, 10), (0, 0.9)))
        self.assertEqual(many.count("<circle cx="), 1)
        self.assertRegex(text_of(many), r"beamw with 1 element is within 1 % where width < 5\.\d")

    def test_worst_references_failures(self):
        def outcome(at, f, m):
            return np.where((at[:, 1] > 0.75) & (f == 2), 1, 0)
        page = self.page((WIDTH, ANGLE), status=outcome,
                         kind=lambda at: np.where(at[:, 0] > 0.85, 3, 2), doubt=0.02,
                         worst=[(49, "beamw", 8, "u", 0.25, "ok", "point 49.yaml"),
                                (99, "sheet_third", 8, "", np.nan, "not_converged", "")])
        said = text_of(page)
        for words in ("25 %", "width = 5 m, angle = 0.9 rad",
                      f"beamwork solve --scene '{self.folder}/made.worst/point 49.yaml' "
                      "-f beamw -n 8",
                      "not converged", "limit of the meshes of all: 80",
                      "20 points, chiefly where width ≥ 9 m; nothing is judged there",
                      "80 points worse than 1 %", "A limit is where the meshes", "angle from 0.7 rad to 0.9 rad",
                      "20 of 100 points have no reference value"):
            self.assertIn(words, said)
        worst = said[said.index("Worst points"):said.index("What errors are against")]
        self.assertLess(worst.index("not converged"), worst.index("25 %"))

    def test_what_a_file_says_is_text(self):
        page = self.page((WIDTH, ANGLE), worst=[(0, "beamw", 8, "<b>", 0.1, "ok", "<i>.yaml")])
        self.assertNotIn("<b>", page)
        self.assertNotIn("<i>", page)

    def test_many_points(self):
        """A page of 300 000 cells is no longer than one of few."""
        axes = [(name, "m", "sobol", "linear") for name in ("width", "length", "load")]
        page = self.page(axes, sweeps.scattered(25_000, *[(1, 10)] * 3))
        self.assertIn("300 000 cells", text_of(page))
        for file in (self.folder / "site").iterdir():
            self.assertLess(file.stat().st_size, PAGE, file.name)

    def test_nothing_to_measure_by(self):
        for axes in ((WIDTH,), (WIDTH, ANGLE), (WIDTH, ANGLE, SHAPE)):
            said = text_of(self.page(axes, kind=lambda at: np.full(len(at), 4)))
            self.assertIn("within 1 % in no range worth naming: nothing to measure it by", said)
            self.assertIn("No point has anything to measure by", said)
            self.assertNotIn("Lowest cost</h2>", said)

    def test_truths_here_limits_there(self):
        said, axes = "elsewhere against limits of meshes", (WIDTH, ANGLE)
        truth, limit = 0, 2
        for kind, found in ((lambda at: np.where(at[:, 0] < 0.5, truth, limit), self.assertIn),
                            (lambda at: np.full(len(at), limit), self.assertNotIn),
                            (lambda at: np.full(len(at), truth), self.assertNotIn)):
            found(said, text_of(self.page(axes, kind=kind)))

    def test_one_point(self):
        """And one formulation, one mesh."""
        axes = (("width", "m", "list", (2.5,)), ("shape", "1", "words", ("C",)))
        said = text_of(self.page(axes, keys=("collocation",), meshes=(2,)))
        self.assertIn("collocation with 2 elements", said)

    def test_without_costs(self):
        """Formulations that rank nothing win nowhere, and are told."""
        path = sweeps.store(self.folder / "c.h5", (WIDTH, ANGLE), sweeps.grid(WIDTH, ANGLE),
                            {key: errors(key) for key in KEYS})
        with sweeps.h5py.File(path, "r+") as file:
            file["cost"][:, 0] = np.nan
        self.assertEqual(report(path, self.folder / "site").returncode, 0)
        said = text_of((self.folder / "site" / "index.html").read_text(encoding="utf-8"))
        self.assertIn("by counted work: collocation at 100 % of the points.", said)
        self.assertIn("in no order: beamw.", said)

    def test_beside_results(self):
        """A page of its own, in the bar, and a sentence on the first page."""
        path = sweeps.store(self.folder / "leaf-sizes.h5", (WIDTH, ANGLE),
                            sweeps.grid(WIDTH, ANGLE), {key: errors(key) for key in KEYS})
        site = drawn(self.folder, "-k", "warping_torsion/default", "-f", "collocation",
                     options=("--sweep", path))
        first = (site / "index.html").read_text(encoding="utf-8")
        self.assertIn("Sweep of made_up.yaml. collocation with 2 elements is within 1 % everywhere",
                      text_of(first))
        self.assertIn('href="sweep_leaf-sizes.html"', first)
        page = (site / "sweep_leaf-sizes.html").read_text(encoding="utf-8")
        self.assertIn('href="formulation_collocation.html"', page)
        self.assertNotIn('href="formulation_beamw.html"', page)  # the results have none of it
        self.assertIn('aria-current="page">Sweeps</a>', page)

    def test_several(self):
        """Also of files of the same name; the first stands in the place of results."""
        paths = []
        for folder in ("a", "b", "c"):
            (self.folder / folder).mkdir()
            paths.append(sweeps.store(self.folder / folder / "same.h5", (WIDTH,),
                                      sweeps.grid(WIDTH), {"beamw": errors("beamw")}))
        done = report(paths[0], self.folder / "site", "--sweep", paths[1], "--sweep", paths[2])
        self.assertEqual(done.returncode, 0, done.stderr)
        names = {path.name for path in (self.folder / "site").iterdir()}
        self.assertLessEqual({"index.html", "sweep_same_2.html", "sweep_same_3.html",
                              "cells_same.js", "cells_same_2.js", "cells_same_3.js"}, names)

    def test_what_is_no_sweep(self):
        path = sweeps.store(self.folder / "s.h5", (WIDTH,), sweeps.grid(WIDTH),
                            {"beamw": errors("beamw")})
        with sweeps.h5py.File(path, "r+") as file:
            del file["error"]
        for given, words in ((path, "s.h5: cannot be read"), (__file__, "cannot be read")):
            done = report(given, self.folder / "site")
            self.assertEqual((done.returncode, done.stderr.count("\n")), (4, 1), done.stderr)
            self.assertIn(words, done.stderr)

    def test_many_that_say_the_same(self):
        """Together in one sentence; the counts are those of the worst of them."""
        def nearly(bad):
            return lambda at, n: np.where(at[:, 0] + at[:, 1] > 2.01 - 0.05 * bad, 0.02, 0.001)
        axes = (WIDTH, ANGLE)
        path = sweeps.store(self.folder / "same.h5", axes, sweeps.grid(*axes), {
            "beamw": nearly(1), "collocation": nearly(0), "sheet_third": nearly(0)})
        self.assertEqual(report(path, self.folder / "site").returncode, 0)
        said = text_of((self.folder / "site" / "index.html").read_text(encoding="utf-8"))
        self.assertIn("collocation, sheet_third and beamw with 1 element are within 1 % everywhere"
                      ": at least 99 of 100 points; the exception: beamw at width = 10 m, "
                      "angle = 0.9 rad (2 %).", said)


if __name__ == "__main__":
    unittest.main()
