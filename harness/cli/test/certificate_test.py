"""`element-test`: output for formulations that satisfy or violate the interface requirements."""
import csv
import hashlib
import io
import json
import re

from harness.cli.test.element_test_test import EXAMPLES, FAULTS, Tested
from harness.tools.kit.program import environment, run


class Certificates(Tested):

    def test_all_keep_the_contract(self):
        record = self.record("element-test", "all")
        listed = run("list", "formulations").stdout
        for one in record["formulations"]:
            self.assertTrue(one["kept"], one["formulation"])
            self.assertIn(one["formulation"], listed)
            self.assertGreater(one["compared"], 5000)
            along = [c["outcome"] for c in record["claims"]
                     if (c["formulation"], c["family"]) == (one["formulation"], "along")]
            self.assertEqual(set(along), {"holds"})
            self.assertGreaterEqual(len(along), 2)
        self.assertEqual([m for m in record["measured"] if m["wrong_limit"]], [])
        self.assertGreaterEqual(len(record["formulations"]), 10)

    def test_examples_keep_it(self):
        for source in sorted(set(EXAMPLES.glob("*.c")) - {EXAMPLES / "uel.c"}):
            out = self.answered("element-test", "--element", self.compiled(source.name)).stdout
            self.assertIn("interface requirements: SATISFIED", out)
            self.assertIn("not applicable", out)
            if source.stem in ("ancf_slopes", "simo_vu_quoc"):
                self.assertIn("one element is not exact", " ".join(out.split()))
                continue
            self.assertRegex(out, r"distributed loads are as exact as forces at the nodes \((98|102) compared\)")

    def test_with_options(self):
        out = self.answered("element-test", "collocation:stages=3", "geometrically_exact:nodes=2",
                            "--quiet").stdout
        self.assertIn("2 of 2 formulations satisfy the interface requirements", out)

    def test_width(self):
        out = self.answered("element-test", "all", "-v", env=environment(LC_ALL="C")).stdout
        self.assertTrue(out.isascii())
        self.assertLessEqual(max(map(len, out.splitlines())), 100)

    def test_quiet(self):
        self.assertEqual(self.answered("element-test", "beamw", "-q").stdout, "beamw: SATISFIED\n")

    def test_quiet_tells_what_is_broken(self):
        made = self.compiled("timoshenko.c", FAULTS["energy"][0])
        out = self.answered("element-test", "--element", made, "-q", code=1).stdout
        self.assertIn("interface requirements: VIOLATED", out)
        self.assertIn("sigma 1", " ".join(out.split()))
        self.assertNotIn("declared", out)

    def test_file(self):
        path = self.folder / "certificates.json"
        out = self.answered("element-test", "beamw", "--json", path).stdout
        self.assertIn("interface requirements: SATISFIED", out)
        found = json.loads(path.read_text(encoding="utf-8"))
        self.assertEqual([c["formulation"] for c in found["formulations"]], ["beamw"])

    def test_refused(self):
        self.refused(2, ("name a formulation", "--element ./mine.so"), "element-test")
        self.refused(2, "beamv", "element-test", "beamv")
        self.refused(2, "text, json, csv, markdown or latex", "element-test", "beamw", "--format",
                     "pdf")
        self.refused(2, "twice", "element-test", "beamw", "beamw")


ROWS = re.compile(r"^    (.*) \\\\$", re.M)


