"""Constraints between components: one node in two, bodies, gears, cells that repeat; what is refused."""
import math

from harness.tools.kit.program import ProgramTest, ROOT, run

EXAMPLE = ROOT / "cases" / "examples" / "geared_shafts.yaml"
HEAD = """beamwork: 1
sections: {s: {rectangle: {width: 0.02, thickness: 0.03}, young: 2e9, shear_modulus: 0.8e9, density: 2000}}
"""
# At @: where m ends; at #: where n begins.
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


MASS = ", mass: 0.5, centre: [0.02, 0.01, 0.03], inertia: [0.01, 0.02, 0.015, 0, 0, 0]"
ALL = "components: [ux, uy, uz, rx, ry, rz]"
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
# Two shafts whose wheels turn in a ratio.
GEAR = """beamwork: 1
sections: {s: {tube: {diameter: 0.02, thickness: 0.01}, young: 210e9, shear_modulus: 80e9, density: 1e-3}}
nodes:
  a: {at: [0, 0, 0], hold: all}
  b: {at: [0, 0, 1], AXES hold: [ux, uy, rx, ry], inertia: [0.3, 0.3, 0.3, 0, 0, 0]}
  c: {at: [0.1, 0, 1], hold: all}
  d: {at: [0.1, 0, 3], AXES hold: [ux, uy, rx, ry], inertia: [0.05, 0.05, 0.05, 0, 0, 0]}
members:
  m: {from: a, to: b, section: s, y: [0, 1, 0]}
  n: {from: c, to: d, section: s, y: [0, 1, 0]}
constraints: {gear: {node: WHO, component: rz, ratio: RATIO, of: OTHER}}
loads: {t: {moment: [0, 0, TORQUE], on: b}, u: {moment: [0, 0, -5], on: d}}
omit: [shear, trapeze, wagner_torque, wagner_moments, rotary_inertia]
analyses:
  L: {linear: {}}
  S: {static: {stations: [0.5, 1]}}
  M: {modal: {}}
  MS: {modal: {about: S}}
  C: {compliance: {node: b}}
  D: {compliance: {node: d, about: S}}
quantities:
  lb: {displacement: {analysis: L, node: b, component: rz}}
  sb: {displacement: {analysis: S, node: b, component: rz}}
  sd: {displacement: {analysis: S, node: d, component: rz}}
  rb: {reaction: {analysis: S, node: b, component: rz}}
  rd: {reaction: {analysis: S, node: d, component: rz}}
  f: {frequency: {analysis: M}}
  fs: {frequency: {analysis: MS}}
  c: {compliance: {analysis: C, row: rz, column: rz}}
  d: {compliance: {analysis: D, row: rz, column: rz}}
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
# A triangle of columns that carries a floor.
STOREY = """beamwork: 1
sections:
  c: {rectangle: {width: 0.3, thickness: 0.2}, young: 30e9, shear_modulus: 12e9, density: 2500}
  d: {rectangle: {width: 0.4, thickness: 0.3}, young: 30e9, shear_modulus: 12e9, density: 2500}
nodes:
  A0: {at: [0, 0, 0], hold: all}
  B0: {at: [6, 0, 0], hold: all}
  C0: {at: [6, 4, 0], hold: all}
  A: {at: [0, 0, 3]HOLD}
  B: {at: [6, 0, 3]HOLD}
  C: {at: [6, 4, 3]HOLD}
  M: {at: [3, 2, 3], hold: [uz, rx, ry], mass: 500}
members:
  a: {from: A0, to: A, section: d, y: [0, 1, 0], warping: fixedRELEASE}
  b: {from: B0, to: B, section: c, y: [0, 1, 0], warping: fixedRELEASE}
  c: {from: C0, to: C, section: c, y: [0, 1, 0], warping: fixedRELEASE}
CONSTRAINTS
LOADS
analyses:
  L: {linear: {}}
  M: {modal: {}}
  S: {static: {stations: [0.5, 1]}}
  MS: {modal: {about: S}}
  C: {compliance: {node: M, about: S}}
  B: {buckling: {}}
  H: {harmonic: {frequencies: [3]}}
