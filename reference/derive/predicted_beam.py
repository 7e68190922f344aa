"""The beam to which a printed element converges: beam.py with the measures below.

The energy per length is W = 1/2 s.E, where E(gamma, kappa, a) are the measures and s their stresses. At each point,
the stress resultants N, M of beam.py and the amplitude a are given. gamma, kappa and s are the solution of
  E = compliance s  (torsion: s = GJ k_x + 4 c k_x^3),  N = s.dE/dgamma,  M = s.dE/dkappa
Without warping, g_w is absent.  Then r' = R (e_x + gamma), q' = q o (0, kappa)/2, EIw a' = B, B' = s.dE/da.
"""
import numpy as np

from reference.derive.beam import Beam, Scaled, product, rotation

# Strain measures of printed elements under refinement, that is, of a short element of a smooth beam.  r' = R (e_x +
# gamma), kappa~ = R^T R', and a is the warping amplitude. h is the length, lambda = |e_x + gamma|, and the chord is
# along n = (e_x + gamma)/lambda. Each function returns (eps, g_y, g_z, g_w, k_x, k_y, k_z) to leading order in h.
# The corresponding stiffness tends to diag(EA, G D, GIt, EIy, EIz), and the stiffness of a' is EIw. The shear
# strains g are those of the shear centre. reference/test/measures_test.py contains proofs with short elements.  J
# Eq. 7, where e3, e4 = -+ h n_z + h^2 k_y/2, e5, e6 = +- h n_y + h^2 k_z/2, e2 = h^2 kappa_x:   eps = lambda - 1,
# g_y = n_y - zs k_x,  g_z = n_z + ys k_x,  g_w = k_x - a,   k_x = kappa_x,  k_y = n_x kappa_y - n_y kappa_x,  k_z =
# n_x kappa_z - n_z kappa_x J Eq. 66, with w = kappa_x - a:   eps + (n_y^2 + n_z^2)/10 + (Ip/A) (kappa_x^2 +
# w^2/5)/2 - (ys^2 + zs^2) kappa_x^2/10,   k_x + n_y k_y + n_z k_z,  k_y - n_y w/5,  k_z - n_z w/5 N Eqs. 37, 40,
# 42, with the angles of N's local coordinates, sin y = n_z, tan z = -n_y/n_x, and p = kappa_x - kappa_y tan z, y' =
# kappa_y/cos z, z' = kappa_z:   eps = lambda - 1 + (y^2 + z^2)/10 + Ite p^2/2,  g_y = -z,  g_z = y,  g_w = p - a,
# k_x = p + y z',  k_y = y' + z p,  k_z = z' - y p The same integrals over the linear solution with shear
# (sheet_second_consistent):   eps = lambda - 1 - (y^2 + z^2)/2 + Ite p^2/2,  k_x = p + z y',  k_y = y',  k_z = z' N
# Eqs. 44-65 (sheet_third) give the measures of Eq. 37. The terms added by the stress function are of higher order
# in h, and g_y has no compliance (N Eq. 50).

VARIABLES = 7  # gamma, kappa, a
MEASURES = 7


