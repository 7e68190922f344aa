"""The viewer and films must play the frames of a motion that the results contain."""
import base64
import contextlib
import io
import json
import re
import sys
import unittest

import numpy as np

from harness.tools.kit.program import ROOT, TRUTHS, ProgramTest, run
from reports import film, shapes
from reports.test import frames
from reports.test.browser_test import CHROMIUM, chromium, console

TIMES = np.linspace(0, 0.5, 26)
CASE = "spherical_joint"

CLOCK = """<script>
window.due = null; window.requestAnimationFrame = next => { window.due = next; };
window.IntersectionObserver = class {
  constructor(seen) { this.seen = seen; } unobserve() {}
  observe(target) { this.seen([{ isIntersecting: true, target }]); }
};</script>"""

ACTION = """<pre id="out"></pre><script>addEventListener("load", () => {{
  const out = {{}}, place = document.querySelector("div.viewer");
  const q = what => place.querySelector(what), time = () => q("output").textContent;
  const key = name => q("canvas").dispatchEvent(
    new KeyboardEvent("keydown", {{ key: name, bubbles: true, cancelable: true }}));
  {action}
  document.querySelector("#out").textContent = JSON.stringify(out);
}});</script>"""


def filmed(results, target):
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        return film.main([str(results), "-o", str(target)])


