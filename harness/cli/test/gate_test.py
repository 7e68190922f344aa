"""Verdicts on requested formulations must affect the exit status."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

import h5py

from harness.cli.test.plugin import compile_shared
from harness.library.python.test.module import SETTINGS, sanitized
from harness.tools.kit.program import ROOT, ProgramTest, environment, report, run

EXAMPLE = ROOT / "elements" / "examples" / "timoshenko.c"
NAME = "timoshenko"
RUN = ("-k", "elastica/default or tapered_cantilever/default")
NOWHERE = ("-k", "hexapod/default")
MASS = (("static int strains(const double options[])", """
static status inertia(const element_data *d, const node_state x[], const element_rotating_frame *frame,
                      inertia_output *out)
{
    (void)x;
    if (frame != NULL || out->M == NULL)
        return STATUS_REFUSED;
    memset(out->M, 0, 14 * 14 * sizeof(double));
    for (int i = 0; i < 3; i++)
        out->M[15 * i] = out->M[15 * (7 + i)] = 1.1 * d->mass / 2;
    return STATUS_OK;
}

static int strains(const double options[])"""), (".stress = stress,", ".stress = stress, .inertia = inertia,"),
        ("    double length;\n", "    double length, mass;\n"),
        ("    out->length = l;\n", "    out->length = l;\n    out->mass = c->density * c->A * l;\n"))
FAULTS = {
    "right": ("", "", "pass"),
    "stiffness": ("1 / Fy,", "1.1 / Fy,", "fail"),
    "coupling": ("c->young * c->Iy / l3", "1.1 * c->young * c->Iy / l3", "fail"),
    "torsion": ("c->shear_modulus * c->It / l3", "0.9 * c->shear_modulus * c->It / l3", "fail"),
    "energy": ("out->sigma[i] = d->stiffness[i] * e[i];", "out->sigma[i] = 1.1 * d->stiffness[i] * e[i];", "fail"),
    "stub": ("energy += d->stiffness[i] * e[i] * e[i] / 2;", "energy += 0;", "fail"),
    "coarse": ("cos(sqrt(square) / 2)", "cos(sqrt(square) / 2.1)", "pass"),
}
OWN_LOADS = (("static int strains(const double options[])", """
static void along(int count, const element_data *const data[], const node_state x[], along_output out[],
                  status outcome[])
{
    static const double weight[] = {0.10122853629037626, 0.22238103445337447, 0.31370664587788729,
                                    0.36268378337836198}, unturned[] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    for (int k = 0; k < count; k++) {
        along_output *o = &out[k];
        const double *q = o->rate != NULL ? o->rate : o->force, rest[STRAINS] = {0};
        const int moves = o->rate == NULL && o->e != NULL;
        double whole[3] = {0}, own[3] = {0};
        for (int i = 0; i < 3 * ELEMENT_ALONG_POINTS; i++)
            whole[i % 3] += data[k]->length * weight[i < 12 ? i / 3 : 7 - i / 3] / 2 * q[i];
        outcome[k] = stress(data[k], moves ? o->e : rest, NULL, &(stress_output){.sigma = o->sigma, .C = o->C});
        if (o->C != NULL && !moves)
            memset(o->C, 0, STRAINS * STRAINS * sizeof *o->C);
        transposed(moves ? unturned : x[2 * k].R, whole, own);
        o->sigma[4] -= own[2] / 12;
        o->sigma[5] += own[1] / 12;
        if (o->mixed != NULL)
            memset(o->mixed, 0, 3 * STRAINS * sizeof *o->mixed);
        if (o->H != NULL)
            memset(o->H, 0, ELEMENT_ALONG_COORDINATES * ELEMENT_ALONG_COORDINATES * sizeof *o->H);
        memset(o->turn, 0, sizeof o->turn);
        memset(o->ends, 0, sizeof o->ends);
        memset(o->moment, 0, sizeof o->moment);
        memset(o->second, 0, sizeof o->second);
        for (int i = 0; i < 3; i++)
            o->ends[i] = o->ends[7 + i] = whole[i] / 2;
    }
}

