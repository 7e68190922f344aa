"""Paths with limit points in OpenSees and xara, by their displacement control."""
from __future__ import annotations

from typing import Any

from ._path import Path, free_places, require_proportional
from .data import Analysis, PathPoint


class PathOfModel(Path):
    """A path in OpenSees."""

    def __init__(self, model: Any, analysis: Analysis) -> None:
        require_proportional(model.scene)
        self.model, self.ops = model, model.ops
        self.places = free_places(model.scene, analysis)
        self.targets = [(model.mesh.node_of[name], i + 1) for name, i in self.places]

    def begin(self) -> None:
        self.model.build()
        self.ops.integrator("LoadControl", 0.0)
        self.ops.analysis("Static", "-noWarnings")

    def move(self, place: int, value: float) -> int:
        node, component = self.targets[place]
        self.ops.integrator("DisplacementControl", node, component, value - self.ops.nodeDisp(node, component))
        return max(int(self.ops.testIter()), 1) if self.ops.analyze(1) == 0 else -int(self.model.most_iterations)

    def point(self) -> PathPoint:
        return PathPoint(float(self.ops.getTime()), [float(self.ops.nodeDisp(*at)) for at in self.targets], self.model.state(False))


class PathOfFrame(Path):
    """A path in xara. Rotations of nodes are followed from point to point."""

    def __init__(self, frame: Any, analysis: Analysis) -> None:
        require_proportional(frame.scene)
        self.frame, self.places = frame, free_places(frame.scene, analysis)
        self.targets = [(frame.mesh.node_of[name], i + 1) for name, i in self.places]

    def begin(self) -> None:
        self.turns = self.frame.no_turns()
        self.model = self.frame.loaded_along_path()

    def move(self, place: int, value: float) -> int:
        node, component = self.targets[place]
        increment = value - float(self.model.nodeDisp(node, component))
        self.model.integrator("DisplacementControl", node, component, increment)
        return max(int(self.model.numIter()), 1) if self.model.analyze(1) == 0 else -20

    def point(self) -> PathPoint:
        self.frame.follow_turns(self.model, self.turns)
        values = [float(self.model.nodeDisp(*at)) for at in self.targets]
        return PathPoint(float(self.model.getTime()), values, self.frame.state(self.model, self.turns))
