"""Motions of rods of PyElastica by its explicit method PositionVerlet."""
from __future__ import annotations

import math
from typing import Any

from . import _motion
from .data import Analysis, Answer, Failed, Load, Scene, State, rotation_vector

_STEP = 0.5  # product of the largest time step and the highest frequency
_SAMPLES = 400


def _largest_step(model: Any) -> float:
    """Returns a time step for which the method is stable at the highest frequencies of a rod with free ends."""
    s, size = model.section, model.scene.length() / model.number
    stretch = 2 / size * math.sqrt(max(s.EA, *s.GA) / s.rho_A)
    bend = 2 / size * math.sqrt(max(k / i for k, i in zip((s.GIt, s.EIy, s.EIz), s.rho_I)))
    shear = math.sqrt(max(s.GA) / min(s.rho_I[1:]))
    return _STEP / math.hypot(stretch, bend, shear)


def set_masses(model: Any, rod: Any) -> None:
    s, size = model.section, model.scene.length() / model.number
    rod.mass[...] = size * s.rho_A
    rod.mass[0] = rod.mass[-1] = size * s.rho_A / 2
    for i, inertia in enumerate((s.rho_I[1], s.rho_I[2], s.rho_I[0])):
        rod.mass_second_moment_of_inertia[i, i] = size * inertia
        rod.inv_mass_second_moment_of_inertia[i, i] = 1 / (size * inertia)


def fixed(scene: Scene, held: frozenset[str]) -> str:
    """Returns the support of an end: clamped, pinned or free; "": another support."""
    k = _motion.normal(scene)
    if not held:
        return "free"
    if len(held) == 6:
        return "clamped"
    return "pinned" if {"ux", "uy", "uz"} <= held and k is not None and "r" + "xyz"[k] not in held else ""


def _world(model: Any, analysis: Analysis, holds: list[str]) -> Any:
    import elastica
    import numpy as np

    scene, rod = model.scene, model.rod
    loads = [(load, _motion.load_factor(scene, load, analysis), np.array(load.vector, dtype=float)) for load in scene.loads]
    end = {name: (0 if i == 0 else -1) for i, name in enumerate(model.ends)}

    def apply_forces(_: Any, system: Any, time: Any = 0.0) -> None:
        for load, factor, vector in loads:
            if load.kind == "gravity":
                system.external_forces += factor(float(time)) * np.outer(vector, system.mass)
            elif load.kind == "force":
                system.external_forces[:, end[str(load.node)]] += factor(float(time)) * vector

    def apply_torques(_: Any, system: Any, time: Any = 0.0) -> None:
        for load, factor, vector in loads:
            if load.kind == "moment":
                k = end[str(load.node)]
                system.external_torques[:, k] += system.director_collection[..., k] @ (factor(float(time)) * vector)

    parts = (elastica.BaseSystemCollection, elastica.Constraints, elastica.Forcing)
    world: Any = type("System", parts, {})()
    world.append(rod)
    for k, hold in zip((0, -1), holds):
        if hold != "free":
            world.constrain(rod).using(elastica.FixedConstraint, constrained_position_idx=(k, ),
                                       constrained_director_idx=(k, ) if hold == "clamped" else ())
    world.add_forcing_to(rod).using(type("Load", (elastica.NoForces, ), {"apply_forces": apply_forces, "apply_torques": apply_torques}))
    world.finalize()
    return world


def _start(model: Any, analysis: Analysis, holds: list[str]) -> None:
    import numpy as np

    rod = model.rod
    for k in range(model.number + 1):
        v, w = _motion.start_velocity(analysis, [float(x) for x in rod.position_collection[:, k]])
        rod.velocity_collection[:, k] = v
        if k < model.number:
            rod.omega_collection[:, k] = rod.director_collection[..., k] @ np.array(w)
    for k, hold in zip((0, -1), holds):
        if hold != "free":
            rod.velocity_collection[:, k] = 0.0
        if hold == "clamped":
            rod.omega_collection[:, k] = 0.0


def _state(model: Any, holds: list[str], before: dict[str, list[float]]) -> State:
    """Returns the state. The rotations of the ends are extrapolated from two elements."""
    import numpy as np

    rod, u, reaction, rate = model.rod, dict[str, Any](), dict[str, Any](), dict[str, Any]()
    moved = rod.position_collection - model.places
    for k, name, hold in zip((0, -1), model.ends, holds):
        vectors = []
        for i in (k, 1 if k == 0 else -2):
            key = f"{name} {i}"
            turn = rod.director_collection[..., i].T @ model.frames[..., i]
            before[key] = _motion.continued(rotation_vector(turn.tolist()), before.get(key, [0.0] * 3))
            vectors.append(np.array(before[key]))
        u[name] = [float(x) for x in (*moved[:, k], *(1.5 * vectors[0] - 0.5 * vectors[1]))]
        rate[name] = [*(float(x) for x in rod.velocity_collection[:, k]), None, None, None]
        reaction[name] = [None if hold != "free" else 0.0] * 6
    return State(u, reaction, rate=rate)


def motion(model: Any, analysis: Analysis, holds: list[str]) -> Answer:
    """Solves a motion. The time step is the largest stable one times analysis.step/first_step, but at most
    analysis.step."""
    import elastica
    import numpy as np

    last = analysis.stations[-1]
    step = min(analysis.step, _largest_step(model) * analysis.step / _motion.first_step(model.scene, analysis))
    samples = min(_SAMPLES, math.ceil(last / step))
    each = math.ceil(last / step / samples)
    world, stepper = _world(model, analysis, holds), elastica.PositionVerlet()
    _start(model, analysis, holds)
    time, before = 0.0, dict[str, list[float]]()
    grid, states = [0.0], [_state(model, holds, before)]
    for i in range(samples):
        time = elastica.integrate(stepper, world, last / samples, each, restart_time=time, progress_bar=False)
        if not np.isfinite(model.rod.position_collection).all():
            raise Failed(f"PositionVerlet is unstable with {samples * each} time steps")
        grid.append(last * (i + 1) / samples)
        states.append(_state(model, holds, before))
    rod = model.rod
    kinetic = float(rod.compute_translational_energy() + rod.compute_rotational_energy())
    strain = float(rod.compute_bending_energy() + rod.compute_shear_energy())
    states[-1].energy = {"kinetic": kinetic, "strain": strain, "energy": kinetic + strain}
    return Answer(states, times=grid, iterations=samples * each)


def accepts(load: Load) -> bool:
    return load.kind == "gravity" or (load.kind in ("force", "moment") and load.node is not None and not load.follower)
