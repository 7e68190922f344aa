"""Measures which features peers support, with a small scene for each feature that has a closed-form solution."""
from __future__ import annotations

import datetime
import json
import math
import pathlib
import re
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from .. import Scene, version
from ..errors import Refused
from ..program import run as program
from ._rounds import Series

L, E, G, A, I, IT, RHO = 1.0, 2e11, 8e10, 1e-2, 2e-6, 3e-6, 8000.0
EA, EI, GIT, GA = E * A, E * I, G * IT, 1e7
F = 1e3  # load of the scenes with small displacements
FINE, WORKS = (16, 32), 0.01  # meshes; largest error with which a feature works
# words that are repeated in every cell of the table and are therefore omitted
_SHORT = re.compile(r": the (?:element|driver) of .* does not (?:model it|read this key).*")
_HALVED = 0.7  # largest ratio of the error on the finer mesh to that on the coarser mesh for which values count as convergent

Case = tuple[str, str, Callable[[], Scene], float]


def _cantilever(loads: Mapping[str, Any], analysis: Mapping[str, Any], quantity: Mapping[str, Any], omit: Sequence[str] = ("trapeze", "wagner_torque"),
                section: Mapping[str, Any] | None = None, **tip: Any) -> Scene:
    """Returns a cantilever along x. Without `section`, it is rigid in shear and does not warp."""
    made = Scene("feature")
    constants = {"A": A, "Iy": I, "Iz": I, "It": IT, "Ip": 2 * I}
    made.sections["bar"] = dict(section or {"constants": constants, "young": E, "shear_modulus": G, "density": RHO})
    made.nodes["root"], made.nodes["tip"] = {"at": [0, 0, 0], "hold": "all"}, {"at": [L, 0, 0], **tip}
    made.members["bar"] = {"from_": "root", "to": "tip", "section": "bar", "y": [0, 1, 0]}
    for name, load in loads.items():
        made.loads[name] = load
    made.analyses["a"] = dict(analysis)
    made.quantities["q"] = {next(iter(quantity)): {"analysis": "a", **next(iter(quantity.values()))}, "unit": "1", "factor": 1}
    made.omit = list(omit)
    return made


def _tip(component: str) -> dict[str, Any]:
    return {"displacement": {"node": "tip", "component": component}}


def _linear(load: Mapping[str, Any], component: str, **section: Any) -> Scene:
    return _cantilever({"load": {"on": "tip", **load}}, {"linear": {}}, _tip(component), **section)


def _shear() -> Scene:
    D = [GA / G, 0, 0, 0, GA / G, 0, 0, 0, 1]
    constants = {"A": A, "Iy": I, "Iz": I, "It": IT, "Ip": 2 * I, "D": D}
    section = {"constants": constants, "young": E, "shear_modulus": G}
    return _linear({"force": [0, F, 0]}, "uy", section=section)


def _coupled() -> Scene:
    K = [0.0] * 36
    for i, value in enumerate((EA, GA, GA, GIT, EI, EI)):
        K[7 * i] = value
    K[5] = K[30] = 0.5 * math.sqrt(EA * EI)
    return _linear({"force": [F, 0, 0]}, "rz", section={"stiffness": K})


def _coupled_value() -> float:
    """Returns the rotation of the tip under the force F: the compliance between axial force and curvature, times F
    and the length."""
    c = 0.5 * math.sqrt(EA * EI)
    return -c / (EA * EI - c * c) * F * L


def _arc() -> Scene:
    """A quarter of a circle of radius 1 from the origin, in the xy plane, under a force at its end along y."""
    made = _linear({"force": [0, F, 0]}, "uy")
    made.nodes["tip"]["at"] = [1, 1, 0]
    made.members["bar"]["curvature"] = [0, 0, 1]
    return made


def _warping() -> Scene:
    constants = {"A": A, "Iy": I, "Iz": I, "It": IT, "Ip": 2 * I, "Iw": GIT * L**2 / 9 / E}  # sqrt(GIt/(E Iw)) L = 3
    section = {"constants": constants, "young": E, "shear_modulus": G}
    made = _linear({"moment": [F, 0, 0]}, "rx", section=section)
    made.members["bar"]["warping"] = ["fixed", "free"]
    return made


