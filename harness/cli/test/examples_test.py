"""Every example of a formulation must be short, compile with the commands of an external author, and pass its cases."""
import re
import shutil
import subprocess
import unittest

from harness.cli.test.plugin import EXAMPLES, WARNINGS, PluginTest, compile_shared
from harness.tools.kit.program import ROOT, read_json

STATICS_AND_FREQUENCIES = ("tapered_cantilever", "deep_beam", "tip_body", "sprung_beam",
                           "loaded_cantilever", "elastica", "snap_through", "right_angle_frame")


# A short cantilever with a length of 1 m: E Iz = 5e5 N m2, G A k = 1e7 N.
SHORT = """
beamwork: 1
sections:
  bar: {constants: {A: 0.01, Iy: 1e-5, Iz: 5e-6, It: 1e-5, D: [2e-4, 0, 0, 0, 1e-4, 0, 0, 0, 0]},
        young: 1e11, shear_modulus: 5e10}
nodes:
  wall: {at: [0, 0, 0], hold: all}
  tip: {at: [1, 0, 0]}
members:
  bar: {from: wall, to: tip, section: bar, y: [0, 1, 0]}
loads:
  push: {force: [0, 100, 0], on: tip}
analyses:
  bent: {linear: {}}
quantities:
  tip: {displacement: {analysis: bent, node: tip, component: uy}, unit: m}
"""


class Judged:
    cases, ending, most = (), "c", 200

    @classmethod
    def setUpClass(cls):
        cls.object = compile_shared(EXAMPLES / f"{cls.example}.c",
                                    cls.class_folder() / f"{cls.example}.so", *WARNINGS)

    def test_short(self):
        name = f"{self.example}.{self.ending}"
        lines = (EXAMPLES / name).read_text(encoding="utf-8").splitlines()
        table = (EXAMPLES / "README.md").read_text(encoding="utf-8")
        promised = re.search(rf"^\| `{re.escape(name)}` \| (\d+) \|", table, re.MULTILINE)
        self.assertLessEqual(len(lines), int(promised[1]))
        self.assertLessEqual(len(lines), self.most)
        self.assertEqual([line for line in lines if line.startswith('#include "')],
                         [] if self.ending == "f90" else ['#include "elements/element.h"'])

    def test_keeps_the_contract(self):
        self.answered("element-test", "--element", self.object)

    def test_judged_like_the_others(self):
        record = self.folder / "v.json"
        self.assertGreaterEqual(len(self.cases), 8)
        self.answered("verify", "--element", self.object, "-f", self.name(), "-k",
                      " or ".join(f"{case}/default" for case in self.cases), "--json", record)
        found = [v for v in read_json(record)["verdicts"]
                 if v["verdict"] not in ("skip", "no truth", "other model")]
        self.assertEqual({v["case"] for v in found} - {"shear_elastica"}, set(self.cases))
        self.assertEqual([v for v in found if v["verdict"] != "pass"], [])

    def name(self):
        return getattr(self, "loaded", self.example)

    def values(self, made, name, *arguments):
        record = self.record("solve", *arguments, "--element", made, "-f", name)
        return [q["value"] for q in record["quantities"] if q["value"] is not None]

    def same_values(self, other, name, case):
        own, theirs = (self.values(*of, case, "-n", "4")
                       for of in ((self.object, self.name()), (other, name)))
        self.assertGreater(len(own), 2)
        for one, same in zip(own, theirs, strict=True):
            self.assertAlmostEqual(one / same, 1, delta=1e-9)

    def short_cantilever(self):
        (self.folder / "short.yaml").write_text(SHORT, encoding="utf-8")
        (tip,), force, shear, bending = self.values(
            self.object, self.name(), "--scene", self.folder / "short.yaml", "-n", "1"), 100, 1e7, 5e5
        self.assertAlmostEqual(tip, force / (3 * bending) + force / shear, delta=1e-12 * tip)


class Timoshenko(Judged, PluginTest):
    example = "timoshenko"
    cases = (*STATICS_AND_FREQUENCIES, "weighted_column", "bend_45")


