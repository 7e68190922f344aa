"""Pages of sweeps must show the answers, maps and errors of artificial sweeps (sweeps.py)."""
import html
import json
import re
import unittest

import numpy as np

from harness.records.test.stored import group_of
from harness.tools.kit.program import ProgramTest, drawn, report, run
from reports.sweep import gather, maps, stored
from reports.test import sweeps
from reports.test.browser_test import CHROMIUM, chromium, console
from reports.test.sweep_test import ANGLE, SHAPE, WIDTH


PAGE = 2_000_000  # bytes, for any number of points
KEYS = ("beamw", "collocation", "sheet_third")


def errors(key):
    level = {"beamw": lambda at, n: np.where(at[:, 0] < 0.55, 0.001, 0.5) / n**0.1,
             "collocation": lambda at, n: np.full(len(at), 0.03 / n**2),
             "sheet_third": lambda at, n: np.full(len(at), 0.3 / n)}
    return level[key]


def text_of(page):
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
        for words in ("made_up.yaml: over what range is each formulation within 1 %?",
                      "collocation with 2 elements is within 1 % everywhere: all 100 points.",
                      "beamw with 1 element is within 1 % where width ≤ 5 m: all 50 points there, "
                      "50 % of all.",
                      "sheet_third is within 1 % in no range large enough to report: at no point with up to "
                      "8 elements.",
                      "beamw at 50 % of the points, collocation at 50 % of the points",
                      "100 points (width: 1 to 10 m, 10 values; angle: 0 to 0.9 rad, 10 values), "
                      "1 200 cells"):
            self.assertIn(words, said)
        self.assertLess(said.index("collocation with 2"), said.index("beamw with 1"))

    def test_maps(self):
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
        self.assertEqual(names[:3], ["sheet_third", "beamw", "collocation"])
        self.assertIn("beamw with 1 element is within 1 % where width ≤ 5 m", text_of(page))

    def test_three_axes(self):
        page = self.page((WIDTH, ANGLE, SHAPE))
        self.assertEqual(len(re.findall(r'<svg id="sweep_map_\d_\d"', page)), 9)
        self.assertIn(">shape is strip</text>", page)

    def test_scattered(self):
        axes = [("width", "m", "halton", "linear"), ("angle", "rad", "halton", "linear")]
        few = self.page(axes, sweeps.scattered(100, (1, 10), (0, 0.9)))
        self.assertEqual(few.count("<circle cx=") - 1, 300)
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
                      "80 points worse than 1 %", "A limit is the value to which the meshes", "angle from 0.7 rad to 0.9 rad",
                      "20 of 100 points have no reference value"):
            self.assertIn(words, said)
        worst = said[said.index("Worst points"):said.index("References of the errors")]
        self.assertLess(worst.index("not converged"), worst.index("25 %"))

    def test_what_a_file_says_is_text(self):
        page = self.page((WIDTH, ANGLE), worst=[(0, "beamw", 8, "<b>", 0.1, "ok", "<i>.yaml")])
        self.assertNotIn("<b>", page)
        self.assertNotIn("<i>", page)

    def test_many_points(self):
        axes = [(name, "m", "sobol", "linear") for name in ("width", "length", "load")]
        page = self.page(axes, sweeps.scattered(25_000, *[(1, 10)] * 3))
        self.assertIn("300 000 cells", text_of(page))
        for file in (self.folder / "site").iterdir():
            self.assertLess(file.stat().st_size, PAGE, file.name)

    def test_nothing_to_measure_by(self):
        for axes in ((WIDTH,), (WIDTH, ANGLE), (WIDTH, ANGLE, SHAPE)):
            said = text_of(self.page(axes, kind=lambda at: np.full(len(at), 4)))
            self.assertIn("within 1 % in no range large enough to report: no reference for its error", said)
            self.assertIn("No point has a reference value or a limit", said)
            self.assertNotIn("Lowest cost</h2>", said)

    def test_truths_here_limits_there(self):
        said, axes = "elsewhere against limits of mesh sequences", (WIDTH, ANGLE)
        truth, limit = 0, 2
        for kind, found in ((lambda at: np.where(at[:, 0] < 0.5, truth, limit), self.assertIn),
                            (lambda at: np.full(len(at), limit), self.assertNotIn),
                            (lambda at: np.full(len(at), truth), self.assertNotIn)):
            found(said, text_of(self.page(axes, kind=kind)))

    def test_one_point(self):
        axes = (("width", "m", "list", (2.5,)), ("shape", "1", "words", ("C",)))
        said = text_of(self.page(axes, keys=("collocation",), meshes=(2,)))
        self.assertIn("collocation with 2 elements", said)

    def test_without_costs(self):
        path = sweeps.store(self.folder / "c.h5", (WIDTH, ANGLE), sweeps.grid(WIDTH, ANGLE),
                            {key: errors(key) for key in KEYS})
        with sweeps.h5py.File(path, "r+") as file:
            file["cost"][:, 0] = np.nan
        self.assertEqual(report(path, self.folder / "site").returncode, 0)
        said = text_of((self.folder / "site" / "index.html").read_text(encoding="utf-8"))
        self.assertIn("by counted work: collocation at 100 % of the points.", said)
        self.assertIn("not ranked: beamw.", said)

    def test_beside_results(self):
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
        self.assertNotIn('href="formulation_beamw.html"', page)
        self.assertIn('aria-current="page">Sweeps</a>', page)

    def test_several(self):
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


