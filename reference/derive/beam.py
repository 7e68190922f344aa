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

    @staticmethod
    def _rotation(q):
        """Rotation matrices [3, 3, ...] of quaternions [4, ...]."""
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
            if np.max(np.abs(step)) <= 1e-17:
                break
        return k

    def _slope(self, y, F, m0):
        """Columns of y [7 or 9, many] are independent beams."""
        r, q = y[:3], y[3:7]
        R = self._rotation(q)
        m = m0 - np.cross(r, F, axis=0)
        N, M = np.einsum("ijk,ik->jk", R, F), np.einsum("ijk,ik->jk", R, m)
        kx = y[7] if self.warps else self._twist(M[0], N[0])
        g = np.array([1 + self.a * N[0] - self.t * kx * kx / 2, self.fy * N[1], self.fz * N[2]])
        ky, kz = self.by * M[1], self.bz * M[2] + self.curvature
        w, x, v, z = q
        dq = np.array([-x * kx - v * ky - z * kz, w * kx + v * kz - z * ky, w * ky + z * kx - x * kz, w * kz + x * ky - v * kx]) / 2
        out = [np.einsum("ijk,jk->ik", R, g), dq]
        if self.warps:
            out.append(np.array([y[8] / self.iw, (self.gj + self.t * N[0]) * kx + 4 * self.c * kx ** 3 - M[0]]))
        return np.concatenate(out)

    def tips(self, p, tolerance=TOLERANCE):
        """p [6 or 7, many] = (F, m0[, B0]), dimensionless -> list of (r, R, m at the tip, (kx, B) there)."""
        many = p.shape[1]
        F, m0 = p[:3], p[3:6]
        y0 = np.zeros((9 if self.warps else 7, many), dtype=complex)
        y0[3] = 1
        if self.warps:
            y0[8] = p[6]
        shape = y0.shape
        s = solve_ivp(lambda _, y: self._slope(y.reshape(shape), F, m0).ravel(), (0.0, 1.0), y0.ravel(), method="DOP853", rtol=tolerance, atol=tolerance / 100)
        y = s.y[:, -1].reshape(shape)
        R, m = self._rotation(y[3:7]), m0 - np.cross(y[:3], F, axis=0)
        return [(y[:3, k], R[:, :, k], m[:, k], y[7:9, k] if self.warps else np.zeros(2)) for k in range(many)]

    def tip(self, p):
        return self.tips(p.astype(complex).reshape(-1, 1))[0]

    def linearised(self, f, p, tolerance=TOLERANCE):
        """f(p, tip) and its derivative by complex steps, all columns integrated together."""
        n = len(p)
        z = np.tile(p.astype(complex)[:, None], (1, n))
        z[np.arange(n), np.arange(n)] += 1e-30j
        values = np.array([f(z[:, k], tip) for k, tip in enumerate(self.tips(z, tolerance))])
        return values[0].real, values.imag.T / 1e-30

    def solve(self, residual, p, path=(1.0,)):
        """Newton on residual(level, p, tip(p)) = 0 for each level of the path in turn."""
        for level in path:
            last = level == path[-1]
            for _ in range(40):
                value, jacobian = self.linearised(lambda z, tip: np.array(residual(level, z, tip)), p, TOLERANCE if last else 1e-8)
                step = np.linalg.solve(jacobian, value)
                p = p - step
                if np.max(np.abs(step)) <= (1e-12 if last else 1e-5) * (1 + np.max(np.abs(p))):
                    break
            else:
                raise ArithmeticError("the shooting method did not converge")
        return p


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
