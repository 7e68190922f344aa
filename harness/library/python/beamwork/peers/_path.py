"""Follows an equilibrium path by control of one coordinate: limit points of the load factor, and states at values of the
control coordinate of the scene. The controlled coordinate is the one that moved most in the last step, so the path may
reverse its direction in any other coordinate."""
from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from .data import COMPONENTS, Analysis, Answer, Failed, MeshNode, PathPoint, Refused, Scene

_STEPS = (0.1, 0.07, 0.05, 0.035, 0.025, 0.0125)  # largest displacement in a step, divided by the length of the longest member
_LEAST, _MOST_POINTS, _MOST_REFINEMENTS = 1e-4, 2000, 6
_FIRST_FACTOR = 1e-3  # change of the load factor with which the first slope of the reaction is computed
# largest number of solutions for one point; reaction that counts as zero, relative to the largest reaction
_MOST_SECANTS, _BALANCED = 10, 1e-9
_APART = 1e-4  # smallest distance of points for an interpolation, divided by the length
_SAME = 1e-6  # change of a coordinate at a limit point, divided by the length, at which its refinement ends
_TURN = 0.7  # cosine of the largest angle between successive steps


class Path:
    """Interface of a driver. places: free translations (node of the scene, component), the first of which is the control
    coordinate of the scene."""
    places: Sequence[tuple[str, int]] = ()

    def begin(self) -> None:
        """Returns to the undeformed structure with the load factor 0."""
        raise NotImplementedError

    def move(self, place: int, value: float) -> int:
        """Changes the load factor so that a coordinate has this value. Returns the number of equation systems that were
        solved. If there is no solution, returns minus this number and restores the former state."""
        raise NotImplementedError

    def point(self) -> PathPoint:
        raise NotImplementedError


class HeldPath(Path):
    """Displacement control for programs that do not provide it: a support fixes the coordinate, and a search finds the
    load factor for which the reaction of the support is zero."""
    factor = largest = 0.0

    def __init__(self) -> None:
        self.rates: dict[int, float] = {}  # slope of the reaction as a function of the load factor

    def hold(self, place: int, value: float) -> None:
        """Supports a coordinate, and no other, at a value."""
        raise NotImplementedError

    def save(self) -> Any:
        """Returns the state of the structure, for `restore`."""
        raise NotImplementedError

    def restore(self, saved: Any) -> None:
        raise NotImplementedError

    def reaction(self, place: int, factor: float) -> tuple[int, float | None]:
        """Solves with a load factor. Returns the number of equation systems and the reaction of the support. If there is
        no solution, restores the former state and returns None."""
        raise NotImplementedError

    def reach(self, place: int, begin: float, value: float, factor: float, halvings: int = 4) -> tuple[int, float | None]:
        """Moves the support, in smaller steps where the solution fails."""
        self.hold(place, value)
        spent, force = self.reaction(place, factor)
        if force is not None or halvings == 0:
            return spent, force
        middle = (begin + value) / 2
        more, force = self.reach(place, begin, middle, factor, halvings - 1)
        spent += more
        if force is not None:
            more, force = self.reach(place, middle, value, factor, halvings - 1)
            spent += more
        return spent, force

    def move(self, place: int, value: float) -> int:
        before, saved = self.point(), self.save()
        tried, spent, factor = list[tuple[float, float]](), 0, self.factor
        while len(tried) < _MOST_SECANTS:
            count, force = self.reaction(place, factor) if tried else self.reach(place, before.values[place], value, factor)
            spent += count
            if force is None:
                break
            tried.append((factor, force))
            most = max(abs(f) for _, f in tried)
            if len(tried) > 1 and tried[-1][1] != tried[-2][1]:
                self.rates[place] = (tried[-1][1] - tried[-2][1]) / (tried[-1][0] - tried[-2][0])
            allowed = max(1e2 * most, abs(self.rates.get(place, 0.0)) * self.largest)
            if abs(force) <= _BALANCED * allowed:
                self.factor, self.largest = factor, max(self.largest, abs(factor))
                return spent
            factor = factor - force / self.rates[place] if place in self.rates else factor + _FIRST_FACTOR
        self.restore(saved)
        return -spent


