"""Loads that begin, end or act within a member lie at nodes of the mesh: resultants on either side of
jumps by statics, the same as with members that end there, in either order of the member's nodes, and
orders of convergence as without such loads."""
import json
import math
import unittest

from harness.tools.kit.program import ProgramTest, run

SECTION = """sections: {s: {constants: {A: 0.04, Iy: 3e-4, Iz: 2e-4, It: 4e-4,
               F: [0.001, 0, 0, 0, 0.001, 0, 0, 0, 0]}, young: 70e3, shear_modulus: 27e3}}
"""
# Hinged, length 1: 1 at 0.3, and from 2 at 0.5 to 4 at 0.8; at its first end acts this.
ROOT = -(0.7 + 2 * 0.3 * 0.35 + 2 * 0.15 * 0.3)
HINGED = "beamwork: 1\n" + SECTION + """nodes: {a: {at: [0, 0, 0], hold: [ux, uy, uz, rx]},
        b: {at: [1, 0, 0], hold: [ux, uy, uz]}%s}
members: {%s}
loads: {%s}
analyses: {li: {linear: {}}}
quantities:
"""
WHOLE = HINGED % ("", "beam: {from: a, to: b, section: s, y: [0, 1, 0]}",
                  "f: {force: [0, 1, 0], on: beam, where: 0.3}, d: {distributed: [0, 2, 0], "
                  "on: beam, from: 0.5, to: 0.8, to_value: [0, 4, 0]}")
TURNED = HINGED % ("", "beam: {from: b, to: a, section: s, y: [0, 1, 0]}",
                   "f: {force: [0, 1, 0], on: beam, where: 0.7}, d: {distributed: [0, 4, 0], "
                   "on: beam, from: 0.2, to: 0.5, to_value: [0, 2, 0]}")
CUT = HINGED % (", c: {at: [0.3, 0, 0]}, d: {at: [0.5, 0, 0]}, e: {at: [0.8, 0, 0]}",
                ", ".join("m%s: {from: %s, to: %s, section: s, y: [0, 1, 0]}" % (p + q, p, q)
                          for p, q in ("ac", "cd", "de", "eb")),
                "f: {force: [0, 1, 0], on: c}, d: {distributed: [0, 2, 0], on: mde, "
                "to_value: [0, 4, 0]}")
ARC = """beamwork: 1
sections: {s: {constants: {A: 1.0e-2, Iy: 1e-6, Iz: 1e-6, It: 2e-6,
               F: [0.001, 0, 0, 0, 0.001, 0, 0, 0, 0]}, young: 1e9, shear_modulus: 4e8}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [%.17g, 0, 0]}}
members: {beam: {from: a, to: b, section: s, y: [0, 1, 0], curvature: [0, 0, 1]}}
loads: {f: {force: [10, 200, 30], on: beam, where: 0.3}, d: {distributed: [0, 100, 50], on: beam,
        from: 0.5, to: 0.8, to_value: [0, 400, 0]}}
analyses: {st: {static: {stations: [1]}}}
quantities: {u: {displacement: {analysis: st, node: b, component: uy}},
             w: {displacement: {analysis: st, node: b, component: uz}},
             M: {internal: {analysis: st, member: beam, where: 0.5, resultant: Mz}}}
""" % (2 * math.sin(0.5))


def internal(name, member, where, resultant, side="to", sign=1):
    return (f"  {name}: {{internal: {{analysis: li, member: {member}, where: {where}, side: {side}, "
            f"resultant: {resultant}}}, factor: {sign}, unit: N}}\n")


