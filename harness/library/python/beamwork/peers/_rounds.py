"""Peers and formulations solve the same meshes in rounds that alternate between them, on one processor: each runs in
a separate process, which waits while another computes."""
from __future__ import annotations

import dataclasses
import json
import os
import pathlib
import selectors
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from ._clock import least

_PACKAGE = __name__.rpartition(".")[0]
_FOLDER = pathlib.Path(__file__).resolve().parents[2]
_ENOUGH = 2.0  # [s] time after which no further rounds of a mesh are run


@dataclasses.dataclass
class Series:
    """Results of one element of a peer, or of a formulation of beamwork (peer: ""). runs: one dict for each mesh, with the
    keys elements and either values, refused, unknowns, iterations, setup [s], seconds, times and settings, or refusal, or
    failure. missing: the reason why nothing was run, or ""."""
    peer: str
    element: str
    program: str
    version: str = ""
    missing: str = ""
    runs: list[dict[str, Any]] = dataclasses.field(default_factory=list)


class _Lost(Exception):
    """Raised if the process ended or did not answer in time."""


class _Process:
    """The process of a peer or of a formulation."""

    def __init__(self, python: str, name: str, request: Mapping[str, Any]) -> None:
        paths = [str(_FOLDER), os.environ.get("PYTHONPATH", "")]
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, paths)), "OMP_NUM_THREADS": "1"}
        told = None if os.environ.get("BEAMWORK_PEERS_STDERR") else subprocess.DEVNULL
        self.process = subprocess.Popen(  # pylint: disable=consider-using-with
            [python, "-m", f"{_PACKAGE}.run", name], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=told,
            env=environment, start_new_session=True)
        self.rest = b""
        self.say(json.dumps(request))

    def say(self, line: str) -> None:
        assert self.process.stdin is not None
        try:
            self.process.stdin.write(line.encode() + b"\n")
            self.process.stdin.flush()
        except BrokenPipeError:
            pass  # hear() reports the reason

    def hear(self, limit: float) -> Any:
        """Returns the next answer. Raises TimeoutError if the answer takes longer than `limit` seconds, and _Lost if the
        process has ended."""
        assert self.process.stdout is not None
        until = time.monotonic() + limit
        with selectors.DefaultSelector() as wait:
            wait.register(self.process.stdout, selectors.EVENT_READ)
            while b"\n" not in self.rest:
                if not wait.select(max(until - time.monotonic(), 0)):
                    raise TimeoutError(f"no answer within {limit:g} s")
                some = os.read(self.process.stdout.fileno(), 65536)
                if not some:
                    raise _Lost(self._end())
                self.rest += some
        line, _, self.rest = self.rest.partition(b"\n")
        return json.loads(line)

    def _end(self) -> str:
        code = self.process.wait()
        return f"ended by {signal.Signals(-code).name}" if code < 0 else f"ended with status {code}"

    def close(self) -> None:
        for pipe in (self.process.stdin, self.process.stdout):
            assert pipe is not None
            try:
                pipe.close()
            except BrokenPipeError:
                pass
        if self.process.poll() is None:
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()


class Compared:
    """One element of a peer, or one formulation. A process that crashes is started again for the next mesh; after a mesh that
    exceeds the time limit, finer meshes are not tried."""

    def __init__(self, series: Series, python: str, request: Mapping[str, Any], limit: float) -> None:
        self.series, self.python, self.limit = series, python, limit
        self.request = {**request, "element": series.element}
        self.process: _Process | None = None
        self.stopped, self.spent = False, 0.0

    def _ready(self) -> _Process:
        if self.process is None:
            self.process = _Process(self.python, self.series.peer or "_ours", self.request)
            told = self.process.hear(self.limit)
            self.series.version = told.get("version", self.series.version)
            self.series.missing = told.get("missing", "")
            self.stopped = bool(self.series.missing)
        return self.process

    def begin(self) -> None:
        self.spent = 0.0

    def round(self, n: int) -> None:
        """Solves a mesh with n elements, unless a coarser mesh exceeded the time limit, or this mesh failed before
        or has already taken _ENOUGH seconds."""
        last = self.series.runs[-1] if self.series.runs and self.series.runs[-1]["elements"] == n else None
        if self.stopped or (last is not None and ("values" not in last or self.spent > _ENOUGH)):
            return
        try:
            process = self._ready()
            if self.stopped:
                return
            begun = time.monotonic()
            process.say(str(n))
            self._take(process.hear(self.limit), last)
            self.spent += time.monotonic() - begun
        except (TimeoutError, _Lost) as error:
            self.close()
            self.stopped = isinstance(error, TimeoutError)
            if last is None:
                self.series.runs.append({"elements": n, "failure": str(error)})

    def _take(self, run: dict[str, Any], last: dict[str, Any] | None) -> None:
        if last is None:
            self.series.runs.append(run)
        elif "values" in run:
            last["times"] = least(last["times"], run["times"])
            last["setup"], last["seconds"] = (min(last[key], run[key]) for key in ("setup", "seconds"))

    def close(self) -> None:
        if self.process is not None:
            self.process.close()
        self.process = None


def take_turns(compared: Sequence[Compared], elements: Sequence[int], rounds: int,
            progress: Callable[[str], None] = lambda text: None) -> None:
    """Solves all meshes. In each round, every peer and formulation solves the mesh once."""
    try:
        for n in elements:
            for one in compared:
                one.begin()
            for i in range(rounds):
                for one in compared:
                    progress(f"{n} elements, round {i + 1} of {rounds}: {one.series.program}")
                    one.round(n)
    finally:
        for one in compared:
            one.close()


def of_formulation(scene: Mapping[str, Any], formulation: str, processor: int, limit: float) -> Compared:
    series = Series("", formulation, formulation)
    return Compared(series, sys.executable, {"scene": scene, "processor": processor}, limit)
