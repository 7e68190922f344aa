"""Runs the shell loop of the README as written: a run in shards is started, restarted and merged."""
import os
import pathlib
import re
import subprocess

from harness.tools.kit.program import PROGRAM, ProgramTest

README = pathlib.Path(__file__).parents[1] / "README.md"


class Loop(ProgramTest):
    def shell(self, text, code=0):
        places = f"{pathlib.Path(PROGRAM).parent}:{os.environ['PATH']}"
        done = subprocess.run(["sh", "-c", text], cwd=self.folder, capture_output=True, text=True,
                              check=False, env=os.environ | {"PATH": places})
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def hash_of(self, name):
        return self.answered("compare", "--hash", self.folder / name).stdout.split()[:2]

    def test_as_one_run(self):
        loop, merge = re.search(r"```sh\n(N=4\nfor .*done\n)(.*)```", README.read_text("utf-8"),
                                re.DOTALL).groups()
        merge = merge.partition("\n")[0]
        self.shell(loop)
        parts = sorted((self.folder / "parts").iterdir())
        self.assertGreater(len(parts), 1)
        parts[0].unlink()
        self.assertIn("missing", self.shell(merge, code=5).stderr)
        self.assertEqual(self.shell(loop).stdout.count(" 1 computed now"), 1)
        self.shell(merge)
        self.shell(re.search("beamwork verify -k [a-z]+", loop)[0] + " -o alone.h5")
        self.assertEqual(self.hash_of("results.h5"), self.hash_of("alone.h5"))
