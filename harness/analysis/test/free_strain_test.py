"""Temperature, pretension, unstressed lengths and free curvatures compared with closed forms."""
import json
import math
import unittest

import numpy
import scipy.optimize

from harness.cli.test.plugin import EXAMPLES, compile_shared
from harness.tools.kit.program import ProgramTest, run


L, E, G, A, I, ALPHA, RHO = 1.0, 200e9, 80e9, 2e-4, 2e-9, 12e-6, 7800.0
FORMULATIONS = ("collocation", "geometrically_exact", "beamw", "beamw_consistent", "beamw_vlasov", "beamw_first",
                "sheet_second", "sheet_second_consistent", "sheet_third", "sheet_third_printed")
HEAD = f"""beamwork: 1
sections:
  s: {{constants: {{A: {A}, Iy: {I}, Iz: {I}, It: {2 * I}, F: [0, 0, 0, 0, 0, 0, 0, 0, 0], Iw: 0}}, young: {E},
      shear_modulus: {G}, density: {RHO}, expansion: {ALPHA}}}
"""


TIES = """plane: xy
nodes: {a: {at: [-0.4, 0, 0], hold: [ux, uy]}, n: {at: [0, 0, 0], mass: 20, hold: [rz]}, b: {at: [0.6, 0, 0], hold: [ux, uy]}}
members:
  l: {from: a, to: n, section: s, y: [0, 1, 0]%s, release: {from: [rz], to: [rz]}}
  r: {from: n, to: b, section: s, y: [0, 1, 0], release: {from: [rz], to: [rz]}}
loads: {t: {temperature: %g, on: r, path: [0, 1], factor: [1, 1]}, p: {force: [0, 30, 0], on: n}}
analyses:
  st: {static: {stations: [1]}}
  on: {static: {stations: 0.25..1/4}}
  fr: {modal: {about: st}}
  co: {continuation: {control: {node: n, component: uy}, to: [2e-3], step: 1e-3}}
  ro: {rotation: {omega: [0, 0, 1e-6], centre: [0, 0, 0], stations: [1]}}
  li: {linear: {}}
  bu: {buckling: {}}
quantities:
  N: {internal: {analysis: st, member: r, end: to, resultant: N}}
  uy: {displacement: {analysis: st, node: n, component: uy}}
  uy_on: {displacement: {analysis: on, node: n, component: uy, at: 1}}
  uy_ro: {displacement: {analysis: ro, node: n, component: uy}}
  f: {frequency: {analysis: fr}}
  uy_co: {displacement: {analysis: co, node: n, component: uy}}
  li: {displacement: {analysis: li, node: n, component: uy}}
  bu: {critical_factor: {analysis: bu}}
"""


def solved(text, formulation, elements=4):
    done = run("solve", "--scene", "/dev/stdin", "-f", formulation, "-n", elements, "--format", "json", input=HEAD + text)
    assert done.returncode == 0, done.stderr + done.stdout
    return {q["quantity"]: q["value"] for q in json.loads(done.stdout)["quantities"]}


def beam(right, more="", loads="", keys=""):
    return f"""nodes: {{a: {{at: [0, 0, 0], hold: all}}, b: {{at: [{L}, 0, 0], hold: {right}}}}}
members: {{m: {{from: a, to: b, section: s, y: [0, 1, 0]{keys}}}}}
loads: {{{loads}}}
{more}"""


