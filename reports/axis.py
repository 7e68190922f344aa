"""Axes of charts: limits, where values are, few round ticks."""
import math

import numpy as np

SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def power(decade):
    return f"10{str(decade).translate(SUPERSCRIPTS)}" if decade not in (0, 1) else str(10**decade)


def whole_ticks(low, high):
    """Few round whole numbers on a logarithmic axis."""
    decades = math.log10(high / low)
    if decades < 0.7:
        step = max(1, round((high - low) / 4))
        return [n for n in range(math.ceil(low), math.floor(high) + 1) if n % step == 0] or [low]
    steps = (1, 2, 4) if decades < 1.2 else (1, 2, 5) if decades < 2.2 else (1,)
    return [s * 10**e for e in range(-3, 10) for s in steps if low <= s * 10**e <= high]


def log_ticks(low, high):
    """Powers of ten, at most six."""
    first, last = math.ceil(math.log10(low) - 1e-9), math.floor(math.log10(high) + 1e-9)
    every = max(1, math.ceil((last - first + 1) / 6))
    if last > first:
        return [(10.0**e, power(e)) for e in range(first, last + 1) if (e - last) % every == 0]
    return [(s * 10.0**e, f"{s * 10.0**e:g}") for e in range(first - 2, last + 1) for s in (1, 2, 5)
            if low <= s * 10.0**e <= high]


def linear_ticks(low, high):
    step = 10.0**math.floor(math.log10((high - low) / 4))
    step *= next(f for f in (1, 2, 5, 10) if (high - low) / (f * step) <= 6)
    digits = max(0, -math.floor(math.log10(step) + 1e-9))
    return [(i * step, f"{i * step:.{digits}f}" if 1e-4 < step < 1e5 else f"{i * step:g}")
            for i in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]


class Axis:
    """One direction of a panel. log: logarithmic; whole: its ticks are whole numbers."""

    def __init__(self, log, whole=False):
        self.log, self.whole, self.low, self.high = log, whole, math.inf, -math.inf

    def take(self, values):
        values = [v for v in values if math.isfinite(v) and (v > 0 or not self.log)]
        self.low, self.high = min([self.low, *values]), max([self.high, *values])

    def settle(self):
        """Limits a little beyond what is drawn."""
        if not self.high >= self.low:
            self.low, self.high = 1, 10
        if self.log:
            margin = (self.high / self.low)**0.05 if self.high > self.low else 3
            self.low, self.high = self.low / margin, self.high * margin
        else:
            margin = 0.05 * (self.high - self.low) or abs(self.low) or 1
            self.low, self.high = self.low - margin, self.high + margin

    def part(self, values):
        """Where values are, from 0 to 1."""
        values = np.asarray(values, float)
        if self.log:
            return np.log(values / self.low) / math.log(self.high / self.low)
        return (values - self.low) / (self.high - self.low)

    def ticks(self):
        if not self.log:
            return linear_ticks(self.low, self.high)
        if self.whole:
            return [(t, f"{t:g}") for t in whole_ticks(self.low, self.high)]
        return log_ticks(self.low, self.high)
