"""Other programs' values (`beamwork import`) beside ours: kept apart, so that nothing that counts formulations counts them."""
import math

import h5py

from reports import data


def truths_of(point):
    """{quantity: (truth, kind)} that the formulations of a point are judged by."""
    return {v.quantity: v.truth for s in point.series for v in s.verdicts if math.isfinite(v.truth)}


def with_errors(series, truths):
    """The series with errors against our truths; of another model they are errors of the model."""
    for mesh in series.meshes:
        into = mesh.errors if series.model == "beam" else mesh.model_errors
        for quantity, value in mesh.values.items():
            if truths.get(quantity) and math.isfinite(value):
                into[quantity] = value / truths[quantity] - 1
    return series


def add(cases, path):
    """Adds the imported series of a file to points that the results have; those of the same name are there already."""
    with h5py.File(path) as file:
        names = set(file["cases"])
    for case in cases:
        if case.name not in names:
            continue
        found = {p.parameters: p.others for p in data.read_case(path, case.name).points}
        for point in case.points:
            known = {s.key for s in point.others}
            new = [s for s in found.get(point.parameters, []) if s.key not in known]
            point.others += [with_errors(s, truths_of(point)) for s in new]


def named(point, key):
    """The other program's series of this name, or None."""
    return next((s for s in point.others if s.key == key), None)


def style(index):
    """Grey, hollow, dotted: taken elsewhere."""
    return {
        "color": "currentColor", "marker": "sDv^<>ph"[index % 8], "hollow": True,
        "linestyle": (0, (1, 1)), "linewidth": 1, "markersize": 6, "alpha": 0.85 - 0.08 * (index % 8)
    }


def rows(point):
    """[(series, verdict or None, quantity, finest mesh with a value)] for a table."""
    out = []
    for series in point.others:
        judged = {v.quantity: v for v in series.verdicts}
        names = dict.fromkeys(
            q for m in series.meshes for q, value in m.values.items() if math.isfinite(value))
        for quantity in names:
            mesh = max(
                (m for m in series.meshes if math.isfinite(m.values.get(quantity, math.nan))),
                key=lambda m: m.n)
            out.append((series, judged.get(quantity), quantity, mesh))
    return out
