"""Flexural-torsional buckling of an equal angle on fork supports. The angle is rigid in shear. Each half-wave k = n pi/l
is a 3 x 3 problem.

The unknowns are the amplitudes of v_s, w_s (shear centre) and phi, which are multiplied by sin kx. The stress is -P/A
- P y_a y/Iz - P z_a z/Iy for an axial force P at (y_a, z_a), or -M z/Iy for end moments M. The stress does work on the
slopes v' = v_s' - (z - zs) phi', w' = w_s' + (y - ys) phi' of the fibres (Vlasov, Thin-walled Elastic Beams, 1961,
chapter V). The section is that of code_aster V3.01.103.
"""
from mpmath import eigsy, matrix, mp, mpf, pi, sqrt

from reference.derive import defaults

mp.dps = 40
E, L = mpf("2.1e11"), mpf("1.2")
G = E / mpf("2.6")
A, IY, IZ, IT, IW = mpf("1856e-6"), mpf("4167339e-12"), mpf("1045547e-12"), mpf("39595e-12"), mpf(
    "44398819e-18")
YS, WAGNER_Y = mpf("41.012e-3"), mpf(
    "-84948392e-15")  # y is an axis of symmetry, so zs = 0 and int z (y^2 + z^2) dA = 0
POINTS = {"centroid": (0, 0), "shear_centre": (YS, 0), "leg": (0, YS)}
HALF_WAVES, LOADS = 12, 3


def stiffness(k, warping):
    return [E * IZ * k ** 4, E * IY * k ** 4, (E * IW * k ** 4 if warping else 0) + G * IT * k ** 2]


def work(k, force, y, z, polar):
    """Returns the matrix [3, 3] of the work of stresses in the half-wave k. The stresses have the resultant `force`, the
    first moments y and z, and the second moment `polar` about the centroid."""
    m = matrix(3, 3)
    m[0, 0] = m[1, 1] = force
    m[0, 2] = m[2, 0] = -z
    m[1, 2] = m[2, 1] = y - force * YS
    m[2, 2] = polar - 2 * YS * y + force * YS ** 2
    return k ** 2 * m


def factors(k, warping, stress):
    """Returns the positive critical factors on `stress` for the half-wave k."""
    roots = [sqrt(s) for s in stiffness(k, warping)]
    b = work(k, *stress)
    scaled = matrix(3, 3)
    for i in range(3):
        for j in range(3):
            scaled[i, j] = b[i, j] / roots[i] / roots[j]
    return [1 / v for v in eigsy(scaled, eigvals_only=True) if v > mpf(10) ** -30]


def stress_of(load):
    if load == "moment":
        return mpf(0), mpf(0), mpf(1), mpf(0)
    y, z = POINTS[load]
    return mpf(1), mpf(y), mpf(z), (IY + IZ) / A + y * WAGNER_Y / IZ


def least_factors(warping, stress):
    """Returns the LOADS smallest positive factors over all half-waves."""
    return sorted(
        v for n in range(1, HALF_WAVES + 1) for v in factors(n * pi / L, warping, stress))[:LOADS]


def rows():
    for load in ("centroid", "shear_centre", "leg", "moment"):
        for warping in (1, 0):
            at = defaults.differing("angle_column", load=load, warping=warping)
            name, unit = ("critical_moment", "N m") if load == "moment" else ("critical_load", "N")
            for i, value in enumerate(least_factors(warping, stress_of(load))):
                yield "angle_column", at, f"{name}_{i + 1}", value, unit
