"""Motions for drivers: functions of time of a scene, quantities of histories, and the choice of the time step."""
from __future__ import annotations

import ast
import bisect
import math
import operator
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from .data import (COMPONENTS, Analysis, Answer, Failed, Load, Mesh, Quantity, Refused, Scene, State, Vector, cross, product, rotation,
                   rotation_vector, times, transposed)

Function = Callable[[float], float]
# settings that only beamwork uses
NUMERICS = {"integrator", "step", "tolerance", "rho", "hht", "trapezoidal", "parameters", "mass"}
TAKES = ("last", "curve", "max", "min", "max_time", "min_time", "mean", "rms", "crossing")
QUANTITIES = {"displacement": {"node", "component"}, "reaction": {"node", "component"}, "rate": {"node", "component", "of"},
              "relative": {"node", "from", "component"}, "energy": {"of"}}
LEAST, MOST = 1e-5, 1e-3  # bounds of the change of the values when the time step is halved
_FIRST_BOUND = 1e-4
_NAMES: dict[str, Any] = {"pi": math.pi, "deg": math.pi / 180, "abs": abs, "sign": lambda x: (x > 0) - (x < 0), "min": min,
                          "max": max, "mod": lambda x, y: x - y * math.floor(x / y),
                          **{name: getattr(math, name) for name in ("sqrt", "exp", "log", "sin", "cos", "tan", "asin", "acos",
                                                                    "atan", "sinh", "cosh", "tanh", "floor", "ceil", "atan2",
                                                                    "hypot")}}
_OPERATORS: dict[type, Callable[..., float]] = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul,
                                                ast.Div: operator.truediv, ast.Pow: operator.pow, ast.USub: operator.neg,
                                                ast.UAdd: operator.pos}


def expression(text: str) -> Function:
    """Returns an expression of a scene file as a function of t."""
    whole = ast.parse(text.replace("^", "**"), mode="eval").body

    def check(node: ast.AST) -> None:
        if isinstance(node, ast.Call):
            parts: list[Any] = [node.func, *node.args]
        elif isinstance(node, ast.BinOp) and type(node.op) in _OPERATORS:
            parts = [node.left, node.right]
        elif isinstance(node, ast.UnaryOp) and type(node.op) in _OPERATORS:
            parts = [node.operand]
        elif isinstance(node, ast.Name) and (node.id == "t" or node.id in _NAMES):
            parts = []
        elif isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
            parts = []
        else:
            raise Refused(f"time: drivers do not read the expression {text}")
        for part in parts:
            check(part)

    def value(node: Any, t: float) -> Any:
        if isinstance(node, ast.Constant):
            return node.value
        if isinstance(node, ast.Name):
            return t if node.id == "t" else _NAMES[node.id]
        if isinstance(node, ast.Call):
            return value(node.func, t)(*(value(one, t) for one in node.args))
        if isinstance(node, ast.UnaryOp):
            return _OPERATORS[type(node.op)](value(node.operand, t))
        return _OPERATORS[type(node.op)](value(node.left, t), value(node.right, t))

    check(whole)
    return lambda t: float(value(whole, t))


def function_of(raw: Mapping[str, Any]) -> Function | None:
    """Returns the function of time of a load or a motion; None if it has none."""
    if "pieces" not in raw:
        return None
    ends = [float(piece.get("until", math.inf)) for piece in raw["pieces"]]
    parts = [expression(str(piece["is"])) for piece in raw["pieces"]]
    return lambda t: parts[min(bisect.bisect_right(ends, t), len(parts) - 1)](t)


def load_factor(scene: Scene, load: Load, analysis: Analysis) -> Function:
    """Returns the factor of a load over time."""
    found = function_of(load.raw)
    end = scene.analyses[analysis.about].stations[-1] if analysis.about else 1.0
    constant = scene.load_factor(load, end) if analysis.about else 1.0
    return found or (lambda t: constant)


def drive_value(scene: Scene, name: str, analysis: Analysis) -> Function:
    """Returns the value of a prescribed motion over time."""
    found = function_of(scene.motions[name])
    path_end = scene.analyses[analysis.about].stations[-1] if analysis.about else 0.0
    before = scene.motion_value(name, path_end) if analysis.about else 0.0
    last = float(scene.motions[name]["value"][-1]) if found is None else 0.0
    if abs((found(0.0) if found else last) - before) > 1e-9 * (1 + abs(before)):
        raise Refused(f"motions: {name} jumps at the start of {analysis.name}")
    return found or (lambda t: last)


