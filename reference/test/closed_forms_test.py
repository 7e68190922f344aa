"""Compares the deriving programs with results in another form or from another source."""
import pathlib
import sys
import unittest

import numpy as np
from mpmath import besselj, exp, findroot, mp, mpf, pi, sqrt, zeta

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
from reference.derive import channel_cantilever, channel_rotating, column, linear_buckling, rotating, tip_body, torsion  # noqa: E402
from reference.derive.section import section  # noqa: E402


class Sections(unittest.TestCase):

    def test_channel_of_table_1(self):
        s = column.channel_data()
        for got, value in ((s.A, "0.054"), (s.Iy, "3.78e-3"), (s.Iz, "2.16e-3"), (s.It, "1.62e-5"),
                           (s.ys, mpf(16) / 35), (s.Iw, mpf(243) / 175 * mpf("1e-4"))):
            self.assertLess(abs(got / mpf(value) - 1), mpf(10) ** -30)
        d = mp.inverse(s.F)
        for i, j, value in ((0, 0, "0.0276923077"), (1, 1, "0.015989011"), (2, 2, "0.0036936533"),
                            (1, 2, "-0.0038147567")):
            self.assertLess(abs(d[i, j] / mpf(value) - 1), 3e-8)
        self.assertLess(abs(d[0, 1]) + abs(d[0, 2]), mpf(10) ** -30)

    def test_axes_do_not_depend_on_the_drawing(self):
        walls = [(0, 1, "0.02"), (1, 2, "0.01"), (2, 3, "0.03")]
        points = np.array([(0, -0.3), (0.5, -0.3), (0.5, 0.3), (0.2, 0.3)])
        c, n = np.cos(0.7), np.sin(0.7)
        a, b = section(points, walls), section(points @ np.array([[c, -n], [n, c]]) + 1.5, walls)
        for name in ("A", "Iy", "Iz", "It", "Iw"):
            self.assertLess(abs(getattr(a, name) / getattr(b, name) - 1), 1e-13)
        self.assertLess(abs(abs(a.ys) - abs(b.ys)) + abs(abs(a.zs) - abs(b.zs)), 1e-14)
        self.assertLess(
            np.max(
                np.abs(
                    np.abs(np.array(a.F.tolist(), dtype=float)) /
                    np.abs(np.array(b.F.tolist(), dtype=float)) - 1)), 1e-11)


class Torsion(unittest.TestCase):

    def test_rectangles(self):
        for w, t in ((1, 1), (2, 1), (mpf("0.05"), mpf("0.0005"))):
            rest = sum(mpf(2) / n ** 5 / (exp(n * pi * w / t) + 1) for n in range(1, 40, 2))
            value = w * t ** 3 / mpf(3) * (1 - 192 / pi ** 5 * t / w * (31 * zeta(5) / 32 - rest))
            self.assertLess(abs(torsion.rectangle_constant(w, t) / value - 1), mpf(10) ** -30)


class Buckling(unittest.TestCase):

    def test_tip_load_is_a_zero_of_a_bessel_function(self):
        value = linear_buckling.lateral_load("tip", 0, "4.0")
        self.assertLess(abs(value - 2 * findroot(lambda x: besselj(-mpf(1) / 4, x), 2)),
                        mpf(10) ** -25)

    def test_warping_vanishes(self):
        """For K -> inf, the difference from the load of the narrow strip must be proportional to 1/sqrt(K)."""
        limit = linear_buckling.lateral_load("tip", 0, "4.0")
        near = [linear_buckling.lateral_load("tip", K, g) for K, g in ((100, "5.0"), (400, "4.45"))]
        self.assertTrue(0.4 < (near[1] - limit) / (near[0] - limit) < 0.5)

    def test_frame(self):
        """The critical moment of the frame must be M = pi sqrt(EI GJ)/L."""
        row = next(iter(linear_buckling.frame_rows()))
        E, nu, b, t, length = mpf(71240) * 10 ** 6, mpf("0.31"), mpf("0.03"), mpf("0.0006"), mpf(
            "0.24")
        self.assertLess(
            abs(row[3] / (pi / length * sqrt(E * b * t ** 3 / 12 * E /
                                             (2 * (1 + nu)) * b * t ** 3 / 3)) - 1), 1e-20)

    def test_shear_column_without_shear(self):
        plain = column.channel_data()
        for haringx in (False, True):
            stiff = column.channel_data()
            stiff.F = stiff.F / mpf(10) ** 12
            self.assertLess(
                abs(
                    column.buckling_load(stiff, mpf(6), True, haringx) /
                    column.buckling_load(plain, mpf(6), False, False) - 1), 1e-11)


