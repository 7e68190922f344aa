"""What each kind of load can say, and what is refused of it: every key with every kind."""
import itertools
import unittest

from cases.format.test.scene_case import SceneCase
from harness.tools.kit.program import run

SCENE = """beamwork: 1
UNITS
sections:
  s: {rectangle: {width: WIDTH, thickness: THICK}, young: YOUNG, shear_modulus: SHEAR, density: RHO}
nodes:
  root: {at: [0, 0, 0], hold: all}
  tip: {at: [LENGTH, 0, 0], mass: MASS}
members:
  bar: {from: root, to: tip, section: s, y: [0, 1, 0]}
loads:
LOADS
analyses:
  run: ANALYSIS
"""
SI = {"UNITS": "", "WIDTH": "0.05", "THICK": "0.02", "YOUNG": "2e11", "SHEAR": "8e10", "RHO": "7800", "LENGTH": "2", "MASS": "3"}
MM = {"UNITS": "units: mm, N, MPa", "WIDTH": "50", "THICK": "20", "YOUNG": "2e5", "SHEAR": "8e4", "RHO": "7.8e-9", "LENGTH": "2000",
      "MASS": "3e-3"}

KINDS = {
    "force": "force: [1, 2, 3], on: tip",
    "moment": "moment: [1, 2, 3], on: tip",
    "force within": "force: [1, 2, 3], on: bar, where: 0.25",
    "moment within": "moment: [1, 2, 3], on: bar, where: 0.25",
    "distributed": "distributed: [1, 2, 3], on: bar",
    "distributed moment": "distributed_moment: [1, 2, 3], on: bar",
    "gravity": "gravity: [1, 2, 3], on: bar",
    "weight": "gravity: [1, 2, 3], on: tip",
    "all": "gravity: [1, 2, 3], on: all"
}
FORCES, MOMENTS = ("force", "force within", "distributed"), ("moment", "moment within", "distributed moment")
ON_MEMBERS = ("force within", "moment within", "distributed", "distributed moment")
SPREAD = ("distributed", "distributed moment")
# key: which kinds can have it; a force or a moment within a member has `where` already
KEYS = {
    "where: 0.75": (),
    "from: 0.25": SPREAD,
    "to: 0.75": SPREAD,
    "to_value: [3, 2, 1]": SPREAD,
    "lumped: yes": (*SPREAD, "gravity", "all"),
    "at: [0, 0, 0.125]": FORCES,
    "axes: member": ON_MEMBERS,
    "follower: true": FORCES + MOMENTS,
    "path: [0, 1], factor: [0, 2]": tuple(KINDS)
}
# what they are without it
NOTHING = ("from: 0, to: 1", "lumped: no", "at: [0, 0, 0]", "axes: fixed", "follower: no")
ANALYSES = {
    "linear": "{linear: {}}",
    "static": "{static: {stations: [1]}}",
    "continuation": "{continuation: {control: {node: tip, component: uy}, to: [0.1], step: 0.1}}",
    "buckling": "{buckling: {}}",
    "modal": "{modal: {}}",
    "compliance": "{compliance: {node: tip}}",
    "rotation": "{rotation: {omega: [0, 0, 1], stations: [1]}}"
}


def text_of(loads, analysis="{linear: {}}", words=SI):
    text = SCENE.replace("LOADS", "\n".join(f"  l{i}: {{{said}}}" for i, said in enumerate(loads)))
    text = text.replace("ANALYSIS", analysis)
    for key, word in words.items():
        text = text.replace(key, word)
    return text


