"""The ranking of programs by the time in which they reach an error, and the record of a comparison."""
import csv
import importlib
import io
import json
import os
import pathlib
import sys
import unittest

from harness.library.python.test.module import SETTINGS, ModuleTest, bw, python
from harness.tools.kit.program import PROGRAM

ranking = None if bw is None else importlib.import_module("beamwork.peers._ranking")
record_of = None if bw is None else importlib.import_module("beamwork.peers._record")
tables = None if bw is None else importlib.import_module("beamwork.peers._tables")

DRIVER = '''
import math
from beamwork.peers.data import Answer, Element, Model, State
NAME, PROGRAM, LICENCE, HOMEPAGE, REQUIRES = "fake", "fake", "MIT", "https://example.org", ()
ELEMENTS = {"bar": Element("a bar", frozenset({"shear", "large rotations"}), frozenset({"static"})),
            "stiff": Element("another", frozenset({"shear", "large rotations"}), frozenset({"static"}))}
def version(): return "1"
class M(Model):
    unknowns, settings = 3, "none"
    def __init__(self, name, n): self.value = 0.3017207757695 * (1 + 0.1 / n**2 + 0.02 * (name == "stiff"))
    def solve(self, analysis):
        return Answer([State({"tip": [-0.056433233831, self.value, 0, 0, 0, None]})], iterations=2)
def build(scene, name, mesh): return M(name, len(mesh.elements))
'''


def run(n, error, time, unknowns=6, systems=5):
    return {"elements": n, "unknowns": unknowns, "systems": systems, "setup": 1.0, "times": {"bent": time, "": 2 * time},
            "errors": {"u": error}, "values": {"u": 1 + error}}


def series(name, runs, ours=False, **own):
    return {"name": name, "ours": ours, "version": "1", "missing": "", "settings": "", "other_model": "", "refused": {}, "verdicts": {},
            "runs": runs, **own}


def record(*all_series):
    return {"beamwork_peers": 1, "case": "c", "parameters": "", "beamwork": "0", "date": "2026-01-01", "rounds": 3,
            "unit": {"name": "a", "ours": True, "elements": 1}, "series": list(all_series),
            "quantities": [{"name": "u", "unit": "m", "analysis": "bent", "truth": 1.0, "kind": "exact", "meaning": ""}]}


@unittest.skipIf(bw is None, "needs a library without sanitizers")
class Ranking(unittest.TestCase):

    def test_no_quantity(self):
        empty = {**record(series("a", [run(1, 1e-3, 1.0)], True)), "quantities": []}
        self.assertIn("no quantity is ranked", tables.text(empty))

    def ranked(self, level, *all_series):
        given = record(*all_series)
        return ranking.rank(given, given["quantities"][0], level)

    def test_coarsest(self):
        """A mesh must count as reaching an error only if all finer meshes reach it as well."""
        lucky = series("lucky", [run(1, 1e-5, 1), run(2, -0.03, 2), run(4, 0.005, 4)])
        self.assertEqual(ranking.coarsest(lucky, "u", 1e-2)["elements"], 4)
        self.assertEqual(ranking.coarsest(lucky, "u", 1e-1)["elements"], 1)
        self.assertIsNone(ranking.coarsest(lucky, "u", 1e-3))

    def test_order_and_ratio(self):
        found = self.ranked(1e-2, series("a", [run(1, 1e-3, 2.0)], True), series("b", [run(1, 1e-3, 1.0, systems=3)]),
                            series("c", [run(1, 1e-3, 3.0)]))
        self.assertEqual([(row["name"], row["ratio"]) for row in found["rows"]], [("b", 0.5), ("a", 1), ("c", 1.5)])
        self.assertIn("3 systems solved against 5 (a)", found["ahead"].replace("systems solved against", "systems solved against"))

    def test_least_work(self):
        """The program with the least work must be found even if it is not the fastest."""
        found = self.ranked(1e-2, series("a", [run(1, 1e-3, 1.0)], True), series("b", [run(1, 1e-3, 2.0, unknowns=3)]))
        self.assertEqual((found["rows"][0]["name"], found["least_work"]["name"], found["least_work"]["work"]), ("a", "b", 15))
        text = tables.text(record(series("a", [run(1, 1e-3, 1.0)], True), series("b", [run(1, 1e-3, 2.0, unknowns=3)])))
        self.assertIn("least unknowns times systems: b, 3 x 5", text)

    def test_ours_first(self):
        found = self.ranked(1e-2, series("a", [run(1, 1e-3, 1.0)], True), series("b", [run(1, 1e-3, 2.0)]))
        self.assertEqual(found["ahead"], "")

    def test_only_a_peer(self):
        found = self.ranked(1e-4, series("a", [run(1, 1e-3, 1.0)], True), series("b", [run(1, 1e-5, 2.0)]))
        self.assertIn("no formulation of beamwork reaches", found["ahead"])
        self.assertEqual(found["others"], [["a", "smallest error 0.1 %, with 1 elements"]])

    def test_wrong_limit(self):
        """A program whose limit is known to be wrong must not count as reaching a smaller error by chance."""
        wrong = {"u": {"verdict": "wrong limit", "message": "converges to a wrong limit: +2 %", "limit": 1.02, "error": 0.02}}
        given = (series("a", [run(1, 1e-3, 1.0)], True), series("b", [run(4, 1e-3, 0.1)], verdicts=wrong))
        found = self.ranked(1e-2, *given)
        self.assertEqual([row["name"] for row in found["rows"]], ["a"])
        self.assertEqual(found["others"], [["b", "converges to a wrong limit: +2 %"]])
        self.assertEqual([row["name"] for row in self.ranked(0.1, *given)["rows"]], ["b", "a"])

    def test_reasons(self):
        """Every program that is not compared must be listed with the reason."""
        refused = series("b", [{"elements": 1, "refusal": "warping: none"}])
        text = tables.text(record(series("a", [run(1, 1e-3, 1.0)], True), refused, series("d", [], missing="d is not installed")))
        self.assertIn("not compared: b: warping: none", text)
        self.assertIn("not compared: d: d is not installed", text)

    def test_without_times(self):
        """Recorded results without times must be ranked by work, and must never be listed as faster than
        formulations."""
        old = series("old", [{**run(1, 1e-3, 1.0), "times": {}}])
        found = self.ranked(1e-2, old, series("a", [run(1, 1e-3, 1.0)], True))
        self.assertEqual(([row["name"] for row in found["rows"]], found["ahead"]), (["a", "old"], ""))


