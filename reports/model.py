"""What a run modelled: physics, supports, and the stability along its load paths."""
from dataclasses import dataclass

import h5py


@dataclass(frozen=True)
class Model:
    """The model of a formulation. `supports` are the coordinates that are not unknowns. `stability` is
    [(analysis, [(state, first path, last path)])] of the finest mesh."""

    key: str
    n: int
    features: str
    supports: list
    warping: str
    stability: list


def ranges(rows):
    """Returns [(state, first, last)] of consecutive [(path, state)] with the same state."""
    out = []
    for path, state in rows:
        if out and out[-1][0] == state:
            out[-1][2] = path
        else:
            out.append([state, path, path])
    return [tuple(one) for one in out]


def stability_of(path, case, point, key, n):
    """Returns [(analysis, ranges())] of a run in a results file, without analyses whose stability is undecided throughout."""
    with h5py.File(path) as file:
        group = file["cases"].get(case, {})
        table = group["steps"][()] if "steps" in group else None
    if table is None or "stability" not in (table.dtype.names or ()):
        return []
    own = table[(table["elements"] == n) & (table["formulation"] == key.encode()) & (table["point"] == point.encode())]
    found = {}
    for name, at, state in zip(own["analysis_name"].tolist(), own["path"].tolist(), own["stability"].tolist()):
        found.setdefault(name.decode(), []).append((at, state.decode()))
    return [(name, ranges(rows)) for name, rows in found.items() if {state for _, state in rows} != {"undecided"}]


def of(results, case, point, key):
    """Returns the Model of a formulation on its finest mesh, or None without a run."""
    series = next((s for s in point.series if s.key == key), None)
    meshes = [m for m in series.meshes if m.status == "ok"] if series else []
    if not meshes:
        return None
    mesh = meshes[-1]
    supports = [one for one in mesh.left_out.split("; ") if one and not one.startswith("physics:")]
    return Model(key, mesh.n, mesh.features, supports, mesh.warping,
                 stability_of(results, case.name, point.name, key, mesh.n))


def omissions(point):
    """Returns [(formulations, words)]: the physics that formulations omit, and the effect of the omission."""
    found = {}
    for series in point.series:
        if series.without and not series.missing:
            found.setdefault(series.without, []).append(series.key)
    return [(keys, words) for words, keys in found.items()]
