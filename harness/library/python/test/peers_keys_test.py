"""Keys of scene files that drivers of other programs read: small scenes with closed forms. Every element that supports a key must
give the values of its scene. Programs that are not installed are skipped by name."""
import math
import unittest

import numpy as np

from harness.library.python.test.module import bw
from harness.library.python.test.peers_test import PeerTest, peers

L, E, G, A, IY, IZ, IT, RHO, ALPHA = 2.0, 2e11, 8e10, 1e-2, 4e-6, 2e-6, 3e-6, 8000.0, 1.2e-5
EA, EIY, EIZ, GIT = E * A, E * IY, E * IZ, G * IT
WORDS = ("ux", "uy", "uz", "rx", "ry", "rz")


def cantilever(tip=None, **root):
    """Returns a bar along x that is clamped at its root."""
    made = bw.Scene("keys")
    made.sections["bar"] = {"constants": {"A": A, "Iy": IY, "Iz": IZ, "It": IT, "Ip": IY + IZ}, "young": E, "shear_modulus": G,
                            "density": RHO, "expansion": ALPHA}
    made.nodes["root"], made.nodes["tip"] = {"at": [0, 0, 0], "hold": "all", **root}, {"at": [L, 0, 0], **(tip or {})}
    made.members["bar"] = {"from_": "root", "to": "tip", "section": "bar", "y": [0, 1, 0], "warping": "free"}
    made.omit = ["trapeze", "wagner_torque", "shear"]
    return made


def weight():
    made = cantilever({"mass": 5.0})
    made.loads["bar"] = {"gravity": [0.1, -0.2, 0], "on": "all"}
    q, F = RHO * A * 0.2, 5 * 0.2
    return made, {"tip uy": -q * L**4 / 8 / EIZ - F * L**3 / 3 / EIZ, "root Ruy": q * L + F, "root Rux": -(RHO * A * L + 5) * 0.1,
                  "root Rrz": q * L**2 / 2 + F * L, "tip ux": (RHO * A * L**2 / 2 + 5 * L) * 0.1 / EA}


def heated():
    made = cantilever()
    made.loads["sun"] = {"temperature": 30, "gradient": [200, 100], "on": "bar"}
    y, z = ALPHA * 200, ALPHA * 100
    return made, {"tip ux": 30 * ALPHA * L, "tip uy": -y * L**2 / 2, "tip uz": -z * L**2 / 2, "tip ry": z * L, "tip rz": -y * L,
                  "root Rux": 0.0, "root Rrz": 0.0}


def heated_in_part():
    made = cantilever({"hold": "all"})
    made.loads["sun"] = {"temperature": 30, "on": "bar", "from_": 0.5}
    return made, {"root Rux": 30 * ALPHA / 2 * EA, "tip Rux": -30 * ALPHA / 2 * EA}


def settled():
    made = cantilever({"hold": ["ux", "uz", "rx", "ry", "rz"], "drive": {"uy": "sinks"}})
    made.motions["sinks"] = {"path": [0, 1], "value": [0, -1e-5]}
    return made, {"tip uy": -1e-5, "tip Ruy": -12e-5 * EIZ / L**3, "root Ruy": 12e-5 * EIZ / L**3, "tip Rrz": 6e-5 * EIZ / L**2}


def own_axes():
    """A load along the y axis of a vertical member."""
    made = cantilever()
    made.nodes["tip"]["at"] = [0, L, 0]
    made.members["bar"]["y"] = [-1, 0, 0]
    made.loads["q"] = {"distributed": [0, 3.0, 0], "to_value": [0, 0, 0], "axes": "member", "on": "bar"}
    return made, {"tip ux": -3 * L**4 / 30 / EIZ, "root Rux": 3 * L / 2, "root Rrz": -3 * L**2 / 6}


def hinged():
    """A bar on two pins, whose ends rotate about z only."""
    pin = {"hold": ["ux", "uy", "uz"], "rotation": {"sequence": [{"axis": "z", "angle": "free"}]}}
    made = cantilever(pin, **pin)
    made.loads["M"] = {"moment": [0, 0, 7.0], "on": "tip"}
    return made, {"tip rz": 7 * L / 3 / EIZ, "root rz": -7 * L / 6 / EIZ, "root Ruy": 7 / L}


