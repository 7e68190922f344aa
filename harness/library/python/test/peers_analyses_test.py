"""Scenes with several analyses: a driver must not start an analysis from the state of another."""
import math
import unittest

import numpy as np

from harness.library.python.test.module import bw
from harness.library.python.test.peers_test import FORCE, LENGTH, MOMENT, PeerTest, closed_form, peers, scene


def cantilever(analyses):
    """Returns a bar with EI = 2e5 N m^2, whose tip is pushed aside by a third of its length, and displacements, reactions
    and compliances of the analyses."""
    made = bw.Scene("several")
    made.sections["bar"] = {"constants": {"A": 1e-2, "Iy": 1e-6, "Iz": 1e-6, "It": 1e-6, "Ip": 2e-6}, "young": 200e9,
                            "shear_modulus": 80e9}
    made.nodes["root"], made.nodes["tip"] = {"at": [0, 0, 0], "hold": "all"}, {"at": [2, 0, 0]}
    made.members["bar"] = {"from_": "root", "to": "tip", "section": "bar", "y": [0, 1, 0], "warping": "free"}
    made.loads["force"] = {"force": [0, 5e4, 0], "on": "tip"}
    made.omit = ["shear", "trapeze"]
    for name, analysis in analyses.items():
        made.analyses[name] = analysis
        if "compliance" in analysis:
            made.quantities[name] = {"compliance": {"analysis": name, "row": "uy", "column": "uy"}, "unit": "m/N"}
        else:
            made.quantities[name] = {"displacement": {"analysis": name, "node": "tip", "component": "uy"}, "unit": "m"}
    return made


ANALYSES = {"path": {"static": {"stations": [0.5, 1]}}, "half": {"static": {"stations": [0.5]}}, "linear": {"linear": {}},
            "start": {"compliance": {"node": "tip"}}, "end": {"compliance": {"node": "tip", "about": "path"}},
            "again": {"compliance": {"node": "tip", "about": "path"}}}


class Several(PeerTest):

    def run_of(self, peer, element, made, n=8):
        found = peers.solve(self.data(made), peer, element, [n], rounds=1)
        if found.missing:
            self.skipTest(found.missing)
        return found.runs[0]

    def test_analyses_are_independent(self):
        """Each analysis must have the same result as if it were the only analysis."""
        for peer, name in peers.chosen(["opensees:forceBeamColumn", "opensees:forceBeamColumnCSBDI", "exudyn:exact_3d",
                                        "kratos", "xara:force", "xara:exact_3"]):
            with self.subTest(peer=peer, element=name):
                run = self.run_of(peer, name, cantilever(ANALYSES))
                if "failure" in run:
                    self.skipTest(run["failure"])
                for words in (["path"], ["half"], ["linear"], ["path", "end"]):
                    if words[-1] in run["values"]:
                        alone = self.run_of(peer, name, cantilever({word: ANALYSES[word] for word in words}))
                        self.assertAlmostEqual(run["values"][words[-1]] / alone["values"][words[-1]], 1, places=7)
                if "end" in run["values"]:
                    self.assertAlmostEqual(run["values"]["again"] / run["values"]["end"], 1, places=7)
                    self.assertAlmostEqual(run["values"]["start"] / (8 / 6e5), 1, delta=5e-3 if peer == "exudyn" else 2e-5)

    def test_linear_with_large_loads(self):
        """Linear results must be proportional to the loads. This includes reactions, which must be in equilibrium
        with the loads on the undeformed structure."""
        for peer in peers.names():
            for name, element in peers.load(peer).ELEMENTS.items():
                if "linear" in element.analyses:
                    with self.subTest(peer=peer, element=name):
                        u, R = self.values(peer, name, scene(element, small=1e3), 16)
                        np.testing.assert_allclose(u, closed_form(element, True, 1e3), rtol=3e-3)
                        force, moment = np.multiply(FORCE, 1e3), np.multiply(MOMENT, 1e3)
                        np.testing.assert_allclose(R[:3], -force, rtol=1e-5)
                        np.testing.assert_allclose(R[3:], -moment - np.cross([LENGTH, 0, 0], force), rtol=1e-5)


    def test_convergence_of_newton(self):
        """A converged state of Kratos must be in equilibrium: small increments alone must not count as convergence."""
        run = self.run_of("kratos", "corotational", cantilever({"path": {"static": {"stations": [0.25, 0.5, 0.75, 1]}}}))
        self.assertAlmostEqual(run["values"]["path"], 0.60344, delta=5e-4)  # xara, exact_3: 0.60345


