"""Scenes as a new user writes them, without options for physics, compared with closed forms: torsional buckling,
unsymmetric sections, the effect of tension and rotation on torsion, and rotary inertia. Also tests messages on
omitted physics and on the shear theory."""
import math
import unittest

from cases.format.test.scene_case import SceneCase, values

MATERIAL = "young: 210e9, shear_modulus: 81e9, density: 7850"
E, G, RHO = 210e9, 81e9, 7850

COLUMN = """\
beamwork: 1
sections:
  bar: {{{section}, {material}}}
nodes:
  a: {{at: [0, 0, 0], hold: [ux, uy, uz, rx]}}
  b: {{at: [{length}, 0, 0], hold: [uy, uz, rx]}}
members:
  bar: {{from: a, to: b, section: bar, y: [0, 1, 0]}}
loads:
{loads}
analyses:
  b: {{buckling: {{wanted: 6}}}}
quantities:
  up:   {{critical_factor: {{analysis: b, which: 0}}, unit: "1"}}
  down: {{critical_factor: {{analysis: b, which: 0, sign: negative}}, unit: "1"}}
"""
PUSH = "  push: {force: [-1, 0, 0], on: b}"

BAR = """\
beamwork: 1
sections:
  bar: {{rectangle: {{width: {width}, thickness: {thickness}}}, {material}, given: {{Iw: 0}}}}
nodes:
  a: {{at: [0, 0, 0], hold: all}}
  b: {{at: [{length}, 0, 0]}}
members:
  bar: {{from: a, to: b, section: bar, y: [0, 1, 0]}}
{rest}
"""


def walls(points, lines, thickness):
    names = dict(zip("abcdefgh", points))
    return (f"points: {{{', '.join(f'{n}: [{y}, {z}]' for n, (y, z) in names.items())}}}, walls: ["
            + ", ".join(f"{{from: {one}, to: {two}, thickness: {thickness}}}"
                        for one, two in lines) + "]")


def flexural_torsional(A, I_across, I_along, It, away, length):
    """Returns the lowest critical load [N] of a fork-ended column whose section is symmetric about one axis and does
    not warp. I_across is the second moment of area for the bending that couples with the twist. They couple because
    the shear centre is not at the centroid."""
    euler, weak = (math.pi ** 2 * E * I / length ** 2 for I in (I_across, I_along))
    r2 = (I_across + I_along) / A + away ** 2
    twist, beta = G * It / r2, 1 - away ** 2 / r2
    both = (euler + twist - math.sqrt((euler + twist) ** 2 - 4 * beta * euler * twist)) / (2 * beta)
    return min(weak, both)


