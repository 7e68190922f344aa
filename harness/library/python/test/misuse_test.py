"""Wrong use of the Python module, and its use of memory."""
import copy
import ctypes
import gc
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
import unittest

import numpy

from harness.library.python.test.module import ModuleTest, SETTINGS, bw, leaf, python
from harness.tools.kit.program import environment


CASE = "sheet_cantilever"


def solved_here(elements):
    return bw.Scene.case(CASE).solve("sheet_third", elements)["C_zz"]


class Arguments(ModuleTest):

    def test_scenes(self):
        for words, kind, call in (
                ("nowhere", bw.Refused, lambda: bw.Scene.case("nowhere")),
                ("empty", bw.Refused, lambda: bw.Scene.case("")),
                ("string", TypeError, lambda: bw.Scene.case(None)),
                ("string", TypeError, lambda: bw.Scene.case(3)),
                ("null", bw.Refused, lambda: bw.Scene.case("a\0b")),
                ("case", bw.Refused, lambda: bw.Scene.case("\udcff")),
                ("case", bw.Refused, lambda: bw.Scene.case("x" * 100000)),
                ("nowhere.yaml", bw.Error, lambda: bw.Scene.open("nowhere.yaml")),
                ("empty", bw.Refused, lambda: bw.Scene.text("")),
                ("scene", bw.Refused, lambda: bw.Scene.text("{")),
                ("string", TypeError, lambda: bw.Scene.text(b"beamwork: 1")),
                ("sections", bw.Refused, lambda: bw.Scene("a").solve()),
                ("name", bw.Refused, lambda: leaf(bw.Scene("a b")).solve()),
                ("memebrs", AttributeError, lambda: bw.Scene().memebrs),
                ("memebrs", AttributeError, lambda: setattr(bw.Scene(), "memebrs", {})),
                ("nodes|write", AttributeError, lambda: bw.Scene.case(CASE).nodes),
                ("dict", TypeError, lambda: setattr(bw.Scene(), "nodes", [])),
                ("list", TypeError, lambda: setattr(bw.Scene(), "meshes", 3)),
        ):
            with self.subTest(words):
                self.one_line(kind, words, call)

    def test_entries(self):
        endless = {}
        endless["at"] = endless
        for words, entry in (
                ("nodes['tip']['at'][0] is nan", {"at": [float("nan"), 0, 0]}),
                ("nodes['tip']['at'][1] is inf", {"at": numpy.array([0, numpy.inf, 0])}),
                ("NoneType", {"at": None}), ("complex", {"at": [1j, 0, 0]}),
                ("empty", {"hold": ""}), ("is not a name", {3: 4}), ("is not a name", {"": 4}),
                ("set", {"at": {1, 2, 3}}), ("nested", endless), ("bytes", {"hold": b"all"}),
                ("at", {"at": [0.1, 0, 0, 0]}), ("nodes['tip']", {"at": "x" * 5000}),
                ("hold", {"at": [0.1, 0, 0], "hold": "\udcff"}),
                ("hold", {"at": [0.1, 0, 0], "hold": "a\0b"}), ("nodes", 3), ("nodes", [1])):
            with self.subTest(words):
                scene = leaf()
                scene.nodes["tip"] = entry
                self.one_line(bw.Refused, words, scene.solve)

    def test_solving(self):
        scene = bw.Scene.case(CASE)
        for words, kind, call in (
                ("elements", bw.Refused, lambda: scene.solve("sheet_third", 0)),
                ("elements", bw.Refused, lambda: scene.solve("sheet_third", -1)),
                ("elements", bw.Refused, lambda: scene.solve("sheet_third", 2**40)),
                ("elements", bw.Refused, lambda: scene.solve("sheet_third", True)),
                ("elements", TypeError, lambda: scene.solve("sheet_third", 1.5)),
                ("elements", TypeError, lambda: scene.solve("sheet_third", "2")),
                ("elements", TypeError, lambda: scene.solve("sheet_third", float("nan"))),
                ("sheet_thrd|sheet_third", bw.Refused, lambda: scene.solve("sheet_thrd")),
                ("formulation", bw.Refused, lambda: scene.solve("")),
                ("formulation", TypeError, lambda: scene.solve(["sheet_third"])),
                ("newton", bw.Refused, lambda: scene.solve("sheet_third:newton=x")),
                ("stepz", bw.Refused, lambda: scene.solve("sheet_third", 1, stepz=3)),
                ("steps", bw.Refused, lambda: scene.solve("sheet_third", 1, steps="three")),
                ("options", TypeError, lambda: scene.solve("sheet_third", 1, steps=float("nan"))),
                ("options", TypeError, lambda: scene.solve("sheet_third", 1, steps=object())),
                ("thickness", TypeError, lambda: scene.set(thickness=None)),
                ("thickness is nan", bw.Refused, lambda: scene.set(thickness=float("nan"))),
                ("thickness", bw.Refused, lambda: scene.set(thickness="")),
                ("thickness", TypeError, lambda: scene.set(thickness=[1, 2])),
                ("thickness", TypeError, lambda: scene.set(thickness=numpy.ones(2))),
                ("meshes", bw.Refused, lambda: scene.converge(meshes=[])),
                ("meshes", TypeError, lambda: scene.converge(meshes=3)),
                ("meshes", bw.Refused, lambda: scene.converge(meshes=[0])),
                ("formulation", TypeError, lambda: scene.converge(["a", "b"])),
                ("select", TypeError, lambda: bw.verify(select=3)),
                ("nothing", bw.Error, lambda: bw.verify(select="nothing_like_it")),
                ("my.so", bw.Error, lambda: bw.load("./my.so")),
                ("element", TypeError, lambda: bw.load(None)),
                ("nowhere.h5", bw.Error, lambda: bw.truths("nowhere.h5")),
        ):
            with self.subTest(words):
                self.one_line(kind, words, call)
        self.assertEqual(scene.solve("sheet_third", numpy.int64(1)).elements, 1)

    def test_results(self):
        result = bw.Scene.case(CASE).solve("sheet_third", 1)
        for words, kind, call in (
                ("C_zx|C_", KeyError, lambda: result["C_zx"]),
                ("None", KeyError, lambda: result[None]),
                ("[]", KeyError, lambda: result[[]]),
                ("curve", KeyError, lambda: result["C_zz_curve"]),
                ("C_zz", KeyError, lambda: result.curve("C_zz")),
                ("3", KeyError, lambda: result.curve(3)),
                ("pickled|document", TypeError, lambda: pickle.dumps(result)),
                ("pickled", TypeError, lambda: copy.deepcopy(result)),
                ("pickled|write", TypeError, lambda: pickle.dumps(bw.Scene.case(CASE))),
                ("assignment", TypeError, lambda: operator_set(result.values, "C_zz", 1)),
                ("read-only", ValueError,
                 lambda: operator_set(result.curve("C_zz_curve").y, 0, 1)),
        ):
            with self.subTest(words):
                self.one_line(kind, words, call)

    def test_failures_carry_what_was_found(self):
        scene = bw.Scene.case("roll_up").set(turns=2)
        error = self.one_line(bw.NotConverged, "converge", scene.solve, "beamw_first", 1)
        self.assertIsInstance(error.result, bw.Result)
        self.assertEqual(error.result.cell["status"], "not_converged")
        again = pickle.loads(pickle.dumps(error))
        self.assertEqual((type(again), str(again), again.result),
                         (bw.NotConverged, str(error), None))

    def test_no_pandas(self):
        done = python("import sys; sys.modules['pandas'] = None\nimport beamwork as bw\n"
                      "bw.cases().frame()")
        self.assertIn("ImportError: beamwork: frame() requires pandas", done.stderr)


