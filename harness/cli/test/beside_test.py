"""converge: formulations side by side, a selection of quantities, what is chosen by itself."""
import json
import re
import unittest

from harness.tools.kit.program import ROOT, ProgramTest

HEAD, COLUMN, WIDEST = 8, 15, 100
LEAF = ROOT / "cases" / "examples" / "leaf_spring_guide.yaml"


def cells(line):
    """The columns of a line of a table."""
    return [line[at:at + COLUMN].strip() for at in range(HEAD, len(line), COLUMN)]


def tables(text):
    """{(quantity, formulation): {row: cell}} of the tables."""
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
        """Every error and value of the tables is that of JSON; every one of JSON is there."""
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
        self.assertIn("collocation: no truth to judge by", text)
        self.agree("--scene", LEAF, "-n", "1,2,4", "--set", "stroke=0.009")

    def test_selection(self):
        """Quantities, formulations, both; what names nothing is refused."""
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
        self.refused(2, "holds for no quantity", "converge", "elastica", "-k", "c_column")

    def test_selected_values_are_the_same(self):
        work = ("converge", "c_column", "-f", "beamw", "-n", "4")
        every = self.record(*work)["series"][0]["quantities"]
        one = self.record(*work, "-k", "frequency_2")
        values = {q["quantity"]: q["meshes"][0]["value"] for q in every}
        for quantity in one["series"][0]["quantities"]:
            self.assertAlmostEqual(quantity["meshes"][0]["value"] / values[quantity["quantity"]], 1,
                                   delta=1e-9)

    def test_by_itself(self):
        """All formulations, the case's own meshes; those that cannot are named."""
        chosen = self.answered("converge", "c_column", "-k", "frequency_1", "-n", "2,4").stdout
        every = self.answered("converge", "c_column", "-k", "frequency_1", "-n", "2,4", "-f",
                              "all").stdout
        self.assertEqual(tables(chosen), tables(every))
        self.assertRegex(chosen, r"(?m)^beamw_vlasov: another model: shear not modelled \(")
        chosen = self.answered("converge", "coupled_beam", "-k", "uy", "-n", "2,4").stdout
        self.assertRegex(chosen, r"(?m)^not run, does not offer coupled section: \w+,")
        self.assertGreater(len(next(iter(tables(self.answered(
            "converge", "elastica", "-k", "theta").stdout).values()))), 6)

    def test_another_error(self):
        work = ("converge", "elastica", "-k", "theta", "--error")
        self.assertIn("\nfor 0.1 % in every quantity: ", self.answered(*work, "0.1%").stdout)
        self.assertIn("for 0.1 % in", self.record(*work, "0.1%")["sentence"])
        for error in ("1%,2%", "0", "2", ""):
            self.refused(2, "--error", *work, error)

    def test_one_or_verbose(self):
        """Values and times of each formulation by itself."""
        for words in (("-f", "beamw"), ("-f", "beamw", "-f", "collocation", "-v")):
            text = self.answered("converge", "elastica", "-n", "2,4,8", *words).stdout
            self.assertIn("elastica, beamw\n  w_over_L [1]\n", text)


if __name__ == "__main__":
    unittest.main()
