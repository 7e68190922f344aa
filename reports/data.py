"""Reads results.h5 and truths.h5 into plain records. `beamwork schema` describes the tables and columns of the files."""
import math
import multiprocessing

import h5py

from reports.records import Case, Clock, Dense, Kept, Mesh, Point, Series, Verdict


class Unreadable(Exception):
    """Raised for a file that is missing, damaged or of another kind. The message contains the name of the file."""


def text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


REACH = {0.1: "reach_10", 0.01: "reach_1", 0.001: "reach_0.1", 0.0001: "reach_0.01"}
SCHEMA, VERSIONS = "beamwork-results", (2, 3)
BENCH = "experiments/bench"  # group of the times, which version 2 stored in a separate file


def column(values):
    return [value.decode()
            for value in values.tolist()] if values.dtype.kind == "S" else values.tolist()


def rows(group, name):
    table = group[name][()]
    return [
        dict(zip(table.dtype.names, row))
        for row in zip(*(column(table[c]) for c in table.dtype.names))
    ]


def of_series(row):
    return row["point"], row["formulation"]


def of_mesh(row):
    return row["point"], row["formulation"], row["elements"]


def read_clock(row, prefix, setup, solve):
    if not row[f"{prefix}repeats"]:
        return None
    rounds = [row[f"{prefix}round_{i}"] for i in range(1, 6)]
    return Clock(row[setup], row[solve], min(rounds), max(rounds), row[f"{prefix}repeats"], rounds)


def read_timings(group, meshes):
    for row in rows(group, "timings"):
        mesh = meshes.get(of_mesh(row))
        if mesh is None:
            continue
        mesh.parts = {
            part: row[f"seconds_{part}"]
            for part in ("elements", "assembly", "factorisation", "solution")
        }
        if row["dense_unknowns"]:
            mesh.dense = Dense(row["dense_seconds"], row["dense_unknowns"], row["dense_whole"])
        mesh.clock = read_clock(row, "", "seconds_setup", "seconds_solve") or mesh.clock
        kept = read_clock(row, "keep_all_", "keep_all_setup", "keep_all_solve")
        mesh.kept = Kept(kept, row["keep_all_free"]) if kept else None


def read_cell(row):
    setup, solve = row["seconds_setup"], row["seconds_solve"]
    work = {name: float(value) for name, value in row.items() if isinstance(value, (int, float))}
    clock = Clock(setup, solve, setup + solve, setup + solve, 1)
    return Mesh(row["elements"], row["status"], row["reason"], clock, row["free"],
                row["iterations"],
                row["left_out"],
                work,
                cost=row.get("cost", math.nan),
                priced=row.get("priced", True),
                features=row.get("features", ""),
                warping=row.get("warping", ""))


def read_meshes(group):
    """Returns {(point, formulation, elements): Mesh} with the results of each mesh, and {point: {quantity: unit}}."""
    meshes, units = {of_mesh(row): read_cell(row) for row in rows(group, "cells")}, {}
    for row in rows(group, "quantities"):
        mesh, name = meshes[of_mesh(row)], row["quantity"]
        mesh.values[name], mesh.errors[name], mesh.model_errors[name] = row["value"], row[
            "error"], row["model_error"]
        mesh.reasons[name] = row["reason"]
        units.setdefault(row["point"], {})[name] = row["unit"]
        if math.isfinite(row["prediction"]):
            mesh.predictions[name] = row["prediction"]
    for row in rows(group, "verdicts"):  # these include points without a run
        units.setdefault(row["point"], {}).setdefault(row["quantity"], row["unit"])
    x, value = group["curve_x"][()], group["curve_value"][()]
    for row in rows(group, "curves"):
        part = slice(row["first"], row["first"] + row["points"])
        meshes[of_mesh(row)].curves[row["quantity"]] = (x[part], value[part], row["x_name"],
                                                        row["x_unit"], row["unit"])
    return meshes, units


def read_verdict(row):
    own = {name: row[name] for name in Verdict.__dataclass_fields__ if name != "reach"}
    return Verdict(**own, reach={level: row[name] for level, name in REACH.items() if row[name]})


def unranked(declared):
    """Returns the reason why a formulation has no rank, from its row of /declarations, or an empty string if the
    formulation has a rank."""
    if declared.get("differences"):
        return "by differences"
    if declared.get("misprint"):
        return "kept with its misprint"
    return "in another process" if declared.get("process") else ""


def mark(series, declared):
    """Adds the declarations of its formulation to a series. A series without a rank has no cost."""
    series.unranked, series.is_new = unranked(declared), bool(declared.get("is_new"))
    for mesh in series.meshes if series.unranked else []:
        mesh.cost = math.nan


