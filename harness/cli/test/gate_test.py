"""What is asked for gates: wrong elements through every door by which a run says how it ended."""
import json
import subprocess
import sys
import unittest
import xml.etree.ElementTree

import h5py

from harness.python.test.module import SETTINGS, sanitized
from harness.test.program import ROOT, ProgramTest, environment, report, run

EXAMPLE = ROOT / "elements" / "examples" / "timoshenko.c"
NAME = "timoshenko"
RUN = ("-k", "elastica/default or tapered_cantilever/default")
NOWHERE = ("-k", "hexapod/default")
FAULTS = {
    "right": ("", "", "pass"),
    "stiffness": ("1 / Fy,", "1.1 / Fy,", "fail"),
    "coupling": ("c->young * c->Iy / l3", "1.1 * c->young * c->Iy / l3", "fail"),
    "torsion": ("c->shear_modulus * c->It / l3", "0.9 * c->shear_modulus * c->It / l3", "fail"),
    "energy": ("out->sigma[i] = d->stiffness[i] * e[i];", "out->sigma[i] = 1.1 * d->stiffness[i] * e[i];", "fail"),
    "stub": ("energy += d->stiffness[i] * e[i] * e[i] / 2;", "energy += 0;", "fail"),
}
OUTCOMES = {"pass": 0, "fail": 1, "nothing was judged": 3}
PYTHON = """
import beamwork as bw, sys
bw.load(sys.argv[1])
found = bw.verify("timoshenko", select=sys.argv[2])
print(found.passed, found.outcome)
"""


class Gate(ProgramTest):
    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        text = EXAMPLE.read_text(encoding="utf-8")
        cls.element = {}
        for name, (before, after, _) in FAULTS.items():
            assert not before or text.count(before) == 1, name
            source = folder / f"{name}.c"
            source.write_text(text.replace(before, after) if before else text, encoding="utf-8")
            cls.element[name] = folder / f"{name}.so"
            subprocess.run(["cc", "-O2", "-shared", "-fPIC", "-I", ROOT, source, "-o", cls.element[name]], check=True)

    def verified(self, element, *options, what=RUN, named=("-f", NAME)):
        """The process, and what its files say."""
        files = {kind: self.folder / f"out.{kind}" for kind in ("json", "xml", "md", "h5")}
        done = run("verify", "--element", self.element[element], *named, *what, "--json", files["json"],
                   "--junit", files["xml"], "--markdown", files["md"], "-o", files["h5"], *options)
        return done, files

    def check_doors(self, done, files, outcome, code):
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        document = json.loads(files["json"].read_text(encoding="utf-8"))
        self.assertEqual(document["outcome"], outcome)
        suite = xml.etree.ElementTree.parse(files["xml"]).getroot().find("testsuite")
        failures = suite.findall(".//failure")
        self.assertEqual(int(suite.get("failures")), len(failures))
        self.assertEqual(int(suite.get("tests")), len(suite.findall("testcase")))
        self.assertEqual(bool(failures), outcome != "pass")
        self.assertTrue(files["md"].read_text(encoding="utf-8").startswith(f"## beamwork: {outcome}\n"))
        end = max(done.stdout.rfind(f"\n{word}: ") for word in ("PASS", "FAIL"))
        paragraph = " ".join(done.stdout[end:].split())
        if outcome == "nothing was judged":
            self.assertIn("nothing was judged", done.stderr)
        else:
            self.assertTrue(paragraph.startswith(outcome.upper() + ":"), done.stdout)
        with h5py.File(files["h5"]) as file:
            self.assertEqual(file.attrs["outcome"].decode(), outcome)
            sentence = file.attrs["sentence"].decode().strip("\0")
        if outcome != "nothing was judged":
            self.assertEqual(" ".join(sentence.split()), paragraph)
        return document, failures

    def test_all_doors(self):
        for name, (_, _, outcome) in FAULTS.items():
            with self.subTest(fault=name):
                done, files = self.verified(name)
                document, _ = self.check_doors(done, files, outcome, OUTCOMES[outcome])
                broken = name in ("energy", "stub")
                self.assertEqual([b["formulation"] for b in document["broken_contracts"]], [NAME] * broken)
                self.assertEqual(done.stdout.startswith("BROKEN CONTRACT of timoshenko: "), broken)
                self.assertEqual("element-test" in done.stdout, broken)

    def test_loaded_without_a_name(self):
        done, files = self.verified("stiffness", named=())
        self.check_doors(done, files, "fail", 1)

    def test_nothing_judged(self):
        """It cannot run there, or is another model, or no truth is known."""
        done, files = self.verified("right", what=NOWHERE)
        document, failures = self.check_doors(done, files, "nothing was judged", 3)
        self.assertEqual(document["judged"], 0)
        self.assertIn("judged nothing", failures[0].get("message"))

    def test_exit_zero(self):
        """Explores: everything is said as ever, but for the status."""
        for name, what in (("stiffness", RUN), ("stub", RUN), ("right", NOWHERE)):
            done, files = self.verified(name, "--exit-zero", what=what)
            first = done.stdout.splitlines()[0]
            self.assertEqual(first, "exploring: the exit status is 0 whatever the verdicts are (--exit-zero)")
            outcome = "nothing was judged" if what == NOWHERE else "fail"
            self.check_doors(done, files, outcome, 0)
        self.refused(2, "--no_such_option", "verify", "--exit-zero", "--no_such_option", silent=False)

    def test_proposals(self):
        """What gates is proposed as findings all the same."""
        needed = self.folder / "needed.csv"
        self.verified("stiffness", "--propose", needed)
        self.assertGreater(len(needed.read_text(encoding="utf-8").splitlines()), 1)

    def test_report(self):
        for name, outcome in (("right", "pass"), ("stiffness", "fail")):
            done, files = self.verified(name)
            self.assertEqual(done.returncode, OUTCOMES[outcome])
            site = self.folder / name
            self.assertEqual(report(files["h5"], site).returncode, 0)
            page = (site / "index.html").read_text(encoding="utf-8")
            self.assertRegex(page, r"Outcome\.</strong> <span" + (">PASS:" if outcome == "pass" else r' class="wrong">FAIL:'))

    @unittest.skipIf(sanitized(), "needs a library without sanitizers")
    def test_python(self):
        for name, what, said in (("right", RUN[1], "True pass"), ("stiffness", RUN[1], "False fail"),
                                 ("stub", RUN[1], "False fail"), ("right", NOWHERE[1], "False nothing was judged")):
            done = subprocess.run([sys.executable, "-c", PYTHON, self.element[name], what], text=True, check=True,
                                  stdout=subprocess.PIPE, env=environment(**SETTINGS))
            self.assertEqual(done.stdout.strip(), said, name)


if __name__ == "__main__":
    unittest.main()
