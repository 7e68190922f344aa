"""Supports in oblique axes: a scene that is rotated with its supports must give the same results in every analysis."""
import json
import math

from harness.tools.kit.program import ProgramTest, ROOT, run

EXAMPLE = ROOT / "cases" / "examples" / "inclined_roller.yaml"
HEAD = """beamwork: 1
name: frame
sections: {s: {rectangle: {width: 0.02, thickness: 0.03}, young: 2e9, shear_modulus: 0.8e9, density: 2000}}
"""
LISTS = """
nodes:
  a: {at: [0, 0, 0], hold: [uy, uz, rx, ry]}
  b: {at: [1, 0.2, 0.1], hold: [uz], mass: 0.5, centre: [0.02, 0.01, 0.03], inertia: [0.01, 0.02, 0.015, 0, 0, 0]}
  c: {at: [2, -0.1, 0], hold: [uy, rx, rz], drive: {ux: push}}
members:
  m: {from: a, to: b, section: s, y: [0, 1, 0]}
  n: {from: b, to: c, section: s, y: [0, 1, 0], offset: {from: [0, 0.01, 0], to: [0, 0, 0]}, release: {to: [ux, rz]}}
springs: {s: {to: b, stiffness: [0, 0, 20, 0, 0, 0.5], damping: [1, 1, 1, 0.01, 0.01, 0.01]}}
loads:
  f: {force: [3, -2, 1], on: b}
  g: {distributed: [0.5, 1, -1], on: n}
"""
ANALYSES = {
    "linear": ("A: {linear: {}}", 5e-7), "static": ("A: {static: {stations: [0.5, 1]}}", 1e-7),
    "buckling": ("A: {buckling: {}}", 1e-7), "modal": ("A: {modal: {}}", 1e-7),
    "about": ("B: {static: {stations: [1]}}\n  A: {modal: {about: B}}", 1e-7),
    "alpha": ("A: {motion: {stations: [0.02], integrator: alpha, step: 0.002}}", 1e-7),
    "conserving": ("A: {motion: {stations: [0.02], integrator: conserving, step: 0.002}}", 1e-7),
    "radau": ("A: {motion: {stations: [0.02], integrator: radau, step: 0.002}}", 1e-7)}
FORCES = """
  ra: {reaction: {analysis: A, node: @a, component: uy}}
  rc: {reaction: {analysis: A, node: @c, component: ux}}
  rm: {reaction: {analysis: A, node: @a, component: rx}}
  n: {internal: {analysis: A, member: @n, end: from, resultant: N}}
"""
QUANTITIES = {"buckling": "\n  p: {critical_factor: {analysis: A}}\n", **dict.fromkeys(
    ("modal", "about"), "\n  f: {frequency: {analysis: A}}\n  g: {frequency: {analysis: A, which: 3}}\n")}
SLIDE = HEAD + """parameters: {slope: {value: 0.5, unit: rad, min: 0, max: 1, about: slope}}
nodes:
  slide: {at: [0, 0, 0], axes: {x: [cos(slope), sin(slope), 0], z: [0, 0, 1]}, hold: [uy, uz, rx, ry], mass: 2}
  bob: {at: [0.3*sin(slope), -0.3*cos(slope), 0], mass: 1}
members: {rod: {from: slide, to: bob, section: s, y: [0, 0, 1]}}
loads: {own: {gravity: [0, -9.81, 0], on: all, time: 1}}
analyses: {down: {motion: {stations: [0.2], integrator: KIND, step: 0.002}}}
quantities:
  x: {displacement: {analysis: down, node: slide, component: ux}}
  y: {displacement: {analysis: down, node: slide, component: uy}}
  t: {displacement: {analysis: down, node: bob, component: rz}}
"""


