"""converge: output formats, and formulations in adjacent columns."""
import csv
import io
import json
import pathlib
import re
import unittest

from harness.tools.kit.program import ProgramTest, ROOT, run


LEAF = pathlib.Path(__file__).parents[3] / "cases" / "examples" / "leaf_spring_guide.yaml"


def converge(form):
    done = run("converge", "elastica", "-f", "beamw", "-f", "sheet_second:newton=displacement",
               "-n", "4,8,16", "--format", form)
    assert done.returncode == 0, done.stderr
    return done.stdout


def answer(text):
    return " ".join(text[text.rindex("\nfor 1 %"):].split())


class Forms(unittest.TestCase):

    def test_nothing_runs(self):
        done = run("converge", "coupled_beam", "-f", "beamw_vlasov")
        self.assertEqual(done.returncode, 3)
        self.assertEqual(" ".join(done.stdout.split()),
                         "nothing was run: beamw_vlasov does not support coupled section")

    def test_json_and_csv_agree(self):
        series = json.loads(converge("json"))["series"]
        self.assertEqual([s["formulation"] for s in series],
                         ["beamw", "sheet_second:newton=displacement"])
        rows = {(r["formulation"], r["quantity"], int(r["elements"])): r
                for r in csv.DictReader(io.StringIO(converge("csv")))}
        seen = 0
        for one in series:
            for quantity in one["quantities"]:
                for mesh in quantity["meshes"]:
                    row = rows[one["formulation"], quantity["quantity"], mesh["elements"]]
                    self.assertEqual(float(row["value"]), mesh["value"])
                    self.assertEqual(float(row["error"]), mesh["error"])
                    seen += 1
        self.assertEqual(seen, len(rows))

    def test_limit_order_and_verdict(self):
        quantities = json.loads(converge("json"))["series"][0]["quantities"]
        one = next(q for q in quantities if q["quantity"] == "w_over_L")
        self.assertEqual(one["verdict"], "pass")
        self.assertAlmostEqual(one["order"], 2, delta=0.05)
        self.assertLess(abs(one["error"]), 1e-4)
        self.assertIn("exact", converge("text"))

    def test_the_last_line_answers(self):
        series = json.loads(converge("json"))["series"]
        text = answer(converge("text"))
        self.assertTrue(text.startswith("for 1 % in every quantity: "), text)
        told = {
            name: int(n)
            for name, n in re.findall(r"([\w:=]+) n = (\d+) \([\d.e-]+ ms\)", text)
        }
        self.assertEqual(set(told), {s["formulation"] for s in series})
        for one in series:
            counts = [m["elements"] for m in one["quantities"][0]["meshes"]]
            bad = [
                k for q in one["quantities"] for k, m in enumerate(q["meshes"])
                if abs(m["error"]) > 0.01
            ]
            self.assertEqual(told[one["formulation"]], counts[max(bad, default=-1) + 1])

    def test_at_an_error_of_ones_own(self):
        at = {}
        for said, level in (("10%", 0.1), ("0.3%", 0.003), ("0.003", 0.003)):
            command = ("converge", "elastica", "-f", "all", "-n", "1,2,4,8,16", "--error", said)
            whole = json.loads(run(*command, "--format", "json").stdout)
            line = whole["sentence"]
            self.assertEqual(whole["level"], level)
            self.assertTrue(line.startswith(f"for {100 * level:g} % in every quantity: "), line)
            for one in whole["answers"]:
                self.assertIn(f"{one['formulation']} n = {one['elements']} (", line)
            ranked = [one for one in whole["answers"] if one["rank"]]
            self.assertEqual([one["rank"] for one in ranked], list(range(1, len(ranked) + 1)))
            self.assertEqual([one["cost"] for one in ranked],
                             sorted(one["cost"] for one in ranked))
            at[said] = [(one["formulation"], one["elements"]) for one in whole["answers"]]
        self.assertEqual(at["0.3%"], at["0.003"])
        self.assertNotEqual(at["0.3%"], at["10%"])

    def test_what_is_wrong_is_told_beside(self):
        whole = json.loads(run("converge", "shear_elastica", "-f", "all", "--error", "1%",
                               "--format", "json").stdout)
        wrong = [one for one in whole["answers"] if one["defect"]]
        self.assertTrue(wrong)
        self.assertTrue(all(one["rank"] == 0 and not one["tie"] for one in wrong))
        self.assertIn("; also within 1 %, with a different limit: ", whole["sentence"])
        cheapest = whole["answers"][0]
        self.assertEqual(cheapest["defect"], "")
        self.assertLess(min(one["cost"] for one in wrong), cheapest["cost"])

    def test_of_another_model(self):
        whole = json.loads(run("converge", "sheet_cantilever", "-f", "collocation", "-f", "beamw",
                               "-n", "2,4,8", "--format", "json").stdout)
        right = {one["formulation"] for one in whole["answers"] if not one["defect"]}
        self.assertEqual(right, {"collocation"})
        most = max((q for s in whole["series"] if s["formulation"] in right
                    for q in s["quantities"] if q["model_truth_kind"] == "independent"),
                   key=lambda q: abs(q["model_error"]))
        self.assertRegex(whole["sentence"],
                         rf"\. The beam model differs from the structure: {most['quantity']} of another model is .*; the limit of "
                         rf"collocation differs from it by [+]?{100 * most['model_error']:.2g} %")
        text = run("converge", "sheet_cantilever", "-f", "collocation", "-n", "2,4,8").stdout
        self.assertIn("\nThe beam model differs from the structure: ", text)
        self.assertNotIn("The beam model differs", converge("text"))
        self.assertFalse(converge("text").endswith("\n\n"))

    def test_without_a_truth_families_agree(self):
        new = ("converge", "--scene", str(LEAF), "--set", "stroke=0.009")
        done = run(*new, "-f", "all", "--format", "json")
        self.assertEqual(done.returncode, 0, done.stderr)
        whole = json.loads(done.stdout)
        quantities = [q for s in whole["series"] for q in s["quantities"]]
        agreed = [q for q in quantities if q["model_truth_kind"] == "agreement"]
        self.assertTrue(agreed)
        for one in agreed:
            self.assertIn(one["verdict"], ("no truth", "other model"))
            self.assertIn("agree", one["message"])
            self.assertTrue(all("error" in m for m in one["meshes"]))
        self.assertTrue(whole["sentence"].startswith("for 1 % in every quantity: "))
        self.assertNotIn("without a reference", whole["sentence"])
        alone = run(*new, "-f", "collocation", "-f", "geometrically_exact")
        names = sorted({q["quantity"] for q in quantities})
        why = r"no agreement of formulations: collocation, geometrically_exact: one family \(reissner\); add -f (\w+)"
        more = re.search(why, " ".join(alone.stdout.split()))
        self.assertNotIn("compare with", alone.stdout)
        agreed = run(*new, "-f", "collocation", "-f", more[1]).stdout
        self.assertRegex(agreed, r"agreement \S+, no reference value: ")
        self.assertNotIn("compare with", agreed)
        said = re.match(r"for 1 % in (?:no quantity|(\d+) of (\d+) quantities) "
                        r"\(without a reference: ([^)]*)\): ", answer(alone.stdout))
        missing = said[3].split(", ")
        self.assertLessEqual(set(missing), set(names))
        self.assertEqual(int(said[1] or 0) + len(missing), int(said[2] or len(names)))


