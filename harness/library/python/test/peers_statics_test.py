"""Statics of drivers of other programs in large displacements: paths with limit points. Programs that are not installed are
skipped by name."""
import importlib
import json
import math
import os
import types
import unittest
import unittest.mock

import numpy as np

from harness.library.python.test.module import ModuleTest, bw
from harness.library.python.test.peers_test import PeerTest

peers = None if bw is None else importlib.import_module("beamwork.peers")
data, path = (None, None) if bw is None else (importlib.import_module(f"beamwork.peers.{name}") for name in ("data", "_path"))
ANGLE = 0.3  # [rad] inclination of the bars of the frame of von Mises


def load(w):
    """Returns the load factor of the frame of von Mises at the deflection w: bars of length 1 with EA = 1."""
    y = math.sin(ANGLE) - w
    length = math.hypot(math.cos(ANGLE), y)
    return 2 * (1 - length) * y / length


LIMIT = math.sin(ANGLE) - math.sqrt(math.cos(ANGLE)**(4 / 3) - math.cos(ANGLE)**2)


class Truss(path.Path if path else object):
    """The frame of von Mises, with a coordinate that reverses its direction at half of the deflection."""
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

    def follow(self, to, truss=None, mesh=("truss", 1)):
        analysis = types.SimpleNamespace(name="path", raw={"to": to})
        return path.follow(truss or Truss(), analysis, types.SimpleNamespace(of="", length=lambda: 1.0), mesh)

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
            self.follow([-1], truss)

    def test_again(self):
        """Steps that failed must not be tried again for the same mesh."""
        begun = []

        class Stiff(Truss):
            """A path that has no solution if a step is longer than 0.06."""

            def begin(self):
                super().begin()
                begun.append(0)

            def move(self, place, value):
                if abs(value - self.point().values[place]) > 0.06:
                    raise data.Failed("too far")
                return super().move(place, value)

        first = self.follow([-0.4], Stiff(), ("stiff", 1))
        count = len(begun)
        again = self.follow([-0.4], Stiff(), ("stiff", 1))
        self.assertGreater(count, 1)
        self.assertEqual(len(begun), count + 1)
        self.assertEqual([p.values for p in again.path], [p.values for p in first.path])


class Driven(PeerTest):

    def test_rotation(self):
        """A driven rotation must rotate the structure or be rejected."""
        made, length = bw.Scene("driven"), 0.5
        made.sections["bar"] = {"constants": {"A": 5e-6, "Iy": 1e-9, "Iz": 1e-9, "It": 1e-9, "Ip": 2e-9}, "young": 2e11, "shear_modulus": 8e10}
        made.nodes["root"] = {"at": [0, 0, 0], "hold": ["ux", "uy", "uz", "rx", "ry"], "drive": {"rz": "turn"}}
        made.nodes["tip"] = {"at": [length, 0, 0]}
        made.members["bar"] = {"from_": "root", "to": "tip", "section": "bar", "y": [0, 1, 0]}
        made.motions["turn"] = {"unit": "rad", "path": [0, 1], "value": [0, 2]}
        made.analyses["path"] = {"static": {"stations": [0.25, 0.5, 0.75, 1]}}
        for c in ("ux", "uy"):
            made.quantities[c] = {"displacement": {"analysis": "path", "node": "tip", "component": c}, "unit": "m"}
        made.omit = ["trapeze", "wagner_torque"]
        given, want = self.data(made), (length * (math.cos(2) - 1), length * math.sin(2))
        for peer in peers.names():
            for name, element in peers.load(peer).ELEMENTS.items():
                with self.subTest(peer=peer, element=name):
                    found = peers.solve(given, peer, name, [4], rounds=1)
                    if found.missing or "refusal" in found.runs[0]:
                        self.skipTest(found.missing or found.runs[0]["refusal"])
                    for c, value in zip(("ux", "uy"), want):
                        self.assertAlmostEqual(found.runs[0]["values"][c] / value, 1, delta=1e-6)


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
        """Both limit points of the frame of von Mises must be those of the closed form."""
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
        """The limit points of Lee's frame, which snaps through and back, must be within 5 % of the exact ones of
        reference/derive/lee_frame.py."""
        for peer, name in peers.chosen(["opensees:forceBeamColumn", "exudyn:exact_2d"]):
            with self.subTest(peer=peer):
                values = self.solved(peer, name, 8, "lee_frame")["values"]
                self.assertAlmostEqual(values["limit_load"] / 1.85567275, 1, delta=0.02)
                self.assertAlmostEqual(values["limit_load_back"] / -0.94144316, 1, delta=0.05)
                self.assertAlmostEqual(values["deflection_at_limit"] / 48.735137, 1, delta=0.02)
                self.assertAlmostEqual(values["deflection_at_limit_back"] / 58.216815, 1, delta=0.01)

    def test_refusals(self):
        """Drivers must reject paths that they cannot follow, and name the reason."""
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


