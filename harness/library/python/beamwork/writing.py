"""Writes a scene of dicts and lists as the text of a scene file. The numbers keep all bits."""
from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any

from .errors import Refused

# First keys of a scene file, in this order. The lists of entries follow, with each entry on a separate line.
HEAD = ("name", "summary", "source", "plane")
ENTRIES = ("parameters", "let", "sections", "nodes", "members", "springs", "constraints", "imperfections", "motions", "loads",
           "analyses", "quantities", "truths", "omit", "shear_theory", "needs", "meshes", "parts", "instances")
LISTS = ("truths", "omit", "shear_theory", "needs", "meshes")
WORDS = ("omit", "shear_theory")  # a single word is sufficient for these keys
_WORD = re.compile(r"[A-Za-z_][A-Za-z0-9_]*\Z")
_DEEPEST = 40


def number(value: float, where: str) -> str:
    """Returns a float or an integer with the fewest digits that give the same bits when they are read."""
    if not math.isfinite(value):
        raise Refused(f"{where} is {value}: a finite number is expected")
    return repr(value)


def quoted(text: str, where: str) -> str:
    if not text.isprintable():
        raise Refused(f"{where}: {text[:40]!r} contains a non-printing character; write it in "
                      "one line, without tabs")
    if _WORD.match(text):
        return text
    plain = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{plain}"'


def written(value: Any, where: str, depth: int = 0) -> str:
    """Returns a value on one line: dicts as {key: value}, lists and arrays as [a, b]. Keys are written as by name()."""
    if depth > _DEEPEST:
        raise Refused(f"{where} is nested deeper than {_DEEPEST} levels")
    if hasattr(value, "tolist"):  # numpy: an array or a numpy number
        value = value.tolist()
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, (int, float)):
        return number(value, where)
    if isinstance(value, str):
        if not value:
            raise Refused(f"{where} is an empty string")
        return quoted(value, where)
    if isinstance(value, Mapping):
        pairs = (f"{name(key, where)}: {written(v, f'{where}[{key!r}]', depth + 1)}"
                 for key, v in value.items())
        return "{" + ", ".join(pairs) + "}"
    if isinstance(value, (list, tuple, range)):
        return "[" + ", ".join(
            written(v, f"{where}[{i}]", depth + 1) for i, v in enumerate(value)) + "]"
    raise Refused(f"{where} is {type(value).__name__}: only numbers, strings, lists and dicts can be written")


def name(key: Any, where: str) -> str:
    """Returns a key as it is written to the file. from_, for_ and is_ lose the _, because they are Python keywords
    without it."""
    if not isinstance(key, str) or not key:
        raise Refused(f"{where}: the key {key!r} is not a name")
    return quoted(key[:-1] if key in ("from_", "for_", "is_") else key, where)


def scene_text(head: Mapping[str, str], entries: Mapping[str, Any]) -> tuple[str, list[str]]:
    """Returns the text of a scene file and, for each of its lines, the entry that wrote the line ('': none). head: {key
    of HEAD: text}; entries: {key of ENTRIES: dict of entries, or a list}."""
    lines, owners = ["beamwork: 1"], [""]

    def add(line: str, owner: str) -> None:
        lines.append(line)
        owners.append(owner)

    for key in HEAD:
        if head.get(key):
            add(f"{key}: {written(head[key], key)}", key)
    for key in ENTRIES:
        value = entries.get(key)
        if value is None:
            continue
        value = value.tolist() if hasattr(value, "tolist") else value
        is_word = key in WORDS and isinstance(value, str)
        if not is_word and not isinstance(value, (list, tuple, range) if key in LISTS else Mapping):
            raise Refused(f"{key} is {type(value).__name__}: "
                          f"{'a list' if key in LISTS else 'a dict of names'} is expected")
        if not value:
            continue
        if key in WORDS or key in ("needs", "meshes"):
            add(f"{key}: {written(value, key)}", key)
            continue
        add(f"{key}:", key)
        pairs = enumerate(value) if key in LISTS else value.items()
        for label, entry in pairs:
            owner = f"{key}[{label!r}]"
            begin = "  - " if key in LISTS else f"  {name(label, key)}: "
            add(begin + written(entry, owner), owner)
    return "\n".join(lines) + "\n", owners