def _buckling() -> Scene:
    return _cantilever({"P": {"force": [-1, 0, 0], "on": "tip"}}, {"buckling": {}}, {"critical_factor": {}})


def _compliance() -> Scene:
    made = _cantilever({"F": {"force": [0, 1e-3, 0], "on": "tip"}}, {"static": {"stations": [1]}},
                       {"compliance": {"row": "uy", "column": "uy"}})
    made.analyses["c"] = {"compliance": {"about": "a", "node": "tip"}}
    made.quantities["q"]["compliance"]["analysis"] = "c"
    return made


def _prescribed() -> Scene:
    made = _cantilever({}, {"static": {"stations": [1]}}, {"reaction": {"node": "tip", "component": "uy"}},
                       drive={"uy": "m"})
    made.motions["m"] = {"path": [0, 1], "value": [0, 1e-4]}
    return made


def _flying() -> Scene:
    """A free rod that a force along it accelerates for 0.1 s."""
    made = _cantilever({"F": {"force": [RHO * A * L, 0, 0], "on": "tip"}}, {"motion": {"stations": [0.1]}}, _tip("ux"))
    made.nodes["root"] = {"at": [0, 0, 0], "hold": ["uy", "uz", "rx", "ry", "rz"]}
    return made


def _hinged() -> Scene:
    """Two clamped bars that a hinge connects; each bar carries half of the load."""
    made = _linear({"force": [0, F, 0]}, "uy")
    made.nodes["end"] = {"at": [2 * L, 0, 0], "hold": "all"}
    made.members["other"] = {"from_": "tip", "to": "end", "section": "bar", "y": [0, 1, 0], "release": {"from_": ["rz"]}}
    return made


def _sprung() -> Scene:
    made = _linear({"force": [0, F, 0]}, "uy")
    made.springs["spring"] = {"to": "tip", "stiffness": [0, 3 * EI / L**3, 0, 0, 0, 0]}
    return made


def _heavy() -> Scene:
    made = _cantilever({"g": {"gravity": [0, 9.81, 0], "on": "all"}}, {"linear": {}}, _tip("uy"), mass=5.0)
    return made


def _heated() -> Scene:
    made = _cantilever({"T": {"temperature": 10, "gradient": [100, 0], "on": "bar"}}, {"linear": {}}, _tip("uy"))
    made.sections["bar"]["expansion"] = 1e-5
    return made


def _body() -> Scene:
    """A cantilever with a density that is small compared with the mass at its tip."""
    made = _cantilever({}, {"modal": {}}, {"frequency": {}}, ("trapeze", "wagner_torque", "rotary_inertia"), mass=1e5)
    return made


def _tapered() -> Scene:
    """A wedge of rectangles, half as thick at its tip as at its root."""
    made = _linear({"force": [F, 0, 0]}, "ux")
    for name, thickness in (("bar", 0.1), ("thin", 0.05)):
        made.sections[name] = {"rectangle": {"width": 0.1, "thickness": thickness}, "given": {"Iw": 0}, "young": E, "shear_modulus": G}
    made.members["bar"]["section"] = ["bar", "thin"]
    made.omit = [*made.omit, "shear"]
    return made


