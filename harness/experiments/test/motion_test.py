import csv
import io
import json
import math
import re
import unittest

from harness.tools.kit import program
from harness.tools.kit.program import ProgramTest
from harness.tools.kit.scenes import LEAF

FLIGHT = ("free_flight_space", "-f", "collocation", "-n", "4", "--set", "time=7.5")


def run(*arguments):
    return program.run("motion", *arguments)


class Runs(ProgramTest):

    @classmethod
    def setUpClass(cls):
        done = run(*FLIGHT, "--integrator", "alpha,conserving,radau", "--step", "0.1..0.025",
                   "--tolerance", "1e-4,1e-6", "--format", "json")
        assert done.returncode == 0, done.stderr
        cls.case = json.loads(done.stdout)

    def runs(self, integrator, by_tolerance=False):
        return [
            r for r in self.case["runs"]
            if r["integrator"] == integrator and (r["tolerance"] > 0) == by_tolerance
        ]

    def test_all_are_there(self):
        self.assertEqual([r["step"] for r in self.runs("alpha")], [0.1, 0.05, 0.025])
        self.assertEqual([r["tolerance"] for r in self.runs("radau", True)], [1e-4, 1e-6])
        self.assertEqual(self.runs("conserving", True), [])
        for r in self.case["runs"]:
            self.assertEqual((r["status"], r["reason"]), ("ok", ""))
            self.assertGreater(r["cost"], 0)
            self.assertLess(r["iterations_per_step"], 5)

    def test_errors_fall(self):
        self.assertLess(self.case["references"][0]["uncertainty"], 1e-6)
        for integrator in ("alpha", "conserving", "radau"):
            errors = [r["error"] for r in self.runs(integrator)]
            self.assertEqual(errors, sorted(errors, reverse=True))
        coarse, fine = self.runs("radau", True)
        self.assertLess(fine["error"], coarse["error"] / 3)
        self.assertGreater(fine["steps"], coarse["steps"])

    def test_orders(self):
        orders = {o["integrator"]: o for o in self.case["orders"]}
        for integrator in ("alpha", "conserving"):
            errors = [r["error"] for r in self.runs(integrator)]
            self.assertAlmostEqual(orders[integrator]["order"], math.log2(errors[1] / errors[2]))
            self.assertEqual(self.runs(integrator)[2]["order"], orders[integrator]["order"])
            self.assertGreater(orders[integrator]["order"], 1.7)

    def test_what_is_conserved(self):
        self.assertEqual(self.case["references"][0]["alone_from"], 5)
        for r in self.runs("conserving"):
            self.assertLess(r["energy_drift"], 1e-11)
            self.assertLess(r["momentum_drift"], 1e-12)
            self.assertEqual(r["outcome"], "exact")
        for r in self.runs("alpha"):
            self.assertGreater(r["energy_drift"], 1e-6)
            self.assertEqual(r["outcome"], "bounded")
        drift = [r["momentum_drift"] for r in self.runs("alpha")]
        self.assertAlmostEqual(math.log2(drift[1] / drift[2]), 2, delta=0.3)

    def test_cheapest(self):
        for one in self.case["reached"]:
            runs = self.runs(one["integrator"]) + self.runs(one["integrator"], True)
            within = [r["cost"] for r in runs if r["error"] <= one["error"]]
            self.assertLessEqual(one["cost"], max(within) * (1 + 1e-12), one)
        self.assertTrue(any(o["error"] == 1e-4 for o in self.case["reached"]))


class Stability(ProgramTest):

    def test_trapezoidal_in_stiff_flight(self):
        case = *FLIGHT[:-1], "time=20"
        record = self.record("motion", *case, "--vary", "stiffening=1,1e4", "--conservation-only",
                             "--integrator", "trapezoidal,conserving", "--step", "0.2")
        points = record["runs"]
        self.assertEqual([(r["parameters"], r["integrator"]) for r in points],
                         [(k, i) for k in ("time=20", "time=20;stiffening=10000")
                          for i in ("trapezoidal", "conserving")])
        self.assertEqual((record["references"], record["errors"]), ([], []))
        for r in points:
            self.assertFalse(r["has_reference"])
            self.assertEqual(r["rejected"], 0)
            self.assertEqual(r["outcome"] == "stops", r["status"] != "ok")
            self.assertEqual(r["stopped"] is None, r["status"] == "ok")
            self.assertEqual(bool(r["reason"]), r["status"] != "ok")

    def test_held_structures_have_no_fate(self):
        record = self.record("motion", "pendulum", "-f", "collocation", "-n", "2", "--set",
                             "time=0.5", "--conservation-only", "--integrator", "alpha", "--step", "0.01")
        self.assertEqual(record["runs"][0]["outcome"], "")


