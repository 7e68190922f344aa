"""Requirements on motions that other programs solve: closed forms, and results of beamwork. Programs that are not installed
are skipped by name."""
import importlib
import json
import math
import os
import sys
import unittest
import unittest.mock

import numpy as np

from harness.library.python.test.module import bw
from harness.library.python.test.peers_test import TILT, PeerTest, peers

LENGTH, EI, MASS = 2.0, 5.0, 1.5  # a slender bar, [m, N m^2, kg/m]
HELD = ["ux", "uy", "uz", "rx", "ry", "rz"]


def bar(stiffness=EI, turn=np.eye(3), hold=tuple(HELD), radius=2e-3):
    """Returns a bar that is initially along x. radius: radius of gyration relative to the length."""
    made = bw.Scene("motion")
    young = stiffness / (radius * LENGTH)**2 / MASS  # the area is MASS, and the density 1
    shear_modulus, Iy = 0.3 * young, stiffness / young
    made.sections["bar"] = {"constants": {"A": MASS, "Iy": Iy, "Iz": 1.5 * Iy, "It": 0.8 * stiffness / shear_modulus, "Ip": 2.5 * Iy,
                                          "D": [MASS, 0, 0, 0, MASS, 0, 0, 0, 1]},
                            "young": young, "shear_modulus": shear_modulus, "density": 1}
    made.nodes["root"] = {"at": [0, 0, 0], "hold": list(hold)}
    made.nodes["tip"] = {"at": turn @ np.array([LENGTH, 0, 0])}
    made.members["bar"] = {"from_": "root", "to": "tip", "section": "bar", "y": turn @ np.array([0, 1, 0])}
    return made


def ask(made, name, node, component, kind="displacement", unit="m", **more):
    what = {} if component is None else {"node": node, "component": component}
    made.quantities[name] = {kind: {"analysis": "run", **what, **more}, "unit": unit}


class MotionTest(PeerTest):

    def each(self, check):
        for peer in peers.names():
            for name, element in peers.load(peer).ELEMENTS.items():
                if "motion" in element.analyses:
                    self.omit = sorted({"shear"} - element.offers)
                    self.loose = 5 if peer == "pyelastica" else 1  # order 1: the half elements at the ends do not bend
                    with self.subTest(peer=peer, element=name):
                        check(peer, name, "plane only" not in element.summary)

    def solved(self, peer, name, made, n=8, whole=True):
        made.omit = ["trapeze", "wagner_torque", *self.omit]
        found = peers.solve(self.data(made), peer, name, [n], rounds=1, limit=300)
        if found.missing:
            self.skipTest(found.missing)
        run = found.runs[0]
        if "refusal" in run and not whole:
            return None
        self.assertIn("values", run, run)
        self.assertTrue(not whole or run["refused"] == {}, run["refused"])
        self.assertTrue("time step" in run["settings"], run["settings"])
        return run["values"]

    def ours(self, made, n=32):
        place = self.folder / "scene.yaml"
        made.write(place)
        words = ("solve", "--scene", place, "-f", "geometrically_exact", "-n", str(n), "--format", "json")
        return json.loads(self.answered(*words).stdout)


