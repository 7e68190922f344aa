"""What needs no engine: scripts stay short and say how they are used, engines that are missing are
skipped by name, marked processes end with whoever started them, and hashes tell answers from times.
The engines themselves are run by `make engines`."""
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import textwrap
import time
import unittest

import h5py
import numpy as np

from harness.tools.cluster import answers, engine, engines, keeper
from harness.tools.kit.program import PROGRAM, ROOT, ProgramTest, run

MOST_LINES = 20


class Scripts(ProgramTest):

    def test_they_are_short_and_say_how_they_are_used(self):
        self.assertEqual(len(engine.ENGINES), 4)
        for one in engine.ENGINES:
            lines = one.script.read_text(encoding="utf-8").splitlines()
            self.assertLessEqual(len(lines), MOST_LINES, one.script)
            self.assertTrue(any(line.startswith("# usage: ") for line in lines), one.script)

    def test_shell_scripts_are_refused_nothing_by_the_shell(self):
        for one in engine.ENGINES:
            if one.script.suffix == ".sh":
                self.assertTrue(os.access(one.script, os.X_OK), one.script)
                self.assertEqual(run("-n", one.script, program="sh").returncode, 0, one.script)

    def test_arguments_with_spaces_reach_the_program(self):
        """By a stand-in for GNU parallel that calls what it is told for each line it reads."""
        (self.folder / "parallel").write_text(textwrap.dedent("""\
            #!/usr/bin/python3
            import subprocess, sys
            for line in sys.stdin:
                words = [word.replace("{}", line.strip()) for word in sys.argv[2:]]
                subprocess.run(words, check=True)
            """), encoding="utf-8")
        (self.folder / "program").write_text(
            '#!/bin/sh\nfor word; do printf "<%s>" "$word"; done\necho\n', encoding="utf-8")
        for name in ("parallel", "program"):
            (self.folder / name).chmod(0o755)
        into = str(self.folder / "some batches")
        done = run("2", into, "out.h5", "verify", "-k", "a or b",
                   program=engine.HERE / "parallel.sh",
                   env={**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}",
                        "BEAMWORK": str(self.folder / "program")})
        self.assertEqual(done.stdout.splitlines(), [
            f"<verify><-k><a or b><--shard><1/2><--into><{into}>",
            f"<verify><-k><a or b><--shard><2/2><--into><{into}>",
            f"<merge><{into}><-o><out.h5>"], done.stderr)


class Missing(ProgramTest):

    def test_what_is_not_installed_is_skipped_by_name(self):
        nothing = self.folder / "bin"
        nothing.mkdir()
        script = "from harness.tools.cluster import engine, engines; engine.PATHS = r'%s'; " \
                 "raise SystemExit(engines.main())" % nothing
        done = run("-B", "-c", script, PROGRAM, program=sys.executable, cwd=ROOT)
        lines = done.stdout.splitlines()
        self.assertEqual(done.returncode, 0, done.stderr)
        for line, one in zip(lines, engine.ENGINES):
            self.assertTrue(line.startswith(one.name), line)
            self.assertIn(f"skipped: {one.commands[0]} is not installed (apt install "
                          f"{one.packages})", line)
        self.assertEqual(lines[-1], "0 passed, 0 failed, 4 skipped")

    def test_an_engine_that_there_is_not(self):
        done = run("-B", "-m", "harness.tools.cluster.engines", PROGRAM, "abacus",
                   program=sys.executable, cwd=ROOT)
        self.assertEqual(done.returncode, 2)
        self.assertIn("no engine is called 'abacus'", done.stderr)


class Kept(ProgramTest):

    def left_after(self, end):
        """Marked processes and the folder, once a program with two of them was ended."""
        script = textwrap.dedent("""\
            import subprocess, sys, time
            from harness.tools.cluster import engines
            with engines.kept_folder() as (folder, environment):
                stubborn = "trap '' TERM; sleep 601 & wait; sleep 602"
                for command in (["sleep", "600"], ["setsid", "sh", "-c", stubborn]):
                    subprocess.Popen(command, env=environment)
                print(folder, flush=True)
                sys.stdin.read()
            """)
        with subprocess.Popen([sys.executable, "-B", "-c", script], cwd=ROOT, text=True,
                              stdin=subprocess.PIPE, stdout=subprocess.PIPE) as holder:
            folder = holder.stdout.readline().strip()
            for _ in range(100):
                if len(keeper.marked(folder)) >= 3:
                    break
                time.sleep(0.1)
            self.assertGreaterEqual(len(keeper.marked(folder)), 3)
            end(holder)
        for _ in range(200):
            if not pathlib.Path(folder).exists() and not keeper.marked(folder):
                return []
            time.sleep(0.1)
        return [folder, *keeper.marked(folder)]

    def test_nothing_is_left_whatever_happens(self):
        self.assertEqual(self.left_after(lambda holder: holder.stdin.close()), [])
        self.assertEqual(self.left_after(lambda holder: holder.send_signal(signal.SIGKILL)), [])


class Hash(ProgramTest):

    def write(self, name, value, seconds):
        path = self.folder / name
        table = np.array([(value, seconds)], [("value", "f8"), ("seconds_solve", "f8")])
        with h5py.File(path, "w") as file:
            file["cases/a/cells"] = table
            file["seconds"] = np.array([seconds])
            file.attrs["clock"] = str(seconds)
            file.attrs["plan"] = "p"
        return answers.hash_of(path)

    def test_answers_count_and_times_do_not(self):
        first = self.write("a.h5", 1.0, 2.0)
        self.assertEqual(first, self.write("b.h5", 1.0, 3.0))
        self.assertNotEqual(first, self.write("c.h5", np.nextafter(1.0, 2), 2.0))

    def test_a_run_has_one(self):
        for name, jobs in (("one.h5", 1), ("two.h5", 2)):
            self.answered("verify", "-k", "elastica/default", "-j", jobs, "-o", self.folder / name)
        shutil.copy(self.folder / "one.h5", self.folder / "copy.h5")
        hashes = {answers.hash_of(self.folder / f"{name}.h5") for name in ("one", "two", "copy")}
        self.assertEqual(len(hashes), 1)


if __name__ == "__main__":
    unittest.main()
