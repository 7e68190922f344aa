"""Requirements on the modes of every driver of another program. Programs that are not installed are skipped by name."""
import json
import math

import numpy as np

from harness.library.python.test.module import bw
from harness.library.python.test.peers_test import TILT, PeerTest, peers

YOUNG, SHEAR, DENSITY, AREA = 2e11, 8e10, 8000.0, 1e-2


def bar(element, turn=np.eye(3), reverse=False, hold="all", about=False, **section):
    """Returns a bar of 1 m, initially along x, with its modal analysis. section: constants that differ from the
    defaults."""
    made = bw.Scene("modes")
    shear = {"D": [AREA, 0, 0, 0, AREA, 0, 0, 0, 1]} if "shear" in element.offers else {}
    constants = {"A": AREA, "Iy": 4e-5, "Iz": 1e-5, "It": 2e-5, "Ip": 5e-5, "Iw": 0, **shear, **section}
    made.sections["bar"] = {"constants": constants, "young": YOUNG, "shear_modulus": SHEAR, "density": DENSITY}
    made.nodes["a"], made.nodes["b"] = {"at": [0, 0, 0]}, {"at": turn @ np.array([1, 0, 0])}
    made.nodes["b" if reverse else "a"].update({"hold": hold} if hold else {})
    made.members["bar"] = {"from_": "b" if reverse else "a", "to": "a" if reverse else "b", "section": "bar",
                           "y": turn @ np.array([0, 1, 0]), "warping": "free"}
    if "plane only" in element.summary:
        made.plane = "xy"
    if about:
        made.nodes["b"]["hold"] = ["uy", "uz", "rx", "ry", "rz"]
        made.loads["pull"] = {"force": turn @ np.array([about, 0, 0]), "on": "b"}
        made.analyses["pulled"] = {"static": {"stations": [1]}}
    made.analyses["modes"] = {"modal": {"about": "pulled"} if about else {}}
    for i in range(8):
        made.quantities[f"f_{i}"] = {"frequency": {"analysis": "modes", "which": i}, "unit": "Hz"}
    made.omit = ["trapeze", "wagner_moments", "wagner_torque"] + ([] if shear else ["shear"])
    return made


