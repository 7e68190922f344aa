"""A beam formulation in Python and numpy for beamwork --element 'exec:python3 my_beam.py'.

serve(*functions, **words) implements the protocol of harness/formulations/protocol.md. timoshenko.py in this folder is
an example. Arrays contain N elements at once, with n nodes and m strains. Matrices are the last two axes. The first
argument of each function is the kind of all N elements:
  prepare(kind) -> C[m, m], constant: sigma = C e; or None. Called once for each kind; may store
                          results in it. kind.length, .curvature[3], .strain[3],
                          .section.young ..., .features (a set of words), .options (a dict)
  strain(kind, r, u, R, a) -> e[N, m] from r[N, n, 3], u[N, n, 3], R[N, n, 3, 3], a[N, n]
  stress(kind, e) -> energy[N], sigma[N, m], C[N, m, m]; if prepare returns None
  force(kind, r, u, R, a) -> energy[N], F[N, 7 n], K[N, 7 n, 7 n]: for gives="tangent", instead of
                          strain and stress; K or F and K may be None for "force" and "energy"
  mass(kind, r, u, R, a) -> M[N, 7 n, 7 n], optional: x' M x'/2 is the kinetic energy; x': velocity,
                          angular velocity (both in fixed axes) and rate of warping of each node.
                          Everything else follows from it: rotating frames, motions
                          (not with inertia="vibration"). Default: the mass that all formulations share
  damping(kind) -> V[m, m], optional, constant, symmetric and positive semidefinite: strain rates e' add V e' to the
                          stresses in motions, damped modes and harmonic analyses
  line(kind, at, r, u, R, a) -> place[N, 3], axes[N, 3, 3], optional: the sections at at[N] in [0, 1] along the elements,
                          for loads along them. axes: columns, at rest those of the element
  begin(kind, r, u, R, a) -> h[N, q], with history=q: the values of the undeformed elements. strain or force then has
                          one more argument, h of the last accepted state, the end of a load step or time step. The
                          energy of force is then not requested and may be None
  commit(kind, r, u, R, a, h) -> h[N, q] of an accepted state, which was reached from h
With scalars=w, all functions of a state have one more argument after a: s[N, n, w], the additional unknowns of the
nodes; F, K and M then have c = (7 + w) n columns instead of 7 n: those of the nodes, followed by the unknowns.
Derivatives of strain, mass and line are computed by complex steps: they must accept complex arrays and be analytic (no abs,
norm, conj or comparison of values; rotation_vector and sinc below are analytic). With gives="e", strain receives only
real arrays, and beamwork computes differences. Raise Refused(why) for unsupported requests.
"""
import difflib
import functools
import json
import os
import sys
import traceback
from types import SimpleNamespace

import numpy as np

FEATURES = ("warping", "shear", "eccentric shear centre", "trapeze", "wagner moments",
            "wagner torque", "engesser", "haringx", "geometric", "large rotations", "mass",
            "rotary inertia", "initial curvature", "coupled section")
SECTION = ("young shear_modulus density A Iy Iz It Iw ys zs Ip wagner_y wagner_z wagner_torque D:9 "
           "F:9 axes_angle centroid:2 matrices stiffness:36 mass:36 rectangle width height")
FUNCTIONS = ("prepare", "strain", "stress", "force", "mass", "begin", "commit", "damping",
             "line")
KEYS = ("name summary source family offers gives strains nodes places order limits shear_theories "
        "inertia options history scalars").split()
TINY, STEP = 1e-20, 2e-3  # sizes of complex steps and of the finite differences that check complex steps


class Refused(Exception):
    """Raised if a request is rejected. The message is for the user."""


def checked(value, name, count, each, why, numbers="biuf"):
    """Returns the result of a function as an array[count, *each], or [*each] if count is 0. Raises Refused if the result
    has another shape or type."""
    def words(shape):
        all_of = ["N" if count and (i, v) == (0, count) else str(v) for i, v in enumerate(shape)]
        return f"({', '.join(all_of)})" if shape else "one number"

    try:
        found = np.asarray(value)
    except ValueError:
        raise Refused(f"{name}: an array is expected, but its rows differ in length") from None
    if value is None or found.dtype.kind not in numbers:
        what = "None" if value is None else f"numbers of type {found.dtype}"
        raise Refused(f"{name} returned {what}, real numbers are expected for real states")
    shape = (count, *each) if count else each
    if found.shape != shape:
        with_N = f", here N = {count}" if count else ""
        raise Refused(f"{name} returned {words(found.shape)}, {why} {words(shape)}{with_N}")
    return found


