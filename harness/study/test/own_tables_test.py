"""Verification with user tables, and modes followed over a parameter."""
import csv
import io
import subprocess
import unittest

from harness.tools.kit.program import PROGRAM, ProgramTest, ROOT


EXAMPLE = ROOT / "elements" / "examples" / "timoshenko.c"
RULES = "rule,formulations,cases,condition,quantities,verdicts,largest_error,predicted,cause,proof"
ROWS = ("case,parameters,formulation,theory,elements,quantity,at,value,unit,uncertainty,kind,model,"
        "convention,source")
RUN = ("-k", "elastica/default or tapered_cantilever/default")
SCENE = """beamwork: 1
sections:
  leaf: {rectangle: {width: 50e-3, thickness: 0.5e-3}, young: 210e9, shear_modulus: 81e9}
parameters: {length: {value: 0.1, unit: m, min: 0.01, max: 1, about: span}}
nodes:
  base: {at: [0, 0, 0], hold: all}
  tip:  {at: [length, 0, 0]}
members:
  leaf: {from: base, to: tip, section: leaf, y: [0, 1, 0]}
loads:
  push: {force: [0, 0.1, 0], on: tip}
analyses: {run: {linear: {}}}
quantities: {dip: {displacement: {analysis: run, node: tip, component: uy}, unit: m}}
"""


class Own(ProgramTest):

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        text = EXAMPLE.read_text(encoding="utf-8")
        cls.element = {}
        for name, change in (("right", ""), ("wrong", "1.01 * ")):
            planted = text.replace("c->young * c->Iy / l3", f"{change}c->young * c->Iy / l3", 1)
            source = folder / f"{name}.c"
            source.write_text(planted, encoding="utf-8")
            cls.element[name] = folder / f"{name}.so"
            subprocess.run(["cc", "-O2", "-shared", "-fPIC", "-I", ROOT, source, "-o",
                            cls.element[name]], check=True)

    def write(self, name, head, *lines):
        path = self.folder / name
        path.write_text("\n".join([head, *lines]) + "\n", encoding="utf-8")
        return path

    def verified(self, element, *options, code=0, what=RUN):
        return self.answered("verify", "--element", self.element[element], "-f", "timoshenko", *what,
                             *options, code=code)

    def scene(self):
        path = self.folder / "leaf.yaml"
        path.write_text(SCENE, encoding="utf-8")
        return path

    @staticmethod
    def dip(factor):
        """Returns a row with the deflection of a slender cantilever times `factor`."""
        value = 0.1 * 0.1**3 / 3 / (210e9 * 50e-3 * 0.5e-3**3 / 12)
        return f"leaf,,,,,dip,,{factor * value:.12g},m,{1e-4 * value},exact,same,,beam theory"

    @staticmethod
    def explained(needed):
        text = needed.read_text(encoding="utf-8")
        needed.write_text(text.replace('"to be found: why is this not a pass?",', "planted,test"),
                          encoding="utf-8")
        return needed

    def proposed(self, element):
        needed = self.folder / "needed.csv"
        self.verified(element, "--propose-deviations", needed, code=element != "right")
        return needed


