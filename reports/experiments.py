"""Reads the results of experiments other than verify. Each experiment has a group below /experiments. `beamwork schema`
describes the tables, whose column names are used here.

    python -m reports.experiments RESULTS.h5 EXPERIMENT PROGRAM

Exit status: 0 if the group of the experiment was written after the program was built, otherwise 1."""
import contextlib
import datetime
import math
import os
import sys

import h5py

from reports.data import Unreadable, rows, text

GROUPS = "experiments"


def plain(value):
    return None if isinstance(value, float) and not math.isfinite(value) else value


def attribute(value):
    return text(value) if isinstance(value, (bytes, str)) else plain(value.item())


def about(group):
    return {name: attribute(value) for name, value in group.attrs.items()}


@contextlib.contextmanager
def opened(path):
    try:
        file = h5py.File(path)
    except OSError as why:
        raise Unreadable(f"{path}: cannot be read ({why}); 'make verify' writes it") from why
    with file:
        yield file


def holds(path, name):
    if not os.path.exists(path):
        return False
    with opened(path) as file:
        return f"{GROUPS}/{name}" in file


def read(path, name):
    """Returns {name: value of an attribute, or rows of a table} of an experiment, or None if the file does not contain
    it."""
    if not holds(path, name):
        return None
    with opened(path) as file:
        group = file[GROUPS][name]
        tables = {table: [{column: plain(value) for column, value in row.items()}
                          for row in rows(group, table)]
                  for table in group if isinstance(group[table], h5py.Dataset)}
        return {**about(group), **tables}


def made(path):
    if not os.path.exists(path):
        return []
    with opened(path) as file:
        return [(name, about(file[GROUPS][name])) for name in file.get(GROUPS, ())]


def grouped(found, *names):
    out = {}
    for row in found:
        out.setdefault(tuple(row[name] for name in names), []).append(row)
    return out


def is_newer(path, name, program):
    run = dict(made(path)).get(name)
    if run is None:
        return False
    then = datetime.datetime.strptime(run["clock"], "%Y-%m-%dT%H:%M:%S%z")
    return then.timestamp() >= int(os.path.getmtime(program))


if __name__ == "__main__":
    sys.exit(0 if is_newer(*sys.argv[1:]) else 1)
