"""Reads results.h5 and truths.h5 into plain records. The schema is described in harness/README.md and reference/README.md."""
import math
import multiprocessing
from dataclasses import dataclass, field

import h5py
import numpy as np


class Unreadable(Exception):
    """A file that is missing, damaged or of another kind; the text names it."""


@dataclass
class Clock:
    """Time of a cell: least of all repetitions, and the least and the greatest round; of a single run all three are the same."""
    setup: float
    solve: float
    least: float
    most: float
    repeats: int
    rounds: tuple = ()


@dataclass
class Kept:
    """The same cell with nothing left out."""
    clock: Clock
    free: int


@dataclass
class Dense:
    """The same cell by the published algorithm (newton=dense). whole: a run was timed, not one iteration times their number."""
    seconds: float
    unknowns: int
    whole: bool


@dataclass
class Mesh:
    """One cell: a formulation on one mesh."""
    n: int
    status: str
    reason: str
    clock: Clock
    free: int
    iterations: int
    left_out: str
    work: dict                                   # counter -> number
    values: dict = field(default_factory=dict)   # quantity -> value
    errors: dict = field(default_factory=dict)   # quantity -> relative error of discretisation
    model_errors: dict = field(default_factory=dict)
    reasons: dict = field(default_factory=dict)  # quantity -> why it has no value
    curves: dict = field(default_factory=dict)   # quantity -> (x, value, x name, x unit, unit)
    kept: Kept = None
    parts: dict = field(default_factory=dict)   # part of Newton's iterations -> seconds
    dense: Dense = None
    predictions: dict = field(default_factory=dict)   # quantity -> value of an analytic model

    @property
    def seconds(self):
        return self.clock.least


@dataclass
class Verdict:
    """One line of the judge."""
    quantity: str
    verdict: str
    expected: str
    kind: str
    reason: str
    proof: str
    source: str
    truth: float
    limit: float
    order: float
    error: float
    model_truth: float
    model_error: float
    tolerance: float
    reach: dict   # level -> elements of the coarsest mesh from which on every mesh is within it


@dataclass
class Series:
    """One formulation at one parameter point."""
    key: str
    summary: str
    source: str
    missing: str
    meshes: list
    verdicts: list


@dataclass
class Point:
    """One parameter point of a case."""
    name: str
    parameters: str
    series: list
    units: dict


@dataclass
class Case:
    """A case with all its parameter points."""
    name: str
    summary: str
    source: str
    points: list


def text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


COUNTERS = ("strain_evaluations", "stress_evaluations", "inertia_evaluations", "iterations", "load_steps", "rejected_steps", "factorisations", "solutions", "factor_entries", "factor_flops")
REACH = {0.1: "reach_10", 0.01: "reach_1", 0.001: "reach_0.1", 0.0001: "reach_0.01"}


def attributes(group, *names):
    """Values of attributes, without what h5py does beyond (it matters for thousands of cells)."""
    out = []
    for name in names:
        item = h5py.h5a.open(group.id, name.encode())
        value = np.empty((), item.dtype)
        item.read(value)
        out.append(value[()])
    return out


class Rows:
    """Reads tables that all have the type of the first one, which h5py would work out again for each."""

    def __init__(self):
        self.type = self.memory = None

    def read(self, group, name):
        table = h5py.h5d.open(group.id, name)
        if self.type is None:
            self.type = h5py.Dataset(table).dtype
            self.memory = h5py.h5t.py_create(self.type)
        out = np.empty(table.shape, self.type)
        if out.size:
            table.read(h5py.h5s.ALL, h5py.h5s.ALL, out, self.memory)
        return out.tolist()


QUANTITIES = Rows()


def read_clock(row, prefix):
    if not row[f"{prefix}repeats"]:
        return None
    rounds = [row[f"{prefix}round_{i}"] for i in range(1, 6)]
    return Clock(row[f"{prefix}setup"], row[f"{prefix}solve"], min(rounds), max(rounds), int(row[f"{prefix}repeats"]), rounds)


def read_timing(series, table):
    """Replaces the times of single runs by those of a benchmark."""
    columns = text(table.attrs["columns"]).split()
    rows = {int(row[0]): dict(zip(columns, row)) for row in table[()].tolist()}
    for mesh in series.meshes:
        clock = read_clock(rows[mesh.n], "") if mesh.n in rows else None
        kept = read_clock(rows[mesh.n], "all_") if mesh.n in rows else None
        if mesh.n not in rows:
            continue
        mesh.parts = {name[:-5]: value for name, value in rows[mesh.n].items() if name.endswith("_part")}
        if rows[mesh.n]["dense_unknowns"]:
            mesh.dense = Dense(rows[mesh.n]["dense_seconds"], int(rows[mesh.n]["dense_unknowns"]), bool(rows[mesh.n]["dense_whole"]))
        mesh.clock = clock or mesh.clock
        mesh.kept = Kept(kept, int(rows[mesh.n]["all_free"])) if kept else None


def read_curves(mesh, group):
    for name, item in group.items():
        x, value = item["x"], item["value"]
        mesh.curves[name] = (x[()], value[()], text(x.attrs["name"]), text(x.attrs["unit"]), text(value.attrs["unit"]))


