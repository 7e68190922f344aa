"""Quantities along members: they must be exact for uniform beams under loads within a member, must have their values
on either side of a jump, and must converge on arcs and under tension."""
import json
import math
import unittest

from harness.tools.kit.program import ProgramTest, run


L, q, m = 0.7, 3.0, 2.0
E, G, A, Iy, Iz, It = 70e3, 27e3, 0.04, 3e-4, 2e-4, 4e-4
HELD = {"clamped": ("all", "all"), "cantilever": ("all", "[]"), "propped": ("all", "[ux, uy, uz, rx]"),
        "hinged": ("[ux, uy, uz, rx]", "[ux, uy, uz]"), "guided": ("all", "[ux, rx, ry, rz]")}
RIGID = {"beamw_vlasov": "yz", "sheet_second": "y", "sheet_third": "y", "sheet_third_printed": "y"}


def flexibility(formulation, along):
    """Returns 1/(k G A) [1/N] of the formulation, or zero if the formulation is rigid in shear."""
    return 0 if along in RIGID.get(formulation, "") else 12 / (G * A)


def scene(formulation, support, loads):
    shear = " ".join(["F: [%g, 0, 0, 0, %g, 0, 0, 0, 0]" % tuple(
        flexibility(formulation, a) * G for a in "yz")])
    p, held = HELD[support]
    return f"""beamwork: 1
sections: {{s: {{constants: {{A: {A}, Iy: {Iy}, Iz: {Iz}, It: {It}, {shear}}}, young: {E},
               shear_modulus: {G}}}}}
nodes: {{a: {{at: [0, 0, 0], hold: {p}}}, b: {{at: [{L}, 0, 0], hold: {held}}}}}
members: {{beam: {{from: a, to: b, section: s, y: [0, 1, 0]}}}}
loads: {{{loads}}}
analyses: {{li: {{linear: {{}}}}}}
quantities:
""" + "".join(
        f"  {kind}{end}: {{internal: {{analysis: li, member: beam, where: {where}, resultant: {kind}}}}}\n"
        for kind in ("N", "Qy", "Qz", "Mx", "My", "Mz") for end, where in (("0", 0), ("h", 0.5), ("1", 1))
    ) + "".join(
        f"  {c}: {{displacement: {{analysis: li, node: b, component: {c}}}, unit: \"{unit}\"}}\n"
        for c, unit in (("ux", "m"), ("uy", "m"), ("uz", "m"), ("rx", "rad"), ("ry", "rad"),
                        ("rz", "rad")) if support not in ("clamped",))


def forces(formulation, support):
    exact = {}
    for along, turn, moment, inertia, sign in (("y", "rz", "Mz", Iz, 1), ("z", "ry", "My", Iy, -1)):
        EI, soft = E * inertia, flexibility(formulation, along)
        tip = q * L**4 / (8 * EI) + soft * q * L**2 / 2
        if support == "cantilever":
            exact.update({f"u{along}": tip, turn: sign * q * L**3 / (6 * EI),
                          f"{moment}0": sign * q * L**2 / 2, f"{moment}h": sign * q * L**2 / 8,
                          f"Q{along}0": q * L, f"Q{along}1": 0})
        elif support == "propped":
            prop = tip / (L**3 / (3 * EI) + soft * L)
            exact.update({f"Q{along}0": q * L - prop, f"Q{along}1": -prop,
                          f"{moment}0": sign * (q * L**2 / 2 - prop * L), f"{moment}1": 0})
        elif support == "hinged":
            exact.update({f"{moment}h": -sign * q * L**2 / 8, turn: -sign * q * L**3 / (24 * EI),
                          f"{moment}0": 0})
        elif support == "guided":
            exact.update({f"u{along}": q * L**4 / (24 * EI) + soft * q * L**2 / 2,
                          f"{moment}0": sign * q * L**2 / 3, f"{moment}1": -sign * q * L**2 / 6})
        else:
            exact.update({f"{moment}0": sign * q * L**2 / 12, f"{moment}1": sign * q * L**2 / 12,
                          f"{moment}h": -sign * q * L**2 / 24, f"Q{along}0": q * L / 2})
    free = support == "cantilever"
    exact.update({"N0": q * L if free else q * L / 2, "N1": 0 if free else -q * L / 2})
    if support in ("cantilever", "hinged"):
        exact["Mx0"] = m * L
        exact["rx"] = m * L**2 / (2 * G * It)
    else:
        exact["Mx0"] = m * L / 2
    if free:
        exact["ux"] = q * L**2 / (2 * E * A)
    return exact


