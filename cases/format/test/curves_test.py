"""Curves: tables in text, rows in CSV, over an abscissa of choice, and their errors over the meshes."""
import csv
import io
import unittest

from cases.format.test.scene_case import SceneCase

# A leaf guide: its stiffness across the stroke falls with the stroke.
GUIDE = """beamwork: 1
sections:
  leaf: {rectangle: {width: 30e-3, thickness: 0.3e-3}, young: 200e9, shear_modulus: 77e9}
nodes:
  base_a: {at: [0, 0, 0], hold: all}
  base_b: {at: [0.06, 0, 0], hold: all}
  stage: {at: [0.03, 0.08, 0], drive: {ux: travel}}
  end_a: {at: [0, 0.08, 0], part_of: stage}
  end_b: {at: [0.06, 0.08, 0], part_of: stage}
members:
  leaf_a: {from: base_a, to: end_a, section: leaf, y: [1, 0, 0], warping: fixed}
  leaf_b: {from: base_b, to: end_b, section: leaf, y: [1, 0, 0], warping: fixed}
motions:
  travel: {unit: m, path: [0, 1, 2], value: [0, -8e-3, 8e-3]}
analyses:
  stroke: {static: {stations: 1..2/STATIONS}}
  support: {compliance: {node: stage, about: stroke}}
  other: {linear: {}}
quantities:
  place: {displacement: {analysis: stroke, node: stage, component: ux, take: curve}, unit: mm, factor: 1000}
  force: {reaction: {analysis: stroke, node: stage, component: ux, take: curve}, x: {quantity: place}}
  k_z: {stiffness: {analysis: support, component: uz, take: curve}, x: {quantity: place}}
  k_y: {stiffness: {analysis: support, component: uy, take: curve}}
  k_end: {stiffness: {analysis: support, component: uz}}
meshes: [1, 2, 4]
"""
FEW, MANY = GUIDE.replace("STATIONS", "20"), GUIDE.replace("STATIONS", "100")
WHERE = ("-f", "collocation", "-n", 2)


def curves(record):
    return {c["quantity"]: c for c in record["curves"]}


class CurvesTest(SceneCase):

    def rows(self, text):
        return list(csv.DictReader(io.StringIO(text)))

    def test_abscissa(self):
        """The values of another quantity of the same path, of what follows it, too."""
        found = curves(self.record("solve", "--scene", self.scene(FEW), *WHERE))
        places = found["place"]["curve_value"]
        self.assertEqual(len(places), 21)
        for name in ("force", "k_z"):
            self.assertEqual(found[name]["curve_x"], places)
            self.assertEqual((found[name]["x_name"], found[name]["x_unit"]), ("place", "mm"))
        self.assertAlmostEqual(places[0], -8, delta=1e-9)
        self.assertEqual(found["k_y"]["x_name"], "path")
        self.same_again(self.scene(FEW), *WHERE)

    def test_csv(self):
        """Every point with its abscissa, of a single mesh and of several."""
        found = curves(self.record("solve", "--scene", self.scene(MANY), *WHERE))
        rows = self.rows(self.answered("solve", "--scene", self.scene(MANY), *WHERE, "--format", "csv").stdout)
        for name, curve in found.items():
            mine = [r for r in rows if r["quantity"] == name]
            self.assertEqual([float(r["x"]) for r in mine], curve["curve_x"])
            self.assertEqual([float(r["value"]) for r in mine], curve["curve_value"])
            self.assertEqual({(r["x_name"], r["x_unit"]) for r in mine}, {(curve["x_name"], curve["x_unit"])})
        self.assertEqual(len([r for r in rows if r["quantity"] == "k_end"]), 1)
        rows = self.rows(self.answered("converge", "--scene", self.scene(FEW), "-f", "collocation",
                                       "--format", "csv").stdout)
        self.assertEqual(len([r for r in rows if r["quantity"] == "force"]), 3*21)

    def test_text(self):
        """Beside each other where the abscissa is the same; of many points some, and how to get all."""
        text = self.answered("solve", "--scene", self.scene(FEW), *WHERE).stdout
        lines = [line.split() for line in text.splitlines()]
        at = lines.index(["place", "[mm]", "force", "[N]", "k_z", "[N/m]", "stable"])
        table = [[float(x) for x in line[:3]] for line in lines[at + 1:at + 22]]
        self.assertEqual([row[0] for row in table], sorted(row[0] for row in table))
        self.assertAlmostEqual(table[10][0], 0)
        self.assertAlmostEqual(table[10][1], 0)
        many = self.answered("solve", "--scene", self.scene(MANY), *WHERE).stdout
        self.assertIn("20 of 101 points; --format csv and json have them all", many)
        self.assertLess(len(many.splitlines()), 120)

    def test_largest_error(self):
        """Of each mesh, at any point, by the largest value of the finest."""
        path = self.scene(FEW)
        value = {n: curves(self.record("solve", "--scene", path, "-f", "beamw", "-n", n))["k_z"]["curve_value"]
                 for n in (1, 2, 4)}
        size = max(map(abs, value[4]))
        text = self.answered("converge", "--scene", path, "-f", "beamw", "-f", "collocation").stdout
        block = text[text.index("k_z [N/m] over place [mm], largest error over the curve"):]
        line = next(line for line in block.splitlines() if line.startswith("  beamw "))
        shown = [float(x) for x in line.replace("%", "").split()[1:3]]
        for n, percent in zip((1, 2), shown):
            error = 100*max(abs(a - b) for a, b in zip(value[n], value[4]))/size
            self.assertAlmostEqual(percent, error, delta=1e-3*error + 1e-4)
        self.assertIn("from collocation", block.splitlines()[2])
        record = self.record("converge", "--scene", path, "-f", "beamw", "-f", "collocation")
        found, = (c for c in record["series"][0]["curves"] if c["quantity"] == "k_z")
        self.assertEqual((found["x_name"], found["x_unit"], found["reference"]), ("place", "mm", "collocation"))
        for mesh in found["meshes"]:
            n = mesh["elements"]
            error = max(abs(a - b) for a, b in zip(value[n], value[4]))/size
            self.assertAlmostEqual(mesh["error"], error, delta=1e-9 + 1e-9*error)
        last = record["series"][1]["curves"]
        self.assertTrue(all(c["reference_error"] == 0 for c in last))
        self.assertIn("place [mm]: the same curve on all meshes", text)

    def test_chosen(self):
        """-k keeps what the curve is over."""
        text = self.answered("converge", "--scene", self.scene(FEW), "-f", "collocation", "-k", "force").stdout
        self.assertIn("force [N] over place [mm]", text)

    def test_refusals(self):
        for before, behind, words in (
                ("x: {quantity: place}}\n  k_z", "x: {quantity: k_end}}\n  k_z", "no other quantity with take: curve"),
                ("x: {quantity: place}}\n  k_z", "x: {quantity: plane}}\n  k_z", "did you mean 'place'"),
                ("x: {quantity: place}}\n  k_z", "x: {quantity: place, factor: 2}}\n  k_z", "has its factor"),
                ("x: {quantity: place}}\n  k_z", "x: {quantity: force}}\n  k_z", "no other quantity"),
                ("x: {quantity: place}}\n  k_z", "x: {quantity: away}}\n  k_z", "of another path")):
            self.assertIn(before, FEW)
            text = FEW.replace(before, behind).replace("quantities:", """  second: {static: {stations: 1..2/20}}
quantities:
  away: {displacement: {analysis: second, node: stage, component: ux, take: curve}}""")
            self.refused(2, words, "solve", "--scene", self.scene(text))


if __name__ == "__main__":
    unittest.main()