class Jet:
    """A value [many] with its gradient [VARIABLES, many] and Hessian [VARIABLES, VARIABLES, many]."""

    def __init__(self, value, gradient, hessian):
        self.value, self.gradient, self.hessian = value, gradient, hessian

    @staticmethod
    def variables(values):
        """Returns one Jet for each row of values [VARIABLES, many]."""
        zero = np.zeros((VARIABLES,) + values.shape, dtype=values.dtype)
        return [Jet(v, np.eye(VARIABLES)[i][:, None] + zero[0], zero) for i, v in enumerate(values)]

    def _of(self, value, first, second):
        g = self.gradient
        return Jet(value, first * g, first * self.hessian + second * g[:, None] * g[None])

    def __add__(self, other):
        if not isinstance(other, Jet):
            return Jet(self.value + other, self.gradient, self.hessian)
        return Jet(self.value + other.value, self.gradient + other.gradient,
                   self.hessian + other.hessian)

    def __mul__(self, other):
        if not isinstance(other, Jet):
            return Jet(self.value * other, self.gradient * other, self.hessian * other)
        cross = self.gradient[:, None] * other.gradient[None]
        curved = self.value * other.hessian + other.value * self.hessian
        gradient = self.value * other.gradient + other.value * self.gradient
        return Jet(self.value * other.value, gradient, curved + cross + np.swapaxes(cross, 0, 1))

    __radd__, __rmul__ = __add__, __mul__

    def __neg__(self):
        return self * -1.0

    def __sub__(self, other):
        return self + other * -1.0

    def __truediv__(self, other):
        return self * other._of(1 / other.value, -1 / other.value ** 2, 2 / other.value ** 3)

    def sqrt(self):
        root = np.sqrt(self.value)
        return self._of(root, 1 / (2 * root), -1 / (4 * root * self.value))

    def arcsin(self):
        x = self.value
        first = 1 / np.sqrt(1 - x * x)
        return self._of(np.arcsin(x), first, x * first ** 3)

    def arctan(self):
        x = self.value
        first = 1 / (1 + x * x)
        return self._of(np.arctan(x), first, -2 * x * first ** 2)


def chord(gamma):
    """Returns lambda and n."""
    x = gamma[0] + 1.0
    stretch = (x * x + gamma[1] * gamma[1] + gamma[2] * gamma[2]).sqrt()
    return stretch, [x / stretch, gamma[1] / stretch, gamma[2] / stretch]


def jonker_first(gamma, kappa, a, centre, polar):
    """If a is None, there is no warping."""
    stretch, n = chord(gamma)
    ys, zs = centre
    k = [kappa[0], n[0] * kappa[1] - n[1] * kappa[0], n[0] * kappa[2] - n[2] * kappa[0]]
    warping = None if a is None else k[0] - a
    return [stretch + -1.0, n[1] - zs * k[0], n[2] + ys * k[0], warping] + k


def jonker(gamma, kappa, a, centre, polar):
    eps, _, _, w, kx, ky, kz = jonker_first(gamma, kappa, a, centre, polar)
    _, n = chord(gamma)
    ys, zs = centre
    eps = eps + (n[1] * n[1] + n[2] * n[2]) * 0.1 + kx * kx * (polar / 2 - (ys * ys + zs * zs) / 10)
    twist, warping = kx + n[1] * ky + n[2] * kz, None
    if w is not None:
        eps, ky, kz = eps + w * w * (polar / 10), ky - n[1] * w * 0.2, kz - n[2] * w * 0.2
        warping = twist - a
    return [eps, n[1] - zs * twist, n[2] + ys * twist, warping, twist, ky, kz]


def _angles(gamma, kappa):
    stretch, n = chord(gamma)
    slope = -(n[1] / n[0])  # tan z
    rate = kappa[1] * (slope * slope + 1.0).sqrt()
    return stretch, n[2].arcsin(), slope.arctan(), kappa[0] - kappa[1] * slope, rate


def nijenhuis(gamma, kappa, a, centre, polar):
    stretch, y, z, p, dy = _angles(gamma, kappa)
    eps = stretch + -1.0 + (y * y + z * z) * 0.1 + p * p * (polar / 2)
    warping = None if a is None else p - a
    return [eps, -z, y, warping, p + y * kappa[2], dy + z * p, kappa[2] - y * p]


def nijenhuis_sheared(gamma, kappa, a, centre, polar):
    stretch, y, z, p, dy = _angles(gamma, kappa)
    eps = stretch + -1.0 - (y * y + z * z) * 0.5 + p * p * (polar / 2)
    return [eps, -z, y, None if a is None else p - a, p + z * dy, dy, kappa[2]]


def simo_reissner(gamma, kappa, a, centre, polar):
    """Returns the strains of beam.py without the eccentricity terms, for tests."""
    (ys, zs), warping = centre, None if a is None else kappa[0] - a
    eps = gamma[0] + kappa[0] * kappa[0] * (polar / 2)
    return [eps, gamma[1] - zs * kappa[0], gamma[2] + ys * kappa[0], warping] + list(kappa)


OF = {"beamw": jonker, "beamw_vlasov": jonker, "beamw_first": jonker_first,
      "sheet_second": nijenhuis, "sheet_third": nijenhuis,
      "sheet_second_consistent": nijenhuis_sheared}


