"""The C library: its location, its functions, and objects that must be freed."""
from __future__ import annotations

import ctypes
import os
import pathlib
import shutil
import threading
from collections.abc import Callable, Sequence
from ctypes import POINTER, c_char_p, c_double, c_int, c_size_t, c_void_p
from typing import Any, TypeVar

from .errors import Error, of_status

FILE = "libbeamwork.so.0"


def places() -> list[pathlib.Path]:
    asked = os.environ.get("BEAMWORK_LIBRARY")
    if asked:
        return [pathlib.Path(asked)]
    here = pathlib.Path(__file__).resolve().parent
    found = [here / "lib" / FILE, here / FILE, here.parent / FILE]
    for folder in here.parents:  # finds PREFIX/lib for the package PREFIX/lib/python3/dist-packages/beamwork
        found += [folder / FILE, folder / "lib" / FILE, folder / "build" / FILE]
        found += sorted((folder / "lib").glob(f"*/{FILE}"))
    program = shutil.which("beamwork")
    if program:
        folder = pathlib.Path(program).resolve().parent
        found += [folder / FILE, folder.parent / "lib" / FILE]
    return found + [pathlib.Path(FILE)]  # found by the system's loader


def _load() -> tuple[ctypes.CDLL, pathlib.Path]:
    tried = places()
    for path in tried:
        if path.name == str(path) or path.is_file():
            try:
                return ctypes.CDLL(str(path)), path
            except OSError as error:
                if path.name != str(path):
                    raise ImportError(f"beamwork: {path} cannot be loaded: {error}") from None
    what = f"BEAMWORK_LIBRARY={tried[0]} is not a file" if len(tried) == 1 else f"no {FILE}"
    raise ImportError(f"beamwork: {what}; run 'make library' in a clone of beamwork, or name the "
                      "file in BEAMWORK_LIBRARY")


_text = POINTER(c_void_p)
# Types of the arguments of functions that return a status. The last argument 'why' is added to each list.
_CALLS: dict[str, list[Any]] = {
    "truths": [c_char_p],
    "list": [c_char_p, _text],
    "formulation_load": [c_char_p, _text],
    "scene_case": [c_char_p, _text],
    "scene_read": [c_char_p, c_size_t, c_char_p, _text],
    "scene_open": [c_char_p, _text],
    "scene_set": [c_void_p, c_char_p],
    "scene_write": [c_void_p, _text],
    "scene_json": [c_void_p, _text],
    "solve": [c_void_p, c_char_p, c_int, c_char_p, _text],
    "result_json": [c_void_p, _text],
    "converge": [c_void_p, c_char_p, c_char_p, c_char_p, _text],
    "verify": [c_void_p, c_char_p, c_char_p, c_char_p, c_char_p, _text],
}
_ARRAY = POINTER(POINTER(c_double))
# Types of the results and arguments of functions that return no status.
_OTHERS: dict[str, tuple[Any, list[Any]]] = {
    "version": (c_char_p, []),
    "free_text": (None, [c_void_p]),
    "scene_free": (None, [c_void_p]),
    "result_free": (None, [c_void_p]),
    "result_quantities": (c_int, [c_void_p]),
    "result_name": (c_char_p, [c_void_p, c_int]),
    "result_unit": (c_char_p, [c_void_p, c_int]),
    "result_value": (c_double, [c_void_p, c_char_p]),
    "result_error": (c_double, [c_void_p, c_char_p]),
    "result_at": (c_double, [c_void_p, c_char_p]),
    "result_curve": (c_size_t, [c_void_p, c_char_p, _ARRAY, _ARRAY]),
    "result_motion": (c_size_t, [c_void_p, c_char_p, _ARRAY]),
    "result_formulation": (c_char_p, [c_void_p]),
    "result_elements": (c_int, [c_void_p]),
    "result_shapes": (c_size_t, [c_void_p, POINTER(c_size_t), _ARRAY]),
    "result_members": (c_size_t, [c_void_p, POINTER(POINTER(c_int))]),
    "result_shape_kind": (c_char_p, [c_void_p, c_size_t]),
    "result_shape_value": (c_double, [c_void_p, c_size_t]),
}


