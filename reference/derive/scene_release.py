"""What an end of a member does not pass on to its node: a joint (network.py) between them.

The end is at r + R rho + R_end s, R_end = R exp(a_1 t_1) exp(a_2 t_2) with the node's body r, R; three turns have no order, R_end is free.
s: shifts along the turned end.  No load works on what is released: with the moment about the joint, mu + (R_end s) x f, it vanishes
along the axes of the turns, and f along the shifts.
"""
import numpy as np

from reference.derive.scene_support import WORDS, skew, turn


class Release:
    """words: components in their order; axes: columns are those of the end; at: of the node from its body's point (dimensionless);
    new_number(): of the problem, one for each but three turns."""

    def __init__(self, words, axes, at, new_number):
        components = [WORDS.index(word) for word in words]
        self.at, turns = np.array(at), [i for i in components if i > 2]
        self.ball = len(turns) == 3
        self.turns = [] if self.ball else [(axes[:, i - 3], new_number()) for i in turns]
        self.slides = [(axes[:, i], new_number()) for i in components if i < 3]

    def _axes(self, R, numbers):
        """Of the turns now, and the rotation behind them; R of the node."""
        out = []
        for axis, k in self.turns:
            out.append(R @ axis)
            R = R @ turn(axis, numbers[k])
        return out, R

    def _apart(self, R, numbers):
        return R @ sum((numbers[k] * along for along, k in self.slides), np.zeros(3))

    def conditions(self, level, x, R, force, moment, numbers, on):
        apart = self._apart(R, numbers)
        turned = moment + np.cross(apart, force) if self.ball else skew(
            R @ self._axes(on[1], numbers)[1].T)
        return np.concatenate([x - on[0] - on[1] @ self.at - apart, turned])

    def extra(self):
        """Of the numbers, in their order."""

        def turns(which):
            return lambda level, x, R, force, moment, numbers, on: [
                self._axes(on[1], numbers)[0][which] @ (moment + np.cross(
                    self._apart(R, numbers), force))
            ]

        def slides(along):
            return lambda level, x, R, force, moment, numbers, on: [(R @ along) @ force]

        return [turns(i)
                for i in range(len(self.turns))] + [slides(along) for along, _ in self.slides]
