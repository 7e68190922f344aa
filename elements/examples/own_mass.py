"""The beam of timoshenko.py with a user-defined mass. Velocities are linear along the element. Half of the rotary inertia
is at each node.
  beamwork solve deep_beam --element 'exec:python3 own_mass.py' -f own_mass_py -n 8
"""
import numpy as np

from beamwork_element import serve
from timoshenko import prepare, strain


def mass(kind, r, _u, R, _a):
    """Returns M[N, 14, 14] for r[N, 2, 3] and R[N, 2, 3, 3], which may be complex."""
    c, l = kind.section, kind.length
    M = np.zeros((len(r), 2, 7, 2, 7), R.dtype)
    line = np.einsum("pq,ij->piqj", [[2, 1], [1, 2]], np.eye(3))
    M[:, :, :3, :, :3] = c.density * c.A * l / 6 * line
    about = [c.Ip, c.Iy, c.Iz] if "rotary inertia" in kind.features else [c.Ip, 0, 0]
    for p in 0, 1:
        M[:, p, 3:6, p, 3:6] = c.density * l / 2 * R[:, p] * about @ R[:, p].swapaxes(1, 2)
    return M.reshape(-1, 14, 14)


if __name__ == "__main__":
    serve(prepare, strain, mass=mass, name="own_mass_py", family="example", strains=6,
          summary="two nodes, one integration point, flexible in shear, own mass matrix, in Python",
          source="Reissner, J. Appl. Math. Phys. 32 (1981), one point of integration",
          offers=["shear", "geometric", "large rotations", "mass", "rotary inertia"],
          shear_theories=["haringx"], limits=["doubly symmetric"])
