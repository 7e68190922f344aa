"""The beam of incremental.c in the same folder, whose rotations are updated: an element with a history.
  beamwork element-test --element 'exec:python3 incremental.py'
"""
import numpy as np

from beamwork_element import cross_matrix, rotation_vector, serve, sinc
from timoshenko import prepare


def at_point(kind, R, h):
    """Returns the rotation [N, 3, 3] and the curvature [N, 3] at the point from h[N, 30]: the last rotations of both
    nodes, the rotation and the curvature at the point."""
    last = h[:, :18].reshape(-1, 2, 3, 3)
    p, q = (rotation_vector(R[:, k] @ last[:, k].swapaxes(1, 2)) for k in (0, 1))
    L, t, rate = h[:, 18:27].reshape(-1, 3, 3), (p + q) / 2, (q - p) / kind.length
    square = (t * t).sum(1)[:, None]
    angle, spin = np.sqrt(square), cross_matrix(t)
    turn = np.eye(3) + spin * sinc(angle)[..., None] + spin @ spin * (sinc(angle / 2)**2 / 2)[..., None]
    third = (1 - sinc(angle)) / np.where(square == 0, 1, square)
    T_rate = sinc(angle) * rate + third * (t * rate).sum(1)[:, None] * t - sinc(angle / 2)**2 / 2 * np.cross(t, rate)
    return turn @ L, h[:, 27:] + (T_rate[:, None] @ L)[:, 0]


def strain(kind, r, _u, R, _a, h):
    """Returns e[N, 6] for r[N, 2, 3] and R[N, 2, 3, 3], which may be complex, and the history h[N, 30]."""
    turn, k = at_point(kind, R, h)
    slope = ((r[:, 1] - r[:, 0])[:, None] @ turn)[:, 0]
    return np.hstack([slope - [kind.length, 0, 0], kind.length**2 * k])


def begin(_kind, _r, _u, R, _a):
    """Returns the history [N, 30] of undeformed elements."""
    rotations = [R[:, 0], R[:, 1], R[:, 0], 0 * R[:, 0, 0]]
    return np.hstack([v.reshape(len(R), -1) for v in rotations])


def commit(kind, _r, _u, R, _a, h):
    """Returns the history [N, 30] of accepted states."""
    turn, k = at_point(kind, R, h)
    return np.hstack([v.reshape(len(R), -1) for v in (R, turn, k)])


if __name__ == "__main__":
    serve(prepare, strain, begin=begin, commit=commit, name="incremental_py", family="example", strains=6, history=30,
          summary="two nodes, one integration point, interpolated rotation increments, in Python",
          source="Cardona, Geradin, Int. J. Numer. Meth. Eng. 26 (1988), one point of integration",
          offers=["shear", "geometric", "large rotations", "mass", "rotary inertia"],
          shear_theories=["haringx"], limits=["doubly symmetric", "not objective", "path dependent"])