AXES = "axes: {x: [0.6, 0.8, 0], z: [0, 0, 1]}"
GUIDED = AXES + ", hold: [uy, uz, rx, ry, rz]"
MIRRORED = HEAD + """nodes:
  a: {at: [0, 0, 0], GUIDED}
  m: {at: [0.6, 0.8, 0], MIDDLE}
END
members:
  l: {from: a, to: m, section: s, y: [-0.8, 0.6, 0], warping: fixed}
RIGHT
loads:
  p: {force: [0.6, 0.8, 0], on: a}
  q: {distributed: [-4, 3, 2], on: l}
MORE
analyses:
  bent: {static: {stations: [20]}}
  buckled: {buckling: {}}
  modes: {modal: {}}
quantities:
  u: {displacement: {analysis: bent, node: m, component: ux}}
  w: {displacement: {analysis: bent, node: m, component: uz}}
  c: {critical_factor: {analysis: buckled}}
  f: {frequency: {analysis: modes}}
"""


class Axes(ProgramTest):

    def values(self, text, *options, formulation="collocation"):
        return self.values_of(text, "-f", formulation, "-n", "2", *options)

    @staticmethod
    def scene(name, turned):
        analysis = ANALYSES[name][0]
        motion = "time: 0.02*(1 - cos(3*t))" if "motion" in analysis else "path: [0, 1], value: [0, 0.02]"
        quantities = QUANTITIES.get(name, FORCES)
        lists = LISTS
        if turned:
            lists = "\nparts:\n  p:" + LISTS.replace("\n", "\n    ") + """
instances: {i: {part: p, at: [0.3, 0.2, 0.1], axes: {x: [0.36, 0.48, -0.8], z: [0.48, 0.64, 0.6]}}}
"""
        return (HEAD + "motions: {push: {unit: m, " + motion + "}}" + lists + "analyses:\n  " + analysis +
                "\nquantities:" + quantities.replace("@", "i." if turned else ""))

    def test_turned_scene(self):
        for name, (_, close) in ANALYSES.items():
            plain, turned = (self.values(self.scene(name, turned)) for turned in (0, 1))
            self.assertGreater(len(plain), 0)
            for key, value in plain.items():
                self.assertLess(abs(turned[key] - value), close * max(1, abs(value)), f"{name}: {key}")

    def test_formulations(self):
        names = [f["formulation"] for f in self.record("list", "formulations")["formulations"]]
        self.assertGreaterEqual(len(names), 10)
        for name in names:
            record = self.record("solve", "--scene", EXAMPLE, "-f", name, "-n", "2")
            for q in record["quantities"]:
                self.assertLess(abs(q["error"]), 1e-6, f"{name}: {q['quantity']}")

    def test_slide(self):
        fall = 9.81 * math.sin(0.5) * 0.2**2 / 2
        for kind in ("alpha", "conserving", "radau"):
            found = self.values(SLIDE.replace("KIND", kind))
            self.assertAlmostEqual(found["x"], -fall * math.cos(0.5), delta=1e-6)
            self.assertAlmostEqual(found["y"], -fall * math.sin(0.5), delta=1e-6)
            self.assertAlmostEqual(found["t"], 0, delta=1e-6)

    def test_symmetry(self):
        half = MIRRORED.replace("GUIDED", GUIDED).replace("MIDDLE", AXES + ", hold: [ux, ry, rz]")
        whole = MIRRORED.replace("GUIDED", GUIDED).replace("MIDDLE", AXES + ", hold: [ux]")
        for name, more in (("END", f"  b: {{at: [1.2, 1.6, 0], {GUIDED}}}"),
                           ("RIGHT", "  r: {from: m, to: b, section: s, y: [-0.8, 0.6, 0], warping: fixed}"),
                           ("MORE", "  o: {force: [-0.6, -0.8, 0], on: b}\n  t: {distributed: [-4, 3, 2], on: r}")):
            whole, half = whole.replace(name, more), half.replace(name, "")
        a, b = self.values(whole), self.values(half)
        self.assertGreater(abs(a["u"]), 0.01)
        for name, value in a.items():
            self.assertLess(abs(b[name] / value - 1), 1e-7, name)

    def test_harmonic_reaction(self):
        text = HEAD + """motions: {go: {unit: m, path: [0, 1], value: [0, 0]}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0], axes: {x: [1, 1, 0], z: [0, 0, 1]}, hold: [uy], drive: {ux: go}}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}
analyses: {h: {harmonic: {frequencies: [0]}}}
quantities: {r: {response: {analysis: h, node: b, component: ux, of: reaction, drive: go}, unit: N/m}}
"""
        stiff = 2e9 * 0.02 * 0.03 + 3 * 2e9 * 0.03**3 * 0.02 / 12  # stiffness along and across the member, at 45 degrees
        found = self.values(text + "omit: [shear]\n")
        self.assertAlmostEqual(found["r"] / (stiff / 2), 1, delta=1e-6)
        path = self.folder / "across.yaml"
        path.write_text(text.replace("component: ux", "component: uy"))
        done = run("solve", "--scene", path, "-f", "collocation", "-n", "1")
        self.assertIn("requires a motion that drives only this component", done.stdout + done.stderr)

    def test_written_again(self):
        first = json.loads(run("solve", "--scene", EXAMPLE, "-f", "collocation", "-n", "1", "--format", "json").stdout)
        again = self.folder / "again.yaml"
        again.write_text(self.answered("scene", "--scene", EXAMPLE).stdout)
        second = self.record("solve", "--scene", again, "-f", "collocation", "-n", "1")
        for a, b in zip(first["quantities"], second["quantities"]):
            self.assertAlmostEqual(a["value"], b["value"], delta=1e-12 * abs(a["value"]))
        by_member = EXAMPLE.read_text().replace("axes: {x: [cos(slope), sin(slope), 0], z: [0, 0, 1]}",
                                                "axes: {member: right}")
        found = self.values(by_member)
        self.assertAlmostEqual(found["across"], 500, delta=1e-6)
        self.assertAlmostEqual(found["axial"], 0, delta=1e-6)

    def test_refused(self):
        text = EXAMPLE.read_text()
        for new, words in (("axes: {x: [1, 1, 0]}", "give two of x, y and z, or a member"),
                           ("axes: {x: [1, 1, 0], y: [1, 0, 0]}", "not perpendicular"),
                           ("axes: {member: left}", "neither end of member 'left' is at this node"),
                           ("axes: {x: [1, 1, 0], z: [0, 0, 1]}, drive: {rx: go}", "at most one rotation may be free or prescribed"),
                           ("axes: {x: [1, 1, 0], y: [0, 0, 1]}, rotation: {vector: [go, go, go]}", None)):
            path = self.folder / "bad.yaml"
            changed = text.replace("axes: {x: [cos(slope), sin(slope), 0], z: [0, 0, 1]}", new)
            path.write_text(changed.replace("loads:", "motions: {go: {unit: rad, path: [0, 1], value: [0, 1]}}\nloads:")
                            if "go" in new else changed)
            if words is not None:
                self.refused(2, words, "scene", "--scene", path)
        plane = self.folder / "plane.yaml"
        plane.write_text(text.replace("x: [cos(slope), sin(slope), 0], z: [0, 0, 1]", "x: [1, 0, 1], y: [0, 1, 0]") +
                         "plane: xy\n")
        self.refused(2, "neither in the plane nor normal to it", "scene", "--scene", plane)
        plane.write_text(HEAD + """
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0], axes: {x: [1, 1, 0], z: [0, 0, 1]}, hold: [uy]}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0], warping: fixed}}
loads: {f: {force: [1, 0, 0], on: b}}
analyses: {l: {linear: {}}}
quantities: {x: {displacement: {analysis: l, node: b, component: ux}}}
""")
        self.refused(2, "supports along rotated axes cannot be written as solids", "export", "--to", "calculix", "--scene", plane, "-o",
                     self.folder / "deck.inp")
