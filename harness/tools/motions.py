"""Compares all stored values of motions with the limits of mesh refinement: each stored value, the value on the finest
mesh, its limit and the uncertainty.

usage: motions.py PROGRAM [CASE...] [--fine] [-o FILE.csv]     The exit status is 1 if the distance of a limit from its
reference value exceeds both uncertainties. The program also counts the limits whose uncertainty exceeds a hundredth of
the largest value of their unit; --fine uses finer meshes, and takes longer. One integration serves all instants of a
structure: the scene requests at each time the quantities that the case requests at one. The steps are so short that the
time-integration error is below the error of the meshes; geometrically_exact is the formulation with the most accurate
limits.
"""
import argparse
import concurrent.futures
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
FORMULATION = "geometrically_exact"
HOW = ("integrator", "step", "tolerance")
COLUMNS = ("case,parameters,time,quantity,unit,kind,truth,truth_uncertainty,elements,finest,limit,"
           "limit_uncertainty,off,within").split(",")
# Meshes, and the tolerance relative to the motion. For some cases, also parameters.
CASES = {
    "rigid_body": {"": ((1, 2, 4), 1e-11)},
    "spin_up": {"": ((2, 4, 8), 1e-8)},
    "free_flight_plane": {"": ((8, 16, 32), 1e-6)},
    "free_flight_space": {"": ((4, 8, 16), 1e-6)},
    "elbow": {"": ((4, 8, 16), 1e-5)},
    "pendulum": {"": ((4, 8, 16), 1e-6)},
    "leaf_guide": {"": ((2, 4, 8), 1e-6)},
    "release": {"": ((8, 16, 32), 2e-6)},
}
FINE = {
    **CASES,
    "spin_up": {"": ((8, 16, 32), 1e-10)},
    "free_flight_plane": {"": ((16, 32, 64), 1e-8), "load=step": ((32, 64, 128), 1e-7)},
    "free_flight_space": {"": ((8, 16, 32), 1e-8)},
    "elbow": {"": ((8, 16, 32), 1e-7)},
    "pendulum": {"": ((8, 16, 32), 1e-8)},
    "leaf_guide": {"": ((4, 8, 16), 1e-7)},
}
LOOSE = 0.01


def stored(case):
    """Returns {structure parameters: [(time or None, row)]} from the table of a case. The key does not contain
    the keys of HOW, the time, or parameters with the value *."""
    found = {}
    with open(ROOT / "reference" / "tables" / f"{case}.csv", newline="", encoding="utf-8") as table:
        for row in csv.DictReader(table):
            given = dict(item.split("=") for item in row["parameters"].split(";") if item)
            time = given.pop("time", None)
            structure = ";".join(f"{name}={value}" for name, value in given.items()
                                 if name not in HOW and value != "*")
            found.setdefault(structure, []).append((None if time == "*" else time, row))
    return found


def default_time(program, case):
    listed = json.loads(_run(program, "list", case, "--format", "json"))
    return next(f"{p['default']:g}" for p in listed["parameters"] if p["name"] == "time")


def _run(program, *words):
    done = subprocess.run([program, *words], capture_output=True, text=True, check=False)
    if not done.stdout:
        sys.exit(f"motions.py: {' '.join(words)}: {done.stderr.strip()}")
    return done.stdout


def asked_at(scene, times):
    """Returns the scene with quantities NAME_0, NAME_1, ... at each of the times. They replace the quantities at a
    single time. Other quantities do not change."""
    motions = [name for name, a in scene["analyses"].items() if "motion" in a]
    scene["analyses"][motions[0]]["motion"]["stations"] = times
    quantities = {}
    for name, quantity in scene["quantities"].items():
        kind = next(iter(quantity))
        if quantity[kind].get("analysis") != motions[0]:
            quantities[name] = quantity
            continue
        for i, time in enumerate(times):
            quantities[f"{name}_{i}"] = {**quantity, kind: {**quantity[kind], "at": time}}
    scene["quantities"] = quantities
    return scene


