"""Shards of verbs that are computed, killed, damaged and merged must give the result of a single run."""
import os
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import time
import zlib

import h5py

from harness.tools.kit.program import PROGRAM, TRUTHS, ProgramTest, environment, read_json, run

CASES = "(roll_up or bend_45 or right_angle_frame or snap_through) and default"
SCENE = """beamwork: 1
parameters:
  reach: {value: 0.1, unit: m, min: 0.01, max: 1, about: length}
sections:
  leaf: {rectangle: {width: 50e-3, thickness: 0.5e-3}, young: 210e9, shear_modulus: 81e9}
nodes:
  base: {at: [0, 0, 0], hold: all}
  tip:  {at: [reach, 0, 0]}
members:
  leaf: {from: base, to: tip, section: leaf, y: [0, 1, 0]}
loads:
  push: {force: [0, 1, 0], on: tip}
analyses:
  run: {linear: {}}
"""


def without_times(text):
    return [line for line in text.splitlines() if " in " not in line or " runs, and " not in line]


class SpreadTest(ProgramTest):

    def hash_of(self, file):
        return self.answered("compare", "--hash", file).stdout.split()[:2]

    def shard(self, which, *arguments, into="parts", code=0, **options):
        return self.answered(*arguments, "--shard", which, "--into", self.folder / into, code=code,
                             **options)

    def names(self, into="parts"):
        return sorted(path.name for path in (self.folder / into).iterdir())


class Verify(SpreadTest):

    @classmethod
    def setUpClass(cls):
        cls.home = cls.class_folder()
        cls.alone = run("verify", "-k", CASES, "-o", cls.home / "alone.h5", "--json",
                        cls.home / "alone.json", "--junit", cls.home / "alone.xml")
        assert cls.alone.returncode == 0, cls.alone.stderr
        for k in (3, 1, 2):
            done = run("verify", "-k", CASES, "--shard", f"{k}/3", "--into", cls.home / "parts")
            assert done.returncode == 0, done.stderr

    def setUp(self):
        super().setUp()
        shutil.copytree(self.home / "parts", self.folder / "parts")

    def merged(self, *options, folders=("parts",), code=0):
        return self.answered("merge", *(self.folder / name for name in folders), "-o",
                             self.folder / "merged.h5", *options, code=code)

    def is_as_alone(self, *options, folders=("parts",)):
        done = self.merged(*options, folders=folders)
        self.assertEqual(self.hash_of(self.folder / "merged.h5"),
                         self.hash_of(self.home / "alone.h5"))
        return done

    def test_merged(self):
        done = self.is_as_alone("--json", self.folder / "merged.json", "--junit",
                                self.folder / "merged.xml")
        self.assertEqual(without_times(done.stdout), without_times(self.alone.stdout))
        ours, theirs = (read_json(path) for path in
                        (self.folder / "merged.json", self.home / "alone.json"))
        self.assertEqual(ours["verdicts"], theirs["verdicts"])
        with h5py.File(self.folder / "merged.h5") as file:
            self.assertIn(f"({os.uname().nodename})", file.attrs["processor"].decode())
        tests = [path.read_text().count("<testcase") for path in
                 (self.folder / "merged.xml", self.home / "alone.xml")]
        self.assertGreater(tests[0], 50)
        self.assertEqual(tests[0], tests[1])

    def test_anywhere(self):
        (self.folder / "more").mkdir()
        names = self.names()
        self.assertGreater(len(names), 3)
        for name in names[::2]:
            shutil.copy(self.folder / "parts" / name, self.folder / "more")
        (self.folder / "parts" / names[0]).unlink()
        self.answered("merge", "more", "parts", "-o", "here.h5", cwd=self.folder)
        self.assertEqual(self.hash_of(self.folder / "here.h5"),
                         self.hash_of(self.home / "alone.h5"))

    def test_again(self):
        gone = self.folder / "parts" / self.names()[1]
        gone.unlink()
        done = self.shard("1/1", "verify", "-k", CASES)
        self.assertIn(" 1 computed now", done.stdout)
        self.assertTrue(gone.exists())
        self.assertIn(" 0 computed now", self.shard("2/5", "verify", "-k", CASES).stdout)
        self.is_as_alone()

    def test_missing(self):
        names = self.names()
        for name in names[1:]:
            (self.folder / "parts" / name).unlink()
        done = self.merged(code=5)
        self.assertIn(f"{len(names) - 1} of {len(names)} batches are missing: 2-{len(names)} "
                      "(shards ", done.stderr)
        self.assertEqual(done.stdout, "")
        done = self.merged("--partial", code=5)
        self.assertIn("not computed", done.stderr)
        self.assertRegex(" ".join(done.stdout.split()), "INCOMPLETE: for the existing part every")
        self.assertFalse((self.folder / "merged.h5").exists())
        self.assertGreater(int(self.hash_of(self.folder / "merged.partial.h5")[1]), 1000)

    def test_spoilt(self):
        first, second, *_ = (self.folder / "parts" / name for name in self.names())
        os.truncate(first, first.stat().st_size // 2)
        content = bytearray(second.read_bytes())
        content[len(content) // 2] ^= 1
        second.write_bytes(content)
        done = self.merged(code=5)
        for path in (first, second):
            self.assertIn(f"{path} is truncated, damaged or altered; delete it, and start its shard again (this batch counts as missing)",
                          done.stderr)
        self.assertIn(" 2 computed now", self.shard("1/1", "verify", "-k", CASES).stdout)
        self.is_as_alone()

    def test_foreign(self):
        parts = self.folder / "parts"
        self.refused(2, ["another request", "(verify --select"], "verify", "-k", "elastica",
                     "--into", parts)
        other = self.folder / "beamwork"
        content = bytearray(pathlib.Path(PROGRAM).read_bytes())
        content[content.index(b"\4\0\0\0\x14\0\0\0\3\0\0\0GNU\0") + 16] ^= 1  # within the build id
        other.write_bytes(content)
        other.chmod(0o755)
        self.refused(2, ["another build"], "merge", parts, program=str(other),
                     env=environment(BEAMWORK_TRUTHS=TRUTHS))
        (parts / "odd.batch").write_text("some text\n")
        self.refused(2, ["odd.batch", "not a batch of this program"], "merge", parts)

    def test_other_answers(self):
        name = self.names()[0]
        other = self.folder / "other"
        other.mkdir()
        line, rest = (self.folder / "parts" / name).read_bytes().split(b"\n", 1)
        at = line.index(b'"content":"') + 11
        line = line[:at] + bytes([ord("0") if line[at] != ord("0") else ord("1")]) + line[at + 1:]
        body = line + b"\n" + rest[:-40]
        (other / name).write_bytes(body + b"beamwork-seal %016x %08x\n" % (
            len(body), zlib.crc32(body)))
        self.refused(2, [f"parts/{name}", f"other/{name}", "contain different results of the same batch"], "merge",
                     self.folder / "parts", other)

    def test_no_room(self):
        names = self.names()
        gone = max(names, key=lambda name: (self.folder / "parts" / name).stat().st_size)
        (self.folder / "parts" / gone).unlink()
        self.refused(4, ["cannot be written"], "verify", "-k", CASES, "--into",
                     self.folder / "parts",
                     preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096)))
        self.assertEqual(self.names(), [name for name in names if name != gone])
        self.shard("1/1", "verify", "-k", CASES)
        self.is_as_alone()


