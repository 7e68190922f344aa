"""Continuations must find the first critical points of a path, also if several coincide, with any step size."""
import json
import math
import unittest

from harness.tools.kit.program import ProgramTest, run

# E Iz = 1, L = 1. The critical load is P = (c pi)^2 E I, where c depends on the supports; shortening is negligible.
COLUMN = """beamwork: 1
sections: {s: {constants: {A: 1e6, Iy: %(Iy)r, Iz: 1, It: 1}, young: 1, shear_modulus: 1}}
nodes: {a: {at: [0, 0, 0], hold: %(a)s}, b: {at: [1, 0, 0]%(b)s}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}
loads: {p: {force: [-1, 0, 0], on: b}%(more)s}
analyses: {path: {continuation: {control: {node: b, component: ux}, by: coordinate, to: [-%(to)r],
                                 step: %(step)r, step_max: %(step)r}}}
quantities:
  P_$i: {for: {i: 0..3}, critical_point: {analysis: path, kind: bifurcation, which: $i}, unit: N}
omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia]
"""
ARCH = """beamwork: 1
sections: {s: {constants: {A: 1e4, Iy: 10, Iz: 1, It: 1}, young: 1, shear_modulus: 1}}
nodes: {a: {at: [-1, 0, 0], hold: [ux, uy, uz, rx, ry]}, t: {at: [0, 0.12, 0]},
        b: {at: [1, 0, 0], hold: [ux, uy, uz, rx, ry]}}
members: {l: {from: a, to: t, section: s, y: [0, 1, 0]},
          r: {from: t, to: b, section: s, y: [0, 1, 0]}}
loads: {p: {force: [0, -1, 0], on: t}%(more)s}
analyses: {path: {continuation: {control: {node: t, component: uy}, by: coordinate, to: [-0.24],
                                 step: %(step)r, step_max: %(step)r}}}
quantities:
  b_$i: {for: {i: 0..1}, critical_point: {analysis: path, kind: bifurcation, which: $i}, unit: N}
  l_$i: {for: {i: 0..1}, critical_point: {analysis: path, kind: limit, which: $i}, unit: N}
omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia]
"""
SHAFT = """beamwork: 1
sections: {s: {constants: {A: 1e6, Iy: %(Iy)r, Iz: 1, It: %(It)r}, young: 1, shear_modulus: 1}}
nodes: {a: {at: [0, 0, 0], hold: [ux, uy, uz]}, c: {at: [0.5, 0, 0], hold: [rx]},
        b: {at: [1, 0, 0], hold: [uy, uz]}}
members: {l: {from: a, to: c, section: s, y: [0, 1, 0]},
          r: {from: c, to: b, section: s, y: [0, 1, 0]}}
loads: {p: {force: [-1, 0, 0], on: b}, t: {moment: [%(m)r, 0, 0], on: b},
        u: {moment: [-%(m)r, 0, 0], on: a}}
analyses: {path: {continuation: {control: {node: b, component: ux}, by: coordinate, to: [-%(to)r],
                                 step: %(step)r, step_max: %(step)r}}}
quantities:
  P_$i: {for: {i: 0..3}, critical_point: {analysis: path, kind: bifurcation, which: $i}, unit: N}
omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia]
"""
PASSING = """beamwork: 1
sections: {s: {constants: {A: 1e6, Iy: 1, Iz: 1000, It: 1000}, young: 1, shear_modulus: 1}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}
loads: {p: {force: [0, 1, 0], on: b}, q: {force: [-5, 0, 0], on: b, factor: %(factor)s, path: %(path)s}}
analyses: {path: {continuation: {control: {node: b, component: uy}, by: coordinate, to: [0.01],
                                 step: %(step)r, step_max: %(step)r}}}
quantities:
  P_$i: {for: {i: 0..3}, critical_point: {analysis: path, kind: bifurcation, which: $i}, unit: N}
omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia]
"""
BESIDE = """beamwork: 1
sections: {s: {constants: {A: 1e6, Iy: 3, Iz: 1, It: 1}, young: 1, shear_modulus: 1, density: 1e-6}}
nodes: {a: {at: [0, 0, 0], hold: [ux, uy, uz, rx]}, b: {at: [1, 0, 0], hold: [uy, uz, rx]}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}
loads: {p: {force: [-1, 0, 0], on: b}%s}
analyses: {s: {static: {stations: [1]}}, b: {buckling: {about: s}}, m: {modal: {}}, a: {modal: {about: s}}}
quantities:
  P_$i: {for: {i: 0..1}, critical_factor: {analysis: b, which: $i}}
  f_$i: {for: {i: 0..3}, frequency: {analysis: m, which: $i}, unit: Hz}
  g_$i: {for: {i: 0..3}, frequency: {analysis: a, which: $i}, unit: Hz}
omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia]
"""
TWISTED_BY_ARMS = """beamwork: 1
sections: {s: {constants: {A: 1e6, Iy: 1, Iz: 1, It: 1}, young: 1, shear_modulus: 1}}
nodes: {a: {at: [0, 0, 0], hold: [ux, uy, uz, rx]}, b: {at: [1, 0, 0], hold: [uy, uz]},
        c: {at: [1, 0.5, 0], part_of: b}, d: {at: [1, -0.5, 0], part_of: b}}
members: {l: {from: a, to: b, section: s, y: [0, 1, 0]}}
loads: {p: {force: [-1, 0, 0], on: b}, t: {force: [0, 0, %r], on: c}, u: {force: [0, 0, %r], on: d}}
analyses: {lin: {buckling: {}}}
quantities:
  P_$i: {for: {i: 0..1}, critical_factor: {analysis: lin, which: $i}, unit: 1}
omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia]
"""
FOLLOWED = COLUMN.replace("{p: {force: [-1, 0, 0], on: b}%(more)s}",
                          "{p: {force: [%(fixed)r, 0, 0], on: b}, "
                          "f: {force: [%(eta)r, 0, 0], on: b, follower: true}}") \
                 .replace("%(a)s", "all").replace("%(b)s", "")
