"""Small motions about instants of motions, compared with closed forms, a steady rotation, and motions with nearby initial
states."""
import csv
import json
import math
import unittest

import numpy
import scipy.io

from harness.tools.kit.program import ProgramTest, run

SECTION = """beamwork: 1
sections:
  rod: {rectangle: {width: 20e-3, thickness: 10e-3}, young: 70e9, shear_modulus: 26e9, density: 2700}
"""
ASIDE = """  wall: {at: [0, 5, 0], hold: all}
  end: {at: [0.1, 5, 0], hold: all}
"""
STUB = "members: {stub: {from: wall, to: end, section: rod, y: [0, 1, 0]}}\n"
FORMULATIONS = ("collocation", "geometrically_exact", "beamw", "sheet_third")

PENDULUM = SECTION + "nodes:\n" + ASIDE + """  pin: {at: [0, 0, 0], hold: [ux, uy, uz, rx, ry]}
  bob: {at: [1.5, 0, 0], part_of: pin, mass: 2}
springs: {none: {to: pin, stiffness: [0, 0, 0, 0, 0, 1e-9]}}
""" + STUB + """loads: {weight: {force: [0, -19.62, 0], on: bob}}
analyses:
  swing: {motion: {stations: [0, 0.31, 0.7], integrator: %(integrator)s, step: 1e-3, tolerance: 1e-4%(start)s}}
  modes: {modal: {about: swing, time: %(time)r, damped: yes}}
  shake: {harmonic: {about: swing, time: %(time)r, frequencies: [0.1, 0.3]}}
quantities:
  angle: {displacement: {analysis: swing, node: pin, component: rz, at: %(time)r}}
  at_the_step: {energy: {analysis: swing, of: kinetic, at: %(time)r}}  # not between two steps
  f: {frequency: {analysis: modes, which: 0}}
  decay: {damping_ratio: {analysis: modes, which: 0, of: decay}}
  turns: {response: {analysis: shake, node: pin, component: rz, force: pin, along: rz, at: 0.3, part: real}}
"""

ROTOR = SECTION + "nodes:\n" + ASIDE + """  disc: {at: [0, 0, 0], mass: 2, inertia: [0.03, 0.02, 0.02, 0, 0, 0]}
  left: {at: [-0.5, 0, 0], part_of: disc}
  right: {at: [0.5, 0, 0], part_of: disc}
springs:
  l: {to: left, stiffness: [1000, 800, 800, 0, 0, 0], damping: [0, 0.2, 0.2, 0, 0, 0]}
  r: {to: right, stiffness: [1000, 800, 800, 1e-6, 0, 0], damping: [0, 0.2, 0.2, 0, 0, 0]}
""" + STUB + """analyses:
  spin: {motion: {stations: [0.01], step: 5e-4, integrator: alpha, start: {spin: [300, 0, 0]}}}
  modes: {modal: {about: spin, time: 0.0081, damped: yes, axes: fixed}}
quantities:
  f_$i: {for: {i: 0..5}, frequency: {analysis: modes, which: $i}}
"""

ARM = SECTION + """nodes:
  hub: {at: [0, 0, 0], hold: [ux, uy, uz, rx, ry], drive: {rz: turn}}
  tip: {at: [1, 0, 0]}
members: {arm: {from: hub, to: tip, section: rod, y: [0, 0, 1]}}
motions: {turn: {unit: rad, time: 20*t}}
analyses:
  steady: {rotation: {omega: [0, 0, 20], stations: [1], wanted: 6}}
  spin: {motion: {about: steady, stations: [0.02], step: 1e-3}}
  modes: {modal: {about: spin, time: 0, damped: yes, axes_of: hub}}
quantities:
  r_$i: {for: {i: 0..3}, frequency: {analysis: steady, which: $i}}
  m_$i: {for: {i: 0..3}, frequency: {analysis: modes, which: $i}}
mass: lumped
"""

BEAD = SECTION + "nodes:\n" + ASIDE + """  hub: {at: [0, 0, 0], hold: [ux, uy, uz, rx, ry], drive: {rz: turn}}
  bead: {at: [0.4, 0, 0], mass: 0.5, hold: [rx, ry, rz]}
springs: {s: {from: hub, to: bead, stiffness: [400, 900, 700, 0, 0, 0]}}
""" + STUB + """motions: {turn: {unit: rad, time: 12*t}}
analyses:
  spin: {motion: {stations: [0.3], start: {spin: [0, 0, 12]}}}
  modes: {modal: {about: spin, time: %(time)r, damped: yes, axes_of: hub}}
quantities:
  f_$i: {for: {i: 0..2}, frequency: {analysis: modes, which: $i}}
"""

