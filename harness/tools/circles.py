#!/usr/bin/python3
"""Rejects circular calls between source files, and circular calls or includes between their folders. nm lists the symbols
that an object defines and needs.

usage: circles.py OBJECT...     one line for each circle; exit status 1 if there is one
"""
import collections
import pathlib
import re
import subprocess
import sys

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]+"([^"]+)"', re.M)
SHOWN = 3  # number of printed reasons for each step of a circle


def symbols(objects):
    """Returns ({symbol: object that defines it}, {object: symbols it needs})."""
    defined, needed = {}, collections.defaultdict(set)
    for line in subprocess.check_output(["nm", "-gA", *objects], text=True).splitlines():
        name, rest = line.split(":", 1)
        kind, symbol = rest.split()[-2:]
        if kind == "U":
            needed[name].add(symbol)
        else:
            defined[symbol] = name
    return defined, needed


def circles(calls):
    """Returns the strongly connected groups of two or more files (Tarjan's algorithm). The files of a group are in
    alphabetical order."""
    index, low, stack, found = {}, {}, [], []

    def visit(node):
        index[node] = low[node] = len(index)
        stack.append(node)
        for other in calls[node]:
            if other not in index:
                visit(other)
            if other in stack:
                low[node] = min(low[node], low[other])
        if low[node] == index[node]:
            group = []
            while not group or group[-1] != node:
                group.append(stack.pop())
            if len(group) > 1:
                found.append(sorted(group))

    for node in list(calls):
        if node not in index:
            visit(node)
    return found


def calls_of(objects):
    """Returns {(object, object): functions of the second object that the first one calls}."""
    defined, needed = symbols(objects)
    calls = collections.defaultdict(set)
    for name in objects:
        for symbol in needed[name]:
            if defined.get(symbol, name) != name:
                calls[name, defined[symbol]].add(symbol)
    return calls


FOLDER = re.compile(r"(?:.*/)?((?:elements|cases/format|cases|harness/\w+)/)(?:.*/)?")


def folder(path):
    """Returns the folder of a source or an object: build/harness/time/step.o belongs to harness/time."""
    found = FOLDER.match(path)
    return found[1] if found else str(pathlib.Path(path).parent)


def includes_of(objects):
    """Returns {(file, file): ""} of the sources and headers next to the sources of the objects."""
    matches = map(FOLDER.match, objects)
    places = {found[0][found.start(1):] for found in matches if found}
    return {(str(path), other): {""} for place in places for path in pathlib.Path(place).glob("*.[ch]")
            for other in INCLUDE.findall(path.read_text(encoding="utf-8"))}


def between_folders(steps):
    """Returns {(folder, folder): "file -> file: why"}."""
    found = collections.defaultdict(set)
    for (one, other), why in steps.items():
        ends = folder(one), folder(other)
        if ends[0] != ends[1]:
            found[ends] |= {f"{one} -> {other} {word}".rstrip() for word in why}
    return found


def tell(what, steps):
    ways = collections.defaultdict(set)
    for one, other in steps:
        ways[one].add(other)
    found = circles(ways)
    for group in found:
        print(f"circle of {what}: {', '.join(group)}")
        for one in group:
            for other in sorted(ways[one] & set(group)):
                why = sorted(steps[one, other])
                print(f"    {one} -> {other}: {', '.join(why[:SHOWN])}"
                      + (f" and {len(why) - SHOWN} more" if len(why) > SHOWN else ""))
    return len(found)


def main(objects):
    calls = calls_of(objects)
    found = tell("calls", calls) + tell("folders by calls", between_folders(calls)) + \
        tell("folders by includes", between_folders(includes_of(objects)))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
