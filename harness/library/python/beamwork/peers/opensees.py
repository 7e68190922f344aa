"""OpenSees: frames with corotational transformation; statics by load control, modes."""
from __future__ import annotations

import importlib.metadata
import math
import sys
from collections.abc import Mapping
from typing import Any

from . import _opensees_motion
from ._loads import KEYS, THERMAL, acts, nodal
from ._modes import diagonal_inertia, families, require_plain_mass, rigid_motions, spectrum
from ._opensees_buckling import buckling
from ._opensees_path import PathOfModel
from ._opensees_springs import add_hinges, add_springs, reactions
from ._path import follow
from .data import (COMPONENTS, Analysis, Answer, Element, Failed, LoadSteps, Mesh, Model, Refused, Scene, Section, State, Vector,
                   cross, times, transposed)

NAME, PROGRAM, LICENCE = "opensees", "OpenSees", "free for research and internal use; no commercial redistribution"
HOMEPAGE = "https://openseespydoc.readthedocs.io"
REQUIRES = ('openseespy==3.8.0.0; python_version >= "3.12"', 'openseespy==3.7.1.2; python_version < "3.12"')
_STATICS = frozenset({"linear", "static", "compliance", "continuation"})
_MASS = frozenset({"mass", "rotary inertia"})
_ANALYSES = _STATICS | {"modal", "buckling", "motion"}
_LARGE, _KEYS = _MASS | {"large rotations", "geometric"}, KEYS | THERMAL | {"springs", "springs.from", "members.release", "modal.about", "plane", "nodes.mass", "nodes.inertia"}
_SHEAR = _LARGE | {"shear"}
ELEMENTS = {
    "dispBeamColumn": Element("displacement-based, 2 Gauss points, corotational", _LARGE, _ANALYSES, keys=_KEYS),
    "elasticBeamColumn": Element("Euler-Bernoulli, corotational", _LARGE, _ANALYSES, keys=_KEYS),
    "forceBeamColumn": Element("force-based with shear, 3 Lobatto points, corotational; lumped mass", _SHEAR, _ANALYSES,
                               keys=_KEYS),
    "forceBeamColumnCBDI": Element("force-based with second-order moments inside the element (CBDI), 5 Lobatto points, corotational;"
                                   " linear analyses by forceBeamColumn", _LARGE, _STATICS - {"continuation"}, keys=_KEYS),
    "forceBeamColumnCSBDI": Element("forceBeamColumnCBDI with shear (CSBDI)", _SHEAR, _STATICS - {"continuation"}, keys=_KEYS),
    "ElasticTimoshenkoBeam": Element("Timoshenko, linear", _MASS | {"shear"}, frozenset({"linear", "modal"}),
                                     keys=KEYS | THERMAL | {"springs", "springs.from", "members.release", "plane", "nodes.mass", "nodes.inertia"}),
}
_RULES = {"forceBeamColumn": ("Lobatto", 3), "forceBeamColumnCBDI": ("Lobatto", 5), "forceBeamColumnCSBDI": ("Lobatto", 5)}
_TURNS = 1e-5  # [rad] larger rotations in space differ from sums of increments by more than 1e-5 of their value


def version() -> str:
    """Returns the version of the package with the program, which may be newer than that of the package of its interface."""
    program = {"win32": "openseespywin", "darwin": "openseespymac"}.get(sys.platform, "openseespylinux")
    importlib.metadata.version("openseespy")
    return importlib.metadata.version(program)


def _shear_modulus(section: Section) -> float:
    """Returns G for which G J is the torsional stiffness and J/A times the mass the inertia in torsion, as elements
    with consistent mass assume."""
    if section.rho_I[0] == 0 or section.rho_A == 0:
        return float(section.raw["G"])
    return section.GIt * section.rho_A / (section.rho_I[0] * section.EA / float(section.raw["E"]))


