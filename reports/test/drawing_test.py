"""Drawings of scenes must contain every load, motion, spring, support and constraint of the scene. Labels must not
overlap."""
import itertools
import pathlib
import tempfile
import unittest
from dataclasses import replace

import numpy as np

from harness.tools.kit.program import ROOT, run
from reports import pictures, shapes
from reports.structure_drawing import describe, draw, geometry, loads, members, scene
from reports.structure_drawing.canvas import Canvas, boxes_overlap
from reports.figures.style import plt


LOADED = ROOT / "cases/format/test/good/loaded.yaml"


def written():
    found = {p.stem: ("scene", p.stem) for p in (ROOT / "cases" / "benchmarks").glob("*.[cy]*")}
    found.update({p.stem: ("scene", "--scene", str(p))
                  for p in (ROOT / "cases" / "examples").glob("*.yaml")})
    return {name: run(*arguments).stdout for name, arguments in sorted(found.items())}


class Arrows(Canvas):
    def __init__(self):
        super().__init__()
        self.arrows = []

    def arrow(self, points, *more, **named):
        super().arrow(points, *more, **named)
        self.arrows.append(np.asarray(points))


class Drawings(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.scenes = {name: scene.read(text) for name, text in written().items()}

    def test_all_of_them(self):
        self.assertGreaterEqual(len(self.scenes), 49)

    def test_motions_in_time(self):
        one = self.scenes["spin_up"]
        self.assertEqual(one.motions, {"turn": ()})
        self.assertEqual(loads.motion_words(one, "turn", True), "turn, in time")
        self.assertEqual(describe.motion("turn", ()), "turn: a function of time")
        self.assertEqual(describe.motion("turn", None), "turn: unknown")
        self.assertIsNone(scene.read_motion({"such_that": {}}))

    def test_everything_is_on_the_drawing(self):
        for name, one in self.scenes.items():
            figure = draw.draw(one)
            marks = [a.get_gid() for a in figure.findobj() if a.get_gid()]
            wanted = [load.name for load in one.loads] + [s.name for s in one.springs]
            wanted += [f"support_{n.name}" for n in members.supported(one)]
            wanted += [f"constraint_{c.name}" for c in one.constraints]
            wanted += [f"offset_{m.name}_{end}" for m in one.members.values() for end in (0, 1) if m.offset[end].any()]
            wanted += ["spin"] if one.spin is not None and one.spin.omega.any() else []
            for mark in wanted:
                self.assertEqual(marks.count(mark), 1, f"{name}: {mark}")
            moved = [n.name for n in one.nodes.values() for _ in loads.motions_of(one, n)]
            self.assertEqual(len([m for m in marks if m.startswith("motion_")]), len(moved), name)
            plt.close(figure)

    def test_offsets_and_constraints(self):
        one = self.scenes["composite_beam"]
        line = geometry.line_of(one, one.members["upper"])
        np.testing.assert_allclose(line.points, [[0, 0.01, 0], [2, 0.01, 0]])
        self.assertEqual(dict(describe.describe(one))["Offset ends"][1], "upper at end: (0, 0.01, 0) m from it")
        said = [line for name in ("eccentric_storey", "geared_shafts") for line in dict(describe.describe(self.scenes[name]))["Constraints"]]
        self.assertEqual(said, ["floor: rigid in its plane (middle, a, b, c, d)", "gear: rz of wheel_2 = -2 rz of wheel_1",
                                "coupled: rz equal (wheel_2, clutch)"])

    def test_loads_on_parts_of_members(self):
        one = scene.read(run("scene", "--scene", str(LOADED)).stdout)
        self.assertEqual(len(one.loads), 19)
        figure = draw.draw(one)
        marks = [a.get_gid() for a in figure.findobj() if a.get_gid()]
        for load in one.loads:
            self.assertEqual(marks.count(load.name), 1, load.name)
        plt.close(figure)
        said = dict(describe.describe(one))["Loads"]
        for words in ("force 2 N along +y on leaf at 25 % of it, offset by (0, 0, 0.001) m",
                      "moment 1 N m about +y on leaf at 33.33 % of it, in the member's axes, rotates with it",
                      "distributed 1 N/m along +y on leaf from 25 % to 75 % of it, offset by (0, 0, 0.001) m",
                      "distributed (0, 0, 0) to (0, 3, 0) N/m on leaf, rotates with it",
                      "distributed 1 N/m along +y on leaf, lumped at its nodes"):
            self.assertIn(words, said)
        part, ramp, same = (self.arrows(one, name) for name in ("part", "ramp", "same"))
        self.assertEqual([len(part), len(ramp), len(same)], [loads.ALONG, loads.ALONG, 1])
        tips = part[:, 1, 0]
        self.assertTrue(0.025 < tips.min() < 0.027 and 0.073 < tips.max() < 0.075, tips)
        sizes = np.linalg.norm(ramp[:, 1] - ramp[:, 0], axis=1)
        self.assertTrue(np.all(np.diff(sizes) >= 0) and sizes[-1] > 5 * sizes[0], sizes)
        np.testing.assert_allclose(same[0, 0], (0.1, 0.05), atol=1e-12)

    @staticmethod
    def arrows(one, name):
        load = next(each for each in one.loads if each.name == name)
        canvas, line = Arrows(), geometry.line_of(one, one.members[load.on])
        only = replace(one, loads=[load])
        loads.put_loads(canvas, geometry.View(*np.eye(3)[:2]), only, {load.on: line}, None)
        return np.array(canvas.arrows)

    def test_labels_keep_clear(self):
        for name, one in self.scenes.items():
            canvas = draw.compose(one)
            for a, b in itertools.combinations(canvas.boxes, 2):
                self.assertLess(boxes_overlap(a, b), 12, f"{name}: {a} {b}")

    def test_sections(self):
        for name, one in self.scenes.items():
            figure = draw.draw_sections(one)
            shapes = [s for s in one.sections.values() if geometry.outline(s)]
            self.assertEqual(figure is not None, bool(shapes), name)
            plt.close(figure)

    def test_words(self):
        for name, one in self.scenes.items():
            said = dict(describe.describe(one))
            for heading, own in (("Loads", one.loads), ("Springs", one.springs),
                                 ("Sections", one.sections)):
                lines = min(len(own), describe.MOST + 1)
                self.assertEqual(len(said.get(heading, [])), lines, f"{name}: {heading}")


class Geometry(unittest.TestCase):

    def test_arc(self):
        one = scene.read("""
name: arc
sections: {s: {rectangle: {width: 0.1, thickness: 0.1}}}
nodes: {p: {at: [0, 0, 0]}, q: {at: [2, 2, 0]}}
members: {m: {from: p, to: q, section: s, y: [0, 1, 0], curvature: [0, 0, 0.5]}}
analyses: {a: {linear: {}}}
""")
        line = geometry.line_of(one, one.members["m"])
        radius = np.linalg.norm(line.points - [0, 2, 0], axis=1)
        self.assertLess(abs(radius - 2).max(), 1e-9)
        self.assertLess(abs(line.axes[0][0] - [1, 0, 0]).max(), 1e-9)
        self.assertLess(abs(line.axes[-1][0] - [0, 1, 0]).max(), 1e-9)

    def test_walls_about_their_centroid(self):
        channel = {"points": {"a": ["0", "0"], "b": ["1", "0"], "c": ["1", "2"]},
                   "walls": [{"from": "a", "to": "b", "thickness": "0.1"},
                             {"from": "b", "to": "c", "thickness": "0.1"}]}
        _, ends, thickness = geometry.walls_of(channel)
        areas = thickness * np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        self.assertLess(abs((areas[:, None] * ends.mean(axis=1)).sum(axis=0)).max(), 1e-15)

    def test_plane_structures_face_on(self):
        frame = np.array([[0, 0, 0], [0, 0, 3.0], [4, 0, 3]])
        down, out = [np.array([0, 0, -1.0])], [np.array([0, 1.0, 0])]
        self.assertTrue(geometry.choose_view(frame, down, [], True).face_on)
        self.assertTrue(geometry.choose_view(frame, [], out, True).face_on)
        self.assertFalse(geometry.choose_view(frame, out, [], True).face_on)
        self.assertFalse(geometry.choose_view(frame[:2], down, [], True).face_on)

    def test_far_axes(self):
        text = """
name: turns
sections: {s: {rectangle: {width: 0.1, thickness: 0.1}}}
nodes: {p: {at: [0, 0, 0], hold: [ux]}, q: {at: [1, 0, 0]}}
members: {m: {from: p, to: q, section: s, y: [0, 1, 0]}}
analyses: {a: {rotation: {omega: [0, 0, 2], centre: [%d, 0, 0], stations: [0, 1]}}}
"""
        for centre, drawn in ((0, 1), (-100, 0)):
            one = scene.read(text % centre)
            figure = draw.draw(one)
            marks = [a.get_gid() for a in figure.findobj()]
            self.assertEqual(marks.count("spin"), drawn)
            self.assertIn("Axes turn with", dict(describe.describe(one)))
            plt.close(figure)

    def test_warping(self):
        text = """
name: warps
sections: {s: {SECTION}}
nodes: {p: {at: [0, 0, 0]}, q: {at: [1, 0, 0]}, r: {at: [2, 0, 0]}, t: {at: [2, 1, 0]}}
members:
  a: {from: p, to: q, section: s, y: [0, 1, 0], warping: [fixed, {shared: w0}]}
  b: {from: q, to: r, section: s, y: [0, 1, 0], warping: [{shared: w0}, free]}
  c: {from: r, to: t, section: s, y: [1, 0, 0], warping: fixed}
analyses: {run: {linear: {}}}
"""
        corner = "points: {a: [0, 0], b: [1, 0], c: [1, 1]%s}, walls: [{from: a, to: b, thickness: 0.1}, {from: b, to: c, thickness: 0.1}%s]"
        flat = "rectangle: {width: 0.1, thickness: 0.1}"
        for section, more, drawn in (
                (flat, "", 4), (flat, "omit: [warping]", 0), (flat, "omit: all", 0),
                ("tube: {diameter: 0.1, thickness: 0.01}", "", 0),
                ("constants: {A: 1, Iy: 1, Iz: 1, It: 1}", "", 0),
                ("constants: {A: 1, Iy: 1, Iz: 1, It: 1, Iw: 1}", "", 4),
                (corner % ("", ""), "", 0),
                (corner % (", d: [0, 1]", ", {from: c, to: d, thickness: 0.1}"), "", 4)):
            one = scene.read(text.replace("SECTION", section) + more)
            figure = draw.draw(one)
            marks = {m for m in (a.get_gid() for a in figure.findobj()) if m}
            self.assertEqual(
                sorted(m for m in marks if m.startswith("warping_")),
                ["warping_a_0", "warping_b_1", "warping_c_0", "warping_c_1"] if drawn else [])
            said = dict(describe.describe(one)).get("Warping at ends of members")
            self.assertEqual(said, ["held (filled bar): p, c at r, t", "shared: q",
                                    "free (open bar): b at r"] if drawn else None)
            plt.close(figure)

    def test_titles_of_load_cases(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "r.h5"
            run("solve", "--scene", str(ROOT / "cases/examples/continuous_beam.yaml"), "-f", "collocation", "-n", "1",
                "--shapes", "-o", str(path))
            s = shapes.read_file(path, "continuous_beam")
            self.assertEqual([pictures.title_of(s, k, 1) for k in range(len(s.kind))],
                             ["undeformed", "linear solution, combination both", "linear solution, combination first",
                              "linear solution, combination second", "linear solution, case dead"])

    def test_nothing_written(self):
        self.assertIsNone(scene.read(""))


if __name__ == "__main__":
    unittest.main()
