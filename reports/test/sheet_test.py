"""Tests the direct SVG of drawings against matplotlib's figure: same size, same shapes, colours that change in dark mode."""
import re
import unittest

from harness.tools.kit.program import run
from reports.figures.svg import image_of
from reports.structure_drawing import draw, scene
from reports.structure_drawing.canvas import INK, LOAD, Canvas
from reports.structure_drawing.sheet import Sheet

class Site:
    class paper:
        @staticmethod
        def wants(name):
            return False


class Drawings(unittest.TestCase):

    def test_as_matplotlib_draws_it(self):
        for case in ("sheet_wagner", "winkler_beam", "spherical_joint"):
            with self.subTest(case):
                self.compare(scene.read(run("scene", case).stdout))

    def compare(self, read):
        own, other = draw.compose(read).image(Site, "a"), image_of(draw.draw(read), "a", [], tight=False)
        size = r' width="(\d+)" height="(\d+)"'
        self.assertEqual(re.search(size, own.markup).groups(), re.search(size, other.markup).groups())
        self.assertEqual(sorted(re.findall(r">([^<>]+)</text>", own.markup)), sorted(re.findall(r">([^<>]+)</text>", other.markup)))
        colours = r"(?:fill|stroke)=\"(var\([^\"]*\)|#[0-9a-f]{6})\""
        self.assertEqual(set(re.findall(colours, own.markup)), set(re.findall(colours, other.markup)))
        self.assertLess(len(own.markup), len(other.markup))

    def test_each_shape(self):
        canvas = Canvas()
        canvas.line([(0, 0), (10, 20)], LOAD, 2, (0, (4, 2)))
        canvas.area([(0, 0), (10, 0), (10, 20)], "white")
        canvas.dot((5, 5), 4, INK)
        canvas.label((10, 20), "a < b")
        markup = canvas.image(Site, "a").markup
        for part in ('stroke="var(--bad,#b03a00)" stroke-width="2" stroke-dasharray="8,4" d="M', 'fill="var(--paper,#fff)"',
                     "a2 2 0 1 0 4 0", ">a &lt; b</text>"):
            self.assertIn(part, markup)

    def test_coordinates(self):
        """y is upwards in the drawing and downwards in the file."""
        sheet = Sheet((0, 0), (100, 50))
        sheet.plot([0, 100], [0, 50], color=INK)
        self.assertIn('d="M0 50L100 0"', sheet.image("a").markup)


if __name__ == "__main__":
    unittest.main()