def operator_set(target, key, value):
    target[key] = value


class Memory(ModuleTest):

    def test_views_outlive_the_result(self):
        result = bw.Scene.case(CASE).solve("sheet_third", 1, shapes=5)
        x, y = result.curve("C_zz_curve")
        position = result.shapes.position
        kept = x.copy(), y.copy(), position.copy()
        other = result.curve("C_zz_curve").y
        self.assertEqual(other.__array_interface__["data"], y.__array_interface__["data"])
        result.close()
        del result
        gc.collect()
        for _ in range(50):
            bw.Scene.case(CASE).solve("sheet_third", 1, shapes=5)
        for ours, theirs in zip(kept, (x, y, position)):
            numpy.testing.assert_array_equal(ours, theirs)

    def test_closed(self):
        with bw.Scene.case(CASE).solve("sheet_third", 1) as result:
            value = result["C_zz"]
        self.assertEqual(result["C_zz"], value)
        for call in (lambda: result.curve("C_zz_curve"), lambda: result.document,
                     lambda: result.shapes, lambda: result.steps):
            self.one_line(ValueError, "closed", call)
        result.close()
        self.assertIn("closed", repr(result))

    def test_result_outlives_the_scene(self):
        scene = bw.Scene.case(CASE)
        result = scene.solve("sheet_third", 1)
        before = copy.deepcopy(result.document["parameters"])
        scene.set(thickness=1e-3)
        del scene
        gc.collect()
        result._handle.pointer  # pylint: disable=pointless-statement,protected-access
        again = bw.Scene.case(CASE).solve("sheet_third", 1)
        self.assertEqual(before, again.parameters)

    def test_shapes(self):
        shapes = bw.Scene.case(CASE).solve("sheet_third", 2, shapes=4).shapes
        self.assertEqual(shapes.position.shape[0], len(shapes.kinds))
        self.assertEqual(shapes.position.shape[1], shapes.first[-1])
        numpy.testing.assert_array_equal(shapes.position[0, [0, -1]], [[0, 0, 0], [0.1, 0, 0]])
        self.assertAlmostEqual(shapes.position[-1, -1, 1], 0.015, 12)
        self.assertIsNone(bw.Scene.case(CASE).solve("sheet_third", 2).shapes)


