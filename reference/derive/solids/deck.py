"""Input decks of CalculiX: written, run, and their results read."""
import os
import pathlib
import shutil
import subprocess

import numpy as np
from scipy.sparse import coo_matrix

PROGRAM = "ccx"
# Newton's iterations stop at 1e-7 of the mean force and of the largest displacement
# (the default: 5e-3 and 1e-2).
CONTROLS = "*CONTROLS,PARAMETERS=FIELD\n1e-7,1e-7\n"


class Failed(Exception):
    """CalculiX found no solution; the text is its last complaint."""


def available():
    return shutil.which(PROGRAM) is not None


def mesh(grid, kind, material):
    """Nodes, elements and the one section; material: cards after *MATERIAL."""
    lines = (
        ["*NODE"]
        + ["%d,%.12e,%.12e,%.12e" % (i + 1, *p) for i, p in enumerate(grid.nodes)]
        + [f"*ELEMENT,TYPE={kind},ELSET=ALL"]
    )
    for i, element in enumerate(grid.elements):
        numbers = [str(i + 1)] + [str(n + 1) for n in element]
        lines += [",".join(numbers[:11]) + ",", ",".join(numbers[11:])]
    return (
        "\n".join(lines) + f"\n*MATERIAL,NAME=M\n{material}\n*SOLID SECTION,ELSET=ALL,MATERIAL=M\n"
    )


def node_set(name, nodes):
    return f"*NSET,NSET={name}\n" + "".join(f"{n + 1},\n" for n in nodes)


def elastic(young, poisson):
    return f"*ELASTIC\n{young:.12e},{poisson:.12e}\n*DENSITY\n1."


def run(folder, name, text):
    """Writes the deck and solves it in the folder."""
    path = pathlib.Path(folder) / name
    path.with_suffix(".inp").write_text(text, encoding="utf-8")
    done = subprocess.run(
        [PROGRAM, name],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "OMP_NUM_THREADS": "1"},
    )
    if "Job finished" not in done.stdout or "*ERROR" in done.stdout:
        complaints = [line.strip() for line in done.stdout.splitlines() if "ERROR" in line] or [
            "it stopped"
        ]
        raise Failed(f"{PROGRAM} {name}: {complaints[-1]}")
    return path


def printed(path, what):
    """[{node: vector [3]}] of every printed increment; what: 'displacements' or 'forces'."""
    blocks, current = [], None
    for line in path.with_suffix(".dat").read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words and not words[0].isdigit():
            current = {} if words[0] == what else None
            blocks += [current] if current is not None else []
        elif words and current is not None:
            current[int(words[0]) - 1] = np.array([float(w) for w in words[1:4]])
    return blocks


def tangent(path):
    """(stiffness [n, n], [(node, direction)] of its rows) of a step with SOLVER=MATRIXSTORAGE."""
    row, column, value = np.loadtxt(path.with_suffix(".sti"), unpack=True)
    i, j = row.astype(int) - 1, column.astype(int) - 1
    off = i != j
    places = [
        tuple(int(p) for p in line.split("."))
        for line in path.with_suffix(".dof").read_text(encoding="utf-8").split()
    ]
    n = len(places)
    upper = coo_matrix((value, (i, j)), (n, n))
    return (upper + coo_matrix((value[off], (j[off], i[off])), (n, n))).tocsc(), [
        (node - 1, direction - 1) for node, direction in places
    ]
