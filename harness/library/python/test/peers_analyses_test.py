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
        """Each analysis must have the result that it has alone."""
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
                    self.assertAlmostEqual(run["values"]["start"] / (8 / 6e5), 1, delta=2e-5)

    def test_linear_with_large_loads(self):
        """Linear results must be proportional to the loads, also the reactions, which are in balance with the loads on
        the undeformed structure."""
        for peer in peers.names():
            for name, element in peers.load(peer).ELEMENTS.items():
                if "linear" in element.analyses:
                    with self.subTest(peer=peer, element=name):
                        u, R = self.values(peer, name, scene(element, small=1e3), 16)
                        np.testing.assert_allclose(u, closed_form(element, True, 1e3), rtol=3e-3)
                        force, moment = np.multiply(FORCE, 1e3), np.multiply(MOMENT, 1e3)
                        np.testing.assert_allclose(R[:3], -force, rtol=1e-5)
                        np.testing.assert_allclose(R[3:], -moment - np.cross([LENGTH, 0, 0], force), rtol=1e-5)


class Best(PeerTest):

    def test_second_order_moments(self):
        """Elements of OpenSees with second-order moments inside must converge with order 4 in large bending."""
        for element in ("forceBeamColumnCBDI", "forceBeamColumnCSBDI"):
            values = []
            for n in (2, 4, 16):
                made = cantilever({"path": ANALYSES["path"]})
                found = peers.solve(self.data(made), "opensees", element, [n], rounds=1)
                if found.missing:
                    self.skipTest(found.missing)
                values.append(found.runs[0]["values"]["path"])
            self.assertGreater(math.log2((values[0] - values[2]) / (values[1] - values[2])), 3.5)


if __name__ == "__main__":
    unittest.main()
