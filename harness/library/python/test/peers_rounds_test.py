"""Formulations of beamwork and other programs must alternate and solve the same problem."""
import importlib
import json
import unittest

from harness.library.python.test.module import ModuleTest, bw

peers = None if bw is None else importlib.import_module("beamwork.peers")
rounds = None if bw is None else importlib.import_module("beamwork.peers._rounds")


class Turns(unittest.TestCase):

    @unittest.skipIf(bw is None, "needs a library without sanitizers")
    def test_order(self):
        """In each round, each program must solve the mesh once, and all processes must end."""
        log = []

        class Silent:

            def __init__(self, name):
                self.series, self.name = rounds.Series("", name, name), name

            def begin(self):
                log.append("begin " + self.name)

            def round(self, n):
                log.append(f"{self.name} {n}")

            def close(self):
                log.append("close " + self.name)

        rounds.take_turns([Silent("a"), Silent("b")], [1, 2], 2)
        meshes = [["begin a", "begin b", f"a {n}", f"b {n}", f"a {n}", f"b {n}"] for n in (1, 2)]
        self.assertEqual(log, meshes[0] + meshes[1] + ["close a", "close b"])


class Ours(ModuleTest):

    def data(self, case):
        return json.loads(self.answered("scene", case, "--format", "json").stdout)

    def test_values(self):
        """A formulation in a separate process must give the values of `beamwork solve`."""
        found = peers.solve_all(self.data("elastica"), [], ["collocation", "beamw"], [1, 4], 2)
        self.assertEqual([one.program for one in found], ["collocation", "beamw"])
        for one in found:
            for run in one.runs:
                result = bw.Scene.case("elastica").solve(one.element, run["elements"])
                for name, value in result.values.items():
                    self.assertAlmostEqual(run["values"][name] / value, 1, places=12)
                self.assertEqual(run["unknowns"], result.cell["free"])
                self.assertGreater(run["times"][""], 0)

    def test_analyses(self):
        """There must be a time for each analysis, and for all of them together."""
        run, = peers.solve_all(self.data("c_column"), [], ["beamw_consistent"], [2], 1)[0].runs
        self.assertGreater(len(run["times"]), 2)
        self.assertIn("", run["times"])
        self.assertTrue(all(0 < seconds < 10 for seconds in run["times"].values()))

    def test_systems(self):
        """Equation systems must be counted for each analysis."""
        run, = peers.solve_all(self.data("sheet_cantilever"), [], ["collocation"], [1], 1)[0].runs
        path, compliance = run["systems"]["analysis_0"], run["systems"]["analysis_1"]
        self.assertGreater(path, 0)
        self.assertGreater(compliance, path)

    def test_stability(self):
        """Without the search for flutter, the values must be the same."""
        scene = bw.Scene.case("sheet_cantilever")
        one, other = (scene.solve("collocation", 2, stability=s) for s in (True, False))
        self.assertEqual(one.values, other.values)
        with self.assertRaises(bw.Refused):
            scene.solve("collocation", 2, stability=1)

    def test_refused(self):
        """A rejection by a formulation must have its reason, and the other meshes must be tried."""
        found, = peers.solve_all(self.data("bend_45"), [], ["beamw_vlasov:mass=no"], [1, 2], 1)
        self.assertEqual(len(found.runs), 2)
        self.assertIn("mass", found.runs[0]["refusal"])
