"""Load cases and combinations must apply exactly the loads that they list, in every analysis and with all
formulations."""
import json
import unittest

from harness.tools.kit.program import ProgramTest, run

FORMULATIONS = ("collocation", "geometrically_exact", "beamw", "beamw_consistent", "beamw_vlasov", "beamw_first",
                "sheet_second", "sheet_second_consistent", "sheet_third", "sheet_third_printed")
HEAD = """beamwork: 1
parameters: {with: {value: 1, choices: [0, 1]}, g: {value: 1.35}}
sections: {s: {rectangle: {width: 0.02, thickness: 0.01}, young: 2e11, shear_modulus: 8e10, density: 7800, expansion: 1e-5}}
nodes:
  a: {at: [0, 0, 0], hold: all}
  b: {at: [1, 0, 0], hold: [uz, rx, ry], drive: {uy: down}}
  c: {at: [2, 0, 0], hold: [uz, rx, ry], mass: 0.5}
members:
  ab: {from: a, to: b, section: s, y: [0, 1, 0]}
  bc: {from: b, to: c, section: s, y: [0, 1, 0]PRETENSION}
"""
LOADS = {"weight": ("gravity: [0, -9.81, 0], on: all", "dead"), "wind": ("distributed: [2, 3, 0], on: bc, from: 0.3", "wind"),
         "hit": ("force: [-40, 5, 0], on: c", "wind"), "twist": ("moment: [0, 0, 2], on: ab, where: 0.4", "live"),
         "sun": ("temperature: 10, gradient: [100, 0], on: bc", "live")}
FACTORS = {"dead": 1.35, "wind": -0.6, "live": 0}
QUANTITIES = """  u: {displacement: {analysis: A, WHICH node: c, component: uy}}
  v: {displacement: {analysis: A, WHICH node: c, component: rz}}
  r: {reaction: {analysis: A, WHICH node: b, component: uy}}
  m: {internal: {analysis: A, WHICH member: bc, along: largest, resultant: Mz}}
  s: {stress: {analysis: A, WHICH member: bc}}
"""


def loads(factors=None, live=1.0, skip=()):
    """Returns the loads of a scene with their load cases. With `factors`, loads have no cases and are multiplied by
    the factors of their cases."""
    out = ["loads:"]
    for name, (text, case) in LOADS.items():
        if case in skip:
            continue
        if factors is None:
            out.append(f"  {name}: {{{text}, case: {case}}}")
        else:
            out.append(f"  {name}: {{{text}, path: [0, 1], factor: [0, {factors[case]}]}}")
    down = 0.002 * (live if factors is None else factors["wind"])
    out.append(f"motions: {{down: {{path: [0, 1], value: [0, {down}]{', case: wind' if factors is None else ''}}}}}")
    return "\n".join(out) + "\n"


COMBINATIONS = "combinations: {ULS: {dead: g, wind: -0.6, live: 0}, SLS: {dead: 1, wind: 1, live: 1}, lift: {wind: -2}}\n"


def solved(text, formulation="collocation", elements=2):
    done = run("solve", "--scene", "/dev/stdin", "-f", formulation, "-n", elements, "--format", "json", input=text)
    assert done.returncode == 0, done.stderr + done.stdout
    return {q["quantity"]: q for q in json.loads(done.stdout)["quantities"]}


def values(of):
    return {name: q["value"] for name, q in of.items()}


