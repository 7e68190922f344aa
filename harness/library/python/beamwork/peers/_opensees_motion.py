"""Motions of OpenSees' models: Newmark's method (the trapezoidal rule) with lumped masses. With HHT, driven nodes would lag
their prescribed displacements at the end of a step."""
from __future__ import annotations

import math
from typing import Any

from . import _motion
from ._loads import nodal
from ._modes import diagonal_inertia
from ._opensees_springs import reactions
from .data import COMPONENTS, Analysis, Answer, Failed, Node, Refused, State

_SMALL = 1e-2  # [rad] in space, inertias of nodes do not rotate with them, so larger rotations are rejected


def settings(length: float) -> str:
    return f"Newmark 0.5 0.25, Newton, NormDispIncr {_tolerance(length):.1e}; lumped mass"


def _tolerance(length: float) -> float:
    return 1e-10 * length


def _bodies(node: Node) -> list[float]:
    """Returns the mass of a node for each of the three translations, and its moments of inertia about x, y, z."""
    xx, yy, zz, *products = node.raw.get("inertia", (0.0, ) * 6)
    if any(products):
        raise Refused(f"inertia: nodes of OpenSees have no products of inertia ({node.name})")
    return [float(node.raw.get("mass", 0))] * 3 + [xx, yy, zz]


def _masses(model: Any) -> list[list[float]]:
    """Adds bodies and rotary inertias to nodes. Returns the masses of the six components of each node of the mesh."""
    scene, mesh = model.scene, model.mesh
    whole = [[m] * 3 + [0.0] * 3 for m in _motion.lumped_mass(mesh)]
    own = [[0.0] * 6 for _ in mesh.nodes]
    normal = _motion.normal(scene)
    for number, inertia in diagonal_inertia(mesh, lambda s: s.rho_I, "OpenSees").items() if normal is None else ():
        own[number][3:] = inertia
    for element in mesh.elements if normal is not None else ():
        s = element.member.section
        for k in element.nodes:
            own[k][3 + (normal or 0)] += element.length / 2 * s.rho_I[2 if abs(element.R[normal or 0][2]) > 0.5 else 1]
    for node in scene.nodes.values():
        k = mesh.node_of[node.name]
        own[k] = [a + b for a, b in zip(own[k], _bodies(node))]
    for k, masses in enumerate(own):
        if any(masses):
            model.ops.mass(k, *masses)
    return [[a + b for a, b in zip(m, n)] for m, n in zip(whole, own)]


def _loads(model: Any, analysis: Analysis) -> list[tuple[_motion.Function, dict[int, list[float]]]]:
    """Returns the factor of each load over time, and its forces and moments at nodes of the mesh for the factor 1."""
    out = []
    for load in model.scene.loads:
        forces: dict[int, list[float]] = {}
        if load.kind == "gravity":
            for k, m in _gravity_masses(model, load).items():
                forces[k] = [m * g for g in load.vector] + [0.0] * 3
        else:
            forces = {k: list(force) for k, force in nodal(load, model.mesh, model.scene).items()}
        out.append((_motion.load_factor(model.scene, load, analysis), forces))
    return out


def _gravity_masses(model: Any, load: Any) -> dict[int, float]:
    if load.node is not None:
        return {model.mesh.node_of[load.node]: float(model.scene.nodes[load.node].raw.get("mass", 0))}
    out: dict[int, float] = {}
    for element in model.mesh.elements:
        for k in element.nodes if element.member.name == load.member else ():
            out[k] = out.get(k, 0.0) + element.length / 2 * element.member.section.rho_A
    return out


class _Series:
    """Patterns over time, from values at the ends of the time steps."""

    def __init__(self, model: Any, grid: list[float]) -> None:
        self.ops, self.grid, self.tag = model.ops, grid, model.next_tag

    def series(self, f: _motion.Function) -> int:
        self.tag += 1
        grid = [*self.grid, 2 * self.grid[-1] - self.grid[-2]]
        self.ops.timeSeries("Path", self.tag, "-time", *grid, "-values", *(f(t) for t in grid))
        return int(self.tag)


