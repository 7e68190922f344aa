"""Destinations of output, and output on a terminal."""
import csv
import json
import os
import pty
import re
import shlex
import shutil
import signal
import subprocess
import threading
import time
import unittest

import h5py

from harness.cli.test.work import BOTH, TEXT, WHOLE, WORK
from harness.tools.kit.program import (PROGRAM, ProgramTest, ROOT, TRUTHS, environment, read_json,
                                       run)
from reference.pack import seal


def shape(text):
    return re.sub(r"[0-9][0-9.e+-]*", "#", text)


class Folder(ProgramTest):

    def stored(self, name):
        path = self.folder / name
        self.assertEqual(run("verify", *WORK["verify"], "-o", path).returncode, 0)
        return path


class Places(Folder):

    def test_no_places(self):
        for verb, work in WORK.items():
            for option in [(o,) for o in TEXT[verb]] + ([WHOLE[verb]] if WHOLE[verb] else []):
                self.refused(2, "the name of an output f", verb, *work, *option, "")
                self.refused(4, "cannot be written", verb, *work, *option, self.folder)
                self.refused(4, "cannot be written", verb, *work, *option,
                             self.folder / "none" / "file")
                self.refused(4, "cannot be written", verb, *work, *option, "x" * 300)
                self.refused(4, "cannot be written", verb, *work, *option, "/tmp/" + "x/" * 3000)
        self.assertEqual(os.listdir(self.folder), [])

    def test_whole_files(self):
        fifo = self.folder / "fifo"
        os.mkfifo(fifo)
        for verb, option in WHOLE.items():
            for place in (fifo, "/dev/stdout", "/dev/null") if option else ():
                self.refused(2, "regular file", verb, *WORK[verb], *option, place)
        self.assertTrue(fifo.is_fifo())

    def test_text_is_no_hdf5(self):
        for verb, options in TEXT.items():
            for option in options:
                for name in ("a.h5", "a.HDF5") if (verb, option) not in BOTH else ():
                    self.refused(2, ("this output is text, not HDF5", "solve --shapes"), verb, *WORK[verb], option, self.folder / name)
        self.assertEqual(os.listdir(self.folder), [])
        for verb, option in BOTH:
            path = self.folder / f"{verb}.HDF5"
            done = run(verb, *WORK[verb], option, path)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertNotEqual(done.stdout, "")
            with h5py.File(path) as file:
                self.assertEqual(list(file["experiments"]), [verb])

    def test_closed_standard_output(self):
        for work in (("verify", *WORK["verify"]), ("solve", "elastica", "-f", "beamw", "-n", "1", "--shapes"),
                     ("sweep", "elastica", "-f", "beamw", "-n", "1", "--vary", "load=1,2")):
            path = self.folder / f"{work[0]}.h5"
            done = subprocess.run(f"{shlex.join([PROGRAM, *work, '-o', str(path)])} >&-", shell=True, check=False,
                                  stderr=subprocess.PIPE, text=True)
            self.assertEqual((done.returncode, done.stderr),
                             (4, "beamwork: standard output cannot be written (Bad file descriptor); free disk space, or redirect the output to another file\n"))
            with h5py.File(path) as file:
                self.assertTrue(list(file))
        path = self.folder / "s.json"
        done = subprocess.run(f"{shlex.join([PROGRAM, 'stress', *WORK['stress'], '--json', str(path)])} >&-", shell=True,
                              check=False, stderr=subprocess.DEVNULL)
        self.assertEqual(done.returncode, 4)
        self.assertTrue(read_json(path)["outcomes"])

    def test_signals(self):
        for number in (signal.SIGTERM, signal.SIGHUP):
            for delay in (0.01, 0.03, 0.05, 0.08, 0.12):
                for work in (("converge", "loaded_cantilever", "-f", "beamw", "-o", "c.txt"),
                             ("verify", "-k", "loaded_cantilever", "-f", "beamw", "-o", "v.h5", "--json", "v.json")):
                    with subprocess.Popen([PROGRAM, *work], cwd=self.folder, stdout=subprocess.DEVNULL,
                                          stderr=subprocess.DEVNULL) as process:
                        time.sleep(delay)
                        process.send_signal(number)
                    self.assertEqual([name for name in os.listdir(self.folder) if ".part-" in name], [])

    def test_pipes(self):
        for verb, options in TEXT.items():
            for option in options:
                fifo, file, got = self.folder / "fifo", self.folder / "file", []
                os.mkfifo(fifo)
                reader = threading.Thread(target=lambda got=got,
                                          fifo=fifo: got.append(fifo.read_text(encoding="utf-8")))
                reader.start()
                done = run(verb, *WORK[verb], option, fifo)
                reader.join()
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertTrue(fifo.is_fifo())
                self.assertEqual(run(verb, *WORK[verb], option, file).returncode, 0)
                self.assertEqual(len(got[0].splitlines()),
                                 len(file.read_text(encoding="utf-8").splitlines()), (verb, option))
                fifo.unlink()

    def test_standard_output(self):
        work = ("converge", *WORK["converge"], "--format", "csv")
        piped = run(*work, "-o", "/dev/stdout").stdout
        plain = run(*work).stdout
        self.assertEqual(shape(piped), shape(plain))
        file = self.folder / "file"
        inside = f"echo before; '{PROGRAM}' {' '.join(work)} -o /dev/stdout; echo after"
        subprocess.run(f"{{ {inside}; }} >'{file}'", shell=True, check=True)
        self.assertEqual(shape(file.read_text(encoding="utf-8")),
                         shape("before\n" + plain + "after\n"))
        with open(file, "w", encoding="utf-8") as out:
            self.assertEqual(run("verify", *WORK["verify"], "-o", file, stdout=out).returncode, 2)

    def test_links(self):
        target, link = self.folder / "target", self.folder / "link"
        target.write_text("before", encoding="utf-8")
        link.symlink_to("target")
        self.assertEqual(run("verify", *WORK["verify"], "-o", link).returncode, 0)
        self.assertTrue(link.is_symlink() and not target.is_symlink())
        self.assertEqual(run("compare", target, link).returncode, 0)


