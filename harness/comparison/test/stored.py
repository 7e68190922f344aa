"""Stored runs for tests: made by verify, altered in one place, compared."""
import os
import shutil
import subprocess

import h5py
import numpy as np
from reference.pack import seal

PROGRAM = os.environ.get("BEAMWORK", "build/beamwork")
WORK = {
    "iterations": ("iterations",),
    "evaluations": ("strain_evaluations", "stress_evaluations", "inertia_evaluations"),
    "factorisations": ("factorisations",),
}
NUMBERS = ("value", "error", "near_zero")


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False)


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


def former_layout(stored, path):
    """The same run in the layout of version 1: a group for each cell."""
    with h5py.File(stored, "r") as old, h5py.File(path, "w") as new:
        new.attrs["schema"] = np.bytes_("beamwork-results")
        new.attrs["schema_version"] = 1
        for case, tables in old["cases"].items():
            for point in tables["points"][()]:
                group = new.create_group(f"cases/{case}/{point['point'].decode()}")
                group.attrs["parameters"] = np.bytes_(point["parameters"])
            for cell in tables["cells"][()]:
                former_cell(new[f"cases/{case}"], cell, tables["quantities"][()])
    seal(path)
    return path


def former_cell(of_case, cell, quantities):
    name = f"{cell['point'].decode()}/{cell['formulation'].decode()}/n{cell['elements']}"
    group = of_case.create_group(name)
    group.attrs["elements_per_member"] = cell["elements"]
    group.attrs["status"] = np.bytes_(cell["status"])
    for column in sum(WORK.values(), ()):
        group.attrs[column] = cell[column]
    own = quantities[
        np.all(
            [quantities[key] == cell[key] for key in ("point", "formulation", "elements")], axis=0
        )
    ]
    text = h5py.string_dtype("utf-8", own.dtype["quantity"].itemsize)
    rows = np.zeros(len(own), [("name", text)] + [(c, "f8") for c in NUMBERS])
    rows["name"] = own["quantity"]
    for column in NUMBERS:
        rows[column] = own[column]
    group["quantities"] = rows
