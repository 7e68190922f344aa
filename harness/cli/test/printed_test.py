"""Commands that the program prints are run as they stand: with elements, scenes, and names that need quotes."""
import re
import shlex
import subprocess
import unittest

from harness.tools.kit.program import PROGRAM, ROOT, ProgramTest, environment, run

EXAMPLE = (ROOT / "elements" / "examples" / "timoshenko.c").read_text(encoding="utf-8")
SCENE = (ROOT / "cases" / "examples" / "euler_column.yaml").read_text(encoding="utf-8")
BENDING = "c->young * c->I"


def commands(text):
    """Lines that begin with the program's name, continued ones joined."""
    return re.findall(r"(?:^ *|: )(beamwork (?!\w+: )[^;\n]+)", re.sub(r" \\\n *", " ", text), re.MULTILINE)


class Printed(ProgramTest):
    def setUp(self):
        super().setUp()
        self.element = self.folder / "my element's.so"
        source = self.folder / "mine.c"
        source.write_text(EXAMPLE.replace(BENDING, "1.1 * " + BENDING).replace("energy += d", "energy += 1.01 * d"),
                          encoding="utf-8")
        subprocess.run(["cc", "-O2", "-shared", "-fPIC", "-I", ROOT, source, "-o", self.element], check=True)
        self.scene = self.folder / "a very long name of a scene, in which one asks for quotes' quotes.yaml"
        self.scene.write_text(SCENE, encoding="utf-8")

    def run_all(self, text, least, *words):
        found = commands(text)
        self.assertGreaterEqual(len(found), least, text)
        for command in found:
            for word in words:
                self.assertIn(str(word), shlex.split(command), command)
            done = subprocess.run(command.replace("beamwork", shlex.quote(PROGRAM), 1), shell=True, text=True, check=False,
                                  cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment())
            self.assertIn(done.returncode, (0, 1), (command, done.stderr))
            self.assertNotEqual(done.stdout, "", command)

    def test_verify(self):
        own = ("--element", self.element)
        self.run_all(run("verify", *own, "-k", "=elastica and default or =tapered_cantilever").stdout, 3, self.element)
        out = run("verify", *own, "-f", "timoshenko", "--scene", self.scene).stdout
        self.run_all(out[out.find(" 1. "):], 1, self.element, self.scene)
        self.assertIn("beamwork element-test", out)

    def test_sweep(self):
        for of in (("elastica", "--vary", "load=1,5"), ("--scene", self.scene, "--vary", "length=1,2")):
            done = self.answered("sweep", *of, "--element", self.element, "-f", "timoshenko", "-n", "2")
            self.run_all(done.stdout, 1, self.element)

    def test_what_is_shown_by(self):
        """Hints with the name of a file, to be copied from between their quotes."""
        for words in (("solve", "--scene", self.scene, "--set", "foo=1"), ("sweep", "--scene", self.scene),
                      ("sweep", "--scene", self.scene, "--vary", "foo")):
            hint = re.search(r"'(beamwork list .*)' shows", self.refused_line(*words))
            self.run_all(hint[1], 1, self.scene)
        hint = re.search(r"'(beamwork merge .*) -o FILE'", self.refused_line(
            "verify", "-k", "=elastica and =default and =beamw", "--into", "a folder", "-o", "r.h5"))
        self.assertEqual(shlex.split(hint[1]), ["beamwork", "merge", "a folder"])

    def refused_line(self, *words):
        done = run(*words)
        self.assertEqual(done.returncode, 2, done)
        return done.stderr

    def test_explain(self):
        for word in ("elastica", "beamw"):
            out = self.answered("explain", word).stdout
            self.run_all(out.replace("; beamwork", "\nbeamwork"), 1 if word == "elastica" else 0)


if __name__ == "__main__":
    unittest.main()