HEAD, COLUMN, WIDEST = 8, 15, 100
BESIDE_LEAF = ROOT / "cases" / "examples" / "leaf_spring_guide.yaml"


def cells(line):
    return [line[at:at + COLUMN].strip() for at in range(HEAD, len(line), COLUMN)]


def tables(text):
    """Returns {(quantity, formulation): {row: cell}} of the tables."""
    found, quantity, names = {}, None, []
    for line in text.splitlines():
        head = line[:HEAD].strip()
        begun = re.match(r"(\w+) \[[^]]*\], ", line)
        if begun:
            quantity = begun[1]
        elif line.startswith(f"{'n':>{HEAD}}"):
            names = cells(line)
        elif head == "" and line.strip() and not re.match(" {2,4}[^ ]", line):
            names = [name + more for name, more in
                     zip(names, cells(line) + [""] * len(names), strict=False)]
        elif re.fullmatch(r"\d+|limit|\+-|order", head):
            for name, cell in zip(names, cells(line), strict=True):
                found.setdefault((quantity, name), {})[head] = cell
    return found


class Beside(ProgramTest):

    def both(self, *words):
        text = self.answered("converge", *words).stdout
        return text, json.loads(self.answered("converge", *words, "--format", "json").stdout)

    def agree(self, *words):
        text, record = self.both(*words)
        found, seen = tables(text), 0
        for one in record["series"]:
            for quantity in one["quantities"]:
                other = "(other model)" if one["other_model"] else ""
                column = found.pop((quantity["quantity"], one["formulation"] + other))
                for mesh in quantity["meshes"]:
                    cell = column[str(mesh["elements"])]
                    is_error = cell.endswith(" %")
                    shown = float(cell.removesuffix(" %")) / (100 if is_error else 1)
                    error = mesh["model_error" if other else "error"]
                    exact = error if is_error else mesh["value"]
                    self.assertAlmostEqual(shown, exact, delta=max(0.06 * abs(exact), 1e-6))
                    seen += 1
                if quantity["order"] is not None:
                    self.assertAlmostEqual(float(column["order"]), quantity["order"], delta=0.006)
        self.assertEqual(found, {})
        self.assertGreater(seen, 10)
        return text

    def test_tables_are_those_of_json(self):
        text = self.agree("elastica", "-n", "1,2,4,8")
        self.assertLessEqual(max(map(len, text.splitlines())), WIDEST)

    def test_values_where_there_is_nothing_to_measure_by(self):
        text = self.agree("c_column", "-k", "buckling_load", "-n", "2,4,8,16")
        said = " ".join(text.split())
        self.assertRegex(said, r"collocation: no reference value for its shear theory; its limit is -4\.[34]\d* % from "
                               "the reference value for engesser")
        self.agree("--scene", BESIDE_LEAF, "-n", "1,2,4", "--set", "stroke=0.009")

    def test_selection(self):
        found = tables(self.answered("converge", "c_column", "-k", "frequency_4").stdout)
        self.assertEqual({quantity for quantity, _ in found}, {"frequency_4"})
        self.assertGreater(len(found), 2)
        found = tables(self.answered("converge", "c_column", "-n", "2,4", "-k",
                                     "(frequency_1 or buckling_load) and beamw and not "
                                     "frequency_10").stdout)
        self.assertLessEqual({("buckling_load", "beamw"), ("frequency_1", "beamw_first")},
                             set(found))
        self.assertFalse([name for _, name in found if not name.startswith("beamw")])
        self.refused(2, "did you mean 'buckling_load'", "converge", "c_column", "-k",
                     "buckling_laod")
        self.refused(2, "selects no quantity", "converge", "elastica", "-k", "c_column")

    def test_selected_values_are_the_same(self):
        work = ("converge", "c_column", "-f", "beamw", "-n", "4")
        every = self.record(*work)["series"][0]["quantities"]
        one = self.record(*work, "-k", "frequency_2")
        values = {q["quantity"]: q["meshes"][0]["value"] for q in every}
        for quantity in one["series"][0]["quantities"]:
            self.assertAlmostEqual(quantity["meshes"][0]["value"] / values[quantity["quantity"]], 1,
                                   delta=1e-9)

    def test_by_itself(self):
        chosen = self.answered("converge", "c_column", "-k", "frequency_1", "-n", "2,4").stdout
        every = self.answered("converge", "c_column", "-k", "frequency_1", "-n", "2,4", "-f",
                              "all").stdout
        self.assertEqual(tables(chosen), tables(every))
        self.assertRegex(chosen, r"(?m)^beamw_vlasov: another model: shear not modelled \(")
        chosen = self.answered("converge", "coupled_beam", "-k", "uy", "-n", "2,4").stdout
        self.assertRegex(chosen, r"(?m)^not run, does not support coupled section: \w+,")
        self.assertGreater(len(next(iter(tables(self.answered(
            "converge", "elastica", "-k", "theta").stdout).values()))), 6)

    def test_another_error(self):
        work = ("converge", "elastica", "-k", "theta", "--error")
        self.assertIn("\nfor 0.1 % in every quantity: ", self.answered(*work, "0.1%").stdout)
        self.assertIn("for 0.1 % in", self.record(*work, "0.1%")["sentence"])
        for error in ("1%,2%", "0", "2", ""):
            self.refused(2, "--error", *work, error)

    def test_one_or_verbose(self):
        for words in (("-f", "beamw"), ("-f", "beamw", "-f", "collocation", "-v")):
            text = self.answered("converge", "elastica", "-n", "2,4,8", *words).stdout
            self.assertIn("elastica, beamw\n  w_over_L [1]\n", text)


if __name__ == "__main__":
    unittest.main()
