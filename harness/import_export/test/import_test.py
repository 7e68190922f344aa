"""The import must convert names, units, parameters and axes, and report all errors with their lines. `verify` must
judge imported values and read only files that are complete."""
import json
import pathlib
import unittest

import h5py

from harness.tools.kit.program import ROOT, ProgramTest, run

HEAD = """# beamwork-import: 1
# program: MBDyn 1.7.3, 3-node   # as legends show it
# case: sheet_cantilever; warping=0; trapeze=0; shear_factor=0.8333333333333334
"""
COLUMNS = "quantity, unit, elements, unknowns, seconds, x, value, uncertainty\n"
ROWS = "C_xx, mm/N, 2, 24, 2.1e-3, , 3.9408e-4,\nC_xx, mm/N, 4, 48, 3.3e-3, , 3.97064e-4, 1e-9\n"
FLYING = """beamwork: 1
sections: {rod: {rectangle: {width: 0.02, thickness: 0.01}, young: 70e9, shear_modulus: 26e9, density: 2700}}
nodes: {a: {at: [0, 0, 0]}, b: {at: [1, 0, 0]}}
members: {rod: {from: a, to: b, section: rod, y: [0, 1, 0]}}
analyses: {fly: {motion: {stations: [1], step: 0.1, start: {spin: [0, 0, 1]}}}}
quantities:
  vx: {rate: {analysis: fly, node: b, component: ux}}
  vy: {rate: {analysis: fly, node: b, component: uy}}
  Lx: {momentum: {analysis: fly, component: lx}}
  Ly: {momentum: {analysis: fly, component: ly}}
  pz: {momentum: {analysis: fly, component: pz}}
  kinetic: {energy: {analysis: fly, of: kinetic}}
  top_x: {displacement: {analysis: fly, node: b, component: ux, take: max}}
  top_y: {displacement: {analysis: fly, node: b, component: uy, take: max}}
  low_x: {displacement: {analysis: fly, node: b, component: ux, take: min}}
  low_y: {displacement: {analysis: fly, node: b, component: uy, take: min}}
  R_xy: {orientation: {analysis: fly, node: b, row: x, column: y}}
  R_yx: {orientation: {analysis: fly, node: b, row: y, column: x}}
  rise: {displacement: {analysis: fly, node: b, component: ux, take: crossing}, when: {level: 0.1, direction: rising}}
  fall: {displacement: {analysis: fly, node: b, component: uy, take: crossing}, when: {level: -0.1, direction: falling}}
"""
DATA = pathlib.Path(__file__).parent / "data"
MAPS = pathlib.Path(__file__).parents[1]
SELECT = "sheet_cantilever and C_xx and shear_factor"


