"""Drivers of other programs that solve a scene. Each peer is a file of this folder and runs in a separate process.

    python3 -m beamwork.peers bend_45 --peers exudyn,opensees -o theirs.csv

writes the results of the peers in the form that `beamwork import` reads."""
from __future__ import annotations

import importlib
import os
import pathlib
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from ..errors import Refused
from ._rounds import Compared, Series, of_formulation, take_turns

_HERE = pathlib.Path(__file__).resolve().parent
_OWN = {"data", "read", "run"}  # files that are not peers; nor are files whose names begin with "_"
__path__ += filter(None, os.environ.get("BEAMWORK_DRIVERS", "").split(os.pathsep))


def names() -> list[str]:
    """Returns the names of all peers: files of this folder, and of the folders in BEAMWORK_DRIVERS."""
    return sorted(path.stem for folder in __path__ for path in pathlib.Path(folder).glob("[!_]*.py") if path.stem not in _OWN)


def load(name: str) -> Any:
    if name not in names():
        raise Refused(f"unknown peer '{name}'; the peers are {', '.join(names())}")
    return importlib.import_module(f"{__name__}.{name}")


def interpreter() -> str:
    """Returns the Python interpreter of the peers: BEAMWORK_PEERS, otherwise that of `make peers`, otherwise this
    one."""
    asked = os.environ.get("BEAMWORK_PEERS")
    if asked:
        return asked
    for folder in _HERE.parents:
        place = folder / "build" / "peers-venv" / "bin" / "python"
        if place.is_file():
            return str(place)
    return sys.executable


def chosen(words: Sequence[str]) -> list[tuple[str, str]]:
    """Returns (peer, element) for "peer" (all its elements) and "peer:element"."""
    out = []
    for word in words:
        name, _, element = word.partition(":")
        known = load(name).ELEMENTS
        if element and element not in known:
            raise Refused(f"{name} has no element '{element}'; its elements are {', '.join(known)}")
        out += [(name, one) for one in ([element] if element else known)]
    return out


def solve_all(scene: Mapping[str, Any], peers: Sequence[tuple[str, str]], formulations: Sequence[str],
              elements: Sequence[int], rounds: int = 3, limit: float = 60,
              progress: Callable[[str], None] = lambda text: None) -> list[Series]:
    """Solves a scene (`beamwork scene --format json`) with elements of peers, (peer, element), and with formulations of
    beamwork, on several meshes. Their rounds alternate, on one processor. limit: longest time for one mesh [s]. A mesh fails
    if its process crashes or exceeds the limit; in the latter case, finer meshes are not tried."""
    processor = max(os.sched_getaffinity(0))
    request = {"scene": scene, "processor": processor, "limit": limit}
    all_ = [of_formulation(scene, name, processor, limit) for name in formulations]
    all_ += [Compared(Series(peer, element, f"{load(peer).PROGRAM}, {element}"), interpreter(), request, limit)
             for peer, element in peers]
    take_turns(all_, elements, rounds, progress)
    return [one.series for one in all_]


def solve(scene: Mapping[str, Any], peer: str, element: str, elements: Sequence[int], rounds: int = 3,
          limit: float = 60) -> Series:
    """Solves a scene with one element of a peer; see solve_all()."""
    return solve_all(scene, [(peer, element)], [], elements, rounds, limit)[0]


def _rows(scene: Mapping[str, Any], run: Mapping[str, Any]) -> Iterator[str]:
    for name, value in run["values"].items():
        unit = scene["scene"]["quantities"][name]["unit"]
        for x, number in value if isinstance(value, list) else [("", value)]:
            yield (f"{name},{unit},{run['elements']},{run['unknowns'] or ''},{run['seconds']:.3g},"
                   f"{x if x == '' else repr(x)},{number!r},")


def _notes(run: Mapping[str, Any]) -> Iterator[str]:
    n = run["elements"]
    for word in ("refusal", "failure"):
        if word in run:
            yield f"# {n} elements, {word}: {' '.join(str(run[word]).split())}"
    if "values" in run:
        yield f"# {n} elements, set-up: {run['setup']:.3g} s; systems solved: {run['iterations']}; {run['settings']}"


def table(scene: Mapping[str, Any], found: Sequence[Series]) -> str:
    """Returns the results as an import file. Comments contain set-up times, counts, settings, refusals and failures."""
    lines = ["# beamwork-import: 1", f"# case: {scene['of']}", "# convention: spatial"]
    head = "quantity,unit,elements,unknowns,seconds,x,value,uncertainty"
    for one in found:
        lines += [f"# program: {one.program}", f"# version: {one.version or '-'}"]
        lines += [f"# not run: {one.missing}"] if one.missing else []
        lines += [note for run in one.runs for note in _notes(run)]
        told = {f"# {name}, not computed: {why}" for run in one.runs for name, why in run.get("refused", {}).items()}
        rows = [row for run in one.runs if "values" in run for row in _rows(scene, run)]
        lines += sorted(told) + ([head] if rows and head not in lines else []) + rows
    return "\n".join(lines) + "\n"
