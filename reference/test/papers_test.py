"""The tables of papers and equations must be complete and name existing cases, functions and
tests."""
import ast
import csv
import fnmatch
import inspect
import pathlib
import re
import unittest

from reference import pack
from reference.derive import rederive, section


REFERENCE = pathlib.Path(__file__).resolve().parents[1]
ROOT = REFERENCE.parent
STATUSES = ("reproduced", "partly", "not reproducible", "contradicted", "open")
ITEMS = {
    "J": "Table 1|Table 2|Table 3|Table 4|Figs. 1-2, 4-9|Fig. 3|Fig. 10|Fig. 11|Fig. 12|Fig. 13|App. A"
         "|Eqs. 73, 74|Eqs. 75, 76|Sec. 5|Sec. 5.1|Sec. 5.2|Sec. 6",
    "N": "Table 1|Figs. 1-4, 7, 9|Fig. 5|Fig. 6|Fig. 8|Fig. 10|Sec. 2.1|Sec. 2.5|Sec. 3.4|Sec. 3.5|Sec. 4"
         "|Sec. 4.1|Sec. 4.2|Sec. 5|App. A|App. B"
}
FIGURES = {"J": 13, "N": 10}
EQUATIONS = {
    "J": {*map(str, range(1, 77)), "App. A"},
    "N": {*map(str, range(1, 71)), "A1", "B2"}
}
RUN = ("elements/test/*_test.c", "cases/test/*_test.c", "cases/*/test/*_test.c",
       "harness/*/test/*_test.c", "reference/test/*_test.py", "reports/test/*_test.py",
       "cases/*/test/*_test.py", "harness/*/test/*_test.py", "harness/*/*/test/*_test.py")


def rows(name="papers.csv"):
    with open(REFERENCE / name, newline="", encoding="utf-8") as table:
        return list(csv.DictReader(table))


def numbers(text):
    """Returns the numbers of equations such as '1-3,7' as a list of strings."""
    out = []
    for part in (p.strip() for p in re.sub(r"^(Figs?\.|Eqs\.) ", "", text).split(",")):
        first, _, last = part.partition("-")
        out += map(str, range(int(first), int(last) + 1)) if last else [first]
    return out


