"""The strain measures to which printed elements converge, compared with those of short elements."""
import functools
import math
import pathlib
import sys
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
from reference.derive import predicted_beam  # noqa: E402
from reference.derive.beam import exponential, rotation  # noqa: E402
from reference.derive.predicted_beam import Jet  # noqa: E402


X, WEIGHT = (lambda x, w: ((x + 1) / 2, w / 2))(*np.polynomial.legendre.leggauss(12))
# A smooth beam with constant gamma and kappa, the amplitude a and its rate, and the section of the beam.
GAMMA, KAPPA, A, RATE = np.array([0.05, 0.23, -0.31]), np.array([0.4, -0.7, 0.9]), 0.55, 0.35
(YS, ZS), POLAR = CENTRE, _ = (0.21, -0.13), 0.37
E, G, AREA, IY, IZ, IT, IW = 3.0, 1.1, 1.7, 0.9, 1.3, 0.6, 0.8
D = np.array([[0.8, 0.05, -0.03], [0.05, 0.7, 0.06], [-0.03, 0.06, 0.5]])


def turned(axis, angle):
    v = np.zeros(3)
    v[axis] = angle
    return rotation(exponential(v))


def ends(h):
    turns = [rotation(exponential(KAPPA * h * (x - 0.5))) for x in X]
    r = h * sum(w * R @ (np.array([1.0, 0, 0]) + GAMMA) for w, R in zip(WEIGHT, turns))
    return r, rotation(exponential(-KAPPA * h / 2)), rotation(exponential(KAPPA * h / 2))


def variables(gamma=GAMMA, kappa=KAPPA, a=A):
    v = Jet.variables(np.array([*gamma, *kappa, a])[:, None])
    return v[:3], v[3:6], v[6]


def values(measures, **given):
    return np.array([m.value[0] for m in measures(*variables(**given), CENTRE, POLAR)])


def extrapolated(measured, h):
    """Returns the limit h -> 0 of a measurement whose error contains all powers of h."""
    table = [measured(h / 2 ** k) for k in range(5)]
    for k in range(1, 5):
        table = [(2 ** k * fine - coarse) / (2 ** k - 1) for coarse, fine in zip(table, table[1:])]
    return table[0]


def jonker_modes(h):
    r, Rp, Rq = ends(h)
    (_, yp, zp), (_, yq, zq), l = Rp.T, Rq.T, np.linalg.norm(r)
    n = r / l
    twist = h / 2 * (zp @ yq - yp @ zq)
    amplitudes = [h * h * (A - RATE * h / 2), h * h * (A + RATE * h / 2)]
    return np.array([l - h, twist, -h * n @ zp, h * n @ zq, h * n @ yp, -h * n @ yq, *amplitudes])


def eq66(e, h):
    _, e2, e3, e4, e5, e6, e7, e8 = e
    tw = e2 - (e7 + e8) / 2
    bending = (2 * e3 ** 2 + e3 * e4 + 2 * e4 ** 2 + 2 * e5 ** 2 + e5 * e6 + 2 * e6 ** 2) / 30
    twist = POLAR / 2 * (e2 ** 2 + (e7 - e8) ** 2 / 12 + tw ** 2 / 5)
    twist -= (YS ** 2 + ZS ** 2) * e2 ** 2 / 10
    return e + np.array([
        bending + twist / h ** 2, e4 * e5 - e3 * e6,
        e2 * e5 / 10 + e2 * e6 / 5 + e5 * e7 / 10 - e5 * e8 / 30 - e6 * e8 / 30,
        -e2 * e5 / 5 - e2 * e6 / 10 + e5 * e7 / 30 + e6 * e7 / 30 - e6 * e8 / 10,
        -e2 * e3 / 10 - e2 * e4 / 5 - e3 * e7 / 10 + e3 * e8 / 30 + e4 * e8 / 30,
        e2 * e3 / 5 + e2 * e4 / 10 - e3 * e7 / 30 - e4 * e7 / 30 + e4 * e8 / 10, 0, 0]) / h


