"""Stops with gaps: one load step and many load steps must lead to the same state. Each stop must be open, or its
force must be proportional to its compression."""
import random
import re

from cases.format.test.scene_case import SceneCase

LENGTH, NODES = 1.0, 5
STIFFNESS = 3*200e9*0.02*0.01**3/12/LENGTH**3


def scene(seed, stations):
    draw = random.Random(seed)
    stiffness, force = STIFFNESS*10**draw.uniform(0, 6), 10**draw.uniform(0, 2.5)
    nodes, members, springs, gaps = "", "", "", []
    for i in range(1, NODES + 1):
        gap, side = 10**draw.uniform(-5, -2), draw.choice([1, -1])
        points = [[-1, gap, 1], [0, 0, stiffness*(1 - gap)]] if side > 0 else [[-1, -gap, 1], [-stiffness*(1 - gap), 0, 0]]
        nodes += f"  n{i}: {{at: [{i*LENGTH/NODES}, 0, 0]}}\n"
        members += f"  m{i}: {{from: n{i - 1}, to: n{i}, section: bar, y: [0, 1, 0], warping: free}}\n"
        springs += f"  s{i}: {{to: n{i}, tables: {{uy: {{at: {points[0]}, value: {points[1]}}}}}}}\n"
        gaps.append((gap, side, stiffness))
    return gaps, force, f"""beamwork: 1
sections:
  bar: {{rectangle: {{width: 0.02, thickness: 0.01}}, young: 200e9, shear_modulus: 80e9}}
nodes:
  n0: {{at: [0, 0, 0], hold: all}}
{nodes}members:
{members}springs:
{springs}loads:
  p: {{force: [0, {force}, 0], on: n5}}
  q: {{force: [0, {-1.5*force}, 0], on: n3}}
analyses:
  a: {{static: {{stations: {stations}}}}}
quantities:
  R: {{reaction: {{analysis: a, node: n0, component: uy}}, unit: N}}
""" + "".join(f"  u{i}: {{displacement: {{analysis: a, node: n{i}, component: uy}}, unit: m}}\n" for i in range(1, NODES + 1))


class GapsTest(SceneCase):

    def found(self, text, *more):
        done = self.answered("solve", "--scene", self.scene(text), "-f", "collocation", "-n", 1, *more)
        return {name: float(value) for name, value in re.findall(r"^(R|u\d)\s+(\S+) ", done.stdout, flags=re.M)}

    def test_stops(self):
        for seed in range(8):
            gaps, force, one = scene(seed, "[1]")
            found, steps = self.found(one), self.found(scene(seed, "0..1/40")[2])
            pushed = 0
            for i, (gap, side, stiffness) in enumerate(gaps, 1):
                self.assertAlmostEqual(found[f"u{i}"], steps[f"u{i}"], delta=1e-9)
                pushed -= side*stiffness*max(0, side*found[f"u{i}"] - gap)
            self.assertAlmostEqual(found["R"] + pushed, 0.5*force, delta=1e-6*force)

    def test_refused(self):
        text = scene(0, "[1]")[2]
        for points, words in (("at: [0, 0], value: [0, 1]", "does not ascend"), ("at: [0, 1], value: [0, -1]", "decrease,"),
                              ("at: [0, 1], value: [1, 2]", "is not 0"), ("at: [0], value: [0]", "two or more points"),
                              ("at: [0, 1], value: [0]", "two or more points")):
            bad = re.sub(r"s1: .*", f"s1: {{to: n1, tables: {{uy: {{{points}}}}}}}", text)
            self.refused(2, words, "solve", "--scene", self.scene(bad), "-f", "collocation", "-n", 1)
