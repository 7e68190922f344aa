"""Compares compliances about loaded states with central differences of displacements under small additional loads."""
import numpy

from harness.tools.kit.program import ProgramTest

COMPONENTS = ("ux", "uy", "uz", "rx", "ry", "rz")
HEAD = """beamwork: 1
sections:
  s: {rectangle: {width: 0.02, thickness: 0.03}, young: 2e9, shear_modulus: 0.8e9}
  c: {rectangle: {width: 0.3, thickness: 0.2}, young: 30e9, shear_modulus: 12e9}
  d: {rectangle: {width: 0.4, thickness: 0.3}, young: 30e9, shear_modulus: 12e9}
"""
BENT = HEAD + """nodes:
  a: {at: [0, 0, 0], hold: all}
  b: {at: [1, 0.1, 0], rotation: {sequence: [{axis: z, angle: free}, {axis: x, angle: X}, {axis: y, angle: Y}]}}
  c: {at: [2, 0, 0.1], hold: [uy, uz]}
members:
  m: {from: a, to: b, section: s, y: [0, 1, 0]}
  n: {from: b, to: c, section: s, y: [0, 1, 0]}
loads: {f: {force: [60, 400, -600], on: b}, g: {moment: [20, 30, 40], on: c}, UNIT}
"""
STOREY = HEAD + """nodes:
  A0: {at: [0, 0, 0], hold: all}
  B0: {at: [6, 0, 0], hold: all}
  C0: {at: [6, 4, 0], hold: all}
  A: {at: [0, 0, 3]DRIVE}
  B: {at: [6, 0, 3]}
  C: {at: [6, 4, 3]}
members:
  a: {from: A0, to: A, section: d, y: [0, 1, 0], warping: fixed}
  b: {from: B0, to: B, section: c, y: [0, 1, 0], warping: fixed}
  c: {from: C0, to: C, section: c, y: [0, 1, 0], warping: fixed}
constraints: {floor: {diaphragm: [B, C], master: A, normal: z}}
loads: {f: {force: [1.2e6, 8e5, -1e6], on: B}, g: {force: [0, 1.6e6, 0], on: C}, UNIT}
"""


def skew(v):
    return numpy.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def turn(v):
    size = numpy.linalg.norm(v)
    return numpy.eye(3) + numpy.sin(size) / size * skew(v) + (1 - numpy.cos(size)) / size**2 * skew(v) @ skew(v)


def spin(v):
    """Returns the matrix that maps a change of the rotation vector v to a spatial rotation."""
    size = numpy.linalg.norm(v)
    return (numpy.eye(3) + (1 - numpy.cos(size)) / size**2 * skew(v)
            + (size - numpy.sin(size)) / size**3 * skew(v) @ skew(v))


class UnitLoads(ProgramTest):

    def values(self, text):
        return self.values_of(text, "-f", "collocation", "-n", 1)

    def moved(self, text, node, unit):
        text = text.replace("UNIT", f"u: {{force: {list(unit[:3])}, on: {node}}}, v: {{moment: {list(unit[3:])}, on: {node}}}")
        text += "analyses: {S: {static: {stations: [0.5, 1]}}}\nquantities:\n"
        text += "".join(f"  {c}: {{displacement: {{analysis: S, node: {node}, component: {c}}}}}\n" for c in COMPONENTS)
        found = self.values(text)
        return numpy.array([found[c] for c in COMPONENTS])

    def differences(self, text, node, size, about=(0,) * 6):
        C = numpy.zeros((6, 6))
        for j in range(6):
            ends = [self.moved(text, node, [float(about[i]) + sign * size * (i == j) for i in range(6)]) for sign in (1, -1)]
            C[:, j] = (ends[0] - ends[1]) / (2 * size)
        C[3:] = spin(self.moved(text, node, [float(x) for x in about])[3:]) @ C[3:]
        return C

    def compliance(self, text, node, more=""):
        text = text.replace(", UNIT", "") + f"analyses: {{S: {{static: {{stations: [0.5, 1]}}}}, C: {{compliance: {{node: {node}, about: S{more}}}}}}}\n"
        text += "quantities:\n" + "".join(f"  {a}{b}: {{compliance: {{analysis: C, row: {a}, column: {b}}}}}\n" for a in COMPONENTS for b in COMPONENTS)
        found = self.values(text)
        return numpy.array([[found[a + b] for b in COMPONENTS] for a in COMPONENTS])

    def alike(self, C, D, words):
        size = numpy.sqrt(numpy.abs(numpy.diag(D)))
        self.assertGreater(size.min(), 0, words)
        self.assertLess(numpy.max(numpy.abs(C - D) / numpy.outer(size, size)), 1e-6, words)

    def test_sequence(self):
        for x, y in (("held", "free"), ("free", "held"), ("free", "free")):
            text = BENT.replace("angle: X", f"angle: {x}").replace("angle: Y", f"angle: {y}")
            self.alike(self.compliance(text, "b"), self.differences(text, "b", 1e-2), f"{x}, {y}")
        text = BENT.replace(", {axis: x, angle: X}", "").replace("angle: Y", "angle: free")
        self.alike(self.compliance(text, "b"), self.differences(text, "b", 1e-2), "two angles")

    def test_diaphragm(self):
        text = STOREY.replace("DRIVE", "")
        for node in "AB":
            self.alike(self.compliance(text, node), self.differences(text, node, 1e3), node)

    def test_released(self):
        driven = STOREY.replace("DRIVE", ", drive: {rz: turn}") + "motions: {turn: {unit: rad, path: [0, 1], value: [0, 0.1]}}\n"
        C, R = self.compliance(driven, "A", ", released: [rz]"), turn(self.moved(driven.replace("UNIT", ""), "A", [0] * 6)[3:])
        free, about = STOREY.replace("DRIVE", ""), numpy.arctan2(-R[0, 1], R[1, 1])
        self.assertAlmostEqual(about, 0.1, delta=1e-12)
        first = turn([0, 0, about])  # rotations about z, then x, then y
        along = numpy.cross(first[:, 0], first @ turn([numpy.arcsin(R[2, 1]), 0, 0])[:, 1])

        def beyond(moment):
            R = turn(self.moved(free, "A", [0.0] * 3 + [float(moment * x / along[2]) for x in along])[3:])
            return numpy.arctan2(-R[0, 1], R[1, 1]) - 0.1
        m, n = -4.5e6, -4.4e6
        f, g = beyond(m), beyond(n)
        while abs(g) > 1e-12:
            m, n, f = n, n - g * (n - m) / (g - f), g
            g = beyond(n)
        self.alike(C, self.differences(free, "A", 1e3, [0] * 3 + [n * x / along[2] for x in along]), "released")
        path = self.folder / "scene.yaml"
        text = driven.replace(", UNIT", "").replace("B: {at: [6, 0, 3]}", "B: {at: [6, 0, 3], hold: [rx]}")
        path.write_text(text + "analyses: {C: {compliance: {node: B, released: [rx]}}}\nquantities: {c: {compliance: {analysis: C, row: ux, column: ux}}}\n")
        self.refused(2, "rx of node B is fixed, but only driven components can be released", "scene", "--scene", path)
