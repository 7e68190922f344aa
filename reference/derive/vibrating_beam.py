"""Exact small vibration of a uniform straight beam with or without shear deformation: transfer of its amplitudes from end
to end.

Bending, with the angular frequency o, the rotation t of the section and the shear stiffness S: w' = t + Q/S, t' = M/EI,
M' = -Q - o^2 rho I t, Q' = -o^2 rho A w. The beam is an Euler-Bernoulli beam if 1/S = 0 and rho I = 0, a Rayleigh beam
if only 1/S = 0, and otherwise a Timoshenko beam. Stretch and torsion: p'' = -(o/c)^2 p with c^2 = EA/(rho A) or GJ/(rho
Ip).
"""
from mpmath import cos, expm, findroot, matrix, mpf, sin


def bending(length, o, EI, mass, rotary=0, flexibility=0):
    """Returns (w, t, M, Q) at the end due to unit values at the start [4, 4]. `mass` is rho A, `rotary` is rho I, and
    `flexibility` is 1/S."""
    a = matrix(4, 4)
    a[0, 1], a[0, 3], a[1, 2], a[2, 3] = 1, flexibility, 1 / EI, -1
    a[2, 1], a[3, 0] = -rotary * o ** 2, -mass * o ** 2
    return expm(a * length)


def along(length, o, stiffness, speed):
    """Returns (p, force) at the end of a rod that is fixed at its start, where the force is 1. `stiffness` is EA or GJ."""
    k = o / speed
    return sin(k * length) / (k * stiffness), cos(k * length)


def zeros(function, end, step):
    """Returns the zeros below `end` in ascending order. Zeros closer together than the step may be missed."""
    found, x, before = [], mpf(step), function(mpf(step))
    while x < end:
        after = function(x + step)
        if before * after < 0:
            found.append(findroot(function, (x, x + step), solver="anderson"))
        x, before = x + step, after
    return found
