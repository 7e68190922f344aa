"""The explorer: its numbers are those of the results, and in a browser it draws what is chosen. The
latter is skipped
where there is no Chromium."""
import json
import math
import re
import unittest

from harness.tools.kit.program import ProgramTest, drawn
from reports import data
from reports.test.browser_test import CHROMIUM, chromium, console

# Opens a copy of the page and chooses: what is said and drawn before and after.
ACTION = """<pre id="out"></pre><script>addEventListener("load", () => {
  const out = {}, q = what => document.querySelector(what), fields = document.forms.choice.elements;
  const seen = () => ({ curves: document.querySelectorAll("#explored [data-p]").length, label: q("#explored svg") && q("#explored svg").getAttribute("aria-label"), words: q("#explored-words").textContent });
  const choose = (name, value) => { fields[name].value = value; document.forms.choice.dispatchEvent(new Event("change")); };
  out.first = seen(); out.hash = location.hash;
  q("#explored").dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true,
  cancelable: true }));
  out.box = q("#said").innerText;
  choose("x", "u"); choose("y", "v"); out.second = seen();
  fields.case.value = "warping_torsion"; document.forms.choice.dispatchEvent(new Event("change"));
  setTimeout(() => { out.third = seen(); q("#out").textContent = JSON.stringify(out); }, 500);
});</script>"""


class Explorer(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.place = cls.class_folder()
        cls.site = drawn(cls.place, "-k", "elastica or warping_torsion/default")

    def stored(self, name):
        text = (self.site / f"data_{name}.js").read_text(encoding="utf-8")
        return json.loads(re.fullmatch(r'beamwork_data\("\w+", (.*)\);\n', text)[1])

    def test_numbers(self):
        """Every value of the results is there, to the digits that are stored."""
        case = data.read_case(str(self.place / "results.h5"), "elastica")
        stored = self.stored("elastica")
        points = stored["points"]

        def told(text):
            return stored["w"][text] if isinstance(text, int) else text

        def values(columns):
            """Of what has a truth they follow from the errors."""
            errors, _, truth, *plain = map(told, columns)
            if plain:
                return plain[0].split()
            return [e if e == "-" else float(truth) * (1 + float(e)) for e in errors.split()]

        self.assertEqual(len(points), len(case.points))
        seen = 0
        for point, found in zip(case.points, points):
            names = [name for name, _ in found["q"]]
            for series, one in zip((s for s in point.series if s.meshes), found["s"]):
                self.assertEqual(series.key, told(one[0]))
                self.assertEqual([m.n for m in series.meshes], [int(n) for n in told(one[1]).split()])
                for name, columns in zip(names, one[-1]):
                    for mesh, value in zip(series.meshes, values(columns) if columns else ()):
                        wanted = mesh.values.get(name, math.nan)
                        if value == "-":
                            self.assertFalse(math.isfinite(wanted))
                            continue
                        self.assertAlmostEqual(float(value), wanted, delta=1e-6 * abs(wanted))
                        seen += 1
        self.assertGreater(seen, 100)

    @unittest.skipUnless(CHROMIUM, "needs chromium")
    def test_browser(self):
        copy = self.site / "chosen.html"
        text = (self.site / "explorer.html").read_text(encoding="utf-8")
        copy.write_text(text.replace("</body>", ACTION + "</body>"), encoding="utf-8")
        ran = chromium(self.folder, "--virtual-time-budget=10000", "--dump-dom",
                       copy.as_uri() + "#case=elastica&name=w_over_L&x=n&y=e")
        self.assertEqual(console(ran), [])
        out = json.loads(re.search(r'<pre id="out">(.+?)</pre>', ran.stdout, re.S)[1])
        self.assertEqual(out["first"]["curves"], 10)
        self.assertEqual(out["first"]["label"],
                         "relative error of w_over_L against elements per member")
        self.assertIn("case=elastica", out["hash"])
        self.assertRegex(out["box"], r"(?s)beamw.*elements\s+1\b.*verdict")
        self.assertRegex(out["second"]["label"], r"w_over_L \[1\] against unknowns")
        self.assertTrue(out["third"]["words"].startswith("warping_torsion"))


if __name__ == "__main__":
    unittest.main()
