"""Harmonic responses against closed forms, and what a harmonic analysis refuses."""
import cmath
import math
import unittest

from harness.tools.kit.program import ProgramTest, run

# A cantilever that only bends, with a dashpot at its tip.
BEAM = """beamwork: 1
let: {E: 210e9, b: 0.02, h: 0.01, L: 1, c: 15}
sections: {s: {constants: {A: b*h, Iy: 1e-4, Iz: b*h^3/12, It: 1e-6}, young: E, shear_modulus: 81e9, density: 7800}}
nodes:
  root: {at: [0, 0, 0], %s}
  tip: {at: [L, 0, 0]}
members: {m: {from: root, to: tip, section: s, y: [0, 1, 0]}}
springs: {d: {to: tip, damping: [0, c, 0, 0, 0, 0]}}
%s
analyses:
%s
  steady: {harmonic: {frequencies: [5, 8, 20, 60]%s}}
quantities:
%s
omit: [shear, rotary_inertia, trapeze, wagner_moments, wagner_torque]
"""
EI, MU, C = 210e9*0.02*0.01**3/12, 7800*0.02*0.01, 15
FREQUENCIES = 5, 8, 20, 60
PARTS = "real", "imaginary"


def reading(name, **keys):
    return "".join(f"  {name}_{part}: {{response: {{analysis: steady, node: tip, part: {part}, take: curve, "
                   + ", ".join(f"{k}: {v}" for k, v in keys.items()) + "}}\n" for part in PARTS)


FORCED = reading("u", component="uy", force="tip", along="uy") + reading("t", component="rz", force="tip", along="uy")
SHAKEN = reading("u", component="uy", drive="shake") + reading("r", component="uy", drive="shake", **{"from": "root"})


def beam(hertz, tension, length, by_mass=0.0, by_stiffness=0.0):
    """v(x) of EI v'''' - N v'' - mu w^2 v = 0 by its four exponentials: the roots, and EI. The mass stays, and
    moments go by the rotation per initial length. Proportional damping: EI (1 + i w b), mu (1 - i a/w)."""
    w = 2*math.pi*hertz
    stiff = EI*length*(1 + 1j*w*by_stiffness)
    s = cmath.sqrt((tension/(2*stiff))**2 + MU/length*w*(w - 1j*by_mass)/stiff)
    a, b = cmath.sqrt(tension/(2*stiff) + s), cmath.sqrt(s - tension/(2*stiff))
    return (a, -a, 1j*b, -1j*b), stiff/length


def solve(rows, right):
    """Gaussian elimination with complex numbers."""
    n = len(rows)
    table = [list(map(complex, row)) + [complex(r)] for row, r in zip(rows, right)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(table[i][k]))
        table[k], table[pivot] = table[pivot], table[k]
        for i in range(n):
            if i != k:
                part = table[i][k]/table[k][k]
                table[i] = [x - part*y for x, y in zip(table[i], table[k])]
    return [table[k][n]/table[k][k] for k in range(n)]


def exact(hertz, force=0.0, shift=0.0, tension=0.0, length=1.0, **damping):
    """Deflection and slope at the tip, of a force there or a shift of the root."""
    w = 2*math.pi*hertz
    roots, stiff = beam(hertz, tension, length, **damping)
    at = [cmath.exp(k*length) for k in roots]
    rows = [[1]*4, list(roots), [k*k*e for k, e in zip(roots, at)],
            [-stiff*length*k**3*e + tension*k*e + 1j*w*C*e for k, e in zip(roots, at)]]
    amplitude = solve(rows, [shift, 0, 0, force])
    return (sum(a*e for a, e in zip(amplitude, at)),
            sum(a*k*e for a, k, e in zip(amplitude, roots, at)))


