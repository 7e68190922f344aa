"""Every format carries the fields that `beamwork schema` tells, under the same names."""
import contextlib
import csv
import io
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import h5py

PROGRAM = os.path.abspath(os.environ.get("BEAMWORK", "build/beamwork"))
ROOT = pathlib.Path(__file__).resolve().parents[3]
JSON_ONLY = ("outcomes", "truths")
KINDS = {"int": "i4", "long": "i8", "double": "f8", "flag": "b1", "text": "S", "enum": "S"}


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False, timeout=120).stdout


class Schema(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.schema = json.loads(run("schema", "--format", "json"))
        cls.records = {r["table"]: r["fields"] for r in cls.schema["records"]}
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.results, cls.bench, cls.verdicts = (os.path.join(cls.folder.name, name) for name in ("results.h5", "bench.h5", "v.json"))
        run("verify", "-k", "lee_frame/default or elastica/default and collocation", "-o", cls.results, "--json", cls.verdicts)
        run("bench", "elastica", "-f", "collocation", "-n", "1,2", "-o", cls.bench)

    def names(self, table, keys=True, around=True):
        return [f["name"] for f in self.records[table] if (keys or not f["key"]) and (around or not f["said_around"])]

    def check_table(self, table, fields):
        """Names, types and units of the columns, in their order; texts begin where they should."""
        columns = table.dtype.names
        self.assertEqual(list(columns[:len(fields)]), [f["name"] for f in fields])
        self.assertEqual([u.decode() for u in table.attrs["units"]][:len(fields)], [f["unit"] for f in fields])
        self.assertEqual([s.decode() for s in table.attrs["summaries"]][:len(fields)], [f["summary"] for f in fields])
        self.assertEqual(len(table.attrs["units"]), len(columns))
        for f in fields:
            base, shape = table.dtype[f["name"]].base, table.dtype[f["name"]].shape
            self.assertTrue(base.str.lstrip("<|").startswith(KINDS[f["kind"]]) or f["kind"] == "flag" and base.kind == "b", f)
            self.assertEqual(shape, (6, 6) if f["count"] == 36 else ())
            if f["kind"] == "enum":
                self.assertLessEqual({word.decode() for word in table[f["name"]]}, set(f["words"]))

    def test_hdf5(self):
        for path in (self.results, self.bench):
            with h5py.File(path) as file:
                self.assertEqual((file.attrs["schema"].decode(), file.attrs["schema_version"]), (self.schema["schema"], self.schema["schema_version"]))
                for case in file["cases"].values():
                    for table, fields in self.records.items():
                        if table not in JSON_ONLY:
                            self.check_table(case[table], [f for f in fields if not f["said_around"]])

    def test_every_table_is_seen(self):
        """What the other tests walk over is not empty."""
        with h5py.File(self.results) as file:
            for table in self.records:
                if table not in (*JSON_ONLY, "timings", "agreements", "matrices"):
                    self.assertGreater(sum(len(case[table]) for case in file["cases"].values()), 0, table)
        with h5py.File(self.bench) as file:
            self.assertEqual(len(file["cases/elastica/timings"]), 2)

    def test_references(self):
        """Rows belong to cells that are there; points of curves lie in the arrays."""
        with h5py.File(self.results) as file:
            for case in file["cases"].values():
                cells = {(c["point"], c["formulation"], c["elements"]) for c in case["cells"][()]}
                for table in ("quantities", "curves", "steps", "iterations", "events"):
                    self.assertLessEqual({(r["point"], r["formulation"], r["elements"]) for r in case[table][()]}, cells, table)
                ends = [(c["first"], c["first"] + c["points"]) for c in case["curves"][()]]
                self.assertEqual([b for _, b in ends], [a for a, _ in ends[1:]] + [len(case["curve_x"])] if ends else [])
                self.assertEqual(len(case["curve_x"]), len(case["curve_value"]))
                self.assertEqual(case["steps"]["iterations"].sum(), len(case["iterations"]))

    def test_json_of_verdicts(self):
        record = json.loads(pathlib.Path(self.verdicts).read_text(encoding="utf-8"))
        for table in ("verdicts", "agreements"):
            for row in record[table]:
                self.assertEqual(sorted(row), sorted(self.names(table)))
        with h5py.File(self.results) as file:
            stored = [v for case in file["cases"].values() for v in case["verdicts"][()]]
        self.assertEqual(sorted((v["formulation"].decode(), v["verdict"].decode()) for v in stored), sorted((v["formulation"], v["verdict"]) for v in record["verdicts"]))

    def test_json_of_solution(self):
        record = json.loads(run("solve", "sheet_cantilever", "-f", "sheet_third", "-n", "1", "--format", "json"))
        self.assertEqual(sorted(record["cell"]), sorted(self.names("cells", keys=False)))
        for table, more in (("quantities", {"truths"}), ("curves", {"curve_x", "curve_value"}), ("steps", set()), ("iterations", set()), ("matrices", set())):
            self.assertGreater(len(record[table]), 0, table)
            for row in record[table]:
                self.assertEqual(set(row) - more, set(self.names(table, keys=False)), table)
        self.assertEqual(set(record["quantities"][0]["truths"][0]), set(self.names("truths")))
        jumps = json.loads(run("solve", "lee_frame", "-f", "collocation", "-n", "4", "--format", "json"))["events"]
        self.assertGreater(len(jumps), 0)
        self.assertEqual(set(jumps[0]), set(self.names("events", keys=False)))

    def test_parameters(self):
        """Columns of points are the parameters of the case, with their units and values."""
        path = os.path.join(self.folder.name, "s.h5")
        sets = ("solve", "sheet_cantilever", "-f", "sheet_third", "-n", "1", "--set", "width=0.07", "--set", "tip_warping=1")
        run(*sets, "--shapes=1", "-o", path)
        parameters = json.loads(run(*sets, "--format", "json"))["parameters"]
        with h5py.File(path) as file:
            points = file["cases/sheet_cantilever/points"]
            units = dict(zip(points.dtype.names, points.attrs["units"]))
            row = {name: points[name][0] for name in points.dtype.names[len(self.names("points", around=False)):]}
        self.assertEqual(list(row), list(parameters))
        self.assertEqual({name: v.decode() if isinstance(v, bytes) else v for name, v in row.items()}, parameters)
        self.assertEqual((units["length"], row["width"]), (b"m", 0.07))

    def test_json_of_convergence(self):
        for series in json.loads(run("converge", "elastica", "-f", "collocation", "-n", "1,2,4", "--format", "json"))["series"]:
            self.assertEqual(set(series) - {"quantities"}, set(self.names("series")))
            for quantity in series["quantities"]:
                self.assertEqual(set(quantity) - {"meshes"}, set(self.names("verdicts", keys=False)))
                for mesh in quantity["meshes"]:
                    self.assertLessEqual(set(self.names("cells", keys=False)) | set(self.names("quantities", keys=False)) | {"elements"}, set(mesh))

    def test_csv(self):
        expected = {("solve", "elastica", "-f", "beamw", "-n", "2"): ("quantities",), ("converge", "elastica", "-f", "beamw", "-n", "2,4"): ("quantities", "cells"),
                    ("bench", "elastica", "-f", "beamw", "-n", "2"): ("timings", "quantities", "cells")}
        for command, tables in expected.items():
            head = next(csv.reader(io.StringIO(run(*command, "--format", "csv"))))
            names = list(dict.fromkeys(name for table in tables for name in self.names(table)))
            self.assertEqual(head, names)

    def test_stress(self):
        arguments = ("stress", "-k", "thin", "-f", "sheet_third")
        record = json.loads(run(*arguments, "--format", "json"))
        self.assertEqual(sorted(record["outcomes"][0]), sorted(self.names("outcomes")))
        self.assertEqual(next(csv.reader(io.StringIO(run(*arguments, "--format", "csv")))), self.names("outcomes"))

    def test_text(self):
        """The description names every field."""
        text = run("schema")
        for fields in self.records.values():
            for f in fields:
                self.assertIn(f["name"], text)
                self.assertIn(f["summary"], text)

    def test_lines_of_the_readme(self):
        """The lines of h5py that README shows print the rows they say."""
        code = re.search(r"```python\n(.*?)```", (ROOT / "README.md").read_text(encoding="utf-8"), re.S).group(1)
        self.assertEqual(len(code.strip().splitlines()), 3)
        out, before = io.StringIO(), os.getcwd()
        os.chdir(self.folder.name)
        try:
            with contextlib.redirect_stdout(out):
                exec(compile(code, "README.md", "exec"), {})    # pylint: disable=exec-used
        finally:
            os.chdir(before)
        self.assertIn("w_over_L", out.getvalue())


if __name__ == "__main__":
    unittest.main()
