"""Modes and compliances of a model of Exudyn, from its matrices."""
from __future__ import annotations

from typing import Any

from ._modes import families, require_plain_mass, rigid_motions, spectrum
from .data import COMPONENTS, Analysis, Answer, Refused


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
    import numpy  # pylint: disable=import-outside-toplevel
    K, constraints, M = _whole(model)
    free = numpy.eye(len(M))
    if len(constraints) > 0:
        _, sizes, motions = numpy.linalg.svd(constraints)
        free = motions[int((sizes > 1e-12 * sizes.max()).sum()):].T
    return free.T @ K @ free, free.T @ M @ free, free


def compliance(model: Any, analysis: Analysis) -> list[list[float | None]]:
    """Returns the compliance at a node of the plane beam from the tangent of the initial state. Constraints of released
    components are omitted; the forces that replace them are constant."""
    import numpy  # pylint: disable=import-outside-toplevel
    name, released = analysis.raw["node"], analysis.raw.get("released", [])
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
    rigid = rigid_motions(scene, mesh)
    if rigid and analysis.about is not None:
        raise Refused("about: the driver has no modes of a structure under loads that its supports do not hold")
    K, M, free = _matrices(model)
    found, vectors = spectrum(K, M, rigid)
    shapes = [_shape(model, free @ vectors[:, i]) for i in range(len(found))]
    return Answer(frequencies=found, families=families(mesh, found, shapes), iterations=1)