PINNED = {"a": "[ux, uy, uz, rx]", "b": ", hold: [uy, uz, rx]", "more": ""}
CLAMPED = {"a": "all", "b": "", "more": ""}
ZERO = ("", ", z: {moment: [0, 0, 0], on: b}", ", z: {force: [0, 0, 0], on: b, follower: true}",
        ", z: {distributed_moment: [0, 0, 0], on: m}")
PI2 = math.pi ** 2


class MultiplePoints(ProgramTest):

    def points(self, formulation="collocation", n=8, scene=COLUMN, **column):
        path = self.folder / "scene.yaml"
        path.write_text(scene % column)
        done = run("solve", "--scene", path, "-f", formulation, "-n", n, "--format", "json")
        self.assertEqual(done.returncode, 0, (column, done.stdout + done.stderr))
        return [q.get("value") for q in json.loads(done.stdout)["quantities"]]

    def near(self, found, exact, part, *about):
        for value, right in zip(found, exact):
            self.assertIsNotNone(value, (found, about))
            self.assertLess(abs(value / right - 1), part, (found, about))

    def test_equal_and_almost_equal(self):
        for off in (0, 1e-9, -1e-9, 1e-6, -1e-6, 1e-3, -1e-3):
            for step in (1e-6, 1e-5, 4.5e-5):
                self.near(self.points(Iy=1 + off, step=step, to=4.5e-5, **PINNED),
                          (PI2, PI2, 4 * PI2, 4 * PI2), 2e-3, off, step)

    def test_formulations(self):
        for formulation in ("collocation", "geometrically_exact", "beamw", "beamw_consistent"):
            for n in (8, 16):
                self.near(self.points(formulation, n, Iy=1, step=3e-5, to=3e-5, **CLAMPED),
                          [PI2 / 4] * 2 + [9 * PI2 / 4] * 2, 2e-2, formulation, n)

    def test_zero_loads(self):
        for ends in (PINNED, CLAMPED):
            for Iy in (1, 3):
                found = [self.points(Iy=Iy, step=1e-3, to=1e-3, **{**ends, "more": more})
                         for more in ZERO]
                for other in found[1:]:
                    self.assertEqual(other, found[0], (ends, Iy))
        self.near(self.points(Iy=3, step=1e-3, to=1e-3, **PINNED), (PI2, 3 * PI2, 4 * PI2), 1e-3)

    def test_lost_and_regained(self):
        fine = self.points(n=4, scene=ARCH, step=0.0024, more="")
        self.near(fine, (2.15466, -0.612777, 2.99647, -0.620572), 1e-5)
        for step in (0.024, 0.08, 0.24):
            for more in ZERO[:2] if step == 0.24 else ZERO[:1]:
                more = more.replace("on: b", "on: t")
                self.near(self.points(n=4, scene=ARCH, step=step, more=more), fine, 1e-7, step)

    def test_greenhill(self):
        """A round shaft under thrust P and a torque m P of fixed direction has double points at (m P/2)^2 + P =
        pi^2, where the determinant does not change sign. With slightly different second moments, each double
        point becomes two points."""
        for m in (1e-8, 0.1, 0.5, 2):
            exact = PI2 if m < 1e-3 else 2 * (math.sqrt(1 + m ** 2 * PI2) - 1) / m ** 2
            for twist in (1, 1e4):
                for step in (2e-6, 1.5e-5):
                    end = 0.5e-5 if m == 2 else 1.5e-5
                    found = self.points(n=4, scene=SHAFT, Iy=1, It=twist, m=m, to=end, step=step)
                    self.near(found, (exact, exact), 1e-4, m, twist, step)
                    self.assertEqual(found[2:], [None, None])
        for Iy in (1.02, 3):
            fine = self.points(n=4, scene=SHAFT, Iy=Iy, It=1e4, m=0.5, to=1.5e-5, step=1e-6)
            self.assertEqual(fine[2:], [None, None])
            for step in (3e-6, 1.5e-5):
                self.near(self.points(n=4, scene=SHAFT, Iy=Iy, It=1e4, m=0.5, to=1.5e-5, step=step),
                          fine[:2], 1e-8, Iy, step)

    def test_partly_following(self):
        for eta in (0.2, 0.4, 0.49, 0.4999, 0.501, 1):
            self.follow(eta, 1, (1e-6, 3e-6, 1e-5))
        self.follow(0.4, 3, (1e-6, 3e-6, 1e-5, 3e-5))

    def follow(self, eta, Iy, steps):
        exact = [math.acos(-eta / (1 - eta)) if eta < 0.5 else None]
        exact = [exact[0] ** 2, (2 * math.pi - exact[0]) ** 2] if eta < 0.5 else []
        exact = sorted(exact * 2 if Iy == 1 else exact + [exact[0] * Iy])
        for step in steps:
            found = self.points(n=16, scene=FOLLOWED, Iy=Iy, fixed=-(1 - eta), eta=-eta, to=2e-5,
                                step=step)
            self.near(found, exact, 2e-4, eta, Iy, step)
            self.assertEqual(found[len(exact):], [None] * (4 - len(exact)), (eta, step))

    def test_words_without_symmetry(self):
        for density, said in ((0, ["no divergence"] * 3 + ["unstable (2)"] * 3),
                              (1e-9, ["stable"] * 3 + ["unstable: grows"] * 3)):
            path = self.folder / "scene.yaml"
            path.write_text((FOLLOWED % {"Iy": 1, "fixed": -0.8, "eta": -0.2, "to": 6e-6,
                                         "step": 1e-6})
                            .replace("young: 1,", "young: 1, density: %r," % density))
            done = run("solve", "--scene", path, "-f", "collocation", "-n", 8, "--format", "json")
            self.assertEqual([step["stability"] for step in json.loads(done.stdout)["steps"]], said)

    def test_frequencies_judge_what_the_determinant_does_not(self):
        path = self.folder / "scene.yaml"
        for density, said in ((0, ["no divergence"] * 6), (1e-9, ["stable"] * 4 + ["unstable: grows"] * 2)):
            path.write_text((FOLLOWED % {"Iy": 2, "fixed": 0.0, "eta": -1.0, "to": 3e-5, "step": 5e-6})
                            .replace("young: 1,", "young: 1, density: %r," % density))
            done = run("solve", "--scene", path, "-f", "geometrically_exact", "-n", 8, "--format", "json")
            self.assertEqual([step["stability"] for step in json.loads(done.stdout)["steps"]], said)

    def test_passing_thrust(self):
        for middle in (0.21, 0.25, 0.28, 0.33, 0.42, 0.5, 0.58, 0.67, 0.75, 0.79):
            found = self.points(n=4, scene=PASSING, factor=[0, 0, 1, 0, 0], step=0.01,
                                path=[0] + [30 * (middle + away) for away in (-0.2, 0, 0.2)] + [40])
            self.near([found[1] - found[0], found[0] + found[1]], (30 * 0.202, 60 * middle), 5e-3, middle)
            self.assertEqual(found[2:], [None, None])
        path = [0] + [30 * part for part in (0.05, 0.25, 0.45, 0.55, 0.75, 0.95)] + [40]
        fine, whole = [self.points(n=4, scene=PASSING, factor=[0, 0, 1, 0, 0, 1, 0, 0], path=path, step=step)
                       for step in (5e-4, 0.01)]
        self.near(whole, fine, 1e-7)

    def test_static_paths_are_looked_into(self):
        path = self.folder / "scene.yaml"
        for more, well in (("", "stable"), (", z: {moment: [1e-3, 0, 0], on: b}", "no divergence")):
            for middle in (0.21, 0.3, 0.5, 0.66, 0.79):
                text = PASSING % {"factor": [0, 0, 1, 0, 0], "path": [0, middle - 0.2, middle, middle + 0.2, 1], "step": 1}
                text = text[:text.index("analyses:")].replace("[0, 1, 0], on: b}", "[0, 30, 0], on: b}" + more)
                path.write_text(text + "analyses: {st: {static: {stations: [1]}}}\n"
                                "quantities: {u: {displacement: {analysis: st, node: b, component: uy}}}\n")
                done = run("solve", "--scene", path, "-f", "collocation", "-n", 4, "--format", "json")
                said = [step["stability"] for step in json.loads(done.stdout)["steps"]]
                self.assertIn("unstable (1)", said, (more, middle))
                self.assertEqual(said[-1], well, (more, middle))

    def test_what_is_undecided_is_said(self):
        path = self.folder / "scene.yaml"
        for step in (2e-6, 1.2e-5):
            path.write_text(FOLLOWED % {"Iy": 3, "fixed": -0.5, "eta": -0.5, "to": 1.2e-5,
                                        "step": step})
            done = run("solve", "--scene", path, "-f", "collocation", "-n", 8, "--format", "json")
            self.assertEqual(done.returncode, 1, done.stdout)
            for q in json.loads(done.stdout)["quantities"]:
                self.assertIsNone(q.get("value"))
                self.assertRegex(q["reason"], "undecided: between load factors 9.8[67][0-9]* and 9.8[67]")

    def test_held_turn_under_torque(self):
        for step in (1.5e-5, 1.5e-6):
            path = self.folder / "scene.yaml"
            path.write_text(COLUMN % {"a": "[ux, uy, uz, rx]", "b": ", hold: [uy, uz]", "Iy": 1, "step": step, "to": 1.5e-5,
                                      "more": ", t: {moment: [0.5, 0, 0], on: b, factor: [1, 1], path: [0, 1]}"})
            done = run("solve", "--scene", path, "-f", "collocation", "-n", 8, "--format", "json")
            self.assertEqual(done.returncode, 0, done.stdout)
            found = [q.get("value") for q in json.loads(done.stdout)["quantities"]]
            self.near(found, [PI2 - 0.0625] * 2, 1e-4, step)
            self.assertEqual(found[2:], [None, None])

    def test_held_turn_in_linear_buckling(self):
        for arms, found in ((1, None), (0, [PI2, PI2])):
            path = self.folder / "scene.yaml"
            path.write_text(TWISTED_BY_ARMS % (arms, -arms))
            done = run("solve", "--scene", path, "-f", "collocation", "-n", 8, "--format", "json")
            if found is None:
                self.assertNotEqual(done.returncode, 0)
                self.assertIn("the moment that holds rx of node a", done.stdout + done.stderr)
            else:
                self.near([q["value"] for q in json.loads(done.stdout)["quantities"]], found, 1e-4)

    def test_found_beside_zero_loads(self):
        for more in ZERO[1:]:
            for formulation, n in (("collocation", 24), ("geometrically_exact", 24)):
                with_it, without = (self.found_beside(one, formulation, n) for one in (more, ""))
                self.assertEqual(with_it, without, (more, formulation))
                self.near(with_it[:2], (PI2, 3 * PI2), 1e-2, more, formulation)

    def found_beside(self, more, formulation, n):
        path = self.folder / "scene.yaml"
        path.write_text(BESIDE % more)
        done = run("solve", "--scene", path, "-f", formulation, "-n", n, "--format", "json")
        self.assertEqual(done.returncode, 0, (more, done.stdout + done.stderr))
        return [q["value"] for q in json.loads(done.stdout)["quantities"]]

    def test_stability_of_steps(self):
        path = self.folder / "scene.yaml"
        path.write_text(COLUMN % {**CLAMPED, "Iy": 1, "step": 1e-6, "to": 5e-6})
        done = run("solve", "--scene", path, "-f", "collocation", "-n", 8, "--format", "json")
        said = [step["stability"] for step in json.loads(done.stdout)["steps"]]
        self.assertEqual(said, ["stable"] * 2 + ["unstable (2)"] * 3)

    def test_rounding(self):
        exact = {"bifurcation_load": 0.8681346606, "deflection_at_limit": 48.7351372}
        for n in 24, 96:
            done = run("solve", "lee_frame", "--set", "plane=0", "-f", "geometrically_exact", "-n", n, "--format", "json")
            found = {q["quantity"]: q for q in json.loads(done.stdout)["quantities"]}
            for name, right in exact.items():
                error, rounding = abs(found[name]["value"] / right - 1), found[name]["rounding"]
                self.assertLess(rounding, 1e-3)
                if n == 96:
                    self.assertLess(error, rounding)
                    self.assertGreater(rounding, 1e-5)
                else:
                    self.assertLess(rounding, 5e-6)
        scene = COLUMN.replace("analyses: {", "analyses: {push: {static: {stations: [0.5]}}, about: {buckling: {about: push}}, ") \
                      .replace("which: $i}, unit: N}", "which: $i}, unit: N}\n  f: {critical_factor: {analysis: about}}") \
                      .replace("A: 1e6", "A: 100")
        path = self.folder / "scene.yaml"
        path.write_text(scene % {**CLAMPED, "Iy": 2, "step": 0.01, "to": 0.05})
        coarse, fine = ({q["quantity"]: q for q in json.loads(run(
            "solve", "--scene", path, "-f", "geometrically_exact", "-n", n, "--format", "json").stdout)["quantities"]}
                        for n in (64, 256))
        for name in "P_0", "f":
            error = abs(fine[name]["value"] / coarse[name]["value"] - 1)
            self.assertLess(error, fine[name]["rounding"])
            self.assertTrue(1e-6 < fine[name]["rounding"] < 1e-3, name)
        out = run("solve", "lee_frame", "--set", "plane=0", "-f", "geometrically_exact", "-n", 96).stdout
        self.assertRegex(out, r"bifurcation at -8\.34\d* m, load factor 0\.8681\d?:")
        self.assertRegex(out, r"bifurcation_load +0\.8681\d* N .*, round-off \d\.\de-04")


if __name__ == "__main__":
    unittest.main()