_BENT = EI * math.pi / 2 / L  # moment that bends the cantilever to a quarter of a circle
_ARC = (3 * math.pi / 4 - 2) / EI + math.pi / 4 / EA  # integrals of (1 - sin s)^2/EI and sin(s)^2/EA over the quarter of a circle
CASES: tuple[Case, ...] = (
    ("bending", "cantilever under a small tip force", lambda: _linear({"force": [0, F, 0]}, "uy"), F * L**3 / 3 / EI),
    ("torsion", "cantilever under a small torque", lambda: _linear({"moment": [F, 0, 0]}, "rx"), F * L / GIT),
    ("shear", "cantilever, flexible in shear, under a small tip force", _shear, F * (L**3 / 3 / EI + L / GA)),
    ("distributed load", "cantilever under a small uniform load", lambda: _cantilever(
        {"q": {"distributed": [0, F, 0], "on": "bar"}}, {"linear": {}}, _tip("uy")), F * L**4 / 8 / EI),
    ("prescribed displacement", "reaction at the tip of a cantilever that is displaced there", _prescribed, 1e-4 * 3 * EI / L**3),
    ("weight", "deflection of a cantilever with a mass at its tip, under its weight", _heavy,
     9.81 * (RHO * A * L**4 / 8 + 5 * L**3 / 3) / EI),
    ("temperature", "deflection of a cantilever whose temperature varies across the section", _heated, -1e-5 * 100 * L**2 / 2),
    ("spring", "cantilever with a spring at its tip, as stiff as the cantilever", _sprung, F * L**3 / 6 / EI),
    ("hinge", "two cantilevers that a hinge joins at their tips", _hinged, F * L**3 / 6 / EI),
    ("taper", "extension of a wedge, half as thick at its tip as at its root", _tapered, F * 2 * L * math.log(2) / EA),
    ("coupled section", "rotation under an axial force, if the section couples axial force and bending", _coupled, _coupled_value()),
    ("initial curvature", "quarter of a circle under a small force at its end", _arc, F * _ARC),
    ("warping", "torsion of a cantilever whose root does not warp, k L = 3", _warping, F * L / GIT * (1 - math.tanh(3) / 3)),
    ("large displacements, plane", "cantilever bent to a quarter of a circle by a moment about z", lambda: _cantilever(
        {"M": {"moment": [0, 0, _BENT], "on": "tip"}}, {"static": {"stations": [1]}}, _tip("uy")), 2 * L / math.pi),
    ("large displacements, space", "the same, about y", lambda: _cantilever(
        {"M": {"moment": [0, -_BENT, 0], "on": "tip"}}, {"static": {"stations": [1]}}, _tip("uz")), 2 * L / math.pi),
    ("compliance", "compliance of the tip of a cantilever", _compliance, L**3 / 3 / EI),
    ("buckling", "Euler's load of a cantilever", _buckling, math.pi**2 * EI / 4 / L**2),
    ("frequency", "first frequency of a cantilever without rotary inertia", lambda: _cantilever(
        {}, {"modal": {}}, {"frequency": {}}, ("trapeze", "wagner_torque", "rotary_inertia")),
     1.8751040687119611**2 / (2 * math.pi * L**2) * math.sqrt(EI / RHO / A)),
    ("body", "frequency of a cantilever with a mass at its tip that is 1250 times that of the bar", _body,
     math.sqrt(3 * EI / (1e5 + 33 / 140 * RHO * A * L) / L**3) / (2 * math.pi)),
    ("motion", "rod that a force accelerates along its axis for 0.1 s, at the end of this time", _flying, 0.5 * 0.1**2),
)


def adapted(make: Callable[[], Scene], element: Any) -> Scene:
    """Returns the scene for an element: with a static analysis if the element has no linear one, and restricted to
    the xy plane if the element is plane and the loads are in this plane."""
    made = make()
    if made.analyses["a"] == {"linear": {}} and "linear" not in element.analyses:
        made.analyses["a"] = {"static": {"stations": [1]}}
    if "plane" in element.summary and "plane" in element.keys:
        made.plane = "xy"
        try:
            made.write()
        except Refused:  # the loads are not in this plane
            made.plane = ""
    return made


def _data(made: Scene) -> dict[str, Any]:
    with tempfile.TemporaryDirectory() as folder:
        place = pathlib.Path(folder, "scene.yaml")
        made.write(place)
        text, _ = program("scene", scene=str(place), format="json")
    data: dict[str, Any] = json.loads(text)
    return data


