"""The integrator conserving must have order 2 if a node with an eccentric mass is driven."""
import numpy
from scipy.integrate import solve_ivp

from cases.format.test.scene_case import SceneCase, values

SCENE = """beamwork: 1
sections: {{s: {{constants: {{A: 1e-2, Iy: 1e-2, Iz: 1e-2, It: 1e-2}}, young: 1e6, shear_modulus: 1e6}}}}
nodes:
  m: {{at: [0, 0, 0], {node}, mass: 3, centre: [0.4, 0.25, 0.1], inertia: [0.4, 0.3, 0.5, 0.1, 0.05, 0]}}
  g: {{at: [5, 5, 0], hold: all}}
  h: {{at: [6, 5, 0], hold: all}}
members: {{beam: {{from: g, to: h, section: s, y: [0, 1, 0]}}}}
springs: {{s1: {{to: m, stiffness: [300, 120, 90, 0, 0, 0]}}}}
motions: {{d: {{unit: {unit}, time: "0.3*(1 - cos(6*t))"}}}}
analyses: {{go: {{motion: {{stations: [0.5, 1.2], integrator: conserving, step: {step}}}}}}}
quantities:
  x: {{displacement: {{analysis: go, node: m, component: ux}}}}
  y: {{displacement: {{analysis: go, node: m, component: uy}}}}
  vy: {{rate: {{analysis: go, node: m, component: uy}}}}
  wz: {{rate: {{analysis: go, node: m, component: rz}}}}
  work: {{energy: {{analysis: go, of: work}}}}
  drift: {{energy: {{analysis: go, of: drift}}}}
omit: [trapeze, wagner_moments, wagner_torque]
"""
MASS, STIFFNESS = 3, numpy.array([300, 120, 90])
CENTRE = numpy.array([0.4, 0.25, 0.1])
INERTIA = numpy.array([[0.4, 0.1, 0], [0.1, 0.3, 0.05], [0, 0.05, 0.5]]) + MASS * (
    CENTRE @ CENTRE * numpy.eye(3) - numpy.outer(CENTRE, CENTRE))


def skew(v):
    return numpy.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def exact(driven, held, until):
    """Integrates the rigid body by the method of Dormand and Prince of order 8. Unknowns: displacement, rotation matrix,
    velocity, angular velocity in the axes of the body, work of the drive."""
    free = [i for i in range(6) if i not in (driven, *held)]

    def slope(t, y):
        r, R, v, w = y[:3], y[3:12].reshape(3, 3), y[12:15], y[15:18]
        M = numpy.zeros((6, 6))
        M[:3, :3], M[3:, 3:] = MASS * numpy.eye(3), INERTIA
        M[:3, 3:] = -MASS * R @ skew(CENTRE)
        M[3:, :3] = M[:3, 3:].T
        f = numpy.concatenate([-STIFFNESS * r - MASS * R @ numpy.cross(w, numpy.cross(w, CENTRE)),
                               -numpy.cross(w, INERTIA @ w)])
        a = numpy.zeros(6)
        a[driven] = 10.8 * numpy.cos(6 * t)
        a[free] = numpy.linalg.solve(M[numpy.ix_(free, free)], f[free] - M[free, driven] * a[driven])
        power = (M @ a - f)[driven] * 1.8 * numpy.sin(6 * t)
        return numpy.concatenate([v, (R @ skew(w)).ravel(), a, [power]])

    y = numpy.zeros(19)
    y[3:12] = numpy.eye(3).ravel()
    y = solve_ivp(slope, [0, until], y, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
    return {"x": y[0], "y": y[1], "vy": y[13], "wz": y[17], "work": y[18]}


class DrivenMassesTest(SceneCase):

    def test_order(self):
        for node, unit, driven, held in (("drive: {uz: d}", "m", 2, ()), ("hold: [ux], drive: {uz: d}", "m", 2, (0,)),
                                         ("hold: [uz, rx, ry], drive: {ux: d}", "m", 0, (2, 3, 4)),
                                         ("hold: [uz, rx, ry], drive: {rz: d}", "rad", 5, (2, 3, 4))):
            wanted, errors = exact(driven, held, 1.2), []
            for step in (8e-4, 4e-4):
                text = SCENE.format(node=node, unit=unit, step=step)
                found = values(self.record("solve", "--scene", self.scene(text), "-f", "collocation", "-n", 1))
                errors.append({name: found[name] - value for name, value in wanted.items()})
                self.assertLess(abs(found["drift"]), 1e-11 * abs(found["work"]))
            for name, value in wanted.items():
                first, second = errors[0][name], errors[1][name]
                self.assertLess(abs(first), 1e-3 * max(1, abs(value)), (node, name))
                if abs(second) > 1e-9:
                    self.assertAlmostEqual(first / second, 4, delta=0.1, msg=(node, name))
