"""Flexure-based hexapod (N section 4.3, synthetic dimensions): support stiffness of its platform along z. The twelve
joints consist of geometrically exact sheets.

Six cranks rotate about horizontal tangents by one common, unknown angle, which gives the platform the prescribed
height. Then the cranks are fixed, and a unit force acts on the platform. The base of each joint is on the rod. The z
axis of a joint is along the rod and points away from it. The x axis is in the plane of the rod and the global z axis,
on the upper side.
"""
import math

import numpy as np

from reference.derive import defaults
from reference.derive.beam import rotation
from reference.derive.joint import add_joint, sheet_of
from reference.derive.network import Network
from reference.derive.sheets import parameters

RELATIVE = 1e-9
DEFAULTS = defaults.values("hexapod")


def crank_conditions(pivot, axis):
    axis = np.asarray(axis)

    def conditions(level, x, R, force, moment, numbers):
        turn = rotation(np.concatenate([[np.cos(numbers[0] / 2)], np.sin(numbers[0] / 2) * axis]))
        D = R @ turn.T
        return np.concatenate(
            [x - pivot,
             np.array([D[2, 1] - D[1, 2], D[0, 2] - D[2, 0], D[1, 0] - D[0, 1]]) / 2])

    return conditions


def joint_axes(direction):
    x = np.array([0, 0, 1]) - direction[2] * direction
    x = x / np.linalg.norm(x)
    return np.column_stack([x, np.cross(direction, x), direction])


def add_leg(net, beam, value, leg, platform):
    side, middle = (-1 if leg % 2 == 0 else 1), 2 * math.pi / 3 * (leg // 2)
    below, above = middle + side * value["crank_azimuth"], middle + side * value["platform_azimuth"]
    radial = np.array([math.cos(below), math.sin(below), 0])
    low = (value["base_radius"] - value["crank_length"]) * radial
    high = np.array([
        value["platform_radius"] * math.cos(above), value["platform_radius"] * math.sin(above),
        value["height"]
    ])
    along = (high - low) / np.linalg.norm(high - low)
    pivot = value["base_radius"] * radial
    crank = net.body(pivot,
                     crank_conditions(pivot / net.length, (-math.sin(below), math.cos(below), 0)))
    rod = net.body(low)
    add_joint(net, beam, value, low, joint_axes(-along), rod, crank, f"{leg}.low")
    add_joint(net, beam, value, high, joint_axes(along), rod, platform, f"{leg}.high")


def stiffness_curve(intervals=3, nodes=9, form=lambda beam: beam, **given):
    """Returns [(stiffness in N/m, crank angle in rad)] at the positions from -stroke to +stroke. `form` is explained at
    sheets.deflected."""
    value = {**DEFAULTS, **given}
    beam = form(sheet_of(value))
    net = Network(beam.length,
                  beam.EIz / beam.length ** 2,
                  numbers=[0.0],
                  intervals=intervals,
                  nodes=nodes)
    platform = net.body((0, 0, value["height"]))
    for leg in range(6):
        add_leg(net, beam, value, leg, platform)
    net.extra = [(
        platform,
        lambda level, x, R, force, moment, numbers: [x[2] -
                                                     (value["height"] + level) / net.length])]
    cranks_held = {"extra": [(platform, lambda level, x, R, force, moment, numbers: [numbers[0]])]}
    out = []
    steps = value["steps"]
    positions = [value["stroke"] * (2 * k / (steps - 1) - 1) for k in range(steps)]
    net.solve([positions[0] / 4 * k for k in (1, 2, 3)], tolerance=1e-4)
    for position in positions:
        net.solve((position, ), tolerance=1e-9)
        out.append((1 / net.response(position, platform, cranks_held)[2, 2], net.numbers[0]))
    return out


def rows():
    for given in ({}, {"wagner": 0}):
        curve = stiffness_curve(**given)
        for k, (stiffness, _) in enumerate(curve):
            yield "hexapod", parameters(
                given), f"support_stiffness_{k + 1}", stiffness, "N/m", RELATIVE
        yield "hexapod", parameters(given), "crank_angle", curve[-1][1], "rad", RELATIVE
