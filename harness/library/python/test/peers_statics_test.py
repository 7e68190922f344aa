"""Statics of drivers of other programs in large displacements: paths with limit points. Programs that are not installed are
skipped by name."""
import importlib
import json
import math
import types
import unittest

import numpy as np

from harness.library.python.test.module import ModuleTest, bw

peers = None if bw is None else importlib.import_module("beamwork.peers")
data, path = (None, None) if bw is None else (importlib.import_module(f"beamwork.peers.{name}") for name in ("data", "_path"))
ANGLE = 0.3  # of the bars of the frame of von Mises


def load(w):
    """Returns the load factor of the frame of von Mises at the deflection w: bars of length 1 with EA = 1."""
    y = math.sin(ANGLE) - w
    length = math.hypot(math.cos(ANGLE), y)
    return 2 * (1 - length) * y / length


LIMIT = math.sin(ANGLE) - math.sqrt(math.cos(ANGLE)**(4 / 3) - math.cos(ANGLE)**2)


class Truss(path.Path if path else object):
    """The frame of von Mises, and a coordinate that turns back at half of the deflection."""
    places = (("apex", 1), ("other", 0))

    def begin(self):
        self.w = 0.0

    def other(self, w):
        return 5 * w * (2 * math.sin(ANGLE) - w)

    def move(self, place, value):
        if place == 0:
            self.w = -value
            return 1
        low, high = (0, math.sin(ANGLE)) if self.w < math.sin(ANGLE) else (math.sin(ANGLE), 2 * math.sin(ANGLE))
        root = math.sin(ANGLE)**2 - value / 5
        if root < 0:
            return -1
        self.w = math.sin(ANGLE) + math.copysign(math.sqrt(root), low + high - 2 * math.sin(ANGLE))
        return 1

    def point(self):
        return data.PathPoint(load(self.w), [-self.w, self.other(self.w)], data.State())


class Walk(ModuleTest):
    """The path of a known function must be followed past limit points of the load factor and of a coordinate."""

    def follow(self, to):
        analysis = types.SimpleNamespace(raw={"to": to})
        return path.follow(Truss(), analysis, types.SimpleNamespace(length=lambda: 1.0))

    def test_limits(self):
        answer = self.follow([-0.4, -0.7])
        limits = [p for p in answer.path if p.limit]
        np.testing.assert_allclose([p.values[0] for p in limits], [-LIMIT, LIMIT - 2 * math.sin(ANGLE)], rtol=1e-6)
        np.testing.assert_allclose([p.factor for p in limits], [load(LIMIT), -load(LIMIT)], rtol=1e-10)
        self.assertEqual([p.values[0] for p in answer.stops], [-0.4, -0.7])
        self.assertEqual(answer.path[-1].values[0], -0.7)
        self.assertTrue(all(a.values[0] > b.values[0] for a, b in zip(answer.path, answer.path[1:])))

    def test_no_path(self):
        truss = Truss()
        truss.move = lambda place, value: -7
        with self.assertRaisesRegex(data.Failed, "no equilibrium"):
            path.follow(truss, types.SimpleNamespace(raw={"to": [-1]}), types.SimpleNamespace(length=lambda: 1.0))


class Continuation(ModuleTest):

    def each(self, check):
        for peer in peers.names():
            for name, element in peers.load(peer).ELEMENTS.items():
                if "continuation" in element.analyses:
                    with self.subTest(peer=peer, element=name):
                        check(peer, name)

    def solved(self, peer, name, n, *words):
        scene = json.loads(self.answered("scene", *words, "--format", "json").stdout)
        found = peers.solve(scene, peer, name, [n], rounds=1)
        if found.missing:
            self.skipTest(found.missing)
        return found.runs[0]

    def test_snap_through(self):
        """Both limit points of the frame of von Mises, in closed form."""
        def check(peer, name):
            run = self.solved(peer, name, 2, "snap_through")
            self.assertIn("values", run, run)
            values = run["values"]
            self.assertAlmostEqual(values["limit_load"] / load(LIMIT), 1, places=7)
            self.assertAlmostEqual(values["limit_load_back"] / load(LIMIT), -1, places=7)
            self.assertAlmostEqual(values["deflection_at_limit"] / LIMIT, 1, places=5)
            self.assertAlmostEqual(values["load_inverted"] / load(0.7388005166533489), 1, places=6)
            for x, value in values["curve"]:
                self.assertAlmostEqual(value, load(x), places=8)
        self.each(check)

    def test_lee_frame(self):
        """Snap-through and snap-back, with the exact limit loads of reference/derive/lee_frame.py."""
        for peer, name in peers.chosen(["opensees:forceBeamColumn", "exudyn:exact_2d"]):
            with self.subTest(peer=peer):
                values = self.solved(peer, name, 8, "lee_frame")["values"]
                self.assertAlmostEqual(values["limit_load"] / 1.85567275, 1, delta=0.02)
                self.assertAlmostEqual(values["limit_load_back"] / -0.94144316, 1, delta=0.05)
                self.assertAlmostEqual(values["deflection_at_limit"] / 48.735137, 1, delta=0.02)
                self.assertAlmostEqual(values["deflection_at_limit_back"] / 58.216815, 1, delta=0.01)

    def test_refusals(self):
        """What a driver cannot follow must be refused by name."""
        text = self.answered("scene", "snap_through").stdout
        place = self.folder / "scene.yaml"
        for old, new, word in (("on: apex}", "on: apex, path: [0, 1], factor: [0, 1]}", "proportional"),
                               ("component: uy}, by: arc, to: [-0.7388005166533489]", "component: ux}, by: arc, to: [0.1]", "freely"),
                               ("kind: limit, value: factor}", "kind: bifurcation, value: factor}", "limit points")):
            with self.subTest(word):
                self.assertIn(old, text)
                place.write_text(text.replace(old, new), encoding="utf-8")
                done = self.answered("scene", "--scene", place, "--format", "json")
                found = peers.solve(json.loads(done.stdout), "opensees", "forceBeamColumn", [2], rounds=1)
                if found.missing:
                    self.skipTest(found.missing)
                self.assertIn(word, str(found.runs[0].get("refusal", found.runs[0].get("refused"))))


if __name__ == "__main__":
    unittest.main()