class Findings(Own):

    def test_what_is_proposed_explains(self):
        empty = self.write("empty.csv", RULES)
        self.verified("right", "--deviations", empty)
        out = self.verified("wrong", "--deviations", empty, code=1).stdout
        self.assertIn("wrong limit, expected pass", out)
        self.assertNotIn("(new)", out)
        needed = self.proposed("wrong")
        with open(needed, newline="", encoding="utf-8") as rows:
            self.assertIn("wrong limit", {r["verdicts"] for r in csv.DictReader(rows)})
        self.refused(2, ("needed.csv:2:9", "no cause yet"), "verify", "--element",
                     self.element["wrong"], "--deviations", needed)
        self.verified("wrong", "--deviations", self.explained(needed))

    def test_beyond_the_largest_error(self):
        needed = self.explained(self.proposed("wrong"))
        text = needed.read_text(encoding="utf-8").replace('"wrong limit",0.0', '"wrong limit",0.00')
        self.assertNotEqual(text, needed.read_text(encoding="utf-8"))
        small = self.folder / "small.csv"
        small.write_text(text, encoding="utf-8")
        self.assertIn("but known deviation", self.verified("wrong", "--deviations", small, code=1).stdout)

    def test_a_rule_nobody_shows(self):
        rule = "old,collocation,leaf,,*,wrong limit,0.1,,once,paper"
        truths = self.write("t.csv", ROWS, self.dip(1))
        run = ("verify", "-f", "collocation", "--scene", self.scene(), "--truths", truths)
        path = self.write("f.csv", RULES, rule)
        self.answered(*run, "--deviations", path, "-k", "dip")
        out = self.answered(*run, "--deviations", path, code=1).stdout
        self.assertIn(f"known deviation old ({path}:2) was not observed", " ".join(out.split()))
        for change in (("collocation", "collocation beamw"), ("leaf", "leaf elastica")):
            other = self.write("o.csv", RULES, rule.replace(*change))
            self.answered(*run, "--deviations", other)

    def test_a_rule_nobody_shows_of_a_selected_case(self):
        path = self.write("f.csv", RULES,
                          "old,timoshenko,tapered_cantilever,,*,undecided,0.1,,once,paper")
        for select, code in (("tapered_cantilever", 1), ("elastica or tapered_cantilever", 1),
                             ("tapered_cantilever/default", 0), ("elastica/default", 0),
                             ("tapered_cantilever and not deflection_y", 0)):
            with self.subTest(select=select):
                out = self.verified("right", "--deviations", path, what=("-k", select),
                                    code=code).stdout
                self.assertEqual("known deviation old (" in " ".join(out.split()), code == 1)

    def test_several(self):
        files = [self.write("empty.csv", RULES), self.explained(self.proposed("wrong"))]
        for first, second in (files, files[::-1]):
            self.verified("wrong", "--deviations", first, "--deviations", second)

    def test_refused(self):
        good = "a,timoshenko,elastica,,*,wrong limit,0.1,,cause,proof"
        for words, line in (
                (("2:2", "did you mean 'timoshenko'"), good.replace("timoshenko", "timoshenk")),
                (("2:3", "did you mean 'elastica'"), good.replace("elastica", "elastca")),
                (("2:4", "neither a feature"), good.replace("elastica,", "elastica,lod=3")),
                (("2:5", "did you mean 'w_over_L'"), good.replace("*", "w_ovr_L")),
                (("2:6", "did you mean 'wrong limit'"), good.replace("wrong limit", "wrong limt")),
                (("2:6", "not a verdict that a known deviation explains\n"), good.replace("wrong limit", "pass")),
                (("2:7", "largest_error"), good.replace("0.1", "-0.1")),
                (("2:8", "prediction"), good.replace("0.1,", "0.1,elastca/w_over_L")),
                (("2:9", "no cause yet"), good.replace("cause", "")),
                (("2:10", "no proof"), good.replace("proof", "")),
                (("2:1", "give one word"), good.replace("a,", "a b,", 1)),
                (("2:1", "the list of known deviations"), good.replace("a,", "J66-shear,", 1)),
                (("2:1", "fields"), good + ",more"), (("2:1", "a quote is not closed"), good + '"')):
            with self.subTest(line=line):
                self.refused(2, ("f.csv:", *words), "verify", "--element", self.element["right"],
                             "--deviations", self.write("f.csv", RULES, line))
        self.refused(2, ("f.csv:1:1", "first line"), "verify", "--deviations",
                     self.write("f.csv", "rule,case"))
        self.refused(2, ("2:2", "1 more"), "verify", "--deviations", self.write(
            "f.csv", RULES, good, good.replace("a,", "b,", 1)))
        self.refused(4, "cannot be read", "verify", "--deviations", self.folder / "none.csv")
        path = self.write("f.csv", RULES)
        self.refused(2, "is an input", "verify", "--deviations", path, "--propose-deviations", path)


