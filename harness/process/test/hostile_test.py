"""Processes that mean harm, or are wrong: each ends as one line that names the formulation and what
happened, in `solve` and in every cell of `verify`; nothing of them is left."""
import json
import os
import pathlib
import sys
import textwrap
import time

from harness.test.program import ROOT, ProgramTest, run

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
        """exec: of a process with these lines before its first line, behind it, before an
        answer."""
        path = self.folder / "speaker.py"
        path.write_text(SPEAKER.format(pids=str(self.folder / "pids"), first=first, then=then,
                                       at=textwrap.indent(at, "    ").strip()), encoding="utf-8")
        return f"exec:'{sys.executable}' '{path}'"

    def nothing_left(self):
        """Every process that was started is gone, within a moment."""
        pids = [int(line) for line in (self.folder / "pids").read_text("utf-8").split()]
        self.assertTrue(pids)
        end = time.monotonic() + 20
        while any(pathlib.Path(f"/proc/{pid}").exists() for pid in pids):
            self.assertLess(time.monotonic(), end, "a process is left")
            time.sleep(0.05)

    def refuse(self, element, *words):
        self.refused(2, words, "solve", "elastica", "-f", "speaker", "-n", "2", "--element",
                     element, "--time-limit", "2")


class Refused(Speaker):
    """Before there is a formulation: status 2."""

    def test_no_such_command(self):
        self.refuse("exec:/no/such/command at all", "/no/such/command", "No such file")
        self.refuse(f"exec:{ROOT / 'README.md'}", "README.md", "Permission denied")

    def test_no_command(self):
        self.refuse("exec:", "there is no command")
        self.refuse("exec:  ", "there is no command")
        self.refuse("exec:''", "there is no command")
        self.refuse("exec:python3 'my beam.py", "a quote does not end")
        self.refuse("exec:" + 70 * "a ", "too many words")

    def test_rubbish(self):
        self.refuse(self.speaker(first="write(b'hello\\x07, world\\n')"), "hello., world", "JSON")
        self.refuse(self.speaker(first="write(bytes(range(256)) * 300)\ntime.sleep(60)"), "JSON")
        self.refuse(self.speaker(first="said = [1, 2]"), "[1, 2]", "JSON")
        self.refuse("exec:yes", "began with 'y'")
        self.nothing_left()

    def test_other_protocol(self):
        self.refuse(self.speaker(first="said['beamwork'] = 7"), "speaks protocol 7, this program 1")
        self.refuse(self.speaker(first="del said['beamwork']"), "protocol")

    def test_says_too_little_or_too_much(self):
        for line, word in (("del said['name']", "'name'"), ("said['name'] = 'A b'", "'name'"),
                           ("said['summary'] = 'a\\nb'", "'summary'"),
                           ("said['strains'] = 1000", "1 to 24"),
                           ("del said['strains']", "1 to 24"),
                           ("said['nodes'] = 4", "2 to 3"), ("said['gives'] = 'all'", "'gives'"),
                           ("said['offers'] = ['magic']", "'magic'"),
                           ("said['order'] = dict(statics=[4, 2])", "'order'"),
                           ("said['colour'] = 1", "'colour'"),
                           ("said['options'] = [dict(name='k', default=3, min=0, max=1)]", "'k'"),
                           ("said['options'] = [dict(name='k', choices=['a'], default='b')]",
                            "'k'"),
                           ("said['name'] = 'collocation'", "is there already")):
            self.refuse(self.speaker(first=line), word)

    def test_ends_before_it_speaks(self):
        self.refuse(self.speaker(first="sys.exit(3)"), "ended with status 3 before its first line")
        self.refuse(self.speaker(first="os.kill(os.getpid(), signal.SIGKILL)"), "signal 9")

    def test_never_speaks(self):
        self.refuse(self.speaker(first="time.sleep(600)"), "did not answer within 2 s")
        self.nothing_left()

    def test_speaks_on(self):
        self.refuse(self.speaker(first="write(json.dumps(said).encode() + b'\\nmore\\n')"),
                    "more than an answer", "standard error")

    def test_own_words(self):
        """What it refuses of a beam is told as it says it."""
        self.refuse(self.speaker(at="answer(b'no sections\\nof wood', 3); continue"),
                    "formulation speaker: no sections.of wood")