class Loads(ModuleTest):
    """Loads on a cantilever of length 1 with EI = 1: the first element of every driver that reads the key must give the closed
    form of the tip deflection and the force of the support."""
    CASES = {"uniform": ({"distributed": [0, 1e-2, 0]}, 1 / 8, 1),
             "part": ({"distributed": [0, 1e-2, 0], "from_": 0.5}, 41 / 384, 0.5),
             "triangle": ({"distributed": [0, 0, 0], "to_value": [0, 1e-2, 0]}, 11 / 120, 0.5),
             "where": ({"force": [0, 1e-2, 0], "where": 0.5}, 5 / 48, 1),
             "moments": ({"distributed_moment": [0, 0, 1e-2]}, 1 / 3, 0)}

    def made(self, load, kind):
        made = bw.Scene("loads")
        made.sections["bar"] = {"constants": {"A": 1e3, "Iy": 3, "Iz": 1, "It": 2, "Ip": 4}, "young": 1, "shear_modulus": 1}
        made.nodes["root"], made.nodes["tip"] = {"at": [0, 0, 0], "hold": "all"}, {"at": [1, 0, 0]}
        made.members["bar"] = {"from_": "root", "to": "tip", "section": "bar", "y": [0, 1, 0], "warping": "free"}
        made.loads["load"] = {**load, "on": "bar"}
        made.analyses["path"] = {kind: {"stations": [1]} if kind == "static" else {}}
        made.quantities["uy"] = {"displacement": {"analysis": "path", "node": "tip", "component": "uy"}, "unit": "m"}
        made.quantities["F"] = {"reaction": {"analysis": "path", "node": "root", "component": "uy"}, "unit": "N"}
        made.omit = ["trapeze"]
        place = self.folder / "scene.yaml"
        made.write(place)
        return json.loads(self.answered("scene", "--scene", place, "--format", "json").stdout)

    def test_closed_forms(self):
        for name, (load, deflection, force) in self.CASES.items():
            key = "loads." + next(k for k in [*reversed(load)]).rstrip("_")
            scenes = {kind: self.made(load, kind) for kind in ("static", "linear")}
            for peer in peers.names():
                for word, element in list(peers.load(peer).ELEMENTS.items())[:1]:
                    if key not in element.keys:
                        continue
                    for kind in sorted({"static", "linear"} & element.analyses):
                        if kind == "static" and "large rotations" not in element.offers:
                            continue
                        with self.subTest(load=name, peer=peer, element=word, analysis=kind):
                            found = peers.solve(scenes[kind], peer, word, [8], rounds=1)
                            if found.missing:
                                self.skipTest(found.missing)
                            self.assertIn("values", found.runs[0], found.runs[0])
                            self.assertAlmostEqual(found.runs[0]["values"]["uy"] / (1e-2 * deflection), 1, delta=1.2e-2)
                            self.assertAlmostEqual(found.runs[0]["values"]["F"] / -1e-2, force, delta=2e-5)


class Released(ModuleTest):
    """A driver that releases all driven components must reject a compliance for which one of them is fixed."""

    def test_held_component(self):
        text = self.answered("scene", "sheet_cantilever").stdout.replace("omit: [wagner_torque]", "omit: [wagner_torque, warping, trapeze]")
        place = self.folder / "scene.yaml"
        place.write_text(text.replace("released: [uy, rz]", "released: [rz]"), encoding="utf-8")
        scene = json.loads(self.answered("scene", "--scene", place, "--format", "json").stdout)
        for peer, name in (("xara", "force"), ("kratos", "corotational")):
            with self.subTest(peer=peer):
                found = peers.solve(scene, peer, name, [8], rounds=1)
                if found.missing:
                    self.skipTest(found.missing)
                self.assertIn("released", found.runs[0].get("refusal", str(found.runs[0].keys())))


