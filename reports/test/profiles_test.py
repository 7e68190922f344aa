"""Performance and data profiles of artificial problems must agree with shares calculated by hand."""
import math
import unittest

from reports import data, index, problems, profiles
from reports.problems import Question, any_defect, no_defect, to_the_smallest
from reports.test.results import series

LEVEL = 0.01


def tried(key, quantities, cost=1.0, missing=""):
    found = series(key, [
        data.Verdict(name, kind, truth=1.0, truth_kind="exact", error=error, truth_uncertainty=1e-9,
                     reach={LEVEL: 1} if reached else {})
        for name, (kind, error, reached) in quantities.items()
    ])
    found.meshes[0].cost = cost
    found.missing = missing
    return found


def case(name, *points):
    return data.Case(name, "", "", [data.Point(f"p{i}", str(i), list(s), {})
                                    for i, s in enumerate(points)])


GOOD, POOR = ("pass", 0.0, True), ("pass", 0.0, False)


def two():
    """Returns two cases with two formulations. Formulation a costs 1/2 of b in the first case and 1/4 of b in the
    second case, in which it solves only one of the two problems."""
    first = case("first", [tried("a", {"u": GOOD}, 1), tried("b", {"u": GOOD}, 2)])
    second = case("second", [tried("a", {"u": GOOD, "v": POOR}, 1),
                             tried("b", {"u": GOOD, "v": GOOD}, 4)])
    return [first, second]


def at(compared, question, factor, offered=False):
    places = profiles.places(profiles.FARTHEST[question.unit])
    return {k: s[places.index(factor)] for k, s in compared.profile(question, offered).items()}


class Shares(unittest.TestCase):

    def test_by_hand(self):
        pairs = [(1, 0.25), (2, 0.25), (3, 0.25), (math.inf, 0.25)]
        self.assertEqual(profiles.shares(pairs, [1, 1.9, 2, 10]), [0.25, 0.25, 0.5, 0.75, 0.75])

    def test_monotone_and_whole(self):
        pairs = [((i * 7919) % 101 + 1, 1.0) for i in range(100)]
        found = profiles.shares(pairs, profiles.places(100))
        self.assertEqual(found, sorted(found))
        self.assertEqual(found[-1], 1)

    def test_places(self):
        for farthest in (10, 100, 1000):
            found = profiles.places(farthest)
            self.assertEqual((found[0], found[-1]), (1, farthest))
            self.assertEqual(found, sorted(set(found)))
            self.assertIn(2, found)

    def test_rounding_keeps_ties(self):
        self.assertEqual(profiles.shares([(1 + 1e-12, 1.0)], [1]), [1, 1])


class Stairs(unittest.TestCase):

    def test_a_share_holds_from_its_factor_on(self):
        found = profiles.stairs([1, 2, 3, 5, 10], [0.25, 0.5, 0.5, 0.75, 0.75])
        self.assertEqual(found, ([1, 2, 2, 5, 5, 10], [0.25, 0.25, 0.5, 0.5, 0.75, 0.75]))

    def test_ticks_are_on_the_axis(self):
        for farthest in profiles.FARTHEST.values():
            axis = profiles.factors(farthest)
            values = [value for value, _ in axis.ticks()]
            self.assertEqual((values[0], values[-1]), (1, farthest))
            for value, part in zip(axis.part([1, farthest]), (0, 1)):
                self.assertAlmostEqual(value, part, 12)


class ByHand(unittest.TestCase):

    def setUp(self):
        self.compared = profiles.Compared(two())

    def test_factor_to_the_best(self):
        self.assertEqual(at(self.compared, Question(LEVEL), 1), {"a": 0.75, "b": 0.25})
        self.assertEqual(at(self.compared, Question(LEVEL), 2), {"a": 0.75, "b": 0.75})
        self.assertEqual(at(self.compared, Question(LEVEL), 4), {"a": 0.75, "b": 1})

    def test_factor_to_the_smallest(self):
        question = Question(LEVEL, unit=to_the_smallest)
        self.assertEqual(at(self.compared, question, 1), {"a": 0.75, "b": 0})
        self.assertEqual(at(self.compared, question, 2), {"a": 0.75, "b": 0.5})
        self.assertEqual(at(self.compared, question, 4), {"a": 0.75, "b": 1})

    def test_a_run_that_failed_is_no_unit(self):
        cases = [case("one", [tried("a", {"u": GOOD}, 3), tried("b", {"u": POOR}, 1)])]
        cases[0].points[0].series[1].meshes[0].status = "singular"
        question = Question(LEVEL, unit=to_the_smallest)
        self.assertEqual(at(profiles.Compared(cases), question, 1), {"a": 1, "b": 0})

    def test_ties_are_the_best_both(self):
        question = Question(LEVEL, "unknowns")
        self.assertEqual(at(self.compared, question, 1), {"a": 0.75, "b": 1})

    def test_nothing_reaches_a_level_that_is_not_there(self):
        self.assertEqual(at(self.compared, Question(0.1), 100), {"a": 0, "b": 0})

    def test_trust_and_speed(self):
        rows = {r.key: r for r in problems.trust_table(two(), self.compared.problems, ["a", "b"])}
        self.assertEqual([rows[k].solved for k in "ab"], [0.75, 1])
        self.assertEqual([rows[k].near for k in "ab"], [0.75, 0.75])
        self.assertEqual([rows[k].factor for k in "ab"], [1, 2])
        said = index.of_speed(self.compared, list(rows.values()))
        self.assertEqual((said["near"], said["most"], said["most_share"]), (["a", "b"], ["b"], 1))