def defines(path, name):
    """Returns True if a file defines the function `name`, which in Python may have the form Class.function."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".py":
        of = ast.parse(text).body
        for part in name.split("."):
            found = [n for n in of if isinstance(n, (ast.ClassDef, ast.FunctionDef)) and n.name == part]
            if not found:
                return False
            of = found[0].body
        return True
    return bool(re.search(rf"^[a-z][\w \*]*[ \*]{name}\([^;]*?\)\s*\{{", text, re.MULTILINE))


class Papers(unittest.TestCase):

    def test_every_item(self):
        for paper, items in ITEMS.items():
            self.assertEqual({r["item"] for r in rows() if r["paper"] == paper}, set(items.split("|")))
        self.assertEqual({r["paper"] for r in rows()}, set(ITEMS))

    def test_every_figure(self):
        for paper, count in FIGURES.items():
            found = {n for r in rows() if r["paper"] == paper and r["item"].startswith("Fig") for n in numbers(r["item"])}
            self.assertEqual(found, set(map(str, range(1, count + 1))), paper)

    def test_status_and_reason(self):
        for r in rows():
            self.assertIn(r["status"], STATUSES, r)
            self.assertTrue(r["claim"] and (r["why"] or r["status"] == "reproduced"), r)
            self.assertEqual(r["status"] == "open", r["why"].startswith("missing: "), r)

    def test_cases_parameters_and_cells(self):
        defaults = pack.read_defaults(REFERENCE / "defaults.csv")
        for r in rows():
            self.assertTrue(list((ROOT / "cases" / "benchmarks").glob(r["case"] + ".[cy]*")), r)
            pack.parameter_hash(defaults[r["case"]], r["parameters"], f"papers.csv: {r['item']}")
            given = [bool(r[name]) for name in ("formulation", "elements", "quantity")]
            self.assertIn(sum(given), (0, 3), r)
            if r["formulation"]:
                self.assertTrue((ROOT / "elements" / (r["formulation"].split(":")[0] + ".c")).is_file(), r)

    def test_contradicted_numbers_are_errata(self):
        errata = (REFERENCE / "ERRATA.md").read_text(encoding="utf-8")
        for r in (
            r
            for r in rows()
            if r["status"] == "contradicted" and r["item"].startswith(("Table", "App", "Fig. 3"))
        ):
            self.assertIn(f"{r['paper']} {r['item']}", errata, r)


class Numbers(unittest.TestCase):
    """papers_numbers.csv: the printed numbers of the items of papers.csv."""

    def test_each_belongs_to_an_item(self):
        items = {(r["paper"], r["item"], r["claim"]) for r in rows()}
        for r in rows("papers_numbers.csv"):
            self.assertIn((r["paper"], r["item"], r["claim"]), items)

    def test_each_is_compared_or_has_a_reason(self):
        defaults = pack.read_defaults(REFERENCE / "defaults.csv")
        for r in rows("papers_numbers.csv"):
            self.assertIn(r["measure"], ("value", "exact", "error", "plate", "time", "derived", "none"), r)
            of_run = r["measure"] not in ("derived", "none")
            self.assertEqual([bool(r[n]) for n in ("case", "formulation", "elements", "quantity")], 4 * [of_run], r)
            self.assertEqual(bool(r["proof"]), not of_run, r)
            self.assertEqual(bool(r["ours"]), r["measure"] == "derived", r)
            if of_run:
                pack.parameter_hash(defaults[r["case"]], r["parameters"], r["number"])
                self.assertTrue((ROOT / "elements" / (r["formulation"].split(":")[0] + ".c")).is_file(), r)

    def test_all_numbers_of_the_tables(self):
        """J Tables 2 and 3 and the legend of N Fig. 8 have 6, 28 and 11 numbers; Tables 1 have 13 and 8."""
        found = {}
        for r in (r for r in rows("papers_numbers.csv") if r["printed"] and r["unit"] != "%"):
            found[r["paper"], r["item"]] = found.get((r["paper"], r["item"]), 0) + 1
        self.assertEqual({item: found[item] for item in (("J", "Table 1"), ("J", "Table 2"), ("J", "Table 3"),
                                                         ("N", "Table 1"), ("N", "Fig. 8"))},
                         {("J", "Table 1"): 13, ("J", "Table 2"): 6, ("J", "Table 3"): 28, ("N", "Table 1"): 8, ("N", "Fig. 8"): 11})

    def test_table_1(self):
        """Values of J Table 1 from the mid-line of the section. Shear stiffnesses: inverse of the flexibilities."""
        found = section.channel(0.6, 0.6, 0.03, 0.03)
        stiffness = found.F**-1
        computed = {"A": found.A * 10**6, "y_s": found.ys * 1000, "I_y": found.Iy * 10**12, "I_z": found.Iz * 10**12,
                    "I_t": found.It * 10**12, "I_omega": found.Iw * 10**18, "I_p/A": found.Ip / found.A * 10**6,
                    "D_y": stiffness[0, 0] * 10**6, "D_z": stiffness[1, 1] * 10**6, "D_omega": stiffness[2, 2] * 10**12,
                    "D_zomega": stiffness[1, 2] * 10**9}
        stated = {r["number"]: float(r["ours"]) for r in rows("papers_numbers.csv") if r["proof"].endswith("test_table_1")}
        self.assertEqual(set(stated), set(computed))
        for name, value in computed.items():
            self.assertAlmostEqual(stated[name] / float(value), 1, 5, name)


class Equations(unittest.TestCase):

    def test_every_equation_once_a_set_or_a_reason(self):
        for paper, printed in EQUATIONS.items():
            of = [r for r in rows("equations.csv") if r["paper"] == paper]
            used = {n for r in of if r["file"] for n in numbers(r["equations"])}
            unused = [n for r in of if not r["file"] for n in numbers(r["equations"])]
            self.assertEqual(used | set(unused), printed, paper)
            self.assertEqual(used & set(unused), set(), paper)
            self.assertEqual(len(unused), len(set(unused)), paper)
        self.assertEqual({r["paper"] for r in rows("equations.csv")}, set(EQUATIONS))

    def test_a_set_has_all_and_a_reason_nothing_else(self):
        for r in rows("equations.csv"):
            self.assertTrue(r["what"], r)
            given = [bool(r[name]) for name in ("file", "name", "test", "by")]
            self.assertEqual(sum(given), 0 if r["why"] else 4, r)

    def test_files_and_functions(self):
        for r in (r for r in rows("equations.csv") if r["file"]):
            self.assertFalse("/test/" in r["file"], r)
            self.assertTrue(defines(ROOT / r["file"], r["name"]), r)

    def test_tests_run_and_reach_it(self):
        for r in (r for r in rows("equations.csv") if r["file"]):
            path, _, name = r["test"].partition("::")
            self.assertTrue(any(fnmatch.fnmatch(path, pattern) for pattern in RUN), r)
            self.assertTrue(defines(ROOT / path, name), r)
            text = (ROOT / path).read_text(encoding="utf-8")
            self.assertTrue(r["by"] in text, r)
            if path.endswith(".c"):
                self.assertGreater(len(re.findall(rf"\b{name}\(", text)), 1, r)
            else:
                self.assertTrue(name.split(".")[1].startswith("test_"), r)

    def test_what_is_not_defined_is_noticed(self):
        self.assertFalse(defines(ROOT / "elements/beamw/fields.c", "beamw_stiffness"))
        self.assertFalse(defines(ROOT / "elements/beamw/variants.h", "beamw_modified_printed"))
        self.assertFalse(defines(REFERENCE / "test/papers_test.py", "Papers.test_files_and_functions"))


class Programs(unittest.TestCase):

    def test_each_takes_no_more_than_whether_all_are_wanted(self):
        for name in rederive.programs([]):
            module = rederive.importlib.import_module(f"reference.derive.{name}")
            wanted = ["everything"] if rederive.is_solid(name) else []
            self.assertEqual(list(inspect.signature(module.rows).parameters), wanted, name)

    def test_a_name_that_is_none(self):
        with self.assertRaisesRegex(SystemExit, "no program 'rotor'"):
            rederive.programs(["rotor"])


if __name__ == "__main__":
    unittest.main()
