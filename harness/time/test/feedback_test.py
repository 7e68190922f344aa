"""Loads with feedback. Two masses and a bar with a controller are compared with the matrix exponential."""
import json
import unittest

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from harness.tools.kit.program import ProgramTest, run, values

M1, M2, K = 1.0, 0.5, 100.0  # masses of the cart and of the tool [kg], and stiffness of the bar [N/m]
SCENE = """beamwork: 1
sections:
  bar: {constants: {A: 1e-4, Iy: 1e-9, Iz: 1e-9, It: 1e-9}, young: 1e6, shear_modulus: 8e5}
nodes:
  cart: {at: [0, 0, 0], hold: [uy, uz, rx, ry, rz], mass: 1}
  tool: {at: [1, 0, 0], hold: [uy, uz, rx, ry, rz], mass: 0.5}
members:
  bar: {from: cart, to: tool, section: bar, y: [0, 1, 0], warping: free, damping: %(eta)g}
loads:
  motor: {force: [1, 0, 0], on: cart, %(more)s feedback: {%(gains)s}}
analyses:
%(analyses)s
quantities:
  tool: {displacement: {analysis: last, node: tool, component: ux}}
  cart: {displacement: {analysis: last, node: cart, component: ux}}
  drift: {energy: {analysis: last, of: drift}}
  energy: {energy: {analysis: last, of: energy}}
omit: [trapeze, wagner_moments, wagner_torque]
"""
MOTION = "  last: {motion: {stations: [1.5], step: %g, integrator: %s}}"


def exact(kp, kd, ki, damping, place, end, measured=2):
    """Returns the displacements of the tool and the cart at `end`, from the linear system of the states x1, v1, x2, v2,
    the integral and 1."""
    A = np.zeros((6, 6))
    A[0, 1] = A[2, 3] = 1
    A[1] = [-K / M1, -damping / M1, K / M1, damping / M1, ki / M1, kp * place / M1]
    A[3] = [K / M2, damping / M2, -K / M2, -damping / M2, 0, 0]
    A[4, 2 * measured - 2], A[4, 5] = -1, place
    A[1, 2 * measured - 2] -= kp / M1
    A[1, 2 * measured - 1] -= kd / M1
    x = expm(A * end) @ [0, 0, 0, 0, 0, 1]
    return x[2], x[0]


