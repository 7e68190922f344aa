"""The table of analytic predictions: errors against the truth of the point, nothing where there is none."""
import unittest

from reports import data, predictions


def point(prediction):
    mesh = data.Mesh(1,
                     "ok",
                     "",
                     data.Clock(0, 1e-3, 1e-3, 1e-3, 1),
                     8,
                     4,
                     "", {},
                     values={"C_zz": 2.2},
                     errors={"C_zz": 0.1},
                     predictions=prediction)
    verdict = data.Verdict("C_zz",
                           "pass",
                           truth_kind="exact",
                           truth=2.0,
                           limit=2.0,
                           order=2.0,
                           error=0.0)
    return data.Point("default", "", [data.Series("beam", "", "", "", [mesh], [verdict])],
                      {"C_zz": "m/N"})


class Predictions(unittest.TestCase):

    def test_errors(self):
        rows = predictions.of_point(point({"C_zz": 2.1}))
        self.assertEqual([(r[0], r[1], r[3]) for r in rows], [("C_zz", 2.1, [("beam", 1, 0.1)])])
        self.assertAlmostEqual(rows[0][2], 0.05)

    def test_section(self):
        case = data.Case("sheet", "", "", [point({"C_zz": 2.1}), point({})])
        (heading, markup), = predictions.section(None, case)
        self.assertEqual(heading, "Analytic prediction")
        self.assertEqual(markup.count("<table>"), 1)
        self.assertIn("+5.0000 %", markup)
        self.assertNotIn("&lt;", markup)
        self.assertEqual(predictions.section(None, data.Case("other", "", "", [point({})])), [])


if __name__ == "__main__":
    unittest.main()