class Weights(unittest.TestCase):

    def test_many_points_weigh_no_more(self):
        both = [tried("a", {"u": GOOD}), tried("b", {"u": POOR})]
        only_b = [tried("a", {"u": POOR}), tried("b", {"u": GOOD})]
        compared = profiles.Compared([case("many", *([both] * 60)), case("one", only_b)])
        self.assertEqual(len(compared.problems), 61)
        found = compared.profile(Question(LEVEL))
        self.assertAlmostEqual(found["a"][-1], 0.5, 12)
        self.assertAlmostEqual(found["b"][-1], 0.5, 12)

    def test_what_is_not_offered(self):
        skipped = tried("a", {"u": ("skip", math.nan, False)}, missing="warping")
        first = case("first", [tried("a", {"u": GOOD}), tried("b", {"u": GOOD})])
        compared = profiles.Compared([first, case("second", [skipped, tried("b", {"u": GOOD})])])
        question = Question(LEVEL)
        self.assertEqual([compared.profile(question)[k][-1] for k in "ab"], [0.5, 1])
        self.assertEqual([compared.profile(question, True)[k][-1] for k in "ab"], [1, 1])

    def test_second_names_and_other_truths(self):
        names = [tried(k, {"C_xx": GOOD, "C_ux_Fx": GOOD, "f": GOOD}) for k in "ab"]
        for one in names:
            one.meshes[0].values = {"C_xx": 2.0, "C_ux_Fx": 2.0, "f": 3.0}
            one.verdicts[2].truth_kind = "published"
        found = problems.problems([case("one", names)], ["a", "b"])
        self.assertEqual([p.quantity for p in found], ["C_ux_Fx"])


class Defects(unittest.TestCase):

    def test_known_defect_beyond_the_level(self):
        wrong = {"u": ("wrong limit", 0.02, True), "v": ("wrong limit", 0.005, True)}
        both = case("one", [tried("a", wrong), tried("b", {"u": GOOD, "v": GOOD})])
        compared = profiles.Compared([both])

        def solved(forbids=None):
            question = Question(LEVEL, forbids=forbids) if forbids else Question(LEVEL)
            return compared.profile(question)["a"][-1]

        self.assertEqual([solved(), solved(no_defect), solved(any_defect)], [0.5, 1, 0])


class Contestants(unittest.TestCase):

    def test_options_and_misprints_are_left_out(self):
        keys = ("sheet_third", "sheet_third_printed", "beamw", "beamw:mass=lumped")
        found = problems.contestants([case("one", [tried(k, {"u": GOOD}) for k in keys])])
        self.assertEqual(found, ["beamw", "sheet_third"])

    def test_what_only_options_were_run_on_is_no_problem(self):
        cases = [case("one", [tried("a", {"u": GOOD})], [tried("a:mass=lumped", {"u": GOOD})])]
        self.assertEqual([p.point for p in problems.problems(cases, ["a"])], ["p0"])

    def test_unless_nothing_else_was_run(self):
        found = problems.contestants([case("one", [tried("beamw:mass=lumped", {"u": GOOD})])])
        self.assertEqual(found, ["beamw:mass=lumped"])

    def test_eight_curves(self):
        keys = [f"f{i}" for i in range(10)]
        compared = profiles.Compared([case("one", [tried(k, {"u": GOOD}) for k in keys])])
        self.assertEqual(len(compared.curves), 8)
        self.assertEqual(sorted(compared.profile(Question(LEVEL))), keys)

    def test_without_counted_work(self):
        tries = [tried(k, {"u": GOOD}, math.nan) for k in "ab"]
        compared = profiles.Compared([case("one", tries)])
        row, _ = problems.trust_table([case("one", tries)], compared.problems, compared.keys)
        self.assertFalse(compared.any)
        self.assertTrue(math.isnan(row.solved) and math.isnan(row.factor))

    def test_nothing_to_compare(self):
        alone = profiles.Compared([case("one", [tried("a", {"u": GOOD})])])
        none = profiles.Compared([case("one", [tried("a", {}), tried("b", {})])])
        self.assertEqual([alone.any, none.any, none.curves], [False, False, []])


class Sentences(unittest.TestCase):

    def test_of_trust(self):
        cases = [case("one", [tried("a", {"u": ("wrong limit, as predicted", 0.1, False),
                                          "v": ("wrong limit", 0.1, False)}),
                              tried("b", {"u": GOOD, "v": ("diverged", math.nan, False)}),
                              tried("c", {"u": GOOD, "v": GOOD})])]
        compared = profiles.Compared(cases)
        said = index.of_trust(cases, problems.trust_table(cases, compared.problems, compared.keys))
        self.assertEqual((said["never"], said["worst"], said["where"]), (["c"], "a", ["one"]))
        self.assertEqual((said["wrong"], said["derived"], said["times"]), (2, 1, 2))

    def test_of_truths(self):
        said = index.of_truths([case("one", [tried("a", {"u": GOOD, "v": GOOD})])])
        self.assertEqual((said["number"], said["kinds"], said["half"]), (2, {"exact": 2}, 1e-9))
        self.assertIsNone(index.of_truths([case("one", [tried("a", {})])]))


class Median(unittest.TestCase):

    def test_of_weights(self):
        self.assertEqual(problems.median([(3, 1), (1, 1), (2, 1)]), 2)
        self.assertEqual(problems.median([(1, 0.7), (5, 0.3)]), 1)
        self.assertTrue(math.isnan(problems.median([])))


if __name__ == "__main__":
    unittest.main()
