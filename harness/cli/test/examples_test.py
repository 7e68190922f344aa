"""Every example of a formulation: compiled as a stranger would, short, and judged on ten cases."""
import re

from harness.cli.test.plugin import EXAMPLES, WARNINGS, PluginTest, compile_shared
from harness.test.program import read_json

STATICS_AND_FREQUENCIES = ("tapered_cantilever", "deep_beam", "tip_body", "sprung_beam",
                           "loaded_cantilever", "elastica", "snap_through", "right_angle_frame")


class Judged:
    """What holds for each: limits that are right, and no more lines than the table says."""

    cases = ()

    @classmethod
    def setUpClass(cls):
        cls.object = compile_shared(EXAMPLES / f"{cls.example}.c",
                                    cls.class_folder() / f"{cls.example}.so", *WARNINGS)

    def test_short(self):
        lines = (EXAMPLES / f"{self.example}.c").read_text(encoding="utf-8").splitlines()
        table = (EXAMPLES / "README.md").read_text(encoding="utf-8")
        promised = re.search(rf"^\| `{self.example}\.c` \| (\d+) \|", table, re.MULTILINE)
        self.assertLessEqual(len(lines), int(promised[1]))
        self.assertLessEqual(len(lines), 200)
        self.assertEqual([line for line in lines if line.startswith('#include "')],
                         ['#include "elements/element.h"'])

    def test_judged_like_the_others(self):
        """Ten cases, statics, vibration and buckling."""
        record = self.folder / "v.json"
        self.assertEqual(len(self.cases), 10)
        self.answered("verify", "--element", self.object, "-f", self.example, "-k",
                      " or ".join(f"{case}/default" for case in self.cases), "--json", record)
        found = [v for v in read_json(record)["verdicts"]
                 if v["verdict"] not in ("skip", "no truth")]
        self.assertEqual({v["case"] for v in found} - {"shear_elastica"}, set(self.cases))
        self.assertEqual([v for v in found if v["verdict"] != "pass"], [])


class Timoshenko(Judged, PluginTest):
    example = "timoshenko"
    cases = (*STATICS_AND_FREQUENCIES, "weighted_column", "bend_45")


class Corotational(Judged, PluginTest):
    example = "corotational"
    cases = (*STATICS_AND_FREQUENCIES, "weighted_column", "lateral_buckling")

    def test_converges_as_the_others(self):
        """A tangent that is not symmetric, and a chord that hardly stretches: as few iterations."""
        for axial in ("1e4", "1e12"):
            iterations = {
                name: self.record("solve", "elastica", "--element", self.object, "-f", name, "-n",
                                  "8", "-s", "load=10", "-s", f"axial={axial}")["cell"]["iterations"]
                for name in (self.example, "beamw_first")
            }
            self.assertLessEqual(iterations[self.example], iterations["beamw_first"] + 1)


class Ancf(Judged, PluginTest):
    example = "ancf"
    cases = ("elastica", "sprung_beam", "lateral_buckling", "loaded_cantilever", "roll_up",
             "rotating_cantilever", "snap_through", "tapered_cantilever", "tip_body",
             "weighted_column")
