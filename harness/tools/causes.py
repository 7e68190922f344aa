#!/usr/bin/python3
"""Experiments on the causes of known deviations, for the report.

usage: causes.py PROGRAM VERIFY_JSON -o FILE [--minutes M] [--rule RULE]...

For each known deviation and each case in which it was observed, the verdict whose limit is farthest from the reference
value is examined further:
  finer      the same run with more elements, up to 256;
  without    with one feature of the scene omitted (shear, trapeze, wagner, warping);
  instead    with a formulation that differs in a single feature.
A change that removes nine tenths of the error shows its cause. Limits, uncertainties and reference values are those of
the program; if a changed scene has no reference value, the limit of collocation is used instead. Experiments that do
not start within the time limit are recorded as not run.
"""
import argparse
import concurrent.futures
import json
import math
import os
import re
import subprocess
import time

MESHES = (8, 16, 32, 64, 128, 256)
OF_MECHANISMS = {"spherical_joint": (4, 8, 16, 32, 64), "hexapod": (1, 2, 4, 8)}
FEATURES = ("shear", "trapeze", "wagner", "warping")
EXACT, EXACT_MESHES = "collocation:stages=8", (2, 4, 8, 16)
SECONDS = 60  # time limit [s] of a series
LEFT = 0.1  # largest remaining fraction of an error that counts as vanished
RIGHT = 1e-3  # largest relative error that counts as correct if there was no value before

# (formulation, formulation, the only feature in which they differ). causes_test.py checks the code.
SIBLINGS = (
    ("beamw", "beamw_first", "second-order terms of the modes (J Eq. 66)"),
    ("sheet_second", "sheet_second_consistent", "shear in the generalized strains (N Eq. 37)"),
    ("sheet_third", "sheet_third_printed", "sign of u_y (N Eq. 49)"),
    ("sheet_third", "sheet_second", "stress function (N Eqs. 44-65, or 33-36)"),
    (
        "beamw_consistent",
        "beamw_consistent:inside=linear",
        "equilibrium of the inside with its stress",
    ),
    ("beamw_consistent", "beamw_consistent:torsion=hyperbolic", "functions of the twist"),
)
OF_VIBRATION = (
    ("beamw", "beamw:mass=lumped", "mass matrix"),
    ("beamw_first", "beamw_first:mass=lumped", "mass matrix"),
    ("beamw_vlasov", "beamw_vlasov:mass=lumped", "mass matrix"),
    ("beamw_consistent", "beamw_consistent:mass=lumped", "mass matrix"),
)


def siblings(formulation, vibrates):
    """Returns [(other formulation, the only feature in which it differs)]. For a formulation with an option, the list
    includes the formulation without the option."""
    pairs = SIBLINGS + (OF_VIBRATION if vibrates else ())
    found = [(b, what) for a, b, what in pairs if a == formulation]
    return found + [(a, what) for a, b, what in pairs if b == formulation]


def newton_of(formulation):
    """Returns the formulation with the other form of Newton's method, which is used if a run does not converge."""
    separator = "," if ":" in formulation else ":"
    return f"{formulation}{separator}newton=displacement", "unknowns of Newton's method"


def error_of(limit, exact):
    return (limit - exact) / (abs(exact) or 1)


class Laboratory:
    def __init__(self, program, deadline):
        self.program, self.deadline, self.kept = program, deadline, {}

    def ask(self, case, formulation, parameters, meshes):
        command = [self.program, "converge", case, "-f", formulation, "-j", "1", "--format", "json"]
        command += ["-n", ",".join(map(str, meshes))] + [w for p in parameters for w in ("-s", p)]
        left = self.deadline - time.monotonic()
        if left <= 0:
            return None, "not run: the time limit was reached"
        try:
            done = subprocess.run(
                command, capture_output=True, text=True, timeout=min(SECONDS, left), check=False
            )
        except subprocess.TimeoutExpired:
            return None, f"no answer within {min(SECONDS, left):.0f} s"
        if done.returncode not in (0, 1, 3) or not done.stdout:  # 3: the run was rejected, with a reason
            return None, done.stderr.strip().splitlines()[-1] if done.stderr.strip() else "failed"
        series = json.loads(done.stdout)["series"][0]
        if series["missing"]:
            return None, f"does not support {series['missing']}"
        return {q["quantity"]: q for q in series["quantities"]}, ""

    def series(self, *what):
        if what not in self.kept:
            self.kept[what] = self.ask(*what)
        return self.kept[what]

    def stand_in(self, case, parameters, quantity):
        """Returns the limit of collocation if its relative uncertainty is at most 1e-6, otherwise NaN."""
        found, _ = self.series(case, EXACT, parameters, EXACT_MESHES)
        record = (found or {}).get(quantity)
        if not record or record["limit"] is None or record["limit_uncertainty"] is None:
            return math.nan
        sure = record["limit_uncertainty"] <= 1e-6 * abs(record["limit"])
        return record["limit"] if sure else math.nan

    def exact(self, case, parameters, quantity, record, known):
        if record["truth"] is not None:
            return record["truth"], "truth"
        if known is not None:
            return known, "truth"
        return self.stand_in(case, parameters, quantity), EXACT

    def limit(self, case, formulation, parameters, quantity, known):
        meshes = OF_MECHANISMS.get(case, MESHES)
        out = {"formulation": formulation, "parameters": ";".join(parameters), "meshes": meshes}
        found, why = self.series(case, formulation, parameters, meshes)
        record = (found or {}).get(quantity)
        if not record or record["limit"] is None:
            why = why or (record or {}).get("reason") or "no value"
            return {**out, "error": None, "why": why}
        exact, against = self.exact(case, parameters, quantity, record, known)
        error = record["error"] if record["error"] is not None else error_of(record["limit"], exact)
        missing = "" if math.isfinite(error) else "no exact value for comparison"
        return {
            **out,
            "limit": record["limit"],
            "limit_uncertainty": record["limit_uncertainty"],
            "error": None if missing else error,
            "against": against,
            "why": missing,
        }