def free_places(scene: Scene, analysis: Analysis) -> list[tuple[str, int]]:
    """Returns the free translations of the nodes of the scene, the control coordinate first."""
    control = analysis.raw["control"]
    first = (control["node"], COMPONENTS.index(control["component"]))
    places = [(node.name, i) for node in scene.nodes.values() for i, c in enumerate(COMPONENTS[:3])
              if c not in scene.held_at(MeshNode(0, node.name, node.at)) and c not in node.drive and "part_of" not in node.raw]
    if first not in places:
        raise Refused(f"control: {control['node']} does not move freely along {control['component']}")
    return [first, *(place for place in places if place != first)]


def require_proportional(scene: Scene) -> None:
    """Raises Refused if a load or motion is not proportional to the load factor of a continuation."""
    if scene.motions:
        raise Refused("motions: the driver follows paths without prescribed motions only")
    for load in scene.loads:
        if "factor" in load.raw:
            raise Refused(f"factor: the driver follows paths only if all loads are proportional; {load.name} is not")


def _difference(a: PathPoint, b: PathPoint) -> list[float]:
    return [y - x for x, y in zip(a.values, b.values)]


def _largest(vector: Sequence[float]) -> float:
    return max(abs(x) for x in vector)


def _cosine(a: Sequence[float], b: Sequence[float]) -> float:
    """Returns the cosine of the angle between two vectors."""
    size = math.hypot(*a) * math.hypot(*b)
    return sum(x * y for x, y in zip(a, b)) / size if size > 0 else 1.0


def _slope(points: Sequence[tuple[float, float]], x: float) -> float:
    """Returns the derivative at x of the polynomial through the points."""
    total = 0.0
    for j, (a, value) in enumerate(points):
        rest = [b for k, (b, _) in enumerate(points) if k != j]
        for i, b in enumerate(rest):
            total += value / (a - b) * math.prod((x - c) / (a - c) for k, c in enumerate(rest) if k != i)
    return total


def _extremum(points: Sequence[tuple[float, float]]) -> float:
    """Returns the position of the extremum of the polynomial through the points, between the neighbours of the extreme
    point."""
    known = sorted(points)
    sign = 1 if known[1][1] > known[0][1] else -1
    middle = max(range(1, len(known) - 1), key=lambda i: sign * known[i][1])
    low, high = known[middle - 1][0], known[middle + 1][0]
    rising = _slope(known, low) > 0
    for _ in range(60):
        x = (low + high) / 2
        low, high = (x, high) if (_slope(known, x) > 0) == rising else (low, x)
    return x


