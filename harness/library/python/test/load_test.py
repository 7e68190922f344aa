"""Finding, loading and installing the Python module, and its documentation."""
import ast
import json
import os
import re
import shutil
import subprocess
import sys
import unittest

from harness.library.python.test.module import (FOLDER, LIBRARY, ModuleTest, ROOT, SETTINGS, bw,
                                                python)
from harness.tools.kit.program import PROGRAM, environment


EXAMPLES = ROOT / "elements" / "examples"
CASE = "tapered_cantilever"
# A formulation stays loaded for the life of a process, so each test needs its own Python process.
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
        path = self.folder / "asked.py"
        path.write_text(code, encoding="utf-8")
        done = subprocess.run([sys.executable, path, door], env=environment(**SETTINGS), text=True,
                              check=False, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def test_bits(self):
        for kind in ("object", "process"):
            with self.subTest(kind):
                door = self.door(kind)
                name, values, cell = json.loads(self.asked(SOLVE, door))
                record = self.record("solve", CASE, "--element", door, "-f", name, "-n", 4)
                self.assertEqual({q["quantity"]: q["value"] for q in record["quantities"]}, values)
                self.assertEqual(cell["value"], values[cell["quantity"]])

    def test_threads(self):
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


INSIDE = """
import sys, threading
import beamwork as bw
sys.path.insert(0, sys.argv[1])
import timoshenko as t
calls = []
def strain(*state):
    calls.append(threading.current_thread())
    return t.strain(*state)
words = dict(family="example", strains=6, shear_theories=["haringx"], limits=["doubly symmetric"],
             offers=["shear", "geometric", "large rotations", "mass", "rotary inertia"])
bw.load("exec:" + sys.executable + " " + sys.argv[1] + "/timoshenko.py")
name = bw.load(t.prepare, strain, name="inside", summary="x", source="y", **words)
scene = bw.Scene.case("tapered_cantilever")
ours, theirs = (dict(scene.solve(n, 4).values) for n in (name, "timoshenko_py"))
assert ours == theirs and calls and threading.main_thread() not in calls
series = [[r["value"] for r in scene.converge(n, meshes=[1, 2], jobs=2)] for n in (name, "timoshenko_py")]
assert series[0] == series[1]
swept = bw.sweep("elastica", name, "timoshenko_py", vary={"load": [1]}, elements=2)
assert swept.where(formulation=name)[0]["value"] == swept.where(formulation="timoshenko_py")[0]["value"]
assert bw.element_test(name).passed == bw.element_test("timoshenko_py").passed
def bad(*state):
    raise RuntimeError("no strain today")
bw.load(t.prepare, bad, name="bad", summary="x", source="y", **words)
try:
    scene.solve("bad", 1)
except bw.Error as error:
    assert "no strain today" in str(error), error
else:
    raise AssertionError("solved")
for wrong, told in ((lambda: bw.load(t.prepare, t.strain, colour=1), "colour=1 is no key"),
                    (lambda: bw.load("./x.so", strains=6), ""),
                    (lambda: bw.load(t.prepare, t.strain, damping=[[1.0]]),
                     "is no function; give a function that returns it")):
    try:
        wrong()
    except TypeError as error:
        assert told in str(error), error
        continue
    raise AssertionError("accepted")
print("done")
"""


class Inside(ModuleTest):

    def test_functions_of_this_process(self):
        done = subprocess.run([sys.executable, "-c", INSIDE, EXAMPLES], text=True, check=False, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, env=environment(**SETTINGS, BEAMWORK=PROGRAM))
        self.assertEqual((done.stdout, done.returncode), ("done\n", 0), done.stderr)


class Finding(ModuleTest):

    def test_missing(self):
        settings = {**SETTINGS, "BEAMWORK_LIBRARY": str(self.folder / "none.so")}
        done = python("import beamwork", env=environment(**settings))
        last = done.stderr.strip().splitlines()[-1]
        self.assertTrue(last.startswith("ImportError: beamwork: "), last)
        self.assertIn("none.so", last)
        self.assertIn("BEAMWORK_LIBRARY", last)

    def test_no_library(self):
        path = self.folder / "rubbish.so"
        path.write_bytes(b"rubbish")
        done = python("import beamwork",
                      env=environment(**{**SETTINGS, "BEAMWORK_LIBRARY": str(path)}))
        self.assertIn("ImportError: beamwork: ", done.stderr.strip().splitlines()[-1])

    def test_another_library(self):
        path = self.folder / "other.so"
        subprocess.run(["cc", "-shared", "-o", path, "-xc", "/dev/null"], check=True)
        done = python("import beamwork",
                      env=environment(**{**SETTINGS, "BEAMWORK_LIBRARY": str(path)}))
        self.assertIn("bw_", done.stderr.strip().splitlines()[-1])

    def test_beside_and_installed(self):
        source = os.path.dirname(bw.__file__)
        for module, library in (("here/beamwork", "here"), ("here2/beamwork", "here2/beamwork"),
                                ("w/beamwork", "w/beamwork/lib"),
                                ("p/lib/python3/dist-packages/beamwork", "p/lib"),
                                ("q/lib/python3/dist-packages/beamwork", "q/lib/x86_64-linux-gnu"),
                                ("clone/harness/library/python/beamwork", "clone/build")):
            with self.subTest(library):
                place = self.folder / module
                subprocess.run(["cp", "-r", source, f"{self.folder}/copied"], check=True)
                place.parent.mkdir(parents=True, exist_ok=True)
                os.rename(self.folder / "copied", place)
                (self.folder / library).mkdir(parents=True, exist_ok=True)
                os.link(LIBRARY, self.folder / library / LIBRARY.name)
                settings = {**SETTINGS, "PYTHONPATH": str(place.parent)}
                del settings["BEAMWORK_LIBRARY"]
                without = {k: v for k, v in environment(**settings).items()
                           if k != "BEAMWORK_LIBRARY"}
                done = python("import beamwork; print(beamwork.path)", env=without)
                self.assertEqual(done.stdout.strip(),
                                 str(self.folder / library / LIBRARY.name), done.stderr)


class Said(ModuleTest):

    def test_version(self):
        cited = re.search(r"^version: (\S+)", (ROOT / "CITATION.cff").read_text("utf-8"), re.M)
        self.assertEqual(cited.group(1), bw.version)

    def test_help(self):
        done = python("import beamwork; help(beamwork)")
        for name in bw.__all__:
            self.assertIn(name, done.stdout)
            if callable(getattr(bw, name)):
                self.assertTrue(getattr(bw, name).__doc__, name)
        for cls in (bw.Scene, bw.Result, bw.Records):
            for name, member in vars(cls).items():
                if not name.startswith("_") and callable(member):
                    self.assertTrue(member.__doc__, f"{cls.__name__}.{name}")


class Types(ModuleTest):

    @unittest.skipUnless(shutil.which("mypy"), "needs mypy")
    def test_mypy(self):
        done = subprocess.run(["mypy", "--cache-dir", self.folder, "--python-executable", sys.executable], cwd=ROOT,
                              text=True, check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_everything_has_types(self):
        """Every function of the module must have types of its arguments and of its result. This is tested also without
        mypy."""
        for path in sorted((FOLDER / "beamwork").rglob("*.py")):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.FunctionDef):
                    given = node.args.posonlyargs + node.args.args + node.args.kwonlyargs
                    given += [one for one in (node.args.vararg, node.args.kwarg) if one]
                    bare = [a.arg for a in given if a.annotation is None and a.arg not in ("self", "cls")]
                    self.assertEqual((bare, node.returns is None), ([], False), f"{path.name}: {node.name}")
        self.assertTrue((FOLDER / "beamwork" / "py.typed").exists())


if __name__ == "__main__":
    unittest.main()
