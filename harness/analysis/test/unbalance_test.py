"""Synchronous response to an unbalance of the Jeffcott rotor, and of an overhung disc with gyroscopic moments on general
bearings."""
import re

import numpy as np

from harness.tools.kit.program import ProgramTest, run

# A disc at the end of a shaft along x that is clamped at its root. A bearing supports the disc.
SCENE = """beamwork: 1
let: {E: 210e9, I: 5e-10, L: 0.4}
sections: {shaft: {constants: {A: 1e-4, Iy: I, Iz: I, It: 1e-9}, young: E, shear_modulus: 8e10}}
nodes:
  root: {at: [0, 0, 0], %(root)s}
  disc: {at: [L, 0, 0], %(disc)s, mass: 2, inertia: [0.01, 0.006, 0.006, 0, 0, 0]}
members: {shaft: {from: root, to: disc, section: shaft, y: [0, 1, 0]}}
springs:
  bearing: {to: disc, stiffness: [%(stiffness)s], damping: [%(damping)s]}
%(motions)sanalyses:
  steady: {harmonic: {frequencies: [2, 5, 11, 30, 90]%(solution)s}}
quantities:
%(quantities)s
omit: [shear, trapeze, wagner_moments, wagner_torque]
"""
HERTZ = 2, 5, 11, 30, 90
E, I, L, MASS = 210e9, 5e-10, 0.4, 2.0
SIX = "ux", "uy", "uz", "rx", "ry", "rz"


def matrix(**entries):
    out = np.zeros((6, 6))
    for name, value in entries.items():
        row, column = name.split("_")
        out[SIX.index(row), SIX.index(column)] = value
    return out


def read(component, axis="rx", **more):
    keys = {"node": "disc", "component": component, "unbalance": "disc", "about": axis, **more}
    name = f"{more.get('of', component)}_{axis}"
    return "".join(f"  {name}_{part}: {{response: {{analysis: steady, part: {part}, take: curve, "
                   + ", ".join(f"{k}: {v}" for k, v in keys.items()) + "}}\n" for part in ("real", "imaginary"))


def text(**keys):
    keys = {"root": "hold: all", "disc": "hold: [ux, rx]", "solution": "", "stiffness": np.zeros((6, 6)),
            "damping": np.zeros((6, 6)), "motions": "", **keys}
    for name in ("stiffness", "damping"):
        keys[name] = ", ".join(map(repr, map(float, keys[name].ravel())))
    return SCENE % keys


