"""A process that follows the protocol, with lines that a test inserts in three places."""
import pathlib
import sys
import textwrap
import time

from harness.tools.kit.program import ProgramTest

SPEAKER = '''
import json, os, signal, struct, sys, time
def read(count):
    data = b""
    while len(data) < count:
        more = os.read(0, count - len(data))
        if not more:
            sys.exit(0)
        data += more
    return data
def write(data):
    while data:
        data = data[os.write(1, data):]
def answer(body, outcome=0):
    write(struct.pack("<8sqq", b"beamwork", outcome, len(body)) + body)
with open({pids!r}, "a") as to:
    to.write(f"{{os.getpid()}}\\n")
said = dict(beamwork=1, name="speaker", summary="a test", source="none", family="example",
            offers=["shear", "geometric", "large rotations", "mass"], gives="e,J,H", strains=6)
{first}
write(json.dumps(said).encode() + b"\\n")
{then}
while True:
    _, what, mask, count, size = struct.unpack("<8sqqqq", read(40))
    body = read(size)
    each = {{2: (6, 84, 196), 3: (1, 6, 36)}}.get(what, ())
    right = 8 * count * sum(n for k, n in enumerate(each) if mask >> k & 1)
    if what == 1:
        body = b"".join(struct.pack("<d", 1e3 * (i // 6 == i % 6)) for i in range(36))
    else:
        body = bytes(right)
    {at}
    answer(body)
'''


class Speaker(ProgramTest):

    def speaker(self, first="", then="", at=""):
        """Returns "exec:" and the command of a process with these lines inserted before its first line, after its first
        line, and before an answer."""
        path = self.folder / "speaker.py"
        path.write_text(SPEAKER.format(pids=str(self.folder / "pids"), first=first, then=then,
                                       at=textwrap.indent(at, "    ").strip()), encoding="utf-8")
        return f"exec:'{sys.executable}' '{path}'"

    def nothing_left(self):
        pids = [int(line) for line in (self.folder / "pids").read_text("utf-8").split()]
        self.assertTrue(pids)
        end = time.monotonic() + 20
        while any(pathlib.Path(f"/proc/{pid}").exists() for pid in pids):
            self.assertLess(time.monotonic(), end, "a process is left")
            time.sleep(0.05)

    def refuse(self, element, *words):
        self.refused(2, words, "solve", "elastica", "-f", "speaker", "-n", "2", "--element",
                     element, "--time-limit", "2")
