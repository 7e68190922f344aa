"""Errors, each with one line that names the cause and the remedy."""
from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .library import Owned
    from .result import Result


@dataclass(frozen=True)
class Mistake:
    """An error of a scene: its position (line and column start at 1; 0: none) and its text."""
    file: str
    line: int
    column: int
    text: str
    entry: str = ""  # for a scene built in Python: the entry with the error, such as nodes['tip']

    def __str__(self) -> str:
        place = f"{self.file}:{self.line}:{self.column}" if self.line else self.file
        return f"{self.entry or place}: {self.text}"


class Error(Exception):
    """Base class of all failures of the library. result: the partial result, or None."""
    result: Result | None = None
    partial: Owned | None = None  # partial result in memory of the library

    def __reduce__(self) -> tuple[Any, ...]:  # pickles the error without its result
        state = {k: v for k, v in vars(self).items() if k not in ("result", "partial")}
        return type(self), self.args, state


class Refused(Error, ValueError):
    """Invalid input. mistakes: the errors of a scene in their order, each a Mistake."""
    mistakes: tuple[Mistake, ...] = ()


class NotConverged(Error):
    """An iteration did not converge, or the values still change on the finest mesh."""


class Singular(Error):
    """A matrix is singular, for example because the structure is insufficiently supported or has lost its stiffness."""


class Fault(Error):
    """A file or disk error, insufficient memory, or a process that ended unexpectedly."""


class TimeLimit(Error):
    """The work was stopped by a time limit, or because the descriptor `stop` became readable."""


class NoValue(Error):
    """The requested value does not exist, for example the critical load of a structure that has none."""


_OF_STATUS: dict[int, type[Error]] = {1: NotConverged, 2: Singular, 3: Refused, 4: Fault, 5: TimeLimit, 6: NoValue}


def of_status(status: int, why: str, entries: Sequence[str] = ()) -> Error:
    """Returns the exception for a status of the library. why: its line, or the JSON of all errors of a scene. entries:
    for each line of the scene's text, the entry that wrote the line."""
    try:
        document = json.loads(why)
    except ValueError:
        document = None
    if not isinstance(document, dict) or not isinstance(document.get("mistakes"), list):
        return _OF_STATUS.get(status, Fault)(why or f"status {status} of the library")

    def entry(line: int) -> str:
        return entries[line - 1] if 0 < line <= len(entries) else ""

    mistakes = tuple(
        Mistake(document.get("file", ""), m["line"], m["column"], m["text"], entry(m["line"]))
        for m in document["mistakes"])
    more = document.get("more", 0) + len(mistakes) - 1
    line = str(mistakes[0]) if mistakes else "the scene is refused"
    error = Refused(line + (f" (and {more} more: mistakes)" if more > 0 else ""))
    error.mistakes = mistakes
    return error
