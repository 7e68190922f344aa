"""A scene as `beamwork scene` writes it, loops and expressions written out: text and numbers, and nothing read that is not understood.

What a program here does not know is refused in one line that names it, never passed over.
"""
import math

import yaml


class Refused(Exception):
    """The line for the user: what of the scene is not within the deriving program."""


def read(text):
    """The scene as nested dictionaries and lists of words."""
    try:
        scene = yaml.load(text, Loader=yaml.BaseLoader)
    except yaml.YAMLError as error:
        raise Refused(f"the scene cannot be read: {' '.join(str(error).split())}") from error
    if not isinstance(scene, dict) or scene.get("beamwork") != "1":
        raise Refused("the scene is not of version 1, as 'beamwork scene' writes it")
    return scene


def only(entry, where, known):
    """Refuses an entry with a key that is not known."""
    for key in entry:
        if key not in known:
            raise Refused(f"{where}: '{key}' is not within the deriving program")


def number(word, where):
    try:
        value = float(word)
    except (TypeError, ValueError):
        raise Refused(f"{where}: '{word}' is not a number") from None
    if not math.isfinite(value):
        raise Refused(f"{where}: {word} is not finite")
    return value


def numbers(words, where, count=None):
    if not isinstance(words, list) or count not in (None, len(words)):
        raise Refused(f"{where}: {count or 'a list of'} numbers are wanted")
    return [number(word, where) for word in words]


def named(table, name, what, where):
    if name not in table:
        raise Refused(f"{where}: no {what} '{name}'")
    return table[name]


def table(path, value):
    """Linear between the stations of a path, constant beyond them."""

    def at(level):
        if level <= path[0]:
            return value[0]
        for (a, u), (b, v) in zip(zip(path, value), zip(path[1:], value[1:])):
            if level <= b:
                return u + (v - u) * (level - a) / (b - a)
        return value[-1]

    return at
