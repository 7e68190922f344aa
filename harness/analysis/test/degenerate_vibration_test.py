import math
import unittest

from harness.tools.kit.program import ProgramTest


YOUNG, SHEAR, DENSITY, AREA, INERTIA, TWIST = 2e11, 8e10, 8000.0, 1e-4, 1e-9, 1.4e-9
LINE = DENSITY * AREA
WAVE = math.sqrt(YOUNG * INERTIA / LINE) / (2 * math.pi)
SCENE = """beamwork: 1
sections:
  s: {constants: {A: 1e-4, Iy: 1e-9, Iz: 1e-9, It: 1.4e-9, Iw: 0}, young: 2e11, shear_modulus: 8e10, density: 8000}
  light: {constants: {A: 1e-4, Iy: 1e-9, Iz: 1e-9, It: 1.4e-9, Iw: 0}, young: 2e11, shear_modulus: 8e10}
  flat: {constants: {A: 1e-4, Iy: 4e-9, Iz: 1e-9, It: 1.4e-9, Iw: 0}, young: 2e11, shear_modulus: 8e10, density: 8000}
nodes: {%s}
members: {%s}
%s
analyses: {v: {modal: {wanted: %d}}}
quantities: {f_$n: {for: {n: 1..%d}, frequency: {analysis: v, which: n - 1}, unit: Hz}}
omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia]
"""
SECOND = "c: {at: [2, 0, 0]}"
BEYOND = "n: {from: b, to: c, section: %s, y: [0, 1, 0]%s}"
HELD, FREE = "a: {at: [0, 0, 0], hold: all}", "a: {at: [0, 0, 0]}"
BODY = ", mass: 2, inertia: [3, 3, 3, 0, 0, 0]"


def bar(section="s", more=""):
    return f"m: {{from: a, to: b, section: {section}, y: [0, 1, 0]{more}}}"


def tip(more=""):
    return f"b: {{at: [1, 0, 0]{more}}}"


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def turned(v):
    size = math.sqrt(0.7**2 + 0.4**2 + 0.3**2 + 0.5**2)
    w, *r = (q / size for q in (0.7, 0.4, -0.3, 0.5))
    half = [c + w * x for c, x in zip(cross(r, v), v)]
    return [x + 2 * c for x, c in zip(v, cross(r, half))]


