#!/usr/bin/python3
"""Finds the cause of every verdict that is expected although it is not `pass`, by experiment, and writes it down.

usage: causes.py PROGRAM VERIFY_JSON [CASE...]      rewrites the column `proof` of reference/findings.csv

A finding's formulation is run on meshes finer than those of the verdict: if its limit there agrees with the truth, the
verdict's meshes were too coarse.  Otherwise one feature after the other (shear, trapeze, wagner, warping), then every pair,
is left out of the scene: the first that lets the limit agree with the exact value of the same scene (a stored truth, or
one collocation element of eight stages against two) is the cause.  Otherwise a formulation that differs in one thing only is run.
What none of them explains keeps the proof it has.
"""
import collections
import csv
import io
import itertools
import json
import math
import pathlib
import subprocess
import sys

FINDINGS = pathlib.Path(__file__).parents[2] / "reference" / "findings.csv"
FINE = collections.defaultdict(lambda: (16, 32, 64, 128), spherical_joint=(4, 8, 16), hexapod=(4, 8, 16), roll_up=(64, 128, 256, 512))
FEATURES = ("shear", "trapeze", "wagner", "warping")
LEFT_OUT = {  # what a formulation does with a feature
    "beamw": {"shear": "J Eq. 66 does not see shear (ERRATA, J 58/62/66)"},
    "beamw_first": {"shear": "first-order modes do not see shear in the second order", "trapeze": "first-order modes: twist does not shorten"},
    "sheet_second": {"shear": "N Eq. 37 leaves shear out (ERRATA)"},
    "sheet_third": {"shear": "N Eqs. 37 and 50 leave shear out (ERRATA)"},
    "sheet_third_printed": {"shear": "N Eqs. 37 and 50 leave shear out (ERRATA)"},
    "sheet_second_consistent": {"shear": "shear angles kept to second order only"},
}
KEEPS_SHEAR = ("sheet_second_consistent", "keeping shear in the compatibility equations")
EXACT = ("collocation", "exact kinematics with shear angles of any size")
SIBLINGS = {  # formulations that differ in one thing, the closest first
    "beamw": [("beamw_consistent", "keeping shear and eccentricity in the modes"), EXACT],
    "beamw_first": [("beamw_consistent", "its second-order modes"), EXACT],
    "sheet_second": [KEEPS_SHEAR, EXACT],
    "sheet_third": [KEEPS_SHEAR, EXACT],
    "sheet_third_printed": [("sheet_third", "the sign of u_y that equilibrium asks for"), KEEPS_SHEAR, EXACT],
    "sheet_second_consistent": [EXACT],
    "beamw_consistent": [EXACT],
}


class Laboratory:
    """Runs the program; every quantity by mesh, with the stored truth if there is one."""

    def __init__(self, program):
        self.program, self.kept = program, {}

    def values(self, case, formulation, parameters, meshes):
        key = (case, formulation, tuple(parameters), meshes)
        if key not in self.kept:
            command = [self.program, "converge", case, "-f", formulation, "-n", ",".join(map(str, meshes)), "--format", "csv"]
            for p in parameters:
                command += ["-s", p]
            text = subprocess.run(command, capture_output=True, text=True, timeout=600).stdout
            found = collections.defaultdict(dict)
            for row in csv.DictReader(io.StringIO(text)):
                if row["value"]:
                    found[row["quantity"]][int(row["elements"])] = (float(row["value"]), float(row["truth"] or "nan"))
            self.kept[key] = found
        return self.kept[key]

    def exact(self, case, parameters, quantity, found):
        """The stored truth, or what collocation gives on one and two elements if both agree to 1e-7."""
        stored = [truth for _, truth in found.values() if not math.isnan(truth)]
        if stored:
            return stored[0]
        ours = self.values(case, "collocation:stages=8", parameters, (4, 8)).get(quantity, {})
        if len(ours) == 2 and abs(ours[4][0] - ours[8][0]) <= 1e-7 * abs(ours[8][0]):
            return ours[8][0]
        return math.nan

    def limit_error(self, case, formulation, parameters, quantity):
        """Error of the limit, relative unless the exact value is zero (NaN if unknown), and the order seen."""
        found = self.values(case, formulation, parameters, FINE[case]).get(quantity, {})
        if len(found) < 3:
            return math.nan, math.nan
        exact = self.exact(case, parameters, quantity, found)
        limit, order = limit_of([found[n][0] for n in sorted(found)][-3:])
        return (limit - exact) / (abs(exact) or 1), order


def limit_of(v):
    """Richardson's limit of three values on meshes that double, the last value where no order shows; and the order."""
    first, second = v[0] - v[1], v[1] - v[2]
    ratio = first / second if second else math.nan
    if not ratio > 1.2:
        return v[2], math.nan
    return v[2] - second / (ratio - 1), math.log2(ratio)


def cause_of(laboratory, row, verdict, switches):
    """The sentence for `proof`, or None."""
    tolerance = verdict["tolerance"] / (abs(verdict["truth"]) or 1)
    case, formulation, quantity = row["case"], row["formulation"].split(":")[0], row["quantity"]
    given = [p for p in row["parameters"].split(";") if p]
    finest = FINE[case][-1]
    base, order = laboratory.limit_error(case, row["formulation"], given, quantity)
    if math.isnan(base):
        left, _ = laboratory.limit_error(case, EXACT[0], given, quantity)
        failed = verdict["verdict"] == "diverged" and abs(left) <= tolerance
        return f"{verdict['reason']}; {EXACT[0]}, which differs by {EXACT[1]}, has its limit {left:+.1e} off" if failed else None
    if abs(base) <= tolerance / 2:
        return f"the meshes of the verdict are too coarse: with n to {finest} the limit is {base:+.1e} off" + (f", order {order:.1f}" if order > 0 else "")
    for count in (1, 2):
        for chosen in itertools.combinations([s for s in switches if all(p.split("=")[0] != s for p in given)], count):
            off = [f"{s}=0" for s in chosen]
            left, _ = laboratory.limit_error(case, row["formulation"], given + off, quantity)
            if abs(left) <= abs(base) / 20 and abs(left) <= max(tolerance / 10, 1e-6):
                why = "; ".join(LEFT_OUT.get(formulation, {}).get(s, f"the error comes with {s}") for s in chosen)
                return f"{why}: with n to {finest} the limit is {base:+.1e} off, with {' '.join(off)} {left:+.1e}"
    for other, what in SIBLINGS.get(formulation, []):
        left, _ = laboratory.limit_error(case, other, given, quantity)
        if abs(left) <= abs(base) / 5:
            return f"{other}, which differs by {what}, has its limit {left:+.1e} off with n to {finest}; this one {base:+.1e}"
    return None


def main(program, verdicts, cases):
    with open(verdicts) as file:
        judged = {(v["case"], v["parameters"], v["formulation"], v["quantity"]): v for v in json.load(file)["verdicts"]}
    with open(FINDINGS, newline="") as file:
        rows = list(csv.DictReader(file))
    laboratory, told = Laboratory(program), 0
    for row in rows:
        verdict = judged.get((row["case"], row["parameters"], row["formulation"], row["quantity"]))
        if (cases and row["case"] not in cases) or verdict is None or verdict["truth"] is None:
            continue
        listed = subprocess.run([program, "list", row["case"]], capture_output=True, text=True).stdout.split()
        sentence = cause_of(laboratory, row, verdict, [f for f in FEATURES if f in listed])
        if sentence:
            row["proof"], told = sentence, told + 1
    with open(FINDINGS, "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    print(f"{told} of {len(rows)} findings explained by experiment")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], sys.argv[3:])
