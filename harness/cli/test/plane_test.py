"""plane: a scene that is held in its plane."""
import math

from harness.tools.kit.program import ROOT, ProgramTest

EXAMPLES = ROOT / "cases" / "examples"
E, G, RHO = 210e9, 81e9, 7850
LENGTH, HEIGHT, THICK = 1, 0.1, 0.002
# the strip is high in its plane and thin across it
STRIP = """beamwork: 1
name: strip
sections: {s: {rectangle: {width: 0.002, thickness: 0.1}, young: 210e9, shear_modulus: 81e9,
               density: 7850}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}
loads: {push: {force: [-1, 0, 0], on: b}}
analyses:
  buckling: {buckling: {}}
  modes: {modal: {}}
  path: {static: {stations: [1]}}
quantities:
  p: {critical_factor: {analysis: buckling}}
  f: {frequency: {analysis: modes}}
  g: {frequency: {analysis: modes, which: 1}}
  u: {displacement: {analysis: path, node: b, component: uy}}
omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia]
"""


FRAME = """beamwork: 1
name: frame
sections: {s: {rectangle: {width: 0.02, thickness: 0.01}, young: 210e9, shear_modulus: 81e9,
               density: 7850}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [0, 1, 0]}, c: {at: [1, 1.2, 0]},
        d: {at: [1, 0, 0], hold: [ux, uy, uz, rx, ry]}}
members:
  m: {from: a, to: b, section: s, y: [1, 0, 0]}
  n: {from: b, to: c, section: s, y: [0, 1, 0], release: {from: %s}}
  o: {from: c, to: d, section: s, y: [1, 0, 0]}
loads: {t: {force: [10, 0, 0], on: b}, q: {distributed: [0, -5, 0], on: n}}
analyses: {path: {static: {stations: [1]}}, modes: {modal: {}}, b: {buckling: {}}, l: {linear: {}}}
quantities:
  ux: {displacement: {analysis: path, node: b, component: ux}}
  uc: {displacement: {analysis: path, node: c, component: uy}}
  ul: {displacement: {analysis: l, node: b, component: ux}}
  mz: {internal: {analysis: path, member: m, resultant: Mz, end: from}}
  f: {frequency: {analysis: modes}}
  p: {critical_factor: {analysis: b}}
"""


def turned(text, plane):
    """The strip in another plane: its x and y become those two axes."""
    to = {"xy": (0, 1), "xz": (0, 2), "yz": (1, 2)}[plane]
    for old in ("[1, 0, 0]", "[0, 1, 0]", "[-1, 0, 0]"):
        x, y, _ = (int(v) for v in old[1:-1].split(","))
        new = [0, 0, 0]
        new[to[0]], new[to[1]] = x, y
        text = text.replace(old, "<" + ", ".join(str(v) for v in new) + ">")
    return text.replace("<", "[").replace(">", "]").replace(
        "component: uy", "component: u" + "xyz"[to[1]]) + f"plane: {plane}\n"


