"""The viewer, the explorer and figures must show the stored values, and react to keyboard and pointer."""
import base64
import json
import math
import re
import types
import unittest

import numpy as np

from harness.tools.kit.program import ProgramTest, drawn
from reports import data, shapes
from reports.test.browser_test import CHROMIUM, chromium, console


ACTION = """<pre id="out"></pre><script>addEventListener("load", () => {
  const out = {}, place = document.querySelector("div.viewer");
  const picture = () => {
    const from = place.querySelector("canvas"), { width, height } = from;
    const flat = Object.assign(document.createElement("canvas"), { width, height }).getContext("2d");
    flat.drawImage(from, 0, 0);
    return flat.getImageData(0, 0, width, height).data;
  };
  const drawn = data => data.reduce((sum, value, i) => sum + (i % 4 == 3 && value > 0 ? 1 : 0), 0);
  const differ = (a, b) => a.reduce((sum, value, i) => sum + (value != b[i] ? 1 : 0), 0);
  const look = () => {
    if (!place.querySelector("canvas")) { setTimeout(look, 50); return; }
    const first = picture(), slider = place.querySelector("input");
    out.pixels = first.length / 4; out.drawn = drawn(first); out.words = place.querySelector("output").textContent;
    slider.value = 0; slider.dispatchEvent(new Event("input"));
    const rest = picture(); out.moved = differ(first, rest); out.rest = place.querySelector("output").textContent;
    place.querySelector("canvas").dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight",
    cancelable: true }));
    out.turned = differ(rest, picture());
    document.querySelector("#out").textContent = JSON.stringify(out);
  };
  look();
});</script>"""


class Stored(ProgramTest):

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        cls.site = drawn(folder, "-k", "spherical_joint/default", "-f", "sheet_third", "--shapes")
        place = types.SimpleNamespace(results=str(folder / "results.h5"))
        cls.shapes = shapes.read(place, types.SimpleNamespace(name="spherical_joint"))
        text = (cls.site / "shape_spherical_joint.js").read_text(encoding="utf-8")
        cls.found = json.loads(re.fullmatch(r'beamwork_shape\("spherical_joint", (.*)\);\n', text)[1])

    def numbers(self, name, width):
        whole = np.frombuffer(base64.b64decode(self.found[name]), "<i2") / shapes.WHOLE
        return whole.reshape(len(self.found["states"]), -1, width)

    def test_nodes(self):
        half, nodes = self.found["half"], self.numbers("nodes", 3) * self.found["half"]
        for k, of in enumerate(shapes.exaggerations(self.shapes)):
            wanted = self.shapes.nodes[0] + of * (self.shapes.nodes[k] - self.shapes.nodes[0])
            off = nodes[k] - wanted
            self.assertLess(np.ptp(off, axis=0).max(), 1.01 * half / shapes.WHOLE)

    def test_axes(self):
        w, x, y, z = np.moveaxis(self.numbers("at", 7)[0][:, 3:], -1, 0)
        second = np.stack([2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)], axis=1)
        at, _ = shapes.kept(self.shapes)
        np.testing.assert_allclose(second, self.shapes.axes[0][at, 1], atol=2e-4)

    def test_members(self):
        self.assertEqual(len(self.found["members"]), len(self.shapes.members))
        self.assertEqual(self.found["members"][-1][1], self.found["count"])
        self.assertTrue(all(self.found["profiles"][p]["strips"] for _, _, p in self.found["members"]))
        nodes = {i for face in self.found["bodies"] for i in face}
        self.assertLess(max(nodes | set(self.found["held"])), self.found["ends"])

    def test_a_path_has_one_exaggeration(self):
        move = np.array([0, 1e-12, 1e-3])
        s = types.SimpleNamespace(kind=["undeformed", "path", "path"], sections=[np.zeros((1, 4, 2))],
                                  position=np.array([[[0, 0, 0], [1, m, 0]] for m in move], float),
                                  axes=np.tile(np.eye(3), (3, 2, 1, 1)))
        self.assertEqual(shapes.exaggerations(s), [1.0, 100.0, 100.0])

    @unittest.skipUnless(CHROMIUM, "needs chromium")
    def test_browser(self):
        copy = self.site / "turned.html"
        text = (self.site / "pictures.html").read_text(encoding="utf-8")
        copy.write_text(text.replace("</body>", ACTION + "</body>"), encoding="utf-8")
        ran = chromium(self.folder, "--virtual-time-budget=20000", "--dump-dom", copy.as_uri(),
                       software=True)
        self.assertEqual(console(ran), [])
        out = json.loads(re.search(r'<pre id="out">(.+?)</pre>', ran.stdout, re.S)[1])
        self.assertGreater(out["drawn"], 0.01 * out["pixels"])
        self.assertGreater(out["moved"], 0.01 * out["pixels"])
        self.assertGreater(out["turned"], 0.01 * out["pixels"])
        self.assertNotEqual(out["words"], out["rest"])
        without = chromium(self.folder, "--disable-3d-apis", "--virtual-time-budget=3000", "--dump-dom",
                           (self.site / "pictures.html").as_uri())
        self.assertNotIn("<canvas", without.stdout)
        self.assertIn('<img src="picture_spherical_joint.svg"', without.stdout)


