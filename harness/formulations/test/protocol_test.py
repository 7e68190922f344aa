"""The page on the protocol must agree with the program. A client written in another language from the page alone
must compute the results of timoshenko.c within 1e-7."""
import re
import shutil
import struct
import sys
import unittest

from harness.cli.test.plugin import EXAMPLES, compile_shared
from harness.tools.kit.program import ROOT, ProgramTest

PAGE = (ROOT / "harness" / "formulations" / "protocol.md").read_text(encoding="utf-8")
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.M | re.S)
BYTES = re.compile(r"^((?:[0-9a-f]{2} ){7}[0-9a-f]{2})  ", re.M)
RECTANGLE = """
beamwork: 1
sections:
  bar: {rectangle: {width: 0.2, thickness: 0.1}, young: 3e9, shear_modulus: 1e9, density: 700}
nodes:
  wall: {at: [0, 0, 0], hold: all}
  tip: {at: [0, 2, 0]}
members:
  bar: {from: wall, to: tip, section: bar, y: [0, 0, 1]}
loads:
  push: {force: [0, 0, 1], on: tip}
analyses:
  bent: {linear: {}}
quantities:
  tip: {displacement: {analysis: bent, node: tip, component: uz}, unit: m}
"""


class Client(ProgramTest):

    def setUp(self):
        super().setUp()
        code, = (body for kind, body in BLOCK.findall(PAGE) if kind == "python")
        client = self.folder / "client.py"
        client.write_text(code, encoding="utf-8")
        self.command = f"'{sys.executable}' -I '{client}'"

    def values(self, case, name, element, *options):
        record = self.record("solve", *case, "-f", name + "".join(options), "--element", element)
        return [q["value"] for q in record["quantities"] if q["value"] is not None]

    def like_timoshenko(self, name, command, *cases):
        there = compile_shared(EXAMPLES / "timoshenko.c", self.folder / "there.so")
        for case in cases:
            found = self.values([case, "-n", "2"], name, f"exec:{command}")
            expected = self.values([case, "-n", "2"], "timoshenko", there)
            for one, same in zip(found, expected, strict=True):
                self.assertAlmostEqual(one / same, 1, delta=1e-7, msg=case)

    def recorded(self, *case):
        script = self.folder / "record.sh"
        script.write_text(f"cd '{self.folder}'\ntee requests.bin | {self.command} | tee answers.bin\n",
                          encoding="utf-8")
        self.values(case, "plain", f"exec:sh '{script}'")
        return [(self.folder / name).read_bytes() for name in ("requests.bin", "answers.bin")]

    def test_client_of_the_page(self):
        self.like_timoshenko("plain", self.command, "elastica", "bend_45", "tapered_cantilever")

    @unittest.skipIf(shutil.which("perl") is None, "needs perl")
    def test_client_from_the_page(self):
        script = ROOT / "harness" / "formulations" / "test" / "client.pl"
        command = f"perl '{script}'"
        self.like_timoshenko("perl_beam", command, "elastica", "bend_45", "deep_beam")
        case = ["bend_45", "-n", "1"]
        self.assertNotEqual(self.values(case, "perl_beam", f"exec:{command}", ":torsion=2"),
                            self.values(case, "perl_beam", f"exec:{command}"))

    def test_bytes(self):
        requests, answers = self.recorded("elastica", "-n", "2")
        shown = [bytes.fromhex("".join(BYTES.findall(body))) for _, body in BLOCK.findall(PAGE)
                 if BYTES.search(body)]
        self.assertEqual([len(part) for part in shown], [72, 24, 56])
        self.assertEqual(requests[:72], shown[0])
        size, = struct.unpack_from("<q", requests, 32)
        self.assertEqual(requests[40 + size:][:56], shown[2])
        answers = answers.partition(b"\n")[2]
        self.assertEqual(answers[:24], shown[1])
        self.assertEqual(struct.unpack_from("<qq", answers, 24 + 288 + 8), (0, 96))

    def test_section(self):
        scene = self.folder / "bar.yaml"
        scene.write_text(RECTANGLE, encoding="utf-8")
        requests, _ = self.recorded("--scene", scene, "-n", "1")
        section = struct.unpack_from("<111d", requests, 40 + 80)
        along_z, along_y = 0.2, 0.1
        area = along_y * along_z
        expected = {0: 3e9, 1: 1e9, 2: 700, 3: area, 4: along_y * along_z**3 / 12,
                    5: along_z * along_y**3 / 12, 10: area * (along_y**2 + along_z**2) / 12,
                    14: area * 5 / 6, 18: area * 5 / 6, 23: 1.2 / area, 27: 1.2 / area, 35: 0,
                    108: 1, 109: along_z, 110: along_y}
        for position, value in expected.items():
            self.assertAlmostEqual(section[position], value, delta=1e-9 * abs(value), msg=position)
        size, = struct.unpack_from("<q", requests, 32)
        strain = 40 + size + 40 + 8
        nodes = struct.unpack_from("<32d", requests, strain)
        self.assertEqual(nodes[16:19], (0, 2, 0))
        self.assertEqual([nodes[6 + 3 * i] for i in range(3)], [0, 1, 0], "axis x along the element")
        self.assertEqual([nodes[7 + 3 * i] for i in range(3)], [0, 0, 1], "axis y as the scene gives it")
