"""Scenes that several tests write."""

# Ten lines are enough: a leaf spring clamped at one end, loaded at the other.
LEAF = """\
beamwork: 1
sections:
  leaf: {rectangle: {width: 50e-3, thickness: 0.5e-3}, young: 210e9, shear_modulus: 81e9}
nodes:
  base: {at: [0, 0, 0], hold: all}
  tip:  {at: [0.1, 0, 0]}
members:
  leaf: {from: base, to: tip, section: leaf, y: [0, 1, 0]}
loads:
  push: {force: [0, 1, 0], on: tip}
"""
