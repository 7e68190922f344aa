"""The parameter `mass` of built-in cases: where the mass of members lies. The usual is what a case has without it."""
import csv
import io
import re
import unittest

from cases.format.test.scene_case import SceneCase, values

ASKED = {"coupled_beam": ("asked=frequencies",), "sheet_cantilever": ("modes=3",),
         "tapered_cantilever": ("section=wedge", "asked=waves")}
MASSLESS = {"angle_column", "bend_45", "c_cantilever", "carried_rod", "cross_flexure", "elastica", "geradin_cardona",
            "hexapod", "lateral_buckling", "lee_frame", "loaded_cantilever", "moment_buckling", "rigid_body",
            "right_angle_frame", "roll_up", "shear_column", "shear_elastica", "sheet_wagner", "snap_through",
            "spherical_joint", "wagner_torsion", "warping_torsion", "weighted_column"}
WHERE = ("-f", "collocation", "-n", 2)
LUMPED = ("--set", "mass=lumped")


def with_key(scene):
    return re.sub(r"(?m)^analyses:", "mass: lumped\nanalyses:", scene)


class MassTest(SceneCase):

    def massive(self):
        """(case, what is set) of those that have mass."""
        names = [c["case"] for c in self.record("list")["cases"]]
        having = [n for n in names if "mass" in {p["name"] for p in self.record("list", n)["parameters"]}]
        self.assertEqual(set(names) - set(having), MASSLESS)
        return [(n, tuple(w for one in ASKED.get(n, ()) for w in ("--set", one))) for n in having]

    def lumped_differs(self, case, point):
        """As the scene of the case with `mass: lumped`, bit for bit, and marked."""
        usual, lumped = (self.record("solve", case, *WHERE, *point, *mass) for mass in ((), LUMPED))
        self.assertEqual(usual["parameters"]["mass"], "usual")
        self.assertEqual(lumped["parameters"]["mass"], "lumped")
        self.assertRegex(lumped["cell"]["lumped"], "^mass ", case)
        self.assertNotIn("mass", usual["cell"]["lumped"], case)
        mine, former = values(lumped), values(usual)
        self.assertTrue([q for q in mine if mine[q] != former[q]], case)
        return mine, former

    def test_every_case_that_has_mass(self):
        for case, point in self.massive():
            mine, former = self.lumped_differs(case, point)
            text = self.answered("scene", case, *point).stdout
            self.assertNotRegex(text, r"(?m)\bmass: (lumped|consistent)", case)
            if case in ("leaf_guide", "deep_beam", "tip_body", "spin_up"):
                as_scene = self.record("solve", "--scene", self.scene(with_key(text)), *WHERE)
                self.assertEqual(values(as_scene), mine, case)
                as_written = self.record("solve", "--scene", self.scene(text), *WHERE)
                self.assertEqual(values(as_written), former, case)
                self.assertIn("\nmass: lumped\n", self.answered("scene", case, *point, *LUMPED).stdout)

    def test_reference_values_hold(self):
        """Meshes go to the same limit: halves at the nodes to order 2."""
        found = self.record("solve", "deep_beam", "-f", "collocation", "-n", 64, *LUMPED)
        errors = [q["error"] for q in found["quantities"] if q["quantity"].startswith("frequency")]
        self.assertTrue(errors and all(e is not None and 1e-6 < abs(e) < 1e-3 for e in errors), errors)
        point = ("--set", "omega_star=2.5")
        said = [self.answered("truth", "tip_body", *point, *mass).stdout.split("\n", 1) for mass in ((), LUMPED)]
        self.assertEqual(said[0][1], said[1][1])
        self.assertIn("mass=lumped", said[1][0])

    def test_consistent_is_required(self):
        """What has it is as usual; what lumps is refused."""
        spin = ("spin_up", *WHERE, "--set", "time=0.5")
        usual = values(self.record("solve", *spin))
        self.assertEqual(values(self.record("solve", *spin, "--set", "mass=consistent")), usual)
        self.refused(2, "has lumped mass only", "solve", *spin, "--set", "mass=consistent", "--set",
                     "integrator=conserving")

    def test_names(self):
        self.refused(2, "elastica has no parameter 'mass'", "solve", "elastica", *LUMPED)
        self.refused(2, "give one of usual|lumped|consistent", "solve", "tip_body", "--set", "mass=2")
        text = self.answered("solve", "deep_beam", *WHERE, *LUMPED).stdout
        self.assertIn("deep_beam (mass=lumped), collocation", text)
        self.assertIn("lumped: mass of analysis modal", text)

    def test_sweep(self):
        done = self.answered("sweep", "deep_beam", "--vary", "mass=usual,lumped", *WHERE, "-k", "frequency_1",
                             "--format", "csv")
        found = {row["mass"]: abs(float(row["error"])) for row in csv.DictReader(io.StringIO(done.stdout))}
        self.assertLess(10 * found["usual"], found["lumped"])


if __name__ == "__main__":
    unittest.main()
