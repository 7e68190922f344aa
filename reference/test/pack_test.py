"""The packing of truths: round trip, hash, and every refusal."""
import csv
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))
from reference import pack  # noqa: E402


class Pack(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        (self.folder / "tables").mkdir()
        self.write("defaults.csv", ["case,parameter,value,choices", "beam,length,2,", "beam,ends,1,free|fixed"])
        self.write("findings.csv", [",".join(pack.FINDING_COLUMNS)])
        self.write("extreme_findings.csv", [",".join(pack.EXTREME_COLUMNS)])
        self.row = ["beam", "length=3;ends=free", "", "", "load", "12.5", "N", "0.1", "exact", "same", "", "closed form"]

    def tearDown(self):
        shutil.rmtree(self.folder)

    def write(self, name, lines):
        (self.folder / name).write_text("\n".join(lines) + "\n")

    def run_pack(self, *rows):
        with open(self.folder / "tables" / "beam.csv", "w", newline="") as table:
            writer = csv.writer(table, lineterminator="\n")
            writer.writerow(pack.COLUMNS)
            writer.writerows(rows)
        return subprocess.run([sys.executable, ROOT / "reference" / "pack.py", "-o", self.folder / "t.h5", "--folder", self.folder],
                              capture_output=True, text=True, check=False)

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
            self.assertEqual(file["truths/beam/value"][0], 12.5)
            self.assertEqual(file["truths/beam/quantity"][0], b"load")
            self.assertEqual(int(file["truths/beam/hash"][0]), pack.fnv1a("length=3;ends=0;"))

    def test_hash_of_known_text(self):
        self.assertEqual(pack.fnv1a(""), 0xCBF29CE484222325)
        self.assertEqual(pack.fnv1a("a"), 0xAF63DC4C8601EC8C)
        self.assertEqual(pack.fnv1a("foobar"), 0x85944171F73967E8)

    def test_any_value(self):
        self.assertEqual(pack.parameter_hash([("x", 1.0, [])], "x=*", "here"), pack.fnv1a("x=*;"))

    def test_refused_truths(self):
        for word, fields in (("unknown case", {"case": "bean"}), ("unknown parameter", {"parameters": "lenght=3"}), ("is none of", {"parameters": "ends=loose"}),
                             ("finite", {"parameters": "length=long"}), ("given twice", {"parameters": "length=3;length=4"}), ("name=value", {"parameters": "length"}),
                             ("finite", {"value": "nan"}), ("finite", {"value": "inf"}), ("finite", {"value": ""}), ("finite", {"uncertainty": "nan"}),
                             ("negative", {"uncertainty": "-1"}), ("kind", {"kind": "guess"}), ("model", {"model": "similar"}), ("unit", {"unit": ""}), ("source", {"source": ""}),
                             ("discrete", {"formulation": "beamw"}), ("discrete", {"elements": "4"}), ("elements", {"formulation": "beamw", "elements": "four"}),
                             ("elements", {"formulation": "beamw", "elements": "-2"})):
            with self.subTest(word=word, **fields):
                self.refused(word, self.changed(**fields))

    def test_refused_pairs(self):
        self.refused("the same row", self.row, self.row)
        self.refused("the same row", self.row, self.changed(parameters="ends=free;length=3.0", source="another program"))
        self.refused("but in N", self.row, self.changed(parameters="", unit="kN"))

    def test_refused_findings(self):
        good = ["beam", "length=*", "beamw", "load", "wrong limit", "11", "0.1", "why"]
        for word, at, value in (("unknown case", 0, "bean"), ("unknown parameter", 1, "lenght=3"), ("unknown verdict", 4, "bad"), ("finite", 5, "nan"), ("together", 6, ""), ("proof", 7, "")):
            with self.subTest(word=word):
                bad = good[:at] + [value] + good[at + 1:]
                self.write("findings.csv", [",".join(pack.FINDING_COLUMNS), ",".join(bad)])
                self.refused(word, self.row)
        self.write("findings.csv", [",".join(pack.FINDING_COLUMNS), ",".join(good), ",".join(good)])
        self.refused("the same finding", self.row)
        self.write("findings.csv", [",".join(pack.FINDING_COLUMNS), ",".join(good)])
        self.assertEqual(self.run_pack(self.row).returncode, 0)

    def test_refused_files(self):
        self.refused("wrong number of fields", self.row[:-1])
        (self.folder / "tables" / "beam.csv").unlink()
        (self.folder / "tables" / "other.csv").write_bytes(b"case,\xff\n")
        self.refused("decode", self.row)
        (self.folder / "tables" / "other.csv").unlink()
        self.write("defaults.csv", ["case,parameter,value,choices", "beam,length,2,", "beam,length,3,"])
        self.refused("given twice", self.row)

    def test_old_file_survives_a_refusal(self):
        self.assertEqual(self.run_pack(self.row).returncode, 0)
        before = (self.folder / "t.h5").read_bytes()
        self.assertEqual(self.run_pack(self.changed(value="nan")).returncode, 1)
        self.assertEqual((self.folder / "t.h5").read_bytes(), before)


class Tables(unittest.TestCase):
    def test_tables_parse(self):
        defaults = pack.read_defaults(ROOT / "reference" / "defaults.csv")
        truths = pack.read_truths(ROOT / "reference" / "tables", defaults)
        self.assertGreater(sum(len(rows) for rows in truths.values()), 300)
        pack.read_findings(ROOT / "reference" / "findings.csv", defaults)

    def test_every_exact_row_names_its_program(self):
        defaults = pack.read_defaults(ROOT / "reference" / "defaults.csv")
        for rows in pack.read_truths(ROOT / "reference" / "tables", defaults).values():
            for row in rows:
                if row["kind"] == "exact":
                    self.assertTrue((ROOT / row["source"]).is_file(), row)


if __name__ == "__main__":
    unittest.main()
