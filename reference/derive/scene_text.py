"""Reads a scene in the form that `beamwork scene` writes, with loops and expressions expanded.

Entries that the program does not support are rejected with one line that names them.
"""
import math

import mpmath as mp
import numpy as np
import yaml

from reference.derive.beam import Beam
from reference.derive.torsion import rectangle_constant


class Refused(Exception):
    """Raised if the program does not support a part of the scene. The text is a line for the user."""


def read(text):
    try:
        scene = yaml.load(text, Loader=yaml.BaseLoader)
    except yaml.YAMLError as error:
        raise Refused(f"the scene cannot be read: {' '.join(str(error).split())}") from error
    if not isinstance(scene, dict) or scene.get("beamwork") != "1":
        raise Refused("the scene is not of version 1, as 'beamwork scene' writes it")
    return scene


def only(entry, where, known):
    for key in entry:
        if key not in known:
            raise Refused(f"{where}: '{key}' is not supported by the deriving program")


def number(word, where):
    try:
        value = float(word)
    except (TypeError, ValueError):
        raise Refused(f"{where}: '{word}' is not a number") from None
    if not math.isfinite(value):
        raise Refused(f"{where}: {word} is not finite")
    return value


def numbers(words, where, count=None):
    if not isinstance(words, list) or count not in (None, len(words)):
        raise Refused(f"{where}: {count or 'a list of'} numbers are wanted")
    return [number(word, where) for word in words]


def named(table, name, what, where):
    if name not in table:
        raise Refused(f"{where}: no {what} '{name}'")
    return table[name]


def table(path, value):
    """Returns a function that is linear between the stations of a path and constant beyond them."""

    def at(level):
        if level <= path[0]:
            return value[0]
        for (a, u), (b, v) in zip(zip(path, value), zip(path[1:], value[1:])):
            if level <= b:
                return u + (v - u) * (level - a) / (b - a)
        return value[-1]

    return at


# Builds the beam of beam.py from a section of a scene, with the physics that the scene does not omit.
#
# A fibre rotates about the shear centre. Therefore, if the shear centre is not at the centroid, the trapeze term
# contains ys^2 + zs^2, and the Wagner moments contain -2 ys and -2 zs. Ip/A is included only with `trapeze`. int y (y^2
# + z^2) dA and int z (y^2 + z^2) dA are included only with `wagner_moments`.
#
# Rectangle: EIw is computed from Saint-Venant's series (warping_constant). 1/F = k A; if k is not given, k = 5/6, and
# the warping shear has the factor 5/6. c = (w^5 t + w t^5)/1440 = 1/8 (int r^4 dA - Ip^2/A).
#
# Walls: c = 1/8 (int r^4 dA - Ip^2/A - wagner_y^2/Iz - wagner_z^2/Iy) with r^2 = y^2 + z^2 (section.py).
#
# Ring with radii R > r: 1/k = 7/6 + 10/3 m^2/(1 + m^2)^2 with m = r/R (Renton 1991; Cowper 1966 at nu = 0), and c = 1/8
# int (r^2 - Ip/A)^2 dA.

MATERIAL = ("young", "shear_modulus", "density", "given")
OVERRIDES = ("Iw", "ys", "zs", "It", "Ip", "wagner_torque")
NAMES = ("A", "Iy", "Iz", "It", "Iw", "Ip", "ys", "zs", "wagner_y", "wagner_z", "wagner_torque")
RIGIDITIES = ("Dy", "Dz", "Dw", "Dyz", "Dyw", "Dzw")
PLACES = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


class Constants:
    """Constants of a section. A, Iy, ... are in SI units. F [3, 3] are shear flexibilities times G. `turned` is the angle
    [rad] from the y axis of the description to the principal y axis."""

    def __init__(self, **values):
        for name in NAMES:
            setattr(self, name, values.get(name, 0.0))
        self.F, self.turned = np.array(values.get("F", np.zeros((3, 3))), dtype=float), values.get(
            "turned", 0.0)


def warping_constant(wide, thin):
    """Returns int omega^2 dA with omega = y z + sum C_n sin(k_n y) sinh(k_n z) and stress-free sides, by integration over
    the area."""
    a, b = mp.mpf(thin) / 2, mp.mpf(wide) / 2
    ks = [(2*n + 1) * mp.pi / 2 / a for n in range(60)]
    cs = [-4 * (-1)**n / (a * k**3) for n, k in enumerate(ks)]
    # omega^2 is integrated over z in closed form, and over y by orthogonality of sin(k_n y)
    total = 4 * a**3 * b**3 / 9
    for n, (k, c) in enumerate(zip(ks, cs)):
        tanh = mp.tanh(k * b)
        first, second = 2 * (-1)**n / k**2, 2 * (b / k - tanh / k**2)
        total += 2 * c * first * second + c**2 * a * (tanh / k - b / mp.cosh(k * b)**2)
    k = (2*len(ks) + 1) * mp.pi / 2 / a  # remaining terms, for which tanh = 1
    tail = (mp.zeta(6, len(ks) + mp.mpf(1)/2)) * (a / mp.pi)**6
    total += -32 * b / a * tail + 48 / a * mp.zeta(7, len(ks) + mp.mpf(1)/2) * (a / mp.pi)**7
    return float(total)