class Corotational(Judged, PluginTest):
    example = "corotational"
    cases = (*STATICS_AND_FREQUENCIES, "weighted_column", "lateral_buckling")

    def test_converges_as_the_others(self):
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


class Legendre(Judged, PluginTest):
    example, most = "legendre", 380
    cases = Timoshenko.cases

    def test_converges_exponentially(self):
        errors = []
        for order in range(2, 7):
            (tip, *_) = self.values(self.object, f"legendre:order={order}", "elastica", "-n", "1", "-k", "w_over_L")
            errors.append(abs(tip / 0.30172077577 - 1))
        for more, fewer in zip(errors, errors[1:]):
            self.assertLess(fewer, more / 4)
        self.assertLess(errors[-1], 1e-8)


class Cubic(Judged, PluginTest):
    example, most = "cubic", 330
    cases = Corotational.cases

    def test_beside_the_paper(self):
        """Nijenhuis et al. (2024), section 4.1: with two elements, C_xx must be within 0.7 % and C_zz within 0.2 % of
        the converged values; at a deflection of half the length, C_zz within 1 %."""
        for deflection, bounds in (("0.015", (0.007, 0.002)), ("0.05", (0.007, 0.01))):
            two, many = (self.values(self.object, "cubic", "sheet_cantilever", "-n", n, "-s", f"tip_deflection={deflection}",
                                     "-k", "=C_xx or =C_zz") for n in ("2", "8"))
            for one, limit, bound in zip(two, many, bounds):
                self.assertLess(abs(one / limit - 1), bound)


@unittest.skipUnless(shutil.which("gfortran"), "needs gfortran")
class Uel(Judged, PluginTest):
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
        self.same_values(other, "corotational", "lee_frame")


@unittest.skipUnless(shutil.which("g++"), "needs g++")
class Frame(Judged, PluginTest):
    example, ending, most = "frame", "cpp", 240
    cases = Corotational.cases

    @classmethod
    def setUpClass(cls):
        cls.object = cls.class_folder() / "frame.so"
        cls.compile("g++", cls.object)

    @classmethod
    def compile(cls, compiler, made):
        subprocess.run([compiler, "-std=c++17", "-O1", *WARNINGS, "-Wpedantic",
                        "-fvisibility=hidden", "-shared", "-fPIC", "-I", ROOT,
                        EXAMPLES / "frame.cpp", "-o", made], check=True)

    def test_clang(self):
        if shutil.which("clang++-19") is None:
            self.skipTest("needs clang++-19")
        made = self.folder / "frame.so"
        self.compile("clang++-19", made)
        self.same_values(made, "frame", "lee_frame")

    def test_the_beam_of_the_other_example(self):
        other = compile_shared(EXAMPLES / "corotational.c", self.folder / "other.so")
        for case in ("lee_frame", "bend_45"):
            self.same_values(other, "corotational", case)

    def test_closed_form(self):
        """One element must give the deflection of a Timoshenko cantilever: F L^3/(3 E I) + F L/(G A k)."""
        self.short_cantilever()


