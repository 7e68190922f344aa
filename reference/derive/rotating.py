"""Free vibration of a cantilever in steady rotation: flap and lag for an axis normal to the beam, and whirling for an
axis along the beam.

L = 1, EI = 1 and rho A = 1. EA = s^2 with the slenderness s = L/sqrt(I/A), and the root is at x = R. Shear deformation
and rotary inertia are neglected.

Equilibrium: x' = 1 + N/EA and N' = -Omega^2 x give x = R cos kX + (1 + k R sin k) sin(kX)/(k cos k) with k = Omega/s.
The elongation is tan k/k - 1 + R (1/cos k - 1), and the force on the root is s^2 (x'(0) - 1).

Vibration: the energy of second order in w is 1/2 [N w'^2/x' + (w'/x')'^2]. Flap satisfies det(K - omega^2 M) = 0. Lag
has the additional term -Omega^2 v and the Coriolis coupling with stretching, 2 Omega (u' v - u v'). For s -> inf,
w'''' - Omega^2/2 ((1 - X^2) w')' = omega^2 w, and lag^2 = flap^2 - Omega^2. The Galerkin method with integrated
Legendre polynomials converges spectrally to all digits.

If the axis is along the beam, there is no stretch, and the two planes have the modes of the beam at rest, omega_j and
omega_j sqrt(ratio). Then lambda^4 + lambda^2 (a + b + 4 Omega^2) + a b = 0 with a = omega_j^2 - Omega^2 and b = ratio
omega_j^2 - Omega^2.
"""
import numpy as np
from mpmath import cos, cosh, findroot, mp, mpf, pi, sin, sqrt, tan
from numpy.polynomial import legendre
from scipy.linalg import eigh, eig

from reference.derive import defaults

mp.dps = 30
SIZE = 18
RELATIVE = 5e-12


def _basis(times):
    """Returns Gauss points and weights on [0, 1], and the values and derivatives at these points [SIZE, times + 1,
    points] of polynomials. The polynomials and their first `times` - 1 derivatives vanish at 0."""
    points, weights = legendre.leggauss(2 * SIZE)
    fields = []
    for n in range(SIZE):
        series = [np.array([0.0] * n + [1.0])]
        for _ in range(times):
            series.append(legendre.legint(series[-1], lbnd=-1))
        scale = np.sqrt(2 * n + 1)
        fields.append([
            scale * 2.0 ** (d - times) * legendre.legval(points, series[times - d])
            for d in range(times + 1)
        ])
    return (points + 1) / 2, weights / 2, np.array(fields)


def matrices(omega, s, R=0):
    """Returns (K, M) of flap, (K, M) of stretching, and the coupling int u v."""
    X, weight, w = _basis(2)
    _, _, u = _basis(1)
    k = omega / s
    strain = (2 * np.sin(k * (1 - X) / 2) * np.sin(k * (1 + X) / 2) +
              k * R * np.sin(k * (1 - X))) / np.cos(k)  # a form without cancellation
    stretch, force = 1 + strain, s * s * strain
    slope = -k * (np.sin(k * X) + k * R * np.cos(k * (1 - X))) / np.cos(k)  # derivative of the stretch
    curvature = w[:, 2] / stretch - w[:, 1] * slope / stretch ** 2
    K = (curvature * weight) @ curvature.T + (w[:, 1] * (weight * force / stretch)) @ w[:, 1].T
    M = (w[:, 0] * weight) @ w[:, 0].T
    return K, M, s * s * (u[:, 1] * weight) @ u[:, 1].T, (u[:, 0] * weight) @ u[:, 0].T, (
        u[:, 0] * weight) @ w[:, 0].T


def flap(omega, s, count=3, R=0):
    K, M, _, _, _ = matrices(omega, s, R)
    return 1 / np.sqrt(eigh(
        M, K, eigvals_only=True)[::-1][:count])  # this form is well conditioned for the lowest frequencies


