"""Reduced models of structures with multiple frequencies, or with transfer functions that are zero."""
import csv
import shutil
import unittest

import numpy
import scipy.io

from harness.tools.kit.program import ProgramTest

CANTILEVER = """beamwork: 1
sections: {s: {%(section)s, young: 70e9, shear_modulus: 26e9, density: 2700}}
nodes:
  root: {at: [0, 0, 0], hold: all}
  mid: {at: [%(mid)s]}
  tip: {at: [%(tip)s], mass: 0.1}
members: {a: {from: root, to: mid, section: s, y: [%(y)s]}, b: {from: mid, to: tip, section: s, y: [%(y)s]}}
"""
STRAIGHT = {"mid": "0.5, 0, 0", "tip": "0.9, 0, 0", "y": "0, 1, 0"}
INCLINED = {"mid": "0.3, 0, 0.4", "tip": "0.54, 0, 0.72", "y": "0, 1, 0"}
SKEW = {"mid": "0.3, 0.4, 0", "tip": "0.54, 0.72, 0", "y": "-0.48, 0.36, 0.8"}
RECTANGLE, TUBE = "rectangle: {width: 20e-3, thickness: 8e-3}", "tube: {diameter: 30e-3, thickness: 2e-3}"
SPRINGS = """beamwork: 1
sections: {s: {rectangle: {width: 20e-3, thickness: 8e-3}, young: 70e9, shear_modulus: 26e9, density: 2700}}
nodes:
  root: {at: [0, 0, 0], hold: all}
  mid: {at: [0.1, 0, 0]}
  tip: {at: [1, 0, 0], mass: 2, hold: [rx, ry, rz]}
members: {a: {from: root, to: mid, section: s, y: [0, 1, 0]}}
springs: {k: {to: tip, stiffness: [3e4, 3e4, 3e4, 0, 0, 0]}}
"""
HARMONIC = """analyses: {h: {harmonic: {frequencies: [3, 11, 60], damping: {stiffness: 1e-5}}}}
quantities:
  same: {response: {analysis: h, node: tip, component: uy, force: tip, along: uy}}
  across: {response: {analysis: h, node: tip, component: uz, force: tip, along: uy, of: velocity}}
  other: {response: {analysis: h, node: tip, component: %s, force: tip, along: uz, of: acceleration}}
"""
# scene, reduction, and number of modes that the reduced model uses
TABLE = [(CANTILEVER % dict(place, section=section), reduction, taken)
         for section, places, rows in ((RECTANGLE, (STRAIGHT, INCLINED), (("1", 1), ("3:mid", 3))),
                                       (TUBE, (STRAIGHT, INCLINED, SKEW), (("1", 2), ("2", 2), ("3", 4), ("1:mid", 2), ("4:mid", 4))))
         for place in places for reduction, taken in rows]
TABLE += [(SPRINGS, "1", 3), (SPRINGS, "2", 3), (SPRINGS, "3", 3), (SPRINGS, "1:mid", 3)]


class Reduced(ProgramTest):

    def rows(self, name):
        with open(self.folder/"out"/name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def read(self, name):
        file = self.folder/"out"/f"{name}.mtx"
        return scipy.io.mmread(file).toarray() if file.exists() else 0

    def transfer(self, state, hertz):
        K, C, M, B, D = (self.read(f"{state}/{letter}") for letter in ("K", "C", "M", "B", "D"))
        s, L = 2j*numpy.pi*hertz, [self.read(f"{state}/{letter}") for letter in ("L", "L_rate", "L_acceleration")]
        return (L[0] + s*L[1] + s*s*L[2]) @ numpy.linalg.solve(K + s*C + s*s*M, B) + D

    def test_table(self):
        for scene, reduction, taken in TABLE:
            with self.subTest(scene=scene, reduction=reduction):
                (self.folder/"scene.yaml").write_text(scene + HARMONIC % ("ux" if "springs" in scene else "rz"), encoding="utf-8")
                shutil.rmtree(self.folder/"out", ignore_errors=True)
                said = self.answered("solve", "--scene", self.folder/"scene.yaml", "-f", "collocation", "-n", 3, "--matrices",
                                     self.folder/"out", "--state-space", "--reduce", reduction).stderr
                line = next(l for l in said.splitlines() if l.startswith("beamwork: reduced model of h"))
                asked = int(reduction.split(":")[0])
                self.assertEqual(f"{taken} modes instead of {asked}, so that modes with the same frequency" in line, taken > asked, line)
                errors = self.rows("h/reduced/errors.csv")
                modes, functions = errors[:taken], errors[taken:]
                self.assertEqual([e["kind"] for e in errors], ["natural frequency"]*taken + ["transfer function"]*len(functions))
                for e in modes:
                    off = float(e["reduced"]) - float(e["whole"])
                    self.assertLess(abs(float(e["difference"]) - off), 0.01*abs(off) + 1e-12)
                self.check(functions, line)

    def check(self, functions, line):
        inputs, outputs = self.rows("inputs.csv"), self.rows("outputs.csv")
        H, h = (numpy.array([self.transfer(f"h/{state}", hertz) for hertz in (3, 11, 60)]) for state in ("second_order", "reduced"))
        largest, zeros = 0, 0
        for e in functions:
            y, u = int(e["output"]) - 1, int(e["input"]) - 1
            off, size = (abs(A[:, y, u]).max() for A in (H - h, H))
            plane = {"uy": "xy", "rz": "xy", "uz": "xz", "ux": "x"}
            self.assertEqual(e["difference_unit"],
                             {"m": "m/N", "m/s": "(m/s)/N", "m/s^2": "(m/s^2)/N", "rad/s^2": "(rad/s^2)/N"}[outputs[y]["unit"]])
            if plane[outputs[y]["component"]] == plane[inputs[u]["component"]]:
                self.assertLess(abs(float(e["error"]) - off/size), 0.01*off/size + 1e-9)
                self.assertLess(abs(float(e["difference"]) - off), 0.01*off + 1e-9*size)
                if off/size > largest:
                    largest, where = off/size, f"(output {y + 1}, input {u + 1})"
            else:
                zeros += 1
                self.assertEqual(e["error"], "nan")
                self.assertLess(float(e["difference"]), 1e-9*abs(H[:, y]).max() + 1e-15)
        self.assertIn(f"; {zeros} of {len(functions)} transfer functions are zero and not counted", line)
        if largest > 1e-12:
            self.assertIn(f"transfer functions differ by at most {largest:.1e} of the largest {where}", line)
        else:
            self.assertRegex(line, r"transfer functions differ by at most \d\.\de-1[3-9] of the largest")


if __name__ == "__main__":
    unittest.main()
