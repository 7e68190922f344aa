"""What a page does in a browser: a box at the marks, formulations switched off, folded parts on
paper, no page wider
than a phone. Skipped where there is no Chromium."""
import json
import re
import unittest

from harness.tools.kit.program import ProgramTest, drawn
from reports.test.browser_test import CHROMIUM, chromium, console

ACTION = """<pre id="out"></pre><script>addEventListener("load", () => {{
  const out = {{}}, q = (what, where = document) => where.querySelector(what), frame = q("[data-p]").closest("div.figure"), svg = q("svg", frame);
  const key = name => frame.dispatchEvent(new KeyboardEvent("keydown", {{ key: name, bubbles: true, cancelable: true }}));
  const hidden = f => [...document.querySelectorAll(`[data-f="${{f}}"]`)].map(g => g.style.display == "none");
  {action}
  q("#out").textContent = JSON.stringify(out);
}});</script>"""


@unittest.skipUnless(CHROMIUM, "needs chromium")
class Behaviour(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.site = drawn(cls.class_folder(), "-k", "elastica or warping_torsion/default")

    def done(self, page, action, *options):
        """What the action put into `out`, on a page opened from its file."""
        copy = self.site / f"acted_{page}"
        text = (self.site / page).read_text(encoding="utf-8")
        copy.write_text(text.replace("</body>", ACTION.format(action=action) + "</body>"),
                        encoding="utf-8")
        try:
            ran = chromium(self.folder, "--virtual-time-budget=10000", "--dump-dom", *options,
                           copy.as_uri())
        finally:
            copy.unlink()
        self.assertEqual(console(ran), [])
        found = re.search(r'<pre id="out">(.+?)</pre>', ran.stdout, re.S)
        self.assertIsNotNone(found, ran.stderr[-2000:])
        return json.loads(found.group(1).replace("&gt;", ">").replace("&lt;", "<"))

    def test_keyboard(self):
        """Arrow keys go from mark to mark and from curve to curve; Escape leaves."""
        out = self.done(
            "elastica.html", """
            key("ArrowRight"); out.first = q("#said").innerText;
            key("ArrowRight"); out.second = q("#said").innerText;
            key("ArrowDown"); out.other = q("#said b").innerText;
            out.aloud = q(".aloud").textContent;
            key("ArrowUp"); out.back = q("#said b").innerText;
            key("Escape"); out.gone = q("#said").hidden;""")
        self.assertRegex(out["first"], r"(?s)beamw.*w_over_L.*elements\s+1\b.*value.*error.*verdict")
        self.assertRegex(out["second"], r"elements\s+2\b")
        self.assertIn(out["other"], ("beamw_consistent", "beamw_first"))  # next by its times
        self.assertIn(out["other"], out["aloud"])
        self.assertEqual(out["back"], "beamw")
        self.assertTrue(out["gone"])

    def test_pointer(self):
        """On a mark the box says what it is, far from all there is none."""
        out = self.done(
            "elastica.html", """
            key("ArrowRight"); const ring = q("circle", svg).getBoundingClientRect();
            key("Escape");
            const at = (x, y) => svg.dispatchEvent(new PointerEvent("pointermove", { clientX: x, clientY: y, bubbles: true }));
            at(ring.x + ring.width / 2 + 2, ring.y + ring.height / 2); out.on = q("#said").hidden;
            const all = svg.getBoundingClientRect();
            at(all.x + all.width - 1, all.y + all.height - 1); out.off = q("#said").hidden;""")
        self.assertEqual(out, {"on": False, "off": True})

    def test_legend(self):
        """A click in one legend switches a formulation off in all figures of the page, another one
        on again."""
        out = self.done(
            "elastica.html", """
            const entry = q('[data-l="collocation"][role]', svg);
            out.before = hidden("collocation"); entry.dispatchEvent(new MouseEvent("click"));
            out.after = hidden("collocation"); out.pressed = entry.getAttribute("aria-pressed");
            entry.dispatchEvent(new KeyboardEvent("keydown", { key: "Enter" })); out.again = hidden("collocation");""")
        self.assertGreater(len(out["before"]), 8)
        self.assertEqual(set(out["before"]), {False})
        self.assertEqual((set(out["after"]), out["pressed"]), ({True}, "false"))
        self.assertEqual(set(out["again"]), {False})

    def test_at_most_eight(self):
        """Of ten formulations drawn eight are shown until the button is pressed."""
        out = self.done(
            "explorer.html", """
            const shown = () => new Set([...svg.querySelectorAll("[data-f]")].filter(g => g.style.display != "none").map(g => g.dataset.f)).size;
            out.first = shown(); q("button.more").click(); out.then = shown(); q("button.more").click(); out.last = shown();""")
        self.assertEqual(out, {"first": 8, "then": 10, "last": 8})

    def test_paper(self):
        """What is folded is open on paper and folded again after it."""
        out = self.done(
            "elastica.html", """
            const open = () => document.querySelectorAll("details:not([open])").length;
            out.before = open(); dispatchEvent(new Event("beforeprint")); out.on = open();
            dispatchEvent(new Event("afterprint")); out.after = open();""")
        self.assertGreater(out["before"], 0)
        self.assertEqual((out["on"], out["after"]), (0, out["before"]))

    def test_phone(self):
        """No page is wider than a phone: tables and figures scroll in themselves."""
        frames = "".join(f'<iframe width="390" height="800" src="{p.name}"></iframe>'
                         for p in sorted(self.site.glob("*.html")))
        driver = self.site / "phone.html"
        driver.write_text(
            f"""<body>{frames}<pre id="out"></pre><script>addEventListener("load", () => {{
              q = [...document.querySelectorAll("iframe")].filter(f => f.contentDocument.documentElement.scrollWidth > 391).map(f => f.src);
              document.getElementById("out").textContent = JSON.stringify(q); }});</script></body>""",
            encoding="utf-8")
        ran = chromium(self.folder, "--virtual-time-budget=60000", "--dump-dom", driver.as_uri())
        driver.unlink()
        found = re.search(r'<pre id="out">(.+?)</pre>', ran.stdout, re.S)
        self.assertEqual(json.loads(found.group(1)), [])


if __name__ == "__main__":
    unittest.main()
