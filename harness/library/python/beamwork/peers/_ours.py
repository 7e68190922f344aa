"""Formulations of beamwork, solved in separate processes and timed with the same clock as the peers."""
from __future__ import annotations

import json
import math
import time
from collections.abc import Mapping
from typing import Any

from .. import NotConverged, NoValue, Scene, Singular, version as _version
from ..errors import Error
from ._clock import ROUND, clock
from .data import Failed, Refused

PROGRAM = "beamwork"


def version() -> str:
    return _version


def text_of(file: Mapping[str, Any]) -> str:
    """Returns the text of a scene file from the data of `beamwork scene --format json`, where each number is a float."""
    return json.dumps({**file, "beamwork": 1})


def scene_of(raw: Mapping[str, Any]) -> dict[str, Scene]:
    """Returns the scene under the name "" and, if quantities belong to several analyses, one scene for each of these
    with only the necessary analyses."""
    file, name = raw["scene"], raw["scene"]["name"]
    scenes, analyses = {"": Scene.text(text_of(file), name)}, analyses_of(file)
    for asked in analyses if len(analyses) > 1 else ():
        needed = {asked, next(iter(file["analyses"][asked].values())).get("about")}
        part = {**file, "analyses": {k: v for k, v in file["analyses"].items() if k in needed},
                "quantities": {k: v for k, v in file["quantities"].items() if analysis_of(v) == asked}}
        try:
            scenes[asked] = Scene.text(text_of(part), name)
        except Error:  # another part of the scene requires the other analyses
            scenes[asked] = scenes[""]
    return scenes


def analysis_of(quantity: Mapping[str, Any]) -> str:
    return str(next(iter(quantity.values())).get("analysis", ""))


def analyses_of(file: Mapping[str, Any]) -> list[str]:
    """Returns the names of the analyses that have quantities."""
    return list(dict.fromkeys(a for a in map(analysis_of, file.get("quantities", {}).values()) if a in file["analyses"]))


def _one(scene: Scene, formulation: str, n: int) -> tuple[float, float, Any]:
    """Returns the shortest times of set-up and of solution in a round, and the result. The library measures the solution;
    the rest of the call, such as the model and the tables of results, counts as set-up."""
    begun, setup, solution, result = time.perf_counter(), math.inf, math.inf, None
    while result is None or time.perf_counter() - begun < ROUND:
        start = clock()
        try:
            result = scene.solve(formulation, n, threads=1, stability=False)
        except NoValue as error:  # only some of the quantities have a value
            result = error.result
            if result is None:
                raise Failed(str(error)) from error
        except (NotConverged, Singular) as error:
            raise Failed(str(error)) from error
        except Error as error:
            raise Refused(str(error)) from error
        took, own = clock() - start, result.cell["seconds_solve"]
        setup, solution = min(setup, took - own), min(solution, own)
    return setup, solution, result


def solved(_peer: Any, scenes: Mapping[str, Scene], formulation: str, n: int) -> dict[str, Any]:
    """Solves one mesh, as _solved() of run.py does."""
    setup, seconds, result = _one(scenes[""], formulation, n)
    times, systems = {"": seconds}, {}
    for name, scene in scenes.items():
        if name:
            _, times[name], own = (setup, seconds, result) if scene is scenes[""] else _one(scene, formulation, n)
            systems[name] = own.cell["factorisations"]
    curves = {name: [list(pair) for pair in zip(*(axis.tolist() for axis in result.curve(name)))] for name in result.curves}
    values = {name: value for name, value in {**result.values, **curves}.items() if isinstance(value, list) or math.isfinite(value)}
    return {"setup": setup, "seconds": seconds, "times": times, "unknowns": result.cell["free"], "settings": "defaults",
            "iterations": result.cell["factorisations"], "systems": systems, "values": values, "refused": {}}
