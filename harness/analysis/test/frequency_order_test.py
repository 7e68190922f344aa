"""Frequencies of straight members without stress against closed forms: bending with shear and
rotary inertia, stretch, torsion, restrained warping, with bodies and springs at the ends."""
import math
import unittest

from harness.tools.kit.program import ProgramTest

E, NU, RHO, LENGTH = 2e11, 0.25, 8000.0, 1.0
G = E / 2 / (1 + NU)
ALL = ("collocation", "beamw", "beamw_vlasov", "beamw_first", "beamw_consistent", "sheet_second",
       "sheet_second_consistent", "sheet_third", "geometrically_exact",
       "geometrically_exact:nodes=2")
SHEARED = ("collocation", "beamw", "beamw_first", "beamw_consistent", "sheet_second_consistent",
           "geometrically_exact", "geometrically_exact:nodes=2")
WARPING = ("collocation", "beamw_consistent", "beamw_consistent:torsion=hyperbolic",
           "geometrically_exact", "geometrically_exact:nodes=2")
FEW = ("collocation", "beamw_consistent", "geometrically_exact")
SCENE = """beamwork: 1
sections:
  bar: {constants: {%(constants)s}, young: %(young)r, shear_modulus: %(shear)r, density: %(density)r}
nodes:
  a: {at: [0, 0, 0]%(a)s}
  b: {at: [1, 0, 0]%(b)s}
members:
  bar: {from: a, to: b, section: bar, y: [0, 1, 0]}
%(more)sanalyses:
  v: {modal: {wanted: 24}}
quantities:
  f_$n: {for: {n: 1..24}, frequency: {analysis: v, which: n - 1}, unit: Hz}
omit: [%(omit)s]
"""
SECTION = {"A": 4e-4, "Iy": 3e-8, "Iz": 1.3e-8, "It": 2e-8, "Iw": 0}
NO_SHEAR = "shear, trapeze, wagner_moments, wagner_torque, rotary_inertia"
WITH_SHEAR = "trapeze, wagner_moments, wagner_torque"


def root(function, low, high):
    """Of a function that changes its sign once between the two."""
    sign = function(low) > 0
    for _ in range(200):
        middle = (low + high) / 2
        if (function(middle) > 0) == sign:
            low = middle
        else:
            high = middle
    return (low + high) / 2


def timoshenko(section, wave, upper=False):
    """[Hz] Hinged: deflection and rotation are sine and cosine of wave x (2 x 2 problem)."""
    area, inertia, shear = section["A"], section["Iz"], G / section["F"][0]
    k11, k12, k22 = shear * wave**2, -shear * wave, shear + E * inertia * wave**2
    m1, m2 = RHO * area, RHO * inertia
    a, b, c = m1 * m2, -(k11 * m2 + k22 * m1), k11 * k22 - k12**2
    root_of = math.sqrt(b * b - 4 * a * c)
    square = (-b + root_of) / (2 * a) if upper else 2 * c / (-b + root_of)
    return math.sqrt(square) / (2 * math.pi)


def warped(section):
    """[Hz] First torsion of a cantilever whose root does not warp."""
    EIw, GIt, inertia = E * section["Iw"], G * section["It"], RHO * (section["Iy"] + section["Iz"])

    def determinant(f):
        square = (2 * math.pi * f)**2 * inertia
        whole = math.sqrt(GIt**2 + 4 * EIw * square)
        b, a = math.sqrt((whole + GIt) / (2 * EIw)), math.sqrt((whole - GIt) / (2 * EIw))
        cos, sin, cosh, decay = math.cos(a), math.sin(a), math.cosh(b), math.exp(-b)
        # phi of (cosh bx - cos ax)/cosh b, and cos ax - b/a sin ax - exp(-bx)
        slope = (b * math.tanh(b) + a * sin / cosh, b * decay - b * cos - a * sin)
        bend = (b**2 + a**2 * cos / cosh, -b**2 * decay + a * b * sin - a**2 * cos)
        third = (b**3 * math.tanh(b) - a**3 * sin / cosh,
                 b**3 * decay + a**2 * b * cos + a**3 * sin)
        force = [EIw * t - GIt * d for t, d in zip(third, slope)]
        return bend[0] * force[1] - bend[1] * force[0]

    low = step = math.sqrt(GIt / inertia) / 40
    while (determinant(low) > 0) == (determinant(low + step) > 0):
        low += step
    return root(determinant, low, low + step)


