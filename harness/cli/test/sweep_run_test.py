"""sweep: runs that are interrupted, shared among several or given again, and refusals."""
import fcntl
import os
import signal
import subprocess
import time
import unittest

import numpy as np

from harness.records.test.stored import group_of
from harness.tools.kit.program import PROGRAM, ROOT, ProgramTest

LEAF = ROOT / "cases" / "examples" / "leaf_spring_guide.yaml"


class Going(ProgramTest):

    def test_scene(self):
        done = self.answered("sweep", "--scene", LEAF, "--vary", "thickness=0.2e-3..1e-3/2", "-f",
                             "collocation", "-n", "1,2,4", "-k", "k_drive", "-o",
                             self.folder / "leaf.h5")
        self.assertIn("3 points by a stored truth", done.stdout)
        with group_of(self.folder / "leaf.h5") as file:
            self.assertEqual(file.attrs["scene"].decode(), str(LEAF))

    def test_interrupted_goes_on(self):
        """What was done is kept, and the rest gives the same file as a run that was not
        interrupted."""
        words = ["sweep", "snap_through", "--vary", "angle=0.1..0.6/1199", "-f", "beamw", "-n",
                 "1,2", "-k", "limit_load", "-j", "1", "-o"]
        path, whole = self.folder / "s.h5", self.folder / "whole.h5"
        with subprocess.Popen([PROGRAM, *words, str(path)], stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True) as process:
            while process.poll() is None and not list(self.folder.glob("s.batches/*.batch")):
                time.sleep(0.01)
            process.send_signal(signal.SIGINT)
            told = process.communicate()[1]
        self.assertEqual(process.returncode, 5, told)
        self.assertIn("give the same command again", told)
        self.assertFalse(path.exists())
        kept = list(self.folder.glob("s.batches/*.batch"))
        self.assertGreater(len(kept), 0)
        self.answered(*words, path)
        self.answered(*words, whole)
        with group_of(path) as one, group_of(whole) as other:
            self.assertEqual(one.attrs["content"], other.attrs["content"])
            for name in ("value", "error", "least", "status", "cost", "reference"):
                np.testing.assert_array_equal(one[name][()], other[name][()])
        self.assertFalse((self.folder / "s.batches").exists())

    def test_shards(self):
        """Computed by several that never meet, and put together: the same; some missing: told."""
        words = ("sweep", "snap_through", "--vary", "angle=0.1..0.6/1199", "-f", "beamw", "-n",
                 "1,2", "-k", "limit_load")
        into = [self.folder / name for name in ("a", "b")]
        for i, folder in enumerate(into):
            self.answered(*words, "--shard", f"{i + 1}/2", "--into", folder)
        done = self.answered("merge", into[0], "-o", self.folder / "m.h5", code=5)
        self.assertIn("incomplete", done.stderr)
        self.assertEqual({p.name for p in self.folder.iterdir()}, {"a", "b"})
        done = self.answered("merge", into[0], "-o", self.folder / "m.h5", "--partial", code=5)
        self.assertRegex(done.stdout, r"\d+ of 1200 points are there")
        self.answered("merge", *into, "-o", self.folder / "m.h5")
        self.answered(*words, "-o", self.folder / "whole.h5")
        with group_of(self.folder / "m.h5") as one, group_of(
                self.folder / "whole.h5") as whole, group_of(
                    self.folder / "m.partial.h5") as part:
            for name in ("plan", "content"):
                self.assertEqual(one.attrs[name], whole.attrs[name])
            state = part["status"].attrs["names"].decode().split("\n").index("not_computed")
            missing = part["status"][()] == state
            self.assertTrue(missing.any() and not missing.all())
            self.assertTrue(np.isnan(part["value"][()][missing]).all())
            np.testing.assert_array_equal(part["value"][()][~missing],
                                          whole["value"][()][~missing])

    def test_other_files_among_batches_stay(self):
        (self.folder / "e.batches").mkdir()
        (self.folder / "e.batches" / "mine.txt").write_text("mine", encoding="utf-8")
        self.answered("sweep", "elastica", "--vary", "load=1,2", "-f", "beamw", "-n", "1", "-o",
                      self.folder / "e.h5")
        self.assertEqual((self.folder / "e.batches" / "mine.txt").read_text(), "mine")

    def test_again_replaces(self):
        words = ("sweep", "elastica", "--vary", "load=1,2", "-f", "beamw", "-n", "1,2", "-o",
                 self.folder / "e.h5")
        self.answered(*words)
        first = (self.folder / "e.h5").read_bytes()
        self.answered(*words)
        self.assertEqual(len((self.folder / "e.h5").read_bytes()), len(first))

    def test_folder_of_somebody_is_refused(self):
        (self.folder / "e.worst").mkdir()
        (self.folder / "e.worst" / "mine.txt").write_text("mine", encoding="utf-8")
        done = self.answered("sweep", "elastica", "--vary", "load=1,2", "-f", "beamw", "-n", "1",
                             "-o", self.folder / "e.h5", code=2)
        self.assertIn("e.worst is there already and not empty", done.stderr)
        self.assertEqual([p.name for p in self.folder.iterdir()], ["e.worst"])

    def test_one_run_for_each_output(self):
        """Another run works there: this one ends with a line, and takes nothing away."""
        batches = self.folder / "e.batches"
        batches.mkdir()
        words = ("sweep", "elastica", "--vary", "load=1,2", "-f", "beamw", "-n", "1", "-o", self.folder / "e.h5")
        held = os.open(batches, os.O_RDONLY)
        fcntl.flock(held, fcntl.LOCK_EX)
        self.refused(2, "another 'beamwork sweep' works there", *words, silent=False)
        os.close(held)
        self.answered(*words)
        self.assertFalse(batches.exists())

    def test_refusals(self):
        """Culprit and remedy, before anything runs."""
        for words, says in (
                (("elastica",), "what varies?"),
                (("elastica", "--vary", "lod=1..2/3"), "did you mean 'load'"),
                (("elastica", "--vary", "load=1..2"), "how many parts?"),
                (("elastica", "--vary", "load=1..5000/3"), "outside its range"),
                (("elastica", "--vary", "load=1..2/3", "--set", "load=3"), "set and varies"),
                (("elastica", "--vary", "load=1..2/3", "--vary", "load=3,4"), "given twice"),
                (("elastica", "--vary", "load=1..2/3", "-k", "w_ovr"), "did you mean 'w_over_L'"),
                (("elastica", "--vary", "load=1..2/3", "--design", "sobl"), "give one of grid|"),
                (("elastica", "--vary", "load=1..2/3", "--points", "3"), "--points belongs"),
                (("elastica", "--vary", "load=1..2/3", "--seed", "3"), "--seed belongs"),
                (("elastica", "--vary", "load=1..2", "--design", "halton"), "--points N"),
                (("elastica", "--vary", "load=1..2/3", "--error", "2"), "error"),
                (("elastica", "--vary", "load=1..2/3", "--format", "json"), "text, csv"),
                (("coupled_beam", "--vary", "coupling=0.1,0.2", "-f", "beamw_vlasov"),
                 "does not offer coupled section"),
                (("c_column", "--vary", "height=0.4,0.5", "--set", "section_data=printed"),
                 "no scene can be built")):
            done = self.answered("sweep", *words, code=2)
            self.assertIn(says, done.stderr)
            self.assertEqual(done.stdout, "")
            self.assertEqual(len(done.stderr.splitlines()), 1)


if __name__ == "__main__":
    unittest.main()
