"""Modes followed over a parameter: numbers that stay where frequencies cross, exact laws along each
curve, and frequencies that avoid each other."""
import csv
import io
import unittest

from harness.tools.kit.program import ProgramTest

FORMULATIONS = ("beamw", "beamw_vlasov", "beamw_consistent", "sheet_second", "sheet_third",
                "geometrically_exact", "collocation")

# Bending in both planes, f ~ thickness and f ~ width: they cross where the section is square.
CANTILEVER = """beamwork: 1
parameters:
  width: {value: 5e-3, unit: m, min: 1e-4, max: 1, about: "across"}
  coupling: {value: 0, unit: kg m^2, min: 0, max: 1, about: "product of inertia of the tip"}
  length: {value: 0.7, unit: m, min: 0.1, max: 10, about: "of the beam"}
let:
  thickness: 8e-3
  young: 7e10
sections:
  bar: {constants: {A: width*thickness, Iy: thickness*width^3/12, Iz: width*thickness^3/12,
        It: 1e-3*width*thickness}, young: young, shear_modulus: young/2.6, density: 2700}
nodes:
  root: {at: [0, 0, 0], hold: all}
  tip: {at: [length, 0, 0]MASS}
members:
  bar: {from: root, to: tip, section: bar, y: [0, 1, 0]}
analyses:
  vibration: {modal: {wanted: WANTED}}
quantities:
  f_$n: {for: {n: 1..WANTED}, frequency: {analysis: vibration, which: n - 1}, unit: Hz}
omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia]
"""
PLAIN = CANTILEVER.replace("MASS", "").replace("WANTED", "4")
COUPLED = CANTILEVER.replace("WANTED", "2").replace(
    "MASS", ", mass: 1e-3, inertia: [2e-5, 2e-5, 2e-5, 0, coupling, 0]")
# Torsion falls as 1/length, bending as its square: no tie between them.
TWIST = PLAIN.replace("It: 1e-3*width*thickness", "It: 1e-12").replace("1..4", "1..6").replace(
    "wanted: 4", "wanted: 6")


class Follow(ProgramTest):
    def follow(self, scene, formulation, over, *more, n=2):
        file = self.folder / "scene.yaml"
        file.write_text(scene, encoding="utf-8")
        return self.record("solve", "--scene", file, "-f", formulation, "-n", n, "--follow", over,
                           *more)

    def constant(self, curve, tolerance, what):
        self.assertLess(max(curve) / min(curve) - 1, tolerance, what)

    def test_crossing(self):
        """Every formulation: the modes cross at the square section and obey their laws before and
        behind it, also where a value is the crossing itself."""
        for formulation in FORMULATIONS:
            for over in ("width=5e-3..12e-3/7", "width=12e-3..4.5e-3/3"):
                got = self.follow(PLAIN, formulation, over)
                values, curves = got["values"], [c["frequency"] for c in got["curves"]]
                self.assertEqual(len(curves), 4)
                slopes = []
                for curve in curves:
                    grows = curve[-1] / curve[0] > 1.01 or curve[-1] / curve[0] < 0.99
                    law = [f / v if grows else f for f, v in zip(curve, values)]
                    self.constant(law, 1e-9, (formulation, over))
                    slopes.append(grows)
                self.assertEqual(sum(slopes), 2, "two bend across, two along the thickness")
                crossings = [e for e in got["events"] if e["kind"] == "crossing"]
                square = [e for e in crossings if abs(e["value"] / 8e-3 - 1) < 1e-8]
                self.assertEqual(len(square), 2, (formulation, got["events"]))
                self.assertEqual([e for e in got["events"] if e["kind"] == "veering"], [])

    def test_torsion(self):
        """Torsion and bending over the length; a crossing where the two laws say."""
        got = self.follow(TWIST, "collocation", "length=0.3..1.5/12")
        values, curves = got["values"], [c["frequency"] for c in got["curves"]]
        powers = {1: [], 2: []}
        for i, curve in enumerate(curves):
            power = 1 if abs(curve[-1] * values[-1] / curve[0] / values[0] - 1) < 1e-6 else 2
            self.constant([f * v**power for f, v in zip(curve, values)], 1e-8, (i, power))
            powers[power].append((i + 1, curve[0] * values[0]**power))
        self.assertGreaterEqual(len(powers[1]), 1)
        exact = sorted((b / t, i, j) for i, t in powers[1] for j, b in powers[2]
                       if values[0] < b / t < values[-1])
        self.assertGreaterEqual(len(exact), 1)
        crossings = sorted((e["value"], *sorted(e["modes"])) for e in got["events"]
                           if e["kind"] == "crossing")
        self.assertEqual([c[1:] for c in crossings], [tuple(sorted(e[1:])) for e in exact])
        for found, known in zip(crossings, exact):
            self.assertLess(abs(found[0] / known[0] - 1), 1e-8)

    def test_veering(self):
        """A body whose axes lie askew ties the two planes: they no longer cross, however coarse the
        values that are asked for, and come closest near the square."""
        for parts in (1, 2, 9):
            got = self.follow(COUPLED, "collocation", f"width=6e-3..10e-3/{parts}", "--set",
                              "coupling=1e-5")
            first, second = (c["frequency"] for c in got["curves"])
            self.assertTrue(all(a < b for a, b in zip(first, second)))
            self.assertEqual([(e["kind"], e["modes"]) for e in got["events"]],
                             [("veering", [1, 2])])
            self.assertLess(abs(got["events"][0]["value"] / 8e-3 - 1), 0.05)
            self.assertLess(len([a for a in got["asked"] if a]), len(got["asked"]))
            free = self.follow(COUPLED, "collocation", f"width=6e-3..10e-3/{parts}")
            self.assertEqual([e["kind"] for e in free["events"]], ["crossing"])
            self.assertLess(abs(free["events"][0]["value"] / 8e-3 - 1), 1e-8)

    def test_forms(self):
        got = self.follow(PLAIN, "beamw", "width=5e-3..12e-3/7")
        work = ("solve", "--scene", self.folder / "scene.yaml", "-f", "beamw", "-n", 2, "--follow",
                "width=5e-3..12e-3/7")
        text = self.answered(*work, "--format", "csv").stdout
        rows = list(csv.DictReader(io.StringIO(text)))
        self.assertEqual(len(rows), 4 * len(got["values"]))
        self.assertEqual([float(r["frequency"]) for r in rows if r["mode"] == "2"],
                         got["curves"][1]["frequency"])
        self.assertIn("cross at 0.008", self.answered(*work).stdout)

    def test_refused(self):
        self.follow(PLAIN, "beamw", "width=5e-3..6e-3/1")
        work = ("solve", "--scene", self.folder / "scene.yaml", "-f", "beamw", "-n", 2, "--follow")
        for over, words in (("width=1", "A..B/N"), ("width=1e-3..2e-3", "A..B/N"),
                            ("width=1e-3..2e-3/0", "A..B/N"), ("width=1e-3..2e-3/3x", "A..B/N"),
                            ("wide=1e-3..2e-3/3", "width"), ("width=1e-3..9/3", "width"),
                            ("width=1e-3..1e-3/3", "the same"), ("width=1e-3..x/3", "width")):
            self.refused(2, words, *work, over)
        self.refused(2, "no modes", "solve", "elastica", "-f", "beamw", "-n", 2, "--follow",
                     "load=1..2/2")
        self.refused(2, "--matrices", *work, "width=1e-3..2e-3/2", "--matrices",
                     self.folder / "new")


if __name__ == "__main__":
    unittest.main()