def moments(formulation, support):
    exact = {}
    for along, turn, moment, inertia, sign in (("y", "rz", "Mz", Iz, 1), ("z", "ry", "My", Iy, -1)):
        EI, soft = E * inertia, flexibility(formulation, along)
        if support == "cantilever":
            exact.update({f"u{along}": sign * m * L**3 / (3 * EI), turn: m * L**2 / (2 * EI),
                          f"{moment}0": m * L, f"Q{along}0": 0})
        elif support == "clamped":
            Phi = 12 * EI * soft / L**2
            exact.update({f"Q{along}0": -sign * m / (1 + Phi),
                          f"{moment}0": m * L * Phi / (2 * (1 + Phi)), f"{moment}h": 0})
    return exact


LOADS = {"forces": ("f: {distributed: [%g, %g, %g], on: beam}, t: {distributed_moment: [%g, 0, 0], "
                    "on: beam}" % (q, q, q, m), forces),
         "moments": ("t: {distributed_moment: [0, %g, %g], on: beam}" % (m, m), moments)}


def formulations():
    return [f["formulation"] for f in json.loads(run("list", "--format", "json").stdout)["formulations"]]


class AlongMembers(ProgramTest):

    def check(self, formulation, support, kind):
        loads, closed = LOADS[kind]
        path = self.folder / "beam.yaml"
        path.write_text(scene(formulation, support, loads), encoding="utf-8")
        done = run("solve", "--scene", path, "-f", formulation, "-n", "1", "--format", "json")
        self.assertEqual(done.returncode, 0, f"{formulation}, {support}: {done.stderr}")
        found = {v["quantity"]: v["value"] for v in json.loads(done.stdout)["quantities"]}
        size = q * L + m
        for name, value in closed(formulation, support).items():
            scale = max(abs(value), size * 1e-3 if name[0] in "NQM" else 0) or 1
            self.assertLess(abs(found[name] - value), 1e-9 * scale,
                            f"{formulation}, {support}, {kind}: {name} {found[name]} for {value}")

    def test_every_formulation(self):
        for formulation in formulations():
            for support in HELD:
                for kind in LOADS:
                    with self.subTest(f"{formulation}, {support}, {kind}"):
                        self.check(formulation, support, kind)


SECTION = """sections: {s: {constants: {A: 0.04, Iy: 3e-4, Iz: 2e-4, It: 4e-4,
               F: [0.001, 0, 0, 0, 0.001, 0, 0, 0, 0]}, young: 70e3, shear_modulus: 27e3}}
"""
# [N] reaction at the left end of a hinged beam of length 1 m under 1 N at 0.3 m and a load from 2 N/m at 0.5 m to 4 N/m
# at 0.8 m
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
                self.assertEqual(cell["divided"], "beam has 4 elements, 1 in each of 4 pieces, because "
                                 "loads begin, end or act at 0.3, 0.5, 0.8 of the length")

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
                        continue
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
        self.assertIn("acts within the fraction 0.001 of the length from an end or from another such position, so "
                      "resultants would have a kink", " ".join(done.stdout.split()))

    def test_a_side_without_a_place(self):
        path = self.folder / "scene.yaml"
        path.write_text(WHOLE + "  Q: {internal: {analysis: li, member: beam, along: max, "
                        "side: from, resultant: Qy}}\n", encoding="utf-8")
        done = run("solve", "--scene", path, "-f", "collocation", "-n", "1")
        self.assertEqual(done.returncode, 2)
        self.assertIn("add 'where', or remove 'side'", done.stderr)

    def test_a_tension_on_a_member(self):
        path = self.folder / "scene.yaml"
        path.write_text(WHOLE.replace("{force: [0, 1, 0], on: beam, where: 0.3}", "{tension: 5, on: beam, towards: a}") +
                        internal("M", "beam", 0.4, "Mz"), encoding="utf-8")
        done = run("solve", "--scene", path, "-f", "collocation", "-n", "1")
        self.assertEqual(done.returncode, 2)
        self.assertIn("'beam' is a member; a tension acts between two nodes; name a node", done.stderr)


