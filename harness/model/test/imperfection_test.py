"""Initial shapes of members compared with closed forms: magnified moments, the frequency of a shallow arch, and absence of stress.
Also tests shapes of modes and measured shifts of nodes."""
import math

from cases.format.test.scene_case import SceneCase, values
from harness.tools.kit.program import ROOT, run

FORMULATIONS = ("beamw", "beamw_consistent", "beamw_first", "beamw_vlasov", "collocation",
                "geometrically_exact", "sheet_second", "sheet_second_consistent", "sheet_third",
                "sheet_third_printed")
CURVED = ("collocation", "geometrically_exact", "sheet_second", "sheet_third")
YOUNG, I, LENGTH = 210e9, 8e-7, 3.0
CRITICAL = math.pi**2 * YOUNG * I / LENGTH**2


def column(bow, half_waves=1, axes="[0, 1, 0]", area=1e3, ends=("foot", "head"), more="",
           analyses="", hold="[uy, uz]", inertia=f"Iy: {I}, Iz: {I}"):
    return f"""beamwork: 1
sections:
  bar: {{constants: {{A: {area}, {inertia}, It: {2 * I}}}, young: {YOUNG}, shear_modulus: 81e9, density: 7850}}
nodes:
  foot: {{at: [0, 0, 0], hold: [ux, uy, uz, rx]}}
  head: {{at: [{LENGTH}, 0, 0], hold: {hold}}}
members:
  column: {{from: {ends[0]}, to: {ends[1]}, section: bar, y: {axes}, imperfection: {{amplitude: {bow}, half_waves: {half_waves}}}}}
omit: [shear]
{more}{analyses}"""


def pushed(part, where=0.5, resultant="Mz"):
    return f"""loads:
  thrust: {{force: [{-part * CRITICAL!r}, 0, 0], on: head}}
analyses:
  push: {{static: {{stations: 0..1/4}}}}
quantities:
  moment: {{internal: {{analysis: push, member: column, where: {where}, resultant: {resultant}, at: 1}}}}
"""


