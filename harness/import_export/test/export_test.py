"""Decks for CalculiX: their meshes, loads and quantities, rejected scenes, the conversion of results to a file for
import, and results of ccx compared with closed forms and beams."""
import collections
import csv
import re
import sys
import unittest

import numpy as np

from cases.format.test.scene_case import EXAMPLES
from harness.import_export import read_back
from harness.import_export.test.export_case import (CHANNEL, ExportTest, HEIGHT, INERTIA, LENGTH, PATH,
                                               PERCENT, RECTANGLE, TIP, WALLS, WIDTH, YOUNG,
                                               cantilever, hinge, mesh_of, needs_ccx)
from harness.tools.kit.program import ROOT, run


class Decks(ExportTest):

    def test_bricks_fill_the_member(self):
        nodes, elements = mesh_of(self.deck(self.scene(cantilever(1.0)), "-n", "6"))
        self.assertEqual(elements.shape, (6 * 8 * 1, 20))
        corners = np.array([[nodes[n] for n in e[:8]] for e in elements])
        x, y, z = (corners[:, k] - corners[:, 0] for k in (1, 3, 4))
        volume = np.einsum("ij,ij->i", np.cross(x, y), z)
        self.assertGreater(volume.min(), 0)
        self.assertAlmostEqual(volume.sum() / (LENGTH * WIDTH * HEIGHT), 1, places=9)
        used = {n for e in elements for n in e}
        self.assertEqual(len(set(nodes) - used), 2 * 2)
        low, high = (f(np.array([nodes[n] for n in used]), axis=0) for f in (np.min, np.max))
        np.testing.assert_allclose(low, [0.02 - HEIGHT / 2, 0, -WIDTH / 2], atol=1e-12)
        np.testing.assert_allclose(high, [0.02 + HEIGHT / 2, LENGTH, WIDTH / 2], atol=1e-12)

    def test_middles_of_edges(self):
        nodes, elements = mesh_of(self.deck(self.scene(cantilever(1.0)), "-n", "3"))
        edges = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5),
                 (2, 6), (3, 7)]
        for e in elements:
            for middle, (a, b) in zip(e[8:], edges):
                np.testing.assert_allclose(nodes[middle], (nodes[e[a]] + nodes[e[b]]) / 2,
                                           atol=1e-12)

    def test_walls(self):
        faces = [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
        for section, (area, twice) in WALLS.items():
            deck = self.deck(self.scene(cantilever(1.0).replace(RECTANGLE, section)), "-n", "3")
            nodes, elements = mesh_of(deck)
            corners = np.array([[nodes[n] for n in e[:8]] for e in elements])
            x, y, z = (corners[:, k] - corners[:, 0] for k in (1, 3, 4))
            volume = np.einsum("ij,ij->i", np.cross(x, y), z)
            self.assertGreater(volume.min(), 0, section)
            filled = volume.sum() / LENGTH
            self.assertAlmostEqual(filled / (area - twice), 1, places=9, msg=section)
            used = {n for e in elements for n in e}
            self.assertEqual(len(set(nodes) - used), 2 * 2, section)
            places = np.array([nodes[n] for n in sorted(used)])
            self.assertEqual(len(np.unique(places.round(9), axis=0)), len(used), section)
            shared = collections.Counter(frozenset(e[list(f)]) for e in elements for f in faces)
            self.assertEqual(set(shared.values()), {1, 2}, section)
            off, = re.findall(r"^\*\*AREA member \w+: (\S+) % of",
                              deck.read_text(encoding="utf-8"), re.M)
            self.assertAlmostEqual(float(off), -100 * twice / area, delta=1e-2, msg=section)

    def test_walls_are_where_the_section_says(self):
        """For a channel with its y axis along x and its z axis along z, the distance of the web from the centroid
        must be b^2 tf/A, where b and tf are the width and thickness of a flange."""
        section = next(iter(WALLS))
        scene = self.scene(cantilever(1.0).replace(RECTANGLE, section))
        nodes, elements = mesh_of(self.deck(scene, "-n", "1"))
        places = np.array([nodes[n] for n in {n for e in elements for n in e}])
        web = 0.01**2 * 1e-3 / 32e-6
        for place, sides in ((places.max(axis=0), [0.02 + web + 0.3e-3, LENGTH, 0.0105]),
                             (places.min(axis=0), [0.02 + web - 0.01, 0, -0.0105])):
            np.testing.assert_allclose(place, sides, atol=1e-9)

    def test_each_quantity_has_its_answer(self):
        deck = self.deck(EXAMPLES / "leaf_spring_guide.yaml", "-n", "2").read_text(encoding="utf-8")
        answers = [line.split("|")[0][4:] for line in deck.splitlines() if line.startswith("**Q ")]
        self.assertEqual(sorted(answers),
                         ["force", "k_drive", "k_pushed", "k_support", "shortening"])

    def test_parameters_are_said(self):
        deck = self.deck(EXAMPLES / "leaf_spring_guide.yaml", "-n", "2", "--set",
                         "thickness=0.4e-3").read_text(encoding="utf-8")
        self.assertIn("leaf_spring_guide.yaml; thickness=0.0004\n", deck)

    def test_one_turn(self):
        deck = self.deck(self.scene(hinge()), "-n", "2").read_text(encoding="utf-8")
        moment = re.search(r"^\*\*Q moment\|N m\|forces\|4\|(\d+)\|3\|", deck, re.M)
        states = [step for step in deck.split("*STEP") if step.startswith(",NLGEOM")]
        self.assertEqual(len(states), 4)
        for state, angle in zip(states, (0.25, 0.5, 0.75, 1)):
            cards = dict(re.findall(rf"^{moment[1]},(\d),\d,(\S+)$", state, re.M))
            self.assertEqual((float(cards["1"]), float(cards["2"])), (0, 0))
            self.assertAlmostEqual(float(cards["3"]) / np.deg2rad(20), angle, places=9)

    def test_what_is_not_carried(self):
        plain = cantilever(1.0)
        wrong = {
            "warp": plain.replace(", warping: fixed", ""),
            "member bar: wall number 1 of the section is oblique": plain.replace(
                RECTANGLE, "points: {a: [0, 0], b: [0.1, 0.1], c: [0.1, 0.2]}, walls: [{from: a, "
                "to: b, thickness: 1e-3}, {from: b, to: c, thickness: 1e-3}]"),
            "remove 'given'": plain.replace(RECTANGLE, CHANNEL + ", given: {Iw: 1e-8}"),
            "rectangles and straight walls": plain.replace(
                RECTANGLE, "tube: {diameter: 10e-3, thickness: 1e-3}"),
            "Poisson": plain.replace("shear_modulus: 100e9", "shear_modulus: 1e9"),
            "along members": plain.replace("force: [1.0, 0, 0], on: tip",
                                        "distributed: [1, 0, 0], on: bar"),
            "push: weight and loads along members": plain.replace("force: [1.0, 0, 0], on: tip",
                                              "force: [1.0, 0, 0], on: bar, where: 0.5"),
            "one stiffness of a loaded": cantilever(1.0, PATH).replace(
                "quantities:", "  stiff: {compliance: {node: tip, about: run}}\nquantities:\n"
                "  k_x: {stiffness: {analysis: stiff, component: ux}, unit: N/m}\n"
                "  k_y: {stiffness: {analysis: stiff, component: uy}, unit: N/m}"),
            "last station": cantilever(1.0, PATH).replace(
                "quantities:", "  stiff: {compliance: {node: tip, about: run}}\nquantities:\n"
                "  k_x: {stiffness: {analysis: stiff, component: ux, at: 0.5}, unit: N/m}"),
            "dead loads": plain.replace("on: tip", "on: tip, follower: true"),
            "none, two or all": cantilever(1.0, PATH).replace(
                "at: [0.02, 0.1, 0]", "at: [0.02, 0.1, 0], hold: [rx]"),
            "at which several members end": plain.replace("members:", "  far: {at: [0.1, 0.1, 0]}\nmembers:").replace(
                "loads:", "  more: {from: tip, to: far, section: bar, y: [0, 1, 0], "
                "warping: fixed}\nloads:"),
        }
        for word, text in wrong.items():
            out = self.folder / "none.inp"
            self.refused(2, word, "export", "--scene", self.scene(text), "--to", "calculix", "-o",
                         out)
            self.assertFalse(out.exists())

    def test_words(self):
        scene = self.scene(cantilever(1.0))
        self.refused(2, "--to calculix", "export", "--scene", scene)
        self.refused(2, "--to calculix", "export", "--scene", scene, "--to", "abaqus")
        self.refused(2, "a single number", "export", "--scene", scene, "--to", "calculix", "-n", "2,4")
        self.refused(2, "give -n a number from 1 to", "export", "--scene", scene, "--to", "calculix", "-n", "401")
        self.refused(2, "initial curvature", "export", "bend_45", "--to", "calculix")
        self.refused(2, "springs", "export", "sprung_beam", "--to", "calculix")


class Answers(ExportTest):
    def printed(self, *vectors):
        deck = self.deck(self.scene(cantilever(1.0, PATH)), "-n", "1")
        answers = [line[4:].split("|") for line in deck.read_text(encoding="utf-8").splitlines()
                   if line.startswith("**Q ")]
        text = ""
        for u, f in vectors:
            for name, vector in (("displacements (vx,vy,vz)", u), ("forces (fx,fy,fz)", f)):
                text += f"\n {name} for set BODIES and time  0.1E+01\n\n"
                for node in sorted({a[4] for a in answers}, key=int):
                    text += f"{node:>10} " + " ".join(f"{v:.6E}" for v in vector) + "\n"
        deck.with_suffix(".dat").write_text(text, encoding="utf-8")
        return deck

    def test_read(self):
        deck = self.printed(*2 * [([0.25, 0.5, 0.125], [4, 5, 6])])
        rows = {row[0]: row for row in read_back.rows(deck)[1]}
        self.assertEqual({name: float(row[6]) for name, row in rows.items()},
                         {"deflection": 0.25, "shortening": 0.5, "turn": 0.125, "held": 4})
        self.assertEqual(float(rows["deflection"][7]), 0.25 * read_back.DIGITS)

    def test_convention(self):
        text = cantilever(1.0).replace("run: {linear: {}}", "run: {compliance: {node: tip}}")
        text = text[:text.index("  deflection:")] + (
            "  turn: {compliance: {analysis: run, row: rz, column: rz}, unit: rad/(N m)}\n")
        deck, out = self.deck(self.scene(text), "-n", "1"), self.folder / "values.csv"
        node = re.search(r"^\*\*Q turn\|[^|]*\|displacements\|1\|(\d+)\|3\|",
                         deck.read_text(encoding="utf-8"), re.M)[1]
        deck.with_suffix(".dat").write_text(f" displacements (vx,vy,vz) for set\n{node} 0 0 0.25\n",
                                            encoding="utf-8")
        run(ROOT / "harness/import_export/read_back.py", deck, "-o", out, program=sys.executable)
        self.assertIn("# convention: spatial\n", out.read_text(encoding="utf-8"))
        self.answered("import", out, "-o", self.folder / "values.h5")

    def test_meshes_of_one_scene(self):
        scene, decks = self.scene(cantilever(1.0)), []
        for n in ("1", "2"):
            decks.append(self.deck(scene, "-n", n).rename(self.folder / f"deck{n}.inp"))
        for deck in decks:
            bodies = re.findall(r"REF NODE=(\d+),ROT NODE=(\d+)", deck.read_text(encoding="utf-8"))
            rows = "".join(f"{n} 0.25 0.5 0.125\n" for pair in bodies for n in pair)
            deck.with_suffix(".dat").write_text(f" displacements (vx,vy,vz) for set\n{rows}",
                                                encoding="utf-8")
        found = read_back.series(decks)[1]
        self.assertEqual([row[2] for row in found if row[0] == "turn"], ["8", "16"])
        with self.assertRaisesRegex(read_back.Incomplete, "same number of elements"):
            read_back.series([decks[0], decks[0]])
        text = decks[1].read_text(encoding="utf-8")
        decks[1].write_text(text.replace("**CASE ", "**CASE other"), encoding="utf-8")
        with self.assertRaisesRegex(read_back.Incomplete, "several scenes"):
            read_back.series(decks)

    def test_stopped(self):
        deck = self.printed()
        with self.assertRaisesRegex(read_back.Incomplete, "step 2 was not solved"):
            read_back.rows(deck)

    def test_imported(self):
        deck, out = self.printed(*2 * [([0.25, 0.5, 0.125], [4, 5, 6])]), self.folder / "values.csv"
        done = run(ROOT / "harness/import_export/read_back.py", deck, "-o", out, program=sys.executable)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with open(out, encoding="utf-8") as file:
            self.assertEqual(len(list(csv.reader(file))), 4 + 1 + 4)
        told = self.answered("import", out, "-o", self.folder / "values.h5").stdout
        self.assertIn("4 values, 1 mesh; another model: solid", told)


@needs_ccx
class Solved(ExportTest):

    def test_cantilever(self):
        """The tip deflection of a cantilever must be F L^3/(3 E I) + 6 F L/(5 G A), and the tip rotation F L^2/(2 E
        I), within 1e-3."""
        found = self.solved(self.scene(cantilever(2.0)), "-n", "10")
        bent = 2 * LENGTH**3 / (3 * YOUNG * INERTIA)
        sheared = 1.2 * 2 * LENGTH / (YOUNG / 2 * WIDTH * HEIGHT)
        self.assertAlmostEqual(found["deflection"] / (bent + sheared), 1, delta=1e-3)
        self.assertAlmostEqual(found["turn"] / (-2 * LENGTH**2 / (2 * YOUNG * INERTIA)), 1,
                               delta=1e-3)

    def test_elastica(self):
        """For F L^2/(E I) = 2, the deflection of the elastica must be 0.49346 L, and the shortening 0.16064 L
        (Mattiasson 1981), within 2e-3."""
        force = 2 * YOUNG * INERTIA / LENGTH**2
        found = self.solved(self.scene(cantilever(force, PATH)), "-n", "16")
        self.assertAlmostEqual(found["deflection"] / (0.49346 * LENGTH), 1, delta=2e-3)
        self.assertAlmostEqual(found["shortening"] / (-0.16064 * LENGTH), 1, delta=2e-3)
        self.assertAlmostEqual(found["held"] / -force, 1, delta=1e-5)

    def test_arc(self):
        """For a bar bent by an end rotation a, the deflection must be (1 - cos a) L/a, and the shortening (1 - sin
        a/a) L, within 2e-3."""
        angle, c, s = 1.2, 0.8, 0.6
        text = cantilever(0.0, PATH).replace(
            "tip:  {at: [0.02, 0.1, 0]", "tip:  {at: [0.02, 0.08, 0.06], rotation: {vector: [none, "
            "about_y, about_z]}").replace(
            "loads:\n  push: {force: [0.0, 0, 0], on: tip}", "motions:\n"
            "  none:    {unit: rad, path: [0, 1], value: [0, 0]}\n"
            f"  about_y: {{unit: rad, path: [0, 1], value: [0, {s * angle!r}]}}\n"
            f"  about_z: {{unit: rad, path: [0, 1], value: [0, {-c * angle!r}]}}")
        found = self.solved(self.scene(text), "-n", "16")
        self.assertAlmostEqual(found["deflection"] / ((1 - np.cos(angle)) / angle * LENGTH), 1,
                               delta=2e-3)
        self.assertAlmostEqual(found["shortening"] / (-c * (1 - np.sin(angle) / angle) * LENGTH), 1,
                               delta=2e-3)
        self.assertAlmostEqual(found["turn"], -c * angle, delta=1e-6)

    def test_compliance(self):
        """The compliances of the end of a cantilever must be L/(E I), L^2/(2 E I) and L/(E A), within 2e-3."""
        text = cantilever(1.0).replace("run: {linear: {}}", "run: {compliance: {node: tip}}")
        entries = {"turn_turn": ("rz", "rz", "rad/(N m)", LENGTH / (YOUNG * INERTIA)),
                   "turn_move": ("rz", "ux", "rad/N", -LENGTH**2 / (2 * YOUNG * INERTIA)),
                   "move_turn": ("ux", "rz", "1/N", -LENGTH**2 / (2 * YOUNG * INERTIA)),
                   "along": ("uy", "uy", "m/N", LENGTH / (YOUNG * WIDTH * HEIGHT))}
        text = text[:text.index("  deflection:")] + "".join(
            f"  {name}: {{compliance: {{analysis: run, row: {row}, column: {column}}}, "
            f"unit: {unit}}}\n" for name, (row, column, unit, _) in entries.items())
        found = self.solved(self.scene(text), "-n", "10")
        for name, (*_, value) in entries.items():
            self.assertAlmostEqual(found[name] / value, 1, delta=2e-3, msg=name)

    def test_channel(self):
        head = cantilever(1.0).replace(RECTANGLE, CHANNEL).replace("at: [0.02, 0.1, 0]", TIP)
        text = head[:head.index("loads:")] + (
            "analyses:\n  run: {compliance: {node: tip}}\nquantities:\n" + "".join(
                f"  {c}: {{compliance: {{analysis: run, row: {c}, column: {c}}}}}\n"
                for c in PERCENT if c != "twist") +
            "  twist: {compliance: {analysis: run, row: ry, column: uz}}\n")
        scene = self.scene(text)
        solid = self.solved(scene, "-n", "8")
        told = self.record("solve", "--scene", scene, "-f", "collocation", "-n", "4")
        more = {q["quantity"]: 100 * (solid[q["quantity"]] / q["value"] - 1)
                for q in told["quantities"]}
        for name, percent in PERCENT.items():
            self.assertAlmostEqual(more[name], percent, delta=0.1, msg=name)

    def test_wagner_moments(self):
        text = cantilever(0.0, "{static: {stations: [1]}}").replace(RECTANGLE, CHANNEL).replace(
            "force: [0.0, 0, 0]", "force: [0, 0, -3e3]").replace("[0.02, 0.1, 0]", "[0.02, 4, 0]")
        text = text.replace("shear_modulus: 100e9", "shear_modulus: 80e9")
        scene = self.scene(text + "omit: [wagner_torque, rotary_inertia]\n")
        solid = self.solved(scene, "-n", "6")["deflection"]
        plain = self.scene(text + "omit: [trapeze, wagner_moments, wagner_torque, rotary_inertia]\n",
                           "plain.yaml")
        for beams, least, most in ((scene, 0.985, 1.005), (plain, 1.1, 1.14)):
            told = self.record("solve", "--scene", beams, "-f", "collocation", "-n", "8")
            beam, = [q["value"] for q in told["quantities"] if q["quantity"] == "deflection"]
            self.assertGreater(solid / beam, least)
            self.assertLess(solid / beam, most)

    def test_leaf_spring_guide(self):
        scene = EXAMPLES / "leaf_spring_guide.yaml"
        solid = self.solved(scene, "-n", "20")
        told = self.record("solve", "--scene", scene, "-f", "collocation", "-n", "4")
        more = {q["quantity"]: 100 * (solid[q["quantity"]] / q["value"] - 1)
                for q in told["quantities"]}
        for name, percent in (("k_drive", 6.9), ("force", 8.0), ("k_pushed", 6.3),
                              ("k_support", 1.3), ("shortening", 0.2)):
            self.assertAlmostEqual(more[name], percent, delta=0.2, msg=name)


if __name__ == "__main__":
    unittest.main()
