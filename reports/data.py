"""Reads results.h5 and truths.h5 into plain records. The schema is described in harness/README.md and reference/README.md."""
import math
from dataclasses import dataclass, field

import h5py


class Unreadable(Exception):
    """A file that is missing, damaged or of another kind; the text names it."""


@dataclass
class Mesh:
    """One cell: a formulation on one mesh."""
    n: int
    status: str
    reason: str
    seconds: float
    free: int
    iterations: int
    left_out: str
    values: dict = field(default_factory=dict)   # quantity -> value
    errors: dict = field(default_factory=dict)   # quantity -> relative error
    curves: dict = field(default_factory=dict)   # quantity -> (x, value, x name, x unit, unit)
    steps: object = None


@dataclass
class Verdict:
    """One line of the judge."""
    quantity: str
    verdict: str
    expected: str
    kind: str
    reason: str
    proof: str
    truth: float
    limit: float
    order: float
    error: float
    model_error: float
    tolerance: float


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


def read_mesh(group, units):
    attrs = group.attrs
    mesh = Mesh(int(attrs["elements_per_member"]), text(attrs["status"]), text(attrs["reason"]), float(attrs["seconds_setup"]) + float(attrs["seconds_solve"]),
                int(attrs["free"]), int(attrs["iterations"]), text(attrs["left_out"]))
    for row in group["quantities"][()]:
        name = text(row["name"])
        mesh.values[name], mesh.errors[name], units[name] = float(row["value"]), float(row["error"]), text(row["unit"])
    for name, item in group["curves"].items():
        mesh.curves[name] = (item["x"][()], item["value"][()], text(item["x"].attrs["name"]), text(item["x"].attrs["unit"]), text(item["value"].attrs["unit"]))
    mesh.steps = group["steps"][()]
    return mesh


def read_verdicts(group):
    columns = {name: group[name][()] for name in group}
    rows = []
    for i in range(len(columns["quantity"])):
        words = [text(columns[c][i]) for c in ("quantity", "verdict", "expected", "kind", "reason", "proof")]
        numbers = [float(columns[c][i]) for c in ("truth", "limit", "order", "error", "model_error", "tolerance")]
        rows.append(Verdict(*words, *numbers))
    return rows


def read_point(name, group):
    units, series = {}, []
    for key, item in group.items():
        meshes = sorted((read_mesh(item[m], units) for m in item if m != "verdicts"), key=lambda m: m.n)
        series.append(Series(key, text(item.attrs["summary"]), text(item.attrs["source"]), text(item.attrs["missing"]), meshes, read_verdicts(item["verdicts"])))
    return Point(name, text(group.attrs["parameters"]), sorted(series, key=lambda s: s.key), units)


def read_results(path):
    """(environment {name: text}, [Case])"""
    try:
        with h5py.File(path) as file:
            if text(file.attrs.get("schema", "")) != "beamwork-results":
                raise Unreadable(f"{path}: not a file of results; 'make verify' writes one")
            environment = {name: text(value) for name, value in file.attrs.items()}
            cases = []
            for name, group in file["cases"].items():
                points = [read_point(p, group[p]) for p in group]
                points.sort(key=lambda p: (p.name != "default", p.parameters))
                first = group[points[0].name].attrs
                cases.append(Case(name, text(first["summary"]), text(first["source"]), points))
            return environment, cases
    except (OSError, KeyError) as why:
        raise Unreadable(f"{path}: cannot be read ({why}); 'make verify' writes it") from why


def read_truth_counts(path):
    """{kind: rows} of the packed truths."""
    try:
        with h5py.File(path) as file:
            counts = {}
            for group in file["truths"].values():
                for kind in group["kind"]:
                    counts[text(kind)] = counts.get(text(kind), 0) + 1
            return counts
    except (OSError, KeyError) as why:
        raise Unreadable(f"{path}: cannot be read ({why}); 'make all' packs it") from why


def cheapest(point, quantity, levels):
    """{level: (seconds, key, n)}: the least time in which a formulation is within the level from that mesh on."""
    best = {}
    for series in point.series:
        for i, mesh in enumerate(series.meshes):
            finer = [m.errors.get(quantity, math.nan) for m in series.meshes[i:]]
            for level in levels:
                if all(math.isfinite(e) and abs(e) <= level for e in finer) and (level not in best or mesh.seconds < best[level][0]):
                    best[level] = (mesh.seconds, series.key, mesh.n)
    return best