class Film(ProgramTest):

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        cls.results = folder / "results.h5"
        run("verify", "-k", f"{CASE}/default", "-f", "sheet_third", "--shapes", "-o", cls.results)
        cls.plain = folder / "plain.h5"
        cls.plain.write_bytes(cls.results.read_bytes())
        frames.only(cls.results, CASE, TIMES, rate=2.0)
        cls.film = folder / "film.html"
        assert filmed(cls.results, cls.film) == 0
        cls.text = cls.film.read_text(encoding="utf-8")
        cls.shape = json.loads(re.search(rf'id="shape_{CASE}">(.*?)</script>', cls.text, re.S)[1])

    def numbers(self, name, width):
        whole = np.frombuffer(base64.b64decode(self.shape[name]), "<i2") / shapes.WHOLE
        return whole.reshape(len(self.shape["states"]), -1, width)

    def test_frames_are_those_of_the_file(self):
        s = shapes.read_file(self.results, CASE)
        at, _ = shapes.kept(s, film.MOST)
        self.assertEqual(self.shape["times"][1:], TIMES.tolist())
        half, found = self.shape["half"], self.numbers("at", 7)[..., :3]
        off = found * self.shape["half"] - s.position[:, at]
        self.assertLess(np.ptp(off, axis=(0, 1)).max(), 1.01 * half / shapes.WHOLE)
        off = self.numbers("nodes", 3) * half - s.nodes
        self.assertLess(np.ptp(off, axis=(0, 1)).max(), 1.01 * half / shapes.WHOLE)

    def test_sections_turn_with_their_frames(self):
        s = shapes.read_file(self.results, CASE)
        angle = 2.0 * (TIMES[-1] - TIMES[0])
        turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0],
                         [0, 0, 1]])
        np.testing.assert_allclose(s.axes[-1], s.axes[1] @ turn.T, atol=1e-12)

    def test_thinned(self):
        s = shapes.read_file(self.results, CASE)
        states = shapes.drawn_states(s, shapes.LEAST * len(s.members) * 6)
        self.assertEqual([states[0], states[1], states[-1]], [0, 1, len(TIMES)])
        self.assertEqual(len(states), 7)
        apart = np.diff(states[1:])
        self.assertLessEqual(apart.max() - apart.min(), 1)
        self.assertEqual(shapes.drawn_states(s), list(range(len(TIMES) + 1)))

    def test_alone(self):
        self.assertLess(len(self.text), 2_000_000)
        page = self.text.replace(self.shape["at"], "")
        self.assertNotRegex(page, r'<(?:script|link|img)[^>]*(?:src|href)="(?!data:)')
        self.assertNotRegex(page.replace('"http://www.w3.org/2000/svg"', ""), "https?://")

    def test_words(self):
        self.assertIn("0 to 0.5 s, computed with sheet_third", self.text)

    def test_refusals(self):
        for results, code in ((self.plain, 2), (self.folder / "none.h5", 4)):
            target = self.folder / "none.html"
            self.assertEqual(filmed(results, target), code)
            self.assertFalse(target.exists())
        with self.assertRaisesRegex(film.NoFilm, f"no frames of 'nobody'.*{CASE}"):
            film.chosen(self.results, "nobody")

    def test_results_are_not_replaced(self):
        before = self.results.read_bytes()
        self.assertEqual(filmed(self.results, self.results), 2)
        self.assertEqual(self.results.read_bytes(), before)

    def test_as_a_report(self):
        target = self.folder / "same.html"
        done = run("-B", "-m", "reports", self.results, TRUTHS, "--film", target, "-k", CASE,
                   program=sys.executable, cwd=ROOT)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(target.read_text(encoding="utf-8"), self.text)

    def done(self, action, *options):
        copy = self.folder / "acted.html"
        text = self.text.replace("<main>", CLOCK + "<main>")
        copy.write_text(text.replace("</body>", ACTION.format(action=action) + "</body>"),
                        encoding="utf-8")
        ran = chromium(self.folder, "--virtual-time-budget=5000", "--dump-dom", *options,
                       copy.as_uri(), software=True)
        self.assertEqual(console(ran), [])
        found = re.search(r'<pre id="out">(.+?)</pre>', ran.stdout, re.S)
        self.assertIsNotNone(found, ran.stderr[-2000:])
        return json.loads(found[1].replace("&lt;", "<").replace("&gt;", ">"))

    @unittest.skipUnless(CHROMIUM, "needs chromium")
    def test_plays(self):
        out = self.done("""
            out.label = q("button").textContent; out.live = q("output").getAttribute("aria-live");
            q("button").click(); out.paused = q("button").textContent;
            out.aloud = q("output").getAttribute("aria-live");
            let now = 0; key("Home"); q("select").selectedIndex = 3; q("button").click();
            out.seen = []; out.speed = Number(q("select").value);
            for (let i = 0; i < 400; i++) {
              const next = window.due; next(now += 25); out.seen.push(parseFloat(time().slice(4)));
            }
            q("button").click();
            const stays = time(); window.due(now += 1000); out.stays = time() == stays;""")
        self.assertEqual((out["label"], out["live"]), ("Pause", "off"))
        self.assertEqual((out["paused"], out["aloud"]), ("Play", "polite"))
        self.assertTrue(out["stays"])
        begin = next(i for i, t in enumerate(out["seen"]) if i and t < out["seen"][i - 1])
        once = out["seen"][:begin]
        for i, t in enumerate(once):
            wanted = TIMES[TIMES <= 0.025 * i * out["speed"] + 1e-9][-1]
            self.assertAlmostEqual(t, wanted, places=4)
        self.assertEqual((once[-1], out["seen"][begin]), (TIMES[-1], 0))
        rest = 0.025 * begin - TIMES[-1] / out["speed"]
        self.assertAlmostEqual(rest, 0.6, delta=0.06)

    @unittest.skipUnless(CHROMIUM, "needs chromium")
    def test_keyboard(self):
        out = self.done("""
            key(" "); out.paused = q("button").textContent;
            key("Home"); out.home = time(); key("."); out.next = time();
            key(","); key(","); out.before = time();
            key("End"); out.end = time(); key("."); out.beyond = time();
            const slider = q("input");
            const to = value => { slider.value = value; slider.dispatchEvent(new Event("input")); };
            to(slider.max); out.last = time(); to(slider.min); out.first = time();
            out.aloud = slider.getAttribute("aria-valuetext");
            const speed = q("select").selectedIndex;
            key("<"); out.slower = q("select").selectedIndex - speed;
            key(">"); key(">"); out.faster = q("select").selectedIndex - speed;
            key(" "); out.again = q("button").textContent;""")
        self.assertEqual((out["paused"], out["again"]), ("Play", "Pause"))
        self.assertEqual((out["home"], out["next"], out["before"]), ("t = 0 s", "t = 0.02 s",
                                                                     "t = 0 s"))
        self.assertEqual((out["end"], out["beyond"], out["last"]), ("t = 0.5 s",) * 3)
        self.assertEqual((out["first"], out["aloud"]), ("undeformed",) * 2)
        self.assertEqual((out["slower"], out["faster"]), (-1, 1))

    @unittest.skipUnless(CHROMIUM, "needs chromium")
    def test_less_motion(self):
        out = self.done("""
            out.asked = window.due !== null; out.label = q("button").textContent; out.time = time();
            key(" "); out.then = q("button").textContent;""", "--force-prefers-reduced-motion")
        self.assertEqual(out, {"asked": False, "label": "Play", "time": "t = 0 s", "then": "Pause"})

    @unittest.skipUnless(CHROMIUM, "needs chromium")
    def test_without_graphics(self):
        ran = chromium(self.folder, "--disable-3d-apis", "--virtual-time-budget=3000",
                       "--dump-dom", self.film.as_uri())
        self.assertNotIn("<canvas", ran.stdout)
        self.assertIn("<svg", ran.stdout)


class Genuine(ProgramTest):

    def test_examples(self):
        for name in ("slider_crank", "released_guide", "robot_arm"):
            results, target = self.folder / f"{name}.h5", self.folder / f"{name}.html"
            self.answered("solve", "--scene", ROOT / "cases" / "examples" / f"{name}.yaml", "-f",
                          "collocation", "-n", 1, "--shapes", "-o", results)
            self.assertEqual(filmed(results, target), 0)
            s = shapes.read_file(results, name)
            times = s.value[shapes.frames_of(s)]
            self.assertGreater(len(times), 15)
            self.assertTrue((np.diff(times) > 0).all())
            self.assertIn(f" to {times[-1]:.4g} s", target.read_text(encoding="utf-8"))
            moved = np.ptp(s.nodes[shapes.frames_of(s)], axis=0).max()
            self.assertGreater(moved, 0.01 * shapes.size_of(s))


if __name__ == "__main__":
    unittest.main()
