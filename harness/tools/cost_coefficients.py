"""Fits cost coefficients of counted work to measured times (`make lab L=cost-coefficients`).

The runs of SAMPLE are measured several times; the shortest processor time of a run counts. The sample contains all
cases and examples at their default points, all integrators, options of formulations, and meshes of up to 10000
elements. Cost coefficients are fitted by non-negative least squares of relative errors; large errors count less. The
coefficients of a formulation tend to the general ones (*) where the sample does not determine them.

The accuracy is measured for each kind of analysis, on runs that were not used in the fit: those of CHECK, which are
other cases, integrators and numbers of elements, and those of the sample, whose cases are in five groups, each of
which is predicted from the other four. Costs are compared with times up to a common factor, the speed of the machine.
The noise is the smallest ratio of two costs from which nine of ten pairs of formulations have measured times in the
order of their costs.
"""
import argparse
import collections
import math
import pathlib
import subprocess
import tempfile

import h5py
import numpy as np
import yaml
from scipy.optimize import nnls

# General coefficients, followed by coefficients for each formulation, of columns of the table `cells`
SHARED = ("one", "elements_total", "load_steps", "factor_flops", "solutions", "solved_entries",
          "dense_operations")
OWN = ("element_kinds", "strain_evaluations", "stress_evaluations", "inertia_evaluations",
       "geometric_evaluations")
# Options that change the work of an element. Other options do not change the coefficients of a formulation.
OPTIONS = ("torsion", "stages", "nodes", "inside")
VARIANTS = ("collocation:stages=3", "collocation:stages=4", "collocation:stages=6",
            "collocation:stages=8", "geometrically_exact:nodes=2", "geometrically_exact:nodes=3",
            "beamw_consistent:torsion=hyperbolic", "beamw_consistent:inside=linear")
FEW = ("beamw", "sheet_third", "geometrically_exact", "collocation")
SOME = FEW + ("beamw_consistent", "sheet_second")
INTEGRATORS = ("alpha", "conserving", "explicit", "radau")
# Case with options, numbers of elements, formulations (none: all), integrators (none: that of the case)
LARGER = (("free_flight_space", "2,6", (), INTEGRATORS[:3]),
          ("leaf_guide -s time=0.005", "1,4", SOME, INTEGRATORS[:2]),
          ("release -s time=0.05", "1,4", SOME, INTEGRATORS[:3]),
          ("c_cantilever_spin_up -s time=0.05", "2", SOME, INTEGRATORS[:3]),
          ("elastica", "64,1000", (), ()), ("sheet_cantilever", "64,1000", (), ()),
          ("c_column", "64,1000", (), ()), ("elastica", "10000", FEW, ()),
          ("sheet_cantilever", "10000", FEW, ()))
CHECK = (("pendulum", "3", SOME, INTEGRATORS), ("elbow", "3", SOME, INTEGRATORS),
         ("free_flight_plane", "3", SOME, INTEGRATORS),
         ("spin_up", "3", SOME, ("alpha", "radau"))) + tuple(
             (case, "100,300", SOME, ())
             for case in ("c_cantilever", "shear_elastica", "sheet_cantilever", "spherical_joint",
                          "loaded_cantilever", "right_angle_frame", "unsymmetric_column",
                          "lateral_buckling")) + (("c_cantilever", "3000", FEW, ()),
                                                  ("bend_45", "3000", FEW, ()),
                                                  ("c_column", "3000", FEW, ()))
FOLDS = 5
NEAR = 3  # runs of a case are compared if the ratio of their times is within this factor
STEP = 1.05  # factor between the ratios at which the fraction of correct orders is determined
WITHIN = 2  # factor between cost and time that nine of ten runs of a kind of analysis must not exceed
PRIOR = 0.3  # weight of the general coefficients in the fit of those of a formulation, in runs


def name_of(key):
    """Returns the formulation with only those options that have separate cost coefficients."""
    name, _, options = key.partition(":")
    kept = [o for o in options.split(",") if o.partition("=")[0] in OPTIONS]
    return name + (":" + ",".join(kept) if kept else "")


def kind_of(scene):
    """Returns the kind of the analysis that takes most of the work of a scene."""
    found = set()
    for analysis in (scene.get("analyses") or {}).values():
        ((kind, body),) = analysis.items()
        found.add(body["integrator"] + " motion" if kind == "motion" else kind)
    for kind in [i + " motion" for i in INTEGRATORS] + ["continuation", "rotation"]:
        if kind in found:
            return kind
    if {"static", "compliance"} <= found:
        return "static and compliance"
    for kind in ("static", "harmonic", "buckling", "modal", "compliance", "linear"):
        if kind in found:
            return kind
    return "none"


def runs_of(rows):
    for case, elements, formulations, integrators in rows:
        chosen = [a for f in formulations for a in ("-f", f)]
        for integrator in integrators or [None]:
            given = ["-s", "integrator=" + integrator] if integrator else []
            yield ["converge", *case.split(), "-n", elements, *given, *chosen]


def sample():
    default = ["verify", "--built-in", "--scene", "cases/examples", "-k", "default"]
    return [default, default + [a for v in VARIANTS for a in ("-f", v)], *runs_of(LARGER)]


