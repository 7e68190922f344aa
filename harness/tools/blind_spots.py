#!/usr/bin/python3
"""Finds the smallest faults that `make verify` detects.

usage: blind_spots.py FAULTY VERIFY_JSON RESULTS_H5 FINDINGS_CSV -o BLIND_SPOTS_CSV -p PLANTED_FAULTS_CSV

FAULTY is the program with a fault of 1e-3 in one constant of all elements, or in one kind of loads (plant.c).
For each constant, the values on the two coarsest meshes with and without the fault give the derivative of every
limit. VERIFY_JSON, of a run without a fault, contains the band in which a limit may move without changing its
verdict (harness/study/verdict.c, evaluation.c). The smallest detected fault is the band divided by the
derivative. There are two ways of detection:
  verdict    the verdict differs, for either sign of the fault;
  baseline   the limit at the default point differs from the committed one by more than 1e-5
             (harness/experiments/regressions.c), where no exact reference value checks it as closely. Comparisons
             of
             mesh errors with the committed ones detect some smaller faults of one sign; these are not counted."""
import argparse
import csv
import json
import math
import os
import subprocess
import tempfile
from dataclasses import dataclass

import h5py

CONSTANTS = (
    "EA", "EIy", "EIz", "GIt", "EIw", "GAy", "GAz", "GAw", "wagner_torque", "mass", "rotary", "body",
    "body_inertia", "spring", "force", "moment", "distributed", "weight"
)  # yapf: disable
SIZE = 1e-3  # size of the injected faults
WANTED = 1e-3  # larger faults must not remain undetected without a reason
LEAST = 1e-9  # smallest difference between two faults
SURELY, KNOWN, MOVED = 3, 1e-9, 1e-5  # constants of study/verdict.c, of predictions, and of experiments/regressions.c
CHANGED = 1e-7  # smaller relative changes of a value are due to rounding or to the steps of a motion
NEAR = 1e-2  # largest relative error of values on coarse meshes that predict the change of a limit sufficiently well
SOUND = 1e-3  # tolerance of a limit, cases/scene/scene.h
UNJUDGED = ("skip", "other model", "refused", "diverged")
CLOSELY = ("pass", "biased, as predicted", "wrong limit, as predicted")
ROWS = (
    "case", "quantity", "reference", "noticed", "by", "constant", "formulation", "parameters",
    "verdicts_alone", "reason"
)  # yapf: disable
FAULTS = ("formulation", "constant", "noticed", "case", "parameters", "quantity", "reason")


def key_of(verdict):
    return verdict["case"], verdict["point"], verdict["formulation"], verdict["quantity"]


def planted_values(program, folder, constant):
    """Returns {(case, point, formulation, quantity): value} of a run with a fault in a constant; None: no fault."""
    path = os.path.join(folder, "verify.json")
    environment = dict(os.environ, BEAMWORK_PLANT_MESHES="2")
    if constant is not None:
        environment["BEAMWORK_PLANT"] = f"{constant}={SIZE}"
    subprocess.run(
        [
            program, "verify", "--built-in", "--scene", "cases/examples", "--exit-zero", "--quiet",
            "-o", os.path.join(folder, "results.h5"), "--json", path
        ],  # yapf: disable
        env=environment, stdout=subprocess.DEVNULL, check=True)
    with open(path, encoding="utf-8") as file:
        return {key_of(v): v["value"] for v in json.load(file)["verdicts"]}


def scale_of(v):
    size = abs(v["limit"] if v["truth"] is None else v["truth"])
    return max(size, v["near_zero"] or 0)


def band_of(v, rules):
    """Returns (largest distance of the limit from its expected value for which the verdict does not change, actual
    distance). The first distance is infinite if the verdict never changes."""
    if v["truth"] is None or v["limit"] is None or v["verdict"] in UNJUDGED:
        return math.inf, 0
    scale, doubt = scale_of(v), v["limit_uncertainty"] or 0
    away = abs(v["limit"] - v["truth"])
    if v["verdict"] == "pass":
        band = v["tolerance"] - doubt
        if v["truth_kind"] == "exact":
            rest = v["tolerance"] - v["truth_uncertainty"] - SOUND * scale
            left_out = max(rest, 0) if v["omitted"] else 0
            band = min(band, SURELY * doubt + v["truth_uncertainty"] + left_out)
        return band, away
    rule = rules[v["finding"]]
    told = float(rule["largest_error"] or "inf") * scale
    if v["predicted"] is None:
        return told, away
    next_kind = "biased" if away + doubt <= v["tolerance"] else "wrong limit"
    if v["verdict"].endswith("as predicted") and next_kind not in rule["verdicts"].split("|"):
        told = min(told, SURELY * doubt + KNOWN * abs(v["predicted"]))
    return told, abs(v["limit"] - v["predicted"])