class LoadsTest(SceneCase):

    def written(self, text):
        return self.answered("scene", "--scene", self.scene(text)).stdout

    def loads_of(self, text):
        return [line for line in self.written(text).partition("\nloads:\n")[2].splitlines() if line.startswith("  l")]

    def test_every_key(self):
        """What a kind can have is read, written and read again; else one line says which key, and a remedy."""
        taken, refused = [], 0
        for (kind, said), (key, kinds) in itertools.product(KINDS.items(), KEYS.items()):
            where = key.startswith("where") and "within" in kind
            entry = said.replace("where: 0.25", key) if where else f"{said}, {key}"
            if where or kind in kinds:
                taken.append(entry)
                continue
            path = self.scene(text_of([entry]))
            done = run("scene", "--scene", path)
            self.assertEqual((done.returncode, done.stdout), (2, ""), entry)
            lines = [line for line in done.stderr.splitlines() if "earlier versions" not in line]
            self.assertEqual(len(lines), 1, (entry, lines))
            self.assertTrue(lines[0].startswith(f"{path}:11:"), lines)
            self.assertRegex(lines[0], rf"\b{key.partition(':')[0]}\b", entry)
            self.assertIn("; ", lines[0])
            refused += 1
        self.assertGreater(len(taken), 30)
        self.assertGreater(refused, 30)
        once = self.written(text_of([entry for entry in taken if "on: all" not in entry]))
        self.assertEqual(self.written(once), once)
        for key in KEYS:
            self.assertIn(key, once)

    def test_analyses(self):
        """Every kind with every analysis: the file is the same again. What has no potential is refused where that matters, by name."""
        several = [said for kind, said in KINDS.items() if kind != "all"]
        several += [f"{KINDS[kind]}, from: 0.25, to: 0.5, to_value: [4, 5, 6], follower: true" for kind in SPREAD]
        for analysis, said in ANALYSES.items():
            once = self.written(text_of(several, said))
            self.assertEqual(self.written(once), once, analysis)
        about = "{static: {stations: [1]}}\n  fall: {modal: {about: run}}"
        self.assertEqual(len(self.loads_of(text_of(several, about))), len(several))
        for kind in ("distributed moment", "moment within"):
            path = self.scene(text_of([KINDS[kind]], ANALYSES["buckling"]))
            done = run("solve", "--scene", path, "-f", "beamw", "-n", 2)
            self.assertEqual((done.returncode, done.stdout), (2, ""), kind)
            self.assertRegex(done.stderr, r"\bl0 \(moments? .*\): it has no potential")

    def test_nothing(self):
        """Said or not, it is the same."""
        for kind, said in KINDS.items():
            for key in NOTHING:
                if kind not in SPREAD and key.startswith("from"):
                    continue
                if kind in ("gravity", "weight", "all") and key.startswith("at"):
                    continue
                self.assertEqual(self.loads_of(text_of([f"{said}, {key}"])), self.loads_of(text_of([said])), (kind, key))

    def test_plane(self):
        """What leaves it where it begins or where it ends is refused."""
        inside = ["force: [1, 2, 0], on: bar, where: 0.25", "moment: [0, 0, 3], on: bar, where: 0.25",
                  "distributed: [1, 2, 0], on: bar, to_value: [2, 1, 0]", "distributed_moment: [0, 0, 0], on: bar, to_value: [0, 0, 1]"]
        outside = ["force: [1, 2, 3], on: bar, where: 0.25", "moment: [1, 0, 3], on: bar, where: 0.25, axes: member",
                   "distributed: [1, 2, 0], on: bar, to_value: [2, 1, 1]", "distributed: [0, 0, 1], on: bar, to_value: [2, 1, 0]",
                   "distributed_moment: [0, 0, 0], on: bar, to_value: [0, 1, 1]"]
        self.assertEqual(len(self.loads_of(text_of(inside) + "plane: xy\n")), len(inside))
        for said in outside:
            path = self.scene(text_of([said]) + "plane: xy\n")
            done = run("scene", "--scene", path)
            self.assertEqual((done.returncode, done.stdout), (2, ""), said)
            self.assertRegex(done.stderr, r":11:3: l0: it (acts|turns) out of the plane, .*: take that or plane: xy away\n$")

    def test_units(self):
        """In mm and N: parts of a length have no unit, vectors that of their kind, at both ends."""
        def loads(millimetre):
            force, moment, line, moments, arm = (f"[{x}, {2*x}, {3*x}]" for x in (1, 0.5*millimetre, 2/millimetre, 0.25, 0.125*millimetre))
            more = [f"distributed: {line}, on: bar, from: 0.25, to: 0.5, at: {arm}, to_value: [0, {8/millimetre}, 0]",
                    f"distributed_moment: {moments}, on: bar, to: 0.5, to_value: [0, 4, 0], lumped: yes"]
            return [f"force: {force}, on: bar, where: 0.25, at: {arm}", f"moment: {moment}, on: bar, where: 0.25"] + more
        self.assertEqual(self.loads_of(text_of(loads(1000), words=MM)), self.loads_of(text_of(loads(1))))
        self.assertNotEqual(self.loads_of(text_of(loads(1000))), self.loads_of(text_of(loads(1))))


if __name__ == "__main__":
    unittest.main()