def bending_fields(h, p, q, stiffness, sheared):
    """Returns u', the rotation and its rate from the angles at the ends (N Eqs. 14-17, GA = 1)."""
    Phi = 12 * stiffness / h ** 2 if sheared else 0.0
    lag = Phi / (2 + 2 * Phi) * (p + q)
    slope = p * (1 - 4 * X + 3 * X ** 2) + q * (3 * X ** 2 - 2 * X) - lag * (1 - 6 * X + 6 * X ** 2)
    rate = (p * (6 * X - 4) + q * (6 * X - 2) - lag * (12 * X - 6)) / h
    return slope, slope + lag, rate


def local_coordinates(h):
    r, Rp, Rq = ends(h)
    d, l = Rp.T @ r, np.linalg.norm(r)
    yp, zp = math.asin(d[2] / l), -math.atan(d[1] / d[0])
    R = turned(1, yp) @ turned(2, zp) @ Rp.T @ Rq
    px, yq, zq = -math.atan(R[1, 2] / R[1, 1]), -math.atan(R[2, 0] / R[0, 0]), math.asin(R[1, 0])
    return l - h, px, yp, yq, zp, zq


def nijenhuis_modes(h, sheared):
    """Returns e1 .. e8 of N, from Eq. 7 over the linear solution, with Wp = Wq = px/h. For Phi = 0, this is Eq. 37."""
    u, px, yp, yq, zp, zq = local_coordinates(h)
    duy, phz, dphz = bending_fields(h, zp, zq, IZ, sheared)
    minus_duz, phy, dphy = bending_fields(h, yp, yq, IY, sheared)
    phx, s = px * X, h * X
    gx = -phy * (phy / 2 - minus_duz) - phz * (phz / 2 - duy) + POLAR * (px / h) ** 2 / 2
    gy, gz, ky, kz = (phy - minus_duz) * phx, (phz - duy) * phx, dphz * phx, -dphy * phx
    total = lambda f: h * float(WEIGHT @ f)  # noqa: E731
    twist = h * (px + total(dphy * phz))
    in_z = [-h * yp + total((h - s) * ky - gz), h * yq + total(s * ky + gz)]
    in_y = [-h * zp + total((h - s) * kz + gy), h * zq + total(s * kz - gy)]
    return np.array([u + total(gx), twist, *in_z, *in_y, twist, twist])


def measured(e, h, centre):
    """Returns the strain measures of a short element, in the order of predicted_beam.py."""
    k, gy, gz = e[1] / h ** 2, (e[4] - e[5]) / (2 * h), (e[3] - e[2]) / (2 * h)
    warping = k - (e[6] + e[7]) / (2 * h ** 2)
    bending = [(e[2] + e[3]) / h ** 2, (e[4] + e[5]) / h ** 2]
    return np.array([e[0] / h, gy - centre[1] * k, gz + centre[0] * k, warping, k, *bending])


def torsion_of_appendix_a(h, i, q):
    """Returns the rows and columns e2, e7, e8 of S, where i = 1/(1 + Phi_w) and q = Phi_w/(1 + Phi_w)."""
    f = 5 * q * (i + q / 2)
    same = np.array([[36 * i * i + 30 * q * (2 * i + q), -3 * i * i, -3 * i * i],
                     [-3 * i * i, 4 * i * i + f, -i * i - f],
                     [-3 * i * i, -i * i - f, 4 * i * i + f]])
    warping = np.array([[12 * i, -6 * i, -6 * i], [-6 * i, 4 * i + q, 2 * i - q],
                        [-6 * i, 2 * i - q, 4 * i + q]])
    return G * IT / (30 * h ** 3) * same + E * IW / h ** 5 * warping