EXPLORER_ACTION = """<pre id="out"></pre><script>addEventListener("load", () => {
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
        case = data.read_case(str(self.place / "results.h5"), "elastica")
        stored = self.stored("elastica")
        points = stored["points"]

        def told(text):
            return stored["w"][text] if isinstance(text, int) else text

        def values(columns):
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
        copy.write_text(text.replace("</body>", EXPLORER_ACTION + "</body>"), encoding="utf-8")
        ran = chromium(self.folder, "--virtual-time-budget=10000", "--dump-dom",
                       copy.as_uri() + "#case=elastica&name=w_over_L&x=n&y=e")
        self.assertEqual(console(ran), [])
        out = json.loads(re.search(r'<pre id="out">(.+?)</pre>', ran.stdout, re.S)[1])
        self.assertEqual(out["first"]["curves"], 10)
        self.assertEqual(out["first"]["label"],
                         "relative error of w_over_L against elements per member")
        self.assertIn("case=elastica", out["hash"])
        self.assertRegex(out["box"], r"(?s)beamw.*n\s+1\b.*verdict")
        self.assertRegex(out["second"]["label"], r"w_over_L \[1\] against unknowns")
        self.assertTrue(out["third"]["words"].startswith("warping_torsion"))


BEHAVIOUR_ACTION = """<pre id="out"></pre><script>addEventListener("load", () => {{
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
        copy = self.site / f"acted_{page}"
        text = (self.site / page).read_text(encoding="utf-8")
        copy.write_text(text.replace("</body>", BEHAVIOUR_ACTION.format(action=action) + "</body>"),
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
        out = self.done(
            "elastica.html", """
            key("ArrowRight"); out.first = q("#said").innerText;
            key("ArrowRight"); out.second = q("#said").innerText;
            out.start = q("#said b").innerText;
            key("ArrowDown"); out.other = q("#said b").innerText;
            out.aloud = q(".aloud").textContent;
            key("ArrowUp"); out.back = q("#said b").innerText;
            key("Escape"); out.gone = q("#said").hidden;""")
        self.assertRegex(out["first"], r"(?s)beamw.*w_over_L.*n\s+1\b.*value.*error.*verdict")
        self.assertRegex(out["second"], r"n\s+2\b")
        self.assertNotEqual(out["other"], out["start"])
        self.assertIn(out["other"], out["aloud"])
        self.assertEqual(out["back"], out["start"])
        self.assertTrue(out["gone"])

    def test_pointer(self):
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
        out = self.done(
            "explorer.html", """
            const shown = () => new Set([...svg.querySelectorAll("[data-f]")].filter(g => g.style.display != "none").map(g => g.dataset.f)).size;
            out.first = shown(); q("button.more").click(); out.then = shown(); q("button.more").click(); out.last = shown();""")
        self.assertEqual(out, {"first": 8, "then": 10, "last": 8})

    def test_paper(self):
        out = self.done(
            "elastica.html", """
            const open = () => document.querySelectorAll("details:not([open])").length;
            out.before = open(); dispatchEvent(new Event("beforeprint")); out.on = open();
            dispatchEvent(new Event("afterprint")); out.after = open();""")
        self.assertGreater(out["before"], 0)
        self.assertEqual((out["on"], out["after"]), (0, out["before"]))

    def test_phone(self):
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