static int strains(const double options[])"""), (".stress = stress,", ".stress = stress, .along = along,"))
PLANTS = {
    "right": ((), "pass", 0),
    "stiffness": ((("c->young * c->Iz / l3", "1.1 * c->young * c->Iz / l3"),), "fail", 2),
    "mass": (MASS, "fail", 1),
    "load": ((("= whole[i] / 2", "= (i == 1 ? -1 : 1) * whole[i] / 2"),), "fail", 1),
    "moment": ((("o->sigma[5] += own", "o->sigma[5] -= own"),), "fail", 0),
    "stub": ((("    (void)inner;\n", "    (void)inner;\n    return STATUS_OK;\n"),), "fail", 2),
    "refuses": ((("    (void)f;\n", "    strcpy(f->text, \"not yet\");\n    return STATUS_REFUSED;\n"),), "fail", 2),
}
# With a force, a moment and a load along the beam, the deflection is F l^3/(3EI) + M l^2/(2EI) + q l^4/(8EI), with EI =
# 1 and l = 1. The frequency is 1.8751^2/(2pi) sqrt(EI/(rho A l^4)).
LOADED = """beamwork: 1
sections: {s: {rectangle: {width: 1, thickness: 0.01}, young: 12e6, shear_modulus: 5e6, density: 100}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}
loads: {force: {force: [0, 3, 0], on: b}, moment: {moment: [0, 0, 2], on: b}, along: {distributed: [0, 8, 0], on: m}}
analyses: {linear: {linear: {}}, free: {modal: {wanted: 1}}}
quantities:
  uy: {displacement: {analysis: linear, node: b, component: uy}}
  f1: {frequency: {analysis: free, which: 0}, unit: Hz}
truths:
  - {quantity: uy, value: 3, kind: exact, source: beam without shear}
  - {quantity: f1, value: 0.5595912100, kind: exact, source: beam without shear, uncertainty: 1e-8}