def cross_matrix(v):
    """Returns the matrices [..., 3, 3] of the vectors v[..., 3], where cross_matrix(v) @ w = v x w."""
    return np.cross(v[..., None, :], np.eye(3), axisa=-1, axisb=-1, axisc=-2)


def sinc(x):
    """Returns sin(x)/x; x may be complex."""
    return np.sin(x) / np.where(x == 0, 1, x) + (x == 0)


def rotation_vector(T):
    """Returns the rotation vectors, shorter than pi, of the rotation matrices T[..., 3, 3], which may be complex."""
    axis = np.stack([T[..., 2, 1] - T[..., 1, 2], T[..., 0, 2] - T[..., 2, 0],
                     T[..., 1, 0] - T[..., 0, 1]], -1) / 2
    c, s = (np.trace(T, axis1=-2, axis2=-1) - 1) / 2, np.sqrt((axis * axis).sum(-1))
    angle = np.arctan2(s.real, c.real)
    if np.iscomplexobj(T):
        angle = angle + 1j * (c.real * s.imag - s.real * c.imag) / (s.real**2 + c.real**2)
    return axis * (angle / np.where(s == 0, 1, s) + (s == 0))[..., None]


def turns(n):
    """Returns the indices [n, 3] of the rotations of n nodes among the coordinates."""
    return np.add.outer(7 * np.arange(n), [3, 4, 5])


def units(kind, x):
    """Returns the units [c] in which the increments of all coordinates of elements x[N, n, 16 + w] are of order one."""
    n, w = x.shape[1], x.shape[2] - 16
    return np.append(np.tile(kind.length ** np.array([1, 1, 1, 0, 0, 0, -1]), n), np.ones(w * n))


@functools.lru_cache
def steps(n, w, second):
    """Returns the real and imaginary coordinate increments [P, c] of the P evaluations from which derivatives are computed."""
    one = np.eye((7 + w) * n)
    if not second:
        return 0 * one, one
    i, j = np.tril_indices(len(one))
    size = STEP * np.array([1, -1, 2, -2])[:, None, None]
    real, imag = size * one[j], one[i] + 0 * size
    real, imag = real.reshape(-1, len(one)), imag.reshape(-1, len(one))
    psi, e = real[:, turns(n)], imag[:, turns(n)]  # spatial increment dexp(psi) e
    t2 = (psi**2).sum(-1)[..., None]
    turn, twice = np.cross(psi, e), np.cross(psi, np.cross(psi, e))
    imag[:, turns(n)] = e + turn * (1 / 2 - t2 / 24) + twice * (1 / 6 - t2 / 120)
    return real, imag


def moved(kind, x, real, imag):
    """Returns the states r, u, R, a, s [N P, n, ...] of the elements x[N, n, 16 + w] after each of P increments [P, c]."""
    n, w = x.shape[1], x.shape[2] - 16
    move, (psi, e) = (real + 1j * TINY * imag) * units(kind, x), (real[:, turns(n)], imag[:, turns(n)])
    more, move = move[:, 7 * n:].reshape(len(move), n, w), move[:, :7 * n].reshape(-1, n, 7)
    t, spin = np.linalg.norm(psi, axis=-1)[..., None, None] / np.pi, cross_matrix(psi)
    turn = np.eye(3) + spin * np.sinc(t) + spin @ spin * np.sinc(t / 2)**2 / 2
    turn, at = turn + 1j * TINY * cross_matrix(e) @ turn, x[:, None]
    turned = turn @ at[..., 6:15].reshape(len(x), 1, -1, 3, 3)
    return [v.reshape(-1, *v.shape[2:]) for v in (
        at[..., 0:3] + move[..., :3], at[..., 3:6] + move[..., :3], turned,
        at[..., 15] + move[..., 6], at[..., 16:] + more)[:5 if w else 4]]


