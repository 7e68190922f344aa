"""The geometrically exact (Simo-Reissner) beam with warping, by shooting: an independent solution of the continuum.

State y(s) = (r, q, kx, B), s in [0, 1] times the length; F constant, m(s) = m0 - r x F in fixed axes; N = R^T F, M = R^T m;
  gx = Nx/EA - t kx^2/2, gy = Ny/GAy, gz = Nz/GAz, ky = My/EIy + ky0, kz = Mz/EIz + kz0,
  r' = R (ex + g), q' = q o (0, k)/2, EIw kx' = B, B' = (GJ + t Nx) kx + 4 c kx^3 - Mx   (warping restrained)
  or Mx = (GJ + t Nx) kx + 4 c kx^3                                                    (uniform torsion, EIw = 0).
t = Ip/A (trapeze term), c = E int (y^2 + z^2 - Ip/A)^2 dA/8 (Wagner torque); N Eqs. 46-47 with the sign of u_y corrected.
Everything is made dimensionless with the length and EIz, integrated by an eighth-order Runge-Kutta method, and linearised
by complex steps, so that derivatives cost no digits.
"""
import numpy as np
from scipy.integrate import solve_ivp

TOLERANCE = 3e-14


class Beam:
    """Stiffnesses in SI; shear compliances may be zero (rigid)."""

    def __init__(self, length, EA, EIy, EIz, GJ, fy=0.0, fz=0.0, EIw=0.0, t=0.0, c=0.0, curvature=0.0):
        self.length, self.force = length, EIz / length ** 2
        unit = EIz
        self.a = unit / (EA * length ** 2)      # compliances, dimensionless
        self.fy, self.fz = fy * unit / length ** 2, fz * unit / length ** 2
        self.by, self.bz, self.gj = unit / EIy, 1.0, GJ / unit
        self.iw, self.t, self.c = EIw / (unit * length ** 2), t / length ** 2, c / (unit * length ** 2)
        self.curvature = curvature * length
        self.warps = EIw > 0

    def _rotation(self, q):
        w, x, y, z = q
        return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                         [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                         [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])

    def _twist(self, Mx, Nx):
        """kx of uniform torsion."""
        k = Mx / (self.gj + self.t * Nx)
        for _ in range(60 if self.c else 0):
            step = ((self.gj + self.t * Nx) * k + 4 * self.c * k ** 3 - Mx) / (self.gj + self.t * Nx + 12 * self.c * k ** 2)
            k = k - step
            if abs(step) <= 1e-17 * (1 + abs(k)):
                break
        return k

    def _slope(self, y, F, m0):
        r, q = y[:3], y[3:7]
        R = self._rotation(q)
        m = m0 - np.cross(r, F)
        N, M = R.T @ F, R.T @ m
        kx = y[7] if self.warps else self._twist(M[0], N[0])
        g = np.array([1 + self.a * N[0] - self.t * kx * kx / 2, self.fy * N[1], self.fz * N[2]])
        k = np.array([kx, self.by * M[1], self.bz * M[2] + self.curvature])
        w, x, yy, z = q
        dq = np.array([-x * k[0] - yy * k[1] - z * k[2], w * k[0] + yy * k[2] - z * k[1],
                       w * k[1] + z * k[0] - x * k[2], w * k[2] + x * k[1] - yy * k[0]]) / 2
        tail = [y[8] / self.iw, (self.gj + self.t * N[0]) * kx + 4 * self.c * kx ** 3 - M[0]] if self.warps else []
        return np.concatenate([R @ g, dq, tail])

    def tip(self, p, start=None):
        """p = (F, m0[, B0]), dimensionless -> (r, R, m at the tip, kx and B there)."""
        F, m0 = p[:3], p[3:6]
        y0 = np.zeros(9 if self.warps else 7, dtype=complex)
        y0[3] = 1
        if self.warps:
            y0[8] = p[6]
        s = solve_ivp(lambda _, y: self._slope(y, F, m0), (0.0, 1.0), y0, method="DOP853", rtol=TOLERANCE, atol=1e-16)
        y = s.y[:, -1]
        return y[:3], self._rotation(y[3:7]), m0 - np.cross(y[:3], F), (y[7:9] if self.warps else np.zeros(2))

    def solve(self, residual, p, path=(1.0,)):
        """Newton on residual(level, p, tip(p)) = 0 for each level of the path in turn."""
        for level in path:
            for _ in range(40):
                value = np.array(residual(level, p, self.tip(p.astype(complex)))).real
                jacobian = self.derivative(lambda z: residual(level, z, self.tip(z)), p)
                step = np.linalg.solve(jacobian, value)
                p = p - step
                if np.max(np.abs(step)) <= 1e-13 * (1 + np.max(np.abs(p))):
                    break
            else:
                raise ArithmeticError("the shooting method did not converge")
        return p

    def derivative(self, f, p):
        columns = []
        for i in range(len(p)):
            z = p.astype(complex)
            z[i] += 1e-30j
            columns.append(np.array(f(z)).imag / 1e-30)
        return np.array(columns).T


def rotation_vector(R):
    """Of a real rotation below pi, also for small complex parts."""
    axis = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    sine = np.sqrt((axis * axis).sum() + 0j)
    cosine = (R[0, 0] + R[1, 1] + R[2, 2] - 1) / 2
    angle = np.arctan2(sine.real, cosine.real)
    if abs(sine) < 1e-8:
        return axis
    return axis * angle / sine.real if np.all(axis.imag == 0) else axis * (angle + 1j * (sine.imag * cosine.real - sine.real * cosine.imag)) / sine


def spatial_spin(R, R0):
    """theta of dR R0^T = theta~ from the imaginary part of R."""
    W = R.imag @ R0.real.T
    return np.array([W[2, 1] - W[1, 2], W[0, 2] - W[2, 0], W[1, 0] - W[0, 1]]) / 2
