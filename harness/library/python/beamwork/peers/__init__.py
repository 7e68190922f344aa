"""Other programs that solve a scene: each peer is a file of this folder, which runs in a process of its own.

    python3 -m beamwork.peers bend_45 --peers exudyn,opensees -o theirs.csv

writes the results of the peers in the form that `beamwork import` reads."""
from __future__ import annotations

import contextlib
import dataclasses
import importlib
import json
import os
import pathlib
import selectors
import signal
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ..errors import Refused

_HERE = pathlib.Path(__file__).resolve().parent
_OWN = {"__init__", "__main__", "data", "read", "run"}
__path__ += filter(None, os.environ.get("BEAMWORK_DRIVERS", "").split(os.pathsep))


@dataclasses.dataclass
class Series:
    """Results of one element of a peer. runs: one dict for each mesh, with the keys elements and either values, refused,
    unknowns, iterations, setup [s], seconds and settings, or refusal, or failure. missing: the reason why nothing was
    run, or ""."""
    peer: str
    element: str
    program: str
    version: str = ""
    missing: str = ""
    runs: list[dict[str, Any]] = dataclasses.field(default_factory=list)


def names() -> list[str]:
    """Returns the names of all peers: files of this folder, and of the folders in BEAMWORK_DRIVERS."""
    return sorted(path.stem for folder in __path__ for path in pathlib.Path(folder).glob("*.py") if path.stem not in _OWN)


def load(name: str) -> Any:
    """Returns the module of a peer."""
    if name not in names():
        raise Refused(f"unknown peer '{name}'; the peers are {', '.join(names())}")
    return importlib.import_module(f"{__name__}.{name}")


def interpreter() -> str:
    """Returns the Python interpreter of the peers: BEAMWORK_PEERS, that of `make peers`, or this one."""
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


def _lines(process: subprocess.Popen[bytes], limit: float) -> Iterator[dict[str, Any]]:
    """Yields the answers of a process. Raises TimeoutError if one takes longer than `limit` seconds."""
    assert process.stdout is not None
    rest = b""
    with selectors.DefaultSelector() as wait:
        wait.register(process.stdout, selectors.EVENT_READ)
        while True:
            if not wait.select(limit):
                raise TimeoutError
            some = os.read(process.stdout.fileno(), 65536)
            if not some:
                return
            *whole, rest = (rest + some).split(b"\n")
            for line in whole:
                yield json.loads(line)


def _one_process(series: Series, request: Mapping[str, Any], limit: float) -> str:
    """Runs the remaining meshes in one process. Returns why it ended early; "": it did not."""
    paths = [str(_HERE.parent.parent), os.environ.get("PYTHONPATH", "")]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, paths)), "OMP_NUM_THREADS": "1"}
    with subprocess.Popen([interpreter(), "-m", f"{__name__}.run", series.peer], stdin=subprocess.PIPE,
                          stdout=subprocess.PIPE, stderr=None if os.environ.get("BEAMWORK_PEERS_STDERR") else subprocess.DEVNULL,
                          env=environment, start_new_session=True) as process:
        assert process.stdin is not None
        try:
            with contextlib.suppress(BrokenPipeError), process.stdin as to:
                to.write(json.dumps(request).encode())
            for line in _lines(process, limit):
                if "elements" in line:
                    series.runs.append(line)
                else:
                    series.version = line.get("version", series.version)
                    series.missing = line.get("missing", "")
            code = process.wait(limit)
        except (TimeoutError, subprocess.TimeoutExpired):
            return f"no answer within {limit:g} s"
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
    if code == 0:
        return ""
    return f"ended by {signal.Signals(-code).name}" if code < 0 else f"ended with status {code}"


def solve(scene: Mapping[str, Any], peer: str, element: str, elements: Sequence[int], rounds: int = 3,
          limit: float = 60) -> Series:
    """Solves a scene (`beamwork scene --format json`) with one element on several meshes. limit: longest time for one
    mesh [s]. A mesh fails if its process crashes or exceeds the limit; in the latter case, finer meshes are not
    tried."""
    module = load(peer)
    series = Series(peer, element, f"{module.PROGRAM}, {element}")
    while len(series.runs) < len(elements) and not series.missing:
        left = list(elements[len(series.runs):])
        request = {"scene": scene, "element": element, "elements": left, "rounds": rounds}
        why = _one_process(series, request, limit)
        if why and len(series.runs) < len(elements):
            series.runs.append({"elements": elements[len(series.runs)], "failure": why})
        if why.startswith("no answer") or (not why and len(series.runs) < len(elements)):
            break
    return series


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