class Evaluated(Speaker):
    """In the middle of a solution: status 1, and the reason of a cell."""

    def one_line(self, words, at, what=2):
        element = self.speaker(at=f"if what == {what}:\n" + textwrap.indent(at, "    "))
        done = run("solve", "elastica", "-f", "speaker", "-n", "2", "--element", element,
                   "--time-limit", "2")
        self.assertEqual(done.returncode, 1, done)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        for word in ("formulation speaker", *words):
            self.assertIn(word, done.stderr)
        self.cell(element, words)
        self.nothing_left()

    def cell(self, element, words):
        record = self.folder / "v.json"
        run("verify", "-f", "speaker", "--element", element, "-k", "elastica/default", "--json",
            record, "--time-limit", "2", "-j", "2")
        found = json.loads(record.read_text(encoding="utf-8"))["verdicts"]
        reasons = {v["reason"] for v in found if v["verdict"] == "diverged"}
        self.assertTrue(reasons, found)
        for word in words if "did not" not in words[0] else ["time limit"]:
            self.assertTrue(all(word in reason for reason in reasons), reasons)

    def test_crash(self):
        self.one_line(["signal 11"], "os.kill(os.getpid(), signal.SIGSEGV)")

    def test_death(self):
        self.one_line(["ended with status 7"], "os._exit(7)")

    def test_death_while_it_learns(self):
        self.one_line(["ended with status 7"], "os._exit(7)", what=1)

    def test_closes_its_input(self):
        self.one_line(["gave no answer"], "os.close(0); answer(body); time.sleep(0.2); os._exit(5)")

    def test_endless(self):
        self.one_line(["did not"], "while True: pass")

    def test_half_an_answer(self):
        self.one_line(["in the middle of an answer"],
                      "write(struct.pack('<8sqq', b'beamwork', 0, len(body)) + body[:-8])\n"
                      "os._exit(0)")
        self.one_line(["in the middle of an answer"], "write(b'beamwo'); os._exit(0)")

    def test_half_an_answer_and_no_more(self):
        self.one_line(["did not"], "write(struct.pack('<8sqq', b'beamwork', 0, len(body)))\n"
                      "time.sleep(600)")

    def test_wrong_sizes(self):
        self.one_line(["bytes where", "were asked for"], "answer(body[8:]); continue")
        self.one_line(["bytes where", "were asked for"], "answer(body + body); continue")
        self.one_line(["outcome"], "answer(b'', 9); continue")
        self.one_line(["outcome"], "write(struct.pack('<8sqq', b'beamwork', 0, -8)); continue")

    def test_more_than_an_answer(self):
        self.one_line(["more than an answer"], "body += bytes(8)\nwrite(struct.pack('<8sqq', "
                      "b'beamwork', 0, len(body) - 8) + body); continue")

    def test_text_on_standard_output(self):
        self.one_line(["wrote 'here I am", "standard error"], "print('here I am', flush=True)")

    def test_not_a_number(self):
        element = self.speaker(
            at="if what == 2: body = right // 8 * struct.pack('<d', float('nan'))")
        done = run("solve", "elastica", "-f", "speaker", "-n", "2", "--element", element)
        self.assertEqual(done.returncode, 1, done)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        self.assertIn("no number", done.stderr)

    def test_refuses_a_state(self):
        self.one_line(["too far"], "answer(b'too far', 3); continue")

    def test_others_go_on(self):
        """A crash in every cell takes nothing from the cells of others."""
        element = self.speaker(at="if what == 2: os._exit(7)")
        self.answered("verify", "-f", "speaker", "-f", "collocation", "--element", element, "-k",
                      "elastica/default", "-j", "2")


