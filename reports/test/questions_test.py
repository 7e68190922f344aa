"""Quantities must be assigned to questions, verdicts counted by error, and a default formulation chosen, as
reports/questions.py and reports/index.py describe."""
import math
import unittest

from reports import answers, data, index, questions
from reports import case as pages_of_cases
from reports.problems import GROUPS, TrustRow
from reports.test.results import case, series

SCENE = """beamwork: 1
analyses:
  buckled: {buckling: {}}
  modes: {modal: {}}
  moved: {motion: {stations: [1]}}
  bent: {static: {stations: [1]}}
  eased: {compliance: {about: bent}}
quantities:
  "load": {critical_factor: {analysis: buckled}, unit: "N"}
  "load_2": {critical_factor: {analysis: buckled, which: 1}, unit: "N"}
  "swing": {displacement: {analysis: moved, node: tip}, unit: "m"}
  "k": {stiffness: {analysis: eased, component: uz}, unit: "N/m"}
  "tip": {displacement: {analysis: bent, node: tip}, unit: "m"}
"""
MODES = "".join(f'  "f_{i}": {{frequency: {{analysis: modes, which: {i + 3}, family: any}}, unit: "Hz"}}\n' for i in range(5))


def judged(verdict="pass", error=0.0, name="u", n=2, cost=1.0, key="a"):
    one = series(key, [data.Verdict(name, verdict, truth=2.0, error=error, tolerance=0.002,
                                    reach={level: n for level in answers.LEVELS})])
    one.meshes = [data.Mesh(n, "ok", "", data.Clock(0, 1, 1, 1, 1), 8, 4, "", {}, values={name: 2.0},
                            errors={name: error}, cost=cost)]
    return one


class Questions(unittest.TestCase):

    def of(self, *names):
        one = case("one", series("a", [data.Verdict(name, "pass", truth=1.0) for name in names]))
        one.points[0].scene = SCENE + MODES
        return questions.questions_of(one.points[0])

    def test_each_kind_of_quantity(self):
        self.assertEqual(self.of("tip", "k", "swing", "load"), {
            questions.BUCKLING: ["load"], questions.STIFFNESS: ["k"], questions.MOTION: ["swing"],
            questions.LOADED: ["tip"]})

    def test_only_the_first_modes(self):
        """Modes are counted from the lowest one with a reference value: a free structure has rigid modes."""
        self.assertEqual(self.of("load_2", "load", "f_4", "f_3", "f_2", "f_1", "f_0"), {
            questions.BUCKLING: ["load"], questions.FREQUENCIES: ["f_2", "f_1", "f_0"]})

    def test_without_a_scene(self):
        one = case("one", series("a", [data.Verdict("u", "pass", truth=1.0)]))
        self.assertEqual(questions.questions_of(one.points[0]), {questions.LOADED: ["u"]})

    def test_lowest_cost_at_each_error(self):
        one = case("one", judged(key="a", n=4, cost=2.0), judged(key="b", n=2, cost=1.0))
        (question, (line,)), = questions.grouped([one])
        self.assertEqual((question, line.case.name), (questions.LOADED, "one"))
        for level in answers.LEVELS:
            self.assertEqual((line.found[level].best[0].key, line.found[level].best[0].n), ("b", 2))


class Steps(unittest.TestCase):

    def test_what_an_order_of_magnitude_costs(self):
        fine, coarse = judged(key="a", n=4, cost=6.0), judged(key="b", n=2, cost=2.0)
        coarse.verdicts[0].reach = {0.1: 2, 0.01: 2}
        found = pages_of_cases.steps_of(pages_of_cases.cheapest_of(case("one", fine, coarse).points[0]))
        self.assertEqual([(level, w.key, factor) for level, w, factor in found], [(0.001, "a", 3.0), (0.0001, "a", 3.0)])
        self.assertEqual(pages_of_cases.steps_of([]), [])


class Sizes(unittest.TestCase):

    def test_by_size(self):
        rows = (("pass", 0), ("biased", 5e-4), ("wrong limit", 5e-3), ("wrong limit, as predicted", -5e-2),
                ("undecided", 0.1), ("diverged", math.nan), ("no truth", 0))
        found = index.sizes_of([case(f"c{i}", judged(*row)) for i, row in enumerate(rows)])
        self.assertEqual(found, {"a": index.Sizes(judged=6, passes=1, biased=1, beyond=1, far=1, derived=1,
                                                  unknown=1, none=1)})

    def test_tolerance(self):
        self.assertEqual(index.tolerance_of([case("one", judged())]), 0.001)
        self.assertTrue(math.isnan(index.tolerance_of([])))

    def test_default_choice(self):
        """The chosen formulation is neither the cheapest, which has a wrong limit, nor one that solves
        fewer problems."""
        none = dict.fromkeys(GROUPS, 0)
        rows = [TrustRow("exact", none, solved=0.98, factor=2.0), TrustRow("fast", none, solved=0.975, factor=1.4),
                TrustRow("wrong", none, solved=0.98, factor=1.0), TrustRow("narrow", none, solved=0.5, factor=1.0)]
        sizes = {r.key: index.Sizes(judged=9, beyond=r.key == "wrong") for r in rows}
        self.assertEqual(index.default_choice(rows, sizes).key, "fast")
        self.assertIsNone(index.default_choice(rows[2:3], sizes))


if __name__ == "__main__":
    unittest.main()