class Corotational(Model):
    """A model of OpenSees, initially at path parameter 0. Loads and motions are series over the path."""

    most_iterations = 30

    def __init__(self, scene: Scene, name: str, mesh: Mesh) -> None:
        import openseespy.opensees as ops  # pylint: disable=import-error,import-outside-toplevel
        self.ops, self.scene, self.name, self.mesh = ops, scene, name, mesh
        self.settings = (f"Newton, NormDispIncr {1e-9 * (1 + scene.length()):.1e}, adaptive load steps; modes: LAPACK, with the "
                         "matrices of GimmeMCK")
        self.moves = any(a.kind == "motion" for a in scene.analyses.values())
        if self.moves:
            self.settings = _opensees_motion.settings(scene.length())
        self.build({a.kind for a in scene.analyses.values()} == {"linear"})

    def build(self, linear: bool = False, moved: Mapping[int, Vector] | None = None) -> None:
        """Builds the model without loads. linear: with the linear transformation, and with elements without
        second-order moments. moved: displacements and rotations of the nodes of a model without stresses."""
        ops, scene, mesh, self.linear = self.ops, self.scene, self.mesh, linear
        name = "forceBeamColumn" if linear and self.name.startswith("forceBeamColumn") else self.name
        ops.wipe()
        ops.model("basic", "-ndm", 3, "-ndf", 6)
        for node in mesh.nodes:
            ops.node(node.number, *(a + b for a, b in zip(node.at, moved[node.number] if moved else (0, 0, 0))))
        for i, section in enumerate(scene.sections.values(), 1):
            self._add_section(i, section, name, 1.0)
        self.base = ""  # the analysis in whose last state the model is
        tags = {section: i for i, section in enumerate(scene.sections, 1)}
        ends = add_hinges(ops, scene, mesh, moved)
        for i, element in enumerate(mesh.elements, 1):
            s, tag, z, scale = element.member.section, 0, transposed(element.R)[2], 1.0
            if moved is not None:
                u, v = (moved[k] for k in ends[i - 1])
                z = [a + (b + c) / 2 for a, b, c in zip(z, cross(u[3:], z), cross(v[3:], z))]
                scale = 1 + sum((b - a) * row[0] for a, b, row in zip(u, v, element.R)) / element.length
                tag = len(tags) + i
                self._add_section(tag, s, name, scale)
            ops.geomTransf("Linear" if linear else "Corotational", i, *z)
            E, G = scale * s.raw["E"], scale * _shear_modulus(s)
            constants: tuple[Any, ...] = (i, tag or tags[s.name])
            if name == "elasticBeamColumn":
                constants = (scale * s.EA / E, E, G, scale * s.GIt / G, scale * s.EIy / E, scale * s.EIz / E, i)
            elif name == "ElasticTimoshenkoBeam":
                constants = (E, G, s.EA / E, s.GIt / G, s.EIy / E, s.EIz / E, *(min(k / G, 1e4 * s.EA / E) for k in s.GA), i)
            ops.element(name, i, *ends[i - 1], *constants, "-mass", s.rho_A, *(["-cMass"] if name not in _RULES and not self.moves else []))
        add_springs(ops, scene, mesh, moved)
        self._add_supports()
        length = scene.length()
        self.unknowns = 6 * len(mesh.nodes) - self.held
        ops.numberer("RCM")
        ops.constraints("Transformation")
        ops.system("BandGeneral")
        ops.test("NormDispIncr", 1e-9 * (1 + length), self.most_iterations)
        ops.algorithm("Newton")

    def _add_section(self, tag: int, section: Section, name: str, scale: float) -> None:
        """Adds a section whose stiffnesses are multiplied by `scale`, with its integration rule. name: of the element."""
        E, G = scale * section.raw["E"], scale * section.raw["G"]
        A, Iz, Iy, J = (scale * x for x in (section.EA / E, section.EIz / E, section.EIy / E, section.GIt / G))
        shear = [min(scale * GA / (G * A), 1e4) for GA in section.GA] if "shear" in ELEMENTS[self.name].offers else []
        self.ops.section("Elastic", tag, E, A, Iz, Iy, G, J, *shear)
        rule, points = _RULES.get(name, ("Legendre", 2))
        self.ops.beamIntegration(rule, tag, tag, points)

    def _series(self, tag: int, raw: Any, key: str) -> None:
        if key in raw:
            self.ops.timeSeries("Path", tag, "-time", *raw["path"], "-values", *raw[key], "-useLast")
        elif key == "value":  # a function of time, which is 0 before the motion
            self.ops.timeSeries("Constant", tag, "-factor", 0.0)
        else:
            self.ops.timeSeries("Linear", tag)
        self.ops.pattern("Plain", tag, tag)

    def _add_supports(self) -> None:
        ops, self.held, tag = self.ops, 0, 1
        for one in self.mesh.nodes:
            held = self.scene.held_at(one)
            ops.fix(one.number, *(int(c in held) for c in COMPONENTS))
            self.held += len(held)
        self.held += sum(len(node.drive) for node in self.scene.nodes.values())
        for name, motion in self.scene.motions.items():
            self._series(tag, motion, "value")
            for node in self.scene.nodes.values():
                for component, by in node.drive.items():
                    if by == name:
                        ops.sp(self.mesh.node_of[node.name], COMPONENTS.index(component) + 1, 1.0)
            tag += 1
        for load in self.scene.loads:
            self._series(tag, load.raw, "factor")
            if load.kind == "distributed" and self.linear and not {"to_value", "lumped"} & set(load.raw):
                for i, element in enumerate(self.mesh.elements, 1):
                    if acts(load, element):
                        x, y, z = times(transposed(element.R), load.vector)
                        ops.eleLoad("-ele", i, "-type", "-beamUniform", y, z, x)
            else:
                for number, vector in nodal(load, self.mesh, self.scene).items():
                    ops.load(number, *vector)
            tag += 1
        self.next_tag = tag

    def solve(self, analysis: Analysis) -> Answer:
        if analysis.kind == "modal":
            return self._modal(analysis)
        if analysis.kind == "buckling":
            return buckling(self)
        if analysis.kind == "motion":
            return _opensees_motion.motion(self, analysis)
        if analysis.kind == "compliance":
            return Answer([State(compliance=self._compliance(analysis))], iterations=1)
        if analysis.kind == "continuation":
            answer = follow(PathOfModel(self, analysis), analysis, self.scene, (self.name, len(self.mesh.elements)))
            self.base = analysis.name
            return answer
        linear = analysis.kind == "linear"
        if self.base or self.linear != linear:
            self.build(linear)
        # elements with "force" in their name need an iteration before element loads act fully
        if linear and not self.name.startswith("force"):
            self.ops.algorithm("Linear")
        stations = analysis.stations or (1.0, )
        states, iterations, path = [], 0, 0.0
        steps = LoadSteps((self.scene.of, self.name, len(self.mesh.elements), analysis.name), stations[-1])
        before = self._turns()
        self.ops.integrator("LoadControl", 1.0)
        self.ops.analysis("Static", "-noWarnings")
        for station in stations:
            while path < station * (1 - 1e-12):
                step = station - path if linear else steps.next(station - path)
                self.ops.integrator("LoadControl", step)
                if self.ops.analyze(1) != 0:
                    iterations += self.most_iterations
                    steps.failed(step)
                    self.ops.setTime(path)
                    continue
                path += step
                iterations += max(self.ops.testIter(), 1)
                if not linear:  # large rotations of a linear analysis are no jump
                    after = self._turns()
                    steps.done(step, max(math.dist(a, b) for a, b in zip(before, after)))
                    before = after
            states.append(self.state(linear))
        self.base = analysis.name
        return Answer(states, iterations=iterations)

    def _turns(self) -> list[list[float]]:
        return [self.ops.nodeDisp(node.number)[3:] for node in self.mesh.nodes]

    def state(self, linear: bool) -> State:
        self.ops.reactions()
        u: dict[str, list[float | None]] = {}
        for name, number in self.mesh.node_of.items():
            moved = [float(x) for x in self.ops.nodeDisp(number)]
            turns = sorted(abs(x) for x in moved[3:])
            known = linear or turns[2] < _TURNS or turns[1] < 1e-9 * turns[2]
            u[name] = [x if known or i < 3 else None for i, x in enumerate(moved)]
        return State(u, reactions(self.ops, self.scene, self.mesh))

    def _compliance(self, analysis: Analysis) -> list[list[float]]:
        """Returns the compliance from the tangent of the last state. Released components get their reactions as loads."""
        import numpy  # pylint: disable=import-outside-toplevel
        ops, node = self.ops, self.mesh.node_of[analysis.raw["node"]]
        released = analysis.raw.get("released", [])
        ops.reactions()
        forces = reactions(ops, self.scene, self.mesh)[analysis.raw["node"]]
        ops.loadConst("-time", 0.0)
        ops.timeSeries("Constant", self.next_tag)
        ops.pattern("Plain", self.next_tag, self.next_tag)
        ops.load(node, *(f if COMPONENTS[i] in released else 0.0 for i, f in enumerate(forces)))
        for tag in range(1, len(self.scene.motions) + 1):
            ops.remove("loadPattern", tag)
        for one in self.scene.nodes.values():
            number = self.mesh.node_of[one.name]
            for c in one.drive:
                i = COMPONENTS.index(c) + 1
                if c not in released or number != node:
                    ops.sp(number, i, float(ops.nodeDisp(number, i)))
        for c in self.scene.nodes[analysis.raw["node"]].hold.intersection(released):
            ops.remove("sp", node, COMPONENTS.index(c) + 1)
        ops.wipeAnalysis()
        ops.numberer("Plain")
        ops.constraints("Transformation")
        ops.system("FullGeneral")
        ops.test("NormDispIncr", 1e-9 * (1 + self.scene.length()), self.most_iterations)
        ops.algorithm("Newton")
        ops.integrator("LoadControl", 0.0)
        ops.analysis("Static", "-noWarnings")
        if ops.analyze(1) != 0:
            raise Failed("Newton's method does not converge with the reactions as loads")
        size = ops.systemSize()
        K = numpy.array(ops.printA("-ret")).reshape(size, size).T  # stored by columns
        degrees = ops.nodeDOFs(node)
        out = numpy.zeros((6, 6))
        for k, column in enumerate(degrees):
            if column >= 0:
                unit = numpy.zeros(size)
                unit[column] = 1
                x = numpy.linalg.solve(K, unit)
                for i, row in enumerate(degrees):
                    out[i, k] = x[row] if row >= 0 else 0
        return [[float(x) for x in row] for row in out]


    def _modal(self, analysis: Analysis) -> Answer:
        """Computes frequencies from the mass and stiffness matrices of the program, which its integrator GimmeMCK gives."""
        import numpy  # pylint: disable=import-outside-toplevel
        require_plain_mass(self.scene)
        if analysis.about is not None and analysis.about != self.base:
            raise Refused(f"about: {analysis.about} is not the last static analysis before {analysis.name}")
        if analysis.about is None and self.base:
            self.build()
        rigid = rigid_motions(self.scene, self.mesh)
        if rigid and analysis.about is not None:
            raise Refused("about: the driver does not support modes of a loaded structure if its supports leave it free to move")
        self._add_inertia()
        M, K = self.matrices()
        found, vectors = spectrum(K, M, rigid)
        shapes = numpy.zeros((len(found), len(self.mesh.nodes), 6))
        for node in self.mesh.nodes:
            for c, row in enumerate(self.ops.nodeDOFs(node.number)):
                if row >= 0:
                    shapes[:, node.number, c] = vectors[row, :len(found)]
        return Answer(frequencies=found, families=families(self.mesh, found, list(shapes)), iterations=1)

    def _add_inertia(self) -> None:
        """Adds bodies to the nodes, and the rotary inertia that the elements omit."""
        added = {number: [0.0] * 3 for number in range(len(self.mesh.nodes))}
        if self.name == "ElasticTimoshenkoBeam":
            for s in self.scene.sections.values():
                own = [s.rho_A * EI / s.EA for EI in (s.EIy, s.EIz)]
                if any(abs(a - b) > 1e-6 * (a + b) for a, b in zip(own, s.rho_I[1:])):
                    raise Refused("rotary inertia: ElasticTimoshenkoBeam has that of a homogeneous section, and always")
        else:
            twists = self.name == "elasticBeamColumn"
            added |= diagonal_inertia(self.mesh, lambda s: (0.0 if twists else s.rho_I[0], *s.rho_I[1:]), PROGRAM)
        bodies = {self.mesh.node_of[node.name]: node.raw for node in self.scene.nodes.values()}
        for number, rotary in added.items():
            mass, inertia = bodies.get(number, {}).get("mass", 0.0), bodies.get(number, {}).get("inertia", [0.0] * 6)
            if any(inertia[3:]):
                raise Refused("inertia: bodies of OpenSees have no products of inertia")
            self.ops.mass(number, *[float(mass)] * 3, *(a + float(b) for a, b in zip(rotary, inertia)))

    def matrices(self) -> tuple[Any, Any]:
        """Returns the mass and the tangent stiffness matrix of the current state, of all equations."""
        import numpy  # pylint: disable=import-outside-toplevel
        ops = self.ops
        for one in self.scene.nodes.values():
            for c in one.drive if self.base else ():
                i = COMPONENTS.index(c) + 1
                ops.sp(self.mesh.node_of[one.name], i, float(ops.nodeDisp(self.mesh.node_of[one.name], i)))
        ops.wipeAnalysis()
        ops.numberer("Plain")
        ops.constraints("Transformation")
        ops.system("FullGeneral")
        ops.algorithm("Linear")
        out = []
        for factors in ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)):
            ops.integrator("GimmeMCK", *factors)
            ops.analysis("Transient", "-noWarnings")
            ops.analyze(1, 0.0)  # fails if the matrix is singular, but the printed matrix is then still complete
            size = ops.systemSize()
            out.append(numpy.array(ops.printA("-ret")).reshape(size, size).T)
        return out[0], out[1]


def build(scene: Scene, element: str, mesh: Mesh) -> Model:
    return Corotational(scene, element, mesh)
