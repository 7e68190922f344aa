"""Formulations whose times rank nothing, in bench and converge: shown, marked, never the cheapest."""
import json
import subprocess

from harness.tools.kit.program import ROOT, ProgramTest

MARK = "timoshenko: by differences, its times rank nothing"


class Unranked(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.object = cls.class_folder() / "mine.so"
        subprocess.run(["cc", "-O2", "-shared", "-fPIC", "-I", ROOT,
                        ROOT / "elements" / "examples" / "timoshenko.c", "-o", cls.object],
                       check=True)

    def bench(self, *options):
        return self.answered("bench", "tapered_cantilever", "--element", self.object, "-f",
                             "timoshenko", *options).stdout

    def test_table(self):
        out = " ".join(self.bench("-f", "collocation", "-n", "4,8,16,32").split())
        self.assertEqual(out.count(MARK), 1)
        self.assertNotIn("collocation: by differences", out)
        self.assertRegex(out, r"stretch within 10, 1 %: collocation, n = 4, [^;]*; also within it: "
                         r"timoshenko, n = 4, [0-9.e-]+ ms \(by differences: no rank\)")

    def test_alone(self):
        """Nobody is the cheapest where nobody ranks."""
        out = " ".join(self.bench("-n", "4,8,16,32").split())
        self.assertRegex(out, r"stretch within 10, 1 %: none that ranks; also within it: timoshenko")

    def test_against(self):
        """At equal error and at equal elements, as text and as JSON."""
        out = " ".join(self.bench("--against", "collocation", "-k", "stretch", "--error",
                                  "1%").split())
        self.assertIn("no rank: beside", out)
        self.assertNotIn("is faster", out)
        at = ("--against", "collocation", "-n", "2")
        out = self.bench(*at)
        self.assertIn("pairs): unranked", out)
        self.assertIn("by differences, its times rank nothing", out)
        self.assertEqual(json.loads(self.bench(*at, "--format", "json"))["outcome"], "unranked")

    def test_ranked_ones_are(self):
        out = self.answered("bench", "tapered_cantilever", "-f", "collocation", "--against",
                            "beamw_consistent", "-k", "stretch", "--error", "1%").stdout
        self.assertNotIn("rank", out)

    def test_converge_names_what_is_missed(self):
        out = self.answered("converge", "tapered_cantilever", "-f", "beamw", "-n", "2,4",
                            "--error", "0.01%").stdout
        self.assertRegex(" ".join(out.split()), r"not reached by beamw \(\w+: [0-9.]+ %\)")
