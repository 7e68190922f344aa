"""Tests `bench`: injects delays of known size, which the comparison must detect.

usage: bench_check.py PROGRAM [-o FILE]
* 20 % of the run time is added to one of two equal formulations in one process: this formulation must be reported as slower, by 15 to 25 %.
* Nothing is added: the comparison must be undecided (one process, and two copies of the program).
* One run keeps all degrees of freedom (--all-dofs): the work counts must differ, because there are more unknowns; the
  counts of two equal runs must be equal.
Each part is repeated; the outcome of every repetition is printed, and written as JSON for the report.
"""
import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

CELLS = (("c_column", "beamw", 8), ("sheet_cantilever", "sheet_third", 2),
         ("elastica", "collocation", 2), ("moment_buckling", "beamw_consistent", 8))

KEPT = ("shear_column", "beamw", 8)  # a run in which warping coordinates are eliminated


def against(program, cell, other, *more):
    case, formulation, n = cell
    command = [program, "bench", case, "-f", formulation, "-n", str(n), "--against", other,
               "--format", "json", *more]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=300)
    return json.loads(done.stdout)


def differing(answer):
    return [w["name"] for w in answer["work"] if w["a"] != w["b"]]


def row(what, cell, answer, good):
    return {"what": what, "cell": f"{cell[0]}, {cell[1]}, n = {cell[2]}",
            **{name: answer[name] for name in ("ratio", "low", "high", "pairs", "outcome")},
            "work": ", ".join(differing(answer)) or "the same", "good": good}


def is_undecided(answer):
    return answer["outcome"] == "undecided" and not differing(answer)


def checks(program, folder):
    copy = shutil.copy(program, os.path.join(folder, "copy"))
    wrapper = pathlib.Path(folder) / "whole"
    wrapper.write_text(f'#!/bin/sh\nexec "{os.path.abspath(program)}" "$@" --all-dofs\n',
                       encoding="utf-8")
    wrapper.chmod(0o755)
    for cell in CELLS:
        slow = against(program, cell, cell[1], "--inject-slowdown", "20")
        found = slow["outcome"] == "slower" and 1.15 < slow["ratio"] < 1.25
        yield row("20 % injected, one process", cell, slow, found and not differing(slow))
        same = against(program, cell, cell[1])
        yield row("nothing injected, one process", cell, same, is_undecided(same))
    same = against(program, CELLS[0], copy)
    yield row("nothing injected, two programs", CELLS[0], same, is_undecided(same))
    more = against(program, KEPT, str(wrapper))
    yield row("the other program keeps all degrees of freedom", KEPT, more,
              more["outcome"] == "slower" and "free" in differing(more))


def show(r):
    print(f"{'ok  ' if r['good'] else 'FAIL'} {r['what']:38} {r['cell']:34} {r['ratio']:.3f} "
          f"({r['low']:.3f} to {r['high']:.3f}, {r['pairs']} pairs) {r['outcome']}; "
          f"work: {r['work']}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("-o", dest="output")
    given = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        beside = os.path.dirname(os.path.abspath(given.program))
        os.environ.setdefault("BEAMWORK_TRUTHS", os.path.join(beside, "truths.h5"))
        for r in checks(given.program, folder):
            rows.append(r)
            show(r)
    if given.output:
        pathlib.Path(given.output).write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
    failed = sum(not r["good"] for r in rows)
    print(f"{len(rows) - failed} as expected, {failed} not")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
