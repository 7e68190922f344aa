"""Constraints between components in motions, with every integrator."""
import math

from harness.cli.test.constraints import ALL, GEAR, HEAD, MASS, ConstraintsCase
from harness.tools.kit.program import run

MOVING = HEAD + """nodes:
  a: {at: [0, 0, 0], hold: all}
  b: {at: [1, 0.2, 0.1]MOVES}
  c: {at: [2, -0.1, 0], mass: 0.3, inertia: [0.001, 0.002, 0.003, 0, 0, 0]}
NODES
members:
  m: {from: a, to: b, section: s, y: [0, 1, 0], warping: fixedDAMPS}
  n: {from: #, to: c, section: s, y: [0, 1, 0], warping: fixed}
springs: {t: {to: #, stiffness: [9, 8, 20, 0.1, 0.2, 0.5], damping: [3, 1, 2, 0.01, 0.02, 0.01]}}
loads:
  f: {force: [0, -60, 30], on: c, time: sin(30*t)}
  g: {moment: [3, 4, 5], on: "#", time: 1}
CONSTRAINTS
analyses: {T: {motion: {stations: [UNTIL], integrator: HOW}}}
quantities:
  y: {displacement: {analysis: T, node: "#", component: uy}}
  t: {displacement: {analysis: T, node: b, component: rz}}
  r: {reaction: {analysis: T, node: a, component: uy}}
  M: {internal: {analysis: T, member: n, end: from, resultant: Mz}}
  E: {energy: {analysis: T, of: energy}}
  D: {energy: {analysis: T, of: drift}}
  P: {momentum: {analysis: T, component: py}}
  L: {momentum: {analysis: T, component: lz}}
  v: {rate: {analysis: T, node: "#", component: uz}}
  w: {rate: {analysis: T, node: b, component: ry}}
"""
FLIGHT = HEAD + """nodes:
  a: {at: [0, 0, 0], mass: 1}
  b: {at: [1, 0, 0], mass: 2, inertia: [0.1, 0.1, 0.1, 0, 0, 0]}
  c: {at: [0, 2, 0], mass: 3}
  d: {at: [1, 2, 0.3], inertia: [0.02, 0.01, 0.03, 0, 0, 0]}
members:
  m: {from: a, to: b, section: s, y: [0, 1, 0], warping: fixed}
  n: {from: c, to: d, section: s, y: [0, 1, 0], warping: fixed}
constraints:
  s: {node: d, component: ux, ratio: RATIO, of: b}
  u: {equal: [a, c], components: [uz]}
  v: {equal: [b, d], components: [rx, ry, rz]}
analyses: {T: {motion: {stations: [1], integrator: HOW, start: START}}}
loads: {f: {force: [0, 0, 5], on: b, time: 1}}
quantities:
  x: {displacement: {analysis: T, node: b, component: ux}}
  d: {displacement: {analysis: T, node: d, component: ux}}
  px: {momentum: {analysis: T, component: px}}
  pz: {momentum: {analysis: T, component: pz}}
  E: {energy: {analysis: T, of: energy}}
  D: {energy: {analysis: T, of: drift}}
  rb: {reaction: {analysis: T, node: b, component: ux}}
  rd: {reaction: {analysis: T, node: d, component: ux}}
"""