class Repository(Own):

    def test_gate_of_a_repository(self):
        page = (ROOT / "docs" / "tutorials" / "element_in_c.md").read_text(encoding="utf-8")
        lines = [line.split("#")[0].split() for line in page.splitlines()
                 if line.startswith(("beamwork/build/beamwork verify --element ./mine.so",
                                     "cc -O2 -shared -fPIC -I beamwork mine.c"))]
        self.assertEqual(len(lines), 3)
        (self.folder / "truths.csv").write_text(
            f"{ROWS}\n{Truths.row.format(at='load=0.6', value=0.1923502802)}\n", encoding="utf-8")
        text = EXAMPLE.read_text(encoding="utf-8").replace('"timoshenko"', '"mine"')
        codes = []
        for planted in ("", "1.01 * "):
            (self.folder / "mine.c").write_text(
                text.replace("c->young * c->Iy / l3", f"{planted}c->young * c->Iy / l3", 1),
                encoding="utf-8")
            for line in lines if not planted else lines[::2]:
                codes.append(self.called(line))
                if "--propose-deviations" in line:
                    self.explained(self.folder / "findings.csv")
        self.assertEqual(codes, [0, 0, 0, 0, 1])

    def called(self, words):
        program = [str(ROOT) if w == "beamwork" else w for w in words]
        if program[0].endswith("/beamwork"):
            program = [PROGRAM, *program[1:], "-k", "elastica or tapered_cantilever/default"]
        return subprocess.run(program, cwd=self.folder, check=False, capture_output=True).returncode


class Truths(Own):
    row = "elastica,{at},,,,w_over_L,,{value},1,1e-9,independent,same,,my program"

    def test_beside(self):
        for value, code in ((0.5, 1), (0.1923502802, 0)):
            path = self.write("t.csv", ROWS, self.row.format(at="load=0.6", value=value))
            out = self.answered("verify", "-k", "elastica/load=0.6 and w_over_L", "-f",
                                "collocation", "--truths", path, "-v", code=code).stdout
            self.assertIn("load=0.6", out)

    def test_several_in_all_verbs(self):
        paths = [self.write(f"{i}.csv", ROWS, self.row.format(at=f"load=0.{i}", value=0.2))
                 for i in (6, 7)]
        both = [word for path in paths for word in ("--truths", path)]
        for i in (6, 7):
            out = self.answered("truth", "elastica", "--set", f"load=0.{i}", *both).stdout
            self.assertIn("my program", out)
        out = self.record("converge", "elastica", "--set", "load=0.6", "-f", "collocation", *both)
        self.assertEqual(out["series"][0]["quantities"][0]["truth"], 0.2)

    def test_of_a_scene(self):
        for factor, code in ((1, 0), (1.1, 1)):
            path = self.write("t.csv", ROWS, self.dip(factor))
            self.answered("verify", "--scene", self.scene(), "-f", "collocation", "--truths", path,
                          code=code)

    def test_refused(self):
        good = self.row.format(at="load=0.6", value=0.5)
        for words, line in (
                (("2:1", "did you mean 'elastica'"), good.replace("elastica", "elastca")),
                (("2:2", "did you mean 'load'"), good.replace("load", "lod")),
                (("2:3", "did you mean 'beamw'"), good.replace("0.6,,,,", "0.6,beamv,,4,")),
                (("2:4", "theory 'euler' is unknown; give one of engesser|haringx"), good.replace("0.6,,,", "0.6,,euler,")),
                (("2:5", "elements"), good.replace("0.6,,,,", "0.6,,,4,")),
                (("2:6", "did you mean 'w_over_L'"), good.replace("w_over_L", "w_ovr_L")),
                (("2:8", "finite"), good.replace("0.5", "nan")),
                (("2:9", "'1'"), good.replace("0.5,1", "0.5,m")),
                (("2:10", "uncertainty '-1e-9' is negative; give zero or a positive number"), good.replace("1e-9", "-1e-9")),
                (("2:11", "kind 'guess' is unknown; give one of exact|predicted|independent|"), good.replace("independent", "guess")),
                (("2:12", "model 'mine' is unknown; give one of same|other"), good.replace("same", "mine")),
                (("2:14", "source"), good.replace("my program", "")),
                (("2:6", "already exists"), good.replace("load=0.6", "").replace(
                    "independent", "exact"))):
            with self.subTest(line=line):
                self.refused(2, ("t.csv:", *words), "verify", "--truths",
                             self.write("t.csv", ROWS, line))
        self.refused(2, "given twice with files other than .csv tables", "verify", "--truths", "a.h5", "--truths", "b.h5")


