"""Bounds of the ledger: the rule by which they are set, and what is said where they differ."""
import unittest

from harness.tools import bounds


def verdict(error, limit=1.0, predicted=None, kind="biased", rule="a"):
    truth = None if limit is None or error is None else limit / (1 + error)
    return {"finding": rule, "error": error, "limit": limit, "predicted": predicted,
            "truth": truth, "verdict": kind}


class Bounds(unittest.TestCase):
    def test_rule(self):
        """1, 2, 5 times a power of ten, never below what was seen."""
        for seen, bound in ((0.74, "1"), (0.2, "0.2"), (0.2001, "0.5"), (2.1e-5, "5e-05"),
                            (1e-9, "1e-09"), (2.966, "5"), (5.0001, "10"), (None, "")):
            self.assertEqual(bounds.bound_of(seen), bound)

    def said(self, allowed, verdicts):
        rule = {"rule": "a", "largest_error": allowed}
        one, = bounds.lines([rule], verdicts)
        return one

    def test_what_differs_is_said(self):
        given = [verdict(-3e-4), verdict(1e-4), verdict(0.5, rule="")]
        self.assertTrue(self.said("3e-4", given)["stands"])
        for allowed in ("2e-4", "5e-4", "1e-3", ""):
            one = self.said(allowed, given)
            self.assertFalse(one["stands"])
            self.assertIn("should allow 0.0003", bounds.text_of(one))

    def test_loose(self):
        """Ten times what is seen beside a derived limit, 1.5 times without one; each by itself."""
        derived = {**verdict(-0.25, 3.0, 3.004, bounds.PREDICTED), "truth": 4.0}  # by 1e-3
        for allowed, verdicts, loose in (("1e-2", [derived], False), ("1.1e-2", [derived], True),
                                         ("1.5e-3", [verdict(1e-3)], False), ("1.6e-3", [verdict(1e-3)], True),
                                         ("1e-3", [derived, verdict(1e-9)], True), ("", [verdict(None)], False),
                                         ("1e-3", [derived, verdict(9e-4)], False)):
            self.assertEqual(self.said(allowed, verdicts)["loose"], loose, allowed)
        self.assertIn("a rule of their own", bounds.text_of(self.said("1e-3", [derived, verdict(1e-9)])))

    def test_derived_limits_bind(self):
        """The distance counts from the derived limit where there is one, in parts of the truth."""
        derived = {**verdict(-0.25, 3.0, 3.004, bounds.PREDICTED), "truth": 4.0}
        self.assertAlmostEqual(self.said("1e-3", [derived])["seen"], 1e-3)
        self.assertAlmostEqual(self.said("1", [derived, verdict(2e-3)])["seen"], 2e-3)

    def test_without_an_error(self):
        given = [verdict(None, limit=None, kind="diverged")]
        self.assertTrue(self.said("", given)["stands"])
        self.assertFalse(self.said("1e-3", given)["stands"])

    def test_covered(self):
        """Whatever the verdict; 3 U and what the prediction is known to."""
        given = [{**verdict(0.1, limit, 2.0), "limit_uncertainty": 1e-6}
                 for limit in (2.0, 2.0000029, 2.0000031, None)]
        self.assertEqual(bounds.covered(given + [verdict(0.1)]), (2, 3))

    def test_digits_of_the_farthest(self):
        met = [verdict(0.1, limit, 2.0, bounds.PREDICTED) for limit in (2.0002, 1.99999, 2.0)]
        one = self.said("0.1", met + [verdict(0.1, 3.0, 2.0, "undecided")])
        self.assertAlmostEqual(one["digits"], 4.0, places=3)
        self.assertEqual(one["met"], 3)
        self.assertIsNone(self.said("0.1", [verdict(0.1)])["digits"])


if __name__ == "__main__":
    unittest.main()
