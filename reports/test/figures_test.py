"""Figures in pages: identifiers unique, text kept, colours that follow the page, curves that say
whose they are."""
import json
import re
import unittest

from reports import figures, style
from reports.style import Styles, plt


def drawn(name, said=(), gid=None):
    figure, axes = plt.subplots(figsize=(3, 2))
    look = Styles.of("beamw:mass=lumped")
    axes.plot([1, 2, 4], [1, 3, 2], label="the <curve>", **{**look, "gid": gid or look["gid"]})
    axes.axhspan(1, 2, color="0.75")
    axes.legend()
    return figures.image_of(figure, name, said)


class Figures(unittest.TestCase):

    def test_identifiers(self):
        """Those of two figures differ, every one that is used is there."""
        one, two = (set(re.findall(r' id="([^"]+)"', drawn(name).markup)) for name in ("a", "b"))
        self.assertGreater(len(one), 2)
        self.assertFalse(one & two)
        self.assertEqual(set(re.findall(r'[("]#(\w+)', drawn("a").markup)), one)

    def test_colours(self):
        """Ink is that of the text, also where it is grey; a formulation's colour is a variable."""
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
        """Curve, handle and words of the legend belong to the formulation; the marks of a curve are
        in the order of
        what is said of them."""
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
        """The look of a formulation depends on its name alone; options change the line only."""
        for keys in (["beamw"], ["another", "beamw"]):
            self.assertEqual(Styles(keys).of("beamw")["color"], "#0072b2")
        self.assertEqual(Styles.of("mine"), Styles.of("mine"))
        self.assertIn(Styles.of("mine")["color"], [light for light, _ in style.RESERVE])
        one, other = Styles.of("beamw"), Styles.of("beamw:mass=lumped")
        self.assertEqual((one["color"], one["marker"]), (other["color"], other["marker"]))
        self.assertNotEqual(one["linestyle"], other["linestyle"])

    def test_table(self):
        """No two formulations look alike."""
        looks = list(style.TABLE.values())
        for column in zip(*looks):
            self.assertEqual(len(set(column)), len(looks))

    def test_classes(self):
        """What curves share is said once in a page; curves that differ do not share it."""
        curve = '<polyline points="{}" stroke="red" stroke-dasharray="1 2" style="{}:url(#k1)"/>'
        page = "<head></head>" + "".join(curve.format(*one) for one in (
            ("0,0", "marker"), ("1,1", "marker"), ("2,2", "marker-mid")))
        made = figures.with_classes(page)
        self.assertEqual(re.findall('points="(.*?)" class="(.*?)" stroke-dasharray="1 2"/>', made),
                         [("0,0", "q0"), ("1,1", "q0"), ("2,2", "q1")])
        self.assertIn(".q0{stroke:red;marker:url(#k1)}.q1{stroke:red;marker-mid:url(#k1)}</style>",
                      made)
        self.assertEqual(figures.with_classes("<head></head>"), "<head></head>")


if __name__ == "__main__":
    unittest.main()
