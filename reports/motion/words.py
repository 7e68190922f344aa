"""Sentences about a motion: what integrated it, its steps, what it drifts by."""
import math
import re

import numpy as np

ROUND_OFF = 1e-6  # momenta that change by less are said to stay


def scheme(how):
    """Name and parameters of what integrated a motion."""
    name = how.get("integrator", "alpha")
    if name != "alpha":
        return name
    if how.get("trapezoidal"):
        return "the trapezoidal rule"
    if "hht" in how:
        return f"HHT ({float(how['hht']):g})"
    if "parameters" not in how:
        return f"alpha (rho {float(how.get('rho', 0.9)):g})"
    alpha_m, alpha_f = map(float, how["parameters"])
    if not alpha_m:
        return f"HHT ({alpha_f:g})" if alpha_f else "the trapezoidal rule"
    rho = alpha_f / (1 - alpha_f) if alpha_f != 1 else math.inf
    if abs((2 * rho - 1) / (rho + 1) - alpha_m) < 1e-9:
        return f"alpha (rho {rho:.3g})"
    return f"alpha ({alpha_m:.3g}, {alpha_f:.3g})"


def steps(motion):
    """How many and how long."""
    lengths = motion.steps
    if np.ptp(lengths) <= 1e-6 * lengths.max():
        return f"{len(lengths)} steps of {lengths[0]:.3g} s"
    return f"{len(lengths)} steps of {lengths.min():.2g} to {lengths.max():.2g} s"


def momenta(motion):
    """What is said of momenta that stay."""
    changes = [c for c in (motion.stays("P"), motion.stays("L")) if math.isfinite(c)]
    if changes and max(changes) < ROUND_OFF:
        return f", momentum and angular momentum by {max(changes):.0e}"
    return ""


def sentence(motion, how):
    """One motion in one sentence."""
    rejected = int(motion.columns["rejected"].sum())
    tries = (f" ({rejected} longer {'one' if rejected == 1 else 'ones'} rejected)"
             if rejected else "")
    drift = float(np.abs(motion.drift).max())
    name = scheme(how)
    tolerance = float(how.get("tolerance", 0))  # YAML reads 1e-05 as a text
    by = f" with a tolerance of {tolerance:g} a step" if tolerance else ""
    return (f"{name[0].upper()}{name[1:]}{by} takes {steps(motion)}{tries} to "
            f"{motion.time[-1]:.4g} s, {motion.columns['iterations'][1:].mean():.1f} iterations "
            f"each; energy drifts by at most {drift:.0e} of its largest value{momenta(motion)}.")


def between(values, form):
    """`least to largest`, one where they are told alike."""
    least, most = form.format(min(values)), form.format(max(values))
    return least if least == most else f"{least} to {most}"


def whenever(meaning):
    """What a quantity is, without the instant at which it is read."""
    return re.sub(r", \S+ s after the start of the motion", "", meaning)


def spread(motions):
    """How the others compare, or nothing."""
    if len(motions) < 2:
        return ""
    drifts = [float(np.abs(m.drift).max()) for m in motions]
    counts = [float(m.columns["iterations"][1:].mean()) for m in motions]
    return (f"Of all {len(motions)} formulations energy drifts by "
            f"{between(drifts, '{:.0e}')}, and a step takes {between(counts, '{:.1f}')} iterations.")