class Modes(PeerTest):

    def each(self, check):
        for peer in peers.names():
            for name, element in peers.load(peer).ELEMENTS.items():
                if "modal" in element.analyses:
                    with self.subTest(peer=peer, element=name):
                        check(peer, name, element)

    def solved(self, peer, name, made, n=32, refused=""):
        """Returns the values. refused: part of the message of an allowed rejection, for which the test is skipped."""
        found = peers.solve(self.data(made), peer, name, [n], rounds=1)
        if found.missing:
            self.skipTest(found.missing)
        run = found.runs[0]
        if "refusal" in run and ("ANCF beam couples" in run["refusal"] or (refused and refused in run["refusal"])):
            self.skipTest(run["refusal"])
        self.assertIn("values", run, run)
        self.assertEqual(run["refused"], {})
        return list(run["values"].values())

    def limits(self, peer, name, made, refused=""):
        """Returns the limits extrapolated from two meshes with order 2, the order of lumped masses."""
        coarse, fine = (np.array(self.solved(peer, name, made, n, refused)) for n in ((32, 64) if made.plane else (16, 32)))
        return (4 * fine - coarse) / 3

    def ours(self, made):
        place = self.folder / "ours.yaml"
        made.write(place)
        return [q["value"] for q in self.record("solve", "--scene", place, "-f", "collocation", "-n", 64)["quantities"]]

    def test_cantilever(self):
        """Frequencies of bending with shear and rotary inertia, of torsion and of extension must be those of beamwork,
        whose limits other tests compare with closed forms. The torsional frequency is sqrt(G It/(rho Ip))/(4 L)."""
        def check(peer, name, element):
            ratio = 1.0 if peer == "kratos" else 0.5
            made = bar(element, Ip=5e-5 / ratio) if "plane only" not in element.summary else bar(element)
            got = self.limits(peer, name, made, refused="always")
            np.testing.assert_allclose(got, self.ours(made), rtol=1e-3)
            if "plane only" not in element.summary:
                torsion = math.sqrt(SHEAR * 2e-5 / (DENSITY * 5e-5 / ratio)) / 4
                self.assertLess(min(abs(f / torsion - 1) for f in got), 1e-3)
        self.each(check)

    def test_free(self):
        """A free structure must have a zero frequency for each rigid-body motion, then the elastic frequencies."""
        def check(peer, name, element):
            made = bar(element, hold="")
            got = self.solved(peer, name, made, refused="supports that hold")
            rigid = 3 if made.plane else 6
            self.assertEqual(got[:rigid + 1].count(0), rigid)
            np.testing.assert_allclose(self.limits(peer, name, made), self.ours(made), rtol=1e-3, atol=1e-9)
        self.each(check)

    def test_pinned(self):
        """A bar that may rotate about its end must have three zero frequencies, or one in the plane."""
        def check(peer, name, element):
            made = bar(element, hold=["ux", "uy", "uz"])
            got = self.solved(peer, name, made, refused="supports that hold")
            self.assertEqual(got.count(0), 1 if made.plane else 3)
            np.testing.assert_allclose(self.limits(peer, name, made), self.ours(made), rtol=1e-3, atol=1e-9)
        self.each(check)

    def test_direction(self):
        """A rotation of the scene, or another order of nodes, must not change the frequencies."""
        def check(peer, name, element):
            want = self.solved(peer, name, bar(element), 8)
            turns = TILT if not bar(element).plane else (np.array([[0.6, -0.8, 0], [0.8, 0.6, 0], [0, 0, 1]]), )
            for turn, reverse in [(np.array(turn), False) for turn in turns] + [(np.eye(3), True)]:
                with self.subTest(turn=turn.tolist()):
                    got = self.solved(peer, name, bar(element, turn, reverse), 8, refused="about global axes only")
                    np.testing.assert_allclose(got, want, rtol=1e-6)
        self.each(check)

    def test_loaded(self):
        """The lowest frequency w/(2 pi) of a bar with L = 1 that is clamped at both ends and under tension T must
        satisfy 2 a b (1 - cosh a cos b) + (a^2 - b^2) sinh a sin b = 0 with a^2, b^2 = sqrt((T/2 EI)^2 + rho A
        w^2/EI) +- T/2 EI."""
        pull, stiffness = 8e6, YOUNG * 1e-5

        def boundary(f):
            half = pull / 2 / stiffness
            root = math.sqrt(half**2 + DENSITY * AREA * (2 * math.pi * f)**2 / stiffness)
            a, b = math.sqrt(root + half), math.sqrt(root - half)
            return 2 * a * b * (1 - math.cosh(a) * math.cos(b)) + (a * a - b * b) * math.sinh(a) * math.sin(b)

        low, high = 500.0, 1000.0
        self.assertLess(boundary(low) * boundary(high), 0)
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if boundary(low) * boundary(middle) > 0 else (low, middle)

        def check(peer, name, element):
            if "modal.about" not in element.keys:
                return
            made = bar(element, about=pull, D=[10, 0, 0, 0, 10, 0, 0, 0, 1]) if "shear" in element.offers else bar(element, about=pull)
            made.omit = [*made.omit, "rotary_inertia"]
            got = self.solved(peer, name, made, refused="that the scene omits")
            self.assertLess(abs(got[0] / low - 1), 5e-3, (got, low))
        self.each(check)

    def test_families(self):
        """Modes must be counted separately in each family, even if frequencies are equal."""
        def check(peer, name, element):
            if made_plane := "plane only" in element.summary:
                families = {"bending_y": math.nan, "axial": 1250}
            else:
                families = {"bending_y": math.nan, "bending_z": math.nan, "axial": 1250, "torsion": math.sqrt(SHEAR / DENSITY / 2) / 4}
            made = bar(element, Iy=1e-5, Iz=1e-5, It=1e-5, Ip=2e-5)
            made.quantities = {key: {"frequency": {"analysis": "modes", "family": key}, "unit": "Hz"} for key in families}
            data = self.data(made)
            found = peers.solve(data, peer, name, [32], rounds=1)
            if found.missing:
                self.skipTest(found.missing)
            run = found.runs[0]
            if "refused" not in run or "does not find the modes of the family" in str(run["refused"]):
                self.skipTest(str(run))
            for (key, want), got, ours in zip(families.items(), run["values"].values(), self.ours(made)):
                self.assertLess(abs(got / (ours if math.isnan(want) else want) - 1), 1e-2, key)
            self.assertTrue(made_plane or abs(run["values"]["bending_y"] / run["values"]["bending_z"] - 1) < 1e-6)
        self.each(check)

    def test_no_mass(self):
        """A structure without mass must have no frequencies."""
        def check(peer, name, element):
            data = self.data(bar(element))
            data["sections"][0]["density"] = 0
            found = peers.solve(data, peer, name, [4], rounds=1)
            if found.missing:
                self.skipTest(found.missing)
            self.assertNotIn("f_0", found.runs[0].get("values", {}), found.runs[0])
        self.each(check)

    def test_body(self):
        """A body at the tip must change the frequencies as it does in beamwork."""
        def check(peer, name, element):
            if "nodes.mass" not in element.keys:
                return
            made = bar(element)
            made.nodes["b"].update(mass=30, inertia=[1, 2, 3, 0, 0, 0])
            np.testing.assert_allclose(self.limits(peer, name, made)[:6], self.ours(made)[:6], rtol=1e-3)
        self.each(check)

    def test_hinge(self):
        """The frequencies of a bar that is clamped at one end and has a hinge at the other must be those of beamwork."""
        def check(peer, name, element):
            if "members.release" in element.keys:
                made = bar(element)
                made.nodes["b"]["hold"] = "all"
                made.members["bar"]["release"] = {"to": ["rz"]}
                np.testing.assert_allclose(self.limits(peer, name, made), self.ours(made), rtol=1e-3)
        self.each(check)

    def test_ring(self):
        """A free ring must have six rigid-body motions, and double frequencies of bending that converge to the
        closed form."""
        def check(peer, name, element):
            data = {}
            for rotary in (0, 1):
                words = ("scene", "free_ring", "--set", f"rotary_inertia={rotary}", "--format", "json")
                data[rotary] = json.loads(self.answered(*words).stdout)
            want = {0: {"out_2": 2.605768024522, "in_2": 2.682938129455}, 1: {"out_2": 2.605247340907, "in_2": 2.682696821181}}
            for rotary in (0, 1):
                found = peers.solve(data[rotary], peer, name, [8, 16], rounds=1)
                if found.missing:
                    self.skipTest(found.missing)
                if "refusal" not in found.runs[0]:
                    coarse, fine = (run["values"] for run in found.runs)
                    for key, value in want[rotary].items():
                        self.assertAlmostEqual((4 * fine[key] - coarse[key]) / 3 / value, 1, delta=3e-4, msg=f"{rotary} {key}")
        self.each(check)