FORMULATIONS = ("beamw", "beamw_vlasov", "beamw_consistent", "sheet_second", "sheet_third",
                "geometrically_exact", "collocation")

CANTILEVER = """beamwork: 1
parameters:
  width: {value: 5e-3, unit: m, min: 1e-4, max: 1, about: "across"}
  coupling: {value: 0, unit: kg m^2, min: 0, max: 1, about: "product of inertia of the tip"}
  length: {value: 0.7, unit: m, min: 0.1, max: 10, about: "of the beam"}
let:
  thickness: 8e-3
  young: 7e10
sections:
  bar: {constants: {A: width*thickness, Iy: thickness*width^3/12, Iz: width*thickness^3/12,
        It: 1e-3*width*thickness}, young: young, shear_modulus: young/2.6, density: 2700}
nodes:
  root: {at: [0, 0, 0], hold: all}
  tip: {at: [length, 0, 0]MASS}
members:
  bar: {from: root, to: tip, section: bar, y: [0, 1, 0]}
analyses:
  vibration: {modal: {wanted: WANTED}}
quantities:
  f_$n: {for: {n: 1..WANTED}, frequency: {analysis: vibration, which: n - 1}, unit: Hz}
omit: [shear, trapeze, wagner_moments, wagner_torque, rotary_inertia]
"""
PLAIN = CANTILEVER.replace("MASS", "").replace("WANTED", "4")
COUPLED = CANTILEVER.replace("WANTED", "2").replace(
    "MASS", ", mass: 1e-3, inertia: [2e-5, 2e-5, 2e-5, 0, coupling, 0]")
TWIST = PLAIN.replace("It: 1e-3*width*thickness", "It: 1e-12").replace("1..4", "1..6").replace(
    "wanted: 4", "wanted: 6")


