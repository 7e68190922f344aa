"""PyNite: linear analysis of frames with Euler-Bernoulli elements."""
from __future__ import annotations

import importlib.metadata
import math
from typing import Any

from ._hinges import hinges, idle
from ._loads import KEYS, THERMAL, acts, nodal, require_known
from .data import COMPONENTS, Analysis, Answer, Element, Mesh, MeshElement, Model, Scene, State

NAME, PROGRAM, LICENCE = "pynite", "PyNite", "MIT"
HOMEPAGE = "https://github.com/JWock82/Pynite"
REQUIRES = ("PyNiteFEA==3.2.0", )
ELEMENTS = {"frame": Element("straight Euler-Bernoulli frame element", analyses=frozenset({"linear"}),
                             keys=KEYS | THERMAL | {"springs", "members.release"})}
_DEGREES = ("DX", "DY", "DZ", "RX", "RY", "RZ")
_FORCES = ("FX", "FY", "FZ", "MX", "MY", "MZ")


def version() -> str:
    return importlib.metadata.version("PyNiteFEA")


def _angle(member: Any, element: MeshElement) -> float:
    """Returns the angle [degrees] from the usual y axis of PyNite to the y axis of the section."""
    usual, own = member.T()[:3, :3], [[row[k] for row in element.R] for k in range(3)]
    y, z = (sum(own[1][i] * usual[k][i] for i in range(3)) for k in (1, 2))
    return math.degrees(math.atan2(z, y))


class Frame(Model):
    """The model."""
    settings = "analyze_linear, sparse solver"

    def __init__(self, scene: Scene, mesh: Mesh) -> None:
        from Pynite import FEModel3D  # pylint: disable=import-error,import-outside-toplevel
        self.scene, self.mesh, self.model = scene, mesh, FEModel3D()
        held = 0
        for node in mesh.nodes:
            self.model.add_node(f"n{node.number}", *node.at)
        for name, section in scene.sections.items():
            E, G = section.raw["E"], section.raw["G"]
            self.model.add_material(name, E, G, 0.3, 1.0)
            self.model.add_section(name, section.EA / E, section.EIy / E, section.EIz / E, section.GIt / G)
        for i, element in enumerate(mesh.elements):
            p, q = (f"n{k}" for k in element.nodes)
            name = element.member.section.name
            self.model.add_member(f"e{i}", p, q, name, name)
            member = self.model.members[f"e{i}"]
            member.rotation = _angle(member, element)
        released = dict[int, dict[str, bool]]()
        for hinge in hinges(scene, mesh):
            names = [f"{c[0].upper().replace('U', 'D')}{c[1]}{'ij'[hinge.end]}" for c in hinge.own]
            released.setdefault(hinge.element, {}).update(dict.fromkeys(names, True))
        for element_index, names_of in released.items():
            self.model.def_releases(f"e{element_index}", **names_of)
        loose = idle(scene)
        for own in scene.nodes.values():
            n = f"n{mesh.node_of[own.name]}"
            self.model.def_support(n, *(c in own.hold or c in own.drive or c in loose.get(own.name, ()) for c in COMPONENTS))
            held += len(own.hold | set(own.drive))
            for component, motion in own.drive.items():
                self.model.def_node_disp(n, _DEGREES[COMPONENTS.index(component)], scene.motion_value(motion, 1))
        for spring in scene.springs:
            for direction, stiffness in zip(_DEGREES, spring.stiffness):
                if stiffness != 0:
                    self.model.def_support_spring(f"n{mesh.node_of[spring.end]}", direction, stiffness)
        self._add_loads()
        self.unknowns = 6 * len(mesh.nodes) - held

    def _add_loads(self) -> None:
        """Adds forces along members as loads of elements, and other loads as forces and moments at nodes."""
        require_known(self.scene)
        for load in self.scene.loads:
            factor = self.scene.load_factor(load, 1)
            if load.kind != "distributed" or load.raw.get("lumped") in ("yes", "true"):
                for number, vector in nodal(load, self.mesh, self.scene).items():
                    for direction, value in zip(_FORCES, vector):
                        if value != 0:
                            self.model.add_node_load(f"n{number}", direction, factor * value)
                continue
            begin, end = load.raw.get("from", 0.0), load.raw.get("to", 1.0)
            for k, element in enumerate(self.mesh.elements):
                if acts(load, element):
                    x, y = ((at - begin) / (end - begin) for at in (element.begin, element.end))
                    for direction, p, q in zip(_FORCES, load.vector, load.raw.get("to_value", load.vector)):
                        if p != 0 or q != 0:
                            self.model.add_member_dist_load(f"e{k}", direction, factor * (p + (q - p) * x), factor * (p + (q - p) * y))

    def solve(self, analysis: Analysis) -> Answer:
        self.model.analyze_linear(check_stability=False)
        u, reaction = {}, {}
        for name, number in self.mesh.node_of.items():
            node = self.model.nodes[f"n{number}"]
            u[name] = [float(getattr(node, d)["Combo 1"]) for d in _DEGREES]
            reaction[name] = [float(getattr(node, f"Rxn{f}")["Combo 1"]) for f in _FORCES]
        return Answer([State(u, reaction)], iterations=1)


def build(scene: Scene, element: str, mesh: Mesh) -> Model:
    del element
    return Frame(scene, mesh)
