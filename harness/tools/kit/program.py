"""Functions for calls of the program and for files, shared by all Python tests. reference/test does not use it,
because programs that derive reference values share nothing with the program under test. """
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.abspath(os.environ.get("BEAMWORK", "build/beamwork"))
TRUTHS = os.path.abspath(os.environ.get("BEAMWORK_TRUTHS", "build/truths.h5"))
if "BEAMWORK_TRUTHS" in os.environ:  # absolute path, because some programs run in another folder
    os.environ["BEAMWORK_TRUTHS"] = TRUTHS
ROOT = pathlib.Path(__file__).resolve().parents[3]

# Background jobs of a shell ignore SIGINT, and the program does not change ignored signals.
signal.signal(signal.SIGINT, signal.default_int_handler)


def run(*arguments, program=PROGRAM, **options):
    """Returns the finished process with its output as text. options: those of subprocess.run."""
    return subprocess.run([program, *map(str, arguments)], text=True, check=False,
                          **{"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **options})


def environment(**changes):
    return {**os.environ, **changes}


def report(results, folder, *options):
    return run("-B", "-m", "reports", results, TRUTHS, *options, "-o", folder,
               program=sys.executable, cwd=ROOT)


def drawn(folder, *selection, options=()):
    """Runs verify for a selection, writes its report with these options, and returns the folder of the report."""
    results, site = folder / "results.h5", folder / "site"
    run("verify", *selection, "-o", results)
    done = report(results, site, *options)
    assert done.returncode == 0, done.stderr
    return site


def broken(record):
    """Returns the descriptions of violated requirements, from the output of `element-test --format json`."""
    return [c["sentence"] for c in record["claims"] if c["outcome"] == "broken"]


def read_json(path):
    return json.loads(pathlib.Path(path).read_text(encoding="utf-8"))


def values(record):
    """Returns {quantity: value as written}, so that values can be compared bit for bit."""
    return {q["quantity"]: q["value"] for q in record["quantities"]}


class ProgramTest(unittest.TestCase):
    """A test with a temporary folder, which is empty before the test and is removed after the test."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    @classmethod
    def class_folder(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        return pathlib.Path(folder.name)

    def answered(self, *arguments, code=0, **options):
        done = run(*arguments, **options)
        self.assertEqual(done.returncode, code, f"{arguments}\n{(done.stdout or '')[-4000:]}\n{done.stderr}")
        return done

    def record(self, *arguments, **options):
        return json.loads(self.answered(*arguments, "--format", "json", **options).stdout)

    def values_of(self, scene, *options):
        path = self.folder / "scene.yaml"
        path.write_text(scene, encoding="utf-8")
        return values(self.record("solve", "--scene", path, *options))

    def refused(self, code, words, *arguments, silent=True, **options):
        """Checks that a command fails with the given status, without computing anything, and with a one-line error that
        contains all the words."""
        done = run(*arguments, **options)
        self.assertEqual(done.returncode, code, (arguments, done))
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        for word in [words] if isinstance(words, str) else words:
            self.assertIn(word, done.stderr)
        if silent:
            self.assertEqual(done.stdout, "", (arguments, "something was computed"))