class Rotating(unittest.TestCase):

    def test_slender_limit_by_power_series(self):
        """The slender limit must be that of the power series of w'''' - Omega^2 (T w')' = omega^2 w with T = R (1 - X)
        + (1 - X^2)/2, w(0) = w'(0) = 0, w''(1) = w'''(1) = 0."""

        def determinant(omega, Omega, R):
            tall = []
            for start in ((0, 0, 1, 0), (0, 0, 0, 1)):
                c = [mpf(v) for v in start]
                for n in range(120):
                    tension = (n + 1) * ((R + mpf(1) / 2) * (n + 2) * c[n + 2] - R *
                                         (n + 1) * c[n + 1] - mpf(n) / 2 * c[n])
                    c.append((Omega ** 2 * tension + omega ** 2 * c[n]) / ((n + 1) * (n + 2) *
                                                                           (n + 3) * (n + 4)))
                tall.append((sum(n * (n - 1) * v for n, v in enumerate(c)),
                             sum(n * (n - 1) * (n - 2) * v for n, v in enumerate(c))))
            return tall[0][0] * tall[1][1] - tall[0][1] * tall[1][0]

        for Omega, R in ((2, 0), (12, 0), (6, 1), (1, -2)):
            for value in rotating.flap(Omega, 1e7, R=R):
                self.assertLess(
                    abs(findroot(lambda w: determinant(w, mpf(Omega), R), value) / value - 1),
                    1e-10)

    def test_symmetric_shaft(self):
        rest = rotating.bending(3)
        for Omega in (2, 5):
            frequencies, growth = rotating.whirl(Omega, 1, 3)
            self.assertEqual(growth, 0)
            for found, value in zip(frequencies,
                                    sorted(
                                        abs(w + sign * Omega) for w in rest for sign in (-1, 1))):
                self.assertLess(abs(found / value - 1), 1e-20)

    def test_channel_at_rest(self):
        force, lateral = channel_rotating.path((0.1, ), 0)[0]
        other, aside = channel_cantilever.path((0.1, ))[0]
        self.assertLess(abs(force / other - 1), 1e-8)
        self.assertLess(abs(lateral / aside - 1), 1e-8)

    def test_lag_follows_from_flap(self):
        for Omega in (2, 6, 12):
            self.assertLess(
                np.max(
                    np.abs(
                        rotating.lag(Omega, 1e6) ** 2 /
                        (rotating.flap(Omega, 1e6) ** 2 - Omega ** 2) - 1)), 1e-7)

    def test_body_at_the_end(self):
        for m, c, g in ((1.0, 0.2, 0.3), (0.1, -0.5, 0.3), (10.0, 0.0, 0.0)):
            rest = np.array([float(w) for w in tip_body.at_rest(m, c, g)])
            self.assertLess(np.max(np.abs(tip_body.flap(0, m, c, g) / rest - 1)), 1e-11)
            self.assertLess(np.max(np.abs(tip_body.lag(0, m, c, g) / rest - 1)), 1e-11)
        self.assertLess(
            np.max(np.abs(tip_body.flap(6, 0.0, 0.0, 0.0) / rotating.flap(6, 1000) - 1)), 1e-11)
        self.assertLess(np.max(np.abs(tip_body.lag(6, 0.0, 0.0, 0.0) / rotating.lag(6, 1000) - 1)),
                        1e-11)
        flap, lag = (f(6, 2.0, 0.0, 0.0, 1e6) for f in (tip_body.flap, tip_body.lag))
        self.assertLess(np.max(np.abs(lag ** 2 / (flap ** 2 - 36) - 1)), 1e-7)


if __name__ == "__main__":
    unittest.main()