class Closed(MotionTest):

    def test_vibration(self):
        """After a force begins to act at the time 0, the deflection of a cantilever must be the sum over its modes."""
        def check(peer, name, _):
            made, force = bar(radius=0.02), 1e-3 * EI / LENGTH**2
            made.loads["force"] = {"force": [0, force, 0], "on": "tip", "time": "1 + 0*t"}
            stiffness = 1.5 * EI
            roots = [1.8751040687, 4.6940911330, 7.8547574382, 10.9955407349]
            period = 2 * math.pi * LENGTH**2 / roots[0]**2 * math.sqrt(MASS / stiffness)
            made.analyses["run"] = {"motion": {"stations": [0.3 * period, 0.5 * period]}}
            ask(made, "y", "tip", "uy", take="curve")
            values = self.solved(peer, name, made, 12)["y"]
            for t, y in values:
                want = sum(4 * force * LENGTH**3 / stiffness / r**4 *
                           (1 - math.cos(r**2 / LENGTH**2 * math.sqrt(stiffness / MASS) * t)) for r in roots)
                self.assertAlmostEqual(y / want, 1, delta=0.03 * self.loose)
        self.each(check)

    def test_pendulum(self):
        """A stiff bar that hangs and starts with an angular velocity must follow the equation of a rigid pendulum."""
        def check(peer, name, _):
            made = bar(1e4, np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]]), HELD[:5], 0.02)
            made.loads["weight"] = {"gravity": [0, -9.81, 0], "on": "bar"}
            end, spin, count = 0.4, 5.0, 1000
            made.analyses["run"] = {"motion": {"stations": [end], "start": {"spin": [0, 0, spin], "centre": [0, 0, 0]}}}
            ask(made, "x", "tip", "ux")
            ask(made, "y", "tip", "uy")
            ask(made, "turn", "root", "rz", unit="rad")
            ask(made, "energy", None, None, "energy", "J", of="energy")
            found = self.solved(peer, name, made, 12, whole=False)
            if found is None:
                return
            angle, rate, step = 0.0, spin, end / count
            for _ in range(count):  # the midpoint rule
                half = angle + step / 2 * rate, rate - step / 2 * 1.5 * 9.81 / LENGTH * math.sin(angle)
                angle, rate = angle + step * half[1], rate - step * 1.5 * 9.81 / LENGTH * math.sin(half[0])
            want = {"x": LENGTH * math.sin(angle), "y": LENGTH * (1 - math.cos(angle)), "turn": angle,
                    "energy": MASS * LENGTH**3 / 6 * rate**2}
            self.assertTrue({"x", "y"} <= set(found))
            for key, value in found.items():
                self.assertAlmostEqual(value / want[key], 1, delta=2e-2 * self.loose, msg=key)
        self.each(check)

    def test_strain_energy(self):
        """A force that grows slowly must store the energy of bending and shear."""
        def check(peer, name, _):
            if self.omit:
                return
            made, force, end = bar(radius=0.3), 1e-2, 60.0
            made.loads["force"] = {"force": [0, force, 0], "on": "tip", "time": f"sin(pi*t/{2 * end})^2"}
            made.analyses["run"] = {"motion": {"stations": [end]}}
            ask(made, "energy", None, None, "energy", "J", of="strain")
            shear_stiffness = 0.3 * EI / (0.3 * LENGTH)**2
            want = force**2 / 2 * (LENGTH**3 / 3 / (1.5 * EI) + LENGTH / shear_stiffness)
            self.assertAlmostEqual(self.solved(peer, name, made, 8)["energy"] / want, 1, delta=0.03 * self.loose)
        self.each(check)

    def test_driven(self):
        """The moment and the force that move a stiff bar must be its inertia times its acceleration."""
        def check(peer, name, _):
            for driven, unit, inertia in (("rz", "N m", MASS * LENGTH**3 / 3), ("uy", "N", MASS * LENGTH)):
                made = bar(1e5, hold=[c for c in HELD if c != driven])
                made.nodes["root"]["drive"] = {driven: "move"}
                made.motions["move"] = {"unit": "rad" if driven == "rz" else "m", "time": "0.5*t^4"}
                made.analyses["run"] = {"motion": {"stations": [0.5, 1.0]}}
                ask(made, "holds", "root", driven, "reaction", unit)
                ask(made, "moved", "root", driven, unit="rad" if driven == "rz" else "m", at=0.5)
                ask(made, "tip", "tip", "uy")
                found = self.solved(peer, name, made, 12, whole=False)
                if found is None:
                    continue
                self.assertAlmostEqual(found["moved"], 0.5 * 0.5**4, places=6)
                self.assertAlmostEqual(found["tip"] / (0.5 if driven == "uy" else LENGTH * math.sin(0.5)), 1, delta=1e-3)
                if "holds" in found:
                    self.assertAlmostEqual(found["holds"] / (inertia * 6), 1, delta=1e-2)
        self.each(check)