def sprung():
    """A bar on springs at both ends, which bends and moves as a rigid body."""
    made = cantilever({"hold": ["uz", "rx", "ry"]})
    made.nodes["root"]["hold"] = ["ux", "uz", "rx", "ry"]
    k, r = 0.1 * EIZ / L**3, 0.3 * EIZ / L
    made.springs["at_root"] = {"to": "root", "stiffness": [0, k, 0, 0, 0, r]}
    made.springs["at_tip"] = {"to": "tip", "stiffness": [2 * k, 3 * k, 0, 0, 0, 0]}
    F = 1e-4 * k
    made.loads["F"] = {"force": [F, F, 0], "on": "tip"}
    a, b, c = 12 * EIZ / L**3, 6 * EIZ / L**2, EIZ / L
    K = np.array([[a + k, b, -a, b], [b, 4 * c + r, -b, 2 * c], [-a, -b, a + 3 * k, -b], [b, 2 * c, -b, 4 * c]])
    u = np.linalg.solve(K, [0, 0, F, 0])
    return made, {"root uy": u[0], "root rz": u[1], "tip uy": u[2], "tip rz": u[3], "tip ux": F / (2 * k + EA / L)}


def propped():
    """Two clamped bars that are connected by a hinge: the first bar carries the load of the second half."""
    made = cantilever()
    made.nodes["tip"] = {"at": [L, 0, 0]}
    made.nodes["end"] = {"at": [2 * L, 0, 0], "hold": "all"}
    made.members["other"] = {**made.members["bar"], "from_": "tip", "to": "end", "release": {"from_": ["rz"]}}
    made.loads["F"] = {"force": [0, 6.0, 0], "on": "tip"}
    return made, {"tip uy": 3 * L**3 / 3 / EIZ, "tip rz": 3 * L**2 / 2 / EIZ, "root Ruy": -3.0, "root Rrz": -3 * L, "end Ruy": -3.0,
                  "end Rrz": 3 * L}


def pinned():
    """A bar with hinges at both ends; nothing resists the rotations of the second node."""
    made = cantilever({"hold": ["ux", "uy", "uz"]})
    made.members["bar"]["release"] = {"from_": ["ry", "rz"], "to": ["rx", "ry", "rz"]}
    made.loads["q"] = {"distributed": [0, 6.0, 0], "on": "bar"}
    return made, {"root Ruy": -6 * L / 2, "root Rrz": 0.0, "tip Ruy": -6 * L / 2}


def fixed():
    """A bar between two clamps, with a hinge at one of them."""
    made = cantilever({"hold": "all"})
    made.members["bar"]["release"] = {"from_": ["rz"]}
    made.loads["q"] = {"distributed": [0, 6.0, 0], "on": "bar"}
    return made, {"root Ruy": -6 * 3 * L / 8, "root Rrz": 0.0, "tip Ruy": -6 * 5 * L / 8, "tip Rrz": 6 * L**2 / 8}


def tapered(linear):
    """A wedge that is half as thick at its tip as at its root. linear: adds an axial force, which would stiffen the wedge in a
    nonlinear analysis."""
    made = cantilever()
    for name, thickness in (("bar", 0.02), ("thin", 0.01)):
        made.sections[name] = {"rectangle": {"width": 0.03, "thickness": thickness}, "given": {"Iw": 0}, "young": E, "shear_modulus": G}
    made.members["bar"].update(section=["bar", "thin"])
    made.loads["F"] = {"force": [50.0, 0, 0], "on": "tip"}
    wanted = {"tip ux": 50 * 2 * L * math.log(2) / E / 0.03 / 0.02}
    if linear:
        made.loads["M"] = {"moment": [0, 0, 1e-3], "on": "tip"}
        wanted |= {"tip rz": 1e-3 * 3 * L * 12 / E / 0.03 / 0.02**3, "root Rrz": -1e-3}
    return made, wanted


CASES = {"taper": ("taper", tapered), "release": ("members.release", propped), "pinned": ("members.release", pinned), "fixed": ("members.release", fixed), "springs": ("springs", sprung), "gravity": ("loads.gravity", weight), "temperature": ("loads.temperature", heated),
         "part": ("loads.temperature", heated_in_part), "drive": ("", settled), "axes": ("loads.to_value", own_axes), "rotation": ("", hinged)}
DRIVEN = {"pyelastica"}  # rods with a clamped and a free end only


