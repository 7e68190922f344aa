"""The program as a user meets it: answers, refusals with one line and the documented exit code,
no partial file."""
import os
import pathlib
import re
import shutil
import unittest

import h5py

from harness.tools.kit.program import ROOT, TRUTHS, ProgramTest, environment, run
from reference.pack import seal

EXAMPLES = ROOT / "cases" / "examples"


def solve(case, *assignments):
    """Words that solve a case on a small mesh."""
    sets = [word for assignment in assignments for word in ("--set", assignment)]
    return ("solve", case, "-f", "beamw", "-n", "2", *sets)


def untimed(text):
    """What verify shows, but for the time it took."""
    return re.sub(r"noise, in [\d.]+ s", "noise", text)


class Refusals(ProgramTest):
    def test_names(self):
        self.refused(2, "did you mean 'c_column'", "solve", "c_colum", "-f", "beamw", "-n", "2")
        self.refused(2, "did you mean 'beamw'", "solve", "c_column", "-f", "beamv", "-n", "2")
        self.refused(2, "did you mean 'length'", *solve("c_column", "lenght=2"))
        self.refused(2, "did you mean 'verify'", "verifi")

    def test_values(self):
        for bad in ("length=-1", "length=nan", "length=inf", "length=0x10", "length=1e-999", "young=0", "flange_thickness=0"):
            self.refused(2, bad.partition("=")[0], *solve("c_column", bad))
        self.refused(2, "positive definite", *solve("c_column", "section_data=misprinted"))
        self.refused(2, "poisson", *solve("sheet_cantilever", "poisson=0.5"))
        self.refused(2, "tip_deflection", *solve("sheet_cantilever", "tip_deflection=0.2"))
        self.refused(2, "elements", "solve", "c_column", "-f", "beamw", "-n", "0")
        self.refused(2, "memory", "solve", "c_column", "-f", "beamw", "-n", "10000000")
        self.refused(2, "does not offer coupled section", "solve", "coupled_beam", "-f",
                     "beamw_vlasov", "-n", "2")
        done = self.answered("solve", "sheet_cantilever", "-f", "collocation:newton=dense", "-n", "2",
                             "--set", "modes=3", code=1)
        self.assertIn("give newton=mixed", done.stdout + done.stderr)

    def test_byte_order_marks(self):
        """At the beginning of any text that is read, as some editors put them."""
        results, table = self.folder / "r.h5", self.folder / "r.csv"
        self.answered("verify", "-k", "=elastica", "-f", "beamw", "-o", results)
        self.answered("compare", results, "-o", table)
        scene = (EXAMPLES / "euler_column.yaml").read_text(encoding="utf-8")
        columns = {name: (ROOT / "reference" / name).read_text(encoding="utf-8").splitlines()[0] + "\n"
                   for name in ("findings.csv", "tables/elastica.csv")}
        imported = ("# beamwork-import: 1\n# program: mine\n# case: elastica\n"
                    "quantity, unit, elements, value\nw_over_L, 1, 4, 0.3\n")
        for text, words in ((table.read_text(encoding="utf-8"), ("compare", "FILE", results)),
                            (scene, ("solve", "--scene", "FILE")), (imported, ("import", "FILE", "-o", self.folder / "i.h5")),
                            (columns["findings.csv"], ("verify", "-k", "=elastica", "-f", "beamw", "--findings", "FILE")),
                            (columns["tables/elastica.csv"],
                             ("verify", "-k", "=elastica", "-f", "beamw", "--truths", "FILE"))):
            path = self.folder / ("marked.yaml" if text == scene else "marked.csv")
            path.write_text(text, encoding="utf-8-sig")
            self.answered(*[path if word == "FILE" else word for word in words])

    def test_examples_have_names(self):
        """A scene of cases/examples is a case by its name, as in the report."""
        path = EXAMPLES / "euler_column.yaml"
        for verb in (("list", ), ("solve", "-f", "beamw", "-n", "2", "--format", "csv"), ("truth", )):
            by_name, by_file = (self.answered(verb[0], *of, *verb[1:]).stdout
                                for of in (("euler_column", ), ("--scene", path)))
            self.assertEqual(re.sub(r"\d\.\d+(e-\d+)?", "#", by_name), re.sub(r"\d\.\d+(e-\d+)?", "#", by_file))
        self.refused(2, "unknown case 'euler_colum'", "solve", "euler_colum")

    def test_truth_files(self):
        foreign, cut = self.folder / "foreign.h5", self.folder / "cut.h5"
        foreign.write_bytes(b"hello")
        cut.write_bytes(pathlib.Path(TRUTHS).read_bytes()[:3000])
        for path in (foreign, cut, self.folder / "missing.h5"):
            self.refused(4, str(path), "verify", "--truths", path)

    def test_unwritable_output(self):
        words = "cannot be written"
        self.refused(4, words, "verify", "-k", "warping_torsion", "-o", "/nowhere/results.h5")
        self.refused(4, words, *solve("warping_torsion"), "-o", self.folder)
        self.assertEqual(os.listdir(self.folder), [])

    def test_full_disk(self):
        if os.path.exists("/dev/full"):
            with open("/dev/full", "w", encoding="ascii") as full:
                self.answered(*solve("warping_torsion"), code=4, stdout=full)

    def test_nothing_checked(self):
        self.refused(3, "nothing was judged", "verify", "-k", "elastica and hexapod",
                     silent=False)

    def test_misspelt_selection(self):
        """A word that names nothing would leave cells out in silence; in brackets or not."""
        for verb in ("verify", "stress"):
            self.refused(2, "did you mean 'elastica'?", verb, "-k", "elastca")
            self.refused(2, "'sheet_thrid'", verb, "-k", "(elastica or sheet_thrid)")
        found = [untimed(self.answered("verify", "-k", selection).stdout) for selection in
                 ("warping_torsion/default or elastica/default",
                  "(warping_torsion/default or elastica/default)",
                  "((elastica or warping_torsion) and (default))")]
        self.assertEqual(len(set(found)), 1, found)


