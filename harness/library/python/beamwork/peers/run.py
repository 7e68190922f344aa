"""The process of a peer or of a formulation: `python -m beamwork.peers.run NAME` reads a request as a line of JSON and writes
a line of JSON about the program. Then it reads numbers of elements, one on each line, and for each writes a line with the
results and the times of one round."""
from __future__ import annotations

import dataclasses
import importlib
import json
import math
import os
import sys
import time
from typing import Any

from . import _motion
from ._clock import ROUND, clock, least
from .data import Analysis, Answer, Failed, Mesh, Model, Refused, Scene
from ._modes import require_plain_mass
from .read import check, refusal, scene_of, value_of


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


def _groups(scene: Scene, asked: set[str]) -> list[list[Analysis]]:
    """Returns groups that together contain all analyses with quantities. Each group contains an analysis, preceded by its
    base analysis if there is one. Each group is solved with a separate model, so that no analysis starts from the state of
    another group."""
    wanted = [a for a in scene.analyses.values() if a.name in asked]
    states = {a.about for a in wanted}
    return [[*([scene.analyses[a.about]] if a.about else []), a] for a in wanted if a.name not in states]


def _once(peer: Any, scene: Scene, name: str, mesh: Mesh, groups: list[list[Analysis]]) -> tuple[
        float, dict[str, float], dict[str, Answer], Model]:
    """Solves all groups. Returns the time of set-up, that of each analysis, and the answers."""
    built, took, answers, model = 0.0, dict[str, float](), dict[str, Answer](), Model()
    for group in groups:
        start = clock()
        model = peer.build(scene, name, mesh)
        built += clock() - start
        for analysis in group:
            start = clock()
            answers[analysis.name] = model.solve(analysis)
            took[analysis.name] = clock() - start
    return built, took, answers, model


class _Steps:
    """The time steps of motions, which depend on the mesh. Later rounds of a mesh repeat the steps of the first."""

    def __init__(self, limit: float) -> None:
        self.limit = limit
        self.known: dict[int, tuple[dict[str, float], str]] = {}
        self.before: dict[str, Any] = {}  # values of the previous mesh
        self.searched = set[int]()  # meshes

    def of(self, n: int, scene: Scene, motions: list[Analysis], solved: Any) -> tuple[dict[str, float], str]:
        """Returns the steps for n elements, and a sentence about them. solved: values with given steps."""
        if not motions:
            return {}, ""
        if n not in self.known:
            require_plain_mass(scene)
            names = [q.name for q in scene.quantities if q.analysis in [a.name for a in motions]]
            steps, note, self.before = _motion.refined({a.name: _motion.first_step(scene, a) for a in motions}, solved,
                lambda a, b: _motion.difference(scene, [name for name in names if name in a and name in b], a, b),
                self.before, self.limit)
            self.known[n] = steps, note
        return self.known[n]


def _solved(peer: Any, scene: Scene, name: str, n: int, known: _Steps) -> dict[str, Any]:
    """Solves one mesh. Each time is the shortest of the round. times: for each analysis with quantities, the time of its
    solution with that of the state about which it is computed; "": all analyses."""
    element = peer.ELEMENTS[name]
    check(scene, element, peer.PROGRAM)
    asked = {q.analysis for q in scene.quantities if refusal(scene, element, q) == ""}
    about = {a.name: a.about for a in scene.analyses.values() if a.name in asked and a.about}
    if not asked:
        raise Refused("; ".join(sorted({refusal(scene, element, q) for q in scene.quantities})) or "no quantity")
    scene = scene.divided(n)
    mesh = scene.mesh(n, element.order)
    groups = _groups(scene, asked)
    motions = [group for group in groups if group[-1].kind == "motion"]

    def with_steps(some: list[list[Analysis]], steps: dict[str, float]) -> list[list[Analysis]]:
        return [[dataclasses.replace(a, step=steps.get(a.name, 0.0)) for a in group] for group in some]

    def values(steps: dict[str, float]) -> dict[str, Any]:
        _, _, answers, _ = _once(peer, scene, name, mesh, with_steps(motions, steps))
        part = dataclasses.replace(scene, quantities=tuple(q for q in scene.quantities if q.analysis in steps))
        return _values(part, element, answers)["values"]

    steps, note = known.of(n, scene, [group[-1] for group in motions], values)
    if n not in known.searched and any(a.kind == "continuation" for group in groups for a in group):
        _once(peer, scene, name, mesh, groups)  # this round finds the steps with which the path can be followed
    known.searched.add(n)
    begun, setup, answers, model = time.perf_counter(), math.inf, dict[str, Answer](), Model()
    took: dict[str, float] = {}
    while not answers or time.perf_counter() - begun < ROUND:
        built, one, answers, model = _once(peer, scene, name, mesh, with_steps(groups, steps))
        setup, took = min(setup, built), least(took, one)
    times = {a: took[a] + took.get(about.get(a, ""), 0.0) for a in took if a in asked}
    solved = {a: sum(answers[b].iterations for b in (a, about.get(a, "")) if b in answers) for a in times}
    return {"setup": setup, "seconds": sum(took.values()), "times": {**times, "": sum(took.values())},
            "unknowns": model.unknowns, "settings": "; ".join(filter(None, (model.settings, note))),
            "iterations": sum(a.iterations for a in answers.values()), "systems": solved, **_values(scene, element, answers)}


def _mesh(peer: Any, scene: Any, name: str, n: int, known: _Steps) -> dict[str, Any]:
    try:
        return {"elements": n, **(peer.solved(peer, scene, name, n) if hasattr(peer, "solved") else
                                  _solved(peer, scene, name, n, known))}
    except Refused as error:
        return {"elements": n, "refusal": str(error)}
    except Failed as error:
        return {"elements": n, "failure": str(error)}
    except Exception as error:  # pylint: disable=broad-exception-caught
        return {"elements": n, "failure": f"{type(error).__name__}: {error}"}


def main() -> None:
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # what the peer prints goes to standard error
    request = json.loads(sys.stdin.readline())
    if "processor" in request:
        os.sched_setaffinity(0, {request["processor"]})
    peer = importlib.import_module(f"{__package__}.{sys.argv[1]}")

    def say(line: dict[str, Any]) -> None:
        print(json.dumps(line), file=answers, flush=True)

    try:
        say({"version": peer.version()})
    except ImportError as error:
        say({"missing": f"{peer.PROGRAM} is not installed: {error}"})
        return
    scene = peer.scene_of(request["scene"]) if hasattr(peer, "solved") else scene_of(request["scene"])
    known = _Steps(0.6 * request.get("limit", 60.0))
    for n in map(int, sys.stdin):
        say(_mesh(peer, scene, request["element"], n, known))


if __name__ == "__main__":
    main()
