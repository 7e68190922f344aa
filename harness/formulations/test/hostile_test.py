"""Malicious or faulty processes. Each of them must lead to one line that names the formulation and the failure, in
`solve` and in every run of `verify`. No process may remain."""
import json
import textwrap

from harness.formulations.test.speaker import Speaker
from harness.tools.kit.program import ROOT, run


class Refused(Speaker):
    def test_no_such_command(self):
        self.refuse("exec:/no/such/command at all", "/no/such/command", "No such file")
        self.refuse(f"exec:{ROOT / 'README.md'}", "README.md", "Permission denied")

    def test_no_command(self):
        self.refuse("exec:", "no command is given")
        self.refuse("exec:  ", "no command is given")
        self.refuse("exec:''", "no command is given")
        self.refuse("exec:python3 'my beam.py", "a quotation mark is not closed")
        self.refuse("exec:" + 70 * "a ", "too many words")

    def test_rubbish(self):
        self.refuse(self.speaker(first="write(b'hello\\x07, world\\n')"), "hello., world", "JSON")
        self.refuse(self.speaker(first="write(bytes(range(256)) * 300)\ntime.sleep(60)"), "JSON")
        self.refuse(self.speaker(first="said = [1, 2]"), "[1, 2]", "JSON")
        self.refuse("exec:yes", "began with 'y'")
        self.nothing_left()

    def test_other_protocol(self):
        self.refuse(self.speaker(first="said['beamwork'] = 7"), "uses protocol 7, but this program uses protocol 1")
        self.refuse(self.speaker(first="del said['beamwork']"), "protocol")

    def test_says_too_little_or_too_much(self):
        for line, word in (("del said['name']", "'name'"), ("said['name'] = 'A b'", "'name'"),
                           ("said['summary'] = 'a\\nb'", "'summary'"),
                           ("said['strains'] = 1000", "1 to 56"),
                           ("del said['strains']", "1 to 56"),
                           ("said['nodes'] = 9", "2 to 8"), ("said['places'] = [0, 0.5, 1]", "one number for each node"),
                           ("said.update(nodes=3, places=[0, 1, 1])", "increase from 0"),
                           ("said.update(nodes=4, places=[0, 0.01, 0.02, 1])", "Gauss-Lobatto"), ("said['gives'] = 'all'", "'gives'"),
                           ("said['offers'] = ['magic']", "'magic'"), ("del said['offers']", "a list of the supported physics"),
                           ("said['order'] = dict(statics=[4, 2])", "'order'"),
                           ("said['colour'] = 1", "'colour'"),
                           ("said['options'] = [dict(name='k', default=3, min=0, max=1)]", "'k'"),
                           ("said['options'] = [dict(name='k', choices=['a'], default='b')]",
                            "'k'"),
                           ("said['name'] = 'collocation'", "already exists")):
            self.refuse(self.speaker(first=line), word)

    def test_list(self):
        for line, word in (("said.update(nodes=3, places=[0, 1, 1])", "increase from 0"),
                           ("del said['offers']", "a list of the supported physics")):
            self.refused(2, word, "list", "speaker", "--element", self.speaker(first=line))

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
        self.refuse(self.speaker(at="answer(b'no sections\\nof wood', 3); continue"),
                    "formulation speaker: no sections.of wood")


class Evaluated(Speaker):
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
        self.one_line(["bytes instead of"], "answer(body[8:]); continue")
        self.one_line(["bytes instead of"], "answer(body + body); continue")
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
        self.assertIn("NaN or Inf", done.stderr)

    def test_refuses_a_state(self):
        self.one_line(["too far"], "answer(b'too far', 3); continue")

    def test_others_go_on(self):
        element = self.speaker(at="if what == 2: os._exit(7)")
        self.answered("verify", "-f", "speaker", "-f", "collocation", "--element", element, "-k",
                      "elastica/default", "-j", "2", code=1)
