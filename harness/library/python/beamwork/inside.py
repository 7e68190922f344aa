"""Formulations whose functions are in this process. The library and the program start this file as
the process of the formulation. That process relays messages through a socket to this process, whose
threads answer them."""
from __future__ import annotations

import os
import select
import socket
import sys
from collections.abc import Callable
from typing import Any


def _element() -> Any:
    import importlib  # pylint: disable=import-outside-toplevel
    try:
        return importlib.import_module("beamwork_element")
    except ImportError:
        folder = os.path.join(os.path.dirname(__file__), *[".."] * 4, "elements", "examples")
        sys.path.append(os.path.realpath(folder))
        return importlib.import_module("beamwork_element")


def _listen(place: str, functions: dict[str, Callable[..., Any]], said: dict[str, Any]) -> None:
    import threading  # pylint: disable=import-outside-toplevel
    listening = socket.socket(socket.AF_UNIX)
    listening.bind(place)
    listening.listen(64)

    def answer(connection: socket.socket) -> None:
        with connection, connection.makefile("rb") as requests, connection.makefile("wb") as to:
            try:
                _element().answer_all(requests, to, functions, said)
            except OSError:  # the other process has ended
                pass

    def accept() -> None:
        while True:
            threading.Thread(target=answer, args=[listening.accept()[0]], daemon=True).start()

    threading.Thread(target=accept, daemon=True).start()


def door(functions: tuple[Callable[..., Any], ...], words: dict[str, Any]) -> str:
    """Returns the argument of load() for functions and words of beamwork_element.serve. Threads of this process answer
    requests until the process ends."""
    import atexit  # pylint: disable=import-outside-toplevel
    import shutil  # pylint: disable=import-outside-toplevel
    import tempfile  # pylint: disable=import-outside-toplevel
    try:
        by_name, said = _element().taken(functions, words)
    except SystemExit as error:
        raise TypeError(str(error)) from None
    folder = tempfile.mkdtemp(prefix="beamwork")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    place = os.path.join(folder, "element")
    _listen(place, by_name, said)
    return f"exec:{sys.executable} -I -S '{__file__}' '{place}'"


def relay(place: str) -> None:
    """Passes data from standard input to the socket, and from the socket to standard output, until one of them ends."""
    with socket.socket(socket.AF_UNIX) as there:
        there.connect(place)
        while True:
            for ready in select.select([0, there.fileno()], [], [])[0]:
                some = os.read(ready, 1 << 20)
                if not some:
                    return
                if ready == 0:
                    there.sendall(some)
                while ready != 0 and some:
                    some = some[os.write(1, some):]


if __name__ == "__main__":
    relay(sys.argv[1])
