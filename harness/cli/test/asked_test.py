"""Selections, partial results, default choices, and formulations that are not ranked."""
import json
import re
import subprocess
import unittest

import h5py

from harness.tools.kit.program import ProgramTest, ROOT, environment, run


HEAD = """beamwork: 1
sections: {s: {rectangle: {width: 0.05, thickness: 0.005}, young: 210e9, shear_modulus: 81e9,
               density: 7850}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}
loads: {t: {force: [-1, 0.1, 0], on: b}}
"""
ANALYSES = """analyses:
  path: {static: {stations: [0.5, 1]}}
  c: {compliance: {about: path, node: b}}
  v: {modal: {about: path}}
  plain: {modal: {wanted: 3}}
  w: {buckling: {wanted: 3}}
  l: {linear: {}}
  p: {static: {stations: [1, 2]}}
"""
TIP = "tip: {displacement: {analysis: %s, node: b, component: uy}}"
QUANTITIES = {
    "path": TIP % "path",
    "l": TIP % "l",
    "p": TIP % "p",
    "c": "stiff: {stiffness: {analysis: c, component: uy}}",
    "v": "loaded: {frequency: {analysis: v}}",
    "plain": "plain: {frequency: {analysis: plain}}",
    "w": "crit: {critical_factor: {analysis: w}}",
}


def work(record):
    cell = record["cell"]
    return {k: cell[k] for k in ("factorisations", "solutions", "iterations",
                                 "stress_evaluations")}


class Asked(ProgramTest):

    def solved(self, text, *options):
        path = self.folder / "scene.yaml"
        path.write_text(text)
        return self.record("solve", "--scene", path, "-f", "collocation", "-n", "4", *options)

    def only(self, names):
        lines = ANALYSES.splitlines(keepends=True)
        return HEAD + "".join(lines[:1] + [x for x in lines[1:]
                                           if x.split(":")[0].strip() in names])

    def test_analyses_that_nobody_reads(self):
        for asked, line in QUANTITIES.items():
            wanted = f"quantities:\n  {line}\n"
            needed = {asked, "path"} if asked in "cv" else {asked}
            least = self.solved(self.only(needed) + wanted)
            all_of_them = self.solved(HEAD + ANALYSES + wanted)
            self.assertEqual(work(all_of_them), work(least), asked)
            self.assertEqual(all_of_them["quantities"][0]["value"],
                             least["quantities"][0]["value"], asked)

    def test_a_selection(self):
        lines = {k: v.replace("tip:", f"tip_{k}:") for k, v in QUANTITIES.items()}
        text = HEAD + ANALYSES + "quantities:\n" + "".join(f"  {x}\n" for x in lines.values())
        whole = self.solved(text)
        values = {q["quantity"]: q["value"] for q in whole["quantities"]}
        self.assertEqual(len(values), len(lines))
        for asked, line in lines.items():
            name = line.split(":")[0]
            one = self.solved(text, "-k", name)
            chosen = {q["quantity"]: q["value"] for q in one["quantities"]}
            self.assertIn(name, chosen)
            for key, value in chosen.items():
                self.assertEqual(value, values[key], key)
            self.assertLess(one["cell"]["factorisations"], whole["cell"]["factorisations"])

    def test_no_quantities(self):
        asked = self.solved(HEAD + ANALYSES + "quantities:\n  " + QUANTITIES["path"] + "\n")
        nothing = self.solved(HEAD + ANALYSES)
        self.assertGreater(nothing["cell"]["factorisations"], asked["cell"]["factorisations"])
        self.assertGreater(len(nothing["steps"]), len(asked["steps"]))

    def test_what_is_drawn_is_asked_for(self):
        text = HEAD + ANALYSES + "quantities:\n  " + QUANTITIES["path"] + "\n"
        path, out = self.folder / "s.yaml", self.folder / "out.h5"
        path.write_text(text)
        self.answered("solve", "--scene", path, "-f", "collocation", "-n", "4", "--shapes", "-o",
                      out)
        folder = self.folder / "matrices"
        self.answered("solve", "--scene", path, "-f", "collocation", "-n", "4", "--matrices",
                      folder)
        with h5py.File(out) as file:
            kinds = []
            file.visititems(lambda name, node: kinds.append(name))
            self.assertTrue(any("shape" in name for name in kinds), kinds)
        names = {p.name for p in folder.iterdir()}
        self.assertGreater(len(names), 8, names)

    def test_counts_of_the_issue(self):
        column = ("solve", "c_column", "-n", "16")
        self.assertEqual(self.record(*column)["cell"]["factorisations"], 4)
        asked = self.record(*column, "-k", "buckling_load")
        self.assertEqual(asked["cell"]["factorisations"], 2)
        self.assertEqual([q["quantity"] for q in asked["quantities"]], ["buckling_load"])

    def test_the_mesh_is_chosen_by_what_is_asked(self):
        least = self.record("solve", "c_column", "-k", "buckling_load")["elements"]
        self.assertLess(least, self.record("solve", "c_column")["elements"])

    def test_refused(self):
        self.refused(2, "did you mean 'buckling_load'", "solve", "c_column", "-k", "bucling_load")
        self.refused(2, "selects no quantity", "solve", "c_column", "-f", "beamw", "-k",
                     "elastica or not (c_column or elastica)")
        self.refused(2, "remove -k", "solve", "tip_body", "--follow", "body=0.1..0.2/2", "-k",
                     "frequency")

    def test_verify(self):
        out = self.folder / "v.h5"
        self.answered("verify", "-k", "c_column/default/ and buckling_load", "-f", "beamw", "-o",
                      out)
        with h5py.File(out) as file:
            group = file["cases/c_column"]
            self.assertEqual({q.decode() for q in group["quantities"]["quantity"][()]},
                             {"buckling_load"})
            cells = group["cells"][()]
            finest = cells[cells["elements"] == 16]
            self.assertEqual(list(finest["factorisations"]), [2])