def _put(model: Any, analysis: Analysis, grid: list[float], loads: Any) -> None:
    """Replaces the loads and prescribed displacements along the path by those over time."""
    ops, series, step = model.ops, _Series(model, grid), grid[1]
    ops.setTime(0.0)
    for tag in range(1, model.next_tag):
        ops.remove("loadPattern", tag)
    for factor, forces in loads:
        tag = series.series(factor)
        ops.pattern("Plain", tag, tag)
        for k, force in forces.items():
            ops.load(k, *force)
    for node in model.scene.nodes.values():
        for word, name in node.drive.items():
            f = _motion.drive_value(model.scene, name, analysis)
            rate, acceleration = _motion.derivatives(f, step)
            tags = [series.series(g) for g in (f, rate, acceleration)]
            series.tag += 1
            ops.pattern("MultipleSupport", series.tag)
            ops.groundMotion(series.tag, "Plain", "-disp", tags[0], "-vel", tags[1], "-accel", tags[2])
            ops.imposedMotion(model.mesh.node_of[node.name], COMPONENTS.index(word) + 1, series.tag)


def _start(model: Any, analysis: Analysis, masses: list[list[float]], loads: Any) -> None:
    """Sets velocities and, because the method starts from given accelerations, those due to the loads at the start."""
    ops, scene = model.ops, model.scene
    force = [[0.0] * 6 for _ in model.mesh.nodes]
    for (factor, forces), load in zip(loads, scene.loads):
        before = scene.load_factor(load, scene.analyses[analysis.about].stations[-1]) if analysis.about else 0.0
        for k, one in forces.items():
            force[k] = [a + (factor(0.0) - before) * b for a, b in zip(force[k], one)]
    for node in model.mesh.nodes:
        at = [a + b for a, b in zip(node.at, ops.nodeDisp(node.number))]
        v, w = _motion.start_velocity(analysis, at)
        held = scene.held_at(node) | set(scene.nodes[node.name].drive if node.name is not None else ())
        for i, (rate, m, f) in enumerate(zip([*v, *w], masses[node.number], force[node.number])):
            if COMPONENTS[i] not in held:
                ops.setNodeVel(node.number, i + 1, rate, "-commit")
                if m > 0:
                    ops.setNodeAccel(node.number, i + 1, f / m, "-commit")


def _energy(model: Any, masses: list[list[float]]) -> dict[str, float]:
    ops = model.ops
    kinetic = sum(m * v**2 / 2 for k, one in enumerate(masses) for m, v in zip(one, ops.nodeVel(k)))
    strain = sum(q * v / 2 for i in range(1, len(model.mesh.elements) + 1) for q, v in zip(ops.basicForce(i), ops.basicDeformation(i)))
    return {"kinetic": kinetic, "strain": strain, "energy": kinetic + strain}


def motion(model: Any, analysis: Analysis) -> Answer:
    """Solves a motion from the current state."""
    ops, last = model.ops, analysis.stations[-1]
    count = max(2, math.ceil(last / analysis.step * (1 - 1e-9)))
    grid = [last * i / count for i in range(count + 1)]
    normal = _motion.normal(model.scene)
    masses = _masses(model)
    loads = _loads(model, analysis)
    _put(model, analysis, grid, loads)
    _start(model, analysis, masses, loads)
    ops.wipeAnalysis()
    ops.numberer("RCM")
    ops.constraints("Transformation")
    ops.system("BandGeneral")
    ops.test("NormDispIncr", _tolerance(model.scene.length()), 30)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient", "-noWarnings")
    nodes = _motion.asked(model.scene)
    states, iterations = [_state(model, nodes)], 0
    for t in grid[1:]:
        if ops.analyze(1, grid[1]) != 0:
            raise Failed(f"Newton's method does not converge at {t:g} s with {count} time steps")
        iterations += max(int(ops.testIter()), 1)
        states.append(_state(model, nodes))
    if normal is None:
        turned = max(math.hypot(*ops.nodeDisp(node.number)[3:]) for node in model.mesh.nodes)
        if turned > _SMALL:
            raise Refused(f"space: inertias of nodes do not rotate with them in OpenSees, and nodes turn by {turned:.2g} rad")
    states[-1].energy = _energy(model, masses)
    return Answer(states, times=grid, iterations=iterations)


def _state(model: Any, nodes: set[str]) -> State:
    """Returns the state. Rates of rotations are along fixed axes, which are also the axes of the nodes in the plane
    and for small rotations."""
    ops = model.ops
    ops.reactions("-dynamic")
    number = {name: model.mesh.node_of[name] for name in nodes}
    return State({name: [float(x) for x in ops.nodeDisp(k)] for name, k in number.items()},
                 {name: values for name, values in reactions(ops, model.scene, model.mesh).items() if name in nodes},
                 rate={name: [float(x) for x in ops.nodeVel(k)] for name, k in number.items()})
