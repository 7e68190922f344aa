"""What solve and converge choose where nobody chose."""
import re
import unittest

from harness.tools.kit.program import ROOT, ProgramTest, environment

LEAF = ROOT / "cases" / "examples" / "leaf_spring_guide.yaml"


class Solve(ProgramTest):
    def test_both(self):
        """Said in the output, and right."""
        for case, quantity in (("elastica", "w_over_L"), ("lateral_buckling", "load_factor")):
            text = self.answered("solve", case).stdout
            told = re.match(r"-f (\S+): .*no known defect here.*\n-n (\d+): ", text)
            formulation, n = told.groups()
            self.assertIn(f"\n{case}, {formulation}\nok; ", text)
            record = self.record("solve", case)
            self.assertEqual((record["formulation"], record["elements"]), (formulation, int(n)))
            one = next(q for q in record["quantities"] if q["quantity"] == quantity)
            truths = [t for t in one["truths"] if t["truth_kind"] == "exact"]
            self.assertTrue(truths)
            self.assertLess(min(abs(t["error"]) for t in truths), 1e-3)

    def test_cost(self):
        """The formulation costs at most twice what the cheapest for 0.1 % does, as converge says,
        which runs all of them."""
        for case in ("elastica", "bend_45", "angle_column", "cross_flexure", "deep_beam", "lateral_buckling",
                     "carried_rod", "geradin_cardona", "loaded_cantilever", "weighted_column"):
            chosen = self.record("solve", case)["formulation"]
            answers = self.record("converge", case, "--error", "0.1%")["answers"]
            cost = {a["formulation"]: a["cost"] for a in answers if a["rank"]}
            self.assertIn(chosen, cost, case)
            self.assertLessEqual(cost[chosen], 2 * min(cost.values()), f"{case}: {chosen}, {cost}")

    def test_finer_than_the_meshes_of_a_scene(self):
        """Elements are doubled until values have settled."""
        text = LEAF.read_text(encoding="utf-8")
        path = self.folder / "coarse.yaml"
        path.write_text(re.sub(r"(?m)^meshes: .*$", "meshes: [1]", text), encoding="utf-8")
        told = re.match(r"-f \S+: .*\n-n (\d+): no value changed", self.answered("solve", "--scene", path).stdout)
        self.assertGreater(int(told.group(1)), 1)

    def test_steps(self):
        """How many were chosen and how many tries of longer ones failed stands in the first
        lines, as the steps themselves say."""
        for case, rejects in (("elastica", True), ("bend_45", False)):
            more = ("--set", "load=10") if rejects else ()
            what = ("solve", case, "-f", "beamw", "-n", "8", *more)
            steps = self.record(*what)["steps"]
            failed = sum(s["rejected"] for s in steps)
            self.assertEqual(failed > 0, rejects)
            told = f" in {len(steps)} load step" + ("s" if len(steps) > 1 else "")
            told += f" ({failed} longer rejected)," if rejects else ","
            self.assertIn(told, " ".join(self.answered(*what).stdout.split()))

    def test_one_of_them(self):
        text = self.answered("solve", "elastica", "-f", "beamw").stdout
        self.assertTrue(text.startswith("-n "), text)
        text = self.answered("solve", "elastica", "-n", "3").stdout
        self.assertRegex(text, r"\A-f \S+: .*\nelastica, ")
        text = self.answered("solve", "elastica", "-f", "beamw", "-n", "3").stdout
        self.assertTrue(text.startswith("elastica, beamw\n"), text)
        self.refused(2, "one -f and one -n", "solve", "elastica", "-f", "beamw", "-n", "1,2")

    def test_the_theory_that_the_case_asks_for(self):
        """Engesser's by default; the value is that of the truth of this theory."""
        record = self.record("solve", "shear_column")
        self.assertIn("engesser", record["cell"]["features"])
        load = next(q for q in record["quantities"] if q["quantity"] == "buckling_load")
        self.assertLess(abs(load["error"]), 1e-3)

    def test_a_scene_and_modes(self):
        text = self.answered("solve", "--scene", LEAF).stdout
        self.assertRegex(text, r"\A-f \S+: .*\n-n \d+: .*\nleaf_spring_guide, ")
        text = self.answered("solve", "tip_body", "--follow", "body=0.1..0.2/2").stdout
        self.assertRegex(text, r"\A-f \S+: .*\n-n \d+: ")

    def test_without_truths(self):
        """The ledger is not known: a solution all the same, and no word of defects."""
        done = self.answered("solve", "elastica", env=environment(BEAMWORK_TRUTHS="/nowhere.h5"))
        self.assertIn("without truths", done.stderr)
        self.assertRegex(done.stdout, r"\A-f \S+: ")
        self.assertNotIn("defect", done.stdout)


if __name__ == "__main__":
    unittest.main()
