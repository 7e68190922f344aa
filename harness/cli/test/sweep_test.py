"""Sweeps: varied parameters, computed values, and processes."""
import csv
import fcntl
import io
import itertools
import json
import os
import signal
import subprocess
import time
import unittest

import numpy as np

from harness.records.test.stored import group_of
from harness.tools.kit.program import PROGRAM, ProgramTest, ROOT, run


LEAF = ROOT / "cases" / "examples" / "leaf_spring_guide.yaml"
COLUMN = ("shear_column", "--vary", "length=0.5..2/3", "--vary", "side=0.01..0.04/2:log",
          "-f", "beamw", "-f", "collocation", "-n", "8,2,4")


def sealed(path):
    data = path.read_bytes()
    word, size, _ = data[-40:].split()
    return word == b"beamwork-seal" and int(size, 16) == len(data) - 40


def solved(*words, quantity):
    done = run("solve", *words, "--format", "json")
    rows = json.loads(done.stdout)["quantities"]
    return next(r["value"] for r in rows if r["quantity"] == quantity)


class Grid(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.path = cls.class_folder() / "column.h5"
        cls.done = run("sweep", *COLUMN, "-o", cls.path)
        assert cls.done.returncode == 0, cls.done.stderr
        with group_of(cls.path) as file:
            cls.of = {name: file[name][()] for name in file}
            cls.told = dict(file.attrs)
            cls.kinds = file["reference_kind"].attrs["names"].decode().split("\n")
            cls.states = file["status"].attrs["names"].decode().split("\n")

    def test_points_are_the_grid(self):
        lengths, sides = (0.5, 1, 1.5, 2), (0.01, 0.02, 0.04)
        np.testing.assert_allclose(self.of["points"],
                                   list(itertools.product(lengths, sides)), rtol=1e-15)
        self.assertEqual([tuple(r) for r in self.of["axes"][["name", "unit", "kind", "count"]]],
                         [(b"length", b"m", b"linear", 4), (b"side", b"m", b"log", 3)])
        self.assertEqual(list(self.of["meshes"]), [2, 4, 8])

    def test_same_bits_as_solve(self):
        for point, formulation, mesh in ((0, 0, 0), (7, 1, 2), (11, 0, 1)):
            length, side = self.of["points"][point].tolist()
            alone = solved("shear_column", "--set", f"length={length!r}", "--set",
                           f"side={side!r}", "-f", ("beamw", "collocation")[formulation],
                           "-n", self.of["meshes"][mesh], quantity="buckling_load")
            self.assertEqual(self.of["value"][point, formulation, mesh, 0], alone)

    def test_errors_and_least_mesh(self):
        error = self.of["error"][:, 0, :, 0]
        expected = self.of["value"][:, 0, :, 0] / self.of["reference"] - 1
        known = np.isfinite(error)
        self.assertGreater(known.sum(), 0)
        np.testing.assert_allclose(error[known], expected[known], rtol=1e-9, atol=1e-15)
        within = np.abs(error) <= 0.01
        for row, least in zip(within, self.of["least"][:, 0, 0]):
            good = [n for i, n in enumerate((2, 4, 8)) if row[i:].all()]
            self.assertEqual(least, good[0] if good else 0)

    def test_stored_truth_is_taken_where_there_is_one(self):
        kind = [self.kinds[k] for k in self.of["reference_kind"][:, 0]]
        at = self.of["points"].tolist().index([1, 0.02])
        self.assertEqual(kind[at], "truth stored")
        self.assertEqual(kind.count("truth stored"), 1)

    def test_file_says_what_it_is(self):
        self.assertEqual(self.told["beamwork_sweep"], 1)
        self.assertEqual(self.told["case"], b"shear_column")
        self.assertEqual(self.told["tolerance"], 0.01)
        self.assertTrue(sealed(self.path))
        self.assertEqual({self.states[s] for s in self.of["status"].ravel()}, {"ok"})
        self.assertTrue((self.of["cost"] > 0).all() and (self.of["seconds"] > 0).all())

    def test_worst_points_are_scenes_that_solve(self):
        for row in self.of["worst"]:
            which = ("beamw", "collocation").index(row["formulation"].decode())
            path = self.path.with_suffix(".worst") / row["scene"].decode()
            alone = solved("--scene", path, "-f", row["formulation"].decode(), "-n", row["mesh"],
                           quantity=row["quantity"].decode())
            self.assertEqual(self.of["value"][row["point"], which, 2, 0], alone)
        for one in (0, 1):
            worst = np.sort(-np.abs(self.of["error"][:, one, 2, 0]))
            told = self.of["worst"]["error"][self.of["worst"]["formulation"] ==
                                             (b"beamw", b"collocation")[one]]
            np.testing.assert_array_equal(-np.abs(told), worst[:len(told)])

    def test_nothing_else_is_left(self):
        self.assertEqual(sorted(p.name for p in self.path.parent.iterdir()),
                         ["column.h5", "column.worst"])

    def test_any_number_of_processes(self):
        for jobs in (1, 3):
            path = self.folder / f"{jobs}.h5"
            self.answered("sweep", *COLUMN, "-j", jobs, "-o", path)
            with group_of(path) as file:
                self.assertEqual(file.attrs["content"], self.told["content"])
                self.assertEqual(file.attrs["plan"], self.told["plan"])

    def test_csv_is_the_file(self):
        done = self.answered("sweep", *COLUMN, "--format", "csv")
        rows = list(csv.DictReader(io.StringIO(done.stdout)))
        self.assertEqual(len(rows), 12 * 2 * 3)
        self.assertEqual([float(r["value"]) for r in rows], list(self.of["value"].ravel()))
        self.assertEqual([float(r["side"]) for r in rows[::6]], list(self.of["points"][:, 1]))
        self.assertEqual([r["error"] == "" for r in rows],
                         list(np.isnan(self.of["error"].ravel())))
        self.assertEqual({r["status"] for r in rows}, {"ok"})

    def test_screen(self):
        for line in self.done.stdout.splitlines():
            self.assertLessEqual(len(line), 100)
        self.assertIn("shear_column: 12 points (grid), 2 formulations, 3 meshes: 72 runs",
                      self.done.stdout)
        self.assertIn("share of the points with errors within 1 %", self.done.stdout)
        self.assertIn("worst points with n = 8", self.done.stdout)


class References(ProgramTest):

    def kinds(self, *words):
        path = self.folder / "r.h5"
        done = self.answered("sweep", *words, "-o", path)
        with group_of(path) as file:
            names = file["reference_kind"].attrs["names"].decode().split("\n")
            return ([[names[k] for k in row] for row in file["reference_kind"][()]],
                    file["reference"][()], file["error"][()], done.stdout)

    def test_derived_where_asked_for(self):
        kind, reference, error, _ = self.kinds("elastica", "--vary", "load=1,1.25", "-f", "beamw",
                                               "-n", "8,16", "--compute-references", "-k", "w_over_L")
        self.assertEqual(kind, [["truth stored"], ["truth derived"]])
        told = run("truth", "elastica", "--set", "load=1.25").stdout
        self.assertIn(f"{reference[1, 0]:.12g}"[:12], told)
        self.assertTrue((np.abs(error) < 1e-2).all())

    def test_limit_of_one_formulation_is_told_as_such(self):
        kind, *_, screen = self.kinds("elastica", "--vary", "load=1.25,1.5", "-f", "sheet_third",
                                      "-n", "2,4,8,16", "-k", "w_over_L")
        self.assertEqual(kind, [["limit of the meshes of all"]] * 2)
        self.assertIn("the limit of the same meshes", screen)

    def test_limits_that_disagree_are_no_reference(self):
        kind, _, error, screen = self.kinds(
            "--scene", LEAF, "--vary", "thickness=0.8e-3,1e-3", "-f", "sheet_second", "-f",
            "sheet_third", "-n", "8,16,32,64,128", "-k", "k_pushed", "--error", "0.1%")
        flat = [k for row in kind for k in row]
        self.assertEqual(set(flat), {"none: formulations disagree"})
        self.assertIn("limits of the formulations disagree", " ".join(screen.split()))
        self.assertTrue(np.isnan(error).all())

    def test_truths_that_are_not_known_well_enough_are_passed_over(self):
        words = ("tip_body", "--vary", "omega_star=0..3/2", "-f", "beamw", "-n", "1,2", "-k",
                 "flap_1")
        self.assertIn(["truth stored"], self.kinds(*words)[0])
        self.assertEqual(self.kinds(*words, "--error", "1e-13")[0], [["none"]] * 3)

    def test_points_without_a_scene_are_results(self):
        done = self.answered("sweep", "c_column", "--vary", "section_data=shear_flow,printed",
                             "--set", "height=0.5", "-f", "beamw", "-n", "1,2", "-k",
                             "buckling_load", "-o", self.folder / "c.h5")
        self.assertIn("no scene can be built at 1 point; the first is at section_data=printed", done.stdout)
        with group_of(self.folder / "c.h5") as file:
            names = file["status"].attrs["names"].decode().split("\n")
            self.assertEqual([names[s] for s in file["status"][:, 0, 0]], ["ok", "no_scene"])
            self.assertEqual(file["points"].attrs["section_data"].decode(), "shear_flow\nprinted")
            self.assertEqual(file["points"][()].tolist(), [[0], [1]])


class Designs(ProgramTest):

    def points(self, *words):
        path = self.folder / "d.h5"
        self.answered("sweep", "elastica", *words, "-f", "beamw", "-n", "1", "-o", path)
        with group_of(path) as file:
            return file["points"][()], dict(file.attrs), [r["kind"] for r in file["axes"][()]]

    def test_sobol(self):
        at, told, kinds = self.points("--vary", "load=0..4", "--vary", "axial=1e4..1e8:log",
                                      "--design", "sobol", "--points", "3")
        np.testing.assert_allclose(at, [[2, 1e6], [3, 1e5], [1, 1e7]], rtol=1e-14)
        self.assertEqual((told["design"], kinds), (b"sobol", [b"sobol", b"sobol"]))

    def test_random_states_its_seed(self):
        words = ("--vary", "load=0..4", "--design", "random", "--points", "5")
        first, told, _ = self.points(*words, "--seed", "3")
        again, *_ = self.points(*words, "--seed", "3")
        other, *_ = self.points(*words, "--seed", "4")
        self.assertEqual(told["seed"], 3)
        self.assertTrue((first == again).all() and (first != other).all())


SWEEP_RUN_LEAF = ROOT / "cases" / "examples" / "leaf_spring_guide.yaml"


class Going(ProgramTest):

    def test_scene(self):
        done = self.answered("sweep", "--scene", SWEEP_RUN_LEAF, "--vary", "thickness=0.2e-3..1e-3/2", "-f",
                             "collocation", "-n", "1,2,4", "-k", "k_drive", "-o",
                             self.folder / "leaf.h5")
        self.assertIn("3 points: stored reference values", done.stdout)
        with group_of(self.folder / "leaf.h5") as file:
            self.assertEqual(file.attrs["scene"].decode(), str(SWEEP_RUN_LEAF))

    def test_interrupted_goes_on(self):
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
        self.assertIn("run the same command again", told)
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
        words = ("sweep", "snap_through", "--vary", "angle=0.1..0.6/1199", "-f", "beamw", "-n",
                 "1,2", "-k", "limit_load")
        into = [self.folder / name for name in ("a", "b")]
        for i, folder in enumerate(into):
            self.answered(*words, "--shard", f"{i + 1}/2", "--into", folder)
        done = self.answered("merge", into[0], "-o", self.folder / "m.h5", code=5)
        self.assertIn("incomplete", done.stderr)
        self.assertEqual({p.name for p in self.folder.iterdir()}, {"a", "b"})
        done = self.answered("merge", into[0], "-o", self.folder / "m.h5", "--partial", code=5)
        self.assertRegex(done.stdout, r"\d+ of 1200 points are complete")
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
        self.assertIn("e.worst already exists and is not empty", done.stderr)
        self.assertEqual([p.name for p in self.folder.iterdir()], ["e.worst"])

    def test_one_run_for_each_output(self):
        batches = self.folder / "e.batches"
        batches.mkdir()
        words = ("sweep", "elastica", "--vary", "load=1,2", "-f", "beamw", "-n", "1", "-o", self.folder / "e.h5")
        held = os.open(batches, os.O_RDONLY)
        fcntl.flock(held, fcntl.LOCK_EX)
        self.refused(2, "another 'beamwork sweep' is using this folder", *words, silent=False)
        os.close(held)
        self.answered(*words)
        self.assertFalse(batches.exists())

    def test_refusals(self):
        for words, says in (
                (("elastica",), "no parameter varies"),
                (("elastica", "--vary", "lod=1..2/3"), "did you mean 'load'"),
                (("elastica", "--vary", "load=1..2"), "the number of parts is missing"),
                (("elastica", "--vary", "load=1..5000/3"), "outside its range"),
                (("elastica", "--vary", "load=1..2/3", "--set", "load=3"), "given by both --set and --vary"),
                (("elastica", "--vary", "load=1..2/3", "--vary", "load=3,4"), "given twice"),
                (("elastica", "--vary", "load=1..2/3", "-k", "w_ovr_L"), "did you mean 'w_over_L'"),
                (("elastica", "--vary", "load=1..2/3", "--design", "sobl"), "is unknown; give one of grid|"),
                (("elastica", "--vary", "load=1..2/3", "--points", "3"), "--points requires"),
                (("elastica", "--vary", "load=1..2/3", "--seed", "3"), "--seed requires"),
                (("elastica", "--vary", "load=1..2", "--design", "halton"), "add, for example, --points 100"),
                (("elastica", "--vary", "load=1..2/3", "--error", "2"), "error"),
                (("elastica", "--vary", "load=1..2/3", "--format", "json"), "--format json is not supported here; give text or csv"),
                (("coupled_beam", "--vary", "coupling=0.1,0.2", "-f", "beamw_vlasov"),
                 "does not support coupled section"),
                (("c_column", "--vary", "height=0.4,0.5", "--set", "section_data=printed"),
                 "no scene can be built")):
            done = self.answered("sweep", *words, code=2)
            self.assertIn(says, done.stderr)
            self.assertEqual(done.stdout, "")
            self.assertEqual(len(done.stderr.splitlines()), 1)


if __name__ == "__main__":
    unittest.main()
