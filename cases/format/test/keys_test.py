"""What keys of a scene file come to where they are left out."""
import json
import re
import unittest

import yaml

from cases.format.test.scene_case import EXAMPLES, SceneCase
from harness.tools.kit.program import ROOT, run

GOOD = ROOT / "cases/format/test/good"

# What no other scene has: entries of every kind with as little as they need.
BARE = [
    """sections:
  b: {rectangle: {width: 0.02, thickness: 0.01}, young: 7e10, shear_modulus: 2.6e10, density: 2700}
  w: {points: {a: [0, 0], b: [0.1, 0], c: [0.1, 0.1]}, walls: [{from: a, to: b, thickness: 2e-3}, {from: b, to: c, thickness: 2e-3}], young: 7e10, shear_modulus: 2.6e10}
  c: {constants: {A: 1e-4, Iy: 1e-8, Iz: 2e-8, It: 1e-8}, young: 7e10, shear_modulus: 2.6e10}
  m: {stiffness: [1e6, 1e6, 1e6, 1e3, 1e3, 1e3]}
nodes:
  a: {at: [0, 0, 0], hold: all}
  b: {at: [1, 0, 0], hold: [uz, rx, ry]}
  c: {at: [2, 0, 0]}
  d: {at: [3, 0, 0]}
  e: {at: [4, 0, 0]}
members:
  ab: {from: a, to: b, section: b, y: [0, 1, 0]}
  bc: {from: b, to: c, section: w, y: [0, 1, 0], release: {from: [rz]}}
  cd: {from: c, to: d, section: c, y: [0, 1, 0], release: {to: [rz]}}
  de: {from: d, to: e, section: m, y: [0, 1, 0]}
springs:
  s: {to: c, stiffness: [1e3, 1e3, 1e3, 1, 1, 1]}
  t: {to: d, stiffness: [1e3, 1e3, 1e3, 1, 1, 1]}
  u: {to: e, stiffness: [1e3, 1e3, 1e3, 1, 1, 1]}
loads:
  push: {force: [0, 1, 0], on: b}
  line: {distributed: [0, 1, 0], on: ab}
""", """analyses:
  path: {static: {stations: [1]}}
  still: {compliance: {node: b}}
  free: {modal: {}}
  critical: {buckling: {}}
  curve: {continuation: {control: {node: b, component: uy}, to: [0.1], step: 0.1}}
quantities:
  uy: {displacement: {analysis: path, node: b, component: uy}}
  over: {displacement: {analysis: path, node: b, component: uy, take: curve}, x: {}}
  first: {frequency: {analysis: free}}
  load: {critical_factor: {analysis: critical}}
  point: {critical_point: {analysis: curve, kind: limit}}
  most: {stress: {analysis: path, member: ab}}
  there: {stress: {analysis: path, member: ab, where: 0.5}}
  force: {reaction: {analysis: path, node: a, component: ux}}
  within: {internal: {analysis: path, member: ab, end: from, resultant: N}}
  k: {stiffness: {analysis: still, component: ux}}
  c: {compliance: {analysis: still, row: ux, column: ux}}
  at: {factor_at: {analysis: curve}}
truths:
  - {quantity: uy, value: 1, kind: exact, source: here}
""", """analyses:
  swing: {motion: {stations: [1], step: 0.01, start: {}}}
quantities:
  uy: {displacement: {analysis: swing, node: b, component: uy, take: crossing}, when: {}}
  over: {displacement: {analysis: swing, node: b, component: uy, take: curve}, x: {}}
  vx: {rate: {analysis: swing, node: b, component: ux}}
  R: {orientation: {analysis: swing, node: b, row: x, column: y}}
  E: {energy: {analysis: swing, of: energy}}
  p: {momentum: {analysis: swing, component: px}}
  r: {relative: {analysis: swing, node: b, from: a, component: ux}}
""", """analyses:
  turn: {rotation: {omega: [0, 0, 1], stations: [1]}}
  spun: {static: {stations: [1], spin: {omega: [0, 0, 1]}}}
quantities:
  grows: {growth: {analysis: turn}}
"""]


