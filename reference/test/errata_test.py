"""Proofs of the errata (reference/ERRATA.md) that need no element: each corrected form is correct, and the printed form
is not."""
import math
import pathlib
import sys
import unittest
from fractions import Fraction

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
from reference.derive import second_order  # noqa: E402
from reference.derive.beam import exponential, rotation  # noqa: E402
from reference.derive.column import channel_data  # noqa: E402

X, WEIGHT = (lambda x, w: ((x + 1) / 2, w / 2))(*np.polynomial.legendre.leggauss(12))
STEP = 1e-6


def integral(values):
    return float(WEIGHT @ values)


def slope(f, x=X, h=1e-5):
    return (8 * (f(x + h) - f(x - h)) - f(x + 2 * h) + f(x - 2 * h)) / (12 * h)


def shapes(Phi):
    """Returns the functions of the corrected J Eq. 38b."""
    f = 1 / (1 + Phi)
    return {
        "13": lambda x: f * (x * x * (3 - 2 * x) + Phi * x), "23": lambda x: f * 6 * x * (1 - x),
        "12": lambda x: f * x * ((1 - x) ** 2 + Phi / 2 *
                                 (1 - x)), "14": lambda x: f * x * (x - x * x + Phi / 2 * (1 - x)),
        "22": lambda x: f * (-3 * x * x + 4 * x - 1 + Phi *
                             (x - 1)), "24": lambda x: f * x * (3 * x - 2 + Phi)
    }


class Modes(unittest.TestCase):
    """J Eqs. 7 and 13, and J Eq. 60."""
    l0 = 1.3

    def modes(self, r, Rp, Rq):
        l0, d = self.l0, r[3:] - r[:3]
        n = d / np.linalg.norm(d)
        (_, yp, zp), (_, yq, zq) = Rp.T, Rq.T
        return np.array([
            np.linalg.norm(d) - l0, l0 / 2 * (zp @ yq - yp @ zq), -l0 * n @ zp, l0 * n @ zq,
            l0 * n @ yp, -l0 * n @ yq
        ])

    def setUp(self):
        self.r = np.array([0.1, -0.2, 0.3, 1.2, 0.4, -0.1])
        self.Rp, self.Rq = rotation(exponential(np.array([0.3, 0.2, -0.4]))), rotation(
            exponential(np.array([-0.2, 0.5, 0.1])))

    def measured(self):
        """Returns the gradient by central differences, with columns r^p, phi^p, r^q, phi^q."""
        columns = []
        for k in range(12):
            values = []
            for sign in (1, -1):
                r, turn = self.r.copy(), {3: np.zeros(3), 9: np.zeros(3)}
                if k < 3 or 6 <= k < 9:
                    r[k if k < 3 else k - 3] += sign * STEP
                else:
                    turn[3 if k < 6 else 9][k % 3] = sign * STEP
                values.append(
                    self.modes(r,
                               rotation(exponential(turn[3])) @ self.Rp,
                               rotation(exponential(turn[9])) @ self.Rq))
            columns.append((values[0] - values[1]) / (2 * STEP))
        return np.array(columns).T

    def test_gradient(self):
        d = self.r[3:] - self.r[:3]
        l, l0 = np.linalg.norm(d), self.l0
        n = d / l
        P = np.eye(3) - np.outer(n, n)
        (_, yp, zp), (_, yq, zq) = self.Rp.T, self.Rq.T
        zero, c = np.zeros(3), np.cross
        right = np.array([
            np.concatenate(row)
            for row in ((-n, zero, n, zero), (zero, l0 / 2 * (c(zp, yq) - c(yp, zq)), zero,
                                              l0 / 2 * (c(yq, zp) - c(zq, yp))),
                        (l0 / l * P @ zp, -l0 * c(zp, n), -l0 / l * P @ zp,
                         zero), (-l0 / l * P @ zq, zero, l0 / l * P @ zq, l0 * c(zq, n)),
                        (-l0 / l * P @ yp, l0 * c(yp, n), l0 / l * P @ yp,
                         zero), (l0 / l * P @ yq, zero, -l0 / l * P @ yq, -l0 * c(yq, n)))
        ])
        measured = self.measured()
        self.assertLess(np.max(np.abs(right - measured)), 1e-9)
        printed4 = np.concatenate(
            [-l0 / l * (zq - (n @ zp) * n), zero, l0 / l * (zq - (n @ zp) * n), zero])
        printed6 = np.concatenate(
            [-l0 / l * (yq - (n @ yp) * n), zero, l0 / l * (yp - (n @ yp) * n), zero])
        self.assertGreater(np.max(np.abs(printed4 - measured[3])), 0.1)
        self.assertGreater(np.max(np.abs(printed6 - measured[5])), 0.1)

    def test_rotation_about_the_shear_centre(self):
        """A twist of the end about the axis at (ys, zs) moves the centroid. All terms have signs opposite to those
        printed in J Eq. 60."""
        angle, ys, zs = 1e-6, 0.4, -0.3
        moved = np.array([0, 0, 0, self.l0, zs * angle, -ys * angle])
        e = self.modes(moved, np.eye(3), rotation(exponential(np.array([angle, 0, 0]))))
        e2 = e[1]
        self.assertLess(np.max(np.abs(e[2:] * self.l0 / e2 - np.array([ys, -ys, zs, -zs]))), 1e-5)


