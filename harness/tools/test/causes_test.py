"""Tests of the causes of known deviations and of their bounds."""
import pathlib
import re
import unittest
from unittest import mock

from harness.tools import bounds, causes


ROOT = pathlib.Path(__file__).resolve().parents[3]
ABOUT = {
    "name",
    "summary",
    "source",
    "offers",
    "limits",
    "lacks",
    "lacks_by",
    "shear_theories",
    "own_theory",
}
STRESS_FUNCTION = {"data_size", "prepare", "stress", "geometric", "stress_many",
                   "equations_many", "tension", "misprint", "along"}


def source(formulation):
    text = (ROOT / "elements" / f"{formulation}.c").read_text(encoding="utf-8")
    return re.sub(r"/\*.*?\*/", "", text, flags=re.S)


def shared():
    found = {}
    for header in (ROOT / "elements").glob("*/*.h"):
        text = header.read_text(encoding="utf-8").replace("\\\n", " ")
        found.update(re.findall(r"#define (\w+)[ \t]+(\S.*)", text))
    return found


def members(formulation):
    body, macros = source(formulation).split(f"element_{formulation} = {{")[1], shared()
    for _ in range(3):
        body = re.sub(r"(?<![.\w])([A-Z]\w+)(?=,)", lambda m: macros.get(m[1], m[1]), body)
    return dict(re.findall(r"\.(\w+) =\s*(.*?),\s*(?=\.|\};)", body, re.S))


def words_of_prepare(formulation):
    body = re.search(r"static status prepare\(.*?\n\}\n", source(formulation), re.S).group(0)
    return re.findall(r"\w+|[^\w\s]", body)


class OneThing(unittest.TestCase):

    def pairs(self, with_options):
        found = causes.SIBLINGS + causes.OF_VIBRATION
        return [(a, b) for a, b, _ in found if (":" in b) == with_options]

    def differing(self, a, b):
        one, other = members(a), members(b)
        return {name
                for name in one.keys() | other.keys() if one.get(name) != other.get(name)} - ABOUT

    def test_formulations(self):
        for a, b in self.pairs(False):
            differing = self.differing(a, b)
            if differing:
                self.assertLessEqual(differing, STRESS_FUNCTION, (a, b))
                continue
            one, other = words_of_prepare(a), words_of_prepare(b)
            self.assertEqual(len(one), len(other), (a, b))
            self.assertEqual(sum(x != y for x, y in zip(one, other)), 1, (a, b))

    def test_what_differs_in_more_is_seen(self):
        self.assertGreater(len(self.differing("beamw", "beamw_consistent")), 2)
        self.assertFalse(self.differing("beamw", "beamw_consistent") <= STRESS_FUNCTION)

    def test_options(self):
        choices = (ROOT / "elements" / "beamw" / "prepare.c").read_text(encoding="utf-8")
        for a, b in self.pairs(True):
            name, _, option = b.partition(":")
            key, _, value = option.partition("=")
            self.assertEqual((name, option.count(",")), (a, 0))
            listed = re.search(rf'"{key}",\s*"",[^"]*"([\w|]+)"', choices.replace("\\",
                                                                                  " ")).group(1)
            self.assertIn(value, listed.split("|"))

    def test_both_ways(self):
        for a, b, what in causes.SIBLINGS:
            self.assertIn((b, what), causes.siblings(a, False))
            self.assertIn((a, what), causes.siblings(b, False))


def verdict(rule, case, error):
    return {
        "finding": rule,
        "case": case,
        "error": error,
        "parameters": "",
        "formulation": "beamw",
        "quantity": "load",
        "verdict": "wrong limit",
        "predicted": None,
        "reason": "",
        "unit": "N",
        "truth": 1.0,
    }


class Choice(unittest.TestCase):

    def test_the_worst_of_each_case(self):
        given = [
            verdict("a", "x", 0.1),
            verdict("a", "x", -0.3),
            verdict("a", "y", None),
            verdict("", "x", 9),
        ]
        found = causes.worst_of(given)
        self.assertEqual({key: v["error"]
                          for key, v in found.items()}, {("a", "x"): -0.3, ("a", "y"): None})

    def test_every_rule_before_a_second_case(self):
        keys = [("a", "x"), ("a", "y"), ("b", "x"), ("a", "z")]
        order = causes.rounds({key: verdict(*key, 0.1) for key in keys})
        self.assertEqual({rule for rule, _ in order[:2]}, {"a", "b"})
        self.assertEqual(sorted(order), sorted(keys))