class Twice(Folder):

    def names(self, name):
        path = self.folder / name
        link = self.folder / f"link_of_{name}"
        link.unlink(missing_ok=True)
        link.symlink_to(name)
        yield path
        yield f"{self.folder}/./{name}"
        yield link
        if path.exists():
            hard = self.folder / f"hard_{name}"
            hard.unlink(missing_ok=True)
            os.link(path, hard)
            yield hard

    def test_outputs(self):
        for there in (False, True):
            first = self.folder / "a"
            if there:
                first.write_text("before", encoding="utf-8")
            for name in self.names("a"):
                for one, other in (("-o", "--json"), ("--json", "--junit"),
                                   ("--junit", "--markdown"), ("-o", "--markdown")):
                    self.refused(2, "are the same file", "verify", *WORK["verify"], one, first,
                                 other, name)
                self.refused(2, "are the same file", "stress", *WORK["stress"], "-o", first,
                             "--json", name)
            self.assertEqual(first.read_text(encoding="utf-8") if there else first.exists(),
                             "before" if there else False)

    def test_two_devices(self):
        done = run("verify", *WORK["verify"], "--json", "/dev/null", "--junit", "/dev/null")
        self.assertEqual(done.returncode, 0, done.stderr)

    @staticmethod
    def why_not(name):
        return "not HDF5" if str(name).endswith(".h5") else "which is an input"

    def test_compared_file(self):
        path = self.stored("run.h5")
        before = path.read_bytes()
        for name in self.names("run.h5"):
            self.refused(2, self.why_not(name), "compare", path, "-o", name)
            self.assertEqual(path.read_bytes(), before)

    def test_truths(self):
        truths = self.folder / "truths.h5"
        shutil.copy(TRUTHS, truths)
        before = truths.read_bytes()
        for name in self.names("truths.h5"):
            for verb, work in WORK.items():
                for option in [(o,) for o in TEXT[verb]] + ([WHOLE[verb]] if WHOLE[verb] else []):
                    is_whole = WHOLE[verb] == option or (verb, *option) in BOTH
                    words = "which is an input" if is_whole else self.why_not(name)
                    self.refused(2, words, verb, *work, "--truths", truths, *option, name)
        self.assertEqual(truths.read_bytes(), before)

    def test_program(self):
        program = self.folder / "beamwork"
        shutil.copy(PROGRAM, program)
        before = program.read_bytes()
        self.refused(2, "which is an input", "verify", *WORK["verify"], "--truths", TRUTHS, "-o",
                     program, program=program)
        self.assertEqual(program.read_bytes(), before)


