"""Frequencies of a free circular ring of radius 1 with EI = 1 in both planes, EA = 1e4 and mass 1 per length, rigid in shear.

A mode of n waves is a product of amplitudes with cos(n t) or sin(n t), where t is the angle.
In the plane: displacements u outwards and v along the ring, rotation v + n u, strain n v + u. The energies are
  strain  EA (n v + u)^2 + EI n^2 (v + n u)^2        kinetic  omega^2 (u^2 + v^2 + j (v + n u)^2)
Out of the plane: displacement w, twist p, rotation n w. Curvature p + n^2 w, torsion n (p + w). The energies are
  strain  EI (p + n^2 w)^2 + GJ n^2 (p + w)^2        kinetic  omega^2 (w^2 + 2 i p^2 + j n^2 w^2)
with i = 1e-4, and j = i with rotary inertia, else 0. For EA = infinity and i = 0, the lower frequencies are those of A. E.
H. Love, A Treatise on the Mathematical Theory of Elasticity, section 293: omega^2 = n^2 (n^2 - 1)^2/(n^2 + 1), and n^2 (n^2 -
1)^2/(n^2 + EI/GJ) out of the plane.
"""
from mpmath import mp, mpf, sqrt

from reference.derive import defaults

mp.dps = 40
AXIAL, POLAR = mpf(10) ** 4, mpf(2) / 10 ** 4


def lower(K, M):
    """Returns the lower circular frequency of [a, b; b, c] matrices, given as (a, b, c)."""
    twos = M[0] * M[2] - M[1] ** 2
    ones = K[0] * M[2] + K[2] * M[0] - 2 * K[1] * M[1]
    none = K[0] * K[2] - K[1] ** 2
    return sqrt(2 * none / (ones + sqrt(ones ** 2 - 4 * twos * none)))


def in_plane(n, rotary, axial=AXIAL):
    n, i = mpf(n), rotary * POLAR / 2
    return lower((axial + n ** 4, n * axial + n ** 3, axial * n ** 2 + n ** 2),
                 (1 + i * n ** 2, i * n, 1 + i))


def out_of_plane(n, rotary, torsion, polar=POLAR):
    n, torsion = mpf(n), mpf(torsion)
    return lower((n ** 4 + torsion * n ** 2, n ** 2 * (1 + torsion), 1 + torsion * n ** 2),
                 (1 + rotary * polar / 2 * n ** 2, 0, polar))


def values(torsion, rotary):
    """Yields (quantity, value, unit)."""
    for n in (2, 3, 4):
        yield f"out_{n}", out_of_plane(n, rotary, torsion), "1"
        yield f"in_{n}", in_plane(n, rotary), "1"


def rows():
    for given in ({}, {"torsion": 0.1}, {"torsion": 0.5}, {"rotary_inertia": 1}):
        at = {**defaults.values("free_ring"), **given}
        for row in values(at["torsion"], at["rotary_inertia"]):
            yield ("free_ring", defaults.differing("free_ring", **given), *row)
