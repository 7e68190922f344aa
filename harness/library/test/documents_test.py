"""The documents of the library must equal those of the program byte for byte, except times, for every case and every
example."""
import ctypes
import pathlib
import re
import unittest

from harness.tools.kit.program import PROGRAM, ROOT, ProgramTest, read_json, run

LIBRARY = pathlib.Path(PROGRAM).parent / "libbeamwork.so.0"
EXAMPLES = sorted((ROOT / "cases" / "examples").glob("*.yaml"))
PART = {"hexapod_motion": "time=0.05"}
CLOCKS = re.compile(r'"(seconds_\w+|clock)": ("[^"]*"|[^,\n]+)')


class Library:
    """Calls library functions whose last two arguments receive a document and a message."""

    def __init__(self):
        self.calls = ctypes.CDLL(str(LIBRARY))

    def text(self, pointer):
        out = ctypes.string_at(pointer).decode()
        self.calls.bw_free_text(pointer)
        return out

    def made(self, name, *arguments):
        out, why = ctypes.c_void_p(), ctypes.c_void_p()
        status = getattr(self.calls, name)(*arguments, ctypes.byref(out), ctypes.byref(why))
        line = self.text(why) if why.value is not None else ""
        if out.value is None:
            raise AssertionError((name, status, line))
        return out

    def scene(self, name):
        if "/" not in name:
            return self.made("bw_scene_case", name.encode())
        return self.made("bw_scene_open", name.encode())

    def set(self, scene, assignment):
        why = ctypes.c_void_p()
        if self.calls.bw_scene_set(scene, assignment.encode(), ctypes.byref(why)) != 0:
            raise AssertionError(self.text(why))

    def solved(self, scene, formulation, elements):
        result = self.made("bw_solve", scene, formulation, elements, None)
        out = self.text(self.made("bw_result_json", result))
        self.calls.bw_result_free(result)
        return out


def is_sanitized():
    return b"__asan_" in LIBRARY.read_bytes()


@unittest.skipIf(is_sanitized(), "Python is not built with sanitizers")
class Documents(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.library = Library()

    def same(self, ours, *arguments):
        done = run(*arguments, "--format", "json")
        theirs = done.stdout
        self.assertIn(done.returncode, (0, 1), done.stderr)
        self.assertGreater(len(ours), 200)
        self.assertEqual(CLOCKS.sub("", ours), CLOCKS.sub("", theirs), arguments)

    def check(self, name, *words):
        scene = self.library.scene(name)
        listed = self.library.text(self.library.made("bw_scene_json", scene))
        self.same(listed, "list", *words)
        runs = [who["formulation"] for who in self.record("list", *words)["formulations"]
                if who["runs"]]
        if name in PART:
            self.library.set(scene, PART[name])
            words += ("--set", PART[name])
        self.same(self.library.solved(scene, None, 0), "solve", *words)
        self.same(self.library.solved(scene, runs[-1].encode(), 2), "solve", *words, "-f",
                  runs[-1], "-n", "2")
        written = self.library.text(self.library.made("bw_scene_write", scene))
        self.assertEqual(written, self.answered("scene", *words).stdout)
        self.library.calls.bw_scene_free(scene)

    def test_every_case(self):
        cases = [one["case"] for one in self.record("list", "cases")["cases"]]
        self.assertGreater(len(cases), 20)
        for name in cases:
            with self.subTest(name):
                self.check(name, name)

    def test_every_example(self):
        self.assertGreater(len(EXAMPLES), 10)
        for path in EXAMPLES:
            with self.subTest(path.name):
                self.check(str(path), "--scene", str(path))

    def test_list(self):
        for what in (None, "cases", "formulations", "beamw:mass=lumped"):
            name = what.encode() if what else None
            ours = self.library.text(self.library.made("bw_list", name))
            self.same(ours, "list", *([what] if what else []))

    def test_converge(self):
        scene = self.library.scene("elastica")
        ours = self.library.text(self.library.made("bw_converge", scene, None, b"1,2,4",
                                                   b'{"error": 0.002, "select": "w_over_L"}'))
        self.same(ours, "converge", "elastica", "-f", "all", "-n", "1,2,4", "--error", "0.2%", "-k",
                  "w_over_L")

    def test_verify(self):
        path = self.folder / "verdicts.json"
        stored = self.folder / "ours.h5"
        file = EXAMPLES[0]
        for name, select, words in ((None, "elastica/default and collocation", []),
                                    ("bend_45", "bend_45 and collocation", []),
                                    (str(file), None, ["--scene", str(file)])):
            scene = self.library.scene(name) if name else None
            chosen = ["-k", select] if select else []
            ours = self.library.text(self.library.made(
                "bw_verify", scene, None, select.encode() if select else None, None,
                str(stored).encode()))
            self.answered("verify", *words, *chosen, "--json", path, "-o", self.folder / "r.h5")
            self.assertEqual(CLOCKS.sub("", ours),
                             CLOCKS.sub("", path.read_text(encoding="utf-8")))
            self.assertGreater(read_json(path)["judged"], 0)
            self.answered("compare", stored, self.folder / "r.h5", "--threshold",
                          "error=0,floor=0,work=0")


if __name__ == "__main__":
    unittest.main()
