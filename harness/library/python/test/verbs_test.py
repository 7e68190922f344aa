"""Every verb of the program must have a function in Python, which returns the data that the program writes."""
import csv
import io
import json
import os
import re
import shutil
import signal
import sys
import threading
import time
import unittest
from unittest import mock

from harness.library.python.test.module import ModuleTest, SETTINGS, bw, leaf
from harness.tools.kit.program import PROGRAM, ROOT, environment, read_json, run

RUNS = ("-f", "beamw", "-n", "1,2")
CLOCKS = re.compile(r"clock|seconds.*|spent|round_.*|keep_all_.*|repeats|kept|noise|work_spread")


def timeless(data):
    if isinstance(data, dict):
        return {k: timeless(v) for k, v in data.items() if not CLOCKS.fullmatch(k)}
    return [timeless(one) for one in data] if isinstance(data, list) else data


class Verbs(ModuleTest):

    @classmethod
    def setUpClass(cls):
        cls.place = cls.class_folder()
        for name in ("one", "other"):
            run("verify", "-k", "elastica/default and collocation", "-o", cls.place / f"{name}.h5")

    def json(self, *arguments, code=0):
        return json.loads(self.answered(*arguments, "--format", "json", code=code).stdout)

    def csv(self, *arguments):
        return list(csv.DictReader(io.StringIO(self.answered(*arguments, "--format", "csv").stdout)))

    def same(self, ours, theirs):
        self.assertEqual(timeless(ours), timeless(theirs))
        self.assertGreater(len(ours), 0)

    def same_rows(self, ours, theirs):
        self.assertGreater(len(ours), 0)
        self.assertEqual(len(ours), len(theirs))
        for mine, one in zip(timeless(list(ours)), timeless(theirs)):
            self.assertEqual(list(mine), list(one))
            for key, value in mine.items():
                told = one[key]
                self.assertEqual(value, type(value)(told) if value is not None else None, key)
                self.assertEqual(value is None, told == "" and not isinstance(value, str), key)

    def test_list(self):
        self.same(bw.list_(), self.json("list"))
        self.same(bw.list_("beamw"), self.json("list", "beamw"))

    def test_explain(self):
        for words in ("wrong limit", "haringx", ""):
            self.assertEqual(bw.explain(words), self.answered("explain", *words.split()).stdout)
        self.one_line(bw.Refused, "frobnicate", bw.explain, "frobnicate")

    def test_solve(self):
        ours = bw.Scene.case("elastica").solve("beamw", 2).document
        self.same(ours, self.json("solve", "elastica", "-f", "beamw", "-n", 2))

    @unittest.skipUnless(shutil.which("/usr/bin/python3"), "needs /usr/bin/python3")
    def test_plot(self):
        ours = bw.plot("lee_frame", self.folder / "a.csv", "collocation", elements=2)
        self.answered("plot", "lee_frame", "-f", "collocation", "-n", 2, "-o", self.folder / "b.csv")
        self.assertEqual(ours.read_bytes(), (self.folder / "b.csv").read_bytes())

    def test_converge(self):
        theirs = self.json("converge", "elastica", *RUNS)
        scene = bw.Scene.case("elastica")
        self.same(scene.converge("beamw", meshes=[1, 2]).document, theirs)
        self.same(scene.converge("beamw", meshes=[1, 2], progress=print).document, theirs)

    def test_sweep(self):
        ours = bw.sweep("elastica", "beamw", vary={"load": "1..2/2"}, elements=[1, 2])
        self.same_rows(ours, self.csv("sweep", "elastica", "--vary", "load=1..2/2", *RUNS))
        self.assertEqual({r["unit"] for r in ours}, {"1", "rad"})
        listed = bw.sweep("elastica", "beamw", vary={"load": [1, 1.5, 2]}, elements=[1, 2])
        self.assertEqual(timeless(list(listed)), timeless(list(ours)))

    def test_truth(self):
        for given in ({}, {"load": 2.5}):
            words = [f"--set={k}={v}" for k, v in given.items()]
            self.same(bw.truth("elastica", set=given), self.json("truth", "elastica", *words))
        one = bw.truth(bw.Scene.case("elastica").set(load=2.5))["values"][0]
        printed = self.answered("truth", "elastica", "--set", "load=2.5").stdout
        self.assertIn(f"{one['value']:.13g}"[:14], printed)
        path = ROOT / "cases" / "examples" / "leaf_spring_guide.yaml"
        self.same(bw.truth(path), self.json("truth", path))
        self.refused(2, "text and json", "truth", "elastica", "--format", "csv")

    def test_scene(self):
        self.assertEqual(bw.Scene.case("elastica").write(), self.answered("scene", "elastica").stdout)

    def test_verify(self):
        select, path = "elastica/default and collocation", self.folder / "v.json"
        self.answered("verify", "-k", select, "--json", path)
        self.same(bw.verify("collocation", select=select).document, read_json(path))
        told = bw.verify(select=select, junit=self.folder / "j.xml")
        self.same(told.document, read_json(path))
        self.assertTrue((self.folder / "j.xml").exists())

    def test_bench(self):
        ours = bw.bench("elastica", formulations=("beamw",), elements=[1])
        theirs = self.csv("bench", "elastica", "-f", "beamw", "-n", 1)
        self.assertEqual([list(one) for one in ours], [list(one) for one in theirs])
        self.assertEqual([one["value"] for one in ours], [float(one["value"]) for one in theirs])
        self.assertGreater(ours[0]["seconds_solve"], 0)

    def test_stress(self):
        select = "thin_sheet and collocation"
        self.same(bw.stress(select=select), self.json("stress", "-k", select))

    def test_motion(self):
        ours = bw.motion("free_flight_space", "collocation", elements=1, integrator=["alpha", "radau"],
                         step=0.1, set={"time": 0.2})
        self.same(ours, self.json("motion", "free_flight_space", "-f", "collocation", "-n", 1, "--integrator",
                                  "alpha,radau", "--step", 0.1, "--set", "time=0.2"))
        self.assertTrue(ours.passed)

    def test_element_test(self):
        ours = bw.element_test("beamw_vlasov")
        self.same(ours, self.json("element-test", "beamw_vlasov"))
        self.assertTrue(ours.passed)

    def test_merge(self):
        select = "elastica/default and collocation"
        self.answered("verify", "-k", select, "--shard", "1/1", "--into", self.folder / "parts")
        self.answered("merge", self.folder / "parts", "--json", self.folder / "v.json")
        self.same(bw.merge(self.folder / "parts").document, read_json(self.folder / "v.json"))
        words = ("sweep", "elastica", "--vary", "load=1..2/2", *RUNS)
        self.answered(*words, "--shard", "1/1", "--into", self.folder / "swept")
        self.same_rows(bw.merge(self.folder / "swept", of="sweep"), self.csv(*words))

    def test_compare(self):
        one, other = self.place / "one.h5", self.place / "other.h5"
        ours = bw.compare(one, other)
        self.assertTrue(ours.same)
        self.assertEqual(str(ours) + "\n", self.answered("compare", one, other).stdout)
        self.one_line(bw.Refused, "none.h5", bw.compare, one, self.folder / "none.h5")

    def test_export(self):
        path = ROOT / "cases" / "examples" / "leaf_spring_guide.yaml"
        theirs = self.answered("export", "--scene", path, "--to", "calculix", "-n", 2).stdout
        for scene in (path, bw.Scene.open(path)):
            self.assertEqual(bw.export(scene, elements=2), theirs)

    def test_import(self):
        path = self.folder / "theirs.csv"
        path.write_text("# beamwork-import: 1\n# program: Other\n# case: elastica\n"
                        "quantity, unit, elements, unknowns, seconds, x, value, uncertainty\n"
                        "w_over_L, 1, 10, 60, 1, , 0.3017, \n", encoding="utf-8")
        stored = bw.import_(path, output=self.folder / "theirs.h5")
        found = bw.verify("collocation", select="elastica/default", imported=stored)
        self.assertIn("Other", {one["formulation"] for one in found})
        path.write_text(path.read_text("utf-8").replace("w_over_L", "w_over_M"), encoding="utf-8")
        error = self.one_line(bw.Refused, "w_over_M", bw.import_, path, output=self.folder / "n.h5")
        self.assertEqual([m.line for m in error.mistakes], [5])

    def test_schema(self):
        self.same(bw.schema(), self.json("schema"))

    def test_each_has_a_function(self):
        verbs = re.findall(r"^  ([a-z-]+)  +\S", self.answered("--help").stdout.partition("to begin with")[0], re.M)
        self.assertGreater(len(verbs), 16)
        methods = {"solve": bw.Scene.solve, "converge": bw.Scene.converge, "scene": bw.Scene.write}
        for verb in verbs:
            name = verb.replace("-", "_")
            self.assertTrue(hasattr(type(self), f"test_{name}"), verb)
            if name not in methods:
                name += "_" if name in ("list", "import") else ""
                self.assertIn(name, bw.__all__)
                self.assertTrue(getattr(bw, name).__doc__, verb)


