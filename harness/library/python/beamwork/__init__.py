"""Beam finite elements: scenes, solutions, convergence and verdicts. All values are SI.

    import beamwork as bw
    scene = bw.Scene.case("sheet_cantilever").set(tip_warping=1)
    result = scene.solve("sheet_third", elements=2)
    result["C_zz"], result.errors["C_zz"]
    x, y = result.curve("C_zz_curve")            # arrays of numpy
    scene.converge("sheet_third", "collocation", select="C_zz").limits
    bw.verify("collocation", select="elastica").passed

Scene: a built-in case, a scene file, or a scene built from dicts.  Result: values, errors, curves, steps.
Convergence, Verdicts: lists of records; frame() of each is a pandas.DataFrame.

The message of an exception is one line with the cause and the remedy. Error is the base class of Refused (attribute
mistakes: the errors of a scene with file, line and column), NotConverged, Singular, NoValue, TimeLimit and Fault.
error.result contains partial results. Arguments of a wrong type raise TypeError.

Every verb of the program has a function: sweep, bench, stress, motion, element_test, truth, compare, merge, plot,
export, import_, explain, list_, schema and verify; solve, converge and scene are Scene.solve, Scene.converge and
Scene.write.
They return the data that the program writes as JSON (Document) or CSV (Records).

BEAMWORK_LIBRARY is the path of the library libbeamwork.so.0. If it is not set, the library is searched for in the
folder of this module, in `lib` of the prefix or `build` of the clone that contains this module, in the folder of the
program, and in the search path of the system. beamwork.path is the path that was found.

Other threads run while the library computes. A scene performs one computation at a time. Ctrl-C raises
KeyboardInterrupt. It ends the processes of converge and verify immediately, and a solution after its current iteration
or time step.
"""
from __future__ import annotations as _annotations

import json as _json
import os as _os
from collections.abc import Callable as _Callable
from typing import Any as _Any

from .arguments import required as _required
from .errors import (Error, Fault, Mistake, NotConverged, NoValue, Refused, Singular, TimeLimit)
from .inside import door as _door
from .library import call as _call
from .library import path, version
from .library import text_of as _text_of
from .outline import outline
from .program import LOADED as _LOADED
from .program import program
from .records import Convergence, Document, Records, Verdicts
from .result import Curve, Result, Shapes
from .scene import Scene
from .scene import verified as _verified
from .verbs import (Comparison, bench, compare, element_test, explain, export, import_, list_, merge, motion, plot,
                    schema, stress, sweep, truth)

__version__ = version
__all__ = ["Comparison", "Convergence", "Curve", "Document", "Error", "Fault", "Mistake", "NoValue",
           "NotConverged", "Records", "Refused", "Result", "Scene", "Shapes", "Singular", "TimeLimit",
           "Verdicts", "bench", "cases", "compare", "element_test", "explain", "export", "formulations",
           "import_", "list_", "load", "merge", "motion", "outline", "path", "plot", "program", "schema",
           "stress", "sweep", "truth", "truths", "verify", "version"]


def _listed(what: bytes) -> Records:
    return Records(_json.loads(_text_of("list", what))[what.decode()])


def cases() -> Records:
    """Returns a record for each built-in case, with the keys case, summary and source."""
    return _listed(b"cases")


def formulations() -> Records:
    """Returns a record for each built-in or loaded formulation, with the keys formulation, summary, source, ..."""
    return _listed(b"formulations")


def load(element: str | _os.PathLike[str] | _Callable[..., _Any], *functions: _Callable[..., _Any],
         **words: _Any) -> str:
    """Loads your formulation, "./mine.so" or "exec:python3 my_beam.py", and returns its name. The formulation remains
    loaded until the process ends. A shared object runs inside the process. If it crashes in solve, Python crashes as
    well.

    Also loads functions of this process, with arrays of numpy: load(prepare, strain, name="mine", strains=6). The
    arguments are those of beamwork_element.serve, which describes the functions. Solutions, converge, verify and every
    verb then use the functions while this process runs."""
    if callable(element):
        element = _door((element, *functions), words)
    elif functions or words:
        raise TypeError("load: arguments such as name= are for functions, not for a file or a command")
    name = _text_of("formulation_load", _required(element, "element"))
    _LOADED[name] = _os.fspath(element)
    return name


def truths(path: str | _os.PathLike[str]) -> None:
    """Sets the file (truths.h5) from which the reference values of the built-in cases are read from now on."""
    _call("truths", _required(path, "path"))


def verify(*formulations: str, select: str | None = None, results: str | _os.PathLike[str] | None = None,
           **options: _Any) -> Verdicts:
    """Computes the verdicts of formulations (none named: all) on the built-in cases.

    select: words with and, or, not, such as "c_column and not beamw_first"; None: all, which takes minutes. results: an
    HDF5 file to write. progress: a function that is called with (done, of, share, what). options: tolerance (relative;
    replaces the tolerances of the cases), not_worse_than (results of a previous run: larger errors of meshes and
    changed limits fail), jobs, time_limit [s] of a run, refine (number of additional meshes of each series, each with
    twice the elements), shapes, stop (a file descriptor: when it becomes readable, the work ends with TimeLimit), and
    those of `beamwork help verify`, with _ for -, such as imported="theirs.h5"."""
    return _verified(None, formulations, select, results, options)