class Answers(ProgramTest):
    def test_json(self):
        result = self.record(*solve("c_column", "section_data=printed"))
        self.assertEqual(result["schema_version"], 3)
        self.assertEqual(result["parameters"]["section_data"], "printed")
        load = result["quantities"][0]
        self.assertAlmostEqual(load["value"] / 12858745.038, 1, delta=1e-9)
        self.assertTrue(any(t["truth_kind"] == "exact" for t in load["truths"]))

    def test_gate(self):
        """A rule that is taken out of the ledger turns the gate red."""
        path = self.folder / "t.h5"
        shutil.copy(TRUTHS, path)
        selection = ("-k", "c_column and section_data=printed and beamw", "--truths", path)
        self.answered("verify", *selection)
        with h5py.File(path, "r+") as file:
            file["findings/quantities"][...] = b"gone"
        seal(path)
        done = self.answered("verify", *selection, code=1)
        self.assertIn("-2.7801 % wrong limit", done.stdout)

    def test_jobs_agree(self):
        one = run("verify", "-k", "warping_torsion", "-j", "1")
        two = run("verify", "-k", "warping_torsion", "-j", "2")
        self.assertEqual(untimed(one.stdout), untimed(two.stdout))

    def test_truth(self):
        """Stored at known points, derived at new ones, refused where no program can."""
        source = r" +1 +exact +same\n +reference/derive/cantilevers.py"
        for load in ("load=2", "load=2.5"):
            done = self.answered("truth", "elastica", "--set", load)
            self.assertRegex(done.stdout, r"w_over_L +0\.[45]\d+ \+- \S+" + source)
        self.answered("truth", "elastica", "--set", "load=zwei", code=2)
        self.answered("truth", "no_such_case", code=2)
        self.refused(4, "", "truth", "elastica", "--set", "load=2.5",
                     silent=False, env=environment(BEAMWORK_REFERENCE="/nowhere"))

    def derived(self, scene, *words):
        """{quantity: (value, uncertainty)} of the lines for the file, and the lines."""
        done = self.answered("truth", "--scene", scene, *words)
        lines = done.stdout.partition("truths:\n")[2]
        found = re.findall(r"quantity: (\w+), value: (\S+), uncertainty: (\S+), kind: exact", lines)
        return {name: (float(value), float(plus)) for name, value, plus in found}, lines

    def test_truth_of_a_scene(self):
        """A scene of one's own is solved as a network: what its file and the built-in case know."""
        for case in ("bend_45", "shear_elastica", "roll_up"):
            scene = self.folder / f"{case}.yaml"
            self.answered("scene", case, "-o", scene)
            stored = re.findall(r"^  (\w+) +(\S+) \+- (\S+) .* exact ",
                                self.answered("truth", case).stdout, re.MULTILINE)
            found = self.derived(scene)[0]
            self.assertEqual({name for name, _, _ in stored}, set(found))
            for name, value, plus in stored:
                self.assertLessEqual(abs(float(value) - found[name][0]),
                                     float(plus) + found[name][1], (case, name))
        text = (EXAMPLES / "box_girder.yaml").read_text(encoding="utf-8")
        beyond, start = self.folder / "beyond.yaml", text.index("truths:\n")
        beyond.write_text(text[:start] + text[text.index("meshes:", start):], encoding="utf-8")
        self.refused(1, "cells", "truth", "--scene", beyond, silent=False)
        done = self.answered("truth", "--scene", EXAMPLES / "box_girder.yaml")
        self.assertIn("cells", done.stderr)

    def test_derived_lines_belong_into_the_file(self):
        """Of the parameters they were derived for, and no others."""
        scene = self.folder / "portal.yaml"
        text = (EXAMPLES / "plane_portal.yaml").read_text(encoding="utf-8")
        head, _, tail = text.partition("truths:\n")
        found, lines = self.derived(EXAMPLES / "plane_portal.yaml", "--set", "push=900")
        scene.write_text(head + "truths:\n" + lines + tail[tail.index("omit:"):], encoding="utf-8")
        there = self.answered("truth", "--scene", scene, "--set", "push=900").stdout
        for name, (value, _) in found.items():
            self.assertRegex(there, rf"{name} +{re.escape(str(value)[:12])}\S* .*exact")
        elsewhere = self.answered("truth", "--scene", scene).stdout
        self.assertNotRegex(elsewhere, r"same\n +reference")


if __name__ == "__main__":
    unittest.main()
