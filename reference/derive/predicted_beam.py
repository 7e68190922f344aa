"""The beam that a printed element converges to: beam.py with the measures of predicted_strains.py.

Energy per length W = 1/2 s.E, E(gamma, kappa, a) the measures and s their stresses.  At each point
the stress resultants N, M of beam.py and the amplitude a are given; gamma, kappa and s follow from
  E = compliance s  (torsion: s = GJ k_x + 4 c k_x^3),  N = s.dE/dgamma,  M = s.dE/dkappa
(nothing warps: without g_w).  Then r' = R (e_x + gamma), q' = q o (0, kappa)/2, EIw a' = B,
B' = s.dE/da.
"""
import numpy as np

from reference.derive.beam import Beam, Scaled, product, rotation
from reference.derive.predicted_strains import MEASURES, OF, VARIABLES, Jet

WARPING, TORSION = 3, 4  # among the measures
NEWTON_STEPS, SETTLED = 40, 1e-12


class Printed(Beam):
    """A Beam with the strains of a formulation: its name or a function of that kind."""

    def __init__(self, beam, formulation):
        self.__dict__.update(beam.__dict__)
        self.measures = OF.get(formulation, formulation)
        eccentricity = beam.centre[0] ** 2 + beam.centre[1] ** 2
        self.polar = beam.t - eccentricity  # Ip/A, 0 without the trapeze term
        if formulation == "sheet_third":  # N Eq. 50: g_y = 0
            self.f = self.f * np.diag([0.0, 1.0, 1.0])

    def scaled(self, length, force):
        s = ScaledPrinted()
        s.__dict__.update(super().scaled(length, force).__dict__)
        s.measures, s.polar = self.measures, self.polar / length ** 2
        return s


class ScaledPrinted(Scaled):
    @property
    def kept(self):
        """The measures that count."""
        return [i for i in range(MEASURES) if self.warps or i != WARPING]

    def _measures(self, x, a):
        """Jets of the kept measures by (gamma, kappa, a)."""
        v = Jet.variables(np.concatenate([x[:6], a[None]]))
        E = self.measures(v[:3], v[3:6], v[6] if self.warps else None, self.centre, self.polar)
        E[6] = E[6] - self.curvature
        return [E[i] for i in self.kept]

    def _compliance(self):
        """[kept, kept]; that of torsion is not linear: see _constitutive."""
        C = np.zeros((MEASURES, MEASURES))
        C[0, 0], C[5, 5], C[6, 6], C[1:4, 1:4] = self.a, self.by, self.bz, self.f
        return C[np.ix_(self.kept, self.kept)]

    def _torsional_rigidity(self, twist):
        return self.gj + 12 * self.c * twist ** 2

    def _constitutive(self, E, s):
        """E - compliance s [kept, many], and its derivatives by (gamma, kappa, a) and by s."""
        C, t = self._compliance(), self.kept.index(TORSION)
        right = np.array([e.value for e in E]) - C @ s
        by_v = np.array([e.gradient for e in E])
        by_s = np.repeat(-C[:, :, None], s.shape[1], axis=2)
        twist = E[t].value
        right[t] = self.gj * twist + 4 * self.c * twist ** 3 - s[t]
        by_v[t], by_s[t, t] = self._torsional_rigidity(twist) * by_v[t], -1.0
        return right, by_v, by_s

    def _equations(self, x, given):
        """Residual and its derivative by x = (gamma, kappa, s); given = (N, M, a) [7, many]."""
        E, s = self._measures(x, given[6]), x[6:]
        right, by_v, by_s = self._constitutive(E, s)
        gradient = np.array([e.gradient[:6] for e in E])
        balance = np.einsum("im,ikm->km", s, gradient) - given[:6]
        curved = sum(stress * e.hessian[:6, :6] for stress, e in zip(s, E))
        matrix = np.concatenate([np.concatenate([by_v[:, :6], by_s], axis=1),
                                 np.concatenate([curved, np.swapaxes(gradient, 0, 1)], axis=1)])
        return np.concatenate([right, balance]).T, np.moveaxis(matrix, 2, 0)

    def _settled(self, given):
        """x [n, many] by Newton's method from the stress-free state."""
        x = np.zeros((6 + len(self.kept), given.shape[1]))
        scale = 1 + np.max(np.abs(given[:6]), axis=0)
        for _ in range(NEWTON_STEPS):
            residual, matrix = self._equations(x, given)
            step = np.linalg.solve(matrix, residual[:, :, None])[:, :, 0].T
            x = x - step
            if max(np.max(np.abs(step[:6])), np.max(np.abs(step[6:]) / scale)) < SETTLED:
                return x
        raise ArithmeticError("the strains at a point did not settle")

    def _derivatives(self, x, given):
        """Of (gamma, kappa, B') [many, 7, 7] by (N, M, a), and B' [many]."""
        E, s, count = self._measures(x, given[6]), x[6:], len(self.kept)
        curved = sum(stress * e.hessian for stress, e in zip(s, E))
        pull = np.array([e.gradient[6] for e in E])
        right = np.zeros((given.shape[1], 6 + count, VARIABLES))
        right[:, count + np.arange(6), np.arange(6)] = 1.0
        right[:, :count, 6] = -self._constitutive(E, s)[1][:, 6].T
        right[:, count:, 6] = -curved[:6, 6].T
        by = np.linalg.solve(self._equations(x, given)[1], right)
        rate = np.einsum("im,mij->mj", np.concatenate([curved[6, :6], pull]), by)
        rate[:, 6] += curved[6, 6]
        return np.concatenate([by[:, :6], rate[:, None]], axis=1), np.einsum("im,im->m", s, pull)

    def _local(self, given):
        """gamma, kappa, B' [7, many] of (N, M, a); imaginary parts go through the derivatives."""
        points, place = np.unique(given.real, axis=1, return_inverse=True)
        x = self._settled(points)
        by, rate = self._derivatives(x, points)
        value = np.concatenate([x[:6], rate[None]])[:, place]
        if not np.iscomplexobj(given):
            return value
        return value + 1j * np.einsum("mij,jm->im", by[place], given.imag)

    def slope(self, y, p):
        """As in beam.py."""
        R, F = rotation(y[3:7]), p[:3]
        m = p[3:] - np.cross(y[:3], F, axis=0)
        N, M = np.einsum("ijk,ik->jk", R, F), np.einsum("ijk,ik->jk", R, m)
        strains = self._local(np.concatenate([N, M, y[7:8] if self.warps else 0 * N[:1]]))
        along, kappa = np.concatenate([1 + strains[:1], strains[1:3]]), strains[3:6]
        turn = product(y[3:7], np.concatenate([0 * kappa[:1], kappa])) / 2
        out = [np.einsum("ijk,jk->ik", R, along), turn]
        if self.warps:
            out.append(np.array([y[8] / self.iw, strains[6]]))
        return self.length * np.concatenate(out)
