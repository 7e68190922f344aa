"""PyElastica: discrete Cosserat rods. Equilibria are found by damped motion."""

from __future__ import annotations

import importlib.metadata
import math
from typing import Any

from . import _pyelastica_motion
from .data import Analysis, Answer, Element, Failed, Mesh, Model, Refused, Scene, State
from .data import rotation_vector

NAME, PROGRAM, LICENCE = "pyelastica", "PyElastica", "MIT"
HOMEPAGE = "https://github.com/GazzolaLab/PyElastica"
REQUIRES = ("pyelastica==1.0.0",)
ELEMENTS = {
    "rod": Element(
        "Cosserat rod: a rod clamped at one end; statics by damped motion; order of convergence 1",
        offers=frozenset({"shear", "large rotations", "mass", "rotary inertia"}),
        analyses=frozenset({"static", "motion"}),
        keys=frozenset({"loads.gravity"}),
    ),
}
_STEP = 0.2  # ratio of the time step to the time that the fastest wave takes to pass an element
_BLOCK = 0.5  # ratio of the time between checks to the time constant of the damping
_MOST_STEPS = 4_000_000
_COMPILED: list[bool] = []
_STILL = 1e-7  # largest change of the axes in a time constant, relative to their whole change


def version() -> str:
    return importlib.metadata.version("pyelastica")


def build(scene: Scene, element: str, mesh: Mesh) -> Model:
    return Rod(scene, mesh)