class Outcome(unittest.TestCase):

    def laboratory(self, errors):
        made = causes.Laboratory("program", 0)

        def series(case, formulation, parameters, meshes):
            error = errors.get(parameters, errors.get(formulation))
            record = {
                "limit": 1 + error,
                "limit_uncertainty": 0.0,
                "truth": 1.0,
                "error": error,
                "reason": "",
            }
            return {"load": record}, ""

        made.series = series
        return made

    def study(self, errors):
        with mock.patch.object(causes, "switches", lambda *_: ["shear"]):
            return causes.study(self.laboratory(errors), verdict("a", "x", 0.1))["experiments"]

    def test_what_takes_the_error_away(self):
        found = self.study({(): 0.1, ("shear=0", ): 1e-6, "beamw_first": 0.1})
        self.assertEqual(
            [(e["kind"], e["gone"]) for e in found],
            [("finer", False), ("without", True), ("instead", False)],
        )

    def test_coarse_meshes(self):
        self.assertTrue(self.study({(): 1e-5, ("shear=0", ): 1e-5, "beamw_first": 1e-5})[0]["gone"])

    def test_a_failure_is_gone_where_a_value_is_right(self):
        self.assertTrue(causes.is_gone(1e-4, None))
        self.assertFalse(causes.is_gone(1e-2, None))
        self.assertFalse(causes.is_gone(None, None))
        self.assertFalse(causes.is_gone(None, 0.1))

    def test_what_has_no_value_is_tried_with_the_other_newton(self):
        with mock.patch.object(causes, "switches", lambda *_: []):
            found = causes.experiments(self.laboratory({(): 1e-6}), verdict("a", "x", None))
        self.assertEqual(found[-1]["formulation"], "beamw:newton=displacement")
        self.assertEqual(causes.newton_of("a:b=c")[0], "a:b=c,newton=displacement")

    def test_time_is_bounded(self):
        found = causes.Laboratory("/nowhere/program", 0).limit("x", "beamw", (), "load", 1.0)
        self.assertIn("not run", found["why"])

    def test_nothing_is_written_into_the_reference(self):
        text = (ROOT / "harness" / "tools" / "causes.py").read_text(encoding="utf-8")
        self.assertNotIn("findings.csv", text)


def verdict_of_bounds(error, limit=1.0, predicted=None, kind="biased", rule="a"):
    truth = None if limit is None or error is None else limit / (1 + error)
    return {"finding": rule, "error": error, "limit": limit, "predicted": predicted,
            "truth": truth, "verdict": kind}


class Bounds(unittest.TestCase):

    def test_rule(self):
        for seen, bound in ((0.74, "1"), (0.2, "0.2"), (0.2001, "0.5"), (2.1e-5, "5e-05"),
                            (1e-9, "1e-09"), (2.966, "5"), (5.0001, "10"), (None, "")):
            self.assertEqual(bounds.bound_of(seen), bound)

    def said(self, allowed, verdicts):
        rule = {"rule": "a", "largest_error": allowed}
        one, = bounds.lines([rule], verdicts)
        return one

    def test_what_differs_is_said(self):
        given = [verdict_of_bounds(-3e-4), verdict_of_bounds(1e-4), verdict_of_bounds(0.5, rule="")]
        self.assertTrue(self.said("3e-4", given)["stands"])
        for allowed in ("2e-4", "5e-4", "1e-3", ""):
            one = self.said(allowed, given)
            self.assertFalse(one["stands"])
            self.assertIn("should allow 0.0003", bounds.text_of(one))

    def test_loose(self):
        derived = {**verdict_of_bounds(-0.25, 3.0, 3.004, bounds.PREDICTED), "truth": 4.0}
        for allowed, verdicts, loose in (("1e-2", [derived], False), ("1.1e-2", [derived], True),
                                         ("1.5e-3", [verdict_of_bounds(1e-3)], False), ("1.6e-3", [verdict_of_bounds(1e-3)], True),
                                         ("1e-3", [derived, verdict_of_bounds(1e-9)], True), ("", [verdict_of_bounds(None)], False),
                                         ("1e-3", [derived, verdict_of_bounds(9e-4)], False)):
            self.assertEqual(self.said(allowed, verdicts)["loose"], loose, allowed)
        self.assertIn("a separate entry", bounds.text_of(self.said("1e-3", [derived, verdict_of_bounds(1e-9)])))

    def test_derived_limits_bind(self):
        derived = {**verdict_of_bounds(-0.25, 3.0, 3.004, bounds.PREDICTED), "truth": 4.0}
        self.assertAlmostEqual(self.said("1e-3", [derived])["seen"], 1e-3)
        self.assertAlmostEqual(self.said("1", [derived, verdict_of_bounds(2e-3)])["seen"], 2e-3)

    def test_without_an_error(self):
        given = [verdict_of_bounds(None, limit=None, kind="diverged")]
        self.assertTrue(self.said("", given)["stands"])
        self.assertFalse(self.said("1e-3", given)["stands"])

    def test_covered(self):
        """A limit must count as covered if it is within three times its uncertainty plus that of the prediction."""
        given = [{**verdict_of_bounds(0.1, limit, 2.0), "limit_uncertainty": 1e-6}
                 for limit in (2.0, 2.0000029, 2.0000031, None)]
        self.assertEqual(bounds.covered(given + [verdict_of_bounds(0.1)]), (2, 3))

    def test_digits_of_the_farthest(self):
        met = [verdict_of_bounds(0.1, limit, 2.0, bounds.PREDICTED) for limit in (2.0002, 1.99999, 2.0)]
        one = self.said("0.1", met + [verdict_of_bounds(0.1, 3.0, 2.0, "undecided")])
        self.assertAlmostEqual(one["digits"], 4.0, places=3)
        self.assertEqual(one["met"], 3)
        self.assertIsNone(self.said("0.1", [verdict_of_bounds(0.1)])["digits"])


if __name__ == "__main__":
    unittest.main()
