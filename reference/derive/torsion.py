"""Torsion: Saint-Venant's constant of a rectangle, and twist_ratio = phi GJ/(T L) of a cantilever with warping restrained
at its root."""
import functools

from mpmath import inf, mp, mpf, nsum, pi, tanh, workdps

from reference.derive import defaults

mp.dps = 40


@functools.cache
def rectangle_constant(w, t):
    """Returns w t^3/3 (1 - 192/pi^5 t/w sum over odd n of tanh(n pi w/2t)/n^5) for w >= t to 30 digits. The remaining
    terms are extrapolated."""
    with workdps(40):
        w, t = mpf(w), mpf(t)
        series = nsum(lambda m: tanh((2 * m + 1) * pi * w / (2 * t)) / (2 * m + 1) ** 5, [0, inf])
        return w * t ** 3 / 3 * (1 - 192 / pi ** 5 * t / w * series)


def twist_ratio(kl, ends):
    """Returns 1 - tanh(x)/x, where x is kL of a cantilever. If warping is restrained at both ends, each half of the beam
    is such a cantilever."""
    x = mpf(kl) / (2 if ends == "fixed" else 1)
    return 1 - tanh(x) / x


def rows():
    for kl in ("0.001", "0.5", "1", "2", "5", "10", "20"):
        for ends in ("cantilever", "fixed"):
            yield "warping_torsion", defaults.differing("warping_torsion", kL=kl,
                                                        ends=ends), "twist_ratio", twist_ratio(
                                                            kl, ends), "1"