class Rod(Model):
    def __init__(self, scene: Scene, mesh: Mesh) -> None:
        self.scene, self.mesh = scene, mesh
        self.number = len(mesh.elements)
        self.settings = (
            f"PositionVerlet, AnalyticalLinearDamper, rotary inertia chosen, at rest within {_STILL:.0e} of the change"
        )
        self.moves = any(a.kind == "motion" for a in scene.analyses.values())
        self._refuse()
        first, last = mesh.elements[0].nodes[0], mesh.elements[-1].nodes[-1]
        held = [self.scene.nodes[str(mesh.nodes[n].name)].hold for n in (first, last)]
        self.ends = [str(mesh.nodes[n].name) for n in (first, last)]
        self.holds = [_pyelastica_motion.fixed(scene, h) for h in held]
        if "" in self.holds or (sorted(map(len, held)) != [0, 6] and not self._only_moves()):
            raise Refused("hold: the driver supports only rods with one clamped and one free end")
        self.reversed = len(held[0]) == 0
        self.section = mesh.elements[0].member.section
        if not all(map(math.isfinite, self.section.GA)):
            raise Refused("shear: the section is rigid in shear, but the rods of PyElastica deform in shear; give shear stiffnesses")
        self.unknowns = 6 * self.number
        self.steps = 0
        if self.moves and ("rotary inertia" not in scene.physics or min(self.section.rho_I) <= 0 or self.section.rho_A <= 0):
            raise Refused("rotary inertia: explicit steps require mass and inertia about all axes")
        if self._only_moves():
            self.settings = "PositionVerlet, without damping"
        self.rod = self._rod()
        if not _COMPILED and not self._only_moves():
            self._equilibrium([[0.0] * 3] * 2)  # compiles the functions of the program
            _COMPILED.append(True)
            self.steps = 0
            self.rod = self._rod()

    def _only_moves(self) -> bool:
        return all(a.kind == "motion" for a in self.scene.analyses.values())

    def _refuse(self) -> None:
        if self.number < 2:
            raise Refused("elements: a rod of this program has two or more")
        if len(self.scene.members) != 1:
            raise Refused("members: the driver supports only one rod")
        for load in self.scene.loads:
            if self._only_moves() and _pyelastica_motion.accepts(load):
                continue
            if load.follower or load.kind not in ("force", "moment"):
                raise Refused("loads: the driver supports only dead forces and moments at the free end")
            if self.scene.nodes[str(load.node)].hold:
                raise Refused("loads: the driver does not support loads on the clamped end")
        if len(self.scene.nodes) != 2:
            raise Refused("nodes: the driver supports no nodes except the two at the ends of the rod")
        if any(node.drive for node in self.scene.nodes.values()):
            raise Refused("drive: the driver does not support driven nodes")

    def _rod(self) -> Any:
        """Returns a rod whose first node is the clamped one. Directors: y, z and x of the section;
        a rod that runs against the member has y, -z and -x."""
        import elastica
        import numpy as np

        chain = [e.nodes[0] for e in self.mesh.elements] + [self.mesh.elements[-1].nodes[-1]]
        frames = [np.array(e.R, dtype=float) for e in self.mesh.elements]
        if self.reversed and not self._only_moves():
            chain.reverse()
            frames = [f @ np.diag([-1.0, 1.0, -1.0]) for f in reversed(frames)]
        at = np.array([self.mesh.nodes[n].at for n in chain], dtype=float).T
        directors = np.array([[f[:, 1], f[:, 2], f[:, 0]] for f in frames]).transpose(1, 2, 0).copy()
        length = sum(e.length for e in self.mesh.elements)
        rod = elastica.CosseratRod.straight_rod(
            self.number,
            at[:, 0],
            directors[2, :, 0],
            directors[0, :, 0],
            length,
            length / 100,
            1.0,
            youngs_modulus=1.0,
            shear_modulus=0.5,
            position=at,
            directors=directors,
        )
        s = self.section
        rod.shear_matrix[...] = np.diag([*s.GA, s.EA])[..., None]
        rod.bend_matrix[...] = np.diag([s.EIy, s.EIz, s.GIt])[..., None]
        rod.rest_kappa[...] = rod.kappa
        size = length / self.number
        rod.mass[...] = size
        rod.mass[0] = rod.mass[-1] = size / 2
        inertia = size * max(size, math.sqrt(max(s.EIy, s.EIz, s.GIt) / s.EA)) ** 2
        for i in range(3):
            rod.mass_second_moment_of_inertia[i, i] = inertia
            rod.inv_mass_second_moment_of_inertia[i, i] = 1 / inertia
        speed = math.sqrt(max(s.EA, *s.GA, max(s.EIy, s.EIz, s.GIt) * size / inertia))
        self.step = _STEP * size / speed
        self.frequency = 3.5 / length**2 * math.sqrt(min(s.EIy, s.EIz))
        self.frames = directors.copy()
        self.places = at.copy()
        return rod

    def solve(self, analysis: Analysis) -> Answer:
        if analysis.kind == "motion":
            if not self._only_moves():
                raise Refused("analyses: the driver supports motions only in scenes without other analyses")
            self.rod = self._rod()
            _pyelastica_motion.set_masses(self, self.rod)
            return _pyelastica_motion.motion(self, analysis, self.holds)
        states = [self._equilibrium(self._loads(p)) for p in analysis.stations]
        return Answer(states=states, iterations=self.steps)

    def _loads(self, p: float) -> Any:
        import numpy as np

        out = np.zeros((2, 3))
        for load in self.scene.loads:
            factor = float(self.scene.load_factor(load, p))
            out[int(load.kind == "moment")] += factor * np.array(load.vector, dtype=float)
        return out

    def _equilibrium(self, given: Any) -> State:
        import elastica
        import numpy as np

        loads = np.array(given)

        ramp = 2 / self.frequency

        def apply_forces(_: Any, system: Any, time: Any = 0.0) -> None:
            system.external_forces[:, -1] += min(1.0, time / ramp) * loads[0]

        def apply_torques(_: Any, system: Any, time: Any = 0.0) -> None:
            turned = system.director_collection[..., -1] @ loads[1]
            system.external_torques[:, -1] += min(1.0, time / ramp) * turned

        parts = (
            elastica.BaseSystemCollection,
            elastica.Constraints,
            elastica.Forcing,
            elastica.Damping,
        )
        Load: Any = type(
            "Load",
            (elastica.NoForces,),
            {"apply_forces": apply_forces, "apply_torques": apply_torques},
        )
        world: Any = type("System", parts, {})()
        world.append(self.rod)
        world.constrain(self.rod).using(
            elastica.OneEndFixedBC, constrained_position_idx=(0,), constrained_director_idx=(0,)
        )
        world.add_forcing_to(self.rod).using(Load)
        world.dampen(self.rod).using(
            elastica.AnalyticalLinearDamper,
            uniform_damping_constant=2 * self.frequency,
            time_step=np.float64(self.step),
        )
        world.finalize()
        stepper = elastica.PositionVerlet()
        count = max(1, round(_BLOCK / self.frequency / self.step))
        size = float(np.abs(loads[0]).max() + np.abs(loads[1]).max() / self.scene.length())
        noise = 4e-15 * self.section.EA * self.number  # round-off of forces from positions
        time, calm = 0.0, 0
        while calm < 3:
            before = self._rotations()
            time = elastica.integrate(
                stepper, world, count * self.step, count, restart_time=time, progress_bar=False
            )
            self.steps += count
            after = self._rotations()
            change = float(np.abs(after - before).max())
            whole = max(float(np.abs(after - self.frames).max()), 1e-5)
            if not math.isfinite(change) or self.steps > _MOST_STEPS:
                raise Failed("the rod does not come to rest")
            unbalanced = float(np.abs(self.rod.internal_forces[:, 0] - loads[0]).max())
            rest = change < _STILL * _BLOCK * whole and unbalanced <= 50 * _STILL * size + noise
            calm = calm + 1 if rest and time > ramp else 0
        return self._state()

    def _rotations(self) -> Any:
        return self.rod.director_collection.copy()

    def _state(self) -> State:
        """Returns the state. The rotation of the free end is extrapolated from the last two
        elements."""
        import numpy as np

        q = self.rod.director_collection
        turn = [q[..., i].T @ self.frames[..., i] for i in (-1, -2)]
        vectors = [np.array(rotation_vector(t.tolist())) for t in turn]
        end = 1.5 * vectors[0] - 0.5 * vectors[1]
        moved = self.rod.position_collection - self.places
        names = [name for name, node in self.scene.nodes.items() if node.hold]
        names += [name for name, node in self.scene.nodes.items() if not node.hold]
        force = -self.rod.internal_forces[:, 0]
        moment = -(q[..., 0].T @ self.rod.internal_torques[:, 0])
        zero = [0.0] * 6
        return State(
            u={names[0]: zero, names[1]: [float(x) for x in (*moved[:, -1], *end)]},
            reaction={names[0]: [float(x) for x in (*force, *moment)], names[1]: zero},
        )
