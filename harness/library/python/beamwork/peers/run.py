"""The process of a peer: `python -m beamwork.peers.run NAME` reads one request as JSON, and writes a line of JSON about the
program, then one for each mesh."""
from __future__ import annotations

import importlib
import json
import math
import os
import sys
import time
from typing import Any

from .data import Answer, Failed, Model, Refused, Scene
from .read import check, refusal, scene_of, value_of

_ENOUGH = 2.0  # [s] no further rounds after this time


def _finite(value: Any) -> bool:
    return all(map(_finite, value)) if isinstance(value, list) else math.isfinite(value)


def _values(scene: Scene, element: Any, answers: dict[str, Answer]) -> dict[str, dict[str, Any]]:
    values, refused = {}, {}
    for q in scene.quantities:
        why = refusal(scene, element, q)
        if why == "":
            try:
                values[q.name] = value_of(scene, q, answers[q.analysis])
            except Refused as error:
                why = str(error)
        if why:
            refused[q.name] = why
        elif not _finite(values[q.name]):
            raise Failed(f"{q.name} is not a finite number")
    return {"values": values, "refused": refused}


def _solved(peer: Any, scene: Scene, name: str, n: int, rounds: int) -> dict[str, Any]:
    """Solves one mesh. Each time is the shortest of all rounds."""
    element = peer.ELEMENTS[name]
    check(scene, element, peer.PROGRAM)
    asked = {q.analysis for q in scene.quantities if refusal(scene, element, q) == ""}
    needed = asked | {a.about for a in scene.analyses.values() if a.name in asked and a.about}
    if not asked:
        raise Refused("; ".join(sorted({refusal(scene, element, q) for q in scene.quantities})) or "no quantity")
    mesh = scene.mesh(n, element.order)
    setup = seconds = math.inf
    begun, answers, model = time.perf_counter(), {}, Model()
    for _ in range(rounds):
        start = time.perf_counter()
        model = peer.build(scene, name, mesh)
        ready = time.perf_counter()
        answers = {a.name: model.solve(a) for a in scene.analyses.values() if a.name in needed}
        end = time.perf_counter()
        setup, seconds = min(setup, ready - start), min(seconds, end - ready)
        if end - begun > _ENOUGH:
            break
    return {"setup": setup, "seconds": seconds, "unknowns": model.unknowns, "settings": model.settings,
            "iterations": sum(a.iterations for a in answers.values()), **_values(scene, element, answers)}


def _mesh(peer: Any, scene: Scene, name: str, n: int, rounds: int) -> dict[str, Any]:
    try:
        return {"elements": n, **_solved(peer, scene, name, n, rounds)}
    except Refused as error:
        return {"elements": n, "refusal": str(error)}
    except Failed as error:
        return {"elements": n, "failure": str(error)}
    except Exception as error:  # pylint: disable=broad-exception-caught
        return {"elements": n, "failure": f"{type(error).__name__}: {error}"}


def main() -> None:
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # what the peer prints goes to standard error
    request = json.load(sys.stdin)
    peer = importlib.import_module(f"{__package__}.{sys.argv[1]}")

    def say(line: dict[str, Any]) -> None:
        print(json.dumps(line), file=answers, flush=True)

    try:
        say({"version": peer.version()})
    except ImportError as error:
        say({"missing": f"{peer.PROGRAM} is not installed: {error}"})
        return
    scene = scene_of(request["scene"])
    for n in request["elements"]:
        say(_mesh(peer, scene, request["element"], n, request["rounds"]))


if __name__ == "__main__":
    main()