class Degenerate(ProgramTest):

    def each(self):
        return [f["formulation"] for f in self.record("list", "formulations")["formulations"]] + [
            "geometrically_exact:nodes=2", "beamw:mass=lumped"]

    def scene(self, nodes, members, more="", wanted=8):
        path = self.folder / "scene.yaml"
        path.write_text(SCENE % (nodes, members, more, wanted, wanted), encoding="utf-8")
        return path

    def found(self, formulation, nodes, members, more="", wanted=8, n=4):
        """Returns the frequencies [Hz] in ascending order; None: the mesh has no further mode."""
        path = self.scene(nodes, members, more, wanted)
        return [q["value"] for q in self.record("solve", "--scene", path, "-f", formulation, "-n", n)["quantities"]]

    def same(self, found, right, within, *what):
        self.assertEqual([v is None for v in found], [v is None for v in right], (found, right, *what))
        largest = max(v for v in right if v is not None)
        for here, there in zip(found, right):
            if here is not None:
                self.assertLessEqual(abs(here - there), within * (there if there > 1e-6 * largest else largest),
                                     (found, right, *what))

    def test_two_of_each(self):
        for formulation in self.each():
            within = 3e-2 if formulation.endswith("lumped") else 1e-3 if "exact" in formulation else 2e-4
            found = self.found(formulation, f"{HELD}, {tip()}", bar(), wanted=4, n=8)
            self.same(found, [WAVE * f for f in (3.516015, 3.516015, 22.03449, 22.03449)], within, formulation)
            self.same(found[::2], found[1::2], 1e-9, formulation)
            found = self.found(formulation, f"{FREE}, {tip()}", bar(), n=8)
            self.assertEqual(found[:6], [0] * 6, formulation)
            self.same(found[6:], [22.373285 * WAVE] * 2, 3 * within, formulation)
            self.same(found[6:7], found[7:], 1e-9, formulation)

    def test_pairs_of_a_free_ring(self):
        corners = [("e", [1, 0, 0]), ("n", [0, 1, 0]), ("w", [-1, 0, 0]), ("s", [0, -1, 0])]
        nodes = ", ".join(f"{name}: {{at: {at}}}" for name, at in corners)
        members = ", ".join(
            f"m_{name}: {{from: {name}, to: {corners[(i + 1) % 4][0]}, section: s, y: {[-x for x in at]}, curvature: [0, 0, 1]}}"
            for i, (name, at) in enumerate(corners))
        for formulation in self.each():
            for n in (7, 8):
                found = self.found(formulation, nodes, members, wanted=18, n=n)
                self.assertEqual(found[:6], [0] * 6, formulation)
                self.same(found[6::2], found[7::2], 1e-11, formulation, n)

    def test_softer_than_rounding_of_fine_meshes(self):
        spring = "springs: {k: {to: a, stiffness: [%s]}}"
        for formulation in ("beamw", "collocation", "geometrically_exact"):
            soft = [self.found(formulation, f"{FREE}, {tip()}", bar(), spring % ", ".join(["1e-2"] * 6), wanted=6, n=n) for n in (4, 500)]
            self.same(soft[1][:6], soft[0][:6], 1e-3, formulation)
            self.assertGreater(soft[1][0], 0, formulation)
            for n in (250, 500):
                self.assertEqual(self.found(formulation, f"{FREE}, {tip()}", bar(), n=n)[:6], [0] * 6, formulation)

    def test_nothing_has_mass(self):
        for nodes in (HELD, FREE):
            self.refused(2, "v: the structure has no mass; add a density or a mass to a section, or a mass to a node",
                         "solve", "--scene", self.scene(f"{nodes}, {tip()}", bar("light")))

    def test_nothing_resists(self):
        alone = "a coordinate has neither stiffness nor mass"
        spring = "springs: {k: {to: b, stiffness: [100, 200, 300, 0, 0, 0]}}"
        other = "m: {from: a, to: z, section: light, y: [1, 0, 0]}"
        arm = f"{bar()}, {BEYOND % ('light', ', release: {from: [ry, rz]}')}"
        for words, scene in (
                (alone, (f"a: {{at: [0, 0, 0], mass: 1}}, {tip(', mass: 2')}", bar("light"))),
                (alone, (f"{HELD}, z: {{at: [0, 1, 0], hold: all}}, {tip(', mass: 2')}", other, spring)),
                ("the released ends form a mechanism", (f"{HELD}, {tip()}, {SECOND}", arm))):
            self.refused(1, words, "solve", "--scene", self.scene(*scene), "-f", "collocation", "-n", 2, silent=False)

    def test_zeros(self):
        apart = f"{FREE}, {tip()}, c: {{at: [0, 3, 0]}}, d: {{at: [1, 3, 0]}}"
        two = f"{bar()}, n: {{from: c, to: d, section: s, y: [0, 1, 0]}}"
        hinge = f"{bar()}, {BEYOND % ('s', ', release: {from: [rz]}')}"
        scenes = [(zeros, f"a: {{at: [0, 0, 0], hold: [{held}]}}, {tip()}", bar(), "") for held, zeros in (
            ("ux", 5), ("rx", 5), ("ux, uy", 4), ("ux, rx", 4), ("ux, uy, uz", 3), ("rx, ry, rz", 3),
            ("ux, uy, uz, rx, ry", 1), ("all", 0))]
        scenes += [(3, f"{FREE}, {tip()}", bar(), "plane: xy"), (12, apart, two, ""),
                   (1, f"{HELD}, {tip()}, {SECOND}", hinge, "")]
        for formulation in self.each():
            for zeros, *scene in scenes:
                found = self.found(formulation, *scene, wanted=14, n=3)
                self.assertEqual([f == 0 for f in found if f is not None][:zeros + 1], [True] * zeros + [False],
                                 (formulation, scene, found))

    def test_one_member_has_mass(self):
        end = "c: {at: [1, 0, 0.5]}"
        arm = "arm: {from: b, to: c, section: light, y: [0, 1, 0]}"
        pair = f"{bar('light', ', divisions: %d')}, {BEYOND % ('s', ', divisions: 4')}"
        for formulation in self.each():
            bare = self.found(formulation, f"{HELD}, {tip()}", bar(), wanted=6)
            both = self.found(formulation, f"{HELD}, {tip()}, {end}", f"{bar()}, {arm}", wanted=6)
            self.same(both, bare, 1e-8, formulation)
            one, many = (self.found(formulation, f"{HELD}, {tip()}, {SECOND}", pair % k, wanted=6) for k in (1, 4))
            self.same(one, many, 1e-8, formulation)

    def test_light_member_between_masses(self):
        stretch, twist, bend = YOUNG * AREA, SHEAR * TWIST, YOUNG * INERTIA
        for formulation in self.each():
            found = self.found(formulation, f"{HELD}, {tip(', mass: 2')}", bar("light"), wanted=5, n=2)
            self.same(found, [math.sqrt(3 * bend / 2) / 2 / math.pi] * 2 + [math.sqrt(stretch / 2) / 2 / math.pi] +
                      [None] * 2, 1e-8, formulation)
            two = f"a: {{at: [0, 0, 0], mass: 1, inertia: [1, 1, 1, 0, 0, 0]}}, {tip(BODY)}"
            found = self.found(formulation, two, bar("light"), wanted=12, n=2)
            self.assertEqual(found[:6], [0] * 6, formulation)
            axial, turning = (math.sqrt(k) / 2 / math.pi for k in (stretch * 1.5, twist * 4 / 3))
            self.same([found[6], found[11]], [turning, axial], 1e-8, formulation)
            self.same(found[7:11:2], found[8:11:2], 1e-8, formulation)

    def test_bodies(self):
        spring = "springs: {k: {to: b, stiffness: [100, 200, 300, 40, 50, 60]}}"
        mass, about = (100, 200, 300), (40, 50, 60)
        right = sorted(math.sqrt(k / m) / 2 / math.pi for m, all_of in ((2, mass), (3, about)) for k in all_of)
        for formulation in self.each():
            apart = f"{HELD}, z: {{at: [0, 1, 0], hold: all}}, {tip(BODY)}"
            fixed = "m: {from: a, to: z, section: light, y: [1, 0, 0], divisions: 1}"
            self.same(self.found(formulation, apart, fixed, spring, wanted=6, n=1), right, 1e-9, formulation)
            bare, none = (self.found(formulation, f"{HELD}, {tip(m)}", bar(), wanted=6)
                          for m in ("", ", mass: 0, inertia: [0, 0, 0, 0, 0, 0]"))
            self.assertEqual(bare, none, formulation)

    def test_released_at_both_ends(self):
        """A bar with hinges in both directions at both ends has the frequency factors pi^2 and 4 pi^2, each twice, like
        a bar whose nodes rotate."""
        ends = f"{HELD}, {tip(', hold: all')}"
        hinged = bar(more=", release: {from: [ry, rz], to: [ry, rz]}")
        turning = "a: {at: [0, 0, 0], hold: [ux, uy, uz, rx]}, b: {at: [1, 0, 0], hold: [ux, uy, uz, rx]}"
        for formulation in self.each():
            within = 2e-2 if formulation.endswith("lumped") else 1e-3
            found = self.found(formulation, ends, hinged, wanted=4, n=8)
            self.same(found, [WAVE * f * math.pi**2 for f in (1, 1, 4, 4)], within, formulation)
            self.same(found, self.found(formulation, turning, bar(), wanted=4, n=8), 1e-8, formulation)

    def test_equal_legs(self):
        nodes = ("{0}: {{at: [0, 0, 0], hold: all}}, p: {{at: [0, 0, 1]}}, q: {{at: [0.7, 0, 1]}}, "
                 "{1}: {{at: [0.7, 0, 0], hold: all}}")
        leg = "{0}l: {{from: {0}, to: {1}, section: flat, y: [0, 1, 0]}}"
        beam = "beam: {from: p, to: q, section: flat, y: [0, 1, 0]}"
        for formulation in self.each():
            one, other = (self.found(formulation, nodes.format(*ends),
                                     ", ".join((leg.format(ends[0], "p"), beam, leg.format(ends[1], "q"))))
                          for ends in (("a", "b"), ("b", "a")))
            self.same(one, other, 1e-9, formulation)
            turned = self.found(formulation, nodes.format("a", "b"), ", ".join(
                (leg.format("a", "p"), beam.replace("from: p, to: q", "from: q, to: p"), leg.format("b", "q"))))
            self.same(turned, one, 1e-8, formulation)
            alone = self.found(formulation, nodes.format("a", "b"), leg.format("a", "p") + ", " + leg.format("b", "q"))
            self.same(alone[::2], alone[1::2], 1e-9, formulation)

    def test_springs_to_the_ground(self):
        """A nearly rigid bar on two soft springs has the circular transverse frequencies sqrt(2 k/m) and sqrt(6 k/m),
        each twice."""
        k = 0.02
        springs = (f"springs: {{p: {{to: a, stiffness: [0, {k}, {k}, 1, 0, 0]}}, "
                   f"q: {{to: b, stiffness: [{k}, {k}, {k}, 0, 0, 0]}}}}")
        right = [math.sqrt(c * k / LINE) / 2 / math.pi for c in (1, 2, 2, 6, 6)]
        for formulation in self.each():
            if formulation.endswith("lumped"):
                continue  # the moment of inertia of a bar with lumped mass is different
            found = self.found(formulation, f"{FREE}, {tip()}", bar(), springs, wanted=5, n=8)
            self.same(found, right, 1e-3, formulation)

    def test_offsets(self):
        for formulation in self.each():
            plain = self.found(formulation, f"{HELD}, {tip()}", bar(), wanted=6)
            beside = "z: {at: [0, 0.3, 0.2], hold: all}, a: {at: [0, 0, 0], part_of: z}"
            self.same(self.found(formulation, f"{beside}, {tip()}", bar(), wanted=6), plain, 1e-9, formulation)
            heavy, carried = (self.found(formulation, f"{HELD}, {end}", bar(), wanted=6) for end in (
                tip(", mass: 0.3, centre: [0.1, 0.3, 0.2]"),
                tip() + ", z: {at: [1.1, 0.3, 0.2], part_of: b, mass: 0.3}"))
            self.same(heavy, carried, 1e-9, formulation)

    def test_turned(self):
        for formulation in self.each():
            right = self.found(formulation, f"{HELD}, {tip()}", bar("flat"), wanted=6)
            x, y = turned((1, 0, 0)), turned((0, 1, 0))
            nodes = "a: {at: [3, -2, 1], hold: all}, b: {at: [%r, %r, %r]}" % (3 + x[0], x[1] - 2, x[2] + 1)
            member = "m: {from: %s, section: flat, y: [%r, %r, %r]}"
            for ends in ("a, to: b", "b, to: a"):
                self.same(self.found(formulation, nodes, member % (ends, *y), wanted=6), right, 1e-8, formulation)


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
FREQUENCY_ORDER_SCENE = """beamwork: 1
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
    sign = function(low) > 0
    for _ in range(200):
        middle = (low + high) / 2
        if (function(middle) > 0) == sign:
            low = middle
        else:
            high = middle
    return (low + high) / 2


def timoshenko(section, wave, upper=False):
    """Returns the frequency [Hz] of a hinged Timoshenko beam. The deflection is a sine of wave x and the rotation a cosine, so the
    frequencies are those of a 2 x 2 eigenvalue problem."""
    area, inertia, shear = section["A"], section["Iz"], G / section["F"][0]
    k11, k12, k22 = shear * wave**2, -shear * wave, shear + E * inertia * wave**2
    m1, m2 = RHO * area, RHO * inertia
    a, b, c = m1 * m2, -(k11 * m2 + k22 * m1), k11 * k22 - k12**2
    root_of = math.sqrt(b * b - 4 * a * c)
    square = (-b + root_of) / (2 * a) if upper else 2 * c / (-b + root_of)
    return math.sqrt(square) / (2 * math.pi)


def warped(section):
    EIw, GIt, inertia = E * section["Iw"], G * section["It"], RHO * (section["Iy"] + section["Iz"])

    def determinant(f):
        square = (2 * math.pi * f)**2 * inertia
        whole = math.sqrt(GIt**2 + 4 * EIw * square)
        b, a = math.sqrt((whole + GIt) / (2 * EIw)), math.sqrt((whole - GIt) / (2 * EIw))
        cos, sin, cosh, decay = math.cos(a), math.sin(a), math.cosh(b), math.exp(-b)
        # derivatives at the tip of (cosh bx - cos ax)/cosh b and cos ax - b/a sin ax - exp(-bx), the terms of the
        # rotation
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
        words = ", ".join(f"{k}: {v!r}" for k, v in (constants or SECTION).items())
        file = self.folder / "scene.yaml"
        file.write_text(FREQUENCY_ORDER_SCENE % {"constants": words, "young": E, "shear": G, "density": RHO, "a": a,
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
        return factor * math.sqrt(E * SECTION["Iz"] / (RHO * SECTION["A"])) / (2 * math.pi)

    def test_slender_bending(self):
        for formulation in ALL:
            for factor, held in ((3.5160152685, ", hold: all"), (22.034491565, ", hold: all"),
                                 (22.373285448, "")):
                self.assertLess(self.near(self.bending(factor), formulation, 8, a=held),
                                1e-4 if formulation == "geometrically_exact" else 5e-7,
                                (formulation, factor))
        cosine = lambda x: math.cos(x) + 1 / math.cosh(x)
        self.fourth(ALL, self.bending(root(cosine, 5.2 * math.pi, 5.8 * math.pi)**2),
                    a=", hold: all")

    def test_shear(self):
        section = {**SECTION, "Iz": 4e-6, "Iy": 9e-6, "It": 1.3e-5,
                   "F": [1.2 / 4e-4, 0, 0, 0, 1.2 / 4e-4, 0, 0, 0, 0]}
        held = {"a": ", hold: [ux, uy, uz, rx]", "b": ", hold: [uy, uz]"}
        for wave in (1, 2, 3):
            self.fourth(SHEARED, timoshenko(section, wave * math.pi), constants=section,
                        omit=WITH_SHEAR, **held)

    def test_stretch_and_twist(self):
        for mode in (1, 3):
            speeds = (math.sqrt(E / RHO),
                      math.sqrt(G * SECTION["It"] / RHO / (SECTION["Iy"] + SECTION["Iz"])))
            for speed in speeds:
                self.fourth(ALL, mode * speed / 4, a=", hold: all")

    def test_bodies_and_springs(self):
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
        for decay in (3, 30):
            section = {**SECTION, "Iw": G * SECTION["It"] / E / decay**2}
            self.fourth(WARPING, warped(section), constants=section, least=3.4, meshes=(16, 32),
                        a=", hold: all")

    def test_motions_inside_elements(self):
        """The frequencies of a square section, with and without damping, do not depend on the direction of its y axis,
        although `sheet_third` has no shear along y: the masses inside its elements split the double eigenvalues of K and M."""
        nodes = "left: {at: [0, 0, 0], hold: [ux, uy, uz, rx]}, right: {at: [10, 0, 0], hold: [uy, uz]}"
        section = ("polar: {rectangle: {width: 2, thickness: 2}, shear_factor: 0.8333333333333334, given: {Iw: 0, It: 2.6666666666666665},"
                   " young: 2e11, shear_modulus: 7.7e10, density: 8000}")
        found = []
        for angle in (0, 0.3, math.pi / 4):
            path = self.folder / "scene.yaml"
            path.write_text(f"""beamwork: 1
sections: {{{section}}}
nodes: {{{nodes}}}
members: {{m: {{from: left, to: right, section: polar, y: [0, {math.cos(angle)}, {math.sin(angle)}], warping: [free, free], damping: 1e-4}}}}
analyses: {{v: {{modal: {{}}}}, w: {{modal: {{damped: yes}}}}}}
quantities:
  f_$n: {{for: {{n: 1..8}}, frequency: {{analysis: v, which: n - 1}}, unit: Hz}}
  g_$n: {{for: {{n: 1..8}}, frequency: {{analysis: w, which: n - 1}}, unit: Hz}}
""", encoding="utf-8")
            found.append([row["value"] for n in (1, 2, 3)
                          for row in self.record("solve", "--scene", path, "-f", "sheet_third", "-n", n)["quantities"]])
        for other in found[1:]:
            for a, b in zip(found[0], other):
                self.assertEqual(a is None, b is None)
                if a is not None:
                    self.assertAlmostEqual(a / b, 1, delta=1e-9)


if __name__ == "__main__":
    unittest.main()