class LoadCases(ProgramTest):

    def same(self, with_cases, without, delta=1e-9, **more):
        one, two = values(solved(with_cases, **more)), values(solved(without, **more))
        self.assertEqual(one.keys(), two.keys())
        for name in one:
            self.assertAlmostEqual(one[name] / two[name], 1, delta=delta, msg=(name, more))

    def test_every_analysis(self):
        kinds = {"linear": "linear: {COMBINED}", "static": "static: {stations: [0.5, 1]COMBINED}",
                 "rotation": "rotation: {omega: [0, 0, 0.1], stations: [1]COMBINED}"}
        for formulation in FORMULATIONS:
            for name, kind in kinds.items():
                combined = "combination: ULS" if name == "linear" else ", combination: ULS"
                what = QUANTITIES.replace("WHICH ", "").replace("A,", "x,")
                for text, mine, factors in ((HEAD + COMBINATIONS, combined, None), (HEAD, "", FACTORS)):
                    text = (text.replace("PRETENSION", ", pretension: 200") + loads(factors)
                            + f"analyses: {{x: {{{kind.replace('COMBINED', mine)}}}}}\nquantities:\n" + what)
                    if factors is None:
                        first = text
                with self.subTest(formulation=formulation, kind=name):
                    self.same(first, text, formulation=formulation)

    def test_states_and_motions(self):
        analyses = """analyses:
  st: {static: {stations: [1]COMBINED}}
  tone: {modal: {about: st}}
  soft: {compliance: {node: c, about: st}}
  li: {linear: {ALONE}}
  note: {modal: {about: li}}
  late: {buckling: {ALONE}}
  go: {motion: {stations: [0.05], step: 0.001, about: st}}
  on: {motion: {stations: [0.1], step: 0.001, about: go}}
quantities:
  f: {frequency: {analysis: tone}}
  k: {stiffness: {analysis: soft, component: rz}}
  n: {frequency: {analysis: note}}
  c: {critical_factor: {analysis: late}}
  g: {displacement: {analysis: go, node: c, component: uy}}
  o: {displacement: {analysis: on, node: c, component: uy}}
  e: {energy: {analysis: on, of: strain}}
"""
        for formulation in ("collocation", "beamw_consistent", "sheet_third"):
            follows = loads().replace("on: ab, where: 0.4", "on: b, follower: true")
            cases = (HEAD + COMBINATIONS).replace("PRETENSION", "") + follows + analyses.replace(
                "COMBINED", ", combination: ULS").replace("ALONE", "combination: ULS")
            plain = HEAD.replace("PRETENSION", "") + loads(FACTORS, skip=("live",)) + analyses.replace(
                "COMBINED", "").replace("ALONE", "")
            self.same(cases, plain, formulation=formulation, delta=1e-8)

    def test_time_buckling_continuation(self):
        text = """nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}
loads:
  push: {force: [-10, 0, 0], on: bCASE}
  shake: {force: [0, TIMES, 0], on: b, time: "sin(20*t)"WIND}
  side: {force: [0, SIDE, 0], on: bWIND}
analyses:
  b: {buckling: {COMBINED}}
  p: {continuation: {control: {node: b, component: uy}, to: [0.3], step: 0.02, COMBINED}}
  t: {motion: {stations: [0.3], step: 0.002, COMBINED}}
quantities:
  load: {critical_factor: {analysis: b}}
  factor: {factor_at: {analysis: p}}
  u: {displacement: {analysis: t, node: b, component: uy}}
  most: {displacement: {analysis: t, node: b, component: uy, take: max}}
"""
        head = HEAD.split("nodes:", maxsplit=1)[0]
        cases = head + "combinations: {ULS: {dead: 3, wind: 0.5}}\n" + text.replace("CASE", ", case: dead").replace(
            "WIND", ", case: wind").replace("COMBINED", "combination: ULS").replace("TIMES", "4").replace("SIDE", "2")
        plain = head + text.replace("CASE", "").replace("WIND", "").replace("COMBINED", "").replace("-10", "-30").replace(
            "TIMES", "2").replace("SIDE", "1")
        for formulation in ("collocation", "geometrically_exact", "beamw_consistent"):
            self.same(cases, plain, formulation=formulation, delta=1e-8)

    def test_one_factorisation(self):
        kinds = {"ULS": "combination: ULS", "SLS": "combination: SLS", "lift": "combination: lift", "dead": "case: dead",
                 "live": "case: live"}
        head = (HEAD + COMBINATIONS).replace("PRETENSION", ", pretension: 200") + loads()
        for formulation in FORMULATIONS:
            every = head + "analyses: {x: {linear: {}}}\nquantities:\n" + "".join(
                f"  {name}_{line.strip()}\n" for name, which in kinds.items()
                for line in QUANTITIES.replace("A, WHICH", f"x, {which},").splitlines())
            done = run("solve", "--scene", "/dev/stdin", "-f", formulation, "-n", 2, "--format", "json", input=every)
            record = json.loads(done.stdout)
            self.assertEqual(record["cell"]["factorisations"], 1)
            got = {q["quantity"]: q["value"] for q in record["quantities"]}
            for name, which in kinds.items():
                alone = values(solved(head + f"analyses: {{x: {{linear: {{{which}}}}}}}\nquantities:\n"
                                      + QUANTITIES.replace("A, WHICH", "x,"), formulation))
                for quantity, value in alone.items():
                    with self.subTest(formulation=formulation, which=which, quantity=quantity):
                        self.assertAlmostEqual(got[f"{name}_{quantity}"], value, delta=1e-12 * abs(value))

    def test_envelopes(self):
        head = (HEAD + COMBINATIONS).replace("PRETENSION", "") + loads() + "analyses: {x: {linear: {}}}\nquantities:\n"
        one = {c: values(solved(head + QUANTITIES.replace("A, WHICH", f"x, combination: {c},"))) for c in ("ULS", "SLS", "lift")}
        for kind, best in (("max", max), ("min", min), ("largest", lambda v, key: max(v, key=lambda c: abs(key(c))))):
            for some in (("ULS", "SLS", "lift"), ("SLS", "lift"), ("ULS",)):
                over = f"combinations: [{', '.join(some)}]," if len(some) < 3 else ""
                got = solved(head + QUANTITIES.replace("A, WHICH", f"x, envelope: {kind}, {over}"))
                for name, q in got.items():
                    governs = best(some, key=lambda c, name=name: one[c][name])
                    value = one[governs][name]
                    self.assertEqual(q["meaning"], f"combination {governs}", (kind, some, name))
                    self.assertAlmostEqual(q["value"], value, delta=1e-12 * abs(value), msg=(kind, some, name))
        cases = head.replace(COMBINATIONS, "") + QUANTITIES.replace("A, WHICH", "x, envelope: max,")
        self.assertIn(solved(cases)["u"]["meaning"], ("case dead", "case wind", "case live"))

    def test_conditions_and_names(self):
        text = (HEAD + "combinations: {ULS: {dead: g, wind: 1.5, live: 1}, \"G$i\": {for: {i: 1..2}, dead: i, wind: 1}}\n").replace(
            "PRETENSION", "") + loads().replace("case: live}", "case: live, if: {with: 1}}") + """analyses: {x: {linear: {}}}
quantities:
  u: {displacement: {analysis: x, combination: ULS, node: c, component: uy}}
  "u_$c": {for: {c: [G1, G2]}, displacement: {analysis: x, combination: c, node: c, component: uy}}
"""
        text = text.replace("node: c, component", "node: b, component").replace("displacement", "reaction")
        path = self.folder / "scene.yaml"
        path.write_text(text, encoding="utf-8")
        for value in (0, 1):
            got = self.record("solve", "--scene", path, "--set", f"with={value}", "-f", "collocation", "-n", 2)
            self.assertEqual(len(got["quantities"]), 3)
            again = self.folder / "again.yaml"
            again.write_text(self.answered("scene", "--scene", path, "--set", f"with={value}").stdout, encoding="utf-8")
            self.assertEqual("live" in again.read_text(encoding="utf-8"), value == 1)
            twice = self.record("solve", "--scene", again, "-f", "collocation", "-n", 2)
            self.assertEqual([q["value"] for q in got["quantities"]], [q["value"] for q in twice["quantities"]])

    def test_refused(self):
        head = (HEAD + COMBINATIONS).replace("PRETENSION", "") + loads()
        u = "quantities: {u: {displacement: {analysis: x, WHICH node: c, component: uy}}}\n"
        rows = (
            (head + "analyses: {x: {static: {stations: [1]}}}\n" + u, ["does not select one", "combination: ULS"]),
            (head + "analyses: {x: {linear: {}}}\n" + u, ["u: analysis x solves every load case", "combination: ULS"]),
            (head + "analyses: {x: {linear: {combination: ULS}}}\n" + u.replace("WHICH", "combination: SLS,"),
             ["u: analysis x is solved only for combination ULS"]),
            (head + "analyses: {x: {linear: {combination: SUL}}}\n" + u, ["no combination 'SUL'"]),
            (head + "analyses: {x: {linear: {case: ded}}}\n" + u, ["no load case 'ded'", "'dead'"]),
            (head + "analyses: {x: {linear: {}}, y: {modal: {about: x}}}\n"
             + u.replace("WHICH", "case: dead,"), ["its base state is that of analysis x, which solves every"]),
            (head + "analyses: {w: {static: {stations: [1], case: wind}}, x: {motion: {stations: [1], about: w, case: dead}}}\n" + u,
             ["base state is that of analysis w, whose loads also act here; remove the key 'case'"]),
            (head.replace(", case: dead", "") + "analyses: {x: {linear: {}}}\n" + u.replace("WHICH", "case: wind,"),
             ["no load case 'dead'"]),
            (head.replace("on: all, case: dead", "on: all") + "analyses: {x: {linear: {}}}\n" + u.replace("WHICH", "case: wind,"),
             ["no load case 'dead'"]),
            (head.replace("on: c, case: wind", "on: c") + "analyses: {x: {linear: {}}}\n" + u.replace("WHICH", "case: wind,"),
             ["hit: this load has no load case", "add a case, such as case: "]),
            (head.replace("on: c, case: wind", "on: c, case: wnd") + "analyses: {x: {linear: {}}}\n"
             + u.replace("WHICH", "case: wind,"), ["'wnd' is not used by any"]),
            (head.replace("lift: {", "dead: {") + "analyses: {x: {linear: {}}}\n" + u.replace("WHICH", "case: wind,"),
             ["dead: a load case has the same name"]),
            (head.replace("lift: {wind: -2}", "lift: {}") + "analyses: {x: {linear: {}}}\n" + u.replace("WHICH", "case: wind,"),
             ["lift", "it contains no load case"]),
            (head.replace("lift: {wind: -2}", "lift: {wnid: -2}") + "analyses: {x: {linear: {}}}\n"
             + u.replace("WHICH", "case: wind,"), ["no load case 'wnid'", "'wind'"]),
            (head + "analyses: {x: {linear: {}}}\n" + u.replace("WHICH", "combination: ULS, combinations: [SLS],"),
             ["of an envelope"]),
            (head + "analyses: {x: {linear: {}}}\n" + u.replace("WHICH", "combination: ULS, case: dead,"),
             ["only one of case, combination, envelope"]),
            (head + "analyses: {x: {linear: {}, combination: ULS}}\n" + u, ["within the kind"]),
            (head + "analyses: {x: {linear: {}}}\n" + u.replace("{displacement", "{envelope: max, displacement"), ["next to 'analysis'"]),
            (HEAD.replace("PRETENSION", "") + loads(FACTORS) + "analyses: {x: {linear: {}}}\n" + u.replace("WHICH", "envelope: max,"),
             ["u: analysis x has no load cases"]),
        )
        for text, words in rows:
            done = run("solve", "--scene", "/dev/stdin", "-f", "collocation", "-n", 2, input=text.replace("WHICH ", ""))
            self.assertEqual(done.returncode, 2, (words, done.stdout, done.stderr))
            for word in words:
                self.assertIn(word, done.stderr)