quantities:
  y: {displacement: {analysis: L, node: A, component: uy}}
  t: {displacement: {analysis: S, node: M, component: rz}}
  s: {displacement: {analysis: S, node: A, component: ux}}
  r: {reaction: {analysis: S, node: C0, component: uy}}
  N: {internal: {analysis: S, member: b, end: from, resultant: My}}
  f: {frequency: {analysis: M}}
  g: {frequency: {analysis: MS, which: 1}}
  c: {compliance: {analysis: C, row: ux, column: uy}}
  b: {critical_factor: {analysis: B}}
  h: {response: {analysis: H, node: B, component: uy, force: A, along: ux}}
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


class Constraints(ProgramTest):
    def values(self, text, formulation="collocation", elements=2):
        path = self.folder / "scene.yaml"
        path.write_text(text)
        record = self.record("solve", "--scene", path, "-f", formulation, "-n", elements)
        return {q["quantity"]: q["value"] for q in record["quantities"]}

    def same(self, one, two, close=1e-10, **options):
        a, b = self.values(one, **options), self.values(two, **options)
        self.assertGreater(len(a), 0)
        for name, value in a.items():
            self.assertLess(abs(b[name] - value), close * abs(value), name)

    def names(self):
        names = [f["formulation"] for f in self.record("list", "formulations")["formulations"]]
        self.assertGreaterEqual(len(names), 10)
        return names

    def test_one_node_in_two(self):
        """Two nodes at one place that are equal in all components are one, in every analysis and formulation."""
        one = FRAME.replace("@", "b").replace("#", "b").replace("MOVES", MASS)
        two = FRAME.replace("@", "b").replace("#", "e").replace("MOVES", "")
        one = one.replace("NODES", "").replace("CONSTRAINTS", "")
        two = two.replace("NODES", "  e: {at: [1, 0.2, 0.1]" + MASS + "}")
        two = two.replace("CONSTRAINTS", "constraints: {one: {equal: [b, e], " + ALL + "}}")
        for name in self.names():
            self.same(one, two, 1e-7, formulation=name)

    def test_matrices(self):
        """What --matrices writes is that of the one node: stiffness and mass."""
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
        """Of a motion that others follow by constraints it is refused: it would be that of all of them."""
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
            self.assertIn("drives more than the component", done.stdout + done.stderr)

    def test_units(self):
        """One scene in mm and N gives the same: a ratio has no unit."""
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
        """Likewise a continuation, and buckling about a path."""
        one = COLUMN.replace("NODES", "").replace("#", "b").replace("CONSTRAINTS", "")
        two = COLUMN.replace("NODES", "e: {at: [0.5, 0, 0]}").replace("#", "e")
        self.same(one, two.replace("CONSTRAINTS", "constraints: {one: {equal: [e, b], components: [ux, uy, rz]}}"), 1e-7)

    def test_sliders(self):
        """On slopes, joined by a member: equal along them is a rigid link between them."""
        one = SLIDERS.replace("SLIDES", "part_of: p").replace("CONSTRAINTS", "")
        two = SLIDERS.replace("SLIDES", "axes: {x: [0.8, 0.6, 0], z: [0, 0, 1]}, hold: [uy, uz, rx, ry, rz]")
        self.same(one, two.replace("CONSTRAINTS", "constraints: {s: {equal: [p, q], components: ux}}"))

    def test_gear(self):
        """Stiffness k1 + i^2 k2 and inertia I1 + i^2 I2, at large turns too, whoever names whom; in turned axes."""
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
        """About an axis that is none of the scene's."""
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
        """Displacements in a ratio: the spring at the other end counts with its square; driven, it follows."""
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
        """Turns in a ratio at the ends of two beams of a plane scene: (3 E I/2 + 9 x 4 E I) of the first turn."""
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
        """A cell whose ends are equal is one of three in a row whose ends are equal."""
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
        """A member between nodes that are equal: heated it pushes with E A alpha T; loaded it is clamped."""
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
        """In closed form, in all formulations; what is written again gives the same."""
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
        """What contradicts supports, motions, bodies or another constraint."""
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
                           ("{equal: [a, b], components: ux}", "x: ux of node a is both held and constrained"),
                           ("{equal: [b, c], components: uz}", "uz of node b is both held"),
                           ("{equal: [b, c], components: uy}", "uy of node c is driven twice"),
                           ("{equal: [b, d], components: ux}", "node d moves with node c; name the latter instead"),
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

    def test_one_node_in_two_in_time(self):
        """Likewise motions: all integrators, with dashpots, driven, of nodes with and without mass; energy as it was."""
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
        """Two halves, one of them elsewhere in axes of its own, equal in the plane of symmetry: the whole, from a static start."""
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
        """A step of torque: T/k (1 - cos omega t), whoever names whom, in turned axes too, with and without inertia behind the gear."""
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
        """Two free bars that share one translation, or in a ratio, and their turns: momentum and energy to round-off."""
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
            self.assertIn("node d: the initial velocity contradicts a constraint", done.stdout + done.stderr)

    def test_driven_in_time(self):
        """A lever that is driven: the other end follows, and its inertia is at the drive."""
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

    def test_diaphragm(self):
        """Across its normal a rigid body: at large rotations too, with loads beside nodes; with free tilts, universal joints."""
        loads = """loads:
  f: {force: [1e6, 4e6, 0], on: M}
  g: {force: [1e6, -3e6, 0], on: A}
  h: {moment: [0, 0, 1e6], on: M}
  i: {force: [2e6, 1e6, 0], on: C, at: [0.5, 0.2, 0.1]}
  j: {distributed: [2e5, 1e5, 0], on: a}
"""
        for tilts, released in (("rx, ry, ", ""), ("", ", release: {to: [rz, ry]}")):
            same = STOREY.replace("LOADS", loads if tilts else loads.replace(", at: [0.5, 0.2, 0.1]", ""))
            floor = same.replace("HOLD", ", hold: [" + tilts + "uz]").replace("RELEASE", "")
            floor = floor.replace("CONSTRAINTS", "constraints: {floor: {diaphragm: [A, B, C], master: M, normal: z}}")
            body = same.replace("HOLD", ", part_of: M").replace("CONSTRAINTS", "").replace("RELEASE", released)
            a, b = self.values(floor), self.values(body)
            self.assertGreater(abs(b["t"]), 0.02)
            for name, value in b.items():
                self.assertLess(abs(a[name] - value), 1e-7 * abs(value), f"{tilts}: {name}")
            path = self.folder / "floor.yaml"
            path.write_text(floor)
            again = self.answered("scene", "--scene", path).stdout
            self.assertIn("diaphragm: [A, B, C]", again)
            for name, value in self.values(again).items():
                self.assertLess(abs(a[name] - value), 1e-10 * abs(a[name]), name)

    def test_braced_floor(self):
        """Its nodes also rise and tilt: the limit of stiff bars in its plane, with hinges across it, with an error of their compliance."""
        loads, errors = "loads: {f: {force: [1e4, 2e4, -3e4], on: A}, g: {force: [0, 1e4, 5e3], on: C}}\n", []
        same = STOREY.replace("LOADS", loads).replace("HOLD", "").replace("RELEASE", "").replace(", hold: [uz, rx, ry], mass: 500", ", hold: [uz, rx, ry]")
        same = same[:same.index("analyses")] + "analyses: {L: {linear: {}}}\n" + """quantities:
  x: {displacement: {analysis: L, node: A, component: ux}}
  y: {displacement: {analysis: L, node: C, component: uy}}
  z: {displacement: {analysis: L, node: C, component: uz}}
  r: {displacement: {analysis: L, node: B, component: rx}}
"""
        exact = self.values(same.replace("CONSTRAINTS", "constraints: {floor: {diaphragm: [A, B, C], master: M, normal: z}}"))
        for stiff in (1e2, 1e4):
            bars = same.replace("  M: {at: [3, 2, 3], hold: [uz, rx, ry]}\n", "").replace("CONSTRAINTS", "")
            ends = ", release: {from: [rz], to: [rz, rx]}"
            bars = bars.replace("members:", "members:" + "".join(f"\n  {p}{q}: {{from: {p}, to: {q}, section: bar, y: [0, 0, 1]{ends}}}" for p, q in ("AB", "BC", "CA")))
            bars = bars.replace("sections:", f"sections:\n  bar: {{rectangle: {{width: 0.3, thickness: 0.3}}, young: {30e9 * stiff}, shear_modulus: {12e9 * stiff}}}")
            found = self.values(bars)
            errors.append(max(abs(found[name] / value - 1) for name, value in exact.items()))
        self.assertLess(errors[1], 1e-5)
        self.assertAlmostEqual(errors[0] / errors[1], 100, delta=10)

    def test_storey(self):
        """The example in closed form, in all formulations; what a diaphragm cannot be."""
        example = ROOT / "cases" / "examples" / "eccentric_storey.yaml"
        for name in self.names():
            for q in self.record("solve", "--scene", example, "-f", name, "-n", "1")["quantities"]:
                self.assertLess(abs(q["error"]), 1e-8, f"{name}: {q['quantity']}")
        text, path = example.read_text(), self.folder / "storey.yaml"
        for old, new, words in (("d:  {at: [0, 4, 3], hold: [uz, rx, ry]}", "d:  {at: [0, 4, 3], hold: [uz, ux]}", "ux of node d is fixed or driven, but follows the master"),
                                ("d:  {at: [0, 4, 3], hold: [uz, rx, ry]}", "d:  {at: [0, 4, 3], axes: {x: [0, 1, 0], y: [1, 0, 0]}}", "node d has axes of its own"),
                                ("[a, b, c, d], master", "[a, b, c, middle], master", "floor: node middle is named twice"),
                                ("normal: z}", "normal: z}\n  two: {equal: [a, b], components: [uy]}", "uy of node a is in a diaphragm, too"),
                                ("normal: z}", "normal: z}\n  two: {diaphragm: [a], master: b, normal: z}", "is in another constraint, too"),
                                (", normal: z}", "}", "{diaphragm: [NODE], master: NODE, normal: z}")):
            self.assertIn(old, text)
            path.write_text(text.replace(old, new))
            self.refused(2, words, "scene", "--scene", path)
        text = text.replace("pushed: {linear: {}}", "pushed: {linear: {}}\n  C: {compliance: {node: a}}")
        text = text.replace("quantities:", "quantities:" + "".join(
            f"\n  c{a}{b}: {{compliance: {{analysis: C, row: {a}, column: {b}}}}}" for a in ("ux", "uy", "rz") for b in ("ux", "uy")))
        det = "(ky*kt - kc^2)"  # displacement of a: that of the middle + turn x (-3, -2)
        text = text.replace("truths:", "truths:" + "".join(
            f"\n  - {{quantity: c{name}, value: {value}, kind: exact, source: statics, uncertainty: 1e-9}}" for name, value in {
                "uxux": f"1/ky + 4*ky/{det}", "uyuy": f"(kt + 6*kc + 9*ky)/{det}", "uxuy": f"(-2*kc - 6*ky)/{det}",
                "uyux": f"(-2*kc - 6*ky)/{det}", "rzux": f"2*ky/{det}", "rzuy": f"(-kc - 3*ky)/{det}"}.items()))
        path.write_text(text)
        for q in self.record("solve", "--scene", path, "-f", "collocation", "-n", "1")["quantities"]:
            self.assertLess(abs(q["error"]), 1e-8, q["quantity"])
        text = example.read_text()
        path.write_text(text.replace("modes:  {modal: {}}", "modes:  {modal: {}}\n  T: {motion: {stations: [0.1], integrator: alpha, step: 0.01}}")
                        .replace("quantities:", "quantities:\n  q: {displacement: {analysis: T, node: a, component: ux}}"))
        done = run("solve", "--scene", path, "-f", "collocation", "-n", "1")
        self.assertIn("is a diaphragm, which motions in time do not support", done.stdout + done.stderr)

    def test_motions(self):
        """What an integrator cannot do is refused by name, alone."""
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
        self.assertIn("constrained translations of a node that rotates with a mass beside it (node c)", done.stdout + done.stderr)
        path.write_text(text.replace("BESIDE", ""))
        done = run("export", "--to", "calculix", "--scene", path, "-o", self.folder / "deck.inp")
        self.assertIn("constraints cannot be written with solids", done.stdout + done.stderr)
        gear = GEAR.replace("WHO", "d").replace("OTHER", "b").replace("RATIO", "-2").replace("TORQUE", "40").replace("AXES ", "")
        path.write_text(gear[:gear.index("analyses")] + """analyses: {T: {motion: {stations: [0.01], integrator: conserving, step: 0.001}}}
quantities: {t: {displacement: {analysis: T, node: b, component: rz}}}
""")
        done = run("solve", "--scene", path, "-f", "collocation", "-n", "1")
        self.assertIn("conserving does not support rotations in a ratio (node d); use alpha or radau", done.stdout + done.stderr)

    def test_mechanism(self):
        """What only a constraint could hold, and does not; what it holds."""
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
        self.assertIn("0, 0) while nothing deforms: parts that constraints join", done.stdout + done.stderr)
        found = self.values(text.replace("ENDS", ", hold: [ux]"))
        self.assertAlmostEqual(found["l"], 2 * 3 / (2e9 * 6e-4), delta=1e-15)
