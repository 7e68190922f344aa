"""Loads along a beam (beam.py): six more states, F and m0 (moment about the origin, fixed axes) less those at the start,
  F' = -f q,   m0' = -f ((r + R d) x q + c),
per initial length, q and c in fixed axes, or turning with the sections; d: where q acts, from the centroid; f: factor at the level.
"""
import numpy as np

from reference.derive.beam import Scaled, rotation


class LineLoad:
    """force [N/m], moment [N] at each length, in fixed axes, or in those of the section, with which they turn; at [m]: of the force, in the
    section's axes; factor(level)."""

    def __init__(self, force, moment, at, turns, factor):
        self.force, self.moment, self.at, self.turns, self.factor = (*(np.array(
            v, dtype=float) for v in (force, moment, at)), turns, factor)

    def scaled(self, length, force):
        return LineLoad(self.force * length / force, self.moment / force, self.at / length,
                        self.turns, self.factor)


class Loaded(Scaled):
    """A scaled beam with such loads; the level is the network's."""
    carries = True
    stays = False  # do its loads stay where they are at rest? So they do in linear analysis

    def __init__(self, beam, loads):
        self.__dict__.update(beam.__dict__)
        self.plain, self.loads, self.level = beam, loads, 0.0

    @property
    def states(self):
        return self.plain.states + 6

    def slope(self, y, p):
        n = self.plain.states
        place = y[:7].real if self.stays else y[:7]  # what is not varied has no derivative
        R, out = rotation(place[3:]), np.zeros((6, y.shape[1]), dtype=np.result_type(y, p))
        for load in self.loads:
            factor = load.factor(self.level)
            turned = R if load.turns else np.eye(3)[:, :, None]
            q, c = (np.einsum("ijk,j->ik", turned, factor * v) + 0 * y[:3]
                    for v in (load.force, load.moment))
            out[:3] -= q
            out[3:] -= np.cross(place[:3] + np.einsum("ijk,j->ik", R, load.at), q, axis=0) + c
        return np.concatenate([self.plain.slope(y[:n], p + y[n:]), self.length * out])

    def at_rest(self, start, q0, s):
        y = self.plain.at_rest(start, q0, s)
        return np.concatenate([y, np.zeros((6, y.shape[1]))])