RING = """beamwork: 1
sections: {leaf: {rectangle: {width: 20e-3, thickness: %(t)s}, young: 200e9, shear_modulus: 80e9}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [0.1, 0.1, 0]}}
members: {ring: {from: a, to: b, section: leaf, y: [-1, 1, 0], curvature: [0, 0, 10],
                 warping: free}}
loads: {p: {force: [0, -1e-3, 0], on: b}}
analyses: {li: {%(analysis)s}}
quantities: {u: {displacement: {analysis: li, node: b, component: uy}, unit: m}}
omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia]
"""
STRUT = """beamwork: 1
sections: {leg: {angle: {along_y: 0.07, along_z: 0.07, thickness: 0.004}, young: 210e9,
                 shear_modulus: 81e9}}
nodes: {a: {at: [0, 0, 0], hold: [ux, uy, uz, rx]}, b: {at: [0.8, 0, 0], hold: [uy, uz, rx]}}
members: {strut: {from: a, to: b, section: leg, y: [0, 1, 0], warping: free}}
loads: {P: {force: [-1, 0, 0], on: b}}
analyses: {b: {buckling: {wanted: 1}}}
omit: [shear, wagner_torque, rotary_inertia]
quantities:
  tension: {critical_factor: {analysis: b, which: 0, sign: negative}}
  compression: {critical_factor: {analysis: b, which: 0}}
"""
WIRE = """beamwork: 1
sections: {s: {constants: {A: 1e-2, Iy: 1e-9, Iz: 1e-9, It: 2e-9, Iw: 0, wagner_torque: 0%(more)s}, young: 2e11,
               shear_modulus: 8e10, density: 7800}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]}}
members: {wire: {from: a, to: b, section: s, y: [0, 1, 0]}}
loads: {t: {force: [%(N)r, 1e-3, 0], on: b}}
analyses: {st: {static: {stations: [1]}}, m: {modal: {wanted: 1, about: st}}}
quantities:
  u: {displacement: {analysis: st, node: b, component: uy}, unit: m}
  f: {frequency: {analysis: m, which: 0}, unit: Hz}
omit: [trapeze, rotary_inertia]
"""
TRUSS = """beamwork: 1
sections: {s: {constants: {A: 1e-2, Iy: 1e-9, Iz: 1e-9, It: 2e-9, Iw: 0, wagner_torque: 0}, young: 2e11,
               shear_modulus: 8e10}}
nodes: {a: {at: [-1, 1, 0], hold: all}, b: {at: [1, 1, 0], hold: all}, c: {at: [0, 0, 0], hold: [uz, rx, ry, rz]}}
members: {l: {from: a, to: c, section: s, y: [1, 1, 0], release: {from: %s, to: %s}},
          r: {from: b, to: c, section: s, y: [1, -1, 0], release: {from: %s, to: %s}}}
loads: {p: {force: [0, -4e5, 0], on: c}}
analyses: {st: {static: {stations: [1]}}}
quantities: {u: {displacement: {analysis: st, node: c, component: uy}, unit: m}}
omit: [trapeze, rotary_inertia]
"""


