"""Spherical flexure joint (N section 4.2): support stiffness of twelve geometrically exact sheets over one revolution of
the tilt axis.

The fold lines pass through the centre at the polar angle from z, and their outer ends are at the radius. The two
sheets of a fold are perpendicular to the fold line, on the outer side, symmetric about the vertical plane through the
fold line, and include the fold angle. Three folds join the base and the intermediate body. Their mirror images in the
xy plane, rotated by 60 degrees, join the intermediate body to the end effector. The sheet on the +azimuth side is
attached to the lower-numbered body. Warping is restrained at bodies.
"""
import math

import numpy as np

from reference.derive import defaults
from reference.derive.network import Network, clamped
from reference.derive.sheets import parameters, sheet

RELATIVE = 1e-10
DEFAULTS = defaults.values("spherical_joint")
SIZES = ("length", "width", "thickness", "young", "poisson", "wagner")


def sheet_of(given):
    value = {**DEFAULTS, **given}
    return sheet(**{k: value[k] for k in SIZES})


def fold(net, beam, given, centre, axes, azimuth, mirrored, bodies, name):
    """Adds two sheets and the body where they meet. The columns of `axes` are x, y, z of the joint."""
    value = {**DEFAULTS, **given}
    up = np.diag([1, 1, -1.0 if mirrored else 1.0])
    turn = np.array([[math.cos(azimuth), -math.sin(azimuth), 0],
                     [math.sin(azimuth), math.cos(azimuth), 0], [0, 0, 1]])
    to_global = axes @ turn @ up
    polar, half = value["polar_angle"], value["fold_angle"] / 2
    line = np.array([math.sin(polar), 0, math.cos(polar)])
    outward = np.array([math.cos(polar), 0, -math.sin(polar)])
    middle = (value["radius"] - value["width"] / 2) * line
    crease = net.body(centre + to_global @ middle)
    for side, body in ((1, bodies[0]), (-1, bodies[1])):
        along = math.cos(half) * outward + side * math.sin(half) * np.array(
            [0, 1, 0])  # from the fold to the body
        end = middle + value["length"] * along
        x, z = -to_global @ along, to_global @ line
        at_fold = {"shared": name, "free": "free", "fixed": "fixed"}[value["fold_warping"]]
        y = np.cross(z, x)
        net.member(beam, body, crease, centre + to_global @ end, np.column_stack([x, y, z]),
                   ("fixed", at_fold))


def add_joint(net, beam, given, centre, axes, base, effector, name):
    """Returns the intermediate body."""
    middle = net.body(centre)
    first = {**DEFAULTS, **given}["azimuth"]
    for k in range(3):
        fold(net, beam, given, centre, axes, first + 2 * math.pi * k / 3, False, (base, middle),
             f"{name}.{k}")
    for k in range(3):
        fold(net, beam, given, centre, axes, first + 2 * math.pi * (k + 0.5) / 3, True,
             (middle, effector), f"{name}.{k + 3}")
    return middle


def turned(given):
    value = {**DEFAULTS, **given}
    tilt, steps = value["tilt"], value["steps"]

    def vector(level):
        azimuth = 2 * math.pi * max(level - 1, 0) / steps
        return min(level, 1.0) * tilt * np.array([math.cos(azimuth), math.sin(azimuth), 0.0])

    return vector


def stiffness_curve(intervals=4, nodes=10, form=lambda beam: beam, **given):
    """Returns (stiffness of the undeformed joint, [stiffness at every azimuth]) in N/m."""
    beam = form(sheet_of(given))
    net = Network(beam.length, beam.EIz / beam.length ** 2, intervals=intervals, nodes=nodes)
    vector = turned(given)
    place = clamped((0.0, 0.0, 0.0), vector)

    def driven(level, x, R, force, moment, numbers):
        return np.concatenate([force, place(level, x, R, force, moment, numbers)[3:]])

    base, effector = net.body((0, 0, 0), clamped((0.0, 0.0, 0.0))), net.body((0, 0, 0), driven)
    add_joint(net, beam, given, np.zeros(3), np.eye(3), base, effector, "joint")

    def stiffness(level):
        return 1 / net.response(level, effector, {})[2, 2]

    undeformed, curve = stiffness(0.0), []
    for level in (0.5, 1.0):
        net.solve((level, ))
    steps = {**DEFAULTS, **given}["steps"]
    for k in range(steps):
        net.solve((1.0 + k, ), tolerance=1e-9)
        curve.append(stiffness(1.0 + k))
    return undeformed, curve


def rows():
    for given in ({}, {"wagner": 0}, {
            "fold_warping": "free", "wagner": 0, "tilt": 0.1, "steps": 10
    }):
        undeformed, curve = stiffness_curve(**given)
        at = parameters(given)
        for name, value in (("max", max(curve)), ("min", min(curve)), ("undeformed", undeformed)):
            yield "spherical_joint", at, f"support_stiffness_{name}", value, "N/m", RELATIVE
