"""Motions of Exudyn's models: the generalised-alpha method, with sensors at the nodes and supports of the scene."""
from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from . import _motion
from .data import COMPONENTS, Analysis, Answer, Failed, Mesh, Node, Scene, Section, cross

_LEAST_RADIUS = 1e-4  # radius of gyration of sections without rotary inertia, relative to the length
Get = Callable[[str, int, str], list[float]]  # output of an item: ("Node" or "Object", number, name of the output)


SETTINGS = ("SolveDynamic, generalised alpha with spectral radius 0.9, Newton residuals below 1e-8 of the first, sparse; "
            f"least radius of gyration {_LEAST_RADIUS:g} L")


def moves(scene: Scene) -> bool:
    return any(a.kind == "motion" for a in scene.analyses.values())


def inertia(scene: Scene, section: Section) -> list[float]:
    """Returns the rotary inertias of a section about x, y, z [kg m]. In motions they are not zero, because the mass
    matrix must not be singular."""
    least = section.rho_A * (_LEAST_RADIUS * scene.length())**2 if moves(scene) else 0.0
    return [max(v, least) for v in section.rho_I]


def body(node: Node) -> tuple[float, list[float]]:
    """Returns the mass of a node, and its inertia tensor [xx, yy, zz, xy, yz, zx]."""
    return float(node.raw.get("mass", 0)), [float(v) for v in node.raw.get("inertia", (0, ) * 6)]


class Sensors:
    """Histories of outputs of items. Each is an array of rows [time, values...]."""

    def __init__(self, model: Any) -> None:
        self.model, self.numbers, self.rows = model, dict[Any, int](), dict[Any, Any]()

    def record(self, kind: str, item: int, output: str) -> list[float]:
        """Adds a sensor, unless it exists. Returns placeholders for its output, which is known only after the
        motion."""
        key = (kind, item, output)
        if key not in self.numbers:
            given = {f"{kind.lower()}Number": item, "outputVariableType": getattr(self.model.exu.OutputVariableType, output)}
            self.numbers[key] = self.model.mbs.AddSensor(getattr(self.model.items, f"Sensor{kind}")(
                writeToFile=False, storeInternal=True, **given))
        return [1.0, 0, 0, 0, 1.0, 0, 0, 0, 1.0] if output == "RotationMatrix" else [0.0] * 9

    def read(self) -> list[float]:
        """Reads the histories. Returns their times."""
        self.rows = {key: self.model.mbs.GetSensorStoredData(number) for key, number in self.numbers.items()}
        return [float(row[0]) for row in next(iter(self.rows.values()))] if self.rows else []

    def at(self, i: int) -> Get:
        return lambda kind, item, output: [float(x) for x in self.rows[kind, item, output][i][1:]]


def _functions(model: Any, analysis: Analysis) -> None:
    """Gives loads and prescribed motions their functions of time."""
    mbs = model.mbs
    for load, number, vector in model.loads:
        factor = _motion.load_factor(model.scene, load, analysis)
        mbs.SetLoadParameter(number, "loadVector", [factor(0.0) * x for x in vector])
        if "pieces" in load.raw:
            mbs.SetLoadParameter(number, "loadVectorUserFunction",
                                 lambda _, t, __, f=factor, v=tuple(vector): [f(t) * x for x in v])
    for name, item, component in [(name, item, -1) for name, item in model.driven] + model.turned:
        value = _motion.drive_value(model.scene, name, analysis)
        if component < 0:
            mbs.SetObjectParameter(item, "offset", value(0.0))
            mbs.SetObjectParameter(item, "offsetUserFunction", lambda _, t, __, ___, f=value: f(t))
        else:
            mbs.SetObjectParameter(item, "offsetUserFunction",
                                   lambda _, t, __, ___, f=value, k=component: [f(t) if i == k else 0.0 for i in range(6)])


def _round_off(mesh: Mesh) -> float:
    """Returns a bound of the round-off of forces, which follow from differences of positions [N]."""
    size = max(math.hypot(*node.at) for node in mesh.nodes)
    return max(4e-15 * max([e.member.section.EA, *(k for k in e.member.section.GA if k < math.inf)]) *
               (size + e.member.length) / e.length for e in mesh.elements)


def _force_scale(model: Any, analysis: Analysis) -> float:
    """Returns the order of magnitude of the forces of a motion [N]."""
    scene, length = model.scene, model.scene.length()
    mass = sum(_motion.lumped_mass(model.mesh)) + sum(body(node)[0] for node in scene.nodes.values())
    count = 64
    grid = [analysis.stations[-1] * i / count for i in range(count + 1)]
    scale = 0.0
    for load in scene.loads:
        factor = _motion.load_factor(scene, load, analysis)
        unit = {"gravity": mass, "moment": 1 / length}.get(load.kind, 1.0)
        scale = max(scale, unit * math.hypot(*load.vector) * max(abs(factor(t)) for t in grid))
    for node in scene.nodes.values():
        for word, name in node.drive.items():
            value = [_motion.drive_value(scene, name, analysis)(t) * (length if word[0] == "r" else 1.0) for t in grid]
            scale = max(scale, mass * max(abs(a - 2 * b + c) for a, b, c in zip(value, value[1:], value[2:])) / (grid[1] - grid[0])**2)
    start = analysis.raw.get("start", {})
    speed = max(math.hypot(*start.get("velocity", (0.0, ))), length * math.hypot(*start.get("spin", (0.0, ))))
    return float(max(scale, mass * speed**2 / length))