def derivatives(f: Function, step: float) -> tuple[Function, Function]:
    """Returns the first and second derivatives of a function of time, by differences over `step`; at 0 s from the right."""
    def rate(t: float) -> float:
        return (f(t + step) - f(t - step)) / (2 * step) if t >= step else (4 * f(t + step) - f(t + 2 * step) - 3 * f(t)) / (2 * step)

    def acceleration(t: float) -> float:
        t = max(t, step)
        return (f(t + step) - 2 * f(t) + f(t - step)) / step**2

    return rate, acceleration


def asked(scene: Scene) -> set[str]:
    """Returns the nodes in quantities of motions."""
    return {q.raw[key] for q in scene.quantities for key in ("node", "from")
            if key in q.raw and q.analysis in scene.analyses and scene.analyses[q.analysis].kind == "motion"}


def normal(scene: Scene) -> int | None:
    """Returns the index of the global axis perpendicular to the plane in which a scene stays; None: the scene does not stay
    in a plane."""
    for k in range(3):
        others = [i for i in range(3) if i != k]
        level = next(iter(scene.nodes.values())).at[k]
        straight = all(abs(abs(member.axes[k][1]) - 1) < 1e-12 or abs(abs(member.axes[k][2]) - 1) < 1e-12
                       for member in scene.members.values())
        bent = any(member.curvature[0] != 0 or member.curvature[2 if abs(member.axes[k][1]) > 0.5 else 1] != 0
                   for member in scene.members.values())
        across = any(any(load.vector[i] != 0 for i in others) if load.kind == "moment" else load.vector[k] != 0 for load in scene.loads)
        driven = any(c in node.drive for node in scene.nodes.values() for c in ("u" + "xyz"[k], *("r" + "xyz"[i] for i in others)))
        starts = [a.raw.get("start", {}) for a in scene.analyses.values()]
        leaves = any(s.get("velocity", (0, 0, 0))[k] != 0 or any(s.get("spin", (0, 0, 0))[i] != 0 for i in others) for s in starts)
        if all(node.at[k] == level for node in scene.nodes.values()) and straight and not (bent or across or driven or leaves):
            return k
    return None


def start_velocity(analysis: Analysis, at: Vector) -> tuple[list[float], list[float]]:
    """Returns the velocity of a node, and its angular velocity along fixed axes, at the start of a motion."""
    start = analysis.raw.get("start", {})
    spin = list(start.get("spin", (0.0, 0.0, 0.0)))
    arm = [a - c for a, c in zip(at, start.get("centre", (0.0, 0.0, 0.0)))]
    return [v + w for v, w in zip(start.get("velocity", (0.0, 0.0, 0.0)), cross(spin, arm))], spin


def lumped_mass(mesh: Mesh) -> list[float]:
    """Returns the mass of the members at each node of the mesh. The mass of elements with three nodes is divided by Simpson's
    rule."""
    out = [0.0] * len(mesh.nodes)
    for element in mesh.elements:
        weights = (0.5, 0.5) if len(element.nodes) == 2 else (1 / 6, 2 / 3, 1 / 6)
        for node, weight in zip(element.nodes, weights):
            out[node] += weight * element.length * element.member.section.rho_A
    return out


def continued(vector: Sequence[float], before: Sequence[float]) -> list[float]:
    """Returns the rotation vector of the same rotation that is nearest to the vector before."""
    size = math.hypot(*vector)
    if size < 1e-12:
        size, axis = 0.0, [x / (math.hypot(*before) or 1.0) for x in before]
    else:
        axis = [x / size for x in vector]
    turns = round((sum(a * b for a, b in zip(axis, before)) - size) / (2 * math.pi))
    return [(size + 2 * math.pi * turns) * x for x in axis]


def _relative(q: Quantity, scene: Scene, state: State, before: list[float]) -> list[float | None]:
    node, base = q.raw["node"], q.raw["from"]
    both = [state.u[base], state.u[node]]
    if any(None in u[:3] for u in both) or any(None in u[3:] for u in both[:1]):
        return [None] * 6
    (p, r), (x, _) = [([float(v) for v in u[:3] if v is not None], u[3:]) for u in both]
    R = rotation([float(v) for v in r if v is not None])
    arm = [b - a for a, b in zip(scene.nodes[base].at, scene.nodes[node].at)]
    moved = [a + d - c for a, d, c in zip(arm, x, p)]
    out: list[float | None] = [v - a for v, a in zip(times(transposed(R), moved), arm)]
    turn = both[1][3:]
    if None in turn:
        return [*out, None, None, None]
    vector = rotation_vector(product(transposed(R), rotation([float(v) for v in turn if v is not None])))
    before[:] = continued(vector, before)
    return [*out, *before]


