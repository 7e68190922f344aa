"""The sheet flexure with prescribed tip motion: reactions and the compliance matrix with spatial moments, by shooting.

The tip's six loads and the warping condition are functions of the seven unknowns at the root, and so is its motion:
C = d(motion)/d(unknowns) [d(loads)/d(unknowns)]^-1, which is the compliance with dead forces and dead moments about fixed axes.
"""
import math

import numpy as np

from reference.derive.beam import Beam, spatial_spin

RELATIVE = 1e-9
RESPONSE, LOAD = ("ux", "uy", "uz", "thx", "thy", "thz"), ("Fx", "Fy", "Fz", "Mx", "My", "Mz")
PLANAR = [(0, 0), (0, 1), (0, 5), (1, 0), (1, 1), (1, 5), (5, 0), (5, 1), (5, 5),
          (2, 2), (2, 3), (2, 4), (3, 2), (3, 3), (3, 4), (4, 2), (4, 3), (4, 4)]


def rectangle_torsion(w, t):
    """Saint-Venant constant, w >= t."""
    total = sum(math.tanh(n * math.pi * w / (2 * t)) / n ** 5 for n in range(1, 400, 2))
    return w * t ** 3 / 3 * (1 - 192 * t / (math.pi ** 5 * w) * total)


def sheet(length=0.1, width=0.1, thickness=0.00225, young=200e9, poisson=0.3, warping=1, shear=1, trapeze=1, wagner=0, shear_factor=0.0, **_):
    G, w, t = young / (2 * (1 + poisson)), width, thickness
    k = shear_factor or 10 * (1 + poisson) / (12 + 11 * poisson)
    f = 1 / (k * G * w * t) if shear else 0.0
    return Beam(length, EA=young * w * t, EIy=young * t * w ** 3 / 12, EIz=young * w * t ** 3 / 12, GJ=G * rectangle_torsion(w, t), fy=f, fz=f,
                EIw=young * (w * t) ** 3 / 144 if warping else 0.0, t=(w * w + t * t) / 12 if trapeze else 0.0, c=young * w ** 5 * t / 1440 if wagner else 0.0)


def warp_residual(beam, tip, tip_warping):
    return [] if not beam.warps else [tip[3][1] if tip_warping else tip[3][0]]


def compliance(beam, p, tip_warping):
    here = beam.tip(p)

    def motion_and_loads(z, tip):
        r, R, m, _ = tip
        return np.concatenate([r, 1j * spatial_spin(R, here[1]), z[:3], m, np.array(warp_residual(beam, tip, tip_warping), dtype=complex)])
    _, slope = beam.linearised(motion_and_loads, p)
    C = (slope[:6] @ np.linalg.inv(slope[6:]))[:, :6]
    L, force = beam.length, beam.force
    scale_out = np.array([L, L, L, 1, 1, 1])
    scale_in = np.array([force] * 3 + [force * L] * 3)
    return C * scale_out[:, None] / scale_in[None, :], here


def unit_of(i, j):
    return ("m/N" if j < 3 else "1/N") if i < 3 else ("rad/N" if j < 3 else "rad/(N m)")


def parameters(given):
    return ";".join(f"{k}={v}" for k, v in given.items())


def cantilever(**given):
    beam, deflection, free = sheet(**given), given.get("tip_deflection", 0.015), given.get("tip_warping", 0)

    def residual(level, p, tip):
        r, R, m, _ = tip
        return [r[1] - level * deflection / beam.length, R[1, 0], p[0], p[2], m[0], m[1]] + warp_residual(beam, tip, free)
    p = beam.solve(residual, np.zeros(7 if beam.warps else 6), np.linspace(0.2, 1, 5) if deflection > 0.02 else (0.5, 1.0))
    C, (r, _, m, _) = compliance(beam, p, free)
    at = parameters(given)
    for i, j in PLANAR:
        yield "sheet_cantilever", at, f"C_{RESPONSE[i]}_{LOAD[j]}", C[i, j], unit_of(i, j), RELATIVE, "spatial moments"
    yield "sheet_cantilever", at, "C_xx", C[0, 0], "m/N", RELATIVE, "spatial moments"
    yield "sheet_cantilever", at, "C_zz", C[2, 2], "m/N", RELATIVE, "spatial moments"
    yield "sheet_cantilever", at, "u_x", beam.length * (r[0].real - 1), "m", RELATIVE
    yield "sheet_cantilever", at, "F_y", beam.force * p[1], "N", RELATIVE
    yield "sheet_cantilever", at, "M_z", beam.force * beam.length * m[2].real, "N m", RELATIVE


def twisted(**given):
    """sheet_wagner: R = Ry Rz Rx, phi_y free with zero moment about the fixed y axis."""
    beam = sheet(**{"wagner": 1, **given})
    free, phi_x, phi_z, deflection = given.get("tip_warping", 0), given.get("tip_phi_x", 0.15), given.get("tip_phi_z", 0.15), given.get("tip_deflection", 0.015)

    def residual(level, p, tip):
        r, R, m, _ = tip
        bend, twist = min(level, 1.0), max(level - 1.0, 0.0)
        return [r[1] - bend * deflection / beam.length, R[1, 0] - math.sin(bend * phi_z), R[1, 2] + math.tan(twist * phi_x) * R[1, 1], p[0], p[2], m[1]] \
            + warp_residual(beam, tip, free)
    p = beam.solve(residual, np.zeros(7), [0.5] + [1 + i / 60 for i in range(61)] if phi_x else (0.5, 1.0))
    C, (r, _, m, _) = compliance(beam, p, free)
    at = parameters(given)
    for i in range(6):
        for j in range(6):
            if abs(C[i, j]) > 1e-9 * math.sqrt(abs(C[i, i] * C[j, j])):
                yield "sheet_wagner", at, f"C_{RESPONSE[i]}_{LOAD[j]}", C[i, j], unit_of(i, j), RELATIVE, "spatial moments; R = Ry Rz Rx"
    yield "sheet_wagner", at, "u_x", beam.length * (r[0].real - 1), "m", RELATIVE
    yield "sheet_wagner", at, "u_z", beam.length * r[2].real, "m", RELATIVE
    yield "sheet_wagner", at, "F_y", beam.force * p[1], "N", RELATIVE
    yield "sheet_wagner", at, "M_x", beam.force * beam.length * m[0].real, "N m", RELATIVE
    yield "sheet_wagner", at, "M_z", beam.force * beam.length * m[2].real, "N m", RELATIVE


def rows():
    for given in ({}, {"tip_warping": 1}, {"tip_deflection": 0.05}, {"tip_deflection": 0.05, "tip_warping": 1}, {"tip_deflection": 0.001}, {"shear": 0},
                  {"warping": 0, "trapeze": 0, "shear_factor": 0.8333333333333334}, {"length": 0.05, "tip_deflection": 0.0075}, {"width": 0.02}, {"thickness": 0.0005}):
        yield from cantilever(**given)
    for given in ({}, {"wagner": 0}, {"tip_warping": 1}, {"wagner": 0, "tip_warping": 1}):
        yield from twisted(**given)