def moved_of(v):
    """Returns the allowed difference of the limit from the committed limit, or infinity if there is no committed
    limit or an exact reference value checks the limit as closely."""
    if v["point"] != "default" or v["limit"] is None or v["verdict"] in UNJUDGED:
        return math.inf
    slack = MOVED * max(abs(v["limit"]), scale_of(v))
    close = v["verdict"] in CLOSELY and v["truth_kind"] == "exact" and (
        SURELY * (v["limit_uncertainty"] or 0) + v["truth_uncertainty"] <= slack
    )
    return math.inf if close else slack


def relative(v, values):
    """Returns ({constant: derivative of the value with respect to the size of a fault}, error of the value) for a
    verdict, from its coarse meshes. Derivatives and error are relative to the value. Returns None if the coarse meshes
    have no value."""
    key, size = key_of(v), max(abs(v["limit"]), scale_of(v))
    whole, changes = values[0].get(key), {}
    if whole is None or size == 0:
        return None
    for constant, faulty in values[1].items():
        change = (faulty[key] - whole if faulty.get(key) is not None else 0) / max(abs(whole), scale_of(v))
        if abs(change) > CHANGED:
            changes[constant] = change / SIZE
    return changes, abs(whole - v["limit"]) / size


def derivatives(verdicts, values):
    """Returns [(verdict, {constant: |derivative| of the limit})] from the values on the coarse meshes. If these values
    are missing or have large errors, the values of the nearest formulation are used."""
    own, best = [(v, relative(v, values)) for v in verdicts], {}
    for v, known in own:
        if known is not None and known[1] < best.get(v["point"], ({}, math.inf))[1]:
            best[v["point"]] = known
    for v, known in own:
        slopes, nearest = (known or ({}, math.inf)), best.get(v["point"], ({}, math.inf))[0]
        slopes, off = slopes
        if off > NEAR:
            slopes = {c: s for c, s in nearest.items() if known is None or c in slopes} or slopes
        size = max(abs(v["limit"]), scale_of(v))
        yield v, {c: abs(slope) * size for c, slope in slopes.items()}


@dataclass(frozen=True)
class Notice:
    """The smallest fault in a constant that a verdict detects in one of the two ways; inf: it detects none."""

    size: float
    slope: float
    door: str
    constant: str
    verdict: dict

    def __lt__(self, other):
        return self.size < other.size


def notices(v, slopes, rules):
    band, away = band_of(v, rules)
    slack, found = moved_of(v), []
    for constant, slope in slopes.items():
        found.append(Notice((band + away) / slope, slope, "verdict", constant, v))
        found.append(Notice(slack / slope, slope, "baseline", constant, v))
    return found


def weakest(found, formulations):
    """Returns the largest of the smallest faults that are detected for each formulation, as a Notice."""
    best = {key: None for key in formulations}
    for one in found:
        key = one.verdict["formulation"]
        if math.isfinite(one.size) and (best[key] is None or one < best[key]):
            best[key] = one
    if not best or None in best.values():
        return None
    return max(best.values())


def digits(size):
    if size is None or not math.isfinite(size):
        return ""
    power = math.floor(math.log10(max(size, LEAST))) - 1
    return "%.1e" % (math.ceil(max(size, LEAST) / 10**power - 1e-9) * 10**power)


def passes(text):
    return not text or float(text) > WANTED


def reason_of(verdicts, noticed):
    """Returns the reason why a fault of 0.1 % in every constant remains undetected for a formulation."""
    if noticed is not None:
        part = noticed.slope * WANTED / scale_of(noticed.verdict)
        return f"0.1 % of a constant changes it by {part:.0e} of itself at most ({noticed.constant})"
    if all(abs(v["limit"]) <= 1e-6 * scale_of(v) for v in verdicts):
        return "zero, by symmetry or as an error: no factor on a constant changes it"
    return "set by the geometry and what is prescribed: 0.1 % of a constant changes it by less than 1e-7 of its size"


