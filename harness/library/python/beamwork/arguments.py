"""Converts the user's arguments for the library. Invalid arguments raise a one-line error."""
from __future__ import annotations

import json
import operator
import os
from collections.abc import Iterable
from typing import Any

from .errors import Refused


def utf8(value: Any, what: str) -> bytes | None:
    if value is None:
        return None
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if not isinstance(value, str):
        raise TypeError(f"{what}: a string is expected, not {type(value).__name__}")
    if not value or "\0" in value:
        raise Refused(f"{what}: {'an empty string' if not value else 'a string with a null character'} "
                      "is not allowed")
    return value.encode("utf-8", "surrogateescape")


def required(value: Any, what: str) -> bytes:
    if value is None:
        raise TypeError(f"{what}: a string is expected, not None")
    found = utf8(value, what)
    assert found is not None
    return found


def names(values: Iterable[Any], what: str) -> bytes | None:
    return b" ".join(required(v, what) for v in values) if values else None


def whole(value: Any, what: str) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{what}: a whole number is expected, not {value!r}") from None
    if isinstance(value, bool) or not 1 <= number < 2**31:
        raise Refused(f"{what} is {value!r}: a whole number of at least 1 is expected")
    return number


def whole_list(values: Any, what: str) -> bytes | None:
    if values is None:
        return None
    try:
        listed = list(values)
    except TypeError:
        raise TypeError(f"{what}: a list is expected, not {values!r}") from None
    if not listed:
        raise Refused(f"{what}: the list is empty; to use that of the scene, omit the argument")
    return ",".join(str(whole(v, what)) for v in listed).encode()


def options(values: dict[str, Any]) -> bytes | None:
    try:
        return json.dumps(values, allow_nan=False,
                          default=lambda v: v.item()).encode() if values else None
    except (TypeError, ValueError, AttributeError):
        raise TypeError(f"the values of options must be numbers, strings, True or False, not {values!r}") from None