class Interpolation(unittest.TestCase):
    """J Eqs. 38, 40a, App. A."""
    Phi = 0.7

    def test_torsion_functions(self):
        """phi(0) = 0. The warping shear, which is due to the change of the bimoment, is constant: g_w = q (e2 - (e7 +
        e8)/2)/l0^2."""
        N, q = shapes(self.Phi), self.Phi / (1 + self.Phi)
        for e2, e7, e8 in ((1, 0, 0), (0, 1, 0), (0, 0, 1)):
            phi = lambda x: N["13"](x) * e2 + N["12"](x) * e7 - N["14"](x) * e8  # noqa: E731
            a = lambda x: N["23"](x) * e2 - N["22"](x) * e7 + N["24"](x) * e8  # noqa: E731
            self.assertLess(np.max(np.abs(slope(phi) - a(X) - q * (e2 - (e7 + e8) / 2))), 1e-9)
        self.assertEqual(N["13"](0.0), 0)
        printed = lambda x: x * x * (3 - 2 * x) + self.Phi  # noqa: E731
        self.assertEqual(printed(0.0), self.Phi)

    def test_sign_of_the_row_of_v(self):
        """Without shear, v' = phi_z requires v = -(N12 e5 + N14 e6)."""
        N = shapes(0.0)
        for e5, e6 in ((1, 0), (0, 1)):
            phi_z = N["22"](X) * e5 + N["24"](X) * e6
            v = lambda x: N["12"](x) * e5 + N["14"](x) * e6  # noqa: E731
            self.assertLess(np.max(np.abs(-slope(v) - phi_z)), 1e-9)
            self.assertGreater(np.max(np.abs(slope(v) - phi_z)), 0.5)

    def test_coupling_of_shear_and_warping(self):
        """The correct S24 is d2/de2 de4 of int G D_zw g_z g_w dx = G D_zw q_w q_z/(2 l0^2). J prints 2/l0."""
        l0, G, D, qz, qw = 1.7, 2.0, -0.3, 0.4, 0.2
        energy = lambda e2, e4: G * D * l0 * (qz * e4 /
                                              (2 * l0)) * (qw * e2 / l0 ** 2)  # noqa: E731
        second = energy(1, 1) - energy(1, 0) - energy(0, 1) + energy(0, 0)
        self.assertAlmostEqual(second, G * D * qw * qz / (2 * l0 ** 2), delta=1e-15)
        self.assertGreater(abs(second / (2 * G * D * qw * qz / l0) - 1), 0.5)

    def test_uniform_torsion(self):
        """With e7 = e8 = e2 in J Eq. 40a and Iw = 0, s2 is G It/l0^3 e2, not 1/30 of this value, and s7 = s8 = 0."""
        s = np.array([[36, -3, -3], [-3, 4, -1], [-3, -1, 4]]) / 30 @ np.ones(3)
        self.assertLess(np.max(np.abs(s - [1, 0, 0])), 1e-15)