def derivatives(kind, strain, x, s, h=()):
    """Returns J [N, m, c]. If s [N, m] is given, returns H [N, c, c], the second derivative of s times the
    strains. h is () or (history [N, q],)."""
    N, unit, (real, imag) = len(x), units(kind, x), steps(x.shape[1], x.shape[2] - 16, s is not None)
    h = [v.repeat(len(real), 0) for v in h]
    rate = strain(kind, *moved(kind, x, real, imag), *h).imag.reshape(N, len(real), -1) / TINY
    if s is None:
        return rate.swapaxes(1, 2) / unit
    f = np.einsum("npm,nm->np", rate, s).reshape(N, 4, -1)
    i, j = np.tril_indices(len(unit))
    H = np.empty((N, len(unit), len(unit)))
    H[:, i, j] = (8 * (f[:, 0] - f[:, 1]) - f[:, 2] + f[:, 3]) / (12 * STEP) / (unit[i] * unit[j])
    H[:, j, i] = H[:, i, j]
    return H


def is_analytic(kind, strain, x, h=()):
    """Returns True if complex steps of strain or mass agree with finite differences near an element x[1, n, 16 + w]."""
    n, unit = x.shape[1], units(kind, x)
    away = np.sin(np.arange(1, len(unit) + 1))[None] / 20
    state = [v.real for v in moved(kind, x, away, 0 * away)]
    x = np.concatenate([v.reshape(1, n, -1) for v in state], -1)
    real = STEP * np.kron([[1], [-1], [2], [-2]], np.eye(len(unit)))
    e = strain(kind, *(v.real for v in moved(kind, x, real, 0 * real)),
               *(v.repeat(len(real), 0) for v in h)).reshape(4, len(unit), -1)
    by_differences = (8 * (e[0] - e[1]) - e[2] + e[3]).T / (12 * STEP)
    by_steps = derivatives(kind, strain, x, None, h)[0] * unit
    return not (abs(by_steps - by_differences) > 1e-6 * abs(by_differences).max()).any()


def described(body, said):
    """Returns the number of a kind of elements, and the kind, from the body of the prepare request."""
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


def three(name, found, mask, parts, N, c, why):
    """Returns the requested items of energy[N], a vector [N, c] and a matrix [N, c, c]. Bit i of `mask` requests item i."""
    if not isinstance(found, (tuple, list)) or len(found) != 3:
        raise Refused(f"{name} must return three values: energy, {parts[0]}, {parts[1]}")
    all_three = [None if v is None and not mask >> i & 1 else
                 checked(v, f"{name}, for {part},", N, (c,) * i, f"{why} wants" if i else "wants")
                 for i, (v, part) in enumerate(zip(found, ("energy", *parts)))]
    return [v for i, v in enumerate(all_three) if mask >> i & 1]


def turning(kind, M, x, frame):
    """Returns potential, force, N and G of the elements x[N, n, 16 + w] in a rotating frame (omega, centre)."""
    N, n, c = len(x), x.shape[1], len(units(kind, x))

    def momentum(kind, r, *state):  # M v and v M v, where v is the velocity due to the rotation of the frame
        v = np.zeros((len(r), c), r.dtype)
        v[:, turns(n) - 3], v[:, turns(n)] = np.cross(frame[0], r - frame[1]), frame[0]
        p = np.einsum("nij,nj->ni", M(kind, r, *state), v)
        return np.hstack([p, (p * v).sum(1)[:, None]])

    J, s = derivatives(kind, momentum, x, None), np.zeros((N, c + 1))
    s[:, c] = -1 / 2
    p = momentum(kind, *states(x))
    G = J[:, :c] - J[:, :c].swapaxes(1, 2)
    for k in range(3, 7 * n, 7):
        G[:, k:k + 3, k:k + 3] += cross_matrix(p[:, k:k + 3])
    return [-p[:, c] / 2, J[:, c] / 2, derivatives(kind, momentum, x, s), G]


