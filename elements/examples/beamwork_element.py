"""A beam formulation in Python and numpy for beamwork --element 'exec:python3 my_beam.py'.

serve(**what it is, functions) speaks the protocol of harness/process/README.md; timoshenko.py
beside this file is an example. Arrays: N elements at once, n nodes, m strains; matrices are the
last two axes. Functions (first argument: the kind of element that all N are):
  prepare(kind)           -> C[m, m], constant: sigma = C e; or None. Once for each kind; may keep
                          what it computes in it. kind.length, .curvature[3], .strain[3],
                          .section.young ..., .features (a set of words), .options (a dict)
  strain(kind, r, u, R, a) -> e[N, m] from r[N, n, 3], u[N, n, 3], R[N, n, 3, 3], a[N, n]
  stress(kind, e)         -> energy[N], sigma[N, m], C[N, m, m]; where prepare gives None
  force(kind, r, u, R, a) -> energy[N], F[N, 7 n], K[N, 7 n, 7 n]: for gives="tangent", in place of
                          strain and stress; K or F and K may be None for "force" and "energy"
Derivatives of strains are complex steps: strain must take complex arrays and be analytic (no abs,
norm, conj, comparison of values; rotation_vector and sinc below are). With gives="e" it is called
with real arrays only and beamwork takes differences. Raise Refused(why) for what cannot be done.
"""
import functools
import json
import os
import traceback
from types import SimpleNamespace

import numpy as np

FEATURES = ("warping", "shear", "eccentric shear centre", "trapeze", "wagner moments",
            "wagner torque", "engesser", "haringx", "geometric", "large rotations", "mass",
            "rotary inertia", "initial curvature", "coupled section")
SECTION = ("young shear_modulus density A Iy Iz It Iw ys zs Ip wagner_y wagner_z wagner_torque D:9 "
           "F:9 axes_angle centroid:2 matrices stiffness:36 mass:36 rectangle width height")
TINY, STEP = 1e-20, 2e-3  # of complex steps and of differences of their results


class Refused(Exception):
    """Its text reaches the user."""


def cross_matrix(v):
    """[..., 3] -> [..., 3, 3]: cross_matrix(v) @ w = v x w."""
    return np.cross(v[..., None, :], np.eye(3), axisa=-1, axisb=-1, axisc=-2)


def sinc(x):
    """sin(x)/x, also of complex steps."""
    return np.sin(x) / np.where(x == 0, 1, x) + (x == 0)


def rotation_vector(T):
    """Of rotation matrices [..., 3, 3], shorter than pi, also of complex steps."""
    axis = np.stack([T[..., 2, 1] - T[..., 1, 2], T[..., 0, 2] - T[..., 2, 0],
                     T[..., 1, 0] - T[..., 0, 1]], -1) / 2
    c, s = (np.trace(T, axis1=-2, axis2=-1) - 1) / 2, np.sqrt((axis * axis).sum(-1))
    angle = np.arctan2(s.real, c.real)
    if np.iscomplexobj(T):
        angle = angle + 1j * (c.real * s.imag - s.real * c.imag) / (s.real**2 + c.real**2)
    return axis * (angle / np.where(s == 0, 1, s) + (s == 0))[..., None]


@functools.lru_cache
def steps(n, second):
    """Increments of all coordinates [P, n, 7] (real, imaginary) that derivatives are taken from."""
    one = np.eye(7 * n)
    if not second:
        return np.zeros((7 * n, n, 7)), one.reshape(-1, n, 7)
    i, j = np.tril_indices(7 * n)
    size = STEP * np.array([1, -1, 2, -2])[:, None, None]
    real, imag = size * one[j], one[i] + 0 * size
    real, imag = real.reshape(-1, n, 7), imag.reshape(-1, n, 7)
    psi, e = real[..., 3:6], imag[..., 3:6]  # spatial increment: dexp(psi) e
    t2 = (psi**2).sum(-1)[..., None]
    turn, twice = np.cross(psi, e), np.cross(psi, np.cross(psi, e))
    imag[..., 3:6] = e + turn * (1 / 2 - t2 / 24) + twice * (1 / 6 - t2 / 120)
    return real, imag


