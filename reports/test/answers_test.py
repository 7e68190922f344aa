"""The choice of the winner: the least mesh that stays within a level, ranked by counted work; what
does not pass is never the cheapest; costs nearer than prices are known tie; clocks have no say."""
import math
import random
import unittest

from reports import answers, data
from reports.test.results import verdict


def clock(*rounds):
    return data.Clock(0, min(rounds), min(rounds), max(rounds), 5 if len(rounds) > 1 else 1, rounds)


def series(key, errors, costs, kind="pass", seconds=None):
    """One quantity `u` on meshes 1, 2, 4, ..."""
    meshes = [data.Mesh(2**i, "ok", "", clock(*((seconds or {}).get(2**i, (1.0,)))), 8, 4, "", {},
                        errors={"u": e}, cost=c)
              for i, (e, c) in enumerate(zip(errors, costs))]
    out = data.Series(key, "", "", "", meshes, [verdict("u", kind, truth=1.0)])
    out.verdicts[0].reach = {level: n for level in data.REACH
                             if (n := answers.first_within(out, "u", level))}
    return out


def answer(*found, level=0.01, quantity="u", noise=1.25):
    return answers.answer(data.Point("default", "", list(found), {}, [], noise), quantity, level)


def told(ways):
    return [(w.key, w.n) for w in ways]


class Mesh(unittest.TestCase):

    def test_a_dip_is_no_arrival(self):
        dips = series("dips", (0.005, 0.05, 0.002, 0.001), (1, 2, 4, 8))
        self.assertEqual(told(answer(dips).best), [("dips", 4)])
        self.assertEqual(told(answer(dips, level=0.1).best), [("dips", 1)])
        lost = series("lost", (0.005, 0.001, math.nan), (1, 2, 4))
        self.assertEqual(answer(lost).missed, ["lost"])

    def test_any_level_by_the_same_rule(self):
        one = series("one", (-0.2, 0.03, -0.003, 0.003, 0.0004), (1, 2, 4, 8, 16))
        for level, n in ((0.5, 1), (0.2, 1), (0.19, 2), (0.03, 2), (0.003, 4), (0.001, 16),
                         (1e-4, None)):
            found = answer(one, level=level).best
            self.assertEqual(told(found), [("one", n)] if n else [], level)


class Order(unittest.TestCase):

    def test_work_ranks_and_clocks_do_not(self):
        fast = series("dear", (0.001,), (2e-3,), seconds={1: (1e-4, 1.1e-4)})
        slow = series("cheap", (0.001,), (1e-3,), seconds={1: (5e-4, 6e-4)})
        found = answer(fast, slow)
        self.assertEqual(told(found.best), [("cheap", 1)])
        self.assertEqual(told(found.faster), [("dear", 1)])
        overlap = series("dear", (0.001,), (2e-3,), seconds={1: (1e-4, 5.5e-4)})
        self.assertEqual(answer(overlap, slow).faster, [])

    def test_ties(self):
        one, two, three = (series(k, (0.001,), (c,)) for k, c in (("one", 1.2), ("two", 1.0),
                                                                 ("three", 1.3)))
        found = answer(one, two, three)
        self.assertEqual(told(found.best), [("two", 1), ("one", 1)])
        self.assertEqual(told(found.dearer), [("three", 1)])
        self.assertEqual([(w.key, rank, tie) for w, rank, tie in found.ways],
                         [("two", 1, True), ("one", 2, True), ("three", 3, False)])
        self.assertEqual(told(answer(series("b", (0,), (1,)), series("a", (0,), (1,))).best),
                         [("a", 1), ("b", 1)])

    def test_times_shuffled_by_three_change_nothing(self):
        dice = random.Random(16)
        kinds = ("pass", "pass", "wrong limit")
        found = [series(f"f{i}", sorted((10**dice.uniform(-5, -1) for _ in range(5)), reverse=True),
                        [dice.uniform(1, 5) * 2**k for k in range(5)], dice.choice(kinds))
                 for i in range(9)]

        def answered():
            return [[told(part) for part in (a.best, a.dearer, a.defective)]
                    for a in (answer(*found, level=level) for level in (0.1, 0.01, 0.003, 1e-3))]

        before = answered()
        for s in found:
            for m in s.meshes:
                m.clock = clock(*(m.clock.least * 3**dice.uniform(-1, 1) for _ in range(5)))
        self.assertEqual(answered(), before)


    def test_variants_that_repeat(self):
        plain, same = series("one", (0.02, 0.001), (1, 2)), series("one:mass=lumped", (0.02, 0.001),
                                                                   (1, 2))
        self.assertEqual(told(answer(plain, same).best), [("one", 2)])
        self.assertEqual(told(answer(same).best), [("one:mass=lumped", 2)])
        for other in (series("one:mass=lumped", (0.03, 0.001), (1, 2)),
                      series("one:mass=lumped", (0.02, 0.001), (1, 2.1))):
            self.assertEqual(len(answer(plain, other).best), 2)


class Defects(unittest.TestCase):

    def test_never_the_cheapest(self):
        for kind in ("biased", "wrong limit", "biased, as predicted", "wrong limit, as predicted",
                     "low order", "undecided", "diverged"):
            wrong = series("wrong", (0.001,), (1,), kind)
            right = series("right", (0.001,), (100,))
            found = answer(wrong, right)
            self.assertEqual(told(found.best), [("right", 1)], kind)
            self.assertEqual(told(found.defective), [("wrong", 1)], kind)
            self.assertTrue(answers.defect_words(found.defective[0]))
            alone = answer(wrong)
            self.assertEqual((alone.best, told(alone.defective)), ([], [("wrong", 1)]), kind)

    def test_of_all_quantities_one_is_enough(self):
        one = series("one", (0.001,), (1,))
        one.meshes[0].errors["v"] = 0.002
        one.verdicts.append(verdict("v", "biased", truth=1.0, error=0.002))
        one.verdicts[1].reach = {0.01: 1}
        self.assertEqual(told(answer(one).best), [("one", 1)])
        found = answer(one, quantity=answers.ALL)
        self.assertEqual((found.best, told(found.defective)), ([], [("one", 1)]))

    def test_without_a_truth_of_its_theory(self):
        one, two = series("one", (0.001,), (1,)), series("two", (0.001,), (1,))
        two.verdicts[0].truth = math.nan
        found = answer(one, two)
        self.assertEqual((told(found.best), found.unjudged), ([("one", 1)], ["two"]))


if __name__ == "__main__":
    unittest.main()