class LongPaths(Folder):

    def test_clone(self):
        deep = self.folder
        while len(str(deep)) < 3000:
            deep = deep / ("d" * 200)
        (deep / "build").mkdir(parents=True)
        program = deep / "build" / "beamwork"
        shutil.copy(PROGRAM, program)
        shutil.copy(TRUTHS, deep / "build" / "truths.h5")
        (deep / "reference").symlink_to(ROOT / "reference")
        alone = {k: v for k, v in os.environ.items() if not k.startswith("BEAMWORK")}
        for arguments in (("verify", *WORK["verify"], "-o", deep / "r.h5"),
                          ("truth", "elastica", "--set", "load=2.5"),
                          ("compare", deep / "r.h5", deep / "r.h5")):
            done = run(*arguments, program=program, env=alone)
            self.assertEqual(done.returncode, 0, done.stderr)


SELECT = ("verify", "-k", "c_column and section_data=printed and (beamw or collocation)")
SMALL = ("verify", "-k", "shear_elastica/default or elastica/default")
UTF8 = environment(LC_ALL="C.UTF-8")
ASCII = environment(LC_ALL="C")


def on_terminal(*arguments, **changes):
    parent, child = pty.openpty()
    with subprocess.Popen([PROGRAM, *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=child,
                          stderr=child, env=environment(**changes)) as process:
        os.close(child)
        written = b""
        try:
            while more := os.read(parent, 65536):
                written += more
        except OSError:
            pass
    os.close(parent)
    return written.decode(), process.returncode


class Pictures(ProgramTest):
    SCENE = """beamwork: 1
sections:
  tube: {tube: {diameter: 0.04, thickness: 2e-3}, young: 70e9, shear_modulus: 26e9, density: 2700}
nodes:
  wall: {at: [0, 0, 0], hold: all}
  tip: {at: [1, 0, 0], mass: 0.5}
members:
  arm: {from: wall, to: tip, section: tube, y: [0, 1, 0], damping: 1e-4}
loads:
  push: {force: [0, 10, 0], on: tip, path: [0, 1], factor: [0, 1], time: sin(30*t)}
analyses:
  pull: {static: {stations: [1]}}
  run: {motion: {stations: [0.1], step: 0.005}}
  shake: {harmonic: {frequencies: 5..500/20:log}}
  modes: {modal: {}}
quantities:
  bent: {displacement: {analysis: pull, node: tip, component: uy}}
  last: {displacement: {analysis: run, node: tip, component: uy}}
  most: {displacement: {analysis: run, node: tip, component: uy, take: max}}
  late: {displacement: {analysis: run, node: tip, component: uy, take: max_time}}
  gives: {response: {analysis: shake, node: tip, component: uy, force: tip, along: uy, take: max}}
  first: {frequency: {analysis: modes, which: 0}}
omit: [trapeze, wagner_moments, wagner_torque]
"""

    def setUp(self):
        super().setUp()
        self.scene = self.folder / "arm.yaml"
        self.scene.write_text(self.SCENE, encoding="utf-8")

    def plot(self, *options, code=0):
        return self.answered("plot", self.scene, "-n", "1", *options, code=code, cwd=self.folder)

    def table(self, *options):
        self.plot(*options, "-o", self.folder / "arm.csv")
        rows = list(csv.reader((self.folder / "arm.csv").read_text(encoding="utf-8").splitlines()))
        columns = {}
        for k, name in enumerate(rows[0]):
            columns.setdefault(name, [float(r[k]) for r in rows[1:] if r[k] != ""])
        return columns

    def test_forms(self):
        self.assertEqual(self.plot("-f", "beamw").stdout, "arm.png\n")
        for form, begin in (("png", b"\x89PNG"), ("svg", b"<?xml"), ("pdf", b"%PDF")):
            path = self.folder / f"arm.{form}"
            self.plot("-f", "beamw", "-f", "collocation", "-o", path)
            self.assertTrue(path.read_bytes().startswith(begin))
        words = (self.folder / "arm.svg").read_text(encoding="utf-8")
        for word in ("time [s]", "frequency [Hz]", "gives [m/N]", "gives, phase [rad]",
                     "collocation, n = 1", "last, most [m]"):
            self.assertIn(word, words)

    def test_columns(self):
        of = self.table("-f", "beamw")
        self.assertEqual(list(of), ["path", "bent [m]", "time [s]", "last [m]", "most [m]",
                                    "frequency [Hz]", "gives [m/N]", "gives, phase [rad]"])
        solved = json.loads(run("solve", self.scene, "-f", "beamw", "-n", "1", "--format",
                                "json").stdout)
        value = {q["quantity"]: q["value"] for q in solved["quantities"]}
        self.assertEqual((len(of["path"]), len(of["time [s]"])), (21, 301))
        self.assertAlmostEqual(of["bent [m]"][-1] / value["bent"], 1, 9)
        self.assertAlmostEqual(of["bent [m]"][10] / value["bent"], 0.5, 3)
        self.assertAlmostEqual(of["last [m]"][-1] / value["last"], 1, 9)
        self.assertAlmostEqual(max(of["most [m]"]) / value["most"], 1, 3)
        self.assertLess(max(of["gives, phase [rad]"]), 0)
        two = self.table("-f", "beamw", "-f", "collocation", "-k", "last")
        self.assertEqual(list(two), ["time [s]", "last [m] beamw, n = 1",
                                     "last [m] collocation, n = 1"])

    def test_refusals(self):
        for words, options in (("no quantity can be drawn as a curve", ("-k", "=first")),
                               ("plot writes figures (.png", ("-o", "arm.jpg")),
                               ("plot accepts one number of elements", ("-n", "2,4"))):
            self.assertIn(words, self.plot("-f", "beamw", *options, code=2).stderr)


class Screen(ProgramTest):

    def columns(self, text):
        for line in text.splitlines():
            self.assertLessEqual(len(line), 100, line)

    def test_widths(self):
        long_name = "collocation:stages=3,newton=displacement"
        for words in (("truth", "c_column"), ("truth", "warping_torsion"), ("scene", "--keys"),
                      ("bench", "c_column", "-f", "collocation", "--against", "beamw_consistent",
                       "--error", "10%"),
                      ("bench", "elastica", "-f", long_name, "-n", "1", "--against",
                       "beamw_consistent")):
            self.columns(self.answered(*words).stdout)

    def test_source_of_a_prediction(self):
        text = self.answered("solve", "sheet_cantilever", "-f", "sheet_third", "-n", "1").stdout
        self.assertRegex(text, r"(?m)^estimate C_xx .* %  N Eq\. 54, analytic$")

    def without_a_rule(self):
        path = self.folder / "t.h5"
        shutil.copy(TRUTHS, path)
        with h5py.File(path, "r+") as file:
            file["findings"]["quantities"] = b"gone"
        seal(path)
        return path

    def test_matrix(self):
        for env, marks in ((UTF8, "≠1 ✓ · ○ ✓ ✓ ≠1 ≈2 ○ ○"), (ASCII, "#1 ok . m ok ok #1 ~2 m m")):
            text = self.answered(*SMALL, env=env).stdout
            row, = re.findall(r"^shear_elastica +(\S.*)$", text, re.M)
            self.assertEqual(row.split(), marks.split())
            words = re.escape(marks.split()[0][0]) + " limit outside the tolerance "
            self.assertRegex(text, f"(?m)^{words}")
            self.columns(text)
            self.assertRegex(text, r"\d+ runs, and \d+ more to measure rounding scatter, in [\d.]+ s\n")
            self.assertEqual(text.isascii(), env is ASCII)

    def test_verdict_sentence(self):
        for quiet in ((), ("-q",)):
            text = self.answered(*SMALL, *quiet).stdout
            self.assertRegex(" ".join(text.split()), r"PASS: every verdict is as expected; 6 of them concern "
                             r"limits that differ from the reference value \(4 within the tolerance, 2 outside it\), as "
                             r'derived for these formulations \(beamwork explain "wrong limit, as '
                             r'predicted"\)\.')
        self.assertEqual(text.count("PASS"), 1)
        self.assertTrue(text.startswith("PASS"), text)
        self.assertLess(len(text.splitlines()), 5)

    def test_unexpected(self):
        truths = self.without_a_rule()
        for quiet in ((), ("-q",), ("-v",)):
            text = self.answered(*SELECT, "--truths", truths, *quiet, code=1, env=ASCII).stdout
            self.columns(text)
            end = text.splitlines()[-1]
            self.assertRegex(end, r"^FAIL: 3 verdicts differ from the expected ones\.$")
            block = text[text.index(" 1. "):]
            self.assertIn(" 1. c_column (section_data=printed), beamw, buckling_load [N]\n"
                          "    wrong limit, as predicted, expected pass\n", block)
            self.assertIn("-2.7801 %", block)
            self.assertEqual(len(re.findall(r"^ \d\. ", block, re.M)), 3)
            again = block[block.index("    beamwork "):].partition("\n\n")[0]
            again = shlex.split(again.replace("\\\n", ""))
        self.assertEqual(again[:5], ["beamwork", "converge", "c_column", "--set",
                                     "section_data=printed"])
        limit, = re.findall(r"limit ([\d.]+) \+- ", block.partition(" 2. ")[0])
        self.assertIn(limit[:6], self.answered(*again[1:]).stdout)

    def test_marks_of_the_unexpected(self):
        text = self.answered(*SELECT, "--truths", self.without_a_rule(), code=1, env=ASCII).stdout
        row, = re.findall(r"^c_column +(\S.*)$", text, re.M)
        self.assertIn("!#1", row.split())
        self.assertIn("! not as expected, see below   # limit outside the tolerance", text)

    def test_long_table(self):
        long = r"(?m)^  w_over_L \[.*\], truth 0\.\d+ \+- \S+ \(exact\)$"
        chosen = ("verify", "-k", "elastica/default and (beamw or collocation)")
        self.assertRegex(self.answered(*chosen).stdout, long)
        self.assertRegex(self.answered(*chosen, "-v").stdout, long)
        self.assertNotRegex(self.answered(*chosen, "-q").stdout, long)
        self.refused(2, "give only one of them", *chosen, "-q", "-v")

    def test_widths(self):
        longest = ("-f", "beamw_consistent:torsion=hyperbolic", "-f", "collocation")
        for words in (("solve", "c_column", *longest[:2], "-n", "2"),
                      ("solve", "sheet_cantilever", "-f", "sheet_third", "-n", "1"),
                      ("converge", "shear_elastica", "-n", "1,2,4"),
                      ("converge", "shear_elastica", "-n", "1,2,4", "-v"),
                      ("bench", "shear_elastica", *longest, "-n", "1,2", "--dense"),
                      ("stress", "-k", "decay_free"), ("stress", "-k", "twist_wagner")):
            text = self.answered(*words).stdout
            self.assertGreater(len(text.splitlines()), 3)
            self.columns(re.sub(r"(?m)( % against \w+), .*$", r"\1", text))

    def test_errors_in_percent(self):
        case = ("shear_elastica", "-f", "beamw", "-n", "4")
        error = 100 * self.record("solve", *case)["quantities"][0]["error"]
        shown = f"{error:+.4f} %"
        for verb in ("solve", "converge", "bench"):
            self.assertIn(shown, self.answered(verb, *case).stdout)

    def test_colour(self):
        coloured, code = on_terminal(*SMALL, TERM="xterm", NO_COLOR="")
        self.assertEqual(code, 0)
        self.assertIn("\x1b[32mPASS\x1b[0m", coloured)
        for plain in ({"TERM": "dumb", "NO_COLOR": ""}, {"TERM": "xterm", "NO_COLOR": "1"}):
            text, code = on_terminal(*SMALL, **plain)
            self.assertEqual(code, 0)
            self.assertIn("PASS: every", text)
            self.assertNotIn("\x1b[3", text)
        quiet, code = on_terminal(*SMALL, "-q", TERM="xterm", NO_COLOR="1")
        self.assertRegex(quiet, r"^PASS: [^\x1b]*$")
        self.assertNotIn("\r", quiet.replace("\r\n", ""))
        piped = self.answered(*SMALL, env=environment(TERM="xterm", NO_COLOR=""))
        self.assertNotIn("\x1b", piped.stdout + piped.stderr)


if __name__ == "__main__":
    unittest.main()
