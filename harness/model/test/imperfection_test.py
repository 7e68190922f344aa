"""Initial shapes of members against closed forms: moments that they magnify, frequencies of a shallow arch, no stress."""
import math

from cases.format.test.scene_case import SceneCase, values

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
        """N a/(1 - N/N_k) with the buckling load of as many half waves, about both axes."""
        bow = 1e-5
        for half_waves, part, where in ((1, 0.5, 0.5), (2, 2.0, 0.25), (3, -3.0, 1 / 6)):
            for amplitude, resultant in ((f"[{bow}, 0]", "Mz"), (f"[0, {bow}]", "My")):
                exact = part * CRITICAL * bow / (1 - part / half_waves**2)
                for formulation in CURVED:
                    got = abs(self.solve(
                        column(amplitude, half_waves) + pushed(part, where, resultant), formulation,
                        12 * half_waves)["moment"])
                    # a path beyond the first buckling load has steps that see no instability of symmetry
                    self.assertAlmostEqual(got / abs(exact), 1, delta=2e-4,
                                           msg=(formulation, half_waves, resultant))

    def test_chords_converge(self):
        """Formulations without initial curvature take chords: order 2."""
        exact = 0.5 * CRITICAL * 1e-5 / 0.5
        for formulation in ("beamw", "beamw_consistent", "beamw_first", "beamw_vlasov"):
            error = [abs(abs(self.solve(column("[1e-5, 0]") + pushed(0.5), formulation, n)["moment"])
                         / exact - 1) for n in (8, 16)]
            self.assertLess(error[1], 5e-3, formulation)
            self.assertAlmostEqual(error[0] / error[1], 4, delta=0.4, msg=formulation)

    def test_no_stress(self):
        """Without loads nothing moves and nothing is stressed, however large the bow."""
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
        """A bow is the same when its ends are exchanged: y turns round, and with it its part there;
        an even number of half waves begins on the other side."""
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
        """Between hinges that stay: omega^2 = pi^4 E I/(rho A L^4) (1 + A a^2/(2 I)), slopes small."""
        area, bow = 1e-3, 0.02
        exact = math.sqrt(math.pi**4 * YOUNG * I / (7850 * area * LENGTH**4) *
                          (1 + area * bow**2 / (2 * I))) / (2 * math.pi)
        for formulation in CURVED:
            got = self.solve(
                column(f"[{bow}, 0]", area=area, hold="[ux, uy, uz]", inertia=f"Iy: {100 * I}, Iz: {I}") +
                "analyses:\n  modes: {modal: {}}\n"
                "quantities:\n  f: {frequency: {analysis: modes, which: 0}}\n", formulation, 16)["f"]
            self.assertAlmostEqual(got / exact, 1, delta=2e-3, msg=formulation)

    def test_refused(self):
        self.refused(2, ["member column", "2 half waves", "at least 4"], "solve", "--scene",
                     self.scene(column("[1e-3, 0]", 2) + pushed(0.5)), "-n", 3)
        self.refused(2, "half_waves = 0", "scene", "--scene",
                     self.scene(column("[1e-3, 0]", 0) + pushed(0.5)))
        self.refused(2, "imperfection leaves the plane", "scene", "--scene",
                     self.scene(column("[0, 1e-3]") + "plane: xy\n" + pushed(0.5)))
        self.refused(2, "amplitude", "scene", "--scene",
                     self.scene(column("[1e-3]") + pushed(0.5)))

    def test_usual_meshes_show_it(self):
        written = self.answered("scene", "--scene",
                                self.scene(column("[1e-3, 0]", 3) + pushed(0.5))).stdout
        self.assertIn("meshes: [6, 12, 24, 48]", written)

    def test_on_a_foundation(self):
        """Springs of the foundation have the weights of a straight member, wherever the bow lies in
        space: a bow of nothing changes nothing, and rounding of its elements' lengths does not matter."""
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
        turned = [(0.36, 0.48, -0.8), (0.8, -0.6, 0)]  # x and y axes of a turned scene
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