CHOOSE = """<pre id="out"></pre><script>addEventListener("load", () => {{
  const form = document.getElementById("choice"), drawn = document.getElementById("drawn");
  const all = (what, of) => [...drawn.querySelectorAll(what)].map(of);
  const shapes = () => [all("path", p => p.getAttribute("d")), all("text", t => t.textContent),
                        all("svg", s => s.getAttribute("aria-label"))];
  const before = shapes();
  const loaded = window.beamwork_sweep;
  window.beamwork_sweep = cells => {{
    loaded(cells);
    document.getElementById("out").textContent = JSON.stringify({{
    here: [document.getElementById("here").childNodes[0]?.data,
           ...[...document.querySelectorAll("#here tr")].map(r => [...r.cells].map(c => c.textContent))],
    wide: document.body.scrollWidth,
    hidden: form.hidden, before, after: shapes(), told: document.getElementById("told").textContent,
    fields: [...form.querySelectorAll("label")].filter(l => !l.hidden)
      .map(l => l.firstChild.data.trim()),
    }});
  }};
  {set}
  form.dispatchEvent(new Event("change"));
}});</script>"""


@unittest.skipUnless(CHROMIUM, "needs chromium")
class Chosen(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.folder = cls.class_folder()
        axes = (WIDTH, ANGLE, SHAPE)
        path = sweeps.store(cls.folder / "made.h5", axes, sweeps.grid(*axes), {
            "beamw": lambda at, n: 0.02 * (0.1 + at[:, 0] + at[:, 1] * at[:, 2]) / n,
            "collocation": sweeps.series("collocation")},
            status=lambda at, f, m: np.where((f == 1) & (at[:, 0] > 0.95), 1, 0))
        done = report(path, cls.folder / "site")
        assert done.returncode == 0, done.stderr

    def setUp(self):
        pass

    def chosen(self, change, page="index.html"):
        site = self.folder / "site"
        text = (site / page).read_text(encoding="utf-8")
        (site / "acted.html").write_text(
            text.replace("</body>", CHOOSE.format(set=change) + "</body>"), encoding="utf-8")
        ran = chromium(self.folder, "--virtual-time-budget=10000", "--dump-dom",
                       (site / "acted.html").as_uri())
        self.assertEqual(console(ran), [])
        found = re.search(r'<pre id="out">(.+?)</pre>', ran.stdout, re.S)
        self.assertIsNotNone(found, ran.stderr[-2000:])
        return json.loads(html.unescape(found.group(1)))

    def test_the_same_drawn_twice(self):
        found = self.chosen("")
        self.assertFalse(found["hidden"])
        self.assertEqual(found["after"][:2], found["before"][:2])
        self.assertGreater(len(found["after"][0]), 15)
        self.assertEqual(found["fields"], ["Show", "across", "up", "side by side"])

    def test_other_axes(self):
        found = self.chosen("form.elements.x.value = 2; form.elements.y.value = 0; "
                            "form.elements.of.value = -1; form.elements.at1.value = 9;")
        self.assertEqual(found["fields"], ["Show", "across", "up", "side by side", "angle"])
        self.assertIn("strip", found["after"][1])
        sweep = stored.read(self.folder / "made.h5")
        counted, look = gather.of_sweep(sweep), maps.Look(sweep.meshes)
        for f, key in enumerate(sweep.keys):
            reach = counted.reach[:, f, -1].reshape(*counted.shape, -1)[:, 9]
            state = maps.states(reach, reach.sum(axis=-1), look)
            drawn, = [label for label in found["after"][2] if f"by {key} over shape" in label]
            self.assertEqual(set(drawn.partition(": ")[2].split("; ")), {
                f"{look.words[k]}: {100 * (state == k).mean():.0f} %" for k in np.unique(state)})

    def test_errors(self):
        found = self.chosen("form.elements.show.value = 3;")
        self.assertIn("The largest error", found["told"])
        self.assertTrue({"0.1", "0.5"} & set(found["after"][1]))
        self.assertIn("!", found["after"][1])

    def own(self, *values):
        fields = "".join(f'document.getElementById("own").elements.v{k}.value = "{value}";'
                         for k, value in enumerate(values))
        found = self.chosen(fields + 'document.getElementById("own").dispatchEvent('
                            'new Event("submit", { cancelable: true }));')
        words, *rows = found["here"]
        return words, {row[0]: tuple(row[1:]) for row in rows[1:]}

    def test_own_sizes(self):
        words, found = self.own(3, 0.6, 1)
        self.assertEqual(words, "Tried there: width 3, angle 0.6, shape box.")
        self.assertEqual(found["beamw"], ("2 elements", "up to 1 %"))
        self.assertEqual(set(found), {"beamw", "collocation"})
        self.assertEqual(self.own("10", "0,3", 2)[1]["collocation"][0], "no solution with 8")
        words, found = self.own(11, 0.6, 1)
        self.assertEqual(words, "Give width from 1 to 10: nothing was tried elsewhere.")
        self.assertEqual(found, {})

    def test_on_a_phone(self):
        found = self.chosen("document.body.style.width = '366px';")
        self.assertLessEqual(found["wide"], 390)

    def test_axes_that_are_the_same(self):
        found = self.chosen("form.elements.x.value = form.elements.y.value;")
        self.assertEqual(found["told"], "Choose axes that differ.")


class Genuine(ProgramTest):

    def test_a_grid(self):
        path, site = self.folder / "loads.h5", self.folder / "site"
        run("sweep", "elastica", "--vary", "load=1..8/7", "--vary", "axial=1e6..1e8/1:log", "-f",
            "collocation", "-f", "beamw", "-f", "sheet_third", "-n", "1,2,4", "-j", "1", "-o", path)
        sweep = stored.read(path)
        self.assertEqual((sweep.name, sweep.points, sweep.meshes), ("elastica", 16, [1, 2, 4]))
        self.assertGreater(sweep.noise, 1)
        self.assertIn("ok", sweep.statuses)
        self.assertTrue(sweep.without)
        found = gather.of_sweep(sweep)
        with group_of(path) as file:
            least, status = file["least"][()], file["status"][()]
        absent = np.isin(status, sweep.outcomes(stored.ABSENT)).any(axis=2)
        for f, key in enumerate(sweep.keys):
            for q, quantity in enumerate(sweep.quantities):
                for m, n in enumerate(sweep.meshes):
                    within = (least[:, f, q] > 0) & (least[:, f, q] <= n) & ~absent[:, f]
                    self.assertEqual(found.reach[:, f, q, :m + 1].sum(), within.sum(),
                                     (key, quantity, n))
        self.assertEqual(report(path, site).returncode, 0)
        page = text_of((site / "index.html").read_text(encoding="utf-8"))
        self.assertIn("elastica: over what range is each formulation within 1 %?", page)
        scene = re.search(r"beamwork solve --scene (\S+\.yaml) -f (\S+) -n (\d+)", page)
        self.answered("solve", "--scene", scene[1], "-f", scene[2], "-n", scene[3])


if __name__ == "__main__":
    unittest.main()
