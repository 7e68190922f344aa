"""Stored runs for tests: made by verify, altered in one place, compared."""
import shutil

import h5py

from harness.tools.kit.program import run
from reference.pack import seal

WORK = {
    "iterations": ("iterations",),
    "evaluations": ("strain_evaluations", "stress_evaluations", "inertia_evaluations"),
    "factorisations": ("factorisations",),
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
    """A sealed copy of which change(file) was made."""
    shutil.copy(old, new)
    with h5py.File(new, "r+") as file:
        change(file)
    seal(new)
    return new


def replace(group, name, rows):
    del group[name]
    group[name] = rows
