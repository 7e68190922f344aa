"""Ranks the programs of a recorded comparison (_record.py) by the time in which they reach an error, and states their
work."""
from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

LEVELS = (1e-2, 1e-3, 1e-4)
WRONG = ("wrong limit", "wrong limit, as predicted", "biased", "biased, as predicted")


def wrong_limit(series: Mapping[str, Any], quantity: str) -> float:
    """Returns the relative error of a known different limit, or 0."""
    verdict = series["verdicts"].get(quantity, {})
    return abs(float(verdict.get("error") or 0.0)) if verdict.get("verdict") in WRONG else 0.0


def meshes(series: Mapping[str, Any], quantity: str) -> list[dict[str, Any]]:
    """Returns the runs with an error of the quantity, the coarsest first."""
    runs = [run for run in series["runs"] if run.get("errors", {}).get(quantity) is not None]
    return sorted(runs, key=lambda run: int(run["elements"]))


def coarsest(series: Mapping[str, Any], quantity: str, level: float) -> dict[str, Any] | None:
    """Returns the coarsest run such that its error and the errors of all finer runs are at most `level`; None: there is none,
    or the limit is known to differ by more than `level`."""
    found = None
    for run in reversed(meshes(series, quantity)):
        if abs(run["errors"][quantity]) > level:
            break
        found = run
    return None if wrong_limit(series, quantity) > level else found


def time_of(run: Mapping[str, Any], analysis: str) -> float:
    """Returns the time of the solution for the quantities of an analysis, in the unit of the record, or NaN."""
    times = run.get("times", {})
    return float(times.get(analysis, times.get("", math.nan)))


def systems_of(run: Mapping[str, Any], analysis: str) -> int | None:
    """Returns the number of equation systems solved for the quantities of an analysis; None: unknown."""
    systems = run["systems"]
    if isinstance(systems, Mapping):
        systems = systems.get(analysis, systems.get(""))
    return None if systems is None else int(systems)


def _why_not(series: Mapping[str, Any], quantity: str, level: float) -> str:
    if series["missing"]:
        return str(series["missing"])
    if series.get("other_model"):
        return str(series["other_model"])
    if wrong_limit(series, quantity) > level:
        return str(series["verdicts"][quantity]["message"])
    found = meshes(series, quantity)
    if found:
        best = min(found, key=lambda run: abs(float(run["errors"][quantity])))
        return f"smallest error {100 * abs(best['errors'][quantity]):.2g} %, with {best['elements']} elements"
    if quantity in series["refused"]:
        return f"refused: {series['refused'][quantity]}"
    for word, text in (("refusal", "refused"), ("failure", "failed")):
        told = [run[word] for run in series["runs"] if word in run]
        if told:
            return f"{text}: {told[-1]}"
    return "no value, or no reference value of the same theory"


def _reason(first: Mapping[str, Any], ours: Mapping[str, Any] | None) -> str:
    """Returns the reason why the first row, which is that of a peer, is faster than the best row of beamwork."""
    if ours is None:
        return "no formulation of beamwork reaches this error on these meshes"
    parts = [f"{first[key]} {word} against {ours[key]}" for key, word in
             (("elements", "elements"), ("unknowns", "unknowns"), ("systems", "systems solved"))
             if first[key] and ours[key] and first[key] < ours[key]]
    return f"{', '.join(parts) or 'less time for each system of equations'} ({ours['name']})"


def rank(record: Mapping[str, Any], quantity: Mapping[str, Any], level: float) -> dict[str, Any]:
    """Returns {"rows": the programs that reach the error, the fastest first, "others": [name, reason], "least_work": the row with
    the least work or None, "ahead": why a peer is ahead of all formulations, or ""}. In a row, work: unknowns times systems
    solved; ratio: time relative to the fastest formulation of beamwork."""
    rows, others = [], []
    for series in record["series"]:
        run = coarsest(series, quantity["name"], level)
        if run is None or series.get("other_model"):
            others.append([series["name"], _why_not(series, quantity["name"], level)])
            continue
        rows.append({"name": series["name"], "ours": series["ours"], "unranked": series.get("unranked", ""),
                     "elements": run["elements"], "unknowns": run["unknowns"], "systems": systems_of(run, quantity["analysis"]),
                     "error": run["errors"][quantity["name"]], "time": time_of(run, quantity["analysis"])})
    rows.sort(key=lambda row: (bool(row["unranked"]), math.isnan(row["time"]), row["time"],
                               (row["unknowns"] or 0) * (row["systems"] or 0)))
    ours = next((row for row in rows if row["ours"] and not row["unranked"] and not math.isnan(row["time"])), None)
    for row in rows:
        row["work"] = row["unknowns"] * row["systems"] if row["unknowns"] and row["systems"] else None
        row["ratio"] = row["time"] / ours["time"] if ours else math.nan
    ahead = bool(rows) and not rows[0]["ours"] and not math.isnan(rows[0]["time"])
    least = min((row for row in rows if row["work"] and not row["unranked"]), key=lambda row: int(row["work"]), default=None)
    return {"rows": rows, "others": others, "least_work": least, "ahead": _reason(rows[0], ours) if ahead else ""}


def rankings(record: Mapping[str, Any], levels: Sequence[float] = LEVELS) -> list[tuple[Mapping[str, Any], float, dict[str, Any]]]:
    """Returns [(quantity, error, rank())] for the quantities that have errors."""
    known = [q for q in record["quantities"] if any(meshes(s, q["name"]) for s in record["series"])]
    return [(q, level, rank(record, q, level)) for q in known for level in levels]


def program_of(series: Mapping[str, Any]) -> str:
    """Returns the program of a series or row: "Exudyn" for "Exudyn, exact_2d", "beamwork" for a formulation."""
    return "beamwork" if series["ours"] else str(series["name"]).partition(", ")[0]


def merged(first: Mapping[str, Any], second: Mapping[str, Any]) -> dict[str, Any]:
    """Returns the first record with the peers of the second that it does not contain. The unit of time of the second record
    is a run of beamwork; if the first contains this run, times are converted by it, and otherwise the peers have no times."""
    names = {s["name"] for s in first["series"]}
    factor = next((run["times"][""] for s in first["series"] if s["name"] == second["unit"]["name"] and s["ours"]
                   for run in s["runs"] if run["elements"] == second["unit"]["elements"] and run.get("times")), None)

    def converted(run: Mapping[str, Any]) -> dict[str, Any]:
        times = {a: t * factor for a, t in run["times"].items()} if factor and "times" in run else {}
        return {**run, "times": times} if "errors" in run else {**run}
    new = [{**s, "runs": [converted(run) for run in s["runs"]]} for s in second["series"] if not s["ours"] and s["name"] not in names]
    return {**first, "series": first["series"] + new}


def by_case(records: Iterable[Mapping[str, Any]]) -> dict[tuple[str, str], Mapping[str, Any]]:
    """Returns {(case, parameters): record}, where the records of a case are merged in the given order."""
    found: dict[tuple[str, str], Mapping[str, Any]] = {}
    for record in records:
        key = record["case"], record["parameters"]
        found[key] = merged(found[key], record) if key in found else record
    return found
