"""Momentum of freely flying structures after the load has ended, which is the integral of the load."""
from mpmath import mpf

ANY = "integrator=*;step=*;tolerance=*"
ROUND_OFF = 1e-12  # relative round-off of a run with hundreds of steps
PLANE_TIMES = {"": ("2.5", "5", "10"), "load=step;": ("2.5", "5", "7.5", "10")}
SPACE_TIMES = ("5", "7", "7.5", "9", "10")


def plane():
    """Returns the momentum [kg m/s] due to 8 N for 2.5 s. The force is constant, or a squared sine with twice the
    amplitude and therefore the same mean."""
    return 8 * mpf("2.5")


def space():
    """Returns the momentum [kg m/s] due to a triangular force of 5 s with a peak of a tenth of 200 N."""
    return mpf(5) * 20 / 2


def rows():
    for load, times in PLANE_TIMES.items():
        for time in times:
            yield ("free_flight_plane", f"{load}time={time};{ANY}", "px", plane(), "kg m/s",
                   ROUND_OFF)
    for time in SPACE_TIMES:
        for name, value in (("px", space()), ("py", 0), ("pz", 0)):
            yield ("free_flight_space", f"time={time};{ANY}", name, value, "kg m/s", ROUND_OFF)