class EnvelopeTest(ProgramTest):
    TEXT = """beamwork: 1
UNITS
sections: {bar: {tube: {diameter: DIAMETER, thickness: WALL}, young: YOUNG, shear_modulus: SHEAR, density: RHO}}
nodes: {foot: {at: [0, 0, 0], hold: all}, head: {at: [LENGTH, 0, 0]}}
members: {column: {from: foot, to: head, section: bar, y: [0, 1, 0]}}
loads:
  thrust: {force: [-1000, 0, 0], on: head, case: dead}
  wind: {force: [0, 100, 0], on: head, case: wind}
combinations: {with: {dead: 1, wind: 1}, against: {dead: 0.9, wind: -1.5}}
analyses:
  with: {static: {stations: 0..1/2, combination: with}}
  against: {static: {stations: 0..1/2, combination: against}}
  gust: {motion: {about: with, stations: [0.01, 0.02], step: 0.002}}
  all: {linear: {}}
quantities:
  low: {envelope_of: {quantities: [M_with, M_against, M_all, M_gust], select: min}, factor: 2}
  M_with: {internal: {analysis: with, member: column, end: from, resultant: Mz}}
  M_against: {internal: {analysis: against, member: column, end: from, resultant: Mz}}
  M_gust: {internal: {analysis: gust, member: column, end: from, resultant: Mz, take: max}}
  M_all: {internal: {analysis: all, member: column, end: from, resultant: Mz, envelope: min}}
  M: {envelope_of: {quantities: [M_with, M_against, M_all], select: largest}}
  high: {envelope_of: {quantities: [M_with, M_against], select: max}, factor: -1}
  deep: {envelope_of: {quantities: [M_against, M_with], select: min}, factor: -1, unit: MOMENT}
  size: {envelope_of: {quantities: [back, M_with], select: largest}, factor: -2, unit: MOMENT}
  both: {envelope_of: {quantities: [back, M_with], select: min}, unit: MOMENT}
  back: {internal: {analysis: with, member: column, end: from, resultant: Mz}, factor: -1.5, unit: MOMENT}
"""
    METRES = {"UNITS": "", "MOMENT": "N m", "DIAMETER": 0.05, "WALL": 3e-3, "YOUNG": 210e9, "SHEAR": 81e9, "RHO": 7850, "LENGTH": 3}
    MILLIMETRES = {"UNITS": "units: mm, N, MPa", "MOMENT": "N mm", "DIAMETER": 50, "WALL": 3, "YOUNG": 210e3, "SHEAR": 81e3,
                   "RHO": 7.85e-9, "LENGTH": 3000}

    def text(self, numbers):
        text = self.TEXT
        for name, value in numbers.items():
            text = text.replace(name, str(value))
        return text

    def test_governs(self):
        for formulation in FORMULATIONS:
            got = solved(self.text(self.METRES), formulation)
            v = values(got)
            least = min(("M_with", "M_against", "M_all", "M_gust"), key=v.get)
            self.assertEqual(v["low"], 2 * v[least])
            self.assertTrue(got["low"]["meaning"].startswith(least))
            self.assertEqual(v["M"], max((v[n] for n in ("M_with", "M_against", "M_all")), key=abs))
            self.assertLess(v["M_against"] * v["M_with"], 0)
            for name, of, select, factor in (("high", ("M_with", "M_against"), max, -1),
                                             ("deep", ("M_with", "M_against"), min, -1),
                                             ("size", ("M_with", "back"), lambda x: max(x, key=abs), -2),
                                             ("both", ("M_with", "back"), min, 1)):
                value = select([factor * v[n] for n in of])
                self.assertEqual(v[name], value, (formulation, name))
                self.assertEqual(got[name]["meaning"], of[[factor * v[n] for n in of].index(value)])
            self.assertLess(v["M_against"], v["M_all"] - 10, "the thrust magnifies the moment")

    def test_units_and_written(self):
        one, other = (values(solved(self.text(n))) for n in (self.METRES, self.MILLIMETRES))
        for name in one:
            self.assertAlmostEqual(other[name] / one[name], 1000, delta=1e-6, msg=name)
        written = run("scene", "--scene", "/dev/stdin", input=self.text(self.MILLIMETRES)).stdout
        again = values(solved(written))
        for name in one:
            self.assertAlmostEqual(again[name] / other[name], 1, delta=1e-12, msg=name)

    def test_refused(self):
        for old, new, words in (("[M_with, M_against], select", "[M_with, none], select", "no quantity 'none'"),
                                ("[M_with, M_against], select", "[], select", "give a list of names of quantities"),
                                ("max}, factor: -1}", "max}, when: {from: 0.1}}", "when: this key is only for quantities of motions"),
                                ("select: min}, unit: N m}", "select: min}, unit: N}", "unit 'N': the quantities of the envelope are in N m"),
                                ("[M_with, M_against], select", "[M_with, M], select", "M is an envelope"),
                                ("end: from, resultant: Mz}}\n  M_against", "end: from, resultant: N}}\n  M_against",
                                 "the unit of M_with is N and that of M_against is N m; name quantities with the same unit"),
                                ("resultant: Mz}}\n  M_gust", "resultant: Mz, take: curve}}\n  M_gust", "M_against is a curve")):
            text = self.text(self.METRES)
            self.assertIn(old, text)
            done = run("solve", "--scene", "/dev/stdin", "-f", "collocation", "-n", 1, input=text.replace(old, new))
            self.assertEqual(done.returncode, 2, (words, done.stdout, done.stderr))
            self.assertIn(words, done.stderr)

    def test_sign_of_extremes(self):
        got = values(solved("""beamwork: 1
sections: {bar: {tube: {diameter: 0.05, thickness: 3e-3}, young: 210e9, shear_modulus: 81e9, density: 7850}}
nodes: {foot: {at: [0, 0, 0], hold: all}, head: {at: [3, 0, 0], hold: [ux, uy, uz]}, middle: {at: [1.5, 0, 0]}}
members:
  one: {from: foot, to: middle, section: bar, y: [0, 1, 0]}
  two: {from: middle, to: head, section: bar, y: [0, 1, 0]}
loads: {wind: {distributed: [0, 100, 0], on: one, time: "exp(2*t)*cos(9*t)"}}
analyses:
  push: {static: {stations: 0..1/4}}
  free: {motion: {stations: 0..0.5/10, step: 0.005}}
quantities:
""" + "".join(f"  {n}{k}: {{{kind}, factor: {s}}}\n" for k, s in (("p", 1), ("n", -1)) for n, kind in (
            ("pmax", "displacement: {analysis: push, node: middle, component: uy, take: max}"),
            ("pmin", "displacement: {analysis: push, node: middle, component: uy, take: min}"),
            ("mmax", "displacement: {analysis: free, node: middle, component: uy, take: max}"),
            ("mmin", "displacement: {analysis: free, node: middle, component: uy, take: min}"),
            ("fmax", "internal: {analysis: free, member: one, end: from, resultant: Mz, take: max}"),
            ("fmin", "internal: {analysis: free, member: one, end: from, resultant: Mz, take: min}"),
            ("amax", "internal: {analysis: push, member: one, along: max, resultant: Mz}"),
            ("amin", "internal: {analysis: push, member: one, along: min, resultant: Mz}")))))
        for kind in "pmfa":
            self.assertNotEqual(got[f"{kind}maxp"], got[f"{kind}minp"])
            self.assertEqual(got[f"{kind}maxn"], -got[f"{kind}minp"], kind)
            self.assertEqual(got[f"{kind}minn"], -got[f"{kind}maxp"], kind)


if __name__ == "__main__":
    unittest.main()