def tables(schema):
    """Every map of the schema with its keys: name -> (place, properties)."""

    def below(node, place):
        if "properties" in node:
            yield place, node["properties"], node.get("required", [])
            for key, value in node["properties"].items():
                yield from below(value, (*place, key))
        for word in ("additionalProperties", "items"):
            if isinstance(node.get(word), dict):
                yield from below(node[word], (*place, "*"))

    yield from below(schema, ())


def maps(scene, schema, place=()):
    """Of a scene: every map that a table of keys describes."""
    if isinstance(scene, dict) and "properties" in schema:
        yield place, scene, schema["properties"]
        for key, value in scene.items():
            if key in schema["properties"]:
                yield from maps(value, schema["properties"][key], (*place, key))
    elif isinstance(scene, dict) and isinstance(schema.get("additionalProperties"), dict):
        for value in scene.values():
            yield from maps(value, schema["additionalProperties"], (*place, "*"))
    elif isinstance(scene, list) and isinstance(schema.get("items"), dict):
        for value in scene:
            yield from maps(value, schema["items"], (*place, "*"))


class KeysTest(SceneCase):

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.schema = json.loads(run("scene", "--schema").stdout)

    def test_words_of_keys(self):
        """What an editor offers is what the list says, word by word."""
        said = "".join(self.answered("scene", "--keys").stdout.split())
        offered = []

        def gather(node):
            for value in node.values() if isinstance(node, dict) else node:
                if isinstance(value, (dict, list)):
                    gather(value)
            if isinstance(node, dict) and isinstance(node.get("examples"), list):
                offered.append(node["examples"])

        gather(self.schema)
        self.assertGreater(len(offered), 10)
        for words in offered:
            self.assertTrue(f"({','.join(words)})" in said, words)

    def test_every_key(self):
        """It must be there, or the list and the schema say what it comes to."""
        lines = []
        for line in self.answered("scene", "--keys").stdout.partition("is replaced:\n")[2].splitlines():
            if re.match(r" {0,11}\S", line):
                lines.append(line)
            else:
                lines[-1] += " " + line.strip()
        self.assertGreater(len(lines), 200)
        for line in lines:
            self.assertRegex(line, r"(\*|; default: .+)$")
            self.assertNotRegex(line, r"; default: .*\*$", line)
        said = 0
        for place, properties, required in tables(self.schema):
            for key, value in properties.items():
                words = value["description"]
                if "; default: " not in words:
                    continue
                said += 1
                self.assertNotIn(key, required, place)
                if "default" in value:
                    told = words.partition("; default: ")[2]
                    self.assertEqual(yaml.load(told, yaml.BaseLoader),
                                     yaml.load(json.dumps(value["default"]), yaml.BaseLoader)
                                     if not re.fullmatch(r"[\d.e-]+", told) else told, (place, key))
        self.assertGreater(said, 150)

    def test_written(self):
        """Every default that is a value means the same when it is written."""
        wanted = {(place, key)
                  for place, properties, _ in tables(self.schema)
                  for key, value in properties.items() if "default" in value}
        self.assertGreater(len(wanted), 60)
        scenes = [yaml.load("beamwork: 1\n" + BARE[0] + more, yaml.BaseLoader) for more in BARE[1:]]
        scenes += [yaml.load(path.read_text(encoding="utf-8"), yaml.BaseLoader)
                   for path in sorted((*EXAMPLES.glob("*.yaml"), *GOOD.glob("*.yaml")))]
        tried = set()
        for number, scene in enumerate(scenes):
            path = self.folder / f"s{number}.yaml"
            path.write_text(yaml.safe_dump(scene, sort_keys=False), encoding="utf-8")
            written = self.answered("scene", "--scene", path).stdout
            for place, entry, properties in list(maps(scene, self.schema)):
                for key, value in properties.items():
                    is_known = (place, key) in tried and number >= len(BARE) - 1
                    if "default" not in value or key in entry or is_known:
                        continue
                    entry[key] = value["default"]
                    path.write_text(yaml.safe_dump(scene, sort_keys=False), encoding="utf-8")
                    done = run("scene", "--scene", path)
                    del entry[key]
                    if done.returncode == 0:
                        self.assertEqual(done.stdout, written, (place, key, entry))
                        tried.add((place, key))
        # of parts, which are as the scene itself
        self.assertEqual({one for one in wanted - tried if one[0][:1] != ("parts",)}, set())


if __name__ == "__main__":
    unittest.main()