class PhysicsTest(SceneCase):

    def solved(self, text, *arguments):
        return values(self.record("solve", "--scene", self.scene(text), *arguments))

    def column(self, section, length=2.0, loads=PUSH, more="", material=MATERIAL, **where):
        return self.solved(
            COLUMN.format(section=section, length=length, loads=loads, material=material) + more,
            "-n", 64, **where)

    def near(self, value, exact, part):
        self.assertLess(abs(value / exact - 1), part, (value, exact))

    def test_cruciform_twists(self):
        section = "constants: {A: 1.6e-3, Iy: 8e-6/3, Iz: 8e-6/3, It: 2.56e-8/3}"
        found = self.column(section, 1.0, material="young: 208e9, shear_modulus: 80e9")
        self.near(found["up"], 204800, 1e-9)
        legs = walls([(0, 0), (0.1, 0), (-0.1, 0), (0, 0.1), (0, -0.1)],
                     ("ab", "ac", "ad", "ae"), 4e-3)
        self.near(self.column(legs, 1.0, material="young: 208e9, shear_modulus: 80e9")["up"],
                  204800, 1e-6)

    def test_channel_as_the_case(self):
        section = "channel: {depth: 98e-3, flange: 49e-3, flange_thickness: 2e-3, web_thickness: 2e-3}"
        sizes = ("length=2", "height=0.098", "width=0.049", "flange_thickness=2e-3",
                 "web_thickness=2e-3", "young=210e9", "shear_modulus=81e9", "density=7850")
        sizes = [word for size in sizes for word in ("--set", size)]
        for theory in ("haringx", "engesser"):
            case = values(self.record("solve", "c_column", "-f", "beamw_consistent", "-n", 16,
                                      *sizes, "--set", f"shear_stability={theory}"))
            own = self.solved(
                COLUMN.format(section=section, length=2, loads=PUSH, material=MATERIAL) +
                f"shear_theory: {theory}\n", "-f", "beamw_consistent", "-n", 16)
            self.near(own["up"], case["buckling_load"], 1e-12)
        self.near(self.column(section)["up"], 43467, 2e-4)
        self.near(self.column(section, more="omit: [shear]\n")["up"], 43535, 1e-3)

    def test_kinds(self):
        for section, kind in (("rectangle: {width: 0.02, thickness: 0.03}", "flexural"),
                              ("tube: {diameter: 0.04, thickness: 2e-3}", "flexural, double"),
                              ("constants: {A: 1.6e-3, Iy: 3e-6, Iz: 4e-6, It: 8e-9, Iw: 1e-12}", "torsional"),
                              ("channel: {depth: 98e-3, flange: 49e-3, flange_thickness: 2e-3, web_thickness: 2e-3}",
                               "flexural-torsional")):
            text = COLUMN.format(section=section, length=2, loads=PUSH, material=MATERIAL)
            text += '  next: {critical_factor: {analysis: b, which: 1}, unit: "1"}\n'
            for formulation in ("beamw_consistent", "collocation", "geometrically_exact"):
                found = self.record("solve", "--scene", self.scene(text), "-f", formulation, "-n", 8)["quantities"]
                self.assertEqual(found[0]["meaning"], kind, f"{section}, {formulation}")

    def test_angle_and_tee_twist(self):
        for leg, thickness, length in ((0.1, 8e-3, 2.0), (0.06, 3e-3, 1.0), (0.05, 5e-3, 3.0)):
            A, I = 2 * leg * thickness, thickness * leg ** 3
            exact = flexural_torsional(A, I / 3, I / 12, A * thickness ** 2 / 3,
                                       leg / math.sqrt(8), length)
            angle = walls([(leg, 0), (0, 0), (0, leg)], ("ab", "bc"), thickness)
            self.near(self.column(angle, length, more="omit: [shear]\n")["up"], exact, 5e-5)
            self.near(self.column(angle, length)["up"], exact, 1e-2)
            A, centre = 2 * leg * thickness, leg / 4
            along = thickness * leg ** 3 / 12  # second moment of area of the flange alone, for bending perpendicular to the stem
            across = along + thickness * leg * (centre ** 2 + (leg / 2 - centre) ** 2)
            tee = walls([(-leg / 2, 0), (0, 0), (leg / 2, 0), (0, leg)], ("ab", "bc", "bd"),
                        thickness)
            # the twist couples with bending along the flange, whose stiffness is that of the flange
            exact = flexural_torsional(A, along, across, A * thickness ** 2 / 3, centre, length)
            self.near(self.column(tee, length, more="omit: [shear]\n")["up"], exact, 5e-5)
            self.near(self.column(tee, length)["up"], exact, 1e-2)

    def test_unequal_flanges_under_a_moment(self):
        text = walls([(-0.1, -0.15), (0, -0.15), (0.1, -0.15), (-0.05, 0.15), (0, 0.15),
                      (0.05, 0.15)], ("ab", "bc", "be", "de", "ef"), 0.012).replace(
                          "{from: b, to: e, thickness: 0.012}", "{from: b, to: e, thickness: 0.008}")
        moments = "  a: {moment: [0, -1, 0], on: a}\n  b: {moment: [0, 1, 0], on: b}"
        found = self.column(text, 6.0, moments)
        self.near(found["up"], 177150, 5e-4)
        self.near(found["down"], -66540, 5e-4)
        without = self.column(text, 6.0, moments, "omit: wagner_moments\n")
        self.assertGreater(abs(without["up"] / 177150 - 1), 0.05)

    def test_twisted_leaf(self):
        """A leaf with the twist rate w' that is free to shorten must have the moment M = G It w' + E/2 w'^3 (int r^4
        - Ip^2/A), and shorten by w'^2 L Ip/2A."""
        text = BAR.format(
            width=50e-3, thickness=0.5e-3, length=0.1, material=MATERIAL,
            rest="motions:\n  twist: {unit: rad, path: [0, 1], value: [0, 0.2]}\nanalyses:\n"
            "  st: {static: {stations: [1]}}\nquantities:\n"
            "  M:  {reaction: {analysis: st, node: b, component: rx}, unit: N m}\n"
            "  ux: {displacement: {analysis: st, node: b, component: ux}, unit: m}").replace(
                "0.1, 0, 0]", "0.1, 0, 0], hold: [uy, uz, ry, rz], drive: {rx: twist}")
        found = self.solved(text)
        self.near(found["M"], 1.06454, 1e-5)
        self.near(found["ux"], -41.6708333e-6, 1e-7)
        plain = self.solved(text + "omit: [trapeze, wagner_torque]\n")
        self.near(plain["M"], 0.335373, 1e-5)
        self.assertLess(abs(plain["ux"]), 1e-15)

    def test_twisted_walls(self):
        """Walls with the twist rate w' that are free to shorten, bend and warp must have the moment M = G It w' + 4
        E c w'^3 with 8 c = int q^2 dA, where q is r^2 without its components along 1, y and z."""
        import numpy as np
        t, rate = 1e-3, 0.1
        for points, lines in (
            ([(0, 0), (0.1, 0), (-0.1, 0), (0, 0.1), (0, -0.1)], ("ab", "ac", "ad", "ae")),
            ([(-0.04, 0.1), (0, 0.1), (0.04, 0.1), (-0.02, -0.1), (0, -0.1), (0.02, -0.1)],
             ("ab", "bc", "be", "de", "ef")),
            ([(0.05, 0.1), (0, 0.1), (0, -0.1), (0.05, -0.1)], ("ab", "bc", "cd")),
            ([(0.12, 0), (0, 0), (0, 0.07)], ("ab", "bc")),
            ([(-0.06, 0), (0, 0), (0.06, 0), (0, 0.1)], ("ab", "bc", "bd"))):
            fibre, weight = [], []
            for one, two in lines:
                p, q = (np.array(points["abcdef".index(end)]) for end in (one, two))
                for x, w in zip(*np.polynomial.legendre.leggauss(5)):
                    fibre.append(p + (q - p) * (1 + x) / 2)
                    weight.append(w / 2 * math.dist(p, q) * t)
            y, z = np.array(fibre).T
            root, r2 = np.sqrt(weight), y * y + z * z
            _, left, _, _ = np.linalg.lstsq(
                np.array([np.ones_like(y), y, z]).T * root[:, None], r2 * root, rcond=None)
            exact = G * sum(weight) * t * t / 3 * rate + E * left[0] / 2 * rate ** 3
            text = BAR.format(
                width=1, thickness=1, length=1, material=MATERIAL,
                rest="loads:\n  turn: {moment: [%.17g, 0, 0], on: b}\nanalyses:\n  st: {static: {stations: [1]}}\n"
                "quantities:\n  turn: {displacement: {analysis: st, node: b, component: rx}, unit: rad}" % exact)
            text = text.replace("rectangle: {width: 1, thickness: 1}", walls(points, lines, t)).replace(
                ", given: {Iw: 0}", "").replace("y: [0, 1, 0]", "y: [0, 1, 0], warping: free")
            for formulation in ("collocation", "geometrically_exact"):
                self.near(self.solved(text, "-f", formulation)["turn"], rate, 1e-3)
            plain = self.solved(text + "omit: wagner_torque\n")["turn"]
            self.assertGreater(plain / rate, 1.02, points)

    def test_torsion_under_tension(self):
        b, t, length, torque = 60e-3, 2e-3, 0.5, 1e-4
        A, Ip = b * t, b * t * (b * b + t * t) / 12
        It = b * t ** 3 / 3 * (1 - 192 / math.pi ** 5 * t / b * math.tanh(math.pi * b / 2 / t) *
                               31 / 32 * 1.0369277551433699)
        for pull in (0, 20e3, -50):
            text = BAR.format(
                width=b, thickness=t, length=length, material=MATERIAL,
                rest=f"loads:\n  pull: {{force: [{pull}, 0, 0], on: b}}\n"
                "%s\nanalyses:\n  st: {static: {stations: [1]}}\n%s\nquantities:\n  wanted: {%s}")
            stiff = G * It + pull * Ip / A
            turned = self.solved(text % (f"  turn: {{moment: [{torque}, 0, 0], on: b}}", "",
                                         "displacement: {analysis: st, node: b, component: rx}, unit: rad"), "-n", 8)
            self.near(turned["wanted"], torque * length / stiff, 2e-3)
            swings = self.solved(text % ("", "  v: {modal: {about: st, wanted: 12}}",
                                         "frequency: {analysis: v, which: 0, family: torsion}, unit: Hz"), "-n", 32)
            self.near(swings["wanted"], math.sqrt(stiff / (RHO * Ip)) / (4 * length), 3e-3)

    def test_strip_that_rotates(self):
        b, t, length, speed = 40e-3, 1e-3, 0.4, 300.0
        I1, I2, terms = t * b ** 3 / 12, b * t ** 3 / 12, 5
        Ip, It = I1 + I2, b * t ** 3 / 3 * (1 - 0.63025 * t / b)
        import numpy as np
        K, M = np.zeros((terms, terms)), np.zeros((terms, terms))
        for i in range(terms):
            for j in range(terms):
                p, q = 2 * i + 1, 2 * j + 1
                s = p + q - 1  # int w_p' w_q' dx = p q/s and int x^2 w_p' w_q' dx = p q/(s + 2), with x from 0 to 1
                K[i, j] = G * It / length ** 2 * p * q / s + RHO * Ip * speed ** 2 / 2 * p * q * (
                    1 / s - 1 / (s + 2)) + RHO * (I1 - I2) * speed ** 2 / (p + q + 1)
                M[i, j] = RHO * Ip / (p + q + 1)
        exact = math.sqrt(min(np.linalg.eigvals(np.linalg.solve(M, K)).real)) / (2 * math.pi)
        text = BAR.format(
            width=b, thickness=t, length=length, material=MATERIAL,
            rest=f"analyses:\n  r: {{rotation: {{omega: [0, {speed}, 0], stations: [1], wanted: 8}}}}\n"
            "quantities:\n  f: {frequency: {analysis: r, which: 0, family: torsion}, unit: Hz}")
        self.near(self.solved(text, "-n", 32)["f"], exact, 3e-3)

    def test_rotary_inertia(self):
        text = BAR.format(width=50e-3, thickness=30e-3, length=1, material=MATERIAL,
                          rest="analyses:\n  v: {modal: {wanted: 8}}\nquantities:\n"
                          "  f: {frequency: {analysis: v, which: 2, family: bending_y}, unit: Hz}")
        text = text.replace("7850", "7800, shear_factor: 5/6").replace(
            "hold: all", "hold: [ux, uy, uz, rx, ry]").replace(
                "at: [1, 0, 0]", "at: [1, 0, 0], hold: [uy, uz, rx, ry]")
        self.near(self.solved(text, "-n", 64)["f"], 626.78, 5e-5)
        self.near(self.solved(text + "omit: rotary_inertia\n", "-n", 64)["f"], 628.78, 5e-5)

    def test_words(self):
        square = "rectangle: {width: 0.1, thickness: 0.1}"
        text = COLUMN.format(section=square, length=1, loads=PUSH, material=MATERIAL)
        self.assertNotIn("omitted", self.answered("solve", "--scene", self.scene(text)).stdout)
        for words, told in (("all", "shear, trapeze, warping"), ("[wagner_moments]", None),
                            ("[trapeze, shear]", "shear, trapeze"), ("none", None)):
            scene = self.scene(text + f"omit: {words}\n")
            for verb in (("solve", "-n", 2), ("converge", "-n", 2, "-f", "collocation")):
                lines = self.answered(verb[0], "--scene", scene, *verb[1:]).stdout.splitlines()
                self.assertEqual([line for line in lines if line.startswith("omitted")],
                                 [f"omitted: {told}"] if told else [], words)
            record = self.record("solve", "--scene", scene, "-n", 2)
            self.assertEqual(record["omitted"], told.split(", ") if told else [])
        for theory, told in (("haringx", ["Haringx", "Haringx"]), ("engesser", ["Haringx", "Engesser"])):
            scene = self.scene(text + f"shear_theory: {theory}\n")
            lines = [self.answered("solve", "--scene", scene, "-n", 2, "-f", name).stdout.splitlines()
                     for name in ("collocation", "beamw_consistent")]
            self.assertEqual([[line for line in one if line.startswith("shear in stability")]
                              for one in lines], [[f"shear in stability: {word}"] for word in told])
            record = self.record("solve", "--scene", scene, "-n", 2, "-f", "beamw_consistent")
            self.assertEqual(record["shear_theory"], told[1])
        self.assertNotIn("shear in stability", self.answered(
            "solve", "--scene", self.scene(text + "omit: shear\n")).stdout)


