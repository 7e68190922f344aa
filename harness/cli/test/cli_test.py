"""The program as a user meets it: answers, refusals with one line and the documented exit code, no partial file."""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from reference.pack import seal

PROGRAM = os.environ.get("BEAMWORK", "build/beamwork")
TRUTHS = os.environ.get("BEAMWORK_TRUTHS", "build/truths.h5")


def run(*arguments, **environment):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, env={**os.environ, **environment}, check=False)


class Refusals(unittest.TestCase):
    def refused(self, code, word, *arguments, **environment):
        done = run(*arguments, **environment)
        self.assertEqual(done.returncode, code, done)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        self.assertIn(word, done.stderr)

    def test_names(self):
        self.refused(2, "did you mean 'c_column'", "solve", "c_colum", "-f", "beamw", "-n", "2")
        self.refused(2, "did you mean 'beamw'", "solve", "c_column", "-f", "beamv", "-n", "2")
        self.refused(2, "did you mean 'length'", "solve", "c_column", "-f", "beamw", "-n", "2", "--set", "lenght=2")
        self.refused(2, "did you mean 'verify'", "verifi")

    def test_values(self):
        for bad in ("length=-1", "length=nan", "length=inf", "young=0", "flange_thickness=0"):
            self.refused(2, bad.partition("=")[0], "solve", "c_column", "-f", "beamw", "-n", "2", "--set", bad)
        self.refused(2, "positive definite", "solve", "c_column", "-f", "beamw", "-n", "2", "--set", "section_data=misprinted")
        self.refused(2, "poisson", "solve", "sheet_cantilever", "-f", "beamw", "-n", "2", "--set", "poisson=0.5")
        self.refused(2, "tip_deflection", "solve", "sheet_cantilever", "-f", "beamw", "-n", "2", "--set", "tip_deflection=0.2")
        self.refused(2, "elements", "solve", "c_column", "-f", "beamw", "-n", "0")
        self.refused(2, "memory", "solve", "c_column", "-f", "beamw", "-n", "10000000")
        self.refused(2, "does not offer", "solve", "c_column", "-f", "beamw_vlasov", "-n", "2")

    def test_truth_files(self):
        folder = tempfile.mkdtemp()
        try:
            foreign, cut = os.path.join(folder, "foreign.h5"), os.path.join(folder, "cut.h5")
            pathlib.Path(foreign).write_bytes(b"hello")
            pathlib.Path(cut).write_bytes(pathlib.Path(TRUTHS).read_bytes()[:3000])
            for path in (foreign, cut, os.path.join(folder, "missing.h5")):
                self.refused(4, path, "verify", "--truths", path)
        finally:
            shutil.rmtree(folder)

    def test_unwritable_output(self):
        folder = tempfile.mkdtemp()
        try:
            self.refused(4, "cannot be written", "verify", "-k", "warping_torsion", "-o", "/nowhere/results.h5")
            self.refused(4, "cannot be written", "solve", "warping_torsion", "-f", "beamw", "-n", "2", "-o", folder)
            self.assertEqual(os.listdir(folder), [])
        finally:
            shutil.rmtree(folder)

    def test_full_disk(self):
        if os.path.exists("/dev/full"):
            with open("/dev/full", "w", encoding="ascii") as full:
                done = subprocess.run([PROGRAM, "solve", "warping_torsion", "-f", "beamw", "-n", "2"], stdout=full, stderr=subprocess.PIPE, text=True, check=False)
            self.assertEqual(done.returncode, 4, done.stderr)

    def test_nothing_checked(self):
        self.refused(3, "nothing was checked", "verify", "-k", "no_such_case")


class Answers(unittest.TestCase):
    def test_json(self):
        done = run("solve", "c_column", "-f", "beamw", "-n", "2", "--set", "section_data=printed", "--format", "json")
        self.assertEqual(done.returncode, 0, done.stderr)
        result = json.loads(done.stdout)
        self.assertEqual(result["schema_version"], 2)
        self.assertEqual(result["parameters"]["section_data"], "printed")
        load = result["quantities"][0]
        self.assertAlmostEqual(load["value"] / 12858745.038, 1, delta=1e-9)
        self.assertTrue(any(t["truth_kind"] == "exact" for t in load["truths"]))

    def test_gate(self):
        """A rule that is taken out of the ledger turns the gate red."""
        import h5py
        folder = tempfile.mkdtemp()
        try:
            path = os.path.join(folder, "t.h5")
            shutil.copy(TRUTHS, path)
            selection = ("verify", "-k", "c_column and section_data=printed and beamw", "--truths", path)
            self.assertEqual(run(*selection).returncode, 0)
            with h5py.File(path, "r+") as file:
                file["findings/quantities"][...] = b"gone"
            seal(path)
            done = run(*selection)
            self.assertEqual(done.returncode, 1)
            self.assertIn("-2.7801%  wrong limit", done.stdout)
        finally:
            shutil.rmtree(folder)

    def test_jobs_agree(self):
        one = run("verify", "-k", "warping_torsion", "-j", "1")
        two = run("verify", "-k", "warping_torsion", "-j", "2")
        self.assertEqual(one.stdout, two.stdout)

    def test_truth(self):
        """Stored at known points, derived at new ones, refused where no program can."""
        stored, derived = run("truth", "elastica", "--set", "load=2"), run("truth", "elastica", "--set", "load=2.5")
        self.assertEqual((stored.returncode, derived.returncode), (0, 0), derived.stderr)
        for done in (stored, derived):
            self.assertRegex(done.stdout, r"w_over_L +0\.[45]\d+ \+- \S+ +1 +exact +same +reference/derive/cantilevers.py")
        self.assertEqual(run("truth", "elastica", "--set", "load=zwei").returncode, 2)
        self.assertEqual(run("truth", "no_such_case").returncode, 2)
        away = run("truth", "elastica", "--set", "load=2.5", BEAMWORK_REFERENCE="/nowhere")
        self.assertEqual(away.returncode, 4)
        self.assertEqual(len(away.stderr.strip().splitlines()), 1)

    def test_help(self):
        for verb in ("solve", "verify", "converge", "list"):
            done = run(verb, "--help", ASAN_OPTIONS="detect_leaks=0")  # the C library's argp leaves a byte when it exits
            self.assertEqual(done.returncode, 0)
            self.assertIn("Usage", done.stdout)
        self.assertIn("HDF5", run("--version").stdout)


if __name__ == "__main__":
    unittest.main()
