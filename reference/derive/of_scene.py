"""Exact values of a scene that is a network of geometrically exact beams, rigid bodies and supports: displacements,
reactions, stiffnesses, resultants at the ends of members, and frequencies about the undeformed state.

usage: of_scene.py [FILE]     FILE or standard input is a scene in the form that 'beamwork scene' writes.

Prints one line for each quantity, in the format of at.py. The exit status is 0, or 3 if the scene or all of its
quantities are not supported by this program; a line for each gives the reason.

Each value is that of the finer of two grids. The uncertainty is twice the difference between both, and at least
round-off. Grids are refined until the difference is below 1e-10 of the value or of its scale.
"""
import os
import pathlib
import subprocess
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
from reference.derive import scene_text, scenes  # noqa: E402
from reference.derive.predicted_beam import Printed  # noqa: E402
from reference.derive.scene_network import SceneNetwork, cut, whole  # noqa: E402
from reference.derive.scene_states import (  # noqa: E402
    Path, compliance, frequencies, linear, reaction, resultants)
from reference.derive.scene_support import WORDS  # noqa: E402
from reference.derive.scene_text import Refused, number, only  # noqa: E402

TABLES = "examples"
SOURCE = "reference/derive/of_scene.py"
GRIDS = ((4, 13), (6, 14), (10, 15), (16, 16))  # (number of intervals, nodes of each interval)
# Relative difference of grids, round-off relative to a value, and round-off relative to the scale of a value.
AGREEMENT, ROUND_OFF, NOTHING = 1e-10, 1e-11, 1e-13
KINDS = ("displacement", "reaction", "stiffness", "compliance", "motion", "internal", "frequency")
RESULTANTS = ("N", "Qy", "Qz", "Mx", "My", "Mz")


class Question:
    def __init__(self, name, entry):
        only(entry, name, (*KINDS, "unit", "tolerance", "order", "near_zero", "factor", "offset",
                           "x", "prediction"))
        self.name, self.entry = name, entry
        self.kind = next(kind for kind in KINDS if kind in entry)
        self.of = entry[self.kind]
        only(self.of, name,
             ("analysis", "at", "take", "node", "component", "row", "column", "motion", "member",
              "end", "where", "resultant", "which", "family", "half_waves"))
        if self.kind == "internal" and (self.of["resultant"] not in RESULTANTS or
                                        self._end() is None):
            raise Refused(
                f"{name}: of internal forces {', '.join(RESULTANTS)} at the ends of members are supported by the deriving program"
            )
        if self.kind == "frequency" and (self.of.get("family", "any") != "any" or
                                         self.of.get("half_waves", "0") != "0"):
            raise Refused(f"{name}: a family of modes is not supported by the deriving program")
        if self.of.get("take") == "curve":
            raise Refused(f"{name}: a curve is not supported by the deriving program")

    def _end(self):
        return {"from": 0, "to": 1, "0": 0, "1": 1}.get(self.of.get("end", self.of.get("where")))

    def of_resultants(self, rows):
        return rows[self._end(), RESULTANTS.index(self.of["resultant"])]

    def told(self, value):
        return value * number(self.entry.get("factor", "1"), self.name) + number(
            self.entry.get("offset", "0"), self.name)

    def reduced(self, stations, values):
        take = self.of.get("take", "last")
        if "at" in self.of:
            at = number(self.of["at"], self.name)
            return next(
                v for s, v in zip(stations, values) if abs(s - at) <= 1e-12 * max(1, abs(at)))
        return {"last": lambda v: v[-1], "max": max, "min": min}[take](values)

    def of_state(self, scene, level):
        i = WORDS.index(self.of["component"]) if "component" in self.of else None
        if self.kind == "displacement":
            return scene.displacement(self.of["node"], i)
        if self.kind == "reaction":
            return reaction(scene, self.of["node"], i, level)
        if self.kind == "internal":
            return self.of_resultants(resultants(scene, self.of["member"]))
        return scene.motion[self.of["motion"]](level, scene.net.numbers)

    def scale(self, scene):
        """Returns the scale of a displacement, a reaction or a resultant in the network, which determines its round-off.
        Returns 0 for other kinds."""
        turns = self.of.get("component", "ux")[0] == "r" or self.of.get("resultant", "N")[0] == "M"
        if self.kind == "displacement":
            return 1.0 if turns else scene.length
        if self.kind in ("reaction", "internal"):
            return max(
                np.max(np.abs(body.load))
                for body in scene.net.bodies) * scene.force * (scene.length if turns else 1.0)
        return 0.0

    def of_matrix(self, C):
        if self.kind == "compliance":
            return C[WORDS.index(self.of["row"]), WORDS.index(self.of["column"])]
        i = WORDS.index(self.of["component"])
        return 1 / C[i, i]


