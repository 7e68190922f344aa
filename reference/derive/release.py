"""Linear vibration of a cantilever that is deflected by a force at its tip and released. The value is the ratio of the
tip deflection to that at t = 0.

For the Euler-Bernoulli beam with L = EI = rho A = 1, the ratio is 12 sum cos(l_n^2 t)/l_n^4, where 1 + cos(l) cosh(l)
= 0.

Without a body, the response of this beam to a force is N/(l^3 D) with N = sin(l) cosh(l) - cos(l) sinh(l) and D = 1 +
cos(l) cosh(l). With a body of mu times the mass of the beam at the tip, the response is
  H = N/(l^3 D - mu l^4 N) at omega = l^2, with poles and residues as below.

For the Timoshenko beam with rotary inertia, y = (w, p, Q, M), Q = k G A (w' - p), M = E I p' and
  y' = A(omega^2) y:  Q' = -rho A omega^2 w,  M' = -Q - rho I omega^2 p;  w = p = 0 at the root, Q = M = 0 at the tip.
The response of the tip to a force of frequency omega, H = w(L)/F, is computed from exp(A L). The poles of H are the
modes. The residues r_n give the share of each mode in the response to a constant force, r_n/(omega_n^2 H(0)). The sum
of all shares is one, so the share of the modes beyond the last one is the uncertainty.
"""
import numpy as np
from mpmath import cos, cosh, diff, findroot, mp, mpf, pi, sin, sinh, tan, tanh
from scipy.linalg import expm
from scipy.optimize import brentq

mp.dps = 30
ANY = "integrator=*;step=*;tolerance=*"
STATIC = 1e-9  # relative uncertainty of linear theory; the deflection is 1e-5 of the length
BERNOULLI_TIMES = ("0.25", "0.5", "1", "1.5", "1.75", "2", "5", "10")
TIMOSHENKO_TIMES = ("0.001", "0.002", "0.005", "0.01", "0.02")
JUDGED, JUDGED_AT = "0.001", "model=timoshenko;step=1e-5;time=0.001"
MODES, FREQUENCIES = 400, 3
ROUNDED = 5e-9

YOUNG, POISSON, DENSITY, WIDTH, HEIGHT = 200e9, 0.3, 7800.0, 0.05, 0.1
AREA, INERTIA = WIDTH * HEIGHT, WIDTH * HEIGHT**3 / 12
EI, GA = YOUNG * INERTIA, 5 / 6 * YOUNG / (2 * (1 + POISSON)) * AREA


def bernoulli_modes(count=MODES):
    """Returns the roots l of 1 + cos(l) cosh(l), whose squares are the angular frequencies."""
    guesses = [mpf("1.875"), *((n + mpf(1) / 2) * pi for n in range(1, count))]
    return [findroot(lambda x: cos(x) + 1 / cosh(x), guess) for guess in guesses]


def bernoulli(t, modes):
    return 12 * sum(cos(x**2 * mpf(t)) / x**4 for x in modes)


def with_body_modes(body, count):
    """Returns (root l, share of the initial deflection) of the first modes. Each root lies between a root of the beam
    with a fixed tip and a root of the beam without a body."""

    def both(x):
        return sin(x) * cosh(x) - cos(x) * sinh(x), 1 + cos(x) * cosh(x)

    def pole(x):
        N, D = both(x)
        return (D - body * x * N) / (1 + body) / cosh(x)

    free = bernoulli_modes(count)
    held = [mpf(0), *(findroot(lambda x: tan(x) - tanh(x), (n + mpf(1) / 4) * pi)
                      for n in range(1, count))]
    found = []
    for low, high in zip(held, free):
        x = findroot(pole, (low, high), solver="bisect", maxsteps=400, tol=mpf(10)**-30)
        slope = diff(lambda q: q**(mpf(3) / 4) * both(q**(mpf(1) / 4))[1] -
                     body * q * both(q**(mpf(1) / 4))[0], x**4)
        found.append((x, -3 * both(x)[0] / slope / x**4))
    return found


def with_body(t, modes):
    return sum(share * cos(x**2 * mpf(t)) for x, share in modes)


def _system(square):
    return np.array([[0, 1, 1 / GA, 0], [0, 0, 0, 1 / EI], [-DENSITY * AREA * square, 0, 0, 0],
                     [0, -DENSITY * INERTIA * square, -1, 0]])


def _transfer(square):
    """Returns exp(A L) and its derivative with respect to omega^2, with equal scales of the values at both ends."""
    A, dA = _system(square), _system(1.0) - _system(0.0)
    scale = np.array([1, 1, EI, EI])
    both = np.block([[A, dA], [np.zeros((4, 4)), A]])
    double = np.concatenate([scale, scale])
    T = expm(both / double[:, None] * double[None, :])
    return T[:4, :4], T[:4, 4:]


def _determinant(omega):
    T, _ = _transfer(omega**2)
    return T[2, 2] * T[3, 3] - T[2, 3] * T[3, 2]


def _answer(square):
    """Returns the numerator and the determinant of H, multiplied by EI, and the derivative of the determinant with
    respect to omega^2."""
    T, dT = _transfer(square)
    numerator = T[0, 2] * T[3, 3] - T[0, 3] * T[3, 2]
    slope = (dT[2, 2] * T[3, 3] + T[2, 2] * dT[3, 3] - dT[2, 3] * T[3, 2] - T[2, 3] * dT[3, 2])
    return numerator, T[2, 2] * T[3, 3] - T[2, 3] * T[3, 2], slope


def flexibility():
    return 1 / (3 * EI) + 1 / GA


def timoshenko_modes(count=MODES):
    """Returns (angular frequency [rad/s], share of the initial deflection) of the first modes."""
    found, omega, step = [], 1.0, 40.0
    last = _determinant(omega)
    while len(found) < count:
        there = _determinant(omega + step)
        if last * there < 0:
            found.append(brentq(_determinant, omega, omega + step, xtol=1e-9, rtol=1e-15))
        omega, last = omega + step, there
    shares = []
    for value in found:
        numerator, _, slope = _answer(value**2)
        shares.append(-numerator / slope / EI / value**2 / flexibility())
    return np.array(found), np.array(shares)


def timoshenko(t, modes):
    omega, share = modes
    return float(share @ np.cos(omega * t))


def _row(at, name, value, unit, uncertainty):
    return "release", at, name, value, unit, uncertainty / abs(float(value))


def rows():
    modes = bernoulli_modes()
    for t in BERNOULLI_TIMES:
        yield _row(f"time={t};{ANY}", "tip", bernoulli(t, modes), "1", ROUNDED)
    at = f"time=*;{ANY}"
    for i, x in enumerate(modes[:FREQUENCIES]):
        yield "release", at, f"frequency_{i + 1}", x**2 / (2 * pi), "Hz"
    yield "release", at, "flexibility", mpf(1) / 3, "m/N", STATIC
    modes = timoshenko_modes()
    rest = abs(1 - float(np.sum(modes[1])))
    for t in TIMOSHENKO_TIMES:
        at = f"model=timoshenko;time={t};{ANY}" if t != JUDGED else JUDGED_AT
        yield _row(at, "tip", timoshenko(float(t), modes), "1", rest)
    at = f"model=timoshenko;time=*;{ANY}"
    for i, omega in enumerate(modes[0][:FREQUENCIES]):
        yield "release", at, f"frequency_{i + 1}", omega / (2 * np.pi), "Hz", 1e-10
    yield "release", at, "flexibility", flexibility(), "m/N", STATIC
