"""Pages of motions must show the energies, momenta, steps, quantities and reference values of the results."""
import re
import types
import unittest

import h5py
import numpy as np

from harness.tools.kit.program import TRUTHS, ProgramTest, report, run
from reports import motion_page
from reports.test import balances, frames
from reports.test.browser_test import CHROMIUM, chromium, console
from reports.test.film_test import CLOCK

RHO_9 = [0.8 / 1.9, 0.9 / 1.9]
FORMULATIONS = ("beamw", "collocation")


def motion(**more):
    found = balances.rows("beamw", 4, **more)
    return motion_page.Motion("beamw", 4, {name: found[name].astype(float)
                                           for name in balances.COLUMNS})


class Words(unittest.TestCase):

    def test_scheme(self):
        for how, wanted in (({"integrator": "radau"}, "radau"), ({"parameters": RHO_9},
                                                                 "alpha (rho 0.9)"),
                            ({"parameters": [0, 0]}, "the trapezoidal rule"),
                            ({"parameters": [0, 0.05]}, "HHT (0.05)"),
                            ({"parameters": [0.1, 0.3]}, "alpha (0.1, 0.3)"),
                            ({"hht": 0.1}, "HHT (0.1)"),
                            ({"trapezoidal": True}, "the trapezoidal rule"),
                            ({"rho": 0.6}, "alpha (rho 0.6)"), ({}, "alpha (rho 0.9)")):
            self.assertEqual(motion_page.scheme(how), wanted)

    def test_sentence(self):
        text = motion_page.sentence(motion(), {"integrator": "radau", "tolerance": "1e-06"})
        self.assertIn("Radau with a tolerance of 1e-06 per step takes 400 steps of 0.005 s to 2 s",
                      text)
        self.assertIn("3.0 iterations each; energy drifts by at most 1e-05 of its largest value.", text)

    def test_momenta_that_stay(self):
        self.assertIn("momentum and angular momentum by 0e+00",
                      motion_page.sentence(motion(free=True), {}))
        self.assertNotIn("momentum", motion_page.sentence(motion(), {}))

    def test_steps(self):
        found = motion()
        found.columns["step"][1] = 0.001
        found.columns["rejected"][3] = 2
        self.assertIn("400 steps of 0.001 to 0.005 s (2 longer ones rejected)",
                      motion_page.sentence(found, {}))

    def test_spread(self):
        self.assertEqual(motion_page.spread([motion()]), "")
        self.assertIn("In all 2 formulations energy drifts by 1e-05 to 1e-03",
                      motion_page.spread([motion(), motion(drift=1e-3)]))


class Curves(unittest.TestCase):

    def test_no_peak_is_lost(self):
        x, y = np.arange(1000.0), np.zeros(1000)
        y[777] = 5
        at, most = motion_page.largest(x, y)
        self.assertEqual((len(at), most.max(), at[most.argmax()]), (motion_page.MOST_POINTS, 5, 777))

    def test_thinned(self):
        at = motion_page.thinned(np.arange(1000))
        self.assertEqual((at[0], at[-1], len(at)), (0, 999, motion_page.MOST_POINTS))
        self.assertEqual(motion_page.thinned(np.arange(3)).tolist(), [0, 1, 2])

    def test_units(self):
        for values, unit, wanted in (([0, -2e-3], "m", (1e-3, "mm")), ([0.5, 3], "J", (1, "J")),
                                     ([0.02], "m", (1, "m")), ([5e-6], "N m", (1e-6, "µN m")),
                                     ([2e4], "J", (1e3, "kJ")), ([2e4], "m", (1e3, "10³ m")),
                                     ([1e-3], "kg m/s", (1e-3, "10⁻³ kg m/s")),
                                     ([], "m", (1, "m")),
                                     ([4e-4], "1", (1e-3, "10⁻³")), ([0, 0], "m", (1, "m"))):
            self.assertEqual(motion_page.fitting(values, unit), wanted)

    def test_scale(self):
        found = motion()
        self.assertAlmostEqual(found.scale, 3)
        found.columns["work"][5] = -9
        self.assertAlmostEqual(found.drift[-1], 1e-5 / 3)


