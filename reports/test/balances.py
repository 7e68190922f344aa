"""Adds the table `motion` to a results file: a mass on a spring with known energies and momenta."""
import h5py
import numpy as np

COLUMNS = ("time", "step", "iterations", "rejected", "error", "kinetic", "strain", "work",
           "dissipated", "drift", "px", "py", "pz", "lx", "ly", "lz")
KEYS = [("point", "S16"), ("formulation", "S40"), ("elements", "i4")]
TYPE = np.dtype(KEYS + [(name, "i4" if name in ("iterations", "rejected") else "f8")
                        for name in COLUMNS])


def rows(formulation, elements, end=2.0, steps=400, drift=1e-5, free=False):
    out = np.zeros(steps + 1, TYPE)
    t = np.linspace(0, end, steps + 1)
    out["point"], out["formulation"], out["elements"] = b"default", formulation.encode(), elements
    out["time"], out["iterations"][1:] = t, 3
    out["step"][1:] = np.diff(t)
    out["kinetic"], out["strain"] = 3 * np.sin(5 * t)**2, 3 * np.cos(5 * t)**2
    out["drift"] = 3 * drift * t / end
    out["px"] = 1 if free else np.sin(5 * t)
    out["lz"] = 2 if free else np.cos(5 * t)
    return out


def add(path, case, *found):
    with h5py.File(path, "r+") as file:
        group = file[f"cases/{case}"]
        if "motion" in group:
            del group["motion"]
        group["motion"] = np.concatenate(found)
