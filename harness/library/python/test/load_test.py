"""Formulations of one's own from Python, through both doors: the bits of the program."""
import json
import os
import subprocess
import sys
import unittest

from harness.library.python.test.module import ROOT, SETTINGS, ModuleTest, python
from harness.tools.kit.program import environment

EXAMPLES = ROOT / "elements" / "examples"
CASE = "tapered_cantilever"
# Loaded once in the life of a process: each in a Python of its own.
SOLVE = """
import json, sys
import beamwork as bw
name = bw.load(sys.argv[1])
assert name in [f["formulation"] for f in bw.formulations()], name
scene = bw.Scene.case("tapered_cantilever")
print(json.dumps([name, dict(scene.solve(name, 4).values), scene.converge(name, meshes=[4])[0]]))
"""
THREADS = """
import sys, threading
import beamwork as bw
name, found = bw.load(sys.argv[1]), []
def work():
    for _ in range(10):
        found.append(bw.Scene.case("tapered_cantilever").solve(name, 4)["twist"])
threads = [threading.Thread(target=work) for _ in range(4)]
for thread in threads: thread.start()
for thread in threads: thread.join()
assert len(found) == 40 and len(set(found)) == 1, found
"""


class Doors(ModuleTest):

    def door(self, kind):
        if kind == "process":
            return f"exec:{sys.executable} {EXAMPLES / 'timoshenko.py'}"
        path = self.folder / "mine.so"
        subprocess.run([os.environ.get("CC", "cc"), "-O1", "-shared", "-fPIC", "-I", ROOT,
                        EXAMPLES / "timoshenko.c", "-o", path], check=True)
        return str(path)

    def asked(self, code, door):
        """What a Python of its own prints, which ends well."""
        path = self.folder / "asked.py"
        path.write_text(code, encoding="utf-8")
        done = subprocess.run([sys.executable, path, door], env=environment(**SETTINGS), text=True,
                              check=False, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def test_bits(self):
        """A shared object and a process: values of the program with the same element."""
        for kind in ("object", "process"):
            with self.subTest(kind):
                door = self.door(kind)
                name, values, cell = json.loads(self.asked(SOLVE, door))
                record = self.record("solve", CASE, "--element", door, "-f", name, "-n", 4)
                self.assertEqual({q["quantity"]: q["value"] for q in record["quantities"]}, values)
                self.assertEqual(cell["value"], values[cell["quantity"]])

    def test_threads(self):
        """Four threads share the element."""
        for kind in ("object", "process"):
            with self.subTest(kind):
                self.asked(THREADS, self.door(kind))

    def test_refused(self):
        for door, words in (("exec:/nowhere/at/all", "nowhere"), ("exec:", "exec"),
                            (f"exec:{sys.executable} -c pass", "first line"),
                            (str(ROOT / "README.md"), "README.md")):
            done = python(f"import beamwork as bw\ntry:\n    bw.load({door!r})\n"
                          "except bw.Refused as error:\n    print(error)")
            with self.subTest(door):
                self.assertEqual(len(done.stdout.splitlines()), 1, done.stderr)
                self.assertIn(words, done.stdout)


if __name__ == "__main__":
    unittest.main()
