"""A rigid body that tumbles without forces, with J = diag(1, 2, 3) kg m^2, body rates (0.5, 0.2, 2) rad/s and R = 1 at t
= 0.

Rates: the energy T and the angular momentum L satisfy L^2 > 2 T J2, so
  w1 = a1 cn, w2 = a2 sn, w3 = a3 dn of p t + u0, parameter m,
where a_i and p are functions of T and L (E.T. Whittaker, Analytical Dynamics, 1904, chapter 6). Orientation: with z
along L, Euler's angles z x z satisfy sin(theta) (sin(psi), cos(psi)) = (J1 w1, J2 w2)/L and cos(theta) = J3 w3/L. The
precession is the integral of
  phi' = L (J1 w1^2 + J2 w2^2)/(J1^2 w1^2 + J2^2 w2^2).
For comparison, test/motion_test.py integrates the equations of motion. Values are rounded to eight decimals, far below
the error required of any integrator.
"""
from mpmath import atan2, cos, ellipf, ellipfun, matrix, mp, mpf, quad, sin, sqrt

mp.dps = 30
J = (mpf(1), mpf(2), mpf(3))
START = (mpf("0.5"), mpf("0.2"), mpf(2))
TIMES = ("0", "1", "2", "5", "10")
ROUNDED = 5e-9
AXES = "xyz"
ANY = "integrator=*;step=*;tolerance=*"

TWICE_ENERGY = sum(j * w**2 for j, w in zip(J, START))
SQUARE = sum((j * w)**2 for j, w in zip(J, START))


def _constants():
    a1 = sqrt((SQUARE - TWICE_ENERGY * J[2]) / (J[0] * (J[0] - J[2])))
    a2 = sqrt((SQUARE - TWICE_ENERGY * J[2]) / (J[1] * (J[1] - J[2])))
    a3 = sqrt((SQUARE - TWICE_ENERGY * J[0]) / (J[2] * (J[2] - J[0])))
    p = sqrt((J[2] - J[1]) * (SQUARE - TWICE_ENERGY * J[0]) / (J[0] * J[1] * J[2]))
    m = ((J[1] - J[0]) * (TWICE_ENERGY * J[2] - SQUARE)) / ((J[2] - J[1]) *
                                                            (SQUARE - TWICE_ENERGY * J[0]))
    return (a1, a2, a3), p, m


def rates(t):
    (a1, a2, a3), p, m = _constants()
    # w2 increases while w1 and w3 are positive, because J2 w2' = (J3 - J1) w3 w1 > 0, and so does sn u
    u = p * t + ellipf(atan2(START[1] / a2, START[0] / a1), m)
    return (a1 * ellipfun("cn", u, m=m), a2 * ellipfun("sn", u, m=m), a3 * ellipfun("dn", u, m=m))


def _about(axis, angle):
    i, j = (axis + 1) % 3, (axis + 2) % 3
    R = mp.eye(3)
    R[i, i] = R[j, j] = cos(angle)
    R[j, i], R[i, j] = sin(angle), -sin(angle)
    return R


def _against_momentum(t):
    w = rates(t)
    L = sqrt(SQUARE)
    theta = mp.acos(J[2] * w[2] / L)
    phi = quad(_precession, [mpf(k) * t / 20 for k in range(21)]) if t else mpf(0)
    return _about(2, phi) * _about(0, theta) * _about(2, atan2(J[0] * w[0], J[1] * w[1]))


def _precession(t):
    w = rates(t)
    return sqrt(SQUARE) * (J[0] * w[0]**2 + J[1] * w[1]**2) / ((J[0] * w[0])**2 +
                                                               (J[1] * w[1])**2)


def orientation(t):
    return matrix(_against_momentum(mpf(0))).T * _against_momentum(mpf(t))


def _row(at, name, value, unit):
    value = value if abs(value) > ROUNDED / 10 else 0
    return "rigid_body", at, name, value, unit, ROUNDED / (abs(value) or 1)


def rows():
    for time in TIMES:
        at = f"time={time};{ANY}"
        for axis, value in zip(AXES, rates(mpf(time))):
            yield _row(at, f"w_{axis}", value, "rad/s")
        R = orientation(mpf(time))
        for i in range(3):
            for k in range(3):
                yield _row(at, f"R_{AXES[i]}{AXES[k]}", R[i, k], "1")
    yield _row(f"time=*;{ANY}", "energy", TWICE_ENERGY / 2, "J")
