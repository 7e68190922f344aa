"""A shear-deformable beam with two nodes. The strains [m] are uniform along the element:
  d = Rm^T (rq - rp) - (l, 0, 0), where Rm is halfway from Rp to Rq, and l log(Rp^T Rq).
The physics is that of timoshenko.c in the same folder.
  beamwork converge tapered_cantilever --element 'exec:python3 timoshenko.py' -f all
"""
import numpy as np

from beamwork_element import rotation_vector, serve, sinc


def prepare(kind):
    """Returns the stiffness C [N/m] of the element, where sigma = C e."""
    c, l = kind.section, kind.length
    # transverse flexibility: shear if requested, and the bending that a uniform curvature does not represent
    shear = l / c.shear_modulus if "shear" in kind.features else 0
    across_y = shear * c.F[0] + l**3 / (12 * c.young * c.Iz)
    across_z = shear * c.F[4] + l**3 / (12 * c.young * c.Iy)
    return np.diag([c.young * c.A / l, 1 / across_y, 1 / across_z, c.shear_modulus * c.It / l**3,
                    c.young * c.Iy / l**3, c.young * c.Iz / l**3])


def strain(kind, r, _u, R, _a):
    """Returns e[N, 6] for r[N, 2, 3] and R[N, 2, 3, 3], which may be complex."""
    chord = (r[:, 1] - r[:, 0])[:, None, None, :] @ R  # chord in the axes of each node
    psi = rotation_vector(R[:, 0].swapaxes(1, 2) @ R[:, 1])
    # Normal to psi, the mean of both chords is the chord in the middle axes, shortened by the factor c. Along psi, all
    # three chords are equal.
    angle = np.sqrt((psi * psi).sum(1))[:, None]
    c, along = np.cos(angle / 2), (psi * chord[:, 0, 0]).sum(1)[:, None]
    e = (chord[:, 0, 0] + chord[:, 1, 0]) / (2 * c) - sinc(angle / 4)**2 / (8 * c) * along * psi
    return np.hstack([e - [kind.length, 0, 0], kind.length * psi])


if __name__ == "__main__":
    serve(prepare, strain, name="timoshenko_py", family="example", strains=6,
          summary="two nodes, one integration point, flexible in shear, no warping, in Python",
          source="Reissner, J. Appl. Math. Phys. 32 (1981), one point of integration",
          offers=["shear", "geometric", "large rotations", "mass", "rotary inertia"],
          shear_theories=["haringx"], limits=["doubly symmetric"])