def analyses(scene, questions, grid, scales=None):
    """Returns {quantity: value, or Refused with the reason} on one grid. `scales` is a dictionary that receives
    {quantity: scale}."""
    out, scales = {}, {} if scales is None else scales

    def answer(asked, stations, states):
        for q in asked:
            out[q.name] = q.told(q.reduced(stations, [state[q.name] for state in states]))

    def try_one(name):
        entry = scene["analyses"][name]
        kind = next(iter(entry))
        asked = [q for q in questions if q.of["analysis"] == name]
        if kind == "linear":
            for q in asked:
                if q.kind not in ("displacement", "internal"):
                    out[q.name] = Refused(f"{q.name}: {q.kind} of a linear analysis is not supported by the deriving program")
            asked = [q for q in asked if q.name not in out]
            network = SceneNetwork(scene, *grid)
            moved, inside = linear(network)
            scales.update({
                q.name: np.max(
                    np.abs(moved[q.of["node"]] if q.kind ==
                           "displacement" else [inside[one] for one in whole(q.of["member"], inside)]))
                for q in asked
            })
            answer(asked, [1.0], [{
                q.name: moved[q.of["node"]][WORDS.index(q.of["component"])]
                if q.kind == "displacement" else q.of_resultants(inside[q.of["member"]])
                for q in asked
            }])
        elif kind == "static":
            after = [
                n for n, a in scene["analyses"].items()
                if a.get("compliance", {}).get("about") == name
            ]
            about = {n: [q for q in questions if q.of["analysis"] == n] for n in after}
            if not asked and not any(about.values()):
                return
            path = Path(scene, name, grid)

            def ask(state, level):
                found = {q.name: q.of_state(state, level) for q in asked}
                scales.update({q.name: q.told(q.scale(state)) - q.told(0.0) for q in asked})
                for n, some in about.items():
                    if some:
                        C = compliance(state, level, scene["analyses"][n]["compliance"], n)
                        found.update({q.name: q.of_matrix(C) for q in some})
                return found

            states = path.walk(ask)
            answer(asked + [q for some in about.values() for q in some], path.stations, states)
        elif kind == "compliance" and "about" not in entry[kind] and asked:
            C = compliance(SceneNetwork(scene, *grid), 0.0, entry[kind], name)
            answer(asked, [0.0], [{q.name: q.of_matrix(C) for q in asked}])
        elif kind == "modal" and "about" not in entry[kind] and asked:
            which = [int(number(q.of.get("which", "0"), q.name)) for q in asked]
            found = frequencies(
                SceneNetwork({key: value
                              for key, value in scene.items() if key != "loads"}, *grid),
                max(which) + 1)
            answer(asked, [0.0], [{q.name: found[i] for q, i in zip(asked, which)}])
        elif kind == "modal" and asked:
            raise Refused(
                f"{name}: frequencies about a loaded state are not supported by the deriving program")
        elif kind != "compliance" and asked:
            raise Refused(
                f"{name}: analyses of the kind '{kind}' are not supported by the deriving program")

    for name in scene["analyses"]:
        try:
            try_one(name)
        except Refused as why:
            for q in questions:
                if q.of["analysis"] == name or scene["analyses"][q.of["analysis"]].get(
                        "compliance", {}).get("about") == name:
                    out[q.name] = why
    return out