def read_assumptions(group):
    found = {}
    for row in rows(group, "assumptions") if "assumptions" in group else []:
        found.setdefault(row["point"], []).append((row["kind"], row["text"]))
    return found


def read_points(group, meshes, units, noise):
    series, points = {}, []
    omitted = {row["point"]: row.get("omitted", "") for row in rows(group, "cells")}
    assumed = read_assumptions(group)
    for row in rows(group, "series"):
        series[of_series(row)] = Series(row["formulation"], row["summary"], row["source"],
                                        row["missing"], [], [], row.get("imported", ""),
                                        row.get("model", "beam"))
        series[of_series(row)].without = row.get("model_words", "")
        if row.get("other_model"):
            series[of_series(row)].other = row["not_modelled"]
    for (point, key, _), mesh in sorted(meshes.items()):
        series[point, key].meshes.append(mesh)
        if series[point, key].other:  # errors relative to the other model, so that the series is drawn; it is not ranked
            mesh.errors.update(mesh.model_errors)
    for row in rows(group, "verdicts"):
        series[of_series(row)].verdicts.append(read_verdict(row))
    for row in rows(group, "points"):
        own = sorted((s for (point, _), s in series.items() if point == row["point"]),
                     key=lambda s: s.key)
        ours, others = [s for s in own if not s.imported], [s for s in own if s.imported]
        points.append(
            Point(row["point"], row["parameters"], ours, units.get(row["point"], {}), others,
                  noise, omitted=omitted.get(row["point"], ""),
                  assumed=assumed.get(row["point"], [])))
    return sorted(points, key=lambda p: (p.name != "default", p.parameters))


def read_words(group, points):
    """Returns the rows that describe the parameters of the case, or [] if the file has no scenes. Stores the scene and
    the meanings of quantities in each point."""
    if "scenes" not in group:
        return []
    scenes = {row["point"]: row["scene"] for row in rows(group, "scenes")}
    meanings = {}
    for row in rows(group, "meanings"):
        meanings.setdefault(row["point"], {})[row["quantity"]] = row["meaning"]
    for point in points:
        point.scene, point.meanings = scenes[point.name], meanings.get(point.name, {})
    return rows(group, "parameters")


def root_of_bench(file):
    return file[BENCH] if BENCH in file else file


def of_root(file):
    return file


def read_case(path, name, bench=None, root=of_root):
    with h5py.File(path) as file:
        own = root(file)
        group = own["cases"][name]
        meshes, units = read_meshes(group)
        read_timings(group, meshes)
        declared = declarations_in(own)
        case = Case(name, text(group.attrs["summary"]), text(group.attrs["source"]),
                    read_points(group, meshes, units, float(own.attrs.get("cost_noise", 1))),
                    rows(group, "coverages"))
        case.parameters = read_words(group, case.points)
        for one in [s for p in case.points for s in p.series]:
            mark(one, declared.get(one.key, {}))
    if bench:
        read_bench(bench, name, meshes)
    return case


def read_bench(path, name, meshes):
    with h5py.File(path) as file:
        cases = root_of_bench(file)["cases"]
        if name in cases:
            read_timings(cases[name], meshes)


def read_about(path, root=of_root):
    try:
        with h5py.File(path) as file:
            if text(file.attrs.get("schema", "")) != SCHEMA:
                raise Unreadable(
                    f"{path}: not a results file; 'make verify' and 'make bench' write them")
            if file.attrs["schema_version"] not in VERSIONS:
                raise Unreadable(
                    f"{path}: the results have version {file.attrs['schema_version']}, but the report reads versions {VERSIONS[0]} to {VERSIONS[-1]}; write the file again with 'make verify' or 'make bench'"
                )
            return {name: text(value) for name, value in root(file).attrs.items()}
    except OSError as why:
        raise Unreadable(
            f"{path}: cannot be read ({why}); 'make verify' and 'make bench' write build/results.h5"
        ) from why


def read_results(path, bench=None):
    """Returns (environment, [Case]). Cases are read in parallel."""
    environment = read_about(path)
    try:
        with h5py.File(path) as file:
            names = list(file["cases"])
        with multiprocessing.get_context("fork").Pool() as pool:
            return environment, pool.starmap(read_case, [(path, name, bench) for name in names],
                                             chunksize=1)
    except (OSError, KeyError, ValueError) as why:
        raise Unreadable(f"{path}: cannot be read ({why}); 'make verify' writes it") from why


