"""A new run must reproduce the recorded comparison (reference/peers) and its diagram. Programs that are not installed, or
installed in another version, are skipped by name."""
import importlib
import json
import os
import unittest

from harness.library.python.test.module import SETTINGS, ModuleTest, bw, python
from harness.tools.kit.program import PROGRAM, ROOT
from reports import peers_data

CASES = {"elastica": ((1, 2, 4, 8), "exudyn:exact_2d,opensees:elasticBeamColumn,opensees:forceBeamColumn,xara:exact,kratos"),
         "free_flight_plane": ((2, 4, 8), "exudyn:exact_2d,pyelastica")}
OURS = ("geometrically_exact", "collocation")
DIGITS = 2e-3  # errors are recorded with 4 digits


@unittest.skipIf(bw is None, "needs a library without sanitizers")
class Live(ModuleTest):

    def live(self, case):
        """Returns the file of a new comparison, made by the same command as the recorded one."""
        place = self.folder / "live.json"
        words = ["peers", case, "--peers", CASES[case][1], "--elements", ",".join(map(str, self.meshes)), "-o", str(place)]
        words += [word for name in OURS for word in ("-f", name)]
        code = f"import runpy, sys; sys.argv = {words!r}; runpy.run_module('beamwork.peers', run_name='__main__')"
        done = python(code, env={**os.environ, **SETTINGS, "BEAMWORK": PROGRAM})
        self.assertEqual(done.returncode, 0, done.stderr)
        return place

    def pairs(self, live):
        """Yields the series that both comparisons contain, in the same version, and skips the others by name."""
        old = {s["name"]: s for s in self.recorded["series"]}
        for series in live["series"]:
            with self.subTest(series["name"]):
                if series["missing"]:
                    self.skipTest(series["missing"])
                if not series["ours"] and series["version"] != old[series["name"]]["version"]:
                    self.skipTest(f"version {series['version']}; {old[series['name']]['version']} is recorded")
                yield old[series["name"]], series

    def close(self, one, other):
        self.assertLessEqual(abs(one - other), DIGITS * abs(one) + 1e-9)

    def test_statics(self):
        self.again("elastica")

    def test_motion(self):
        self.again("free_flight_plane")

    def again(self, case):
        self.meshes = CASES[case][0]
        self.recorded = peers_data.read(ROOT / "reference" / "peers" / f"{case}.json")
        place = self.live(case)
        with self.subTest("counts, values and errors"):
            for old, new in self.pairs(peers_data.read(place)):
                self.same(old, new)
        with self.subTest("diagram"):
            self.same_diagrams(place)

    def same(self, old, new):
        """Counts must be equal. For formulations of beamwork, which may be improved, only the numbers of unknowns must be
        equal."""
        runs = {run["elements"]: run for run in old["runs"]}
        self.assertEqual([run["elements"] for run in new["runs"]], list(self.meshes))
        for run in new["runs"]:
            before = runs[run["elements"]]
            self.assertEqual("values" in run, "values" in before, run)
            if "values" not in run:
                continue
            self.assertEqual(run["unknowns"], before["unknowns"])
            if not new["ours"]:
                self.assertEqual(run["systems"], before["systems"])
            self.assertTrue(run["errors"])
            self.assertLessEqual(set(run["errors"]), set(before["errors"]))  # two formulations agree on fewer limits
            for name, value in run["values"].items():
                self.assertAlmostEqual(value / before["values"][name], 1, delta=1e-8)
            for name, error in run["errors"].items():
                self.close(before["errors"][name], error)

    def same_diagrams(self, place):
        """The report that is given the live file draws the live curves, and these are the recorded ones: equal meshes and
        errors, and times of the same magnitude."""
        live, = [r for r in peers_data.records([place]) if r["file"] == place.name]
        names = {new["name"] for _, new in self.pairs(live)}
        scale = self.unit(live) / self.unit(self.recorded)
        for quantity in peers_data.known(live):
            one, other = (self.curves(r, quantity, names) for r in (self.recorded, live))
            self.assertEqual(set(one), set(other))
            for name, points in one.items():
                self.assertEqual([n for _, _, n in points], [n for _, _, n in other[name]], name)
                for (t, e, _), (u, f, _) in zip(points, other[name]):
                    self.close(e, f)
                    self.assertTrue(0.1 < u / (scale * t) < 10, (name, u / (scale * t)))

    def curves(self, record, quantity, names):
        """Returns the curves of a diagram, without other meshes."""
        found = {name: [p for p in points if p[2] in self.meshes]
                 for name, points in peers_data.diagram(record, quantity)["curves"].items() if name in names}
        return {name: points for name, points in found.items() if points}

    def unit(self, record):
        """Returns the time of one run, which is the unit of both comparisons."""
        run, = [r for s in record["series"] if s["name"] == OURS[0] for r in s["runs"] if r["elements"] == self.meshes[-1]]
        return run["times"][""]


if __name__ == "__main__":
    unittest.main()
