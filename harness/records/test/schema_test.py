"""Every format must contain the fields listed by `beamwork schema`, under the same names."""
import csv
import io
import json
import unittest

import h5py

from harness.tools.kit import program
from harness.tools.kit.program import ProgramTest

KEYS = ("point", "formulation", "elements")
JSON_ONLY = ("truths", )
OF_THE_RUN = ("declarations",)
OF_SOME = ("motion", "assumptions")
KINDS = {"int": "i4", "long": "i8", "double": "f8", "flag": "b", "text": "S", "enum": "S"}


def run(*arguments):
    return program.run(*arguments).stdout


def text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


class Schema(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.schema = json.loads(run("schema", "--format", "json"))
        cls.records = {r["table"]: r["fields"] for r in cls.schema["records"]
                       if not r["place"].startswith("/experiments/")}
        cls.groups = {r["place"] + r["table"]: r["fields"] for r in cls.schema["records"]
                      if r["place"].startswith("/experiments/")}
        cls.stored = cls.class_folder()
        cls.results, cls.bench, cls.verdicts = (
            cls.stored / name for name in ("results.h5", "bench.h5", "v.json"))
        run("verify", "-k",
            "lee_frame/default or (elastica/default or elbow/default) and collocation",
            "-o", cls.results, "--json", cls.verdicts)
        run("bench", "elastica", "-f", "collocation", "-n", "1,2", "-o", cls.bench)

    def names(self, table, keys=True, around=True):
        return [f["name"] for f in self.records[table]
                if (keys or not f["key"]) and (around or not f["said_around"])]

    def check_table(self, table, fields):
        columns = table.dtype.names
        self.assertEqual(list(columns[:len(fields)]), [f["name"] for f in fields])
        for name, attribute in (("unit", "units"), ("summary", "summaries")):
            told = [text.decode() for text in table.attrs[attribute]]
            self.assertEqual(told[:len(fields)], [f[name] for f in fields])
        self.assertEqual(len(table.attrs["units"]), len(columns))
        for f in fields:
            base, shape = table.dtype[f["name"]].base, table.dtype[f["name"]].shape
            self.assertTrue(base.str.lstrip("<|").startswith(KINDS[f["kind"]]), f)
            self.assertEqual(shape, (6, 6) if f["count"] == 36 else ())
            if f["kind"] == "enum":
                self.assertLessEqual({word.decode() for word in table[f["name"]]}, set(f["words"]))

    def test_hdf5(self):
        for path, root in ((self.results, "/"), (self.bench, "experiments/bench")):
            with h5py.File(path) as whole:
                file = whole[root]
                for name in ("schema", "schema_version"):
                    self.assertEqual(text(file.attrs[name]), str(self.schema[name]))
                for case in file["cases"].values():
                    for table, fields in self.records.items():
                        if table not in (*JSON_ONLY, *OF_THE_RUN) and \
                                (table in case or table not in OF_SOME):
                            own = [f for f in fields if not f["said_around"]]
                            self.check_table(case[table], own)
                for table in OF_THE_RUN:
                    self.check_table(file[table], self.records[table])

    def test_declarations(self):
        with h5py.File(self.results) as file:
            rows = file["declarations"][()]
            run_here = {text(s["formulation"]) for case in file["cases"].values()
                        for s in case["series"][()]}
        self.assertEqual(sorted(text(r["formulation"]) for r in rows), sorted(run_here))
        own = next(r for r in rows if r["formulation"] == b"collocation")
        self.assertEqual((own["statics_least"], own["statics_highest"], own["nodes"]), (2, 10, 2))
        self.assertIn("coupled section", text(own["offers"]).split(", "))
        self.assertEqual(text(own["shear_theory"]), "haringx")
        stages = text(own["options"]).split("\n")[0].split("\t")
        self.assertEqual(stages[:3], ["stages", "3|4|5|6|7|8", "5"])

    def test_every_table_is_seen(self):
        with h5py.File(self.results) as file:
            for table in self.records:
                if table not in (*JSON_ONLY, *OF_THE_RUN, "timings", "agreements", "matrices", "imports", "assumptions"):
                    seen = sum(len(case[table]) for case in file["cases"].values()
                               if table in case or table not in OF_SOME)
                    self.assertGreater(seen, 0, table)
        with h5py.File(self.bench) as file:
            self.assertEqual(len(file["experiments/bench/cases/elastica/timings"]), 2)

    def test_references(self):
        with h5py.File(self.results) as file:
            for case in file["cases"].values():
                cells = {tuple(c[k] for k in KEYS) for c in case["cells"][()]}
                for table in ("quantities", "curves", "steps", "iterations", "events"):
                    own = {tuple(row[k] for k in KEYS) for row in case[table][()]}
                    self.assertLessEqual(own, cells, table)
                ends = [(c["first"], c["first"] + c["points"]) for c in case["curves"][()]]
                begins = [a for a, _ in ends] + [len(case["curve_x"])]
                self.assertEqual([0] + [b for _, b in ends], begins)
                self.assertEqual(len(case["curve_x"]), len(case["curve_value"]))
                self.assertEqual(case["steps"]["iterations"].sum(), len(case["iterations"]))

    def test_json_of_verdicts(self):
        record = json.loads(self.verdicts.read_text(encoding="utf-8"))
        for table in ("verdicts", "agreements"):
            for row in record[table]:
                self.assertEqual(sorted(row), sorted(self.names(table)))
        with h5py.File(self.results) as file:
            stored = [v for case in file["cases"].values() for v in case["verdicts"][()]]
        said = [(v["formulation"], v["verdict"]) for v in record["verdicts"]]
        stored = [(text(v["formulation"]), text(v["verdict"])) for v in stored]
        self.assertEqual(sorted(stored), sorted(said))

    def test_json_of_solution(self):
        record = json.loads(run("solve", "sheet_cantilever", "-f", "sheet_third", "-n", "1",
                                "--format", "json"))
        self.assertEqual(sorted(record["cell"]), sorted(self.names("cells", keys=False)))
        besides = {"quantities": {"truths"}, "curves": {"curve_x", "curve_value"}}
        for table in ("quantities", "curves", "steps", "iterations", "matrices"):
            self.assertGreater(len(record[table]), 0, table)
            for row in record[table]:
                self.assertEqual(set(row) - besides.get(table, set()),
                                 set(self.names(table, keys=False)), table)
        self.assertEqual(set(record["quantities"][0]["truths"][0]), set(self.names("truths")))
        flown = json.loads(run("solve", "pendulum", "-f", "collocation", "-n", "2", "--set",
                               "time=0.1", "--set", "step=0.025", "--set", "tolerance=0",
                               "--format", "json"))["motion"]
        self.assertEqual([round(row["time"], 9) for row in flown], [0, 0.025, 0.05, 0.075, 0.1])
        self.assertEqual(set(flown[0]), set(self.names("motion", keys=False)))
        jumps = json.loads(run("solve", "lee_frame", "-f", "collocation", "-n", "4",
                               "--format", "json"))["events"]
        self.assertGreater(len(jumps), 0)
        self.assertEqual(set(jumps[0]), set(self.names("events", keys=False)))

    def test_parameters(self):
        path = self.folder / "s.h5"
        sets = ("solve", "sheet_cantilever", "-f", "sheet_third", "-n", "1",
                "--set", "width=0.07", "--set", "tip_warping=1")
        run(*sets, "--shapes=1", "-o", path)
        parameters = json.loads(run(*sets, "--format", "json"))["parameters"]
        with h5py.File(path) as file:
            points = file["cases/sheet_cantilever/points"]
            units = dict(zip(points.dtype.names, points.attrs["units"]))
            own = points.dtype.names[len(self.names("points", around=False)):]
            row = {name: points[name][0] for name in own}
        self.assertEqual(list(row), list(parameters))
        self.assertEqual({name: text(v) if isinstance(v, bytes) else v for name, v in row.items()},
                         parameters)
        self.assertEqual((units["length"], row["width"]), (b"m", 0.07))

    def test_scenes(self):
        with h5py.File(self.results) as file:
            for name, case in file["cases"].items():
                scenes = {text(row["point"]): text(row["scene"]) for row in case["scenes"][()]}
                self.assertEqual(set(scenes), {text(p) for p in case["points"]["point"]})
                self.assertEqual(scenes["default"], run("scene", name))

    def test_what_can_be_set(self):
        with h5py.File(self.results) as file:
            for case in file["cases"].values():
                table, points = case["parameters"][()], case["points"]
                own = points.dtype.names[len(self.names("points", around=False)):]
                self.assertEqual([text(name) for name in table["parameter"]], list(own))
                row = next(p for p in points[()] if p["point"] == b"default")
                for p in table:
                    value, told = row[text(p["parameter"])], text(p["default"])
                    self.assertEqual(text(value) if p["choices"] else value,
                                     told if p["choices"] else float(told))
                    self.assertTrue(p["choices"] or p["min"] <= value <= p["max"])
                    self.assertTrue(p["summary"])

    def test_meanings(self):
        with h5py.File(self.results) as file:
            for name, case in file["cases"].items():
                told = {(m["point"], m["quantity"]): text(m["meaning"])
                        for m in case["meanings"][()]}
                asked = {(q["point"], q["quantity"]) for q in case["quantities"][()]}
                self.assertLessEqual(asked, set(told))
                self.assertGreater(min(len(words) for words in told.values()), 10)
                curves = {m["quantity"] for m in case["meanings"][()] if m["curve"]}
                self.assertEqual(curves, {c["quantity"] for c in case["curves"][()]})
                shown = " ".join(run("list", name).split())
                for (point, _), words in told.items():
                    self.assertTrue(point != b"default" or words in shown, words)

    def test_json_of_convergence(self):
        done = run("converge", "elastica", "-f", "collocation", "-n", "1,2,4", "--format", "json")
        for series in json.loads(done)["series"]:
            self.assertEqual(set(series) - {"quantities", "curves"}, set(self.names("series")))
            for quantity in series["quantities"]:
                self.assertEqual(set(quantity) - {"meshes"},
                                 set(self.names("verdicts", keys=False)))
                own = {*self.names("cells", keys=False), *self.names("quantities", keys=False)}
                for mesh in quantity["meshes"]:
                    self.assertLessEqual(own | {"elements"}, set(mesh))

    def test_csv(self):
        expected = {"solve": ("quantities",), "converge": ("quantities", "cells"),
                    "bench": ("timings", "quantities", "cells")}
        for verb, tables in expected.items():
            written = run(verb, "elastica", "-f", "beamw", "-n", "2", "--format", "csv")
            head = next(csv.reader(io.StringIO(written)))
            names = list(dict.fromkeys(name for table in tables for name in self.names(table)))
            self.assertEqual(head, names + ["omitted", "assumed"] * (verb == "solve"))

    def test_experiments(self):
        path = self.folder / "results.h5"
        csv_of = {"stress": "outcomes", "motion": "runs"}
        for verb, *asked in (("stress", "-k", "thin", "-f", "sheet_third"),
                             ("motion", "pendulum", "-f", "collocation", "-n", "1", "--set",
                              "time=0.1", "--integrator", "alpha", "--step", "0.01,0.005"),
                             ("element-test", "sheet_third")):
            place = f"/experiments/{verb}/"
            own = {name.removeprefix(place): fields for name, fields in self.groups.items()
                   if name.startswith(place)}
            run(verb, *asked, "-o", path, "--json", self.folder / "record.json")
            record = program.read_json(self.folder / "record.json")
            with h5py.File(path) as file:
                self.assertEqual(set(file[place]), set(own))
                self.assertEqual(text(file[place].attrs["commit"]), record["commit"])
                for table, fields in own.items():
                    self.check_table(file[place][table], fields)
                    self.assertEqual(len(file[place][table]), len(record[table]), table)
                    for row in record[table][:1]:
                        self.assertEqual(list(row), [f["name"] for f in fields])
                    self.assertEqual(bool(record[table]), table != "verdicts", table)
            if verb in csv_of:
                head = next(csv.reader(io.StringIO(run(verb, *asked, "--format", "csv"))))
                self.assertEqual(head, [f["name"] for f in own[csv_of[verb]]])

    def test_text(self):
        told = run("schema")
        for fields in (*self.records.values(), *self.groups.values()):
            for f in fields:
                self.assertIn(f["name"], told)
                self.assertIn(f["summary"], told)


if __name__ == "__main__":
    unittest.main()