class Running(ModuleTest):

    def test_scenes(self):
        built = leaf()
        built.parameters["push"] = {"value": 1, "unit": "N"}
        built.loads["push"]["force"] = [0, "push", 0]
        found = bw.sweep(built, "beamw", vary={"push": [1, 2]}, elements=1).where(quantity="tip_uy")
        for record in found:
            value = built.copy().set(push=record["push"]).solve("beamw", 1)["tip_uy"]
            self.assertEqual(value, record["value"])
        self.one_line(bw.Refused, "did you mean 'elastica'", bw.sweep, "elastic", vary={"load": [1]})

    def test_refused(self):
        self.one_line(bw.Refused, "--colour", bw.stress, colour="red")

    def test_progress(self):
        program = self.folder / "program"
        program.write_text("#!/bin/sh\n[ -t 2 ] || exit 4\nprintf '\\rcells 3 of 7, 40 %%, about 3 s left: elastica, "
                           "beamw, n = 2\\r   \\r\\rtimes of points 4 of 7, 50 %%: x\\r' >&2\n"
                           "echo '{\"outcomes\": []}'\n", encoding="utf-8")
        program.chmod(0o755)
        seen = []
        with mock.patch.dict(os.environ, BEAMWORK=str(program)):
            self.assertEqual(bw.stress(progress=lambda *told: seen.append(told)), {"outcomes": []})
            self.assertEqual(seen, [(3, 7, 0.4, "elastica, beamw, n = 2"), (4, 7, 0.5, "x")])
            with self.assertRaises(ZeroDivisionError):
                bw.stress(progress=lambda *told: 1 / 0)
            self.one_line(bw.Fault, "status 4", bw.stress)

    def test_interrupt(self):
        timer = threading.Timer(1.5, os.kill, [os.getpid(), signal.SIGINT])
        timer.start()
        begun = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            bw.verify(refine=3, exit_zero=True)
        self.assertLess(time.monotonic() - begun, 20)
        self.assertTrue(bw.element_test("beamw_vlasov").passed)

    def test_loaded(self):
        code = ("import beamwork as bw, sys; name = bw.load(sys.argv[1]);"
                "print(name, bw.sweep('elastica', name, vary={'load': [1]}, elements=2)[0]['status'])")
        path = ROOT / "elements" / "examples" / "timoshenko.py"
        done = run("-c", code, f"exec:{sys.executable} {path}", program=sys.executable,
                   env=environment(**SETTINGS, BEAMWORK=PROGRAM))
        self.assertEqual(done.stdout.split(), ["timoshenko_py", "ok"], done.stderr)


if __name__ == "__main__":
    unittest.main()