def solve(scene, form=lambda beam: beam):
    """Yields (quantity, value, unit, uncertainty, convention), or (quantity, Refused) if the program does not support the
    quantity. `form` replaces each beam by another beam."""
    questions, scene = [], cut(scene)
    for name, entry in scene["quantities"].items():
        try:
            questions.append(Question(name, entry))
        except Refused as why:
            yield name, why
    found, scales = [], {}
    for grid in ((*grid, form) for grid in GRIDS):
        found.append(analyses(scene, questions, grid, scales))
        if len(found) > 1 and all(
                near(found[-1][q.name], found[-2][q.name], abs(scales.get(q.name, 0.0)))
                for q in questions):
            break
    for q in questions:
        value = found[-1][q.name]
        if isinstance(value, Refused):
            yield q.name, value
            continue
        uncertainty = max(2 * abs(value - found[-2][q.name]), ROUND_OFF * abs(value),
                          NOTHING * abs(scales.get(q.name, 0.0)))
        yield q.name, value, q.entry.get("unit", "1"), uncertainty, moments_of(scene, q)


def near(a, b, scale):
    return isinstance(a, Refused) or abs(a - b) <= max(AGREEMENT * abs(a), NOTHING * scale)


def moments_of(scene, question):
    if question.kind not in ("stiffness", "compliance"):
        return ""
    return scene["analyses"][question.of["analysis"]]["compliance"].get("moments",
                                                                        "spatial").replace(
                                                                            "spatial", "")


EXAMPLES = ("cross_flexure_hinge", "folded_leaf_stage", "leaf_spring_guide", "channel_portal")
PROGRAM = os.environ.get("BEAMWORK",
                         str(pathlib.Path(__file__).resolve().parents[2] / "build" / "beamwork"))
PREDICTED = EXAMPLES[:3]  # examples for which limits of sheet_third, which is rigid in shear along y, are derived
LIMIT = 1e-9  # relative uncertainty of these limits
KNOWN = {"leaf_spring_guide": ("k_drive", "k_support")}  # quantities with closed forms


def rows():
    if not os.access(PROGRAM, os.X_OK):
        raise SystemExit(f"of_scene.py: {PROGRAM} is not there; run make all first")
    for name in EXAMPLES:
        path = scenes.PATH / f"{name}.yaml"
        text = subprocess.run([PROGRAM, "scene", "--scene", path],
                              check=True,
                              text=True,
                              stdout=subprocess.PIPE).stdout
        parameters = scene_text.read(path.read_text(encoding="utf-8")).get("parameters", {})
        at = ";".join(f"{key}={entry['value']}" for key, entry in parameters.items())
        for row in solve(scene_text.read(text)):
            if not isinstance(row[1], Refused) and row[0] not in KNOWN.get(name, ()):
                quantity, value, unit, uncertainty, _ = row
                yield name, at, quantity, value, unit, uncertainty / abs(value)
        for quantity, value, unit, *_ in solve(
                scene_text.read(text),
                lambda beam: Printed(beam, "sheet_third")) if name in PREDICTED else ():
            if quantity not in KNOWN.get(name, ()):
                yield name, at, quantity, value, unit, LIMIT, "", "", "sheet_third*"


def main(arguments):
    text = pathlib.Path(arguments[0]).read_text(encoding="utf-8") if arguments else sys.stdin.read()
    values = 0
    try:
        for row in solve(scene_text.read(text)):
            if isinstance(row[1], Refused):
                print(row[1], file=sys.stderr)
                continue
            name, value, unit, uncertainty, convention = row
            values += 1
            print(f"{name}\t{value:.17g}\t{unit}\t{uncertainty:.1e}\t{convention}\t{SOURCE}",
                  flush=True)
    except Refused as why:
        print(why, file=sys.stderr)
        return 3
    return 0 if values else 3


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
