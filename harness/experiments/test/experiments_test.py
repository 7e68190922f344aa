"""One results file for all experiments: several experiments at a time, old files, damaged files."""
import fcntl
import shutil
import subprocess
import unittest

import h5py

from harness.records.test.stored import altered
from harness.tools.kit.program import PROGRAM, ProgramTest, report, run

VERIFY = ("verify", "-k", "elastica/default and (beamw or collocation)")
ASKED = {
    "stress": ("stress", "-k", "thin and sheet_third"),
    "motion": ("motion", "pendulum", "-f", "collocation", "-n", "1", "--set", "time=0.1",
               "--integrator", "alpha", "--step", "0.01,0.005"),
    "element-test": ("element-test", "sheet_third"),
    "bench": ("bench", "elastica", "-f", "collocation", "-n", "1,2"),
    "converge": ("converge", "elastica", "-f", "collocation", "-n", "1,2"),
    "sweep": ("sweep", "warping_torsion", "--vary", "kL=1,2", "-f", "beamw", "-n", "2"),
}  # yapf: disable
SAME = "0 worse, 0 better, 0 changed, 0 gone, 0 new"
SAYS = ("schema", "schema_version", "program_version", "commit", "clock")


def content(group):
    found = {"": sorted((name, str(value)) for name, value in group.attrs.items())}

    def take(name, one):
        if isinstance(one, h5py.Dataset):
            found[name] = one[()].tobytes(), str(one.dtype)

    group.visititems(take)
    return found


def contents(path):
    """Returns {group: contents}. The key `verify` has the contents outside the groups."""
    with h5py.File(path) as file:
        groups = {name: content(group) for name, group in file["experiments"].items()}
        own = {name: value for name, value in content(file).items()
               if not name.startswith("experiments/")}
        return {**groups, "verify": own}


