"""Scenes: a built-in case, a scene file, or a scene built from dicts."""
from __future__ import annotations

import copy
import json
import os
import threading
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from . import arguments, display
from .arguments import required, utf8
from .errors import Error, Refused
from .library import Owned, call, owned_by, stoppable, text_of
from .records import Convergence, Records, Verdicts
from .result import Result
from .writing import ENTRIES, HEAD, LISTS, number, scene_text

if TYPE_CHECKING:
    from .program import Progress


# Options of verify in the library.
_OF_LIBRARY = {"tolerance", "not_worse_than", "jobs", "time_limit", "refine", "shapes", "stop"}


def verified(scene: Any, formulations: tuple[str, ...], select: str | None, results: str | os.PathLike[str] | None,
             options: dict[str, Any], lines: Sequence[str] = (), case: Scene | None = None) -> Verdicts:
    """Returns the verdicts that the library computes. scene: pointer to the scene; None: all built-in cases. case: the
    scene, for the program."""
    if not _OF_LIBRARY.issuperset(options):
        from .verbs import verified_by_program  # pylint: disable=import-outside-toplevel,cyclic-import
        return verified_by_program(case, formulations, select=select, output=results, **options)
    chosen, words = arguments.names(formulations, "formulation"), utf8(select, "select")
    into = utf8(results, "results")
    return Verdicts(json.loads(stoppable(
        lambda given: text_of("verify", scene, chosen, words, arguments.options(given), into,
                              entries=lines), options)))