def appendix_a(h):
    """Returns S of J App."""
    Phi = 12 * E * np.array([IZ, IY, IW]) / (G * np.diag(D) * h ** 2)
    (qy, qz, qw), S, pair = Phi / (1 + Phi), np.zeros((8, 8)), np.array([1, -1])
    S[0, 0] = E * AREA / h
    for at, I, P in ((2, IY, Phi[1]), (4, IZ, Phi[0])):
        block = np.array([[4 + P, P - 2], [P - 2, 4 + P]])
        S[at:at + 2, at:at + 2] = E * I / h ** 3 / (1 + P) * block
    S[np.ix_([1, 6, 7], [1, 6, 7])] = torsion_of_appendix_a(h, 1 - qw, qw)
    S[2:4, 4:6] = -G * D[0, 1] * qy * qz / (4 * h) * np.outer(pair, pair)
    for row, share in ((1, 1), (6, -0.5), (7, -0.5)):
        S[row, 2:4] = -share * G * D[1, 2] * qz * qw / (2 * h ** 2) * pair
        S[row, 4:6] = share * G * D[0, 2] * qy * qw / (2 * h ** 2) * pair
    upper = np.abs(S) > np.abs(S.T)
    return np.where(upper, S, S.T)


class Measures(unittest.TestCase):
    def assert_limit(self, modes, measures, centre, h, delta):
        limit = extrapolated(lambda length: measured(modes(length), length, centre), h)
        self.assertLess(np.max(np.abs(limit - measures)), delta)

    def test_first_order(self):
        self.assert_limit(jonker_modes, values(predicted_beam.jonker_first), CENTRE, 0.2, 1e-6)

    def test_eq66(self):
        printed, first = values(predicted_beam.jonker), values(predicted_beam.jonker_first)
        self.assert_limit(lambda h: eq66(jonker_modes(h), h), printed, CENTRE, 0.2, 1e-6)
        self.assertGreater(np.min(np.abs(printed - first)), 1e-3)

    def test_sheets(self):
        for sheared, name in ((False, "sheet_second"), (True, "sheet_second_consistent")):
            p = KAPPA[0] + KAPPA[1] * GAMMA[1] / (1 + GAMMA[0])
            limit = values(predicted_beam.OF[name], a=p)
            modes = functools.partial(nijenhuis_modes, sheared=sheared)
            self.assert_limit(modes, limit, (0, 0), 0.1, 1e-5)

    def test_energy_of_a_short_element(self):
        def energy(h):
            e, at_centre = eq66(jonker_modes(h), h), np.eye(8)
            at_centre[2:6, 1] = np.array([-YS, YS, -ZS, ZS]) / h
            return (at_centre @ e) @ appendix_a(h) @ (at_centre @ e) / (2 * h)
        eps, gy, gz, gw, kx, ky, kz = values(predicted_beam.jonker)
        g = np.array([gy, gz, gw])
        bending = IY * ky ** 2 + IZ * kz ** 2 + IW * RATE ** 2
        density = (E * (AREA * eps ** 2 + bending) + G * (g @ D @ g + IT * kx ** 2)) / 2
        self.assertLess(abs(extrapolated(energy, 0.1) / density - 1), 1e-5)

    def test_all_are_right_without_shear(self):
        given = {"gamma": (0.02, 0, 0), "a": KAPPA[0]}
        right = predicted_beam.simo_reissner(*variables(**given), (0, 0), POLAR)
        for name in ("beamw", "sheet_second", "sheet_second_consistent"):
            ours = predicted_beam.OF[name](*variables(**given), (0, 0), POLAR)
            for one, other in zip(ours, right):
                self.assertAlmostEqual(one.value[0], other.value[0], delta=1e-14)

    def test_derivatives(self):
        point, step = np.array([*GAMMA, *KAPPA, A]), 1e-5

        def jets(measures, shift):
            v = Jet.variables((point + shift)[:, None])
            return measures(v[:3], v[3:6], v[6], CENTRE, POLAR)
        for measures in set(predicted_beam.OF.values()):
            for i, d in enumerate(step * np.eye(7)):
                found = zip(jets(measures, d), jets(measures, -d), jets(measures, 0 * d))
                for ahead, back, here in found:
                    slope = (ahead.value[0] - back.value[0]) / (2 * step)
                    second = (ahead.gradient - back.gradient)[:, 0] / (2 * step)
                    self.assertAlmostEqual(slope, here.gradient[i, 0], delta=1e-8)
                    self.assertLess(np.max(np.abs(second - here.hessian[i, :, 0])), 1e-8)


if __name__ == "__main__":
    unittest.main()
