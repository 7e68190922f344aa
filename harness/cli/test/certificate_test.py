"""`element-test`: what it prints and writes of formulations that satisfy the interface requirements or do not."""
import json

from harness.cli.test.element_test_test import EXAMPLES, FAULTS, Tested
from harness.tools.kit.program import environment, run


class Certificates(Tested):

    def test_all_keep_the_contract(self):
        record = self.record("element-test", "all")
        listed = run("list", "formulations").stdout
        for one in record["formulations"]:
            self.assertTrue(one["kept"], one["formulation"])
            self.assertIn(one["formulation"], listed)
            self.assertGreater(one["compared"], 5000)
            along = [c["outcome"] for c in record["claims"]
                     if (c["formulation"], c["family"]) == (one["formulation"], "along")]
            self.assertEqual(set(along), {"holds"})
            self.assertGreaterEqual(len(along), 2)
        self.assertEqual([m for m in record["measured"] if m["wrong_limit"]], [])
        self.assertGreaterEqual(len(record["formulations"]), 10)

    def test_examples_keep_it(self):
        """All but the one that needs a compiler of Fortran, which has tests of its own."""
        for source in sorted(set(EXAMPLES.glob("*.c")) - {EXAMPLES / "uel.c"}):
            out = self.answered("element-test", "--element", self.compiled(source.name)).stdout
            self.assertIn("interface requirements: SATISFIED", out)
            self.assertIn("not applicable", out)
            self.assertIn("loads along one element are as exact as forces at its nodes (97 compared)",
                          out)

    def test_with_options(self):
        out = self.answered("element-test", "collocation:stages=3", "geometrically_exact:nodes=2",
                            "--quiet").stdout
        self.assertIn("2 of 2 formulations satisfy the interface requirements", out)

    def test_width(self):
        out = self.answered("element-test", "all", "-v", env=environment(LC_ALL="C")).stdout
        self.assertTrue(out.isascii())
        self.assertLessEqual(max(map(len, out.splitlines())), 100)

    def test_quiet(self):
        self.assertEqual(self.answered("element-test", "beamw", "-q").stdout, "beamw: SATISFIED\n")

    def test_quiet_tells_what_is_broken(self):
        made = self.compiled("timoshenko.c", FAULTS["energy"][0])
        out = self.answered("element-test", "--element", made, "-q", code=1).stdout
        self.assertIn("interface requirements: VIOLATED", out)
        self.assertIn("sigma 1", " ".join(out.split()))
        self.assertNotIn("declared", out)

    def test_file(self):
        path = self.folder / "certificates.json"
        out = self.answered("element-test", "beamw", "--json", path).stdout
        self.assertIn("interface requirements: SATISFIED", out)
        found = json.loads(path.read_text(encoding="utf-8"))
        self.assertEqual([c["formulation"] for c in found["formulations"]], ["beamw"])

    def test_refused(self):
        self.refused(2, ("name a formulation", "--element ./mine.so"), "element-test")
        self.refused(2, "beamv", "element-test", "beamv")
        self.refused(2, "text or json", "element-test", "beamw", "--format", "csv")
        self.refused(2, "twice", "element-test", "beamw", "beamw")
