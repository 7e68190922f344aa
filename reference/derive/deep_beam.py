"""Frequencies of a simply supported Timoshenko beam with a square section, fixed axially and in torsion at one end only.

Bending: deflection w sin(kx) and rotation of the section t cos(kx) with the wave number k = n pi/l. With the shear
stiffness s = 5/6 GA, the energies per l/4 are
  strain  EI (k t)^2 + s (k w - t)^2        kinetic  omega^2 rho (A w^2 + I t^2)
Both planes have the same frequencies. Torsion and extension have the frequencies (2n - 1) c/(4 l) with c^2 = GJ/(rho
Ip) or E/rho. J of the square is computed from Saint-Venant's series.
"""
from mpmath import mp, mpf, pi, sqrt

from reference.derive import defaults
from reference.derive.torsion import rectangle_constant

mp.dps = 40
E, RHO, LENGTH, SIDE, SHEAR_FACTOR = mpf("200e9"), mpf(8000), mpf(10), mpf(2), mpf(5) / 6
G, A, I = E / mpf("2.6"), SIDE ** 2, SIDE ** 4 / 12
FREQUENCIES, HALF_WAVES = 9, 12


def bending(n, shear, rotary):
    k = n * pi / LENGTH
    if not shear:
        return [E * I * k ** 4 / (RHO * (A + (I * k ** 2 if rotary else 0)))]
    s = SHEAR_FACTOR * G * A
    if not rotary:  # t = s k/(EI k^2 + s) w
        return [E * I * k ** 4 * s / (E * I * k ** 2 + s) / (RHO * A)]
    # RHO A RHO I x^2 - (s k^2 RHO I + (EI k^2 + s) RHO A) x + s EI k^4 = 0
    a, b, c = RHO * A * RHO * I, s * k ** 2 * RHO * I + (E * I * k ** 2 +
                                                         s) * RHO * A, s * E * I * k ** 4
    root = sqrt(b ** 2 - 4 * a * c)
    return [(b - root) / (2 * a), (b + root) / (2 * a)]


def torsion_constant(exact):
    if not exact:
        return SIDE ** 4 / 6
    return rectangle_constant(SIDE, SIDE)


def frequencies(exact_torsion, shear, rotary):
    found = [
        sqrt(x) / (2 * pi) for n in range(1, HALF_WAVES) for x in bending(n, shear, rotary)
        for _ in "yz"
    ]
    if shear and rotary:  # n = 0: the sections rotate in pure shear
        found += [sqrt(SHEAR_FACTOR * G * A / (RHO * I)) / (2 * pi)] * 2
    twist = sqrt(G * torsion_constant(exact_torsion) / (RHO * 2 * I))
    for n in range(1, HALF_WAVES):
        found += [(2 * n - 1) * speed / (4 * LENGTH) for speed in (twist, sqrt(E / RHO))]
    return sorted(found)[:FREQUENCIES]


def rows():
    for given in ({}, {"torsion": "exact"}, {"shear": 0}, {"shear": 0, "rotary_inertia": 0}):
        at = {**defaults.values("deep_beam"), **given}
        found = frequencies(at["torsion"] == "exact", at["shear"], at["rotary_inertia"])
        for i, value in enumerate(found):
            yield "deep_beam", defaults.differing("deep_beam",
                                                  **given), f"frequency_{i + 1}", value, "Hz"
