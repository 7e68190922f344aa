"""Beam finite elements: scenes, solutions, convergence and verdicts. All values are SI.

    import beamwork as bw
    scene = bw.Scene.case("sheet_cantilever").set(tip_warping=1)
    result = scene.solve("sheet_third", elements=2)
    result["C_zz"], result.errors["C_zz"]
    x, y = result.curve("C_zz_curve")            # arrays of numpy
    scene.converge("sheet_third", "collocation", select="C_zz").limits
    bw.verify("collocation", select="elastica").passed

Scene: a built-in case, a scene file, or one built of dicts.  Result: values, errors, curves, steps.
Convergence, Verdicts: lists of records; frame() of each is a pandas.DataFrame.

Exceptions, each one line with culprit and remedy: Error, and of it Refused (its mistakes: those of
a scene with file, line and column), NotConverged, Singular, NoValue, TimeLimit, Fault. What was
found until then is error.result. Arguments of a wrong type are a TypeError.

The library is libbeamwork.so.0: BEAMWORK_LIBRARY, or beside this module, in lib of the prefix or
build of the clone that it stands in, beside the program, or where the system looks (beamwork.path).

Threads: other threads run while the library computes; one scene computes one thing at a time.
Ctrl-C ends the processes in which converge and verify compute, with KeyboardInterrupt; a solution
comes to its end first.
"""
import json as _json

from .arguments import required as _required
from .errors import (Error, Fault, Mistake, NotConverged, NoValue, Refused, Singular, TimeLimit)
from .library import call as _call
from .library import path, version
from .library import text_of as _text_of
from .outline import outline
from .records import Convergence, Records, Verdicts
from .result import Curve, Result, Shapes
from .scene import Scene
from .scene import verified as _verified

__version__ = version
__all__ = ["Convergence", "Curve", "Error", "Fault", "Mistake", "NoValue", "NotConverged",
           "Records", "Refused", "Result", "Scene", "Shapes", "Singular", "TimeLimit", "Verdicts",
           "cases", "formulations", "load", "outline", "path", "truths", "verify", "version"]


def _listed(what):
    return Records(_json.loads(_text_of("list", what))[what.decode()])


def cases():
    """Records of the built-in cases: case, summary, source."""
    return _listed(b"cases")


def formulations():
    """Records of the formulations, built-in and loaded: formulation, summary, source, ..."""
    return _listed(b"formulations")


def load(element):
    """Loads your formulation, "./mine.so" or "exec:python3 my_beam.py", and returns its name. It
    stays for the life of the process; a shared object runs inside it: where that crashes in solve,
    Python does."""
    return _text_of("formulation_load", _required(element, "element"))


def truths(path):
    """Takes the reference values of the built-in cases from that file (truths.h5) from now on."""
    _call("truths", _required(path, "path"))


def verify(*formulations, select=None, results=None, **options):
    """Verdicts of formulations (none named: all) on the built-in cases.

    select: words with and, or, not, as "c_column and not beamw_first"; None: all, minutes.
    results: an HDF5 file to write.  options: tolerance (relative; limits within it pass, in place
    of the tolerances of the cases), not_worse_than (results of a former run: errors of meshes that
    are larger than there fail, and limits that moved), jobs, time_limit [s] of a cell, refine
    (more meshes of each series, each with twice the elements), shapes,
    stop (a file descriptor: once it can be read, the work ends with TimeLimit)."""
    return _verified(None, formulations, select, results, options)
