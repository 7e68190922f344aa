"""Writes and runs input decks of CalculiX, and reads their results."""
import os
import pathlib
import shutil
import subprocess

import numpy as np
from scipy.sparse import coo_matrix, identity, lil_matrix
from scipy.sparse.linalg import splu

from reference.derive.beam import cross_matrix, exponential, rotation

# Positions of the nodes in half steps of the lattice: corners, then middles of the edges of the lower face, of the
# upper face, and between the faces.
BRICK = (
    (0, 0, 0),
    (2, 0, 0),
    (2, 2, 0),
    (0, 2, 0),
    (0, 0, 2),
    (2, 0, 2),
    (2, 2, 2),
    (0, 2, 2),
    (1, 0, 0),
    (2, 1, 0),
    (1, 2, 0),
    (0, 1, 0),
    (1, 0, 2),
    (2, 1, 2),
    (1, 2, 2),
    (0, 1, 2),
    (0, 0, 1),
    (2, 0, 1),
    (2, 2, 1),
    (0, 2, 1),
)


def graded(elements):
    """Returns stations from 0 to 1 [elements + 1], dense at both ends."""
    return (1 - np.cos(np.pi * np.arange(elements + 1) / elements)) / 2


def halved(stations):
    """Returns the stations together with the middles between them."""
    return np.sort(np.concatenate([stations, (stations[1:] + stations[:-1]) / 2]))


class Grid:
    """A mesh. `nodes` is [count, 3] in m and `elements` is [count, 20], with indices from zero."""

    def __init__(self, xs, ys, zs, wanted=lambda i, j, k: True):
        """xs, ys, zs are the stations of corners along each axis [m]. `wanted` returns True for the cells that are
        filled."""
        axes, number, nodes = [halved(np.asarray(a, dtype=float)) for a in (xs, ys, zs)], {}, []

        def node(place):
            if place not in number:
                number[place] = len(nodes)
                nodes.append([axis[i] for axis, i in zip(axes, place)])
            return number[place]

        cells = [c for c in np.ndindex(len(xs) - 1, len(ys) - 1, len(zs) - 1) if wanted(*c)]
        self.elements = np.array(
            [[node(tuple(2 * i + d for i, d in zip(c, offset))) for offset in BRICK] for c in cells]
        )
        self.nodes = np.array(nodes)

    def at(self, axis, value):
        return np.flatnonzero(np.abs(self.nodes[:, axis] - value) < 1e-9)


# Rigid end of a solid: the motion of its face, the resultant on the face, and the tangent between motion and resultant.
#
# The face moves in the same way as the edge of a shell, that is, as a rigid body whose thickness can change. The
# directions of the face rotate with the face.


def turned(vector):
    return rotation(exponential(np.asarray(vector, dtype=float)))


def spin(vector):
    phi, x = np.linalg.norm(vector), cross_matrix(np.asarray(vector, dtype=float))
    if phi < 1e-8:
        return np.eye(3) + x / 2
    return np.eye(3) + (1 - np.cos(phi)) / phi**2 * x + (phi - np.sin(phi)) / phi**3 * (x @ x)


class Tip:
    """A face of nodes [indices] about a point.

    `middle` contains the nodes that may not move along the thickness, which is axis 1 of the face.
    """

    def __init__(self, grid, nodes, middle, point):
        self.nodes, self.middle, self.point = (
            list(nodes),
            set(middle),
            np.asarray(point, dtype=float),
        )
        self.arms = {n: grid.nodes[n] - self.point for n in self.nodes}

    def held(self, node):
        """Returns the directions of the rotated face in which a node is fixed."""
        return (0, 1, 2) if node in self.middle else (0, 2)

    def boundary(self, translation, R):
        """Returns the cards of the directions of the face and of the motion along them."""
        cards = (
            "*TRANSFORM,NSET=TIP,TYPE=R\n"
            + ",".join("%.12e" % a for a in np.concatenate([R[:, 0], R[:, 1]]))
            + "\n"
        )
        motion = "*BOUNDARY\n"
        for n in self.nodes:
            along = R.T @ (np.asarray(translation) + R @ self.arms[n] - self.arms[n])
            motion += "".join(f"{n + 1},{d + 1},{d + 1},{along[d]:.12e}\n" for d in self.held(n))
        return cards, motion

    def resultant(self, displacements, forces, translation, R):
        """Returns (force [N], moment about the displaced point [N m]) on the face."""
        arms = self.displaced(displacements, translation, R)
        return sum(forces[n] for n in self.nodes), sum(
            np.cross(arms[n], forces[n]) for n in self.nodes
        )

    def displaced(self, displacements, translation, R):
        """Returns the arms of the nodes, which are rigid except along the thickness, where they follow the printed
        displacements (7 digits)."""
        out = {n: R @ self.arms[n] for n in self.nodes}
        for n in set(self.nodes) - self.middle:
            moved = displacements[n] - np.asarray(translation) + self.arms[n] - out[n]
            out[n] = out[n] + R[:, 1] * (R[:, 1] @ moved)
        return out

    def stiffness(self, tangent, displacements, forces, translation, R):
        """Returns d(force, spatial moment)/d(translation, spin) [6, 6]. `tangent` is the result of deck.tangent.

        Along the thickness, a node is free, and its force remains zero as this direction rotates. Therefore the force
        in fixed axes changes.
        """
        K, places = tangent
        index = {p: i for i, p in enumerate(places)}
        turn = self.directions(index, R)
        K, arms = (turn.T @ K @ turn).tocsc(), self.displaced(displacements, translation, R)
        prescribed = np.array([index[n, d] for n in self.nodes for d in self.held(n)])
        motion, load = np.zeros((2, len(places), 6))
        for n in self.nodes:
            for d in range(3):
                motion[index[n, d]] = np.concatenate([R[:, d], np.cross(arms[n], R[:, d])])
                load[index[n, d], 3:] = -np.cross(R[:, d], forces[n])
        rest = np.setdiff1d(np.arange(len(places)), prescribed)
        motion[rest] = splu(K[rest][:, rest].tocsc()).solve(
            load[rest] - K[rest][:, prescribed] @ motion[prescribed]
        )
        load[prescribed] = (K @ motion)[prescribed]
        return self.change(index, R, arms, forces, motion, load)

    def change(self, index, R, arms, forces, motion, load):
        out = np.zeros((6, 6))
        for n in self.nodes:
            rows = [index[n, d] for d in range(3)]
            force, moved = R @ load[rows], R @ motion[rows]
            moved[:, :3] -= np.eye(3)
            out[:3] += force
            out[3:] += np.cross(arms[n], force, axisb=0).T + np.cross(moved, forces[n], axisa=0).T
        return out

    def directions(self, index, R):
        """Returns the matrix [n, n] whose columns are the directions of the rotated face at the nodes of the face,
        and the fixed axes at all other nodes."""
        out = lil_matrix(identity(len(index)))
        for n in self.nodes:
            rows = [index[n, d] for d in range(3)]
            for i, row in enumerate(rows):
                for j, column in enumerate(rows):
                    out[row, column] = R[i, j]
        return out.tocsr()


