"""Drivers of other programs must reproduce numbers from the documentation or the tests of these programs."""
import importlib
import json
import math
import unittest

from harness.library.python.test.module import ModuleTest, bw

peers = None if bw is None else importlib.import_module("beamwork.peers")


def cantilever(section, length, load, omit):
    made = bw.Scene("cantilever")
    constants = {key: value for key, value in section.items() if key not in ("E", "G")}
    made.sections["bar"] = {"constants": constants, "young": section["E"], "shear_modulus": section["G"]}
    made.nodes["root"], made.nodes["tip"] = {"at": [0, 0, 0], "hold": "all"}, {"at": [length, 0, 0]}
    made.members["bar"] = {"from_": "root", "to": "tip", "section": "bar", "y": [0, 1, 0], "warping": "free"}
    made.loads["load"] = {**load, "on": "tip"}
    made.analyses["bent"] = {"static": {"stations": [1]}}
    for c in ("ux", "uy", "uz"):
        made.quantities[c] = {"displacement": {"analysis": "bent", "node": "tip", "component": c}, "unit": "m"}
    made.omit = ["trapeze", "wagner_torque", *omit]
    return made


class Examples(ModuleTest):

    def values(self, peer, element, n, made=None, **case):
        if made is not None:
            case["scene"] = self.folder / "scene.yaml"
            made.write(case["scene"])
        words = [word for key, value in case.items() if key != "case" for word in (f"--{key}", value)]
        data = json.loads(self.answered("scene", *([case["case"]] if "case" in case else []), *words, "--format", "json").stdout)
        found = peers.solve(data, peer, element, [n], rounds=1)
        if found.missing:
            self.skipTest(found.missing)
        self.assertIn("values", found.runs[0], found.runs[0])
        return list(found.runs[0]["values"].values())

    def same(self, got, want, delta):
        for a, b in zip(got, want, strict=True):
            self.assertAlmostEqual(a, b, delta=delta)

    def test_xara_force(self):
        """Table 5 of Perez and Filippou, Int. J. Numer. Meth. Eng. 125 (2024), doi 10.1002/nme.7506, as in xara's examples."""
        made = cantilever({"E": 10, "G": 10, "A": 1e7, "Iy": 1, "Iz": 1, "It": 1e7, "Ip": 2, "D": [50, 0, 0, 0, 50, 0, 0, 0, 1]}, 1,
                          {"force": [0, 10, 0]}, [])
        self.same(self.values("xara", "exact", 10, made), (-0.061013882, 0.31723971, 0), 1e-8)
        self.same(self.values("xara", "exact_4", 10, made), (-0.061315634, 0.31781389, 0), 1e-8)

    def test_xara_bend(self):
        got = self.values("xara", "exact", 8, case="bend_45", set="torsion=polar")
        self.same(got, (-23.477869, -13.487488, 53.369390), 3e-5)

    def test_kratos(self):
        """Cantilever under a tip moment: test_patch_test_cr_beam.py of the StructuralMechanicsApplication."""
        made = cantilever({"E": 210e9, "G": 210e9 / 2.6, "A": 0.01, "Iy": 1e-5, "Iz": 1e-5, "It": 1e-5, "Ip": 2e-5}, 1,
                          {"moment": [0, 0, 150000]}, ["shear"])
        self.same(self.values("kratos", "corotational", 20, made), (-0.0008495924536316574, 0.03569912736309147, 0), 1e-9)

    def test_mystran(self):
        """Clamped column of 10 elements: deck SB-BAR-10-BUCKLING-CF-LOAD-LAN-3D of MYSTRAN's benchmarks, whose title names
        Euler's load."""
        made = cantilever({"E": 10e6, "G": 10e6 / 2.66, "A": 0.5, "Iy": 104.16666666667, "Iz": 0.041666666666667, "It": 0.1, "Ip": 104.3},
                          100, {"force": [-1, 0, 0]}, ["shear", "wagner_moments"])
        made.analyses = {"bent": {"buckling": {}}}
        made.quantities = {"load": {"critical_factor": {"analysis": "bent"}, "unit": "1"}}
        got = self.values("mystran", "bar", 10, made)
        self.assertAlmostEqual(got[0], math.pi**2 * 10e6 * 0.041666666666667 / 4 / 100**2, delta=2e-3)

    def test_pyelastica(self):
        meshes = [self.values("pyelastica", "rod", n, case="bend_45", set="torsion=polar") for n in (8, 16)]
        self.same([2 * b - a for a, b in zip(*meshes)], (-23.5603, -13.6045, 53.4749), 0.25)
        bar = {"E": 1, "G": 1, "A": 1000, "Iy": 2, "Iz": 1, "It": 1, "Ip": 3, "D": [500, 0, 0, 0, 500, 0, 0, 0, 1]}
        made = cantilever(bar, 1, {"force": [0.1, 0.5, 0.2]}, [])
        made.quantities["R"] = {"reaction": {"analysis": "bent", "node": "root", "component": "uy"}, "unit": "N"}
        along_x = self.values("pyelastica", "rod", 4, made)
        self.assertAlmostEqual(along_x[3], -0.5, delta=1e-5)
        made.nodes["root"], made.nodes["tip"] = {"at": [0, 0, 0]}, {"at": [0, 0, 1], "hold": "all"}
        made.members["bar"]["y"] = [1, 0, 0]
        made.loads["load"] = {"force": [0.5, 0.2, -0.1], "on": "root"}
        for c in ("ux", "uy", "uz"):
            made.quantities[c]["displacement"]["node"] = "root"
        made.quantities["R"]["reaction"].update(node="tip", component="ux")
        turned = self.values("pyelastica", "rod", 4, made)
        self.same((-turned[2], turned[0], turned[1], turned[3]), along_x, 1e-5)


