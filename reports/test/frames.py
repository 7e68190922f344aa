"""Adds frames of motions to a results file: a structure that rotates as a rigid body."""
import h5py
import numpy as np
from scipy.spatial.transform import Rotation

from reports.shapes import FRAME


def turned(axes, by):
    own = Rotation.from_quat(axes[:, [1, 2, 3, 0]])
    return (by * own).as_quat()[:, [3, 0, 1, 2]]


def add(path, case, times, rate=1.0):
    with h5py.File(path, "r+") as file:
        g = file[f"cases/{case}/shapes/default"]
        new = {"kind": [FRAME.encode()] * len(times), "analysis": [0] * len(times),
               "value": list(times),
               "position": [], "orientation": [], "nodes": []}
        for t in times:
            by = Rotation.from_rotvec([0, 0, rate * t])
            new["position"].append(by.apply(g["position"][0]))
            new["orientation"].append(turned(g["orientation"][0], by))
            new["nodes"].append(by.apply(g["nodes"][0]))
        for name, values in new.items():
            old = g[name][()]
            values = np.array(values)
            if name == "kind":
                old, values = old.astype("S16"), values.astype("S16")
            del g[name]
            g[name] = np.concatenate([old, values])


def only(path, case, times, rate=1.0):
    """Adds frames as `add` does, but keeps only the undeformed state and the frames."""
    with h5py.File(path, "r+") as file:
        g = file[f"cases/{case}/shapes/default"]
        for name in ("kind", "analysis", "value", "position", "orientation", "nodes"):
            old = g[name][()][:1]
            del g[name]
            g[name] = old
    add(path, case, times, rate)