class Buckling(PeerTest):
    """Critical loads of linear buckling, which neglects the displacements before buckling."""

    def factor(self, peer, name, case, n, **parameters):
        data = json.loads(self.answered("scene", case, *(w for k, v in parameters.items() for w in ("--set", f"{k}={v}")),
                                        "--format", "json").stdout)
        found = peers.solve(data, peer, name, [n], rounds=1)
        if found.missing:
            self.skipTest(found.missing)
        if "refusal" in found.runs[0]:
            self.skipTest(found.runs[0]["refusal"])
        self.assertIn("values", found.runs[0], found.runs[0])
        return next(iter(found.runs[0]["values"].values()))

    def buckling(self, check):
        for peer in peers.names():
            for name, element in peers.load(peer).ELEMENTS.items():
                if "buckling" in element.analyses:
                    with self.subTest(peer=peer, element=name):
                        check(peer, name)

    def test_column(self):
        """The critical load of the pinned column must be Engesser's, although the column shortens by 3e-4 before it
        buckles."""
        def check(peer, name):
            self.assertAlmostEqual(self.extrapolated(peer, name, "shear_column", (16, 32)) / 9202.2121765, 1, delta=2e-5)
        self.buckling(check)

    def extrapolated(self, peer, name, case, meshes=(8, 16), **parameters):
        """Returns the limit extrapolated from two meshes with order 2."""
        coarse, fine = (self.factor(peer, name, case, n, **parameters) for n in meshes)
        return (4 * fine - coarse) / 3

    def test_springs(self):
        """The load of a beam on rotational springs must be that of its closed form."""
        def check(peer, name):
            if "springs" in peers.load(peer).ELEMENTS[name].keys:
                self.assertAlmostEqual(self.extrapolated(peer, name, "sprung_beam", load="axial") / 20.9567986, 1, delta=5e-5)
        self.buckling(check)

    def test_lateral(self):
        """The factor of sqrt(EI GJ)/L^2 in the load of lateral buckling must be 4.0126 for a cantilever with any
        ratio of the bending stiffnesses, and 16.936 for a fork-ended beam. With ForceFrame of xara, values of the
        cantilever converge with order 1."""
        def check(peer, name):
            for want, parameters in ((4.0125993, {}), (4.0125993, {"ratio": 3}), (16.936132, {"load": "mid"})):
                order_1 = (peer, name) == ("xara", "force") and "load" not in parameters
                self.assertAlmostEqual(self.extrapolated(peer, name, "lateral_buckling", **parameters) / want, 1,
                                       delta=1.5e-2 if order_1 else 2e-5)
        self.buckling(check)


