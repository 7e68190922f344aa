"""Exudyn: geometrically exact beams, ANCF cable in the plane, ANCF beam in space; statics, modes and motions."""
from __future__ import annotations

import importlib.metadata

from ._exudyn_cable import Cable
from ._exudyn_plane import Plane
from ._exudyn_space import Space
from ._loads import KEYS
from .data import Element, Mesh, Model, Scene

NAME, PROGRAM, LICENCE = "exudyn", "Exudyn", "EXUDYN General License 1.0, terms of BSD-3-Clause"
HOMEPAGE = "https://github.com/jgerstmayr/EXUDYN"
REQUIRES = ("exudyn==1.13.6", )
_ANALYSES = frozenset({"static", "modal", "continuation"})
_PHYSICS = frozenset({"shear", "large rotations", "geometric", "mass", "rotary inertia"})
_FEW, _ALL = frozenset({"loads.follower", "modal.about"}), _ANALYSES | {"motion"}
_KEYS = KEYS | _FEW | {"springs", "members.release", "nodes.mass", "nodes.inertia"}
ELEMENTS = {
    "exact_2d": Element("geometrically exact, 2 nodes, xy plane only", _PHYSICS, _ALL | {"compliance"}, keys=_KEYS | {"plane"}),
    "exact_2d_3": Element("geometrically exact, 3 nodes, xy plane only", _PHYSICS, _ALL | {"compliance"}, 2, _KEYS | {"plane"}),
    "cable_2d": Element("ANCF cable, Euler-Bernoulli, 2 nodes, Lobatto and Gauss points (useReducedOrderIntegration=2), xy plane only",
                        frozenset({"large rotations"}), frozenset({"static"}), keys=frozenset({"loads.follower", "plane"})),
    "exact_3d": Element("geometrically exact, 2 nodes, helical interpolation", _PHYSICS, _ALL | {"compliance", "buckling"}, keys=_KEYS),
    # The mass matrix of the ANCF beam contains the rate of the sum of both slopes, and depends on the axes of the scene.
    "ancf_3d": Element("ANCF beam with cross-section slopes, 2 nodes; unfinished, according to its authors", _PHYSICS, _ANALYSES, keys=_FEW),
}


def version() -> str:
    return importlib.metadata.version("exudyn")


def build(scene: Scene, element: str, mesh: Mesh) -> Model:
    kind: type[Model] = Cable if element == "cable_2d" else Plane if element.startswith("exact_2d") else Space
    return kind(scene, element, mesh)  # type: ignore[call-arg]