class Supports(PeerTest):

    def test_two_rotations_held(self):
        """For each pair of rotations that a support fixes, the reactions must be in equilibrium: the moments about
        the supported end must balance."""
        for peer, name in peers.chosen(["exudyn:exact_3d", "opensees:forceBeamColumn", "xara:exact_3"]):
            for pair in (("rx", "ry"), ("rx", "rz"), ("ry", "rz")):
                with self.subTest(peer=peer, element=name, held=pair):
                    made = scene(peers.load(peer).ELEMENTS[name], kind="static")
                    made.nodes["root"]["hold"] = ["ux", "uy", "uz", *pair]
                    made.nodes["tip"]["hold"] = ["ux", "uy", "uz", "rx", "ry", "rz"]
                    made.nodes["middle"] = {"at": [0.6 * LENGTH, 0, 0]}
                    bar = made.members.pop("bar")
                    made.members["one"], made.members["two"] = {**bar, "to": "middle"}, {**bar, "from_": "middle"}
                    made.quantities.clear()
                    for load in made.loads.values():
                        load["on"] = "middle"
                    for node in ("root", "tip"):
                        for c in made.nodes[node]["hold"]:
                            made.quantities[node + c] = {"reaction": {"analysis": "all", "node": node, "component": c},
                                                         "unit": "N" if c[0] == "u" else "N m"}
                    found = peers.solve(self.data(made), peer, name, [8], rounds=1)
                    if found.missing:
                        self.skipTest(found.missing)
                    got = found.runs[0]["values"]
                    force, moment = ([got.get("tip" + k + c, 0) for c in "xyz"] for k in "ur")
                    root = [got.get("rootr" + c, 0) for c in "xyz"]
                    loads = [np.multiply(v, 1e-4) for v in (FORCE, MOMENT)]
                    rest = np.add(moment, root) + np.cross([LENGTH, 0, 0], force) + loads[1] + np.cross([0.6 * LENGTH, 0, 0], loads[0])
                    np.testing.assert_allclose(rest, 0, atol=1e-5 * np.abs(loads[1]).max())

    def test_arc(self):
        """A quarter of a circle under a tip force in its plane must have the deflection and rotation of Castigliano's
        theorem. Elements with stress in the initial curved state must be rejected."""
        made = cantilever({"path": ANALYSES["path"]})
        made.sections["bar"]["constants"]["A"] = 0.1
        made.nodes["tip"]["at"] = [2, 2, 0]
        made.members["bar"].update(curvature=[0, 0, 0.5])
        made.loads["force"]["force"] = [0, 1, 0]
        made.quantities["turn"] = {"displacement": {"analysis": "path", "node": "tip", "component": "rz"}, "unit": "rad"}
        for peer, name in peers.chosen(["exudyn", "opensees", "xara:exact", "xara:force"]):
            with self.subTest(peer=peer, element=name):
                found = peers.solve(self.data(made), peer, name, [32], rounds=1)
                if found.missing:
                    self.skipTest(found.missing)
                if name in ("ancf_3d", "ElasticTimoshenkoBeam"):
                    self.assertIn("refusal", found.runs[0])
                    continue
                got = found.runs[0]["values"]
                self.assertAlmostEqual(got["path"] / (8 / 2e5 * (0.75 * math.pi - 2)), 1, delta=2e-3)
                if "turn" in got:
                    self.assertAlmostEqual(got["turn"] / (4 / 2e5 * (math.pi / 2 - 1)), 1, delta=2e-3)


    def test_driven_rotation(self):
        """A clamp that turns by 1.2 rad must turn the beam by this angle, in any number of load steps. The driver of
        Kratos must reject this rotation."""
        for peer, name in peers.chosen(["exudyn:exact_2d", "opensees:elasticBeamColumn", "xara:exact_3", "kratos"]):
            with self.subTest(peer=peer, element=name):
                made = cantilever({"path": {"static": {"stations": [1]}}})
                made.loads["force"]["force"] = [0, 1, 0]
                made.nodes["root"] = {"at": [0, 0, 0], "hold": ["ux", "uy", "uz", "rx", "ry"], "drive": {"rz": "turn"}}
                made.motions["turn"] = {"unit": "rad", "path": [0, 1], "value": [0, 1.2]}
                found = peers.solve(self.data(made), peer, name, [4], rounds=1)
                if found.missing:
                    self.skipTest(found.missing)
                if peer == "kratos":
                    self.assertIn("refusal", found.runs[0])
                else:
                    self.assertAlmostEqual(found.runs[0]["values"]["path"], 2 * math.sin(1.2), delta=1e-4)

    def test_factor_of_loads(self):
        """Linear analyses must use the factor of a load at the path parameter 1."""
        for peer, name in peers.chosen(["opensees:elasticBeamColumn", "xara:force", "kratos", "mystran", "pynite"]):
            with self.subTest(peer=peer, element=name):
                made = cantilever({"linear": {"linear": {}}})
                made.loads["force"].update(path=[0, 1], factor=[0, 3])
                found = peers.solve(self.data(made), peer, name, [2], rounds=1)
                if found.missing:
                    self.skipTest(found.missing)
                self.assertAlmostEqual(found.runs[0]["values"]["linear"], 2, places=5)


class Best(PeerTest):

    def test_second_order_moments(self):
        """The best elements of OpenSees and Exudyn must converge with order 4 in large bending."""
        for peer, element in peers.chosen(["opensees:forceBeamColumnCBDI", "opensees:forceBeamColumnCSBDI", "exudyn:cable_2d"]):
            values = []
            for n in (2, 4, 16):
                made = cantilever({"path": ANALYSES["path"]})
                found = peers.solve(self.data(made), peer, element, [n], rounds=1)
                if found.missing:
                    self.skipTest(found.missing)
                values.append(found.runs[0]["values"]["path"])
            self.assertGreater(math.log2((values[0] - values[2]) / (values[1] - values[2])), 3.5)


if __name__ == "__main__":
    unittest.main()