class Modified(unittest.TestCase):
    """J Eqs. 58 to 66."""

    def test_elongation_without_shear_and_eccentricity(self):
        rng = np.random.default_rng(7)
        e = rng.uniform(-1, 1, 9)  # e[1] .. e[8]
        N = shapes(0.0)
        v = lambda x: -(N["12"](x) * e[5] + N["14"](x) * e[6])  # noqa: E731
        w = lambda x: N["12"](x) * e[3] + N["14"](x) * e[4]  # noqa: E731
        phi = lambda x: N["13"](x) * e[2] + N["12"](x) * e[7] - N["14"](x) * e[8]  # noqa: E731
        bending = integral(slope(v) ** 2 + slope(w) ** 2) / 2
        self.assertAlmostEqual(bending,
                               (2 * e[3] ** 2 + e[3] * e[4] + 2 * e[4] ** 2 + 2 * e[5] ** 2 +
                                e[5] * e[6] + 2 * e[6] ** 2) / 30,
                               delta=1e-9)
        printed = (3 * e[2] *
                   (6 * e[2] - e[7] - e[8]) + 2 * e[7] ** 2 - e[7] * e[8] + 2 * e[8] ** 2) / 30
        self.assertAlmostEqual(integral(slope(phi) ** 2) / 2, printed, delta=1e-9)

    def elongation(self, e, Phi, ys):
        """Returns int (v_c'^2 + w_c'^2)/2 dx for l0 = 1, where e[3], e[4] refer to the shear centre, v_c = v_s and w_c =
        w_s - ys phi."""
        N = shapes(Phi)
        e3, e4 = e[3] - ys * e[2], e[4] + ys * e[2]
        w = lambda x: N["12"](x) * e3 + N["14"](x) * e4 - ys * (N["13"](x) * e[2] + N["12"](x) * e[
            7] - N["14"](x) * e[8]) + ys * e[2] * x  # noqa: E731
        # the chord connects the centroids, so w_s(1) = ys phi(1)
        return integral(slope(w) ** 2) / 2

    def test_shear_and_eccentricity_are_missing(self):
        """The coefficients 2, 1, 2 over 30 are those of beams that are rigid in shear."""
        e = {2: 0.0, 3: 0.8, 4: -0.5, 7: 0.0, 8: 0.0}
        printed = (2 * e[3] ** 2 + e[3] * e[4] + 2 * e[4] ** 2) / 30
        self.assertAlmostEqual(self.elongation(e, 0.0, 0.0), printed, delta=1e-9)
        for Phi in (1.0, 100.0):  # Phi is proportional to 1/l0^2, so these are values of fine meshes
            Vt = (e[3] - e[4]) / (2 * (1 + Phi))
            Vs = (e[3] + e[4]) / 2
            self.assertAlmostEqual(self.elongation(e, Phi, 0.0), (Vs ** 2 / 3 + Vt ** 2 / 5) / 2,
                                   delta=1e-9)
            self.assertGreater(abs(self.elongation(e, Phi, 0.0) / printed - 1), 0.2)

    @staticmethod
    def sum66(e3, e4):
        return (2 * e3 ** 2 + e3 * e4 + 2 * e4 ** 2) / 30

    def test_eccentric_shear_centre(self):
        """The exact integral has a closed form for any shear and twist. J Eq. 66 includes neither shear nor twist."""
        ys, e = 0.7, {2: 0.6, 3: 0.8, 4: -0.5, 7: 0.4, 8: -0.3}
        for Phi in (0.0, 2.0):
            tw = (e[2] - (e[7] + e[8]) / 2) / (1 + Phi)
            Ws, Wt = (e[3] + e[4]) / 2 - ys * (e[7] - e[8]) / 2, (e[3] - e[4] - 2 * ys * e[2]) / (
                2 * (1 + Phi)) + ys * tw
            self.assertAlmostEqual(self.elongation(e, Phi, ys), (Ws ** 2 / 3 + Wt ** 2 / 5) / 2,
                                   delta=1e-9)
            self.assertGreater(
                abs(
                    self.elongation(e, Phi, ys) - self.sum66(e[3], e[4]) +
                    ys ** 2 * e[2] ** 2 / 10), 0.01)

    def test_term_of_an_eccentric_shear_centre(self):
        """For uniform twist without shear, the elongation has no additional term if it is written in strains of the shear
        centre. Written in the strains e of J, it has a product of twist and bending, which equals the printed square if
        there is no bending."""
        ys, e2 = 0.7, 0.6
        for e3, e4, alone in ((0.8, -0.5, False), (ys * e2, -ys * e2, True)):
            exact = self.elongation({2: e2, 3: e3, 4: e4, 7: e2, 8: e2}, 0.0, ys)
            self.assertAlmostEqual(exact, self.sum66(e3 - ys * e2, e4 + ys * e2), delta=1e-9)
            self.assertAlmostEqual(
                exact,
                self.sum66(e3, e4) + ys ** 2 * e2 ** 2 / 10 - ys * (e3 - e4) * e2 / 10,
                delta=1e-9)
            printed = self.sum66(e3, e4) - ys ** 2 * e2 ** 2 / 10
            self.assertEqual(abs(exact - printed) < 1e-9, alone)
            self.assertEqual(abs(exact - printed) > 0.01, not alone)

    def test_twist_of_an_eccentric_beam(self):
        """Without shear, e2bar - e2 of the corrected modes (second_order.py) is e4s e5s - e3s e6s, but it is printed with
        e of J."""
        length, (ys, zs) = second_order.L, (Fraction(2, 7), Fraction(-5, 9))
        e = [Fraction(k, 11) for k in (0, 3, -4, 7, 2, 5, 3, 3)]  # uniform twist
        shift = [0, 0, -ys, ys, -zs, zs, 0, 0]
        s = [a + b * e[1] / length for a, b in zip(e, shift)]
        hg = ((s[4] - s[5]) / (2 * length), (s[3] - s[2]) / (2 * length))
        right = second_order.all_modes(e, hg, (Fraction(0), Fraction(0)), Fraction(0), 0,
                                       (ys, zs))[1]
        self.assertEqual(right, (s[3] * s[4] - s[2] * s[5]) / length)
        self.assertNotEqual(right, (e[3] * e[4] - e[2] * e[5]) / length)

    def test_table_1(self):
        """D is indefinite with the printed D_w = 3.65e6 mm^4, and positive definite with 3.65e9 mm^4 and with the value
        computed from the shear flow."""
        for Dw, good in ((3.65e6, False), (3.65e9, True)):
            self.assertEqual(1.58e4 * Dw - 3.7e6 ** 2 > 0, good)
        self.assertAlmostEqual(float((channel_data().F ** -1)[2, 2]) * 1e12, 3.6936533e9, delta=1e2)


