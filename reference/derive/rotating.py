"""Free vibration of a cantilever that turns about an axis through its root, normal to it: flap and lag.

Units: L = 1, EI = 1, rho A = 1; EA = s^2 with s the slenderness L/sqrt(I/A).  No shear, no rotary inertia.
Equilibrium: stretch x' = 1 + N/EA, N' = -Omega^2 x: x = sin(kX)/(k cos k), k = Omega/s (end stretch tan k/k - 1).
Second order in w: 1/2 [N w'^2/x' + (w'/x')'^2]; flap: det(K - omega^2 M) = 0; lag adds -Omega^2 v and the Coriolis coupling
with stretching, 2 Omega (u' v - u v').  s -> inf: w'''' - Omega^2/2 ((1 - X^2) w')' = omega^2 w, and lag^2 = flap^2 - Omega^2.
Galerkin method with integrated Legendre polynomials; spectral, so that all digits are reached.
"""
import numpy as np
from numpy.polynomial import legendre
from scipy.linalg import eigh, eig

SIZE = 18
RELATIVE = 5e-12


def _basis(times):
    """Values and derivatives at Gauss points of polynomials that vanish with their first `times` - 1 derivatives at 0."""
    points, weights = legendre.leggauss(2 * SIZE)
    fields = []
    for n in range(SIZE):
        series = [np.array([0.0] * n + [1.0])]
        for _ in range(times):
            series.append(legendre.legint(series[-1], lbnd=-1))
        scale = np.sqrt(2 * n + 1)
        fields.append([scale * 2.0 ** (d - times) * legendre.legval(points, series[times - d]) for d in range(times + 1)])
    return (points + 1) / 2, weights / 2, np.array(fields)


def matrices(omega, s):
    """(K, M) of flap, (K, M) of stretching, coupling int u v."""
    X, weight, w = _basis(2)
    _, _, u = _basis(1)
    k = omega / s
    stretch = np.cos(k * X) / np.cos(k)
    slope = -k * np.sin(k * X) / np.cos(k)  # of the stretch
    force = s * s * (2 * np.sin(k * (1 - X) / 2) * np.sin(k * (1 + X) / 2) / np.cos(k))  # s^2 (stretch - 1), without cancellation
    curvature = w[:, 2] / stretch - w[:, 1] * slope / stretch ** 2
    K = (curvature * weight) @ curvature.T + (w[:, 1] * (weight * force / stretch)) @ w[:, 1].T
    M = (w[:, 0] * weight) @ w[:, 0].T
    return K, M, s * s * (u[:, 1] * weight) @ u[:, 1].T, (u[:, 0] * weight) @ u[:, 0].T, (u[:, 0] * weight) @ w[:, 0].T


def flap(omega, s, count=3):
    K, M, _, _, _ = matrices(omega, s)
    return 1 / np.sqrt(eigh(M, K, eigvals_only=True)[::-1][:count])  # the lowest are the best conditioned so


def lag(omega, s, count=3):
    """u'' - 2 Omega v' + (K_u - Omega^2) u = 0, v'' + 2 Omega u' + (K - Omega^2) v = 0 (primes: time)."""
    K, M, Ku, Mu, C = matrices(omega, s)
    n = SIZE
    mass = np.block([[Mu, np.zeros((n, n))], [np.zeros((n, n)), M]])
    stiffness = np.block([[Ku - omega ** 2 * Mu, np.zeros((n, n))], [np.zeros((n, n)), K - omega ** 2 * M]])
    gyroscopic = 2 * omega * np.block([[np.zeros((n, n)), -C], [C.T, np.zeros((n, n))]])
    # With stiffness = L L^T and z = L^T x: (mu^2 + mu L^-1 G L^-T + L^-1 M L^-T) z = 0, mu = 1/(i omega): well conditioned where it matters.
    inverse = np.linalg.inv(np.linalg.cholesky(stiffness))
    B = np.block([[np.zeros((2 * n, 2 * n)), np.eye(2 * n)], [-inverse @ mass @ inverse.T, -inverse @ gyroscopic @ inverse.T]])
    values = eig(B, right=False)
    found = np.sort(1 / np.abs(values.imag[np.abs(values.imag) > 1e-9 * np.max(np.abs(values.imag))]))
    return found[::2][:count]


def rows():
    for slenderness in (1000, 100):
        for omega in (0, 2, 6, 12):
            at = [f"omega_star={omega}"] if omega else []
            at += [f"slenderness={slenderness}"] if slenderness != 1000 else []
            for name, values in (("flap", flap(omega, slenderness)), ("lag", lag(omega, slenderness))):
                for i, value in enumerate(values):
                    yield "rotating_cantilever", ";".join(at), f"{name}_{i + 1}", value, "1", RELATIVE
