"""Pictures: geometry of what is drawn, and that a report with shapes has them."""
import types
import unittest

import numpy as np
from scipy.spatial.transform import Rotation

from harness.tools.kit.program import ProgramTest, drawn
from reports import pictures, shapes


class Geometry(unittest.TestCase):

    def test_axes(self):
        rotation = Rotation.from_rotvec([0.3, -1.1, 0.7])
        x, y, z, w = rotation.as_quat()
        np.testing.assert_allclose(shapes.matrices(np.array([w, x, y, z])),
                                   rotation.as_matrix().T,
                                   atol=1e-15)

    def test_hull(self):
        square = np.array([[0, 0, 1.], [1, 0, 1], [1, 1, 1], [0, 1, 1], [0.5, 0.5, 1]])
        faces = shapes.hull(square)
        self.assertEqual([len(f) for f in faces], [4])
        self.assertEqual(len(shapes.hull(square[:1])), 0)
        self.assertEqual([len(f) for f in shapes.hull(square[[0, 4, 2]])], [2])
        corners = np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)], float)
        self.assertEqual(len(shapes.hull(corners)), 12)

    def test_chosen(self):
        """Of an even path, whose middle is a little less than half as far, the end is shown; of one that returns both extremes."""
        for moved, wanted in (([0, 0.75, 1.499, 2.25,
                                3], [0, 2, 4]), ([0, 0.6, 1.2, 1.8, 2.4,
                                                  3], [0, 3, 5]), ([0, -3, -1.5, 0, 1.5,
                                                                    3], [0, 1, 5])):
            s = types.SimpleNamespace(
                kind=["undeformed"] + ["path"] * (len(moved) - 1),
                sections=[np.zeros((1, 1, 2))],
                position=np.array(moved, float)[:, None, None] * np.array([1, 0, 0]),
                axes=np.tile(np.eye(3), (len(moved), 1, 1, 1)))
            self.assertEqual(pictures.chosen(s), wanted)

    def test_clusters(self):
        points = np.array([[0, 0, 0.], [0.1, 0, 0], [1, 0, 0], [1, 0.1, 0]])
        self.assertEqual([list(g) for g in shapes.clusters(points)], [[0, 1], [2, 3]])

    def test_hinges(self):
        """Points at the ends of members that release something."""
        ends = types.SimpleNamespace(first=np.array([0, 13, 26, 39]),
                                     released=np.array([[0, 32], [1, 0], [0, 0]]))
        self.assertEqual(list(pictures.hinges(ends)), [12, 13])


    def test_view_of_a_plane(self):
        """A motion in the plane of x and y is looked at from above, x to the right; in space not,
        nor one along z, however small."""
        flat = np.array([[[0, 0, 0], [1, 0, 0]], [[0, 0, 0], [0, 1, 0]]], float)
        lifted = np.array([[[0, 0, 0], [1, 0, 0]], [[0, 0, 0], [1, 0, 0.01]]], float)
        for points, wanted in ((flat, (-90, 74)), (flat[..., [0, 2, 1]], (-58, 24)),
                               (lifted, (-58, 24))):
            s = types.SimpleNamespace(kind=["undeformed", shapes.FRAME], position=points)
            view = pictures.best_view(s, [1])
            self.assertEqual(view.angles, wanted)
        np.testing.assert_allclose(pictures.View(-90, 74).right, [1, 0, 0], atol=1e-15)


class Report(ProgramTest):

    def site(self, *options):
        return drawn(self.folder, "-k", "spherical_joint/default", "-f", "sheet_third", *options)

    def test_drawn(self):
        site = self.site("--shapes")
        name = "picture_spherical_joint.svg"
        self.assertGreater((site / name).read_text(encoding="utf-8").count("<path"), 50)
        self.assertIn("beamwork_shape(", (site / "shape_spherical_joint.js").read_text("utf-8"))
        for page in ("pictures.html", "spherical_joint.html"):
            text = (site / page).read_text(encoding="utf-8")
            self.assertIn(f'src="{name}"', text)
            self.assertIn('data-shape="spherical_joint"', text)

    def test_absent(self):
        """Results without shapes: no page, and how to get it is said with the environment."""
        site = self.site()
        self.assertFalse((site / "pictures.html").exists())
        about = (site / "environment.html").read_text(encoding="utf-8")
        self.assertIn("verify --shapes", about)


if __name__ == "__main__":
    unittest.main()
