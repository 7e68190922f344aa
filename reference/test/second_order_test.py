"""The derived modified modes must equal N Eq. 37 (apart from the factor l/l0 of the shear strain),
J Eq. 66 without shear and the corrected J Eq. 66, exactly (reference/derive/second_order.py)."""
import pathlib
import sys
import unittest
from fractions import Fraction

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
from reference.derive import second_order  # noqa: E402


class ModifiedModes(unittest.TestCase):

    def test_sheet_element_consistent_with_shear(self):
        same, stretched = second_order.against_sheet()
        self.assertEqual((len(same), second_order.largest(same)), (28, 0))
        self.assertEqual((len(stretched), second_order.largest(stretched)), (8, 0))

    def test_eq66_without_shear(self):
        gaps = second_order.against_eq66()
        self.assertEqual((len(gaps), second_order.largest(gaps)), (72, 0))

    def test_eq66_repaired(self):
        gaps = second_order.against_all_modes()
        self.assertEqual((len(gaps), second_order.largest(gaps)), (110, 0))

    def test_theories_differ_with_shear_only(self):
        e, zero = [Fraction(k, 7) for k in range(8)], (Fraction(0), Fraction(0))
        for g, equal in ((zero, True), ((Fraction(1, 3), Fraction(0)), False)):
            both = [second_order.simo_reissner(e, zero, g, Fraction(1, 5), c) for c in (0, 1)]
            self.assertEqual(both[0] == both[1], equal)

    def test_warping_of_the_sheet_element(self):
        self.assertGreater(second_order.warping_of_sheet(), 1)


if __name__ == "__main__":
    unittest.main()