def _settings(model: Any, analysis: Analysis, steps: int) -> Any:
    last = analysis.stations[-1]
    s = model.exu.SimulationSettings()
    s.solutionSettings.writeSolutionToFile = False
    s.solutionSettings.sensorsWriteFileHeader = s.solutionSettings.sensorsWriteFileFooter = False
    s.solutionSettings.sensorsWritePeriod = last / steps / 2
    t = s.timeIntegration
    t.verboseMode, t.endTime, t.numberOfSteps, t.adaptiveStep, t.newton.useModifiedNewton = 0, last, steps, False, False
    scale = _force_scale(model, analysis)
    t.newton.absoluteTolerance = min(_round_off(model.mesh), 1e-5 * scale) if scale > 0 else _round_off(model.mesh)
    s.linearSolverType = model.exu.LinearSolverType.EigenSparse
    return s


def _start_rates(model: Any, analysis: Analysis) -> None:
    """Sets the velocities at the start. The initial positions are the current ones."""
    data, mbs, configuration = model.mbs.systemData, model.mbs, model.exu.ConfigurationType
    position = data.GetODE2Coordinates(configuration=configuration.Current)
    data.SetODE2Coordinates(position, configuration=configuration.Initial)
    rates = [0.0] * len(position)
    slopes = {}
    for name, node in model.scene.nodes.items():
        for word, motion in node.drive.items():
            slopes[name, word] = _motion.derivatives(_motion.drive_value(model.scene, motion, analysis),
                                                     1e-6 * analysis.stations[-1])[0](0.0)
    types = model.exu.OutputVariableType
    for name, number in model.all_nodes():
        at = [float(x) for x in mbs.GetNodeOutput(number, types.Position)]
        v, w = _motion.start_velocity(analysis, at)
        for k, word in enumerate(COMPONENTS):
            if (name, word) in slopes:
                (v if k < 3 else w)[k % 3] = slopes[name, word]
        first = int(mbs.GetNodeODE2Index(number))
        for k, rate in enumerate(model.coordinate_rates(number, v, w)):
            rates[first + k] = rate
    data.SetODE2Coordinates_t(rates, configuration=configuration.Initial)


def quaternion_rate(p: list[float], w: list[float]) -> list[float]:
    """Returns the time derivative of Euler parameters. w: angular velocity along fixed axes."""
    turned = cross(w, p[1:])
    return [-0.5 * sum(a * b for a, b in zip(w, p[1:])), *(0.5 * (p[0] * a + b) for a, b in zip(w, turned))]


def motion(model: Any, analysis: Analysis) -> Answer:
    """Solves a motion from the current state."""
    last = analysis.stations[-1]
    count = max(1, math.ceil(last / analysis.step * (1 - 1e-9)))
    _functions(model, analysis)
    _start_rates(model, analysis)
    try:
        done = model.mbs.SolveDynamic(_settings(model, analysis, count), storeSolver=True)
    except (RuntimeError, ValueError) as error:
        raise Failed(f"SolveDynamic: {' '.join(str(error).split())[:200]}") from error
    if not done:
        raise Failed(f"SolveDynamic: Newton's method does not converge with {count} time steps")
    solver = model.mbs.sys["dynamicSolver"]
    times = model.sensors.read() or [last]
    if len(times) != count + 1 and model.sensors.rows:
        raise Failed(f"sensors: {len(times)} samples of {count} time steps")
    states = [model.state(model.sensors.at(i)) for i in range(len(times))]
    _continue(states)
    for state in states:  # Lagrange multipliers have opposite signs in SolveStatic and SolveDynamic
        state.reaction = {name: [-x for x in values] for name, values in state.reaction.items()}
    states[-1].energy = _energy(model, solver)
    return Answer(states, times=times, iterations=int(solver.it.newtonStepsCount))


def _continue(states: list[Any]) -> None:
    """Makes the rotation vectors of each node continuous over time."""
    before: dict[str, list[float]] = {}
    for state in states:
        for name, u in state.u.items():
            before[name] = _motion.continued(u[3:], before.get(name, [0.0] * 3))
            u[3:] = before[name]


def _energy(model: Any, solver: Any) -> dict[str, float]:
    if not any(q.kind == "energy" for q in model.scene.quantities):
        return {}
    solver.ComputeMassMatrix(model.mbs)
    rates = model.mbs.systemData.GetODE2Coordinates_t()
    kinetic = float(rates @ solver.GetSystemMassMatrix() @ rates) / 2
    strain, types = 0.0, model.exu.OutputVariableType
    for element, beam in model.beams:
        half = element.length / 12**0.5
        places = [0.0] if len(element.nodes) == 2 else [-half, half]  # the points of integration
        for x in places:
            forces = [float(f) for which in (types.ForceLocal, types.TorqueLocal)
                      for f in model.mbs.GetObjectOutputBody(beam, which, [x, 0, 0])]
            strain += element.length / len(places) / 2 * sum(f**2 / k for f, k in zip(forces, model.stiffness_of(element)))
    return {"kinetic": kinetic, "strain": strain, "energy": kinetic + strain}