def _declare(library: ctypes.CDLL, path: pathlib.Path) -> dict[str, Any]:
    declared = {}
    calls: dict[str, tuple[Any, list[Any]]] = {name: (c_int, [*arguments, _text]) for name, arguments in _CALLS.items()}
    for name, (returns, arguments) in {**calls, **_OTHERS}.items():
        try:
            function = getattr(library, f"bw_{name}")
        except AttributeError:
            raise ImportError(f"beamwork: {path} has no bw_{name}: its version differs from "
                              "the version of this module") from None
        function.restype, function.argtypes = returns, arguments
        declared[name] = function
    return declared


_library, path = _load()
_functions = _declare(_library, path)
version: str = _functions["version"]().decode()
_Found = TypeVar("_Found")


class Owned:
    """A pointer to memory that the library allocated. It is freed with this object. lock: held by
    the thread that uses the pointer."""
    __slots__ = ("pointer", "lock", "_free", "__weakref__")

    def __init__(self, kind: str) -> None:
        self.pointer, self.lock = c_void_p(), threading.RLock()
        self._free = _functions[f"{kind}_free" if kind != "text" else "free_text"]

    def __del__(self) -> None:
        if self.pointer:
            self._free(self.pointer)

    def text(self) -> str:
        return ctypes.string_at(self.pointer).decode("utf-8", "replace") if self.pointer else ""


def call(name: str, *arguments: Any, entries: Sequence[str] = ()) -> None:
    """Calls bw_NAME, and raises the exception for its status. entries: see errors.of_status."""
    why = Owned("text")
    status = _functions[name](*arguments, ctypes.byref(why.pointer))
    if status != 0:
        raise of_status(status, why.text(), entries)


def text_of(name: str, *arguments: Any, entries: Sequence[str] = ()) -> str:
    text = Owned("text")
    call(name, *arguments, ctypes.byref(text.pointer), entries=entries)
    return text.text()


def owned_by(kind: str, name: str, *arguments: Any, entries: Sequence[str] = ()) -> Owned:
    """Returns the scene or result that bw_NAME returns. After a failure, a partial result is error.partial."""
    made = Owned(kind)
    try:
        call(name, *arguments, ctypes.byref(made.pointer), entries=entries)
    except Error as error:
        error.partial = made if made.pointer else None
        raise
    return made


def stoppable(work: Callable[[dict[str, Any]], _Found], options: dict[str, Any]) -> _Found:
    """Returns the result of work(options), which runs in another thread. Ctrl-C makes a descriptor readable, which is
    passed as the option stop. This ends the library's processes, and the interrupt is then raised in this thread. If
    stop is given, or in another thread, which receives no Ctrl-C, work(options) runs directly."""
    if "stop" in options or threading.current_thread() is not threading.main_thread():
        return work(options)
    outcome: list[tuple[_Found | None, BaseException | None]] = []
    done = threading.Event()
    readable, writable = os.pipe()

    def run() -> None:
        try:
            outcome.append((work({**options, "stop": readable}), None))
        except BaseException as error:  # pylint: disable=broad-exception-caught
            outcome.append((None, error))
        finally:
            done.set()

    threading.Thread(target=run).start()
    try:
        done.wait()
    finally:
        os.write(writable, b"x")  # forked processes hold the descriptor open, so closing it has no effect
        while not done.is_set():
            try:
                done.wait()
            except KeyboardInterrupt:  # Ctrl-C was pressed again before the end
                pass
        os.close(readable)
        os.close(writable)
    found, error = outcome[0]
    if error is not None:
        raise error
    return found  # type: ignore[return-value]  # of work, without an error


def ask(name: str, *arguments: Any) -> Any:
    return _functions[name](*arguments)