class InPython(Speaker):
    """What the module for authors makes of mistakes."""

    def example(self, before, after):
        text = (ROOT / "elements/examples/timoshenko.py").read_text(encoding="utf-8")
        self.assertIn(before, text)
        path = self.folder / "mine.py"
        path.write_text(text.replace(before, after, 1), encoding="utf-8")
        return f"exec:'{sys.executable}' '{path}'"

    def solve(self, element):
        path = str(ROOT / "elements" / "examples")
        return run("solve", "elastica", "-f", "timoshenko_py", "-n", "2", "--element", element,
                   env={**os.environ, "PYTHONPATH": path})

    def test_exception(self):
        done = self.solve(self.example("chord = (", "chord = 1 / 0 + ("))
        self.assertEqual(done.returncode, 1, done)
        self.assertRegex(done.stderr,
                         r"^beamwork: .*timoshenko_py: ZeroDivisionError: .*mine.py:\d+")
        self.assertEqual(len(done.stderr.splitlines()), 1)

    def test_refusal(self):
        done = self.solve(self.example("    c, l = kind",
                                       "    from beamwork_element import Refused\n"
                                       "    raise Refused('only steel')\n    c, l = kind"))
        self.assertEqual(done.returncode, 2, done)
        self.assertIn("timoshenko_py: only steel\n", done.stderr)

    def test_print(self):
        """It is seen, and harms nothing."""
        done = self.solve(self.example("    chord = (", "    print('hello')\n    chord = ("))
        self.assertEqual(done.returncode, 0, done)
        self.assertIn("hello", done.stderr)

    def told(self, before, after, *words, code=1):
        """The example with that change fails and says so."""
        done = self.solve(self.example(before, after))
        self.assertEqual(done.returncode, code, done)
        for word in words:
            self.assertIn(word, done.stderr)
        return done

    def test_wrong_shapes(self):
        """A sentence with both shapes, and no line of the module or of numpy."""
        back = "return np.hstack([e - [kind.length, 0, 0], kind.length * psi])"
        due = "strains=6 wants (N, 6)"
        for after, words in ((f"{back}[:, :5]", ("strain returned (N, 5)", due)),
                             (f"{back}.T", ("strain returned (6, ", due)),
                             (f"{back}[0]", ("strain returned (6)", due)),
                             ("return 0.0", ("strain returned one number", due)),
                             (f"{back}[:1]", ("strain returned (1, 6)", due)),
                             ("return None", ("strain returned None",)),
                             ("return 'long'", ("strain returned numbers of type <U4",)),
                             ("return [[1], [1, 2]]", ("strain: an array is due",)),
                             (f"{back} + 0j", ("complex128", "real numbers of real states"))):
            done = self.told(back, after, "timoshenko_py: ", *words)
            self.assertNotIn(".py:", done.stderr)
        self.told("strains=6", "strains=5", "prepare returned (6, 6), strains=5 wants (5, 5)",
                  code=2)

    def stress(self, back):
        """What is told of the example with this stress in place of a constant stiffness."""
        text = (ROOT / "elements/examples/timoshenko.py").read_text(encoding="utf-8")
        text = text.replace("    return np.diag(", "    kind.C = np.diag(").replace(
            "serve(prepare, strain,", f"def stress(kind, e):\n"
            f"    s = e @ kind.C\n    w = (s * e).sum(1) / 2\n    {back}\n\n\n"
            "serve(prepare, strain, stress,")
        (self.folder / "mine.py").write_text(text, encoding="utf-8")
        return self.solve(f"exec:'{sys.executable}' '{self.folder / 'mine.py'}'")

    def test_wrong_stresses(self):
        right = "np.broadcast_to(kind.C, (len(e), 6, 6))"
        self.assertEqual(self.stress(f"return w, s, {right}").returncode, 0)
        for back, words in ((f"return w.sum(), s, {right}", "for energy, returned one number"),
                            (f"return w[:, None], s, {right}", "for energy, returned (N, 1)"),
                            (f"return w, s[:1], {right}", "for sigma, returned (1, 6)"),
                            ("return w, s, kind.C", "for C, returned (6, 6)"),
                            ("return w", "stress must return three: energy, sigma, C")):
            done = self.stress(back)
            self.assertEqual(done.returncode, 1, done)
            self.assertIn(words, done.stderr)

    def test_ends_itself(self):
        self.told("    chord = (", "    raise SystemExit('enough')\n    chord = (",
                  "SystemExit: enough (mine.py:")

    def test_a_word_that_is_none(self):
        self.told("strains=6", "strain=6", "strain=6 is no function, did you mean strains?",
                  code=2)
        self.told("summary=", "sumary=", "is no key, did you mean summary?", code=2)
        self.told('offers=["shear"', 'offers=["sheer"', "'sheer'", "trapeze, wagner moments",
                  code=2)

    def test_not_analytic(self):
        """Also where value and derivative are right in the undeformed state."""
        self.told("np.sqrt((psi * psi).sum(1))", "np.linalg.norm(psi, axis=1)",
                  "strain is not analytic", "gives='e'")

    def test_no_words_of_numpy(self):
        """States that are no numbers are asked too; what comes of them is no warning."""
        element = self.example("chord = (", "np.float64(0) / np.zeros(1)\n    chord = (")
        done = self.solve(element)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done)

    def contract(self, before, after):
        path = str(ROOT / "elements" / "examples")
        done = run("element-test", "timoshenko_py", "--element", self.example(before, after),
                   env={**os.environ, "PYTHONPATH": path})
        self.assertEqual(done.returncode, 1, done)
        return " ".join(done.stdout.partition("measured:")[0].split())

    def test_one_cause_in_the_contract(self):
        """What fails always is told as the cause of each family, and as nothing else."""
        out = self.contract("chord = (", "chord = 1 / 0 + (")
        self.assertRegex(out, r"derivatives of the strains \(1 compared\) ✘ formulation "
                              r"timoshenko_py: ZeroDivisionError: division by zero "
                              r"\(mine.py:\d+\); the rest is not checked")
        self.assertNotIn("nan", out)
        self.assertNotIn("crashed", out)

    def test_fails_for_some(self):
        """An element that cannot be made again is told; what stood there before is used."""
        out = self.contract(
            "    chord = (", "    longer = prepare.__dict__.setdefault('longer', set())\n"
            "    if kind.length > 0.4:\n        longer.add(id(kind))\n"
            "    if kind.length > 0.4 and len(longer) > 1:\n        raise ValueError('too long')\n"
            "    chord = (")
        self.assertIn("refused when it is made again: formulation timoshenko_py: ValueError: too "
                      "long (mine.py:", out)
        self.assertNotIn("crashed", out)

    def test_finds_the_module(self):
        """From an empty folder, also behind a PYTHONPATH of the user's."""
        element = self.example("strains=6", "strains=6")
        for given in ({}, {"PYTHONPATH": ""}, {"PYTHONPATH": "/no/such"}):
            clean = {name: v for name, v in os.environ.items() if name != "PYTHONPATH"}
            done = run("solve", "elastica", "-f", "timoshenko_py", "-n", "2", "--element", element,
                       cwd=self.folder, env={**clean, **given})
            self.assertEqual(done.returncode, 0, done)
