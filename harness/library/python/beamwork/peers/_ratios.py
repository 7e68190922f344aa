"""The page of ratios: times of the programs relative to those of beamwork, from recorded comparisons, and the factors of each small ratio."""
from __future__ import annotations

import json
import math
import pathlib
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ..errors import Error, Refused
from ..program import run as program
from ._ranking import by_case, program_of, rankings
from ._record import read

LEVELS = (1e-2, 1e-3)
SMALL = 10  # ratios below this are listed with their factors
_ALIKE = 1.05  # counts and times count as equal up to this factor
_HEADINGS = (("Statics", {"linear", "static", "compliance", "continuation"}), ("Motions", {"motion"}),
             ("Frequencies and critical loads", {"modal", "buckling"}), ("Scenes that are not built in", {""}))
_FACTORS = (
    "A ratio is the product of three factors, each of the program relative to beamwork: unknowns, systems solved, and time for each",
    "unknown of a system. The last column names the factors up to 1.",
)
_NOTES = {  # of cases, and of cases under a heading: what the factors do not contain
    "Motions": ("In motions, beamwork uses Radau's method, whose systems contain three stages; those of Exudyn and OpenSees contain one. PyElastica",
                "factors no matrices: its explicit steps count as systems."),
    "sheet_cantilever": ("In `sheet_cantilever`, Exudyn's plane elements compute the quantities in this plane only; the formulations compute all in their",
                         "time."),
    "roll_up": ("In `roll_up`, xara's two-node element represents the constant curvature exactly, and converges in one load step on 2 elements.",
                "`beamw_consistent` does not: each of the 2 elements would rotate by half a turn, which is the limit of the formulation."),
}
_Record = Mapping[str, Any]
_Pair = tuple[str, float, Mapping[str, Any], Mapping[str, Any]]  # quantity, error, row of a program, row of beamwork


def recorded(folder: pathlib.Path) -> list[_Record]:
    """Returns the records in the files of a folder, one for each case."""
    files = [path for path in sorted(folder.glob("*.json")) if path.name != "features.json"]
    if not files:
        raise Refused(f"{folder}: no recorded comparisons (FILE.json)")
    return [record for _, record in sorted(by_case(map(read, files)).items())]


def pairs(record: _Record, analyses: set[str]) -> list[_Pair]:
    """Returns the fastest element of each program and the fastest formulation, for quantities of these analyses."""
    out: list[_Pair] = []
    for quantity, level, ranked in rankings(record, LEVELS):
        if quantity["analysis"] in analyses:
            fastest: dict[str, Mapping[str, Any]] = {}
            for row in ranked["rows"]:
                if math.isfinite(row["ratio"]) and not row["unranked"]:
                    fastest.setdefault(program_of(row), row)
            out += [(quantity["name"], level, row, fastest["beamwork"]) for name, row in fastest.items() if name != "beamwork"]
    return out


def factors(row: Mapping[str, Any], ours: Mapping[str, Any]) -> tuple[float, float, float] | None:
    """Returns the factors whose product is the ratio: of unknowns, of systems, and of the time for each unknown of a system.
    None: a count is unknown."""
    if not row["work"] or not ours["work"]:
        return None
    unknowns, systems = row["unknowns"] / ours["unknowns"], row["systems"] / ours["systems"]
    return unknowns, systems, row["ratio"] / (unknowns * systems)


def reason(found: tuple[float, float, float] | None) -> str:
    """Returns why a ratio is small: the factors that are at most about 1 or, if there is none, the largest factor."""
    if found is None:
        return "its number of systems is unknown"
    words = ("unknowns", "systems", "time for each unknown of a system")
    parts = [f"{'less' if i == 2 else 'fewer'} {word}" if factor < 1 / _ALIKE else f"as {'much' if i == 2 else 'many'} {word}"
             for i, (word, factor) in enumerate(zip(words, found)) if factor < _ALIKE]
    return ", ".join(parts) or f"no factor is above {max(found):.2g}"


def _percent(level: float) -> str:
    return f"{100 * level:g} %"


def _of(record: _Record) -> str:
    return f"{record['case']} ({record['parameters'].replace(';', ', ')})" if record["parameters"] else str(record["case"])


def _cell(ratios: Sequence[float], quantities: int) -> str:
    if not ratios:
        return "–"
    few = f" ({len(ratios)} of {quantities})" if len(ratios) < quantities else ""
    return (f"**{min(ratios):.3g}**" if min(ratios) < SMALL else f"{min(ratios):.3g}") + few