@unittest.skipUnless(shutil.which("g++"), "needs g++")
class OpenSeesLike(Judged, PluginTest):
    example, ending, most = "opensees_like", "cpp", 360
    cases = ("tapered_cantilever", "deep_beam", "tip_body", "sprung_beam", "elastica", "snap_through", "roll_up",
             "release")

    @classmethod
    def setUpClass(cls):
        cls.object = cls.class_folder() / "opensees_like.so"
        cls.compile("g++", cls.object)

    @classmethod
    def compile(cls, compiler, made, *options):
        subprocess.run([compiler, "-std=c++17", "-O1", *WARNINGS, "-Wpedantic", *options, "-shared", "-fPIC", "-I", ROOT,
                        EXAMPLES / "opensees_like.cpp", "-o", made], check=True)

    def test_clang(self):
        if shutil.which("clang++-19") is None:
            self.skipTest("needs clang++-19")
        made = self.folder / "opensees_like.so"
        self.compile("clang++-19", made)
        self.same_values(made, self.example, "elastica")

    def test_kratos(self):
        made = self.folder / "kratos_like.so"
        self.compile("g++", made, "-DELEMENT=FromKratos")
        for case in ("elastica", "snap_through"):
            self.same_values(made, self.example, case)

    def test_state_is_committed(self):
        one, many = (self.bent(steps) for steps in (2, 9))
        for few, more in zip(one, many, strict=True):
            self.assertAlmostEqual(few / more, 1, delta=1e-9)

    def bent(self, steps):
        text = SHORT.replace("force: [0, 100, 0]", "moment: [0, 2e6, 1.5e6]")
        text = text.replace("linear: {}", f"static: {{stations: [1], steps: {steps}}}")
        path = self.folder / "bent.yaml"
        path.write_text(text + "omit: [trapeze, wagner_moments, wagner_torque]\n", encoding="utf-8")
        return self.values(self.object, self.example, "--scene", path, "-n", "8")

    def test_closed_form(self):
        self.short_cantilever()


@unittest.skipUnless(shutil.which("gfortran"), "needs gfortran")
class Fortran(Judged, PluginTest):
    example, ending, most = "timoshenko", "f90", 250
    loaded, cases = "timoshenko_f90", Timoshenko.cases

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        cls.object = folder / "timoshenko_f90.so"
        subprocess.run(["gfortran", "-std=f2018", "-O1", *WARNINGS, "-Wno-unused-dummy-argument",
                        "-shared", "-fPIC", "-J", folder, EXAMPLES / "timoshenko.f90", "-o",
                        cls.object], check=True)

    def test_the_beam_of_the_other_example(self):
        other = compile_shared(EXAMPLES / "timoshenko.c", self.folder / "other.so")
        for case in ("lee_frame", "bend_45"):
            self.same_values(other, "timoshenko", case)

    def test_closed_form(self):
        self.short_cantilever()


class Planted(PluginTest):
    def broken(self, example, change, *words):
        made = self.altered(example, change)
        told = " ".join(self.answered("element-test", "--element", made, code=1).stdout.split())
        for word in words:
            self.assertIn(word, told)

    def test_sign_of_forces(self):
        self.broken("corotational.c", ("F[i] = n * r[i]", "F[i] = -n * r[i]"),
                    "displacement along x of node 1", "the derivative of the energy is")

    def test_sign_in_the_tangent(self):
        self.broken("corotational.c", ("spin(-1, F + b", "spin(1, F + b"), "differences of F give")

    def test_no_geometric_stiffness_by_moments(self):
        self.broken("corotational.c", ("add(N, N, 3, 1, Pk, HP, K);", ""), "rotation about",
                    "differences of F give")

    def test_rotations_in_the_wrong_axes(self):
        self.broken("corotational.c", ("- S[k][i]) / 2", "- S[k][3 * (i % 3) + i / 3]) / 2"),
                    "rotation about z of node 2", "the derivative of the energy is")

    def test_energy_that_turning_changes(self):
        self.broken("ancf.c", ("(size - 1) * (size - 1)", "(first[0] - 1) * (first[0] - 1)"),
                    "a rigid rotation", "measure strains in axes that rotate with the element")

    def test_energy_of_one_end(self):
        self.broken("ancf.c", ("carried(x[1].R, t, dt, y[1])", "carried(x[0].R, t, dt, y[1])"),
                    "if its nodes are exchanged")

    def test_axes_exchanged(self):
        made = self.altered("ancf.c", ("ky = dot(section_y", "ky = dot(section_z"),
                            ("kz = dot(section_z", "kz = dot(section_y"))
        record = self.folder / "v.json"
        self.answered("verify", "--element", made, "-f", "ancf", "-k",
                      "tapered_cantilever/default", "--json", record, code=1)
        wrong = {v["quantity"] for v in read_json(record)["verdicts"]
                 if v["verdict"] == "wrong limit"}
        self.assertEqual(wrong, {"deflection_y", "deflection_z", "slope_y", "slope_z"})