class Keys(PeerTest):

    def check(self, peer, name, element, make):
        linear = "linear" in element.analyses
        made, wanted = make(linear) if make is tapered else make()
        kind = "linear" if linear else "static"
        made.analyses["all"] = {kind: {} if kind == "linear" else {"stations": [1]}}
        for key in wanted:
            node, word = key.split()
            what, component = ("reaction", word[1:]) if word[0] == "R" else ("displacement", word)
            made.quantities[key.replace(" ", "_")] = {what: {"analysis": "all", "node": node, "component": component},
                                                      "unit": ("N" if what == "reaction" else "m") if component[0] == "u" else
                                                      "N m" if what == "reaction" else "rad"}
        found = peers.solve(self.data(made), peer, name, [8, 16], rounds=1)
        if found.missing:
            self.skipTest(found.missing)
        run = found.runs[-1]
        if ("space" in run.get("refusal", "") and "plane" in element.summary) or (kind == "static" and "in large motions" in run.get("refusal", "")):
            return
        self.assertIn("values", run, run)
        for key, want in wanted.items():
            coarse, fine = (one["values"][key.replace(" ", "_")] for one in found.runs)
            size = max(abs(v) for k, v in wanted.items() if k.split()[1][:-1] == key.split()[1][:-1]) or EA * ALPHA
            self.assertAlmostEqual((4 * fine - coarse) / 3 / size, want / size, delta=2e-4, msg=key)

    def each(self, name):
        key, make = CASES[name]
        for peer in peers.names():
            for word, element in peers.load(peer).ELEMENTS.items():
                if (not key or key in element.keys) and {"linear", "static"} & element.analyses and peer not in DRIVEN and (
                        "temperature" not in key or "linear" in element.analyses):
                    with self.subTest(peer=peer, element=word):
                        self.check(peer, word, element, make)


    def test_buckling_with_hinges(self):
        """Critical loads of members with hinges, which converge slowly in MYSTRAN and OpenSees, must be rejected."""
        made, _ = propped()
        made.analyses["all"] = {"buckling": {}}
        made.quantities["P"] = {"critical_factor": {"analysis": "all"}, "unit": "1"}
        for peer in ("mystran:bar", "opensees:elasticBeamColumn"):
            found = peers.solve(self.data(made), *peer.split(":"), [2], rounds=1)
            if found.missing:
                self.skipTest(found.missing)
            self.assertIn("release", found.runs[0]["refusal"])


    def test_large_hinges(self):
        """A bent bar that a hinge in the plane, or a ball joint, connects with a second one must have the displacements of beamwork."""
        for release in (["rz"], ["rx", "ry", "rz"]):
            made, _ = propped()
            made.nodes["tip"]["at"], made.nodes["end"]["at"] = [L, 0, 0], [L, L, 0]
            made.members["other"].update(y=[-1, 0, 0], release={"from_": release})
            made.loads["F"] = {"force": [2 * EIZ / L**2, 2 * EIZ / L**2, 0 if release == ["rz"] else EIY / L**2], "on": "tip"}
            made.analyses["all"] = {"static": {"stations": [1]}}
            for c in ("ux", "uy", "uz"):
                made.quantities[c] = {"displacement": {"analysis": "all", "node": "tip", "component": c}, "unit": "m"}
            for c in ("ux", "rz"):
                made.quantities["R" + c] = {"reaction": {"analysis": "all", "node": "end", "component": c}, "unit": "N" if c == "ux" else "N m"}
            place = self.folder / "large.yaml"
            made.write(place)
            ours = {q["quantity"]: q["value"] for q in self.record("solve", "--scene", place, "-f", "collocation", "-n", 8)["quantities"]}
            for peer, name in peers.chosen(["opensees:elasticBeamColumn", "opensees:forceBeamColumn", "xara:exact_3", "exudyn:exact_2d_3",
                                             "exudyn:exact_3d"]):
                if name == "exact_2d_3" and release != ["rz"]:
                    continue
                with self.subTest(peer=peer, element=name, release=release):
                    found = peers.solve(self.data(made), peer, name, [8, 16], rounds=1)
                    if found.missing:
                        self.skipTest(found.missing)
                    self.assertIn("values", found.runs[1], found.runs[1])
                    coarse, fine = (run["values"] for run in found.runs)
                    for key, value in ours.items():
                        size = {"u": L, "R": 2 * EIZ / L**2}[key[0]]
                        got = (4 * fine[key] - coarse[key]) / 3 if name[-2:] != "_3" else fine[key]
                        self.assertAlmostEqual(got / size, value / size, delta=3e-4, msg=key)


for case in CASES:
    setattr(Keys, f"test_{case}", lambda self, name=case: self.each(name))


if __name__ == "__main__":
    unittest.main()
