"""Comparisons of formulations with other programs (`python3 -m beamwork.peers`): recorded files, diagrams and profiles."""
import importlib.util
import json
import math
import pathlib

from reports import data
from reports.site import ROOT

RECORDS, FEATURES = ROOT / "reference" / "peers", "features.json"


def _module(name):
    """Returns a module of beamwork.peers, loaded without the library, so that the program and the report rank alike."""
    places = [ROOT / "harness" / "library" / "python" / "beamwork"]
    found = importlib.util.find_spec("beamwork")
    places += [pathlib.Path(p) for p in (found.submodule_search_locations or ())] if found else []
    path = next((p / "peers" / name for p in places if (p / "peers" / name).is_file()), None)
    if path is None:
        raise data.Unreadable(f"{name} of the Python module beamwork was not found; install the module")
    spec = importlib.util.spec_from_file_location("peers_ranking", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


ranking = _module("_ranking.py")
LEVELS = ranking.LEVELS
program_of = ranking.program_of


def read(path):
    """Returns the record in a file."""
    try:
        record = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError) as why:
        raise data.Unreadable(f"{path}: cannot be read ({why})") from why
    if not isinstance(record, dict) or record.get("beamwork_peers") != 1:
        raise data.Unreadable(f"{path}: not a record of `python3 -m beamwork.peers CASE -o FILE.json`")
    return record


def records(live=(), folder=RECORDS):
    """Returns the recorded comparisons, in which those of the files `live` replace those of the same case and parameters."""
    found = ranking.by_case({**read(path), "file": path.name} for path in sorted(pathlib.Path(folder).glob("*.json")) if path.name != FEATURES)
    for path in live:
        record = {**read(path), "file": pathlib.Path(path).name}
        found[record["case"], record["parameters"]] = record
    return [record for _, record in sorted(found.items())]


def known(record):
    """Returns the quantities with errors."""
    return [q for q in record["quantities"] if any(ranking.meshes(s, q["name"]) for s in record["series"])]


def curves(record, quantity):
    """Returns [(series, [(time, error, run)])] of the runs with a time and an error other than zero. Series of other
    models are omitted."""
    out = []
    for series in record["series"]:
        if series.get("other_model"):
            continue
        points = [(ranking.time_of(run, quantity["analysis"]), abs(run["errors"][quantity["name"]]), run)
                  for run in ranking.meshes(series, quantity["name"])]
        points = [p for p in points if math.isfinite(p[0]) and p[1] > 0]
        out += [(series, points)] if points else []
    return out


def front(found):
    """Returns the Pareto front of curves(): [(time, error, name)] with ascending times and descending errors."""
    points = sorted((t, e, series["name"]) for series, points in found for t, e, _ in points)
    out = []
    for t, e, name in points:
        if not out or e < out[-1][1]:
            out.append((t, e, name))
    return out


def diagram(record, quantity):
    """Returns the numbers of a work-precision diagram: {"curves": {name: [(time, error, elements)]}, "front": front()}."""
    found = curves(record, quantity)
    return {"curves": {series["name"]: [(t, e, run["elements"]) for t, e, run in points] for series, points in found},
            "front": front(found)}


def problems(found, level):
    """Returns [(record, quantity, weight, rank)]: every quantity that some program solves to the error. The cases have equal
    weights, which their quantities share."""
    out = []
    for record in found:
        ranked = [(q, ranking.rank(record, q, level)) for q in known(record)]
        ranked = [(q, r) for q, r in ranked if any(math.isfinite(row["time"]) for row in r["rows"])]
        out += [(record, q, 1 / len(ranked), r) for q, r in ranked]
    return out


def untimed(series):
    """Returns True if the series has errors but no times, such as results that were recorded elsewhere."""
    runs = [run for run in series["runs"] if "errors" in run]
    return bool(runs) and not any(run.get("times") for run in runs)


def factors(found, level):
    """Returns {program or formulation: [(time relative to the fastest, weight)]} with infinite times for problems that are
    not solved. A program is represented by its fastest element."""
    all_ = problems(found, level)
    ours = {s["name"] for record in found for s in record["series"] if s["ours"]}
    names = sorted({program_of(s) for record in found for s in record["series"] if not untimed(s)} | ours)
    out = {name: [] for name in names}
    for _, _, weight, ranked in all_:
        rows = [row for row in ranked["rows"] if math.isfinite(row["time"])]
        best = min(row["time"] for row in rows)
        for name in names:
            own = [row["time"] for row in rows if name in (row["name"], program_of(row))]
            out[name].append((min(own) / best if own else math.inf, weight))
    return out


def ahead(found):
    """Returns [(record, quantity, level, rank())] where a peer is faster than all formulations."""
    return [(record, q, level, r) for level in LEVELS for record, q, _, r in problems(found, level) if r["ahead"]]


def outcomes(record):
    """Returns [(series, text)], where the text is the reason why the program solved nothing, or "" if it solved something."""
    out = []
    for series in record["series"]:
        told = [series["missing"]] + [run[word] for run in series["runs"] for word in ("refusal", "failure") if word in run]
        solved = any("values" in run for run in series["runs"])
        out.append((series, "" if solved else next(filter(None, told), "not run")))
    return out


def features(folder=RECORDS):
    """Returns the measured features, or None."""
    path = pathlib.Path(folder) / FEATURES
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else None
