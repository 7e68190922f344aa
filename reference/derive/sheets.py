"""The sheet flexure with prescribed tip motion: reactions, and the compliance matrix of its tip.

The moment m of the reaction follows a convention as the tip rotates by theta. A spatial moment is dead about fixed
axes, as in the response of the network. A semitangential moment becomes m + theta x m/2, and its stiffness is the
spatial stiffness plus m~/2 on the rotations. The symmetrised stiffness is the symmetric part of the spatial stiffness.
It equals the semitangential stiffness if the beam has a potential.
"""
import math

import numpy as np

from reference.derive import defaults
from reference.derive.beam import Beam, cross_matrix
from reference.derive.compliance import name_of, unit_of
from reference.derive.network import Network, clamped, free
from reference.derive.torsion import rectangle_constant

RELATIVE = 5e-12
ROUNDING = 1e-15  # round-off of a coordinate, relative to the length of the sheet
PLANAR = [(0, 0), (0, 1), (0, 5), (1, 0), (1, 1), (1, 5), (5, 0), (5, 1), (5, 5), (2, 2), (2, 3),
          (2, 4), (3, 2), (3, 3), (3, 4), (4, 2), (4, 3), (4, 4)]


def sheet(length,
          width,
          thickness,
          young,
          poisson,
          warping=1,
          shear=1,
          trapeze=1,
          wagner=0,
          shear_factor=0.0,
          **_):
    G, w, t = young / (2 * (1 + poisson)), width, thickness
    k = shear_factor or 10 * (1 + poisson) / (12 + 11 * poisson)
    f = 1 / (k * G * w * t) if shear else 0.0
    return Beam(length,
                EA=young * w * t,
                EIy=young * t * w ** 3 / 12,
                EIz=young * w * t ** 3 / 12,
                GJ=G * float(rectangle_constant(w, t)),
                fy=f,
                fz=f,
                EIw=young * (w * t) ** 3 / 144 if warping else 0.0,
                t=(w * w + t * t) / 12 if trapeze else 0.0,
                c=young * w ** 5 * t / 1440 if wagner else 0.0)


def parameters(given):
    return ";".join(f"{k}={v}" for k, v in given.items())


def clamped_sheet(value, conditions, form=lambda beam: beam):
    """Returns the network of one sheet whose tip satisfies the conditions. `value` contains all parameters. `form` is
    explained at `deflected`."""
    beam = form(sheet(**value))
    net = Network(beam.length,
                  beam.EIz / beam.length ** 2,
                  intervals=max(4, round(2 * beam.length / value["width"])),
                  nodes=14)
    root, tip = net.body((0, 0, 0), clamped((0.0, 0.0, 0.0))), net.body((beam.length, 0, 0),
                                                                        conditions)
    net.member(beam, root, tip, (0, 0, 0), np.eye(3),
               ("fixed", "free" if value["tip_warping"] else "fixed"))
    return net, tip


def under_convention(C, moment, convention):
    """Returns the compliance [6, 6] under another convention, from the compliance for spatial moments. `moment` [3] is in
    N m."""
    K = np.linalg.inv(C)
    if convention == "semitangential":
        K[3:, 3:] += cross_matrix(moment) / 2
    elif convention == "symmetrised":
        K = (K + K.T) / 2
    return C if convention == "spatial" else np.linalg.inv(K)


def quantities(case, given, net, tip, entries):
    convention = {**defaults.values(case), **given}["moment_convention"]
    turned = "RyRzRx" if case == "sheet_wagner" else ""
    note = f"{convention} {turned}".strip()
    C = under_convention(net.response(1.0, tip, {tip: free}), net.force * net.length * tip.load[3:],
                         convention)
    at = parameters(given)
    for i, j in entries:
        if abs(C[i, j]) > 1e-9 * math.sqrt(abs(C[i, i] * C[j, j])):
            yield case, at, name_of(i, j), C[i, j], unit_of(i, j), RELATIVE, note
    if case == "sheet_cantilever":
        yield case, at, "C_xx", C[0, 0], "m/N", RELATIVE, note
        yield case, at, "C_zz", C[2, 2], "m/N", RELATIVE, note
    shortening = 1 - tip.x[0]
    yield case, at, "u_x", -net.length * shortening, "m", max(RELATIVE,
                                                              ROUNDING / abs(shortening)), turned
    if case == "sheet_wagner":
        yield case, at, "u_z", net.length * tip.x[2], "m", RELATIVE, turned
    yield case, at, "F_y", net.force * tip.load[1], "N", RELATIVE, turned
    if case == "sheet_wagner":
        yield case, at, "M_x", net.force * net.length * tip.load[3], "N m", RELATIVE, turned
    yield case, at, "M_z", net.force * net.length * tip.load[5], "N m", RELATIVE, turned


