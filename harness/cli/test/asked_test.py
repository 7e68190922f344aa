"""What is not asked for is not computed."""
import h5py

from harness.tools.kit.program import ProgramTest

HEAD = """beamwork: 1
sections: {s: {rectangle: {width: 0.05, thickness: 0.005}, young: 210e9, shear_modulus: 81e9,
               density: 7850}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}
loads: {t: {force: [-1, 0.1, 0], on: b}}
"""
ANALYSES = """analyses:
  path: {static: {stations: [0.5, 1]}}
  c: {compliance: {about: path, node: b}}
  v: {modal: {about: path}}
  plain: {modal: {wanted: 3}}
  w: {buckling: {wanted: 3}}
  l: {linear: {}}
  p: {static: {stations: [1, 2]}}
"""
TIP = "tip: {displacement: {analysis: %s, node: b, component: uy}}"
QUANTITIES = {
    "path": TIP % "path",
    "l": TIP % "l",
    "p": TIP % "p",
    "c": "stiff: {stiffness: {analysis: c, component: uy}}",
    "v": "loaded: {frequency: {analysis: v}}",
    "plain": "plain: {frequency: {analysis: plain}}",
    "w": "crit: {critical_factor: {analysis: w}}",
}


def work(record):
    cell = record["cell"]
    return {k: cell[k] for k in ("factorisations", "solutions", "iterations",
                                 "stress_evaluations")}


class Asked(ProgramTest):
    def solved(self, text, *options):
        path = self.folder / "scene.yaml"
        path.write_text(text)
        return self.record("solve", "--scene", path, "-f", "collocation", "-n", "4", *options)

    def only(self, names):
        """A scene that has these analyses and no others."""
        lines = ANALYSES.splitlines(keepends=True)
        return HEAD + "".join(lines[:1] + [x for x in lines[1:]
                                           if x.split(":")[0].strip() in names])

    def test_analyses_that_nobody_reads(self):
        """The work and the bits of a scene that has no more than what is read."""
        for asked, line in QUANTITIES.items():
            wanted = f"quantities:\n  {line}\n"
            needed = {asked, "path"} if asked in "cv" else {asked}
            least = self.solved(self.only(needed) + wanted)
            all_of_them = self.solved(HEAD + ANALYSES + wanted)
            self.assertEqual(work(all_of_them), work(least), asked)
            self.assertEqual(all_of_them["quantities"][0]["value"],
                             least["quantities"][0]["value"], asked)

    def test_a_selection(self):
        """-k is the same as writing those quantities only."""
        lines = {k: v.replace("tip:", f"tip_{k}:") for k, v in QUANTITIES.items()}
        text = HEAD + ANALYSES + "quantities:\n" + "".join(f"  {x}\n" for x in lines.values())
        whole = self.solved(text)
        values = {q["quantity"]: q["value"] for q in whole["quantities"]}
        self.assertEqual(len(values), len(lines))
        for asked, line in lines.items():
            name = line.split(":")[0]
            one = self.solved(text, "-k", name)
            chosen = {q["quantity"]: q["value"] for q in one["quantities"]}
            self.assertIn(name, chosen)
            for key, value in chosen.items():
                self.assertEqual(value, values[key], key)
            self.assertLess(one["cell"]["factorisations"], whole["cell"]["factorisations"])

    def test_no_quantities(self):
        """All that its analyses give."""
        asked = self.solved(HEAD + ANALYSES + "quantities:\n  " + QUANTITIES["path"] + "\n")
        nothing = self.solved(HEAD + ANALYSES)
        self.assertGreater(nothing["cell"]["factorisations"], asked["cell"]["factorisations"])
        self.assertGreater(len(nothing["steps"]), len(asked["steps"]))

    def test_what_is_drawn_is_asked_for(self):
        text = HEAD + ANALYSES + "quantities:\n  " + QUANTITIES["path"] + "\n"
        path, out = self.folder / "s.yaml", self.folder / "out.h5"
        path.write_text(text)
        self.answered("solve", "--scene", path, "-f", "collocation", "-n", "4", "--shapes", "-o",
                      out)
        folder = self.folder / "matrices"
        self.answered("solve", "--scene", path, "-f", "collocation", "-n", "4", "--matrices",
                      folder)
        with h5py.File(out) as file:
            kinds = []
            file.visititems(lambda name, node: kinds.append(name))
            self.assertTrue(any("shape" in name for name in kinds), kinds)
        names = {p.name for p in folder.iterdir()}
        self.assertGreater(len(names), 8, names)

    def test_counts_of_the_issue(self):
        column = ("solve", "c_column", "-n", "16")
        self.assertEqual(self.record(*column)["cell"]["factorisations"], 7)
        asked = self.record(*column, "-k", "buckling_load")
        self.assertEqual(asked["cell"]["factorisations"], 3)
        self.assertEqual([q["quantity"] for q in asked["quantities"]], ["buckling_load"])

    def test_the_mesh_is_chosen_by_what_is_asked(self):
        least = self.record("solve", "c_column", "-k", "buckling_load")["elements"]
        self.assertLess(least, self.record("solve", "c_column")["elements"])

    def test_refused(self):
        self.refused(2, "did you mean 'buckling_load'", "solve", "c_column", "-k", "bucling_load")
        self.refused(2, "holds for no quantity", "solve", "c_column", "-f", "beamw", "-k",
                     "elastica or not (c_column or elastica)")
        self.refused(2, "leave -k", "solve", "tip_body", "--follow", "body=0.1..0.2/2", "-k",
                     "frequency")

    def test_verify(self):
        """A selection computes what it names; a whole run computes everything."""
        out = self.folder / "v.h5"
        self.answered("verify", "-k", "c_column/default/ and buckling_load", "-f", "beamw", "-o",
                      out)
        with h5py.File(out) as file:
            group = file["cases/c_column"]
            self.assertEqual({q.decode() for q in group["quantities"]["quantity"][()]},
                             {"buckling_load"})
            cells = group["cells"][()]
            finest = cells[cells["elements"] == 16]
            self.assertEqual(list(finest["factorisations"]), [3])
