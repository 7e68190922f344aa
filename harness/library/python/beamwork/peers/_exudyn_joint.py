"""Torques of the joints of Exudyn."""
from __future__ import annotations

from collections.abc import Sequence

from .data import Matrix, cross, rotation, transposed


def torque_of(multipliers: Sequence[float], held: Sequence[int], turn: Matrix) -> list[float]:
    """Returns the torque of a GenericJoint. TorqueLocal contains the Lagrange multipliers of its constraints f.l = 0, where f
    is an axis of the ground and l one of the body (CObjectJointGeneric.cpp). held: rotations that the joint fixes. turn:
    rotation of the body."""
    if len(held) == 3:  # z.y, z.x, x.y
        return [multipliers[0], -multipliers[1], -multipliers[2]]
    body, ground, out = transposed(turn), rotation([0, 0, 0]), [0.0, 0.0, 0.0]
    for k in held:
        if len(held) == 2:
            f, l = ({0, 1, 2} - set(held)).pop(), k
        else:
            f, l = sorted({0, 1, 2} - {k})
        out = [a + multipliers[k] * b for a, b in zip(out, cross(body[l], ground[f]))]
    return out