PROGRAM = "ccx"
# Newton's iterations end at 1e-7 of the mean force and of the largest displacement (the defaults are 5e-3 and 1e-2).
CONTROLS = "*CONTROLS,PARAMETERS=FIELD\n1e-7,1e-7\n"


class Failed(Exception):
    """Raised if CalculiX found no solution. The text is the last message of CalculiX."""


def available():
    return shutil.which(PROGRAM) is not None


def mesh(grid, kind, material):
    """Returns the cards for nodes, elements and the only section. `material` contains the cards after *MATERIAL."""
    lines = (
        ["*NODE"]
        + ["%d,%.12e,%.12e,%.12e" % (i + 1, *p) for i, p in enumerate(grid.nodes)]
        + [f"*ELEMENT,TYPE={kind},ELSET=ALL"]
    )
    for i, element in enumerate(grid.elements):
        numbers = [str(i + 1)] + [str(n + 1) for n in element]
        lines += [",".join(numbers[:11]) + ",", ",".join(numbers[11:])]
    return (
        "\n".join(lines) + f"\n*MATERIAL,NAME=M\n{material}\n*SOLID SECTION,ELSET=ALL,MATERIAL=M\n"
    )


def node_set(name, nodes):
    return f"*NSET,NSET={name}\n" + "".join(f"{n + 1},\n" for n in nodes)


def elastic(young, poisson):
    return f"*ELASTIC\n{young:.12e},{poisson:.12e}\n*DENSITY\n1."


def run(folder, name, text):
    """Writes the deck and solves it in the folder. Returns the path of the files without suffix. Raises Failed if
    there is no solution."""
    path = pathlib.Path(folder) / name
    path.with_suffix(".inp").write_text(text, encoding="utf-8")
    done = subprocess.run(
        [PROGRAM, name],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "OMP_NUM_THREADS": "1"},
    )
    if "Job finished" not in done.stdout or "*ERROR" in done.stdout:
        complaints = [line.strip() for line in done.stdout.splitlines() if "ERROR" in line] or [
            "it stopped"
        ]
        raise Failed(f"{PROGRAM} {name}: {complaints[-1]}")
    return path


def printed(path, what):
    """Returns [{node: vector [3]}] with an entry for every printed increment. `what` is 'displacements' or 'forces'."""
    blocks, current = [], None
    for line in path.with_suffix(".dat").read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words and not words[0].isdigit():
            current = {} if words[0] == what else None
            blocks += [current] if current is not None else []
        elif words and current is not None:
            current[int(words[0]) - 1] = np.array([float(w) for w in words[1:4]])
    return blocks


def tangent(path):
    """Returns (stiffness [n, n], [(node, direction)] of its rows) of a step with SOLVER=MATRIXSTORAGE."""
    row, column, value = np.loadtxt(path.with_suffix(".sti"), unpack=True)
    i, j = row.astype(int) - 1, column.astype(int) - 1
    off = i != j
    places = [
        tuple(int(p) for p in line.split("."))
        for line in path.with_suffix(".dof").read_text(encoding="utf-8").split()
    ]
    n = len(places)
    upper = coo_matrix((value, (i, j)), (n, n))
    return (upper + coo_matrix((value[off], (j[off], i[off])), (n, n))).tocsc(), [
        (node - 1, direction - 1) for node, direction in places
    ]