class Page(ProgramTest):

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        cls.results, cls.site = folder / "results.h5", folder / "site"
        run("verify", "-k", "elastica/default or roll_up/default", "-f", "beamw", "-f",
            "collocation", "--shapes", "-o", cls.results)
        balances.add(cls.results, "elastica", balances.rows("beamw", 4, drift=1e-3),
                     balances.rows("beamw", 2, steps=7), balances.rows("collocation", 4, steps=99))
        frames.only(cls.results, "elastica", np.linspace(0, 2, 11))
        done = report(cls.results, cls.site)
        assert done.returncode == 0, done.stderr
        cls.text = (cls.site / "motion_elastica.html").read_text(encoding="utf-8")

    def test_finest_meshes(self):
        found = motion_page.motions_of(self.results, "elastica")
        self.assertEqual([(m.formulation, m.elements, len(m.steps)) for m in found],
                         [("beamw", 4, 400), ("collocation", 4, 99)])
        self.assertEqual(motion_page.motions_of(self.results, "roll_up"), [])

    def test_list(self):
        text = (self.site / "motions.html").read_text(encoding="utf-8")
        self.assertIn('<a href="motion_elastica.html">elastica</a>', text)
        self.assertNotIn("motion_roll_up.html", text)
        self.assertIn("400 steps of 0.005 s", text)
        self.assertFalse((self.site / "motion_roll_up.html").exists())

    def test_energies_are_those_of_the_file(self):
        figure = re.search(r'<svg id="motion_elastica_energies".*?</svg>', self.text, re.S)[0]
        line = re.search(r'data-f="kinetic".*?points="([^"]+)"', figure)[1]
        points = np.array([[float(x) for x in p.split(",")] for p in line.split()])
        found = motion_page.motions_of(self.results, "elastica")[0]
        at = motion_page.thinned(found.time)
        for of, column in ((found.time[at], 0), (found.columns["kinetic"][at], 1)):
            slope, off = np.polyfit(of, points[:, column], 1)
            self.assertLess(np.abs(slope * of + off - points[:, column]).max(), 0.11)

    def test_nothing_that_is_zero(self):
        self.assertNotIn('data-f="work"', self.text)
        self.assertIn('data-f="strain"', self.text)

    def test_case_leads_to_it(self):
        for page, name, there in (("elastica", "motion_elastica", True), ("index", "motions", True),
                                  ("roll_up", "motion_", False)):
            text = (self.site / f"{page}.html").read_text(encoding="utf-8")
            self.assertEqual(f'href="{name}' in text.partition("<main")[2], there, page)

    def test_it_can_be_seen(self):
        self.assertIn('data-shape="elastica"', self.text)
        self.assertIn('"times":', (self.site / "shape_elastica.js").read_text(encoding="utf-8"))
        bar = re.search('<nav class="bar" [^>]*>(.*?)</nav>', self.text, re.S)[1]
        self.assertRegex(bar, r'aria-current="true">Motion<')

    def test_small(self):
        self.assertLess(len(self.text), 200_000)

    def test_absent(self):
        plain = self.folder / "plain.h5"
        with h5py.File(plain, "w") as file:
            file.create_group("cases/a")
        self.assertFalse(motion_page.present(types.SimpleNamespace(alone=False,
                                                                   results=str(plain))))

    @unittest.skipUnless(CHROMIUM, "needs chromium")
    def test_browser(self):
        copy = self.site / "seen.html"
        copy.write_text(self.text.replace("<main", CLOCK + "<main"), encoding="utf-8")
        ran = chromium(self.folder, "--virtual-time-budget=9000", "--dump-dom", copy.as_uri(),
                       software=True)
        copy.unlink()
        self.assertEqual(console(ran), [])
        self.assertIn('class="player"', ran.stdout)


class Truths(ProgramTest):

    def setUp(self):
        super().setUp()
        self.path = str(self.folder / "truths.h5")
        at = ["time=1;step=*", "time=2;step=*", "step=*", "time=3;stiffening=1e3", "time=4",
              "time=5"]
        with h5py.File(self.path, "w") as file:
            g = file.create_group("truths/swing")
            g["parameters"], g["quantity"] = [a.encode() for a in at], [b"x"] * 5 + [b"y"]
            g["model"] = [b"beam"] * 4 + [b"other", b"beam"]
            g["formulation"] = [b""] * 6
            g["value"] = np.arange(6.0)

    def test_of_all_instants(self):
        found = motion_page.truths_of(self.path, "swing", "x", 9.0)
        self.assertEqual([(t.time, t.value) for t in found], [(1, 0), (2, 1), (9, 2)])
        self.assertEqual(motion_page.truths_of(self.path, "nothing", "x", 9.0), [])

    def test_values_at_points(self):
        def point(said, value):
            mesh = types.SimpleNamespace(n=4, values={"x": value}, curves={})
            return types.SimpleNamespace(parameters=said, series=[
                types.SimpleNamespace(key="beamw", meshes=[mesh])])

        case = types.SimpleNamespace(
            parameters=[{"parameter": "time", "default": "9"}],
            points=[point("", 5.0), point("time=3", 4.0), point("time=3;step=1", 7.0)])
        x, y, n, whole = motion_page.over_time(case, "x")["beamw"]
        self.assertEqual((x.tolist(), y.tolist(), n, whole), ([3, 9], [4, 5], 4, False))

    def test_one_instant(self):
        mesh = types.SimpleNamespace(n=4, values={"tip_x": 1.0}, curves={})
        series = types.SimpleNamespace(key="beamw", meshes=[mesh])
        case = types.SimpleNamespace(
            name="pendulum", parameters=[{"parameter": "time", "default": "0.125"}],
            points=[types.SimpleNamespace(parameters="", series=[series], units={})])
        site = types.SimpleNamespace(truths=TRUTHS)
        self.assertGreater(len(motion_page.truths_of(TRUTHS, "pendulum", "tip_x", 0.125)), 1)
        self.assertIsNone(motion_page.draw_quantity(site, case, "tip_x", "figure"))

    def test_words(self):
        self.assertEqual(motion_page.between([2.04e-5, 1.96e-5], "{:.0e}"), "2e-05")
        self.assertEqual(motion_page.between([1, 3], "{:.1f}"), "1.0 to 3.0")
        self.assertEqual(motion_page.whenever("displacement of a along x, 0.125 s after the start of the "
                                              "motion, plus 1"), "displacement of a along x, plus 1")

    def test_stored_truths_are_read(self):
        with h5py.File(TRUTHS) as file:
            names = list(file["truths"])
        self.assertGreater(len(names), 10)
        for name in names:
            motion_page.truths_of(TRUTHS, name, "tip_x", 1.0)


if __name__ == "__main__":
    unittest.main()
