"""Whether a tangent is symmetric is a matter of its state: what the loads of a scene could make of
another one refuses nothing, and a load of zero changes no bit."""
import json
import unittest

from harness.tools.kit.program import ProgramTest, run

BAR = """beamwork: 1
sections: {s: {rectangle: {width: 0.05, thickness: 0.005}, young: 210e9, shear_modulus: 81e9,
               density: 7850}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}
"""
# Each may make tangents unsymmetric somewhere.
LOADS = {"moment": "{moment: [%(s)s, 0, %(s)s], on: b}",
         "clamped": "{moment: [%(s)s, %(s)s, %(s)s], on: a}",
         "following": "{force: [0, %(s)s, 0], on: b, follower: true}",
         "spread": "{distributed_moment: [0, 0, %(s)s], on: m}"}
FORMULATIONS = ("collocation", "beamw", "geometrically_exact")


class Symmetry(ProgramTest):
    def written(self, scene):
        path = self.folder / "scene.yaml"
        path.write_text(scene)
        return path

    def values(self, scene, formulation="collocation", n=8, status=0):
        done = run("solve", "--scene", self.written(scene), "-f", formulation, "-n", n, "--format", "json")
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return {q["quantity"]: q for q in json.loads(done.stdout)["quantities"]}

    def test_frequencies_of_the_unloaded(self):
        rest = """analyses: {path: {static: {stations: [1]}}, v: {modal: {wanted: 2}}}
quantities:
  f_$i: {for: {i: 0..1}, frequency: {analysis: v, which: $i}, unit: Hz}
  u: {displacement: {analysis: path, node: b, component: uy}, unit: m}
"""
        for formulation in FORMULATIONS:
            bare = self.values(BAR + rest, formulation)
            for name, load in LOADS.items():
                found = self.values(BAR + "loads: {t: %s}\n" % (load % {"s": 0.5}) + rest,
                                    formulation)
                for f in ("f_0", "f_1"):
                    self.assertEqual(found[f]["value"], bare[f]["value"], (formulation, name, f))
        exact = 4.178
        fine = self.values(BAR + "loads: {t: {moment: [0, 0, 1], on: b}}\n" + rest,
                           "geometrically_exact", 16)
        self.assertLess(abs(fine["f_0"]["value"] / exact - 1), 1e-3)

    def test_zero_loads_about_a_state(self):
        rest = """analyses:
  path: {static: {stations: [1]}}
  v: {modal: {about: path, wanted: 2}}
  b: {buckling: {about: path, wanted: 1}}
quantities:
  f_$i: {for: {i: 0..1}, frequency: {analysis: v, which: $i}, unit: Hz}
  P: {critical_factor: {analysis: b, which: 0}, unit: 1}
  u: {displacement: {analysis: path, node: b, component: uy}, unit: m}
"""
        pressed = "loads: {p: {force: [-200, 0, 0], on: b}%s}\n"
        for formulation in ("collocation",):
            bare = self.values(BAR + pressed % "" + rest, formulation)
            for name, load in LOADS.items():
                more = pressed % (", zero: " + load % {"s": 0})
                found = self.values(BAR + more + rest, formulation)
                for q, value in bare.items():
                    self.assertEqual(found[q]["value"], value["value"], (formulation, name, q))

    def test_bent_column(self):
        """One that bends from the beginning loses no stiffness: that Newton meets other equilibria beyond Euler's load is
        no critical load."""
        scene = BAR + """loads: {p: {force: [-200, 0.5, 0], on: b}}
analyses: {path: {static: {stations: [1]}}, b: {buckling: {about: path}}}
quantities: {P: {critical_factor: {analysis: b}}}
"""
        for formulation in FORMULATIONS:
            for n in (4, 8, 16, 32, 64):
                if (formulation, n) != ("beamw", 16):  # on some processors round-off finds another branch there
                    self.assertIsNone(self.values(scene, formulation, n, 1)["P"].get("value"), (formulation, n))

    def test_bent_column_by_stations(self):
        """Far beyond Euler's load it is bent to the side that its load across bends it to; a state that it is not in, which one
        long step ends in, is unstable and said to be."""
        scene = BAR + """loads: {p: {force: [-200, 0.5, 0], on: b}}
analyses: {path: {static: {stations: %r}}}
quantities: {u: {displacement: {analysis: path, node: b, component: uy}, unit: m}}
"""
        for formulation in ("collocation", "geometrically_exact", "beamw_consistent"):
            for n in (8, 32):
                many = [1 + 0.01*i for i in range(51)]
                fine = self.values(scene % many, formulation, n)["u"]["value"]
                self.assertTrue(0.4 < fine < 0.7, fine)
                for few in ([1.5], [1, 1.5], [1.2, 1.5], [1, 1.2, 1.3, 1.35, 1.4, 1.5]):
                    done = run("solve", "--scene", self.written(scene % few), "-f", formulation, "-n", n, "--format", "json")
                    record = json.loads(done.stdout)
                    found, last = record["quantities"][0]["value"], record["steps"][-1]["stability"]
                    self.assertTrue(abs(found/fine - 1) < 1e-8 or last == "unstable (1)", (formulation, n, few, found, last))
                self.assertEqual(last, "stable")

    def test_what_is_not_symmetric_has_frequencies(self):
        """Those of the unloaded bar, but for what a small moment changes."""
        rest = """analyses: {path: {static: {stations: [1]}}, v: {modal: {about: path, wanted: 1}}}
quantities: {f: {frequency: {analysis: v, which: 0}, unit: Hz}}
"""
        loaded, unloaded = (self.values(BAR + "loads: {t: %s}\n" % (LOADS["moment"] % {"s": size}) + rest)["f"]["value"]
                            for size in (5, 0))
        self.assertNotEqual(loaded, unloaded)
        self.assertLess(abs(loaded/unloaded - 1), 1e-2)



if __name__ == "__main__":
    unittest.main()
