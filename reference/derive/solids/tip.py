"""What a rigid end does to a solid: the motion of its face, the resultant on it, their tangent.

A shell's edge: the face moves as a rigid body, but its thickness is free to change; the directions
of the face turn with it.
"""
import numpy as np
from scipy.sparse import identity, lil_matrix
from scipy.sparse.linalg import splu

from reference.derive.beam import cross_matrix, exponential, rotation


def turned(vector):
    """Rotation matrix of a rotation vector [rad]."""
    return rotation(exponential(np.asarray(vector, dtype=float)))


def spin(vector):
    """T [3, 3] with spin = T d(vector) in fixed axes."""
    phi, x = np.linalg.norm(vector), cross_matrix(np.asarray(vector, dtype=float))
    if phi < 1e-8:
        return np.eye(3) + x / 2
    return np.eye(3) + (1 - np.cos(phi)) / phi**2 * x + (phi - np.sin(phi)) / phi**3 * (x @ x)


class Tip:
    """A face of nodes [indices] about a point.

    `middle` holds its nodes that may not move along the thickness, its axis 1.
    """

    def __init__(self, grid, nodes, middle, point):
        self.nodes, self.middle, self.point = (
            list(nodes),
            set(middle),
            np.asarray(point, dtype=float),
        )
        self.arms = {n: grid.nodes[n] - self.point for n in self.nodes}

    def held(self, node):
        """Directions of the turned face in which a node is held."""
        return (0, 1, 2) if node in self.middle else (0, 2)

    def boundary(self, translation, R):
        """Cards: the face's directions, and the motion along them."""
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
        """(force [N], moment about the displaced point [N m]) on the face."""
        arms = self.displaced(displacements, translation, R)
        return sum(forces[n] for n in self.nodes), sum(
            np.cross(arms[n], forces[n]) for n in self.nodes
        )

    def displaced(self, displacements, translation, R):
        """Arms: rigid but along the thickness, where the printed displacements (7 digits) say."""
        out = {n: R @ self.arms[n] for n in self.nodes}
        for n in set(self.nodes) - self.middle:
            moved = displacements[n] - np.asarray(translation) + self.arms[n] - out[n]
            out[n] = out[n] + R[:, 1] * (R[:, 1] @ moved)
        return out

    def stiffness(self, tangent, displacements, forces, translation, R):
        """d(force, spatial moment)/d(translation, spin) [6, 6]; tangent: of deck.tangent.

        Along the thickness a node is free: its force there stays zero while the direction turns,
        so that it changes in fixed axes.
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
        """The resultant's change [6, 6]: of forces, and of the arms of those that act already."""
        out = np.zeros((6, 6))
        for n in self.nodes:
            rows = [index[n, d] for d in range(3)]
            force, moved = R @ load[rows], R @ motion[rows]
            moved[:, :3] -= np.eye(3)
            out[:3] += force
            out[3:] += np.cross(arms[n], force, axisb=0).T + np.cross(moved, forces[n], axisa=0).T
        return out

    def directions(self, index, R):
        """[n, n]: columns: directions of the turned face at its nodes, else the fixed ones."""
        out = lil_matrix(identity(len(index)))
        for n in self.nodes:
            rows = [index[n, d] for d in range(3)]
            for i, row in enumerate(rows):
                for j, column in enumerate(rows):
                    out[row, column] = R[i, j]
        return out.tocsr()