class Follow(ProgramTest):

    def follow(self, scene, formulation, over, *more, n=2):
        file = self.folder / "scene.yaml"
        file.write_text(scene, encoding="utf-8")
        return self.record("solve", "--scene", file, "-f", formulation, "-n", n, "--follow", over,
                           *more)

    def constant(self, curve, tolerance, what):
        self.assertLess(max(curve) / min(curve) - 1, tolerance, what)

    def test_crossing(self):
        for formulation in FORMULATIONS:
            for over in ("width=5e-3..12e-3/7", "width=12e-3..4.5e-3/3"):
                got = self.follow(PLAIN, formulation, over)
                values, curves = got["values"], [c["frequency"] for c in got["curves"]]
                self.assertEqual(len(curves), 4)
                slopes = []
                for curve in curves:
                    grows = curve[-1] / curve[0] > 1.01 or curve[-1] / curve[0] < 0.99
                    law = [f / v if grows else f for f, v in zip(curve, values)]
                    self.constant(law, 1e-9, (formulation, over))
                    slopes.append(grows)
                self.assertEqual(sum(slopes), 2, "two bend across, two along the thickness")
                crossings = [e for e in got["events"] if e["kind"] == "crossing"]
                square = [e for e in crossings if abs(e["value"] / 8e-3 - 1) < 1e-8]
                self.assertEqual(len(square), 2, (formulation, got["events"]))
                self.assertEqual([e for e in got["events"] if e["kind"] == "veering"], [])

    def test_torsion(self):
        got = self.follow(TWIST, "collocation", "length=0.3..1.5/12")
        values, curves = got["values"], [c["frequency"] for c in got["curves"]]
        powers = {1: [], 2: []}
        for i, curve in enumerate(curves):
            power = 1 if abs(curve[-1] * values[-1] / curve[0] / values[0] - 1) < 1e-6 else 2
            self.constant([f * v**power for f, v in zip(curve, values)], 1e-8, (i, power))
            powers[power].append((i + 1, curve[0] * values[0]**power))
        self.assertGreaterEqual(len(powers[1]), 1)
        exact = sorted((b / t, i, j) for i, t in powers[1] for j, b in powers[2]
                       if values[0] < b / t < values[-1])
        self.assertGreaterEqual(len(exact), 1)
        crossings = sorted((e["value"], *sorted(e["modes"])) for e in got["events"]
                           if e["kind"] == "crossing")
        self.assertEqual([c[1:] for c in crossings], [tuple(sorted(e[1:])) for e in exact])
        for found, known in zip(crossings, exact):
            self.assertLess(abs(found[0] / known[0] - 1), 1e-8)

    def test_veering(self):
        for parts in (1, 2, 9):
            got = self.follow(COUPLED, "collocation", f"width=6e-3..10e-3/{parts}", "--set",
                              "coupling=1e-5")
            first, second = (c["frequency"] for c in got["curves"])
            self.assertTrue(all(a < b for a, b in zip(first, second)))
            self.assertEqual([(e["kind"], e["modes"]) for e in got["events"]],
                             [("veering", [1, 2])])
            self.assertLess(abs(got["events"][0]["value"] / 8e-3 - 1), 0.05)
            self.assertLess(len([a for a in got["asked"] if a]), len(got["asked"]))
            free = self.follow(COUPLED, "collocation", f"width=6e-3..10e-3/{parts}")
            self.assertEqual([e["kind"] for e in free["events"]], ["crossing"])
            self.assertLess(abs(free["events"][0]["value"] / 8e-3 - 1), 1e-8)

    def test_forms(self):
        got = self.follow(PLAIN, "beamw", "width=5e-3..12e-3/7")
        work = ("solve", "--scene", self.folder / "scene.yaml", "-f", "beamw", "-n", 2, "--follow",
                "width=5e-3..12e-3/7")
        text = self.answered(*work, "--format", "csv").stdout
        rows = list(csv.DictReader(io.StringIO(text)))
        self.assertEqual(len(rows), 4 * len(got["values"]))
        self.assertEqual([float(r["frequency"]) for r in rows if r["mode"] == "2"],
                         got["curves"][1]["frequency"])
        self.assertIn("cross at 0.008", self.answered(*work).stdout)

    def test_refused(self):
        self.follow(PLAIN, "beamw", "width=5e-3..6e-3/1")
        work = ("solve", "--scene", self.folder / "scene.yaml", "-f", "beamw", "-n", 2, "--follow")
        for over, words in (("width=1", "A..B/N"), ("width=1e-3..2e-3", "A..B/N"),
                            ("width=1e-3..2e-3/0", "A..B/N"), ("width=1e-3..2e-3/3x", "A..B/N"),
                            ("widht=1e-3..2e-3/3", "width"), ("width=1e-3..9/3", "width"),
                            ("width=1e-3..1e-3/3", "the same"), ("width=1e-3..x/3", "width")):
            self.refused(2, words, *work, over)
        self.refused(2, "no modes", "solve", "elastica", "-f", "beamw", "-n", 2, "--follow",
                     "load=1..2/2")
        self.refused(2, "--matrices", *work, "width=1e-3..2e-3/2", "--matrices",
                     self.folder / "new")


if __name__ == "__main__":
    unittest.main()
