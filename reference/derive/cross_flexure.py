"""Cross-flexure hinge: three leaves cross at their middles, at the angles half_angle and pi - half_angle from x. The
outer two are parallel. The arm rotates about z.

The only free body is the arm, whose rotation about z is given. Its tilts are fixed if the parameter `rotation` is hinge
or vector. They are free if the parameter is first, last or between, which is the position of the driven rotation in the
sequence of the three rotations. In a plane state, this position has no effect. A unit load acts on the arm while the
rotation about z is fixed. The moment of the drive along z is dead (spatial moments) or follows the tilt. For
semitangential moments, the stiffness K changes by m~/2 on the tilts. For symmetrised moments, K is replaced by its
symmetric part."""
import math

import numpy as np

from reference.derive import defaults
from reference.derive.network import Network, clamped
from reference.derive.sheets import parameters, sheet

# Uncertainty of a position, relative to the length of a leaf. Eight networks (4 to 10 intervals, 12 to 20 nodes) give
# positions at angle=0.01 that differ by 6e-18 m, half of this value.
ROUND_OFF = 2.2e-16
RELATIVE = 1e-9  # relative uncertainty; the high axial stiffness of a leaf increases round-off errors
DEFAULTS = defaults.values("cross_flexure")
SIZES = ("length", "width", "thickness", "young", "poisson")
TILTS_FREE = ("first", "last", "between")


def hinge(given, intervals=4, nodes=14, form=lambda beam: beam):
    """Returns (network, arm, conditions that prescribe the rotation of the arm). `form` is explained at
    sheets.deflected."""
    value = {**DEFAULTS, **given}
    beam = form(sheet(**{k: value[k] for k in SIZES}))
    net = Network(beam.length, beam.EIz / beam.length ** 2, intervals=intervals, nodes=nodes)
    turned = clamped((0.0, 0.0, 0.0), lambda level: (0.0, 0.0, level * value["angle"]))

    def conditions(level, x, R, force, moment, numbers):
        return np.concatenate([force, turned(level, x, R, force, moment, numbers)[3:]])

    arm = net.body((0, 0, 0), conditions)
    for i in range(3):
        a = value["half_angle"] if i == 1 else math.pi - value["half_angle"]
        along = np.array([math.cos(a), math.sin(a), 0])
        start = -along * beam.length / 2 + np.array([0, 0, (i - 1) * value["pitch"]])
        base = net.body(start, clamped(tuple(start / net.length)))
        axes = np.column_stack([along, [-along[1], along[0], 0], [0, 0, 1]])
        net.member(beam, base, arm, start, axes, ("fixed", "fixed"))
    return net, arm, turned


def compliance(net, arm, turned, tilts_free, convention):
    """Returns the compliance in SI units for (ux, uy, uz, thx, thy) [5, 5] if the tilts are free, or for the
    translations [3, 3] if they are fixed."""

    def tilting(level, x, R, force, moment, numbers):
        return np.concatenate([force, moment[:2], turned(level, x, R, force, moment, numbers)[5:]])

    C = net.response(1.0, arm, {arm: tilting} if tilts_free else {})
    if not tilts_free:
        return C[:3, :3]
    C = C[:5, :5]
    K = np.linalg.inv(C)
    moment = net.force * net.length * arm.load[5]
    half = np.array([[0.0, -moment], [moment, 0.0]]) / 2
    if convention == "semitangential":
        K[3:, 3:] += half
    elif convention == "symmetrised":
        K = (K + K.T) / 2
    return C if convention == "spatial" else np.linalg.inv(K)


def quantities(given, form=lambda beam: beam):
    value = {**DEFAULTS, **given}
    convention, rotation = value["moment_convention"], value["rotation"]
    net, arm, turned = hinge(given, form=form)
    net.solve((0.5, 1.0), tolerance=1e-10)  # above the round-off due to the axial stiffness of the leaves
    C = compliance(net, arm, turned, rotation in TILTS_FREE, convention)
    yield "moment", net.force * net.length * arm.load[5], "N m", RELATIVE
    for i, name in enumerate(("shift_x", "shift_y")):
        yield name, net.length * arm.x[i], "m", max(RELATIVE, ROUND_OFF / abs(arm.x[i]))
    for i, name in enumerate(("k_x", "k_y", "k_z", "k_tilt_x", "k_tilt_y")[:len(C)]):
        yield name, 1 / C[i, i], "N/m" if i < 3 else "N m/rad", RELATIVE, convention


POINTS = [{}, {"angle": 0.01}, {"angle": 0.3490658503988659},
          {"half_angle": 0.5, "angle": -0.2, "pitch": 0.03}]
POINTS += [{"rotation": rotation} for rotation in ("vector", *TILTS_FREE)]
POINTS += [{"rotation": "first", "moment_convention": convention}
           for convention in ("semitangential", "symmetrised")]


def rows():
    for given in POINTS:
        for row in quantities(given):
            yield "cross_flexure", parameters(given), *row
