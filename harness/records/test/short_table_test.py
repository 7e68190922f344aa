"""The short table of a run."""
import csv
import unittest

import h5py
import numpy as np

from harness.records.test.stored import WORK, altered, table_of, verify
from harness.tools.kit.program import ProgramTest, run

SELECTION = "warping_torsion/default or bend_45/default and collocation"
FLOOR, ERROR = 1e-8, 0.01


def names_of(case, rows):
    return [f"{case}/default/{row['formulation'].decode()}" for row in rows]


def change_rows(file, table, change):
    for case, group in file["cases"].items():
        rows = group[table][()]
        change(case, rows)
        group[table][()] = rows


class ShortTable(ProgramTest):

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        cls.old, cls.new, cls.table, cls.bad = (
            folder / name for name in ("old.h5", "new.h5", "old.csv", "bad.csv")
        )
        verify(SELECTION, cls.old)
        table_of(cls.old, cls.table)
        cls.text = cls.table.read_text(encoding="utf-8")
        cls.row = list(csv.DictReader(cls.text.splitlines()))

    def noticed(self, table, change, former=None):
        altered(self.old, self.new, lambda file: change_rows(file, table, change))
        done = run("compare", former or self.table, self.new)
        self.assertIn(done.returncode, (0, 1), done)
        return done.stdout.splitlines()[:-2]

    def expect(self, planted, lines, words):
        self.assertEqual({line.split()[1].rstrip(":") for line in lines}, set(planted), lines)
        for word in words:
            self.assertTrue(all(word in line for line in lines), lines)

    def plant(self, table, allowed, alter, words):
        """For every k, applies alter(rows, i) to the k-th row of every series and expects the change to be detected.
        Returns the number of changes."""
        total = 0
        for k in range(1000):
            planted = []

            def change(case, rows, k=k, planted=planted):
                names = names_of(case, rows)
                for name in sorted(set(names)):
                    own = [i for i, n in enumerate(names) if n == name and allowed(rows[i])]
                    if k < len(own):
                        alter(rows, own[k])
                        planted.append(name)

            lines = self.noticed(table, change)
            if not planted:
                return total
            self.expect(planted, lines, words)
            total += len(planted)
        self.fail("series without end")

    def errors(self, sign):
        def alter(rows, i):
            error = rows["error"][i]
            rows["error"][i] += np.copysign(1.1 * (FLOOR + ERROR * abs(error)), sign * error)

        return alter

    def test_errors(self):
        has = lambda row: np.isfinite(row["error"])
        least = lambda row: has(row) and abs(row["error"]) > 10 * FLOOR
        self.assertGreater(self.plant("quantities", has, self.errors(1), ["worse", "error"]), 60)
        self.assertGreater(
            self.plant("quantities", least, self.errors(-1), ["better", "error"]), 20
        )

    def test_lost_values(self):
        def lose(rows, i):
            rows["error"][i] = np.nan

        self.plant(
            "quantities",
            lambda row: np.isfinite(row["error"]),
            lose,
            ["worse", "values with a known error"],
        )

    def test_work(self):
        def one(column):
            def more(rows, i):
                rows[column][i] += 1

            return more

        def half(column):
            def more(rows, i):
                rows[column][i] += rows[column][i] // 2

            return more

        for word in ("iterations", "factorisations"):
            self.assertGreater(
                self.plant("cells", lambda row: True, one(word), ["worse", word]), 60
            )
        fine = lambda row: row["elements"] > 4
        for column, word in (("strain_evaluations", "evaluations"), ("factor_flops", "flops"),
                             ("solved_entries", "entries")):
            self.assertGreater(self.plant("cells", fine, half(column), ["worse", word]), 30)
        self.assertGreater(
            self.plant("cells", lambda row: True, one("solutions"), ["worse", "solutions"]), 60
        )

    def test_limits(self):
        has = lambda row: np.isfinite(row["limit"])

        def move(rows, i):
            rows["limit"][i] += 1e-7 * max(abs(rows["limit"][i]), 1e-3)

        def lose(rows, i):
            rows["limit"][i] = np.nan

        self.assertGreater(self.plant("verdicts", has, move, ["changed", "limit of"]), 10)
        self.assertGreater(self.plant("verdicts", has, lose, ["worse", "no longer has a limit"]), 10)

    def test_renamed_limit(self):
        text = self.text.replace("u_tangent=", "v=")
        self.bad.write_text(text, encoding="utf-8")
        lines = self.noticed("cells", lambda case, rows: None, self.bad)
        self.assertEqual(
            [line.split(": ")[1] for line in lines],
            ["v no longer has a limit", "u_tangent has a limit now"],
        )

    def test_statuses(self):
        def fail(rows, i):
            rows["status"][i] = b"x"

        self.assertGreater(self.plant("cells", lambda row: True, fail, ["worse", ": ok -> x"]), 60)

    def test_columns(self):
        with h5py.File(self.old, "r") as file:
            for row in self.row:
                case, _, formulation = row["series"].split("/")
                tables = {
                    name: file["cases"][case][name][()]
                    for name in ("cells", "quantities", "verdicts")
                }
                own = {
                    name: table[table["formulation"] == formulation.encode()]
                    for name, table in tables.items()
                }
                self.check_row(row, own)

    def check_row(self, row, own):
        self.assertEqual([int(n) for n in row["meshes"].split()], sorted(own["cells"]["elements"]))
        for word, columns in WORK.items():
            self.assertEqual(int(row[word]), sum(int(own["cells"][c].sum()) for c in columns))
        judged = own["quantities"][np.isfinite(own["quantities"]["error"])]
        size = np.abs(judged["error"])
        self.assertEqual(int(row["errors"]), len(judged))
        self.assertAlmostEqual(float(row["decades"]), np.log10(np.maximum(size, FLOOR)).sum(), delta=1e-6)
        worst = {n: size[judged["elements"] == n].max() for n in set(judged["elements"])}
        self.check_error(row, "largest", judged, max(worst.values()))
        self.check_error(row, "least", judged, min(worst.values()))
        limits = {
            quantity.decode(): value
            for quantity, value in own["verdicts"][["quantity", "limit"]]
            if np.isfinite(value)
        }
        found = dict(item.rsplit("=", 1) for item in row["limits"].split())
        self.assertEqual(set(found), set(limits))
        for quantity, value in limits.items():
            self.assertAlmostEqual(float(found[quantity]), value, delta=1e-9 * abs(value))

    def check_error(self, row, which, judged, size):
        self.assertAlmostEqual(float(row[which]), size, delta=1e-5 * size)
        of = judged[
            (judged["elements"] == int(row[f"{which}_elements"]))
            & (judged["quantity"] == row[f"{which}_quantity"].encode())
        ]
        self.assertAlmostEqual(abs(of["error"][0]), size, delta=1e-5 * size)

    def test_other_points(self):
        path = verify("warping_torsion and beamw_vlasov", self.folder / "points.h5")
        text = table_of(path, self.bad).read_text(encoding="utf-8")
        rows = list(csv.DictReader(text.splitlines()))
        self.assertGreater(len(rows), 3)
        self.assertEqual([row["series"] for row in rows], sorted(row["series"] for row in rows))
        for row in rows:
            self.assertEqual(row["limits"] != "", "/default/" in row["series"], row)

    def test_missing(self):
        lines = self.text.splitlines(keepends=True)
        self.bad.write_text("".join(lines[:2] + lines[3:]), encoding="utf-8")
        for pair, word in (((self.table, self.bad), "gone"), ((self.bad, self.old), "new")):
            done = run("compare", *pair)
            self.assertEqual(done.returncode, 1, done)
            self.assertIn(f"{word:8} {self.row[1]['series']}\n", done.stdout)

    def damaged(self, text, word):
        self.bad.write_text(text, encoding="utf-8")
        done = run("compare", self.bad, self.old)
        self.assertEqual(done.returncode, 2, (text, done))
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        self.assertIn(word, done.stderr)

    def test_damaged(self):
        lines = self.text.splitlines()
        fields = next(csv.reader([lines[3]]))
        spoilt = {
            "series": ("", 1300 * "n"),
            "meshes": ("", "0", "2 1", "2 2", "1:", "a", "1:" + 20 * "s"),
            "limits": ("x", "=1", "x=", "x=nan", "x=1e999", 60 * "q" + "=1"),
        }
        for i, name in enumerate(self.row[0]):
            text = (
                ("", 60 * "q")
                if name.endswith("quantity")
                else ("", "x", "nan", "1e999", "-1e10", "1 2")
            )
            for bad in spoilt.get(name, text):
                self.spoilt(lines, ",".join(fields[:i] + [bad] + fields[i + 1 :]))
        whole = ",".join(fields)
        for row in (",".join(fields[:-1]), whole + ",", "", '"' + whole, whole + 20000 * " "):
            self.spoilt(lines, row)
        self.damaged("\n".join(lines + [lines[3]]) + "\n", "occurs twice")

    def spoilt(self, lines, row):
        self.damaged(
            "\n".join(lines[:3] + [row] + lines[4:]) + "\n", f"{self.bad}:4: the row is damaged"
        )

    def test_cut(self):
        rows = self.text.count("\n")
        for end in (1, 5, 40):
            self.damaged(self.text[:-end], f"{self.bad}:{rows}: the row is damaged or truncated")
        for text in ("", self.text[:100], "cell,elements,status\n", "\n" + self.text):
            self.damaged(text, "neither a result")


if __name__ == "__main__":
    unittest.main()