def holds(parameters, at):
    """Returns True if a reference value with these parameters applies at a point. Both arguments are `name=value;...`.
    `parameters` must contain every parameter of the point; a value of `*` stands for any value."""
    said = dict(item.split("=", 1) for item in parameters.split(";") if item)
    there = dict(item.split("=", 1) for item in at.split(";") if item)
    return all(value == "*" or there.get(name) == value
               for name, value in said.items()) and all(name in said for name in there)


def read_other_model(path, case, parameters, quantity):
    """Returns the value of another model (plate, solid) at a parameter point, or NaN."""
    with h5py.File(path) as file:
        table = file["truths"].get(case)
        names = ("parameters", "quantity", "model", "formulation")
        rows = zip(*([text(v) for v in table[name]] for name in names)) if table else ()
        for i, (at, of, model, formulation) in enumerate(rows):
            if model == "other" and not formulation and of == quantity and holds(at, parameters):
                return float(table["value"][i])
    return math.nan


def columns_of(table):
    return {name: column(table[name]) for name in table.dtype.names}


def read_rules(path):
    """Returns [{column: value}] of the list of known deviations (reference/findings.csv), which is packed with the
    reference values."""
    try:
        with h5py.File(path, driver="core", backing_store=False) as file:
            columns = columns_of(file["findings"])
    except (OSError, KeyError) as why:
        raise Unreadable(f"{path}: cannot be read ({why}); 'make all' packs it") from why
    return [dict(zip(columns, row)) for row in zip(*columns.values())]


def declarations_in(file):
    """Returns {formulation: row of /declarations}, or {} if the results were stored without declarations."""
    found = rows(file, "declarations") if "declarations" in file else []
    return {row["formulation"]: row for row in found}


def read_declarations(path):
    with h5py.File(path) as file:
        return declarations_in(file)


def read_glossary(path):
    """Returns [{column: string}] of the glossary packed with the reference values, or [] if there is none."""
    try:
        with h5py.File(path, driver="core", backing_store=False) as file:
            if "glossary" not in file:
                return []
            columns = columns_of(file["glossary"])
    except OSError as why:
        raise Unreadable(f"{path}: cannot be read ({why}); 'make all' packs it") from why
    return [dict(zip(columns, row)) for row in zip(*columns.values())]


def read_truth_counts(path):
    try:
        with h5py.File(path, driver="core", backing_store=False) as file:
            counts = {}
            for table in file["truths"].values():
                for kind in table["kind"]:
                    counts[text(kind)] = counts.get(text(kind), 0) + 1
            return counts
    except (OSError, KeyError) as why:
        raise Unreadable(f"{path}: cannot be read ({why}); 'make all' packs it") from why



def truths_of(point):
    return {v.quantity: v.truth for s in point.series for v in s.verdicts if math.isfinite(v.truth)}


def with_errors(series, truths):
    """Returns the series of another program with errors relative to the reference values of beamwork. If the series
    belongs to another model than a beam, they are stored as model errors."""
    for mesh in series.meshes:
        into = mesh.errors if series.model == "beam" else mesh.model_errors
        for quantity, value in mesh.values.items():
            if truths.get(quantity) and math.isfinite(value):
                into[quantity] = value / truths[quantity] - 1
    return series


def add_beside(cases, path):
    """Adds the imported series of a file to the points of the results, except those whose names already exist."""
    with h5py.File(path) as file:
        names = set(file["cases"])
    for case in cases:
        if case.name not in names:
            continue
        found = {p.parameters: p.others for p in read_case(path, case.name).points}
        for point in case.points:
            known = {s.key for s in point.others}
            new = [s for s in found.get(point.parameters, []) if s.key not in known]
            point.others += [with_errors(s, truths_of(point)) for s in new]


def beside_named(point, key):
    return next((s for s in point.others if s.key == key), None)


def style_beside(index):
    return {
        "color": "currentColor", "marker": "sDv^<>ph"[index % 8], "hollow": True,
        "linestyle": (0, (1, 1)), "linewidth": 1, "markersize": 6, "alpha": 0.85 - 0.08 * (index % 8)
    }


def rows_beside(point):
    """Returns [(series of another program, verdict or None, quantity, finest mesh with a value)] for a table."""
    out = []
    for series in point.others:
        judged = {v.quantity: v for v in series.verdicts}
        names = dict.fromkeys(
            q for m in series.meshes for q, value in m.values.items() if math.isfinite(value))
        for quantity in names:
            mesh = max(
                (m for m in series.meshes if math.isfinite(m.values.get(quantity, math.nan))),
                key=lambda m: m.n)
            out.append((series, judged.get(quantity), quantity, mesh))
    return out
