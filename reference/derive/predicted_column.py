"""Half-waves of a beam on fork supports with the strains of printed elements (measures: predicted_beam.py).

The strain energy is that of column.py, with the amplitudes of v_s, w_s, phi and g_y, g_z, g_w. The second-order parts
of the measures do work with a uniform axial force or moment. At the centroid, with v_c' = v_s' + zs phi', w_c' = w_s'
- ys phi', gy_c = g_y + zs phi', gz_c = g_z - ys phi':
  compression P, P/2 times v_c'^2 + w_c'^2 (J Eq. 7), and with Eq. 66
    + (gy_c^2 + gz_c^2)/5 + (Ip/A) (phi'^2 + g_w^2/5) - (ys^2 + zs^2) phi'^2/5
  moment Mz, -M times the second-order part of k_z, with phi_y = gz_c - w_c',
    (phi phi_y' - phi_y phi')/2 + gz_c phi', and with Eq. 66 + gz_c g_w/5
The sheet elements of N have the second-order terms of Eq. 66 if nothing is eccentric and nothing warps.
"""
from mpmath import matrix, mpf, pi, sqrt

from reference.derive.column import _ratios, _square, _strain

HALF_WAVES, NONE = 5, mpf(10) ** -30


def _functionals(s, k, shear):
    """Returns v_c', w_c', gy_c, gz_c, phi', g_w as functions of the amplitudes. If the section is rigid in shear, there
    are only the first three amplitudes."""
    rows = ([k, 0, s.zs * k, 0, 0, 0], [0, k, -s.ys * k, 0, 0, 0], [0, 0, s.zs * k, 1, 0, 0],
            [0, 0, -s.ys * k, 0, 1, 0], [0, 0, k, 0, 0, 0], [0, 0, 0, 0, 0, 1])
    return [[mpf(v) for v in row[:6 if shear else 3]] for row in rows]


def _product(m, factor, a, b):
    for i in range(len(a)):
        for j in range(len(a)):
            m[i, j] += mpf(factor) * (a[i] * b[j] + a[j] * b[i]) / 2


def compression(s, k, shear, eq66):
    v, w, gy, gz, twist, gw = _functionals(s, k, shear)
    m, polar, eccentricity = matrix(len(v), len(v)), s.Ip / s.A, s.ys ** 2 + s.zs ** 2
    for factor, form in [(1, v), (1, w)]:
        _square(m, factor, form)
    fifth = mpf(1) / 5 if eq66 else 0
    for factor, form in [(1, gy), (1, gz), (5 * polar - eccentricity, twist), (polar, gw)]:
        _square(m, factor * fifth, form)
    return m


def moment(s, k, shear, eq66):
    """Returns the prestress matrix of a unit moment Mz. phi phi_y' is a product of sines and has the opposite sign."""
    _, w, _, gz, twist, gw = _functionals(s, k, shear)
    m = matrix(len(w), len(w))
    _product(m, -2, [a - b for a, b in zip(gz, w)], twist)
    _product(m, 2, gz, twist)
    _product(m, mpf(2) / 5 if eq66 else 0, gz, gw)
    return m


def critical(s, length, shear, prestress, eq66):
    """Returns the (largest negative, smallest positive) critical load over the half-waves. A load that does not exist
    is None."""
    found = []
    for n in range(1, HALF_WAVES + 1):
        k = n * pi / length
        ratios = _ratios(_strain(s, k, shear), prestress(s, k, shear, eq66))
        found += [1 / nu for nu in ratios if abs(nu) > NONE]
    negative, positive = [p for p in found if p < 0], [p for p in found if p > 0]
    return max(negative, default=None), min(positive, default=None)


def pinned_square(length, side, young, shear_modulus, eq66):
    """Returns Engesser's P = PE/(1 + PE/GA), where GA - P/5 replaces GA for Eq. 66 and N Eq. 37.

    Both ends of a short element rotate by -gamma relative to its chord. Eq. 66 treats this rotation as bending, which
    adds gamma^2/10 per unit length.
    """
    length, side, young, shear_modulus = (mpf(v) for v in (length, side, young, shear_modulus))
    euler = pi ** 2 * young * side ** 4 / 12 / length ** 2
    GA = mpf(5) / 6 * shear_modulus * side ** 2
    if not eq66:
        return euler / (1 + euler / GA)
    b = GA + euler * 6 / 5  # P (GA - P/5 + PE) = PE (GA - P/5)
    return (b - sqrt(b * b - 4 * euler * GA / 5)) / (mpf(2) / 5)