class FreeStrains(ProgramTest):

    def test_cantilever(self):
        kappa, warm = -ALPHA * 50e3, ALPHA * 100
        text = beam("[]", loads="t: {temperature: 100, gradient: [50e3, 0], on: m}", more="""
analyses: {li: {linear: {}}, st: {static: {stations: [0.5, 1]}}}
quantities:
""" + "".join(f"  {c}_{a}: {{displacement: {{analysis: {a}, node: b, component: {c}}}, unit: {u}}}\n"
              for a in ("li", "st") for c, u in (("ux", "m"), ("uy", "m"), ("rz", "rad")))
            + "".join(f"  {r}_{a}: {{internal: {{analysis: {a}, member: m, where: 0.3, resultant: {r}}}}}\n"
                      for a in ("li", "st") for r in ("N", "Qy", "Mz")))
        exact = {"ux_li": warm, "uy_li": kappa / 2, "rz_li": kappa, "rz_st": kappa,
                 "ux_st": (1 + warm) * math.sin(kappa) / kappa - 1,
                 "uy_st": (1 + warm) * (1 - math.cos(kappa)) / kappa}
        for formulation in FORMULATIONS:
            got = solved(text, formulation)
            for name in got:
                with self.subTest(formulation=formulation, quantity=name):
                    self.assertAlmostEqual(got[name], exact.get(name, 0), delta=1e-9 if name in exact else 1e-6)

    def test_failed_base(self):
        text = """nodes: {a: {at: [0, 0, 0], hold: all}, n: {at: [1, 0, 0], hold: [rx, ry, rz], mass: 2}, b: {at: [2, 0, 0], hold: all}}
members:
  l: {from: a, to: n, section: s, y: [0, 1, 0]%s, release: {from: [ry, rz], to: [ry, rz]}}
  r: {from: n, to: b, section: s, y: [0, 1, 0], release: {from: [ry, rz], to: [ry, rz]}}
loads: {p: {force: [1, 0, 0], on: n}}
analyses:
  base: {%s}
  modal: {modal: {about: base}}
  other: {%s}
  harmonic: {harmonic: {about: base, frequencies: [3]}}
quantities:
  modal: {frequency: {analysis: modal}}
  other: {%s: {analysis: other, which: 0}}
  harmonic: {response: {analysis: harmonic, node: n, component: ux, force: n, along: ux, at: 3}}
"""
        for scene in ((", pretension: 800", "linear: {}", "modal: {about: base, damped: yes}", "frequency"),
                      ("", "static: {stations: [1]}", "buckling: {about: base}", "critical_factor")):
            done = run("solve", "--scene", "/dev/stdin", "-f", "collocation", "-n", 1, "--format", "json", input=HEAD + text % scene)
            self.assertEqual(done.returncode, 1, done.stderr + done.stdout)
            for quantity in json.loads(done.stdout)["quantities"]:
                with self.subTest(base=scene[1], quantity=quantity["quantity"]):
                    self.assertNotEqual(quantity["status"], "ok")
                    self.assertIsNone(quantity["value"])
                    self.assertIn("can move along", quantity["reason"])

    def test_prestressed_mechanism(self):
        for pretension, heat in ((8000, 0), (8000, -20), (0, -20)):
            text = TIES % (f", pretension: {pretension}" * (pretension > 0), heat)
            u, forces, frequency = self.ties(pretension, heat)
            for formulation in FORMULATIONS:
                done = run("solve", "--scene", "/dev/stdin", "-f", formulation, "-n", 4, "--format", "json",
                           input=HEAD.replace(f", density: {RHO}", "") + text)
                self.assertEqual(done.returncode, 1, done.stderr)
                got = {q["quantity"]: q for q in json.loads(done.stdout)["quantities"]}
                exact = {"N": forces[1], "uy": u[1], "uy_on": u[1], "uy_ro": u[1], "f": frequency, "uy_co": 2e-3}
                for name, value in exact.items():
                    with self.subTest(formulation=formulation, quantity=name, pretension=pretension, heat=heat):
                        self.assertEqual(got[name]["status"], "ok", got[name])
                        self.assertAlmostEqual(got[name]["value"], value, delta=1e-6 * abs(value))
                for name in ("li", "bu"):
                    self.assertIsNone(got[name]["value"])
                    self.assertIn("; if pretension or temperatures make the structure stiff, use a static path", got[name]["reason"])

    def ties(self, pretension, heat):
        def forces(u):
            a, b = math.hypot(0.4 + u[0], u[1]), math.hypot(0.6 - u[0], u[1])
            return pretension + E * A * (a / 0.4 - 1), E * A * (b / 0.6 - 1 - ALPHA * heat), a, b

        def balance(u):
            l, r, a, b = forces(u)
            return numpy.array((l * (0.4 + u[0]) / a - r * (0.6 - u[0]) / b, l * u[1] / a + r * u[1] / b - 30))

        u = scipy.optimize.fsolve(balance, (0, 1e-3), xtol=1e-14)
        h = 1e-7
        K = numpy.array([(balance(u + h * d) - balance(u - h * d)) / (2 * h) for d in numpy.eye(2)])
        return u, forces(u), math.sqrt(numpy.linalg.eigvalsh((K + K.T) / 2)[0] / 20) / (2 * math.pi)

    def test_where_the_path_begins(self):
        for keys, loads, force in ((", pretension: 10000", "", 10000),
                                   (f", unstressed_length: {L * (1 - 1e-4)}", "", E * A * 1e-4),
                                   ("", "t: {temperature: -50, on: m, path: [0], factor: [1]}", E * A * ALPHA * 50)):
            text = beam("all", keys=keys, loads=loads, more="""
analyses: {st: {static: {stations: [0, 1]}}, zero: {static: {stations: [0]}}, early: {modal: {about: zero}}, late: {modal: {about: st}}}
quantities:
  N_0: {internal: {analysis: st, member: m, where: 0.5, resultant: N, at: 0}}
  N_1: {internal: {analysis: st, member: m, where: 0.5, resultant: N, at: 1}}
  least: {internal: {analysis: st, member: m, where: 0.5, resultant: N, take: min}}
  early: {frequency: {analysis: early}}
  late: {frequency: {analysis: late}}
""")
            for formulation in ("collocation", "geometrically_exact", "beamw_consistent", "sheet_third"):
                got = solved(text, formulation)
                for name in ("N_0", "N_1", "least"):
                    self.assertAlmostEqual(got[name] / force, 1, delta=1e-9, msg=(formulation, name, keys, loads))
                self.assertAlmostEqual(got["early"] / got["late"], 1, delta=1e-9, msg=(formulation, keys, loads))
        text = beam("[]", loads="dead: {force: [0, 10, 0], on: b, path: [0], factor: [1]}", more="""
analyses: {st: {static: {stations: [0, 1]}}}
quantities:
  early: {displacement: {analysis: st, node: b, component: uy, at: 0}}
  late: {displacement: {analysis: st, node: b, component: uy, at: 1}}
""")
        got = solved(text, "collocation")
        self.assertAlmostEqual(got["early"] / (10 * L**3 / (3 * E * I)), 1, delta=1e-2)
        self.assertAlmostEqual(got["early"] / got["late"], 1, delta=1e-9)

    def test_misfits_that_strains_do_not_cover(self):
        for length, words in ((0, "unstressed_length = 0"), (0.9 * L, "within 1 %"), (-1, "give at least 0")):
            done = run("scene", "--scene", "/dev/stdin", input=HEAD + beam("all", keys=f", unstressed_length: {length}"))
            solve = run("solve", "--scene", "/dev/stdin", "-f", "collocation", "-n", 2,
                        input=HEAD + beam("all", keys=f", unstressed_length: {length}"))
            self.assertEqual(solve.returncode, 2, (length, solve, done))
            self.assertIn(words, solve.stderr)

    def test_clamped(self):
        """A clamped-clamped member under the temperature T with gradients g_y and g_z must have N = -EA alpha T, Mz
        = EI alpha g_y and My = -EI alpha g_z."""
        text = beam("all", loads="t: {temperature: 20, gradient: [300, 500], on: m}", more="""
analyses: {li: {linear: {}}, st: {static: {stations: [1]}}}
quantities:
""" + "".join(f"  {r}_{a}: {{internal: {{analysis: {a}, member: m, where: 0.3, resultant: {r}}}}}\n"
              for a in ("li", "st") for r in ("N", "My", "Mz")))
        exact = {"N": -E * A * ALPHA * 20, "My": -E * I * ALPHA * 500, "Mz": E * I * ALPHA * 300}
        for formulation in FORMULATIONS:
            got = solved(text, formulation)
            for name in got:
                with self.subTest(formulation=formulation, quantity=name):
                    size = exact[name[:-3]]
                    rough = 1e-3 if formulation == "beamw_first" else 1e-5
                    tolerance = 1e-11 if name.endswith("li") else rough
                    self.assertAlmostEqual(got[name], size, delta=tolerance * abs(size))

    def test_length(self):
        for keys, force in ((", pretension: 500", 500), (f", unstressed_length: {L * (1 - 1e-5)}", E * A * 1e-5),
                            (", strain: [-1e-5, 0, 0]", E * A * 1e-5)):
            text = f"""nodes: {{a: {{at: [0, 0, 0], hold: all}}, b: {{at: [{L}, 0, 0], hold: [uy, uz, rx, ry, rz]}},
         c: {{at: [{2 * L}, 0, 0], hold: all}}}}
members: {{m: {{from: a, to: b, section: s, y: [0, 1, 0]{keys}}}, n: {{from: b, to: c, section: s, y: [0, 1, 0]}}}}
analyses: {{li: {{linear: {{}}}}, st: {{static: {{stations: [1]}}}}}}
quantities: {{li: {{internal: {{analysis: li, member: n, end: to, resultant: N}}}},
             st: {{internal: {{analysis: st, member: m, end: from, resultant: N}}}}}}
"""
            for formulation in FORMULATIONS if "strain" not in keys else FORMULATIONS[:2]:
                got = solved(text, formulation)
                for name in got:
                    with self.subTest(formulation=formulation, keys=keys, analysis=name):
                        self.assertAlmostEqual(got[name], force / 2, delta=1e-5 * force)

    def test_bent(self):
        k = 0.5
        for formulation in ("collocation", "geometrically_exact", "sheet_second_consistent"):
            for own, free in ((k, -k), (0, k)):
                quantities = """analyses: {st: {static: {stations: [1]}}}
quantities:
  M: {internal: {analysis: st, member: m, where: 0.3, resultant: Mz}, unit: N m}
  N: {internal: {analysis: st, member: m, where: 0.3, resultant: N}}
  rz: {displacement: {analysis: st, node: b, component: rz}, unit: rad}
"""
                keys = f", curvature: [0, 0, {own}], free_curvature: [0, {free}]"
                held = solved(beam("all", quantities, keys=keys), formulation, 8)
                loose = solved(beam("[]", quantities, keys=keys), formulation, 8)
                length = 2 / own * math.asin(own * L / 2) if own else L
                with self.subTest(formulation=formulation, own=own):
                    self.assertAlmostEqual(held["M"], -E * I * free, delta=1e-5 * E * I * k)
                    self.assertAlmostEqual(held["N"] / (E * A), 0, delta=1e-6)
                    self.assertAlmostEqual(loose["M"], 0, delta=1e-6 * E * I * k)
                    self.assertAlmostEqual(loose["rz"], free * length, delta=1e-6)

    def test_stability_and_frequencies(self):
        text = beam("[ux, uy, uz, rx]", loads="t: {temperature: 1, on: m}", more="""
analyses: {cold: {modal: {}}, lin: {buckling: {}}, st: {static: {stations: [2, 4]}}, on: {buckling: {about: st}},
           warm: {modal: {about: st}}}
quantities:
  lin: {critical_factor: {analysis: lin, which: 0}}
  on:  {critical_factor: {analysis: on, which: 0}}
  f_0: {frequency: {analysis: cold, which: 0}, unit: Hz}
  f:   {frequency: {analysis: warm, which: 0}, unit: Hz}
omit: [rotary_inertia, trapeze]
""").replace("hold: all", "hold: [ux, uy, uz, rx]")
        critical, square = math.pi**2 * I / (A * L**2) / ALPHA, math.pi**2 / (2 * math.pi) * math.sqrt(E * I / (RHO * A))
        for formulation in FORMULATIONS:
            got = solved(text, formulation, 32)
            rough = 3e-3 if formulation == "beamw_first" else 1e-4
            with self.subTest(formulation=formulation):
                self.assertAlmostEqual(got["lin"] / critical, 1, delta=rough)
                self.assertAlmostEqual(got["on"] / critical, 1, delta=rough)
                self.assertAlmostEqual(got["f_0"] / square, 1, delta=1e-4)
                self.assertAlmostEqual(got["f"] / square, math.sqrt(1 - 4 / critical), delta=rough)

    def test_in_time(self):
        for formulation in ("collocation", "geometrically_exact", "beamw_consistent", "sheet_second"):
            for integrator in ("alpha", "radau"):
                text = beam("[uy, uz, rx, ry, rz]", loads="t: {temperature: 10, gradient: [100, 0], on: m, time: t^2}",
                            more=f"""
springs: {{wall: {{to: b, stiffness: [{E * A / L}, 0, 0, 0, 0, 0]}}}}
analyses: {{mo: {{motion: {{stations: [1], step: 2e-4, integrator: {integrator}}}}}}}
quantities:
  N: {{internal: {{analysis: mo, member: m, where: 0.5, resultant: N}}}}
  M: {{internal: {{analysis: mo, member: m, where: 0.5, resultant: Mz}}}}
  drift: {{energy: {{analysis: mo, of: drift}}, unit: J}}
  work: {{energy: {{analysis: mo, of: work}}, unit: J}}
""").replace("step: 2e-4", "step: 2e-3")
                got = solved(text, formulation, 2)
                N, M = -E * A * ALPHA * 10 / 2, E * I * ALPHA * 100
                work = E * A * (ALPHA * 10)**2 / 4 * L + E * I * (ALPHA * 100)**2 / 2 * L
                with self.subTest(formulation=formulation, integrator=integrator):
                    self.assertAlmostEqual(got["N"] / N, 1, delta=1e-3)
                    self.assertAlmostEqual(got["M"] / M, 1, delta=1e-3)
                    self.assertAlmostEqual(got["work"] / work, 1, delta=2e-3)
                    self.assertAlmostEqual(got["drift"] / work, 0, delta=2e-4)

    def test_part(self):
        text = beam("[]", loads=f"t: {{temperature: 90, gradient: [900, 0], on: m, from: 0.2, to: {0.2 + 1 / 3}}}", more="""
analyses: {li: {linear: {}}}
quantities:
  ux: {displacement: {analysis: li, node: b, component: ux}}
  uy: {displacement: {analysis: li, node: b, component: uy}}
""")
        for formulation in FORMULATIONS:
            got = solved(text, formulation, 2)
            with self.subTest(formulation=formulation):
                self.assertAlmostEqual(got["ux"], ALPHA * 30 * L, delta=1e-13)
                self.assertAlmostEqual(got["uy"], -ALPHA * 300 * (0.8 - 1 / 6) * L**2, delta=1e-12)

    def test_refused(self):
        element = compile_shared(EXAMPLES / "corotational.c", self.folder / "corotational.so")
        for text, who in ((beam("[]", loads="t: {temperature: 90, on: m}"), "load t"),
                          (beam("[]", keys=", pretension: 9"), "member m")):
            done = run("solve", "--scene", "/dev/stdin", "--element", element, "-f", "corotational", "-n", 1,
                       input=HEAD + text)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(f"the stress-free strains of {who} (it computes forces, not strains)", " ".join(done.stderr.split()))


if __name__ == "__main__":
    unittest.main()