class Against(MotionTest):
    """The results of other programs must tend to those of beamwork."""

    def large(self, turn, hold=tuple(HELD)):
        made = bar(turn=turn, hold=hold, radius=0.1)
        made.loads["force"] = {"force": turn @ np.array([1.0, 3.0, -2.0]), "on": "tip", "time": "sin(2*t)^2"}
        made.loads["moment"] = {"moment": turn @ np.array([1.0, -0.8, 1.2]), "on": "tip", "pieces": [{"until": 0.5, "is": "2*t^2"},
                                                                                                {"is": "2*t - 0.5"}]}
        made.analyses["run"] = {"motion": {"stations": [1.0], "step": 0.005, "integrator": "radau"}}
        for c in HELD:
            ask(made, c, "tip", c, unit="m" if c[0] == "u" else "rad")
            ask(made, "V" + c, "tip", c, "rate", "m/s" if c[0] == "u" else "rad/s")
            if c in hold:
                ask(made, "R" + c, "root", c, "reaction", "N" if c[0] == "u" else "N m")
        ask(made, "energy", None, None, "energy", "J", of="energy")
        return made

    def compare(self, found, want, bound):
        """Errors are relative to the largest value of the same kind. For rotations, this value is at least the largest
        translation divided by the length."""
        for key in found:
            alike = [k for k in want if len(k) == len(key) and k[:-1] == key[:-1]]
            size = max(abs(want[k]) for k in alike)
            if key[:-1] in ("r", "Vr"):
                size = max([size, *(abs(want[key[:-2] + "u" + c]) / LENGTH for c in "xyz" if key[:-2] + "u" + c in want)])
            self.assertLess(abs(found[key] - want[key]) / size, bound, key)

    def numbers(self, made):
        solution = self.ours(made)
        return {q["quantity"]: q["value"] for q in solution["quantities"]}

    def test_large(self):
        """In large motions in space, with and without supports, displacements, velocities, reactions and energy must
        agree."""
        def check(peer, name, space):
            if not space:
                return
            for hold in (HELD, []):
                made = self.large(np.eye(3), hold)
                found = self.solved(peer, name, made, 16, whole=False)
                if found is not None:
                    # the stiffnesses of PyElastica change with the axial strain, which is 2 % here
                    self.compare(found, self.numbers(made), 0.06 if peer == "pyelastica" else 0.03)
        self.each(check)

    def test_rotated(self):
        """A rotation of the whole scene must rotate the results."""
        def check(peer, name, space):
            if not space:
                return
            results = []
            for turn in (np.eye(3), TILT[1]):
                results.append(self.solved(peer, name, self.large(turn), 4, whole=False))
            if None in results:
                return
            for before in ("", "R"):
                for kind in ("u", "r"):
                    keys = [before + kind + c for c in "xyz"]
                    if set(keys) <= set(results[0]):
                        one, other = ([found[key] for key in keys] for found in results)
                        np.testing.assert_allclose(other, TILT[1] @ one, atol=2e-3 * np.abs(one).max())
        self.each(check)

    def test_plane(self):
        """Motions in a plane must agree for a structure with a body at a node, gravity and a driver."""
        def check(peer, name, _):
            made = bar(radius=0.05)
            made.nodes["tip"].update(mass=1.0, inertia=[0.2, 0.2, 0.2, 0, 0, 0])
            made.nodes["root"].update(hold=["ux", "uz", "rx", "ry"], drive={"uy": "lift"})
            made.motions["lift"] = {"unit": "m", "time": "0.5*t^4"}
            made.loads["weight"] = {"gravity": [1.0, -2.0, 0], "on": "all", "time": "sin(2*t)^2"}
            made.analyses["run"] = {"motion": {"stations": [0.6], "step": 0.005, "integrator": "radau"}}
            for c, unit in (("ux", "m"), ("uy", "m"), ("rz", "rad")):
                ask(made, c, "tip", c, unit=unit)
                ask(made, "V" + c, "tip", c, "rate", unit + "/s")
            ask(made, "Ruy", "root", "uy", "reaction", "N")
            ask(made, "Mean", "tip", "uy", take="mean")
            ask(made, "Least", "tip", "uy", take="min")
            ask(made, "Relative", "tip", "ux", "relative", **{"from_": "root"})
            found = self.solved(peer, name, made, 20, whole=False)
            if found is not None:
                self.compare(found, self.numbers(made), 0.03)
        self.each(check)


    def test_start(self):
        """A free bar must keep its velocity and spin, and a bar must start from a static state."""
        def check(peer, name, space):
            made = bar(1e3, hold=(), radius=0.02)
            spin = np.array([0.4, 0.3, 2.0] if space else [0, 0, 2.0])
            made.analyses["run"] = {"motion": {"stations": [0.7], "start": {"velocity": [1, 2, 0], "spin": spin,
                                                                            "centre": [LENGTH / 2, 0, 0]}}}
            for c in HELD[:3]:
                ask(made, c, "tip", c)
            found = self.solved(peer, name, made, 4, whole=False)
            if found is not None:
                self.compare(found, self.numbers(made), 2e-3)
            made = bar()
            made.loads["pull"] = {"force": [0, 1.0, 0], "on": "tip", "time": "cos(t)^2"}
            made.loads["push"] = {"force": [-1.0, 0, 0], "on": "tip"}
            made.analyses["before"] = {"static": {"stations": [0.5]}}
            made.analyses["run"] = {"motion": {"stations": [1.0], "about": "before"}}
            for c in HELD[:2]:
                ask(made, c, "tip", c)
            found = self.solved(peer, name, made, 16, whole=False)
            if found is not None:
                self.compare(found, self.numbers(made), 0.03)
        self.each(check)


