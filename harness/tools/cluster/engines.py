"""Runs every engine of this folder for real and asks of it what trials.py says (`make engines`).

A line for each: passed with the hashes of its answers, FAILED, or skipped by name; then how many.
Installs nothing. Whatever happens, no process and no folder of it is left (keeper.py).
usage: python3 -m harness.tools.cluster.engines PROGRAM [-o FILE.json] [--kills N] [ENGINE...]
"""
import argparse
import contextlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

from harness.tools.cluster import keeper, trials
from harness.tools.cluster.engine import ENGINES

# Some seconds of the processor each, eight batches or more.
RUNS = (["verify", "-k",
         "c_column/default or bend_45 or sheet_cantilever/default or lee_frame/default"],
        ["sweep", "snap_through", "--vary", "angle=0.1..0.6/299", "-n", "1,2"])


@contextlib.contextmanager
def kept_folder():
    """A folder, and an environment whose processes end with it."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="beamwork_"))
    keeps = keeper.keeper(folder)
    try:
        yield folder, {**os.environ, keeper.MARK: str(folder)}
    finally:
        keeps.stdin.close()
        if keeps.wait() != 0:
            raise trials.Failed("processes are left")


def tried(engine, program, kills, runs):
    """What an engine came to: {result, trials, kills, left_out, seconds}."""
    began, done, left_out = time.monotonic(), [], []
    try:
        with kept_folder() as (folder, environment):
            bench = trials.Bench(engine, program, runs, folder, engine.begin(folder, environment))
            for trial in trials.ALL:
                try:
                    trial(bench, **({"wanted": kills} if trial is trials.killed else {}))
                    done.append(trial.__name__)
                except trials.LeftOut as reason:
                    left_out.append(str(reason))
        result = "passed"
    except (trials.Failed, RuntimeError, OSError, subprocess.SubprocessError) as reason:
        result = f"FAILED: {trials.ALL[len(done) + len(left_out)].__name__}: {reason}"
    return {"engine": engine.name, "result": result, "hash": [run.hash for run in runs],
            "trials": done, "kills": kills if "killed" in done else 0,
            "left_out": left_out, "seconds": round(time.monotonic() - began, 1)}


def line_of(row):
    """What the screen says of it."""
    if row["result"] != "passed":
        return f"{row['engine']:<11} {row['result']}"
    hashes = " ".join(one[:12] for one in row["hash"])
    left_out = "".join(f"; left out: {what}" for what in row["left_out"])
    return (f"{row['engine']:<11} passed {hashes}: {len(row['trials'])} trials, "
            f"{row['kills']} processes killed, {row['seconds']:.0f} s{left_out}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("engines", nargs="*", metavar="ENGINE", help="those alone")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="the same as JSON")
    parser.add_argument("--kills", type=int, default=5, help="of each engine (5)")
    chosen = parser.parse_intermixed_args()
    known = [engine.name for engine in ENGINES]
    for name in chosen.engines:
        if name not in known:
            parser.error(f"no engine is called '{name}'; there are {', '.join(known)}")
    program, rows = chosen.program.resolve(), []
    if (program.parent / "truths.h5").exists():  # also for a copy of the program elsewhere
        os.environ.setdefault("BEAMWORK_TRUTHS", str(program.parent / "truths.h5"))
    those = [e for e in ENGINES if not chosen.engines or e.name in chosen.engines]
    runs = None
    for engine in those:
        missing = engine.missing()
        if missing:
            row = {"engine": engine.name, "missing": missing, "result":
                   f"skipped: {missing[0]} is not installed (apt install {engine.packages})"}
        else:
            if runs is None:
                with kept_folder() as (folder, environment):
                    runs = [trials.Run(program, words, folder, environment) for words in RUNS]
            row = tried(engine, program, chosen.kills, runs)
        rows.append(row)
        print(line_of(row), flush=True)
    passed, failed, skipped = (sum(row["result"].startswith(word) for row in rows)
                               for word in ("passed", "FAILED", "skipped"))
    if chosen.output:
        chosen.output.write_text(json.dumps({"runs": RUNS, "rows": rows}, indent=1),
                                 encoding="utf-8")
    print(f"{passed} passed, {failed} failed, {skipped} skipped")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
