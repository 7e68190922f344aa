"""Tables of springs, motions and loads in CSV files."""
import json
import unittest

from cases.format.test.scene_case import SceneCase
from harness.tools.kit.program import run

SHAKEN = """\
beamwork: 1
sections:
  tube: {tube: {diameter: 20e-3, thickness: 1e-3}, young: 70e9, shear_modulus: 26e9, density: 2700}
nodes:
  base: {at: [0, 0, 0], hold: [ux, uz, rx, ry, rz], drive: {uy: shake}}
  tip:  {at: [0.1, 0, 0], mass: 0.1}
members:
  arm: {from: base, to: tip, section: tube, y: [0, 1, 0]}
springs:
  stop: {to: tip, tables: {uz: STOP}}
motions:
  shake: {unit: m, table: SHAKE}
loads:
  push: {force: [0, 0, 10], on: tip, table: PUSH}
analyses:
  run: {motion: {stations: [0.1, 0.2, 0.35], step: 0.005}}
quantities:
  half: {displacement: {analysis: run, node: base, component: uy, at: 0.1}}
  end:  {displacement: {analysis: run, node: tip, component: uy}}
  side: {displacement: {analysis: run, node: tip, component: uz}}
omit: [trapeze, wagner_moments, wagner_torque]
"""
INLINE = {"SHAKE": "{at: [0, 0.1, 0.3], value: [0, 1e-3, -2.5e-4]}", "PUSH": "{at: [0.05, 0.3], value: [0, 2]}",
          "STOP": "{at: [-1, 1e-6, 1], value: [0, 0, 2e4]}"}
FILES = {"SHAKE": "{file: in/drive.csv, at: t, value: ux}", "PUSH": "{value: 3, file: push.txt, at: 1}",
         "STOP": "{file: stop.csv, at: gap, value: force}"}
CSV = {"in/drive.csv": "\ufeff# recorded\n\nno,  t , ux\r\n1,0,0\r\n\r\n# here\n2, .1, 1e-3\n3,0.3,-2.5D-4",
       "push.txt": "  # t, name, factor\n  0.05 a 0\n0.3 b 2\n", "stop.csv": "\"gap\";force\n-1;0\n1e-6;0\n1;2e4\n"}


class TableFileTest(SceneCase):

    def filled(self, tables, name="scene.yaml"):
        text = SHAKEN
        for mark, table in tables.items():
            text = text.replace(mark, table)
        return self.scene(text, name)

    def files(self):
        (self.folder / "in").mkdir(exist_ok=True)
        for name, text in CSV.items():
            (self.folder / name).write_text(text, encoding="utf-8")

    def test_same_as_inline(self):
        self.files()
        inline, read = self.filled(INLINE, "inline.yaml"), self.filled(FILES, "read.yaml")
        texts = [self.answered("scene", "--scene", p).stdout.replace(p.stem, "NAME") for p in (inline, read)]
        self.assertEqual(*texts)
        got, same = (self.same_again(p, "-f", "collocation", "-n", 1) for p in (read, inline))
        self.assertEqual(got, same)
        self.assertAlmostEqual(got["half"], 1e-3, delta=1e-15)

    def test_scene_elsewhere(self):
        self.files()
        path = self.filled({**FILES, "STOP": f"{{file: {self.folder}/stop.csv, at: 1, value: 2}}"})
        done = run("solve", "--scene", path, "-f", "collocation", "-n", 1, cwd="/")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_mistakes(self):
        for text, told in (
                ("t,ux\n0,0\n0.1,x\n", "drive.csv:3: 'x' is not a number"),
                ("t,ux\n0,0\n0.1,nan\n", "drive.csv:3: 'nan' is not a number"),
                ("t,ux\n0,0\n0.1\n", "drive.csv:3: the number of columns differs from that in the first row"),
                ("t,ux\n0,0\n\n0,1\n", "drive.csv:4: the values of 'at' do not ascend at 0"),
                ("t,ux\n0,0\n", "drive.csv:2: the file has fewer than two rows of numbers"),
                ("", "drive.csv:1: the file has fewer than two rows of numbers"),
                ("t,uy\n0,0\n1,1\n", "drive.csv:1: column 'ux' does not exist; the columns are t, uy"),
                ("t,ux,ux\n0,0,0\n1,1,1\n", "drive.csv:1: two columns have the name 'ux'"),
                ("0,0\n1,1\n", "drive.csv:1: column 't' does not exist, because the file has no header; give the number of the column, 1 to 2"),
                ("t;ux\n0,5;0\n1,5;1\n", "drive.csv:2: '5;0' is not a number"),
                ("t,ux\n" + "".join(f"{i},0\n" for i in range(10001)), "drive.csv:10002: the table has more than 10000 rows"),
                ("t,ux\n0," + 9000 * " " + "0\n", "drive.csv:2: a line has more than 8000 characters")):
            with self.subTest(text[:30]):
                self.files()
                (self.folder / "in/drive.csv").write_text(text, encoding="utf-8")
                done = run("scene", "--scene", self.filled(FILES))
                self.assertEqual(done.returncode, 2)
                self.assertIn(told, done.stderr)
                self.assertIn("scene.yaml:12:", done.stderr)

    def test_mixed_row(self):
        self.files()
        (self.folder / "in/drive.csv").write_text("0,nan\n1,0\n2,1\n", encoding="utf-8")
        done = run("scene", "--scene", self.filled({**FILES, "SHAKE": "{file: in/drive.csv, at: 1, value: 2}"}))
        self.assertIn("drive.csv:1: 'nan' is not a number", done.stderr)

    def test_misused(self):
        self.files()
        for table, told in (("{file: none.csv, at: t, value: ux}", "none.csv cannot be read: No such file"),
                            ("{file: in, at: t, value: ux}", "cannot be read"),
                            ("{file: in/drive.csv, at: t}", "with 'file', give columns of the file"),
                            ("{file: in/drive.csv, at: [0, 1], value: ux}", "with 'file', give columns of the file"),
                            ("{file: [a], at: t, value: ux}", "file: give the path of a CSV file"),
                            ("{at: t, value: ux}", "a list of numbers"),
                            ("{file: in/drive.csv, at: t, value: ux, unit: mm}", "has no key 'unit'")):
            with self.subTest(table):
                done = run("scene", "--scene", self.filled({**FILES, "SHAKE": table}))
                self.assertEqual(done.returncode, 2)
                self.assertIn(told, done.stderr)
                self.assertIn("scene.yaml:12:", done.stderr)

    def test_listed(self):
        schema = json.loads(self.answered("scene", "--schema").stdout)
        self.assertIn("CSV", json.dumps(schema))


if __name__ == "__main__":
    unittest.main()
