"""Packing of reference values: round trip, hash, and every rejection."""
import csv
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))
from reference import accepted, glossary, pack  # noqa: E402


class Pack(unittest.TestCase):

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        (self.folder / "tables").mkdir()
        self.write("defaults.csv",
                   ["case,parameter,value,choices", "beam,length,2,", "beam,ends,1,free|fixed"])
        self.write("findings.csv", [",".join(pack.FINDING_COLUMNS)])
        self.write("extreme_findings.csv", [",".join(pack.EXTREME_COLUMNS)])
        self.write("glossary.csv", [",".join(glossary.GLOSSARY_COLUMNS)])
        self.write("accepted.csv", [",".join(accepted.ACCEPTED_COLUMNS)])
        self.row = [
            "beam", "length=3;ends=free", "", "", "", "load", "", "12.5", "N", "0.1", "exact",
            "same", "", "closed form"
        ]

    def tearDown(self):
        shutil.rmtree(self.folder)

    def write(self, name, lines):
        (self.folder / name).write_text("\n".join(lines) + "\n")

    def packed(self, column, *rows):
        self.assertEqual(self.run_pack(*rows).returncode, 0)
        with h5py.File(self.folder / "t.h5") as file:
            values = list(file["truths/beam"][column])
        (self.folder / "t.h5").unlink()
        return values

    def run_pack(self, *rows):
        with open(self.folder / "tables" / "beam.csv", "w", newline="") as table:
            writer = csv.writer(table, lineterminator="\n")
            writer.writerow(pack.COLUMNS)
            writer.writerows(rows)
        return subprocess.run([
            sys.executable, ROOT / "reference" / "pack.py", "-o", self.folder / "t.h5", "--folder",
            self.folder
        ],
                              capture_output=True,
                              text=True,
                              check=False)

    def changed(self, **fields):
        row = list(self.row)
        for name, value in fields.items():
            row[pack.COLUMNS.index(name)] = value
        return row

    def refused(self, word, *rows):
        done = self.run_pack(*rows)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1)
        self.assertIn(word, done.stderr)
        self.assertFalse(list(self.folder.glob("t.h5*")))

    def test_round_trip(self):
        self.assertEqual(self.run_pack(self.row).returncode, 0)
        with h5py.File(self.folder / "t.h5") as file:
            self.assertEqual(file.attrs["schema"], b"beamwork-truths")
            self.assertEqual(file["truths/beam"]["value"][0], 12.5)
            self.assertEqual(file["truths/beam"]["quantity"][0], b"load")
            self.assertEqual(int(file["truths/beam"]["hash"][0]), pack.fnv1a("length=3;ends=0;"))

    def test_hash_of_known_text(self):
        self.assertEqual(pack.fnv1a(""), 0xCBF29CE484222325)
        self.assertEqual(pack.fnv1a("a"), 0xAF63DC4C8601EC8C)
        self.assertEqual(pack.fnv1a("foobar"), 0x85944171F73967E8)

    def test_any_value(self):
        self.assertEqual(pack.parameter_hash([("x", 1.0, [])], "x=*", "here"), pack.fnv1a("x=*;"))

    def test_refused_truths(self):
        for word, fields in (("unknown case", {"case": "bean"}), ("unknown parameter", {
                "parameters": "lenght=3"
        }), ("is none of", {"parameters": "ends=loose"}), ("finite", {
                "parameters": "length=long"
        }), ("given twice", {"parameters": "length=3;length=4"}), ("name=value", {
                "parameters": "length"
        }), ("finite", {"value": "nan"}), ("finite", {"value": "inf"}), ("finite", {
                "value": ""
        }), ("finite", {"uncertainty": "nan"}), ("negative", {"uncertainty": "-1"}), ("kind", {
                "kind": "guess"
        }), ("model", {"model": "similar"}), ("unit", {"unit": ""}), ("source", {
                "source": ""
        }), ("discrete", {"formulation": "beamw"}), ("discrete", {"elements": "4"}), ("elements", {
                "formulation": "beamw", "elements": "four"
        }), ("elements", {"formulation": "beamw", "elements": "-2"}), ("theory", {
                "theory": "timoshenko"
        }), ("convention", {"convention": "spatial moments"}), ("convention", {
                "convention": "vector spatial"
        }), ("at", {"at": "half"}), ("predicted", {"kind": "predicted"}), ("discrete", {
                "kind": "agreement", "formulation": "beamw"
        }), ("predicted", {"kind": "predicted", "formulation": "beamw", "elements": "4"})):
            with self.subTest(word=word, **fields):
                self.refused(word, self.changed(**fields))

    def test_a_limit_of_one_formulation_is_read_from_its_own_folder(self):
        (self.folder / "predicted").mkdir()
        predicted = self.changed(kind="predicted", formulation="beamw", value="11")
        self.write("predicted/beam.csv", [",".join(pack.COLUMNS), ",".join(predicted)])
        self.assertEqual(self.packed("formulation", self.row), [b"", b"beamw"])
        self.write("predicted/beam.csv", [",".join(pack.COLUMNS), ",".join(self.row)])
        self.refused("the same row", self.row)

    def test_points_of_a_curve_differ_in_their_abscissa(self):
        at = self.packed("at", self.changed(at="0.5"), self.changed(at="0.6"), self.row)
        self.assertEqual(at[:2], [0.5, 0.6])
        self.assertNotEqual(at[2], at[2])
        self.refused("the same row", self.changed(at="0.5"), self.changed(at="0.50"))

    def test_theories_are_told_apart(self):
        self.assertEqual(
            self.packed("theory", self.changed(theory="engesser"), self.changed(theory="haringx")),
            [b"engesser", b"haringx"])
        self.refused("the same row", self.changed(theory="haringx"), self.changed(theory="haringx"))

    def test_words_that_contradict_the_parameters(self):
        self.write("defaults.csv", [
            "case,parameter,value,choices", "beam,length,2,", "beam,ends,1,free|fixed",
            "beam,shear_stability,0,engesser|haringx",
            "beam,moment_convention,0,spatial|semitangential|symmetrised"
        ])
        self.refused("shear_stability", self.changed(theory="haringx"))
        self.refused("shear_stability",
                     self.changed(parameters="shear_stability=haringx", theory="engesser"))
        self.refused("moment_convention", self.changed(quantity="C_xx"))
        self.refused("moment_convention",
                     self.changed(quantity="C_xx", convention="semitangential RyRzRx"))
        self.assertEqual(
            self.run_pack(self.changed(parameters="shear_stability=haringx", theory="haringx"),
                          self.changed(quantity="C_xx", convention="spatial RyRzRx")).returncode, 0)

    def test_refused_pairs(self):
        self.refused("the same row", self.row, self.row)
        self.refused("the same row", self.row,
                     self.changed(parameters="ends=free;length=3.0", source="another program"))
        self.refused("but in N", self.row, self.changed(parameters="", unit="kN"))

    def test_refused_findings(self):
        good = [
            "shear-left-out", "beamw", "beam", "length>1", "load", "wrong limit", "0.1",
            "beam/load", "why", "test"
        ]
        wrong = (("one word", 0, "two words"), ("formulations", 1, ""), ("unknown case", 2, "bean"),
                 ("needs quantities", 4, ""), ("is none of", 5, "wrong"), ("finite", 6, "nan"),
                 ("case/quantity", 7, "load"), ("needs cause", 8, ""), ("needs proof", 9, ""))
        for word, at, value in wrong:
            with self.subTest(word=word):
                bad = good[:at] + [value] + good[at + 1:]
                self.write("findings.csv", [",".join(pack.FINDING_COLUMNS), ",".join(bad)])
                self.refused(word, self.row)
        self.write("findings.csv", [",".join(pack.FINDING_COLUMNS), ",".join(good), ",".join(good)])
        self.refused("the same rule", self.row)
        self.write("findings.csv", [",".join(pack.FINDING_COLUMNS), ",".join(good)])
        self.assertEqual(self.run_pack(self.row).returncode, 0)

    def test_refused_entries_of_the_glossary(self):
        head, good = ",".join(glossary.GLOSSARY_COLUMNS), "limit,end,convergence,What values tend to.,"
        for word, line in (("needs meaning", "order,,convergence,,"),
                           ("needs group", "order,,,A power.,"), ("needs term", ",,g,A power.,"),
                           ("is explained at", "order,END,convergence,A power.,"),
                           ("is explained at", "Limit,,convergence,A power.,"),
                           ("which is not another term", "order,,convergence,A power.,end"),
                           ("which is not another term", "order,,convergence,A power.,order")):
            with self.subTest(line=line):
                self.write("glossary.csv", [head, good, line])
                self.refused(word, self.row)
        self.write("glossary.csv", [head, good, "order,,convergence,A power.,limit"])
        self.assertEqual(self.run_pack(self.row).returncode, 0)
        with h5py.File(self.folder / "t.h5") as file:
            self.assertEqual(list(file["glossary"]["term"]), [b"limit", b"order"])

    def test_refused_rows_of_what_is_accepted(self):
        head, good = ",".join(accepted.ACCEPTED_COLUMNS), "beam,2026-11-21,0.1.0"
        for word, line in (("without options", "beam:mass=lumped,2026-11-21,0.1.0"),
                           ("without options", ",2026-11-21,0.1.0"),
                           ("is accepted at", "beam,2026-11-22,0.1.0"),
                           ("is not a date", "other,yesterday,0.1.0"),
                           ("is not a version", "other,2026-11-21,first"),
                           ("wrong number of fields", "other,2026-11-21")):
            with self.subTest(line=line):
                self.write("accepted.csv", [head, good, line])
                self.refused(word, self.row)
        self.write("accepted.csv", [head, good, "other,2026-11-22,0.1.0"])
        self.assertEqual(self.run_pack(self.row).returncode, 0)
        with h5py.File(self.folder / "t.h5") as file:
            self.assertEqual(list(file["accepted"]["formulation"]), [b"beam", b"other"])

    def test_refused_files(self):
        self.refused("wrong number of fields", self.row[:-1])
        (self.folder / "tables" / "beam.csv").unlink()
        (self.folder / "tables" / "other.csv").write_bytes(b"case,\xff\n")
        self.refused("decode", self.row)
        (self.folder / "tables" / "other.csv").unlink()
        self.write("defaults.csv",
                   ["case,parameter,value,choices", "beam,length,2,", "beam,length,3,"])
        self.refused("given twice", self.row)

    def test_old_file_survives_a_refusal(self):
        self.assertEqual(self.run_pack(self.row).returncode, 0)
        before = (self.folder / "t.h5").read_bytes()
        self.assertEqual(self.run_pack(self.changed(value="nan")).returncode, 1)
        self.assertEqual((self.folder / "t.h5").read_bytes(), before)


