"""The location of the program, and runs of its verbs."""
from __future__ import annotations

import os
import pathlib
import pty
import re
import shutil
import signal
import subprocess
import tempfile
import threading
from collections.abc import Callable, Iterable
from typing import Any, Union

from .errors import Error, Fault, Refused, TimeLimit, of_status
from .library import path as _library
from .scene import Scene

Case = Union[str, "os.PathLike[str]", Scene, None]
Progress = Callable[[int, int, float, str], object]

_HERE = pathlib.Path(__file__).resolve().parent
_PROGRESS = re.compile(r"[a-z ]+ (\d+) of (\d+), (\d+) %(?:, about .* left)?: (.*)")
_REPEATED = ("element", "scene", "truths", "from_", "imported", "deviations")
_FAILED: dict[int, type[Error]] = {2: Refused, 4: Fault, 5: TimeLimit}
LOADED: dict[str, str] = {}  # argument of load() for each loaded formulation, for verbs that run in the program


def program() -> str:
    """Returns the path of the program: the value of BEAMWORK; otherwise the program of the wheel,
    the program next to the library or in bin of its prefix, or the one in the PATH."""
    asked = os.environ.get("BEAMWORK")
    near = _library.resolve().parent
    places = [pathlib.Path(asked)] if asked else [
        _HERE / "bin" / "beamwork", near / "beamwork", near.parent / "bin" / "beamwork",
        near.parent.parent / "bin" / "beamwork"]
    for place in places:
        if place.is_file() and os.access(place, os.X_OK):
            return str(place.resolve())
    found = None if asked else shutil.which("beamwork")
    if found is None:
        raise Fault(f"BEAMWORK={asked} is not a program" if asked else
                    "the program beamwork was not found; run 'make all' in a clone of beamwork, or "
                    "give its path in BEAMWORK")
    return found


def _joined(value: Any) -> str:
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, (list, tuple, range)):
        return ",".join(_joined(v) for v in value)
    return repr(value) if isinstance(value, float) else str(value)


def _words(name: str, value: Any) -> list[str]:
    """Returns the words of an option: True is a switch, a dict is NAME=VALUE, and a list is joined by commas or, for
    options that take one file, repeats the option."""
    option = "--" + name.rstrip("_").replace("_", "-")
    if value is None or value is False:
        return []
    if value is True:
        return [option]
    if isinstance(value, dict):
        return [f"{option}={k}={_joined(v)}" for k, v in value.items()]
    if isinstance(value, (list, tuple)) and name in _REPEATED:
        return [f"{option}={v}" for v in value]
    return [f"{option}={_joined(value)}"]


class _Told:
    """Standard error of the program: progress is passed to the function, and other lines are kept."""

    def __init__(self, progress: Progress | None) -> None:
        self.progress = progress
        self.failure: BaseException | None = None
        self.lines: list[str] = []
        self.read, self.write = os.pipe() if progress is None else pty.openpty()
        self.thread = threading.Thread(target=self._follow, daemon=True)

    def _follow(self) -> None:
        rest, some = b"", b" "
        while some:
            try:
                some = os.read(self.read, 65536)
            except OSError:
                some = b""
            *lines, rest = re.split(rb"[\r\n]+", rest + some)
            for line in lines + ([] if some else [rest]):
                self._take(line.decode("utf-8", "replace").strip())

    def _take(self, line: str) -> None:
        found = _PROGRESS.fullmatch(line)
        if found is None or self.progress is None:
            self.lines += [line] if line else []
            return
        try:
            self.progress(int(found[1]), int(found[2]), int(found[3]) / 100, found[4])
        except BaseException as error:  # pylint: disable=broad-exception-caught
            self.failure, self.progress = error, lambda *_: None


def _failure(code: int, output: str, lines: list[str]) -> Error:
    try:
        found = of_status(3, output) if code == 2 else None
    except ValueError:
        found = None
    if isinstance(found, Refused) and found.mistakes:
        return found
    line = lines[-1] if lines else f"the program ended with status {code}"
    return _FAILED.get(code, Fault)(line.removeprefix("beamwork: "))


def _end(process: subprocess.Popen[str]) -> None:
    """Ends the program, which first writes the verdicts that are complete."""
    process.send_signal(signal.SIGINT)
    try:
        process.communicate(timeout=5)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()


def run(verb: str, *arguments: object, formulations: Iterable[str] = (),
        progress: Progress | None = None, **options: Any) -> tuple[str, int]:
    """Runs a verb in another process. Returns its standard output and its exit status.

    formulations: names; formulations that load() has loaded are also loaded there. progress: a function of (done, of,
    share, what). options: those of `beamwork help VERB`, with _ for -. Ctrl-C ends the process.

    Raises Refused, Fault or TimeLimit with the line of the program for the statuses 2, 4 and 5."""
    named = [str(f) for f in formulations]
    doors = [LOADED[n] for n in dict.fromkeys(f.partition(":")[0] for f in named) if n in LOADED]
    words = [program(), verb, *(w for name, value in options.items() for w in _words(name, value)),
             *(f"--element={door}" for door in doors), *(f"--formulation={f}" for f in named),
             *map(str, arguments)]
    told = _Told(progress)
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=told.write, text=True,
                          encoding="utf-8", stdin=subprocess.DEVNULL) as process:
        os.close(told.write)
        told.thread.start()
        try:
            output, _ = process.communicate()
        except BaseException:
            _end(process)
            raise
        finally:
            told.thread.join()
            os.close(told.read)
    if told.failure is not None:
        raise told.failure
    if process.returncode in _FAILED or process.returncode < 0:
        raise _failure(process.returncode, output, told.lines)
    return output, process.returncode


class Given:
    """A case in the form of program arguments."""

    def __init__(self, case: Case) -> None:
        self.case = case
        self.folder: tempfile.TemporaryDirectory[str] | None = None

    def __enter__(self) -> tuple[list[str], dict[str, Any]]:
        """Returns the positional arguments and the options."""
        if self.case is None:
            return [], {}
        if not isinstance(self.case, Scene):
            return [os.fspath(self.case)], {}
        kind, where, values = self.case.origin()
        given = {"set": values} if values else {}
        if kind == "case":
            return [where], given
        if kind == "text":
            self.folder = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
            place = pathlib.Path(self.folder.name, "scene.yaml")
            place.write_text(where, encoding="utf-8")
            where = str(place)
        return [], {"scene": where, **given}

    def __exit__(self, *_: object) -> None:
        if self.folder is not None:
            self.folder.cleanup()