class Tables(Tested):
    usual = None

    def forms(self, *changes, code=0):
        if not changes and Tables.usual is not None:
            return Tables.usual
        made = self.compiled("timoshenko.c", *changes)
        out = {form: self.answered("element-test", "--element", made, "--format", form,
                                   code=code).stdout
               for form in ("json", "csv", "markdown", "latex")}
        out |= {"json": json.loads(out["json"]),
                "hash": hashlib.sha256(made.read_bytes()).hexdigest()}
        if not changes:
            Tables.usual = out
        return out

    def test_hash_and_version(self):
        found = self.forms()
        one, = found["json"]["formulations"]
        self.assertEqual(one["hash"], found["hash"])
        for form in ("csv", "markdown", "latex"):
            self.assertIn(found["hash"], found[form])
            self.assertIn(found["json"]["program_version"], found[form])
            self.assertIn(found["json"]["commit"], found[form])

    def test_hash_of_a_command(self):
        script = self.folder / "timoshenko.py"
        script.write_bytes((EXAMPLES / "timoshenko.py").read_bytes())
        path = environment(PYTHONPATH=str(EXAMPLES))
        out = self.answered("element-test", "--element", f"exec:/usr/bin/python3 {script}",
                            "--format", "markdown", env=path).stdout
        self.assertIn("SHA-256 of the files named by its command", out)
        before, = re.findall(r"\b[0-9a-f]{64}\b", out)
        script.write_bytes(script.read_bytes() + b"\n")
        again = self.answered("element-test", "--element", f"exec:/usr/bin/python3 {script}",
                              "--format", "markdown", env=path).stdout
        self.assertNotIn(before, again)
        out = self.answered("element-test", "beamw", "--format", "latex").stdout
        self.assertIn("SHA-256 of the program that contains the element", out)

    def test_csv(self):
        found = self.forms()
        rows = list(csv.DictReader(io.StringIO(found["csv"])))
        self.assertEqual([(r["family"], r["name"], r["outcome"], int(r["compared"]))
                          for r in rows if r["outcome"] != "measured"],
                         [(c["family"], c["claim"], c["outcome"], c["compared"])
                          for c in found["json"]["claims"]])
        values = [r for r in rows if r["at"]]
        self.assertEqual([(r["name"], float(r["at"]), float(r["error"]) if r["error"] else None)
                          for r in values],
                         [(p["name"], p["at"], p["error"])
                          for p in found["json"]["measured_points"]])
        self.assertIn("not supported: warping", [r["words"] for r in rows if r["name"] ==
                                               "torsion, warping held"])

    def test_markdown(self):
        text = self.forms()["markdown"]
        tables = [[line.count("|") for line in part.splitlines()]
                  for part in re.findall(r"(?:^\|.*\n)+", text, re.M)]
        self.assertEqual(len(tables), 5)
        for bars in tables:
            self.assertGreater(len(bars), 4)
            self.assertEqual(len(set(bars)), 1)
        self.assertIn("| statics, large: tip force | 18 % | 2.9 % |", text)
        self.assertIn("| pure bending about y | exact | exact | correct |", text)
        self.assertIn("vibration with the mass computed by beamwork", text)

    def test_latex(self):
        text = self.forms()["latex"]
        opened = []
        for what, name in re.findall(r"\\(begin|end)\{(\w+)\}", text):
            if what == "begin":
                opened.append(name)
            else:
                self.assertEqual(opened.pop(), name)
        self.assertEqual(opened, [])
        tables = re.findall(r"\\begin\{tabular\}\{(\S+)\}\n(.*?)\\end\{tabular\}", text, re.S)
        self.assertEqual(len(tables), 5)
        for columns, body in tables:
            columns = re.sub(r"p\{.*?\}", "p", columns)
            self.assertGreater(len(ROWS.findall(body)), 3)
            for row in ROWS.findall(body):
                spanned = sum(int(n) - 1 for n in re.findall(r"\\multicolumn\{(\d+)\}", row))
                self.assertEqual(len(re.split(r"(?<!\\)&", row)) + spanned, len(columns), row)
        plain = re.sub(r"^%.*$|\\[&%$#_{}]|\$[^$]*\$|\\label\{.*?\}", "", text, flags=re.M)
        self.assertEqual(plain.count("{"), plain.count("}"))
        self.assertEqual(re.findall(r"[#$_^~%]", plain), [])
        self.assertTrue(text.isascii())
        self.assertIn(r"pure bending, a quarter turn & 11\,\% & 0.94\,\% & -- \\", text)

    def test_violations(self):
        found = self.forms(FAULTS["energy"][0], code=1)
        self.assertRegex(found["markdown"], r"interface requirements violated \((\d+ in '\w+', )*\d+ in 'energy'")
        self.assertIn("* violated: stress: sigma 1 is", found["markdown"])
        self.assertIn("% violated: stress: sigma 1 is", found["latex"])
        self.assertRegex(found["latex"], r"stress and C derive .* & violated ")

    def test_special_characters(self):
        text = self.forms(("two nodes, one integration point", "50 % of {a_b} & #1 | $x^2$ ~ \\\\"),
                          ('"timoshenko"', '"my_beam"'))
        self.assertIn(r"\caption{my\_beam: ", text["latex"])
