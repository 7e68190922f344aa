"""What an engine must survive: each trial ends in the answers of a run in one piece, or says what
it found. A trial that fails raises Failed with what was there instead."""
import os
import pathlib
import random
import shutil
import signal
import subprocess
import time

from harness.tools.cluster import answers, keeper
from harness.tools.cluster.engine import SECONDS

INCOMPLETE = 5  # exit status: batches are missing
REFUSED = 2
RESTARTS = 40  # of one run until it is complete


class Failed(Exception):
    """What was expected, and what happened."""


class LeftOut(Exception):
    """What the machine does not allow."""


def expect(held, what):
    if not held:
        raise Failed(what)


class Run:
    """What is asked of the program, and how it ends in one piece: hash, exit status, seconds."""

    def __init__(self, program, arguments, folder, environment):
        self.arguments, output, began = arguments, folder / "whole.h5", time.monotonic()
        done = subprocess.run([program, *arguments, "-o", output], env=environment, check=False,
                              text=True, capture_output=True)
        if not output.exists():
            raise SystemExit(f"engines: {' '.join(arguments)}: status {done.returncode}: "
                             f"{done.stderr}")
        self.hash, self.status = answers.hash_of(output), done.returncode
        self.seconds = time.monotonic() - began
        output.unlink()


class Bench:
    """One engine and what it is given: a verification, and a sweep."""

    def __init__(self, engine, program, runs, folder, environment, shards=4):
        self.engine, self.program = engine, pathlib.Path(program)
        self.verification, self.sweep = runs
        self.folder, self.environment, self.shards = folder, environment, shards
        self.complete = folder / "complete"
        self.random = random.Random(engine.name)
        self.kills = 0

    def start(self, into, output, program=None, run=None):
        """The engine's process."""
        environment = {**self.environment, "BEAMWORK": str(program or self.program)}
        with open(self.folder / "log", "w", encoding="utf-8") as log:
            return self.engine.start(self.shards, into, output,
                                     (run or self.verification).arguments, environment, log)

    def run(self, into, output, program=None, run=None):
        """Its status as far as the engine hands it on, and what was said."""
        process = self.start(into, output, program, run)
        code = self.engine.status(process.wait(SECONDS))
        return code, (self.folder / "log").read_text(encoding="utf-8")

    def same(self, output, code, said="", run=None):
        """The answers of the run in one piece, and its status."""
        run = run or self.verification
        expect(code in (run.status, None) and output.exists(),
               f"status {code}, not {run.status}, or no answers: {said[-600:]}")
        found = answers.hash_of(output)
        expect(found == run.hash, f"hash {found[:12]}, in one piece {run.hash[:12]}")

    def complete_copy(self, name):
        """Of the folder that the first trial filled."""
        copy = self.folder / name
        shutil.copytree(self.complete, copy)
        return copy

    def called(self, *arguments, program=None):
        """The program itself."""
        return subprocess.run([program or self.program, *map(str, arguments)], text=True,
                              capture_output=True, check=False, env=self.environment)


def batches(folder):
    return sorted(pathlib.Path(folder).glob("*.batch"))


def started_once(bench):
    """One run: the answers, and each batch there once."""
    output = bench.folder / "once.h5"
    code, said = bench.run(bench.complete, output)
    bench.same(output, code, said)
    left = [p.name for p in bench.complete.iterdir() if p not in batches(bench.complete)]
    expect(not left, f"left behind: {left}")
    expect(len(batches(bench.complete)) >= 2 * bench.shards, "fewer than two batches a shard")


def kill_one(bench):
    """SIGKILL to a process of the program, shard or worker. 0: there is none."""
    those = [p for p in keeper.marked(bench.environment[keeper.MARK])
             if keeper.program_of(p) == str(bench.program)]
    if not those:
        return 0
    try:
        os.kill(bench.random.choice(those), signal.SIGKILL)
    except ProcessLookupError:
        return 0
    return 1


def killed(bench, wanted):
    """Processes killed at random moments; started again until it is complete."""
    rounds = 0
    while bench.kills < wanted:
        rounds += 1
        into, output = bench.folder / f"killed_{rounds}", bench.folder / f"killed_{rounds}.h5"
        for restart in range(RESTARTS):
            process = bench.start(into, output)
            while process.poll() is None:
                time.sleep(bench.random.uniform(0, 0.4 * bench.verification.seconds))
                if bench.kills < wanted:
                    bench.kills += kill_one(bench)
                else:
                    process.wait(SECONDS)
            code = bench.engine.status(process.returncode)
            if output.exists():
                break
            ended = code in (INCOMPLETE, None) or code < 0 or code > 2  # the merge is killed, too
            expect(ended or not batches(into), f"start {restart}: status {code}, not {INCOMPLETE}: "
                   + (bench.folder / "log").read_text()[-600:])
        bench.same(output, code)
        names = [p.name for p in batches(into)]
        expect(names == [p.name for p in batches(bench.complete)], "batches lost or made twice")
        expect(rounds < RESTARTS, "nothing to kill")


