"""Result: a scene solved with one formulation on one mesh."""
from __future__ import annotations

import ctypes
import difflib
import functools
import json
import math
import types
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy

from . import display, plots
from .library import Owned, ask, text_of
from .records import Records

if TYPE_CHECKING:
    import pandas


class Curve(NamedTuple):
    """Points of a quantity along a path: x and y [points] in SI units."""
    x: numpy.ndarray[Any, Any]
    y: numpy.ndarray[Any, Any]


class Shapes(NamedTuple):
    """Centre lines. position: [states, points, 3] in m; the first state is undeformed. first: [members + 1] first point
    of each member. kinds: [states] "path", "buckling", "motion", ...; values: [states] path parameter, load factor,
    frequency [Hz] or time [s]."""
    position: numpy.ndarray[Any, Any]
    first: numpy.ndarray[Any, Any]
    kinds: list[str]
    values: numpy.ndarray[Any, Any]

    def plot(self, scale: float = 1) -> Any:
        """Returns a matplotlib Figure of the centre lines. scale: factor of the displacements."""
        return plots.shapes(self, scale)


MOTION = ("time", "step", "iterations", "rejected", "error", "kinetic", "strain", "work",
          "dissipated", "drift", "px", "py", "pz", "lx", "ly", "lz")


class _Errors(dict[str, float]):
    """Relative errors of quantities. For a quantity without an error, raises KeyError with the reason."""

    def __missing__(self, name: object) -> float:
        raise KeyError(f"no error of {name!r}: this run has no reference value of it; 'beamwork truth CASE' lists those of a case")


class _Memory:
    def __init__(self, owner: Owned, array: Any, *shape: int) -> None:
        self.owner = owner
        size = ctypes.sizeof(array._type_)
        kind = "f" if array._type_ is ctypes.c_double else "i"
        self.__array_interface__ = {"version": 3, "shape": shape, "typestr": f"={kind}{size}",
                                    "data": (ctypes.cast(array, ctypes.c_void_p).value, True)}