def in_time(kind, M, x, rate, acceleration, tangents):
    """Returns taken and, with tangents, C and K of the elements x[N, n, 16]: Lagrange's equations for x' M x'/2."""
    N, c = rate.shape

    def momentum(*at):
        return np.einsum("npij,nj->npi", M(*at).reshape(N, -1, c, c), rate).reshape(-1, c)

    if tangents:
        D = derivatives(kind, lambda *at: M(*at).reshape(-1, c * c), x, None).reshape(N, c, c, c)
        by_place = np.einsum("nikj,nk->nij", D, rate)
    else:
        by_place = derivatives(kind, momentum, x, None)
    now = M(kind, *states(x))
    p = np.einsum("nij,nj->ni", now, rate)
    taken = np.einsum("nij,nj->ni", now, acceleration) + np.einsum(
        "nij,nj->ni", by_place - by_place.swapaxes(1, 2) / 2, rate)
    starts = turns(x.shape[1])[:, 0]
    for k in starts:
        taken[:, k:k + 3] += np.cross(p[:, k:k + 3], rate[:, k:k + 3])
    if not tangents:
        return [taken]
    C = np.einsum("nijk,nk->nij", D, rate) + by_place - by_place.swapaxes(1, 2)
    for k in starts:
        C[:, k:k + 3] -= cross_matrix(rate[:, k:k + 3]) @ now[:, k:k + 3]
        C[:, k:k + 3, k:k + 3] += cross_matrix(p[:, k:k + 3])
    return [taken, C, np.einsum("nijk,nj->nik", D, acceleration)]


def states(x):
    """Returns the positions r, displacements u, rotations R, amplitudes a and unknowns s of the elements x[N, n, 16 + w]."""
    state = x[..., 0:3], x[..., 3:6], x[..., 6:15].reshape(*x.shape[:2], 3, 3), x[..., 15], x[..., 16:]
    return state[:5 if x.shape[2] > 16 else 4]


def inertia(mask, kind, x, body, functions):
    """Returns the inertia outputs that the mask requests for the elements x[N, n, 16 + w]. body[N, ...] contains the frame and the rates."""
    N, c = len(x), len(units(kind, x))

    def mass(kind, *state):
        numbers = "biufc" if np.iscomplexobj(state[0]) else "biuf"
        return checked(functions["mass"](kind, *state), "mass", len(state[0]), (c, c),
                       f"nodes={x.shape[1]} wants", numbers)

    if mask & (256 | 224) and not functions.get("analytic mass") and np.isfinite(x[0]).all():
        functions["analytic mass"] = is_analytic(
            kind, lambda *at: mass(*at).reshape(-1, c * c), x[:1])
        if not functions["analytic mass"]:
            raise Refused("derivatives are complex steps, but mass is not analytic (abs, norm, a "
                          "comparison, .real?): correct it")
    zero = np.zeros((N, c))
    found = [mass(kind, *states(x))] if mask & 1 else [None]
    if mask & 256:
        found += turning(kind, mass, x, body[0, :6].reshape(2, 3))
    else:
        found += [zero[:, 0], zero, np.zeros((N, c, c)), np.zeros((N, c, c))]
    if mask & 224:
        rates = body[:, 6 if mask & 256 else 0:].reshape(N, -1, c)
        found += in_time(kind, mass, x, rates[:, 0] if mask & 512 else zero,
                         rates[:, 1] if mask & 1024 else zero, mask & 192)
    return [v for i, v in enumerate(found) if mask >> i & 1]


