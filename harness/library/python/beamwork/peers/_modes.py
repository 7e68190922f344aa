"""Frequencies and critical factors from the matrices of a program, and the families of modes."""
from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

from ._loads import vectors
from .data import COMPONENTS, Failed, Mesh, Refused, Scene, Section, cross, times, transposed

_NOTHING = 1e-10  # relative size of rounding errors
_SAME = 1e-6  # relative difference of eigenvalues of a cluster


def rigid_motions(scene: Scene, mesh: Mesh) -> int:
    """Returns the number of rigid-body motions that the supports allow; members that share no node move separately."""
    import numpy as np  # pylint: disable=import-outside-toplevel
    part = list(range(len(mesh.nodes)))
    if any(s.begin is not None for s in scene.springs):
        raise Refused("springs: the driver does not support modes of structures with springs between nodes")
    for element in mesh.elements:
        kept = {part[k] for k in element.nodes}
        part = [min(kept) if p in kept else p for p in part]
    size = max(math.dist(mesh.nodes[0].at, node.at) for node in mesh.nodes) or 1.0
    free = 0
    for one in set(part):
        own = [node for node in mesh.nodes if part[node.number] == one]
        rows = []
        for node in own:
            arm = [(a - b) / size for a, b in zip(node.at, own[0].at)]
            turned = transposed([cross(axis, arm) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))])
            unit = [[float(i == k) for k in range(3)] for i in range(3)]
            motion = [[*unit[i], *turned[i]] for i in range(3)] + [[0.0] * 3 + unit[i] for i in range(3)]
            held = scene.held_at(node) | set(scene.nodes[node.name].drive if node.name is not None else ())
            held |= {c for s in scene.springs if s.begin is None and s.end == node.name for c, k in zip(COMPONENTS, s.stiffness) if k > 0}
            rows += [motion[COMPONENTS.index(c)] for c in held]
        free += 6 - (int(np.linalg.matrix_rank(np.array(rows), tol=1e-9)) if rows else 0)
    if free and any("release" in member.raw for member in scene.members.values()):
        raise Refused("release: the driver does not support modes of a structure with hinges if its supports leave it free to move")
    return free


def spectrum(K: Any, M: Any, rigid: int) -> tuple[list[float], Any]:
    """Returns the frequencies [Hz] in ascending order and the modes as columns. Coordinates without mass add no
    frequencies. The first `rigid` frequencies are zero: K does not resist these motions, except for rounding errors."""
    import numpy as np  # pylint: disable=import-outside-toplevel
    K, M = (K + K.T) / 2, (M + M.T) / 2
    if not np.abs(M).max(initial=0) > 0:
        raise Failed("the structure has no mass")
    scale = 1 / np.sqrt(np.diag(K) + _NOTHING * np.diag(K).max())
    k, m = scale[:, None] * K * scale, scale[:, None] * M * scale
    free = np.linalg.eigh(k)[1][:, :rigid]
    basis = np.linalg.svd((m @ free).T)[2][rigid:].T if rigid else np.eye(len(k))
    try:
        L = np.linalg.cholesky(basis.T @ k @ basis)
    except np.linalg.LinAlgError as error:
        raise Failed("the stiffness matrix is not positive definite: the state is unstable, or a motion has no "
                     "stiffness") from error
    half = np.linalg.solve(L, basis.T @ m @ basis)
    mu, y = np.linalg.eigh(np.linalg.solve(L, half.T))
    order = [i for i in np.argsort(-mu) if mu[i] > _NOTHING * 1e-4 * mu.max()]
    modes = scale[:, None] * np.hstack([free, basis @ np.linalg.solve(L.T, y[:, order])])
    found = [1 / math.sqrt(mu[i]) / (2 * math.pi) for i in order]
    for i in range(rigid):
        mode = modes[:, i]
        if found and mode @ K @ mode > 1e-4 * (2 * math.pi * found[0])**2 * (mode @ M @ mode):
            raise Failed("a rigid-body motion strains the elements")
    return [0.0] * rigid + found, modes


def critical_factors(K: Any, G: Any) -> list[float]:
    """Returns the positive factors f at which K + f G is singular, in ascending order."""
    import numpy as np  # pylint: disable=import-outside-toplevel
    scale = 1 / np.sqrt(np.diag(K))
    k, g = scale[:, None] * K * scale, scale[:, None] * G * scale
    try:
        L = np.linalg.cholesky((k + k.T) / 2)
    except np.linalg.LinAlgError as error:
        raise Failed("the structure without loads is not stable") from error
    A = np.linalg.solve(L, np.linalg.solve(L, g).T)
    mu = -np.linalg.eigvals(A)
    largest = np.abs(mu).max(initial=0)
    return sorted(1 / float(x.real) for x in mu if x.real > 1e-9 * largest and abs(x.imag) < 1e-6 * abs(x.real))


