"""Formulations whose costs rank nothing, and new ones: shown and marked everywhere, never first."""
import json
import math
import re
import shutil
import subprocess
import sys
import unittest

import h5py
import numpy

from harness.tools.kit.program import ROOT, ProgramTest, report, run
from reference.pack import seal
from reports import answers, answers_table, data, problems

EXAMPLES = ROOT / "elements" / "examples"
NAMES = {"timoshenko": "by differences", "timoshenko_py": "in another process"}


def series(key, cost, unranked="", errors=(0.001,)):
    clock = data.Clock(0, 1e-3, 1e-3, 1e-3, 1)
    meshes = [data.Mesh(1, "ok", "", clock, 8, 4, "", {}, errors={"u": e}, cost=cost)
              for e in errors]
    verdict = data.Verdict("u", "pass", truth=1.0, truth_kind="exact",
                           reach={level: 1 for level in data.REACH})
    return data.Series(key, "", "", "", meshes, [verdict], unranked=unranked)


def point(*found):
    return data.Point("default", "", list(found), {"u": "m"})


class Rule(unittest.TestCase):

    def test_what_does_not_rank_is_never_first(self):
        one = answers.answer(point(series("a", math.nan, "by differences"), series("b", 1.0)), "u",
                             0.01)
        self.assertEqual([w.key for w in one.best], ["b"])
        self.assertEqual([(w.key, w.unranked) for w in one.unranked], [("a", "by differences")])
        self.assertEqual([(w.key, rank) for w, rank, _ in one.ways], [("b", 1), ("a", 0)])
        alone = answers.answer(point(series("a", math.nan, "by differences")), "u", 0.01)
        self.assertEqual(alone.best, [])
        self.assertEqual(answers_table.sentence(alone),
                         "within 1 %, no rank (by differences): a n = 1")

    def test_without_costs_nobody_wins(self):
        found = answers.answer(point(series("b", math.nan), series("a", math.nan)), "u", 0.01)
        self.assertEqual((found.best, found.dearer), ([], []))
        self.assertIn("no rank (the results have no costs): a n = 1, b n = 1",
                      answers_table.sentence(found))

    def test_not_compared(self):
        case = data.Case("c", "", "", [point(series("a", math.nan, "by differences"),
                                             series("b", 1.0))])
        self.assertEqual(problems.contestants([case]), ["b"])

    def test_the_front_is_of_what_ranks(self):
        fast = series("a", math.nan, "in another process", errors=(1e-6,))
        self.assertEqual([s.key for s, _ in answers.front(point(fast, series("b", 1.0)), "u")],
                         ["b"])


class Drawn(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.at = cls.class_folder()
        made = cls.at / "mine.so"
        subprocess.run(["cc", "-O2", "-shared", "-fPIC", "-I", ROOT, EXAMPLES / "timoshenko.c",
                        "-o", made], check=True)
        cls.results = cls.at / "r.h5"
        done = run("verify", "--element", made, "--element",
                   f"exec:{sys.executable} {EXAMPLES / 'timoshenko.py'}", "-k",
                   "tapered_cantilever/default", "-o", cls.results)
        assert done.returncode == 0, done.stderr
        cls.site = cls.at / "site"
        done = report(cls.results, cls.site)
        assert done.returncode == 0, done.stderr

    def page(self, name):
        return (self.site / name).read_text(encoding="utf-8")

    def test_marks(self):
        """In tables and legends, beside the name."""
        for name, why in NAMES.items():
            words = f"({why})"
            for page in ("index.html", "tapered_cantilever.html", "formulations.html"):
                self.assertRegex(self.page(page),
                                 re.escape(f"formulation_{name}.html") + "[^(]*" + re.escape(words))
            self.assertIn(f"{name} {words}", self.page("tapered_cantilever.html"))  # a legend
            marks = json.loads(re.search(r'id="chosen"[^>]*>(.*?)</script>',
                                         self.page("explorer.html"))[1])["marks"]
            self.assertEqual(marks[name], words[1:-1])
            self.assertIn(words[2:-1], self.page(f"formulation_{name}.html"))
        self.assertNotIn("collocation (", self.page("tapered_cantilever.html"))

    def test_never_first(self):
        _, cases = data.read_results(self.results)
        seen = 0
        for level in data.REACH:
            found = answers.answer(cases[0].points[0], answers.ALL, level)
            self.assertFalse({w.key for w in found.best + found.dearer} & set(NAMES))
            seen += len(found.unranked)
        self.assertGreater(seen, 2)
        self.assertEqual({row["unranked"] for row in answers_table.rows(cases)
                          if row["formulation"] in NAMES and not row["defect"]}, set(NAMES.values()))

    def test_the_page_of_answers(self):
        page = self.page("answers.html")
        for name, why in NAMES.items():
            self.assertRegex(page, rf"no rank \({why}\): {name} n = \d")
        own = json.loads(re.search(r'id="points">(.*?)</script>', page)[1])
        self.assertEqual(set(own["cases"][0]["unranked"].values()), {*NAMES.values(), "kept with its misprint"})

    def test_profiles(self):
        page = self.page("profiles.html")
        self.assertIn("whose costs rank nothing", page)

    def test_results_without_costs(self):
        """Files of before work was priced: no winner is named, and why."""
        old = self.folder / "old.h5"
        shutil.copy(self.results, old)
        with h5py.File(old, "r+") as file:
            group = file["cases/tapered_cantilever"]
            rows = group["cells"][()]
            kept = [name for name in rows.dtype.names if name not in ("cost", "priced")]
            fewer = numpy.zeros(len(rows), dtype=[(n, rows.dtype[n]) for n in kept])
            for name in kept:
                fewer[name] = rows[name]
            del group["cells"]
            group["cells"] = fewer
        seal(old)
        done = report(old, self.folder / "site")
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (self.folder / "site" / "answers.html").read_text(encoding="utf-8")
        self.assertIn("no rank (the results have no costs): beamw n = ", text)
        self.assertNotIn("within noise of each other", text)
        _, cases = data.read_results(old)
        self.assertEqual(answers.answer(cases[0].points[0], answers.ALL, 0.01).best, [])