def outcome(series: Series, exact: float) -> str:
    """Returns "works (error)", "converges slowly (error)", "wrong by x %", "refused: reason", "failed: reason", "not
    installed" or, if there is no result and no reason, "no answer"."""
    if series.missing:
        return "not installed"
    errors = [run["values"]["q"] / exact - 1 for run in series.runs if "q" in run.get("values", {})]
    if errors:
        last = abs(errors[-1])
        if last <= WORKS:
            return f"works ({100 * last:.1g} %)"
        slow = len(errors) > 1 and last < _HALVED * abs(errors[0])
        return f"converges slowly ({100 * errors[-1]:+.2g} %)" if slow else f"wrong by {100 * errors[-1]:+.2g} %"
    for run in series.runs:
        if "q" in run.get("refused", {}):
            return f"refused: {run['refused']['q']}"
        for word, text in (("refusal", "refused"), ("failure", "failed")):
            if word in run:
                return f"{text}: {run[word]}"
    return "no answer"


def measure(peers: Sequence[tuple[str, str, Any]], solve: Callable[..., Series], limit: float,
            progress: Callable[[str], None]) -> dict[str, Any]:
    """Tries all features with all elements, (peer, name, Element)."""
    rows: dict[tuple[str, str], dict[str, Any]] = {}
    for name, _, make, exact in CASES:
        for peer, element, declared in peers:
            progress(f"{name}: {peer}:{element}")
            series = solve(_data(adapted(make, declared)), peer, element, FINE, 1, limit)
            row = rows.setdefault((peer, element), {"name": series.program, "version": "", "outcomes": {}})
            row["version"] = series.version or row["version"]
            row["outcomes"][name] = outcome(series, exact)
    return {"beamwork_peer_features": 1, "beamwork": version, "date": datetime.datetime.now(datetime.timezone.utc).date().isoformat(),
            "features": [{"name": name, "meaning": meaning} for name, meaning, _, _ in CASES], "rows": list(rows.values())}


def _tables(found: Mapping[str, Any]) -> Iterator[str]:
    programs: dict[str, list[Mapping[str, Any]]] = {}
    for row in found["rows"]:
        programs.setdefault(row["name"].split(", ")[0], []).append(row)
    for name, rows in programs.items():
        yield f"\n## {name} {rows[0]['version'] or '(not installed)'}\n"
        elements = [row["name"].split(", ", 1)[1] for row in rows]
        yield "| feature | " + " | ".join(f"`{element}`" for element in elements) + " |"
        yield "|---" * (len(rows) + 1) + "|"
        for feature in found["features"]:
            cells = (_SHORT.sub("", row["outcomes"][feature["name"]]).replace("|", "/") for row in rows)
            yield f"| {feature['name']} | " + " | ".join(cells) + " |"


def markdown(found: Mapping[str, Any]) -> str:
    """Returns the page of the documentation."""
    lines = ["# Features of other programs, as tried", "",
             "`python3 -m beamwork.peers --features --recorded reference/peers/features.json` prints this page, and `--features -o FILE.json`",
             f"measures the features again. Measured on {found['date']} with beamwork {found['beamwork']}. Each feature is a small scene with a",
             f"closed form, solved with {FINE[0]} and {FINE[1]} elements through the [drivers](../howto/peers.md) of beamwork. The entry is \"works\" with the",
             "error; \"converges slowly\" if the error is above 1 % but decreases; \"wrong by\" with the error; or the reason why the driver",
             "refuses the scene, or why the program fails. What a driver refuses may be possible with the program itself.", "",
             "| feature | scene |", "|---|---|", *(f"| {f['name']} | {f['meaning']} |" for f in found["features"])]
    return "\n".join([*lines, *_tables(found)]) + "\n"


def as_json(found: Mapping[str, Any]) -> str:
    rows = ",\n".join(f"  {json.dumps(row)}" for row in found["rows"])
    head = ",\n".join(f" {json.dumps(key)}: {json.dumps(value)}" for key, value in found.items() if key != "rows")
    return "{\n" + head + ',\n "rows": [\n' + rows + "\n ]\n}\n"