class Words(unittest.TestCase):

    def test_the_program_knows_the_same_words(self):
        text = "".join((ROOT / "harness" / "study" / name).read_text(encoding="utf-8")
                       for name in ("study.h", "truths.c", "truth.c", "truth.c"))
        text += (ROOT / "cases" / "scene" / "scene.h").read_text(encoding="utf-8")
        for name, words in (("truth_kinds", pack.KINDS), ("SCENE_SHEAR_THEORIES", pack.THEORIES[1:]),
                            ("conventions", pack.CONVENTIONS[1:])):
            quoted = re.search(rf'\b{name}(?:\[\] =)?\s+((?:"[^"]*"\s*)+)', text)[1]
            self.assertEqual("".join(re.findall(r'"([^"]*)"', quoted)).split("|"), list(words),
                             name)
        self.assertIn(f"TRUTHS_VERSION = {pack.VERSION} ", text)


class Tables(unittest.TestCase):

    def test_tables_parse(self):
        defaults = pack.read_defaults(ROOT / "reference" / "defaults.csv")
        truths = pack.read_truths([ROOT / "reference" / name for name in pack.TRUTH_FOLDERS],
                                  defaults)
        self.assertGreater(sum(len(rows) for rows in truths.values()), 300)
        self.assertLessEqual(len(pack.read_findings(ROOT / "reference" / "findings.csv", defaults)),
                             45)

    def test_every_exact_row_names_its_program(self):
        defaults = pack.read_defaults(ROOT / "reference" / "defaults.csv")
        for rows in pack.read_truths([ROOT / "reference" / name for name in pack.TRUTH_FOLDERS],
                                     defaults).values():
            for row in rows:
                if row["kind"] == "exact":
                    self.assertTrue((ROOT / row["source"]).is_file(), row)


if __name__ == "__main__":
    unittest.main()
