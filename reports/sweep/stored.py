"""Reads the results of `beamwork sweep` piece by piece. Only one piece is in memory at a time."""
import pathlib
from dataclasses import dataclass

import h5py
import numpy as np

from reports.data import Unreadable, text

MARK, VERSION = "beamwork_sweep", 1
GROUP = "experiments/sweep"  # in older files, the group is the root
PIECE = 1_000_000  # largest number of values of a table that are read at once
SCATTERED = ("sobol", "halton", "random")
NONE = "none"  # prefix of kinds of missing references
OTHER = "other_model"  # outcome of a formulation that omits relevant physics
ABSENT = ("not_offered", "no_scene", OTHER)  # outcomes of formulations that are not compared at a point


@dataclass(frozen=True)
class Axis:
    """A parameter that was varied. `log` is True if its range is divided into logarithmic intervals. `words` are its
    strings in the order of their indices. An axis of numbers has no words."""

    name: str
    unit: str
    kind: str
    count: int
    log: bool = False
    words: tuple = ()

    @property
    def scattered(self):
        return self.kind in SCATTERED

    def value(self, number):
        if self.words:
            return self.words[int(number)]
        return f"{number:.4g}" + (f" {self.unit}" if self.unit not in ("", "1") else "")


@dataclass(frozen=True)
class Quantity:
    name: str
    unit: str


@dataclass(frozen=True)
class Worst:
    """The worst point of a formulation and a mesh. `quantity` is empty if there is no solution (see status). `error`
    is relative. `scene` is the name of the stored scene file, or empty."""

    point: int
    formulation: str
    elements: int
    quantity: str
    error: float
    status: str
    scene: str


@dataclass
class Piece:
    """Consecutive points of a sweep.

      first   index of the first point
      at      values of the parameters [points, axes]
      `doubt` uncertainty of the reference value [points, quantities]
      kind    kind of the reference value, as an index in Sweep.kinds [points, quantities]
      value   [points, formulations, meshes, quantities], NaN if there is none
      error   relative error [points, formulations, meshes, quantities], NaN if there is none
      status  outcome, as an index in Sweep.statuses [points, formulations, meshes]
      cost    cost of counted work [s] [points, formulations, meshes]
      least   number of elements from which all meshes are within the tolerance, or 0 if there is none
              [points, formulations, quantities]"""

    first: int
    at: np.ndarray
    doubt: np.ndarray
    kind: np.ndarray
    value: np.ndarray
    error: np.ndarray
    status: np.ndarray
    cost: np.ndarray
    least: np.ndarray