def _entries(q: Quantity, scene: Scene, answer: Answer) -> list[float]:
    """Returns the values of a quantity at the times of an answer."""
    c = COMPONENTS.index(q.raw["component"]) if "component" in q.raw else 0
    found: list[float | None] = []
    before = [0.0] * 3
    for state in answer.states:
        if q.kind == "energy":
            found.append(state.energy.get(q.raw["of"]))
        elif q.kind == "relative":
            found.append(_relative(q, scene, state, before)[c])
        else:
            given = {"displacement": state.u, "reaction": state.reaction, "rate": state.rate}[q.kind]
            found.append(given[q.raw["node"]][c] if q.raw["node"] in given else None)
    whole = q.raw.get("take", "last") != "last" or "at" in q.raw
    if None in (found if whole else found[-1:]):
        raise Refused(f"{q.raw.get('component', q.raw.get('of', ''))}: the program does not give this {q.kind}"
                      + (" at all times" if whole else ""))
    return [math.nan if v is None else v for v in found]


def at_time(grid: Sequence[float], values: Sequence[float], t: float) -> float:
    """Returns the value of a cubic through the four nearest points of a history."""
    i = bisect.bisect_left(grid, t)
    for k in (i - 1, i):
        if 0 <= k < len(grid) and abs(grid[k] - t) <= 1e-9 * grid[-1]:
            return values[k]
    first = min(max(i - 2, 0), max(len(grid) - 4, 0))
    chosen = range(first, min(first + 4, len(grid)))
    return sum(values[k] * math.prod((t - grid[j]) / (grid[k] - grid[j]) for j in chosen if j != k) for k in chosen)


def _extreme(grid: Sequence[float], values: Sequence[float], sign: float) -> tuple[float, float]:
    """Returns the time and the value of the largest (sign 1) or smallest (-1) value, interpolated by a parabola between
    times."""
    k = max(range(len(values)), key=lambda i: sign * values[i])
    if not 0 < k < len(values) - 1:
        return grid[k], values[k]
    (a, b, c), (p, q, r) = grid[k - 1:k + 2], values[k - 1:k + 2]
    slope, next_slope = (q - p) / (b - a), (r - q) / (c - b)
    bend = (next_slope - slope) / (c - a)
    if bend == 0:
        return b, q
    t = min(max((a + b) / 2 - slope / (2 * bend), a), c)
    return t, p + slope * (t - a) + bend * (t - a) * (t - b)


def _crossing(q: Quantity, grid: Sequence[float], values: Sequence[float]) -> float:
    when = q.raw_entry.get("when", {})
    level, direction, which = float(when.get("level", 0)), when.get("direction", "rising"), int(when.get("which", 0))
    for a, b, v, w in zip(grid, grid[1:], values, values[1:]):
        rises, falls = v < level <= w, v > level >= w
        if (rises and direction != "falling") or (falls and direction != "rising"):
            if which == 0:
                return a + (b - a) * (level - v) / (w - v)
            which -= 1
    raise Refused("crossing: the peer's history does not cross the level so often")


def value_of(scene: Scene, q: Quantity, answer: Answer) -> float | list[list[float]]:
    """Returns the value of a quantity of a motion, or for a curve the list of [time, value]."""
    values, grid = _entries(q, scene, answer), answer.times
    take = q.raw.get("take", "last")
    if take == "crossing":
        return q.factor * _crossing(q, grid, values) + q.offset
    if take in ("mean", "rms"):
        power = 1 if take == "mean" else 2
        area = sum((b - a) * (v**power + w**power) / 2 for a, b, v, w in zip(grid, grid[1:], values, values[1:]))
        mean = area / (grid[-1] - grid[0])
        return q.factor * (mean if take == "mean" else math.sqrt(mean)) + q.offset
    if take[:3] in ("max", "min"):
        sign = (1 if take[:3] == "max" else -1) * (1 if q.factor >= 0 or take.endswith("time") else -1)
        t, extreme = _extreme(grid, values, sign)
        return q.factor * (t if take.endswith("time") else extreme) + q.offset
    values = [q.factor * v + q.offset for v in values]
    if take == "curve":
        return [[q.x.get("factor", 1.0) * t + q.x.get("offset", 0.0), at_time(grid, values, t)]
                for t in scene.analyses[q.analysis].stations]
    return at_time(grid, values, float(q.raw["at"])) if "at" in q.raw else values[-1]