class Processes(ModuleTest):

    def test_threads(self):
        shared, found = bw.Scene.case(CASE), []
        expected = solved_here(2)

        def work(own):
            for _ in range(5):
                scene = bw.Scene.case(CASE) if own else shared
                found.append(scene.solve("sheet_third", 2)["C_zz"])

        threads = [threading.Thread(target=work, args=(i % 2, )) for i in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, [expected] * 40)

    def test_fork(self):
        numpy.linalg.inv(numpy.eye(300) + 1)
        keep = threading.Event()
        waiting = threading.Thread(target=keep.wait)
        waiting.start()
        try:
            with multiprocessing.get_context("fork").Pool(2) as pool:
                found = pool.map_async(solved_here, [1, 2, 1, 2]).get(60)
            self.assertEqual(found, [solved_here(1), solved_here(2)] * 2)
            self.assertTrue(bw.verify("collocation", select="elastica/default", jobs=2).passed)
        finally:
            keep.set()
            waiting.join()

    def test_fork_beside_threads(self):
        expected, done = solved_here(2), threading.Event()

        def work():
            while not done.is_set():
                solved_here(2)

        threads = [threading.Thread(target=work) for _ in range(2)]
        for thread in threads:
            thread.start()
        try:
            for _ in range(15):
                child = os.fork()
                if child == 0:
                    os._exit(0 if solved_here(2) == expected else 3)
                end, ended = time.monotonic() + 60, (0, 0)
                while ended[0] == 0 and time.monotonic() < end:
                    ended = os.waitpid(child, os.WNOHANG)
                    time.sleep(0.01)
                if ended[0] == 0:
                    os.kill(child, signal.SIGKILL)
                    os.waitpid(child, 0)
                self.assertEqual(ended, (child, 0))
        finally:
            done.set()
            for thread in threads:
                thread.join()

    def test_stop(self):
        readable, writable = os.pipe()
        self.addCleanup(os.close, readable)
        self.addCleanup(os.close, writable)
        scene = bw.Scene.case("elastica")
        self.assertTrue(scene.converge("beamw", meshes=[1, 2], stop=readable))
        os.write(writable, b"x")
        many = bw.Scene.case(CASE)
        for call in (lambda: many.converge(stop=readable), lambda: many.verify(stop=readable),
                     lambda: bw.verify(select=CASE, stop=readable)):
            self.one_line(bw.TimeLimit, "stopped before", call)
        for alone in (scene, bw.Scene.case("free_flight_space"), bw.Scene.case("deep_beam")):
            self.one_line(bw.TimeLimit, "stopped before", alone.solve, "collocation", 1, stop=readable)
        self.one_line(bw.Refused, "stop", scene.converge, stop=-1)
        self.assertGreater(scene.solve("collocation", 1)["w_over_L"], 0)

    def test_interrupted_solution(self):
        scene = bw.Scene.case("free_flight_space")
        expected = scene.solve("collocation", 1).values
        scene.set(time=100, step=1e-4, tolerance=0)
        threading.Timer(1, os.kill, (os.getpid(), signal.SIGINT)).start()
        begun = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            scene.solve("collocation", 1)
        self.assertLess(time.monotonic() - begun, 20)
        again = bw.Scene.case("free_flight_space").solve("collocation", 1)
        self.assertEqual(dict(again.values), dict(expected))

    def test_interrupt(self):
        for call in ("bw.verify(refine=3)", "while True: s.solve('collocation', 16)",
                     "bw.Scene.case('hexapod').converge(meshes=[16, 32, 64])"):
            code = ("import beamwork as bw\ns = bw.Scene.case('sheet_cantilever')\n"
                    f"print('go', flush=True)\n{call}\n")
            with self.subTest(call), subprocess.Popen(
                [sys.executable, "-c", code], env=environment(**SETTINGS), text=True,
                    stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
                process.stdout.readline()
                threading.Timer(1, process.send_signal, (signal.SIGINT, )).start()
                _, told = process.communicate(timeout=100)
                self.assertIn("KeyboardInterrupt", told)
                self.assertEqual(process.returncode, -signal.SIGINT)


CYCLES = 1000
BOUND = 300 * CYCLES  # [bytes] a leak of 1 kB per cycle would exceed this bound by a factor of three


class Arena(ctypes.Structure):
    """struct mallinfo2 of the C library, with the bytes that malloc has allocated and not yet freed."""
    _fields_ = [(name, ctypes.c_size_t) for name in
                ("arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks", "fsmblks", "uordblks",
                 "fordblks", "keepcost")]


def in_use():
    gc.collect()
    ask = ctypes.CDLL(None).mallinfo2
    ask.restype = Arena
    found = ask()
    return found.uordblks + found.hblkhd


def cycle(built):
    scene = bw.Scene.case("sheet_cantilever").set(tip_deflection=0.01)
    result = scene.solve("sheet_third", 1, shapes=3)
    if len(result.curve("C_zz_curve").x) + len(result.steps) + len(result.shapes.kinds) == 0:
        raise AssertionError("nothing was made")
    built.solve("beamw", 1)
    try:
        bw.Scene.text("beamwork: 1\nnode: {}\n")
    except bw.Refused:
        return
    raise AssertionError("nothing was refused")


class Leaks(ModuleTest):

    def grown(self, work):
        for _ in range(50):
            work()
        before = in_use()
        for _ in range(CYCLES):
            work()
        return in_use() - before

    def test_thousand_cycles(self):
        built = leaf()
        self.assertLess(self.grown(lambda: cycle(built)), BOUND)

    def test_a_leak_is_noticed(self):
        kept = []
        self.assertGreater(self.grown(lambda: kept.append(bytearray(1024))), BOUND)


if __name__ == "__main__":
    unittest.main()
