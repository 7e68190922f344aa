"""Modes and compliances of a model of Exudyn, from its matrices."""
from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ._modes import families, require_plain_mass, rigid_motions, spectrum
from .data import COMPONENTS, Analysis, Answer, Refused, State


def _whole(model: Any) -> tuple[Any, Any, Any]:
    """Returns the stiffness matrix, the Jacobian of the constraints by rows, and the mass matrix of the initial state."""
    import numpy  # pylint: disable=import-outside-toplevel
    solver, mbs, settings = model.exu.MainSolverStatic(), model.mbs, model.settings_of
    before, settings.linearSolverType = settings.linearSolverType, model.exu.LinearSolverType.EXUdense
    solver.InitializeSolver(mbs, settings)
    solver.ComputeMassMatrix(mbs)
    M = numpy.array(solver.GetSystemMassMatrix())
    solver.ComputeJacobianODE2RHS(mbs, scalarFactor_ODE2=-1, scalarFactor_ODE2_t=0, scalarFactor_ODE1=0)
    if solver.GetAEsize() > 0:
        solver.ComputeJacobianAE(mbs, scalarFactor_ODE2=1.0, scalarFactor_ODE2_t=0.0, scalarFactor_ODE1=0.0, velocityLevel=False)
    whole, n = numpy.array(solver.GetSystemJacobian()), len(M)
    solver.FinalizeSolver(mbs, settings)
    settings.linearSolverType = before
    return whole[:n, :n], whole[n:, :n], M


def _matrices(model: Any) -> tuple[Any, Any, Any]:
    """Returns the stiffness and mass matrices of the initial state, for motions that the constraints allow, and a
    matrix with these motions as columns. exudyn.solver.ComputeODE2Eigenvalues does the same, but requires that
    every motion has mass."""
    K, constraints, M = _whole(model)
    free = free_motions(constraints)
    return free.T @ K @ free, free.T @ M @ free, free


def _rotations(model: Any, state: Any) -> Any:
    """Returns the matrix that maps translations and small rotations about fixed axes (six for each node of the beam in
    space) to small changes of the coordinates with Euler parameters."""
    import numpy  # pylint: disable=import-outside-toplevel
    out = numpy.zeros((len(state), 6 * len(model.frame)))
    for k, node in enumerate(model.frame):
        first = int(model.mbs.GetNodeODE2Index(node))
        e0, e1, e2, e3 = model.parameters(node, state[first:first + 7])
        out[first:first + 3, 6 * k:6 * k + 3] = numpy.eye(3)
        out[first + 3:first + 7, 6 * k + 3:6 * k + 6] = [[-e1 / 2, -e2 / 2, -e3 / 2], [e0 / 2, e3 / 2, -e2 / 2], [-e3 / 2, e0 / 2, e1 / 2],
                                                         [e2 / 2, -e1 / 2, e0 / 2]]
    return out


def tangent(model: Any, state: Any) -> tuple[Any, Any]:
    """Returns the stiffness matrix and the Jacobian of the constraints of a state, for translations and small rotations
    about fixed axes of each node of the beam in space. The matrix does not contain the effect of moments at nodes (see
    moment_stiffness())."""
    types = model.exu.ConfigurationType
    model.mbs.systemData.SetODE2Coordinates(state, configuration=types.Initial)
    K, constraints, _ = _whole(model)
    T = _rotations(model, state)
    return T.T @ K @ T, constraints @ T


def free_motions(constraints: Any) -> Any:
    """Returns the motions that the constraints allow, as columns."""
    import numpy  # pylint: disable=import-outside-toplevel
    if not numpy.abs(constraints).max(initial=0) > 0:
        return numpy.eye(constraints.shape[1])
    _, sizes, motions = numpy.linalg.svd(constraints)
    return motions[int((sizes > 1e-12 * sizes.max()).sum()):].T


def _moment_stiffness(M: Sequence[float]) -> list[list[float]]:
    """Returns the stiffness of rotations against a moment whose vector is constant, where K is symmetric: Euler parameters
    turn the moment by half of the rotation."""
    x, y, z = (v / 2 for v in M)
    return [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]]


def _require_plain(model: Any, analysis: Analysis) -> None:
    """Raises Refused if the tangent of a loaded state lacks effects of follower loads, or of moments in hinges in space."""
    if not model.name.startswith("exact_2d") and any("release" in member.raw for member in model.scene.members.values()):
        raise Refused(f"release: in space, the driver does not support {analysis.kind} analyses about a state of members with hinges")
    for load in model.scene.loads:
        if load.follower:
            raise Refused(f"follower: the driver does not support {analysis.kind} analyses with follower loads ({load.name})")


def compliance(model: Any, analysis: Analysis) -> list[State]:
    """Returns the compliance at a node from the tangents of the states. Constraints of released components are omitted; the
    forces and moments that replace them are constant."""
    if analysis.about is not None:
        _require_plain(model, analysis)
    if model.name.startswith("exact_2d"):
        return [State(compliance=_plane_compliance(model, analysis, q)) for _, q, _ in model.states_about(analysis)]
    return [State(compliance=_space_compliance(model, analysis, *one)) for one in model.states_about(analysis)]


def require_no_torque(model: Any, state: State, released: Mapping[str, set[str]]) -> None:
    """Raises Refused if a support fixes one rotation by a moment. The effect of such a moment on the other rotations is
    that of a joint of Exudyn, and is not included."""
    largest = max((abs(x or 0) for values in state.reaction.values() for x in values[3:]), default=0.0)
    for name, items in model.held.items():
        left = [k for _, components in items for k in components if k > 2 and COMPONENTS[k] not in released.get(name, ())]
        if len(left) == 1 and abs(state.reaction[name][left[0]] or 0) > 1e-6 * largest:
            raise Refused(f"hold: a moment holds one rotation of {name}, whose effect on the other rotations is not included")