FLYING = SECTION + """nodes:
  a: {at: [0, 0, 0]}
  b: {at: [1, 0, 0], mass: 0.3}
  c: {at: [1, 0.7, 0.2]}
members:
  p: {from: a, to: b, section: rod, y: [0, 1, 0.1], damping: 1e-4}
  q: {from: b, to: c, section: rod, y: [1, 0, 0.2], damping: 1e-4}
analyses:
  flies: {motion: {stations: [0, 1e-5], step: 1e-6, start: {spin: [%(x)r, %(y)r, 30]}}}
  about: {harmonic: {about: flies, time: 0, frequencies: [1, 2], axes: fixed}}
quantities:
  $n$i: {for: {n: [a, b, c], i: [x, y, z]}, rate: {analysis: flies, node: $n, component: u$i, of: acceleration, at: 0}}
"""


class Instants(ProgramTest):

    def solved(self, text, formulation="collocation", elements=1, status=0, more=()):
        path = self.folder / "scene.yaml"
        path.write_text(text)
        done = run("solve", "--scene", path, "-f", formulation, "-n", elements, "--format", "json", *more)
        self.assertEqual(done.returncode != 0, status != 0, done.stdout[:300] + done.stderr)
        if status:
            return " ".join((done.stdout + done.stderr).split())
        return {q["quantity"]: q.get("value") for q in json.loads(done.stdout)["quantities"]}

    def near(self, value, right, tolerance=1e-8):
        self.assertLess(abs(value / right - 1), tolerance, (value, right))

    def test_pendulum(self):
        """Small deviations of a pendulum obey dtheta'' = -(g/l) cos(theta) dtheta, with theta = 0 at the lowest position."""
        for formulation in FORMULATIONS:
            for integrator in ("radau", "alpha"):
                for time in (0, 0.31, 0.7):
                    found = self.solved(PENDULUM % {"integrator": integrator, "time": time, "start": ""},
                                        formulation)
                    square = 9.81 / 1.5 * math.cos(math.pi / 2 + found["angle"])
                    if time > 0:
                        self.near(found["f"] * 2 * math.pi, math.sqrt(square))
                    self.near(found["turns"], 1 / (4.5 * (square - (0.6 * math.pi)**2)))
        for integrator in ("conserving", "explicit"):
            found = self.solved(PENDULUM % {"integrator": integrator, "time": 0.31, "start": ""})
            square = 9.81 / 1.5 * math.cos(math.pi / 2 + found["angle"])
            self.near(found["f"] * 2 * math.pi, math.sqrt(square))
        found = self.solved(PENDULUM % {"integrator": "radau", "time": 0.31, "start": ", start: {spin: [0, 0, 3]}"})
        square = 9.81 / 1.5 * math.cos(math.pi / 2 + found["angle"])
        self.assertLess(square, 0)
        self.near(found["decay"]**2, -square)

    def test_rotor(self):
        """A disc that spins at w between bearings has eigenvalues s with I s^2 - i J w s + c s + k = 0, where I and
        J are its transverse and polar moments of inertia, and k and c are the stiffness and damping against
        tilting."""
        found = self.solved(ROTOR)
        exact = [abs(numpy.roots([0.02, 0.1 + sign * 0.03j * 300, 400]).imag) for sign in (1, -1)]
        bounce = math.sqrt(1600 / 2 - (0.4 / 4)**2)
        right = sorted([math.sqrt(2000 / 2), bounce, bounce, *exact[0]])
        for value, expected in zip([found[f"f_{i}"] for i in range(1, 6)], right):
            self.near(value * 2 * math.pi, expected, 1e-7)

    def test_steady_rotation(self):
        for formulation in FORMULATIONS:
            found = self.solved(ARM, formulation, 4)
            for i in range(4):
                self.near(found[f"m_{i}"], found[f"r_{i}"])

    def test_bead(self):
        """A bead of mass m between springs of stiffness k and l, in axes that rotate at w, has eigenvalues s with
        (k/m - w^2 + s^2) (l/m - w^2 + s^2) + 4 w^2 s^2 = 0."""
        for time in (0, 0.123, 0.3):
            found = self.solved(BEAD % {"time": time})
            p, q, w = 800 - 144, 1800 - 144, 12
            squares = numpy.roots([1, p + q + 4 * w * w, p * q])
            right = sorted([*numpy.sqrt(-squares), math.sqrt(1400)])
            for i in range(3):
                self.near(found[f"f_{i}"] * 2 * math.pi, right[i])

    def test_nearby_motions(self):
        for formulation in ("collocation", "geometrically_exact", "beamw_consistent"):
            folder = self.folder / formulation
            self.solved(FLYING % {"x": 10.0, "y": -20.0}, formulation, 2, 0,
                        ("--matrices", folder, "--state-space"))
            M, C = (scipy.io.mmread(folder / "about" / "second_order" / f"{name}.mtx").toarray() for name in "MC")
            with open(folder / "dofs.csv", encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            for axis, name in enumerate("xy"):
                spin = numpy.eye(3)[axis]
                start = []
                for row in rows:
                    field = [*numpy.cross(spin, [float(row[k]) for k in "xyz"]), *spin]
                    names = ["ux", "uy", "uz", "rx", "ry", "rz"]
                    start.append(field[names.index(row["component"])] if row["component"] in names else 0)
                expected = -numpy.linalg.solve(M, C @ numpy.array(start))
                both = [self.solved(FLYING % {"x": 10.0, "y": -20.0, name: value}, formulation, 2)
                        for value in ((9.0, 11.0) if name == "x" else (-21.0, -19.0))]
                size = max(abs(v) for v in expected)
                for row, value in zip(rows, expected):
                    if row["node"] and row["component"][0] == "u":
                        key = row["node"] + row["component"][1]
                        self.assertLess(abs((both[1][key] - both[0][key]) / 2 - value), 1e-6 * size, (formulation, key))

    def test_refused(self):
        scene = PENDULUM % {"integrator": "radau", "time": 0.31, "start": ""}
        for before, after, said in (
                (", damped: yes", "", "add damped: yes"),
                ("time: 0.31, damped", "time: 0.8, damped", "lasts from 0 to 0.7 s; give a time in this range"),
                ("frequencies: [0.1, 0.3]", "frequencies: [0.1, 0.3], solution: modal", "remove 'solution'"),
                ("frequencies: [0.1, 0.3]", "frequencies: [0.1, 0.3], damping: {ratio: 0.1}", "damping ratios"),
                ("damped: yes", "damped: yes, damping: {mass: 1}", "give damping: {mass: a} to swing"),
                ("about: swing, time: 0.31, damped", "time: 0.31, damped", "is not about a motion"),
                ("damped: yes", "damped: yes, axes_of: wall2", "wall2"),
                ("node: pin, component: rz, force: pin", "node: bob, component: uy, of: velocity, force: pin", "its body rotates at 0.31 s")):
            self.assertIn(before, scene)
            self.assertIn(said, self.solved(scene.replace(before, after, 1), status=1), said)
        scene = BEAD.replace("modal: {about: spin, time: %(time)r, damped: yes, axes_of: hub}",
                             "compliance: {about: spin, node: bead}").replace("frequency", "compliance")
        scene = scene.split("quantities")[0]
        self.assertIn("name a static analysis", self.solved(scene, status=1))
        scene = (BEAD % {"time": 0.1}).replace("mass: 0.5, hold: [rx", "mass: 0.5, hold: [uy, rx")
        self.assertIn("replace 'axes_of'", self.solved(scene, status=1))

    def test_feedback(self):
        scene = (PENDULUM % {"integrator": "radau", "time": 0.31, "start": ""}).replace(
            "on: bob}}", "on: bob}, servo: {moment: [0, 0, 1], on: pin, feedback: "
            "{node: pin, component: rz, proportional: 3, derivative: 1}}}")
        opened = scene.replace("damped: yes}", "damped: yes, loops: open}")
        self.assertIn("modal about an instant", self.solved(scene, status=1))
        self.assertIn("harmonic about an instant", self.solved(opened, status=1))
        found = self.solved(opened.replace("[0.1, 0.3]}", "[0.1, 0.3], loops: open}"))
        self.near((found["f"] * 2 * math.pi)**2, 9.81 / 1.5 * math.cos(math.pi / 2 + found["angle"]))


if __name__ == "__main__":
    unittest.main()