WARPING, TORSION = 3, 4  # indices among the measures
NEWTON_STEPS, SETTLED = 40, 1e-12


class Printed(Beam):
    """A Beam with the strain measures of a formulation, given by its name or by a function as above."""

    def __init__(self, beam, formulation):
        self.__dict__.update(beam.__dict__)
        self.measures = OF.get(formulation, formulation)
        eccentricity = beam.centre[0] ** 2 + beam.centre[1] ** 2
        self.polar = beam.t - eccentricity  # Ip/A, or 0 without the trapeze term
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
        return [i for i in range(MEASURES) if self.warps or i != WARPING]

    def _measures(self, x, a):
        v = Jet.variables(np.concatenate([x[:6], a[None]]))
        E = self.measures(v[:3], v[3:6], v[6] if self.warps else None, self.centre, self.polar)
        E[6] = E[6] - self.curvature
        return [E[i] for i in self.kept]

    def _compliance(self):
        """Returns the compliance [kept, kept] without torsion, which is nonlinear (see _constitutive)."""
        C = np.zeros((MEASURES, MEASURES))
        C[0, 0], C[5, 5], C[6, 6], C[1:4, 1:4] = self.a, self.by, self.bz, self.f
        return C[np.ix_(self.kept, self.kept)]

    def _torsional_rigidity(self, twist):
        return self.gj + 12 * self.c * twist ** 2

    def _constitutive(self, E, s):
        """Returns E - compliance s [kept, many] and its derivatives with respect to (gamma, kappa, a) and to s."""
        C, t = self._compliance(), self.kept.index(TORSION)
        right = np.array([e.value for e in E]) - C @ s
        by_v = np.array([e.gradient for e in E])
        by_s = np.repeat(-C[:, :, None], s.shape[1], axis=2)
        twist = E[t].value
        right[t] = self.gj * twist + 4 * self.c * twist ** 3 - s[t]
        by_v[t], by_s[t, t] = self._torsional_rigidity(twist) * by_v[t], -1.0
        return right, by_v, by_s

    def _equations(self, x, given):
        """Returns the residual and its derivative with respect to x = (gamma, kappa, s). `given` is (N, M, a) [7, many]."""
        E, s = self._measures(x, given[6]), x[6:]
        right, by_v, by_s = self._constitutive(E, s)
        gradient = np.array([e.gradient[:6] for e in E])
        balance = np.einsum("im,ikm->km", s, gradient) - given[:6]
        curved = sum(stress * e.hessian[:6, :6] for stress, e in zip(s, E))
        matrix = np.concatenate([np.concatenate([by_v[:, :6], by_s], axis=1),
                                 np.concatenate([curved, np.swapaxes(gradient, 0, 1)], axis=1)])
        return np.concatenate([right, balance]).T, np.moveaxis(matrix, 2, 0)

    def _settled(self, given):
        x = np.zeros((6 + len(self.kept), given.shape[1]))
        scale = 1 + np.max(np.abs(given[:6]), axis=0)
        for _ in range(NEWTON_STEPS):
            residual, matrix = self._equations(x, given)
            step = np.linalg.solve(matrix, residual[:, :, None])[:, :, 0].T
            x = x - step
            if max(np.max(np.abs(step[:6])), np.max(np.abs(step[6:]) / scale)) < SETTLED:
                return x
        raise ArithmeticError("the strains at a point did not converge")

    def _derivatives(self, x, given):
        """Returns the derivatives of (gamma, kappa, B') [many, 7, 7] with respect to (N, M, a), and B' [many]."""
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
        """Returns gamma, kappa and B' [7, many] for (N, M, a). Imaginary parts (complex steps) are computed from the
        derivatives."""
        points, place = np.unique(given.real, axis=1, return_inverse=True)
        x = self._settled(points)
        by, rate = self._derivatives(x, points)
        value = np.concatenate([x[:6], rate[None]])[:, place]
        if not np.iscomplexobj(given):
            return value
        return value + 1j * np.einsum("mij,jm->im", by[place], given.imag)

    def slope(self, y, p):
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
