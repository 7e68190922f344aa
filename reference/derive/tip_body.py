"""Free vibration of a cantilever with a rigid body at its end, at rest and in steady rotation about an axis through the
root, normal to the beam.

The units and the beam are those of rotating.py: L = 1, EI = 1, rho A = 1, EA = s^2. The body has the mass m, and its
centre of mass is c beyond the end. Its inertia is J = m g^2 about transverse axes through that centre, and zero about
the axis of the beam.

At rest: w'''' = omega^2 w and w(0) = w'(0) = 0. At the end, with y = w + c w', w'' = omega^2 (J w' + m c y) and w''' =
-omega^2 m y.

Equilibrium: x'' = -k^2 x with k = Omega/s, x(0) = 0 and s^2 (x'(1) - 1) = m Omega^2 (x(1) + c).

Second order about this equilibrium, with the slope t = w'/x' at the end and y = w + c t: the body adds 1/2 Omega^2 (m
c (x + c) + J) t^2 to the energy of flap and 1/2 Omega^2 (m c (x + c) t^2 - m (u^2 + y^2)) to that of lag. The body
adds m (u^2, y^2) and J t^2 to the mass, and m u y to the Coriolis coupling. The Galerkin method is that of
rotating.py.
"""
import numpy as np
from mpmath import cos, cosh, findroot, matrix, mp, mpf, sin, sinh, det
from numpy.polynomial import legendre
from scipy.linalg import eig, eigh

from reference.derive import rotating

mp.dps = 30
S = 1000
COUNT = 3


def at_rest(m, c, g, count=COUNT):
    """Returns the exact frequencies at rest. With w = A (cosh - cos) + B (sinh - sin), they are the zeros of the
    determinant of the conditions at the end, found between samples of the wave number z = sqrt(omega)."""
    m, c, J = mpf(m), mpf(c), mpf(m) * mpf(g) ** 2

    def boundary(z):
        w = [(cosh(z) - cos(z)) / cosh(z), (sinh(z) - sin(z)) / cosh(z)]
        w1 = [z * (sinh(z) + sin(z)) / cosh(z), z * (cosh(z) - cos(z)) / cosh(z)]
        w2 = [z ** 2 * (cosh(z) + cos(z)) / cosh(z), z ** 2 * (sinh(z) + sin(z)) / cosh(z)]
        w3 = [z ** 3 * (sinh(z) - sin(z)) / cosh(z), z ** 3 * (cosh(z) + cos(z)) / cosh(z)]
        y = [w[i] + c * w1[i] for i in (0, 1)]
        return det(
            matrix([[w2[i] - z ** 4 * (J * w1[i] + m * c * y[i]) for i in (0, 1)],
                    [w3[i] + z ** 4 * m * y[i] for i in (0, 1)]]))

    found, step, z = [], mpf(1) / 50, mpf(1) / 50
    while len(found) < count:
        if boundary(z) * boundary(z + step) < 0:
            found.append(findroot(boundary, (z, z + step), solver="anderson") ** 2)
        z += step
    return found


def equilibrium(omega, m, c, s=S):
    k = mpf(omega) / s
    return (1 + mpf(m) * k ** 2 * mpf(c)) / (k * cos(k) - mpf(m) * k ** 2 * sin(k)), k


def _ends(times):
    fields = []
    for n in range(rotating.SIZE):
        series = [np.array([0.0] * n + [1.0])]
        for _ in range(times):
            series.append(legendre.legint(series[-1], lbnd=-1))
        scale = np.sqrt(2 * n + 1)
        fields.append(
            [scale * 2.0 ** (d - times) * legendre.legval(1.0, series[times - d]) for d in (0, 1)])
    return np.array(fields)


