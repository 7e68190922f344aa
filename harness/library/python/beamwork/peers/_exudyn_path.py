"""Paths with limit points in Exudyn: of several constraints of coordinates, one is active at a time."""
from __future__ import annotations

from typing import Any

from ._path import HeldPath, follow, free_places, require_proportional
from .data import Analysis, Answer, PathPoint

Place = tuple[str, int]


def add_controls(model: Any) -> dict[Place, int]:
    """Adds the constraints that control the continuations of the scene."""
    controls: dict[Place, int] = {}
    for analysis in model.scene.analyses.values():
        if analysis.kind == "continuation":
            require_proportional(model.scene)
            for name, i in free_places(model.scene, analysis):
                if (name, i) not in controls and model.moves(i):
                    zero = model.add("MarkerNodeCoordinate", nodeNumber=model.ground, coordinate=0)
                    marker = model.add("MarkerNodeCoordinate", nodeNumber=model.node_of(name), coordinate=i)
                    controls[name, i] = model.add("CoordinateConstraint", markerNumbers=[zero, marker], activeConnector=False)
    return controls


class _Path(HeldPath):
    """The path, controlled by constraints of coordinates, of which one is active at a time."""

    def __init__(self, model: Any, analysis: Analysis) -> None:
        super().__init__()
        self.model, self.places = model, [place for place in free_places(model.scene, analysis) if place in model.controls]
        self.active = 0
        for place in self.places:
            self.model.mbs.SetObjectParameter(self.model.controls[place], "activeConnector", False)

    def save(self) -> Any:
        return self.model.mbs.systemData.GetODE2Coordinates(configuration=self.model.exu.ConfigurationType.Current)

    def restore(self, saved: Any) -> None:
        self.model.mbs.systemData.SetODE2Coordinates(saved, configuration=self.model.exu.ConfigurationType.Current)

    def begin(self) -> None:
        self.restore(self.model.undeformed)
        self.factor = 0.0

    def hold(self, place: int, value: float) -> None:
        mbs, controls = self.model.mbs, self.model.controls
        mbs.SetObjectParameter(controls[self.places[self.active]], "activeConnector", False)
        mbs.SetObjectParameter(controls[self.places[place]], "activeConnector", True)
        mbs.SetObjectParameter(controls[self.places[place]], "offset", value)
        self.active = place

    def reaction(self, place: int, factor: float) -> tuple[int, float | None]:
        if not self.model.step(factor):
            return self.model.most_iterations, None
        types = self.model.exu.OutputVariableType
        force = float(self.model.mbs.GetObjectOutput(self.model.controls[self.places[place]], types.Force))
        return self.model.newton_steps(), force

    def point(self) -> PathPoint:
        state = self.model.state()
        return PathPoint(self.factor, [float(state.u[name][i] or 0.0) for name, i in self.places], state)


def follow_path(model: Any, analysis: Analysis) -> Answer:
    path = _Path(model, analysis)
    answer = follow(path, analysis, model.scene, (model.name, len(model.mesh.elements)))
    model.mbs.SetObjectParameter(model.controls[path.places[path.active]], "activeConnector", False)
    path.begin()
    return answer
