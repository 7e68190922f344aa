"""Every example of a formulation: compiled as a stranger would, short, and judged on ten cases."""
import re
import shutil
import subprocess
import unittest

from harness.cli.test.plugin import EXAMPLES, WARNINGS, PluginTest, compile_shared
from harness.tools.kit.program import read_json

STATICS_AND_FREQUENCIES = ("tapered_cantilever", "deep_beam", "tip_body", "sprung_beam",
                           "loaded_cantilever", "elastica", "snap_through", "right_angle_frame")


class Judged:
    """What holds for each: limits that are right, and no more lines than the table says."""

    cases = ()

    @classmethod
    def setUpClass(cls):
        cls.object = compile_shared(EXAMPLES / f"{cls.example}.c",
                                    cls.class_folder() / f"{cls.example}.so", *WARNINGS)

    def test_short(self):
        lines = (EXAMPLES / f"{self.example}.c").read_text(encoding="utf-8").splitlines()
        table = (EXAMPLES / "README.md").read_text(encoding="utf-8")
        promised = re.search(rf"^\| `{self.example}\.c` \| (\d+) \|", table, re.MULTILINE)
        self.assertLessEqual(len(lines), int(promised[1]))
        self.assertLessEqual(len(lines), 200)
        self.assertEqual([line for line in lines if line.startswith('#include "')],
                         ['#include "elements/element.h"'])

    def test_keeps_the_contract(self):
        self.answered("element-test", "--element", self.object)

    def test_judged_like_the_others(self):
        """Ten cases, statics, vibration and buckling."""
        record = self.folder / "v.json"
        self.assertEqual(len(self.cases), 10)
        self.answered("verify", "--element", self.object, "-f", self.example, "-k",
                      " or ".join(f"{case}/default" for case in self.cases), "--json", record)
        found = [v for v in read_json(record)["verdicts"]
                 if v["verdict"] not in ("skip", "no truth", "other model")]
        self.assertEqual({v["case"] for v in found} - {"shear_elastica"}, set(self.cases))
        self.assertEqual([v for v in found if v["verdict"] != "pass"], [])


class Timoshenko(Judged, PluginTest):
    example = "timoshenko"
    cases = (*STATICS_AND_FREQUENCIES, "weighted_column", "bend_45")


class Corotational(Judged, PluginTest):
    example = "corotational"
    cases = (*STATICS_AND_FREQUENCIES, "weighted_column", "lateral_buckling")

    def test_converges_as_the_others(self):
        """A tangent that is not symmetric, and a chord that hardly stretches: as few iterations."""
        for axial in ("1e4", "1e12"):
            iterations = {
                name: self.record("solve", "elastica", "--element", self.object, "-f", name, "-n",
                                  "8", "-s", "load=10", "-s", f"axial={axial}")["cell"]["iterations"]
                for name in (self.example, "beamw_first")
            }
            self.assertLessEqual(iterations[self.example], iterations["beamw_first"] + 1)


class Ancf(Judged, PluginTest):
    example = "ancf"
    cases = ("elastica", "sprung_beam", "lateral_buckling", "loaded_cantilever", "roll_up",
             "rotating_cantilever", "snap_through", "tapered_cantilever", "tip_body",
             "weighted_column")


@unittest.skipUnless(shutil.which("gfortran"), "needs gfortran")
class Uel(Judged, PluginTest):
    """A user element in Fortran; the same beam as that of corotational.c."""

    example = "uel"
    cases = ("elastica", "sprung_beam", "lateral_buckling", "loaded_cantilever",
             "rotating_cantilever", "snap_through", "tapered_cantilever", "tip_body",
             "weighted_column", "right_angle_frame")

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        beam, cls.object = folder / "uel_beam.o", folder / "uel.so"
        subprocess.run(["gfortran", "-O2", "-Wall", "-Wno-unused-dummy-argument", "-Werror", "-fPIC",
                        "-c", EXAMPLES / "uel_beam.f90", "-o", beam],
                       check=True)
        compile_shared(EXAMPLES / "uel.c", cls.object, *WARNINGS, beam, "-lgfortran")

    def test_the_beam_of_the_other_example(self):
        other = compile_shared(EXAMPLES / "corotational.c", self.folder / "other.so")
        values = [
            [q["value"] for q in self.record(
                "solve", "lee_frame", "--element", made, "-f", name, "-n", "4")["quantities"]
             if q["value"] is not None]
            for name, made in ((self.example, self.object), ("corotational", other))
        ]
        self.assertGreater(len(values[0]), 3)
        for one, same in zip(*values, strict=True):
            self.assertAlmostEqual(one / same, 1, delta=1e-9)


class Planted(PluginTest):
    """What an author gets wrong is told by what he runs first, `element-test`, or by `verify`."""

    def broken(self, example, change, *words):
        made = self.altered(example, change)
        told = " ".join(self.answered("element-test", "--element", made, code=1).stdout.split())
        for word in words:
            self.assertIn(word, told)

    def test_sign_of_forces(self):
        """RHS in the place of F."""
        self.broken("corotational.c", ("F[i] = n * r[i]", "F[i] = -n * r[i]"),
                    "displacement along x of node 1", "the energy's derivative is")

    def test_sign_in_the_tangent(self):
        self.broken("corotational.c", ("spin(-1, F + b", "spin(1, F + b"), "differences of F give")

    def test_no_geometric_stiffness_by_moments(self):
        self.broken("corotational.c", ("add(N, N, 3, 1, Pk, HP, K);", ""), "rotation about",
                    "differences of F give")

    def test_rotations_in_the_wrong_axes(self):
        self.broken("corotational.c", ("- S[k][i]) / 2", "- S[k][3 * (i % 3) + i / 3]) / 2"),
                    "rotation about z of node 2", "the energy's derivative is")

    def test_energy_that_turning_changes(self):
        self.broken("ancf.c", ("(size - 1) * (size - 1)", "(first[0] - 1) * (first[0] - 1)"),
                    "a rigid rotation", "measure strains in axes that rotate with the element")

    def test_energy_of_one_end(self):
        self.broken("ancf.c", ("carried(x[1].R, t, dt, y[1])", "carried(x[0].R, t, dt, y[1])"),
                    "with its nodes exchanged")

    def test_axes_exchanged(self):
        """No contradiction in itself: another beam, which verify sees."""
        made = self.altered("ancf.c", ("ky = dot(section_y", "ky = dot(section_z"),
                            ("kz = dot(section_z", "kz = dot(section_y"))
        record = self.folder / "v.json"
        self.answered("verify", "--element", made, "-f", "ancf", "-k",
                      "tapered_cantilever/default", "--json", record, code=1)
        wrong = {v["quantity"] for v in read_json(record)["verdicts"]
                 if v["verdict"] == "wrong limit"}
        self.assertEqual(wrong, {"deflection_y", "deflection_z", "slope_y", "slope_z"})
