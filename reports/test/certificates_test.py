"""Element reports must show the results of `beamwork element-test`. Formulations without a rank must never be the one
of lowest cost."""
import json
import math
import re
import shutil
import subprocess
import sys
import unittest

import h5py
import numpy

from harness.records.test.stored import put_experiment
from harness.tools.kit.program import ProgramTest, ROOT, drawn, report, run
from reference.pack import seal
from reports import answers, answers_table, certificates, data, experiments, problems


class Site:
    def __init__(self, folder, keys):
        self.results = folder / "results.h5"
        self.styles = type("Styles", (), {"order": keys})


class Words(unittest.TestCase):

    def test_percent(self):
        self.assertEqual([certificates.percent(e) for e in (None, 1e-10, -0.012, 2e-7, 30)],
                         ["–", "exact", "1.2 %", "2e-05 %", "3e+03 %"])

    def test_order(self):
        one = {"least": 2, "highest": 4, "order": 3.96, "error": [0.1, 0.01]}
        self.assertEqual(certificates.order(one), "4.0, declared 2 to 4")
        self.assertEqual(certificates.order({**one, "order": None, "error": [1e-12, 1e-13]}),
                         "exact, declared 2 to 4")
        self.assertEqual(certificates.order({**one, "order": None, "error": [0.1, None]}),
                         "none seen, declared 2 to 4")

    def test_standing(self):
        def of(*outcomes):
            return certificates.standing({"claims": [{"outcome": o} for o in outcomes]})
        self.assertEqual(of("not claimed"), ("not claimed", 0))
        self.assertEqual(of("not claimed", "holds", "holds"), ("holds", 2))
        self.assertEqual(of("holds", "broken"), ("broken", 2))


class Present(ProgramTest):

    def test_only_with_certificates_of_what_was_run(self):
        site = Site(self.folder, ["beamw:mass=lumped", "collocation"])
        self.assertFalse(certificates.present(site))
        run("element-test", "beamw", "sheet_second", "-o", site.results)
        self.assertEqual(certificates.names(site), {"beamw"})
        self.assertFalse(certificates.present(Site(self.folder, ["collocation"])))


class Page(ProgramTest):

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        path = folder / "results.h5"
        run("element-test", "beamw", "geometrically_exact", "-o", path)
        record = experiments.read(path, "element-test")
        record["formulations"][1].update(summary="<b>&", kept=False)
        claim = next(c for c in record["claims"] if c["formulation"] == "geometrically_exact")
        claim.update(outcome="broken", sentence="J: <i> is wrong")
        path.unlink()
        put_experiment(path, "element-test", record)
        site = drawn(folder, "-k", "elastica/default", "-f", "beamw", "-f", "geometrically_exact")
        cls.page = (site / "certificates.html").read_text(encoding="utf-8")
        cls.formulation = (site / "formulation_beamw.html").read_text(encoding="utf-8")

    def test_all_is_there(self):
        for words in ('id="beamw"', 'id="geometrically_exact"', "pure torsion", "exact",
                      "quarter ring", "declared 2 to 4", "J is the derivative of the strains"):
            self.assertIn(words, self.page)
        self.assertEqual(self.page.count("<figure"), 2)

    def test_broken_is_told(self):
        self.assertIn("It is violated by geometrically_exact.", " ".join(self.page.split()))
        self.assertIn("J: &lt;i&gt; is wrong", self.page)

    def test_names_are_escaped(self):
        self.assertIn("&lt;b&gt;&amp;", self.page)
        self.assertNotIn("<b>&", self.page)

    def test_linked(self):
        self.assertIn('href="certificates.html#beamw"', self.formulation)


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
        for name, why in NAMES.items():
            words = f"({why})"
            for page in ("index.html", "tapered_cantilever.html", "formulations.html"):
                self.assertRegex(self.page(page),
                                 re.escape(f"formulation_{name}.html") + "[^(]*" + re.escape(words))
            self.assertIn(f"{name} {words}", self.page("tapered_cantilever.html"))
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
        own = json.loads(self.page("answers_points.js").removeprefix("window.answersPoints = ").removesuffix(";\n"))
        self.assertEqual(set(own["cases"][0]["unranked"].values()), {*NAMES.values(), "kept with its misprint"})

    def test_profiles(self):
        page = self.page("profiles.html")
        self.assertIn("whose costs cannot be ranked", page)

    def test_results_without_costs(self):
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
        self.assertNotIn("costs tie", text)
        _, cases = data.read_results(old)
        self.assertEqual(answers.answer(cases[0].points[0], answers.ALL, 0.01).best, [])


if __name__ == "__main__":
    unittest.main()
