"""Numbers of an axis near one: values in thousandths or millionths of a unit, or in thousands."""
import numpy as np

PREFIXES = ((1e-6, "µ"), (1e-3, "m"), (1.0, ""), (1e3, "k"))
POWERS = {1e-6: "10⁻⁶ ", 1e-3: "10⁻³ ", 1e3: "10³ "}
PLAIN = ("m", "rad", "J", "N", "N m", "s")  # units that take a prefix as they are


def fitting(values, unit):
    """(size of the unit that suits them, its name)."""
    largest = float(np.abs(np.asarray(values, float)).max(initial=0))
    size, prefix = 1.0, ""
    for one, name in PREFIXES:
        if largest >= 0.2 * one and largest > 0:
            size, prefix = one, name
    if 0.01 <= largest <= 9999 or size == 1:
        return 1.0, unit
    if unit in PLAIN and not (unit in ("m", "rad") and size > 1):
        return size, prefix + unit
    return size, POWERS[size] + unit if unit not in ("", "1") else POWERS[size].strip()
