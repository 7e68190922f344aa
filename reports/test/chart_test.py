"""Charts written by themselves: where things are, ticks, legends, what marks say."""
import json
import re
import types
import unittest
import xml.etree.ElementTree

from reports import chart, figures
from reports.site import Site
from reports.style import Styles


def site():
    """What a chart asks of a site."""
    found = types.SimpleNamespace(said=[], styles=Styles([]))
    found.points = types.MethodType(Site.points, found)
    return found


class Axes(unittest.TestCase):

    def test_part(self):
        """Decades are equally long; the margin keeps what is drawn inside."""
        one = chart.Axis(log=True)
        one.take([1e-3, 1e-1, 1e1, 0, float("nan")])
        one.settle()
        low, middle, high = one.part([1e-3, 1e-1, 1e1])
        self.assertAlmostEqual(middle, 0.5)
        self.assertGreater(low, 0.02)
        self.assertAlmostEqual(high, 1 - low)

    def test_ticks(self):
        self.assertEqual([w for _, w in chart.log_ticks(0.5e-3, 20)],
                         ["10⁻³", "10⁻²", "10⁻¹", "1", "10"])
        self.assertLessEqual(len(chart.log_ticks(1e-14, 1)), 8)
        self.assertEqual(chart.whole_ticks(0.9, 70), [1, 2, 5, 10, 20, 50])
        self.assertEqual(chart.whole_ticks(9.7, 13.2), [10, 11, 12, 13])
        self.assertEqual([w for _, w in chart.linear_ticks(-0.1, 1.05)],
                         ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"])
        for low, high in ((1.2, 1.9), (3.1, 3.2), (40, 41)):
            self.assertGreater(len(chart.whole_ticks(low, high)), 0)

    def test_nothing_to_scale(self):
        """One value, and none, have an axis too."""
        for values in ([3.0], []):
            one = chart.Axis(log=True, whole=True)
            one.take(values)
            one.settle()
            self.assertLess(one.low, one.high)


class Charts(unittest.TestCase):

    def drawn(self):
        place, picture = site(), chart.Chart(2, (100, 80))
        one = picture.panel("<one>", "x", "y")
        two = picture.panel("two", "x", like=one)
        look = place.points("beamw", ("elements", "error"), [(1, 0.5), (2, 0.25)], "w")
        for panel in (one, two):
            panel.plot([1, 2], [0.5, 0.25], label="beamw", **look)
        two.plot([1, 4], [0.1, 0.1], label="<theirs>", color="currentColor", marker="s", hollow=True)
        one.level(0.01, "tolerance")
        one.below = 0.02
        one.cross(2, look["color"], look["gid"].rpartition("|")[0])
        return picture.image(place, "some")

    def test_valid(self):
        """The file of its own is well-formed, and every marker that is used is defined."""
        text = figures.alone(self.drawn().markup)
        xml.etree.ElementTree.fromstring(text.encode())
        self.assertEqual(set(re.findall(r"url\(#(\w+)\)", text)),
                         set(re.findall(r'marker id="(\w+)"', text)))
        self.assertIn("&lt;one&gt;", text)
        self.assertIn("&lt;theirs&gt;", text)

    def test_points(self):
        """Both panels speak of the same points; the curve is where its values are."""
        image = self.drawn()
        self.assertEqual(image.markup.count('data-f="beamw" data-p="0"'), 2)
        said = json.loads(image.points)
        self.assertEqual([said["v"][i] for i in said["s"][0]["r"]], [[1, 2], [0.5, 0.25]])
        self.assertIn('data-l="beamw"', image.markup)
        curve = re.search(r'data-p="0"><polyline points="([^"]+)"', image.markup).group(1)
        (x0, y0), (x1, y1) = (map(float, p.split(",")) for p in curve.split())
        self.assertLess(x0, x1)
        self.assertLess(y0, y1)  # a smaller error is farther down


if __name__ == "__main__":
    unittest.main()