class _Walk:
    """A path that is followed with a given largest step."""

    def __init__(self, path: Path, analysis: Analysis, length: float, size: float) -> None:
        self.path, self.size, self.length = path, size * length, length
        self.targets, self.found = list(map(float, analysis.raw["to"])), list[PathPoint]()
        self.iterations = 0
        path.begin()
        self.points = [path.point()]

    def move(self, place: int, value: float) -> PathPoint | None:
        """Returns the point at which a coordinate has this value; None: no such point was found."""
        spent = self.path.move(place, value)
        self.iterations += abs(spent)
        return self.path.point() if spent > 0 else None

    def found_at(self, place: int, value: float) -> PathPoint:
        point = self.move(place, value)
        if point is None:
            raise Failed(f"no equilibrium after the load factor {self.points[-1].factor:g}")
        return point

    def attempt(self, place: int, step: float, before: Sequence[float]) -> PathPoint | None:
        """Makes a step. If the path turns too far or jumps, the step is too long: then restores the start of the step
        and returns None."""
        here = self.points[-1]
        after = self.move(place, here.values[place] + step)
        if after is None:
            return None
        moved = _difference(here, after)
        if _largest(moved) <= 3 * abs(step) and (not before or _cosine(before, moved) > _TURN):
            return after
        for k in sorted(range(len(moved)), key=lambda i: -abs(moved[i]))[:3]:
            back = self.move(k, here.values[k])
            if back is not None and _largest(_difference(here, back)) < 1e-6 * self.length:
                return None
        raise Failed(f"the path is lost after the load factor {here.factor:g}")

    def step(self, expected: Sequence[float], before: Sequence[float], size: float) -> tuple[int, PathPoint]:
        """Makes the longest step that succeeds. expected: direction of the path. Returns the controlled coordinate."""
        places = sorted(range(len(expected)), key=lambda i: -abs(expected[i]))[:2]
        while size > _LEAST * self.length:
            for place in places:
                after = self.attempt(place, math.copysign(size, expected[place]), before) if expected[place] != 0 else None
                if after is not None:
                    return place, after
            size /= 2
        raise Failed(f"no equilibrium after the load factor {self.points[-1].factor:g}")

    def follow(self) -> Answer:
        expected = [math.copysign(1, self.targets[0] - self.points[0].values[0])] + [0.0] * (len(self.path.places) - 1)
        before: list[float] = []
        size = self.size / 16
        while self.targets:
            if len(self.points) > _MOST_POINTS:
                raise Failed("the path does not reach the last value of the control coordinate")
            here = self.points[-1]
            place, after = self.step(expected, before, size)
            moved = _difference(here, after)
            size = min(self.size, 2 * _largest(moved))
            self.points.append(after)
            stop = self.stop_at_target()
            self.refine_limit(place)
            if not self.targets and stop is not None and self.points[-1] is not stop:
                self.points.append(stop)
            ratio = math.hypot(*moved) / math.hypot(*before) if before else 1
            expected = [2 * a - ratio * b for a, b in zip(moved, before)] if before else moved
            before = moved
        return Answer([p.state for p in self.found], path=self.points, stops=self.found, iterations=self.iterations)

    def stop_at_target(self) -> PathPoint | None:
        """If the last step passed the next value of the control coordinate, replaces the end of the step by the point
        with this value."""
        begin, end = (p.values[0] for p in self.points[-2:])
        if not min(begin, end) <= self.targets[0] <= max(begin, end) or begin == self.targets[0]:
            return None
        self.points[-1] = self.found_at(0, self.targets.pop(0))
        self.found.append(self.points[-1])
        return self.points[-1]

    def refine_limit(self, place: int) -> None:
        """If the load factor has an extremum within the last two steps, replaces the points beyond the extremum by the
        extremum, from which the path continues."""
        three = self.points[-3:]
        if len(three) < 3 or three[1].limit or (three[1].factor - three[0].factor) * (three[2].factor - three[1].factor) >= 0:
            return
        ahead = 1 if three[2].values[place] > three[1].values[place] else -1
        if ahead * three[0].values[place] >= ahead * three[1].values[place]:
            raise Failed(f"the path turns too quickly after the load factor {three[1].factor:g}")
        known, best = [(p.values[place], p.factor) for p in three], three[1]
        for _ in range(_MOST_REFINEMENTS):
            value = _extremum(known)
            change, best = abs(value - best.values[place]), self.found_at(place, value)
            if change < _SAME * self.length or min(abs(value - x) for x, _ in known) < _APART * self.length:
                break
            known.append((best.values[place], best.factor))
        best.limit = True
        while ahead * self.points[-1].values[place] >= ahead * best.values[place]:
            self.points.pop()
        self.points.append(best)


_known: dict[tuple[str, str, int, str], float] = {}  # largest steps with which each path was followed


def follow(path: Path, analysis: Analysis, scene: Scene, mesh: tuple[str, int]) -> Answer:
    """Follows a path from the undeformed structure, and repeats this with smaller steps if it fails. Later rounds begin
    with the steps that succeeded in the first round. mesh: name and number of elements."""
    key, why = (scene.of, *mesh, analysis.name), Failed("")
    for size in [step for step in _STEPS if step <= _known.get(key, math.inf)]:
        try:
            answer = _Walk(path, analysis, scene.length(), size).follow()
            _known[key] = size
            return answer
        except Failed as error:
            why = error
    raise why