class Scene:
    """A structure, its loads and the requested quantities, as in a scene file; all values are SI.

    scene = Scene.case("c_column"), Scene.open("leaf.yaml"), Scene.text(yaml) or, built from dicts,

        scene = Scene("leaf")
        scene.sections["leaf"] = dict(rectangle=dict(width=50e-3, thickness=0.5e-3),
                                      young=210e9, shear_modulus=81e9)
        scene.nodes["base"] = dict(at=[0, 0, 0], hold="all")
        scene.nodes["tip"] = dict(at=[0.1, 0, 0])
        scene.members["leaf"] = dict(from_="base", to="tip", section="leaf", y=[0, 1, 0])
        scene.loads["push"] = dict(force=[0, 1, 0], on="tip")

    Keys are those of a scene file (`beamwork scene --keys`); `from_` is `from`. Numbers may be numpy numbers; strings
    may be expressions ("2*pi/3"). parameters, let, sections, nodes, members, springs, constraints, imperfections,
    motions, loads, analyses, quantities, parts and instances are dicts of entries; truths, omit and meshes are lists.
    omit may also be one word ("all"); shear_theory and plane ("xy": everything is restricted to it) are words. Entries
    may be changed between solutions.

    Invalid entries raise Refused with all errors together (error.mistakes). Threads that share a scene wait for each
    other."""
    __slots__ = ("summary", "source", "plane", "_name", "_make", "_written", "_entries", "_values",
                 "_handle", "_lines", "_lock", "_origin", "__weakref__")

    summary: str
    source: str
    plane: str

    def __init__(self, name: str = "scene", *, summary: str = "", source: str = "", plane: str = "") -> None:
        self._name, self.summary, self.source, self.plane = name, summary, source, plane
        self._origin: tuple[str, str] | None = None
        self._make: Callable[[], Owned] | None = None  # for scenes that are not built from dicts: the function that creates the handle
        self._entries: dict[str, Any] = {key: [] if key in LISTS else {} for key in ENTRIES}
        self._values: dict[str, bytes] = {}
        self._written: str | None = None
        self._handle: Owned | None = None
        self._lines: Sequence[str] = ()
        self._lock = threading.RLock()

    @classmethod
    def _made(cls, name: str, make: Callable[[], Owned], origin: tuple[str, str]) -> Scene:
        scene = cls(name)
        scene._make, scene._origin = make, origin
        scene._ready()
        return scene

    @classmethod
    def case(cls, name: str) -> Scene:
        """Makes a scene from a built-in case (see beamwork.cases())."""
        raw = required(name, "case")
        return cls._made(name, lambda: owned_by("scene", "scene_case", raw), ("case", name))

    @classmethod
    def open(cls, path: str | os.PathLike[str]) -> Scene:
        """Reads a scene file in its current state."""
        raw = required(path, "path")
        return cls._made(os.fspath(path), lambda: owned_by("scene", "scene_open", raw),
                         ("file", os.fspath(path)))

    @classmethod
    def text(cls, text: str, name: str = "scene") -> Scene:
        """Reads the text of a scene file. name: its name in error messages."""
        content, label = required(text, "text"), required(name, "name")
        return cls._made(name,
                         lambda: owned_by("scene", "scene_read", content, len(content), label),
                         ("text", text))

    def __getattr__(self, key: str) -> Any:
        if key not in ENTRIES:
            raise AttributeError(f"a scene has no {key!r}; it has: {', '.join(ENTRIES)}")
        if self._make is not None:
            raise AttributeError(f"{key}: {self._name} was not built from dicts; scene.write() returns "
                                 "its text, and Scene() begins a scene of dicts")
        return self._entries[key]

    def __setattr__(self, key: str, value: Any) -> None:
        if key in ENTRIES:
            getattr(self, key)  # raises AttributeError if there are no such entries
            if not isinstance(value, (list, tuple) if key in LISTS else Mapping):
                raise TypeError(f"{key}: {'a list' if key in LISTS else 'a dict'} is expected")
            self._entries[key] = value
        elif key in type(self).__slots__:
            super().__setattr__(key, value)
        else:
            raise AttributeError(f"a scene has no {key!r}; it has: {', '.join(ENTRIES)}")

    def _ready(self) -> Owned:
        lines: Sequence[str] = ()
        text = ""
        if self._make is None:
            head = dict(zip(HEAD, (self._name, self.summary, self.source, self.plane)))
            text, lines = scene_text(head, self._entries)
            if text != self._written:
                self._handle = None
        if self._handle is None:
            if self._make is None:
                content = text.encode()
                handle = owned_by("scene", "scene_read", content, len(content),
                                  required(self._name, "name"), entries=lines)
                self._written = text
            else:
                handle = self._make()
            for assignment in self._values.values():
                call("scene_set", handle.pointer, assignment)
            self._handle, self._lines = handle, lines
        return self._handle

    def set(self, **values: Any) -> Scene:
        """Sets parameter values, for example set(thickness=0.5e-3, kind="wide"). If a value is rejected, none is set.
        Returns the scene."""
        assignments = {}
        for key, value in values.items():
            value = value.tolist() if hasattr(value, "tolist") else value
            if isinstance(value, bool) or not isinstance(value, (int, float, str)):
                raise TypeError(f"{key}: a number or a word is expected, not {value!r}")
            word = value if isinstance(value, str) else number(value, key)
            required(word, key)
            assignments[key] = required(f"{key}={word}", key)
        with self._lock:
            before = self._values
            self._values = {**before, **assignments}
            try:
                handle = self._ready()
                for assignment in assignments.values():
                    call("scene_set", handle.pointer, assignment)
            except BaseException:
                self._values, self._handle = before, None
                raise
        return self

    def origin(self) -> tuple[str, str, dict[str, str]]:
        """Returns the origin of the scene, for the program: "case", "file" or "text"; its name, path or text; and
        {name: value} of the values that were set."""
        with self._lock:
            self._ready()
            kind, where = self._origin or ("text", self._written or "")
            values = (raw.decode().partition("=") for raw in self._values.values())
            return kind, where, {name: value for name, _, value in values}

    @property
    def about(self) -> dict[str, Any]:
        """Returns the description of the scene in the form of `beamwork list CASE --format json`: a dict of case,
        summary, source and Records of parameters (name, unit, value, default, min, max, choices, summary), quantities
        (name, unit, meaning, is_curve) and formulations (formulation, runs, without)."""
        with self._lock:
            told = json.loads(text_of("scene_json", self._ready().pointer, entries=self._lines))
        return {k: Records(v) if isinstance(v, list) else v for k, v in told.items()}

    def write(self, path: str | os.PathLike[str] | None = None) -> str:
        """Returns the text of the scene as a file, with expanded loops and expressions, and numbers that keep all
        bits. If `path` is given, writes this file as well."""
        with self._lock:
            text = text_of("scene_write", self._ready().pointer, entries=self._lines)
        if path is not None:
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        return text

    def solve(self, formulation: str | None = None, elements: int | None = None, **options: Any) -> Result:
        """Returns the Result of one formulation on one mesh.

        formulation: such as "beamw" or "beamw:mass=lumped"; None: a formulation that supports the physics of the scene.
        elements: number per member; None: the coarsest mesh on which no value changes by more than `error` (0.001) from
        the previous mesh. Raises NotConverged if the values still change on the finest mesh tried.
        options: error, all_dofs, steps, shapes, threads, stability, stop, ... (see beamwork.h).

        Raises Refused, NotConverged, Singular or Fault; error.result is the partial result, or None. After Ctrl-C,
        raises KeyboardInterrupt when the current iteration or, in a motion, the current step is complete."""
        name = utf8(formulation, "formulation")
        count = 0 if elements is None else arguments.whole(elements, "elements")
        arguments.options(options)
        with self._lock:
            try:
                handle = self._ready()
                return Result(stoppable(
                    lambda given: owned_by("result", "solve", handle.pointer, name, count, arguments.options(given),
                                           entries=self._lines), options))
            except Error as error:
                if error.partial is not None:
                    error.result, error.partial = Result(error.partial), None
                raise

    def converge(self, *formulations: str, meshes: Sequence[int] | None = None, progress: Progress | None = None,
                 **options: Any) -> Convergence:
        """Returns the Convergence of formulations (none named: all that support the scene) over meshes (None: those of
        the scene): errors, limits with their uncertainty, orders, and the formulations ranked by cost.

        progress: a function of (done, of, share, what) that is called at least once a second.
        options: error (0.01: the error target of `answers`), select ("C_zz or C_xx"), jobs (processes), stop (a file
        descriptor: when it becomes readable, the call raises TimeLimit)."""
        if progress is not None:
            from .verbs import converged_by_program  # pylint: disable=import-outside-toplevel,cyclic-import
            return converged_by_program(self, formulations, meshes, progress, options)
        chosen = arguments.names(formulations, "formulation")
        sizes = arguments.whole_list(meshes, "meshes")
        with self._lock:
            handle = self._ready()
            return Convergence(json.loads(stoppable(
                lambda given: text_of("converge", handle.pointer, chosen, sizes,
                                      arguments.options(given), entries=self._lines), options)))

    def verify(self, *formulations: str, select: str | None = None, results: str | os.PathLike[str] | None = None,
               **options: Any) -> Verdicts:
        """Returns the Verdicts on formulations for this scene, from its reference values (see beamwork.verify)."""
        with self._lock:
            return verified(self._ready().pointer, formulations, select, results, options,
                            self._lines, self)

    def copy(self) -> Scene:
        """Returns a copy with the same entries and values."""
        return copy.deepcopy(self)

    __copy__ = copy

    def __deepcopy__(self, memo: dict[int, Any]) -> Scene:
        made = Scene(self._name, summary=self.summary, source=self.source, plane=self.plane)
        made._make, made._values = self._make, dict(self._values)
        made._origin = self._origin
        made._entries = copy.deepcopy(self._entries, memo)
        return made

    def __reduce__(self) -> tuple[Any, ...]:
        raise TypeError("a Scene refers to memory of the library and cannot be pickled; "
                        "pickle scene.write()")

    def __repr__(self) -> str:
        kind = "built" if self._make is None else "read"
        return f"<Scene {self._name}, {kind}{''.join(f', {k}' for k in self._values)}>"

    def _repr_html_(self) -> str:
        try:
            return display.scene(self.about, self.write())
        except Refused as error:
            return display.mistakes(error.mistakes or (error, ))