class Discretised(ProgramTest):

    def solve(self, scene, formulation, n):
        path = self.folder / "scene.yaml"
        path.write_text(scene)
        done = run("solve", "--scene", path, "-f", formulation, "-n", n, "--format", "json")
        said = " ".join((done.stdout + done.stderr).split())
        found = json.loads(done.stdout).get("quantities", []) if done.stdout[:1] == "{" else []
        values = {q["quantity"]: q.get("value") for q in found}
        return done.returncode, values, said

    def test_arcs(self):
        for n in (1, 2, 4, 8):
            turn = math.pi / 2 / n
            for side in (0.25, 0.98, 1.02, 30):
                t = 0.1 * turn ** 2 * math.sqrt(12 / (256 * side))
                for analysis in ("linear: {}", "static: {stations: [1]}"):
                    scene = RING % {"t": repr(t), "analysis": analysis}
                    status, values, said = self.solve(scene, "sheet_third", n)
                    if side < 1:
                        self.assertEqual(status, 0, said)
                        if n > 1:
                            right = self.solve(scene, "collocation", n)[1]["u"]
                            self.assertLess(abs(values["u"] / right - 1), 0.12 if side > 0.9 else 0.012, (n, side))
                        continue
                    needed = n + 1 if side < 2 else math.floor(n * side ** 0.25) + 1
                    self.assertEqual(status, 1, said)
                    self.assertRegex(said, r"the arc of element 1 of %d of (member )?\w+ rises by [.\d]+ radii of gyration of its "
                                     r"section, but sheet_third is accurate only below 2; use %d elements" % (n, needed))
                    self.assertEqual(self.solve(scene, "sheet_third", needed)[0], 0, (n, side))
                    for other in ("sheet_second", "sheet_second_consistent"):
                        self.assertEqual(self.solve(scene, other, n)[0], 0, (n, other))
        self.assertIn("radii of gyration", run("list", "sheet_third").stdout)
        self.assertNotIn("radii of gyration", run("list", "sheet_second").stdout)

    def test_tension(self):
        for formulation in ("geometrically_exact", "beamw_consistent", "collocation"):
            for n in (1, 2, 4, 8):
                _, values, said = self.solve(STRUT, formulation, n)
                self.assertIsNone(values["tension"], (formulation, n, said))
                self.assertGreater(values["compression"], 0, (formulation, n))

    def test_tension_of_states(self):
        for formulation, most in (("geometrically_exact:nodes=2", 12), ("geometrically_exact", 60),
                                  ("sheet_third", 30 + math.sqrt(1620)), ("sheet_third_printed", 30 + math.sqrt(1620))):
            for n in (1, 2, 16):
                for part in (0.5, 0.99, 1.01, 1.6):
                    N = part * most * 200 * n * n
                    status, values, said = self.solve(WIRE % {"N": N, "more": ""}, formulation, n)
                    if part < 1:
                        root = math.sqrt(N / 200)
                        exact = 1e-3 / N * (1 - math.tanh(root) / root)
                        self.assertEqual(status, 0, said)
                        self.assertLess(abs(values["u"] / exact - 1), 0.5 if n == 1 and most == 12 else 0.17, (formulation, n))
                    else:
                        self.assertEqual(status, 1, (formulation, n, said))
                        self.assertRegex(said, r"element \d+ of %d of (member )?wire is too long for the axial force in it, by "
                                         r"a factor of 1[.\d]*, at path 0?\.[\d]+: %s loses its transverse stiffness; use %d elements"
                                         % (n, formulation.split(":")[0], n + 1))
                        self.assertIsNone(values.get("u"))
                        self.assertEqual(self.solve(WIRE % {"N": N, "more": ""}, formulation, 2*n)[0], 0, (formulation, n))
        for formulation in ("geometrically_exact", "sheet_third", "collocation"):
            for ends, status in (("[ry, rz]", 0), ("[rz]", 1)):
                done, values, said = self.solve(TRUSS % (ends, ends, ends, ends), formulation, 1)
                self.assertEqual(done, status if formulation != "collocation" else 0, (formulation, said))
                if done == 0:
                    self.assertLess(abs(values["u"] / (-2e5 * math.sqrt(2) / 2e9 * 2) - 1), 1e-3, formulation)
        for formulation in ("geometrically_exact:nodes=2", "geometrically_exact", "sheet_third"):
            self.assertIn("so long that its axial force", " ".join(run("list", formulation.split(":")[0]).stdout.split()))
        self.assertNotIn("so long that its axial force", " ".join(run("list", "collocation").stdout.split()))

    def test_tension_with_shear(self):
        shear = ", F: [%r, 0, 0, 0, %r, 0, 0, 0, 0]" % (8e10 * 1e-4, 8e10 * 1e-4)
        for formulation, N, status in (("geometrically_exact", 9000.0, 0), ("geometrically_exact:nodes=2", 1900.0, 0),
                                       ("geometrically_exact:nodes=2", 1990.0, 1)):
            found, values, said = self.solve(WIRE % {"N": N, "more": shear}, formulation, 1)
            self.assertEqual(found, status, (formulation, N, said))


if __name__ == "__main__":
    unittest.main()