GUIDE = """\
beamwork: 1
units: mm, N, MPa
sections:
  leaf: {{rectangle: {{width: 50, thickness: 0.5}}, young: 210e3, shear_modulus: 81e3, density: 7.85e-9}}
nodes:
  stage:   {{at: [25, 100, 0], drive: {{ux: travel}}, mass: 0.5{inertia}}}
  base_$i: {{for: {{i: 0..1}}, at: [i*50, 0, 0], hold: all}}
  end_$i:  {{for: {{i: 0..1}}, at: [i*50, 100, 0], part_of: stage{more}}}
members:
  leaf_$i: {{for: {{i: 0..1}}, from: base_$i, to: end_$i, section: leaf, y: [1, 0, 0], warping: fixed}}
motions:
  travel: {{unit: mm, path: [0, 1], value: [0, 10]}}
{rest}
"""
MODAL = "analyses: {v: {modal: {}}}\nquantities: {f: {frequency: {analysis: v, which: 0}}}"


class MassesTest(SceneCase):

    def said(self, **changes):
        text = GUIDE.format(**{"inertia": "", "more": "", "rest": MODAL} | changes)
        printed = self.answered("solve", "--scene", self.scene(text), "-f", "collocation", "-n", 1).stdout
        return [line for line in printed.splitlines() if line.startswith(("mass: ", "held by "))]

    def test_body_in_tonnes_shows(self):
        self.assertEqual(self.said(), ["mass: bodies 500 kg, members 0.03925 kg; no moment of inertia: stage",
                                       "held by drives (modal): stage ux"])

    def test_inertia_or_masses_aside_need_no_remark(self):
        whole = "mass: bodies {} kg, members 0.03925 kg"
        self.assertEqual(self.said(inertia=", inertia: [1, 1, 1, 0, 0, 0]")[0], whole.format(500))
        self.assertEqual(self.said(more=", mass: 0.1")[0], whole.format(700))

    def test_statics_use_no_mass_but_weight(self):
        statics = ("analyses: {s: {static: {stations: [1]}}}\n"
                   "quantities: {r: {reaction: {analysis: s, node: stage, component: ux}}}")
        self.assertEqual(self.said(rest=statics), [])
        self.assertEqual(self.said(rest="loads: {g: {gravity: [0, -9810, 0], on: all}}\n" + statics),
                         ["mass: bodies 500 kg, members 0.03925 kg"])

    def test_input_of_a_response_moves(self):
        swept = ("analyses: {h: {harmonic: {frequencies: [10]}}}\nquantities: {t: {response: {analysis: h, node: stage, "
                 "component: uy, drive: travel, at: 10}}}")
        self.assertEqual([line for line in self.said(rest=swept) if "held" in line], [])


if __name__ == "__main__":
    unittest.main()