class Words(ProgramTest):

    def test_formats_agree(self):
        asked = *FLIGHT, "--integrator", "alpha", "--step", "0.1,0.05"
        record = self.record("motion", *asked)
        rows = list(csv.DictReader(io.StringIO(run(*asked, "--format", "csv").stdout)))
        self.assertEqual([float(r["error"]) for r in rows],
                         [r["error"] for r in record["runs"]])
        text = run(*asked).stdout
        self.assertIn("free_flight_space (time=7.5), collocation, n = 4, to 7.5 s", text)
        self.assertIn("integrators with the lowest cost for an error of 0.01 (at most three):", text)

    def test_consistent_mass_is_not_lumped_in_silence(self):
        scene = self.folder / "mine.yaml"
        scene.write_text(LEAF.replace("young: 210e9", "density: 7800, young: 210e9") + """
analyses:
  swing: {motion: {stations: [0.01], step: 1e-3, mass: consistent}}
quantities:
  tip: {displacement: {analysis: swing, node: tip, component: uy}}
omit: [trapeze, wagner_moments, wagner_torque]
""", encoding="utf-8")
        text = run("--scene", scene, "-f", "beamw", "-n", "1", "--integrator",
                   "alpha,conserving,explicit", "--step", "1e-3,5e-4,2.5e-4").stdout
        text = re.sub(r"\n    (?! )", " ", text)
        for name in ("conserving", "explicit"):
            self.assertEqual(len(re.findall(rf"  {name} .*stops at 0 s", text)), 3, text)
            self.assertIn(f"the integrator {name} supports only lumped mass", text)
            self.assertIn(f"order of {name}: undecided; the order cannot be measured from the errors", text)
        self.assertNotIn("nan", text)

    def test_refusals(self):
        for arguments, words in (
            (("elastica",), "case elastica has no transient analysis"),
            ((*FLIGHT, "--integrator", "euler"), "--integrator 'euler'"),
            ((*FLIGHT, "--step", "0.1..0.2"), "--step '0.1..0.2'"),
            ((*FLIGHT, "--tolerance", "0"), "--tolerance '0'"),
            (("free_flight_space", "-n", "2,4"), "only one number of elements"),
            ((*FLIGHT, "--vary", "stiffening=1..2"), "the number of parts is missing"),
        ):
            done = run(*arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertIn(words, done.stderr)


HEAD = "judged,case,parameters,formulation,elements,integrator,steps,expected,why"


class Expected(ProgramTest):

    def judged(self, *rows):
        path = self.folder / "expected.csv"
        path.write_text("\n".join([HEAD, *rows]) + "\n", encoding="utf-8")
        return run("--expected", path)

    def test_as_expected_and_not(self):
        row = "{},free_flight_space,time=7.5,collocation,2,{},0.1..0.025,{},because"
        good = row.format("energy", "conserving", "conserved"), row.format(
            "energy", "alpha", "order 2")
        done = self.judged(*good)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        self.assertIn("2 verdicts; 0 differ", done.stdout)
        done = self.judged(row.format("energy", "alpha", "conserved"), good[0])
        self.assertEqual(done.returncode, 1)
        self.assertIn("unexpected: energy of alpha", done.stdout)
        self.assertIn("2 verdicts; 1 differ", done.stdout)

    def test_tolerances_within_a_factor_of_two(self):
        row = "tolerance,free_flight_space,time=7.5,collocation,2,radau,1e-4..1e-6,{},because"
        found = self.judged(row.format("9")).stdout.split(": ")[-1].split(",")[0]
        near = " ".join(f"{float(x) + 0.2:.1f}" for x in found.split())
        far = " ".join(f"{float(x) + 0.4:.1f}" for x in found.split())
        self.assertEqual(self.judged(row.format(near)).returncode, 0)
        self.assertEqual(self.judged(row.format(far)).returncode, 1)
        self.assertEqual(self.judged(row.format(near.split()[0])).returncode, 1)

    def test_mistakes_of_the_table(self):
        good = "order,pendulum,,collocation,2,alpha,0.01,pass,because".split(",")
        for column, word, words in ((0, "speed", "property 'speed' has no verdict"),
                                    (1, "pendulums", "pendulum"), (2, "mass=1", "mass"),
                                    (3, "colocation", "collocation"), (4, "two", "whole number"),
                                    (5, "euler", "--integrator 'euler'"),
                                    (6, "0", "--step '0'"), (1, "elastica", "no transient analysis")):
            row = [*good[:column], word, *good[column + 1:]]
            done = self.judged(",".join(row))
            self.assertEqual(done.returncode, 2, row)
            self.assertIn("expected.csv:2: ", done.stderr)
            self.assertIn(words, done.stderr)
        self.assertEqual(run("--expected", self.folder / "none.csv").returncode, 4)
        self.assertEqual(self.judged().returncode, 3)


if __name__ == "__main__":
    unittest.main()