def disk_full(bench):
    """No room for all batches: named, nothing half-written; with more room it goes on."""
    into, output = bench.folder / "full", bench.folder / "full.h5"
    into.mkdir()
    size = sum(p.stat().st_size for p in batches(bench.complete))
    most = max(p.stat().st_size for p in batches(bench.complete))
    mount = ["mount", "-t", "tmpfs", "-o", f"size={most + size // 3}", "none", into]
    if subprocess.run(mount, capture_output=True, check=False).returncode != 0:
        raise LeftOut("disk full: mounting needs root")
    code, said = bench.run(into, output)
    expect(code in (INCOMPLETE, None) and not output.exists(),
           f"full: status {code}: {said[-600:]}")
    subprocess.run(["mount", "-o", f"remount,size={4 * size + (1 << 20)}", into], check=True)
    code, said = bench.run(into, output)
    bench.same(output, code, said)


def cut_short(bench):
    """A batch that is cut short or altered is told, and computed again."""
    into, output = bench.complete_copy("cut"), bench.folder / "cut.h5"
    first, second = bench.random.sample(batches(into), 2)
    whole = first.read_bytes()
    first.write_bytes(whole[:bench.random.randrange(len(whole))])
    altered = bytearray(second.read_bytes())
    altered[bench.random.randrange(len(altered) // 2, len(altered))] ^= 1
    second.write_bytes(altered)
    merged = bench.called("merge", into, "-o", output)
    expect(merged.returncode == INCOMPLETE and first.name in merged.stderr
           and second.name in merged.stderr and not output.exists(),
           f"merge: status {merged.returncode}: {merged.stderr[-600:]}")
    code, said = bench.run(into, output)
    bench.same(output, code, said)


def foreign(bench):
    """A batch of another run: refused by name; nothing is taken away; without it all is well."""
    into, output, elsewhere = (bench.complete_copy("mixed"), bench.folder / "mixed.h5",
                               bench.folder / "elsewhere")
    made = bench.called(*bench.sweep.arguments, "--shard", "1/1", "--into", elsewhere)
    expect(made.returncode == 0, f"the other run: {made.stderr[-300:]}")
    stranger = into / batches(elsewhere)[0].name
    shutil.copy(batches(elsewhere)[0], stranger)
    bench.random.choice([p for p in batches(into) if p != stranger]).unlink()
    code, said = bench.run(into, output)
    expect(code in (REFUSED, None) and not output.exists() and str(into) in said,
           f"status {code}: {said[-600:]}")
    stranger.unlink()
    code, said = bench.run(into, output)
    bench.same(output, code, said)


def two_folders(bench):
    """Two folders that share some batches: each counts once."""
    one, two = bench.complete_copy("one"), bench.complete_copy("two")
    names = [p.name for p in batches(one)]
    bench.random.shuffle(names)
    third = max(1, len(names) // 3)
    for name in names[:third]:
        (one / name).unlink()
    output = bench.folder / "both.h5"
    for name in names[-third:]:
        (two / name).unlink()
    lacking = bench.called("merge", two, "-o", output)
    expect(lacking.returncode == INCOMPLETE and not output.exists(), f"one: {lacking.stderr}")
    both = bench.called("merge", one, two, "-o", output)
    bench.same(output, both.returncode, both.stderr)


def another_build(bench):
    """A program that was built of other sources: refused, and the folder stays as it was."""
    into, output = bench.complete_copy("built"), bench.folder / "built.h5"
    batches(into)[0].unlink()
    before = [(p.name, p.read_bytes()) for p in batches(into)]
    stranger = bench.folder / "another"
    said = bench.called("--version").stdout
    commit = said[said.index("(") + 1:said.index(")")].encode()
    whole = bench.program.read_bytes()
    expect(len(commit) > 6 and commit in whole, f"the program does not say its commit: {said}")
    stranger.write_bytes(whole.replace(commit, b"0" * len(commit)))
    stranger.chmod(0o755)
    code, said = bench.run(into, output, program=stranger)
    expect(code in (REFUSED, None) and not output.exists(), f"status {code}: {said[-600:]}")
    expect(before == [(p.name, p.read_bytes()) for p in batches(into)], "the folder was changed")
    code, said = bench.run(into, output)
    bench.same(output, code, said)


def swept(bench):
    """A sweep over parameters."""
    output = bench.folder / "swept.h5"
    code, said = bench.run(bench.folder / "swept", output, run=bench.sweep)
    bench.same(output, code, said, run=bench.sweep)


ALL = [started_once, swept, killed, disk_full, cut_short, foreign, two_folders, another_build]
