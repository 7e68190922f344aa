#!/usr/bin/python3
"""Refuses circles of calls between source files: nm says what an object defines and what it needs.

usage: circles.py OBJECT...     one line for each circle; exit status 1 when there is one
"""
import collections
import subprocess
import sys


def symbols(objects):
    """({symbol: object that defines it}, {object: symbols it needs})."""
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
    """Strongly connected groups of two files or more (Tarjan), each in alphabetical order."""
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


def main(objects):
    defined, needed = symbols(objects)
    calls = {name: {defined[s] for s in needed[name] if s in defined} - {name} for name in objects}
    found = circles(calls)
    for group in found:
        print("circle of calls: " + ", ".join(group))
        for name in group:
            for other in group:
                shared = sorted(s for s in needed[name] if defined.get(s) == other)
                if shared and other != name:
                    print(f"    {name} -> {other}: {', '.join(shared)}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
