"""The order of high modes differs between coarse and fine meshes (rule meshes-high-modes). With one more mesh, the
verdict is a pass."""
import unittest

from harness.tools.kit.program import ProgramTest

# case, formulation, parameters, quantity, the quantity that has this mode on the coarsest mesh, and the meshes
CROSSINGS = (
    ("c_column", "beamw:mass=lumped", (), "frequency_12", "frequency_11",
     (8, 16, 32, 64, 128, 256)),
    ("c_column", "beamw:mass=lumped", (), "frequency_11", "frequency_13",
     (8, 16, 32, 64, 128, 256)),
    ("deep_beam", "beamw:mass=lumped", ("shear=0", "rotary_inertia=0"), "frequency_9", "frequency_8",
     (4, 8, 16, 32, 64, 128)),
)
COARSE = (
    ("angle_column", "beamw", (), "critical_load_3", (4, 8, 16, 32, 64, 128)),
    ("angle_column", "beamw_first", ("load=moment",), "critical_moment_3",
     (4, 8, 16, 32, 64, 128)),
    *((case, formulation, given, quantity, meshes)
      for case, formulation, given, quantity, _, meshes in CROSSINGS),
)


class Modes(ProgramTest):

    def series(self, case, formulation, given, meshes):
        words = [word for one in given for word in ("--set", one)]
        found, = self.record("converge", case, "-f", formulation, "-j", 1, "-n",
                             ",".join(map(str, meshes)), *words)["series"]
        return {q["quantity"]: q for q in found["quantities"]}

    def values(self, record):
        return {mesh["elements"]: mesh["value"] for mesh in record["meshes"]}

    def test_one_mesh_more_passes(self):
        for case, formulation, given, quantity, meshes in COARSE:
            with self.subTest(case=case, formulation=formulation, quantity=quantity):
                found = self.series(case, formulation, given, meshes)[quantity]
                self.assertEqual(found["verdict"], "pass")
                self.assertLess(abs(found["order"] - 2), 0.01)

    def test_modes_cross(self):
        for case, formulation, given, quantity, other, meshes in CROSSINGS:
            with self.subTest(case=case, formulation=formulation, quantity=quantity):
                found = self.series(case, formulation, given, meshes)
                own, coarse = self.values(found[quantity]), meshes[0]
                there = own[meshes[1]] - 4 * (own[meshes[2]] - own[meshes[1]])
                apart = abs(own[coarse] - there)
                self.assertLess(abs(self.values(found[other])[coarse] - there), apart / 5)


if __name__ == "__main__":
    unittest.main()
