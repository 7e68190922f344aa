"""Comparison of a formulation in another process with timoshenko.c: the verdicts must be equal, and the limits must
agree within 1e-7."""
import json

from harness.cli.test.plugin import EXAMPLES, compile_shared
from harness.tools.kit.program import ProgramTest


class BesideC(ProgramTest):

    def verdicts(self, element, name, cases):
        record = self.folder / "v.json"
        self.answered("verify", "--element", element, "-f", name, "-k",
                      " or ".join(f"{case}/default" for case in cases), "--json", record)
        return json.loads(record.read_text(encoding="utf-8"))["verdicts"]

    def like_timoshenko(self, element, name, cases):
        there = compile_shared(EXAMPLES / "timoshenko.c", self.folder / "timoshenko.so")
        here = self.verdicts(element, name, cases)
        there = self.verdicts(there, "timoshenko", cases)
        self.assertEqual([(v["case"], v["quantity"], v["verdict"]) for v in here],
                         [(v["case"], v["quantity"], v["verdict"]) for v in there])
        for mine, other in zip(here, there):
            if mine["limit"] is not None:
                self.assertLess(abs(mine["limit"] - other["limit"]), 1e-7 * abs(other["limit"]),
                                (mine["case"], mine["quantity"]))
        return {v["case"] for v in here if v["verdict"] == "pass"}