class Compliance(PeerTest):

    WORDS = ("sheet_cantilever", "--set", "warping=0", "--set", "trapeze=0", "--set", "shear_factor=0.8333333333")

    def test_sheet(self):
        """In the deflected sheet, Exudyn must have the compliances of beamwork along and across the sheet; the beam in
        space must also have those out of the plane."""
        data = json.loads(self.answered("scene", *self.WORDS, "--format", "json").stdout)
        record = self.record("solve", *self.WORDS, "-f", "collocation", "-n", 8)
        ours = {q["quantity"]: q["value"] for q in record["quantities"] if "value" in q}
        found = peers.solve(data, "exudyn", "exact_2d_3", [16], rounds=1)
        if found.missing:
            self.skipTest(found.missing)
        for name in ("C_xx", "C_ux_Fy", "C_ux_Mz", "C_uy_Fy", "C_thz_Mz"):
            self.assertAlmostEqual(found.runs[0]["values"][name] / ours[name], 1, delta=1e-5, msg=name)
        self.assertIn("does not compute this component", found.runs[0]["refused"]["C_zz"])
        both = [run["values"] for run in peers.solve(data, "exudyn", "exact_3d", [16, 32], rounds=1).runs]
        for name in (name for name in ours if name[:2] == "C_" and "curve" not in name):
            self.assertAlmostEqual((4 * both[1][name] - both[0][name]) / 3 / ours[name], 1, delta=3e-4, msg=name)

    def test_corner(self):
        """The compliance, which is not symmetric, of a bent and twisted corner of two members under a force and a moment."""
        made = bw.Scene("corner")
        made.sections["bar"] = {"stiffness": [4e4, 1e4, 1e4, 2, 3, 5], "mass": [1] * 6}
        for name, at in (("root", [0, 0, 0]), ("corner", [1, 0, 0]), ("tip", [1, 0.7, 0.2])):
            made.nodes[name] = {"at": at}
        made.nodes["root"]["hold"] = "all"
        made.members["one"] = {"from_": "root", "to": "corner", "section": "bar", "y": [0, 1, 0]}
        made.members["two"] = {"from_": "corner", "to": "tip", "section": "bar", "y": [1, 0, 0]}
        made.loads["force"] = {"force": [0.5, 1.5, -1], "on": "tip"}
        made.loads["moment"] = {"moment": [1.5, 1, 0.5], "on": "tip"}
        made.analyses["path"] = {"static": {"stations": [0.5, 1]}}
        made.analyses["end"] = {"compliance": {"node": "tip", "about": "path"}}
        words = ("ux", "uy", "uz", "rx", "ry", "rz")
        for row in words:
            for column in words:
                unit = {"uu": "m/N", "rr": "rad/(N m)"}.get(row[0] + column[0], "1/N" if row[0] == "u" else "rad/N")
                made.quantities[row + column] = {"compliance": {"analysis": "end", "row": row, "column": column}, "unit": unit}
        place = self.folder / "corner.yaml"
        made.write(place)
        record = self.record("solve", "--scene", place, "-f", "collocation", "-n", 8)
        ours = np.array([q["value"] for q in record["quantities"]]).reshape(6, 6)
        for peer, name in peers.chosen(["exudyn:exact_3d", "xara:exact"]):
            with self.subTest(peer=peer, element=name):
                found = peers.solve(self.data(made), peer, name, [8, 16], rounds=1)
                if found.missing:
                    self.skipTest(found.missing)
                self.assertIn("values", found.runs[1], found.runs[1])
                coarse, fine = (np.array(list(run["values"].values())).reshape(6, 6) for run in found.runs)
                for rows in (slice(0, 3), slice(3, 6)):
                    for columns in (slice(0, 3), slice(3, 6)):
                        want, got = ours[rows, columns], ((4 * fine - coarse) / 3)[rows, columns]
                        np.testing.assert_allclose(got, want, atol=3e-4 * np.abs(want).max())
