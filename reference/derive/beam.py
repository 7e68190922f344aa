"""The geometrically exact (Simo-Reissner) beam with warping: its differential equations, and their spectral integration.

The state is y(s) = (r, q, a, B): the position r of the centroidal axis, the unit quaternion q of the rotation R of the
section, the warping amplitude a and the bimoment B. In fixed axes, F is constant and m(s) = m0 - r x F. In the axes of
the section, N = R^T F, M = R^T m, and the strains g, k (kz0: initial curvature) follow from
  gx = Nx/EA - t kx^2/2, ky = My/EIy - by kx^2/2, kz = Mz/EIz + kz0 + bz kx^2/2,
  Mw = Mx + zs Ny - ys Nz - (GJ + t Nx + by My - bz Mz) kx - 4 c kx^3,
  (gy - zs kx, gz + ys kx, kx - a) = f (Ny, Nz, Mw)   (strains at the shear centre and of warping; f = F/G, zero: rigid),
  r' = R (ex + g), q' = q o (0, k)/2, EIw a' = B, B' = -Mw; for uniform torsion, EIw = 0 and Mw = 0.
p is the distance from the shear centre. The mean t of p^2 is the trapeze term. The constants of the Wagner moments are
bz = int y p^2 dA/Iz and by = int z p^2 dA/Iy; J includes only the terms -2 ys and -2 zs. The constant of the Wagner
torque is c = E int (y^2 + z^2 - Ip/A)^2 dA/8, for ys = zs = 0. These are N Eqs. 46-47 with the sign of u_y corrected,
and the strains of J with Haringx's shear theory.

Each of several intervals is integrated from values at Chebyshev points, Y_j = y_0 + h sum_k W_jk f(Y_k), where W is
exact for the interpolating polynomial. Derivatives are computed by complex steps, which lose no digits.
"""
import numpy as np

STEP = 1e-30


class Beam:
    """Stiffnesses in SI units. `shear` is the 3 x 3 compliance f of (y, z, w), or only fy and fz. EIw = 0 means uniform
    torsion."""

    def __init__(self,
                 length,
                 EA,
                 EIy,
                 EIz,
                 GJ,
                 fy=0.0,
                 fz=0.0,
                 EIw=0.0,
                 t=0.0,
                 c=0.0,
                 curvature=0.0,
                 centre=(0.0, 0.0),
                 shear=None,
                 wagner=(0.0, 0.0)):
        self.length, self.EA, self.EIy, self.EIz, self.GJ = length, EA, EIy, EIz, GJ
        self.f = np.diag([fy, fz, 0.0]) if shear is None else np.array(shear, dtype=float)
        self.EIw, self.t, self.c, self.curvature, self.centre, self.wagner = EIw, t, c, curvature, centre, wagner  # wagner = (by, bz)

    def scaled(self, length, force):
        """Returns the beam in units of a length and a force. Stiffnesses that may be infinite are
        replaced by compliances."""
        moment = force * length
        s = Scaled()
        s.length, s.warps = self.length / length, self.EIw > 0
        dimension = np.array([1.0, 1.0, length])
        s.a, s.f = force / self.EA, self.f * force * np.outer(dimension, dimension)
        s.by, s.bz, s.gj = moment * length / self.EIy, moment * length / self.EIz, self.GJ / (
            moment * length)
        s.iw, s.t, s.c = self.EIw / (moment * length ** 3), self.t / length ** 2, self.c / (
            moment * length ** 3)
        s.curvature, s.centre, s.wagner = self.curvature * length, np.array(
            self.centre) / length, np.array(self.wagner) / length
        return s


