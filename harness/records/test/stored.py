"""Stored runs for tests."""
import contextlib
import math
import shutil

import h5py
import numpy

from harness.tools.kit.program import run
from reference.pack import seal

WORK = {
    "iterations": ("iterations",),
    "evaluations": ("strain_evaluations", "stress_evaluations", "inertia_evaluations"),
    "factorisations": ("factorisations",),
    "flops": ("factor_flops",),
    "solutions": ("solutions",),
    "entries": ("solved_entries",),
}


def verify(selection, path, *options):
    done = run("verify", "-k", selection, "-o", path, *options)
    assert done.returncode == 0, done.stdout + done.stderr
    return path


def table_of(stored, path):
    done = run("compare", stored, "-o", path)
    assert done.returncode == 0, done.stderr
    return path


def altered(old, new, change):
    shutil.copy(old, new)
    with h5py.File(new, "r+") as file:
        change(file)
    seal(new)
    return new


@contextlib.contextmanager
def group_of(path, name="sweep"):
    with h5py.File(path) as file:
        yield file["experiments"][name]


def replace(group, name, rows):
    del group[name]
    group[name] = rows


def of_dtype(values):
    if isinstance(values[0], str):
        return numpy.array([value.encode() for value in values] or [b""])
    return numpy.array([math.nan if value is None else value for value in values])


def put_experiment(path, name, record):
    with h5py.File(path, "a") as file:
        if "schema" not in file.attrs:
            file.attrs.update(schema=numpy.bytes_("beamwork-results"), schema_version=3)
        group = file.require_group("experiments").create_group(name)
        for key, value in record.items():
            if not isinstance(value, list):
                group.attrs[key] = value
                continue
            columns = {c: of_dtype([row[c] for row in value]) for c in (value[0] if value else ())}
            rows = numpy.zeros(len(value), [(c, v.dtype) for c, v in columns.items()] or "S1")
            for column, values in columns.items():
                rows[column] = values
            group[key] = rows
    seal(path)
