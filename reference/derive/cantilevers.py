import math

import numpy as np

from reference.derive import defaults
from reference.derive.beam import Beam
from reference.derive.network import Network, clamped
from reference.derive.torsion import rectangle_constant

RELATIVE = 5e-12


def dead_load(beam, F, steps):
    """Returns the position of the tip divided by L, and the rotation matrix of the tip, of a cantilever under a dead tip
    force F [N]."""
    net = Network(beam.length, beam.EIz / beam.length ** 2, intervals=6)
    load = np.array(F) / net.force
    angle = beam.curvature * beam.length
    end = beam.length * np.array([math.sin(angle), 2 *
                                  math.sin(angle / 2) ** 2, 0]) / angle if angle else (beam.length,
                                                                                       0, 0)
    root, tip = net.body((0, 0, 0), clamped((0.0, 0.0, 0.0))), net.body(
        end,
        lambda level, x, R, force, moment, numbers: np.concatenate([force - level * load, moment]))
    net.member(beam, root, tip, (0, 0, 0), np.eye(3))
    net.solve(np.linspace(1 / steps, 1, steps))
    return tip.x, tip.R


def planar_angle(R):
    return math.atan2(R[1, 0], R[0, 0])


def elastica(loads=(1, 2, 5, 10), form=lambda beam: beam):
    axial = float(defaults.values("elastica")["axial"])
    for load in loads:
        beam = form(Beam(1.0, EA=axial, EIy=1.0, EIz=1.0, GJ=1.0))
        r, R = dead_load(beam, (0, load, 0), 10)
        at = defaults.differing("elastica", load=load)
        yield "elastica", at, "w_over_L", r[1], "1", RELATIVE
        yield "elastica", at, "u_over_L", 1 - r[0], "1", RELATIVE
        yield "elastica", at, "theta", planar_angle(R), "rad", RELATIVE


def shear_elastica(stiffnesses=(500, 50, 10), form=lambda beam: beam):
    axial = float(defaults.values("shear_elastica")["axial"])
    for GA in stiffnesses:
        beam = form(Beam(1.0, EA=axial, EIy=10.0, EIz=10.0, GJ=10.0, fy=1 / GA, fz=1 / GA))
        r, _ = dead_load(beam, (0, 10, 0), 10)
        at = defaults.differing("shear_elastica", GA=GA)
        yield "shear_elastica", at, "u", r[0] - 1, "m", RELATIVE
        yield "shear_elastica", at, "v", r[1], "m", RELATIVE


def geradin_cardona(loads=(600e3, 300e3), form=lambda beam: beam):
    for load in loads:
        beam = form(
            Beam(5.0, EA=4.8e8, EIy=9.346e6, EIz=9.346e6, GJ=1e6, fy=1 / 3.231e8, fz=1 / 3.231e8))
        r, R = dead_load(beam, (0, -load, 0), 10)
        at = defaults.differing("geradin_cardona", load=f"{load:g}")
        yield "geradin_cardona", at, "tip_x", 5 * r[0], "m", RELATIVE
        yield "geradin_cardona", at, "tip_y", 5 * r[1], "m", RELATIVE
        yield "geradin_cardona", at, "theta", -planar_angle(R), "rad", RELATIVE


def bend_45(torsions=("exact", "polar"), forces=(600, 300), form=lambda beam: beam):
    radius, angle, E, G = 100.0, math.pi / 4, 1e7, 5e6
    for torsion in torsions:
        k, J = (5 / 6, float(rectangle_constant(1, 1))) if torsion == "exact" else (1.0, 1 / 6)
        beam = form(
            Beam(radius * angle,
                 EA=E,
                 EIy=E / 12,
                 EIz=E / 12,
                 GJ=G * J,
                 fy=1 / (k * G),
                 fz=1 / (k * G),
                 curvature=1 / radius))
        for force in forces:
            r, _ = dead_load(beam, (0, 0, force), 20)
            at = defaults.differing("bend_45", force=force, torsion=torsion)
            start = (radius * math.sin(angle), radius * (1 - math.cos(angle)), 0.0)
            for i, name in enumerate(("u_tangent", "u_radial", "u_load")):
                yield "bend_45", at, name, beam.length * r[i] - start[i], "m", RELATIVE


def roll_up(all_turns=(1, 0.25, 2)):
    for turns in all_turns:
        angle = 2 * math.pi * turns
        value = 0.0 if turns >= 1 and turns == int(turns) else math.sin(angle) / angle
        yield "roll_up", defaults.differing("roll_up", turns=turns), "tip_gap", value, "1", 1e-13


def wagner_strip(angle):
    E, G, b, t, L = 2e11, 8e10, 0.2, 0.01, 1.0
    k = angle / L
    J, In = b * t ** 3 / 3, t * b ** 5 / 180
    at = defaults.differing("wagner_torsion", angle=f"{angle:g}")
    yield "wagner_torsion", at, "moment", G * J * k + E * In * k ** 3 / 2, "N m"
    yield "wagner_torsion", at, "shortening", L * (b ** 2 + t ** 2) / 24 * k ** 2, "m"


def wagner_torsion(angles=(1.0, 0.5, 2.0)):
    for angle in angles:
        yield from wagner_strip(angle)


def rows():
    for family in (elastica, shear_elastica, geradin_cardona, bend_45, roll_up, wagner_torsion):
        yield from family()