def refusal(q: Quantity) -> str:
    """Returns the reason why no driver computes the quantity of a motion; "": drivers may compute it."""
    if q.kind not in QUANTITIES or set(q.raw) - QUANTITIES[q.kind] - {"analysis", "take", "at"}:
        return f"{q.kind}: no driver computes this quantity"
    if q.raw.get("take", "last") not in TAKES or "quantity" in q.x:
        return f"take: no driver computes '{q.raw.get('take', 'curve')}'"
    if set(q.raw_entry.get("when", {})) - {"level", "direction", "which"}:
        return "when: drivers do not read windows of a motion"
    if q.kind == "rate" and q.raw.get("of", "velocity") != "velocity":
        return f"rate: no driver computes the {q.raw['of']}"
    if q.kind == "energy" and q.raw["of"] not in ("kinetic", "strain", "energy"):
        return f"energy: no driver computes '{q.raw['of']}'"
    return ""


def first_step(scene: Scene, analysis: Analysis) -> float:
    """Returns the first time step: the smaller of a 32nd of the motion and a 16th of the shortest period of the
    first bending vibration of a member as a cantilever."""
    step = analysis.stations[-1] / 32
    for member in scene.members.values():
        s = member.section
        if s.rho_A > 0:
            step = min(step, 2 * math.pi / 3.516 * member.length**2 * math.sqrt(s.rho_A / max(s.EIy, s.EIz)) / 16)
    return step


def _numbers(value: Any) -> list[float]:
    return [point[1] for point in value] if isinstance(value, list) else [value]


def difference(scene: Scene, names: Sequence[str], a: Mapping[str, Any], b: Mapping[str, Any]) -> float:
    """Returns the largest difference between the values a and b, relative to the largest of the size of b,
    near_zero, and 1 % of the size of all values of the same kind and unit."""
    size: dict[Any, float] = {}
    chosen = [q for q in scene.quantities if q.name in names]
    for q in chosen:
        most = max(abs(v - q.offset) for v in _numbers(b[q.name]))
        size[q.kind, q.unit] = max(size.get((q.kind, q.unit), 0.0), most)
    worst = 0.0
    for q in chosen:
        x, y = _numbers(a[q.name]), _numbers(b[q.name])
        scale = max(max(abs(v) for v in y), float(q.raw_entry.get("near_zero", 0)), 0.01 * size[q.kind, q.unit])
        if scale > 0:
            worst = max(worst, max(abs(v - w) for v, w in zip(x, y)) / scale)
    return worst


def _bound(space: float | None) -> float:
    """Returns the bound of the change of the values when the time step is halved. space: change from the previous mesh; None:
    unknown."""
    return _FIRST_BOUND if space is None else min(max(0.03 * space, LEAST), MOST)


def refined(steps: dict[str, float], solved: Callable[[dict[str, float]], dict[str, Any]],
            differ: Callable[[Mapping[str, Any], Mapping[str, Any]], float], before: Mapping[str, Any],
            limit: float) -> tuple[dict[str, float], str, dict[str, Any]]:
    """Halves the time steps until the values change by less than a bound. Returns the steps, a sentence about them, and the
    values. solved: the values with given steps; differ: their relative difference. before: the values of the previous mesh;
    may be empty. limit: longest time [s]."""
    begun, last, failures, change = time.perf_counter(), dict[str, Any](), 0, math.inf
    while True:
        start, found = time.perf_counter(), dict[str, Any]()
        try:
            found = solved(steps)
        except Failed:
            failures += 1
            if failures > 6:
                raise
        if found and last:
            change = differ(last, found)
            if change <= _bound(differ(before, found) if before else None):
                told = ", ".join(f"{step:.3g}" for step in steps.values())
                return steps, f"time step at most {told} s; twice the step changes the values by {change:.1e} at most", found
        last, now = found, time.perf_counter()
        if now - begun + 2 * (now - start) > limit:
            told = "is not known" if change == math.inf else f"is {change:.1e}"
            raise Failed(f"time step: the change of the values when the step is halved to {min(steps.values()):.2g} s {told}, "
                         "and there is no time for shorter steps")
        steps = {name: step / 2 for name, step in steps.items()}