def derivatives(kind, strain, x, s):
    """J [N, m, 7 n]; or, where s [N, m] is given, H [N, 7 n, 7 n] of s times the strains."""
    (N, n, _), (real, imag) = x.shape, steps(x.shape[1], s is not None)
    unit = kind.length ** np.array([1, 1, 1, 0, 0, 0, -1])  # increments as numbers of order one
    move, (psi, e) = (real + 1j * TINY * imag) * unit, (real[..., 3:6], imag[..., 3:6])
    t, spin = np.linalg.norm(psi, axis=-1)[..., None, None] / np.pi, cross_matrix(psi)
    turn = np.eye(3) + spin * np.sinc(t) + spin @ spin * np.sinc(t / 2)**2 / 2
    turn = turn + 1j * TINY * cross_matrix(e) @ turn
    at = x[:, None]
    rate = strain(kind, *(v.reshape(-1, *v.shape[2:]) for v in (
        at[..., 0:3] + move[..., :3], at[..., 3:6] + move[..., :3],
        turn @ at[..., 6:15].reshape(N, 1, n, 3, 3), at[..., 15] + move[..., 6])))
    rate, unit = rate.imag.reshape(N, len(real), -1) / TINY, np.tile(unit, n)
    if s is None:
        return rate.swapaxes(1, 2) / unit
    f = np.einsum("npm,nm->np", rate, s).reshape(N, 4, -1)
    i, j = np.tril_indices(7 * n)
    H = np.empty((N, 7 * n, 7 * n))
    H[:, i, j] = (8 * (f[:, 0] - f[:, 1]) - f[:, 2] + f[:, 3]) / (12 * STEP) / (unit[i] * unit[j])
    H[:, j, i] = H[:, i, j]
    return H


def described(body, said):
    """A kind of elements from the body of a request to prepare it; its number."""
    (number, bits, _), rest = np.frombuffer(body, "<i8", 3), np.frombuffer(body, "<f8", offset=24)
    kind, at = SimpleNamespace(length=rest[0], curvature=rest[1:4], strain=rest[4:7]), 7
    kind.section = SimpleNamespace()
    for name, _, size in (word.partition(":") for word in SECTION.split()):
        setattr(kind.section, name, rest[at:at + int(size)] if size else rest[at])
        at += int(size or 1)
    kind.features = {word for i, word in enumerate(FEATURES) if bits >> i & 1}
    kind.options = {option["name"]: option["choices"][int(v)] if "choices" in option else v
                    for option, v in zip(said.get("options", ()), rest[at:])}
    return int(number), kind


def answers(what, mask, kind, body, size, functions):
    """The arrays that a mask asks for, of elements of one kind, body[N, ...] as in the request."""
    if what == 3:
        all_three = functions["stress"](kind, body)
        return [v for i, v in enumerate(all_three) if mask >> i & 1]
    x = body[:, :16 * size].reshape(len(body), size, 16)
    state = x[..., 0:3], x[..., 3:6], x[..., 6:15].reshape(*x.shape[:2], 3, 3), x[..., 15]
    if what == 4:
        return [v for i, v in enumerate(functions["force"](kind, *state)) if mask >> i & 1]
    strain = functions["strain"]
    of = (lambda: strain(kind, *state), lambda: derivatives(kind, strain, x, None),
          lambda: derivatives(kind, strain, x, body[:, 16 * size:]))
    return [f() for i, f in enumerate(of) if mask >> i & 1]


def answer(what, mask, count, body, kinds, said, functions):
    """The body of an answer."""
    if what == 1:
        number, kind = described(body, said)
        kinds[number], C = kind, functions["prepare"](kind)
        return [] if C is None else [C]
    numbers, rest = np.frombuffer(body, "<i8", count), np.frombuffer(body, "<f8", offset=8 * count)
    nodes, strains = said.get("nodes", 2), said.get("strains", 0)
    parts = np.split(rest, [16 * nodes * count]) if what != 3 else [rest]
    each = np.hstack([part.reshape(count, -1) for part in parts if part.size])
    out = None
    for number in np.unique(numbers):
        of = numbers == number
        found = answers(what, mask, kinds[number], each[of], nodes, functions)
        out = [np.empty((count, *v.shape[1:])) for v in found] if out is None else out
        for whole, part in zip(out, found):
            whole[of] = part
    return out


def serve(prepare, strain=None, stress=None, force=None, **said):
    """Answers until beamwork has no more requests. said: keys of the protocol's first line."""
    said = {"beamwork": 1, "gives": "tangent" if force else "e,J,H", **said}
    functions, kinds = {"prepare": prepare, "strain": strain, "stress": stress, "force": force}, {}
    requests, to = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # print goes to standard error
    to.write(json.dumps(said).encode() + b"\n")
    to.flush()
    while len(head := requests.read(40)) == 40:
        what, mask, count, size = (int(v) for v in np.frombuffer(head, "<i8", offset=8))
        body = requests.read(size)
        try:
            arrays, outcome = answer(what, mask, count, body, kinds, said, functions), 0
            out = b"".join(np.asarray(v, "<f8").tobytes() for v in arrays)
        except Exception as error:  # pylint: disable=broad-except
            last = traceback.extract_tb(error.__traceback__)[-1]
            where = "" if isinstance(error, Refused) else f" ({last.filename}:{last.lineno})"
            name = "" if isinstance(error, Refused) else f"{type(error).__name__}: "
            outcome, out = 3, f"{name}{error}{where}".encode()[:300]
        to.write(b"beamwork" + np.array([outcome, len(out)], "<i8").tobytes() + out)
        to.flush()