def sections(mask, kind, x, body, functions):
    """Returns place, axes, P, T and H of the sections of the elements x[N, n, 16], as the mask requests. body[N, 7] contains
    their positions, and forces and moments for H."""
    N, (at, force, moment) = len(x), np.split(body, [1, 4], 1)

    def motion(kind, *state):
        found, numbers = functions["line"](kind, state[-1][:, 0], *state[:-1]), "biuf"
        if not isinstance(found, (tuple, list)) or len(found) != 2:
            raise Refused("line must return two values: place, axes")
        numbers = "biufc" if np.iscomplexobj(state[0]) else "biuf"
        return np.hstack([checked(v, f"line, for {part},", len(state[0]), each, "it wants", numbers).reshape(-1, 3**len(each))
                          for v, part, each in zip(found, ("place", "axes"), ((3,), (3, 3)))])

    if mask & 28 and not functions.get("analytic line") and np.isfinite(x[0]).all():
        functions["analytic line"] = is_analytic(kind, motion, x[:1], (at[:1],))
        if not functions["analytic line"]:
            raise Refused("derivatives are complex steps, but line is not analytic (abs, norm, a "
                          "comparison, .real?): correct it")
    found = motion(kind, *states(x), at)
    place, R = found[:, :3], found[:, 3:].reshape(N, 3, 3)
    J = derivatives(kind, motion, x, None, (at,)) if mask & 28 else np.zeros((N, 12, 0))
    P, dR = J[:, :3], J[:, 3:].reshape(N, 3, 3, -1)
    T = np.cross(R[..., None], dR, axis=1).sum(2) / 2
    H = None
    if mask & 16:  # T^T m is half the sum of dR_k . (m x R_k) over the axes R_k
        turned = np.cross(moment[..., None], R, axis=1) / 2
        H = derivatives(kind, motion, x, np.hstack([force, turned.reshape(N, 9)]), (at,))
        H += np.einsum("nikc,nij,njkd->ncd", dR, cross_matrix(moment), dR) / 2
    return [v for i, v in enumerate((place, R, P, T, H)) if mask >> i & 1]


def answers(what, mask, kind, body, said, functions):
    """Returns the arrays that the mask requests for elements of one kind. body[N, ...] is the body of the request."""
    N, n, m, q = len(body), *(said.get(key, no) for key, no in (("nodes", 2), ("strains", 0), ("history", 0)))
    if what == 3:
        found = functions["stress"](kind, body)
        return three("stress", found, mask, ("sigma", "C"), N, m, f"strains={m}")
    w = said.get("scalars", 0)
    x = np.concatenate([body[:, :16 * n].reshape(N, n, 16), body[:, 16 * n:(16 + w) * n].reshape(N, n, w)], -1)
    body = body[:, (16 + w) * n:]
    if what == 5:
        return inertia(mask, kind, x, body, functions)
    if what == 8:
        return sections(mask, kind, x, body, functions)
    state = states(x)
    h, s = body[:, :q], body[:, q:]
    last = (h,) if q else ()
    if what in (6, 7):
        name = FUNCTIONS[what - 1]
        if name == "begin" and name not in functions:
            return [np.zeros((N, q))]
        found = functions[name](kind, *state, *(() if what == 6 else (h,)))
        return [checked(found, name, N, (q,), f"history={q} wants")]
    if what == 4:
        found = functions["force"](kind, *state, *last)
        return three("force", found, mask, "FK", N, (7 + w) * n, f"nodes={n}")

    def strain(kind, *state):
        numbers = "biufc" if np.iscomplexobj(state[0]) else "biuf"
        return checked(functions["strain"](kind, *state), "strain", len(state[0]), (m,),
                       f"strains={m} wants", numbers)

    if mask & 6 and not functions.get("analytic") and np.isfinite(x[0]).all():
        functions["analytic"] = is_analytic(kind, strain, x[:1], [v[:1] for v in last])
        if not functions["analytic"]:
            raise Refused("derivatives are complex steps, but strain is not analytic (abs, norm, "
                          "a comparison, .real?): correct it, or say gives='e'")
    of = (lambda: strain(kind, *state, *last), lambda: derivatives(kind, strain, x, None, last),
          lambda: derivatives(kind, strain, x, s, last))
    return [f() for i, f in enumerate(of) if mask >> i & 1]


def prepared(body, kinds, said, functions):
    """Returns the arrays of the answer to a prepare request."""
    number, kind = described(body, said)
    kinds[number], C = kind, functions["prepare"](kind)
    if "force" not in functions and C is None and "stress" not in functions:
        raise Refused("prepare returned None: give a constant C, or serve the function stress")
    m = said.get("strains", 0)
    found = [] if C is None else [checked(C, "prepare", 0, (m, m), f"strains={m} wants")]
    if "damping" in functions:
        if "stress" in functions and found:
            raise Refused("prepare returned C, but the function stress is served, too: give one of them")
        found.append(checked(functions["damping"](kind), "damping", 0, (m, m), f"strains={m} wants"))
    return found


