"""The ranking of a comparison as text, CSV or JSON."""
from __future__ import annotations

import csv
import io
import json
import math
import textwrap
from collections.abc import Iterator, Mapping
from typing import Any

from ._ranking import rankings

_OURS = 3  # number of formulations of beamwork that the text lists for each error
_COLUMNS = ("case", "parameters", "quantity", "level", "place", "program", "ours", "elements", "unknowns", "systems", "work", "error",
            "ratio", "seconds", "reason")


def _number(value: float | None, digits: int = 3) -> str:
    return "-" if value is None or not math.isfinite(value) else f"{value:.{digits}g}"


def _row(row: Mapping[str, Any], unit: float | None) -> str:
    seconds = f" {_number(1e3 * row['time'] * unit):>8}" if unit else ""
    name = f"{row['name']} (beamwork)" if row["ours"] else row["name"]
    return (f"  {name:<36}{row['elements']:>4}{row['unknowns'] or '-':>9}{row['systems'] or '-':>9}"
            f"{_number(100 * abs(row['error']), 2):>9} %{seconds} {_number(row['ratio']):>7}")


def _refusals(record: Mapping[str, Any]) -> Iterator[str]:
    """Yields "NAME: REASON" for each program or formulation that solved nothing."""
    for series in record["series"]:
        if not any("values" in run for run in series["runs"]):
            told = [series["missing"]] + [run[word] for run in series["runs"] for word in ("refusal", "failure") if word in run]
            yield f"{series['name']}: {next(filter(None, told), 'not run')}"


def text(record: Mapping[str, Any]) -> str:
    """Returns the ranking of each quantity at each error, the best first."""
    unit = record["unit"].get("seconds")
    of = f"{record['case']}; {record['parameters']}" if record["parameters"] else record["case"]
    lines = [f"{of}: coarsest meshes that reach an error, the fastest first",
             f"beamwork {record['beamwork']}, {record['date']}; processor time of the solution, least of {record['rounds']} rounds; "
             "ratio: to the fastest of beamwork"]
    silent = dict(line.split(": ", 1) for line in _refusals(record))
    lines += [f"not compared: {name}: {why}" for name, why in silent.items()]
    shown = ""
    for quantity, level, ranked in rankings(record):
        if quantity["name"] != shown:
            shown = quantity["name"]
            lines += ["", f"{shown} [{quantity['unit']}]" + (f", {quantity['kind']} {quantity['truth']:.11g}" if quantity["truth"] is not None else "")]
            lines += [f"  {'program':<36}{'n':>4}{'unknowns':>9}{'systems':>9}{'error':>11}{' time/ms' if unit else '':>{9 if unit else 0}}{'ratio':>8}"]
        lines += [f" to {100 * level:g} %:" + (f" a peer is ahead: {ranked['ahead']}" if ranked["ahead"] else "")]
        least = ranked["least_work"]
        if least and least["work"] < (ranked["rows"][0]["work"] or math.inf):
            lines += [f"  least unknowns times systems: {least['name']}, {least['unknowns']} x {least['systems']}"]
        more = [row for row in ranked["rows"] if row["ours"]][_OURS:]
        lines += [_row(row, unit) for row in ranked["rows"] if row not in more]
        lines += [f"  and {len(more)} of beamwork: {', '.join(row['name'] for row in more)}"] if more else []
        lines += [f"  not reached by {name}: {why}" for name, why in ranked["others"] if name not in silent]
    lines += [] if shown else ["", "no quantity is ranked: none has a reference value or an agreed limit other than zero"]
    return "\n".join(textwrap.fill(line, 130, subsequent_indent="    ") if len(line) > 130 else line for line in lines) + "\n"


def rows(record: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    """Yields a row for each program, quantity and error. place 0: the error is not reached, and `reason` states why."""
    unit = record["unit"].get("seconds")
    ours = {series["name"]: series["ours"] for series in record["series"]}
    for quantity, level, ranked in rankings(record):
        head = {"case": record["case"], "parameters": record["parameters"], "quantity": quantity["name"], "level": level}
        for i, row in enumerate(ranked["rows"]):
            time = row["time"] if math.isfinite(row["time"]) else None
            yield {**head, "place": i + 1, "program": row["name"], "ours": row["ours"], "elements": row["elements"],
                   "unknowns": row["unknowns"], "systems": row["systems"], "work": row["work"], "error": row["error"],
                   "ratio": float(f"{row['ratio']:.4g}") if math.isfinite(row["ratio"]) else None,
                   "seconds": float(f"{time * unit:.4g}") if unit and time is not None else None,
                   "reason": ranked["ahead"] if i == 0 else ""}
        for name, why in ranked["others"]:
            yield {**head, "place": 0, "program": name, "ours": ours[name], "reason": why}


def as_csv(record: Mapping[str, Any]) -> str:
    to = io.StringIO()
    table = csv.DictWriter(to, _COLUMNS, restval="", lineterminator="\n")
    table.writeheader()
    table.writerows({key: ("" if value is None else int(value) if isinstance(value, bool) else value) for key, value in row.items()}
                    for row in rows(record))
    return to.getvalue()


def as_json(record: Mapping[str, Any]) -> str:
    return json.dumps({**record, "ranking": list(rows(record))}, indent=1) + "\n"


WRITERS = {"text": text, "csv": as_csv, "json": as_json}
