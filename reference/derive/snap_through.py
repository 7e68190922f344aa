"""Von Mises truss: two hinged bars of EA = 1 N and L = 1 m with the current length l and the compression N = EA (1 -
l/L). The limit points and the forces have closed forms."""
from mpmath import acos, atan, cos, mp, mpf, sin, sqrt, tan

from reference.derive import defaults

mp.dps = 30


def force(start, angle):
    """Returns the force 2 N sin(angle), with l/L = cos(start)/cos(angle)."""
    return 2 * (1 - cos(start) / cos(angle)) * sin(angle)


def rows():
    for text in ("0.3", "0.1", "1"):
        start = mpf(text)
        limit = acos(cos(start) ** (mpf(1) / 3))
        assert abs(force(start, limit) - 2 * sqrt(1 - cos(start) ** (mpf(2) / 3)) ** 3) < 1e-25
        values = (("limit_load", force(start,
                                       limit), "N"), ("limit_load_back", -force(start, limit), "N"),
                  ("deflection_at_limit", cos(start) * (tan(start) - tan(limit)),
                   "m"), ("load_inverted", force(start, atan(-tan(start) * 3 / 2)), "N"))
        for control in ("arc", "displacement"):
            at = defaults.differing("snap_through", angle=text, control=control)
            for name, value, unit in values:
                yield "snap_through", at, name, value, unit