class Feedback(ProgramTest):

    def solved(self, gains, analyses, more="time: 0.01,", eta=0.0):
        path = self.folder / "scene.yaml"
        text = SCENE % {"gains": gains, "analyses": analyses, "more": more, "eta": eta}
        path.write_text(text, encoding="utf-8")
        said = self.record("solve", "--scene", path, "-f", "collocation", "-n", "1")
        found = values(said)
        self.assertLess(abs(found["drift"]), 1e-3 * found["energy"] + 1e-9)
        return found, [s["iterations"] for s in said["steps"]]

    def test_exponential(self):
        for scheme, step, near in (("radau", 0.01, 1e-6), ("alpha", 1e-3, 2e-3),
                                   ("explicit", 0.02, 1e-9)):
            for kp, kd, ki, node in ((20, 3, 5, 2), (20, 0, 0, 2), (300, -4, 0, 2), (50, 8, 90, 1)):
                eta = 0 if scheme == "explicit" else 0.01
                name = "tool" if node == 2 else "cart"
                found, steps = self.solved(
                    f"node: {name}, component: ux, proportional: {kp}, derivative: {kd}, "
                    f"integral: {ki}", MOTION % (step, scheme), eta=eta)
                tool, cart = exact(kp, kd, ki, eta * K, 0.01, 1.5, node)
                size = abs(tool) + abs(cart)
                self.assertLess(abs(found["tool"] - tool) + abs(found["cart"] - cart), near * size,
                                (scheme, kp, kd, ki))
                if scheme != "explicit":
                    self.assertLess(np.mean(steps), 2.1)

    def test_order(self):
        errors = []
        for step in (2e-3, 1e-3):
            found, _ = self.solved(
                "node: tool, component: ux, proportional: 20, derivative: 3, integral: 5",
                MOTION % (step, "alpha"))
            errors.append(found["cart"] - exact(20, 3, 5, 0, 0.01, 1.5)[1])
        self.assertAlmostEqual(errors[0] / errors[1], 4, 1)

    def test_limit(self):
        for scheme in ("radau", "alpha", "explicit"):
            found, _ = self.solved(
                "node: tool, component: ux, proportional: 1e6, derivative: 20, limit: 3",
                MOTION % (0.005, scheme), more="time: 1000,")
            centre = (M1 * found["cart"] + M2 * found["tool"]) / (M1 + M2)
            self.assertAlmostEqual(centre / (3 * 1.5**2 / 2 / (M1 + M2)), 1, 5)

    def test_continued(self):
        gains = "node: tool, component: ux, proportional: 20, derivative: 3, integral: 40"
        jump = "pieces: [{until: 0.5, is: 0.01}, {is: 0.03 + 0.01*t}],"
        for scheme in ("radau", "alpha", "explicit"):
            whole, _ = self.solved(gains, MOTION % (0.01, scheme), jump)
            parts, _ = self.solved(
                gains, f"  first: {{motion: {{stations: [0.7], step: 0.01, integrator: {scheme}}}}}\n"
                f"  last: {{motion: {{stations: [1.5], step: 0.01, integrator: {scheme}, "
                "about: first}}", jump)
            self.assertAlmostEqual(whole["tool"] / parts["tool"], 1, 8)

    def test_units(self):
        gains = "node: tool, component: ux, proportional: %g, derivative: %g, integral: %g"
        found, _ = self.solved(gains % (20, 3, 5), MOTION % (0.01, "radau"))
        text = SCENE % {"gains": gains % (20e-3, 3e-3, 5e-3), "more": "time: 10,", "eta": 0,
                        "analyses": MOTION % (0.01, "radau")}
        for a, b in (("beamwork: 1", "beamwork: 1\nunits: mm, N, MPa"), ("A: 1e-4", "A: 100"),
                     ("young: 1e6", "young: 1"), ("shear_modulus: 8e5", "shear_modulus: 0.8"),
                     ("at: [1,", "at: [1000,"), ("mass: 1}", "mass: 1e-3}"),
                     ("mass: 0.5}", "mass: 0.5e-3}"), ("Iy: 1e-9, Iz: 1e-9, It: 1e-9",
                                                       "Iy: 1000, Iz: 1000, It: 1000")):
            text = text.replace(a, b)
        path = self.folder / "mm.yaml"
        path.write_text(text, encoding="utf-8")
        said = json.loads(
            run("solve", "--scene", path, "-f", "collocation", "-n", "1", "--format", "json").stdout)
        millimetres = {q["quantity"]: q["value"] for q in said["quantities"]}["tool"]
        self.assertAlmostEqual(millimetres / (1000 * found["tool"]), 1, 9)

    def refusal(self, gains, analyses, more, words, *options):
        path = self.folder / "scene.yaml"
        text = SCENE % {"gains": gains, "analyses": analyses, "more": more, "eta": 0}
        path.write_text(text, encoding="utf-8")
        done = run("solve", "--scene", path, "-f", "collocation", "-n", "1", *options)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn(words, done.stderr)

    def test_refusals(self):
        gains = "node: tool, component: ux, proportional: 20"
        motion = MOTION % (0.01, "radau")
        self.refusal(gains, MOTION % (0.01, "conserving"), "time: 0.01,",
                     "(conserving): load motor has feedback")
        self.refusal("node: tool, component: ux", motion, "", "the feedback has no gain")
        self.refusal(gains + ", from: tool", motion, "", "the component of node tool minus itself is always 0")
        path, turn = self.folder / "scene.yaml", "node: tool, component: %s, proportional: 20"
        for component, code in (("ry", 2), ("rx", 0)):
            text = SCENE % {"gains": turn % component, "analyses": motion, "more": "time: 0.01,", "eta": 0}
            path.write_text(text.replace("hold: [uy, uz, rx, ry, rz], mass: 0.5", "hold: [uy, uz], mass: 0.5").replace(
                "warping: free", "release: {to: [ry]}, warping: free"), encoding="utf-8")
            done = run("solve", "--scene", path, "-f", "collocation", "-n", "1")
            self.assertEqual(done.returncode, code, done.stdout + done.stderr)
            self.assertEqual("all members at this node release its rotation about (0, 1, 0)" in done.stderr, code == 2, done.stderr)
        self.refusal(gains, "  held: {static: {stations: [1]}}\n" + motion.replace(
            "radau", "radau, about: held"), "", "(static): load motor (feedback) acts only in motions, harmonic")
        self.refusal(gains + ", integral: 1", motion, "", "motor (feedback): the integral of the error cannot be stored; remove --save-state",
                     "--save-state", self.folder / "end.h5")


BAR = """beamwork: 1
sections:
  bar: {constants: {A: 1e-4, Iy: 1e-9, Iz: 1e-9, It: 1e-9}, young: 1e6, shear_modulus: 8e5}
nodes:
  wall: {at: [0, 0, 0], hold: all}
  mass: {at: [2, 0, 0], hold: [uy, uz, rx, ry, rz], mass: 0.5}
members:
  bar: {from: wall, to: mass, section: bar, y: [0, 1, 0], warping: free}
loads:
  drive: {elongation: %s, on: bar, %s}
analyses:
  run: {%s}
quantities:
  x: {displacement: {analysis: run, node: mass, component: ux}}
  N: {internal: {analysis: run, member: bar, end: to, resultant: N}}
omit: [trapeze, wagner_moments, wagner_torque]
"""


