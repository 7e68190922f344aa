#!/usr/bin/python3
"""Compares the two forms of Newton's method, including the most demanding paths.

usage: newton.py PROGRAM -o FILE

Writes JSON for the report: `singles`, targets tried in one step; `contests`, one comparison per case, formulation
and first step, with both forms; `histories`, the corrections and residuals of every iteration."""
import argparse
import json
import subprocess
import sys

FORMS = ("mixed", "displacement")
FIRST_STEPS = (16, 8, 4, 2, 1)
CANTILEVER = ("sheet_second 2", "sheet_third 1", "sheet_second_consistent 4",
              "beamw_consistent 4", "geometrically_exact 4", "collocation 1")
JOINT = ("sheet_second 1", "sheet_second 2", "sheet_third 1", "sheet_second_consistent 2",
         "collocation 1")
SINGLES = (  # case, parameters, increasing parameter, its values, unit, formulations and meshes
    ("sheet_cantilever", "stations=1", "tip_deflection",
     (0.015, 0.03, 0.05, 0.07, 0.08, 0.09), "m", CANTILEVER),
    ("spherical_joint", "steps=1", "tilt",
     (0.03, 0.06, 0.1, 0.15, 0.2, 0.26, 0.4, 0.6, 0.8), "rad", JOINT),
)
CONTESTS = (  # case, parameters, formulations and meshes
    ("sheet_cantilever", "stations=1", CANTILEVER),
    ("sheet_cantilever", "stations=1;tip_deflection=0.05", CANTILEVER),
    ("spherical_joint", "steps=1", JOINT),
)
HISTORIES = tuple(  # case, parameters, formulation and mesh, first steps
    (case, "", contestant, 0) for case in ("roll_up", "bend_45")
    for contestant in ("collocation 4", "geometrically_exact 16", "beamw_consistent 16"))


def solve(program, case, parameters, formulation, n, steps):
    """Returns the solution as read from JSON. Exits with an error if the program fails."""
    sets = [word for p in parameters.split(";") if p for word in ("--set", p)]
    command = [program, "solve", case, "-f", formulation, "-n", n, "--format", "json", *sets,
               *(["--steps", str(steps)] if steps else [])]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1) or not done.stdout:
        raise SystemExit(f"newton.py: {' '.join(command)}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def steps_of(result):
    out = [{**step, "corrections": [], "residuals": []} for step in result["steps"]]
    for iteration in result["iterations"]:
        out[iteration["step"]]["corrections"].append(iteration["correction"])
        out[iteration["step"]]["residuals"].append(iteration["residual"])
    return out


def summary(result):
    cell, steps = result["cell"], result["steps"]
    return {"status": cell["status"], "reason": cell["reason"], "iterations": cell["iterations"],
            "steps": len(steps), "rejected": cell["rejected_steps"],
            "largest_step": max((s["increment"] for s in steps), default=0.0),
            "most_iterations": max((s["iterations"] for s in steps), default=0),
            "reached": steps[-1]["path"] if steps else 0.0}


def single(program, case, parameters, formulation, n):
    """Returns the number of iterations of the single step, or None if it did not converge in one step."""
    result = solve(program, case, parameters, formulation, n, 1)
    whole = result["cell"]["status"] == "ok" and result["cell"]["rejected_steps"] == 0
    return result["steps"][0]["iterations"] if whole else None


def singles(program):
    for case, parameters, name, values, unit, contestants in SINGLES:
        for formulation, n in map(str.split, contestants):
            tried = {form: [single(program, case, f"{parameters};{name}={value}",
                                   f"{formulation}:newton={form}", n) for value in values]
                     for form in FORMS}
            yield {"case": case, "parameter": name, "unit": unit, "values": values,
                   "formulation": formulation, "elements": int(n), **tried}


def contests(program):
    for case, parameters, contestants in CONTESTS:
        for formulation, n in map(str.split, contestants):
            for steps in FIRST_STEPS:
                both = {form: summary(solve(program, case, parameters,
                                            f"{formulation}:newton={form}", n, steps))
                        for form in FORMS}
                yield {"case": case, "parameters": parameters, "formulation": formulation,
                       "elements": int(n), "first_steps": steps, **both}


def histories(program):
    for case, parameters, contestant, steps in HISTORIES:
        formulation, n = contestant.split()
        for form in FORMS:
            key = f"{formulation}:newton={form}"
            result = solve(program, case, parameters, key, n, steps)
            yield {"case": case, "parameters": parameters, "formulation": formulation,
                   "elements": int(n), "form": form, "status": result["cell"]["status"],
                   "reason": result["cell"]["reason"], "steps": steps_of(result)}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("-o", required=True, metavar="FILE")
    given = parser.parse_args()
    record = {part.__name__: list(part(given.program)) for part in (singles, contests, histories)}
    with open(given.o, "w", encoding="utf-8") as out:
        json.dump(record, out, indent=1)


if __name__ == "__main__":
    sys.exit(main())