BAR = """beamwork: 1
parameters: {depth: {value: 0.1, unit: m, min: 0.05, max: 0.5, about: "of the section at b"},
             damping: {value: 0, unit: s, min: 0, max: 1, about: "of the member"}}
sections:
  s: {i: {depth: 0.2, flange: 0.1, flange_thickness: 0.008, web_thickness: 0.005}, young: 210e9,
      shear_modulus: 81e9, density: 7850}
  t: {i: {depth: depth, flange: 0.1, flange_thickness: 0.008, web_thickness: 0.005}, young: 210e9,
      shear_modulus: 81e9, density: 7850}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [2, 0, 0]}}
members: {m: {from: a, to: b, section: [s, t], y: [0, 1, 0], damping: damping}}
loads: {p: {force: [0, 0, 100], on: b}}
analyses: {run: {linear: {}}}
quantities: {uz: {displacement: {analysis: run, node: b, component: uz}}}
"""
HINGES = """beamwork: 1
sections: {s: {constants: {A: 1e-3, Iy: 1e-6, Iz: 1e-6, It: 2e-6}, young: 210e9,
               shear_modulus: 81e9}}
nodes: {a: {at: [0, 0, 0], hold: all}, m: {at: [1, 0, 0]}, b: {at: [2, 0, 0], hold: all}}
members:
  p: {from: a, to: m, section: s, y: [0, 1, 0], release: {to: [rz]}}
  q: {from: m, to: b, section: s, y: [0, 1, 0], release: {from: [rz]}}
loads: {f: {force: [0, 960, 0], on: m}}
analyses: {run: {linear: {}}}
quantities:
  uy: {displacement: {analysis: run, node: m, component: uy}}
  rz: {displacement: {analysis: run, node: m, component: rz}}
"""


class Selected(ProgramTest):
    ONES = "c_column and length=4 and (sheet_second or beamw)", "unsymmetric_column/default", \
        "angle_column/default", "deep_beam/default", "shear_column/default", "sheet_wagner/default"

    def verdicts(self, selection):
        path = self.folder / "verdicts.json"
        run("verify", "-q", "-k", selection, "--json", path)
        rows = json.loads(path.read_text())["verdicts"]
        return {tuple(v[k] for k in ("case", "parameters", "formulation", "quantity")): (v["verdict"], v["as_expected"])
                for v in rows}

    def test_verdicts(self):
        for some in self.ONES:
            every = self.verdicts(some)
            quantities = sorted({key[3] for key in every})
            others = 0
            for asked in (quantities[0], quantities[-1]), *((q, ) for q in quantities[:2]):
                words = " or ".join(f"={q}" for q in asked)
                part = {key: v for key, v in every.items() if key[3] in asked}
                self.assertEqual(self.verdicts(f"({some}) and ({words})"), part, words)
                others += sum(v[0] == "other model" for v in part.values())
            self.assertTrue(every, some)
            self.assertGreater(others, 0 if "column" in some else -1, some)

    def test_alike_in_converge(self):
        where = ("converge", "c_column", "--set", "length=4", "--set", "height=0.9", "--set", "width=0.3", "-f",
                 "sheet_second", "-n", "2,4,8,16")
        for more in ((), ("-k", "=buckling_load")):
            series, = self.record(*where, *more)["series"]
            found, = (q for q in series["quantities"] if q["quantity"] == "buckling_load")
            self.assertEqual(found["verdict"], "other model")