def answer(what, mask, count, body, kinds, said, functions):
    """Returns the arrays of the answer to any request."""
    if what == 1:
        return prepared(body, kinds, said, functions)
    numbers, rest = np.frombuffer(body, "<i8", count), np.frombuffer(body, "<f8", offset=8 * count)
    n = said.get("nodes", 2) * count
    w, q = said.get("scalars", 0), said.get("history", 0) * count
    sizes = {2: [q], 4: [q], 5: [6 * (mask >> 8 & 1), *((7 + w) * n * (mask >> bit & 1) for bit in (9, 10))],
             8: [count, 3 * count]}
    ends = np.cumsum([16 * n, w * n, *sizes.get(what, [])]) if what != 3 else []
    parts = np.split(rest, ends)
    if what == 5:  # one frame for all elements
        parts[2] = np.tile(parts[2], count)
    each = np.hstack([part.reshape(count, -1) for part in parts if part.size])
    out = None
    for number in np.unique(numbers):
        of = numbers == number
        found = answers(what, mask, kinds[number], each[of], said, functions)
        out = [np.empty((count, *v.shape[1:])) for v in found] if out is None else out
        for whole, part in zip(out, found):
            whole[of] = part
    return out


def told(error):
    """Returns one line for the user with the error and the last line of the user's code that was reached."""
    if isinstance(error, Refused):
        return str(error)
    own = [f for f in traceback.extract_tb(error.__traceback__)
           if f.filename != __file__ and not f.filename.startswith(os.path.dirname(np.__file__))]
    where = f" ({os.path.basename(own[-1].filename)}:{own[-1].lineno})" if own else ""
    return f"{type(error).__name__}: {str(error)[:120]}{where}"


def taken(functions, words):
    """Returns the functions by name, and the keys of the first line of the protocol. Exits with an error if a word is unknown."""
    functions, said = dict(zip(FUNCTIONS, functions)), {}
    for word, value in words.items():
        if word in KEYS:
            said[word] = value
        elif word in FUNCTIONS and (value is None or callable(value)):
            functions[word] = value
        else:
            near = difflib.get_close_matches(word, KEYS, 1)
            value = type(value).__name__ if isinstance(value, np.ndarray) else repr(value)
            sys.exit(f"serve(): {word}={value} is no " + ("function; give a function that returns it" if word in FUNCTIONS
                     else f"key, did you mean {near[0]}?" if near else f"key; keys: {', '.join(KEYS)}"))
    functions = {name: f for name, f in functions.items() if f is not None}
    if "places" in said:
        said["places"] = [float(v) for v in said["places"]]
    if "mass" in functions:
        moves = said.get("nodes", 2) == 2 and "scalars" not in said
        said = {"inertia": "motion" if moves else "vibration", **said}
    said.update({name: True for name in ("damping", "line") if name in functions})
    if "damping" in functions and "stress" in functions:
        said["damping"] = "only V"  # without C
    return functions, {"beamwork": 1, "gives": "tangent" if "force" in functions else "e,J,H",
                       **said}


def answer_all(requests, to, functions, said):
    """Answers requests from a stream until the end of the stream, and writes the answers to another stream. functions, said: the
    results of taken()."""
    functions, kinds = dict(functions), {}
    to.write(json.dumps(said).encode() + b"\n")
    to.flush()
    while len(head := requests.read(40)) == 40:
        what, mask, count, size = (int(v) for v in np.frombuffer(head, "<i8", offset=8))
        body = requests.read(size)
        try:
            with np.errstate(all="ignore"):  # states may contain NaN or Inf
                arrays, outcome = answer(what, mask, count, body, kinds, said, functions), 0
            out = b"".join(np.asarray(v, "<f8").tobytes() for v in arrays)
        except (Exception, SystemExit) as error:  # pylint: disable=broad-except
            outcome, out = 3, told(error).encode()[:300]
        to.write(b"beamwork" + np.array([outcome, len(out)], "<i8").tobytes() + out)
        to.flush()


def serve(*functions, **words):
    """Answers requests until beamwork stops. Example: serve(prepare, strain, stress, family="..."). `words` are keys of
    the first line of the protocol. Functions that are not needed may be omitted."""
    functions, said = taken(functions, words)
    requests, to = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # print writes to standard error
    answer_all(requests, to, functions, said)