class Killed(SpreadTest):

    def test_killed(self):
        alone = self.folder / "alone.h5"
        self.answered("verify", "-k", CASES, "-o", alone)
        parts = self.folder / "parts"
        dice = random.Random(20)
        written = {}
        for i in range(20):
            with subprocess.Popen([PROGRAM, "verify", "-k", CASES, "--into", parts],
                                  start_new_session=True, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL) as child:
                time.sleep(dice.uniform(0, 0.5))
                (os.killpg if i % 2 else os.kill)(child.pid, signal.SIGKILL)
            time.sleep(0.05)
            for path in parts.glob("*.batch") if parts.exists() else ():
                self.assertEqual(written.setdefault(path.name, path.stat().st_mtime_ns),
                                 path.stat().st_mtime_ns, "a batch was computed twice")
        self.answered("verify", "-k", CASES, "--into", parts)
        self.assertTrue(all(name.endswith(".batch") or (parts / name).stat().st_size == 0
                            for name in self.names()), self.names())
        self.answered("merge", parts, "-o", self.folder / "merged.h5")
        self.assertEqual(self.hash_of(self.folder / "merged.h5"), self.hash_of(alone))

    def test_interrupted(self):
        parts = self.folder / "parts"
        with subprocess.Popen([PROGRAM, "verify", "--into", parts], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True) as child:
            while not any(parts.glob("*.batch")) and child.poll() is None:
                time.sleep(0.01)
            child.send_signal(signal.SIGINT)
            out, errors = child.communicate()
        self.assertEqual((child.returncode, out), (5, ""))
        self.assertRegex(errors, r"^beamwork: interrupted: \d+ of \d+ batches of shard 1/1 are "
                         "missing; start the shard again with the same command\n$")
        self.assertEqual([name for name in self.names() if not name.endswith(".batch")], [])


class Others(SpreadTest):

    def test_own_scene(self):
        scene = self.folder / "leaf.yaml"
        scene.write_text(SCENE)
        ask = ("verify", "--scene", scene)
        self.answered(*ask, "-o", self.folder / "alone.h5", code=3)
        for which in ("1/2", "2/2"):
            self.shard(which, *ask)
        self.answered("merge", self.folder / "parts", "-o", self.folder / "merged.h5", code=3,
                      cwd=pathlib.Path("/"))
        self.assertEqual(self.hash_of(self.folder / "merged.h5"),
                         self.hash_of(self.folder / "alone.h5"))
        scene.write_text(SCENE.replace("0.1, unit", "0.2, unit"))
        self.refused(2, ["other reference values, scene files or formulations"], "merge", self.folder / "parts")

    def test_refused(self):
        parts = self.folder / "parts"
        for words, arguments in (
                (["K/N"], ["--shard", "3/2", "--into", parts]),
                (["--into batches"], ["--shard", "1/2"]),
                (["beamwork merge"], ["--into", parts, "-o", self.folder / "r.h5"]),
                (["give only one"], ["--into", parts, "--from", parts]),
                (["--partial requires"], ["--partial"])):
            self.refused(2, words, "verify", "-k", "elastica", *arguments)
        for verb in ("bench", "converge", "stress"):
            self.refused(2, ["--into"], verb, "--into", parts)
        self.refused(2, ["merge requires the folders of --into"], "merge")
        self.refused(4, ["nowhere", "cannot be read"], "merge", self.folder / "nowhere")
        self.refused(2, ["contains no batch that can be read"], "merge", self.folder)
        self.assertFalse(parts.exists())