def _ratios(found: Sequence[tuple[_Record, int, list[_Pair]]]) -> Iterator[str]:
    """Yields the table of the smallest ratios."""
    names = sorted({program_of(row) for _, _, own in found for _, _, row, _ in own})
    yield "| case | error | " + " | ".join(names) + " |"
    yield "|---" * (len(names) + 2) + "|"
    for record, quantities, own in found:
        for level in LEVELS:
            cells = (_cell([row["ratio"] for _, at, row, _ in own if at == level and program_of(row) == name], quantities) for name in names)
            yield f"| {_of(record)} | {_percent(level)} | " + " | ".join(cells) + " |"


def _small(record: _Record, own: Sequence[_Pair]) -> Iterator[str]:
    """Yields a row of the table of small ratios for each pair of runs, with the quantities for which it is the fastest one."""
    alike: dict[tuple[Any, ...], list[_Pair]] = {}
    for pair in own:
        _, _, row, ours = pair
        if row["ratio"] < SMALL:
            alike.setdefault((row["name"], row["elements"], ours["name"], ours["elements"], row["ratio"]), []).append(pair)
    for same in alike.values():
        row, ours = same[0][2:]
        where = "; ".join(f"{_percent(level)}: {', '.join(name for name, at, _, _ in same if at == level)}"
                          for level in LEVELS if any(at == level for _, at, _, _ in same))
        found = factors(row, ours)
        numbers = " | ".join(f"{factor:.2g}" for factor in found) if found else "– | – | –"
        yield (f"| {_of(record)} | {where} | {row['name']}, n = {row['elements']} | {ours['name']}, n = {ours['elements']} | "
               f"{row['ratio']:.3g} | {numbers} | {reason(found)} |")


def _kinds(record: _Record) -> dict[str, str]:
    """Returns {analysis: its kind} of a built-in case, and "" as the kind of other scenes."""
    try:
        text, _ = program("scene", record["case"], format="json")
    except Error:
        return {q["analysis"]: "" for q in record["quantities"]}
    return {name: next(iter(analysis)) for name, analysis in json.loads(text)["scene"]["analyses"].items()}


def markdown(records: Sequence[_Record]) -> str:
    """Returns the page of the documentation."""
    sections: dict[str, list[tuple[_Record, int, list[_Pair]]]] = {heading: [] for heading, _ in _HEADINGS}
    for record in records:
        kinds = _kinds(record)
        for heading, wanted in _HEADINGS:
            analyses = {name for name, kind in kinds.items() if kind in wanted}
            own = pairs(record, analyses)
            known = {q["name"] for q, _, _ in rankings(record, LEVELS) if q["analysis"] in analyses}
            sections[heading] += [(record, len(known), own)] if own else []
    every = [pair for found in sections.values() for _, _, own in found for pair in own]
    small = sum(row["ratio"] < SMALL for _, _, row, _ in every)
    lines = ["# Run times of other programs, relative to beamwork", "",
             "`python3 -m beamwork.peers --ratios reference/peers` prints this page from the [recorded comparisons](peer_records.md). A ratio is",
             "the time of the fastest element of a program over that of the fastest formulation; each of them takes the coarsest mesh that",
             "reaches the error, as do all finer meshes. An entry is the smallest ratio of all quantities of the case that the program",
             "computes to this error (\"2 of 3\": of 2 of the 3 quantities; –: none). Times of MBDyn include the start of the program.",
             f"Of all {len(every)} ratios, {len(every) - small} are at least {SMALL}.", ""]
    for heading, found in sections.items():
        lines += [f"## {heading}", "", *_ratios(found), ""] if found else []
    rows = {(heading, record["case"]): rows for heading, found in sections.items() for record, _, own in found if (rows := list(_small(record, own)))}
    lines += [f"## Ratios below {SMALL}", "", *_FACTORS]
    for word, (first, *more) in _NOTES.items():
        lines += [f"* {first}", *(f"  {line}" for line in more)] if any(word in key for key in rows) else []
    lines += ["", f"| case | error: quantities | program | beamwork | ratio | unknowns | systems | time for each | why below {SMALL} |", "|---" * 9 + "|"]
    return "\n".join([*lines, *(row for own in rows.values() for row in own)]) + "\n"