class Steps(PeerTest):
    """The time step must be halved until the time-integration error is small. The driver of this test has an error of order
    2 in the step."""

    def run_motion(self, error="1.0", elements=(4, ), when=None, **of):
        code = ("import math\nfrom .data import *\nNAME = PROGRAM = 'fake'\n"
                "ELEMENTS = {'bar': Element('bar', frozenset({'shear', 'mass', 'rotary inertia', 'large rotations'}), "
                "frozenset({'motion'}))}\n"
                "def version(): return '1'\n"
                "class M(Model):\n    unknowns = 3\n"
                "    def solve(self, a):\n        n = math.ceil(a.stations[-1]/a.step)\n        h = a.stations[-1]/n\n"
                f"        t = [i*h for i in range(n + 1)]\n        u = [1 - math.cos(x) + {error}*h**2*x for x in t]\n"
                "        return Answer([State({'tip': [v]*6}) for v in u], times=t, iterations=n)\n"
                "def build(scene, element, mesh): return M()\n")
        (self.folder / "fake.py").write_text(code, encoding="utf-8")
        sys.modules.pop("beamwork.peers.fake", None)
        with unittest.mock.patch.dict(os.environ, BEAMWORK_DRIVERS=str(self.folder)), \
                unittest.mock.patch.object(peers, "__path__", [*peers.__path__, str(self.folder)]):
            made = bar()
            made.omit = ["trapeze", "wagner_torque"]
            made.loads["force"] = {"force": [0, 1, 0], "on": "tip"}
            made.analyses["run"] = {"motion": {"stations": [1.5, 7.0]}}
            ask(made, "y", "tip", "uy", unit="s" if of.get("take") in ("crossing", "max_time") else "m", **of)
            if when:
                made.quantities["y"]["when"] = when
            return peers.solve(self.data(made), "fake", "bar", elements, rounds=1, limit=30).runs[-1]

    def test_statistics(self):
        mean_square = 1.5 - (2 * math.sin(7) - math.sin(14) / 4) / 7
        for want, of in ((1 - math.cos(7), {}), (2.0, {"take": "max"}), (0.0, {"take": "min"}), (math.pi, {"take": "max_time"}),
                         (1 - math.sin(7) / 7, {"take": "mean"}), (math.sqrt(mean_square), {"take": "rms"}),
                         (1 - math.cos(1.5), {"at": 1.5}), (math.pi / 2, {"take": "crossing", "when": {"level": 1}}),
                         (1.5 * math.pi, {"take": "crossing", "when": {"level": 1, "direction": "falling"}}),
                         (1.5 * math.pi, {"take": "crossing", "when": {"level": 1, "which": 1, "direction": "either"}})):
            with self.subTest(of):
                run = self.run_motion(**of)
                self.assertAlmostEqual(run["values"]["y"], want, delta=1e-3)

    def test_curve(self):
        for t, y in self.run_motion(take="curve")["values"]["y"]:
            self.assertAlmostEqual(y, 1 - math.cos(t), delta=1e-4)

    def test_bound(self):
        """A larger error of the driver must lead to shorter steps, and an error that does not decrease must be a
        failure."""
        few, many = (self.run_motion(error)["iterations"] for error in ("0.1", "10.0"))
        self.assertGreater(many, 4 * few)
        self.assertIn("when the step is halved", self.run_motion("(-1)**round(math.log2(n))/h**2")["failure"])

    def test_bound_follows_the_mesh(self):
        """The time-integration error must be small compared with the change from the previous mesh."""
        self.assertGreater(self.run_motion(elements=(4, 8))["iterations"], self.run_motion(elements=(4, ))["iterations"])


if __name__ == "__main__":
    unittest.main()