class Driven(ProgramTest):

    def solved(self, *words, code=0):
        path = self.folder / "scene.yaml"
        path.write_text(self.scene % words, encoding="utf-8")
        done = self.answered("solve", "--scene", path, "-f", "collocation", "-n", self.elements, "--format", "json",
                             code=code)
        return done.stdout + done.stderr if code else values(json.loads(done.stdout))


class Elongation(Driven):

    scene, elements = BAR, 2

    def test_linear(self):
        for part in ("", "from: 0.2, to: 0.7,"):
            self.assertAlmostEqual(self.solved("0.01", part, "linear: {}")["x"], 0.01, 12)

    def test_motion(self):
        t = 1.3
        x = 0.01 * (1 - 100 / 51 * np.cos(7 * t) + (100 / 51 - 1) * np.cos(10 * t))
        for scheme, step, near in (("radau", 0.01, 1e-7), ("alpha", 5e-4, 1e-4)):
            found = self.solved("0.01", "time: 1 - cos(7*t)",
                                f"motion: {{stations: [{t}], step: {step}, integrator: {scheme}}}")
            self.assertLess(abs(found["x"] - x), near)
            force = 50 * (x - 0.01 * (1 - np.cos(7 * t)))
            self.assertLess(abs(found["N"] - force), 100 * near)

    def test_refusals(self):
        motion = "motion: {stations: [1], step: 0.01, integrator: %s}"
        self.assertIn("an elongation cannot jump", self.solved(
            "0.01", "pieces: [{until: 0.5, is: 0}, {is: 1}]", motion % "radau", code=2))
        self.assertIn("(conserving): load drive changes in time", self.solved(
            "0.01", "time: 1 - cos(7*t)", motion % "conserving", code=2))
        self.assertIn("no temperature and no gradient", self.solved(
            "0.01", "gradient: [0, 1]", "linear: {}", code=2))
        self.assertIn("an elongation acts on the sections", self.solved(
            "0.01", "follower: true", "linear: {}", code=2))


BOOM = """beamwork: 1
sections:
  stiff: {constants: {A: 1, Iy: 1, Iz: 1, It: 1}, young: 1e12, shear_modulus: 1e12}
nodes:
  hinge: {at: [0, 0, 0], hold: [ux, uy, uz, rx, ry]}
  lug: {at: [1, 0, 0]}
  tip: {at: [2, 0, 0], mass: 50}
  top: {at: [0, 1, 0], hold: all}
members:
  inner: {from: hinge, to: lug, section: stiff, y: [0, 1, 0], warping: free}
  outer: {from: lug, to: tip, section: stiff, y: [0, 1, 0], warping: free}
springs:
  spring: {to: hinge, stiffness: [0, 0, 0, 0, 0, 1000]}
loads:
  pull: {tension: 800, on: lug, towards: top%s}
analyses:
  run: {%s}
quantities:
  angle: {displacement: {analysis: run, node: hinge, component: rz}}
  pulls: {reaction: {analysis: run, node: top, component: uy}}
omit: [trapeze, wagner_moments, wagner_torque]
"""


class Tension(Driven):

    scene, elements = BOOM, 1

    @staticmethod
    def lever(angle):
        """Returns minus the derivative of the distance between lug and top with respect to the angle."""
        return np.cos(angle) / np.sqrt(2 - 2 * np.sin(angle))

    def test_static(self):
        found = self.solved("", "static: {stations: [1]}")
        angle = found["angle"]
        self.assertAlmostEqual(1000 * angle / (800 * self.lever(angle)), 1, 8)
        self.assertAlmostEqual(found["pulls"], 800 * (1 - np.sin(angle)) / np.sqrt(
            2 - 2 * np.sin(angle)), 5)

    def test_motion(self):
        for words, force in (
                (", time: 1 + 0.2*sin(3*t)", lambda t, y: 800 * (1 + 0.2 * np.sin(3 * t))),
                (", time: 0.5, feedback: {node: hinge, component: rz, proportional: 3, derivative: 1, "
                 "integral: 2}", lambda t, y: 800 * (3 * (0.5 - y[0]) - y[1] + 2 * y[2]))):
            exact = solve_ivp(
                lambda t, y, force=force: [y[1], (force(t, y) * self.lever(y[0]) - 1000 * y[0]) /
                                           200, 0.5 - y[0]], (0, 1), [0, 0, 0], rtol=1e-10,
                atol=1e-12).y[0][-1]
            for scheme, step, near in (("radau", 0.005, 1e-7), ("alpha", 1e-3, 1e-5)):
                found = self.solved(
                    words, f"motion: {{stations: [1], step: {step}, integrator: {scheme}}}")
                self.assertLess(abs(found["angle"] - exact), near)

    def test_refusals(self):
        for words, analysis, text in (
                (", follower: true", "static: {stations: [1]}", "'towards' applies only to a tension"),
                (", time: t", "motion: {stations: [1], step: 0.01, integrator: conserving}",
                 "a tension between nodes")):
            self.assertIn(text, self.solved(words, analysis, code=2))


if __name__ == "__main__":
    unittest.main()
