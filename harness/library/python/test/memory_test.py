"""Memory after a thousand scenes, solutions and results."""
import ctypes
import gc
import unittest

from harness.library.python.test.module import ModuleTest, bw, leaf

CYCLES = 1000
BOUND = 300 * CYCLES  # bytes: a third of what a leak of 1 kB in each cycle would be


class Arena(ctypes.Structure):
    """struct mallinfo2 of the C library: bytes that malloc has handed out and not got back."""
    _fields_ = [(name, ctypes.c_size_t) for name in
                ("arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks", "fsmblks", "uordblks",
                 "fordblks", "keepcost")]


def in_use():
    """Bytes in use, of the library and of Python."""
    gc.collect()
    ask = ctypes.CDLL(None).mallinfo2
    ask.restype = Arena
    found = ask()
    return found.uordblks + found.hblkhd


def cycle(built):
    """All that is made and must be freed."""
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
        """Bytes in use after a thousand more times."""
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
        """The same measure sees 1 kB of each cycle that is kept."""
        kept = []
        self.assertGreater(self.grown(lambda: kept.append(bytearray(1024))), BOUND)


if __name__ == "__main__":
    unittest.main()
