"""Fits cost coefficients of counted work to measured times (`make lab L=cost-coefficients`).

The defaults of every case run several times in one process, with the formulations alternating; the shortest time of a
run counts. Cost coefficients are fitted by non-negative least squares of relative errors; large errors count less.
Their accuracy is measured on runs that were not used in the fit: the cases are in five groups, and each group is
predicted from the other four. The noise is the smallest ratio of two costs from which nine of ten pairs of formulations
have measured times in the order of their costs.
"""
import argparse
import collections
import math
import pathlib
import subprocess
import tempfile

import h5py
import numpy as np
from scipy.optimize import nnls

# General coefficients, followed by coefficients for each formulation. They are multiplied by products of columns of the
# table `cells`.
SHARED = ("one", "free", "load_steps", "load_steps*elements_total", "factorisations*free",
          "factor_flops", "solutions", "solutions*free", "solutions*factor_entries",
          "dense_operations")
OWN = ("element_kinds", "elements_total", "strain_evaluations", "stress_evaluations",
       "inertia_evaluations", "geometric_evaluations")
ANY = OWN + ("strain_evaluations*strains", "stress_evaluations*strains",
             "geometric_evaluations*strains")
# Options that change the work of an element. Other options do not change the coefficients of a formulation.
OPTIONS = ("torsion", "stages", "nodes", "inside")
VARIANTS = ("collocation:stages=3", "collocation:stages=4", "collocation:stages=6",
            "collocation:stages=7", "collocation:stages=8", "geometrically_exact:nodes=2",
            "geometrically_exact:nodes=3", "beamw_consistent:torsion=hyperbolic",
            "beamw_consistent:inside=linear")
FOLDS = 5
NEAR = 3  # runs of a case are compared if the ratio of their times is within this factor
STEP = 1.05  # factor between the ratios at which the fraction of correct orders is determined


def name_of(key):
    """Returns the formulation with only those options that have separate cost coefficients."""
    name, _, options = key.partition(":")
    kept = [o for o in options.split(",") if o.partition("=")[0] in OPTIONS]
    return name + (":" + ",".join(kept) if kept else "")


