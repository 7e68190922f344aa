"""Lee's frame: limit points of the force on its beam, and the force at which a frame with equal bending stiffnesses
buckles out of its plane.

The parameter of the path is the arc length in the space of position, rotation and force of the loaded point. A limit
point is the extremum of the interpolant of the force through Chebyshev points of the arc; a bifurcation is a zero of
the determinant of the bordered system.
"""
import copy

import numpy as np
from scipy.optimize import brentq

from reference.derive.beam import Beam
from reference.derive.network import Network

LENGTH, LOAD_AT, EA, EI, G = 120.0, 24.0, 4320.0, 1440.0, 720 / 2.6
RELATIVE, STEP = 1e-9, 0.05


class Frame:
    """A state of the frame. If `plane` is True, the frame is too stiff to buckle out of its plane."""

    def __init__(self, plane):
        across = (2e6 * 720, 2e6 * G) if plane else (EI, 2.6 * G)
        net = self.net = Network(LENGTH, EI / LENGTH ** 2, numbers=[0.0], intervals=3, nodes=12)

        def hinge(place):
            return lambda level, x, R, force, moment, numbers: np.array(
                [*(x - np.array(place) / LENGTH), R[2, 0], R[2, 1], moment[2]])

        def loaded(level, x, R, force, moment, numbers):
            return np.concatenate(
                [force + np.array([0 * numbers[0], numbers[0], 0 * numbers[0]]), moment])

        places = (0, 0, 0), (0, LENGTH, 0), (LOAD_AT, LENGTH, 0), (LENGTH, LENGTH, 0)
        bodies = net.body(places[0], hinge(places[0])), net.body(places[1]), net.body(
            places[2], loaded), net.body(places[3], hinge(places[3]))
        up, right = np.array([[0, -1.0, 0], [1, 0, 0], [0, 0, 1]]), np.eye(3)
        for i, (length, axes) in enumerate(
            ((LENGTH, up), (LOAD_AT, right), (LENGTH - LOAD_AT, right))):
            net.member(Beam(length, EA=EA, EIy=across[0], EIz=EI, GJ=across[1]), bodies[i],
                       bodies[i + 1], places[i], axes)
        self.node = 2
        self.way, self.origin = np.array([0, 0, 0, 1.0]), self.place()

    @staticmethod
    def coordinates(x, R, numbers):
        return np.array([x[0], x[1], R[1, 0], numbers[0] / 50])

    def place(self):
        b = self.net.bodies[self.node]
        return self.coordinates(b.x, b.R, self.net.numbers)

    def advanced(self, arc):
        one = copy.deepcopy(self)
        way, origin = self.way, self.origin
        one.net.extra = [(one.net.bodies[self.node], lambda level, x, R, force, moment, numbers:
                          [way @ (self.coordinates(x, R, numbers) - origin) - level])]
        one.net.solve((arc, ))
        return one

    def turned(self, before):
        self.way = self.place() - before.place()
        self.way, self.origin = self.way / np.linalg.norm(self.way), self.place()
        return self

    @property
    def force(self):
        return self.net.numbers[0] * self.net.force

    @property
    def deflection(self):
        return (1 - self.net.bodies[self.node].x[1]) * LENGTH

    def determinant(self, size):
        sign, logarithm = np.linalg.slogdet(self.net.system(0.0)[0].toarray())
        return sign * np.exp(logarithm - size)


def path(frame, least):
    """Returns at most 400 states along the path, which ends when the force has been negative and then exceeds `least`
    [N]."""
    points = [frame, frame.advanced(STEP)]
    points[1].turned(frame)
    while len(points) < 400 and not (points[-1].force > points[-2].force > least and
                                     min(p.force for p in points) < 0):
        points.append(points[-1].advanced(STEP).turned(points[-1]))
    return points


def extremum(before, width):
    nodes = (1 - np.cos(np.pi * (np.arange(11) + 0.5) / 11)) / 2 * width
    found = [before.advanced(s) for s in nodes]
    series = [
        np.polynomial.Polynomial.fit(nodes, [getattr(p, name) for p in found], 10)
        for name in ("force", "deflection")
    ]
    zeros = series[0].deriv().roots()
    at = next(z.real for z in zeros if abs(z.imag) < 1e-9 and 0 <= z.real <= width)
    return series[0](at), series[1](at)


def rows():
    points = path(Frame(True), 0.5)
    turns = [
        i for i in range(1,
                         len(points) - 1)
        if (points[i].force - points[i - 1].force) * (points[i + 1].force - points[i].force) < 0
    ]
    for i, name in zip(turns, ("", "_back")):
        force, deflection = extremum(points[i - 1], 2 * STEP)
        yield "lee_frame", "", "limit_load" + name, force, "N", RELATIVE
        yield "lee_frame", "", "deflection_at_limit" + name, deflection, "m", 10 * RELATIVE
        if name == "":
            yield "lee_frame", "plane=0", "limit_load", force, "N", RELATIVE
    start = Frame(False)
    before = start.advanced(STEP).turned(start)
    size = np.linalg.slogdet(before.net.system(0.0)[0].toarray())[1]
    while (before.determinant(size) > 0) == (before.advanced(STEP).determinant(size) > 0):
        before = before.advanced(STEP).turned(before)
    at = brentq(lambda s: before.advanced(s).determinant(size), 0, STEP, xtol=1e-13)
    yield "lee_frame", "plane=0", "bifurcation_load", before.advanced(at).force, "N", RELATIVE