@dataclass
class Sweep:
    """Header of a file, whose tables pieces() reads.

    `subject` is the scene file or the case. `fixed` are the values of all parameters that do not vary. `noise` is the
    cost ratio below which costs tie. `points` is the number of points. `statuses` and `kinds` are names by number."""

    path: str
    subject: str
    fixed: str
    program: str
    tolerance: float
    noise: float
    axes: list
    quantities: list
    keys: list
    meshes: list
    points: int
    statuses: list
    kinds: list
    worst: list

    @property
    def without(self):
        """Returns the numbers of the kinds of missing reference values."""
        return [k for k, name in enumerate(self.kinds) if name.startswith(NONE)]

    def outcomes(self, names):
        return [s for s, name in enumerate(self.statuses) if name in names]

    @property
    def name(self):
        return pathlib.PurePath(self.subject).name

    def scene_of(self, worst):
        """Returns the scene file of a worst point, in a folder next to the sweep."""
        return str(pathlib.PurePath(self.path).with_suffix(".worst") / worst.scene)

    @property
    def cells(self):
        return self.points * len(self.keys) * len(self.meshes)

    def pieces(self):
        """Yields Piece records that contain every point once, in order. A formulation that omits relevant physics at a
        point has no values there."""
        names = {"at": "points", "doubt": "reference_doubt", "kind": "reference_kind"}
        names |= {name: name for name in ("value", "error", "status", "cost", "least")}
        whole = len(self.keys) * len(self.meshes) * len(self.quantities)
        names |= {"lacks": "not_modelled"}
        for first, found in self.read(names.values(), PIECE // whole):
            columns = dict(zip(names, found))
            other = columns.pop("lacks") != 0
            columns["status"][other] = self.statuses.index(OTHER)
            columns["value"][other] = columns["error"][other] = np.nan
            columns["least"][other] = 0
            yield Piece(first, **columns)

    def points_only(self):
        """Yields the parameters of all points, in pieces."""
        for _, (at, ) in self.read(["points"], PIECE // len(self.axes)):
            yield at

    def read(self, names, step):
        step = max(1, step)
        try:
            with h5py.File(self.path) as file:
                group = home(file)
                for first in range(0, self.points, step):
                    yield first, [group[name][first:first + step] for name in names]
        except OSError as why:
            raise Unreadable(f"{self.path}: cannot be read ({why}); run 'beamwork sweep' again"
                             ) from why

    def place(self, values):
        return ", ".join(f"{a.name} = {a.value(v)}" for a, v in zip(self.axes, values))


def home(file):
    """Returns the group with the tables of a sweep in a file, or None."""
    return file if MARK in file.attrs else file.get(GROUP)


def is_there(path):
    """Returns True if the file contains a sweep, and False for files that cannot be read."""
    try:
        with h5py.File(path) as file:
            return home(file) is not None
    except OSError:
        return False


def is_alone(path):
    """Returns True if the file contains a sweep but no results of verify."""
    if not is_there(path):
        return False
    with h5py.File(path) as file:
        return "cases" not in file


def program_of(told):
    return text(told["program"]) if "program" in told else (
        f"beamwork {text(told['program_version'])} ({text(told['commit'])})")


def listed(value):
    """Returns the strings of an attribute, which is a list or one string with a line for each."""
    if isinstance(value, (str, bytes)):
        return [line for line in text(value).split("\n") if line]
    return [text(each) for each in np.asarray(value).ravel().tolist()]


def axes_of(file):
    """Returns the axes of a file. The strings of an axis are an attribute of the points with the name of the axis."""
    told, out = file["points"].attrs, []
    for row in file["axes"][()]:
        name, unit, kind, scale = (text(row[c]) for c in ("name", "unit", "kind", "scale"))
        out.append(Axis(name, unit, kind, int(row["count"]), "log" in (kind, scale),
                        tuple(listed(told[name])) if kind == "words" else ()))
    return out


def check(file, sweep):
    """Raises ValueError if the size of a table does not match the sizes of the other tables."""
    f, m, q = len(sweep.keys), len(sweep.meshes), len(sweep.quantities)
    whole = {"points": (len(sweep.axes),), "reference_doubt": (q,), "reference_kind": (q,),
             "value": (f, m, q), "error": (f, m, q), "status": (f, m), "cost": (f, m),
             "least": (f, q), "not_modelled": (f, )}
    for name, size in whole.items():
        if file[name].shape != (sweep.points, *size) or 0 in file[name].shape:
            raise ValueError(f"table '{name}' has the size {file[name].shape} instead of "
                             f"{(sweep.points, *size)}")


def worst_of(file):
    return [Worst(int(r["point"]), text(r["formulation"]), int(r["mesh"]), text(r["quantity"]),
                  float(r["error"]), text(r["status"]), text(r["scene"]))
            for r in file["worst"][()]]


def read(path):
    """Returns the Sweep of a file. Raises Unreadable with the reason."""
    try:
        with h5py.File(path) as whole:
            file = home(whole)
            if file is None:
                raise Unreadable(f"{path}: not a sweep; 'beamwork sweep -o FILE' writes one")
            if file.attrs[MARK] != VERSION:
                raise Unreadable(f"{path}: the sweep has version {file.attrs[MARK]}, but the report reads version "
                                 f"{VERSION}; run 'beamwork sweep' again")
            told = file.attrs
            quantities = [Quantity(text(r["name"]), text(r["unit"]))
                          for r in file["quantities"][()]]
            found = Sweep(str(path), text(told["scene" if "scene" in told else "case"]),
                          text(told.get("parameters", "")), program_of(told),
                          float(told["tolerance"]), float(told.get("cost_noise", 1)),
                          axes_of(file), quantities,
                          [text(r["key"]) for r in file["formulations"][()]],
                          [int(n) for n in file["meshes"][()]], file["points"].shape[0],
                          listed(file["status"].attrs["names"]) + [OTHER],
                          listed(file["reference_kind"].attrs["names"]), worst_of(file))
            check(file, found)
            return found
    except (OSError, KeyError, ValueError, IndexError) as why:
        raise Unreadable(f"{path}: cannot be read ({why}); run 'beamwork sweep' again") from why