def row_of(pair, verdicts, found):
    formulations = sorted({v["formulation"] for v in verdicts})
    noticed = weakest(found, formulations)
    alone = weakest([one for one in found if one.door == "verdict"], formulations)
    size = digits(noticed and noticed.size)
    return {
        "case": pair[0], "quantity": pair[1],
        "reference": " ".join(sorted({v["truth_kind"] for v in verdicts} - {""})),
        "noticed": size,
        "by": noticed.door if noticed else "",
        "constant": noticed.constant if noticed else "",
        "formulation": noticed.verdict["formulation"] if noticed else "",
        "parameters": noticed.verdict["parameters"] if noticed else "",
        "verdicts_alone": digits(alone and alone.size),
        "reason": reason_of(verdicts, noticed) if passes(size) else "",
    }  # yapf: disable


def fault_of(formulation, constant, found):
    by_verdicts = [one for one in found if one.door == "verdict" and math.isfinite(one.size)]
    best = min(by_verdicts, default=None)
    size, reason = digits(best and best.size), ""
    if not found:
        reason = "no requested value depends on the constant"
    elif passes(size):
        reason = "no verdict depends on the constant more closely"
    if reason and ":" in formulation:
        reason = "judged only where its option matters; see the formulation without the option"
    v = best.verdict if best else {"case": "", "parameters": "", "quantity": ""}
    return {
        "formulation": formulation, "constant": constant, "noticed": size, "case": v["case"],
        "parameters": v["parameters"], "quantity": v["quantity"], "reason": reason
    }  # yapf: disable


def tables(verdicts, rules, values):
    pairs, notes = {}, []
    for v in verdicts:
        pairs.setdefault((v["case"], v["quantity"]), []).append(v)
    rows = []
    for pair, own in sorted(pairs.items()):
        held = [v for v in own if math.isfinite(band_of(v, rules)[0]) or math.isfinite(moved_of(v))]
        found = [
            one for v, slopes in derivatives(held, values) for one in notices(v, slopes, rules)
        ]
        rows.append(row_of(pair, held, found))
        notes += found
    of = {}
    for one in notes:
        of.setdefault((one.verdict["formulation"], one.constant), []).append(one)
    formulations = sorted({formulation for formulation, _ in of})
    faults = [fault_of(f, c, of.get((f, c), [])) for f in formulations for c in CONSTANTS]
    return rows, faults


def write(path, columns, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        out = csv.DictWriter(file, columns, lineterminator="\n")
        out.writeheader()
        out.writerows(rows)


def read_verdicts(path, results):
    sizes = {}
    with open(path, encoding="utf-8") as file, h5py.File(results) as stored:
        verdicts = json.load(file)["verdicts"]
        for case in {v["case"] for v in verdicts}:
            for row in stored["cases"][case]["quantities"][()]:
                sizes[case, row["point"].decode(), row["quantity"].decode()] = float(row["near_zero"])
    return [{**v, "near_zero": sizes.get((v["case"], v["point"], v["quantity"]))} for v in verdicts]


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("planted")
    parser.add_argument("verdicts")
    parser.add_argument("results")
    parser.add_argument("ledger")
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("-p", "--planted-faults", required=True)
    given = parser.parse_args()
    verdicts = read_verdicts(given.verdicts, given.results)
    with open(given.ledger, newline="", encoding="utf-8") as file:
        rules = {rule["rule"]: rule for rule in csv.DictReader(file)}
    with tempfile.TemporaryDirectory() as folder:
        whole = planted_values(given.planted, folder, None)
        faulty = {c: planted_values(given.planted, folder, c) for c in CONSTANTS}
    rows, faults = tables(verdicts, rules, (whole, faulty))
    write(given.output, ROWS, rows)
    write(given.planted_faults, FAULTS, faults)
    count = sum(passes(r["noticed"]) for r in rows), sum(passes(r["verdicts_alone"]) for r in rows)
    print("%d quantities: a fault of 0.1 %% passes in %d; by verdicts alone in %d" % (len(rows), *count))
    print(
        "%d constants of formulations: %d are noticed at 0.1 %% by a verdict" %
        (len(faults), sum(not passes(f["noticed"]) for f in faults))
    )


if __name__ == "__main__":
    main()