class Experiments(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.stored = cls.class_folder() / "results.h5"
        jobs = [subprocess.Popen([PROGRAM, *words, "-o", cls.stored], stdout=subprocess.DEVNULL,
                                 stderr=subprocess.PIPE, text=True)
                for words in (VERIFY, *ASKED.values())]
        cls.ended = [(job.wait(), job.stderr.read()) for job in jobs]
        for job in jobs:
            job.stderr.close()

    def setUp(self):
        super().setUp()
        self.path = self.folder / "results.h5"
        shutil.copy(self.stored, self.path)

    def test_all_at_once(self):
        self.assertEqual(self.ended, [(0, "")] * (1 + len(ASKED)))
        with h5py.File(self.stored) as file:
            self.assertEqual(set(file["experiments"]), set(ASKED))
            for group in (file, *file["experiments"].values()):
                self.assertLessEqual(set(SAYS), set(group.attrs), group.name)
        self.assertEqual(sorted(p.name for p in self.stored.parent.iterdir()),
                         ["results.h5", "results.worst"])

    def test_replaced_whole(self):
        before = contents(self.path)
        self.answered("element-test", "beamw", "-o", self.path)
        self.answered("motion", "pendulum", "-f", "beamw", "-n", "1", "--set", "time=0.1",
                      "--integrator", "alpha", "--step", "0.01", "-o", self.path)
        after = contents(self.path)
        self.assertEqual({n for n in before if before[n] != after[n]}, {"element-test", "motion"})
        with h5py.File(self.path) as file:
            self.assertEqual(set(file["experiments/element-test/claims"]["formulation"]), {b"beamw"})
            self.assertEqual(len(file["experiments/motion/runs"]), 1)
        self.answered("verify", "-k", "elbow/default and beamw", "-o", self.path)
        last = contents(self.path)
        self.assertEqual({n for n in after if after[n] != last[n]}, {"verify"})
        with h5py.File(self.path) as file:
            self.assertEqual(list(file["cases"]), ["elbow"])

    def test_an_old_file(self):
        def old(file):
            del file["experiments"]
            file.attrs.modify("schema_version", 2)

        path = altered(self.path, self.folder / "old.h5", old)
        self.assertIn(SAME, self.answered("compare", path, self.path).stdout)
        done = report(path, self.folder / "site")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertFalse((self.folder / "site" / "stability.html").exists())
        self.answered(*ASKED["stress"], "-o", path)
        self.assertIn(SAME, self.answered("compare", path, self.path).stdout)
        done = report(path, self.folder / "site")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((self.folder / "site" / "stability.html").exists())

    def test_times_alone(self):
        path = self.folder / "times.h5"
        self.answered(*ASKED["bench"], "-o", path)
        self.assertIn(SAME, self.answered("compare", path, path).stdout)

    def test_report(self):
        def other(file):
            file["experiments/stress"].attrs["commit"] = b"another one"

        path = altered(self.path, self.folder / "other.h5", other)
        done = report(path, self.folder / "site")
        self.assertEqual(done.returncode, 0, done.stderr)
        page = (self.folder / "site" / "environment.html").read_text(encoding="utf-8")
        for name in (*ASKED, "verify"):
            self.assertIn(f"<tr><td>{name}</td>", page)
        self.assertEqual(page.count('<td class="unexpected">another one</td>'), 1)
        self.assertIn("measured by <code>make bench</code>", page)

    def test_what_would_be_lost(self):
        damaged, other = self.folder / "damaged.h5", self.folder / "other.h5"
        damaged.write_bytes(self.path.read_bytes()[:-100])
        with h5py.File(other, "w") as file:
            file["x"] = 1
        for path in (damaged, other):
            before = path.read_bytes()
            for words in (VERIFY, *ASKED.values()):
                self.refused(2, "would be overwritten, but it is damaged or is not a results file", *words, "-o", path)
            self.assertEqual(path.read_bytes(), before)

    def test_a_sweep_alone(self):
        def old(file):
            group = file["experiments/sweep"]
            for name in group:
                file.copy(group[name], name)
            for name in set(file.attrs) - {"beamwork_sweep"}:
                del file.attrs[name]
            for name in set(group.attrs) - {"schema", "schema_version", "program_version", "commit"}:
                file.attrs[name] = group.attrs[name]
            file.attrs["program"] = "beamwork 0 (before)"
            del file["experiments"]

        new, path = self.folder / "new.h5", self.folder / "old.h5"
        self.answered(*ASKED["sweep"], "-o", new)
        altered(new, path, old)
        self.assertIn(SAME, self.answered("compare", path, new).stdout)
        self.assertIn(SAME, self.answered("compare", path, self.path, "--experiment", "sweep").stdout)
        self.refused(2, "--experiment sweep", "compare", path, self.path)
        done = report(path, self.folder / "site")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.answered(*ASKED["stress"], "-o", path)
        self.assertIn(SAME, self.answered("compare", path, new, "--experiment", "sweep").stdout)
        self.answered(*ASKED["sweep"], "-o", path)
        self.assertEqual(set(contents(path)), {"verify", "stress", "sweep"})

    def test_held(self):
        with open(f"{self.path}.lock", "w", encoding="ascii") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.refused(2, "is in use by another beamwork run", *ASKED["sweep"], "-o", self.path)
        with open(self.path, "rb") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            self.refused(2, "is being written by another program", *VERIFY, "-o", self.path)
        (self.folder / "results.h5.lock").unlink(missing_ok=True)
        (self.folder / "results.h5.lock").mkdir()
        self.refused(4, "results.h5.lock cannot be opened", *ASKED["stress"], "-o", self.path)

    def test_text_still(self):
        path = self.folder / "stress.csv"
        self.answered(*ASKED["stress"], "--format", "csv", "-o", path)
        self.assertEqual(path.read_text(encoding="utf-8"),
                         run(*ASKED["stress"], "--format", "csv").stdout)


if __name__ == "__main__":
    unittest.main()
