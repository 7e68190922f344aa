"""Channel cantilever under a dead tip force parallel to its web (J section 5.2): force at given deflections of the loaded
point.

The model is the geometrically exact beam with eccentric shear centre and warping. The root is clamped with warping
restrained, and the tip is free to warp. The end section is rigid, and the force acts at its point D (top of the web)
or E (bottom). As in J, shortening by twist and the part -2 ys of the Wagner moments are included, and the Wagner
torque is omitted. int y (y^2 + z^2) dA is included only if requested. Haringx's shear theory is used.
"""
import numpy as np

from reference.derive import defaults
from reference.derive.beam import Beam
from reference.derive.network import Network, clamped
from reference.derive.section import channel

E, G, LENGTH = 210e9, 80.77e9, float(defaults.values("c_cantilever")["length"])
FLANGE = 0.016
SIZES = {"overall": ("0.284", "0.095"), "centreline": ("0.3", "0.1")}
RELATIVE = 1e-9


def channel_beam(sizes, shear, wagner_moments):
    """Returns (beam, half of the height, y of the web) for a flange thickness of 16 mm and a web thickness of 10 mm."""
    s = channel(*SIZES[sizes], "0.016", "0.010")
    ys, zs = float(s.ys), float(s.zs)
    beam = Beam(LENGTH,
                EA=E * float(s.A),
                EIy=E * float(s.Iy),
                EIz=E * float(s.Iz),
                GJ=G * float(s.It),
                EIw=E * float(s.Iw),
                t=float(s.Ip / s.A) + ys ** 2 + zs ** 2,
                centre=(ys, zs),
                wagner=(-2 * zs, float(s.wagner_y / s.Iz) * wagner_moments - 2 * ys),
                shear=np.array((s.F / G).tolist(), dtype=float) * shear)
    return beam, float(SIZES[sizes][0]) / 2, float(s.points[1][0])


def path(deflections, intervals=6, nodes=11, form=lambda beam: beam, **given):
    """Returns (force [N], displacement of the loaded point along y [m]) at each deflection [m]. The steps are so small
    that the branch does not change."""
    value = {**defaults.values("c_cantilever"), **given}
    beam, half, web = channel_beam(value["sizes"], value["shear"], value["wagner_moments"])
    beam = form(beam)
    half += FLANGE / 2 if value["load_height"] == "edge" else 0
    net = Network(LENGTH, beam.EIz / LENGTH ** 2, numbers=[0.0], intervals=intervals, nodes=nodes)
    arm = np.array([0, web, half if value["load_point"] == "D" else -half]) / LENGTH

    def loaded(level, x, R, force, moment, numbers):
        pull = np.array([0 * numbers[0], 0 * numbers[0], -numbers[0]])
        return np.concatenate([force - pull, moment - np.cross(R @ arm, pull)])

    root, tip = net.body((0, 0, 0), clamped((0.0, 0.0, 0.0))), net.body((LENGTH, 0, 0), loaded)
    net.member(beam, root, tip, (0, 0, 0), np.eye(3), ("fixed", "free"))
    net.extra = [
        (tip, lambda level, x, R, force, moment, numbers: [x[2] + (R @ arm)[2] - arm[2] + level])
    ]
    out, at = [], 0.0
    for w in deflections:
        while at < w - 1e-12:
            at = min(at + (0.01 if at < 0.4 else 0.05), w)
            net.solve((at / LENGTH, ), tolerance=1e-11 if at == w else 1e-7)
        out.append((net.numbers[0] * net.force, (tip.x + tip.R @ arm - arm)[1] * LENGTH))
    return out


POINTS = (({}, (0.125, 0.25, 0.5, 1.0, 1.5, 2.0, 2.5, 2.6)), ({
    "load_point": "E"
}, (0.125, 0.25, 0.5, 1.0, 1.2, 1.5, 2.0, 2.5)), ({"sizes": "centreline"}, (0.25, 1.0, 2.5)), ({
    "sizes": "centreline", "load_point": "E"
}, (1.0, )), ({"shear": 1}, (0.25, 1.0, 2.5)), ({"shear": 1, "load_point": "E"}, (1.0, )), ({
    "wagner_moments": 1
}, (1.0, )), ({"load_height": "edge", "wagner_moments": 1}, (0.1, 0.2, 0.5, 1.04, 2.6)), ({
    "load_height": "edge", "load_point": "E", "wagner_moments": 1
}, (0.1, 0.2, 0.494, 1.04, 1.2)), ({"load_height": "edge"}, (0.1, 0.2, 0.5, 1.04, 2.6)), ({
    "load_height": "edge", "load_point": "E"
}, (0.1, 0.2, 0.494, 1.04, 1.2)))


def rows():
    for given, deflections in POINTS:
        for w, (force, lateral) in zip(deflections, path(deflections, **given)):
            at = defaults.differing("c_cantilever", **given, w=w)
            yield "c_cantilever", at, "load_at_w", force, "N", RELATIVE
            yield "c_cantilever", at, "lateral", lateral, "m", RELATIVE
