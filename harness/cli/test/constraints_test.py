"""Constraints between components: split nodes, bodies, gears, periodic cells, and rejected constraints."""
import math

from harness.cli.test.constraints import ALL, GEAR, HEAD, MASS, ConstraintsCase
from harness.tools.kit.program import ROOT, run

EXAMPLE = ROOT / "cases" / "examples" / "geared_shafts.yaml"
# placeholders: @ for a node or key at the end of m, # for one at the start of n
FRAME = HEAD + """motions: {push: {unit: m, path: [0, 1], value: [0, 0.02]}}
nodes:
  a: {at: [0, 0, 0], hold: [ux, uy, uz, rx, ry]}
  b: {at: [1, 0.2, 0.1]MOVES}
  c: {at: [2, -0.1, 0], hold: [uy, uz, rx, ry], drive: {ux: push}}
NODES
members:
  m: {from: a, to: @, section: s, y: [0, 1, 0], warping: fixed}
  n: {from: #, to: c, section: s, y: [0, 1, 0], offset: {from: [0, 0.01, 0], to: [0, 0, 0]}, warping: fixed, damping: 1e-4}
springs:
  s: {to: c, stiffness: [500, 0, 20, 0, 0, 0.5], damping: [1, 1, 1, 0.01, 0.01, 0.01]}
  t: {to: @, stiffness: [9, 8, 20, 0.1, 0.2, 0.5], damping: [3, 1, 2, 0.01, 0.02, 0.01]}
loads:
  f: {force: [-6, -12, 6], on: #}
  q: {force: [0, 0, 2], on: #, at: [0.02, 0.03, 0]}
  g: {distributed: [0.5, 1, -1], on: n}
CONSTRAINTS
analyses:
  L: {linear: {}}
  S: {static: {stations: [0.5, 1]}}
  ML: {modal: {about: L}}
  M: {modal: {}}
  B: {buckling: {}}
  MD: {modal: {damped: yes}}
  C: {compliance: {node: #}}
  CS: {compliance: {node: #, about: S}}
  R: {rotation: {omega: [0, 0, 3], centre: [0, 0, 0], stations: [1]}}
  H: {harmonic: {frequencies: [3]}}
quantities:
  ux: {displacement: {analysis: L, node: b, component: ux}}
  sx: {displacement: {analysis: S, node: b, component: ux}}
  sy: {displacement: {analysis: S, node: #, component: uy}}
  sz: {displacement: {analysis: S, node: #, component: rz}}
  ra: {reaction: {analysis: S, node: a, component: uy}}
  rc: {reaction: {analysis: S, node: c, component: uy}}
  N: {internal: {analysis: S, member: n, end: from, resultant: Mz}}
  f1: {frequency: {analysis: M}}
  f5: {frequency: {analysis: M, which: 5}}
  fl: {frequency: {analysis: ML, which: 2}}
  fr: {frequency: {analysis: R, which: 2}}
  cx: {compliance: {analysis: C, row: ux, column: ux}}
  bc: {critical_factor: {analysis: B}}
  fd: {frequency: {analysis: MD, which: 3}}
  h: {response: {analysis: H, node: b, component: uy, force: #, along: ux}}
  v: {response: {analysis: H, node: #, component: uz, force: b, along: ux, part: phase}}
  cz: {compliance: {analysis: CS, row: uz, column: rx}}
"""
SLIDERS = HEAD + """nodes:
  a: {at: [0, 0, 0], hold: all}
  p: {at: [1, 0.1, 0], axes: {x: [0.8, 0.6, 0], z: [0, 0, 1]}, hold: [uy, uz, rx, ry, rz]}
  q: {at: [1, 0.8, 0.2], SLIDES}
  c: {at: [2, 0.7, 0.1], hold: all}
members:
  m: {from: a, to: p, section: s, y: [0, 1, 0], warping: free}
  n: {from: q, to: c, section: s, y: [0, 1, 0], warping: free}
  o: {from: p, to: q, section: s, y: [1, 0, 0], warping: free}
CONSTRAINTS
loads: {f: {force: [300, 50, 20], on: p}, g: {distributed: [10, 20, 30], on: o}, h: {force: [-20, 50, 0], on: q}}
analyses:
  L: {linear: {}}
  S: {static: {stations: [1]}}
  M: {modal: {}}
  B: {buckling: {}}
  MS: {modal: {about: S}}
  C: {compliance: {node: p, about: S}}
quantities:
  lx: {displacement: {analysis: L, node: q, component: ux}}
  sx: {displacement: {analysis: S, node: q, component: ux}}
  sy: {displacement: {analysis: S, node: p, component: uy}}
  ra: {reaction: {analysis: S, node: a, component: uy}}
  M: {internal: {analysis: S, member: o, end: from, resultant: Mz}}
  f0: {frequency: {analysis: M}}
  f2: {frequency: {analysis: M, which: 2}}
  fs: {frequency: {analysis: MS}}
  b: {critical_factor: {analysis: B}}
  c: {compliance: {analysis: C, row: ux, column: uy}}
"""
COLUMN = HEAD + """nodes:
  a: {at: [0, 0, 0], hold: [ux, uy, uz, rx]}
  b: {at: [0.5, 0, 0]}
  NODES
  c: {at: [1, 0, 0], hold: [uy, uz, rx]}
members:
  m: {from: a, to: b, section: s, y: [0, 1, 0], warping: fixed}
  n: {from: #, to: c, section: s, y: [0, 1, 0], warping: fixed}
CONSTRAINTS
loads: {p: {force: [-1, 0, 0], on: c}, f: {force: [0, 1e-3, 0], on: b}}
plane: xy
analyses:
  K: {continuation: {control: {node: #, component: uy}, to: [0.05], step: 0.01}}
  S: {static: {stations: [20]}}
  B: {buckling: {about: S}}
quantities:
  p: {factor_at: {analysis: K, at: 0.05}}
  u: {displacement: {analysis: S, node: c, component: ux}}
  b: {critical_factor: {analysis: B}}
"""