def require_axial_loads(scene: Scene, mesh: Mesh, why: str) -> None:
    """Raises Refused if a load is a moment or has a component across any member."""
    axes = [[float(row[0]) for row in e.R] for e in mesh.elements]
    for load in scene.loads:
        if load.kind.endswith("moment") or any(abs(sum(a * b for a, b in zip(x, v))) < (1 - 1e-9) * math.hypot(*v)
                                               for x in axes for v in vectors(load)):
            raise Refused(f"buckling: {why}")


def require_still_springs(scene: Scene, mesh: Mesh) -> None:
    """Raises Refused if loads before buckling may twist a rotational spring, because the rotation of its moment with the node
    would be that of the program's spring."""
    if any(any(s.stiffness[3:]) for s in scene.springs):
        require_axial_loads(scene, mesh, "drivers support rotational springs only if all loads are axial")


def _measures(mesh: Mesh, mode: Any) -> tuple[list[float], list[float]]:
    """Returns the motion of a mode at the nodes of all elements: translations along x, y and z of the member, and its
    twist times the radius of gyration; then rotations about z and y times this radius, for modes that do not translate.
    mode[nodes][6]."""
    moves, turns = [], []
    for element in mesh.elements:
        s = element.member.section
        radius = math.sqrt((s.EIy + s.EIz) / s.EA)
        for k, frame in zip(element.nodes, element.frames):
            u, r = (times(transposed(frame), mode[k][i:i + 3]) for i in (0, 3))
            moves += [*u, radius * r[0]]
            turns += [0.0, radius * r[2], -radius * r[1], 0.0]
    return moves, turns


def _separated(frequencies: Sequence[float], moves: Any) -> Any:
    """Returns the motions of the modes. Modes with equal frequencies are combined such that each moves along y or
    along z."""
    import numpy as np  # pylint: disable=import-outside-toplevel
    begin = 0
    for end in range(1, len(frequencies) + 1):
        if end < len(frequencies) and frequencies[end] <= frequencies[begin] * (1 + _SAME):
            continue
        if end - begin > 1:
            own = moves[begin:end]
            all_, along_z = own @ own.T, own[:, 2::4] @ own[:, 2::4].T
            L = np.linalg.cholesky(all_ + 1e-13 * np.trace(all_) * np.eye(end - begin))
            _, y = np.linalg.eigh(np.linalg.solve(L, np.linalg.solve(L, along_z).T))
            moves[begin:end] = np.linalg.solve(L.T, y).T @ own
        begin = end
    return moves


def families(mesh: Mesh, frequencies: Sequence[float], modes: Sequence[Any]) -> list[str]:
    """Returns the family of each mode: axial, bending_y, bending_z or torsion, by the largest sum of squares of motions.
    modes: for each mode, the components of all nodes of the mesh."""
    import numpy as np  # pylint: disable=import-outside-toplevel
    both = [_measures(mesh, mode) for mode in modes]
    if not both:
        return []
    moved, turned = (np.array([part[i] for part in both]) for i in (0, 1))
    stays = (moved**2).sum(axis=1) <= 1e-16 * (turned**2).sum(axis=1)
    motion = _separated(frequencies, np.where(stays[:, None], turned, moved))
    sums = np.array([[(row[k::4]**2).sum() for k in range(4)] for row in motion])
    return [("axial", "bending_y", "bending_z", "torsion")[int(i)] for i in sums.argmax(axis=1)]


def require_plain_mass(scene: Scene) -> None:
    """Raises Refused if a section is given by a mass matrix with terms off the diagonal, or with masses that differ
    between the axes."""
    for name, section in scene.sections.items():
        given = section.raw.get("mass")
        if given is not None and (any(given[i][k] != 0 for i in range(6) for k in range(6) if i != k) or
                                  any(given[i][i] != given[0][0] for i in (1, 2))):
            raise Refused(f"mass: the matrix of section {name} is not that of a mass at the centroid")


def nodal_inertia(mesh: Mesh, of: Callable[[Section], Sequence[float]]) -> dict[int, list[list[float]]]:
    """Returns moments of inertia of half an element at each of its ends, as a matrix in global axes for each node. of:
    rotary inertia about the axes of a section [kg m]."""
    out: dict[int, list[list[float]]] = {}
    for element in mesh.elements:
        R, own = element.R, of(element.member.section)
        for k in element.nodes:
            node = out.setdefault(k, [[0.0] * 3 for _ in range(3)])
            for i in range(3):
                for j in range(3):
                    node[i][j] += element.length / 2 * sum(R[i][m] * R[j][m] * own[m] for m in range(3))
    return out


def diagonal_inertia(mesh: Mesh, of: Callable[[Section], Sequence[float]], program: str) -> dict[int, list[float]]:
    """Returns the moments of inertia of nodal_inertia about global axes, for a program that does not support products of
    inertia. Raises Refused if a product of inertia is not zero."""
    out = nodal_inertia(mesh, of)
    for matrix in out.values():
        if max(abs(matrix[i][k]) for i in range(3) for k in range(i)) > 1e-9 * max(matrix[i][i] for i in range(3)):
            raise Refused(f"rotary inertia: nodes of {program} have it about global axes only, along which not all members are")
    return {k: [matrix[i][i] for i in range(3)] for k, matrix in out.items()}