class ConstraintsInTime(ConstraintsCase):

    def test_one_node_in_two_in_time(self):
        mass = ", mass: 0.5, inertia: [0.01, 0.02, 0.015, 0, 0, 0]"
        beside = ", mass: 0.5, centre: [0.02, 0.01, 0.03], inertia: [0.01, 0.02, 0.015, 0, 0, 0]"
        for how, until, moves in (("alpha, step: 0.002", 0.1, beside), ("alpha, step: 0.002, mass: consistent", 0.1, ""),
                                  ("radau, step: 0.005, mass: lumped", 0.1, mass), ("radau, step: 0.005", 0.1, beside),
                                  ("conserving, step: 0.002", 0.1, mass), ("conserving, step: 0.002", 0.1, ""),
                                  ("explicit, step: 5e-6", 0.0005, beside)):
            text = MOVING.replace("HOW", how).replace("UNTIL", str(until)).replace("DAMPS", "" if "explicit" in how else ", damping: 1e-4")
            one = text.replace("NODES\n", "").replace("CONSTRAINTS\n", "").replace("#", "b").replace("MOVES", moves)
            two = text.replace("NODES", "  e: {at: [1, 0.2, 0.1]" + moves + "}").replace("#", "e").replace("MOVES", "")
            two = two.replace("CONSTRAINTS", "constraints: {one: {equal: [b, e], " + ALL + "}}")
            a, b = self.values(one), self.values(two)
            for name in ("y", "t", "r", "M", "E", "P", "L", "v", "w"):
                self.assertLess(abs(b[name] - a[name]), 1e-8 * abs(a[name]), f"{how}: {name}")
            if "conserving" in how:
                self.assertLess(abs(b["D"]), 1e-11 * abs(b["E"]), how)

    def test_half(self):
        for how in ("alpha, step: 0.001", "radau, step: 0.002", "conserving, step: 0.001", "explicit, step: 1e-5, mass: lumped"):
            found = []
            for half in (0, 1):
                text = HEAD + """nodes:
  a: {at: [0, 0, 0], hold: all}
  b: {at: [1, 0, 0], hold: [ux, rx, ry, rz], mass: MASS}
  c: {at: PLACE, hold: all}
NODES
members:
  m: {from: a, to: b, section: s, y: [0, 1, 0], warping: fixed}
  n: {from: #, to: c, section: s, y: [0, 1, 0], warping: fixed}
CONSTRAINTS
loads: {f: {force: [0, -200, 150], on: b, time: cos(40*t)}, g: {force: [0, 50, 0], on: "#", time: 1}}
analyses: {S: {static: {stations: [1]}}, T: {motion: {stations: [UNTIL], integrator: HOW, about: S}}}
quantities:
  y: {displacement: {analysis: T, node: b, component: uy}}
  z: {displacement: {analysis: T, node: b, component: uz}}
  v: {rate: {analysis: T, node: "#", component: uy}}
  r: {reaction: {analysis: T, node: a, component: uy}}
  M: {internal: {analysis: T, member: m, end: from, resultant: Mz}}
  E: {energy: {analysis: T, of: energy}}
  W: {energy: {analysis: T, of: work}}
"""
                text = text.replace("HOW", how).replace("UNTIL", "0.001" if "explicit" in how else "0.05").replace("#", "d" if half else "b")
                text = text.replace("MASS", "0.6" if half else "1").replace("PLACE", "[5, 3, 0]" if half else "[2, 0, 0]")
                text = text.replace("NODES", "  d: {at: [5, 3, 1], axes: {x: [0, 0, -1], y: [0, 1, 0]}, hold: [ux, rx, ry, rz], mass: 0.4}" if half else "")
                found.append(self.values(text.replace("CONSTRAINTS", "constraints: {s: {equal: [b, d], components: [uy, uz]}}" if half else ""), elements=3))
            for name, value in found[0].items():
                self.assertLess(abs(found[1][name] - value), 1e-8 * abs(value) + 1e-10, f"{how}: {name}")

    def test_gear_in_time(self):
        """The rotation of geared shafts after a torque step T must be T/k (1 - cos omega t), with their stiffness k
        and their natural frequency omega, for both orders of the components in the constraint, with and without
        inertia beyond the gear."""
        k1, time, torque = 80e9 * math.pi * 0.01**4 / 2, 0.05, 500
        text = GEAR[:GEAR.index("analyses")].replace("loads: {t: {moment: [0, 0, TORQUE], on: b}, u: {moment: [0, 0, -5], on: d}}",
                                                    "loads: {t: {moment: [0, 0, 500], on: b, time: 1}}")
        text = text.replace("hold: [ux, uy, rx, ry]", "hold: [ux, uy, uz, rx, ry]") + """analyses: {T: {motion: {stations: [0.05], integrator: HOW}}}
quantities:
  b: {displacement: {analysis: T, node: b, component: rz}}
  d: {displacement: {analysis: T, node: d, component: rz}}
  v: {rate: {analysis: T, node: d, component: rz}}
  rb: {reaction: {analysis: T, node: b, component: rz}}
  rd: {reaction: {analysis: T, node: d, component: rz}}
  E: {energy: {analysis: T, of: energy}}
  D: {energy: {analysis: T, of: drift}}
"""
        axes = "axes: {x: [0, 1, 0], y: [-1, 0, 0]}, "
        for how, who, other, ratio, second, turned, close in (
                ("alpha, tolerance: 1e-6", "d", "b", -2, 0.05, "", 2e-5), ("alpha, tolerance: 1e-6", "b", "d", -0.5, 0, axes, 2e-5),
                ("radau, tolerance: 1e-9", "d", "b", -2, 0.05, axes, 1e-8), ("radau, tolerance: 1e-9", "b", "d", -0.5, 0, "", 1e-8),
                ("radau, tolerance: 1e-9", "b", "d", 1, 0.05, axes, 1e-8), ("explicit, step: 1e-4", "d", "b", -2, 0.05, "", 1e-8),
                ("explicit, step: 1e-4", "b", "d", -0.5, 0, axes, 1e-8), ("conserving, step: 1e-5", "d", "b", 1, 0.05, "", 3e-6),
                ("conserving, step: 1e-5", "b", "d", 1, 0, axes, 3e-6)):
            i = ratio if who == "d" else 1 / ratio
            stiff, inertia = k1 * (1 + i * i / 2), 0.3 + i * i * second
            omega = math.sqrt(stiff / inertia)
            turn, speed = torque / stiff * (1 - math.cos(omega * time)), torque / stiff * omega * math.sin(omega * time)
            twice = torque / inertia * math.cos(omega * time)
            wanted = {"b": turn, "d": i * turn, "v": i * speed, "E": torque * turn}
            if "conserving" not in how:
                wanted.update(rb=k1 * turn + 0.3 * twice - torque, rd=i * (k1 / 2 * turn + second * twice))
            scene = text.replace("HOW", how).replace("WHO", who).replace("OTHER", other).replace("RATIO", str(ratio))
            scene = scene.replace("AXES ", turned).replace("inertia: [0.05, 0.05, 0.05, 0, 0, 0]", "inertia: [0.05, 0.05, 0.05, 0, 0, 0]" if second else "")
            found = self.values(scene.replace(", }", "}"), elements=1)
            for name, value in wanted.items():
                self.assertLess(abs(found[name] / value - 1), close, f"{how} {ratio}: {name}")
            if "conserving" in how:
                self.assertLess(abs(found["D"]), 1e-9 * found["E"])

    def test_flight(self):
        for ratio in (1, -2):
            for how in ("radau, tolerance: 1e-8", "conserving, step: 0.002"):
                found = self.values(FLIGHT.replace("HOW", how).replace("RATIO", str(ratio)).replace("START", "{velocity: [0, 1, 0]}"))
                round_off = 1e-12 if "conserving" in how else 1e-6
                self.assertLess(abs(found["x"]), 1)
                self.assertGreater(abs(found["x"]), 0.05)
                self.assertAlmostEqual(found["d"], ratio * found["x"], delta=1e-13)
                self.assertLess(abs(found["pz"] / 5 - 1), round_off)
                self.assertLess(abs(found["D"]), round_off * found["E"] * 10)
                if ratio == 1:
                    self.assertLess(abs(found["px"]), round_off)
                if "radau" in how:
                    self.assertAlmostEqual(found["rb"], -ratio * found["rd"], delta=1e-8)
        path = self.folder / "start.yaml"
        for start in ("{velocity: [1, 1, 0]}", "{velocity: [0, 1, 0], spin: [0, 0, 3]}"):
            path.write_text(FLIGHT.replace("HOW", "alpha, step: 0.001").replace("RATIO", "-2").replace("START", start))
            done = run("solve", "--scene", path, "-f", "collocation", "-n", "1")
            self.assertIn("node d: the initial velocity violates a constraint", done.stdout + done.stderr)

    def test_driven_in_time(self):
        for how in ("alpha, step: 1e-4", "radau, step: 0.001", "conserving, step: 1e-4"):
            found = self.values(HEAD + """motions: {go: {unit: m, time: 0.01*t^2}}
nodes:
  a: {at: [0, 0, 0], hold: all}
  b: {at: [1, 0, 0], hold: [ux, uz, rx, ry, rz], drive: {uy: go}}
  c: {at: [0, 2, 0], axes: {x: [0, 0, 1], y: [0, 1, 0]}, hold: [ux, uz, rx, ry, rz], mass: 3}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0], warping: fixed}}
constraints: {lever: {node: c, component: uy, ratio: -3, of: b}}
analyses: {T: {motion: {stations: [0.5], integrator: INTEGRATOR, mass: lumped}}}
quantities:
  c: {displacement: {analysis: T, node: c, component: uy}}
  v: {rate: {analysis: T, node: c, component: uy}}
  r: {reaction: {analysis: T, node: c, component: uy}}
  D: {energy: {analysis: T, of: drift}}
  E: {energy: {analysis: T, of: kinetic}}
""".replace("INTEGRATOR", how))
            for name, value in {"c": -0.03 * 0.25, "v": -0.03, "r": -0.06 * 3}.items():
                self.assertLess(abs(found[name] / value - 1), 1e-8, f"{how} {name}")
            self.assertLess(abs(found["D"]), 1e-5 * found["E"], how)

    def test_motions(self):
        path = self.folder / "motion.yaml"
        text = HEAD + """
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]}, c: {at: [2, 0, 0]BESIDE}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}, n: {from: b, to: c, section: s, y: [0, 1, 0]}}
constraints: {x: {equal: [b, c], components: uy}}
loads: {f: {force: [0, 1, 0], on: b, time: 1}}
analyses: {L: {linear: {}}, T: {motion: {stations: [0.01], integrator: conserving, step: 0.001}}}
quantities:
  l: {displacement: {analysis: L, node: b, component: uy}}
  t: {displacement: {analysis: T, node: b, component: uy}}
"""
        path.write_text(text.replace("BESIDE", ", mass: 1, centre: [0, 0.1, 0]"))
        done = run("solve", "--scene", path, "-f", "collocation", "-n", "1")
        self.assertIn("constrained translations of a node that rotates with an eccentric mass (node c)", done.stdout + done.stderr)
        path.write_text(text.replace("BESIDE", ""))
        done = run("export", "--to", "calculix", "--scene", path, "-o", self.folder / "deck.inp")
        self.assertIn("a constraint cannot be written as solids", done.stdout + done.stderr)
        gear = GEAR.replace("WHO", "d").replace("OTHER", "b").replace("RATIO", "-2").replace("TORQUE", "40").replace("AXES ", "")
        path.write_text(gear[:gear.index("analyses")] + """analyses: {T: {motion: {stations: [0.01], integrator: conserving, step: 0.001}}}
quantities: {t: {displacement: {analysis: T, node: b, component: rz}}}
""")
        done = run("solve", "--scene", path, "-f", "collocation", "-n", "1")
        self.assertIn("conserving does not support rotations in a ratio (node d); use alpha or radau", done.stdout + done.stderr)

    def test_mechanism(self):
        text = HEAD + """
nodes: {a: {at: [0, 0, 0], hold: [uy, uz, rx, ry, rz]}, b: {at: [1, 0, 0]}, c: {at: [0, 1, 0], hold: [uy, uz, rx, ry, rz]}, d: {at: [1, 1, 0]ENDS}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}, n: {from: c, to: d, section: s, y: [0, 1, 0]}}
constraints: {x: {equal: [a, c], components: ux}}
loads: {f: {force: [3, 0, 0], on: b}}
analyses: {L: {linear: {}}}
quantities: {l: {displacement: {analysis: L, node: b, component: ux}}}
"""
        path = self.folder / "loose.yaml"
        path.write_text(text.replace("ENDS", ""))
        done = run("solve", "--scene", path, "-f", "collocation", "-n", "1")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("0, 0) without deformation: parts joined by constraints", done.stdout + done.stderr)
        found = self.values(text.replace("ENDS", ", hold: [ux]"))
        self.assertAlmostEqual(found["l"], 2 * 3 / (2e9 * 6e-4), delta=1e-15)