class OnPath(ModuleTest):
    """A program on PATH: its absence, its version and its failure must be reported. A script stands for the program."""

    def solved(self):
        scene = json.loads(self.answered("scene", "elastica", "--format", "json").stdout)
        return peers.solve(scene, "mbdyn", "beam3", [1], rounds=1)

    def test_mbdyn(self):
        with unittest.mock.patch.dict(os.environ, PATH=str(self.folder)):
            self.assertIn("no program mbdyn on PATH", self.solved().missing)
            script = self.folder / "mbdyn"
            script.write_text('#!/bin/sh\n[ "$1" = --version ] && echo "MBDyn - MultiBody Dynamics 9.8" && exit\n'
                              'echo "line 3: unknown word"\nexit 1\n', encoding="utf-8")
            script.chmod(0o755)
            found = self.solved()
            self.assertEqual((found.version, found.missing), ("9.8", ""))
            self.assertIn("line 3: unknown word", found.runs[0]["failure"])


class MBDyn(ModuleTest):
    """Bodies, prescribed rotations and loads along members."""

    def value(self, made, *names):
        place = self.folder / "scene.yaml"
        made.write(place)
        scene = json.loads(self.answered("scene", "--scene", place, "--format", "json").stdout)
        found = peers.solve(scene, "mbdyn", "beam3", [8], rounds=1)
        if found.missing:
            self.skipTest(found.missing)
        self.assertIn("values", found.runs[0], found.runs[0])
        return [found.runs[0]["values"][name] for name in names]

    def cantilever(self, name):
        made = bw.Scene(name)
        made.sections["bar"] = {"stiffness": [1e4, 1e6, 1e6, 2, 3, 1], "mass": [1] * 6}
        made.nodes["root"], made.nodes["tip"] = {"at": [0, 0, 0], "hold": "all"}, {"at": [1, 0, 0]}
        made.members["bar"] = {"from_": "root", "to": "tip", "section": "bar", "y": [0, 1, 0]}
        made.analyses["path"] = {"static": {"stations": [1]}}
        made.quantities["uy"] = {"displacement": {"analysis": "path", "node": "tip", "component": "uy"}, "unit": "m"}
        return made

    def test_distributed(self):
        """Small loads along a cantilever must cause the deflection q L^4/8 EI and, for a triangle that grows to the
        tip, 11 q L^4/120 EI."""
        made = self.cantilever("loads")
        made.loads["q"] = {"distributed": [0, 1e-4, 0], "on": "bar"}
        self.assertAlmostEqual(self.value(made, "uy")[0] / 1.25e-5, 1, delta=2e-3)
        made.loads["q"] = {"distributed": [0, 0, 0], "to_value": [0, 1e-4, 0], "on": "bar"}
        self.assertAlmostEqual(self.value(made, "uy")[0] / (11e-4 / 120), 1, delta=2e-3)

    def test_compliance(self):
        """The compliances of a deflected sheet must be those on which several programs agree."""
        words = ("sheet_cantilever", "--set", "trapeze=0", "--set", "warping=0", "--set", "shear_factor=0.8333333333333334")
        scene = json.loads(self.answered("scene", *words, "--format", "json").stdout)
        found = peers.solve(scene, "mbdyn", "beam3", [8], rounds=1)
        if found.missing:
            self.skipTest(found.missing)
        values = found.runs[0]["values"]
        self.assertAlmostEqual(values["C_zz"] / 8.206386e-8, 1, delta=1e-3)
        self.assertAlmostEqual(values["C_xx"] / 3.9726242e-7, 1, delta=1e-4)
        self.assertAlmostEqual(values["u_x"] / -1.3586446e-3, 1, delta=1e-4)

    def test_body(self):
        """A bar is clamped at one end, and a body at the other end rotates by a prescribed rotation vector. The moment must
        be 4 EI/L or GJ/L times the angle."""
        for axis, stiffness in ((0, 2), (2, 4)):
            made = self.cantilever("body")
            made.nodes["hub"] = {"at": [1, 0, 0], "rotation": {"vector": ["m0", "m1", "m2"]}}
            made.nodes["hub"]["hold"] = ["ux", "uy", "uz"]
            made.nodes["tip"]["part_of"] = "hub"
            for k in range(3):
                made.motions[f"m{k}"] = {"path": [0, 1], "value": [0, 0.002 if k == axis else 0], "unit": "rad"}
            made.quantities["M"] = {"reaction": {"analysis": "path", "node": "hub", "component": "r" + "xyz"[axis]}, "unit": "N m"}
            self.assertAlmostEqual(self.value(made, "M")[0] / (stiffness * 0.002), 1, delta=5e-3)


if __name__ == "__main__":
    unittest.main()
