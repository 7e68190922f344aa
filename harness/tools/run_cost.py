"""Fits a formula, which predicts the cost of a run before it is solved, to the counted work of solved runs (`make lab
L=run-cost`; the file of the last `make verify`).

Cost [s] = sum over the kinds of work of an analysis of times * (once * o + element * e * elements), where elements are
those of all members together. `once` and `element` belong to the kind of work, the factors o and e to the formulation;
a formulation without a row has factors of one. The accuracy is measured on runs that were not used in the fit: the cases
are in five groups, and each group is predicted from the other four.
"""
import argparse
import collections
import math
import pathlib

import h5py
import numpy as np
import yaml
from scipy.optimize import nnls

# Kinds of work, with the names of harness/study/study.h.
WORK = ("cell", "linear", "buckling", "loaded_buckling", "modal", "load_step", "compliance",
        "continuation", "rotation_step", "rotation_station", "alpha_step", "conserving_step",
        "radau_step", "explicit_step")
FOLDS = 5
ROUNDS = 15
DEAR = 0.75
LARGE = 0.3  # error of the logarithm above which errors have less weight


def stations_of(analyses, body):
    """Returns the number of stations of the path of an analysis, or of the analysis that it follows."""
    while "stations" not in body and "about" in body:
        ((_, body),) = analyses[body["about"]].items()
        body = body or {}
    return len(body.get("stations", [1]))


def motion_steps(body):
    """Returns the number of steps of a motion, with the same rule as harness/study/run_cost.c."""
    tolerance, integrator = float(body.get("tolerance", 0)), body["integrator"]  # YAML reads 1e-05 as text
    if tolerance > 0 and integrator != "explicit":
        steps, power = (40, 0.3) if integrator == "radau" else (80, 0.45)
        return steps * (1e-4 / tolerance) ** power
    return math.ceil(float(body["stations"][-1]) / float(body["step"]) * (1 - 1e-9))


def work_of(scene):
    """Returns {kind of work: times} of a scene, and the number of its members."""
    analyses, times = scene.get("analyses") or {}, collections.Counter(cell=1)
    for analysis in analyses.values():
        ((kind, body),) = analysis.items()
        body = body or {}
        stations = stations_of(analyses, body)
        if kind == "static":
            times["load_step"] += stations + body.get("steps", 1) - 1
        elif kind == "rotation":
            times["rotation_step"] += stations + body.get("steps", 1) - 1
            times["rotation_station"] += stations
        elif kind == "compliance":
            times[kind] += stations
        elif kind == "motion":
            times[body["integrator"] + "_step"] += motion_steps(body)
        elif kind == "buckling":
            times["loaded_buckling" if "about" in body else kind] += 1
        else:
            times[kind] += 1
    return times, len(scene["members"])


def read(path):
    """Returns [{case, name, times, elements, cost, seconds}] of all runs, solved or failed, that have a cost and a
    time."""
    out = []
    with h5py.File(path) as file:
        for case, group in file["cases"].items():
            works = {row["point"]: work_of(yaml.safe_load(row["scene"].decode()))
                     for row in group["scenes"][()]}
            for row in group["cells"][()]:
                seconds = float(row["seconds_setup"] + row["seconds_solve"])
                if row["point"] not in works or row["cost"] <= 0 or seconds <= 0:
                    continue
                times, members = works[row["point"]]
                out.append({"case": case, "name": row["formulation"].decode().partition(":")[0],
                            "times": [times[kind] for kind in WORK], "seconds": seconds,
                            "elements": int(row["elements"]) * members, "cost": float(row["cost"])})
    return out


def columns_of(cells):
    return (np.array([c["times"] for c in cells], float),
            np.array([c["elements"] for c in cells], float), np.array([c["name"] for c in cells]))


def predict(cells, prices, factors):
    """Returns costs [s]. `prices`: cost coefficients [kinds, 2]; factors: {name: (once, element)}."""
    times, elements, names = columns_of(cells)
    factor = np.array([factors.get(name, (1.0, 1.0)) for name in names])
    return times @ prices[:, 0] * factor[:, 0] + times @ prices[:, 1] * elements * factor[:, 1]


def fit(cells):
    """Fits cost coefficients and factors alternately, by non-negative weighted least squares."""
    times, elements, names = columns_of(cells)
    cost = np.array([c["cost"] for c in cells])
    factors = {name: (1.0, 1.0) for name in sorted(set(names))}
    weight = base = cost**-DEAR
    for _ in range(ROUNDS):
        factor = np.array([factors[name] for name in names])
        matrix = np.hstack([times * factor[:, :1], times * (elements * factor[:, 1])[:, None]])
        found, _ = nnls(matrix * weight[:, None], cost * weight)
        prices = found.reshape(2, -1).T
        parts = np.column_stack([times @ prices[:, 0], times @ prices[:, 1] * elements])
        for name in factors:
            own = names == name
            pair, _ = nnls(parts[own] * weight[own, None], (cost * weight)[own])
            factors[name] = tuple(map(float, pair))
        off = np.abs(np.log(np.maximum(predict(cells, prices, factors), 1e-12) / cost))
        weight = base / np.sqrt(np.maximum(1, off / LARGE))
    # The mean of the factors is one, which is the value of a formulation without a row.
    mean = np.mean(list(factors.values()), axis=0)
    return prices * mean, {name: (o / mean[0], e / mean[1]) for name, (o, e) in factors.items()}


def spread(predicted, cost):
    """Returns two factors between prediction and cost, without the common factor: the median, and the factor that nine
    of ten runs do not exceed."""
    off = np.log(np.maximum(predicted, 1e-12) / cost)
    off = np.abs(off - np.median(off))
    return math.exp(np.quantile(off, 0.5)), math.exp(np.quantile(off, 0.9))


def validate(cells):
    cases, out = sorted({c["case"] for c in cells}), np.zeros(len(cells))
    for fold in range(FOLDS):
        left = set(cases[fold::FOLDS])
        found = fit([c for c in cells if c["case"] not in left])
        at = [i for i, c in enumerate(cells) if c["case"] in left]
        out[at] = predict([cells[i] for i in at], *found)
    return out


def write(path, cells):
    prices, factors = fit(cells)
    cost = np.array([c["cost"] for c in cells])
    said = [(name, *spread(predicted, against)) for name, predicted, against in (
        ("counted cost by expected", predict(cells, prices, factors), cost),
        ("of cases that took no part", validate(cells), cost),
        ("measured time by expected", predict(cells, prices, factors),
         np.array([c["seconds"] for c in cells])))]
    lines = [
        "# Expected seconds of a cell on the reference machine, written by `make lab L=run-cost`.",
        "# work: seconds for each time that it is due, once and for each element; formulation:"
        " factors of both.",
        f"# {len(cells)} cells of {len({c['case'] for c in cells})} cases; factor in the median,"
        " for nine of ten: " + "; ".join(f"{n} {a:.2f}, {b:.2f}" for n, a, b in said) + ".",
        "table,name,once,element"]
    lines += [f"work,{kind},{once:.3e},{element:.3e}"
              for kind, (once, element) in zip(WORK, prices)]
    lines += [f"formulation,{name},{once:.2f},{element:.2f}"
              for name, (once, element) in factors.items()]
    pathlib.Path(path).write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(lines[2])


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    arguments.add_argument("results", help="results of verify with all cases")
    arguments.add_argument("-o", "--output", required=True, help="output table (CSV)")
    r = arguments.parse_args()
    write(r.output, read(r.results))


if __name__ == "__main__":
    main()