class Result:
    """Results of one run. `result["k_drive"]` is a value [SI]; curves: `result.curve(name)`.

    values: {quantity: value}; errors: {quantity: error relative to its reference value}; units: {quantity: unit}.
    at: {quantity: position of its value}: for a motion the time [s], for example of a largest value, otherwise the
    path parameter.
    curves: names of the quantities that are curves.
    case, formulation, elements, parameters, cell (status, unknowns, counted work, times).
    document: all data, in the form of `beamwork solve --format json` (read at the first use).

    The memory belongs to the library. It is freed when the result and all arrays of its curves have been deleted.
    Several threads may use a result. A result cannot be pickled, but result.document can."""

    def __init__(self, handle: Owned) -> None:
        self._handle: Owned | None = handle
        values: dict[str, float] = {}
        errors = _Errors()
        units: dict[str, str] = {}
        at: dict[str, float] = {}
        curves = []
        with handle.lock:
            for i in range(ask("result_quantities", handle.pointer)):
                raw = ask("result_name", handle.pointer, i)
                name = raw.decode()
                units[name] = ask("result_unit", handle.pointer, i).decode()
                if self._points(raw)[0]:
                    curves.append(name)
                    continue
                values[name] = ask("result_value", handle.pointer, raw)
                error = ask("result_error", handle.pointer, raw)
                if not math.isnan(error):
                    errors[name] = error
                place = ask("result_at", handle.pointer, raw)
                if not math.isnan(place):
                    at[name] = place
        self.values = types.MappingProxyType(values)
        self.errors = types.MappingProxyType(errors)
        self.units = types.MappingProxyType(units)
        self.at = types.MappingProxyType(at)
        self.curves = tuple(curves)
        self.formulation: str = ask("result_formulation", handle.pointer).decode()
        self.elements: int = ask("result_elements", handle.pointer)

    def _open(self) -> Owned:
        if self._handle is None:
            raise ValueError("the result is closed")
        return self._handle

    def _points(self, name: bytes) -> tuple[int, Any, Any]:
        x, y = ctypes.POINTER(ctypes.c_double)(), ctypes.POINTER(ctypes.c_double)()
        count = ask("result_curve", self._open().pointer, name, ctypes.byref(x), ctypes.byref(y))
        return count, x, y

    def _missing(self, name: object, among: list[str]) -> KeyError:
        near = difflib.get_close_matches(str(name), among, 1)
        hint = f"did you mean {near[0]!r}?" if near else f"there are {', '.join(among) or 'none'}"
        return KeyError(f"no quantity {name!r}: {hint}")

    def __getitem__(self, name: str) -> float:
        """Returns a value in its SI unit. Raises KeyError for an unknown name or the name of a curve."""
        if name in self.curves:
            raise KeyError(f"{name!r} is a curve: result.curve({name!r})")
        try:
            return self.values[name]
        except (KeyError, TypeError):
            raise self._missing(name, list(self.values)) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self.values)

    def __len__(self) -> int:
        return len(self.values)

    def __contains__(self, name: object) -> bool:
        return name in self.values

    def curve(self, name: str) -> Curve:
        """Returns Curve(x, y) of a quantity along its path. The arrays are read-only views of the result's memory."""
        if name not in self.curves:
            raise self._missing(name, list(self.curves))
        handle = self._open()
        with handle.lock:
            count, x, y = self._points(name.encode())
        return Curve(numpy.asarray(_Memory(handle, x, count)), numpy.asarray(_Memory(handle, y, count)))

    @property
    def shapes(self) -> Shapes | None:
        """Returns the shapes of the solution if they were requested (solve(..., shapes=20)), otherwise None."""
        handle, points = self._open(), ctypes.c_size_t()
        position, first = ctypes.POINTER(ctypes.c_double)(), ctypes.POINTER(ctypes.c_int)()
        with handle.lock:
            states = ask("result_shapes", handle.pointer, ctypes.byref(points),
                         ctypes.byref(position))
            if not states:
                return None
            members = ask("result_members", handle.pointer, ctypes.byref(first))
            kinds = [ask("result_shape_kind", handle.pointer, i).decode() for i in range(states)]
            values = [ask("result_shape_value", handle.pointer, i) for i in range(states)]
        return Shapes(numpy.asarray(_Memory(handle, position, states, points.value, 3)),
                      numpy.asarray(_Memory(handle, first, members + 1)), kinds,
                      numpy.array(values))

    @functools.cached_property
    def document(self) -> dict[str, Any]:
        """Returns all data of the run, in the same form as `beamwork solve --format json`."""
        handle = self._open()
        with handle.lock:
            found: dict[str, Any] = json.loads(text_of("result_json", handle.pointer))
        return found

    @property
    def case(self) -> str:
        """Returns the name of the case or scene."""
        return str(self.document["case"])

    @property
    def parameters(self) -> dict[str, Any]:
        """Returns the parameters of the run as {name: value}."""
        return dict(self.document["parameters"])

    @property
    def cell(self) -> dict[str, Any]:
        """Returns status, unknowns, counted work and times [s] of the run."""
        return dict(self.document["cell"])

    @property
    def steps(self) -> dict[str, numpy.ndarray[Any, Any]]:
        """Returns {column: [steps] array} of the load steps: path, increment, iterations, rejected, correction, ..."""
        return self._columns("steps")

    @property
    def iterations(self) -> dict[str, numpy.ndarray[Any, Any]]:
        """Returns {column: [iterations] array} of the iterations: step, iteration, residual, correction, ..."""
        return self._columns("iterations")

    @property
    def motion(self) -> dict[str, numpy.ndarray[Any, Any]]:
        """Returns {column: [steps + 1] array} of a motion, for the start and the end of each step: time and step [s],
        iterations, rejected, error, kinetic, strain, work, dissipated and drift [J] (drift: energy-balance error), px
        to pz [kg m/s], lx to lz [kg m^2/s]. Returns {} if there is no motion. The arrays are read-only views of the
        result's memory."""
        found, handle = {}, self._open()
        with handle.lock:
            for name in MOTION:
                values = ctypes.POINTER(ctypes.c_double)()
                count = ask("result_motion", handle.pointer, name.encode(),
                            ctypes.byref(values))
                if count:
                    found[name] = numpy.asarray(_Memory(handle, values, count))
        return found

    def _columns(self, key: str) -> dict[str, numpy.ndarray[Any, Any]]:
        rows = self.document.get(key, [])
        return {name: numpy.array([math.nan if row[name] is None else row[name] for row in rows])
                for name in (rows[0] if rows else ())}

    @property
    def matrices(self) -> list[dict[str, Any]]:
        """Returns a dict for each state of compliance analyses: node, path, moments, and compliance and stiffness,
        which are [6, 6] arrays in the order ux, uy, uz, rx, ry, rz (None: there is none)."""
        def array(value: Any) -> numpy.ndarray[Any, Any] | None:
            return None if value is None else numpy.array(value, dtype=float)

        return [{**m, "compliance": array(m["compliance"]), "stiffness": array(m["stiffness"])}
                for m in self.document.get("matrices", [])]

    def plot(self, *names: str) -> Any:
        """Returns a matplotlib Figure of curves of quantities; without names, of all curves."""
        return plots.result(self, names)

    def frame(self) -> pandas.DataFrame:
        """Returns a pandas.DataFrame with a row for each value: quantity, value, unit, error, at."""
        return Records({"quantity": name, "value": value, "unit": self.units[name], "error": self.errors.get(name),
                        "at": self.at.get(name)} for name, value in self.values.items()).frame()

    def close(self) -> None:
        """Releases the library's memory, except that of arrays that still exist."""
        self._handle = None

    def __enter__(self) -> Result:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __reduce__(self) -> tuple[Any, ...]:
        raise TypeError("a Result refers to memory of the library and cannot be pickled; "
                        "pickle result.document or dict(result.values)")

    def __str__(self) -> str:
        d = self.document
        return f"{d['case']}, {d['formulation']}, n = {d['elements']}: {d['cell']['status']}"

    def __repr__(self) -> str:
        return "<Result, closed>" if self._handle is None else f"<Result {self}>"

    def _repr_html_(self) -> str:
        return display.result(self)
