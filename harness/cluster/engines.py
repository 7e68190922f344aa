"""Runs every engine of this folder for real and asks of it what trials.py says (`make engines`).

A line for each: passed with the hash of its answers, FAILED, or skipped by name; then their number.
Installs nothing. Whatever happens, no process and no folder of it is left (keeper.py).
usage: python3 -m harness.cluster.engines PROGRAM [-o FILE.json] [--kills N] [ENGINE...]
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

from harness.cluster import answers, keeper, trials
from harness.cluster.engine import ENGINES

# Some seconds of the processor, thirty batches or more; and another run.
ARGUMENTS = ["verify", "-k",
             "c_column/default or bend_45 or sheet_cantilever/default or lee_frame/default"]
OTHER = ["verify", "-k", "shear_elastica"]


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


def in_one_piece(program, folder, environment):
    """Hash, exit status and seconds of the run without shards."""
    output, began = folder / "whole.h5", time.monotonic()
    done = subprocess.run([program, *ARGUMENTS, "-o", output], env=environment, check=False,
                          text=True, capture_output=True)
    if not output.exists():
        sys.exit(f"engines: {' '.join(ARGUMENTS)}: status {done.returncode}: {done.stderr}")
    return answers.hash_of(output), done.returncode, time.monotonic() - began


def tried(engine, program, kills, whole):
    """What an engine came to: {result, trials, kills, left_out, seconds}."""
    began, done, left_out = time.monotonic(), [], []
    try:
        with kept_folder() as (folder, environment):
            bench = trials.Bench(engine, program, ARGUMENTS, OTHER, whole, folder,
                                 engine.begin(folder, environment))
            for trial in trials.ALL:
                try:
                    trial(bench, **({"wanted": kills} if trial is trials.killed else {}))
                    done.append(trial.__name__)
                except trials.LeftOut as reason:
                    left_out.append(str(reason))
        result = "passed"
    except (trials.Failed, RuntimeError, OSError, subprocess.SubprocessError) as reason:
        result = f"FAILED: {trials.ALL[len(done) + len(left_out)].__name__}: {reason}"
    return {"engine": engine.name, "result": result, "hash": whole[0], "trials": done,
            "kills": kills if "killed" in done else 0, "left_out": left_out,
            "seconds": round(time.monotonic() - began, 1)}


def line_of(row):
    """What the screen says of it."""
    if row["result"] != "passed":
        return f"{row['engine']:<11} {row['result']}"
    left_out = "".join(f"; left out: {what}" for what in row["left_out"])
    return (f"{row['engine']:<11} passed {row['hash'][:16]}: {len(row['trials'])} trials, "
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
    whole = None
    for engine in those:
        missing = engine.missing()
        if missing:
            row = {"engine": engine.name, "missing": missing, "result":
                   f"skipped: {missing[0]} is not installed (apt install {engine.packages})"}
        else:
            if whole is None:
                with kept_folder() as (folder, environment):
                    whole = in_one_piece(program, folder, environment)
            row = tried(engine, program, chosen.kills, whole)
        rows.append(row)
        print(line_of(row), flush=True)
    passed, failed, skipped = (sum(row["result"].startswith(word) for row in rows)
                               for word in ("passed", "FAILED", "skipped"))
    if chosen.output:
        chosen.output.write_text(json.dumps({"arguments": ARGUMENTS, "rows": rows}, indent=1),
                                 encoding="utf-8")
    print(f"{passed} passed, {failed} failed, {skipped} skipped")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