def _space_compliance(model: Any, analysis: Analysis, path: float, coordinates: Any, state: State) -> list[list[float]]:
    import numpy  # pylint: disable=import-outside-toplevel
    name, released = analysis.raw["node"], set(analysis.raw.get("released", ()))
    require_no_torque(model, state, {name: released})
    K, constraints = tangent(model, coordinates)
    places = {node: 6 * k for k, node in enumerate(model.frame)}
    own = places[model.of[name][0]]
    moments = [(places[model.of[load.node][0]], [model.scene.load_factor(load, path) * v for v in load.vector])
               for load in model.scene.loads if load.kind == "moment" and load.node is not None] if analysis.about else []
    moments.append((own, [float(state.reaction[name][k + 3] or 0) if c in released else 0.0 for k, c in enumerate(COMPONENTS[3:])]))
    for place, M in moments:
        K[place + 3:place + 6, place + 3:place + 6] += _moment_stiffness(M)
    omitted, more = list[int](), list[Any]()
    for item, components in model.held.get(name, []):
        words = {COMPONENTS[k] for k in components}
        rows = list(model.mbs.systemData.GetObjectLTGAE(item))
        if len(components) == 1 and words <= released:
            omitted += rows
        turns = [c for c in COMPONENTS[3:] if c in words]
        if released & set(turns):
            omitted += rows[3:]
            more += [numpy.eye(1, len(K), own + COMPONENTS.index(c))[0] for c in turns if c not in released]
    kept = [row for i, row in enumerate(constraints) if i not in omitted] + more
    free = free_motions(numpy.array(kept).reshape(-1, len(K)))
    loads = free[own:own + 6].T
    moved = loads.T @ numpy.linalg.solve(free.T @ K @ free, loads)
    return [[float(v) for v in row] for row in moved]


def _plane_compliance(model: Any, analysis: Analysis, coordinates: Any) -> list[list[float | None]]:
    import numpy  # pylint: disable=import-outside-toplevel
    name, released = analysis.raw["node"], analysis.raw.get("released", [])
    model.mbs.systemData.SetODE2Coordinates(coordinates, configuration=model.exu.ConfigurationType.Initial)
    K, constraints, _ = _whole(model)
    omitted = {row for item, (component, ) in model.held.get(name, []) if COMPONENTS[component] in released
               for row in model.mbs.systemData.GetObjectLTGAE(item)}
    C = constraints[[row for row in range(len(constraints)) if row not in omitted]]
    both = numpy.block([[K, C.T], [C, numpy.zeros((len(C), len(C)))]])
    first, places = int(model.mbs.GetNodeODE2Index(model.node_at[model.mesh.node_of[name]])), (0, 1, 5)
    loads = numpy.zeros((len(both), 3))
    loads[first:first + 3] = numpy.eye(3)
    moved = numpy.linalg.solve(both, loads)[first:first + 3]
    out: list[list[float | None]] = [[None] * 6 for _ in range(6)]
    for i, row in enumerate(places):
        for k, column in enumerate(places):
            out[row][column] = float(moved[i, k])
    return out


def _shape(model: Any, vector: Any) -> list[list[float]]:
    """Returns the components of a mode at the nodes of the mesh."""
    out = [[0.0] * 6 for _ in model.mesh.nodes]
    for number, node in model.node_at.items():
        first = int(model.mbs.GetNodeODE2Index(node))
        part = [float(x) for x in vector[first:first + 7]]
        if model.name.startswith("exact_2d"):
            out[number] = [*part[:2], 0.0, 0.0, 0.0, part[2]]
        else:
            e0, e1, e2, e3 = model.mbs.GetNodeParameter(node, "referenceCoordinates")[3:]
            d0, d1, d2, d3 = part[3:]
            turn = (e0 * d1 - e1 * d0 + e2 * d3 - e3 * d2, e0 * d2 - e2 * d0 + e3 * d1 - e1 * d3, e0 * d3 - e3 * d0 + e1 * d2 - e2 * d1)
            out[number] = [*part[:3], *(2 * x for x in turn)]
    return out


def modal(model: Any, analysis: Analysis) -> Answer:
    """Computes the frequencies about the initial state of the model."""
    scene, mesh = model.scene, model.mesh
    require_plain_mass(scene)
    if model.name == "ancf_3d":
        raise Refused("modal: in Exudyn 1.13.6, the mass matrix of the ANCF beam couples its two slopes")
    if model.name.startswith("exact_2d") and scene.plane != "xy":
        raise Refused("modal: the plane beam has no modes out of its plane; state 'plane: xy' in the scene")
    if analysis.about is not None:
        _require_plain(model, analysis)
        if not model.name.startswith("exact_2d") and any(load.kind.endswith("moment") for load in scene.loads):
            raise Refused("about: the driver does not support modes in space under moments, for which the tangent is not symmetric")
    rigid = rigid_motions(scene, mesh)
    if rigid and analysis.about is not None:
        raise Refused("about: the driver does not support modes of a loaded structure if its supports leave it free to move")
    K, M, free = _matrices(model)
    found, vectors = spectrum(K, M, rigid)
    shapes = [_shape(model, free @ vectors[:, i]) for i in range(len(found))]
    return Answer(frequencies=found, families=families(mesh, found, shapes), iterations=1)
