"""Files of results, with the frames of motions."""
import csv
import io
import json
import os
import pathlib
import pty
import re
import resource
import signal
import subprocess
import unittest
import xml.etree.ElementTree

import h5py
import numpy
import numpy as np

from harness.tools.kit.program import PROGRAM, ProgramTest, TRUTHS, read_json, run
from reference.pack import seal


SELECTION = ("verify", "-k", "warping_torsion/default")
QUICK = " and ".join(f"not {word}" for word in ("_motion", "leaf_guide", "flight", "rigid_body", "release",
                                                "pendulum", "spin_up", "lee_frame"))


def small_files():
    """In the child process, limits files to 2000 bytes, so that writing fails as on a full
    disk."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))


class Folder(ProgramTest):

    def path(self, name):
        return str(self.folder / name)

    def text(self, name):
        return pathlib.Path(self.path(name)).read_text(encoding="utf-8")


class Complete(Folder):

    def test_full_disk(self):
        wanted = {"-o": "r.h5", "--json": "v.json", "--junit": "j.xml"}
        for option, name in wanted.items():
            pathlib.Path(self.path(name)).write_bytes(b"before")
            done = run(*SELECTION, option, self.path(name), preexec_fn=small_files)
            self.assertEqual(done.returncode, 4, done.stderr)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
            self.assertEqual(pathlib.Path(self.path(name)).read_bytes(), b"before")
        self.assertEqual(sorted(os.listdir(self.folder)), sorted(wanted.values()))

    def test_killed(self):
        run(*SELECTION, "-o", self.path("whole.h5"))
        whole = os.path.getsize(self.path("whole.h5"))
        for look in range(24):
            process = subprocess.Popen([PROGRAM, *SELECTION, "-o", self.path("r.h5")],
                                       stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
            if look % 2 == 1:
                process.stdout.read(1)
            for _ in range(40 * (look // 2)):
                if os.path.exists(self.path("r.h5")) or process.poll() is not None:
                    break
            process.kill()
            process.communicate()
            if os.path.exists(self.path("r.h5")):
                self.assertAlmostEqual(os.path.getsize(self.path("r.h5")), whole, delta=100)
                self.assertEqual(run("compare", self.path("whole.h5"), self.path("r.h5"),
                                     "--threshold", "error=0,floor=0,work=0").returncode, 0)
            for left in os.listdir(self.folder):
                if left != "whole.h5":
                    os.remove(self.path(left))

    def test_nowhere(self):
        for option in ("-o", "--json", "--junit"):
            for place in (self.folder, self.path("none/r")):
                done = run(*SELECTION, option, place)
                self.assertEqual(done.returncode, 4, done)
                self.assertIn("cannot be written", done.stderr)
        self.assertEqual(os.listdir(self.folder), [])


class Interrupted(Folder):
    def started(self, cells, *arguments):
        terminal, end = pty.openpty()
        self.addCleanup(os.close, terminal)
        process = subprocess.Popen([PROGRAM, "verify", *arguments], stdout=subprocess.PIPE,
                                   stderr=end, start_new_session=True)
        os.close(end)
        said = b""
        while max((int(n) for n in re.findall(rb"runs (\d+) of \d+", said)), default=0) < cells:
            said += os.read(terminal, 4096)
        return process, terminal

    def ended(self, process, terminal):
        out = process.communicate()[0].decode()
        return out, os.read(terminal, 65536).decode()

    def check_partial(self, number, group):
        files = {"-o": "r.h5", "--json": "v.json", "--junit": "j.xml", "--markdown": "v"}
        process, terminal = self.started(60, "-j", "2", "-k", QUICK,
                                         *(word for option, name in files.items()
                                           for word in (option, self.path(name))))
        (os.killpg if group else os.kill)(process.pid, number)
        out, said = self.ended(process, terminal)
        self.assertEqual(process.returncode, 5, said)
        self.assertIn("r.partial.h5", said)
        self.assertIn("interrupted", out)
        self.assertEqual(sorted(os.listdir(self.folder)),
                         ["j.partial.xml", "r.partial.h5", "v.partial", "v.partial.json"])
        self.assertIn("interrupted", self.text("v.partial"))
        suite = xml.etree.ElementTree.parse(self.path("j.partial.xml")).getroot()[0]
        self.assertEqual(int(suite.get("failures")), len(suite.findall("testcase/failure")))
        self.assertGreater(int(suite.get("failures")), 0)
        self.check_content(read_json(self.path("v.partial.json")))
        for name in os.listdir(self.folder):
            os.remove(self.path(name))

    def check_content(self, summary):
        self.assertGreater(summary["unfinished_cells"], 0)
        self.assertGreater(len(summary["verdicts"]), 0)
        with h5py.File(self.path("r.partial.h5")) as file:
            self.assertEqual(file.attrs["unfinished_cells"], summary["unfinished_cells"])
        case = summary["verdicts"][0]["case"]
        name = f"{case}/{summary['verdicts'][0]['parameters'] or 'default'}"
        run("verify", "-k", name.replace(";", " and "), "--json", self.path("whole.json"))
        whole = read_json(self.path("whole.json"))
        self.assertEqual(whole["unfinished_cells"], 0)
        key = ("case", "parameters", "formulation", "quantity")
        of = {tuple(row[k] for k in key): row for row in whole["verdicts"]}
        both = [(row, of[tuple(row[k] for k in key)]) for row in summary["verdicts"]
                if tuple(row[k] for k in key) in of]
        self.assertGreater(len(both), 0)
        for here, there in both:
            for name in ("value", "truth", "tolerance"):
                self.assertEqual(here[name], there[name])

    def test_asked(self):
        self.check_partial(signal.SIGINT, group=True)
        self.check_partial(signal.SIGTERM, group=False)

    def test_ignored(self):
        process = subprocess.Popen([PROGRAM, *SELECTION, "-o", self.path("r.h5")],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN))
        process.send_signal(signal.SIGINT)
        process.communicate()
        self.assertEqual(process.returncode, 0)
        self.assertEqual(os.listdir(self.folder), ["r.h5"])


class Readable(Folder):

    def test_results(self):
        done = run(*SELECTION, "-o", self.path("r.h5"), "--json", self.path("v.json"), "--junit",
                   self.path("j.xml"))
        self.assertEqual(done.returncode, 0, done.stdout)
        summary = read_json(self.path("v.json"))
        suite = xml.etree.ElementTree.parse(self.path("j.xml")).getroot()[0]
        self.assertEqual(int(suite.get("tests")), len(suite))
        self.assertEqual(int(suite.get("failures")), 0)
        self.assertEqual(len(suite), len(summary["verdicts"]) + len(summary["agreements"]) + 3)
        with h5py.File(self.path("r.h5")) as file:
            self.assertEqual(file.attrs["schema"], b"beamwork-results")
            case = file["cases/warping_torsion"]
            points, table, values = case["points"][()], case["verdicts"][()], case["quantities"][()]
            self.assertEqual(points["kL"][points["point"] == b"default"], [1])
            for row in summary["verdicts"]:
                at = numpy.flatnonzero((table["formulation"] == row["formulation"].encode())
                                       & (table["quantity"] == row["quantity"].encode()))[0]
                self.assertEqual(table["verdict"][at].decode(), row["verdict"])
                numpy.testing.assert_equal(table["limit"][at],
                                           numpy.nan if row["limit"] is None else row["limit"])
            row = next(row for row in summary["verdicts"] if row["formulation"] == "beamw")
            finest = max(values[values["formulation"] == b"beamw"],
                         key=lambda value: value["elements"])
            self.assertEqual(finest["value"], row["value"])
            self.assertEqual(finest["unit"], b"1")

    def test_reached(self):
        run("verify", "-k", "elastica/default or warping_torsion/default", "-o", self.path("r.h5"))
        seen = set()
        with h5py.File(self.path("r.h5")) as file:
            for case in ("elastica", "warping_torsion"):
                tables = {name: file["cases"][case][name][()]
                          for name in ("verdicts", "quantities")}
                for row in tables["verdicts"]:
                    seen |= self.check_reached(row, tables["quantities"])
        self.assertGreater(len(seen), 3)

    def check_reached(self, row, values):
        own = ((values["formulation"] == row["formulation"])
               & (values["quantity"] == row["quantity"]))
        value = sorted(zip(values["elements"][own], values["value"][own]))
        seen = set()
        if not value or numpy.isnan(row["truth"]):
            return seen
        error = [(n, float(v) / row["truth"] - 1) for n, v in value]
        for column, level in (("reach_10", 0.1), ("reach_1", 0.01), ("reach_0.1", 1e-3),
                              ("reach_0.01", 1e-4)):
            right = next((n for i, (n, _) in enumerate(error)
                          if all(abs(e) <= level for _, e in error[i:])), 0)
            self.assertEqual(row[column], right,
                             f"{row['formulation']} {row['quantity']} {column}")
            seen.add(right)
        return seen

    def test_csv(self):
        done = run("converge", "warping_torsion", "-f", "beamw", "-f", "beamw_vlasov", "-n",
                   "4,2,8", "--format", "csv")
        rows = list(csv.DictReader(io.StringIO(done.stdout)))
        self.assertEqual([(row["formulation"], row["elements"]) for row in rows],
                         [(name, n) for name in ("beamw", "beamw_vlasov") for n in ("2", "4", "8")])
        for row in rows:
            value, truth, error = (float(row[name]) for name in ("value", "truth", "error"))
            self.assertAlmostEqual((value - truth) / truth, error, delta=1e-12)

    def test_quantity(self):
        done = run("verify", "-k", "c_column/default and buckling_load", "--json",
                   self.path("v.json"))
        self.assertEqual(done.returncode, 0, done.stdout)
        summary = read_json(self.path("v.json"))
        self.assertEqual({row["quantity"] for row in summary["verdicts"]}, {"buckling_load"})

    def test_malformed(self):
        for expression in ("and", "c_column or", "not", ""):
            done = run("verify", "-k", expression)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn("malformed", done.stderr)


class Gate(Folder):

    def altered(self, change):
        pathlib.Path(self.path("t.h5")).write_bytes(pathlib.Path(TRUTHS).read_bytes())
        with h5py.File(self.path("t.h5"), "r+") as file:
            change(file)
        seal(self.path("t.h5"))
        return run(*SELECTION, "--truths", self.path("t.h5"))

    def test_value(self):
        def change(file):
            table = file["truths/warping_torsion"]
            table["value"] = 1.01 * table["value"]
        self.assertEqual(self.altered(lambda file: None).returncode, 0)
        self.assertEqual(self.altered(change).returncode, 1)

    def test_unit(self):
        def change(file):
            file["truths/warping_torsion"]["unit"] = b"m"
        done = self.altered(change)
        self.assertEqual(done.returncode, 4)
        self.assertIn("'m'", done.stderr)

    def test_stale(self):
        def change(file):
            table = file["truths/warping_torsion"]
            table["hash"] = table["hash"] + np.uint64(1)
        done = self.altered(change)
        self.assertEqual(done.returncode, 4)
        self.assertIn("stale", done.stderr)
        self.assertIn("warping_torsion", done.stderr)

    def test_other_parameters(self):
        def change(file):
            del file["truths/warping_torsion"]
        self.assertEqual(self.altered(change).returncode, 3)


MOTION = ("solve", "elbow", "-f", "collocation", "-n", "2", "--set", "step=0.07",
          "--set", "tolerance=0", "--set", "integrator=alpha")


class Frames(ProgramTest):

    def solved(self, name, *more):
        path = self.folder / name
        self.answered(*MOTION, *more, "-o", path)
        return h5py.File(path)

    def shapes(self, file):
        (only,) = file["cases/elbow/shapes"].values()
        return only

    def test_times(self):
        for option, count in (("--shapes", 60), ("--shapes=3", 60), ("--shapes=8", 8)):
            with self.solved("times.h5", option, "--set", "time=2") as file:
                g = self.shapes(file)
                kinds = [k.decode() for k in g["kind"][()]]
                self.assertEqual(kinds, ["undeformed"] + ["motion"] * count)
                np.testing.assert_allclose(g["value"][1:], np.linspace(0, 2, count), atol=1e-15)
                np.testing.assert_allclose(file["VTKHDF/Steps/Values"], np.linspace(0, 2, count),
                                           atol=1e-15)

    def test_places(self):
        with self.solved("places.h5", "--shapes=9", "--set", "time=2") as file:
            nodes, first = self.shapes(file)["nodes"][()], self.shapes(file)["nodes"][0]
            np.testing.assert_array_equal(nodes[1], first)
            for frame in (6, 7, 8):
                time = 2 * (frame - 1) / 8
                record = json.loads(self.answered(*MOTION, "--set", f"time={time}", "--format",
                                                  "json").stdout)
                value = {q["quantity"]: q["value"] for q in record["quantities"]}
                place = [value[f"tip_{axis}"] for axis in "xyz"]
                np.testing.assert_allclose(nodes[frame][2], place, atol=2e-3)
                self.assertGreater(abs(place[2]), 0.03)

    def test_resultants(self):
        with self.solved("forces.h5", "--shapes=40", "--set", "time=2") as file:
            moment = self.shapes(file)["moment"][1:, 0, 1]
            self.assertGreater(np.ptp(moment), 50)
            self.assertLess(np.abs(np.diff(moment)).max(), 0.15 * np.ptp(moment))

    def test_temporal_grid(self):
        frames = 7
        with self.solved("grid.h5", f"--shapes={frames}", "--set", "time=1") as file:
            grid, steps = file["VTKHDF"], file["VTKHDF/Steps"]
            self.assertEqual(tuple(grid.attrs["Version"]), (2, 0))
            self.assertEqual(grid.attrs["Type"], b"UnstructuredGrid")
            self.assertEqual(steps.attrs["NSteps"], frames)
            points, cells, ids = (int(grid[f"NumberOf{name}"][0])
                                  for name in ("Points", "Cells", "ConnectivityIds"))
            self.assertEqual(grid["Points"].shape, (frames * points, 3))
            self.assertEqual(grid["Connectivity"].shape, (ids,))
            self.assertEqual(grid["Offsets"].shape, (cells + 1,))
            self.assertEqual(grid["Types"].dtype, np.uint8)
            self.assertLess(grid["Connectivity"][()].max(), points)
            along = points * np.arange(frames)
            for name, expected in (("PointOffsets", along), ("PartOffsets", 0 * along),
                                   ("NumberOfParts", 0 * along + 1)):
                np.testing.assert_array_equal(steps[name], expected, name)
            for name in ("CellOffsets", "ConnectivityIdOffsets"):
                np.testing.assert_array_equal(steps[name], np.zeros((frames, 1)), name)
            for name, data in grid["PointData"].items():
                self.assertEqual(len(data), frames * points, name)
                np.testing.assert_array_equal(steps["PointDataOffsets"][name], along, name)
            for name, data in grid["CellData"].items():
                self.assertEqual(len(data), cells, name)
                np.testing.assert_array_equal(steps["CellDataOffsets"][name], 0 * along, name)


if __name__ == "__main__":
    unittest.main()
