"""Loads along a beam (beam.py): six more states, F and m0 (moment about the origin, fixed axes) less those at the start,
  F' = -f q,   m0' = -f ((r + R d) x q + c),
per initial length, q and c in fixed axes, or turning with the sections, linear along the beam (then s is a state before the six);
d: where q acts, from the centroid; f: factor at the level.
"""
import numpy as np

from reference.derive.beam import Scaled, rotation


class LineLoad:
    """force [N/m], moment [N] at each length, in fixed axes, or in those of the section, with which they turn; at [m]: of the force, in the
    section's axes; factor(level); more: what force and moment are more at the end than at the start, linear between, or None."""

    def __init__(self, force, moment, at, turns, factor, more=None):
        self.force, self.moment, self.at, self.turns, self.factor = (*(np.array(
            v, dtype=float) for v in (force, moment, at)), turns, factor)
        self.more = None if more is None else [np.array(v, dtype=float) for v in more]

    def scaled(self, length, force):
        more = None if self.more is None else (self.more[0] * length / force, self.more[1] / force)
        return LineLoad(self.force * length / force, self.moment / force, self.at / length,
                        self.turns, self.factor, more)

    def at_place(self, s):
        """Force and moment [3, many]."""
        more = (0.0, 0.0) if self.more is None else (v[:, None] * s for v in self.more)
        return [v[:, None] + m for v, m in zip((self.force, self.moment), more)]


class Loaded(Scaled):
    """A scaled beam with such loads; the level is the network's."""
    carries = True
    stays = False  # do its loads stay where they are at rest? So they do in linear analysis

    def __init__(self, beam, loads):
        self.__dict__.update(beam.__dict__)
        self.plain, self.loads, self.level = beam, loads, 0.0
        self.varies = any(load.more is not None for load in loads)

    @property
    def states(self):
        return self.plain.states + self.varies + 6

    def slope(self, y, p):
        n = self.plain.states
        place = y[:7].real if self.stays else y[:7]  # what is not varied has no derivative
        R, out = rotation(place[3:]), np.zeros((6, y.shape[1]), dtype=np.result_type(y, p))
        s = y[n].real if self.varies else 0 * y[0].real
        for load in self.loads:
            factor = load.factor(self.level)
            q, c = (np.einsum("ijk,jk->ik", R, factor * (v + 0 * s)) if load.turns else
                    factor * v + 0 * y[:3] for v in load.at_place(s))
            out[:3] -= q
            out[3:] -= np.cross(place[:3] + np.einsum("ijk,j->ik", R, load.at), q, axis=0) + c
        rates = [self.plain.slope(y[:n], p + y[-6:]), self.length * out]
        return np.concatenate(rates[:1] + [1 + 0 * y[:1]] * self.varies + rates[1:])

    def at_rest(self, start, q0, s):
        y = self.plain.at_rest(start, q0, s)
        return np.concatenate([y] + [np.array(s)[None]] * self.varies + [np.zeros((6, y.shape[1]))])