def read_mesh(group, units):
    n, status, reason, left_out, free, setup, solve, *counts = attributes(group, "elements_per_member", "status", "reason", "left_out", "free", "seconds_setup", "seconds_solve", *COUNTERS)
    work = dict(zip(COUNTERS, map(float, counts)))
    clock = Clock(float(setup), float(solve), float(setup + solve), float(setup + solve), 1)
    mesh = Mesh(int(n), text(status), text(reason), clock, int(free), int(work["iterations"]), text(left_out), work)
    rows = QUANTITIES.read(group, b"quantities")
    columns = QUANTITIES.type.names
    for row in rows:
        row = dict(zip(columns, row))
        name = text(row["name"])
        mesh.values[name], mesh.errors[name], mesh.model_errors[name] = row["value"], row["error"], row["model_error"]
        mesh.reasons[name], units[name] = text(row["reason"]), text(row["unit"])
        if math.isfinite(row.get("prediction", math.nan)):
            mesh.predictions[name] = row["prediction"]
    return mesh


def read_verdicts(table):
    rows = []
    for row in table[()]:
        words = [text(row[c]) for c in ("quantity", "verdict", "expected", "kind", "reason", "proof", "source")]
        numbers = [float(row[c]) for c in ("truth", "limit", "order", "error", "model_truth", "model_error", "tolerance")]
        rows.append(Verdict(*words, *numbers, {level: int(row[c]) for level, c in REACH.items() if math.isfinite(row[c])}))
    return rows


def read_series(key, group, units, with_curves):
    cells = sorted((int(name[1:]), name) for name in group if name[0] == "n" and name[1:].isdigit())
    meshes = []
    for _, name in cells:
        cell = group[name]
        meshes.append(read_mesh(cell, units))
        if with_curves or name == cells[-1][1]:
            read_curves(meshes[-1], cell["curves"])
    summary, source, missing = (text(t) for t in attributes(group, "summary", "source", "missing"))
    out = Series(key, summary, source, missing, meshes, read_verdicts(group["verdicts"]))
    if "timing" in group:
        read_timing(out, group["timing"])
    return out


def read_point(name, group, with_curves):
    units = {}
    series = [read_series(key, item, units, with_curves) for key, item in group.items()]
    return Point(name, text(group.attrs["parameters"]), sorted(series, key=lambda s: s.key), units)


def opened(path):
    """In memory: thousands of small pieces are read."""
    return h5py.File(path, driver="core", backing_store=False)


DRAWN_EVERYWHERE = {"c_cantilever"}  # curves of coarser meshes away from the defaults are read only where a page draws them


def read_case(path, name, bench=None):
    """A case; with the times of a benchmark where one is given."""
    with opened(path) as file:
        group = file["cases"][name]
        points = [read_point(p, group[p], p == "default" or name in DRAWN_EVERYWHERE) for p in group]
        points.sort(key=lambda p: (p.name != "default", p.parameters))
        first = group[points[0].name].attrs
        case = Case(name, text(first["summary"]), text(first["source"]), points)
    if bench:
        read_bench(bench, case)
    return case


def read_bench(path, case):
    """Times of a benchmark into the cells of the same name."""
    with opened(path) as file:
        for point in case.points:
            for series in point.series:
                place = f"cases/{case.name}/{point.name}/{series.key}/timing"
                if place in file:
                    read_timing(series, file[place])


def read_about(path):
    """Environment {name: text} that a file of results was made in."""
    try:
        with h5py.File(path) as file:
            if text(file.attrs.get("schema", "")) != "beamwork-results":
                raise Unreadable(f"{path}: not a file of results; 'make verify' and 'make bench' write them")
            return {name: text(value) for name, value in file.attrs.items()}
    except OSError as why:
        raise Unreadable(f"{path}: cannot be read ({why}); 'make verify' writes build/results.h5, 'make bench' build/bench.h5") from why


def read_results(path, bench=None):
    """(environment, [Case]); cases are read side by side."""
    environment = read_about(path)
    try:
        with h5py.File(path) as file:
            names = list(file["cases"])
        with multiprocessing.get_context("fork").Pool() as pool:
            return environment, pool.starmap(read_case, [(path, name, bench) for name in names], chunksize=1)
    except (OSError, KeyError, ValueError) as why:
        raise Unreadable(f"{path}: cannot be read ({why}); 'make verify' writes it") from why


def holds(parameters, at):
    """Does a truth with these parameters, `*` for any value, hold at a point?  Both are `name=value;...`."""
    said = dict(item.split("=", 1) for item in parameters.split(";") if item)
    there = dict(item.split("=", 1) for item in at.split(";") if item)
    return all(value == "*" or there.get(name) == value for name, value in said.items()) and all(name in said for name in there)


def read_other_model(path, case, parameters, quantity):
    """Value of another model (plate, solid) at a parameter point, or NaN."""
    with h5py.File(path) as file:
        group = file["truths"].get(case)
        names = ("parameters", "quantity", "model", "formulation")
        rows = zip(*([text(v) for v in group[name][()]] for name in names)) if group else ()
        for i, (at, of, model, formulation) in enumerate(rows):
            if model == "other" and not formulation and of == quantity and holds(at, parameters):
                return float(group["value"][i])
    return math.nan


def read_truth_counts(path):
    """{kind: rows} of the packed truths."""
    try:
        with h5py.File(path, driver="core", backing_store=False) as file:
            counts = {}
            for group in file["truths"].values():
                for kind in group["kind"]:
                    counts[text(kind)] = counts.get(text(kind), 0) + 1
            return counts
    except (OSError, KeyError) as why:
        raise Unreadable(f"{path}: cannot be read ({why}); 'make all' packs it") from why