def rectangle(entry, where):
    shape = entry["rectangle"]
    only(shape, where, ("width", "thickness"))
    only(entry, where, (*MATERIAL, "rectangle", "shear_factor"))
    w, h = (number(shape[name], where) for name in ("width", "thickness"))
    wide, thin = max(w, h), min(w, h)
    given = entry.get("shear_factor")
    k = numbers(given, where, 2) if isinstance(given, list) else [number(given or "0", where)] * 2
    F = np.diag([1 / ((factor or 5 / 6) * w * h)
                 for factor in k] + [0.0 if any(k) else 1 / (5 / 6 * thin * wide ** 3 / 12)])
    return Constants(A=w * h,
                     Iy=h * w ** 3 / 12,
                     Iz=w * h ** 3 / 12,
                     Ip=w * h * (w * w + h * h) / 12,
                     It=float(rectangle_constant(wide, thin)),
                     Iw=warping_constant(wide, thin),
                     wagner_torque=(wide ** 5 * thin + wide * thin ** 5) / 1440,
                     F=F)


def tube(entry, where):
    shape = entry["tube"]
    only(shape, where, ("diameter", "thickness"))
    only(entry, where, (*MATERIAL, "tube"))
    R = number(shape["diameter"], where) / 2
    r = R - number(shape["thickness"], where)
    ring, m = R * R - r * r, R * r / (R * R + r * r)
    A, I = math.pi * ring, math.pi / 4 * ring * (R * R + r * r)
    shear = (7 / 6 + 10 / 3 * m * m) / A
    return Constants(A=A,
                     Iy=I,
                     Iz=I,
                     Ip=2 * I,
                     It=2 * I,
                     wagner_torque=math.pi * ring ** 3 / 96,
                     F=np.diag([shear, shear, 0.0]))


def walls(entry, where):
    from reference.derive.section import section
    only(entry, where, (*MATERIAL, "points", "walls"))
    names = list(entry["points"])
    points = [numbers(entry["points"][name], where, 2) for name in names]
    try:
        s = section(points,
                    [(names.index(w["from"]), names.index(w["to"]), number(w["thickness"], where))
                     for w in entry["walls"]])
    except ValueError as error:
        raise Refused(f"{where}: {error}") from error
    return Constants(F=s.F.tolist(),
                     turned=float(s.beta),
                     **{name: float(getattr(s, name))
                        for name in NAMES if hasattr(s, name)})


def constants(entry, where):
    shape = entry["constants"]
    only(shape, where, (*NAMES, "D", "F"))
    only(entry, where, (*MATERIAL, "constants"))
    values = {name: number(shape[name], where) for name in NAMES if name in shape}
    values.setdefault("Ip", values["Iy"] + values["Iz"])
    if "F" in shape:
        values["F"] = np.reshape(numbers(shape["F"], where, 9), (3, 3))
    elif "D" in shape:
        values["F"] = inverse(np.reshape(numbers(shape["D"], where, 9), (3, 3)))
    return Constants(**values)


def inverse(matrix):
    """Returns the inverse of the nonzero part. Rows and columns that are zero (rigid) remain zero."""
    out, some = np.zeros((3, 3)), [i for i in range(3) if matrix[i, i] != 0]
    out[np.ix_(some, some)] = np.linalg.inv(matrix[np.ix_(some, some)])
    return out


SHAPES = {"rectangle": rectangle, "tube": tube, "walls": walls, "constants": constants}


def constants_of(entry, where):
    shape = [name for name in SHAPES if name in entry]
    if len(shape) != 1:
        raise Refused(f"{where}: its shape is not supported by the deriving program")
    out = SHAPES[shape[0]](entry, where)
    given = entry.get("given", {})
    only(given, where, (*OVERRIDES, *RIGIDITIES))
    for name in OVERRIDES:
        if name in given:
            setattr(out, name, number(given[name], where))
    if any(name in given for name in RIGIDITIES):
        D = inverse(out.F)
        for name, (i, j) in zip(RIGIDITIES, PLACES):
            if name in given:
                D[i, j] = D[j, i] = number(given[name], where)
        out.F = inverse(D)
    return out


def beam(entry, physics, length, curvature, where):
    """Returns (Beam, constants) of a member with this length [m] and curvature [1/m] about the z axis of the section."""
    s = constants_of(entry, where)
    E, G = number(entry["young"], where), number(entry["shear_modulus"], where)
    if s.It == 0 and s.Iw == 0:
        raise Refused(f"{where}: nothing resists its torsion")
    if s.Iw == 0 and "shear" in physics and np.any(s.F[2, :2]):
        raise Refused(f"{where}: shear that is coupled with a warping that is not there")
    moments = "wagner_moments" in physics
    out = Beam(
        length,
        EA=E * s.A,
        EIy=E * s.Iy,
        EIz=E * s.Iz,
        GJ=G * s.It,
        EIw=("warping" in physics) * E * s.Iw,
        curvature=curvature,
        centre=(s.ys, s.zs),
        t=("trapeze" in physics) * s.Ip / s.A + s.ys ** 2 + s.zs ** 2,
        c=("wagner_torque" in physics) * E * s.wagner_torque,
        wagner=(moments * s.wagner_z / s.Iy - 2 * s.zs, moments * s.wagner_y / s.Iz - 2 * s.ys),
        shear=("shear" in physics) * s.F / G)
    return out, s
