"""Buckling loads of the geometrically exact beam with eccentric shear centre and coupled shear, compared with closed
forms according to Haringx."""
import pathlib
import sys
import unittest

import numpy as np
from scipy.optimize import brentq

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
from reference.derive import column  # noqa: E402
from reference.derive.beam import Beam  # noqa: E402
from reference.derive.network import Network  # noqa: E402

LENGTH, RIGID = 6.0, 1e5


class Buckling(unittest.TestCase):

    def determinant(self, force, moment, shear, wagner):
        """Returns the scaled determinant of the tangent of the column on fork supports, which vanishes at the buckling
        load. The column is so stiff axially and in the strong plane that the state before buckling is straight.
        """
        s = column.channel_data()
        E, G = float(s.E), float(s.G)
        ys, zs = float(s.ys), float(s.zs)
        bz = float(s.wagner_y / s.Iz) if wagner else 0.0
        beam = Beam(LENGTH,
                    EA=E * float(s.A) * RIGID,
                    EIy=E * float(s.Iy),
                    EIz=E * float(s.Iz) * (RIGID if moment else 1),
                    GJ=G * float(s.It),
                    EIw=E * float(s.Iw),
                    t=float(s.Ip / s.A) + ys ** 2 + zs ** 2,
                    centre=(ys, zs),
                    wagner=(-2 * zs, bz - 2 * ys),
                    shear=np.array((s.F / G).tolist(), dtype=float) * shear)
        net = Network(LENGTH, 1e6, intervals=3, nodes=10)
        unit = np.array([force / 1e6, moment / 1e6 / LENGTH])

        def start(level, x, R, f, m, numbers):
            return np.array([x[0], x[1], x[2], R[2, 1], m[1], m[2] + unit[1]])

        def end(level, x, R, f, m, numbers):
            return np.array([f[0] + unit[0], x[1], x[2], R[2, 1], m[1], m[2] - unit[1]])

        first, last = net.body((0, 0, 0), start), net.body((LENGTH, 0, 0), end)
        net.member(beam, first, last, (0, 0, 0), np.eye(3), ("free", "free"))
        net.solve((1.0, ))
        sign, size = np.linalg.slogdet(net.system(1.0)[0].toarray())
        return sign * np.exp(size - self.__dict__.setdefault("scale", size))

    def test_axial_load(self):
        found = brentq(lambda P: self.determinant(P, 0.0, 1, False), 11.3e6, 11.5e6, xtol=1.0)
        self.assertAlmostEqual(
            found / float(column.buckling_load(column.channel_data(), 6, True, True)),
            1,
            delta=1e-7)

    def test_end_moments(self):
        for shear in (0, 1):
            for wagner in (False, True):
                closed = column.buckling_moments(column.channel_data(), 6, shear, True, wagner)[0]
                found = brentq(lambda M: self.determinant(0.0, M, shear, wagner),
                               1.01 * float(closed),
                               0.99 * float(closed),
                               xtol=1.0)  # noqa: B023
                self.assertAlmostEqual(found / float(closed), 1, delta=2e-5)


if __name__ == "__main__":
    unittest.main()
