"""Processor times, and the smallest of several."""
import math
import resource
import time
from collections.abc import Mapping

ROUND = 0.02  # [s] time for which a round repeats set-up and solution


def clock() -> float:
    """Returns the processor time of this process and of the processes that it ran [s]."""
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


def least(first: Mapping[str, float], second: Mapping[str, float]) -> dict[str, float]:
    """Returns the times of `second`, each replaced by the time with the same name in `first` if that is smaller."""
    return {name: min(first.get(name, math.inf), value) for name, value in second.items()}