class Plane(ProgramTest):
    def solved(self, text, *options, formulation="collocation", n=16):
        path = self.folder / "scene.yaml"
        path.write_text(text)
        record = self.record("solve", "--scene", path, "-f", formulation, "-n", str(n), *options)
        return record, {q["quantity"]: q["value"] for q in record["quantities"]}

    def test_closed_forms(self):
        """What bends in the plane only: Euler's load, the frequencies of a clamped beam."""
        area, stiff = HEIGHT * THICK, E * THICK * HEIGHT**3 / 12
        soft = E * HEIGHT * THICK**3 / 12
        _, space = self.solved(STRIP)
        self.assertLess(abs(space["p"] / (math.pi**2 * soft / 4) - 1), 1e-3)
        for plane in ("xy", "xz", "yz"):
            record, found = self.solved(turned(STRIP, plane))
            self.assertEqual(record["cell"]["free"], 48)
            self.assertIn(f"held in the plane {plane}", record["cell"]["left_out"])
            self.assertLess(abs(found["p"] / (math.pi**2 * stiff / 4) - 1), 1e-3)
            for name, root in (("f", 1.8751040687), ("g", 4.6940911330)):
                exact = root**2 / (2 * math.pi) * math.sqrt(stiff / (RHO * area))
                self.assertLess(abs(found[name] / exact - 1), 0.02, (plane, name))

    def test_the_same_as_in_space(self):
        """Values of the plane, where what is stable in the plane is stable in space."""
        text = self.answered("scene", "elastica").stdout
        whole, space = self.solved(text)
        half, plane = self.solved(text + "plane: xy\n")
        self.assertEqual((whole["cell"]["free"], half["cell"]["free"]), (96, 48))
        for name, value in space.items():
            self.assertLess(abs(plane[name] / value - 1), 1e-9, name)
        for n in (1, 3, 64):  # in space members of many elements are condensed
            for formulation in ("beamw", "collocation"):
                _, space = self.solved(text, formulation=formulation, n=n)
                _, plane = self.solved(text + "plane: xy\n", formulation=formulation, n=n)
                for name, value in space.items():
                    self.assertLess(abs(plane[name] / value - 1), 1e-8, (formulation, n, name))

    def test_examples(self):
        """Rigid parts, releases, drives, a body and a motion in time."""
        for name in ("bent_leaf", "four_bar", "hinged_guide", "released_guide"):
            text = (EXAMPLES / f"{name}.yaml").read_text()
            _, space = self.solved(text, n=4)
            record, plane = self.solved(text + "\nplane: xy\n", n=4)
            self.assertIn("held in the plane xy", record["cell"]["left_out"])
            self.assertEqual(set(space), set(plane))
            compared = 0
            for key, value in space.items():
                if value is None or plane[key] is None:
                    continue
                compared += 1
                self.assertLess(abs(plane[key] - value), 1e-7 * max(abs(value), 1e-6),
                                (name, key, plane[key], value))
            self.assertGreater(compared, 0)

    def test_released_ends(self):
        """What would leave the plane of a released end is held as the rest."""
        values = []
        for release, plane in (("rz", ""), ("rz", "plane: xy\n"),
                               ("[rx, ry, rz]", "plane: xy\n"),
                               ("[uz, rx, rz]", "plane: xy\n")):
            _, found = self.solved(FRAME % release + plane, n=4)
            values.append(found)
        for found in values[1:]:
            for name, value in values[0].items():
                self.assertLess(abs(found[name] / value - 1), 1e-8, name)

    def test_keep_all(self):
        text = self.answered("scene", "elastica").stdout + "plane: xy\n"
        _, one = self.solved(text, n=4)
        _, other = self.solved(text, "--keep-all", n=4)
        for name, value in one.items():
            self.assertLess(abs(other[name] / value - 1), 1e-9)

    def test_warping_is_held(self):
        text = STRIP.replace("rectangle: {width: 0.002, thickness: 0.1}",
                             "constants: {A: 2e-3, Iy: 1e-6, Iz: 3e-6, It: 1e-9, Iw: 1e-9, "
                             "ys: 0.01}").replace("[-1, 0, 0]", "[0, 1, 0]")
        text = text.replace("  buckling: {buckling: {}}\n", "").replace(
            "  p: {critical_factor: {analysis: buckling}}\n", "")
        record, found = self.solved(text + "plane: xy\n", formulation="beamw", n=8)
        self.assertEqual(record["cell"]["free"], 24)
        self.assertLess(abs(found["u"] / (1 / (3 * E * 3e-6)) - 1), 1e-3)

    def test_written(self):
        path = self.folder / "scene.yaml"
        path.write_text(STRIP + "plane: xy\n")
        text = self.answered("scene", "--scene", path).stdout
        self.assertIn("\nplane: xy\n", text)
        self.assertEqual(self.solved(text)[1], self.solved(STRIP + "plane: xy\n")[1])
        self.assertIn("plane", self.answered("scene", "--keys").stdout)

    def test_what_leaves_it_is_refused(self):
        """One line that names the culprit."""
        held = STRIP + "plane: xy\n"
        node = "b: {at: [1, 0, 0]"
        changes = {
            "push: it acts out of the plane": ("[-1, 0, 0]", "[-1, 0, 1e-3]"),
            "push: it turns out of the plane": ("force: [-1, 0, 0]", "moment: [1, 0, 0]"),
            "push: it acts beside the plane":
                ("force: [-1, 0, 0]", "at: [0, 0, 0.1], force: [-1, 0, 0]"),
            "b: it does not lie in one plane": (node, "b: {at: [1, 0, 0.1]"),
            "b: the centre of its body lies beside":
                (node, node + ", mass: 1, centre: [0, 0, 0.1]"),
            "m: its initial curvature leaves":
                ("y: [0, 1, 0]}}", "y: [0, 1, 0], curvature: [0, 0.1, 0]}}"),
            "m: its initial strain leaves":
                ("y: [0, 1, 0]}}", "y: [0, 1, 0], strain: [0, 0, 1e-3]}}"),
            "m: it is released along or about":
                ("y: [0, 1, 0]}}", "y: [0, 1, 1], release: {from: rz}}}"),
        }
        path = self.folder / "scene.yaml"
        for words, (old, new) in changes.items():
            self.assertIn(old, held)
            text = held.replace(old, new)
            path.write_text(text)
            self.refused(2, words, "solve", "--scene", path, "-f", "collocation", "-n", "2")
        path.write_text(STRIP + "plane: zx\n")
        self.refused(2, "plane", "solve", "--scene", path)

    def test_motions_that_leave_it(self):
        text = STRIP.replace("b: {at: [1, 0, 0]}", "b: {at: [1, 0, 0], drive: {%s: d}}").replace(
            "loads:", "motions: {d: {path: [0, 1], value: [0, 1e-4]}}\nloads:")
        for component, out in (("uz", 1), ("rx", 1), ("ry", 1), ("uy", 0), ("rz", 0)):
            path = self.folder / "scene.yaml"
            path.write_text(text % component + "plane: xy\n")
            what = ("solve", "--scene", path, "-f", "collocation", "-n", "2")
            if out:
                self.refused(2, "b: it is", *what)
            else:
                self.answered(*what)

    def test_compliance(self):
        text = STRIP.replace("  modes: {modal: {}}\n",
                             "  modes: {modal: {}}\n  c: {compliance: {node: b}}\n")
        extra = "  k: {stiffness: {analysis: c, component: %s}}\nomit"
        _, found = self.solved(text.replace("omit", extra % "uy") + "plane: xy\n")
        self.assertLess(abs(found["k"] / (3 * E * THICK * HEIGHT**3 / 12) - 1), 1e-3)
        path = self.folder / "scene.yaml"
        path.write_text(text.replace("omit", extra % "uz") + "plane: xy\n")
        self.refused(2, "k: it is of a motion out of the plane", "solve", "--scene", path)

    def test_decks(self):
        path = self.folder / "scene.yaml"
        path.write_text(STRIP + "plane: xy\n")
        self.refused(2, "held in a plane", "export", "--scene", path, "--to", "calculix")