def deflected(given, form=lambda beam: beam):
    """Returns (network, tip) of sheet_cantilever. u_y of the tip is prescribed, the rotation about z is zero, and all
    other components are free. `form` replaces the beam by another beam, as in predicted.py."""
    value = {**defaults.values("sheet_cantilever"), **given}
    deflection = value["tip_deflection"] / value["length"]

    def conditions(level, x, R, force, moment, numbers):
        return np.array(
            [x[1] - level * deflection, R[1, 0], force[0], force[2], moment[0], moment[1]])

    net, tip = clamped_sheet(value, conditions, form)
    net.solve(np.linspace(0.1, 1, 10) if deflection > 0.2 else (0.5, 1.0))
    return net, tip


def cantilever(form=lambda beam: beam, **given):
    yield from quantities("sheet_cantilever", given, *deflected(given, form), PLANAR)


def twisted(form=lambda beam: beam, **given):
    """Yields the rows of sheet_wagner, whose tip is rotated by R = Ry Rz Rx. phi_y is free, so the moment about the fixed
    y axis is zero."""
    value = {**defaults.values("sheet_wagner"), **given}
    phi_x, phi_z, deflection = value["tip_phi_x"], value[
        "tip_phi_z"], value["tip_deflection"] / value["length"]

    def conditions(level, x, R, force, moment, numbers):
        bend, twist = min(level, 1.0), max(level - 1.0, 0.0)
        return np.array([
            x[1] - bend * deflection, R[1, 0] - math.sin(bend * phi_z),
            R[1, 2] + math.tan(twist * phi_x) * R[1, 1], force[0], force[2], moment[1]
        ])

    net, tip = clamped_sheet(value, conditions, form)
    net.solve([0.5, 1.0] + [1 + i / 5 for i in range(1, 6)] if phi_x else (0.5, 1.0))
    yield from quantities("sheet_wagner", given, net, tip,
                          [(i, j) for i in range(6) for j in range(6)])


def rows():
    for given in ({}, {"tip_warping": 1}, {"tip_deflection": 0.05}, {
            "tip_deflection": 0.05, "tip_warping": 1
    }, {"tip_deflection": 0.001}, {"shear": 0}, {
            "warping": 0, "trapeze": 0, "shear_factor": 0.8333333333333334
    }, {"length": 0.05, "tip_deflection": 0.0075}, {"width": 0.02}, {"thickness": 0.0005}, {
            "thickness": 0.0001, "tip_deflection": 0.05
    }, {"length": 0.05, "tip_deflection": 0.025,
            "tip_warping": 1}, {"length": 0.5,
                                "tip_deflection": 0.25}, {"length": 2, "tip_deflection": 0.3}):
        yield from cantilever(**given)
    for deflection in (0.005, 0.01):
        for tip in (0, 1):
            given = {"tip_deflection": deflection, "tip_warping": 1
                     } if tip else {"tip_deflection": deflection}
            yield from (row for row in cantilever(**given) if row[2] in ("C_xx", "C_zz"))
    for given in ({}, {"wagner": 0}, {"tip_warping": 1}, {"wagner": 0, "tip_warping": 1}):
        yield from twisted(**given)
    for phi_x in (0.05, 0.1):
        for wagner in (1, 0):
            given = {"tip_phi_x": phi_x} if wagner else {"wagner": 0, "tip_phi_x": phi_x}
            yield from (row for row in twisted(**given) if row[2] == "C_ux_My")
    yield from (row for row in cantilever(moment_convention="semitangential") if row[2] == "C_zz")
    yield from (row for row in cantilever(moment_convention="symmetrised")
                if row[2] in ("C_zz", "C_uz_My"))
    for given in ({"moment_convention": "semitangential"}, {"moment_convention": "symmetrised"}, {
            "tip_warping": 1, "moment_convention": "symmetrised"
    }):
        yield from (row for row in twisted(**given) if row[2] in ("C_ux_My", "C_thy_Fx"))