class ExudynInSpace(ModuleTest):
    """Exudyn's test model geometricallyExactBeamTest.py: the sum of the lengths of the tip displacements of five cantilevers, 8
    elements each. The model states 1.012822053539261, and gives 1.0128212332805508 with Exudyn 1.13.6."""

    def tip(self, E, nu, size, length, factors, force=(0, 0, 0), moment=(0, 0, 0)):
        h, w = size
        G, Iy, Iz = E / 2 / (1 + nu), h * w**3 / 12, w * h**3 / 12
        made = bw.Scene("cantilever")
        made.sections["bar"] = {"stiffness": [E * h * w, G * h * w * factors[1], G * h * w * factors[2], G * (Iy + Iz) * factors[0],
                                              E * Iy, E * Iz], "mass": [1] * 6}
        made.nodes["root"], made.nodes["tip"] = {"at": [0, 0, 0], "hold": "all"}, {"at": [length, 0, 0]}
        made.members["bar"] = {"from_": "root", "to": "tip", "section": "bar", "y": [0, 1, 0]}
        made.loads["force"], made.loads["moment"] = {"force": force, "on": "tip"}, {"moment": moment, "on": "tip"}
        made.analyses["bent"] = {"static": {"stations": [1]}}
        for c in ("ux", "uy", "uz"):
            made.quantities[c] = {"displacement": {"analysis": "bent", "node": "tip", "component": c}, "unit": "m"}
        place = self.folder / "scene.yaml"
        made.write(place)
        data = json.loads(self.answered("scene", "--scene", place, "--format", "json").stdout)
        found = peers.solve(data, "exudyn", "exact_3d", [8], rounds=1)
        if found.missing:
            self.skipTest(found.missing)
        self.assertIn("values", found.runs[0], found.runs[0])
        return math.hypot(*found.runs[0]["values"].values())

    def test_sum(self):
        ks = 10 * 1.3 / (12 + 11 * 0.3)
        steel, princeton = (2.07e11, 0.3), (71.7e9, 0.31, (12.3777e-3, 3.2024e-3), 0.508, (0.198, 1, 1))
        total = sum(self.tip(*steel, (0.5, 0.1), 2, (1, ks, ks), (0, f * 0.5**3, 0)) for f in (5e5, 5e8))
        total += self.tip(*steel, (0.2, 0.4), 2, (0.5768, 0.8331, 0.7961), moment=(0.5e6, 2e6, 0))
        total += sum(self.tip(*princeton, (0, -f * math.sqrt(0.5), f * math.sqrt(0.5))) for f in (8.896, 13.345))
        self.assertAlmostEqual(total, 1.0128212332805508, delta=1e-9)


if __name__ == "__main__":
    unittest.main()
