"""Scenes to be exported to CalculiX, and a base class that reads the deck of a scene and the results of CalculiX."""
import os
import re
import shutil
import subprocess
import unittest

import numpy as np

from harness.import_export import read_back
from cases.format.test.scene_case import EXAMPLES, SceneCase

CCX = shutil.which("ccx")
needs_ccx = unittest.skipUnless(CCX, "ccx (Debian: calculix-ccx) is not installed")

LENGTH, WIDTH, HEIGHT, YOUNG = 0.1, 10e-3, 2e-3, 200e9
INERTIA = WIDTH * HEIGHT**3 / 12
CANTILEVER = """\
beamwork: 1
sections:
  bar: {rectangle: {width: 10e-3, thickness: 2e-3}, young: 200e9, shear_modulus: 100e9}
nodes:
  base: {at: [0.02, 0, 0], hold: all}
  tip:  {at: [0.02, 0.1, 0]}
members:
  bar: {from: base, to: tip, section: bar, y: [1, 0, 0], warping: fixed}
loads:
  push: {force: [{force}, 0, 0], on: tip}
analyses:
  run: {kind}
quantities:
  deflection: {displacement: {analysis: run, node: tip, component: ux}, unit: m}
  shortening: {displacement: {analysis: run, node: tip, component: uy}, unit: m}
  turn:       {displacement: {analysis: run, node: tip, component: rz}, unit: rad}
"""
RECTANGLE = "rectangle: {width: 10e-3, thickness: 2e-3}"
# Sections of walls, with the sum of lengths times thicknesses of the walls, and the area that this sum counts twice
# where a wall ends inside another wall.
WALLS = {
    "channel: {depth: 0.02, flange: 0.01, flange_thickness: 1e-3, web_thickness: 0.6e-3}":
        (2 * 10e-6 + 12e-6, 0),
    "zed: {depth: 0.02, flange: 0.01, flange_thickness: 1e-3, web_thickness: 0.6e-3}":
        (2 * 10e-6 + 12e-6, 0),
    "angle: {along_y: 0.01, along_z: 0.02, thickness: 1e-3}": (30e-6, 0),
    "box: {depth: 0.02, flange: 0.01, flange_thickness: 1e-3, web_thickness: 0.6e-3}":
        (2 * 10e-6 + 2 * 12e-6, 0),
    "i: {depth: 0.02, flange: 0.01, flange_thickness: 1e-3, web_thickness: 0.6e-3}":
        (2 * 10e-6 + 12e-6, 2 * 0.5e-3 * 0.6e-3),
    "points: {a: [0, -0.01], b: [0, 0], c: [0, 0.01], d: [0.02, 0]}, walls: [{from: a, to: b, "
    "thickness: 1e-3}, {from: b, to: c, thickness: 1e-3}, {from: b, to: d, thickness: 2e-3}]":
        (20e-6 + 40e-6, 0.5e-3 * 2e-3),
}
CHANNEL = "channel: {depth: 0.2, flange: 0.1, flange_thickness: 10e-3, web_thickness: 6e-3}"
TIP = "at: [0.02, 2, 0]"
PERCENT = {"ux": -0.29, "uy": 0, "uz": 0.04, "rx": -0.19, "ry": 1.32, "rz": -0.26, "twist": 0.89}
HELD = "  held:       {reaction: {analysis: run, node: base, component: ux}, unit: N}\n"
PATH = "{static: {stations: [0.5, 1]}}"


def cantilever(force, kind="{linear: {}}"):
    text = CANTILEVER.replace("{force}", f"{force!r}")
    return text.replace("{kind}", kind) + (HELD if kind == PATH else "")


def hinge():
    text = (EXAMPLES / "cross_flexure_hinge.yaml").read_text(encoding="utf-8")
    return re.sub(r"^  (k_y: |- {quantity: k_y,).*\n", "", text, flags=re.M)


def numbers(line):
    return [int(n) for n in line.strip().strip(",").split(",")]


def mesh_of(deck):
    nodes, elements, card, pending = {}, [], "", []
    for line in deck.read_text(encoding="utf-8").splitlines():
        if line.startswith("*"):
            card = line
        elif card.startswith("*NODE,"):
            words = line.split(",")
            assert int(words[0]) not in nodes, line
            nodes[int(words[0])] = np.array([float(w) for w in words[1:]])
        elif card.startswith("*ELEMENT"):
            pending += numbers(line)
            if not line.endswith(","):
                elements.append(pending[1:])
                pending = []
    return nodes, np.array(elements)


class ExportTest(SceneCase):

    def deck(self, scene, *options):
        path = self.folder / "deck.inp"
        self.answered("export", "--scene", scene, "--to", "calculix", "-o", path, *options)
        return path

    def solved(self, scene, *options):
        deck = self.deck(scene, *options)
        done = subprocess.run([CCX, "deck"], cwd=self.folder, capture_output=True, text=True,
                              check=False, env={**os.environ, "OMP_NUM_THREADS": "1"})
        self.assertIn("Job finished", done.stdout)
        self.assertNotIn("*ERROR", done.stdout)
        return {row[0]: float(row[6]) for row in read_back.rows(deck)[1]}
