"""The beam of timoshenko.py made of a viscous (Kelvin-Voigt) material: stresses are C (e + eta e'), with a
separate eta for torsion.
  beamwork solve --scene swing.yaml --element 'exec:python3 own_damping.py' -f own_damping_py -n 8
"""
import numpy as np

from beamwork_element import serve
from timoshenko import prepare, strain


def damping(kind):
    """Returns V[6, 6], the stresses per strain rate. C is diagonal."""
    eta = np.full(6, kind.options["eta"])
    eta[3] = kind.options["eta_torsion"]
    return prepare(kind) * eta


OPTION = {"default": 1e-4, "min": 0, "max": 10, "unit": "s"}

if __name__ == "__main__":
    serve(prepare, strain, damping=damping, name="own_damping_py", family="example", strains=6,
          options=[{"name": "eta", "summary": "retardation time of elongation, bending and shear", **OPTION},
                   {"name": "eta_torsion", "summary": "retardation time of torsion", **OPTION}],
          summary="two nodes, one integration point, flexible in shear, viscous material, in Python",
          source="Reissner, J. Appl. Math. Phys. 32 (1981), one point of integration",
          offers=["shear", "geometric", "large rotations", "mass", "rotary inertia"],
          shear_theories=["haringx"], limits=["doubly symmetric"])