class DividedMember(ProgramTest):
    def solve(self, text, formulation, elements):
        path = self.folder / "scene.yaml"
        path.write_text(text, encoding="utf-8")
        done = run("solve", "--scene", path, "-f", formulation, "-n", elements, "--format", "json")
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)
        return {v["quantity"]: v["value"] for v in found["quantities"]}, found["cell"]

    def test_either_side_of_a_jump_with_one_element(self):
        listed = json.loads(run("list", "--format", "json").stdout)["formulations"]
        text = (WHOLE + internal("before", "beam", 0.3, "Qy", "from")
                + internal("behind", "beam", 0.3, "Qy") + internal("end", "beam", 0.8, "Qy")
                + internal("M", "beam", 0.5, "Mz"))
        expected = {"before": -ROOT, "behind": -ROOT - 1, "end": -ROOT - 1.9,
                    "M": ROOT * 0.5 + 1 * 0.2}
        for formulation in (f["formulation"] for f in listed):
            with self.subTest(formulation):
                found, cell = self.solve(text, formulation, 1)
                for name, value in expected.items():
                    self.assertAlmostEqual(found[name], value, delta=1e-9, msg=name)
                self.assertEqual(cell["elements_total"], 4)
                self.assertEqual(cell["divided"], "beam has 4 elements, 1 in each of 4 pieces: its "
                                 "loads begin, end or act at 0.3, 0.5, 0.8 of its length")

    def test_members_that_end_there_and_turned_ones(self):
        turn = "  t: {displacement: {analysis: li, node: b, component: rz}}\n"
        whole, _ = self.solve(WHOLE + turn + internal("Q", "beam", 0.3, "Qy", "from")
                              + internal("M", "beam", 0.6, "Mz"), "collocation", 2)
        cut, cell = self.solve(CUT + turn + internal("Q", "mac", 1, "Qy")
                               + internal("M", "mde", 1 / 3, "Mz"), "collocation", 2)
        turned, _ = self.solve(TURNED + turn + internal("Q", "beam", 0.7, "Qy", "to", -1)
                               + internal("M", "beam", 0.4, "Mz", "to", -1), "collocation", 2)
        self.assertEqual(cell["divided"], "")
        for name, value in whole.items():
            self.assertAlmostEqual(cut[name], value, delta=1e-12, msg=name)
            self.assertAlmostEqual(abs(turned[name]), abs(value), delta=1e-12, msg=name)

    def test_orders_on_an_arc(self):
        for formulation in ("collocation", "geometrically_exact"):
            values = [self.solve(ARC, formulation, n)[0] for n in (1, 2, 4, 8)]
            for name in ("u", "w", "M"):
                step = [values[i + 1][name] - values[i][name] for i in range(3)]
                for i in range(2):
                    if abs(step[i + 1]) < 1e-11 * abs(values[0][name]):
                        continue  # rounding: collocation has loads in its equilibrium
                    order = math.log2(abs(step[i] / step[i + 1]))
                    self.assertGreater(order, 3.6, f"{formulation}, {name}")

    def test_places_side_by_side_are_refused_where_resultants_are_asked(self):
        text = WHOLE.replace("from: 0.5", "from: 0.3001")
        self.solve(text + "  t: {displacement: {analysis: li, node: b, component: rz}}\n",
                   "collocation", 1)
        path = self.folder / "scene.yaml"
        path.write_text(text + internal("M", "beam", 0.4, "Mz"), encoding="utf-8")
        done = run("solve", "--scene", path, "-f", "collocation", "-n", "1")
        self.assertEqual(done.returncode, 1)
        self.assertIn("it is within 0.001 of its length of an end, or of another such place; put it "
                      "there", " ".join(done.stdout.split()))

    def test_a_side_without_a_place(self):
        path = self.folder / "scene.yaml"
        path.write_text(WHOLE + "  Q: {internal: {analysis: li, member: beam, along: max, "
                        "side: from, resultant: Qy}}\n", encoding="utf-8")
        done = run("solve", "--scene", path, "-f", "collocation", "-n", "1")
        self.assertEqual(done.returncode, 2)
        self.assertIn("say which, with 'where', or take it away", done.stderr)


if __name__ == "__main__":
    unittest.main()