class Record(ModuleTest):

    def peers(self, *words):
        (pathlib.Path(self.folder) / "fake.py").write_text(DRIVER, encoding="utf-8")
        code = f"import runpy, sys; sys.argv = {['peers', *map(str, words)]!r}; runpy.run_module('beamwork.peers', run_name='__main__')"
        done = python(code, env={**os.environ, **SETTINGS, "BEAMWORK": PROGRAM, "BEAMWORK_DRIVERS": str(self.folder),
                                 "BEAMWORK_PEERS": sys.executable})
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_one_command(self):
        """One command must rank formulations and peers, and its record must give the same ranking without times."""
        words = ("elastica", "--peers", "fake", "-f", "collocation", "-f", "beamw", "--elements", "4,8,16,32", "--rounds", 1)
        place, imports = self.folder / "r.json", self.folder / "r.csv"
        live = list(csv.DictReader(io.StringIO(self.peers(*words, "--format", "csv", "-o", place, "-o", imports))))
        stored = json.loads(place.read_text(encoding="utf-8"))
        self.assertNotIn("seconds", stored["unit"])
        self.assertNotIn("seconds", place.read_text(encoding="utf-8"))
        again = list(csv.DictReader(io.StringIO(self.peers("--recorded", place, "--format", "csv"))))
        self.assertTrue(all(row.pop("seconds") == "" for row in again))
        self.assertTrue(any(row.pop("seconds") for row in live))
        for row in live:
            row.pop("seconds", None)
        self.assertEqual(live, again)
        self.answered("import", imports, "-o", self.folder / "r.h5")

        def place_of(quantity, level, program):
            row, = [r for r in again if (r["quantity"], float(r["level"]), r["program"]) == (quantity, level, program)]
            return int(row["place"]), row
        self.assertEqual(place_of("w_over_L", 1e-2, "fake, bar")[1]["elements"], "4")
        self.assertEqual(place_of("w_over_L", 1e-3, "fake, bar")[1]["elements"], "16")
        self.assertGreater(place_of("w_over_L", 1e-2, "collocation")[0], 0)
        place_, row = place_of("w_over_L", 1e-2, "fake, stiff")
        self.assertEqual(place_, 0)
        self.assertIn("2", row["reason"])  # its limit is 2 % too high
        self.assertIn("does not give this displacement", place_of("theta", 1e-2, "fake, bar")[1]["reason"])
        self.assertIn("a peer is ahead", self.peers("--recorded", place))

    def test_omit(self):
        """A scene with less physics has another name, and no reference values."""
        place = self.folder / "r.json"
        self.peers("shear_elastica", "--omit", "shear", "--peers", "fake:bar", "-f", "collocation", "--elements", "2,4", "--rounds", 1, "-o", place)
        stored = json.loads(place.read_text(encoding="utf-8"))
        self.assertEqual((stored["case"], stored["parameters"]), ("shear_elastica", "omit=shear"))
        self.assertNotIn(str(self.folder), place.read_text(encoding="utf-8"))
        self.assertTrue(all(q["kind"] != "exact" for q in stored["quantities"]))

    def test_import_only(self):
        """If only an import file is requested, it must be written without solving formulations."""
        self.assertEqual(self.peers("elastica", "--peers", "fake:bar", "--elements", "2", "--rounds", 1, "-o", self.folder / "t.csv"), "")
        self.assertIn("# program: fake, bar", (self.folder / "t.csv").read_text(encoding="utf-8"))

    def test_bad_record(self):
        (self.folder / "bad.json").write_text("[]", encoding="utf-8")
        with self.assertRaisesRegex(bw.Refused, "not a record"):
            record_of.read(self.folder / "bad.json")