class Constraints(ConstraintsCase):

    def test_one_node_in_two(self):
        one = FRAME.replace("@", "b").replace("#", "b").replace("MOVES", MASS)
        two = FRAME.replace("@", "b").replace("#", "e").replace("MOVES", "")
        one = one.replace("NODES", "").replace("CONSTRAINTS", "")
        two = two.replace("NODES", "  e: {at: [1, 0.2, 0.1]" + MASS + "}")
        two = two.replace("CONSTRAINTS", "constraints: {one: {equal: [b, e], " + ALL + "}}")
        for name in self.names():
            self.same(one, two, 1e-7, formulation=name)

    def test_matrices(self):
        one = FRAME.replace("@", "b").replace("#", "b").replace("MOVES", MASS)
        two = FRAME.replace("@", "b").replace("#", "e").replace("MOVES", "")
        one = one.replace("NODES", "").replace("CONSTRAINTS", "")
        two = two.replace("NODES", "  e: {at: [1, 0.2, 0.1]" + MASS + "}")
        two = two.replace("CONSTRAINTS", "constraints: {one: {equal: [b, e], " + ALL + "}}")
        found = []
        for name, text in (("one", one), ("two", two)):
            path = self.folder / f"{name}.yaml"
            path.write_text(text)
            self.answered("solve", "--scene", path, "-f", "collocation", "-n", 2, "--matrices", self.folder / name)
            found.append([(self.folder / name / file).read_text().splitlines()
                          for file in ("undeformed/K.mtx", "undeformed/M.mtx")])
        for a, b in zip(*found):
            self.assertEqual([line for line in a if not line.startswith("%")],
                             [line for line in b if not line.startswith("%")])

    def test_harmonic_reaction(self):
        path = self.folder / "followed.yaml"
        path.write_text(HEAD + """motions: {go: {unit: m, path: [0, 1], value: [0, 0]}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0], drive: {uy: go}}, c: {at: [2, 0, 0]}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}, n: {from: b, to: c, section: s, y: [0, 1, 0]}}
constraints: {x: {node: c, component: uy, ratio: 2, of: b}}
analyses: {h: {harmonic: {frequencies: [0]}}}
quantities: {r: {response: {analysis: h, node: NODE, component: uy, of: reaction, drive: go}, unit: N/m}}
""")
        text = path.read_text()
        for node in "bc":
            path.write_text(text.replace("NODE", node))
            done = run("solve", "--scene", path, "-f", "collocation", "-n", "1")
            self.assertIn("drives more components than the one", done.stdout + done.stderr)

    def test_units(self):
        text = GEAR.replace("AXES ", "").replace("WHO", "d").replace("OTHER", "b").replace("RATIO", "-2")
        one = self.values(text.replace("TORQUE", "40"))
        mm = (text.replace("beamwork: 1", "beamwork: 1\nunits: mm, N, MPa").replace("diameter: 0.02, thickness: 0.01", "diameter: 20, thickness: 10")
              .replace("210e9", "210e3").replace("80e9", "80e3").replace("1e-3}", "1e-15}").replace("[0, 0, 1]", "[0, 0, 1000]")
              .replace("[0.1, 0, 1]", "[100, 0, 1000]").replace("[0.1, 0, 3]", "[100, 0, 3000]").replace("[0.3, 0.3, 0.3,", "[300, 300, 300,")
              .replace("[0.05, 0.05, 0.05,", "[50, 50, 50,").replace("TORQUE", "40e3").replace("-5]", "-5e3]"))
        two = self.values(mm)
        for name, factor in (("lb", 1), ("sd", 1), ("rb", 1e3), ("f", 1), ("d", 1e-3)):
            self.assertLess(abs(two[name] / (one[name] * factor) - 1), 1e-8, name)

    def test_column(self):
        one = COLUMN.replace("NODES", "").replace("#", "b").replace("CONSTRAINTS", "")
        two = COLUMN.replace("NODES", "e: {at: [0.5, 0, 0]}").replace("#", "e")
        self.same(one, two.replace("CONSTRAINTS", "constraints: {one: {equal: [e, b], components: [ux, uy, rz]}}"), 1e-7)

    def test_sliders(self):
        one = SLIDERS.replace("SLIDES", "part_of: p").replace("CONSTRAINTS", "")
        two = SLIDERS.replace("SLIDES", "axes: {x: [0.8, 0.6, 0], z: [0, 0, 1]}, hold: [uy, uz, rx, ry, rz]")
        self.same(one, two.replace("CONSTRAINTS", "constraints: {s: {equal: [p, q], components: ux}}"))

    def test_gear(self):
        """Two shafts with the gear ratio i must have the stiffness k1 + i^2 k2 and the inertia I1 + i^2 I2, even for
        large rotations, for both orders of the components in the constraint, and in rotated axes."""
        k1 = 80e9 * math.pi * 0.01**4 / 2
        k2 = k1 / 2
        stiff, inertia = k1 + 4 * k2, 0.3 + 4 * 0.05
        for torque, who, other, ratio in ((40, "d", "b", -2), (5000, "b", "d", -0.5)):
            text = GEAR.replace("WHO", who).replace("OTHER", other).replace("RATIO", str(ratio))
            text = text.replace("TORQUE", str(torque))
            turn = (torque + 10) / stiff
            wanted = {"lb": turn, "sb": turn, "sd": -2 * turn, "rb": k1 * turn - torque, "rd": -2 * k2 * turn + 5,
                      "f": math.sqrt(stiff / inertia) / (2 * math.pi), "c": 1 / stiff, "d": 4 / stiff}
            wanted["fs"] = wanted["f"]
            for axes in ("", "axes: {x: [0, 1, 0], y: [-1, 0, 0]}, "):
                found = self.values(text.replace("AXES ", axes))
                for name, value in wanted.items():
                    self.assertLess(abs(found[name] / value - 1), 1e-8, f"{name} {axes}")

    def test_turned_gear(self):
        text = GEAR.replace("WHO", "d").replace("OTHER", "b").replace("RATIO", "-2").replace("TORQUE", "4000")
        plain = self.values(text.replace("AXES ", ""))
        text = text.replace("AXES ", "axes: {z: [0.48, 0.64, 0.6], x: [0.8, -0.6, 0]}, ").replace("y: [0, 1, 0]", "y: [0.8, -0.6, 0]")
        for z, x in ((1, 0), (1, 0.1), (3, 0.1)):
            text = text.replace(f"at: [{x}, 0, {z}]", f"at: [{x + 0.48 * z}, {0.64 * z}, {0.6 * z}]")
        for axis in "bd":
            for turn in (f"[0, 0, {4000}], on: b", "[0, 0, -5], on: d"):
                size = float(turn.split(",")[2].split("]")[0])
                text = text.replace(f"moment: {turn}", f"moment: [{0.48 * size}, {0.64 * size}, {0.6 * size}], on: {turn[-1]}")
        turned = self.values(text)
        self.assertLess(abs(turned["sb"] / (0.6 * plain["sb"]) - 1), 1e-8)
        for name in ("rb", "rd", "f", "fs"):
            self.assertLess(abs(turned[name] / plain[name] - 1), 1e-8, name)

    def test_lever(self):
        text = HEAD + """motions: {go: {unit: m, path: [0, 1], value: [0, 0.02]}}
nodes:
  a: {at: [0, 0, 0], hold: all}
  b: {at: [1, 0, 0], hold: [ux, uz, rx, ry, rz]DRIVE}
  c: {at: [0, 2, 0], axes: {x: [0.6, 0, 0.8], y: [0, 1, 0]}, hold: [ux, uz, rx, ry, rz], mass: 3}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0], warping: fixed}}
springs: {s: {to: c, stiffness: [0, 700, 0, 0, 0, 0]}}
constraints: {lever: {node: c, component: uy, ratio: -3, of: b}}
loads: {f: {force: [0, 50, 0], on: b}, g: {force: [0, 20, 0], on: c}}
analyses: {L: {linear: {}}, S: {static: {stations: [0.5, 1]}}}
quantities:
  l: {displacement: {analysis: L, node: c, component: uy}}
  b: {displacement: {analysis: S, node: b, component: uy}}
  c: {displacement: {analysis: S, node: c, component: uy}}
  rb: {reaction: {analysis: S, node: b, component: uy}}
  rc: {reaction: {analysis: S, node: c, component: uy}}
plane: PLANE
"""
        stiff = 12 * 2e9 * 0.02 * 0.03**3 / 12
        for plane in ("xy", "space"):
            free = text.replace("DRIVE", "").replace("plane: space\n", "").replace("plane: PLANE\n", "")
            free = free.replace("motions:", "#").replace("loads:", "omit: [shear, trapeze]\nloads:")
            if plane == "xy":
                free = free.replace("axes: {x: [0.6, 0, 0.8], y: [0, 1, 0]}, ", "") + "plane: xy\n"
            found = self.values(free)
            self.assertLess(abs(found["l"] / (-3 * (50 - 60) / (stiff + 9 * 700)) - 1), 1e-8)
            self.assertLess(abs(found["c"] / (-3 * found["b"]) - 1), 1e-12)
            self.assertLess(abs(found["rb"] - 3 * found["rc"]), 1e-8)
        driven = text.replace("DRIVE", ", drive: {uy: go}").replace("plane: PLANE\n", "")
        found = self.values(driven)
        self.assertAlmostEqual(found["c"], -0.06, delta=1e-14)
        self.assertAlmostEqual(found["rc"], -0.06 * 700 - 20, delta=1e-9)

    def test_plane(self):
        """In a plane scene, the rotations at the ends of two beams have the ratio -3. The moment must be (3 E I/2 + 9 x
        4 E I) times the first rotation."""
        found = self.values(HEAD + """
nodes:
  a: {at: [0, 0, 0], hold: [ux, uy]}
  b: {at: [1, 0, 0]}
  c: {at: [2, 0, 0], hold: [ux, uy]}
  d: {at: [0, 1, 0], hold: [uy]}
  e: {at: [1, 1, 0], hold: [ux, uy, rz]}
members:
  m: {from: a, to: b, section: s, y: [0, 1, 0]}
  n: {from: b, to: c, section: s, y: [0, 1, 0]}
  o: {from: d, to: e, section: s, y: [0, 1, 0]}
constraints: {x: {node: d, component: rz, ratio: -3, of: a}}
loads: {w: {moment: [0, 0, 2], on: a}}
analyses: {S: {static: {stations: [1]}}, L: {linear: {}}, M: {modal: {}}}
quantities:
  l: {displacement: {analysis: L, node: a, component: rz}}
  s: {displacement: {analysis: S, node: a, component: rz}}
  d: {displacement: {analysis: S, node: d, component: rz}}
  ra: {reaction: {analysis: S, node: a, component: rz}}
  rd: {reaction: {analysis: S, node: d, component: rz}}
  f: {frequency: {analysis: M}}
plane: xy
omit: [shear]
""")
        bends = 2e9 * 0.02 * 0.03**3 / 12
        self.assertLess(abs(found["l"] * (1.5 + 36) * bends / 2 - 1), 1e-9)
        self.assertLess(abs(found["d"] / (-3 * found["s"]) - 1), 1e-12)
        self.assertLess(abs(found["ra"] - 3 * found["rd"]), 1e-8)
        self.assertGreater(found["f"], 1)

    def test_cell(self):
        found = []
        for cells in (1, 3):
            nodes = "".join(f"  l{i}: {{at: [{i}, 0, 0]}}\n  h{i}: {{at: [{i + 0.4}, 0.1, 0]}}\n" for i in range(cells))
            members = "".join(f"  m{i}: {{from: l{i}, to: h{i}, section: s, y: [0, 1, 0], warping: fixed}}\n"
                              f"  n{i}: {{from: h{i}, to: l{i + 1}, section: s, y: [0, 1, 0], warping: fixed}}\n"
                              for i in range(cells))
            springs = "".join(f"  s{i}: {{to: h{i}, stiffness: [500, 900, 300, 1, 2, 3]}}\n" for i in range(cells))
            loads = "".join(f"  f{i}: {{force: [5, 20, 9], on: h{i}}}\n  g{i}: {{distributed: [0, 30, 7], on: n{i}}}\n"
                            for i in range(cells))
            found.append(self.values(HEAD + f"nodes:\n{nodes}  l{cells}: {{at: [{cells}, 0, 0]}}\nmembers:\n{members}"
                                     f"springs:\n{springs}loads:\n{loads}"
                                     f"constraints: {{cell: {{equal: [l{cells}, l0], {ALL}}}}}\n" + """
analyses: {S: {static: {stations: [1]}}, M: {modal: {}}}
quantities:
  u: {displacement: {analysis: S, node: h0, component: uy}}
  l: {displacement: {analysis: S, node: l0, component: uz}}
  t: {displacement: {analysis: S, node: l0, component: rz}}
  N: {internal: {analysis: S, member: m0, where: 0.3, resultant: N}}
  f: {frequency: {analysis: M}}
"""))
        for name, value in found[0].items():
            self.assertLess(abs(found[1][name] / value - 1), 1e-7, name)

    def test_loop(self):
        text = HEAD.replace("density: 2000", "density: 2000, expansion: 1e-5") + """
nodes: {a: {at: [0, 0, 0], hold: [uz, rx, ry]}, b: {at: [1, 0, 0], hold: [uz, rx, ry]}, m: {at: [0.5, 0, 0], hold: [ux, uz]}}
members:
  m: {from: a, to: m, section: s, y: [0, 1, 0], warping: fixed}
  n: {from: m, to: b, section: s, y: [0, 1, 0], warping: fixed}
springs: {s: {to: a, stiffness: [0, 1e3, 0, 0, 0, 0]}}
constraints: {loop: {equal: [b, a], components: [ux, uy, rz]}}
loads: {t: {temperature: 30, on: m}, u: {temperature: 30, on: n}, f: {force: [0, 16, 0], on: m}}
omit: [shear, trapeze]
analyses: {L: {linear: {}}}
quantities:
  N: {internal: {analysis: L, member: n, end: from, resultant: N}}
  a: {displacement: {analysis: L, node: b, component: uy}}
  u: {displacement: {analysis: L, node: m, component: uy}}
"""
        for elements in (1, 2):
            found = self.values(text, elements=elements)
            self.assertAlmostEqual(found["N"], -2e9 * 6e-4 * 30e-5, delta=1e-6)
            self.assertAlmostEqual(found["a"], 16e-3, delta=1e-12)
            self.assertAlmostEqual(found["u"], 16e-3 + 16 / (192 * 2e9 * 0.02 * 0.03**3 / 12), delta=1e-9)

    def test_example(self):
        for name in self.names():
            for q in self.record("solve", "--scene", EXAMPLE, "-f", name, "-n", "2")["quantities"]:
                self.assertLess(abs(q["error"]), 1e-6, f"{name}: {q['quantity']}")
        again = self.folder / "again.yaml"
        again.write_text(self.answered("scene", "--scene", EXAMPLE).stdout)
        self.assertIn("ratio: ", again.read_text())
        self.assertIn("equal: [", again.read_text())
        one, two = (self.record("solve", "--scene", scene, "-f", "collocation", "-n", "1") for scene in (EXAMPLE, again))
        for a, b in zip(one["quantities"], two["quantities"]):
            self.assertAlmostEqual(a["value"], b["value"], delta=1e-12 * abs(a["value"]))

    def test_refused(self):
        text = HEAD + """motions: {go: {unit: m, path: [0, 1], value: [0, 0.01]}}
nodes:
  a: {at: [0, 0, 0], hold: all}
  b: {at: [1, 0, 0], hold: [uz], drive: {uy: go}}
  c: {at: [1, 1, 0], hold: [rx, ry], drive: {uy: go}}
  d: {at: [1, 2, 0], part_of: c}
  e: {at: [2, 1, 0], rotation: {sequence: [{axis: x, angle: free}, {axis: y, angle: free}]}}
members:
  m: {from: a, to: b, section: s, y: [0, 1, 0]}
  n: {from: b, to: c, section: s, y: [1, 0, 0]}
  o: {from: c, to: e, section: s, y: [0, 1, 0]}
constraints: {x: CONSTRAINT}
analyses: {L: {linear: {}}}
quantities: {u: {displacement: {analysis: L, node: b, component: ux}}}
"""
        path = self.folder / "bad.yaml"
        for new, words in (("{equal: [b, b], components: ux}", "x: node b is named twice"),
                           ("{equal: [a, b], components: ux}", "x: ux of node a is both fixed and constrained"),
                           ("{equal: [b, c], components: uz}", "uz of node b is both fixed"),
                           ("{equal: [b, c], components: uy}", "uy of node c is driven twice"),
                           ("{equal: [b, d], components: ux}", "node d is rigidly connected to node c; name node c instead"),
                           ("{equal: [b, c], components: rz}", "rz of node b is not a rotation about a fixed axis"),
                           ("{equal: [c, e], components: rz}", "rz of node e is not a rotation about a fixed axis"),
                           ("{equal: [b, c, e], components: ux}, y: {equal: [e, b], components: [ux]}",
                            "y: ux of node b already follows from other constraints"),
                           ("{node: b, component: ux, ratio: 0, of: c}", "ratio = 0"),
                           ("{node: b, component: ux, ratio: 2}", "give {equal: [NODE, NODE], components: [ux]}"),
                           ("{equal: [b, c], component: ux}", "give {equal: [NODE, NODE], components: [ux]}"),
                           ("{equal: b, components: ux}", "equal: give a list of at least two nodes"),
                           ("{equal: [b, k], components: ux}", "no node 'k'")):
            path.write_text(text.replace("CONSTRAINT}", new + "}"))
            self.refused(2, words, "scene", "--scene", path)
        path.write_text(text.replace("CONSTRAINT}", "{equal: [b, e], components: uz}}").replace("uz], drive", "rx], drive") + "plane: xy\n")
        self.refused(2, "plane", "scene", "--scene", path)
