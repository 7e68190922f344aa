"""Sweeps of artificial errors in the format of `beamwork sweep`, for tests."""
import itertools

import h5py
import numpy as np

STATUSES = ("ok", "not_converged", "singular", "refused", "fault", "time_limit", "no_value",
            "not_offered", "no_scene")
KINDS = ("truth stored", "truth derived", "limit of the meshes of all", "none",
         "none: formulations disagree")
SCATTERED = ("sobol", "halton", "random")
AXIS = np.dtype([("name", "S64"), ("unit", "S16"), ("kind", "S8"), ("scale", "S8"),
                 ("count", "i4")])
WORST = [("point", "i8"), ("formulation", "S64"), ("mesh", "i4"), ("quantity", "S32"),
         ("error", "f8"), ("status", "S16"), ("scene", "S128")]
WIDTH = ("width", "m", "linear", np.linspace(1, 10, 10))
ANGLE = ("angle", "rad", "linear", np.linspace(0, 0.9, 10))
SHAPE = ("shape", "1", "words", ("C", "box", "strip"))
STEP = 20_000


def grid(*axes):
    """Returns all combinations of the values of the axes (name, unit, kind, values or words) [points, axes]."""
    values = [range(len(a[3])) if a[2] == "words" else a[3] for a in axes]
    return np.array(list(itertools.product(*values)), float)


def scattered(count, *limits, seed=1):
    """Returns random points between the limits (low, high) of each axis [count, axes]."""
    low, high = np.array(limits, float).T
    return low + (high - low) * np.random.default_rng(seed).random((count, len(limits)))


def series(key):
    """Returns a function of points and elements that gives the artificial errors of a formulation. They decrease with the
    square of the number of elements, grow along each axis, and are multiplied by a factor that depends on the name."""
    factor = 1 + sum(map(ord, key)) % 7
    return lambda at, n: 0.02 * factor * (0.1 + at.sum(axis=1)) / n**2


def least_of(error, meshes, tolerance):
    """Returns the number of elements from which all meshes are within the tolerance, as the program computes it."""
    within = np.flip(np.logical_and.accumulate(np.flip(np.abs(error) <= tolerance, 2), axis=2), 2)
    first = np.argmax(within, axis=2)
    return np.where(within.any(axis=2), np.asarray(meshes)[first], 0)


def table_of(rows, columns):
    return np.array([tuple(x.encode() if isinstance(x, str) else x for x in row) for row in rows],
                    columns)


def store(path, axes, points, errors, meshes=(1, 2, 4, 8), quantities=(("u", "m"),),
          tolerance=0.01, status=None, kind=None, doubt=1e-9, worst=(), noise=1.0):
    """Writes a sweep.

      axes    [(name, unit, kind, values, words or, if scattered, "log" or "linear")]
      points  [P, A]
      errors  {formulation: function of points [p, A], scaled to 0..1 along each axis, and of elements to [p] or [p, Q]}
      status  function of points, formulation index and mesh index to numbers [p]
      kind    function of points to numbers [p]
      worst   rows of WORST
      noise   ratio of costs below which costs tie"""
    points = np.asarray(points, float)
    low = points.min(axis=0)
    span = np.where(points.max(axis=0) > low, points.max(axis=0) - low, 1)
    p, f, m, q = len(points), len(errors), len(meshes), len(quantities)
    with h5py.File(path, "w") as file:
        file.attrs.update({"beamwork_sweep": 1, "scene": "made_up.yaml", "program": "tests",
                           "plan": "0", "tolerance": tolerance, "axes": len(axes),
                           "parameters": "load=1", "cost_noise": f"{noise}"})
        rows = [(n, u, k, v, p) if k in SCATTERED else
                (n, u, k, k if k in ("linear", "log") else "", len(v)) for n, u, k, v in axes]
        file["axes"] = table_of(rows, AXIS)
        file["points"] = points
        for name, _, of, values in axes:
            if of == "words":
                file["points"].attrs[name] = "\n".join(values)
        file["quantities"] = table_of(quantities, [("name", "S32"), ("unit", "S16")])
        file["formulations"] = table_of([(k,) for k in errors], [("key", "S64")])
        file["meshes"] = np.array(meshes, "i4")
        shapes = {"reference": ((p, q), "f8"), "reference_doubt": ((p, q), "f8"),
                  "reference_kind": ((p, q), "u1"), "value": ((p, f, m, q), "f8"),
                  "error": ((p, f, m, q), "f8"), "status": ((p, f, m), "u1"),
                  "cost": ((p, f, m), "f8"), "seconds": ((p, f, m), "f8"),
                  "least": ((p, f, q), "i4"), "not_modelled": ((p, f), "i4")}
        table = {name: file.create_dataset(name, shape, of, chunks=True, compression="gzip",
                                           compression_opts=1)
                 for name, (shape, of) in shapes.items()}
        table["status"].attrs["names"] = "\n".join(STATUSES)
        table["reference_kind"].attrs["names"] = "\n".join(KINDS)
        for first in range(0, p, STEP):
            part = slice(first, first + STEP)
            fill(table, part, points[part], (points[part] - low) / span, errors, meshes, q,
                 tolerance, status, kind, doubt)
        file["worst"] = table_of(worst, WORST)
    return path


def fill(table, part, points, unit, errors, meshes, q, tolerance, status, kind, doubt):
    f, m = len(errors), len(meshes)
    error = np.zeros((len(points), f, m, q))
    for i, of in enumerate(errors.values()):
        for j, n in enumerate(meshes):
            error[:, i, j] = np.reshape(of(unit, n), (len(points), -1))
    state = np.zeros((len(points), f, m), int)
    if status:
        for i, j in itertools.product(range(f), range(m)):
            state[:, i, j] = status(unit, i, j)
    known = np.zeros(len(points), int) if kind is None else kind(unit)
    value = 1 + error
    value[state > 0] = error[state > 0] = np.nan
    error[known >= KINDS.index("none")] = np.nan
    work = np.ones((len(points), f, m)) * 1e-5 * np.asarray(meshes) * (1 + np.arange(f))[:, None]
    table["reference"][part] = np.where(known[:, None] >= 3, np.nan, 1.0)
    table["reference_doubt"][part] = doubt
    table["reference_kind"][part] = known[:, None]
    table["value"][part] = value
    table["error"][part] = error
    table["status"][part] = state
    table["cost"][part] = work
    table["seconds"][part] = work
    table["least"][part] = least_of(error, meshes, tolerance)