class Scaled:
    """Dimensionless beam. Lengths are in units of the length of the network."""
    carries = False  # True for a beam with loads along it, which add states

    @property
    def states(self):
        return 9 if self.warps else 7

    def _twist(self, torque, rigidity, N, a):
        f = self.f[2]
        if not self.warps:
            scale, given = rigidity, torque
            cubic = 4 * self.c
        elif not np.any(f):
            return a
        else:
            scale, given = 1 + f[2] * rigidity, a + f[0] * N[1] + f[1] * N[2] + f[2] * torque
            cubic = 4 * self.c * f[2]
        k = given / scale
        for _ in range(40 if self.c else 0):
            k = k - (scale * k + cubic * k ** 3 - given) / (scale + 3 * cubic * k ** 2)
        return k

    def slope(self, y, p):
        R, F = rotation(y[3:7]), p[:3]
        ys, zs = self.centre
        m = p[3:] - np.cross(y[:3], F, axis=0)
        N, M = np.einsum("ijk,ik->jk", R, F), np.einsum("ijk,ik->jk", R, m)
        torque = M[0] + zs * N[1] - ys * N[2]
        rigidity = self.gj + self.t * N[0] + self.wagner[0] * M[1] - self.wagner[1] * M[2]
        kx = self._twist(torque, rigidity, N, y[7] if self.warps else None)
        Mw = torque - rigidity * kx - 4 * self.c * kx ** 3 if self.warps else 0 * kx
        sheared = [self.f[i, 0] * N[1] + self.f[i, 1] * N[2] + self.f[i, 2] * Mw for i in range(2)]
        g = np.array(
            [1 + self.a * N[0] - self.t * kx * kx / 2, sheared[0] + zs * kx, sheared[1] - ys * kx])
        k = np.array([
            kx, self.by * M[1] - self.wagner[0] * kx * kx / 2,
            self.bz * M[2] + self.curvature + self.wagner[1] * kx * kx / 2
        ])
        out = [
            np.einsum("ijk,jk->ik", R, g),
            product(y[3:7], np.concatenate([np.zeros_like(k[:1]), k])) / 2
        ]
        if self.warps:
            out.append(np.array([y[8] / self.iw, -Mw]))
        return self.length * np.concatenate(out)

    def slope_and_derivatives(self, y, p):
        """Returns the slope f [states, many] and its derivatives df/dy [many, states, states] and df/dp [many, states,
        6]."""
        n, many = y.shape
        columns = n + 6
        z = np.repeat(np.concatenate([y, p]).astype(complex)[:, :, None], columns, axis=2)
        z[np.arange(columns), :, np.arange(columns)] += 1j * STEP
        f = self.slope(z[:n].reshape(n, -1), z[n:].reshape(6, -1)).reshape(n, many, columns)
        d = np.moveaxis(f.imag / STEP, 0, 1)
        return f[:, :, 0].real, d[:, :, :n], d[:, :, n:]

    def at_rest(self, start, q0, s):
        """Returns the states [states, many] of the stress-free beam at s in [0, 1]."""
        angle = self.curvature * self.length * s
        with np.errstate(divide="ignore", invalid="ignore"):
            along = np.where(angle == 0, s * self.length,
                             np.sin(angle) / self.curvature if self.curvature else 0)
            across = 2 * np.sin(angle / 2) ** 2 / self.curvature if self.curvature else 0 * s
        y = np.zeros((self.states, len(s)))
        y[:3] = np.array(start)[:, None] + rotation(q0) @ np.array([along, across, 0 * s])
        y[3:7] = product(
            np.array(q0)[:, None] + 0 * s,
            np.array([np.cos(angle / 2), 0 * s, 0 * s,
                      np.sin(angle / 2)]))
        return y


def rotation(q):
    w, x, y, z = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def product(a, b):
    return np.array([
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] + a[2] * b[0] + a[3] * b[1] - a[1] * b[3],
        a[0] * b[3] + a[3] * b[0] + a[1] * b[2] - a[2] * b[1]
    ])


def quaternion(R):
    trace = R[0, 0] + R[1, 1] + R[2, 2]
    squares = [1 + trace] + [1 + 2 * R[i, i] - trace for i in range(3)]
    skew = [R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]
    largest = int(np.argmax(squares))
    if largest == 0:
        q = np.array([squares[0]] + skew)
    else:
        i = largest - 1
        q = np.array([skew[i]] +
                     [squares[largest] if j == i else R[i, j] + R[j, i] for j in range(3)])
    return q / np.linalg.norm(q)


def exponential(v):
    angle = np.linalg.norm(v)
    return np.concatenate([[np.cos(angle / 2)], np.sinc(angle / (2 * np.pi)) / 2 * np.asarray(v)])


def cross_matrix(v):
    return np.array([[0 * v[0], -v[2], v[1]], [v[2], 0 * v[0], -v[0]], [-v[1], v[0], 0 * v[0]]])


def chebyshev(n):
    """Returns n + 1 Chebyshev points in [0, 1] and W [n + 1, n + 1]. sum_k W_jk f(x_k) is the integral of the interpolant
    from 0 to x_j."""
    from numpy.polynomial import chebyshev as c
    x = -np.cos(np.pi * np.arange(n + 1) / n)
    to_series = np.linalg.inv(c.chebvander(x, n))
    W = np.array([c.chebval(x, c.chebint(series, lbnd=-1)) for series in to_series.T]).T / 2
    return (x + 1) / 2, W