class Had(ProgramTest):

    def scene(self, text):
        path = self.folder / "own.yaml"
        path.write_text(text)
        return path

    def test_one_quantity_of_two(self):
        words = ("solve", "--scene", self.scene(HINGES), "-f", "collocation", "-n", "2")
        done = run(*words)
        self.assertEqual(done.returncode, 1, done)
        self.assertEqual(len(done.stderr.splitlines()), 1, done)
        self.assertIn("node m can rotate freely", done.stderr)
        self.assertRegex(done.stdout, r"uy +7\.61904")
        told = json.loads(run(*words, "--format", "json").stdout)
        values = {q["quantity"]: q["value"] for q in told["quantities"]}
        self.assertAlmostEqual(values["uy"], 960 / 6 / 210e3, delta=1e-6)
        self.assertIsNone(values["rz"])
        found = run("converge", "--scene", self.scene(HINGES), "-f", "collocation", "-n", "1,2")
        self.assertEqual(found.returncode, 0, found)

    def test_values_that_are_asked_for(self):
        words = ("solve", "--scene", self.scene(BAR), "-f", "collocation", "-n", "2")
        self.refused(2, "own.yaml", *words)
        done = run(*words, "--set", "depth=0.2")
        self.assertEqual((done.returncode, done.stderr), (0, ""), done)
        self.refused(2, "own.yaml", *words, "--set", "depth=0.3")
        self.refused(2, "did you mean 'depth'", *words, "--set", "deptj=0.2")

    def test_matrices_of_damping(self):
        def entries(folder, letter):
            lines = (self.folder/folder/"undeformed"/f"{letter}.mtx").read_text(encoding="utf-8").splitlines()
            rows = [line.split() for line in lines if not line.startswith("%")][1:]
            return {(row, column): float(value) for row, column, value in rows}
        dashpot = BAR + "springs: {d: {to: b, damping: [0, 7, 0, 0, 0, 0]}}\n"
        for folder, text, eta in (("still", BAR, 0), ("damped", BAR, 1e-3), ("both", dashpot, 1e-3), ("pot", dashpot, 0)):
            done = run("solve", "--scene", self.scene(text), "-f", "collocation", "-n", "2", "--set", "depth=0.2",
                       "--set", f"damping={eta}", "--matrices", self.folder/folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual((self.folder/folder/"undeformed/C.mtx").exists(), folder != "still")
            if folder == "still":
                continue
            K, C = entries(folder, "K"), entries(folder, "C")
            rest = {at: C.get(at, 0) - eta*value for at, value in K.items()}
            apart = sorted(abs(value) for value in rest.values())
            largest = max(map(abs, K.values()))
            self.assertLess(apart[-2], 1e-12*largest)
            self.assertAlmostEqual(apart[-1], 7 if text is dashpot else 0, delta=1e-12*largest)


LEAF = ROOT / "cases" / "examples" / "leaf_spring_guide.yaml"


class Solve(ProgramTest):

    def test_both(self):
        for case, quantity in (("elastica", "w_over_L"), ("lateral_buckling", "load_factor")):
            text = self.answered("solve", case).stdout
            told = re.match(r"-f (\S+): .*no known deviation here.*\n-n (\d+): ", text)
            formulation, n = told.groups()
            self.assertIn(f"\n{case}, {formulation}\nok; ", text)
            record = self.record("solve", case)
            self.assertEqual((record["formulation"], record["elements"]), (formulation, int(n)))
            one = next(q for q in record["quantities"] if q["quantity"] == quantity)
            truths = [t for t in one["truths"] if t["truth_kind"] == "exact"]
            self.assertTrue(truths)
            self.assertLess(min(abs(t["error"]) for t in truths), 1e-3)

    def test_cost(self):
        for case in ("elastica", "bend_45", "angle_column", "cross_flexure", "deep_beam", "lateral_buckling",
                     "carried_rod", "geradin_cardona", "loaded_cantilever", "weighted_column"):
            chosen = self.record("solve", case)["formulation"]
            answers = self.record("converge", case, "--error", "0.1%")["answers"]
            cost = {a["formulation"]: a["cost"] for a in answers if a["rank"]}
            self.assertIn(chosen, cost, case)
            self.assertLessEqual(cost[chosen], 2 * min(cost.values()), f"{case}: {chosen}, {cost}")

    def test_finer_than_the_meshes_of_a_scene(self):
        text = LEAF.read_text(encoding="utf-8")
        path = self.folder / "coarse.yaml"
        path.write_text(re.sub(r"(?m)^meshes: .*$", "meshes: [1]", text), encoding="utf-8")
        told = re.match(r"-f \S+: .*\n-n (\d+): no value changed", self.answered("solve", "--scene", path).stdout)
        self.assertGreater(int(told.group(1)), 1)

    def test_steps(self):
        for case, formulation, rejects in (("elastica", "beamw", True), ("bend_45", "collocation", False)):
            more = ("--set", "load=10") if rejects else ()
            what = ("solve", case, "-f", formulation, "-n", "8", *more)
            steps = self.record(*what)["steps"]
            failed = sum(s["rejected"] for s in steps)
            self.assertEqual(failed > 0, rejects)
            told = f" in {len(steps)} step" + ("s" if len(steps) > 1 else "")
            told += f" ({failed} longer rejected)," if rejects else ","
            self.assertIn(told, " ".join(self.answered(*what).stdout.split()))

    def test_one_of_them(self):
        text = self.answered("solve", "elastica", "-f", "beamw").stdout
        self.assertTrue(text.startswith("-n "), text)
        text = self.answered("solve", "elastica", "-n", "3").stdout
        self.assertRegex(text, r"\A-f \S+: .*\nelastica, ")
        text = self.answered("solve", "elastica", "-f", "beamw", "-n", "3").stdout
        self.assertTrue(text.startswith("elastica, beamw\n"), text)
        self.refused(2, "one formulation and one mesh", "solve", "elastica", "-f", "beamw", "-n", "1,2")

    def test_the_theory_that_the_case_asks_for(self):
        record = self.record("solve", "shear_column")
        self.assertIn("engesser", record["cell"]["features"])
        load = next(q for q in record["quantities"] if q["quantity"] == "buckling_load")
        self.assertLess(abs(load["error"]), 1e-3)

    def test_a_scene_and_modes(self):
        text = self.answered("solve", "--scene", LEAF).stdout
        self.assertRegex(text, r"\A-f \S+: .*\n-n \d+: .*\nleaf_spring_guide, ")
        text = self.answered("solve", "tip_body", "--follow", "body=0.1..0.2/2").stdout
        self.assertRegex(text, r"\A-f \S+: .*\n-n \d+: ")

    def test_without_truths(self):
        done = self.answered("solve", "elastica", env=environment(BEAMWORK_TRUTHS="/nowhere.h5"))
        self.assertIn("no reference values are used", done.stderr)
        self.assertRegex(done.stdout, r"\A-f \S+: ")
        self.assertNotIn("defect", done.stdout)


MARK = "timoshenko: by differences, so its times are not ranked"


class Unranked(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.object = cls.class_folder() / "mine.so"
        subprocess.run(["cc", "-O2", "-shared", "-fPIC", "-I", ROOT,
                        ROOT / "elements" / "examples" / "timoshenko.c", "-o", cls.object],
                       check=True)

    def bench(self, *options):
        return self.answered("bench", "tapered_cantilever", "--element", self.object, "-f",
                             "timoshenko", *options).stdout

    def test_table(self):
        out = " ".join(self.bench("-f", "collocation", "-n", "4,8,16,32").split())
        self.assertEqual(out.count(MARK), 1)
        self.assertNotIn("collocation: by differences", out)
        self.assertRegex(out, r"stretch within 10, 1 %: collocation, n = 4, [^;]*; also within this error: "
                         r"timoshenko, n = 4, timed [0-9.e-]+ ms \(by differences: no rank\)")

    def test_alone(self):
        out = " ".join(self.bench("-n", "4,8,16,32").split())
        self.assertRegex(out, r"stretch within 10, 1 %: none that ranks; also within this error: timoshenko")

    def test_against(self):
        out = " ".join(self.bench("--against", "collocation", "-k", "stretch", "--error",
                                  "1%").split())
        self.assertIn("not ranked: ", out)
        self.assertNotIn("is faster", out)
        at = ("--against", "collocation", "-n", "2")
        out = self.bench(*at)
        self.assertIn("pairs): unranked", out)
        self.assertIn("by differences, so its times are not ranked", out)
        self.assertEqual(json.loads(self.bench(*at, "--format", "json"))["outcome"], "unranked")

    def test_ranked_ones_are(self):
        out = self.answered("bench", "tapered_cantilever", "-f", "collocation", "--against",
                            "beamw_consistent", "-k", "stretch", "--error", "1%").stdout
        self.assertNotIn("rank", out)

    def test_converge_names_what_is_missed(self):
        out = self.answered("converge", "tapered_cantilever", "-f", "beamw", "-n", "2,4",
                            "--error", "0.01%").stdout
        self.assertRegex(" ".join(out.split()), r"not reached by beamw \(\w+: [0-9.]+ %\)")


if __name__ == "__main__":
    unittest.main()
