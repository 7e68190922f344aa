"""Lateral-torsional buckling of beams on fork supports from their bent state: the linearised Kirchhoff rod about plane
bending.

The plane state is bent by theta about y, with the triad nX = (cos, 0, -sin)(theta), nY = y, nZ = (sin, 0, cos)(theta).
One end is free along x, so the force in a section is vertical: F = -(P/2 - q s) ez, where q = 0 for a force P in the
middle. With N = F . nX,
  x' = (1 + N/EA) cos theta,   EIy theta' = My,   My' = (1 + N/EA) cos theta Fz;
  My(0) = 0, theta(1/2) = 0 (symmetry).
The neighbouring state has the displacement v along y, the rotation increment psi = phi nX + chi nZ, and the moment dm
in fixed axes (m_x, 0, m_z). dF = 0 for dead loads and a mode that is symmetric about the middle. With dm = (dMx - chi
My) nX + (dMz + phi My) nZ,
  v' = (1 + N/EA) chi,   chi' = phi theta' + dMz/EIz,   phi' = kx - chi theta',
  m_x' = -v' Fz,   m_z' = 0,
  dMx = GJ kx (K = 0), else kx = a, EIw a' = B, B' = -(dMx - GJ a).
At the fork, two guides normal to y hold the web, which is along the z axis of the section. Therefore nZ . y = 0 and
phi = 0, and the reaction is a moment along nX. The conditions are v = phi = 0, dm . nZ = 0 and B = 0 at the fork, and
chi = 0, m_x = 0 and a = 0 in the middle. The determinant of these conditions vanishes at the critical load. A fixed
rotation about the fixed x axis, cos(theta) phi + sin(theta) chi = 0, would be a different support.
"""
import functools

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

RELATIVE = 2e-10
EA = 1e6  # axial stiffness, where the weak EI, GJ and the length are 1
THETA, MY, FIRST = 0, 1, 2  # indices of theta, My and the first of the fields v, phi, chi, m_x, m_z, a, B
FIELDS = 7


def _slopes(s, y, P, q, ratio, K):
    theta, My = y[THETA], y[MY]
    c, d, Fz = np.cos(theta), np.sin(theta), -(P / 2 - q * s)
    stretch, bend = 1 - Fz * d / EA, My / ratio
    out = np.empty_like(y)
    out[THETA], out[MY] = bend, stretch * c * Fz
    v, phi, chi, mx, mz, a, B = y[FIRST:].reshape(FIELDS, -1)
    dMx, dMz = c * mx - d * mz + chi * My, d * mx + c * mz - phi * My
    kx = a if K else dMx
    dv = stretch * chi
    zero = 0 * v
    warping = [B * K, a - dMx] if K else [zero, zero]
    out[FIRST:] = np.concatenate([dv, kx - chi * bend, phi * bend + dMz, -dv * Fz, zero] + warping)
    return out


def _start(theta, K):
    """Returns theta, My and the fields of the solutions that satisfy the conditions at the fork: chi = 1, a unit moment
    along nX and, with warping (K > 0), a = 1."""
    count = 3 if K else 2
    fields = np.zeros((FIELDS, count))
    fields[2, 0] = 1
    fields[3, 1], fields[4, 1] = np.cos(theta), -np.sin(theta)
    if K:
        fields[5, 2] = 1
    return np.concatenate([[theta, 0.0], fields.ravel()])


def _middle(theta, P, q, ratio, K, tolerance=1e-13):
    path = solve_ivp(_slopes, (0, 0.5),
                     _start(theta, K),
                     method="DOP853",
                     rtol=tolerance,
                     atol=tolerance * 1e-2,
                     args=(P, q, ratio, K))
    y = path.y[:, -1]
    return y[THETA], y[FIRST:].reshape(FIELDS, -1)


def _rotation_at_fork(P, distributed, ratio, K, near):
    """Returns theta(0) of the plane state, computed by the secant method, starting from a value for another load."""

    def turn(theta):
        return _middle(theta, P, P if distributed else 0.0, ratio, K)[0]

    before, now = near - 1e-3, near
    f_before, f_now = turn(before), turn(now)
    for _ in range(50):
        before, now, f_before = now, now - f_now * (now - before) / (f_now - f_before), f_now
        f_now = turn(now)
        if abs(f_now) <= 1e-13 or now == before:
            return now
    raise ArithmeticError(f"no plane state at load {P}")


def critical_load(distributed, ratio, K, bracket, steps=12):
    """Returns P L^2/sqrt(EI GJ). The determinant must change its sign in the bracket but not below it."""
    slope = (1 / 24 if distributed else 1 / 16) / ratio
    turns = {0.0: 0.0}

    def determinant(P):
        below = max(p for p in turns if p <= P)
        near = turns[below] + slope * (P - below) * np.cos(turns[below])
        turns[P] = _rotation_at_fork(P, distributed, ratio, K, near)
        fields = _middle(turns[P], P, P if distributed else 0.0, ratio, K)[1]
        return np.linalg.det(fields[[2, 3, 5] if K else [2, 3]])

    path = [determinant(P) for P in np.linspace(0, bracket[0], steps + 1)[1:]]
    if min(path) * max(path) <= 0:
        raise ArithmeticError(f"a critical load below {bracket[0]}")
    return brentq(determinant, *bracket, xtol=1e-12 * bracket[1], rtol=1e-13)


CRITICAL = (  # load, ratio, K, bracket
    ("mid", 4, 0, (24, 25)), ("mid", 10, 0, (19, 19.5)), ("mid", 100, 0, (17, 17.3)),
    ("mid", 10, 4, (44, 49)), ("mid_distributed", 10, 0, (30, 34)),
    ("mid_distributed", 10, 6.6, (60, 66)), ("mid_distributed", 2.7, 6.6, (210, 225)))


@functools.lru_cache(maxsize=None)
def row(load, ratio, K, bracket):
    return critical_load(load == "mid_distributed", ratio, K, bracket)


def rows():
    for load, ratio, K, bracket in CRITICAL:
        at = ([f"K={K:g}"]
              if K else []) + [f"load={load}", "prebuckling=included", f"ratio={ratio:g}"]
        value = row(load, ratio, K, bracket)
        yield "lateral_buckling", ";".join(at), "load_factor", value, "1", RELATIVE