def limits(program, case, structure, times, meshes, tolerance):
    words = [word for item in structure.split(";") if item for word in ("--set", item)]
    text = _run(program, "scene", case, *words, "--set", f"time={times[-1]}", "--set",
                f"tolerance={tolerance}")
    scene = asked_at(yaml.load(text, Loader=yaml.BaseLoader), times)
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / f"{case}.yaml"
        path.write_text(yaml.dump(scene, sort_keys=False, width=10000), encoding="utf-8")
        answer = json.loads(
            _run(program, "converge", "--scene", str(path), "-f", FORMULATION, "-n",
                 ",".join(map(str, meshes)), "--format", "json"))
    return {
        q["quantity"]: (q["value"], q["limit"], q["limit_uncertainty"])
        for q in answer["series"][0]["quantities"]
    }


def judge(case, structure, rows, found, times, elements):
    for time, row in rows:
        name = row["quantity"] if time is None else f"{row['quantity']}_{times.index(time)}"
        known = found.get(name) or found.get(f"{row['quantity']}_0")
        if known is None or known[1] is None:
            finest = limit = doubt = off = None
        else:
            finest, limit, doubt = known
            off = limit - float(row["value"])
        uncertainty = float(row["uncertainty"])
        within = off is not None and abs(off) <= max(uncertainty, doubt or 0.0)
        yield dict(
            zip(COLUMNS,
                (case, structure, time or "any", row["quantity"], row["unit"], row["kind"],
                 row["value"], row["uncertainty"], elements, finest, limit, doubt, off,
                 "yes" if within else "no")))


def table(program, case, chosen=None):
    for structure, rows in stored(case).items():
        usual = default_time(program, case)
        rows = [(usual if time is None and "time=*" not in row["parameters"] else time, row)
                for time, row in rows]
        times = sorted({"0", usual, *(time for time, _ in rows if time is not None)}, key=float)
        known = (chosen or CASES)[case]
        meshes, tolerance = known.get(structure, known[""])
        found = limits(program, case, structure, times, meshes, tolerance)
        yield from judge(case, structure, rows, found, times, meshes[-1])


def tables(program, cases, chosen):
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as some:
        asked = [some.submit(lambda one: list(table(program, one, chosen)), case)
                 for case in reversed(cases)]
        return [row for one in reversed(asked) for row in one.result()]


def is_loose(row, rows):
    """Returns True if the error of the meshes exceeds a hundredth of the largest value with the same unit."""
    size = max(abs(float(other["truth"])) for other in rows if other["unit"] == row["unit"])
    return row["limit_uncertainty"] is not None and row["limit_uncertainty"] > LOOSE * size


def show(rows):
    outside = [row for row in rows if row["within"] != "yes"]
    for case in dict.fromkeys(row["case"] for row in rows):
        own = [row for row in rows if row["case"] == case]
        good = sum(row["within"] == "yes" for row in own)
        loose = sum(is_loose(row, own) for row in own)
        print(f"{case}: {good} of {len(own)} values within the larger of their digits and the "
              "error of the mesh" + (f", which is more than 1 % for {loose}" if loose else ""))
    for row in outside:
        print("  outside: " + ", ".join(f"{name} {row[name]}" for name in COLUMNS[:-1]
                                        if row[name] not in ("", None)))
    return 1 if outside else 0


def main():
    given = argparse.ArgumentParser()
    given.add_argument("program")
    given.add_argument("case", nargs="*")
    given.add_argument("-o", "--output")
    given.add_argument("--fine", action="store_true")
    asked = given.parse_args()
    chosen = FINE if asked.fine else CASES
    rows = tables(asked.program, asked.case or list(CASES), chosen)
    if asked.output:
        with open(asked.output, "w", newline="", encoding="utf-8") as out:
            writer = csv.DictWriter(out, COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
    return show(rows)


if __name__ == "__main__":
    sys.exit(main())