class ImperfectionTest(SceneCase):

    def solve(self, text, formulation, n, *more):
        return values(
            self.record("solve", "--scene", self.scene(text), "-f", formulation, "-n", n, *more))

    def test_magnified_moment(self):
        """Under the load N, a bow of amplitude a must cause the largest moment N a/(1 - N/N_k) within 2e-4, for
        bending about both axes. N_k is the buckling load with the same number of half-waves."""
        bow = 1e-5
        for half_waves, part, where in ((1, 0.5, 0.5), (2, 2.0, 0.25), (3, -3.0, 1 / 6)):
            for amplitude, resultant in ((f"[{bow}, 0]", "Mz"), (f"[0, {bow}]", "My")):
                exact = part * CRITICAL * bow / (1 - part / half_waves**2)
                for formulation in CURVED:
                    got = abs(self.solve(
                        column(amplitude, half_waves) + pushed(part, where, resultant), formulation,
                        12 * half_waves)["moment"])
                    self.assertAlmostEqual(got / abs(exact), 1, delta=2e-4,
                                           msg=(formulation, half_waves, resultant))

    def test_chords_converge(self):
        exact = 0.5 * CRITICAL * 1e-5 / 0.5
        for formulation in ("beamw", "beamw_consistent", "beamw_first", "beamw_vlasov"):
            error = [abs(abs(self.solve(column("[1e-5, 0]") + pushed(0.5), formulation, n)["moment"])
                         / exact - 1) for n in (8, 16)]
            self.assertLess(error[1], 5e-3, formulation)
            self.assertAlmostEqual(error[0] / error[1], 4, delta=0.4, msg=formulation)

    def test_no_stress(self):
        for formulation in FORMULATIONS:
            got = self.solve(
                column("[0.3, 0.2]", 3, area=1e-3) +
                "loads:\n  none: {force: [0, 0, 0], on: head}\n"
                "analyses:\n  push: {static: {stations: 0..1/2}}\n"
                "quantities:\n"
                "  ux: {displacement: {analysis: push, node: head, component: ux, at: 1}}\n"
                "  N: {internal: {analysis: push, member: column, where: 0.3, resultant: N, at: 1}}\n"
                "  M: {internal: {analysis: push, member: column, where: 0.3, resultant: Mz, at: 1}}\n",
                formulation, 12)
            for name, value in got.items():
                self.assertLess(abs(value), 1e-3 * (1e-6 if name == "ux" else 1), (formulation, name))

    def test_either_order_of_ends(self):
        for half_waves in (1, 2):
            sign = 1 if half_waves == 1 else -1
            for formulation in ("collocation", "beamw", "sheet_third"):
                text = column("[2e-3, 1e-3]", half_waves, area=1e-3)
                back = column(f"[{-sign * 2e-3}, {sign * 1e-3}]", half_waves, "[0, -1, 0]", 1e-3,
                              ("head", "foot"))
                more = ("loads:\n  push: {force: [-1000, 0, 0], on: head}\n"
                        "analyses:\n  push: {static: {stations: 0..1/2}}\n"
                        "quantities:\n"
                        "  ry: {displacement: {analysis: push, node: head, component: ry, at: 1}}\n"
                        "  rz: {displacement: {analysis: push, node: head, component: rz, at: 1}}\n")
                one, other = (self.solve(t + more, formulation, 8) for t in (text, back))
                for name in one:
                    self.assertGreater(abs(one[name]), 1e-6)
                    self.assertAlmostEqual(one[name] / other[name], 1, delta=1e-8,
                                           msg=(formulation, half_waves, name))

    def test_frequency_of_a_shallow_arch(self):
        """On fixed hinges, a shallow bow of amplitude a must have the lowest angular frequency omega within 2e-3,
        where omega^2 = pi^4 E I/(rho A L^4) (1 + A a^2/(2 I))."""
        area, bow = 1e-3, 0.02
        exact = math.sqrt(math.pi**4 * YOUNG * I / (7850 * area * LENGTH**4) *
                          (1 + area * bow**2 / (2 * I))) / (2 * math.pi)
        for formulation in CURVED:
            got = self.solve(
                column(f"[{bow}, 0]", area=area, hold="[ux, uy, uz]", inertia=f"Iy: {100 * I}, Iz: {I}") +
                "analyses:\n  modes: {modal: {}}\n"
                "quantities:\n  f: {frequency: {analysis: modes, which: 0}}\n", formulation, 16)["f"]
            self.assertAlmostEqual(got / exact, 1, delta=2e-3, msg=formulation)

    def test_mode(self):
        bow, exact = 1e-5, 0.5 * CRITICAL * 1e-5 / 0.5
        for inertia, direction, of in ((f"Iy: {100 * I}, Iz: {I}", "", "{buckling: {}}"),
                                       (f"Iy: {I}, Iz: {I}", ", direction: [0, 1, 0]", "{buckling: {}}"),
                                       (f"Iy: {100 * I}, Iz: {I}", ", direction: [0, -1, 0]", "{modal: {}}")):
            text = column("[0, 0]", inertia=inertia, area=1e3).replace(
                "omit:", f"imperfections: {{crook: {{mode_of: shape, amplitude: {bow}{direction}}}}}\nomit:") + pushed(
                    0.5).replace("analyses:\n", f"analyses:\n  shape: {of}\n")
            if "buckling" in of:
                text += "  critical: {critical_factor: {analysis: shape}}\n"
            for formulation in FORMULATIONS:
                got = self.solve(text, formulation, 16)
                bound = 4e-4 if formulation in CURVED else 0.02 if formulation == "beamw_first" else 3e-3
                self.assertAlmostEqual(abs(got["moment"]) / exact, 1, delta=bound, msg=(formulation, of))
                self.assertEqual(got["moment"] < 0, "-1" not in direction, (formulation, direction))
                if "critical" in got and formulation != "beamw_first":
                    self.assertAlmostEqual(got["critical"], 2, delta=1e-5, msg=formulation)

    def test_mode_of_a_twisted_beam(self):
        path = ROOT / "cases/examples/crooked_beam.yaml"
        for formulation in FORMULATIONS:
            error = [values(self.record("solve", "--scene", path, "-f", formulation, "-n", n))["moved"] / 1e-4 - 1
                     for n in (16, 32)]
            self.assertLess(abs(error[1]), 6e-4, formulation)
            self.assertAlmostEqual(error[0] / error[1], 4, delta=0.2, msg=formulation)

    FRAME = """beamwork: 1
sections:
  bar: {constants: {A: 1e-3, Iy: 1e-7, Iz: 1e-7, It: 2e-8}, young: 210e9, shear_modulus: 81e9, density: 7850}
nodes:
  foot: {at: [0, 0, 0], hold: all}
  knee: {at: [0, 2, 0]NODE}
  arm: {at: [0.3, 2.2, 0.1], part_of: knee}
  top: {at: [2, 2.3, 0.1]}
  end: {at: [2, 0, 0.5], hold: all}
  MORE
members:
  c1: {from: foot, to: LEFT, section: bar, y: [1, 0, 0]}
  beam: {from: arm, to: top, section: bar, y: [0, 1, 0]}
  c2: {from: RIGHT, to: end, section: bar, y: [1, 0, 0], release: {to: [rz]}}
imperfections: {crook: {mode_of: buckle, amplitude: 1e-4}}
loads:
  a: {force: [0, -500, 0], on: knee}
  b: {force: [0, -1000, 0], on: top}
analyses:
  push: {static: {stations: [1]}}
  shake: {motion: {about: push, stations: [0.01], step: 0.001}}
  tones: {modal: {about: push}}
  buckle: {buckling: {}}
quantities:
  ux: {displacement: {analysis: push, node: top, component: ux}}
  uz: {displacement: {analysis: push, node: arm, component: uz}}
  later: {displacement: {analysis: shake, node: arm, component: uz}}
  f: {frequency: {analysis: tones}}
  critical: {critical_factor: {analysis: buckle}}
omit: [shear]
"""

    def test_mode_of_a_frame(self):
        offsets = self.FRAME.replace("NODE", "").replace("MORE", "").replace(
            "to: LEFT,", "to: knee, offset: {to: [0, -0.2, 0]},").replace(
                "from: RIGHT,", "from: top, offset: {from: [0.1, -0.1, 0]},")
        bodies = self.FRAME.replace("NODE", "").replace("MORE", "low: {at: [0, 1.8, 0], part_of: knee}\n"
                                                        "  side: {at: [2.1, 2.2, 0.1], part_of: top}").replace(
                                                            "LEFT", "low").replace("RIGHT", "side")
        perfect = offsets.replace("amplitude: 1e-4", "amplitude: 0")
        for formulation in ("collocation", "beamw", "geometrically_exact", "sheet_third"):
            one, two, none = (self.solve(t, formulation, 4) for t in (offsets, bodies, perfect))
            self.assertEqual(one["critical"], none["critical"])
            for name in ("ux", "uz", "later", "f"):
                change = one[name] - none[name]
                self.assertGreater(abs(change), 1e-7 * abs(one[name]), (formulation, name))
                self.assertAlmostEqual((two[name] - none[name]) / change, 1, delta=1e-4, msg=(formulation, name))
            self.assertAlmostEqual(one["later"] / one["uz"], 1, delta=1e-6)

    def test_shifts(self):
        text = self.FRAME.replace("NODE", ", mass: 5").replace("MORE", "").replace("LEFT", "knee").replace(
            "RIGHT", "top")
        shifted = text.replace("{mode_of: buckle, amplitude: 1e-4}",
                               "{shifts: {knee: [0.005, 0, -0.0025], top: [0, 0.01, 0]}, factor: 2}")
        there = text.replace("imperfections: {crook: {mode_of: buckle, amplitude: 1e-4}}", "").replace(
            "knee: {at: [0, 2, 0]", "knee: {at: [0.01, 2, -0.005]").replace("[2, 2.3, 0.1]", "[2, 2.32, 0.1]")
        (self.folder / "survey.csv").write_text("# measured\nno;node;dz;dx;dy\n1;top;0;0;0.01\n"
                                                "2;knee;-0.0025;0.005;0\n", encoding="utf-8")
        filed = shifted.replace("{knee: [0.005, 0, -0.0025], top: [0, 0.01, 0]}", "{file: survey.csv}")
        for formulation in FORMULATIONS:
            one, two, three = (self.solve(t, formulation, 2) for t in (shifted, there, filed))
            for name in two:
                self.assertAlmostEqual(one[name] / two[name], 1, delta=1e-9, msg=(formulation, name))
                self.assertEqual(one[name], three[name])
        for bad, words in (("no;node;dx;dy", "survey.csv:1: no column 'dz'"),
                           ("node;dx;dy;dz\ntop;0;0;x", "survey.csv:2: 'x' is not a number"),
                           ("node;dx;dy;dz\n", "no rows"), ("node;dx;dy;dz\nnone;0;0;1", "no node 'none'"),
                           ("node;dx;dy;dz\ntop;0;0;1\ntop;0;0;1", "node top is shifted twice")):
            (self.folder / "survey.csv").write_text(bad + "\n", encoding="utf-8")
            self.refused(2, words, "solve", "--scene", self.scene(filed), "-n", 1)

    def test_shifted_lengths(self):
        def bar(at, length, shift):
            return f"""beamwork: 1
sections: {{bar: {{rectangle: {{width: 20e-3, thickness: 10e-3}}, young: 200e9, shear_modulus: 77e9}}}}
nodes: {{g: {{at: [0, 0, 0], hold: all}}, a: {{at: [{at}, 0, 0], hold: all}}}}
members: {{m: {{from: g, to: a, section: bar, y: [0, 1, 0], unstressed_length: {length}}}}}
imperfections: {{s: {{shifts: {{a: [{shift}, 0, 0]}}}}}}
analyses: {{li: {{linear: {{}}}}}}
quantities: {{N: {{internal: {{analysis: li, member: m, end: from, resultant: N}}}}}}
"""
        for formulation in FORMULATIONS:
            N = self.solve(bar(1, 0.979, -0.02), formulation, 2)["N"]
            self.assertAlmostEqual(N / (200e9 * 2e-4 * 0.001 / 0.98), 1, delta=1e-9, msg=formulation)
        done = run("solve", "--scene", self.scene(bar(1, 0.999, -0.02)), "-f", "collocation", "-n", 1)
        self.assertEqual(done.returncode, 2)
        self.assertIn("differs by more than 1 % from the drawn length with imperfections, 0.98 m",
                      " ".join((done.stdout + done.stderr).split()))

    def test_modes_refused(self):
        for shape, words in (("mode_of: shape, amplitude: 1e-3", "is one of 2 modes with the same value; give its direction"),
                             ("mode_of: shape, amplitude: 1e-3, direction: [0, 1, 1], which: 999", "there is no mode 999"),
                             ("mode_of: shape, amplitude: 1e-3, direction: [1, 0, 0]", "direction")):
            text = column("[0, 0]").replace("omit:", f"imperfections: {{crook: {{{shape}}}}}\nomit:") + pushed(
                0.5).replace("analyses:\n", "analyses:\n  shape: {buckling: {}}\n")
            done = run("solve", "--scene", self.scene(text), "-f", "collocation", "-n", 4)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(words, done.stdout + done.stderr)
        self.refused(2, "an imperfection cannot be written as solids", "export", "--scene", self.scene(text),
                     "--to", "calculix", "-o", self.folder / "deck")

    def test_refused(self):
        self.refused(2, ["member column", "half_waves: 2", "at least 4"], "solve", "--scene",
                     self.scene(column("[1e-3, 0]", 2) + pushed(0.5)), "-n", 3)
        self.refused(2, "half_waves = 0", "scene", "--scene",
                     self.scene(column("[1e-3, 0]", 0) + pushed(0.5)))
        self.refused(2, "imperfection leaves the plane", "scene", "--scene",
                     self.scene(column("[0, 1e-3]") + "plane: xy\n" + pushed(0.5)))
        self.refused(2, "amplitude", "scene", "--scene",
                     self.scene(column("[1e-3]") + pushed(0.5)))
        self.refused(2, "direction = [0, 0, 0]; give a nonzero vector, or remove the key", "scene", "--scene",
                     self.scene(self.FRAME.replace("NODE", "").replace("MORE", "").replace("LEFT", "knee").replace("RIGHT", "top")
                                .replace("1e-4}}", "1e-4, direction: [0, 0, 0]}}")))

    def test_usual_meshes_show_it(self):
        written = self.answered("scene", "--scene",
                                self.scene(column("[1e-3, 0]", 3) + pushed(0.5))).stdout
        self.assertIn("meshes: [6, 12, 24, 48]", written)

    def test_on_a_foundation(self):
        def founded(bow, tip=(LENGTH, 0, 0), y=(0, 1, 0)):
            return f"""beamwork: 1
sections:
  bar: {{constants: {{A: 1e-3, Iy: {I}, Iz: {2 * I}, It: {2 * I}}}, young: {YOUNG}, shear_modulus: 81e9, density: 7850}}
nodes:
  foot: {{at: [0, 0, 0], hold: all}}
  head: {{at: {list(tip)}, mass: 5}}
members:
  column: {{from: foot, to: head, section: bar, y: {list(y)}, foundation: {{translation: [0, 2e5, 1e5]}}{bow}}}
omit: [shear]
analyses: {{tones: {{modal: {{}}}}}}
quantities: {{f: {{frequency: {{analysis: tones}}}}}}
"""
        turned = [(0.36, 0.48, -0.8), (0.8, -0.6, 0)]
        for formulation in ("collocation", "beamw", "sheet_third", "geometrically_exact"):
            for n in (4, 8):
                straight = self.solve(founded(""), formulation, n)["f"]
                for bow, bound in ((1e-9, 1e-9), (1e-3, 1e-3)):
                    text = f", imperfection: {{amplitude: [0, {bow}]}}"
                    here = self.solve(founded(text), formulation, n)["f"]
                    there = self.solve(
                        founded(text, [LENGTH * x for x in turned[0]], turned[1]), formulation, n)["f"]
                    self.assertAlmostEqual(here / straight, 1, delta=bound, msg=(formulation, n, bow))
                    self.assertAlmostEqual(there / here, 1, delta=1e-9, msg=(formulation, n, bow))
