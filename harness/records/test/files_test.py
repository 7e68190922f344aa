"""Files the program writes: complete or not there at all, and readable by others."""
import csv
import io
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

from harness.tools.kit.program import PROGRAM, TRUTHS, ProgramTest, read_json, run
from reference.pack import seal

SELECTION = ("verify", "-k", "warping_torsion/default")
# Many cells, of which the first ones, the most expensive, end soon.
QUICK = " and ".join(f"not {word}" for word in ("_motion", "leaf_guide", "flight", "rigid_body", "release",
                                                "pendulum", "spin_up", "lee_frame"))


def small_files():
    """In the child: a file cannot grow beyond 2000 bytes, as on a disk that is full."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))


class Folder(ProgramTest):
    def path(self, name):
        return str(self.folder / name)

    def text(self, name):
        return pathlib.Path(self.path(name)).read_text(encoding="utf-8")


class Complete(Folder):
    def test_full_disk(self):
        """Each kind of file on a full disk: one line, exit 4, and what was there before is
        untouched."""
        wanted = {"-o": "r.h5", "--json": "v.json", "--junit": "j.xml"}
        for option, name in wanted.items():
            pathlib.Path(self.path(name)).write_bytes(b"before")
            done = run(*SELECTION, option, self.path(name), preexec_fn=small_files)
            self.assertEqual(done.returncode, 4, done.stderr)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
            self.assertEqual(pathlib.Path(self.path(name)).read_bytes(), b"before")
        self.assertEqual(sorted(os.listdir(self.folder)), sorted(wanted.values()))

    def test_killed(self):
        """Whenever a run is killed, its file is the whole one, or not there: before the work,
        while it is written, behind it."""
        run(*SELECTION, "-o", self.path("whole.h5"))
        whole = os.path.getsize(self.path("whole.h5"))
        for look in range(24):
            process = subprocess.Popen([PROGRAM, *SELECTION, "-o", self.path("r.h5")],
                                       stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
            if look % 2 == 1:
                process.stdout.read(1)   # the work is done, the file comes next
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
    """Who asks to end (Ctrl-C, SIGTERM) has what was judged until then, under names that say so."""

    def started(self, cells, *arguments):
        """A run that has done so many cells: it says so to a terminal."""
        terminal, end = pty.openpty()
        self.addCleanup(os.close, terminal)
        process = subprocess.Popen([PROGRAM, "verify", *arguments], stdout=subprocess.PIPE,
                                   stderr=end, start_new_session=True)
        os.close(end)
        said = b""
        while max((int(n) for n in re.findall(rb"cells (\d+) of \d+", said)), default=0) < cells:
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
        """Values are those of a run that was left alone; limits do without the noise, which is
        measured last."""
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
        self.check_partial(signal.SIGINT, group=True)    # a terminal asks everybody, workers too
        self.check_partial(signal.SIGTERM, group=False)

    def test_ignored(self):
        """nohup: what is ignored ends nothing."""
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
        """Elements from which on every error is within a level, against the errors in the same
        file."""
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
        """A selection reaches single quantities."""
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
        """Exit code and output of a run of one case with a copy of the truths that was changed."""
        pathlib.Path(self.path("t.h5")).write_bytes(pathlib.Path(TRUTHS).read_bytes())
        with h5py.File(self.path("t.h5"), "r+") as file:
            change(file)
        seal(self.path("t.h5"))
        return run(*SELECTION, "--truths", self.path("t.h5"))

    def test_value(self):
        def change(file):
            file["truths/warping_torsion/value"][...] *= 1.01
        self.assertEqual(self.altered(lambda file: None).returncode, 0)
        self.assertEqual(self.altered(change).returncode, 1)

    def test_unit(self):
        def change(file):
            file["truths/warping_torsion/unit"][...] = b"m"
        done = self.altered(change)
        self.assertEqual(done.returncode, 4)
        self.assertIn("'m'", done.stderr)

    def test_stale(self):
        def change(file):
            file["truths/warping_torsion/hash"][0] += 1
        done = self.altered(change)
        self.assertEqual(done.returncode, 4)
        self.assertIn("stale", done.stderr)
        self.assertIn("warping_torsion", done.stderr)

    def test_other_parameters(self):
        """Truths that speak of other points judge nothing here."""
        def change(file):
            del file["truths/warping_torsion"]
        self.assertEqual(self.altered(change).returncode, 3)


if __name__ == "__main__":
    unittest.main()
