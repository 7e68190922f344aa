"""The record of a comparison: counts, errors, verdicts, and times relative to one run of beamwork."""
from __future__ import annotations

import datetime
import json
import math
import pathlib
import tempfile
from collections.abc import Mapping, Sequence
from typing import Any

from .. import version
from ..errors import Refused
from ..program import run as program
from ._ours import analysis_of
from ._rounds import Series

VERSION = 1


def formulations_of(case: Sequence[object], options: Mapping[str, Any]) -> list[str]:
    """Returns the formulations that support the case and contain no known misprint."""
    text, _ = program("list", format="json")
    misprinted = {one["formulation"] for one in json.loads(text)["formulations"] if one["misprint"]}
    text, _ = program("converge", *case, format="json", elements=1, formulations=["all"], **options)
    return [s["formulation"] for s in json.loads(text)["series"] if not s["missing"] and s["formulation"] not in misprinted]


def _judged(case: Sequence[object], options: Mapping[str, Any], found: Sequence[Series], imports: str,
            elements: Sequence[int]) -> list[dict[str, Any]]:
    """Returns the series of `beamwork converge` for the formulations, and for the peers as imported results."""
    with tempfile.TemporaryDirectory() as folder:
        stored: dict[str, Any] = {}
        if any("values" in run for one in found if one.peer for run in one.runs):
            place = pathlib.Path(folder, "peers.csv")
            place.write_text(imports, encoding="utf-8")
            stored = {"imported": str(place.with_suffix(".h5"))}
            program("import", place, output=stored["imported"])
        names = [one.element for one in found if not one.peer] or ["all"]
        text, _ = program("converge", *case, format="json", elements=list(elements), formulations=names, **stored, **options)
    series: list[dict[str, Any]] = json.loads(text)["series"]
    return series


def _rounded(value: float | None) -> float | None:
    return None if value is None or not math.isfinite(value) else float(f"{value:.4g}")


def _verdict(quantity: Mapping[str, Any]) -> dict[str, Any]:
    error = quantity["error"] if quantity["error"] is not None else quantity["model_error"]
    return {"verdict": quantity["verdict"], "message": quantity["message"], "limit": quantity["limit"], "error": _rounded(error)}


def _run(run: Mapping[str, Any], unit: float, errors: Mapping[tuple[str, int], float | None]) -> dict[str, Any]:
    n = run["elements"]
    if "values" not in run:
        return {"elements": n, **{word: run[word] for word in ("refusal", "failure") if word in run}}
    return {"elements": n, "unknowns": run["unknowns"] or None,
            "systems": {a: count or None for a, count in {**run.get("systems", {}), "": run["iterations"]}.items()},
            "setup": _rounded(run["setup"] / unit), "times": {a: _rounded(t / unit) for a, t in run["times"].items()},
            "errors": {q: _rounded(e) for (q, elements), e in errors.items() if elements == n and e is not None},
            "values": {q: v for q, v in run["values"].items() if not isinstance(v, list)}}


def _series(one: Series, told: Mapping[str, Any], unit: float) -> dict[str, Any]:
    errors = {(q["quantity"], m["elements"]): m["error"] for q in told.get("quantities", ()) for m in q["meshes"]}
    runs = [_run(run, unit, errors) for run in one.runs]
    settings = {run["elements"]: run["settings"] for run in one.runs if "values" in run}
    return {"name": one.program, "ours": not one.peer, "version": one.version, "missing": one.missing,
            "settings": settings[max(settings)] if settings else "",
            "other_model": (told.get("model_words") or told["not_modelled"]) if told.get("other_model") else "",
            "refused": {q: why for run in one.runs for q, why in run.get("refused", {}).items()},
            "verdicts": {q["quantity"]: _verdict(q) for q in told.get("quantities", ())}, "runs": runs}


def _quantities(scene: Mapping[str, Any], judged: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Returns the quantities with the values from which errors are computed: reference values, or the limit on which
    formulations agree."""
    out = []
    for name, entry in scene["scene"].get("quantities", {}).items():
        told = [q for s in judged for q in s["quantities"] if q["quantity"] == name]
        truth = next(((q["truth"], q["truth_kind"]) for q in told if q["truth"] is not None), None)
        agreed = next(((q["model_truth"], q["model_truth_kind"]) for q in told if q["model_truth"] is not None), (None, ""))
        value, kind = truth or agreed
        out.append({"name": name, "unit": entry["unit"], "analysis": analysis_of(entry), "truth": value, "kind": kind,
                    "meaning": scene.get("meanings", {}).get(name, "")})
    return out


def make(scene: Mapping[str, Any], found: Sequence[Series], imports: str, case: Sequence[object],
         options: Mapping[str, Any], rounds: int) -> dict[str, Any]:
    """Returns the record. imports: the results of the peers as an import file. The unit of time is the fastest run
    of a formulation or, if there is none, of a peer. Recorded files do not contain the "seconds" of the unit."""
    timed = [(not one.peer, run["times"][""], one.program, run["elements"]) for one in found for run in one.runs if "values" in run]
    if not timed:
        raise Refused("no program solved the case")
    ours, unit, name, n = min((t for t in timed if t[0] == any(t[0] for t in timed)), key=lambda t: float(t[1]))
    elements = sorted({run["elements"] for one in found for run in one.runs})
    judged = _judged(case, options, found, imports, elements)
    of = {s["formulation"]: s for s in judged}
    _, _, parameters = scene.get("whole", scene["of"]).partition("; ")
    return {"beamwork_peers": VERSION, "case": scene["scene"]["name"], "parameters": parameters, "beamwork": version,
            "date": datetime.datetime.now(datetime.timezone.utc).date().isoformat(), "rounds": rounds,
            "unit": {"name": name, "ours": ours, "elements": n, "seconds": unit},
            "quantities": _quantities(scene, judged), "series": [_series(one, of.get(one.program, {}), unit) for one in found]}


def written(record: Mapping[str, Any]) -> str:
    """Returns the text of a recorded file, with one line for each run and without absolute times."""
    unit = {key: value for key, value in record["unit"].items() if key != "seconds"}
    head = {**record, "unit": unit}
    lines = ["{"] + [f"{json.dumps(key)}: {json.dumps(value)}," for key, value in head.items() if key not in ("quantities", "series")]
    lines += ['"quantities": [', ",\n".join(json.dumps(q) for q in record["quantities"]) + "],", '"series": [']
    for i, one in enumerate(record["series"]):
        own = json.dumps({key: value for key, value in one.items() if key != "runs"})[:-1]
        runs = ",\n".join(f"  {json.dumps(run)}" for run in one["runs"])
        lines.append(f'{own}, "runs": [' + (f"\n{runs}" if runs else "") + "]}" + ("," if i < len(record["series"]) - 1 else ""))
    return "\n".join(lines) + "]}\n"


def read(path: pathlib.Path) -> dict[str, Any]:
    """Returns a recorded file."""
    try:
        record: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise Refused(f"{path}: cannot be read: {error}") from error
    if not isinstance(record, dict) or record.get("beamwork_peers") != VERSION:
        raise Refused(f"{path}: not a record of version {VERSION}; `python3 -m beamwork.peers CASE -o FILE.json` writes one")
    return record
