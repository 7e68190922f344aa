#!/usr/bin/python3
"""Runs integrators on every case of motion, with every practical formulation that supports it: the problems of
work-precision diagrams and performance profiles (harness/experiments/integrators.csv).

usage: integrators.py PROGRAM -o FILE [WORD]     Writes JSON for the report and prints a line for each problem. With
WORD, runs only the rows whose case contains this word.

Each row is one run of `beamwork motion`. Its reference, radau at 1e-10, is compared with `explicit` (Runge-Kutta of
order 8, which uses neither Newton's method nor a tangent) at two tolerances on the same mesh, once for each row if
possible (column check: the formulation). The difference decreases with the tolerance as long as the error of
`explicit` dominates.
"""
import argparse
import csv
import json
import pathlib
import subprocess
import sys
import time

TABLE = pathlib.Path(__file__).resolve().parents[1] / "experiments" / "integrators.csv"
EXPLICIT = "1e-11,1e-13"  # tolerances of the steps of `explicit`
CELL, CHECK = "60", "60"  # time limits of a motion [s]: for all integrators, and for checks with `explicit`
LEVEL = 1e-4  # error level of the printed lines


def motion(program, row, *more):
    sets = [word for p in row["parameters"].split(";") if p for word in ("--set", p)]
    command = [program, "motion", row["case"], "-n", row["elements"], *sets, "--format", "json",
               *more]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1) or not done.stdout:
        raise SystemExit(f"integrators.py: {' '.join(command)}: {done.stderr.strip()}")
    return json.loads(done.stdout)


TABLES = ("references", "runs", "orders", "reached")


def refused(record):
    """Returns {formulation: reason} of the formulations that do not support the motion."""
    offered = {r["formulation"] for r in record["runs"] if r["status"] != "refused"}
    return {r["formulation"]: r["reason"] for r in reversed(record["runs"])
            if r["formulation"] not in offered}


def ladder(program, row):
    chosen = [word for name in row["formulations"].split() for word in ("-f", name)]
    record = motion(program, row, *chosen, "--time-limit", CELL, "--step", row["steps"],
                    "--tolerance", row["tolerances"])
    without = refused(record)
    return ({name: [r for r in record[name] if r["formulation"] not in without] for name in TABLES},
            [{"case": row["case"], "parameters": row["parameters"], "formulation": name,
              "reason": why} for name, why in without.items()])


def checked(program, row):
    found = motion(program, row, "-f", row["check"], "--time-limit", CHECK, "--integrator",
                   "explicit", "--tolerance", EXPLICIT)
    coarse, fine = found["runs"]
    return {"case": row["case"], "parameters": row["parameters"], "formulation": row["check"],
            "elements": int(row["elements"]), "distances": [coarse["error"], fine["error"]],
            "uncertainty": found["references"][0]["uncertainty"], "steps": fine["steps"],
            "reason": coarse["reason"] or fine["reason"] or found["references"][0]["reason"]}


def word_of(check):
    if None in check["distances"]:
        return f"not checked: {check['reason']}"
    coarse, fine = check["distances"]
    return (f"explicit at {EXPLICIT.replace(',', ' and ')} is {coarse:.1e} and {fine:.1e} from it "
            f"({check['formulation']})")


def soonest(tables):
    """Returns text such as `radau 7, alpha 2`: for each scheme, the number of formulations for which it has the lowest
    cost within LEVEL."""
    count = {}
    for name in {r["formulation"] for r in tables["runs"]}:
        ways = [w for w in tables["reached"]
                if w["error"] == LEVEL and w["formulation"] == name]
        best = min(ways, key=lambda w: w["cost"])["integrator"] if ways else "none"
        count[best] = count.get(best, 0) + 1
    return ", ".join(f"{name} {n}" for name, n in sorted(count.items(), key=lambda i: -i[1]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("program")
    parser.add_argument("word", nargs="?", default="")
    parser.add_argument("-o", "--output", required=True)
    given = parser.parse_args()
    out = {**{name: [] for name in TABLES}, "left_out": [], "checks": []}
    with open(TABLE, newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if given.word in row["case"]]
    for row in rows:
        begin = time.monotonic()
        tables, left_out = ladder(given.program, row)
        check = checked(given.program, row)
        for name in TABLES:
            out[name] += tables[name]
        out["left_out"] += left_out
        out["checks"].append(check)
        at = f" ({row['parameters']})" if row["parameters"] else ""
        print(f"{row['case']}{at}: {len({r['formulation'] for r in tables['runs']})} formulations, lowest cost within {LEVEL:g}: "
              f"{soonest(tables)}; reference: {word_of(check)}; {time.monotonic() - begin:.0f} s",
              flush=True)
    pathlib.Path(given.output).write_text(json.dumps(out), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