def worst_of(verdicts):
    """Returns {(entry, case): verdict with the largest error, or a verdict without a value if there are no errors}."""
    found = {}
    for v in verdicts:
        key = v["finding"], v["case"]
        if v["finding"] and (
            key not in found or abs(v["error"] or 0) > abs(found[key]["error"] or 0)
        ):
            found[key] = v
    return found


def rounds(found):
    """Returns the verdicts, sorted such that the first cases of all entries precede the second cases, because the time
    limit may prevent the examination of the last verdicts."""
    of_rule = {}
    for rule, case in sorted(found, key=lambda key: -abs(found[key]["error"] or 0)):
        of_rule.setdefault(rule, []).append((rule, case))
    most = max(map(len, of_rule.values()), default=0)
    return [cases[i] for i in range(most) for cases in of_rule.values() if i < len(cases)]


def switches(program, case, given):
    listed = subprocess.run([program, "list", case], capture_output=True, text=True, check=False)
    names = re.findall(r"^  (\w+) ", listed.stdout, re.M)
    return [f for f in FEATURES if f in names and all(p.split("=")[0] != f for p in given)]


def experiments(laboratory, v):
    """Returns [(change, result)] for a verdict. The first change is only a refinement of the meshes."""
    case, quantity, key = v["case"], v["quantity"], v["formulation"]
    given = tuple(p for p in v["parameters"].split(";") if p)
    vibrates = v["unit"] == "Hz" or "omega" in v["parameters"]
    plan = [("finer", "more elements", key, given)]
    plan += [
        ("without", f, key, given + (f"{f}=0",)) for f in switches(laboratory.program, case, given)
    ]
    others = siblings(key, vibrates) + ([newton_of(key)] if v["error"] is None else [])
    plan += [("instead", what, other, given) for other, what in others]
    found = []
    for kind, what, formulation, parameters in plan:
        known = None if kind == "without" else v["truth"]
        shown = laboratory.limit(case, formulation, parameters, quantity, known)
        found.append({"kind": kind, "what": what, **shown})
    return found


def is_gone(error, before):
    return error is not None and abs(error) <= (RIGHT if before is None else LEFT * abs(before))


def study(laboratory, v):
    done = experiments(laboratory, v)
    before = done[0]["error"] if done[0]["error"] is not None else v["error"]
    for e in done:
        e["gone"] = is_gone(e["error"], v["error"] if e["kind"] == "finer" else before)
    names = (
        "finding",
        "case",
        "parameters",
        "formulation",
        "quantity",
        "verdict",
        "error",
        "predicted",
        "reason",
    )
    return {**{name: v[name] for name in names}, "experiments": done}


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("program")
    parser.add_argument("verdicts")
    parser.add_argument("-o", dest="out", required=True)
    parser.add_argument("--minutes", type=float, default=10, help="time limit for starting a series")
    parser.add_argument("--rule", action="append", help="examine only this known deviation; may be repeated")
    given = parser.parse_args()
    with open(given.verdicts, encoding="utf-8") as file:
        verdicts = [
            v for v in json.load(file)["verdicts"] if not given.rule or v["finding"] in given.rule
        ]
    laboratory = Laboratory(given.program, time.monotonic() + 60 * given.minutes)
    found = worst_of(verdicts)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        studies = list(pool.map(lambda key: study(laboratory, found[key]), rounds(found)))
    rows = [e for s in studies for e in s["experiments"]]
    late = sum(e.get("why", "").startswith("not run") for e in rows)
    with open(f"{given.out}.part", "w", encoding="utf-8") as file:
        json.dump({"minutes": given.minutes, "not_run": late, "studies": studies}, file, indent=1)
    os.replace(f"{given.out}.part", given.out)
    rules = {s["finding"] for s in studies}
    print(f"{len(studies)} verdicts of {len(rules)} rules, {len(rows)} experiments, {late} not run")


if __name__ == "__main__":
    main()
