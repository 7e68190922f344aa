"""The beam of timoshenko.py with its own motion between the nodes, for loads along it: a cubic with the slopes of the
nodes. One element of a slender beam then has the exact displacements of its nodes under a uniform load.
  beamwork solve --scene uniform.yaml --element 'exec:python3 own_loads.py' -f own_loads_py -n 1
"""
import numpy as np

from beamwork_element import cross_matrix, rotation_vector, serve, sinc
from timoshenko import prepare, strain


def line(kind, at, r, _u, R, _a):
    """Returns place[N, 3] and axes[N, 3, 3] of the sections at at[N]. r and R may be complex."""
    s = at[:, None]
    q, slope = s * s * (3 - 2 * s), kind.length * s * (1 - s)
    place = (1 - q) * r[:, 0] + q * r[:, 1] + slope * ((1 - s) * R[:, 0, :, 0] - s * R[:, 1, :, 0])
    psi = s * rotation_vector(R[:, 0].swapaxes(1, 2) @ R[:, 1])
    t, spin = np.sqrt((psi * psi).sum(1))[:, None, None], cross_matrix(psi)
    return place, R[:, 0] @ (np.eye(3) + sinc(t) * spin + sinc(t / 2)**2 / 2 * spin @ spin)


if __name__ == "__main__":
    serve(prepare, strain, line=line, name="own_loads_py", family="example", strains=6,
          summary="two nodes, one integration point, flexible in shear, cubic between the nodes, in Python",
          source="Reissner, J. Appl. Math. Phys. 32 (1981), one point of integration",
          offers=["shear", "geometric", "large rotations", "mass", "rotary inertia"],
          shear_theories=["haringx"], limits=["doubly symmetric"])