def measure(program, folder, count):
    """Runs the sample and the runs of CHECK `count` times. Returns the folder of their results."""
    for k in range(count):
        for name, runs in (("sample", sample()), ("check", list(runs_of(CHECK)))):
            for i, run in enumerate(runs):
                subprocess.run([program, *run, "-j", "1", "-o", folder / f"{name}.{k}.{i}.h5"],
                               check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return folder


def read(paths):
    """Returns the solved runs, each with its shortest time."""
    least = {}
    for path in paths:
        with h5py.File(path) as file:
            at = "cases" if "cases" in file else "experiments/converge/cases"
            for case, group in file[at].items():
                kinds = {row["point"]: kind_of(yaml.safe_load(row["scene"].decode()))
                         for row in group["scenes"][()]}
                table = group["cells"][()]
                names = [n for n in table.dtype.names if table.dtype[n].kind in "biuf"]
                for row in table:
                    if row["status"] != b"ok":
                        continue
                    key = case, row["point"], row["formulation"], int(row["elements"])
                    seconds = float(row["seconds_setup"] + row["seconds_solve"])
                    cell = least.setdefault(key, {n: float(row[n]) for n in names} | {
                        "one": 1.0, "case": case, "seconds": seconds, "kind": kinds[row["point"]],
                        "name": name_of(row["formulation"].decode())})
                    cell["seconds"] = min(cell["seconds"], seconds)
    return [least[key] for key in sorted(least)]


def columns_of(cells, names):
    """Returns {(formulation, count): values}. An empty name stands for all formulations."""
    own = np.array([c["name"] for c in cells])
    counts = {count: np.array([c[count] for c in cells]) for count in SHARED + OWN}
    out = {("", count): counts[count] for count in SHARED}
    for name in names or ["*"]:
        out.update({(name, count): np.where(own == name, counts[count], 0) if names else counts[count]
                    for count in OWN})
    return out


def fit(cells, names, fixed=None):
    """Returns {(formulation, count): seconds}. Coefficients in `fixed` do not change. The coefficients of names tend to
    the general ones, which are fitted first."""
    general = fit(cells, []) if names else {}
    found = columns_of(cells, names)
    fixed = fixed or {}
    known = sum((price * found.pop(k) for k, price in fixed.items() if k in found),
                np.zeros(len(cells)))
    matrix = np.array(list(found.values())).T
    seconds = np.array([c["seconds"] for c in cells])
    share = collections.Counter(c["kind"] for c in cells)
    kind = np.array([share[c["kind"]] for c in cells])**-0.5  # kinds with few runs count more
    kind /= np.mean(kind)
    weight = kind / seconds
    size = np.maximum(np.linalg.norm(matrix * weight[:, None], axis=0), 1e-300)
    prior = np.array([general.get(("*", count), 0.0) if name else 0.0 for name, count in found])
    drawn = math.sqrt(PRIOR) * np.diag(1 / (np.where(prior > 0, prior, np.inf) * size))[prior > 0]
    for _ in range(40):
        price = nnls(np.vstack([matrix / size * weight[:, None], drawn]),
                     np.concatenate([np.maximum(seconds - known, 0) * weight,
                                     np.full(len(drawn), math.sqrt(PRIOR))]))[0]
        predicted = np.maximum(matrix @ (price / size) + known, 1e-9)
        off = np.abs(np.log(predicted / seconds))
        weight = kind / np.sqrt(predicted * seconds) / np.sqrt(1 + off / 0.1)
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


def by_kind(cells, predicted):
    """Returns {kind of analysis: (runs, median of cost by time, fraction of runs within the factor WITHIN)}, up to the
    common factor of all runs."""
    off = np.log(np.maximum(predicted, 1e-12) / np.array([c["seconds"] for c in cells]))
    off -= np.median(off)
    kinds = np.array([c["kind"] for c in cells])
    return {kind: (int(np.sum(kinds == kind)), math.exp(float(np.median(off[kinds == kind]))),
                   float(np.mean(np.abs(off[kinds == kind]) <= math.log(WITHIN))))
            for kind in sorted(set(kinds))}


def write(path, cells, check, runs):
    """Writes the table. Prints the accuracy for each kind of analysis."""
    names = sorted({c["name"] for c in cells})
    own, generic = validate(cells, names)
    seconds = np.array([c["seconds"] for c in cells])
    cost, time = pairs(cells, own)
    noise = noise_of(cost, time)
    prices = fit(cells, names)
    any_prices = fit(cells, [], {k: p for k, p in prices.items() if k[0] == ""})
    told = [("sample", by_kind(cells, own)), ("check", by_kind(check, predict(check, prices, names)))]
    said = [
        "# Seconds of one count on the reference machine, written by `make lab L=cost-coefficients`. Count: a column"
        " of the table `cells`.",
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
        f"# Fractions of runs that took no part, whose cost is within a factor {WITHIN} of the time, by kind of"
        " analysis:",
    ]
    for label, table in told:
        said += [f"# {label}: {kind}: {count} runs, median {median:.2f}, within {within:.3f}"
                 for kind, (count, median, within) in table.items()]
    said.append("formulation,count,seconds")
    for (name, count), price in sorted({**any_prices, **prices}.items()):
        said.append(f"{name.replace(',', ';')},{count},{price:.3e}")
    said.append(f"noise,,{noise:.2f}")
    pathlib.Path(path).write_text("\n".join(said) + "\n", encoding="utf-8")
    print("\n".join(line for line in said if line.startswith("# ")))


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    arguments.add_argument("program")
    arguments.add_argument("-o", "--output", required=True, help="output table (CSV)")
    arguments.add_argument("-n", "--runs", type=int, default=5)
    arguments.add_argument("--from", dest="given", help="folder with files of a previous measurement")
    arguments.add_argument("--keep", help="folder for the files of this measurement")
    r = arguments.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        at = pathlib.Path(r.given) if r.given else \
            measure(r.program, pathlib.Path(r.keep or folder), r.runs)
        cells, check = (read(sorted(at.glob(f"{name}.*.h5"))) for name in ("sample", "check"))
    write(r.output, cells, check, r.runs)


if __name__ == "__main__":
    main()