class HarmonicTest(ProgramTest):

    def scene(self, text):
        path = self.folder/"scene.yaml"
        path.write_text(text, encoding="utf-8")
        return path

    def curves(self, text, formulation, n):
        """name -> complex values at the frequencies."""
        record = self.record("solve", "--scene", self.scene(text), "-f", formulation, "-n", n)
        by_name = {}
        for curve in record["curves"]:
            by_name.setdefault(curve["quantity"], curve["curve_value"])
        names = {name.rsplit("_", 1)[0] for name in by_name}
        return {name: [complex(x, y) for x, y in zip(by_name[name + "_real"], by_name[name + "_imaginary"])]
                for name in names}

    def near(self, found, expected, most, message):
        for hertz, one, other in zip(FREQUENCIES, found, expected):
            self.assertLess(abs(one - other), most*abs(other), msg=(message, hertz, one, other))

    def formulations(self):
        return [f["formulation"] for f in self.record("list", "formulations")["formulations"]]

    def test_dashpot_at_the_tip(self):
        """Of a beam in bending, every formulation; velocities are those of displacements."""
        text = BEAM % ("hold: all", "", "", "", FORCED)
        expected = [exact(f, force=1) for f in FREQUENCIES]
        for formulation in self.formulations():
            found = self.curves(text, formulation, 32)
            self.near(found["u"], [u for u, _ in expected], 4e-6, formulation)
            self.near(found["t"], [t for _, t in expected], 4e-6, formulation)

    def test_shaken_base(self):
        text = BEAM % ("hold: [ux, uz, rx, ry, rz], drive: {uy: shake}",
                       "motions: {shake: {unit: m, path: [0, 1], value: [0, 0]}}", "", "", SHAKEN)
        expected = [exact(f, shift=1)[0] for f in FREQUENCIES]
        found = self.curves(text, "collocation", 24)
        self.near(found["u"], expected, 2e-6, "base")
        self.near(found["r"], [u - 1 for u in expected], 2e-6, "as seen from the base")

    def test_proportional_damping(self):
        """Of all formulations; of a base that shakes, the mass is damped by its velocity in fixed axes."""
        damping = {"by_mass": 7, "by_stiffness": 2e-3}
        keys = ", damping: {mass: 7, stiffness: 2e-3}"
        forced = BEAM % ("hold: all", "", "", keys, FORCED)
        expected = [exact(f, force=1, **damping)[0] for f in FREQUENCIES]
        for formulation in self.formulations():
            self.near(self.curves(forced, formulation, 32)["u"], expected, 4e-6, formulation)
        shaken = BEAM % ("hold: [ux, uz, rx, ry, rz], drive: {uy: shake}",
                         "motions: {shake: {unit: m, path: [0, 1], value: [0, 0]}}", "", keys, SHAKEN)
        self.near(self.curves(shaken, "collocation", 32)["u"],
                  [exact(f, shift=1, **damping)[0] for f in FREQUENCIES], 2e-6, "base")

    def test_stiffness_is_that_of_all_members_and_springs(self):
        """About a bent, stretched state and beside a spring and a foundation."""
        loads = "loads: {pull: {force: [-300, 200, 50], on: tip}}"
        with_spring = BEAM.replace("damping: [0, c", "stiffness: [0, 900, 0, 0, 0, 3], damping: [0, c")
        keys = with_spring % ("hold: all", loads, "  before: {static: {stations: [1], steps: 4}}",
                              ", about: before, damping: {stiffness: 1e-3}", FORCED)
        each = (with_spring % ("hold: all", loads, "  before: {static: {stations: [1], steps: 4}}", ", about: before", FORCED)
                ).replace("y: [0, 1, 0]}", "y: [0, 1, 0], damping: 1e-3}").replace(
                    "damping: [0, c, 0, 0, 0, 0]", "damping: [0, c + 0.9, 0, 0, 0, 3e-3]")
        self.assertNotEqual(keys, each)
        one, other = (self.curves(text, "collocation", 4)["u"] for text in (keys, each))
        self.near(one, other, 1e-12, "all")

    def test_about_a_state(self):
        """Under tension: about a static path, on which it is longer, and about a linear analysis."""
        loads = "loads: {pull: {force: [2000, 0, 0], on: tip}}"
        stretched = 1 + 2000/(210e9*0.02*0.01)
        for kind, length in (("{static: {stations: [1]}}", stretched), ("{linear: {}}", 1)):
            expected = [exact(f, force=1, tension=2000, length=length)[0] for f in FREQUENCIES]
            text = BEAM % ("hold: all", loads, f"  before: {kind}", ", about: before", FORCED)
            self.near(self.curves(text, "collocation", 24)["u"], expected, 5e-5, kind)

    def test_reciprocity(self):
        """A rotation for a force is a displacement for a moment."""
        crossed = reading("a", component="rz", force="tip", along="uy") + reading("b", component="uy", force="tip", along="rz")
        found = self.curves(BEAM % ("hold: all", "", "", "", crossed), "sheet_third", 3)
        for one, other in zip(found["a"], found["b"]):
            self.assertLess(abs(one - other), 1e-9*abs(one))

    def test_refused(self):
        held = reading("u", component="uy", force="root", along="uy")
        buckled = "loads: {push: {force: [-2000, 0, 0], on: tip}, aside: {force: [0, 0.1, 0], on: tip}}"
        spun = "  before: {static: {stations: [1], spin: {omega: [0, 0, 5]}}}"
        for text, words in (
                (BEAM % ("hold: all", "", "", "", held), "root is held or driven against the force"),
                (BEAM % ("hold: all", "", spun, ", about: before", FORCED), "axes that turn"),
                (BEAM % ("hold: all", buckled, "  before: {static: {stations: [1], steps: 4}}", ", about: before", FORCED),
                 "not_converged|unstable"),
                (BEAM.replace("5, 8, 20", "-1, 8, 20") % ("hold: all", "", "", "", FORCED), "give none below 0"),
                (BEAM.replace("5, 8, 20", "0, 8, 20") % ("hold: [uz, rx, ry]", "", "", "", FORCED), "at 0 Hz nothing holds"),
                (BEAM % ("hold: all", "", "", "", "  u: {response: {analysis: steady, node: tip, component: uy}}"),
                 "its input is not known"),
                (BEAM % ("hold: all", "", "", ", damping: {mass: -1}", FORCED), "mass = -1; give at least 0"),
                (BEAM % ("hold: all", "", "  modes: {modal: {damping: {mass: 1}}}", "", FORCED), "damping")):
            done = run("solve", "--scene", self.scene(text), "-f", "collocation", "-n", 2)
            self.assertRegex(done.stdout + done.stderr, words.replace("\n", " "))


if __name__ == "__main__":
    unittest.main()
