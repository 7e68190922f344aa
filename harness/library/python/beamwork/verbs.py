"""The verbs of the program as functions, with the data that the program writes.

A case is the name of a built-in case, the path of a scene file, or a Scene. Further options are those of `beamwork help
VERB`, with _ for -, such as elements=[1, 2, 4], set={"load": 2} or jobs=2."""
from __future__ import annotations

import csv
import io
import json
import os
import pathlib
import tempfile
from typing import Any

from .arguments import required
from .errors import Error, Refused
from .library import text_of
from .program import Case, Given, Progress, run
from .records import Convergence, Document, Records, Verdicts


_TEXTS = ("case", "point", "parameters", "formulation", "quantity", "unit", "x_unit")  # columns that are texts even if they look like a number


def _number(text: str) -> Any:
    try:
        return int(text)
    except ValueError:
        pass
    try:
        return float(text)
    except ValueError:
        return text or None


def _rows(text: str) -> Records:
    """Returns the records of a CSV text: numbers, texts, and None for empty fields."""
    return Records({key: value if key in _TEXTS else _number(value) for key, value in row.items()}
                   for row in csv.DictReader(io.StringIO(text)))


def _asked(verb: str, case: Case, formulations: tuple[str, ...] = (), **options: Any) -> tuple[str, int]:
    with Given(case) as (arguments, given):
        both = {**given.get("set", {}), **(options.pop("set", None) or {})}
        return run(verb, *arguments, formulations=formulations,
                   **{**given, **options, **({"set": both} if both else {})})


def verified_by_program(case: Case, formulations: tuple[str, ...], **options: Any) -> Verdicts:
    """Returns the verdicts of the program, which has more options than the library and reports its progress."""
    with tempfile.TemporaryDirectory() as place:
        path = pathlib.Path(place, "verdicts.json")
        with Given(case) as (arguments, given):
            if arguments or given.get("set"):
                raise Refused("verify computes cases at the points of their reference values; select one with "
                              "select=NAME, or give a scene file")
            run("verify", formulations=formulations, json=path, **given, **options)
        return Verdicts(json.loads(path.read_text(encoding="utf-8")))


def converged_by_program(case: Case, formulations: tuple[str, ...], meshes: Any, progress: Progress,
                         options: dict[str, Any]) -> Convergence:
    text, _ = _asked("converge", case, formulations or ("all",), elements=meshes, progress=progress,
                     format="json", **options)
    return Convergence(json.loads(text))


def list_(what: str | None = None) -> Document:
    """Returns cases and formulations, or all data of one of them."""
    return Document(json.loads(text_of("list", None if what is None else required(what, "what"))))


def explain(word: str = "", **options: Any) -> str:
    """Returns the explanation of a verdict, theory, quantity, case, formulation or known deviation. Without a word,
    returns the list of all terms."""
    return run("explain", *word.split(), **options)[0]


def plot(case: Case, output: str | os.PathLike[str], *formulations: str, **options: Any) -> pathlib.Path:
    """Draws the quantities of a case as curves into a file (.png, .svg, .pdf), or writes them as a table (.csv).
    Returns the path of the file."""
    _asked("plot", case, formulations, output=output, **options)
    return pathlib.Path(output)


def sweep(case: Case, *formulations: str, vary: dict[str, Any], progress: Progress | None = None,
          **options: Any) -> Records:
    """Solves a case over ranges of its parameters; returns a record for each quantity of each run.

    vary: {name: "A..B/N", "A..B/N:log" or a list of values}. output: also writes a results file."""
    return _rows(_asked("sweep", case, formulations, vary=vary, progress=progress, format="csv",
                        **options)[0])


def truth(case: Case, **options: Any) -> Document:
    """Returns the reference values of a case at a parameter point: the table `values`. If no values are stored,
    computes them."""
    text, code = _asked("truth", case, format="json", **options)
    if code != 0:
        raise Error("no reference value is stored for this point, and no program can compute it")
    return Document(json.loads(text))


def bench(*cases: str, formulations: tuple[str, ...] = (), progress: Progress | None = None,
          **options: Any) -> Records:
    """Times formulations on cases; returns a record for each quantity of each run, with times and counts."""
    return _rows(run("bench", *cases, formulations=formulations, progress=progress, format="csv",
                     **options)[0])


def stress(*formulations: str, progress: Progress | None = None, **options: Any) -> Document:
    """Solves problems at extreme parameters with the formulations; returns the tables `outcomes`, `formulations`,
    ..."""
    text, code = run("stress", formulations=formulations, progress=progress, format="json", **options)
    return Document(json.loads(text), code)


def motion(case: Case = None, *formulations: str, progress: Progress | None = None,
           **options: Any) -> Document:
    """Compares integrators of a transient analysis; returns the tables `runs`, `orders`, `reached`, ...

    options: integrator, step and tolerance (lists), expected (a table of verdicts, instead of a case), ..."""
    text, code = _asked("motion", case, formulations, progress=progress, format="json", **options)
    return Document(json.loads(text), code)


def element_test(*formulations: str, **options: Any) -> Document:
    """Checks formulations against the interface; returns the tables `claims`, `measured`, ... `passed` is True if the
    requirements are satisfied."""
    text, code = run("element-test", formulations=formulations, format="json", **options)
    return Document(json.loads(text), code)


def merge(*folders: str | os.PathLike[str], of: str = "verify", **options: Any) -> Verdicts | Records:
    """Merges the batches of a run in shards. of: "verify" (returns Verdicts) or "sweep" (returns Records)."""
    if of == "sweep":
        return _rows(run("merge", *folders, format="csv", **options)[0])
    with tempfile.TemporaryDirectory() as place:
        path = pathlib.Path(place, "verdicts.json")
        run("merge", *folders, json=path, **options)
        return Verdicts(json.loads(path.read_text(encoding="utf-8")))


def compare(old: str | os.PathLike[str], new: str | os.PathLike[str], **options: Any) -> Comparison:
    """Compares two stored runs (files of verify, bench or sweep); options: threshold, select, experiment, hash."""
    text, code = run("compare", old, new, **options)
    return Comparison(text, code == 0)


class Comparison:
    """Differences between two stored runs. same: True if no difference exceeds the thresholds; lines: output of
    `beamwork compare`."""

    def __init__(self, text: str, same: bool) -> None:
        self.same, self.lines = same, text.splitlines()

    def __str__(self) -> str:
        return "\n".join(self.lines)

    def __repr__(self) -> str:
        return f"<Comparison, {'the same' if self.same else 'different'}>"


def export(case: Case, to: str = "calculix", **options: Any) -> str:
    """Returns a structure as an input deck of solid elements for another program."""
    return _asked("export", case, to=to, **options)[0]


def import_(*files: str | os.PathLike[str], output: str | os.PathLike[str],
            **options: Any) -> pathlib.Path:
    """Reads results of other programs, stores them for verify(imported=...), and returns the path `output`. Raises
    Refused with all errors of a file (error.mistakes)."""
    run("import", *files, output=output, format="json", **options)
    return pathlib.Path(output)


def schema() -> Document:
    """Returns the structure of results files: the table `records`."""
    return Document(json.loads(run("schema", format="json")[0]))