def measure(program, folder, runs, selection):
    variants = [a for v in VARIANTS for a in ("-f", v)]
    for i in range(runs):
        for kind, chosen in (("all", []), ("variants", variants)):
            path = folder / f"{i}.{kind}.h5"
            subprocess.run([program, "verify", "--built-in", "--scene", "cases/examples", "-k",
                            selection, "-j", "1", *chosen, "-o", path], check=False,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return sorted(folder.glob("*.h5"))


def read(paths):
    least = {}
    for path in paths:
        with h5py.File(path) as file:
            for case, group in file["cases"].items():
                table = group["cells"][()]
                names = [n for n in table.dtype.names if table.dtype[n].kind in "biuf"]
                for row in table:
                    if row["status"] != b"ok":
                        continue
                    key = case, row["point"], row["formulation"], int(row["elements"])
                    seconds = float(row["seconds_setup"] + row["seconds_solve"])
                    cell = least.setdefault(key, {n: float(row[n]) for n in names} | {
                        "one": 1.0, "case": case, "seconds": seconds,
                        "name": name_of(row["formulation"].decode())})
                    cell["seconds"] = min(cell["seconds"], seconds)
    return [least[key] for key in sorted(least)]


def product(cells, count):
    return np.prod([[c[factor] for c in cells] for factor in count.split("*")], axis=0)


def columns_of(cells, names):
    """Returns {(formulation, count): values}. An empty name stands for all formulations."""
    own = np.array([c["name"] for c in cells])
    out = {("", count): product(cells, count) for count in SHARED}
    if not names:
        out.update({("*", count): product(cells, count) for count in ANY})
    for name in names:
        out.update({(name, count): np.where(own == name, product(cells, count), 0)
                    for count in OWN})
    return out


def fit(cells, names, fixed=None):
    """Returns {(formulation, count): seconds}. Coefficients in `fixed` do not change."""
    found = columns_of(cells, names)
    fixed = fixed or {}
    known = sum((price * found.pop(k) for k, price in fixed.items() if k in found),
                np.zeros(len(cells)))
    matrix = np.array(list(found.values())).T
    seconds = np.array([c["seconds"] for c in cells])
    weight = 1 / seconds
    size = np.maximum(np.linalg.norm(matrix * weight[:, None], axis=0), 1e-300)
    for _ in range(40):
        price = nnls(matrix / size * weight[:, None], np.maximum(seconds - known, 0) * weight)[0]
        predicted = np.maximum(matrix @ (price / size) + known, 1e-9)
        off = np.abs(np.log(predicted / seconds))
        weight = 1 / np.sqrt(predicted * seconds) / np.sqrt(1 + off / 0.1)
    return {**fixed, **{k: float(p) for k, p in zip(found, price / size) if p > 0}}


def predict(cells, prices, names):
    found = columns_of(cells, names)
    return sum(price * found[key] for key, price in prices.items() if key in found)


def quantile(values, part):
    return math.exp(float(np.quantile(np.abs(values), part)))


def pairs(cells, predicted):
    """Returns the logarithms of the (predicted, measured) ratios of the times of two formulations in a case, for all
    pairs with measured times within a factor NEAR. The predicted logarithms are positive."""
    groups, out = collections.defaultdict(list), []
    for i, cell in enumerate(cells):
        groups[cell["case"]].append(i)
    cost, time = np.log(predicted), np.log([c["seconds"] for c in cells])
    for group in groups.values():
        for a in group:
            for b in group:
                if cells[a]["name"] != cells[b]["name"] and cost[a] > cost[b] and \
                        abs(time[a] - time[b]) < math.log(NEAR):
                    out.append((cost[a] - cost[b], time[a] - time[b]))
    return np.array(out).T


def noise_of(predicted, measured):
    """Returns the smallest cost ratio from which the measured times of nine of ten pairs are in the order of their
    costs."""
    edge = math.log(STEP)
    for k in range(int(math.log(NEAR) / edge), 0, -1):
        here = (predicted >= (k - 1) * edge) & (predicted < k * edge)
        if np.mean(measured[here] > 0) < 0.9:
            return STEP**k
    return 1.0


def validate(cells, names):
    """Returns two predictions of every run: from cost coefficients that were fitted without its case, and from general
    cost coefficients that were fitted without its formulation."""
    cases = sorted({c["case"] for c in cells})
    own, generic = np.zeros(len(cells)), np.zeros(len(cells))
    for fold in range(FOLDS):
        out = set(cases[fold::FOLDS])
        rest = [c for c in cells if c["case"] not in out]
        at = [i for i, c in enumerate(cells) if c["case"] in out]
        left = [cells[i] for i in at]
        own[at] = predict(left, fit(rest, names), names)
    for name in sorted({n.partition(":")[0] for n in names}):
        rest = [c for c in cells if c["name"].partition(":")[0] != name]
        at = [i for i, c in enumerate(cells) if c["name"].partition(":")[0] == name]
        generic[at] = predict([cells[i] for i in at], fit(rest, []), [])
    return own, generic


def write(path, cells, names, runs):
    """Writes the table."""
    own, generic = validate(cells, names)
    seconds = np.array([c["seconds"] for c in cells])
    cost, time = pairs(cells, own)
    noise = noise_of(cost, time)
    prices = fit(cells, names)
    any_prices = fit(cells, [], {k: p for k, p in prices.items() if k[0] == ""})
    said = [
        "# Seconds of one count on the reference machine, written by `make lab L=cost-coefficients`. Count: a column"
        " of the table `cells`, or a product of two.",
        "# formulation empty: of all; *: of those without cost coefficients of their own; `;` between options.",
        f"# {len(cells)} cells of {len({c['case'] for c in cells})} cases, least of {runs} runs;"
        " predicted by measured time, of cases that took no part: factor"
        f" {quantile(np.log(own / seconds), 0.5):.2f} in the median,"
        f" {quantile(np.log(own / seconds), 0.9):.2f} for nine of ten.",
        f"# Ratios of two formulations of a case, times within a factor {NEAR}:"
        f" {quantile(cost - time, 0.5):.2f} in the median, {quantile(cost - time, 0.9):.2f} for nine"
        f" of ten; from a ratio of {noise:.2f} on nine of ten are measured in that order: the noise.",
        "# By the cost coefficients of any formulation (*), of formulations that took no part:"
        f" {quantile(np.log(generic / seconds), 0.5):.2f} in the median,"
        f" {quantile(np.log(generic / seconds), 0.9):.2f} for nine of ten.",
        "formulation,count,seconds",
    ]
    for (name, count), price in sorted({**any_prices, **prices}.items()):
        said.append(f"{name.replace(',', ';')},{count},{price:.3e}")
    said.append(f"noise,,{noise:.2f}")
    pathlib.Path(path).write_text("\n".join(said) + "\n", encoding="utf-8")
    print("\n".join(line for line in said if line.startswith("# ")))


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    arguments.add_argument("program")
    arguments.add_argument("-o", "--output", required=True, help="output table (CSV)")
    arguments.add_argument("-n", "--runs", type=int, default=9)
    arguments.add_argument("-k", "--select", default="default")
    arguments.add_argument("--from", dest="given", nargs="*", help="files of previous runs")
    r = arguments.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        paths = r.given or measure(r.program, pathlib.Path(folder), r.runs, r.select)
        cells = read(paths)
    names = sorted({c["name"] for c in cells})
    write(r.output, cells, names, r.runs)


if __name__ == "__main__":
    main()