omit: all
meshes: [1, 2, 4, 8, 16, 32]
"""
OUTCOMES = {"pass": 0, "fail": 1, "nothing was judged": 3}
PYTHON = """
import beamwork as bw, json, sys
bw.load(sys.argv[1])
options = json.loads(sys.argv[2])
of = bw.Scene.open(options.pop("scene")) if "scene" in options else bw
found = of.verify("timoshenko", **options)
print(found.passed, found.outcome)
"""


def changed(text, *changes):
    """Replaces each text, which must occur once. Empty texts are ignored."""
    for before, after in changes:
        assert not before or text.count(before) == 1, before
        text = text.replace(before, after) if before else text
    return text


def compiled(source, text):
    source.write_text(text, encoding="utf-8")
    return compile_shared(source, source.with_suffix(".so"))


class Gate(ProgramTest):

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        text = EXAMPLE.read_text(encoding="utf-8")
        cls.element = {name: compiled(folder / f"{name}.c", changed(text, change))
                       for name, (*change, _) in FAULTS.items()}
        text = changed(text, *OWN_LOADS)
        cls.loaded = {name: compiled(folder / f"own {name}.c", changed(text, *changes))
                      for name, (changes, *_) in PLANTS.items()}

    def verified(self, element, *options, what=RUN, named=("-f", NAME)):
        files = {kind: self.folder / f"out.{kind}" for kind in ("json", "xml", "md", "h5")}
        loaded = ("--element", self.element.get(element, element))
        done = run("verify", *loaded, *named, *what, "--json", files["json"],
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
            self.assertIn("no verdict, because there is no reference value", done.stderr)
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
                self.assertEqual(done.stdout.startswith("INTERFACE VIOLATED by timoshenko: "), broken)
                self.assertEqual("element-test" in done.stdout, broken)

    def test_seven_doors(self):
        scene = self.folder / "loaded.yaml"
        scene.write_text(LOADED, encoding="utf-8")
        for name, (_, outcome, wrong) in PLANTS.items():
            done, files = self.verified(self.loaded[name], what=("--scene", scene))
            with self.subTest(fault=name, door="status, JUnit, Markdown, JSON, last line"):
                document, _ = self.check_doors(done, files, outcome, OUTCOMES[outcome])
                self.assertEqual(document["unexpected"], wrong, done.stdout)
            with self.subTest(fault=name, door="report"):
                self.check_report(files, outcome)
            with self.subTest(fault=name, door="Python"):
                self.check_python(self.loaded[name], None, f"{outcome == 'pass'} {outcome}", scene=str(scene))

    def test_not_worse_than(self):
        _, files = self.verified("right")
        old, table = self.folder / "old.h5", self.folder / "old.csv"
        files["h5"].rename(old)
        self.answered("compare", old, "-o", table)
        for former in (old, table):
            for name, outcome in (("right", "pass"), ("coarse", "fail")):
                done, files = self.verified(name, "--not-worse-than", former)
                document, failures = self.check_doors(done, files, outcome, OUTCOMES[outcome])
                self.assertEqual(document["unexpected"], 0)
                self.assertEqual(len(document["regressions"]), len(failures))
                self.assertEqual("worse than in the previous run" in files["md"].read_text(encoding="utf-8"),
                                 outcome == "fail")
                if former == old and outcome == "fail":
                    self.check_report(files, outcome)
                self.check_python(name, RUN[1], f"{outcome == 'pass'} {outcome}", not_worse_than=str(former))
        other = self.folder / "other.h5"
        self.answered("bench", "elastica", "-f", "beamw", "-n", "2", "-o", other)
        for words in (("--not-worse-than", "not of verify; give a file written by 'beamwork verify"),
                      ("--imported", "not imported results; give a file written by 'beamwork import")):
            self.refused(4 if words[0] == "--not-worse-than" else 2, "contains results of bench, " + words[1],
                         "verify", *RUN, words[0], other)
        old.write_bytes(old.read_bytes()[:2000])
        self.refused(4, "old.h5", "verify", *RUN, "--not-worse-than", old)
        self.refused(2, "no results of this run", "verify", "-k", "roll_up/default", "-f", "beamw",
                     "--not-worse-than", table)

    def test_tolerance(self):
        for name, tolerance, outcome in (("stiffness", "50%", "pass"), ("stiffness", "0.1%", "fail"), ("right", "1e-12", "fail")):
            done, files = self.verified(name, "--tolerance", tolerance)
            self.check_doors(done, files, outcome, OUTCOMES[outcome])
            self.check_python(name, RUN[1], f"{outcome == 'pass'} {outcome}",
                              tolerance=float(tolerance.rstrip("%")) / (100 if "%" in tolerance else 1))
        self.assertIn("undecided", done.stdout[done.stdout.rfind("FAIL:"):])
        self.refused(2, "--tolerance '2'", "verify", *RUN, "--tolerance", "2")
        self.assertIn("'undecided' counts as different", " ".join(run("verify", "--help").stdout.split()))

    def test_loaded_without_a_name(self):
        done, files = self.verified("stiffness", named=())
        self.check_doors(done, files, "fail", 1)

    def test_nothing_judged(self):
        done, files = self.verified("right", what=NOWHERE)
        document, failures = self.check_doors(done, files, "nothing was judged", 3)
        self.assertEqual(document["judged"], 0)
        self.assertIn("1 run assigned no verdict", failures[0].get("message"))

    def test_exit_zero(self):
        for name, what in (("stiffness", RUN), ("stub", RUN), ("right", NOWHERE)):
            done, files = self.verified(name, "--exit-zero", what=what)
            first = done.stdout.splitlines()[0]
            self.assertEqual(first, "exploration: the exit status is 0 whatever the verdicts (--exit-zero)")
            outcome = "nothing was judged" if what == NOWHERE else "fail"
            self.check_doors(done, files, outcome, 0)
        self.refused(2, "--no_such_option", "verify", "--exit-zero", "--no_such_option", silent=False)

    def test_proposals(self):
        needed = self.folder / "needed.csv"
        self.verified("stiffness", "--propose-deviations", needed)
        self.assertGreater(len(needed.read_text(encoding="utf-8").splitlines()), 1)

    def check_report(self, files, outcome):
        with tempfile.TemporaryDirectory() as site:
            self.assertEqual(report(files["h5"], site).returncode, 0)
            page = (pathlib.Path(site) / "index.html").read_text(encoding="utf-8")
            free = [each.name for each in pathlib.Path(site).rglob("*.html") if
                    each.name != "glossary.html" and "without effect on the exit status" in each.read_text(encoding="utf-8")]
        self.assertEqual(free, [])
        self.assertRegex(page, r"Outcome\.</strong> <span" + (">PASS:" if outcome == "pass" else r' class="wrong">FAIL:'))

    def check_python(self, name, what, said, **options):
        if sanitized():
            return
        done = subprocess.run([sys.executable, "-c", PYTHON, self.element.get(name, name),
                               json.dumps({"select": what, **options})], text=True,
                              check=True, stdout=subprocess.PIPE, env=environment(**SETTINGS))
        self.assertEqual(done.stdout.strip(), said, name)

    @unittest.skipIf(sanitized(), "needs a library without sanitizers")
    def test_python(self):
        for name, what, said in (("right", RUN[1], "True pass"), ("stiffness", RUN[1], "False fail"),
                                 ("stub", RUN[1], "False fail"), ("right", NOWHERE[1], "False nothing was judged")):
            self.check_python(name, what, said)


if __name__ == "__main__":
    unittest.main()
