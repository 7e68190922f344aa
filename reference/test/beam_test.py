"""Compares the boundary-value solver of the deriving programs with an adaptive Runge-Kutta method, with closed forms, and
with its results on finer grids."""
import math
import pathlib
import sys
import unittest

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import ellipj, ellipk, ellipkinc

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
from reference.derive import cantilevers, defaults, sheets  # noqa: E402
from reference.derive.beam import Beam, chebyshev, exponential, product, quaternion, rotation  # noqa: E402
from reference.derive.network import Network, clamped, free  # noqa: E402


class Pieces(unittest.TestCase):

    def test_integration_is_exact_for_polynomials(self):
        x, W = chebyshev(9)
        for power in range(10):
            self.assertLess(np.max(np.abs(W @ x ** power - x ** (power + 1) / (power + 1))), 2e-15)

    def test_quaternion_of_every_kind_of_rotation(self):
        for v in ([0.3, -0.2, 0.1], [3.1, 0.1, 0.2], [0.1, 3.1, 0.0], [0.2, -0.1, 3.1], [0, 0, 0]):
            q = exponential(np.array(v, dtype=float))
            other = quaternion(rotation(q))
            self.assertLess(min(np.max(np.abs(q - other)), np.max(np.abs(q + other))), 8e-15)

    def test_product_composes_rotations(self):
        a, b = exponential(np.array([0.4, 1.1, -0.7])), exponential(np.array([-1.4, 0.1, 0.5]))
        self.assertLess(np.max(np.abs(rotation(product(a, b)) - rotation(a) @ rotation(b))), 4e-15)


class Sheet(unittest.TestCase):
    given = {"wagner": 1, "tip_phi_x": 0.15}

    def twisted(self, intervals, nodes):
        def conditions(level, x, R, force, moment, numbers):
            return np.array([
                x[1] - 0.15 * level, R[1, 0] - math.sin(0.15 * level),
                R[1, 2] + math.tan(0.1 * level) * R[1, 1], force[0], force[2], moment[1]
            ])

        beam = sheets.sheet(**{**defaults.values("sheet_wagner"), **self.given})
        net = Network(beam.length, beam.EIz / beam.length ** 2, intervals=intervals, nodes=nodes)
        root, tip = net.body((0, 0, 0), clamped((0.0, 0.0, 0.0))), net.body((beam.length, 0, 0),
                                                                            conditions)
        member = net.member(beam, root, tip, (0, 0, 0), np.eye(3))
        net.solve((0.25, 0.5, 0.75, 1.0))
        return net, tip, member

    def test_initial_value_problem_reaches_the_tip(self):
        _, tip, member = self.twisted(6, 14)
        y0 = member.y[0, 0]
        p = member.p[:, None]
        tall = solve_ivp(lambda s, y: member.beam.slope(y[:, None], p)[:, 0], (0, 1),
                         y0,
                         method="DOP853",
                         rtol=1e-12,
                         atol=1e-14).y[:, -1]
        self.assertLess(np.max(np.abs(tall[:3] - tip.x)), 1e-9)
        self.assertLess(np.max(np.abs(rotation(tall[3:7]) - tip.R)), 1e-9)
        self.assertLess(abs(tall[7]), 1e-8)

    def test_finer_grid_changes_nothing(self):
        coarse, tip, _ = self.twisted(5, 13)
        C = coarse.response(1.0, tip, {tip: free})
        fine, tip, _ = self.twisted(12, 16)
        D = fine.response(1.0, tip, {tip: free})
        self.assertLess(np.max(np.abs(C - D) / np.sqrt(np.outer(np.diag(D), np.diag(D)))), 1e-12)

    def test_compliance_is_the_derivative_of_the_equilibrium(self):
        net, tip, _ = self.twisted(6, 12)
        C = net.response(1.0, tip, {tip: free})
        x, R, load = tip.x.copy(), tip.R, tip.load.copy()
        for k in range(6):
            change = np.zeros(6)
            change[k] = 1e-4
            tip.conditions = lambda level, x, R, force, moment, numbers: np.concatenate(
                [force, moment]) - load - level * change
            net.solve((1.0, ))
            plus = np.concatenate([tip.x, _spin(tip.R, R)])
            net.solve((-1.0, ))
            minus = np.concatenate([tip.x, _spin(tip.R, R)])
            net.solve((0.0, ))
            unit = np.array([net.length] * 3 + [1] * 3) / (net.force * (1 if k < 3 else net.length))
            self.assertLess(
                np.max(
                    np.abs((plus - minus) / 2e-4 * unit - C[:, k]) / np.sqrt(np.diag(C) * C[k, k])),
                1e-6)
        self.assertLess(np.max(np.abs(tip.x - x)), 1e-11)

    def test_linear_compliance_of_the_straight_sheet(self):
        """C_zz of a clamped sheet in its plane must be L^3/3EI + L/kGA."""
        beam = sheets.sheet(**defaults.values("sheet_cantilever"))
        net = Network(beam.length, beam.EIz / beam.length ** 2, intervals=4, nodes=10)
        root, tip = net.body((0, 0, 0), clamped((0.0, 0.0, 0.0))), net.body((beam.length, 0, 0))
        net.member(beam, root, tip, (0, 0, 0), np.eye(3))
        C = net.response(1.0, tip, {})
        self.assertAlmostEqual(
            C[2, 2] / (beam.length ** 3 / (3 * beam.EIy) + beam.length * beam.f[1, 1]),
            1,
            delta=1e-12)
        self.assertAlmostEqual(C[0, 0] / (beam.length / beam.EA), 1, delta=1e-12)
        rate = beam.length * math.sqrt(beam.GJ / beam.EIw)
        self.assertAlmostEqual(
            C[3, 3] / (beam.length / beam.GJ * (1 - math.tanh(rate / 2) / (rate / 2))),
            1,
            delta=1e-11)


class Elastica(unittest.TestCase):

    def test_elliptic_integrals(self):
        """A nearly inextensible cantilever must satisfy P L^2/EI = (K(m) - F(phi, m))^2 with m = (1 + sin theta)/2 and
        sin^2 phi = 1/2m."""
        r, R = cantilevers.dead_load(Beam(1.0, EA=1e13, EIy=1.0, EIz=1.0, GJ=1.0), (0, 5.0, 0), 10)
        theta = cantilevers.planar_angle(R)
        m = (1 + math.sin(theta)) / 2
        start = ellipkinc(math.asin(1 / math.sqrt(2 * m)), m)
        self.assertAlmostEqual((ellipk(m) - start) ** 2, 5.0, delta=1e-9)
        cn = ellipj(start, m)[1]
        self.assertAlmostEqual(r[0], 2 * math.sqrt(m) * cn / math.sqrt(5.0), delta=1e-10)


def _spin(R, R0):
    W = R @ R0.T
    return np.array([W[2, 1] - W[1, 2], W[0, 2] - W[2, 0], W[1, 0] - W[0, 1]]) / 2


if __name__ == "__main__":
    unittest.main()
