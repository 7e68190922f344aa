"""Scenes for tests, as text."""
import pathlib
import re

# A minimal scene: a leaf spring clamped at one end and loaded at the other end.
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


def bad_scenes():
    """Returns [(name, text)] of scenes that contain one error each."""
    folder = pathlib.Path(__file__).parents[3] / "cases/format/test/bad"
    files = (path.read_bytes().decode() for path in sorted(folder.glob("*.txt")))
    return [tuple(piece.split("\n", 1)) for text in files
            for piece in re.split(r"^=== ", text, flags=re.M)[1:]]