def lag(omega, s, count=3, R=0):
    """Returns the lowest frequencies of u'' - 2 Omega v' + (K_u - Omega^2) u = 0, v'' + 2 Omega u' + (K - Omega^2) v = 0,
    where primes are time derivatives."""
    K, M, Ku, Mu, C = matrices(omega, s, R)
    n = SIZE
    mass = np.block([[Mu, np.zeros((n, n))], [np.zeros((n, n)), M]])
    stiffness = np.block([[Ku - omega ** 2 * Mu, np.zeros((n, n))],
                          [np.zeros((n, n)), K - omega ** 2 * M]])
    gyroscopic = 2 * omega * np.block([[np.zeros((n, n)), -C], [C.T, np.zeros((n, n))]])
    # With stiffness = L L^T and z = L^T x, (mu^2 + mu L^-1 G L^-T + L^-1 M L^-T) z = 0 and mu = 1/(i omega). This form is
    # well conditioned for the lowest modes.
    inverse = np.linalg.inv(np.linalg.cholesky(stiffness))
    B = np.block([[np.zeros((2 * n, 2 * n)), np.eye(2 * n)],
                  [-inverse @ mass @ inverse.T, -inverse @ gyroscopic @ inverse.T]])
    values = eig(B, right=False)
    found = np.sort(
        1 / np.abs(values.imag[np.abs(values.imag) > 1e-9 * np.max(np.abs(values.imag))]))
    return found[::2][:count]


def stretch(omega, s, R=0):
    k = mpf(omega) / s
    return tan(k) / k - 1 + R * (1 / cos(k) - 1)


def root_force(omega, s, R=0):
    k = mpf(omega) / s
    return mpf(s) ** 2 * ((1 + k * R * sin(k)) / cos(k) - 1)


def bending(count):
    return [
        findroot(lambda z: cos(z) + 1 / cosh(z),
                 (j + mpf(1) / 2) * pi + (mpf("0.3") if j == 0 else 0)) ** 2 for j in range(count)
    ]


def whirl(omega, ratio, count):
    """Returns (frequencies, largest growth rate) for an axis along the beam."""
    frequencies, growth = [], mpf(0)
    for rest in bending(count):
        a, b = rest ** 2 - mpf(omega) ** 2, ratio * rest ** 2 - mpf(omega) ** 2
        half = (a + b + 4 * mpf(omega) ** 2) / 2
        large = half + sqrt(half ** 2 - a * b)  # the roots lambda^2 are -large and -small
        small = a * b / large
        frequencies += [sqrt(large)] + ([sqrt(small)] if small > 0 else [])
        growth = max(growth, sqrt(-small) if small < 0 else mpf(0))
    return sorted(frequencies), growth


def across(**given):
    value, at = {**defaults.values("rotating_cantilever"), **given}, defaults.differing(
                     "rotating_cantilever", **given)
    omega, slenderness, R = value["omega_star"], value["slenderness"], value["hub_radius"]
    for name, values in (("flap", flap(omega, slenderness,
                                       R=R)), ("lag", lag(omega, slenderness, R=R))):
        for i, value in enumerate(values):
            yield "rotating_cantilever", at, f"{name}_{i + 1}", value, "1", RELATIVE
    if omega:
        yield "rotating_cantilever", at, "stretch", stretch(omega, slenderness, R), "1"
        yield "rotating_cantilever", at, "root_force", root_force(omega, slenderness, R), "1"
    yield "rotating_cantilever", at, "growth", 0, "1"


def rows():
    for slenderness in (1000, 100):
        for omega in (0, 2, 6, 12):
            yield from across(omega_star=omega, slenderness=slenderness)
    for given in ({"omega_star": 12,
                   "stations": 13}, {"hub_radius": 1}, {"hub_radius": -2, "omega_star": 1}):
        yield from across(**given)
    for name, value in (("stretch", stretch(5, 10)), ("root_force", root_force(5, 10))):
        yield "rotating_cantilever", "omega_star=5;slenderness=10", name, value, "1"
    for omega, ratio, more in ((2, 1, ""), (5, 4, ";stiffness_ratio=4"),
                               (10, 4, ";stations=41;stiffness_ratio=4")):
        at = f"axis=1.5707963267948966;omega_star={omega}{more}"
        frequencies, growth = whirl(omega, ratio, 4)
        for i in range(4):
            yield "rotating_cantilever", at, f"whirl_{i + 1}", frequencies[i], "1"
        yield "rotating_cantilever", at, "growth", growth, "1"
