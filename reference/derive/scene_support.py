"""Supports, drivers and loads of a body of a scene, as conditions of network.py.

There are six conditions on the position x, the rotation R and the load of the members (f, and mu about the point of
the body). If a component is free, f or mu is the applied load. Rotations have one of three forms: increments about
fixed axes, each free or fixed; a rotation vector; or a sequence R = exp(a_1 t_1) exp(a_2 t_2) .... The free angles of
a sequence are numbers of the problem with mu . (axis of the rotation) = 0. A fork is the sequence (normal of the
guides, web) with both angles free.
"""
import numpy as np

from reference.derive.beam import cross_matrix, exponential, rotation

FREE, HELD = "free", "held"
WORDS = ("ux", "uy", "uz", "rx", "ry", "rz")


def turn(axis, angle):
    """Returns exp(axis angle). The angle may be complex."""
    A = cross_matrix(np.array(axis, dtype=float))
    return np.eye(3) + np.sin(angle) * A + (1 - np.cos(angle)) * (A @ A)


def skew(D):
    return np.array([D[2, 1] - D[1, 2], D[0, 2] - D[2, 0], D[1, 0] - D[0, 1]]) / 2


def rotation_vector(R):
    s = skew(R)
    sine, cosine = np.linalg.norm(s), (np.trace(R) - 1) / 2
    return s * (np.arctan2(sine, cosine) / sine if sine > 0 else 1.0)


class Applied:
    """A force or a moment on a body, in fixed axes or rotating with the body. `arm` is the position of a force relative
    to the point of the body. factor(level) is the factor of the load. If `stays` is True, the load does not follow the
    body, as in linear analysis."""
    stays = False

    def __init__(self, force, moment, arm, turns, factor):
        self.force, self.moment, self.arm, self.turns, self.factor = (*(np.array(
            v, dtype=float) for v in (force, moment, arm)), turns, factor)

    def at(self, level, R):
        R = R.real if self.stays else R  # without the complex step, the load does not follow the motion
        turned = R if self.turns else np.eye(3)
        f = self.factor(level) * (turned @ self.force)
        return np.concatenate(
            [f, np.cross(R @ self.arm, f) + self.factor(level) * (turned @ self.moment)])


