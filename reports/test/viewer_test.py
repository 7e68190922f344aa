"""Shapes that can be turned: what is stored of them, and that a browser draws them. The latter is
skipped where there
is no Chromium."""
import base64
import json
import re
import types
import unittest

import numpy as np

from harness.tools.kit.program import ProgramTest, drawn
from reports import shapes
from reports.test.browser_test import CHROMIUM, chromium, console

# Opens a copy of a page, waits for the viewer, counts what is drawn in three states of it.
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
        """They are where the results have them, to half a unit of what is stored."""
        half, nodes = self.found["half"], self.numbers("nodes", 3) * self.found["half"]
        for k, of in enumerate(shapes.exaggerations(self.shapes)):
            wanted = self.shapes.nodes[0] + of * (self.shapes.nodes[k] - self.shapes.nodes[0])
            off = nodes[k] - wanted
            self.assertLess(np.ptp(off, axis=0).max(), 1.01 * half / shapes.WHOLE)

    def test_axes(self):
        """The stored quaternions turn the axes of space into those of the section."""
        w, x, y, z = np.moveaxis(self.numbers("at", 7)[0][:, 3:], -1, 0)
        second = np.stack([2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)], axis=1)
        at, _ = shapes.kept(self.shapes)
        np.testing.assert_allclose(second, self.shapes.axes[0][at, 1], atol=2e-4)

    def test_members(self):
        """Every member has its points and a profile, and a body only nodes that there are."""
        self.assertEqual(len(self.found["members"]), len(self.shapes.members))
        self.assertEqual(self.found["members"][-1][1], self.found["count"])
        self.assertTrue(all(self.found["profiles"][p]["strips"] for _, _, p in self.found["members"]))
        nodes = {i for face in self.found["bodies"] for i in face}
        self.assertLess(max(nodes | set(self.found["held"])), self.found["ends"])

    def test_a_path_has_one_exaggeration(self):
        """A state near the start of a path is not blown up more than its end."""
        move = np.array([0, 1e-12, 1e-3])
        s = types.SimpleNamespace(kind=["undeformed", "path", "path"], sections=[np.zeros((1, 4, 2))],
                                  position=np.array([[[0, 0, 0], [1, m, 0]] for m in move], float),
                                  axes=np.tile(np.eye(3), (3, 2, 1, 1)))
        self.assertEqual(shapes.exaggerations(s), [1.0, 100.0, 100.0])

    @unittest.skipUnless(CHROMIUM, "needs chromium")
    def test_browser(self):
        """Something is drawn, the slider and an arrow key change it; without WebGL the still
        stays."""
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


if __name__ == "__main__":
    unittest.main()