class Import(ProgramTest):

    def read(self, text, status=0, name="theirs.csv"):
        path = self.folder / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return self.answered("import", path, "-o", self.folder / "theirs.h5", code=status)

    def stored(self, case="sheet_cantilever", table="imports"):
        with h5py.File(self.folder / "theirs.h5") as file:
            rows = file["cases"][case][table][()]
            return [dict(zip(rows.dtype.names, row)) for row in rows]

    def test_units_are_converted_and_the_factor_is_stored(self):
        for unit, factor in (("mm/N", 1e-3), ("m/N", 1), ("m/kN", 1e-3), ("um/mN", 1e-3),
                             ("mm/(kN)", 1e-6)):
            self.read(f"{HEAD}{COLUMNS}C_xx, {unit}, 2, , , , 2.5,\n")
            row, = self.stored()
            self.assertAlmostEqual(row["value"] / (2.5 * factor), 1, delta=1e-14)
            self.assertAlmostEqual(row["factor"] / factor, 1, delta=1e-14)
            self.assertEqual(row["file_unit"].decode(), unit)
            self.assertEqual(row["line"], 5)

    def test_the_schema_of_results(self):
        self.read(HEAD + COLUMNS + ROWS)
        series, = self.stored(table="series")
        self.assertEqual(series["formulation"], b"MBDyn 1.7.3, 3-node")
        self.assertTrue(series["imported"].endswith(b"theirs.csv"))
        self.assertEqual([(c["elements"], c["free"]) for c in self.stored(table="cells")],
                         [(2, 24), (4, 48)])
        values = [q["value"] for q in self.stored(table="quantities") if q["quantity"] == b"C_xx"]
        self.assertEqual(values, [3.9408e-4 * 1e-3, 3.97064e-4 * 1e-3])

    def test_all_mistakes_at_once(self):
        text = """# beamwork-import: 1
# program: MBDyn
# case: sheet_cantilever; warpin=0
# modle: solid
"""
        said = self.read(text + COLUMNS, 2).stderr
        self.assertIn("theirs.csv:4: unknown header 'modle'; did you mean 'model'?", said)
        bad = {
            "C_xy, m/N, 2,,,, 1,": "did you mean 'C_xx'",
            "C_xx, m/Nm, 2,,,, 1,": "unit 'm/Nm' is unknown",
            "C_xx, N, 2,,,, 1,": "unit 'N' cannot be converted to 'm/N'",
            "C_xx_curve, m/N, 2,,,, 1,": "is a curve, so each value requires its position x",
            "C_zz, m/N, 2,,, 3, 1,": "is a single value, not a curve",
            "C_zz, m/N, 0,,,, 1,": "give a whole number", "C_zz, m/N, 2,,,, nan,": "is not a number",
            "C_zz, m/N, 3,,,,,": "the field 'value' is missing or empty",
            "C_thz_Mz, rad/(N m), 2,,,, 1,": "the convention for moments",
            "C_zz, m/N, 4,,,, 1, -1": "uncertainty is negative"
        }
        said = self.read(HEAD + COLUMNS + "\n".join(bad) + "\n", 2).stderr.splitlines()
        self.assertEqual(len(said), len(bad) + 1)
        for i, (line, (row, words)) in enumerate(zip(said, bad.items())):
            self.assertIn(f"theirs.csv:{5 + i}: ", line, row)
            self.assertIn(words, line, row)
        self.assertFalse((self.folder / "theirs.h5").exists())

    def test_headers(self):
        for change, words in ((("sheet_cantilever", "sheet_cantilevr"),
                               "did you mean 'sheet_cantilever'"), (("warping", "warpin"),
                                                                    "did you mean 'warping'"),
                              (("import: 1", "import: 2"), "version '2'"),
                              (("MBDyn 1.7.3, 3-node ", "beamw "),
                               "has the name of a formulation of beamwork"), (("# program", "# progrm"),
                                                                     "did you mean 'program'"),
                              (("# case", "# axes: x=y y=y z=z\n# case"), "are not valid; give the program's axis"),
                              (("# case", "# convention: symmetrised\n# case"),
                               "the moments of the case are spatial")):
            self.assertIn(words, self.read(HEAD.replace(*change) + COLUMNS + ROWS, 2).stderr)
        self.assertIn("UTF-8",
                      self.read(HEAD.replace("MBDyn", "MB\x1bDyn") + COLUMNS + ROWS, 2).stderr)
        said = self.read(bytes(range(256)) * 20, 2).stderr.splitlines()
        self.assertIn("theirs.csv:1: the line is not UTF-8 text; give a CSV file", said[0])
        self.assertEqual(len(said), 2, "one error, and that nothing was imported")
        self.assertIn("given again", self.read(HEAD + COLUMNS + ROWS + ROWS, 2).stderr)

    def test_axes(self):
        self.read(HEAD + "# axes: x=-y y=x z=z\n" + COLUMNS +
                  "C_ux_Fx, m/N, 2,,,, 3,\nC_ux_Fy, m/N, 2,,,, 4,\n")
        found = {row["quantity"]: (row["value"], row["factor"]) for row in self.stored()}
        self.assertEqual(found, {b"C_uy_Fy": (3, 1), b"C_uy_Fx": (-4, -1)})

    def test_mirrored_axes(self):
        self.read(HEAD + "# axes: x=x y=-y z=z\n# convention: spatial\n" + COLUMNS +
                  "C_ux_Mz, 1/N, 2,,,, 3,\nC_uy_Mz, 1/N, 2,,,, 4,\nC_thz_Mz, rad/(N m), 2,,,, 5,\n")
        self.assertEqual({row["quantity"]: row["value"]
                          for row in self.stored()},
                         {b"C_ux_Mz": -3, b"C_uy_Mz": 4, b"C_thz_Mz": 5})

    def test_a_motion_in_other_axes(self):
        (self.folder / "fly.yaml").write_text(FLYING, encoding="utf-8")
        rows = "".join(f"{name}, {unit}, 2,,,, {value},\n" for name, unit, value in (
            ("vx", "mm/s", 3), ("vy", "mm/s", 4), ("Ly", "kg m^2/s", 5), ("pz", "N s", 6),
            ("kinetic", "mJ", 7), ("top_y", "m", 8), ("low_y", "m", 9), ("R_xy", "1", 0.5),
            ("rise", "ms", 10),
            ("top_x", "m", 11)))
        self.read("# beamwork-import: 1\n# program: other\n# case: fly.yaml\n"
                  "# axes: x=-y y=x z=z\n" + COLUMNS + rows)
        self.assertEqual({row["quantity"].decode(): row["value"] for row in self.stored("fly")},
                         {"vy": -0.003, "vx": 0.004, "Lx": 5, "pz": 6, "kinetic": 0.007, "top_x": 8,
                          "low_x": 9, "R_yx": -0.5, "fall": 0.01,
                          "low_y": -11})

    def test_two_programs_in_one_file(self):
        self.read(HEAD + COLUMNS + ROWS + "# program: other\n" + ROWS)
        self.assertEqual({s["formulation"]
                          for s in self.stored(table="series")}, {b"MBDyn 1.7.3, 3-node", b"other"})

    def test_a_scene_of_ones_own_and_a_solid(self):
        leaf = ROOT / "cases/examples/leaf_spring_guide.yaml"
        self.read(
            f"# beamwork-import: 1\n# program: CalculiX\n# model: solid\n# case: {leaf}\nquantity,unit,elements,value\nk_drive,N/mm,320,2.85\n"
        )
        row, = self.stored("leaf_spring_guide")
        self.assertAlmostEqual(row["value"], 2850, delta=1e-9)
        done = run("verify", "--scene", str(leaf), "-f", "beamw", "--imported",
                   self.folder / "theirs.h5")
        line, = [x for x in done.stdout.splitlines() if x.startswith("    CalculiX")]
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("no truth; +8.59 % from another model", line)
        self.refused(2, "no imported value has a verdict", "verify", "--scene", str(leaf), "-f", "beamw", "--imported",
                     self.folder / "theirs.h5", "--imported-must-pass")

    def test_beside_informs_and_gates_where_asked(self):
        self.read(HEAD + COLUMNS + ROWS.replace("3.9", "4.9"))
        beside = ("verify", "-k", SELECT, "-f", "collocation", "--imported",
                  self.folder / "theirs.h5")
        informs, gates = run(*beside), run(*beside, "--imported-must-pass")
        for done in (informs, gates):
            self.assertIn("MBDyn 1.7.3, 3-node", done.stdout)
        self.assertEqual(informs.returncode, 0, informs.stderr)
        self.assertEqual(gates.returncode, 1, gates.stdout)
        elsewhere = run("verify", "-k", "elastica/default", "-f", "collocation", "--imported",
                        self.folder / "theirs.h5")
        self.assertEqual(elsewhere.returncode, 0)
        self.assertIn("theirs.h5: no quantity of this file was run, because the file belongs to sheet_cantilever/",
                      elsewhere.stderr)
        self.assertEqual(len(elsewhere.stderr.splitlines()), 1, elsewhere.stderr)

    def beside(self, text, name, *options):
        self.read(text)
        given = ["--imported", self.folder / "theirs.h5"] if text else []
        return run("verify", "-k", "elastica and w_over_L and not shear", "-f", "collocation", *given, "-o",
                   self.folder / name, *options)

    def test_what_is_missing_is_gone(self):
        values = ((4, 0.30216), (8, 0.30183), (16, 0.301748), (32, 0.3017276))
        text = "# beamwork-import: 1\n# program: {}\n# version: {}\n# case: elastica\nquantity, unit, elements, value\n"
        rows = [f"w_over_L, 1, {n}, {value}\n" for n, value in values]
        whole = text.format("mine", "4.2") + "".join(rows)
        old, table = self.folder / "old.h5", self.folder / "old.csv"
        self.assertEqual(self.beside(whole, "old.h5").returncode, 0)
        self.answered("compare", old, "-o", table)
        for name, new, code, words in (
            ("version", text.format("mine", "4.3") + "".join(rows), 0, ""),
            ("name", text.format("mine 4.3", "") + "".join(rows), 1, "was the program renamed to 'mine 4.3'? If so, write the version in '# version:'"),
            ("mesh", text.format("mine", "4.2") + "".join(rows[:-1]), 1, "/mine n=32")):
            done = self.beside(new, "new.h5", "--imported-must-pass", "--not-worse-than", table)
            self.assertEqual(done.returncode, code, (name, done.stdout))
            self.assertIn(words, " ".join(done.stdout.split()))
            for former in (old, table):
                done = run("compare", former, self.folder / "new.h5")
                self.assertEqual(done.returncode, code, (name, done.stdout))
                self.assertIn(words, done.stdout)
                self.assertEqual(done.stdout.count("gone     "), code, done.stdout)
        worse = [f"w_over_L, 1, {n}, {0.30172077577 + 1.1 * (value - 0.30172077577)}\n" for n, value in values]
        done = self.beside(text.format("mine", "4.2") + "".join(worse) + "w_over_L, 1, 64, 0.3017225\n", "new.h5",
                           "--imported-must-pass", "--not-worse-than", table)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("/mine: largest error", " ".join(done.stdout.split()))
        select = ("verify", "-k", "elastica and w_over_L and not shear", "-f", "collocation")
        done = run(*select, "--not-worse-than", table, "-o", self.folder / "new.h5")
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("/mine: gone: add the file with --imported", " ".join(done.stdout.split()))
        self.assertEqual(run("compare", old, self.folder / "new.h5").returncode, 1)
        self.refused(2, "--imported-must-pass requires imported results; add --imported theirs.h5", *select,
                     "--imported-must-pass")
        self.refused(2, "no quantity of", "verify", "-k", "roll_up/default", "-f", "collocation", "--imported",
                     self.folder / "theirs.h5", "--imported-must-pass")
        self.refused(2, "no imported value has a verdict", "verify", "-k", "elastica/default and u_over_L", "-f",
                     "collocation", "--imported", self.folder / "theirs.h5", "--imported-must-pass")

    def test_quantities_on_their_own_meshes(self):
        self.read("# beamwork-import: 1\n# program: mine\n# case: elastica\nquantity, unit, elements, value\n" +
                  "".join(f"w_over_L, 1, {n}, {v}\n" for n, v in ((4, 0.30216), (8, 0.30183), (16, 0.301748), (32, 0.3017276))) +
                  "".join(f"theta, rad, {n}, {0.46135195119 + 0.04 / n**2}\n" for n in (2, 4, 8, 16)))
        done = run("verify", "-k", "elastica/default", "-f", "collocation", "--imported", self.folder / "theirs.h5",
                   "--imported-must-pass", "-o", self.folder / "found.h5", "--markdown", self.folder / "found.md")
        self.assertEqual(done.returncode, 0, done.stdout)
        omitted = (self.folder / "found.md").read_text(encoding="utf-8").partition("Omitted by the scenes")[2]
        self.assertEqual([line for line in omitted.splitlines() if line.startswith("- ")], ["- elastica: trapeze", "- shear_elastica: trapeze"])
        self.assertRegex(done.stdout, r"theta(.*\n)*?.* mine .* pass")
        self.answered("compare", self.folder / "found.h5", "-o", self.folder / "found.csv")
        self.assertRegex((self.folder / "found.csv").read_text(), "mine.*theta=0.4613")
        self.read("# beamwork-import: 1\n# program: mine\n# case: elastica\nquantity, unit, elements, value\n"
                  "w_over_L, 1, 32, 0.3017276\ntheta, rad, 4, 0.4619\ntheta, rad, 8, 0.4615075\n")
        done = run("verify", "-k", "elastica/default", "-f", "collocation", "--imported", self.folder / "theirs.h5",
                   "--imported-must-pass")
        self.assertIn("finest mesh, n = 8: 0.4615", " ".join(done.stdout.split()))

    def test_several_beside(self):
        self.read(
            HEAD.replace("MBDyn 1.7.3, 3-node", "rival") + COLUMNS + ROWS +
            "# case: elastica\nw_over_L, 1, 2,,,, 1,\n")
        (self.folder / "theirs.h5").rename(self.folder / "rivals.h5")
        self.read(HEAD + COLUMNS + ROWS)
        select = ("verify", "-k", SELECT, "-f", "collocation")
        done = run(*select, "--imported", self.folder / "theirs.h5", "--imported",
                   self.folder / "rivals.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("MBDyn 1.7.3, 3-node", "rival"):
            self.assertEqual(done.stdout.count("\n    " + name), 1, done.stdout)
        self.assertIn(
            "rivals.h5: 1 of 2 series belong to cases or parameters that were not run; the first is elastica/default/rival",
            done.stderr)
        (self.folder / "copy.h5").write_bytes((self.folder / "theirs.h5").read_bytes())
        self.refused(2, "have already been read from another file", *select, "--imported",
                     self.folder / "theirs.h5", "--imported", self.folder / "copy.h5")
        self.refused(2, "is given twice; give it only once", *select, "--imported",
                     self.folder / "theirs.h5", "--imported", self.folder / "theirs.h5")
        self.refused(2, "would overwrite", *select, "--imported", self.folder / "copy.h5", "--imported",
                     self.folder / "theirs.h5", "-o", self.folder / "theirs.h5")

    def test_mistakes_as_json(self):
        files = {
            "good.csv": HEAD + COLUMNS + ROWS, "bad.csv": HEAD + "# modle: solid\n" + COLUMNS + ROWS
        }
        for name, text in files.items():
            (self.folder / name).write_text(text, encoding="utf-8")
        paths = [self.folder / name for name in files]
        done = self.answered("import",
                             *paths,
                             "-o",
                             self.folder / "theirs.h5",
                             "--format",
                             "json",
                             code=2)
        decoder, text, found = json.JSONDecoder(), done.stdout.strip(), []
        while text:
            one, end = decoder.raw_decode(text)
            found.append(one)
            text = text[end:].strip()
        self.assertEqual([one["file"] for one in found], [str(path) for path in paths])
        self.assertEqual(
            [one["mistakes"] for one in found],
            [[], [{"line": 4, "column": 1, "text": "unknown header 'modle'; did you mean 'model'?"}]
             ])
        whole = self.answered("import",
                              paths[0],
                              "-o",
                              self.folder / "theirs.h5",
                              "--format",
                              "json",
                              code=0)
        self.assertEqual(json.loads(whole.stdout)["mistakes"], [])
        self.refused(2, "give text or json", "import", paths[0], "-o", self.folder / "theirs.h5",
                     "--format", "csv")

    def test_curves(self):
        self.read(HEAD + COLUMNS +
                  "C_xx_curve, mm/N, 4,,, 0.01, 29,\nC_xx_curve, mm/N, 4,,, 0.005, 14,\n")
        with h5py.File(self.folder / "theirs.h5") as file:
            case = file["cases"]["sheet_cantilever"]
            self.assertEqual(list(case["curve_x"]), [0.005, 0.01])
            self.assertEqual(list(case["curve_value"]), [14e-3, 29e-3])

    def test_nothing_is_believed_of_a_stored_import(self):
        self.read(HEAD + COLUMNS + ROWS)
        whole = (self.folder / "theirs.h5").read_bytes()
        for name, data in (("cut.h5", whole[:-100]), ("none.h5", b"")):
            (self.folder / name).write_bytes(data)
            done = run("verify", "-k", SELECT, "-f", "beamw", "--imported", self.folder / name)
            self.assertEqual(done.returncode, 4, done.stderr)
            self.assertIn(name, done.stderr)

    def mapped(self, name, *files, status=0):
        return self.answered("import",
                             *files,
                             "--map",
                             name,
                             "-o",
                             self.folder / "theirs.h5",
                             code=status)

    def test_files_of_mbdyn(self):
        """Files that MBDyn 1.7.3 wrote for data/mbdyn_sheet.mbd must be read without loss of digits."""
        self.mapped(MAPS / "mbdyn.yaml", DATA / "mbdyn_sheet.mov", DATA / "mbdyn_sheet.jnt")
        found = {row["quantity"].decode(): row["value"] for row in self.stored()}
        for name, value in (("u_x", 9.864219e-2 - 0.1), ("F_y", 3492.813), ("M_z", -172.2694)):
            self.assertAlmostEqual(found[name] / value, 1, delta=1e-12)
        done = run("verify", "-k", "sheet_cantilever and shear_factor and F_y", "-f", "collocation",
                   "--imported", self.folder / "theirs.h5")
        self.assertIn("  F_y [N], truth 3492.6925", done.stdout)
        self.assertRegex(done.stdout, r"(?m)^    MBDyn.* 3492\.813 ")

    def test_blocks_of_calculix(self):
        text = """
 displacements (vx,vy,vz) for set NTIP and time  0.5000000E+00

         4  1.000000E-01  0.000000E+00  0.000000E+00

 displacements (vx,vy,vz) for set NTIP and time  0.1000000E+01

         3  9.000000E+00  0.000000E+00  0.000000E+00
         4 -1.358000E+00  1.500000E+01  0.000000E+00

 total force (fx,fy,fz) for set NTIP and time  0.1000000E+01

       -1.000000D-10  3.600000E+03  0.000000E+00
"""
        path = self.folder / "job.dat"
        path.write_text(text, encoding="utf-8")
        self.mapped(MAPS / "calculix_dat.yaml", path)
        found = {row["quantity"].decode(): row["value"] for row in self.stored()}
        self.assertAlmostEqual(found["u_x"], -1.358e-3, delta=1e-15)
        self.assertEqual(found["F_y"], 3600)

    def test_mistakes_of_a_map(self):
        path = self.folder / "map.yaml"
        good = (MAPS / "mbdyn.yaml").read_text(encoding="utf-8")
        for change, words in (
            (("column: x", "colum: x"),
             "did you mean 'column'"), (("column: x", "column: ex"),
                                        "is not a column"), (("label: 9", "label: 7"), "no line of the files matches"),
            (("  u_x", "  u_xq"),
             "map.yaml:13: sheet_cantilever has no quantity 'u_xq'; did you mean 'u_x'"),
            (("unit: m,", "unit: kg,"), "cannot be converted"), (("elements: 4", "elements: four"),
                                                                 "is not a number")):
            path.write_text(good.replace(*change), encoding="utf-8")
            said = self.mapped(path, DATA / "mbdyn_sheet.mov", DATA / "mbdyn_sheet.jnt",
                               status=2).stderr
            self.assertRegex(said, r"map\.yaml:\d+: ")
            self.assertIn(words, said)

    def test_no_input_is_replaced(self):
        path = self.folder / "a.csv"
        path.write_text(HEAD + COLUMNS + ROWS, encoding="utf-8")
        self.refused(2, "would overwrite", "import", path, "-o", path)


if __name__ == "__main__":
    unittest.main()