class ThirdOrder(unittest.TestCase):
    """N Eqs. 11, 49, 50, App. B."""

    def test_torsion_moment(self):
        """Equilibrium of a slice gives M_x' = kz M_y - ky M_z, here u_y'' M_y."""
        p, q, zp, zq = 0.7, -0.4, 0.3, 0.9
        u = lambda x: zp * (x - 2 * x ** 2 + x ** 3) + zq * (-x ** 2 + x ** 3)  # noqa: E731
        du = lambda x: zp * (1 - 4 * x + 3 * x ** 2) + zq * (-2 * x + 3 * x ** 2)  # noqa: E731
        ddu = lambda x: zp * (-4 + 6 * x) + zq * (-2 + 6 * x)  # noqa: E731
        My = lambda x: p * (x - 1) + q * x  # noqa: E731
        for sign, holds in ((-1, True), (1, False)):
            Mx = lambda x: sign * u(x) * (p + q) + du(x) * My(x)  # noqa: E731, B023
            self.assertEqual(np.max(np.abs(slope(Mx) - ddu(X) * My(X))) < 1e-9, holds)

    def test_bimoment_of_appendix_b(self):
        """The polynomial part of the bimoment satisfies lambda^2 b - b'' = L f with the printed sign of u_y only after
        division by lambda^4."""
        f = lambda x: 12 * x ** 2 - 18 * x + 6  # noqa: E731
        for rate in (0.5, 4.0):
            b = lambda x: 24 + rate ** 2 * (6 - 18 * x + 12 * x ** 2)  # noqa: E731, B023
            residual = rate ** 2 * b(X) - 24 * rate ** 2
            self.assertLess(np.max(np.abs(residual / rate ** 4 - f(X))), 1e-12)
            self.assertGreater(np.max(np.abs(residual - f(X))), 0.5)

    def test_initial_strains_of_an_arc(self):
        """Along a plane arc with total rotation psi, N Eq. 37 gives an elongation, but N Eq. 52 contains no initial
        elongation."""
        for psi in (0.05, 0.2, math.pi / 4):
            u, zp, zq = 2 * math.sin(psi / 2) / psi - 1, -psi / 2, psi / 2  # divided by L
            elongation = u + (2 * zp ** 2 - zp * zq + 2 * zq ** 2) / 30
            self.assertAlmostEqual(elongation / (psi ** 4 / 1920), 1, delta=psi ** 2 / 100)
        self.assertAlmostEqual(elongation, 2.0e-4, delta=0.05e-4)

    def test_sign_of_the_shear_strain(self):
        """g_z = +(u_z' + phi_y) in N Eqs. 16, 20 and 25, whereas Eq. 11 has the opposite sign."""
        Phi, yp, yq = 0.8, 0.3, 0.5
        u = lambda x: yp * (-x + 2 * x ** 2 - x ** 3) + yq * (x ** 2 - x ** 3) + Phi * (yp + yq) * (
            x - 3 * x ** 2 + 2 * x ** 3) / (2 + 2 * Phi)  # noqa: E731
        phi = -slope(u) + Phi * (yp + yq) / (2 + 2 * Phi)  # Eq. 16
        self.assertLess(np.max(np.abs(slope(u) + phi - Phi * (yq - -yp) / (2 + 2 * Phi))),
                        1e-9)  # Eq. 25 with e3 = -L yp
        self.assertTrue(
            math.isclose(phi[0] + slope(u)[0], Phi * (yp + yq) / (2 + 2 * Phi), rel_tol=1e-9))


if __name__ == "__main__":
    unittest.main()
