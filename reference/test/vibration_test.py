"""Compares frequencies from transfer matrices with those of the Ritz method, which finds every frequency, and with
closed forms."""
import pathlib
import sys
import unittest

import numpy as np
from mpmath import mpf, pi, sqrt
from numpy.polynomial import Polynomial, legendre
from scipy.linalg import eigh, null_space

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
from reference.derive import double_cross, off_centre_masses, rederive, scenes, tip_body  # noqa: E402
from reference.derive.vibrating_beam import bending, zeros  # noqa: E402


def fields(held, length, count=14):
    """Returns (values, first and second derivatives) [count, points] of polynomials divisible by x^held, their values at
    the end [count, 3], and quadrature weights."""
    points, weights = legendre.leggauss(3 * count)
    x, found = np.append((points + 1) / 2, 1.0), []
    for k in range(count):
        one = Polynomial([0.0] * held + [1.0]) * legendre.Legendre.basis(
            k, domain=[0, 1]).convert(kind=Polynomial)
        found.append([one.deriv(d)(x) / length ** d for d in range(3)])
    found = np.array(found)
    return found[:, :, :-1].transpose(1, 0, 2), found[:, :, -1], weights * length / 2


def square(field, weight):
    return (field * weight) @ field.T


class Scenes(unittest.TestCase):

    def test_scenes_have_what_is_derived(self):
        stored = {(row["case"], row["quantity"]): row for row in scenes.stored()}
        quick = ("off_centre_masses", 6), ("double_cross", 16), ("bent_leaf", 6)
        for name, count in quick:
            rows = [row for row, _ in rederive.derived_rows(name, True)]
            self.assertEqual(len(rows), count)
            for row in rows:
                self.assertEqual(scenes.line_of(row),
                                 scenes.line_of(stored.pop((row["case"], row["quantity"]))))
        by_others = {row["source"] for row in stored.values()}
        programs = {f"reference/derive/{name}.py" for name in rederive.programs([])
                    if rederive.folder_of(name) == scenes.FOLDER}
        self.assertLessEqual(by_others, programs)
        self.assertFalse(by_others & {f"reference/derive/{name}.py" for name, _ in quick})


class DoubleCross(unittest.TestCase):

    def ritz(self, conditions):
        """Returns the frequencies of an arm below 60 Hz. `conditions` contains the rows that multiply (w, t, u) at the
        hub."""
        E, rho, A, I = (float(v)
                        for v in (double_cross.E, double_cross.RHO, double_cross.A, double_cross.I))
        value, end, weight = fields(1, 5.0)
        n, none = len(end), np.zeros((len(end), len(end)))
        K = np.block([[E * I * square(value[2], weight), none],
                      [none, E * A * square(value[1], weight)]])
        M = rho * A * np.block([[square(value[0], weight), none], [none, square(value[0], weight)]])
        hub = np.zeros((3, 2 * n))
        hub[0, :n], hub[1, :n], hub[2, n:] = end[:, 0], end[:, 1], end[:, 0]
        free = null_space(
            np.array(conditions) @ hub / [[np.abs(row).max()]
                                          for row in np.array(conditions) @ hub])
        found = np.sqrt(eigh(free.T @ K @ free, free.T @ M @ free, eigvals_only=True)) / (2 * np.pi)
        return found[found < 60]

    def test_ritz(self):
        for family, conditions in ((double_cross.turning, [[1, 0, 0], [
                0, 0, 1
        ]]), (double_cross.moving, [[0, 1, 0], [1, 0, -1]]), (double_cross.at_rest, [[1, 0, 0],
                                                                                     [0, 1, 0],
                                                                                     [0, 0, 1]])):
            got = zeros(family, double_cross.HIGHEST, double_cross.STEP)
            for one, value in zip(got, self.ritz(conditions), strict=True):
                self.assertLess(abs(float(one) / value - 1), 1e-8)

    def test_closed_form(self):
        first = pi / 2 * sqrt(double_cross.E * double_cross.I /
                              (double_cross.RHO * double_cross.A)) / double_cross.LENGTH ** 2
        found = double_cross.frequencies()
        self.assertLess(abs(found[0] / first - 1) + abs(found[8] / first / 4 - 1), 1e-25)


class OffCentreMasses(unittest.TestCase):

    def ritz(self, arm):
        p = off_centre_masses
        E, G, rho, A, I, m = (float(v) for v in (p.E, p.G, p.RHO, p.A, p.I, p.HEAVY + p.LIGHT))
        bent, bent_end, weight = fields(2, 10.0)
        rod, rod_end, _ = fields(1, 10.0)
        n, none = len(bent_end), np.zeros((len(bent_end), len(bent_end)))
        K = [E * I * square(bent[2], weight), E * A * square(rod[1], weight)], [
            E * I * square(bent[2], weight), 2 * G * I * square(rod[1], weight)
        ]
        mass = rho * A * square(bent[0], weight) + rho * I * square(bent[1], weight)
        M = [mass, rho * A * square(rod[0], weight)], [mass, 2 * rho * I * square(rod[0], weight)]
        squares = []
        for plane in (0, 1):
            k, total = (np.block([[a, none], [none, b]]) for a, b in (K[plane], M[plane]))
            for at, point in ((arm, 10000.0), (-arm, 1000.0)):
                if plane == 0:
                    moved = [(bent_end[:, 0], 0 * rod_end[:, 0]),
                             (-at * bent_end[:, 1], rod_end[:, 0])]
                else:
                    moved = [(bent_end[:, 0], at * rod_end[:, 0])]
                for row in (np.concatenate(one) for one in moved):
                    total = total + point * np.outer(row, row)
            squares += list(1 / eigh(total, k, eigvals_only=True)[::-1][:n])
        return np.sqrt(sorted(squares))[:off_centre_masses.COUNT] / (2 * np.pi)

    def test_ritz(self):
        for arm in (2, 1, 0):
            for got, value in zip(off_centre_masses.frequencies(arm), self.ritz(arm), strict=True):
                self.assertLess(abs(float(got) / value - 1), 1e-9, arm)


class TransferMatrices(unittest.TestCase):

    def test_cantilever_with_a_mass(self):
        def end(f):
            t, o = bending(mpf(1), f, mpf(1), mpf(1)), f
            return t[2, 2] * (t[3, 3] - 2 * o ** 2 * t[0, 3]) - t[2, 3] * (t[3, 2] -
                                                                           2 * o ** 2 * t[0, 2])

        for got, value in zip(zeros(end, 60, mpf("0.5")), tip_body.at_rest(2, 0, 0), strict=True):
            self.assertLess(abs(got / value - 1), 1e-25)

    def test_pinned_timoshenko_beam(self):
        """For k = pi/L, the frequencies must satisfy (rho I o^2 - S - EI k^2)(rho A o^2 - S k^2) = S^2 k^2, in this
        test with rho A = rho I = EI = S = L = 1."""
        k2 = pi ** 2
        b = 1 + 2 * k2
        values = [sqrt((b - s * sqrt(b ** 2 - 4 * k2 ** 2)) / 2) for s in (1, -1)]

        def end(o):
            t = bending(mpf(1), o, mpf(1), mpf(1), mpf(1), mpf(1))
            return t[0, 1] * t[2, 3] - t[0, 3] * t[2, 1]

        found = zeros(end, values[1] + mpf("0.1"), mpf("0.05"))
        for value in values:
            self.assertLess(min(abs(one / value - 1) for one in found), 1e-25)


if __name__ == "__main__":
    unittest.main()