def matrices(omega, m, c, g, s=S):
    """Returns (K, M) of flap, (K, M) of lag, (K, M) of stretching, and the coupling, for the beam and the body. K of lag
    and of stretching include centrifugal softening."""
    X, weight, w = rotating._basis(2)
    _, _, u = rotating._basis(1)
    J = m * g * g
    if omega:
        B, k = equilibrium(omega, m, c, s)
        strain = np.array([float(B * k * cos(k * mpf(float(x))) - 1) for x in X])
        slope = np.array([float(-B * k ** 2 * sin(k * mpf(float(x)))) for x in X])
        end, end_stretch = float(B * sin(k)), float(B * k * cos(k))
    else:
        strain, slope, end, end_stretch = 0 * X, 0 * X, 1.0, 1.0
    stretch, force = 1 + strain, s * s * strain
    curvature = w[:, 2] / stretch - w[:, 1] * slope / stretch ** 2
    K = (curvature * weight) @ curvature.T + (w[:, 1] * (weight * force / stretch)) @ w[:, 1].T
    M = (w[:, 0] * weight) @ w[:, 0].T
    Ku, Mu, C = s * s * (u[:, 1] * weight) @ u[:, 1].T, (u[:, 0] * weight) @ u[:, 0].T, (
        u[:, 0] * weight) @ w[:, 0].T
    at = _ends(2)
    t, u_end = at[:, 1] / end_stretch, _ends(1)[:, 0]
    y = at[:, 0] + c * t
    tt, translations = np.outer(t, t), M + m * np.outer(y, y)
    mass, pulled = translations + J * tt, K + omega ** 2 * m * c * (end + c) * tt
    Mu = Mu + m * np.outer(u_end, u_end)
    return ((pulled + omega ** 2 * J * tt, mass), (pulled - omega ** 2 * translations, mass),
            (Ku - omega ** 2 * Mu, Mu), C + m * np.outer(u_end, y))


def flap(omega, m, c, g, s=S, count=COUNT):
    K, M = matrices(omega, m, c, g, s)[0]
    return 1 / np.sqrt(eigh(M, K, eigvals_only=True)[::-1][:count])


def lag(omega, m, c, g, s=S, count=COUNT):
    _, (K, M), (Ku, Mu), C = matrices(omega, m, c, g, s)
    n = rotating.SIZE
    none = np.zeros((n, n))
    mass, stiffness = np.block([[Mu, none], [none, M]]), np.block([[Ku, none], [none, K]])
    gyroscopic = 2 * omega * np.block([[none, -C], [C.T, none]])
    inverse = np.linalg.inv(np.linalg.cholesky(stiffness))
    B = np.block([[np.zeros((2 * n, 2 * n)), np.eye(2 * n)],
                  [-inverse @ mass @ inverse.T, -inverse @ gyroscopic @ inverse.T]])
    values = eig(B, right=False)
    found = np.sort(
        1 / np.abs(values.imag[np.abs(values.imag) > 1e-9 * np.max(np.abs(values.imag))]))
    return found[::2][:count]


def values(omega, m, c, g):
    """Yields (quantity, value, relative uncertainty or None) at one point."""
    for i, value in enumerate(at_rest(m, c, g)):
        yield f"rest_{i + 1}", value, None
    for name, found in (("flap", flap(omega, m, c, g)), ("lag", lag(omega, m, c, g))):
        for i, value in enumerate(found):
            yield f"{name}_{i + 1}", value, rotating.RELATIVE
    if omega:
        B, k = equilibrium(omega, m, c)
        yield "stretch", B * sin(k) - 1, None
        yield "root_force", mpf(S) ** 2 * (B * k - 1), None


POINTS = (("", 4, 1.0, 0.2, 0.3), ("omega_star=0", 0, 1.0, 0.2,
                                   0.3), ("gyration=0;omega_star=10;overhang=0", 10, 1.0, 0.0, 0.0),
          ("body=10;omega_star=2", 2, 10.0, 0.2, 0.3), ("body=0.1;omega_star=8;overhang=-0.5", 8,
                                                        0.1, -0.5, 0.3))


def rows():
    for at, omega, m, c, g in POINTS:
        for quantity, value, relative in values(omega, m, c, g):
            yield ("tip_body", at, quantity, value, "1") + ((relative, ) if relative else ())