class Support:
    """The support of a body. `kinds` contains FREE, HELD or a motion(level, numbers) for each of the six components
    (dimensionless). `sequence` is [(axis, FREE, HELD or a motion)], and `vector` contains three motions. A sequence or
    a vector replaces the last three kinds, which are then HELD."""

    def __init__(self, place):
        self.place, self.kinds, self.sequence, self.vector = np.array(
            place, dtype=float), [FREE] * 6, None, None
        self.loads, self.angles = [], []  # angles contains the numbers of the free rotations of the sequence

    def applied(self, level, R):
        return sum((load.at(level, R) for load in self.loads), np.zeros(6))

    def value(self, kind, level, numbers):
        return 0.0 if kind == HELD else kind(level, numbers)

    def _shifts(self, level, x, force, numbers, kinds):
        return [
            force[i] if kinds[i] == FREE else x[i] - self.place[i] -
            self.value(kinds[i], level, numbers) for i in range(3)
        ]

    def _sequence(self, level, numbers):
        R, free, angles = np.eye(3), [], iter(self.angles)
        for axis, kind in self.sequence:
            if kind == FREE:
                k = next(angles)
                free.append((R @ axis, k))
                R = R @ turn(axis, numbers[k])
            else:
                R = R @ turn(axis, self.value(kind, level, numbers))
        return free, R

    def prescribed(self, level, numbers):
        """Returns the rotation matrix if the rotation is fully prescribed (possibly by numbers of the problem), otherwise
        None."""
        if self.sequence is not None:
            return self._sequence(level, numbers)[1]
        if self.vector is not None:
            return rotation(
                exponential(np.array([self.value(kind, level, numbers) for kind in self.vector])))
        kinds = self.kinds[3:]
        driven = [i for i in range(3) if callable(kinds[i])]
        if FREE in kinds:
            return None
        return turn(np.eye(3)[driven[0]], self.value(kinds[driven[0]], level,
                                                     numbers)) if driven else np.eye(3)

    def _turns(self, level, R, moment, numbers, kinds):
        if FREE not in kinds:
            return skew(R @ self.prescribed(level, numbers).T)
        now = skew(R @ R.real.T)  # increment from the current rotation: zero, with the derivative as imaginary part
        out = []
        for i, kind in enumerate(kinds):
            j, k = (i + 1) % 3, (i + 2) % 3
            angle = self.value(kind, level, numbers) if callable(kind) else 0.0
            out.append(moment[i] if kind == FREE else now[i] if kind == HELD else R[k, j] *
                       np.cos(angle) - R[j, j] * np.sin(angle))
        return out

    def axes_now(self, level, numbers):
        """Returns the axes of the free angles of a sequence, in rows."""
        return np.array([axis for axis, _ in self._sequence(level, numbers)[0]])

    def conditions(self, kept=None, axes=None):
        """Returns the conditions. `kept` is {component: current load} of released components. `axes` are the axes of
        the free rotations, which remain fixed so that no moment rotates with them."""
        kept = kept or {}
        across = None if axes is None else np.linalg.svd(axes)[2][len(axes):]
        kinds = [FREE if i in kept else kind for i, kind in enumerate(self.kinds)]

        def of(level, x, R, force, moment, numbers):
            given = self.applied(level, R)
            for i, value in kept.items():
                given = given + value * np.eye(6)[i]
            if axes is not None:
                turns = np.concatenate([axes @ (moment - given[3:]), across @ skew(R @ R.real.T)])
                return np.concatenate(
                    [self._shifts(level, x, force - given[:3], numbers, kinds), turns])
            return np.concatenate([
                self._shifts(level, x, force - given[:3], numbers, kinds),
                self._turns(level, R, moment - given[3:], numbers, kinds[3:])
            ])

        return of

    def kept_angles(self):
        """Returns conditions that keep the free angles constant, for use with other conditions of the body."""
        return [
            lambda level, x, R, force, moment, numbers, k=k: [numbers[k] - numbers[k].real]
            for k in self.angles
        ]

    def extra(self):
        def of(which):

            def condition(level, x, R, force, moment, numbers):
                axis, _ = self._sequence(level, numbers)[0][which]
                return [axis @ (moment - self.applied(level, R)[3:])]

            return condition

        return [of(i) for i in range(len(self.angles))]

    def path_dependent(self, R):
        """Returns the name of a rotation component whose increments are fixed or prescribed although the node rotates
        about several axes. Returns None if there is no such component."""
        kinds = self.kinds[3:]
        if FREE not in kinds or kinds == [FREE] * 3:
            return None
        v = rotation_vector(R)
        driven = [i for i in range(3) if callable(kinds[i])]
        for i in range(3):
            if (kinds[i] == HELD or (driven and i not in driven)) and abs(v[i]) > 1e-9:
                return WORDS[3 + (driven[0] if driven else i)]
        return None


# End release of a member: a joint (network.py) between the end and its node.
#
# The end is at r + R rho + R_end s, where R_end = R exp(a_1 t_1) exp(a_2 t_2), and r and R belong to the body of the
# node. If three rotations are released, they have no order, and R_end is free. s contains the translations along the
# rotated end. No load does work on the released motions: the moment about the joint, mu + (R_end s) x f, vanishes along
# the axes of the rotations, and f along the translations.


class Release:
    """The release at one end of a member. `words` are the released components in their order. The columns of `axes` are
    the axes of the end. `at` is the position of the node relative to the point of its body (dimensionless). new_number()
    adds a number to the problem: one for each component, but none for three released rotations."""

    def __init__(self, words, axes, at, new_number):
        components = [WORDS.index(word) for word in words]
        self.at, turns = np.array(at), [i for i in components if i > 2]
        self.ball = len(turns) == 3
        self.turns = [] if self.ball else [(axes[:, i - 3], new_number()) for i in turns]
        self.slides = [(axes[:, i], new_number()) for i in components if i < 3]

    def _axes(self, R, numbers):
        """Returns the current axes of the rotations, and the rotation of the end. R is the rotation of the node."""
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
        def turns(which):
            return lambda level, x, R, force, moment, numbers, on: [
                self._axes(on[1], numbers)[0][which] @ (moment + np.cross(
                    self._apart(R, numbers), force))
            ]

        def slides(along):
            return lambda level, x, R, force, moment, numbers, on: [(R @ along) @ force]

        return [turns(i)
                for i in range(len(self.turns))] + [slides(along) for along, _ in self.slides]
