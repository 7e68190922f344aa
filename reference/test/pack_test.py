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
        self.assertEqual(pack.fnv1a("a"), 0xAF63DC4C8601EC8C)

    def test_any_value(self):
        self.assertEqual(pack.parameter_hash([("x", 1.0, [])], "x=*", "here"), pack.fnv1a("x=*;"))

    def test_refusals(self):
        self.refused("unknown case", self.changed(case="bean"))
        self.refused("unknown parameter", self.changed(parameters="lenght=3"))
        self.refused("is none of", self.changed(parameters="ends=loose"))
        self.refused("finite", self.changed(value="nan"))
        self.refused("negative", self.changed(uncertainty="-1"))
        self.refused("kind", self.changed(kind="guess"))
        self.refused("unit", self.changed(unit=""))
        self.refused("discrete", self.changed(formulation="beamw"))
        self.refused("the same row", self.row, self.row)


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
