"""Motions as a result file holds them: the table `motion`, a row for each step that was kept, and
what integrated them, from the scene."""
from dataclasses import dataclass

import h5py
import numpy as np
import yaml

from reports.data import holds, text

TABLE = "motion"
MOMENTA = {"P": ("px", "py", "pz"), "L": ("lx", "ly", "lz")}


@dataclass
class Motion:
    """One motion. columns: {name: values}, the first row is of the begin."""

    formulation: str
    elements: int
    columns: dict

    @property
    def time(self):
        return self.columns["time"]

    @property
    def steps(self):
        """Lengths of the steps [s]."""
        return self.columns["step"][1:]

    @property
    def energy(self):
        return self.columns["kinetic"] + self.columns["strain"]

    @property
    def scale(self):
        """What a drift of energy is relative to: the most that there was at once [J]."""
        return float(max(np.abs(self.energy).max(), np.abs(self.columns["work"]).max()))

    @property
    def drift(self):
        """Of the energy, in parts of its scale, over time."""
        return self.columns["drift"] / (self.scale or 1)

    def momentum(self, which):
        """[steps x 3] of P or L."""
        return np.stack([self.columns[name] for name in MOMENTA[which]], axis=1)

    def stays(self, which):
        """Largest change of a momentum in parts of it, or NaN where there is none."""
        found = self.momentum(which)
        size = np.linalg.norm(found, axis=1).max()
        change = np.linalg.norm(found - found[0], axis=1).max()
        return float(change / size) if size > 0 else float("nan")


def motions_of(path, case, point="default"):
    """[Motion] of a case at a point: of each formulation the finest mesh."""
    with h5py.File(path) as file:
        group = file[f"cases/{case}"]
        if TABLE not in group or not len(group[TABLE]):
            return []
        table = group[TABLE][()]
    table = table[table["point"] == point.encode()]
    out = []
    for key in np.unique(table["formulation"]):
        own = table[table["formulation"] == key]
        own = own[own["elements"] == own["elements"].max()]
        if "analysis" in own.dtype.names:
            own = own[own["analysis"] == own["analysis"].max()]
        columns = {name: own[name].astype(float) for name in own.dtype.names
                   if own[name].dtype.kind in "fiu"}
        if len(own) > 1:
            out.append(Motion(key.decode(), int(own["elements"][0]), columns))
    return out


def has_motions(path):
    """Does any case of the file have one?"""
    with h5py.File(path) as file:
        return any(TABLE in group and len(group[TABLE]) for group in file["cases"].values())


def how(point):
    """What the scene says of its last motion, or {}."""
    analyses = (yaml.safe_load(point.scene) or {}).get("analyses", {}) if point.scene else {}
    found = [a["motion"] for a in analyses.values() if "motion" in a]
    return found[-1] if found else {}


@dataclass(frozen=True)
class Truth:
    """A value that is known at an instant."""

    time: float
    value: float


def truths_of(path, case, quantity, end):
    """[Truth] of a quantity at the defaults, whatever `time` is; end: its default."""
    with h5py.File(path, driver="core", backing_store=False) as file:
        group = file["truths"].get(case)
        names = ("parameters", "quantity", "model", "formulation")
        rows = zip(*([text(v) for v in group[n][()]] for n in names), group["value"][()]) if (
            group) else ()
        found = {}
        for at, of, model, formulation, value in rows:
            said = dict(item.split("=", 1) for item in at.split(";") if item)
            time = said.pop("time", str(end))
            rest = ";".join(f"{name}={what}" for name, what in said.items())
            if of == quantity and model != "other" and not formulation and holds(rest, ""):
                found[end if time == "*" else float(time)] = float(value)
    return [Truth(*item) for item in sorted(found.items())]