class FrequencyOrder(ProgramTest):
    def near(self, exact, formulation, n, constants=None, omit=NO_SHEAR, a="", b="", more=""):
        """Relative error of the frequency nearest to exact [Hz]."""
        words = ", ".join(f"{k}: {v!r}" for k, v in (constants or SECTION).items())
        file = self.folder / "scene.yaml"
        file.write_text(SCENE % {"constants": words, "young": E, "shear": G, "density": RHO, "a": a,
                                 "b": b, "more": more, "omit": omit}, encoding="utf-8")
        found = [q["value"] for q in self.record("solve", "--scene", file, "-f", formulation, "-n",
                                                 n)["quantities"] if q["value"]]
        return min((abs(f / exact - 1) for f in found))

    def fourth(self, formulations, exact, least=3.7, meshes=(8, 16), **scene):
        for formulation in formulations:
            coarse, fine = (self.near(exact, formulation, n, **scene) for n in meshes)
            with self.subTest(formulation=formulation, coarse=coarse, fine=fine):
                self.assertLess(fine, 1e-3)
                if fine > 1e-9:
                    self.assertGreater(math.log2(coarse / fine), least)

    def bending(self, factor):
        """[Hz] of the slender beam, omega = factor sqrt(EI/rho A)/L^2."""
        return factor * math.sqrt(E * SECTION["Iz"] / (RHO * SECTION["A"])) / (2 * math.pi)

    def test_slender_bending(self):
        """3.51602, 22.0345 of a cantilever, 22.3733 of the free bar, and higher modes."""
        for formulation in ALL:
            for factor, held in ((3.5160152685, ", hold: all"), (22.034491565, ", hold: all"),
                                 (22.373285448, "")):
                # Simpson's masses of three nodes have more error than the field
                self.assertLess(self.near(self.bending(factor), formulation, 8, a=held),
                                1e-4 if formulation == "geometrically_exact" else 5e-7,
                                (formulation, factor))
        cosine = lambda x: math.cos(x) + 1 / math.cosh(x)
        self.fourth(ALL, self.bending(root(cosine, 5.2 * math.pi, 5.8 * math.pi)**2),
                    a=", hold: all")

    def test_shear(self):
        """Hinged, shear and rotary inertia, elements down to 3 radii of gyration."""
        section = {**SECTION, "Iz": 4e-6, "Iy": 9e-6, "It": 1.3e-5,
                   "F": [1.2 / 4e-4, 0, 0, 0, 1.2 / 4e-4, 0, 0, 0, 0]}
        held = {"a": ", hold: [ux, uy, uz, rx]", "b": ", hold: [uy, uz]"}
        for wave in (1, 2, 3):
            self.fourth(SHEARED, timoshenko(section, wave * math.pi), constants=section,
                        omit=WITH_SHEAR, **held)

    def test_stretch_and_twist(self):
        """Fixed and free ends."""
        for mode in (1, 3):
            speeds = (math.sqrt(E / RHO),
                      math.sqrt(G * SECTION["It"] / RHO / (SECTION["Iy"] + SECTION["Iz"])))
            for speed in speeds:
                self.fourth(ALL, mode * speed / 4, a=", hold: all")

    def test_bodies_and_springs(self):
        """Stretch and bending with a mass at the tip, stretch against a spring."""
        speed, line = math.sqrt(E / RHO), RHO * SECTION["A"]
        x = root(lambda b: b * math.tan(b) - 1, 0.1, 1.5)
        self.fourth(ALL, x * speed / (2 * math.pi), a=", hold: all", b=f", mass: {line!r}")
        x = root(lambda b: b * math.tan(b) - 1, math.pi, 1.45 * math.pi)
        self.fourth(ALL, x * speed / (2 * math.pi), a=", hold: all", b=f", mass: {line!r}")
        x = root(lambda b: 1 + math.cos(b) * math.cosh(b)
                 + b * (math.cos(b) * math.sinh(b) - math.sin(b) * math.cosh(b)), 3.5, 4.5)
        self.fourth(ALL, self.bending(x**2), a=", hold: all", b=f", mass: {line!r}")
        x = root(lambda b: b * math.cos(b) + 3 * math.sin(b), 0.55 * math.pi, 0.99 * math.pi)
        stiffness = 3 * E * SECTION["A"]
        self.fourth(ALL, x * speed / (2 * math.pi), a=", hold: all",
                    more=f"springs:\n  s: {{to: b, stiffness: [{stiffness!r}, 0, 0, 0, 0, 0]}}\n")

    def test_warping(self):
        """A root that does not warp; lengths of its layer from 0.3 to 0.03."""
        for decay in (3, 30):
            section = {**SECTION, "Iw": G * SECTION["It"] / E / decay**2}
            self.fourth(WARPING, warped(section), constants=section, least=3.4, meshes=(16, 32),
                        a=", hold: all")


if __name__ == "__main__":
    unittest.main()