class Unbalance(ProgramTest):

    def solved(self, scene):
        path = self.folder / "scene.yaml"
        path.write_text(scene, encoding="utf-8")
        record = self.record("solve", "--scene", path, "-f", "collocation", "-n", 1)
        curves = {c["quantity"]: np.array(c["curve_value"]) for c in record["curves"]}
        return {name[:-5]: values + 1j*curves[name[:-5] + "_imaginary"]
                for name, values in curves.items() if name.endswith("_real")}

    def test_jeffcott(self):
        """In forward whirl, the response must be y + i z = w^2/(K - i q - m w^2 + i c w), where z lags y by 90
        degrees. K and q are the stiffness and its cross-coupled part, c is the damping, m the mass, and w the
        angular velocity."""
        K = 3*E*I/L**3
        for film, cross, damping in ((0, 0, 30), (4e3, 1e3, 40)):
            scene = text(disc="hold: [ux, rx]", stiffness=matrix(uy_uy=film, uz_uz=film, uy_uz=cross, uz_uy=-cross),
                         damping=matrix(uy_uy=damping, uz_uz=damping), quantities=read("uy") + read("uz"))
            found = self.solved(scene.replace(", inertia: [0.01, 0.006, 0.006, 0, 0, 0]", ""))
            for i, hertz in enumerate(HERTZ):
                w = 2*np.pi*hertz
                Z = w*w/(K + film - 1j*cross - MASS*w*w + 1j*damping*w)
                self.assertAlmostEqual(found["uy_rx"][i]/Z, 1, 9)
                self.assertAlmostEqual(found["uz_rx"][i]/Z, -1j, 9)

    def overhung(self, hertz, speed, k, c, axis_forces):
        w = 2*np.pi*hertz
        b = E*I/L**3
        K = np.array([[12, 0, 0, -6*L], [0, 12, 6*L, 0], [0, 6*L, 4*L*L, 0], [-6*L, 0, 0, 4*L*L]])*b
        K[:2, :2] += k
        M = np.diag([MASS, MASS, 0.006, 0.006])
        C = np.zeros((4, 4))
        C[:2, :2] = c
        C[2, 3], C[3, 2] = 0.01*speed, -0.01*speed
        return np.linalg.solve(K + 1j*w*C - w*w*M, w*w*np.array(axis_forces))

    def test_bearings(self):
        k, c, speed = np.array([[9e3, 2e3], [-1e3, 5e3]]), np.array([[90, 5], [5, 60.]]), 2*np.pi*11
        stiff = matrix(uy_uy=k[0, 0], uy_uz=k[0, 1], uz_uy=k[1, 0], uz_uz=k[1, 1])
        damp = matrix(uy_uy=c[0, 0], uy_uz=c[0, 1], uz_uy=c[1, 0], uz_uz=c[1, 1], ry_rz=0.01*speed, rz_ry=-0.01*speed)
        found = self.solved(text(stiffness=stiff, damping=damp, quantities="".join(map(read, ("uy", "uz", "ry", "rz")))))
        for i, hertz in enumerate(HERTZ):
            expected = self.overhung(hertz, speed, k, c, [1, -1j, 0, 0])
            for name, value in zip(("uy", "uz", "ry", "rz"), expected):
                self.assertLess(abs(found[f"{name}_rx"][i] - value), 1e-9*np.abs(expected).max(), (name, hertz))

    def test_modal(self):
        damp, parts = matrix(uy_uy=50, uz_uz=20), "".join(map(read, ("uy", "uz", "ry", "rz")))
        stiff = matrix(uy_uy=4e3, uz_uz=9e3)
        direct, modal = (self.solved(text(stiffness=stiff, damping=damp, quantities=parts, solution=solution))
                         for solution in ("", ", solution: modal"))
        for name, values in direct.items():
            self.assertLess(np.abs(modal[name] - values).max(), 1e-8*np.abs(values).max(), name)

    def test_axes(self):
        free = text(root="hold: all", disc="hold: [rx, ry, rz]", stiffness=matrix(ux_ux=1e4, uy_uy=2e4, uz_uz=3e4),
                    damping=matrix(ux_ux=30, uy_uy=30, uz_uz=30),
                    quantities="".join(read(c, axis) for axis in ("rx", "ry", "rz") for c in ("ux", "uy", "uz")))
        found = self.solved(free.replace(", inertia: [0.01, 0.006, 0.006, 0, 0, 0]", ""))
        b = 12*E*I/L**3
        k = [1e4 + E*1e-4/L, 2e4 + b, 3e4 + b]
        for axis in range(3):
            for later in range(3):
                component = (axis + later) % 3
                for i, hertz in enumerate(HERTZ):
                    w = 2*np.pi*hertz
                    x = (0, 1, -1j)[later]*w*w/(k[component] - MASS*w*w + 30j*w)
                    self.assertLess(abs(found[f"{SIX[component]}_{SIX[3 + axis]}"][i] - x), 1e-9*max(abs(x), 1e-6))

    def test_reaction(self):
        found = self.solved(text(disc="hold: [ux, rx], drive: {uy: still}",
                                 motions="motions: {still: {unit: m, path: [0, 1], value: [0, 0]}}\n",
                                 quantities=read("uy", of="reaction") + read("uz")))
        for i, hertz in enumerate(HERTZ):
            tilted = found["reaction_rx"][i]/(2*np.pi*hertz)**2
            self.assertAlmostEqual(tilted, -1, 9)

    def test_units(self):
        lines = []
        for name, component, part in (("shift", "uy", "real"), ("rate", "uy, of: velocity", "imaginary"), ("turn", "rz", "real")):
            lines.append(f"  {name}: {{response: {{analysis: steady, node: disc, component: {component}, part: {part}, "
                         "unbalance: disc, at: 5}}\n")
        scene = text(stiffness=matrix(), quantities="".join(lines)).replace("mass: 2, inertia: [0.01, 0.006, 0.006, 0, 0, 0]", "mass: 2e-3")
        scene = scene.replace("beamwork: 1", "beamwork: 1\nunits: mm, N, MPa", 1).replace(
            "E: 210e9, I: 5e-10, L: 0.4", "E: 210e3, I: 500, L: 400").replace("A: 1e-4", "A: 100").replace("8e10", "8e4")
        (self.folder / "scene.yaml").write_text(scene, encoding="utf-8")
        record = self.record("solve", "--scene", self.folder / "scene.yaml", "-f", "collocation", "-n", 1)
        w = 10*np.pi
        shift = 1000*w*w/(3*E*I/L**3 - MASS*w*w)    # [mm/(kg m)], where 1 kg m is 1 N s^2
        expected = {"shift": (shift, "mm/(N s^2)"), "rate": (w*shift, "mm/(N s^3)"), "turn": (1.5e-3*shift/L, "rad/(N s^2)")}
        for q in record["quantities"]:
            value, unit = expected[q["quantity"]]
            self.assertAlmostEqual(q["value"]/value, 1, 9)
            self.assertEqual(q["unit"], unit)

    def test_refused(self):
        for more, words in (("force: disc", "unbalance"), ("about: ux", "rx|ry|rz")):
            scene = text(quantities=read("uy", **dict([more.split(": ")])))
            (self.folder / "scene.yaml").write_text(scene, encoding="utf-8")
            done = run("solve", "--scene", self.folder / "scene.yaml", "-f", "collocation", "-n", 1)
            self.assertEqual(done.returncode, 2, done.stdout)
        scene = text(disc="hold: [ux, uy, uz, rx]", quantities=read("ry"))
        (self.folder / "scene.yaml").write_text(scene, encoding="utf-8")
        done = run("solve", "--scene", self.folder / "scene.yaml", "-f", "collocation", "-n", 1)
        self.assertIn("a force along a fixed or driven component of node disc", re.sub(r"\s+", " ", done.stdout + done.stderr))
