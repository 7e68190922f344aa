"""Maps of a sweep over the axes of the reader's choice, in a browser; skipped where there is none.
"""
import html
import json
import re
import unittest

import numpy as np

from harness.tools.kit.program import ProgramTest, report
from reports.sweep import gather, maps, stored
from reports.test import sweeps
from reports.test.browser_test import CHROMIUM, chromium, console
from reports.test.sweep_test import ANGLE, SHAPE, WIDTH

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
    """Maps over the axes of the reader's choice."""

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
        """The folder is that of the class."""

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
        """What the script draws of the same choice is what stands in the page."""
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
        """What is told at these sizes: the sentence, and {formulation: (needs, error)}."""
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
        """Nothing makes the page wider than the window."""
        found = self.chosen("document.body.style.width = '366px';")
        self.assertLessEqual(found["wide"], 390)

    def test_axes_that_are_the_same(self):
        found = self.chosen("form.elements.x.value = form.elements.y.value;")
        self.assertEqual(found["told"], "Choose axes that differ.")


if __name__ == "__main__":
    unittest.main()
