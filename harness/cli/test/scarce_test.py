"""If an allocation fails anywhere, including libraries and libc, every run must end within a time limit, with one line,
and leave a complete file or none."""
import re
import shutil
import subprocess
import unittest

from harness.library.python.test.module import sanitized
from harness.tools.kit.program import PROGRAM, ROOT, ProgramTest, environment

SCENE = """beamwork: 1
sections: {s: {rectangle: {width: 0.05, thickness: 0.005}, young: 210e9, shear_modulus: 81e9}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}
loads: {t: {force: [0, 1, 0], on: b}}
parameters: {thickness: {value: 0.005, unit: m}}
analyses: {path: {static: {stations: [1]}}}
quantities: {uy: {displacement: {analysis: path, node: b, component: uy}}}
meshes: [1, 2]
"""
OWN = ("--scene", "tiny.yaml", "-f", "beamw")
WORK = {
    "verify": ("verify", "-k", "elastica/default", "-f", "beamw", "-j", "2", "-o", "out.h5", "--json", "out.json"),
    "converge": ("converge", *OWN, "-o", "out.txt"),
    "solve": ("solve", *OWN, "--format", "json", "-o", "out.json"),
    "matrices": ("solve", *OWN, "-n", "2", "--matrices", "out"),
    "sweep": ("sweep", *OWN, "--vary", "thickness=1e-3,1e-2", "-j", "1", "-o", "out.h5"),
    "stress": ("stress", "-f", "beamw", "-k", "thin_sheet", "-j", "1", "-o", "out.txt"),
}
LIMIT = 60  # [s]
TRIES = 12
# if memory runs out while HDF5 1.10 starts, it crashes, calls exit() or prints its own errors
CRASHED = "beamwork: the program crashed; "
TIMES = re.compile(r"[0-9.e+-]+ m?s\b|\"(seconds\w*|time|load\w*)\": [^,\n]*")


@unittest.skipIf(sanitized(), "needs a program without sanitizers")
class Scarce(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.library = cls.class_folder() / "scarce.so"
        subprocess.run(["cc", "-std=c11", "-D_GNU_SOURCE", "-O1", "-shared", "-fPIC",
                        ROOT / "harness" / "cli" / "test" / "scarce.c", "-o", cls.library, "-ldl", "-pthread"],
                       check=True)

    def attempt(self, words, **scarce):
        for path in self.folder.iterdir():
            if path.is_dir():
                shutil.rmtree(path)
            else:
                path.unlink()
        (self.folder / "tiny.yaml").write_text(SCENE, encoding="utf-8")
        with subprocess.Popen([PROGRAM, *words], cwd=self.folder, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE,
                              env=environment(LD_PRELOAD=str(self.library), **scarce)) as process:
            try:
                out, errors = process.communicate(timeout=LIMIT)
            except subprocess.TimeoutExpired:
                process.kill()
                self.fail(f"{words} with {scarce}: no end after {LIMIT} s")
        return (process.returncode, TIMES.sub("#", out), errors,
                sorted(str(p.relative_to(self.folder)) for p in self.folder.rglob("*")))

    def test_every_verb(self):
        for verb, words in WORK.items():
            counted = self.folder.parent / f"{self.folder.name}.count"
            self.addCleanup(counted.unlink, missing_ok=True)
            right = self.attempt(words, SCARCE_COUNT=str(counted))
            self.assertIn(right[0], (0, 1), right)
            all_calls = int(counted.read_text(encoding="ascii"))
            self.assertGreater(all_calls, 500, verb)
            for k in range(1, all_calls, all_calls // TRIES):
                with self.subTest(verb=verb, call=k):
                    code, out, errors, files = self.attempt(words, SCARCE_AT=str(k))
                    self.assertFalse([name for name in files if ".part-" in name], files)
                    if code == right[0]:
                        self.assertEqual(("".join(out.split()), files), ("".join(right[1].split()), right[3]))
                        continue
                    last = errors.strip().splitlines()[-1]
                    self.assertTrue(last.startswith("beamwork: "), errors)
                    self.assertTrue(code in (2, 4, 5) or last.startswith(CRASHED), (code, errors))

    def test_results_of_workers(self):
        code, _, errors, files = self.attempt(WORK["verify"], SCARCE_AT="1", SCARCE_ONLY="fmemopen")
        self.assertEqual((code, errors, files), (4, "beamwork: out of memory for results; close other programs, or reduce the problem, for example with fewer elements\n", ["tiny.yaml"]))


if __name__ == "__main__":
    unittest.main()
